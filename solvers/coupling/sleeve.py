"""Equilibrium of a floating sleeve between two misaligned hubs, parallel offset (Z) or angular (M) (Fig. 13).

Units as in teeth.balance. First index of a pair: the mesh, left (0) or right (1).

Six equations in (psi, e_x, e_y) of each mesh: the torque at both, the sleeve's two lateral forces and its two moments.
The direction of friction at a tooth does not depend on the unknowns. So friction's moments ask the meshes for a
lateral force, opposite in both; given that force, each mesh is a floating sleeve on its own, a convex problem; and two
equations remain for the force, Phi(g) = g, solved by Newton's method with the exact slope of the tooth loads.
"""

from dataclasses import dataclass
from math import cos, hypot, pi

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.coupling.inputs import CouplingInputs
from solvers.coupling.losses import RotorSamples, rotor_samples, without_rounding
from solvers.coupling.results import Geometry
from solvers.coupling.teeth.balance import ALONG_X, ALONG_Y, ROTATION, SHIFT_X, SHIFT_Y, float_sleeve, solve_loaded
from solvers.coupling.teeth.kinematics import MeshMotion, flank_normals, mesh_motion, relative_velocity
from solvers.coupling.teeth.loads import coaxial_limit, elastic_rotation, interference_at_rest
from solvers.errors import NoSolution

MAX_ITERATIONS = 150  # limit; an equilibrium that is not found by then is not
SUBSTITUTIONS = 5  # fixed-point steps at a time, chosen
SHORTEST_STEP = 1.0 / 64.0  # of Newton's step, below which the substitution is tried again
FORCE_TOLERANCE = 1e-9  # in units of T/r_o, chosen
_LIMIT_MARGIN = 0.9999  # of the force that the teeth can hold, chosen


@kernel
def add_friction_moment(
    ahead: FloatArray,
    normal: FloatArray,
    arm: FloatArray,
    hessian: FloatArray,
    sense: float,
    moment: FloatArray,
    slope: FloatArray,
) -> None:
    """Add sum F_t sgn(v_r) e_r of one mesh to `moment` (2), and its slope by the force on the left mesh to `slope`.

    `arm` (2, teeth) holds sgn(v_r) e_r; `ahead` and `hessian` the mesh as float_sleeve left it; `sense` is +1 or -1
    where the mesh feels the force or its opposite.
    """
    weighted = np.zeros((2, 3))
    row, free = np.empty(3), np.empty(2)
    for i in range(ahead.size):
        if ahead[i] > 0.0:
            for axis in range(2):
                moment[axis] += arm[axis, i] * ahead[i]
                weighted[axis, ROTATION] += arm[axis, i]
                weighted[axis, SHIFT_X] -= arm[axis, i] * normal[ALONG_X, i]
                weighted[axis, SHIFT_Y] -= arm[axis, i] * normal[ALONG_Y, i]
    for axis in range(2):
        # The Hessian is symmetric: its inverse times the weights is the derivative by (torque, force).
        solve_loaded(hessian, weighted[axis], row, free)
        slope[axis, ALONG_X] += sense * row[SHIFT_X]
        slope[axis, ALONG_Y] += sense * row[SHIFT_Y]


@kernel
def unbalanced_force(
    interference: FloatArray,
    normal: FloatArray,
    arm: FloatArray,
    lever: float,
    force: FloatArray,
    state: FloatArray,
    ahead: FloatArray,
    gap: FloatArray,
    slope: FloatArray,
) -> float:
    """Phi(g) - g into `gap` (2), g - Phi(g) differentiated by g into `slope` (2, 2); returns |gap|.

    Balances both meshes under the force g and its opposite, from and into `state` (2, 3), with the interference left
    in `ahead` (2, teeth); inf where one cannot hold it.
    """
    hessian = np.empty((3, 3))
    gap[:] = 0.0
    slope[:, :] = 0.0
    for mesh in range(2):
        sense = 1.0 - 2.0 * mesh
        met = float_sleeve(interference[mesh], normal[mesh], sense * force, state[mesh], ahead[mesh], hessian)
        if met < 0:
            return np.inf
        add_friction_moment(ahead[mesh], normal[mesh], arm[mesh], hessian, sense, gap, slope)
    gap[:] = lever * gap - force
    slope *= -lever
    slope[ALONG_X, ALONG_X] += 1.0
    slope[ALONG_Y, ALONG_Y] += 1.0
    return hypot(gap[ALONG_X], gap[ALONG_Y])


