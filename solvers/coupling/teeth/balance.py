"""How the teeth of one mesh balance the torque, and with a floating sleeve a lateral force: the kernels.

Lengths count in T/(r_o c_t) and forces in T/r_o, so that the tooth forces add up to one. Tooth i interferes by
u_i = psi + w_i and carries max(0, u_i), for teeth never pull: psi is the common rotation, w_i how far the tooth is
ahead.

With a floating sleeve tooth i interferes by u_i = psi + w_i - e . d_i: e is the sleeve's displacement, d_i the flank
normal over cos(alpha).

The sleeve minimises the convex energy sum max(0, u_i)^2/2 - psi - force . e, quadratic in pieces. Newton's steps are
minimised along exactly, so that the energy falls with each of them whatever the start: every sleeve that can be
balanced is. The u_i themselves are carried from step to step: formed anew from psi and e they would lose the digits
of a tooth force that is small against how far the teeth are ahead.
"""

from math import atan2, cos, hypot, pi, sin

import numpy as np

from solvers.arrays import FloatArray, IntArray
from solvers.compiled import kernel

MAX_ITERATIONS = 10_000  # limit that no balance should reach: each step lowers the energy
BALANCE_TOLERANCE = 1e-13  # in units of T/r_o: some hundred roundings
LONGEST_STEP = 1e100  # stands for infinity without overflow when it is squared
STIFF = 1e-12
"""Least stiffness of the sleeve that counts, over that of the loaded teeth together: rounding is some 1e-16 of it."""
FLAT = 1e-12
"""Slope along a step over the slope at its start that counts as none: the lowest energy is reached."""

ROTATION, SHIFT_X, SHIFT_Y = range(3)  # of states, of the forces that belong to them, of the energy's hessian
ALONG_X, ALONG_Y = range(2)  # of lateral forces and normals


@kernel
def _crossing(ahead: FloatArray, highest: float, psi: float) -> float:
    """Where the teeth that psi > 0 loads would carry unit torque: Newton's step on sum max(0, psi + lead_i) = 1."""
    count, total = 0, 0.0
    for lead in ahead:
        behind = lead - highest
        if psi + behind > 0.0:
            count += 1
            total += behind
    return (1.0 - total) / count


@kernel
def rotation_of_leads(ahead: FloatArray, highest: float, start: float) -> float:
    """The psi at which sum max(0, psi + lead_i) = 1, exactly, for leads w_i less the highest of them (Eq. C8).

    Equal to sorting them in falling order and taking the largest k whose psi_k = (1 - sum_1..k lead)/k loads tooth k.
    The sum is convex and linear in pieces: Newton's first step leads to the right of psi from any `start` > 0, the
    others fall, each by at least one tooth less, until they have found the piece.
    """
    psi = _crossing(ahead, highest, start)
    following = _crossing(ahead, highest, psi)
    while following < psi:
        psi, following = following, _crossing(ahead, highest, following)
    return psi


@kernel
def turn_to_torque(ahead: FloatArray, start: float) -> tuple[float, float]:
    """Turn w_i in `ahead` into the u_i that carry unit torque.

    Returns the common rotation psi against the highest w_i, which is sought from `start`, and against all.
    """
    highest: float = ahead[0]
    for lead in ahead:
        highest = max(highest, lead)
    psi = rotation_of_leads(ahead, highest, start)
    for i in range(ahead.size):
        ahead[i] = ahead[i] - highest + psi
    return psi, psi - highest


@kernel
def centred_rows(ahead: FloatArray, unit: float, unit_force: float, rotation: FloatArray) -> None:
    """Turn how far teeth are ahead into the forces of a centred sleeve, row by row, and note its rotation.

    `unit` and `unit_force` are what lengths and forces count in, T/(r_o c_t) and T/r_o.
    """
    psi = 1.0
    for row in range(ahead.shape[0]):
        for i in range(ahead.shape[1]):
            ahead[row, i] /= unit
        psi, turned = turn_to_torque(ahead[row], psi)
        rotation[row] = unit * turned
        for i in range(ahead.shape[1]):
            ahead[row, i] = unit_force * max(0.0, ahead[row, i])


@kernel
def add_up(ahead: FloatArray, normal: FloatArray, held: FloatArray, hessian: FloatArray) -> None:
    """Sum of loaded teeth: torque and lateral force in `held` (3), upper triangle of the energy's `hessian` (3, 3)."""
    held[:] = 0.0
    hessian[:, :] = 0.0
    for i in range(ahead.size):
        u = ahead[i]
        if u > 0.0:
            nx, ny = normal[ALONG_X, i], normal[ALONG_Y, i]
            held[ROTATION] += u
            held[SHIFT_X] -= u * nx
            held[SHIFT_Y] -= u * ny
            hessian[ROTATION, ROTATION] += 1.0
            hessian[ROTATION, SHIFT_X] -= nx
            hessian[ROTATION, SHIFT_Y] -= ny
            hessian[SHIFT_X, SHIFT_X] += nx * nx
            hessian[SHIFT_X, SHIFT_Y] += nx * ny
            hessian[SHIFT_Y, SHIFT_Y] += ny * ny


