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
    """Common rotation of the teeth and displacement (x, y) of the sleeve, or a torque and a lateral force (x, y)."""

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
    """Next psi > 0 of Newton's method for sum max(0, psi + w_i - w_max) = 1; `ahead` holds the leads w_i."""
    count, total = 0, 0.0
    for lead in ahead:
        behind = lead - highest
        if psi + behind > 0.0:
            count += 1
            total += behind
    return (1.0 - total) / count


@inner_kernel
def rotation_of_leads(ahead: FloatArray, highest: float, start: float) -> float:
    """Exact common rotation psi at which the teeth carry unit torque: sum max(0, psi + v_i) = 1 [T/(r_o c_t)] (Eq. C8).

    v_i is the lead minus the largest. The sum is convex and piecewise linear: the first Newton step leads to the root
    or beyond, each further step unloads at least one tooth. With v_i in descending order the root is psi_k = (1 -
    sum_1..k v_i)/k with the largest k for which psi_k + v_k > 0.
    """
    psi = _crossing(ahead, highest, start)
    following = _crossing(ahead, highest, psi)
    while following < psi:
        psi, following = following, _crossing(ahead, highest, following)
    return psi


@inner_kernel
def turn_to_torque(ahead: FloatArray, start: float) -> tuple[float, float]:
    """Replace the leads w_i by the interferences u_i under unit torque, in place; return the common rotation twice.

    The first counts from the contact of the tooth with the largest lead, and starts at `start`; the second is u_i -
    w_i.
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
    """Tooth forces and common rotation at each rotor angle, with a centred sleeve.

    A row of `ahead` holds the interferences at rest on entry and the forces on return; `rotation` receives the
    rotation. `unit` is T/(r_o c_t), `unit_force` T/r_o.
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

    Returns the motion and the (x, y) part of the force in directions without stiffness (fewer than three loaded teeth).
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
    """Newton step that adds the `missing` forces, and the rate at which the energy falls along it.

    If more than half of the missing force has no stiffness against it, the step follows that direction, without
    changing the forces of the loaded teeth.
    """
    step, free_x, free_y = solve_loaded(hessian, missing)
    unheld = hypot(free_x, free_y)
    if unheld > 0.5 * (abs(missing.rotation) + abs(missing.x) + abs(missing.y)):
        x, y = free_x / unheld, free_y / unheld
        step = Motion(-(hessian.x * x + hessian.y * y) / max(hessian.loaded, 1.0), x, y)
    return step, missing.rotation * step.rotation + missing.x * step.x + missing.y * step.y


@inner_kernel
def slope_along(ahead: FloatArray, change: FloatArray, start: float, length: float) -> tuple[float, float]:
    """First and second derivative of the energy at one length of a step, from its derivative `start` at length zero."""
    first, second = start, 0.0
    for i in range(ahead.size):
        u = ahead[i] + length * change[i]
        first += (max(0.0, u) - max(0.0, ahead[i])) * change[i]
        if u > 0.0:
            second += change[i] * change[i]
    return first, second


@inner_kernel
def length_to_lowest(ahead: FloatArray, change: FloatArray, start: float) -> float:
    """Length of a step of lowest energy, or LONGEST_STEP: safeguarded Newton on the piecewise linear derivative.

    If no tooth resists the motion at a length, the length is doubled.
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

    `normal` (2, teeth) is over cos(alpha) [-]; `force` (2,) in T/r_o. Returns the number of iterations, negative
    without balance, and the second derivatives of the energy.
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
    """Balance a floating sleeve in each row (rotor angle); write `share`, `places` and `iterations`.

    `force` (rows, 2) is external; the first entry of `places` holds the start value. A row without balance has a
    negative number of iterations, and the rows after it are not computed.
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
    """Largest of `values_at` at evenly spaced rotor angles [rad] and between them.

    With few loaded teeth peaks are narrower than a pitch, so local maxima are searched twice more finely, except those
    that would have to gain more than half of their height over the lower neighbour.
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
    """Lead of each tooth, its interference without rotation of the mesh and displacement of the sleeve [m] (Eq. C7)."""
    ahead = tangential_displacement(mesh, teeth)
    if coupling.pitch_errors is not None:
        ahead += coupling.pitch_errors
    return ahead


def elastic_rotation(coupling: Coupling, torque: float) -> float:
    """T/(r_o c_t) [m]: the rotation, at the pitch radius, if a single tooth carries the torque."""
    return torque / (pitch_radius(coupling) * coupling.tooth_stiffness)


def centred_loads(coupling: Coupling, mesh: MeshMotion, teeth: ToothPositions, torque: float) -> ToothLoads:
    """Tooth loads with a sleeve that is held centred on the hub; torque >= 0 (Eq. C7)."""
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
    """Tooth loads with a floating sleeve under an external force [N]; torque > 0 (Eq. C7).

    A row in which the teeth cannot hold the force has a negative number of iterations.
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
    """Tooth loads of one mesh without external force.

    Raises NoSolution (`sleeve_balance`) with the unbalanced lateral force over T/r_o.
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
    """Axial thrust if all teeth slide the same way: F_max = mu T/(r_o cos alpha) [N] (Eq. C20)."""
    return friction * torque / (pitch_radius(coupling) * cos(coupling.pressure_angle))


def allowable_misalignment(speed: float, radius: float) -> float | None:
    """Misalignment 0.12/(omega r_o) at the sliding velocity limit [rad]; None above 90 degrees (Eq. C29)."""
    rolling = abs(speed) * radius
    return SLIDING_VELOCITY_LIMIT / rolling if pi / 2 * rolling > SLIDING_VELOCITY_LIMIT else None


def sleeve_centring_torque(coupling: Coupling, radius: float) -> float:
    """Compute the torque above which all teeth stay loaded under the weight of a horizontal sleeve (Eq. C30)."""
    return 2.0 * coupling.sleeve_mass * GRAVITY * radius * cos(coupling.pressure_angle)


def unloading_misalignment(inputs: CouplingInputs, geometry: Geometry) -> float:
    """Misalignment delta_L at which the first tooth of a centred sleeve unloads [rad] (Eq. C10).

    There the peak-to-peak displacement, which grows with its square, is 2 F_m/c_t: tangential, sqrt(4 F_m/(c_t R_t)).
    """
    coupling, operation = inputs.coupling, inputs.operation
    mean_force = operation.torque / (geometry.pitch_radius * coupling.teeth)
    one_radian = mesh_motion(coupling, geometry, replace(operation, misalignment=1.0), inputs.model.kinematics)
    return sqrt(2.0 * mean_force / coupling.tooth_stiffness / displacement_peak_to_peak(one_radian))


def limits(inputs: CouplingInputs, geometry: Geometry) -> Limits:
    """Limits and stiffness of one mesh: torsional z c_t r_o^2, lateral z c_t/(2 cos^2 alpha) (Eq. C31)."""
    coupling, radius = inputs.coupling, geometry.pitch_radius
    all_teeth = coupling.teeth * coupling.tooth_stiffness
    return Limits(
        sliding_velocity_limit=SLIDING_VELOCITY_LIMIT,
        allowable_misalignment=allowable_misalignment(inputs.operation.speed, radius),
        sleeve_centring_torque=sleeve_centring_torque(coupling, radius),
        torsional_stiffness=all_teeth * radius**2,
        lateral_stiffness=all_teeth / (2.0 * cos(coupling.pressure_angle) ** 2),
    )
