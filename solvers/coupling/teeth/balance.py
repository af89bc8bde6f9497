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
from typing import NamedTuple

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


class Motion(NamedTuple):
    """Common rotation of the teeth and displacement of the sleeve; or the torque and lateral force that act on them."""

    rotation: float
    x: float
    y: float


class Places(NamedTuple):
    """Rotation psi and sleeve displacement (e_x, e_y) of balanced meshes, an array each."""

    rotation: FloatArray
    x: FloatArray
    y: FloatArray


class Hessian(NamedTuple):
    """Second derivatives of the energy: over loaded teeth the sums of 1, -d_x, -d_y, d_x^2, d_x d_y and d_y^2."""

    loaded: float
    x: float
    y: float
    xx: float
    xy: float
    yy: float


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
def add_up(ahead: FloatArray, normal: FloatArray) -> tuple[Motion, Hessian]:
    """Torque and lateral force that the loaded teeth hold, and the energy's second derivatives."""
    normal_x, normal_y = normal
    torque, force_x, force_y = 0.0, 0.0, 0.0
    loaded, x, y, xx, xy, yy = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(ahead.size):
        u = ahead[i]
        if u > 0.0:
            nx, ny = normal_x[i], normal_y[i]
            torque += u
            force_x -= u * nx
            force_y -= u * ny
            loaded += 1.0
            x -= nx
            y -= ny
            xx += nx * nx
            xy += nx * ny
            yy += ny * ny
    return Motion(torque, force_x, force_y), Hessian(loaded, x, y, xx, xy, yy)


@kernel
def solve_loaded(hessian: Hessian, right: Motion) -> tuple[Motion, float, float]:
    """Solve hessian motion = right as far as the loaded teeth are stiff, and return the lateral force they are not.

    The rotation is eliminated. What is left, the scatter of the loaded flank normals, is solved along its principal
    directions: fewer than three loaded teeth have no stiffness in one or both of them, and the sleeve stays there.
    The force (x, y) returned is the lateral part of `right` in those directions.
    """
    loaded = max(hessian.loaded, 1.0)
    mean_x, mean_y = hessian.x / loaded, hessian.y / loaded
    xx, xy = hessian.xx - hessian.x * mean_x, hessian.xy - hessian.x * mean_y
    yy = hessian.yy - hessian.y * mean_y
    x, y = right.x - right.rotation * mean_x, right.y - right.rotation * mean_y
    angle = 0.5 * atan2(2.0 * xy, xx - yy)
    half_sum, half_difference = 0.5 * (xx + yy), 0.5 * hypot(2.0 * xy, xx - yy)
    shift_x, shift_y, free_x, free_y = 0.0, 0.0, 0.0, 0.0
    for turn, stiffness in ((0.0, half_sum + half_difference), (0.5 * pi, half_sum - half_difference)):
        nx, ny = cos(angle + turn), sin(angle + turn)
        component = nx * x + ny * y
        if stiffness > STIFF * loaded:
            shift_x += component / stiffness * nx
            shift_y += component / stiffness * ny
        else:
            free_x += component * nx
            free_y += component * ny
    rotation = right.rotation / loaded - mean_x * shift_x - mean_y * shift_y
    return Motion(rotation, shift_x, shift_y), free_x, free_y


@kernel
def next_step(hessian: Hessian, missing: Motion) -> tuple[Motion, float]:
    """Newton's step towards the forces that are `missing`, and how fast the energy falls along it.

    Where most of what is missing acts in a direction without stiffness, the step is one along that direction instead,
    by which the loaded teeth stay loaded as they are: the next tooth that meets the sleeve stops it.
    """
    step, free_x, free_y = solve_loaded(hessian, missing)
    unheld = hypot(free_x, free_y)
    if unheld > 0.5 * (abs(missing.rotation) + abs(missing.x) + abs(missing.y)):
        x, y = free_x / unheld, free_y / unheld
        step = Motion(-(hessian.x * x + hessian.y * y) / max(hessian.loaded, 1.0), x, y)
    return step, missing.rotation * step.rotation + missing.x * step.x + missing.y * step.y


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
    interference: FloatArray, normal: FloatArray, force: FloatArray, places: Places, k: int, ahead: FloatArray
) -> tuple[int, Hessian]:
    """Balance a floating sleeve under unit torque and an external `force` (2), from and into place `k`.

    Returns the number of iterations, negative if the balance was not met, and the second derivatives at the balance.
    Leaves u_i in `ahead` (teeth). Eq. C9.
    """
    normal_x, normal_y = normal
    force_x, force_y = force
    change = np.empty(ahead.size)
    for i in range(ahead.size):
        ahead[i] = interference[i] - places.x[k] * normal_x[i] - places.y[k] * normal_y[i]
    _, places.rotation[k] = turn_to_torque(ahead, 1.0)
    for iteration in range(1, MAX_ITERATIONS + 1):
        held, hessian = add_up(ahead, normal)
        missing = Motion(1.0 - held.rotation, force_x - held.x, force_y - held.y)
        if abs(missing.rotation) + abs(missing.x) + abs(missing.y) < BALANCE_TOLERANCE:
            return iteration, hessian
        step, descent = next_step(hessian, missing)
        for i in range(ahead.size):
            change[i] = step.rotation - step.x * normal_x[i] - step.y * normal_y[i]
        length = length_to_lowest(ahead, change, -descent)
        if length >= LONGEST_STEP:
            break
        for i in range(ahead.size):
            ahead[i] += length * change[i]
        places.rotation[k] += length * step.rotation
        places.x[k] += length * step.x
        places.y[k] += length * step.y
    return -MAX_ITERATIONS, hessian


@kernel
def floating_rows(
    interference: FloatArray,
    normal: FloatArray,
    force: FloatArray,
    share: FloatArray,
    places: Places,
    iterations: IntArray,
) -> None:
    """Shares and places of a floating sleeve under `force` (rows, 2), each row started from the one before.

    A row without balance, its iterations negative, ends it: later rows stay untouched.
    """
    for row in range(interference.shape[0]):
        before = max(row - 1, 0)
        places.x[row], places.y[row] = places.x[before], places.y[before]
        iterations[row], _ = float_sleeve(interference[row], normal[row], force[row], places, row, share[row])
        for i in range(interference.shape[1]):
            share[row, i] = max(0.0, share[row, i])
        if iterations[row] < 0:
            break
