"""Names stand at their points, no text is cut off or overlaps another text, and unusual data are drawn."""

import random
import re
from collections.abc import Iterator
from dataclasses import replace
from importlib.resources import files
from itertools import combinations, pairwise
from unittest.mock import patch

import numpy as np
import pytest
from matplotlib import rcParams
from matplotlib.backend_bases import RendererBase
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_hex
from matplotlib.text import Annotation, Text
from matplotlib.transforms import Bbox

from app.calculations import BY_PATH
from app.evaluate import evaluate
from app.examples import Example, examples
from app.figures.data import (
    Axis,
    Figure,
    Hue,
    Level,
    Line,
    Map,
    Mark,
    NoFigure,
    Panel,
    Ribbon,
    Row,
    Span,
    ThemeName,
    values,
)
from app.figures.drawing.image import draw, draw_for_report, laid_out, places
from app.figures.drawing.style import NARROW, themed, written
from app.figures.studies import Influence, corners, influence
from app.pages.charts import in_columns

pytestmark = pytest.mark.ci

X = np.linspace(0.0, 1.0, 41)
PEAK = 4.0 * X * (1.0 - X)
LOW, HIGH = values(1.0 + PEAK), values(1.0 + 1.2 * PEAK)
PANEL = Panel(
    x=Axis("place", magnitude=False),
    y=Axis("pressure"),
    lines=(Line("pinion", values(X), LOW), Line("wheel", values(X), HIGH, Hue.VERMILLION)),
    marks=(Mark(0.5, 2.0, "2.00"), Mark(0.45, 2.19, "2.19", Hue.VERMILLION)),
)


TOUCH = 0.025  # inches by which the boxes of two texts may meet: the room above and below their letters


def boxes(figure: Figure) -> tuple[list[tuple[str, Bbox]], Bbox]:
    """Return all texts of a figure with their bounding boxes, and the box of the sheet, in inches."""
    drawn: list[Text] = []

    def draw_text(text: Text, _: RendererBase) -> None:
        if text.get_visible() and text.get_text().strip():
            drawn.append(text)

    with themed("light"), patch.object(Text, "draw", draw_text):
        sheet, _ = laid_out(figure)
        renderer = FigureCanvasAgg(sheet).get_renderer()
        sheet.draw(renderer)
        inches = sheet.dpi_scale_trans.inverted()
        found = [(text.get_text(), Text.get_window_extent(text, renderer).transformed(inches)) for text in drawn]
        return found, sheet.bbox_inches


def faults(figure: Figure) -> Iterator[str]:
    """Yield a message for every text that is cut off, and for every two texts that overlap."""
    texts, sheet = boxes(figure)
    assert texts
    for text, box in texts:
        if not (box.x0 >= 0.0 and box.y0 >= 0.0 and box.x1 <= sheet.x1 and box.y1 <= sheet.y1):
            yield f"{text!r} is cut"
    for (text, box), (other, beside) in combinations(texts, 2):
        shared = Bbox.intersection(box, beside)
        if shared is not None and shared.width > TOUCH and shared.height > TOUCH:
            yield f"{text!r} over {other!r}"


def figures(example: Example) -> Iterator[Figure]:
    """Yield all figures of an example."""
    calculation = BY_PATH[example.endpoint]
    request = calculation.request.model_validate({**example.request, "detail": "fields"})
    answer = evaluate(calculation, request)
    for declaration in BY_PATH[example.endpoint].figures:
        try:
            yield declaration.figure(request, answer)
        except NoFigure:
            continue


def test_texts_of_a_printed_report_are_seven_points_high() -> None:
    style = files("app.pages").joinpath("templates", "report.css").read_text("utf-8")
    width = re.search(r"figure img\{width:(\d+)mm", style)
    assert width
    scale = float(width[1]) / 25.4 / NARROW
    with themed("light"):
        sheet, _ = laid_out(Figure("a finding", (PANEL,), title="two peaks", narrow=True))
        assert min(text.get_fontsize() for text in sheet.findobj(Text)) * scale >= 7.0


@pytest.mark.slow
@pytest.mark.parametrize("name", examples())
def test_no_text_of_an_example_is_cut_or_over_another(name: str) -> None:
    found = [fault for figure in figures(examples()[name]) for fault in faults(figure)]
    assert not found


def test_a_figure_in_a_column_of_a_report_has_no_collisions() -> None:
    """A figure that would have collisions in a column keeps its whole width."""
    figure = Figure("a finding", (PANEL,), title="two peaks")
    narrow, image = draw_for_report(figure)
    assert narrow.narrow
    assert not list(faults(narrow))
    assert image == draw(narrow, "svg")
    name = "a limit with a name that is far too long for the width of a column of a report, and then some"
    long = replace(PANEL, levels=(Level(1.5, name),))
    for wide in (Figure("a finding", (long,), title="two peaks"), replace(figure, beside=True)):
        assert draw_for_report(wide) == (wide, draw(wide, "svg"))


