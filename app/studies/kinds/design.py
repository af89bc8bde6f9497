"""Design: the correction of a gear unit whose worst corner is best, or that is least likely to be damaged.

Where machines are drawn, the price of the flanks' tolerance follows: how probable damage is by quality class.
"""

from collections.abc import Sequence
from contextlib import aclosing
from math import ceil, floor, inf, log
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field
from scipy.optimize import NonlinearConstraint, minimize

from app.errors import Unprocessable
from app.schema.fields import Leaf, value_at
from app.schema.quantities import Input
from app.studies import runner
from app.studies.fields import NUMBERS, check_value, not_a_number
from app.studies.machines import MachineDraws
from app.studies.point_sets import common_unit, grid, listed
from app.studies.points import SOLVED, BaseRequest, check_count, check_distinct
from app.studies.price import PROBABILITY, Pricing
from app.studies.requests import (
    RANGES,
    Cases,
    DriveTrainStudy,
    FieldPath,
    FieldPaths,
    FieldsTogether,
    Overrides,
    Ranges,
)
from app.studies.runner import Clock, Line, Lines, Pool, Study, output_header, paths_of
from solvers.arrays import FloatArray
from solvers.drive_train.uncertainty import MOST_CORNERS
from solvers.errors import NoSolution

FIRST_STEP = 0.15  # trust radius at the start of the search, as a share of the range of a variable
SECOND_HELIX = ".second_helix."  # fields without a value have that of the first helix, whose path lacks this part
LAST_STEP = 2e-3  # trust radius at the end of the search, as a share of the range of a variable; chosen
LEAST_GAIN = 1e-3  # the search ends if a restart gains less than this share of the objective at the start
VALUE_SCALE = 0.2  # the unit of the scaled objectives, as a share of the objective at the start
PENALTY = 5.0  # scaled objective of a point without solution, minus the scaled objective of the worst point so far
LEAST_CHANCE = 1e-30  # the search takes the logarithm of a probability, which is at least this
MOST_STEPS = 100  # largest number of COBYQA steps per evaluation; a step that only moves the level is no evaluation


class Variable(FieldsTogether):
    """A variable of the search: a field, or several fields with the same value, and the range of this value."""

    path: Annotated[FieldPaths, Input("field to choose", text="dotted path, or several fields of one value")]
    min: Annotated[float, Input("lower end")]
    max: Annotated[float, Input("upper end")]
    step: Annotated[
        float | None,
        Input("step", text="step of manufacture; the best value is rounded to it and judged again", gt=0, le=1e6),
    ] = None


class DesignRequest(DriveTrainStudy):
    """A gear unit, the variables of its flank correction, and the cases in which a correction is judged."""

    variables: Annotated[list[Variable], Field(min_length=1, max_length=10), Input("variables")]
    corners: Annotated[Ranges, Input("corners", text=RANGES, default_text="the request's own")] = None
    collective: Annotated[
        Cases,
        Input(
            "collective",
            text="operating points, each with the inputs that it changes",
            default_text="the request's own",
        ),
    ] = None
    objective: Annotated[
        FieldPath, Input("objective", text="dotted path of the output to improve at its worst corner")
    ] = "safety.minimum"
    direction: Annotated[
        Literal["maximise", "minimise"] | None,
        Input("direction", text="whether the objective shall be large or small", default_text="towards its safe side"),
    ] = None
    evaluations: Annotated[
        int, Input("evaluations", text="how many corrections may be tried at every corner", ge=1, le=1000)
    ] = 60
    judged_by: Annotated[
        Literal["worst_corner", "probability"],
        Input("judged by", text="the objective at its worst corner, or the probability of damage over drawn machines"),
    ] = "worst_corner"
    tolerances: Annotated[
        MachineDraws | None,
        Input(
            "tolerances",
            text="draws machines, and states the probability of damage by quality class",
            default_text="no machines are drawn, unless the correction is judged by them",
        ),
    ] = None


