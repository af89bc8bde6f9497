"""Edge cases of the load distribution: what is refused, what is warned about, what degenerates gracefully."""

from dataclasses import replace
from math import radians

import numpy as np
import pytest

from solvers.errors import InvalidInput
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.published.xue import PAPER_LOAD, paper_gears, paper_pair
from solvers.scuffing.inputs import (
    Load,
    LoadDistributionInputs,
    Model,
    Modifications,
    Resolution,
    ScuffingInputs,
    angular_speed,
)
from solvers.scuffing.model import solve as solve_load_distribution
from solvers.scuffing.safety import solve_scuffing
from tests.support.gear_pairs import UNDERCUT_PAIR, with_torque
from tests.support.loaded_gears import LINEAR, codes, everything_finite, refusal, solve_gears
from tests.support.modified_pairs import random_pair

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
    """What is not loaded there needs no limit: the pressure is that of the rest, at any resolution."""
    relieved = LoadDistributionInputs(
        UNDERCUT_PAIR, Load(50.0, angular_speed(1000)), Modifications(root_relief=200e-6, root_relief_length=1e-3)
    )
    coarse, fine = (
        solve_load_distribution(replace(relieved, resolution=Resolution(count, count // 2))) for count in (100, 800)
    )
    assert "path_reaches_base_circle" not in codes(coarse)
    assert coarse.pressure.max is not None
    assert coarse.pressure.max == pytest.approx(fine.pressure.max, rel=1e-3)


@pytest.mark.parametrize("torque", [1e-30, 1e-9])
def test_a_torque_too_small_to_press_modified_flanks_counts_as_none(torque: float) -> None:
    crowned = Modifications(profile_crowning=10e-6, lead_crowning=10e-6, tip_relief=5e-6)
    result = solve_load_distribution(with_torque(paper_pair(1, crowned, Model()), torque))
    none = solve_load_distribution(with_torque(paper_pair(1, crowned, Model()), 0.0))
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
    assert "unusual_value" not in codes(
        solve_load_distribution(paper_pair(1, replace(long, tip_relief=0.0, end_relief=0.0)))
    )


def test_undercut_takes_the_verdict_and_nothing_else() -> None:
    gears = GearPairInputs(GearTeeth(10), GearTeeth(60), 3e-3, 20e-3, helix_angle=radians(10), rack_tip_radius=0.38)
    result = solve_scuffing(ScuffingInputs(LoadDistributionInputs(gears, PAPER_LOAD), lubrication="closed_form"))
    refused = np.array(result.path.status) == "refused"
    assert 0 < refused.sum() == result.unsolved_points < 5
    for curve in (result.path.blok_flash, result.path.dowson_higginson):
        assert np.all(np.isnan(curve) == refused)
    assert (result.flash.blok_max, result.film.dowson_higginson_min, result.distribution.pressure.max) == (
        None,
        None,
        None,
    )
    assert [notice.code for notice in result.warnings].count("path_reaches_base_circle") == 1
    assert "no_film" not in codes(result)


def test_where_pressure_has_no_largest_value_flash_has_none_either() -> None:
    """The feature line keeps off the loaded part of the base circle: lifted at A1, its own flash is finite."""
    lifted = LoadDistributionInputs(UNDERCUT_PAIR, Load(50.0, angular_speed(1000)), Modifications(helix_slope=-60e-6))
    result = solve_scuffing(ScuffingInputs(lifted, lubrication="closed_form"))
    assert np.all(np.isfinite(result.path.blok_flash))
    assert (result.distribution.pressure.max, result.flash.blok_max) == (None, None)
    assert result.contact_temperature.blok_max is None
    assert [notice.code for notice in result.warnings].count("path_reaches_base_circle") == 1


def test_a_path_shortened_by_the_fillet_is_a_warning() -> None:
    # The wheel's tip reaches 1.4 modules deep, the straight flank of the pinion's rack 1.21.
    gears = GearPairInputs(
        GearTeeth(30, dedendum=1.45), GearTeeth(100, addendum=1.4), 3e-3, 20e-3, rack_tip_radius=0.36
    )
    result = solve_gears(gears)
    path = result.path_of_contact
    assert "path_shortened" in codes(result)
    assert path.shortened_by == ("pinion",)
    assert path.start == pytest.approx(path.pair.pinion.form_roll_length, rel=1e-12)
    assert path.start > path.pair.line_of_action - path.pair.wheel.tip_roll_length


def test_a_rack_tip_radius_beyond_the_rack_is_held_with_a_warning() -> None:
    gears = replace(paper_gears(1), pressure_angle=radians(25))
    held, exact = solve_gears(gears), solve_gears(replace(gears, rack_tip_radius=0.31788))
    assert "rack_tip_radius" in codes(held)
    assert "rack_tip_radius" not in codes(exact)
    assert held.transmission_error.mean == pytest.approx(exact.transmission_error.mean, rel=1e-5)


def test_a_centre_distance_below_the_backlash_free_one_is_refused() -> None:
    error = refusal(replace(paper_gears(1), centre_distance=80e-3))
    assert (error.code, error.field) == ("flank_interference", "centre_distance")


def test_no_tip_clearance_is_refused() -> None:
    gears = replace(paper_gears(1), pinion=GearTeeth(23, dedendum=0.95))
    error = refusal(gears)
    assert (error.code, error.field) == ("no_tip_clearance", "pinion.dedendum")


def test_pointed_teeth_are_refused() -> None:
    error = refusal(replace(paper_gears(1), pinion=GearTeeth(12, 0.9)))
    assert (error.code, error.field) == ("pointed_tooth", "pinion.addendum")


def test_root_circle_too_small_for_its_teeth_is_refused() -> None:
    error = refusal(replace(paper_gears(1), wheel=GearTeeth(5, 0.0, 1.0, 2.0)))
    assert error.code == "root_circle"


def test_teeth_pointed_in_their_normal_section_only_are_refused_there() -> None:
    gears = GearPairInputs(
        GearTeeth(26, 2.38),
        GearTeeth(165, 1.01),
        5e-3,
        50e-3,
        module_plane="transverse",
        pressure_angle=radians(30.8),
        helix_angle=radians(43.0),
    )
    assert everything_finite(solve_gears(gears, model=Model(section="transverse")))
    with pytest.raises(InvalidInput) as caught:
        solve_gears(gears, model=Model(section="normal"))
    assert (caught.value.code, caught.value.field) == ("pointed_tooth", "section")


def test_thin_tips_are_a_warning() -> None:
    assert "thin_tip" in codes(solve_gears(replace(paper_gears(1), pinion=GearTeeth(14, 0.75))))


def test_tips_that_do_not_overlap_are_refused() -> None:
    assert refusal(replace(paper_gears(1), centre_distance=95e-3)).code == "no_mesh"


def test_a_fillet_that_reaches_its_own_tip_is_refused() -> None:
    gears = replace(paper_gears(1), pinion=GearTeeth(60, addendum=-1.15), wheel=GearTeeth(60, addendum=1.2))
    assert refusal(replace(gears, rack_tip_radius=0.0)).code in {"form_diameter", "no_mesh"}


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
    pinion = GearTeeth(23, 1.0, dedendum=1.4)
    wheel = GearTeeth(30, -1.0, addendum=0.9, dedendum=1.3)
    result = solve_gears(replace(paper_gears(1), pinion=pinion, wheel=wheel))
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


def test_no_film_where_the_feature_line_is_not_loaded() -> None:
    heavy = Modifications(lead_crowning=80e-6)
    result = solve_scuffing(ScuffingInputs(paper_pair(4, heavy), lubrication="closed_form"))
    bare = result.distribution.feature_line.line_load[[0, -1]] == 0
    assert np.all(bare)
    assert np.isnan(result.path.dowson_higginson[0])
    assert result.path.blok_flash[0] == 0.0
    assert result.film.dowson_higginson_min is not None
    assert ("no_film", "modifications") in {(notice.code, notice.field) for notice in result.warnings}


def test_no_film_in_the_middle_of_a_hollow_flank_is_for_its_crowning() -> None:
    hollow = Modifications(lead_crowning=-400e-6)
    result = solve_scuffing(ScuffingInputs(with_torque(paper_pair(4, hollow), 1.0), lubrication="closed_form"))
    assert result.distribution.feature_line.line_load[25] == 0.0
    assert ("no_film", "modifications") in {(notice.code, notice.field) for notice in result.warnings}


@pytest.mark.parametrize("seed", range(6))
def test_modifications_are_not_blamed_where_none_was_given(seed: int) -> None:
    """Flanks as designed touch wherever they are loaded; without torque or speed it is that."""
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


def test_no_film_anywhere_is_for_want_of_torque() -> None:
    result = solve_scuffing(ScuffingInputs(with_torque(paper_pair(1), 0.0), lubrication="closed_form"))
    assert result.film.dowson_higginson_min is None
    assert ("no_film", "pinion_torque") in {(notice.code, notice.field) for notice in result.warnings}


@pytest.mark.parametrize("model", [LINEAR, Model()])
def test_without_torque_the_transmission_error_is_kinematic(model: Model) -> None:
    shape = Modifications(profile_crowning=10e-6, helix_slope=8e-6, end_relief=5e-6)
    result = solve_load_distribution(with_torque(paper_pair(3, shape, model), 0.0))
    assert "no_load" in codes(result)
    assert result.transmission_error.curves.error == pytest.approx(result.balance.unloaded_error, abs=0.0)
    assert result.load.max_line_load == 0.0
    assert result.load.max_at is None
    assert result.load.contact_fraction == 0.0
    assert result.load.face_load_factor is None
    assert result.stiffness.mean_mesh is None
    assert result.friction_loss.loss_factor is None
    assert result.friction_loss.power == 0.0
    assert result.feature_line.load_sharing is None
    assert not np.any(result.flank.line_load)


def test_the_kinematic_error_is_the_limit_of_a_small_torque() -> None:
    shape = Modifications(profile_crowning=10e-6, lead_crowning=10e-6, tip_relief=5e-6)
    none = solve_load_distribution(with_torque(paper_pair(3, shape, LINEAR), 0.0)).transmission_error
    little = solve_load_distribution(with_torque(paper_pair(3, shape, LINEAR), 1e-4)).transmission_error
    unloaded = np.interp(little.curves.roll_position, none.curves.roll_position, none.curves.error)
    assert little.curves.error == pytest.approx(unloaded, abs=0.02e-6)
    assert np.all(little.curves.error > unloaded - 0.002e-6)


def test_scuffing_without_torque_has_neither_flash_nor_film() -> None:
    inputs = with_torque(paper_pair(1), 0.0)
    result = solve_scuffing(ScuffingInputs(inputs, lubrication="closed_form"))
    assert result.flash.blok_max == 0.0
    assert result.flash.blok_at_psi is None
    assert result.film.dowson_higginson_min is None
    assert result.film.thickness_regime is None


def test_scuffing_at_rest_has_neither_flash_nor_film() -> None:
    inputs = replace(paper_pair(1), load=Load(PAPER_LOAD.pinion_torque, 0.0))
    result = solve_scuffing(ScuffingInputs(inputs, lubrication="closed_form"))
    assert result.flash.blok_max == 0.0
    assert result.film.dowson_higginson_min is None


def test_negative_transmission_error_is_legal() -> None:
    # Helix slope is centred: at little load one end meets ahead of the nominal position. Xue Eq. 10 never
    # converges here.
    tenth = PAPER_LOAD.pinion_torque / 10
    result = solve_load_distribution(with_torque(paper_pair(4, Modifications(helix_slope=40e-6)), tenth))
    assert result.transmission_error.min < 0
    assert result.load.balance_error < 1e-12


def test_extreme_loads_stay_within_the_half_space_limit() -> None:
    result = solve_load_distribution(with_torque(paper_pair(1, model=Model()), 2e5))
    assert "half_space" in codes(result)
    assert result.load.balance_error < 1e-10
    assert everything_finite(result)


def test_the_parabola_refuses_half_space_contact() -> None:
    with pytest.raises(InvalidInput) as caught:
        solve_load_distribution(paper_pair(1, model=Model(tooth_stiffness="parabola")))
    assert (caught.value.code, caught.value.field) == ("contact_law", "contact")


@pytest.mark.parametrize(
    ("gears", "code"),
    [
        (replace(paper_gears(1), pinion=GearTeeth(7, 0.3), wheel=GearTeeth(60)), "teeth_range"),
        (replace(paper_gears(1), pressure_angle=radians(14.0)), "pressure_angle_range"),
        (replace(paper_gears(1), helix_angle=radians(46.0)), "helix_angle_range"),
    ],
)
def test_ranges_of_the_model_are_warned_about(gears: GearPairInputs, code: str) -> None:
    assert code in codes(solve_gears(gears))


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
    result = solve_load_distribution(with_torque(paper_pair(1, Modifications(profile_slope=slope), Model()), 0.0))
    assert result.load.max_line_load == 0.0
    assert result.load.face_load_factor is None
    assert result.pressure.max == 0.0
