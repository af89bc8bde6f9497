"""How the teeth of one mesh balance the torque and a lateral force: the kernels.

Lengths count in T/(r_o c_t) and forces in T/r_o, so that the tooth forces add up to one. Tooth i interferes by
u_i = psi + w_i - e . d_i and carries max(0, u_i), for teeth never pull: psi is the common rotation, w_i how far the
tooth is ahead, e the sleeve's displacement, d_i the flank normal over cos(alpha).
"""

from math import sqrt

import numpy as np

from solvers.arrays import FloatArray, IntArray
from solvers.compiled import kernel

MAX_ITERATIONS = 300
BALANCE_TOLERANCE = 1e-13
FARTHEST = 1e14


@kernel
def common_rotation(interference: FloatArray) -> float:
    """The psi at which sum max(0, psi + w_i) = 1, exactly.

    Equal to sorting w in falling order and taking the largest k whose psi_k = (1 - sum_1..k w)/k loads tooth k.
    Newton from the right on the convex, piecewise linear sum drops at least one tooth a step and ends on it.
    """
    highest: float = interference.max()
    loaded = interference.size + 1
    psi = 1.0
    while True:
        count = 0
        total = 0.0
        for w in interference:
            if psi + (w - highest) > 0.0:
                count += 1
                total += w - highest
        if count == loaded:
            return psi - highest
        loaded = count
        psi = (1.0 - total) / count


@kernel
def balance(interference: FloatArray, normal: FloatArray, state: FloatArray, system: FloatArray) -> float:
    """Energy of the sleeve in `state` (psi, e_x, e_y) without external force, its gradient and Hessian in `system`.

    `system` (3, 4): the Hessian of the loaded teeth in columns 0-2, the gradient (less torque and force) in column 3.
    """
    system[:, :] = 0.0
    energy = 0.0
    for i in range(interference.size):
        nx, ny = normal[0, i], normal[1, i]
        u = state[0] + interference[i] - state[1] * nx - state[2] * ny
        if u > 0.0:
            energy += 0.5 * u * u
            system[0, 0] += 1.0
            system[0, 1] -= nx
            system[0, 2] -= ny
            system[1, 1] += nx * nx
            system[1, 2] += nx * ny
            system[2, 2] += ny * ny
            system[0, 3] += u
            system[1, 3] -= u * nx
            system[2, 3] -= u * ny
    return energy


@kernel
def solve_symmetric(system: FloatArray, right: FloatArray, solution: FloatArray) -> None:
    """Solve the 3 x 3 system whose upper triangle `system` holds, with 1e-9 added to its diagonal (Cholesky).

    The addition keeps it regular with fewer than three loaded teeth and does not move the solution, which the
    gradient alone decides.
    """
    a00 = sqrt(system[0, 0] + 1e-9)
    a01, a02 = system[0, 1] / a00, system[0, 2] / a00
    a11 = sqrt(max(system[1, 1] + 1e-9 - a01 * a01, 1e-10))
    a12 = (system[1, 2] - a01 * a02) / a11
    a22 = sqrt(max(system[2, 2] + 1e-9 - a02 * a02 - a12 * a12, 1e-10))
    y0 = right[0] / a00
    y1 = (right[1] - a01 * y0) / a11
    y2 = (right[2] - a02 * y0 - a12 * y1) / a22
    solution[2] = y2 / a22
    solution[1] = (y1 - a12 * solution[2]) / a11
    solution[0] = (y0 - a01 * solution[1] - a02 * solution[2]) / a00


@kernel
def potential(energy: float, force: FloatArray, state: FloatArray) -> float:
    """What a balanced sleeve minimises: the teeth's energy less the work of unit torque and lateral force (2)."""
    work: float = state[0] + force[0] * state[1] + force[1] * state[2]
    return energy - work


@kernel
def slope(force: FloatArray, system: FloatArray, step: FloatArray) -> float:
    """How fast the potential falls along `step` (3)."""
    torque: float = 1.0 - system[0, 3]
    fall: float = torque * step[0] + (force[0] - system[1, 3]) * step[1] + (force[1] - system[2, 3]) * step[2]
    return fall


