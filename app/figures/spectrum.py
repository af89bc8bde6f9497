"""Figures of a load spectrum: the output of every case against its limit, probabilities, what decides, mean losses."""

from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from app.figures.data import ORDER, Axis, Figure, Hue, Level, Line, NoFigure, Panel, Ribbon, Row, Span, Values
from app.figures.wording import number, percent

BAND = 1.6448536  # deviations from 5 to 50 %
REACH = 3.5  # deviations of a limit that are drawn
CURVE_POINTS = 141  # of a bell curve, chosen: it looks smooth
SPECTRUM = "whole spectrum"
NAMED = 8  # tolerances
LEAST = 1e-5  # a probability below it says nothing more: the tails that make it are not known so far out


class Band(NamedTuple):
    """The 5, 50 and 95 % quantiles of an output."""

    low: float
    middle: float
    high: float


@dataclass(frozen=True, slots=True)
class Chance:
    """A probability between its bounds, which are equal where every draw is solved, and its interval."""

    low: float
    high: float
    interval: tuple[float, float] | None

    @property
    def is_tiny(self) -> bool:
        """Whether it is too small to be distinguished from zero, but not exactly zero."""
        most: float = max((self.high, *(self.interval or ())))
        return 0.0 < most < LEAST

    @property
    def text(self) -> str:
        """In per cent."""
        if self.is_tiny:
            return f"below {percent(LEAST)}"
        if self.low == self.high:
            return percent(self.low)
        return f"{percent(self.low)} to {percent(self.high)}"

    def row(self, name: str, hue: Hue) -> Row:
        """The larger bound, with the interval, in per cent."""
        low, high = self.interval or (self.low, self.high)
        return Row(name, 100.0 * self.high, hue, (100.0 * low, 100.0 * high))


@dataclass(frozen=True, slots=True)
class SpectrumCase:
    """A case of the spectrum: its limited output, its probability as if alone, how often it is the worst."""

    name: str
    band: Band | None
    chance: Chance
    decides: float | None


@dataclass(frozen=True, slots=True)
class Limited:
    """A limited output over the spectrum.

    `edges` and `density` are the histogram of the worst case, empty where it does not vary; `influences` are the rank
    correlations of the worst case with the fields that scatter.
    """

    output: Axis
    above: bool
    mean: float
    deviation: float | None
    chance: Chance
    risk: str
    cases: tuple[SpectrumCase, ...]
    edges: tuple[float, ...] = ()
    density: tuple[float, ...] = ()
    influences: dict[str, float] = field(default_factory=dict)

    @property
    def side(self) -> str:
        """On which side of the limit it must not be."""
        return "above" if self.above else "below"

    @property
    def sentence(self) -> str:
        """The probability in words."""
        interval = None if self.chance.is_tiny else self.chance.interval
        reach = f", 90 % interval {percent(interval[0])} to {percent(interval[1])}" if interval else ""
        return f"probability of being {self.side} the limit {self.chance.text}{reach}: {self.risk} risk"


def overlap(found: Limited) -> Figure:
    """The densities of the worst case and of the limit, and below them the band of every case."""
    axis = replace(found.output, magnitude=False)
    rows = [
        Row(each.name, each.band.middle, Hue.BLUE, (each.band.low, each.band.high))
        for each in found.cases
        if each.band is not None
    ]
    if not rows:
        raise NoFigure("no_solution", "no case has a solution")
    panels = [_densities(found, axis)] if found.deviation or found.edges else []
    levels = [Level(found.mean, f"limit {number(found.mean, axis.unit)}", limit=True, vertical=True)]
    reach = BAND * (found.deviation or 0.0)
    spans = [Span(found.mean - reach, found.mean + reach, "")] if reach else []
    panels.append(Panel(x=axis, y=Axis("case"), rows=rows, spans=spans, levels=levels))
    title = f"{found.output.title[0].upper()}{found.output.title[1:]} against its limit"
    return Figure(f"{found.sentence}; bars to the median, lines and shade from 5 to 95 %", panels, title=title)


def _densities(found: Limited, axis: Axis) -> Panel:
    """What the worst case reaches and what the limit is, as densities scaled to one height."""
    curves, levels = list[tuple[str, Values, Values, Hue]](), list[Level]()
    if found.edges:
        y = np.concatenate([[0.0], np.repeat(np.array(found.density) / max(found.density), 2), [0.0]])
        curves.append(("worst case", np.repeat(found.edges, 2), y, Hue.BLUE))
    if found.deviation:
        x = found.mean + found.deviation * np.linspace(-REACH, REACH, CURVE_POINTS)
        curves.append(("limit", x, np.exp(-(((x - found.mean) / found.deviation) ** 2) / 2.0), Hue.VERMILLION))
    else:
        levels.append(Level(found.mean, "", limit=True, vertical=True))
    return Panel(
        x=axis,
        y=Axis("density over its largest"),
        ribbons=[Ribbon(title, x, np.zeros_like(y), y, hue) for title, x, y, hue in curves],
        lines=[Line(*curve) for curve in curves],
        levels=levels,
    )


def chances(found: Limited) -> Figure:
    """The probability of each case as if it were alone, and of the spectrum."""
    if found.chance.is_tiny:
        raise NoFigure("tiny", f"the probability is {found.chance.text} in every case")
    rows = [each.chance.row(each.name, Hue.BLUE) for each in found.cases]
    rows.append(found.chance.row(SPECTRUM, Hue.VERMILLION))
    panel = Panel(x=Axis(f"probability of being {found.side} the limit", "%"), y=Axis("case"), rows=rows)
    finding = "each case as if it were alone; of the spectrum the worst case of each machine counts"
    return Figure(finding, [panel], title=f"Probability: {found.output.title} {found.side} its limit")


def deciding(found: Limited) -> Figure:
    """Share of machines for which each case is the worst, and how strongly each tolerance correlates with it."""
    rows = [Row(each.name, 100.0 * each.decides) for each in found.cases if each.decides is not None]
    if not rows:
        raise NoFigure("no_solution", "no machine is solved in every case")
    panels = [Panel(x=Axis("machines whose worst case it is", "%"), y=Axis("case"), rows=rows)]
    most = max(rows, key=lambda row: row.value)
    finding = f"{most.name} in {number(most.value, '%')} of the machines"
    strongest = sorted(found.influences.items(), key=lambda each: -abs(each[1]))[:NAMED]
    if strongest:
        axis = Axis("rank correlation with the worst case")
        panels.append(Panel(x=axis, y=Axis("tolerance"), rows=[Row(name, value) for name, value in strongest]))
        finding += f"; {strongest[0][0]} matters most"
    return Figure(finding, panels, title="What decides")


def losses(cases: dict[str, dict[str, float]], mean: dict[str, float], energy: float | None) -> Figure:
    """Mean losses [kW] by their kinds, of every case and over the operating time; with the energy of a year [MWh]."""
    hues = {kind: ORDER[place % len(ORDER)] for place, kind in enumerate(mean)}
    rows = []
    for name, own in (*cases.items(), (SPECTRUM, mean)):
        shares = [Row(kind, own[kind], hue) for kind, hue in hues.items() if kind in own]
        rows.append(Row(name, sum(own.values()), parts=shares))
    year = "" if energy is None else f", {number(energy, 'MWh')} a year"
    finding = f"{number(sum(mean.values()), 'kW')} over the operating time{year}"
    return Figure(finding, [Panel(x=Axis("mean loss", "kW"), y=Axis("case"), rows=rows)], title="Mean losses")
