"""Load balance over the contact lines: the approach TE of the flanks at every roll position, and the loads at this TE.

TE is the transmission error. Every line is cut into slices of the length dl = dy / cos beta_b. The line load, which is
the load per length of contact line, is computed at the middle of every slice. This load is w = k max(TE - Delta, 0),
where k is the stiffness of a pair of teeth and Delta is the gap. The sum of w dl over the slices is F_bn (Eq. 9 with
one TE for all points of a roll position).

If a line is loaded over a part of its length only, only the loaded part is cut into slices. This part depends on TE.
The cutting and the balance are therefore repeated until TE no longer changes. The slices then cover exactly the
contact, even if the contact is small. If TE is not linear between two roll positions, further roll positions are added
between these two.

The paper's iteration (Eq. 10) converges only if the mean relief in contact is below TE/2. This module uses Newton's
method instead, because the force F(TE) is convex and increasing. With linear contact, Newton's method reaches the exact
solution in a finite number of steps.
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
    """Compute a start value of TE [m] from a balance with linear compliances.

    If the model of the contact is "hertzian", every slice gets its secant compliance at the mean line load. Newton's
    method solves the linear balance exactly. The first step treats all slices as if they were in contact and could also
    pull. The TE of this step is too large, because slices that pull reduce the force. Every further step reduces TE,
    and fewer slices are in contact.
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
    """Improve the load of every slice by one iteration step, at the transmission error `error` [m].

    Returns four values: the force [N]; the derivative of the force with respect to `error` [N/m]; an estimate of the
    inaccuracy of the force [N]; and the distance of `error` from the nearest kink [m]. The force is inaccurate as long
    as the loads of the slices have not converged. The load of a slice, as a function of `error`, has two kinks. At one
    kink the slice comes into contact. At the other kink the compliance of the slice begins to be held constant.
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
    """Change the load of every slice by its derivative times `change`; return the force of all slices [N].

    `change` [m] is the change of TE, and the derivative of a load is the derivative with respect to TE.
    """
    force = 0.0
    for i in range(count):
        table.load[i] += table.stiffness[i] * change
        force += table.load[i] * table.length[i]
    return force


@inner_kernel
def newton(table: Slices, count: int, logarithmic: float, force: float, error: float) -> tuple[float, float, float]:
    """Solve the balance of one roll position by Newton's method, from a start value of TE (Eq. L13).

    TE and the loads of the slices are iterated together: after every step of TE, the load of every slice takes one step
    of its own iteration. The error after a step of TE is estimated by the square of the relative residual before this
    step. A step is the last step if it crosses no kink and if this estimate is below rounding. In the last step, the
    loads are not iterated: every load changes by its derivative times the step of TE. With linear contact every step
    that crosses no kink is the last step. Returns `error`: approach TE [m]; `residual`: residual of the force divided
    by the force [-]; `steps`: number of steps.
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
    """Solve the balance of one roll position from the start values of a similar position.

    The start values are `error`, the TE [m] of the similar position, and `table.log_load`, the ln w of the similar
    position. If `error` is NaN, or if the iteration from these start values fails, the balance is solved without start
    values. Returns the values that `newton` returns.
    """
    if not np.isnan(error):
        error, residual, steps = newton(table, count, logarithmic, force, error)
        if residual <= TOLERANCE:
            return error, residual, steps
    return solve_position(table, count, logarithmic, force)


@dataclass(frozen=True, slots=True)
class LoadBalance:
    """Loaded state of a mesh over one base pitch; arrays over the roll positions.

    `force` is the force [N] that the contact lines carry together; it is 0 without load. `transmission_error` is TE.
    `unloaded_error` is TE without load; this value equals the least gap over the lines. Both errors are measured along
    the transverse line of action [m]. `residual` is the residual of the load balance divided by the force. `steps` is
    the number of Newton steps. `bent_steps` is the number of pairs of neighbouring roll positions between which TE is
    still not linear.
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
    """Return the indices of the steps over which the transmission error TE is not linear, in ascending order.

    A step lies between two neighbouring roll positions. At every roll position, TE is compared with the straight line
    through TE at both neighbouring positions. If TE is not close to this line, TE is not linear over the steps on both
    sides of the position. The positions marked in `RollPositions.corner` are not tested.
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
    """Insert the roll positions of `added` into `balance`; both are balances of the same mesh.

    `places` contains one index for every added roll position. The added roll position is inserted before the roll
    position of `balance` that has this index.
    """

    def together(old: Any, new: Any) -> Any:
        """Insert `new` into `old` at the indices `places`.

        `old` and `new` are arrays over roll positions, or tuples of such arrays.
        """
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
    """Solve the balance of a roll position at which lines are loaded over a part of their length only.

    `at` contains the phase and the side of the roll position (see `RollPositions`). The start value `error` is the TE
    [m] that results if the lines are cut into slices over their whole length. Every pass cuts into slices only the
    parts of the lines that are loaded at the TE of the previous pass, and solves the balance again. The load is zero at
    the ends of a loaded part. An error of TE in one pass therefore causes only a second-order error in the next pass.
    Returns the `Cover` of the slices in the last pass, TE [m], the relative residual, and the number of steps.
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
    """Balance the load at every roll position.

    Returns TE [m], the least gap [m], the relative residual and the number of steps at every roll position, and the
    survey of the loaded lines.
    """
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
    """Return the transmission error at a point (x, y), and the index of the step from which this error is taken.

    The contact line through the point belongs to one roll position. The result is the transmission error at this roll
    position. A step lies between two neighbouring roll positions of the balance. Within a step, the transmission error
    is interpolated linearly. The search for the step begins at the step `index`. At the end of the path, the result is
    the value just before the contact line leaves the path.
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
    """Return the line load w [N/m] at points x, y [m] of the plane of action; 0 at points where the flanks are apart.

    x and y are arrays of one shape.
    """
    if balance.force == 0.0:
        return np.zeros(np.shape(x))
    points = np.ravel(x).astype(float), np.ravel(y).astype(float)
    return loads_at(balance.mesh, balance.rolls.phase, balance.transmission_error, *points).reshape(np.shape(x))
