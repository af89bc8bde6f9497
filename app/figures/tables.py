"""The numbers of a figure as CSV, with units in the header."""

from collections.abc import Iterable, Iterator
from itertools import zip_longest
from math import isnan
from typing import NamedTuple

import numpy as np

from app.figures.data import Axis, Figure, Panel, Role, Row
from app.spreadsheet import csv_of

Item = float | str | None


class Column(NamedTuple):
    """A header and the names or numbers below the header. None stands for a missing value."""

    header: str
    content: tuple[Item, ...]


def table(figure: Figure) -> bytes:
    """Write the numbers of a figure as CSV; a missing value is an empty cell."""
    columns = columns_of(figure)
    return csv_of([[column.header for column in columns], *zip_longest(*(column.content for column in columns))])


def columns_of(figure: Figure) -> list[Column]:
    """Return all columns; an abscissa that several series share appears once."""
    columns = dict[Column, None]()
    for panel in figure.panels:
        prefix = f"{panel.title}: " if panel.title else ""
        for header, items in _columns(panel):
            content = (None if isinstance(item, float) and isnan(item) else item for item in items)
            columns[Column(prefix + header, tuple(content))] = None
    return list(columns)


def _columns(panel: Panel) -> Iterator[tuple[str, Iterable[Item]]]:
    """Yield the headers and the contents of all columns of a panel."""
    abscissa = _header(panel.x.title, panel.x)
    for line in (*panel.bars, *panel.lines, *panel.shapes):
        name = line.title if line.title == panel.y.title else f"{line.title}: {panel.y.title}"
        yield abscissa, line.x.tolist()
        yield _header(name, panel.y) + " (variant)" * (line.role is Role.VARIANT), line.y.tolist()
    for ribbon in panel.ribbons:
        yield abscissa, ribbon.x.tolist()
        yield _header(f"{ribbon.title}, lower edge", panel.y), ribbon.low.tolist()
        yield _header(f"{ribbon.title}, upper edge", panel.y), ribbon.high.tolist()
    if panel.rows:
        yield from _row_columns(panel)
    if panel.map is not None:
        y, x = np.meshgrid(panel.map.y, panel.map.x, indexing="ij")
        yield _header(panel.y.title, panel.y), y.ravel().tolist()
        yield abscissa, x.ravel().tolist()
        yield f"{panel.map.title} [{panel.map.unit or '-'}]", panel.map.values.ravel().tolist()
    for level in panel.levels:
        yield _header(level.name, panel.x if level.vertical else panel.y), [level.value]


def _row_columns(panel: Panel) -> Iterator[tuple[str, Iterable[Item]]]:
    own = [row for row in panel.rows if row.role is not Role.VARIANT]
    if any(row.dots for row in own):
        own = [Row(f"{row.name} {dot.name}", dot.value) for row in own for dot in row.dots]
    abscissa = _header(panel.x.title, panel.x)
    yield "name", [row.name for row in own]
    yield abscissa, [row.value for row in own]
    for name in dict.fromkeys(part.name for row in own for part in row.parts):
        shares = [sum((part.value for part in row.parts if part.name == name), 0.0) for row in own]
        yield _header(name, panel.x), shares
    variant = {row.name: row.value for row in panel.rows if row.role is Role.VARIANT}
    if variant:
        yield f"{abscissa} (variant)", [variant.get(row.name) for row in own]
    if any(row.bounds for row in own):
        for side, name in enumerate(("lower bound", "upper bound")):
            yield _header(name, panel.x), [row.bounds[side] if row.bounds else None for row in own]


def _header(title: str, axis: Axis) -> str:
    return f"{title} [{axis.unit or '-'}]"
