"""Draws a panel that is a map, and its colour bar."""

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm, Normalize

from app.figures.data import Axis, Map, Panel, Scale, Values
from app.figures.drawing.annotations import draw_mark, name_span
from app.figures.drawing.canvas import Canvas
from app.figures.drawing.labels import Place, Placer, around
from app.figures.drawing.scales import Range, chosen_range, nice_ticks
from app.figures.drawing.style import SMALL, TEXT, Theme, text_width
from app.figures.wording import number

COLOURS = {Scale.MAGNITUDE: "cividis", Scale.RATIO: "RdBu_r", Scale.SIGNED: "RdBu_r"}
RATIO_TICKS = (0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0, 7.0, 10.0, 20.0, 50.0, 100.0)
LINEAR_RATIO = 1.3  # up to which a ratio's ticks are evenly spaced
IMAGE = (360, 300)  # pixels across and up, at most
NAME_ROOM = 0.13  # inches between values at the colour bar
BAR_STEPS = 64
BAR_WIDTH, BAR_GAP, TICK_ROOM = 0.13, 0.12, 0.1


def color_range(chart: Map) -> tuple[float, float]:
    """Least and greatest value of the colours."""
    if chart.range is not None:
        return chart.range
    finite = chart.values[np.isfinite(chart.values)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
    if chart.scale is Scale.RATIO:
        reach = max(high, 1.0 / max(low, 1e-3), 1.0001)
        return 1.0 / reach, reach
    if chart.scale is Scale.SIGNED:
        reach = max(abs(low), abs(high), 1e-12)
        return -reach, reach
    low = min(low, 0.0)
    return low, high if high > low else low + 1.0


def bar_ticks(chart: Map) -> tuple[float, ...]:
    """Values at the colour bar, which are those of the contours too."""
    low, high = color_range(chart)
    if chart.scale is Scale.RATIO and high > LINEAR_RATIO:
        ticks = tuple(tick for tick in RATIO_TICKS if low <= tick <= high)
        return ticks if len(ticks) <= 8 else tuple(tick for tick in ticks if tick not in {0.3, 0.7, 1.5, 3.0, 7.0})
    return nice_ticks(low, high, 6)


def color_bar_width(chart: Map) -> float:
    """Room beside the panel for the colour bar and its texts."""
    texts = [number(tick, digits=6) for tick in bar_ticks(chart)]
    names = [critical.name for critical in chart.critical if _within(chart, critical.value)]
    widest = max(text_width(text, SMALL) for text in [*texts, *names])
    return BAR_GAP + BAR_WIDTH + TICK_ROOM + widest


def draw_map(axes: Axes, panel: Panel, chart: Map, size: tuple[float, float], theme: Theme) -> None:
    """Colours, contours, critical values and marks."""
    x, y = map_ranges(panel, chart)
    canvas = Canvas(axes, x, y, Placer(*size), theme)
    canvas.frame(upright=False, across=False)
    axes.imshow(
        _image(chart, x, y),
        extent=(0.0, 1.0, 0.0, 1.0),
        transform=axes.transAxes,
        origin="lower",
        aspect="auto",
        cmap=colormaps[COLOURS[chart.scale]],
        norm=_norm(chart),
        interpolation="bilinear",
        zorder=0,
    )
    _contours(axes, chart, theme)
    for span in panel.spans:
        axes.axvspan(span.start, span.stop, facecolor=theme.shade, edgecolor="none", zorder=2)
        name_span(canvas, span)
    for mark in panel.marks:
        draw_mark(canvas, mark)
        spot = canvas.inches(mark.x, mark.y)
        corners = around(float(spot[0]), float(spot[1]), mark.text, TEXT, bold=True, gap=0.11)
        place = canvas.placer.place(mark.text, TEXT, corners, bold=True)
        canvas.write(Place(place.x, place.y, over_curve=True), mark.text, TEXT, theme.ink, bold=True)


def draw_color_bar(axes: Axes, chart: Map, size: tuple[float, float], theme: Theme) -> None:
    """The colours with their values; names of critical values where they belong."""
    norm = _norm(chart)
    axes.set_axis_off()
    axes.imshow(
        np.linspace(0.0, 1.0, BAR_STEPS)[:, None],
        extent=(0.0, 1.0, 0.0, 1.0),
        origin="lower",
        aspect="auto",
        cmap=colormaps[COLOURS[chart.scale]],
        interpolation="bilinear",
    )
    ticks = [tick for tick in bar_ticks(chart) if not _crowded(chart, tick, size[1])]
    texts = [(tick, number(tick, digits=6), theme.muted) for tick in ticks]
    critical = [each for each in chart.critical if _within(chart, each.value)]
    texts += [(each.value, each.name, theme.limit) for each in critical]
    for each in critical:
        at = float(norm(each.value))
        axes.plot([0.0, 1.0], [at, at], color=theme.limit, linewidth=1.6, linestyle=(0, (2, 1)))
    for value, text, color in texts:
        place = 1.0 + TICK_ROOM * 0.6 / size[0], float(norm(value))
        axes.text(*place, text, fontsize=SMALL, color=color, va="center_baseline")


def _crowded(chart: Map, tick: float, height: float) -> bool:
    """Whether a tick would meet the name of a critical value."""
    norm = _norm(chart)
    named = [each.value for each in chart.critical if _within(chart, each.value)]
    return any(abs(float(norm(tick)) - float(norm(each))) * height < NAME_ROOM for each in named)


def _within(chart: Map, value: float) -> bool:
    low, high = color_range(chart)
    return low <= value <= high


def _norm(chart: Map) -> Normalize:
    low, high = color_range(chart)
    return LogNorm(low, high) if chart.scale is Scale.RATIO else Normalize(low, high)


def map_ranges(panel: Panel, chart: Map) -> tuple[Range, Range]:
    """Both axes of a map."""
    return _range(chart.x, panel.x), _range(chart.y, panel.y)


def _range(coordinate: Values, axis: Axis) -> Range:
    if axis.log:
        return chosen_range(axis, (coordinate,), snug=True, most=5)
    low, high = axis.limits or (float(coordinate.min()), float(coordinate.max()))
    if low == high:
        low, high = low - 0.5, high + 0.5
    return Range(low, high, axis.ticks or nice_ticks(low, high, 5))


def _image(chart: Map, x: Range, y: Range) -> Values:
    """The values on an even grid, as an image needs them: linear between points, nothing inside a groove."""
    across = np.linspace(0.0, 1.0, min(IMAGE[0], 2 * chart.x.size + 1))
    up = np.linspace(0.0, 1.0, min(IMAGE[1], 2 * chart.y.size + 1))
    columns, lines = x.places(chart.x), y.places(chart.y)
    rows = np.array([np.interp(across, columns, row) for row in chart.values])
    return np.array([np.interp(up, lines, column) for column in rows.T]).T


def _contours(axes: Axes, chart: Map, theme: Theme) -> None:
    """Thin lines at the colour bar's values, a strong dashed one at each critical value."""
    if min(chart.values.shape) < 2:
        return
    finite = chart.values[np.isfinite(chart.values)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 0.0)
    critical = [each.value for each in chart.critical]
    still = {Scale.RATIO: 1.0, Scale.SIGNED: 0.0}.get(chart.scale)  # where nothing happens there is only noise
    levels = [tick for tick in bar_ticks(chart) if low < tick < high and tick not in {*critical, still}]
    pale = chart.scale is not Scale.MAGNITUDE
    for values, style in (
        (levels, {"colors": "#1F2937" if pale else "#FFFFFF", "linewidths": 0.6, "alpha": 0.55}),
        (
            [value for value in critical if low < value < high],
            {"colors": theme.limit if not pale else "#111827", "linewidths": 1.5, "linestyles": "dashed"},
        ),
    ):
        if values:
            axes.contour(chart.x, chart.y, chart.values, levels=values, negative_linestyles="solid", **style)
