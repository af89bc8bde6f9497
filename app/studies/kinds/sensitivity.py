"""Sensitivity: derivatives of each output with respect to each number of a case, by differences.

An input is moved by its tolerance, else by 1 % (1 K for a temperature, 1 for a count); a step of a tolerance is checked
at half of it. On its page the inputs are sorted by what they change, as a figure and a table.
"""

from collections import Counter
from dataclasses import dataclass, replace
from typing import Annotated, Any

from pydantic import Field

from app.errors import Unprocessable
from app.figures.data import Figure
from app.figures.studies import Influence, influence
from app.figures.units import axis_of
from app.figures.wording import difference_unit
from app.pages.query import link
from app.pages.studies.controls import numbered
from app.pages.studies.page import Link, Number, Result, StudyPage, Table
from app.pages.study_kinds import StudyLink
from app.pages.study_links import VARY
from app.pages.typesetting import shown
from app.schema.fields import ITEM, Leaf, leaves
from app.schema.quantities import Input
from app.schema.scuffing import GIVEN_BULK
from app.studies import runner
from app.studies.fields import NUMBERS, fault, indexed, not_a_number, scalar_at, value_at
from app.studies.points import BaseRequest, Point, check_count, check_distinct
from app.studies.requests import FieldPath, Overrides, StudyRequest
from app.studies.runner import Clock, Line, Lines, Pool, Study, output_header

RELATIVE_STEP = 0.01  # of a value: small against its range, large against the solver's tolerance
KELVIN_STEP = 1.0  # of a temperature, whose zero means nothing
DISAGREEMENT = 0.1  # relative difference of two slopes
NOISE = 1e-7  # relative change of an output that an iteration may leave
MOST_ROWS = 40  # of a table that can be read; the file has all


class SensitivityRequest(StudyRequest):
    """How each output moves with each input."""

    inputs: Annotated[
        list[FieldPath] | None,
        Field(min_length=1, max_length=200),
        Input("inputs", text="dotted paths of the numbers to move", default_text="every number of the case"),
    ] = None


@dataclass(frozen=True, slots=True)
class Perturbation:
    """An input, its value and the step by which it is moved.

    The step is the tolerance where the field has one; as that need not be small, the slope is compared with that over
    `half` of it, which is None for other steps.
    """

    leaf: Leaf
    value: float
    step: float
    half: float | None = None

    @property
    def places(self) -> list[float]:
        """The values it is moved to: below, above, the same by half the step; those that its range allows."""
        steps = [self.step] if self.half is None else [self.step, self.half]
        number = int if self.leaf.kind == "integer" else float
        moved = [number(self.value + sign * step) for step in steps for sign in (-1, 1)]
        return [place for place in moved if place != self.value and fault(self.leaf, place) is None]


def perturbation(leaf: Leaf, value: float) -> Perturbation:
    """An input moved by its tolerance, else by 1 %, 1 K for a temperature, 1 for a count."""
    if leaf.kind == "integer":
        return Perturbation(leaf, value, 1.0)
    if leaf.declared.tolerance is not None:
        step = max(leaf.declared.tolerance, (leaf.declared.relative_tolerance or 0.0) * abs(value))
        return Perturbation(leaf, value, step, step / 2.0)
    return Perturbation(leaf, value, KELVIN_STEP if leaf.unit == "°C" else RELATIVE_STEP * abs(value))


