"""Distribution of the torque over the teeth of one mesh (Figs 3, 4); a floating sleeve may also carry a lateral force.

Tooth i carries F_t = c_t max(0, psi + f_t + pitch deviation - e . n/cos(alpha)); the maximum is taken because teeth
never pull. Here psi is the common rotation as a length at the pitch radius, f_t is the tangential displacement of the
tooth, e is the displacement of the sleeve relative to the hub, and n is the flank normal.

In the kernels, lengths are in T/(r_o c_t) and forces in T/r_o, so that the tooth forces add up to one. The interference
of tooth i is u_i = psi + w_i - e . d_i, where w_i is the lead of the tooth and d_i is its flank normal divided by
cos(alpha).

In equilibrium, psi and e minimise the convex energy sum max(0, u_i)^2/2 - psi - force . e, which is piecewise
quadratic. Each Newton step ends where the energy along the step is lowest. The energy therefore falls in each step from
any start, and every sleeve that can be balanced is balanced. The u_i are updated from step to step, because a
calculation from psi and e would lose the digits of tooth forces that are small compared with the leads.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import atan2, cos, hypot, pi, sin, sqrt
from typing import NamedTuple

import numpy as np

from solvers.arrays import ROUNDING, FloatArray, IntArray, frozen
from solvers.compiled import inner_kernel, kernel
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

MAX_ITERATIONS = 10_000  # limit; no balance should reach this limit, because each step lowers the energy
BALANCE_TOLERANCE = 1e-13  # in units of T/r_o; a few hundred rounding errors
LONGEST_STEP = 1e100  # stands for infinity; the square of this number does not overflow
STIFF = 1e-12
"""Largest lateral stiffness of the sleeve that is treated as zero, divided by the stiffness of the loaded teeth.

Rounding errors of this ratio are about 1e-16.
"""
FLAT = 1e-12
"""Largest slope of the energy along a step that is treated as zero, divided by the slope at the start of the step."""

LOADED = 1e-6
"""Smallest ratio of a tooth's force to the mean tooth force at which the tooth counts as loaded."""
SLIDING_VELOCITY_LIMIT = 0.12
"""Limit of the sliding velocity in gear couplings [m/s] (Tribology Handbook B4.6).

For a short time, a misalignment may be 1.6 times the misalignment at which the sliding velocity reaches this limit.
"""
GRAVITY = 9.80665  # m/s^2, standard gravity (CGPM 1901)
_SEARCHES = 2  # chosen: number of searches around the samples near which the highest value may lie
_FINER = 8  # chosen: ratio of the steps of successive searches; two searches locate a peak to 1/128 of the first step


class Motion(NamedTuple):
    """A rotation and a displacement (x, y), or a torque and a lateral force (x, y).

    The rotation is the common rotation of the teeth. The displacement is that of the sleeve.
    """

    rotation: float
    x: float
    y: float


class Places(NamedTuple):
    """Rotation psi and sleeve displacement (e_x, e_y) of balanced meshes, one array per component."""

    rotation: FloatArray
    x: FloatArray
    y: FloatArray


class Hessian(NamedTuple):
    """Second derivatives of the energy: sums of 1, -d_x, -d_y, d_x^2, d_x d_y and d_y^2 over the loaded teeth."""

    loaded: float
    x: float
    y: float
    xx: float
    xy: float
    yy: float


@inner_kernel
def _crossing(ahead: FloatArray, highest: float, psi: float) -> float:
    """Return the next rotation psi in Newton's method for the equation sum max(0, psi + w_i - w_max) = 1.

    `ahead` holds the lead w_i of each tooth, `highest` is the largest lead w_max, and `psi` is the present rotation,
    which is positive.
    """
    count, total = 0, 0.0
    for lead in ahead:
        behind = lead - highest
        if psi + behind > 0.0:
            count += 1
            total += behind
    return (1.0 - total) / count


