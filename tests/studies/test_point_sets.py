"""What a sweep asks for is checked before its first line, and every fault has its place and its code."""

import json
from typing import Any

import numpy as np
import pytest

from app.errors import InvalidBody, Unprocessable, faults_of
from app.examples import examples
from app.studies.sensitivity import Sensitivity
from app.studies.sweep import Sweep

COUPLING = examples()["pahl-axial-displacement"]
LOADS = examples()["xue-pair-1-modified"]
GROOVE = examples()["milian-case-1-groove"]
SPEED = {"path": "operation.speed_rpm", "values": [1000, 2000]}
CROWN = "modifications.lead_crowning_um"


def sweep(**parts: Any) -> dict[str, Any]:
    return {"endpoint": COUPLING.endpoint, "request": COUPLING.request, **parts}


def loads(**parts: Any) -> dict[str, Any]:
    return {"endpoint": LOADS.endpoint, "request": LOADS.request, **parts}


def study_of(body: object, most: int = 2500) -> Sweep:
    return Sweep(body, most, 30.0)


def fault_of(body: object, most: int = 2500) -> tuple[str, str, str]:
    with pytest.raises((Unprocessable, InvalidBody)) as caught:
        study_of(body, most)
    (fault, *_) = faults_of(caught.value)
    return fault["pointer"], fault["code"], fault["message"]


def vary(*axes: dict[str, Any]) -> dict[str, Any]:
    return sweep(vary=list(axes))


def axis(path: str, *values: Any) -> dict[str, Any]:
    return {"path": path, "values": list(values)}


def sample(count: int = 8, method: str = "latin_hypercube", *ranges: tuple[str, float, float]) -> dict[str, Any]:
    wanted = ranges or (("operation.speed_rpm", 1000, 2000),)
    return {
        "method": method,
        "count": count,
        "ranges": [dict(zip(("path", "min", "max"), r, strict=True)) for r in wanted],
    }