def differences(moved: Perturbation, outputs: dict[float, float | None]) -> Line:
    """The change and the derivative of an output by one input; `outputs` by value of the input, None without answer.

    The derivative [output per input] is central where both sides have answers, else one-sided; `elasticity` is per cent
    of the output for a per cent of the input, none at zero and for a temperature in degrees; `change` is by one step
    upwards, from the side where it is larger; `kink`: the slopes of both sides differ by more than a tenth, None where
    one is missing; `curved`: half the step gives a derivative that differs by more than a tenth, None where it is not
    checked.
    """
    base, step, half = outputs[moved.value], moved.step, moved.half

    def slope(below: float, above: float) -> float | None:
        """Difference quotient between two steps; from the base to the other side where one has no answer."""
        places = [moved.value + each for each in (below, 0, above)]
        known = [(place, value) for place in places if (value := outputs.get(place)) is not None]
        if base is None or known[0][0] == known[-1][0]:
            return None
        return (known[-1][1] - known[0][1]) / (known[-1][0] - known[0][0])

    def disagree(one: float | None, other: float | None) -> bool | None:
        if one is None or other is None or base is None:
            return None
        largest = max(abs(one), abs(other))
        return largest * step > NOISE * abs(base) and abs(one - other) > DISAGREEMENT * largest

    derivative, elasticity, sides = slope(-step, step), None, (slope(-step, 0), slope(0, step))
    if derivative is not None and base and moved.value and moved.leaf.unit != "°C":
        elasticity = derivative * moved.value / base
    return {
        "derivative": derivative,
        "elasticity": elasticity,
        "step": step,
        "change": max((each * step for each in sides if each is not None), key=abs, default=None),
        "kink": disagree(*sides),
        "curved": None if half is None else disagree(derivative, slope(-half, half)),
    }


class Sensitivity(Study):
    """Derivatives of the outputs by every number of the case, from differences with its tolerance as step.

    A field without a tolerance is moved by 1 %, a temperature by 1 K, an integer by 1.

    `change` is what one step does to the output, `elasticity` per cent of the output for a per cent of the input;
    `kink` says that the two sides differ by more than 10 %, `curved` that half the step gives another derivative by
    more than 10 %; it is null for fields without a tolerance.
    """

    path = "/v1/sensitivity"
    summary = "What moves each output most"
    answer = "a line for each output and input, the most influential first, and one for the end"
    model = SensitivityRequest
    body: SensitivityRequest

    def _planned(self, base: BaseRequest, most: int) -> int:
        paths, case = self.body.inputs, base.checked({}).model_dump()
        inputs = _every_number(base, case) if paths is None else _named(base, case, paths)
        moved = [perturbation(leaf, value_at(case, leaf.path)) for leaf in inputs]
        self.perturbations = [each for each in moved if each.places]
        total = 1 + sum(len(each.places) for each in self.perturbations)
        check_count(total, most, "inputs")
        return total

    async def lines(self, pool: Pool, clock: Clock) -> Lines:
        """A line for each output and input, the most influential input of an output first; then the end.

        The first point is the case itself.
        """
        moved: list[Overrides] = [{each.leaf.path: place} for each in self.perturbations for place in each.places]
        overrides, points = [{}, *moved], list[Point]()
        async for _, found in runner.in_order(pool, self.question, overrides.__getitem__, range(self.total), clock):
            points += found
        yield [line for column in range(len(self.outputs)) for line in self._ranked(column, points)]
        base = points[0]
        end = self.header(
            inputs=[{**output_header(each.leaf), "value": each.value} for each in self.perturbations],
            outputs=[
                {**output_header(leaf), "value": value} for leaf, value in zip(self.outputs, base.out, strict=True)
            ],
            points=len(points),
            counts=dict(sorted(Counter(point.status for point in points).items())),
            status=base.status,
            warnings=base.warnings,
            error=base.error,
            assumptions=base.assumptions,
        )
        yield [{**end, "type": "end", "elapsed_s": clock.elapsed_s}]

    def _ranked(self, column: int, points: list[Point]) -> list[Line]:
        """The lines of one output."""
        base, *moved = (_number(point.out[column]) for point in points)
        rest = iter(moved)
        found: list[Line] = []
        for each in self.perturbations:
            outputs = {each.value: base, **{place: next(rest) for place in each.places}}
            known = differences(each, outputs)
            found.append({"type": "sensitivity", "output": self.outputs[column].path, "path": each.leaf.path, **known})
        return sorted(found, key=lambda line: -abs(line["change"] or 0.0))


def _number(value: Any) -> float | None:
    return float(value) if isinstance(value, int | float) and not isinstance(value, bool) else None


