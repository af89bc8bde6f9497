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
    """Reduced modulus E' = 2/[(1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2] [Pa] (Eq. E1)."""
    return 2.0 / (plane_strain_compliance(solid_1) + plane_strain_compliance(solid_2))


def half_width(line_load: Real, radius: Real, modulus: float) -> Real:
    """Half width b = sqrt(8 w R/(pi E')) of a Hertzian line contact [m] (Eqs. L14, E1)."""
    return cast("Real", np.sqrt(8.0 * line_load * radius / (np.pi * modulus)))


def maximum_pressure(line_load: Real, radius: Real, modulus: float) -> Real:
    """Largest pressure p_H = sqrt(w E'/(2 pi R)) of a Hertzian line contact [Pa]; the mean is (pi/4) p_H (Eq. E1)."""
    return cast("Real", np.sqrt(line_load * modulus / (2.0 * np.pi * radius)))
