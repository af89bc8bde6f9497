"""The figures of a case on a page: where their images are, and what the script and the table of values show of them."""

import base64
import json
from collections.abc import Iterable
from dataclasses import dataclass, field
from itertools import zip_longest
from typing import Any

import numpy as np

from app.figures import written
from app.figures.comparison import compared
from app.figures.data import Figure, NoFigure, Role, ThemeName, Values
from app.figures.declaration import Declaration
from app.figures.tables import Item, columns_of
from app.pages.cases import Asked, Case

VARIANT = "variant A"
MOST_LINES = 200  # of a table on a page; the file has all
DIGITS = 6  # more than any solver's tolerance leaves
PIXELS = 100  # of an inch


@dataclass(frozen=True, slots=True)
class Chart:
    """A figure on a page.

    `image` is the address of its image, `dark` that of the one for dark pages if there are two. Its values are either
    at the address `values`, or in `content`, as JSON, and in `table`; `study` is JSON too: the points of a sweep, each
    of which opens its case. `size` is width and height in pixels, None where they are not known before the figure is
    drawn.
    """

    name: str
    title: str
    subtitle: str
    image: str
    dark: str = ""
    size: tuple[int, int] | None = None
    values: str = ""
    content: str = ""
    table: dict[str, Any] = field(default_factory=dict)
    study: str = ""


def figure_of(declaration: Declaration, case: Case, variant: Case | None) -> Figure:
    """The data of one figure, and of the variant beside it, if the variant has the figure; raises NoFigure."""
    figure = declaration.figure(case.request, case.response)
    if variant is None:
        return figure
    try:
        other = declaration.figure(variant.request, variant.response)
    except NoFigure:
        return figure
    return compared(figure, other, VARIANT)


def figures_of(
    case: Case, variant: Case | None, *, compute: bool = False
) -> tuple[list[tuple[Declaration, Figure | None]], list[tuple[str, NoFigure]]]:
    """The figures that the page of a case shows, and the titles of those that it lacks with the reasons.

    The data of figures that need more than the answer are None unless `compute` asks for them.
    """
    found, missing = [], []
    for declaration in case.calculation.figures:
        if not declaration.shown_at and declaration.is_asked(case.request):
            known = compute or declaration.compute is None
            try:
                found.append((declaration, figure_of(declaration, case, variant) if known else None))
            except NoFigure as reason:
                missing.append((declaration.title, reason))
    return found, missing


def linked(declaration: Declaration, figure: Figure | None, asked: Asked) -> Chart:
    """A figure whose image and values are at addresses of their own, dark on dark pages unless the page has a theme."""
    return Chart(
        name=declaration.name,
        title=figure.title if figure else declaration.title,
        subtitle=figure.subtitle if figure else declaration.source,
        image=asked.image(declaration.name, "svg"),
        dark="" if asked.theme else asked.image(declaration.name, "svg", theme="dark"),
        size=_pixels(figure) if figure else None,
        values=asked.image(declaration.name, "json"),
    )


def embedded(name: str, figure: Figure, theme: ThemeName | None) -> Chart:
    """A figure that is a part of the page with its values; dark on dark pages unless the page has a theme."""
    return Chart(
        name=name,
        title=figure.title,
        subtitle=figure.subtitle,
        image=data_address(figure, theme or "light"),
        dark="" if theme else data_address(figure, "dark"),
        size=_pixels(figure),
        content=json.dumps({"panels": _panels(figure)}),
        table=_table(figure),
    )


def _pixels(figure: Figure) -> tuple[int, int]:
    from app.figures.drawing.image import size  # noqa: PLC0415  only workers draw

    width, height = size(figure)
    return round(PIXELS * width), round(PIXELS * height)


def data_address(figure: Figure, theme: ThemeName = "light") -> str:
    """An address that holds the image of a figure."""
    return "data:image/svg+xml;base64," + base64.b64encode(written(figure, "svg", theme)).decode()


def in_columns(figures: Iterable[Figure]) -> list[Figure]:
    """Return the figures in the order in which a report in two columns sets them.

    Beside a figure that fits into a column stands the one of the nearest height. A figure that needs the whole width
    stays as it is; such figures come last.
    """
    from app.figures.drawing.image import narrowed, size  # noqa: PLC0415  only workers draw

    placed = [narrowed(figure) for figure in figures]
    left, ordered = [(size(figure)[1], figure) for figure in placed if figure.narrow], list[Figure]()
    while left:
        height, figure = left.pop(0)
        nearest = min(range(len(left)), key=lambda place: abs(left[place][0] - height), default=None)
        ordered += [figure] if nearest is None else [figure, left.pop(nearest)[1]]
    return ordered + [figure for figure in placed if not figure.narrow]


def values_of(figure: Figure) -> bytes:
    """JSON of where the panels lie in the image, their curves, and the table of values."""
    return json.dumps({"panels": _panels(figure), **_table(figure)}).encode()


def _table(figure: Figure) -> dict[str, Any]:
    """The header of a table of the figure's numbers, its first lines, and how many more there are."""
    columns = columns_of(figure)
    cells = [map(_cell, column.content[:MOST_LINES]) for column in columns]
    count = max((len(column.content) for column in columns), default=0)
    return {
        "header": tuple(column.header for column in columns),
        "lines": tuple(zip_longest(*cells, fillvalue="")),
        "more": max(count - MOST_LINES, 0),
    }


def _cell(item: Item) -> str:
    if item is None or isinstance(item, str):
        return item or ""
    return f"{item:.{DIGITS}g}".replace("-", "−")


def _panels(figure: Figure) -> list[dict[str, Any]]:
    """Where each panel with curves lies, as fractions of the image, and its curves."""
    from app.figures.drawing.image import places  # noqa: PLC0415  only workers draw

    found = []
    for place in places(figure):
        panel, curves = place.panel, []
        for series in (*panel.lines, *panel.bars):
            name = f"{series.title} ({VARIANT})" if series.role is Role.VARIANT else series.title
            curve = {"name": name, "unit": panel.y.unit or "", "x": _numbers(series.x), "y": _numbers(series.y)}
            curves.append(curve)
        if curves:
            x = {"range": place.x, "name": panel.x.title, "unit": panel.x.unit or ""}
            found.append({"box": place.box, **x, "curves": curves})
    return found


def _numbers(values: Values) -> list[float | None]:
    return [None if np.isnan(value) else float(f"{value:.{DIGITS}g}") for value in values.tolist()]
