"""Minimax: the point of the unit cube where the largest of several objectives is smallest."""

from collections.abc import Callable, Sequence

import numpy as np
from scipy.optimize import Bounds, NonlinearConstraint, minimize

from solvers.arrays import FloatArray
from solvers.errors import NoSolution

FIRST_STEP = 0.15  # of a variable's range
LAST_STEP = 2e-3  # of a variable's range, chosen
LEAST_GAIN = 1e-3  # of the objective at the start; a restart that gained less is the last
VALUE_SCALE = 0.2  # of the objective at the start: a change that counts as much as a variable's whole range
PENALTY = 5.0  # scaled, above the worst known objective: that of a point without solution
MOST_STEPS = 100  # of COBYQA for each evaluation; steps that change the level alone need no evaluation

Objectives = Callable[[FloatArray], FloatArray | None]
"""The objectives at a point; None where there is no solution."""


def next_place(start: Sequence[float], known_objectives: Sequence[list[float] | None], most: int) -> list[float] | None:
    """The next point that the search evaluates after those known, or None at its end; runs in a worker.

    The search is repeated up to there, which takes some milliseconds a point and needs no thread that waits.
    """
    known = iter(known_objectives)

    def objectives(place: FloatArray) -> FloatArray | None:
        for found in known:
            return None if found is None else np.array(found)
        raise _Unknown(place.tolist())

    try:
        search(objectives, np.array(start), most)
    except _Unknown as unknown:
        return unknown.place
    return None


class _Unknown(Exception):
    """The search needs the objectives at a point."""

    def __init__(self, place: list[float]) -> None:
        super().__init__(place)
        self.place = place


def search(objectives: Objectives, start: FloatArray, evaluations: int) -> None:
    """Minimise the largest objective over the unit cube with at most so many evaluations.

    COBYQA, which needs no derivatives, minimises a level under the constraints that no objective exceeds it: each
    objective has a smooth model of its own, also along a ridge where two are equally large. It is restarted at the best
    point as long as that gains anything. Raises NoSolution design where the start has no solution.
    """
    known: dict[bytes, FloatArray] = {}
    first = objectives(np.clip(start, 0.0, 1.0))
    if first is None:
        raise NoSolution("design", "the point where the search starts has no solution")
    scale = VALUE_SCALE * abs(float(first.max())) or 1.0
    known[_name(start)] = first / scale

    def scaled(place: FloatArray) -> FloatArray:
        name = _name(place[:-1])
        if name not in known:
            if len(known) == evaluations:
                raise _NoEvaluationLeft
            found = objectives(np.clip(place[:-1], 0.0, 1.0))
            worst = max(float(each.max()) for each in known.values())
            known[name] = np.full(first.size, worst + PENALTY) if found is None else found / scale
        return known[name]

    before = np.inf
    while (best := min(known, key=lambda unit: float(known[unit].max()))) and (
        before - (level := float(known[best].max())) >= LEAST_GAIN / VALUE_SCALE
    ):
        before = level
        try:
            _descend(scaled, np.append(np.frombuffer(best), level), evaluations)
        except _NoEvaluationLeft:
            return


def _name(place: FloatArray) -> bytes:
    """A place in the unit cube, the same for those that only rounding tells apart."""
    return np.clip(place, 0.0, 1.0).round(12).tobytes()


class _NoEvaluationLeft(Exception):
    """All evaluations are used."""


def _descend(scaled: Callable[[FloatArray], FloatArray], start: FloatArray, evaluations: int) -> None:
    """One run of COBYQA; the last component of `start` is the level, those before are the place."""
    free = np.full(start.size - 1, 1.0)

    def level(place: FloatArray) -> float:
        scaled(place)
        return float(place[-1])

    minimize(
        level,
        start,
        method="COBYQA",
        bounds=Bounds(np.append(0.0 * free, -np.inf), np.append(free, np.inf)),
        constraints=[NonlinearConstraint(lambda place: scaled(place) - place[-1], -np.inf, 0.0)],
        options={
            "maxfev": MOST_STEPS * evaluations,
            "initial_tr_radius": FIRST_STEP,
            "final_tr_radius": LAST_STEP,
        },
    )