class Design(Study):
    """A search for the best correction of a gear unit. The search starts from the correction in the request.

    The objective of a correction is the value of the chosen output at the worst combination of operating point and
    corner. The output `safety.minimum` needs the thermal film, which takes one second per corner. If the output is
    `safety.blok_flank`, or if `model.lubrication` is `closed_form`, the search is twenty times as fast.

    With `tolerances`, machines are drawn for the correction that was found: what is uncertain of the unit, what the
    models do not know, and the slopes of the flanks by each quality class, with the same draws for every class. A line
    `price` per class states the probability of scuffing or micropitting (the more probable), and `price` in the last
    line the coarsest class that costs less than a tenth more than exact flanks, what dominates, and the probability
    with nominal values, of the unit as described and with exact flanks. With `evaluations` 1 the correction of the
    request itself is priced. `judged_by` `probability` seeks the correction that is least likely to be damaged at the
    quality class of the gears (5 without one); `objective` and `corners` then have no effect.

    If a variable has a `step`, the last line of the answer has the member `rounded`. This member holds the best
    correction, rounded to whole steps, and the objective of the rounded correction.
    """

    path = "/v1/drive-train/design"
    summary = "The correction of a gear unit that is best at its worst corner, and how exactly to grind it"
    answer = "a line for the search, one for each correction tried, and one for the end"
    model = DesignRequest
    body: DesignRequest

    def _outputs(self, base: BaseRequest) -> tuple[Leaf, ...]:
        """Return the output that is the objective. The study has no other outputs."""
        objective = base.output(self.body.objective, "objective")
        if objective.kind not in NUMBERS:
            raise Unprocessable(
                "unknown_output", f"{objective.path} is not a number; choose another objective", "objective"
            )
        return (objective,)

    def _planned(self, base: BaseRequest, most: int) -> int:
        body, (objective,) = self.body, self.outputs
        self.units = [_unit(variable, base, f"variables.{place}") for place, variable in enumerate(body.variables)]
        self.cases = _cases(body, base)
        case = base.checked(self.cases[0]).model_dump()
        self.pricing = self._priced(base, body.collective or list[Overrides]([{}]))
        if body.direction is None and objective.view.bound is None and not self.by_probability:
            message = (
                f"for {objective.path} it is not known whether large or small values are better; set direction to "
                "maximise or minimise"
            )
            raise Unprocessable("direction_missing", message, "direction")
        self.direction = body.direction or ("maximise" if objective.view.greatest_is_best else "minimise")
        if self.by_probability:
            self.direction = "minimise"
        self.start = [_share(variable, case) for variable in body.variables]  # start of the search in the unit cube
        self.is_rounded = any(variable.step is not None for variable in body.variables)
        total = (body.evaluations + self.is_rounded) * self.points_per_trial
        if self.pricing is not None:
            check_count(self.pricing.points, most, "tolerances.count")  # fewer corrections would not help
            total += self.pricing.points
        check_count(total, most, "evaluations")
        return total

    @property
    def by_probability(self) -> bool:
        """Whether corrections are judged by the probability of damage."""
        return self.body.judged_by == "probability"

    @property
    def points_per_trial(self) -> int:
        """The number of points at which a correction is judged."""
        by_machines = self.pricing is not None and self.by_probability
        return self.pricing.points_per_trial if by_machines and self.pricing else len(self.cases)

    def _priced(self, base: BaseRequest, load_cases: list[Overrides]) -> Pricing | None:
        """Return the machines that judge corrections; None if none are drawn."""
        given = self.body.tolerances or (MachineDraws() if self.by_probability else None)
        elsewhere = {path for variable in self.body.variables for path in variable.paths}
        elsewhere |= {path for case in load_cases for path in case}
        return None if given is None else Pricing(base, given, load_cases, elsewhere, self.question)

    async def lines(self, pool: Pool, clock: Clock) -> Lines:
        """Yield the header, a line for each correction tried, and the line `end`."""
        variables = zip(self.body.variables, self.units, strict=True)
        yield [
            self.header(
                variables=[
                    {"path": variable.paths, "unit": unit, "min": variable.min, "max": variable.max}
                    for variable, unit in variables
                ],
                objective=PROBABILITY if self.by_probability else output_header(self.outputs[0]),
                direction=self.direction,
                corners=self.points_per_trial,
                evaluations=self.body.evaluations,
                **({} if self.pricing is None else {"quality_class": self.pricing.machines.reference}),
            )
        ]
        trials: list[Line] = []
        objectives: list[list[float] | None] = []
        place: list[float] | None = self.start
        await self._size_flow(pool, {**self._at(self._values(self.start)), **self.cases[0]})
        while place is not None:
            values = self._values(place)
            trial, signed = await self._trial(pool, clock, values)
            yield [{"type": "trial", "index": len(trials), **trial, "elapsed_s": clock.elapsed_s}]
            trials.append(trial)
            objectives.append(signed)
            if objectives[0] is None:
                lacking = "solution" if self.unsolved else f"value of {self.outputs[0].path}"
                hint = "" if self.unsolved else "; choose another output"
                message = (
                    f"the search cannot start, because the gear unit as described has no {lacking} at one of the "
                    f"corners{hint}"
                )
                yield [clock.error("no_start", message)]
                return
            place = await runner.twice_if_lost(pool, next_place, self.start, objectives, self.body.evaluations)
        best, _ = min(zip(trials, objectives, strict=True), key=lambda pair: max(pair[1] or [inf]))
        rounded: Line = {}
        if self.is_rounded:
            values = [_rounded(variable, best["at"][variable.paths[0]]) for variable in self.body.variables]
            rounded["rounded"], _ = await self._trial(pool, clock, values)
        priced: Line = {}
        if self.pricing is not None:
            wanted = rounded.get("rounded", best)
            at = (best if wanted["objective"] is None else wanted)["at"]
            async for line in self.pricing.lines(pool, clock, at, self.question.gear_flow):
                if "quality_class" in line:
                    yield [{"type": "price", **line, "elapsed_s": clock.elapsed_s}]
                else:
                    priced["price"] = line
        yield [
            {
                "type": "end",
                "start": trials[0]["at"],
                "best": best["at"],
                "objective_start": trials[0]["objective"],
                "objective_best": best["objective"],
                "worst_corner": best["worst_corner"],
                "evaluations": len(trials),
                **rounded,
                **priced,
                "unsolved": objectives.count(None),
                "history": [{"at": trial["at"], "objective": trial["objective"]} for trial in trials],
                "elapsed_s": clock.elapsed_s,
            }
        ]

    def _values(self, place: list[float]) -> list[float]:
        """Return the values of the variables at a place, which holds a share of every range."""
        shares = zip(self.body.variables, place, strict=True)
        return [variable.min + share * (variable.max - variable.min) for variable, share in shares]

    def _at(self, values: list[float]) -> Overrides:
        """Return the fields that take the values of the variables."""
        pairs = zip(self.body.variables, values, strict=True)
        return {path: value for variable, value in pairs for path in variable.paths}

    async def _trial(self, pool: Pool, clock: Clock, values: list[float]) -> tuple[Line, list[float] | None]:
        """Evaluate a correction in all cases. Return a summary of the trial and the objectives of all cases.

        The summary states the values of the variables, the objective in the worst case, and the worst case itself. If
        the objective is to be maximised, the signs of the returned objectives are reversed, so that a smaller number
        is always better.

        If a case has no solution, the remaining cases are not evaluated. The summary then states this case as the
        worst case, with None as its objective. None is also returned instead of the objectives.
        """
        at = self._at(values)
        if self.by_probability and self.pricing is not None:
            trial, chance = await self.pricing.trial(pool, clock, at, self.question.gear_flow)
            self.unsolved = chance is None
            return trial, None if chance is None else [log(max(chance, LEAST_CHANCE))]
        objectives: list[float] = []
        indices = range(len(self.cases))
        runs = runner.in_order(pool, self.question, lambda index: {**at, **self.cases[index]}, indices, clock)
        async with aclosing(runs):
            async for chunk, points in runs:
                for index, point in zip(chunk, points, strict=True):
                    (objective,) = point.out
                    if objective is None:
                        self.unsolved = point.status not in SOLVED
                        return {"at": at, "objective": None, "worst_corner": self.cases[index]}, None
                    objectives.append(objective)
        sign = 1.0 if self.direction == "minimise" else -1.0
        signed = [sign * objective for objective in objectives]
        worst = signed.index(max(signed))
        return {"at": at, "objective": objectives[worst], "worst_corner": self.cases[worst]}, signed


