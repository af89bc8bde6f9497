"""Balance of a floating sleeve between two meshes under friction: the kernels.

Units as in teeth.floating_balance. First index of a pair: the mesh, left (0) or right (1).
"""

from math import hypot

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.coupling.teeth.floating_balance import (
    ALONG_X,
    ALONG_Y,
    ROTATION,
    SHIFT_X,
    SHIFT_Y,
    float_sleeve,
    solve_loaded,
)

MAX_ITERATIONS = 150
SUBSTITUTIONS = 5
SHORTEST_STEP = 1.0 / 64.0
FORCE_TOLERANCE = 1e-9


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
    piecewise linear (teeth come under load) and Newton may cycle between its pieces.
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
