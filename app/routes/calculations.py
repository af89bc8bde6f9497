"""One POST endpoint for every row of the table of calculations."""

from typing import Annotated, Any

from fastapi import APIRouter, Request, Response

from app.calculations import CALCULATIONS, Calculation
from app.compute import Runner
from app.formats.json import answer
from app.library import body_of
from app.problems import documented

router = APIRouter(responses=documented(400, 408, 413, 422, 431, 500, 503, 504))


def _add(calculation: Calculation) -> None:
    async def calculate(http: Request, body: Any) -> Response:
        runner: Runner = http.app.state.runner
        content = await runner.run(http.receive, answer, calculation, body)
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


for each in CALCULATIONS:
    _add(each)
