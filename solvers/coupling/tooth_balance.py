"""How the teeth of one mesh balance the torque and a lateral force: the kernels.

Lengths count in T/(r_o c_t) and forces in T/r_o, so that the tooth forces add up to one. Tooth i interferes by
u_i = psi + w_i - e . d_i and carries max(0, u_i), for teeth never pull: psi is the common rotation, w_i how far the
tooth is ahead, e the sleeve's displacement, d_i the flank normal over cos(alpha).

A floating sleeve minimises the convex energy sum max(0, u_i)^2/2 - psi - force . e, quadratic in pieces. Newton's
steps are minimised along exactly, so that the energy falls with each of them whatever the start: every sleeve that can
be balanced is. The u_i themselves are carried from step to step: formed anew from psi and e they would lose the digits
of a tooth force that is small against how far the teeth are ahead.
"""

from math import atan2, cos, hypot, pi, sin

import numpy as np

from solvers.arrays import FloatArray, IntArray
from solvers.compiled import kernel

MAX_ITERATIONS = 10_000
BALANCE_TOLERANCE = 1e-13
LONGEST_STEP = 1e100
STIFF = 1e-12
"""Least stiffness of the sleeve that counts, over that of the loaded teeth together: rounding is some 1e-16 of it."""
FLAT = 1e-12
"""Slope along a step over the slope at its start that counts as none: the lowest energy is reached."""


@kernel
def rotation_of_leads(lead: FloatArray) -> float:
    """The psi at which sum max(0, psi + lead_i) = 1, exactly, for leads whose largest is zero.

    Equal to sorting them in falling order and taking the largest k whose psi_k = (1 - sum_1..k lead)/k loads tooth k.
    Newton from the right on the convex, piecewise linear sum drops at least one tooth a step and ends on it.
    """
    loaded = lead.size + 1
    psi = 1.0
    while True:
        count = 0
        total = 0.0
        for behind in lead:
            if psi + behind > 0.0:
                count += 1
                total += behind
        if count == loaded:
            return psi
        loaded = count
        psi = (1.0 - total) / count


@kernel
def turn_to_torque(ahead: FloatArray) -> float:
    """Turn w_i in `ahead` into the u_i that carry unit torque; returns the common rotation psi."""
    highest: float = ahead.max()
    for i in range(ahead.size):
        ahead[i] -= highest
    psi = rotation_of_leads(ahead)
    for i in range(ahead.size):
        ahead[i] += psi
    return psi - highest


@kernel
def add_up(ahead: FloatArray, normal: FloatArray, held: FloatArray, hessian: FloatArray) -> None:
    """Sum of loaded teeth: torque and lateral force in `held` (3), upper triangle of the energy's `hessian` (3, 3)."""
    held[:] = 0.0
    hessian[:, :] = 0.0
    for i in range(ahead.size):
        u = ahead[i]
        if u > 0.0:
            nx, ny = normal[0, i], normal[1, i]
            held[0] += u
            held[1] -= u * nx
            held[2] -= u * ny
            hessian[0, 0] += 1.0
            hessian[0, 1] -= nx
            hessian[0, 2] -= ny
            hessian[1, 1] += nx * nx
            hessian[1, 2] += nx * ny
            hessian[2, 2] += ny * ny


@kernel
def solve_loaded(hessian: FloatArray, right: FloatArray, solution: FloatArray, free: FloatArray) -> None:
    """Solve hessian solution = right as far as the loaded teeth are stiff, and leave in `free` (2) what they are not.

    The rotation is eliminated. What is left, the scatter of the loaded flank normals, is solved along its principal
    directions: fewer than three loaded teeth have no stiffness in one or both of them, and the sleeve stays there.
    `free` is the lateral part of `right` in those directions.
    """
    loaded = max(hessian[0, 0], 1.0)
    mean_x, mean_y = hessian[0, 1] / loaded, hessian[0, 2] / loaded
    xx, xy = hessian[1, 1] - hessian[0, 1] * mean_x, hessian[1, 2] - hessian[0, 1] * mean_y
    yy = hessian[2, 2] - hessian[0, 2] * mean_y
    x, y = right[1] - right[0] * mean_x, right[2] - right[0] * mean_y
    angle = 0.5 * atan2(2.0 * xy, xx - yy)
    half_sum, half_difference = 0.5 * (xx + yy), 0.5 * hypot(2.0 * xy, xx - yy)
    solution[:] = 0.0
    free[:] = 0.0
    for turn, stiffness in ((0.0, half_sum + half_difference), (0.5 * pi, half_sum - half_difference)):
        nx, ny = cos(angle + turn), sin(angle + turn)
        component = nx * x + ny * y
        if stiffness > STIFF * loaded:
            solution[1] += component / stiffness * nx
            solution[2] += component / stiffness * ny
        else:
            free[0] += component * nx
            free[1] += component * ny
    solution[0] = right[0] / loaded - mean_x * solution[1] - mean_y * solution[2]


