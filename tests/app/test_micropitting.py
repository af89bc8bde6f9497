"""The service judges and draws micropitting, states its assumptions, and rejects invalid requests."""

from typing import Any

import pytest

from app.calculations import BY_PATH
from app.errors import InvalidBody, Unprocessable
from app.evaluate import answer, evaluate
from app.examples import examples
from app.figures.data import Figure, NoFigure
from app.rexs.answer import with_answer
from app.rexs.document import read
from app.schema.fields import leaf_at
from app.schema.reading import validated
from tests.rexs.units import three_stages
from tests.support.requests import changed

SCUFFING, UNIT = "/v1/scuffing", "/v1/drive-train"
STARTER = examples()["starter-industrial-micropitting"].request | {"model": {"lubrication": "closed_form"}}
SPUR = changed(STARTER, {"modifications": {}, "detail": "fields"})
UNDERCUT = {"gears.pinion": {"teeth": 10}, "gears.wheel": {"teeth": 60}, "temperatures": {"bulk_c": 80}}
TURBO = changed(examples()["starter-turbo-gear-drive-train"].request, {"model.lubrication": "closed_form"})


def asked(request: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    return answer(SCUFFING, changed(request, changes))


def refusals(changes: dict[str, Any]) -> dict[str, str]:
    with pytest.raises(InvalidBody) as refusal:
        asked(STARTER, changes)
    return {fault.pointer: fault.message for fault in refusal.value.faults}


def fields(found: dict[str, Any]) -> set[str]:
    return {each["field"] for each in found["assumptions"]}


@pytest.mark.parametrize(
    ("stage", "message"),
    [
        (4, "failure_load_stage is 4; permissible: 5 to 10"),
        (11, 'failure_load_stage is 11; permissible: 5 to 10; "above 10" on a data sheet means that the oil passed'),
        ("> 10", 'give a number, not text; "above 10" on a data sheet means that the oil passed'),
        (7.5, "give a whole number"),
        ("8", "give a number, not text: 8 instead of"),
    ],
)
def test_stages_that_the_test_does_not_have_are_refused(stage: object, message: str) -> None:
    (found,) = refusals({"micropitting.failure_load_stage": stage}).items()
    assert found[0] == "/micropitting/failure_load_stage"
    assert found[1].startswith(message.partition(" instead")[0])


def test_a_stage_above_the_last_one_counts_as_the_last_and_says_so() -> None:
    """FVA 54/7 prints ">10" for an oil that passed stage 10."""
    passed, ten = (asked(STARTER, {"micropitting.failure_load_stage": stage}) for stage in (">10", 10))
    assert passed["micropitting"] == ten["micropitting"]
    assert passed["inputs"]["micropitting"]["failure_load_stage"] == 10
    (reason,) = (each["reason"] for each in passed["assumptions"] if each["field"] == "micropitting.failure_load_stage")
    assert '">10" is taken as 10' in reason.replace('(">10")', '">10"')


def test_a_stage_and_a_ratio_exclude_each_other() -> None:
    (message,) = refusals({"micropitting.permissible_ratio": 0.3}).values()
    assert message == "failure_load_stage and permissible_ratio are both given; keep one"


def test_the_starter_has_limited_margin_and_says_where() -> None:
    found = asked(STARTER, {})
    local = found["micropitting"]["local"]
    assert 1.0 < local["safety"] < 2.0
    assert local["verdict"] == "limited margin"
    assert local["safety"] == pytest.approx(local["least_ratio"] / found["micropitting"]["permissible_ratio"])
    assert found["micropitting"]["test"]["torque_n_m"] == 171.6
    assert found["micropitting"]["standard"] is None
    assert len(found["path"]["micropitting_ratio"]) == len(found["path"]["psi"])
    assert min(each for each in found["path"]["micropitting_ratio"] if each is not None) >= local["least_ratio"]
    wear = found["wear"]
    assert max(wear["pinion_um_per_million"]) == pytest.approx(wear["pinion_max_um_per_million"])


def test_a_plain_spur_pair_has_the_seven_points_of_the_standard_and_maps() -> None:
    found = asked(SPUR, {})
    standard = found["micropitting"]["standard"]
    assert [each["point"] for each in standard["points"]] == ["A", "AB", "B", "C", "D", "DE", "E"]
    assert standard["least_ratio"] == min(each["ratio"] for each in standard["points"])
    assert {"force_ratio", "pressure_mpa", "flash_k", "film_um", "ratio", "safety"} < set(standard["points"][0])
    shape = len(found["flank"]["profile_fraction"]), len(found["flank"]["face_fraction"])
    for maps in (found["flank"]["micropitting_ratio"], found["wear"]["wheel_map_um_per_million"]):
        assert (len(maps), len(maps[0])) == shape
    assert "micropitting.quality_grade" in fields(found)
    assert "micropitting.quality_grade" not in fields(asked(STARTER, {}))


def test_what_is_not_asked_for_is_null() -> None:
    plain = {name: value for name, value in STARTER.items() if name != "micropitting"}
    found = asked(plain, {})
    assert (found["micropitting"], found["wear"], found["path"]["micropitting_ratio"]) == (None, None, None)
    assert not [field for field in fields(found) if field.startswith("micropitting")]


def test_without_stage_and_ratio_the_assumption_says_what_is_missing() -> None:
    found = asked(STARTER, {"micropitting": {}})
    local = found["micropitting"]["local"]
    assert local["least_ratio"] > 0.0
    assert (local["safety"], local["verdict"], found["micropitting"]["permissible_ratio"]) == (None, None, None)
    (missing,) = (each for each in found["assumptions"] if each["field"] == "micropitting.failure_load_stage")
    assert "no failure load stage and no permissible film thickness" in missing["reason"]


def test_a_given_ratio_takes_the_place_of_the_test() -> None:
    found = asked(STARTER, {"micropitting": {"permissible_ratio": 0.5}})
    assert found["micropitting"]["test"] is None
    assert found["micropitting"]["local"]["safety"] == pytest.approx(
        found["micropitting"]["local"]["least_ratio"] / 0.5
    )
    assert found["micropitting"]["local"]["verdict"] == "micropitting is likely"
    assert not [field for field in fields(found) if field.startswith("micropitting.")]


def test_surfaces_and_their_factor() -> None:
    case, nitrided, factor = (
        asked(STARTER, {f"micropitting.{name}": value})["micropitting"]["permissible_ratio"]
        for name, value in (
            ("surface", {}),
            ("surface", {"pinion": "nitrided", "wheel": "nitrided"}),
            ("material_factor", 1.5),
        )
    )
    assert nitrided == pytest.approx(1.5 * case)
    assert factor == pytest.approx(1.5 * case)


def test_without_an_oil_there_is_wear_but_no_film() -> None:
    dry = {name: value for name, value in STARTER.items() if name != "lubricant"}
    found = asked(dry, {})
    assert found["micropitting"] is None
    assert found["wear"]["pinion_max_um_per_million"] > 0.0
    assert "no_oil" in {each["code"] for each in found["warnings"]}
    assert not [field for field in fields(found) if field.startswith("micropitting")]


def test_an_ester_is_assumed_to_be_as_a_mineral_oil() -> None:
    found = asked(STARTER, {"lubricant.kind": "ester", "friction_coefficient": 0.05})
    assert "lubricant.kind" in fields(found)


def drawn(path: str, name: str, request: dict[str, Any]) -> Figure:
    calculation = BY_PATH[path]
    body = validated(calculation.request, request)
    declaration = next(each for each in calculation.figures if each.name == name)
    return declaration.figure(body, evaluate(calculation, body))


def test_one_figure_says_where_it_starts_and_what_the_modifications_do() -> None:
    figure = drawn(SCUFFING, "micropitting", STARTER)
    local = asked(STARTER, {})["micropitting"]["local"]
    described, plain = figure.panels
    assert described.marks[0].x == pytest.approx(local["at_face_mm"])
    assert described.marks[0].y == pytest.approx(local["at_psi"])
    assert "S_λ = 1.48: limited margin" in figure.finding
    assert "without modifications and misalignment" in figure.finding
    assert plain.marks[0].y == pytest.approx(0.0, abs=1e-6)
    assert len(drawn(SCUFFING, "micropitting", SPUR).panels) == 1


def test_film_and_wear_are_drawn() -> None:
    film = drawn(SCUFFING, "micropitting-film", STARTER)
    permissible = asked(STARTER, {})["micropitting"]["permissible_ratio"]
    assert permissible in [level.value for level in film.panels[0].levels]
    assert [panel.title for panel in drawn(SCUFFING, "wear", STARTER).panels] == ["pinion", "wheel"]


@pytest.mark.parametrize(
    ("name", "changes", "code"),
    [
        ("micropitting", {"micropitting": None}, "not_asked"),
        ("micropitting-film", {"micropitting": None}, "not_asked"),
        ("wear", {"micropitting": None}, "not_asked"),
        ("wear", {"micropitting": {"failure_load_stage": 8}}, "not_asked"),
        ("micropitting", {"lubricant": {}}, "no_oil"),
        ("micropitting", {"load": {"pinion_torque_n_m": 0, "pinion_speed_rpm": 1000}}, "no_film"),
        ("wear", {"load": {"pinion_torque_n_m": 0, "pinion_speed_rpm": 1000}}, "no_load"),
    ],
)
def test_a_figure_that_is_not_asked_for_is_refused(name: str, changes: dict[str, Any], code: str) -> None:
    with pytest.raises(NoFigure) as refusal:
        drawn(SCUFFING, name, changed(STARTER, changes))
    assert isinstance(refusal.value, Unprocessable)
    assert refusal.value.code == code


@pytest.mark.parametrize(
    ("name", "changes", "reason"),
    [
        ("flank-temperature", {"lubricant": {}, "temperatures": {"bulk_c": 80}}, "friction_coefficient"),
        ("flank-temperature", UNDERCUT, "gears"),
        ("micropitting", UNDERCUT, "gears"),
        ("micropitting", {"load": {"pinion_torque_n_m": 0, "pinion_speed_rpm": 1000}}, "load"),
    ],
)
def test_a_missing_map_has_its_own_reason(name: str, changes: dict[str, Any], reason: str) -> None:
    """A pair without an oil does not reach a base circle, and an undercut pair does not lack its load."""
    with pytest.raises(NoFigure) as refusal:
        drawn(SCUFFING, name, changed(STARTER, {**changes, "modifications": {}}))
    assert refusal.value.path == reason


def test_a_unit_has_the_film_under_its_own_gap() -> None:
    request = changed(TURBO, {"micropitting": {"failure_load_stage": 10, "wear_coefficient_mm3_per_n_m": 1e-9}})
    found = answer(UNIT, {**request, "detail": "fields"})
    local, ratio = found["micropitting"]["local"], found["flank"]["micropitting_ratio"]
    assert local["safety"] > 0.0
    assert min(each for row in ratio for each in row if each is not None) >= local["least_ratio"] * (1 - 1e-9)
    assert found["wear"]["wheel_max_um_per_million"] > 0.0
    assert "micropitting_range" in {each["code"] for each in found["warnings"]}, "faster than 60 m/s"
    figure = drawn(UNIT, "micropitting", request)
    assert len(figure.panels) == 2
    assert len(drawn(UNIT, "wear", request).panels) == 2


def test_safety_and_ratio_are_outputs_of_studies() -> None:
    for path in (SCUFFING, UNIT):
        for output in ("micropitting.local.safety", "micropitting.local.least_ratio", "wear.pinion_max_um_per_million"):
            leaf = leaf_at(BY_PATH[path].response, output)
            assert leaf is not None
            assert leaf.is_scalar
            assert leaf.declared.source or leaf.declared.text


def test_results_are_written_into_the_file_of_a_unit() -> None:
    document = read(three_stages().xml(), 10**7)
    stage = next(each["id"] for each in three_stages().components if each["type"] == "cylindrical_stage")
    written = with_answer(document, [stage], SCUFFING, asked(STARTER, {}))
    text = written.content.decode()
    assert "custom_tribodrive_micropitting_safety" in text
    assert "custom_tribodrive_minimum_specific_film_thickness_micropitting" in text


def test_a_solved_film_stands_beside_that_of_the_report() -> None:
    request = changed(STARTER, {"model": {"path_points": 5}})
    found = answer(SCUFFING, request)
    ratio = found["micropitting"]["local"]["thermal_ehl_ratio"]
    assert ratio == pytest.approx(found["film"]["thermal_ehl_min_um"] / 0.8, rel=1e-9)
    lines = drawn(SCUFFING, "micropitting-film", request).panels[0].lines
    assert [line.title for line in lines] == ["at the contact temperature", "thermal EHL"]
    assert asked(STARTER, {})["micropitting"]["local"]["thermal_ehl_ratio"] is None


def test_local_heat_of_pumping_thins_the_film() -> None:
    request = changed(TURBO, {"micropitting": {"failure_load_stage": 10}})
    even, local = (
        answer(UNIT, changed(request, {"temperatures.local_bulk": heated}))["micropitting"]["local"]["least_ratio"]
        for heated in (False, True)
    )
    assert local < even
