"""One implicit time step of a chain of pockets: mass and energy of each, exchanged by nozzle flow.

 dm_i/dt = M_{i-1/2} - M_{i+1/2} - Q_i                                    (Eq. 3, with the density in the radial term)
 dE_i/dt = (M h)_{i-1/2} - (M h)_{i+1/2} - (Q h)_i - p dV/dt              energy closure, h = c_p T upstream
 p = p_e (rho/rho_e)^gamma                                                isentropic closure (Eq. 1)

Backward Euler, the wall work with the mean pressure of the step; Newton's method on pressure and mass of all pockets,
its blocks of two by two eliminated along the chain. All amounts are per metre of face.
"""

from typing import Any, NamedTuple

import numpy as np

from solvers.arrays import Fields, RecordArray, floats, records
from solvers.compiled import kernel
from solvers.pumping.flow.nozzle import Gas, mass_flux

_NEWTON_LIMIT = 200  # limit; a step that has not converged by then does not
_TOLERANCE = 1e-10  # of a pocket's content at ambient pressure
_ROUNDING = 1e-7  # residual accepted once Newton's method no longer lowers it: pressures differ by round-off only
_HALVINGS = 12  # a step of 1/4096 of Newton's no longer helps


STATE = floats("pressure", "mass")
"""State of a pocket or step of Newton's method: pressure [Pa] and mass [kg/m]."""

ROW = floats("by_pressure", "by_mass")
"""Derivatives of a residual by the pressure and the mass of a pocket."""

BALANCE: Fields = [*floats("flow", "leak", "residual"), ("lower", ROW), ("diagonal", ROW), ("upper", ROW)]
"""Balance of mass or of heat of a pocket.

Flow through the face below it towards the high end [kg/s or W], leakage outwards [kg/(s m) or W/m], residual of
Newton's method [kg/m or J/m] and its derivatives by the pocket below, the pocket itself and the one above.
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

State at the start and the end of a step, trial state and correction of Newton's method; both balances; area at the
start and the end of the step [m^2], radial gap [m] and section of the face [m^2] at its end.
"""


def empty_pockets(pockets: int) -> RecordArray:
    """An array of POCKET for so many pockets and the face above the last."""
    return records(pockets + 1, POCKET)


class Side(NamedTuple):
    """A side of an opening: pressure [Pa], mass [kg/m] and section [m^2] of a pocket, or of one of ambient gas."""

    pressure: float
    mass: float
    area: float


class Passage(NamedTuple):
    """What passes an opening from left to right, and its derivatives by the pressure and mass on both sides."""

    flow: float
    by_left_pressure: float
    by_left_mass: float
    by_right_pressure: float
    by_right_mass: float


@kernel
def ambient(gas: Gas) -> Side:
    """The side of ambient gas."""
    return Side(gas.pressure, gas.density, 1.0)


@kernel
def passages(gas: Gas, left: Side, right: Side) -> tuple[Passage, Passage]:
    """Mass and heat per open area from the side of the higher pressure to the other, at the temperature of the first.

    Per unit of mass the heat is that of its source, c_p T = c_p p A/(m R).
    """
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


@kernel
def advance(
    gas: Gas, width: float, discharge: float, pockets: RecordArray, low: int, high: int, dt: float, isentropic: bool
) -> tuple[bool, float]:
    """Pressure and mass of the pockets low..high after dt [s]; whether Newton's method converged, and its residual.

    `width` of a pocket [m], `discharge` coefficient of all openings. Eqs. 1, 3, P5.
    """
    error, share, halvings, newton = np.inf, 0.0, 0, 0
    for i in range(low, high):
        pockets[i].new = pockets[i].old
        pockets[i].correction.pressure = pockets[i].correction.mass = 0.0
    while newton < _NEWTON_LIMIT:
        for i in range(low, high):
            pockets[i].trial.pressure = _stepped(pockets[i].new.pressure, share * pockets[i].correction.pressure)
            pockets[i].trial.mass = _stepped(pockets[i].new.mass, share * pockets[i].correction.mass)
        found = _assemble(gas, width, discharge, pockets, low, high, dt, isentropic)
        stalled = not found < error and halvings == _HALVINGS - 1
        if found < _TOLERANCE or (stalled and error < _ROUNDING):
            _settle(gas, width, pockets, low, high, dt, isentropic)
            return True, found
        if found < error or stalled:
            for i in range(low, high):
                pockets[i].new = pockets[i].trial
            _eliminate(pockets, low, high)
            error, share, halvings, newton = found, 1.0, 0, newton + 1
        else:
            share, halvings = 0.5 * share, halvings + 1
    return False, error


@kernel
def _stepped(value: float, change: float) -> float:
    """A positive value after a step of Newton's method that takes at most 80 % of it."""
    return value + max(change, -0.8 * value)


@kernel
def _settle(gas: Gas, width: float, pockets: RecordArray, low: int, high: int, dt: float, isentropic: bool) -> None:
    """Mass and pressure that follow from the converged flows exactly, so that mass and energy are conserved."""
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


