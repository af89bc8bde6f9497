"""Viscosity and pressure-viscosity coefficient of an oil for the film of ISO/TR 15144-1.

The film of a contact depends on both values at the temperature of this contact. The temperature differs between
contacts. Both values are therefore needed at any temperature. If the oil is given by its data sheet, the laws of the
oil give these values.
"""

from math import log10
from typing import Any, TypeVar, cast

import numpy as np

from solvers.arrays import FloatArray
from solvers.lubricants import ROELANDS_POLE_TEMPERATURE, Lubricant, OilKind
from solvers.oils import ROUNDED_ZERO, SQUARE_MILLIMETRE, WALTHER_SHIFT, OilSheet, over_coefficient_at_38

Real = TypeVar("Real", float, FloatArray)

ROUNDED = 273.15 - ROUNDED_ZERO  # K, difference between the exact and the rounded zero
DENSITY_SLOPE = 0.7  # kg/(m^3 K)
DENSITY_ZERO = 289.0  # K, reference temperature of the density, on the scale with the rounded zero
REFERENCE = 38.0  # C, reference temperature of viscosity and pressure-viscosity coefficient
REFERENCE_COEFFICIENT: dict[OilKind, tuple[float, float]] = {
    "mineral": (2.657e-8, 0.1348),
    "pao": (1.466e-8, 0.0507),
    "polyglycol": (1.392e-8, 0.1572),
    "ester": (2.657e-8, 0.1348),  # no values are known for esters; the values of a mineral oil are used
}
"""Scale [m^2/N at 1 Pa s] and exponent of the law that gives the pressure-viscosity coefficient at 38 C."""


def density(sheet: OilSheet, temperature: Real) -> Real:
    """Compute the density of an oil.

    Eq. M1 of the chapter on micropitting. Returns density [kg/m^3]; 0 at temperatures at which the law would give a
    negative density.
    """
    reference = sheet.density_15
    if reference is None:
        reference = 43.37 * log10(sheet.kinematic_viscosity_40 / SQUARE_MILLIMETRE) + 805.5
    value = reference - DENSITY_SLOPE * (temperature - ROUNDED - DENSITY_ZERO)
    return value * (value > 0.0)


def viscosity(oil: OilSheet | Lubricant, temperature: Real) -> Real:
    """Compute the dynamic viscosity of an oil at ambient pressure [Pa s].

    Eq. M2 of the chapter on micropitting. The equation holds for an oil that is given by a data sheet. For an oil that
    is given by its viscosity, the temperature law of `Lubricant` is used instead. Raises InvalidInput:
    `viscosity_range` if the law of a `Lubricant` gives a viscosity that is too high for any oil.
    """
    if isinstance(oil, OilSheet):
        intercept, slope = oil.walther()
        kinematic: Any = 10.0**10.0 ** (intercept - slope * np.log10(temperature)) - WALTHER_SHIFT
        return cast("Real", kinematic * SQUARE_MILLIMETRE * density(oil, temperature))
    laws = oil.laws
    # This call raises the error if the oil is too thick.
    oil.viscosity_at(0.0, float(np.min(temperature, initial=oil.reference_temperature)))
    if oil.pressure_viscosity_law == "barus":
        heating = temperature - laws.reference_temperature
        return cast("Real", np.exp(laws.log_viscosity - laws.temperature_viscosity * heating))
    pole = ROELANDS_POLE_TEMPERATURE
    ratio = (temperature - pole) / (laws.reference_temperature - pole)
    return cast("Real", np.exp(laws.log_viscosity - laws.a1 + laws.a1 * ratio**-laws.temperature_exponent))


def pressure_viscosity(oil: OilSheet | Lubricant, temperature: Real) -> Real:
    """Compute the pressure-viscosity coefficient of an oil [1/Pa].

    Eq. M3 of the chapter on micropitting. If the coefficient is given, this value is used at every temperature. At
    temperatures above 510 C the law would give a negative coefficient; the coefficient and the film are then 0.
    """
    if oil.pressure_viscosity is not None:
        return cast("Real", np.full(np.shape(temperature), oil.pressure_viscosity))
    assert isinstance(oil, OilSheet)
    reference = oil.pressure_viscosity_38
    if reference is None:
        scale, exponent = REFERENCE_COEFFICIENT[oil.kind]
        reference = scale * viscosity(oil, REFERENCE + 273.15) ** exponent
    return cast("Real", reference * over_coefficient_at_38(temperature))
