"""What a cell of the duct exchanges with its walls over an implicit stage: leakage, gas on the flanks, wall work.

All amounts are per metre of face. The kinetic energy takes no part: what leaks out leaves with the cell's velocity,
what leaks in comes from rest. One unknown remains, the flux through the radial gaps; its square is nearly linear in
the pressure, so Newton's method on the square is safe for any gap and any pressure, however stiff. Whatever flux it
ends with, the cell's mass, momentum and energy follow from it exactly.
"""

from typing import NamedTuple

import numpy as np

from solvers.compiled import kernel
from solvers.pumping.flow.nozzle import Gas, flux_squared

_NEWTON_LIMIT = 30
_TOLERANCE = 1e-5  # of the last correction: Newton's next one would be its square


class Walls(NamedTuple):
    """The space around a cell at one instant.

    `area` [m^2], `growth` its rate [m^2/s], `gap` clearance times discharge coefficient [m], `transport` area per
    second that the flanks carry out [m^2/s].
    """

    area: float
    growth: float
    gap: float
    transport: float


class Stage(NamedTuple):
    """Content after a stage, its pressure, and the rates of loss that led there.

    mass [kg/m], momentum [kg/s], energy [J/m], pressure [Pa]; rates of leakage out and in [kg/(s m)], momentum and
    energy lost [N/m, W/m]; `fits`: whether the state is physical.
    """

    mass: float
    momentum: float
    energy: float
    pressure: float
    leak: float
    momentum_rate: float
    energy_rate: float
    fits: bool


@kernel
def implicit_stage(
    gas: Gas, walls: Walls, mass: float, momentum: float, energy: float, h: float, guess: float
) -> Stage:
    """Backward Euler stage of length h [s] from an explicit content, the leakage from a guess [kg/(s m)]."""
    into = max(-walls.transport, 0.0) * gas.density
    heat = gas.heat_capacity * gas.temperature
    if mass <= 0.0:
        return _unphysical()
    filled = mass + h * into
    inner = energy + h * into * heat - 0.5 * momentum**2 / filled
    stiffness = _stiffness(gas, walls, h)
    if inner <= 0.0 or stiffness <= 0.0:
        return _unphysical()
    if inner > stiffness * gas.pressure:
        out, inflow = _outflow(gas, walls, filled, inner, h, max(guess, 0.0)), into
    else:
        out, inflow = 0.0, into + _inflow(gas, walls, energy + h * into * heat, momentum, filled, h, max(-guess, 0.0))
    filled = mass + h * inflow
    velocity = momentum / filled
    carried = max(walls.transport, 0.0) / walls.area
    new_mass = (filled - h * out) / (1.0 + h * carried)
    out += carried * new_mass
    inner = energy + h * inflow * heat - 0.5 * momentum * velocity
    enthalpy = gas.exponent / (gas.exponent - 1.0) * walls.area / new_mass
    pressure = inner / (walls.area / (gas.exponent - 1.0) + h * walls.growth + h * out * enthalpy)
    energy_rate = pressure * walls.growth + out * (enthalpy * pressure + 0.5 * velocity**2) - inflow * heat
    return Stage(
        new_mass,
        new_mass * velocity,
        energy - h * energy_rate,
        pressure,
        out - inflow,
        out * velocity,
        energy_rate,
        new_mass > 0.0 and pressure > 0.0,
    )


@kernel
def _unphysical() -> Stage:
    return Stage(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, False)


@kernel
def _stiffness(gas: Gas, walls: Walls, h: float) -> float:
    """Inner energy per pressure [m^2] of a cell that does wall work and loses flank gas, but does not leak."""
    g = gas.exponent
    return walls.area / (g - 1.0) + h * walls.growth + h * max(walls.transport, 0.0) * g / (g - 1.0)


@kernel
def _improved(flux: float, squared: float, slope: float) -> float:
    """Positive root of new^2 = squared + slope (new - flux), the nozzle law linearised in the flux; slope <= 0."""
    constant = squared - slope * flux
    if constant <= 0.0:
        return 0.0
    half = -0.5 * slope
    improved: float = constant / (half + np.sqrt(half**2 + constant))
    return improved


@kernel
def _outflow(gas: Gas, walls: Walls, mass: float, inner: float, h: float, guess: float) -> float:
    """Leakage out of a cell above ambient pressure [kg/(s m)]."""
    g, area = gas.exponent, walls.area
    thinned = 1.0 + h * max(walls.transport, 0.0) / area
    stiffness, gap = _stiffness(gas, walls, h), walls.gap
    out = min(guess, 0.5 * mass / h)
    for _ in range(_NEWTON_LIMIT):
        content = (mass - h * out) / thinned
        density = content / area
        enthalpy = g / (g - 1.0) / density
        pressure = inner / (stiffness + h * out * enthalpy)
        squared, by_pressure, _ = flux_squared(gas, pressure, density, gas.pressure)
        shrink = h / (content * thinned)
        pressure_slope = -pressure * pressure / inner * h * enthalpy * (1.0 + out * shrink)
        slope = by_pressure * pressure_slope - squared * shrink
        new = _improved(out, gap**2 * squared, gap**2 * slope)
        new = min(max(new, 0.0), 0.5 * (out + mass / h))
        if abs(new - out) <= _TOLERANCE * new:
            return new
        out = new
    return out


@kernel
def _inflow(gas: Gas, walls: Walls, energy: float, momentum: float, mass: float, h: float, guess: float) -> float:
    """Leakage into a cell below ambient pressure [kg/(s m)]."""
    stiffness, gap, heat = _stiffness(gas, walls, h), walls.gap, gas.heat_capacity * gas.temperature
    inflow = guess
    for _ in range(_NEWTON_LIMIT):
        content = mass + h * inflow
        pressure = (energy + h * inflow * heat - 0.5 * momentum**2 / content) / stiffness
        squared, _, by_pressure = flux_squared(gas, gas.pressure, gas.density, pressure)
        slope = by_pressure * h * (heat + 0.5 * (momentum / content) ** 2) / stiffness
        new = _improved(inflow, gap**2 * squared, gap**2 * slope)
        if abs(new - inflow) <= _TOLERANCE * new:
            return new
        inflow = new
    return inflow
