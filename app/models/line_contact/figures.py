"""Figures of one lubricated line contact."""

from dataclasses import replace

from app.figures import parts
from app.figures.data import Axis, Figure, Hue, Line, Map, NoFigure, Panel, Role, Row, Span
from app.figures.declaration import Declaration, present
from app.figures.units import axis
from app.figures.wording import number, percent
from solvers.contact.ehl import LineContactInputs, LineContactResult

ACROSS = "position across the contact, along the flow"
MEANT = 1.0  # chosen; a larger coefficient of friction has no meaning: even dry steel has at most about 1
THICK = 3.0  # upper end of the film axis divided by the central film thickness; thicker films are in inlet and outlet


def contact(_: LineContactInputs, result: LineContactResult) -> Figure:
    """Draw pressure, Hertzian pressure, film and temperatures across the contact."""
    curves, film, half = present(result.curves), result.film, result.hertz.half_width
    central, zone = present(film.central), [Span(-half, half, "Hertz contact")]
    plain = parts.unnamed(zone)
    x = axis(curves, "x", ACROSS, magnitude=False)
    thickness = axis(curves, "film", "film thickness", limits=(0.0, THICK * central))
    pressures = [
        Line("film", curves.x, curves.pressure),
        Line("Hertz", curves.x, curves.hertz_pressure, Hue.GREY, Role.REFERENCE),
    ]
    gap = parts.curve(x, thickness, curves.x, curves.film, Hue.GREEN, spans=plain)
    panels = [
        Panel(x=x, y=axis(curves, "pressure", "pressure"), lines=pressures, spans=zone),
        replace(gap, marks=parts.extreme(gap.lines, thickness.unit, least=True)),
    ]
    finding = f"film {number(central, 'µm')} in the middle, {number(present(film.minimum), 'µm')} at the thinnest"
    if result.temperature is not None:
        y = axis(curves, "mid_film_temperature", "temperature", magnitude=False, symbol="θ")
        lines = [
            Line("mid film", curves.x, present(curves.mid_film_temperature), Hue.VERMILLION),
            Line("surface 1", curves.x, present(curves.surface_1_temperature), Hue.BLUE),
            Line("surface 2", curves.x, present(curves.surface_2_temperature), Hue.SKY),
        ]
        panels.append(Panel(x=x, y=y, lines=lines, spans=plain))
        finding += f"; up to {number(result.temperature.film_max, '°C')}"
    if result.friction is not None:
        coefficient = result.friction.coefficient
        reason = "" if result.temperature is not None else " without heating and without a limit of the shear stress"
        finding += f"; μ = {number(coefficient)}" if coefficient <= MEANT else f"; μ has no meaning{reason}"
    return Figure(finding, panels)


def film_temperature(_: LineContactInputs, result: LineContactResult) -> Figure:
    """Draw a map of the film's temperature over two coordinates: position along the flow, and height in the film."""
    field, surfaces = result.field, result.temperature
    if field is None or surfaces is None:
        raise _isothermal()
    grid, shown = field.temperature.T, axis(field, "temperature", "temperature")
    ends = float(grid.min()), float(grid.max())
    chart = Map(shown.title, shown.unit, field.x, field.film_fraction, grid, range=ends)
    x = axis(field, "x", ACROSS, magnitude=False)
    y = axis(field, "film_fraction", "height in the film (0: surface 1, 1: surface 2)")
    finding = (
        f"film to {number(surfaces.film_max, '°C')}, surface 1 to {number(surfaces.surface_1_max, '°C')}, "
        f"surface 2 to {number(surfaces.surface_2_max, '°C')}"
    )
    return Figure(finding, [Panel(x=x, y=y, map=chart, marks=[parts.extreme_of_map(chart)])])


def heat(_: LineContactInputs, result: LineContactResult) -> Figure:
    """Draw the heat from shear and compression, and the heat that leaves through the surfaces and with the oil."""
    books = result.heat
    if books is None:
        raise _isothermal()
    made = [
        Row("shear", books.generated, Hue.VERMILLION),
        Row("compression", books.compression, Hue.ORANGE),
    ]
    gone = [
        Row("into surface 1", books.to_surface_1, Hue.BLUE),
        Row("into surface 2", books.to_surface_2, Hue.SKY),
        Row("carried out by the oil", books.convected, Hue.GREEN),
    ]
    ends = [0.0, *(row.value for row in (*made, *gone))]
    limits = (min(ends), max(ends)) if max(ends) > min(ends) else None
    x = Axis("heat per length of contact", "W/mm", symbol="q", limits=limits)
    whole = books.generated + books.compression
    shares = [percent(row.value / whole if whole else 0.0) for row in gone[:2]]
    finding = f"{number(books.generated, 'W/mm')} by shear; surface 1 takes {shares[0]}, surface 2 {shares[1]}"
    panels = [Panel(x=x, y=Axis("heat"), title=title, rows=rows) for title, rows in (("made", made), ("gone", gone))]
    return Figure(finding, panels)


def _isothermal() -> NoFigure:
    return NoFigure("isothermal", "An isothermal contact has no temperatures and no heat", "model.thermal")


FIGURES = (
    Declaration("contact", "Lubricated line contact", "Xue 2020, Fig. 20", contact),
    Declaration("film-temperature", "Temperature in the film", "Xue 2020, Fig. 21", film_temperature),
    Declaration("heat", "Where the heat of the contact goes", "Xue 2020, Eqs. 23, 24", heat),
)
