"""Figures of one lubricated line contact."""

from dataclasses import replace

from app.figures.data import Axis, Figure, Hue, Line, Map, NoFigure, Panel, Role, Row, Span, values
from app.figures.declaration import Declaration, present
from app.figures.parts import curve, extreme, extreme_of_map
from app.figures.units import axis
from app.figures.wording import number, percent
from solvers.contact.ehl import LineContactInputs, LineContactResult
from solvers.contact.ehl.results import ContactCurves, ContactField

ACROSS = "position across the contact, along the flow"
THICK = 3.0  # film beyond so many central films is inlet and outlet, not contact


def contact(_: LineContactInputs, result: LineContactResult) -> Figure:
    """Pressure with Hertz, film and temperatures across the contact."""
    curves, film, half = present(result.curves), result.film, result.hertz.half_width
    x_mm, x = values(curves.x), axis(ContactCurves, "x", ACROSS, magnitude=False)
    zone = Span(-half, half, "Hertz contact")
    plain = (replace(zone, name=""),)
    central = present(film.central)
    thickness = axis(ContactCurves, "film", "film thickness", limits=(0.0, THICK * central))
    pressures = (
        Line("film", x_mm, values(curves.pressure)),
        Line("Hertz", x_mm, values(curves.hertz_pressure), Hue.GREY, Role.REFERENCE),
    )
    gap = curve(x, thickness, curves.x, curves.film, Hue.GREEN, spans=plain)
    panels = [
        Panel(x=x, y=axis(ContactCurves, "pressure", "pressure"), lines=pressures, spans=(zone,)),
        replace(gap, marks=extreme(gap.lines, thickness.unit, least=True)),
    ]
    finding = f"film {number(central, 'µm')} in the middle, {number(present(film.minimum), 'µm')} at the thinnest"
    if result.temperature is not None:
        lines = tuple(
            Line(title, x_mm, values(present(items)), hue)
            for title, items, hue in (
                ("mid film", curves.mid_film_temperature, Hue.VERMILLION),
                ("surface 1", curves.surface_1_temperature, Hue.BLUE),
                ("surface 2", curves.surface_2_temperature, Hue.SKY),
            )
        )
        panels.append(
            Panel(
                x=x,
                y=axis(ContactCurves, "mid_film_temperature", "temperature", magnitude=False, symbol="θ"),
                lines=lines,
                spans=plain,
            )
        )
        finding += f"; up to {number(result.temperature.film_max, '°C')}"
    if result.friction is not None:
        finding += f"; μ = {number(result.friction.coefficient)}"
    return Figure(finding, tuple(panels))


def film_temperature(_: LineContactInputs, result: LineContactResult) -> Figure:
    """Temperature over contact and film."""
    field = result.field
    if field is None or result.temperature is None:
        raise _isothermal()
    grid, shown = field.temperature.T, axis(ContactField, "temperature", "temperature")
    chart = Map(
        shown.title,
        shown.unit,
        values(field.x),
        values(field.film_fraction),
        grid,
        range=(float(grid.min()), float(grid.max())),
    )
    x = axis(ContactField, "x", ACROSS, magnitude=False)
    y = axis(ContactField, "film_fraction", "height in the film (0: surface 1, 1: surface 2)")
    panel = Panel(x=x, y=y, map=chart, marks=(extreme_of_map(chart),))
    surfaces = result.temperature
    finding = (
        f"film to {number(surfaces.film_max, '°C')}, surface 1 to {number(surfaces.surface_1_max, '°C')}, "
        f"surface 2 to {number(surfaces.surface_2_max, '°C')}"
    )
    return Figure(finding, (panel,))


def heat(_: LineContactInputs, result: LineContactResult) -> Figure:
    """Heat from shear and compression, and the heat that leaves by surfaces and flow."""
    books = result.heat
    if books is None:
        raise _isothermal()
    unit = "W/mm"
    source = (
        Row("shear", books.generated, Hue.VERMILLION),
        Row("compression", books.compression, Hue.ORANGE),
    )
    sink = (
        Row("into surface 1", books.to_surface_1, Hue.BLUE),
        Row("into surface 2", books.to_surface_2, Hue.SKY),
        Row("carried out by the oil", books.convected, Hue.GREEN),
    )
    ends = [0.0, *(row.value for row in (*source, *sink))]
    limits = (min(ends), max(ends)) if max(ends) > min(ends) else None
    x = Axis("heat per length of contact", unit, symbol="q", limits=limits)
    made = books.generated + books.compression
    shares = [row.value / made for row in sink[:2]] if made else [0.0, 0.0]
    taken = f"surface 1 takes {percent(shares[0])}, surface 2 {percent(shares[1])}"
    finding = f"{number(books.generated, unit)} by shear; {taken}"
    panels = (
        Panel(x=x, y=Axis("heat"), title="made", rows=source),
        Panel(x=x, y=Axis("heat"), title="gone", rows=sink),
    )
    return Figure(finding, panels)


def _isothermal() -> NoFigure:
    return NoFigure("isothermal", "An isothermal contact has no temperatures and no heat", "model.thermal")


FIGURES = (
    Declaration("contact", "Lubricated line contact", "Xue 2020, Fig. 20", contact),
    Declaration("film-temperature", "Temperature in the film", "Xue 2020, Fig. 21", film_temperature),
    Declaration("heat", "Where the heat of the contact goes", "Xue 2020, Eqs. 23, 24", heat),
)
