"""Balance of a floating sleeve between two meshes under friction: the kernels.

Units as in tooth_balance. First index of a pair: the mesh, left (0) or right (1).
"""

from math import hypot

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.coupling.tooth_balance import float_sleeve, solve_symmetric

MAX_ITERATIONS = 60
FORCE_TOLERANCE = 1e-9


@kernel
def add_friction_moment(
    interference: FloatArray,
    normal: FloatArray,
    arm: FloatArray,
    state: FloatArray,
    system: FloatArray,
    sense: float,
    moment: FloatArray,
    slope: FloatArray,
) -> None:
    """Add sum F_t sgn(v_r) e_r of one mesh to `moment` (2), and its slope by the force on the left mesh to `slope`.

    `arm` (2, teeth) holds sgn(v_r) e_r; `system` the mesh's Hessian as float_sleeve left it; `sense` is +1 or -1
    where the mesh feels the force or its opposite.
    """
    weighted = np.zeros((2, 3))
    row = np.empty(3)
    for i in range(interference.size):
        u = state[0] + interference[i] - state[1] * normal[0, i] - state[2] * normal[1, i]
        if u > 0.0:
            for axis in range(2):
                moment[axis] += arm[axis, i] * u
                weighted[axis, 0] += arm[axis, i]
                weighted[axis, 1] -= arm[axis, i] * normal[0, i]
                weighted[axis, 2] -= arm[axis, i] * normal[1, i]
    for axis in range(2):
        # The Hessian is symmetric: its inverse times the weights is the derivative by (torque, force).
        solve_symmetric(system, weighted[axis], row)
        slope[axis, 0] += sense * row[1]
        slope[axis, 1] += sense * row[2]


@kernel
def balance_sleeve(
    interference: FloatArray,
    normal: FloatArray,
    arm: FloatArray,
    lever: float,
    force_limit: float,
    force: FloatArray,
    state: FloatArray,
) -> float:
    """Solve Phi(g) = g at one rotor angle from and into `force` g (2) and `state` (2, 3); returns |Phi(g) - g|.

    interference (2, teeth), normal and arm (2, 2, teeth); `lever` is (mu/cos alpha)(r_o/l_H). Newton's method; plain
    and damped substitution where the slope is singular or the residual does not fall. The residual is inf where a
    mesh cannot hold the force.
    """
    system, moment, slope = np.empty((3, 4)), np.empty(2), np.empty((2, 2))
    residual, previous, damping = np.inf, np.inf, 1.0
    for _ in range(MAX_ITERATIONS):
        moment[:] = 0.0
        slope[:, :] = 0.0
        for mesh in range(2):
            sense = 1.0 - 2.0 * mesh
            if float_sleeve(interference[mesh], normal[mesh], sense * force, state[mesh], system) < 0:
                return np.inf
            add_friction_moment(interference[mesh], normal[mesh], arm[mesh], state[mesh], system, sense, moment, slope)
        gap_x, gap_y = lever * moment[0] - force[0], lever * moment[1] - force[1]
        residual = hypot(gap_x, gap_y)
        if residual < FORCE_TOLERANCE:
            break
        damping = 0.5 * damping if residual > 0.9 * previous else min(1.0, 2.0 * damping)
        previous = residual
        a, b = 1.0 - lever * slope[0, 0], -lever * slope[0, 1]
        c, d = -lever * slope[1, 0], 1.0 - lever * slope[1, 1]
        determinant = a * d - b * c
        if abs(determinant) > 1e-6 and damping > 0.2:
            gap_x, gap_y = (d * gap_x - b * gap_y) / determinant, (a * gap_y - c * gap_x) / determinant
        force[0] += damping * gap_x
        force[1] += damping * gap_y
        size = hypot(force[0], force[1])
        if size > force_limit:
            force *= force_limit / size
    return residual


@kernel
def balance_rows(
    interference: FloatArray,
    normal: FloatArray,
    arm: FloatArray,
    lever: float,
    force_limit: float,
    state: FloatArray,
    residual: FloatArray,
) -> None:
    """Balance the sleeve at every rotor angle, each started from the one before, then from rest if that fails."""
    force = np.zeros(2)
    for row in range(interference.shape[0]):
        if row > 0:
            state[row] = state[row - 1]
        for _ in range(2):
            residual[row] = balance_sleeve(
                interference[row], normal[row], arm[row], lever, force_limit, force, state[row]
            )
            if residual[row] < FORCE_TOLERANCE:
                break
            force[:] = 0.0
            state[row] = 0.0
