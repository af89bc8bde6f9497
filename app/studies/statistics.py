"""Statistics of samples, and probabilities over a load spectrum with tolerances.

The values of an output over a spectrum are an array `[replicate, draw, case]`; NaN marks a point without solution.

A draw is one machine. Each machine runs every case. The worst case of the machine decides whether the machine exceeds a
limit. If the limit is normally distributed, the probability is integrated over this distribution in closed form. Random
errors then come only from the random draws of the tolerances. The replicates are independent samples. The scatter of
their means gives the error of the overall mean.
"""

from collections.abc import Sequence
from math import isnan
from typing import Any, Literal, NamedTuple

import numpy as np
from scipy.special import ndtr

from solvers.arrays import FloatArray

CONFIDENCE = 0.9  # confidence of all intervals
QUANTILES = (0.05, 0.5, 0.95)  # the median and the usual tails of 5 %
MODERATE, HIGH = 0.1, 0.3  # probabilities between low, moderate and high risk, AGMA 925-A03
RELATIVE_DEVIATION = 0.15  # AGMA 925-A03; taken from a secondary source and not compared with the standard
ASSUMED_DEVIATION = (
    "the scuffing temperature is assumed to be normally distributed, with a standard deviation of 0.15 times its mean "
    "(AGMA 925-A03, secondary source)"
)
LEAST_LIMIT = 1e-9  # share of the typical limit below which the deviation of a limit does not fall, chosen
LEAST_DEGREE, MOST_DEGREE = 2, 4  # of polynomials in an input; 2 sees what is symmetric, 4 is enough for one kink
MOST_BINS = 40  # largest number of bins of a histogram that a user can read

Side = Literal["above", "below"]
Risk = Literal["low", "moderate", "high"]


class Limit(NamedTuple):
    """A limit on one output, fixed (`deviation` 0) or normally distributed about `mean`.

    Values above the limit are bad if `side` is `above`; values below it if `side` is `below`. `own` holds the limit of
    each output where machines or cases have limits of their own, an array like that of the outputs; `mean` is then
    typical of them, and the deviation is the same share of each.
    """

    side: Side
    mean: float
    deviation: float
    output: str = ""
    own: FloatArray | None = None

    @property
    def is_fixed(self) -> bool:
        """Whether the limit has no scatter."""
        return self.deviation == 0.0

    def of_case(self, place: int) -> "Limit":
        """Return the limit of one case, with a last axis of one case."""
        return self if self.own is None else self._replace(own=self.own[..., place : place + 1])

    def margins(self, outputs: FloatArray) -> FloatArray:
        """Return how far each output is beyond the limit, in standard deviations of the limit if it has one."""
        limit = self.mean if self.own is None else self.own
        beyond = outputs - limit if self.side == "above" else limit - outputs
        if self.is_fixed:
            return np.asarray(beyond)
        share = 1.0 if self.own is None else np.maximum(np.abs(self.own / self.mean), LEAST_LIMIT)
        return np.asarray(beyond / (self.deviation * share))

    def exceeded(self, outputs: FloatArray) -> FloatArray:
        """Return, for each output, the probability that it is beyond the limit: 0 or 1 if the limit is fixed.

        NaN where the output is NaN.
        """
        margins = self.margins(outputs)
        return np.where(np.isnan(margins), np.nan, margins > 0.0) if self.is_fixed else np.asarray(ndtr(margins))

    def worst(self, outputs: FloatArray) -> FloatArray:
        """Return the output farthest beyond its limit along the last axis, that of the cases; NaN if none is solved."""
        margins = self.margins(outputs)
        place = np.where(np.isnan(margins), -np.inf, margins).argmax(axis=-1, keepdims=True)
        return np.asarray(np.take_along_axis(outputs, place, axis=-1)[..., 0])


class Mean(NamedTuple):
    """A mean over replicates, its standard error, and its 90 % confidence interval by Student's t distribution.

    If there is only one replicate, the standard error and the interval are None.
    """

    mean: float
    standard_error: float | None
    interval: tuple[float, float] | None


class Estimate(NamedTuple):
    """A probability that a limit is exceeded.

    A draw (one machine) is unsolved if one of its cases has no solution. For the lower of the `bounds`, such a draw is
    judged by its solved cases alone. For the upper bound, every unsolved draw is beyond the limit. If the bounds
    differ, `probability` is None. `risk` is the risk (low, moderate or high) at the upper bound.
    """

    probability: float | None
    bounds: tuple[float, float]
    standard_error: float | None
    interval: tuple[float, float] | None
    risk: Risk


