"""Sweeps: a line a point, then extremes and statistics. Corners are a sweep over uncertain inputs."""

from collections.abc import Callable, Sequence
from functools import partial
from math import inf, isnan
from typing import Any, ClassVar

import numpy as np

from app.errors import Unprocessable
from app.schema.fields import Leaf
from app.spreadsheet import csv_of
from app.studies import engine
from app.studies.engine import Clock, Line, Lines, Pool, Study, json_line, output_header, paths_of
from app.studies.fields import did_you_mean, is_number
from app.studies.point_sets import CheckedAxis, PointSet, drawn, grid, listed, scattering, unit_cube, usual_corners
from app.studies.points import SOLVED, BaseRequest, Point, check_count
from app.studies.probability import CONFIDENCE, QUANTILES, rank_correlation
from app.studies.requests import Axis, Best, CornersRequest, Range, Sample, Scatter, SweepRequest
from solvers.arrays import FloatArray
from solvers.drive_train.uncertainty import MOST_CORNERS, no_convergence


class Summary(engine.Tally):
    """What the end of a sweep says of its points.

    `extremes` are the least and the largest value of every output that has any, as `min` and `max`, each with the
    index of its point; `best_point` is the index of the best one, with its outputs.
    """

    def __init__(self, outputs: Sequence[str], best: Best | None = None, first: int = 0) -> None:
        super().__init__(outputs)
        self.extremes: dict[str, dict[str, tuple[float, int]]] = {}
        self.best_point: tuple[int, list[Any]] | None = None
        self._best = best
        self._first = first
        self._least = inf

    def add(self, point: Point) -> None:
        """Take in the next point, in order; of equal values the first counts."""
        index = self._first + self.counts.total()
        super().add(point)
        for path, value in zip(self.outputs, point.out, strict=True):
            if is_number(value):
                known = self.extremes.setdefault(path, {"min": (value, index), "max": (value, index)})
                if value < known["min"][0]:
                    known["min"] = (value, index)
                if value > known["max"][0]:
                    known["max"] = (value, index)
        if self._best is not None:
            self._compare(self._best, index, point.out)

    def _compare(self, best: Best, index: int, out: list[Any]) -> None:
        """Keep the point if it is the best so far inside all limits."""
        values = dict(zip(self.outputs, out, strict=True))
        inside = all(
            is_number(values[bound.output])
            and (bound.min is None or values[bound.output] >= bound.min)
            and (bound.max is None or values[bound.output] <= bound.max)
            for bound in best.where
        )
        value = values[best.output]
        if inside and is_number(value) and (least := value if best.minimise else -value) < self._least:
            self.best_point, self._least = (index, out), least


def statistics(inputs: FloatArray, outputs: FloatArray, input_paths: list[str], output_paths: Sequence[str]) -> Line:
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


