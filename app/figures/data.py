"""The content of a figure without its style: panels of lines, bars, rows and maps, with limits and marks.

Each number is in the unit of its axis and equals the number in the answer. NaN stands for a point without a value; the
curve has a gap at this point. Sequences are not changed after they have become part of a figure.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from app.errors import Unprocessable
from app.figures.wording import NO_BREAK, NOISE

Values = NDArray[np.float64]
ThemeName = Literal["light", "dark"]


FARTHEST_LEVEL = 4.0  # multiple of the range of values; a level of the ordinate farther away is off the scale


class Hue(StrEnum):
    """The colours of Okabe and Ito. The curves of a panel take the colours in the order of `ORDER`.

    A value such as `C0` is matplotlib's name for a colour in the colour cycle of the style sheet.
    """

    BLUE = "C0"
    VERMILLION = "C1"
    GREEN = "C2"
    PURPLE = "C3"
    ORANGE = "C4"
    SKY = "C5"
    GREY = "C6"


ORDER = tuple(Hue)


class Role(StrEnum):
    """Meaning of a line: the result, a reference for comparison, or another case."""

    RESULT = "result"
    REFERENCE = "reference"
    VARIANT = "variant"


def values(items: Sequence[float | None] | Values) -> Values:
    """Return a read-only array of the items. None becomes NaN, which stands for a point without a value."""
    array = np.array([np.nan if item is None else item for item in items], dtype=np.float64)
    array.flags.writeable = False
    return array


@dataclass(frozen=True, slots=True)
class Axis:
    """A quantity along an axis.

    If `magnitude` is set and the axis is a linear ordinate without `limits`, the axis includes zero.
    """

    title: str
    unit: str | None = None
    log: bool = False
    magnitude: bool = True
    limits: tuple[float, float] | None = None
    ticks: Sequence[float] | None = None
    symbol: str = ""

    @property
    def label(self) -> str:
        """Text at the axis: title, symbol and unit."""
        title = re.sub(r"(?=,| \(|$)", f" {self.symbol}", self.title, count=1) if self.symbol else self.title
        return f"{title},{NO_BREAK}{self.unit}" if self.unit else title


@dataclass(frozen=True, slots=True)
class Mark:
    """A point with a text. The point is usually an extreme, and the text usually states the value at this point."""

    x: float
    y: float
    text: str
    hue: Hue = Hue.BLUE


@dataclass(frozen=True, slots=True, eq=False)
class Line:
    """Points over an abscissa, drawn as a curve, as bars or as the outline of a polygon.

    The legend shows only lines that are `named`. If several polygons have the same title, the legend shows this title
    once. `stroke` is the number of a pattern of dashes; 0 is a solid curve. Different patterns distinguish curves of
    the same hue.
    """

    title: str
    x: Values
    y: Values
    hue: Hue = Hue.BLUE
    role: Role = Role.RESULT
    named: bool = True
    stroke: int = 0

    def mark(self, index: int, text: str) -> Mark:
        """Return a mark at the point with this index, in the hue of the line."""
        return Mark(float(self.x[index]), float(self.y[index]), text, self.hue)


@dataclass(frozen=True, slots=True, eq=False)
class Ribbon:
    """A band between two curves that share one abscissa."""

    title: str
    x: Values
    low: Values
    high: Values
    hue: Hue = Hue.BLUE


@dataclass(frozen=True, slots=True)
class Row:
    """A named value, drawn as a horizontal bar.

    If the row has `parts`, the bar consists of these parts, end to end. If the row has `dots`, a line with named points
    is drawn instead of the bar. `bounds` are the ends of the range of an uncertain value. If the value is NaN, the text
    "not calculated" is written.
    """

    name: str
    value: float
    hue: Hue = Hue.BLUE
    bounds: tuple[float, float] | None = None
    role: Role = Role.RESULT
    parts: Sequence["Row"] = ()
    dots: Sequence["Row"] = ()


class Scale(StrEnum):
    """Scale of colours of a map.

    MAGNITUDE begins at zero, or at the least value if this value is negative. RATIO is logarithmic and symmetrical
    about 1. SIGNED is linear and symmetrical about 0.
    """

    MAGNITUDE = "magnitude"
    RATIO = "ratio"
    SIGNED = "signed"


@dataclass(frozen=True, slots=True)
class Level:
    """A straight line across the panel: a limit if `limit` is set, else a reference.

    The value of a `vertical` level is an abscissa; the value of any other level is an ordinate. The name stands beside
    the line. The names of `points` stand in one row above the axes, and the names of `listed` levels in the legend.
    """

    value: float
    name: str
    limit: bool = False
    vertical: bool = False
    point: bool = False
    listed: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Map:
    """Values over two coordinates, indexed `[y][x]`, with contours at the `critical` values.

    `range` gives the values at both ends of the scale of colours; if it is None, the ends follow from the values of the
    map. `bar` states whether the map has a colour bar. If a figure compares several maps, these maps have the same
    `range`, and only the last one has a colour bar.
    """

    title: str
    unit: str | None
    x: Values
    y: Values
    values: Values
    scale: Scale = Scale.MAGNITUDE
    critical: Sequence[Level] = ()
    range: tuple[float, float] | None = None
    bar: bool = True

    @property
    def ends(self) -> tuple[float, float]:
        """Values at the two ends of the scale of colours: `range` if it is given, else ends that suit the values."""
        if self.range is not None:
            return self.range
        finite = self.values[np.isfinite(self.values)]
        low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
        match self.scale:
            case Scale.RATIO:
                reach = max(high, 1.0 / max(low, 1e-3), 1.0001)
                return 1.0 / reach, reach
            case Scale.SIGNED:
                reach = max(abs(low), abs(high), 1e-12)
                return -reach, reach
            case Scale.MAGNITUDE:
                low = min(low, 0.0)
                return low, high if high > low else low + 1.0


@dataclass(frozen=True, slots=True)
class Span:
    """A shaded range of the abscissa. `name` says why the range is shaded, in the legend if `listed` is set."""

    start: float
    stop: float
    name: str
    listed: bool = False


@dataclass(frozen=True, slots=True)
class Area:
    """A rectangle of the plane with a text in its middle."""

    left: float
    right: float
    bottom: float
    top: float
    text: str
    hue: Hue


@dataclass(frozen=True, slots=True, eq=False)
class Panel:
    """A pair of axes with the curves, maps and texts that are drawn on these axes.

    `shapes` are polygons. If `equal` is set, both axes have the same scale.
    """

    x: Axis
    y: Axis
    title: str | None = None
    lines: Sequence[Line] = ()
    ribbons: Sequence[Ribbon] = ()
    shapes: Sequence[Line] = ()
    bars: Sequence[Line] = ()
    rows: Sequence[Row] = ()
    map: Map | None = None
    areas: Sequence[Area] = ()
    levels: Sequence[Level] = ()
    spans: Sequence[Span] = ()
    marks: Sequence[Mark] = ()
    equal: bool = False

    @property
    def off_scale(self) -> list[Level]:
        """The levels of the ordinate that are not drawn, because they are too far from the values."""
        shown = [line.y for line in (*self.lines, *self.bars, *self.shapes)]
        shown += [edge for ribbon in self.ribbons for edge in (ribbon.low, ribbon.high)]
        shown += [self.map.y] if self.map is not None else []
        shown.append(np.array([mark.y for mark in self.marks] + [0.0] * self.y.magnitude))
        finite = np.concatenate(shown)
        finite = finite[np.isfinite(finite)]
        if self.y.limits is not None:
            low, high = self.y.limits
        elif self.y.log or not finite.size:
            return []
        else:
            low, high = float(finite.min()), float(finite.max())
            reach = max(FARTHEST_LEVEL * (high - low), NOISE * max(abs(low), abs(high)))
            low, high = low - reach, high + reach
        return [level for level in self.levels if not level.vertical and not low <= level.value <= high]


@dataclass(frozen=True, slots=True, eq=False)
class Figure:
    """Panels below a title and a finding. The title names the figure; the finding states the result of the figure.

    If `beside` is set, the panels stand side by side. If the title is empty, `Declaration.figure` uses the title of
    the declaration. The source always comes from the declaration. `unsolved` is the number of points without a
    solution. A `narrow` figure fits into a column of a report.
    """

    finding: str
    panels: Sequence[Panel]
    title: str = ""
    source: str = ""
    beside: bool = False
    unsolved: int = 0
    narrow: bool = False

    @property
    def subtitle(self) -> str:
        """Text below the title: the points without a solution, the finding, levels off the scale, and the source."""
        gaps = f"{self.unsolved} point{'s' * (self.unsolved > 1)} without solution" if self.unsolved else ""
        finding = re.sub(r"(?<=\d) | (?==)|(?<==) ", NO_BREAK, self.finding)  # keeps numbers with their units
        far = ", ".join(dict.fromkeys(level.name for panel in self.panels for level in panel.off_scale if level.name))
        parts = (gaps, finding, far and f"off the scale: {far}", self.source.replace(" ", NO_BREAK))
        return f"{NO_BREAK}· ".join(part for part in parts if part)


class NoFigure(Unprocessable):
    """Error that says why a case has no data for a figure.

    `path` is the dotted path of the request field that decides whether these data are present.
    """
