"""One time step of quasi-one-dimensional gas dynamics in a duct whose section changes with time.

 d(A rho)/dt       + d(A rho u)/dz             = -q
 d(A rho u)/dt     + d(A (rho u^2 + p))/dz     = p dA/dz - q u_q
 d(A rho E)/dt     + d(A u (rho E + p))/dz     = -p dA/dt - q h_q

Here A is the area of the section, and E is the energy of the gas per unit mass, internal plus kinetic. The leakage
is q, the velocity of the leaking gas is u_q, and the stagnation enthalpy of this gas is h_q.

The MUSCL-Hancock method is of second order in space and time. States at the faces come from a limited linear
reconstruction and a half-step predictor. The leakage q and the wall work are integrated by an implicit Runge-Kutta
method with two stages. This method is L-stable and stiffly accurate. The fluxes through the faces are constant during
both stages.
"""

from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray, RecordArray, floats, records
from solvers.compiled import inner_kernel
from solvers.pumping.flow.duct import WALL, Duct, Wall, stroke_share, wall_at
from solvers.pumping.flow.nozzle import Gas
from solvers.pumping.gas.leakage import Stage, Walls, implicit_stage
from solvers.pumping.gas.riemann import Conserved, State, flux, front_face, hllc, ram_pressure, reservoir_face

_DIAGONAL = 1.0 - np.sqrt(0.5)  # diagonal coefficient of the Runge-Kutta method with two stages


CONSERVED = floats("mass", "momentum", "energy")
"""Mass [kg/m], momentum [kg/s] and energy [J/m] per metre of face, or their fluxes through a face [kg/s, N, W]."""

STATE = floats("density", "velocity", "pressure")
"""Density [kg/m^3], velocity [m/s] and pressure [Pa], or the changes of these quantities over a cell."""

LOSS = floats("mass", "energy", "work")
"""Losses of a cell to the walls in a step, per metre of face.

`mass`: leaked mass [kg/m]; `energy`: energy lost with the leakage and by wall work [J/m]; `work`: work of the walls on
the gas by pressures above ambient pressure [J/m].
"""

END = floats("demand", "mach", "velocity")
"""Values at an end of the duct: demand (see `reservoir_face`), Mach number, outward velocity [m/s]."""

LEAK = floats("latest", "halfway", "growth")
"""Leakage of a cell in the latest step; the first guess for the next step is extrapolated from these values.

`latest` and `halfway`: leakage per unit time and per metre of face, at the end and in the middle of the latest step
[kg/(s m)]; `growth`: mean rate at which this leakage grew in the latest step [kg/(s^2 m)].
"""


class Cells(NamedTuple):
    """Arrays with the gas in a duct, used by all kernels of a time step; in brackets their types of records.

    Shapes: (cells + 1,) for `face_area` and `flux`, (2,) for `ends`, otherwise (cells,).

    `content` (CONSERVED), `state` (STATE) and `walls` (WALL) are those at the start of the step, `next_...` those at
    the end; `half` (STATE), `face_area` [m^2] and `flux` (CONSERVED) those in the middle. `slope` (STATE) is the change
    over a cell. `loss` (LOSS), `ends` (END) and `leak` (LEAK) belong to the whole step. `share` is the share of the
    step in which a cell's centre is in its stroke; outside it walls stand still and nothing leaks.
    """

    content: RecordArray
    state: RecordArray
    next_content: RecordArray
    next_state: RecordArray
    walls: RecordArray
    next_walls: RecordArray
    slope: RecordArray
    half: RecordArray
    loss: RecordArray
    face_area: FloatArray
    flux: RecordArray
    ends: RecordArray
    leak: RecordArray
    share: FloatArray


def empty_cells(cells: int) -> Cells:
    """Return the arrays of a duct of `cells` cells; all values are 0."""
    return Cells(
        content=records(cells, CONSERVED),
        state=records(cells, STATE),
        next_content=records(cells, CONSERVED),
        next_state=records(cells, STATE),
        walls=records(cells, WALL),
        next_walls=records(cells, WALL),
        slope=records(cells, STATE),
        half=records(cells, STATE),
        loss=records(cells, LOSS),
        face_area=np.zeros(cells + 1),
        flux=records(cells + 1, CONSERVED),
        ends=records(2, END),
        leak=records(cells, LEAK),
        share=np.zeros(cells),
    )


@inner_kernel
def set_walls(duct: Duct, cells: Cells, low: int, high: int, angle: float, turn: float) -> None:
    """Set the walls of the active cells at the start and end of a step, and the face areas in mid-step."""
    for i in range(low, high):
        z = duct.start + (i + 0.5) * duct.width
        share = stroke_share(duct, z, angle, turn)
        cells.share[i] = share
        _put(cells.walls, i, wall_at(duct, z, angle), share)
        _put(cells.next_walls, i, wall_at(duct, z, angle + turn), share)
    for i in range(low, high + 1):
        cells.face_area[i] = wall_at(duct, duct.start + i * duct.width, angle + 0.5 * turn).area


