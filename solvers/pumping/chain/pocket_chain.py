"""The paper's chain of pockets (Eqs. 2-7). Its pressures depend on the number of pockets, which is a model constant."""

from math import ceil

from solvers.arrays import FloatArray
from solvers.errors import NoSolution
from solvers.pumping.chain.march import march_chain
from solvers.pumping.chain.pockets import empty_pockets
from solvers.pumping.flow.duct import Duct
from solvers.pumping.flow.nozzle import Gas
from solvers.pumping.flow.record import empty_record
from solvers.pumping.flow.space_flow import March, SpaceFlow, space_flow
from solvers.pumping.inputs import Closure
from solvers.pumping.space.face import Stretch

STEPS = 2000  # at least
_REFINEMENTS = (1, 2, 4, 8)  # of the steps, until Newton's method converges in all of them


def pocket_chain(
    gas: Gas, ducts: list[tuple[Stretch, Duct]], angle: FloatArray, closure: Closure, steps: int = STEPS
) -> SpaceFlow:
    """March every stretch of a tooth space through its stroke in at least so many steps.

    Raises NoSolution: newton_not_converged.
    """
    substeps = ceil(steps / (angle.size - 1))
    marches = [_march(gas, stretch, duct, angle, closure, substeps) for stretch, duct in ducts]
    return space_flow(angle, marches, conserves_energy=closure is Closure.ENERGY)


def _march(gas: Gas, stretch: Stretch, duct: Duct, angle: FloatArray, closure: Closure, substeps: int) -> March:
    """The march of one stretch, in finer steps where a flow that turns round within one stalls Newton's method."""
    for refinement in _REFINEMENTS:
        count = refinement * substeps
        record = empty_record(gas, angle.size, duct.cells, count * (angle.size - 1))
        pockets = empty_pockets(duct.cells)
        taken, error = march_chain(gas, duct, pockets, angle, count, record, closure is Closure.ISENTROPIC)
        if taken > 0:
            return March(stretch, record, taken)
    raise NoSolution(
        "newton_not_converged",
        "a time step of the pocket chain did not converge; try a higher speed, fewer slices or gas dynamics",
        {"content_error": error},
    )
