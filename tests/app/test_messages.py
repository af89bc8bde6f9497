"""A refused request says in an engineer's words what to change."""

from typing import Any

import pytest

from tests.support.requests import COUPLING, GONE, PAIR, all_faults, refused

TORQUE, ERRORS = "operation.torque_n_m", "coupling.pitch_errors_um"


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        ("operation.misalignement_deg", 0.05, "unknown field misalignement_deg; did you mean misalignment_deg?"),
        ("coupling.colour", 1, "unknown field colour"),
        ("coupling.<script>", 1, "unknown field"),
        ("coupling.module_mm", 0.001, "module_mm is 0.001; permissible 0.1 to 100 mm"),
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
    message = "pitch_errors_um is 2000000; permissible -10000 to 10000 µm"
    assert refused("/v1/coupling", COUPLING, {ERRORS: [1.0, 2e6]}) == message


def test_at_most_a_hundred_faults_are_told() -> None:
    assert len(all_faults("/v1/coupling", COUPLING, {ERRORS: ["x"] * 500})) == 100


@pytest.mark.parametrize("value", ["<b>", "12; DROP", {"<i>": 1}, ["<u>"]])
def test_nothing_but_numbers_and_names_is_repeated(value: Any) -> None:
    for fault in all_faults("/v1/coupling", COUPLING, {"operation.speed_rpm": value}):
        assert "<" not in fault.message
        assert "DROP" not in fault.message
