"""Figures of the check against scuffing, over the flank and along the evaluated lines.

The evaluated lines are the feature line and, if calculated, the profile through the highest flash temperature. The
feature line is the diagonal of the flank from the corner where the mesh begins to the corner where the mesh ends.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import groupby

import numpy as np

from app.figures import parts
from app.figures.data import FARTHEST_LEVEL, Axis, Figure, Hue, Level, Line, NoFigure, Panel, Role, Span, Values, values
from app.figures.declaration import Build, Declaration, present
from app.figures.units import MM, UM, axis
from app.figures.wording import number
from app.models.load_distribution import figures as load_distribution
from app.models.load_distribution.figures import PATH, path_points
from app.models.scuffing import heat_balance_figures as heat_balance
from app.models.scuffing import micropitting_figures as micropitting
from solvers.drive_train.results import FlankMaps
from solvers.quantity import UNITS
from solvers.scuffing.inputs import ScuffingInputs
from solvers.scuffing.results import Flank
from solvers.scuffing.safety_results import Safety, Scuffing, ScuffingPath, ThermalPath

UNSOLVED = {"no_solution", "refused"}
WARNED = "outside validity"
ROOM = 0.06  # share of the range; room above and below the lines of panels with a common scale
SHOWN_SAFETIES = 4.0  # end of the axis divided by the least factor; greater factors, near the pitch point, are cut off


def temperature_on_flank(inputs: ScuffingInputs, result: Scuffing) -> Figure:
    """Draw Blok's contact temperature over the flank, and the evaluated lines.

    With solutions by thermal EHL, the profile is the one that these solutions call the hottest. It may lie beside the
    hottest place by Blok's formula.
    """
    flank, width = result.flank, inputs.distribution.gears.face_width
    contact, largest = result.contact_temperature, result.flash.blok_max
    shown = axis(flank, "flash_temperature", "flash temperature")
    grid, limit = flank.flash_temperature, None
    if contact is not None:
        grid, limit = contact.bulk + grid, result.safety.scuffing if result.safety is not None else None
        shown = axis(contact, "blok_max", "contact temperature")
    panel = heat_over_flank(width, flank, shown, grid, limit, result.flash.friction_coefficient)
    lines = [Line("feature line", values([0.0, width / MM]), values([0.0, 1.0]), Hue.SKY)]
    if (face := hottest_face(result)) is not None:
        across = values([face] * 2)
        solved = "" if result.flash.thermal_ehl_at_face is None else " by thermal EHL"
        lines.append(Line(f"hottest profile{solved}", across, values([0.0, 1.0]), Hue.SKY, Role.REFERENCE))
    if not largest:
        return Figure("no flash temperature", [replace(panel, lines=lines)])
    finding = f"{number(largest, 'K')} above the bulk"
    if contact is not None and contact.blok_max is not None:
        by = "" if result.flash.thermal_ehl_at_face is None else " by Blok (marked)"
        finding = f"up to {number(contact.blok_max, '°C', digits=4)}{by}, {finding}"
    on_line = result.flash.feature_line_max
    if on_line is not None and on_line < largest:
        finding = f"{finding}; {number(on_line, 'K')} on the feature line"
    return Figure(finding, [replace(panel, lines=lines)])


def heat_over_flank(
    width: float, flank: Flank | FlankMaps, shown: Axis, grid: Values, limit: float | None, friction: float | None
) -> Panel:
    """Return a map of a temperature over the flank; `width` is the face width [m]."""
    if friction is None:
        message = (
            "Give an oil or a coefficient of friction; without one, the flash temperature of the flank is not known"
        )
        raise NoFigure("no_friction", message, "friction_coefficient")
    if not np.isfinite(grid).all():
        message = (
            "The loaded path of contact reaches a base circle; the flash temperature is not defined at a base circle"
        )
        raise NoFigure("no_temperature", message, "gears")
    low, high = float(grid.min()), float(grid.max())
    panel = load_distribution.over_flank(width, flank, shown, grid, high if high > low else None, None)
    assert panel.map is not None
    critical = [Level(limit, "scuffing")] if limit is not None and low < limit < high else []
    return replace(panel, map=replace(panel.map, critical=critical, range=(low, high if high > low else low + 1.0)))


def contact_temperature(inputs: ScuffingInputs, result: Scuffing) -> Figure:
    """Draw the contact temperature of both flanks by thermal EHL and by Blok, with the scuffing temperature."""
    _with_oil(result)
    contact, safety = present(result.contact_temperature), result.safety
    y = Axis("contact temperature, bulk and flash", "°C", magnitude=False, symbol="θ_B")
    levels = [Level(contact.bulk, f"bulk {number(contact.bulk, '°C', digits=4)}")]
    finding = "" if contact.blok_max is None else f"up to {number(contact.blok_max, '°C')} by Blok"
    if contact.thermal_ehl_max is not None:
        finding = f"up to {number(contact.thermal_ehl_max, '°C')} by thermal EHL"
    if safety is not None:
        levels.append(Level(safety.scuffing, f"scuffing temperature {number(safety.scuffing, '°C')}", limit=True))
        factors = {"thermal EHL": safety.thermal_ehl_factor, "Blok": safety.blok_factor}
        texts = [f"{number(factor)} by {method}" for method, factor in factors.items() if factor is not None]
        finding = f"safety factor {', '.join(texts)}" if texts else finding

    def panel(path: ScuffingPath) -> Panel:
        lines = [replace(line, y=_bulk_of(result, line.title) + line.y) for line in _flashes(path)]
        methods = {"EHL": lines[:-1], "Blok": lines[-1:]} if len(lines) > 1 else {"": lines}
        marks = [
            replace(mark, text=f"{method} {mark.text}".strip())
            for method, own in methods.items()
            for mark in parts.extreme(own, y.unit)
        ]
        return Panel(x=PATH, y=y, lines=lines, levels=levels, marks=marks)

    return _along(inputs, result, finding, panel)


def _bulk_of(result: Scuffing, surface: str) -> float:
    """Return the bulk temperature [°C] of a surface."""
    if result.heat is not None and surface in {"pinion", "wheel"}:
        return result.heat.pinion.flank if surface == "pinion" else result.heat.wheel.flank
    return present(result.contact_temperature).bulk


def _flashes(path: ScuffingPath) -> list[Line]:
    """Return lines that show the flash temperatures along a path."""
    lines = list[Line]()
    if path.thermal is not None:
        lines.append(Line("pinion", path.psi, path.thermal.pinion_flash, Hue.BLUE))
        lines.append(Line("wheel", path.psi, path.thermal.wheel_flash, Hue.VERMILLION))
    hue, role = (Hue.GREY, Role.REFERENCE) if lines else (Hue.BLUE, Role.RESULT)
    return [*lines, Line("Blok", path.psi, path.blok_flash, hue, role)]


def hottest_face(result: Scuffing) -> float | None:
    """Return the face position [mm] of the profile line through the hottest place; None if there is no such line."""
    if result.hottest_path is None:
        return None
    flash = result.flash
    return flash.blok_at_face if flash.thermal_ehl_at_face is None else flash.thermal_ehl_at_face


def _paths(result: Scuffing) -> dict[str, ScuffingPath]:
    """Return the evaluated lines of the flank. The keys are the names of the lines."""
    if result.hottest_path is None:
        return {"feature line": result.path}
    across = number(present(hottest_face(result)), "mm")
    return {"feature line": result.path, f"profile at y = {across}": result.hottest_path}


def _along(inputs: ScuffingInputs, result: Scuffing, finding: str, panel: Callable[[ScuffingPath], Panel]) -> Figure:
    """Return a figure with a panel for each evaluated line. The panels have the same ordinate."""
    points, panels = _points(inputs, result), list[Panel]()
    for path in _paths(result).values():
        line_panel = panel(path)
        levels = [*line_panel.levels, *points]
        shown = parts.unnamed(levels) if panels else levels
        panels.append(replace(line_panel, levels=shown, spans=_warned(path)))
    if len(panels) > 1:
        limits = _common_limits(panels)
        panels = [
            replace(line_panel, y=replace(line_panel.y, limits=limits), title=f"along the {name}")
            for name, line_panel in zip(_paths(result), panels, strict=True)
        ]
    return Figure(finding, panels, unsolved=_unsolved(result))


def _common_limits(panels: Sequence[Panel]) -> tuple[float, float]:
    """Return the limits of the ordinate that all panels share."""
    axes = panels[0].y
    if axes.limits is not None:
        return axes.limits
    shown = np.concatenate([line.y[np.isfinite(line.y)] for panel in panels for line in panel.lines])
    low, high = float(shown.min()), float(shown.max())
    reach = FARTHEST_LEVEL * (high - low)
    levels = [level.value for panel in panels for level in panel.levels if not level.vertical]
    near = [value for value in levels if low - reach <= value <= high + reach]
    low, high = min([low, *near]), max([high, *near])
    room = ROOM * (high - low)
    return (0.0 if axes.magnitude else low - room), high + room


def _with_oil(result: Scuffing) -> None:
    """Raise NoFigure if the case lacks an oil or the temperature of the oil."""
    if result.path is not None and result.contact_temperature is None:
        message = "Without an oil and a bulk temperature, film and contact temperature cannot be computed"
        raise NoFigure("no_oil", message, "lubricant")


def safety_along(inputs: ScuffingInputs, result: Scuffing) -> Figure:
    """Draw the safety factor at the points of the evaluated lines (Eq. 26)."""
    _with_oil(result)
    if result.safety is None:
        raise NoFigure(
            "no_scuffing_temperature", "Without a scuffing temperature no safety can be computed", "temperatures"
        )
    oil = inputs.temperatures.oil - UNITS["c"].offset
    reserve = result.safety.scuffing - oil
    safeties = {name: _safeties(result, path, oil, reserve) for name, path in _paths(result).items()}
    lines = [line for along in safeties.values() for line in along]
    if not lines:
        raise NoFigure(
            "no_rise", "No point of the contact is hotter than the oil, so no safety is defined", "temperatures"
        )
    least = parts.extreme(lines, least=True)[0]
    top = max(1.5, min(SHOWN_SAFETIES * least.y, *(1.1 * float(np.nanmax(line.y)) for line in lines)))
    name, method = next(
        (name, line.title) for name, along in safeties.items() for line in along if np.nanmin(line.y) == least.y
    )
    y = axis(Safety, "blok_factor", "safety factor against scuffing", limits=(0.0, top))
    limit = Level(1.0, "scuffing below 1", limit=True)

    def panel(path: ScuffingPath) -> Panel:
        own = _safeties(result, path, oil, reserve)
        return Panel(x=PATH, y=y, lines=own, levels=[limit], marks=parts.extreme(own, least=True))

    place = f"Ψ = {number(least.x)}" if name == "feature line" else f"{number(least.x)} of the {name}"
    return _along(inputs, result, f"least {number(least.y)} by {method}, at {place}", panel)


def _safeties(result: Scuffing, path: ScuffingPath, oil: float, reserve: float) -> list[Line]:
    """Return lines that show the safety factors along a path, by thermal EHL and by Blok's formula.

    The safety factor is NaN at points where the contact is not hotter than the oil.
    """
    *flanks, blok = (replace(line, y=_bulk_of(result, line.title) + line.y) for line in _flashes(path))
    contacts = [replace(blok, role=Role.RESULT)]
    if flanks:
        hotter = np.fmax(*(line.y for line in flanks))
        contacts.insert(0, Line("thermal EHL", blok.x, hotter, Hue.VERMILLION))
    rises = [(line, np.where(line.y > oil, line.y - oil, np.nan)) for line in contacts]
    return [replace(line, y=reserve / rise) for line, rise in rises if np.isfinite(rise).any()]


def film(inputs: ScuffingInputs, result: Scuffing) -> Figure:
    """Draw the film thickness along the evaluated lines. A level marks the film thickness that equals the roughness."""
    _with_oil(result)
    thinnest, pair = present(result.film), inputs.distribution
    if thinnest.thickness_ratio is None:
        finding = "no film is known everywhere" if _unsolved(result) else "no load"
    else:
        regime = present(thinnest.thickness_regime).replace("_", " ")
        method = "Dowson and Higginson" if thinnest.thermal_ehl_min is None else "thermal EHL"
        finding = f"λ by {method} = {number(thinnest.thickness_ratio)} at the thinnest: {regime}"
    roughness = float(np.hypot(pair.pinion_material.roughness, pair.wheel_material.roughness)) / UM  # Eq. 28
    limit = Level(roughness, "λ = 1", limit=True)
    y = Axis("film thickness", "µm", symbol="h")

    def panel(path: ScuffingPath) -> Panel:
        lines = list[Line]()
        if path.thermal is not None:
            lines.append(Line("minimum", path.psi, path.thermal.minimum_film))
            lines.append(Line("central", path.psi, path.thermal.central_film, Hue.SKY))
        hue, role = (Hue.GREY, Role.REFERENCE) if lines else (Hue.BLUE, Role.RESULT)
        lines.append(Line("Dowson-Higginson", path.psi, path.dowson_higginson, hue, role))
        return Panel(x=PATH, y=y, lines=lines, levels=[limit], marks=parts.extreme(lines[:1], y.unit, least=True))

    return _along(inputs, result, finding, panel)


def film_against_micropitting(inputs: ScuffingInputs, result: Scuffing) -> Figure:
    """Draw the film ratio at the contact temperature along the evaluated lines, and the permissible ratio."""
    answer, pair = micropitting.answered(result), inputs.distribution
    roughness = (pair.pinion_material.roughness + pair.wheel_material.roughness) / 2 / UM

    def panel(path: ScuffingPath) -> Panel:
        thermal = None if path.thermal is None else path.thermal.minimum_film
        return micropitting.film_lines(answer, path.psi, present(path.micropitting_ratio), thermal, roughness)

    finding = f"λ_GF by ISO/TR 15144-1 = {number(present(answer.local.least_ratio))} at the thinnest"
    if answer.local.safety is not None:
        finding = f"{finding}: S_λ = {number(answer.local.safety)}, {answer.local.verdict}"
    return _along(inputs, result, finding, panel)


def friction(inputs: ScuffingInputs, result: Scuffing) -> Figure:
    """Draw the local friction and the film pressure by thermal EHL along the evaluated lines."""
    _with_oil(result)
    mean = result.flash.friction_coefficient
    solutions = {name: (path.psi, path.thermal) for name, path in _paths(result).items() if path.thermal is not None}
    if not solutions:
        message = "The friction along the path is computed only by the thermal EHL solution"
        raise NoFigure("closed_form", message, "model.lubrication")
    points, warned = _points(inputs, result), _warned(result.path)
    levels = points if mean is None else [*points, Level(mean, f"Blok's mean {number(mean)}", listed=True)]

    def panel(y: Axis, curve: str, hues: tuple[Hue, Hue]) -> Panel:
        lines = [
            Line(name, psi, getattr(thermal, curve), hue, named=len(solutions) > 1)
            for (name, (psi, thermal)), hue in zip(solutions.items(), hues, strict=False)
        ]
        marks = [mark for mark in parts.extreme(lines, y.unit) if mark.y > 0.0]
        return Panel(x=PATH, y=y, lines=lines, marks=marks)

    local = axis(ThermalPath, "friction_coefficient", "coefficient of friction")
    coefficient = panel(local, "friction_coefficient", (Hue.BLUE, Hue.SKY))
    pressure = panel(axis(ThermalPath, "max_pressure"), "max_pressure", (Hue.VERMILLION, Hue.ORANGE))
    panels = [
        replace(coefficient, levels=levels, spans=warned),
        replace(pressure, levels=parts.unnamed(points), spans=parts.unnamed(warned)),
    ]
    coefficients = np.concatenate([thermal.friction_coefficient for _, thermal in solutions.values()])
    finite = coefficients[np.isfinite(coefficients)]
    finding = "nowhere known"
    if finite.size:
        finding = f"μ from {number(float(finite.min()))} to {number(float(finite.max()))}"
    return Figure(finding, panels, unsolved=_unsolved(result))


def _points(inputs: ScuffingInputs, result: Scuffing) -> list[Level]:
    return path_points(inputs.distribution.gears) if len(result.path.psi) > 1 else []


def _unsolved(result: Scuffing) -> int:
    return sum(status in UNSOLVED for path in _paths(result).values() for status in path.status)


def _warned(path: ScuffingPath) -> list[Span]:
    """Return the ranges of psi in which the points of a path have warnings."""
    psi, spans = path.psi, list[Span]()
    edges = np.concatenate([psi[:1], (psi[:-1] + psi[1:]) / 2.0, psi[-1:]])
    for status, group in groupby(range(psi.size), key=lambda place: path.status[place]):
        if status == "ok_with_warnings":
            places = list(group)
            start, stop = float(edges[places[0]]), float(edges[places[-1] + 1])
            spans.append(Span(start, stop, "" if spans else WARNED, listed=True))
    return spans


def _of_distribution(build: Build) -> Build:
    """Adapt the builder of a load-distribution figure so that it accepts inputs and results of the scuffing check."""
    return lambda inputs, result: build(inputs.distribution, result.distribution)


def _balanced(build: Build) -> Build:
    """Adapt the builder of a heat-balance figure so that it accepts inputs and results of the scuffing check."""
    return lambda _, result: build(heat_balance.heat_of(result.heat))


def node_temperatures(inputs: ScuffingInputs, result: Scuffing) -> Figure:
    """Draw the temperatures of the flanks, of the gear bodies and of the oil mist."""
    return heat_balance.temperatures(heat_balance.heat_of(result.heat), inputs.temperatures.oil - UNITS["c"].offset)


OWN = ("section", "flank-pressure")  # figures of the load distribution that the page of scuffing shows
METHOD, BALANCE, DERIVED = "temperatures.bulk_method", "asks_for_balance", "own derivation, heat balance"
FIGURES = (
    Declaration(
        "contact-temperature", "Contact temperature along the path of contact", "Xue 2020, Fig. 22", contact_temperature
    ),
    Declaration("flank-temperature", "Contact temperature on the flank", "Xue 2020, Eq. 25", temperature_on_flank),
    Declaration("safety", "Safety factor against scuffing along the path of contact", "Xue 2020, Eq. 26", safety_along),
    Declaration(
        "micropitting",
        "Where will micropitting start?",
        "ISO/TR 15144-1, formula 2",
        micropitting.where_it_starts,
        compute=micropitting.solve_unmodified,
        asked_by="micropitting",
    ),
    Declaration(
        "safety-band",
        "Safety over the bulk temperature",
        DERIVED,
        heat_balance.safety_over_the_band,
        asked_by=METHOD,
        asked_if=BALANCE,
    ),
    Declaration("film", "Film along the path of contact", "Xue 2020, Fig. 23", film),
    Declaration(
        "heat-flows",
        "Where the heat goes",
        DERIVED,
        _balanced(heat_balance.where_heat_goes),
        asked_by=METHOD,
        asked_if=BALANCE,
    ),
    Declaration(
        "node-temperatures",
        "Temperatures of the gears",
        DERIVED,
        node_temperatures,
        asked_by=METHOD,
        asked_if=BALANCE,
    ),
    Declaration(
        "oil-flow",
        "What the oil flow does",
        DERIVED,
        heat_balance.oil_flow,
        compute=heat_balance.curve_over_the_flow,
        asked_by=METHOD,
        asked_if=BALANCE,
    ),
    Declaration(
        "micropitting-film",
        "Film against micropitting along the path",
        "ISO/TR 15144-1, formula 2",
        film_against_micropitting,
        asked_by="micropitting",
    ),
    Declaration("wear", "Wear over the flanks", "Archard 1953", micropitting.wear_on_flank, asked_by="micropitting"),
    Declaration("friction", "Friction and pressure along the path of contact", "Xue 2020, section IV", friction),
    *(
        replace(
            declaration,
            build=_of_distribution(declaration.build),
            shown_at="" if declaration.name in OWN else "/v1/scuffing/load-distribution",
        )
        for declaration in load_distribution.FIGURES
    ),
)
