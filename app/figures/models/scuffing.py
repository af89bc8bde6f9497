"""Figures of the check against scuffing along the path of contact."""

import numpy as np

from app.figures.data import Axis, Figure, Hue, Level, Line, Mark, NoFigure, Panel, Role, Span, Values, values
from app.figures.declaration import Declaration, present
from app.figures.models.load_distribution import PATH, path_points, unnamed
from app.figures.wording import number
from app.schema.scuffing import ScuffingPathCurves, ScuffingRequest, ScuffingResponse

UNSOLVED = {"no_solution", "refused"}
WARNED = "outside validity"


def contact_temperature(_: ScuffingRequest, answer: ScuffingResponse) -> Figure:
    """Bulk and flash of both flanks by thermal EHL beside Blok, against the scuffing temperature."""
    _with_oil(answer)
    path, bulk = present(answer.path), present(answer.contact_temperature).bulk_c
    psi = values(path.psi)
    lines = []
    for title, flash, hue in (("pinion", path.pinion_flash_k, Hue.BLUE), ("wheel", path.wheel_flash_k, Hue.VERMILLION)):
        if flash is not None:
            lines.append(Line(title, psi, bulk + values(flash), hue))
    thermal = bool(lines)
    role = Role.REFERENCE if thermal else Role.RESULT
    lines.append(Line("Blok", psi, bulk + values(path.blok_flash_k), Hue.GREY if thermal else Hue.BLUE, role))
    levels = [Level(bulk, f"bulk {number(bulk, '°C', digits=4)}")]
    if answer.safety is not None:
        limit = answer.safety.scuffing_c
        levels.append(Level(limit, f"scuffing temperature {number(limit, '°C')}", limit=True))
    panel = Panel(
        x=PATH,
        y=Axis("contact temperature: bulk and flash", "°C", magnitude=False),
        lines=tuple(lines),
        levels=(*levels, *_pitch_point(answer, path)),
        spans=_warned(path),
        marks=_hottest(lines[:-1] or lines),
    )
    return Figure(_safety(answer), (panel,), unsolved=_unsolved(path))


def _with_oil(answer: ScuffingResponse) -> None:
    """Refuse a figure of what only an oil at its temperature makes known."""
    if answer.path is not None and answer.contact_temperature is None:
        message = (
            "Without an oil and the bulk temperature at which it enters there is neither film nor contact temperature"
        )
        raise NoFigure("no_oil", message, "lubricant")


def _safety(answer: ScuffingResponse) -> str:
    safety, contact = answer.safety, present(answer.contact_temperature)
    known = () if safety is None else ((safety.thermal_ehl_factor, "thermal EHL"), (safety.blok_factor, "Blok"))
    factors = [f"{number(factor)} by {method}" for factor, method in known if factor is not None]
    if factors:
        return f"safety against scuffing {', '.join(factors)}"
    if contact.thermal_ehl_max_c is not None:
        return f"up to {number(contact.thermal_ehl_max_c, '°C')} by thermal EHL"
    return "" if contact.blok_max_c is None else f"up to {number(contact.blok_max_c, '°C')} by Blok"


def _hottest(lines: list[Line]) -> tuple[Mark, ...]:
    """The hottest point of all lines."""
    known = [line for line in lines if np.isfinite(line.y).any()]
    if not known:
        return ()
    line = max(known, key=lambda each: float(np.nanmax(each.y)))
    at = int(np.nanargmax(line.y))
    return (Mark(float(line.x[at]), float(line.y[at]), number(float(line.y[at]), "°C"), line.hue),)


