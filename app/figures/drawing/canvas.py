"""Axes of a panel with what is needed to place something in them."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection

from app.figures.data import Bars, Line, Panel, Role, Values
from app.figures.drawing.labels import Place, Placer
from app.figures.drawing.scales import Range, chosen_range, nice_ticks
from app.figures.drawing.style import SMALL, Theme

TICK_GAP = 0.05
LEGEND_BEYOND = 4  # lines
TICK_PITCH = (0.7, 0.31)  # inches, along and up


@dataclass(frozen=True, slots=True)
class Canvas:
    """Axes of a panel with their ranges, their size in inches, the theme, and what is taken already."""

    axes: Axes
    x: Range
    y: Range
    placer: Placer
    theme: Theme

    def inches(self, x: Values | float, y: Values | float) -> tuple[Values, Values]:
        """Place of points from the lower left corner."""
        return self.x.places(x) * self.placer.width, self.y.places(y) * self.placer.height

    def write(
        self, place: Place, text: str, size: float, color: str, *, bold: bool = False, centred: bool = False
    ) -> None:
        """A text at its place; on a patch of background where it covers a curve."""
        patch = {"facecolor": self.theme.background, "alpha": 0.78, "linewidth": 0, "pad": 0.6}
        self.axes.text(
            place.x / self.placer.width,
            place.y / self.placer.height,
            text,
            transform=self.axes.transAxes,
            fontsize=size,
            color=color,
            fontweight="bold" if bold else "normal",
            va="bottom",
            ha="left",
            multialignment="center" if centred else "left",
            linespacing=1.15,
            bbox=patch if place.over_curve else None,
            zorder=6,
        )

    def frame(self, *, upright: bool = True, across: bool = True, tick_names: bool = True) -> None:
        """Ranges, scales, grid, edges and numbers at the ticks; drawn as two sets of lines, for axes' own are slow."""
        axes, theme = self.axes, self.theme
        axes.set_axis_off()
        for which, chosen in (("x", self.x), ("y", self.y)):
            if chosen.log:
                getattr(axes, f"set_{which}scale")("log")
            getattr(axes, f"set_{which}lim")(chosen.low, chosen.high)
        columns, rows = self.x.places(np.array(self.x.ticks)), self.y.places(np.array(self.y.ticks))
        grid = [((at, 0.0), (at, 1.0)) for at in columns if upright] + [((0.0, at), (1.0, at)) for at in rows if across]
        edges = [((0.0, 0.0), (1.0, 0.0)), *([((0.0, 0.0), (0.0, 1.0))] if self.y.ticks else [])]
        if self.y.low < 0.0 < self.y.high and not self.y.log:
            zero = float(self.y.places(0.0))
            edges.append(((0.0, zero), (1.0, zero)))
        for lines, color, width, order in ((grid, theme.grid, 0.6, 0.5), (edges, theme.frame, 0.8, 4)):
            axes.add_collection(
                LineCollection(
                    lines, colors=color, linewidths=width, transform=axes.transAxes, zorder=order, clip_on=False
                ),
                autolim=False,
            )
        for at, name in zip(columns, self.x.labels, strict=True):
            if tick_names:
                self._number(at, -TICK_GAP / self.placer.height, name, ha="center", va="top")
        for at, name in zip(rows, self.y.labels, strict=True):
            self._number(-TICK_GAP / self.placer.width, at, name, ha="right", va="center_baseline")

    def _number(self, x: float, y: float, name: str, **alignment: Any) -> None:
        self.axes.text(x, y, name, transform=self.axes.transAxes, fontsize=SMALL, color=self.theme.muted, **alignment)


def ranges(panel: Panel, width: float, height: float) -> tuple[Range, Range]:
    """Ranges of both axes of a panel of a size, ticks as far apart as they can be read."""
    most_x, most_y = max(3, int(width / TICK_PITCH[0])), max(3, int(height / TICK_PITCH[1]))
    xs = [line.x for line in panel.lines] + [bar_edges(bars) for bars in panel.bars]
    ys = [line.y for line in panel.lines] + [bars.height for bars in panel.bars]
    xs += [np.array([mark.x]) for mark in panel.marks]
    xs += [ribbon.x for ribbon in panel.ribbons]
    ys += [edge for ribbon in panel.ribbons for edge in (ribbon.low, ribbon.high)]
    ys += [np.array([mark.y]) for mark in panel.marks]
    across = [level.value for level in panel.levels if not level.vertical]
    upright = [level.value for level in panel.levels if level.vertical]
    x = chosen_range(panel.x, xs, upright, snug=not panel.equal, most=most_x)
    y = chosen_range(panel.y, ys, across, snug=False, most=most_y)
    return _equalised(x, y, width, height, most_y) if panel.equal else (x, y)


def _equalised(x: Range, y: Range, width: float, height: float, most: int) -> tuple[Range, Range]:
    """Both ranges widened about their middles to one scale."""
    scale = max((x.high - x.low) / width, (y.high - y.low) / height)
    widened = []
    for each, length in ((x, width), (y, height)):
        middle, half = (each.low + each.high) / 2, scale * length / 2
        widened.append(Range(middle - half, middle + half, nice_ticks(middle - half, middle + half, most)))
    return widened[0], widened[1]


def spacing(bars: Bars) -> float:
    """Distance of neighbouring bars."""
    return float(np.diff(bars.x).min()) if len(bars.x) > 1 else 1.0


def bar_edges(bars: Bars) -> Values:
    """Ends of the abscissa that hold the bars."""
    half = spacing(bars) / 2
    return np.array([bars.x.min() - half, bars.x.max() + half])


def _named(panel: Panel) -> list[Line]:
    return [line for line in panel.lines if line.named and line.role is not Role.VARIANT]


def named_at_end(panel: Panel) -> list[Line]:
    """The lines whose names stand at their ends."""
    named = _named(panel)
    return [] if panel.equal or len(named) > LEGEND_BEYOND else named


def legend_entries(panel: Panel) -> list[Line | Bars]:
    """What a legend names: more lines than ends have room for, and bars side by side."""
    named = _named(panel)
    bars = [bars for bars in panel.bars if bars.role is not Role.VARIANT]
    return [*(named if panel.equal or len(named) > LEGEND_BEYOND else []), *(bars if len(bars) > 1 else [])]
