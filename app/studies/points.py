"""The request that a study varies, and the solution of its points; each point is the endpoint's own answer.

Points are solved in worker processes.
"""

import copy
import logging
import time
from collections.abc import Sequence
from typing import Any, Literal, NamedTuple

from app.calculations import BY_PATH, Calculation
from app.errors import PROBLEMS, InvalidBody, Unprocessable, faults_of
from app.evaluate import evaluate, refuse_endless
from app.schema.fields import Leaf, headlines
from app.schema.model import Request
from app.schema.reading import validated
from app.studies.fields import clear_excluded, scalar_at, set_value, value_at
from app.studies.requests import DRIVE_TRAIN, Overrides
from solvers.notices import Rank

Status = Literal["ok", "ok_with_warnings", "no_solution", "refused", "failed"]
SOLVED = ("ok", "ok_with_warnings")  # the status of a point that has an answer
CHUNK_SECONDS = 0.25  # of work handed out at once: a study gives way within it
COLD = "states.cold."
BY_FILM = {
    DRIVE_TRAIN: {"safety.minimum"},
    "/v1/scuffing": {"film.min_at_psi", "film.thickness_ratio", "unsolved_points"},
}
"""The outputs of an endpoint that need the thermal film, beside those named after it."""

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
        return Point("failed", [None] * len(self.outputs), [], {"pointer": "", "code": code, "message": message})


class BaseRequest(NamedTuple):
    """An endpoint and the request to it; the methods raise Unprocessable at `place` of the study."""

    calculation: Calculation
    body: dict[str, Any]

    def leaf(self, path: str, place: str) -> Leaf:
        """The single value at a path of the request, where it can be set: the lists on the way are long enough."""
        leaf = scalar_at(self.calculation.request, path, place, "unknown_path")
        try:
            set_value(self.calculation.request, copy.deepcopy(self.body), path, None)
        except IndexError:
            message = f"the request has no {path}, because the list in the request is shorter"
            raise Unprocessable("unknown_path", message, place) from None
        return leaf

    def output(self, path: str, place: str) -> Leaf:
        """The single value at a path of the answer."""
        leaf = scalar_at(self.calculation.response, path, place, "unknown_output")
        if leaf.detail != "summary":
            raise Unprocessable(
                "not_scalar", f"{path} belongs to a curve or field; a study gives single values only", place
            )
        return leaf

    def outputs(self, wanted: list[str] | None) -> tuple[Leaf, ...]:
        """The outputs at these paths, by default the headline numbers."""
        if wanted is None:
            return headlines(self.calculation.response)
        check_distinct(wanted, "outputs", numbered=True)
        return tuple(self.output(path, f"outputs.{number}") for number, path in enumerate(wanted))

    def checked(self, first: Overrides) -> Request:
        """The request with the first point inserted; raises InvalidBody with pointers into the study.

        A request that the schema allows and the solver refuses is a refused point.
        """
        try:
            return validated(self.calculation.request, with_overrides(self.calculation, self.body, first))
        except InvalidBody as error:
            found = [each._replace(pointer=f"/request{each.pointer}") for each in error.faults]
            raise InvalidBody(found) from None


def check_count(count: int, most: int, place: str) -> None:
    """Refuse a study of too many points."""
    if count > most:
        raise Unprocessable("too_many_points", f"the study has {count} points; the limit is {most}", place)


def check_distinct(paths: Sequence[str], place: str, *, numbered: bool = False) -> None:
    """Refuse a path that is given twice, where `numbered` at its own place in the list."""
    for number, path in enumerate(paths):
        if path in paths[:number]:
            raise Unprocessable("duplicate_path", f"{path} is given twice", f"{place}.{number}" if numbered else place)


def needs_film(endpoint: str, output: str) -> bool:
    """Whether an output needs the thermal film, which costs more than everything else."""
    return "thermal_ehl" in output or output.removeprefix(COLD) in BY_FILM[endpoint]


def reduced_request(endpoint: str, request: dict[str, Any], outputs: Sequence[str]) -> dict[str, Any]:
    """The request without the thermal film and without other states if no output needs them; outputs are unchanged."""
    if endpoint not in BY_FILM:
        return request
    reduced = copy.deepcopy(request)
    if not any(needs_film(endpoint, path) for path in outputs):
        set_value(BY_PATH[endpoint].request, reduced, "model.lubrication", "closed_form")
    if not any(path.startswith(COLD) for path in outputs):
        reduced.pop("states", None)
    return reduced


def with_overrides(calculation: Calculation, base: dict[str, Any], overrides: Overrides) -> dict[str, Any]:
    """The base request with a point's values; a value of a field takes out those that it excludes."""
    body = copy.deepcopy(base)
    for path, value in overrides.items():
        if value is not None:
            clear_excluded(calculation.request, body, path)
    for path, value in overrides.items():
        set_value(calculation.request, body, path, value)
    body["detail"] = "summary"
    return body


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
        return Point("refused", [None] * len(question.outputs), [], faults_of(error)[0])
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