def test_figures_of_a_report_stand_in_pairs_of_about_the_same_height() -> None:
    wide = Figure("wide", (PANEL, PANEL), beside=True)
    others = [Figure(name, (PANEL,) * count) for name, count in (("a", 1), ("b", 2), ("c", 1), ("d", 2))]
    columns = in_columns([wide, *others])
    assert [figure.finding for figure, _ in columns] == ["a", "c", "b", "d", "wide"]
    assert [figure.narrow for figure, _ in columns] == [True, True, True, True, False]
    assert all(address.startswith("data:image/svg+xml;base64,") for _, address in columns)


@pytest.mark.parametrize("narrow", [False, True])
def test_numbers_of_neighbouring_ticks_keep_a_distance(narrow: bool) -> None:
    ticks = tuple(np.linspace(0.0, 1.0, 41).tolist())
    panel = replace(PANEL, x=replace(PANEL.x, ticks=ticks))
    texts, _ = boxes(Figure("a finding", (panel,), title="two peaks", narrow=narrow))
    numbers = sorted((box for text, box in texts if text.startswith("0.")), key=lambda box: box.x0)
    assert len(numbers) > 3
    assert all(right.x0 - left.x1 > 0.045 for left, right in pairwise(numbers))


def test_the_coupling_on_its_map_of_friction_hides_no_area() -> None:
    """No texts overlap, wherever the point of the coupling lies on the map."""
    example = examples()["starter-turbo-coupling"]
    (map_of_regimes,) = (each for each in figures(example) if each.title == "Friction regime of the coupling")
    (panel,) = map_of_regimes.panels
    choice = random.Random(1)
    for _ in range(16):
        overlap, capacity = 10 ** choice.uniform(-1.0, 1.0), 10 ** choice.uniform(-2.0, 1.0)
        mark = Mark(overlap, capacity, f"Pu = {overlap:.3g}\nTr = {capacity:.3g}")
        moved = replace(map_of_regimes, panels=(replace(panel, marks=(mark,)),))
        assert not list(faults(moved)), mark.text


def texts(panel: Panel, theme: ThemeName = "light") -> dict[str, tuple[str, float]]:
    """Return the style and the height (-y of the SVG) of every text in a panel. The keys are the texts."""
    image = draw(Figure("", (panel,), title="two peaks"), "svg", theme).decode()
    found = re.findall(r'<text style="([^"]*)" x="[\d.]+" y="([\d.]+)"[^>]*>([^<]*)</text>', image)
    assert found
    return {text: (style.lower(), -float(y)) for style, y, text in found}


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_names_of_points_of_several_curves_have_their_hues(theme: ThemeName) -> None:
    found = texts(PANEL, theme)
    with themed(theme):
        for mark in PANEL.marks:
            assert written(mark.hue) in found[mark.text][0]


def test_the_name_of_the_higher_point_is_the_higher_one() -> None:
    found = texts(PANEL)
    assert found["2.19"][1] > found["2.00"][1]


def test_the_name_of_a_single_curves_point_is_plain_ink() -> None:
    marks = (PANEL.marks[0],)
    found = texts(Panel(x=PANEL.x, y=PANEL.y, lines=PANEL.lines[:1], marks=marks))
    with themed("light"):
        assert rcParams["text.color"].lower() in found["2.00"][0]


def test_maps_side_by_side_name_a_common_ordinate_once() -> None:
    """Only the first map names a common ordinate. A second name would overlap the name of the colour bar."""
    x = values(X[:5])
    chart = Map("gap between the unloaded flanks", "µm", x, x, values(np.outer(x, x)))
    first = Panel(x=Axis("face"), y=Axis("profile (0: A, 1: E)"), map=chart)
    other = Panel(x=Axis("face"), y=Axis("angle"), map=chart)
    for panels, count in (((first, first), 1), ((other, first), 1), ((first, other, first), 2)):
        image = draw(Figure("", panels, title="maps", beside=True), "svg").decode()
        assert image.count(">profile (0: A, 1: E)<") == count


