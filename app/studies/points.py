"""The request that a study varies, and the solution of its points in worker processes.

A point changes some values of the request. Its results are those of the endpoint for the changed request.
"""

import copy
import logging
import time
from collections.abc import Sequence
from typing import Any, Literal, NamedTuple

from app.calculations import BY_PATH, Calculation
from app.errors import PROBLEMS, InvalidBody, OtherSources, Unprocessable, faults_of
from app.evaluate import evaluate, refuse_endless
from app.schema.fields import Leaf, headlines, pattern_of, value_at
from app.schema.model import Request
from app.schema.reading import validated
from app.sources import SOURCES
from app.studies.fields import clear_excluded, scalar_at, set_value
from app.studies.requests import Overrides
from solvers.errors import InvalidInput, NoSolution
from solvers.heat_balance import Cooling
from solvers.notices import Rank
from solvers.quantity import UNITS, quantities

Status = Literal["ok", "ok_with_warnings", "no_solution", "refused", "failed"]
SOLVED = ("ok", "ok_with_warnings")  # statuses of points that have an answer
COLD = "states.cold."
BAND = "heat.band."

LEAST_FLOW, MOST_FLOW = (quantities(Cooling)["gear_flow"].bounds[end] for end in ("ge", "le"))

logger = logging.getLogger("tribodrive")


class Point(NamedTuple):
    """The answer at a point, reduced to the requested outputs."""

    status: Status
    out: list[Any]  # values of the requested outputs
    warnings: list[str]  # codes, the gravest warning first
    error: dict[str, str] | None = None  # if the point was refused or failed
    assumptions: tuple[dict[str, Any], ...] = ()
    ranks: tuple[Rank, ...] = ()  # of the warnings, in the same order


class Question(NamedTuple):
    """The parts of a study that are the same at all points."""

    endpoint: str
    base: dict[str, Any]
    outputs: Sequence[str]
    deadline_s: float
    gear_flow: float | None = None  # l/min, sized once for the base request; every point runs with the same oil pump
    sources: str = SOURCES  # of the process that asks; every line of the study states this hash

    def refuse_other_sources(self) -> None:
        """Raise OtherSources in a process with other solvers; asked with every call, as workers join during a study."""
        if self.sources != SOURCES:
            raise OtherSources(
                f"a worker has other solvers (hash {SOURCES}) than the asking process (hash {self.sources}); update it"
            )

    def failed(self, code: str, message: str) -> Point:
        """Return a point with status `failed`: the request is not to blame."""
        return Point("failed", [None] * len(self.outputs), [], {"pointer": "", "code": code, "message": message})


class BaseRequest(NamedTuple):
    """An endpoint, and the request to it that a study varies.

    `place` is where the body of the study gives a path; Unprocessable names it if the path cannot be used.
    """

    calculation: Calculation
    body: dict[str, Any]

    def leaf(self, path: str, place: str) -> Leaf:
        """Return the `Leaf` of the single value at a path of the request; a list may be too short for the path."""
        leaf = scalar_at(self.calculation.request, path, place, "unknown_path")
        try:
            set_value(self.calculation.request, copy.deepcopy(self.body), path, None)
        except IndexError:
            message = f"{path} does not exist, because the list in the request is too short"
            raise Unprocessable("unknown_path", message, place) from None
        return leaf

    def output(self, path: str, place: str) -> Leaf:
        """Return the `Leaf` of the single value at a path of the answer."""
        leaf = scalar_at(self.calculation.response, path, place, "unknown_output")
        if leaf.detail != "summary":
            raise Unprocessable(
                "not_scalar",
                f"{path} is part of a curve or of a map, but a study gives single values only; choose another output",
                place,
            )
        return leaf

    def outputs(self, wanted: list[str] | None) -> tuple[Leaf, ...]:
        """Return a `Leaf` for each output at the paths `wanted`, or for each headline number if `wanted` is None."""
        if wanted is None:
            return headlines(self.calculation.response)
        check_distinct(wanted, "outputs", numbered=True)
        return tuple(self.output(path, f"outputs.{number}") for number, path in enumerate(wanted))

    def checked(self, first: Overrides) -> Request:
        """Return the validated request of the first point, which changes the values `first`.

        The faults of InvalidBody point into the body of the study.
        """
        try:
            return validated(self.calculation.request, with_overrides(self.calculation, self.body, first))
        except InvalidBody as error:
            faults = [fault._replace(pointer=f"/request{fault.pointer}") for fault in error.faults]
            raise InvalidBody(faults) from None

    def described(self) -> Request | None:
        """Return the validated request without changes; None if it lacks a field that the study varies."""
        try:
            return self.checked({})
        except InvalidBody:
            return None


def check_count(count: int, most: int, place: str) -> None:
    """Raise Unprocessable if a study has more than `most` points."""
    if count > most:
        raise Unprocessable("too_many_points", f"the study has {count} points; the limit is {most}", place)


def check_distinct(paths: Sequence[str], place: str, *, numbered: bool = False) -> None:
    """Raise Unprocessable at `place` if a path is given twice; `numbered` adds the index of the second occurrence."""
    for number, path in enumerate(paths):
        if path in paths[:number]:
            raise Unprocessable("duplicate_path", f"{path} is given twice", f"{place}.{number}" if numbered else place)


