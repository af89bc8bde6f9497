"""Calculation of the hot unit that the inputs describe, and of the cold unit on request."""

from dataclasses import replace

from solvers.arrays import FloatArray
from solvers.drive_train import model
from solvers.drive_train.inputs import DriveTrainInputs
from solvers.drive_train.results import DriveTrainResult, States
from solvers.drive_train.safety import contact_of
from solvers.errors import InvalidInput, NoSolution
from solvers.heat_balance import Cooling
from solvers.notices import Notice


def solve(inputs: DriveTrainInputs, start: FloatArray | None = None) -> DriveTrainResult:
    """Compute the hot unit and, if `inputs.states` contains "cold", the cold unit.

    Parameters
    ----------
    inputs : DriveTrainInputs
        The unit.
    start : FloatArray of shape (faces, stations), optional
        Gap due to the shafts of a similar unit, to start from [m].

    Returns
    -------
    DriveTrainResult
        Results of the hot unit, with the warnings that only the cold one has. The cold unit is None, and a warning says
        why, if it has no solution or if its oil is out of range at the reference temperature.

    Raises
    ------
    InvalidInput
        The errors of `model.solve` for the hot unit.
    NoSolution
        The errors of `model.solve` for the hot unit.

    Examples
    --------
    >>> from solvers import drive_train, pumping, scuffing
    >>> gears = scuffing.GearPairInputs(scuffing.GearTeeth(25), scuffing.GearTeeth(76), 4e-3, 0.1, rack_tip_radius=0.3)
    >>> load = scuffing.LoadDistributionInputs(gears, scuffing.Load(900.0, 157.0))
    >>> mesh = scuffing.ScuffingInputs(load, lubrication="closed_form")
    >>> gas = pumping.PumpingSetup(gears, model=pumping.PumpingModel(pumping.Flow.INCOMPRESSIBLE))
    >>> bearings = drive_train.RigidBearing(0.05), drive_train.RigidBearing(0.35)
    >>> shaft = drive_train.Shaft((drive_train.ShaftSection(0.4, 0.1),), bearings, torque_position=0.0)
    >>> unit = drive_train.DriveTrainInputs(mesh, gas, 0.15, shaft, shaft)
    >>> round(drive_train.solve(unit).load.face_load_factor, 1)
    2.7
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
    contact = contact_of(inputs)
    has_bulk = contact.known_oil is not None or contact.temperatures.bulk is not None
    if not has_bulk:  # a dry unit whose cold teeth must not count as a given bulk temperature
        mesh = replace(mesh, temperatures=replace(mesh.temperatures, bulk_method="estimated"))
    elif not inputs.bulk_given:
        mesh = replace(mesh, temperatures=replace(mesh.temperatures, bulk=reference, bulk_method="given"))
    return replace(
        inputs,
        mesh=mesh,
        face_heat=None,
        heat=replace(heat, wall_response=0.0, wall_response_wheel=0.0, pinion_bulk=reference, wheel_bulk=reference),
        couplings=tuple(replace(coupling, alignment=None) for coupling in inputs.couplings),
    )
