"""What a gas step leaves in the record of its march."""

import numpy as np

from solvers.compiled import kernel
from solvers.pumping.flow import record as columns
from solvers.pumping.flow.duct import Duct, phase_of, stroke_end, stroke_share
from solvers.pumping.flow.nozzle import Gas
from solvers.pumping.flow.record import (
    BEGUN,
    ENDED,
    IDLE,
    LOW_END,
    LOW_OUTFLOW,
    WALLS,
    WORK,
    Record,
    book,
    book_cell_speed,
    book_demand,
    book_means,
    book_pressure,
    book_speed,
)
from solvers.pumping.gas.cells import (
    DEMAND,
    DENSITY,
    ENERGY,
    GIVEN,
    LEAKED,
    MACH,
    MASS,
    OUTWARD,
    PRESSURE,
    VELOCITY,
    WORKED,
    Cells,
)

_UNSETTLED = 5.0  # steps in which leakage finds its balance with the walls, and the waves of the beginning pass


@kernel
def book_changes(duct: Duct, cells: Cells, record: Record, low: int, high: int, new_low: int, new_high: int) -> None:
    """Give the content of cells whose stroke is over back to the surroundings, book that of those that begin."""
    for i in range(low, high):
        if i < new_low or i >= new_high:
            book(record, ENDED, cells.content[i, MASS] * duct.width, cells.content[i, ENERGY] * duct.width)
    for i in range(new_low, new_high):
        if i < low or i >= high:
            book(record, BEGUN, cells.content[i, MASS] * duct.width, cells.content[i, ENERGY] * duct.width)


@kernel
def book_ends(
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
        mass, energy = outward * cells.flux[face, MASS] * dt, outward * cells.flux[face, ENERGY] * dt
        book(record, LOW_END + end, share * mass, share * energy)
        book(record, IDLE, (1.0 - share) * mass, (1.0 - share) * energy)
        record.ends[taken, LOW_OUTFLOW + end] = share * mass
        if share > 0.0:
            book_speed(record, cells.ends[end, MACH], abs(cells.ends[end, OUTWARD]))
            book_demand(record, cells.ends[end, DEMAND])


@kernel
def book_cells(
    gas: Gas, duct: Duct, cells: Cells, record: Record, low: int, high: int, angle: float, turn: float, longest: float
) -> None:
    """Book what the walls did, means (trapezoidal) and extremes; `longest` [rad] the turn of a whole step.

    A cell that a step leads beyond its stroke has no extremes: it is shut for the rest, and piles up what comes. Nor
    has one that has just begun: it came with the state of the border, and the gaps answer a wall that starts at once
    within a fraction of a step, which an implicit scheme of second order overshoots.
    """
    old, new, loss, dt = cells.state, cells.next_state, cells.loss, turn / duct.speed
    for i in range(low, high):
        book(record, WALLS, loss[i, LEAKED] * duct.width, loss[i, GIVEN] * duct.width)
        record.energy[WORK] += loss[i, WORKED] * duct.width
        before, after = old[i, PRESSURE] / old[i, DENSITY], new[i, PRESSURE] / new[i, DENSITY]
        static = 0.5 * (before + after) / gas.constant
        dynamic = 0.25 * (old[i, VELOCITY] ** 2 + new[i, VELOCITY] ** 2) / gas.heat_capacity
        book_means(record, i, static, static + dynamic, dt, cells.share[i])
        if duct.first_angle + _UNSETTLED * longest <= phase_of(duct, i, angle + turn) <= stroke_end(duct):
            rho, u, p = new[i]
            book_pressure(record, i, p)
            book_cell_speed(record, i, abs(u) / np.sqrt(gas.exponent * p / rho), abs(u))


@kernel
def take_over(cells: Cells, low: int, high: int) -> None:
    """The end of one step is the start of the next."""
    for i in range(low, high):
        for k in range(3):
            cells.content[i, k], cells.state[i, k] = cells.next_content[i, k], cells.next_state[i, k]


@kernel
def sample(gas: Gas, duct: Duct, cells: Cells, record: Record, low: int, high: int, k: int, angle: float) -> None:
    """Field at the recorded angle k of the active cells whose stroke is not over."""
    for i in range(low, high):
        if phase_of(duct, i, angle) <= stroke_end(duct):
            rho, u, p = cells.state[i]
            record.field[k, i, columns.PRESSURE] = p
            record.field[k, i, columns.MACH] = abs(u) / np.sqrt(gas.exponent * p / rho)
            record.field[k, i, columns.TEMPERATURE] = p / (rho * gas.constant) + 0.5 * u * u / gas.heat_capacity
