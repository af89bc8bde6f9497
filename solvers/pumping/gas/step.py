"""One time step of quasi-one-dimensional gas dynamics in a duct whose section moves: MUSCL-Hancock, walls implicit.

 d(A rho)/dt       + d(A rho u)/dz             = -q
 d(A rho u)/dt     + d(A (rho u^2 + p))/dz     = p dA/dz - q u_q
 d(A rho E)/dt     + d(A u (rho E + p))/dz     = -p dA/dt - q h_q

Second order in space and time: limited linear reconstruction and a half-step predictor for the faces; leakage q and
wall work by a two-stage, L-stable, stiffly accurate Runge-Kutta method around the fluxes of the half step.
"""

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.pumping.flow.duct import AREA, CARRIED, CLEARANCE, Duct
from solvers.pumping.flow.nozzle import Gas
from solvers.pumping.gas.cells import (
    DEMAND,
    DENSITY,
    ENERGY,
    GIVEN,
    GROWTH,
    HALFWAY,
    LATEST,
    LEAKED,
    MACH,
    MASS,
    MOMENTUM,
    OUTWARD,
    PRESSURE,
    VELOCITY,
    WORKED,
    Cells,
)
from solvers.pumping.gas.leakage import Stage, Walls, implicit_stage
from solvers.pumping.gas.riemann import front_face, hllc, reservoir_face

_DIAGONAL = 1.0 - np.sqrt(0.5)  # of the two-stage method


@kernel
def step(gas: Gas, duct: Duct, cells: Cells, low: int, high: int, dt: float, order: int) -> bool:
    """Advance the cells low..high by dt [s] into `next_content` and `next_state`; whether the states are physical."""
    _set_slopes(cells, low, high, order)
    if not _predict(gas, duct, cells, low, high, dt):
        return False
    _set_fluxes(gas, duct, cells, low, high)
    return _correct(gas, duct, cells, low, high, dt)


@kernel
def _set_slopes(cells: Cells, low: int, high: int, order: int) -> None:
    """Van Leer's limited differences; one-sided ones in the end cells."""
    state, slope = cells.state, cells.slope
    for i in range(low, high):
        for k in range(3):
            if order == 1 or high - low < 3:
                slope[i, k] = 0.0
            elif i == low:
                slope[i, k] = _end_slope(state[i + 1, k] - state[i, k], state[i + 2, k] - state[i + 1, k])
            elif i == high - 1:
                slope[i, k] = _end_slope(state[i, k] - state[i - 1, k], state[i - 1, k] - state[i - 2, k])
            else:
                back, ahead = state[i, k] - state[i - 1, k], state[i + 1, k] - state[i, k]
                slope[i, k] = 2.0 * back * ahead / (back + ahead) if back * ahead > 0.0 else 0.0
        for k in (DENSITY, PRESSURE):
            if 0.5 * abs(slope[i, k]) >= 0.9 * state[i, k]:
                slope[i, :] = 0.0


@kernel
def _end_slope(nearest: float, next_one: float) -> float:
    """Slope of an end cell from the two nearest differences: that of a parabola, at most twice the nearest one."""
    slope = 1.5 * nearest - 0.5 * next_one
    if slope * nearest <= 0.0:
        return 0.0
    return slope if abs(slope) < 2.0 * abs(nearest) else 2.0 * nearest


@kernel
def _walls(duct: Duct, now: FloatArray, after: FloatArray, i: int, fraction: float, dt: float) -> Walls:
    """Walls of cell i after a fraction of the step."""
    return Walls(
        now[i, AREA] + fraction * (after[i, AREA] - now[i, AREA]),
        (after[i, AREA] - now[i, AREA]) / dt,
        duct.discharge * (now[i, CLEARANCE] + fraction * (after[i, CLEARANCE] - now[i, CLEARANCE])),
        (after[i, CARRIED] - now[i, CARRIED]) / dt,
    )


