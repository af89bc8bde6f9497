"""Figures: a declaration turns a request and its answer into data, and one package draws the data.

Order: data, wording, units -> declaration, parts, sketches -> models of the endpoints, studies, spectrum. `drawing` and
`tables` turn the data of any figure into bytes, `comparison` puts two cases into one figure.
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
    """Draw a figure as an image, or write its numbers as a table.

    Parameters
    ----------
    figure : Figure
        The data of the figure.
    image_format : {"svg", "png", "pdf", "csv"}
        Format of the image, or CSV for the table.
    theme : {"light", "dark"}
        Colours of the image.

    Returns
    -------
    bytes
        Content of the file.
    """
    if image_format == "csv":
        return table(figure)
    from app.figures.drawing.image import draw  # noqa: PLC0415  only workers draw; the import takes half a second and 70 MB

    return draw(figure, image_format, theme)
