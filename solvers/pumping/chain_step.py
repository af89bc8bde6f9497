"""One implicit time step of a chain of pockets: mass and energy of each, exchanged by nozzle flow.

 dm_i/dt = M_{i-1/2} - M_{i+1/2} - Q_i                                    (Eq. 3, with the density in the radial term)
 dE_i/dt = (M h)_{i-1/2} - (M h)_{i+1/2} - (Q h)_i - p dV/dt              energy closure, h = c_p T upstream
 p = p_e (rho/rho_e)^gamma                                                isentropic closure (Eq. 1)

Backward Euler, the wall work with the mean pressure of the step; Newton's method on pressure and mass of all pockets,
its blocks of two by two eliminated along the chain. All amounts are per metre of face.
"""

from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.pumping.duct import Duct
from solvers.pumping.nozzle import Gas, mass_flux

_NEWTON_LIMIT = 200
_TOLERANCE = 1e-10
_ROUNDING = 1e-7  # residual accepted once Newton's method no longer lowers it: pressures differ by round-off only
_HALVINGS = 12


class Pockets(NamedTuple):
    """Arrays of a chain.

    `old` and `new` (pockets, 2): pressure [Pa], mass [kg/m]; `area` (pockets, 2) at the start and the end of the step
    [m^2] and `gap` [m] at its end; `opening` (faces) [m^2]; `flow` (faces, 2) mass and heat towards the high end
    [kg/s, W], `leak` (pockets, 2) outwards [kg/(s m), W/m]; `residual` (pockets, 2), `lower`, `diagonal`, `upper`
    (pockets, 2, 2) and `correction` (pockets, 2) of Newton's method, `trial` (pockets, 2) its candidate, `error` (1,)
    its largest residual relative to the ambient content.
    """

    old: FloatArray
    new: FloatArray
    area: FloatArray
    gap: FloatArray
    opening: FloatArray
    flow: FloatArray
    leak: FloatArray
    residual: FloatArray
    lower: FloatArray
    diagonal: FloatArray
    upper: FloatArray
    correction: FloatArray
    trial: FloatArray
    error: FloatArray


def empty_pockets(pockets: int) -> Pockets:
    """Arrays for so many pockets."""
    two, blocks = (pockets, 2), (pockets, 2, 2)
    faces = pockets + 1
    shapes = [two, two, two, (pockets,), (faces,), (faces, 2), two, two, blocks, blocks, blocks, two, two, (1,)]
    return Pockets(*[np.zeros(shape) for shape in shapes])


@kernel
def advance(gas: Gas, duct: Duct, pockets: Pockets, low: int, high: int, dt: float, isentropic: bool) -> bool:
    """Pressure and mass of the pockets low..high after dt [s]; whether Newton's method converged."""
    for i in range(low, high):
        pockets.new[i, 0], pockets.new[i, 1] = pockets.old[i, 0], pockets.old[i, 1]
    error = _assemble(gas, duct, pockets, pockets.new, low, high, dt, isentropic)
    for _ in range(_NEWTON_LIMIT):
        pockets.error[0] = error
        if error < _TOLERANCE:
            _settle(gas, duct, pockets, low, high, dt, isentropic)
            return True
        _eliminate(pockets, low, high)
        share = 1.0
        for _ in range(_HALVINGS):
            for i in range(low, high):
                for k in range(2):
                    change = max(share * pockets.correction[i, k], -0.8 * pockets.new[i, k])
                    pockets.trial[i, k] = pockets.new[i, k] + change
            trial_error = _assemble(gas, duct, pockets, pockets.trial, low, high, dt, isentropic)
            if trial_error < error:
                break
            share *= 0.5
        if trial_error >= error and error < _ROUNDING:
            _assemble(gas, duct, pockets, pockets.new, low, high, dt, isentropic)
            _settle(gas, duct, pockets, low, high, dt, isentropic)
            return True
        for i in range(low, high):
            pockets.new[i, 0], pockets.new[i, 1] = pockets.trial[i, 0], pockets.trial[i, 1]
        error = trial_error
    return False


