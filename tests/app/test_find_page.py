"""The page of a search says its answer in a sentence, draws the curve, and links to the cases of the answers."""

import json
import re
from dataclasses import replace
from html import unescape
from typing import Any

import httpx
import numpy as np
import pytest

from app.calculations import BY_PATH
from app.figures.data import Axis, Mark, values
from app.figures.solving import sought
from app.figures.studies import Coordinate, Grid, answer, figures_of
from app.pages.cases import Asked
from app.pages.query import body_of
from app.pages.studies import page as pages
from app.pages.studies.found import Found
from app.pages.studies.page import output_choices, worst_ends
from app.pages.studies.solve_for import SolveForPage
from app.pages.studies.sweep import SweepPage
from app.schema.fields import leaf_at
from app.studies.points import solve_point
from app.studies.runner import Clock, Progress
from tests.support.pages import asked, asked_by, checked, fault_at, lines_of, opened, whole

COUPLING, PITTED = "pahl-axial-displacement", "starter-industrial-micropitting"
TORQUE, GRADE = "operation.torque_n_m", "lubricant.iso_vg"
FILM, THRUST, LIMIT = (
    "lubrication.load_capacity_coefficient",
    "axial_thrust.design_force_n",
    "axial_thrust.coaxial_limit_n",
)
S_LAMBDA = "micropitting.local.safety"


def result_of(found: Asked) -> tuple[SolveForPage, list[dict[str, Any]], str]:
    study = checked(SolveForPage, found)
    assert isinstance(study, SolveForPage)
    lines = lines_of(study)
    return study, lines, whole(study, lines)


def said(html: str) -> str:
    (sentence,) = re.findall(r'<p class="conclusion">(.*?)</p>', html)
    return str(sentence).replace("\u00a0", " ")


def buttons(html: str) -> dict[str, str]:
    return {text: address for address, text in re.findall(r'<a class="button" href="([^"]+)">([^<]+)</a>', html)}


def test_the_answer_opens_the_case_that_was_solved() -> None:
    study, lines, html = result_of(asked(COUPLING, x=TORQUE, wanted="10000"))
    assert said(html) == "Transmitted torque 3665 N m: the thrust to be held is 10 000 N there, and more beyond."
    (answer,) = lines[-1]["answers"]
    case = asked_by(buttons(html)["Open the case with 3665 N m"])
    alone = solve_point(study.study.question._replace(base=body_of(study.calculation.request, case.pairs)), {})
    assert alone.out == [answer["out"]]
    assert re.search(r'alt="Thrust to be held over transmitted torque\. 10.000.N at 3665.N m"', html)


@pytest.mark.ci
def test_the_script_knows_the_places_in_the_image_for_phones_too() -> None:
    html = result_of(asked(COUPLING, x=TORQUE, wanted="10000"))[2]
    study = json.loads(html.partition('data-study="')[2].partition('">')[0])
    assert len(study["narrow"]) == len(study["box"]) == 4
    assert study["narrow"] != study["box"]


def test_a_search_beyond_the_range_keeps_what_goes_along_with_the_case() -> None:
    along = {"rexs_file": "mill.rexs", "pair": "gears.module_mm=3"}
    html = result_of(asked(COUPLING, x=TORQUE, wanted="1e6", **along))[2]
    (address,) = [address for text, address in buttons(html).items() if text.startswith("Search from")]
    assert along.items() <= asked_by(address).views.items()


@pytest.mark.parametrize(
    ("views", "sentence"),
    [
        (
            {"x": TORQUE, "wanted": "1e6"},
            "No answer from 0 N m to 12 000 N m: the nearest thrust to be held is 32 744 N",
        ),
        (
            {"x": TORQUE, "goal": "least"},
            "Transmitted torque 0 N m: the thrust to be held is least there, 0 N, the lower end of the range.",
        ),
        (
            {"x": GRADE, "wanted": "1", "show": LIMIT},
            "The thrust limit of coaxial shafts does not depend on it: 8186 N at",
        ),
        (
            {"x": GRADE, "wanted": "0.1", "show": FILM},
            "ISO viscosity grade 1000 or more: the load capacity coefficient is",
        ),
        (
            {"x": "coupling.teeth", "wanted": "8000"},
            "Between number of teeth 53 and 54 the thrust to be held goes from 8032",
        ),
        ({"x": "lubricant.name", "wanted": "0.1", "show": FILM}, "Mobil SHC 636 is the thinnest: the load capacity"),
        (
            {
                "x": "operation.misalignment_deg",
                "x.from": "-6",
                "x.to": "6",
                "wanted": "300",
                "show": "axial_thrust.force_n",
            },
            "2 answers: misalignment −0.1169° and 0.1169°; the axial thrust is 300 N there, and above it in between.",
        ),
    ],
)
def test_the_answer_comes_first(views: dict[str, str], sentence: str) -> None:
    assert said(result_of(asked(COUPLING, **views))[2]).startswith(sentence)


