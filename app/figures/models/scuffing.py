"""Figures of the check against scuffing along the path of contact."""

from dataclasses import replace
from itertools import groupby

import numpy as np

from app.figures import parts
from app.figures.data import Axis, Figure, Hue, Level, Line, NoFigure, Panel, Role, Span
from app.figures.declaration import Build, Declaration, present
from app.figures.models import load_distribution
from app.figures.models.load_distribution import PATH, path_points
from app.figures.units import UM, axis
from app.figures.wording import number
from solvers.quantity import UNITS
from solvers.scuffing.inputs import ScuffingInputs
from solvers.scuffing.safety_results import Safety, Scuffing, ThermalPath

UNSOLVED = {"no_solution", "refused"}
WARNED = "outside validity"
SHOWN_SAFETIES = 4.0  # times the least, up to which safeties are shown: at the pitch point nothing slides


def contact_temperature(inputs: ScuffingInputs, result: Scuffing) -> Figure:
    """Bulk and flash of both flanks by thermal EHL beside Blok, against the scuffing temperature."""
    _with_oil(result)
    contact, safety = present(result.contact_temperature), result.safety
    lines = [replace(line, y=contact.bulk + line.y) for line in _flashes(result)]
    levels = [Level(contact.bulk, f"bulk {number(contact.bulk, '°C', digits=4)}")]
    finding = "" if contact.blok_max is None else f"up to {number(contact.blok_max, '°C')} by Blok"
    if contact.thermal_ehl_max is not None:
        finding = f"up to {number(contact.thermal_ehl_max, '°C')} by thermal EHL"
    if safety is not None:
        levels.append(Level(safety.scuffing, f"scuffing temperature {number(safety.scuffing, '°C')}", limit=True))
        factors = {"thermal EHL": safety.thermal_ehl_factor, "Blok": safety.blok_factor}
        texts = [f"{number(factor)} by {method}" for method, factor in factors.items() if factor is not None]
        finding = f"safety factor {', '.join(texts)}" if texts else finding
    y = Axis("contact temperature, bulk and flash", "°C", magnitude=False, symbol="θ_B")
    marks = parts.extreme(lines[:-1] or lines, y.unit)
    return _along(inputs, result, finding, Panel(x=PATH, y=y, lines=lines, levels=levels, marks=marks))


def _flashes(result: Scuffing) -> list[Line]:
    """Flash temperatures along the path: of both flanks where they are known, and by Blok."""
    path, lines = result.path, list[Line]()
    if path.thermal is not None:
        lines.append(Line("pinion", path.psi, path.thermal.pinion_flash, Hue.BLUE))
        lines.append(Line("wheel", path.psi, path.thermal.wheel_flash, Hue.VERMILLION))
    hue, role = (Hue.GREY, Role.REFERENCE) if lines else (Hue.BLUE, Role.RESULT)
    return [*lines, Line("Blok", path.psi, path.blok_flash, hue, role)]


def _along(inputs: ScuffingInputs, result: Scuffing, finding: str, panel: Panel) -> Figure:
    """A panel along the path of contact with its points, and the range in which the check does not hold."""
    known = replace(panel, levels=[*panel.levels, *_points(inputs, result)], spans=_warned(result))
    return Figure(finding, [known], unsolved=_unsolved(result))


def _with_oil(result: Scuffing) -> None:
    """Raise NoFigure without an oil and its temperature, which the figure needs."""
    if result.path is not None and result.contact_temperature is None:
        message = (
            "Without an oil and the bulk temperature at which it enters there is neither film nor contact temperature"
        )
        raise NoFigure("no_oil", message, "lubricant")


def safety_along(inputs: ScuffingInputs, result: Scuffing) -> Figure:
    """Scuffing temperature over contact temperature, both above that of the oil (Eq. 26), point by point."""
    _with_oil(result)
    if result.safety is None:
        raise NoFigure("no_scuffing_temperature", "Safety needs a scuffing temperature", "temperatures")
    oil = inputs.temperatures.oil - UNITS["c"].offset
    above_oil, reserve = present(result.contact_temperature).bulk - oil, result.safety.scuffing - oil
    *flanks, blok = _flashes(result)
    flashes = [replace(blok, role=Role.RESULT)]
    if flanks:
        hotter = np.fmax(*(line.y for line in flanks))
        flashes.insert(0, Line("thermal EHL", blok.x, hotter, Hue.VERMILLION))
    rises = [(line, np.where(above_oil + line.y > 0.0, above_oil + line.y, np.nan)) for line in flashes]
    lines = [replace(line, y=reserve / rise) for line, rise in rises if np.isfinite(rise).any()]
    if not lines:
        raise NoFigure("no_rise", "The contact is nowhere hotter than the oil, so no safety is defined", "temperatures")
    marks = parts.extreme(lines, least=True)
    least = marks[0]
    top = max(1.5, min(SHOWN_SAFETIES * least.y, *(1.1 * float(np.nanmax(line.y)) for line in lines)))
    method = next(line.title for line in lines if line.hue is least.hue)
    y = axis(Safety, "blok_factor", "safety factor against scuffing", limits=(0.0, top))
    limit = Level(1.0, "scuffing below 1", limit=True)
    finding = f"least {number(least.y)} by {method}, at Ψ = {number(least.x)}"
    return _along(inputs, result, finding, Panel(x=PATH, y=y, lines=lines, levels=[limit], marks=marks))


