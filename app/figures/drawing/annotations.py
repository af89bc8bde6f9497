"""Draws what explains a panel: limits, ranges, marks, names of lines."""

import numpy as np

from app.figures.data import Bars, Level, Line, Mark, Panel, Span
from app.figures.drawing.canvas import Canvas, legend_entries, named_at_end
from app.figures.drawing.curves import DASHES
from app.figures.drawing.labels import Place, around, spread
from app.figures.drawing.style import SMALL, TEXT, text_height, text_width

END_GAP = 0.07
END_SPACING = 0.155
LIMIT_DASHES, REFERENCE_DASHES = (0, (5.0, 2.5)), (0, (1.0, 2.0))
SWATCH = 0.2


def draw_span(canvas: Canvas, span: Span) -> None:
    """The shade of a range."""
    canvas.axes.axvspan(span.start, span.stop, facecolor=canvas.theme.shade, edgecolor="none", zorder=0)


def name_span(canvas: Canvas, span: Span) -> None:
    """The reason of a shade, at its top or bottom."""
    ends = np.clip(canvas.x.places(np.array([span.start, span.stop])), 0.0, 1.0) * canvas.placer.width
    if not span.name or ends[1] - ends[0] <= 0.0:
        return
    width, height = text_width(span.name, SMALL), text_height(span.name, SMALL)
    starts = float(ends.mean()) - width / 2, float(ends[0]) + 0.04, float(ends[1]) - width - 0.04
    share = canvas.placer.height - height
    levels = share - 0.02, 0.03, share * 0.75, share * 0.5, share * 0.25
    place = canvas.placer.place(span.name, SMALL, [(x, y) for y in levels for x in starts])
    canvas.write(place, span.name, SMALL, canvas.theme.muted)


def draw_level(canvas: Canvas, level: Level) -> None:
    """A limit, dashed in red, or a reference, dotted in grey; nothing if it lies beyond the axis."""
    if not (canvas.x if level.vertical else canvas.y).holds(level.value):
        return
    draw = canvas.axes.axvline if level.vertical else canvas.axes.axhline
    theme = canvas.theme
    draw(
        level.value,
        color=theme.limit if level.limit else theme.muted,
        linestyle=LIMIT_DASHES if level.limit else REFERENCE_DASHES,
        linewidth=1.3 if level.limit else 1.0,
        zorder=2.5,
    )
    at, ends = np.full(2, level.value), np.array([0.0, 1.0])
    if level.vertical:
        x = canvas.x.places(at) * canvas.placer.width
        canvas.placer.add_curve(x, ends * canvas.placer.height)
    else:
        y = canvas.y.places(at) * canvas.placer.height
        canvas.placer.add_curve(ends * canvas.placer.width, y)


def name_level(canvas: Canvas, level: Level) -> None:
    """The name along the line, or with an arrow at the edge beyond which the line lies."""
    along = canvas.x if level.vertical else canvas.y
    if not level.name:
        return
    beyond = "" if along.holds(level.value) else _arrow(level, along.high)
    text = f"{level.name} {beyond}".strip()
    width, height = text_width(text, SMALL), text_height(text, SMALL)
    panel_width, panel_height = canvas.placer.width, canvas.placer.height
    at = float(np.clip(along.places(level.value), 0.0, 1.0))
    if level.vertical:
        x = at * panel_width
        sides = x + 0.05, x - width - 0.05
        heights = panel_height - height - 0.02, 0.03, panel_height * 0.6, panel_height * 0.3
        corners = [(side, y) for y in heights for side in sides]
    else:
        y = at * panel_height
        starts = panel_width - width - 0.04, 0.05, (panel_width - width) / 2
        corners = [(x, side) for side in (y + 0.02, y - height - 0.03) for x in starts]
    place = canvas.placer.place(text, SMALL, corners)
    canvas.write(place, text, SMALL, canvas.theme.limit if level.limit else canvas.theme.muted)


def _arrow(level: Level, high: float) -> str:
    above = level.value > high
    if level.vertical:
        return "→" if above else "←"
    return "↑" if above else "↓"


