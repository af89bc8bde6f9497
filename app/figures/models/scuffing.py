"""Figures of the check against scuffing along the path of contact."""

from dataclasses import replace

import numpy as np

from app.figures.data import Axis, Figure, Hue, Level, Line, Mark, NoFigure, Panel, Role, Span, Values, values
from app.figures.declaration import Build, Declaration, present
from app.figures.models import load_distribution
from app.figures.models.load_distribution import PATH, path_points, unnamed
from app.figures.units import UM
from app.figures.wording import number
from solvers.quantity import UNITS
from solvers.scuffing.inputs import ScuffingInputs
from solvers.scuffing.safety_results import Scuffing, ScuffingPath

UNSOLVED = {"no_solution", "refused"}
WARNED = "outside validity"
SHOWN_SAFETIES = 4.0  # times the least, up to which safeties are shown: at the pitch point nothing slides


def _of_distribution(build: Build) -> Build:
    """A figure of the load distribution that the check rests on."""
    return lambda inputs, result: build(inputs.distribution, result.distribution)


def contact_temperature(_: ScuffingInputs, result: Scuffing) -> Figure:
    """Bulk and flash of both flanks by thermal EHL beside Blok, against the scuffing temperature."""
    _with_oil(result)
    path, bulk = result.path, present(result.contact_temperature).bulk
    psi = values(path.psi)
    lines = []
    if path.thermal is not None:
        lines.append(Line("pinion", psi, bulk + path.thermal.pinion_flash, Hue.BLUE))
        lines.append(Line("wheel", psi, bulk + path.thermal.wheel_flash, Hue.VERMILLION))
    thermal = bool(lines)
    role = Role.REFERENCE if thermal else Role.RESULT
    lines.append(Line("Blok", psi, bulk + values(path.blok_flash), Hue.GREY if thermal else Hue.BLUE, role))
    levels = [Level(bulk, f"bulk {number(bulk, '°C', digits=4)}")]
    if result.safety is not None:
        limit = result.safety.scuffing
        levels.append(Level(limit, f"scuffing temperature {number(limit, '°C')}", limit=True))
    panel = Panel(
        x=PATH,
        y=Axis("contact temperature, bulk and flash", "°C", magnitude=False, symbol="θ"),
        lines=tuple(lines),
        levels=(*levels, *_points(result)),
        spans=_warned(path),
        marks=_hottest(lines[:-1] or lines),
    )
    return Figure(_safety(result), (panel,), unsolved=_unsolved(path))


def _with_oil(result: Scuffing) -> None:
    """Refuse a figure of what only an oil at its temperature makes known."""
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
        return f"safety against scuffing {', '.join(factors)}"
    if contact.thermal_ehl_max is not None:
        return f"up to {number(contact.thermal_ehl_max, '°C')} by thermal EHL"
    return "" if contact.blok_max is None else f"up to {number(contact.blok_max, '°C')} by Blok"


def safety_along(inputs: ScuffingInputs, result: Scuffing) -> Figure:
    """Scuffing temperature over contact temperature, both above that of the oil (Eq. 26), point by point."""
    _with_oil(result)
    if result.safety is None:
        raise NoFigure("no_scuffing_temperature", "Safety needs a scuffing temperature", "temperatures")
    path, bulk = result.path, present(result.contact_temperature).bulk
    oil = inputs.temperatures.oil - UNITS["c"].offset
    flashes = [("Blok", path.blok_flash, Hue.BLUE if path.thermal is None else Hue.GREY)]
    if path.thermal is not None:
        hotter = np.fmax(path.thermal.pinion_flash, path.thermal.wheel_flash)
        flashes.insert(0, ("thermal EHL", hotter, Hue.VERMILLION))
    lines = []
    for title, flash, hue in flashes:
        rise = bulk + flash - oil
        factor = np.where(rise > 0.0, (result.safety.scuffing - oil) / np.where(rise > 0.0, rise, 1.0), np.nan)
        lines.append(Line(title, values(path.psi), values(factor), hue))
    known = [line for line in lines if np.isfinite(line.y).any()]
    if not known:
        raise NoFigure("no_rise", "The contact is nowhere hotter than the oil, so no safety is defined", "temperatures")
    least = min(known, key=lambda line: float(np.nanmin(line.y)))
    at = int(np.nanargmin(least.y))
    value = float(least.y[at])
    top = max(1.5, min(SHOWN_SAFETIES * value, *(1.1 * float(np.nanmax(line.y)) for line in known)))
    panel = Panel(
        x=PATH,
        y=Axis("safety against scuffing", symbol="S_B", limits=(0.0, top)),
        lines=tuple(known),
        levels=(Level(1.0, "scuffing below 1", limit=True), *_points(result)),
        spans=_warned(path),
        marks=(Mark(float(least.x[at]), value, number(value), least.hue),),
    )
    finding = f"least {number(value)} by {least.title}, at Ψ = {number(float(least.x[at]))}"
    return Figure(finding, (panel,), unsolved=_unsolved(path))


def _hottest(lines: list[Line]) -> tuple[Mark, ...]:
    """The hottest point of all lines."""
    known = [line for line in lines if np.isfinite(line.y).any()]
    if not known:
        return ()
    line = max(known, key=lambda each: float(np.nanmax(each.y)))
    at = int(np.nanargmax(line.y))
    return (Mark(float(line.x[at]), float(line.y[at]), number(float(line.y[at]), "°C"), line.hue),)


