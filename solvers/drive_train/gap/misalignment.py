"""The gap over the face, the contribution of each cause to the gap, and modifications that compensate the gap.

The contributions follow from the superposition of the loads.
"""

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.drive_train.gap.balance import Equilibrium, uniform_force
from solvers.drive_train.gap.face_curves import face_crown, face_mean, face_slope
from solvers.drive_train.gap.hub_balance import respond
from solvers.drive_train.gap.thermal_lead import ThermalLead
from solvers.drive_train.inputs import DriveTrainInputs
from solvers.drive_train.results import GapCurves, Misalignment, Parts
from solvers.drive_train.shafts.coupling_loads import LOADS
from solvers.drive_train.shafts.influence import Unit
from solvers.scuffing.modification import gaps_at


def misalignment(
    inputs: DriveTrainInputs, unit: Unit, thermal: ThermalLead, equilibrium: Equilibrium, face: int
) -> Misalignment:
    """Return the gap that shafts and heat cause on a face, and recommended modifications.

    The modifications compensate the gap by heat and the gap that the shafts cause under an even load. The result also
    states how much each cause contributes to the slope of the gap.
    """
    gap = equilibrium.gap[face]
    even = _even_gap(inputs, unit, equilibrium, face) + _at_stations(thermal.even_lead, unit.stations.size)
    return Misalignment(
        shaft_slope=face_slope(gap),
        shaft_crown=face_crown(gap),
        shaft_range=float(np.ptp(gap)),
        shaft_mean=float(equilibrium.mean_gap[face]),
        parts=gap_parts(unit, equilibrium.loads, face) if inputs.effects.shafts else Parts(*([0.0] * 10)),
        thermal_slope=face_slope(thermal.lead),
        thermal_crown=face_crown(thermal.lead),
        thermal_range=float(np.ptp(thermal.lead)),
        thermal_profile_slope=thermal.profile_slope,
        base_pitch=thermal.base_pitch,
        total_slope=face_slope(gap) + face_slope(thermal.lead),
        recommended_helix_slope=-face_slope(even),
        recommended_lead_crowning=-face_crown(even),
        recommended_profile_slope=-thermal.profile_slope,
        curves=_curves(unit, thermal, equilibrium, face),
    )


def _even_gap(inputs: DriveTrainInputs, unit: Unit, equilibrium: Equilibrium, face: int) -> FloatArray:
    """Return the gap [m] that the shafts cause on a face while every face carries its share evenly."""
    count = unit.stations.size
    if not inputs.effects.shafts:
        return np.zeros(count)
    even = np.concatenate([uniform_force(mesh.transmitted, count) for mesh in equilibrium.meshes])
    return respond(unit, even, equilibrium.hubs).motion[unit.on_face(face)]


def gap_parts(unit: Unit, loads: FloatArray, face: int = 0) -> Parts:
    """Return the contribution of each cause to the slope of the gap between the flanks on a face.

    `loads` holds first the loads at the stations of all faces, and then the loads at the hubs on the shafts [N, N m].
    """
    count, here = unit.count, unit.on_face(face)
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
            sums[name] += face_slope(side.reading(side.motion(cause))[here])
        torsion = side.torques.T @ (side.model.torsion @ (side.torques[:, :count] @ force))
        sums["torsion"] += face_slope(torsion[here])
    yielding = [state.displacement for state in unit.bearings(loads)]
    shares = unit.bearing_loads[:, here]
    films = [face_slope(shares[4 * i : 4 * i + 4].T @ np.concatenate(yielding[2 * i : 2 * i + 2])) for i in range(2)]
    return Parts(
        films=sum(films),
        films_pinion=films[0],
        films_wheel=films[1],
        bearing_offsets=face_slope(shares.T @ unit.offsets),
        **sums,
    )


def _curves(unit: Unit, thermal: ThermalLead, equilibrium: Equilibrium, face: int) -> GapCurves:
    """Return the curves of the gaps and of the load over a face.

    The gap by modifications contains only the lead modifications, minus their mean over the face.
    """
    prepared, count = equilibrium.meshes[face].prepared, unit.stations.size
    plane, gap = prepared.path.plane, equilibrium.gap[face]
    form = prepared.mesh.gap._replace(profile_slope=0.0, profile_crowning=0.0, tip_relief=0.0, root_relief=0.0)
    ground = gaps_at(form, np.full(count, plane.path_length / 2), unit.stations)
    ground = ground - face_mean(ground)
    lead = _at_stations(thermal.lead, count)
    widths = np.full(count, plane.face_width / (count - 1))
    widths[0] = widths[-1] = widths[0] / 2
    return GapCurves(
        position=frozen(unit.stations),
        z=frozen(unit.frame.faces[face].positions(unit.stations)),
        shaft=frozen(gap),
        thermal=frozen(lead),
        modification=frozen(ground),
        total=frozen(gap + lead + ground),
        line_force=frozen(equilibrium.loads[unit.on_face(face)] / widths),
    )


def _at_stations(curve: FloatArray, count: int) -> FloatArray:
    """Pick the values at the stations from a curve that has further points between the stations."""
    return curve[:: (curve.size - 1) // (count - 1)]
