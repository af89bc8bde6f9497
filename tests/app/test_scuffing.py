"""The endpoints /v1/scuffing/load-distribution and /v1/scuffing keep their contract: fields, units and refusals."""

from collections.abc import Mapping
from typing import Any

import pytest

from app.examples import examples
from tests.support.requests import GONE, Post, accepted, assumptions, example, refusals, warned

DISTRIBUTION, SCUFFING = "/v1/scuffing/load-distribution", "/v1/scuffing"

SECTIONS = {
    "geometry": (
        "centre_distance_mm working_pressure_angle_deg base_helix_angle_deg transverse_base_pitch_mm "
        "path_of_contact_mm transverse_contact_ratio overlap_ratio total_contact_ratio undercut"
    ),
    "contact_lines": "min_length_mm max_length_mm mean_length_mm length_ratio curves",
    "stiffness": (
        "max_n_per_mm_um approach_n_per_mm_um pitch_n_per_mm_um recess_n_per_mm_um mean_mesh_n_per_mm_um curves"
    ),
    "transmission_error": "peak_to_peak_um mean_um min_um max_um harmonics_um curves",
    "load": (
        "pinion_torque_n_m normal_force_n max_line_load_n_per_mm max_at contact_fraction face_load_factor balance_error"
    ),
    "pressure": "max_mpa max_at",
    "friction_loss": "loss_factor power_w",
    "feature_line": (
        "psi gamma line_load_n_per_mm pressure_mpa half_width_mm radius_mm pinion_speed_m_per_s wheel_speed_m_per_s "
        "sliding_m_per_s iso_load_sharing load_sharing"
    ),
    "flank": "profile_fraction face_fraction modification_um line_load_n_per_mm pressure_mpa",
}
SCUFFING_SECTIONS = {
    "flash": "blok_max_k blok_at_psi thermal_ehl_max_k thermal_ehl_at_psi",
    "contact_temperature": "blok_max_c thermal_ehl_max_c",
    "film": "dowson_higginson_min_um thermal_ehl_min_um min_at_psi thickness_ratio thickness_regime",
    "safety": "blok_factor thermal_ehl_factor",
    "path": (
        "psi status blok_flash_k pinion_flash_k wheel_flash_k dowson_higginson_um minimum_film_um central_film_um "
        "max_pressure_mpa friction_coefficient film_max_temperature_c thickness_ratio"
    ),
}


def distribution(post: Post, changes: Mapping[str, Any] = {}, name: str = "xue-pair-1") -> dict[str, Any]:
    """Request the load distribution of an example with `changes`, and return the answer."""
    return accepted(post(DISTRIBUTION, example(name, changes)))


def scuffing(post: Post, changes: Mapping[str, Any] = {}) -> dict[str, Any]:
    """Request the scuffing calculation of an example with `changes`, and return the answer."""
    return accepted(post(SCUFFING, example("xue-pair-1-scuffing", changes)))


def test_every_field_of_the_contract_is_there(post: Post) -> None:
    loads, result = distribution(post, {"detail": "fields"}), scuffing(post, {"detail": "fields"})
    for answer, sections in ((loads, SECTIONS), (result, SECTIONS | SCUFFING_SECTIONS)):
        for section, fields in sections.items():
            assert set(fields.split()) <= set(answer[section]), section
    assert result["unsolved_points"] == 0


def test_arrays_of_a_group_have_one_length(post: Post) -> None:
    result = distribution(post, {"model.feature_points": 31, "detail": "fields"})
    assert {len(values) for values in result["feature_line"].values()} == {31}
    for section in ("contact_lines", "stiffness", "transmission_error"):
        assert len({len(values) for values in result[section]["curves"].values()}) == 1
    flank = result["flank"]
    for name in ("modification_um", "line_load_n_per_mm", "pressure_mpa"):
        assert len(flank[name]) == len(flank["profile_fraction"])
        assert {len(row) for row in flank[name]} == {len(flank["face_fraction"])}


def test_numbers_arrive_in_the_units_of_their_names(post: Post) -> None:
    result = distribution(post, {"detail": "curves"})
    assert result["geometry"]["transverse_contact_ratio"] == pytest.approx(1.5914, abs=6e-5)
    assert result["contact_lines"]["min_length_mm"] == pytest.approx(20.2608, abs=1e-4)
    assert result["transmission_error"]["peak_to_peak_um"] == pytest.approx(8.80, rel=6e-3)
    assert result["load"]["pinion_torque_n_m"] == pytest.approx(238.732, abs=1e-3)
    assert result["load"]["max_line_load_n_per_mm"] == pytest.approx(368.0, rel=1e-3)
    assert result["pressure"]["max_mpa"] == pytest.approx(1395, rel=1e-3)
    assert result["friction_loss"]["power_w"] == pytest.approx(500, rel=2e-3)
    assert result["feature_line"]["pinion_speed_m_per_s"][0] == pytest.approx(1.018, abs=1e-3)
    assert result["feature_line"]["radius_mm"][0] == pytest.approx(4.067, abs=1e-3)
    assert result["stiffness"]["max_n_per_mm_um"] == pytest.approx(15.49, rel=6e-3)


