"""Results of a drive train whose couplings, shafts, bearings and mesh are in balance."""

from dataclasses import replace
from functools import partial

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.drive_train.derived import derived
from solvers.drive_train.elements import coupling_results, hubs_of, shaft_results, warnings_of
from solvers.drive_train.gap.misalignment import misalignment
from solvers.drive_train.gap.thermal_lead import gas_heat
from solvers.drive_train.inputs import DriveTrainInputs
from solvers.drive_train.losses import force_balance, train_losses
from solvers.drive_train.notices import coupling_notices, load_notices, loss_notices, shaft_notices
from solvers.drive_train.prepared import prepare, settle
from solvers.drive_train.results import Convergence, DriveTrainResult, FaceLoad
from solvers.drive_train.safety import contact_of, flank_heat
from solvers.drive_train.unit_heat import asks_for_balance, warm_unit, with_safety_band
from solvers.heat_balance import over_the_flow
from solvers.scuffing.micropitting.wear import wear_asked_for
from solvers.scuffing.model import distribution
from solvers.scuffing.results import LoadDistribution
from solvers.scuffing.thermal.temperatures import in_force, oil_notices


def solve(inputs: DriveTrainInputs, start: FloatArray | None = None) -> DriveTrainResult:
    """Compute misalignment, load, safety, thrust and losses of a unit in one state, hot or cold.

    Raises InvalidInput: the errors of `check_inputs`, of the models of mesh, pumping and couplings, and of the heat
    balance. Raises NoSolution: if a part of the calculation has no solution. The code names this part: `drive_train`,
    `load_balance`, `journal`, `heat_balance` or `thermal_runaway`.
    """
    warm = None
    if asks_for_balance(inputs):
        warm = warm_unit(inputs, start)
        inputs, prepared, equilibrium = warm.inputs, warm.prepared, warm.equilibrium
    else:
        prepared = prepare(inputs)
        equilibrium = settle(inputs, prepared, start)
    system, mesh, thermal = prepared.unit, prepared.mesh, prepared.thermal
    spread = distribution(inputs.mesh.distribution, mesh.prepared, equilibrium.balance)
    contact, spread, flash, _, rule, ran = in_force(contact_of(inputs), spread)
    inputs = replace(inputs, mesh=contact)
    hubs = hubs_of(system, equilibrium)
    couplings = coupling_results(system, equilibrium, hubs)
    shafts = shaft_results(inputs, mesh.prepared.path, system, equilibrium, couplings)
    gas = gas_heat(inputs.pumping, inputs.mesh.distribution.load.pinion_speed)
    flank = flank_heat(inputs, spread, flash, thermal)
    heat = None if warm is None else with_safety_band(inputs, rule, warm.heat, flank.safety)
    load = face_load(spread)
    losses = train_losses(inputs, spread.friction_loss.power, gas.power, shafts, couplings, heat)
    return DriveTrainResult(
        misalignment=misalignment(inputs, system, mesh, thermal, equilibrium),
        load=load,
        shafts=shafts,
        couplings=couplings,
        flash=flank.flash,
        safety=flank.safety,
        losses=losses,
        balance=force_balance(system, equilibrium, _torques(inputs), mesh.transmitted),
        convergence=Convergence(equilibrium.iterations, equilibrium.residual),
        micropitting=flank.micropitting.answer,
        wear=wear_asked_for(inputs.mesh.micropitting, spread),
        mesh=spread,
        heat=heat,
        over_the_flow=None if warm is None else partial(over_the_flow, warm.balance),
        contact_temperature=frozen(flank.temperature),
        film_ratio=None if flank.micropitting.ratio is None else frozen(flank.micropitting.ratio),
        derived=derived(inputs, spread, ran, heat),
        warnings=(
            *spread.warnings,
            *coupling_notices(inputs, couplings, warnings_of(system, equilibrium)),
            *shaft_notices(inputs, shafts),
            *load_notices(inputs, load),
            *loss_notices(inputs, losses),
            *oil_notices(inputs.mesh, spread.path_of_contact, ran),
            *(() if heat is None else heat.warnings),
            *flank.warnings,
            *gas.warnings,
        ),
    )


def face_load(spread: LoadDistribution) -> FaceLoad:
    """Return the largest values of the load over the face, and the face load factor."""
    loaded = spread.load.face_load_factor is not None
    shares = np.trapezoid(spread.flank.line_load, axis=0)
    return FaceLoad(
        face_load_factor=spread.load.face_load_factor,
        face_load_at=float(spread.flank.face_fraction[int(np.argmax(shares))]) if loaded else None,
        max_line_load=spread.load.max_line_load,
        max_pressure=spread.pressure.max,
        contact_fraction=spread.load.contact_fraction,
        transmission_error_pp=spread.transmission_error.peak_to_peak,
    )


def _torques(inputs: DriveTrainInputs) -> tuple[float, float]:
    """Return the torques of pinion and wheel [N m]."""
    gears, load = inputs.mesh.distribution.gears, inputs.mesh.distribution.load
    return load.torque, load.torque * gears.wheel.teeth / gears.pinion.teeth
