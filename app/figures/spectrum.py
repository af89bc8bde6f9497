"""Figures of a load spectrum: the output of every case against its limit, probabilities, what decides, mean losses.

A probability is a part of the study's lines: its `bounds`, which are equal where every draw is solved, and its
`interval`.
"""

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from app.figures.data import ORDER, Axis, Figure, Hue, Level, Line, NoFigure, Panel, Ribbon, Row, Span, Values
from app.figures.wording import number, percent

BAND = 1.6448536  # deviations from 5 to 50 %
REACH = 3.5  # deviations of a limit that are drawn
CURVE_POINTS = 141  # of a bell curve, chosen: it looks smooth
SPECTRUM = "whole spectrum"
NAMED = 8  # tolerances
LEAST = 1e-5  # a probability below it says nothing more: the tails that make it are not known so far out


class SpectrumCase(NamedTuple):
    """A case of the spectrum.

    `quantiles` are those of its limited output, 5, 50 and 95 %, None where none is solved; `chance` is its probability
    as if alone, `decides` the share of machines of which it is the worst case.
    """

    name: str
    quantiles: tuple[float, float, float] | None
    chance: dict[str, Any]
    decides: float | None


class Limited(NamedTuple):
    """A limited output over the spectrum.

    `found` is what the study says of the limit: its side, mean and deviation, the probability, and the histogram of the
    worst case, empty where that does not vary. `influences` are the rank correlations of the worst case with the fields
    that scatter, by their titles.
    """

    output: Axis
    found: dict[str, Any]
    cases: list[SpectrumCase]
    influences: dict[str, float]


def is_tiny(chance: dict[str, Any]) -> bool:
    """Whether a probability is too small to be distinguished from zero, but not exactly zero."""
    most: float = max(*chance["bounds"], *(chance["interval"] or ()))
    return 0.0 < most < LEAST


def chance_text(chance: dict[str, Any]) -> str:
    """A probability in per cent, or its bounds where they differ."""
    if is_tiny(chance):
        return f"below {percent(LEAST)}"
    low, high = chance["bounds"]
    return percent(low) if low == high else f"{percent(low)} to {percent(high)}"


def sentence(found: dict[str, Any]) -> str:
    """A sentence that states the probability of being above or below a limit."""
    interval = None if is_tiny(found) else found["interval"]
    reach = f", 90 % interval {percent(interval[0])} to {percent(interval[1])}" if interval else ""
    return f"probability of being {found['side']} the limit {chance_text(found)}{reach}: {found['risk']} risk"


def overlap(limited: Limited) -> Figure:
    """The densities of the worst case and of the limit, and below them the band of every case."""
    found, axis, rows = limited.found, replace(limited.output, magnitude=False), []
    for each in limited.cases:
        if each.quantiles is not None:
            low, middle, high = each.quantiles
            rows.append(Row(each.name, middle, Hue.BLUE, (low, high)))
    if not rows:
        raise NoFigure("no_solution", "no case has a solution")
    mean, reach = found["mean"], BAND * (found["deviation"] or 0.0)
    panels = [_densities(found, axis)] if reach or found["histogram"]["edges"] else []
    levels = [Level(mean, f"limit {number(mean, axis.unit)}", limit=True, vertical=True)]
    spans = [Span(mean - reach, mean + reach, "")] if reach else []
    panels.append(Panel(x=axis, y=Axis("case"), rows=rows, spans=spans, levels=levels))
    title = f"{axis.title[0].upper()}{axis.title[1:]} against its limit"
    return Figure(f"{sentence(found)}; bars to the median, lines and shade from 5 to 95 %", panels, title=title)


def _densities(found: dict[str, Any], axis: Axis) -> Panel:
    """What the worst case reaches and what the limit is, as densities scaled to one height."""
    curves, levels = list[tuple[str, Values, Values, Hue]](), list[Level]()
    mean, deviation, histogram = found["mean"], found["deviation"], found["histogram"]
    if edges := histogram["edges"]:
        height = np.repeat(np.array(histogram["density"]) / max(histogram["density"]), 2)
        curves.append(("worst case", np.repeat(edges, 2), np.pad(height, 1), Hue.BLUE))
    if deviation:
        x = mean + deviation * np.linspace(-REACH, REACH, CURVE_POINTS)
        curves.append(("limit", x, np.exp(-(((x - mean) / deviation) ** 2) / 2.0), Hue.VERMILLION))
    else:
        levels.append(Level(mean, "", limit=True, vertical=True))
    return Panel(
        x=axis,
        y=Axis("density over its largest"),
        ribbons=[Ribbon(title, x, np.zeros_like(y), y, hue) for title, x, y, hue in curves],
        lines=[Line(*curve) for curve in curves],
        levels=levels,
    )


def chances(limited: Limited) -> Figure:
    """The probability of each case as if it were alone, and of the spectrum."""
    found = limited.found
    if is_tiny(found):
        raise NoFigure("tiny", f"the probability is {chance_text(found)} in every case")
    known = [*((each.name, each.chance, Hue.BLUE) for each in limited.cases), (SPECTRUM, found, Hue.VERMILLION)]
    rows = []
    for name, chance, hue in known:
        low, high = chance["interval"] or chance["bounds"]
        rows.append(Row(name, 100.0 * chance["bounds"][1], hue, (100.0 * low, 100.0 * high)))
    panel = Panel(x=Axis(f"probability of being {found['side']} the limit", "%"), y=Axis("case"), rows=rows)
    finding = "each case as if it were alone; of the spectrum the worst case of each machine counts"
    return Figure(finding, [panel], title=f"Probability: {limited.output.title} {found['side']} its limit")


def deciding(limited: Limited) -> Figure:
    """Share of machines for which each case is the worst, and how strongly each tolerance correlates with it."""
    rows = [Row(each.name, 100.0 * each.decides) for each in limited.cases if each.decides is not None]
    if not rows:
        raise NoFigure("no_solution", "no machine is solved in every case")
    panels = [Panel(x=Axis("machines whose worst case it is", "%"), y=Axis("case"), rows=rows)]
    most = max(rows, key=lambda row: row.value)
    finding = f"{most.name} in {number(most.value, '%')} of the machines"
    strongest = sorted(limited.influences.items(), key=lambda each: -abs(each[1]))[:NAMED]
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
