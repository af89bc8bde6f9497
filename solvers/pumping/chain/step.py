"""One implicit time step of a chain of pockets: mass and energy of each, exchanged by nozzle flow.

 dm_i/dt = M_{i-1/2} - M_{i+1/2} - Q_i                                    (Eq. 3, with the density in the radial term)
 dE_i/dt = (M h)_{i-1/2} - (M h)_{i+1/2} - (Q h)_i - p dV/dt              energy closure, h = c_p T upstream
 p = p_e (rho/rho_e)^gamma                                                isentropic closure (Eq. 1)

Backward Euler, the wall work with the mean pressure of the step; Newton's method on pressure and mass of all pockets,
its blocks of two by two eliminated along the chain. All amounts are per metre of face.
"""

from typing import NamedTuple

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.pumping.chain.pockets import CONTENT, END, HEAT, MASS, PRESSURE, START, Pockets
from solvers.pumping.flow.duct import Duct
from solvers.pumping.flow.nozzle import Gas, mass_flux

_NEWTON_LIMIT = 200
_TOLERANCE = 1e-10
_ROUNDING = 1e-7  # residual accepted once Newton's method no longer lowers it: pressures differ by round-off only
_HALVINGS = 12


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
def advance(gas: Gas, duct: Duct, pockets: Pockets, low: int, high: int, dt: float, isentropic: bool) -> bool:
    """Pressure and mass of the pockets low..high after dt [s]; whether Newton's method converged."""
    for i in range(low, high):
        pockets.new[i, PRESSURE], pockets.new[i, CONTENT] = pockets.old[i, PRESSURE], pockets.old[i, CONTENT]
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
            pockets.new[i, PRESSURE], pockets.new[i, CONTENT] = pockets.trial[i, PRESSURE], pockets.trial[i, CONTENT]
        error = trial_error
    return False


@kernel
def _settle(gas: Gas, duct: Duct, pockets: Pockets, low: int, high: int, dt: float, isentropic: bool) -> None:
    """Mass and pressure that follow from the converged flows exactly, so that the books close."""
    g = gas.exponent
    for i in range(low, high):
        old_area, area = pockets.area[i]
        mass = (pockets.flow[i, MASS] - pockets.flow[i + 1, MASS]) / duct.width - pockets.leak[i, MASS]
        heat = (pockets.flow[i, HEAT] - pockets.flow[i + 1, HEAT]) / duct.width - pockets.leak[i, HEAT]
        pockets.new[i, CONTENT] = pockets.old[i, CONTENT] + dt * mass
        if isentropic:
            pockets.new[i, PRESSURE] = gas.pressure * (pockets.new[i, CONTENT] / (gas.density * area)) ** g
        else:
            work = 0.5 * (area - old_area)
            energy = pockets.old[i, PRESSURE] * (old_area / (g - 1.0) - work) + dt * heat
            pockets.new[i, PRESSURE] = energy / (area / (g - 1.0) + work)


@kernel
def _ambient(gas: Gas) -> Side:
    return Side(gas.pressure, gas.density, 1.0)


@kernel
def _passages(gas: Gas, left: Side, right: Side) -> tuple[Passage, Passage]:
    """Mass and heat per open area from the side of the higher pressure to the other, at the temperature of the first.

    Per unit of mass the heat is that of its source, c_p T = c_p p A/(m R).
    """
    forward = left.pressure >= right.pressure
    source, sink = (left, right) if forward else (right, left)
    temperature = source.pressure * source.area / (source.mass * gas.constant)
    flux, by_upstream, by_p_sink = mass_flux(gas, source.pressure, temperature, sink.pressure)
    by_p, by_m = by_upstream - 0.5 * flux / source.pressure, 0.5 * flux / source.mass
    heat = gas.heat_capacity * temperature
    energy, energy_by_p_sink = flux * heat, by_p_sink * heat
    energy_by_p, energy_by_m = by_p * heat + energy / source.pressure, by_m * heat - energy / source.mass
    if forward:
        return Passage(flux, by_p, by_m, by_p_sink, 0.0), Passage(
            energy, energy_by_p, energy_by_m, energy_by_p_sink, 0.0
        )
    return Passage(-flux, -by_p_sink, 0.0, -by_p, -by_m), Passage(
        -energy, -energy_by_p_sink, 0.0, -energy_by_p, -energy_by_m
    )


