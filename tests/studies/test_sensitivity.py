"""Sensitivities agree with derivatives known from physics, use one side at the end of a range, and mark kinks."""

from dataclasses import replace
from typing import Any

import pytest

from app.calculations import BY_PATH, CALCULATIONS, Calculation
from app.examples import examples
from app.schema.fields import Leaf, leaf_at, leaves
from app.studies.fields import fault
from app.studies.kinds.sensitivity import Perturbation, Sensitivity, differences, perturbation
from app.studies.kinds.sweep import Sweep
from tests.support.requests import changed
from tests.support.studies import lines_of, study_of

COUPLING = examples()["pahl-axial-displacement"]
UNIT = "starter-turbo-gear-drive-train"
CLOSED_FORM = {"request.model": {"lubrication": "closed_form"}}
INTEGRAL = CLOSED_FORM | {
    "request.pinion_shaft.sections.3.outer_diameter_mm": 238.8,
    "request.model.bearing_film": "short",
}
"""The turbo gear whose pinion is as thick as its reference diameter, 238.8 mm. The slopes below hold for this gear."""
FACE_LOAD_FACTOR = "load.face_load_factor"


def sensitivities(example: str, changes: dict[str, Any] | None = None, **parts: Any) -> list[dict[str, Any]]:
    """Return the lines of a sensitivity study of an example. `changes` replaces values of the body at dotted paths."""
    return lines_of(Sensitivity(changed(study_of(example, **parts), changes or {}), 2500, 30.0))


@pytest.mark.parametrize(
    ("example", "changes", "output", "path", "exponent"),
    [
        (
            COUPLING.name,
            {"request.friction": {"coefficient": 0.17}},
            "axial_thrust.coaxial_limit_n",
            "friction.coefficient",
            1.0,
        ),
        ("xue-line-contact-isothermal", {}, "hertz.max_pressure_mpa", "contact.line_load_n_per_mm", 0.5),
        ("milian-table-1-incompressible", {}, "total.pumping_power_w", "operation.pinion_speed_rpm", 3.0),
    ],
)
def test_an_output_goes_with_its_known_power_of_an_input(
    example: str, changes: dict[str, Any], output: str, path: str, exponent: float
) -> None:
    line, end = sensitivities(example, changes, outputs=[output], inputs=[path])
    assert line["elasticity"] == pytest.approx(exponent, abs=1e-3)
    slope = exponent * end["outputs"][0]["value"] / end["inputs"][0]["value"]
    assert line["derivative"] == pytest.approx(slope, rel=1e-3)
    assert line["kink"] is False


def test_every_item_of_a_list_is_moved() -> None:
    """As long as all teeth carry load, an equal pitch error of all teeth changes nothing."""
    # The slopes with respect to the errors of the single teeth therefore add up to zero.
    errors = [2.0, -1.0, 0.5, -0.5] * 5
    errors[7] = 3.0
    request = {
        "coupling": {**COUPLING.request["coupling"], "teeth": len(errors), "pitch_errors_um": errors},
        "operation": {"torque_n_m": 1200, "speed_rpm": 1910, "misalignment_deg": 0},
    }
    parts = {"request": request, "outputs": ["load_distribution.max_tangential_force_n"]}
    *lines, _ = sensitivities(COUPLING.name, **parts)
    slopes = {line["path"]: line["derivative"] for line in lines if "pitch_errors_um" in line["path"]}
    assert set(slopes) == {f"coupling.pitch_errors_um.{tooth}" for tooth in range(len(errors))}
    largest = slopes["coupling.pitch_errors_um.7"]
    assert largest > 0.0
    assert [each for path, each in slopes.items() if not path.endswith(".7")] == pytest.approx(
        [-largest / (len(errors) - 1)] * (len(errors) - 1), rel=1e-6
    )
    named, _ = sensitivities(COUPLING.name, **parts, inputs=["coupling.pitch_errors_um.7"])
    assert named["derivative"] == largest


