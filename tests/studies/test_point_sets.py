"""The body of a sweep is checked before the first line is sent; every error names the place of the fault and a code."""

import copy
import json
from typing import Any

import numpy as np
import pytest

from app.calculations import CALCULATIONS, Calculation
from app.examples import examples
from app.schema.fields import leaves
from app.studies.kinds.sensitivity import Sensitivity
from app.studies.kinds.spectrum import Spectrum
from app.studies.kinds.sweep import Sweep
from tests.support.requests import changed
from tests.support.studies import fault_of, study_of

COUPLING = examples()["pahl-axial-displacement"]
RPM, TEETH, THRUST = "operation.speed_rpm", "coupling.teeth", "axial_thrust.force_n"
ROUGHNESSES = ["materials.pinion.roughness_um", "materials.wheel.roughness_um"]


def sweep(**parts: Any) -> dict[str, Any]:
    return study_of("pahl-axial-displacement", **parts)


def loads(**parts: Any) -> dict[str, Any]:
    return study_of("xue-pair-1-modified", **parts)


def grooves(**parts: Any) -> dict[str, Any]:
    return study_of("milian-case-1-groove", **parts)


def planned(body: object, most: int = 2500) -> Sweep:
    return Sweep(body, most, 30.0)


def fault(body: object, most: int = 2500) -> tuple[str, str, str]:
    return fault_of(Sweep, body, most)


def axis(path: str | list[str], *values: Any) -> dict[str, Any]:
    return {"path": path, "values": list(values)}


def spread(path: str, start: float, stop: float, count: int, **scale: str) -> dict[str, Any]:
    return {"path": path, "start": start, "stop": stop, "count": count, **scale}


def vary(*axes: dict[str, Any]) -> dict[str, Any]:
    return sweep(vary=list(axes))


def sample(count: int = 8, method: str = "latin_hypercube", *ranges: tuple[str, float, float]) -> dict[str, Any]:
    wanted = [dict(zip(("path", "min", "max"), each, strict=True)) for each in ranges or [(RPM, 1000, 2000)]]
    return sweep(sample={"method": method, "count": count, "ranges": wanted})


def best(*outputs: str, **best: Any) -> dict[str, Any]:
    return sweep(vary=[SPEED], outputs=list(outputs) or None, best=best)


