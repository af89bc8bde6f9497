"""Design: values of some inputs whose worst case is best, searched trial by trial."""

from collections.abc import Sequence
from contextlib import aclosing
from dataclasses import dataclass
from math import ceil, floor, inf
from typing import Any

from app.errors import Unprocessable
from app.schema.fields import Leaf
from app.schema.reading import validated
from app.studies.base_request import BaseRequest, check_count, check_distinct, check_value
from app.studies.engine import Clock, Line, Lines, Pool, Study, case_of_study, output_header, paths_of, twice_if_lost
from app.studies.fields import NUMBERS, value_at
from app.studies.minimax import next_place
from app.studies.point_sets import common_unit, grid, listed
from app.studies.requests import DesignRequest, Overrides, Variable
from solvers.drive_train.uncertainty import MOST_CORNERS

PATH = "/v1/drive-train/design"


@dataclass(frozen=True, slots=True)
class DesignVariable:
    """Fields that take one value, and the range of the search."""

    leaves: tuple[Leaf, ...]
    low: float
    high: float
    step: float | None

    def value(self, share: float) -> float:
        """The value at a share of the range."""
        return self.low + share * (self.high - self.low)

    def rounded(self, value: float) -> float:
        """The nearest multiple of the step inside the range, or the value itself where there is none."""
        if self.step is None:
            return value
        steps = min(max(round(value / self.step), ceil(self.low / self.step)), floor(self.high / self.step))
        return min(max(float(f"{steps * self.step:.12g}"), self.low), self.high)

    def header(self) -> Line:
        """The variable in the first line."""
        return {
            "path": paths_of(self.leaves),
            "unit": common_unit(self.leaves),
            "min": self.low,
            "max": self.high,
        }


@dataclass(frozen=True, slots=True)
class Trial:
    """Values of the variables, the objective at their worst case, and that case; None where a case has no solution.

    `figures` are the objectives of all cases with the sign that the search minimises.
    """

    values: Overrides
    objective: float | None
    worst: Overrides
    figures: list[float] | None = None

    def content(self) -> Line:
        """Values and objective."""
        return {"at": self.values, "objective": self.objective}


@dataclass(frozen=True, slots=True, kw_only=True)
class Design(Study):
    """A search over `variables`, each trial solved at all `cases`; its output is the objective.

    `sign` is -1 where the objective is maximised; `start` holds shares of the ranges of the variables.
    """

    variables: tuple[DesignVariable, ...]
    cases: list[Overrides]
    sign: float
    start: tuple[float, ...]
    evaluations: int

    @property
    def total(self) -> int:
        """How many points it may have."""
        return (self.evaluations + self.is_rounded) * len(self.cases)

    @property
    def is_rounded(self) -> bool:
        """Whether the best values are rounded in the end."""
        return any(variable.step is not None for variable in self.variables)

    async def lines(self, pool: Pool, clock: Clock) -> Lines:
        """The header, a line for each trial, the end."""
        yield [
            self.header(
                "design",
                variables=[variable.header() for variable in self.variables],
                objective=output_header(self.outputs[0]),
                direction="minimise" if self.sign > 0.0 else "maximise",
                corners=len(self.cases),
                evaluations=self.evaluations,
            )
        ]
        trials: list[Trial] = []
        while place := await twice_if_lost(
            pool, next_place, self.start, [trial.figures for trial in trials], self.evaluations
        ):
            values = (variable.value(share) for variable, share in zip(self.variables, place, strict=True))
            trial = await self._trial(pool, clock, list(values))
            yield [{"type": "trial", "index": len(trials), **trial.content(), "worst_corner": trial.worst}]
            trials.append(trial)
            if trials[0].figures is None:
                message = "the unit that the search starts from has no answer at its worst corner"
                yield [clock.error("no_start", message)]
                return
        best = min(trials, key=lambda trial: max(trial.figures or [inf]))
        rounded = None
        if self.is_rounded:
            values = (
                variable.rounded(float(best.values[variable.leaves[0].path] or 0.0)) for variable in self.variables
            )
            rounded = await self._trial(pool, clock, list(values))
        yield [self._end(trials, best, rounded, clock)]

    async def _trial(self, pool: Pool, clock: Clock, values: Sequence[float]) -> Trial:
        """The values of the variables, solved until a case has no solution."""
        at: Overrides = {
            leaf.path: value for variable, value in zip(self.variables, values, strict=True) for leaf in variable.leaves
        }
        objectives: list[float] = []
        runs = self.solve(pool, clock, lambda index: {**at, **self.cases[index]}, range(len(self.cases)))
        async with aclosing(runs):
            async for indices, points in runs:
                for index, point in zip(indices, points, strict=True):
                    (objective,) = point.out
                    if objective is None:
                        return Trial(at, None, self.cases[index])
                    objectives.append(objective)
        figures = [self.sign * objective for objective in objectives]
        worst = figures.index(max(figures))
        return Trial(at, objectives[worst], self.cases[worst], figures)

    def _end(self, trials: list[Trial], best: Trial, rounded: Trial | None, clock: Clock) -> Line:
        return {
            "type": "end",
            "start": trials[0].values,
            "best": best.values,
            "objective_start": trials[0].objective,
            "objective_best": best.objective,
            "worst_corner": best.worst,
            "evaluations": len(trials),
            **({"rounded": {**rounded.content(), "worst_corner": rounded.worst}} if rounded else {}),
            "unsolved": sum(trial.objective is None for trial in trials),
            "history": [trial.content() for trial in trials],
            "elapsed_s": clock.elapsed_s,
        }