@kernel
def solve_loaded(hessian: FloatArray, right: FloatArray, solution: FloatArray, free: FloatArray) -> None:
    """Solve hessian solution = right as far as the loaded teeth are stiff, and leave in `free` (2) what they are not.

    The rotation is eliminated. What is left, the scatter of the loaded flank normals, is solved along its principal
    directions: fewer than three loaded teeth have no stiffness in one or both of them, and the sleeve stays there.
    `free` is the lateral part of `right` in those directions.
    """
    (loaded, sum_x, sum_y), (_, sum_xx, sum_xy), (_, _, sum_yy) = hessian
    loaded = max(loaded, 1.0)
    mean_x, mean_y = sum_x / loaded, sum_y / loaded
    xx, xy = sum_xx - sum_x * mean_x, sum_xy - sum_x * mean_y
    yy = sum_yy - sum_y * mean_y
    x, y = right[SHIFT_X] - right[ROTATION] * mean_x, right[SHIFT_Y] - right[ROTATION] * mean_y
    angle = 0.5 * atan2(2.0 * xy, xx - yy)
    half_sum, half_difference = 0.5 * (xx + yy), 0.5 * hypot(2.0 * xy, xx - yy)
    solution[:] = 0.0
    free[:] = 0.0
    for turn, stiffness in ((0.0, half_sum + half_difference), (0.5 * pi, half_sum - half_difference)):
        nx, ny = cos(angle + turn), sin(angle + turn)
        component = nx * x + ny * y
        if stiffness > STIFF * loaded:
            solution[SHIFT_X] += component / stiffness * nx
            solution[SHIFT_Y] += component / stiffness * ny
        else:
            free[ALONG_X] += component * nx
            free[ALONG_Y] += component * ny
    solution[ROTATION] = right[ROTATION] / loaded - mean_x * solution[SHIFT_X] - mean_y * solution[SHIFT_Y]


@kernel
def next_step(hessian: FloatArray, missing: FloatArray, step: FloatArray) -> float:
    """Newton's step towards the forces that are `missing`; returns how fast the energy falls along it.

    Where most of what is missing acts in a direction without stiffness, the step is one along that direction instead,
    by which the loaded teeth stay loaded as they are: the next tooth that meets the sleeve stops it.
    """
    free = np.empty(2)
    solve_loaded(hessian, missing, step, free)
    unheld = hypot(free[ALONG_X], free[ALONG_Y])
    if unheld > 0.5 * (abs(missing[ROTATION]) + abs(missing[SHIFT_X]) + abs(missing[SHIFT_Y])):
        loaded = max(hessian[ROTATION, ROTATION], 1.0)
        step[SHIFT_X], step[SHIFT_Y] = free[ALONG_X] / unheld, free[ALONG_Y] / unheld
        step[ROTATION] = (
            -(hessian[ROTATION, SHIFT_X] * step[SHIFT_X] + hessian[ROTATION, SHIFT_Y] * step[SHIFT_Y]) / loaded
        )
    fall: float = (
        missing[ROTATION] * step[ROTATION] + missing[SHIFT_X] * step[SHIFT_X] + missing[SHIFT_Y] * step[SHIFT_Y]
    )
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
    """Length of a step at which the energy is lowest, LONGEST_STEP where it has no minimum.

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
    `hessian` (3, 3) of the loaded teeth at the balance. Eq. C9.
    """
    held, missing, step = np.empty(3), np.empty(3), np.empty(3)
    change = np.empty(ahead.size)
    for i in range(ahead.size):
        ahead[i] = interference[i] - state[SHIFT_X] * normal[ALONG_X, i] - state[SHIFT_Y] * normal[ALONG_Y, i]
    _, state[ROTATION] = turn_to_torque(ahead, 1.0)
    for iteration in range(1, MAX_ITERATIONS + 1):
        add_up(ahead, normal, held, hessian)
        missing[ROTATION] = 1.0 - held[ROTATION]
        missing[SHIFT_X] = force[ALONG_X] - held[SHIFT_X]
        missing[SHIFT_Y] = force[ALONG_Y] - held[SHIFT_Y]
        if abs(missing[ROTATION]) + abs(missing[SHIFT_X]) + abs(missing[SHIFT_Y]) < BALANCE_TOLERANCE:
            return iteration
        descent = next_step(hessian, missing, step)
        for i in range(ahead.size):
            change[i] = step[ROTATION] - step[SHIFT_X] * normal[ALONG_X, i] - step[SHIFT_Y] * normal[ALONG_Y, i]
        length = length_to_lowest(ahead, change, -descent)
        if length >= LONGEST_STEP:
            break
        for i in range(ahead.size):
            ahead[i] += length * change[i]
        for axis in range(3):
            state[axis] += length * step[axis]
    return -MAX_ITERATIONS


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
