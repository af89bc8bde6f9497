"""Functions that read and solve requests and write answers, for JSON, pages, figures and studies."""

import json
from collections.abc import Iterator
from dataclasses import asdict
from hashlib import sha256
from operator import attrgetter
from typing import Any

from app import figures
from app.calculations import BY_PATH
from app.errors import Unprocessable
from app.examples import examples
from app.figures.data import ThemeName
from app.models.card import Calculation
from app.models.kernels import KernelGroup
from app.schema.answers import MODEL_VERSION, Response, shown
from app.schema.fields import field_path
from app.schema.model import Request, Section, members
from app.schema.reading import validated
from app.sources import SOURCES
from solvers import notices
from solvers.errors import InvalidInput, NoSolution

_CANONICAL = json.JSONEncoder(sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False)


def refuse_endless(calculation: Calculation, request: Request, deadline_s: float) -> None:
    """Raise Unprocessable if the estimated time of a request is longer than the deadline."""
    if calculation.cost is not None:
        cost = calculation.cost(request)
        if cost.seconds > deadline_s:
            raise Unprocessable(
                "cannot_finish",
                f"the calculation would take about {cost.seconds:.0f} s, but the time limit is {deadline_s:g} s; "
                "reduce the value of this field",
                cost.field,
            )


def calculation_at(endpoint: str) -> Calculation:
    """Return the calculation of an endpoint. Raises Unprocessable if there is no such endpoint."""
    if endpoint not in BY_PATH:
        raise Unprocessable(
            "unknown_endpoint", f"there is no such endpoint; the endpoints are {', '.join(BY_PATH)}", "endpoint"
        )
    return BY_PATH[endpoint]


def answer(endpoint: str, request: dict[str, Any]) -> dict[str, Any]:
    """Return the answer of the service to a request, without a running server.

    Parameters
    ----------
    endpoint : str
        Address of the calculation, such as "/v1/coupling".
    request : dict
        Body of the request, in the same form as a request over HTTP.

    Returns
    -------
    dict
        The answer, in the same form as an answer over HTTP.

    Raises
    ------
    InvalidBody
        If the body is not a valid request; its `faults` have pointer, code and message.
    Unprocessable
        If there is no such endpoint, or if the input is impossible. `code` and `message` state the reason; `path` names
        the field.
    """
    calculation = calculation_at(endpoint)
    content: dict[str, Any] = json.loads(written(evaluate(calculation, validated(calculation.request, request))))
    return content


def answer_of(path: str, request: Request) -> bytes:
    """Solve a request to the endpoint `path` and return the answer as JSON. Raises the errors of `evaluate`.

    This function runs in a worker process.
    """
    return written(evaluate(BY_PATH[path], request))


def figure_of(name: str, image_format: figures.Format, theme: ThemeName, path: str, request: Request) -> bytes:
    """Solve a request to the endpoint `path` and return the figure `name` of the result.

    This function runs in a worker process. Raises the errors of `evaluate`, and NoFigure if this figure cannot be drawn
    from the result.
    """
    declaration = next(figure for figure in BY_PATH[path].figures if figure.name == name)
    summary = request.model_copy(update={"detail": "summary"})
    figure = declaration.figure(summary, evaluate(BY_PATH[path], summary))
    return figures.written(figure, image_format, theme)


def warm(group: KernelGroup) -> None:
    """Compile the kernels of a group in this process, or load them, by solving the examples of the group."""
    for name in group.examples:
        example = examples()[name]
        request = example.request
        if group.model:
            request = request | {"model": request.get("model", {}) | dict(group.model)}
        answer_of(example.endpoint, BY_PATH[example.endpoint].request.model_validate(request))


def written(response: Response) -> bytes:
    """Return a response as JSON. Fields that are not set are left out."""
    return response.model_dump_json(exclude_unset=True).encode()


def evaluate(calculation: Calculation, request: Request) -> Response:
    """Solve a request and return the response.

    Raises Unprocessable if the solver rejects the input, and a validation error if a result is not finite.
    """
    return response_to(calculation, request, solve(calculation, request))