@kernel
def _predict(gas: Gas, duct: Duct, cells: Cells, low: int, high: int, dt: float) -> bool:
    """State in the middle of the step, from each cell's own fluxes (Hancock)."""
    g, share = gas.exponent, 0.5 * dt / duct.width
    w, s, c, area = cells.state, cells.slope, cells.content, cells.face_area
    half, leak = cells.half, cells.leak
    for i in range(low, high):
        left, right = area[i], area[i + 1]
        rho, u, p = w[i]
        by_rho, by_u, by_p = s[i]
        r_l, u_l, p_l = rho - 0.5 * by_rho, u - 0.5 * by_u, p - 0.5 * by_p
        r_r, u_r, p_r = rho + 0.5 * by_rho, u + 0.5 * by_u, p + 0.5 * by_p
        mass = c[i, MASS] - share * (right * r_r * u_r - left * r_l * u_l)
        force = p * (right - left)
        momentum = c[i, MOMENTUM] - share * (right * (r_r * u_r**2 + p_r) - left * (r_l * u_l**2 + p_l) - force)
        enthalpy_l = g / (g - 1.0) * p_l + 0.5 * r_l * u_l**2
        enthalpy_r = g / (g - 1.0) * p_r + 0.5 * r_r * u_r**2
        energy = c[i, ENERGY] - share * (right * u_r * enthalpy_r - left * u_l * enthalpy_l)
        walls = _walls(duct, cells.walls, cells.next_walls, i, 0.5, dt)
        guess = leak[i, LATEST] + 0.5 * dt * leak[i, GROWTH]
        stage = implicit_stage(gas, walls, mass, momentum, energy, 0.5 * dt, guess)
        if not stage.fits:
            return False
        leak[i, HALFWAY] = stage.through_gaps
        half[i, DENSITY], half[i, VELOCITY] = stage.mass / walls.area, stage.momentum / stage.mass
        half[i, PRESSURE] = stage.pressure
    return True


@kernel
def _edge(w: FloatArray, s: FloatArray, i: int, side: float) -> tuple[float, float, float]:
    """State w at a cell's edge by the slope s; that of the cell itself where the slope leads too far."""
    rho, p = w[i, DENSITY] + side * s[i, DENSITY], w[i, PRESSURE] + side * s[i, PRESSURE]
    if rho < 0.1 * w[i, DENSITY] or p < 0.1 * w[i, PRESSURE]:
        return w[i, DENSITY], w[i, VELOCITY], w[i, PRESSURE]
    return rho, w[i, VELOCITY] + side * s[i, VELOCITY], p


@kernel
def _set_fluxes(gas: Gas, duct: Duct, cells: Cells, low: int, high: int) -> None:
    """Fluxes through all faces, times their areas."""
    half, slope, flux, area = cells.half, cells.slope, cells.flux, cells.face_area
    for i in range(low + 1, high):
        rho_l, u_l, p_l = _edge(half, slope, i - 1, 0.5)
        rho_r, u_r, p_r = _edge(half, slope, i, -0.5)
        mass, momentum, energy = hllc(gas.exponent, rho_l, u_l, p_l, rho_r, u_r, p_r)
        flux[i, MASS], flux[i, MOMENTUM], flux[i, ENERGY] = area[i] * mass, area[i] * momentum, area[i] * energy
    _set_end(gas, cells, low, low, 0)
    if high < duct.cells:
        _set_front(gas, duct, cells, high)
    else:
        _set_end(gas, cells, high - 1, high, 1)


@kernel
def _set_end(gas: Gas, cells: Cells, cell: int, face: int, end: int) -> None:
    outward = 2.0 * end - 1.0
    rho, u, p = _edge(cells.half, cells.slope, cell, 0.5 * outward)
    rho_f, v, p_f, mach = reservoir_face(gas, rho, outward * u, p)
    area, g = cells.face_area[face], gas.exponent
    cells.flux[face, MASS] = outward * area * rho_f * v
    cells.flux[face, MOMENTUM] = area * (rho_f * v * v + p_f)
    cells.flux[face, ENERGY] = outward * area * v * (g / (g - 1.0) * p_f + 0.5 * rho_f * v * v)
    cells.ends[end, DEMAND], cells.ends[end, MACH], cells.ends[end, OUTWARD] = mach, v / np.sqrt(g * p_f / rho_f), v


