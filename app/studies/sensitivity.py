"""What moves each output most: differences over every input, sorted by influence."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from app.calculations import Calculation
from app.problems import Unprocessable
from app.reading import read
from app.schema.base import MODEL_VERSION
from app.schema.fields import ITEM, Leaf, leaves
from app.sources import SOURCES
from app.studies.differences import Differences, Probe, probe
from app.studies.engine import Pool, Work, in_order
from app.studies.fields import scalar_at, value_at
from app.studies.outputs import Outputs, chosen
from app.studies.plan import check_count
from app.studies.points import Point, Question
from app.studies.reading import calculation_of, case_of_study, checked_base
from app.studies.requests import Overrides, SensitivityRequest
from app.studies.stream import Clock, Line, Lines

PATH = "/v1/sensitivity"
NUMBERS = {"number", "integer"}


@dataclass(frozen=True, slots=True)
class Sensitivity:
    """A study of sensitivity that has passed its checks; its first point is the case itself."""

    question: Question
    outputs: Outputs
    probes: list[Probe]
    case: str

    @property
    def total(self) -> int:
        """How many points it has."""
        return len(self._overrides())

    async def lines(self, pool: Pool, clock: Clock) -> Lines:
        """All lines but those of progress: of each output the most influential input first, then the end."""
        points: list[Point] = []
        overrides = self._overrides()
        async for indices, answers in in_order(pool, Work(self.question, overrides.__getitem__, len(overrides))):
            points += answers
            clock.done = indices.stop
        yield list(self._ranked(points))
        yield [self._end(points, clock)]

    def _overrides(self) -> list[Overrides]:
        return [{}, *(override for each in self.probes for override in each.overrides())]

    def _ranked(self, points: list[Point]) -> Iterator[Line]:
        for column, path in enumerate(self.outputs.paths):
            found = self._differences([_number(point.out[column]) for point in points])
            for each in sorted(found, key=lambda differences: -abs(differences.change or 0.0)):
                yield {
                    "type": "sensitivity",
                    "output": path,
                    "path": each.probe.leaf.path,
                    "derivative": each.derivative,
                    "elasticity": each.elasticity,
                    "step": each.probe.step,
                    "change": each.change,
                    "kink": each.kink,
                    "curved": each.curved,
                }

    def _differences(self, values: list[float | None]) -> Iterator[Differences]:
        """Every input's differences from the values of one output in the order of the points."""
        base, *moved = values
        rest = iter(moved)
        yield from (_differences(each, base, rest) for each in self.probes)

    def _end(self, points: list[Point], clock: Clock) -> Line:
        base = points[0]
        return {
            "type": "end",
            "endpoint": self.question.endpoint,
            "inputs": [
                {"path": each.leaf.path, "unit": each.leaf.unit, "title": each.leaf.title, "value": each.value}
                for each in self.probes
            ],
            "outputs": [
                {**output, "value": value} for output, value in zip(self.outputs.header(), base.out, strict=True)
            ],
            "points": len(points),
            "counts": dict(sorted(Counter(point.status for point in points).items())),
            "status": base.status,
            "warnings": base.warnings,
            "error": base.error,
            "assumptions": base.assumptions,
            "model_version": MODEL_VERSION,
            "sources": SOURCES,
            "case": self.case,
            "elapsed_s": clock.elapsed_s,
        }


def _differences(probe: Probe, base: float | None, moved: Iterator[float | None]) -> Differences:
    """The differences of one input, whose values come next."""
    below = next(moved) if probe.below is not None else None
    above = next(moved) if probe.above is not None else None
    half = None if probe.half is None else _differences(probe.half, base, moved)
    return Differences(probe, base, below, above, half)


def _number(value: Any) -> float | None:
    return float(value) if isinstance(value, int | float) and not isinstance(value, bool) else None


def plan_sensitivity(body: bytes, most: int, deadline_s: float) -> Sensitivity:
    """The study that a body asks for; runs in a worker.

    Raises Unreadable, InvalidBody and Unprocessable, with locations in the study.
    """
    request = read(SensitivityRequest, body)
    calculation = calculation_of(request)
    outputs = chosen(calculation, request.outputs)
    case = checked_base(calculation, request.request, {}).model_dump()
    question = Question(calculation.path, request.request, outputs.paths, deadline_s)
    if request.inputs is None:
        inputs = _every_number(calculation, case)
    else:
        inputs = [_named(calculation, case, request.inputs, place) for place in range(len(request.inputs))]
    probes = [each for leaf in inputs if (each := probe(leaf, value_at(case, leaf.path)))]
    study = Sensitivity(question, outputs, probes, case_of_study(PATH, request))
    check_count(study.total, most, "inputs")
    return study


def _every_number(calculation: Calculation, case: dict[str, Any]) -> list[Leaf]:
    """Every number that the case has, assumed ones included, options of model and resolution not."""
    return [
        scalar_at(calculation.request, path, "inputs", "unknown_path")
        for leaf in leaves(calculation.request)
        if leaf.dimensions < 2 and leaf.kind in NUMBERS and not leaf.advanced
        for path in _numbers_at(leaf, case)
        if value_at(case, path) is not None
    ]


def _numbers_at(leaf: Leaf, case: dict[str, Any]) -> list[str]:
    """The paths of a field's numbers: every item of a list."""
    paths = places(leaf.path, case)
    if leaf.is_scalar:
        return paths
    return [f"{path}.{index}" for path in paths for index in range(len(value_at(case, path) or ()))]


def places(path: str, case: dict[str, Any]) -> list[str]:
    """The path with every index that its lists have."""
    before, star, after = path.partition(f".{ITEM}.")
    if not star:
        return [path]
    items = range(len(value_at(case, before) or ()))
    return [place for index in items for place in places(f"{before}.{index}.{after}", case)]


def _named(calculation: Calculation, case: dict[str, Any], paths: list[str], place: int) -> Leaf:
    path, where = paths[place], f"inputs.{place}"
    if path in paths[:place]:
        raise Unprocessable("duplicate_path", f"{path} stands here twice", where)
    leaf = scalar_at(calculation.request, path, where, "unknown_path")
    value = value_at(case, path)
    if leaf.kind not in NUMBERS or value is None:
        raise Unprocessable("not_scalar", f"{path} has no number in this case", where)
    return leaf
