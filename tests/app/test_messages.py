"""If the service rejects a request, the message says what to change, in the words of an engineer."""

from dataclasses import replace
from typing import Any

import pytest

from solvers.errors import InvalidInput
from solvers.gears.inputs import GearTeeth
from solvers.guards import checked
from tests.support.gear_pairs import FZG_A
from tests.support.requests import COUPLING, GONE, PAIR, all_faults, refused

TORQUE, ERRORS = "operation.torque_n_m", "coupling.pitch_errors_um"


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        ("operation.misalignement_deg", 0.05, "unknown field misalignement_deg; did you mean misalignment_deg?"),
        ("coupling.colour", 1, "unknown field colour"),
        ("coupling.<script>", 1, "unknown field"),
        ("coupling.module_mm", 0.001, "module_mm is 0.001; permissible: 0.1 to 100 mm"),
        ("operation.speed_rpm", "1910", 'give a number, not text: 1910 instead of "1910"'),
        (TORQUE, "3,5", 'give a number, not text: 3.5 instead of "3,5"'),
        (TORQUE, "a lot", "give a number, not text"),
        (TORQUE, True, "give a number, not true or false"),
        (TORQUE, float("nan"), "give a finite number"),
        (TORQUE, GONE, "torque_n_m is required"),
        ("coupling.teeth", 20.5, "give a whole number"),
        ("lubricant", None, "leave the section out instead of null"),
        (ERRORS, 3.0, "give a list [...] of values here"),
        ("model.sleeve", "hanging", "sleeve: must be one of centred, floating"),
    ],
)
def test_what_is_wrong_with_a_field(path: str, value: Any, message: str) -> None:
    (fault,) = all_faults("/v1/coupling", COUPLING, {path: value})
    assert (fault.pointer, fault.message) == ("/" + path.replace(".", "/"), message)


ABOVE = (
    '"above 12" on a data sheet means that the oil passed stage 12; enter 13 as a lower limit, or the stage at which '
    "the oil failed if you know it"
)
HAND = "give the angle without a sign; the hand of the helix matters only in the drive train and is `gears.hand` there"


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        ("temperatures", {"scuffing_test": {"fzg_stage": 15}}, f"fzg_stage is 15; permissible: 1 to 14; {ABOVE}"),
        ("temperatures", {"scuffing_test": {"fzg_stage": ">12"}}, f"give a number, not text; {ABOVE}"),
        ("temperatures", {"scuffing_test": {"fzg_stage": "12+"}}, f"give a number, not text; {ABOVE}"),
        ("temperatures", {"scuffing_test": {"fzg_stage": 0}}, "fzg_stage is 0; permissible: 1 to 14"),
        ("gears.wheel.teeth", -61, "teeth is -61; permissible: 5 to 1000; internal gears are not modelled"),
        ("gears.wheel.teeth", 4, "teeth is 4; permissible: 5 to 1000"),
        ("gears.helix_angle_deg", -15, f"helix_angle_deg is -15; permissible: 0 to 45 °; {HAND}"),
        ("gears.helix_angle_deg", 50, "helix_angle_deg is 50; permissible: 0 to 45 °"),
    ],
)
def test_a_refused_value_that_has_a_known_cause_says_what_to_give(path: str, value: Any, message: str) -> None:
    assert refused("/v1/scuffing", PAIR, {path: value}) == message


def test_solvers_say_the_same_of_inputs_built_in_python() -> None:
    inputs = FZG_A
    with pytest.raises(InvalidInput, match="permissible: 0 to 45 °; give the angle without a sign"):
        checked(replace(inputs, helix_angle=-0.2))
    with pytest.raises(InvalidInput, match="internal gears are not modelled"):
        checked(replace(inputs, wheel=GearTeeth(-61)))


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        ("load.pinion_torque_n_m", 100, "pinion_torque_n_m and power_kw are both given; keep one"),
        ("load.power_kw", GONE, "give pinion_torque_n_m or power_kw"),
    ],
)
def test_two_ways_to_say_one_thing(path: str, value: Any, message: str) -> None:
    assert refused("/v1/scuffing/load-distribution", PAIR, {"model": {}, path: value}) == message


def test_items_of_a_list_are_pointed_at() -> None:
    fault = all_faults("/v1/coupling", COUPLING, {ERRORS: [1.0, "2", 3.0]})[0]
    assert fault.pointer == "/coupling/pitch_errors_um/1"
    assert fault.message == 'give a number, not text: 2 instead of "2"'
    message = "pitch_errors_um is 2000000; permissible: -10000 to 10000 µm"
    assert refused("/v1/coupling", COUPLING, {ERRORS: [1.0, 2e6]}) == message


def test_at_most_a_hundred_faults_are_told() -> None:
    assert len(all_faults("/v1/coupling", COUPLING, {ERRORS: ["x"] * 500})) == 100


@pytest.mark.parametrize("value", ["<b>", "12; DROP", {"<i>": 1}, ["<u>"]])
def test_nothing_but_numbers_and_names_is_repeated(value: Any) -> None:
    for fault in all_faults("/v1/coupling", COUPLING, {"operation.speed_rpm": value}):
        assert "<" not in fault.message
        assert "DROP" not in fault.message
