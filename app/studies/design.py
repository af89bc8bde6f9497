"""Design: values of some inputs whose worst case is best, searched trial by trial."""

from collections.abc import Sequence
from contextlib import aclosing
from math import ceil, floor, inf
from typing import Any

import numpy as np
from scipy.optimize import NonlinearConstraint, minimize

from app.errors import Unprocessable
from app.schema.fields import Leaf
from app.studies import engine
from app.studies.engine import Clock, Line, Lines, Pool, Study, output_header, paths_of
from app.studies.fields import NUMBERS, check_value, not_a_number, value_at
from app.studies.point_sets import common_unit, grid, listed
from app.studies.points import BaseRequest, check_count, check_distinct
from app.studies.requests import DesignRequest, Overrides, Variable
from solvers.arrays import FloatArray
from solvers.drive_train.uncertainty import MOST_CORNERS
from solvers.errors import NoSolution

FIRST_STEP = 0.15  # of a variable's range
LAST_STEP = 2e-3  # of a variable's range, chosen
LEAST_GAIN = 1e-3  # of the objective at the start; a restart that gained less is the last
VALUE_SCALE = 0.2  # of the objective at the start: a change that counts as much as a variable's whole range
PENALTY = 5.0  # scaled, above the worst known objective: that of a point without solution
MOST_STEPS = 100  # of COBYQA for each evaluation; steps that change the level alone need no evaluation


class Design(Study):
    """A search with COBYQA that starts from the request's own correction.

    The objective of a correction is its value at the worst operating point and corner. `safety.minimum` needs the
    thermal film, a second a corner; with `safety.blok_flank`, or `model.lubrication` in closed form, the search is
    twenty times as fast. Where variables have a `step`, `rounded` in the last line is the best correction in whole
    steps, calculated like the others.
    """

    path = "/v1/drive-train/design"
    summary = "The correction of a gear unit that is best at its worst corner"
    answer = "a line for the search, one for each correction tried, and one for the end"
    model = DesignRequest
    body: DesignRequest

    def _outputs(self, base: BaseRequest) -> tuple[Leaf, ...]:
        """The objective."""
        objective = base.output(self.body.objective, "objective")
        if objective.kind not in NUMBERS:
            raise Unprocessable("unknown_output", f"{objective.path} is no number", "objective")
        return (objective,)

    def _planned(self, base: BaseRequest, most: int) -> int:
        body, (objective,) = self.body, self.outputs
        self.units = [_unit(each, base, f"variables.{place}") for place, each in enumerate(body.variables)]
        self.cases = _cases(body, base)
        case = base.checked(self.cases[0]).model_dump()
        if body.direction is None and objective.view.bound is None:
            message = f"{objective.path} has no safe side of its own; say maximise or minimise"
            raise Unprocessable("direction_missing", message, "direction")
        self.direction = body.direction or ("maximise" if objective.view.greatest_is_best else "minimise")
        self.start = [_share(variable, case) for variable in body.variables]  # of the ranges
        self.is_rounded = any(variable.step is not None for variable in body.variables)
        total = (body.evaluations + self.is_rounded) * len(self.cases)
        check_count(total, most, "evaluations")
        return total

    async def lines(self, pool: Pool, clock: Clock) -> Lines:
        """The header, a line for each trial, the end."""
        variables = zip(self.body.variables, self.units, strict=True)
        yield [
            self.header(
                variables=[{"path": of.paths, "unit": unit, "min": of.min, "max": of.max} for of, unit in variables],
                objective=output_header(self.outputs[0]),
                direction=self.direction,
                corners=len(self.cases),
                evaluations=self.body.evaluations,
            )
        ]
        trials: list[Line] = []
        figures: list[list[float] | None] = []
        place: list[float] | None = self.start
        while place is not None:
            shares = zip(self.body.variables, place, strict=True)
            values = [each.min + share * (each.max - each.min) for each, share in shares]
            trial, found = await self._trial(pool, clock, values)
            yield [{"type": "trial", "index": len(trials), **trial}]
            trials.append(trial)
            figures.append(found)
            if figures[0] is None:
                message = "the unit that the search starts from has no answer at its worst corner"
                yield [clock.error("no_start", message)]
                return
            place = await engine.twice_if_lost(pool, next_place, self.start, figures, self.body.evaluations)
        best, _ = min(zip(trials, figures, strict=True), key=lambda each: max(each[1] or [inf]))
        rounded: Line = {}
        if self.is_rounded:
            values = [_rounded(each, best["at"][each.paths[0]]) for each in self.body.variables]
            rounded["rounded"], _ = await self._trial(pool, clock, values)
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
                "unsolved": figures.count(None),
                "history": [{"at": each["at"], "objective": each["objective"]} for each in trials],
                "elapsed_s": clock.elapsed_s,
            }
        ]

    async def _trial(self, pool: Pool, clock: Clock, values: list[float]) -> tuple[Line, list[float] | None]:
        """The values of the variables, the objective at their worst case, and that case; null without a solution.

        Behind them the objectives of all cases with the sign that the search minimises; None where the first case
        without solution ended the trial.
        """
        pairs = zip(self.body.variables, values, strict=True)
        at: Overrides = {path: value for variable, value in pairs for path in variable.paths}
        objectives: list[float] = []
        indices = range(len(self.cases))
        runs = engine.in_order(pool, self.question, lambda index: {**at, **self.cases[index]}, indices, clock)
        async with aclosing(runs):
            async for solved, points in runs:
                for index, point in zip(solved, points, strict=True):
                    (objective,) = point.out
                    if objective is None:
                        return {"at": at, "objective": None, "worst_corner": self.cases[index]}, None
                    objectives.append(objective)
        sign = 1.0 if self.direction == "minimise" else -1.0
        figures = [sign * objective for objective in objectives]
        worst = figures.index(max(figures))
        return {"at": at, "objective": objectives[worst], "worst_corner": self.cases[worst]}, figures


