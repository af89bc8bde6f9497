"""Pumping: requests of /v1/pumping and /v1/pumping/choking-speed."""

from dataclasses import replace
from typing import Annotated, Any

from pydantic import Field

from app.requests.common import Request, Section
from app.requests.gears import RACK_TIP_RADIUS, Gears
from app.requests.pumping_options import AXIAL_SPEED_ONLY, MILIAN, PumpingOptions
from app.schema.conversion import to_si
from app.schema.quantities import Input
from solvers.pumping import inputs as si

_AMBIENT = si.Ambient()


class BacklashGears(Gears):
    """The gear pair with its backlash."""

    normal_backlash_mm: Annotated[
        float,
        Input(
            "normal backlash",
            "j_n",
            text="normal backlash added to what the centre distance gives, by a thinner mating tooth",
            ge=0,
            le=20,
            assumed="order of magnitude for module 7 mm; the paper gives none",
            tolerance=0.05,
        ),
    ] = 0.3


class PumpingGears(BacklashGears):
    """The gear pair."""

    rack_tip_radius: Annotated[
        float,
        replace(
            RACK_TIP_RADIUS,
            text="tip radius coefficient of the rack, at most the full radius",
            assumed="a usual ground fillet; the paper gives none",
        ),
    ] = 0.25


class GearGroove(Section):
    """A circumferential groove of full tooth depth."""

    position_mm: Annotated[
        float,
        Input(
            "groove position",
            "z_g",
            MILIAN,
            text="centre, from the end that meshes first",
            ge=0,
            le=5000,
            tolerance=0.1,
        ),
    ]
    width_mm: Annotated[float, Input("groove width", "b_g", MILIAN, ge=0.01, le=5000)]


class PumpingOperation(Section):
    """Operating point."""

    pinion_speed_rpm: Annotated[float, Input("pinion speed", "n_1", MILIAN, gt=0, le=1e5)]


class Mist(Section):
    """The air and oil mist around the mesh, a perfect gas."""

    pressure_kpa: Annotated[
        float,
        Input("ambient pressure", "p_e", MILIAN, ge=0.1, le=1e4, assumed="normal atmosphere; the paper gives none"),
    ] = 101.325
    temperature_c: Annotated[
        float,
        Input(
            "ambient temperature",
            "θ_e",
            MILIAN,
            ge=-70,
            le=400,
            tolerance=5,
            assumed="a warm gear case; the paper gives none",
        ),
    ] = 50.0
    isentropic_exponent: Annotated[
        float,
        Input(
            "isentropic exponent",
            "γ",
            MILIAN,
            text="isentropic exponent; oil droplets at the gas's temperature lower it",
            ge=1.01,
            le=2,
        ),
    ] = _AMBIENT.isentropic_exponent
    molar_mass_g_per_mol: Annotated[
        float, Input("molar mass", "M", MILIAN, ge=1, le=500, assumed="dry air; oil in the air raises it")
    ] = 28.9647


class _PumpingSetup(Request):
    """What both calculations have in common."""

    gears: Annotated[PumpingGears, Input("gear pair")]
    grooves: Annotated[
        list[GearGroove],
        Field(max_length=50),
        Input("grooves", None, f"{MILIAN}, Figs. 5, 6", text="circumferential grooves"),
    ] = Field(default_factory=list)
    ambient: Annotated[Mist, Input("ambient", text="the mist around the mesh")] = Mist()
    model: Annotated[PumpingOptions, Input("model", text="choices where the paper leaves room", advanced=True)] = (
        PumpingOptions()
    )

    def options(self) -> dict[str, Any]:
        """The model section, the number of slices filled in."""
        return self.model.model_dump() | {"slices": self.model.pumping().slice_count}

    def unused_defaults(self) -> frozenset[str]:
        """What the flow model leaves out."""
        return self.model.unused_pumping_defaults("model")

    def assumed_by_the_model(self) -> dict[str, str]:
        """A flow with temperatures knows one speed only."""
        return {} if self.model.flow == "incompressible" else {"model.flow": AXIAL_SPEED_ONLY}

    def _setup(self) -> si.PumpingSetup:
        gears = to_si(self.gears)
        return si.PumpingSetup(
            gears=self.gears.pair(gears["rack_tip_radius"]),
            normal_backlash=gears["normal_backlash"],
            grooves=tuple(si.Groove(**to_si(groove)) for groove in self.grooves),
            ambient=si.Ambient(**to_si(self.ambient)),
            model=self.model.pumping(),
        )


class PumpingRequest(_PumpingSetup):
    """A gear pair that pumps the mist around it, at one speed."""

    operation: Annotated[PumpingOperation, Input("operating point")]

    def inputs(self) -> si.PumpingInputs:
        """The solver's inputs."""
        return si.PumpingInputs(self._setup(), **to_si(self.operation))


class ChokingSpeedRequest(_PumpingSetup):
    """A gear pair whose choking speeds are sought."""

    search_limit_rpm: Annotated[
        float, Input("end of the search", "n_1,max", text="pinion speed at which the search ends", ge=100, le=1e5)
    ] = 60000.0

    def inputs(self) -> si.ChokingInputs:
        """The solver's inputs."""
        return si.ChokingInputs(self._setup(), search_limit=to_si(self)["search_limit"])
