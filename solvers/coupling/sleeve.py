"""Equilibrium of a floating sleeve between two hubs; the shafts have a parallel offset (Z) or an angle (M).

The units are those of `tooth_loads`. In arrays with an axis for the mesh, index 0 is the left mesh and index 1 is the
right mesh.

The equilibrium is that of Fig. 13. The unknowns are the rotation and the displacement (psi, e_x, e_y) of each mesh. The
six equations are the balance of torque at each mesh, the balance of the two lateral forces on the sleeve, and the
balance of the two moments on the sleeve. The direction of friction at a tooth does not depend on the unknowns. The
moments of friction require a lateral force g at the left mesh and -g at the right mesh. For a given g, each mesh can be
balanced alone, like a single floating sleeve; this problem is convex. Two equations remain for the two components of g:
Phi(g) = g, where Phi(g) is the lateral force that the moments of friction require if g acts. Newton's method solves
these equations with the exact derivative of the tooth loads.
"""

from dataclasses import dataclass
from math import cos, hypot, pi
from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray, without_rounding
from solvers.compiled import inner_kernel, kernel
from solvers.coupling.inputs import CouplingInputs
from solvers.coupling.kinematics import (
    MeshMotion,
    RotorSamples,
    flank_normals,
    mesh_motion,
    relative_velocity,
    rotor_samples,
)
from solvers.coupling.results import Geometry
from solvers.coupling.tooth_loads import (
    Hessian,
    Motion,
    Places,
    coaxial_limit,
    elastic_rotation,
    float_sleeve,
    interference_at_rest,
    solve_loaded,
)
from solvers.errors import NoSolution

MAX_ITERATIONS = 150  # limit; an iteration that takes longer does not converge
SUBSTITUTIONS = 5  # chosen: number of fixed-point steps in succession
SHORTEST_STEP = 1.0 / 64.0  # smallest share of a Newton step; if even this share does not help, substitutions follow
FORCE_TOLERANCE = 1e-9  # in units of T/r_o, chosen
_LIMIT_MARGIN = 0.9999  # chosen share of the force that the teeth can hold


class Unbalance(NamedTuple):
    """Residual Phi(g) - g of the sleeve's force balance, and the derivatives of g - Phi(g).

    `x` and `y` are the components of the residual, and `size` is the magnitude of the residual. `xx`, `xy`, `yx` and
    `yy` are the derivatives of g - Phi(g) with respect to g; for example, `xy` is the derivative of the x component
    with respect to g_y.
    """

    size: float
    x: float
    y: float
    xx: float
    xy: float
    yx: float
    yy: float


@inner_kernel
def add_friction_moment(
    moment: float, ahead: FloatArray, normal: FloatArray, arm: FloatArray, hessian: Hessian
) -> tuple[float, float, float]:
    """Add one component of the friction moment of a mesh to `moment`.

    Returns the new moment, and the derivatives of the friction moment with respect to the force (x, y) on the mesh. The
    component of the friction moment is sum F_t sgn(v_r) e_r, where e_r is a component of the tooth's radial direction.
    `arm` (teeth) holds sgn(v_r) e_r. `ahead` and `hessian` are the results of `float_sleeve` for this mesh.
    """
    normal_x, normal_y = normal
    torque, x, y = 0.0, 0.0, 0.0
    for i in range(ahead.size):
        if ahead[i] > 0.0:
            moment += arm[i] * ahead[i]
            torque += arm[i]
            x -= arm[i] * normal_x[i]
            y -= arm[i] * normal_y[i]
    # The Hessian is symmetric. The inverse of the Hessian, times the weights (torque, x, y), gives the derivatives by
    # torque and force.
    slope, _, _ = solve_loaded(hessian, Motion(torque, x, y))
    return moment, slope.x, slope.y