SPEED = axis(RPM, 1000, 2000)
GRID = vary(SPEED)
REFUSED: dict[str, tuple[dict[str, Any], str, str]] = {
    "misspelt": (vary(axis("operation.speed_rmp", 1)), "/vary/0/path", "unknown_path"),
    "list for a section": (changed(GRID, {"request.operation": [1]}), "/request/operation", "model_type"),
    "strange path": (vary(axis("operation..x", 1)), "/vary/0/path", "path_type"),
    "no path": (vary(axis("", 1)), "/vary/0/path", "path_type"),
    "section": (vary(SPEED, axis("coupling", 1)), "/vary/1/path", "not_scalar"),
    "list": (vary(axis("coupling.pitch_errors_um", 1)), "/vary/0/path", "not_scalar"),
    "place of no list": (vary(axis("coupling.pitch_errors_um.3", 1)), "/vary/0/path", "unknown_path"),
    "text for a number": (vary(axis(RPM, "fast")), "/vary/0", "out_of_range"),
    "boolean for a number": (vary(axis(RPM, True)), "/vary/0", "out_of_range"),
    "null for a number": (vary(axis(RPM, None)), "/vary/0", "out_of_range"),
    "no such word": (vary(axis("model.kinematics", "spatial", "exact")), "/vary/0", "out_of_range"),
    "beyond the range": (vary(axis(RPM, 1e9)), "/vary/0", "out_of_range"),
    "below the range": (vary(axis("coupling.module_mm", 3, -1)), "/vary/0", "out_of_range"),
    "half a tooth": (vary(axis(TEETH, 50, 50.5)), "/vary/0", "not_integer"),
    "half a tooth in a spread": (vary(spread(TEETH, 50, 53, 3)), "/vary/0", "not_integer"),
    "log of zero": (vary(spread(RPM, 0, 10, 3, scale="log")), "/vary/0/start", "log_needs_positive"),
    "values and range": (vary({**SPEED, "start": 1, "stop": 2, "count": 2}), "/vary/0", "values_or_range"),
    "neither": (vary(SPEED, {"path": TEETH}), "/vary/1", "values_or_range"),
    "half a range": (vary({"path": TEETH, "start": 50, "stop": 52}), "/vary/0", "values_or_range"),
    "twice": (vary(SPEED, SPEED), "/vary", "duplicate_path"),
    "twice together": (vary({**SPEED, "path": [RPM, RPM]}), "/vary", "duplicate_path"),
    "four axes": (vary(SPEED, SPEED, SPEED, SPEED), "/vary", "too_long"),
    "no axis": (vary(), "/vary", "too_short"),
    "nothing": (sweep(), "", "vary_cases_or_sample"),
    "two kinds": (sweep(vary=[SPEED], cases=[{}]), "", "vary_cases_or_sample"),
    "infinite": (vary(axis(RPM, float("inf"))), "/vary/0/values/0", "scalar_type"),
    "a list for a value": (vary(axis(RPM, 1, [2])), "/vary/0/values/1", "values_per_field"),
    "too few for each": (vary(axis([RPM, TEETH], [1000, 50], [1])), "/vary/0/values/1", "values_per_field"),
    "a list in a list": (vary(axis(RPM, [[2]])), "/vary/0/values/0", "scalar_type"),
    "one of each out of range": (vary(axis([RPM, TEETH], [1000, 1])), "/vary/0", "out_of_range"),
    "unknown part": (sweep(vary=[SPEED], colour=1), "/colour", "extra_forbidden"),
    "unknown endpoint": ({**GRID, "endpoint": "/v1/sweep"}, "/endpoint", "unknown_endpoint"),
    "unknown output": (sweep(vary=[SPEED], outputs=["axial_thrust.force"]), "/outputs/0", "unknown_output"),
    "output of a section": (sweep(vary=[SPEED], outputs=["axial_thrust"]), "/outputs/0", "not_scalar"),
    "output of a dictionary": (sweep(vary=[SPEED], outputs=["inputs"]), "/outputs/0", "not_scalar"),
    "output of a curve": (sweep(vary=[SPEED], outputs=["kinematics.curves.angle_deg.3"]), "/outputs/0", "not_scalar"),
    "output twice": (sweep(vary=[SPEED], outputs=["status", "status"]), "/outputs/1", "duplicate_path"),
    "best not told": (best(THRUST, minimise="lubrication.friction_coefficient"), "/best/minimise", "unknown_output"),
    "best of words": (best("status", maximise="status"), "/best/maximise", "unknown_output"),
    "limit on what is not told": (
        best(THRUST, minimise=THRUST, where=[{"output": "status"}]),
        "/best/where/0/output",
        "unknown_output",
    ),
    "best both ways": (best(minimise="a", maximise="b"), "/best", "minimise_or_maximise"),
    "unknown path in a case": (sweep(cases=[{}, {"operation.speed": 1}]), "/cases/1", "unknown_path"),
    "value in a case": (sweep(cases=[{TEETH: 1.5}]), "/cases/0", "not_integer"),
    "sobol of seven": (sample(7, "sobol"), "/sample/count", "not_power_of_two"),
    "sample of whole numbers": (sample(8, "sobol", (TEETH, 40, 60)), "/sample/ranges/0", "not_integer"),
    "sample of words": (sample(8, "sobol", ("model.inlet", 0, 1)), "/sample/ranges/0/path", "not_continuous"),
    "sample twice": (sample(8, "sobol", (RPM, 1, 2), (RPM, 1, 2)), "/sample/ranges", "duplicate_path"),
    "sample backwards": (sample(8, "sobol", (RPM, 2, 1)), "/sample/ranges/0", "out_of_range"),
    "base misspelt": (changed(GRID, {"request.colour": 1}), "/request/colour", "extra_forbidden"),
    "base incomplete": ({**GRID, "request": {}}, "/request/coupling", "missing"),
    "base of another shape": (changed(GRID, {"request.operation": 5}), "/request/operation", "model_type"),
    "both of torque and power": (
        loads(vary=[axis("load.power_kw", 5), axis("load.pinion_torque_n_m", 5)]),
        "/request/load",
        "torque_or_power",
    ),
}


