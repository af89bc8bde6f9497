"""/v1/coupling: the binding names, the paper's numbers end to end, and what is refused."""

import copy
import json
from collections.abc import Callable
from typing import Any

import httpx
import pytest

from app.examples import examples
from tests.support.requests import changed, value_at

Post = Callable[[str, object], httpx.Response]

RESULT = {
    "geometry": "pitch_radius_mm crowning_radius_mm tangential_flank_radius_mm normal_flank_radius_mm",
    "kinematics": (
        "max_sliding_velocity_m_per_s max_contact_travel_mm max_hydrodynamic_velocity_m_per_s "
        "tangential_displacement_peak_to_peak_um curves"
    ),
    "load_distribution": (
        "mean_tangential_force_n max_tangential_force_n min_tangential_force_n max_normal_force_n "
        "load_concentration loaded_teeth iterations rotation_um unloading_misalignment_deg sleeve_displacement_um "
        "curves"
    ),
    "lubrication": (
        "max_normal_force_n hertz_half_width_mm hertz_pressure_mpa contact_overlap inlet_ratio inlet_factor "
        "hydrodynamic_capacity_n load_capacity_coefficient regime friction_coefficient"
    ),
    "axial_thrust": (
        "force_n coaxial_limit_n design_force_n customary_force_n breakaway_force_n fraction_of_limit "
        "uniform_load_force_n lower_bound_n upper_bound_n indeterminate self_induced"
    ),
    "losses": "friction_power_w friction_moment_n_m contact_shift_moment_n_m hub_bending_moment_n_m",
    "limits": (
        "sliding_velocity_limit_m_per_s allowable_misalignment_deg sleeve_centring_torque_n_m "
        "torsional_stiffness_n_m_per_rad lateral_stiffness_n_per_um"
    ),
    "axial_thrust.self_induced": "force_n overturning_moment_n_m simple_model_force_n uniform_load_force_n",
    "lubrication.regime": "area name friction_min friction_max distance_to_boundary",
}


def request(name: str, **changes: dict[str, Any]) -> dict[str, Any]:
    body = copy.deepcopy(examples()[name].request)
    for section, values in changes.items():
        body.setdefault(section, {}).update(values)
    return body


def test_names_of_the_contract(post: Post) -> None:
    result = post("/v1/coupling", request("pahl-z-arrangement")).json()
    for section, names in RESULT.items():
        assert set(value_at(result, section)) == set(names.split()), section


@pytest.mark.parametrize(
    ("name", "path", "value", "tolerance"),
    [
        ("pahl-axial-displacement", "axial_thrust.force_n", 756.5, 0.01),
        ("pahl-axial-displacement", "axial_thrust.coaxial_limit_n", 8186.0, 1e-5),
        ("pahl-heavily-crowned", "lubrication.friction_coefficient", 0.0500, 1e-3),
        ("pahl-heavily-crowned", "lubrication.load_capacity_coefficient", 0.0322, 0.01),
        ("pahl-slightly-crowned", "lubrication.friction_coefficient", 0.0084, 5e-3),
        ("pahl-z-arrangement", "axial_thrust.force_n", 361.7, 0.005),
    ],
)
def test_examples_give_the_papers_numbers(post: Post, name: str, path: str, value: float, tolerance: float) -> None:
    assert value_at(post("/v1/coupling", request(name)).json(), path) == pytest.approx(value, rel=tolerance)


def test_recommendation_of_the_example(post: Post) -> None:
    result = post("/v1/coupling/recommendation", request("pahl-recommended-crowning")).json()
    assert result["feasible"] is True
    assert result["crowning_ratio"] == pytest.approx(6.97, rel=0.02)
    assert result["at_min"]["contact_overlap"] < 1.0
    names = "crowning_ratio min_load_capacity_coefficient max_contact_overlap feasible"
    assert set(result["scan"]) == set(names.split())


def test_orbit_of_the_example(post: Post) -> None:
    result = post("/v1/coupling/sleeve-orbit", request("pahl-sleeve-orbit")).json()
    harmonics = result["inertia_force"]["harmonics_y_n"]
    assert harmonics[3] / harmonics[1] == pytest.approx(5.84, rel=0.02)
    assert set(result["orbit"]) == {"rotor_angle_deg", "x_um", "y_um"}
    assert result["sweeps"] >= 1
    assert 0.0 <= result["change_um"] < 1e-6
    assert max(result["orbit"]["x_um"]) <= result["max_displacement_um"]


