"""The drive train: the gap over the face at which couplings, shafts, bearings, heat and mesh are in equilibrium."""

from dataclasses import dataclass, replace

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.drive_train.checks import check_inputs
from solvers.drive_train.derived import derived
from solvers.drive_train.elements import coupling_results, hubs_of, shaft_results, warnings_of
from solvers.drive_train.gap.balance import Equilibrium, LoadedMesh, equilibrium
from solvers.drive_train.gap.hub_balance import free_hubs
from solvers.drive_train.gap.misalignment import misalignment
from solvers.drive_train.gap.thermal_lead import ThermalLead, gas_heat, no_heat, thermal_lead
from solvers.drive_train.inputs import DriveTrainInputs
from solvers.drive_train.losses import force_balance, train_losses
from solvers.drive_train.notices import coupling_notices, load_notices, loss_notices, shaft_notices
from solvers.drive_train.results import Convergence, DriveTrainResult, FaceLoad
from solvers.drive_train.safety import contact_of, flank_heat
from solvers.drive_train.shafts.influence import Unit, unit
from solvers.scuffing.micropitting.wear import wear_asked_for
from solvers.scuffing.model import distribution, mesh_of
from solvers.scuffing.results import LoadDistribution
from solvers.scuffing.thermal.temperatures import in_force, oil_notices

LEAST_POINTS = 400  # of the gap over the face, the stations among them


@dataclass(frozen=True, slots=True)
class Prepared:
    """Everything but the common gap: shafts and couplings as one system, the mesh under heat, the heat."""

    unit: Unit
    mesh: LoadedMesh
    thermal: ThermalLead


def prepare(inputs: DriveTrainInputs) -> Prepared:
    """The parts ready to be brought together. Raises what `check_inputs`, `mesh_of` and `gas_heat` raise."""
    given = mesh_of(inputs.mesh.distribution)
    check_inputs(inputs, given.path)
    system = unit(inputs, given.path)
    steps = inputs.face_stations - 1
    points = np.linspace(0.0, given.path.plane.face_width, steps * -(-LEAST_POINTS // steps) + 1)
    thermal = thermal_lead(inputs, given.path, points) if inputs.effects.thermal else no_heat(points)
    gap = given.mesh.gap
    own = np.interp(points, np.linspace(0.0, points[-1], gap.lead.size), gap.lead)
    heated = gap._replace(profile_slope=gap.profile_slope + thermal.profile_slope)
    mesh = replace(given, mesh=given.mesh._replace(gap=heated._replace(lead=own)))
    transmitted = given.tangential_force / inputs.contact_load_factor
    carried = given.force * given.path.plane.cos_base_helix
    return Prepared(
        unit=system,
        mesh=LoadedMesh(
            prepared=mesh,
            fixed=own + thermal.lead,
            stations=system.stations,
            force=given.force,
            slices=inputs.mesh.distribution.resolution.slices,
            scale=transmitted / carried if carried > 0.0 else 1.0,
        ),
        thermal=thermal,
    )


def settle(inputs: DriveTrainInputs, prepared: Prepared, start: FloatArray | None = None) -> Equilibrium:
    """The gap that mesh, shafts and couplings agree on; without their effect the shafts do not move.

    Raises NoSolution (drive_train, load_balance, journal).
    """
    if inputs.effects.shafts:
        return equilibrium(prepared.unit, prepared.mesh, start)
    gap = np.zeros(prepared.unit.stations.size)
    mesh = prepared.mesh
    response = mesh.respond(gap)
    force, by_gap = mesh.scale * response.force, mesh.scale * response.derivative
    return Equilibrium(gap, 0.0, force, free_hubs(prepared.unit, force), mesh.balance(gap), by_gap, 0, 0.0)


def solve(inputs: DriveTrainInputs, start: FloatArray | None = None) -> DriveTrainResult:
    """Misalignment, load, safety, thrust and losses of a unit; `start` is the shafts' gap of a similar one.

    Raises InvalidInput (codes of `check_inputs` and of the three models) and NoSolution (drive_train, load_balance,
    journal).
    """
    prepared = prepare(inputs)
    system, mesh, thermal = prepared.unit, prepared.mesh, prepared.thermal
    found = settle(inputs, prepared, start)
    spread = distribution(inputs.mesh.distribution, mesh.prepared, found.balance)
    contact, spread, _ = in_force(contact_of(inputs), spread)
    inputs = replace(inputs, mesh=contact)
    hubs = hubs_of(system, found)
    couplings = coupling_results(system, found, hubs)
    shafts = shaft_results(inputs, mesh.prepared.path, system, found, couplings)
    gas = gas_heat(inputs.pumping, inputs.mesh.distribution.load.pinion_speed)
    heat = flank_heat(inputs, spread, thermal)
    load = face_load(spread)
    losses = train_losses(inputs, spread.friction_loss.power, gas.power, shafts, couplings)
    return DriveTrainResult(
        misalignment=misalignment(inputs, system, mesh, thermal, found),
        load=load,
        shafts=shafts,
        couplings=couplings,
        flash=heat.flash,
        safety=heat.safety,
        losses=losses,
        balance=force_balance(system, found, _torques(inputs), mesh.transmitted),
        convergence=Convergence(found.iterations, found.residual),
        micropitting=heat.micropitting.answer,
        wear=wear_asked_for(inputs.mesh.micropitting, spread),
        mesh=spread,
        contact_temperature=frozen(heat.temperature),
        film_ratio=None if heat.micropitting.ratio is None else frozen(heat.micropitting.ratio),
        derived=derived(inputs, spread),
        warnings=(
            *spread.warnings,
            *coupling_notices(inputs, couplings, warnings_of(system, found)),
            *shaft_notices(inputs, shafts),
            *load_notices(inputs, load),
            *loss_notices(inputs, losses),
            *oil_notices(inputs.mesh, spread.path_of_contact),
            *heat.warnings,
            *gas.warnings,
        ),
    )


def face_load(spread: LoadDistribution) -> FaceLoad:
    """How the face carries."""
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
    """Torques [N m] at the pinion's and at the wheel's shaft."""
    gears, load = inputs.mesh.distribution.gears, inputs.mesh.distribution.load
    return load.torque, load.torque * gears.wheel.teeth / gears.pinion.teeth
