"""The flank that is safest where it is worst: a search over corrections, judged at every corner of what is unknown."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from scipy.optimize import Bounds, NonlinearConstraint, minimize

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
STEEP = 0.2  # of the start's figure, which weighs as much as a variable's range
HOPELESS = 5.0  # above the worst known; stands for a unit without solution
MOST_STEPS = 100  # of the search for each evaluation; those that change the level alone cost nothing


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

    def judge(unit: FloatArray) -> FloatArray | None:
        values = low + unit * (high - low)
        figures, corner = _figures(inputs, variables, values, cases, objective)
        history.append(Trial(tuple(values.tolist()), None if figures is None else sign * float(figures.max())))
        worst.append(corner)
        if progress is not None:
            progress(len(history), evaluations)
        return figures

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


def search(judge: Callable[[FloatArray], FloatArray | None], start: FloatArray, evaluations: int) -> None:
    """Make the largest of the judge's figures small over the unit cube; None is a place without solution.

    By COBYQA, which takes no derivatives, on the place and a level that no figure may exceed and that is made small:
    so every corner has a smooth model of its own, and a ridge where two are equally bad holds nothing up. It begins
    anew at the best place while that gains anything. Raises NoSolution design where the start has none.
    """
    known: dict[bytes, FloatArray] = {}
    first = judge(np.clip(start, 0.0, 1.0))
    if first is None:
        raise NoSolution("design", "the unit the search starts from has no solution at some corner")
    scale = STEEP * abs(float(first.max())) or 1.0
    known[_name(start)] = first / scale

    def figures(place: FloatArray) -> FloatArray:
        name = _name(place[:-1])
        if name not in known:
            if len(known) == evaluations:
                raise _Spent
            found = judge(np.clip(place[:-1], 0.0, 1.0))
            worst = max(float(each.max()) for each in known.values())
            known[name] = np.full(first.size, worst + HOPELESS) if found is None else found / scale
        return known[name]

    before = np.inf
    while (best := min(known, key=lambda unit: float(known[unit].max()))) and (
        before - (level := float(known[best].max())) >= LEAST_GAIN / STEEP
    ):
        before = level
        try:
            _descend(figures, np.append(np.frombuffer(best), level), evaluations)
        except _Spent:
            return


def _name(place: FloatArray) -> bytes:
    """A place in the unit cube, the same for those that only rounding tells apart."""
    return np.clip(place, 0.0, 1.0).round(12).tobytes()


class _Spent(Exception):
    """As many places have been judged as may be."""


def _descend(figures: Callable[[FloatArray], FloatArray], start: FloatArray, evaluations: int) -> None:
    """Lower the level, the last of the start's components, which no figure of the place before it may exceed."""
    free = np.full(start.size - 1, 1.0)

    def level(place: FloatArray) -> float:
        figures(place)
        return float(place[-1])

    minimize(
        level,
        start,
        method="COBYQA",
        bounds=Bounds(np.append(0.0 * free, -np.inf), np.append(free, np.inf)),
        constraints=[NonlinearConstraint(lambda place: figures(place) - place[-1], -np.inf, 0.0)],
        options={
            "maxfev": MOST_STEPS * evaluations,
            "initial_tr_radius": FIRST_STEP,
            "final_tr_radius": LAST_STEP,
        },
    )


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


def _figures(
    inputs: DriveTrainInputs,
    variables: Sequence[Variable],
    values: FloatArray,
    cases: list[dict[str, Any]],
    objective: Objective,
) -> tuple[FloatArray | None, dict[str, Any]]:
    """The figures to be made small at every case, and the worst case; None at a case without solution."""
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
    return np.array(found), cases[int(np.argmax(found))]
