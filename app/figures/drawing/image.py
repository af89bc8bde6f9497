"""From a figure's data to the bytes of an image: layout, house style, formats.

Margins are computed, not searched for: nothing is measured by drawing it. Equal figures give equal bytes.
"""

from dataclasses import dataclass
from io import BytesIO
from itertools import accumulate, pairwise
from typing import Any

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_pdf import FigureCanvasPdf
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure as Sheet

from app.figures.data import Figure, Map, Panel, ThemeName
from app.figures.drawing.annotations import end_width, legend_rows
from app.figures.drawing.canvas import Canvas, ranges
from app.figures.drawing.labels import Placer
from app.figures.drawing.maps import BAR_GAP, BAR_WIDTH, color_bar_width, draw_color_bar, draw_map
from app.figures.drawing.panels import LEGEND_SPACING, draw_panel
from app.figures.drawing.rows import draw_rows, names_width, rows_height, rows_range
from app.figures.drawing.style import DPI, SMALL, TEXT, THEMES, TITLE, WIDTH, Theme, settings, wrapped

EDGE, TICKS = 0.18, 0.46  # left and right of everything; room for the ordinate's numbers
TITLE_LINE, SUBTITLE_LINE, HEAD_GAP = 0.24, 0.165, 0.1
LABEL_LINE = 0.25  # with the ordinate's name, above the panel
TICK_LINE, AXIS_LINE, FOOT = 0.22, 0.2, 0.1
HEIGHTS = {1: 2.9, 2: 1.75, 3: 1.3}  # of panels above each other
MAP_HEIGHT, PLANE_HEIGHT = 2.9, 3.4
DPIS = {"svg": 100, "png": DPI, "pdf": DPI}  # of the images inside the vectors too
CANVASES = {"svg": FigureCanvasSVG, "png": FigureCanvasAgg, "pdf": FigureCanvasPdf}
# No date and no version in any of them.
METADATA: dict[str, dict[str, str | None]] = {
    "svg": {"Date": None, "Creator": None},
    "png": {"Software": None},
    "pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}


@dataclass(frozen=True, slots=True)
class Slot:
    """Place of a panel on the sheet in inches, from its top left corner; whether it shows its abscissa.

    Lying bars share the range of their `peers`; a panel whose left neighbour has its `ordinate` does not name it again.
    """

    panel: Panel
    left: float
    top: float
    width: float
    height: float
    abscissa: bool
    peers: tuple[Panel, ...] = ()
    ordinate: bool = True


class BareAxes(Axes):
    """Axes whose ticks are never made: the canvas draws its own, and making matplotlib's takes longer than the rest."""

    def grid(self, *_: Any, **__: Any) -> None:
        """No grid of its own."""


def draw(figure: Figure, image_format: str, theme_name: ThemeName = "light") -> bytes:
    """The image in one of the formats svg, png and pdf."""
    theme = THEMES[theme_name]
    with rc_context(settings(theme)):
        sheet = drawn(figure, theme)
        image = BytesIO()
        CANVASES[image_format](sheet)
        metadata = METADATA[image_format] | {"Title": figure.title}
        sheet.savefig(image, format=image_format, metadata=metadata, dpi=DPIS[image_format])
        return image.getvalue()


def drawn(figure: Figure, theme: Theme) -> Sheet:
    """The sheet with everything on it; inside the theme's settings."""
    title, subtitle = _wrapped_head(figure)
    slots, height = arranged(figure)
    sheet = Sheet(figsize=(WIDTH, height), dpi=DPI)
    _draw_head(sheet, title, subtitle, height, theme)
    for slot in slots:
        _draw_slot(sheet, slot, height, theme)
    return sheet


def arranged(figure: Figure) -> tuple[list[Slot], float]:
    """The places of the panels, and the height of the sheet."""
    title, subtitle = _wrapped_head(figure)
    head = EDGE + TITLE_LINE * (1 + title.count("\n")) + SUBTITLE_LINE * (1 + subtitle.count("\n")) + HEAD_GAP
    slots = _beside(figure, head) if figure.beside else _stacked(figure, head)
    return slots, max(slot.top + slot.height + _foot(slot) for slot in slots) + FOOT


def _wrapped_head(figure: Figure) -> tuple[str, str]:
    width = WIDTH - 2 * EDGE
    return wrapped(figure.title, TITLE, width, bold=True), wrapped(figure.subtitle, TEXT, width)


def _draw_head(sheet: Sheet, title: str, subtitle: str, height: float, theme: Theme) -> None:
    top = height - EDGE
    sheet.text(EDGE / WIDTH, top / height, title, fontsize=TITLE, fontweight="bold", color=theme.ink, va="top")
    below = top - TITLE_LINE * (1 + title.count("\n"))
    sheet.text(EDGE / WIDTH, below / height, subtitle, fontsize=TEXT, color=theme.muted, va="top", linespacing=1.25)


def _stacked(figure: Figure, top: float) -> list[Slot]:
    """Panels above each other with common edges; only the lowest of those with the same abscissa shows it."""
    panels = figure.panels
    left = EDGE + max(names_width(panel) if panel.rows else TICKS for panel in panels)
    right = EDGE + max(_right(panel) for panel in panels)
    slots: list[Slot] = []
    for index, panel in enumerate(panels):
        shared = index + 1 < len(panels) and not panel.rows and panels[index + 1].x == panel.x
        width = WIDTH - left - right
        top += _above(panel, width)
        peers = tuple(each for each in panels if each.rows and each.x == panel.x)
        slot = Slot(panel, left, top, width, _height(panel, len(panels), width), not shared, peers)
        slots.append(slot)
        top += slot.height + (_foot(slot) if slot.abscissa else 0.06)
    return slots


def _beside(figure: Figure, top: float) -> list[Slot]:
    """Panels of one height in a row."""
    panels = figure.panels
    margins = [(TICKS, _right(panel)) for panel in panels]
    free = WIDTH - 2 * EDGE - sum(left + right for left, right in margins) - 0.12 * (len(panels) - 1)
    width = free / len(panels)
    top += max(_above(panel, width) for panel in panels)
    edges = list(accumulate((left + width + right + 0.12 for left, right in margins), initial=EDGE))
    named = [True, *(panel.y.label != left.y.label for left, panel in pairwise(panels))]
    return [
        Slot(
            panel,
            edge + left,
            top,
            width,
            min(_height(panel, 1, width), 1.35 * width + 0.4),
            abscissa=True,
            ordinate=name,
        )
        for panel, edge, (left, _), name in zip(panels, edges[:-1], margins, named, strict=True)
    ]


def _above(panel: Panel, width: float) -> float:
    title = 0.2 if panel.title else 0.0
    return (
        title
        + LABEL_LINE
        + LEGEND_SPACING * len(legend_rows(panel, width))
        - (LABEL_LINE - 0.08 if panel.rows else 0.0)
    )


def _right(panel: Panel) -> float:
    """Room beside a panel."""
    if panel.map is not None:
        return color_bar_width(panel.map) if panel.map.bar else 0.08
    return max(end_width(panel), 0.08)


def _height(panel: Panel, count: int, width: float) -> float:
    if panel.rows:
        return rows_height(panel)
    if panel.equal:
        return min(width, PLANE_HEIGHT)
    if panel.areas:
        return PLANE_HEIGHT
    return MAP_HEIGHT if panel.map is not None else HEIGHTS[min(count, max(HEIGHTS))]


def _foot(slot: Slot) -> float:
    return TICK_LINE + AXIS_LINE if slot.abscissa else 0.0


def _draw_slot(sheet: Sheet, slot: Slot, height: float, theme: Theme) -> None:
    panel, size = slot.panel, (slot.width, slot.height)
    axes = _axes(sheet, slot.left, slot.top, size, height)
    if panel.rows:
        draw_rows(axes, panel, rows_range(slot.peers, slot.width), *size, theme)
    elif panel.map is not None:
        draw_map(axes, panel, panel.map, size, theme)
        if panel.map.bar:
            bar = (BAR_WIDTH, slot.height)
            beside = _axes(sheet, slot.left + slot.width + BAR_GAP, slot.top, bar, height)
            draw_color_bar(beside, panel.map, bar, theme)
    else:
        draw_panel(Canvas(axes, *ranges(panel, *size), Placer(*size), theme), panel, tick_names=slot.abscissa)
    _draw_names(sheet, slot, height, theme)


def _axes(sheet: Sheet, left: float, top: float, size: tuple[float, float], height: float) -> Axes:
    width, tall = size
    place = (left / WIDTH, 1.0 - (top + tall) / height, width / WIDTH, tall / height)
    return sheet.add_axes(place, axes_class=BareAxes)


def _draw_names(sheet: Sheet, slot: Slot, height: float, theme: Theme) -> None:
    """The ordinate's name above the panel, the abscissa's below, the panel's own on top."""
    panel = slot.panel
    lift = slot.top - 0.07 - LEGEND_SPACING * len(legend_rows(panel, slot.width))
    name = panel.y.label
    if panel.map is not None and panel.map.bar:
        _name_colors(sheet, panel.map, lift, height, theme)
    start = slot.left if panel.rows else slot.left - TICKS + 0.1
    if not panel.rows:
        if slot.ordinate:
            sheet.text(start / WIDTH, 1.0 - lift / height, name, fontsize=SMALL, color=theme.muted)
        lift -= LABEL_LINE
    if panel.title:
        lift -= 0.01
        above = slot.top - 0.07 - (0.0 if panel.rows else LABEL_LINE - 0.02)
        sheet.text(
            slot.left / WIDTH, 1.0 - above / height, panel.title, fontsize=TEXT, fontweight="bold", color=theme.ink
        )
    if slot.abscissa:
        below = 1.0 - (slot.top + slot.height + TICK_LINE) / height
        middle = (slot.left + slot.width / 2) / WIDTH
        sheet.text(
            middle,
            below,
            panel.x.label,
            fontsize=SMALL,
            color=theme.muted,
            ha="center",
            va="top",
        )


def _name_colors(sheet: Sheet, chart: Map, lift: float, height: float, theme: Theme) -> None:
    """What the colours mean, flush with the right edge."""
    name = f"{chart.title}, {chart.unit}" if chart.unit else chart.title
    place = (WIDTH - EDGE) / WIDTH, 1.0 - lift / height
    sheet.text(*place, name, fontsize=SMALL, color=theme.muted, ha="right")
