"""Directions that measurements of pumping fix (Houjoh and others 2004; Diab, Ville, Velex 2006)."""

from dataclasses import replace
from math import log, pi

import numpy as np
import pytest

from solvers.gears.inputs import GearPairInputs
from solvers.published.milian import CASE_1, CASE_2, CHAIN, PRINTED, SPEED_1, SPEED_2, TABLE_1, pinion, run
from solvers.pumping import Ambient, PumpingInputs, PumpingModel, PumpingSetup
from solvers.pumping.model import solve


@pytest.mark.parametrize(("gears", "speed"), [(CASE_1, SPEED_1), (CASE_2, SPEED_2), (TABLE_1, 9000.0)])
def test_pressure_on_the_approach_side_suction_on_the_recess_side(gears: GearPairInputs, speed: float) -> None:
    result = pinion(run(gears, speed))
    lag = np.tan(gears.helix_angle) / (gears.pinion.teeth * gears.normal_module / np.cos(gears.helix_angle) / 2)
    field = result.field
    for column, position in zip(field.pressure_ratio.T[10:-10:10], field.position[10:-10:10], strict=True):
        phase = field.angle - lag * position
        approach, recess = column[(phase > result.stroke.start) & (phase < 0)], column[(phase > 0.02) & (column != 1)]
        assert approach.max() > 1.2
        assert recess.min() < 0.9
        assert approach.mean() > 1 > recess.mean()
        assert phase[np.argmax(column)] < phase[np.argmin(column)]


@pytest.mark.parametrize(("gears", "speed"), [(CASE_1, SPEED_1), (CASE_2, SPEED_2)])
def test_the_medium_is_driven_from_the_end_that_meshes_first_to_the_other(gears: GearPairInputs, speed: float) -> None:
    result = pinion(run(gears, speed))
    peaks = result.field.angle[np.argmax(result.field.pressure_ratio, axis=0)]
    assert np.all(np.diff(peaks[5:-5]) >= 0)
    assert np.argmax(result.profile.peak_pressure_ratio) > 50
    assert result.hottest_position is not None
    assert result.hottest_position > 0.1


def test_closing_the_openings_raises_pumping() -> None:
    powers = [
        pinion(run(TABLE_1, 3000, replace(CHAIN, discharge_coefficient=share))).pumping_power
        for share in (1.0, 0.8, 0.6)
    ]
    assert powers[0] < powers[1] < powers[2]


def test_loss_grows_more_slowly_than_the_cube_once_choked() -> None:
    speeds = [1000.0, 2000.0, 8000.0, 16000.0, 32000.0]
    powers = [pinion(run(CASE_1, speed)).pumping_power for speed in speeds]
    exponents = np.diff(np.log(powers)) / np.diff(np.log(speeds))
    assert exponents[0] == pytest.approx(3, abs=0.05)
    assert exponents[-2] < 2.5
    assert exponents[-1] < exponents[-2]


def test_loss_is_proportional_to_the_density_while_unchoked() -> None:
    def power(**ambient: float) -> float:
        setup = PumpingSetup(CASE_1, ambient=Ambient(**ambient), model=PRINTED)
        return pinion(solve(PumpingInputs(setup, 1000 * pi / 30))).pumping_power

    usual = power()
    assert power(pressure=3 * 101325.0) / usual == pytest.approx(3, rel=1e-9)  # at one sound speed: exactly
    heavier = log(power(molar_mass=1.5 * 0.0289647) / usual) / log(1.5)
    assert heavier == pytest.approx(1, abs=0.03)


def test_default_model_keeps_all_directions() -> None:
    plain, slow = run(CASE_1, SPEED_1, PumpingModel()), run(CASE_1, 1000, PumpingModel())
    assert plain.total.pumping_power > 500 * slow.total.pumping_power
    for spaces in (plain.pinion_spaces, plain.wheel_spaces):
        assert spaces is not None
        assert spaces.hottest_position is not None
        assert 0.7 < spaces.hottest_position / 0.2 < 0.9
        assert spaces.profile.temperature_rise is not None
        assert spaces.profile.temperature_rise[-1] > 2 * spaces.profile.temperature_rise[0]
        assert spaces.radial_choked
