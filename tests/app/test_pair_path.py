"""A gear pair goes from page to page: is it safe, is it choked, on typical shafts, what to grind, one report of all."""

import re
from html import unescape
from math import pi
from types import SimpleNamespace
from typing import Any

import httpx
import pytest
from hypothesis import strategies as st

from app.calculations import BY_PATH
from app.examples import examples as starters
from app.models.drive_train.typical import (
    LEAST_SHARE,
    MOST_SHARE,
    MOST_WIDTH,
    PRESSURE,
    RULES,
    SHAFT_END,
    SHEAR,
    WIDTH,
    typical_unit,
)
from app.pages import views
from app.pages.carried import carried_to, offers
from app.pages.cases import Asked
from app.pages.overview import new_pair_page
from app.pages.pair_path import ENTRY, TRAIN, WITH_PAIR, Step, assumed_of, path_of, template, with_typical
from app.pages.pair_report import _sheet, _step, others_of, report_of
from app.pages.query import body_of, pairs_of
from app.schema.reading import validated
from solvers.gears.inputs import GearPairInputs, GearTeeth
from tests.support.pages import asked, asked_by, html_of
from tests.support.properties import examples
from tests.support.requests import changed

PAIR = "starter-turbo-pair-heat"


def steps_of(found: Asked) -> dict[str, Step]:
    return {step.question: step for step in path_of(found)}


def train_of(found: Asked) -> Asked:
    return asked_by(steps_of(found)["On shafts"].address)


@st.composite
def turbo_pairs(draw: st.DrawFn) -> dict[str, Any]:
    """Draw gears and load of a drive-train request: single or double helical, small and large, slow and fast."""
    pinion = draw(st.integers(15, 80))
    gears = {
        "pinion": {"teeth": pinion},
        "wheel": {"teeth": draw(st.integers(15, 200))},
        "module_mm": draw(st.sampled_from([0.8, 1.5, 3.0, 6.0, 12.0])),
        "helix_angle_deg": draw(st.sampled_from([0.0, 11.5, 28.0])),
    }
    gears["face_width_mm"] = round(gears["module_mm"] * pinion * draw(st.floats(0.3, 1.2)), 1)
    if gears["helix_angle_deg"] > 20.0:
        gears["gap_width_mm"] = 60.0
    operation = {"power_kw": draw(st.floats(0.0, 50.0)) * gears["module_mm"] ** 3, "pinion_speed_rpm": 10000.0}
    return {"gears": gears, "operation": operation}


@examples(10, 200, turbo_pairs())
def test_typical_shafts_are_a_unit_that_the_drive_train_takes(basis: dict[str, Any]) -> None:
    filled = template(pairs_of(basis))
    body = body_of(BY_PATH[TRAIN].request, [*pairs_of(basis), *pairs_of({name: v.value for name, v in filled.items()})])
    body["lubricant"] = {"iso_vg": 46}
    inputs = validated(BY_PATH[TRAIN].request, body).inputs()
    face_end = inputs.face_start + inputs.mesh.distribution.gears.total_width
    for shaft in inputs.shafts:
        first, second = shaft.bearings
        assert first.position + first.width / 2 < inputs.face_start
        assert face_end < second.position - second.width / 2
        assert shaft.start - 1e-9 <= shaft.torque_position <= shaft.end + 1e-9
        assert all(bearing.width / bearing.diameter >= WIDTH - 1e-9 for bearing in shaft.bearings)
        assert all(bearing.width / bearing.diameter <= MOST_WIDTH + 1e-9 for bearing in shaft.bearings)
    assert {value.rule for value in filled.values()} < set(RULES)


def test_a_bearing_of_the_smallest_shaft_is_not_wider_than_its_rule_permits() -> None:
    gears = GearPairInputs(GearTeeth(15), GearTeeth(60), 0.8e-3, 8e-3, rack_tip_radius=0.25)
    unit = typical_unit(gears, 20.0)
    journal, width = (unit[f"pinion_shaft.bearings.0.{name}_mm"].value for name in ("diameter", "width"))
    assert WIDTH * journal < width <= MOST_WIDTH * journal


