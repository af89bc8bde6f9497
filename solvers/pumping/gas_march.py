"""The march of a duct through its strokes: steps, slices that come and go, and the books."""

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.pumping.duct import (
    ACTIVE,
    BEGUN,
    ENDED,
    IDLE,
    LARGEST_DEMAND,
    LARGEST_MACH,
    LARGEST_PRESSURE,
    LARGEST_VELOCITY,
    LOW_END,
    PEAK,
    SMALLEST_PRESSURE,
    STAGNATION,
    STATIC,
    WALLS,
    WORK,
    Duct,
    Record,
    stroke_end,
    stroke_share,
    wall_values,
)
from solvers.pumping.gas_step import Cells, set_walls, step
from solvers.pumping.nozzle import Gas
from solvers.pumping.riemann import front_face

COURANT = 0.7
_ROUNDING = 1e-6  # of a step, by which it may be longer rather than leave so little
_RETRIES = 12
_STEEP = 0.5  # share of a cell's density or pressure below which nothing is extrapolated from it


@kernel
def march(gas: Gas, duct: Duct, cells: Cells, angles: FloatArray, record: Record, order: int) -> int:
    """March from the first of `angles` [rad] to the last, landing on each; the number of steps, negative if it failed.

    Steps are as long as waves allow, the last before an angle is what remains: where one more is needed it is short at
    first, and results change steadily with whatever the step length depends on.
    Fails with -1 where the record has no room for more steps, with -2 where no step length gives a physical state.
    """
    angle, taken, low, high = angles[0], 0, 0, 0
    for k in range(1, angles.size):
        landed = False
        while not landed:
            remaining, longest = angles[k] - angle, _longest_turn(gas, duct, cells, low, high)
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
            if taken == record.ends.shape[0]:
                return -1
            _empty(duct, cells, record, low, high, new_low, new_high)
            _enter(duct, cells, record, low, high, new_low, new_high)
            low, high = new_low, new_high
            if high > low:
                record.ends[taken, 0] = (angle + 0.5 * turn - angles[0]) / duct.speed
                _book_ends(duct, cells, record, low, high, angle, turn, taken)
                _book_cells(gas, duct, cells, record, low, high, angle, turn)
                taken += 1
            landed = turn == remaining
            angle = angles[k] if landed else angle + turn
        _sample(gas, cells, record, low, high, k)
    _empty(duct, cells, record, low, high, 0, 0)
    return taken


@kernel
def _taking_part(gas: Gas, duct: Duct, angle: float, turn: float) -> tuple[int, int]:
    """First cell that takes part in a step of `turn` from `angle` [rad], and the one after the last.

    A cell does while its centre is in its stroke, the first also while its outer end is, the last likewise: whatever
    leaves through an end leaves while that end is open. Walls and books count the share of the step in the stroke.
    Where the stroke runs along the face faster than sound, cells come a width early: gas that the one behind them
    pushes on would pile up at the border, and in truth does not reach it.
    """
    low, high, rear = 0, 0, duct.cells - 1
    early = duct.lag * duct.width if duct.speed >= duct.lag * gas.sound_speed else 0.0
    for i in range(duct.cells):
        centre = (i + 0.5) * duct.width
        first, last = 0.0 if i == 0 else centre, duct.cells * duct.width if i == rear else centre
        if angle - duct.lag * (duct.start + last) >= stroke_end(duct):
            low = i + 1
        if angle + turn - duct.lag * (duct.start + first) + early > duct.first_angle:
            high = i + 1
    return low, max(low, high)


@kernel
def _longest_turn(gas: Gas, duct: Duct, cells: Cells, low: int, high: int) -> float:
    """Turn of the owner [rad] in which no wave crosses more than the Courant number's share of a cell."""
    fastest = gas.sound_speed
    for i in range(low, high):
        w = cells.state[i]
        fastest = max(fastest, abs(w[1]) + np.sqrt(gas.exponent * w[2] / w[0]))
    return COURANT * duct.width / fastest * duct.speed


@kernel
def _fill(gas: Gas, duct: Duct, cells: Cells, low: int, high: int, new_low: int, new_high: int, angle: float) -> None:
    """The gas of the border in the cells whose stroke begins."""
    rho, u, p = _border(gas, duct, cells, low, high)
    for i in range(new_low, new_high):
        if i < low or i >= high:
            area = wall_values(duct, duct.start + (i + 0.5) * duct.width, angle)[0]
            cells.content[i, 0], cells.content[i, 1] = rho * area, rho * u * area
            cells.content[i, 2] = (p / (gas.exponent - 1.0) + 0.5 * rho * u * u) * area
            cells.state[i, 0], cells.state[i, 1], cells.state[i, 2] = rho, u, p


@kernel
def _border(gas: Gas, duct: Duct, cells: Cells, low: int, high: int) -> tuple[float, float, float]:
    """State of the border to the slices that come next, where their centres are: a cell's width ahead of the last.

    Ambient gas at rest where no cell is active yet.
    """
    if not low < high < duct.cells:
        return gas.density, 0.0, gas.pressure
    last, before = cells.state[high - 1], cells.state[max(high - 2, low)]
    rho, p = 2.0 * last[0] - before[0], 2.0 * last[2] - before[2]
    if rho < _STEEP * last[0] or p < _STEEP * last[2]:
        return front_face(gas, duct.speed / duct.lag, last[0], last[1], last[2])
    return front_face(gas, duct.speed / duct.lag, rho, 2.0 * last[1] - before[1], p)


