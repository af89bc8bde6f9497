"""In the figures of random cases, no text is cut off or lies over another text or a mark.

Numbers have the format of the tables, and the numbers of a bar are in order.
"""

import re
from collections.abc import Iterator
from itertools import combinations

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.text import Text
from matplotlib.transforms import Bbox

from app.calculations import CALCULATIONS, Calculation
from app.figures.data import Axis, Figure, NoFigure, Panel, Row
from app.figures.drawing.image import laid_out
from app.figures.drawing.panels import NUMBERS, RING
from app.figures.drawing.style import themed
from app.figures.wording import number
from tests.app.test_figure_labels import TOUCH, faults
from tests.support.drawn_cases import drawn_cases

pytestmark = pytest.mark.ci

CASES = 3  # of each of ten calculations
SEED = 46


def collisions(figure: Figure) -> Iterator[str]:
    """Yield a message for every collision in a figure.

    Collisions are texts that are cut off or overlap other texts or marks, legends inside the axes, and tick labels that
    overlap.
    """
    yield from faults(figure)
    with themed("light"):
        _, drawn = laid_out(figure)
        for axes in drawn:
            yield from _over_marks(axes)
            yield from _legend_over_curves(axes)
            yield from _ticks_over_each_other(axes)


def _over_marks(axes: Axes) -> Iterator[str]:
    """Yield a message for every text that overlaps the ring of a marked point."""
    rings = [line for line in axes.lines if line.get_marker() == "o" and not line.get_clip_on()]
    for ring in rings:
        (x, y), *_ = axes.transData.transform(np.asarray(ring.get_xydata()))
        box = Bbox([(x - RING / 2, y - RING / 2), (x + RING / 2, y + RING / 2)])
        for text in axes.texts:
            if text.get_text() and text.get_window_extent().overlaps(box):
                yield f"{text.get_text()!r} over a mark"


def _legend_over_curves(axes: Axes) -> Iterator[str]:
    legend = axes.get_legend()
    if legend is not None:
        shared = Bbox.intersection(legend.get_window_extent(), axes.bbox)
        if shared is not None and min(shared.width, shared.height) > TOUCH * axes.figure.dpi:
            yield "a legend lies over its curves"


def _ticks_over_each_other(axes: Axes) -> Iterator[str]:
    """Yield a message for every two tick labels that overlap, because they look like one number."""
    for labels in (axes.get_xticklabels(), axes.get_yticklabels()):
        shown = [text for text in labels if text.get_text() and text.get_visible()]
        for one, other in combinations(shown, 2):
            if one.get_window_extent().overlaps(other.get_window_extent()) and one.get_text() != other.get_text():
                yield f"the ticks {one.get_text()!r} and {other.get_text()!r} meet"


def figures(calculation: Calculation) -> Iterator[Figure]:
    for request, answer in drawn_cases(calculation, CASES, SEED):
        for declaration in calculation.figures:
            try:
                yield declaration.figure(request, answer)
            except NoFigure:
                continue


@pytest.mark.slow
@pytest.mark.parametrize("calculation", CALCULATIONS, ids=lambda each: each.path)
def test_nothing_collides_in_the_figures_of_drawn_cases(calculation: Calculation) -> None:
    drawn = 0
    found = []
    for figure in figures(calculation):
        drawn += 1
        found += [f"{figure.title}: {each}" for each in collisions(figure)]
    assert drawn >= CASES
    assert found == []


def test_ticks_and_tables_have_one_format_of_numbers() -> None:
    for value in (1e5, 123456.0, 0.25, 1e-5, 3.2e7, -4.0):
        assert NUMBERS(value, 0) == number(value, digits=6)
    for value, text in ((9999.0, "9999"), (10000.0, "10 000"), (21678.6, "21 679"), (-2e5, "−200 000")):
        assert number(value) == text
        assert NUMBERS(round(value), 0) == text


def test_the_numbers_of_a_bar_with_an_interval_are_in_order() -> None:
    rows = [Row("as described", 136.0, bounds=(120.0, 155.0)), Row("cold", 90.0, bounds=(60.0, 99.0))]
    panel = Panel(x=Axis("temperature", "°C"), y=Axis("case"), rows=rows)
    figure = Figure("two bars", [panel], title="bars with intervals")
    assert not [*collisions(figure)]
    with themed("light"):
        _, (axes,) = laid_out(figure)
        texts: list[Text] = [text for text in axes.texts if text.get_text()]
        for row in rows:
            assert row.bounds
            line = [text for text in texts if str(int(row.value)) in text.get_text() or "to" in text.get_text()]
            said = " ".join(text.get_text() for text in line)
            assert re.search(rf"{row.value:g} °C.*\({row.bounds[0]:g} to {row.bounds[1]:g}\)", said)