def mean_over_replicates(values: FloatArray) -> Mean:
    """Return the mean of values `[replicate, draw]`, with its standard error and its confidence interval.

    The mean of each replicate is computed first. The standard error and the interval follow from the scatter of these
    means. No value may be NaN.
    """
    from scipy.stats import t  # noqa: PLC0415  half a second that only studies need

    means = values.mean(axis=1)
    value = float(means.mean())
    if means.size == 1:
        return Mean(value, None, None)
    error = float(means.std(ddof=1) / np.sqrt(means.size))
    reach = float(t.ppf((1.0 + CONFIDENCE) / 2.0, means.size - 1)) * error
    return Mean(value, error, (value - reach, value + reach))


def of_spectrum(outputs: FloatArray, limit: Limit) -> Estimate:
    """Return the probability that the worst case of a machine is beyond the limit."""
    # The limit of a machine is one property of oil and material: its case farthest beyond decides.
    good = np.nan_to_num(np.fmax.reduce(limit.exceeded(outputs), axis=-1), nan=0.0)
    unsolved = np.isnan(outputs).any(axis=-1)
    low, high = (_chances(chances, limit) for chances in (good, np.where(unsolved, 1.0, good)))
    errors = [side.standard_error for side in (low, high) if side.standard_error is not None]
    return Estimate(
        probability=low.mean if low.mean == high.mean else None,
        bounds=(low.mean, high.mean),
        standard_error=max(errors, default=None),
        interval=None if low.interval is None or high.interval is None else (low.interval[0], high.interval[1]),
        risk="low" if high.mean < MODERATE else "moderate" if high.mean <= HIGH else "high",
    )


def of_case(outputs: FloatArray, limit: Limit) -> Estimate:
    """Return the probability that one case is beyond the limit.

    `outputs` is the array `[replicate, draw]` of the outputs in this case.
    """
    return of_spectrum(outputs[..., np.newaxis], limit)


def _chances(chances: FloatArray, limit: Limit) -> Mean:
    """Return the mean of the draws' probabilities `[replicate, draw]`, with a confidence interval between 0 and 1.

    The interval usually follows from the scatter of the replicates. If the limit is fixed, the probability of a draw is
    1 beyond the limit and 0 within the limit. For a fixed limit, the interval is that of Clopper and Pearson for a
    count if one of these conditions is met:

    - The number of draws beyond the limit is smaller than the number of replicates.
    - The number of draws within the limit is smaller than the number of replicates.
    - Every replicate has the same number of draws beyond the limit.

    If no draw or every draw is beyond the limit, this interval is one-sided and has the width 1 - 0.1^(1/draws).
    """
    from scipy.stats import binomtest  # noqa: PLC0415  half a second that only studies need

    probability, draws = mean_over_replicates(chances), chances.size
    if limit.is_fixed and draws > 1:
        events = round(probability.mean * draws)
        if min(events, draws - events) < len(chances) or not probability.standard_error:
            side: Literal["less", "greater", "two-sided"]
            side = "less" if events == 0 else "greater" if events == draws else "two-sided"
            interval = binomtest(events, draws, alternative=side).proportion_ci(CONFIDENCE)
            return probability._replace(interval=(float(interval.low), float(interval.high)))
    if probability.interval is None:
        return probability
    low, high = probability.interval
    return probability._replace(interval=(max(low, 0.0), min(high, 1.0)))


def deciding(outputs: FloatArray, limit: Limit) -> list[float] | None:
    """Return, for each of the cases along the last axis, the fraction of draws in which this case is the worst.

    A draw is one machine, which runs every case. If several cases of a draw share the worst value, the draw is
    divided equally among these cases. Draws with an unsolved case are left out. If no draws remain, the result is None.
    """
    margins = limit.margins(outputs)
    complete = margins[~np.isnan(margins).any(axis=-1)]
    if not complete.size:
        return None
    is_worst = complete == complete.max(axis=-1, keepdims=True)
    return [float(share) for share in (is_worst / is_worst.sum(axis=1, keepdims=True)).mean(axis=0)]


def mean(values: FloatArray) -> float | None:
    """Return the mean of the values that are not NaN, or None if all values are NaN."""
    finite = values[~np.isnan(values)]
    return float(finite.mean()) if finite.size else None


def quantiles(values: FloatArray) -> list[float] | None:
    """Return the 5, 50 and 95 % quantiles of the values that are not NaN, or None if all values are NaN."""
    finite = values[~np.isnan(values)]
    return [float(quantile) for quantile in np.quantile(finite, QUANTILES)] if finite.size else None


