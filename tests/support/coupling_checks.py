"""Check what must hold for every gear coupling, on random couplings like those of users.

The tests and `benchmarks/search.py` run these checks. Every check in `CHECKS` draws one case from a random generator.
If the check fails, it raises AssertionError with the case.
"""

from collections.abc import Callable
from contextlib import AbstractContextManager
from math import hypot
from types import ModuleType
from unittest.mock import patch

import numpy as np
from numpy.random import Generator

from solvers.coupling import crowning, kinematics
from solvers.coupling.crowning import recommend
from solvers.coupling.inputs import CouplingInputs, RecommendationInputs
from solvers.coupling.model import solve
from solvers.coupling.orbit import solve_orbit
from solvers.coupling.results import CouplingResult
from solvers.errors import SolverError
from tests.support.changes import changed
from tests.support.couplings import random_inputs


def numbers(result: CouplingResult) -> dict[str, tuple[float, float]]:
    """Return each summary number and the scale of its permissible changes. The keys are the names of the numbers.

    If the scale is 0, changes are compared with the number itself. Thrust and moments are differences of much larger
    forces. Their scale is therefore the largest thrust or moment that friction could hold. The scale of the smallest
    tooth force is the mean tooth force.
    """
    limit = result.axial_thrust.coaxial_limit
    moment = limit * result.geometry.pitch_radius
    scales = {
        ("axial_thrust", "force"): limit,
        ("axial_thrust", "lower_bound"): limit,
        ("axial_thrust", "upper_bound"): limit,
        ("axial_thrust", "fraction_of_limit"): 1.0,
        ("losses", "friction_moment"): moment,
        ("losses", "hub_bending_moment"): moment,
        ("load_distribution", "min_tangential_force"): result.load_distribution.mean_tangential_force,
    }
    found = {}
    for group in ("load_distribution", "lubrication", "axial_thrust", "losses", "limits"):
        part = getattr(result, group)
        for name in part.__slots__:
            value = getattr(part, name)
            if type(value) is float:
                found[f"{group}.{name}"] = value, scales.get((group, name), 0.0)
    induced = result.axial_thrust.self_induced
    if induced is not None:
        found["self_induced.force"] = induced.force, limit
        found["self_induced.overturning_moment"] = induced.overturning_moment, moment
    return found


def check_power_and_moments(random: Generator) -> None:
    """Check the friction power, the bending moment on the hub, the torque, and the lateral force on the sleeve."""
    # The friction power is the power of the friction moment plus the power of the thrust. If the kinematics are
    # tangential, the bending moment follows from its two components. The tooth forces together transmit the torque. The
    # lateral forces of the teeth on a floating sleeve cancel.
    inputs = random_inputs(random)
    alone = changed(inputs, {"operation.arrangement": "single"})
    result, operation = solve(alone), inputs.operation
    losses = result.losses
    done = losses.friction_moment * abs(operation.speed * operation.misalignment)
    done += result.axial_thrust.force * operation.axial_velocity
    assert np.isclose(losses.friction_power, done, rtol=1e-9), inputs
    if inputs.model.kinematics == "tangential":
        about_pivot = losses.friction_moment - operation.torque * abs(operation.misalignment) / 2.0
        bending = hypot(about_pivot, losses.contact_shift_moment)
        assert np.isclose(losses.hub_bending_moment, bending, rtol=1e-9), inputs
    load = result.load_distribution
    force, angle = load.curves.tangential_force, load.curves.angle
    assert np.isclose(force.sum() * result.geometry.pitch_radius, operation.torque, rtol=1e-9), inputs
    if inputs.model.sleeve == "floating":
        radial = np.tan(inputs.coupling.pressure_angle)
        for lateral in (radial * np.cos(angle) - np.sin(angle), radial * np.sin(angle) + np.cos(angle)):
            assert abs(force @ lateral) < 1e-9 * force.sum(), inputs


