"""Formulas for the film thickness of a lubricated line contact, and for the ratio of film thickness to roughness."""

from math import hypot
from typing import Literal, TypeVar, cast

from solvers.arrays import FloatArray

Real = TypeVar("Real", float, FloatArray)

Regime = Literal["boundary", "mixed", "full_film"]


def dowson_higginson_minimum(
    *, viscosity: float, pressure_viscosity: float, mean_speed: Real, radius: Real, line_load: Real, modulus: float
) -> Real:
    """Minimum film 2.65 alpha^0.54 (eta_0 u)^0.7 R^0.43/(E'^0.03 w^0.13) (Dowson and Higginson) [m] (Eq. 27)."""
    entrainment = (viscosity * mean_speed) ** 0.7 * radius**0.43
    return cast("Real", 2.65 * pressure_viscosity**0.54 * entrainment / (modulus**0.03 * line_load**0.13))


def thickness_ratio(film: Real, roughness_1: float, roughness_2: float) -> Real:
    """Film thickness over roughness, chi = h/sqrt(Ra_1^2 + Ra_2^2) [-] (Eq. 28)."""
    return film / hypot(roughness_1, roughness_2)


def thickness_regime(ratio: float, boundary_below: float = 1.0, full_film_above: float = 4.0) -> Regime:
    """Regime of lubrication by the ratio of film to roughness; scuffing is probable under boundary lubrication.

    Limits of Xue, Zhang and Wang 2020; many other texts begin the full film at 3.
    """
    if ratio < boundary_below:
        return "boundary"
    return "full_film" if ratio > full_film_above else "mixed"
