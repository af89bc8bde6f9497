"""The scuffing safety in a drive train is that of the pair alone, or missing if unsolved points may change it."""

from dataclasses import replace

import numpy as np
import pytest

from solvers.contact import ehl
from solvers.drive_train.gap.thermal_lead import no_heat
from solvers.drive_train.safety import FaceBulk, FlankHeat, flank_heat
from solvers.lubricants import Lubricant
from solvers.scuffing.inputs import Load, LoadDistributionInputs, ScuffingInputs, Temperatures, angular_speed
from solvers.scuffing.model import solve
from solvers.scuffing.safety import solve_scuffing
from solvers.scuffing.thermal.flank import map_flash
from tests.support.drive_trains import turbo_gear
from tests.support.gear_pairs import UNDERCUT_PAIR
from tests.support.modified_pairs import relieved_pair

COARSE = ehl.Model(nodes=61, film_nodes=11, refine_mesh=False)


def heat_of(inputs: ScuffingInputs) -> FlankHeat:
    """Return the temperatures and safety factors of a pair in a drive train with rigid shafts and no thermal lead."""
    thermal = no_heat(np.linspace(0.0, inputs.distribution.gears.face_width, 11))
    distribution = solve(inputs.distribution)
    flash = map_flash(inputs.distribution, distribution)
    unit = replace(turbo_gear(), mesh=inputs)
    return flank_heat(unit, distribution, flash, FaceBulk(unit, thermal), inputs.temperatures.scuffing_test)


def test_a_point_too_light_to_matter_keeps_the_verdict() -> None:
    """Some points carry almost no load and stay unsolved."""
    # Bounds show that these points are not hotter than the hottest solved point.
    inputs = replace(relieved_pair(200), film=COARSE)
    alone, heat = solve_scuffing(inputs), heat_of(inputs)
    assert heat.unsolved_points > 0
    assert heat.safety.thermal_ehl_profile == pytest.approx(alone.safety.thermal_ehl_factor, rel=1e-9)
    assert heat.safety.thermal_ehl_feature is not None


def test_points_that_may_decide_take_it() -> None:
    """At a viscosity of 80 Pa s, unsolved points may be the hottest. No safety factor by thermal EHL is then stated."""
    inputs = relieved_pair(8)
    inputs = replace(inputs, lubricant=replace(inputs.lubricant, viscosity=80.0), film=COARSE)
    heat = heat_of(inputs)
    assert heat.unsolved_points > 0
    assert (heat.safety.thermal_ehl_feature, heat.safety.thermal_ehl_profile) == (None, None)
    assert heat.safety.blok_flank is not None


def test_the_standard_of_a_unit_is_that_of_the_pair() -> None:
    """With rigid shafts both have the same face load factor; relieved flanks have no flash method, and it is said."""
    inputs = replace(relieved_pair(200), lubrication="closed_form")
    alone, heat = solve_scuffing(inputs), heat_of(inputs)
    assert alone.safety is not None
    assert heat.safety is not None
    assert heat.safety.standard == alone.safety.standard
    assert heat.safety.standard is not None
    assert [notice.code for notice in heat.warnings] == ["no_standard_flash"]


@pytest.mark.parametrize("lubrication", ["closed_form", "thermal_ehl"])
def test_a_load_that_reaches_a_base_circle_leaves_no_safety(lubrication: str) -> None:
    distribution = LoadDistributionInputs(UNDERCUT_PAIR, Load(50.0, angular_speed(1000.0)))
    inputs = replace(
        ScuffingInputs(
            distribution,
            temperatures=Temperatures(scuffing=573.15, bulk=360.0, bulk_method="given"),
            path_points=8,
            lubricant=Lubricant(),
            friction="given",
        ),
        lubrication=lubrication,
    )
    heat = heat_of(inputs)
    assert (heat.flash.feature, heat.flash.flank, heat.flash.flank_at) == (None, None, None)
    assert (heat.safety.blok_feature, heat.safety.blok_flank, heat.safety.minimum) == (None, None, None)
    assert heat.safety.thermal_ehl_feature is None