@inner_kernel
def rotation_of_leads(ahead: FloatArray, highest: float, start: float) -> float:
    """Find the exact common rotation psi at which the teeth carry unit torque [T/(r_o c_t)].

    Eq. C8: sum max(0, psi + v_i) = 1, where v_i is the lead w_i minus the largest of all leads. The sum is a convex and
    piecewise linear function of psi. From any positive start, the first step of Newton's method leads to the root or to
    a larger value. Each further step reduces psi and unloads at least one tooth, until the linear piece that contains
    the root is reached. Sorting would give the same result. If the v_i are sorted in descending order and only the
    first k teeth are loaded, the rotation is psi_k = (1 - sum_1..k v_i)/k. The root is the psi_k with the largest k for
    which psi_k + v_k is positive.
    """
    psi = _crossing(ahead, highest, start)
    following = _crossing(ahead, highest, psi)
    while following < psi:
        psi, following = following, _crossing(ahead, highest, following)
    return psi


@inner_kernel
def turn_to_torque(ahead: FloatArray, start: float) -> tuple[float, float]:
    """Replace the lead w_i of each tooth by its interference u_i under unit torque, in place.

    The lead of a tooth is the length by which the tooth is ahead. Returns the common rotation of the teeth twice. The
    first value is counted from the rotation at which the tooth with the largest lead makes contact. The second value is
    counted from zero and equals u_i - w_i for all teeth. The iteration for the first value starts from `start`.
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
    """Compute the tooth forces and the common rotation of the teeth at each rotor angle, with a centred sleeve.

    A row of `ahead` belongs to one rotor angle. On entry, `ahead` contains the interference at rest w_i of each tooth.
    On return, `ahead` contains the force of each tooth, and `rotation` contains the common rotation of the teeth at
    each rotor angle. `unit` = T/(r_o c_t) is the scale of lengths, and `unit_force` = T/r_o is the scale of forces.
    """
    psi = 1.0
    for row in range(ahead.shape[0]):
        for i in range(ahead.shape[1]):
            ahead[row, i] /= unit
        psi, turned = turn_to_torque(ahead[row], psi)
        rotation[row] = unit * turned
        for i in range(ahead.shape[1]):
            ahead[row, i] = unit_force * max(0.0, ahead[row, i])


@inner_kernel
def add_up(ahead: FloatArray, normal: FloatArray) -> tuple[Motion, Hessian]:
    """Compute the torque and the lateral force of the loaded teeth, and the second derivatives of the energy."""
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


@inner_kernel
def solve_loaded(hessian: Hessian, right: Motion) -> tuple[Motion, float, float]:
    """Solve `hessian` times motion = `right` in the directions in which the loaded teeth have stiffness.

    If fewer than three teeth are loaded, the teeth do not resist a displacement of the sleeve in one direction, or in
    any direction. The motion has no component in such a direction. Returns the motion, and the x and y components of
    that part of the lateral force which acts in directions without stiffness.
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


@inner_kernel
def next_step(hessian: Hessian, missing: Motion) -> tuple[Motion, float]:
    """Return the Newton step that adds the `missing` forces, and the rate at which the energy falls along this step.

    If more than half of the missing force acts in a direction in which the loaded teeth have no stiffness, the step
    follows this direction instead. Such a step does not change the forces of the loaded teeth.
    """
    step, free_x, free_y = solve_loaded(hessian, missing)
    unheld = hypot(free_x, free_y)
    if unheld > 0.5 * (abs(missing.rotation) + abs(missing.x) + abs(missing.y)):
        x, y = free_x / unheld, free_y / unheld
        step = Motion(-(hessian.x * x + hessian.y * y) / max(hessian.loaded, 1.0), x, y)
    return step, missing.rotation * step.rotation + missing.x * step.x + missing.y * step.y