@pytest.mark.parametrize("kind", REFUSED)
def test_refused_with_place_and_code(kind: str) -> None:
    body, pointer, code = REFUSED[kind]
    assert fault(body)[:2] == (pointer, code)


def test_did_you_mean() -> None:
    assert fault(vary(axis("operation.speed_rmp", 1)))[2].endswith("did you mean operation.speed_rpm?")
    assert fault(sweep(vary=[SPEED], outputs=["axial_thrust.force"]))[2].endswith("axial_thrust.force_n?")


@pytest.mark.parametrize(
    ("body", "pointer"),
    [
        (vary({**SPEED, "values": list(range(1, 12))}), "/vary"),
        (vary(spread(RPM, 1, 2, 11)), "/vary"),
        (sweep(cases=[{}] * 11), "/cases"),
        (sample(11), "/sample/count"),
    ],
)
def test_too_many_points_names_limit_and_count(body: dict[str, Any], pointer: str) -> None:
    found = fault(body, most=10)
    assert found[:2] == (pointer, "too_many_points")
    assert "11" in found[2]
    assert "10" in found[2]
    assert planned(body, most=11).total == 11


def test_a_huge_grid_is_counted_not_built() -> None:
    axes = (spread(f"coupling.{name}", 1, 2, 10**6) for name in ("module_mm", "crowning_ratio"))
    assert fault(vary(*axes))[1] == "too_many_points"


@pytest.mark.parametrize("endless", [float("nan"), "\ud800"])
def test_nonsense_behind_a_varied_field_is_refused(endless: object) -> None:
    assert fault(changed(GRID, {"request.operation.speed_rpm": endless}))[:2] == ("/request", "not_json")


def test_first_axis_is_slowest() -> None:
    points = planned(vary(axis(RPM, 1, 2), axis(TEETH, 40, 50, 60))).points
    assert points.rows == [[s, z] for s in (1, 2) for z in (40, 50, 60)]
    assert points.overrides(4) == {RPM: 2, TEETH: 50}


def test_spreads() -> None:
    speeds = spread(RPM, 10, 1000, 3)
    assert planned(vary(speeds)).points.axes[0].values == [10.0, 505.0, 1000.0]
    assert planned(vary({**speeds, "scale": "log"})).points.axes[0].values == pytest.approx([10, 100, 1000], rel=1e-14)
    teeth = planned(vary(spread(TEETH, 50, 52, 3))).points.axes[0].values
    assert teeth == [50, 51, 52]
    assert all(isinstance(value, int) for value in teeth or ())


def test_fields_that_move_together() -> None:
    points = planned(loads(vary=[axis(ROUGHNESSES, 5, 6)])).points
    assert points.overrides(1) == dict.fromkeys(ROUGHNESSES, 6)
    assert points.axes[0].header() == {"path": ROUGHNESSES, "unit": "µm", "values": [5, 6]}


def test_fields_that_move_together_each_to_its_own() -> None:
    points = planned(loads(vary=[axis(ROUGHNESSES, [5, 1], [6, 2], 3)])).points
    assert [list(points.overrides(k).values()) for k in range(3)] == [[5, 1], [6, 2], [3, 3]]
    assert points.rows[1] == [[6, 2]]


def test_place_of_a_list_and_words_and_null() -> None:
    points = planned(grooves(vary=[axis("grooves.0.width_mm", 4, 8), axis("model.slices", None, 50)])).points
    assert points.axes[0].header()["unit"] == "mm"
    assert points.rows[0] == [4, None]
    assert fault(grooves(vary=[axis("grooves.7.width_mm", 4)]))[:2] == ("/vary/0/path", "unknown_path")


