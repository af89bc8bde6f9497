"""The figures of every endpoint: what there is, and each as an image or as numbers."""

from typing import Annotated, Any, Literal, get_args

from fastapi import APIRouter, Depends, HTTPException, Path, Query, Request, Response
from pydantic import BaseModel

from app.calculations import CALCULATIONS, Calculation
from app.contract.quantities import Output
from app.figures.declaration import Declaration
from app.figures.rendering import MEDIA_TYPES, Format, render
from app.problems import documented
from app.reading import read
from app.routes.calculations import require_json
from app.start_up import StartUp
from app.workers.admission import Runner

FORMATS: tuple[Format, ...] = get_args(Format)
# A figure fetched alone runs nothing and loads nothing; its styles and images are its own.
ALONE = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"
router = APIRouter(tags=["figures"])


class FigureSummary(BaseModel):
    """One figure of an endpoint; it is at `{endpoint}/figures/{name}.{format}`."""

    endpoint: Annotated[str, Output("where to post the request")]
    name: Annotated[str, Output("name in the address")]
    title: Annotated[str, Output("what it shows")]
    source: Annotated[str, Output("figures of the paper that it repeats")]
    formats: Annotated[tuple[Format, ...], Output("formats in which it can be had")] = FORMATS


@router.get("/v1/figures")
async def list_figures() -> list[FigureSummary]:
    """Every figure of every endpoint."""
    return [
        FigureSummary(endpoint=calculation.path, name=figure.name, title=figure.title, source=figure.source)
        for calculation in CALCULATIONS
        for figure in calculation.figures
    ]


def figure_of_body(path: str, name: str, body: bytes, image_format: Format, theme: Literal["light", "dark"]) -> bytes:
    """A figure of an endpoint from the bytes of a request; runs in a worker."""
    calculation = next(each for each in CALCULATIONS if each.path == path)
    declaration = next(each for each in calculation.figures if each.name == name)
    return render(calculation, declaration, read(calculation.request, body), image_format, theme)


def _documented_body(calculation: Calculation) -> dict[str, Any]:
    """The body that the worker reads, as the calculation's own endpoint declares it."""
    schema = {"$ref": f"#/components/schemas/{calculation.request.__name__}"}
    return {"required": True, "content": {"application/json": {"schema": schema}}}


def _add(calculation: Calculation) -> None:
    figures = {figure.name: figure for figure in calculation.figures}

    def declared(
        name: Annotated[str, Path(description="name of the figure", json_schema_extra={"enum": list(figures)})],
        image_format: Annotated[
            str, Path(alias="format", description="format of the figure", json_schema_extra={"enum": list(FORMATS)})
        ],
    ) -> tuple[Declaration, Format]:
        if name not in figures or image_format not in FORMATS:
            raise HTTPException(404, f"There are {', '.join(figures)}, each as {', '.join(FORMATS)}")
        return figures[name], image_format

    async def show(
        http: Request,
        which: Annotated[tuple[Declaration, Format], Depends(declared)],
        theme: Annotated[
            Literal["light", "dark"], Query(description="dark lines on white, or light ones on black")
        ] = "light",
    ) -> Response:
        require_json(http)
        start_up: StartUp = http.app.state.start_up
        start_up.require(calculation.path)
        runner: Runner = http.app.state.runner
        declaration, image_format = which
        asked = calculation.path, declaration.name, await http.body(), image_format, theme
        content = await runner.run(http.receive, figure_of_body, *asked)
        return Response(content, 200, {"Content-Security-Policy": ALONE}, media_type=MEDIA_TYPES[image_format])

    _, _, model, *parts = calculation.path.split("/")
    router.add_api_route(
        calculation.path + "/figures/{name}.{format}",
        show,
        methods=["POST"],
        operation_id="_".join((model, *parts, "figure")).replace("-", "_"),
        summary=f"Figures: {calculation.summary}",
        description="The body is that of the calculation; its `detail` is ignored. Points without a solution are gaps.",
        response_class=Response,
        openapi_extra={"requestBody": _documented_body(calculation)},
        responses=documented(400, 404, 408, 413, 415, 422, 431, 500, 503, 504)
        | {
            200: {
                "description": "the figure, or its numbers with their units in the header",
                "content": {
                    media: {"schema": {"type": "string", "format": "binary"}} for media in MEDIA_TYPES.values()
                },
            }
        },
    )


for each in CALCULATIONS:
    if each.figures:
        _add(each)
