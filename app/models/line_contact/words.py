"""What is said of the answers about a line contact: components and views."""

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