@kernel
def next_step(hessian: FloatArray, missing: FloatArray, step: FloatArray) -> float:
    """Newton's step towards the forces that are `missing`; returns how fast the energy falls along it.

    Where most of what is missing acts in a direction without stiffness, the step is one along that direction instead,
    by which the loaded teeth stay loaded as they are: the next tooth that meets the sleeve stops it.
    """
    free = np.empty(2)
    solve_loaded(hessian, missing, step, free)
    unheld = hypot(free[0], free[1])
    if unheld > 0.5 * (abs(missing[0]) + abs(missing[1]) + abs(missing[2])):
        loaded = max(hessian[0, 0], 1.0)
        step[1], step[2] = free[0] / unheld, free[1] / unheld
        step[0] = -(hessian[0, 1] * step[1] + hessian[0, 2] * step[2]) / loaded
    fall: float = missing[0] * step[0] + missing[1] * step[1] + missing[2] * step[2]
    return fall


@kernel
def slope_along(ahead: FloatArray, change: FloatArray, start: float, length: float) -> tuple[float, float]:
    """First and second derivative of the energy by the length of a step that changes u_i by `change`.

    Formed from the first derivative at the `start`, for near the balance torque and tooth forces cancel.
    """
    first, second = start, 0.0
    for i in range(ahead.size):
        u = ahead[i] + length * change[i]
        first += (max(0.0, u) - max(0.0, ahead[i])) * change[i]
        if u > 0.0:
            second += change[i] * change[i]
    return first, second


@kernel
def length_to_lowest(ahead: FloatArray, change: FloatArray, start: float) -> float:
    """Length of a step at which the energy is lowest, LONGEST_STEP where it falls for ever.

    Newton on the slope, which rises with the length in straight pieces from its negative `start`, held between the
    lengths known to lie before and behind the lowest energy. Where no tooth resists, the next one may be many steps
    away: the length doubles.
    """
    before, behind, length = 0.0, LONGEST_STEP, 1.0
    while length < LONGEST_STEP:
        first, second = slope_along(ahead, change, start, length)
        if abs(first) <= FLAT * abs(start):
            break
        if first < 0.0:
            before = length
        else:
            behind = length
        further = length - first / second if second > 0.0 else 2.0 * length
        if not before < further < behind:
            further = 0.5 * (before + behind) if behind < LONGEST_STEP else 2.0 * length
        if further in (length, before, behind):
            break
        length = further
    return length


@kernel
def float_sleeve(
    interference: FloatArray,
    normal: FloatArray,
    force: FloatArray,
    state: FloatArray,
    ahead: FloatArray,
    hessian: FloatArray,
) -> int:
    """Balance a floating sleeve under unit torque and an external `force` (2), from and into `state` (psi, e_x, e_y).

    Returns the number of iterations, negative if the balance was not met. Leaves u_i in `ahead` (teeth) and the
    `hessian` (3, 3) of the loaded teeth at the balance.
    """
    held, missing, step = np.empty(3), np.empty(3), np.empty(3)
    change = np.empty(ahead.size)
    for i in range(ahead.size):
        ahead[i] = interference[i] - state[1] * normal[0, i] - state[2] * normal[1, i]
    state[0] = turn_to_torque(ahead)
    for iteration in range(1, MAX_ITERATIONS + 1):
        add_up(ahead, normal, held, hessian)
        missing[0] = 1.0 - held[0]
        missing[1] = force[0] - held[1]
        missing[2] = force[1] - held[2]
        if abs(missing[0]) + abs(missing[1]) + abs(missing[2]) < BALANCE_TOLERANCE:
            return iteration
        descent = next_step(hessian, missing, step)
        for i in range(ahead.size):
            change[i] = step[0] - step[1] * normal[0, i] - step[2] * normal[1, i]
        length = length_to_lowest(ahead, change, -descent)
        if length >= LONGEST_STEP:
            break
        for i in range(ahead.size):
            ahead[i] += length * change[i]
        for axis in range(3):
            state[axis] += length * step[axis]
    return -MAX_ITERATIONS


@kernel
def centred_rows(interference: FloatArray, share: FloatArray, rotation: FloatArray) -> None:
    """Shares and rotation of a centred sleeve, row by row."""
    for row in range(interference.shape[0]):
        share[row] = interference[row]
        rotation[row] = turn_to_torque(share[row])
        for i in range(interference.shape[1]):
            share[row, i] = max(0.0, share[row, i])


@kernel
def floating_rows(
    interference: FloatArray,
    normal: FloatArray,
    force: FloatArray,
    share: FloatArray,
    state: FloatArray,
    iterations: IntArray,
) -> None:
    """Shares and states (rows, 3) of a floating sleeve under `force` (rows, 2), each row started from the one before.

    A row without balance, its iterations negative, ends it: later rows stay untouched.
    """
    hessian = np.empty((3, 3))
    for row in range(interference.shape[0]):
        state[row] = state[max(row - 1, 0)]
        iterations[row] = float_sleeve(interference[row], normal[row], force[row], state[row], share[row], hessian)
        for i in range(interference.shape[1]):
            share[row, i] = max(0.0, share[row, i])
        if iterations[row] < 0:
            break
