"""What describes a single-stage gear unit with its shafts, bearings and couplings; SI units, angles in radians.

The frame: Z along the pinion's axis, X and Y across it; positions along Z are from any datum, the same for both shafts.
"Pinion" is the driving gear.
"""

from dataclasses import dataclass, field
from math import pi
from typing import Literal

from solvers.coupling.inputs import Coupling, Friction, Lubricant, ModelOptions
from solvers.pumping.inputs import PumpingSetup
from solvers.scuffing.inputs import ScuffingInputs

Vector2 = tuple[float, float]
CouplingFriction = Literal["elastic_plastic", "sliding"]
ShaftName = Literal["pinion", "wheel"]
State = Literal["hot", "cold"]
STATIONS = 41
ASSUMED_RESPONSE = 0.5


@dataclass(frozen=True, slots=True)
class ShaftSection:
    """A cylinder of a shaft [m]."""

    length: float
    outer_diameter: float
    inner_diameter: float = 0.0


@dataclass(frozen=True, slots=True)
class JournalBearing:
    """A plain bearing; lengths [m], viscosity of its film [Pa s].

    `radial_clearance` None is 1.5e-3 of the journal's radius. `offset` (X, Y) is of the bore against the datum axis.
    """

    position: float
    diameter: float
    width: float
    viscosity: float
    radial_clearance: float | None = None
    offset: Vector2 = (0.0, 0.0)

    @property
    def clearance(self) -> float:
        """Radial clearance in force [m]."""
        return 0.75e-3 * self.diameter if self.radial_clearance is None else self.radial_clearance


@dataclass(frozen=True, slots=True)
class LinearBearing:
    """A bearing by its `stiffness` ((xx, xy), (yx, yy)) [N/m], which need not be symmetric."""

    position: float
    stiffness: tuple[Vector2, Vector2]
    offset: Vector2 = (0.0, 0.0)


@dataclass(frozen=True, slots=True)
class RigidBearing:
    """A bearing that does not yield."""

    position: float
    offset: Vector2 = (0.0, 0.0)


Bearing = JournalBearing | LinearBearing | RigidBearing


@dataclass(frozen=True, slots=True)
class Shaft:
    """A shaft in two bearings, its sections in the order of Z from `start` [m].

    The torque enters at `torque_position` [m]; None is where its coupling sits. `ultimate_thrust` [N] is that of its
    thrust bearing.
    """

    sections: tuple[ShaftSection, ...]
    bearings: tuple[Bearing, ...]
    start: float = 0.0
    torque_position: float | None = None
    youngs_modulus: float = 206e9
    poisson_ratio: float = 0.3
    density: float = 7850.0
    ultimate_thrust: float | None = None

    @property
    def end(self) -> float:
        """Position of the far end [m]."""
        return self.start + sum(section.length for section in self.sections)


@dataclass(frozen=True, slots=True)
class Alignment:
    """Heights [m] of the unit's and of the machine's shaft over their feet, and how much these warm up [K].

    `expansion` [1/K] of the supports.
    """

    unit_height: float = 0.0
    unit_rise: float = 0.0
    machine_height: float = 0.0
    machine_rise: float = 0.0
    expansion: float = 11e-6

    @property
    def growth(self) -> float:
        """How far the machine's shaft rises over the unit's as both warm up [m]."""
        return self.expansion * (self.machine_height * self.machine_rise - self.unit_height * self.unit_rise)


@dataclass(frozen=True, slots=True)
class UnitCoupling:
    """A gear coupling between a shaft of the unit and a machine.

    `position` [m] is the tooth plane of the unit's hub; the machine lies to its `machine_side` along Z. `offset` [m]
    and `slope` [rad] (X, Y) are those of the machine's hub against the unit's datum axis, cold where an `alignment` is
    given, else running. `thrust_fraction` is the part of the friction limit that acts, towards +Z if positive.
    """

    shaft: ShaftName
    position: float
    machine_side: Literal["minus", "plus"]
    coupling: Coupling
    lubricant: Lubricant = field(default_factory=Lubricant)
    friction: Friction = field(default_factory=Friction)
    model: ModelOptions = field(default_factory=ModelOptions)
    axial_tooth_stiffness: float | None = None
    offset: Vector2 = (0.0, 0.0)
    slope: Vector2 = (0.0, 0.0)
    thrust_fraction: float = 0.0
    alignment: Alignment | None = None