def _unit(variable: Variable, base: BaseRequest, place: str) -> str | None:
    """Check a variable, and return the common unit of its fields, or None if the units differ.

    Raises Unprocessable if a field does not accept the range of the variable, if the range is empty, or if no multiple
    of the step lies in the range.
    """
    leaves = [base.leaf(path, f"{place}.path") for path in variable.paths]
    for leaf in leaves:
        if leaf.kind != "number":
            message = (
                not_a_number(leaf)
                or f"{leaf.path} accepts only whole numbers, but the search needs a field that accepts all numbers"
            )
            raise Unprocessable("not_continuous", message, f"{place}.path")
        for name, end in {"min": variable.min, "max": variable.max}.items():
            check_value(leaf, end, f"{place}.{name}")
    if not variable.min < variable.max:
        raise Unprocessable("variable_range", "the value of min must be below the value of max", place)
    if variable.step is not None and floor(variable.max / variable.step) < ceil(variable.min / variable.step):
        raise Unprocessable(
            "variable_step",
            "no multiple of the step lies between min and max; choose a smaller step or a wider range",
            f"{place}.step",
        )
    return common_unit(leaves)


def _cases(request: DesignRequest, base: BaseRequest) -> list[Overrides]:
    """Return the cases, which are all combinations of an operating point and a corner.

    A case holds the values that replace values of the request.
    """
    corners: list[Overrides] = [{}]
    if request.corners is not None:
        combined = grid(request.corners, base, MOST_CORNERS, "corners")
        corners = [combined.overrides(index) for index in range(combined.total)]
    points = [{}] if request.collective is None else request.collective
    set_by_points = paths_of(listed(points, base, MOST_CORNERS, "collective").varied)
    check_count(len(points) * len(corners), MOST_CORNERS, "corners")
    changed = [path for variable in request.variables for path in variable.paths]
    for place, paths in {"variables": [], "corners": list(corners[0]), "collective": set_by_points}.items():
        changed += paths
        check_distinct(changed, place)
    return [{**point, **corner} for point in points for corner in corners]


