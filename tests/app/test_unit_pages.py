"""The pages of a gear unit's studies show the results of the studies, and their links lead to the named cases."""

import json
import re
from functools import cache
from html import unescape
from typing import Any

import httpx
import pytest

from app.calculations import BY_PATH
from app.figures.data import Hue
from app.figures.spectrum import chance_text
from app.pages.cases import Asked, solved
from app.pages.studies import page as pages
from app.pages.studies.corners import CornersPage
from app.pages.studies.design import HELICES, DesignPage
from app.pages.studies.page import StudyPage
from app.pages.studies.price import price_figures, price_remarks, price_tables, price_verdict
from app.pages.studies.sensitivity import SensitivityPage
from app.pages.study_links import study_links
from app.pages.typesetting import shown
from app.studies.price import coarsest
from app.studies.runner import Progress
from app.studies.uncertainty import LOAD
from tests.support.pages import asked, asked_by, checked, lines_of, opened, whole

UNIT, DOUBLE = "starter-generator-gear-drive-train", "starter-turbo-double-helical"
SAFETY, SLOPE = "safety.blok_flank", "modifications.helix_slope_um"


def small(**said: str) -> Asked:
    """Return the page of a gear unit with only two corners."""
    whole = asked(UNIT, **said)
    return Asked(whole.path, [*whole.pairs, ("effects.coupling", "false")], said)


@cache
def studied(page: type[StudyPage]) -> tuple[StudyPage, list[dict[str, Any]], str]:
    study = checked(page, small(trials="5", drawn="2") if page is DesignPage else asked(UNIT))
    lines = lines_of(study)
    return study, lines, whole(study, lines)


def rows_of(page: str, title: str) -> list[list[str]]:
    table = page.partition(f"<h2>{title}</h2>")[2].partition("</table>")[0].partition("<tbody>")[2]
    return [re.findall(r"<td[^>]*>(.*?)</td>", row) for row in table.split("</tr>") if "<td" in row]


def value_of(address: str, output: str) -> float:
    found = asked_by(address)
    group, name = output.split(".")
    return getattr(getattr(solved(found.calculation, found.pairs, None).response, group), name)


@pytest.mark.ci
def test_corners_name_both_ends_of_every_output_and_lead_there() -> None:
    _, lines, page = studied(CornersPage)
    extremes = {line["output"]: line for line in lines if line["type"] == "extremes"}
    outputs = {each["title"]: each["path"] for each in lines[0]["outputs"]}
    rows = rows_of(page, "Over all corners")
    assert {outputs[row[0]] for row in rows} == set(extremes) >= {SAFETY, "load.face_load_factor"}
    for title, _, *ends, _ in rows:
        for end, cell in zip(("min", "max"), ends, strict=True):
            address, text = re.findall(r'<a href="([^"]+)">([^<]+)</a>', cell)[0]
            value = extremes[outputs[title]][end]["value"]
            assert text == shown(value)
            if outputs[title] == SAFETY:
                assert value_of(address, SAFETY) == value


@pytest.mark.ci
def test_the_worst_corner_is_that_of_least_safety_and_its_load_is_drawn() -> None:
    study, lines, page = studied(CornersPage)
    points = [line for line in lines if line["type"] == "point"]
    worst = min(points, key=lambda line: line["out"][0])
    changed = next(line for line in lines if line["type"] == "extremes" and line["output"] == SAFETY)["min"]["at"]
    result = study.result(lines)
    assert set(result.figures) <= set(CornersPage.figures)
    assert [row[2] for row in rows_of(page, "The worst corner")] == [shown(value) for value in changed.values()]
    (panel,) = result.figures["corners"].panels
    assert [len(row.dots) for row in panel.rows] == [len(axis["values"]) for axis in lines[0]["axes"]]
    for row in panel.rows:
        assert min(dot.value for dot in row.dots) == worst["out"][0] == row.value
        assert [dot.value for dot in row.dots if dot.hue == Hue.VERMILLION] == [row.value]
    nominal = study.solved({}).response.safety.blok_flank
    assert [(level.value, level.vertical) for level in panel.levels] == [(nominal, True)]
    curves = result.figures["face-load"].panels[0].lines
    assert [(line.title, line.role) for line in curves] == [("worst corner", "result"), ("as described", "variant")]
    for line, changes in zip(curves, (changed, {}), strict=True):
        force = study.solved(changes).response.misalignment.curves.line_force_n_per_mm
        assert line.y.tolist() == force
    assert [lead.text for lead in result.leads] == ["Open the worst corner", "Its report", "What to grind"]
    assert value_of(result.leads[0].address, SAFETY) == worst["out"][0]
    assert result.leads[1].address.startswith("/drive-train/report?")


