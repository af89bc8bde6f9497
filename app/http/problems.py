"""Errors as problem documents (RFC 9457). These documents never repeat values of the input."""

import logging
from http import HTTPStatus
from typing import Annotated, Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from pydantic import BaseModel
from pydantic.json_schema import models_json_schema
from starlette.exceptions import HTTPException

from app.errors import Fault, InvalidBody, Kind, Unprocessable, faults_of, kind_of, pointer, sentence
from app.schema.quantities import Output
from app.schema.reading import MOST_FAULTS

MEDIA_TYPE = "application/problem+json"

logger = logging.getLogger("tribodrive")


class FieldError(BaseModel):
    """The error of one field."""

    pointer: Annotated[str, Output("JSON Pointer into the request; empty for the whole request")]
    code: Annotated[str, Output("stable name of the error, meant for programs")]
    message: Annotated[str, Output("what to change")]


class Problem(BaseModel):
    """An RFC 9457 problem document."""

    type: Annotated[str, Output("URI that names the kind of problem")]
    title: Annotated[str, Output("the kind of problem in words")]
    status: Annotated[int, Output("the HTTP status")]
    detail: Annotated[str, Output("what happened in this case")]
    instance: Annotated[str, Output("the request id, as in the X-Request-ID header and the log")]
    errors: Annotated[list[FieldError] | None, Output("with 422: the fields at fault, at most a hundred")] = None


MEANINGS = {
    400: "the request cannot be read",
    404: "there is nothing of this name",
    413: "the request body is too large",
    422: "the input cannot be computed; `errors` names the fields",
    500: "something went wrong in the service",
    415: "the Content-Type header does not say application/json",
    503: "too many calculations are waiting, kernels are being compiled, or the calculation was lost with its process",
    504: "the calculation took too long",
}


def documented(*statuses: int) -> dict[int | str, dict[str, Any]]:
    """Return the entries of the OpenAPI document for error responses with these status codes."""
    content = {MEDIA_TYPE: {"schema": {"$ref": "#/components/schemas/Problem"}}}
    return {status: {"description": MEANINGS[status], "content": content} for status in statuses}


def install(app: FastAPI) -> None:
    """Answer refused input with problem documents, and add the schema of these documents to the OpenAPI document.

    The other exceptions have handlers of their own (`app.http.routes.pages.failed`), because they may become pages.
    """
    for kind in (RequestValidationError, InvalidBody, Unprocessable):
        app.add_exception_handler(kind, answer)
    openapi = app.openapi

    def with_problems() -> dict[str, Any]:
        document = openapi()
        schemas = document["components"]["schemas"]
        for name in ("HTTPValidationError", "ValidationError"):
            schemas.pop(name, None)
        _, definitions = models_json_schema([(Problem, "serialization")], ref_template="#/components/schemas/{model}")
        schemas |= definitions["$defs"]
        return document

    app.openapi = with_problems  # type: ignore[method-assign]


def problem(instance: str, kind: Kind, detail: str = "", **more: Any) -> JSONResponse:
    """Return a response with a problem document. `more` holds further members of the document."""
    name, detail = f"urn:tribodrive:problem:{kind.code}", detail or kind.title
    document = Problem(type=name, title=kind.title, status=kind.status, detail=detail, instance=instance, **more)
    return JSONResponse(document.model_dump(exclude_none=True), kind.status, kind.headers, media_type=MEDIA_TYPE)


def answer(request: Request, error: Exception) -> JSONResponse:
    """Return the problem document of an exception."""
    instance = str(request.state.request_id)
    match error:
        case RequestValidationError():  # faults of an address; for faults of a body the error is InvalidBody
            items = error.errors()[:MOST_FAULTS]
            faults = [Fault(pointer(item["loc"][1:]), item["type"], _message(item)) for item in items]
            return answer(request, InvalidBody(faults))
        case InvalidBody() | Unprocessable():
            code = error.code if isinstance(error, Unprocessable) else "invalid_request"
            errors = faults_of(error)
            kind = Kind(422, code, "The input cannot be computed")
            return problem(instance, kind, sentence(errors[0]), errors=errors)
        case HTTPException():
            phrase = HTTPStatus(error.status_code).phrase
            code = phrase.lower().replace(" ", "_").replace("-", "_")
            response = problem(instance, Kind(error.status_code, code, phrase), error.detail)
            response.headers.update(error.headers or {})
            return response
        case _:
            return problem(instance, kind_of(error), getattr(error, "detail", ""))


def _message(item: dict[str, Any]) -> str:
    if item["type"] == "literal_error":
        return f"{item['loc'][-1]}: must be one of {item['ctx']['expected']}"
    return str(item["msg"])


def internal_error(instance: str, error: Exception) -> JSONResponse:
    """Log an unexpected exception and return its problem document."""
    logger.error("request %s failed", instance, exc_info=error)
    return problem(instance, Kind(500, "internal_error", "Something went wrong in the service; the log has the cause"))
