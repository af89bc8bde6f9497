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
    """Compute the flux of a state through an area: A (rho u, rho u^2 + p, u (rho E + p)).

    Eq. P6 with rho E = p/(g - 1) + rho u^2/2. The caller computes the ram pressure, because the rounding of the ram
    pressure matters: a march amplifies a difference in the last digit to 1e-7 of a result.
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
    """Compute the state of a face that opens into the ambient, and the demand of this face (Eq. P8).

    `cell`: state of the cell at the face, with the velocity positive outwards. Returns `face`: state of the face.
    Outflow expands to the ambient pressure. If this expansion would lead to more than Mach 1, the outflow only expands
    to Mach 1. Inflow comes from ambient gas at rest. If the cell is supersonic outwards, the face has the state of the
    cell; `demand`: mach number of an expansion to the ambient pressure; negative for inflow, which expands to the
    pressure of the cell. If the magnitude of the demand is above 1, the face is choked, or the cell is supersonic.
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
    """Compute the state of the gas at a border that moves at `speed` [m/s] into gas at rest.

    `cell` is the state of the gas behind the border. Seen from the border, the gas ahead is a head wind. The border is
    therefore treated as a face to a reservoir with the stagnation state of this head wind. The head wind is limited to
    the speed of sound. Real waves do not reach a border that moves faster than sound. But the grid spreads waves over
    several cells, and without the limit the border would stop these waves.

    Two simpler conditions at the border fail. If the gas at the border always has ambient pressure, a jet follows the
    border. If the gas at the border alternately has ambient pressure and no velocity, waves are reflected with the
    pressure rho c u. This pressure is proportional to the speed u, but the correct pressure is proportional to the
    square of the speed.
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
    """Compute the state of ambient gas at the face through which this gas flows from rest into a cell.

    Also return the Mach number of the inflow without the limit of the speed of sound.

    The inflow is at most sonic. Where the inflow meets the gas of the cell, both gases have the same pressure and the
    same velocity, but they may have different temperatures. The `invariant` v + 2c/(g-1) holds in the gas of the cell.
    `cell_sound_speed` is the speed of sound [m/s] in the gas of the cell after an expansion to ambient pressure. In the
    code, `ratio` is the speed of sound at the face divided by the speed of sound in the ambient gas. This ratio is the
    larger root of a quadratic equation.
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
