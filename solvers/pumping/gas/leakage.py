"""Exchange of a cell with its walls over an implicit stage: leakage, gas carried by the flanks, and wall work.

All amounts are per metre of face. Gas that leaks out has the velocity of the cell; gas that leaks in comes from rest.
The only unknown is the flux through the radial gaps. The square of this flux is nearly linear in the pressure.
Therefore Newton's method for the square converges for any gap and any pressure, even if the exchange is very stiff.
Mass, momentum and energy of the cell follow from the flux without further iteration. These three quantities are
therefore conserved even if the flux has an error.
"""

from typing import NamedTuple

import numpy as np

from solvers.compiled import inlined_kernel, inner_kernel
from solvers.pumping.flow.nozzle import Gas, flux_squared

_NEWTON_LIMIT = 30  # iterations; Newton's method on the square of the flux needs few
_TOLERANCE = 1e-10  # largest relative error of the flux through the gaps


class Walls(NamedTuple):
    """The walls of a cell at one instant.

    `area` is the area of the cell's section [m^2], and `growth` is the rate at which this area grows [m^2/s]. `gap` is
    the clearance times the discharge coefficient [m]. `transport` is the volume of gas that the moving flanks carry
    out of the cell, per unit time and per metre of face [m^2/s]. If `transport` is negative, the flanks carry ambient
    gas into the cell.
    """

    area: float
    growth: float
    gap: float
    transport: float


class Stage(NamedTuple):
    """Content and pressure of a cell after a stage, and the rates at which the cell loses its content in the stage.

    The content after the stage is `mass` [kg/m], `momentum` [kg/s] and `energy` [J/m]. `pressure` [Pa] is the pressure
    after the stage. In the stage, the cell loses mass at the rate `leak` [kg/(s m)], momentum at the rate
    `momentum_rate` [N/m], and energy at the rate `energy_rate` [W/m]. `through_gaps` [kg/(s m)] is the part of `leak`
    that passes through the radial gaps. `fits` tells whether the state after the stage is physical.
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
    """Exchange of a cell with its walls over one stage of the backward Euler method (Eq. P7).

    Without gaps only the flanks carry gas and the gas works on the walls; `stiffness` [m^2] is then the inner energy
    before over the pressure after.
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


@inner_kernel
def _unphysical() -> Stage:
    return Stage(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, False)


@inner_kernel
def _improve(flux: float, squared: float, slope: float) -> float:
    """Positive root x of x^2 = squared + slope (x - flux), the linearised nozzle law, or 0; `slope` <= 0."""
    constant = squared - slope * flux
    if constant <= 0.0:
        return 0.0
    half = -0.5 * slope
    root: float = constant / (half + np.sqrt(half**2 + constant))
    return root


@inner_kernel
def _is_settled(change: float, content: float, drop: float) -> bool:
    """Whether the error of the flux, about 2 (change/content)^2/drop after a Newton step, is within tolerance."""
    return 2.0 * change**2 <= _TOLERANCE * content**2 * max(drop, 0.0)


@inlined_kernel
def _outflow(gas: Gas, walls: Walls, stiffness: float, mass: float, inner: float, h: float, guess: float) -> float:
    """Leakage [kg/(s m)] out of a cell above ambient pressure; `inner` is its energy before [J/m]."""
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
        out = min(max(_improve(out, gap**2 * squared, gap**2 * slope), 0.0), 0.5 * (out + mass / h))
        if _is_settled(h * (out - before), content, drop):
            break
    return out


@inlined_kernel
def _inflow(
    gas: Gas, walls: Walls, stiffness: float, energy: float, momentum: float, mass: float, h: float, guess: float
) -> float:
    """Compute the leakage [kg/(s m)] into a cell whose pressure is below ambient pressure."""
    gap, heat, ambient = walls.gap, gas.heat_capacity * gas.temperature, 1.0 / (stiffness * gas.pressure)
    inflow = guess
    for _ in range(_NEWTON_LIMIT):
        content = mass + h * inflow
        velocity = momentum / content
        drop = 1.0 - (energy + h * inflow * heat - 0.5 * momentum * velocity) * ambient
        squared, _, by_pressure = flux_squared(gas, gas.pressure, gas.density, drop)
        slope = by_pressure * h * (heat + 0.5 * velocity**2) / stiffness
        before = inflow
        inflow = _improve(inflow, gap**2 * squared, gap**2 * slope)
        if _is_settled(h * (inflow - before), content, drop):
            break
    return inflow
