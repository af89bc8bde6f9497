"""Draws the contents of one pair of axes: curves, bars, rows, maps, polygons, limits, spans, marks and names."""

from collections.abc import Iterator
from itertools import pairwise, takewhile
from math import log
from textwrap import fill
from typing import Any, NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backend_bases import RendererBase
from matplotlib.colors import LogNorm, Normalize, to_rgba
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle
from matplotlib.path import Path
from matplotlib.text import Text
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullLocator
from matplotlib.transforms import Bbox, BboxBase

from app.figures.data import Area, Axis, Bars, Hue, Level, Line, Map, Panel, Part, Role, Row, Scale, Values
from app.figures.drawing.style import (
    DASHES,
    LETTER,
    LIMIT_DASHES,
    LINE_HEIGHT,
    REFERENCE_DASHES,
    TEXT,
    Theme,
)
from app.figures.wording import number

FARTHEST_LEVEL = 4.0  # a limit beyond so many times the values is named at the edge instead of flattening them
NAME_LENGTH, ROW_NAME_LENGTH = 17, 36  # characters of a line of a name at the right of the axes, and of a row's
BAR_SHARE, FAINT, TINT = 0.8, 0.6, 0.2  # of the spacing; opacity of bars beside the extreme one, and of fills
ROW = 0.52  # height of a row's bar
AREAS_WIDTH, NARROW = 4.8, 0.85  # inches of axes with areas; width of their texts over the mean
RING = 5  # pixels
SIDES = {"above": 1, "below": -1}  # of a point, on which its text is tried first; other texts stay where they are
COLOURS = {Scale.MAGNITUDE: "cividis", Scale.RATIO: "RdBu_r", Scale.SIGNED: "RdBu_r"}
# Of a ratio on a logarithmic axis.
RATIO_TICKS = (0.1, 0.2, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0, 100.0)
LINEAR_RATIO = 1.3  # up to which a ratio's ticks are evenly spaced
CROWDED = 0.05  # of the colour bar: a tick nearer to a critical value gives way
DOTS_MARGINS = 0.55, 0.4  # of the reach of dots, for their titles
WIDE = 0.15  # of the longest bar: bounds farther apart have their values at their ends
NOISE = 1e-9  # of the values: what varies by less is rounding error
STEPS = (1, 2, 2.5, 5, 10)  # of ticks, times powers of ten
NUMBERS = FuncFormatter(lambda value, _: number(value, digits=6))

Style = dict[str, Any]  # of matplotlib's artists


class Name(NamedTuple):
    """A name beside the axes: where its line ends, from 0 at the bottom to 1 at the top, and its line in a legend."""

    end: float
    text: str
    color: str
    handle: Artist


def draw_panel(axes: Axes, panel: Panel, theme: Theme, height: float) -> None:
    """Everything of a panel of a height in inches; the texts of points stay for `place_texts`."""
    for which, quantity in (("x", panel.x), ("y", panel.y)):
        _scale(axes, which, quantity)
    _draw_fills(axes, panel, theme, height)
    if panel.rows:
        _draw_rows(axes, panel, theme)
    if panel.map is not None:
        _draw_map(axes, panel, panel.map, theme)
    for bars in panel.bars:
        _draw_bars(axes, bars, [each for each in panel.bars if each.role is bars.role], theme)
    for line in panel.lines:
        _draw_line(axes, line, theme)
    _draw_marks(axes, panel, theme)
    levels = _draw_levels(axes, panel, theme)
    for span in panel.spans:
        axes.axvspan(span.start, span.stop, facecolor=theme.shade, edgecolor="none", zorder=2 if panel.map else 0)
        _name(axes, span.name, ((span.start + span.stop) / 2, 1.0), theme.muted, theme, axes.get_xaxis_transform())
    _end(axes, panel)
    axes.set_title(panel.title or "")
    axes.set_xlabel(panel.x.label, loc="right" if panel.rows else "center")  # it may be wider than the axes of rows
    if not panel.rows:
        axes.set_ylabel(fill(panel.y.label, max(round(height / LETTER), 10)))
    _name_beside(axes, panel, levels, theme, height)


