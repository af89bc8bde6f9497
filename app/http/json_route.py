"""A route that reads its JSON body by strict rules before FastAPI validates the body by the handler's signature."""

from collections.abc import Callable, Coroutine
from typing import Any, cast

from fastapi import Request, Response
from fastapi.exceptions import RequestValidationError
from fastapi.routing import APIRoute
from pydantic import BaseModel
from starlette.exceptions import HTTPException

from app.errors import InvalidBody
from app.schema.reading import content_of, faults


class _ReadRequest(Request):
    """A request whose body has been read."""

    content: Any

    async def json(self) -> Any:
        return self.content


class JsonRoute(APIRoute):
    """A route with a JSON body.

    The route answers 415 to media types other than JSON. It answers 400 if a name occurs twice in one object. The
    messages come from `app.schema.reading`.
    """

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        """Return the function that answers a request."""
        answer = super().get_route_handler()
        assert self.body_field is not None
        model = cast("type[BaseModel]", self.body_field.field_info.annotation)

        async def handle(http: Request) -> Response:
            media_type = http.headers.get("content-type", "").partition(";")[0].strip().lower()
            kind, _, subtype = media_type.partition("/")
            if kind != "application" or subtype.rpartition("+")[2] != "json":
                raise HTTPException(415, "send the request with the header Content-Type: application/json")
            read = _ReadRequest(http.scope, http.receive)
            read.content = content_of(await read.body())
            try:
                return await answer(read)
            except RequestValidationError as error:
                in_body = [item | {"loc": item["loc"][1:]} for item in error.errors() if item["loc"][0] == "body"]
                if len(in_body) < len(error.errors()):  # there are errors of the address, which are reported first
                    raise
                raise InvalidBody(faults(model, in_body, read.content)) from None

        return handle
