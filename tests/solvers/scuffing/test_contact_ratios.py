"""Spur gears and unusual contact ratios: limits of the load distribution, not cases of their own."""

from dataclasses import replace
from math import radians

import numpy as np
import pytest

from solvers.gears.inputs import GearTeeth
from solvers.published.xue import paper_gears
from solvers.scuffing.inputs import (
    Model,
)
from tests.support.loaded_gears import LINEAR, codes, refusal, solve_gears, spur

# Spur gears


def test_spur_gears_jump_between_one_and_two_pairs() -> None:
    result = solve_gears(spur(), model=LINEAR)
    lengths = np.unique(result.contact_lines.curves.length.round(12))
    assert lengths == pytest.approx([20e-3, 40e-3], rel=1e-12)
    assert result.contact_lines.min_length == pytest.approx(20e-3, rel=1e-12)
    assert result.contact_lines.max_length == pytest.approx(40e-3, rel=1e-12)
    assert result.load.max_line_load == pytest.approx(result.load.normal_force / 20e-3, rel=1e-9)


def test_spur_gears_keep_both_limits_of_a_jump() -> None:
    result = solve_gears(spur(), model=LINEAR)
    curves, geometry = result.transmission_error.curves, result.geometry
    jump = geometry.transverse_contact_ratio % 1
    both = curves.error[np.isclose(curves.roll_position, jump, atol=1e-12)]
    assert both.size == 2
    assert both[1] > 1.5 * both[0]
    assert curves.error[-1] > 1.5 * curves.error[0]  # the new pair has come in, and has not yet, one limit earlier


def test_spur_gears_without_modification_are_springs_in_parallel() -> None:
    result = solve_gears(spur(), model=LINEAR)
    path, pitch = result.geometry.path_of_contact, result.geometry.transverse_base_pitch
    curves, single = result.transmission_error.curves, result.stiffness.curves
    place = (single.gamma - single.gamma[0]) / np.ptp(single.gamma) * path
    first = curves.roll_position[1:-1] * pitch
    second = np.where(first + pitch <= path, np.interp(first + pitch, place, single.single), 0.0)
    springs = np.interp(first, place, single.single) + second
    jump = np.isclose(first + pitch, path, atol=1e-12)
    expected = result.load.normal_force / 20e-3 / springs
    assert curves.error[1:-1][~jump] == pytest.approx(expected[~jump], rel=2e-4)  # the table has steps of 1 % of a path


@pytest.mark.parametrize("model", [LINEAR, Model()])
def test_spur_gears_are_the_limit_of_a_small_helix(model: Model) -> None:
    straight = solve_gears(spur(), model=model)
    slight = solve_gears(replace(spur(), helix_angle=radians(0.01)), model=model)
    for name in ("peak_to_peak", "min", "max", "mean"):
        expected = getattr(straight.transmission_error, name)
        # The entry of a line takes 0.04 % of a pitch: that much of the mean moves.
        assert getattr(slight.transmission_error, name) == pytest.approx(expected, rel=1e-3)
    assert slight.transmission_error.harmonics == pytest.approx(straight.transmission_error.harmonics, rel=0.01)
    assert slight.load.max_line_load == pytest.approx(straight.load.max_line_load, rel=1e-3)
    middle = slice(5, -5)
    assert slight.flank.pressure[middle, 50] == pytest.approx(straight.flank.pressure[middle, 50], rel=0.02)
    # A line of no length that enters at A1 meets the approach of the one pair before it: no limit of a spur gear,
    # whose whole flank enters at once.
    assert slight.pressure.max_at is not None
    assert slight.pressure.max_at.profile_fraction == 0.0
    assert slight.pressure.max > straight.pressure.max


def test_a_helix_below_rounding_is_a_spur_gear() -> None:
    straight, hair = solve_gears(spur()), solve_gears(replace(spur(), helix_angle=1e-12))
    assert hair.geometry.overlap_ratio == 0.0
    assert hair.transmission_error.peak_to_peak == pytest.approx(straight.transmission_error.peak_to_peak, rel=1e-9)


def test_the_ends_of_the_path_of_a_spur_gear_carry_their_share() -> None:
    result = solve_gears(spur(), model=LINEAR)
    ends = result.flank.line_load[[0, -1]]
    assert np.all(ends < 0.7 * result.load.max_line_load)
    assert np.all(ends > 0.2 * result.load.max_line_load)


# Contact ratios


def test_a_contact_ratio_below_1_needs_overlap() -> None:
    stub = {"addendum": 0.5, "dedendum": 1.0}
    gears = replace(paper_gears(4), pinion=GearTeeth(23, **stub), wheel=GearTeeth(30, **stub))
    result = solve_gears(gears)
    assert result.geometry.transverse_contact_ratio < 1
    assert result.contact_lines.min_length > 0
    assert result.feature_line.iso_load_sharing is None
    assert refusal(replace(gears, helix_angle=0.0)).code == "no_contact"
    assert refusal(replace(gears, face_width=3e-3)).code == "no_contact"


@pytest.mark.parametrize("helix", [0.0, 20.2])
def test_a_contact_ratio_above_2_is_nothing_special(helix: float) -> None:
    tall = {"addendum": 1.35, "dedendum": 1.6}
    gears = replace(
        paper_gears(3),
        helix_angle=radians(helix),
        pinion=GearTeeth(40, **tall),
        wheel=GearTeeth(50, **tall),
        rack_tip_radius=0.2,
    )
    result = solve_gears(gears)
    assert 2 < result.geometry.transverse_contact_ratio < 3
    assert result.contact_lines.min_length > 1.9 * 20e-3
    assert (result.feature_line.iso_load_sharing is None) == (helix == 0.0)


def test_a_short_smallest_contact_length_is_warned_about() -> None:
    # eps_alpha + eps_beta just above 1 with eps_alpha below 1: hardly any line at some roll positions.
    stub = {"addendum": 0.5, "dedendum": 1.0}
    gears = replace(paper_gears(4), pinion=GearTeeth(23, **stub), wheel=GearTeeth(30, **stub))
    wide = solve_gears(gears).geometry
    overlap = 1.03 - wide.transverse_contact_ratio
    result = solve_gears(replace(gears, face_width=gears.face_width * overlap / wide.overlap_ratio))
    assert result.geometry.total_contact_ratio == pytest.approx(1.03, rel=1e-12)
    assert "uneven_contact_length" in codes(result)
    assert result.load.balance_error < 1e-12
