"""Impossible drive trains are refused with a code and a field, and unusual drive trains are warned of."""

from dataclasses import replace

import pytest

from solvers import drive_train
from solvers.coupling.inputs import Friction
from solvers.drive_train.inputs import DriveTrainInputs, Effects, LinearBearing, RigidBearing, ShaftSection
from solvers.drive_train.states import solve
from solvers.errors import InvalidInput
from solvers.scuffing.inputs import LeadCurve
from tests.support.changes import changed
from tests.support.drive_trains import COUPLING, GROUND, PINION_SHAFT, running_axis, turbo_gear
from tests.support.outcomes import codes, refused, unsolved

PLAIN_UNIT = turbo_gear()
FIRST, SECOND = PINION_SHAFT.bearings
BEARINGS, TORQUE = "pinion_shaft.bearings", "pinion_shaft.torque_position"
THRUST = "pinion_shaft.ultimate_thrust"
LEAD = "mesh.distribution.modifications.lead_curve"
ASKEW = LinearBearing(0.22, ((1e8, 5e8), (5e8, 1e8)))
REFUSED: list[tuple[str, str, dict[str, object]]] = [
    ("bearing_count", BEARINGS, {BEARINGS: (FIRST,)}),
    ("bearing_count", BEARINGS, {BEARINGS: (FIRST, SECOND, FIRST)}),
    ("bearing_outside", f"{BEARINGS}.1.position", {BEARINGS: (FIRST, RigidBearing(0.9))}),
    ("bearing_order", f"{BEARINGS}.1.position", {BEARINGS: (FIRST, FIRST)}),
    ("bearing_distance", f"{BEARINGS}.1.position", {BEARINGS: (FIRST, RigidBearing(0.3))}),
    ("stiffness_matrix", f"{BEARINGS}.0.stiffness", {BEARINGS: (ASKEW, SECOND)}),
    ("face_outside", "face_start", {"face_start": 0.55}),
    ("face_outside", "face_start", {"face_start": -0.1}),
    ("torque_position", TORQUE, {TORQUE: 0.4}),
    ("torque_position", TORQUE, {TORQUE: 0.8}),
    ("torque_position", TORQUE, {TORQUE: None, "couplings": ()}),
    ("position_outside", "couplings.0.position", {"couplings.0.position": -0.1}),
    ("section_diameter", "pinion_shaft.sections.0.inner_diameter", {"pinion_shaft.sections.0.inner_diameter": 0.13}),
    ("section_diameter", "pinion_shaft.sections.3.outer_diameter", {"pinion_shaft.sections.3.outer_diameter": 0.3}),
    ("thrust_collar_radius", "collar_radius", {"collar_radius": 0.1}),
    ("thrust_collar_radius", "collar_radius", {"collar_radius": 0.14}),
    ("lead_curve", "lead_curve", {LEAD: LeadCurve((0.0,), (0.0,))}),
    ("lead_curve", "lead_curve", {LEAD: LeadCurve((0.1, 0.05), (0.0, 1e-6))}),
    ("lead_curve", "lead_curve", {LEAD: LeadCurve((0.0, 0.3), (0.0, 1e-6))}),
    ("machine_side", "couplings.0.machine_side", {"couplings.0.machine_side": "plus"}),
    ("couplings_on_shaft", "couplings.1.shaft", {"couplings": (COUPLING, replace(COUPLING, position=0.05))}),
    ("scuffing_temperature", "temperatures.scuffing", {"mesh.temperatures.scuffing": 300.0}),
    ("out_of_range", "couplings.0.misalignment", {"couplings.0.offset": (0.0, 0.1)}),
]


@pytest.mark.parametrize(("code", "field", "values"), REFUSED)
def test_refusals(code: str, field: str, values: dict[str, object]) -> None:
    assert refused(solve, changed(PLAIN_UNIT, values)) == (code, field)


