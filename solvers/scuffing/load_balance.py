"""Load balance over the contact lines: the approach TE of the flanks at each roll position, and the loads it leaves.

Each line is cut into slices at whose middles w = k max(TE - Delta, 0) is summed (Eq. 9 with one TE for all points of a
roll position, slices dl = dy / cos beta_b, and w per length of contact line, so that the sum is F_bn). The paper's
iteration (Eq. 10) converges only while the mean relief in contact stays below TE/2; here F(TE), which is convex and
increasing, is solved by Newton steps. With linear contact these end exactly after finitely many.
"""

from dataclasses import dataclass

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.errors import NoSolution
from solvers.gears.path_of_contact import ContactPlane
from solvers.scuffing.contact_lines import RollPositions, line_count
from solvers.scuffing.contact_slices import (
    CONSTANT,
    GAP,
    LENGTH,
    LIMIT,
    LOAD,
    OMEGA,
    ROWS,
    Mesh,
    gather,
    load_at,
)
from solvers.scuffing.line_survey import Survey, empty_survey, survey_ends, survey_slices
from solvers.scuffing.tooth_stiffness import line_load

MAX_STEPS = 60
LEAST_OMEGA = 2.0  # of the start, whose compliance must stay positive
ROUNDING = 1e-14  # relative force at which Newton has nothing left to gain
NEAR_ROUNDING = 1e-12
TOLERANCE = 1e-10  # relative force above which there is no solution


@dataclass(frozen=True, slots=True)
class LoadBalance:
    """Loaded state of a mesh over one base pitch; arrays over the roll positions.

    transmission_error and unloaded_error (least gap over the lines), both along the transverse line of action [m];
    residual of the balance relative to the force [N]; steps of the iteration.
    """

    mesh: Mesh
    rolls: RollPositions
    force: float
    transmission_error: FloatArray
    unloaded_error: FloatArray
    residual: FloatArray
    steps: FloatArray
    survey: Survey


def balance_load(mesh: Mesh, rolls: RollPositions, force: float, slices: int) -> LoadBalance:
    """TE over the roll positions under the force [N]; without a force, the kinematic error.

    Raises NoSolution load_balance if the iteration ends short of the force.
    """
    error, unloaded, residual, steps, survey = _balance(mesh, rolls.phase, rolls.side, force, slices)
    worst = float(np.max(residual))
    if not worst <= TOLERANCE:
        raise NoSolution("load_balance", "the load balance did not converge", {"relative_force": worst})
    return LoadBalance(mesh, rolls, force, error, unloaded, residual, steps, survey)


@kernel
def _secant_start(table: FloatArray, count: int, logarithmic: float, force: float) -> float:
    """Exact TE of the linear problem; half-spaces take their secant compliance at the mean load, and keep its omega.

    All slices pressed to a common TE, pulling included, reach the force to the right of the root of the convex F(TE);
    Newton's steps descend from there through ever smaller contact sets.
    """
    log_mean = 0.0
    if logarithmic > 0.0:
        total = 0.0
        for i in range(count):
            total += table[LENGTH, i]
        log_mean = np.log(force / total)
        for i in range(count):
            table[OMEGA, i] = max(table[CONSTANT, i] / logarithmic - log_mean, LEAST_OMEGA)
    error = np.inf
    for _ in range(MAX_STEPS):
        stiffness, moment = 0.0, 0.0
        for i in range(count):
            if table[GAP, i] < error:
                compliance = logarithmic * table[OMEGA, i] if logarithmic > 0.0 else table[CONSTANT, i]
                stiffness += table[LENGTH, i] / compliance
                moment += table[LENGTH, i] / compliance * table[GAP, i]
        following = (force + moment) / stiffness
        if following >= error:
            break
        error = following
    return error


