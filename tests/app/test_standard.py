"""The service states the standard's numbers beside the local ones, and checks dry or greased pairs and units."""

import re
from types import SimpleNamespace
from typing import Any

import pytest

from app.calculations import BY_PATH
from app.errors import InvalidBody, Unprocessable
from app.evaluate import answer
from app.examples import examples
from app.models.scuffing.words import by_standard
from app.pages.cases import Asked
from app.pages.query import pairs_of
from app.pages.views import report
from tests.support.pages import html_of
from tests.support.requests import changed

SCUFFING, TRAIN, WARM_UP = "/v1/scuffing", "/v1/drive-train", "/v1/drive-train/warm-up"
STARTER = examples()["starter-industrial-scuffing"].request | {"model": {"lubrication": "closed_form"}}
MICRO = examples()["starter-industrial-micropitting"].request | {"model": {"lubrication": "closed_form"}}
DRY = {name: section for name, section in STARTER.items() if name not in {"lubricant", "temperatures"}}
TURBO = examples()["starter-turbo-gear-drive-train"].request
DOUBLE = examples()["starter-turbo-double-helical"].request | {"model": {"lubrication": "closed_form"}}
PLAIN = {"modifications.tip_relief_um": 0.0, "modifications.root_relief_um": 0.0}
TEST = {"temperatures": {"oil_c": 50.0, "scuffing_test": {"fzg_stage": 12}}}
DRY_TURBO = {name: section for name, section in TURBO.items() if name not in {"lubricant", "temperatures"}}
BY_BOTH = "By ISO/TS 6336-20 and -21 the safety factor is"
GIVEN = {
    "temperatures": {"bulk_c": 90.0, "oil_c": 40.0, "scuffing_c": 300.0},
    "friction_coefficient": 0.1,
}


