"""One POST endpoint for every row of the table of calculations."""

from collections.abc import Callable, Coroutine
from functools import partial
from typing import Annotated, Any, NamedTuple

from fastapi import APIRouter, HTTPException, Request, Response
from fastapi.routing import APIRoute

from app.calculations import BY_PATH, CALCULATIONS, Calculation
from app.cost import refuse_endless
from app.formats.json import answer
from app.library import body_of
from app.problems import documented
from app.reading import read
from app.schema.base import Request as Model
from app.settings import Settings
from app.workers.admission import Runner
from app.workers.start_up import StartUp


class Work(NamedTuple):
    """What a worker does with the body of a request for the endpoint at `path`, and the kind of the outcome.

    `policy` is a content policy of its own, where the service's does not fit.
    """

    path: str
    function: Callable[[bytes, float], bytes]
    media_type: str
    policy: str | None = None


class CalculationRoute(APIRoute):
    """An endpoint as its signature documents it, whose body is read and validated where it is calculated."""

    def work(self, _http: Request) -> Work:
        """What is asked for."""
        return Work(self.path, partial(answer_body, self.path), "application/json")

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        """What answers a request."""

        async def handle(http: Request) -> Response:
            work = self.work(http)
            require_json(http)
            start_up: StartUp = http.app.state.start_up
            start_up.require(work.path)
            runner: Runner = http.app.state.runner
            limits: Settings = http.app.state.settings
            content = await runner.run(http, work.function, await http.body(), limits.deadline_s)
            headers = {"Content-Security-Policy": work.policy} if work.policy else None
            return Response(content, headers=headers, media_type=work.media_type)

        return handle


router = APIRouter(route_class=CalculationRoute, responses=documented(400, 408, 413, 415, 422, 431, 500, 503, 504))


def answer_body(path: str, body: bytes, deadline_s: float) -> bytes:
    """The answer of an endpoint to the bytes of a request; runs in a worker."""
    return answer(*read_case(path, body, deadline_s))


def read_case(path: str, body: bytes, deadline_s: float) -> tuple[Calculation, Model]:
    """The calculation and its request; raises what `read` raises, and Unprocessable for what cannot be finished."""
    calculation = BY_PATH[path]
    request = read(calculation.request, body)
    refuse_endless(request, deadline_s)
    return calculation, request


def require_json(http: Request) -> None:
    """Raise 415 unless the body is declared as JSON."""
    media_type = http.headers.get("content-type", "").partition(";")[0].strip().lower()
    kind, _, subtype = media_type.partition("/")
    if kind != "application" or subtype.rpartition("+")[2] != "json":
        raise HTTPException(415, "send the header Content-Type: application/json")


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
