"""The flank that is safest where it is worst: a search over corrections, judged at every corner of what is unknown."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from scipy.optimize import Bounds, minimize

from solvers.arrays import FloatArray
from solvers.drive_train.inputs import DriveTrainInputs
from solvers.drive_train.studies.corners import MOST_RUNS, Range, combinations
from solvers.drive_train.studies.outcome import outcome
from solvers.drive_train.studies.variation import value_at, varied
from solvers.errors import InvalidInput, NoSolution

Objective = Literal["safety", "max_pressure", "face_load_factor"]
EVALUATIONS = 60
FIRST_STEP = 0.15  # of a variable's range
LAST_STEP = 2e-3
LEAST_GAIN = 1e-3  # of the start's figure, that another search must bring
HOPELESS = 10.0  # of the start's figure; stands for a unit without solution


@dataclass(frozen=True, slots=True)
class Variable:
    """An input at a dotted name, or several that move together, that the search may choose between two values."""

    names: tuple[str, ...]
    low: float
    high: float


@dataclass(frozen=True, slots=True)
class Trial:
    """Values of the variables and the worst corner's figure; None where a corner has no solution."""

    values: tuple[float, ...]
    objective: float | None


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

    Starts from the inputs' own values, within their ranges. Raises InvalidInput (variable_range, too_many_corners,
    safety_undefined, unknown_name and what `outcome` raises) and NoSolution design where the start has none.
    """
    cases = _cases(inputs, corners, collective, objective)
    low, high = (np.array([getattr(variable, end) for variable in variables]) for end in ("low", "high"))
    if not variables or not np.all(low < high):
        raise InvalidInput("variable_range", "every variable needs a range from low to high", "variables")
    own = np.array([float(value_at(inputs, variable.names[0]) or 0.0) for variable in variables])
    sign = -1.0 if objective == "safety" else 1.0
    history: list[Trial] = []
    worst: list[dict[str, Any]] = []

    def judge(unit: FloatArray) -> float | None:
        values = low + unit * (high - low)
        figure, corner = _worst(inputs, variables, values, cases, objective)
        history.append(Trial(tuple(values.tolist()), None if figure is None else sign * figure))
        worst.append(corner)
        if progress is not None:
            progress(len(history), evaluations)
        return figure

    search(judge, (own - low) / (high - low), evaluations)
    best = min(
        (place for place, trial in enumerate(history) if trial.objective is not None),
        key=lambda place: sign * (history[place].objective or 0.0),
    )
    return Design(
        start=history[0].values,
        best=history[best].values,
        objective_start=_known(history[0]),
        objective_best=_known(history[best]),
        worst_corner=worst[best],
        evaluations=len(history),
        history=tuple(history),
    )


def _known(trial: Trial) -> float:
    assert trial.objective is not None
    return trial.objective


def search(judge: Callable[[FloatArray], float | None], start: FloatArray, evaluations: int) -> None:
    """Make the judge's figure small over the unit cube; None is a place without solution.

    By COBYQA, which takes no derivatives. Its models may get stuck on a ridge where two corners are equally bad, so it
    begins anew at the best place while that gains anything. Raises NoSolution design where the start has none.
    """
    known: list[tuple[float, FloatArray]] = []
    scale = 0.0

    def relative(unit: FloatArray) -> float:
        nonlocal scale
        unit = np.clip(unit, 0.0, 1.0)
        figure = judge(unit)
        if not known and figure is None:
            raise NoSolution("design", "the unit the search starts from has no solution at some corner")
        scale = scale or abs(figure or 0.0) or 1.0
        known.append((HOPELESS if figure is None else figure / scale, unit))
        return known[-1][0]

    place, before = np.clip(start, 0.0, 1.0), np.inf
    while len(known) < evaluations:
        minimize(
            relative,
            place,
            method="COBYQA",
            bounds=Bounds(np.zeros(start.size), np.ones(start.size)),
            options={
                "maxfev": evaluations - len(known),
                "initial_tr_radius": FIRST_STEP,
                "final_tr_radius": LAST_STEP,
            },
        )
        figure, place = min(known, key=lambda trial: trial[0])
        if before - figure < LEAST_GAIN:
            return
        before = figure


def _cases(
    inputs: DriveTrainInputs, corners: Sequence[Range], collective: Sequence[Mapping[str, Any]], objective: Objective
) -> list[dict[str, Any]]:
    """Every operating point at every corner."""
    limits = inputs.mesh.temperatures
    if objective == "safety" and limits.scuffing is None and limits.scuffing_test is None:
        message = "without a scuffing temperature there is no safety to search for"
        raise InvalidInput("safety_undefined", message, "temperatures.scuffing")
    cases = [{**point, **corner} for point in collective for corner in combinations(corners)]
    if not 0 < len(cases) <= MOST_RUNS:
        raise InvalidInput("too_many_corners", f"{len(cases)} combinations; between 1 and {MOST_RUNS}", "corners")
    return cases


def _worst(
    inputs: DriveTrainInputs,
    variables: Sequence[Variable],
    values: FloatArray,
    cases: list[dict[str, Any]],
    objective: Objective,
) -> tuple[float | None, dict[str, Any]]:
    """The figure to be made small at its worst case, and that case; None at a case without solution."""
    chosen = {name: float(value) for variable, value in zip(variables, values, strict=True) for name in variable.names}
    found = []
    for case in cases:
        try:
            figure = getattr(outcome(varied(inputs, {**chosen, **case})), objective)
        except NoSolution:
            figure = None
        if figure is None:
            return None, case
        found.append(-figure if objective == "safety" else figure)
    k = int(np.argmax(found))
    return float(found[k]), cases[k]
