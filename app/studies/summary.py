"""The end of a sweep: counts, extremes, the best point, and statistics of a random sample."""

import operator
from array import array
from collections import Counter
from math import isnan, nan
from typing import Any, NamedTuple

import numpy as np

from app.studies.point_sets import PointSet
from app.studies.points import Point
from app.studies.probability import CONFIDENCE, QUANTILES, rank_correlation
from app.studies.requests import Best


class Extreme(NamedTuple):
    """A value as the answer has it, and the point where it is."""

    value: float
    point: int


class Summary:
    """Gathers points as they pass; of a grid it keeps the extremes only, of a sample every number."""

    def __init__(self, points: PointSet, outputs: list[str], best: Best | None, first: int = 0) -> None:
        self._points = points
        self._outputs = outputs
        self._best = best
        self._first = first
        self._counts: Counter[str] = Counter()
        self._ranges: dict[str, dict[str, Extreme]] = {}
        self._best_so_far: tuple[Extreme, list[Any]] | None = None
        self._assumptions: dict[str, dict[str, Any]] = {}
        self._values = array("d")
        self._count = 0

    def add(self, point: Point) -> None:
        """Take in the next point, in order."""
        index, self._count = self._first + self._count, self._count + 1
        self._counts[point.status] += 1
        for path, value in zip(self._outputs, point.out, strict=True):
            if _is_number(value):
                self._widen(path, Extreme(value, index))
        if self._best is not None:
            self._compare(self._best, index, point.out)
        if self._points.sample is not None:
            self._values.extend(value if _is_number(value) else nan for value in point.out)
        for each in point.assumptions:
            merge_assumption(self._assumptions, each)

    @property
    def extremes(self) -> dict[str, dict[str, Extreme]]:
        """Least and largest value of every output that has any, as `min` and `max`."""
        return self._ranges

    @property
    def answered(self) -> int:
        """How many points have an answer."""
        return self._counts["ok"] + self._counts["ok_with_warnings"]

    @property
    def values(self) -> np.ndarray[Any, Any] | None:
        """The outputs of a random sample, a row a point, NaN where there is none."""
        if self._points.sample is None:
            return None
        return np.array(self._values).reshape(self._count, len(self._outputs))

    def line(self, statistics: dict[str, Any], elapsed_s: float) -> dict[str, Any]:
        """The last line of the answer."""
        return {
            "type": "end",
            "points": self._count,
            "counts": dict(sorted(self._counts.items())),
            "ranges": self._ranges,
            **statistics,
            "best": self._best_point(),
            "assumptions": list(self._assumptions.values()),
            "elapsed_s": elapsed_s,
        }

    def _widen(self, path: str, found: Extreme) -> None:
        known = self._ranges.setdefault(path, {"min": found, "max": found})
        if found.value < known["min"].value:
            known["min"] = found
        if found.value > known["max"].value:
            known["max"] = found

    def _compare(self, best: Best, index: int, out: list[Any]) -> None:
        """Keep the point if it is the best so far inside all limits; of equals the first."""
        values = dict(zip(self._outputs, out, strict=True))
        value = values[best.output]
        limited = all(
            _is_number(values[bound.output])
            and (bound.min is None or values[bound.output] >= bound.min)
            and (bound.max is None or values[bound.output] <= bound.max)
            for bound in best.where
        )
        better = operator.lt if best.minimise else operator.gt
        if limited and _is_number(value) and (self._best_so_far is None or better(value, self._best_so_far[0].value)):
            self._best_so_far = Extreme(value, index), out

    def _best_point(self) -> dict[str, Any] | None:
        if self._best_so_far is None:
            return None
        (_, index), out = self._best_so_far
        return {"index": index, "at": self._points.at(index), "out": out}


def merge_assumption(known: dict[str, dict[str, Any]], found: dict[str, Any]) -> None:
    """Each assumption once, by its field; a value that differs between points is null."""
    before = known.setdefault(found["field"], found)
    if before["value"] != found["value"]:
        known[found["field"]] = {**before, "value": None}


def _is_number(value: Any) -> bool:
    """Whether it can be compared; true counts as 1."""
    return isinstance(value, int | float)


NO_STATISTICS: dict[str, Any] = {"quantiles": None, "quantile_bounds": None, "rank_correlation": None}


def statistics(
    inputs: np.ndarray[Any, Any], outputs: np.ndarray[Any, Any], input_paths: list[str], output_paths: list[str]
) -> dict[str, Any]:
    """Quantiles with their bounds and rank correlation of a random sample, a row a point; runs in a worker.

    Bounds hold a quantile with 90 % confidence, whatever the distribution; null where the sample is too small for one.
    """
    there = {path: ~np.isnan(outputs[:, place]) for place, path in enumerate(output_paths)}
    columns = {path: outputs[there[path], place] for place, path in enumerate(output_paths) if there[path].any()}
    return {
        "quantiles": {path: np.quantile(values, QUANTILES).tolist() for path, values in columns.items()},
        "quantile_bounds": {path: [_bounds(values, share) for share in QUANTILES] for path, values in columns.items()},
        "rank_correlation": {
            path: {name: rank_correlation(inputs[there[path], place], values) for place, name in enumerate(input_paths)}
            for path, values in columns.items()
        },
    }


def _bounds(values: np.ndarray[Any, Any], share: float) -> list[float | None]:
    """The order statistics that hold a quantile with 90 % confidence."""
    from scipy.stats import quantile_test  # noqa: PLC0415  half a second that only random samples need

    interval: Any = quantile_test(values, p=share).confidence_interval(CONFIDENCE)
    return [None if isnan(end) else float(end) for end in interval]