@kernel
def _assemble(
    gas: Gas, duct: Duct, pockets: Pockets, x: FloatArray, low: int, high: int, dt: float, isentropic: bool
) -> float:
    """Flows, residuals and Jacobian at pressures and masses x; the largest residual relative to the ambient content."""
    g, areas, residual = gas.exponent, pockets.area, pockets.residual
    error = 0.0
    _store(gas, pockets, x, low, high, isentropic)
    _leak(gas, duct, pockets, x, low, high, dt, isentropic)
    _exchange(gas, duct, pockets, x, low, high, dt, isentropic)
    for i in range(low, high):
        mass = gas.density * areas[i, END]
        energy = mass if isentropic else gas.pressure * areas[i, END] / (g - 1.0)
        error = max(error, abs(residual[i, MASS]) / mass, abs(residual[i, HEAT]) / energy)
    return error


@kernel
def _store(gas: Gas, pockets: Pockets, x: FloatArray, low: int, high: int, isentropic: bool) -> None:
    """What closed pockets keep: mass, and energy less wall work or entropy."""
    g = gas.exponent
    old, areas, residual = pockets.old, pockets.area, pockets.residual
    lower, block, upper = pockets.lower, pockets.diagonal, pockets.upper
    for i in range(low, high):
        p, old_area, area = x[i, PRESSURE], areas[i, START], areas[i, END]
        for row in range(2):
            for column in range(2):
                lower[i, row, column], upper[i, row, column] = 0.0, 0.0
        residual[i, MASS] = x[i, CONTENT] - old[i, CONTENT]
        block[i, MASS, PRESSURE], block[i, MASS, CONTENT] = 0.0, 1.0
        if isentropic:
            mass = gas.density * area * (p / gas.pressure) ** (1.0 / g)
            residual[i, HEAT] = x[i, CONTENT] - mass
            block[i, HEAT, PRESSURE], block[i, HEAT, CONTENT] = -mass / (g * p), 1.0
        else:
            work = 0.5 * (area - old_area)
            residual[i, HEAT] = p * (area / (g - 1.0) + work) - old[i, PRESSURE] * (old_area / (g - 1.0) - work)
            block[i, HEAT, PRESSURE], block[i, HEAT, CONTENT] = area / (g - 1.0) + work, 0.0


@kernel
def _leak(
    gas: Gas, duct: Duct, pockets: Pockets, x: FloatArray, low: int, high: int, dt: float, isentropic: bool
) -> None:
    """Flow through the radial gaps."""
    area, gap, leak = pockets.area, pockets.gap, pockets.leak
    residual, diagonal = pockets.residual, pockets.diagonal
    rows = 1 if isentropic else 2
    for i in range(low, high):
        opening = duct.discharge * gap[i]
        passages = _passages(gas, Side(x[i, PRESSURE], x[i, CONTENT], area[i, END]), _ambient(gas))
        for row in range(2):
            leak[i, row] = opening * passages[row].flow
        for row in range(rows):
            passage = passages[row]
            residual[i, row] += dt * opening * passage.flow
            diagonal[i, row, PRESSURE] += dt * opening * passage.by_left_pressure
            diagonal[i, row, CONTENT] += dt * opening * passage.by_left_mass


@kernel
def _exchange(
    gas: Gas, duct: Duct, pockets: Pockets, x: FloatArray, low: int, high: int, dt: float, isentropic: bool
) -> None:
    """Flow through the faces between two pockets, and between a pocket and the ambient."""
    area, openings, flow, residual = pockets.area, pockets.opening, pockets.flow, pockets.residual
    lower, diagonal, upper = pockets.lower, pockets.diagonal, pockets.upper
    rows = 1 if isentropic else 2
    right = _ambient(gas)
    for face in range(low, high + 1):
        before, left = face - 1, right
        right = Side(x[face, PRESSURE], x[face, CONTENT], area[face, END]) if face < high else _ambient(gas)
        passages = _passages(gas, left, right)
        opening = duct.discharge * openings[face]
        share = dt * opening / duct.width
        for row in range(2):
            flow[face, row] = opening * passages[row].flow
        for row in range(rows):
            passage = passages[row]
            if face > low:
                residual[before, row] += share * passage.flow
                diagonal[before, row, PRESSURE] += share * passage.by_left_pressure
                diagonal[before, row, CONTENT] += share * passage.by_left_mass
                upper[before, row, PRESSURE] += share * passage.by_right_pressure
                upper[before, row, CONTENT] += share * passage.by_right_mass
            if face < high:
                residual[face, row] -= share * passage.flow
                diagonal[face, row, PRESSURE] -= share * passage.by_right_pressure
                diagonal[face, row, CONTENT] -= share * passage.by_right_mass
                lower[face, row, PRESSURE] -= share * passage.by_left_pressure
                lower[face, row, CONTENT] -= share * passage.by_left_mass


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
