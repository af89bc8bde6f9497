"""Worst corners of a gear unit: every combination of what nobody knows better, and where each output is at its ends."""

from collections.abc import Iterator
from dataclasses import dataclass

from app.problems import Unprocessable
from app.reading import read
from app.schema.base import MODEL_VERSION
from app.sources import SOURCES
from app.studies.engine import Pool, Work, in_order
from app.studies.lines import point_line
from app.studies.outputs import Outputs, chosen
from app.studies.plan import Plan, Varied, grid
from app.studies.points import Question
from app.studies.reading import calculation_of, case_of_study, checked_base
from app.studies.stream import Clock, Line, Lines
from app.studies.summary import NO_STATISTICS, Extreme, Summary
from app.studies.unit import MOST_CORNERS, lightened, usual_corners
from app.studies.unit_requests import ENDPOINT, CornersRequest
from solvers.drive_train.studies.corners import unconverged

PATH = f"{ENDPOINT}/corners"


@dataclass(frozen=True, slots=True)
class Corners:
    """Corners that have passed their checks."""

    question: Question
    plan: Plan
    outputs: Outputs
    case: str

    @property
    def total(self) -> int:
        """How many corners there are."""
        return self.plan.total

    async def lines(self, pool: Pool, clock: Clock) -> Lines:
        """All lines but those of progress: the ranges, each corner, the extremes of each output, the end."""
        yield [self._header()]
        summary = Summary(self.plan, self.outputs.paths, None)
        async for indices, points in in_order(pool, Work(self.question, self.plan.overrides, self.total)):
            for point in points:
                summary.add(point)
            clock.done = indices.stop
            yield [point_line(index, self.plan.at(index), point) for index, point in zip(indices, points, strict=True)]
        unsolved = self.total - summary.answered
        warnings = [{"code": unconverged(unsolved).code, "message": unconverged(unsolved).message}] if unsolved else []
        yield [*self._extremes(summary), {**summary.line(NO_STATISTICS, clock.elapsed_s), "warnings": warnings}]

    def _header(self) -> Line:
        return {
            "type": "corners",
            "endpoint": self.question.endpoint,
            "axes": [axis.header() for axis in self.plan.axes],
            "outputs": self.outputs.header(),
            "total": self.total,
            "model_version": MODEL_VERSION,
            "sources": SOURCES,
            "case": self.case,
        }

    def _extremes(self, summary: Summary) -> Iterator[Line]:
        for path, found in summary.extremes.items():
            ends = {end: self._place(extreme) for end, extreme in found.items()}
            yield {"type": "extremes", "output": path, **ends}

    def _place(self, extreme: Extreme) -> Line:
        return {"value": extreme.value, "at": self.plan.overrides(extreme.point)}


def plan_corners(body: bytes, most: int, deadline_s: float) -> Corners:
    """The corners that a body asks for; runs in a worker.

    Raises Unreadable, InvalidBody and Unprocessable, with locations in the study.
    """
    request = read(CornersRequest, body)
    calculation = calculation_of(request)
    outputs = chosen(calculation, request.outputs)
    ranges = request.ranges
    if ranges is None:
        ranges = usual_corners(checked_base(calculation, request.request, {}))
    if not ranges:
        raise Unprocessable("no_corners", "nothing is uncertain here; name what is", "ranges")
    plan = grid(ranges, Varied(calculation.request, request.request), "ranges", min(most, MOST_CORNERS))
    checked_base(calculation, request.request, plan.overrides(0))
    base = lightened(request.request, outputs.paths)
    return Corners(
        Question(calculation.path, base, outputs.paths, deadline_s), plan, outputs, case_of_study(PATH, request)
    )
