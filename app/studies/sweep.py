"""Sweeps: a line a point, then extremes and statistics. Corners are a sweep over uncertain inputs."""

from dataclasses import dataclass
from typing import Any, ClassVar

from app.errors import Unprocessable
from app.schema.fields import Leaf
from app.schema.reading import validated
from app.studies.base_request import BaseRequest
from app.studies.engine import Clock, Line, Lines, Pool, Study, case_of_study, output_header, paths_of, twice_if_lost
from app.studies.fields import did_you_mean
from app.studies.point_sets import PointSet, grid, points_of, usual_corners
from app.studies.requests import Best, CornersRequest, SweepRequest
from app.studies.stream import Table, point_line
from app.studies.summary import NO_STATISTICS, Summary, statistics
from solvers.drive_train.uncertainty import MOST_CORNERS, no_convergence

PATH = "/v1/sweep"
CORNERS_PATH = "/v1/drive-train/corners"


@dataclass(frozen=True, slots=True, kw_only=True)
class Sweep(Study):
    """A request solved at the points of a set from `first` on."""

    kind: ClassVar[str] = "sweep"
    points: PointSet
    best: Best | None = None
    first: int = 0

    @property
    def total(self) -> int:
        """How many points it has from the first on."""
        return self.points.total - self.first

    def table(self) -> Table:
        """The lines as rows of a table."""
        return Table(self.points, self.outputs)

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
        summary = Summary(self.points, paths_of(self.outputs), self.best, self.first)
        indices = range(self.first, self.points.total)
        async for solved, points in self.solve(pool, clock, self.points.overrides, indices):
            for point in points:
                summary.add(point)
            yield [point_line(index, self.points.at(index), each) for index, each in zip(solved, points, strict=True)]
        yield await self.closing(summary, pool, clock)

    async def closing(self, summary: Summary, pool: Pool, clock: Clock) -> list[Line]:
        """The last lines."""
        found = NO_STATISTICS
        if self.points.sample is not None:
            inputs, outputs = paths_of(self.points.varied), paths_of(self.outputs)
            sample = self.points.sample[self.first :]
            found = await twice_if_lost(pool, statistics, sample, summary.tally.values, inputs, outputs)
        return [summary.line(found, clock.elapsed_s)]


@dataclass(frozen=True, slots=True, kw_only=True)
class Corners(Sweep):
    """A sweep over the combinations of uncertain inputs, which names the points of the extremes."""

    kind: ClassVar[str] = "corners"

    async def closing(self, summary: Summary, pool: Pool, clock: Clock) -> list[Line]:  # noqa: ARG002
        """The extremes of every output, and a warning where corners have no solution."""
        extremes = [
            {
                "type": "extremes",
                "output": path,
                **{end: {"value": each.value, "at": self.points.overrides(each.point)} for end, each in found.items()},
            }
            for path, found in summary.extremes.items()
        ]
        warnings = _unsolved_corners(self.total - summary.tally.answered)
        return [*extremes, {**summary.line(NO_STATISTICS, clock.elapsed_s), "warnings": warnings}]


def _unsolved_corners(count: int) -> list[dict[str, str]]:
    """The warning about corners without solution, if there are any."""
    notice = no_convergence(count)
    return [{"rank": notice.rank, "code": notice.code, "message": notice.message}] if count else []


def sweep_study(content: Any, most: int, deadline_s: float) -> Sweep:
    """The sweep in a body, of at most `most` points; runs in a worker.

    `content` is the body as JSON's objects, or validated. Raises InvalidBody and Unprocessable, with locations in it.
    """
    request = validated(SweepRequest, content)
    base = BaseRequest.of(request)
    outputs = base.outputs(request.outputs)
    if request.best is not None:
        _check_best(request.best, outputs)
    points = points_of(request, base, most)
    _check_first(request.from_index, points)
    base.checked(points.overrides(0))
    return Sweep(
        question=base.question(paths_of(outputs), deadline_s),
        outputs=outputs,
        case=case_of_study(PATH, request),
        points=points,
        best=request.best,
        first=request.from_index,
    )


def corners_study(content: Any, most: int, deadline_s: float) -> Corners:
    """The corners of a gear unit in a body; arguments and errors as of `sweep_study`."""
    request = validated(CornersRequest, content)
    base = BaseRequest.of(request)
    outputs = base.outputs(request.outputs)
    ranges = list(usual_corners(base.checked({})).values()) if request.ranges is None else request.ranges
    if not ranges:
        raise Unprocessable("no_corners", "nothing is uncertain here; name what is", "ranges")
    points = grid(ranges, base, min(most, MOST_CORNERS), "ranges")
    _check_first(request.from_index, points)
    base.checked(points.overrides(0))
    return Corners(
        question=base.question(paths_of(outputs), deadline_s, reduced=True),
        outputs=outputs,
        case=case_of_study(CORNERS_PATH, request),
        points=points,
        first=request.from_index,
    )


def _check_first(index: int, points: PointSet) -> None:
    if index >= points.total:
        message = f"the study has {points.total} points, counted from 0"
        raise Unprocessable("out_of_range", message, "from_index")


def _check_best(best: Best, outputs: tuple[Leaf, ...]) -> None:
    """Refuse a best point by what is no output of the sweep, or no number."""
    known = {leaf.path: leaf for leaf in outputs}
    goal = "minimise" if best.minimise else "maximise"
    judged: list[tuple[str, Any]] = [(f"best.{goal}", best.output)]
    judged += [(f"best.where.{place}.output", bound.output) for place, bound in enumerate(best.where)]
    for place, path in judged:
        if path not in known:
            message = f"{path} is not among the outputs of the sweep{did_you_mean(path, known)}"
            raise Unprocessable("unknown_output", message, place)
        if known[path].kind == "text":
            raise Unprocessable("unknown_output", f"{path} is no number", place)
