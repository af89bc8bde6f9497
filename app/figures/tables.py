"""A figure's numbers as CSV, a column each, units in the header."""

import csv
from dataclasses import dataclass
from io import StringIO

import numpy as np

from app.figures.data import Axis, Figure, Map, Panel, Role, Row, Values


@dataclass(frozen=True, slots=True, eq=False)
class Column:
    """A header and what stands below it: numbers, or names."""

    header: str
    content: Values | list[str]

    def cells(self, most: int | None = None) -> list[str]:
        """The first cells as texts; a number in as few digits as give it back, a missing one empty."""
        part = self.content[:most]
        return part if isinstance(part, list) else ["" if np.isnan(value) else repr(value) for value in part.tolist()]

    def repeats(self, other: "Column") -> bool:
        """Whether both say the same."""
        if self.header != other.header or len(self.content) != len(other.content):
            return False
        if isinstance(self.content, list) or isinstance(other.content, list):
            return self.content is other.content
        return bool(np.array_equal(self.content, other.content, equal_nan=True))


def table(figure: Figure) -> bytes:
    """All columns beside each other; a missing value is an empty cell."""
    columns = columns_of(figure)
    filled = [column.cells() for column in columns]
    lines = max(map(len, filled), default=0)
    text = StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow([column.header for column in columns])
    for index in range(lines):
        writer.writerow([cells[index] if index < len(cells) else "" for cells in filled])
    return text.getvalue().encode()


def columns_of(figure: Figure) -> list[Column]:
    """Every column."""
    return _without_repeats([column for panel in figure.panels for column in _columns(panel)])


def _columns(panel: Panel) -> list[Column]:
    """Abscissa and ordinate of each line and bar; names and values of rows; maps point by point; limits."""
    prefix = f"{panel.title}: " if panel.title else ""
    columns: list[Column] = []
    series = [(bars.title, bars.role, bars.x, bars.height) for bars in panel.bars]
    series += [(line.title, line.role, line.x, line.y) for line in panel.lines]
    series += [(shape.title, Role.RESULT, shape.x, shape.y) for shape in panel.shapes]
    for title, role, abscissa, ordinate in series:
        name = title if title == panel.y.title else f"{title}: {panel.y.title}"
        variant = " (variant)" if role is Role.VARIANT else ""
        columns.append(Column(prefix + _header(panel.x), abscissa))
        columns.append(Column(f"{prefix}{_header(Axis(name, panel.y.unit))}{variant}", ordinate))
    for ribbon in panel.ribbons:
        columns.append(Column(prefix + _header(panel.x), ribbon.x))
        for name, edge in (("lower edge", ribbon.low), ("upper edge", ribbon.high)):
            columns.append(Column(f"{prefix}{_header(Axis(f'{ribbon.title}, {name}', panel.y.unit))}", edge))
    if panel.rows:
        columns += _row_columns(panel, prefix)
    if panel.map is not None:
        columns += _map_columns(panel, panel.map, prefix)
    for level in panel.levels:
        axis = panel.x if level.vertical else panel.y
        columns.append(Column(f"{prefix}{level.name} [{axis.unit or '-'}]", np.array([level.value])))
    return columns


def _row_columns(panel: Panel, prefix: str) -> list[Column]:
    own = [row for row in panel.rows if row.role is not Role.VARIANT]
    if any(row.dots for row in own):
        own = [Row(f"{row.name} {dot.title}", dot.value) for row in own for dot in row.dots]
    columns: list[Column] = [
        Column(f"{prefix}name", [row.name for row in own]),
        Column(prefix + _header(panel.x), np.array([row.value for row in own])),
    ]
    titles = dict.fromkeys(part.title for row in own for part in row.parts)
    for title in titles:
        values = [sum(part.value for part in row.parts if part.title == title) for row in own]
        columns.append(Column(f"{prefix}{_header(Axis(title, panel.x.unit))}", np.array(values)))
    variant = {row.name: row.value for row in panel.rows if row.role is Role.VARIANT}
    if variant:
        columns.append(
            Column(f"{prefix}{_header(panel.x)} (variant)", np.array([variant.get(row.name, np.nan) for row in own]))
        )
    if any(row.bounds for row in own):
        for side, name in enumerate(("lower bound", "upper bound")):
            bounds = np.array([row.bounds[side] if row.bounds else np.nan for row in own])
            columns.append(Column(f"{prefix}{_header(Axis(name, panel.x.unit))}", bounds))
    return columns


def _map_columns(panel: Panel, chart: Map, prefix: str) -> list[Column]:
    y, x = np.meshgrid(chart.y, chart.x, indexing="ij")
    axis = Axis(chart.title, chart.unit)
    return [
        Column(prefix + _header(panel.y), y.ravel()),
        Column(prefix + _header(panel.x), x.ravel()),
        Column(prefix + _header(axis), chart.values.ravel()),
    ]


def _header(axis: Axis) -> str:
    return f"{axis.title} [{axis.unit or '-'}]"


def _without_repeats(columns: list[Column]) -> list[Column]:
    """An abscissa that several series share stands once."""
    kept: list[Column] = []
    for column in columns:
        if not any(column.repeats(each) for each in kept):
            kept.append(column)
    return kept
