"""Film thickness of a lubricated line contact by formula, and its ratio to the roughness."""

from math import hypot
from typing import Literal, TypeVar, cast

from solvers.arrays import FloatArray

Real = TypeVar("Real", float, FloatArray)

Regime = Literal["boundary", "mixed", "full_film"]


def dowson_higginson_minimum(
    *, viscosity: float, pressure_viscosity: float, mean_speed: Real, radius: Real, line_load: Real, modulus: float
) -> Real:
    """Minimum film h = 2.65 alpha^0.54 (eta0 u)^0.7 R^0.43 / (E'^0.03 w^0.13) [m] (Eq. 27; Dowson and Higginson 1966).

    viscosity [Pa s] and pressure_viscosity [1/Pa] of the oil at the inlet, mean_speed (u1 + u2)/2 [m/s], reduced radius
    [m], line_load > 0 [N/m], modulus E' [Pa] of `hertz.reduced_modulus`.
    """
    entrainment = (viscosity * mean_speed) ** 0.7 * radius**0.43
    return cast("Real", 2.65 * pressure_viscosity**0.54 * entrainment / (modulus**0.03 * line_load**0.13))


def thickness_ratio(film: Real, roughness_1: float, roughness_2: float) -> Real:
    """Chi = h / sqrt(Ra1^2 + Ra2^2) (Eq. 28)."""
    return film / hypot(roughness_1, roughness_2)


def thickness_regime(ratio: float, boundary_below: float = 1.0, full_film_above: float = 4.0) -> Regime:
    """Boundary (scuffing probable), mixed or full film; the limits are the paper's, many texts end mixed at 3."""
    if ratio < boundary_below:
        return "boundary"
    return "full_film" if ratio > full_film_above else "mixed"
