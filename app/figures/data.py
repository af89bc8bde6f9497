"""The content of a figure without its style: panels of lines, bars, rows and maps with their limits and marks.

Numbers are in the unit of their axis and equal those of the answer. NaN is a point without a value and leaves a gap.
Sequences are not changed after they have become part of a figure.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from app.errors import Unprocessable
from app.figures.wording import NO_BREAK

Values = NDArray[np.float64]
ThemeName = Literal["light", "dark"]


class Hue(StrEnum):
    """Colours of Okabe and Ito in the order of the curves, with matplotlib's names for the colours of a style."""

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
    """Return a read-only copy as an array; None becomes NaN, a point without a value."""
    array = np.array([np.nan if item is None else item for item in items], dtype=np.float64)
    array.flags.writeable = False
    return array


@dataclass(frozen=True, slots=True)
class Axis:
    """A quantity along an axis; the axis of a magnitude starts at zero if its values allow it."""

    title: str
    unit: str | None = None
    log: bool = False
    magnitude: bool = True
    limits: tuple[float, float] | None = None
    ticks: Sequence[float] | None = None
    symbol: str = ""

    @property
    def label(self) -> str:
        """Text at the axis: title, symbol and unit; the symbol stands before a comma or parenthesis in the title."""
        title = re.sub(r"(?=,| \(|$)", f" {self.symbol}", self.title, count=1) if self.symbol else self.title
        return f"{title},{NO_BREAK}{self.unit}" if self.unit else title


@dataclass(frozen=True, slots=True)
class Mark:
    """A point with a text, usually an extreme with its value."""

    x: float
    y: float
    text: str
    hue: Hue = Hue.BLUE


@dataclass(frozen=True, slots=True, eq=False)
class Line:
    """Points over an abscissa: a curve, bars or the outline of a polygon.

    A line is not `named` in the legend if its axis names it. Polygons with the same title are named once.
    """

    title: str
    x: Values
    y: Values
    hue: Hue = Hue.BLUE
    role: Role = Role.RESULT
    named: bool = True

    def mark(self, index: int, text: str) -> Mark:
        """Return a mark at one of the points, in the hue of the line."""
        return Mark(float(self.x[index]), float(self.y[index]), text, self.hue)


@dataclass(frozen=True, slots=True, eq=False)
class Ribbon:
    """A band between two curves over one abscissa."""

    title: str
    x: Values
    low: Values
    high: Values
    hue: Hue = Hue.BLUE


@dataclass(frozen=True, slots=True)
class Row:
    """A named value drawn as a horizontal bar, or as the sum of its `parts`; an indeterminate value has bounds.

    The text of the value NaN is "not calculated". If the row has `dots`, named points on a line replace the bar.
    """

    name: str
    value: float
    hue: Hue = Hue.BLUE
    bounds: tuple[float, float] | None = None
    role: Role = Role.RESULT
    parts: Sequence["Row"] = ()
    dots: Sequence["Row"] = ()


class Scale(StrEnum):
    """Scale of colours of a map: upwards from its least value, by ratio around 1, or around 0."""

    MAGNITUDE = "magnitude"
    RATIO = "ratio"
    SIGNED = "signed"


@dataclass(frozen=True, slots=True)
class Level:
    """A straight line across the panel: a limit or a reference; a `vertical` level is a value of the abscissa."""

    value: float
    name: str
    limit: bool = False
    vertical: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Map:
    """Values over two coordinates, `[y][x]`, with contours at the `critical` values.

    Maps of a comparison share the `range` of the colours; only the last of them shows the colour `bar`.
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
        """Values at both ends of the scale of colours: those of the range if there is one."""
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
    """A range of the abscissa that is shaded, with its reason."""

    start: float
    stop: float
    name: str


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
    """A pair of axes with its contents; `shapes` are polygons; `equal` axes have the same scale."""

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


@dataclass(frozen=True, slots=True, eq=False)
class Figure:
    """Panels under a title, which names the figure, and a finding, which states its result.

    `beside` puts the panels in a row. Title and source come from the declaration, but a case may have a title of its
    own. A `narrow` figure fits into a column of a report.
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
        """Finding, number of points without solution, and source."""
        gaps = f"{self.unsolved} point{'s' * (self.unsolved > 1)} without solution" if self.unsolved else ""
        return " · ".join(part for part in (gaps, self.finding, self.source.replace(" ", NO_BREAK)) if part)


class NoFigure(Unprocessable):
    """The case does not have the content of the figure; `path` is the dotted field of the request that decides it."""
