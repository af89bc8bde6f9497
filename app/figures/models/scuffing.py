"""Figures of the check against scuffing along the path of contact."""

from dataclasses import replace
from itertools import groupby

import numpy as np

from app.figures.data import Axis, Figure, Hue, Level, Line, NoFigure, Panel, Role, Span, Values, values
from app.figures.declaration import Build, Declaration, present
from app.figures.models import load_distribution
from app.figures.models.load_distribution import PATH, path_points, unnamed
from app.figures.parts import curve, extreme
from app.figures.units import UM, axis
from app.figures.wording import number
from solvers.quantity import UNITS
from solvers.scuffing.inputs import ScuffingInputs
from solvers.scuffing.safety_results import Safety, Scuffing, ThermalPath

UNSOLVED = {"no_solution", "refused"}
WARNED = "outside validity"
SHOWN_SAFETIES = 4.0  # times the least, up to which safeties are shown: at the pitch point nothing slides


def _of_distribution(build: Build) -> Build:
    """A figure of the load distribution that the check rests on."""
    return lambda inputs, result: build(inputs.distribution, result.distribution)


def contact_temperature(inputs: ScuffingInputs, result: Scuffing) -> Figure:
    """Bulk and flash of both flanks by thermal EHL beside Blok, against the scuffing temperature."""
    _with_oil(result)
    bulk = present(result.contact_temperature).bulk
    lines = [replace(line, y=values(bulk + line.y)) for line in _flashes(result)]
    levels = [Level(bulk, f"bulk {number(bulk, '°C', digits=4)}")]
    if result.safety is not None:
        limit = result.safety.scuffing
        levels.append(Level(limit, f"scuffing temperature {number(limit, '°C')}", limit=True))
    y = Axis("contact temperature, bulk and flash", "°C", magnitude=False, symbol="θ_B")
    return _along(inputs, result, y, lines, levels, _safety(result), marked=lines[:-1] or lines)


def _flashes(result: Scuffing) -> list[Line]:
    """Flash temperatures along the path: of both flanks where they are known, and by Blok."""
    path, psi, lines = result.path, values(result.path.psi), []
    if path.thermal is not None:
        lines.append(Line("pinion", psi, path.thermal.pinion_flash, Hue.BLUE))
        lines.append(Line("wheel", psi, path.thermal.wheel_flash, Hue.VERMILLION))
    hue, role = (Hue.GREY, Role.REFERENCE) if lines else (Hue.BLUE, Role.RESULT)
    return [*lines, Line("Blok", psi, values(path.blok_flash), hue, role)]


def _along(
    inputs: ScuffingInputs,
    result: Scuffing,
    y: Axis,
    lines: list[Line],
    levels: list[Level],
    finding: str,
    *,
    marked: list[Line],
    least: bool = False,
) -> Figure:
    """Lines along the path of contact with an extreme of those marked, and the range in which the check holds."""
    panel = Panel(
        x=PATH,
        y=y,
        lines=tuple(lines),
        levels=(*levels, *_points(inputs, result)),
        spans=_warned(result),
        marks=extreme(marked, y.unit, least=least),
    )
    return Figure(finding, (panel,), unsolved=_unsolved(result))


def _with_oil(result: Scuffing) -> None:
    """Raise NoFigure without an oil and its temperature, which the figure needs."""
    if result.path is not None and result.contact_temperature is None:
        message = (
            "Without an oil and the bulk temperature at which it enters there is neither film nor contact temperature"
        )
        raise NoFigure("no_oil", message, "lubricant")


def _safety(result: Scuffing) -> str:
    safety, contact = result.safety, present(result.contact_temperature)
    known = () if safety is None else ((safety.thermal_ehl_factor, "thermal EHL"), (safety.blok_factor, "Blok"))
    factors = [f"{number(factor)} by {method}" for factor, method in known if factor is not None]
    if factors:
        return f"safety factor {', '.join(factors)}"
    if contact.thermal_ehl_max is not None:
        return f"up to {number(contact.thermal_ehl_max, '°C')} by thermal EHL"
    return "" if contact.blok_max is None else f"up to {number(contact.blok_max, '°C')} by Blok"


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
        hotter = values(np.fmax(*(line.y for line in flanks)))
        flashes.insert(0, Line("thermal EHL", blok.x, hotter, Hue.VERMILLION))
    rises = [(line, np.where(above_oil + line.y > 0.0, above_oil + line.y, np.nan)) for line in flashes]
    lines = [replace(line, y=values(reserve / rise)) for line, rise in rises if np.isfinite(rise).any()]
    if not lines:
        raise NoFigure("no_rise", "The contact is nowhere hotter than the oil, so no safety is defined", "temperatures")
    (mark,) = extreme(lines, least=True)
    top = max(1.5, min(SHOWN_SAFETIES * mark.y, *(1.1 * float(np.nanmax(line.y)) for line in lines)))
    method = next(line.title for line in lines if line.hue is mark.hue)
    finding = f"least {number(mark.y)} by {method}, at Ψ = {number(mark.x)}"
    y, limit = (
        axis(Safety, "blok_factor", "safety factor against scuffing", limits=(0.0, top)),
        Level(1.0, "scuffing below 1", limit=True),
    )
    return _along(inputs, result, y, lines, [limit], finding, marked=lines, least=True)