def found_with(extreme: str | None = None, **end: Any) -> str:
    """Return the sentence about the last line of a search for a torque."""
    calculation = BY_PATH["/v1/coupling"]
    leaf, output = leaf_at(calculation.request, TORQUE), leaf_at(calculation.response, THRUST)
    assert leaf is not None
    assert output is not None
    header = {"find": {"min": 0.0, "max": 9.0, "scale": "linear"}, "equals": 5.0, "extreme": extreme}
    usual = {"answers": [], "crossings": [], "nearest": {"at": 1.0, "out": 2.0, "end": None}, "constant": False}
    return Found(leaf, output, header, usual | end).answer()


def test_jumps_and_gaps_are_no_answers() -> None:
    jump = {"kind": "jump", "between": [3.0, 3.0], "out": [1.0, 8.0]}
    assert found_with(crossings=[jump]) == (
        "No answer at transmitted torque 3 N m: the thrust to be held jumps there from 1 N to 8 N, past 5 N."
    )
    gap = {"kind": "gap", "between": [3.0, 4.0], "out": [1.0, 8.0]}
    assert found_with(crossings=[gap]) == "No solution between 3 N m and 4 N m, where the thrust to be held passes 5 N."
    assert found_with(nearest=None) == "No answer: no point of the range has a solution."


def test_a_curve_that_levels_off_is_not_followed_further() -> None:
    study = checked(SolveForPage, asked(COUPLING, x=TORQUE, wanted="5"))
    assert isinstance(study, SolveForPage)
    header = {"find": {"min": 0.0, "max": 100.0, "scale": "linear"}, "equals": 5.0, "extreme": None}
    nearest = {"at": 100.0, "out": 4.0, "end": "max"}
    end = {"answers": [], "crossings": [], "nearest": nearest, "constant": False}
    places = [0.0, 25.0, 50.0, 75.0, 100.0]
    flat, rising = (
        Found(
            study.leaf,
            study.output,
            header,
            end,
            [{"at": at, "out": [out]} for at, out in zip(places, outs, strict=True)],
        )
        for outs in ([0.0, 3.0, 3.9, 3.99, 4.0], [0.0, 1.0, 2.0, 3.0, 4.0])
    )
    assert flat.answer().endswith("the upper end of the range, where it levels off.")
    assert rising.answer().endswith("the upper end of the range.")
    assert (study._links(flat), len(study._links(rising))) == ([], 1)


def test_a_range_is_not_made_longer_through_zero() -> None:
    study = checked(SolveForPage, asked(COUPLING, x="operation.misalignment_deg", wanted="5"))
    assert isinstance(study, SolveForPage)
    header = {"find": {"min": 0.02, "max": 0.1, "scale": "linear"}, "equals": 5.0, "extreme": None}
    assert Found(study.leaf, study.output, header, {}).beyond("min") == (0.0, 0.02)


def test_more_beyond_an_end_is_said_only_where_the_field_permits_it() -> None:
    least, greatest = ({"at": at, "out": 2.0, "end": end} for at, end in ((0.0, "min"), (9.0, "max")))
    assert found_with("least", answers=[least], nearest=least).endswith("2 N, the lower end of the range.")
    told = found_with("greatest", answers=[greatest], nearest=greatest)
    assert told.endswith("2 N, the upper end of the range: it may be greater beyond.")


@pytest.mark.ci
def test_without_an_answer_the_search_goes_on_beyond_the_nearest_end() -> None:
    (further,) = buttons(result_of(asked(COUPLING, x=TORQUE, wanted="1e5"))[2]).items()
    assert further[0] == "Search from 12 000 to 48 000 N m"
    views = asked_by(further[1]).views
    assert (views["x"], views["x.from"], views["x.to"]) == (TORQUE, "12000", "48000")
    assert said(result_of(replace(asked(COUPLING), views=views))[2]).startswith("Transmitted torque 3")


