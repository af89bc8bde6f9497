"""Sweeps: one request is solved at many points. The results at a point are the endpoint's results for this point.

The study sends one line per point. In JSON, the last line has the extremes and the statistics.
"""

from collections.abc import Callable, Sequence
from functools import partial
from math import inf
from typing import Annotated, Any, ClassVar

import numpy as np
from pydantic import Field

from app.errors import Unprocessable
from app.schema.fields import Leaf
from app.schema.quantities import Input
from app.schema.reading import did_you_mean
from app.spreadsheet import csv_of
from app.studies import runner
from app.studies.fields import is_number
from app.studies.oil_tests import hold, remarks_on, tests_moved
from app.studies.point_sets import CheckedAxis, PointSet, drawn, grid, listed, scattering, unit_cube
from app.studies.points import BaseRequest, Point, check_count
from app.studies.requests import (
    COUNT,
    METHOD,
    OIL_TESTS,
    Axis,
    Cases,
    FieldPath,
    FromIndex,
    Inputs,
    Method,
    OilTests,
    Overrides,
    Part,
    Range,
    Scatter,
    Seed,
    StudyRequest,
)
from app.studies.runner import Clock, Line, Lines, Pool, Study, output_header, paths_of
from app.studies.statistics import of_sample


class Sample(Part):
    """A random sample of points.

    If the sample has `ranges`, the values of each field are distributed uniformly over the range of this field. If the
    sample has `inputs`, the values of each field follow the distribution that is given for this field.
    """

    exactly_one = ("ranges", "inputs")
    method: Annotated[Method, METHOD] = "latin_hypercube"
    count: Annotated[int, COUNT]
    seed: Seed = 1
    ranges: Annotated[
        list[Range] | None, Field(min_length=1, max_length=50), Input("ranges", text="the fields and their ranges")
    ] = None
    inputs: Annotated[Inputs | None, Input("distributions", text="the fields and their distributions")] = None


class Bound(Part):
    """A limit on one output."""

    output: Annotated[FieldPath, Input("limited output", text="dotted path of one of the outputs")]
    min: Annotated[float | None, Input("least permissible value")] = None
    max: Annotated[float | None, Input("largest permissible value")] = None


class Best(Part):
    """The criterion by which the best point is chosen."""

    exactly_one = ("minimise", "maximise")
    minimise: Annotated[FieldPath | None, Input("output to minimise")] = None
    maximise: Annotated[FieldPath | None, Input("output to maximise")] = None
    where: Annotated[list[Bound], Field(max_length=20), Input("limits", text="limits that the best point keeps")] = (
        Field([])
    )

    @property
    def output(self) -> str:
        """The path of the output that is minimised or maximised."""
        return str(self.minimise or self.maximise)


class SweepRequest(StudyRequest):
    """One request at many points: a grid, a list of cases or a random sample."""

    exactly_one = ("vary", "cases", "sample")
    vary: Annotated[list[Axis] | None, Field(min_length=1, max_length=3), Input("axes of a grid")] = None
    cases: Annotated[Cases, Input("cases", text="what each case changes")] = None
    sample: Annotated[Sample | None, Input("random sample")] = None
    best: Annotated[Best | None, Input("best point", text="which point to pick at the end")] = None
    oil_tests: Annotated[OilTests, OIL_TESTS] = "by_stage"
    from_index: FromIndex = 0


