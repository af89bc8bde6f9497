"""What matters: every number of a case is moved by its tolerance, down and up, and the outputs are compared.

The measure is the range of an output over the tolerance of an input. A correlation or a slope at the case is blind to
an effect of the same sign on both sides, such as that of the helix slope about its best value; the range is not. Unlike
a share of variance it is in the unit of the output, has no sampling error and costs four points per input. What inputs
do together it does not see.
"""

from collections import Counter
from dataclasses import dataclass, replace
from typing import Annotated, Any

from pydantic import Field

from app.errors import Unprocessable
from app.schema.fields import ITEM, Leaf, leaves, value_at
from app.schema.precision import NOISE
from app.schema.quantities import Input
from app.studies import runner
from app.studies.fields import NUMBERS, fault, indexed, is_plain_number, not_a_number, scalar_at
from app.studies.points import BaseRequest, Point, check_count, check_distinct
from app.studies.requests import FieldPath, Overrides, StudyRequest
from app.studies.runner import Clock, Line, Lines, Pool, Study, output_header
from app.studies.tolerances import class_assumptions, class_tolerances

RELATIVE_STEP = 0.01  # step as a share of the value; much smaller than usual ranges, much larger than solver errors
KELVIN_STEP = 1.0  # step of temperatures; a share of a temperature in degrees Celsius has no physical meaning
DISAGREEMENT = 0.1  # relative difference above which two slopes count as different


class SensitivityRequest(StudyRequest):
    """A request, the inputs that are moved one at a time, and the outputs whose changes are calculated."""

    inputs: Annotated[
        list[FieldPath] | None,
        Field(min_length=1, max_length=200),
        Input("inputs", text="dotted paths of the numbers to move", default_text="every number of the case"),
    ] = None


@dataclass(frozen=True, slots=True)
class Perturbation:
    """An input, its value, and the step by which the value is moved.

    If the step is the tolerance of the input, the step may be too large for a linear change of the output. To check
    this, the slope over the step is compared with the slope over `half`, which is half the step. If the step is not the
    tolerance, `half` is None.
    """

    leaf: Leaf
    value: float
    step: float
    half: float | None = None

    @property
    def places(self) -> list[float]:
        """The values to which the input is moved.

        They lie one step below and one step above the value of the input. If `half` is set, the values half a step
        below and half a step above follow. Values outside the permissible range of the input are left out.
        """
        steps = [self.step] if self.half is None else [self.step, self.half]
        number = int if self.leaf.kind == "integer" else float
        moved = [number(self.value + sign * step) for step in steps for sign in (-1, 1)]
        return [place for place in moved if place != self.value and fault(self.leaf, place) is None]


def perturbation(leaf: Leaf, value: float, tolerance: float | None = None) -> Perturbation:
    """Return the perturbation of an input.

    The step is 1 for an integer; else a `tolerance` of this case, the declared tolerance, or 1 K or 1 % of the value.
    """
    if leaf.kind == "integer":
        return Perturbation(leaf, value, 1.0)
    if tolerance is not None:
        return Perturbation(leaf, value, tolerance, tolerance / 2.0)
    declared = leaf.declared.tolerance_of(value)
    if declared is not None:
        return Perturbation(leaf, value, declared, declared / 2.0)
    return Perturbation(leaf, value, KELVIN_STEP if leaf.unit == "°C" else RELATIVE_STEP * abs(value))


def differences(moved: Perturbation, outputs: dict[float, float | None]) -> Line:
    """Compute what an input does to an output over its tolerance, and the derivative of the output.

    `outputs` maps each value of the input to the value of the output, or to None if there is no answer. The items of
    the result are:

    `range`: the largest minus the least output over the tolerance, at the value of the input and at half and whole
    steps to both sides; None if there is no answer beside the case, or none of the case.
    `lowered`, `raised`: the changes of the output if the input is lowered or raised by one step; None without answer.
    `derivative`: the central difference quotient [output per input], or a one-sided quotient if there is no answer
    below or above the value of the input.
    `elasticity`: the change of the output in per cent if the input changes by 1 %. It is None if the input or the
    output is zero, if the unit of the input is degrees Celsius, or if there is no derivative.
    `step`: the step of the input.
    `change`: the change of the output if the input is raised by one step, computed with the steeper of the two
    one-sided slopes.
    `kink`: True if the two one-sided slopes differ by more than a tenth; None if one of these slopes is missing.
    `curved`: True if the derivative over the step and the derivative over half the step differ by more than a tenth;
    None if there is no half step.

    `kink` and `curved` are False if one step changes the output by at most `NOISE` times the output.
    """
    base, step, half = outputs[moved.value], moved.step, moved.half

    def slope(below: float, above: float) -> float | None:
        """Return the slope of the output between two values of the input.

        The two values are the value of the input in the case plus `below` and plus `above`. If there is no answer at
        one of the two values, the value of the input in the case takes the place of this value.
        """
        places = [moved.value + offset for offset in (below, 0, above)]
        pairs = [(place, value) for place in places if (value := outputs.get(place)) is not None]
        if base is None or pairs[0][0] == pairs[-1][0]:
            return None
        return (pairs[-1][1] - pairs[0][1]) / (pairs[-1][0] - pairs[0][0])

    def disagree(one: float | None, other: float | None) -> bool | None:
        if one is None or other is None or base is None:
            return None
        largest = max(abs(one), abs(other))
        return largest * step > NOISE * abs(base) and abs(one - other) > DISAGREEMENT * largest

    derivative, elasticity, sides = slope(-step, step), None, (slope(-step, 0), slope(0, step))
    if derivative is not None and base and moved.value and moved.leaf.unit != "°C":
        elasticity = derivative * moved.value / base

    def change(sign: int) -> float | None:
        moved_to = outputs.get(moved.value + sign * step)
        return None if base is None or moved_to is None else moved_to - base

    known = [value for value in outputs.values() if value is not None]
    return {
        "range": max(known) - min(known) if base is not None and len(known) > 1 else None,
        "lowered": change(-1),
        "raised": change(1),
        "derivative": derivative,
        "elasticity": elasticity,
        "step": step,
        "change": max((side * step for side in sides if side is not None), key=abs, default=None),
        "kink": disagree(*sides),
        "curved": None if half is None else disagree(derivative, slope(-half, half)),
    }


