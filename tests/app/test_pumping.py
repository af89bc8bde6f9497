"""The endpoints /v1/pumping and /v1/pumping/choking-speed keep their contract: fields, units and refusals."""

from collections.abc import Mapping
from typing import Any

import pytest

from tests.support.requests import Post, accepted, assumptions, changed, example, refusals, value_at, warned

PUMPING, CHOKING = "/v1/pumping", "/v1/pumping/choking-speed"

# Below the spaces of the pinion and those of the wheel, and below the answer itself.
SPACES = {
    "": (
        "stroke peak_pressure_ratio min_pressure_ratio peak_axial_mach peak_axial_velocity_m_per_s radial_choked "
        "axial_choked inflow_choked front_end rear_end max_temperature_rise_k hottest_position_mm pumping_power_w "
        "work_per_space_j mass_flow_g_per_s "
        "balance profile field"
    ),
    ".stroke": "start_deg contact_start_deg contact_end_deg end_deg max_area_mm2 min_area_mm2 curves",
    ".stroke.curves": "angle_deg area_mm2 clearance_left_mm clearance_right_mm",
    ".mass_flow_g_per_s": ("front rear radial grooves reset front_out front_in rear_out rear_in net_uncertainty"),
    ".balance": "mass_error energy_error",
    ".profile": "position_mm temperature_rise_k static_temperature_rise_k peak_pressure_ratio",
    ".field": "angle_deg position_mm pressure_ratio axial_mach temperature_rise_k",
}
NAMES = {
    **{f"{spaces}{group}": names for spaces in ("pinion_spaces", "wheel_spaces") for group, names in SPACES.items()},
    "geometry": (
        "centre_distance_mm backlash_free_centre_distance_mm working_pressure_angle_deg transverse_contact_ratio "
        "normal_backlash_um undercut"
    ),
    "choking": ("outflow inflow clearances outflow_mach outflow_uncertainty inflow_mach inflow_uncertainty slices"),
    "total": "pumping_power_w meshing_frequency_hz axial_meshing_speed_m_per_s axial_meshing_mach",
    "lead_correction": "range_um slope_um crown_um curves",
    "lead_correction.curves": "position_mm growth_um radial_only_um correction_um",
    "pulsation": "frequency_hz front_mass_flow_g_per_s rear_mass_flow_g_per_s",
}


def solved(post: Post, changes: Mapping[str, Any] = {}, name: str = "milian-case-1") -> dict[str, Any]:
    return accepted(post(PUMPING, example(name, changes)))


@pytest.fixture(scope="module")
def full(post: Post) -> dict[str, Any]:
    return solved(post, {"detail": "fields"})


@pytest.mark.parametrize("section", NAMES)
def test_every_field_of_the_contract_is_there(full: dict[str, Any], section: str) -> None:
    assert set(value_at(full, section)) >= set(NAMES[section].split())


@pytest.mark.parametrize("spaces", ["pinion_spaces", "wheel_spaces"])
def test_arrays_of_one_group_have_one_length(full: dict[str, Any], spaces: str) -> None:
    result = full[spaces]
    assert {len(values) for values in result["stroke"]["curves"].values()} == {361}
    assert {len(values) for values in result["profile"].values()} == {100}
    field = result["field"]
    for name in ("pressure_ratio", "axial_mach", "temperature_rise_k"):
        assert len(field[name]) == len(field["angle_deg"])
        assert {len(row) for row in field[name]} == {len(field["position_mm"])} == {100}


def test_numbers_of_case_1_in_their_units(post: Post) -> None:
    result = solved(post, {"model.wall_transport": False, "model.spaces": "pinion"})
    spaces = result["pinion_spaces"]
    assert spaces["stroke"]["contact_start_deg"] == pytest.approx(-4.234, abs=1e-3)
    assert spaces["stroke"]["min_area_mm2"] == pytest.approx(20.02, abs=0.01)
    assert spaces["mass_flow_g_per_s"]["radial"] == pytest.approx(22.35, rel=0.02)  # on fine grids
    assert result["geometry"]["normal_backlash_um"] == pytest.approx(321.946, abs=1e-3)
    assert result["total"]["meshing_frequency_hz"] == pytest.approx(7259.15)
    assert result["total"]["axial_meshing_speed_m_per_s"] == pytest.approx(723, abs=0.5)
    assert result["wheel_spaces"] is None


def test_total_is_the_sum_of_both_spaces(full: dict[str, Any]) -> None:
    parts = [full[spaces]["pumping_power_w"] for spaces in ("pinion_spaces", "wheel_spaces")]
    assert full["total"]["pumping_power_w"] == pytest.approx(sum(parts))


def test_the_rack_tip_radius_assumed_is_the_one_used(post: Post) -> None:
    pair = {
        "pinion": {"teeth": 30},
        "wheel": {"teeth": 60},
        "module_mm": 5,
        "pressure_angle_deg": 25,
        "face_width_mm": 50,
    }
    body = {"gears": pair, "operation": {"pinion_speed_rpm": 5000}, "model": {"slices": 20, "spaces": "pinion"}}
    for dedendum, radius, held in ((1.5, 0.1349, True), (1.25, 0.25, False)):
        result = accepted(post(PUMPING, changed(body, {"gears.pinion.dedendum": dedendum})))
        used = result["derived"]["rack_tip_radius"]
        assert assumptions(result)["gears.rack_tip_radius"] == used == pytest.approx(radius, abs=1e-4)
        assert ("rack_tip_radius" in warned(result)) is held


