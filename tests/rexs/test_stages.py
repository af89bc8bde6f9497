"""The answer about a file contains the stages of the gear unit with their requests and load cases.

The answer also lists missing fields, assumed values, ignored attributes and faults of the file.
"""

import base64
import json
import struct
from typing import Any

import pytest
from hypothesis import strategies as st

from app.calculations import BY_PATH
from app.evaluate import evaluate
from app.rexs.document import read
from app.rexs.unit import gear_unit
from app.studies.kinds.spectrum import Spectrum
from tests.rexs.units import Unit, Value, three_stages, turbo_unit
from tests.support.properties import examples, first

MOST_BYTES = 20_000_000
LOAD = "/v1/scuffing/load-distribution"


def answer(unit: Unit | bytes) -> dict[str, Any]:
    return gear_unit(read(unit if isinstance(unit, bytes) else unit.xml(), MOST_BYTES).model)


def codes(found: dict[str, Any]) -> set[str]:
    return {each["code"] for each in found["findings"]}


@pytest.mark.parametrize("version", ["1.0", "1.4", "1.7", "2.0"])
def test_three_stages(version: str) -> None:
    found = answer(three_stages(version))
    assert found["version"] == version
    assert found["findings"] == []
    stages = found["stages"]
    requests = [each["requests"][LOAD] for each in stages]
    gears = [each["gears"] for each in requests]
    assert [(each["pinion"]["teeth"], each["wheel"]["teeth"]) for each in gears] == [(23, 67), (13, 76), (14, 87)]
    assert [each["centre_distance_mm"] for each in gears] == [53.0, 57.0, 77.0]
    assert [each["helix_angle_deg"] for each in gears] == [30.0, 10.0, 10.0]
    assert [each["face_width_mm"] for each in gears] == [11.0, 15.0, 36.0]
    assert [each["hand"] for each in stages] == ["right", "left", "right"]
    loads = [each["load"] for each in requests]
    assert [each["pinion_torque_n_m"] for each in loads] == pytest.approx([4.724562, 13.762855, 80.459770], rel=1e-6)
    assert [each["pinion_speed_rpm"] for each in loads] == pytest.approx([1400.0, 480.597015, 82.207384], rel=1e-7)


def test_every_load_distribution_answers() -> None:
    for stage in answer(three_stages())["stages"]:
        calculation = BY_PATH[LOAD]
        request = calculation.request.model_validate({**stage["requests"][LOAD], "detail": "summary"})
        assert evaluate(calculation, request).status == "ok"


def test_formats_say_the_same() -> None:
    unit = turbo_unit()
    unit.cases = [{1: {"operating_time_fraction": (100.0, "%")}}]
    assert answer(unit.json()) == answer(unit.zipped()) == answer(unit)


@pytest.mark.parametrize("unit", [three_stages(), turbo_unit()])
def test_ordered_assemblies_say_the_same(unit: Unit) -> None:
    plain = answer(unit)
    for each in unit.relations:
        if each["type"] == "assembly":
            each["type"] = "ordered_assembly"
    assert answer(unit) == plain


def test_an_array_in_base64_says_the_same() -> None:
    unit = turbo_unit()
    plain = answer(unit)
    coded = base64.b64encode(struct.pack("<3d", 0.0, 517.387, 0.0)).decode()
    text = unit.xml().decode()
    array = "<array><c>0.0</c><c>517.387</c><c>0.0</c></array>"
    assert array in text
    assert answer(text.replace(array, f'<array code="float64">{coded}</array>').encode()) == plain
    damaged = answer(text.replace(array, '<array code="float64">!</array>').encode())
    assert "/v1/drive-train" not in damaged["stages"][0]["requests"]


def test_power_enters_where_torque_and_speed_have_one_sign() -> None:
    unit = three_stages()
    load = next(each["id"] for each in unit.components if each["type"] == "external_load")
    torque, size = unit.of(load)["torque_around_u_axis"]
    assert isinstance(torque, float)
    unit.of(load)["torque_around_u_axis"] = (-torque, size)
    first = answer(unit)["stages"][0]
    assert first["driver"] == first["pinion"]
    assert first["requests"][LOAD]["gears"]["pinion"]["teeth"] == 67


