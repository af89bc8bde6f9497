"""The gap over the face, the contribution of each cause to the gap, and modifications that compensate the gap.

The contributions follow from the superposition of the loads.
"""

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
    inputs: DriveTrainInputs, unit: Unit, mesh: LoadedMesh, thermal: ThermalLead, equilibrium: Equilibrium
) -> Misalignment:
    """Return the gap that shafts and heat cause, and recommended modifications.

    The modifications compensate the gap by heat and the gap that the shafts cause under an even load. The result also
    states how much each cause contributes to the slope of the gap.
    """
    even = _even_gap(inputs, unit, mesh, equilibrium) + _at_stations(thermal.lead, unit.stations.size)
    return Misalignment(
        shaft_slope=face_slope(equilibrium.gap),
        shaft_crown=face_crown(equilibrium.gap),
        shaft_range=float(np.ptp(equilibrium.gap)),
        shaft_mean=equilibrium.mean_gap,
        parts=gap_parts(unit, equilibrium.loads) if inputs.effects.shafts else Parts(*([0.0] * 10)),
        thermal_slope=face_slope(thermal.lead),
        thermal_crown=face_crown(thermal.lead),
        thermal_range=float(np.ptp(thermal.lead)),
        thermal_profile_slope=thermal.profile_slope,
        base_pitch=thermal.base_pitch,
        total_slope=face_slope(equilibrium.gap) + face_slope(thermal.lead),
        recommended_helix_slope=-face_slope(even),
        recommended_lead_crowning=-face_crown(even),
        recommended_profile_slope=-thermal.profile_slope,
        curves=_curves(inputs, unit, mesh, thermal, equilibrium),
    )


def _even_gap(inputs: DriveTrainInputs, unit: Unit, mesh: LoadedMesh, equilibrium: Equilibrium) -> FloatArray:
    """Return the gap [m] that the shafts cause under a load that is spread evenly over the face."""
    count = unit.stations.size
    if not inputs.effects.shafts:
        return np.zeros(count)
    return respond(unit, uniform_force(mesh.transmitted, count), equilibrium.hubs).motion[:count]


def gap_parts(unit: Unit, loads: FloatArray) -> Parts:
    """Return the contribution of each cause to the slope of the gap between the flanks.

    `loads` holds first the loads at the stations of the face, and then the loads at the hubs on the shafts [N, N m].
    """
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
    inputs: DriveTrainInputs, unit: Unit, mesh: LoadedMesh, thermal: ThermalLead, equilibrium: Equilibrium
) -> GapCurves:
    """Return the curves of the gaps and of the load over the face.

    The gap by modifications contains only the lead modifications, minus their mean over the face.
    """
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
        shaft=frozen(equilibrium.gap),
        thermal=frozen(lead),
        modification=frozen(ground),
        total=frozen(equilibrium.gap + lead + ground),
        line_force=frozen(equilibrium.loads[:count] / widths),
    )


def _at_stations(curve: FloatArray, count: int) -> FloatArray:
    """Pick the values at the stations from a curve that has further points between the stations."""
    return curve[:: (curve.size - 1) // (count - 1)]
