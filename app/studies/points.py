"""Points of a study, solved one after another in a worker process: each is the endpoint's own answer."""

import copy
import time
from collections.abc import Sequence
from typing import Any, Literal, NamedTuple

from pydantic import ValidationError

from app.calculations import CALCULATIONS, Calculation
from app.contract.fields import leaf_at
from app.evaluate import evaluate
from app.problems import Unprocessable, field_errors
from app.studies.fields import clear, read, write
from app.studies.requests import Overrides

BY_PATH = {calculation.path: calculation for calculation in CALCULATIONS}

Status = Literal["ok", "ok_with_warnings", "no_solution", "refused", "failed"]


class Point(NamedTuple):
    """One answer, cut down to the outputs asked for; `error` where the point was refused."""

    status: Status
    out: list[Any]
    warnings: list[str]
    error: dict[str, str] | None
    assumptions: list[dict[str, Any]] | None


class Chunk(NamedTuple):
    """Answers of consecutive points and how long they took [s]."""

    points: list[Point]
    seconds: float


def solve_chunk(
    endpoint: str, base: dict[str, Any], overrides: Sequence[Overrides], outputs: Sequence[str]
) -> Chunk:
    """Solve consecutive points of an endpoint."""
    started = time.perf_counter()
    calculation = BY_PATH[endpoint]
    points = [solve_point(calculation, with_overrides(calculation, base, each), outputs) for each in overrides]
    return Chunk(points, time.perf_counter() - started)


def solve_point(calculation: Calculation, body: dict[str, Any], outputs: Sequence[str]) -> Point:
    """One point; a refusal is a point too."""
    nothing = [None] * len(outputs)
    try:
        answer = evaluate(calculation, calculation.request.model_validate(body))
    except ValidationError as error:
        return Point("refused", nothing, [], field_errors(error)[0], None)
    except Unprocessable as error:
        return Point("refused", nothing, [], error.field_error(), None)
    values = [read(answer, path) for path in outputs]
    codes = [warning.code for warning in answer.warnings]
    return Point(answer.status, values, codes, None, [each.model_dump() for each in answer.assumptions])


def with_overrides(calculation: Calculation, base: dict[str, Any], overrides: Overrides) -> dict[str, Any]:
    """The base request with a point's values; an override on an exclusive field clears its fellows."""
    body = copy.deepcopy(base)
    for path, value in overrides.items():
        leaf = leaf_at(calculation.request, path)
        for fellow in leaf.exclusive if leaf and value is not None else ():
            clear(body, fellow)
        write(body, path, value)
    body["detail"] = "summary"
    return body
