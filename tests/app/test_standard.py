"""The service states the standard's numbers beside the local ones, and checks dry or greased pairs."""

from typing import Any

import pytest

from app.errors import InvalidBody
from app.evaluate import answer
from app.examples import examples
from app.pages.cases import Asked
from app.pages.query import pairs_of
from app.pages.views import report
from tests.support.pages import html_of
from tests.support.requests import changed

SCUFFING = "/v1/scuffing"
STARTER = examples()["starter-industrial-scuffing"].request | {"model": {"lubrication": "closed_form"}}
MICRO = examples()["starter-industrial-micropitting"].request | {"model": {"lubrication": "closed_form"}}
DRY = {name: section for name, section in STARTER.items() if name not in {"lubricant", "temperatures"}}
GIVEN = {
    "temperatures": {"bulk_c": 90.0, "oil_c": 40.0, "scuffing_c": 300.0},
    "friction_coefficient": 0.1,
}


def asked(request: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    return answer(SCUFFING, changed(request, changes))


def fields(found: dict[str, Any]) -> set[str]:
    return {each["field"] for each in found["assumptions"]}


def test_the_standard_stands_beside_the_local_check() -> None:
    found = asked(STARTER, {"modifications": {}})
    standard = found["safety"]["standard"]
    assert standard["edition"] == "2017"
    assert standard["factors"]["face_load_factor"] == found["load"]["face_load_factor"]
    assert standard["flash"]["bulk_c"] + standard["flash"]["max_flash_k"] == pytest.approx(
        standard["flash"]["contact_c"]
    )
    assert standard["integral"]["safety"] > 0.0
    assert {"standard.quality_grade", "standard.running_in"} < fields(found)
    changes = {"modifications": {}, "model.standard_edition": "2000"}
    report_of_2000 = asked(STARTER, changes)["safety"]["standard"]
    assert report_of_2000["flash"]["roughness_factor"] == pytest.approx(standard["flash"]["roughness_factor"] ** 2)
    assert report_of_2000["integral"] == standard["integral"]


def test_a_relieved_pair_has_the_integral_method_alone_and_says_why() -> None:
    found = asked(STARTER, {})
    assert found["safety"]["standard"]["flash"] is None
    assert found["safety"]["standard"]["integral"]["safety"] > 0.0
    (notice,) = (each for each in found["warnings"] if each["code"] == "no_standard_flash")
    assert (notice["rank"], "relief" in notice["message"]) == ("note", True)


def test_factors_for_the_standard_are_not_asked_where_nothing_uses_them() -> None:
    plain = changed(STARTER, {"temperatures": {"oil_c": 60}})
    assert not {each for each in fields(asked(plain, {})) if each.startswith("standard")}
    assert "standard.quality_grade" in fields(asked(MICRO, {"modifications": {}}))


@pytest.mark.parametrize(("name", "value"), [("face_load_factor", 0.9), ("quality_grade", 12), ("running_in", 1.1)])
def test_factors_beyond_their_range_are_refused(name: str, value: float) -> None:
    with pytest.raises(InvalidBody) as refusal:
        asked(STARTER, {f"standard.{name}": value})
    assert [fault.pointer for fault in refusal.value.faults] == [f"/standard/{name}"]


def test_page_and_report_show_both_side_by_side_and_say_why_they_differ() -> None:
    case = Asked("/scuffing", pairs_of(changed(MICRO, {"modifications": {}})))
    for html in (html_of(case), report(case, "").content.decode()):
        for title in ("Scuffing: local and by the standard", "Micropitting: local and by the standard"):
            table = html.partition(title)[2].partition("They differ because")[0]
            assert "safety factor" in table
            assert table.count("–") < 5
    alone = html_of(Asked("/scuffing", pairs_of(changed(STARTER, {"temperatures": {"oil_c": 60}}))))
    assert "local and by the standard" not in alone


def test_a_dry_or_greased_pair_has_a_contact_temperature_and_a_safety() -> None:
    """Bulk temperature, friction and scuffing temperature are given: nothing of an oil is asked for."""
    found = asked(DRY, GIVEN)
    contact = found["contact_temperature"]["blok_max_c"]
    assert contact == pytest.approx(90.0 + found["flash"]["blok_max_k"])
    assert found["safety"]["blok_factor"] == pytest.approx((300.0 - 40.0) / (contact - 40.0))
    assert (found["film"], found["micropitting"], found["safety"]["standard"]) == (None, None, None)
    (notice,) = (each for each in found["warnings"] if each["code"] == "no_oil")
    assert "dry or greased" in notice["message"]
    oiled = asked(STARTER, GIVEN)
    assert found["flash"]["blok_max_k"] == pytest.approx(oiled["flash"]["blok_max_k"], rel=1e-9)
    thermal = changed(DRY, GIVEN | {"model": {"lubrication": "thermal_ehl"}})
    assert answer(SCUFFING, thermal)["safety"] == found["safety"]


def test_a_greased_pair_may_have_a_scuffing_test() -> None:
    test = {"fzg_stage": 12, "lubricant_factor": 0.9}
    found = asked(DRY, {"temperatures": {"bulk_c": 90.0, "scuffing_test": test}, "friction_coefficient": 0.1})
    assert found["safety"]["scuffing_c"] == pytest.approx(80.0 + 2.25 * 0.9 * 144)
    unknown = asked(DRY, {"temperatures": {"bulk_c": 90.0, "scuffing_test": {"fzg_stage": 12}}})
    assert unknown["safety"] is None


def test_a_dry_pair_without_a_bulk_temperature_has_no_contact_temperature() -> None:
    found = asked(DRY, {"temperatures": {"scuffing_c": 300.0}, "friction_coefficient": 0.1})
    assert (found["contact_temperature"], found["safety"]) == (None, None)
    assert html_of(Asked("/scuffing", pairs_of(changed(DRY, GIVEN))))