@pytest.mark.parametrize("relation", ["assembly", "ordered_assembly"])
def test_a_torque_counts_about_the_axis_of_its_shaft(relation: str) -> None:
    """Where power enters, speed and torque of the shaft have the same sign."""
    # The kind of relation that attaches the load to the shaft does not matter.
    unit = turbo_unit()
    wheel_shaft = [each for each in unit.components if each["type"] == "shaft"][1]
    driving, driven = (each["id"] for each in unit.components if each["type"] == "external_load")
    origin, size = wheel_shaft["attributes"]["support_vector"]
    wheel_shaft["attributes"]["support_vector"] = ([760.0, *origin[1:]], size)
    wheel_shaft["attributes"]["u_axis_vector"] = ([-1.0, 0.0, 0.0], size)  # so that it turns as the pinion's shaft
    for name in ("power", "defines_torque"):
        del unit.of(driving)[name]
    unit.of(driven).update(torque_around_u_axis=(-38197.0, "N m"), defines_torque=(True, "none"))
    for each in unit.relations:
        if driven in each["roles"].values():
            each["type"] = relation
    stage = answer(unit)["stages"][0]
    assert stage["driver"] == stage["pinion"]
    assert stage["requests"][LOAD]["load"]["pinion_torque_n_m"] == pytest.approx(11459.1, rel=1e-5)
    assert stage["requests"][LOAD]["gears"]["pinion"]["teeth"] == 39


@pytest.mark.parametrize("case", [({"power": (0.69265, "kW")}), ({"power": (692.65, "W")})])
def test_power_instead_of_torque(case: dict[str, tuple[Value, str]]) -> None:
    unit = three_stages()
    load = next(each["id"] for each in unit.components if each["type"] == "external_load")
    del unit.of(load)["torque_around_u_axis"]
    unit.of(load).update(case)
    torque = answer(unit)["stages"][0]["requests"][LOAD]["load"]["pinion_torque_n_m"]
    assert torque == pytest.approx(4.72454, rel=1e-5)


def test_no_torque_is_missing_not_zero() -> None:
    unit = three_stages()
    load = next(each["id"] for each in unit.components if each["type"] == "external_load")
    del unit.of(load)["torque_around_u_axis"]
    for stage in answer(unit)["stages"]:
        assert "load.pinion_torque_n_m" in {each["field"] for each in stage["missing"]}
        assert "pinion_torque_n_m" not in stage["requests"][LOAD]["load"]


def test_load_cases() -> None:
    unit = three_stages("1.4")
    shaft = next(each["id"] for each in unit.components if each["type"] == "shaft")
    load = next(each["id"] for each in unit.components if each["type"] == "external_load")
    for share, speed, torque in ((20.0, 543.0, 5.0), (80.0, 1400.0, 4.0)):
        unit.cases.append(
            {
                1: {"operating_time_fraction": (share, "%")},
                shaft: {"rotational_speed": (speed, "1 / min")},
                load: {"torque_around_u_axis": (torque, "N m")},
                2: {"temperature_lubricant": (70.0, "C")},
            }
        )
    stages = answer(unit)["stages"]
    assert [each["share"] for each in stages[0]["cases"]] == pytest.approx([0.2, 0.8])
    assert "cases" not in {each["field"] for each in stages[0]["assumed"]}  # the attribute is of the standard
    expected = {"load.pinion_torque_n_m": 5.0 * 67 / 23, "load.pinion_speed_rpm": 543.0 * 23 / 67}
    assert stages[1]["cases"][0]["overrides"] == pytest.approx({**expected, "temperatures.oil_c": 70.0})
    own = stages[1]["cases"][0]["overrides"]
    assert stages[1]["spectra"]["/v1/scuffing"][0]["share"] == pytest.approx(0.2)
    assert stages[1]["spectra"]["/v1/scuffing"][0]["set"] == own
    rotation = {"operation.pinion_speed_rpm": own["load.pinion_speed_rpm"]}
    assert stages[1]["spectra"]["/v1/pumping"][0]["set"] == rotation
    del unit.of(load)["torque_around_u_axis"], unit.of(shaft)["rotational_speed"]
    first = answer(unit)["stages"][0]
    assert first["requests"][LOAD]["load"] == {"pinion_torque_n_m": 5.0, "pinion_speed_rpm": 543.0}
    assert any("load case 1" in each["reason"] for each in first["assumed"])
    for case in unit.cases:
        del case[1]
    assert [each["share"] for each in answer(unit)["stages"][0]["cases"]] == [0.5, 0.5]


