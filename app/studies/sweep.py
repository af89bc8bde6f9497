"""Sweeps: a line a point, then extremes and statistics. Corners are a sweep over uncertain inputs."""

import operator
from collections.abc import Sequence
from dataclasses import dataclass
from math import isnan, nan
from typing import Any, Literal

import numpy as np

from app.errors import Unprocessable
from app.schema.fields import Leaf
from app.spreadsheet import csv_of
from app.studies import engine
from app.studies.engine import Clock, Line, Lines, Pool, Study, output_header, paths_of
from app.studies.fields import did_you_mean, is_number
from app.studies.point_sets import CheckedAxis, PointSet, drawn, grid, listed, scattering, unit_cube, usual_corners
from app.studies.points import SOLVED, BaseRequest, Point, check_count
from app.studies.probability import CONFIDENCE, QUANTILES, rank_correlation
from app.studies.requests import Best, CornersRequest, Range, Sample, Scatter, SweepRequest
from solvers.arrays import FloatArray
from solvers.drive_train.uncertainty import MOST_CORNERS, no_convergence

PATH = "/v1/sweep"
CORNERS_PATH = "/v1/drive-train/corners"


class Summary(engine.Tally):
    """The end of a sweep; of a grid it keeps the extremes only, of a sample every number.

    `extremes` are the least and the largest value of every output that has any, as `min` and `max`, each with the
    index of its point.
    """

    def __init__(self, points: PointSet, outputs: list[str], best: Best | None, first: int = 0) -> None:
        super().__init__(outputs)
        self.extremes: dict[str, dict[str, tuple[float, int]]] = {}
        self._points = points
        self._best = best
        self._next = first
        self._best_so_far: Line | None = None
        self._best_value = nan

    def add(self, point: Point) -> None:
        """Take in the next point, in order."""
        super().add(point)
        index, self._next = self._next, self._next + 1
        for path, value in zip(self.outputs, point.out, strict=True):
            if is_number(value):
                found = (value, index)
                known = self.extremes.setdefault(path, {"min": found, "max": found})
                for end, choose in (("min", min), ("max", max)):  # of equals the first
                    known[end] = choose(known[end], found, key=operator.itemgetter(0))
        if self._best is not None:
            self._compare(self._best, index, point.out)
        if self._points.sample is not None:
            self.keep(point.out)

    def line(self, statistics: Line, elapsed_s: float) -> Line:
        """The last line of the answer."""
        return {
            "type": "end",
            "points": self.counts.total(),
            "counts": dict(sorted(self.counts.items())),
            "ranges": self.extremes,
            **statistics,
            "best": self._best_so_far,
            "assumptions": list(self.assumptions.values()),
            "elapsed_s": elapsed_s,
        }

    def _compare(self, best: Best, index: int, out: list[Any]) -> None:
        """Keep the point if it is the best so far inside all limits; of equals the first."""
        values = dict(zip(self.outputs, out, strict=True))
        value = values[best.output]
        limited = all(
            is_number(values[bound.output])
            and (bound.min is None or values[bound.output] >= bound.min)
            and (bound.max is None or values[bound.output] <= bound.max)
            for bound in best.where
        )
        better = operator.lt if best.minimise else operator.gt
        if limited and is_number(value) and (self._best_so_far is None or better(value, self._best_value)):
            self._best_so_far = {"index": index, "at": self._points.at(index), "out": out}
            self._best_value = value


def statistics(inputs: FloatArray, outputs: FloatArray, input_paths: list[str], output_paths: list[str]) -> Line:
    """Quantiles with their bounds and rank correlation of a random sample, a row a point; runs in a worker.

    Bounds are the order statistics that hold a quantile with 90 % confidence, whatever the distribution; null where the
    sample is too small for one.
    """
    from scipy.stats import quantile_test  # noqa: PLC0415  half a second that only random samples need

    found: Line = {"quantiles": {}, "quantile_bounds": {}, "rank_correlation": {}}
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


@dataclass(frozen=True, slots=True, kw_only=True)
class Sweep(Study):
    """A request solved at the points of a set from `first` on; corners name the points of the extremes."""

    points: PointSet
    kind: Literal["sweep", "corners"] = "sweep"
    best: Best | None = None
    first: int = 0

    @property
    def total(self) -> int:
        """How many points it has from the first on."""
        return self.points.total - self.first

    async def lines(self, pool: Pool, clock: Clock) -> Lines:
        """The header, each point, the closing lines."""
        yield [
            self.header(
                self.kind,
                axes=[axis.header() for axis in self.points.axes],
                outputs=[output_header(leaf) for leaf in self.outputs],
                total=self.points.total,
                **({"from_index": self.first} if self.first else {}),
            )
        ]
        outputs = paths_of(self.outputs)
        summary = Summary(self.points, outputs, self.best, self.first)
        indices = range(self.first, self.points.total)
        async for solved, points in engine.in_order(pool, self.question, self.points.overrides, indices, clock):
            for point in points:
                summary.add(point)
            at = (self.points.at(index) for index in solved)
            yield list(map(engine.point_line, solved, at, points))
        found: Line = {"quantiles": None, "quantile_bounds": None, "rank_correlation": None}
        if self.points.sample is not None:
            sample, inputs = self.points.sample[self.first :], paths_of(self.points.varied)
            found = await engine.twice_if_lost(pool, statistics, sample, summary.values, inputs, outputs)
        end = summary.line(found, clock.elapsed_s)
        yield [end] if self.kind == "sweep" else self._of_corners(summary, end)

    def _of_corners(self, summary: Summary, end: Line) -> list[Line]:
        """The extremes of every output, and the end with a warning where corners have no solution."""
        extremes: list[Line] = []
        at = self.points.overrides
        for path, found in summary.extremes.items():
            ends = {name: {"value": value, "at": at(point)} for name, (value, point) in found.items()}
            extremes.append({"type": "extremes", "output": path, **ends})
        unsolved = self.total - sum(summary.counts[status] for status in SOLVED)
        notice = no_convergence(unsolved)
        warning = {"rank": notice.rank, "code": notice.code, "message": notice.message}
        return [*extremes, {**end, "warnings": [warning] if unsolved else []}]


