"""The page of a sweep reads the study from its query, draws the points, and links each point to its case.

If a study is refused, the message stands at the control that is wrong.
"""

import json
import re
from contextlib import nullcontext, suppress
from dataclasses import replace
from html import unescape
from io import BytesIO
from typing import Any

import httpx
import numpy as np
import pytest
from matplotlib.image import imread

from app.calculations import BY_PATH, CALCULATIONS, Calculation
from app.errors import InvalidBody, Unprocessable
from app.examples import examples
from app.figures import MEDIA_TYPES
from app.figures.data import Axis, values
from app.figures.drawing.image import draw, places
from app.figures.studies import MOST_CURVES, Coordinate, Grid, figures_of
from app.pages.cases import Asked
from app.pages.query import VIEW_NAMES, WRITTEN, body_of
from app.pages.studies import PAGES
from app.pages.studies import page as pages
from app.pages.studies.controls import field_choices
from app.pages.studies.corners import CornersPage
from app.pages.studies.design import DesignPage
from app.pages.studies.page import output_choices
from app.pages.studies.solve_for import SolveForPage
from app.pages.studies.spectrum import SpectrumPage
from app.pages.studies.sweep import SweepPage
from app.pages.study_kinds import control_names
from app.pages.study_links import STUDIES, StudyExample
from app.schema.fields import leaf_at, leaves
from app.sources import SHORT_SOURCES
from app.studies.point_sets import PointSet
from app.studies.points import Question, solve_point
from app.studies.runner import Line, point_line
from tests.support import pages as support
from tests.support.pages import DEADLINE_S, MOST, asked, asked_by, fault_at, html_of, opened, whole

COUPLING = "pahl-axial-displacement"
LOADS = "xue-pair-1-modified"
SLOPE, CROWNING = "modifications.helix_slope_um", "modifications.lead_crowning_um"
MAP = {"x": SLOPE, "x.from": "-20", "x.to": "20", "x.count": "3", "y": CROWNING, "y.from": "0", "y.to": "30"}
# One quick case of each endpoint that has one.
QUICK = (COUPLING, "pahl-sleeve-orbit", "pahl-recommended-crowning", "milian-table-1", "fzg-type-a")


def checked(found: Asked) -> tuple[SweepPage, PointSet]:
    study = support.checked(SweepPage, found)
    assert isinstance(study, SweepPage)
    return study, study.study.points


def varied(found: Asked, axis: int = 0) -> list[Any]:
    """Return the values along an axis of the sweep that a page asks for."""
    return list(checked(found)[1].axes[axis].values or ())


def total(found: Asked) -> int:
    return checked(found)[1].total


def solved(found: Asked) -> tuple[SweepPage, list[Line]]:
    study, points = checked(found)
    lines = [
        point_line(index, points.rows[index], solve_point(study.study.question, points.overrides(index)))
        for index in range(points.total)
    ]
    return study, [*json.loads(json.dumps(lines)), {"type": "end", "elapsed_s": 1.0}]


def study_of(example: StudyExample) -> Asked:
    found = asked_by(example.address)
    return replace(found, path=found.path.removesuffix(f"/{example.page}"))


def test_what_a_study_says_is_no_field_of_a_request() -> None:
    for calculation in CALCULATIONS:
        assert not (VIEW_NAMES | control_names()) & {leaf.path for leaf in leaves(calculation.request)}


def named(words: str) -> StudyExample:
    return next(each for each in STUDIES if words in each.title)


@pytest.mark.parametrize("example", STUDIES, ids=lambda each: each.title)
def test_every_study_to_start_from_is_one(example: StudyExample) -> None:
    kind = next(each for each in PAGES if each.link.name == example.page)
    page = pages.opened(kind, study_of(example), MOST, DEADLINE_S)
    assert page.status == 200
    assert page.page.study is not None
    assert page.tail.rstrip().endswith(b"</html>")


def test_every_endpoint_has_a_study_to_start_from() -> None:
    assert {each.calculation.path for each in STUDIES} == set(BY_PATH)


