"""Flash temperature of a sliding line contact by Blok's formula."""

from typing import TypeVar, cast

import numpy as np

from solvers.arrays import FloatArray
from solvers.materials import Solid

Real = TypeVar("Real", float, FloatArray)


def blok_flash_temperature(
    *,
    friction: float,
    line_load: Real,
    speed_1: Real,
    speed_2: Real,
    half_width: Real,
    solid_1: Solid,
    solid_2: Solid,
) -> Real:
    """t_f = 0.7858 f w |u1 - u2| / {[sqrt(lambda1 rho1 c1 u1) + sqrt(lambda2 rho2 c2 u2)] sqrt(b_0)} [K] (Eq. 25).

    line_load [N/m], surface speeds [m/s], half_width of the Hertz contact > 0 [m]. The factor is Blok's 1.11 for the
    full width 2 b_0, 1.1113 / sqrt(2).
    """
    conducted = np.sqrt(_conduction(solid_1) * speed_1) + np.sqrt(_conduction(solid_2) * speed_2)
    generated = friction * line_load * np.abs(speed_1 - speed_2)
    return cast("Real", 0.7858 * generated / (conducted * np.sqrt(half_width)))


def _conduction(solid: Solid) -> float:
    """Lambda rho c, the square of the thermal effusivity."""
    return solid.thermal_conductivity * solid.density * solid.specific_heat