def _scale(axes: Axes, which: str, quantity: Axis) -> None:
    """Linear or logarithmic, with the numbers at the ticks."""
    axis = axes.xaxis if which == "x" else axes.yaxis
    if quantity.log:
        axes.set(**{f"{which}scale": "log"})
        axis.set_major_locator(LogLocator(numticks=7))
        axis.set_minor_locator(NullLocator())
    elif quantity.ticks is None:
        axis.set_major_locator(MaxNLocator(nbins=6, steps=STEPS))
    if quantity.ticks is not None:
        axis.set_ticks(quantity.ticks)
    axis.set_major_formatter(NUMBERS)


def _end(axes: Axes, panel: Panel) -> None:
    """The ends of the axes where they are asked for; no axis shows rounding errors."""
    if panel.equal:
        axes.set_aspect("equal", adjustable="box" if panel.x.limits else "datalim")
        axes.margins(0.08)
        if panel.x.limits:
            axes.set(xlim=panel.x.limits, ylim=panel.y.limits)
        return
    if panel.rows:
        drawn = [each.dataLim for each in axes.get_shared_x_axes().get_siblings(axes)]
        low, high = Bbox.union([box for box in drawn if np.isfinite(box.intervalx).all()]).intervalx
        dots, named = any(row.dots for row in panel.rows), any(row.parts or row.bounds for row in panel.rows)
        left, right = DOTS_MARGINS if dots else (0.35 * (low < 0.0) * named, 0.2 if named else 0.04)
        reach = high - low or 1.0
        axes.set_xlim(low - left * reach, high + right * reach)
        return
    axes.margins(y=0.0 if panel.map else 0.16 if panel.marks else 0.08)
    axes.set_xlim(panel.x.limits)
    low, high = panel.y.limits or axes.get_ylim()
    widest = max(abs(low), abs(high))
    noise = 0.5 * widest if high - low <= NOISE * widest else 0.0
    axes.set_ylim(low - noise, high + noise)


def _tinted(color: str) -> Style:
    return {"facecolor": to_rgba(color, TINT), "edgecolor": color}


def _draw_fills(axes: Axes, panel: Panel, theme: Theme, height: float) -> None:
    """Areas with their texts, bands between curves, and polygons."""
    for area in panel.areas:
        axes.grid(visible=False)
        style = _tinted(theme.drawing[area.hue]) | {"edgecolor": "none"}
        axes.add_patch(Rectangle((area.left, area.bottom), area.right - area.left, area.top - area.bottom, **style))
        middle = (area.left * area.right) ** 0.5, (area.bottom * area.top) ** 0.5
        axes.text(*middle, _fitting(area, panel, height), color=theme.muted, ha="center", va="center", in_layout=False)
    for ribbon in panel.ribbons:
        color = theme.drawing[ribbon.hue]
        axes.fill_between(ribbon.x, ribbon.low, ribbon.high, facecolor=color, alpha=TINT, linewidth=0)
        axes.plot(ribbon.x, np.column_stack([ribbon.low, ribbon.high]), color=color, linewidth=0.8)
    for shape in panel.shapes:
        axes.fill(shape.x, shape.y, linewidth=1.0, **_tinted(theme.drawing[shape.hue]))


def _fitting(area: Area, panel: Panel, height: float) -> str:
    """As many lines of the text of an area as it has room for; both axes are logarithmic."""
    assert panel.x.limits is not None
    assert panel.y.limits is not None
    (left, right), (bottom, top) = panel.x.limits, panel.y.limits
    width = AREAS_WIDTH * log(area.right / area.left) / log(right / left)
    room = height * log(area.top / area.bottom) / log(top / bottom) / LINE_HEIGHT
    lines = area.text.split("\n")[: int(room)]
    return "\n".join(takewhile(lambda line: NARROW * LETTER * len(line) < width, lines))