@pytest.mark.parametrize(
    ("views", "control", "message"),
    [
        ({"x": "coupling", "wanted": "1"}, "x", "is a section"),
        ({"x": TORQUE, "x.from": "abc", "wanted": "1"}, "x.from", "number"),
        ({"x": TORQUE, "x.to": "1e99", "wanted": "1"}, "x.to", "out of range"),
        ({"x": TORQUE, "x.from": "0", "x.scale": "log", "wanted": "1"}, "x.from", "above zero"),
        ({"x": TORQUE, "x.count": "2", "goal": "least"}, "x.count", "permissible: 3 to 500"),
        ({"x": TORQUE}, "wanted", "give the value that the output shall have"),
        ({"x": TORQUE, "wanted": "much"}, "wanted", "number"),
        ({"x": TORQUE, "goal": "best"}, "goal", "least"),
        ({"x": TORQUE, "wanted": "1", "show": "axial_thrust"}, "show", "is a section"),
    ],
)
def test_what_is_refused_stands_at_its_control(views: dict[str, str], control: str, message: str) -> None:
    assert message in fault_at(opened(SolveForPage, asked(COUPLING, **views), 422), control)


def test_the_usual_value_is_well_above_a_lower_limit() -> None:
    study = checked(SolveForPage, asked(PITTED, x="load.power_kw", show=S_LAMBDA))
    assert study.study.body.equals == 2.0


@pytest.mark.ci
def test_over_the_grade_the_page_says_whose_stage_it_is_and_offers_both_ways_out() -> None:
    said_of = {"x": GRADE, "show": S_LAMBDA, "wanted": "1.2"}
    study, lines, html = result_of(asked(PITTED, **said_of))
    (crossing,) = lines[-1]["crossings"]
    assert said(html).startswith(f"ISO viscosity grade {crossing['between'][1]} or more: ")
    assert "Micropitting load stage 8 belongs to the oil of the case" in html
    links = buttons(html)
    named = asked_by(links["Compare oils with stages of their own"])
    assert (named.views["x"], named.views["show"]) == ("lubricant.name", S_LAMBDA)
    assert asked_by(links["Let the limits follow the stages"]).views["oil_tests"] == "by_stage"
    body = body_of(study.calculation.request, asked_by(study.address(study.study.overrides(1500))).pairs)
    thick = next(line for line in lines if line["type"] == "point" and line["at"] == 1500)
    assert solve_point(study.study.question._replace(base=body), {}).out == thick["out"]
    vary = checked(SweepPage, asked(PITTED, x=GRADE, show=S_LAMBDA, **{"x.from": "100", "x.to": "220"}))
    page = whole(vary, lines_of(vary))
    assert "belongs to the oil of the case; another oil fails at another stage. Yet here" in page
    held = asked_by(buttons(page)["Hold the limits of the case"])
    assert (held.path, held.views["oil_tests"]) == ("/scuffing/vary", "held")


@pytest.mark.ci
def test_named_oils_are_bars_and_open_with_their_own_stages() -> None:
    study, lines, html = result_of(asked(PITTED, x="lubricant.name", show=S_LAMBDA, wanted="1.2"))
    first = lines[1]
    body = body_of(study.calculation.request, asked_by(study.address(study.study.overrides(first["at"]))).pairs)
    assert body["lubricant"]["name"] == first["at"]
    assert solve_point(study.study.question._replace(base=body), {}).out == first["out"]
    assert re.search(r'alt="Safety factor against micropitting[^"]*, the thinnest oil first', html)


def test_the_worst_end_of_a_band_is_an_output() -> None:
    calculation = BY_PATH["/v1/scuffing"]
    (end,) = worst_ends(calculation).values()
    assert end.path == "heat.band.safety.0"
    labels = {choice.path: choice.label for choice in output_choices(calculation)}
    assert labels[end.path] == f"{labels['safety.blok_factor']} at the worst end"
    assert end.view.limit == 1.0


def test_the_curve_shows_the_wanted_value_and_both_lines_of_the_verdict() -> None:
    x = Coordinate(Axis("flow", "l/min"), values([1.0, 2.0, 3.0]), own=2.0)
    grid = Grid(x, None, Axis("safety"), values([0.5, None, 2.5]), greatest=True, limit=1.0, good=2.0)
    (panel,) = sought(grid, 1.2, [Mark(1.4, 1.2, "1.4 l/min")], (), "").panels
    assert [level.value for level in panel.levels] == [1.0, 2.0, 1.2, 2.0], "the last is the flow of the case"
    assert [level.limit for level in panel.levels] == [True, False, False, False]
    assert [mark.text for mark in panel.marks] == ["1.4 l/min"]


@pytest.mark.ci
def test_a_page_streams_its_search(client: httpx.Client) -> None:
    page = client.get(SolveForPage(asked(COUPLING, x=TORQUE, wanted="10000")).view(""))
    assert page.status_code == 200
    assert "Transmitted torque 3665 N m" in unescape(page.text).replace("\u00a0", " ")
    told = client.get(SolveForPage(asked(COUPLING, x=TORQUE, wanted="10000")).view(".ndjson"))
    assert told.text.count('"type":"end"') == 1


