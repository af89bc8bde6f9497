"""A sweep: its header, a line a point, its end."""

from collections.abc import AsyncIterator
from dataclasses import dataclass
from typing import Any

from app.calculations import Calculation
from app.contract.cases import case_of
from app.responses.common import MODEL_VERSION
from app.studies.engine import Pool, Work, in_order
from app.studies.errors import StudyRefused
from app.studies.lines import point_line
from app.studies.outputs import ChosenOutputs
from app.studies.fields import did_you_mean
from app.studies.plan import Plan
from app.studies.points import solve_chunk
from app.studies.requests import Best, SweepRequest
from app.studies.stream import Clock, Line
from app.studies.summary import Summary


@dataclass(frozen=True, slots=True)
class Sweep:
    """A sweep that has passed its checks."""

    calculation: Calculation
    request: SweepRequest
    plan: Plan
    outputs: ChosenOutputs

    def header(self) -> Line:
        """The first line."""
        return {
            "type": "sweep",
            "endpoint": self.calculation.path,
            "axes": [{"path": axis.path, "unit": axis.unit, "values": axis.values} for axis in self.plan.axes],
            "outputs": self.outputs.header(),
            "total": self.plan.total,
            "model_version": MODEL_VERSION,
            "case": case_of("/v1/sweep", self.request.model_dump(), MODEL_VERSION),
        }

    async def lines(self, pool: Pool, clock: Clock) -> AsyncIterator[list[Line]]:
        """All lines but those of progress."""
        yield [self.header()]
        summary = Summary(self.plan, self.outputs.paths, self.request.best)
        work = Work(solve_chunk, self._arguments, len(self.outputs.paths))
        async for indices, points in in_order(pool, work, self.plan.total):
            for point in points:
                summary.add(point)
            clock.done = indices.stop
            yield [
                point_line(index, self.plan.at(index), point) for index, point in zip(indices, points, strict=True)
            ]
        yield [summary.line(clock.elapsed_s)]

    def _arguments(self, indices: range) -> tuple[Any, ...]:
        overrides = [self.plan.overrides(index) for index in indices]
        return self.calculation.path, self.request.request, overrides, self.outputs.paths


def check_best(best: Best | None, outputs: ChosenOutputs) -> None:
    """Refuse a best point that is judged by what the sweep does not tell."""
    if best is None:
        return
    goal = "minimise" if best.minimise else "maximise"
    judged = [(f"/best/{goal}", best.minimise or best.maximise or "")]
    judged += [(f"/best/where/{place}/output", bound.output) for place, bound in enumerate(best.where)]
    for pointer, path in judged:
        if path not in outputs.paths:
            message = f"{path} is not among the outputs of the sweep{did_you_mean(path, outputs.paths)}"
            raise StudyRefused(pointer, "unknown_output", message)
