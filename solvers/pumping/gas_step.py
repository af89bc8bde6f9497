"""One time step of quasi-one-dimensional gas dynamics in a duct whose section moves: MUSCL-Hancock, walls implicit.

 d(A rho)/dt       + d(A rho u)/dz             = -q
 d(A rho u)/dt     + d(A (rho u^2 + p))/dz     = p dA/dz - q u_q
 d(A rho E)/dt     + d(A u (rho E + p))/dz     = -p dA/dt - q h_q

Second order in space and time: limited linear reconstruction and a half-step predictor for the faces; leakage q and
wall work by a two-stage, L-stable, stiffly accurate Runge-Kutta method around the fluxes of the half step.
"""

from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.pumping.duct import Duct, stroke_share, wall_values
from solvers.pumping.leakage import Stage, Walls, implicit_stage
from solvers.pumping.nozzle import Gas
from solvers.pumping.riemann import front_face, hllc, reservoir_face

_DIAGONAL = 1.0 - np.sqrt(0.5)  # of the two-stage method


class Cells(NamedTuple):
    """Arrays of a duct, each (cells, 3) or (faces, 3).

    `content` per metre (mass, momentum, energy), `state` (density, velocity, pressure); `walls` at the start of the
    step and `next_walls` at its end (area, clearance, carried gas); `slope` and `half` of the state; `loss` over the
    step (leaked mass, energy lost to the walls, gauge work done by them; per metre); `face_area` and `flux` at the
    half step; `ends` (2, 3) of the low and the high end: Mach number asked for, Mach number, velocity outwards [m/s];
    `leak` (cells,) the latest leakage, a first guess for the next [kg/(s m)]; `share` (cells,) of the step in which a
    cell's centre is in its stroke: outside it the walls stand still and nothing leaks.
    """

    content: FloatArray
    state: FloatArray
    next_content: FloatArray
    next_state: FloatArray
    walls: FloatArray
    next_walls: FloatArray
    slope: FloatArray
    half: FloatArray
    loss: FloatArray
    face_area: FloatArray
    flux: FloatArray
    ends: FloatArray
    leak: FloatArray
    share: FloatArray


def empty_cells(cells: int) -> Cells:
    """Arrays for a duct of so many cells."""
    wide, faces = (cells, 3), cells + 1
    shapes = [wide, wide, wide, wide, wide, wide, wide, wide, wide, (faces,), (faces, 3), (2, 3), (cells,), (cells,)]
    return Cells(*[np.zeros(shape) for shape in shapes])


@kernel
def set_walls(duct: Duct, cells: Cells, low: int, high: int, angle: float, turn: float) -> None:
    """Walls of the active cells at the start and the end of a step, areas of their faces in its middle."""
    for i in range(low, high):
        z = duct.start + (i + 0.5) * duct.width
        now, after = wall_values(duct, z, angle), wall_values(duct, z, angle + turn)
        share = stroke_share(duct, z, angle, turn)
        cells.share[i] = share
        for k in range(3):
            cells.walls[i, k], cells.next_walls[i, k] = now[k], after[k]
        cells.walls[i, 1], cells.next_walls[i, 1] = share * now[1], share * after[1]
    for i in range(low, high + 1):
        cells.face_area[i] = wall_values(duct, duct.start + i * duct.width, angle + 0.5 * turn)[0]


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
        for k in (0, 2):
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
        now[i, 0] + fraction * (after[i, 0] - now[i, 0]),
        (after[i, 0] - now[i, 0]) / dt,
        duct.discharge * (now[i, 1] + fraction * (after[i, 1] - now[i, 1])),
        (after[i, 2] - now[i, 2]) / dt,
    )


@kernel
def _predict(gas: Gas, duct: Duct, cells: Cells, low: int, high: int, dt: float) -> bool:
    """State in the middle of the step, from each cell's own fluxes (Hancock)."""
    g, share = gas.exponent, 0.5 * dt / duct.width
    w, s, c, area, half = cells.state, cells.slope, cells.content, cells.face_area, cells.half
    for i in range(low, high):
        left, right = area[i], area[i + 1]
        r_l, u_l, p_l = w[i, 0] - 0.5 * s[i, 0], w[i, 1] - 0.5 * s[i, 1], w[i, 2] - 0.5 * s[i, 2]
        r_r, u_r, p_r = w[i, 0] + 0.5 * s[i, 0], w[i, 1] + 0.5 * s[i, 1], w[i, 2] + 0.5 * s[i, 2]
        mass = c[i, 0] - share * (right * r_r * u_r - left * r_l * u_l)
        force = w[i, 2] * (right - left)
        momentum = c[i, 1] - share * (right * (r_r * u_r**2 + p_r) - left * (r_l * u_l**2 + p_l) - force)
        enthalpy_l = g / (g - 1.0) * p_l + 0.5 * r_l * u_l**2
        enthalpy_r = g / (g - 1.0) * p_r + 0.5 * r_r * u_r**2
        energy = c[i, 2] - share * (right * u_r * enthalpy_r - left * u_l * enthalpy_l)
        walls = _walls(duct, cells.walls, cells.next_walls, i, 0.5, dt)
        stage = implicit_stage(gas, walls, mass, momentum, energy, 0.5 * dt, cells.leak[i])
        if not stage.fits:
            return False
        half[i, 0], half[i, 1], half[i, 2] = stage.mass / walls.area, stage.momentum / stage.mass, stage.pressure
    return True


