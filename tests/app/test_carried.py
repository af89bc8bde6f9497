"""Links to other calculations carry the gears or the coupling of a case, and keep the other values for the way back."""

import re
from itertools import permutations
from typing import Any

import pytest

from app.calculations import BY_PATH, CALCULATIONS, Calculation, card_of
from app.examples import examples
from app.figures.wording import number
from app.pages.carried import Use, uses
from app.pages.cases import Asked, solved
from app.pages.query import pairs_of
from app.pages.results import cards, resolved
from app.pages.templating import page_path
from app.schema.fields import leaf_at
from tests.support.pages import asked, asked_by, html_of
from tests.support.requests import changed

SCUFFING = "starter-industrial-scuffing"
GEARS = [each for each in CALCULATIONS if card_of(each).subject == "pair"]


def use_of(found: Asked, title: str) -> Use:
    (use,) = [each for each in uses(found) if each.title == title]
    return use


def to(found: Asked, path: str) -> Asked:
    return asked_by(use_of(found, BY_PATH[path].title).address)


def test_is_it_choked_without_a_number_typed_twice() -> None:
    pair = asked(SCUFFING)
    use = use_of(pair, BY_PATH["/v1/pumping"].title)
    assert use.missing == []
    there = asked_by(use.address)
    assert dict(there.pairs)["operation.pinion_speed_rpm"] == dict(pair.pairs)["load.pinion_speed_rpm"]
    for name, text in pair.pairs:
        if name.startswith("gears.") and leaf_at(BY_PATH["/v1/pumping"].request, name):
            assert dict(there.pairs)[name] == text
    html = html_of(there)
    assert "axial choking" in html
    assert re.search(r'class="finding \w+">(Not choked|Choked|Doubtful whether choked)', html)


@pytest.mark.parametrize(("first", "second"), [*permutations([each.path for each in GEARS], 2)])
def test_there_and_back_loses_nothing(first: str, second: str) -> None:
    example = next(each for each in examples().values() if each.endpoint == first)
    here = Asked(page_path(BY_PATH[first]), pairs_of(example.request))
    assert use_of(here, BY_PATH[second].title)
    back = to(to(here, second), first)
    if "pair" in to(here, second).views:
        assert dict(back.pairs) == dict(here.pairs)
    assert back.views.get("pair", "") == ""


def test_a_round_over_three_pages_keeps_oil_and_modifications() -> None:
    request = changed(examples()[SCUFFING].request, {"modifications": {"lead_crowning_um": 7}})
    here = Asked("/scuffing", pairs_of(request))
    loads = to(to(here, "/v1/pumping/choking-speed"), "/v1/scuffing/load-distribution")
    assert dict(loads.pairs)["modifications.lead_crowning_um"] == "7"
    assert dict(loads.pairs)["load.power_kw"] == dict(here.pairs)["load.power_kw"]
    train = to(loads, "/v1/drive-train")
    assert {n: t for n, t in train.pairs if n.startswith("lubricant.")} == {
        n: t for n, t in here.pairs if n.startswith("lubricant.")
    }
    assert dict(train.pairs)["operation.power_kw"] == dict(here.pairs)["load.power_kw"]


def test_what_is_missing_is_named_and_marked() -> None:
    use = use_of(asked(SCUFFING), BY_PATH["/v1/drive-train"].title)
    assert any("bearings" in each for each in use.missing)
    assert any("start" in each for each in use.missing)
    html = html_of(asked_by(use.address), 422)
    assert "Not computed yet" in html
    speed = use_of(asked("starter-choking-speed"), BY_PATH["/v1/scuffing"].title)
    assert "pinion torque or transmitted power" in ", ".join(speed.missing)
    assert any("speed" in each for each in speed.missing)


@pytest.mark.parametrize("calculation", [each for each in CALCULATIONS if card_of(each).subject], ids=page_path)
def test_every_page_of_gears_or_a_coupling_has_the_links(calculation: Calculation) -> None:
    example = next(each for each in examples().values() if each.endpoint == calculation.path)
    others = [
        each
        for each in CALCULATIONS
        if each is not calculation and card_of(each).subject == card_of(calculation).subject
    ]
    found = uses(Asked(page_path(calculation), pairs_of(example.request)))
    assert [each.title for each in found] == [each.title for each in others]


def test_a_coupling_goes_along_too() -> None:
    here = asked("pahl-axial-displacement")
    orbit = to(here, "/v1/coupling/sleeve-orbit")
    assert dict(orbit.pairs) == dict(here.pairs)
    (missing,) = use_of(here, BY_PATH["/v1/coupling/recommendation"].title).missing
    assert "misalignment" in missing
    html = html_of(here)
    assert "Use this coupling in" in html


def test_the_found_crowning_goes_along() -> None:
    here = asked("starter-coupling-crowning")
    answer = solved(here.calculation, here.pairs, None).response
    use = next(each for each in uses(here, answer) if each.title == BY_PATH["/v1/coupling"].title)
    assert use.missing == []
    assert use.found == ["crowning ratio"]
    there = asked_by(use.address)
    assert float(dict(there.pairs)["coupling.crowning_ratio"]) == pytest.approx(answer.crowning_ratio, rel=1e-5)
    assert dict(there.pairs)["operation.misalignment_deg"] == "0.09"
    html = html_of(here)
    assert "with the crowning ratio found here" in html
    assert dict(to(there, "/v1/coupling/recommendation").pairs) == dict(here.pairs)
    coupling = solved(there.calculation, there.pairs, None).response
    assert coupling.geometry.crowning_radius_mm == pytest.approx(answer.crowning_radius_mm, rel=1e-5)


def test_where_no_crowning_serves_nothing_is_handed_on() -> None:
    example = examples()["starter-coupling-crowning"]
    operation = {**example.request["operation"], "misalignment_range_deg": [0.1, 5.0]}
    here = Asked("/coupling/recommendation", pairs_of(changed(example.request, {"operation": operation})))
    answer = solved(here.calculation, here.pairs, None).response
    assert not answer.feasible
    for use in uses(here, answer):
        assert use.found == []
        assert "operation.misalignment_deg" not in dict(asked_by(use.address).pairs)


def test_the_main_result_of_the_crowning_is_radius_and_drop() -> None:
    here = asked("starter-coupling-crowning")
    response = solved(here.calculation, here.pairs, None).response
    html = html_of(here)
    said = html.partition('class="finding near">')[2].partition("<")[0].replace("\u00a0", " ")
    assert said.startswith(f"Crown with radius {number(response.crowning_radius_mm, 'mm')}: the flanks drop ")
    first, second, third, fourth, *_ = cards(response, resolved(response))
    assert [each.path for each in (first, second, third, fourth)] == [
        *("crowning_radius_mm", "crowning_drop_um", "at_max.load_concentration", "unloading_margin")
    ]


def test_a_field_of_its_own_wins_over_what_was_carried() -> None:
    here: dict[str, Any] = dict(to(asked(SCUFFING), "/v1/pumping").pairs)
    carried = to(asked(SCUFFING), "/v1/pumping").views["pair"]
    edited = Asked("/pumping", [*(here | {"gears.face_width_mm": "33"}).items()], {"pair": carried})
    back = to(edited, "/v1/scuffing")
    assert dict(back.pairs)["gears.face_width_mm"] == "33"
    assert solved(BY_PATH["/v1/scuffing"], [*back.pairs, ("model.lubrication", "closed_form")], None).request