@kernel
def balance_sleeve(
    interference: FloatArray,
    normal: FloatArray,
    arm: FloatArray,
    lever: float,
    force_limit: float,
    force: FloatArray,
    state: FloatArray,
    ahead: FloatArray,
) -> float:
    """Solve Phi(g) = g at one rotor angle from and into `force` g (2) and `state` (2, 3); returns |Phi(g) - g|.

    interference and ahead (2, teeth), normal and arm (2, 2, teeth); `lever` is (mu/cos alpha)(r_o/l_H). Newton's
    method with steps shortened until the residual falls; some damped substitutions where that fails, for Phi is
    piecewise linear (teeth come under load) and Newton may cycle between its pieces. Eq. C22.
    """
    gap, step, accepted, slope = np.empty(2), np.zeros(2), np.zeros(2), np.empty((2, 2))
    accepted_residual, length, substitutions = np.inf, 1.0, 0
    for _ in range(MAX_ITERATIONS):
        residual = unbalanced_force(interference, normal, arm, lever, force, state, ahead, gap, slope)
        if residual < FORCE_TOLERANCE or residual == np.inf:
            return residual
        if substitutions > 0 or residual <= (1.0 - 0.1 * length) * accepted_residual:
            length = 1.0
        else:
            length *= 0.5
            if length < SHORTEST_STEP:
                substitutions = SUBSTITUTIONS
        if length == 1.0 or substitutions > 0:
            accepted[:], accepted_residual = force, residual
            (xx, xy), (yx, yy) = slope
            determinant = xx * yy - xy * yx
            if substitutions > 0 or abs(determinant) < 1e-6:
                substitutions = max(0, substitutions - 1)
                length = 0.5
                step[:] = gap
            else:
                step[ALONG_X] = (yy * gap[ALONG_X] - xy * gap[ALONG_Y]) / determinant
                step[ALONG_Y] = (xx * gap[ALONG_Y] - yx * gap[ALONG_X]) / determinant
        force[:] = accepted + length * step
        size = hypot(force[ALONG_X], force[ALONG_Y])
        if size > force_limit:
            force *= force_limit / size
    return accepted_residual


@kernel
def balance_rows(
    interference: FloatArray,
    normal: FloatArray,
    arm: FloatArray,
    lever: float,
    force_limit: float,
    share: FloatArray,
) -> float:
    """Balance the sleeve at every rotor angle, each started from the one before, then from rest if that fails.

    Leaves the tooth forces in `share` (rows, 2, teeth). Returns the largest residual, that of the first angle without
    balance if there is one: no later angle is tried.
    """
    force, state = np.zeros(2), np.zeros((2, 3))
    largest = 0.0
    for row in range(interference.shape[0]):
        tooth, flank, friction = interference[row], normal[row], arm[row]
        residual = balance_sleeve(tooth, flank, friction, lever, force_limit, force, state, share[row])
        if residual >= FORCE_TOLERANCE:
            force[:] = 0.0
            state[:, :] = 0.0
            residual = balance_sleeve(tooth, flank, friction, lever, force_limit, force, state, share[row])
        largest = max(largest, residual)
        if residual >= FORCE_TOLERANCE:
            break
        for mesh in range(2):
            for i in range(share.shape[2]):
                share[row, mesh, i] = max(0.0, share[row, mesh, i])
    return largest


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

    Eq. C22.
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
