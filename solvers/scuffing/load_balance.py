"""Load balance over the contact lines: the transmission error TE at every roll position, and the loads at this TE.

Every line is cut into slices of the length dl = dy / cos beta_b with the line load w = k max(TE - Delta, 0) at the
middle, where k is the stiffness of a pair of teeth and Delta the gap. The sum of w dl is F_bn (Eq. 9 with one TE for
all points of a roll position).

Only the loaded part of a line is cut. It depends on TE, so cutting and balance are repeated until TE stays. Where TE is
not linear between two roll positions, more are added.

The paper's iteration (Eq. 10) converges only if the mean relief in contact is below TE/2. F(TE) is convex and
increasing, so Newton's method always converges, with linear contact in a finite number of steps.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from solvers.arrays import FloatArray, IntArray, copy
from solvers.compiled import inner_kernel, kernel
from solvers.errors import NoSolution
from solvers.gears.pair import ContactPlane
from solvers.scuffing.contact_lines import RollPositions
from solvers.scuffing.contact_slices import (
    Cover,
    Mesh,
    Slices,
    Survey,
    empty_survey,
    gather,
    load_under,
    slice_table,
    survey_ends,
    survey_slices,
)
from solvers.scuffing.modification import gap_at
from solvers.scuffing.tooth_stiffness import LEAST_OMEGA, line_load_near

MAX_STEPS = 60  # largest number of Newton steps; if more steps were needed, the iteration would never converge
ROUNDING = 1e-14  # relative residual of the force, below which a Newton step gains nothing
NEAR_ROUNDING = 1e-12  # relative residual of the force that is accepted if a step does not reduce the residual
TOLERANCE = 1e-10  # largest relative residual of the force in a solution
MAX_COVERS = 20  # number of times that the lines of one roll position are cut into slices
SETTLED = 1e-6  # relative change of the approach; if two covers differ by less, the last cover is accepted
STRAIGHT = 2e-3  # share of the approach; TE is linear if it deviates less from the line between its neighbours
MAX_HALVINGS = 8  # largest number of times that a step between roll positions is halved
MOST_ADDED = 1000  # largest number of roll positions that are added per halving
LEAST_LINE_LOAD = 0.1  # N/m, mean line load; at lower loads the approach is as small as the rounding errors of gaps
LEAST_SPREAD = 1e-12  # m; a smaller range of the kinematic error is replaced by this value
BESIDE = 1e-12  # distance between a load jump and the points just before and behind the jump, as share of the path


Start = tuple[FloatArray, FloatArray]
"""TE [m] at every roll position, and ln w (w in N/m) of every slice at every roll position."""


@inner_kernel
def _secant_start(table: Slices, count: int, logarithmic: float, force: float) -> float:
    """Start value of TE [m] by linear compliances, secant ones at the mean line load if "hertzian".

    The first step lets slices pull, so TE is too large; every further step reduces it and the slices in contact.
    """
    log_mean = 0.0
    if logarithmic > 0.0:
        total = 0.0
        for i in range(count):
            total += table.length[i]
        log_mean = np.log(force / total)
        for i in range(count):
            table.log_load[i] = log_mean
    error = np.inf
    for _ in range(MAX_STEPS):
        stiffness, moment = 0.0, 0.0
        for i in range(count):
            if table.gap[i] < error:
                compliance = max(table.constant[i] - logarithmic * log_mean, logarithmic * LEAST_OMEGA)
                stiffness += table.length[i] / compliance
                moment += table.length[i] / compliance * table.gap[i]
        following = (force + moment) / stiffness
        if following >= error:
            break
        error = following
    return error


@inner_kernel
def _press(table: Slices, count: int, logarithmic: float, error: float) -> tuple[float, float, float, float]:
    """One iteration step of every slice's load at TE `error` [m].

    Returns force [N], its derivative [N/m], its inaccuracy [N] and the distance [m] from the nearest kink, where a
    slice comes into contact or its compliance begins to be held.
    """
    force, slope, unsettled, nearest = 0.0, 0.0, 0.0, np.inf
    for i in range(count):
        approach, length = error - table.gap[i], table.length[i]
        load, stiffness, log_load, step = line_load_near(
            approach, table.constant[i], logarithmic, table.limit[i], table.log_load[i]
        )
        table.load[i], table.stiffness[i], table.log_load[i] = load, stiffness, log_load
        force += load * length
        slope += stiffness * length
        unsettled += load * length * (step * step) ** 2
        nearest = min(nearest, abs(approach))
        if logarithmic > 0.0:
            nearest = min(nearest, abs(table.limit[i] - approach))
    return force, slope, unsettled, nearest


@inner_kernel
def _follow(table: Slices, count: int, change: float) -> float:
    """Change the load of every slice by its derivative times `change` [m] of TE; return the force [N]."""
    force = 0.0
    for i in range(count):
        table.load[i] += table.stiffness[i] * change
        force += table.load[i] * table.length[i]
    return force


@inner_kernel
def newton(table: Slices, count: int, logarithmic: float, force: float, error: float) -> tuple[float, float, float]:
    """Solve the balance of one roll position from a start value; return TE [m], residual and steps (Eq. L13).

    After every step of TE each load takes one step of its own. A step that crosses no kink is the last one if the
    square of the residual before is below rounding (linear contact: always); loads then follow by their derivatives.
    """
    residual, steps = np.inf, 0.0
    while steps < MAX_STEPS:
        carried, slope, unsettled, nearest = _press(table, count, logarithmic, error)
        steps += 1.0
        before, residual = residual, (abs(carried - force) + unsettled) / force
        if slope == 0.0 or residual <= ROUNDING or (residual <= NEAR_ROUNDING and residual >= before):
            break
        change = (force - carried) / slope
        error += change
        bend = residual**2 if logarithmic > 0.0 else 0.0
        if abs(change) < nearest and bend + unsettled / force <= ROUNDING:
            return error, abs(_follow(table, count, change) - force) / force + bend + unsettled / force, steps
    return error, residual, steps


@inner_kernel
def solve_position(table: Slices, count: int, logarithmic: float, force: float) -> tuple[float, float, float]:
    """Solve the balance of one roll position without start values; return the values that `newton` returns."""
    return newton(table, count, logarithmic, force, _secant_start(table, count, logarithmic, force))


@inner_kernel
def solve_near(table: Slices, count: int, logarithmic: float, force: float, error: float) -> tuple[float, float, float]:
    """`newton` from TE and ln w of a similar position; without start values if `error` is NaN or that fails."""
    if not np.isnan(error):
        error, residual, steps = newton(table, count, logarithmic, force, error)
        if residual <= TOLERANCE:
            return error, residual, steps
    return solve_position(table, count, logarithmic, force)


@dataclass(frozen=True, slots=True)
class LoadBalance:
    """Loaded state of a mesh over one base pitch; arrays over the roll positions.

    `force` [N] is that of all lines. `transmission_error` and `unloaded_error` (the least gap) are along the transverse
    line of action [m]; `residual` is relative; `bent_steps` counts steps over which TE is still not linear.
    """

    mesh: Mesh
    rolls: RollPositions
    force: float
    transmission_error: FloatArray
    unloaded_error: FloatArray
    residual: FloatArray
    steps: FloatArray
    survey: Survey
    bent_steps: int = 0


def balance_load(
    mesh: Mesh, rolls: RollPositions, force: float, slices: int, start: Start | None = None
) -> LoadBalance:
    """Balance the load at the given roll positions, and at further roll positions where TE is not linear (Eq. 9).

    Raises NoSolution: `load_balance` if the iteration does not reach the force.
    """
    if force < LEAST_LINE_LOAD * mesh.plane.face_width:
        force = 0.0
    balance = _balanced(mesh, rolls, force, slices, _nothing(rolls) if start is None else start)
    bent = _bent_steps(balance)
    for _ in range(MAX_HALVINGS):
        if bent.size == 0 or bent.size > MOST_ADDED:
            break
        phase = balance.rolls.phase
        between = RollPositions((phase[bent] + phase[bent + 1]) / 2, np.zeros(bent.size), np.zeros(bent.size, bool))
        balance = _merged(balance, _balanced(mesh, between, force, slices, _nothing(between)), bent + 1)
        bent = _bent_steps(balance)
    return replace(balance, bent_steps=bent.size)


def _nothing(rolls: RollPositions) -> Start:
    """Return NaN as the start value at every roll position; NaN means that there is no start value."""
    return np.full(rolls.phase.size, np.nan), np.zeros((rolls.phase.size, 0))


def _balanced(mesh: Mesh, rolls: RollPositions, force: float, slices: int, start: Start) -> LoadBalance:
    error, unloaded, residual, steps, survey = _balance(mesh, rolls.phase, rolls.side, force, slices, *start)
    worst = float(np.max(residual))
    if not worst <= TOLERANCE:
        raise NoSolution("load_balance", "the load balance did not converge", {"relative_force": worst})
    return LoadBalance(mesh, rolls, force, error, unloaded, residual, steps, survey)


def _bent_steps(balance: LoadBalance) -> IntArray:
    """Indices of the steps over which TE is not linear, ascending: both beside a position off its neighbours' line.

    Corners are not tested.
    """
    phase, error = balance.rolls.phase, balance.transmission_error
    spread = np.full(error.size, max(float(np.ptp(error)), LEAST_SPREAD))
    approach = error - balance.unloaded_error if balance.force > 0.0 else spread
    before, after = np.diff(phase)[:-1], np.diff(phase)[1:]
    inner = ~balance.rolls.corner[1:-1]
    share = np.divide(before, before + after, out=np.zeros(inner.size), where=inner)
    off = np.abs(error[1:-1] - error[:-2] - share * (error[2:] - error[:-2]))
    least = np.minimum(np.minimum(approach[:-2], approach[1:-1]), approach[2:])
    bent = np.flatnonzero(inner & (off > STRAIGHT * least))
    return np.unique(np.concatenate((bent, bent + 1)))


def _merged(balance: LoadBalance, added: LoadBalance, places: IntArray) -> LoadBalance:
    """Insert the roll positions of `added` into `balance`, each before the position with its index in `places`."""

    def together(old: Any, new: Any) -> Any:
        """Insert `new` at `places` of `old`, arrays over roll positions or tuples of them."""
        if isinstance(old, tuple):
            return type(old)(*map(together, old, new))
        return np.insert(old, places, new, axis=0)

    return LoadBalance(
        balance.mesh,
        together(balance.rolls, added.rolls),
        balance.force,
        together(balance.transmission_error, added.transmission_error),
        together(balance.unloaded_error, added.unloaded_error),
        together(balance.residual, added.residual),
        together(balance.steps, added.steps),
        together(balance.survey, added.survey),
    )


@inner_kernel
def _settle(
    mesh: Mesh, at: tuple[float, float], slices: int, force: float, least: float, error: float, table: Slices
) -> tuple[Cover, float, float, float]:
    """Balance of a roll position with partly loaded lines; return cover, TE [m], residual and steps.

    Every pass cuts only what is loaded at the TE before; loads vanish at the ends, so the error is of second order.
    `at` is phase and side, `error` the start from whole lines.
    """
    covers, steps, settled = 0, 0.0, False
    phase, side = at
    while not settled:
        cover = gather(mesh, phase, side, slices, error, table)
        before = error
        error, residual, more = solve_near(table, cover.slices, mesh.compliance.logarithmic, force, error)
        covers, steps = covers + 1, steps + more
        settled = abs(error - before) <= SETTLED * (error - least) or covers == MAX_COVERS
    return cover, error, residual, steps


@kernel
def _balance(
    mesh: Mesh, phase: FloatArray, side: FloatArray, force: float, slices: int, start: FloatArray, log_load: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, Survey]:
    """Balance every roll position; return TE [m], least gap [m], residual, steps and the survey of the loaded lines."""
    error, unloaded = np.empty(phase.size), np.empty(phase.size)
    residual, steps = np.zeros(phase.size), np.zeros(phase.size)
    survey = empty_survey(mesh, phase.size)
    table = slice_table(mesh, slices)
    for i in range(phase.size):
        cover = gather(mesh, phase[i], side[i], slices, np.inf, table)
        survey.length[i], unloaded[i] = cover.length, cover.least
        error[i] = cover.least
        if force > 0.0:
            near = start[i]
            if not np.isnan(near):
                copy(log_load[i], table.log_load, cover.slices)
            elif i > 1:  # the table still contains ln w of the previous position
                near = 2.0 * error[i - 1] - error[i - 2]
            error[i], residual[i], steps[i] = solve_near(table, cover.slices, mesh.compliance.logarithmic, force, near)
            if error[i] < cover.most:
                at = (phase[i], side[i])
                cover, error[i], residual[i], steps[i] = _settle(mesh, at, slices, force, cover.least, error[i], table)
            survey.loaded_length[i] = cover.length
            survey_slices(mesh, table, cover.slices, error[i], survey, i)
            survey_ends(mesh, phase[i], side[i], error[i], survey, i)
    return error, unloaded, residual, steps, survey


@inner_kernel
def error_at(
    plane: ContactPlane, phase: FloatArray, error: FloatArray, x: float, y: float, index: int
) -> tuple[float, int]:
    """TE at (x, y), linear in the step of its line, and the step's index; the search begins at `index`.

    At the end of the path, the value just before the line leaves it.
    """
    line = min(x, plane.path_length * (1.0 - BESIDE)) + y * plane.tan_base_helix
    position = line - int(line / plane.base_pitch) * plane.base_pitch
    while index > 0 and phase[index] > position:
        index -= 1
    while index < phase.size - 2 and phase[index + 1] <= position:
        index += 1
    fraction = (position - phase[index]) / (phase[index + 1] - phase[index])
    return error[index] + fraction * (error[index + 1] - error[index]), index


@kernel
def loads_at(mesh: Mesh, phase: FloatArray, error: FloatArray, x: FloatArray, y: FloatArray) -> FloatArray:
    """Return the line load w [N/m] at points (x, y) of the plane of action of a balanced mesh."""
    loads, log_load, index = np.empty(x.size), 0.0, 0
    for i in range(x.size):
        approach, index = error_at(mesh.plane, phase, error, x[i], y[i], index)
        loads[i], log_load = load_under(mesh.compliance, approach - gap_at(mesh.gap, x[i], y[i]), x[i], log_load)
    return loads


def line_loads(balance: LoadBalance, x: FloatArray, y: FloatArray) -> FloatArray:
    """Line load w [N/m] at points x, y [m] (arrays of one shape) of the plane of action; 0 out of contact."""
    if balance.force == 0.0:
        return np.zeros(np.shape(x))
    points = np.ravel(x).astype(float), np.ravel(y).astype(float)
    return loads_at(balance.mesh, balance.rolls.phase, balance.transmission_error, *points).reshape(np.shape(x))