def _draw_line(axes: Axes, line: Line, theme: Theme) -> None:
    """A curve; a point whose neighbours have no value, which a line would not show, as a dot."""
    color, width = theme.drawing[line.hue], 1.6 if line.role is Role.RESULT else 1.4
    axes.plot(line.x, line.y, color=color, linestyle=DASHES[line.role], linewidth=width)
    known = np.concatenate([[False], np.isfinite(line.y), [False]])
    alone = known[1:-1] & ~known[:-2] & ~known[2:]
    if alone.any():
        axes.plot(line.x[alone], line.y[alone], "o", color=color, markersize=2.6)


def _bar_style(role: Role, color: str) -> Style:
    """Filled, or the dashed outline of a variant."""
    if role is Role.VARIANT:
        return {"facecolor": "none", "edgecolor": color, "linestyle": DASHES[role]}
    return {"facecolor": color}


def _draw_bars(axes: Axes, bars: Bars, beside: list[Bars], theme: Theme) -> None:
    """Bars of one of the series that stand beside each other."""
    pitch = float(np.diff(bars.x).min()) if len(bars.x) > 1 else 1.0
    width = BAR_SHARE * pitch / len(beside)
    left = bars.x - BAR_SHARE * pitch / 2 + beside.index(bars) * width
    style = _bar_style(bars.role, theme.drawing[bars.hue])
    drawn = axes.bar(left, np.nan_to_num(bars.height), width, align="edge", **style)
    for index, patch in enumerate(drawn.patches if bars.strong is not None else ()):
        patch.set_alpha(1.0 if index == bars.strong else FAINT)


def _draw_rows(axes: Axes, panel: Panel, theme: Theme) -> None:
    """Horizontal bars, of one part or several, or dots on a line; with names, values and bounds."""
    own = {row.name: row for row in panel.rows if row.role is not Role.VARIANT}
    names = list(own)
    axes.grid(visible=False, axis="y")
    axes.spines["left"].set_visible(False)
    if not any(row.dots for row in panel.rows):
        axes.axvline(0.0, color=theme.frame, linewidth=0.9)
    for row in (row for row in panel.rows if row.name in own and not row.dots):
        left, place = 0.0, names.index(row.name)
        for part in row.parts or (Part("", float(np.nan_to_num(row.value)), row.hue),):
            axes.barh(place, part.value, ROW, left=left, **_bar_style(row.role, theme.drawing[part.hue]))
            left += part.value
        if row.bounds is not None and row.bounds[0] < row.bounds[1]:
            axes.plot(row.bounds, [place, place], color=theme.ink, linewidth=1.2, marker="|", markersize=7)
    for place, row in enumerate(own.values()):
        if row.dots:
            _draw_dots(axes, place, row, theme)
        else:
            _value_row(axes, place, row, panel, theme)
    axes.set_yticks(range(len(own)), [fill(name, ROW_NAME_LENGTH) for name in names])
    axes.set_ylim(len(own) - 0.5, -1.2 if panel.levels else -0.5)
    for label, row in zip(axes.get_yticklabels(), own.values(), strict=True):
        label.set_color(theme.writing[row.hue])


def _value_row(axes: Axes, place: int, row: Row, panel: Panel, theme: Theme) -> None:
    """The value of a row at its right, and those of its bounds at their ends; rounding errors are zero."""
    scale = max((abs(each.value) for each in panel.rows if np.isfinite(each.value)), default=0.0)
    alike = [each for each in panel.rows if each.name == row.name]
    tip = max([0.0, *(end for each in alike for end in (each.value, *(each.bounds or ())) if np.isfinite(end))])
    unit, offset = panel.x.unit or "", 4.0
    style: Style = {"va": "center_baseline", "bbox": _patch(theme), "textcoords": "offset points"}
    if row.bounds is not None and row.bounds[1] - row.bounds[0] > WIDE * scale:
        low, high = (number(end, unit) for end in row.bounds)
        axes.annotate(low, (row.bounds[0], place), (-5, 0), color=theme.muted, ha="right", **style)
        axes.annotate(high, (row.bounds[1], place), (5, 0), color=theme.muted, ha="left", **style)
        offset += 8.0 + 72.0 * LETTER * len(high)
    text = "not calculated"
    if np.isfinite(row.value):
        text = number(0.0 if abs(row.value) <= NOISE * scale else row.value, unit)
    axes.annotate(text, (tip, place), (offset, 0), ha="left", fontsize=TEXT, fontweight="bold", **style)