@inner_kernel
def slope_along(ahead: FloatArray, change: FloatArray, start: float, length: float) -> tuple[float, float]:
    """Compute the first and the second derivative of the energy along a step, at one length of the step.

    The energy is differentiated with respect to the length. `ahead` holds the interferences u_i of the teeth at length
    zero, and `start` is the first derivative at length zero. A step of length 1 changes the interferences by `change`.
    """
    first, second = start, 0.0
    for i in range(ahead.size):
        u = ahead[i] + length * change[i]
        first += (max(0.0, u) - max(0.0, ahead[i])) * change[i]
        if u > 0.0:
            second += change[i] * change[i]
    return first, second


@inner_kernel
def length_to_lowest(ahead: FloatArray, change: FloatArray, start: float) -> float:
    """Find the length of a step at which the energy is lowest.

    If the energy has no minimum, the result is LONGEST_STEP. The derivative of the energy has the negative value
    `start` at length zero, and rises piecewise linearly with the length. Newton's method, safeguarded by a bracket,
    finds the length at which the derivative is zero. If no tooth resists the motion at a length, the length is doubled.
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


@inner_kernel
def float_sleeve(
    interference: FloatArray, normal: FloatArray, force: FloatArray, places: Places, k: int, ahead: FloatArray
) -> tuple[int, Hessian]:
    """Balance a floating sleeve under unit torque and an external force, in place (Eq. C9).

    `normal`: flank normals divided by cos(alpha), shape (2, teeth) [-]; `force`: external force on the sleeve, shape
    (2,) [T/r_o]. Returns `iterations`: number of iterations; negative if the balance was not reached [-]; `hessian`:
    second derivatives of the energy at the balance [-].
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
    """Balance a floating sleeve in each row, and write the results to `share`, `places` and `iterations`.

    A row belongs to one rotor angle. `force` (rows, 2) is the external force on the sleeve. `share` receives the tooth
    forces, and `places` receives the rotation and the displacement of the sleeve. On entry, the first entry of `places`
    holds the start value of the displacement. If a row has no balance, its number of iterations is negative, and the
    later rows are not computed.
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
    """Find the largest value at evenly spaced rotor angles [rad] and between these angles.

    `values_at` takes rotor angles and returns one value per angle. Each tooth causes its own peak. If few teeth are
    loaded, such a peak is narrower than a pitch and may lie between the given angles. Two searches with finer steps
    therefore look for larger values near the local maxima. A local maximum is skipped if it is too low: a finer search
    is expected to add at most half of the difference between the local maximum and the lower neighbouring value.
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
        if not peaks.size:
            break
        step /= _FINER
        places = places[peaks, highest[peaks]][:, None] + step * np.arange(-_FINER, _FINER + 1)
        values = values_at(places.ravel()).reshape(places.shape)
        largest = max(largest, values.max())
    return float(largest)


@dataclass(frozen=True, slots=True)
class ToothLoads:
    """Tooth loads of one mesh, one row per rotor angle.

    `tangential_force` has the shape (rows, teeth) [N], `rotation` (rows) [m] and `displacement` (rows, 2) [m].
    `iterations` (rows) is negative in the first row in which the floating sleeve was not balanced; later rows have no
    meaning.
    """

    tangential_force: FloatArray
    rotation: FloatArray
    displacement: FloatArray
    iterations: IntArray


def interference_at_rest(coupling: Coupling, mesh: MeshMotion, teeth: ToothPositions) -> FloatArray:
    """Compute the lead of each tooth, which is the length by which the tooth is ahead [m] (Eq. C7).

    The lead equals the interference of the tooth if the mesh is not rotated and the sleeve is not displaced.
    """
    ahead = tangential_displacement(mesh, teeth)
    if coupling.pitch_errors is not None:
        ahead += coupling.pitch_errors
    return ahead


def elastic_rotation(coupling: Coupling, torque: float) -> float:
    """Return T/(r_o c_t) [m].

    This is the rotation, as a length at the pitch radius, if a single tooth carries the torque.
    """
    return torque / (pitch_radius(coupling) * coupling.tooth_stiffness)