def test_required_field_may_be_left_to_the_sweep() -> None:
    base = copy.deepcopy(COUPLING.request)
    del base["operation"]["speed_rpm"]
    assert planned({**GRID, "request": base}).total == 2
    assert fault({**vary(axis(TEETH, 40)), "request": base})[:2] == ("/request/operation/speed_rpm", "missing")


@pytest.mark.parametrize("method", ["latin_hypercube", "sobol"])
def test_samples_fill_their_ranges_and_repeat_with_their_seed(method: str) -> None:
    ranges = ((RPM, 1000.0, 2000.0), ("operation.misalignment_deg", 0.01, 0.05))
    body = sample(64, method, *ranges)
    first, second = (np.array(planned(body).points.rows) for _ in range(2))
    other = np.array(planned(changed(body, {"sample.seed": 2})).points.rows)
    assert np.array_equal(first, second)
    assert not np.array_equal(first, other)
    for column, (_, low, high) in enumerate(ranges):
        strata = np.floor((first[:, column] - low) / (high - low) * 64)
        assert sorted(strata) == list(range(64))  # one point in every 64th, for both methods


def test_equal_sweeps_are_one_case_and_others_are_not() -> None:
    assert planned(GRID).case == planned(json.loads(json.dumps(GRID))).case
    assert planned(GRID).case != planned(vary(axis(RPM, 1000, 2001))).case


@pytest.mark.parametrize(
    ("inputs", "pointer", "code"),
    [
        (["operation.speed"], "/inputs/0", "unknown_path"),
        (["operation"], "/inputs/0", "not_scalar"),
        ([RPM, "model.kinematics"], "/inputs/1", "not_scalar"),
        ([RPM, RPM], "/inputs/1", "duplicate_path"),
        (["model.inlet_length_mm"], "/inputs/0", "not_scalar"),
        ([], "/inputs", "too_short"),
    ],
)
def test_inputs_of_a_sensitivity(inputs: list[str], pointer: str, code: str) -> None:
    assert fault_of(Sensitivity, sweep(inputs=inputs))[:2] == (pointer, code)


@pytest.mark.parametrize(
    ("path", "words"),
    [
        ("model.kinematics", "model.kinematics is an option (tangential, spatial), not a number"),
        (
            "coupling.pitch_errors_um",
            "is a list and not a single value; name one of the values in the list, such as coupling.pitch_errors_um.0",
        ),
        ("coupling", "coupling is a section and not a single value"),
    ],
)
def test_what_holds_no_number_says_what_it_is(path: str, words: str) -> None:
    assert words in fault_of(Sensitivity, sweep(inputs=[path]))[2]
    scatter = {"path": path, "distribution": "normal", "mean": 1, "deviation": 1}
    assert words in fault(sweep(sample={"count": 8, "inputs": [scatter]}))[2]
    assert words in fault_of(Spectrum, sweep(cases=[{}], tolerances={"inputs": [scatter]}))[2]


@pytest.mark.parametrize("calculation", CALCULATIONS, ids=lambda each: each.path)
def test_every_field_without_number_is_told_so(calculation: Calculation) -> None:
    """For every option and flag of every endpoint, the message says that the field is an option or a flag."""
    name = next(each.name for each in examples().values() if each.endpoint == calculation.path)
    for leaf in leaves(calculation.request):
        if leaf.is_scalar and (leaf.kind == "boolean" or leaf.options):
            path = leaf.path.replace("*", "0")
            _, code, message = fault_of(Sensitivity, study_of(name, inputs=[path]))
            assert code == "not_scalar"
            assert message.startswith(f"{path} is "), message
            assert ("an option (" if leaf.options else "either true or false") in message


def test_a_sensitivity_counts_its_points_too() -> None:
    assert fault_of(Sensitivity, sweep(), most=10)[1] == "too_many_points"
