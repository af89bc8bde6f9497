"""Choking is decided by refinement: outflow and inflow, with bands that contain what the finest grid gives."""

from functools import cache
from math import pi, radians

import numpy as np
import pytest

from solvers.gears.inputs import GROUND_FILLET, GearPairInputs, GearTeeth
from solvers.pumping import (
    ChokingInputs,
    PumpingInputs,
    PumpingModel,
    PumpingResult,
    PumpingSetup,
    Spaces,
    choking_speeds,
    solve,
)
from solvers.pumping.inputs import MOST_SLICES
from solvers.pumping.model import solve_on_slices
from solvers.pumping.spaces import finest_slices, flow_at, prepare
from solvers.pumping.verdict import Band, Bands, bands, decide, on_grids
from tests.support.answers import differences
from tests.support.pumping_cases import random_gears

RPM = pi / 30


@cache
def solved(slices: int) -> PumpingResult:
    return solve(wide_pair(12000.0, slices))


def wide_pair(speed: float, slices: int) -> PumpingInputs:
    """Return a pair of 32 and 96 teeth with a face of 220 mm, which draws in its air faster than it pushes it out."""
    gears = GearPairInputs(
        GearTeeth(32), GearTeeth(96), 5e-3, 0.22, helix_angle=radians(25.0), rack_tip_radius=GROUND_FILLET
    )
    return PumpingInputs(PumpingSetup(gears, model=PumpingModel(slices=slices, spaces=Spaces.PINION)), speed * RPM)


def test_the_inflow_chokes_long_before_the_outflow() -> None:
    """At 12,000 1/min the air draws in at its critical velocity, but the answer said "choking: no" and "Ma 1.01"."""
    found = solved(100)
    choking, pinion = found.choking, found.pinion_spaces
    assert (choking.outflow, choking.inflow, choking.clearances) == ("not choked", "choked", "not choked")
    assert choking.slices > 100
    assert found.slices == 100, "the numbers of the answer stay those of the request"
    assert pinion is not None
    assert not pinion.axial_choked
    assert max(pinion.front_end.outflow_mach, pinion.rear_end.outflow_mach) < 0.5
    fine = solved(MOST_SLICES).pinion_spaces
    assert fine is not None
    assert fine.inflow_choked is (fine.front_end.inflow_choked or fine.rear_end.inflow_choked) is True


def test_only_the_verdict_needs_finer_grids() -> None:
    plain = solve_on_slices(wide_pair(12000.0, 100))
    assert plain.choking.slices == 100
    assert not differences(solved(100), plain, tolerance=0.0, without=r"^choking\.")


def test_the_verdict_does_not_depend_on_the_slices_of_the_request() -> None:
    words = {
        (found.choking.outflow, found.choking.inflow, found.choking.clearances)
        for found in (solved(slices) for slices in (100, MOST_SLICES))
    }
    assert len(words) == 1


def test_no_advice_to_use_more_than_is_allowed() -> None:
    texts = {slices: " ".join(notice.message for notice in solved(slices).warnings) for slices in (100, MOST_SLICES)}
    assert "use more slices" in texts[100]
    assert "use more slices" not in texts[MOST_SLICES]


@pytest.mark.parametrize(
    ("value", "share", "word"), [(0.9, 0.12, "doubtful"), (0.9, 0.1, "not choked"), (1.2, 0.1, "choked")]
)
def test_a_band_is_doubtful_exactly_if_it_contains_one(value: float, share: float, word: str) -> None:
    assert Band(value, share).word == word


def test_the_slices_are_doubled_up_to_the_largest_number() -> None:
    asked: list[int] = []

    def refined(_: int, slices: int) -> Bands:
        asked.append(slices)
        return unsure

    unsure = Bands(Band(0.98, 0.1), Band(0.1, 0.0), Band(0.1, 0.0))
    found = decide([unsure], 100, 700, refined)
    assert asked == [200, 400, 700]
    assert (found.outflow, found.slices) == ("doubtful", 700)
    assert decide([unsure], 100, 700).slices == 100


def test_the_search_finds_the_speed_of_the_inflow() -> None:
    setup = wide_pair(1.0, 50).setup
    found = choking_speeds(ChokingInputs(setup, search_limit=30000.0 * RPM))
    assert found.inflow_choking_speed is not None
    assert found.axial_choking_speed is not None
    assert found.inflow_choking_speed < found.axial_choking_speed
    for share, choked in ((0.99, False), (1.01, True)):
        spaces = solve(PumpingInputs(setup, share * found.inflow_choking_speed))
        assert spaces.pinion_spaces is not None
        assert spaces.pinion_spaces.inflow_choked is choked


@pytest.mark.parametrize("pairs", [pytest.param(10, marks=pytest.mark.ci), pytest.param(50, marks=pytest.mark.slow)])
def test_the_finest_grid_lies_in_the_band_and_the_band_is_narrow(pairs: int) -> None:
    """The bands of both Mach numbers with 100 slices, against the values of the finest grid that the speed allows."""
    stated, true = [], []
    for seed in range(pairs):
        random = np.random.default_rng([38, seed])
        gears = random_gears(random)
        speed = random.uniform(60.0, 200.0) / (gears.pinion.teeth * gears.normal_module / 2)
        mesh = prepare(PumpingSetup(gears))
        most = finest_slices(mesh, speed, 100)
        for space in mesh.spaces:
            coarse = bands(mesh.gas, space.table, on_grids(mesh, space, speed, 100))
            fine = flow_at(mesh, space, speed, most)
            for band, value in ((coarse.outflow, fine.exit_demand), (coarse.inflow, fine.inflow_demand)):
                stated.append(band.uncertainty)
                true.append(abs(value / band.value - 1.0))
    assert np.mean(np.array(true) <= stated) >= 0.95
    assert sum(stated) <= 3.0 * sum(true)