def centred_loads(coupling: Coupling, mesh: MeshMotion, teeth: ToothPositions, torque: float) -> ToothLoads:
    """Compute the tooth loads with a sleeve that is held centred on the hub (Eq. C7).

    `torque`: torque, not negative [N m].
    """
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
    """Compute the tooth loads with a floating sleeve under an external force [N] (Eq. C7).

    The number of iterations is negative in a row without balance. In such a row the external force exceeds the lateral
    force that the teeth can hold at this torque. `torque`: torque, positive [N m].
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
    """Compute the tooth loads of one mesh without external force.

    Raises NoSolution (`sleeve_balance`) if a floating sleeve cannot be balanced. The residual in NoSolution is the
    lateral force of the teeth on the sleeve, divided by T/r_o.
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
            "no equilibrium of the floating sleeve was found; raise the torque or lower the pitch deviations",
            {"lateral_force": residual},
        )
    return loads


def load_distribution(inputs: CouplingInputs, geometry: Geometry, mesh: MeshMotion) -> LoadDistribution:
    """Compute how the teeth share the torque, and how far the sleeve is displaced."""
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
    """Compute the axial thrust that arises if all teeth slide in the same direction [N] (Eq. C20)."""
    return friction * torque / (pitch_radius(coupling) * cos(coupling.pressure_angle))


def allowable_misalignment(speed: float, radius: float) -> float | None:
    """Compute the misalignment at which the sliding velocity reaches its limit (Eq. C29).

    Returns misalignment 0.12/(omega r_o) [rad]; None if no angle up to 90 degrees reaches the limit.
    """
    rolling = abs(speed) * radius
    return SLIDING_VELOCITY_LIMIT / rolling if pi / 2 * rolling > SLIDING_VELOCITY_LIMIT else None


def sleeve_centring_torque(coupling: Coupling, radius: float) -> float:
    """Compute the torque above which all teeth stay loaded under the weight of a horizontal sleeve (Eq. C30)."""
    return 2.0 * coupling.sleeve_mass * GRAVITY * radius * cos(coupling.pressure_angle)


def unloading_misalignment(inputs: CouplingInputs, geometry: Geometry) -> float:
    """Compute the misalignment at which the first tooth of a centred sleeve unloads [rad] (Eq. C10).

    The peak-to-peak tangential displacement grows with the square of the misalignment. At delta_L this displacement
    reaches 2 F_m/c_t, where F_m is the mean tooth force. With tangential kinematics delta_L = sqrt(4 F_m/(c_t R_t)).
    """
    coupling, operation = inputs.coupling, inputs.operation
    mean_force = operation.torque / (geometry.pitch_radius * coupling.teeth)
    one_radian = mesh_motion(coupling, geometry, replace(operation, misalignment=1.0), inputs.model.kinematics)
    return sqrt(2.0 * mean_force / coupling.tooth_stiffness / displacement_peak_to_peak(one_radian))


def limits(inputs: CouplingInputs, geometry: Geometry) -> Limits:
    """Compute the limits and the stiffness of one mesh (Eq. C31).

    The torsional stiffness is z c_t r_o^2, and the lateral stiffness is z c_t/(2 cos^2 alpha).
    """
    coupling, radius = inputs.coupling, geometry.pitch_radius
    all_teeth = coupling.teeth * coupling.tooth_stiffness
    return Limits(
        sliding_velocity_limit=SLIDING_VELOCITY_LIMIT,
        allowable_misalignment=allowable_misalignment(inputs.operation.speed, radius),
        sleeve_centring_torque=sleeve_centring_torque(coupling, radius),
        torsional_stiffness=all_teeth * radius**2,
        lateral_stiffness=all_teeth / (2.0 * cos(coupling.pressure_angle) ** 2),
    )
