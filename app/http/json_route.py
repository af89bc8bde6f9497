"""A route whose JSON body is read strictly, before FastAPI validates it against the handler's signature."""

from collections.abc import Callable, Coroutine
from typing import Any, cast

from fastapi import Request, Response
from fastapi.exceptions import RequestValidationError
from fastapi.routing import APIRoute
from pydantic import BaseModel
from starlette.exceptions import HTTPException

from app.errors import InvalidBody, Unreadable
from app.evaluate import content_of
from app.schema.reading import faults


class _StrictRequest(Request):
    """A request whose JSON objects have unique names, and a limited number of them."""

    async def json(self) -> Any:
        """What the body says; raises Unreadable and InvalidBody."""
        return content_of(await self.body())


class JsonRoute(APIRoute):
    """A route with a JSON body: 415 for other types, 400 where a name occurs twice, messages by `schema.reading`."""

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        """What answers a request."""
        answer = super().get_route_handler()
        assert self.body_field is not None
        model = cast("type[BaseModel]", self.body_field.field_info.annotation)

        async def handle(http: Request) -> Response:
            require_json(http)
            strict = _StrictRequest(http.scope, http.receive)
            if not await strict.body():
                await strict.json()  # says what is missing
            try:
                return await answer(strict)
            except RequestValidationError as error:
                in_body = [item | {"loc": item["loc"][1:]} for item in error.errors() if item["loc"][0] == "body"]
                if len(in_body) < len(error.errors()):  # the address comes first
                    raise
                raise InvalidBody(faults(model, in_body)) from None
            except HTTPException as error:
                if isinstance(error.__cause__, (Unreadable, InvalidBody)):  # FastAPI calls it a parsing error
                    raise error.__cause__ from None
                raise

        return handle


def require_json(http: Request) -> None:
    """Raise 415 unless the body is declared as JSON."""
    media_type = http.headers.get("content-type", "").partition(";")[0].strip().lower()
    kind, _, subtype = media_type.partition("/")
    if kind != "application" or subtype.rpartition("+")[2] != "json":
        raise HTTPException(415, "send the header Content-Type: application/json")
