"""A stretch of tooth space as a duct: its grid, its moving walls, and what a march through it records."""

from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.pumping.nozzle import Gas

# Entries of the books `mass` and `energy` of a record, of its `extremes`, columns of its `profile`.
BEGUN, ENDED, LOW_END, HIGH_END, WALLS, IDLE, WORK = range(7)
LARGEST_PRESSURE, SMALLEST_PRESSURE, LARGEST_MACH, LARGEST_VELOCITY, LARGEST_DEMAND = range(5)
STATIC, STAGNATION, ACTIVE, PEAK = range(4)


class Duct(NamedTuple):
    """A stretch of a tooth space cut into equal cells.

    `start` [m] from the end that meshes first, `width` of a cell [m], `cells`; `lag` of the stroke per metre of face
    [rad/m]; `speed` of the owner [rad/s]; `table` of area, total clearance and carried gas at `first_angle` +
    k `angle_step` [rad]; `discharge` coefficient of the radial gaps.
    """

    start: float
    width: float
    cells: int
    lag: float
    speed: float
    first_angle: float
    angle_step: float
    table: FloatArray
    discharge: float


class Record(NamedTuple):
    """What a march leaves behind.

    field: (angles, cells, 3) pressure [Pa], axial Mach number, stagnation temperature [K]
    profile: (cells, 4) integral of temperature and of stagnation temperature [K s], active time [s], peak pressure [Pa]
    extremes: largest and smallest pressure [Pa], largest axial Mach number, largest axial velocity [m/s], largest Mach
        number that the ambient pressure asks for at an end (above one: choked)
    mass: content when slices begin, content when they end, outflow at the low end, at the high end, radially, to idle
        slices [kg]
    energy: the same [J], the radial one with the wall work; then the work done on the gas above ambient pressure [J]
    ends: (steps, 3) mid-step time [s], outflow in the step at the low and at the high end [kg]
    """

    field: FloatArray
    profile: FloatArray
    extremes: FloatArray
    mass: FloatArray
    energy: FloatArray
    ends: FloatArray


def empty_record(gas: Gas, angles: int, cells: int, steps: int) -> Record:
    """A record of ambient gas at rest."""
    field = np.zeros((angles, cells, 3))
    field[:, :, 0], field[:, :, 2] = gas.pressure, gas.temperature
    profile = np.zeros((cells, 4))
    profile[:, PEAK] = gas.pressure
    extremes = np.array([gas.pressure, gas.pressure, 0.0, 0.0, 0.0])
    return Record(field, profile, extremes, np.zeros(WORK), np.zeros(WORK + 1), np.zeros((steps, 3)))


@kernel
def wall_values(duct: Duct, z: float, angle: float) -> tuple[float, float, float]:
    """Area, clearance and carried gas at z when the owner stands at `angle`; end values outside the stroke."""
    position = (angle - duct.lag * z - duct.first_angle) / duct.angle_step
    last = duct.table.shape[0] - 1
    position = min(max(position, 0.0), float(last))
    k = min(int(position), last - 1)
    f = position - k
    low, high = duct.table[k], duct.table[k + 1]
    return (1.0 - f) * low[0] + f * high[0], (1.0 - f) * low[1] + f * high[1], (1.0 - f) * low[2] + f * high[2]


@kernel
def active_range(duct: Duct, angle: float) -> tuple[int, int]:
    """First active cell and the one after the last: those whose centre's phase lies in the stroke."""
    low, high = 0, 0
    for i in range(duct.cells):
        phase = angle - duct.lag * (duct.start + (i + 0.5) * duct.width)
        if phase > stroke_end(duct):
            low = i + 1
        if phase >= duct.first_angle:
            high = i + 1
    return low, max(low, high)


@kernel
def stroke_end(duct: Duct) -> float:
    """Phase at which the stroke ends [rad]."""
    end: float = duct.first_angle + duct.angle_step * (duct.table.shape[0] - 1)
    return end


@kernel
def stroke_share(duct: Duct, z: float, angle: float, turn: float) -> float:
    """Share of a step of `turn` from `angle` [rad] in which the place z [m] is in its stroke."""
    phase = angle - duct.lag * z
    inside = min(phase + turn, stroke_end(duct)) - max(phase, duct.first_angle)
    return min(max(inside / turn, 0.0), 1.0)
