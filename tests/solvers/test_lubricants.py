"""The viscosity and the density of an oil follow the laws of Xue's paper."""

from math import exp, log

import pytest
from hypothesis import strategies as st

from solvers.lubricants import Lubricant
from tests.support.properties import examples

PAPER = Lubricant()


def test_constants_of_the_paper() -> None:
    """The constants of Xue Eq. 20 are A1 = 7.144, Z = 0.6011 and S0 = 1.305."""
    # The formula as printed, S0 = beta/(A1 (t0 - 138)), would give S0 = 2.6e-5.
    laws = PAPER.laws
    assert laws.a1 == pytest.approx(7.144, abs=5e-4)
    assert laws.pressure_exponent == pytest.approx(0.6011, abs=5e-5)
    assert laws.temperature_exponent == pytest.approx(1.305, abs=5e-4)


@pytest.mark.parametrize("law", ["roelands", "barus"])
def test_coefficients_are_the_logarithmic_slopes_at_reference(law: str) -> None:
    oil = Lubricant(pressure_viscosity_law="roelands" if law == "roelands" else "barus")
    by_pressure = log(oil.viscosity_at(1e4, 360.0) / oil.viscosity_at(0.0, 360.0)) / 1e4
    by_temperature = log(oil.viscosity_at(0.0, 360.01) / oil.viscosity_at(0.0, 359.99)) / 0.02
    assert by_pressure == pytest.approx(21.9e-9, rel=1e-4)
    assert by_temperature == pytest.approx(-0.042, rel=1e-6)


def test_viscosity_at_the_heart_of_the_contact() -> None:
    """At 1.5 GPa and 360 K, the viscosity of the paper's oil is 1.4e7 Pa s."""
    assert PAPER.viscosity_at(1.5e9, 360.0) == pytest.approx(1.4e7, rel=0.15)


def test_density() -> None:
    """The density follows the formula of Dowson and Higginson (Xue Eq. 19)."""
    # At 1 GPa it rises by the factor 1 + 0.6/(1 + 1.7). It falls by the fraction 0.00065 per kelvin.
    assert PAPER.density_at(1e9, 360.0) == pytest.approx(870.0 * (1 + 0.6 / 2.7), rel=1e-12)
    assert PAPER.density_at(0.0, 460.0) == pytest.approx(870.0 * (1 - 0.065), rel=1e-12)
    assert Lubricant(compressible=False).density_at(1e9, 460.0) == 870.0


@examples(100, 1000, st.floats(0.0, 3e9), st.floats(300.0, 500.0))
def test_viscosity_grows_with_pressure_and_falls_with_temperature(pressure: float, temperature: float) -> None:
    here = PAPER.viscosity_at(pressure, temperature)
    assert PAPER.viscosity_at(pressure + 1e7, temperature) > here
    assert PAPER.viscosity_at(pressure, temperature + 1.0) < here
    assert here >= exp(-9.67)
