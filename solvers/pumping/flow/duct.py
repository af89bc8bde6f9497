"""A stretch of tooth space as a duct that is cut into cells along the face; the walls of the cells move."""

from typing import NamedTuple

from solvers.arrays import FloatArray, RecordArray, floats, records
from solvers.compiled import inner_kernel

WALL = floats("area", "clearance", "carried")
"""Names of the fields of `Wall`, for records."""


class Duct(NamedTuple):
    """A stretch of a tooth space cut into equal cells.

    `start`, `width` in m; `lag` [rad/m] is the delay of the stroke along the face. Row k of `table` holds the walls at
    the owner's angle `first_angle` + k `angle_step` [rad].
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
    """Walls of a tooth space at one position and angle.

    `area` [m^2], `clearance` of both sides [m], and the gas per metre of face that the flanks have `carried` out of the
    space since the stroke began [m^2].
    """

    area: float
    clearance: float
    carried: float


def wall_table(area: FloatArray, clearance: FloatArray, carried: FloatArray) -> RecordArray:
    """Build a table of walls from the values of `Wall` at equal steps of the angle of the gear."""
    table = records(area.size, WALL)
    table.area, table.clearance, table.carried = area, clearance, carried
    return table


@inner_kernel
def wall_at(duct: Duct, z: float, angle: float) -> Wall:
    """Walls at the position z [m] for an `angle` [rad] of the owner; outside the stroke those of its ends."""
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


@inner_kernel
def phase_of(duct: Duct, i: int, angle: float) -> float:
    """Compute the phase of cell i [rad]: the owner's angle minus the lag of the cell.

    The walls of the cell depend on the phase only.
    """
    return angle - duct.lag * (duct.start + (i + 0.5) * duct.width)


@inner_kernel
def active_range(duct: Duct, angle: float) -> tuple[int, int]:
    """Find the first active cell and the cell after the last active cell.

    A cell is active if the phase of the cell lies within the stroke.
    """
    low, high = 0, 0
    for i in range(duct.cells):
        phase = phase_of(duct, i, angle)
        if phase > stroke_end(duct):
            low = i + 1
        if phase >= duct.first_angle:
            high = i + 1
    return low, max(low, high)


@inner_kernel
def stroke_end(duct: Duct) -> float:
    """Compute the phase [rad] at which the stroke ends."""
    end: float = duct.first_angle + duct.angle_step * (duct.table.size - 1)
    return end


@inner_kernel
def stroke_share(duct: Duct, z: float, angle: float, turn: float) -> float:
    """Share of a step of `turn` [rad] from `angle` [rad] that lies within the stroke at the position z [m]."""
    phase = angle - duct.lag * z
    inside = min(phase + turn, stroke_end(duct)) - max(phase, duct.first_angle)
    return min(max(inside / turn, 0.0), 1.0)
