"""Quasi-one-dimensional gas dynamics of a tooth space: the grid-convergent flow model."""

from math import ceil

import numpy as np

from solvers.arrays import FloatArray
from solvers.errors import NoSolution
from solvers.pumping.duct import Duct, empty_record
from solvers.pumping.face import Stretch
from solvers.pumping.flow import March, SpaceFlow, space_flow
from solvers.pumping.gas_march import COURANT, march
from solvers.pumping.gas_step import empty_cells
from solvers.pumping.nozzle import Gas
from solvers.pumping.stroke import StrokeTable

LEAST_SLICES = 4
_HASTE = 2.5  # steps may be this much shorter than sound at rest asks for
_ANGLES = 201


def sample_angles(table: StrokeTable, lag: float, face_width: float) -> FloatArray:
    """Angles of the owner [rad] from the first slice's entry to the last one's exit, where fields are recorded."""
    return np.linspace(table.limits.start, table.limits.end + lag * face_width, _ANGLES)


def duct(table: StrokeTable, stretch: Stretch, lag: float, speed: float, discharge: float, *, transport: bool) -> Duct:
    """A stretch of tooth space at a speed of its owner [rad/s]; `lag` of the stroke per metre of face [rad/m]."""
    return Duct(
        start=stretch.start,
        width=stretch.width,
        cells=stretch.cells,
        lag=lag,
        speed=speed,
        first_angle=table.limits.start,
        angle_step=(table.limits.end - table.limits.start) / (table.angle.size - 1),
        table=table.columns(wall_transport=transport),
        discharge=discharge,
    )


def gas_dynamics(gas: Gas, ducts: list[tuple[Stretch, Duct]], angle: FloatArray) -> SpaceFlow:
    """March every stretch of a tooth space through its stroke.

    Raises NoSolution: unphysical_state.
    """
    room = ceil(_HASTE * max(_steps(gas, part, angle) for _, part in ducts)) + 8 * angle.size
    marches = []
    for stretch, part in ducts:
        record = empty_record(gas, angle.size, part.cells, room)
        steps = march(gas, part, empty_cells(part.cells), angle, record, 2)
        if steps < 0:
            reason = "the step limit was reached" if steps == -1 else "no step length gave a physical state"
            duration = float(angle[-1] - angle[0]) / part.speed
            remaining = {"remaining_share_of_stroke": 1.0 - float(record.ends[:, 0].max()) / duration}
            raise NoSolution("unphysical_state", f"the gas dynamics failed: {reason}; try fewer slices", remaining)
        marches.append(March(stretch, record, steps))
    return space_flow(angle, marches, conserves_energy=True)


def cell_steps(gas: Gas, ducts: list[tuple[Stretch, Duct]], angle: FloatArray) -> float:
    """Cells times steps of a march, while sound is near that of gas at rest."""
    return sum(part.cells * _steps(gas, part, angle) for _, part in ducts)


def _steps(gas: Gas, part: Duct, angle: FloatArray) -> float:
    return float(angle[-1] - angle[0]) / part.speed * gas.sound_speed / (COURANT * part.width)