def test_the_crowning_that_forgives_is_a_map_of_17_by_11() -> None:
    slopes, crownings = (varied(study_of(named("forgives")), axis) for axis in (0, 1))
    assert (len(slopes), len(crownings)) == (17, 11)
    assert (slopes[0], slopes[-1]) == (-20.0, 20.0)


@pytest.mark.parametrize("calculation", CALCULATIONS, ids=lambda each: each.path)
@pytest.mark.ci
def test_numbers_are_varied_and_outputs_shown_by_their_names_alone(calculation: Calculation) -> None:
    """The name of a number is enough to vary this number, and the name of an output is enough to show this output."""
    # If the case has no value of the number, the service may ask for a range.
    found = asked(next(each.name for each in examples().values() if each.endpoint == calculation.path))
    choices = [choice.path for choice in field_choices(calculation, found.case, texts=False)]
    unused = found.calculation.request.model_validate(found.body).unused()
    with_values = [path for path in choices if case_value(found.case, path) and not unused.get(path)]
    for path in choices:
        with nullcontext() if path in with_values else suppress(Unprocessable, InvalidBody):
            assert total(replace(found, views={"x": path})) > 1, path
    for choice in output_choices(calculation):
        assert total(replace(found, views={"x": with_values[0], "show": choice.path}))


def case_value(case: dict[str, Any], path: str) -> Any:
    here: Any = case
    for part in path.split("."):
        here = here[int(part)] if isinstance(here, list) else (here or {}).get(part)
    return here


@pytest.mark.parametrize("name", QUICK)
def test_a_points_link_opens_the_case_that_was_solved(name: str) -> None:
    found = asked(name)
    choices = [choice.path for choice in field_choices(found.calculation, found.case, texts=False)]
    field = next(path for path in choices if path.endswith(("torque_n_m", "speed_rpm")))
    study, (*points, _) = solved(replace(found, views={"x": field, "x.count": "3"}))
    for index, point in enumerate(points):
        body = body_of(found.calculation.request, asked_by(study.point_address(index)).pairs)
        alone = solve_point(study.study.question._replace(base=body), {})
        assert alone.out == point["out"] != [None]


def test_a_link_of_a_field_that_excludes_others_leaves_them_out() -> None:
    torque = {"x": "load.pinion_torque_n_m", "x.from": "1000", "x.to": "2000"}
    study, _ = checked(asked("starter-industrial-scuffing", **torque))
    names = dict(asked_by(study.point_address(0)).pairs)
    assert "load.pinion_torque_n_m" in names
    assert "load.power_kw" not in names


def test_an_item_of_a_list_is_varied_and_opened() -> None:
    item = {"x": "coupling.pitch_errors_um.3", "x.from": "-20", "x.to": "20", "x.count": "3"}
    study, (*points, _) = solved(asked("starter-coupling-pitch-errors", **item))
    assert "refused" not in {point["status"] for point in points}
    body = body_of(BY_PATH["/v1/coupling"].request, asked_by(study.point_address(2)).pairs)
    assert body["coupling"]["pitch_errors_um"][3] == 20


def test_the_figures_numbers_are_the_points() -> None:
    study, lines = solved(asked(LOADS, **MAP, **{"y.count": "7"}, show="pressure.max_mpa"))
    found = np.array([line["out"][0] for line in lines[:-1]]).reshape(3, 7)
    maps, worst = (pages.file(study, lines, name, "csv").decode().splitlines() for name in ("map", "worst"))
    assert maps[0] == "helix crowning [µm],helix slope [µm],largest Hertzian pressure [MPa]"
    assert [float(line.split(",")[2]) for line in maps[1:]] == found.T.ravel().tolist()
    ends = [tuple(map(float, line.split(",")[1:3])) for line in worst[1:]]
    assert ends == list(zip(found.max(axis=0), found[1], strict=True)), "the worst, and that of the case's own slope"


@pytest.mark.ci
def test_the_best_point_is_the_one_of_the_sweeps_end(client: httpx.Client) -> None:
    study, _ = checked(asked(LOADS, **MAP, **{"y.count": "7"}))
    lines = [json.loads(line) for line in client.get(study.view(".ndjson")).text.splitlines()]
    page = whole(study, lines)
    best = lines[-1]["best"]
    assert f"at helix slope {best['at'][0]:g} µm, helix crowning {best['at'][1]:g} µm" in page.replace("\u00a0", " ")