def film(inputs: ScuffingInputs, result: Scuffing) -> Figure:
    """Minimum and central film, the formula, and the film that is as thick as the roughness."""
    _with_oil(result)
    path, thinnest, psi = result.path, present(result.film), values(result.path.psi)
    lines = []
    if path.thermal is not None:
        lines.append(Line("minimum", psi, path.thermal.minimum_film))
        lines.append(Line("central", psi, path.thermal.central_film, Hue.SKY))
    hue, role = (Hue.GREY, Role.REFERENCE) if lines else (Hue.BLUE, Role.RESULT)
    lines.append(Line("Dowson-Higginson", psi, values(path.dowson_higginson), hue, role))
    if thinnest.thickness_ratio is None:
        finding = "no film is known everywhere" if _unsolved(result) else "no load"
    else:
        regime = present(thinnest.thickness_regime).replace("_", " ")
        finding = f"λ = {number(thinnest.thickness_ratio)} at the thinnest: {regime}"
    limit = Level(roughness(inputs), "λ = 1, film as thick as the roughness", limit=True)
    y = Axis("film thickness", "µm", symbol="h")
    return _along(inputs, result, y, lines, [limit], finding, marked=lines[:1], least=True)


def roughness(inputs: ScuffingInputs) -> float:
    """Film thickness of a thickness ratio of 1 in µm (Eq. 28)."""
    pair = inputs.distribution
    return float(np.hypot(pair.pinion_material.roughness, pair.wheel_material.roughness)) / UM


def friction(inputs: ScuffingInputs, result: Scuffing) -> Figure:
    """Coefficient of friction and film pressure along the path, from thermal EHL, beside the mean one in force."""
    _with_oil(result)
    path, thermal, mean = result.path, result.path.thermal, result.distribution.friction_loss.coefficient
    if thermal is None:
        raise NoFigure(
            "closed_form", "Friction along the path comes from the thermal EHL solution only", "model.lubrication"
        )
    points, warned = _points(inputs, result), _warned(result)
    # The coefficient that Blok's flash temperature and the losses take.
    means = () if mean is None else (Level(mean, f"mean of the formulas {number(mean)}"),)
    coefficient = axis(ThermalPath, "friction_coefficient", "coefficient of friction")
    panels = (
        curve(
            PATH,
            coefficient,
            path.psi,
            thermal.friction_coefficient,
            marked=True,
            levels=(*points, *means),
            spans=warned,
        ),
        curve(
            PATH,
            axis(ThermalPath, "max_pressure"),
            path.psi,
            thermal.max_pressure,
            Hue.VERMILLION,
            marked=True,
            levels=unnamed(points),
            spans=tuple(replace(span, name="") for span in warned),
        ),
    )
    known = thermal.friction_coefficient[np.isfinite(thermal.friction_coefficient)]
    finding = f"μ from {number(float(known.min()))} to {number(float(known.max()))}" if known.size else "nowhere known"
    return Figure(finding, panels, unsolved=_unsolved(result))


def _points(inputs: ScuffingInputs, result: Scuffing) -> tuple[Level, ...]:
    return path_points(inputs.distribution.gears) if len(result.path.psi) > 1 else ()


def _unsolved(result: Scuffing) -> int:
    return sum(status in UNSOLVED for status in result.path.status)


def _warned(result: Scuffing) -> tuple[Span, ...]:
    """Stretches of the path whose points carry warnings, to the middle between points."""
    psi: Values = values(result.path.psi)
    edges = np.concatenate([psi[:1], (psi[:-1] + psi[1:]) / 2.0, psi[-1:]])
    runs = groupby(range(psi.size), key=lambda index: result.path.status[index] == "ok_with_warnings")
    places = [list(group) for warned, group in runs if warned]
    return tuple(
        Span(float(edges[each[0]]), float(edges[each[-1] + 1]), "" if place else WARNED)
        for place, each in enumerate(places)
    )


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