@pytest.mark.parametrize("power_kw", [100.0, 2000.0, 12000.0, 20000.0])
def test_a_shaft_end_carries_the_torque_that_its_journal_carries(power_kw: float) -> None:
    gears = GearPairInputs(GearTeeth(39), GearTeeth(130), 6e-3, 0.2, helix_angle=0.2, rack_tip_radius=0.25)
    torque = 1e3 * power_kw / (10000 * pi / 30)
    unit = typical_unit(gears, torque)
    for shaft, place, own in (("pinion_shaft", 0, torque), ("wheel_shaft", 5, torque * 130 / 39)):
        journal = unit[f"{shaft}.bearings.0.diameter_mm"].value
        end = unit[f"{shaft}.sections.{place}.outer_diameter_mm"]
        assert end.rule == "end"
        assert SHAFT_END * journal <= end.value <= journal
        assert 16e3 * own / (pi * end.value**3) <= SHEAR or end.value == journal


@pytest.mark.parametrize("power_kw", [2000.0, 12000.0, 20000.0])
def test_journals_keep_their_rules(power_kw: float) -> None:
    gears = GearPairInputs(GearTeeth(39), GearTeeth(130), 6e-3, 0.2, helix_angle=0.2, rack_tip_radius=0.25)
    torque = 1e3 * power_kw / (10000 * pi / 30)
    unit = typical_unit(gears, torque)
    reference = 39 * 6 / 0.9800665778
    force = 2e3 * torque / (reference * 0.9396926)
    for shaft, own in (("pinion_shaft", torque), ("wheel_shaft", torque * 130 / 39)):
        journal, width = (unit[f"{shaft}.bearings.0.{name}_mm"].value for name in ("diameter", "width"))
        diameter = reference * (1.0 if shaft == "pinion_shaft" else 130 / 39)
        bound = MOST_SHARE * (diameter - 15)
        assert LEAST_SHARE * diameter <= journal <= bound
        at_bound = journal >= bound - 1.0
        assert 16e3 * own / (pi * journal**3) <= SHEAR or at_bound
        assert force / (2 * journal * width) <= PRESSURE * (1 + 1e-9) or width >= MOST_WIDTH * journal - 5
        assert journal % 5 == 0 or at_bound


def test_the_worked_unit_comes_out_about_as_it_was_designed() -> None:
    train = dict(train_of(asked(PAIR)).pairs)
    designed = starters()["starter-turbo-gear-drive-train"].request["pinion_shaft"]["bearings"]
    span = designed[1]["position_mm"] - designed[0]["position_mm"]
    found = [float(train[f"pinion_shaft.bearings.{place}.position_mm"]) for place in (0, 1)]
    assert float(train["pinion_shaft.bearings.0.diameter_mm"]) == pytest.approx(designed[0]["diameter_mm"], rel=0.15)
    assert found[1] - found[0] == pytest.approx(span, rel=0.15)


def test_every_step_of_the_path_takes_the_pair_along() -> None:
    here = asked(PAIR)
    steps = steps_of(here)
    assert [step.question for step in path_of(here) if step.current] == ["Safe?"]
    given = dict(here.pairs)
    assert not any(step.trouble for step in steps.values())
    for question in ("Choked?", "On shafts", "What to grind", "One report"):
        there = dict(asked_by(steps[question].address.replace("/design?", "?").replace("/report?", "?")).pairs)
        assert {name: there[name] for name in given if name.startswith("gears.")} == {
            name: text for name, text in given.items() if name.startswith("gears.")
        }
    train = train_of(here)
    assert dict(train_of(carried_to(train, BY_PATH["/v1/pumping"])).pairs) == dict(train.pairs)
    assert steps["One report"].address.startswith("/drive-train/report?")
    assert f"extent={WITH_PAIR}" in steps["One report"].address
    found = path_of(train, "design")[-1]
    assert (found.address, found.trouble) == ("", "below, with the correction found"), "not of the case as described"
    html = html_of(train.__class__("/drive-train", [], {}))
    assert 'aria-label="Path of a gear pair"' in html


def test_what_is_typical_is_marked_assumed_until_it_is_changed() -> None:
    train = train_of(asked(PAIR))
    found = assumed_of(train)
    assert found
    names = {name for name, _ in train.pairs if name.startswith(("pinion_shaft", "wheel_shaft", "face_start"))}
    assert set(found.fields) == names
    assert found.renewed == ""
    own = "pinion_shaft.bearings.0.diameter_mm"
    edited = Asked(train.path, [(n, "165" if n == own else t) for n, t in train.pairs], train.views)
    again = assumed_of(edited)
    assert again
    assert set(found.fields) - set(again.fields) == {own}
    assert assumed_of(Asked(train.path, train.pairs)) is None, "typed by the user"


