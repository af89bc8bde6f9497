"""Statistics of samples, and probabilities over a load spectrum with tolerances.

A spectrum is a plain array `[replicate, draw, case]`; NaN is unsolved.

A draw is one machine, which runs every case: the worst case of a draw decides whether it exceeds a limit. A limit that
is normally distributed is integrated in closed form, so that the noise is that of the tolerances alone. Replicates are
independent: their scatter gives the error of every mean.
"""

from collections.abc import Sequence
from math import isnan
from typing import Any, Literal, NamedTuple

import numpy as np
from scipy.special import ndtr

from solvers.arrays import FloatArray

CONFIDENCE = 0.9  # of every bound, two-sided
QUANTILES = (0.05, 0.5, 0.95)  # the median and the usual tails of 5 %
MODERATE, HIGH = 0.1, 0.3  # AGMA 925-A03, classes of risk
MOST_BINS = 40  # of a histogram that can be read

Side = Literal["above", "below"]
Risk = Literal["low", "moderate", "high"]


class Limit(NamedTuple):
    """What an output must not exceed (`above`) or fall short of (`below`); fixed where the deviation is zero."""

    side: Side
    mean: float
    deviation: float
    output: str = ""

    def exceeded(self, output: FloatArray) -> FloatArray:
        """The probability that each value is beyond the limit; NaN where there is no value."""
        beyond = output - self.mean if self.side == "above" else self.mean - output
        if self.deviation > 0.0:
            return np.asarray(ndtr(beyond / self.deviation))
        return np.where(np.isnan(beyond), np.nan, beyond > 0.0)

    def worst(self, outputs: FloatArray) -> FloatArray:
        """The worst of the cases (the last axis) that have a solution; NaN where none has."""
        return np.asarray((np.fmax if self.side == "above" else np.fmin).reduce(outputs, axis=-1))


class Mean(NamedTuple):
    """A mean over replicates, its standard error and its 90 % interval by Student's t; None of a single replicate."""

    mean: float
    standard_error: float | None
    interval: tuple[float, float] | None


class Estimate(NamedTuple):
    """A probability; `bounds` take all unsolved draws as good and as bad, and where they differ there is no value.

    The risk in words is that of the upper bound.
    """

    probability: float | None
    bounds: tuple[float, float]
    standard_error: float | None
    interval: tuple[float, float] | None
    risk: Risk


def mean_over_replicates(values: FloatArray) -> Mean:
    """The mean of `[replicate, draw]` without NaN."""
    from scipy.stats import t  # noqa: PLC0415  half a second that only studies need

    means = values.mean(axis=1)
    value = float(means.mean())
    if means.size == 1:
        return Mean(value, None, None)
    error = float(means.std(ddof=1) / np.sqrt(means.size))
    reach = float(t.ppf((1.0 + CONFIDENCE) / 2.0, means.size - 1)) * error
    return Mean(value, error, (value - reach, value + reach))


def of_spectrum(outputs: FloatArray, limit: Limit) -> Estimate:
    """The probability that the worst case of a machine is beyond the limit."""
    good = np.nan_to_num(limit.exceeded(limit.worst(outputs)), nan=0.0)
    unsolved = np.isnan(outputs).any(axis=-1)
    low, high = (_chances(each, limit) for each in (good, np.where(unsolved, 1.0, good)))
    errors = [each.standard_error for each in (low, high) if each.standard_error is not None]
    return Estimate(
        probability=low.mean if low.mean == high.mean else None,
        bounds=(low.mean, high.mean),
        standard_error=max(errors, default=None),
        interval=None if low.interval is None or high.interval is None else (low.interval[0], high.interval[1]),
        risk="low" if high.mean < MODERATE else "moderate" if high.mean <= HIGH else "high",
    )


def of_case(outputs: FloatArray, limit: Limit) -> Estimate:
    """The probability of one case as if it were alone; `outputs` are `[replicate, draw]`."""
    return of_spectrum(outputs[..., np.newaxis], limit)


