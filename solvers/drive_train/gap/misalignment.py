"""Where the gap over the face comes from, by superposition of the loads, and what to grind against it."""

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.drive_train.gap.balance import Equilibrium, LoadedMesh, uniform_force
from solvers.drive_train.gap.face_curves import face_crown, face_mean, face_slope
from solvers.drive_train.gap.hub_balance import respond
from solvers.drive_train.gap.thermal_lead import ThermalLead
from solvers.drive_train.inputs import DriveTrainInputs
from solvers.drive_train.results import GapCurves, Misalignment, Parts
from solvers.drive_train.shafts.coupling_loads import LOADS
from solvers.drive_train.shafts.influence import Unit
from solvers.scuffing.modification import gaps_at


def misalignment(
    inputs: DriveTrainInputs, unit: Unit, mesh: LoadedMesh, thermal: ThermalLead, found: Equilibrium
) -> Misalignment:
    """The gap by shafts and heat, its causes, and the correction that undoes both."""
    even = _even_gap(inputs, unit, mesh, found) + _at_stations(thermal.lead, unit.stations.size)
    return Misalignment(
        shaft_slope=face_slope(found.gap),
        shaft_crown=face_crown(found.gap),
        shaft_range=float(np.ptp(found.gap)),
        shaft_mean=found.mean_gap,
        parts=gap_parts(unit, found.loads) if inputs.effects.shafts else Parts(*([0.0] * 10)),
        thermal_slope=face_slope(thermal.lead),
        thermal_crown=face_crown(thermal.lead),
        thermal_range=float(np.ptp(thermal.lead)),
        thermal_profile_slope=thermal.profile_slope,
        base_pitch=thermal.base_pitch,
        total_slope=face_slope(found.gap) + face_slope(thermal.lead),
        recommended_helix_slope=-face_slope(even),
        recommended_lead_crowning=-face_crown(even),
        recommended_profile_slope=-thermal.profile_slope,
        curves=_curves(inputs, unit, mesh, thermal, found),
    )


def _even_gap(inputs: DriveTrainInputs, unit: Unit, mesh: LoadedMesh, found: Equilibrium) -> FloatArray:
    """The shafts' gap under a load spread evenly over the face."""
    count = unit.stations.size
    if not inputs.effects.shafts:
        return np.zeros(count)
    return respond(unit, uniform_force(mesh.transmitted, count), found.hubs).motion[:count]


def gap_parts(unit: Unit, loads: FloatArray) -> Parts:
    """Slopes of the gap by the loads of the ports."""
    count = unit.stations.size
    force, hubs = loads[:count], loads[count:]
    axial = np.arange(hubs.size) % LOADS == LOADS - 1
    sums = dict.fromkeys(("bending", "torsion", "tilting_moment", "coupling", "collar", "weight"), 0.0)
    for side in unit.shafts:
        transverse = side.mesh_loads @ force
        whole = side.loads[:, :, :count] @ force
        causes = {
            "bending": transverse,
            "tilting_moment": whole - transverse,
            "coupling": side.loads[:, :, count:] @ np.where(axial, 0.0, hubs),
            "collar": side.collar + side.loads[:, :, count:] @ np.where(axial, hubs, 0.0),
            "weight": side.weight,
        }
        for name, cause in causes.items():
            sums[name] += face_slope(side.reading(side.motion(cause))[:count])
        torsion = side.torques.T @ (side.model.torsion @ (side.torques[:, :count] @ force))
        sums["torsion"] += face_slope(torsion[:count])
    yielding = [state.displacement for state in unit.bearings(loads)]
    shares = unit.bearing_loads[:, :count]
    films = [face_slope(shares[4 * i : 4 * i + 4].T @ np.concatenate(yielding[2 * i : 2 * i + 2])) for i in range(2)]
    return Parts(
        films=sum(films),
        films_pinion=films[0],
        films_wheel=films[1],
        bearing_offsets=face_slope(shares.T @ unit.offsets),
        **sums,
    )


def _curves(
    inputs: DriveTrainInputs, unit: Unit, mesh: LoadedMesh, thermal: ThermalLead, found: Equilibrium
) -> GapCurves:
    """Gaps over the face; the modification's at the pitch point, without profile relief, mean taken out."""
    plane, count = mesh.prepared.path.plane, unit.stations.size
    form = mesh.prepared.mesh.gap._replace(profile_slope=0.0, profile_crowning=0.0, tip_relief=0.0, root_relief=0.0)
    ground = gaps_at(form, np.full(count, plane.path_length / 2), unit.stations)
    ground = ground - face_mean(ground)
    lead = _at_stations(thermal.lead, count)
    widths = np.full(count, plane.face_width / (count - 1))
    widths[0] = widths[-1] = widths[0] / 2
    return GapCurves(
        position=frozen(unit.stations),
        z=frozen(unit.frame.positions(inputs.face_start, plane.face_width, unit.stations)),
        shaft=frozen(found.gap),
        thermal=frozen(lead),
        modification=frozen(ground),
        total=frozen(found.gap + lead + ground),
        line_force=frozen(found.loads[:count] / widths),
    )


def _at_stations(curve: FloatArray, count: int) -> FloatArray:
    """A curve on more points, among them the stations."""
    return curve[:: (curve.size - 1) // (count - 1)]
