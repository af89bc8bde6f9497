"""Isothermal films against published regressions: Nijenbanning, Venner and Moes; Pan and Hamrock; Dowson-Higginson."""

from dataclasses import replace
from math import sqrt

import pytest

from solvers.contact import hertz
from solvers.contact.ehl import Contact, LineContactInputs, LineContactResult, Model
from solvers.contact.ehl.model import solve
from solvers.contact.ehl.problem import moes_central_film, moes_minimum_film
from solvers.lubricants import Lubricant, PressureViscosityLaw
from solvers.materials import Solid
from solvers.published.xue import POINT_A

MODULUS = hertz.reduced_modulus(Solid(), Solid())
RADIUS = 0.01
FINE = Model(thermal=False, rheology="newtonian", nodes=361)


def isothermal(line_load: float, viscosity: float, oil: Lubricant) -> LineContactResult:
    """Both surfaces at 1 m/s; `viscosity` [Pa s]."""
    contact = Contact(line_load, RADIUS, 1.0, 1.0)
    return solve(LineContactInputs(contact, lubricant=replace(oil, viscosity=viscosity), model=FINE))


def over_moes(m: float, l: float, law: PressureViscosityLaw, viscosity: float) -> tuple[float, float]:
    """Central and minimum film of an incompressible oil over the regressions of Moes; U = 1e-11."""
    speed_parameter = 1e-11
    alpha = l / (MODULUS * speed_parameter**0.25)
    oil = Lubricant(viscosity, pressure_viscosity=alpha, pressure_viscosity_law=law, compressible=False)
    speed = speed_parameter * MODULUS * RADIUS / (2.0 * viscosity)
    contact = Contact(m * sqrt(speed_parameter) * MODULUS * RADIUS, RADIUS, speed, speed)
    film = solve(LineContactInputs(contact, lubricant=oil, model=FINE)).film
    unit = RADIUS * sqrt(speed_parameter)
    return film.central / unit / moes_central_film(m, l), film.minimum / unit / moes_minimum_film(m, l)


THIN = 0.5e-11 * MODULUS * RADIUS  # Pa s: 1 m/s
BARUS = [(2, 0), (5, 0), (20, 0), (200, 0), (5, 5), (20, 5), (200, 5), (2, 14), (20, 14), (200, 14)]
ROELANDS = [(2, 0), (2, 14), (20, 14), (200, 14)]


@pytest.mark.parametrize(
    ("m", "l", "law", "viscosity"),
    [*((*each, "barus", THIN) for each in BARUS), *((*each, "roelands", 0.2) for each in ROELANDS)],
)
def test_incompressible_film_against_moes(m: float, l: float, law: PressureViscosityLaw, viscosity: float) -> None:
    """Central and minimum film within 5 %, the accuracy of the regression; reference ratios 0.993 to 1.044.

    Roelands' law grows less under pressure, but decides little where the film forms: 5 % for an oil of 0.2 Pa s.
    """
    assert over_moes(m, l, law, viscosity) == pytest.approx((1.0, 1.0), rel=0.05)


def test_isoviscous_film_is_exact_to_a_percent() -> None:
    """L = 0, M = 2: reference 0.995 and 1.022 of the regression."""
    assert over_moes(2, 0, "roelands", THIN) == pytest.approx((0.995, 1.022), abs=0.01)


@pytest.mark.parametrize("w", [1.1e-5, 1e-4, 1e-3])
def test_compression_thins_the_centre_of_the_film(w: float) -> None:
    """By the density at the Hertzian pressure, 0.3 to 2.9 GPa; reference 0.98-1.05 of it."""
    line_load, viscosity = w * MODULUS * RADIUS, 0.02
    thick = isothermal(line_load, viscosity, Lubricant(compressible=False))
    thin = isothermal(line_load, viscosity, Lubricant())
    oil = Lubricant()
    compression = oil.density_at(thin.hertz.max_pressure, oil.reference_temperature) / oil.density
    assert 0.98 < compression * thin.film.central / thick.film.central < 1.05


def compressible(w: float, u: float, g: float) -> LineContactResult:
    """W = w/(E' R), U = eta um/(E' R), G = alpha E'."""
    return isothermal(w * MODULUS * RADIUS, u * MODULUS * RADIUS, Lubricant(pressure_viscosity=g / MODULUS))


def pan_hamrock(w: float, u: float, g: float) -> tuple[float, float, float]:
    """Minimum and central film over R, spike over E' (Pan and Hamrock 1989)."""
    return (
        1.714 * w**-0.128 * u**0.694 * g**0.568,
        2.922 * w**-0.166 * u**0.692 * g**0.470,
        0.648 * w**0.185 * u**0.275 * g**0.391,
    )


# W, U, G and the ratios to Pan and Hamrock's minimum and central film and to Dowson and Higginson's, with tolerances.
# G = 7511 lies outside Pan and Hamrock's fit, by 12 and 20 %; at G = 2504 only the last is a reference.
INSIDE = ((1.05, 0.04), (1.085, 0.045), (0.985, 0.03))
RATIOS = [
    *((w, u, 5007, *INSIDE) for w in (2e-5, 1e-4) for u in (1e-12, 1e-11)),
    (1e-4, 1e-11, 7511, (1.12, 0.015), (1.20, 0.015), (1.07, 0.01)),
    (1e-4, 1e-11, 2504, None, None, (0.91, 0.01)),
]
Ratio = tuple[float, float]


@pytest.mark.parametrize(("w", "u", "g", "minimum", "central", "dowson"), RATIOS)
def test_compressible_film_against_pan_and_hamrock(
    w: float, u: float, g: float, minimum: Ratio | None, central: Ratio | None, dowson: Ratio
) -> None:
    film, formula = compressible(w, u, g).film, pan_hamrock(w, u, g)
    assert film.minimum / film.dowson_higginson == pytest.approx(dowson[0], abs=dowson[1])
    if minimum is not None and central is not None:
        assert film.minimum / RADIUS / formula[0] == pytest.approx(minimum[0], abs=minimum[1])
        assert film.central / RADIUS / formula[1] == pytest.approx(central[0], abs=central[1])


@pytest.mark.parametrize("w", [2e-5, 1e-4, 5e-4])
def test_spike_against_pan_and_hamrock(w: float) -> None:
    """U = 1e-11, G = 5007: 0.94-1.04, and 2 % for the node that is nearest to it."""
    pressure = compressible(w, 1e-11, 5007).pressure
    assert pressure.second_maximum / MODULUS / pan_hamrock(w, 1e-11, 5007)[2] == pytest.approx(0.99, abs=0.07)


def test_dowson_higginson_film_at_point_a() -> None:
    """0.5045 um with E' and the mean speed."""
    result = solve(LineContactInputs(POINT_A, lubricant=Lubricant()))
    assert result.film.dowson_higginson == pytest.approx(0.5045e-6, rel=2e-4)
