"""The flank that is safest where it is worst: a search over corrections, judged at every corner of what is unknown."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any, Literal

import numpy as np
from scipy.optimize import Bounds, minimize

from solvers.arrays import FloatArray
from solvers.drive_train.corners import MOST_RUNS, Range
from solvers.drive_train.inputs import DriveTrainInputs
from solvers.drive_train.outcome import outcome
from solvers.drive_train.variation import value_at, varied
from solvers.errors import InvalidInput, NoSolution

Objective = Literal["safety", "max_pressure", "face_load_factor"]
EVALUATIONS = 60
FIRST_STEP = 0.15  # of a variable's range
LAST_STEP = 2e-3
HOPELESS = 1e3  # stands for a unit without solution, worse than any other


@dataclass(frozen=True, slots=True)
class Variable:
    """An input at a dotted name, or several that move together, that the search may choose between two values."""

    names: tuple[str, ...]
    low: float
    high: float


@dataclass(frozen=True, slots=True)
class Trial:
    """Values of the variables and the worst corner's figure."""

    values: tuple[float, ...]
    objective: float


@dataclass(frozen=True, slots=True)
class Design:
    """Start and best of a search, the corner that decides, and every trial; objectives are the figure itself."""

    start: tuple[float, ...]
    best: tuple[float, ...]
    objective_start: float
    objective_best: float
    worst_corner: dict[str, Any]
    evaluations: int
    history: tuple[Trial, ...]


def design(
    inputs: DriveTrainInputs,
    variables: Sequence[Variable],
    corners: Sequence[Range] = (),
    *,
    collective: Sequence[Mapping[str, Any]] = ({},),
    objective: Objective = "safety",
    evaluations: int = EVALUATIONS,
    progress: Callable[[int, int], None] | None = None,
) -> Design:
    """Best worst case over collective x corners: the largest least safety, or the least largest of other figures.

    Starts from the inputs' own values (within their ranges), searched by COBYQA, which takes no derivatives and copes
    with the kinks of a maximum. Raises InvalidInput (variable_range, too_many_corners, safety_undefined, unknown_name
    and what `outcome` raises) and NoSolution design where the start has none.
    """
    cases = _cases(inputs, corners, collective, objective)
    low, high = (np.array([getattr(variable, end) for variable in variables]) for end in ("low", "high"))
    if not variables or not np.all(low < high):
        raise InvalidInput("variable_range", "every variable needs a range from low to high", "variables")
    own = np.array([float(value_at(inputs, variable.names[0]) or 0.0) for variable in variables])
    sign = -1.0 if objective == "safety" else 1.0
    history: list[Trial] = []
    worst: list[dict[str, Any]] = []
    gaps: dict[int, FloatArray] = {}

    def judge(unit: FloatArray) -> float:
        values = low + np.clip(unit, 0.0, 1.0) * (high - low)
        figure, corner = _worst(inputs, variables, values, cases, objective, gaps)
        history.append(Trial(tuple(values.tolist()), sign * figure))
        worst.append(corner)
        if progress is not None:
            progress(len(history), evaluations)
        return figure

    start = np.clip((own - low) / (high - low), 0.0, 1.0)
    minimize(
        judge,
        start,
        method="COBYQA",
        bounds=Bounds(np.zeros(start.size), np.ones(start.size)),
        options={"maxfev": evaluations, "initial_tr_radius": FIRST_STEP, "final_tr_radius": LAST_STEP},
    )
    best = min(range(len(history)), key=lambda i: sign * history[i].objective)
    if sign * history[0].objective >= HOPELESS:
        raise NoSolution("design", "the unit the search starts from has no solution at some corner")
    return Design(
        start=history[0].values,
        best=history[best].values,
        objective_start=history[0].objective,
        objective_best=history[best].objective,
        worst_corner=worst[best],
        evaluations=len(history),
        history=tuple(history),
    )


def _cases(
    inputs: DriveTrainInputs, corners: Sequence[Range], collective: Sequence[Mapping[str, Any]], objective: Objective
) -> list[dict[str, Any]]:
    """Every operating point at every corner."""
    if objective == "safety" and inputs.mesh.temperatures.scuffing is None:
        message = "without a scuffing temperature there is no safety to search for"
        raise InvalidInput("safety_undefined", message, "temperatures.scuffing")
    combinations = [
        {one.name: value for one, value in zip(corners, values, strict=True)}
        for values in product(*(one.values for one in corners))
    ]
    cases = [{**point, **corner} for point in collective for corner in combinations]
    if not 0 < len(cases) <= MOST_RUNS:
        raise InvalidInput("too_many_corners", f"{len(cases)} combinations; between 1 and {MOST_RUNS}", "corners")
    return cases


def _worst(
    inputs: DriveTrainInputs,
    variables: Sequence[Variable],
    values: FloatArray,
    cases: list[dict[str, Any]],
    objective: Objective,
    gaps: dict[int, FloatArray],
) -> tuple[float, dict[str, Any]]:
    """The figure to be made small at its worst case, and that case; `gaps` start every case from its last answer."""
    chosen = {name: float(value) for variable, value in zip(variables, values, strict=True) for name in variable.names}
    found = []
    for k, case in enumerate(cases):
        try:
            answer = outcome(varied(inputs, {**chosen, **case}), gaps.get(k))
        except NoSolution:
            return HOPELESS, case
        gaps[k] = answer.gap
        figure = getattr(answer, objective)
        found.append(HOPELESS if figure is None else (-figure if objective == "safety" else figure))
    k = int(np.argmax(found))
    return float(found[k]), cases[k]
