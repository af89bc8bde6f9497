"""What the pumping model leaves to choose."""

from typing import Annotated

from app.requests.common import Section
from app.schema.conversion import to_si
from app.schema.quantities import Input
from solvers.pumping import inputs as si

MILIAN = "Milian 2004"


_DEFAULTS = si.PumpingModel()

AXIAL_SPEED_ONLY = (
    "the stagnation temperature counts the axial speed only; air drawn in from rest meets a tooth at the pitch-line "
    "speed U, whose recovery is worth up to U²/(2 c_p) more"
)


class PumpingOptions(Section):
    """Choices where the paper leaves room."""

    flow: Annotated[
        si.Flow,
        Input(
            "flow model",
            None,
            f"{MILIAN}, Eqs. 2-7",
            text="quasi-one-dimensional gas dynamics; the paper's chain of pockets; incompressible flow of one spur "
            "pocket",
            assumed="converges with the slices; pressures of the paper's pocket chain depend on the number of pockets",
            advanced=True,
        ),
    ] = _DEFAULTS.flow
    closure: Annotated[
        si.Closure,
        Input(
            "closure of a pocket",
            None,
            f"{MILIAN}, Eq. 1",
            text="what a pocket of the chain conserves beside mass",
            assumed="the paper's isentropic pockets lose the heat that throttling makes",
            advanced=True,
        ),
    ] = _DEFAULTS.closure
    gap: Annotated[
        si.Gap,
        Input(
            "place of the radial clearances",
            "L_1, L_2",
            f"{MILIAN}, Fig. 1",
            text="radial clearances at the flanks' narrowest sections, sealed in contact, or at the mate's tip corners",
            assumed="flanks in contact seal; with the paper's tip corners its test speeds are far from sonic",
            advanced=True,
        ),
    ] = _DEFAULTS.gap
    wall_transport: Annotated[
        bool,
        Input(
            "transport by the flanks",
            text="whether flanks that roll through the coast-side gap carry their gas along",
            assumed="follows from the flanks' motion; the paper has no such term",
            advanced=True,
        ),
    ] = _DEFAULTS.wall_transport
    slices: Annotated[
        int | None,
        Input(
            "slices",
            "N",
            MILIAN,
            text="slices or pockets over the face width",
            ge=1,
            le=1000,
            default_text="100 of gas dynamics, 10 pockets",
            assumed="the paper gives none; peak pressures of gas dynamics are within 0.1 % at 100",
            advanced=True,
        ),
    ] = _DEFAULTS.slices
    spaces: Annotated[
        si.Spaces,
        Input(
            "pumping tooth spaces",
            None,
            MILIAN,
            text="whose tooth spaces pump",
            assumed="both gears' do; the paper models the pinion's",
            advanced=True,
        ),
    ] = _DEFAULTS.spaces
    discharge_coefficient: Annotated[
        float,
        Input(
            "discharge coefficient",
            "C_d",
            text="of all openings of the chain, of the radial gaps of gas dynamics",
            ge=0,
            le=1,
            tolerance=0.05,
            assumed="ideal",
            advanced=True,
        ),
    ] = _DEFAULTS.discharge_coefficient
    minimum_gap_um: Annotated[
        float,
        Input(
            "least radial clearance",
            "L_min",
            text="least radial clearance of a side",
            ge=0,
            le=1000,
            tolerance=1,
            advanced=True,
        ),
    ] = _DEFAULTS.minimum_gap

    def pumping(self) -> si.PumpingModel:
        """The solver's options."""
        fields = to_si(self)
        return si.PumpingModel(**{name: fields[name] for name in si.PumpingModel.__dataclass_fields__})

    def unused_pumping_defaults(self, section: str) -> frozenset[str]:
        """Closure belongs to the pocket chain, wall transport to gas dynamics with contact gaps, slices to both."""
        unused = set()
        if self.flow != "pocket_chain":
            unused.add(f"{section}.closure")
        if self.flow != "gas_dynamics" or self.gap != "contact":
            unused.add(f"{section}.wall_transport")
        if self.flow == "incompressible":
            unused.add(f"{section}.slices")
        return frozenset(unused)
