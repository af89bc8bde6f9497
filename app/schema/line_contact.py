"""One lubricated line contact: request and answer of /v1/scuffing/line-contact."""

from typing import ClassVar

from app.responses.oil import OilDerived
from app.schema.base import Group, Response
from app.schema.quantities import View
from solvers.contact.ehl import results


class LineContactDerived(OilDerived, of=results.Derived):
    """What load, curvature and speeds make of the two surfaces, and the oil at the inlet."""


class HertzContact(Group, of=results.HertzContact):
    """The dry contact."""

    views: ClassVar = {"max_pressure": View(limit=4000.0, bound="upper")}


class ContactNumbers(Group, of=results.Dimensionless):
    """Dimensionless numbers."""


class FilmThickness(Group, of=results.FilmThickness):
    """Film thickness; null without a solution, but for the formula."""

    views: ClassVar = {"minimum": View(headline=1)}


class FilmPressure(Group, of=results.ContactPressure):
    """Pressure in the film."""


class FilmTemperature(Group, of=results.ContactTemperature):
    """Temperatures."""

    views: ClassVar = {"film_max": View(headline=2)}


class FilmFriction(Group, of=results.ContactFriction):
    """Friction."""

    views: ClassVar = {"coefficient": View(headline=3)}


class FilmHeat(Group, of=results.ContactHeat):
    """Heat per length of contact; into the surfaces and convected out positive."""


class ContactConvergence(Group, of=results.Convergence):
    """How the iteration ended."""


class MeshErrors(Group, of=results.MeshError):
    """Estimated error that the mesh leaves, relative; small friction and flash temperatures over 0.001 and 25 K."""


class ContactCurves(Group, of=results.ContactCurves):
    """Along the contact; temperatures are null if isothermal."""


class ContactField(Group, of=results.ContactField):
    """Temperature in the film, indexed [x][film fraction]."""


class LineContactResponse(Response, of=results.LineContactResult):
    """A lubricated line contact; what was not solved is null."""
