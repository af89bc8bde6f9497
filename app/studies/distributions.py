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


def anchors(scatter: Range | Scatter) -> dict[str, float]:
    """The values of a distribution that its field has to take, in rising order."""
    return {name: getattr(scatter, name) for name in ("min", "mode", "mean", "median", "max") if hasattr(scatter, name)}


class Cut(NamedTuple):
    """The ends of a distribution, their cumulative probabilities, and its law in scipy; None where it is uniform."""

    low: float
    high: float
    shares: tuple[float, float] = (0.0, 1.0)
    law: Any = None

    def drawn(self, share: Array) -> Array:
        """Values at shares of the distribution between its ends."""
        low, high = self.shares
        values = (
            self.low + (self.high - self.low) * share if self.law is None else self.law.ppf(low + (high - low) * share)
        )
        return np.clip(values, self.low, self.high)

    @property
    def cut_off(self) -> float:
        """The share of the distribution beyond its ends."""
        return self.shares[0] + 1.0 - self.shares[1]


def cut(scatter: Range | Scatter, leaf: Leaf) -> Cut:
    """A distribution between its ends: four deviations, and the range of its field."""
    from scipy import stats  # noqa: PLC0415  half a second that only random samples need

    law: Any
    match scatter:
        case Normal():
            law = stats.norm(scatter.mean, scatter.deviation)
            low, high = scatter.mean - CUT * scatter.deviation, scatter.mean + CUT * scatter.deviation
        case Lognormal():
            law = stats.lognorm(log(scatter.factor), scale=scatter.median)
            low, high = scatter.median / scatter.factor**CUT, scatter.median * scatter.factor**CUT
        case Triangular() if (width := scatter.max - scatter.min) > 0.0:
            law = stats.triang((scatter.mode - scatter.min) / width, scatter.min, width)
            return Cut(scatter.min, scatter.max, law=law)
        case _:
            return Cut(scatter.min, scatter.max)
    bounds = leaf.declared.bounds
    low = max(low, bounds.get("ge", -LARGEST), bounds.get("gt", -LARGEST))
    high = min(high, bounds.get("le", LARGEST), bounds.get("lt", LARGEST))
    return Cut(low, high, (float(law.cdf(low)), float(law.cdf(high))), law)


def drawn(scatters: Sequence[Range | Scatter], leaves: Sequence[Leaf], cube: Array) -> Array:
    """Values of the fields, a column each, at points of the unit cube."""
    columns = (cut(each, leaf).drawn(share) for each, leaf, share in zip(scatters, leaves, cube.T, strict=True))
    return np.column_stack(list(columns))


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
