"""A figure's numbers as CSV, a column each, units in the header."""

import csv
from io import StringIO

import numpy as np

from app.figures.data import Axis, Figure, Map, Panel, Role, Values

Column = tuple[str, list[str]]


def table(figure: Figure) -> bytes:
    """All columns beside each other; a missing value is an empty cell."""
    columns = columns_of(figure)
    lines = max((len(cells) for _, cells in columns), default=0)
    text = StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow([header for header, _ in columns])
    for index in range(lines):
        writer.writerow([cells[index] if index < len(cells) else "" for _, cells in columns])
    return text.getvalue().encode()


def columns_of(figure: Figure) -> list[Column]:
    """Header and cells of every column."""
    return _without_repeats([column for panel in figure.panels for column in _columns(panel)])


def _columns(panel: Panel) -> list[Column]:
    """Abscissa and ordinate of each line and bar; names and values of rows; maps point by point; limits."""
    prefix = f"{panel.title}: " if panel.title else ""
    columns: list[Column] = []
    series = [(bars.title, bars.role, bars.x, bars.height) for bars in panel.bars]
    series += [(line.title, line.role, line.x, line.y) for line in panel.lines]
    for title, role, abscissa, ordinate in series:
        name = title if title == panel.y.title else f"{title}: {panel.y.title}"
        variant = " (variant)" if role is Role.VARIANT else ""
        columns.append((prefix + _header(panel.x), _cells(abscissa)))
        columns.append((f"{prefix}{_header(Axis(name, panel.y.unit))}{variant}", _cells(ordinate)))
    for ribbon in panel.ribbons:
        columns.append((prefix + _header(panel.x), _cells(ribbon.x)))
        for name, edge in (("lower edge", ribbon.low), ("upper edge", ribbon.high)):
            columns.append((f"{prefix}{_header(Axis(f'{ribbon.title}, {name}', panel.y.unit))}", _cells(edge)))
    if panel.rows:
        columns += _row_columns(panel, prefix)
    if panel.map is not None:
        columns += _map_columns(panel, panel.map, prefix)
    for level in panel.levels:
        axis = panel.x if level.vertical else panel.y
        columns.append((f"{prefix}{level.name} [{axis.unit or '-'}]", _cells(np.array([level.value]))))
    return columns


def _row_columns(panel: Panel, prefix: str) -> list[Column]:
    own = [row for row in panel.rows if row.role is not Role.VARIANT]
    columns: list[Column] = [
        (f"{prefix}name", [row.name for row in own]),
        (prefix + _header(panel.x), _cells(np.array([row.value for row in own]))),
    ]
    variant = {row.name: row.value for row in panel.rows if row.role is Role.VARIANT}
    if variant:
        columns.append(
            (f"{prefix}{_header(panel.x)} (variant)", _cells(np.array([variant.get(row.name, np.nan) for row in own])))
        )
    if any(row.bounds for row in own):
        for side, name in enumerate(("lower bound", "upper bound")):
            bounds = np.array([row.bounds[side] if row.bounds else np.nan for row in own])
            columns.append((f"{prefix}{_header(Axis(name, panel.x.unit))}", _cells(bounds)))
    return columns


def _map_columns(panel: Panel, chart: Map, prefix: str) -> list[Column]:
    y, x = np.meshgrid(chart.y, chart.x, indexing="ij")
    axis = Axis(chart.title, chart.unit)
    return [
        (prefix + _header(panel.y), _cells(y.ravel())),
        (prefix + _header(panel.x), _cells(x.ravel())),
        (prefix + _header(axis), _cells(chart.values.ravel())),
    ]


def _header(axis: Axis) -> str:
    return f"{axis.title} [{axis.unit or '-'}]"


def _cells(values: Values) -> list[str]:
    return ["" if np.isnan(value) else repr(value) for value in values.tolist()]


def _without_repeats(columns: list[Column]) -> list[Column]:
    """An abscissa that several series share stands once."""
    kept: list[Column] = []
    for column in columns:
        if column not in kept:
            kept.append(column)
    return kept