def _draw_dots(axes: Axes, place: int, row: Row, theme: Theme) -> None:
    """The values of a row on a line with titles at its ends."""
    dots = sorted(row.dots, key=lambda dot: dot.value)
    axes.plot([dot.value for dot in dots], [place] * len(dots), color=theme.frame, linewidth=3.0, zorder=1)
    for dot in dots:
        axes.plot(dot.value, place, "o", color=theme.drawing[dot.hue], markersize=7)
    style: Style = {"va": "center_baseline", "textcoords": "offset points"}
    for dot, offset, side in ((dots[0], -7, "right"), (dots[-1], 7, "left")):
        axes.annotate(dot.title, (dot.value, place), (offset, 0), ha=side, color=theme.writing[dot.hue], **style)


def _draw_map(axes: Axes, panel: Panel, chart: Map, theme: Theme) -> None:
    """Colours with their bar, thin contours at the bar's values, a dashed one at each critical value."""
    low, high = chart.ends
    norm = LogNorm(low, high) if chart.scale is Scale.RATIO else Normalize(low, high)
    x, y = _stretched(chart.x, panel.x), _stretched(chart.y, panel.y)
    shown = np.ma.masked_invalid(np.broadcast_to(chart.values, (y.size, x.size)))
    colors = axes.pcolormesh(x, y, shown, cmap=COLOURS[chart.scale], norm=norm, shading="gouraud", rasterized=True)
    axes.grid(visible=False)
    critical = {each.value: each.name for each in chart.critical if low <= each.value <= high}
    linear = chart.scale is not Scale.RATIO or high <= LINEAR_RATIO
    ticks = MaxNLocator(nbins=6, steps=STEPS).tick_values(low, high) if linear else RATIO_TICKS
    ticks = [tick for tick in ticks if low <= tick <= high]
    still = {Scale.RATIO: 1.0, Scale.SIGNED: 0.0}.get(chart.scale)  # beside it there is only noise
    thin: Style = {"colors": "#FFFFFF" if still is None else "#1F2937", "linewidths": 0.6, "alpha": 0.55}
    strong: Style = {"colors": theme.limit if still is None else "#111827", "linewidths": 1.5, "linestyles": "dashed"}
    for levels, line in (({*ticks} - {*critical, still}, thin), ({*critical}, strong)):
        inside = sorted(level for level in levels if shown.min() < level < shown.max())
        if inside:
            axes.contour(x, y, shown, inside, negative_linestyles="solid", **line)
    if not chart.bar:
        return
    bar = axes.figure.colorbar(colors, ax=axes, pad=0.03, aspect=22, format=NUMBERS)
    bar.outline.set_visible(False)
    bar.set_ticks([tick for tick in ticks if all(abs(norm(tick) - norm(each)) > CROWDED for each in critical)])
    bar.set_label(f"{chart.title}, {chart.unit}" if chart.unit else chart.title)
    bar.ax.yaxis.set_ticks(list(critical), list(critical.values()), minor=True)
    bar.ax.tick_params(which="minor", labelcolor=theme.limit)
    for value in critical:
        bar.ax.axhline(value, color=theme.limit, linewidth=1.6, linestyle=(0, (2, 1)))


def _stretched(coordinate: Values, axis: Axis) -> Values:
    """The values of a coordinate; for a single value, which holds everywhere, the ends of its axis."""
    middle = float(coordinate[0])
    return coordinate if coordinate.size > 1 else np.array(axis.limits or (middle - 0.5, middle + 0.5))


