"""Two stages between the same shafts with opposite hands are the helices of one unit; other stages are not."""

import json
from collections.abc import Callable

import pytest

from app.rexs.answer import with_answer, with_results
from app.rexs.document import read
from tests.rexs.test_fields import MOST_BYTES, PUMPING, SCUFFING, TRAIN, answer, stage_of
from tests.rexs.units import LOWER, UPPER, Unit, Value, double_helical, gears, held, modified

SHARE = "custom_tribodrive_share"


def of_type(unit: Unit, type_: str) -> list[int]:
    return [each["id"] for each in unit.components if each["type"] == type_]


def finding(unit: Unit, code: str) -> str:
    (message,) = [each["message"] for each in answer(unit)["findings"] if each["code"] == code]
    return str(message)


def test_two_stages_are_one_double_helical_unit() -> None:
    content = answer(double_helical())
    (stage,) = content["stages"]
    assert content["findings"] == []
    assert stage["helices"] == [LOWER, UPPER]
    requests = stage["requests"]
    for request in (requests[TRAIN], requests[SCUFFING], requests[PUMPING]):
        assert request["gears"]["face_width_mm"] == 110.0
        assert request["gears"]["gap_width_mm"] == 60.0
    unit = requests[TRAIN]
    assert (unit["gears"]["hand"], unit["face_start_mm"]) == ("right", 320.0)
    assert unit["operation"]["pinion_torque_n_m"] == pytest.approx(11459.16)
    (reason,) = [each["reason"] for each in stage["assumed"] if each["field"] == "load.pinion_torque_n_m"]
    assert "a division that the file states is not used" in reason
    sections = [(each["length_mm"], each["outer_diameter_mm"]) for each in unit["wheel_shaft"]["sections"]]
    assert [length for length, _ in sections] == [320.0, 110.0, 60.0, 110.0, 240.0]
    assert sections[2][1] == 800.0, "the gap is not thickened to the root of the teeth"


def second_first(unit: Unit) -> None:
    """Name the stage at the higher Z first in the file, with its gears in the other order."""
    lower, upper = unit.components[LOWER - 1], unit.components[UPPER - 1]
    unit.components[LOWER - 1], unit.components[UPPER - 1] = upper, lower
    roles = next(each["roles"] for each in unit.relations if each["roles"].get("stage") == UPPER)
    roles["gear_1"], roles["gear_2"] = roles["gear_2"], roles["gear_1"]


def test_the_order_in_the_file_does_not_matter() -> None:
    unit = double_helical()
    second_first(unit)
    assert stage_of(unit)["requests"] == stage_of(double_helical())["requests"]
    assert stage_of(unit)["helices"] == [LOWER, UPPER]


def from_the_other_end(unit: Unit) -> None:
    """Describe the same unit with u axes that point the other way; slopes then count from the other faces."""
    for each in unit.components:
        own = each["attributes"]
        for name in ("u_coordinate_on_shaft", "u_coordinate_on_shaft_inner_side"):
            if name in own:
                own[name] = (840.0 - own[name][0] - own.get("length", (0.0,))[0], "mm")
        if each["type"] == "shaft":
            own["support_vector"] = ([840.0, *own["support_vector"][0][1:]], "mm")
            own["u_axis_vector"] = ([-1.0, 0.0, 0.0], "mm")
        for name in ("rotational_speed", "helix_slope"):
            if name in own:
                own[name] = (-own[name][0], own[name][1])


def test_from_the_other_end_the_helices_change_places() -> None:
    unit = double_helical()
    modified(unit, LOWER, "helix_slope", helix_slope=(20.0, "mum"))
    modified(unit, UPPER, "helix_slope", helix_slope=(5.0, "mum"))
    before = stage_of(unit)["requests"][TRAIN]
    from_the_other_end(unit)
    stage = stage_of(unit)
    after = stage["requests"][TRAIN]
    assert stage["helices"] == [UPPER, LOWER]
    assert (after["gears"]["hand"], after["operation"]["rotation"]) == ("left", "clockwise"), "the apex leads as before"
    assert after["face_start_mm"] == 840.0 - (before["face_start_mm"] + 280.0)
    slopes = [
        (each["helix_slope_um"], each["second_helix"]["helix_slope_um"])
        for each in (before["modifications"], after["modifications"])
    ]
    assert slopes[0] == slopes[1][::-1]


def test_unequal_widths_are_found_and_the_smaller_one_is_taken() -> None:
    unit = double_helical()
    for gear in gears(unit, LOWER):
        unit.of(gear)["face_width"] = (90.0, "mm")
    request = stage_of(unit)["requests"][TRAIN]
    assert (request["gears"]["face_width_mm"], request["gears"]["gap_width_mm"]) == (90.0, 70.0)
    assert request["face_start_mm"] == 330.0, "the lower helix keeps its place"
    assert "90 and 110 mm wide" in finding(unit, "widths_differ")


def same_hand(unit: Unit) -> None:
    for gear, other in zip(gears(unit, LOWER), gears(unit, UPPER), strict=True):
        unit.of(other)["helix_angle_reference_diameter"] = unit.of(gear)["helix_angle_reference_diameter"]


def changed(name: str, value: Value, size: str, type_: str = "cylindrical_gear") -> Callable[[Unit], None]:
    """Return a change of an attribute of the last component of a type."""

    def change(unit: Unit) -> None:
        unit.of(of_type(unit, type_)[-1])[name] = (value, size)

    return change


def nowhere(unit: Unit) -> None:
    del unit.of(gears(unit, UPPER)[0])["u_coordinate_on_shaft"]


