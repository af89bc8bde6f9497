"""From the bytes of a body to a validated request; runs in a worker, so that no body holds up the other clients."""

import json
from typing import Any, TypeVar

from pydantic import ValidationError

from app.requests.common import Request

R = TypeVar("R", bound=Request)
MOST_MEMBERS = 1000
MOST_FIELD_ERRORS = 100


class Unreadable(Exception):
    """The body is no JSON that can be read."""

    def __init__(self, detail: str) -> None:
        super().__init__(detail)
        self.detail = detail


class InvalidBody(Exception):
    """The body is no request; `errors` has location, type and message of each fault, a hundred at most."""

    def __init__(self, errors: list[dict[str, Any]]) -> None:
        super().__init__(errors)
        self.errors = errors


def read(model: type[R], body: bytes) -> R:
    """The request in the body.

    Raises Unreadable and InvalidBody.
    """
    if not body:
        raise InvalidBody([_fault("missing", "Field required")])
    try:
        content = json.loads(body, object_pairs_hook=_members)
    except json.JSONDecodeError as error:
        raise InvalidBody(
            [_fault("json_invalid", f"The body is no JSON: {error.msg} at position {error.pos}")]
        ) from None
    except (ValueError, RecursionError):  # bytes that are no text, numbers without end, brackets without end
        raise Unreadable("The body cannot be read as JSON") from None
    return validated(model, content)


def validated(model: type[R], content: Any) -> R:
    """The request that the content is; raises InvalidBody."""
    try:
        return model.model_validate(content)
    except ValidationError as error:
        found = error.errors(include_url=False, include_context=False, include_input=False)
        raise InvalidBody(
            [{"loc": each["loc"], "type": each["type"], "msg": each["msg"]} for each in found[:MOST_FIELD_ERRORS]]
        ) from None


def _members(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """An object of unique names, as many as any request could need."""
    if len(pairs) > MOST_MEMBERS:
        raise InvalidBody([_fault("too_many_fields", f"An object has more than {MOST_MEMBERS} fields")])
    members = dict(pairs)
    if len(members) < len(pairs):
        raise Unreadable("A name stands twice in one object of the body")
    return members


def _fault(code: str, message: str) -> dict[str, Any]:
    return {"loc": (), "type": code, "msg": message}
