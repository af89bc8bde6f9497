"""/v1/scuffing/line-contact gives the agreed names and the contact of the paper, and rejects invalid requests."""

from collections.abc import Mapping
from typing import Any

import pytest

from tests.support.requests import Post, accepted, assumptions, example, refusals, warned

PATH = "/v1/scuffing/line-contact"

NAMES = {
    "hertz": "half_width_mm max_pressure_mpa",
    "dimensionless": "moes_m moes_l slide_roll_ratio peclet_1 peclet_2",
    "film": "central_um minimum_um dowson_higginson_um",
    "pressure": "centre_mpa maximum_mpa maximum_at_mm",
    "temperature": "film_max_c surface_1_max_c surface_2_max_c surface_1_flash_k surface_2_flash_k",
    "friction": "coefficient power_w_per_mm max_shear_stress_mpa",
    "heat": (
        "generated_w_per_mm compression_w_per_mm to_surface_1_w_per_mm to_surface_2_w_per_mm convected_w_per_mm "
        "balance_error"
    ),
    "convergence": "iterations pressure_change temperature_change_k load_error nodes",
    "curves": (
        "x_mm pressure_mpa hertz_pressure_mpa film_um mid_film_temperature_c surface_1_temperature_c "
        "surface_2_temperature_c"
    ),
    "field": "x_mm film_fraction temperature_c",
}


def solved(post: Post, changes: Mapping[str, Any] = {}) -> dict[str, Any]:
    return accepted(post(PATH, example("xue-line-contact", changes)))


def test_names_of_the_contract(post: Post) -> None:
    result = solved(post, {"detail": "fields"})
    for section, names in NAMES.items():
        assert set(names.split()) <= set(result[section]), section
    field = result["field"]
    assert len(field["temperature_c"]) == len(field["x_mm"])
    assert {len(row) for row in field["temperature_c"]} == {len(field["film_fraction"])}
    assert len({len(values) for values in result["curves"].values()}) == 1


def test_point_a_arrives_in_the_units_of_its_names(post: Post) -> None:
    # ehl point A at 121 nodes; its radius 4.015 mm and speeds are rounded here, hence 1 %
    result = solved(post)
    assert result["hertz"]["max_pressure_mpa"] == pytest.approx(1565.2, rel=1e-3)
    assert result["hertz"]["half_width_mm"] == pytest.approx(0.1110, rel=1e-3)
    assert result["dimensionless"]["moes_m"] == pytest.approx(14.73, rel=1e-3)
    assert result["dimensionless"]["moes_l"] == pytest.approx(22.39, rel=1e-3)
    assert result["film"]["central_um"] == pytest.approx(0.4632, rel=0.01)
    assert result["film"]["minimum_um"] == pytest.approx(0.3243, rel=0.01)
    assert result["film"]["dowson_higginson_um"] == pytest.approx(0.5045, rel=1e-3)
    assert result["pressure"]["centre_mpa"] == pytest.approx(1546, rel=5e-3)
    assert result["temperature"]["film_max_c"] == pytest.approx(467.7 - 273.15, abs=1.0)
    assert result["temperature"]["surface_1_flash_k"] == pytest.approx(60.6, abs=1.0)
    assert result["friction"]["coefficient"] == pytest.approx(0.02747, rel=0.01)
    assert result["heat"]["generated_w_per_mm"] == pytest.approx(21.393, rel=0.06)


def test_isothermal_results_have_no_temperatures(post: Post) -> None:
    result = solved(post, {"model.thermal": False, "detail": "fields"})
    assert result["temperature"] is None
    assert result["heat"] is None
    assert result["convergence"]["temperature_change_k"] is None
    assert result["curves"]["mid_film_temperature_c"] is None
    assert result["field"] is None


@pytest.mark.parametrize(
    ("field", "value", "code"),
    [
        ("contact.speed_1_m_per_s", -4, "no_entrainment"),
        ("contact.speed_1_m_per_s", 0, "stationary_surface"),
        ("contact.speed_2_m_per_s", 0, "stationary_surface"),
        ("lubricant.viscosity_pa_s", 6e-5, "viscosity_range"),
        ("contact.line_load_n_per_mm", 2000, "pressure_range"),
        ("contact.line_load_n_per_mm", 0, "greater_than"),
        ("model.nodes", 20, "greater_than_equal"),
        ("model.thermal", 1, "bool_type"),
    ],
)
def test_what_is_refused(post: Post, field: str, value: float, code: str) -> None:
    assert refusals(post(PATH, example("xue-line-contact", {field: value}))) == [(code, field)]


def test_a_surface_may_stand_still_in_an_isothermal_film(post: Post) -> None:
    result = solved(post, {"contact.speed_1_m_per_s": 0, "model.thermal": False})
    assert result["film"]["minimum_um"] > 0


def test_exchanged_surfaces_exchange_their_results(post: Post) -> None:
    result = solved(post)
    mirrored = solved(post, {"contact.speed_1_m_per_s": 3.708, "contact.speed_2_m_per_s": 1.018})
    hottest = result["temperature"]["surface_1_max_c"]
    assert mirrored["temperature"]["surface_2_max_c"] == pytest.approx(hottest, abs=0.02)
    assert mirrored["friction"]["coefficient"] == pytest.approx(result["friction"]["coefficient"], rel=1e-4)


def test_the_slow_surface_is_warned_about(post: Post) -> None:
    assert warned(solved(post)) == {"low_peclet": "contact.speed_1_m_per_s"}


def test_rheology_is_an_assumption_until_it_is_chosen(post: Post) -> None:
    rheology = {"model.rheology", "model.eyring_stress_mpa"}
    assert rheology <= set(assumptions(solved(post)))
    assert not rheology & set(assumptions(solved(post, {"model.rheology": "newtonian"})))


def test_a_contact_without_solution_says_how_far_it_came(post: Post) -> None:
    contact = {"line_load_n_per_mm": 68.0028, "radius_mm": 5, "speed_1_m_per_s": 10.5, "speed_2_m_per_s": 9.5}
    oil, model = {"viscosity_pa_s": 0.08}, {"rheology": "newtonian"}
    result = accepted(post(PATH, {"contact": contact, "lubricant": oil, "model": model}))
    assert result["status"] == "no_solution"
    assert set(result["residuals"]) == {"pressure_change", "temperature_change", "load_error"}
    assert result["residuals"]["pressure_change"] > 1e-5
    assert result["convergence"]["stage"] == "coupling"
    assert [warning["code"] for warning in result["warnings"]] == ["not_converged", "newtonian_low_slip"]
    assert result["friction"] is None
    assert result["film"]["minimum_um"] is None
    assert result["hertz"]["max_pressure_mpa"] > 0
