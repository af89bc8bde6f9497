"""One implicit time step of a chain of pockets that exchange mass and energy by nozzle flow.

 dm_i/dt = M_{i-1/2} - M_{i+1/2} - Q_i                                    (Eq. 3; here Q_i contains the density)
 dE_i/dt = (M h)_{i-1/2} - (M h)_{i+1/2} - (Q h)_i - p dV/dt              energy closure, h = c_p T upstream
 p = p_e (rho/rho_e)^gamma                                                isentropic closure (Eq. 1)

Here m_i and E_i are mass and energy of pocket i, M_{i-1/2} and M_{i+1/2} are the mass flows through the faces below and
above the pocket, Q_i is the mass flow through the radial gaps, and h is the enthalpy of the gas upstream. The index e
denotes the ambient state. Masses, energies, volumes and flows are divided by the width of a pocket.

The step is a backward Euler step, but the wall work is computed with the mean pressure of the step. Newton's method
solves for pressure and mass of all pockets. The Jacobian consists of blocks of two by two. These blocks are eliminated
along the chain.
"""

from typing import Any, NamedTuple

import numpy as np

from solvers.arrays import Fields, RecordArray, floats, records
from solvers.compiled import inner_kernel
from solvers.pumping.flow.nozzle import Gas, mass_flux

_NEWTON_LIMIT = 200  # number of iterations after which a step counts as not converged
_TOLERANCE = 1e-10  # largest permitted residual, relative to a pocket's content at ambient pressure
_ROUNDING = 1e-7  # largest residual that is accepted if round-off keeps Newton's method from reducing the residual
_HALVINGS = 12  # largest number of halvings of a Newton step; steps below 1/4096 of Newton's step do not help


STATE = floats("pressure", "mass")
"""State of a pocket, or a correction of this state by Newton's method: pressure [Pa] and mass [kg/m]."""

ROW = floats("by_pressure", "by_mass")
"""Derivatives of a residual by the pressure and by the mass of a pocket."""

BALANCE: Fields = [*floats("flow", "leak", "residual"), ("lower", ROW), ("diagonal", ROW), ("upper", ROW)]
"""Balance of mass or of heat of a pocket.

`flow`: flow upwards through the face below the pocket [kg/s or W]; `leak`: leakage outwards [kg/(s m) or W/m];
`residual` of Newton's method [kg/m or J/m]. `lower`, `diagonal` and `upper`: derivatives of the residual by the
state of the pocket below, of the pocket itself and of the pocket above.
"""

POCKET: Fields = [
    ("old", STATE),
    ("new", STATE),
    ("trial", STATE),
    ("correction", STATE),
    ("mass_balance", BALANCE),
    ("heat_balance", BALANCE),
    *floats("start_area", "area", "gap", "opening"),
]
"""A pocket and the face below it.

`old` and `new`: state at the start and at the end of a step; `trial` and `correction`: trial state and correction of
Newton's method; `mass_balance` and `heat_balance`: balances of mass and heat; `start_area` and `area`: area at the
start and at the end of the step [m^2]; `gap` and `opening`: radial gap [m] and section of the face [m^2] at the end of
the step.
"""


def empty_pockets(pockets: int) -> RecordArray:
    """Records of a chain of `pockets` pockets, and one more for the face above the last."""
    return records(pockets + 1, POCKET)


class Side(NamedTuple):
    """Gas on one side of an opening: pressure [Pa], mass [kg/m] and section [m^2]."""

    pressure: float
    mass: float
    area: float


class Passage(NamedTuple):
    """Flow of mass or heat through an opening, positive from left to right, and its derivatives by both sides."""

    flow: float
    by_left_pressure: float
    by_left_mass: float
    by_right_pressure: float
    by_right_mass: float


@inner_kernel
def ambient(gas: Gas) -> Side:
    """Return the ambient gas as one side of an opening. The section of this side is 1 m^2."""
    return Side(gas.pressure, gas.density, 1.0)


