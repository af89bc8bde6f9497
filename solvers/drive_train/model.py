"""Results of a drive train whose couplings, shafts, bearings and mesh are in balance."""

from collections.abc import Iterable
from dataclasses import replace
from functools import partial

from solvers.arrays import FloatArray
from solvers.drive_train.derived import derived
from solvers.drive_train.elements import coupling_results, hubs_of, shaft_results, warnings_of
from solvers.drive_train.face_heat import face_heats, with_amplification_band
from solvers.drive_train.gap.thermal_lead import gas_heat
from solvers.drive_train.helices import axial_balance, decisive, loaded_face
from solvers.drive_train.inputs import DriveTrainInputs
from solvers.drive_train.losses import force_balance, train_losses
from solvers.drive_train.notices import (
    coupling_notices,
    face_heat_notices,
    helix_notices,
    load_notices,
    loss_notices,
    shaft_notices,
)
from solvers.drive_train.prepared import prepare, settle
from solvers.drive_train.results import Convergence, DriveTrainResult, HelixResult
from solvers.drive_train.unit_heat import asks_for_balance, check_face_heat, warm_unit, with_safety_band
from solvers.heat_balance import over_the_flow
from solvers.heat_balance.results import FaceHeat
from solvers.notices import Notice
from solvers.scuffing.thermal.temperatures import oil_notices


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
        check_face_heat(inputs)
        prepared = prepare(inputs)
        equilibrium = settle(inputs, prepared, start)
    system = prepared.unit
    flanks = [None] * len(prepared.meshes) if warm is None else warm.helix_flanks
    faces = [loaded_face(inputs, prepared, equilibrium, k, own) for k, own in enumerate(flanks)]
    number = decisive(faces)
    face = faces[number]
    inputs, spread, flank, result = face.inputs, face.spread, face.flank, face.result
    hubs = hubs_of(system, equilibrium)
    couplings = coupling_results(system, equilibrium, hubs)
    shafts = shaft_results(inputs, prepared.path, system, equilibrium, couplings)
    gas = gas_heat(inputs.pumping, inputs.mesh.distribution.load.pinion_speed)
    heat = None if warm is None else with_safety_band(inputs, face.rule, warm, number, flank.safety)
    along = () if warm is None else face_heats(warm)
    if heat is not None and warm is not None and along:
        heat = with_amplification_band(replace(heat, face=along[number]), warm, number)
    frictions = [own.spread.friction_loss.power for own in faces]
    friction = None if None in frictions else sum(power for power in frictions if power is not None)
    losses = train_losses(inputs, friction, gas.power, shafts, couplings, heat)
    double = system.split is not None
    axial = axial_balance(inputs, prepared, equilibrium, couplings)
    return DriveTrainResult(
        misalignment=result.misalignment,
        load=result.load,
        shafts=shafts,
        couplings=couplings,
        flash=flank.flash,
        safety=flank.safety,
        losses=losses,
        balance=force_balance(system, equilibrium, _torques(inputs), prepared.meshes[0].transmitted),
        convergence=Convergence(equilibrium.iterations, equilibrium.residual),
        micropitting=result.micropitting,
        wear=result.wear,
        mesh=spread,
        heat=heat,
        over_the_flow=None if warm is None else partial(over_the_flow, warm.balance),
        contact_temperature=result.contact_temperature,
        film_ratio=result.film_ratio,
        derived=derived(inputs, spread, face.ran, heat),
        axial=axial,
        helices=_helices([own.result for own in faces], along) if double else None,
        decisive_helix=number + 1 if double else None,
        warnings=(
            *_once(notice for own in faces for notice in own.spread.warnings),
            *coupling_notices(inputs, couplings, warnings_of(system, equilibrium)),
            *shaft_notices(inputs, shafts),
            *load_notices(inputs, [own.result.load for own in faces]),
            *loss_notices(inputs, losses),
            *(() if axial is None else helix_notices(inputs, axial, face.ran, heat)),
            *face_heat_notices(inputs, prepared.path, along),
            *oil_notices(inputs.mesh, spread.path_of_contact, face.ran),
            *(() if heat is None else heat.warnings),
            *_once(notice for own in faces for notice in own.flank.warnings),
            *gas.warnings,
        ),
    )


def _helices(results: list[HelixResult], along: tuple[FaceHeat, ...]) -> tuple[HelixResult, ...]:
    if not along:
        return tuple(results)
    return tuple(replace(result, face_heat=own) for result, own in zip(results, along, strict=True))


def _once(notices: Iterable[Notice]) -> tuple[Notice, ...]:
    """Return the notices of both helices, each kind once."""
    return tuple({(notice.code, notice.field): notice for notice in reversed(list(notices))}.values())[::-1]


def _torques(inputs: DriveTrainInputs) -> tuple[float, float]:
    """Return the torques of pinion and wheel [N m]."""
    gears, load = inputs.mesh.distribution.gears, inputs.mesh.distribution.load
    return load.torque, load.torque * gears.wheel.teeth / gears.pinion.teeth
