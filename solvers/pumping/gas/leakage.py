"""Exchange of a cell of the duct with its walls over an implicit stage: leakage, gas on the flanks, wall work.

All amounts are per metre of face. The kinetic energy takes no part: what leaks out leaves with the cell's velocity,
what leaks in comes from rest. One unknown remains, the flux through the radial gaps; its square is nearly linear in
the pressure, so Newton's method on the square is safe for any gap and any pressure, however stiff. Whatever flux it
ends with, the cell's mass, momentum and energy follow from it exactly.
"""

from typing import NamedTuple

import numpy as np

from solvers.compiled import inlined_kernel, kernel
from solvers.pumping.flow.nozzle import Gas, flux_squared

_NEWTON_LIMIT = 30  # limit; Newton's method on the square of the flux needs few steps
_TOLERANCE = 1e-10  # relative, of the flux through the gaps


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

    mass [kg/m], momentum [kg/s], energy [J/m], pressure [Pa]; rates of mass, momentum and energy lost [kg/(s m), N/m,
    W/m], of the mass `through_gaps` alone; `fits`: whether the state is physical.
    """

    mass: float
    momentum: float
    energy: float
    pressure: float
    leak: float
    momentum_rate: float
    energy_rate: float
    through_gaps: float
    fits: bool


@inlined_kernel
def implicit_stage(
    gas: Gas, walls: Walls, mass: float, momentum: float, energy: float, h: float, guess: float
) -> Stage:
    """Backward Euler stage of length h [s] from an explicit content, the flux through gaps from a guess [kg/(s m)].

    `stiffness` is inner energy per pressure [m^2] of a cell that does wall work and loses flank gas, but does not leak.

    Eq. P7.
    """
    g, area = gas.exponent, walls.area
    into, carried = max(-walls.transport, 0.0) * gas.density, max(walls.transport, 0.0) / area
    heat, per_pressure = gas.heat_capacity * gas.temperature, area / (g - 1.0)
    if mass <= 0.0:
        return _unphysical()
    filled, given = mass + h * into, energy + h * into * heat
    inner = given - 0.5 * momentum**2 / filled
    stiffness = per_pressure * (1.0 + g * h * carried) + h * walls.growth
    if inner <= 0.0 or stiffness <= 0.0:
        return _unphysical()
    if inner > stiffness * gas.pressure:
        through_gaps = _outflow(gas, walls, stiffness, filled, inner, h, max(guess, 0.0))
    else:
        through_gaps = -_inflow(gas, walls, stiffness, given, momentum, filled, h, max(-guess, 0.0))
    out, inflow = max(through_gaps, 0.0), into + max(-through_gaps, 0.0)
    filled = mass + h * inflow
    velocity = momentum / filled
    new_mass = (filled - h * out) / (1.0 + h * carried)
    out += carried * new_mass
    inner = energy + h * inflow * heat - 0.5 * momentum * velocity
    enthalpy = g * per_pressure / new_mass
    pressure = inner / (per_pressure + h * walls.growth + h * out * enthalpy)
    energy_rate = pressure * walls.growth + out * (enthalpy * pressure + 0.5 * velocity**2) - inflow * heat
    return Stage(
        new_mass,
        new_mass * velocity,
        energy - h * energy_rate,
        pressure,
        out - inflow,
        out * velocity,
        energy_rate,
        through_gaps,
        new_mass > 0.0 and pressure > 0.0,
    )


@kernel
def _unphysical() -> Stage:
    return Stage(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, False)


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
def _settled(change: float, content: float, drop: float) -> bool:
    """Whether Newton's last change of a content [kg/m] leaves less than the tolerance of the flux.

    What the linearised law leaves out is its second derivative: of the flux that is about (change / content)^2 by the
    relative pressure drop, with a factor of 1 to 2 from the powers in which a cell's pressure and density fall.
    """
    return 2.0 * change**2 <= _TOLERANCE * content**2 * max(drop, 0.0)


@inlined_kernel
def _outflow(gas: Gas, walls: Walls, stiffness: float, mass: float, inner: float, h: float, guess: float) -> float:
    """Leakage out of a cell above ambient pressure [kg/(s m)].

    The cell's pressure is inner / resistance: its stiffness [m^2], and what the enthalpy of the leak adds to it.
    """
    g, area, gap = gas.exponent, walls.area, walls.gap
    thinning = 1.0 / (1.0 + h * max(walls.transport, 0.0) / area)
    ambient = gas.pressure / inner
    out = min(guess, 0.5 * mass / h)
    for _ in range(_NEWTON_LIMIT):
        content = (mass - h * out) * thinning
        volume = area / content
        enthalpy = g / (g - 1.0) * volume
        resistance = stiffness + h * out * enthalpy
        drop, pressure = 1.0 - ambient * resistance, inner / resistance
        squared, by_pressure, _ = flux_squared(gas, pressure, content / area, drop)
        shrink = h * thinning * volume / area
        pressure_slope = -pressure / resistance * h * enthalpy * (1.0 + out * shrink)
        slope = by_pressure * pressure_slope - squared * shrink
        before = out
        out = min(max(_improved(out, gap**2 * squared, gap**2 * slope), 0.0), 0.5 * (out + mass / h))
        if _settled(h * (out - before), content, drop):
            break
    return out


@inlined_kernel
def _inflow(
    gas: Gas, walls: Walls, stiffness: float, energy: float, momentum: float, mass: float, h: float, guess: float
) -> float:
    """Leakage into a cell below ambient pressure [kg/(s m)]."""
    gap, heat, ambient = walls.gap, gas.heat_capacity * gas.temperature, 1.0 / (stiffness * gas.pressure)
    inflow = guess
    for _ in range(_NEWTON_LIMIT):
        content = mass + h * inflow
        velocity = momentum / content
        drop = 1.0 - (energy + h * inflow * heat - 0.5 * momentum * velocity) * ambient
        squared, _, by_pressure = flux_squared(gas, gas.pressure, gas.density, drop)
        slope = by_pressure * h * (heat + 0.5 * velocity**2) / stiffness
        before = inflow
        inflow = _improved(inflow, gap**2 * squared, gap**2 * slope)
        if _settled(h * (inflow - before), content, drop):
            break
    return inflow
