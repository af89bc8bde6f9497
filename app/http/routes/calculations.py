"""A POST endpoint for each row of the table of calculations, and an endpoint for the figures of each row."""

from collections.abc import Callable
from functools import partial
from operator import attrgetter
from typing import Annotated, Any, cast

from fastapi import APIRouter, Body, Depends, Path, Query, Request, Response
from pydantic import BaseModel

from app.calculations import BY_PATH, CALCULATIONS, Calculation
from app.evaluate import answer_of, figure_of, refuse_endless
from app.examples import examples
from app.figures import MEDIA_TYPES, Format
from app.figures.data import ThemeName
from app.http.json_route import JsonRoute
from app.http.problems import documented
from app.http.routes.pages import DOCUMENT_POLICY, unknown_figure
from app.schema.model import Request as Model
from app.schema.quantities import Output

FORMATS: tuple[Format, ...] = tuple(MEDIA_TYPES)
REFUSALS = documented(400, 413, 415, 422, 500, 503, 504)

router = APIRouter(route_class=JsonRoute, responses=REFUSALS)
figures = APIRouter(tags=["figures"])


class FigureSummary(BaseModel):
    """One figure of an endpoint; its address is `{endpoint}/figures/{name}.{format}`."""

    endpoint: Annotated[str, Output("where to post the request")]
    name: Annotated[str, Output("name in the address")]
    title: Annotated[str, Output("what it shows")]
    source: Annotated[str, Output("figure or section of the paper that it follows")]
    formats: Annotated[tuple[Format, ...], Output("available formats")] = FORMATS


async def calculated(http: Request, path: str, function: Callable[..., bytes], request: Model) -> bytes:
    """Run `function(path, request)` in a worker and return the result.

    A request whose kernels are being compiled waits for them. Raises WarmingUp if they take too long, Unprocessable
    if the request would take too long, and the errors of the function and of the workers.
    """
    refuse_endless(BY_PATH[path], request, http.app.state.settings.deadline_s)
    await http.app.state.start_up.wait(http, BY_PATH[path].kernels.of(lambda field: attrgetter(field)(request)))
    content: bytes = await http.app.state.pool.calculate(http, function, path, request)
    return content


def _body_of(calculation: Calculation) -> Any:
    """Return the type of a calculation's body, with the examples for the docs page."""
    shown: dict[str, Any] = {
        example.name: {"summary": example.title, "description": example.source, "value": example.request}
        for example in examples().values()
        if example.endpoint == calculation.path
    }
    return Annotated[calculation.request, Body(openapi_examples=shown)]


def _operation(calculation: Calculation) -> str:
    return calculation.path.removeprefix("/v1/").replace("/", "_").replace("-", "_")


def add(router: APIRouter, calculation: Calculation) -> None:
    """Add the endpoint of a calculation to a router."""

    async def calculate(http: Request, body: Any) -> Response:
        content = await calculated(http, calculation.path, answer_of, body)
        return Response(content, media_type="application/json")

    calculate.__annotations__["body"] = _body_of(calculation)
    router.add_api_route(
        calculation.path,
        calculate,
        methods=["POST"],
        tags=[calculation.path.split("/")[2]],
        operation_id=_operation(calculation),
        summary=calculation.summary,
        description=f"Source: {calculation.source}.",
        response_model=calculation.response,
    )


def _add_figures(calculation: Calculation) -> None:
    names = [figure.name for figure in calculation.figures]

    async def check_name(http: Request) -> None:
        """Answer 404 for an unknown figure or format, before the body is validated."""
        if http.path_params["name"] not in names or http.path_params["format"] not in FORMATS:
            raise unknown_figure(names, FORMATS)

    async def show(
        http: Request,
        name: Annotated[str, Path(description="name of the figure", json_schema_extra={"enum": names})],
        image_format: Annotated[
            str, Path(alias="format", description="format of the figure", json_schema_extra={"enum": list(FORMATS)})
        ],
        body: Any,
        theme: Annotated[ThemeName, Query(description="dark lines on white, or light ones on black")] = "light",
    ) -> Response:
        image = cast("Format", image_format)
        content = await calculated(http, calculation.path, partial(figure_of, name, image, theme), body)
        return Response(content, headers={"Content-Security-Policy": DOCUMENT_POLICY}, media_type=MEDIA_TYPES[image])

    show.__annotations__["body"] = _body_of(calculation)
    images = {media: {"schema": {"type": "string", "format": "binary"}} for media in MEDIA_TYPES.values()}
    shown = {"description": "the figure, or its numbers with their units in the header", "content": images}
    figures.add_api_route(
        calculation.path + "/figures/{name}.{format}",
        show,
        methods=["POST"],
        dependencies=[Depends(check_name)],
        route_class_override=JsonRoute,
        operation_id=f"{_operation(calculation)}_figure",
        summary=f"Figures: {calculation.summary}",
        description="The body is that of the calculation; its `detail` is ignored. Points without a solution are gaps.",
        response_class=Response,
        responses=REFUSALS | documented(404) | {200: shown},
    )


@figures.get("/v1/figures")
async def list_figures() -> list[FigureSummary]:
    """List the figures of all endpoints."""
    return [
        FigureSummary(endpoint=calculation.path, name=figure.name, title=figure.title, source=figure.source)
        for calculation in CALCULATIONS
        for figure in calculation.figures
    ]


for row in CALCULATIONS:
    add(router, row)
    if row.figures:
        _add_figures(row)