def film(request: ScuffingRequest, answer: ScuffingResponse) -> Figure:
    """Minimum and central film, the formula, and the film that is as thick as the roughness."""
    _with_oil(answer)
    path, thinnest = present(answer.path), present(answer.film)
    psi = values(path.psi)
    formula = values(path.dowson_higginson_um)
    lines = []
    if path.minimum_film_um is not None:
        lines.append(Line("minimum", psi, values(path.minimum_film_um)))
    if path.central_film_um is not None:
        lines.append(Line("central", psi, values(path.central_film_um), Hue.SKY))
    thermal = bool(lines)
    hue, role = (Hue.GREY, Role.REFERENCE) if thermal else (Hue.BLUE, Role.RESULT)
    lines.append(Line("Dowson-Higginson", psi, formula, hue, role))
    marks: tuple[Mark, ...] = ()
    if np.isfinite(lines[0].y).any():
        at = int(np.nanargmin(lines[0].y))
        marks = (Mark(float(psi[at]), float(lines[0].y[at]), number(float(lines[0].y[at]), "µm"), lines[0].hue),)
    panel = Panel(
        x=PATH,
        y=Axis("film thickness", "µm"),
        lines=tuple(lines),
        levels=(
            Level(roughness(request), "λ = 1, film as thick as the roughness", limit=True),
            *_pitch_point(answer, path),
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


def roughness(request: ScuffingRequest) -> float:
    """Film thickness of a thickness ratio of 1 in µm (Eq. 28)."""
    materials = request.materials
    return float(np.hypot(materials.pinion.roughness_um, materials.wheel.roughness_um))


def friction(_: ScuffingRequest, answer: ScuffingResponse) -> Figure:
    """Coefficient of friction and film pressure along the path, from thermal EHL, beside the mean one in force."""
    _with_oil(answer)
    path = present(answer.path)
    if path.friction_coefficient is None or path.max_pressure_mpa is None:
        raise NoFigure(
            "closed_form", "Friction along the path comes from the thermal EHL solution only", "model.lubrication"
        )
    psi, friction_line = values(path.psi), values(path.friction_coefficient)
    points = _pitch_point(answer, path)
    panels = (
        Panel(
            x=PATH,
            y=Axis("coefficient of friction"),
            lines=(Line("friction", psi, friction_line, named=False),),
            levels=(*points, *_mean_friction(answer)),
            spans=_warned(path),
            marks=_largest(psi, friction_line, "", Hue.BLUE),
        ),
        Panel(
            x=PATH,
            y=Axis("largest pressure in the film", "MPa"),
            lines=(Line("pressure", psi, values(path.max_pressure_mpa), Hue.VERMILLION, named=False),),
            levels=unnamed(points),
            spans=tuple(Span(span.start, span.stop, "") for span in _warned(path)),
            marks=_largest(psi, values(path.max_pressure_mpa), "MPa", Hue.VERMILLION),
        ),
    )
    known = friction_line[np.isfinite(friction_line)]
    finding = f"μ from {number(float(known.min()))} to {number(float(known.max()))}" if known.size else "nowhere known"
    return Figure(finding, panels, unsolved=_unsolved(path))


def _mean_friction(answer: ScuffingResponse) -> tuple[Level, ...]:
    """The coefficient that Blok's flash temperature and the losses take."""
    mean = None if answer.friction_loss is None else answer.friction_loss.coefficient
    return () if mean is None else (Level(mean, f"mean of the formulas {number(mean)}"),)


def _largest(psi: Values, y: Values, unit: str, hue: Hue) -> tuple[Mark, ...]:
    if not np.isfinite(y).any():
        return ()
    at = int(np.nanargmax(y))
    return (Mark(float(psi[at]), float(y[at]), number(float(y[at]), unit), hue),)


def _pitch_point(answer: ScuffingResponse, path: ScuffingPathCurves) -> tuple[Level, ...]:
    curves = present(answer.feature_line)
    return path_points(values(curves.psi), values(curves.gamma)) if len(path.psi) > 1 else ()


def _unsolved(path: ScuffingPathCurves) -> int:
    return sum(status in UNSOLVED for status in path.status)


def _warned(path: ScuffingPathCurves) -> tuple[Span, ...]:
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
    Declaration("film", "Film along the path of contact", "Xue 2020, Fig. 23", film),
    Declaration("friction", "Friction and pressure along the path of contact", "Xue 2020, section IV", friction),
)