@inner_kernel
def unbalanced_force(
    interference: FloatArray,
    normal: FloatArray,
    arm: FloatArray,
    lever: float,
    force: FloatArray,
    places: Places,
    ahead: FloatArray,
) -> Unbalance:
    """Residual Phi(g) - g of the sleeve's balance under the lateral force g on the left mesh and -g on the right.

    `places` holds start values and receives the solution, `ahead` (2, teeth) the interference; the size is inf if a
    mesh cannot hold the force.
    """
    moment_x, moment_y, xx, xy, yx, yy = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for mesh in range(2):
        sense = 1.0 - 2.0 * mesh
        teeth, normals, (arm_x, arm_y) = ahead[mesh], normal[mesh], arm[mesh]
        met, hessian = float_sleeve(interference[mesh], normals, sense * force, places, mesh, teeth)
        if met < 0:
            return Unbalance(np.inf, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        moment_x, by_x, by_y = add_friction_moment(moment_x, teeth, normals, arm_x, hessian)
        xx, xy = xx + sense * by_x, xy + sense * by_y
        moment_y, by_x, by_y = add_friction_moment(moment_y, teeth, normals, arm_y, hessian)
        yx, yy = yx + sense * by_x, yy + sense * by_y
    force_x, force_y = force
    x, y = lever * moment_x - force_x, lever * moment_y - force_y
    return Unbalance(hypot(x, y), x, y, 1.0 - lever * xx, -lever * xy, -lever * yx, 1.0 - lever * yy)


@inner_kernel
def balance_sleeve(
    interference: FloatArray,
    normal: FloatArray,
    arm: FloatArray,
    lever: float,
    force_limit: float,
    force: FloatArray,
    places: Places,
    ahead: FloatArray,
) -> float:
    """Solve Phi(g) = g at one rotor angle; return |Phi(g) - g|, inf if a mesh cannot hold the force [T/r_o] (Eq. C22).

    Newton's method with steps shortened until the residual falls; Phi is piecewise linear, so that it may cycle, and
    then damped substitutions follow. Shapes: `interference` (2, teeth) and `ahead`, which receives that of the balance,
    [T/(r_o c_t)]; `normal` (flank normals over cos(alpha)) and `arm` (2, 2, teeth) [-]; `force` (2,), in place [T/r_o].
    """
    accepted_x, accepted_y, step_x, step_y = 0.0, 0.0, 0.0, 0.0
    accepted_residual, length, substitutions = np.inf, 1.0, 0
    for _ in range(MAX_ITERATIONS):
        unbalance = unbalanced_force(interference, normal, arm, lever, force, places, ahead)
        residual = unbalance.size
        if residual < FORCE_TOLERANCE or residual == np.inf:
            return residual
        if substitutions > 0 or residual <= (1.0 - 0.1 * length) * accepted_residual:
            length = 1.0
        else:
            length *= 0.5
            if length < SHORTEST_STEP:
                substitutions = SUBSTITUTIONS
        if length == 1.0 or substitutions > 0:
            (accepted_x, accepted_y), accepted_residual = force, residual
            determinant = unbalance.xx * unbalance.yy - unbalance.xy * unbalance.yx
            if substitutions > 0 or abs(determinant) < 1e-6:
                substitutions = max(0, substitutions - 1)
                length = 0.5
                step_x, step_y = unbalance.x, unbalance.y
            else:
                step_x = (unbalance.yy * unbalance.x - unbalance.xy * unbalance.y) / determinant
                step_y = (unbalance.xx * unbalance.y - unbalance.yx * unbalance.x) / determinant
        x, y = accepted_x + length * step_x, accepted_y + length * step_y
        shortened = min(1.0, force_limit / hypot(x, y))
        force[0], force[1] = shortened * x, shortened * y
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
    """Balance the sleeve at every rotor angle from the one before, else from zero; return the largest residual.

    `share` (rows, 2, teeth) receives the tooth forces. Stops at the first angle without balance.
    """
    force, places = np.zeros(2), Places(np.zeros(2), np.zeros(2), np.zeros(2))
    largest = 0.0
    for row in range(interference.shape[0]):
        tooth, flank, friction = interference[row], normal[row], arm[row]
        residual = balance_sleeve(tooth, flank, friction, lever, force_limit, force, places, share[row])
        if residual >= FORCE_TOLERANCE:
            force[:] = 0.0
            places.x[:] = 0.0
            places.y[:] = 0.0
            residual = balance_sleeve(tooth, flank, friction, lever, force_limit, force, places, share[row])
        largest = max(largest, residual)
        if residual >= FORCE_TOLERANCE:
            break
        for mesh in range(2):
            for i in range(share.shape[2]):
                share[row, mesh, i] = max(0.0, share[row, mesh, i])
    return largest


@dataclass(frozen=True, slots=True)
class SleeveEquilibrium:
    """Mean thrust on one shaft [N], positive if it pulls the shafts together, and moment on the sleeve [N m]."""

    thrust: float
    overturning_moment: float


def two_meshes(inputs: CouplingInputs, geometry: Geometry) -> tuple[MeshMotion, MeshMotion]:
    """Left mesh (hub drives) and right mesh (sleeve drives); the right hub tilts alike (Z) or oppositely (M)."""
    right_tilt = 1 if inputs.operation.arrangement == "parallel_offset" else -1
    left = mesh_motion(inputs.coupling, geometry, inputs.operation, inputs.model.kinematics)
    right = mesh_motion(inputs.coupling, geometry, inputs.operation, inputs.model.kinematics, side=-1, tilt=right_tilt)
    return left, right


def sleeve_equilibrium(
    inputs: CouplingInputs, geometry: Geometry, friction: float, axial_velocity: float
) -> SleeveEquilibrium:
    """Thrust [N] and overturning moment [N m] of two meshes; both zero if nothing slides (Eq. C22).

    `axial_velocity` is that of each mesh, positive if the shafts move apart [m/s]. Phi(g) is the lateral force that
    balances the friction moments under a lateral force g; if mu d_o/l_H < cos(pi/z), the teeth can hold Phi(g) for
    every g that they can hold, and Phi(g) = g has a solution (Brouwer). Raises NoSolution: `sleeve_equilibrium`.
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
    """Tangential tooth forces [N] in the shape of `direction` (rotor angles, meshes, teeth).

    Raises NoSolution with the unbalanced lateral force over T/r_o, at most 1.
    """
    coupling, teeth = inputs.coupling, samples.teeth
    unit, cosine = elastic_rotation(coupling, inputs.operation.torque), cos(coupling.pressure_angle)
    interference = np.stack([interference_at_rest(coupling, mesh, teeth) / unit for mesh in meshes], axis=1)
    normal = np.stack([flank_normals(mesh, teeth) for mesh in meshes], axis=1)
    arm = direction[:, :, None] * np.stack((teeth.cosine, teeth.sine), axis=1)[:, None]
    lever = friction / cosine * geometry.pitch_radius / coupling.hub_distance
    # Largest lateral force that z teeth hold at every rotor angle; the flank normals form a regular polygon.
    force_limit = _LIMIT_MARGIN * cos(pi / coupling.teeth) / cosine
    share = np.zeros_like(interference)
    residual = balance_rows(interference, normal, arm, lever, force_limit, share)
    if residual >= FORCE_TOLERANCE:
        raise NoSolution(
            "sleeve_equilibrium",
            "friction tilts the sleeve, and the tooth forces cannot balance the tilting moment; increase the hub "
            "distance or reduce the friction",
            {"lateral_force": min(residual, 1.0)},
        )
    return unit * coupling.tooth_stiffness * share
