"""One lubricated line contact: request and answer of /v1/scuffing/line-contact."""

from typing import Annotated, Any, ClassVar

from app.schema.gears import Surface
from app.schema.model import Group, Request, Response, Section
from app.schema.oil import Oil, OilDerived
from app.schema.quantities import Input, View
from solvers.contact import ehl
from solvers.contact.ehl import results
from solvers.errors import InvalidInput
from solvers.oils import lubricant_at


class LineContact(Section, of=ehl.Contact):
    """Load, curvature and speeds of the contact."""


class LineContactTemperatures(Section, of=ehl.Temperatures):
    """Temperatures of the surfaces far from the contact, and of the oil at the inlet."""


class FilmModel(Section, of=ehl.Model, without=("thermal",)):
    """Physical model of the film, and numerical resolution."""

    def unused(self) -> dict[str, bool]:
        """Mark the Eyring stress as unused if the film is Newtonian."""
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
        """Mark the temperatures of the surfaces as unused if the film is isothermal.

        Mark the kind of oil as unused if the oil is given by its viscosity.
        """
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


class LineContactDerived(OilDerived, of=results.Derived):
    """Mean speed and reduced modulus of the two surfaces, and properties of the oil at the inlet."""


class HertzContact(Group, of=results.HertzContact):
    """Half width and largest pressure of the dry contact."""

    views: ClassVar = {"max_pressure": View(limit=4000.0, bound="upper")}


class ContactNumbers(Group, of=results.Dimensionless):
    """Dimensionless numbers of the contact."""


class FilmThickness(Group, of=results.FilmThickness):
    """Film thickness of the solution, and minimum film thickness by the formula of Dowson and Higginson.

    If there is no solution, only the value by the formula is given. The other values are then null.
    """

    views: ClassVar = {"minimum": View(headline=1)}


class FilmPressure(Group, of=results.ContactPressure):
    """Pressure in the film."""


class FilmTemperature(Group, of=results.ContactTemperature):
    """Largest temperatures of the film and of both surfaces."""

    views: ClassVar = {"film_max": View(headline=2)}


class FilmFriction(Group, of=results.ContactFriction):
    """Friction in the film."""

    views: ClassVar = {"coefficient": View(headline=3)}


class FilmHeat(Group, of=results.ContactHeat):
    """Heat per length of contact. Heat that enters a surface is positive. Heat that leaves with the oil is positive."""


class ContactConvergence(Group, of=results.Convergence):
    """The end of the iteration: number of Newton steps, last changes and remaining errors."""


class MeshErrors(Group, of=results.MeshError):
    """Estimated relative errors of the results due to the numerical grid.

    If a coefficient of friction is below 0.001, its error is relative to 0.001. If a flash temperature is below 25 K,
    its error is relative to 25 K.
    """


class ContactCurves(Group, of=results.ContactCurves):
    """Curves along the contact; temperatures and heat fluxes are null if the contact is isothermal."""


class ContactField(Group, of=results.ContactField):
    """Temperature in the film, indexed [x][film fraction].

    x is the position along the flow. The film fraction is the height above surface 1 divided by the film thickness.
    """


class LineContactResponse(Response, of=results.LineContactResult):
    """Results of a lubricated line contact. If there is no solution, the values that need the solution are null."""