@pytest.mark.ci
def test_the_grinding_proposed_is_that_of_the_search_and_leads_to_its_case() -> None:
    study, lines, page = studied(DesignPage)
    end = lines[-1]
    assert end["evaluations"] == 5
    assert end["objective_best"] > end["objective_start"]
    wanted = end["rounded"]
    assert all((2.0 * value).is_integer() for value in wanted["at"].values())
    sheet = rows_of(page, "What to grind")
    assert [row[0] for row in sheet] == ["pinion", "pinion", "pinion", "wheel"]
    assert [row[4] for row in sheet] == [shown(abs(value), 4) for value in wanted["at"].values()]
    worst, nominal, by_class, fixed = rows_of(page, "What it brings")
    assert worst[1:3] == [shown(end["objective_start"]), shown(wanted["objective"])]
    grindings: tuple[dict[str, Any], ...] = ({}, wanted["at"])
    cases = [study.solved(at).response.safety.blok_flank for at in grindings]
    assert nominal[1:3] == [shown(each) for each in cases]
    assert ("With the inputs as described the result is worse" in page) == (cases[1] < cases[0])
    numbers = {row[0].partition(":")[0].partition(",")[0]: row[1] for row in rows_of(page, "Which number is which")}
    estimate = study.solved({}).response.misalignment.recommended_helix_slope_um
    assert numbers["first estimate"] == shown(estimate, 4)
    assert numbers["best at the worst corner"] == shown(end["best"][SLOPE], 4)
    assert numbers["to grind"] == shown(wanted["at"][SLOPE], 4)
    result = study.result(lines)
    order = ["price", "dominating", "lead", "face-load", "gap", "search"]
    assert list(result.figures) == order, "the search comes last"
    assert set(result.figures) == set(DesignPage.figures)
    reached = result.figures["search"].panels[0].lines[0].y.tolist()
    assert reached == [line["objective"] for line in lines if line["type"] == "trial"]
    pairs = dict(asked_by(result.leads[0].address).pairs)
    assert {path: float(pairs[path]) for path in wanted["at"]} == wanted["at"]
    assert result.leads[-1].address.startswith("/drive-train/corners?")
    at_worst = study.solved({**wanted["at"], **wanted["worst_corner"]}).response
    assert at_worst.safety.blok_flank == wanted["objective"]

    price = end["price"]
    own = next(row for row in price["classes"] if row["quality_class"] == price["reference_class"])
    assert by_class[1:3] == [chance_text(price["as_described"]), chance_text(own)]
    assert fixed[2] == chance_text(price["nominal"])


@pytest.mark.ci
def test_how_exactly_to_grind_is_said_first_with_its_numbers() -> None:
    study, lines, page = studied(DesignPage)
    price = lines[-1]["price"]
    result = study.result(lines)
    exact, *rows = rows_of(page, "How exactly to grind")
    assert exact[0] == "exact"
    assert exact[3] == chance_text(price["exact"])
    assert [row[0] for row in rows] == ["3", "4", "5", "6", "7"]
    assert [row[3] for row in rows] == [chance_text(row) for row in price["classes"]]
    found = price["coarsest_class"]
    assert result.answer.startswith("Not even class 3" if found is None else f"Class {found} is exact enough: ")
    if found is not None:
        wide = next(row["tolerances"]["helix_slope_um"] for row in price["classes"] if row["quality_class"] == found)
        assert rows_of(page, "What to grind")[0][5] == f"± {shown(wide, 3)}"