def film(inputs: ScuffingInputs, result: Scuffing) -> Figure:
    """Minimum and central film, the formula, and the film that is as thick as the roughness."""
    _with_oil(result)
    path, thinnest, pair, lines = result.path, present(result.film), inputs.distribution, list[Line]()
    if path.thermal is not None:
        lines.append(Line("minimum", path.psi, path.thermal.minimum_film))
        lines.append(Line("central", path.psi, path.thermal.central_film, Hue.SKY))
    hue, role = (Hue.GREY, Role.REFERENCE) if lines else (Hue.BLUE, Role.RESULT)
    lines.append(Line("Dowson-Higginson", path.psi, path.dowson_higginson, hue, role))
    if thinnest.thickness_ratio is None:
        finding = "no film is known everywhere" if _unsolved(result) else "no load"
    else:
        regime = present(thinnest.thickness_regime).replace("_", " ")
        finding = f"λ = {number(thinnest.thickness_ratio)} at the thinnest: {regime}"
    roughness = float(np.hypot(pair.pinion_material.roughness, pair.wheel_material.roughness)) / UM  # Eq. 28
    limit = Level(roughness, "λ = 1, film as thick as the roughness", limit=True)
    y = Axis("film thickness", "µm", symbol="h")
    marks = parts.extreme(lines[:1], y.unit, least=True)
    return _along(inputs, result, finding, Panel(x=PATH, y=y, lines=lines, levels=[limit], marks=marks))


def friction(inputs: ScuffingInputs, result: Scuffing) -> Figure:
    """Coefficient of friction and film pressure along the path, from thermal EHL, beside the mean one of Blok's."""
    _with_oil(result)
    psi, thermal, mean = result.path.psi, result.path.thermal, result.flash.friction_coefficient
    if thermal is None:
        message = "Friction along the path comes from the thermal EHL solution only"
        raise NoFigure("closed_form", message, "model.lubrication")
    points, warned, coefficient = _points(inputs, result), _warned(result), thermal.friction_coefficient
    levels = points if mean is None else [*points, Level(mean, f"mean of Blok's flash temperature {number(mean)}")]
    plain = {"levels": parts.unnamed(points), "spans": parts.unnamed(warned)}
    local = axis(ThermalPath, "friction_coefficient", "coefficient of friction")
    pressure = axis(ThermalPath, "max_pressure")
    panels = [
        parts.curve(PATH, local, psi, coefficient, marked=True, levels=levels, spans=warned),
        parts.curve(PATH, pressure, psi, thermal.max_pressure, Hue.VERMILLION, marked=True, **plain),
    ]
    known = coefficient[np.isfinite(coefficient)]
    finding = f"μ from {number(float(known.min()))} to {number(float(known.max()))}" if known.size else "nowhere known"
    return Figure(finding, panels, unsolved=_unsolved(result))


def _points(inputs: ScuffingInputs, result: Scuffing) -> list[Level]:
    return path_points(inputs.distribution.gears) if len(result.path.psi) > 1 else []


def _unsolved(result: Scuffing) -> int:
    return sum(status in UNSOLVED for status in result.path.status)


def _warned(result: Scuffing) -> list[Span]:
    """Stretches of the path whose points carry warnings, to the middle between points; the first is named."""
    psi, spans = result.path.psi, list[Span]()
    edges = np.concatenate([psi[:1], (psi[:-1] + psi[1:]) / 2.0, psi[-1:]])
    for status, group in groupby(range(psi.size), key=lambda place: result.path.status[place]):
        if status == "ok_with_warnings":
            places = list(group)
            start, stop = float(edges[places[0]]), float(edges[places[-1] + 1])
            spans.append(Span(start, stop, "" if spans else WARNED))
    return spans


def _of_distribution(build: Build) -> Build:
    """A figure of the load distribution that the check rests on."""
    return lambda inputs, result: build(inputs.distribution, result.distribution)


OWN = ("section", "flank-pressure")  # of the figures of the load distribution: where the pair can scuff
FIGURES = (
    Declaration(
        "contact-temperature", "Contact temperature along the path of contact", "Xue 2020, Fig. 22", contact_temperature
    ),
    Declaration("safety", "Safety factor against scuffing along the path of contact", "Xue 2020, Eq. 26", safety_along),
    Declaration("film", "Film along the path of contact", "Xue 2020, Fig. 23", film),
    Declaration("friction", "Friction and pressure along the path of contact", "Xue 2020, section IV", friction),
    *(
        replace(
            each,
            build=_of_distribution(each.build),
            shown_at="" if each.name in OWN else "/v1/scuffing/load-distribution",
        )
        for each in load_distribution.FIGURES
    ),
)
