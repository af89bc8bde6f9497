"""What a load distribution says; SI units, read-only arrays.

x runs along the path from A to E, y along the face from the end that meshes first; gamma is the profile parameter.
"""

from dataclasses import dataclass

from solvers.arrays import BoolArray, FloatArray, frozen
from solvers.gears.pair import PathOfContact
from solvers.notices import Notice
from solvers.scuffing.load_balance import LoadBalance


@dataclass(frozen=True, slots=True)
class Place:
    """A point of the flank: gamma, fraction of the path from A, fraction of the face from the end that meshes first."""

    gamma: float
    profile_fraction: float
    face_fraction: float


@dataclass(frozen=True, slots=True)
class Geometry:
    """The mesh: lengths [m], angles [rad]; undercut is true if either gear is."""

    centre_distance: float
    working_pressure_angle: float
    base_helix_angle: float
    transverse_base_pitch: float
    path_of_contact: float
    transverse_contact_ratio: float
    overlap_ratio: float
    total_contact_ratio: float
    undercut: bool


@dataclass(frozen=True, slots=True)
class LengthCurves:
    """Total contact length [m] over the roll position, a fraction of the base pitch; spur gears' jumps stand twice."""

    roll_position: FloatArray
    length: FloatArray


@dataclass(frozen=True, slots=True)
class ContactLines:
    """Total length of the contact lines [m], extremes and mean in closed form."""

    min_length: float
    max_length: float
    mean_length: float
    length_ratio: float
    curves: LengthCurves


@dataclass(frozen=True, slots=True)
class StiffnessCurves:
    """Stiffness of one pair over gamma [Pa]."""

    gamma: FloatArray
    single: FloatArray


@dataclass(frozen=True, slots=True)
class Stiffness:
    """Stiffness per face width [Pa]: of one pair, secant at secant_load [N/m], and of the mesh.

    `pitch` is None where the path does not hold the pitch point, `mean_mesh` without load. `standard_...` is ISO
    6336-1, method B.
    """

    max: float
    max_at_gamma: float
    approach: float
    pitch: float | None
    recess: float
    mean_mesh: float | None
    standard_single: float
    standard_mesh: float
    secant_load: float
    curves: StiffnessCurves


@dataclass(frozen=True, slots=True)
class ErrorCurves:
    """Transmission error [m] over the roll position, a fraction of the base pitch; spur gears' jumps stand twice."""

    roll_position: FloatArray
    error: FloatArray


@dataclass(frozen=True, slots=True)
class TransmissionError:
    """Transmission error along the transverse line of action [m]; harmonics are amplitudes 2 |c_k| from order 1."""

    peak_to_peak: float
    mean: float
    min: float
    max: float
    harmonics: FloatArray
    curves: ErrorCurves


@dataclass(frozen=True, slots=True)
class LoadOnFlank:
    """Forces [N], torque [N m], largest line load [N/m] and its place; contact_fraction of the flank's contact length.

    pinion_torque is the transmitted one, the forces are contact_factor times what it gives. normal_force is the one
    in balance, tangential_force always F_bt. pair_share [line, roll position] is the force on each line over the force
    in balance.
    """

    pinion_torque: float
    contact_factor: float
    tangential_force: float
    normal_force: float
    max_line_load: float
    max_at: Place | None
    contact_fraction: float
    face_load_factor: float | None
    balance_error: float
    pair_share: FloatArray | None


@dataclass(frozen=True, slots=True)
class Pressure:
    """Largest Hertz pressure [Pa] over all roll positions, and its place.

    None where the loaded path reaches a base circle, towards which pressure has no limit.
    """

    max: float | None
    max_at: Place | None


@dataclass(frozen=True, slots=True)
class FrictionLoss:
    """Mean coefficient of friction, loss factor H_V, friction power [W] and efficiency.

    Without load loss factor and efficiency are None; where the coefficient is not known it is None, and power and
    efficiency are.
    """

    coefficient: float | None
    loss_factor: float | None
    power: float | None
    efficiency: float | None


@dataclass(frozen=True, slots=True)
class ContactPoints:
    """At points of the flank: line load [N/m], Hertz pressure [Pa], half width and reduced radius [m], speeds [m/s].

    pressure is NaN where the reduced radius vanishes.
    """

    gamma: FloatArray
    line_load: FloatArray
    pressure: FloatArray
    half_width: FloatArray
    radius: FloatArray
    pinion_speed: FloatArray
    wheel_speed: FloatArray

    @property
    def sliding(self) -> FloatArray:
        """Sliding velocity u_1 - u_2 [m/s]."""
        return frozen(self.pinion_speed - self.wheel_speed)

    @property
    def in_contact(self) -> BoolArray:
        """Where the flanks touch and move, so that film and flash temperature have a meaning."""
        return (self.line_load > 0.0) & (self.half_width > 0.0) & (self.pinion_speed + self.wheel_speed > 0.0)

    @property
    def undefined(self) -> BoolArray:
        """Where a load presses too near a base circle for a width of contact, a pressure or a flash temperature."""
        return (self.line_load > 0.0) & (self.half_width <= 0.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class FeatureLine(ContactPoints):
    """Points along the feature line; load sharing is None without load, the standard's also where it has no diagram."""

    psi: FloatArray
    load_sharing: FloatArray | None
    iso_load_sharing: FloatArray | None


@dataclass(frozen=True, slots=True)
class Flank:
    """Maps [profile, face]: modification [m], line load [N/m], pressure [Pa] (NaN where R_n vanishes)."""

    profile_fraction: FloatArray
    face_fraction: FloatArray
    modification: FloatArray
    line_load: FloatArray
    pressure: FloatArray


@dataclass(frozen=True, slots=True)
class Derived:
    """What follows from the inputs before any physics: torque [N m], power [W], lengths [m].

    rack_tip_radius is what both racks have room for, in normal modules.
    """

    pinion_torque: float
    power: float
    centre_distance: float
    tip_relief_length: float
    root_relief_length: float
    end_relief_length: float
    rack_tip_radius: float


@dataclass(frozen=True, slots=True)
class LoadDistribution:
    """How a pair of gears carries its load; path_of_contact and balance are what further checks build on."""

    path_of_contact: PathOfContact
    balance: LoadBalance
    geometry: Geometry
    contact_lines: ContactLines
    stiffness: Stiffness
    transmission_error: TransmissionError
    load: LoadOnFlank
    pressure: Pressure
    friction_loss: FrictionLoss
    feature_line: FeatureLine
    flank: Flank
    derived: Derived
    warnings: tuple[Notice, ...]
