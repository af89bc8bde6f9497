"""A figure's numbers as CSV, a column each, units in the header."""

from collections.abc import Iterator
from itertools import zip_longest
from typing import Any, NamedTuple

import numpy as np

from app.figures.data import Axis, Figure, Map, Panel, Role, Row, Values
from app.spreadsheet import csv_of


class Column(NamedTuple):
    """A header and what stands below it: numbers, or names."""

    header: str
    content: Values | list[str]

    @property
    def items(self) -> list[Any]:
        """Names, or numbers; None where one is missing."""
        if isinstance(self.content, list):
            return self.content
        return [None if np.isnan(value) else value for value in self.content.tolist()]

    def cells(self, most: int) -> list[str]:
        """The first cells as texts; a number in as few digits as give it back, a missing one empty."""
        return ["" if item is None else str(item) for item in self.items[:most]]


def table(figure: Figure) -> bytes:
    """All columns beside each other; a missing value is an empty cell."""
    columns = columns_of(figure)
    return csv_of([[column.header for column in columns], *zip_longest(*(column.items for column in columns))])


def columns_of(figure: Figure) -> list[Column]:
    """Every column; an abscissa that several series share stands once."""
    columns = (column for panel in figure.panels for column in _columns(panel))
    kept: dict[tuple[str, object], Column] = {}
    for column in columns:
        content = column.content
        kept.setdefault((column.header, tuple(content) if isinstance(content, list) else content.tobytes()), column)
    return list(kept.values())


def _columns(panel: Panel) -> Iterator[Column]:
    """Abscissa and ordinate of each line, bar and polygon; names and values of rows; maps point by point; limits."""
    prefix = f"{panel.title}: " if panel.title else ""
    abscissa = prefix + _header(panel.x.title, panel.x)
    series = [(bars.title, bars.role, bars.x, bars.height) for bars in panel.bars]
    series += [(line.title, line.role, line.x, line.y) for line in panel.lines]
    series += [(shape.title, Role.RESULT, shape.x, shape.y) for shape in panel.shapes]
    for title, role, x, y in series:
        name = title if title == panel.y.title else f"{title}: {panel.y.title}"
        yield Column(abscissa, x)
        yield Column(f"{prefix}{_header(name, panel.y)}{' (variant)' if role is Role.VARIANT else ''}", y)
    for ribbon in panel.ribbons:
        yield Column(abscissa, ribbon.x)
        yield Column(prefix + _header(f"{ribbon.title}, lower edge", panel.y), ribbon.low)
        yield Column(prefix + _header(f"{ribbon.title}, upper edge", panel.y), ribbon.high)
    if panel.rows:
        yield from _row_columns(panel, prefix)
    if panel.map is not None:
        yield from _map_columns(panel, panel.map, prefix)
    for level in panel.levels:
        yield Column(prefix + _header(level.name, panel.x if level.vertical else panel.y), np.array([level.value]))


def _row_columns(panel: Panel, prefix: str) -> Iterator[Column]:
    own = [row for row in panel.rows if row.role is not Role.VARIANT]
    if any(row.dots for row in own):
        own = [Row(f"{row.name} {dot.title}", dot.value) for row in own for dot in row.dots]
    whole = prefix + _header(panel.x.title, panel.x)
    yield Column(f"{prefix}name", [row.name for row in own])
    yield Column(whole, np.array([row.value for row in own]))
    for title in dict.fromkeys(part.title for row in own for part in row.parts):
        parts = [sum(part.value for part in row.parts if part.title == title) for row in own]
        yield Column(prefix + _header(title, panel.x), np.array(parts))
    variant = {row.name: row.value for row in panel.rows if row.role is Role.VARIANT}
    if variant:
        yield Column(f"{whole} (variant)", np.array([variant.get(row.name, np.nan) for row in own]))
    if any(row.bounds for row in own):
        bounds = np.array([row.bounds or (np.nan, np.nan) for row in own])
        for name, side in zip(("lower bound", "upper bound"), bounds.T, strict=True):
            yield Column(prefix + _header(name, panel.x), side)


def _map_columns(panel: Panel, chart: Map, prefix: str) -> Iterator[Column]:
    y, x = np.meshgrid(chart.y, chart.x, indexing="ij")
    yield Column(prefix + _header(panel.y.title, panel.y), y.ravel())
    yield Column(prefix + _header(panel.x.title, panel.x), x.ravel())
    yield Column(f"{prefix}{chart.title} [{chart.unit or '-'}]", chart.values.ravel())


def _header(title: str, axis: Axis) -> str:
    """A title with the unit of an axis."""
    return f"{title} [{axis.unit or '-'}]"