def film(inputs: ScuffingInputs, result: Scuffing) -> Figure:
    """Minimum and central film, the formula, and the film that is as thick as the roughness."""
    _with_oil(result)
    path, thinnest = result.path, present(result.film)
    psi = values(path.psi)
    formula = values(path.dowson_higginson)
    lines = []
    if path.thermal is not None:
        lines.append(Line("minimum", psi, path.thermal.minimum_film))
        lines.append(Line("central", psi, path.thermal.central_film, Hue.SKY))
    thermal = bool(lines)
    hue, role = (Hue.GREY, Role.REFERENCE) if thermal else (Hue.BLUE, Role.RESULT)
    lines.append(Line("Dowson-Higginson", psi, formula, hue, role))
    marks: tuple[Mark, ...] = ()
    if np.isfinite(lines[0].y).any():
        at = int(np.nanargmin(lines[0].y))
        marks = (Mark(float(psi[at]), float(lines[0].y[at]), number(float(lines[0].y[at]), "µm"), lines[0].hue),)
    panel = Panel(
        x=PATH,
        y=Axis("film thickness", "µm", symbol="h"),
        lines=tuple(lines),
        levels=(
            Level(roughness(inputs), "λ = 1, film as thick as the roughness", limit=True),
            *_points(result),
        ),
        spans=_warned(path),
        marks=marks,
    )
    if thinnest.thickness_ratio is None:
        finding = "no film is known everywhere" if _unsolved(path) else "no load"
    else:
        regime = present(thinnest.thickness_regime).replace("_", " ")
        finding = f"λ = {number(thinnest.thickness_ratio)} at the thinnest: {regime}"
    return Figure(finding, (panel,), unsolved=_unsolved(path))


def roughness(inputs: ScuffingInputs) -> float:
    """Film thickness of a thickness ratio of 1 in µm (Eq. 28)."""
    pair = inputs.distribution
    return float(np.hypot(pair.pinion_material.roughness, pair.wheel_material.roughness)) / UM


def friction(_: ScuffingInputs, result: Scuffing) -> Figure:
    """Coefficient of friction and film pressure along the path, from thermal EHL, beside the mean one in force."""
    _with_oil(result)
    path = result.path
    thermal = path.thermal
    if thermal is None:
        raise NoFigure(
            "closed_form", "Friction along the path comes from the thermal EHL solution only", "model.lubrication"
        )
    psi, friction_line = values(path.psi), values(thermal.friction_coefficient)
    points = _points(result)
    panels = (
        Panel(
            x=PATH,
            y=Axis("coefficient of friction", symbol="μ"),
            lines=(Line("friction", psi, friction_line, named=False),),
            levels=(*points, *_mean_friction(result)),
            spans=_warned(path),
            marks=_largest(psi, friction_line, "", Hue.BLUE),
        ),
        Panel(
            x=PATH,
            y=Axis("largest pressure in the film", "MPa", symbol="p_max"),
            lines=(Line("pressure", psi, values(thermal.max_pressure), Hue.VERMILLION, named=False),),
            levels=unnamed(points),
            spans=tuple(Span(span.start, span.stop, "") for span in _warned(path)),
            marks=_largest(psi, values(thermal.max_pressure), "MPa", Hue.VERMILLION),
        ),
    )
    known = friction_line[np.isfinite(friction_line)]
    finding = f"μ from {number(float(known.min()))} to {number(float(known.max()))}" if known.size else "nowhere known"
    return Figure(finding, panels, unsolved=_unsolved(path))


def _mean_friction(result: Scuffing) -> tuple[Level, ...]:
    """The coefficient that Blok's flash temperature and the losses take."""
    mean = result.distribution.friction_loss.coefficient
    return () if mean is None else (Level(mean, f"mean of the formulas {number(mean)}"),)


def _largest(psi: Values, y: Values, unit: str, hue: Hue) -> tuple[Mark, ...]:
    if not np.isfinite(y).any():
        return ()
    at = int(np.nanargmax(y))
    return (Mark(float(psi[at]), float(y[at]), number(float(y[at]), unit), hue),)


def _points(result: Scuffing) -> tuple[Level, ...]:
    return path_points(result.distribution) if len(result.path.psi) > 1 else ()


def _unsolved(path: ScuffingPath) -> int:
    return sum(status in UNSOLVED for status in path.status)


def _warned(path: ScuffingPath) -> tuple[Span, ...]:
    """Stretches of the path whose points carry warnings, to the middle between points."""
    psi, spans = values(path.psi), list[Span]()
    edges = np.concatenate([psi[:1], (psi[:-1] + psi[1:]) / 2.0, psi[-1:]])
    start: float | None = None
    for index, status in enumerate((*path.status, "ok")):
        if status == "ok_with_warnings" and start is None:
            start = float(edges[index])
        elif status != "ok_with_warnings" and start is not None:
            spans.append(Span(start, float(edges[index]), "" if spans else WARNED))
            start = None
    return tuple(spans)


FIGURES = (
    Declaration(
        "contact-temperature", "Contact temperature along the path of contact", "Xue 2020, Fig. 22", contact_temperature
    ),
    Declaration("safety", "Safety against scuffing along the path of contact", "Xue 2020, Eq. 26", safety_along),
    Declaration("film", "Film along the path of contact", "Xue 2020, Fig. 23", film),
    Declaration("friction", "Friction and pressure along the path of contact", "Xue 2020, section IV", friction),
    *(replace(each, build=_of_distribution(each.build)) for each in load_distribution.FIGURES),
)