EXAMPLES = {
    "/v1/coupling": "pahl-heavily-crowned",
    "/v1/coupling/sleeve-orbit": "pahl-sleeve-orbit",
    "/v1/coupling/recommendation": "pahl-recommended-crowning",
}
COUPLING, ORBIT, RECOMMENDATION = EXAMPLES
NAN = float("nan")
FALLING = {"sliding_velocity_m_per_s": [0.2, 0.1], "coefficient": [0.1, 0.1]}


@pytest.mark.parametrize(
    ("path", "changes", "at", "code"),
    [
        (COUPLING, {"coupling.pitch_errors_um": [1.0] * 51}, "coupling.pitch_errors_um", "pitch_errors_length"),
        (ORBIT, {"operation.torque_n_m": 0.1}, "operation.torque_n_m", "torque_too_low"),
        (ORBIT, {"operation.torque_n_m": 0}, "operation.torque_n_m", "torque_too_low"),
        (ORBIT, {"coupling.pitch_errors_um": [1.0] * 53}, "coupling.pitch_errors_um", "pitch_errors_length"),
        (COUPLING, {"coupling.pitch_errors_um": [*[1.0] * 51, NAN]}, "coupling.pitch_errors_um.51", "finite_number"),
        (COUPLING, {"operation.misalignment_deg": NAN}, "operation.misalignment_deg", "finite_number"),
        (COUPLING, {"operation.speed_rpm": "1910"}, "operation.speed_rpm", "number_type"),
        (COUPLING, {"coupling.crowning": 1.0}, "coupling.crowning", "extra_forbidden"),
        (RECOMMENDATION, {"coupling.crowning_ratio": 1.0}, "coupling.crowning_ratio", "extra_forbidden"),
        (
            COUPLING,
            {"coupling.youngs_modulus_gpa": 1, "operation.torque_n_m": 2e5},
            "coupling.crowning_ratio",
            "contact_width",
        ),
        (
            COUPLING,
            {"friction.mixed_curve": {"highest": 0.05, "lowest": 0.1}},
            "friction.mixed_curve.lowest",
            "mixed_curve",
        ),
        (COUPLING, {"operation.torque_n_m": 3e6}, "operation.torque_n_m", "hertz_pressure"),
        (COUPLING, {"operation.torque_n_m": -1}, "operation.torque_n_m", "greater_than_equal"),
        (COUPLING, {"friction.mixed_law": FALLING}, "friction.mixed_law", "mixed_law"),
        (
            RECOMMENDATION,
            {"operation.misalignment_range_deg": [0.3, 0.1]},
            "operation.misalignment_range_deg",
            "misalignment_range",
        ),
    ],
)
def test_what_is_refused(client: httpx.Client, path: str, changes: dict[str, Any], at: str, code: str) -> None:
    # With the NaN that strict encoders refuse.
    body = json.dumps(changed(examples()[EXAMPLES[path]].request, changes))
    response = client.post(path, content=body, headers={"Content-Type": "application/json"})
    assert response.status_code == 422, response.text
    found = [(error["pointer"], error["code"]) for error in response.json()["errors"]]
    assert found == [("/" + at.replace(".", "/"), code)]


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


OF_CONTACT = {
    "coupling.face_width_mm",
    "coupling.tooth_height_mm",
    "coupling.youngs_modulus_gpa",
    "coupling.poisson_ratio",
    "lubricant.viscosity_pa_s",
    "friction.coefficient",
    "friction.mixed_curve.velocity_m_per_s",
    "model.inlet",
    "model.film_angle_deg",
}
AT_REST = {"friction.static_coefficient"}
OF_SPRINGS = {"coupling.pressure_angle_deg", "coupling.tooth_stiffness_n_per_um", "coupling.sleeve_mass_kg"}


def assumed(post: Post, path: str, body: dict[str, Any]) -> dict[str, str]:
    return {each["field"]: each["reason"] for each in post(path, body).json()["assumptions"]}