class Sweep(Study):
    """Every point is the endpoint's own answer.

    Lines are `sweep`, then `point` in order with the first axis slowest, `progress` when nothing else was sent for two
    seconds, and `end`; or `error`, which ends a study early and is the last row of a table. A stream without either was
    cut off: with `from_index` the study goes on, with the same points and lines from there.
    The end of a sample has the 5, 50 and 95 % quantiles, and in `quantile_bounds` their 90 % confidence intervals.
    """

    path = "/v1/sweep"
    summary = "One request at many points: a grid, a list of cases, a random sample"
    answer = "a line for the sweep, one for each point in order, one for the end"
    model: ClassVar[type[Any]] = SweepRequest
    is_reduced = False
    points: PointSet

    def _planned(self, base: BaseRequest, most: int) -> int:
        self.points = self._points(base, most)
        first: int = self.body.from_index
        if first >= self.points.total:
            message = f"the study has {self.points.total} points, counted from 0"
            raise Unprocessable("out_of_range", message, "from_index")
        base.checked(self.points.overrides(0))
        return self.points.total - first

    def _points(self, base: BaseRequest, most: int) -> PointSet:
        """The points that the body asks for."""
        body: SweepRequest = self.body
        if body.best is not None:
            _check_best(body.best, self.outputs)
        if body.cases is not None:
            return listed(body.cases, base, most, "cases")
        if body.sample is not None:
            return _sampled(body.sample, base, most)
        return grid(body.vary or [], base, most, "vary")

    async def lines(self, pool: Pool, clock: Clock) -> Lines:
        """The header, each point, the closing lines."""
        points, first, outputs = self.points, self.body.from_index, self.question.outputs
        yield [
            self.header(
                axes=[axis.header() for axis in points.axes],
                outputs=[output_header(leaf) for leaf in self.outputs],
                total=points.total,
                **({"from_index": first} if first else {}),
            )
        ]
        summary, indices = Summary(outputs, self.body.best, first), range(first, points.total)
        async for solved, found in engine.in_order(pool, self.question, points.overrides, indices, clock):
            lines = []
            for index, point in zip(solved, found, strict=True):
                summary.add(point)
                if self.body.sample:
                    summary.keep(point.out)
                lines.append(engine.point_line(index, points.rows[index], point))
            yield lines
        of_sample: Line = {"quantiles": None, "quantile_bounds": None, "rank_correlation": None}
        if self.body.sample:
            inputs, varied = np.array(points.rows[first:]), paths_of(points.varied)
            of_sample = await engine.twice_if_lost(pool, statistics, inputs, summary.values, varied, outputs)
        best = summary.best_point
        end = {
            "type": "end",
            "points": self.total,
            "counts": dict(sorted(summary.counts.items())),
            "ranges": summary.extremes,
            **of_sample,
            "best": best and {"index": best[0], "at": points.rows[best[0]], "out": best[1]},
            "assumptions": list(summary.assumptions.values()),
            "elapsed_s": clock.elapsed_s,
        }
        yield self._closing(summary, end)

    def _closing(self, _: Summary, end: Line) -> list[Line]:
        """The lines behind those of the points, of which `end` is the last."""
        return [end]


class Corners(Sweep):
    """Every corner is the endpoint's own answer, up to 256 of them; `extremes` are the least and largest values.

    Where no output needs the thermal film, it is not calculated: corners are twenty times as fast and have fewer
    warnings. The last line warns `no_convergence_of_corner` where corners have no solution; their own lines say why.
    """

    path = "/v1/drive-train/corners"
    summary = "A gear unit at every combination of its uncertain inputs"
    answer = "a line for the ranges, each corner, the extremes of each output, and one for the end"
    model = CornersRequest
    is_reduced = True

    def _points(self, base: BaseRequest, most: int) -> PointSet:
        ranges: list[Axis] | None = self.body.ranges
        if ranges is None:
            ranges = list(usual_corners(base.checked({})).values())
        if not ranges:
            raise Unprocessable("no_corners", "nothing is uncertain here; name what is", "ranges")
        return grid(ranges, base, min(most, MOST_CORNERS), "ranges")

    def _closing(self, summary: Summary, end: Line) -> list[Line]:
        """The extremes of every output, and the end with a warning where corners have no solution."""
        extremes: list[Line] = []
        for path, found in summary.extremes.items():
            ends = {name: {"value": value, "at": self.points.overrides(at)} for name, (value, at) in found.items()}
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


def _sampled(sample: Sample, base: BaseRequest, most: int) -> PointSet:
    """Random points, the same for the same seed."""
    check_count(sample.count, most, "sample.count")
    scatters: Sequence[Range | Scatter] = sample.ranges or sample.inputs or ()
    leaves = scattering(scatters, base, "sample.ranges" if sample.ranges else "sample.inputs")
    cube = unit_cube(sample.method, sample.count, len(leaves), sample.seed, "sample.count")
    axes = [CheckedAxis(leaf.path, (leaf,), None) for leaf in leaves]
    return PointSet(axes, leaves, drawn(scatters, leaves, cube).tolist())


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


def encoder(study: Study, written_as: str) -> Callable[[Line], bytes]:
    """Return what writes the lines of a study; those of a sweep also as the rows of a table."""
    if isinstance(study, Sweep) and written_as == "csv":
        return partial(table_row, study.points, study.outputs)
    return json_line