class Summary(runner.Tally):
    """The summary of all points, for the last line of a sweep.

    `extremes` holds the least value (`min`) and the largest value (`max`) of every output that has values, with the
    indices of the points at which these values occur. `best_point` holds the index of the best point and the outputs at
    this point.
    """

    def __init__(self, outputs: Sequence[str], best: Best | None = None, first: int = 0) -> None:
        super().__init__(outputs)
        self.extremes: dict[str, dict[str, tuple[float, int]]] = {}
        self.best_point: tuple[int, list[Any]] | None = None
        self._best = best
        self._first = first
        self._least = inf

    def add(self, point: Point) -> None:
        """Add the next point to the summary. Points must be added in order.

        If several points have the same extreme or best value, the first of these points is stored.
        """
        index = self._first + self.counts.total()
        super().add(point)
        for path, value in zip(self.outputs, point.out, strict=True):
            if is_number(value):
                extreme = self.extremes.setdefault(path, {"min": (value, index), "max": (value, index)})
                if value < extreme["min"][0]:
                    extreme["min"] = (value, index)
                if value > extreme["max"][0]:
                    extreme["max"] = (value, index)
        if self._best is not None:
            self._compare(self._best, index, point.out)

    def _compare(self, best: Best, index: int, out: list[Any]) -> None:
        """Store the point as the best point if it keeps all limits and is better than the best point so far."""
        values = dict(zip(self.outputs, out, strict=True))
        is_inside = all(
            is_number(values[bound.output])
            and (bound.min is None or values[bound.output] >= bound.min)
            and (bound.max is None or values[bound.output] <= bound.max)
            for bound in best.where
        )
        value = values[best.output]
        if is_inside and is_number(value) and (least := value if best.minimise else -value) < self._least:
            self.best_point, self._least = (index, out), least


class Sweep(Study):
    """The results of one endpoint at many points.

    The first line is `sweep`. Then there is a line `point` for each point; the value on the first axis changes most
    slowly. A line `progress` comes if no other line was sent for two seconds. The last line is `end`. If the study ends
    early, the last line is `error` instead. In an answer in CSV, the line `error` is a row with the error's message.

    A stream that has neither `end` nor `error` was cut off. A request with `from_index` continues the study. The points
    stay the same, and the lines start at the point with this index.

    A load stage of a test belongs to one oil. If the oil varies, `remarks` of the line `end` say so. With `oil_tests`
    set to `held`, every point has the limits that the stages prove for the oil of the case; the first line has them.

    `ends` of the best point of a grid are the fields whose range ends there. For a random sample, the line `end` has
    the 5, 50 and 95 % quantiles. The member `quantile_bounds` of this line has the 90 % confidence intervals of the
    quantiles.
    """

    path = "/v1/sweep"
    summary = "One request at many points: a grid, a list of cases, a random sample"
    answer = "a line for the sweep, one for each point in order, one for the end"
    model: ClassVar[type[Any]] = SweepRequest
    formats: ClassVar[tuple[str, ...]] = ("csv", "ndjson")
    is_reduced = False
    points: PointSet

    def _planned(self, base: BaseRequest, most: int) -> int:
        self.points = self._points(base, most)
        first: int = self.body.from_index
        if first >= self.points.total:
            total = self.points.total
            message = f"this point does not exist; the study has {total} points, numbered from 0 to {total - 1}"
            raise Unprocessable("out_of_range", message, "from_index")
        request = base.checked(self.points.overrides(0))
        varied = paths_of(self.points.varied)
        self.tests = tests_moved(base.described() or request, varied, paths_of(self.outputs))
        self.held: Overrides = {}
        return self.points.total - first

    def overrides(self, index: int) -> Overrides:
        """Return what a point changes in the request, with the limits that are held."""
        return {**self.held, **self.points.overrides(index)}

    def _points(self, base: BaseRequest, most: int) -> PointSet:
        """Return the points that the body requests.

        Raises Unprocessable if the points or the criterion for the best point are not valid.
        """
        body: SweepRequest = self.body
        if body.best is not None:
            _check_best(body.best, self.outputs)
        if body.cases is not None:
            return listed(body.cases, base, most, "cases")
        if body.sample is not None:
            return _sampled(body.sample, base, most)
        return grid(body.vary or [], base, most, "vary")

    async def lines(self, pool: Pool, clock: Clock) -> Lines:
        """Yield the header, a line for each point, and then the lines that `_closing` returns."""
        points, first, outputs = self.points, self.body.from_index, self.question.outputs
        await self._size_flow(pool, points.overrides(0))
        try:
            self.held = await self._limits_held(pool)
        except Unprocessable as error:
            yield [clock.error(error.code, error.message)]
            return
        yield [
            self.header(
                axes=[axis.header() for axis in points.axes],
                outputs=[output_header(leaf) for leaf in self.outputs],
                total=points.total,
                **({"from_index": first} if first else {}),
                **({"held": self.held} if self.held else {}),
            )
        ]
        summary, indices = Summary(outputs, self.body.best, first), range(first, points.total)
        async for chunk, chunk_points in runner.in_order(pool, self.question, self.overrides, indices, clock):
            lines = []
            for index, point in zip(chunk, chunk_points, strict=True):
                summary.add(point)
                if self.body.sample:
                    summary.keep(point.out)
                lines.append(runner.point_line(index, points.rows[index], point))
            yield lines
        statistics: Line = dict.fromkeys(("quantiles", "quantile_bounds", "rank_correlation", "variance_share"))
        if self.body.sample:
            inputs, varied = np.array(points.rows[first:]), paths_of(points.varied)
            statistics = await runner.twice_if_lost(pool, of_sample, inputs, summary.values, varied, outputs)
        best = summary.best_point
        end = {
            "type": "end",
            "points": self.total,
            "counts": dict(sorted(summary.counts.items())),
            "ranges": summary.extremes,
            **statistics,
            "best": best
            and {"index": best[0], "at": points.rows[best[0]], "out": best[1], "ends": points.ends(best[0])},
            "assumptions": list(summary.assumptions.values()),
            **({"remarks": self.remarks()} if self.tests else {}),
            "elapsed_s": clock.elapsed_s,
        }
        yield self._closing(summary, end)

    async def _limits_held(self, pool: Pool) -> Overrides:
        if not self.tests or self.body.oil_tests != "held":
            return {}
        return await hold(pool, self.question, self.tests, self.points.overrides(0))

    def remarks(self) -> list[str]:
        """Say what the tests of the case's oil mean for a study over the oil."""
        return remarks_on(self.tests, self.held)

    def _closing(self, _: Summary, end: Line) -> list[Line]:
        """Return the lines that follow the last point. A subclass may put further lines before the line `end`."""
        return [end]

    def encoder(self, written_as: str) -> Callable[[Line], bytes]:
        """Return the function that converts a line into bytes: a row of a table if the format is "csv", else JSON."""
        if written_as == "csv":
            return partial(table_row, self.points, self.outputs)
        return super().encoder(written_as)