def _draw_marks(axes: Axes, panel: Panel, theme: Theme) -> None:
    """Rings with texts, the lowest first; in the hues of their curves where there are several."""
    several = len({mark.hue for mark in panel.marks}) > 1
    rising = sorted(panel.marks, key=lambda mark: mark.y)
    for mark in rising:
        style: Style = {"markersize": 5.5, "color": theme.background, "mec": theme.drawing[mark.hue], "mew": 1.6}
        axes.plot(mark.x, mark.y, "o", clip_on=False, zorder=5, **style)
        color = theme.writing[mark.hue] if several else theme.ink
        side = "above" if mark is rising[-1] else "below"
        _name(axes, mark.text, (mark.x, mark.y), color, theme, gid=side, fontsize=TEXT, fontweight="bold")


def _draw_levels(axes: Axes, panel: Panel, theme: Theme) -> list[tuple[Level, Line2D]]:
    """Limits dashed in red and references dotted in grey, those near the values; zero where it is crossed."""
    if panel.map is None and not panel.rows and not panel.y.log and panel.y.limits is None:
        low, high = axes.dataLim.intervaly
        if panel.y.magnitude or low < 0.0 < high:
            axes.axhline(0.0, color=theme.frame, linewidth=0.8, zorder=1).sticky_edges.y.append(0.0)
    drawn = []
    ends = {True: axes.dataLim.intervalx.copy(), False: axes.dataLim.intervaly.copy()}
    for level in panel.levels:
        low, high = ends[level.vertical]
        reach = FARTHEST_LEVEL * (high - low)
        color, dashes = (theme.limit, LIMIT_DASHES) if level.limit else (theme.muted, REFERENCE_DASHES)
        style: Style = {"color": color, "linestyle": dashes, "linewidth": 1.3 if level.limit else 1.0}
        if (panel.x if level.vertical else panel.y).log or low - reach <= level.value <= high + reach:
            drawn.append((level, (axes.axvline if level.vertical else axes.axhline)(level.value, **style)))
        else:
            drawn.append((level, Line2D([], [], **style)))
        if level.vertical:
            _name(axes, level.name, (level.value, 1.0), color, theme, axes.get_xaxis_transform())
    return drawn


def _name(
    axes: Axes, text: str, xy: tuple[float, float], color: str, theme: Theme, xycoords: Any = "data", **style: Any
) -> None:
    """A text for a point, on a patch of background; `place_texts` finds its place."""
    style = {"gid": "below", "textcoords": "offset points", "in_layout": False, "zorder": 6, **style}
    if text:
        axes.annotate(text, xy, (0, 0), xycoords, color=color, bbox=_patch(theme), annotation_clip=False, **style)


def _patch(theme: Theme) -> Style:
    return {"facecolor": theme.background, "alpha": 0.78, "linewidth": 0, "pad": 0.8}


def _name_beside(axes: Axes, panel: Panel, levels: list[tuple[Level, Line2D]], theme: Theme, height: float) -> None:
    """Names at the right of the axes: where lines and levels end if these ends are apart, else in a legend."""
    names = list(_names(axes, panel, levels, theme))
    if not panel.equal:
        names.sort(key=lambda each: -each.end)
    halves = [(1 + each.text.count("\n")) * LINE_HEIGHT / 2 / height for each in names]
    ends = [min(max(each.end, half), 1.0 - half) for each, half in zip(names, halves, strict=True)]
    near = (upper - one < lower + other for (upper, one), (lower, other) in pairwise(zip(ends, halves, strict=True)))
    if panel.equal or any(near):
        entries = [each.handle for each in names], [each.text for each in names]
        axes.legend(*entries, loc="upper left", bbox_to_anchor=(1.02, 1.0), labelcolor=[each.color for each in names])
        return
    style: Style = {"xycoords": "axes fraction", "textcoords": "offset points", "va": "center"}
    for name, end in zip(names, ends, strict=True):
        axes.annotate(name.text, (1.0, end), (5, 0), color=name.color, **style)


