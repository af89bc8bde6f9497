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
    """Compute the flash temperature of a line contact by Blok's formula [K].

    Eq. 25: t_f = 0.7858 f w |u_1 - u_2|/{[sqrt(lambda_1 rho_1 c_1 u_1) + sqrt(lambda_2 rho_2 c_2 u_2)] sqrt(b_0)}. The
    factor 0.7858 is 1.1113/sqrt(2). In a formula with the full width 2 b_0, Blok's factor is 1.11. `half_width`: half
    width b_0 of the Hertzian contact, positive [m].
    """
    conducted = np.sqrt(_conduction(solid_1) * speed_1) + np.sqrt(_conduction(solid_2) * speed_2)
    generated = friction * line_load * np.abs(speed_1 - speed_2)
    return cast("Real", 0.7858 * generated / (conducted * np.sqrt(half_width)))


def _conduction(solid: Solid) -> float:
    """Return lambda rho c, the square of the thermal effusivity."""
    return solid.thermal_conductivity * solid.density * solid.specific_heat