REFUSED: dict[str, tuple[dict[str, Any], str, str]] = {
    "misspelt": (vary(axis("operation.speed_rmp", 1)), "/vary/0/path", "unknown_path"),
    "list for a section": (
        {**vary(SPEED), "request": {**COUPLING.request, "operation": [1]}},
        "/request/operation",
        "model_type",
    ),
    "strange path": (vary(axis("operation..x", 1)), "/vary/0/path", "path_type"),
    "no path": (vary(axis("", 1)), "/vary/0/path", "path_type"),
    "section": (vary(SPEED, axis("coupling", 1)), "/vary/1/path", "not_scalar"),
    "list": (vary(axis("coupling.pitch_errors_um", 1)), "/vary/0/path", "not_scalar"),
    "place of no list": (vary(axis("coupling.pitch_errors_um.3", 1)), "/vary/0/path", "unknown_path"),
    "text for a number": (vary(axis("operation.speed_rpm", "fast")), "/vary/0", "out_of_range"),
    "boolean for a number": (vary(axis("operation.speed_rpm", True)), "/vary/0", "out_of_range"),
    "null for a number": (vary(axis("operation.speed_rpm", None)), "/vary/0", "out_of_range"),
    "no such word": (vary(axis("model.kinematics", "spatial", "exact")), "/vary/0", "out_of_range"),
    "beyond the range": (vary(axis("operation.speed_rpm", 1e9)), "/vary/0", "out_of_range"),
    "below the range": (vary(axis("coupling.module_mm", 3, -1)), "/vary/0", "out_of_range"),
    "half a tooth": (vary(axis("coupling.teeth", 50, 50.5)), "/vary/0", "not_integer"),
    "half a tooth in a spread": (
        vary({"path": "coupling.teeth", "start": 50, "stop": 53, "count": 3}),
        "/vary/0",
        "not_integer",
    ),
    "log of zero": (
        vary({"path": "operation.speed_rpm", "start": 0, "stop": 10, "count": 3, "scale": "log"}),
        "/vary/0/start",
        "log_needs_positive",
    ),
    "values and range": (vary({**SPEED, "start": 1, "stop": 2, "count": 2}), "/vary/0", "values_or_range"),
    "neither": (vary(SPEED, {"path": "coupling.teeth"}), "/vary/1", "values_or_range"),
    "half a range": (vary({"path": "coupling.teeth", "start": 50, "stop": 52}), "/vary/0", "values_or_range"),
    "twice": (vary(SPEED, SPEED), "/vary", "duplicate_path"),
    "twice together": (vary({**SPEED, "path": [SPEED["path"]] * 2}), "/vary", "duplicate_path"),
    "four axes": (vary(SPEED, SPEED, SPEED, SPEED), "/vary", "too_long"),
    "no axis": (vary(), "/vary", "too_short"),
    "nothing": (sweep(), "", "vary_cases_or_sample"),
    "two kinds": (sweep(vary=[SPEED], cases=[{}]), "", "vary_cases_or_sample"),
    "infinite": (vary(axis("operation.speed_rpm", float("inf"))), "/vary/0/values/0", "scalar_type"),
    "a list for a value": (vary(axis("operation.speed_rpm", 1, [2])), "/vary/0/values/1", "values_per_field"),
    "too few for each": (
        vary({"path": ["operation.speed_rpm", "coupling.teeth"], "values": [[1000, 50], [1]]}),
        "/vary/0/values/1",
        "values_per_field",
    ),
    "a list in a list": (vary(axis("operation.speed_rpm", [[2]])), "/vary/0/values/0", "scalar_type"),
    "one of each out of range": (
        vary({"path": ["operation.speed_rpm", "coupling.teeth"], "values": [[1000, 1]]}),
        "/vary/0",
        "out_of_range",
    ),
    "unknown part": (sweep(vary=[SPEED], colour=1), "/colour", "extra_forbidden"),
    "unknown endpoint": ({**vary(SPEED), "endpoint": "/v1/sweep"}, "/endpoint", "unknown_endpoint"),
    "unknown output": (sweep(vary=[SPEED], outputs=["axial_thrust.force"]), "/outputs/0", "unknown_output"),
    "output of a section": (sweep(vary=[SPEED], outputs=["axial_thrust"]), "/outputs/0", "not_scalar"),
    "output of a dictionary": (sweep(vary=[SPEED], outputs=["inputs"]), "/outputs/0", "not_scalar"),
    "output of a curve": (
        sweep(vary=[SPEED], outputs=["kinematics.curves.angle_deg.3"]),
        "/outputs/0",
        "not_scalar",
    ),
    "output twice": (sweep(vary=[SPEED], outputs=["status", "status"]), "/outputs/1", "duplicate_path"),
    "best of what is not told": (
        sweep(vary=[SPEED], outputs=["axial_thrust.force_n"], best={"minimise": "lubrication.friction_coefficient"}),
        "/best/minimise",
        "unknown_output",
    ),
    "best of words": (
        sweep(vary=[SPEED], outputs=["status"], best={"maximise": "status"}),
        "/best/maximise",
        "unknown_output",
    ),
    "limit on what is not told": (
        sweep(
            vary=[SPEED],
            outputs=["axial_thrust.force_n"],
            best={"minimise": "axial_thrust.force_n", "where": [{"output": "status"}]},
        ),
        "/best/where/0/output",
        "unknown_output",
    ),
    "best both ways": (sweep(vary=[SPEED], best={"minimise": "a", "maximise": "b"}), "/best", "minimise_or_maximise"),
    "unknown path in a case": (sweep(cases=[{}, {"operation.speed": 1}]), "/cases/1", "unknown_path"),
    "value in a case": (sweep(cases=[{"coupling.teeth": 1.5}]), "/cases/0", "not_integer"),
    "sobol of seven": (sweep(sample=sample(7, "sobol")), "/sample/count", "not_power_of_two"),
    "sample of whole numbers": (
        sweep(sample=sample(8, "sobol", ("coupling.teeth", 40, 60))),
        "/sample/ranges/0",
        "not_integer",
    ),
    "sample of words": (
        sweep(sample=sample(8, "sobol", ("model.inlet", 0, 1))),
        "/sample/ranges/0/min",
        "out_of_range",
    ),
    "sample twice": (
        sweep(sample=sample(8, "sobol", *[("operation.speed_rpm", 1, 2)] * 2)),
        "/sample/ranges",
        "duplicate_path",
    ),
    "sample backwards": (
        sweep(sample=sample(8, "sobol", ("operation.speed_rpm", 2, 1))),
        "/sample/ranges/0",
        "out_of_range",
    ),
    "base misspelt": (
        {**vary(SPEED), "request": {**COUPLING.request, "colour": 1}},
        "/request/colour",
        "extra_forbidden",
    ),
    "base incomplete": ({**vary(SPEED), "request": {}}, "/request/coupling", "missing"),
    "base of another shape": (
        {**vary(SPEED), "request": {**COUPLING.request, "operation": 5}},
        "/request/operation",
        "model_type",
    ),
    "both of torque and power": (
        loads(vary=[axis("load.power_kw", 5), axis("load.pinion_torque_n_m", 5)]),
        "/request/load",
        "torque_or_power",
    ),
}


