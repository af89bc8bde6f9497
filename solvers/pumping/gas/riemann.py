"""States of the gas, and fluxes through the faces of a duct: between two cells (HLLC), and into ambient gas at rest.

A velocity [m/s] is positive in the direction of the duct; at an end that opens into the ambient, it is positive
outwards.
"""

from typing import NamedTuple

import numpy as np

from solvers.compiled import inner_kernel
from solvers.pumping.flow.nozzle import Gas

COLDEST = 1e-3  # least speed of sound of an inflow over that of the ambient gas; nearly a vacuum


class State(NamedTuple):
    """Density rho [kg/m^3], velocity u [m/s] and pressure p [Pa]."""

    density: float
    velocity: float
    pressure: float


class Conserved(NamedTuple):
    """Fluxes of mass, momentum and energy [kg/s, N, W], or fluxes per area [kg/(s m^2), Pa, W/m^2]."""

    mass: float
    momentum: float
    energy: float


@inner_kernel
def flux(g: float, area: float, state: State, ram: float) -> Conserved:
    """Flux A (rho u, rho u^2 + p, u (rho E + p)) of a state through an area, rho E = p/(g - 1) + rho u^2/2 (Eq. P6).

    The caller computes the ram pressure: a march amplifies its last digit to 1e-7 of a result.
    """
    rho, u, p = state
    return Conserved(area * rho * u, area * (ram + p), area * u * (g / (g - 1.0) * p + 0.5 * ram))


@inner_kernel
def ram_pressure(state: State) -> float:
    """Compute the ram pressure rho u^2 [Pa]."""
    return state.density * state.velocity * state.velocity


@inner_kernel
def hllc(g: float, left: State, right: State) -> Conserved:
    """Compute the HLLC flux with Einfeldt's wave speeds (Toro, Riemann Solvers, 2009, sections 10.4 to 10.6)."""
    rho_l, u_l, p_l = left
    rho_r, u_r, p_r = right
    c_l, c_r = np.sqrt(g * p_l / rho_l), np.sqrt(g * p_r / rho_r)
    w_l, w_r = np.sqrt(rho_l), np.sqrt(rho_r)
    mean_u = (w_l * u_l + w_r * u_r) / (w_l + w_r)
    spread = 0.5 * w_l * w_r / (w_l + w_r) ** 2 * (u_r - u_l) ** 2
    mean_c = np.sqrt((w_l * c_l * c_l + w_r * c_r * c_r) / (w_l + w_r) + spread)
    s_l, s_r = min(u_l - c_l, mean_u - mean_c), max(u_r + c_r, mean_u + mean_c)
    if s_l >= 0.0:
        return flux(g, 1.0, left, ram_pressure(left))
    if s_r <= 0.0:
        return flux(g, 1.0, right, ram_pressure(right))
    m_l, m_r = rho_l * (s_l - u_l), rho_r * (s_r - u_r)
    s_m = (p_r - p_l + u_l * m_l - u_r * m_r) / (m_l - m_r)
    if s_m >= 0.0:
        return _star_flux(g, left, s_l, s_m)
    return _star_flux(g, right, s_r, s_m)


@inner_kernel
def _star_flux(g: float, state: State, s: float, s_m: float) -> Conserved:
    """Compute the flux between an outer wave of speed `s` and the contact discontinuity of speed `s_m`.

    `state` is the state outside the outer wave.
    """
    rho, u, p = state
    outside = flux(g, 1.0, state, ram_pressure(state))
    total = p / (g - 1.0) + 0.5 * rho * u * u
    star = rho * (s - u) / (s - s_m)
    star_total = star * (total / rho + (s_m - u) * (s_m + p / (rho * (s - u))))
    return Conserved(
        outside.mass + s * (star - rho),
        outside.momentum + s * (star * s_m - rho * u),
        outside.energy + s * (star_total - total),
    )


@inner_kernel
def reservoir_face(gas: Gas, cell: State) -> tuple[State, float]:
    """State of a face that opens into the ambient, and its demand (Eq. P8).

    `cell` has its velocity positive outwards. Outflow expands to ambient pressure, at most to Mach 1; inflow comes from
    rest; a supersonic cell keeps its state. The demand is the Mach number of the full expansion, negative for inflow;
    beyond 1 the face is choked.
    """
    g = gas.exponent
    rho, v, p = cell
    c = np.sqrt(g * p / rho)
    if v >= c:
        return cell, v / c
    invariant = v + 2.0 * c / (g - 1.0)
    c_f = c * (gas.pressure / p) ** (0.5 * (g - 1.0) / g)
    v_f = invariant - 2.0 * c_f / (g - 1.0)
    if v_f < 0.0:
        face, wanted = _inflow(gas, invariant, c_f)
        return face, -wanted
    mach = v_f / c_f
    if mach > 1.0:
        c_f = (g - 1.0) / (g + 1.0) * invariant
        v_f = c_f
    rho_f = rho * (c_f / c) ** (2.0 / (g - 1.0))
    return State(rho_f, v_f, rho_f * c_f * c_f / g), mach


@inner_kernel
def front_face(gas: Gas, speed: float, cell: State) -> State:
    """State at a border that moves at `speed` [m/s] into gas at rest; `cell` is the state behind it.

    Seen from the border the gas ahead is a head wind: a reservoir with its stagnation state, at most sonic, because the
    grid spreads waves that in reality do not reach a faster border. Ambient pressure at the border would let a jet
    follow it; ambient pressure and rest in turn would reflect waves with rho c u instead of a pressure of second order.
    """
    g, head = gas.exponent, min(speed, gas.sound_speed)
    warming = 1.0 + 0.5 * (g - 1.0) * (head / gas.sound_speed) ** 2
    wind = Gas(
        g,
        gas.constant,
        gas.heat_capacity,
        gas.pressure * warming ** (g / (g - 1.0)),
        gas.temperature * warming,
        gas.density * warming ** (1.0 / (g - 1.0)),
        gas.sound_speed * np.sqrt(warming),
        gas.critical_ratio,
        gas.critical_density_ratio,
    )
    face, _ = reservoir_face(wind, State(cell.density, cell.velocity - head, cell.pressure))
    return State(face.density, face.velocity + head, face.pressure)


@inner_kernel
def _inflow(gas: Gas, invariant: float, cell_sound_speed: float) -> tuple[State, float]:
    """State of ambient gas at the face through which it flows into a cell, and its Mach number without the sonic limit.

    Pressure and velocity are continuous, temperature is not; v + 2c/(g-1) = `invariant` holds in the cell. `ratio`, the
    speed of sound over ambient, is the larger root of a quadratic.
    """
    g, stagnation = gas.exponent, gas.sound_speed
    slope, jet = 2.0 / (g - 1.0) * cell_sound_speed, 2.0 / (g - 1.0) * stagnation**2
    root = np.sqrt(max(jet * (slope**2 + jet - invariant**2), 0.0))
    unlimited = max((slope * invariant + root) / (slope**2 + jet), COLDEST)
    wanted = np.sqrt(max(jet * (1.0 - unlimited**2), 0.0)) / (stagnation * unlimited)
    ratio = max(unlimited, np.sqrt(2.0 / (g + 1.0)))
    c = stagnation * ratio
    v = -np.sqrt(max(jet * (1.0 - ratio**2), 0.0))  # at rest `ratio` may be rounded to more than 1
    rho = gas.density * ratio ** (2.0 / (g - 1.0))
    return State(rho, v, rho * c * c / g), wanted