@inner_kernel
def passages(gas: Gas, left: Side, right: Side) -> tuple[Passage, Passage]:
    """Flows of mass and heat through an opening, per area; heat is the upstream enthalpy c_p p A/(m R)."""
    forward = left.pressure >= right.pressure
    source, sink = (left, right) if forward else (right, left)
    flux, by_p, by_p_sink = mass_flux(gas, source.pressure, source.mass / source.area, sink.pressure)
    per_mass = 1.0 / source.mass
    by_m = 0.5 * flux * per_mass
    per_pressure = gas.heat_capacity / gas.constant * source.area * per_mass
    heat = source.pressure * per_pressure
    energy, energy_by_p_sink = flux * heat, by_p_sink * heat
    energy_by_p, energy_by_m = by_p * heat + flux * per_pressure, by_m * heat - energy * per_mass
    if forward:
        return Passage(flux, by_p, by_m, by_p_sink, 0.0), Passage(
            energy, energy_by_p, energy_by_m, energy_by_p_sink, 0.0
        )
    return Passage(-flux, -by_p_sink, 0.0, -by_p, -by_m), Passage(
        -energy, -energy_by_p_sink, 0.0, -energy_by_p, -energy_by_m
    )


@inner_kernel
def advance(
    gas: Gas, width: float, discharge: float, pockets: RecordArray, low: int, high: int, dt: float, isentropic: bool
) -> tuple[bool, float]:
    """Pressure and mass of the active pockets at the end of a time step (Eqs. 1, 3, P5).

    Returns whether Newton's method converged, and the largest residual over the ambient content of its pocket.
    """
    error, share, halvings, newton = np.inf, 0.0, 0, 0
    for i in range(low, high):
        pockets[i].new = pockets[i].old
        pockets[i].correction.pressure = pockets[i].correction.mass = 0.0
    while newton < _NEWTON_LIMIT:
        for i in range(low, high):
            pockets[i].trial.pressure = _add_change(pockets[i].new.pressure, share * pockets[i].correction.pressure)
            pockets[i].trial.mass = _add_change(pockets[i].new.mass, share * pockets[i].correction.mass)
        trial_error = _assemble(gas, width, discharge, pockets, low, high, dt, isentropic)
        stalled = not trial_error < error and halvings == _HALVINGS - 1
        if trial_error < _TOLERANCE or (stalled and error < _ROUNDING):
            _set_from_flows(gas, width, pockets, low, high, dt, isentropic)
            return True, trial_error
        if trial_error < error or stalled:
            for i in range(low, high):
                pockets[i].new = pockets[i].trial
            _eliminate(pockets, low, high)
            error, share, halvings, newton = trial_error, 1.0, 0, newton + 1
        else:
            share, halvings = 0.5 * share, halvings + 1
    return False, error


@inner_kernel
def _add_change(value: float, change: float) -> float:
    """Add the change of a Newton step to a positive value; the value falls by at most 80 %."""
    return value + max(change, -0.8 * value)


@inner_kernel
def _set_from_flows(
    gas: Gas, width: float, pockets: RecordArray, low: int, high: int, dt: float, isentropic: bool
) -> None:
    """Mass and pressure from the converged flows: conserves mass and, unless `isentropic`, energy to rounding."""
    g = gas.exponent
    for i in range(low, high):
        old_area, area = pockets[i].start_area, pockets[i].area
        mass = (pockets[i].mass_balance.flow - pockets[i + 1].mass_balance.flow) / width - pockets[i].mass_balance.leak
        heat = (pockets[i].heat_balance.flow - pockets[i + 1].heat_balance.flow) / width - pockets[i].heat_balance.leak
        content = pockets[i].old.mass + dt * mass
        pockets[i].new.mass = content
        if isentropic:
            pockets[i].new.pressure = gas.pressure * (content / (gas.density * area)) ** g
        else:
            work = 0.5 * (area - old_area)
            energy = pockets[i].old.pressure * (old_area / (g - 1.0) - work) + dt * heat
            pockets[i].new.pressure = energy / (area / (g - 1.0) + work)


