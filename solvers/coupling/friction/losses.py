"""Friction power and the moments that bend the hub, one mesh, means over the rotor angles."""

from math import cos, hypot, pi, tan

import numpy as np

from solvers.coupling.friction.averaging import LoadedMesh
from solvers.coupling.friction.sums import without_rounding
from solvers.coupling.inputs import CouplingInputs
from solvers.coupling.results import Geometry, Losses


def losses(inputs: CouplingInputs, geometry: Geometry, loaded: LoadedMesh, friction: float) -> Losses:
    """Power P = sum mu F_n |v_r| [W] and moments [N m] of the mesh of the driving hub, v_r = v_ax + v_G.

    Friction's moment about the pivot direction, against the tilting motion, is M_f = r_o sum mu F_n sgn(v_r)
    sgn(v_G1) sin phi with v_G1 the sliding velocity at 90 degrees: P = M_f omega delta + F_ax v_ax. It is zero where
    nothing tilts, and where nothing slides at all it is open. The power balance leaves M_f - T delta/2 of it to bend
    the driving hub, whatever the load distribution.
    """
    operation, sums = inputs.operation, loaded.sums
    scale = friction / cos(inputs.coupling.pressure_angle)
    lever = scale * geometry.pitch_radius * float(np.sign(loaded.motion.sliding))
    friction_moment = lever * without_rounding(sums.tilting, sums.load)
    shift_moment = contact_shift_moment(inputs, geometry, loaded)
    tilting_moment = shift_moment
    if inputs.model.kinematics == "spatial":
        # Only the pivoting motion feels friction's moment about the tilt axis, -r_o sum mu F_n cos(phi) sgn.
        tilting_moment -= lever * without_rounding(sums.pivoting, sums.load)
    return Losses(
        friction_power=scale * sums.power,
        friction_moment=friction_moment,
        contact_shift_moment=shift_moment,
        hub_bending_moment=hypot(
            friction_moment - operation.torque * abs(operation.misalignment) / 2.0, tilting_moment
        ),
    )


def equal_loads_friction_moment(coaxial_limit: float, pitch_radius: float) -> float:
    """(2/pi) mu T/cos(alpha) [N m], friction's moment against a tilt with equal tooth loads.

    `coaxial_limit` is that of the thrust, mu T/(r_o cos alpha) [N].
    """
    return 2.0 / pi * pitch_radius * coaxial_limit


def contact_shift_moment(inputs: CouplingInputs, geometry: Geometry, loaded: LoadedMesh) -> float:
    """M_s = |sum z_c F_n n_x| [N m], moment about the tilt axis of tooth forces off the middle of the face.

    Both factors are harmonics of phi: their product is one of sin^2, sin cos and cos^2. `tangential`: z_c = s_1 and
    the tangential part of n; R_t delta T/(2 r_o) for equal loads. `spatial`: z_c = s_1 - delta r_o cos phi, the
    contact's place in the sleeve's frame, and all of n. Both equal sum F_t df_t/d delta. The y components of n add
    T delta/2 about the pivot direction in space, which the power balance of the hub already holds.
    """
    motion, sums = loaded.motion, loaded.sums
    arm_sin, arm_cos, normal_sin, normal_cos = motion.travel_sin, 0.0, -motion.side, 0.0
    if inputs.model.kinematics == "spatial":
        arm_cos = motion.travel_cos - inputs.operation.misalignment * geometry.pitch_radius
        normal_cos = tan(motion.pressure_angle)
    return abs(
        arm_sin * normal_sin * sums.tilted
        + (arm_sin * normal_cos + arm_cos * normal_sin) * sums.mixed
        + arm_cos * normal_cos * sums.pivoted
    )