@kernel
def _empty(duct: Duct, cells: Cells, record: Record, low: int, high: int, new_low: int, new_high: int) -> None:
    """Give the content of cells whose stroke is over back to the surroundings."""
    for i in range(low, high):
        if i < new_low or i >= new_high:
            record.mass[ENDED] += cells.content[i, 0] * duct.width
            record.energy[ENDED] += cells.content[i, 2] * duct.width


@kernel
def _enter(duct: Duct, cells: Cells, record: Record, low: int, high: int, new_low: int, new_high: int) -> None:
    """Book the content of cells whose stroke begins."""
    for i in range(new_low, new_high):
        if i < low or i >= high:
            record.mass[BEGUN] += cells.content[i, 0] * duct.width
            record.energy[BEGUN] += cells.content[i, 2] * duct.width


@kernel
def _book_ends(
    duct: Duct, cells: Cells, record: Record, low: int, high: int, angle: float, turn: float, taken: int
) -> None:
    """Book what left through both ends of the active cells: ends of the duct, or borders to idle slices.

    The end of the duct counts as one for the share of the step in which it is in its stroke itself.
    """
    dt = turn / duct.speed
    for end in range(2):
        face, outward = (low, -1.0) if end == 0 else (high, 1.0)
        open_end = (low == 0) if end == 0 else (high == duct.cells)
        share = stroke_share(duct, duct.start + face * duct.width, angle, turn) if open_end else 0.0
        mass, energy = outward * cells.flux[face, 0] * dt, outward * cells.flux[face, 2] * dt
        record.mass[LOW_END + end] += share * mass
        record.energy[LOW_END + end] += share * energy
        record.mass[IDLE] += (1.0 - share) * mass
        record.energy[IDLE] += (1.0 - share) * energy
        record.ends[taken, 1 + end] = share * mass
        if share > 0.0:
            record.extremes[LARGEST_MACH] = max(record.extremes[LARGEST_MACH], cells.ends[end, 1])
            record.extremes[LARGEST_VELOCITY] = max(record.extremes[LARGEST_VELOCITY], abs(cells.ends[end, 2]))
            record.extremes[LARGEST_DEMAND] = max(record.extremes[LARGEST_DEMAND], cells.ends[end, 0])


@kernel
def _book_cells(
    gas: Gas, duct: Duct, cells: Cells, record: Record, low: int, high: int, angle: float, turn: float
) -> None:
    """Book what the walls did and means (trapezoidal), and take over the new state."""
    old, new, content, loss, dt = cells.state, cells.next_state, cells.content, cells.loss, turn / duct.speed
    for i in range(low, high):
        record.mass[WALLS] += loss[i, 0] * duct.width
        record.energy[WALLS] += loss[i, 1] * duct.width
        record.energy[WORK] += loss[i, 2] * duct.width
        share, profile = cells.share[i], record.profile
        static = 0.5 * (old[i, 2] / old[i, 0] + new[i, 2] / new[i, 0]) / gas.constant
        dynamic = 0.25 * (old[i, 1] ** 2 + new[i, 1] ** 2) / gas.heat_capacity
        profile[i, STATIC] += static * dt * share
        profile[i, STAGNATION] += (static + dynamic) * dt * share
        profile[i, ACTIVE] += dt * share
        if angle + turn - duct.lag * (duct.start + (i + 0.5) * duct.width) <= stroke_end(duct):
            _book_extremes(gas, record, new, i)
        for k in range(3):
            content[i, k], old[i, k] = cells.next_content[i, k], new[i, k]


@kernel
def _book_extremes(gas: Gas, record: Record, state: FloatArray, i: int) -> None:
    """Extremes of a cell in its stroke; one that a step leads beyond is shut for its rest, and piles up what comes."""
    profile, extremes, (rho, u, p) = record.profile, record.extremes, state[i]
    profile[i, PEAK] = max(profile[i, PEAK], p)
    extremes[LARGEST_PRESSURE] = max(extremes[LARGEST_PRESSURE], p)
    extremes[SMALLEST_PRESSURE] = min(extremes[SMALLEST_PRESSURE], p)
    extremes[LARGEST_MACH] = max(extremes[LARGEST_MACH], abs(u) / np.sqrt(gas.exponent * p / rho))
    extremes[LARGEST_VELOCITY] = max(extremes[LARGEST_VELOCITY], abs(u))


@kernel
def _sample(gas: Gas, cells: Cells, record: Record, low: int, high: int, k: int) -> None:
    """Field of the active cells at a recorded angle."""
    for i in range(low, high):
        rho, u, p = cells.state[i]
        record.field[k, i, 0] = p
        record.field[k, i, 1] = abs(u) / np.sqrt(gas.exponent * p / rho)
        record.field[k, i, 2] = p / (rho * gas.constant) + 0.5 * u * u / gas.heat_capacity
