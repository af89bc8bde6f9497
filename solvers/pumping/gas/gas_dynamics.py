"""Quasi-one-dimensional gas dynamics of a tooth space, computed in time steps from the start to the end of the stroke.

A time step computes only the cells in which the stroke is under way. If the grid is refined, the results of this model
converge, but the results of the pocket chain do not converge.
"""

from math import ceil

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import inner_kernel, kernel
from solvers.errors import NoSolution
from solvers.pumping.flow.duct import Duct, phase_of, stroke_end, stroke_share, wall_at
from solvers.pumping.flow.nozzle import Gas
from solvers.pumping.flow.space_flow import (
    March,
    Record,
    SpaceFlow,
    add_means,
    add_outflow,
    empty_record,
    include_demand,
    include_pressure,
    include_speed,
    space_flow,
)
from solvers.pumping.gas.riemann import State, front_face
from solvers.pumping.gas.step import Cells, empty_cells, set_walls, step
from solvers.pumping.space.face import Stretch

LEAST_SLICES = 4  # chosen: limited slopes need three cells
_HASTE = 2.5  # the record has room for this factor times the number of steps that `_steps` estimates
COURANT = 0.7  # Courant number; less than the limit of the scheme, 1, because waves may become faster within a step
_ROUNDING = 1e-6  # a step may exceed the longest step by this share, so that no tiny step remains
_RETRIES = 12  # number of halvings of a failed step, chosen
_AHEAD = 4.0  # number of cells that take part early if the stroke runs along the face faster than sound
_STEEP = 0.5  # share of a cell's value; if an extrapolated value is smaller, the cell's own values are used
_UNSETTLED = 5.0  # number of steps after the start of a stroke until the leakage and the waves of the start settle


def gas_dynamics(gas: Gas, ducts: list[tuple[Stretch, Duct]], angle: FloatArray) -> SpaceFlow:
    """March every stretch of a tooth space through the stroke, and record the gas at each `angle` [rad].

    Raises NoSolution: unphysical_state if no step length gives a physical state, or if too many steps are needed.
    """
    room = ceil(_HASTE * max(_steps(gas, part, angle) for _, part in ducts)) + 8 * angle.size
    marches = []
    for stretch, part in ducts:
        record = empty_record(gas, angle.size, part.cells, room)
        steps = march(gas, part, empty_cells(part.cells), angle, record, 2)
        if steps < 0:
            reason = "the step limit was reached" if steps == -1 else "no step length gave a physical state"
            duration = float(angle[-1] - angle[0]) / part.speed
            remaining = {"remaining_share_of_stroke": 1.0 - float(record.ends.time.max()) / duration}
            raise NoSolution(
                "unphysical_state", f"the gas dynamics failed because {reason}; try fewer slices", remaining
            )
        marches.append(March(stretch, record, steps))
    return space_flow(angle, marches, conserves_energy=True)


def cell_steps(gas: Gas, ducts: list[tuple[Stretch, Duct]], angle: FloatArray) -> float:
    """Estimate the number of cells times the number of steps of `march`, from the speed of sound in gas at rest."""
    return sum(part.cells * _steps(gas, part, angle) for _, part in ducts)


def _steps(gas: Gas, part: Duct, angle: FloatArray) -> float:
    return float(angle[-1] - angle[0]) / part.speed * gas.sound_speed / (COURANT * part.width)


@kernel
def march(gas: Gas, duct: Duct, cells: Cells, angles: FloatArray, record: Record, order: int) -> int:
    """March from the first to the last of the `angles` [rad]; return the number of steps, or a negative number.

    The fastest wave determines the longest permitted step. A step that would pass the next of the `angles` is shortened
    and ends at this angle, even if the step is then very short. Results therefore depend continuously on the step
    length. The returned number is -1 if the record has no room for more steps, and -2 if no step length gives a
    physical state.
    """
    angle, taken, low, high = angles[0], 0, 0, 0
    for k in range(1, angles.size):
        landed = False
        while not landed:
            remaining = angles[k] - angle
            longest = min(_longest_turn(gas, duct, cells, low, high), angles[k] - angles[k - 1])
            turn = remaining if remaining <= (1.0 + _ROUNDING) * longest else longest
            done = False
            for retry in range(_RETRIES):
                new_low, new_high = _taking_part(gas, duct, angle, turn)
                if new_high == new_low:
                    done = True
                    break
                _fill(gas, duct, cells, low, high, new_low, new_high, angle)
                set_walls(duct, cells, new_low, new_high, angle, turn)
                done = step(gas, duct, cells, new_low, new_high, turn / duct.speed, order if retry == 0 else 1)
                if done:
                    break
                turn *= 0.5
            if not done:
                return -2
            if taken == record.ends.size:
                return -1
            _record_changes(duct, cells, record, low, high, new_low, new_high)
            low, high = new_low, new_high
            if high > low:
                record.ends[taken].time = (angle + 0.5 * turn - angles[0]) / duct.speed
                _record_ends(duct, cells, record, low, high, angle, turn, taken)
                _record_cells(gas, duct, cells, record, low, high, angle, turn, longest)
                _take_over(cells, low, high)
                taken += 1
            landed = turn == remaining
            angle = angles[k] if landed else angle + turn
        _record_field(gas, duct, cells, record, low, high, k, angle)
    _record_changes(duct, cells, record, low, high, 0, 0)
    return taken