@inner_kernel
def _put(walls: RecordArray, i: int, wall: Wall, share: float) -> None:
    """Store the walls of cell i.

    `share` is the share of the step in which the gap is open; the clearance is multiplied by this share.
    """
    walls[i].area, walls[i].clearance, walls[i].carried = wall.area, share * wall.clearance, wall.carried


@inner_kernel
def step(gas: Gas, duct: Duct, cells: Cells, low: int, high: int, dt: float, order: int) -> bool:
    """Advance the active cells by one time step (Eq. P6)."""
    _set_slopes(cells, low, high, order)
    if not _predict(gas, duct, cells, low, high, dt):
        return False
    _set_fluxes(gas, duct, cells, low, high)
    return _correct(gas, duct, cells, low, high, dt)


@inner_kernel
def _set_slopes(cells: Cells, low: int, high: int, order: int) -> None:
    """Limited slopes of the state; 0 in a cell whose density or pressure would nearly vanish at an edge."""
    state, slope = cells.state, cells.slope
    for i in range(low, high):
        if order == 1 or high - low < 3:
            _put_slope(slope, i, 0.0, 0.0, 0.0)
            continue
        inner = low + 1 if i == low else high - 2 if i == high - 1 else i
        a, b, c = state[inner - 1], state[inner], state[inner + 1]
        _put_slope(
            slope,
            i,
            _limited(i - inner, b.density - a.density, c.density - b.density),
            _limited(i - inner, b.velocity - a.velocity, c.velocity - b.velocity),
            _limited(i - inner, b.pressure - a.pressure, c.pressure - b.pressure),
        )
        density = 0.5 * abs(slope[i].density) >= 0.9 * state[i].density
        pressure = 0.5 * abs(slope[i].pressure) >= 0.9 * state[i].pressure
        if density or pressure:
            _put_slope(slope, i, 0.0, 0.0, 0.0)


@inner_kernel
def _put_slope(slope: RecordArray, i: int, density: float, velocity: float, pressure: float) -> None:
    slope[i].density, slope[i].velocity, slope[i].pressure = density, velocity, pressure


@inner_kernel
def _limited(side: int, back: float, ahead: float) -> float:
    """Limited slope from both differences: van Leer's in inner cells (`side` 0), `_end_slope` in the end cells."""
    if side < 0:
        return _end_slope(back, ahead)
    if side > 0:
        return _end_slope(ahead, back)
    return 2.0 * back * ahead / (back + ahead) if back * ahead > 0.0 else 0.0


@inner_kernel
def _end_slope(nearest: float, next_one: float) -> float:
    """Slope of an end cell by a parabola, of the sign of the nearest difference and at most twice as large."""
    slope = 1.5 * nearest - 0.5 * next_one
    if slope * nearest <= 0.0:
        return 0.0
    return slope if abs(slope) < 2.0 * abs(nearest) else 2.0 * nearest


@inner_kernel
def _walls(duct: Duct, now: RecordArray, after: RecordArray, i: int, fraction: float, dt: float) -> Walls:
    """Interpolate the walls of cell i between the start of a step (fraction 0) and its end (fraction 1)."""
    return Walls(
        now[i].area + fraction * (after[i].area - now[i].area),
        (after[i].area - now[i].area) / dt,
        duct.discharge * (now[i].clearance + fraction * (after[i].clearance - now[i].clearance)),
        (after[i].carried - now[i].carried) / dt,
    )


@inner_kernel
def _predict(gas: Gas, duct: Duct, cells: Cells, low: int, high: int, dt: float) -> bool:
    """Compute the states in the middle of the step by Hancock's method.

    The flux at each edge of a cell is computed from the state of this cell alone.
    """
    g, share = gas.exponent, 0.5 * dt / duct.width
    w, s, c, area = cells.state, cells.slope, cells.content, cells.face_area
    half, leak = cells.half, cells.leak
    for i in range(low, high):
        left, right = area[i], area[i + 1]
        into, out = _own_flux(g, left, _edge(w, s, i, -0.5)), _own_flux(g, right, _edge(w, s, i, 0.5))
        force = w[i].pressure * (right - left)
        mass = c[i].mass - share * (out.mass - into.mass)
        momentum = c[i].momentum - share * (out.momentum - into.momentum - force)
        energy = c[i].energy - share * (out.energy - into.energy)
        walls = _walls(duct, cells.walls, cells.next_walls, i, 0.5, dt)
        guess = leak[i].latest + 0.5 * dt * leak[i].growth
        stage = implicit_stage(gas, walls, mass, momentum, energy, 0.5 * dt, guess)
        if not stage.fits:
            return False
        leak[i].halfway = stage.through_gaps
        half[i].density, half[i].velocity = stage.mass / walls.area, stage.momentum / stage.mass
        half[i].pressure = stage.pressure
    return True


@inner_kernel
def _own_flux(g: float, area: float, edge: State) -> Conserved:
    """Flux through a face of a cell from its state `edge` there."""
    return flux(g, area, edge, edge.density * edge.velocity**2)