def test_a_load_spectrum_is_ready_to_be_asked() -> None:
    """The request and the load cases for an endpoint make a valid spectrum study without any change."""
    unit = turbo_unit()
    load = next(each["id"] for each in unit.components if each["type"] == "external_load")
    for percent, power in ((30.0, 5000.0), (70.0, 9000.0)):
        unit.cases.append({1: {"operating_time_fraction": (percent, "%")}, load: {"power": (power, "kW")}})
    (stage,) = answer(unit)["stages"]
    for endpoint in ("/v1/scuffing", "/v1/drive-train", LOAD):
        body = {"endpoint": endpoint, "request": stage["requests"][endpoint], "cases": stage["spectra"][endpoint]}
        study = Spectrum(body, 20_000, 30.0)
        assert [case.share for case in study.cases] == pytest.approx([0.3, 0.7])
        low, high = ([value for path, value in case.set.items() if "torque" in path] for case in study.cases)
        assert high == pytest.approx([1.8 * torque for torque in low])


def test_a_long_load_spectrum_is_no_spectrum_as_it_stands() -> None:
    unit = three_stages("1.4")
    unit.cases = [{1: {"operating_time_fraction": (1.0, "%")}} for _ in range(101)]
    found = answer(unit)
    assert len(found["stages"][0]["cases"]) == 101
    assert found["stages"][0]["spectra"] == {}
    assert "too_many_cases" in codes(found)


def gear_of(unit: Unit, place: int) -> int:
    found: int = [each["id"] for each in unit.components if each["type"] == "cylindrical_gear"][place]
    return found


@pytest.mark.parametrize(
    ("attribute", "value", "unit_", "code"),
    [
        ("tip_diameter", 1.0, "mm", "diameter"),
        ("tip_diameter", 40.0, "mm", "diameter"),
        ("root_diameter", 500.0, "mm", "diameter"),
        ("face_width", -16.0, "mm", "out_of_range"),
        ("normal_module", 1.0, "kg", "unit"),
        ("normal_module", "wide", "mm", "not_a_number"),
        ("normal_module", "inf", "mm", "not_a_number"),
        ("normal_module", 1e9, "mm", "out_of_range"),
        ("normal_module", 1e300, "mm", "not_a_number"),
        ("number_of_teeth", 2.5, "none", "teeth"),
        ("number_of_teeth", 4, "none", "out_of_range"),
        ("helix_angle_reference_diameter", 20.0, "deg", "helix_angles"),
        ("helix_angle_reference_diameter", 90.0, "deg", "out_of_range"),
    ],
)
def test_what_is_wrong_is_found_and_not_used(attribute: str, value: Value, unit_: str, code: str) -> None:
    unit = three_stages("1.4")
    unit.of(gear_of(unit, 0))[attribute] = (value, unit_)
    if code == "out_of_range" and attribute == "face_width":
        unit.of(gear_of(unit, 1))[attribute] = (value, unit_)
    assert code in codes(answer(unit))


def test_tip_and_root_diameter_give_the_rack() -> None:
    unit = three_stages("1.4")
    reference = 23 / 0.8660254037844386  # mm, m_n 1, 30 degrees
    unit.of(gear_of(unit, 0)).update(
        tip_diameter=(reference + 2 * (0.9 + 0.581), "mm"), root_diameter=(reference - 2 * (1.4 - 0.581), "mm")
    )
    pinion = answer(unit)["stages"][0]["requests"][LOAD]["gears"]["pinion"]
    assert (pinion["addendum"], pinion["dedendum"]) == (pytest.approx(0.9), pytest.approx(1.4))