@kernel
def _press(table: FloatArray, count: int, logarithmic: float, error: float) -> tuple[float, float]:
    """Force [N] at an approach [m] and its derivative [N/m]; notes each slice's load and omega."""
    force, slope = 0.0, 0.0
    for i in range(count):
        load, stiffness, table[OMEGA, i] = line_load(
            error - table[GAP, i], table[CONSTANT, i], logarithmic, table[LIMIT, i], table[OMEGA, i]
        )
        table[LOAD, i] = load
        force += load * table[LENGTH, i]
        slope += stiffness * table[LENGTH, i]
    return force, slope


@kernel
def newton(table: FloatArray, count: int, logarithmic: float, force: float, error: float) -> tuple[float, float, float]:
    """TE [m] from a start, relative residual and steps at one roll position; loads and omegas stay in the table."""
    residual, steps = np.inf, 0.0
    while steps < MAX_STEPS:
        carried, slope = _press(table, count, logarithmic, error)
        steps += 1.0
        before, residual = residual, abs(carried - force) / force
        if residual <= ROUNDING or (residual <= NEAR_ROUNDING and residual >= before):
            break
        error -= (carried - force) / slope
    return error, residual, steps


@kernel
def solve_position(table: FloatArray, count: int, logarithmic: float, force: float) -> tuple[float, float, float]:
    """TE [m], relative residual and steps at one roll position, without a start."""
    return newton(table, count, logarithmic, force, _secant_start(table, count, logarithmic, force))


@kernel
def _balance(
    mesh: Mesh, phase: FloatArray, side: FloatArray, force: float, slices: int
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, Survey]:
    """TE, least gap, residual and steps at each roll position, and the survey of the loaded lines."""
    error, unloaded = np.empty(phase.size), np.empty(phase.size)
    residual, steps = np.zeros(phase.size), np.zeros(phase.size)
    survey = empty_survey(mesh, phase.size)
    table = np.zeros((ROWS, line_count(mesh.plane) * slices))
    for i in range(phase.size):
        count, unloaded[i] = gather(mesh, phase[i], side[i], slices, table)
        error[i] = unloaded[i]
        if force > 0.0:
            error[i], residual[i], steps[i] = solve_position(table, count, mesh.compliance.logarithmic, force)
        survey_slices(mesh, table, count, error[i], survey, i)
        survey_ends(mesh, phase[i], side[i], error[i], survey, i)
    return error, unloaded, residual, steps, survey


@kernel
def _error_at(plane: ContactPlane, phase: FloatArray, error: FloatArray, x: float, y: float) -> float:
    """TE at the roll position whose line passes through (x, y).

    The end of the path belongs to the roll position that leaves it, not to the next.
    """
    inside = min(x, plane.path_length * (1.0 - 1e-9))
    position = (inside + y * plane.tan_base_helix) % plane.base_pitch
    index = min(max(int(np.searchsorted(phase, position, side="right")) - 1, 0), phase.size - 2)
    fraction = (position - phase[index]) / (phase[index + 1] - phase[index])
    return float(error[index] + fraction * (error[index + 1] - error[index]))


@kernel
def _line_loads(mesh: Mesh, phase: FloatArray, error: FloatArray, x: FloatArray, y: FloatArray) -> FloatArray:
    loads, omega = np.empty(x.size), 0.0
    for i in range(x.size):
        local = _error_at(mesh.plane, phase, error, x[i], y[i])
        loads[i], omega = load_at(mesh, local, x[i], y[i], omega)
    return loads


def line_loads(balance: LoadBalance, x: FloatArray, y: FloatArray) -> FloatArray:
    """Line load w [N/m] at points (x, y) of the plane, arrays of one shape; 0 where the flanks stand apart."""
    if balance.force == 0.0:
        return np.zeros(np.shape(x))
    loads = _line_loads(
        balance.mesh,
        balance.rolls.phase,
        balance.transmission_error,
        np.ravel(x).astype(float),
        np.ravel(y).astype(float),
    )
    return loads.reshape(np.shape(x))
