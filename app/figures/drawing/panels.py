"""Drawing of the contents of axes: curves, bars, rows, maps, polygons, limits, spans, marks and names."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import cycle, product
from math import copysign, hypot
from textwrap import fill
from typing import Any

import numpy as np
from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm, Normalize, to_rgba
from matplotlib.patches import Rectangle
from matplotlib.path import Path
from matplotlib.patheffects import withStroke
from matplotlib.text import Annotation, Text
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullLocator
from matplotlib.transforms import Bbox, BboxBase, ScaledTranslation
from scipy.optimize import isotonic_regression

from app.figures.data import FARTHEST_LEVEL, Line, Map, Panel, Role, Row, Scale, Values
from app.figures.drawing.style import DASHES, LIMIT, REFERENCES, STROKES, TEXT, patch, written
from app.figures.wording import NOISE, number, without_rounding

NAME_LENGTH, ROW_NAME_LENGTH = 17, 36  # characters per line of a legend, and of the name of a row
BAR_SHARE, TINT = 0.8, 0.2  # share of the spacing that bars fill; opacity of fills
LEGEND_COLUMNS = 2  # columns of a legend above narrow axes
LINE = 1.3 / 72.0  # inches; height of a line of text per point of letter size
NAME_BELOW = 36  # characters per line of the name below narrow axes
ROW = 0.52  # height of a row's bar divided by the distance between rows
POINT_REACH, POINT_GAP = 2, 2  # typographic points between the names of points and the axes, and between two names
LEAST_REACH = 7  # typographic points between a text and its point or vertical line
ROW_REACH = 3  # typographic points between a horizontal line and its name
WRONG = 4.0  # cost of a name that is nearer to another horizontal line, or separated from its point by a text
FAR = 12  # typographic points; a thin line leads from a point to its text if they are farther apart
# Typographic points between a text and a curve, for the edge of the text's patch and half the width of the curve; cost
# of a text that is closer to a curve but not over the curve.
CLEAR, CLOSE = 1.6, 0.2
HIDES = 2.0  # cost of a text that crosses a curve; one that covers a curve from end to end costs three times as much
INSET = 2.0  # typographic points between the text of an area and the edge of the area
AWAY = 6  # largest additional distance between a horizontal line and its name, in half heights of the name
# Number of steps in which the name of a line can be moved along the line; length of a downward step, as a multiple of
# the height of the name.
ALONG, DOWN = 8, 0.6
RING = 5  # pixels, half the side of the box around a mark
SIDES = {"above": 1, "below": -1}  # side of a point on which the text of the point is tried first
MOVED = {*SIDES, "row", "column"}  # texts of points, of horizontal and of vertical lines; other texts are not moved
# Ticks per decade of ratios. If the greatest ratio of a map is at most LINEAR_RATIO, ticks are evenly spaced instead.
RATIO_TICKS, LINEAR_RATIO = (1.0, 1.5, 2.0, 3.0, 5.0, 7.0), 1.5
FEW_DECADES = 100.0  # if the ratio of the ends of a logarithmic axis is smaller, there are ticks between powers of ten
CROWDED = 0.08  # share of the colour bar; a tick closer than this to a critical value is left out
BESIDE_ROWS = 0.4  # share of the range of rows; room for the texts at the ends of rows
WIDE = 0.15  # share of the longest bar; if bounds are farther apart than this, their values are written
STEPS = (1, 2, 2.5, 5, 10)  # permitted distances between ticks, to be multiplied by a power of ten
NUMBERS = FuncFormatter(lambda value, _: number(value, digits=6))

Style = dict[str, Any]  # keyword arguments of matplotlib's artists
# A dark edge on both sides of a curve makes the curve visible on every colour of a map.
OUTLINE: Style = {"path_effects": [withStroke(linewidth=3.2, foreground="#12171f", alpha=0.75)]}


def draw_panel(axes: Axes, panel: Panel, length: int, *, narrow: bool = False) -> None:
    """Draw a panel. The names of its axes have at most `length` characters per line."""
    name = "" if panel.rows else fill(panel.y.label, length)
    axes.set(xscale="log" if panel.x.log else "linear", yscale="log" if panel.y.log else "linear")
    points = LINE * TEXT * has_points(panel)  # height of the row of names between the axes and the name of the ordinate
    axes.set_title(panel.title or "", pad=4.0 + 72.0 * points + 1.3 * TEXT * len(name.splitlines()))
    axes.set_ylabel(name, rotation="horizontal", ha="left", va="bottom")
    above = axes.transAxes + ScaledTranslation(0.0, 4.0 / 72.0 + points, axes.figure.dpi_scale_trans)
    axes.yaxis.set_label_coords(0.0, 1.0, above)
    for axis, quantity in ((axes.xaxis, panel.x), (axes.yaxis, panel.y)):
        axis.set_major_locator(LogLocator(numticks=7) if quantity.log else MaxNLocator(nbins=6, steps=STEPS))
        axis.set_minor_locator(NullLocator())
        if quantity.ticks is not None:
            axis.set_ticks(quantity.ticks)
        axis.set_major_formatter(NUMBERS)
    # The name of the abscissa may be wider than axes with rows. The name therefore ends where such axes end.
    axes.set_xlabel(fill(panel.x.label, NAME_BELOW if narrow else length), loc="right" if panel.rows else "center")
    _draw_rows(axes, panel)
    _draw_fills(axes, panel)
    if panel.map is not None:
        _draw_map(axes, panel, panel.map)
    for bars in panel.bars:
        _draw_bars(axes, bars, [other for other in panel.bars if other.role is bars.role])
    for line in panel.lines:
        _draw_line(axes, line, OUTLINE if panel.map is not None else {})
    several = len({mark.hue for mark in panel.marks}) > 1
    rising = sorted(panel.marks, key=lambda mark: mark.y)
    for mark in reversed(rising):  # from the top down, as the names of levels
        style: Style = {"markersize": 5.5, "color": rcParams["figure.facecolor"], "mec": mark.hue, "mew": 1.6}
        axes.plot(mark.x, mark.y, "o", clip_on=False, zorder=5, **style)
        style = {"color": written(mark.hue) if several else rcParams["text.color"], "fontsize": TEXT}
        side = "above" if mark is rising[-1] else "below"
        _name(axes, mark.text, (mark.x, mark.y), gid=side, fontweight="bold", **style)
    _draw_levels(axes, panel)
    for span in panel.spans:
        shade: Style = {"facecolor": rcParams["grid.color"], "edgecolor": "none", "zorder": 2 if panel.map else 0}
        if span.listed and span.name:
            shade["label"] = fill(span.name, NAME_LENGTH)
        axes.axvspan(span.start, span.stop, **shade)
        top = (span.start + span.stop) / 2, 1.0
        if not span.listed:
            _name(axes, span.name, top, axes.get_xaxis_transform(), gid="column", color=rcParams["axes.labelcolor"])
    _draw_legend(axes, panel, narrow=narrow)


def _draw_legend(axes: Axes, panel: Panel, *, narrow: bool) -> None:
    """Draw the legend beside the axes, or above the axes if the figure is narrow or the panel has a map."""
    handles = dict[str, Any]()
    for handle in axes.get_legend_handles_labels()[0]:  # names may repeat; a curve comes before its band
        handles.setdefault(str(handle.get_label()), handle)
    if handles and narrow:  # above the name of the ordinate, because there is no room beside the axes
        above = axes.transAxes + ScaledTranslation(
            0.0, LINE * TEXT * (1 + bool(panel.title) + has_points(panel)), axes.figure.dpi_scale_trans
        )
        style: Style = {
            "loc": "lower left",
            "bbox_to_anchor": (0.0, 1.02),
            "bbox_transform": above,
            "ncols": LEGEND_COLUMNS,
        }
        axes.legend(handles.values(), handles, **style)
    elif handles and panel.map is not None:  # above the axes, because the colour bar stands beside the axes
        axes.legend(handles.values(), handles, loc="lower right", bbox_to_anchor=(1.0, 1.01), ncols=len(handles))
    elif handles:
        axes.legend(handles.values(), handles, bbox_to_anchor=(1.02, 1.0))


def legend_lines(panel: Panel) -> int:
    """Return the number of lines of the legend above a narrow panel."""
    fills = [*(ribbon.title for ribbon in panel.ribbons), *(shape.title for shape in panel.shapes)]
    fills += [span.name for span in panel.spans if span.listed and span.name]
    fills += [level.name for level in panel.levels if level.listed and level.name and level not in panel.off_scale]
    lines = [*(line.title for line in panel.lines if line.named), *fills]
    bars = [bars.title for bars in panel.bars] if len(panel.bars) > 1 else []
    names = dict.fromkeys([*lines, *bars, *(part.name for row in panel.rows for part in row.parts)])
    rows = -(-len(names) // LEGEND_COLUMNS)
    return rows * max((len(fill(name, NAME_LENGTH).splitlines()) for name in names), default=0)


def has_points(panel: Panel) -> bool:
    """Return True if the names of points stand above the axes."""
    return any(level.point and level.name for level in panel.levels)


def _end(axes: Axes, panel: Panel) -> None:
    """Set the ends of the axes to the limits in the panel. Without limits, leave room around the data.

    If the values of the ordinate differ only by rounding errors, the axis is widened so that these errors do not show.
    """
    if panel.equal:
        axes.set_aspect("equal", adjustable="box" if panel.x.limits else "datalim")
        axes.margins(0.08)
        if panel.y.limits:
            axes.set_ylim(panel.y.limits)
    elif panel.rows:
        axes.margins(x=BESIDE_ROWS)
    else:
        axes.margins(y=0.0 if panel.map else 0.16 if panel.marks else 0.08)
        low, high = panel.y.limits or axes.get_ylim()
        widest = max(abs(low), abs(high))
        noise = 0.5 * widest if high - low <= NOISE * widest else 0.0
        axes.set_ylim(low - noise, high + noise)
    if panel.x.limits:
        axes.set_xlim(panel.x.limits)
    for axis, quantity in ((axes.xaxis, panel.x), (axes.yaxis, panel.y)):
        low, high = axis.get_view_interval()
        if quantity.log and quantity.ticks is None and high < FEW_DECADES * low:
            axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))


def _draw_fills(axes: Axes, panel: Panel) -> None:
    """Draw areas, bands between curves, and polygons."""
    for area in panel.areas:
        axes.grid(visible=False)
        size = area.right - area.left, area.top - area.bottom
        axes.add_patch(Rectangle((area.left, area.bottom), *size, facecolor=to_rgba(area.hue, TINT), linewidth=0))
    for ribbon in panel.ribbons:
        style: Style = {
            "facecolor": ribbon.hue,
            "alpha": TINT,
            "linewidth": 0,
            "label": fill(ribbon.title, NAME_LENGTH),
        }
        axes.fill_between(ribbon.x, ribbon.low, ribbon.high, **style)
        axes.plot(ribbon.x, np.column_stack([ribbon.low, ribbon.high]), color=ribbon.hue, linewidth=0.8)
    for shape in panel.shapes:
        style = {"facecolor": to_rgba(shape.hue, TINT), "edgecolor": shape.hue, "linewidth": 1.0}
        axes.fill(shape.x, shape.y, label=fill(shape.title, NAME_LENGTH), **style)


def _draw_line(axes: Axes, line: Line, outline: Style) -> None:
    """Draw a curve. A point whose neighbours have no value is drawn as a dot, because no line leads to this point."""
    finite = np.isfinite(line.y)
    alone = finite & ~np.append(False, finite[:-1]) & ~np.append(finite[1:], False)
    dashes = STROKES[line.stroke % len(STROKES)] if line.role is Role.RESULT else DASHES[line.role]
    style: Style = {"color": line.hue, "linestyle": dashes, **outline}
    if line.named and finite.any():
        style["label"] = fill(line.title, NAME_LENGTH)
    if alone.any():
        style |= {"marker": "o", "markersize": 2.6, "markevery": alone}
    axes.plot(line.x, line.y, **style)


def _bar_style(role: Role, color: str) -> Style:
    """Return the style of a bar: filled, or a dashed outline if the bar belongs to a variant."""
    if role is Role.VARIANT:
        return {"facecolor": "none", "edgecolor": color, "linestyle": DASHES[role]}
    return {"facecolor": color}


def _draw_bars(axes: Axes, bars: Line, beside: list[Line]) -> None:
    """Draw the bars of the series `bars`."""
    pitch = float(np.diff(bars.x).min()) if len(bars.x) > 1 else 1.0
    width = BAR_SHARE * pitch / len(beside)
    left = bars.x - BAR_SHARE * pitch / 2 + beside.index(bars) * width
    style = _bar_style(bars.role, bars.hue)
    if bars.role is not Role.VARIANT and len(beside) > 1:
        style["label"] = fill(bars.title, NAME_LENGTH)
    axes.bar(left, np.nan_to_num(bars.y), width, align="edge", **style)


def _draw_rows(axes: Axes, panel: Panel) -> None:
    """Draw the rows as bars with their values, or as dots on lines. Bars of a variant lie over the bars of the case."""
    own = [row for row in panel.rows if row.role is not Role.VARIANT]
    if not own:
        return
    places = {row.name: place for place, row in enumerate(own)}
    axes.grid(visible=False, axis="y")
    axes.spines["left"].set_visible(False)
    if not any(row.dots for row in own):
        axes.axvline(0.0, color=rcParams["axes.edgecolor"], linewidth=0.9)
    for row in panel.rows:
        place = places[row.name]
        (_draw_dots if row.dots else _draw_row)(axes, place, row)
        if not row.dots and row.role is not Role.VARIANT:
            _write_value(axes, place, row, panel)
    axes.set_yticks(range(len(own)), [fill(row.name, ROW_NAME_LENGTH) for row in own])
    axes.set_ylim(len(own) - 0.5, -1.2 if panel.levels else -0.5)
    for text, row in zip(axes.get_yticklabels(), own, strict=True):
        text.set_color(written(row.hue))


def _draw_dots(axes: Axes, place: int, row: Row) -> None:
    """Draw the values of a row as dots on a line. The first and the last dot have their names beside them."""
    dots = sorted(row.dots, key=lambda dot: dot.value)
    axes.plot([dot.value for dot in dots], [place] * len(dots), color=rcParams["axes.edgecolor"], lw=3.0, zorder=1)
    for dot in dots:
        axes.plot(dot.value, place, "o", color=dot.hue, markersize=7)
    for dot, offset in ((dots[0], -7), (dots[-1], 7)):
        _write(axes, dot.name, (dot.value, place), offset, color=written(dot.hue), gid="dot")


def _draw_row(axes: Axes, place: int, row: Row) -> None:
    """Draw a row as one bar. If the row has parts, draw one bar per part, end to end."""
    left = 0.0
    for part in row.parts or [replace(row, name="", value=float(np.nan_to_num(row.value)))]:
        label = fill(part.name, NAME_LENGTH)
        axes.barh(place, part.value, ROW, left=left, label=label, **_bar_style(row.role, part.hue))
        left += part.value
    if row.bounds is not None and row.bounds[0] < row.bounds[1]:
        color = rcParams["text.color"] if row.role is Role.RESULT else row.hue
        style: Style = {"color": color, "linestyle": DASHES[row.role], "linewidth": 1.2}
        axes.plot(row.bounds, [place, place], marker="|", markersize=7, **style)


def _write_value(axes: Axes, place: int, row: Row, panel: Panel) -> None:
    """Write the value of a row to the right of its bar. A rounding error is written as zero."""
    scale = max((abs(other.value) for other in panel.rows if np.isfinite(other.value)), default=0.0)
    value, unit = without_rounding(row.value, scale), panel.x.unit
    text = number(value, unit) if np.isfinite(value) else "not calculated"
    same = [other for other in panel.rows if other.name == row.name]
    ends = [end for other in same for end in (other.value, *(other.bounds or ()))]
    written = _write(axes, text, (np.nanmax([0.0, *ends]), place), 4, fontsize=TEXT, fontweight="bold")
    if row.bounds is not None and row.bounds[1] - row.bounds[0] > WIDE * scale:
        low, high = (number(end) for end in row.bounds)
        _write(axes, f"({low} to {high})", (1, 0.5), 3, xycoords=written, color=rcParams["axes.labelcolor"])


def _write(axes: Axes, text: str, xy: tuple[float, float], offset: float, **style: Any) -> Text:
    """Write a text at the height of the point `xy`."""
    style |= {"textcoords": "offset points", "va": "center_baseline", "ha": "left" if offset > 0.0 else "right"}
    return axes.annotate(text, xy, (offset, 0), bbox=patch(), **style)


def _draw_map(axes: Axes, panel: Panel, chart: Map) -> None:
    """Draw a map in colours, with a colour bar and contours."""
    low, high = chart.ends
    norm = LogNorm(low, high) if chart.scale is Scale.RATIO else Normalize(low, high)
    still = {Scale.RATIO: 1.0, Scale.SIGNED: 0.0}.get(chart.scale)  # a contour at this value would show only noise
    cmap = "cividis" if still is None else "RdBu_r"
    # If a coordinate has a single value, the map does not change along the axis of this coordinate.
    x, y = (
        along if along.size > 1 else np.array(axis.limits or along[0] + (-0.5, 0.5))
        for along, axis in ((chart.x, panel.x), (chart.y, panel.y))
    )
    shown = np.ma.masked_invalid(np.broadcast_to(chart.values, (y.size, x.size)))
    edges = _edges(x, panel.x.log), _edges(y, panel.y.log)
    colors = axes.pcolormesh(*edges, shown, cmap=cmap, norm=norm, rasterized=True)
    axes.grid(visible=False)
    critical = {level.value: level.name for level in chart.critical if low <= level.value <= high}
    bar = axes.figure.colorbar(colors, axes.inset_axes((1.04, 0.0, 0.035, 1.0)), format=NUMBERS)
    decades = chart.scale is Scale.RATIO and high > LINEAR_RATIO
    bar.locator = LogLocator(subs=RATIO_TICKS) if decades else MaxNLocator(nbins=6, steps=STEPS)
    ticks = [tick for tick in bar.get_ticks() if low <= tick <= high]
    thin: Style = {"colors": "#FFFFFF" if still is None else "#1F2937", "linewidths": 0.6, "alpha": 0.55}
    strong: Style = {"colors": LIMIT if still is None else "#111827", "linewidths": 1.5, "linestyles": "dashed"}
    for levels, style in (({*ticks} - {*critical, still}, thin), ({*critical}, strong)):
        inside = sorted(level for level in levels if shown.min() < level < shown.max())
        if inside:
            contours = axes.contour(x, y, shown, inside, negative_linestyles="solid", **style)
            contours.set(**OUTLINE if style is strong and still is None else {})
    if not chart.bar:
        bar.ax.remove()
        return
    bar.outline.set_visible(False)
    bar.set_ticks([tick for tick in ticks if all(abs(norm(tick) - norm(value)) > CROWDED for value in critical)])
    bar.set_label(f"{chart.title}, {chart.unit}" if chart.unit else chart.title)
    bar.ax.yaxis.set_ticks(list(critical), list(critical.values()), minor=True)
    bar.ax.tick_params(which="minor", labelcolor=LIMIT)
    for value in critical:
        bar.ax.axhline(value, color=LIMIT, linewidth=1.6, linestyle=(0, (2, 1)), **OUTLINE)


def _edges(along: Values, log: bool) -> Values:
    """Return the edges of the cells around points."""
    scaled = np.log(along) if log else along
    edges = np.concatenate([scaled[:1], (scaled[1:] + scaled[:-1]) / 2, scaled[-1:]])
    return np.exp(edges) if log else edges


def _draw_levels(axes: Axes, panel: Panel) -> None:
    """Draw limits as dashed red lines, references as dotted grey lines, and zero as a grey line.

    References in the legend differ by their dashes. A level that is too far to the left or right is only named.
    """
    if panel.map is None and not panel.rows and not panel.y.log and panel.y.limits is None:
        low, high = axes.dataLim.intervaly
        if panel.y.magnitude or low < 0.0 < high:
            line = axes.axhline(0.0, color=rcParams["axes.edgecolor"], linewidth=0.8, zorder=1)
            line.sticky_edges.y.append(0.0)
    data, references = axes.dataLim.frozen(), cycle(REFERENCES)
    off_scale = panel.off_scale
    levels = [level for level in panel.levels if level not in off_scale]
    (low, high), x = data.intervalx, panel.x
    reach = FARTHEST_LEVEL * (high - low)
    for level in levels:
        if not level.vertical or x.log or x.limits or low - reach <= level.value <= high + reach:
            style = _level_style(level.limit)
            if level.listed and level.name:
                style["label"] = fill(level.name, NAME_LENGTH)
                style["linestyle"] = style["linestyle"] if level.limit else next(references)
            (axes.axvline if level.vertical else axes.axhline)(level.value, **style)
    _end(axes, panel)
    # Names are placed from the top down. If two levels are close, the name of the lower level is then below it.
    low, high = sorted(axes.get_xlim())
    top, right = axes.get_xaxis_transform(), axes.get_yaxis_transform()
    for level in sorted(levels, key=lambda level: (not level.vertical, -level.value)):
        name, color = level.name, _level_style(level.limit)["color"]
        if level.point:
            style = {"gid": "point", "ha": "center", "va": "bottom", "bbox": None}
            _name(axes, name, (level.value, 1.0), top, color=color, **style)
        elif level.vertical and name:
            name += " ←" if level.value < low else " →" if level.value > high else ""
            _name(axes, name, (float(np.clip(level.value, low, high)), 1.0), top, gid="column", color=color)
        elif not level.listed:
            _name(axes, name, (1.0, level.value), right, gid="row", color=color)


def _level_style(limit: bool) -> Style:
    if limit:
        return {"color": LIMIT, "linestyle": (0, (5.0, 2.5)), "linewidth": 1.3}
    return {"color": rcParams["axes.labelcolor"], "linestyle": (0, (1.0, 2.0)), "linewidth": 1.0}


def _name(axes: Axes, text: str, xy: tuple[float, float], xycoords: Any = "data", **style: Any) -> None:
    """Write a text on a patch in the background colour, at the point that the text names."""
    style = {"textcoords": "offset points", "in_layout": False, "zorder": 6, "annotation_clip": False, **style}
    if text:
        axes.annotate(text, xy, (0, 0), xycoords, **{"bbox": patch(), **style})


def _keep_clear(axes: Axes, text: Text, room: Bbox, points: list[Bbox], rings: list[Bbox]) -> None:
    """Move the text of an area to a free position in the area.

    A position is free if the text there overlaps no box in `points`. These boxes enclose points together with their
    texts. If no position is free, overlaps with texts are permitted: the text must then only avoid the boxes in
    `rings`, which enclose the points alone. If this is not possible either, the text is not moved.
    """
    box = text.get_window_extent()
    inset = INSET * axes.figure.dpi / 72.0
    free_x, free_y = (max((of - own) / 2 - inset, 0.0) for of, own in zip(room.size, box.size, strict=True))
    ways = (0, 0), (0, 1), (0, -1), (1, 0), (-1, 0), (1, 1), (-1, 1), (1, -1), (-1, -1)
    for taken, (across, up) in product((points, rings), ways):
        middle = (room.x0 + room.x1) / 2 + across * free_x, (room.y0 + room.y1) / 2 + up * free_y
        moved = Bbox.from_bounds(middle[0] - box.width / 2, middle[1] - box.height / 2, box.width, box.height)
        if not any(moved.overlaps(other) for other in taken):
            x, y = axes.transData.inverted().transform(middle)
            text.set_position((float(x), float(y)))
            return


def place_texts(axes: Axes, panel: Panel) -> None:
    """Write the texts of areas, and move the texts of points to places clear of other texts."""
    _place_points(axes)
    points = (axes.transData.transform((mark.x, mark.y)) for mark in panel.marks)
    rings = [Bbox([point - RING, point + RING]) for point in points]
    point = axes.figure.dpi / 72.0
    heights = [1.3 * TEXT * point * len(mark.text.splitlines()) for mark in panel.marks]
    named = [ring.padded(height) for ring, height in zip(rings, heights, strict=True)]
    for area in panel.areas:
        room = Bbox([(area.left, area.bottom), (area.right, area.top)]).transformed(axes.transData)
        middle = (area.left * area.right) ** 0.5, (area.bottom * area.top) ** 0.5  # the axes of areas are logarithmic
        text = axes.text(*middle, area.text, color=rcParams["axes.labelcolor"], ha="center", va="center")
        while (box := text.get_window_extent()).width > room.width or box.height > room.height:
            text.set_text(text.get_text().rpartition("\n")[0])
        _keep_clear(axes, text, room, named, rings)
    taken: list[Bbox] = [text.get_window_extent() for text in axes.texts if text.get_gid() not in MOVED]
    taken += [*rings, axes.yaxis.label.get_window_extent(), axes.title.get_window_extent()]
    shapes = [line for line in axes.lines if line.get_linestyle() != "None"]
    shapes += [bar for container in axes.containers for bar in container]
    curves = [shape.get_path().transformed(shape.get_transform()) for shape in shapes]
    rows = [_point_of(text)[1] for text in axes.texts if text.get_gid() == "row"]
    for text in [*axes.texts]:
        if text.get_gid() not in MOVED:
            continue
        text.set(ha="center", va="center")
        size, room, at = text.get_window_extent(), axes.bbox, _point_of(text)
        # The cost of a position is a sum. It counts the overlapped texts, the hidden parts of curves, the length of the
        # text outside the axes, the distance from the point, and whether the text seems to name another point or line.
        costs = {}
        for place, distance in _places(str(text.get_gid()), size, room, point):
            box = size.translated(*place)
            leader = Path([at, at + np.array(place)])
            if text.get_gid() == "row":
                wrong = int(any(abs(at[1] + place[1] - row) < abs(place[1]) - 0.01 for row in rows))
            elif text.get_gid() in SIDES:
                wrong = sum(leader.intersects_bbox(other) for other in taken if not other.contains(*at))
            else:
                wrong = 0
            outside = max(room.x0 - box.x0, box.x1 - room.x1, 0.0) + max(room.y0 - box.y0, box.y1 - room.y1, 0.0)
            near = box.padded(CLEAR * point)
            hidden = sum(_hidden(curve, box, near) for curve in curves if curve.intersects_bbox(near, filled=False))
            overlapped = sum(box.overlaps(other) for other in taken)
            costs[place] = hidden + 10.0 * overlapped + outside + distance + WRONG * wrong
        best = min(costs, key=costs.__getitem__)
        text.set_position((best[0] / point, best[1] / point))
        if isinstance(text, Annotation) and text.get_gid() in SIDES:
            curves += _lead(axes, text, size, best, point)
        taken.append(size.translated(*best).padded(2.0 * point))  # leaves space between the patches of two texts


def _place_points(axes: Axes) -> None:
    """Write the names of points in one row above the axes, each over its line. Names that would touch move apart."""
    names = sorted((text for text in axes.texts if text.get_gid() == "point"), key=lambda text: _point_of(text)[0])
    if names:
        at = np.array([_point_of(text)[0] for text in names])
        point = axes.figure.dpi / 72.0
        widths = np.array([text.get_window_extent().width for text in names])
        apart = np.append(0.0, np.cumsum((widths[1:] + widths[:-1]) / 2.0 + POINT_GAP * point))
        moved = isotonic_regression(at - apart).x + apart  # the least sum of squares of all moves
        for text, move in zip(names, (moved - at) / point, strict=True):
            text.set_position((float(move), POINT_REACH))


def _point_of(text: Text) -> Values:
    """Return the position [pixels] of the point that a text names, or of the end of the line that a text names."""
    assert isinstance(text, Annotation)
    coordinates: Any = text.xycoords
    axes = text.axes
    assert axes is not None
    transform = axes.transData if coordinates == "data" else coordinates
    point: Values = transform.transform(text.xy)
    return point


def _lead(axes: Axes, text: Annotation, size: BboxBase, place: tuple[float, float], point: float) -> list[Path]:
    """Draw a thin line from a point to its text if the text is far from the point. Return the lines that are drawn."""
    half = size.width / 2, size.height / 2
    x, y = (copysign(max(abs(off) - reach, 0.0), off) / point for off, reach in zip(place, half, strict=True))
    if hypot(x, y) <= FAR:
        return []
    style: Style = {"arrowstyle": "-", "color": text.get_color(), "linewidth": 0.8, "shrinkA": 0.0, "shrinkB": 3.5}
    axes.annotate("", text.xy, (x, y), "data", "offset points", arrowprops=style, annotation_clip=False)
    start = axes.transData.transform(text.xy)
    return [Path([start, start + np.array([x, y]) * point])]


def _hidden(curve: Path, box: Bbox, near: Bbox) -> float:
    """Return the penalty for the position of a text that hides a curve or stands close to a curve."""
    x, y = np.asarray(curve.vertices).T
    inside = x[(x > near.x0) & (x < near.x1) & (y > near.y0) & (y < near.y1)]
    length = float(np.ptp(inside)) if inside.size else 0.0
    return (HIDES if curve.intersects_bbox(box, filled=False) else CLOSE) + 2.0 * HIDES * length / near.width


def _places(kind: str, size: BboxBase, room: BboxBase, point: float) -> Iterator[tuple[tuple[float, float], float]]:
    """Yield positions to try for a text, each position with a penalty."""
    gap = (ROW_REACH if kind == "row" else LEAST_REACH) * point
    if kind == "row":
        free = max(room.width - size.width - 2 * gap, 0.0)
        for step, away, side in product(range(ALONG + 1), range(AWAY + 1), (1, -1)):
            left = gap + size.width / 2 + free * step / ALONG
            off = gap + size.height / 2 + away * size.height / 2
            yield (-left, side * off), 0.05 * step + 0.02 * (side < 0) + 0.75 * away
    elif kind == "column":
        for step, side in product(range(2 * ALONG + 1), (0, 1, -1)):
            below = gap + size.height / 2 + DOWN * step * size.height
            yield (side * (gap + size.width / 2), -below), 0.2 * step + 0.1 * abs(side)
    else:
        side = SIDES[kind]
        for reach in (LEAST_REACH, 12, 20, 32, 48, 64):
            for across, up in ((0, side), (0, -side), (1, 0), (-1, 0), (1, 0.7), (-1, 0.7), (1, -0.7), (-1, -0.7)):
                far = reach * point
                yield (across * (far + size.width / 2), up * (far + size.height / 2)), reach / 32.0
