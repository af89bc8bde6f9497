"""Figures of studies: sweeps as curves and maps, influences, worst corners, lead charts, and the course of a search."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from math import isfinite
from typing import NamedTuple

import numpy as np

from app.figures import parts
from app.figures.data import (
    ORDER,
    Axis,
    Figure,
    Hue,
    Level,
    Line,
    Map,
    Mark,
    Panel,
    Ribbon,
    Role,
    Row,
    Span,
    Values,
    values,
)
from app.figures.wording import NO_BREAK, difference_unit, listed, number, to_digits
from app.schema.precision import NOISE, is_constant

MOST_CURVES = 6  # if a sweep of two fields needs more curves, a map is drawn instead
NEAR = (
    0.25  # a line of the verdict is drawn if it lies at most this share of its value outside the values of the figure
)
FLAT = 0.5  # an axis does not start at zero if all values are above this share of the largest value
MOST_ROWS = 12  # largest number of bars in a figure
NAMED = 3  # largest number of inputs in the finding
ALIKE = 0.05  # share of its range by which both ends of an input may differ and still be one dot


@dataclass(frozen=True, slots=True, eq=False)
class Coordinate:
    """A varied field and its values. The values are either words, or numbers in rising order.

    `own` is the value of the field in the case itself. If `scatters` is True, the field has a tolerance, and the design
    has to tolerate all of the values.
    """

    axis: Axis
    values: Values
    words: tuple[str, ...] = ()
    own: float | None = None
    scatters: bool = False

    def is_end(self, index: int) -> bool:
        """Return whether the value with the given index is the least or the greatest of several numbers."""
        return not self.words and self.values.size > 1 and index in {0, self.values.size - 1}

    def named(self, index: int) -> str:
        """Return the value with the given index as text."""
        return self.words[index] if self.words else number(float(self.values[index]), self.axis.unit)


@dataclass(frozen=True, slots=True, eq=False)
class Grid:
    """Values of an output over one field, `[x]`, or over two fields, `[x][y]`.

    NaN stands for a point that has no value, or that is not calculated yet. If `greatest` is True, greater values are
    better. `limit` is the limit of the output; beyond the value `good`, the output is well on the safe side of it.

    `invalid` and `doubtful` are used only if one field is varied. Both then have an item for each value of this field.
    An item of `invalid` is the reason why the output is not valid, or None if the output is valid. An item of
    `doubtful` is True if the calculation leaves a limit of validity.
    """

    x: Coordinate
    y: Coordinate | None
    output: Axis
    values: Values
    greatest: bool = False
    limit: float | None = None
    good: float | None = None
    invalid: tuple[str | None, ...] = ()
    doubtful: tuple[bool, ...] = ()
    unsolved: int = 0

    @property
    def fields(self) -> list[Coordinate]:
        """The varied fields."""
        return [self.x] if self.y is None else [self.x, self.y]

    @property
    def is_constant(self) -> bool:
        """Whether the output is the same at all of several points."""
        return is_constant(self.values[np.isfinite(self.values)])

    @property
    def without_effect(self) -> list[Coordinate]:
        """The fields that do not change the output, if another one does."""
        if self.y is None or self.is_constant or not np.isfinite(self.values).all():
            return []
        least = NOISE * float(np.abs(self.values).max())
        return [field for axis, field in enumerate(self.fields) if np.ptp(self.values, axis=axis).max() <= least]

    @property
    def best(self) -> tuple[int, ...] | None:
        """Index of the best value, or of the first of several equally good values; None if no value is finite."""
        if not np.isfinite(self.values).any():
            return None
        flat = np.nanargmax(self.values) if self.greatest else np.nanargmin(self.values)
        return tuple(int(place) for place in np.unravel_index(flat, self.values.shape))


def figures_of(grid: Grid) -> dict[str, Figure]:
    """Return the figures of a sweep. The keys are the names of the figures."""
    if grid.y is None:
        return {"curve": curve(grid)}
    if grid.y.words or grid.y.values.size <= MOST_CURVES:
        return {"family": family(grid, grid.y)}
    forgiven = {"worst": worst(grid, grid.y)} if grid.x.scatters else {}
    return {"map": chart(grid, grid.y), **forgiven}


def curve(grid: Grid) -> Figure:
    """Draw the output over the varied field."""
    x, own = grid.x, grid.x.own
    line = Line(grid.output.title, x.values, grid.values, named=False)
    levels, spans, start = verdict_levels(grid), list[Span](), 0
    if own is not None and x.values[0] <= own <= x.values[-1]:
        levels.append(Level(own, f"this case: {number(own, x.axis.unit)}", vertical=True))
    for reason, group in groupby(grid.invalid):
        stop = start + len(list(group))
        if reason is not None:
            spans.append(Span(float(x.values[start]), float(x.values[stop - 1]), reason))
        start = stop
    doubtful = [at for at, doubt in enumerate(grid.doubtful) if doubt and np.isfinite(grid.values[at])]
    rings = [replace(line.mark(at, ""), hue=Hue.ORANGE) for at in doubtful]
    crossings = [Mark(at.place, grid.limit or 0.0, at.named(x.axis)) for at in _crossings(grid)]
    finding = _finding(grid)
    if grid.best is not None and any(grid.doubtful):
        finding += "; orange rings: doubtful, outside a limit of validity"
    if grid.best is not None and crossings:
        finding = f"crosses its limit at {listed([mark.text for mark in crossings])}; {finding}"
    marks = [*rings, *crossings, *parts.extreme([line], grid.output.unit, least=not grid.greatest)]
    panel = Panel(x=x.axis, y=_ordinate(grid), lines=[line], levels=levels, spans=spans, marks=marks)
    return _figure(grid, f"{grid.output.title} over {x.axis.title}", panel, finding)


def family(grid: Grid, y: Coordinate) -> Figure:
    """Draw the output over the first field, with a curve for each value of the second field."""
    lines = [
        Line(y.named(index), grid.x.values, grid.values[:, index], ORDER[index % len(ORDER)])
        for index in range(y.values.size)
    ]
    marks = parts.extreme(lines, grid.output.unit, least=not grid.greatest)
    panel = Panel(x=grid.x.axis, y=_ordinate(grid), lines=lines, levels=verdict_levels(grid), marks=marks)
    title = f"{grid.output.title} over {grid.x.axis.title}, by {y.axis.title}"
    return _figure(grid, title, panel, _finding(grid))


def chart(grid: Grid, y: Coordinate) -> Figure:
    """Draw the output over both fields as a map, with a mark at the best point."""
    x, output = grid.x, grid.output
    finite = grid.values[np.isfinite(grid.values)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
    ends = (low, high) if high > low else (low - 0.5, low + 0.5)
    critical = [replace(level, limit=False) for level in verdict_levels(grid)]
    colours = Map(output.title, output.unit, x.values, y.values, grid.values.T, critical=critical, range=ends)
    marks = [] if grid.best is None else [parts.extreme_of_map(colours, least=not grid.greatest)]
    if x.own is not None and y.own is not None:
        marks.append(Mark(x.own, y.own, "as described", Hue.VERMILLION))
    title = f"{output.title} over {x.axis.title} and {y.axis.title}"
    return _figure(grid, title, Panel(x=x.axis, y=y.axis, map=colours, marks=marks), _finding(grid))


def worst(grid: Grid, y: Coordinate) -> Figure:
    """Draw the worst output at each value of the second field.

    The worst output is taken over all values of the first field. If one of these outputs is unknown, the worst output
    is unknown, too.
    """
    x, finding = grid.x, ""
    reached = grid.values.min(axis=0) if grid.greatest else grid.values.max(axis=0)
    lines = [Line("worst", y.values, reached, ORDER[1])]
    if x.own is not None and (at := np.flatnonzero(np.isclose(x.values, x.own))).size:
        lines.append(Line(f"at {x.named(int(at[0]))}", y.values, grid.values[at[0]], ORDER[0]))
    marks = parts.extreme(lines[:1], grid.output.unit, least=not grid.greatest)
    for mark in marks:
        side = "above" if grid.greatest else "below"
        place = y.named(int(np.flatnonzero(y.values == mark.x)[0]))
        finding = f"{y.axis.title} {place} keeps {grid.output.title} {side} {mark.text}"
    panel = Panel(x=y.axis, y=_ordinate(grid), lines=lines, levels=verdict_levels(grid), marks=marks)
    span = f"{number(float(x.values[0]))} to {number(float(x.values[-1]), x.axis.unit)}"
    return _figure(grid, f"Which {y.axis.title} forgives {x.axis.title} from {span}?", panel, finding)


def _figure(grid: Grid, title: str, panel: Panel, finding: str) -> Figure:
    return Figure(finding, [panel], title=title[0].upper() + title[1:], unsolved=grid.unsolved)


def _finding(grid: Grid) -> str:
    """Return the best value of the output, and the values of the varied fields at this point, as text."""
    if grid.best is None:
        return ""
    value, found = number(float(grid.values[grid.best]), grid.output.unit), [*zip(grid.fields, grid.best, strict=True)]
    if grid.is_constant:
        return f"{value} at every point"
    places = [f"{field.axis.title} {field.named(index)}" for field, index in found]
    ends = [field.axis.title for field, index in found if field.is_end(index)]
    told = f"{'greatest' if grid.greatest else 'least'} {value} at {', '.join(places)}"
    if ends:
        told += ", where its range ends" if grid.y is None else f"; the range of {listed(ends)} ends there"
    return told


def _ordinate(grid: Grid) -> Axis:
    """Return the axis of the output. The axis includes zero unless the output changes little."""
    finite = np.abs(grid.values[np.isfinite(grid.values)])
    flat = finite.size > 0 and finite.min() > FLAT * finite.max()
    return replace(grid.output, magnitude=not flat)


def verdict_levels(grid: Grid) -> list[Level]:
    """Return the lines of the verdict: the limit, and where the output is well on its safe side, unless that is far."""
    if grid.limit is None:
        return []
    unit, finite = grid.output.unit, grid.values[np.isfinite(grid.values)]
    lines = [Level(grid.limit, f"limit {number(grid.limit, unit)}", limit=True)]
    good = grid.good
    if good is not None and finite.size and finite.min() - NEAR * abs(good) <= good <= finite.max() + NEAR * abs(good):
        lines.append(Level(good, f"well {'above' if grid.greatest else 'below'} it: {number(good, unit)}"))
    return lines


class Crossing(NamedTuple):
    """A crossing of a curve and its limit: the abscissa of the crossing, and the error of this abscissa."""

    place: float
    error: float

    def named(self, axis: Axis) -> str:
        """Return the abscissa and its unit as text. The error of the abscissa determines the number of digits."""
        glue = "" if axis.unit in {None, "", "°"} else " "
        return f"{to_digits(self.place, self.error)}{glue}{axis.unit or ''}"


def _crossings(grid: Grid) -> list[Crossing]:
    """Return the points at which a curve crosses its limit, interpolated linearly between the points of the curve.

    The error of this interpolation is estimated with the second divided difference of three points of the curve. If the
    curve has only two points, the error is the distance between these points.
    """
    if grid.limit is None or grid.x.words:
        return []
    x, beyond = grid.x.values, grid.values - grid.limit
    crossings = []
    for before in np.flatnonzero(beyond[:-1] * beyond[1:] < 0.0).tolist():
        start, stop = float(x[before]), float(x[before + 1])
        slope = (beyond[before + 1] - beyond[before]) / (stop - start)
        place = start - float(beyond[before] / slope)
        triples = [slice(first, first + 3) for first in (before - 1, before) if 0 <= first <= x.size - 3]
        curvatures = [_second_difference(x[three], beyond[three]) for three in triples]
        errors = [abs(bend / slope) * (place - start) * (stop - place) for bend in curvatures if isfinite(bend)]
        crossings.append(Crossing(place, max(errors, default=stop - start)))
    return crossings


def _second_difference(x: Values, y: Values) -> float:
    """Return the second divided difference of three points."""
    slopes = np.diff(y) / np.diff(x)
    return float((slopes[1] - slopes[0]) / (x[2] - x[0]))


def answer(grid: Grid) -> str:
    """Return the answer to the question of a sweep as a sentence."""
    finite = np.isfinite(grid.values)
    if grid.best is None:
        return ""
    name, unit = grid.output.title, grid.output.unit
    best = _finding(grid)
    if grid.is_constant:
        return f"The {name} does not depend on {'it' if grid.y is None else 'either'}: {best}."
    if grid.without_effect:
        best += f". It does not depend on the {grid.without_effect[0].axis.title}"
    kept = finite & (grid.values >= grid.limit if grid.greatest else grid.values <= grid.limit) if grid.limit else None
    if kept is None:
        if grid.y is not None or grid.x.words or not (finite[0] and finite[-1]):
            return f"The {name}: {best}."
        ends = [f"{number(float(grid.values[at]), unit)} at {grid.x.named(at)}" for at in (0, grid.x.values.size - 1)]
        return f"The {name} goes from {ends[0]} to {ends[1]}; {best}."
    side, limit = ("above", "below")[not grid.greatest], number(grid.limit or 0.0, unit)
    crossings = _crossings(grid) if grid.y is None else []
    if crossings:
        places = listed([crossing.named(grid.x.axis) for crossing in crossings])
        good = grid.x.named(int(np.flatnonzero(kept)[0]))
        return f"The {name} crosses its limit {limit} at about {places}; it is {side} the limit at {good}; {best}."
    span = "at every point" if kept.sum() == finite.sum() else f"at {kept.sum()} of {finite.sum()} points"
    return f"The {name} is {side} its limit {limit} {span if kept.any() else 'at no point'}; {best}."


class Lead(NamedTuple):
    """Slope and crowning of a helix [um], or the tolerances of both [um]."""

    slope: float
    crowning: float


class Influence(NamedTuple):
    """What an input does to an output over its tolerance: the changes with the input lowered and raised by one step.

    A change is None without an answer. `range` is the largest minus the least output over the tolerance.
    """

    name: str
    step: str  # of the input, without a sign
    lowered: float | None
    raised: float | None
    range: float


def influence(output: Axis, value: float, influences: list[Influence]) -> Figure:
    """Draw a line for each input over the outputs at both ends of its tolerance, the most influential input first."""
    moving = [item for item in influences if item.range][:MOST_ROWS]
    title = f"What moves the {output.title} most"
    if not moving:
        return Figure("nothing does", [], title=title)
    rows = [Row(f"{item.name}, ±{item.step.replace(' ', NO_BREAK)}", item.range, dots=_ends(item)) for item in moving]
    finding = (
        f"{number(value, output.unit)} now; {listed([item.name for item in moving[:NAMED]])} first; − lowered, + raised"
    )
    axis = Axis(f"change of the {output.title} over the tolerance", difference_unit(output.unit), magnitude=False)
    levels = [Level(0.0, "this case", vertical=True)]
    return Figure(finding, [Panel(x=axis, y=Axis("input"), rows=rows, levels=levels)], title=title)


def _ends(item: Influence) -> list[Row]:
    """Return the dots of an input: one for each end of its tolerance, or one for both where they do the same."""
    known = {sign: change for sign, change in (("−", item.lowered), ("+", item.raised)) if change is not None}
    ends = [*known.values()]
    if len(ends) == 2 and abs(ends[0] - ends[1]) < ALIKE * item.range:
        return [Row("", 0.0, Hue.GREY), Row("±", max(ends, key=abs), Hue.VERMILLION)]
    hues = {"−": Hue.BLUE, "+": Hue.VERMILLION}
    return [Row("", 0.0, Hue.GREY), *(Row(sign, change, hues[sign]) for sign, change in known.items())]


def corners(output: Axis, rows: list[Row], nominal: float | None) -> Figure:
    """Draw a row for each uncertain input, with a dot for each value of the input.

    A corner is a combination of values of all uncertain inputs. The dot for a value of an input shows the worst output
    of all corners with this value. The worst of these dots is red. `nominal` is the output of the case as described.
    """
    levels = []
    if nominal is not None:
        levels = [Level(nominal, f"as described {number(nominal, output.unit)}", vertical=True)]
    finding = f"worst {number(rows[0].value, output.unit)}, where the values in red meet"
    panel = Panel(x=replace(output, magnitude=False), y=Axis("uncertain input"), rows=rows, levels=levels)
    return Figure(finding, [panel], title="The worst that each uncertain input can lead to")


def lead_chart(
    position: Values, face_fraction: Values, wanted: Lead, before: Lead, tolerance: Lead, ends: tuple[str, str]
) -> Figure:
    """Draw the lead chart of the helix to grind, with its tolerances. Removed material is drawn downwards.

    `position` is the position on the axis of the unit [mm]. `wanted` is the lead to grind, and `before` is the lead
    that the case describes. `ends` holds the names of the two ends of the face.
    """
    eta = face_fraction - 0.5

    def depth(slope: float, crowning: float) -> Values:
        """Return the depth of the material to remove [um], measured from the unmodified helix."""
        return slope * eta + 4.0 * crowning * eta**2

    ground = -depth(*wanted)
    off = depth(0.0, tolerance.crowning) + np.abs(depth(tolerance.slope, 0.0))
    panel = Panel(
        x=Axis("position on the unit's axis Z", "mm", magnitude=False),
        y=Axis("flank, removed material downwards", "µm", magnitude=False),
        lines=[
            Line("to grind", position, ground),
            Line("as described", position, -depth(*before), Hue.GREY, Role.REFERENCE),
        ],
        ribbons=[Ribbon("tolerance", position, ground - off, ground + off)],
    )
    low, high = sorted(zip(position[[0, -1]], ends, strict=True))
    finding = f"left {low[1]}, right {high[1]}; shaded: tolerances"
    return Figure(finding, [panel], title="Lead chart of the pinion's working flank")


def price(rows: Sequence[Row], finding: str) -> Figure:
    """Draw the probability of damage for exact flanks and for each quality class, with its 90 % intervals."""
    axis = Axis("probability of damage", "%")
    panel = Panel(x=axis, y=Axis("quality class"), rows=rows)
    return Figure(finding, [panel], title="What a tolerance of the flanks costs")


def dominating(shares: dict[str, float]) -> Figure:
    """Draw the share that each input has in the squared changes of the margin to damage, the largest first."""
    rows = [Row(name, 100.0 * share) for name, share in shares.items()][:MOST_ROWS]
    axis = Axis("share of the squared changes of the margin", "%")
    finding = f"{rows[0].name} matters most" if rows else ""
    return Figure(finding, [Panel(x=axis, y=Axis("input"), rows=rows)], title="What the damage depends on")


def search(output: Axis, objectives: Sequence[float | None], *, greatest: bool, where: str) -> Figure:
    """Draw the output for each of the corrections that a search has tried; `where` says at what each is judged.

    An item of `objectives` is the output of one correction; None if the calculation has no solution.
    """
    reached = values(objectives)
    so_far = np.fmax.accumulate(reached) if greatest else np.fmin.accumulate(reached)
    order = np.arange(1, reached.size + 1, dtype=np.float64)
    lines = [Line("tried", order, reached, Hue.GREY, Role.REFERENCE), Line("best so far", order, so_far)]
    marks = [replace(mark, hue=Hue.BLUE) for mark in parts.extreme(lines[:1], output.unit, least=not greatest)]
    x = Axis("correction tried", magnitude=False)
    y = replace(output, title=f"{output.title} {where}", magnitude=False)
    panel = Panel(x=x, y=y, lines=lines, marks=marks)
    finding = f"from {number(float(reached[0]), output.unit)} to {number(float(so_far[-1]), output.unit, digits=4)}"
    title = f"What the search reached {where}"
    return Figure(finding, [panel], title=title, unsolved=list(objectives).count(None))