def _chances(chances: FloatArray, limit: Limit) -> Mean:
    """The mean with its interval inside 0 to 1.

    Draws beyond a fixed limit are counted. Where fewer of them than replicates are beyond it, or within it, or all
    replicates count the same, the scatter of the replicates says nothing: the interval is Clopper and Pearson's of the
    count, one-sided where none or all count, 1 - 0.1^(1/draws).
    """
    from scipy.stats import binomtest  # noqa: PLC0415  half a second that only studies need

    found, draws = mean_over_replicates(chances), chances.size
    if limit.deviation == 0.0 and draws > 1:
        events = round(found.mean * draws)
        if min(events, draws - events) < len(chances) or not found.standard_error:
            side: Literal["less", "greater", "two-sided"]
            side = "less" if events == 0 else "greater" if events == draws else "two-sided"
            interval = binomtest(events, draws, alternative=side).proportion_ci(CONFIDENCE)
            return found._replace(interval=(float(interval.low), float(interval.high)))
    if found.interval is None:
        return found
    low, high = found.interval
    return found._replace(interval=(max(low, 0.0), min(high, 1.0)))


def deciding(outputs: FloatArray, limit: Limit) -> list[float] | None:
    """How often each case is the worst, of draws solved in all cases; ties are shared. None without such draws."""
    solved = outputs[~np.isnan(outputs).any(axis=-1)]
    if not solved.size:
        return None
    worst = solved == limit.worst(solved)[:, np.newaxis]
    return [float(share) for share in (worst / worst.sum(axis=1, keepdims=True)).mean(axis=0)]


def mean(values: FloatArray) -> float | None:
    """The mean of all values there are."""
    known = values[~np.isnan(values)]
    return float(known.mean()) if known.size else None


def quantiles(values: FloatArray) -> list[float] | None:
    """5, 50 and 95 % of all values there are."""
    known = values[~np.isnan(values)]
    return [float(each) for each in np.quantile(known, QUANTILES)] if known.size else None


def weighted_mean(outputs: FloatArray, shares: Sequence[float]) -> Mean | None:
    """The mean over the cases by their shares, over the draws that are solved in all; None where a replicate has none.

    Replicates that lost draws are means over those that are left.
    """
    per_draw = outputs @ np.asarray(shares)
    kept = [each[~np.isnan(each)] for each in per_draw]
    if not all(each.size for each in kept):
        return None
    return mean_over_replicates(np.array([[each.mean()] for each in kept]))


def histogram(values: FloatArray) -> tuple[list[float], list[float]]:
    """Edges and probability density of all values there are; nothing where they are all the same."""
    known = values[~np.isnan(values)]
    if known.size < 2 or not np.ptp(known) > 0.0:
        return [], []
    bins = min(MOST_BINS, max(1, round(np.sqrt(known.size))))
    try:
        density, edges = np.histogram(known, bins, density=True)
    except ValueError:  # values so near to each other that no number lies between two edges
        return [], []
    return edges.tolist(), density.tolist()


def rank_correlation(x: FloatArray, y: FloatArray) -> float | None:
    """Spearman's coefficient; none of fewer than three points, or where either does not vary."""
    from scipy.stats import spearmanr  # noqa: PLC0415  half a second that only studies need

    if y.size < 3 or np.ptp(x) == 0.0 or np.ptp(y) == 0.0:
        return None
    return float(spearmanr(x, y).statistic)


def of_sample(
    inputs: FloatArray, outputs: FloatArray, input_paths: list[str], output_paths: Sequence[str]
) -> dict[str, Any]:
    """Quantiles with their bounds and rank correlation of a random sample, a row a point; runs in a worker.

    Bounds are the order statistics that hold a quantile with 90 % confidence, whatever the distribution; null where the
    sample is too small for one.
    """
    from scipy.stats import quantile_test  # noqa: PLC0415  half a second that only random samples need

    found: dict[str, Any] = {"quantiles": {}, "quantile_bounds": {}, "rank_correlation": {}}
    for path, column in zip(output_paths, outputs.T, strict=True):
        there = ~np.isnan(column)
        if there.any():
            values = column[there]
            tests: list[Any] = [quantile_test(values, p=share) for share in QUANTILES]
            bounds = [test.confidence_interval(CONFIDENCE) for test in tests]
            found["quantiles"][path] = np.quantile(values, QUANTILES).tolist()
            found["quantile_bounds"][path] = [[None if isnan(end) else float(end) for end in ends] for ends in bounds]
            found["rank_correlation"][path] = {
                name: rank_correlation(own[there], values) for name, own in zip(input_paths, inputs.T, strict=True)
            }
    return found