@inner_kernel
def _assemble(
    gas: Gas, width: float, discharge: float, pockets: RecordArray, low: int, high: int, dt: float, isentropic: bool
) -> float:
    """Set flows, residuals and Jacobian of the trial state; return the largest residual over the ambient content."""
    error = 0.0
    _store(gas, pockets, low, high, isentropic)
    _leak(gas, discharge, pockets, low, high, dt, isentropic)
    _exchange(gas, width, discharge, pockets, low, high, dt, isentropic)
    for i in range(low, high):
        mass = gas.density * pockets[i].area
        energy = mass if isentropic else gas.pressure * pockets[i].area / (gas.exponent - 1.0)
        error = max(error, abs(pockets[i].mass_balance.residual) / mass, abs(pockets[i].heat_balance.residual) / energy)
    return error


@inner_kernel
def _store(gas: Gas, pockets: RecordArray, low: int, high: int, isentropic: bool) -> None:
    """Residuals and derivatives without flows: mass and, if `isentropic`, entropy stay, else wall work adds energy."""
    g = gas.exponent
    for i in range(low, high):
        p, content = pockets[i].trial.pressure, pockets[i].trial.mass
        old_area, area = pockets[i].start_area, pockets[i].area
        mass_balance, heat_balance = pockets[i].mass_balance, pockets[i].heat_balance
        _clear(mass_balance)
        _clear(heat_balance)
        mass_balance.residual = content - pockets[i].old.mass
        mass_balance.diagonal.by_mass = 1.0
        if isentropic:
            mass = gas.density * area * (p / gas.pressure) ** (1.0 / g)
            heat_balance.residual = content - mass
            heat_balance.diagonal.by_pressure = -mass / (g * p)
            heat_balance.diagonal.by_mass = 1.0
        else:
            work = 0.5 * (area - old_area)
            kept = pockets[i].old.pressure * (old_area / (g - 1.0) - work)
            heat_balance.residual = p * (area / (g - 1.0) + work) - kept
            heat_balance.diagonal.by_pressure = area / (g - 1.0) + work


@inner_kernel
def _clear(balance: Any) -> None:
    balance.lower.by_pressure = balance.lower.by_mass = 0.0
    balance.diagonal.by_pressure = balance.diagonal.by_mass = 0.0
    balance.upper.by_pressure = balance.upper.by_mass = 0.0


@inner_kernel
def _side(pockets: RecordArray, i: int) -> Side:
    return Side(pockets[i].trial.pressure, pockets[i].trial.mass, pockets[i].area)


@inner_kernel
def _add(row: Any, share: float, by_pressure: float, by_mass: float) -> None:
    """Add `share` times two derivatives to the derivatives of a balance."""
    row.by_pressure += share * by_pressure
    row.by_mass += share * by_mass


@inner_kernel
def _leak(gas: Gas, discharge: float, pockets: RecordArray, low: int, high: int, dt: float, isentropic: bool) -> None:
    """Add the flow through the radial gaps to the balances."""
    for i in range(low, high):
        opening = discharge * pockets[i].gap
        mass, heat = passages(gas, _side(pockets, i), ambient(gas))
        _add_leakage(pockets[i].mass_balance, opening, dt, mass, counts=True)
        _add_leakage(pockets[i].heat_balance, opening, dt, heat, counts=not isentropic)


@inner_kernel
def _add_leakage(balance: Any, opening: float, dt: float, passage: Passage, counts: bool) -> None:
    """Record the leakage through a radial gap; if `counts` is true, also add the leakage to the residual."""
    balance.leak = opening * passage.flow
    if counts:
        share = dt * opening
        balance.residual += share * passage.flow
        _add(balance.diagonal, share, passage.by_left_pressure, passage.by_left_mass)