def test_a_tool_gives_the_dedendum() -> None:
    unit = turbo_unit()
    tool = unit.add(
        "rack_shaped_tool",
        addendum_reference_profile=(8.4, "mm"),
        tip_corner_radius_factor_reference_profile=(0.3, "none"),
    )
    flank = next(each["id"] for each in unit.components if each["type"] == "cylindrical_gear_flank")
    unit.relate("manufacturing_step", order=1, workpiece=flank, tool=tool)
    gears = answer(unit)["stages"][0]["requests"][LOAD]["gears"]
    assert gears["pinion"]["dedendum"] == pytest.approx(1.4)
    assert gears["rack_tip_radius"] == 0.3


def test_modifications_of_both_gears_add_on_the_flanks_that_carry() -> None:
    unit = turbo_unit()
    flanks = [each["id"] for each in unit.components if each["type"] == "cylindrical_gear_flank"]
    (_, pinion), (left, right) = flanks[:2], flanks[2:]

    def modify(flank: int, type_: str, **attributes: tuple[Value, str]) -> None:
        unit.relate("reference", origin=flank, referenced=unit.add(type_, **attributes))

    modify(pinion, "tip_relief", tip_relief_depth=(0.015, "mm"), tip_relief_datum_length=(4.0, "mm"),
           shape_of_relief=("parabolic", "none"))  # fmt: skip
    modify(right, "root_relief", root_relief_depth=(5.0, "mum"), root_relief_datum_length=(3.0, "mm"))
    modify(right, "tip_relief", tip_relief_depth=(0.012, "mm"), shape_of_relief=("parabolic", "none"))
    modify(left, "tip_relief", tip_relief_depth=(99.0, "mum"))  # the other flank
    modify(pinion, "helix_crowning", helix_crowning_amount_datum_face=(3.0, "mum"),
           helix_crowning_amount_non_datum_face=(5.0, "mum"))  # fmt: skip
    modify(pinion, "helix_slope", helix_slope=(20.0, "mum"))
    modify(right, "helix_slope", helix_slope=(2.0, "mum"))
    modify(pinion, "profile_slope", profile_slope=(6.0, "mum"))
    modify(right, "profile_slope", profile_slope=(2.0, "mum"))
    modify(right, "end_relief_datum_face", end_relief_depth_datum_face=(8.0, "mum"),
           end_relief_length_datum_face=(10.0, "mm"))  # fmt: skip
    modify(pinion, "profile_twist", twist=(1.0, "mum"))
    found = answer(unit)
    modifications = found["stages"][0]["requests"][LOAD]["modifications"]
    # right hand, positive speed: y runs against u (sigma = h = 1), so that what is missing at large u opens y = 0
    assert modifications == pytest.approx(
        {
            "tip_relief_um": 20.0,
            "tip_relief_length_mm": 4.0,
            "root_relief_um": 12.0,
            "relief_exponent": 2.0,
            "lead_crowning_um": 4.0,
            "helix_slope_um": -22.0,
            "profile_slope_um": 4.0,
            "end_relief_um": 4.0,
            "end_relief_length_mm": 10.0,
        }
    )
    assert {"ends_differ", "modification"} <= codes(found)


def test_backlash_counts_beyond_the_centre_distance() -> None:
    unit = turbo_unit()
    request = answer(unit)["stages"][0]["requests"]["/v1/pumping"]
    calculation = BY_PATH["/v1/pumping"]
    result = evaluate(calculation, calculation.request.model_validate({**request, "detail": "summary"}))
    assert result.model_dump()["geometry"]["normal_backlash_um"] == pytest.approx(300.0, rel=1e-6)


