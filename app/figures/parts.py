"""Parts that figures of several models have: a curve that its ordinate names, the extremes of curves and maps."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from app.figures.data import Axis, Hue, Line, Map, Mark, Panel, Values, values
from app.figures.wording import number


def extreme(lines: Sequence[Line], unit: str | None = None, *, least: bool = False) -> tuple[Mark, ...]:
    """The greatest value of the lines or the least, marked with it; nothing where no point has a value."""
    pick, at = (min, np.nanargmin) if least else (max, np.nanargmax)
    known = [(line, int(at(line.y))) for line in lines if np.isfinite(line.y).any()]
    if not known:
        return ()
    line, place = pick(known, key=lambda each: float(each[0].y[each[1]]))
    value = float(line.y[place])
    return (Mark(float(line.x[place]), value, number(value, unit or ""), line.hue),)


def curve(
    x: Axis, y: Axis, along: Values, data: Values, hue: Hue = Hue.BLUE, *, marked: bool = False, **panel: Any
) -> Panel:
    """A panel of one curve, which its ordinate names; its greatest value marked if asked for and above zero."""
    line = Line(y.title, values(along), values(data), hue, named=False)
    marks = extreme([line], y.unit) if marked and np.nanmax(line.y, initial=0.0) > 0.0 else ()
    return Panel(x=x, y=y, lines=(line,), marks=marks, **panel)


def extreme_of_map(chart: Map, wording: Callable[[float, str], str] = number, *, least: bool = False) -> Mark:
    """The greatest value of a map or the least, marked with it."""
    at = int(np.nanargmin(chart.values) if least else np.nanargmax(chart.values))
    row, column = np.unravel_index(at, chart.values.shape)
    text = wording(float(chart.values[row, column]), chart.unit or "")
    return Mark(float(chart.x[column]), float(chart.y[row]), text)