@pytest.mark.parametrize("kind", REFUSED)
def test_refused_with_place_and_code(kind: str) -> None:
    body, pointer, code = REFUSED[kind]
    assert fault_of(body)[:2] == (pointer, code)


def test_did_you_mean() -> None:
    assert fault_of(vary(axis("operation.speed_rmp", 1)))[2].endswith("did you mean operation.speed_rpm?")
    assert fault_of(sweep(vary=[SPEED], outputs=["axial_thrust.force"]))[2].endswith("axial_thrust.force_n?")


@pytest.mark.parametrize(
    ("body", "pointer"),
    [
        (vary({**SPEED, "values": list(range(1, 12))}), "/vary"),
        (vary({"path": "operation.speed_rpm", "start": 1, "stop": 2, "count": 11}), "/vary"),
        (sweep(cases=[{}] * 11), "/cases"),
        (sweep(sample=sample(11)), "/sample/count"),
    ],
)
def test_too_many_points_names_limit_and_count(body: dict[str, Any], pointer: str) -> None:
    found = fault_of(body, most=10)
    assert found[:2] == (pointer, "too_many_points")
    assert "11" in found[2]
    assert "10" in found[2]
    assert study_of(body, most=11).total == 11


def test_a_huge_grid_is_counted_not_built() -> None:
    axes = [
        {"path": f"coupling.{name}", "start": 1, "stop": 2, "count": 10**6} for name in ("module_mm", "crowning_ratio")
    ]
    assert fault_of(vary(*axes))[1] == "too_many_points"


@pytest.mark.parametrize("endless", [float("nan"), "\ud800"])
def test_nonsense_behind_a_varied_field_is_refused(endless: object) -> None:
    base = {**COUPLING.request, "operation": {**COUPLING.request["operation"], "speed_rpm": endless}}
    assert fault_of({**vary(SPEED), "request": base})[:2] == ("/request", "not_json")


def test_first_axis_is_slowest() -> None:
    points = study_of(vary(axis("operation.speed_rpm", 1, 2), axis("coupling.teeth", 40, 50, 60))).points
    assert points.rows == [[s, z] for s in (1, 2) for z in (40, 50, 60)]
    assert points.overrides(4) == {"operation.speed_rpm": 2, "coupling.teeth": 50}


def test_spreads() -> None:
    speeds = {"path": "operation.speed_rpm", "start": 10, "stop": 1000, "count": 3}
    assert study_of(vary(speeds)).points.axes[0].values == [10.0, 505.0, 1000.0]
    assert study_of(vary({**speeds, "scale": "log"})).points.axes[0].values == pytest.approx([10, 100, 1000], rel=1e-14)
    teeth = study_of(vary({"path": "coupling.teeth", "start": 50, "stop": 52, "count": 3})).points.axes[0].values
    assert teeth == [50, 51, 52]
    assert all(isinstance(value, int) for value in teeth or ())


