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
LETTER, LINE_HEIGHT = 0.58 * SMALL / 72.0, 1.3 * SMALL / 72.0  # inches: mean width of a character, height of a line
DASHES: dict[Role, Any] = {Role.RESULT: "solid", Role.REFERENCE: (0, (1.2, 1.8)), Role.VARIANT: (0, (4.5, 2.2))}
LIMIT_DASHES, REFERENCE_DASHES = (0, (5.0, 2.5)), (0, (1.0, 2.0))  # line widths on and off


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

    @property
    def patch(self) -> dict[str, Any]:
        """The box of a text that lies over other things."""
        return {"facecolor": self.background, "alpha": 0.78, "linewidth": 0, "pad": 0.8}

    def written(self, color: str) -> str:
        """The colour of the text about what is drawn in a colour."""
        return next((self.writing[hue] for hue, drawn in self.drawing.items() if drawn == color), color)


def _hues(*colours: str) -> dict[Hue, str]:
    """Shades of the hues of Okabe and Ito, in the order of `Hue`."""
    return dict(zip(Hue, colours, strict=True))


THEMES: dict[ThemeName, Theme] = {
    "light": Theme(
        *("#FFFFFF", "#1F2937", "#5B6472", "#9CA3AF", "#E5E7EB", "#E8ECF2", "#C22525"),
        drawing=_hues("#0072B2", "#D55E00", "#009E73", "#56B4E9", "#E69F00", "#CC79A7", "#6B7280"),
        writing=_hues("#0068A3", "#B34F00", "#00795A", "#1C74AC", "#8F6200", "#A64C7D", "#5B6472"),
    ),
    "dark": Theme(
        *("#12171F", "#E5E9F0", "#A3ADBB", "#5A6575", "#28303C", "#202936", "#FF7B72"),
        drawing=_hues("#3D9BDC", "#D55E00", "#1DB58A", "#9AD2F7", "#E69F00", "#CC79A7", "#9AA4B2"),
        writing=_hues("#5AAEE8", "#F08A3C", "#2CC79A", "#9AD2F7", "#F0B429", "#E19BC1", "#A3ADBB"),
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
