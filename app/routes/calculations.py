"""One POST endpoint for every row of the table of calculations."""

from collections.abc import Callable, Coroutine
from typing import Annotated, Any

from fastapi import APIRouter, HTTPException, Request, Response
from fastapi.routing import APIRoute

from app.calculations import CALCULATIONS, Calculation
from app.formats.json import answer
from app.library import body_of
from app.problems import documented
from app.reading import read
from app.start_up import StartUp
from app.workers.admission import Runner


class CalculationRoute(APIRoute):
    """An endpoint as its signature documents it, whose body is read and validated where it is calculated."""

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        """What answers a request."""
        path = self.path

        async def handle(http: Request) -> Response:
            require_json(http)
            start_up: StartUp = http.app.state.start_up
            start_up.require(path)
            runner: Runner = http.app.state.runner
            content = await runner.run(http.receive, answer_body, path, await http.body())
            return Response(content, media_type="application/json")

        return handle


router = APIRouter(route_class=CalculationRoute, responses=documented(400, 408, 413, 415, 422, 431, 500, 503, 504))
_BY_PATH = {calculation.path: calculation for calculation in CALCULATIONS}


def answer_body(path: str, body: bytes) -> bytes:
    """The answer of an endpoint to the bytes of a request; runs in a worker."""
    calculation = _BY_PATH[path]
    return answer(calculation, read(calculation.request, body))


def require_json(http: Request) -> None:
    """Raise 415 unless the body is declared as JSON."""
    media_type = http.headers.get("content-type", "").partition(";")[0].strip().lower()
    kind, _, subtype = media_type.partition("/")
    if kind != "application" or subtype.rpartition("+")[2] != "json":
        raise HTTPException(415, "The content type must be application/json")


def _add(calculation: Calculation) -> None:
    async def calculate(body: Any) -> Response:
        raise NotImplementedError(body)  # documents the endpoint; CalculationRoute answers

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


for each in CALCULATIONS:
    _add(each)
