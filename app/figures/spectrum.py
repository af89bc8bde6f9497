"""Figures of a load spectrum: outputs of all cases, probabilities of violating a limit, deciding cases, mean losses.

The study's result states a probability as a dictionary. The entry `bounds` holds a lower and an upper bound of the
probability. Both bounds are equal if all random draws are solved. The entry `interval` is the confidence interval.
"""

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from app.figures.data import ORDER, Axis, Figure, Hue, Level, Line, NoFigure, Panel, Ribbon, Row, Span, Values
from app.figures.wording import number, percent

BAND = 1.6448536  # standard deviations between the quantiles at 5 % and 50 %
REACH = 3.5  # number of standard deviations that are drawn on either side of the mean of a limit
CURVE_POINTS = 141  # points of a bell curve; chosen so that the curve looks smooth
SPECTRUM = "whole spectrum"
NAMED = 8  # largest number of tolerances in a figure
LEAST = 1e-5  # smaller probabilities are not stated, because the tails of the distributions are not known so far out


class LimitedCase(NamedTuple):
    """A case of a load spectrum, with the results for an output that has a limit.

    `quantiles` holds the quantiles of the output at 5, 50 and 95 %. `quantiles` is None if no random draw has a
    solution. `chance` is the probability of violating the limit if this case were the only case of the spectrum.
    `decides` is the fraction of the machines for which this case is the worst case.
    """

    name: str
    quantiles: tuple[float, float, float] | None
    chance: dict[str, Any]
    decides: float | None


class Limited(NamedTuple):
    """An output that has a limit, in all cases of a load spectrum.

    `found` is what the study states about the limit: the mean and the standard deviation of the limit, the side that
    is a violation ("above" or "below"), the probability of a violation, and the histogram of the output in the worst
    case. The histogram is empty if this output does not vary. `influences` maps the title of each scattering input to
    the share of the variance of the worst case that it explains alone.
    """

    output: Axis
    found: dict[str, Any]
    cases: list[LimitedCase]
    influences: dict[str, float]


def is_tiny(chance: dict[str, Any]) -> bool:
    """Return True if a probability is not exactly zero, but too small to be distinguished from zero."""
    most: float = max(*chance["bounds"], *(chance["interval"] or ()))
    return 0.0 < most < LEAST


def chance_text(chance: dict[str, Any]) -> str:
    """Return a probability in per cent as text. If the bounds of the probability differ, return both bounds."""
    if is_tiny(chance):
        return f"below {percent(LEAST)}"
    low, high = chance["bounds"]
    return percent(low) if low == high else f"{percent(low)} to {percent(high)}"


def sentence(limit: dict[str, Any], output: str) -> str:
    """Return the verdict of a limit: in a few words, the share of the machines beyond it, the error of sampling.

    The risk is in words only for the scuffing temperature, whose standard has such words. Any other limit is neither
    kept nor violated by a share, so that the share itself comes first.
    """
    risk, is_rare = limit["risk"], is_tiny(limit) or max(limit["bounds"]) == 0.0
    if risk is not None:
        verdict = f"{risk[0].upper()}{risk[1:]} risk of scuffing: {chance_text(limit)} of the machines"
    elif is_rare:
        verdict = f"The limit holds: {chance_text(limit)} of the machines have the {output} {limit['side']} it"
    else:
        verdict = f"{chance_text(limit)} of the machines exceed the limit: {output} {limit['side']} it"
    interval, reach = None if is_tiny(limit) else limit["interval"], ""
    if interval:
        reach = f" (90 % interval {percent(interval[0])} to {percent(interval[1])}, the error of sampling alone)"
    return f"{verdict}{reach}"


