"""The figures on a page: the addresses of their images, their values for the page's script, and their tables."""

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
from app.pages.cases import Asked, SolvedCase

VARIANT = "variant A"
MOST_LINES = 200  # largest number of lines of a table on a page; the CSV file of the figure has all lines
DIGITS = 6  # significant digits; because of the tolerances of the solvers, fewer digits are accurate
PIXELS = 100  # per inch


@dataclass(frozen=True, slots=True)
class Chart:
    """A figure on a page.

    `image` is the address of the image. `dark` is the address of a second image for dark pages, or an empty text;
    `narrow` and `narrow_dark` are the addresses of the images for phones, or empty texts. The numbers of the figure are
    either loaded from the address `values`, or contained in `content` and `table`. `study` holds the points of a sweep
    and the links to the cases at these points. `content` and `study` are JSON texts. `size` is width and height in
    pixels, or None if the data of the figure are still to be computed.
    """

    name: str
    title: str
    subtitle: str
    image: str
    dark: str = ""
    narrow: str = ""
    narrow_dark: str = ""
    size: tuple[int, int] | None = None
    values: str = ""
    content: str = ""
    table: dict[str, Any] = field(default_factory=dict)
    study: str = ""


def figure_of(declaration: Declaration, case: SolvedCase, variant: SolvedCase | None) -> Figure:
    """Return a figure of the case; raise NoFigure if the case does not have this figure."""
    figure = declaration.figure(case.request, case.response)
    if variant is None:
        return figure
    try:
        other = declaration.figure(variant.request, variant.response)
    except NoFigure:
        return figure
    return compared(figure, other, VARIANT)


def figures_of(
    case: SolvedCase, variant: SolvedCase | None, *, compute: bool = False
) -> tuple[list[tuple[Declaration, Figure | None]], list[tuple[str, NoFigure]]]:
    """Return the figures that the page of a case shows, and the titles of missing figures with the reasons.

    Some figures need more data than the answer holds. If `compute` is False, these figures are not made, and the list
    of figures has None in their places.
    """
    figures, missing = [], []
    for declaration in case.calculation.figures:
        if not declaration.shown_at and declaration.is_asked(case.request):
            has_data = compute or declaration.compute is None
            try:
                figures.append((declaration, figure_of(declaration, case, variant) if has_data else None))
            except NoFigure as reason:
                missing.append((declaration.title, reason))
    return figures, missing


def linked(declaration: Declaration, figure: Figure | None, asked: Asked) -> Chart:
    """Return the chart of a figure. The page loads the image and the values of the chart from separate addresses."""
    return Chart(
        name=declaration.name,
        title=figure.title if figure else declaration.title,
        subtitle=figure.subtitle if figure else declaration.source,
        image=asked.image(declaration.name, "svg"),
        dark="" if asked.theme else asked.image(declaration.name, "svg", theme="dark"),
        narrow=asked.image(declaration.name, "svg", narrow=True),
        narrow_dark="" if asked.theme else asked.image(declaration.name, "svg", theme="dark", narrow=True),
        size=_pixels(figure) if figure else None,
        values=asked.image(declaration.name, "json"),
    )


def embedded(name: str, figure: Figure, theme: ThemeName | None, *, grows: bool) -> Chart:
    """Return the chart of a figure whose image and values are part of the page; one that `grows` is not for phones."""
    narrow = figure if grows else for_phones(figure)
    wide = _images(figure, theme)
    small = ("", "") if narrow is figure else _images(narrow, theme)
    return Chart(
        name=name,
        title=figure.title,
        subtitle=figure.subtitle,
        image=wide[0],
        dark=wide[1],
        narrow=small[0],
        narrow_dark=small[1],
        size=_pixels(figure),
        content=json.dumps({"panels": _panels(figure), "narrow": _panels(narrow)}),
        table=_table(figure),
    )


def _images(figure: Figure, theme: ThemeName | None) -> tuple[str, str]:
    """Return the addresses of a figure's image, and of its image for dark pages if the page has no theme of its own."""
    dark = "" if theme else _data_address(written(figure, "svg", "dark"))
    return _data_address(written(figure, "svg", theme or "light")), dark


def for_phones(figure: Figure) -> Figure:
    """Return a figure that is as narrow as a phone, if its texts allow that."""
    from app.figures.drawing.image import fitted  # noqa: PLC0415  only workers draw

    return fitted(figure)


def _pixels(figure: Figure) -> tuple[int, int]:
    from app.figures.drawing.image import size  # noqa: PLC0415  only workers draw

    width, height = size(figure)
    return round(PIXELS * width), round(PIXELS * height)


def _data_address(image: bytes) -> str:
    """Return an address of the scheme `data:` that contains an image in the format svg."""
    return "data:image/svg+xml;base64," + base64.b64encode(image).decode()


def in_columns(figures: Iterable[Figure]) -> list[tuple[Figure, str]]:
    """Draw the figures for a report with two columns. Return figures and images in the order of the report."""
    from app.figures.drawing.image import draw_for_report, size  # noqa: PLC0415  only workers draw

    placed = [(drawn, _data_address(image)) for drawn, image in map(draw_for_report, figures)]
    left, ordered = [each for each in placed if each[0].narrow], list[tuple[Figure, str]]()
    while left:
        first = left.pop(0)
        ordered.append(first)
        if left:
            height = size(first[0])[1]
            nearest = min(range(len(left)), key=lambda place: abs(size(left[place][0])[1] - height))
            ordered.append(left.pop(nearest))
    return ordered + [each for each in placed if not each[0].narrow]


def values_of(figure: Figure) -> bytes:
    """Return the curves of a figure, the positions of its panels in the image, and its table of values, as JSON.

    `narrow` has the positions in the image for phones.
    """
    return json.dumps({"panels": _panels(figure), "narrow": _panels(for_phones(figure)), **_table(figure)}).encode()


def _table(figure: Figure) -> dict[str, Any]:
    """Return the table of the figure's numbers: its header, its first lines and the number of further lines."""
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
    """Return the curves of each panel, and the position of the panel as fractions of the image."""
    from app.figures.drawing.image import places  # noqa: PLC0415  only workers draw

    panels = []
    for place in places(figure):
        panel, curves = place.panel, []
        for series in (*panel.lines, *panel.bars):
            name = f"{series.title} ({VARIANT})" if series.role is Role.VARIANT else series.title
            curve = {"name": name, "unit": panel.y.unit or "", "x": _numbers(series.x), "y": _numbers(series.y)}
            curves.append(curve)
        if curves:
            x = {"range": place.x, "name": panel.x.title, "unit": panel.x.unit or ""}
            panels.append({"box": place.box, **x, "curves": curves})
    return panels


def _numbers(values: Values) -> list[float | None]:
    return [None if np.isnan(value) else float(f"{value:.{DIGITS}g}") for value in values.tolist()]