def finer(module: ModuleType, factor: int, *names: str) -> AbstractContextManager[object]:
    """Return a patch that multiplies constants of a module; these constants are resolutions that no input sets."""
    return patch.multiple(module, **{name: factor * getattr(module, name) for name in names})


def check_resolution(random: Generator) -> None:
    check_resolution_of(random_inputs(random))


def check_resolution_of(inputs: CouplingInputs) -> None:
    """Check that no summary number changes by more than 1 % if every resolution is doubled."""
    # Thrust and moments are small sums of friction forces that nearly cancel. If teeth come under load and lift off,
    # the quadrature has an error of up to 6e-5 of the largest thrust or moment that friction could hold. This value
    # comes from 2600 random couplings; the error does not shrink with the thrust. Thrust and moments may therefore
    # change by 1 % plus 1e-4 of this limit.
    before = numbers(solve(inputs))
    with finer(kinematics, 2, "_PITCH_NODES", "_LEAST_ROTOR_POSITIONS"):
        after = numbers(solve(inputs))
    for name, (value, scale) in before.items():
        assert abs(after[name][0] - value) <= 0.01 * abs(value) + 1e-4 * scale, (name, value, after[name][0], inputs)


def check_orbit_resolution(random: Generator) -> None:
    check_orbit_resolution_of(random_inputs(random, errors=True))


def check_orbit_resolution_of(inputs: CouplingInputs) -> None:
    """Check that twice as many rotor angles hardly change the orbit of the sleeve."""
    # The largest displacement may change by 1 %, and a harmonic of the inertia force by 2 % of the largest harmonic. An
    # orbit that is not solved, or that has the notice `orbit_resolution`, is not checked.
    try:
        before = solve_orbit(inputs)
        with finer(kinematics, 2, "_LEAST_ROTOR_POSITIONS"):
            after = solve_orbit(inputs)
    except SolverError as refusal:
        if refusal.code not in {"sleeve_orbit", "torque_too_low"}:
            raise
        return
    if any(notice.code == "orbit_resolution" for notice in before.warnings):
        return
    assert abs(after.max_displacement - before.max_displacement) <= 0.01 * before.max_displacement + 1e-12, inputs
    largest = max(before.inertia_force.harmonics_x.max(), before.inertia_force.harmonics_y.max())
    for axis in ("harmonics_x", "harmonics_y"):
        moved = np.abs(getattr(after.inertia_force, axis) - getattr(before.inertia_force, axis)).max()
        assert moved <= 0.02 * largest + 1e-9, (axis, moved, largest, inputs)


def check_recommendation_resolution(random: Generator) -> None:
    """Check that twice as many crowning ratios give the same verdict, and the same load capacity within 1 %."""
    inputs = random_inputs(random)
    low = abs(inputs.operation.misalignment)
    wanted = RecommendationInputs(inputs, low, low * random.uniform(1.0, 3.0))
    before = recommend(wanted)
    counts = {name: 2 * getattr(crowning, name) - 1 for name in ("_SCAN_POINTS", "_WINDOW_POINTS")}
    with patch.multiple(crowning, **counts):
        after = recommend(wanted)
    assert before.feasible == after.feasible, inputs
    assert before.failed_constraint == after.failed_constraint, inputs
    if before.min_load_capacity_coefficient is not None and after.min_load_capacity_coefficient is not None:
        change = after.min_load_capacity_coefficient / before.min_load_capacity_coefficient - 1.0
        assert abs(change) < 0.01, (change, wanted)


SCANNED = {
    "coupling": ("face_width", "tooth_height", "pressure_angle", "crowning_ratio", "hub_distance", "tooth_stiffness"),
    "operation": ("torque", "speed", "misalignment", "axial_velocity"),
    "lubricant": ("viscosity", "reference_film"),
    "friction": ("coefficient",),
    "model": ("rotor_angle",),
}
HALVINGS = 16  # the narrowest ramp seen, of a tooth that lifts off, is 1/250 of a scan's step
EDGE = ("lubrication.", "axial_thrust.", "losses.", "self_induced.")
"""Names of numbers that depend on the oil film begin with one of these texts.

If the contact leaves the tooth, the film ends. These numbers then jump, unless the oil inlet has shrunk to zero.
"""


