"""Request of /v1/scuffing/line-contact."""

from typing import Annotated, Any

from app.models.sections.gears import Surface
from app.models.sections.oil import Oil
from app.schema.model import Request, Section
from app.schema.quantities import Input
from solvers.contact import ehl
from solvers.errors import InvalidInput
from solvers.oils import lubricant_at


class LineContact(Section, of=ehl.Contact):
    """Load, curvature and speeds of the contact."""


class LineContactTemperatures(Section, of=ehl.Temperatures):
    """Temperatures of the surfaces far from the contact, and of the oil at the inlet."""


class FilmModel(Section, of=ehl.Model, without=("thermal",)):
    """Physical model of the film, and numerical resolution."""

    def unused(self) -> dict[str, bool]:
        return super().unused() | {"eyring_stress_mpa": self.rheology == "newtonian"}


class LineContactModel(FilmModel, of=ehl.Model):
    """Physical model of the contact, and numerical resolution."""


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
        """Return the model options, and the chosen laws of the oil."""
        laws = self.lubricant.model_dump(include={"pressure_viscosity_law", "compressible"})
        return super().options() | laws

    def unused(self) -> dict[str, bool]:
        isothermal = dict.fromkeys(("temperatures.surface_1_c", "temperatures.surface_2_c"), not self.model.thermal)
        return isothermal | {"lubricant.kind": not self.lubricant.by_sheet}

    def inputs(self) -> ehl.LineContactInputs:
        """Return the solver's inputs.

        If a grade or data sheet describes the oil, the properties of the oil are taken at the inlet temperature. Raises
        InvalidInput `no_oil` if no oil is given.
        """
        oil = self.lubricant.resolve()
        if oil is None:
            message = "without an oil there is no film; give iso_vg, kinematic_viscosity_40 or viscosity_pa_s"
            raise InvalidInput("no_oil", message, "lubricant")
        inlet = self.temperatures.si(ehl.Temperatures).inlet
        return self.si(ehl.LineContactInputs, lubricant=lubricant_at(oil, inlet))