def _every_number(base: BaseRequest, case: dict[str, Any]) -> list[Leaf]:
    """Every number that the case has, assumed ones included, options of model and resolution not."""
    return [
        replace(leaf, path=path, dimensions=0)
        for leaf in leaves(base.calculation.request)
        if leaf.dimensions < 2 and leaf.kind in NUMBERS and not leaf.advanced
        for path in indexed(leaf.path if leaf.is_scalar else f"{leaf.path}.{ITEM}", case)
        if value_at(case, path) is not None
    ]


def _named(base: BaseRequest, case: dict[str, Any], paths: list[str]) -> list[Leaf]:
    """The numbers at these paths; raises Unprocessable."""
    check_distinct(paths, "inputs", numbered=True)
    model = base.calculation.request
    named = [scalar_at(model, path, f"inputs.{place}", "unknown_path") for place, path in enumerate(paths)]
    for place, leaf in enumerate(named):
        message = not_a_number(leaf)
        if message is not None:
            raise Unprocessable("not_scalar", f"{message}; use a sweep to compare its values", f"inputs.{place}")
        if value_at(case, leaf.path) is None:
            raise Unprocessable("not_scalar", f"{leaf.path} has no number in this case", f"inputs.{place}")
    return named


class SensitivityPage(StudyPage):
    """Which inputs change an output most."""

    link = StudyLink(
        "influence", "What matters", "every input moved by its tolerance: which moves the result most", place=2
    )
    question = "which input matters?"
    about = "Every number of the case is moved by its usual tolerance, else by 1 % (1 K, 1)."
    figures = ("influence",)
    plan = Sensitivity

    def body(self) -> dict[str, Any]:
        """The request of the case, and the output that is shown."""
        outputs = [self.output.path]
        return {"endpoint": self.calculation.path, "request": self.asked.body, "outputs": outputs}

    def result(self, lines: list[Line]) -> Result:
        """The change of the output by one step of each input, largest first, as a bar chart and a table."""
        end, output = lines[-1], self.output
        inputs = {each["path"]: each for each in end["inputs"]}
        steps, rows = list[Influence](), []
        for line in lines:
            if line["type"] == "sensitivity" and line["change"] is not None:
                path, known = line["path"], inputs[line["path"]]
                name, unit = numbered(known["title"], path), known["unit"] or ""
                step = f"+{shown(line['step'], 3)} {difference_unit(unit)}".rstrip()
                varied = {"x": path, "show": output.path, "theme": self.asked.theme}
                row = (
                    Link(name, link(f"{self.asked.path}/{VARY}", self.asked.pairs, **varied)),
                    shown(float(known["value"])),
                    unit,
                    step,
                    shown(line["change"], 4),
                    shown(line["elasticity"], 3),
                    "up and down differ" if line["kink"] else "half a step differs" if line["curved"] else "",
                )
                steps.append(Influence(name, step, line["change"], bool(line["kink"])))
                rows.append(row)
        value, figures, remarks = end["outputs"][0]["value"], dict[str, Figure](), []
        if not isinstance(value, int | float):
            remarks.append(f"The case has no {output.title}, so nothing moves it.")
        elif (figure := influence(axis_of(output), float(value), steps)).panels:
            figures["influence"] = figure
        else:
            remarks.append(f"No input moves the {output.title} of this case.")
        if GIVEN_BULK in {each["reason"] for each in end["assumptions"]}:
            remarks.append(f"Oil temperature: {GIVEN_BULK}.")
        changes = f"changes the {output.title} by{f', {difference_unit(output.unit)}' if output.unit else ''}"
        head = ("input", Number("value"), "unit", Number("one step"), Number(changes), Number("% for 1 %"), "remark")
        more = len(rows) - MOST_ROWS
        note = "A name leads to the curve over that input."
        note += f" {more} inputs more change it less." if more > 0 else ""
        table = Table("Inputs, the most influential first", head, rows[:MOST_ROWS], note)
        progress = f"{end['points']} cases in {shown(end['elapsed_s'], 2)} s"
        return Result(progress, figures, (table,) if rows else (), tuple(remarks))


PAGE = SensitivityPage
