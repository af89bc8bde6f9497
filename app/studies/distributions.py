"""Random values of request fields: points of the unit cube through the distributions of the fields."""

from collections.abc import Sequence
from math import log
from typing import Any, NamedTuple

import numpy as np

from app.errors import Unprocessable
from app.schema.fields import Leaf
from app.studies.requests import LARGEST, Lognormal, Method, Normal, Range, Scatter, Triangular

CUT = 4.0  # deviations

Array = np.ndarray[Any, np.dtype[np.float64]]


def anchors(scatter: Range | Scatter) -> tuple[float, ...]:
    """The values of a distribution that its field has to take, in rising order."""
    match scatter:
        case Normal():
            return (scatter.mean,)
        case Lognormal():
            return (scatter.median,)
        case Triangular():
            return scatter.min, scatter.mode, scatter.max
        case _:
            return scatter.min, scatter.max


class Cut(NamedTuple):
    """The ends of a distribution, their cumulative probabilities, and its law; None where both ends are equal."""

    low: float
    high: float
    shares: tuple[float, float]
    law: Any

    def drawn(self, share: Array) -> Array:
        """Values at shares of the distribution between its ends."""
        if self.law is None:
            return np.full(share.shape, self.low)
        low, high = self.shares
        values: Array = np.clip(self.law.ppf(low + (high - low) * share), self.low, self.high)
        return values

    @property
    def cut_off(self) -> float:
        """The share of the distribution beyond its ends."""
        return self.shares[0] + 1.0 - self.shares[1]


def cut(scatter: Range | Scatter, leaf: Leaf) -> Cut:
    """A distribution between four deviations and the ends of its field."""
    from scipy import stats  # noqa: PLC0415  half a second that only random samples need

    law: Any
    match scatter:
        case Normal():
            reach = CUT * scatter.deviation
            law = stats.norm(scatter.mean, scatter.deviation)
            low, high = scatter.mean - reach, scatter.mean + reach
        case Lognormal():
            law = stats.lognorm(log(scatter.factor), scale=scatter.median)
            low, high = scatter.median / scatter.factor**CUT, scatter.median * scatter.factor**CUT
        case _ if scatter.min == scatter.max:
            return Cut(scatter.min, scatter.max, (0.0, 1.0), None)
        case Triangular():
            width = scatter.max - scatter.min
            return Cut(
                scatter.min,
                scatter.max,
                (0.0, 1.0),
                stats.triang((scatter.mode - scatter.min) / width, scatter.min, width),
            )
        case _:
            return Cut(scatter.min, scatter.max, (0.0, 1.0), stats.uniform(scatter.min, scatter.max - scatter.min))
    bounds = leaf.declared.bounds
    low = max(low, bounds.get("ge", -LARGEST), bounds.get("gt", -LARGEST))
    high = min(high, bounds.get("le", LARGEST), bounds.get("lt", LARGEST))
    return Cut(low, high, (float(law.cdf(low)), float(law.cdf(high))), law)


def drawn(scatters: Sequence[Range | Scatter], leaves: Sequence[Leaf], cube: Array) -> Array:
    """Values of the fields, a column each, at points of the unit cube."""
    return np.column_stack(
        [cut(each, leaf).drawn(cube[:, place]) for place, (each, leaf) in enumerate(zip(scatters, leaves, strict=True))]
    )


def unit_cube(method: Method, count: int, dimensions: int, seed: Any, place: str) -> Array:
    """Points of the unit cube; raises Unprocessable at `place` of the study, where the count is.

    `seed` is a number, or a generator of NumPy.
    """
    from scipy.stats import qmc  # noqa: PLC0415  half a second that only random samples need

    if method == "latin_hypercube":
        return np.asarray(qmc.LatinHypercube(dimensions, rng=seed).random(count))
    exponent = count.bit_length() - 1
    if count != 1 << exponent:
        raise Unprocessable("not_power_of_two", "a Sobol sample needs a power of two of points", place)
    return np.asarray(qmc.Sobol(dimensions, rng=seed).random_base2(exponent))
