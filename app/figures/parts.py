"""Parts that figures of several models share: curves and orders of a result, extremes of curves and maps."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np

from app.figures.data import ORDER, Axis, Hue, Level, Line, Map, Mark, Panel, Span, Values, values
from app.figures.wording import number

Named = TypeVar("Named", Level, Span)


def curve(
    x: Axis, y: Axis, along: Values, data: Values, hue: Hue = Hue.BLUE, *, marked: bool = False, **panel: Any
) -> Panel:
    """Return a panel of one curve, which its ordinate names. If `marked`, mark its greatest value above zero."""
    line = Line(y.title, along, data, hue, named=False)
    marks = extreme([line], y.unit) if marked and np.nanmax(line.y, initial=0.0) > 0.0 else []
    return Panel(x=x, y=y, lines=[line], marks=marks, **panel)


def lines(along: Values, series: Mapping[str, Sequence[float] | Values]) -> list[Line]:
    """Return lines over one abscissa from data by title, in the order of the hues."""
    return [Line(title, along, values(data), hue) for (title, data), hue in zip(series.items(), ORDER, strict=False)]


def orders(title: str, y: Axis, first: int, series: Mapping[str, Sequence[float] | Values], symbol: str = "") -> Panel:
    """Return a panel with bars of amplitudes over their orders, which begin at `first`."""
    count = max(len(data) for data in series.values())
    order = np.arange(first, first + count, dtype=np.float64)
    x = Axis(title, magnitude=False, ticks=order.tolist(), symbol=symbol)
    return Panel(x=x, y=y, bars=lines(order, series))


def extreme(curves: Sequence[Line], unit: str | None = None, *, least: bool = False) -> list[Mark]:
    """Return a mark at the greatest or least value of the lines, with this value; none if no point has a value."""
    pick, at = (min, np.nanargmin) if least else (max, np.nanargmax)
    extremes = [(line, int(at(line.y))) for line in curves if np.isfinite(line.y).any()]
    if not extremes:
        return []
    line, place = pick(extremes, key=lambda at_line: float(at_line[0].y[at_line[1]]))
    return [line.mark(place, number(float(line.y[place]), unit))]


def extreme_of_map(chart: Map, wording: Callable[..., str] = number, *, least: bool = False) -> Mark:
    """Return a mark at the greatest or least value of a map, with this value."""
    at = int(np.nanargmin(chart.values) if least else np.nanargmax(chart.values))
    row, column = np.unravel_index(at, chart.values.shape)
    text = wording(float(chart.values[row, column]), chart.unit)
    return Mark(float(chart.x[column]), float(chart.y[row]), text)


def unnamed(items: Iterable[Named]) -> list[Named]:
    """Return the same levels or spans without names, for panels below the one that names them."""
    return [replace(item, name="") for item in items]