def test_rows_of_long_names_are_whole_and_have_a_dot_at_each_end() -> None:
    output = Axis("scuffing safety on the flank by Blok", symbol="S_B")
    steps = [
        Influence(f"radial clearance of the bearing {each}, wheel shaft", "15 µm", lowered, raised, 0.3)
        for each, (lowered, raised) in enumerate(((-0.2, 0.1), (0.1, -0.1), (-0.13, -0.13), (None, 0.05)))
    ]
    bars = influence(output, 2.19, steps)
    assert not list(faults(bars))
    (panel,) = bars.panels
    named = [[(dot.name, dot.value) for dot in row.dots if dot.name] for row in panel.rows]
    assert named == [[("−", -0.2), ("+", 0.1)], [("−", 0.1), ("+", -0.1)], [("±", -0.13)], [("+", 0.05)]]
    dots = [Row("165, 135 µm", 1.62, Hue.VERMILLION), Row("135, 165 µm", 1.87)]
    assert not list(faults(corners(output, [Row(each.name, 1.62, dots=dots) for each in steps], 2.19)))


def test_a_band_is_named_in_the_legend() -> None:
    band = Ribbon("contact", values(X), LOW, HIGH)
    panel = replace(PANEL, lines=PANEL.lines[:1], marks=(), ribbons=(band,))
    for narrow in (False, True):
        figure = Figure("a finding", (panel,), title="a band", narrow=narrow)
        assert {"pinion", "contact"} <= {text for text, _ in boxes(figure)[0]}
        assert not list(faults(figure))


def test_result_curves_of_one_hue_differ_by_their_dashes() -> None:
    lines = tuple(Line(f"bearing {each}", values(X), values(each + X), stroke=each) for each in range(4))
    panel = Panel(x=PANEL.x, y=PANEL.y, lines=lines)
    image = draw(Figure("", (panel,), title="bearings"), "svg").decode().lower()
    with themed("light"):
        hue = to_hex(Hue.BLUE)
    styles = [style for style in re.findall(r'style="([^"]*)"', image) if f"stroke: {hue}" in style]
    patterns = {"".join(re.findall(r"stroke-dasharray: [^;]*", style)) for style in styles}
    assert len(patterns) == 4


def leaders(panel: Panel) -> list[tuple[Annotation, float]]:
    """Return the texts of points that have a leader line, with the lengths of these lines [in]."""
    with themed("light"):
        _, (axes,) = laid_out(Figure("", (panel,), title="two peaks"))
        annotations = [text for text in axes.texts if isinstance(text, Annotation) and text.arrow_patch is not None]
        return [(text, float(np.hypot(*text.get_position())) / 72.0) for text in annotations]


def test_a_line_leads_to_the_text_of_a_point_only_where_it_stands_far_from_the_point() -> None:
    """A text far from its point has a leader line. Here 25 lines leave no room near the point."""
    assert not leaders(PANEL)
    crowd = tuple(Line("a", values(X), values(level + 0.0 * X), Hue.GREY) for level in np.linspace(0.0, 2.4, 25))
    found = leaders(replace(PANEL, lines=crowd, marks=(Mark(0.5, 1.2, "1.2"),), y=Axis("load", limits=(0.0, 4.0))))
    assert len(found) == 1
    ((text, length),) = found
    assert text.xy == (0.5, 1.2)
    assert length > 0.16


def test_texts_are_placed_on_the_axes_that_are_drawn() -> None:
    """Equal scales widen one of the axes before the texts are placed. Drawing does not change the limits any more."""
    angle = np.linspace(0.0, 2.0 * np.pi, 73)
    circle = Line("path", values(np.cos(angle)), values(np.sin(angle)))
    panel = Panel(x=Axis("x", magnitude=False), y=Axis("y", magnitude=False), lines=(circle,), equal=True)
    with themed("light"):
        sheet, (axes,) = laid_out(Figure("", (panel,), title="orbit"))
        before = axes.get_xlim(), axes.get_ylim()
        sheet.draw_without_rendering()
        assert (axes.get_xlim(), axes.get_ylim()) == before


def test_numbers_of_a_finding_keep_their_units_at_a_line_break() -> None:
    figure = Figure("from 4 to 12 000 N, K_Hβ = 1.2", (PANEL,), source="ISO 21771")
    assert figure.subtitle.split(" ") == [
        "from",
        "4\u00a0to",
        "12\u00a0000\u00a0N,",
        "K_Hβ\u00a0=\u00a01.2\u00a0·",
        "ISO\u00a021771",
    ]