@pytest.mark.parametrize(
    ("arrangement", "more"),
    [
        ("single", set()),
        ("parallel_offset", {"coupling.hub_distance_mm", "model.simple_thrust_factor"}),
        ("angular", {"coupling.hub_distance_mm"}),
    ],
)
def test_assumptions_of_an_arrangement(post: Post, arrangement: str, more: set[str]) -> None:
    operation = {"torque_n_m": 3000, "speed_rpm": 1910, "misalignment_deg": 0.1, "arrangement": arrangement}
    body = {"coupling": {"teeth": 52, "module_mm": 3}, "operation": operation}
    assert set(assumed(post, "/v1/coupling", body)) == OF_CONTACT | OF_SPRINGS | AT_REST | more
    # The recommendation shows the thrust on the shafts, not the one-pair model of it, and no breakaway.
    del operation["misalignment_deg"]
    operation["misalignment_range_deg"] = [0.1, 0.3]
    expected = (OF_CONTACT | OF_SPRINGS | more) - {"model.simple_thrust_factor"}
    assert set(assumed(post, "/v1/coupling/recommendation", body)) == expected


def test_an_orbit_assumes_and_reports_only_what_it_uses(post: Post) -> None:
    body = request("pahl-sleeve-orbit", model={"kinematics": "spatial", "inlet": "travel"}, friction={"coefficient": 1})
    del body["coupling"]["sleeve_mass_kg"]
    assert set(assumed(post, "/v1/coupling/sleeve-orbit", body)) == OF_SPRINGS
    result = post("/v1/coupling/sleeve-orbit", body).json()
    assert result["model"] == {"kinematics": "spatial", "sleeve": "floating"}
    # What it does not assume does not matter.
    other = changed(
        body,
        {
            "coupling.face_width_mm": 1,
            "coupling.tooth_height_mm": 1,
            "coupling.hub_distance_mm": 10,
            "coupling.youngs_modulus_gpa": 1,
            "coupling.poisson_ratio": 0,
            "lubricant": {"viscosity_pa_s": 1},
            "model": {"kinematics": "spatial", "rotor_angle_deg": 90},
        },
    )
    again = post("/v1/coupling/sleeve-orbit", other).json()
    assert again["orbit"] == result["orbit"]
    heavier = changed(body, {"coupling.sleeve_mass_kg": 8})
    assert post("/v1/coupling/sleeve-orbit", heavier).json()["orbit"] != result["orbit"]


MIXED_VELOCITY = "friction.mixed_curve.velocity_m_per_s"


@pytest.mark.parametrize(
    ("changes", "dropped"),
    [
        ({"coupling": {"pressure_angle_deg": 20}}, {"coupling.pressure_angle_deg"}),
        ({"model": {"inlet_length_mm": 5}}, {"model.inlet"}),
        ({"model": {"film_angle_deg": 90}}, {"model.film_angle_deg"}),
        (
            {"friction": {"coefficient": 0.1}},
            {"friction.coefficient", MIXED_VELOCITY, "friction.static_coefficient"},
        ),
        ({"friction": {"static_coefficient": 0.2}}, {"friction.static_coefficient"}),
        (
            {"friction": {"mixed_law": {"sliding_velocity_m_per_s": [0.1], "coefficient": [0.1]}}},
            {MIXED_VELOCITY},
        ),
        ({"friction": {"mixed_curve": {"velocity_m_per_s": 0.2}}}, {MIXED_VELOCITY}),
    ],
)
def test_a_choice_drops_the_assumptions_it_replaces(
    post: Post, changes: dict[str, dict[str, Any]], dropped: set[str]
) -> None:
    fields = set(assumed(post, "/v1/coupling", request("pahl-heavily-crowned", **changes)))
    assert fields == (OF_CONTACT | OF_SPRINGS | AT_REST) - dropped


def test_assumptions_state_the_value_used_and_the_friction_law(post: Post) -> None:
    found = post("/v1/coupling", request("pahl-heavily-crowned")).json()["assumptions"]
    values, reasons = ({each["field"]: each[name] for each in found} for name in ("value", "reason"))
    assert (values["coupling.face_width_mm"], values["coupling.tooth_height_mm"]) == (24.0, 6.0)
    assert reasons["friction.coefficient"].startswith("no coefficient given: the law of the friction regime")
    assert "calibration" in reasons[MIXED_VELOCITY]


