"""Edge cases of the load distribution are refused, warned of or solved, also with unusual contact ratios."""

from dataclasses import replace
from math import radians
from typing import Any

import numpy as np
import pytest

from benchmarks.published.xue import PAPER_LOAD, paper_gears, paper_pair
from solvers.gears.inputs import GROUND_FILLET, GearPairInputs, GearTeeth
from solvers.lubricants import Lubricant
from solvers.scuffing.inputs import (
    Load,
    LoadDistributionInputs,
    Model,
    Modifications,
    Resolution,
    ScuffingInputs,
    Temperatures,
    angular_speed,
)
from solvers.scuffing.model import solve as solve_load_distribution
from solvers.scuffing.results import LoadDistribution
from solvers.scuffing.safety import solve_scuffing
from solvers.scuffing.safety_results import Scuffing
from tests.support.gear_pairs import UNDERCUT_PAIR, with_torque
from tests.support.modified_pairs import random_pair
from tests.support.outcomes import codes, refused
from tests.support.properties import first

LINEAR, HERTZIAN = Model(contact="linear"), Model()
STUB = {"addendum": 0.5, "dedendum": 1.0}
STUBBED = replace(paper_gears(4), pinion=GearTeeth(23, **STUB), wheel=GearTeeth(30, **STUB))
SPUR = replace(paper_gears(1), helix_angle=0.0)


def solve_gears(gears: GearPairInputs, model: Model = HERTZIAN) -> LoadDistribution:
    return solve_load_distribution(LoadDistributionInputs(gears, PAPER_LOAD, model=model))


def closed_form(inputs: LoadDistributionInputs) -> Scuffing:
    return solve_scuffing(
        ScuffingInputs(
            inputs,
            lubrication="closed_form",
            lubricant=Lubricant(),
            friction="given",
            temperatures=Temperatures(bulk=360.0, bulk_method="given"),
        )
    )


def everything_finite(result: LoadDistribution) -> bool:
    line, flank = result.feature_line, result.flank
    arrays = [line.line_load, line.half_width, line.radius, line.sliding, flank.line_load, flank.modification]
    return all(np.all(np.isfinite(array)) for array in (*arrays, result.transmission_error.curves.error))


# Teeth


def test_undercut_is_a_warning_and_cuts_the_path_at_the_base_circle() -> None:
    gears = GearPairInputs(GearTeeth(10), GearTeeth(60), 3e-3, 20e-3, rack_tip_radius=0.38)
    result = solve_gears(gears)
    assert result.geometry.undercut
    assert {"undercut", "path_shortened", "path_reaches_base_circle"} <= codes(result)
    assert result.path_of_contact.start == 0.0
    assert np.all(np.isnan(result.flank.pressure[0]))
    assert np.all(np.isfinite(result.flank.pressure[20:]))
    assert np.isnan(result.feature_line.pressure[0])
    assert everything_finite(result)


@pytest.mark.parametrize("points", [10, 50, 100, 500])
def test_a_loaded_path_that_reaches_a_base_circle_has_no_largest_pressure(points: int) -> None:
    resolution = Resolution(roll_positions=2 * points, slices=points)
    inputs = LoadDistributionInputs(UNDERCUT_PAIR, Load(50.0, angular_speed(1000)), resolution=resolution)
    result = solve_load_distribution(inputs)
    assert result.pressure.max is None
    assert result.pressure.max_at is None
    assert "path_reaches_base_circle" in codes(result)
    assert result.load.max_line_load == pytest.approx(191.16e3, rel=2e-3)