@inner_kernel
def _taking_part(gas: Gas, duct: Duct, angle: float, turn: float) -> tuple[int, int]:
    """Find the first cell that takes part in a step from `angle` over `turn` [rad], and the cell after the last.

    A cell takes part while the stroke is under way at its centre; the outer cells also while it is at the end of the
    duct, so that gas can leave as long as the end is open. Leakage and mean temperatures of a cell count only for the
    part of the step in its stroke.

    If the stroke runs along the face faster than sound, a cell takes part as soon as the stroke is less than `_AHEAD`
    cell widths away. No real wave reaches the border to the idle cells, but on a grid waves spread over a few cells and
    would change the state with which the next ones begin; two sequences of steps could lead to two flows.
    """
    low, high, rear = 0, 0, duct.cells - 1
    early = _AHEAD * duct.lag * duct.width if duct.speed >= duct.lag * gas.sound_speed else 0.0
    for i in range(duct.cells):
        centre = (i + 0.5) * duct.width
        first, last = 0.0 if i == 0 else centre, duct.cells * duct.width if i == rear else centre
        if angle - duct.lag * (duct.start + last) >= stroke_end(duct):
            low = i + 1
        if angle + turn - duct.lag * (duct.start + first) + early > duct.first_angle:
            high = i + 1
    return low, max(low, high)


@inner_kernel
def _longest_turn(gas: Gas, duct: Duct, cells: Cells, low: int, high: int) -> float:
    """Compute the turn of the gear [rad] in which the fastest wave crosses the fraction `COURANT` of a cell."""
    fastest = gas.sound_speed
    for i in range(low, high):
        rho, u, p = cells.state[i].density, cells.state[i].velocity, cells.state[i].pressure
        fastest = max(fastest, abs(u) + np.sqrt(gas.exponent * p / rho))
    return COURANT * duct.width / fastest * duct.speed


@inner_kernel
def _fill(gas: Gas, duct: Duct, cells: Cells, low: int, high: int, new_low: int, new_high: int, angle: float) -> None:
    """Set the gas in every cell that begins its stroke to the state that `_border` computes."""
    rho, u, p = _border(gas, duct, cells, low, high)
    for i in range(new_low, new_high):
        if i < low or i >= high:
            area = wall_at(duct, duct.start + (i + 0.5) * duct.width, angle).area
            cells.content[i].mass, cells.content[i].momentum = rho * area, rho * u * area
            cells.content[i].energy = (p / (gas.exponent - 1.0) + 0.5 * rho * u * u) * area
            cells.state[i].density, cells.state[i].velocity, cells.state[i].pressure = rho, u, p


@inner_kernel
def _border(gas: Gas, duct: Duct, cells: Cells, low: int, high: int) -> State:
    """Compute the state of the gas with which the next cells begin their stroke.

    This is the state at the moving border between active and idle cells. `front_face` computes it from the state behind
    the border, which is extrapolated from the last two active cells. If no cell is active yet, the next cells begin
    with ambient gas at rest.
    """
    if not low < high < duct.cells:
        return State(gas.density, 0.0, gas.pressure)
    last, before = cells.state[high - 1], cells.state[max(high - 2, low)]
    rho = 2.0 * last.density - before.density
    u = 2.0 * last.velocity - before.velocity
    p = 2.0 * last.pressure - before.pressure
    if rho < _STEEP * last.density or p < _STEEP * last.pressure:
        rho, u, p = last.density, last.velocity, last.pressure
    return front_face(gas, duct.speed / duct.lag, State(rho, u, p))


