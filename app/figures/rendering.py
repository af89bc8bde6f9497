"""From a figure to the bytes of an image or of a table; runs in a worker process."""

from typing import Literal

from app.figures.data import Figure, ThemeName
from app.figures.tables import table

Format = Literal["svg", "png", "pdf", "csv"]
MEDIA_TYPES: dict[Format, str] = {
    "svg": "image/svg+xml",
    "png": "image/png",
    "pdf": "application/pdf",
    "csv": "text/csv; charset=utf-8",
}


def written(figure: Figure, image_format: Format, theme: ThemeName) -> bytes:
    """The figure as an image, or its numbers."""
    if image_format == "csv":
        return table(figure)
    from app.figures.drawing.image import draw  # noqa: PLC0415  only workers draw: half a second and 70 MB

    return draw(figure, image_format, theme)
