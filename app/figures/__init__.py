"""Figures: a declaration turns a request and its answer into data, one place draws the data.

Order: data, wording, units -> declaration, parts, sketches -> models of the endpoints, studies, spectrum; drawing and
tables make bytes of any of them; comparison puts two cases into one figure.
"""

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
    """The figure as an image, or its numbers as a table."""
    if image_format == "csv":
        return table(figure)
    from app.figures.drawing.image import draw  # noqa: PLC0415  only workers draw: half a second and 70 MB

    return draw(figure, image_format, theme)
