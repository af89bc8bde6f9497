"""What no drive train can be made of, by code and field; and what a drive train says of itself."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from solvers import drive_train
from solvers.coupling.inputs import Friction
from solvers.drive_train.inputs import (
    DriveTrainInputs,
    Effects,
    JournalBearing,
    LinearBearing,
    RigidBearing,
    Shaft,
    ShaftSection,
)
from solvers.drive_train.states import solve
from solvers.errors import InvalidInput, NoSolution
from solvers.scuffing.inputs import LeadCurve
from tests.support.drive_trains import COUPLING, GROUND, PINION_SHAFT, turbo_gear


def pinion_shaft(**changes: object) -> DriveTrainInputs:
    return replace(turbo_gear(), pinion_shaft=replace(PINION_SHAFT, **changes))


def coupling(**changes: object) -> DriveTrainInputs:
    return replace(turbo_gear(), couplings=(replace(COUPLING, **changes),))


def section(index: int, **changes: float) -> DriveTrainInputs:
    sections = list(PINION_SHAFT.sections)
    sections[index] = replace(sections[index], **changes)
    return pinion_shaft(sections=tuple(sections))


def lead(position: tuple[float, ...], gap: tuple[float, ...]) -> DriveTrainInputs:
    return turbo_gear(replace(GROUND, lead_curve=LeadCurve(position, gap)))


FIRST, SECOND = PINION_SHAFT.bearings
ASKEW = ((1e8, 5e8), (5e8, 1e8))
REFUSED: list[tuple[str, str, Callable[[], DriveTrainInputs]]] = [
    ("bearing_count", "pinion_shaft.bearings", lambda: pinion_shaft(bearings=(FIRST,))),
    ("bearing_count", "pinion_shaft.bearings", lambda: pinion_shaft(bearings=(FIRST, SECOND, FIRST))),
    ("bearing_outside", "pinion_shaft.bearings.1.position", lambda: pinion_shaft(bearings=(FIRST, RigidBearing(0.9)))),
    ("bearing_order", "pinion_shaft.bearings.1.position", lambda: pinion_shaft(bearings=(FIRST, FIRST))),
    ("bearing_distance", "pinion_shaft.bearings.1.position", lambda: pinion_shaft(bearings=(FIRST, RigidBearing(0.3)))),
    ("face_outside", "face_start", lambda: replace(turbo_gear(), face_start=0.55)),
    ("face_outside", "face_start", lambda: replace(turbo_gear(), face_start=-0.1)),
    ("torque_position", "pinion_shaft.torque_position", lambda: pinion_shaft(torque_position=0.4)),
    ("torque_position", "pinion_shaft.torque_position", lambda: pinion_shaft(torque_position=0.8)),
    (
        "torque_position",
        "pinion_shaft.torque_position",
        lambda: replace(pinion_shaft(torque_position=None), couplings=()),
    ),
    ("position_outside", "couplings.0.position", lambda: coupling(position=-0.1)),
    ("section_diameter", "pinion_shaft.sections.0.inner_diameter", lambda: section(0, inner_diameter=0.13)),
    ("section_diameter", "pinion_shaft.sections.3.outer_diameter", lambda: section(3, outer_diameter=0.3)),
    (
        "stiffness_matrix",
        "pinion_shaft.bearings.0.stiffness",
        lambda: pinion_shaft(bearings=(LinearBearing(0.22, ASKEW), SECOND)),
    ),
    ("thrust_collar_radius", "collar_radius", lambda: replace(turbo_gear(), collar_radius=0.1)),
    ("thrust_collar_radius", "collar_radius", lambda: replace(turbo_gear(), collar_radius=0.14)),
    ("lead_curve", "lead_curve", lambda: lead((0.0,), (0.0,))),
    ("lead_curve", "lead_curve", lambda: lead((0.1, 0.05), (0.0, 1e-6))),
    ("lead_curve", "lead_curve", lambda: lead((0.0, 0.3), (0.0, 1e-6))),
    ("machine_side", "couplings.0.machine_side", lambda: coupling(machine_side="plus")),
    (
        "couplings_on_shaft",
        "couplings.1.shaft",
        lambda: replace(turbo_gear(), couplings=(COUPLING, replace(COUPLING, position=0.05))),
    ),
    (
        "scuffing_temperature",
        "temperatures.scuffing",
        lambda: _temperatures(scuffing=300.0),
    ),
    ("out_of_range", "couplings.0.misalignment", lambda: coupling(offset=(0.0, 0.1))),
]


def _temperatures(**changes: float) -> DriveTrainInputs:
    inputs = turbo_gear()
    return replace(inputs, mesh=replace(inputs.mesh, temperatures=replace(inputs.mesh.temperatures, **changes)))


@pytest.mark.parametrize(("code", "field", "inputs"), REFUSED)
def test_refusals(code: str, field: str, inputs: Callable[[], DriveTrainInputs]) -> None:
    with pytest.raises(InvalidInput) as refusal:
        solve(inputs())
    assert (refusal.value.code, refusal.value.field) == (code, field)


def test_ranges_of_parts_are_checked_by_name() -> None:
    thin = coupling(coupling=replace(COUPLING.coupling, face_width=-1.0))
    with pytest.raises(InvalidInput, match=r"face_width is -1000 mm; permissible 0\.1 to 2000 mm") as refusal:
        drive_train.solve(thin)
    assert refusal.value.code == "out_of_range"


def test_a_film_too_thin_to_exist() -> None:
    thin = tuple(
        replace(bearing, viscosity=1e-9) for bearing in PINION_SHAFT.bearings if isinstance(bearing, JournalBearing)
    )
    with pytest.raises(NoSolution) as refusal:
        solve(pinion_shaft(bearings=thin))
    assert refusal.value.code == "journal"


def codes(inputs: DriveTrainInputs) -> dict[str, str | None]:
    return {notice.code: notice.field for notice in solve(inputs).warnings}


def test_warnings_of_the_example() -> None:
    found = codes(turbo_gear())
    assert found["thrust_reversal"] == "pinion_shaft.ultimate_thrust"
    assert "short_bearing_range" not in found, "140 over 200 mm is the limit itself"
    assert "edge_load" in found
    assert "corner_missed" in found
    assert "wall_response_assumed" not in found
    assert "thrust_overload" not in found
    assert "misalignment_limit" not in found
    assert "thin_film" not in found
    assert "lift_off" not in found
    assert "long_overhang" not in found
    assert "edge_load" not in codes(turbo_gear(GROUND))


def test_warnings_of_other_units() -> None:
    inputs = turbo_gear()
    assert codes(replace(inputs, heat=replace(inputs.heat, wall_response=None)))["wall_response_assumed"]
    assert "wall_response_assumed" not in codes(
        replace(inputs, heat=replace(inputs.heat, wall_response=None), effects=Effects(thermal=False))
    )
    assert codes(pinion_shaft(ultimate_thrust=60e3))["thrust_overload"] == "pinion_shaft.ultimate_thrust"
    assert "thrust_overload" not in codes(pinion_shaft(ultimate_thrust=80e3))
    assert codes(coupling(offset=(0.0, 1.2e-3)))["misalignment_limit"] == "couplings.0.misalignment"
    wide = tuple(replace(bearing, width=0.113) for bearing in inputs.pinion_shaft.bearings)
    assert codes(pinion_shaft(bearings=wide))["short_bearing_range"] == "pinion_shaft.bearings.1.width"
    lifted = turbo_gear(replace(GROUND, helix_slope=250e-6))
    assert "lift_off" in codes(lifted)
    thin = tuple(
        replace(bearing, viscosity=3e-4) for bearing in PINION_SHAFT.bearings if isinstance(bearing, JournalBearing)
    )
    assert codes(pinion_shaft(bearings=thin))["thin_film"] == "pinion_shaft.bearings.1.radial_clearance"
    far = Shaft(
        (ShaftSection(0.3, 0.13), *PINION_SHAFT.sections), PINION_SHAFT.bearings, start=-0.3, torque_position=-0.25
    )
    overhung = replace(turbo_gear(), pinion_shaft=far, couplings=(replace(COUPLING, position=-0.25),))
    assert codes(overhung)["long_overhang"] == "couplings.0.position"


def test_an_aligned_hub_is_said_to_stick() -> None:
    frictional = replace(COUPLING, friction=Friction(0.25), offset=(0.0, -20e-6))
    inputs = replace(turbo_gear(), couplings=(frictional,), coupling_friction="elastic_plastic")
    moved = solve(replace(inputs, couplings=(COUPLING,)))
    assert not any(moved.couplings[0].stuck)
    assert "hub_sticks" not in {notice.code for notice in moved.warnings}
    curves = solve(replace(inputs, effects=Effects(coupling=False))).shafts[0].curves
    lines = [np.polyfit(curves.z[:3], line[:3], 1) for line in (curves.x, curves.y)]
    reach = COUPLING.position - COUPLING.coupling.hub_distance
    offset, slope = [np.polyval(line, reach) for line in lines], [line[0] for line in lines]
    straight = replace(frictional, offset=(offset[0], offset[1]), slope=(slope[0], slope[1]))
    stuck = solve(replace(inputs, couplings=(straight,)))
    assert all(stuck.couplings[0].stuck)
    assert max(stuck.couplings[0].friction_share) < 0.8
    assert {notice.code: notice.field for notice in stuck.warnings}["hub_sticks"] == "couplings.0.friction"