@kernel
def _set_front(gas: Gas, duct: Duct, cells: Cells, high: int) -> None:
    """Flux through the border to slices whose stroke is to begin, at the state with which they will begin."""
    rho, u, p = _edge(cells.half, cells.slope, high - 1, 0.5)
    rho_f, v, p_f = front_face(gas, duct.speed / duct.lag, rho, u, p)
    area, g = cells.face_area[high], gas.exponent
    cells.flux[high, MASS] = area * rho_f * v
    cells.flux[high, MOMENTUM] = area * (rho_f * v * v + p_f)
    cells.flux[high, ENERGY] = area * v * (g / (g - 1.0) * p_f + 0.5 * rho_f * v * v)


@kernel
def _correct(gas: Gas, duct: Duct, cells: Cells, low: int, high: int, dt: float) -> bool:
    """Content at the end of the step from the fluxes of its middle, leakage and wall work in two implicit stages."""
    flux, area, c, h = cells.flux, cells.face_area, cells.content, _DIAGONAL * dt
    loss, leak = cells.loss, cells.leak
    for i in range(low, high):
        mass = (flux[i, MASS] - flux[i + 1, MASS]) / duct.width
        force = cells.half[i, PRESSURE] * (area[i + 1] - area[i])
        momentum = (flux[i, MOMENTUM] - flux[i + 1, MOMENTUM] + force) / duct.width
        energy = (flux[i, ENERGY] - flux[i + 1, ENERGY]) / duct.width
        early, late, latest = dt - h, h, leak[i, LATEST]
        ahead = 2.0 * (leak[i, HALFWAY] - latest)  # growth over the step
        walls = _walls(duct, cells.walls, cells.next_walls, i, _DIAGONAL, dt)
        old_mass, old_momentum, old_energy = c[i]
        first = implicit_stage(
            gas,
            walls,
            old_mass + h * mass,
            old_momentum + h * momentum,
            old_energy + h * energy,
            h,
            latest + _DIAGONAL * ahead,
        )
        walls = _walls(duct, cells.walls, cells.next_walls, i, 1.0, dt)
        full_mass, full_momentum = old_mass + dt * mass, old_momentum + dt * momentum
        full_energy = old_energy + dt * energy
        last = implicit_stage(
            gas,
            walls,
            full_mass - early * first.leak,
            full_momentum - early * first.momentum_rate,
            full_energy - early * first.energy_rate,
            late,
            latest + ahead,
        )
        if not (first.fits and last.fits):  # one stage: first order, hardier
            early, late = 0.0, dt
            last = implicit_stage(gas, walls, full_mass, full_momentum, full_energy, dt, latest + ahead)
        if not last.fits:
            return False
        loss[i, LEAKED] = early * first.leak + late * last.leak
        loss[i, GIVEN] = early * first.energy_rate + late * last.energy_rate
        gauge = early * (gas.pressure - first.pressure) + late * (gas.pressure - last.pressure)
        loss[i, WORKED] = gauge * walls.growth
        leak[i, LATEST], leak[i, GROWTH] = last.through_gaps, (last.through_gaps - latest) / dt
        _store(gas, cells.next_content, cells.next_state, i, last, walls.area)
    return True


@kernel
def _store(gas: Gas, content: FloatArray, state: FloatArray, i: int, stage: Stage, area: float) -> None:
    content[i, MASS], content[i, MOMENTUM], content[i, ENERGY] = stage.mass, stage.momentum, stage.energy
    state[i, DENSITY], state[i, VELOCITY] = stage.mass / area, stage.momentum / stage.mass
    state[i, PRESSURE] = (gas.exponent - 1.0) * (stage.energy - 0.5 * stage.momentum**2 / stage.mass) / area