def test_fields_that_move_together() -> None:
    together = axis("", 5, 6) | {"path": ["materials.pinion.roughness_um", "materials.wheel.roughness_um"]}
    study = study_of(loads(vary=[together]))
    assert study.points.overrides(1) == {"materials.pinion.roughness_um": 6, "materials.wheel.roughness_um": 6}
    assert study.points.axes[0].header() == {"path": together["path"], "unit": "µm", "values": [5, 6]}


def test_fields_that_move_together_each_to_its_own() -> None:
    together = axis("", [5, 1], [6, 2], 3) | {"path": ["materials.pinion.roughness_um", "materials.wheel.roughness_um"]}
    points = study_of(loads(vary=[together])).points
    assert [list(points.overrides(k).values()) for k in range(3)] == [[5, 1], [6, 2], [3, 3]]
    assert points.rows[1] == [[6, 2]]


def test_place_of_a_list_and_words_and_null() -> None:
    grooves = {"endpoint": GROOVE.endpoint, "request": GROOVE.request}
    found = study_of({**grooves, "vary": [axis("grooves.0.width_mm", 4, 8), axis("model.slices", None, 50)]})
    assert found.points.axes[0].header()["unit"] == "mm"
    assert found.points.rows[0] == [4, None]
    assert fault_of({**grooves, "vary": [axis("grooves.7.width_mm", 4)]})[:2] == ("/vary/0/path", "unknown_path")


def test_required_field_may_be_left_to_the_sweep() -> None:
    base = {**COUPLING.request, "operation": {**COUPLING.request["operation"]}}
    del base["operation"]["speed_rpm"]
    assert study_of({**vary(SPEED), "request": base}).total == 2
    found = fault_of({**vary(axis("coupling.teeth", 40)), "request": base})
    assert found[:2] == ("/request/operation/speed_rpm", "missing")


@pytest.mark.parametrize("method", ["latin_hypercube", "sobol"])
def test_samples_fill_their_ranges_and_repeat_with_their_seed(method: str) -> None:
    ranges = (("operation.speed_rpm", 1000.0, 2000.0), ("operation.misalignment_deg", 0.01, 0.05))
    body = sample(64, method, *ranges)
    first, second = (np.array(study_of(sweep(sample=body)).points.rows) for _ in range(2))
    other = np.array(study_of(sweep(sample={**body, "seed": 2})).points.rows)
    assert np.array_equal(first, second)
    assert not np.array_equal(first, other)
    for column, (_, low, high) in enumerate(ranges):
        strata = np.floor((first[:, column] - low) / (high - low) * 64)
        assert sorted(strata) == list(range(64))  # one point in every 64th, for both methods


def test_equal_sweeps_are_one_case_and_others_are_not() -> None:
    body = vary(SPEED)
    assert study_of(body).case == study_of(json.loads(json.dumps(body))).case
    assert study_of(body).case != study_of(vary({**SPEED, "values": [1000, 2001]})).case


@pytest.mark.parametrize(
    ("inputs", "pointer", "code"),
    [
        (["operation.speed"], "/inputs/0", "unknown_path"),
        (["operation"], "/inputs/0", "not_scalar"),
        (["operation.speed_rpm", "model.kinematics"], "/inputs/1", "not_scalar"),
        (["operation.speed_rpm", "operation.speed_rpm"], "/inputs/1", "duplicate_path"),
        (["model.inlet_length_mm"], "/inputs/0", "not_scalar"),
        ([], "/inputs", "too_short"),
    ],
)
def test_inputs_of_a_sensitivity(inputs: list[str], pointer: str, code: str) -> None:
    with pytest.raises((Unprocessable, InvalidBody)) as caught:
        Sensitivity(sweep(inputs=inputs), 2500, 30.0)
    assert tuple(faults_of(caught.value)[0].values())[:2] == (pointer, code)


def test_a_sensitivity_counts_its_points_too() -> None:
    with pytest.raises(Unprocessable, match="too_many_points"):
        Sensitivity(sweep(), 10, 30.0)
