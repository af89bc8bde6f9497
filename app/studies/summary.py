"""What a study gathers of its points as they pass: counts, extremes, the best point, statistics of a sample."""

import operator
from array import array
from collections import Counter
from math import isnan, nan
from typing import Any, NamedTuple

import numpy as np

from app.studies.point_sets import PointSet
from app.studies.points import SOLVED, Point
from app.studies.probability import CONFIDENCE, QUANTILES, Array, rank_correlation
from app.studies.requests import Best


class Tally:
    """Counts of the points by status, of their errors and warnings by code, and their assumptions; kept numbers."""

    def __init__(self, outputs: int) -> None:
        self.counts: Counter[str] = Counter()
        self.errors: Counter[str] = Counter()
        self.warnings: Counter[str] = Counter()
        self._assumptions: dict[str, dict[str, Any]] = {}
        self._numbers = array("d")
        self._outputs = outputs

    def add(self, point: Point) -> None:
        """Take in the next point."""
        self.counts[point.status] += 1
        if point.error is not None:
            self.errors[point.error["code"]] += 1
        self.warnings.update(point.warnings)
        for each in point.assumptions:
            known = self._assumptions.setdefault(each["field"], each)
            if known["value"] != each["value"]:
                self._assumptions[each["field"]] = {**known, "value": None}

    def keep(self, out: list[Any]) -> None:
        """Keep the numbers of a point."""
        self._numbers.extend(value if is_number(value) else nan for value in out)

    @property
    def values(self) -> Array:
        """The numbers kept, one row per point, NaN where there is none."""
        return np.array(self._numbers).reshape(-1, self._outputs)

    @property
    def assumptions(self) -> list[dict[str, Any]]:
        """Each assumption once, by its field; a value that differs between points is null."""
        return list(self._assumptions.values())

    @property
    def answered(self) -> int:
        """How many points have an answer."""
        return sum(self.counts[status] for status in SOLVED)


class Extreme(NamedTuple):
    """A value as the answer has it, and the point where it is."""

    value: float
    point: int


class Summary:
    """The end of a sweep; of a grid it keeps the extremes only, of a sample every number.

    `extremes` are the least and the largest value of every output that has any, as `min` and `max`.
    """

    def __init__(self, points: PointSet, outputs: list[str], best: Best | None, first: int = 0) -> None:
        self.tally = Tally(len(outputs))
        self.extremes: dict[str, dict[str, Extreme]] = {}
        self._points = points
        self._outputs = outputs
        self._best = best
        self._next = first
        self._best_so_far: tuple[Extreme, list[Any]] | None = None

    def add(self, point: Point) -> None:
        """Take in the next point, in order."""
        index, self._next = self._next, self._next + 1
        self.tally.add(point)
        for path, value in zip(self._outputs, point.out, strict=True):
            if is_number(value):
                found = Extreme(value, index)
                known = self.extremes.setdefault(path, {"min": found, "max": found})
                for end, choose in (("min", min), ("max", max)):  # of equals the first
                    known[end] = choose(known[end], found, key=operator.itemgetter(0))
        if self._best is not None:
            self._compare(self._best, index, point.out)
        if self._points.sample is not None:
            self.tally.keep(point.out)

    def line(self, statistics: dict[str, Any], elapsed_s: float) -> dict[str, Any]:
        """The last line of the answer."""
        best = None
        if self._best_so_far is not None:
            (_, index), out = self._best_so_far
            best = {"index": index, "at": self._points.at(index), "out": out}
        return {
            "type": "end",
            "points": self.tally.counts.total(),
            "counts": dict(sorted(self.tally.counts.items())),
            "ranges": self.extremes,
            **statistics,
            "best": best,
            "assumptions": self.tally.assumptions,
            "elapsed_s": elapsed_s,
        }

    def _compare(self, best: Best, index: int, out: list[Any]) -> None:
        """Keep the point if it is the best so far inside all limits; of equals the first."""
        values = dict(zip(self._outputs, out, strict=True))
        value = values[best.output]
        limited = all(
            is_number(values[bound.output])
            and (bound.min is None or values[bound.output] >= bound.min)
            and (bound.max is None or values[bound.output] <= bound.max)
            for bound in best.where
        )
        better = operator.lt if best.minimise else operator.gt
        if limited and is_number(value) and (self._best_so_far is None or better(value, self._best_so_far[0].value)):
            self._best_so_far = Extreme(value, index), out


def is_number(value: Any) -> bool:
    """Whether a value can be compared; true counts as 1."""
    return isinstance(value, int | float)


NO_STATISTICS: dict[str, Any] = {"quantiles": None, "quantile_bounds": None, "rank_correlation": None}


def statistics(inputs: Array, outputs: Array, input_paths: list[str], output_paths: list[str]) -> dict[str, Any]:
    """Quantiles with their bounds and rank correlation of a random sample, a row a point; runs in a worker.

    Bounds hold a quantile with 90 % confidence, whatever the distribution; null where the sample is too small for one.
    """
    found: dict[str, Any] = {name: {} for name in NO_STATISTICS}
    for path, column in zip(output_paths, outputs.T, strict=True):
        there = ~np.isnan(column)
        if there.any():
            values = column[there]
            found["quantiles"][path] = np.quantile(values, QUANTILES).tolist()
            found["quantile_bounds"][path] = [_bounds(values, share) for share in QUANTILES]
            found["rank_correlation"][path] = {
                name: rank_correlation(own[there], values) for name, own in zip(input_paths, inputs.T, strict=True)
            }
    return found


def _bounds(values: Array, share: float) -> list[float | None]:
    """The order statistics that hold a quantile with 90 % confidence."""
    from scipy.stats import quantile_test  # noqa: PLC0415  half a second that only random samples need

    interval: Any = quantile_test(values, p=share).confidence_interval(CONFIDENCE)
    return [None if isnan(end) else float(end) for end in interval]
