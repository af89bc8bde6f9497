"""The coupling endpoints give the agreed names and the numbers of the paper, and reject invalid requests."""

import json
from collections.abc import Mapping
from typing import Any

import httpx
import pytest

from tests.support.requests import GONE, Post, accepted, assumptions, changed, example, refusals, value_at, warned

RESULT = {
    "geometry": "pitch_radius_mm crowning_radius_mm crowning_drop_um tangential_flank_radius_mm normal_flank_radius_mm",
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


EXAMPLES = {
    "/v1/coupling": "pahl-heavily-crowned",
    "/v1/coupling/sleeve-orbit": "pahl-sleeve-orbit",
    "/v1/coupling/recommendation": "pahl-recommended-crowning",
}
COUPLING, ORBIT, RECOMMENDATION = EXAMPLES


def solved(post: Post, changes: Mapping[str, Any] = {}, name: str = EXAMPLES[COUPLING]) -> dict[str, Any]:
    """Return the answer of /v1/coupling to an example with changes."""
    return accepted(post(COUPLING, example(name, changes)))


def test_names_of_the_contract(post: Post) -> None:
    result = solved(post, name="pahl-z-arrangement")
    for section, names in RESULT.items():
        assert set(value_at(result, section)) == set(names.split()), section


def test_recommendation_of_the_example(post: Post) -> None:
    result = accepted(post(RECOMMENDATION, example(EXAMPLES[RECOMMENDATION])))
    assert result["feasible"] is True
    assert result["at_min"]["contact_overlap"] < 1.0
    names = "crowning_ratio min_load_capacity_coefficient max_contact_overlap feasible"
    assert set(result["scan"]) == set(names.split())


def test_orbit_of_the_example(post: Post) -> None:
    result = accepted(post(ORBIT, example(EXAMPLES[ORBIT])))
    harmonics = result["inertia_force"]["harmonics_y_n"]
    assert harmonics[3] / harmonics[1] == pytest.approx(5.84, rel=0.02)
    assert set(result["orbit"]) == {"rotor_angle_deg", "x_um", "y_um"}
    assert result["sweeps"] >= 1
    assert 0.0 <= result["change_um"] < 1e-6
    assert max(result["orbit"]["x_um"]) <= result["max_displacement_um"]


NAN = float("nan")
ERRORS, CURVE, LAW = "coupling.pitch_errors_um", "friction.mixed_curve", "friction.mixed_law"
FALLING = {"sliding_velocity_m_per_s": [0.2, 0.1], "coefficient": [0.1, 0.1]}
SOFT = {"operation.torque_n_m": 2e5, "coupling.youngs_modulus_gpa": 1}


# The endpoint, the changes, the code, and the field that is named where it is not the one that is changed.
@pytest.mark.parametrize(
    ("path", "changes", "code", "named"),
    [
        (COUPLING, {ERRORS: [1.0] * 51}, "pitch_errors_length", None),
        (COUPLING, {ERRORS: [*[1.0] * 51, NAN]}, "finite_number", f"{ERRORS}.51"),
        (COUPLING, {"operation.misalignment_deg": NAN}, "finite_number", None),
        (COUPLING, {"operation.speed_rpm": "1910"}, "number_type", None),
        (COUPLING, {"operation.torque_n_m": 3e6}, "hertz_pressure", None),
        (COUPLING, {"operation.torque_n_m": -1}, "greater_than_equal", None),
        (COUPLING, {"coupling.crowning": 1.0}, "extra_forbidden", None),
        (COUPLING, SOFT, "contact_width", "coupling.crowning_ratio"),
        (COUPLING, {CURVE: {"highest": 0.05, "lowest": 0.1}}, "mixed_curve", f"{CURVE}.lowest"),
        (COUPLING, {LAW: FALLING}, "mixed_law", None),
        (ORBIT, {"operation.torque_n_m": 0.1}, "torque_too_low", None),
        (ORBIT, {"operation.torque_n_m": 0}, "torque_too_low", None),
        (ORBIT, {ERRORS: [1.0] * 53}, "pitch_errors_length", None),
        (RECOMMENDATION, {"coupling.crowning_ratio": 1.0}, "extra_forbidden", None),
        (RECOMMENDATION, {"operation.misalignment_range_deg": [0.3, 0.1]}, "misalignment_range", None),
    ],
)
def test_what_is_refused(
    client: httpx.Client, path: str, changes: dict[str, Any], code: str, named: str | None
) -> None:
    # With the NaN that strict encoders refuse.
    body = json.dumps(example(EXAMPLES[path], changes))
    response = client.post(path, content=body, headers={"Content-Type": "application/json"})
    assert refusals(response) == [(code, named or next(iter(changes)))]


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
    result = accepted(post(COUPLING, {"coupling": {"teeth": 52, "module_mm": 3}, "operation": operation}))
    thrust = result["axial_thrust"]
    assert thrust["lower_bound_n"] <= thrust["force_n"] <= thrust["upper_bound_n"]
    at_rest = axial_velocity == 0 and (speed == 0 or misalignment == 0)
    assert thrust["indeterminate"] == (at_rest and torque > 0)
    assert (result["lubrication"]["contact_overlap"] is None) == (misalignment == 0)
    assert ("no_misalignment" in warned(result)) == (misalignment == 0)


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


@pytest.mark.parametrize(
    ("arrangement", "more"),
    [
        ("single", set()),
        ("parallel_offset", {"coupling.hub_distance_mm", "model.simple_thrust_factor"}),
        ("angular", {"coupling.hub_distance_mm"}),
    ],
)
def test_assumptions_of_an_arrangement(post: Post, arrangement: str, more: set[str]) -> None:
    operation = {"torque_n_m": 3000, "speed_rpm": 1910, "arrangement": arrangement}
    body = {"coupling": {"teeth": 52, "module_mm": 3}, "operation": operation}
    found = accepted(post(COUPLING, changed(body, {"operation.misalignment_deg": 0.1})))
    assert set(assumptions(found)) == OF_CONTACT | OF_SPRINGS | AT_REST | more
    # The recommendation shows the thrust on the shafts, not the one-pair model of it, and no breakaway.
    found = accepted(post(RECOMMENDATION, changed(body, {"operation.misalignment_range_deg": [0.1, 0.3]})))
    assert set(assumptions(found)) == (OF_CONTACT | OF_SPRINGS | more) - {"model.simple_thrust_factor"}


def test_an_orbit_assumes_and_reports_only_what_it_uses(post: Post) -> None:
    model = {"kinematics": "spatial", "inlet": "travel"}
    changes = {"model": model, "friction": {"coefficient": 1}, "coupling.sleeve_mass_kg": GONE}
    body = example(EXAMPLES[ORBIT], changes)
    result = accepted(post(ORBIT, body))
    assert set(assumptions(result)) == OF_SPRINGS | {"coupling.youngs_modulus_gpa"}
    assert assumptions(result)["coupling.tooth_stiffness_n_per_um"] == 280.0
    assert result["model"] == {"kinematics": "spatial", "sleeve": "floating"}
    # What it does not assume does not matter.
    unused = {
        "coupling.face_width_mm": 1,
        "coupling.tooth_height_mm": 1,
        "coupling.hub_distance_mm": 10,
        "coupling.poisson_ratio": 0,
        "lubricant": {"viscosity_pa_s": 1},
        "model": {"kinematics": "spatial", "rotor_angle_deg": 90},
    }
    assert accepted(post(ORBIT, changed(body, unused)))["orbit"] == result["orbit"]
    heavier = accepted(post(ORBIT, changed(body, {"coupling.sleeve_mass_kg": 8})))
    assert heavier["orbit"] != result["orbit"]


MIXED_VELOCITY = "friction.mixed_curve.velocity_m_per_s"


@pytest.mark.parametrize(
    ("field", "value", "dropped"),
    [
        ("coupling.pressure_angle_deg", 20, {"coupling.pressure_angle_deg"}),
        ("model.inlet_length_mm", 5, {"model.inlet"}),
        ("model.film_angle_deg", 90, {"model.film_angle_deg"}),
        ("friction.coefficient", 0.1, {"friction.coefficient", MIXED_VELOCITY, "friction.static_coefficient"}),
        ("friction.static_coefficient", 0.2, {"friction.static_coefficient"}),
        (LAW, {"sliding_velocity_m_per_s": [0.1], "coefficient": [0.1]}, {MIXED_VELOCITY}),
        (MIXED_VELOCITY, 0.2, {MIXED_VELOCITY}),
    ],
)
def test_a_choice_drops_the_assumptions_it_replaces(post: Post, field: str, value: Any, dropped: set[str]) -> None:
    assert set(assumptions(solved(post, {field: value}))) == (OF_CONTACT | OF_SPRINGS | AT_REST) - dropped


def test_assumptions_state_the_value_used_and_the_friction_law(post: Post) -> None:
    found = solved(post)
    values, reasons = assumptions(found), {each["field"]: each["reason"] for each in found["assumptions"]}
    assert (values["coupling.face_width_mm"], values["coupling.tooth_height_mm"]) == (24.0, 6.0)
    assert reasons["friction.coefficient"].startswith("from the friction regime; our law")
    assert "calibrated so that" in reasons[MIXED_VELOCITY]


def test_film_angle_and_inlet_length_reach_the_film(post: Post) -> None:
    model: tuple[dict[str, float], ...] = ({}, {"model.film_angle_deg": 90.0}, {"model.inlet_length_mm": 2.0})
    largest, reversal, long = (solved(post, changes)["lubrication"] for changes in model)
    ratio = reversal["hydrodynamic_capacity_n"] / largest["hydrodynamic_capacity_n"]
    assert ratio == pytest.approx(0.179, abs=5e-4)
    # B = b_I/sqrt(2 R_e h_0) with R_e = 78 mm/sin(20 deg) and h_0 = 1 um.
    assert long["inlet_ratio"] == pytest.approx(2.0 / (2 * 228.055 * 1e-3) ** 0.5, rel=1e-5)
    assert largest["max_normal_force_n"] > largest["hydrodynamic_capacity_n"]


def test_the_mixed_friction_curve_reaches_the_coefficient(post: Post) -> None:
    curve = {CURVE: {"lowest": 0.06, "highest": 0.06}}
    film = solved(post, {**curve, "operation.misalignment_deg": 1.0})["lubrication"]
    # The curve's value at Tr 0, its lowest value at 0.2: no less and no more between them.
    assert 0.0 < film["load_capacity_coefficient"] < 0.2
    assert film["friction_coefficient"] == pytest.approx(0.06, rel=1e-9)


def test_the_thrust_factor_reaches_the_one_pair_model(post: Post) -> None:
    full, half = (
        solved(post, changes, "pahl-z-arrangement")["axial_thrust"]["self_induced"]
        for changes in ({}, {"model.simple_thrust_factor": 0.5})
    )
    assert full["simple_model_force_n"] == pytest.approx(1277.0, rel=1e-3)
    assert half["simple_model_force_n"] == pytest.approx(full["simple_model_force_n"] / 2, rel=1e-12)
    assert half["force_n"] == full["force_n"]


def test_static_friction_gives_the_breakaway_force_alone(post: Post) -> None:
    given, default = (
        solved(post, changes, "pahl-axial-displacement")["axial_thrust"]
        for changes in ({"friction.static_coefficient": 0.3}, {})
    )
    assert default["breakaway_force_n"] == default["coaxial_limit_n"]
    assert given["breakaway_force_n"] == pytest.approx(1.5 * given["coaxial_limit_n"], rel=1e-12)
    assert given["force_n"] == default["force_n"]


def test_the_rotor_angle_turns_the_teeth(post: Post) -> None:
    pitch = 360 / 52
    angles = (0.0, pitch, pitch / 2)
    still, turned, half = (solved(post, {"model.rotor_angle_deg": angle}) for angle in angles)
    curves, later = (each["load_distribution"]["curves"] for each in (still, turned))
    assert later["angle_deg"] == pytest.approx([angle + pitch for angle in curves["angle_deg"]], abs=1e-9)
    force = curves["tangential_force_n"]
    assert later["tangential_force_n"] == pytest.approx([*force[1:], force[0]], rel=1e-9, abs=1e-6)
    assert half["load_distribution"]["max_tangential_force_n"] != pytest.approx(max(force), rel=1e-5)
    assert half["lubrication"] == still["lubrication"]


def test_an_angle_between_the_shafts_has_no_closed_form_thrust(post: Post) -> None:
    angular = solved(post, {"operation.arrangement": "angular"}, "pahl-z-arrangement")
    induced = angular["axial_thrust"]["self_induced"]
    assert induced["simple_model_force_n"] == induced["uniform_load_force_n"] == 0.0
    assert induced["force_n"] == pytest.approx(0.0, abs=1e-3)


def test_a_recommendation_points_its_warnings_into_its_own_request(post: Post) -> None:
    wide = {"operation.misalignment_range_deg": [0.1, 0.5], "operation.torque_n_m": 5}
    assert warned(accepted(post(RECOMMENDATION, example(EXAMPLES[RECOMMENDATION], wide)))) == {
        "sliding_velocity": "operation.misalignment_range_deg",
        "sleeve_not_centred": "operation.torque_n_m",
    }
