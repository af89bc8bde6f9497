"""Preparation of the parts of a unit for the iteration that finds the gap, and the call of this iteration."""

from dataclasses import dataclass, replace

import numpy as np

from solvers.arrays import FloatArray
from solvers.drive_train.checks import check_inputs
from solvers.drive_train.gap.balance import Equilibrium, LoadedMesh, equilibrium
from solvers.drive_train.gap.hub_balance import free_hubs
from solvers.drive_train.gap.thermal_lead import ThermalLead, no_heat, thermal_lead
from solvers.drive_train.inputs import DriveTrainInputs
from solvers.drive_train.shafts.influence import Unit, unit
from solvers.scuffing.model import mesh_of

LEAST_POINTS = 400  # least number of points of the gap over the face; the stations are among these points


@dataclass(frozen=True, slots=True)
class Prepared:
    """The parts of a unit before the iteration that finds the gap.

    `unit` holds shafts, bearings and couplings as one elastic system, `mesh` holds the mesh of the heated gears, and
    `thermal` holds the gap that heat causes.
    """

    unit: Unit
    mesh: LoadedMesh
    thermal: ThermalLead


def prepare(inputs: DriveTrainInputs) -> Prepared:
    """Prepare the parts of a unit. Raises the errors of `check_inputs`, `mesh_of` and `gas_heat`."""
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
    """Find the gap at which mesh, shafts and couplings are in equilibrium.

    If the effect of the shafts is switched off, the gap due to the shafts is zero. Raises NoSolution `drive_train` if
    the iteration does not converge, `load_balance` if the mesh has no solution, and `journal` if the film of a bearing
    would be too thin.
    """
    if inputs.effects.shafts:
        return equilibrium(prepared.unit, prepared.mesh, start)
    gap = np.zeros(prepared.unit.stations.size)
    mesh = prepared.mesh
    response = mesh.respond(gap)
    force, by_gap = mesh.scale * response.force, mesh.scale * response.derivative
    return Equilibrium(gap, 0.0, force, free_hubs(prepared.unit, force), mesh.balance(gap), by_gap, 0, 0.0)
