"""Isothermal films agree with published regressions.

The regressions are by Nijenbanning, Venner and Moes, by Pan and Hamrock, and by Dowson and Higginson.
"""

from dataclasses import replace
from math import sqrt

import pytest

from benchmarks.published.xue import POINT_A
from solvers.contact import hertz
from solvers.contact.ehl import Contact, LineContactInputs, LineContactResult, Model
from solvers.contact.ehl.model import solve
from solvers.contact.ehl.problem import moes_central_film, moes_minimum_film
from solvers.lubricants import Lubricant, PressureViscosityLaw
from solvers.materials import Solid

MODULUS = hertz.reduced_modulus(Solid(), Solid())
RADIUS = 0.01
FINE = Model(thermal=False, rheology="newtonian", nodes=361)


def isothermal(line_load: float, viscosity: float, oil: Lubricant) -> LineContactResult:
    """Solve an isothermal contact of two surfaces that move at 1 m/s. `line_load` is in N/m, `viscosity` in Pa s."""
    contact = Contact(line_load, RADIUS, 1.0, 1.0)
    return solve(LineContactInputs(contact, lubricant=replace(oil, viscosity=viscosity), model=FINE))


def over_moes(m: float, l: float, law: PressureViscosityLaw, viscosity: float) -> tuple[float, float]:
    """Return the central and the minimum film of an incompressible oil, each divided by the regression of Moes."""
    # The speed parameter U is 1e-11.
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
    """Central and minimum film agree with the regression within 5 %, which is the accuracy of the regression."""
    # For Barus' law, the ratios of an independent calculation are 0.993 to 1.044. Roelands' law gives a lower viscosity
    # under pressure than Barus' law. This hardly matters where the film forms: with an oil of 0.2 Pa s, the films for
    # Roelands' law are also within 5 %.
    assert over_moes(m, l, law, viscosity) == pytest.approx((1.0, 1.0), rel=0.05)


def test_isoviscous_film_is_exact_to_a_percent() -> None:
    """At L = 0 and M = 2, the central film is 0.995 of the regression, and the minimum film is 1.022 of the regression.

    These ratios come from an independent calculation.
    """
    assert over_moes(2, 0, "roelands", THIN) == pytest.approx((0.995, 1.022), abs=0.01)


@pytest.mark.parametrize("w", [1.1e-5, 1e-4, 1e-3])
def test_compression_thins_the_centre_of_the_film(w: float) -> None:
    """Compression divides the central film by the relative density at the Hertzian pressure (0.3 to 2.9 GPa)."""
    # In an independent calculation, the product of film ratio and relative density is 0.98 to 1.05.
    line_load, viscosity = w * MODULUS * RADIUS, 0.02
    thick = isothermal(line_load, viscosity, Lubricant(compressible=False))
    thin = isothermal(line_load, viscosity, Lubricant())
    oil = Lubricant()
    compression = oil.density_at(thin.hertz.max_pressure, oil.reference_temperature) / oil.density
    assert 0.98 < compression * thin.film.central / thick.film.central < 1.05


def compressible(w: float, u: float, g: float) -> LineContactResult:
    """Solve an isothermal contact with W = w/(E' R), U = eta um/(E' R), G = alpha E' and a compressible oil."""
    return isothermal(w * MODULUS * RADIUS, u * MODULUS * RADIUS, Lubricant(pressure_viscosity=g / MODULUS))


def pan_hamrock(w: float, u: float, g: float) -> tuple[float, float, float]:
    """Return minimum and central film, both divided by R, and the spike divided by E' (Pan and Hamrock 1989)."""
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
    """At U = 1e-11 and G = 5007, the spike of an independent calculation is 0.94 to 1.04 of the regression."""
    # The test allows a further 2 %, because the nearest node does not lie exactly at the spike.
    pressure = compressible(w, 1e-11, 5007).pressure
    assert pressure.second_maximum / MODULUS / pan_hamrock(w, 1e-11, 5007)[2] == pytest.approx(0.99, abs=0.07)


def test_dowson_higginson_film_at_point_a() -> None:
    """With E' and the mean speed, the formula of Dowson and Higginson gives a film of 0.5045 um at point A."""
    result = solve(LineContactInputs(POINT_A, lubricant=Lubricant()))
    assert result.film.dowson_higginson == pytest.approx(0.5045e-6, rel=2e-4)