def test_relief_keeps_the_load_off_a_base_circle() -> None:
    """If relief keeps the load off the base circle, the largest pressure exists and is the same at any resolution."""
    relieved = LoadDistributionInputs(
        UNDERCUT_PAIR, Load(50.0, angular_speed(1000)), Modifications(root_relief=200e-6, root_relief_length=1e-3)
    )
    coarse, fine = (
        solve_load_distribution(replace(relieved, resolution=Resolution(count, count // 2))) for count in (100, 800)
    )
    assert "path_reaches_base_circle" not in codes(coarse)
    assert coarse.pressure.max == pytest.approx(fine.pressure.max, rel=1e-3)


@pytest.mark.parametrize("torque", [1e-30, 1e-9])
def test_a_torque_too_small_to_press_modified_flanks_counts_as_none(torque: float) -> None:
    crowned = Modifications(profile_crowning=10e-6, lead_crowning=10e-6, tip_relief=5e-6)
    result = solve_load_distribution(with_torque(paper_pair(1, crowned, HERTZIAN), torque))
    none = solve_load_distribution(with_torque(paper_pair(1, crowned, HERTZIAN), 0.0))
    assert "no_load" in codes(result)
    assert result.load.max_line_load == 0.0
    assert np.array_equal(result.transmission_error.curves.error, none.transmission_error.curves.error)


def test_relief_beyond_the_path_is_taken_and_warned_of() -> None:
    long = Modifications(tip_relief=10e-6, tip_relief_length=0.1, end_relief=5e-6, end_relief_length=0.05)
    result = solve_load_distribution(paper_pair(1, long))
    notices = [notice for notice in result.warnings if notice.code == "unusual_value"]
    assert [notice.field for notice in notices] == ["tip_relief_length", "end_relief_length"]
    path = result.path_of_contact
    expected = 10e-6 * (1 - path.length / 0.1) + 5e-6 * (1 - 10e-3 / 0.05)  # at A, in the middle of the face
    assert result.flank.modification[0, 50] == pytest.approx(expected, rel=1e-9)
    none = replace(long, tip_relief=0.0, end_relief=0.0)
    assert "unusual_value" not in codes(solve_load_distribution(paper_pair(1, none)))


def test_undercut_takes_the_verdict_and_nothing_else() -> None:
    gears = GearPairInputs(GearTeeth(10), GearTeeth(60), 3e-3, 20e-3, helix_angle=radians(10), rack_tip_radius=0.38)
    result = closed_form(LoadDistributionInputs(gears, PAPER_LOAD))
    refused = np.array(result.path.status) == "refused"
    assert 0 < refused.sum() == result.unsolved_points < 5
    for curve in (result.path.blok_flash, result.path.dowson_higginson):
        assert np.all(np.isnan(curve) == refused)
    assert (result.flash.blok_max, result.film.dowson_higginson_min, result.distribution.pressure.max) == (None,) * 3
    assert [notice.code for notice in result.warnings].count("path_reaches_base_circle") == 1
    assert "no_film" not in codes(result)


def test_where_pressure_has_no_largest_value_flash_has_none_either() -> None:
    """The flank is loaded at the base circle, but not at the corner A1, where the feature line begins."""
    # The flash temperature on the feature line is therefore finite, but no largest flash temperature is stated.
    lifted = LoadDistributionInputs(UNDERCUT_PAIR, Load(50.0, angular_speed(1000)), Modifications(helix_slope=-60e-6))
    result = closed_form(lifted)
    assert np.all(np.isfinite(result.path.blok_flash))
    assert (result.distribution.pressure.max, result.flash.blok_max) == (None, None)
    assert result.contact_temperature.blok_max is None
    assert [notice.code for notice in result.warnings].count("path_reaches_base_circle") == 1


def test_a_rack_tip_radius_beyond_the_rack_is_held_with_a_warning() -> None:
    gears = replace(paper_gears(1), pressure_angle=radians(25))
    held, exact = solve_gears(gears), solve_gears(replace(gears, rack_tip_radius=0.31788))
    assert "rack_tip_radius" in codes(held)
    assert "rack_tip_radius" not in codes(exact)
    assert held.transmission_error.mean == pytest.approx(exact.transmission_error.mean, rel=1e-5)


@pytest.mark.parametrize(
    ("changes", "code", "field"),
    [
        ({"centre_distance": 80e-3}, {"flank_interference"}, "centre_distance"),
        ({"centre_distance": 95e-3}, {"no_mesh"}, None),
        ({"pinion": GearTeeth(23, dedendum=0.95)}, {"no_tip_clearance"}, "pinion.dedendum"),
        ({"pinion": GearTeeth(12, 0.9)}, {"pointed_tooth"}, "pinion.addendum"),
        ({"wheel": GearTeeth(5, 0.0, 1.0, 2.0)}, {"root_circle"}, None),
        # The fillet reaches its own tip.
        (
            {"pinion": GearTeeth(60, addendum=-1.15), "wheel": GearTeeth(60, addendum=1.2), "rack_tip_radius": 0.0},
            {"form_diameter", "no_mesh"},
            None,
        ),
    ],
)
def test_gears_that_cannot_be_are_refused(changes: dict[str, Any], code: set[str], field: str | None) -> None:
    found, named = refused(solve_gears, replace(paper_gears(1), **changes))
    assert found in code
    assert field is None or named == field


def test_teeth_pointed_in_their_normal_section_only_are_refused_there() -> None:
    gears = GearPairInputs(
        GearTeeth(26, 2.38),
        GearTeeth(165, 1.01),
        5e-3,
        50e-3,
        module_plane="transverse",
        pressure_angle=radians(30.8),
        helix_angle=radians(43.0),
        rack_tip_radius=GROUND_FILLET,
    )
    assert everything_finite(solve_gears(gears, model=Model(section="transverse")))
    assert refused(solve_gears, gears, Model(section="normal")) == ("pointed_tooth", "section")


def test_teeth_no_narrower_at_the_tip_than_at_the_root_count_as_rectangles() -> None:
    # An undercut tooth with hardly any involute left: its width at the form circle is below the one at the tip.
    gears = GearPairInputs(
        GearTeeth(9, -0.3, addendum=0.2), GearTeeth(60, 0.3), 3e-3, 60e-3, helix_angle=radians(20), rack_tip_radius=0.2
    )
    result = solve_gears(gears, model=Model(section="transverse"))
    assert everything_finite(result)
    assert np.all(result.stiffness.curves.single > 0)


def test_a_larger_centre_distance_brings_backlash_and_a_shorter_path() -> None:
    near, far = solve_gears(paper_gears(1)), solve_gears(replace(paper_gears(1), centre_distance=81.5e-3))
    assert far.geometry.working_pressure_angle > near.geometry.working_pressure_angle
    assert far.geometry.transverse_contact_ratio < near.geometry.transverse_contact_ratio


def test_the_pitch_point_may_lie_outside_the_path() -> None:
    teeth = {"pinion": GearTeeth(23, 1.0, dedendum=1.4), "wheel": GearTeeth(30, -1.0, addendum=0.9, dedendum=1.3)}
    result = solve_gears(replace(paper_gears(1), **teeth))
    assert result.path_of_contact.start > result.path_of_contact.pitch_point
    assert result.stiffness.pitch is None
    assert "pitch_point_outside" in codes(result)
    assert result.friction_loss.loss_factor is not None


# Loads


def test_contact_is_lost_over_part_of_the_flank() -> None:
    result = solve_load_distribution(paper_pair(4, Modifications(lead_crowning=80e-6, helix_slope=60e-6)))
    loads = result.flank.line_load
    assert 0.05 < result.load.contact_fraction < 0.8
    assert np.all(loads >= 0)
    assert np.any(loads == 0)
    assert np.all(result.flank.pressure[loads == 0] == 0)
    assert result.load.balance_error < 1e-12
    assert everything_finite(result)


@pytest.mark.parametrize(
    ("inputs", "bare"),
    [
        (paper_pair(4, Modifications(lead_crowning=80e-6)), [0, -1]),
        (with_torque(paper_pair(4, Modifications(lead_crowning=-400e-6)), 1.0), [25]),  # hollow
    ],
)
def test_no_film_where_the_feature_line_is_not_loaded(inputs: LoadDistributionInputs, bare: list[int]) -> None:
    result = closed_form(inputs)
    assert np.all(result.distribution.feature_line.line_load[bare] == 0.0)
    assert np.isnan(result.path.dowson_higginson[bare[0]])
    assert result.path.blok_flash[bare[0]] == 0.0
    assert result.film.dowson_higginson_min is not None
    assert ("no_film", "modifications") in {(notice.code, notice.field) for notice in result.warnings}


@pytest.mark.parametrize("seed", first(3, range(6)))
def test_modifications_are_not_blamed_where_none_was_given(seed: int) -> None:
    """Unmodified flanks touch wherever they are loaded."""
    # If a film is missing, the warning therefore names only the torque or the speed, and only if this input is zero or
    # almost zero.
    drawn = random_pair(np.random.default_rng([5, seed]))
    plain = replace(drawn.distribution, modifications=Modifications())
    for load, blamed in (
        (plain.load, set()),
        (replace(plain.load, pinion_torque=1e-30), {"pinion_torque"}),
        (replace(plain.load, pinion_speed=0.0), {"pinion_speed"}),
    ):
        inputs = replace(drawn, distribution=replace(plain, load=load), lubrication="closed_form")
        result = solve_scuffing(inputs)
        assert {notice.field for notice in result.warnings if notice.code == "no_film"} == blamed


@pytest.mark.parametrize("model", [LINEAR, HERTZIAN])
def test_without_torque_the_transmission_error_is_kinematic(model: Model) -> None:
    shape = Modifications(profile_crowning=10e-6, helix_slope=8e-6, end_relief=5e-6)
    result = solve_load_distribution(with_torque(paper_pair(3, shape, model), 0.0))
    assert "no_load" in codes(result)
    assert result.transmission_error.curves.error == pytest.approx(result.balance.unloaded_error, abs=0.0)
    assert result.load.max_line_load == result.load.contact_fraction == result.friction_loss.power == 0.0
    assert (result.load.max_at, result.load.face_load_factor, result.feature_line.load_sharing) == (None,) * 3
    assert (result.stiffness.mean_mesh, result.friction_loss.loss_factor) == (None, None)
    assert not np.any(result.flank.line_load)


def test_the_kinematic_error_is_the_limit_of_a_small_torque() -> None:
    shape = Modifications(profile_crowning=10e-6, lead_crowning=10e-6, tip_relief=5e-6)
    none = solve_load_distribution(with_torque(paper_pair(3, shape, LINEAR), 0.0)).transmission_error
    little = solve_load_distribution(with_torque(paper_pair(3, shape, LINEAR), 1e-4)).transmission_error
    unloaded = np.interp(little.curves.roll_position, none.curves.roll_position, none.curves.error)
    assert little.curves.error == pytest.approx(unloaded, abs=0.02e-6)
    assert np.all(little.curves.error > unloaded - 0.002e-6)


@pytest.mark.parametrize("load", [replace(PAPER_LOAD, pinion_torque=0.0), replace(PAPER_LOAD, pinion_speed=0.0)])
def test_scuffing_without_torque_or_speed_has_neither_flash_nor_film(load: Load) -> None:
    result = closed_form(replace(paper_pair(1), load=load))
    assert result.flash.blok_max == 0.0
    assert result.film.dowson_higginson_min is None
    if load.pinion_torque == 0.0:
        assert (result.flash.blok_at_psi, result.film.thickness_regime) == (None, None)
        assert ("no_film", "pinion_torque") in {(notice.code, notice.field) for notice in result.warnings}


def test_negative_transmission_error_is_legal() -> None:
    # Helix slope is centred: at little load one end meets ahead of the nominal position. Xue Eq. 10 never
    # converges here.
    tenth = PAPER_LOAD.pinion_torque / 10
    result = solve_load_distribution(with_torque(paper_pair(4, Modifications(helix_slope=40e-6)), tenth))
    assert result.transmission_error.min < 0
    assert result.load.balance_error < 1e-12


def test_extreme_loads_stay_within_the_half_space_limit() -> None:
    result = solve_load_distribution(with_torque(paper_pair(1, model=HERTZIAN), 2e5))
    assert "half_space" in codes(result)
    assert result.load.balance_error < 1e-10
    assert everything_finite(result)


def test_the_parabola_refuses_half_space_contact() -> None:
    inputs = paper_pair(1, model=Model(tooth_stiffness="parabola"))
    assert refused(solve_load_distribution, inputs) == ("contact_law", "contact")


@pytest.mark.parametrize(
    ("changes", "code"),
    [
        ({"pinion": GearTeeth(7, 0.3), "wheel": GearTeeth(60)}, "teeth_range"),
        ({"pressure_angle": radians(14.0)}, "pressure_angle_range"),
        ({"helix_angle": radians(46.0)}, "helix_angle_range"),
        ({"pinion": GearTeeth(14, 0.75)}, "thin_tip"),
    ],
)
def test_ranges_of_the_model_are_warned_about(changes: dict[str, Any], code: str) -> None:
    assert code in codes(solve_gears(replace(paper_gears(1), **changes)))


def test_default_reliefs_reach_to_the_single_contact_and_have_a_floor() -> None:
    result = solve_load_distribution(paper_pair(1))
    gap, geometry = result.balance.mesh.gap, result.geometry
    long_relief = (geometry.transverse_contact_ratio - 1) * geometry.transverse_base_pitch
    assert gap.tip_relief_length == pytest.approx(long_relief, rel=1e-12)
    assert gap.root_relief_length == pytest.approx(long_relief, rel=1e-12)
    assert gap.end_relief_length == pytest.approx(2e-3, rel=1e-12)


@pytest.mark.parametrize("slope", [-645e-6, 20e-6])
def test_without_a_force_nothing_presses_between_the_slices_either(slope: float) -> None:
    # the kinematic error leaves an end of a line less than rounding apart: once an endless face load factor
    result = solve_load_distribution(with_torque(paper_pair(1, Modifications(profile_slope=slope), HERTZIAN), 0.0))
    assert result.load.max_line_load == 0.0
    assert result.load.face_load_factor is None
    assert result.pressure.max == 0.0


# Spur gears and unusual contact ratios: limits of the load distribution, not cases of their own


def test_spur_gears_jump_between_one_and_two_pairs_and_keep_both_limits() -> None:
    result = solve_gears(SPUR, LINEAR)
    lines, curves = result.contact_lines, result.transmission_error.curves
    assert np.unique(lines.curves.length.round(12)) == pytest.approx([20e-3, 40e-3], rel=1e-12)
    assert (lines.min_length, lines.max_length) == pytest.approx((20e-3, 40e-3), rel=1e-12)
    assert result.load.max_line_load == pytest.approx(result.load.normal_force / 20e-3, rel=1e-9)
    both = curves.error[np.isclose(curves.roll_position, result.geometry.transverse_contact_ratio % 1, atol=1e-12)]
    assert both.size == 2
    assert both[1] > 1.5 * both[0]
    assert curves.error[-1] > 1.5 * curves.error[0]  # the new pair has come in, and has not yet, one limit earlier
    ends = result.flank.line_load[[0, -1]]
    assert np.all((ends > 0.2 * result.load.max_line_load) & (ends < 0.7 * result.load.max_line_load))


def test_spur_gears_without_modification_are_springs_in_parallel() -> None:
    result = solve_gears(SPUR, model=LINEAR)
    path, pitch = result.geometry.path_of_contact, result.geometry.transverse_base_pitch
    curves, single = result.transmission_error.curves, result.stiffness.curves
    place = (single.gamma - single.gamma[0]) / np.ptp(single.gamma) * path
    first = curves.roll_position[1:-1] * pitch
    second = np.where(first + pitch <= path, np.interp(first + pitch, place, single.single), 0.0)
    springs = np.interp(first, place, single.single) + second
    jump = np.isclose(first + pitch, path, atol=1e-12)
    expected = result.load.normal_force / 20e-3 / springs
    assert curves.error[1:-1][~jump] == pytest.approx(expected[~jump], rel=2e-4)  # the table has steps of 1 % of a path


@pytest.mark.parametrize("model", [LINEAR, HERTZIAN])
def test_spur_gears_are_the_limit_of_a_small_helix(model: Model) -> None:
    straight = solve_gears(SPUR, model=model)
    slight = solve_gears(replace(SPUR, helix_angle=radians(0.01)), model=model)
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
    assert slight.pressure.max_at.profile_fraction == 0.0
    assert slight.pressure.max > straight.pressure.max


def test_a_helix_below_rounding_is_a_spur_gear() -> None:
    straight, hair = solve_gears(SPUR), solve_gears(replace(SPUR, helix_angle=1e-12))
    assert hair.geometry.overlap_ratio == 0.0
    assert hair.transmission_error.peak_to_peak == pytest.approx(straight.transmission_error.peak_to_peak, rel=1e-9)


def test_a_contact_ratio_below_1_needs_overlap() -> None:
    result = solve_gears(STUBBED)
    assert result.geometry.transverse_contact_ratio < 1
    assert result.contact_lines.min_length > 0
    assert result.feature_line.iso_load_sharing is None
    assert refused(solve_gears, replace(STUBBED, helix_angle=0.0))[0] == "no_contact"
    assert refused(solve_gears, replace(STUBBED, face_width=3e-3))[0] == "no_contact"


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
    wide = solve_gears(STUBBED).geometry
    overlap = 1.03 - wide.transverse_contact_ratio
    result = solve_gears(replace(STUBBED, face_width=STUBBED.face_width * overlap / wide.overlap_ratio))
    assert result.geometry.total_contact_ratio == pytest.approx(1.03, rel=1e-12)
    assert "uneven_contact_length" in codes(result)
    assert result.load.balance_error < 1e-12