def test_drive_train_of_a_turbo_unit() -> None:
    found = answer(turbo_unit())
    assert found["findings"] == []
    (stage,) = found["stages"]
    assert stage["missing"] == []
    request = stage["requests"]["/v1/drive-train"]
    assert request["face_start_mm"] == 320.0
    assert request["operation"]["wheel_angle_deg"] == 0.0
    assert request["operation"]["rotation"] == "counterclockwise"
    assert request["operation"]["pinion_torque_n_m"] == pytest.approx(11459.156, rel=1e-6)
    assert [each["position_mm"] for each in request["pinion_shaft"]["bearings"]] == [220.0, 620.0]
    assert request["wheel_shaft"]["bearings"][0]["radial_clearance_um"] == 150.0
    assert request["pinion_shaft"]["torque_position_mm"] == 20.0
    assert [each["outer_diameter_mm"] for each in request["pinion_shaft"]["sections"]] == [160.0, 240.0, 160.0]


def test_a_unit_described_from_the_other_end_gives_the_same_loads() -> None:
    """The u axes of both shafts are reversed, and all coordinates are converted. The unit remains the same."""
    plain = answer(turbo_unit())["stages"][0]["requests"]["/v1/drive-train"]
    unit = turbo_unit()
    for each in unit.components:
        attributes = each["attributes"]
        if each["type"] == "shaft":
            (x, y, z), size = attributes["support_vector"]
            attributes["support_vector"] = ([x + 760.0, y, z], size)
            attributes["u_axis_vector"] = ([-1.0, 0.0, 0.0], size)
            if "rotational_speed" in attributes:
                attributes["rotational_speed"] = (-attributes["rotational_speed"][0], "1 / min")
        for name in ("u_coordinate_on_shaft", "u_coordinate_on_shaft_inner_side"):
            if name in attributes:
                length = attributes["length"][0] if each["type"] == "shaft_section" else 0.0
                attributes[name] = (760.0 - attributes[name][0] - length, "mm")
    turned = answer(unit)["stages"][0]["requests"]["/v1/drive-train"]
    assert turned["operation"]["rotation"] == "clockwise"
    calculation = BY_PATH["/v1/drive-train"]
    factors = []
    for request in (plain, turned):
        closed = {**request, "model": {**request.get("model", {}), "lubrication": "closed_form"}, "detail": "summary"}
        model = calculation.request.model_validate(closed)
        factors.append(evaluate(calculation, model).model_dump()["load"]["face_load_factor"])
    assert factors[0] == pytest.approx(factors[1], rel=1e-9)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ("second gear", "another gear"),
        ("one bearing", "1 radial bearings"),
        ("no axis", "where the shaft lies"),
    ],
)
def test_why_there_is_no_drive_train(change: str, words: str) -> None:
    unit = turbo_unit()
    shafts = [each["id"] for each in unit.components if each["type"] == "shaft"]
    if change == "second gear":
        unit.relate("assembly", assembly=shafts[1], part=unit.add("cylindrical_gear", number_of_teeth=(30, "none")))
    if change == "one bearing":
        unit.relations.remove(next(each for each in unit.relations if each["type"] == "side"))
    if change == "no axis":
        del unit.of(shafts[1])["support_vector"]
    (stage,) = answer(unit)["stages"]
    assert "/v1/drive-train" not in stage["requests"]
    assert any(words in each["message"] for each in stage["missing"])


@pytest.mark.parametrize(
    ("stiffness", "kind"), [((2e8, "N / m"), "linear"), ((1e23, "N / m"), "rigid"), ((0.0, "N / m"), None)]
)
def test_other_bearings_by_their_stiffness(stiffness: tuple[float, str], kind: str | None) -> None:
    unit = turbo_unit()
    for each in unit.components:
        if each["type"] == "hydrodynamic_radial_plain_bearing":
            each["type"] = "concept_bearing"
            each["attributes"]["radial_stiffness"] = stiffness
    (stage,) = answer(unit)["stages"]
    bearing = stage["requests"]["/v1/drive-train"]["pinion_shaft"]["bearings"][0]
    if kind == "linear":
        assert bearing["stiffness_n_per_um"] == pytest.approx(200.0)
    assert bearing["type"] == (kind or "linear")
    assert any("radial stiffness" in each["message"] for each in stage["missing"]) == (kind is None)