def test_ranges_of_parts_are_checked_by_name() -> None:
    thin = changed(PLAIN_UNIT, {"couplings.0.coupling.face_width": -1.0})
    with pytest.raises(InvalidInput, match=r"face_width is -1000 mm; permissible: 0\.1 to 2000 mm") as refusal:
        drive_train.solve(thin)
    assert refusal.value.code == "out_of_range"


OVERHUNG = changed(
    PLAIN_UNIT,
    {
        "pinion_shaft": replace(
            PINION_SHAFT, sections=(ShaftSection(0.3, 0.13), *PINION_SHAFT.sections), start=-0.3, torque_position=-0.25
        ),
        "couplings.0.position": -0.25,
    },
)


def with_films(viscosity: float) -> DriveTrainInputs:
    return changed(PLAIN_UNIT, {f"{BEARINGS}.{k}.viscosity": viscosity for k in (0, 1)})


def test_a_film_too_thin_to_exist() -> None:
    assert unsolved(solve, with_films(1e-9)).code == "journal"


def fields(inputs: DriveTrainInputs) -> dict[str, str | None]:
    """Return the field of every warning by the code of the warning."""
    return {notice.code: notice.field for notice in solve(inputs).warnings}


def test_warnings_of_the_example() -> None:
    found = fields(PLAIN_UNIT)
    assert found["thrust_reversal"] == THRUST
    assert "edge_load" in found
    absent = "wall_response_assumed thrust_overload misalignment_limit thin_film lift_off long_overhang"
    assert not set(absent.split()) & set(found)
    assert "short_bearing_range" not in found, "140 over 200 mm is the limit itself"
    assert "edge_load" not in fields(turbo_gear(GROUND))


@pytest.mark.parametrize(
    ("inputs", "code", "field"),
    [
        (changed(PLAIN_UNIT, {"heat.wall_response": None}), "wall_response_assumed", "heat.wall_response"),
        (changed(PLAIN_UNIT, {THRUST: 60e3}), "thrust_overload", THRUST),
        (changed(PLAIN_UNIT, {"couplings.0.offset": (0.0, 1.2e-3)}), "misalignment_limit", "couplings.0.misalignment"),
        (changed(PLAIN_UNIT, {f"{BEARINGS}.1.width": 0.113}), "short_bearing_range", f"{BEARINGS}.1.width"),
        (
            changed(PLAIN_UNIT, {f"{BEARINGS}.1.width": 0.33, "bearing_film": "finite"}),
            "wide_bearing",
            f"{BEARINGS}.1.width",
        ),
        (turbo_gear(replace(GROUND, helix_slope=250e-6)), "lift_off", None),
        (with_films(3e-4), "thin_film", f"{BEARINGS}.1.radial_clearance"),
        (OVERHUNG, "long_overhang", "couplings.0.position"),
    ],
)
def test_warnings_of_other_units(inputs: DriveTrainInputs, code: str, field: str | None) -> None:
    found = fields(inputs)
    assert code in found
    assert field is None or found[code] == field


def test_units_short_of_a_limit_are_not_warned_of() -> None:
    cold = changed(PLAIN_UNIT, {"heat.wall_response": None, "effects": Effects(thermal=False)})
    assert "wall_response_assumed" not in codes(solve(cold))
    assert "thrust_overload" not in codes(solve(changed(PLAIN_UNIT, {THRUST: 80e3})))


def test_an_aligned_hub_is_said_to_stick() -> None:
    inputs = replace(PLAIN_UNIT, coupling_friction="elastic_plastic")
    moved = solve(inputs)
    assert not any(moved.couplings[0].stuck)
    assert "hub_sticks" not in codes(moved)
    offset, slope = running_axis(inputs)
    straight = replace(COUPLING, friction=Friction(0.25), offset=offset, slope=slope)
    stuck = solve(replace(inputs, couplings=(straight,)))
    assert all(stuck.couplings[0].stuck)
    assert max(stuck.couplings[0].friction_share) < 0.8
    assert "couplings.0.friction" in {notice.field for notice in stuck.warnings if notice.code == "hub_sticks"}
