"""Inputs of a pumping calculation."""

from enum import StrEnum
from math import pi

from solvers.gears.inputs import GearPairInputs
from solvers.quantity import quantity, record
from solvers.sources import MILIAN

MOLAR_GAS_CONSTANT = 8.314462618  # J/(mol K)
MOST_SLICES = 1000


class Flow(StrEnum):
    """Model of the flow in a tooth space."""

    GAS_DYNAMICS = "gas_dynamics"
    POCKET_CHAIN = "pocket_chain"
    INCOMPRESSIBLE = "incompressible"


class Closure(StrEnum):
    """The quantity that a pocket of the chain conserves in addition to mass."""

    ENERGY = "energy"
    ISENTROPIC = "isentropic"


class Gap(StrEnum):
    """Whether a radial gap lies at the narrowest section between the flanks, or at a tip corner of the mating gear."""

    CONTACT = "contact"
    TIP = "tip"


class Spaces(StrEnum):
    """The gears whose tooth spaces are computed."""

    BOTH = "both"
    PINION = "pinion"
    WHEEL = "wheel"


@record
class Groove:
    """A circumferential groove of full tooth depth.

    `position` is the distance from the end that meshes first to the centre of the groove [m].
    """

    position: float = quantity(
        "groove position",
        "z_g",
        MILIAN,
        unit="mm",
        ge=0,
        le=5000,
        tolerance=0.1,
        text="centre, from the end that meshes first",
    )
    width: float = quantity("groove width", "b_g", MILIAN, unit="mm", ge=0.01, le=5000)


@record
class Ambient:
    """The mist around the mesh, modelled as a perfect gas.

    The pressure is in [Pa], the temperature is in [K], and the molar mass is in [kg/mol].
    """

    pressure: float = quantity(
        "ambient pressure",
        "p_e",
        MILIAN,
        unit="kpa",
        default=101.325,
        ge=0.1,
        le=1e4,
        assumed="normal atmosphere; the paper gives none",
    )
    temperature: float = quantity(
        "ambient temperature",
        "θ_e",
        MILIAN,
        unit="c",
        default=50.0,
        ge=-70,
        le=400,
        tolerance=5,
        assumed="a warm gear case; the paper gives none",
    )
    isentropic_exponent: float = quantity(
        "isentropic exponent",
        "γ",
        MILIAN,
        default=1.4,
        ge=1.01,
        le=2,
        text="isentropic exponent; oil droplets at the gas's temperature lower it",
    )
    molar_mass: float = quantity(
        "molar mass",
        "M",
        MILIAN,
        unit="g_per_mol",
        default=28.9647,
        ge=1,
        le=500,
        assumed="dry air; oil in the air raises it",
    )