def _share(variable: Variable, case: dict[str, Any]) -> float:
    """Return where the value of an input lies in the range of a variable, from 0 (lower end) to 1 (upper end).

    `case` holds the values of the inputs. If the input has no value, return 0.
    """
    path = variable.paths[0]
    own = value_at(case, path)
    if own is None and SECOND_HELIX in path:
        own = value_at(case, path.replace(SECOND_HELIX, "."))
    return 0.0 if own is None else min(max((own - variable.min) / (variable.max - variable.min), 0.0), 1.0)


def _rounded(variable: Variable, value: float) -> float:
    """Round a value to the nearest multiple of the variable's step that lies inside the range of the variable.

    If the variable has no step, return the value itself.
    """
    step, low, high = variable.step, variable.min, variable.max
    if step is None:
        return value
    steps = min(max(round(value / step), ceil(low / step)), floor(high / step))
    return min(max(float(f"{steps * step:.12g}"), low), high)


class _Unknown(Exception):
    """Exception that stops the search if the objectives at a new point are needed. The argument is the new point."""


def next_place(start: Sequence[float], told: Sequence[list[float] | None], most: int) -> list[float] | None:
    """Return the point of the unit cube that the search evaluates next, or None if the search has ended.

    The search minimises the largest of the objectives, with at most `most` evaluations. `told` holds the objectives at
    all points evaluated so far, in the order of evaluation. An item of `told` is None if the point has no solution.
    Each call repeats the search from the beginning with the objectives in `told`, and stops at the first new point.
    The repetition takes some milliseconds per point. In return, no thread has to wait while objectives are computed.

    The method is COBYQA. It minimises an additional variable, the level, under the constraint that no objective
    exceeds the level. The method is restarted at the best point as long as a restart improves the result. Raises
    NoSolution with the code `design` if the starting point has no solution.
    """
    if len(told) == most:
        return None
    if (first := told[0]) is None:
        raise NoSolution("design", "the search cannot start, because the starting point has no solution")
    scale = VALUE_SCALE * abs(max(first)) or 1.0
    evaluated = {_name(np.array(start)): np.array(first) / scale}

    def scaled(place: FloatArray) -> FloatArray:
        """Return the scaled objectives at a point.

        `place` holds the coordinates of the point and, as its last item, the level. The level is not used here.
        """
        name = _name(place[:-1])
        if name not in evaluated:
            if len(evaluated) == len(told):
                raise _Unknown(np.clip(place[:-1], 0.0, 1.0).tolist())
            objectives = told[len(evaluated)]
            worst = max(float(others.max()) for others in evaluated.values())
            evaluated[name] = (
                np.full(len(first), worst + PENALTY) if objectives is None else np.array(objectives) / scale
            )
        return evaluated[name]

    def level(place: FloatArray) -> float:
        scaled(place)
        return float(place[-1])

    bounds = [*[(0.0, 1.0)] * len(start), (-np.inf, np.inf)]
    below = NonlinearConstraint(lambda place: scaled(place) - place[-1], -np.inf, 0.0)
    options: Any = {"maxfev": MOST_STEPS * most, "initial_tr_radius": FIRST_STEP, "final_tr_radius": LAST_STEP}
    before = np.inf
    while True:
        best = min(evaluated, key=lambda place: float(evaluated[place].max()))
        lowest = float(evaluated[best].max())
        if before - lowest < LEAST_GAIN / VALUE_SCALE:
            return None
        before = lowest
        x0 = np.append(np.frombuffer(best), lowest)
        try:
            minimize(level, x0, method="COBYQA", bounds=bounds, constraints=[below], options=options)
        except _Unknown as unknown:
            return list(unknown.args[0])


def _name(place: FloatArray) -> bytes:
    """Return a key for a point of the unit cube. Points that differ only by rounding errors have the same key."""
    return np.clip(place, 0.0, 1.0).round(12).tobytes()