def varied(inputs: CouplingInputs, group: str, name: str, factor: float) -> CouplingInputs:
    """Return the inputs with one of them multiplied by `factor`.

    Every pitch deviation is multiplied by `factor`. The rotor angle is set to `factor` in radians.
    """
    value = getattr(getattr(inputs, group), name)
    if name == "pitch_errors":
        value = tuple(factor * error for error in value)
    else:
        value = factor if name == "rotor_angle" else factor * value
    return changed(inputs, {f"{group}.{name}": value})


def check_no_jump(random: Generator) -> None:
    """Check that no number jumps while one input is changed in small steps."""
    # A change is suspicious if it is more than ten times as large as the changes at the neighbouring steps. Such a
    # change must shrink to less than a tenth if the step is halved many times. Only numbers that depend on the oil film
    # may jump, and only if the contact leaves the tooth.
    inputs = random_inputs(random)
    choices = [(group, name) for group, names in SCANNED.items() for name in names]
    if inputs.coupling.pitch_errors is not None:
        choices.append(("coupling", "pitch_errors"))
    group, name = choices[random.integers(len(choices))]
    if name == "coefficient" and inputs.friction.coefficient is None:
        return
    wide = name in {"misalignment", "axial_velocity", "pitch_errors", "rotor_angle"}
    factors = np.linspace(-1.5, 1.5, 42) if wide else np.linspace(0.7, 1.3, 42)
    if name == "pressure_angle":
        factors = factors[factors * inputs.coupling.pressure_angle < 0.78]

    def at(factor: float) -> tuple[dict[str, tuple[float, float]], bool]:
        """Return all numbers of the mesh, and whether the contact stays on the tooth."""
        point = varied(inputs, group, name, factor)
        result = solve(point)
        return numbers(result), result.kinematics.max_contact_travel < point.coupling.face_width / 2.0

    scan = [at(float(factor)) for factor in factors]
    for key in scan[0][0]:
        values = np.array([point[0].get(key, (np.nan, 0.0))[0] for point in scan])
        change = np.abs(np.diff(values))
        rounding = 1e-8 * np.abs(values).max() + 1e-6 * scan[0][0][key][1]
        for place in map(int, np.flatnonzero(change > 1e-3 * np.ptp(values) + rounding)):
            around = np.delete(change[max(0, place - 3) : place + 4], min(place, 3))
            if change[place] <= 10.0 * around.max():
                continue
            steep = narrowed(at, key, (float(factors[place]), float(factors[place + 1])))
            assert steep is None or steep < 0.1 * change[place], (group, name, key, factors[place], inputs)


def narrowed(
    at: Callable[[float], tuple[dict[str, tuple[float, float]], bool]], key: str, interval: tuple[float, float]
) -> float | None:
    """Halve the interval many times, keep the half with the larger change, and return the change in the last half.

    Return None if the contact leaves the tooth in this last half, and the number depends on the oil film.
    """
    low, high = interval
    (at_low, on_low), (at_high, on_high) = at(low), at(high)
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        at_middle, on_middle = at(middle)
        if abs(at_middle[key][0] - at_low[key][0]) > abs(at_high[key][0] - at_middle[key][0]):
            high, at_high, on_high = middle, at_middle, on_middle
        else:
            low, at_low, on_low = middle, at_middle, on_middle
    if on_low != on_high and key.startswith(EDGE):
        return None
    return abs(at_high[key][0] - at_low[key][0])


CHECKS = (
    check_power_and_moments,
    check_resolution,
    check_orbit_resolution,
    check_recommendation_resolution,
    check_no_jump,
)
