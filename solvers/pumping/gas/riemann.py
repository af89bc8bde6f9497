"""States of the gas and fluxes through the faces of a duct: between two cells (HLLC), into surroundings at rest.

Velocities are along the face [m/s], or outwards at a face that opens into the ambient.
"""

from typing import NamedTuple

import numpy as np

from solvers.compiled import kernel
from solvers.pumping.flow.nozzle import Gas


class State(NamedTuple):
    """Density rho [kg/m^3], velocity u [m/s] and pressure p [Pa]."""

    density: float
    velocity: float
    pressure: float


class Conserved(NamedTuple):
    """Mass, momentum and energy: of a flux [kg/s, N, W], per area [kg/(s m^2), Pa, W/m^2]."""

    mass: float
    momentum: float
    energy: float


@kernel
def flux(g: float, area: float, state: State, ram: float) -> Conserved:
    """Flux of a state through an area: A (rho u, rho u^2 + p, u (rho E + p)), rho E = p/(g - 1) + rho u^2/2 (Eq. P6).

    `ram` is rho u^2 [Pa] as its caller rounds it: a march amplifies its last digit to 1e-7 of a result.
    """
    rho, u, p = state
    return Conserved(area * rho * u, area * (ram + p), area * u * (g / (g - 1.0) * p + 0.5 * ram))


@kernel
def ram_pressure(state: State) -> float:
    """Ram pressure rho u^2 [Pa]."""
    return state.density * state.velocity * state.velocity


@kernel
def hllc(g: float, left: State, right: State) -> Conserved:
    """HLLC flux with Einfeldt's wave speeds (Toro, Riemann Solvers and Numerical Methods, 2009, section 10.4-10.6)."""
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


@kernel
def _star_flux(g: float, state: State, s: float, s_m: float) -> Conserved:
    """Flux of the state between the outer wave s and the contact s_m."""
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


@kernel
def reservoir_face(gas: Gas, cell: State) -> tuple[State, float]:
    """State of a face that opens into the ambient, and how nearly it is sonic (Eq. P8).

    The velocity v of the cell is outwards. Outflow expands to the ambient pressure, at most to Mach 1; inflow
    starts from ambient gas at rest. The last value is the Mach number that the ambient pressure asks for, negative
    for inflow: above one the face is choked (or the duct supersonic, and the face has its state).
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
        face = _inflow(gas, invariant, c_f)
        return face, face.velocity / np.sqrt(g * face.pressure / face.density)
    mach = v_f / c_f
    if mach > 1.0:
        c_f = (g - 1.0) / (g + 1.0) * invariant
        v_f = c_f
    rho_f = rho * (c_f / c) ** (2.0 / (g - 1.0))
    return State(rho_f, v_f, rho_f * c_f * c_f / g), mach


@kernel
def front_face(gas: Gas, speed: float, cell: State) -> State:
    """State of the border to gas at rest that the stroke runs over at `speed` [m/s], from the cell behind it.

    Seen from the border the gas ahead comes in at that speed: the border is a reservoir face in its own frame, the
    reservoir at the stagnation state of this head wind. From the speed of sound on nothing runs ahead of the border;
    the wind of that speed lets pass what the grid spreads. Ambient pressure or gas at rest, one alone or in turn, are
    no such border: the first draws a jet along, and both together reflect rho c u, a pressure in proportion to the
    speed instead of its square.
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


@kernel
def _inflow(gas: Gas, invariant: float, cell_sound_speed: float) -> State:
    """Inflow from rest that meets the gas of the cell at one pressure and velocity, at most sonic.

    `cell_sound_speed` is that of the cell's gas brought to ambient pressure: where it is hotter than the ambient a
    contact lies between both, and the invariant v + 2c/(g-1) holds on its far side. The larger root of a quadratic for
    the ratio of the face's sound speed to the ambient one.
    """
    g, stagnation = gas.exponent, gas.sound_speed
    slope, jet = 2.0 / (g - 1.0) * cell_sound_speed, 2.0 / (g - 1.0) * stagnation**2
    root = np.sqrt(jet * (slope**2 + jet - invariant**2))
    ratio = max((slope * invariant + root) / (slope**2 + jet), np.sqrt(2.0 / (g + 1.0)))
    c = stagnation * ratio
    v = -np.sqrt(max(jet * (1.0 - ratio**2), 0.0))  # at rest the root may round beyond one
    rho = gas.density * ratio ** (2.0 / (g - 1.0))
    return State(rho, v, rho * c * c / g)
