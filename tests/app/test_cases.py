"""If the inputs in an answer are posted again, the case is the same. Defaults of requests are those of the solvers."""

import dataclasses
import hashlib
import json
from collections.abc import Iterator
from typing import Any

import pytest

from app.calculations import BY_PATH, Calculation
from app.evaluate import evaluate, written
from app.examples import examples
from app.schema.fields import field_path
from app.schema.model import Request
from app.sources import SOURCES

SOLVED = ("pahl-z-arrangement", "pahl-sleeve-orbit", "milian-table-1-incompressible", "xue-pair-1-modified")


def case(name: str, **changes: Any) -> tuple[Calculation, Request]:
    example = examples()[name]
    calculation = BY_PATH[example.endpoint]
    return calculation, calculation.request.model_validate({**example.request, "detail": "summary", **changes})


def sent_back(request: Request) -> Request:
    inputs = json.loads(json.dumps(request.model_dump(mode="json", exclude={"detail"})))
    return type(request).model_validate({**inputs, "detail": request.detail})


@pytest.mark.parametrize("name", sorted(examples()))
def test_inputs_posted_back_are_the_solver_s_same_inputs(name: str) -> None:
    _, request = case(name)
    assert sent_back(request).inputs() == request.inputs()


@pytest.mark.parametrize("name", SOLVED)
def test_inputs_posted_back_give_the_same_numbers_and_case(name: str) -> None:
    calculation, request = case(name)
    first = json.loads(written(evaluate(calculation, request)))
    again = calculation.request.model_validate({**first["inputs"], "detail": "summary"})
    second = json.loads(written(evaluate(calculation, again)))
    assert "detail" not in first["inputs"]
    assert second | {"assumptions": None} == first | {"assumptions": None}


def test_case_is_the_hash_that_the_contract_describes() -> None:
    calculation, request = case("xue-pair-1-modified", detail="curves")
    answer = json.loads(written(evaluate(calculation, request)))
    content = {"endpoint": calculation.path, "inputs": answer["inputs"], "sources": SOURCES}
    text = json.dumps(content, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
    assert answer["case"] == hashlib.sha256(text.encode()).hexdigest()


def test_case_depends_on_inputs_only() -> None:
    calculation, request = case("pahl-z-arrangement")
    same = case("pahl-z-arrangement", detail="curves", lubricant={"viscosity_pa_s": request.lubricant.viscosity_pa_s})
    other = case("pahl-z-arrangement", lubricant={"viscosity_pa_s": 0.03})
    found = [evaluate(*each).case for each in ((calculation, request), same, other)]
    assert found[0] == found[1]
    assert found[0] != found[2]


def test_derived_says_what_the_request_left_open() -> None:
    calculation, request = case("pahl-z-arrangement")
    derived = evaluate(calculation, request).model_dump()["derived"]
    module = request.coupling.module_mm
    assert derived == {
        "face_width_mm": pytest.approx(8 * module),
        "tooth_height_mm": pytest.approx(2 * module),
        "tooth_stiffness_n_per_um": 280.0,
        "viscosity_pa_s": request.lubricant.viscosity_pa_s,
        "viscosity_index": None,
    }


def test_torque_follows_from_power() -> None:
    load = {"power_kw": 100, "pinion_speed_rpm": 3000}
    derived = evaluate(*case("xue-pair-1-modified", load=load)).model_dump()["derived"]
    assert derived["pinion_torque_n_m"] == pytest.approx(9549.297 * 100 / 3000, rel=1e-6)
    assert derived["power_kw"] == pytest.approx(100)


def test_assumed_lengths_are_those_derived() -> None:
    calculation, request = case("xue-pair-1-modified", modifications={"tip_relief_um": 10, "end_relief_um": 5})
    answer = evaluate(calculation, request).model_dump()
    assumed = {each["field"]: each["value"] for each in answer["assumptions"]}
    for relief in ("tip_relief", "end_relief"):
        length = answer["derived"][f"{relief}_length_mm"]
        assert assumed[f"modifications.{relief}_length_mm"] == length
        assert length > 0
    assert answer["derived"]["end_relief_length_mm"] == pytest.approx(request.gears.face_width_mm / 10)
    assert "modifications.root_relief_length_mm" not in assumed


@pytest.mark.parametrize(
    ("load", "sent"),
    [
        ({"power_kw": 100, "pinion_speed_rpm": 3000}, "load.power_kw"),
        ({"pinion_torque_n_m": 100, "pinion_speed_rpm": 3000}, "load.pinion_torque_n_m"),
    ],
)
def test_a_solver_s_torque_is_the_field_that_was_sent(load: dict[str, float], sent: str) -> None:
    _, request = case("xue-pair-1-modified", load=load)
    assert field_path(request, "pinion_torque") == sent
    assert field_path(request, "wheel.teeth") == "gears.wheel.teeth"
    assert field_path(request, "no_such_input") is None


def test_fields_of_list_items_are_found() -> None:
    _, request = case("milian-case-1-groove")
    assert field_path(request, "grooves.0.width") == "grooves.0.width_mm"


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        ("pinion_shaft.bearings.1.viscosity", "pinion_shaft.bearings.1.viscosity_pa_s"),
        ("couplings.0.lubricant.viscosity", "couplings.0.lubricant.viscosity_pa_s"),
        ("couplings.0.coupling.face_width", "couplings.0.coupling.face_width_mm"),
        ("couplings.0.pitch_errors", "couplings.0.coupling.pitch_errors_um"),
        ("couplings.0.misalignment", "couplings.0"),
        ("couplings.7.position", None),
        ("lubricant.viscosity", "lubricant.viscosity_pa_s"),
        ("face_width", "gears.face_width_mm"),
        ("heat.wall_response", "thermal.wall_response"),
        ("collar_radius", "thrust_collar.radius_mm"),
        ("wheel_shaft.ultimate_thrust", "wheel_shaft.thrust_bearing.ultimate_load_n"),
        ("mesh.distribution.modifications.helix_slope", "modifications.helix_slope_um"),
    ],
)
def test_what_a_solver_of_many_parts_names_is_found(said: str, meant: str | None) -> None:
    """A solver's name of an input leads to the field of the request."""
    # If several fields match, the outermost field is meant. For a list item, the item's own field is meant, or the item
    # itself if it lacks the field.
    _, request = case("starter-turbo-gear-drive-train")
    assert field_path(request, said) == meant


