"""The tests compute the geometry of the tooth spaces in Milian's Fig. 3 and Tables 1-3."""

from dataclasses import replace
from math import degrees, hypot, pi

import numpy as np
import pytest

from benchmarks.published.milian import CASE_1, CASE_2, TABLE_1, TIP, pinion, run
from solvers.gears.inputs import GearPairInputs
from solvers.gears.pair import gear_pair
from solvers.pumping.inputs import Gap
from solvers.pumping.space.section import section
from solvers.pumping.space.stroke import StrokeTable, stroke_table
from solvers.pumping.space.tooth_space import circumferential_backlash, normal_backlash, tooth_space


@pytest.fixture(scope="module")
def fig_3() -> StrokeTable:
    return stroke_table(tooth_space(gear_pair(TABLE_1), 0.0, Gap.TIP, of_pinion=True))


@pytest.mark.parametrize(("gears", "expected"), [(TABLE_1, 514.0756), (CASE_1, 589.968), (CASE_2, 454.99967)])
def test_backlash_free_centre_distance(gears: GearPairInputs, expected: float) -> None:
    # the normal module gives the round 590 and 455 mm; a transverse module would give 575 and 448
    assert gear_pair(gears).backlash_free_centre_distance * 1e3 == pytest.approx(expected, abs=5e-4)


@pytest.mark.parametrize("gears", [TABLE_1, CASE_1, CASE_2])
def test_no_backlash_at_the_backlash_free_centre_distance(gears: GearPairInputs) -> None:
    assert abs(circumferential_backlash(gear_pair(replace(gears, centre_distance=None)), 0.0)) < 1e-15


def test_case_1_backlash_of_the_centre_distance() -> None:
    assert normal_backlash(gear_pair(CASE_1), 0.0) * 1e6 == pytest.approx(21.946, abs=5e-4)


def test_fig_3_volume_is_u_shaped_and_symmetric_without_backlash(fig_3: StrokeTable) -> None:
    area = fig_3.area * 1e6
    assert (np.diff(area[:181]) < 0).all()
    assert (np.diff(area[180:]) > 0).all()
    assert fig_3.area == pytest.approx(fig_3.area[::-1], rel=1e-12)
    assert fig_3.clearance_left == pytest.approx(fig_3.clearance_right[::-1], abs=1e-15)


def test_fig_3_stroke_and_clearance(fig_3: StrokeTable) -> None:
    assert np.degrees((fig_3.limits.start, fig_3.limits.end)) == pytest.approx((-20.278, 20.278), abs=1e-3)
    total = (fig_3.clearance_left + fig_3.clearance_right) * 1e3
    assert total[180] == pytest.approx(0.5541, abs=1e-4)
    assert total[[0, 360]].min() > 5 * total[180]


def test_fig_3_tip_touches_the_flank_at_the_start_of_contact(fig_3: StrokeTable) -> None:
    space = tooth_space(gear_pair(TABLE_1), 0.0, Gap.TIP, of_pinion=True)
    assert degrees(fig_3.limits.contact_start) == pytest.approx(-3.9431, abs=1e-3)
    at = fig_3.limits.contact_start
    gaps = [section(space, at + step)[1] for step in (-2e-3, -1e-3, 0.0, 1e-3, 2e-3)]
    assert gaps[2] < 1e-15
    # a double zero: the clearance grows with the square of the angle on both sides
    assert gaps[0] / gaps[1] == pytest.approx(4.0, rel=0.1)
    assert gaps[4] / gaps[3] == pytest.approx(4.0, rel=0.1)


def test_contact_duration_is_the_contact_ratio(fig_3: StrokeTable) -> None:
    duration = fig_3.limits.contact_end - fig_3.limits.contact_start
    result = run(TABLE_1, 1000, TIP, 10, 0.0)
    assert duration * 47 / (2 * pi) == pytest.approx(result.geometry.transverse_contact_ratio, rel=1e-12)
    assert pinion(result).stroke.contact_start < 0


