"""Reads and solves a request and writes its answer, for JSON, pages, figures and studies alike."""

import json
from collections.abc import Iterator
from dataclasses import asdict
from hashlib import sha256
from operator import attrgetter
from typing import Any

from app import figures
from app.calculations import BY_PATH, Calculation
from app.errors import Fault, InvalidBody, Unprocessable, Unreadable
from app.figures.data import ThemeName
from app.figures.declaration import Declaration
from app.schema.fields import field_path
from app.schema.model import MODEL_VERSION, Request, Response, Section, from_si, members
from app.schema.reading import validated
from app.sources import SOURCES
from solvers import notices
from solvers.errors import InvalidInput, NoSolution

MOST_MEMBERS = 1000  # fields of one object, chosen: no section has nearly as many
MOST_OBJECTS = 10_000  # in a body, chosen: no study within its limits names nearly as many
_CANONICAL = json.JSONEncoder(sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False)


def content_of(body: bytes) -> Any:
    """What the JSON of a body says: no more objects than any request could need, nor more fields in one."""
    objects = 0

    def members_of(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        nonlocal objects
        objects += 1
        if objects > MOST_OBJECTS:
            raise InvalidBody([Fault("", "too_many_objects", f"the body has more than {MOST_OBJECTS} objects")])
        if len(pairs) > MOST_MEMBERS:
            raise InvalidBody([Fault("", "too_many_fields", f"an object has more than {MOST_MEMBERS} fields")])
        found = dict(pairs)
        if len(found) < len(pairs):
            raise Unreadable("A name stands twice in one object of the body")
        return found

    if not body:
        raise InvalidBody([Fault("", "missing", "the request needs a body")])
    try:
        return json.loads(body, object_pairs_hook=members_of)
    except json.JSONDecodeError as error:
        message = f"the body is no JSON: {error.msg} at position {error.pos}"
        raise InvalidBody([Fault("", "json_invalid", message)]) from None
    except (ValueError, RecursionError):  # bytes that are no text, numbers without end, brackets without end
        raise Unreadable("The body cannot be read as JSON") from None


def refuse_endless(calculation: Calculation, request: Request, deadline_s: float) -> None:
    """Raise Unprocessable for a request whose estimated time is longer than the deadline."""
    if calculation.cost is not None:
        cost = calculation.cost(request)
        if cost.seconds > deadline_s:
            raise Unprocessable(
                "cannot_finish",
                f"would take some {cost.seconds:.0f} s, but calculations end after {deadline_s:g} s; make it less",
                cost.field,
            )


def calculation_at(endpoint: str) -> Calculation:
    """The calculation of an endpoint; raises Unprocessable where there is none."""
    if endpoint not in BY_PATH:
        raise Unprocessable("unknown_endpoint", f"there are {', '.join(BY_PATH)}", "endpoint")
    return BY_PATH[endpoint]


def answer(endpoint: str, request: dict[str, Any]) -> dict[str, Any]:
    """The service's answer to a request, in process.

    Parameters
    ----------
    endpoint
        Address of the calculation: "/v1/coupling".
    request
        The body that would be posted there.

    Raises
    ------
    InvalidBody
        The body is no request; its `faults` have pointer, code and message each.
    Unprocessable
        There is no such endpoint, or the input is impossible; `code` and `message` say why, `path` is the field at
        fault.

    """
    calculation = calculation_at(endpoint)
    content: dict[str, Any] = json.loads(json_answer(calculation, validated(calculation.request, request)))
    return content


def answer_of(path: str, request: Request) -> bytes:
    """Return the answer of an endpoint to a request as JSON; runs in a worker process."""
    return json_answer(BY_PATH[path], request)


def figure_of(name: str, image_format: figures.Format, theme: ThemeName, path: str, request: Request) -> bytes:
    """Return a figure of a case; runs in a worker process."""
    declaration = next(figure for figure in BY_PATH[path].figures if figure.name == name)
    return drawn(BY_PATH[path], declaration, request, image_format, theme)


def json_answer(calculation: Calculation, request: Request) -> bytes:
    """Solve the request and write its answer as JSON; runs in a worker process. Raises what `evaluate` raises."""
    return written(evaluate(calculation, request))


def written(response: Response) -> bytes:
    """The response as JSON; fields that are not set are left out."""
    return response.model_dump_json(exclude_unset=True).encode()


def drawn(
    calculation: Calculation,
    declaration: Declaration,
    request: Request,
    image_format: figures.Format,
    theme: ThemeName,
) -> bytes:
    """Solve the request and write a figure; raises Unprocessable as `evaluate` does and where there is no figure."""
    asked = request.model_copy(update={"detail": "summary"})
    figure = declaration.figure(asked, evaluate(calculation, asked))
    return figures.written(figure, image_format, theme)


def evaluate(calculation: Calculation, request: Request) -> Response:
    """The answer to a request.

    Raises Unprocessable where the solver finds the input impossible, and a validation error (never an answer) where
    a result is not finite.
    """
    return response_to(calculation, request, solve(calculation, request))


def solve(calculation: Calculation, request: Request) -> Any:
    """The solver's result, or the NoSolution that says why there is none; raises Unprocessable as `evaluate` does."""
    try:
        return calculation.solve(request.inputs())
    except InvalidInput as error:
        path = field_path(request, error.field) if error.field else None
        raise Unprocessable(error.code, error.message, path) from error
    except NoSolution as failure:
        return failure


def response_to(calculation: Calculation, request: Request, result: Any) -> Response:
    """The answer made of a result or of a NoSolution; raises a validation error if a number is not finite."""
    content: dict[str, Any]
    if isinstance(result, NoSolution):
        warning = {"rank": "invalid", "code": result.code, "message": result.message}
        content = {"status": "no_solution", "warnings": [warning], "residuals": result.residuals}
        result = None
    else:
        warnings = [
            asdict(each) | {"field": field_path(request, each.field) if each.field else None}
            for each in sorted(result.warnings, key=lambda each: notices.RANKS.index(each.rank))
        ]
        content = from_si(calculation.response, result, request.detail)
        content |= {"status": "ok_with_warnings" if warnings else "ok", "warnings": warnings}
        if getattr(result, "status", None) == "no_solution":
            content |= {"status": "no_solution", "residuals": result.residuals}
    taken_for_granted = (
        {"field": path, "value": attrgetter(path)(request), "reason": reason}
        for path, reason in request.assumed_by_the_model().items()
    )
    inputs = request.model_dump(exclude={"detail"})
    content |= {
        "assumptions": [*_assumptions(request, content.get("derived", {})), *taken_for_granted],
        "model_version": MODEL_VERSION,
        "sources": SOURCES,
        "model": request.options(),
        "inputs": inputs,
        "case": case_of(calculation.path, inputs, SOURCES),
    }
    return calculation.response.model_validate(content).read_from(result)


def case_of(endpoint: str, inputs: dict[str, Any], sources: str) -> str:
    """SHA-256 in hex of the case's JSON: sorted keys, no blanks, shortest floats, UTF-8."""
    content = {"endpoint": endpoint, "inputs": inputs, "sources": sources}
    return sha256(_CANONICAL.encode(content).encode()).hexdigest()


def _assumptions(
    section: Section, derived: dict[str, Any], prefix: str = "", unused: frozenset[str] = frozenset()
) -> Iterator[dict[str, Any]]:
    """The assumed defaults that the result depends on, with the value used where `derived` holds it.

    `derived` holds such values under their names, or in groups and lists of the sections' own names. `unused` are
    dotted names that the sections around leave out.
    """
    unused |= {prefix + name for name, left_out in section.unused().items() if left_out}
    for member in members(type(section)):
        name, reason = member.name, member.meaning.assumed
        if not (reason or member.group) or (path := prefix + name) in unused:
            continue
        value = getattr(section, name)
        if isinstance(value, Section):
            yield from _assumptions(value, derived.get(name, derived) or {}, f"{path}.", unused)
        elif isinstance(value, list) and member.group:
            known = derived.get(name) or [{}] * len(value)
            for index, (item, own) in enumerate(zip(value, known, strict=True)):
                yield from _assumptions(item, own, f"{path}.{index}.", unused)
        elif reason and (value is None or name not in section.model_fields_set):
            used = derived.get(name, value)
            yield {"field": path, "value": section.stands_for_null(name) if used is None else used, "reason": reason}
