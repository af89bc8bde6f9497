"""From a request and its answer to the bytes of one of its figures; runs in a worker process."""

from typing import Any, Literal

from app.errors import Unprocessable
from app.figures.data import Figure, NoFigure, ThemeName
from app.figures.declaration import Declaration
from app.figures.tables import table
from app.schema.model import Request

Format = Literal["svg", "png", "pdf", "csv"]
MEDIA_TYPES: dict[Format, str] = {
    "svg": "image/svg+xml",
    "png": "image/png",
    "pdf": "application/pdf",
    "csv": "text/csv; charset=utf-8",
}


def figure_of(declaration: Declaration, request: Request, response: Any) -> Figure:
    """The data of a figure; raises Unprocessable where the case has none."""
    try:
        return declaration.figure(request, response)
    except NoFigure as reason:
        raise Unprocessable(reason.code, reason.message, reason.field) from reason


def written(figure: Figure, image_format: Format, theme: ThemeName) -> bytes:
    """The figure as an image, or its numbers."""
    if image_format == "csv":
        return table(figure)
    from app.figures.drawing.image import draw  # noqa: PLC0415  only workers draw: half a second and 70 MB

    return draw(figure, image_format, theme)
