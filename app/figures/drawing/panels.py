"""Draws one panel of curves and bars."""

from app.figures.data import Panel
from app.figures.drawing.annotations import (
    draw_legend,
    draw_level,
    draw_mark,
    draw_span,
    name_level,
    name_line_ends,
    name_marks,
    name_span,
)
from app.figures.drawing.canvas import Canvas
from app.figures.drawing.curves import draw_area, draw_bars, draw_line, draw_ribbon

LEGEND_SPACING = 0.17


def draw_panel(canvas: Canvas, panel: Panel, *, tick_names: bool) -> None:
    """Everything of the panel from the ground up; texts last and in the order of their worth."""
    canvas.frame(upright=not panel.areas, across=not panel.areas, tick_names=tick_names)
    for span in panel.spans:
        draw_span(canvas, span)
    for bars in panel.bars:
        beside = [each for each in panel.bars if each.role is bars.role]
        draw_bars(canvas, bars, beside.index(bars), len(beside))
    for ribbon in panel.ribbons:
        draw_ribbon(canvas, ribbon)
    for line in panel.lines:
        draw_line(canvas, line)
    for level in panel.levels:
        draw_level(canvas, level)
    for mark in panel.marks:
        draw_mark(canvas, mark)
    _write_texts(canvas, panel)


def _write_texts(canvas: Canvas, panel: Panel) -> None:
    for area in panel.areas:
        draw_area(canvas, area)  # its name can stand in few places, that of a mark in many
    name_marks(canvas, panel.marks)
    for level in panel.levels:
        name_level(canvas, level)
    for span in panel.spans:
        name_span(canvas, span)
    name_line_ends(canvas, panel)
    draw_legend(canvas, panel, LEGEND_SPACING)
