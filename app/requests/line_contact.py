"""One lubricated line contact: request of /v1/scuffing/line-contact."""

from dataclasses import replace
from typing import Annotated, Any

from app.requests.oil import Oil
from app.schema.base import Request, Section
from app.schema.conversion import to_si
from app.schema.gears import Surface
from app.schema.quantities import Input
from solvers.contact import ehl
from solvers.errors import InvalidInput
from solvers.materials import Solid
from solvers.oils import lubricant_at
from solvers.sources import XUE

BULK = "360 K, the paper's bulk temperature"

_DEFAULTS = ehl.Model()


class LineContact(Section):
    """Load, curvature and speeds."""

    line_load_n_per_mm: Annotated[float, Input("line load", "w", XUE, text="load per length of contact", gt=0, le=1e5)]
    radius_mm: Annotated[
        float,
        Input("reduced radius", "R", XUE, text="reduced radius of curvature, 1/R = 1/R_1 + 1/R_2", ge=0.01, le=1e4),
    ]
    speed_1_m_per_s: Annotated[
        float,
        Input(
            "speed of surface 1",
            "u_1",
            f"{XUE}, Eq. 18",
            text="through the contact, positive into it",
            ge=-300,
            le=300,
            tolerance=0.01,
            relative_tolerance=0.01,
        ),
    ]
    speed_2_m_per_s: Annotated[
        float,
        Input(
            "speed of surface 2",
            "u_2",
            f"{XUE}, Eq. 18",
            text="through the contact, positive into it",
            ge=-300,
            le=300,
            tolerance=0.01,
            relative_tolerance=0.01,
        ),
    ]


class LineContactTemperatures(Section):
    """Temperatures far from the contact."""

    surface_1_c: Annotated[
        float, Input("bulk temperature of surface 1", "θ_M1", XUE, ge=-50, le=400, tolerance=5, assumed=BULK)
    ] = 86.85
    surface_2_c: Annotated[
        float, Input("bulk temperature of surface 2", "θ_M2", XUE, ge=-50, le=400, tolerance=5, assumed=BULK)
    ] = 86.85
    inlet_c: Annotated[
        float,
        Input(
            "inlet temperature",
            "θ_in",
            XUE,
            text="temperature of the oil at the inlet",
            ge=-50,
            le=400,
            tolerance=5,
            assumed=BULK,
        ),
    ] = 86.85


class FilmModel(Section):
    """Physics and resolution of the film."""

    rheology: Annotated[
        ehl.Rheology,
        Input(
            "rheology",
            None,
            XUE,
            text="how shear stress depends on shear rate",
            assumed="the paper's film is Newtonian, whose friction is not physical near pure rolling",
            advanced=True,
        ),
    ] = _DEFAULTS.rheology
    eyring_stress_mpa: Annotated[
        float,
        Input(
            "Eyring stress",
            "τ_0",
            ge=1,
            le=50,
            assumed="middle of the usual 3 to 12 MPa of gear oils",
            advanced=True,
        ),
    ] = 5.0
    nodes: Annotated[int, Input("nodes along the contact", "N", ge=61, le=481, advanced=True)] = _DEFAULTS.nodes
    refine_mesh: Annotated[
        bool,
        Input(
            "refine the mesh",
            text="add nodes, up to 481, until the estimated error of the mesh is below 2 %",
            advanced=True,
        ),
    ] = _DEFAULTS.refine
    film_nodes: Annotated[int, Input("nodes across the film", "N_z", ge=7, le=61, advanced=True)] = _DEFAULTS.film_nodes

    def film(self) -> ehl.Model:
        """The solver's model of a film that heats up."""
        return ehl.Model(
            rheology=self.rheology,
            eyring_stress=to_si(self)["eyring_stress"],
            nodes=self.nodes,
            film_nodes=self.film_nodes,
            refine=self.refine_mesh,
        )

    def unused_film_defaults(self, section: str) -> frozenset[str]:
        """A Newtonian film has no Eyring stress."""
        return frozenset({f"{section}.eyring_stress_mpa"} if self.rheology == "newtonian" else ())


class LineContactModel(FilmModel):
    """Physics and resolution of the contact."""

    thermal: Annotated[bool, Input("thermal film", None, XUE, text="whether the film heats up", advanced=True)] = (
        _DEFAULTS.thermal
    )


class LineContactRequest(Request):
    """One lubricated line contact."""

    contact: Annotated[LineContact, Input("contact", text="load, curvature and speeds")]
    surface_1: Annotated[Surface, Input("surface 1", text="material of surface 1")] = Surface()
    surface_2: Annotated[Surface, Input("surface 2", text="material of surface 2")] = Surface()
    lubricant: Annotated[Oil, Input("oil")] = Oil()
    temperatures: Annotated[LineContactTemperatures, Input("temperatures", text="far from the contact")] = (
        LineContactTemperatures()
    )
    model: Annotated[LineContactModel, Input("model", text="physics and resolution", advanced=True)] = (
        LineContactModel()
    )

    def options(self) -> dict[str, Any]:
        """The model section and the laws of the oil."""
        laws = self.lubricant.model_dump(include={"pressure_viscosity_law", "compressible"})
        return self.model.model_dump() | laws

    def unused_defaults(self) -> frozenset[str]:
        """What `FilmModel` leaves out; an isothermal film does not know the temperatures of the surfaces."""
        unused = self.model.unused_film_defaults("model") | self.lubricant.unused_defaults("lubricant")
        return unused if self.model.thermal else unused | {"temperatures.surface_1_c", "temperatures.surface_2_c"}

    def inputs(self) -> ehl.LineContactInputs:
        """The solver's inputs; an oil by its data sheet is what it is at the inlet.

        Raises InvalidInput no_oil without one.
        """
        temperatures, oil = ehl.Temperatures(**to_si(self.temperatures)), self.lubricant.oil()
        if oil is None:
            message = "there is no film without an oil: give iso_vg, two kinematic viscosities or viscosity_pa_s"
            raise InvalidInput("no_oil", message, "lubricant")
        return ehl.LineContactInputs(
            contact=ehl.Contact(**to_si(self.contact)),
            surface_1=self.surface_1.si(Solid),
            surface_2=self.surface_2.si(Solid),
            lubricant=lubricant_at(oil, temperatures.inlet),
            temperatures=temperatures,
            model=replace(self.model.film(), thermal=self.model.thermal),
        )
