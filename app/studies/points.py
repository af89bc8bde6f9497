"""Solves points of a study in a worker process; each point is the endpoint's own answer to its request."""

import copy
import logging
import time
from collections.abc import Sequence
from typing import Any, Literal, NamedTuple

from app.calculations import BY_PATH, Calculation
from app.errors import PROBLEMS, InvalidBody, Unprocessable, faults_of
from app.evaluate import evaluate, refuse_endless
from app.schema.reading import validated
from app.studies.fields import clear, excluded_by, set_value, value_at
from app.studies.requests import Overrides
from solvers.notices import Rank

Status = Literal["ok", "ok_with_warnings", "no_solution", "refused", "failed"]
SOLVED = ("ok", "ok_with_warnings")  # the status of a point that has an answer
CHUNK_SECONDS = 0.25  # of work handed out at once: a study gives way within it

logger = logging.getLogger("tribodrive")


class Point(NamedTuple):
    """One answer, cut down to the outputs asked for; `error` where the point was refused or failed.

    `warnings` are codes, the gravest first, `ranks` their ranks.
    `assumptions` are left out where they are those of the point before it in its chunk.
    """

    status: Status
    out: list[Any]
    warnings: list[str]
    error: dict[str, str] | None = None
    assumptions: tuple[dict[str, Any], ...] = ()
    ranks: tuple[Rank, ...] = ()


class Question(NamedTuple):
    """What is the same at every point."""

    endpoint: str
    base: dict[str, Any]
    outputs: Sequence[str]
    deadline_s: float

    def failed(self, code: str, message: str) -> Point:
        """A point that failed for a reason outside its request."""
        return Point("failed", self._nothing, [], {"pointer": "", "code": code, "message": message})

    def refused(self, error: InvalidBody | Unprocessable) -> Point:
        """A point whose request cannot be computed."""
        return Point("refused", self._nothing, [], faults_of(error)[0])

    @property
    def _nothing(self) -> list[Any]:
        return [None] * len(self.outputs)


class Chunk(NamedTuple):
    """Answers of the first of the points asked for, and how long they took [s]."""

    points: list[Point]
    seconds: float


def solve_chunk(question: Question, overrides: Sequence[Overrides]) -> Chunk:
    """Solve consecutive points, as many as a chunk's time allows, at least one."""
    started = time.perf_counter()
    points: list[Point] = []
    known: tuple[dict[str, Any], ...] = ()
    for each in overrides:
        point = solve_point(question, each)
        points.append(point._replace(assumptions=()) if point.assumptions == known else point)
        known = point.assumptions
        if time.perf_counter() - started >= CHUNK_SECONDS:
            break
    return Chunk(points, time.perf_counter() - started)


def solve_point(question: Question, overrides: Overrides) -> Point:
    """One point; a refusal is a point too."""
    calculation = BY_PATH[question.endpoint]
    try:
        request = validated(calculation.request, with_overrides(calculation, question.base, overrides))
        refuse_endless(calculation, request, question.deadline_s)
        answer = evaluate(calculation, request)
    except (InvalidBody, Unprocessable) as error:
        return question.refused(error)
    except MemoryError:
        kind = PROBLEMS[MemoryError]
        return question.failed(kind.code, kind.title)
    except Exception:
        logger.exception("a point of a study failed")
        return question.failed("internal_error", "something went wrong in the service; the log has the cause")
    return Point(
        answer.status,
        [value_at(answer, path) for path in question.outputs],
        [warning.code for warning in answer.warnings],
        assumptions=tuple(dict(each) for each in answer.assumptions),
        ranks=tuple(warning.rank for warning in answer.warnings),
    )


def with_overrides(calculation: Calculation, base: dict[str, Any], overrides: Overrides) -> dict[str, Any]:
    """The base request with a point's values; a value of a field takes out those that it excludes."""
    body = copy.deepcopy(base)
    for path, value in overrides.items():
        if value is not None:
            for excluded in excluded_by(calculation.request, path):
                clear(body, excluded)
    for path, value in overrides.items():
        set_value(calculation.request, body, path, value)
    body["detail"] = "summary"
    return body