@kernel
def move_downhill(
    interference: FloatArray,
    normal: FloatArray,
    force: FloatArray,
    state: FloatArray,
    step: FloatArray,
    energy: float,
    system: FloatArray,
) -> float:
    """Move `state` along Newton's `step` (3) to a lower potential; returns the energy and leaves `system` there.

    The step halves until the potential falls enough. Where fewer than three teeth carry, the sleeve moves freely in
    some direction, and the next tooth may be many steps away: a whole step doubles while the slope stays as it was.
    """
    start = state.copy()
    descent = slope(force, system, step)
    before = potential(energy, force, start)
    length = 1.0
    while True:
        state[:] = start + length * step
        energy = balance(interference, normal, state, system)
        drop = before - potential(energy, force, state)
        if drop >= 1e-4 * length * descent - 1e-13 * (abs(before) + 1.0) or length < 1e-14:
            break
        length *= 0.5
    while 1.0 <= length < FARTHEST and slope(force, system, step) > 0.5 * descent:
        nearer = potential(energy, force, state)
        length *= 2.0
        state[:] = start + length * step
        energy = balance(interference, normal, state, system)
        if potential(energy, force, state) > nearer:
            state[:] = start + 0.5 * length * step
            return balance(interference, normal, state, system)
    return energy


@kernel
def float_sleeve(
    interference: FloatArray, normal: FloatArray, force: FloatArray, state: FloatArray, system: FloatArray
) -> int:
    """Balance a floating sleeve under unit torque and an external `force` (2), from and into `state` (psi, e_x, e_y).

    Damped semi-smooth Newton on the convex energy sum max(0, u_i)^2/2 - psi - force . e. Returns the number of
    iterations, negative if the balance was not met; `system` is left as at the solution.
    """
    residual, step = np.empty(3), np.empty(3)
    state[0] = common_rotation(interference - state[1] * normal[0] - state[2] * normal[1])
    energy = balance(interference, normal, state, system)
    for iteration in range(1, MAX_ITERATIONS + 1):
        residual[0] = 1.0 - system[0, 3]
        residual[1] = force[0] - system[1, 3]
        residual[2] = force[1] - system[2, 3]
        rounding = 1e-15 * interference.size * (abs(state[0]) + abs(state[1]) + abs(state[2]))
        if abs(residual[0]) + abs(residual[1]) + abs(residual[2]) < BALANCE_TOLERANCE + rounding:
            return iteration
        solve_symmetric(system, residual, step)
        energy = move_downhill(interference, normal, force, state, step, energy, system)
        if not abs(state[1]) + abs(state[2]) < FARTHEST:
            break
    return -MAX_ITERATIONS


@kernel
def centred_rows(interference: FloatArray, share: FloatArray, rotation: FloatArray) -> None:
    """Shares and rotation of a centred sleeve, row by row."""
    for row in range(interference.shape[0]):
        psi = common_rotation(interference[row])
        rotation[row] = psi
        for i in range(interference.shape[1]):
            share[row, i] = max(0.0, psi + interference[row, i])


@kernel
def floating_rows(
    interference: FloatArray, normal: FloatArray, force: FloatArray, state: FloatArray, iterations: IntArray
) -> None:
    """States (rows, 3) of a floating sleeve under `force` (rows, 2), each row started from the one before.

    Where that fails it starts from rest; a row that fails again, its iterations negative, ends it: later rows stay
    untouched.
    """
    system = np.empty((3, 4))
    for row in range(interference.shape[0]):
        state[row] = state[max(row - 1, 0)]
        iterations[row] = float_sleeve(interference[row], normal[row], force[row], state[row], system)
        if iterations[row] < 0:
            state[row] = 0.0
            iterations[row] = float_sleeve(interference[row], normal[row], force[row], state[row], system)
        if iterations[row] < 0:
            break
