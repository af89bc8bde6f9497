"""Images of figures: the layout on a sheet, and the formats. Equal figures give equal bytes."""

from collections.abc import Sequence
from dataclasses import replace
from io import BytesIO
from itertools import combinations, pairwise
from textwrap import fill
from typing import Any, NamedTuple

from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_pdf import FigureCanvasPdf
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure as Sheet
from matplotlib.text import Text
from matplotlib.transforms import Bbox

from app.figures.data import Figure, Panel, ThemeName
from app.figures.drawing.panels import LINE, draw_panel, has_points, legend_lines, place_texts
from app.figures.drawing.style import DPI, NARROW, TEXT, TITLE, WIDTH, themed
from app.figures.wording import subscripts

EDGE = 0.1  # inches; margin around the whole image
TITLE_LENGTH, LENGTH, BESIDE_LENGTH = 58, 84, 30  # characters per line: titles, other texts, names of axes side by side
HEIGHTS = {1: 2.6, 2: 1.6, 3: 1.25}  # inches; height of a panel if this number of panels stand above one another
PLANE, PLANE_BESIDE = 3.3, 1.8  # inches; height of a panel with `equal` or `areas`: alone, and side by side
TOUCH = 0.025  # inches by which the boxes of two texts may overlap, as boxes include space around letters
NARROW_HEIGHT = 0.66  # height of axes in a narrow figure divided by their usual height
ROW_HEIGHT = 0.3  # inches; height of a bar whose name has up to two lines
APART, FEWEST_TICKS = 0.05, 3  # inches, least distance between neighbouring tick labels; least number of ticks
ABSCISSA = 0.45  # inches; height of the tick labels and the name below axes
TICKS = 0.35  # inches; least width of the tick labels to the left of axes
LEGEND, BAR, END = 1.5, 1.1, 0.15  # inches of room to the right of axes that have a legend, a colour bar, or neither
CANVASES = {"svg": FigureCanvasSVG, "png": FigureCanvasAgg, "pdf": FigureCanvasPdf}
# The metadata contain neither date nor version, so that equal figures give equal bytes.
METADATA: dict[str, dict[str, str | None]] = {
    "svg": {"Date": None, "Creator": None},
    "png": {"Software": None},
    "pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}


def draw(figure: Figure, image_format: str, theme: ThemeName = "light") -> bytes:
    """Draw a figure as svg, png or pdf."""
    with themed(theme):
        sheet, _ = laid_out(figure)
        return _written(sheet, figure.title, image_format)


def draw_for_report(figure: Figure) -> tuple[Figure, bytes]:
    """Draw a figure as svg, if possible in the width of a report's column. Return the figure and the svg.

    If the svg has the width of the column, the returned figure is the copy with `narrow` set to True. Panels that
    stand side by side keep the usual width.
    """
    placed = figure if figure.beside else fitted(figure)
    return placed, draw(placed, "svg")


def fitted(figure: Figure) -> Figure:
    """Return the figure in the width of a phone or of a report's column, its panels one above the other.

    The figure is unchanged if its texts would be cut off or overlap in this width.
    """
    narrow = replace(figure, narrow=True, beside=False)
    with themed("light"):
        return figure if _collides(*laid_out(narrow)) else narrow


def _written(sheet: Sheet, title: str, image_format: str) -> bytes:
    """Return a sheet as svg, png or pdf. The layout of the sheet must be complete (see `laid_out`)."""
    sheet.set_dpi(DPI[image_format])
    image, metadata = BytesIO(), METADATA[image_format] | {"Title": title}
    canvas: Any = CANVASES[image_format](sheet)
    getattr(canvas, f"print_{image_format}")(image, metadata=metadata)  # `savefig` would draw everything twice
    return image.getvalue()


class PanelPlace(NamedTuple):
    """Position of the axes of a panel in the image.

    `box` holds left, top, width and height as fractions of the image. `x` holds three items: the
    values at both ends of the abscissa, and True if the abscissa is logarithmic. `y` holds the same for the ordinate.
    """

    panel: Panel
    box: tuple[float, float, float, float]
    x: tuple[float, float, bool]
    y: tuple[float, float, bool]


def places(figure: Figure) -> list[PanelPlace]:
    """Return the positions of the axes of all panels in the image."""
    with themed("light"):
        _, axes = laid_out(figure)
    positions = []
    for panel, own_axes in zip(figure.panels, axes, strict=True):
        box = own_axes.get_position()
        x, y = (*own_axes.get_xlim(), panel.x.log), (*own_axes.get_ylim(), panel.y.log)
        positions.append(PanelPlace(panel, (box.x0, 1.0 - box.y1, box.width, box.height), x, y))
    return positions


def size(figure: Figure) -> tuple[float, float]:
    """Return width and height of the image in inches."""
    heights = [_height(panel, figure) for panel in figure.panels]
    body = max(heights, default=0.0) if figure.beside else sum(heights) + _gap(figure) * (len(heights) - 1)
    return _width(figure), _top(figure) + body + _abscissa(figure) + EDGE


def _width(figure: Figure) -> float:
    """Return the width of the image in inches."""
    return NARROW if figure.narrow else WIDTH


def _letters(figure: Figure, length: int) -> int:
    """Return the number of characters that fit into a line of text in this figure."""
    return int(length * _width(figure) / WIDTH)


def _head(figure: Figure) -> tuple[str, str, float, float]:
    """Return the title and the finding of a figure, both broken into lines, and two distances [in]."""
    title, finding = fill(figure.title, _letters(figure, TITLE_LENGTH)), fill(figure.subtitle, _letters(figure, LENGTH))
    below = EDGE + LINE * TITLE * (1 + title.count("\n"))
    return title, finding, below, below + LINE * TEXT * (1 + finding.count("\n")) + EDGE


def _height(panel: Panel, figure: Figure) -> float:
    """Return the height of the axes of a panel in inches."""
    height = _usual_height(panel, figure)
    return height if panel.rows or not figure.narrow else NARROW_HEIGHT * height


def _usual_height(panel: Panel, figure: Figure) -> float:
    if panel.rows:
        return ROW_HEIGHT * (len({row.name for row in panel.rows}) + (1 if panel.levels else 0.3))
    if panel.equal or panel.areas:
        return PLANE_BESIDE if figure.beside else PLANE
    return HEIGHTS[1 if figure.beside else min(len(figure.panels), max(HEIGHTS))]


def _heading(figure: Figure) -> float:
    """Return the height [in] of the texts above axes: titles, names of ordinates and, in a narrow figure, legends."""
    names = 0 if all(panel.rows for panel in figure.panels) else 2 if figure.beside else 1
    names += max(map(legend_lines, figure.panels), default=0) if figure.narrow else 0
    return LINE * TEXT * (names + any(panel.title for panel in figure.panels)) + EDGE / 2


def _points(panels: Sequence[Panel]) -> float:
    """Return the height [in] of the row of names of points above axes."""
    return LINE * TEXT * any(map(has_points, panels))


def _top(figure: Figure) -> float:
    """Return the height [in] of everything above the first axes."""
    return _head(figure)[-1] + _heading(figure) + _points(figure.panels if figure.beside else figure.panels[:1])


def _shares_abscissa(figure: Figure) -> bool:
    """Return True if the panels stand above one another and have the same abscissa."""
    return not figure.beside and all(panel.x == figure.panels[0].x for panel in figure.panels)


def _abscissa(figure: Figure) -> float:
    """Return the height [in] of the texts below axes: the tick labels, and the name of the abscissa."""
    return ABSCISSA + LINE * TEXT * figure.narrow


def _gap(figure: Figure) -> float:
    """Return the vertical distance between two axes that lie one above the other [in]."""
    return _heading(figure) + _points(figure.panels[1:]) + (EDGE / 2 if _shares_abscissa(figure) else _abscissa(figure))


def laid_out(figure: Figure) -> tuple[Sheet, list[Axes]]:
    """Lay out a figure with the settings of the current theme. Return the sheet and the axes of the panels."""
    (title, finding, below, _), (width, height) = _head(figure), size(figure)
    sheet = Sheet(figsize=(width, height), dpi=DPI["svg"])
    FigureCanvasAgg(sheet)  # with this canvas, texts can be measured
    style: dict[str, Any] = {"va": "top", "linespacing": 1.2}
    sheet.text(EDGE / width, 1.0 - EDGE / height, title, fontsize=TITLE, fontweight="bold", **style)
    sheet.text(EDGE / width, 1.0 - below / height, finding, fontsize=TEXT, color=rcParams["axes.labelcolor"], **style)
    axes = _axes(sheet, figure) if figure.panels else []
    for text in sheet.findobj(Text):
        typeset = subscripts(text.get_text(), _symbol)
        if typeset != text.get_text():
            text.set(text=typeset, parse_math=True)
    for panel_axes, panel in zip(axes, figure.panels, strict=True):
        place_texts(panel_axes, panel)
    return sheet, axes


def _collides(sheet: Sheet, axes: list[Axes]) -> bool:
    """Return True if a text on the sheet is cut off or overlaps another text."""
    sheet.draw_without_rendering()  # places the names of axes and the legends
    texts = list[Text]()
    for panel_axes in axes:
        texts += [*panel_axes.texts, panel_axes.title, panel_axes.xaxis.label, panel_axes.yaxis.label]
        for axis in (panel_axes.xaxis, panel_axes.yaxis):
            low, high = sorted(axis.get_view_interval())
            texts += [tick.label1 for tick in axis.get_major_ticks() if low <= tick.get_loc() <= high]
        texts += legend.get_texts() if (legend := panel_axes.get_legend()) else []
    boxes = [text.get_window_extent() for text in (*sheet.texts, *texts) if text.get_visible() and text.get_text()]
    right, top = sheet.bbox.x1, sheet.bbox.y1
    if any(box.x0 < 0.0 or box.y0 < 0.0 or box.x1 > right or box.y1 > top for box in boxes):
        return True
    overlaps = (Bbox.intersection(first, second) for first, second in combinations(boxes, 2))
    return any(overlap and min(overlap.width, overlap.height) > TOUCH * sheet.dpi for overlap in overlaps)


def _symbol(letter: str, subscript: str) -> str:
    """Return a symbol in the notation of matplotlib's mathematical text."""
    return rf"${letter}_\mathrm{{{subscript.replace(',', '{,}')}}}$"


def _axes(sheet: Sheet, figure: Figure) -> list[Axes]:
    """Draw the axes of all panels. Leave room around the axes for tick labels, legends and colour bars."""
    heights, (width, height) = [_height(panel, figure) for panel in figure.panels], size(figure)
    rows, columns = (1, len(heights)) if figure.beside else (len(heights), 1)
    ratios, share = None if figure.beside else heights, _shares_abscissa(figure)
    axes = list(sheet.subplots(rows, columns, squeeze=False, sharex=share, height_ratios=ratios).flat)
    length = _letters(figure, BESIDE_LENGTH if columns > 1 else LENGTH)
    for panel_axes, panel in zip(axes, figure.panels, strict=True):
        draw_panel(panel_axes, panel, length, narrow=figure.narrow)
        panel_axes.xaxis.label.set_visible(panel_axes is axes[-1] or not share)
    for panel_axes, (before, panel) in zip(axes[1:], pairwise(figure.panels), strict=True):
        panel_axes.yaxis.label.set_visible(not figure.beside or panel.y.label != before.y.label)
    ticks = max(text.get_window_extent().width for panel_axes in axes for text in panel_axes.get_yticklabels())
    left = EDGE + max(TICKS, ticks / sheet.dpi) + EDGE / 2
    ends = [_room_right(panel_axes, narrow=figure.narrow) for panel_axes in axes]
    right, between = (ends[-1], left + max(ends[:-1], default=0.0)) if figure.beside else (max(ends), 0.0)
    sheet.subplots_adjust(
        left=left / width,
        right=1.0 - right / width,
        top=1.0 - _top(figure) / height,
        bottom=(_abscissa(figure) + EDGE) / height,
        wspace=between * columns / (width - left - right - between * (columns - 1)),
        hspace=_gap(figure) * rows / sum(heights),
    )
    for panel_axes in axes:
        panel_axes.apply_aspect()  # the texts are placed before the sheet is drawn
        _thin_ticks(panel_axes)
    return axes


def _room_right(axes: Axes, *, narrow: bool) -> float:
    """Return the room [in] that a colour bar, a legend or texts need to the right of axes."""
    if axes.child_axes:
        return BAR
    return LEGEND if axes.get_legend() and not narrow else END + _overhang(axes)


def _thin_ticks(axes: Axes) -> None:
    """Remove every second tick of a linear abscissa, until the labels are far enough apart to be read."""
    low, high = sorted(axes.get_xlim())
    ticks = [tick for tick in axes.get_xticks() if low <= tick <= high]
    while axes.get_xscale() == "linear" and len(ticks) > FEWEST_TICKS:
        boxes = [text.get_window_extent() for text in axes.get_xticklabels() if text.get_visible() and text.get_text()]
        if all(other.x0 - box.x1 >= APART * axes.figure.dpi for box, other in pairwise(boxes)):
            return
        ticks = ticks[::2]
        axes.set_xticks(ticks)


def _overhang(axes: Axes) -> float:
    """Return the length [in] by which texts extend beyond the right end of axes."""
    rows = dict[float, float]()
    for text in (text for text in axes.texts if text.get_gid() is None):
        place = round(text.get_window_extent().y0)
        rows[place] = rows.get(place, 0.0) + text.get_window_extent().width
    ticks = [text.get_window_extent().width for text in axes.get_xticklabels()]
    return max([*rows.values(), max(ticks, default=0.0) / 2 - END * axes.figure.dpi, 0.0]) / axes.figure.dpi
