"""Calculation of the hot unit that the inputs describe, and of the cold unit on request."""

from dataclasses import replace

from solvers.arrays import FloatArray
from solvers.drive_train import model
from solvers.drive_train.inputs import DriveTrainInputs
from solvers.drive_train.results import DriveTrainResult, States
from solvers.errors import InvalidInput, NoSolution
from solvers.heat_balance import Cooling
from solvers.notices import Notice


def solve(inputs: DriveTrainInputs, start: FloatArray | None = None) -> DriveTrainResult:
    """Compute the hot unit and, if `inputs.states` contains "cold", the cold unit.

    Parameters
    ----------
    inputs : DriveTrainInputs
        The unit.
    start : FloatArray of shape (stations,), optional
        Start value of the iteration: the gap due to the shafts of a similar unit [m].

    Returns
    -------
    DriveTrainResult
        Results of the hot unit, and of the cold unit if requested. Warnings that only the cold unit has are added to
        the warnings of the hot unit. If the cold unit has no solution, or if the oil is out of range at the reference
        temperature, the results of the cold unit are None and a warning states the cause.

    Raises
    ------
    InvalidInput
        The errors of `model.solve` for the hot unit.
    NoSolution
        The errors of `model.solve` for the hot unit.
    """
    hot = model.solve(inputs, start)
    if "cold" not in inputs.states:
        return hot
    try:
        other = model.solve(cool_down(inputs), start)
    except (NoSolution, InvalidInput) as failure:
        notice = Notice("no_cold_solution", f"the cold unit: {failure.message}", "states")
        return replace(hot, states=States(None), warnings=(*hot.warnings, notice))
    of_hot = {(notice.code, notice.field) for notice in hot.warnings}
    new = [notice for notice in other.warnings if (notice.code, notice.field) not in of_hot]
    notices = tuple(replace(notice, message=f"the cold unit: {notice.message}") for notice in new)
    return replace(hot, states=States(other), warnings=(*hot.warnings, *notices))


def cool_down(inputs: DriveTrainInputs) -> DriveTrainInputs:
    """Return the inputs of the cold unit.

    The teeth have the reference temperature, pumping does not heat the teeth, and the supports of the shafts do not
    grow. The bulk temperature of the contact is the reference temperature too, unless the inputs give a bulk
    temperature. There is no heat balance.
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
