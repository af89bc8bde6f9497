"""The march of a duct through its strokes: steps, and slices that come and go."""

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.pumping.flow.duct import Duct, stroke_end, wall_at
from solvers.pumping.flow.nozzle import Gas
from solvers.pumping.flow.record import TIME, Record
from solvers.pumping.gas.books import book_cells, book_changes, book_ends, sample, take_over
from solvers.pumping.gas.cells import DENSITY, ENERGY, MASS, MOMENTUM, PRESSURE, VELOCITY, Cells, set_walls
from solvers.pumping.gas.riemann import front_face
from solvers.pumping.gas.step import step

COURANT = 0.7
_ROUNDING = 1e-6  # of a step, by which it may be longer rather than leave so little
_RETRIES = 12
_AHEAD = 4.0  # widths by which cells come early where no wave outruns their stroke
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
            if taken == record.ends.shape[0]:
                return -1
            book_changes(duct, cells, record, low, high, new_low, new_high)
            low, high = new_low, new_high
            if high > low:
                record.ends[taken, TIME] = (angle + 0.5 * turn - angles[0]) / duct.speed
                book_ends(duct, cells, record, low, high, angle, turn, taken)
                book_cells(gas, duct, cells, record, low, high, angle, turn, longest)
                take_over(cells, low, high)
                taken += 1
            landed = turn == remaining
            angle = angles[k] if landed else angle + turn
        sample(gas, duct, cells, record, low, high, k, angle)
    book_changes(duct, cells, record, low, high, 0, 0)
    return taken


@kernel
def _taking_part(gas: Gas, duct: Duct, angle: float, turn: float) -> tuple[int, int]:
    """First cell that takes part in a step of `turn` from `angle` [rad], and the one after the last.

    A cell does while its centre is in its stroke, the first also while its outer end is, the last likewise: whatever
    leaves through an end leaves while that end is open. Walls and books count the share of the step in the stroke.
    Where the stroke runs along the face faster than sound, cells come some widths early: waves do not reach the border
    in truth, but on a grid they spread over a few cells. A border among those feeds what it lets pass into the cells
    that come next, and the flow takes one of two courses by how the steps fall.
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


@kernel
def _longest_turn(gas: Gas, duct: Duct, cells: Cells, low: int, high: int) -> float:
    """Turn of the owner [rad] in which no wave crosses more than the Courant number's share of a cell."""
    fastest = gas.sound_speed
    for i in range(low, high):
        w = cells.state[i]
        fastest = max(fastest, abs(w[VELOCITY]) + np.sqrt(gas.exponent * w[PRESSURE] / w[DENSITY]))
    return COURANT * duct.width / fastest * duct.speed


@kernel
def _fill(gas: Gas, duct: Duct, cells: Cells, low: int, high: int, new_low: int, new_high: int, angle: float) -> None:
    """The gas of the border in the cells whose stroke begins."""
    rho, u, p = _border(gas, duct, cells, low, high)
    for i in range(new_low, new_high):
        if i < low or i >= high:
            area = wall_at(duct, duct.start + (i + 0.5) * duct.width, angle).area
            cells.content[i, MASS], cells.content[i, MOMENTUM] = rho * area, rho * u * area
            cells.content[i, ENERGY] = (p / (gas.exponent - 1.0) + 0.5 * rho * u * u) * area
            cells.state[i, DENSITY], cells.state[i, VELOCITY], cells.state[i, PRESSURE] = rho, u, p


@kernel
def _border(gas: Gas, duct: Duct, cells: Cells, low: int, high: int) -> tuple[float, float, float]:
    """State of the border to the slices that come next, where their centres are: a cell's width ahead of the last.

    Ambient gas at rest where no cell is active yet.
    """
    if not low < high < duct.cells:
        return gas.density, 0.0, gas.pressure
    last, before = cells.state[high - 1], cells.state[max(high - 2, low)]
    rho = 2.0 * last[DENSITY] - before[DENSITY]
    u = 2.0 * last[VELOCITY] - before[VELOCITY]
    p = 2.0 * last[PRESSURE] - before[PRESSURE]
    if rho < _STEEP * last[DENSITY] or p < _STEEP * last[PRESSURE]:
        rho, u, p = last[DENSITY], last[VELOCITY], last[PRESSURE]
    return front_face(gas, duct.speed / duct.lag, rho, u, p)