def test_every_number_is_moved_sorted_by_influence() -> None:
    *lines, end = sensitivities(COUPLING.name)
    outputs = [each["path"] for each in end["outputs"]]
    assert [line["output"] for line in lines] == [output for output in outputs for _ in end["inputs"]]
    for output in outputs:
        changes = [line["range"] or 0.0 for line in lines if line["output"] == output]
        assert changes == sorted(changes, reverse=True)
        assert changes[0] > 0.0
    moved = {each["path"] for each in end["inputs"]}
    given = BY_PATH[COUPLING.endpoint].request.model_validate(COUPLING.request)
    numbers = [leaf for leaf in leaves(type(given)) if leaf.kind in {"number", "integer"} and leaf.is_scalar]
    assert {leaf.path for leaf in numbers if leaf.advanced} & moved == set()
    assert {
        "coupling.teeth",
        "operation.torque_n_m",
        "lubricant.viscosity_pa_s",
        "coupling.youngs_modulus_gpa",
    } <= moved
    measures = ["range", "lowered", "raised", "derivative", "elasticity", "step", "change", "kink", "curved"]
    assert list(lines[0]) == ["type", "output", "path", *measures]
    whole = lines[: len(moved)]
    sides = 2 * len(moved) - sum(line["kink"] is None for line in whole)
    assert end["points"] == 1 + sides + 2 * sum(line["curved"] is not None for line in whole)
    assert end["status"] == "ok"


def test_places_of_lists_are_moved() -> None:
    body = study_of("milian-case-1-groove")
    paths = [each.leaf.path for each in Sensitivity(body, 2500, 30.0).perturbations]
    count = len(body["request"]["grooves"])
    assert [path for path in paths if path.startswith("grooves")] == [
        f"grooves.{place}.{name}" for name in ("position_mm", "width_mm") for place in range(count)
    ]


def leaf(**changes: Any) -> Leaf:
    found = leaf_at(BY_PATH["/v1/coupling"].request, "friction.coefficient")
    assert found is not None
    kind, unit = changes.pop("kind", "number"), changes.pop("unit", None)
    plain = {"tolerance": None, "relative_tolerance": None, "ge": 0.0, "le": 50.0}
    return replace(found, kind=kind, unit=unit, declared=replace(found.declared, **{**plain, **changes}))


@pytest.mark.parametrize(
    ("changes", "value", "below", "above"),
    [
        ({}, 20.0, 19.8, 20.2),
        ({"tolerance": 0.5}, 20.0, 19.5, 20.5),
        ({"unit": "°C"}, 20.0, 19.0, 21.0),
        ({"unit": "K"}, 20.0, 19.8, 20.2),
        ({"unit": "°C", "tolerance": 2.0}, 20.0, 18.0, 22.0),
        ({"kind": "integer"}, 20, 19, 21),
        ({"kind": "integer", "ge": 20, "le": 50}, 20, None, 21),
        ({"tolerance": 0.5}, 0.0, None, 0.5),
        ({"tolerance": 0.5, "relative_tolerance": 0.01}, 20.0, 19.5, 20.5),
        ({"tolerance": 0.5, "relative_tolerance": 0.05}, 20.0, 19.0, 21.0),
        ({"relative_tolerance": 0.1}, 20.0, 18.0, 22.0),
        ({"gt": 0.0, "le": 50.0, "tolerance": 1.0}, 1.0, None, 2.0),
        ({}, 50.0, 49.5, None),
        ({"ge": -50.0, "le": 50.0}, -20.0, -20.2, -19.8),
    ],
)
def test_steps(changes: dict[str, Any], value: float, below: float | None, above: float | None) -> None:
    found = perturbation(leaf(**changes), value)
    whole = [place for place in (below, above) if place is not None]
    assert replace(found, half=None).places == pytest.approx(whole)
    assert all(isinstance(place, type(value)) for place in found.places)


def test_a_field_with_one_value_only_is_not_moved() -> None:
    assert perturbation(leaf(ge=3.0, le=3.0), 3.0).places == []
    assert perturbation(leaf(ge=0.0, le=0.0, tolerance=1.0), 0.0).places == []


def test_a_tolerance_is_checked_at_half_of_it() -> None:
    assert perturbation(leaf(tolerance=0.5), 20.0).places == [19.5, 20.5, 19.75, 20.25]
    assert perturbation(leaf(), 20.0).half is None


@pytest.mark.parametrize("calculation", CALCULATIONS, ids=lambda each: each.path)
def test_every_number_that_may_be_zero_has_a_tolerance(calculation: Calculation) -> None:
    for each in leaves(calculation.request):
        if each.kind == "number" and fault(each, 0.0) is None:
            assert each.declared.tolerance, each.path


