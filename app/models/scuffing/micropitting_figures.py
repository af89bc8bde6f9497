"""Figures of the check against micropitting, and of wear, over the flank and along the evaluated lines."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from app.figures import parts
from app.figures.data import Figure, Hue, Level, Line, Map, Mark, NoFigure, Panel, Values
from app.figures.declaration import present
from app.figures.units import MM, axis, shown
from app.figures.wording import number, percent
from app.models.load_distribution.figures import PATH, PROFILE, face
from solvers.drive_train.results import DriveTrainResult, FlankMaps
from solvers.scuffing import solve_scuffing
from solvers.scuffing.inputs import Modifications, ScuffingInputs
from solvers.scuffing.micropitting.results import LocalFilm, Micropitting, Wear
from solvers.scuffing.safety_results import HeatedFlank, Scuffing, ScuffingPath

AS_DRAWN = "without modifications and misalignment"
# Largest ratio on the scale of colours, divided by the least ratio. Greater ratios occur at lightly loaded edges and
# share one colour.
SHOWN_RATIOS = 2.5
FILM_OVER_ROUGHNESS = "film over roughness"


def solve_unmodified(inputs: ScuffingInputs, *_: Scuffing) -> Scuffing | None:
    """Solve the pair in closed form without its modifications and misalignment.

    Return None if the pair has neither modifications nor misalignment. The result is in the units that pages show.
    """
    if inputs.distribution.modifications == Modifications():
        return None
    plain = replace(inputs.distribution, modifications=Modifications())
    return shown(solve_scuffing(replace(inputs, distribution=plain, lubrication="closed_form")))


def where_it_starts(inputs: ScuffingInputs, result: Scuffing, plain: Scuffing | None) -> Figure:
    """Draw two maps of the film ratio over the flank, one of the pair and one of the unmodified pair."""
    answer = answered(result)
    return over_flanks(inputs, answer, result.flank, plain)


def answered(result: Scuffing | DriveTrainResult) -> Micropitting:
    """Return the answer of the check. Raise NoFigure if there is no answer or no least film ratio."""
    answer = result.micropitting
    if answer is None:
        message = "Without an oil and a bulk temperature the film cannot be computed"
        raise NoFigure("no_oil", message, "lubricant")
    if answer.local.least_ratio is None:
        if not result.flank.line_load.any():
            raise NoFigure("no_film", "Without load there is no film that could be too thin", "load")
        message = "The loaded path of contact reaches a base circle; the film is not defined at a base circle"
        raise NoFigure("no_film", message, "gears")
    return answer


class _Case(NamedTuple):
    """A gear pair in the figure, with or without its modifications: title, least film ratio and maps over the flank."""

    title: str | None
    local: LocalFilm
    flank: HeatedFlank | FlankMaps

    @property
    def grid(self) -> Values:
        """Film ratios over the flank."""
        return present(self.flank.micropitting_ratio)


def over_flanks(
    inputs: ScuffingInputs, answer: Micropitting, flank: HeatedFlank | FlankMaps, plain: Scuffing | None
) -> Figure:
    """Draw the film ratio of a pair and of the unmodified pair. Both maps share one scale of colours."""
    cases = [_Case(None, answer.local, flank)]
    if plain is not None and plain.micropitting is not None:
        cases = [_Case("as described", answer.local, flank), _Case(AS_DRAWN, plain.micropitting.local, plain.flank)]
    low = min(float(np.nanmin(case.grid)) for case in cases)
    highest = max(float(np.nanmax(case.grid)) for case in cases)
    ends = low, min(highest, SHOWN_RATIOS * low) if low < highest and low > 0.0 else low + 1.0
    width = inputs.distribution.gears.face_width
    panels = [_film_map(width, case, answer.permissible_ratio, ends, bar=case is cases[-1]) for case in cases]
    finding = f"least {_place(answer.local)}"
    if answer.local.safety is not None:
        finding = f"S_λ = {number(answer.local.safety)}: {answer.local.verdict}; {finding}"
    if len(cases) > 1 and cases[1].local.least_ratio is not None:
        finding = f"{finding}; {AS_DRAWN} {_place(cases[1].local)}"
    return Figure(finding, panels, beside=len(panels) > 1)


def _place(local: LocalFilm) -> str:
    place = f"{percent(present(local.at_psi))} of the path, y = {number(present(local.at_face), 'mm')}"
    return f"λ_GF = {number(present(local.least_ratio))} at {place}"


def _film_map(width: float, case: _Case, permissible: float | None, ends: tuple[float, float], *, bar: bool) -> Panel:
    """Return a map of the film ratio, with a mark at the least ratio and a contour at the permissible ratio."""
    film, local = axis(case.flank, "micropitting_ratio", FILM_OVER_ROUGHNESS), case.local
    inside = permissible is not None and float(np.nanmin(case.grid)) < permissible < float(np.nanmax(case.grid))
    mapped = Map(
        film.title,
        film.unit,
        case.flank.face_fraction * width / MM,
        case.flank.profile_fraction,
        case.grid,
        critical=[Level(permissible, "permissible")] if permissible is not None and inside else [],
        range=ends,
        bar=bar,
    )
    marks = []
    if local.least_ratio is not None and local.at_psi is not None and local.at_face is not None:
        marks = [Mark(local.at_face, local.at_psi, number(local.least_ratio))]
    return Panel(x=face(width), y=PROFILE, title=case.title, map=mapped, marks=marks)


def film_lines(
    answer: Micropitting, psi: Values, ratio: Values, thermal_film: Values | None, roughness: float
) -> Panel:
    """Return a panel of the film ratios along a line, and of the permissible ratio.

    `ratio` is the film ratio at the contact temperature. The ratio by thermal EHL is `thermal_film` [um] divided by
    `roughness`, which is the mean Ra of both flanks [um].
    """
    lines = [Line("at the contact temperature", psi, ratio)]
    if thermal_film is not None:
        lines.append(Line("thermal EHL", psi, thermal_film / roughness, Hue.VERMILLION))
    levels = []
    if answer.permissible_ratio is not None:
        name = f"permissible {number(answer.permissible_ratio)}"
        levels = [Level(answer.permissible_ratio, name, limit=True)]
    marks = parts.extreme(lines[:1], least=True)
    return Panel(
        x=PATH, y=axis(ScuffingPath, "micropitting_ratio", FILM_OVER_ROUGHNESS), lines=lines, levels=levels, marks=marks
    )


def wear_on_flank(inputs: ScuffingInputs, result: Scuffing | DriveTrainResult) -> Figure:
    """Draw the depth of wear over the flanks of pinion and wheel. Both maps share one scale of colours."""
    wear, flank = result.wear, result.flank
    if wear is None:
        raise NoFigure(
            "not_asked",
            "Give a wear coefficient; the wear of the flanks is computed with this coefficient",
            "micropitting",
        )
    if wear.pinion_max is None or wear.wheel_max is None:
        message = "The loaded path of contact reaches a base circle; the wear is not defined at a base circle"
        raise NoFigure("no_wear", message, "gears")
    width, highest = inputs.distribution.gears.face_width, max(wear.pinion_max, wear.wheel_max)
    if highest == 0.0:
        raise NoFigure("no_load", "Without load there is no wear", "load")
    panels = []
    for gear, grid in (("pinion", wear.pinion_map), ("wheel", wear.wheel_map)):
        depth = axis(Wear, f"{gear}_map", "depth of wear")
        y = flank.face_fraction * width / MM
        mapped = Map(
            depth.title, depth.unit, y, flank.profile_fraction, grid, range=(0.0, highest), bar=gear == "wheel"
        )
        marks = [parts.extreme_of_map(mapped, lambda value, _: number(value))]
        panels.append(Panel(x=face(width), y=PROFILE, title=gear, map=mapped, marks=marks))
    unit = depth.unit
    finding = f"pinion up to {number(wear.pinion_max, unit)}, wheel up to {number(wear.wheel_max, unit)}"
    return Figure(finding, panels, beside=True)