def test_what_a_bearing_lacks_is_named_at_its_place_along_the_shaft() -> None:
    unit = turbo_unit()
    first = next(each for each in unit.components if each["type"] == "hydrodynamic_radial_plain_bearing")
    first["type"] = "concept_bearing"
    first["attributes"]["u_coordinate_on_shaft_inner_side"] = (700.0, "mm")  # behind the second one
    (stage,) = answer(unit)["stages"]
    bearings = stage["requests"]["/v1/drive-train"]["pinion_shaft"]["bearings"]
    assert [each["type"] for each in bearings] == ["journal", "linear"]
    assert [each["field"] for each in stage["missing"]] == ["pinion_shaft.bearings.1.stiffness_n_per_um"]


def test_what_the_models_cannot_use_is_listed() -> None:
    unit = three_stages("1.4")
    unit.of(gear_of(unit, 0))["chamfer_at_tooth_end"] = (0.5, "mm")
    ignored = answer(unit)["stages"][0]["ignored"]
    assert [(each["component"], each["attribute"]) for each in ignored] == [(gear_of(unit, 0), "chamfer_at_tooth_end")]


@pytest.mark.parametrize("extreme", first(1, [1e300, 1e29, -1e29, 1e-300]))
def test_one_extreme_number_leaves_the_answer_finite(extreme: float) -> None:
    for place, component in enumerate(turbo_unit().components):
        for name, (value, size) in component["attributes"].items():
            if isinstance(value, float):
                unit = turbo_unit()
                unit.components[place]["attributes"][name] = (extreme, size)
                json.dumps(answer(unit.json()), allow_nan=False)


@pytest.mark.parametrize("shift", [-1e29, -1e12, 1e12, 1e29])
def test_a_profile_shift_that_no_gear_has_is_found(shift: float) -> None:
    unit = three_stages("1.4")
    unit.of(gear_of(unit, 0))["tip_diameter"] = (29.0, "mm")
    flank = next(each["id"] for each in unit.components if each["type"] == "cylindrical_gear_flank")
    unit.of(flank)["addendum_modification_coefficient"] = (shift, "none")
    assert "out_of_range" in codes(answer(unit))


@pytest.mark.parametrize("number", ["nan", "wide", 1e31, 10**400])
def test_a_vector_of_impossible_numbers_is_found(number: Value) -> None:
    unit = turbo_unit()
    shaft = next(each["id"] for each in unit.components if each["type"] == "shaft")
    unit.of(shaft)["support_vector"] = ([0.0, number, 0.0], "mm")
    assert "not_a_number" in codes(answer(unit.json()))


numbers = st.one_of(
    st.floats(allow_nan=False, allow_infinity=False), st.integers(-(10**20), 10**20), st.text(max_size=5), st.booleans()
)


@examples(100, 1000, st.data())
def test_damaged_files_never_raise(data: st.DataObject) -> None:
    unit = data.draw(st.sampled_from([three_stages, turbo_unit]))("1.4")
    for _ in range(data.draw(st.integers(1, 4))):
        attributes = data.draw(st.sampled_from(unit.components))["attributes"]
        if attributes:
            name = data.draw(st.sampled_from(sorted(attributes)))
            value = data.draw(numbers)
            attributes[name] = (value, data.draw(st.sampled_from(["mm", "none", "", "deg", "N m", "kg", "C"])))
        if data.draw(st.booleans()):
            relation = data.draw(st.sampled_from(unit.relations))
            role = data.draw(st.sampled_from(sorted(relation["roles"])))
            relation["roles"][role] = data.draw(st.integers(0, len(unit.components) + 2))
    found = gear_unit(read(unit.json(), MOST_BYTES).model)
    for stage in found["stages"]:
        lacking = {each["field"] for each in stage["missing"]}
        for endpoint, request in stage["requests"].items():
            if not lacking:
                BY_PATH[endpoint].request.model_validate(request)