Moved = tuple[Perturbation, dict[float, float | None]]


def moved(base: float | None, below: float | None, above: float | None, value: float = 10.0, **changes: Any) -> Moved:
    """Return the perturbation of an input, and the outputs at its value, one step below and one step above."""
    found = perturbation(leaf(**{"tolerance": 1.0, **changes}), value)
    return found, {value - found.step: below, value: base, value + found.step: above}


@pytest.mark.parametrize(
    ("half", "curved"),
    [
        ((95.0, 105.0), False),
        ((95.4, 105.0), False),
        ((96.0, 104.0), True),
        ((None, 104.0), True),
        ((None, None), None),
    ],
)
def test_a_derivative_that_half_the_step_does_not_confirm_is_curved(
    half: tuple[float | None, float | None], curved: bool | None
) -> None:
    whole, outputs = moved(100.0, 90.0, 110.0)
    assert differences(whole, outputs | dict(zip((9.5, 10.5), half, strict=True)))["curved"] is curved
    assert differences(*moved(100.0, 90.0, 110.0, tolerance=None))["curved"] is None


@pytest.mark.parametrize(
    ("values", "derivative", "elasticity", "change", "kink"),
    [
        ((100.0, 90.0, 110.0), 10.0, 1.0, 10.0, False),
        ((100.0, 100.0, 110.0), 5.0, 0.5, 10.0, True),
        ((100.0, 105.0, 105.0), 0.0, 0.0, -5.0, True),  # the bottom of a valley counts
        ((100.0, 90.0, 110.5), 10.25, 1.025, 10.5, False),
        ((100.0, 90.0, 112.0), 11.0, 1.1, 12.0, True),
        ((100.0, None, 110.0), 10.0, 1.0, 10.0, None),
        ((100.0, 90.0, None), 10.0, 1.0, 10.0, None),
        ((100.0, None, None), None, None, None, None),
        ((None, 90.0, 110.0), None, None, None, None),
        ((0.0, -1.0, 1.0), 1.0, None, 1.0, False),
        ((100.0, 100.0, 100.0 + 1e-6), 5e-7, 5e-8, 1e-6, False),  # what an iteration leaves is no kink
    ],
)
def test_differences(
    values: tuple[float | None, float | None, float | None],
    derivative: float | None,
    elasticity: float | None,
    change: float | None,
    kink: bool | None,
) -> None:
    found = differences(*moved(*values))
    for name, expected in {"derivative": derivative, "elasticity": elasticity, "change": change}.items():
        assert found[name] is None if expected is None else found[name] == pytest.approx(expected, rel=1e-6, abs=1e-12)
    assert found["kink"] is kink


@pytest.mark.parametrize(
    ("values", "lowered", "raised", "spread"),
    [
        ((100.0, 90.0, 110.0), -10.0, 10.0, 20.0),
        ((100.0, 95.0, 95.0), -5.0, -5.0, 5.0),  # the top of a hill, which a slope and a rank correlation do not see
        ((100.0, None, 110.0), None, 10.0, 10.0),
        ((100.0, None, None), None, None, None),
        ((None, 90.0, 110.0), None, None, None),
    ],
)
def test_the_range_sees_an_effect_of_either_sign(
    values: tuple[float | None, float | None, float | None],
    lowered: float | None,
    raised: float | None,
    spread: float | None,
) -> None:
    found = differences(*moved(*values))
    assert (found["lowered"], found["raised"], found["range"]) == (lowered, raised, spread)


def test_the_range_sees_what_half_a_step_does() -> None:
    whole, outputs = moved(100.0, 100.0, 100.0)
    assert differences(whole, outputs | {9.5: 97.0, 10.5: 101.0})["range"] == 4.0


def test_inputs_move_by_tolerances_that_users_have() -> None:
    by_class = {"application_factor": 0.1, "power_kw": 0.05, "pinion_torque_n_m": 0.05}
    for path in ("load.{}", "operation.{}"):
        request = BY_PATH["/v1/scuffing" if path.startswith("load") else "/v1/drive-train"].request
        for name, share in by_class.items():
            field = leaf_at(request, path.format(name))
            assert field is not None
            assert field.declared.tolerance_of(1000.0) == pytest.approx(share * 1000.0)
        for friction in ("friction_coefficient", "friction_factor"):
            field = leaf_at(request, friction)
            assert field is not None
            assert field.declared.tolerance_of(1.0) == pytest.approx(0.3)