@kernel
def _settle(gas: Gas, duct: Duct, pockets: Pockets, low: int, high: int, dt: float, isentropic: bool) -> None:
    """Mass and pressure that follow from the converged flows exactly, so that the books close."""
    g = gas.exponent
    for i in range(low, high):
        old_area, area = pockets.area[i]
        mass = (pockets.flow[i, 0] - pockets.flow[i + 1, 0]) / duct.width - pockets.leak[i, 0]
        heat = (pockets.flow[i, 1] - pockets.flow[i + 1, 1]) / duct.width - pockets.leak[i, 1]
        pockets.new[i, 1] = pockets.old[i, 1] + dt * mass
        if isentropic:
            pockets.new[i, 0] = gas.pressure * (pockets.new[i, 1] / (gas.density * area)) ** g
        else:
            work = 0.5 * (area - old_area)
            energy = pockets.old[i, 0] * (old_area / (g - 1.0) - work) + dt * heat
            pockets.new[i, 0] = energy / (area / (g - 1.0) + work)


@kernel
def _discharge(gas: Gas, p: float, m: float, area: float, downstream: float) -> tuple[float, float, float, float]:
    """Mass flux out of a pocket and its derivatives by the pocket's pressure and mass and the downstream pressure."""
    flux, by_p, by_down = mass_flux(gas, p, p * area / (m * gas.constant), downstream)
    return flux, by_p - 0.5 * flux / p, 0.5 * flux / m, by_down


@kernel
def _assemble(
    gas: Gas, duct: Duct, pockets: Pockets, x: FloatArray, low: int, high: int, dt: float, isentropic: bool
) -> float:
    """Flows, residuals and Jacobian at pressures and masses x; the largest residual relative to the ambient content."""
    g = gas.exponent
    error = 0.0
    _store(gas, pockets, x, low, high, isentropic)
    _leak(gas, duct, pockets, x, low, high, dt, isentropic)
    _exchange(gas, duct, pockets, x, low, high, dt, isentropic)
    for i in range(low, high):
        mass = gas.density * pockets.area[i, 1]
        energy = mass if isentropic else gas.pressure * pockets.area[i, 1] / (g - 1.0)
        error = max(error, abs(pockets.residual[i, 0]) / mass, abs(pockets.residual[i, 1]) / energy)
    return error


@kernel
def _store(gas: Gas, pockets: Pockets, x: FloatArray, low: int, high: int, isentropic: bool) -> None:
    """What closed pockets keep: mass, and energy less wall work or entropy."""
    g = gas.exponent
    residual, block = pockets.residual, pockets.diagonal
    for i in range(low, high):
        p, old_area, area = x[i, 0], pockets.area[i, 0], pockets.area[i, 1]
        for row in range(2):
            for column in range(2):
                pockets.lower[i, row, column], pockets.upper[i, row, column] = 0.0, 0.0
        residual[i, 0] = x[i, 1] - pockets.old[i, 1]
        block[i, 0, 0], block[i, 0, 1] = 0.0, 1.0
        if isentropic:
            mass = gas.density * area * (p / gas.pressure) ** (1.0 / g)
            residual[i, 1] = x[i, 1] - mass
            block[i, 1, 0], block[i, 1, 1] = -mass / (g * p), 1.0
        else:
            work = 0.5 * (area - old_area)
            residual[i, 1] = p * (area / (g - 1.0) + work) - pockets.old[i, 0] * (old_area / (g - 1.0) - work)
            block[i, 1, 0], block[i, 1, 1] = area / (g - 1.0) + work, 0.0


@kernel
def _leak(
    gas: Gas, duct: Duct, pockets: Pockets, x: FloatArray, low: int, high: int, dt: float, isentropic: bool
) -> None:
    """Flow through the radial gaps."""
    residual, block = pockets.residual, pockets.diagonal
    for i in range(low, high):
        p, m, area = x[i, 0], x[i, 1], pockets.area[i, 1]
        gap = duct.discharge * pockets.gap[i]
        if p >= gas.pressure:
            flux, by_p, by_m, _ = _discharge(gas, p, m, area, gas.pressure)
            heat = gas.heat_capacity * p * area / (m * gas.constant)
            heat_by_p, heat_by_m = heat / p, -heat / m
        else:
            inflow, _, by_down = mass_flux(gas, gas.pressure, gas.temperature, p)
            flux, by_p, by_m = -inflow, -by_down, 0.0
            heat, heat_by_p, heat_by_m = gas.heat_capacity * gas.temperature, 0.0, 0.0
        pockets.leak[i, 0], pockets.leak[i, 1] = gap * flux, gap * flux * heat
        residual[i, 0] += dt * gap * flux
        block[i, 0, 0] += dt * gap * by_p
        block[i, 0, 1] += dt * gap * by_m
        if not isentropic:
            residual[i, 1] += dt * gap * flux * heat
            block[i, 1, 0] += dt * gap * (by_p * heat + flux * heat_by_p)
            block[i, 1, 1] += dt * gap * (by_m * heat + flux * heat_by_m)


