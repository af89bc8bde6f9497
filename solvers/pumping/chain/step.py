"""One implicit time step of a chain of pockets: mass and energy of each, exchanged by nozzle flow.

 dm_i/dt = M_{i-1/2} - M_{i+1/2} - Q_i                                    (Eq. 3, with the density in the radial term)
 dE_i/dt = (M h)_{i-1/2} - (M h)_{i+1/2} - (Q h)_i - p dV/dt              energy closure, h = c_p T upstream
 p = p_e (rho/rho_e)^gamma                                                isentropic closure (Eq. 1)

Backward Euler, the wall work with the mean pressure of the step; Newton's method on pressure and mass of all pockets,
its blocks of two by two eliminated along the chain. All amounts are per metre of face.
"""

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.pumping.chain.passages import Side, ambient, passages
from solvers.pumping.chain.pockets import (
    AREA,
    CONTENT,
    CORRECTION,
    DIAGONAL,
    END,
    FLOW,
    GAP,
    HEAT,
    LEAK,
    LOWER,
    MASS,
    NEW,
    OLD,
    OPENING,
    PRESSURE,
    RESIDUAL,
    START,
    TRIAL,
    UPPER,
)
from solvers.pumping.flow.nozzle import Gas

_NEWTON_LIMIT = 200
_TOLERANCE = 1e-10
_ROUNDING = 1e-7  # residual accepted once Newton's method no longer lowers it: pressures differ by round-off only
_HALVINGS = 12


@kernel
def advance(
    gas: Gas, width: float, discharge: float, pockets: FloatArray, low: int, high: int, dt: float, isentropic: bool
) -> tuple[bool, float]:
    """Pressure and mass of the pockets low..high after dt [s]; whether Newton's method converged, and its residual.

    `width` of a pocket [m], `discharge` coefficient of all openings.
    """
    error, share, halvings, newton = np.inf, 0.0, 0, 0
    for i in range(low, high):
        for k in range(2):
            pockets[i, NEW + k], pockets[i, CORRECTION + k] = pockets[i, OLD + k], 0.0
    while newton < _NEWTON_LIMIT:
        for i in range(low, high):
            for k in range(2):
                change = max(share * pockets[i, CORRECTION + k], -0.8 * pockets[i, NEW + k])
                pockets[i, TRIAL + k] = pockets[i, NEW + k] + change
        found = _assemble(gas, width, discharge, pockets, low, high, dt, isentropic)
        stalled = not found < error and halvings == _HALVINGS - 1
        if found < _TOLERANCE or (stalled and error < _ROUNDING):
            _settle(gas, width, pockets, low, high, dt, isentropic)
            return True, found
        if found < error or stalled:
            for i in range(low, high):
                for k in range(2):
                    pockets[i, NEW + k] = pockets[i, TRIAL + k]
            _eliminate(pockets, low, high)
            error, share, halvings, newton = found, 1.0, 0, newton + 1
        else:
            share, halvings = 0.5 * share, halvings + 1
    return False, error


@kernel
def _settle(gas: Gas, width: float, pockets: FloatArray, low: int, high: int, dt: float, isentropic: bool) -> None:
    """Mass and pressure that follow from the converged flows exactly, so that the books close."""
    g = gas.exponent
    for i in range(low, high):
        old_area, area = pockets[i, AREA + START], pockets[i, AREA + END]
        mass = (pockets[i, FLOW + MASS] - pockets[i + 1, FLOW + MASS]) / width - pockets[i, LEAK + MASS]
        heat = (pockets[i, FLOW + HEAT] - pockets[i + 1, FLOW + HEAT]) / width - pockets[i, LEAK + HEAT]
        content = pockets[i, OLD + CONTENT] + dt * mass
        pockets[i, NEW + CONTENT] = content
        if isentropic:
            pockets[i, NEW + PRESSURE] = gas.pressure * (content / (gas.density * area)) ** g
        else:
            work = 0.5 * (area - old_area)
            energy = pockets[i, OLD + PRESSURE] * (old_area / (g - 1.0) - work) + dt * heat
            pockets[i, NEW + PRESSURE] = energy / (area / (g - 1.0) + work)


@kernel
def _assemble(
    gas: Gas, width: float, discharge: float, pockets: FloatArray, low: int, high: int, dt: float, isentropic: bool
) -> float:
    """Flows, residuals and Jacobian of the trial; the largest residual relative to the ambient content."""
    error = 0.0
    _store(gas, pockets, low, high, isentropic)
    _leak(gas, discharge, pockets, low, high, dt, isentropic)
    _exchange(gas, width, discharge, pockets, low, high, dt, isentropic)
    for i in range(low, high):
        mass = gas.density * pockets[i, AREA + END]
        energy = mass if isentropic else gas.pressure * pockets[i, AREA + END] / (gas.exponent - 1.0)
        error = max(error, abs(pockets[i, RESIDUAL + MASS]) / mass, abs(pockets[i, RESIDUAL + HEAT]) / energy)
    return error


