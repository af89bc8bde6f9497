"""Speeds at which the flow of Milian's gears becomes sonic (reference numbers of an independent calculation)."""

from math import pi

import pytest

from solvers.gears.inputs import GearPairInputs
from solvers.published.milian import CASE_1, CASE_2, PRINTED, SPEED_1, SPEED_2, TIP
from solvers.pumping import ChokingInputs, ChokingSpeeds, PumpingModel, PumpingSetup
from solvers.pumping.choking import choking_speeds


def search(gears: GearPairInputs, backlash: float, model: PumpingModel, limit: float = 60000) -> ChokingSpeeds:
    return choking_speeds(ChokingInputs(PumpingSetup(gears, backlash, model=model), limit * pi / 30))


@pytest.mark.parametrize(
    ("gears", "backlash", "radial", "axial"),
    [(CASE_1, 0.3e-3, 7016, 7386), (CASE_1, 0.1e-3, 5676, 5755), (CASE_2, 0.3e-3, 5787, 6243)],
)
def test_contact_gaps(gears: GearPairInputs, backlash: float, radial: float, axial: float) -> None:
    # converged numbers to 0.1 %: the largest pressure at 100 slices is as near its limit
    found = search(gears, backlash, PRINTED)
    assert found.radial_choking_speed is not None
    assert found.axial_choking_speed is not None
    assert found.radial_choking_speed * 30 / pi == pytest.approx(radial, rel=1e-3)
    assert found.axial_choking_speed * 30 / pi == pytest.approx(axial, rel=1.5e-3)
    assert found.warnings == ()


@pytest.mark.parametrize(("gears", "test_speed", "radial"), [(CASE_1, SPEED_1, 21800), (CASE_2, SPEED_2, 23600)])
def test_tip_gaps_choke_far_above_the_test_speeds(gears: GearPairInputs, test_speed: float, radial: float) -> None:
    # the reference is of first order, whose peaks are lower: it chokes a few per cent later
    found = search(gears, 0.0, TIP)
    assert found.radial_choking_speed is not None
    assert found.radial_choking_speed * 30 / pi == pytest.approx(radial, rel=0.035)
    assert found.radial_choking_speed * 30 / pi > 2 * test_speed


def test_beyond_the_search_limit() -> None:
    found = search(CASE_1, 0.3e-3, PRINTED, 7200)
    assert found.radial_choking_speed is not None
    assert found.axial_choking_speed is None
    assert [notice.code for notice in found.warnings] == ["beyond_search_limit"]
