"""Design of a gear unit's flank: a search that is judged by the worst of all corners, trial by trial."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.schema.base import MODEL_VERSION
from app.schema.fields import Leaf
from app.sources import SOURCES
from app.studies.engine import Pool, Work, in_order, twice_if_lost
from app.studies.points import Question
from app.studies.requests import Overrides
from app.studies.stream import Clock, Line, Lines
from solvers.arrays import FloatArray
from solvers.drive_train.studies.design import search


@dataclass(frozen=True, slots=True)
class Choice:
    """What the search may choose: fields that take one value, and its range."""

    leaves: tuple[Leaf, ...]
    low: float
    high: float

    def value(self, share: float) -> float:
        """The value at a share of the range."""
        return self.low + share * (self.high - self.low)

    def header(self) -> Line:
        """What the first line says of it."""
        units = {leaf.unit for leaf in self.leaves}
        return {
            "path": [leaf.path for leaf in self.leaves],
            "unit": units.pop() if len(units) == 1 else None,
            "min": self.low,
            "max": self.high,
        }


@dataclass(frozen=True, slots=True)
class Trial:
    """A correction, its objective at its worst case, and that case; None where a case has no answer.

    `figures` are what the search makes small: the objective at every case, with a sign.
    """

    correction: Overrides
    objective: float | None
    worst: Overrides
    figures: list[float] | None = None

    def line(self, index: int) -> Line:
        """The line of the trial."""
        return {"type": "trial", "index": index, **self.content(), "worst_corner": self.worst}

    def content(self) -> Line:
        """The trial in short."""
        return {"at": self.correction, "objective": self.objective}


@dataclass(frozen=True, slots=True)
class Design:
    """A search that has passed its checks; `start` in shares of the choices' ranges, `sign` -1 where large is good."""

    question: Question
    choices: tuple[Choice, ...]
    cases: list[Overrides]
    objective: Leaf
    sign: float
    start: tuple[float, ...]
    evaluations: int
    case: str

    @property
    def total(self) -> int:
        """How many points it may have."""
        return self.evaluations * len(self.cases)

    async def lines(self, pool: Pool, clock: Clock) -> Lines:
        """All lines but those of progress: the variables, a line a trial, the end."""
        yield [self._header()]
        trials: list[Trial] = []
        figures: list[list[float] | None] = []
        while shares := await twice_if_lost(pool, next_trial, self.start, figures, self.evaluations):
            trial = await self._judged(pool, clock, shares)
            trials.append(trial)
            figures.append(trial.figures)
            yield [trial.line(len(trials) - 1)]
            if figures[0] is None:
                message = "the unit that the search starts from has no answer at its worst corner"
                yield [clock.error("no_start", message)]
                return
        yield [self._end(trials, clock)]

    async def _judged(self, pool: Pool, clock: Clock, shares: Sequence[float]) -> Trial:
        """The correction at its worst case, the first one of equals; a case without answer is worse than all."""
        correction = self._correction(shares)
        objectives: list[float] = []
        done = clock.done
        work = Work(self.question, lambda index: {**correction, **self.cases[index]}, len(self.cases))
        async for indices, points in in_order(pool, work):
            clock.done = done + indices.stop
            for index, point in zip(indices, points, strict=True):
                (objective,) = point.out
                if objective is None:
                    return Trial(correction, None, self.cases[index])
                objectives.append(objective)
        figures = [self.sign * objective for objective in objectives]
        worst = max(range(len(figures)), key=lambda k: figures[k])
        return Trial(correction, objectives[worst], self.cases[worst], figures)

    def _correction(self, shares: Sequence[float]) -> Overrides:
        return {
            leaf.path: choice.value(share)
            for choice, share in zip(self.choices, shares, strict=True)
            for leaf in choice.leaves
        }

    def _header(self) -> Line:
        return {
            "type": "design",
            "endpoint": self.question.endpoint,
            "variables": [choice.header() for choice in self.choices],
            "objective": {"path": self.objective.path, "unit": self.objective.unit, "title": self.objective.title},
            "direction": "minimise" if self.sign > 0.0 else "maximise",
            "corners": len(self.cases),
            "evaluations": self.evaluations,
            "model_version": MODEL_VERSION,
            "sources": SOURCES,
            "case": self.case,
        }

    def _end(self, trials: list[Trial], clock: Clock) -> Line:
        solved = [trial for trial in trials if trial.objective is not None]
        best = min(solved, key=lambda trial: self.sign * (trial.objective or 0.0))
        return {
            "type": "end",
            "start": trials[0].correction,
            "best": best.correction,
            "objective_start": trials[0].objective,
            "objective_best": best.objective,
            "worst_corner": best.worst,
            "evaluations": len(trials),
            "unsolved": len(trials) - len(solved),
            "history": [trial.content() for trial in trials],
            "elapsed_s": clock.elapsed_s,
        }


def next_trial(start: Sequence[float], figures: Sequence[list[float] | None], most: int) -> list[float] | None:
    """Where the search looks next, in shares of the ranges, or None at its end; runs in a worker.

    The search itself is run again up to there: it takes some milliseconds a trial, and needs no thread that waits.
    """
    told = iter(figures)

    def judge(shares: FloatArray) -> FloatArray | None:
        for found in told:
            return None if found is None else np.array(found)
        raise _Asked(shares.tolist())

    try:
        search(judge, np.array(start), most)
    except _Asked as asked:
        return asked.shares
    return None


class _Asked(Exception):
    """The search wants to know the figure at a place."""

    def __init__(self, shares: list[float]) -> None:
        super().__init__(shares)
        self.shares = shares
