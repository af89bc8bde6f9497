"""What moves each output most: central differences over every input, sorted by influence."""

from collections.abc import AsyncIterator
from dataclasses import dataclass
from typing import Any, Literal

from app.calculations import Calculation
from app.contract.cases import case_of
from app.contract.fields import Leaf
from app.responses.common import MODEL_VERSION
from app.studies.fields import fault
from app.studies.engine import Pool, Work, in_order
from app.studies.outputs import ChosenOutputs
from app.studies.points import Point, solve_chunk
from app.studies.requests import Overrides, SensitivityRequest
from app.studies.stream import Clock, Line

RELATIVE_STEP = 0.01
KELVIN_STEP = 1.0
KINK = 0.1  # relative difference of the one-sided slopes

Side = Literal["minus", "plus"]


@dataclass(frozen=True, slots=True)
class Probe:
    """One input, where it stands and how far it is moved to either side; None where its range ends."""

    leaf: Leaf
    value: float
    step: float
    minus: float | None
    plus: float | None


def probe(leaf: Leaf, value: float) -> Probe | None:
    """How an input is moved: by its tolerance, else by 1 %, 1 K for a temperature, 1 for a count."""
    step = _step(leaf, value)
    if step == 0.0:
        return None
    minus, plus = (_inside(leaf, value + sign * step) for sign in (-1.0, 1.0))
    return None if minus is None and plus is None else Probe(leaf, value, step, minus, plus)


def _step(leaf: Leaf, value: float) -> float:
    if leaf.kind == "integer":
        return 1.0
    if leaf.tolerance is not None:
        return leaf.tolerance
    if leaf.unit == "°C":
        return KELVIN_STEP
    if value != 0.0:
        return RELATIVE_STEP * abs(value)
    low, high = (leaf.bounds.get(key) for key in ("ge", "le"))
    return 0.0 if low is None or high is None else RELATIVE_STEP * (high - low)


def _inside(leaf: Leaf, value: float) -> float | None:
    moved = int(value) if leaf.kind == "integer" else value
    return moved if fault(leaf, moved) is None else None


@dataclass(frozen=True, slots=True)
class Sensitivity:
    """A study of sensitivity that has passed its checks; the first point is the case itself."""

    calculation: Calculation
    request: SensitivityRequest
    outputs: ChosenOutputs
    probes: list[Probe]

    def header(self) -> Line:
        """The first line."""
        return {
            "type": "sensitivities",
            "endpoint": self.calculation.path,
            "inputs": [{"path": each.leaf.path, "unit": each.leaf.unit, "value": each.value} for each in self.probes],
            "outputs": self.outputs.header(),
            "total": len(self._places()) + 1,
            "model_version": MODEL_VERSION,
            "case": case_of("/v1/sensitivity", self.request.model_dump(), MODEL_VERSION),
        }

    async def lines(self, pool: Pool, clock: Clock) -> AsyncIterator[list[Line]]:
        """All lines but those of progress: the most influential input of each output first."""
        yield [self.header()]
        overrides: list[Overrides] = [{}, *(override for _, override in self._places())]

        def arguments(indices: range) -> tuple[Any, ...]:
            chosen = [overrides[index] for index in indices]
            return self.calculation.path, self.request.request, chosen, self.outputs.paths

        answers: list[Point] = []
        work = Work(solve_chunk, arguments, len(self.outputs.paths))
        async for indices, points in in_order(pool, work, len(overrides)):
            answers += points
            clock.done = indices.stop
        yield self._ranked(answers)
        counts = {status: sum(point.status == status for point in answers) for status in {p.status for p in answers}}
        yield [{"type": "end", "points": len(answers), "counts": dict(sorted(counts.items())), "elapsed_s": clock.elapsed_s}]

    def _places(self) -> list[tuple[tuple[int, Side], Overrides]]:
        """Every moved point: which probe, which side, what it changes."""
        return [
            ((place, side), {each.leaf.path: value})
            for place, each in enumerate(self.probes)
            for side, value in (("minus", each.minus), ("plus", each.plus))
            if value is not None
        ]

    def _ranked(self, answers: list[Point]) -> list[Line]:
        moved = dict(zip((key for key, _ in self._places()), answers[1:], strict=True))
        lines = []
        for column, path in enumerate(self.outputs.paths):
            rows = [
                _row(path, each, _value(answers[0], column), *(_value(moved.get((place, side)), column) for side in ("minus", "plus")))
                for place, each in enumerate(self.probes)
            ]
            lines += sorted(rows, key=lambda row: -abs(row["change"] or 0.0))
        return lines


def _value(point: Point | None, column: int) -> float | None:
    value = None if point is None else point.out[column]
    return float(value) if isinstance(value, int | float) and not isinstance(value, bool) else None


def _row(output: str, each: Probe, base: float | None, below: float | None, above: float | None) -> Line:
    """Derivative [output per input], elasticity, the change over one step, and whether the slopes disagree."""
    left = _slope(base, below, each.value, each.minus)
    right = _slope(base, above, each.value, each.plus)
    both = None if left is None or right is None or each.minus is None or each.plus is None else (above - below) / (each.plus - each.minus)
    derivative = both if both is not None else left if left is not None else right
    return {
        "type": "sensitivity",
        "output": output,
        "path": each.leaf.path,
        "derivative": derivative,
        "elasticity": _elasticity(each, base, derivative),
        "step": each.step,
        "change": None if derivative is None else derivative * each.step,
        "kink": _kink(left, right),
    }


def _slope(base: float | None, moved: float | None, at: float, place: float | None) -> float | None:
    return None if base is None or moved is None or place is None else (moved - base) / (place - at)


def _elasticity(each: Probe, base: float | None, derivative: float | None) -> float | None:
    """Per cent of the output for a per cent of the input; none at zero and for a temperature in degrees."""
    if derivative is None or not base or not each.value or each.leaf.unit == "°C":
        return None
    return derivative * each.value / base


def _kink(left: float | None, right: float | None) -> bool:
    """Whether the slopes to either side disagree by more than a tenth."""
    if left is None or right is None:
        return False
    return abs(left - right) > KINK * max(abs(left), abs(right))
