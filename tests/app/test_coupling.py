"""/v1/coupling: the binding names, the paper's numbers end to end, and what is refused."""

import copy
from collections.abc import Callable
from typing import Any

import httpx
import pytest

from app.library import examples

Post = Callable[[str, object], httpx.Response]

RESULT = {
    "geometry": {"pitch_radius_mm", "crowning_radius_mm", "tangential_flank_radius_mm", "normal_flank_radius_mm"},
    "kinematics": {
        "max_sliding_velocity_m_per_s",
        "max_contact_travel_mm",
        "max_hydrodynamic_velocity_m_per_s",
        "tangential_displacement_peak_to_peak_um",
        "curves",
    },
    "load_distribution": {
        "mean_tangential_force_n",
        "max_tangential_force_n",
        "min_tangential_force_n",
        "max_normal_force_n",
        "load_concentration",
        "loaded_teeth",
        "rotation_um",
        "unloading_misalignment_deg",
        "sleeve_displacement_um",
        "curves",
    },
    "lubrication": {
        "hertz_half_width_mm",
        "hertz_pressure_mpa",
        "contact_overlap",
        "inlet_ratio",
        "inlet_factor",
        "hydrodynamic_capacity_n",
        "load_capacity_coefficient",
        "regime",
        "friction_coefficient",
    },
    "axial_thrust": {
        "force_n",
        "coaxial_limit_n",
        "breakaway_force_n",
        "fraction_of_limit",
        "uniform_load_force_n",
        "lower_bound_n",
        "upper_bound_n",
        "indeterminate",
        "self_induced",
    },
    "losses": {"friction_power_w", "friction_moment_n_m", "contact_shift_moment_n_m", "hub_bending_moment_n_m"},
    "limits": {
        "sliding_velocity_limit_m_per_s",
        "allowable_misalignment_deg",
        "sleeve_centring_torque_n_m",
        "torsional_stiffness_n_m_per_rad",
        "lateral_stiffness_n_per_um",
    },
}


def request(name: str, **changes: dict[str, Any]) -> dict[str, Any]:
    body = copy.deepcopy(examples()[name].request)
    for section, values in changes.items():
        body.setdefault(section, {}).update(values)
    return body


def test_names_of_the_contract(post: Post) -> None:
    result = post("/v1/coupling", request("pahl-z-arrangement")).json()
    assert {section: set(result[section]) for section in RESULT} == RESULT
    assert set(result["axial_thrust"]["self_induced"]) == {
        "force_n",
        "overturning_moment_n_m",
        "simple_model_force_n",
        "uniform_load_force_n",
    }
    assert set(result["lubrication"]["regime"]) == {
        "area",
        "name",
        "friction_min",
        "friction_max",
        "distance_to_boundary",
    }


@pytest.mark.parametrize(
    ("name", "section", "field", "value", "tolerance"),
    [
        ("pahl-axial-displacement", "axial_thrust", "force_n", 756.5, 0.01),
        ("pahl-axial-displacement", "axial_thrust", "coaxial_limit_n", 8186.0, 1e-5),
        ("pahl-heavily-crowned", "lubrication", "friction_coefficient", 0.0500, 1e-3),
        ("pahl-heavily-crowned", "lubrication", "load_capacity_coefficient", 0.0322, 0.01),
        ("pahl-slightly-crowned", "lubrication", "friction_coefficient", 0.0084, 5e-3),
        ("pahl-z-arrangement", "axial_thrust", "force_n", 361.7, 0.005),
    ],
)
def test_examples_give_the_papers_numbers(
    post: Post, name: str, section: str, field: str, value: float, tolerance: float
) -> None:
    assert post("/v1/coupling", request(name)).json()[section][field] == pytest.approx(value, rel=tolerance)


def test_recommendation_of_the_example(post: Post) -> None:
    result = post("/v1/coupling/recommendation", request("pahl-recommended-crowning")).json()
    assert result["feasible"] is True
    assert result["crowning_ratio"] == pytest.approx(6.97, rel=0.02)
    assert result["at_min"]["contact_overlap"] < 1.0
    assert set(result["scan"]) == {
        "crowning_ratio",
        "min_load_capacity_coefficient",
        "max_contact_overlap",
        "feasible",
    }


