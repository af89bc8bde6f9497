"""Friction power and the moments that bend the hub, one mesh, means over the rotor angles."""

from math import cos, hypot

import numpy as np

from solvers.coupling.averaging import LoadedMesh
from solvers.coupling.inputs import CouplingInputs
from solvers.coupling.kinematics import contact_position, flank_normals, sliding_velocity
from solvers.coupling.results import Geometry, Losses


def losses(inputs: CouplingInputs, geometry: Geometry, loaded: LoadedMesh, friction: float) -> Losses:
    """Power P = sum mu F_n |v_G| [W] and moments [N m] of the mesh of the driving hub.

    The friction moment M_f = r_o sum mu F_n |sin phi| acts about the pivot direction; P = M_f omega delta. The power
    balance leaves M_f - T delta/2 of it to bend the driving hub, whatever the load distribution.
    """
    operation = inputs.operation
    scale = friction / cos(inputs.coupling.pressure_angle)
    sliding = np.abs(sliding_velocity(loaded.motion, loaded.teeth))
    friction_moment = (
        scale * geometry.pitch_radius * loaded.mean_sum(loaded.tangential_force * np.abs(loaded.teeth.sine))
    )
    shift_moment = contact_shift_moment(inputs, geometry, loaded)
    tilting_moment = shift_moment + pivoting_friction_moment(inputs, geometry, loaded, friction)
    return Losses(
        friction_power=scale * loaded.mean_sum(loaded.tangential_force * sliding),
        friction_moment=friction_moment,
        contact_shift_moment=shift_moment,
        hub_bending_moment=hypot(
            friction_moment - operation.torque * abs(operation.misalignment) / 2.0, tilting_moment
        ),
    )


def contact_shift_moment(inputs: CouplingInputs, geometry: Geometry, loaded: LoadedMesh) -> float:
    """M_s = |sum z_c F_n n_x| [N m], moment about the tilt axis of tooth forces off the middle of the face.

    `tangential`: z_c = s_1 and the tangential part of n; R_t delta T/(2 r_o) for equal loads. `spatial`: z_c = s_1 -
    delta r_o cos phi, the contact's place in the sleeve's frame, and all of n. Both equal sum F_t df_t/d delta. The y
    components of n add T delta/2 about the pivot direction in space, which the power balance of the hub already holds.
    """
    teeth = loaded.teeth
    arm = contact_position(loaded.motion, teeth)
    if inputs.model.kinematics == "tangential":
        normal_x = -loaded.motion.side * teeth.sine
    else:
        arm -= inputs.operation.misalignment * geometry.pitch_radius * teeth.cosine
        normal_x = flank_normals(loaded.motion, teeth)[:, 0]
    return abs(loaded.mean_sum(loaded.tangential_force * arm * normal_x))


def pivoting_friction_moment(inputs: CouplingInputs, geometry: Geometry, loaded: LoadedMesh, friction: float) -> float:
    """Friction's moment about the tilt axis [N m], -r_o sum mu F_n cos(phi) sgn(sin phi); none in `tangential`."""
    if inputs.model.kinematics == "tangential":
        return 0.0
    scale = friction / cos(inputs.coupling.pressure_angle) * geometry.pitch_radius
    return -scale * loaded.mean_sum(loaded.tangential_force * loaded.teeth.cosine * np.sign(loaded.teeth.sine))
