"""What describes a gear coupling, its operation and the choices of the model.

Lengths [m], angles [rad], forces [N], speeds [rad/s]. Every name is the API's name without its unit.
"""

from dataclasses import dataclass, field
from math import radians
from typing import Any, Literal

Arrangement = Literal["single", "parallel_offset", "angular"]
KinematicModel = Literal["tangential", "spatial"]
SleeveSupport = Literal["centred", "floating"]
InletModel = Literal["face", "travel", "infinite"]


@dataclass(frozen=True, slots=True)
class Coupling:
    """The coupling: crowned hub teeth in a straight internal sleeve.

    `crowning_ratio` is crowning radius over pitch radius (1: heavily crowned). `face_width` and `tooth_height`
    (load-carrying height, the length of the contact line) [m] belong to the hub. `hub_distance` [m] lies between
    the two tooth planes. `tooth_stiffness` [N/m] is tangential, one tooth pair; its default is of the order of
    ISO 6336 (14 N/(mm um) over 20 mm). `sleeve_mass` [kg] is the mass one mesh carries: half the sleeve.
    `pitch_errors` [m], one a tooth, are positive where a tooth carries early; None means none.
    """

    teeth: int
    module: float
    face_width: float
    tooth_height: float
    pressure_angle: float = radians(20.0)
    crowning_ratio: float = 1.0
    hub_distance: float = 0.2
    tooth_stiffness: float = 2.8e8
    sleeve_mass: float = 4.0
    pitch_errors: tuple[float, ...] | None = None
    youngs_modulus: float = 206e9
    poisson_ratio: float = 0.3


def proportioned(
    *, module: float, face_width: float | None = None, tooth_height: float | None = None, **others: Any
) -> Coupling:
    """The coupling, a missing face width 8 modules and a missing tooth height 2 modules: the paper gives none."""
    return Coupling(
        module=module,
        face_width=8 * module if face_width is None else face_width,
        tooth_height=2 * module if tooth_height is None else tooth_height,
        **others,
    )


@dataclass(frozen=True, slots=True)
class Operation:
    """Load and motion.

    `torque` [N m] >= 0. Signed: `speed` [rad/s] (sense of rotation), `misalignment` [rad] of hub against sleeve at
    one mesh, `axial_velocity` [m/s] per mesh, positive where the shafts move apart. `arrangement`: `single` is one
    mesh, `parallel_offset` (Z) two hubs tilted alike against the sleeve, `angular` (M) two hubs tilted oppositely.
    `shaft_diameter` [m] is that of the customary thrust 0.25 T/D; None asks for none.
    """

    torque: float
    speed: float
    misalignment: float
    axial_velocity: float = 0.0
    arrangement: Arrangement = "single"
    shaft_diameter: float | None = None


@dataclass(frozen=True, slots=True)
class Lubricant:
    """Oil at the teeth: `viscosity` [Pa s] (default: ISO VG 46 near 50 C); `reference_film` [m] of the capacity."""

    viscosity: float = 0.025
    reference_film: float = 1e-6


@dataclass(frozen=True, slots=True)
class MixedFrictionCurve:
    """Our law of mixed friction against sliding velocity: falls from `highest` to `lowest` at `velocity` [m/s].

    The end values are the paper's band of area 1.1; `velocity` is a calibration: it puts the minimum of the heavily
    crowned coupling at 0.4 degrees and 200 rad/s (the paper gives no speed for its Fig. 11).
    """

    highest: float = 0.10
    lowest: float = 0.05
    velocity: float = 0.11


@dataclass(frozen=True, slots=True)
class MixedFrictionTable:
    """Measured mixed friction: `coefficient` [-] over rising `sliding_velocity` [m/s], one point or more.

    Constant outside the table.
    """

    sliding_velocity: tuple[float, ...]
    coefficient: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Friction:
    """Coefficients of friction: None means the law of the friction regime.

    `static_coefficient` None means the user's coefficient, without one that of the regime at rest without film.
    """

    coefficient: float | None = None
    static_coefficient: float | None = None
    mixed_law: MixedFrictionCurve | MixedFrictionTable = field(default_factory=MixedFrictionCurve)


@dataclass(frozen=True, slots=True)
class ModelOptions:
    """Choices where the paper leaves room.

    `kinematics`: `tangential` is what the paper describes, `spatial` exact to first order (it adds the pivot motion).
    `sleeve` of the single mesh. `inlet` of the oil film: `face` (the face left ahead of the contact at the reversal),
    `travel` (the contact's travel) or `infinite`; `inlet_length` [m] overrides it. `film_angle` [rad]: the tooth
    angle whose hydrodynamic velocity builds the film; None means its largest. `rotor_angle` [rad] at which the tooth
    forces are reported. `simple_thrust_factor`: share of the sleeve force that the one-pair model of self-induced
    thrust turns into a difference of tooth forces (the paper does not state it).
    """

    kinematics: KinematicModel = "tangential"
    sleeve: SleeveSupport = "centred"
    inlet: InletModel = "face"
    inlet_length: float | None = None
    film_angle: float | None = None
    rotor_angle: float = 0.0
    simple_thrust_factor: float = 1.0


@dataclass(frozen=True, slots=True)
class CouplingInputs:
    """One coupling at one operating point."""

    coupling: Coupling
    operation: Operation
    lubricant: Lubricant = field(default_factory=Lubricant)
    friction: Friction = field(default_factory=Friction)
    model: ModelOptions = field(default_factory=ModelOptions)


@dataclass(frozen=True, slots=True)
class RecommendationInputs:
    """A coupling whose crowning is sought for a range of misalignment [rad], 0 < minimum <= maximum.

    `design` gives everything else; its own crowning ratio and misalignment are not read.
    """

    design: CouplingInputs
    min_misalignment: float
    max_misalignment: float
