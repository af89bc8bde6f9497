"""What the coupling model answers at one operating point, in SI, arrays read-only.

Lengths [m], angles [rad], forces [N], moments [N m]. A value that has no meaning is None, and a notice in `warnings`
says why.
"""

from dataclasses import dataclass

from solvers.arrays import FloatArray
from solvers.coupling.inputs import Coupling
from solvers.notices import Notice


@dataclass(frozen=True, slots=True)
class Geometry:
    """Radii of the crowned tooth [m]."""

    pitch_radius: float
    crowning_radius: float
    tangential_flank_radius: float
    normal_flank_radius: float


@dataclass(frozen=True, slots=True)
class KinematicCurves:
    """Motion over one revolution of a tooth of the driving hub, one value an angle.

    `angle` counts from the pivot position (the tilt positions are at 90 and 270 degrees). `sliding_velocity` is
    axial, hub against sleeve, signed; `hydrodynamic_velocity` a magnitude; `contact_position` axial on the hub tooth.
    """

    angle: FloatArray
    sliding_velocity: FloatArray
    hydrodynamic_velocity: FloatArray
    tangential_displacement: FloatArray
    contact_position: FloatArray


@dataclass(frozen=True, slots=True)
class Kinematics:
    """Largest values of the tooth's motion over a revolution, all positive [m/s, m]."""

    max_sliding_velocity: float
    max_contact_travel: float
    max_hydrodynamic_velocity: float
    tangential_displacement_peak_to_peak: float
    curves: KinematicCurves


@dataclass(frozen=True, slots=True)
class LoadCurves:
    """Tooth forces at the rotor angle asked for: tooth i stands at `angle` = 2 pi i / teeth + rotor angle."""

    angle: FloatArray
    tangential_force: FloatArray


@dataclass(frozen=True, slots=True)
class LoadDistribution:
    """One mesh, the one where the hub drives the sleeve, at the rotor angle asked for.

    `load_concentration` is largest over mean force (None without torque). `rotation` is the common rotation of the
    hub against the sleeve as a length at the pitch radius. `unloading_misalignment`: beyond it some tooth carries
    nothing (centred sleeve, many teeth, no pitch errors). `sleeve_displacement` (x, y) is relative to the hub.
    `iterations` of the floating sleeve, 0 for the centred one.
    """

    mean_tangential_force: float
    max_tangential_force: float
    min_tangential_force: float
    max_normal_force: float
    load_concentration: float | None
    loaded_teeth: int
    rotation: float
    unloading_misalignment: float
    sleeve_displacement: tuple[float, float]
    iterations: int
    curves: LoadCurves


@dataclass(frozen=True, slots=True)
class Regime:
    """An area of the paper's map of friction conditions (Fig. 9); an open end of its friction band is None.

    `distance_to_boundary` is the smallest |ln| of overlap and load capacity against the map's boundaries; None where
    both lie infinitely far (no misalignment).
    """

    area: str
    name: str
    friction_min: float | None
    friction_max: float | None
    distance_to_boundary: float | None


@dataclass(frozen=True, slots=True)
class Lubrication:
    """Contact and film of the highest loaded tooth in the tilt position (over a revolution with pitch errors).

    `contact_overlap` None: the contact does not travel. `inlet_ratio` None: infinite inlet.
    `load_capacity_coefficient` None: no load.
    """

    max_normal_force: float
    hertz_half_width: float
    hertz_pressure: float
    contact_overlap: float | None
    inlet_ratio: float | None
    inlet_factor: float
    hydrodynamic_capacity: float
    load_capacity_coefficient: float | None
    regime: Regime
    friction_coefficient: float


@dataclass(frozen=True, slots=True)
class SelfInducedThrust:
    """Thrust that two meshes make without any axial motion, mean over one tooth pitch.

    `overturning_moment` is friction's on the sleeve, both meshes. `simple_model_force` and `uniform_load_force` are
    closed forms (one tooth pair a mesh; all teeth loaded alike), zero in the angular arrangement.
    """

    force: float
    overturning_moment: float
    simple_model_force: float
    uniform_load_force: float


@dataclass(frozen=True, slots=True)
class AxialThrust:
    """Mean axial thrust over one tooth pitch (one revolution with pitch errors).

    `force`: of one mesh in the sense of the axial velocity (`single`), or on one shaft, positive = shafts pulled
    together. The bounds differ from `force` only where friction is `indeterminate` (nothing slides).
    `fraction_of_limit` is force over `coaxial_limit`; None without load. `breakaway_force` starts coaxial shafts
    sliding from rest, where no film carries. `uniform_load_force` is the closed form of one mesh with equal tooth
    loads. A thrust bearing must hold `design_force`, the larger of |force| and breakaway; `customary_force` is beside
    it what practice reckons with, None without a shaft diameter.
    """

    force: float
    coaxial_limit: float
    breakaway_force: float
    design_force: float
    customary_force: float | None
    fraction_of_limit: float | None
    uniform_load_force: float
    lower_bound: float
    upper_bound: float
    indeterminate: bool
    self_induced: SelfInducedThrust | None


@dataclass(frozen=True, slots=True)
class Losses:
    """Friction power [W] and moments [N m] of one mesh, means over one tooth pitch (revolution with pitch errors).

    Axial velocity included: power is friction moment times tilting speed plus thrust times axial velocity. Where
    nothing slides the friction moment is open and reported as zero.
    """

    friction_power: float
    friction_moment: float
    contact_shift_moment: float
    hub_bending_moment: float


@dataclass(frozen=True, slots=True)
class Limits:
    """Design limits and linear stiffness with every tooth loaded [m/s, rad, N m, N m/rad, N/m].

    `allowable_misalignment` None: the coupling turns too slowly to reach the limit, or not at all.
    """

    sliding_velocity_limit: float
    allowable_misalignment: float | None
    sleeve_centring_torque: float
    torsional_stiffness: float
    lateral_stiffness: float


@dataclass(frozen=True, slots=True)
class CouplingResult:
    """Everything about one operating point; `derived` is the coupling with its proportions filled in."""

    geometry: Geometry
    kinematics: Kinematics
    load_distribution: LoadDistribution
    lubrication: Lubrication
    axial_thrust: AxialThrust
    losses: Losses
    limits: Limits
    derived: Coupling
    warnings: tuple[Notice, ...]