ONES = values([1.0, 1.0, 1.0])
THIRDS = values([0.0, 0.5, 1.0])
UNSOLVED = values([None, None, None])
AWKWARD = {
    "no panel": (),
    "zeros": (Panel(x=PANEL.x, y=PANEL.y, lines=(Line("a", THIRDS, 0.0 * ONES),)),),
    "no point": (Panel(x=PANEL.x, y=Axis("load", log=True), lines=(Line("a", THIRDS, UNSOLVED),)),),
    "rounding errors": (Panel(x=PANEL.x, y=Axis("k", magnitude=False), lines=(Line("a", THIRDS, ONES + 1e-15),)),),
    "six long names": (
        replace(
            PANEL, lines=tuple(Line(f"a line with a rather long name {each}", THIRDS, each * ONES) for each in range(6))
        ),
    ),
    "rows of zero": (Panel(x=Axis("loss", "W"), y=Axis("part"), rows=(Row("mesh", 0.0), Row("bearings", 0.0))),),
    "negative rows": (
        Panel(x=Axis("loss", "W"), y=Axis("part"), rows=(Row("mesh", -2e9), Row("fan", -1.0, bounds=(-3.0, 2.0)))),
    ),
    "map of one point": (
        Panel(x=PANEL.x, y=PANEL.y, map=Map("pressure", "MPa", ONES[:1], ONES[:1], values([2.0]).reshape(1, 1))),
    ),
    "map without a point": (
        Panel(x=PANEL.x, y=PANEL.y, map=Map("pressure", "MPa", THIRDS, THIRDS, np.full((3, 3), np.nan))),
    ),
    "markup": (replace(PANEL, lines=(Line("$\\alpha$ <b>&", THIRDS, ONES),)),),
}


@pytest.mark.parametrize("name", AWKWARD)
def test_awkward_data_are_drawn(name: str) -> None:
    figure = Figure("a finding <&> $x$", AWKWARD[name], title=name)
    for image_format, begins in (("svg", b"<?xml"), ("png", b"\x89PNG"), ("pdf", b"%PDF")):
        assert draw(figure, image_format).startswith(begins)
    for place in places(figure):
        assert np.isfinite([*place.box, *place.x, *place.y]).all()
    placed, image = draw_for_report(figure)
    assert image == draw(placed, "svg")


def test_limits_far_from_the_values_are_named_below_the_title() -> None:
    """A limit far from the values is named below the title. An axis up to this limit would flatten the curve."""
    levels = (Level(300.0, "yield point", limit=True), Level(3.0, "endurance limit", limit=True))
    panel = replace(PANEL, levels=levels, marks=())
    (place,) = places(Figure("", (panel,), title="two peaks"))
    assert 3.0 < place.y[1] < 4.0
    assert {"off the scale: yield point", "endurance limit"} <= {*texts(panel)}


def test_names_of_points_stand_in_one_row_above_the_axes_and_do_not_touch() -> None:
    at = {"A": 0.0, "B": 0.4, "C": 0.405, "D": 0.41, "E": 1.0}
    levels = tuple(Level(value, name, vertical=True, point=True) for name, value in at.items())
    with themed("light"):
        _, (axes,) = laid_out(Figure("", (replace(PANEL, levels=levels),), title="two peaks"))
        found = {text.get_text(): text.get_window_extent() for text in axes.texts if text.get_text() in at}
        lines = {name: axes.transData.transform((value, 0.0))[0] for name, value in at.items()}
    assert len({round(box.y0, 6) for box in found.values()}) == 1
    assert all(box.y0 > axes.bbox.y1 for box in found.values())
    assert all(one.x1 < other.x0 for one, other in pairwise(found[name] for name in at))
    for name in "ACE":
        assert (found[name].x0 + found[name].x1) / 2 == pytest.approx(lines[name], abs=0.5)


def test_levels_in_the_legend_differ_by_their_dashes() -> None:
    """A level that is off the scale is not in the legend."""
    levels = (Level(1.0, "standard", listed=True), Level(1.5, "mean", listed=True), Level(300.0, "far", listed=True))
    panel = replace(PANEL, levels=levels, spans=(Span(0.0, 0.2, "outside validity", listed=True),))
    with themed("light"):
        _, (axes,) = laid_out(Figure("", (panel,), title="two peaks"))
    legend = axes.get_legend()
    assert legend is not None
    assert {"standard", "mean", "outside validity"} < (names := {text.get_text() for text in legend.get_texts()})
    assert "far" not in names
    drawn = {line.get_label(): line._dash_pattern for line in axes.lines}  # type: ignore[attr-defined]
    assert drawn["standard"] != drawn["mean"]


def test_a_logarithmic_axis_within_a_decade_has_numbers_to_read() -> None:
    x = values(np.geomspace(3.0, 30.0, 9))
    found = texts(Panel(x=Axis("speed", log=True, limits=(3.0, 30.0)), y=PANEL.y, lines=(Line("a", x, x),)))
    assert {"5", "10", "20"} <= {*found}