def grid(*sizes: int, **more: Any) -> Grid:
    rng = np.random.default_rng(1)
    fields = [
        Coordinate(
            Axis(f"field {rank}", "mm", magnitude=False), values(np.linspace(-1, 1, size)), own=0.0, scatters=True
        )
        for rank, size in enumerate(sizes)
    ]
    return Grid(
        fields[0], fields[1] if len(fields) > 1 else None, Axis("output", "N"), values(rng.random(sizes)), **more
    )


@pytest.mark.parametrize(
    ("sizes", "names"),
    [((5,), ["curve"]), ((5, MOST_CURVES), ["family"]), ((5, MOST_CURVES + 1), ["map", "worst"])],
)
def test_one_field_is_a_curve_few_values_are_curves_more_are_a_map(sizes: tuple[int, ...], names: list[str]) -> None:
    assert list(figures_of(grid(*sizes))) == names


def test_nothing_vouches_for_a_row_with_a_point_without_solution() -> None:
    found = grid(5, 7)
    known = found.values.copy()
    known[2, 3] = np.nan
    figure = figures_of(Grid(found.x, found.y, found.output, values(known)))["worst"]
    assert np.flatnonzero(np.isnan(figure.panels[0].lines[0].y)).tolist() == [3]


@pytest.mark.parametrize("greatest", [False, True])
def test_the_worst_is_the_other_end_of_the_best(greatest: bool) -> None:
    found = grid(5, 7, greatest=greatest)
    line = figures_of(found)["worst"].panels[0].lines[0]
    ends = found.values.min(axis=0) if greatest else found.values.max(axis=0)
    assert line.y.tolist() == ends.tolist()
    assert found.best is not None
    assert found.values[found.best] == (found.values.max() if greatest else found.values.min())


