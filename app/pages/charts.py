"""The figures of a case on a page: an image in its address, values for the pointer, a table below."""

import base64
import json
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.figures.comparison import compared
from app.figures.data import Bars, Figure, Line, NoFigure, Panel, Role, ThemeName, Values
from app.figures.declaration import Declaration
from app.figures.drawing.style import WIDTH
from app.figures.registry import figures_of
from app.figures.rendering import written
from app.figures.tables import columns_of
from app.pages.cases import Case

VARIANT = "variant A"
MOST_LINES = 200
DIGITS = 6


@dataclass(frozen=True, slots=True)
class Chart:
    """A figure ready to be shown; `width` and `height` are in pixels.

    `series` is JSON for the script, `study` too: the points of a sweep, each of which opens its case.
    """

    name: str
    title: str
    subtitle: str
    image: str
    width: int
    height: int
    series: str
    header: tuple[str, ...]
    lines: tuple[tuple[str, ...], ...]
    more: int
    study: str = ""


@dataclass(frozen=True, slots=True)
class Missing:
    """A figure that the case does not have, why, and the field that decides it."""

    title: str
    reason: str
    field: str | None


def figure_of(declaration: Declaration, case: Case, variant: Case | None) -> Figure:
    """The data of one figure, with the variant's beside it where that has the figure; raises NoFigure."""
    figure = declaration.figure(case.request, case.response)
    if variant is None:
        return figure
    try:
        other = declaration.figure(variant.request, variant.response)
    except NoFigure:
        return figure
    return compared(figure, other, VARIANT)


def charts(case: Case, variant: Case | None, theme: ThemeName) -> tuple[list[Chart], list[Missing]]:
    """Every figure of a case, and those that it lacks."""
    found, missing = [], []
    for declaration in figures_of(case.calculation.path):
        try:
            figure = figure_of(declaration, case, variant)
        except NoFigure as reason:
            missing.append(Missing(declaration.title, reason.message, reason.field))
        else:
            found.append(chart_of(declaration.name, figure, theme))
    return found, missing


def chart_of(name: str, figure: Figure, theme: ThemeName) -> Chart:
    """A figure drawn, with its values."""
    from app.figures.drawing.image import arranged  # noqa: PLC0415  only workers draw

    columns = columns_of(figure)
    cells = [column.cells(MOST_LINES) for column in columns]
    slots, height = arranged(figure)
    count = max((len(column.content) for column in columns), default=0)
    lines = (tuple(_cell(each, index) for each in cells) for index in range(min(count, MOST_LINES)))
    return Chart(
        name=name,
        title=figure.title,
        subtitle=figure.subtitle,
        image=embedded(written(figure, "svg", theme)),
        width=round(100 * WIDTH),
        height=round(100 * height),
        series=json.dumps([_panel(slot, height) for slot in slots if slot.panel.lines or slot.panel.bars]),
        header=tuple(column.header for column in columns),
        lines=tuple(lines),
        more=max(count - MOST_LINES, 0),
    )


def embedded(image: bytes) -> str:
    """An image as an address that holds it."""
    return "data:image/svg+xml;base64," + base64.b64encode(image).decode()


def _cell(cells: list[str], index: int) -> str:
    if index >= len(cells):
        return ""
    try:
        return f"{float(cells[index]):.{DIGITS}g}".replace("-", "−")
    except ValueError:
        return cells[index]


def _panel(slot: Any, height: float) -> dict[str, Any]:
    """Where a panel lies, as fractions of the image, and its curves."""
    from app.figures.drawing.canvas import ranges  # noqa: PLC0415  only workers draw

    panel: Panel = slot.panel
    x, _ = ranges(panel, slot.width, slot.height)
    return {
        "box": [slot.left / WIDTH, slot.top / height, slot.width / WIDTH, slot.height / height],
        "range": [x.low, x.high, x.log],
        "name": panel.x.title,
        "unit": panel.x.unit or "",
        "curves": [*(_curve(panel, line) for line in panel.lines), *(_curve(panel, bars) for bars in panel.bars)],
    }


def _curve(panel: Panel, series: Line | Bars) -> dict[str, Any]:
    ordinate = series.height if isinstance(series, Bars) else series.y
    name = f"{series.title} ({VARIANT})" if series.role is Role.VARIANT else series.title
    return {"name": name, "unit": panel.y.unit or "", "x": _numbers(series.x), "y": _numbers(ordinate)}


def _numbers(values: Values) -> list[float | None]:
    return [None if np.isnan(value) else float(f"{value:.{DIGITS}g}") for value in values.tolist()]
