"""Search for the place of the unit cube where the largest of several figures is smallest."""

from collections.abc import Callable, Sequence

import numpy as np
from scipy.optimize import Bounds, NonlinearConstraint, minimize

from solvers.arrays import FloatArray
from solvers.errors import NoSolution

FIRST_STEP = 0.15  # of a variable's range
LAST_STEP = 2e-3
LEAST_GAIN = 1e-3  # of the start's figure, that another search must bring
STEEP = 0.2  # of the start's figure, which weighs as much as a variable's range
HOPELESS = 5.0  # above the worst known; stands for a place without solution
MOST_STEPS = 100  # of the search for each evaluation; those that change the level alone cost nothing

Judge = Callable[[FloatArray], FloatArray | None]
"""The figures at a place; None where there is no solution."""


def next_place(start: Sequence[float], judged: Sequence[list[float] | None], most: int) -> list[float] | None:
    """Where the search looks after the places judged so far, or None at its end; runs in a worker.

    The search is repeated up to there, which takes some milliseconds for each place and needs no waiting thread.
    """
    known = iter(judged)

    def judge(place: FloatArray) -> FloatArray | None:
        for found in known:
            return None if found is None else np.array(found)
        raise _Unknown(place.tolist())

    try:
        search(judge, np.array(start), most)
    except _Unknown as unknown:
        return unknown.place
    return None


class _Unknown(Exception):
    """The search needs the figures at a place."""

    def __init__(self, place: list[float]) -> None:
        super().__init__(place)
        self.place = place


def search(judge: Judge, start: FloatArray, evaluations: int) -> None:
    """Minimise the largest of the judge's figures over the unit cube with at most so many evaluations.

    COBYQA, which needs no derivatives, minimises a level under the constraints that no figure exceeds it: each figure
    has a smooth model of its own, also along a ridge where two are equally large. The search is started again at the
    best place as long as that gains anything. Raises NoSolution design where the start has no solution.
    """
    known: dict[bytes, FloatArray] = {}
    first = judge(np.clip(start, 0.0, 1.0))
    if first is None:
        raise NoSolution("design", "the place where the search starts has no solution")
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
    """All evaluations are used."""


def _descend(figures: Callable[[FloatArray], FloatArray], start: FloatArray, evaluations: int) -> None:
    """One run of COBYQA; the last component of `start` is the level, those before are the place."""
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