def needs_film(endpoint: str, output: str) -> bool:
    """Return True if an output needs the thermal film, which takes longer than all the rest of the answer."""
    of_the_film = BY_PATH[endpoint].words.of_the_film or ()
    return "thermal_ehl" in output or pattern_of(output.removeprefix(COLD)) in of_the_film


def reduced_request(endpoint: str, request: dict[str, Any], outputs: Sequence[str]) -> dict[str, Any]:
    """Return a request without what no output needs: thermal film, cold state of the unit, band of the heat balance."""
    if BY_PATH[endpoint].words.of_the_film is None:
        return request
    reduced = copy.deepcopy(request)
    if not any(path.startswith(BAND) for path in outputs):
        set_value(BY_PATH[endpoint].request, reduced, "cooling.band", False)
    if not any(needs_film(endpoint, path) for path in outputs):
        set_value(BY_PATH[endpoint].request, reduced, "model.lubrication", "closed_form")
    if not any(path.startswith(COLD) for path in outputs):
        reduced.pop("states", None)
    return reduced


def with_overrides(calculation: Calculation, base: dict[str, Any], overrides: Overrides) -> dict[str, Any]:
    """Return a copy of the base request with the values of a point, without the fields that these values exclude."""
    body = copy.deepcopy(base)
    for path, value in overrides.items():
        if value is not None:
            clear_excluded(calculation.request, body, path)
    for path, value in overrides.items():
        set_value(calculation.request, body, path, value)
    body["detail"] = "summary"
    return body


def sized_flow(question: Question, first: Overrides) -> float | None:
    """Return the oil flow [l/min] that the calculation sizes for the base request of a study; None if it sizes none.

    If the base request leaves out a field that the study varies, the request of the first point is taken.
    """
    question.refuse_other_sources()
    calculation = BY_PATH[question.endpoint]
    if calculation.pump is None:
        return None
    for overrides in ({}, first):
        try:
            request = validated(calculation.request, with_overrides(calculation, question.base, overrides))
            flow = calculation.pump.sized(request.inputs())
        except InvalidBody:
            continue
        except (InvalidInput, NoSolution):  # each point says so itself
            return None
        return None if flow is None else min(max(flow / UNITS["l_per_min"].scale, LEAST_FLOW), MOST_FLOW)
    return None


def _with_flow(question: Question, calculation: Calculation, overrides: Overrides, request: Request) -> Request:
    """Return the request with the flow of the study's oil pump, unless the point varies the flow or has no balance."""
    pump, flow = calculation.pump, question.gear_flow
    if pump is None or flow is None or not request.is_balanced or not {pump.flow, pump.rise}.isdisjoint(overrides):
        return request
    return validated(calculation.request, with_overrides(calculation, question.base, {**overrides, pump.flow: flow}))


class Chunk(NamedTuple):
    """The answers at the first few of the requested points, and their computing time [s]; None if they were kept."""

    points: list[Point]
    seconds: float | None


def solve_chunk(question: Question, overrides: Sequence[Overrides], seconds: float) -> Chunk:
    """Solve points in order until `seconds` have passed. Solve at least one point, and leave out the rest."""
    question.refuse_other_sources()
    started = time.perf_counter()
    points: list[Point] = []
    preceding: tuple[dict[str, Any], ...] = ()
    for values in overrides:
        point = solve_point(question, values)
        if point.assumptions == preceding:
            point = point._replace(assumptions=preceding)  # one object for all, which is pickled once
        points.append(point)
        preceding = point.assumptions
        if time.perf_counter() - started >= seconds:
            break
    return Chunk(points, time.perf_counter() - started)


def solve_point(question: Question, overrides: Overrides) -> Point:
    """Solve one point. Never raises: status `refused` for a bad request, `failed` for a fault of the service."""
    calculation = BY_PATH[question.endpoint]
    try:
        request = validated(calculation.request, with_overrides(calculation, question.base, overrides))
        refuse_endless(calculation, request, question.deadline_s)
        with_flow = _with_flow(question, calculation, overrides, request)
        answer = evaluate(calculation, with_flow)
    except (InvalidBody, Unprocessable) as error:
        return Point("refused", [None] * len(question.outputs), [], faults_of(error)[0])
    except MemoryError:
        kind = PROBLEMS[MemoryError]
        return question.failed(kind.code, kind.title)
    except Exception:
        logger.exception("a point of a study failed")
        return question.failed("internal_error", "something went wrong in the service; the log has the cause")
    assumptions = [*map(dict, answer.assumptions)]
    if calculation.pump and with_flow is not request:
        reason = "sized once, for the base request: one oil pump for all points"
        assumptions.append({"field": calculation.pump.flow, "value": question.gear_flow, "reason": reason})
    ranks: dict[str, Rank] = {}  # a code counts once at a point, also if it holds for both gears
    for warning in answer.warnings:
        ranks.setdefault(warning.code, warning.rank)
    return Point(
        answer.status,
        [value_at(answer, path) for path in question.outputs],
        [*ranks],
        assumptions=tuple(assumptions),
        ranks=tuple(ranks.values()),
    )
