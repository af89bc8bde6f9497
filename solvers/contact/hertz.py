"""Dry elastic line contact of two cylinders (Hertz; Johnson, Contact Mechanics, 1985, section 4.2)."""

from typing import TypeVar, cast

import numpy as np

from solvers.arrays import FloatArray
from solvers.materials import Solid

Real = TypeVar("Real", float, FloatArray)


def plane_strain_compliance(solid: Solid) -> float:
    """Return the compliance (1 - nu^2)/E [1/Pa]."""
    return (1.0 - solid.poisson_ratio**2) / solid.youngs_modulus


def reduced_modulus(solid_1: Solid, solid_2: Solid) -> float:
    """Compute the reduced modulus of two solids [Pa].

    Eq. E1: E' = 2/[(1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2]. The film formulas use the same definition of E'.
    """
    return 2.0 / (plane_strain_compliance(solid_1) + plane_strain_compliance(solid_2))


def half_width(line_load: Real, radius: Real, modulus: float) -> Real:
    """Compute the half width of a Hertzian line contact [m]. Eqs. L14, E1: b = sqrt(8 w R/(pi E'))."""
    return cast("Real", np.sqrt(8.0 * line_load * radius / (np.pi * modulus)))


def maximum_pressure(line_load: Real, radius: Real, modulus: float) -> Real:
    """Compute the largest pressure of a Hertzian line contact [Pa].

    Eq. E1: p_H = sqrt(w E'/(2 pi R)). The mean pressure is (pi/4) p_H.
    """
    return cast("Real", np.sqrt(line_load * modulus / (2.0 * np.pi * radius)))