def overlap(limited: Limited) -> Figure:
    """Draw the probability densities of the limit and of the output in the worst case."""
    limit, axis, rows = limited.found, replace(limited.output, magnitude=False), []
    for case in limited.cases:
        if case.quantiles is not None:
            low, middle, high = case.quantiles
            rows.append(Row(case.name, middle, Hue.BLUE, (low, high)))
    if not rows:
        raise NoFigure("no_solution", "no case has a solution")
    mean, reach = limit["mean"], BAND * (limit["deviation"] or 0.0)
    panels = [_densities(limit, axis)] if reach or limit["histogram"]["edges"] else []
    levels = [Level(mean, f"limit {number(mean, axis.unit)}", limit=True, vertical=True)]
    spans = [Span(mean - reach, mean + reach, "")] if reach else []
    panels.append(Panel(x=axis, y=Axis("case"), rows=rows, spans=spans, levels=levels))
    title = f"{axis.title[0].upper()}{axis.title[1:]} against its limit"
    chance = f"{chance_text(limit)} of the machines {limit['side']} it"
    return Figure(f"{chance}; bars to the median, lines and shade from 5 to 95 %", panels, title=title)


def _densities(limit: dict[str, Any], axis: Axis) -> Panel:
    """Return a panel with the probability densities of the limit and of the output in the worst case."""
    curves, levels = list[tuple[str, Values, Values, Hue]](), list[Level]()
    mean, deviation, histogram = limit["mean"], limit["deviation"], limit["histogram"]
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
    """Draw the probability of violating the limit, for each case and for the whole spectrum."""
    limit = limited.found
    if is_tiny(limit):
        raise NoFigure(
            "tiny",
            f"the probability of violating the limit is {chance_text(limit)} for the whole spectrum",
        )
    cases = ((case.name, case.chance, Hue.BLUE) for case in limited.cases)
    rows = []
    for name, chance, hue in (*cases, (SPECTRUM, limit, Hue.VERMILLION)):
        low, high = chance["interval"] or chance["bounds"]
        rows.append(Row(name, 100.0 * chance["bounds"][1], hue, (100.0 * low, 100.0 * high)))
    panel = Panel(x=Axis(f"probability of being {limit['side']} the limit", "%"), y=Axis("case"), rows=rows)
    finding = "each case as if it were alone; of the spectrum the worst case of each machine counts"
    return Figure(finding, [panel], title=f"Probability: {limited.output.title} {limit['side']} its limit")


def deciding(limited: Limited) -> Figure:
    """Draw which cases and which tolerances decide whether a machine violates the limit."""
    rows = [Row(case.name, 100.0 * case.decides) for case in limited.cases if case.decides is not None]
    if not rows:
        raise NoFigure(
            "no_solution",
            "every computed machine has at least one load case without a solution, so there is nothing to draw",
        )
    panels = [Panel(x=Axis("machines whose worst case it is", "%"), y=Axis("case"), rows=rows)]
    most = max(rows, key=lambda row: row.value)
    finding = f"{most.name} in {number(most.value, '%')} of the machines"
    strongest = sorted(limited.influences.items(), key=lambda title_and_share: -title_and_share[1])[:NAMED]
    if strongest:
        axis = Axis("share of the worst case's variance that it explains alone", "%")
        rows = [Row(name, 100.0 * value) for name, value in strongest]
        panels.append(Panel(x=axis, y=Axis("tolerance"), rows=rows))
        finding += f"; {strongest[0][0]} matters most"
    return Figure(finding, panels, title="What decides")


def losses(cases: dict[str, dict[str, float]], mean: dict[str, float], energy: float | None) -> Figure:
    """Draw the mean losses for every case and for the whole operating time, divided into the kinds of loss.

    `mean` maps the kinds of loss to the losses [kW], averaged over the operating time. `cases` maps the name of each
    case to the losses [kW] of this case, again by the kind of loss. `energy` is the energy lost per year [MWh].
    """
    hues = {kind: ORDER[place % len(ORDER)] for place, kind in enumerate(mean)}
    rows = []
    for name, own in (*cases.items(), (SPECTRUM, mean)):
        shares = [Row(kind, own[kind], hue) for kind, hue in hues.items() if kind in own]
        rows.append(Row(name, sum(own.values()), parts=shares))
    year = "" if energy is None else f", {number(energy, 'MWh')} a year"
    finding = f"{number(sum(mean.values()), 'kW')} over the operating time{year}"
    return Figure(finding, [Panel(x=Axis("mean loss", "kW"), y=Axis("case"), rows=rows)], title="Mean losses")