def weighted_mean(outputs: FloatArray, shares: Sequence[float]) -> Mean | None:
    """Return the mean of an output over the replicates, draws and cases, weighted with the shares of the cases.

    Only draws with a solution in every case count. If a replicate has no such draw, the result is None.
    """
    per_draw = outputs @ np.asarray(shares)
    replicates = [draws[~np.isnan(draws)] for draws in per_draw]
    if not all(draws.size for draws in replicates):
        return None
    return mean_over_replicates(np.array([[draws.mean()] for draws in replicates]))


def histogram(values: FloatArray) -> tuple[list[float], list[float]]:
    """Return the bin edges and the probability density in the bins, for the values that are not NaN.

    Both lists are empty if there are fewer than two such values, or if these values are too close together for bins.
    """
    finite = values[~np.isnan(values)]
    if finite.size < 2 or not np.ptp(finite) > 0.0:
        return [], []
    bins = min(MOST_BINS, max(1, round(np.sqrt(finite.size))))
    try:
        density, edges = np.histogram(finite, bins, density=True)
    except ValueError:  # the values are so close together that no number lies between two edges
        return [], []
    return edges.tolist(), density.tolist()


def rank_correlation(x: FloatArray, y: FloatArray) -> float | None:
    """Return Spearman's rank correlation of x and y.

    The result is None if there are fewer than three points, or if x or y is constant.
    """
    from scipy.stats import spearmanr  # noqa: PLC0415  half a second that only studies need

    if y.size < 3 or np.ptp(x) == 0.0 or np.ptp(y) == 0.0:
        return None
    return float(spearmanr(x, y).statistic)


def variance_shares(inputs: FloatArray, output: FloatArray) -> list[float | None]:
    """Share of the variance of an output that each input explains alone: first-order Sobol indices, from one sample.

    The output is fitted by polynomials in each input up to degree 4, or as far as the sample allows; what noise adds to
    a fit is subtracted. A share sees effects of the same sign on both sides of the middle, which a rank correlation
    does not; what inputs do together is left out. None for an input that is constant, and for all if the output is
    constant or the sample is too small for degree 2.
    """
    count, shares = len(output), list[float | None]([None] * inputs.shape[1])
    varied = [place for place, column in enumerate(inputs.T) if count and np.ptp(column) > 0.0]
    degree = min(MOST_DEGREE, (count // 2 - 1) // max(len(varied), 1))
    if degree < LEAST_DEGREE or not np.ptp(output) > 0.0:
        return shares
    low, high = inputs[:, varied].min(axis=0), inputs[:, varied].max(axis=0)
    scaled = (2.0 * inputs[:, varied] - low - high) / (high - low)
    bases = [np.polynomial.legendre.legvander(own, degree)[:, 1:] for own in scaled.T]
    matrix = np.column_stack([np.ones(count), *bases])
    fitted, *_ = np.linalg.lstsq(matrix, output)
    noise = float(np.square(output - matrix @ fitted).sum()) / (count - matrix.shape[1])
    for number, (place, basis) in enumerate(zip(varied, bases, strict=True)):
        own = float(np.var(basis @ fitted[1 + degree * number : 1 + degree * (number + 1)])) - noise * degree / count
        shares[place] = min(max(own / float(np.var(output)), 0.0), 1.0)
    return shares


def of_sample(
    inputs: FloatArray, outputs: FloatArray, input_paths: list[str], output_paths: Sequence[str]
) -> dict[str, Any]:
    """Return the statistics of each output of a random sample.

    The statistics are quantiles with bounds, and for each input the rank correlation with the output and the share of
    the variance that it explains. Each row of `inputs` and `outputs` is a point. The bounds of a quantile are two
    values of the sample. The quantile lies between these two values with 90 % confidence, whatever the distribution is.
    A bound is None if the sample is too small for this bound. This function runs in a worker.
    """
    from scipy.stats import quantile_test  # noqa: PLC0415  half a second that only random samples need

    content: dict[str, Any] = {"quantiles": {}, "quantile_bounds": {}, "rank_correlation": {}, "variance_share": {}}
    for path, column in zip(output_paths, outputs.T, strict=True):
        has_value = ~np.isnan(column)
        if has_value.any():
            values = column[has_value]
            tests: list[Any] = [quantile_test(values, p=share) for share in QUANTILES]
            bounds = [test.confidence_interval(CONFIDENCE) for test in tests]
            content["quantiles"][path] = np.quantile(values, QUANTILES).tolist()
            content["quantile_bounds"][path] = [[None if isnan(end) else float(end) for end in ends] for ends in bounds]
            content["rank_correlation"][path] = {
                name: rank_correlation(own[has_value], values) for name, own in zip(input_paths, inputs.T, strict=True)
            }
            shares = variance_shares(inputs[has_value], values)
            content["variance_share"][path] = dict(zip(input_paths, shares, strict=True))
    return content
