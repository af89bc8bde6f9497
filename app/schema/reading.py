"""From the bytes of a body to a validated request."""

import json
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from app.errors import Fault, InvalidBody, Unreadable
from app.schema.messages import faults

M = TypeVar("M", bound=BaseModel)
MOST_MEMBERS = 1000
MOST_OBJECTS = 10_000


def read(model: type[M], body: bytes) -> M:
    """The request in the body.

    Raises Unreadable and InvalidBody.
    """
    return validated(model, content_of(body))


def validated(model: type[M], content: Any) -> M:
    """The request of this content, or InvalidBody."""
    try:
        return model.model_validate(content)
    except ValidationError as error:
        found = error.errors(include_url=False)
        raise InvalidBody(faults(model, found)) from None  # type: ignore[arg-type]


def content_of(body: bytes) -> Any:
    """What the JSON of a body says."""
    if not body:
        raise InvalidBody([Fault("", "missing", "the request needs a body")])
    try:
        return json.loads(body, object_pairs_hook=_Objects().members)
    except json.JSONDecodeError as error:
        message = f"the body is no JSON: {error.msg} at position {error.pos}"
        raise InvalidBody([Fault("", "json_invalid", message)]) from None
    except (ValueError, RecursionError):  # bytes that are no text, numbers without end, brackets without end
        raise Unreadable("The body cannot be read as JSON") from None


class _Objects:
    """The objects of a body: not more than any request could need, nor more fields in one, and no name twice."""

    def __init__(self) -> None:
        self._count = 0

    def members(self, pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        """One object."""
        self._count += 1
        if self._count > MOST_OBJECTS:
            raise InvalidBody([Fault("", "too_many_objects", f"the body has more than {MOST_OBJECTS} objects")])
        if len(pairs) > MOST_MEMBERS:
            raise InvalidBody([Fault("", "too_many_fields", f"an object has more than {MOST_MEMBERS} fields")])
        members = dict(pairs)
        if len(members) < len(pairs):
            raise Unreadable("A name stands twice in one object of the body")
        return members
