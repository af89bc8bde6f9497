"""Figures. The declaration of a figure turns a request and its answer into data; the package `drawing` draws the data.

The modules build on one another in this order: data, wording and units; then declaration, parts and sketches; then
models, studies and spectrum. `models` has one module for each model of the service. `drawing` turns the data of any
figure into an image, and `tables` writes the data as CSV. `comparison` puts the figures of two cases into one figure.
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
    """Draw a figure as an image, or write the numbers of the figure as a table."""
    if image_format == "csv":
        return table(figure)
    from app.figures.drawing.image import draw  # noqa: PLC0415  only workers draw; the import takes half a second and 70 MB

    return draw(figure, image_format, theme)
