"""Draws lines, bars and areas."""

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.patches import Rectangle
from numpy.typing import NDArray

from app.figures.data import Area, Bars, Line, Ribbon, Role, Values
from app.figures.drawing.canvas import Canvas, spacing
from app.figures.drawing.style import SMALL, text_height, text_width

DASHES = {Role.RESULT: "solid", Role.REFERENCE: (0, (1.2, 1.8)), Role.VARIANT: (0, (4.5, 2.2))}
WIDTHS = {Role.RESULT: 1.7, Role.REFERENCE: 1.5, Role.VARIANT: 1.3}
BAR_SHARE = 0.8  # of the spacing
FAINT = 0.6  # of bars beside the extreme one


def draw_line(canvas: Canvas, line: Line) -> None:
    """A curve; points without solved neighbours as dots."""
    color = canvas.theme.drawing[line.hue]
    canvas.axes.plot(line.x, line.y, color=color, linestyle=DASHES[line.role], linewidth=WIDTHS[line.role], zorder=3)
    canvas.placer.add_curve(*canvas.inches(line.x, line.y))
    alone = _alone(line.y)
    if alone.any():
        canvas.axes.plot(line.x[alone], line.y[alone], "o", color=color, markersize=2.6, zorder=3)


def _alone(y: Values) -> NDArray[np.bool_]:
    """Points whose neighbours have no value, which a line would not show."""
    known = np.concatenate([[False], np.isfinite(y), [False]])
    return np.asarray(known[1:-1] & ~known[:-2] & ~known[2:])


def draw_ribbon(canvas: Canvas, ribbon: Ribbon) -> None:
    """A tinted band with thin edges."""
    color = canvas.theme.drawing[ribbon.hue]
    canvas.axes.fill_between(ribbon.x, ribbon.low, ribbon.high, color=color, alpha=0.22, linewidth=0, zorder=1.5)
    for edge in (ribbon.low, ribbon.high):
        canvas.axes.plot(ribbon.x, edge, color=color, linewidth=0.8, zorder=2)
        canvas.placer.add_curve(*canvas.inches(ribbon.x, edge))


def draw_bars(canvas: Canvas, bars: Bars, rank: int, count: int) -> None:
    """Bars of the series `rank` of `count` side by side; those of a variant are dashed outlines."""
    pitch = spacing(bars)
    width = BAR_SHARE * pitch / count
    left = bars.x - BAR_SHARE * pitch / 2 + rank * width
    top, zero = np.nan_to_num(bars.height), np.zeros_like(bars.height)
    corners = np.stack([[left, zero], [left, top], [left + width, top], [left + width, zero]])
    color, variant = canvas.theme.drawing[bars.hue], bars.role is Role.VARIANT
    alpha = np.full(top.size, 1.0 if bars.strong is None or variant else FAINT)
    if bars.strong is not None:
        alpha[bars.strong] = 1.0
    canvas.axes.add_collection(
        PolyCollection(
            list(corners.transpose(2, 0, 1)),
            facecolors="none" if variant else color,
            edgecolors=color if variant else "none",
            linestyles=[(0, (3.0, 1.5))] if variant else "solid",
            linewidths=0.9 if variant else 0.0,
            alpha=alpha,
            zorder=3 if variant else 2,
        ),
        autolim=False,
    )
    x, y = canvas.inches(corners[:, 0].T.ravel(), corners[:, 1].T.ravel())
    canvas.placer.add_curve(x, y)


def draw_area(canvas: Canvas, area: Area) -> None:
    """A tinted rectangle with as many lines of its text as fit in the middle of what the axes show of it."""
    left, right = max(area.left, canvas.x.low), min(area.right, canvas.x.high)
    bottom, top = max(area.bottom, canvas.y.low), min(area.top, canvas.y.high)
    theme = canvas.theme
    canvas.axes.add_patch(
        Rectangle(
            (left, bottom),
            right - left,
            top - bottom,
            facecolor=theme.drawing[area.hue],
            edgecolor=theme.background,
            linewidth=2.0,
            alpha=0.2,
            zorder=0,
        )
    )
    x, y = canvas.inches(np.array([left, right]), np.array([bottom, top]))
    text = _fitting(area.text, float(x[1] - x[0]), float(y[1] - y[0]))
    width, height = text_width(text, SMALL), text_height(text, SMALL)
    levels = float(y.mean()), float(y[1]) - height, float(y[0]) + height
    corners = [(float(x.mean()) - width / 2, level - height / 2) for level in levels]
    place = canvas.placer.place(text, SMALL, corners)
    canvas.write(place, text, SMALL, theme.muted, centred=True)


def _fitting(text: str, width: float, height: float) -> str:
    """The first lines of a text, as many as there is room for."""
    lines = text.split("\n")
    while lines and (text_width("\n".join(lines), SMALL) > width or text_height("\n".join(lines), SMALL) > height):
        lines.pop()
    return "\n".join(lines)
