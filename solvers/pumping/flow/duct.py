"""A stretch of tooth space as a duct, cut into cells along the face, whose walls move with the gears."""

from typing import NamedTuple

from solvers.arrays import FloatArray, RecordArray, floats, records
from solvers.compiled import kernel

WALL = floats("area", "clearance", "carried")
"""Walls of a cell, see `Wall`."""


class Duct(NamedTuple):
    """A stretch of a tooth space cut into equal cells.

    `start` [m] from the end that meshes first; `width` of a cell [m]; number of `cells`; `lag`: angle by which the
    stroke comes later per metre of face [rad/m]; `speed` of the owner [rad/s]; `table` of walls (`wall_table`), whose
    row k belongs to the angle `first_angle` + k `angle_step` [rad]; `discharge` coefficient of the radial gaps.
    """

    start: float
    width: float
    cells: int
    lag: float
    speed: float
    first_angle: float
    angle_step: float
    table: RecordArray
    discharge: float


class Wall(NamedTuple):
    """Section of a tooth space [m^2], sum of both clearances [m], area of gas that the flanks carried out [m^2]."""

    area: float
    clearance: float
    carried: float


def wall_table(area: FloatArray, clearance: FloatArray, carried: FloatArray) -> RecordArray:
    """Build the table of walls from arrays of the values in `Wall` at equal steps of the owner's angle."""
    table = records(area.size, WALL)
    table.area, table.clearance, table.carried = area, clearance, carried
    return table


@kernel
def wall_at(duct: Duct, z: float, angle: float) -> Wall:
    """Interpolate the walls at z [m] for an `angle` [rad] of the owner; outside the stroke, return the end values."""
    position = (angle - duct.lag * z - duct.first_angle) / duct.angle_step
    table = duct.table
    last = table.size - 1
    position = min(max(position, 0.0), float(last))
    k = min(int(position), last - 1)
    f = position - k
    return Wall(
        (1.0 - f) * table[k].area + f * table[k + 1].area,
        (1.0 - f) * table[k].clearance + f * table[k + 1].clearance,
        (1.0 - f) * table[k].carried + f * table[k + 1].carried,
    )


@kernel
def phase_of(duct: Duct, i: int, angle: float) -> float:
    """Compute the phase of cell i [rad], on which its walls depend: the owner's angle less the lag of the cell."""
    return angle - duct.lag * (duct.start + (i + 0.5) * duct.width)


@kernel
def active_range(duct: Duct, angle: float) -> tuple[int, int]:
    """Find the first active cell and the cell after the last active one: cells whose phase is in the stroke."""
    low, high = 0, 0
    for i in range(duct.cells):
        phase = phase_of(duct, i, angle)
        if phase > stroke_end(duct):
            low = i + 1
        if phase >= duct.first_angle:
            high = i + 1
    return low, max(low, high)


@kernel
def stroke_end(duct: Duct) -> float:
    """Compute the phase at which the stroke ends [rad]."""
    end: float = duct.first_angle + duct.angle_step * (duct.table.size - 1)
    return end


@kernel
def stroke_share(duct: Duct, z: float, angle: float, turn: float) -> float:
    """Compute the share of a step of `turn` from `angle` [rad] in which the position z [m] is in its stroke."""
    phase = angle - duct.lag * z
    inside = min(phase + turn, stroke_end(duct)) - max(phase, duct.first_angle)
    return min(max(inside / turn, 0.0), 1.0)