def asked(request: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    return answer(SCUFFING, changed(request, changes))


def train(request: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    return answer(TRAIN, changed(request, {"detail": "summary"} | changes))


def fields(found: dict[str, Any]) -> set[str]:
    return {each["field"] for each in found["assumptions"]}


def assumed(found: dict[str, Any], field: str) -> Any:
    return next((each["value"] for each in found["assumptions"] if each["field"] == field), "not assumed")


def tables_of(html: str) -> dict[str, str]:
    """Return the tables of local values and the standard's, by title."""
    titles = re.finditer(r">([^<>]+): local and by the standard<", html)
    return {title[1]: html[title.end() :].partition("They differ because")[0] for title in titles}


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


@pytest.mark.ci
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


def test_a_unit_has_the_standard_with_the_face_load_factor_of_its_shafts() -> None:
    found = train(TURBO, PLAIN | TEST)
    standard = found["safety"]["standard"]
    assert standard["factors"]["face_load_factor"] == found["load"]["face_load_factor"] > 1.01
    excess = standard["flash"]["scuffing_c"] - 50.0, standard["flash"]["contact_c"] - 50.0
    assert standard["flash"]["safety"] == pytest.approx(excess[0] / excess[1])
    assert standard["integral"]["load_safety"] > 1.0
    assert found["safety"]["minimum"] == found["safety"]["blok_flank"]
    heavy = train(TURBO, PLAIN | TEST | {"standard.face_load_factor": 1.5, "model.standard_edition": "2000"})
    other = heavy["safety"]["standard"]
    assert other["factors"]["face_load_factor"] == 1.5
    assert other["flash"]["roughness_factor"] == pytest.approx(standard["flash"]["roughness_factor"] ** 2)
    assert heavy["safety"] | {"standard": None} == found["safety"] | {"standard": None}


def test_a_relieved_unit_says_once_why_the_flash_method_is_missing() -> None:
    found = train(TURBO, {})
    assert found["safety"]["standard"]["flash"] is None
    assert [each["code"] for each in found["warnings"]].count("no_standard_flash") == 1
    assert train(TURBO, {"temperatures.scuffing_c": None})["safety"] is None


@pytest.mark.parametrize(
    ("flash", "integral", "own", "said"),
    [
        (0.66, 1.1, 1.4, f"{BY_BOTH} 0.66 (flash) and 1.1 (integral): by the standard it scuffs."),
        (0.66, 1.1, 0.9, f"{BY_BOTH} 0.66 (flash) and 1.1 (integral)."),
        (None, 1.28, 1.85, "By ISO/TS 6336-21 the safety factor is 1.28 (integral)."),
        (0.66, None, None, "By ISO/TS 6336-20 the safety factor is 0.66 (flash): by the standard it scuffs."),
        (None, None, 1.85, ""),
    ],
)
def test_the_conclusion_says_what_the_standard_finds(
    flash: float | None, integral: float | None, own: float | None, said: str
) -> None:
    methods = {
        name: safety and SimpleNamespace(safety=safety) for name, safety in (("flash", flash), ("integral", integral))
    }
    assert by_standard(SimpleNamespace(standard=SimpleNamespace(**methods)), own) == said


def test_each_helix_has_its_own_standard() -> None:
    found = train(DOUBLE, PLAIN | {"modifications.helix_slope_um": 60.0})
    helices, decisive = found["helices"], found["decisive_helix"] - 1
    for helix in helices:
        assert helix["safety"]["standard"]["factors"]["face_load_factor"] == helix["load"]["face_load_factor"]
    assert found["safety"] == helices[decisive]["safety"]
    one, other = (helix["safety"]["standard"]["factors"]["line_load_n_per_mm"] for helix in helices)
    assert one != other
    assert [each["code"] for each in found["warnings"]].count("no_standard_flash") == 0


@pytest.mark.parametrize(
    ("endpoint", "request_of", "section"),
    [(SCUFFING, MICRO, "standard"), (SCUFFING, MICRO, "micropitting"), (TRAIN, TURBO, "standard")],
)
def test_the_quality_grade_follows_the_quality_class(endpoint: str, request_of: dict[str, Any], section: str) -> None:
    """A class of the gears is the grade of the standard too, said as an assumption; a given grade wins."""
    path = f"{section}.quality_grade"
    plain, classed, given = (
        answer(endpoint, changed(request_of, {"detail": "summary"} | PLAIN | change))
        for change in ({}, {"gears.quality_class": 9}, {"gears.quality_class": 9, path: 7})
    )
    assert [assumed(each, path) for each in (plain, classed, given)] == [7, 9, "not assumed"]
    assert [each["derived"][section]["quality_grade"] for each in (plain, classed, given)] == [7, 9, 7]
    if section == "standard":
        factors = [each["safety"]["standard"]["factors"] for each in (plain, classed, given)]
        assert factors[1]["dynamic_factor"] > factors[0]["dynamic_factor"] == factors[2]["dynamic_factor"]
    else:
        first = [each["micropitting"]["standard"]["points"][0]["force_ratio"] for each in (plain, classed, given)]
        assert first[1] > first[0] == first[2]


@pytest.mark.ci
def test_page_and_report_of_a_unit_show_both_side_by_side() -> None:
    case = Asked("/drive-train", pairs_of(changed(TURBO, PLAIN | {"micropitting": {"failure_load_stage": 8}})))
    for html in (html_of(case), report(case, "").content.decode()):
        tables = tables_of(html)
        assert tables.keys() == {"Scuffing", "Micropitting"}
        assert "safety factor" in tables["Scuffing"]
        assert tables["Scuffing"].count("–") < 5


@pytest.mark.ci
def test_the_page_of_two_helices_has_a_table_for_each() -> None:
    html = html_of(Asked("/drive-train", pairs_of(changed(DOUBLE, PLAIN))))
    assert tables_of(html).keys() == {"Scuffing of helix 1", "Scuffing of helix 2"}


def test_a_dry_or_greased_unit_has_a_contact_temperature_and_a_safety() -> None:
    """Its bearings state their own oil; of the gears bulk temperature, friction and scuffing temperature are given."""
    found = train(DRY_TURBO, GIVEN)
    contact = found["flash"]["contact_max_c"]
    assert contact == pytest.approx(90.0 + found["flash"]["flank_k"])
    assert found["safety"]["blok_flank"] == pytest.approx((300.0 - 40.0) / (contact - 40.0))
    assert found["safety"]["minimum"] == pytest.approx(found["safety"]["blok_flank"], rel=0.1)
    assert (found["safety"]["standard"], found["heat"], found["micropitting"]) == (None, None, None)
    assert found["losses"]["mesh_w"] > 0.0
    (notice,) = (each for each in found["warnings"] if each["code"] == "no_oil")
    assert "dry or greased" in notice["message"]
    oiled = train(TURBO, GIVEN)
    assert found["flash"] == oiled["flash"]
    thermal = train(DRY_TURBO, GIVEN | {"model": {"lubrication": "thermal_ehl"}})
    assert thermal["safety"] == found["safety"]
    cold = train(DRY_TURBO, GIVEN | {"states": ["hot", "cold"]})["states"]["cold"]
    assert cold["derived"]["temperatures"]["bulk_c"] == 90.0


def test_a_dry_unit_takes_the_mean_of_its_teeth_and_is_cold_without_them() -> None:
    friction = {"friction_coefficient": 0.1, "temperatures": {"scuffing_c": 300.0}}
    found = train(DRY_TURBO, friction)
    assert found["derived"]["temperatures"]["bulk_c"] == pytest.approx((95.0 + 80.0) / 2)
    assert found["safety"]["blok_flank"] > 0.0
    unknown = train(DRY_TURBO, friction | {"thermal": {"wall_response": 0.6}, "states": ["hot", "cold"]})
    assert (unknown["safety"], unknown["states"]["cold"]["safety"]) == (None, None)


@pytest.mark.parametrize("part", ["pinion_shaft", "wheel_shaft"])
def test_a_dry_unit_needs_the_viscosity_of_its_plain_bearings(part: str) -> None:
    with pytest.raises(Unprocessable) as refusal:
        train(DRY_TURBO, GIVEN | {f"{part}.bearings.0.viscosity_pa_s": None})
    assert (refusal.value.code, refusal.value.path) == ("no_oil", f"{part}.bearings.0.viscosity_pa_s")


@pytest.mark.parametrize(
    ("changes", "pointer"),
    [
        ({"standard.quality_grade": 12}, "/standard/quality_grade"),
        ({"standard.face_load_factor": "NaN"}, "/standard/face_load_factor"),
        ({"standard.running_in": -1}, "/standard/running_in"),
        ({"standard": []}, "/standard"),
        ({"model.standard_edition": "1987"}, "/model/standard_edition"),
    ],
)
def test_a_unit_refuses_what_the_standard_does_not_have(changes: dict[str, Any], pointer: str) -> None:
    for endpoint in (TRAIN, WARM_UP):
        with pytest.raises(InvalidBody) as refusal:
            answer(endpoint, changed(TURBO, changes))
        assert pointer in [fault.pointer for fault in refusal.value.faults]


def test_a_warm_up_asks_for_nothing_of_the_standard() -> None:
    request = examples()["starter-turbo-gear-warm-up"].request
    asked_for = BY_PATH[WARM_UP].request.model_validate(request).unused()
    assert asked_for["standard"]
    assert asked_for["model.standard_edition"]