@inner_kernel
def _exchange(
    gas: Gas, width: float, discharge: float, pockets: RecordArray, low: int, high: int, dt: float, isentropic: bool
) -> None:
    """Add the flow through the faces between the pockets, and between pockets and the ambient, to the balances."""
    right = ambient(gas)
    for face in range(low, high + 1):
        left = right
        right = _side(pockets, face) if face < high else ambient(gas)
        mass, heat = passages(gas, left, right)
        opening = discharge * pockets[face].opening
        share = dt * opening / width
        pockets[face].mass_balance.flow, pockets[face].heat_balance.flow = opening * mass.flow, opening * heat.flow
        if face > low:
            _add_outflow(pockets[face - 1].mass_balance, share, mass)
            if not isentropic:
                _add_outflow(pockets[face - 1].heat_balance, share, heat)
        if face < high:
            _add_inflow(pockets[face].mass_balance, share, mass)
            if not isentropic:
                _add_inflow(pockets[face].heat_balance, share, heat)


@inner_kernel
def _add_outflow(balance: Any, share: float, passage: Passage) -> None:
    """Add the outflow through the upper face of a pocket to the balance of this pocket."""
    balance.residual += share * passage.flow
    _add(balance.diagonal, share, passage.by_left_pressure, passage.by_left_mass)
    _add(balance.upper, share, passage.by_right_pressure, passage.by_right_mass)


@inner_kernel
def _add_inflow(balance: Any, share: float, passage: Passage) -> None:
    """Add the flow that enters a pocket through its lower face to the balance of this pocket."""
    balance.residual -= share * passage.flow
    _add(balance.diagonal, -share, passage.by_right_pressure, passage.by_right_mass)
    _add(balance.lower, -share, passage.by_left_pressure, passage.by_left_mass)


@inner_kernel
def _eliminate(pockets: RecordArray, low: int, high: int) -> None:
    """Newton's correction by elimination of the 2 x 2 blocks along the chain.

    After the forward pass `mass_balance` holds the equation of the pressure and `heat_balance` that of the mass; the
    backward pass evaluates them.
    """
    for i in range(low, high):
        mass, heat = pockets[i].mass_balance, pockets[i].heat_balance
        if i > low:
            _substitute(mass, pockets[i - 1].mass_balance, pockets[i - 1].heat_balance)
            _substitute(heat, pockets[i - 1].mass_balance, pockets[i - 1].heat_balance)
        a, b, c, d = mass.diagonal.by_pressure, mass.diagonal.by_mass, heat.diagonal.by_pressure, heat.diagonal.by_mass
        scale = 1.0 / (a * d - b * c)
        one, other = mass.upper.by_pressure, heat.upper.by_pressure
        mass.upper.by_pressure, heat.upper.by_pressure = scale * (d * one - b * other), scale * (a * other - c * one)
        one, other = mass.upper.by_mass, heat.upper.by_mass
        mass.upper.by_mass, heat.upper.by_mass = scale * (d * one - b * other), scale * (a * other - c * one)
        one, other = mass.residual, heat.residual
        mass.residual, heat.residual = scale * (d * one - b * other), scale * (a * other - c * one)
    for i in range(high - 1, low - 1, -1):
        mass, heat, correction = pockets[i].mass_balance, pockets[i].heat_balance, pockets[i].correction
        correction.pressure, correction.mass = -mass.residual, -heat.residual
        if i < high - 1:
            above = pockets[i + 1].correction
            correction.pressure -= mass.upper.by_pressure * above.pressure + mass.upper.by_mass * above.mass
            correction.mass -= heat.upper.by_pressure * above.pressure + heat.upper.by_mass * above.mass


@inner_kernel
def _substitute(balance: Any, pressure: Any, mass: Any) -> None:
    """Eliminate the pocket below from a balance, by its equations `pressure` and `mass`."""
    p, m = balance.lower.by_pressure, balance.lower.by_mass
    balance.diagonal.by_pressure -= p * pressure.upper.by_pressure + m * mass.upper.by_pressure
    balance.diagonal.by_mass -= p * pressure.upper.by_mass + m * mass.upper.by_mass
    balance.residual -= p * pressure.residual + m * mass.residual
