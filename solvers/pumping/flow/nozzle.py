"""The perfect gas with its ambient state, and the flow of this gas through an opening.

Eq. 7 gives the flow through a choked opening.
"""

from math import sqrt
from typing import NamedTuple

import numpy as np

from solvers.compiled import inlined_kernel, inner_kernel
from solvers.pumping.inputs import MOLAR_GAS_CONSTANT, Ambient

_LINEAR = 1e-7  # relative pressure drop; below it the flux is linear in the drop, so that no derivative is infinite
_SMALL = 1e-2  # relative pressure drop; below it the expansion is computed by a series
_TERMS = 7  # number of terms of the series; for drops up to _SMALL the first omitted term is below 1e-16


class Gas(NamedTuple):
    """The perfect gas and its ambient state, in SI units.

    `critical_ratio` is the pressure at Mach 1 divided by the pressure at rest. `critical_density_ratio` is the density
    at Mach 1 divided by the density at rest.
    """

    exponent: float
    constant: float
    heat_capacity: float
    pressure: float
    temperature: float
    density: float
    sound_speed: float
    critical_ratio: float
    critical_density_ratio: float


def gas(ambient: Ambient) -> Gas:
    """Compute the properties of the gas from its ambient state."""
    exponent, constant = ambient.isentropic_exponent, MOLAR_GAS_CONSTANT / ambient.molar_mass
    return Gas(
        exponent=exponent,
        constant=constant,
        heat_capacity=constant * exponent / (exponent - 1.0),
        pressure=ambient.pressure,
        temperature=ambient.temperature,
        density=ambient.pressure / (constant * ambient.temperature),
        sound_speed=sqrt(exponent * constant * ambient.temperature),
        critical_ratio=(2.0 / (exponent + 1.0)) ** (exponent / (exponent - 1.0)),
        critical_density_ratio=(2.0 / (exponent + 1.0)) ** (1.0 / (exponent - 1.0)),
    )


@inlined_kernel
def flux_squared(gas: Gas, upstream: float, density: float, drop: float) -> tuple[float, float, float]:
    """Square of the mass flux, G^2 = 2 g/(g - 1) p rho y (y - x), and its derivatives by both pressures (Eq. P4).

    x is the pressure ratio, y = x^(1/g) the density ratio; accurate however small the drop. A negative drop continues
    it linearly. Derivatives hold at a fixed density upstream. In SI units.
    """
    power = 1.0 / gas.exponent
    if drop <= 0.0:
        slope = 2.0 * density
        return slope * upstream * drop, slope, -slope
    scale = 2.0 / (1.0 - power) * density
    if drop >= 1.0 - gas.critical_ratio:
        x, y = gas.critical_ratio, gas.critical_density_ratio
        slope = scale * y * (y - x)
        return slope * upstream, slope, 0.0
    x = 1.0 - drop
    y, more = _expansion(power, drop)
    by_upstream = scale * y * (y + power * (x - 2.0 * y))
    by_downstream = scale * y * (2.0 * power * y / x - (1.0 + power))
    return scale * upstream * y * more, by_upstream, by_downstream


@inner_kernel
def _expansion(power: float, drop: float) -> tuple[float, float]:
    """Density ratio y = x^power of an isentropic expansion to x = 1 - drop, and y - x, for small drops by series."""
    if drop > _SMALL:
        x = 1.0 - drop
        y = x**power
        return y, y - x
    series = 1.0
    for n in range(_TERMS, 0, -1):
        series = 1.0 + (n - power) * (1.0 / (n + 1)) * drop * series
    fallen = power * drop * series
    return 1.0 - fallen, drop - fallen


@inner_kernel
def mass_flux(gas: Gas, upstream: float, density: float, downstream: float) -> tuple[float, float, float]:
    """Mass flux through an opening and its derivatives by both pressures, at fixed density upstream (Eq. P4).

    Without the discharge coefficient; kg/(s m^2).
    """
    drop = (upstream - downstream) / upstream
    if drop < _LINEAR:
        edge = flux_squared(gas, upstream, density, _LINEAR)[0]
        slope = np.sqrt(edge) / (_LINEAR * upstream)
        return slope * (upstream - downstream), slope, -slope
    squared, by_upstream, by_downstream = flux_squared(gas, upstream, density, drop)
    flux = np.sqrt(squared)
    half = 0.5 / flux
    return flux, half * by_upstream, half * by_downstream


@inner_kernel
def throat_mach(gas: Gas, upstream: float, downstream: float) -> float:
    """Compute the Mach number in the narrowest section of an opening; 1 if the opening is choked."""
    g = gas.exponent
    ratio = min(max(downstream / upstream, gas.critical_ratio), 1.0)
    mach: float = np.sqrt(2.0 / (g - 1.0) * (ratio ** ((1.0 - g) / g) - 1.0))
    return mach


def choked_mass_flux(gas: Gas, pressure: float, temperature: float) -> float:
    """Compute the largest mass flux from a stagnation state [kg/(s m^2)]. Eq. 7 divided by the area of the opening."""
    g, r = gas.exponent, gas.constant
    velocity_factor: float = (2 / (g + 1)) ** (1 / (g - 1)) * sqrt(2 * g * r / (g + 1))
    return velocity_factor * pressure / (r * sqrt(temperature))
