"""A sweep: its header, a line a point, its end."""

from dataclasses import dataclass
from typing import Any

from app.problems import Unprocessable
from app.reading import read
from app.schema.base import MODEL_VERSION
from app.schema.fields import Leaf
from app.sources import SOURCES
from app.studies.engine import Pool, Work, in_order, twice_if_lost
from app.studies.fields import did_you_mean, scalar_at
from app.studies.lines import Table, point_line
from app.studies.outputs import Outputs, chosen
from app.studies.plan import Plan, planned
from app.studies.points import Question
from app.studies.reading import calculation_of, case_of_study, checked_base
from app.studies.requests import Best, SweepRequest
from app.studies.stream import Clock, Line, Lines
from app.studies.summary import NO_STATISTICS, Summary, statistics

PATH = "/v1/sweep"


@dataclass(frozen=True, slots=True)
class Sweep:
    """A sweep that has passed its checks."""

    question: Question
    plan: Plan
    varied: tuple[Leaf, ...]
    outputs: Outputs
    best: Best | None
    case: str

    @property
    def total(self) -> int:
        """How many points it has."""
        return self.plan.total

    async def lines(self, pool: Pool, clock: Clock) -> Lines:
        """All lines but those of progress."""
        yield [self._header()]
        summary = Summary(self.plan, self.outputs.paths, self.best)
        async for indices, points in in_order(pool, Work(self.question, self.plan.overrides, self.total)):
            for point in points:
                summary.add(point)
            clock.done = indices.stop
            yield [point_line(index, self.plan.at(index), point) for index, point in zip(indices, points, strict=True)]
        yield [summary.line(await self._statistics(pool, summary), clock.elapsed_s)]

    def table(self) -> Table:
        """The same as rows of a table."""
        return Table(self.plan, self.varied, self.outputs.leaves)

    def _header(self) -> Line:
        return {
            "type": "sweep",
            "endpoint": self.question.endpoint,
            "axes": [axis.header() for axis in self.plan.axes],
            "outputs": self.outputs.header(),
            "total": self.total,
            "model_version": MODEL_VERSION,
            "sources": SOURCES,
            "case": self.case,
        }

    async def _statistics(self, pool: Pool, summary: Summary) -> dict[str, Any]:
        if self.plan.sample is None:
            return NO_STATISTICS
        inputs = [axis.leaves[0].path for axis in self.plan.axes]
        arguments = (self.plan.sample, summary.values, inputs, self.outputs.paths)
        found: dict[str, Any] = await twice_if_lost(pool, statistics, *arguments)
        return found


def plan_sweep(body: bytes, most: int, deadline_s: float) -> Sweep:
    """The sweep that a body asks for; runs in a worker.

    Raises Unreadable, InvalidBody and Unprocessable, with locations in the sweep.
    """
    request = read(SweepRequest, body)
    calculation = calculation_of(request)
    outputs = chosen(calculation, request.outputs)
    if request.best is not None:
        _check_best(request.best, outputs)
    plan = planned(request, calculation.request, most)
    checked_base(calculation, request.request, plan.overrides(0))
    paths = dict.fromkeys(path for case in plan.cases or () for path in case)
    listed = (scalar_at(calculation.request, path, "cases", "unknown_path") for path in paths)
    return Sweep(
        question=Question(calculation.path, request.request, outputs.paths, deadline_s),
        plan=plan,
        varied=(*(leaf for axis in plan.axes for leaf in axis.leaves), *listed),
        outputs=outputs,
        best=request.best,
        case=case_of_study(PATH, request),
    )


def _check_best(best: Best, outputs: Outputs) -> None:
    """Refuse a best point that is judged by what the sweep does not tell, or by words."""
    goal = "minimise" if best.minimise else "maximise"
    judged = [(f"best.{goal}", best.output)]
    judged += [(f"best.where.{place}.output", bound.output) for place, bound in enumerate(best.where)]
    for place, path in judged:
        if path not in outputs.paths:
            message = f"{path} is not among the outputs of the sweep{did_you_mean(path, outputs.paths)}"
            raise Unprocessable("unknown_output", message, place)
        if outputs.leaves[outputs.paths.index(path)].kind == "text":
            raise Unprocessable("unknown_output", f"{path} is no number", place)
