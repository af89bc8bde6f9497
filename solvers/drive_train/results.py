"""What a drive train says; SI units, read-only arrays. Vectors are (X, Y), gaps positive where the flanks part."""

from dataclasses import dataclass

from solvers.arrays import FloatArray
from solvers.drive_train.derived import Derived
from solvers.drive_train.inputs import Vector2
from solvers.drive_train.shafts.thrust_budget import Thrust
from solvers.notices import Notice
from solvers.scuffing.results import LoadDistribution, Place


@dataclass(frozen=True, slots=True)
class Parts:
    """Slope of the shafts' gap over the face [m] by its causes, at the load that both agreed on.

    bending, torsion and tilting_moment are elastic, by the mesh force; films is the bearings' yielding to all loads, of
    pinion and wheel together and apart; coupling, collar and weight are what these loads bend elastically.
    """

    bending: float
    torsion: float
    tilting_moment: float
    films: float
    films_pinion: float
    films_wheel: float
    bearing_offsets: float
    coupling: float
    collar: float
    weight: float


@dataclass(frozen=True, slots=True)
class GapCurves:
    """Over the face, at stations from the end that meshes first [m]: gaps [m], transverse force per face [N/m].

    modification is its lead part; total is the sum of the three.
    """

    position: FloatArray
    z: FloatArray
    shaft: FloatArray
    thermal: FloatArray
    modification: FloatArray
    total: FloatArray
    line_force: FloatArray


@dataclass(frozen=True, slots=True)
class Misalignment:
    """Slope, crown and range of the gap [m] by shafts and heat, and what to grind against both.

    `shaft_mean` went into the transmission error. The recommendation is a total: minus slope and crown of the gap under
    a load spread evenly over the face, for that is what a corrected flank has.
    """

    shaft_slope: float
    shaft_crown: float
    shaft_range: float
    shaft_mean: float
    parts: Parts
    thermal_slope: float
    thermal_crown: float
    thermal_range: float
    thermal_profile_slope: float
    base_pitch: float
    total_slope: float
    recommended_helix_slope: float
    recommended_lead_crowning: float
    recommended_profile_slope: float
    curves: GapCurves


@dataclass(frozen=True, slots=True)
class FaceLoad:
    """How the face carries: K_H_beta and its place (fraction of the face), line load [N/m], pressure [Pa], PPTE [m]."""

    face_load_factor: float | None
    face_load_at: float | None
    max_line_load: float
    max_pressure: float | None
    contact_fraction: float
    transmission_error_pp: float


@dataclass(frozen=True, slots=True)
class BearingResult:
    """A bearing: reaction on the shaft [N], displacement without the bore's offset [m]; the rest of plain ones only."""

    reaction: Vector2
    displacement: Vector2
    eccentricity_ratio: float | None
    attitude: float | None
    min_film: float | None
    specific_pressure: float | None
    friction_power: float


@dataclass(frozen=True, slots=True)
class ShaftCurves:
    """Along a shaft at z [m]: displacement x, y [m] and twist [rad] of its axis."""

    z: FloatArray
    x: FloatArray
    y: FloatArray
    twist: FloatArray


@dataclass(frozen=True, slots=True)
class ShaftResult:
    """A shaft: bearings, thrust, curves."""

    bearings: tuple[BearingResult, BearingResult]
    thrust: Thrust
    curves: ShaftCurves


@dataclass(frozen=True, slots=True)
class CouplingResult:
    """A coupling: tilts of the hubs A (unit) and B (machine) [rad], whether they stick; loads on hub A [N m, N].

    `force` holds half the sleeve's weight; `thrust` is the stated part of the limit, towards +Z. `friction_share` is
    the friction moment of each hub over that of full sliding; friction_coefficient the smaller.
    """

    tilt: Vector2
    stuck: tuple[bool, bool]
    friction_share: Vector2
    moment: Vector2
    force: Vector2
    friction_coefficient: float
    thrust: float
    thrust_limit: float
    friction_power: float


@dataclass(frozen=True, slots=True)
class FlashPlaces:
    """Largest Blok flash temperature [K] on the feature line and on the flank, and where; None at a base circle."""

    feature: float | None
    flank: float | None
    flank_at: Place | None


@dataclass(frozen=True, slots=True)
class TrainSafety:
    """Safety against scuffing: Blok on the feature line and over the flank, thermal EHL on two lines; None unknown.

    `blok_at` is the flank's worst point by Blok, and the profile line runs from A to E through it. `minimum` is the
    smallest of those asked for, None where one is unknown.
    """

    blok_feature: float | None
    blok_flank: float | None
    blok_at: Place | None
    thermal_ehl_feature: float | None
    thermal_ehl_profile: float | None
    minimum: float | None


@dataclass(frozen=True, slots=True)
class TrainLosses:
    """Power [W] lost in couplings, to pumping, in mesh and plain bearings; efficiency None where they exceed it.

    Where the mesh's coefficient of friction is not known, its loss, the total and the efficiency are None.
    """

    coupling: float
    pumping: float
    mesh: float | None
    bearings: float
    total: float | None
    efficiency: float | None


@dataclass(frozen=True, slots=True)
class ForceBalance:
    """Largest unbalanced sum on a shaft: forces over F_bt, moments over F_bt b; None without load."""

    force_error: float | None
    moment_error: float | None


@dataclass(frozen=True, slots=True)
class Convergence:
    """Iterations on the gap and the last residual [m]."""

    iterations: int
    residual: float


@dataclass(frozen=True, slots=True)
class FlankMaps:
    """Maps [profile, face]: line load [N/m], pressure [Pa], NaN where R_n vanishes, contact temperature by Blok [K]."""

    profile_fraction: FloatArray
    face_fraction: FloatArray
    line_load: FloatArray
    pressure: FloatArray
    contact_temperature: FloatArray


@dataclass(frozen=True, slots=True)
class States:
    """The unit in other states than the one asked about; None where that state was not asked for or has no solution."""

    cold: "DriveTrainResult | None"


@dataclass(frozen=True, slots=True)
class DriveTrainResult:
    """The unit's answer; `mesh` is the load distribution under the gap that all agreed on.

    `contact_temperature` is the map [profile, face] by Blok [K].
    """

    misalignment: Misalignment
    load: FaceLoad
    shafts: tuple[ShaftResult, ShaftResult]
    couplings: tuple[CouplingResult, ...]
    flash: FlashPlaces
    safety: TrainSafety | None
    losses: TrainLosses
    balance: ForceBalance
    convergence: Convergence
    mesh: LoadDistribution
    contact_temperature: FloatArray
    warnings: tuple[Notice, ...]
    derived: Derived
    states: States | None = None

    @property
    def flank(self) -> FlankMaps:
        """Over the flank."""
        maps = self.mesh.flank
        return FlankMaps(
            maps.profile_fraction, maps.face_fraction, maps.line_load, maps.pressure, self.contact_temperature
        )
