"""Quasi-one-dimensional gas dynamics of a tooth space: the grid-convergent flow model."""

from math import ceil

from solvers.arrays import FloatArray
from solvers.errors import NoSolution
from solvers.pumping.flow.duct import Duct
from solvers.pumping.flow.nozzle import Gas
from solvers.pumping.flow.record import TIME, empty_record
from solvers.pumping.flow.space_flow import March, SpaceFlow, space_flow
from solvers.pumping.gas.cells import empty_cells
from solvers.pumping.gas.march import COURANT, march
from solvers.pumping.space.face import Stretch

LEAST_SLICES = 4
_HASTE = 2.5  # steps may be this much shorter than sound at rest asks for


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
            remaining = {"remaining_share_of_stroke": 1.0 - float(record.ends[:, TIME].max()) / duration}
            raise NoSolution("unphysical_state", f"the gas dynamics failed: {reason}; try fewer slices", remaining)
        marches.append(March(stretch, record, steps))
    return space_flow(angle, marches, conserves_energy=True)


def cell_steps(gas: Gas, ducts: list[tuple[Stretch, Duct]], angle: FloatArray) -> float:
    """Cells times steps of a march, while sound is near that of gas at rest."""
    return sum(part.cells * _steps(gas, part, angle) for _, part in ducts)


def _steps(gas: Gas, part: Duct, angle: FloatArray) -> float:
    return float(angle[-1] - angle[0]) / part.speed * gas.sound_speed / (COURANT * part.width)