@pytest.mark.parametrize("name", sorted(examples()))
def test_defaults_are_the_solver_s(name: str) -> None:
    """If a request leaves out a field with a default, the solver gets its own default."""
    # Methods are not checked, because they follow from other fields.
    example = examples()[name]
    calculation = BY_PATH[example.endpoint]
    request = calculation.request.model_validate(example.request)
    methods = getattr(request, "methods", {})  # follow from what else is given
    for given, path in declared(request.inputs()):
        for field in dataclasses.fields(given):
            default = default_of(field)
            wanted = field_path(request, f"{path}{field.name}")
            if default is None or wanted is None or not is_default(request, wanted) or wanted in methods:
                continue
            value = getattr(given, field.name)
            assert value == (pytest.approx(default, rel=1e-12) if isinstance(default, float) else default), field.name


def default_of(field: "dataclasses.Field[Any]") -> Any:
    """Return the default of a field if it is a number or a text, otherwise None.

    `rack_tip_radius` also gives None, because its default differs between models.
    """
    plain = isinstance(field.default, float | int | str) and field.name != "rack_tip_radius"
    return field.default if plain else None


def declared(inputs: Any, path: str = "") -> Iterator[tuple[Any, str]]:
    """Yield the solver's inputs and all dataclasses inside them, each with the last part of its path."""
    yield inputs, path
    for field in dataclasses.fields(inputs):
        value = getattr(inputs, field.name)
        if dataclasses.is_dataclass(value):
            yield from declared(value, f"{field.name}.")


def is_default(request: Request, path: str) -> bool:
    """Return whether a field has a value although the request leaves the field out."""
    section: Any = request
    *sections, name = path.split(".")
    for part in sections:
        section = getattr(section, part)
    return name not in section.model_fields_set and getattr(section, name) is not None