def test_no_elasticity_at_zero_and_for_degrees() -> None:
    assert differences(*moved(100.0, None, 110.0, value=0.0))["elasticity"] is None
    assert differences(*moved(100.0, 90.0, 110.0, unit="°C"))["elasticity"] is None
    assert differences(*moved(0.0, -1.0, 1.0))["elasticity"] is None


@pytest.fixture(scope="module")
def turbo_unit() -> list[dict[str, Any]]:
    """Return the sensitivities of two outputs of the turbo unit.

    Most of the moved inputs are offsets of bearings, which the request leaves at their defaults.
    """
    inputs = [
        *(f"{shaft}_shaft.bearings.{k}.offset_um.{axis}" for shaft, k, axis in (("pinion", 0, 1), ("wheel", 1, 0))),
        "couplings.0.slope_mrad.0",
        "pinion_shaft.start_mm",
    ]
    assert not any("offset_um" in each for each in examples()[UNIT].request["pinion_shaft"]["bearings"])
    return sensitivities(UNIT, INTEGRAL, outputs=[FACE_LOAD_FACTOR, "safety.blok_flank"], inputs=inputs)


def test_lists_left_to_their_defaults_are_moved(turbo_unit: list[dict[str, Any]]) -> None:
    *lines, end = turbo_unit
    assert len(lines) == 8
    assert end["counts"]["ok_with_warnings"] == end["points"] - end["counts"].get("refused", 0)
    assert all(line["derivative"] is not None for line in lines if "offset_um" in line["path"])
    assert all(line["derivative"] for line in lines if line["path"] == "couplings.0.slope_mrad.0")


def test_bore_offsets_move_by_what_a_bore_is_off(turbo_unit: list[dict[str, Any]]) -> None:
    """The face load factor changes by +0.00118 per um of offset of the first pinion bore."""
    # Two single requests, with offsets of 1 um up and down, gave this slope. Offsets of 100 um gave -0.00024 per um.
    (found,) = (
        line
        for line in turbo_unit
        if line["type"] == "sensitivity"
        and (line["output"], line["path"]) == (FACE_LOAD_FACTOR, "pinion_shaft.bearings.0.offset_um.1")
    )
    assert found["step"] <= 5
    assert found["derivative"] == pytest.approx(0.00118, rel=0.02)
    assert found["curved"] is False


def test_a_step_that_is_too_large_says_so() -> None:
    """If the first pinion bore is moved by 100 um, the slope is -0.00024 per um."""
    # The slopes on both sides differ, and the study reports a kink.
    path = "pinion_shaft.bearings.0.offset_um"
    vary = [{"path": f"{path}.1", "values": [-100, -50, 0, 50, 100]}]
    body = changed(study_of(UNIT, vary=vary, outputs=[FACE_LOAD_FACTOR]), INTEGRAL)
    points = [line for line in lines_of(Sweep(body, 2500, 30.0)) if line["type"] == "point"]
    leaf = leaf_at(BY_PATH["/v1/drive-train"].request, path)
    assert leaf is not None
    known = replace(leaf, path=f"{path}.1", declared=replace(leaf.declared, tolerance=100.0))
    found = differences(perturbation(known, 0.0), {line["at"][0]: line["out"][0] for line in points})
    assert found["derivative"] == pytest.approx(-0.000236, rel=0.02)
    assert found["kink"] is True


def test_a_change_of_regime_is_a_kink() -> None:
    """The face load factor has different derivatives below and above a helix slope of 0."""
    line, end = sensitivities("xue-pair-1", outputs=[FACE_LOAD_FACTOR], inputs=["modifications.helix_slope_um"])
    assert end["inputs"][0]["value"] == 0.0
    assert line["elasticity"] is None
    assert line["kink"] is True
    assert line["change"] > 0.0 or line["change"] < 0.0


def test_no_thermal_film_is_computed_for_outputs_that_need_none() -> None:
    for output, lubrication in (("safety.blok_factor", "closed_form"), ("safety.thermal_ehl_factor", None)):
        study = Sensitivity(study_of("starter-high-speed-scuffing", outputs=[output]), 2500, 30.0)
        assert study.question.base["model"].get("lubrication") == lubrication