def test_film_angle_and_inlet_length_reach_the_film(post: Post) -> None:
    def film(**model: float) -> Any:
        return post("/v1/coupling", request("pahl-heavily-crowned", model=model)).json()["lubrication"]

    largest, reversal = (film(**model)["hydrodynamic_capacity_n"] for model in ({}, {"film_angle_deg": 90.0}))
    assert reversal / largest == pytest.approx(0.179, abs=5e-4)
    # B = b_I/sqrt(2 R_e h_0) with R_e = 78 mm/sin(20 deg) and h_0 = 1 um.
    assert film(inlet_length_mm=2.0)["inlet_ratio"] == pytest.approx(2.0 / (2 * 228.055 * 1e-3) ** 0.5, rel=1e-5)
    assert film()["max_normal_force_n"] > film()["hydrodynamic_capacity_n"]


def test_the_mixed_friction_curve_reaches_the_coefficient(post: Post) -> None:
    body = request("pahl-heavily-crowned", friction={"mixed_curve": {"lowest": 0.06, "highest": 0.06}})
    body["operation"]["misalignment_deg"] = 1.0
    film = post("/v1/coupling", body).json()["lubrication"]
    # The curve's value at Tr 0, its lowest value at 0.2: no less and no more between them.
    assert 0.0 < film["load_capacity_coefficient"] < 0.2
    assert film["friction_coefficient"] == pytest.approx(0.06, rel=1e-9)


def test_the_thrust_factor_reaches_the_one_pair_model(post: Post) -> None:
    full, half = (
        post("/v1/coupling", request("pahl-z-arrangement", model=model)).json()["axial_thrust"]["self_induced"]
        for model in ({}, {"simple_thrust_factor": 0.5})
    )
    assert full["simple_model_force_n"] == pytest.approx(1277.0, rel=1e-3)
    assert half["simple_model_force_n"] == pytest.approx(full["simple_model_force_n"] / 2, rel=1e-12)
    assert half["force_n"] == full["force_n"]


def test_static_friction_gives_the_breakaway_force_alone(post: Post) -> None:
    given, default = (
        post("/v1/coupling", request("pahl-axial-displacement", friction=friction)).json()["axial_thrust"]
        for friction in ({"static_coefficient": 0.3}, {})
    )
    assert default["breakaway_force_n"] == default["coaxial_limit_n"]
    assert given["breakaway_force_n"] == pytest.approx(1.5 * given["coaxial_limit_n"], rel=1e-12)
    assert given["force_n"] == default["force_n"]


def test_the_rotor_angle_turns_the_teeth(post: Post) -> None:
    pitch = 360 / 52
    still, turned, half = (
        post("/v1/coupling", request("pahl-heavily-crowned", model={"rotor_angle_deg": angle})).json()
        for angle in (0.0, pitch, pitch / 2)
    )
    curves, later = (each["load_distribution"]["curves"] for each in (still, turned))
    assert later["angle_deg"] == pytest.approx([angle + pitch for angle in curves["angle_deg"]], abs=1e-9)
    force = curves["tangential_force_n"]
    assert later["tangential_force_n"] == pytest.approx([*force[1:], force[0]], rel=1e-9, abs=1e-6)
    assert half["load_distribution"]["max_tangential_force_n"] != pytest.approx(max(force), rel=1e-5)
    assert half["lubrication"] == still["lubrication"]


def test_an_angle_between_the_shafts_has_no_closed_form_thrust(post: Post) -> None:
    body = request("pahl-z-arrangement", operation={"arrangement": "angular"})
    induced = post("/v1/coupling", body).json()["axial_thrust"]["self_induced"]
    assert induced["simple_model_force_n"] == induced["uniform_load_force_n"] == 0.0
    assert induced["force_n"] == pytest.approx(0.0, abs=1e-3)


def test_a_recommendation_points_its_warnings_into_its_own_request(post: Post) -> None:
    body = request("pahl-recommended-crowning", operation={"misalignment_range_deg": [0.1, 0.5], "torque_n_m": 5})
    warnings = post("/v1/coupling/recommendation", body).json()["warnings"]
    assert {warning["code"]: warning["field"] for warning in warnings} == {
        "sliding_velocity": "operation.misalignment_range_deg",
        "sleeve_not_centred": "operation.torque_n_m",
    }
