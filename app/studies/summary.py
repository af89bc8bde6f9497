"""What a sweep says at its end: ranges, quantiles, rank correlation and the best point."""

from collections import Counter
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.stats import spearmanr

from app.studies.plan import Plan
from app.studies.points import Point
from app.studies.requests import Best

QUANTILES = (0.05, 0.5, 0.95)
LEAST_CORRELATED = 3
SOLVED = ("ok", "ok_with_warnings")


@dataclass
class Summary:
    """Gathers points as they pass; numbers only, so that its memory is that of the outputs."""

    plan: Plan
    outputs: list[str]
    best: Best | None
    counts: Counter[str] = field(default_factory=Counter)
    assumptions: list[dict[str, Any]] | None = None
    _values: list[list[float | None]] = field(default_factory=list)

    def add(self, point: Point) -> None:
        """Take in the next point, in order."""
        self.counts[point.status] += 1
        self._values.append([_number(value) for value in point.out])
        if self.assumptions is None and point.assumptions is not None:
            self.assumptions = point.assumptions

    def line(self, elapsed_s: float) -> dict[str, Any]:
        """The last line of the answer."""
        table = np.array(self._values, dtype=float).reshape(len(self._values), len(self.outputs))
        sampled = self.plan.sample is not None
        return {
            "type": "end",
            "points": len(self._values),
            "counts": dict(sorted(self.counts.items())),
            "ranges": {name: _range(table[:, column]) for column, name in enumerate(self.outputs)},
            "quantiles": self._by_output(table, _quantiles) if sampled else None,
            "rank_correlation": self._by_output(table, self._correlation) if sampled else None,
            "best": self._best(table),
            "assumptions": self.assumptions or [],
            "elapsed_s": elapsed_s,
        }

    def _by_output(self, table: np.ndarray[Any, Any], function: Any) -> dict[str, Any]:
        return {name: function(table[:, column]) for column, name in enumerate(self.outputs)}

    def _correlation(self, values: np.ndarray[Any, Any]) -> dict[str, float | None]:
        """Spearman's rank correlation of an output with each sampled field."""
        assert self.plan.sample is not None
        there = ~np.isnan(values)
        found: dict[str, float | None] = {}
        for column, axis in enumerate(self.plan.axes):
            x, y = self.plan.sample[: values.size, column][there], values[there]
            varied = y.size >= LEAST_CORRELATED and np.ptp(y) > 0.0 and np.ptp(x) > 0.0
            found[axis.paths[0]] = float(spearmanr(x, y).statistic) if varied else None
        return found

    def _best(self, table: np.ndarray[Any, Any]) -> dict[str, Any] | None:
        """The solved point with the smallest or largest output inside all bounds."""
        if self.best is None:
            return None
        allowed = np.ones(len(table), dtype=bool)
        for bound in self.best.where:
            values = table[:, self.outputs.index(bound.output)]
            allowed &= ~np.isnan(values)
            allowed &= values >= (-np.inf if bound.min is None else bound.min)
            allowed &= values <= (np.inf if bound.max is None else bound.max)
        wanted = self.best.minimise or self.best.maximise
        assert wanted is not None
        values = table[:, self.outputs.index(wanted)]
        allowed &= ~np.isnan(values)
        if not allowed.any():
            return None
        ranked = np.where(allowed, values if self.best.minimise else -values, np.inf)
        index = int(np.argmin(ranked))
        return {"index": index, "at": self.plan.at(index), "out": [_json(value) for value in table[index]]}


def _number(value: Any) -> float | None:
    """A number or truth value as a number; words and nulls have none."""
    return float(value) if isinstance(value, int | float) else None


def _json(value: float) -> float | None:
    return None if np.isnan(value) else float(value)


def _range(values: np.ndarray[Any, Any]) -> dict[str, list[float | int]] | None:
    """Smallest and largest value with their points; None where no point has the output."""
    if not values.size or np.isnan(values).all():
        return None
    low, high = int(np.nanargmin(values)), int(np.nanargmax(values))
    return {"min": [float(values[low]), low], "max": [float(values[high]), high]}


def _quantiles(values: np.ndarray[Any, Any]) -> list[float] | None:
    """5, 50 and 95 % quantiles of the points that have the output."""
    there = values[~np.isnan(values)]
    return [float(value) for value in np.quantile(there, QUANTILES)] if there.size else None
