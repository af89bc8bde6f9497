"""All models share one verdict on a gear pair: whether the pair is refused, and what the notices say."""

from dataclasses import replace
from math import radians

import pytest

from benchmarks.published.xue import paper_gears
from solvers.gears.gear import rack_tip_radius
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.gears.notices import pair_notices
from solvers.gears.pair import gear_pair, meshing_path
from tests.support.gear_pairs import FZG_A, INCH_PAIR, UNDERCUT_PAIR
from tests.support.outcomes import refused


@pytest.mark.parametrize("printed", [FZG_A, INCH_PAIR])
def test_printed_centre_distances_are_backlash_free(printed: GearPairInputs) -> None:
    exact = gear_pair(replace(printed, centre_distance=None))
    pair = gear_pair(printed)
    assert printed.centre_distance < exact.centre_distance
    assert pair == replace(exact, inputs=printed)


def test_printed_centre_distances_are_tolerated_to_a_ten_thousandth_below_and_used_as_given_above() -> None:
    exact = gear_pair(paper_gears(1)).centre_distance
    assert gear_pair(replace(paper_gears(1), centre_distance=exact * (1 - 0.99e-4))).centre_distance == exact
    below = replace(paper_gears(1), centre_distance=exact * (1 - 1.01e-4))
    assert refused(meshing_path, below) == ("flank_interference", "centre_distance")
    apart = exact * (1 + 1e-6)
    assert gear_pair(replace(paper_gears(1), centre_distance=apart)).centre_distance == apart


def test_a_rack_without_room_for_its_tip_radius_cuts_with_the_full_one() -> None:
    steep = replace(paper_gears(1), pressure_angle=radians(25))
    assert rack_tip_radius(steep, steep.pinion) == pytest.approx(0.31788, abs=5e-6)
    notices = [notice for notice in pair_notices(meshing_path(steep)) if notice.code == "rack_tip_radius"]
    assert len(notices) == 2
    assert all("0.318" in notice.message for notice in notices)


def test_an_undercut_path_starts_at_the_base_circle() -> None:
    path = meshing_path(UNDERCUT_PAIR)
    assert path.start == 0.0
    assert path.shortened_by == ("pinion",)
    assert {notice.code for notice in pair_notices(path)} == {"undercut", "path_shortened"}


def test_fillets_below_the_mates_tip_shorten_the_path_at_either_end() -> None:
    # The wheel's tip reaches 1.4 modules deep, the straight flank of the pinion's rack 1.21.
    deep, tall = GearTeeth(30, dedendum=1.45), GearTeeth(100, addendum=1.4)
    at_start = meshing_path(GearPairInputs(deep, tall, 3e-3, 20e-3, rack_tip_radius=0.36))
    at_end = meshing_path(GearPairInputs(tall, deep, 3e-3, 20e-3, rack_tip_radius=0.36))
    assert at_start.shortened_by == ("pinion",)
    assert at_end.shortened_by == ("wheel",)
    assert at_start.start == pytest.approx(at_start.pair.pinion.form_roll_length, rel=1e-14)
    assert at_start.start > at_start.pair.line_of_action - at_start.pair.wheel.tip_roll_length
    assert at_end.length == pytest.approx(at_start.length, rel=1e-12)
    assert at_end.start + at_start.end == pytest.approx(at_start.pair.line_of_action, rel=1e-12)
    assert pair_notices(at_end)[-1].field == "wheel.dedendum"


def test_flanks_of_which_the_fillets_leave_nothing_are_refused() -> None:
    pinion, wheel = GearTeeth(47, -1.428, 0.2214, 1.16), GearTeeth(35, -0.166, 0.4276, 0.8673)
    gears = GearPairInputs(pinion, wheel, 3e-3, 20e-3, rack_tip_radius=0.5073)
    assert refused(meshing_path, gears)[0] == "involute_interference"


def test_a_fillet_that_reaches_the_gears_own_tip_is_refused() -> None:
    pinion, wheel = GearTeeth(60, -1.0, -0.5, 1.25), GearTeeth(20, 1.0)
    gears = GearPairInputs(pinion, wheel, 3e-3, 20e-3, rack_tip_radius=0.3)
    assert refused(meshing_path, gears) == ("form_diameter", "pinion.profile_shift")
