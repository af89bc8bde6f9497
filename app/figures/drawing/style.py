"""The style of all figures: sizes, colours on a light and on a dark background, matplotlib's settings."""

from dataclasses import dataclass
from functools import cache
from importlib.resources import as_file, files
from typing import Any

from matplotlib import rc_params_from_file

from app.figures.data import Hue, Role, ThemeName

WIDTH = 5.6  # inches
DPI = {"svg": 100, "png": 180, "pdf": 180}  # of the maps inside the vector formats too
TITLE, TEXT, SMALL = 11.0, 8.5, 8.0  # points; the texts of axes, as the style sheet has it, are small
LETTER = 0.58 * SMALL / 72.0  # mean width of a character, in inches
LINE_HEIGHT = 1.3 * SMALL / 72.0  # inches
DASHES: dict[Role, Any] = {Role.RESULT: "solid", Role.REFERENCE: (0, (1.2, 1.8)), Role.VARIANT: (0, (4.5, 2.2))}
LIMIT_DASHES, REFERENCE_DASHES = (0, (5.0, 2.5)), (0, (1.0, 2.0))

OKABE_ITO = {
    Hue.BLUE: "#0072B2",
    Hue.VERMILLION: "#D55E00",
    Hue.GREEN: "#009E73",
    Hue.SKY: "#56B4E9",
    Hue.ORANGE: "#E69F00",
    Hue.PURPLE: "#CC79A7",
    Hue.GREY: "#6B7280",
}


@dataclass(frozen=True, slots=True)
class Theme:
    """Colours; `writing` of a hue has a contrast of at least 4.5 on the background where its `drawing` has not."""

    background: str
    ink: str
    muted: str
    frame: str
    grid: str
    shade: str
    limit: str
    drawing: dict[Hue, str]
    writing: dict[Hue, str]


THEMES: dict[ThemeName, Theme] = {
    "light": Theme(
        background="#FFFFFF",
        ink="#1F2937",
        muted="#5B6472",
        frame="#9CA3AF",
        grid="#E5E7EB",
        shade="#E8ECF2",
        limit="#C22525",
        drawing=OKABE_ITO,
        writing={
            Hue.BLUE: "#0068A3",
            Hue.VERMILLION: "#B34F00",
            Hue.GREEN: "#00795A",
            Hue.SKY: "#1C74AC",
            Hue.ORANGE: "#8F6200",
            Hue.PURPLE: "#A64C7D",
            Hue.GREY: "#5B6472",
        },
    ),
    "dark": Theme(
        background="#12171F",
        ink="#E5E9F0",
        muted="#A3ADBB",
        frame="#5A6575",
        grid="#28303C",
        shade="#202936",
        limit="#FF7B72",
        drawing=OKABE_ITO | {Hue.BLUE: "#3D9BDC", Hue.SKY: "#9AD2F7", Hue.GREY: "#9AA4B2", Hue.GREEN: "#1DB58A"},
        writing={
            Hue.BLUE: "#5AAEE8",
            Hue.VERMILLION: "#F08A3C",
            Hue.GREEN: "#2CC79A",
            Hue.SKY: "#9AD2F7",
            Hue.ORANGE: "#F0B429",
            Hue.PURPLE: "#E19BC1",
            Hue.GREY: "#A3ADBB",
        },
    ),
}


@cache
def settings(theme_name: ThemeName) -> dict[Any, Any]:
    """The settings of matplotlib under which a figure is drawn and written."""
    theme = THEMES[theme_name]
    with as_file(files("app.figures.drawing") / "figures.mplstyle") as path:
        found = dict(rc_params_from_file(path, use_default_template=False))
    found |= dict.fromkeys(("axes.edgecolor", "xtick.color", "ytick.color"), theme.frame)
    found |= dict.fromkeys(("axes.labelcolor", "xtick.labelcolor", "ytick.labelcolor"), theme.muted)
    found |= dict.fromkeys(("figure.facecolor", "savefig.facecolor"), theme.background)
    return found | {"text.color": theme.ink, "grid.color": theme.grid}
