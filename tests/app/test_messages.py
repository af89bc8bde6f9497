"""A refused request says in an engineer's words what to change."""

import copy
from typing import Any

import pytest
from pydantic import ValidationError

from app.errors import Fault
from app.schema.coupling import CouplingRequest
from app.schema.model import Request
from app.schema.reading import faults
from app.schema.scuffing import LoadDistributionRequest

COUPLING: dict[str, Any] = {
    "coupling": {"teeth": 52, "module_mm": 3.0},
    "operation": {"torque_n_m": 3000, "speed_rpm": 1910, "misalignment_deg": 0.05},
}
PAIR: dict[str, Any] = {
    "gears": {"pinion": {"teeth": 23}, "wheel": {"teeth": 30}, "module_mm": 3, "face_width_mm": 20},
    "load": {"power_kw": 50, "pinion_speed_rpm": 2000},
}
GONE = object()


def refused(model: type[Request], body: dict[str, Any], path: str, value: Any) -> list[Fault]:
    changed = copy.deepcopy(body)
    *way, last = path.split(".")
    place = changed
    for part in way:
        place = place.setdefault(part, {})
    if value is GONE:
        del place[last]
    else:
        place[last] = value
    with pytest.raises(ValidationError) as refusal:
        model.model_validate(changed)
    return faults(model, refusal.value.errors())


@pytest.mark.parametrize(
    ("path", "value", "pointer", "message"),
    [
        (
            "operation.misalignement_deg",
            0.05,
            "/operation/misalignement_deg",
            "unknown field misalignement_deg; did you mean misalignment_deg?",
        ),
        ("coupling.colour", 1, "/coupling/colour", "unknown field colour"),
        ("coupling.<script>", 1, "/coupling/<script>", "unknown field"),
        ("coupling.module_mm", 0.001, "/coupling/module_mm", "module_mm is 0.001; permissible 0.1 to 100 mm"),
        (
            "operation.speed_rpm",
            "1910",
            "/operation/speed_rpm",
            'give a number, not text: 1910 instead of "1910"',
        ),
        (
            "operation.torque_n_m",
            "3,5",
            "/operation/torque_n_m",
            'give a number, not text: 3.5 instead of "3,5"',
        ),
        ("operation.torque_n_m", "a lot", "/operation/torque_n_m", "give a number, not text"),
        ("operation.torque_n_m", True, "/operation/torque_n_m", "give a number, not true or false"),
        ("operation.torque_n_m", float("nan"), "/operation/torque_n_m", "give a finite number"),
        ("operation.torque_n_m", GONE, "/operation/torque_n_m", "torque_n_m is required"),
        ("coupling.teeth", 20.5, "/coupling/teeth", "give a whole number"),
        ("lubricant", None, "/lubricant", "leave the section out instead of null"),
        ("coupling.pitch_errors_um", 3.0, "/coupling/pitch_errors_um", "give a list [...] of values here"),
        ("model.sleeve", "hanging", "/model/sleeve", "sleeve: must be one of centred, floating"),
    ],
)
def test_coupling(path: str, value: Any, pointer: str, message: str) -> None:
    fault, *others = refused(CouplingRequest, COUPLING, path, value)
    assert not others
    assert (fault.pointer, fault.message) == (pointer, message)


def test_two_ways_to_say_one_thing() -> None:
    fault = refused(LoadDistributionRequest, PAIR, "load.pinion_torque_n_m", 100)[0]
    assert fault.message == "pinion_torque_n_m and power_kw are both given; keep one"
    fault = refused(LoadDistributionRequest, PAIR, "load.power_kw", GONE)[0]
    assert fault.message == "give pinion_torque_n_m or power_kw"


def test_items_of_a_list_are_pointed_at() -> None:
    fault = refused(CouplingRequest, COUPLING, "coupling.pitch_errors_um", [1.0, "2", 3.0])[0]
    assert fault.pointer == "/coupling/pitch_errors_um/1"
    assert fault.message == 'give a number, not text: 2 instead of "2"'
    fault = refused(CouplingRequest, COUPLING, "coupling.pitch_errors_um", [1.0, 2e6])[0]
    assert fault.message == "pitch_errors_um is 2000000; permissible -10000 to 10000 µm"


def test_at_most_a_hundred_faults_are_told() -> None:
    found = refused(CouplingRequest, COUPLING, "coupling.pitch_errors_um", ["x"] * 500)
    assert len(found) == 100


def test_nothing_but_numbers_and_names_is_repeated() -> None:
    for value in ("<b>", "12; DROP", {"<i>": 1}, ["<u>"]):
        for fault in refused(CouplingRequest, COUPLING, "operation.speed_rpm", value):
            assert "<" not in fault.message
            assert "DROP" not in fault.message
