"""Equilibrium of a floating sleeve between two misaligned hubs, parallel offset (Z) or angular (M) (Fig. 13).

Six equations in (psi, e_x, e_y) of each mesh: the torque at both, the sleeve's two lateral forces and its two moments.
The direction of friction at a tooth does not depend on the unknowns. So friction's moments ask the meshes for a
lateral force, opposite in both; given that force, each mesh is a floating sleeve on its own, a convex problem; and two
equations remain for the force, Phi(g) = g, solved by Newton's method with the exact slope of the tooth loads.
"""

from dataclasses import dataclass
from math import cos, hypot, pi

import numpy as np

from solvers.arrays import FloatArray
from solvers.coupling.friction.averaging import RotorSamples, rotor_samples
from solvers.coupling.friction.sums import without_rounding
from solvers.coupling.inputs import CouplingInputs
from solvers.coupling.results import Geometry
from solvers.coupling.sleeve.balance import FORCE_TOLERANCE, balance_rows
from solvers.coupling.teeth.kinematics import MeshMotion, flank_normals, mesh_motion, relative_velocity
from solvers.coupling.teeth.limits import coaxial_limit
from solvers.coupling.teeth.loads import elastic_rotation, interference_at_rest
from solvers.errors import NoSolution

_LIMIT_MARGIN = 0.9999


@dataclass(frozen=True, slots=True)
class SleeveEquilibrium:
    """Means over one tooth pitch (revolution with pitch errors) of two meshes on one sleeve.

    `thrust` [N] acts on one shaft, positive = shafts pulled together; `overturning_moment` [N m] is friction's on the
    sleeve.
    """

    thrust: float
    overturning_moment: float


def two_meshes(inputs: CouplingInputs, geometry: Geometry) -> tuple[MeshMotion, MeshMotion]:
    """Left mesh, where the hub drives the sleeve, and right mesh; the right hub tilts alike (Z) or oppositely (M)."""
    right_tilt = 1 if inputs.operation.arrangement == "parallel_offset" else -1
    left = mesh_motion(inputs.coupling, geometry, inputs.operation, inputs.model.kinematics)
    right = mesh_motion(inputs.coupling, geometry, inputs.operation, inputs.model.kinematics, side=-1, tilt=right_tilt)
    return left, right


def sleeve_equilibrium(
    inputs: CouplingInputs, geometry: Geometry, friction: float, axial_velocity: float
) -> SleeveEquilibrium:
    """Thrust and overturning moment of two meshes, the shafts moving apart at `axial_velocity` [m/s] per mesh.

    Without any sliding (no axial velocity, and no misalignment or no speed) the direction of friction is open: the
    result is zero. Raises NoSolution `sleeve_equilibrium` where the tooth forces cannot hold the moment of friction; an
    equilibrium exists at any rate while mu d_o/l_H < cos(pi/z) (Brouwer: Phi maps the forces the teeth hold into them).
    """
    coupling, torque = inputs.coupling, inputs.operation.torque
    meshes = two_meshes(inputs, geometry)
    if torque == 0.0 or friction == 0.0 or (meshes[0].sliding == 0.0 and axial_velocity == 0.0):
        return SleeveEquilibrium(0.0, 0.0)
    samples = rotor_samples(coupling, meshes[0], axial_velocity)
    teeth = samples.teeth
    velocities = (-axial_velocity, axial_velocity)
    direction = np.stack(
        [np.sign(relative_velocity(mesh, teeth, v)) for mesh, v in zip(meshes, velocities, strict=True)], axis=1
    )
    force = _tooth_forces(inputs, geometry, meshes, samples, direction, friction)
    friction_force = friction / cos(coupling.pressure_angle) * force * direction
    both = friction_force.sum(axis=1)
    moment_x, moment_y = (samples.weight @ (both * axis).sum(axis=1) for axis in (teeth.sine, teeth.cosine))
    limit = coaxial_limit(coupling, torque, friction)
    thrust = -float(samples.weight @ friction_force[:, 0].sum(axis=1))
    return SleeveEquilibrium(
        thrust=without_rounding(thrust, limit),
        overturning_moment=geometry.pitch_radius * without_rounding(hypot(moment_x, moment_y), limit),
    )


def _tooth_forces(
    inputs: CouplingInputs,
    geometry: Geometry,
    meshes: tuple[MeshMotion, MeshMotion],
    samples: RotorSamples,
    direction: FloatArray,
    friction: float,
) -> FloatArray:
    """Tangential tooth forces [N], shape (rotor angles, mesh, teeth), as the direction of friction.

    The residual of a NoSolution is the unbalanced lateral force over T/r_o, at most 1.
    """
    coupling, teeth = inputs.coupling, samples.teeth
    unit, cosine = elastic_rotation(coupling, inputs.operation.torque), cos(coupling.pressure_angle)
    interference = np.stack([interference_at_rest(coupling, mesh, teeth) / unit for mesh in meshes], axis=1)
    normal = np.stack([flank_normals(mesh, teeth) for mesh in meshes], axis=1)
    arm = direction[:, :, None] * np.stack((teeth.cosine, teeth.sine), axis=1)[:, None]
    lever = friction / cosine * geometry.pitch_radius / coupling.hub_distance
    # The largest lateral force that the normals of z teeth, a regular polygon, hold at every rotor angle.
    force_limit = _LIMIT_MARGIN * cos(pi / coupling.teeth) / cosine
    share = np.zeros_like(interference)
    residual = balance_rows(interference, normal, arm, lever, force_limit, share)
    if residual >= FORCE_TOLERANCE:
        raise NoSolution(
            "sleeve_equilibrium",
            "the tooth forces cannot hold the overturning moment of friction on the sleeve; "
            "lengthen the hub distance or lower the friction",
            {"lateral_force": min(residual, 1.0)},
        )
    return unit * coupling.tooth_stiffness * share