def design_study(content: Any, most: int, deadline_s: float) -> Design:
    """The search in a body, of at most `most` points; runs in a worker.

    `content` is the body as JSON's objects, or validated. Raises InvalidBody and Unprocessable, with locations in it.
    """
    request = validated(DesignRequest, content)
    base = BaseRequest.of(request)
    objective = base.output(request.objective, "objective")
    if objective.kind not in NUMBERS:
        raise Unprocessable("unknown_output", f"{request.objective} is no number", "objective")
    variables = tuple(_variable(each, base, f"variables.{place}") for place, each in enumerate(request.variables))
    cases = _cases(request, base)
    case = base.checked(cases[0]).model_dump()
    study = Design(
        question=base.question([objective.path], deadline_s, reduced=True),
        outputs=(objective,),
        case=case_of_study(PATH, request),
        variables=variables,
        cases=cases,
        sign=_sign(request, objective),
        start=tuple(_share(variable, case) for variable in variables),
        evaluations=request.evaluations,
    )
    check_count(study.total, most, "evaluations")
    return study


def _variable(variable: Variable, base: BaseRequest, place: str) -> DesignVariable:
    leaves = tuple(base.leaf(path, f"{place}.path") for path in variable.paths)
    for leaf in leaves:
        if leaf.kind != "number":
            raise Unprocessable("not_continuous", f"{leaf.path} is not a continuous number", f"{place}.path")
        for name, end in {"min": variable.min, "max": variable.max}.items():
            check_value(leaf, end, f"{place}.{name}")
    if not variable.min < variable.max:
        raise Unprocessable("variable_range", "a variable needs a range from min to max", place)
    if variable.step is not None and floor(variable.max / variable.step) < ceil(variable.min / variable.step):
        raise Unprocessable("variable_step", "no multiple of the step lies between min and max", f"{place}.step")
    return DesignVariable(leaves, variable.min, variable.max, variable.step)


def _cases(request: DesignRequest, base: BaseRequest) -> list[Overrides]:
    """Every operating point at every corner."""
    corners: list[Overrides] = [{}]
    if request.corners is not None:
        combined = grid(request.corners, base, MOST_CORNERS, "corners")
        corners = [combined.overrides(index) for index in range(combined.total)]
    points = [{}] if request.collective is None else request.collective
    listed(points, base, MOST_CORNERS, "collective")
    check_count(len(points) * len(corners), MOST_CORNERS, "corners")
    known = [path for variable in request.variables for path in variable.paths]
    for place, paths in (
        ("variables", []),
        ("corners", corners[0]),
        ("collective", {path for p in points for path in p}),
    ):
        known += paths
        check_distinct(known, place)
    return [{**point, **corner} for point in points for corner in corners]


def _sign(request: DesignRequest, objective: Leaf) -> float:
    """Factor with which the objective is minimised."""
    if request.direction is not None:
        return -1.0 if request.direction == "maximise" else 1.0
    if objective.view.bound is None:
        message = f"{objective.path} has no safe side of its own; say maximise or minimise"
        raise Unprocessable("direction_missing", message, "direction")
    return -1.0 if objective.view.greatest_is_best else 1.0


def _share(variable: DesignVariable, case: dict[str, Any]) -> float:
    """The case's own value as a share of the range; 0 where it has none."""
    own = value_at(case, variable.leaves[0].path)
    return 0.0 if own is None else min(max((own - variable.low) / (variable.high - variable.low), 0.0), 1.0)
