"""Blok's flash temperature at points of the flank."""

import numpy as np

from solvers.arrays import FloatArray
from solvers.contact.flash import blok_flash_temperature
from solvers.scuffing.inputs import LoadDistributionInputs
from solvers.scuffing.results import ContactPoints


def blok_flash(given: LoadDistributionInputs, points: ContactPoints) -> FloatArray:
    """Compute Blok's flash temperature at points of the flank (Eq. 25).

    Returns flash temperature [K]. It is 0 at points without contact or motion. It is NaN at loaded points that are too
    near a base circle. If the coefficient of friction is None, the flash temperature is NaN at every point in contact.
    """
    apart = np.where(points.undefined, np.nan, 0.0)
    if given.friction_coefficient is None:
        return np.where(points.in_contact, np.nan, apart)
    with np.errstate(divide="ignore", invalid="ignore"):  # division by zero at points that are not in contact
        flash = blok_flash_temperature(
            friction=given.friction_coefficient,
            line_load=points.line_load,
            speed_1=points.pinion_speed,
            speed_2=points.wheel_speed,
            half_width=points.half_width,
            solid_1=given.pinion_material,
            solid_2=given.wheel_material,
        )
    return np.where(points.in_contact, flash, apart)
