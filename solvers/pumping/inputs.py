"""What describes a pumping calculation."""

from dataclasses import dataclass, field
from enum import StrEnum
from math import pi

from solvers.gears.inputs import GearPairInputs

MOLAR_GAS_CONSTANT = 8.314462618  # J/(mol K)


class Flow(StrEnum):
    """How the gas in a tooth space moves."""

    GAS_DYNAMICS = "gas_dynamics"
    POCKET_CHAIN = "pocket_chain"
    INCOMPRESSIBLE = "incompressible"


class Closure(StrEnum):
    """What a pocket of the chain conserves beside mass."""

    ENERGY = "energy"
    ISENTROPIC = "isentropic"


class Gap(StrEnum):
    """Where the radial clearances are taken: at the flanks' narrowest sections, or at the mate's tip corners."""

    CONTACT = "contact"
    TIP = "tip"


class Spaces(StrEnum):
    """Whose tooth spaces are computed."""

    BOTH = "both"
    PINION = "pinion"
    WHEEL = "wheel"


@dataclass(frozen=True, slots=True)
class Groove:
    """A circumferential groove of full tooth depth; centre `position` from the end that meshes first, `width` [m]."""

    position: float
    width: float


@dataclass(frozen=True, slots=True)
class Ambient:
    """The mist around the mesh, a perfect gas; pressure [Pa], temperature [K], molar mass [kg/mol]."""

    pressure: float = 101325.0
    temperature: float = 323.15
    isentropic_exponent: float = 1.4
    molar_mass: float = 0.0289647


@dataclass(frozen=True, slots=True)
class PumpingModel:
    """The options in force.

    `slices` None is the flow model's own number; `closure` belongs to the pocket chain, `wall_transport` to gas
    dynamics with contact gaps; `discharge_coefficient` acts on every opening of the pocket chain and of the
    incompressible model and on the radial gaps of gas dynamics; `minimum_gap` [m] is the least radial clearance of a
    side.
    """

    flow: Flow = Flow.GAS_DYNAMICS
    closure: Closure = Closure.ENERGY
    gap: Gap = Gap.CONTACT
    wall_transport: bool = True
    slices: int | None = None
    spaces: Spaces = Spaces.BOTH
    discharge_coefficient: float = 1.0
    minimum_gap: float = 0.0

    @property
    def slice_count(self) -> int:
        """Slices over the face width: as asked for, else the flow model's own number."""
        if self.slices is not None:
            return self.slices
        return {Flow.GAS_DYNAMICS: 100, Flow.POCKET_CHAIN: 10, Flow.INCOMPRESSIBLE: 1}[self.flow]


@dataclass(frozen=True, slots=True)
class PumpingSetup:
    """All but the speed; `normal_backlash` [m] is added to what the centre distance gives."""

    gears: GearPairInputs
    normal_backlash: float = 0.3e-3
    grooves: tuple[Groove, ...] = ()
    ambient: Ambient = field(default_factory=Ambient)
    model: PumpingModel = field(default_factory=PumpingModel)


@dataclass(frozen=True, slots=True)
class PumpingInputs:
    """One operating point; `pinion_speed` [rad/s]."""

    setup: PumpingSetup
    pinion_speed: float


@dataclass(frozen=True, slots=True)
class ChokingInputs:
    """A search for the speeds that choke the flow, up to `search_limit` [rad/s] of the pinion."""

    setup: PumpingSetup
    search_limit: float


def rpm(speed: float) -> float:
    """Revolutions per minute of an angular speed [rad/s]."""
    return speed * 30 / pi