def draw_mark(canvas: Canvas, mark: Mark) -> None:
    """A ring at the point."""
    theme = canvas.theme
    canvas.axes.plot(
        [mark.x],
        [mark.y],
        "o",
        markersize=5.5,
        markerfacecolor=theme.background,
        markeredgecolor=theme.drawing[mark.hue],
        markeredgewidth=1.6,
        clip_on=False,
        zorder=5,
    )
    x, y = (float(value) for value in canvas.inches(mark.x, mark.y))
    canvas.placer.add_box(x - 0.05, y - 0.05, x + 0.05, y + 0.05)


def name_marks(canvas: Canvas, marks: tuple[Mark, ...]) -> None:
    """Their texts beside them, the highest first, so that none takes another's place; several hues name their own."""
    several = len({mark.hue for mark in marks}) > 1
    for mark in sorted(marks, key=lambda mark: -mark.y):
        _name_mark(canvas, mark, canvas.theme.writing[mark.hue] if several else canvas.theme.ink)


def _name_mark(canvas: Canvas, mark: Mark, color: str) -> None:
    x, y = (float(value) for value in canvas.inches(mark.x, mark.y))
    place = canvas.placer.place(mark.text, TEXT, around(x, y, mark.text, TEXT, bold=True), bold=True)
    canvas.write(place, mark.text, TEXT, color, bold=True)


def end_width(panel: Panel) -> float:
    """Room that the names at line ends need beside the panel."""
    return max((END_GAP + text_width(line.title, TEXT, bold=True) for line in named_at_end(panel)), default=0.0)


def name_line_ends(canvas: Canvas, panel: Panel) -> None:
    """Names at the right, at the height where their lines end, apart from each other."""
    lines = [line for line in named_at_end(panel) if np.isfinite(line.y).any()]
    height = text_height("x", TEXT)
    wanted = [float(canvas.y.places(_last(line))) * canvas.placer.height for line in lines]
    places = spread(wanted, END_SPACING, height / 2, canvas.placer.height - height / 2)
    for line, middle in zip(lines, places, strict=True):
        place = Place(canvas.placer.width + END_GAP, middle - height / 2, over_curve=False)
        canvas.write(place, line.title, TEXT, canvas.theme.writing[line.hue], bold=True)


def _last(line: Line) -> float:
    return float(line.y[np.isfinite(line.y)][-1])


def legend_rows(panel: Panel, width: float) -> list[list[Line | Bars]]:
    """Entries of the legend in rows that fit."""
    rows: list[list[Line | Bars]] = []
    used = 0.0
    for entry in legend_entries(panel):
        room = SWATCH + 0.08 + text_width(entry.title, SMALL) + 0.16
        if not rows or used + room > width:
            rows, used = [*rows, []], 0.0
        rows[-1].append(entry)
        used += room
    return rows


def draw_legend(canvas: Canvas, panel: Panel, spacing: float) -> None:
    """Above the panel, from the left, the last row next to the panel."""
    rows = legend_rows(panel, canvas.placer.width)
    for rank, row in enumerate(rows):
        x, y = 0.0, canvas.placer.height + 0.06 + spacing * (len(rows) - 1 - rank)
        for entry in row:
            x = _legend_entry(canvas, entry, x, y)


def _legend_entry(canvas: Canvas, entry: Line | Bars, x: float, y: float) -> float:
    """One swatch with its name; where the next one starts."""
    width, height, theme = canvas.placer.width, canvas.placer.height, canvas.theme
    bar = isinstance(entry, Bars)
    canvas.axes.plot(
        [x / width, (x + SWATCH) / width],
        [(y + 0.06) / height] * 2,
        transform=canvas.axes.transAxes,
        color=theme.drawing[entry.hue],
        linestyle="solid" if bar else DASHES[entry.role],
        linewidth=5.0 if bar else 1.7,
        solid_capstyle="butt",
        clip_on=False,
    )
    start = x + SWATCH + 0.08
    canvas.write(Place(start, y, over_curve=False), entry.title, SMALL, theme.writing[entry.hue])
    return start + text_width(entry.title, SMALL) + 0.16