def test_other_gears_ask_for_typical_shafts_again() -> None:
    train = train_of(asked(PAIR))
    wide = [(name, "240" if name == "gears.face_width_mm" else text) for name, text in train.pairs]
    found = assumed_of(Asked(train.path, wide, train.views))
    assert found
    renewed = asked_by(found.renewed)
    assert dict(renewed.pairs)["gears.face_width_mm"] == "240"
    assert dict(renewed.pairs)["wheel_shaft.sections.2.length_mm"] == "240"
    kept = assumed_of(renewed)
    assert kept
    assert kept.renewed == ""


def test_shafts_that_are_known_stay_as_they_are() -> None:
    unit = asked("starter-turbo-gear-drive-train")
    assert with_typical(unit) == unit
    back = train_of(carried_to(unit, BY_PATH["/v1/scuffing"]))
    assert dict(back.pairs) == dict(unit.pairs)
    assert "typical" not in back.views


def test_two_helices_get_a_shaft_with_a_gap() -> None:
    gears = {**starters()[PAIR].request["gears"], "gap_width_mm": 60, "face_width_mm": 110, "helix_angle_deg": 28}
    train = train_of(Asked("/scuffing", pairs_of(changed(starters()[PAIR].request, {"gears": gears}))))
    lengths = [text for name, text in train.pairs if re.fullmatch(r"pinion_shaft\.sections\.\d\.length_mm", name)]
    assert lengths[3:6] == ["110", "60", "110"] or lengths[2:5] == ["110", "60", "110"]
    validated(BY_PATH[TRAIN].request, train.body).inputs()


def test_a_pair_without_load_has_no_shafts_yet() -> None:
    here = Asked("/scuffing", [("gears.pinion.teeth", "39")])
    step = steps_of(here)["On shafts"]
    assert step.address == ""
    assert "number of teeth" in step.trouble


def test_shafts_are_not_asked_for_where_typical_ones_would_do() -> None:
    steps = steps_of(asked("milian-case-1"))
    for question in ("On shafts", "What to grind", "One report"):
        assert steps[question].trouble == "missing: pinion torque or transmitted power"
    assert steps["On shafts"].title == "typical shafts and bearings"


@pytest.mark.ci
def test_a_case_that_is_too_long_for_a_link_says_so_and_offers_nothing() -> None:
    here = asked(PAIR)
    long = Asked(
        here.path, here.pairs, {"pair": "&".join(f"pinion_shaft.sections.{k}.length_mm=1" for k in range(300))}
    )
    assert offers(here)
    assert offers(long) == []
    step = steps_of(long)["Choked?"]
    assert (step.address, step.trouble) == ("", "the case is too long for a link")
    assert step.trouble in html_of(long)


def test_the_new_pair_is_a_short_form_of_the_scuffing_page() -> None:
    page = unescape(new_pair_page(""))
    names = set(re.findall(r'name="([a-z]\w*\.[\w.]+)"', page))
    assert names == set(ENTRY)
    assert 'action="/scuffing"' in page


@pytest.mark.ci
def test_the_pumping_loss_comes_by_one_click(client: httpx.Client) -> None:
    here = asked(PAIR)
    (offer,) = offers(here)
    assert (offer.title, offer.source) == ("pumping loss", BY_PATH["/v1/pumping"].title)
    sent = client.get(offer.address)
    assert sent.status_code == 303
    there = asked_by(sent.headers["location"])
    answer = client.post("/v1/pumping", json=carried_to(here, BY_PATH["/v1/pumping"]).body).json()
    assert float(dict(there.pairs)["cooling.pumping_w"]) == pytest.approx(answer["total"]["pumping_power_w"], rel=1e-5)
    assert {pair for pair in there.pairs if pair[0] != "cooling.pumping_w"} == set(here.pairs)
    assert offers(there) == []


def test_a_pair_that_cannot_be_pumped_says_why(client: httpx.Client) -> None:
    (offer,) = offers(asked(PAIR))
    page = client.get(offer.address.replace("gears.module_mm=6", "gears.module_mm=-6"))
    assert page.status_code == 422
    assert "Not computed yet" in page.text


