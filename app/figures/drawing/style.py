"""The style of all figures: sizes, dashes and other settings that are not in the style sheets beside this file."""

from contextlib import AbstractContextManager
from typing import Any

from matplotlib import rcParams, style
from matplotlib.colors import to_hex, to_rgb

from app.figures.data import Hue, Role, ThemeName

WIDTH, NARROW = 5.6, 3.9  # inches; width of a figure, and of a figure in a column of a report
DPI = {"svg": 100, "png": 180, "pdf": 180}  # applies to maps inside the vector formats too
TITLE, TEXT = 11.0, 8.5  # letter sizes in points; the style sheet sets the size of the texts at axes
DASHES: dict[Role, Any] = {Role.RESULT: "solid", Role.REFERENCE: (0, (1.2, 1.8)), Role.VARIANT: (0, (4.5, 2.2))}
STROKES: tuple[Any, ...] = ("solid", (0, (5, 1)), (0, (5, 1, 1, 1)), (0, (2, 1)))  # results that share a hue
# References that one legend names.
REFERENCES: tuple[Any, ...] = (
    (0, (1.0, 2.0)),
    (0, (7.0, 2.0, 1.0, 2.0)),
    (0, (1.0, 1.0, 1.0, 4.0)),
    (0, (7.0, 2.0, 1.0, 2.0, 1.0, 2.0)),
)
LIMIT = "C7"  # colour of limits


def themed(theme: ThemeName) -> AbstractContextManager[None]:
    """Return a context with matplotlib's settings for a theme. Lay out and write figures in this context."""
    return style.context(["app.figures.drawing.figures", f"app.figures.drawing.{theme}"])


def written(hue: Hue) -> str:
    """Return the colour for a text about something that is drawn in `hue`.

    The hue is mixed with the text colour, so that the contrast to the background is at least 4.5.
    """
    own, ink = to_rgb(hue), to_rgb(rcParams["text.color"])
    red, green, blue = (0.6 * hue_part + 0.4 * ink_part for hue_part, ink_part in zip(own, ink, strict=True))
    return to_hex((red, green, blue))


def patch() -> dict[str, Any]:
    """Return the style of the box behind a text that lies over other parts of a figure."""
    return {"facecolor": rcParams["figure.facecolor"], "alpha": 0.78, "linewidth": 0, "pad": 0.8}