def _names(axes: Axes, panel: Panel, levels: list[tuple[Level, Line2D]], theme: Theme) -> Iterator[Name]:
    """Horizontal levels, lines, and what is filled: polygons, bars that stand beside others, the parts of rows."""

    def end(value: float) -> float:
        point = axes.transData.transform((axes.get_xlim()[0], value))
        return float(axes.transAxes.inverted().transform(point)[1])

    for level, handle in levels:
        if level.name and not level.vertical:
            at = end(level.value)
            text = level.name + (" ↑" if at > 1.0 else " ↓" if at < 0.0 else "")
            yield Name(at, fill(text, NAME_LENGTH), str(handle.get_color()), handle)
    for line in panel.lines:
        if line.named and line.role is not Role.VARIANT and np.isfinite(line.y).any():
            handle = Line2D([], [], color=theme.drawing[line.hue], linestyle=DASHES[line.role])
            at = end(line.y[np.isfinite(line.y)][-1])
            yield Name(at, fill(line.title, NAME_LENGTH), theme.writing[line.hue], handle)
    bars = {each.title: each.hue for each in panel.bars if each.role is not Role.VARIANT}
    filled: dict[str, Hue] = {shape.title: shape.hue for shape in panel.shapes}
    filled |= bars if len(bars) > 1 else {}
    filled |= {part.title: part.hue for row in panel.rows for part in row.parts}
    for title, hue in filled.items():
        style: Style = _tinted(theme.drawing[hue]) if panel.shapes else {"color": theme.drawing[hue]}
        yield Name(0.0, fill(title, NAME_LENGTH), theme.writing[hue], Rectangle((0, 0), 1, 1, **style))


def place_texts(axes: Axes, panel: Panel, renderer: RendererBase) -> None:
    """Put the texts of points beside them, off other texts and off curves."""
    fixed = [text for text in axes.texts if text.get_gid() not in SIDES]
    taken: list[BboxBase] = [text.get_window_extent(renderer) for text in fixed]
    rings = (axes.transData.transform((mark.x, mark.y)) for mark in panel.marks)
    taken += [Bbox([ring - RING, ring + RING]) for ring in rings]
    shapes = [line for line in axes.lines if line.get_linestyle() != "None"]
    shapes += [bar for each in axes.containers for bar in each]
    curves = [shape.get_path().transformed(shape.get_transform()) for shape in shapes]
    for text in axes.texts:
        if text.get_gid() in SIDES:
            taken.append(_place(axes.bbox, text, taken, curves, renderer))


def _place(axes: BboxBase, text: Text, taken: list[BboxBase], curves: list[Path], renderer: RendererBase) -> BboxBase:
    """Move the text to the first of the places around its point that cover least; the box it fills there."""
    text.set(ha="center", va="center")
    side = SIDES[str(text.get_gid())]
    size, point = text.get_window_extent(renderer), float(np.asarray(renderer.points_to_pixels(1.0)))

    def cost(place: tuple[float, float]) -> float:
        box = size.translated(*place)
        outside = max(axes.x0 - box.x0, box.x1 - axes.x1, 0.0) + max(axes.y0 - box.y0, box.y1 - axes.y1, 0.0)
        crossed = sum(curve.intersects_bbox(box, filled=False) for curve in curves)
        return float(crossed + 10.0 * sum(box.overlaps(other) for other in taken) + outside)

    places = [
        (across * (reach * point + size.width / 2), up * (reach * point + size.height / 2))
        for reach in (7, 12, 20, 32, 48, 64)
        for across, up in ((0, side), (0, -side), (1, 0), (-1, 0), (1, 0.7), (-1, 0.7), (1, -0.7), (-1, -0.7))
    ]
    best = min(places, key=cost)
    text.set_position((best[0] / point, best[1] / point))
    return size.translated(*best)
