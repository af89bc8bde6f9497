"""Pumping: requests of /v1/pumping and /v1/pumping/choking-speed."""

from typing import Annotated, Any, Literal, Self

from pydantic import Field

from app.conversion import to_si
from app.quantities import Input
from app.requests.common import Request, Section
from app.requests.gears import Gears
from solvers.pumping import inputs as si

MILIAN = "Milian 2004"


class PumpingGears(Gears):
    """The gear pair."""

    rack_tip_radius: Annotated[
        float,
        Input(
            "tip radius coefficient of the rack, at most the full radius",
            "ρ_fP*",
            "ISO 53",
            ge=0,
            le=0.6,
            assumed="a usual ground fillet; the paper gives none",
        ),
    ] = 0.25
    normal_backlash_mm: Annotated[
        float,
        Input(
            "normal backlash added to what the centre distance gives, by a thinner mating tooth",
            "j_n",
            ge=0,
            le=20,
            assumed="order of magnitude for module 7 mm; the paper gives none",
        ),
    ] = 0.3


class GearGroove(Section):
    """A circumferential groove of full tooth depth."""

    position_mm: Annotated[float, Input("centre, from the end that meshes first", "z", MILIAN, ge=0, le=5000)]
    width_mm: Annotated[float, Input("width", None, MILIAN, ge=0.01, le=5000)]


class PumpingOperation(Section):
    """Operating point."""

    pinion_speed_rpm: Annotated[float, Input("pinion speed", "n_1", MILIAN, gt=0, le=1e5)]


class Mist(Section):
    """The air and oil mist around the mesh, a perfect gas."""

    pressure_kpa: Annotated[
        float, Input("pressure", "P_e", MILIAN, ge=0.1, le=1e4, assumed="normal atmosphere; the paper gives none")
    ] = 101.325
    temperature_c: Annotated[
        float, Input("temperature", "T_e", MILIAN, ge=-70, le=400, assumed="a warm gear case; the paper gives none")
    ] = 50.0
    isentropic_exponent: Annotated[
        float, Input("isentropic exponent; oil droplets at the gas's temperature lower it", "γ", MILIAN, ge=1.01, le=2)
    ] = 1.4
    molar_mass_g_per_mol: Annotated[
        float, Input("molar mass", "M", MILIAN, ge=1, le=500, assumed="dry air; oil in the air raises it")
    ] = 28.9647


class PumpingOptions(Section):
    """Choices where the paper leaves room."""

    flow: Annotated[
        Literal["gas_dynamics", "pocket_chain", "incompressible"],
        Input(
            "quasi-one-dimensional gas dynamics; the paper's chain of pockets; incompressible flow of one spur pocket",
            None,
            f"{MILIAN}, Eqs. 2-7",
            assumed="converges with the slices; pressures of the paper's pocket chain depend on the number of pockets",
        ),
    ] = "gas_dynamics"
    closure: Annotated[
        Literal["energy", "isentropic"],
        Input(
            "what a pocket of the chain conserves beside mass",
            None,
            f"{MILIAN}, Eq. 1",
            assumed="the paper's isentropic pockets lose the heat that throttling makes",
        ),
    ] = "energy"
    gap: Annotated[
        Literal["contact", "tip"],
        Input(
            "radial clearances at the flanks' narrowest sections, sealed in contact, or at the mate's tip corners",
            "L_1, L_2",
            f"{MILIAN}, Fig. 1",
            assumed="flanks in contact seal; with the paper's tip corners its test speeds are far from sonic",
        ),
    ] = "contact"
    wall_transport: Annotated[
        bool,
        Input(
            "whether flanks that roll through the coast-side gap carry their gas along",
            assumed="follows from the flanks' motion; the paper has no such term",
        ),
    ] = True
    slices: Annotated[
        int | None,
        Input(
            "slices or pockets over the face width; null: 100 of gas dynamics, 10 pockets",
            "N",
            MILIAN,
            ge=1,
            le=1000,
            assumed="the paper gives none; peak pressures of gas dynamics are within 0.1 % at 100",
        ),
    ] = None
    spaces: Annotated[
        Literal["both", "pinion", "wheel"],
        Input("whose tooth spaces pump", None, MILIAN, assumed="both gears' do; the paper models the pinion's"),
    ] = "both"
    discharge_coefficient: Annotated[
        float,
        Input("of all openings of the chain, of the radial gaps of gas dynamics", "C_d", ge=0, le=1, assumed="ideal"),
    ] = 1.0
    minimum_gap_um: Annotated[float, Input("least radial clearance of a side", "L_min", ge=0, le=1000)] = 0.0


class _PumpingSetup(Request):
    """What both calculations have in common."""

    gears: Annotated[PumpingGears, Input("the gear pair")]
    grooves: Annotated[
        list[GearGroove], Field(max_length=50), Input("circumferential grooves", None, f"{MILIAN}, Figs. 5, 6")
    ] = Field(default_factory=list)
    ambient: Annotated[Mist, Input("the mist around the mesh")] = Mist()
    model: Annotated[PumpingOptions, Input("choices where the paper leaves room")] = PumpingOptions()

    def resolved(self) -> Self:
        """The number of slices follows from the flow model."""
        return self.model_copy(update={"model": self.model.model_copy(update={"slices": self._options().slice_count})})

    def options(self) -> dict[str, Any]:
        """The model section, the number of slices filled in."""
        return self.model.model_dump()

    def unused_defaults(self) -> frozenset[str]:
        """Closure belongs to the pocket chain, wall transport to gas dynamics with contact gaps, slices to both."""
        flow, unused = self.model.flow, set()
        if flow != "pocket_chain":
            unused.add("model.closure")
        if flow != "gas_dynamics" or self.model.gap != "contact":
            unused.add("model.wall_transport")
        if flow == "incompressible":
            unused.add("model.slices")
        return frozenset(unused)

    def _options(self) -> si.PumpingModel:
        options = to_si(self.model)
        kinds = {"flow": si.Flow, "closure": si.Closure, "gap": si.Gap, "spaces": si.Spaces}
        return si.PumpingModel(**options | {name: kind(options[name]) for name, kind in kinds.items()})

    def _setup(self) -> si.PumpingSetup:
        gears = to_si(self.gears)
        return si.PumpingSetup(
            gears=self.gears.pair(gears["rack_tip_radius"]),
            normal_backlash=gears["normal_backlash"],
            grooves=tuple(si.Groove(**to_si(groove)) for groove in self.grooves),
            ambient=si.Ambient(**to_si(self.ambient)),
            model=self._options(),
        )


class PumpingRequest(_PumpingSetup):
    """A gear pair that pumps the mist around it, at one speed."""

    operation: Annotated[PumpingOperation, Input("operating point")]

    def inputs(self) -> si.PumpingInputs:
        """The solver's inputs."""
        return si.PumpingInputs(self._setup(), **to_si(self.operation))


class ChokingSpeedRequest(_PumpingSetup):
    """A gear pair whose choking speeds are sought."""

    search_limit_rpm: Annotated[float, Input("pinion speed at which the search ends", ge=100, le=1e5)] = 60000.0

    def inputs(self) -> si.ChokingInputs:
        """The solver's inputs."""
        return si.ChokingInputs(self._setup(), search_limit=to_si(self)["search_limit"])
