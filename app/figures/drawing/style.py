"""The style of all figures: sizes, dashes, and what the sheets of matplotlib's settings beside this file leave out."""

from contextlib import AbstractContextManager
from typing import Any

from matplotlib import rcParams, style
from matplotlib.colors import to_hex, to_rgb

from app.figures.data import Hue, Role, ThemeName

WIDTH, NARROW = 5.6, 3.9  # inches, of a figure and of one in a column of a report
DPI = {"svg": 100, "png": 180, "pdf": 180}  # of the maps inside the vector formats too
TITLE, TEXT = 11.0, 8.5  # points; the texts of axes have 8, as the style sheet says
DASHES: dict[Role, Any] = {Role.RESULT: "solid", Role.REFERENCE: (0, (1.2, 1.8)), Role.VARIANT: (0, (4.5, 2.2))}
LIMIT = "C7"  # colour of limits


def themed(theme: ThemeName) -> AbstractContextManager[None]:
    """The settings of matplotlib under which a figure is laid out and written."""
    return style.context(["app.figures.drawing.figures", f"app.figures.drawing.{theme}"])


def written(hue: Hue) -> str:
    """The colour of a text in a hue: it goes so far towards plain ink that the contrast is at least 4.5."""
    own, ink = to_rgb(hue), to_rgb(rcParams["text.color"])
    red, green, blue = (0.6 * one + 0.4 * other for one, other in zip(own, ink, strict=True))
    return to_hex((red, green, blue))


def patch() -> dict[str, Any]:
    """The box of a text that lies over other things."""
    return {"facecolor": rcParams["figure.facecolor"], "alpha": 0.78, "linewidth": 0, "pad": 0.8}