@record
class PumpingModel:
    """Options of the flow model.

    `closure` has an effect in the pocket chain only. `wall_transport` has an effect in gas dynamics with contact gaps
    only. `discharge_coefficient` applies to every opening of the pocket chain and of the incompressible model; in gas
    dynamics it applies to the radial gaps only.
    """

    flow: Flow = quantity(
        "flow model",
        None,
        f"{MILIAN}, Eqs. 2-7",
        default=Flow.GAS_DYNAMICS,
        text="quasi-one-dimensional gas dynamics; the paper's chain of pockets; incompressible flow of one spur pocket",
        assumed=(
            "gas dynamics converges with the slices; pressures of the paper's pocket chain depend "
            "on the number of pockets"
        ),
        advanced=True,
    )
    closure: Closure = quantity(
        "closure of a pocket",
        None,
        f"{MILIAN}, Eq. 1",
        default=Closure.ENERGY,
        text="what a pocket of the chain conserves beside mass",
        assumed="the paper's isentropic pockets lose the heat that throttling makes",
        advanced=True,
    )
    gap: Gap = quantity(
        "place of the radial clearances",
        "L_1, L_2",
        f"{MILIAN}, Fig. 1",
        default=Gap.CONTACT,
        text=(
            "at the narrowest section between the flanks, sealed in contact, or at the tip corners of the mating gear"
        ),
        assumed="flanks in contact seal; with the paper's tip corners the flow at its test speeds is far from sonic",
        advanced=True,
    )
    wall_transport: bool = quantity(
        "transport by the flanks",
        default=True,
        text="whether flanks that roll through the coast-side gap carry their gas along",
        assumed="follows from the motion of the flanks; the paper leaves it out",
        advanced=True,
    )
    slices: int | None = quantity(
        "slices",
        "N",
        MILIAN,
        default=None,
        ge=1,
        le=MOST_SLICES,
        text="slices or pockets over the face width",
        default_text="100 slices of gas dynamics, 10 pockets of the chain",
        assumed="the paper gives none; peak pressures of gas dynamics are within 0.1 % at 100",
        advanced=True,
    )
    spaces: Spaces = quantity(
        "pumping tooth spaces",
        None,
        MILIAN,
        default=Spaces.BOTH,
        text="whose tooth spaces pump",
        assumed="both gears' do; the paper models the pinion's",
        advanced=True,
    )
    discharge_coefficient: float = quantity(
        "discharge coefficient",
        "C_d",
        default=1.0,
        ge=0,
        le=1,
        tolerance=0.05,
        text="applies to all openings of the pocket chain, and to the radial gaps of gas dynamics",
        assumed="ideal",
        advanced=True,
    )
    minimum_gap: float = quantity(
        "least radial clearance",
        "L_min",
        unit="um",
        default=0.0,
        ge=0,
        le=1000,
        tolerance=1,
        text="least radial clearance of a side",
        advanced=True,
    )

    @property
    def slice_count(self) -> int:
        """Number of slices over the face width: `slices`, or the default of the flow model if `slices` is None."""
        if self.slices is not None:
            return self.slices
        return {Flow.GAS_DYNAMICS: 100, Flow.POCKET_CHAIN: 10, Flow.INCOMPRESSIBLE: 1}[self.flow]


@record
class PumpingSetup:
    """All inputs except the speed.

    `normal_backlash` [m] is added to the backlash that results from the centre distance.
    """

    gears: GearPairInputs = quantity("gear pair")
    normal_backlash: float = quantity(
        "normal backlash",
        "j_n",
        unit="mm",
        default=0.3,
        ge=0,
        le=20,
        tolerance=0.05,
        text="normal backlash added to what the centre distance gives, by a thinner mating tooth",
        assumed="order of magnitude for module 7 mm; the paper gives none",
    )
    grooves: tuple[Groove, ...] = quantity(
        "grooves",
        None,
        f"{MILIAN}, Figs. 5, 6",
        default=(),
        length=(0, 50),
        text="circumferential grooves, in each helix",
    )
    ambient: Ambient = quantity("ambient", default_factory=Ambient, text="the mist around the mesh")
    model: PumpingModel = quantity(
        "model", default_factory=PumpingModel, text="options where the paper leaves the model open", advanced=True
    )


@record
class PumpingInputs:
    """The inputs at one operating point; `pinion_speed` is in [rad/s]."""

    setup: PumpingSetup
    pinion_speed: float = quantity("pinion speed", "n_1", MILIAN, unit="rpm", gt=0, le=1e5)


@record
class ChokingInputs:
    """A search for the pinion speeds at which the flow chokes; the search ends at the speed `search_limit` [rad/s]."""

    setup: PumpingSetup
    search_limit: float = quantity(
        "end of the search",
        "n_1,max",
        unit="rpm",
        default=6e4,
        ge=100,
        le=1e5,
        text="pinion speed at which the search ends",
    )


def rpm(speed: float) -> float:
    """Convert an angular speed [rad/s] to revolutions per minute."""
    return speed * 30 / pi
