"""Directions that measurements of thermal contacts fix."""

from functools import cache

import numpy as np
import pytest

from solvers.contact.ehl import Contact, LineContactInputs, LineContactResult, Model
from solvers.contact.ehl.model import solve

RATIOS = (0.0, 0.02, 0.05, 0.1, 0.3, 0.6, 1.0, 1.5)


@cache
def at(ratio: float, thermal: bool = True) -> LineContactResult:
    """R 6.5 mm, 350 N/mm, 2.4 m/s; surface 1 is the faster one for a positive slide-roll ratio."""
    speeds = 2.4 * (1 + ratio / 2), 2.4 * (1 - ratio / 2)
    return solve(LineContactInputs(Contact(3.5e5, 6.5e-3, *speeds), model=Model(thermal=thermal)))


@pytest.mark.parametrize("ratio", [0.6, 1.0, 1.5])
def test_hot_shear_band_lies_nearer_the_slower_surface(ratio: float) -> None:
    """The faster surface carries its heat away."""
    field = at(ratio).field
    assert field is not None
    column = field.temperature[int(field.temperature.max(axis=1).argmax())]
    assert field.film_fraction[int(column.argmax())] >= 0.5  # surface 2, at 1, is the slower one
    slower, faster = column[11:], column[:10]
    assert np.all(slower > faster[::-1])


def test_thermal_film_is_thinner_than_the_isothermal_one_the_more_so_with_sliding() -> None:
    shares = []
    for ratio in RATIOS:
        thermal, isothermal = at(ratio).film.minimum, at(ratio, thermal=False).film.minimum
        assert thermal is not None
        assert isothermal is not None
        shares.append(thermal / isothermal)
    assert max(shares) < 1.0
    assert np.all(np.diff(shares[2:]) < 0.0)


def test_traction_rises_peaks_and_falls_with_the_slide_roll_ratio() -> None:
    coefficients = [r.friction.coefficient for ratio in RATIOS if (r := at(ratio)).friction]
    assert len(coefficients) == len(RATIOS)
    peak = int(np.argmax(coefficients))
    assert 0 < peak < len(RATIOS) - 1
    assert np.all(np.diff(coefficients[: peak + 1]) > 0.0)
    assert np.all(np.diff(coefficients[peak:]) < 0.0)


def test_at_zero_slip_only_inlet_heating_remains() -> None:
    """No sliding power, no traction; the oil squeezed back in the inlet still shears and heats."""
    result = at(0.0)
    assert result.friction is not None
    assert result.heat is not None
    assert result.temperature is not None
    assert result.friction.power == 0.0
    assert result.friction.coefficient < 1e-6
    assert 0.0 < result.heat.generated < 0.1 * (at(0.3).heat or result.heat).generated
    assert result.temperature.surface_1_flash < 5.0
