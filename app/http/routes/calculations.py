"""One POST endpoint for every row of the table of calculations."""

from collections.abc import Callable
from typing import Annotated, Any

from fastapi import APIRouter, Body, Request, Response

from app.calculations import BY_PATH, CALCULATIONS, Calculation
from app.evaluate import json_answer, refuse_endless
from app.examples import examples
from app.http.json_route import JsonRoute
from app.http.problems import documented
from app.schema.model import Request as Model
from app.workers.start_up import StartUp


def body_of(endpoint: str) -> Any:
    """The body parameter of an endpoint, its examples on the docs page."""
    return Body(
        openapi_examples={
            example.name: {"summary": example.title, "description": example.source, "value": example.request}
            for example in examples().values()
            if example.endpoint == endpoint
        }
    )


async def calculated(http: Request, path: str, function: Callable[..., bytes], request: Model) -> bytes:
    """The result of `function(path, request)` in a worker; raises WarmingUp, Unprocessable for endless requests."""
    calculation = BY_PATH[path]
    start_up: StartUp = http.app.state.start_up
    if calculation.stage not in start_up.warm:
        raise start_up.warming_up()
    refuse_endless(calculation, request, http.app.state.settings.deadline_s)
    made: bytes = await http.app.state.pool.calculate(http, function, path, request)
    return made


def answer_of(path: str, request: Model) -> bytes:
    """The answer of an endpoint to a request; runs in a worker."""
    return json_answer(BY_PATH[path], request)


def add(router: APIRouter, calculation: Calculation) -> None:
    """The endpoint of a row of the table."""

    async def calculate(http: Request, body: Any) -> Response:
        content = await calculated(http, calculation.path, answer_of, body)
        return Response(content, media_type="application/json")

    _, _, model, *parts = calculation.path.split("/")
    calculate.__annotations__["body"] = Annotated[calculation.request, body_of(calculation.path)]
    router.add_api_route(
        calculation.path,
        calculate,
        methods=["POST"],
        tags=[model],
        operation_id="_".join((model, *parts)).replace("-", "_"),
        summary=calculation.summary,
        description=f"Source: {calculation.source}.",
        response_model=calculation.response,
    )


router = APIRouter(route_class=JsonRoute, responses=documented(400, 408, 413, 415, 422, 431, 500, 503, 504))
for each in CALCULATIONS:
    add(router, each)