def test_a_mesh_without_solution_hands_nothing_on(monkeypatch: pytest.MonkeyPatch) -> None:
    unsolved, page = SimpleNamespace(response=SimpleNamespace(status="no_solution")), views.Shown(b"why")
    monkeypatch.setattr(views, "solved", lambda *_: unsolved)
    monkeypatch.setattr(views, "page", lambda _: page)
    assert views.handed_on(carried_to(asked(PAIR), BY_PATH["/v1/pumping"]), "/v1/scuffing") is page


def test_an_answer_hands_on_only_where_it_is_an_input(client: httpx.Client) -> None:
    assert client.get("/pumping/into/drive-train?a=b").status_code == 404
    assert client.get("/scuffing/into/pumping").status_code == 404


def test_the_pair_alone_is_judged_without_the_slope_that_the_unit_needs() -> None:
    """A flank that is ground for bent shafts looks wrong on aligned ones (row 7 of the worked example)."""
    train = train_of(asked(PAIR))
    ground = Asked(train.path, [*train.pairs, ("modifications.helix_slope_um", "50")], {"extent": WITH_PAIR})
    scuffing, pumping = others_of(ground)
    assert (scuffing.path, pumping.path) == ("/scuffing", "/pumping")
    assert "modifications.helix_slope_um" not in dict(scuffing.pairs)
    assert "modifications.lead_crowning_um" in dict(scuffing.pairs)
    assert others_of(Asked(ground.path, ground.pairs)) == []


@pytest.mark.parametrize(("slope", "is_said"), [("50", True), ("0", False), (None, False)])
def test_the_report_speaks_of_the_slope_only_if_there_is_one(slope: str | None, is_said: bool) -> None:
    train, there = train_of(asked(PAIR)), Asked("/scuffing", [])
    given = [("modifications.helix_slope_um", slope)] if slope else []
    step = _step(there, Asked(train.path, [*train.pairs, *given]))
    assert bool(step["note"]) == is_said
    assert step["judged"] == " (pair alone, aligned)"
    assert _step(there, carried_to(train, BY_PATH["/v1/pumping"]))["judged"] == ""


@pytest.mark.ci
def test_one_report_holds_all_steps_and_marks_what_is_assumed() -> None:
    train = train_of(asked(PAIR))
    quick = [*train.pairs, ("model.lubrication", "closed_form"), ("modifications.helix_slope_um", "-20")]
    quick.append(("gears.quality_class", "6"))
    whole = Asked(train.path, quick, {**train.views, "extent": WITH_PAIR})
    shown = report_of(whole, "", others_of(whole))
    text = unescape(shown.content.decode())
    assert shown.status == 200
    for question in ("Safe?", "Choked?"):
        assert re.search(rf"<h2>{re.escape(question)} \w", text)
    assert "Safe? (pair alone, aligned) " in text
    assert "Typical shafts and bearings: " in text
    sheet = text.partition("<h2>What to grind</h2>")[2].partition("</table>")[0]
    assert re.search(r"helix slope, over the face width.*?>20<", sheet, re.DOTALL)
    assert "what both gears together may have in quality class 6" in text
    assert re.search(r"journal diameter.*?assumed", text, re.DOTALL)
    alone = views.report(Asked(train.path, quick, train.views), "").content.decode()
    assert "Choked?" not in alone


def test_a_report_of_flanks_without_correction_has_no_sheet_for_the_grinder() -> None:
    train = train_of(asked(PAIR))
    plain = [(name, text) for name, text in train.pairs if not name.startswith("modifications.")]
    assert _sheet(Asked(train.path, [*plain, ("model.lubrication", "closed_form")])) is None


HOSTILE = [
    "gears=1",
    "gears.pinion.teeth=x&operation.power_kw=NaN",
    "gears.0.1=2",
    "a..b=1",
    "gears.pinion=on&gears.pinion.teeth=1e400",
]


@pytest.mark.parametrize("typical", HOSTILE)
def test_any_text_of_a_link_is_answered(client: httpx.Client, typical: str) -> None:
    for address in ("/drive-train", "/scuffing", "/pumping"):
        page = client.get(address, params={"typical": typical, "gears.pinion.teeth": "39"}, follow_redirects=True)
        assert page.status_code == 422
        assert "Not computed yet" in page.text
    assert client.get("/drive-train", params={"typical": "a=1&" * 1001, "gears.module_mm": "3"}).status_code < 500
