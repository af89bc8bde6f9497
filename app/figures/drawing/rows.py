"""Draws a panel of named values as lying bars."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from app.figures.data import Axis, Panel, Role, Row
from app.figures.drawing.annotations import draw_level, name_level
from app.figures.drawing.canvas import Canvas
from app.figures.drawing.labels import Place, Placer
from app.figures.drawing.scales import Range, chosen_range
from app.figures.drawing.style import TEXT, Theme, text_height, text_width
from app.figures.wording import number

PITCH = 0.3  # inches from row to row
BAR = 0.52  # of the pitch
NOISE = 1e-9  # of the axis


def rows_height(panel: Panel) -> float:
    """Height of the panel; rows of a variant share those of the case."""
    own = sum(row.role is not Role.VARIANT for row in panel.rows)
    return PITCH * own + (0.24 if panel.levels else 0.06)


def names_width(panel: Panel) -> float:
    """Room for the names at the left."""
    return max(text_width(row.name, TEXT) for row in panel.rows) + 0.1


def draw_rows(axes: Axes, panel: Panel, x: Range, width: float, height: float, theme: Theme) -> None:
    """Bars from zero with value and name; a thin line from bound to bound."""
    own = [row for row in panel.rows if row.role is not Role.VARIANT]
    canvas = Canvas(axes, x, Range(0.0, height, ()), Placer(width, height), theme)
    canvas.frame(across=False)
    axes.axvline(0.0, color=theme.frame, linewidth=0.9, zorder=3)
    names = [row.name for row in own]
    for level in panel.levels:
        draw_level(canvas, level)
    for row in panel.rows:
        if row.name in names:
            others = [each for each in panel.rows if each.name == row.name and each is not row]
            _row(
                canvas,
                row,
                PITCH * (len(own) - names.index(row.name) - 0.5),
                panel.x,
                others,
                crossed=bool(panel.levels),
            )
    for level in panel.levels:
        name_level(canvas, level)


def rows_range(panels: Sequence[Panel], width: float) -> Range:
    """The range of all panels of one abscissa, with room for the values written beside the bars."""
    axis, rows = panels[0].x, [row for panel in panels for row in panel.rows]
    ends = [end for row in rows for end in (row.value, *(row.bounds or ()))]
    levels = [level.value for panel in panels for level in panel.levels]
    chosen = chosen_range(axis, [np.array(ends)], levels, snug=False, most=6)
    widest = max(text_width(number(row.value, axis.unit or ""), TEXT, bold=True) for row in rows) + 0.12
    low, high = min([0.0, *ends]), max([0.0, *ends])
    scale = (chosen.high - chosen.low) / max(width - widest * (1 + (low < 0.0)), 0.5)
    low = min(chosen.low, low - widest * scale) if low < 0.0 else 0.0
    high = max(chosen.high, high + widest * scale)
    return chosen_range(replace(axis, limits=(low, high)), [], snug=False, most=6)


def _written(canvas: Canvas, value: float, axis: Axis) -> str:
    """The value; what is rounding error beside the others is zero."""
    noise = abs(value) < NOISE * (canvas.x.high - canvas.x.low)
    return number(0.0 if noise else value, axis.unit or "")


def _row(canvas: Canvas, row: Row, middle: float, axis: Axis, others: Sequence[Row], *, crossed: bool) -> None:
    """One bar with its name and value, which stands beyond the bars of `others` in the same place.

    Where levels may have `crossed` the value, it hides them.
    """
    theme, thick = canvas.theme, BAR * PITCH
    color, variant = theme.drawing[row.hue], row.role is Role.VARIANT
    canvas.axes.add_patch(
        Rectangle(
            (min(row.value, 0.0), middle - thick / 2),
            abs(row.value),
            thick,
            facecolor="none" if variant else color,
            edgecolor=color if variant else "none",
            linestyle=(0, (3.0, 1.5)),
            linewidth=1.1 if variant else 0.0,
            zorder=3 if variant else 2,
        )
    )
    if variant:
        return
    ends = [row.value, *(each.value for each in others)]
    if row.bounds is not None and row.bounds[0] < row.bounds[1]:
        canvas.axes.plot(
            row.bounds, [middle, middle], color=theme.ink, linewidth=1.2, marker="|", markersize=7, zorder=4
        )
        ends += row.bounds
    text, height = _written(canvas, row.value, axis), text_height("x", TEXT)
    width = text_width(text, TEXT, bold=True)
    tip = max(0.0, *ends) if row.value >= 0.0 else min(0.0, *ends)
    x = float(canvas.x.places(tip)) * canvas.placer.width
    x = x + 0.06 if row.value >= 0.0 else x - width - 0.06
    place = canvas.placer.place(text, TEXT, [(x, middle - height / 2 - 0.01)], bold=True)
    canvas.write(replace(place, over_curve=crossed), text, TEXT, theme.ink, bold=True)
    name = Place(-text_width(row.name, TEXT) - 0.08, middle - height / 2 - 0.01, over_curve=False)
    canvas.write(name, row.name, TEXT, theme.writing[row.hue])
