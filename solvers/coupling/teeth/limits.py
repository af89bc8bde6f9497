"""Design limits and linear stiffness of the coupling."""

from dataclasses import replace
from math import cos, pi, sqrt

from solvers.coupling.inputs import Coupling, CouplingInputs
from solvers.coupling.results import Geometry, Limits
from solvers.coupling.teeth.geometry import pitch_radius
from solvers.coupling.teeth.kinematics import displacement_peak_to_peak, mesh_motion

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
