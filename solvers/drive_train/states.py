"""The unit warm as described, and cold beside it."""

from dataclasses import replace

from solvers.arrays import FloatArray
from solvers.drive_train import model
from solvers.drive_train.inputs import DriveTrainInputs
from solvers.drive_train.results import DriveTrainResult, States
from solvers.errors import InvalidInput, NoSolution
from solvers.heat_balance import Cooling
from solvers.notices import Notice


def solve(inputs: DriveTrainInputs, start: FloatArray | None = None) -> DriveTrainResult:
    """The unit's answer, with that of its cold state where `inputs.states` asks for it.

    What only the cold unit warns of stands among the warnings. Raises what `model.solve` raises for the hot unit; a
    cold one without solution, or whose oil is none any more, is a warning.
    """
    found = model.solve(inputs, start)
    if "cold" not in inputs.states:
        return found
    try:
        other = model.solve(cold(inputs), start)
    except (NoSolution, InvalidInput) as failure:
        notice = Notice("no_cold_solution", f"the cold unit: {failure.message}", "states")
        return replace(found, states=States(None), warnings=(*found.warnings, notice))
    known = {(notice.code, notice.field) for notice in found.warnings}
    new = [notice for notice in other.warnings if (notice.code, notice.field) not in known]
    notices = tuple(replace(notice, message=f"the cold unit: {notice.message}") for notice in new)
    return replace(found, states=States(other), warnings=(*found.warnings, *notices))


def cold(inputs: DriveTrainInputs) -> DriveTrainInputs:
    """Every tooth at the reference temperature, nothing pumped warm, supports that have not grown.

    The contact's bulk temperature is a tooth's as well, unless it is given; there is no heat to balance.
    """
    heat, reference = inputs.heat, inputs.heat.reference
    mesh = replace(inputs.mesh, cooling=Cooling())
    if not inputs.bulk_given:
        mesh = replace(mesh, temperatures=replace(mesh.temperatures, bulk=reference, bulk_method="given"))
    return replace(
        inputs,
        mesh=mesh,
        heat=replace(heat, wall_response=0.0, wall_response_wheel=0.0, pinion_bulk=reference, wheel_bulk=reference),
        couplings=tuple(replace(coupling, alignment=None) for coupling in inputs.couplings),
    )