@kernel
def _edge(w: FloatArray, s: FloatArray, i: int, side: float) -> tuple[float, float, float]:
    """State w at a cell's edge by the slope s; that of the cell itself where the slope leads too far."""
    rho, p = w[i, 0] + side * s[i, 0], w[i, 2] + side * s[i, 2]
    if rho < 0.1 * w[i, 0] or p < 0.1 * w[i, 2]:
        return w[i, 0], w[i, 1], w[i, 2]
    return rho, w[i, 1] + side * s[i, 1], p


@kernel
def _set_fluxes(gas: Gas, duct: Duct, cells: Cells, low: int, high: int) -> None:
    """Fluxes through all faces, times their areas."""
    half, slope, flux, area = cells.half, cells.slope, cells.flux, cells.face_area
    for i in range(low + 1, high):
        rho_l, u_l, p_l = _edge(half, slope, i - 1, 0.5)
        rho_r, u_r, p_r = _edge(half, slope, i, -0.5)
        mass, momentum, energy = hllc(gas.exponent, rho_l, u_l, p_l, rho_r, u_r, p_r)
        flux[i, 0], flux[i, 1], flux[i, 2] = area[i] * mass, area[i] * momentum, area[i] * energy
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
    cells.flux[face, 0] = outward * area * rho_f * v
    cells.flux[face, 1] = area * (rho_f * v * v + p_f)
    cells.flux[face, 2] = outward * area * v * (g / (g - 1.0) * p_f + 0.5 * rho_f * v * v)
    cells.ends[end, 0], cells.ends[end, 1], cells.ends[end, 2] = mach, v / np.sqrt(g * p_f / rho_f), v


@kernel
def _set_front(gas: Gas, duct: Duct, cells: Cells, high: int) -> None:
    """Flux through the border to slices whose stroke is to begin, at the state with which they will begin."""
    rho, u, p = _edge(cells.half, cells.slope, high - 1, 0.5)
    rho_f, v, p_f = front_face(gas, duct.speed / duct.lag, rho, u, p)
    area, g = cells.face_area[high], gas.exponent
    cells.flux[high, 0] = area * rho_f * v
    cells.flux[high, 1] = area * (rho_f * v * v + p_f)
    cells.flux[high, 2] = area * v * (g / (g - 1.0) * p_f + 0.5 * rho_f * v * v)


@kernel
def _correct(gas: Gas, duct: Duct, cells: Cells, low: int, high: int, dt: float) -> bool:
    """Content at the end of the step from the fluxes of its middle, leakage and wall work in two implicit stages."""
    flux, area, c, loss, h = cells.flux, cells.face_area, cells.content, cells.loss, _DIAGONAL * dt
    for i in range(low, high):
        mass = (flux[i, 0] - flux[i + 1, 0]) / duct.width
        force = cells.half[i, 2] * (area[i + 1] - area[i])
        momentum = (flux[i, 1] - flux[i + 1, 1] + force) / duct.width
        energy = (flux[i, 2] - flux[i + 1, 2]) / duct.width
        early, late = dt - h, h
        walls = _walls(duct, cells.walls, cells.next_walls, i, _DIAGONAL, dt)
        first = implicit_stage(
            gas, walls, c[i, 0] + h * mass, c[i, 1] + h * momentum, c[i, 2] + h * energy, h, cells.leak[i]
        )
        walls = _walls(duct, cells.walls, cells.next_walls, i, 1.0, dt)
        full_mass, full_momentum, full_energy = c[i, 0] + dt * mass, c[i, 1] + dt * momentum, c[i, 2] + dt * energy
        last = implicit_stage(
            gas,
            walls,
            full_mass - early * first.leak,
            full_momentum - early * first.momentum_rate,
            full_energy - early * first.energy_rate,
            late,
            first.leak,
        )
        if not (first.fits and last.fits):  # one stage: first order, hardier
            early, late = 0.0, dt
            last = implicit_stage(gas, walls, full_mass, full_momentum, full_energy, dt, cells.leak[i])
        if not last.fits:
            return False
        loss[i, 0] = early * first.leak + late * last.leak
        loss[i, 1] = early * first.energy_rate + late * last.energy_rate
        gauge = early * (gas.pressure - first.pressure) + late * (gas.pressure - last.pressure)
        loss[i, 2] = gauge * walls.growth
        cells.leak[i] = last.leak
        _store(gas, cells.next_content, cells.next_state, i, last, walls.area)
    return True


@kernel
def _store(gas: Gas, content: FloatArray, state: FloatArray, i: int, stage: Stage, area: float) -> None:
    content[i, 0], content[i, 1], content[i, 2] = stage.mass, stage.momentum, stage.energy
    state[i, 0], state[i, 1] = stage.mass / area, stage.momentum / stage.mass
    state[i, 2] = (gas.exponent - 1.0) * (stage.energy - 0.5 * stage.momentum**2 / stage.mass) / area
