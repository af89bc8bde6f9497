"""An oil by its name is the oil of its data sheet; given values win; other names are refused with the nearest."""

from typing import Any

import pytest

from app.calculations import BY_PATH
from app.errors import InvalidBody
from app.examples import examples
from app.schema.fields import leaf_at, value_at
from app.schema.reading import validated
from app.studies.kinds.sweep import Sweep
from solvers.named_oils import named_oils
from tests.support.requests import CONTACT, COUPLING, PAIR, changed, solved
from tests.support.studies import lines_of

UNIT: dict[str, Any] = changed(
    examples()["starter-turbo-gear-drive-train"].request, {"model.lubrication": "closed_form", "lubricant": {}}
)
USES: dict[str, tuple[str, dict[str, Any], str]] = {
    "coupling": ("/v1/coupling", COUPLING, "lubricant"),
    "scuffing": ("/v1/scuffing", PAIR, "lubricant"),
    "line contact": ("/v1/scuffing/line-contact", CONTACT, "lubricant"),
    "unit": ("/v1/drive-train", UNIT, "lubricant"),
    "coupling of a unit": (
        "/v1/drive-train",
        changed(UNIT, {"lubricant": {"iso_vg": 46}, "couplings.0.friction": {}}),
        "couplings.0.lubricant",
    ),
}
OIL = named_oils()["Mobil SHC 626"]
TYPED = {
    "kinematic_viscosity_40_mm2_per_s": 68,
    "kinematic_viscosity_100_mm2_per_s": 11.6,
    "kind": "pao",
}
RESULTS = ("status", "lubrication", "safety", "film", "thermal_ehl", "load", "flash", "friction_loss", "axial_thrust")


def answer(use: str, oil: dict[str, Any], **changes: Any) -> dict[str, Any]:
    endpoint, body, path = USES[use]
    return solved(endpoint, body, {path: oil, **changes})


def refused(use: str, oil: dict[str, Any]) -> tuple[str, str, str]:
    endpoint, body, path = USES[use]
    with pytest.raises(InvalidBody) as refusal:
        validated(BY_PATH[endpoint].request, changed(body, {path: oil}))
    fault = refusal.value.faults[0]
    return fault.pointer, fault.code, fault.message


@pytest.mark.parametrize("use", USES)
def test_a_name_is_the_data_sheet(use: str) -> None:
    by_name, typed = answer(use, {"name": OIL.name}), answer(use, TYPED)
    for name in RESULTS:
        assert by_name.get(name) == typed.get(name), name
    path = USES[use][2]
    assert value_at(by_name["inputs"], path) == value_at(typed["inputs"], path) | {"name": OIL.name}
    assert solved(USES[use][0], by_name["inputs"])["case"] == by_name["case"]  # as the answer's inputs are posted again
    said = {each["field"]: each for each in by_name["assumptions"] if OIL.source in each["reason"]}
    assert {field: each["value"] for field, each in said.items()} == {
        f"{path}.{name}": value for name, value in TYPED.items()
    }
    assert all(OIL.read in each["reason"] for each in said.values())


def test_names_are_read_without_regard_to_capitals() -> None:
    assert answer("coupling", {"name": "mobil shc 626"})["inputs"]["lubricant"]["name"] == OIL.name


@pytest.mark.parametrize(
    "given",
    [
        {"kinematic_viscosity_40_mm2_per_s": 70.0},
        {"kinematic_viscosity_100_mm2_per_s": 11.0},
        {"kind": "polyglycol"},
        {"density_15_kg_per_m3": 851.0},
    ],
)
def test_given_values_win(given: dict[str, Any]) -> None:
    found = answer("coupling", {"name": OIL.name, **given})
    assert found["derived"] == answer("coupling", TYPED | given)["derived"]
    (name,) = given
    assert f"lubricant.{name}" not in {each["field"] for each in found["assumptions"] if OIL.source in each["reason"]}


def test_a_given_index_replaces_the_viscosity_at_100_degrees() -> None:
    found = answer("coupling", {"name": OIL.name, "viscosity_index": 100})
    assert found["derived"]["viscosity_index"] == pytest.approx(100, abs=1e-6)


def test_an_index_that_cannot_be_is_said() -> None:
    found = answer("coupling", {"name": "Mobil DTE 846"})
    reason = next(each["reason"] for each in found["assumptions"] if "prints" in each["reason"])
    assert "prints the viscosity index 106, but its viscosities have 90 (ASTM D2270)" in reason


@pytest.mark.parametrize(
    "name", ["Mobil SHC", "", "\x00\ud800", "x" * 100_000, 5, True, ["FVA 3A"], {"name": "FVA 3A"}]
)
@pytest.mark.parametrize("use", ["coupling", "scuffing", "coupling of a unit"])
def test_other_names_are_refused_with_the_nearest_ones(use: str, name: Any) -> None:
    pointer, code, message = refused(use, {"name": name})
    assert (pointer, code) == (f"/{USES[use][2].replace('.', '/')}/name", "unknown_oil")
    near = message.partition("the nearest are ")[2].partition(". Any other")[0].split("; ")
    assert len(near) == 3
    assert set(near) <= set(named_oils())


@pytest.mark.parametrize("other", [{"iso_vg": 46}, {"viscosity_pa_s": 0.02}, {"reference_temperature_c": 60}])
def test_a_name_is_no_second_description(other: dict[str, Any]) -> None:
    _, code, message = refused("scuffing", {"name": OIL.name, **other})
    assert code == "exclusive"
    assert message == f"name and {next(iter(other))} are both given; keep one"


def test_the_load_stages_of_the_sheet_are_used_where_none_is_given() -> None:
    oil = {"name": "Mobilgear 600 XP 220"}
    found = answer("scuffing", oil, micropitting={})
    assert found["inputs"]["temperatures"]["scuffing_test"]["fzg_stage"] == 13
    assert found["inputs"]["micropitting"]["failure_load_stage"] == 10
    source = named_oils()[oil["name"]].source
    said = {each["field"] for each in found["assumptions"] if source in each["reason"]}
    assert {"temperatures.scuffing_test.fzg_stage", "micropitting.failure_load_stage"} <= said
    by_hand = answer("scuffing", oil, **{"temperatures.scuffing_test": {"fzg_stage": 9}})
    assert by_hand["inputs"]["temperatures"]["scuffing_test"]["fzg_stage"] == 9
    assert "temperatures.scuffing_test.fzg_stage" not in {each["field"] for each in by_hand["assumptions"]}
    measured = answer("scuffing", oil, **{"temperatures.scuffing_c": 300})
    assert measured["inputs"]["temperatures"]["scuffing_test"] is None
    assert answer("scuffing", {"name": OIL.name})["safety"] is None  # its sheet prints no stage


def test_names_can_be_swept() -> None:
    names = ["Mobil DTE 732", "Mobil SHC 632"]
    graded = {"endpoint": "/v1/coupling", "request": changed(COUPLING, {"lubricant": {"iso_vg": 46}})}
    axis = {"path": "lubricant.name", "values": names}
    study = Sweep({**graded, "vary": [axis], "outputs": ["derived.viscosity_pa_s"]}, 2500, 30.0)
    found = [line["out"][0] for line in lines_of(study) if line["type"] == "point"]
    single = [answer("coupling", {"name": name})["derived"]["viscosity_pa_s"] for name in names]
    assert found == single
    assert found[0] < found[1]


def test_the_names_are_a_menu() -> None:
    leaf = leaf_at(BY_PATH["/v1/scuffing"].request, "lubricant.name")
    assert leaf is not None
    assert leaf.options == tuple(named_oils())
