"""One implicit time step of a chain of pockets: mass and energy of each, exchanged by nozzle flow.

 dm_i/dt = M_{i-1/2} - M_{i+1/2} - Q_i                                    (Eq. 3, with the density in the radial term)
 dE_i/dt = (M h)_{i-1/2} - (M h)_{i+1/2} - (Q h)_i - p dV/dt              energy closure, h = c_p T upstream
 p = p_e (rho/rho_e)^gamma                                                isentropic closure (Eq. 1)

Backward Euler, the wall work with the mean pressure of the step; Newton's method on pressure and mass of all pockets,
its blocks of two by two eliminated along the chain. All amounts are per metre of face.
"""

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.pumping.chain.pockets import CONTENT, END, HEAT, MASS, PRESSURE, START, Pockets
from solvers.pumping.flow.duct import Duct
from solvers.pumping.flow.nozzle import Gas, mass_flux

_NEWTON_LIMIT = 200
_TOLERANCE = 1e-10
_ROUNDING = 1e-7  # residual accepted once Newton's method no longer lowers it: pressures differ by round-off only
_HALVINGS = 12


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
        mass = gas.density * pockets.area[i, END]
        energy = mass if isentropic else gas.pressure * pockets.area[i, END] / (g - 1.0)
        error = max(error, abs(pockets.residual[i, MASS]) / mass, abs(pockets.residual[i, HEAT]) / energy)
    return error


@kernel
def _store(gas: Gas, pockets: Pockets, x: FloatArray, low: int, high: int, isentropic: bool) -> None:
    """What closed pockets keep: mass, and energy less wall work or entropy."""
    g = gas.exponent
    residual, block = pockets.residual, pockets.diagonal
    for i in range(low, high):
        p, old_area, area = x[i, PRESSURE], pockets.area[i, START], pockets.area[i, END]
        for row in range(2):
            for column in range(2):
                pockets.lower[i, row, column], pockets.upper[i, row, column] = 0.0, 0.0
        residual[i, MASS] = x[i, CONTENT] - pockets.old[i, CONTENT]
        block[i, MASS, PRESSURE], block[i, MASS, CONTENT] = 0.0, 1.0
        if isentropic:
            mass = gas.density * area * (p / gas.pressure) ** (1.0 / g)
            residual[i, HEAT] = x[i, CONTENT] - mass
            block[i, HEAT, PRESSURE], block[i, HEAT, CONTENT] = -mass / (g * p), 1.0
        else:
            work = 0.5 * (area - old_area)
            residual[i, HEAT] = p * (area / (g - 1.0) + work) - pockets.old[i, PRESSURE] * (old_area / (g - 1.0) - work)
            block[i, HEAT, PRESSURE], block[i, HEAT, CONTENT] = area / (g - 1.0) + work, 0.0


@kernel
def _leak(
    gas: Gas, duct: Duct, pockets: Pockets, x: FloatArray, low: int, high: int, dt: float, isentropic: bool
) -> None:
    """Flow through the radial gaps."""
    residual, block = pockets.residual, pockets.diagonal
    for i in range(low, high):
        p, m, area = x[i, PRESSURE], x[i, CONTENT], pockets.area[i, END]
        gap = duct.discharge * pockets.gap[i]
        if p >= gas.pressure:
            flux, by_p, by_m, _ = _discharge(gas, p, m, area, gas.pressure)
            heat = gas.heat_capacity * p * area / (m * gas.constant)
            heat_by_p, heat_by_m = heat / p, -heat / m
        else:
            inflow, _, by_down = mass_flux(gas, gas.pressure, gas.temperature, p)
            flux, by_p, by_m = -inflow, -by_down, 0.0
            heat, heat_by_p, heat_by_m = gas.heat_capacity * gas.temperature, 0.0, 0.0
        pockets.leak[i, MASS], pockets.leak[i, HEAT] = gap * flux, gap * flux * heat
        residual[i, MASS] += dt * gap * flux
        block[i, MASS, PRESSURE] += dt * gap * by_p
        block[i, MASS, CONTENT] += dt * gap * by_m
        if not isentropic:
            residual[i, HEAT] += dt * gap * flux * heat
            block[i, HEAT, PRESSURE] += dt * gap * (by_p * heat + flux * heat_by_p)
            block[i, HEAT, CONTENT] += dt * gap * (by_m * heat + flux * heat_by_m)


@kernel
def _exchange(
    gas: Gas, duct: Duct, pockets: Pockets, x: FloatArray, low: int, high: int, dt: float, isentropic: bool
) -> None:
    """Flow through the faces between two pockets, and between a pocket and the ambient."""
    for face in range(low, high + 1):
        left = x[face - 1, PRESSURE] if face > low else gas.pressure
        right = x[face, PRESSURE] if face < high else gas.pressure
        source, sink, direction = (face - 1, face, 1.0) if left >= right else (face, face - 1, -1.0)
        opening = duct.discharge * pockets.opening[face]
        upstream, downstream = max(left, right), min(left, right)
        if low <= source < high:
            area, m = pockets.area[source, END], x[source, CONTENT]
            flux, by_p, by_m, by_down = _discharge(gas, upstream, m, area, downstream)
            heat = gas.heat_capacity * upstream * area / (m * gas.constant)
            heat_by_p, heat_by_m = heat / upstream, -heat / m
        else:
            flux, by_p, by_down = mass_flux(gas, upstream, gas.temperature, downstream)
            heat, by_m, heat_by_p, heat_by_m = gas.heat_capacity * gas.temperature, 0.0, 0.0, 0.0
        pockets.flow[face, MASS] = direction * opening * flux
        pockets.flow[face, HEAT] = direction * opening * flux * heat
        share = dt * opening / duct.width
        for end in range(2):
            i, sign = (source, share) if end == 0 else (sink, -share)
            if i < low or i >= high:
                continue
            own = pockets.diagonal
            other = pockets.upper if i == face - 1 else pockets.lower
            by_source, by_sink = (own, other) if end == 0 else (other, own)
            pockets.residual[i, MASS] += sign * flux
            by_source[i, MASS, PRESSURE] += sign * by_p
            by_source[i, MASS, CONTENT] += sign * by_m
            by_sink[i, MASS, PRESSURE] += sign * by_down
            if not isentropic:
                pockets.residual[i, HEAT] += sign * flux * heat
                by_source[i, HEAT, PRESSURE] += sign * (by_p * heat + flux * heat_by_p)
                by_source[i, HEAT, CONTENT] += sign * (by_m * heat + flux * heat_by_m)
                by_sink[i, HEAT, PRESSURE] += sign * by_down * heat


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