def test_scuffing_arrives_in_the_units_of_its_names(post: Post) -> None:
    result = scuffing(post)
    assert result["flash"]["blok_max_k"] == pytest.approx(71.5, abs=0.1)
    assert result["flash"]["blok_at_psi"] == 0.0
    assert result["contact_temperature"]["blok_max_c"] == pytest.approx(86.85 + 71.5, abs=0.1)
    assert result["film"]["dowson_higginson_min_um"] == pytest.approx(0.5235, abs=2e-4)
    assert result["film"]["thickness_ratio"] == pytest.approx(0.5235 / (0.4 * 2**0.5), abs=1e-3)
    assert result["film"]["thickness_regime"] == "boundary"
    assert result["safety"]["blok_factor"] == pytest.approx(100 / (26.85 + 71.5), rel=2e-3)
    assert result["flash"]["thermal_ehl_max_k"] is None
    assert result["path"]["pinion_flash_k"] is None
    assert len(result["path"]["psi"]) == 50


def test_safety_is_null_without_a_scuffing_temperature(post: Post) -> None:
    assert scuffing(post, {"temperatures.scuffing_c": GONE})["safety"] is None


def test_power_and_torque_are_two_ways_to_say_one_thing(post: Post) -> None:
    by_power = distribution(post)
    load = {"pinion_torque_n_m": by_power["load"]["pinion_torque_n_m"], "pinion_speed_rpm": 2000}
    by_torque = distribution(post, {"load": load})
    assert by_torque["pressure"]["max_mpa"] == pytest.approx(by_power["pressure"]["max_mpa"], rel=1e-12)


PINION, WHEEL = "gears.pinion", "gears.wheel"
REFUSED: list[tuple[str, dict[str, Any], tuple[str, str]]] = [
    (DISTRIBUTION, {"load": {"pinion_speed_rpm": 2000}}, ("torque_or_power", "load")),
    (DISTRIBUTION, {"load.pinion_torque_n_m": 200}, ("torque_or_power", "load")),
    (DISTRIBUTION, {"gears.centre_distance_mm": 80}, ("flank_interference", "gears.centre_distance_mm")),
    (DISTRIBUTION, {"gears.centre_distance_mm": 95}, ("no_mesh", "gears.centre_distance_mm")),
    (DISTRIBUTION, {PINION: {"teeth": 12, "profile_shift": 0.9}}, ("pointed_tooth", f"{PINION}.addendum")),
    (DISTRIBUTION, {f"{PINION}.dedendum": 0.95}, ("no_tip_clearance", f"{PINION}.dedendum")),
    (
        DISTRIBUTION,
        {"gears.helix_angle_deg": 0, f"{PINION}.addendum": 0.5, f"{WHEEL}.addendum": 0.5},
        ("no_contact", f"{PINION}.addendum"),
    ),
    (DISTRIBUTION, {"gears.module_mm": 0.03, "gears.helix_angle_deg": 30}, ("overlap_range", "gears.face_width_mm")),
    (
        DISTRIBUTION,
        {"model.tooth_stiffness": "parabola", "model.contact": "hertzian"},
        ("contact_law", "model.contact"),
    ),
    (SCUFFING, {"temperatures.scuffing_c": 50}, ("scuffing_temperature", "temperatures.scuffing_c")),
]


@pytest.mark.parametrize(("path", "changes", "expected"), REFUSED)
def test_impossible_gears_and_contradictions_are_named(
    post: Post, path: str, changes: dict[str, Any], expected: tuple[str, str]
) -> None:
    name = "xue-pair-1" if path == DISTRIBUTION else "xue-pair-1-scuffing"
    assert refusals(post(path, example(name, changes))) == [expected]