POWER = Coordinate(Axis("power", "kW"), values([1.0, 2.0, 3.0]))


@pytest.mark.ci
def test_a_sweep_shows_up_to_four_outputs() -> None:
    shows = {"show.2": LIMIT, "show.3": FILM, "show.4": "losses.friction_power_w"}
    study = checked(SweepPage, asked(COUPLING, x=TORQUE, **{"x.count": "3"}, **shows))
    lines = lines_of(study)
    assert [each["path"] for each in lines[0]["outputs"]] == [THRUST, *shows.values()]
    assert list(study.result(lines).figures) == ["curve", "curve-2", "curve-3", "curve-4"]
    html = whole(study, lines)
    assert said(html).startswith("The thrust to be held goes from ")
    for place, point in enumerate(lines[1:-1]):
        third = pages.file(study, lines, "curve-3", "csv").decode().splitlines()[place + 1]
        assert float(third.split(",")[1]) == point["out"][2]
    refused = opened(SweepPage, asked(COUPLING, x=TORQUE, **{"show.3": "axial_thrust"}), 422)
    assert "is a section" in fault_at(refused, "show.3")


def test_an_output_that_does_not_depend_on_the_field_is_said_in_words() -> None:
    flat = Grid(POWER, None, Axis("thrust", "N"), values([5.0, 5.0, 5.0]))
    assert answer(flat) == "The thrust does not depend on it: 5 N at every point."
    assert figures_of(flat)["curve"].finding == "5 N at every point"
    speed = Coordinate(Axis("speed"), values([1.0, 2.0]))
    of_power = Grid(POWER, speed, Axis("thrust"), values(np.array([[1.0, 1.0], [2.0, 2.0], [3.0, 3.0]])))
    assert answer(of_power).endswith(". It does not depend on the speed.")


def test_a_best_value_at_an_end_of_its_range_is_said() -> None:
    assert answer(Grid(POWER, None, Axis("loss"), values([1.0, 2.0, 3.0]))).endswith(
        "at power 1 kW, where its range ends."
    )
    assert "ends" not in answer(Grid(POWER, None, Axis("loss"), values([3.0, 1.0, 2.0])))
    speed = Coordinate(Axis("speed"), values([1.0, 2.0, 3.0]))
    both = Grid(POWER, speed, Axis("loss"), values(np.array([[3.0, 1.0, 2.0]] * 2 + [[4.0, 4.0, 4.0]])))
    assert answer(both).endswith("; the range of power ends there.")


def test_both_lines_of_the_verdict_are_drawn_where_they_are_near() -> None:
    safety = Grid(POWER, None, Axis("safety"), values([0.8, 1.4, 2.2]), greatest=True, limit=1.0, good=2.0)
    levels = figures_of(safety)["curve"].panels[0].levels
    assert [(level.value, level.limit, level.name) for level in levels] == [
        (1.0, True, "limit 1"),
        (2.0, False, "well above it: 2"),
    ]
    low = replace(safety, values=values([0.2, 0.3, 0.4]))
    assert [level.value for level in figures_of(low)["curve"].panels[0].levels] == [1.0]


def test_the_time_left_is_said_if_it_is_long() -> None:
    study = checked(SweepPage, asked(COUPLING, x=TORQUE))
    text = pages.drawn(study, [], Progress(3, 21, 42.0)).decode()
    assert "3 of 21 points, about 40 s left" in re.sub("<[^>]+>", "", text)
    assert "left" not in pages.drawn(study, [], Progress(3, 21)).decode().replace("left out", "")
    clock = Clock(100)
    assert clock.progress == Progress(0, 100)
    clock.done = 50
    assert clock.progress.left_s is None, "it takes less than five seconds"
    clock._started -= 10.0
    assert clock.progress.left_s == pytest.approx(10.0, abs=0.5)
    assert clock.line()["left_s"] == pytest.approx(10.0, abs=0.5)
    clock.total, clock.kept, clock.done = 2000, 1000, 1010
    assert clock.progress.left_s == pytest.approx(990.0, rel=0.05), "points that were kept took no time"


def test_a_search_that_ends_before_its_first_point_says_why() -> None:
    study = checked(SolveForPage, asked(COUPLING, x=TORQUE, wanted="10000"))
    lines = [study.study._header(), {"type": "error", "code": "lost", "message": "The power failed.", "done": 0}]
    assert "Ended after 0 of 21 points" in whole(study, lines)
    assert "The power failed." in whole(study, lines)
    assert "Ended after 25 of 29 points" in pages.drawn(study, lines, Progress(25, 29)).decode()
