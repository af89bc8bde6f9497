"""How the teeth of one mesh share the torque, and with a floating sleeve a lateral force (Figs 3 and 4).

Tooth i carries F_t = c_t max(0, psi + f_t + pitch deviation - e . n/cos(alpha)), for teeth never pull: psi is the
common rotation as a length at the pitch radius, e the sleeve's displacement against the hub.

Kernels count lengths in T/(r_o c_t) and forces in T/r_o, so that the tooth forces add up to one. There tooth i
interferes by u_i = psi + w_i - e . d_i: w_i is how far the tooth is ahead, d_i the flank normal over cos(alpha).

The sleeve minimises the convex energy sum max(0, u_i)^2/2 - psi - force . e, quadratic in pieces. Newton's steps are
minimised along exactly, so that the energy falls with each of them whatever the start: every sleeve that can be
balanced is. The u_i themselves are carried from step to step: formed anew from psi and e they would lose the digits
of a tooth force that is small against how far the teeth are ahead.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import atan2, cos, hypot, pi, sin, sqrt
from typing import NamedTuple

import numpy as np

from solvers.arrays import ROUNDING, FloatArray, IntArray, frozen
from solvers.compiled import kernel
from solvers.coupling.inputs import Coupling, CouplingInputs
from solvers.coupling.kinematics import (
    MeshMotion,
    ToothPositions,
    displacement_peak_to_peak,
    flank_normals,
    mesh_motion,
    pitch_radius,
    tangential_displacement,
    tooth_positions,
)
from solvers.coupling.results import Geometry, Limits, LoadCurves, LoadDistribution
from solvers.errors import NoSolution

MAX_ITERATIONS = 10_000  # limit that no balance should reach: each step lowers the energy
BALANCE_TOLERANCE = 1e-13  # in units of T/r_o: some hundred roundings
LONGEST_STEP = 1e100  # stands for infinity without overflow when it is squared
STIFF = 1e-12
"""Least stiffness of the sleeve that counts, over that of the loaded teeth together: rounding is some 1e-16 of it."""
FLAT = 1e-12
"""Slope along a step over the slope at its start that counts as none: the lowest energy is reached."""

LOADED = 1e-6
"""Tooth force over the mean one from which a tooth counts as loaded."""
SLIDING_VELOCITY_LIMIT = 0.12
"""Steady sliding of gear couplings [m/s], Tribology Handbook B4.6; transients may tilt 1.6 times as far."""
GRAVITY = 9.80665  # m/s^2, standard gravity (CGPM 1901)
_SEARCHES = 2  # chosen: searches, each around every sample whose neighbours may hide the highest
_FINER = 8  # chosen: steps of a search in one of the search before, so that two meet a peak within 1/128 of a step


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


def largest_value(angles: FloatArray, values_at: Callable[[FloatArray], FloatArray]) -> float:
    """Largest value over evenly spaced rotor angles [rad], searched twice more in steps eight times as fine.

    Each search is around the local maxima that may hide the largest value, were they to rise for half a step as they
    did before: between few loaded teeth a peak lasts but a fraction of a pitch, and each tooth has its own.
    `values_at` takes rotor angles (rows) and returns one value each.
    """
    coarse, step = values_at(angles), angles[1] - angles[0]
    places = angles[:, None] + step * np.array([-1.0, 0.0, 1.0])
    values = np.stack((np.roll(coarse, 1), coarse, np.roll(coarse, -1)), axis=1)
    largest = coarse.max()
    for _ in range(_SEARCHES):
        rows, highest = np.arange(len(values)), values[:, 1:-1].argmax(axis=1) + 1
        top, before, after = (values[rows, highest + shift] for shift in (0, -1, 1))
        reach = np.where((top >= before) & (top >= after), 1.5 * top - 0.5 * np.minimum(before, after), -np.inf)
        peaks = np.flatnonzero(reach >= largest)
        step /= _FINER
        places = places[peaks, highest[peaks]][:, None] + step * np.arange(-_FINER, _FINER + 1)
        values = values_at(places.ravel()).reshape(places.shape)
        largest = max(largest, values.max())
    return float(largest)


@dataclass(frozen=True, slots=True)
class ToothLoads:
    """Tooth loads of one mesh, one row a rotor angle.

    `tangential_force` (rows, teeth) [N], `rotation` (rows) and `displacement` (rows, 2) [m]; `iterations` (rows) is
    negative in the first row where the balance of a floating sleeve was not met; later rows then mean nothing.
    """

    tangential_force: FloatArray
    rotation: FloatArray
    displacement: FloatArray
    iterations: IntArray


def interference_at_rest(coupling: Coupling, mesh: MeshMotion, teeth: ToothPositions) -> FloatArray:
    """How far each tooth is ahead, f_t + pitch deviation [m], shape (rows, teeth) (Eq. C7)."""
    ahead = tangential_displacement(mesh, teeth)
    if coupling.pitch_errors is not None:
        ahead += coupling.pitch_errors
    return ahead


def elastic_rotation(coupling: Coupling, torque: float) -> float:
    """T/(r_o c_t) [m]: the rotation of a coupling with one tooth, as a length at the pitch radius."""
    return torque / (pitch_radius(coupling) * coupling.tooth_stiffness)


def centred_loads(coupling: Coupling, mesh: MeshMotion, teeth: ToothPositions, torque: float) -> ToothLoads:
    """Loads of a sleeve held centred on the hub: exact for any torque >= 0 (Eq. C7)."""
    ahead = interference_at_rest(coupling, mesh, teeth)
    rows = ahead.shape[0]
    displacement, iterations = np.zeros((rows, 2)), np.zeros(rows, dtype=np.int64)
    if torque == 0.0:
        return ToothLoads(np.zeros_like(ahead), -ahead.max(axis=1), displacement, iterations)
    unit, rotation = elastic_rotation(coupling, torque), np.empty(rows)
    centred_rows(ahead, unit, unit * coupling.tooth_stiffness, rotation)
    return ToothLoads(ahead, rotation, displacement, iterations)


def floating_loads(
    coupling: Coupling, mesh: MeshMotion, teeth: ToothPositions, torque: float, force: FloatArray
) -> ToothLoads:
    """Loads of a sleeve that finds its own place under an external `force` (rows, 2) [N], for torque > 0 (Eq. C7).

    Iterations are negative in a row without balance: the force exceeds what the torque's tooth forces can hold.
    """
    unit = elastic_rotation(coupling, torque)
    unit_force = unit * coupling.tooth_stiffness
    interference = interference_at_rest(coupling, mesh, teeth) / unit
    normal = flank_normals(mesh, teeth)
    rows = interference.shape[0]
    share, iterations = np.zeros_like(interference), np.zeros(rows, dtype=np.int64)
    places = Places(*np.zeros((3, rows)))
    floating_rows(interference, normal, force / unit_force, share, places, iterations)
    displacement = unit * np.stack((places.x, places.y), axis=1)
    return ToothLoads(unit_force * share, unit * places.rotation, displacement, iterations)


def mesh_loads(
    coupling: Coupling, mesh: MeshMotion, teeth: ToothPositions, torque: float, *, floating: bool
) -> ToothLoads:
    """Loads of one mesh without external force.

    Raises NoSolution `sleeve_balance` if a floating sleeve is not balanced (its lateral force over T/r_o).
    """
    if not floating or torque == 0.0:
        return centred_loads(coupling, mesh, teeth, torque)
    loads = floating_loads(coupling, mesh, teeth, torque, np.zeros((teeth.sine.shape[0], 2)))
    row = int(loads.iterations.argmin())
    if loads.iterations[row] < 0:
        lateral = flank_normals(mesh, teeth)[row] @ loads.tangential_force[row]
        residual = float(np.hypot(*lateral)) * pitch_radius(coupling) / torque
        raise NoSolution(
            "sleeve_balance",
            "the floating sleeve was not balanced; raise the torque or lower the pitch deviations",
            {"lateral_force": residual},
        )
    return loads


def load_distribution(inputs: CouplingInputs, geometry: Geometry, mesh: MeshMotion) -> LoadDistribution:
    """Share of each tooth in the torque, and the place the sleeve takes."""
    coupling, torque, rotor_angle = inputs.coupling, inputs.operation.torque, inputs.model.rotor_angle
    positions = tooth_positions(np.array([rotor_angle]), coupling.teeth)
    loads = mesh_loads(coupling, mesh, positions, torque, floating=inputs.model.sleeve == "floating")
    mean, largest = torque / (geometry.pitch_radius * coupling.teeth), float(loads.tangential_force.max())
    force = np.where(loads.tangential_force[0] < ROUNDING * largest, 0.0, loads.tangential_force[0])
    return LoadDistribution(
        mean_tangential_force=mean,
        max_tangential_force=largest,
        min_tangential_force=float(force.min()),
        max_normal_force=largest / cos(coupling.pressure_angle),
        load_concentration=largest / mean if mean > 0.0 else None,
        loaded_teeth=int(np.count_nonzero(force > LOADED * mean)),
        rotation=float(loads.rotation[0]),
        unloading_misalignment=unloading_misalignment(inputs, geometry),
        sleeve_displacement=(float(loads.displacement[0, 0]), float(loads.displacement[0, 1])),
        iterations=int(loads.iterations[0]),
        curves=LoadCurves(
            angle=frozen(rotor_angle + 2.0 * pi / coupling.teeth * np.arange(coupling.teeth)),
            tangential_force=frozen(force),
        ),
    )


def coaxial_limit(coupling: Coupling, torque: float, friction: float) -> float:
    """F_max = mu T/(r_o cos alpha) [N]: every tooth slides the same way (Eq. C20)."""
    return friction * torque / (pitch_radius(coupling) * cos(coupling.pressure_angle))


def allowable_misalignment(speed: float, radius: float) -> float | None:
    """Misalignment at the limit of sliding velocity, 0.12/(omega r_o) [rad]; None where no angle reaches it.

    Eq. C29.
    """
    rolling = abs(speed) * radius
    return SLIDING_VELOCITY_LIMIT / rolling if pi / 2 * rolling > SLIDING_VELOCITY_LIMIT else None


def sleeve_centring_torque(coupling: Coupling, radius: float) -> float:
    """Torque that holds a horizontal sleeve of weight W a mesh with every tooth loaded, 2 W r_o cos(alpha) [N m].

    Eq. C30.
    """
    return 2.0 * coupling.sleeve_mass * GRAVITY * radius * cos(coupling.pressure_angle)


def unloading_misalignment(inputs: CouplingInputs, geometry: Geometry) -> float:
    """Misalignment [rad] at which the first tooth of a centred sleeve unloads, pitch deviations ignored (Eq. C10).

    There the peak-to-peak displacement, a square of the misalignment, reaches 2 F_m/c_t with F_m the mean tooth force:
    delta_L = sqrt(4 F_m/(c_t R_t)) with the tangential kinematics.
    """
    coupling, operation = inputs.coupling, inputs.operation
    mean_force = operation.torque / (geometry.pitch_radius * coupling.teeth)
    one_radian = mesh_motion(coupling, geometry, replace(operation, misalignment=1.0), inputs.model.kinematics)
    return sqrt(2.0 * mean_force / coupling.tooth_stiffness / displacement_peak_to_peak(one_radian))


def limits(inputs: CouplingInputs, geometry: Geometry) -> Limits:
    """Limits and the stiffness of one mesh: z c_t r_o^2 in torsion, z c_t/(2 cos^2 alpha) laterally (Eq. C31)."""
    coupling, radius = inputs.coupling, geometry.pitch_radius
    all_teeth = coupling.teeth * coupling.tooth_stiffness
    return Limits(
        sliding_velocity_limit=SLIDING_VELOCITY_LIMIT,
        allowable_misalignment=allowable_misalignment(inputs.operation.speed, radius),
        sleeve_centring_torque=sleeve_centring_torque(coupling, radius),
        torsional_stiffness=all_teeth * radius**2,
        lateral_stiffness=all_teeth / (2.0 * cos(coupling.pressure_angle) ** 2),
    )