def test_orbit_of_the_example(post: Post) -> None:
    result = post("/v1/coupling/sleeve-orbit", request("pahl-sleeve-orbit")).json()
    harmonics = result["inertia_force"]["harmonics_y_n"]
    assert harmonics[3] / harmonics[1] == pytest.approx(5.84, rel=0.02)
    assert set(result["orbit"]) == {"rotor_angle_deg", "x_um", "y_um"}
    assert result["sweeps"] >= 1


@pytest.mark.parametrize(
    ("path", "name", "changes", "pointer", "code"),
    [
        (
            "/v1/coupling",
            "pahl-heavily-crowned",
            {"coupling": {"pitch_errors_um": [1.0] * 51}},
            "/coupling/pitch_errors_um",
            "pitch_errors_length",
        ),
        (
            "/v1/coupling/sleeve-orbit",
            "pahl-sleeve-orbit",
            {"operation": {"torque_n_m": 0.1}},
            "/operation/torque_n_m",
            "torque_too_low",
        ),
        (
            "/v1/coupling",
            "pahl-heavily-crowned",
            {"operation": {"torque_n_m": 3e6}},
            "/operation/torque_n_m",
            "hertz_pressure",
        ),
        (
            "/v1/coupling",
            "pahl-heavily-crowned",
            {"operation": {"torque_n_m": -1}},
            "/operation/torque_n_m",
            "greater_than_equal",
        ),
        (
            "/v1/coupling",
            "pahl-heavily-crowned",
            {"friction": {"mixed_law": {"sliding_velocity_m_per_s": [0.2, 0.1], "coefficient": [0.1, 0.1]}}},
            "/friction/mixed_law",
            "mixed_law",
        ),
        (
            "/v1/coupling/recommendation",
            "pahl-recommended-crowning",
            {"operation": {"misalignment_range_deg": [0.3, 0.1]}},
            "/operation/misalignment_range_deg",
            "misalignment_range",
        ),
    ],
)
def test_what_is_refused(
    post: Post, path: str, name: str, changes: dict[str, dict[str, Any]], pointer: str, code: str
) -> None:
    response = post(path, request(name, **changes))
    assert response.status_code == 422, response.text
    assert [(error["pointer"], error["code"]) for error in response.json()["errors"]] == [(pointer, code)]


@pytest.mark.parametrize("torque", [0, 3000])
@pytest.mark.parametrize("speed", [0, 1910])
@pytest.mark.parametrize("misalignment", [0, 0.1])
@pytest.mark.parametrize("axial_velocity", [0, 2])
@pytest.mark.parametrize("arrangement", ["single", "parallel_offset", "angular"])
def test_nothing_moves_nothing_loads(
    post: Post, torque: float, speed: float, misalignment: float, axial_velocity: float, arrangement: str
) -> None:
    operation = {
        "torque_n_m": torque,
        "speed_rpm": speed,
        "misalignment_deg": misalignment,
        "axial_velocity_mm_per_s": axial_velocity,
        "arrangement": arrangement,
    }
    response = post("/v1/coupling", {"coupling": {"teeth": 52, "module_mm": 3}, "operation": operation})
    assert response.status_code == 200, response.text
    result = response.json()
    thrust = result["axial_thrust"]
    assert thrust["lower_bound_n"] <= thrust["force_n"] <= thrust["upper_bound_n"]
    at_rest = axial_velocity == 0 and (speed == 0 or misalignment == 0)
    assert thrust["indeterminate"] == (at_rest and torque > 0)
    assert (result["lubrication"]["contact_overlap"] is None) == (misalignment == 0)
    codes = {warning["code"] for warning in result["warnings"]}
    assert ("no_misalignment" in codes) == (misalignment == 0)


def test_given_defaults_are_no_assumptions(post: Post) -> None:
    body = request("pahl-heavily-crowned", coupling={"pressure_angle_deg": 20}, friction={"coefficient": 0.1})
    fields = {each["field"] for each in post("/v1/coupling", body).json()["assumptions"]}
    assert "coupling.pressure_angle_deg" not in fields
    assert "friction.coefficient" not in fields
    assert {"coupling.face_width_mm", "coupling.tooth_stiffness_n_per_um", "model.inlet"} <= fields


def test_assumptions_state_the_value_used(post: Post) -> None:
    values = {
        each["field"]: each["value"]
        for each in post("/v1/coupling", request("pahl-heavily-crowned")).json()["assumptions"]
    }
    assert values["coupling.face_width_mm"] == 24.0
    assert values["coupling.tooth_height_mm"] == 6.0
