"""Isothermal films against published regressions: Nijenbanning, Venner and Moes; Pan and Hamrock; Dowson-Higginson."""

from math import sqrt

import pytest

from solvers.contact import hertz
from solvers.contact.ehl import Contact, LineContactInputs, LineContactResult, Model, solve
from solvers.contact.ehl.dimensionless import moes_central_film, moes_minimum_film
from solvers.lubricants import Lubricant
from solvers.materials import Solid

MODULUS = hertz.reduced_modulus(Solid(), Solid())
RADIUS = 0.01
FINE = Model(thermal=False, rheology="newtonian", nodes=361)


def isothermal(line_load: float, viscosity: float, oil: Lubricant) -> LineContactResult:
    """Both surfaces at 1 m/s; `viscosity` [Pa s]."""
    oil = Lubricant(
        viscosity=viscosity,
        pressure_viscosity=oil.pressure_viscosity,
        pressure_viscosity_law=oil.pressure_viscosity_law,
        compressible=oil.compressible,
    )
    return solve(LineContactInputs(Contact(line_load, RADIUS, 1.0, 1.0), lubricant=oil, model=FINE))


MOES = [(2, 0), (5, 0), (20, 0), (200, 0), (5, 5), (20, 5), (200, 5), (2, 14), (20, 14), (200, 14)]


@pytest.mark.parametrize(("m", "l"), MOES)
def test_incompressible_barus_film_against_moes(m: float, l: float) -> None:
    """Central and minimum film within 5 %, the accuracy of the regression; reference ratios 0.993 to 1.044."""
    speed_parameter = 1e-11
    oil = Lubricant(
        pressure_viscosity=l / (MODULUS * speed_parameter**0.25), pressure_viscosity_law="barus", compressible=False
    )
    viscosity = speed_parameter * MODULUS * RADIUS / 2.0
    film = isothermal(m * sqrt(speed_parameter) * MODULUS * RADIUS, viscosity, oil).film
    assert film.central is not None
    assert film.minimum is not None
    unit = RADIUS * sqrt(speed_parameter)
    assert film.central / unit == pytest.approx(moes_central_film(m, l), rel=0.05)
    assert film.minimum / unit == pytest.approx(moes_minimum_film(m, l), rel=0.05)


def test_isoviscous_film_is_exact_to_a_percent() -> None:
    """L = 0, M = 2: reference 0.995 and 1.022 of the regression."""
    speed_parameter = 1e-11
    oil = Lubricant(pressure_viscosity=0.0, compressible=False)
    film = isothermal(2 * sqrt(speed_parameter) * MODULUS * RADIUS, speed_parameter * MODULUS * RADIUS / 2, oil).film
    unit = RADIUS * sqrt(speed_parameter)
    assert (film.central or 0.0) / unit / moes_central_film(2, 0) == pytest.approx(0.995, abs=0.01)
    assert (film.minimum or 0.0) / unit / moes_minimum_film(2, 0) == pytest.approx(1.022, abs=0.01)


@pytest.mark.parametrize("w", [1.1e-5, 1e-4, 1e-3])
def test_compression_thins_the_centre_of_the_film(w: float) -> None:
    """By the density at the Hertz pressure, 0.3 to 2.9 GPa; reference 0.98-1.05 of it."""
    line_load, viscosity = w * MODULUS * RADIUS, 0.02
    thick = isothermal(line_load, viscosity, Lubricant(compressible=False))
    thin = isothermal(line_load, viscosity, Lubricant())
    assert thin.film.central is not None
    assert thick.film.central is not None
    oil = Lubricant()
    compression = oil.density_at(thin.hertz.maximum_pressure, oil.reference_temperature) / oil.density
    assert 0.98 < compression * thin.film.central / thick.film.central < 1.05


@pytest.mark.parametrize("w", [2e-5, 1e-4])
@pytest.mark.parametrize("u", [1e-12, 1e-11])
def test_compressible_film_against_pan_and_hamrock(w: float, u: float) -> None:
    """G = 5007. Reference ratios: h_min 1.01-1.09, h_c 1.04-1.13; Dowson and Higginson's h_min 0.96-1.01."""
    g = 5007
    oil = Lubricant(pressure_viscosity=g / MODULUS)
    film = isothermal(w * MODULUS * RADIUS, u * MODULUS * RADIUS, oil).film
    assert film.central is not None
    assert film.minimum is not None
    assert film.minimum / RADIUS / (1.714 * w**-0.128 * u**0.694 * g**0.568) == pytest.approx(1.05, abs=0.04)
    assert film.central / RADIUS / (2.922 * w**-0.166 * u**0.692 * g**0.470) == pytest.approx(1.085, abs=0.045)
    assert film.minimum / film.dowson_higginson == pytest.approx(0.985, abs=0.03)


def test_dowson_higginson_film_at_point_a() -> None:
    """0.5045 um with E' and the mean speed."""
    result = solve(LineContactInputs(Contact(2.73e5, 4.015e-3, 1.0179, 3.7076)))
    assert result.film.dowson_higginson == pytest.approx(0.5045e-6, rel=2e-4)