@kernel
def _assemble(
    gas: Gas, width: float, discharge: float, pockets: RecordArray, low: int, high: int, dt: float, isentropic: bool
) -> float:
    """Flows, residuals and Jacobian of the trial; the largest residual relative to the ambient content."""
    error = 0.0
    _store(gas, pockets, low, high, isentropic)
    _leak(gas, discharge, pockets, low, high, dt, isentropic)
    _exchange(gas, width, discharge, pockets, low, high, dt, isentropic)
    for i in range(low, high):
        mass = gas.density * pockets[i].area
        energy = mass if isentropic else gas.pressure * pockets[i].area / (gas.exponent - 1.0)
        error = max(error, abs(pockets[i].mass_balance.residual) / mass, abs(pockets[i].heat_balance.residual) / energy)
    return error


@kernel
def _store(gas: Gas, pockets: RecordArray, low: int, high: int, isentropic: bool) -> None:
    """Set the residuals and blocks of closed pockets: kept mass, and kept energy less wall work or kept entropy."""
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


@kernel
def _clear(balance: Any) -> None:
    """Set the derivatives of a balance to 0."""
    balance.lower.by_pressure = balance.lower.by_mass = 0.0
    balance.diagonal.by_pressure = balance.diagonal.by_mass = 0.0
    balance.upper.by_pressure = balance.upper.by_mass = 0.0


@kernel
def _side(pockets: RecordArray, i: int) -> Side:
    return Side(pockets[i].trial.pressure, pockets[i].trial.mass, pockets[i].area)


@kernel
def _add(row: Any, share: float, by_pressure: float, by_mass: float) -> None:
    """Add to a row of derivatives."""
    row.by_pressure += share * by_pressure
    row.by_mass += share * by_mass


@kernel
def _leak(gas: Gas, discharge: float, pockets: RecordArray, low: int, high: int, dt: float, isentropic: bool) -> None:
    """Flow through the radial gaps."""
    for i in range(low, high):
        opening = discharge * pockets[i].gap
        mass, heat = passages(gas, _side(pockets, i), ambient(gas))
        _lose(pockets[i].mass_balance, opening, dt, mass, counts=True)
        _lose(pockets[i].heat_balance, opening, dt, heat, counts=not isentropic)


@kernel
def _lose(balance: Any, opening: float, dt: float, passage: Passage, counts: bool) -> None:
    """What leaves a pocket through its radial gap, in a balance that counts or is recorded only."""
    balance.leak = opening * passage.flow
    if counts:
        share = dt * opening
        balance.residual += share * passage.flow
        _add(balance.diagonal, share, passage.by_left_pressure, passage.by_left_mass)


@kernel
def _exchange(
    gas: Gas, width: float, discharge: float, pockets: RecordArray, low: int, high: int, dt: float, isentropic: bool
) -> None:
    """Flow through the faces between two pockets, and between a pocket and the ambient."""
    right = ambient(gas)
    for face in range(low, high + 1):
        left = right
        right = _side(pockets, face) if face < high else ambient(gas)
        mass, heat = passages(gas, left, right)
        opening = discharge * pockets[face].opening
        share = dt * opening / width
        pockets[face].mass_balance.flow, pockets[face].heat_balance.flow = opening * mass.flow, opening * heat.flow
        if face > low:
            _flow_out(pockets[face - 1].mass_balance, share, mass)
            if not isentropic:
                _flow_out(pockets[face - 1].heat_balance, share, heat)
        if face < high:
            _flow_in(pockets[face].mass_balance, share, mass)
            if not isentropic:
                _flow_in(pockets[face].heat_balance, share, heat)


@kernel
def _flow_out(balance: Any, share: float, passage: Passage) -> None:
    """What leaves a pocket through the face above it."""
    balance.residual += share * passage.flow
    _add(balance.diagonal, share, passage.by_left_pressure, passage.by_left_mass)
    _add(balance.upper, share, passage.by_right_pressure, passage.by_right_mass)


@kernel
def _flow_in(balance: Any, share: float, passage: Passage) -> None:
    """What enters a pocket through the face below it."""
    balance.residual -= share * passage.flow
    _add(balance.diagonal, -share, passage.by_right_pressure, passage.by_right_mass)
    _add(balance.lower, -share, passage.by_left_pressure, passage.by_left_mass)


@kernel
def _eliminate(pockets: RecordArray, low: int, high: int) -> None:
    """Newton's correction by elimination of the blocks along the chain.

    Once a pocket is solved for, the upper rows and the residuals of its balances belong to its pressure and its mass.
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


@kernel
def _substitute(balance: Any, pressure: Any, mass: Any) -> None:
    """Take the pocket below, solved for its pressure and mass in its two balances, out of a balance."""
    p, m = balance.lower.by_pressure, balance.lower.by_mass
    balance.diagonal.by_pressure -= p * pressure.upper.by_pressure + m * mass.upper.by_pressure
    balance.diagonal.by_mass -= p * pressure.upper.by_mass + m * mass.upper.by_mass
    balance.residual -= p * pressure.residual + m * mass.residual
