"""What a figure shows, without how it looks: panels of lines, bars, rows and maps with their limits and marks.

Every number is in the unit of its axis and equals the answer's; NaN is a point without a value, and a gap. Sequences
are not changed once they are part of a figure.
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
    """Colours of Okabe and Ito in the order in which curves take them, as matplotlib names those of a style's cycle."""

    BLUE = "C0"
    VERMILLION = "C1"
    GREEN = "C2"
    PURPLE = "C3"
    ORANGE = "C4"
    SKY = "C5"
    GREY = "C6"


ORDER = tuple(Hue)


class Role(StrEnum):
    """Why a line is there: the result, something known to hold it against, or another case."""

    RESULT = "result"
    REFERENCE = "reference"
    VARIANT = "variant"


def values(items: Sequence[float | None] | Values) -> Values:
    """A read-only copy as an array; None, a point without a value, becomes NaN."""
    array = np.array([np.nan if item is None else item for item in items], dtype=np.float64)
    array.flags.writeable = False
    return array


@dataclass(frozen=True, slots=True)
class Axis:
    """A quantity along an axis; a magnitude's axis starts at zero where its values allow."""

    title: str
    unit: str | None = None
    log: bool = False
    magnitude: bool = True
    limits: tuple[float, float] | None = None
    ticks: Sequence[float] | None = None
    symbol: str = ""

    @property
    def label(self) -> str:
        """Title, symbol and unit as they stand at the axis; the symbol before what explains the title."""
        title = re.sub(r"(?=,| \(|$)", f" {self.symbol}", self.title, count=1) if self.symbol else self.title
        return f"{title},{NO_BREAK}{self.unit}" if self.unit else title


@dataclass(frozen=True, slots=True)
class Mark:
    """A point with a text, usually the extreme with its value."""

    x: float
    y: float
    text: str
    hue: Hue = Hue.BLUE


@dataclass(frozen=True, slots=True, eq=False)
class Line:
    """Points over an abscissa: a curve, bars or the outline of a polygon.

    One that is not named needs no label, because its axis says what it is. Polygons of one title are named once.
    """

    title: str
    x: Values
    y: Values
    hue: Hue = Hue.BLUE
    role: Role = Role.RESULT
    named: bool = True

    def mark(self, index: int, text: str) -> Mark:
        """A mark at one of the points, in the hue of the line."""
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
    """A named value drawn as a horizontal bar, with its bounds where it is indeterminate; or the sum of its `parts`.

    NaN is a value that was not calculated, and is said to be that. Instead of the bar `dots` are points on a line, each
    with its name.
    """

    name: str
    value: float
    hue: Hue = Hue.BLUE
    bounds: tuple[float, float] | None = None
    role: Role = Role.RESULT
    parts: Sequence["Row"] = ()
    dots: Sequence["Row"] = ()


class Scale(StrEnum):
    """How a map is coloured: from its least value up, around 1 by ratio, or around 0."""

    MAGNITUDE = "magnitude"
    RATIO = "ratio"
    SIGNED = "signed"


@dataclass(frozen=True, slots=True)
class Level:
    """A straight line across the panel: a limit, or a reference; `vertical` stands at an abscissa."""

    value: float
    name: str
    limit: bool = False
    vertical: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Map:
    """Values over two coordinates, `[y][x]`; `critical` are values at which something happens.

    Maps that are compared share the `range` of the colours, and the last of them shows the `bar`.
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
        """Least and greatest value that has a colour of its own: those of the range if there is one."""
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
    """One pair of axes and all that is drawn in it; `shapes` are polygons; `equal` axes distort nothing."""

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
    """Panels under a title that says what and a finding that says what of it; `beside` puts them in a row.

    Title and source are those of the declaration, unless the case calls for a title of its own. A `narrow` figure is
    laid out for a column of a report.
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
    """The case lacks what the figure shows; `path` is the dotted request field that decides it."""