@pytest.mark.parametrize(
    ("lubrication", "points"),
    [("closed_form", 10), ("closed_form", 50), ("closed_form", 100), ("closed_form", 500), ("thermal_ehl", 10)],
)
def test_a_path_that_reaches_a_base_circle_has_no_verdict(post: Post, lubrication: str, points: int) -> None:
    """With 12 and 60 teeth, the path of contact reaches a base circle, where the pressure has no value."""
    # An earlier version of the service answered 154,550 MPa, and Blok safety factors of 3.8, 2.4, 2.1 and 1.4 with 10,
    # 50, 100 and 500 points of the path.
    rack = {"module_mm": 2, "helix_angle_deg": 15, "face_width_mm": 20}
    body = {
        "gears": {"pinion": {"teeth": 12}, "wheel": {"teeth": 60}, **rack},
        "load": {"pinion_torque_n_m": 50, "pinion_speed_rpm": 1000},
        "lubricant": {"viscosity_pa_s": 0.08},
        "temperatures": {"scuffing_c": 300, "bulk_c": 86.85},
        "model": {"lubrication": lubrication, "path_points": points},
    }
    result = accepted(post(SCUFFING, body))
    assert result["status"] == "ok_with_warnings"
    assert (result["pressure"]["max_mpa"], result["pressure"]["max_at"]) == (None, None)
    assert (result["flash"]["blok_max_k"], result["flash"]["blok_at_psi"]) == (None, None)
    assert (result["flash"]["thermal_ehl_max_k"], result["contact_temperature"]["thermal_ehl_max_c"]) == (None, None)
    assert result["contact_temperature"]["blok_max_c"] is None
    assert (result["safety"]["blok_factor"], result["safety"]["thermal_ehl_factor"]) == (None, None)
    assert [warning["code"] for warning in result["warnings"]].count("path_reaches_base_circle") == 1


def test_pressure_is_null_where_the_path_reaches_a_base_circle(post: Post) -> None:
    result = distribution(post, {PINION: {"teeth": 10}, WHEEL: {"teeth": 60}, "detail": "fields"})
    assert result["geometry"]["undercut"] is True
    assert result["feature_line"]["pressure_mpa"][0] is None
    assert set(result["flank"]["pressure_mpa"][0]) == {None}
    assert {"undercut", "path_reaches_base_circle"} <= set(warned(result))


def test_without_load_what_has_no_meaning_is_null(post: Post) -> None:
    result = distribution(post, {"load.power_kw": 0})
    assert result["load"]["max_at"] is None
    assert result["stiffness"]["mean_mesh_n_per_mm_um"] is None
    assert result["friction_loss"]["loss_factor"] is None
    assert result["feature_line"]["load_sharing"] is None
    assert "no_load" in warned(result)


def test_relief_lengths_are_assumptions_only_where_there_is_relief(post: Post) -> None:
    assert "modifications.tip_relief_length_mm" not in assumptions(distribution(post))
    relieved = assumptions(distribution(post, name="xue-pair-1-modified"))
    assert relieved["modifications.tip_relief_length_mm"] == pytest.approx(0.5914 * 8.9721, rel=1e-3)
    assert relieved["modifications.relief_exponent"] == 1
    assert "modifications.root_relief_length_mm" not in relieved


def test_our_choices_are_assumptions_until_they_are_made(post: Post) -> None:
    choices = {"model.contact", "model.section"}
    assert choices <= set(assumptions(distribution(post, {"model": GONE})))
    assert not choices & set(assumptions(distribution(post)))


def test_a_rack_in_the_transverse_plane_is_the_same_gear(post: Post) -> None:
    normal = distribution(post)
    # 3 mm / cos(9.8 deg); atan(tan(20 deg) / cos(9.8 deg))
    transverse = {"gears.module_mm": 3.04442552, "gears.pressure_angle_deg": 20.27239}
    same = distribution(post, {"gears.module_plane": "transverse", **transverse})
    assert same["geometry"]["centre_distance_mm"] == pytest.approx(normal["geometry"]["centre_distance_mm"], rel=1e-6)
    assert same["pressure"]["max_mpa"] == pytest.approx(normal["pressure"]["max_mpa"], rel=1e-4)


def test_examples_cover_the_papers_cases() -> None:
    names = set(examples())
    assert {f"xue-pair-{pair}{suffix}" for pair in (1, 2, 3, 4) for suffix in ("", "-modified")} <= names
    assert {f"xue-pair-4-helix-slope-{slope}" for slope in (10, 20, 40)} <= names


def test_the_rack_tip_radius_assumed_is_the_one_used(post: Post) -> None:
    steep = distribution(post, {"gears.pressure_angle_deg": 25, "gears.rack_tip_radius": GONE})
    assert assumptions(steep)["gears.rack_tip_radius"] == pytest.approx(0.31788, abs=5e-6)
    assert "rack_tip_radius" in warned(steep)
    assert assumptions(distribution(post))["gears.rack_tip_radius"] == 0.38


@pytest.mark.parametrize("modified", [{}, {"modifications": {"tip_relief_um": 5, "lead_crowning_um": 10}}])
def test_a_tiny_torque_is_answered_and_named(post: Post, modified: dict[str, Any]) -> None:
    for field, load in (("pinion_torque_n_m", 1e-30), ("power_kw", 0)):
        body = {"load": {field: load, "pinion_speed_rpm": 2000}, **modified}
        assert warned(distribution(post, body))["no_load"] == f"load.{field}"


def test_a_relief_beyond_the_path_points_at_its_length(post: Post) -> None:
    result = distribution(post, {"modifications.root_relief_um": 5, "modifications.root_relief_length_mm": 100})
    assert warned(result)["unusual_value"] == "modifications.root_relief_length_mm"
