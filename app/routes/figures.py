"""The figures of every endpoint: what there is, and each as an image or as numbers."""

from collections.abc import Callable, Coroutine
from typing import Annotated, Any, get_args

from fastapi import APIRouter, HTTPException, Path, Query, Request, Response
from fastapi.routing import APIRoute
from pydantic import BaseModel

from app.calculations import CALCULATIONS, Calculation
from app.contract.quantities import Output
from app.figures.data import ThemeName
from app.figures.rendering import MEDIA_TYPES, Format, render
from app.library import body_of
from app.problems import Unprocessable, documented
from app.reading import read
from app.routes.calculations import require_json
from app.start_up import StartUp
from app.workers.admission import Runner

FORMATS: tuple[Format, ...] = get_args(Format)
THEMES: tuple[ThemeName, ...] = get_args(ThemeName)
_BY_PATH = {calculation.path: calculation for calculation in CALCULATIONS}


class FigureRoute(APIRoute):
    """A figure as its signature documents it; the body is read, the case solved and the figure drawn in a worker."""

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        """What answers a request."""
        path = self.path.partition("/figures/")[0]

        async def handle(http: Request) -> Response:
            name, image_format, theme = _wanted(_BY_PATH[path], http)
            require_json(http)
            start_up: StartUp = http.app.state.start_up
            start_up.require(path)
            runner: Runner = http.app.state.runner
            content = await runner.run(http.receive, draw_body, path, name, await http.body(), image_format, theme)
            return Response(content, media_type=MEDIA_TYPES[image_format])

        return handle


def draw_body(path: str, name: str, body: bytes, image_format: Format, theme: ThemeName) -> bytes:
    """The figure of a case given by the bytes of a request; runs in a worker."""
    calculation = _BY_PATH[path]
    figure = next(figure for figure in calculation.figures if figure.name == name)
    return render(calculation, figure, read(calculation.request, body), image_format, theme)


def _wanted(calculation: Calculation, http: Request) -> tuple[str, Format, ThemeName]:
    """Name, format and theme of the address; raises 404 that lists what there is."""
    names = [figure.name for figure in calculation.figures]
    name, image_format = http.path_params["name"], http.path_params["format"]
    theme = http.query_params.get("theme", THEMES[0])
    if name not in names or image_format not in FORMATS:
        raise HTTPException(404, f"There are {', '.join(names)}, each as {', '.join(FORMATS)}")
    if theme not in THEMES:
        raise Unprocessable("unknown_theme", f"there are the themes {', '.join(THEMES)}", None)
    return name, image_format, theme


router = APIRouter(tags=["figures"])
drawn = APIRouter(tags=["figures"], route_class=FigureRoute)


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


def _add(calculation: Calculation) -> None:
    names = [figure.name for figure in calculation.figures]

    async def show(
        name: Annotated[str, Path(description="name of the figure", json_schema_extra={"enum": names})],
        image_format: Annotated[
            str, Path(alias="format", description="format of the figure", json_schema_extra={"enum": list(FORMATS)})
        ],
        body: Any,
        theme: Annotated[ThemeName, Query(description="dark lines on white, or light ones on black")] = "light",
    ) -> Response:
        raise NotImplementedError(name, image_format, body, theme)  # documents the figure; FigureRoute answers

    show.__annotations__["body"] = Annotated[calculation.request, body_of(calculation.path)]
    _, _, model, *parts = calculation.path.split("/")
    drawn.add_api_route(
        calculation.path + "/figures/{name}.{format}",
        show,
        methods=["POST"],
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

router.include_router(drawn)