@dataclass(frozen=True, slots=True)
class Arrangement:
    """How the unit stands and turns.

    `hand` of the pinion's helix. `rotation` of the pinion seen against Z. `wheel_angle` is the direction from pinion to
    wheel, `gravity_angle` that of gravity, counter-clockwise from X [rad]; `gravity_factor` in units of g.
    """

    hand: Literal["right", "left"] = "right"
    rotation: Literal["counterclockwise", "clockwise"] = "counterclockwise"
    wheel_angle: float = 0.0
    gravity_angle: float = -pi / 2
    gravity_factor: float = 1.0


@dataclass(frozen=True, slots=True)
class Heat:
    """Tooth temperatures [K] without the pumping heat, and how much of the gas's rise the metal takes (0 to 1.5).

    `wall_response` None is an assumed one, 0.5, and says so. `wall_response_wheel` None is the pinion's times z1/z2: a
    wheel tooth meets the hot gas once a turn. Where the bulk temperatures include the pumping heat, only the deviation
    of the gas's rise from its mean over the face counts.
    """

    wall_response: float | None = None
    wall_response_wheel: float | None = None
    pinion_bulk: float = 363.15
    wheel_bulk: float = 353.15
    reference: float = 293.15
    bulk_includes_pumping: bool = False

    def responses(self, speed_ratio: float) -> tuple[float, float]:
        """Wall responses of pinion and wheel; `speed_ratio` is z1/z2."""
        pinion = ASSUMED_RESPONSE if self.wall_response is None else self.wall_response
        return pinion, pinion * speed_ratio if self.wall_response_wheel is None else self.wall_response_wheel


@dataclass(frozen=True, slots=True)
class Effects:
    """What is taken into account; without shafts, couplings have nothing to bend."""

    shafts: bool = True
    coupling: bool = True
    thermal: bool = True


@dataclass(frozen=True, slots=True)
class DriveTrainInputs:
    """The unit: its mesh, the gas pumped in it, shafts, couplings, heat.

    The mesh and the pumped spaces are of one pair; only the radius of the rack's tip may differ. `face_start` [m] is
    the end of the common face with the lower Z. The load factors of the mesh raise the load of its contacts only.
    A thrust collar of `collar_radius` [m] on the pinion takes the place of the pinion's thrust bearing.
    `local_bulk` adds the local pumping heat to the contact's bulk temperature, which is that of the cold unit too where
    `bulk_given`, and else there the reference temperature. The answer is of the hot unit, with
    that of the cold one beside it where `states` holds it.
    """

    mesh: ScuffingInputs
    pumping: PumpingSetup
    face_start: float
    pinion_shaft: Shaft
    wheel_shaft: Shaft
    arrangement: Arrangement = field(default_factory=Arrangement)
    couplings: tuple[UnitCoupling, ...] = ()
    collar_radius: float | None = None
    heat: Heat = field(default_factory=Heat)
    effects: Effects = field(default_factory=Effects)
    coupling_friction: CouplingFriction = "elastic_plastic"
    face_stations: int = STATIONS
    local_bulk: bool = False
    bulk_given: bool = True
    states: tuple[State, ...] = ("hot",)

    @property
    def shafts(self) -> tuple[Shaft, Shaft]:
        """The pinion's and the wheel's shaft."""
        return self.pinion_shaft, self.wheel_shaft

    @property
    def acting_couplings(self) -> tuple[UnitCoupling, ...]:
        """The couplings whose loads count."""
        return self.couplings if self.effects.shafts and self.effects.coupling else ()

    @property
    def contact_load_factor(self) -> float:
        """K_A K_v K_gamma."""
        return self.mesh.distribution.load.contact_factor