@kernel
def _store(gas: Gas, pockets: FloatArray, low: int, high: int, isentropic: bool) -> None:
    """What closed pockets keep: mass, and energy less wall work or entropy."""
    g = gas.exponent
    for i in range(low, high):
        p, content = pockets[i, TRIAL + PRESSURE], pockets[i, TRIAL + CONTENT]
        old_area, area = pockets[i, AREA + START], pockets[i, AREA + END]
        pockets[i, LOWER : UPPER + 4] = 0.0
        pockets[i, RESIDUAL + MASS] = content - pockets[i, OLD + CONTENT]
        pockets[i, DIAGONAL + 2 * MASS + CONTENT] = 1.0
        if isentropic:
            mass = gas.density * area * (p / gas.pressure) ** (1.0 / g)
            pockets[i, RESIDUAL + HEAT] = content - mass
            pockets[i, DIAGONAL + 2 * HEAT + PRESSURE] = -mass / (g * p)
            pockets[i, DIAGONAL + 2 * HEAT + CONTENT] = 1.0
        else:
            work = 0.5 * (area - old_area)
            kept = pockets[i, OLD + PRESSURE] * (old_area / (g - 1.0) - work)
            pockets[i, RESIDUAL + HEAT] = p * (area / (g - 1.0) + work) - kept
            pockets[i, DIAGONAL + 2 * HEAT + PRESSURE] = area / (g - 1.0) + work


@kernel
def _side(pockets: FloatArray, i: int) -> Side:
    return Side(pockets[i, TRIAL + PRESSURE], pockets[i, TRIAL + CONTENT], pockets[i, AREA + END])


@kernel
def _add(pockets: FloatArray, i: int, block: int, row: int, share: float, by_pressure: float, by_mass: float) -> None:
    """Add to a row of one of a pocket's blocks."""
    pockets[i, block + 2 * row + PRESSURE] += share * by_pressure
    pockets[i, block + 2 * row + CONTENT] += share * by_mass


@kernel
def _leak(gas: Gas, discharge: float, pockets: FloatArray, low: int, high: int, dt: float, isentropic: bool) -> None:
    """Flow through the radial gaps."""
    for i in range(low, high):
        opening = discharge * pockets[i, GAP]
        both = passages(gas, _side(pockets, i), ambient(gas))
        for row in range(2):
            passage = both[row]
            pockets[i, LEAK + row] = opening * passage.flow
            if row == MASS or not isentropic:
                share = dt * opening
                pockets[i, RESIDUAL + row] += share * passage.flow
                _add(pockets, i, DIAGONAL, row, share, passage.by_left_pressure, passage.by_left_mass)


@kernel
def _exchange(
    gas: Gas, width: float, discharge: float, pockets: FloatArray, low: int, high: int, dt: float, isentropic: bool
) -> None:
    """Flow through the faces between two pockets, and between a pocket and the ambient."""
    right = ambient(gas)
    for face in range(low, high + 1):
        before, left = face - 1, right
        right = _side(pockets, face) if face < high else ambient(gas)
        both = passages(gas, left, right)
        opening = discharge * pockets[face, OPENING]
        share = dt * opening / width
        for row in range(2):
            passage = both[row]
            pockets[face, FLOW + row] = opening * passage.flow
            if row == HEAT and isentropic:
                continue
            if face > low:
                pockets[before, RESIDUAL + row] += share * passage.flow
                _add(pockets, before, DIAGONAL, row, share, passage.by_left_pressure, passage.by_left_mass)
                _add(pockets, before, UPPER, row, share, passage.by_right_pressure, passage.by_right_mass)
            if face < high:
                pockets[face, RESIDUAL + row] -= share * passage.flow
                _add(pockets, face, DIAGONAL, row, -share, passage.by_right_pressure, passage.by_right_mass)
                _add(pockets, face, LOWER, row, -share, passage.by_left_pressure, passage.by_left_mass)


@kernel
def _eliminate(pockets: FloatArray, low: int, high: int) -> None:
    """Newton's correction by elimination of the blocks along the chain."""
    t, d, u, r = pockets, DIAGONAL, UPPER, RESIDUAL
    for i in range(low, high):
        if i > low:  # upper block and residual of the pocket before are already solved for
            for row in range(2):
                by_pressure, by_mass = t[i, LOWER + 2 * row], t[i, LOWER + 2 * row + 1]
                for column in range(2):
                    t[i, d + 2 * row + column] -= (
                        by_pressure * t[i - 1, u + column] + by_mass * t[i - 1, u + 2 + column]
                    )
                t[i, r + row] -= by_pressure * t[i - 1, r] + by_mass * t[i - 1, r + 1]
        a, b, c, e = t[i, d], t[i, d + 1], t[i, d + 2], t[i, d + 3]
        scale = 1.0 / (a * e - b * c)
        for first, second in ((u, u + 2), (u + 1, u + 3), (r, r + 1)):
            one, other = t[i, first], t[i, second]
            t[i, first], t[i, second] = scale * (e * one - b * other), scale * (a * other - c * one)
    for i in range(high - 1, low - 1, -1):
        for row in range(2):
            t[i, CORRECTION + row] = -t[i, r + row]
            if i < high - 1:
                t[i, CORRECTION + row] -= (
                    t[i, u + 2 * row] * t[i + 1, CORRECTION] + t[i, u + 2 * row + 1] * t[i + 1, CORRECTION + 1]
                )