@inner_kernel
def _record_changes(duct: Duct, cells: Cells, record: Record, low: int, high: int, new_low: int, new_high: int) -> None:
    """Update the balances of mass and energy if the stroke of a cell ends or begins between two steps.

    The content of a cell whose stroke ends is added to `ended`. The content of a cell whose stroke begins is added to
    `begun`.
    """
    for i in range(low, high):
        if i < new_low or i >= new_high:
            record.mass[0].ended += cells.content[i].mass * duct.width
            record.energy[0].ended += cells.content[i].energy * duct.width
    for i in range(new_low, new_high):
        if i < low or i >= high:
            record.mass[0].begun += cells.content[i].mass * duct.width
            record.energy[0].begun += cells.content[i].energy * duct.width


@inner_kernel
def _record_ends(
    duct: Duct, cells: Cells, record: Record, low: int, high: int, angle: float, turn: float, taken: int
) -> None:
    """Record the flow through both ends of the row of active cells.

    An end of the row is either an open end of the duct or a border to idle cells. The flow through a border is added to
    `idle`. If the stroke at an end of the duct begins or ends within the time step, only the flow during the stroke is
    recorded as flow out of the duct. The flow through this end during the rest of the step is also added to `idle`.
    """
    dt = turn / duct.speed
    for end in range(2):
        face, outward = (low, -1.0) if end == 0 else (high, 1.0)
        open_end = (low == 0) if end == 0 else (high == duct.cells)
        share = stroke_share(duct, duct.start + face * duct.width, angle, turn) if open_end else 0.0
        mass, energy = outward * cells.flux[face].mass * dt, outward * cells.flux[face].energy * dt
        add_outflow(record, end, taken, share * mass, share * energy)
        record.mass[0].idle += (1.0 - share) * mass
        record.energy[0].idle += (1.0 - share) * energy
        if share > 0.0:
            include_speed(record.extremes, cells.ends[end].mach, abs(cells.ends[end].velocity))
            include_demand(record.extremes, cells.ends[end].demand, end)


@inner_kernel
def _record_cells(
    gas: Gas, duct: Duct, cells: Cells, record: Record, low: int, high: int, angle: float, turn: float, longest: float
) -> None:
    """Record wall losses, work, mean temperatures (trapezoidal rule) and extremes of the active cells.

    The extremes leave out a cell whose stroke ends within the step (gas then flows in but no longer out), and one whose
    stroke began less than `_UNSETTLED` times `longest` ago, the largest permitted turn [rad]: its leakage settles
    within a fraction of a step, so that the implicit scheme overshoots.
    """
    old, new, loss, dt = cells.state, cells.next_state, cells.loss, turn / duct.speed
    for i in range(low, high):
        record.mass[0].walls += loss[i].mass * duct.width
        record.energy[0].walls += loss[i].energy * duct.width
        record.energy[0].work += loss[i].work * duct.width
        rho, u, p = new[i].density, new[i].velocity, new[i].pressure
        before, after = old[i].pressure / old[i].density, p / rho
        static = 0.5 * (before + after) / gas.constant
        dynamic = 0.25 * (old[i].velocity ** 2 + u**2) / gas.heat_capacity
        add_means(record.profile, i, static, static + dynamic, dt, cells.share[i])
        if duct.first_angle + _UNSETTLED * longest <= phase_of(duct, i, angle + turn) <= stroke_end(duct):
            mach = abs(u) / np.sqrt(gas.exponent * p / rho)
            include_pressure(record.profile, i, p)
            include_speed(record.extremes, mach, abs(u))
            record.profile[i].mach = max(record.profile[i].mach, mach)


@inner_kernel
def _take_over(cells: Cells, low: int, high: int) -> None:
    """Copy the state at the end of a step to the start of the next step."""
    for i in range(low, high):
        cells.content[i] = cells.next_content[i]
        cells.state[i] = cells.next_state[i]


@inner_kernel
def _record_field(
    gas: Gas, duct: Duct, cells: Cells, record: Record, low: int, high: int, k: int, angle: float
) -> None:
    """Record the gas in the active cells at `angle` [rad], in row k of the field.

    Cells whose stroke is over at this angle are left out.
    """
    for i in range(low, high):
        if phase_of(duct, i, angle) <= stroke_end(duct):
            rho, u, p = cells.state[i].density, cells.state[i].velocity, cells.state[i].pressure
            record.field[k, i].pressure = p
            record.field[k, i].mach = abs(u) / np.sqrt(gas.exponent * p / rho)
            record.field[k, i].temperature = p / (rho * gas.constant) + 0.5 * u * u / gas.heat_capacity
