"""Preparation of the parts of a unit for the iteration that finds the gap, and the call of this iteration."""

from dataclasses import dataclass, replace

import numpy as np

from solvers.arrays import FloatArray
from solvers.drive_train.checks import check_inputs
from solvers.drive_train.gap.balance import Equilibrium, LoadedMesh, at_rest, equilibrium
from solvers.drive_train.gap.thermal_lead import ThermalLead, no_heat, thermal_lead
from solvers.drive_train.inputs import DriveTrainInputs
from solvers.drive_train.shafts.influence import Unit, unit
from solvers.gears.pair import PathOfContact
from solvers.scuffing.inputs import LeadCurve, LoadDistributionInputs
from solvers.scuffing.model import PreparedMesh, mesh_of
from solvers.scuffing.modification import lead_table

LEAST_POINTS = 400  # least number of points of the gap over the face; the stations are among these points


@dataclass(frozen=True, slots=True)
class Prepared:
    """The parts of a unit before the iteration that finds the gap.

    `unit` holds shafts, bearings and couplings as one elastic system, `meshes` holds the mesh of the heated gears on
    every face under the whole force, and `thermals` holds the gap that heat causes on every face.
    """

    unit: Unit
    meshes: tuple[LoadedMesh, ...]
    thermals: tuple[ThermalLead, ...]

    @property
    def path(self) -> PathOfContact:
        """Path of contact of the gear pair."""
        return self.meshes[0].prepared.path


def prepare(inputs: DriveTrainInputs) -> Prepared:
    """Prepare the parts of a unit. Raises the errors of `check_inputs`, `mesh_of` and `gas_heat`."""
    given = [mesh_of(face) for face in of_faces(inputs)]
    path = given[0].path
    check_inputs(inputs, path)
    system = unit(inputs, path)
    steps = inputs.face_stations - 1
    points = np.linspace(0.0, path.plane.face_width, steps * -(-LEAST_POINTS // steps) + 1)
    thermal = thermal_lead(inputs, path, points) if inputs.effects.thermal else no_heat(points)
    meshes = tuple(_loaded(inputs, mesh, thermal, points, system.stations) for mesh in given)
    return Prepared(system, meshes, (thermal,) * len(meshes))


def of_faces(inputs: DriveTrainInputs) -> tuple[LoadDistributionInputs, ...]:
    """Return the mesh of every face, with its own modifications, under the whole load."""
    given = inputs.mesh.distribution
    if given.gears.helices == 1:
        return (given,)
    second = given.modifications.second_helix
    if second is not None and second.lead_curve not in {None, LeadCurve()}:
        lead_table(second.lead_curve, given.gears.face_width, "second_helix.lead_curve")
    return given, replace(given, modifications=given.modifications.of_second_helix)


def _loaded(
    inputs: DriveTrainInputs, given: PreparedMesh, thermal: ThermalLead, points: FloatArray, stations: FloatArray
) -> LoadedMesh:
    """Return the heated mesh of a face with the part of the gap that does not depend on the load."""
    gap = given.mesh.gap
    own = np.interp(points, np.linspace(0.0, points[-1], gap.lead.size), gap.lead)
    heated = gap._replace(profile_slope=gap.profile_slope + thermal.profile_slope)
    mesh = replace(given, mesh=given.mesh._replace(gap=heated._replace(lead=own)))
    transmitted = given.tangential_force / inputs.contact_load_factor
    carried = given.force * given.path.plane.cos_base_helix
    return LoadedMesh(
        prepared=mesh,
        fixed=own + thermal.lead,
        stations=stations,
        force=given.force,
        slices=inputs.mesh.distribution.resolution.slices,
        scale=transmitted / carried if carried > 0.0 else 1.0,
    )


def settle(inputs: DriveTrainInputs, prepared: Prepared, start: FloatArray | None = None) -> Equilibrium:
    """Find the gap at which mesh, shafts and couplings are in equilibrium.

    If the effect of the shafts is switched off, the gap due to the shafts is zero. Raises NoSolution `drive_train` if
    the iteration does not converge, `load_balance` if the mesh has no solution, and `journal` if the film of a bearing
    would be too thin.
    """
    if inputs.effects.shafts:
        return equilibrium(prepared.unit, prepared.meshes, start)
    return at_rest(prepared.unit, prepared.meshes)
