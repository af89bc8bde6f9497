"""What is said of the answers about a line contact: components, views and verdict."""

from typing import Any

from app.figures.wording import number
from app.models.card import Verdict, Words
from app.schema.answers import Response, component, group, named
from app.schema.quantities import View
from solvers.contact.ehl import results

named(
    ContactNumbers=results.Dimensionless,
    FilmPressure=results.ContactPressure,
    FilmHeat=results.ContactHeat,
    ContactConvergence=results.Convergence,
    MeshErrors=results.MeshError,
    LineContactDerived=results.Derived,
)
component(results.HertzContact, max_pressure=View(limit=4000.0, bound="upper"))
component(results.FilmThickness, minimum=View(headline=1))
component(results.ContactTemperature, "FilmTemperature", film_max=View(headline=2))
component(results.ContactFriction, "FilmFriction", coefficient=View(headline=3))

LINE_CONTACT = group(results.LineContactResult, "LineContactResponse", base=Response)


def verdict(response: Any) -> Verdict:
    """Say how thick the film is, how hot it becomes, and its friction."""
    friction = f"coefficient of friction {number(response.friction.coefficient)}"
    if response.film.minimum_um is None:
        return Verdict("plain", f"No film is stated; {friction}.")
    hot = "" if response.temperature is None else f", oil up to {number(response.temperature.film_max_c, '°C')}"
    return Verdict("plain", f"Film of {number(response.film.minimum_um, 'µm')} at the thinnest{hot}; {friction}.")


_FILM, _HOT, _FRICTION = "film.minimum_um", "temperature.film_max_c", "friction.coefficient"
WORDS = Words(verdict=verdict, touches={"low_peclet": (_HOT,), "high_traction": (_HOT, _FRICTION)})