def solve(calculation: Calculation, request: Request) -> Any:
    """Return the solver's result. If the solver raises NoSolution, return this exception.

    Raises Unprocessable if the solver rejects the input.
    """
    try:
        return calculation.solve(request.inputs())
    except InvalidInput as error:
        raise Unprocessable(error.code, error.message, field_path(request, error.field)) from error
    except NoSolution as failure:
        return failure


def response_to(calculation: Calculation, request: Request, result: Any) -> Response:
    """Return the response for a solver's result, or for the exception NoSolution that the solver raised.

    Raises a validation error if a number in the result is not finite.
    """
    content: dict[str, Any]
    if isinstance(result, NoSolution):
        warning: dict[str, str | None] = {"rank": "invalid", "code": result.code, "message": result.message}
        if result.field is not None:
            warning["field"] = field_path(request, result.field)
        content = {"status": "no_solution", "warnings": [warning], "residuals": result.residuals}
        result = None
    else:
        warnings = [
            asdict(notice) | {"field": field_path(request, notice.field)}
            for notice in sorted(result.warnings, key=lambda notice: notices.RANKS.index(notice.rank))
        ]
        content = shown(calculation.response, result, request.detail)
        content |= {"status": "ok_with_warnings" if warnings else "ok", "warnings": warnings}
        if getattr(result, "status", None) == "no_solution":
            content |= {"status": "no_solution", "residuals": result.residuals}
    of_model = (
        {"field": path, "value": attrgetter(path)(request), "reason": reason}
        for path, reason in request.assumed_by_the_model().items()
    )
    inputs = request.model_dump(exclude={"detail"})
    content |= {
        "assumptions": [*_assumptions(request, content.get("derived", {})), *of_model],
        "model_version": MODEL_VERSION,
        "sources": SOURCES,
        "model": request.options(),
        "inputs": inputs,
        "case": case_of(calculation.path, inputs, SOURCES),
    }
    return calculation.response.model_validate(content).read_from(result)


def case_of(endpoint: str, inputs: dict[str, Any], sources: str) -> str:
    """Return the SHA-256 hash of endpoint, inputs and the hash `sources` of the solvers' code, as hexadecimal digits.

    The hashed text is JSON in UTF-8, with sorted keys, without blanks, and with floats in their shortest form.
    """
    content = {"endpoint": endpoint, "inputs": inputs, "sources": sources}
    return sha256(_CANONICAL.encode(content).encode()).hexdigest()


def _assumptions(
    section: Section, derived: dict[str, Any], prefix: str = "", unused: frozenset[str] = frozenset()
) -> Iterator[dict[str, Any]]:
    """Yield the field, the value and the reason of each default of our choice, and of each value that was looked up.

    Values without effect on the result are left out.

    `derived` holds the values that the calculation used, by the names of the fields. `prefix` is put before the names
    of the fields of `section`. `unused` holds the dotted names of fields without effect on the result.
    """
    unused |= {prefix + name for name, left_out in section.unused().items() if left_out}
    looked_up = section.values_by_source()
    for member in members(type(section)):
        name, reason = member.name, member.meaning.assumed
        if not (reason or member.group or name in looked_up) or (path := prefix + name) in unused:
            continue
        value = getattr(section, name)
        if name in looked_up:
            yield {"field": path, "value": value, "reason": looked_up[name]}
        elif isinstance(value, Section):
            yield from _assumptions(value, derived.get(name, derived) or {}, f"{path}.", unused)
        elif isinstance(value, list) and member.group:
            derived_items = derived.get(name) or [{}] * len(value)
            for index, (item, own) in enumerate(zip(value, derived_items, strict=True)):
                yield from _assumptions(item, own, f"{path}.{index}.", unused)
        elif reason and (value is None or name not in section.model_fields_set):
            used = derived.get(name, value)
            yield {"field": path, "value": section.stands_for_null(name) if used is None else used, "reason": reason}
