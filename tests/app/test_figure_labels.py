"""Names of marked points stand at their own points."""

import re

import numpy as np
import pytest

from app.figures.data import Axis, Figure, Hue, Line, Map, Mark, Panel, ThemeName, values
from app.figures.drawing.image import draw
from app.figures.drawing.style import THEMES

X = np.linspace(0.0, 1.0, 41)
PEAK = 4.0 * X * (1.0 - X)
LOW, HIGH = values(1.0 + PEAK), values(1.0 + 1.2 * PEAK)
PANEL = Panel(
    x=Axis("place", magnitude=False),
    y=Axis("pressure"),
    lines=(Line("pinion", values(X), LOW), Line("wheel", values(X), HIGH, Hue.VERMILLION)),
    marks=(Mark(0.5, 2.0, "2.00"), Mark(0.45, 2.19, "2.19", Hue.VERMILLION)),
)


def texts(panel: Panel, theme: ThemeName = "light") -> dict[str, tuple[str, float]]:
    """Colour and height from the bottom of every text, by the text."""
    image = draw(Figure("", (panel,), title="two peaks"), "svg", theme).decode()
    found = re.findall(r'<text style="([^"]*)" x="[\d.]+" y="([\d.]+)"[^>]*>([^<]*)</text>', image)
    assert found
    return {text: (style.lower(), -float(y)) for style, y, text in found}


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_names_of_points_of_several_curves_have_their_hues(theme: ThemeName) -> None:
    found = texts(PANEL, theme)
    for mark in PANEL.marks:
        assert THEMES[theme].writing[mark.hue].lower() in found[mark.text][0]


def test_the_name_of_the_higher_point_is_the_higher_one() -> None:
    found = texts(PANEL)
    assert found["2.19"][1] > found["2.00"][1]


def test_the_name_of_a_single_curves_point_is_plain_ink() -> None:
    marks = (PANEL.marks[0],)
    found = texts(Panel(x=PANEL.x, y=PANEL.y, lines=PANEL.lines[:1], marks=marks))
    assert THEMES["light"].ink.lower() in found["2.00"][0]


def test_maps_side_by_side_name_a_common_ordinate_once() -> None:
    """The second name would meet that of the colours."""
    x = values(X[:5])
    chart = Map("gap between the unloaded flanks", "µm", x, x, values(np.outer(x, x)))
    first = Panel(x=Axis("face"), y=Axis("profile (0: A, 1: E)"), map=chart)
    other = Panel(x=Axis("face"), y=Axis("angle"), map=chart)
    for panels, count in (((first, first), 1), ((other, first), 1), ((first, other, first), 2)):
        image = draw(Figure("", panels, title="maps", beside=True), "svg").decode()
        assert image.count(">profile (0: A, 1: E)<") == count