def test_mass_flows_sum_to_zero(full: dict[str, Any]) -> None:
    flows = full["pinion_spaces"]["mass_flow_g_per_s"]
    assert abs(sum(flows[name] for name in ("front", "rear", "radial", "grooves", "reset"))) < 1e-9
    for end in ("front", "rear"):
        assert flows[end] == pytest.approx(flows[f"{end}_out"] - flows[f"{end}_in"], abs=1e-9)


def test_slices_in_force_are_echoed(post: Post) -> None:
    assert solved(post, {"detail": "summary"})["model"]["slices"] == 100
    chain = solved(post, {"model.flow": "pocket_chain", "detail": "summary"})
    assert (chain["model"]["slices"], chain["slices"]) == (10, 10)


def test_pocket_chain_of_the_paper(post: Post) -> None:
    result = solved(post, {"detail": "summary"}, "milian-case-1-pocket-chain")
    assert result["pinion_spaces"]["peak_pressure_ratio"] == pytest.approx(1.878, rel=2e-3)
    assert result["pinion_spaces"]["balance"]["energy_error"] is None
    # 0.165 g/s net of 20.5 out and 20.3 in at the front, 0.063 g/s apart for half the time steps
    assert [warning["code"] for warning in result["warnings"]] == ["net_flow_uncertain", "no_energy_balance"]
    assert "slices" not in result["warnings"][0]["message"]


def test_incompressible_has_no_temperatures(post: Post) -> None:
    result = solved(post, {"detail": "fields"}, "milian-table-1-incompressible")
    assert result["pinion_spaces"]["max_temperature_rise_k"] is None
    assert result["pinion_spaces"]["profile"]["temperature_rise_k"] is None
    assert result["lead_correction"] is None
    assert result["total"]["axial_meshing_speed_m_per_s"] is None
    assert set(warned(result)) == {"spur_gear", "no_temperature", "no_lead_correction"}


def test_assumptions_name_what_the_result_rests_on(post: Post) -> None:
    named = set(assumptions(solved(post, {"detail": "summary"})))
    assert {"gears.normal_backlash_mm", "model.gap", "model.flow", "model.wall_transport", "model.slices"} <= named
    assert "model.closure" not in named
    given = solved(post, {"model.gap": "tip", "model.slices": 40, "detail": "summary"})
    assert not {"model.gap", "model.slices", "model.wall_transport"} & set(assumptions(given))


# The changes, the code, and the field that is named where it is not the one that is changed.
REFUSED: list[tuple[dict[str, Any], str, str | None]] = [
    ({"gears.centre_distance_mm": 589}, "flank_interference", None),
    ({"gears.centre_distance_mm": 620}, "no_mesh", None),
    ({"gears.normal_backlash_mm": 6}, "pointed_tooth", None),
    ({"grooves": [{"position_mm": 100, "width_mm": 250}]}, "groove_outside", "grooves.0.position_mm"),
    (
        {"grooves": [{"position_mm": 50, "width_mm": 20}, {"position_mm": 60, "width_mm": 20}]},
        "groove_overlap",
        "grooves.1.position_mm",
    ),
    ({"model.flow": "incompressible"}, "helix_incompressible", "gears.helix_angle_deg"),
    ({"model.slices": 3}, "too_few_slices", None),
    ({"operation.pinion_speed_rpm": 1}, "too_many_steps", None),
    ({"operation.pinion_speed_rpm": 0}, "greater_than", None),
]


@pytest.mark.parametrize(("changes", "code", "named"), REFUSED)
def test_impossible_input_is_refused_with_its_pointer(
    post: Post, changes: dict[str, Any], code: str, named: str | None
) -> None:
    assert refusals(post(PUMPING, example("milian-case-1", changes))) == [(code, named or next(iter(changes)))]


def test_transverse_module_is_that_of_the_transverse_plane(post: Post) -> None:
    # Table 2 read as transverse module: the backlash-free centre distance becomes 575.42 mm
    plane = {"gears.module_plane": "transverse", "gears.centre_distance_mm": None}
    result = solved(post, {**plane, "detail": "summary"})
    assert result["geometry"]["centre_distance_mm"] == pytest.approx(575.42, abs=0.01)


def test_choking_speeds(post: Post) -> None:
    model = {"model.wall_transport": False, "model.spaces": "pinion"}
    result = accepted(post(CHOKING, example("milian-case-1-choking", model)))
    assert result["radial_choking_speed_rpm"] == pytest.approx(7016, rel=1e-3)
    assert result["axial_choking_speed_rpm"] == pytest.approx(7386, rel=1.5e-3)
    curves = result["curves"]
    assert len({len(values) for values in curves.values()}) == 1
    assert curves["pinion_speed_rpm"] == sorted(curves["pinion_speed_rpm"])


def test_choking_beyond_the_limit_is_null(post: Post) -> None:
    result = accepted(post(CHOKING, example("milian-case-1-choking", {"search_limit_rpm": 5000})))
    assert result["radial_choking_speed_rpm"] is None
    assert result["axial_choking_speed_rpm"] is None
    assert result["status"] == "ok_with_warnings"
    assert {warning["field"] for warning in result["warnings"]} == {"search_limit_rpm"}


def test_choking_takes_no_operation(post: Post) -> None:
    assert refusals(post(CHOKING, example("milian-case-1"))) == [("extra_forbidden", "operation")]