@pytest.mark.parametrize("sizes", [(5,), (5, 3), (5, 7), (2,), (2, 7)])
@pytest.mark.ci
def test_figures_are_drawn_while_few_or_no_points_are_there(sizes: tuple[int, ...]) -> None:
    whole = grid(*sizes)
    for count in (0, 1, whole.values.size // 2):
        known = np.full(whole.values.size, np.nan)
        known[:count] = whole.values.ravel()[:count]
        part = Grid(whole.x, whole.y, whole.output, values(known.reshape(sizes)))
        assert all(draw(figure, "svg") for figure in figures_of(part).values())


def test_a_map_over_even_ratios_puts_its_points_where_the_axes_have_them() -> None:
    x = Coordinate(Axis("speed", log=True, magnitude=False, limits=(1.0, 100.0)), values([1.0, 10.0, 100.0]))
    y = Coordinate(Axis("load", magnitude=False), values(np.arange(8.0)))
    known = np.tile([[0.0], [1.0], [0.0]], (1, 8))
    figure = figures_of(Grid(x, y, Axis("output"), values(known)))["map"]
    image = imread(BytesIO(draw(figure, "png")))
    left, top, width, height = places(figure)[0].box
    row = image[round((top + 0.2 * height) * len(image))]
    start, stop = round(left * len(row)), round((left + width) * len(row))
    brightness = row[start:stop, :2].sum(axis=1)
    (brightest,) = np.nonzero(brightness > 1.5)  # yellow; white lines over blue are darker
    assert start + brightest.mean() == pytest.approx((start + stop) / 2, abs=0.02 * len(row))
    assert len(brightest) == pytest.approx((stop - start) / 2, rel=0.05)  # halfway to its neighbours


@pytest.mark.parametrize(
    ("said", "control", "message"),
    [
        ({"x": "coupling.tooth"}, "x", "there is no coupling.tooth"),
        ({"x": "coupling"}, "x", "is a section"),
        ({"x": "operation.arrangement"}, "x", "are not numbers"),
        ({"x": "operation.torque_n_m", "x.from": "abc"}, "x.from", "number"),
        ({"x": "operation.torque_n_m", "x.from": "1e400"}, "x.from", "finite"),
        ({"x": "operation.torque_n_m", "x.from": "5", "x.to": "5"}, "x.from", "must be different"),
        ({"x": "operation.torque_n_m", "x.from": "0", "x.scale": "log"}, "x.from", "above zero"),
        ({"x": "operation.torque_n_m", "x.scale": "cubic"}, "x.scale", "linear"),
        ({"x": "operation.torque_n_m", "x.count": "2501"}, "x.count", "the limit is 2500"),
        ({"x": "operation.torque_n_m", "x.count": "1.5"}, "x.count", "whole number"),
        ({"x": "operation.misalignment_deg", "x.to": "90"}, "x.to", "90 is out of range; permissible: -6 to 6"),
        ({"x": "operation.torque_n_m", "x.to": "1e99"}, "x.to", "torque: 1e+99 is out of range"),
        ({"x": "operation.torque_n_m", "x.from": "5", "x.to": "-5", "x.scale": "log"}, "x.to", "above zero"),
        ({"x": "operation.torque_n_m", "y": "operation.torque_n_m"}, "y", "varied already"),
        ({"x": "operation.torque_n_m", "show": "axial_thrust"}, "show", "is a section"),
        ({"x": "operation.torque_n_m", "show": "lubrication.regime.name"}, "show", "is not a number"),
        ({"x": "operation.torque_n_m", "best": "largest"}, "best", "'least' or 'greatest'"),
        ({"y": "operation.torque_n_m"}, "x", "choose the first field to vary before the second field"),
    ],
)
def test_what_is_refused_stands_at_its_control(said: dict[str, str], control: str, message: str) -> None:
    assert message in fault_at(opened(SweepPage, asked(COUPLING, **said), 422), control)


def test_a_fault_of_the_case_is_named_by_the_title_of_its_field() -> None:
    pairs = [(name, "-5" if name == "operation.torque_n_m" else text) for name, text in asked(COUPLING).pairs]
    wrong = replace(asked(COUPLING), pairs=pairs)
    said = {"x": "operation.misalignment_deg", "show": "axial_thrust.coaxial_limit_n"}
    study = opened(SweepPage, replace(wrong, views=said), 422)
    for html in (study, html_of(wrong, 422)):
        problem = re.search(r'<div class="problem".*?</div>', html, re.DOTALL)
        assert problem
        told = problem[0].replace("\u00a0", " ").replace("−", "-")
        assert "transmitted torque is -5; permissible: 0 to 100000000 N m" in told
    assert "torque_n_m" not in re.sub(r"<[^>]*>", "", study[study.index('class="problem"') :])


def test_a_decimal_comma_is_read() -> None:
    assert varied(asked(COUPLING, x="operation.misalignment_deg", **{"x.to": "0,1"}))[-1] == 0.1


@pytest.mark.parametrize(("count", "wanted"), [("3", [40, 45, 50]), ("21", list(range(40, 51)))])
def test_whole_numbers_are_varied_in_whole_steps(count: str, wanted: list[int]) -> None:
    said = {"x": "coupling.teeth", "x.from": "40", "x.to": "50", "x.count": count}
    assert varied(asked(COUPLING, **said)) == wanted


def test_words_make_a_family() -> None:
    said = {"x": "operation.misalignment_deg", "x.count": "3", "y": "operation.arrangement"}
    arrangement = leaf_at(BY_PATH["/v1/coupling"].request, "operation.arrangement")
    assert set(varied(asked(COUPLING, **said), axis=1)) == set(arrangement.options)


@pytest.mark.parametrize(
    "query",
    [
        "x=<script>alert(1)</script>&coupling.teeth=52",
        "x=operation.torque_n_m&show=<img src=x onerror=alert(1)>&coupling.teeth=52",
        'x=operation.torque_n_m&x.from="><script>&coupling.teeth=52',
        'x=operation.torque_n_m&theme="><script>&coupling.teeth="><script>',
        "x=" + "a." * 3000 + "b&coupling.teeth=52",
        "x=operation.torque_n_m&x.count=99999999999999999999999&coupling.teeth=52",
        "x=operation.torque_n_m&unknown=1",
        "coupling=1&coupling.teeth=52&x=operation.torque_n_m",
        "&".join(f"a{index}=1" for index in range(1500)),
    ],
)
def test_hostile_queries_get_a_clear_page(client: httpx.Client, query: str) -> None:
    answer = client.get(f"/coupling/vary?{query}", follow_redirects=True)
    assert 400 <= answer.status_code < 500
    assert "default-src 'self'" in answer.headers["content-security-policy"]
    body = answer.text.partition("<body>")[2]
    assert "<script" not in body
    assert "<img src=x" not in body
    assert body.rstrip().endswith("</html>")


@pytest.mark.ci
def test_a_page_grows_and_ends_with_the_same_points_as_its_files(client: httpx.Client) -> None:
    study, _ = checked(study_of(named("by axial velocity")))
    page = client.get(study.view(""))
    assert page.status_code == 200
    assert "244 points in" in page.text
    told = client.get(study.view(".ndjson"))
    points = [json.loads(line) for line in told.text.splitlines()][1:-1]
    data = json.loads(unescape(re.findall(r'data-study="([^"]+)"', page.text)[0]))
    assert data["out"] == [point["out"][0] for point in points if point["type"] == "point"]
    table = client.get(study.view(".csv"))
    assert table.headers["content-type"].startswith("text/csv")
    assert len(table.text.splitlines()) == 245


def test_empty_fields_are_dropped_by_a_redirect(client: httpx.Client) -> None:
    query = "coupling.teeth=52&coupling.module_mm=&x=operation.torque_n_m&y=&y.from="
    answer = client.get(f"/coupling/vary?{query}")
    assert answer.status_code == 303
    assert answer.headers["location"] == (
        f"/coupling/vary?coupling.teeth=52&x=operation.torque_n_m&sources={SHORT_SOURCES}"
    )


@pytest.mark.ci
def test_figures_are_files(client: httpx.Client) -> None:
    axes = {"x": "operation.misalignment_deg", "y": "operation.axial_velocity_mm_per_s"}
    links = SweepPage(asked(COUPLING, **axes, **{"x.count": "3", "y.count": "7"}))
    for image_format, kind in MEDIA_TYPES.items():
        answer = client.get(links.image("map", image_format))
        assert answer.headers["content-type"] == kind
        assert answer.content == client.get(links.image("map", image_format)).content
    for name, image_format in (("curve", "svg"), ("pie", "svg"), ("map", "gif")):
        assert client.get(links.image(name, image_format)).status_code == 404


def test_a_posted_study_is_the_same(client: httpx.Client) -> None:
    links = SweepPage(asked(COUPLING, x="operation.torque_n_m", **{"x.count": "3"}))
    path, _, query = links.view(".csv").partition("?")
    form = {"Content-Type": "application/x-www-form-urlencoded"}
    assert client.post(path, content=query, headers=form).content == client.get(links.view(".csv")).content


def test_ready_questions_on_the_page_of_a_case_are_asked_of_this_case() -> None:
    own = asked("xue-pair-3-modified")
    links = re.findall(r'<li><a href="([^"]+)">Which crowning forgives', unescape(opened(SweepPage, own)))
    question = asked_by(links[0])
    assert question.pairs == own.pairs
    assert [question.views[name] for name in ("x", "y", "x.count")] == [SLOPE, CROWNING, "17"]
    assert total(replace(question, path=own.path)) == 17 * 11


def test_the_result_links_the_map_of_safety_over_speed_and_power_of_its_case(client: httpx.Client) -> None:
    own = asked("starter-turbo-gear-drive-train")
    page = unescape(client.get(own.page).text)
    (link,) = re.findall(r'<a href="([^"]+)">How safe is it, over speed and power', page)
    question = asked_by(link)
    assert question.pairs == own.pairs
    varied = {name: text for name, text in question.views.items() if name[0] in "xy"}
    speed, power = "operation.pinion_speed_rpm", "operation.power_kw"
    assert varied == {"x": speed, "x.count": "9", "y": power, "y.count": "9"}, "around its own values"
    assert total(replace(question, path=own.path)) == 81


def test_a_map_marks_the_case_and_the_best_point() -> None:
    x = Coordinate(Axis("speed"), values([1.0, 2.0, 3.0]), own=2.0)
    y = Coordinate(Axis("power"), values(np.linspace(1.0, 3.0, 9)), own=2.5)
    safety = values(np.add.outer([1.0, 2.0, 3.0], np.arange(9.0)))
    (panel,) = figures_of(Grid(x, y, Axis("safety"), safety, greatest=True))["map"].panels
    assert [(mark.x, mark.y, mark.text) for mark in panel.marks] == [(3.0, 3.0, "11"), (2.0, 2.5, "as described")]


def test_the_names_of_a_study_are_those_of_its_form() -> None:
    varied_one, unit = asked(COUPLING, x="operation.torque_n_m"), asked("starter-turbo-gear-drive-train")
    scattering = asked(COUPLING, **{"t9": "friction.coefficient", "t9.by": "0.01"})
    double = asked("starter-turbo-double-helical")
    classed = replace(unit, pairs=[*unit.pairs, ("gears.quality_class", "5")])
    designs = ((DesignPage, unit), (DesignPage, double), (CornersPage, classed))
    oils = asked(
        "starter-industrial-micropitting", x="lubricant.iso_vg", show="micropitting.local.safety", wanted="1.2"
    )
    studies = ((SweepPage, varied_one), *designs, (SpectrumPage, scattering), (SolveForPage, oils))
    pattern = r'<(?:input|select|textarea)\b[^>]*?\bname="([^"]+)"'
    found = [set(re.findall(pattern, opened(page, case))) for page, case in studies]
    assert set.union(*found) >= control_names()
    for names, case in zip(found, (varied_one, unit, double, classed, scattering, oils), strict=True):
        assert names - control_names() == {WRITTEN, *dict(case.pairs)}


def test_a_curve_is_shaded_where_it_is_invalid_and_ringed_where_it_is_doubtful() -> None:
    x = Coordinate(Axis("speed", "1/min"), values([1.0, 2.0, 3.0, 4.0]))
    found = Grid(
        x,
        None,
        Axis("thrust", "N"),
        values([5.0, 6.0, None, 8.0]),
        invalid=(None, None, None, "edge contact"),
        doubtful=(False, True, True, False),
    )
    figure = figures_of(found)["curve"]
    panel = figure.panels[0]
    assert figure.finding.endswith("; orange rings: doubtful, outside a limit of validity")
    assert [(span.start, span.stop, span.name) for span in panel.spans] == [(4.0, 4.0, "edge contact")]
    assert [(mark.x, mark.y, mark.text) for mark in panel.marks if not mark.text] == [(2.0, 6.0, "")]


def test_points_of_a_study_tell_the_ranks_of_their_warnings() -> None:
    limits = examples()["starter-coupling-at-its-limits"]
    point = solve_point(Question(limits.endpoint, limits.request, ["axial_thrust.force_n"], 30.0), {})
    assert point_line(0, [], point)["warnings"] == ["edge_contact", "sliding_velocity"]
    assert point_line(0, [], point)["ranks"] == ("invalid", "doubtful")


def test_a_curve_says_where_it_crosses_its_limit() -> None:
    power = Coordinate(Axis("power", unit="kW"), np.array([100.0, 200.0, 300.0, 400.0]))
    safety = np.array([3.0, 2.0, 0.5, np.nan])
    figure = figures_of(Grid(power, None, Axis("safety"), safety, greatest=True, limit=1.0))["curve"]
    assert figure.finding == "crosses its limit at 267 kW; greatest 3 at power 100 kW, where its range ends"
    (crossing,) = [mark for mark in figure.panels[0].marks if mark.text == "267 kW"]
    assert crossing.x == pytest.approx(800.0 / 3.0)
    assert crossing.y == 1.0
    never = figures_of(Grid(power, None, Axis("safety"), safety, greatest=True, limit=0.1))["curve"]
    assert never.finding == "greatest 3 at power 100 kW, where its range ends"