class Sensitivity(Study):
    """Every number of the case moved by its tolerance, down and up: what that does to the outputs.

    The step of an input is:

    - 1 for an integer
    - the tolerance for any other input that has a tolerance; by the quality class of the gears, if they have one
    - 1 K for a temperature without a tolerance
    - 1 % of the value for all remaining inputs

    The inputs are ranked by `range`, the largest minus the least output over the tolerance (at no, half and whole
    steps), which also sees an effect of the same sign on both sides; `lowered` and `raised` are the changes of the
    output at both ends.

    `change` is the change of the output if the input is raised by one step. `elasticity` is the change of the output in
    per cent if the input changes by 1 %. `kink` is true if the slopes below and above the value of the input differ by
    more than 10 %. `curved` is true if the derivative over the step and the derivative over half the step differ by
    more than 10 %; it is null for integers and for inputs without a tolerance.
    """

    path = "/v1/sensitivity"
    summary = "What moves each output most"
    answer = "a line for each output and input, the most influential first, and one for the end"
    model = SensitivityRequest
    body: SensitivityRequest

    def _planned(self, base: BaseRequest, most: int) -> int:
        request = base.checked({})
        paths, case, by_class = self.body.inputs, request.model_dump(), class_tolerances(request)
        inputs = _every_number(base, case) if paths is None else _named(base, case, paths)
        perturbations = [perturbation(leaf, value_at(case, leaf.path), by_class.get(leaf.path)) for leaf in inputs]
        moved_by_class = {leaf.path: by_class[leaf.path] for leaf in inputs if leaf.path in by_class}
        self.by_class = class_assumptions(request, moved_by_class)
        self.perturbations = [moved for moved in perturbations if moved.places]
        total = 1 + sum(len(moved.places) for moved in self.perturbations)
        check_count(total, most, "inputs")
        return total

    async def lines(self, pool: Pool, clock: Clock) -> Lines:
        """Yield one result for each pair of an output and an input, and then the line `end`.

        The results for the first output come first. For each output, the input with the greatest influence comes first.
        """
        overrides: list[Overrides] = [{}]  # the first point is the case itself
        overrides += [{moved.leaf.path: place} for moved in self.perturbations for place in moved.places]
        points: list[Point] = []
        await self._size_flow(pool, {})
        async for _, chunk in runner.in_order(pool, self.question, overrides.__getitem__, range(self.total), clock):
            points += chunk
        yield [line for column in range(len(self.outputs)) for line in self._ranked(column, points)]
        base = points[0]
        end = self.header(
            inputs=[{**output_header(moved.leaf), "value": moved.value} for moved in self.perturbations],
            outputs=[
                {**output_header(leaf), "value": value} for leaf, value in zip(self.outputs, base.out, strict=True)
            ],
            points=len(points),
            counts=dict(sorted(Counter(point.status for point in points).items())),
            status=base.status,
            warnings=base.warnings,
            error=base.error,
            assumptions=[*base.assumptions, *self.by_class],
        )
        yield [{**end, "type": "end", "elapsed_s": clock.elapsed_s}]

    def _ranked(self, column: int, points: list[Point]) -> list[Line]:
        """Return one line per input for the output in `column`. The most influential input comes first."""
        values = (point.out[column] for point in points)
        base, *others = (float(value) if is_plain_number(value) else None for value in values)
        rest = iter(others)
        lines: list[Line] = []
        output = self.outputs[column].path
        for moved in self.perturbations:
            outputs = {moved.value: base, **{place: next(rest) for place in moved.places}}
            line: Line = {"type": "sensitivity", "output": output, "path": moved.leaf.path}
            lines.append(line | differences(moved, outputs))
        return sorted(lines, key=lambda line: -(line["range"] or 0.0))


def _every_number(base: BaseRequest, case: dict[str, Any]) -> list[Leaf]:
    """Return all inputs that have a number in this case. The number may be given or assumed.

    Options of the model and of the resolution are left out.
    """
    return [
        replace(leaf, path=path, dimensions=0)
        for leaf in leaves(base.calculation.request)
        if leaf.dimensions < 2 and leaf.kind in NUMBERS and not leaf.advanced
        for path in indexed(leaf.path if leaf.is_scalar else f"{leaf.path}.{ITEM}", case)
        if value_at(case, path) is not None
    ]


def _named(base: BaseRequest, case: dict[str, Any], paths: list[str]) -> list[Leaf]:
    """Return the inputs at these paths. Raises Unprocessable if the case has no number at one of the paths."""
    check_distinct(paths, "inputs", numbered=True)
    model = base.calculation.request
    named = [scalar_at(model, path, f"inputs.{place}", "unknown_path") for place, path in enumerate(paths)]
    for place, leaf in enumerate(named):
        message = not_a_number(leaf)
        if message is not None:
            raise Unprocessable(
                "not_scalar", f"{message}; use a sweep to compare the values of this field", f"inputs.{place}"
            )
        if value_at(case, leaf.path) is None:
            raise Unprocessable(
                "not_scalar",
                f"{leaf.path} has no value in this case; leave this input out, or give the value in the case",
                f"inputs.{place}",
            )
    return named
