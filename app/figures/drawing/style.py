"""The house style: what every figure looks like on white and on black."""

from dataclasses import dataclass
from functools import cache
from typing import Any

from matplotlib.font_manager import FontProperties, findfont, get_font
from matplotlib.ft2font import LoadFlags

from app.figures.data import Hue, ThemeName

WIDTH = 6.4  # inches, as all lengths of a figure
DPI = 160
TITLE, TEXT, SMALL = 12.0, 8.8, 8.0  # points
POINT = 1.0 / 72.0
UNIT_SIZE = 100.0  # at which characters are measured
# Measured in the widest of them, which comes with matplotlib, so that no reader's substitute is cut.
FONTS = ("DejaVu Sans", "Verdana", "Segoe UI", "Helvetica Neue", "Arial", "sans-serif")

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
    """Colours; `writing` of a hue keeps a contrast of 4.5 on the background where its `drawing` does not."""

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


def settings(theme: Theme) -> Any:
    """Settings of matplotlib under which a figure is drawn and written."""
    return {
        "font.family": "sans-serif",
        "font.sans-serif": list(FONTS),
        "font.size": SMALL,
        "lines.linewidth": 1.7,
        "lines.solid_capstyle": "round",
        "lines.dash_capstyle": "butt",
        "text.parse_math": False,
        "text.color": theme.ink,
        "savefig.facecolor": theme.background,
        "savefig.edgecolor": "none",
        "svg.fonttype": "none",
        "svg.hashsalt": "tribodrive",
        "pdf.fonttype": 42,
        "image.composite_image": False,
    }


def text_width(text: str, size: float, *, bold: bool = False) -> float:
    """Width of the widest line of a text of `size` points, in inches."""
    widths = (sum(_advance(character, bold=bold) for character in line) for line in text.split("\n"))
    return max(widths) * size * POINT


@cache
def _advance(character: str, *, bold: bool) -> float:
    """Width of a character over the size of the font."""
    font = get_font(_font_file(bold=bold))
    font.set_size(UNIT_SIZE, 72.0)
    return float(font.load_char(ord(character), flags=LoadFlags.NO_HINTING).linearHoriAdvance) / 65536.0 / UNIT_SIZE


@cache
def _font_file(*, bold: bool) -> str:
    return str(findfont(FontProperties(family="DejaVu Sans", weight="bold" if bold else "normal")))


def text_height(text: str, size: float) -> float:
    """Height of a text of `size` points with its leading, in inches."""
    return (text.count("\n") + 1) * 1.2 * size * POINT


def wrapped(text: str, size: float, width: float, *, bold: bool = False) -> str:
    """The text broken between words, so that no line is wider than `width` inches where words allow."""
    lines = [""]
    for word in text.split(" "):
        longer = f"{lines[-1]} {word}".strip()
        if lines[-1] and text_width(longer, size, bold=bold) > width:
            lines.append(word)
        else:
            lines[-1] = longer
    return "\n".join(line.removesuffix(" ·") for line in lines)