def overlapping(unit: Unit) -> None:
    for gear in gears(unit, UPPER):
        unit.of(gear)["u_coordinate_on_shaft"] = (470.0, "mm")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (same_hand, "both helices of the pinion are right-hand"),
        (changed("number_of_teeth", 131, "none"), "the numbers of teeth are 39/130 and 39/131"),
        (changed("center_distance", 530.0, "mm", "cylindrical_stage"), "the centre distances are 526.362 and 530 mm"),
        (nowhere, "at which positions of the shafts the gears sit"),
        (overlapping, "the faces of the helices overlap"),
    ],
)
def test_stages_that_do_not_agree_stay_two(change: Callable[[Unit], None], words: str) -> None:
    unit = double_helical()
    change(unit)
    assert words in finding(unit, "not_double_helical")
    stages = answer(unit)["stages"]
    assert [stage["helices"] for stage in stages] == [None, None]
    for stage in stages:
        assert TRAIN not in stage["requests"]
        assert "gap_width_mm" not in stage["requests"][SCUFFING]["gears"]


def test_each_helix_has_its_own_correction() -> None:
    """Material at the end of high Z: the last end of one helix, and the first one of the other."""
    unit = double_helical()
    for stage in (LOWER, UPPER):
        modified(unit, stage, "helix_slope", helix_slope=(20.0, "mum"))
    modified(unit, UPPER, "helix_crowning", helix_crowning_amount_datum_face=(4.0, "mum"))
    modified(unit, LOWER, "tip_relief", tip_relief_depth=(15.0, "mum"))
    requests = stage_of(unit)["requests"]
    modifications = requests[TRAIN]["modifications"]
    assert modifications["helix_slope_um"] == -20.0
    assert modifications["second_helix"] == {"helix_slope_um": 20.0, "lead_crowning_um": 4.0}
    assert "second_helix" not in requests[SCUFFING]["modifications"]
    assert "modifications.tip_relief_um: the helices differ (15 and 0)" in finding(unit, "helices_differ")


def test_torques_of_the_gears_add_up() -> None:
    unit = double_helical()
    del unit.of(of_type(unit, "external_load")[0])["power"]
    for stage, torque in ((LOWER, 7000.0), (UPPER, 4000.0)):
        pinion = gears(unit, stage)[0]
        data = unit.add("cylindrical_stage_gear_data", torque=(torque, "N m"), is_driving_gear=(True, "none"))
        unit.relate("stage_gear_data", stage=stage, gear=pinion, stage_gear_data=data)
    assert stage_of(unit)["requests"][SCUFFING]["load"]["pinion_torque_n_m"] == 11000.0
    del unit.components[-1]["attributes"]["torque"]
    lacking = stage_of(unit)
    assert "pinion_torque_n_m" not in lacking["requests"][SCUFFING]["load"]
    assert "load.pinion_torque_n_m" in {each["field"] for each in lacking["missing"]}


def test_the_shaft_that_no_bearing_holds_floats() -> None:
    unit = double_helical()
    unit.of(of_type(unit, "external_load")[0])["force_u_direction"] = (-5.0, "kN")
    wheel = held(unit, 1)
    requests = stage_of(unit)["requests"]
    assert (requests[TRAIN]["floating_shaft"], requests[TRAIN]["operation"]["axial_force_n"]) == ("pinion", -5e3)
    assert requests[SCUFFING]["load"]["axial_force_n"] == -5e3
    held(unit, 0)
    assert "one shaft floats" in finding(unit, "both_shafts_held")
    unit.of(wheel)["axial_force_absorption"] = ("no_direction", "none")
    train = stage_of(unit)["requests"][TRAIN]
    assert train["floating_shaft"] == "wheel"
    assert "axial_force_n" not in train["operation"], "the force acts on the shaft that is held"


def test_results_of_each_helix_are_written_to_its_stage() -> None:
    unit, body = double_helical(), stage_of(double_helical())["requests"][TRAIN]
    body |= {"operation": body["operation"] | {"axial_force_n": 10e3}, "floating_shaft": "pinion"}
    body["model"] = {"lubrication": "closed_form"}
    body["temperatures"] |= {"bulk_c": 90.0, "scuffing_c": 250.0}
    file = with_results(unit.xml(), MOST_BYTES, UPPER, json.dumps(body).encode(), 60.0)
    components = read(file.content, MOST_BYTES).model.components
    lower, upper = (
        {name: attribute.value for name, attribute in components[stage].attributes.items()} for stage in (LOWER, UPPER)
    )
    assert float(lower[SHARE]) + float(upper[SHARE]) == pytest.approx(1.0, abs=1e-12)
    assert float(upper[SHARE]) == pytest.approx(0.6, abs=2e-3), "10 kN of the 50.2 kN that unload a helix"
    for name in ("face_load_factor_contact_stress", "custom_tribodrive_scuffing_safety_blok_flank"):
        assert lower[name] != upper[name]
    assert lower["custom_tribodrive_case"] == upper["custom_tribodrive_case"]
    assert "custom_tribodrive_total_power_loss" in lower
    assert "custom_tribodrive_total_power_loss" not in upper, "the unit's loss is not counted twice"


def test_the_more_loaded_helix_of_a_pair_is_written_to_both_stages() -> None:
    document = read(double_helical().xml(), MOST_BYTES)
    found = {"status": "ok", "case": "0", "load": {"face_load_factor": 1.2}, "helix": {"share": 0.6}}
    written = read(with_answer(document, [LOWER, UPPER], SCUFFING, found).content, MOST_BYTES).model
    for stage in (LOWER, UPPER):
        own = written.components[stage].attributes
        assert (own["face_load_factor_contact_stress"].value, own[SHARE].value) == ("1.2", "0.6")