@kernel
def _exchange(
    gas: Gas, duct: Duct, pockets: Pockets, x: FloatArray, low: int, high: int, dt: float, isentropic: bool
) -> None:
    """Flow through the faces between two pockets, and between a pocket and the ambient."""
    for face in range(low, high + 1):
        left = x[face - 1, 0] if face > low else gas.pressure
        right = x[face, 0] if face < high else gas.pressure
        source, sink, direction = (face - 1, face, 1.0) if left >= right else (face, face - 1, -1.0)
        opening = duct.discharge * pockets.opening[face]
        upstream, downstream = max(left, right), min(left, right)
        if low <= source < high:
            area, m = pockets.area[source, 1], x[source, 1]
            flux, by_p, by_m, by_down = _discharge(gas, upstream, m, area, downstream)
            heat = gas.heat_capacity * upstream * area / (m * gas.constant)
            heat_by_p, heat_by_m = heat / upstream, -heat / m
        else:
            flux, by_p, by_down = mass_flux(gas, upstream, gas.temperature, downstream)
            heat, by_m, heat_by_p, heat_by_m = gas.heat_capacity * gas.temperature, 0.0, 0.0, 0.0
        pockets.flow[face, 0], pockets.flow[face, 1] = direction * opening * flux, direction * opening * flux * heat
        share = dt * opening / duct.width
        for end in range(2):
            i, sign = (source, share) if end == 0 else (sink, -share)
            if i < low or i >= high:
                continue
            own = pockets.diagonal
            other = pockets.upper if i == face - 1 else pockets.lower
            by_source, by_sink = (own, other) if end == 0 else (other, own)
            pockets.residual[i, 0] += sign * flux
            by_source[i, 0, 0] += sign * by_p
            by_source[i, 0, 1] += sign * by_m
            by_sink[i, 0, 0] += sign * by_down
            if not isentropic:
                pockets.residual[i, 1] += sign * flux * heat
                by_source[i, 1, 0] += sign * (by_p * heat + flux * heat_by_p)
                by_source[i, 1, 1] += sign * (by_m * heat + flux * heat_by_m)
                by_sink[i, 1, 0] += sign * by_down * heat


@kernel
def _eliminate(pockets: Pockets, low: int, high: int) -> None:
    """Newton's correction by elimination of the blocks along the chain."""
    d, u, l, r, x = pockets.diagonal, pockets.upper, pockets.lower, pockets.residual, pockets.correction
    for i in range(low, high):
        if i > low:  # upper block and residual of the pocket before are already solved for
            for row in range(2):
                for column in range(2):
                    d[i, row, column] -= l[i, row, 0] * u[i - 1, 0, column] + l[i, row, 1] * u[i - 1, 1, column]
                r[i, row] -= l[i, row, 0] * r[i - 1, 0] + l[i, row, 1] * r[i - 1, 1]
        a, b, c, e = d[i, 0, 0], d[i, 0, 1], d[i, 1, 0], d[i, 1, 1]
        scale = 1.0 / (a * e - b * c)
        for column in range(2):
            first, second = u[i, 0, column], u[i, 1, column]
            u[i, 0, column], u[i, 1, column] = scale * (e * first - b * second), scale * (a * second - c * first)
        first, second = r[i, 0], r[i, 1]
        r[i, 0], r[i, 1] = scale * (e * first - b * second), scale * (a * second - c * first)
    for i in range(high - 1, low - 1, -1):
        for row in range(2):
            x[i, row] = -r[i, row]
            if i < high - 1:
                x[i, row] -= u[i, row, 0] * x[i + 1, 0] + u[i, row, 1] * x[i + 1, 1]