def priced(more: tuple[float | None, ...], chance: float = 0.04) -> dict[str, Any]:
    """A price with these additional costs of classes 3, 4, ...; None is a third, where exact flanks are safe."""

    def row(probability: float, **parts: Any) -> dict[str, Any]:
        own = {"probability": probability, "bounds": (probability, probability), "interval": None, "unsolved": 0.0}
        return {**own, "kinds": {"scuffing": own}, **parts}

    classes = [
        row(
            1 / 3 if each is None else chance * (1.0 + each),
            quality_class=3 + place,
            more=each,
            more_error=0.01 if each else each,
            enough=each is not None and each < 0.1,
            tolerances={"helix_slope_um": 7.0 + place, "profile_slope_um": 5.0},
        )
        for place, each in enumerate(more)
    ]
    found, is_open = coarsest(classes, 4)
    said: dict[str, Any] = {
        "machines": 64,
        "reference_class": 5,
        "coarsest_class": found,
        "undecided": is_open,
        "influences": [
            {"name": "helix slope", "paths": ["modifications.helix_slope_um"], "share": 0.6},
            {"name": "offset", "paths": ["couplings.0.offset_um.0"], "share": 0.3},
            {"name": "power", "paths": ["operation.power_kw"], "share": 0.1},
        ],
        "assumptions": [{"field": "operation.power_kw", "reason": LOAD}],
    }
    return {"exact": row(chance), "classes": classes, **said}


@pytest.mark.parametrize(
    ("more", "chance", "verdict"),
    [
        (
            (0.01, 0.05, 0.5),
            0.04,
            "Class 4 is exact enough: damage is 4.2 % probable, with exact flanks 4 %, because ±8 µm",
        ),
        (
            (0.2, 0.5),
            0.04,
            "Not even class 3 is enough: damage is 4.8 % probable, 20 % more than with exact flanks (4 %).",
        ),
        (
            (0.01, 0.2),
            0.14,
            (
                "Not safe however exactly it is ground: with exact flanks damage is 14 % probable. Change oil, relief "
                "or geometry first. Class 3 costs less than a tenth more."
            ),
        ),
        ((0.0, 0.0), 1e-13, "Any of these classes is enough: even with class 4 damage is below 0.001 % probable."),
        ((None, None), 0.0, "Not even class 3 is enough: damage is 33.3 % probable, with exact flanks 0 %."),
        ((0.0, None), 0.0, "Class 3 is exact enough: damage is 0 % probable, with exact flanks 0 %, because ±7 µm"),
    ],
)
def test_the_verdict_on_the_tolerance(more: tuple[float | None, ...], chance: float, verdict: str) -> None:
    found = priced(more, chance)
    assert price_verdict(found).startswith(verdict)
    assert price_figures(found)["price"].panels[0].rows[0].value == pytest.approx(100.0 * chance)
    assert price_tables(found)[0].rows[0][0] == "exact"
    assert price_tables(found)[0].note.endswith("Drawn are also offset, load.")
    assert not price_remarks(found)


def test_a_verdict_that_sampling_leaves_open_says_so() -> None:
    (remark,) = price_remarks(priced((0.02, 0.095)))
    assert "leaves open" in remark


@pytest.mark.ci
def test_the_sheet_names_the_end_where_material_is_removed() -> None:
    """The lead chart is lowest at the end that the grinding sheet names, for both signs of the helix slope."""
    # The other end of the chart is higher by the slope of 30 um.
    study, lines, _ = studied(DesignPage)
    for slope in (30.0, -30.0):
        end = {**lines[-1], "rounded": {**lines[-1]["rounded"], "at": {**lines[-1]["rounded"]["at"], SLOPE: slope}}}
        result = study.result([*lines[:-1], end])
        _, _, where, _, amount, *_ = map(str, result.first[0].rows[0])
        low, high = (float(text) for text in re.findall(r"Z = (\d+) mm", where))
        trace = result.figures["lead"].panels[0].lines[0]
        assert amount == "30"
        assert trace.x[trace.y.argmin()] == low
        assert trace.y[trace.x == low] - trace.y[trace.x == high] == pytest.approx(-30.0)


def test_two_helices_have_a_correction_each_and_the_thrust_counts() -> None:
    body = checked(DesignPage, asked(DOUBLE)).body()
    paths = [path for each in body["variables"] for path in each["path"]]
    assert [path for path in paths if "second_helix" in path] == list(HELICES[1])
    assert len(set(paths)) == 6
    offset, thrust = body["corners"]
    assert (thrust["path"], thrust["values"]) == ("couplings.0.thrust_fraction", [-1.0, 0.0, 1.0])
    assert len(offset["values"]) == 4