def table_row(points: PointSet, outputs: tuple[Leaf, ...], line: Line) -> bytes:
    """Return a line of a sweep as a row of comma-separated values.

    The first line of the sweep becomes the heading with units. A line `error` becomes a row with the message of the
    error. A line `progress` or `end` has no row, so the result is empty.
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
    """Return the points of a random sample. The same seed gives the same points."""
    check_count(sample.count, most, "sample.count")
    scatters: Sequence[Range | Scatter] = sample.ranges or sample.inputs or ()
    leaves = scattering(scatters, base, "sample.ranges" if sample.ranges else "sample.inputs")
    cube = unit_cube(sample.method, sample.count, len(leaves), sample.seed, "sample.count")
    axes = [CheckedAxis(leaf.path, (leaf,), None) for leaf in leaves]
    return PointSet(axes, leaves, drawn(scatters, leaves, cube).tolist())


def _check_best(best: Best, outputs: tuple[Leaf, ...]) -> None:
    """Raise Unprocessable if a path in the criterion for the best point is not the path of a numeric output."""
    leaf_by_path = {leaf.path: leaf for leaf in outputs}
    judged = {"best.minimise" if best.minimise else "best.maximise": best.output}
    judged |= {f"best.where.{place}.output": bound.output for place, bound in enumerate(best.where)}
    for place, path in judged.items():
        if path not in leaf_by_path:
            message = f"{path} is not an output of the sweep{did_you_mean(path, leaf_by_path)}"
            raise Unprocessable("unknown_output", message, place)
        if leaf_by_path[path].kind == "text":
            raise Unprocessable("unknown_output", f"{path} is not a number", place)
