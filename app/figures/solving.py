"""Figures of a search along one input: the curve on which the answers were found, and oils side by side."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from app.figures.data import Axis, Figure, Hue, Level, Line, Mark, Panel, Row, Span
from app.figures.studies import Grid, verdict_levels
from app.figures.wording import number

MOST_OILS = 14  # largest number of oils in a figure


def sought(grid: Grid, wanted: float | None, answers: Sequence[Mark], gaps: Sequence[Span], finding: str) -> Figure:
    """Draw the curve with the answers, the wanted value, and the lines of the verdict.

    `gaps` are the ranges without a solution. If the abscissa has ticks of its own, every point is marked, because there
    is nothing between the points.
    """
    x, unit = grid.x, grid.output.unit
    levels = verdict_levels(grid)
    if wanted is not None and wanted not in {level.value for level in levels}:
        levels.append(Level(wanted, f"wanted: {number(wanted, unit)}"))
    if x.own is not None and x.values[0] <= x.own <= x.values[-1]:
        levels.append(Level(x.own, f"this case: {number(x.own, x.axis.unit)}", vertical=True))
    line = Line(grid.output.title, x.values, grid.values, named=False)
    points = [replace(line.mark(at, ""), hue=Hue.SKY) for at in np.flatnonzero(np.isfinite(grid.values)).tolist()]
    marks = [*(points if x.axis.ticks else ()), *answers]
    ordinate = replace(grid.output, magnitude=False)
    panel = Panel(x=x.axis, y=ordinate, lines=[line], levels=levels, spans=gaps, marks=marks)
    title = f"{grid.output.title} over {x.axis.title}"
    return Figure(finding, [panel], title=title[0].upper() + title[1:], unsolved=grid.unsolved)


def oils(output: Axis, named: Sequence[tuple[str, float]], wanted: float | None, first: int, finding: str) -> Figure:
    """Draw a bar for each oil, the thinnest first, and the value that the output shall have.

    Of many oils, those around the oil with the index `first` are drawn, the first one that reaches the value.
    """
    start = max(min(first - MOST_OILS // 2, len(named) - MOST_OILS), 0)
    levels = [] if wanted is None else [Level(wanted, f"wanted: {number(wanted, output.unit)}", vertical=True)]
    panel = Panel(
        x=output, y=Axis("oil"), rows=[Row(*pair) for pair in named[start : start + MOST_OILS]], levels=levels
    )
    return Figure(finding, [panel], title=f"{output.title[0].upper()}{output.title[1:]}, the thinnest oil first")