@pytest.mark.ci
def test_the_sheet_has_both_helices() -> None:
    """Each lead chart is lowest at the end that the sheet names for its helix."""
    said = {"trials": "1", "drawn": "1", "corner.thrust_fraction": "1", "corner.offset": "0 400"}
    start = asked(DOUBLE, **said)
    given = {"temperatures.bulk_c": "95", "effects.thermal": "false", HELICES[1][0]: "-6"}
    pairs = [pair for pair in start.pairs if not pair[0].startswith("cooling") and pair[0] not in given]
    study = checked(DesignPage, Asked(start.path, [*pairs, *given.items()], said))
    lines = lines_of(study)
    result = study.result(lines)
    sheet, *_ = result.first
    assert [str(row[0]) for row in sheet.rows] == [
        *["pinion, helix 1"] * 2,
        *["pinion, helix 2"] * 2,
        "pinion, both helices",
        "wheel, both helices",
    ]
    assert [str(sheet.rows[place][4]) for place in (0, 2)] == ["13", "6"]
    panels = result.figures["lead"].panels
    assert [panel.title for panel in panels] == ["helix 1", "helix 2"]
    for place, panel in enumerate(panels):
        deep, high = (float(text) for text in re.findall(r"Z = (\d+) mm", str(sheet.rows[2 * place][2])))
        trace = panel.lines[0]
        assert trace.y[trace.x == deep] < trace.y[trace.x == high]
    assert "outer end (Z = 320 mm) deeper" in str(sheet.rows[0][2])
    assert "end at the gap (Z = 490 mm) deeper" in str(sheet.rows[2][2]), "a slope of the other sign"


@pytest.mark.ci
def test_the_best_so_far_is_shown_while_the_search_runs_and_when_it_ends_early() -> None:
    study, lines, _ = studied(DesignPage)
    trials = [line for line in lines if line["type"] == "trial"]
    best = max(trials[:3], key=lambda line: line["objective"])
    error = {"type": "error", "code": "study_deadline", "message": "the study took longer than 1 s", "done": 9}
    for page in (pages.drawn(study, lines[:4], Progress(9, 12)), pages.drawn(study, [*lines[:4], error])):
        text = unescape(page.decode())
        *corrections, judged = rows_of(text, "Best so far")
        assert [row[2] for row in corrections] == [shown(value, 4) for value in best["at"].values()]
        assert judged[1:3] == [shown(trials[0]["objective"]), shown(best["objective"])]
        assert "Open the unit ground so" in text
        assert "Correction 3 of at most 5" in text
    running = pages.drawn(study, [], Progress(9, 12, 63.0)).decode()
    assert "9 of 12 points, about 65 s left" in re.sub("<[^>]+>", "", running)


def test_corners_are_those_typed_on_both_pages() -> None:
    said = {"corner.friction": "0,1; 0.2", "corner.offset": "0 300; 300 0", "corner.pinion_clearance": "140 120"}
    turbo = asked("starter-turbo-gear-drive-train", **said)
    for page, part, others in ((CornersPage, "ranges", 3), (DesignPage, "corners", 1)):
        body = checked(page, turbo).body()
        values = {str(axis["path"]): axis["values"] for axis in body[part]}
        assert values["couplings.0.friction.coefficient"] == [0.1, 0.2]
        assert values["['couplings.0.offset_um.0', 'couplings.0.offset_um.1']"] == [[0, 300], [300, 0]]
        assert [140, 120] in [each for axis in values.values() for each in axis]
        assert len(values) == 3 + others
        wrong = asked("starter-turbo-gear-drive-train", **{**said, "corner.friction": "0.1; 7"})
        assert '<a href="#f.corner.friction">Uncertain inputs, friction</a>' in opened(page, wrong, 422)


def test_ranges_and_trials_come_from_the_form() -> None:
    said = {"low.0": "-10", "high.0": "20,5", "trials": "7", "show": "load.face_load_factor"}
    body = checked(DesignPage, asked(UNIT, **said)).body()
    assert (body["judged_by"], body["tolerances"]) == ("worst_corner", {"count": 4, "replicates": 4})
    judged = checked(DesignPage, asked(UNIT, judged="probability", drawn="16")).body()
    assert (judged["judged_by"], judged["tolerances"]["count"]) == ("probability", 16)
    assert body["variables"][0] == {"path": ["modifications.helix_slope_um"], "min": -10, "max": 20.5, "step": 0.5}
    assert body["variables"][1]["max"] == 20.0
    assert (body["evaluations"], body["objective"], body["direction"]) == (7, "load.face_load_factor", "minimise")