def _unit(variable: Variable, base: BaseRequest, place: str) -> str | None:
    """The common unit of the fields of a variable, whose range they take."""
    leaves = [base.leaf(path, f"{place}.path") for path in variable.paths]
    for leaf in leaves:
        if leaf.kind != "number":
            message = not_a_number(leaf) or f"{leaf.path} takes whole numbers; the search needs a continuous one"
            raise Unprocessable("not_continuous", message, f"{place}.path")
        for name, end in {"min": variable.min, "max": variable.max}.items():
            check_value(leaf, end, f"{place}.{name}")
    if not variable.min < variable.max:
        raise Unprocessable("variable_range", "a variable needs a range from min to max", place)
    if variable.step is not None and floor(variable.max / variable.step) < ceil(variable.min / variable.step):
        raise Unprocessable("variable_step", "no multiple of the step lies between min and max", f"{place}.step")
    return common_unit(leaves)


def _cases(request: DesignRequest, base: BaseRequest) -> list[Overrides]:
    """Every operating point at every corner."""
    corners: list[Overrides] = [{}]
    if request.corners is not None:
        combined = grid(request.corners, base, MOST_CORNERS, "corners")
        corners = [combined.overrides(index) for index in range(combined.total)]
    points = [{}] if request.collective is None else request.collective
    set_by_points = paths_of(listed(points, base, MOST_CORNERS, "collective").varied)
    check_count(len(points) * len(corners), MOST_CORNERS, "corners")
    known = [path for variable in request.variables for path in variable.paths]
    for place, paths in {"variables": [], "corners": list(corners[0]), "collective": set_by_points}.items():
        known += paths
        check_distinct(known, place)
    return [{**point, **corner} for point in points for corner in corners]


def _share(variable: Variable, case: dict[str, Any]) -> float:
    """The case's own value as a share of the range; 0 where it has none."""
    own = value_at(case, variable.paths[0])
    return 0.0 if own is None else min(max((own - variable.min) / (variable.max - variable.min), 0.0), 1.0)


def _rounded(variable: Variable, value: float) -> float:
    """The nearest multiple of the variable's step inside its range, or the value itself where there is no step."""
    step, low, high = variable.step, variable.min, variable.max
    if step is None:
        return value
    steps = min(max(round(value / step), ceil(low / step)), floor(high / step))
    return min(max(float(f"{steps * step:.12g}"), low), high)


class _Unknown(Exception):
    """The search needs the objectives at a point, the argument."""


def next_place(start: Sequence[float], told: Sequence[list[float] | None], most: int) -> list[float] | None:
    """The point of the unit cube that the search evaluates next, or None at its end; runs in a worker.

    The search minimises the largest objective with at most so many evaluations. `told` are the objectives at the points
    before, from the start on, None where there is no solution: the search is repeated up to there, which takes some
    milliseconds a point and needs no thread that waits.
    COBYQA, which needs no derivatives, minimises a level under the constraints that no objective exceeds it: each
    objective has a smooth model of its own, also along a ridge where two are equally large. It is restarted at the best
    point as long as that gains anything. Raises NoSolution design where the start has no solution.
    """
    if len(told) == most:
        return None
    if (first := told[0]) is None:
        raise NoSolution("design", "the point where the search starts has no solution")
    scale = VALUE_SCALE * abs(max(first)) or 1.0
    known = {_name(np.array(start)): np.array(first) / scale}

    def scaled(place: FloatArray) -> FloatArray:
        """The objectives at a place, whose last component is the level."""
        name = _name(place[:-1])
        if name not in known:
            if len(known) == len(told):
                raise _Unknown(np.clip(place[:-1], 0.0, 1.0).tolist())
            found = told[len(known)]
            worst = max(float(each.max()) for each in known.values())
            known[name] = np.full(len(first), worst + PENALTY) if found is None else np.array(found) / scale
        return known[name]

    def level(place: FloatArray) -> float:
        scaled(place)
        return float(place[-1])

    bounds = [*[(0.0, 1.0)] * len(start), (-np.inf, np.inf)]
    below = NonlinearConstraint(lambda place: scaled(place) - place[-1], -np.inf, 0.0)
    options: Any = {"maxfev": MOST_STEPS * most, "initial_tr_radius": FIRST_STEP, "final_tr_radius": LAST_STEP}
    before = np.inf
    while True:
        best = min(known, key=lambda place: float(known[place].max()))
        lowest = float(known[best].max())
        if before - lowest < LEAST_GAIN / VALUE_SCALE:
            return None
        before = lowest
        x0 = np.append(np.frombuffer(best), lowest)
        try:
            minimize(level, x0, method="COBYQA", bounds=bounds, constraints=[below], options=options)
        except _Unknown as unknown:
            return list(unknown.args[0])


def _name(place: FloatArray) -> bytes:
    """A place in the unit cube, the same for those that only rounding tells apart."""
    return np.clip(place, 0.0, 1.0).round(12).tobytes()
