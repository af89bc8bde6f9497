"""The figures of every endpoint: a list of them, and each as an image or as numbers."""

from functools import partial
from typing import Annotated, Any, Literal, cast, get_args

from fastapi import APIRouter, Depends, HTTPException, Path, Query, Request, Response
from pydantic import BaseModel

from app.calculations import BY_PATH, CALCULATIONS, Calculation
from app.evaluate import drawn
from app.figures.rendering import MEDIA_TYPES, Format
from app.http.json_route import JsonRoute
from app.http.problems import documented
from app.http.routes.calculations import body_of, calculated
from app.schema.model import Request as Model
from app.schema.quantities import Output

Theme = Literal["light", "dark"]
FORMATS: tuple[Format, ...] = get_args(Format)
THEMES: tuple[Theme, ...] = get_args(Theme)
# A figure needs no script and no other address: styles and images are inside it.
ALONE = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'"
_FIGURES = {each.path: {figure.name: figure for figure in each.figures} for each in CALCULATIONS}

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


def figure_of(name: str, image_format: Format, theme: Theme, path: str, request: Model) -> bytes:
    """The figure of a case; runs in a worker."""
    return drawn(BY_PATH[path], _FIGURES[path][name], request, image_format, theme)


def _add(calculation: Calculation) -> None:
    names = list(_FIGURES[calculation.path])

    async def known(http: Request) -> None:
        """404 for an unknown figure or format, before the body is validated."""
        if http.path_params["name"] not in names or http.path_params["format"] not in FORMATS:
            raise HTTPException(404, f"There are {', '.join(names)}, each as {', '.join(FORMATS)}")

    async def show(
        http: Request,
        name: Annotated[str, Path(description="name of the figure", json_schema_extra={"enum": names})],
        image_format: Annotated[
            str, Path(alias="format", description="format of the figure", json_schema_extra={"enum": list(FORMATS)})
        ],
        body: Any,
        theme: Annotated[Theme, Query(description="dark lines on white, or light ones on black")] = "light",
    ) -> Response:
        image = cast("Format", image_format)
        figure = partial(figure_of, name, image, theme)
        content = await calculated(http, calculation.path, figure, body)
        return Response(content, headers={"Content-Security-Policy": ALONE}, media_type=MEDIA_TYPES[image])

    show.__annotations__["body"] = Annotated[calculation.request, body_of(calculation.path)]
    _, _, model, *parts = calculation.path.split("/")
    router.add_api_route(
        calculation.path + "/figures/{name}.{format}",
        show,
        methods=["POST"],
        dependencies=[Depends(known)],
        route_class_override=JsonRoute,
        operation_id="_".join((model, *parts, "figure")).replace("-", "_"),
        summary=f"Figures: {calculation.summary}",
        description="The body is that of the calculation; its `detail` is ignored. Points without a solution are gaps.",
        response_class=Response,
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