@pytest.mark.parametrize(
    ("said", "control", "title"),
    [
        ({"trials": "many"}, "trials", "Search, corrections tried"),
        ({"drawn": "7"}, "drawn", "Search, machines drawn"),
        ({"judged": "luck"}, "judged", "Search, judged by"),
        ({"low.0": "5", "high.0": "1"}, "low.0", "Search, helix slope, from"),
        ({"high.1": "9999999"}, "high.1", "Search, crowning, to"),
        ({"show": "no.such"}, "show", "Show, output"),
    ],
)
def test_what_is_wrong_stands_at_its_control(said: dict[str, str], control: str, title: str) -> None:
    assert f'<a href="#f.{control}">{title}</a>' in opened(DesignPage, asked(UNIT, **said), 422)


@pytest.mark.parametrize("page", [CornersPage, DesignPage], ids=lambda page: page.link.name)
def test_a_unit_without_the_output_says_which_to_choose(page: type[StudyPage]) -> None:
    bare = small()
    without = Asked(bare.path, [pair for pair in bare.pairs if not pair[0].startswith("temperatures.scuffing")])
    study = checked(page, without)
    text = whole(study, lines_of(study))
    assert "choose another output" in text


@pytest.mark.parametrize("page", [SensitivityPage, CornersPage, DesignPage], ids=lambda page: page.link.name)
def test_a_study_that_breaks_off_says_why(page: type[StudyPage]) -> None:
    study = checked(page, asked(UNIT))
    text = pages.drawn(study, [{"type": "error", "code": "study_deadline", "message": "<b>too long</b>", "done": 3}])
    assert "&lt;b&gt;too long&lt;/b&gt;" in text.decode()


@pytest.mark.ci
def test_the_report_of_a_search_has_the_grinding_sheet() -> None:
    study, lines, page = studied(DesignPage)
    text = unescape(pages.report(study, lines, "").decode())
    captions = re.findall(r"<caption>([^<]*)</caption>", text)
    first, *_ = (place for place, title in enumerate(captions) if title == "What to grind")
    assert captions[first : first + 3] == ["What to grind", "How exactly to grind", "What it brings"]
    sheet = text.partition("<caption>What to grind</caption>")[2].partition("</table>")[0]
    for row in rows_of(page, "What to grind"):
        assert [cell for cell in row if f">{cell}</td>" not in sheet] == []
    assert "<p>Only the working flanks are corrected." in text


@pytest.mark.ci
def test_links_alone_lead_from_a_unit_to_its_worst_corner_and_to_what_to_grind(client: httpx.Client) -> None:
    page = unescape(client.get(small().page).text)
    for offer in study_links(BY_PATH["/v1/drive-train"]):
        assert f'href="{small().study(offer.name)}"' in page
    start = unescape(client.get("/drive-train/corners").text)
    assert f'href="{asked(UNIT).study("corners")}"' in start
    coupling = unescape(client.get("/coupling/corners", follow_redirects=False).text)
    assert "not found" in coupling.lower()
    found = client.get(small().study("corners"))
    assert found.status_code == 200
    assert found.text.rstrip().endswith("</html>")
    assert "Open the worst corner" in found.text
    assert "<script>" not in found.text


def test_lines_and_figures_by_their_addresses(client: httpx.Client) -> None:
    case = small()
    lines = [json.loads(line) for line in client.get(case.view("corners.ndjson")).text.splitlines()]
    assert [lines[0]["type"], lines[-1]["type"]] == ["corners", "end"]
    svg = client.get(case.view("corners/figures/corners.svg"))
    assert (svg.status_code, svg.headers["content-type"]) == (200, "image/svg+xml")
    assert svg.text.rstrip().endswith("</svg>")
    for nothing in ("other.svg", "corners.gif"):
        assert client.get(case.view(f"corners/figures/{nothing}")).status_code == 404
