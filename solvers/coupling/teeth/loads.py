"""How the teeth of one mesh share the torque, at many rotor angles at once (Figs 3 and 4).

Tooth i carries F_t = c_t max(0, psi + f_t + pitch error - e . n/cos(alpha)) with psi the common rotation as a length
at the pitch radius and e the sleeve's displacement against the hub.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import cos, pi, sqrt

import numpy as np

from solvers.arrays import FloatArray, IntArray
from solvers.coupling.inputs import Coupling, CouplingInputs
from solvers.coupling.results import Geometry, Limits
from solvers.coupling.teeth.balance import Places, centred_rows, floating_rows
from solvers.coupling.teeth.kinematics import (
    MeshMotion,
    ToothPositions,
    displacement_peak_to_peak,
    flank_normals,
    mesh_motion,
    pitch_radius,
    tangential_displacement,
)
from solvers.errors import NoSolution

_PEAKS = 8  # highest samples around which the maximum is sought; more than one, as neighbours may hide the highest
_FINER = np.arange(-1.0, 1.125, 0.125)


def largest_value(angles: FloatArray, values_at: Callable[[FloatArray], FloatArray]) -> float:
    """Largest value over evenly spaced rotor angles [rad], searched again in steps eight times as fine.

    The second search is around the local maxima that may hide the largest value, were they to rise for half a step as
    they did before: between few loaded teeth a peak lasts but a fraction of a pitch, and each tooth has its own.
    `values_at` takes rotor angles (rows) and returns one value each.
    """
    coarse = values_at(angles)
    before, after = np.roll(coarse, 1), np.roll(coarse, -1)
    local = np.flatnonzero((coarse >= before) & (coarse >= after))
    reach = 1.5 * coarse - 0.5 * np.minimum(before, after)
    peaks = local[np.argsort(reach[local])[-_PEAKS:]]
    around = (angles[1] - angles[0]) * _FINER
    fine = values_at((angles[peaks, None] + around).ravel())
    return float(max(coarse.max(), fine.max()))


@dataclass(frozen=True, slots=True)
class ToothLoads:
    """Tooth loads of one mesh, one row a rotor angle.

    `tangential_force` (rows, teeth) [N], `rotation` (rows) and `displacement` (rows, 2) [m]; `iterations` (rows) is
    negative in the first row where the balance of a floating sleeve was not met; later rows then mean nothing.
    """

    tangential_force: FloatArray
    rotation: FloatArray
    displacement: FloatArray
    iterations: IntArray


def interference_at_rest(coupling: Coupling, mesh: MeshMotion, teeth: ToothPositions) -> FloatArray:
    """How far each tooth is ahead, f_t + pitch error [m], shape (rows, teeth) (Eq. C7)."""
    ahead = tangential_displacement(mesh, teeth)
    if coupling.pitch_errors is not None:
        ahead += coupling.pitch_errors
    return ahead


def elastic_rotation(coupling: Coupling, torque: float) -> float:
    """T/(r_o c_t) [m]: the rotation of a coupling with one tooth, as a length at the pitch radius."""
    return torque / (pitch_radius(coupling) * coupling.tooth_stiffness)


def centred_loads(coupling: Coupling, mesh: MeshMotion, teeth: ToothPositions, torque: float) -> ToothLoads:
    """Loads of a sleeve held centred on the hub: exact for any torque >= 0 (Eq. C7)."""
    ahead = interference_at_rest(coupling, mesh, teeth)
    rows = ahead.shape[0]
    displacement, iterations = np.zeros((rows, 2)), np.zeros(rows, dtype=np.int64)
    if torque == 0.0:
        return ToothLoads(np.zeros_like(ahead), -ahead.max(axis=1), displacement, iterations)
    unit, rotation = elastic_rotation(coupling, torque), np.empty(rows)
    centred_rows(ahead, unit, unit * coupling.tooth_stiffness, rotation)
    return ToothLoads(ahead, rotation, displacement, iterations)


def floating_loads(
    coupling: Coupling, mesh: MeshMotion, teeth: ToothPositions, torque: float, force: FloatArray
) -> ToothLoads:
    """Loads of a sleeve that finds its own place under an external `force` (rows, 2) [N], for torque > 0 (Eq. C7).

    Iterations are negative in a row without balance: the force exceeds what the torque's tooth forces can hold.
    """
    unit = elastic_rotation(coupling, torque)
    unit_force = unit * coupling.tooth_stiffness
    interference = interference_at_rest(coupling, mesh, teeth) / unit
    normal = flank_normals(mesh, teeth)
    rows = interference.shape[0]
    share, iterations = np.zeros_like(interference), np.zeros(rows, dtype=np.int64)
    places = Places(*np.zeros((3, rows)))
    floating_rows(interference, normal, force / unit_force, share, places, iterations)
    displacement = unit * np.stack((places.x, places.y), axis=1)
    return ToothLoads(unit_force * share, unit * places.rotation, displacement, iterations)


def mesh_loads(
    coupling: Coupling, mesh: MeshMotion, teeth: ToothPositions, torque: float, *, floating: bool
) -> ToothLoads:
    """Loads of one mesh without external force.

    Raises NoSolution `sleeve_balance` if a floating sleeve is not balanced (its lateral force over T/r_o).
    """
    if not floating or torque == 0.0:
        return centred_loads(coupling, mesh, teeth, torque)
    loads = floating_loads(coupling, mesh, teeth, torque, np.zeros((teeth.sine.shape[0], 2)))
    row = int(loads.iterations.argmin())
    if loads.iterations[row] < 0:
        lateral = flank_normals(mesh, teeth)[row] @ loads.tangential_force[row]
        residual = float(np.hypot(*lateral)) * pitch_radius(coupling) / torque
        raise NoSolution(
            "sleeve_balance",
            "the floating sleeve was not balanced; raise the torque or lower the pitch errors",
            {"lateral_force": residual},
        )
    return loads


SLIDING_VELOCITY_LIMIT = 0.12
"""Steady sliding of gear couplings [m/s], Tribology Handbook B4.6; transients may tilt 1.6 times as far."""
GRAVITY = 9.80665  # m/s^2, standard gravity (CGPM 1901)


def coaxial_limit(coupling: Coupling, torque: float, friction: float) -> float:
    """F_max = mu T/(r_o cos alpha) [N]: every tooth slides the same way (Eq. C20)."""
    return friction * torque / (pitch_radius(coupling) * cos(coupling.pressure_angle))


def allowable_misalignment(speed: float, radius: float) -> float | None:
    """Misalignment at the limit of sliding velocity, 0.12/(omega r_o) [rad]; None where no angle reaches it.

    Eq. C29.
    """
    rolling = abs(speed) * radius
    return SLIDING_VELOCITY_LIMIT / rolling if pi / 2 * rolling > SLIDING_VELOCITY_LIMIT else None


def sleeve_centring_torque(coupling: Coupling, radius: float) -> float:
    """Torque that holds a horizontal sleeve of weight W a mesh with every tooth loaded, 2 W r_o cos(alpha) [N m].

    Eq. C30.
    """
    return 2.0 * coupling.sleeve_mass * GRAVITY * radius * cos(coupling.pressure_angle)


def unloading_misalignment(inputs: CouplingInputs, geometry: Geometry) -> float:
    """Misalignment [rad] at which the first tooth of a centred sleeve unloads, pitch errors ignored (Eq. C10).

    There the peak-to-peak displacement, a square of the misalignment, reaches 2 F_m/c_t with F_m the mean tooth force:
    delta_L = sqrt(4 F_m/(c_t R_t)) with the tangential kinematics.
    """
    coupling, operation = inputs.coupling, inputs.operation
    mean_force = operation.torque / (geometry.pitch_radius * coupling.teeth)
    one_radian = mesh_motion(coupling, geometry, replace(operation, misalignment=1.0), inputs.model.kinematics)
    return sqrt(2.0 * mean_force / coupling.tooth_stiffness / displacement_peak_to_peak(one_radian))


def limits(inputs: CouplingInputs, geometry: Geometry) -> Limits:
    """Limits and the stiffness of one mesh: z c_t r_o^2 in torsion, z c_t/(2 cos^2 alpha) laterally (Eq. C31)."""
    coupling, radius = inputs.coupling, geometry.pitch_radius
    all_teeth = coupling.teeth * coupling.tooth_stiffness
    return Limits(
        sliding_velocity_limit=SLIDING_VELOCITY_LIMIT,
        allowable_misalignment=allowable_misalignment(inputs.operation.speed, radius),
        sleeve_centring_torque=sleeve_centring_torque(coupling, radius),
        torsional_stiffness=all_teeth * radius**2,
        lateral_stiffness=all_teeth / (2.0 * cos(coupling.pressure_angle) ** 2),
    )
