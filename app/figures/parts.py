"""Parts that figures of several models share: panels of curves and of orders, and marks at extremes."""

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
    """Return a panel with one curve. The title of the ordinate names the curve."""
    line = Line(y.title, along, data, hue, named=False)
    marks = extreme([line], y.unit) if marked and np.nanmax(line.y, initial=0.0) > 0.0 else []
    return Panel(x=x, y=y, lines=[line], marks=marks, **panel)


def lines(along: Values, series: Mapping[str, Sequence[float] | Values]) -> list[Line]:
    """Return a line for each title in `series`. The lines share one abscissa and take the hues from `ORDER`."""
    return [Line(title, along, values(data), hue) for (title, data), hue in zip(series.items(), ORDER, strict=False)]


def orders(title: str, y: Axis, first: int, series: Mapping[str, Sequence[float] | Values], symbol: str = "") -> Panel:
    """Return a panel with amplitudes as bars over their orders. The first amplitude has the order `first`."""
    count = max(len(data) for data in series.values())
    order = np.arange(first, first + count, dtype=np.float64)
    x = Axis(title, magnitude=False, ticks=order.tolist(), symbol=symbol)
    return Panel(x=x, y=y, bars=lines(order, series))


def extreme(curves: Sequence[Line], unit: str | None = None, *, least: bool = False) -> list[Mark]:
    """Return a list with one mark at the greatest value of all lines, or at the least value if `least` is set."""
    pick, at = (min, np.nanargmin) if least else (max, np.nanargmax)
    extremes = [(line, int(at(line.y))) for line in curves if np.isfinite(line.y).any()]
    if not extremes:
        return []
    line, place = pick(extremes, key=lambda at_line: float(at_line[0].y[at_line[1]]))
    return [line.mark(place, number(float(line.y[place]), unit))]


def extreme_of_map(chart: Map, wording: Callable[..., str] = number, *, least: bool = False) -> Mark:
    """Return a mark at the greatest value of a map, or at the least value if `least` is set."""
    at = int(np.nanargmin(chart.values) if least else np.nanargmax(chart.values))
    row, column = np.unravel_index(at, chart.values.shape)
    text = wording(float(chart.values[row, column]), chart.unit)
    return Mark(float(chart.x[column]), float(chart.y[row]), text)


def unnamed(items: Iterable[Named]) -> list[Named]:
    """Return copies of levels or spans without their names."""
    return [replace(item, name="") for item in items]
