"""What is refused of the fields of double-helical gears, with its code and its place."""

from collections.abc import Callable
from typing import Any

import httpx
import pytest

from app.examples import examples
from tests.support.requests import changed

UNIT, PAIR, PUMP = "starter-turbo-double-helical", "starter-turbo-pair-heat", "milian-case-1"
TYPED = {f"pinion_shaft.sections.{k}.outer_diameter_mm": 230.0 for k in (3, 5)}  # a diameter where teeth may not be
Post = Callable[[str, object], httpx.Response]


def refused(post: Post, name: str, values: dict[str, Any]) -> tuple[int, str, str]:
    """Return status, code and field of the first fault of a changed example."""
    example = examples()[name]
    answer = post(example.endpoint, changed(example.request, values))
    fault = answer.json()["errors"][0] if answer.status_code == 422 else {}
    return answer.status_code, fault.get("code", ""), fault.get("pointer", "").strip("/").replace("/", ".")


@pytest.mark.parametrize(
    ("name", "field", "value"),
    [
        (UNIT, "gears.gap_width_mm", -1.0),
        (UNIT, "gears.gap_width_mm", 2001.0),
        (UNIT, "gears.gap_width_mm", "60"),
        (UNIT, "gears.apex_runout_um", -1.0),
        (UNIT, "floating_shaft", "both"),
        (UNIT, "operation.axial_force_n", "10 kN"),
        (UNIT, "operation.axial_force_n", 2e8),
        (UNIT, "modifications.second_helix", {"helix_slope_um": 1001.0}),
        (UNIT, "modifications.second_helix", {"lead_crowning_um": True}),
        (UNIT, "modifications.second_helix", {"tip_relief_um": 5.0}),
        (PAIR, "gears.gap_width_mm", True),
        (PAIR, "load.axial_force_n", -2e8),
        (PUMP, "gears.gap_width_mm", -0.1),
    ],
)
def test_values_out_of_range(post: Post, name: str, field: str, value: Any) -> None:
    status, _, place = refused(post, name, {field: value})
    assert status == 422
    assert place.startswith(field)


@pytest.mark.parametrize(
    ("name", "values", "code", "field"),
    [
        (UNIT, {"gears.helix_angle_deg": 0.0}, "double_helical_spur", "gears.helix_angle_deg"),
        (
            PUMP,
            {"gears.gap_width_mm": 50.0, "gears.helix_angle_deg": 0.0},
            "double_helical_spur",
            "gears.helix_angle_deg",
        ),
        (UNIT, {"thrust_collar": {"radius_mm": 125.0}}, "thrust_collar_double_helical", "thrust_collar.radius_mm"),
        (UNIT, TYPED | {"face_start_mm": 900.0}, "face_outside", "face_start_mm"),
        (UNIT, {"pinion_shaft.torque_position_mm": 460.0}, "torque_position", "pinion_shaft.torque_position_mm"),
        (
            UNIT,
            {"pinion_shaft.sections.4.outer_diameter_mm": None},
            "section_diameter",
            "pinion_shaft.sections.4.outer_diameter_mm",
        ),
        (
            UNIT,
            {"modifications.second_helix": {"lead_curve": {"position_mm": [5.0], "gap_um": [1.0]}}},
            "lead_curve",
            "modifications.second_helix.lead_curve",
        ),
    ],
)
def test_what_does_not_fit(post: Post, name: str, values: dict[str, Any], code: str, field: str) -> None:
    assert refused(post, name, values) == (422, code, field)


def test_a_force_that_lifts_a_helix_off_names_its_field(post: Post) -> None:
    example = examples()[UNIT]
    answer = post(example.endpoint, changed(example.request, {"operation.axial_force_n": 61.2e3})).json()
    assert answer["status"] == "no_solution"
    (warning,) = (one for one in answer["warnings"] if one["code"] == "helix_unloaded")
    assert warning["field"] == "operation.axial_force_n"
    assert "lifts off at 50.16 kN" in warning["message"]