def table_row(points: PointSet, outputs: tuple[Leaf, ...], line: Line) -> bytes:
    """A line of a sweep as comma-separated values, the first one as a header with units.

    Nothing for progress and end; an error has a row with its message.
    """
    error = line if line["type"] == "error" else line.get("error")
    message = f"{error['code']}: {error['message']}" if error else None
    row: list[Any]
    match line["type"]:
        case "sweep":
            inputs, results = (
                [f"{leaf.path} [{leaf.unit}]" if leaf.unit else leaf.path for leaf in leaves]
                for leaves in (points.varied, outputs)
            )
            row = ["index", *inputs, "status", *results, "warnings", "error"]
        case "point":
            overrides = points.overrides(line["index"])
            at = [overrides.get(leaf.path) for leaf in points.varied]
            row = [line["index"], *at, line["status"], *line["out"], " ".join(line["warnings"]), message]
        case "error":
            row = [None, *[None] * len(points.varied), "error", *[None] * len(outputs), None, message]
        case _:
            return b""
    return csv_of([row])


def sweep_study(content: Any, most: int, deadline_s: float) -> Sweep:
    """The sweep in a body."""
    request, base = engine.asked(SweepRequest, content)
    outputs = base.outputs(request.outputs)
    if request.best is not None:
        _check_best(request.best, outputs)
    if request.cases is not None:
        points = listed(request.cases, base, most, "cases")
    elif request.sample is not None:
        points = _sampled(request.sample, base, most)
    else:
        points = grid(request.vary or [], base, most, "vary")
    _check_first(request.from_index, points, base)
    question = base.question(paths_of(outputs), deadline_s, reduced=False)
    case = engine.case_of_study(PATH, request)
    return Sweep(question, outputs, case, points=points, best=request.best, first=request.from_index)


def corners_study(content: Any, most: int, deadline_s: float) -> Sweep:
    """The corners of a gear unit in a body."""
    request, base = engine.asked(CornersRequest, content)
    outputs = base.outputs(request.outputs)
    ranges = list(usual_corners(base.checked({})).values()) if request.ranges is None else request.ranges
    if not ranges:
        raise Unprocessable("no_corners", "nothing is uncertain here; name what is", "ranges")
    points = grid(ranges, base, min(most, MOST_CORNERS), "ranges")
    _check_first(request.from_index, points, base)
    question = base.question(paths_of(outputs), deadline_s)
    case = engine.case_of_study(CORNERS_PATH, request)
    return Sweep(question, outputs, case, kind="corners", points=points, first=request.from_index)


def _sampled(sample: Sample, base: BaseRequest, most: int) -> PointSet:
    """Random points, the same for the same seed."""
    check_count(sample.count, most, "sample.count")
    scatters: Sequence[Range | Scatter] = sample.ranges or sample.inputs or ()
    leaves = scattering(scatters, base, "sample.ranges" if sample.ranges else "sample.inputs")
    cube = unit_cube(sample.method, sample.count, len(leaves), sample.seed, "sample.count")
    axes = [CheckedAxis(leaf.path, (leaf,), None) for leaf in leaves]
    return PointSet(axes, sample.count, leaves, sample=drawn(scatters, leaves, cube))


def _check_first(index: int, points: PointSet, base: BaseRequest) -> None:
    """Refuse an index behind the last point, and a base request that is invalid with the first one."""
    if index >= points.total:
        message = f"the study has {points.total} points, counted from 0"
        raise Unprocessable("out_of_range", message, "from_index")
    base.checked(points.overrides(0))


def _check_best(best: Best, outputs: tuple[Leaf, ...]) -> None:
    """Refuse a best point by what is no output of the sweep, or no number."""
    known = {leaf.path: leaf for leaf in outputs}
    judged = {"best.minimise" if best.minimise else "best.maximise": best.output}
    judged |= {f"best.where.{place}.output": bound.output for place, bound in enumerate(best.where)}
    for place, path in judged.items():
        if path not in known:
            message = f"{path} is not among the outputs of the sweep{did_you_mean(path, known)}"
            raise Unprocessable("unknown_output", message, place)
        if known[path].kind == "text":
            raise Unprocessable("unknown_output", f"{path} is no number", place)