@inner_kernel
def _edge(w: RecordArray, s: RecordArray, i: int, side: float) -> State:
    """Extrapolate the state w of cell i linearly to an edge of this cell; s is the change of the state over the cell.

    `side` is the position of the edge in cell widths from the centre, -0.5 or 0.5.
    """
    return State(
        w[i].density + side * s[i].density,
        w[i].velocity + side * s[i].velocity,
        w[i].pressure + side * s[i].pressure,
    )


@inner_kernel
def _safe_edge(w: RecordArray, s: RecordArray, i: int, side: float) -> State:
    """`_edge`, or the state of the cell if density or pressure would fall below a tenth of it."""
    edge = _edge(w, s, i, side)
    if edge.density < 0.1 * w[i].density or edge.pressure < 0.1 * w[i].pressure:
        return State(w[i].density, w[i].velocity, w[i].pressure)
    return edge


@inner_kernel
def _set_fluxes(gas: Gas, duct: Duct, cells: Cells, low: int, high: int) -> None:
    half, slope, fluxes, area = cells.half, cells.slope, cells.flux, cells.face_area
    for i in range(low + 1, high):
        left, right = _safe_edge(half, slope, i - 1, 0.5), _safe_edge(half, slope, i, -0.5)
        mass, momentum, energy = hllc(gas.exponent, left, right)
        fluxes[i].mass, fluxes[i].momentum, fluxes[i].energy = area[i] * mass, area[i] * momentum, area[i] * energy
    _set_end(gas, cells, low, low, 0)
    if high < duct.cells:
        # The gas at the border to idle cells has the state with which these cells would begin their stroke.
        border = front_face(gas, duct.speed / duct.lag, _safe_edge(half, slope, high - 1, 0.5))
        _put_flux(gas, cells, high, 1.0, border)
    else:
        _set_end(gas, cells, high - 1, high, 1)


@inner_kernel
def _put_flux(gas: Gas, cells: Cells, face: int, outward: float, state: State) -> None:
    """Store the flux of a state, its velocity positive outwards; `outward` is -1 at the low end, else 1."""
    through, fluxes = flux(gas.exponent, cells.face_area[face], state, ram_pressure(state)), cells.flux
    fluxes[face].mass, fluxes[face].energy = outward * through.mass, outward * through.energy
    fluxes[face].momentum = through.momentum


@inner_kernel
def _set_end(gas: Gas, cells: Cells, cell: int, face: int, end: int) -> None:
    """Compute the flux through an end that opens into the ambient."""
    outward, ends = 2.0 * end - 1.0, cells.ends
    rho, u, p = _safe_edge(cells.half, cells.slope, cell, 0.5 * outward)
    opening, demand = reservoir_face(gas, State(rho, outward * u, p))
    _put_flux(gas, cells, face, outward, opening)
    sound = np.sqrt(gas.exponent * opening.pressure / opening.density)
    ends[end].demand, ends[end].mach, ends[end].velocity = demand, opening.velocity / sound, opening.velocity


@inner_kernel
def _correct(gas: Gas, duct: Duct, cells: Cells, low: int, high: int, dt: float) -> bool:
    """Content of the cells at the end of the step; two implicit wall stages, else a single one. False if that fails."""
    fluxes, area, c, h = cells.flux, cells.face_area, cells.content, _DIAGONAL * dt
    loss, leak = cells.loss, cells.leak
    for i in range(low, high):
        mass = (fluxes[i].mass - fluxes[i + 1].mass) / duct.width
        force = cells.half[i].pressure * (area[i + 1] - area[i])
        momentum = (fluxes[i].momentum - fluxes[i + 1].momentum + force) / duct.width
        energy = (fluxes[i].energy - fluxes[i + 1].energy) / duct.width
        early, late, latest = dt - h, h, leak[i].latest
        ahead = 2.0 * (leak[i].halfway - latest)  # expected growth of the leakage over the step
        walls = _walls(duct, cells.walls, cells.next_walls, i, _DIAGONAL, dt)
        old_mass, old_momentum, old_energy = c[i].mass, c[i].momentum, c[i].energy
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
        if not (first.fits and last.fits):  # a single stage is of first order, but more robust
            early, late = 0.0, dt
            last = implicit_stage(gas, walls, full_mass, full_momentum, full_energy, dt, latest + ahead)
        if not last.fits:
            return False
        loss[i].mass = early * first.leak + late * last.leak
        loss[i].energy = early * first.energy_rate + late * last.energy_rate
        gauge = early * (gas.pressure - first.pressure) + late * (gas.pressure - last.pressure)
        loss[i].work = gauge * walls.growth
        leak[i].latest, leak[i].growth = last.through_gaps, (last.through_gaps - latest) / dt
        _store(gas, cells.next_content, cells.next_state, i, last, walls.area)
    return True


@inner_kernel
def _store(gas: Gas, content: RecordArray, state: RecordArray, i: int, stage: Stage, area: float) -> None:
    content[i].mass, content[i].momentum, content[i].energy = stage.mass, stage.momentum, stage.energy
    state[i].density, state[i].velocity = stage.mass / area, stage.momentum / stage.mass
    state[i].pressure = (gas.exponent - 1.0) * (stage.energy - 0.5 * stage.momentum**2 / stage.mass) / area