@pytest.mark.parametrize("gears", [TABLE_1, CASE_1, CASE_2])
@pytest.mark.parametrize("of_pinion", [True, False])
def test_displacement_law_of_gear_pumps(gears: GearPairInputs, *, of_pinion: bool) -> None:
    """While both flanks seal, the area of a tooth space (Milian Eq. 5) grows with the square of the angle."""
    # S = S_0 + K phi^2 with K = r_b [(z1/z2)(N - s) - s] while both flanks seal: exact, without backlash
    pair = gear_pair(replace(gears, centre_distance=None))
    space = tooth_space(pair, 0.0, Gap.CONTACT, of_pinion=of_pinion)
    s = space.pitch_roll - space.base_radius * space.pitch_half_angle
    stiffness = space.base_radius * (space.ratio * (space.line_of_action - s) - s)
    start = -stroke_table(space).limits.contact_start if of_pinion else stroke_table(space).limits.contact_end
    smallest = section(space, 0.0)[0]
    for share in (-0.95, -0.5, 0.3, 0.9):
        angle = share * abs(start)
        assert section(space, angle)[0] - smallest == pytest.approx(stiffness * angle**2, rel=1e-9)


@pytest.mark.parametrize("of_pinion", [True, False])
def test_volume_rate_with_a_gap_fixed_in_space(*, of_pinion: bool) -> None:
    # dS/dphi = (z1/z2)(N - s - j/2)(2 r_b phi -+ j) - 2 s r_b phi while both sides close on the line of action; the
    # minimum of case 1 is near j v/(2 K w) = 0.49 deg
    space = tooth_space(gear_pair(CASE_1), 0.3e-3, Gap.CONTACT, of_pinion=of_pinion)
    s, j, base = space.pitch_roll - space.base_radius * space.pitch_half_angle, space.backlash_gap, space.base_radius
    arm = space.ratio * (space.line_of_action - s - j / 2)
    minimum = j * arm / (2 * base * (arm - s)) * (1 if of_pinion else -1)
    step = 1e-5
    for angle in (-0.02, 0.0, 0.015):
        slope = (section(space, angle + step)[0] - section(space, angle - step)[0]) / (2 * step)
        assert slope == pytest.approx(2 * base * (arm - s) * (angle - minimum), rel=1e-6)
    if of_pinion:
        assert degrees(minimum) == pytest.approx(0.49, abs=0.05)


@pytest.mark.parametrize("of_pinion", [True, False])
def test_flanks_carry_gas_out_of_the_drivers_spaces_into_the_driven_ones(*, of_pinion: bool) -> None:
    # on the line of centres hardly anything is squeezed: the change of volume is what the flanks carry, to 8 %
    space = tooth_space(gear_pair(CASE_1), 0.3e-3, Gap.CONTACT, of_pinion=of_pinion)
    ahead, back = section(space, 1e-5), section(space, -1e-5)
    transport = (ahead[3] - back[3]) / 2e-5
    assert (transport > 0) is of_pinion
    assert (ahead[0] - back[0]) / 2e-5 == pytest.approx(-transport, rel=0.08)


def test_rolling_velocity_at_the_test_speeds() -> None:
    # 53-70 m/s: half the sum of the two flanks' rolling velocities
    for gears, speed in ((CASE_1, 9267.0), (CASE_2, 8962.0)):
        space = tooth_space(gear_pair(gears), 0.3e-3, Gap.CONTACT, of_pinion=True)
        table = stroke_table(space)
        transport = np.diff(table.carried) / np.diff(table.angle)
        rolling = (transport[:-2] > 0) & (transport[2:] > 0)  # the section is on the flanks all along
        velocity = transport[1:-1][rolling] / space.backlash_gap * speed * pi / 30
        assert 50 < velocity.min() < velocity.max() < 75


@pytest.mark.parametrize("gears", [TABLE_1, CASE_1, CASE_2])
def test_sealed_flank_is_the_line_of_action(gears: GearPairInputs) -> None:
    space = tooth_space(gear_pair(gears), 0.3e-3, Gap.CONTACT, of_pinion=True)
    limits = stroke_table(space).limits
    for share in (0.01, 0.5, 0.99):
        angle = limits.contact_start + share * (limits.contact_end - limits.contact_start)
        assert section(space, angle)[1] < 1e-12
    assert section(space, 0.0)[2] == pytest.approx(space.backlash_gap, rel=1e-12)
    assert space.tip_roll == pytest.approx(np.sqrt(space.tip_radius**2 - space.base_radius**2))
    assert hypot(space.base_radius, space.root.involute_roll) < space.tip_radius
