"""Load balance over the contact lines: the approach TE of the flanks at each roll position, and the loads it leaves.

Each line is cut into slices at whose middles w = k max(TE - Delta, 0) is summed (Eq. 9 with one TE for all points of a
roll position, slices dl = dy / cos beta_b, and w per length of contact line, so that the sum is F_bn). Lines that are
loaded in part are cut again, each time only where the last TE loads them, until TE settles: however small a contact
is, it is covered by all slices. Roll positions are added where TE is not straight between them. The paper's
iteration (Eq. 10) converges only while the mean relief in contact stays below TE/2; here F(TE), which is convex and
increasing, is solved by Newton steps. With linear contact these end exactly after finitely many.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from solvers.arrays import FloatArray, IntArray
from solvers.compiled import kernel
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

MAX_STEPS = 60  # limit; a roll position that has not converged by then does not
ROUNDING = 1e-14  # relative force at which Newton has nothing left to gain
NEAR_ROUNDING = 1e-12  # accepted once the residual no longer falls
TOLERANCE = 1e-10  # relative force above which there is no solution
MAX_COVERS = 20  # of the lines of one roll position by slices
SETTLED = 1e-6  # change of the approach between two covers
STRAIGHT = 2e-3  # of the approach; how far TE may lie off the straight line between its neighbours
MAX_HALVINGS = 8  # of the steps between roll positions
MOST_ADDED = 1000  # roll positions
LEAST_LINE_LOAD = 0.1  # N/m, mean; the approach it makes is near the rounding of large gaps
LEAST_SPREAD = 1e-12  # m, of a kinematic error
BESIDE = 1e-12  # of the path: how far beside a jump of the load its two sides are looked at, above rounding


Start = tuple[FloatArray, FloatArray]
"""TE [m] by roll position, and ln w [N/m] by roll position and slice."""


@kernel
def _secant_start(table: Slices, count: int, logarithmic: float, force: float) -> float:
    """Exact TE of the linear problem; half-spaces take their secant compliance at the mean load, and start from it.

    All slices pressed to a common TE, pulling included, reach the force to the right of the root of the convex F(TE);
    Newton's steps descend from there through ever smaller contact sets.
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


@kernel
def _press(table: Slices, count: int, logarithmic: float, error: float) -> tuple[float, float, float, float]:
    """Force [N] at an approach [m], its derivative [N/m], its error while slices settle [N], distance of a kink [m].

    Each slice goes one step towards its law and is noted with it. A law has a kink where the slice touches, and where
    its compliance is held.
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


@kernel
def _follow(table: Slices, count: int, change: float) -> float:
    """Force [N] once the loads have followed a change of TE [m] along their derivatives."""
    force = 0.0
    for i in range(count):
        table.load[i] += table.stiffness[i] * change
        force += table.load[i] * table.length[i]
    return force


@kernel
def newton(table: Slices, count: int, logarithmic: float, force: float, error: float) -> tuple[float, float, float]:
    """TE [m] from a start, relative residual and steps at one roll position; the slices stay in the table (Eq. L13).

    One iteration over both levels: with every step of TE each slice goes one of its own. A step that crosses no kink
    and whose square is rounding is the last, and the loads follow their derivatives; of linear contact any step is that
    crosses none.
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


@kernel
def solve_position(table: Slices, count: int, logarithmic: float, force: float) -> tuple[float, float, float]:
    """TE [m], relative residual and steps at one roll position."""
    return newton(table, count, logarithmic, force, _secant_start(table, count, logarithmic, force))


@kernel
def solve_near(table: Slices, count: int, logarithmic: float, force: float, error: float) -> tuple[float, float, float]:
    """The same from the TE [m] of a similar position and the table's ln w; from nothing if TE is NaN or that fails."""
    if not np.isnan(error):
        error, residual, steps = newton(table, count, logarithmic, force, error)
        if residual <= TOLERANCE:
            return error, residual, steps
    return solve_position(table, count, logarithmic, force)


@dataclass(frozen=True, slots=True)
class LoadBalance:
    """Loaded state of a mesh over one base pitch; arrays over the roll positions, whose force is 0 or in balance.

    transmission_error and unloaded_error (least gap over the lines), both along the transverse line of action [m];
    residual of the balance relative to the force [N]; steps of the iteration; `bent_steps` between roll positions were
    left across which TE is not straight.
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
    """TE over the roll positions, and over those added between, under the force [N]; the kinematic error without one.

    `start` holds TE and the slices' ln w of the same mesh under a similar gap. A force that presses the lines by less
    than `LEAST_LINE_LOAD` counts as none. Raises NoSolution load_balance if the iteration ends short of the force.

    Eq. 9.
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
    """A start that knows nothing."""
    return np.full(rolls.phase.size, np.nan), np.zeros((rolls.phase.size, 0))


def _balanced(mesh: Mesh, rolls: RollPositions, force: float, slices: int, start: Start) -> LoadBalance:
    error, unloaded, residual, steps, survey = _balance(mesh, rolls.phase, rolls.side, force, slices, *start)
    worst = float(np.max(residual))
    if not worst <= TOLERANCE:
        raise NoSolution("load_balance", "the load balance did not converge", {"relative_force": worst})
    return LoadBalance(mesh, rolls, force, error, unloaded, residual, steps, survey)


def _bent_steps(balance: LoadBalance) -> IntArray:
    """Indices of the steps between roll positions across which TE is not straight, ascending.

    What counts is how far a position lies off the line through its neighbours; corners may be sharp.
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
    """Two balances of one mesh as one, the added roll positions at their places among the others."""

    def together(old: Any, new: Any) -> Any:
        """Values of the positions of both in their order, arrays or tuples of them."""
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


@kernel
def _settle(
    mesh: Mesh, at: tuple[float, float], slices: int, force: float, least: float, error: float, table: Slices
) -> tuple[Cover, float, float, float]:
    """Slices, TE [m], relative residual and steps at a roll position (phase, side) whose lines are loaded in part.

    Starts from the TE of whole lines. Forces vanish at the ends of what is loaded, so that an error of TE moves the
    next one in second order only.
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
    mesh: Mesh, phase: FloatArray, side: FloatArray, force: float, slices: int, known: FloatArray, log_load: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, Survey]:
    """TE, least gap, residual and steps at each roll position, and the survey of the loaded lines."""
    error, unloaded = np.empty(phase.size), np.empty(phase.size)
    residual, steps = np.zeros(phase.size), np.zeros(phase.size)
    survey = empty_survey(mesh, phase.size)
    table = slice_table(mesh, slices)
    for i in range(phase.size):
        cover = gather(mesh, phase[i], side[i], slices, np.inf, table)
        survey.length[i], unloaded[i] = cover.length, cover.least
        error[i] = cover.least
        if force > 0.0:
            near = known[i]
            if not np.isnan(near):
                table.log_load[: cover.slices] = log_load[i, : cover.slices]
            elif i > 1:  # the table still holds the slices of the position before
                near = 2.0 * error[i - 1] - error[i - 2]
            error[i], residual[i], steps[i] = solve_near(table, cover.slices, mesh.compliance.logarithmic, force, near)
            if error[i] < cover.most:
                at = (phase[i], side[i])
                cover, error[i], residual[i], steps[i] = _settle(mesh, at, slices, force, cover.least, error[i], table)
            survey.loaded_length[i] = cover.length
            survey_slices(mesh, table, cover.slices, error[i], survey, i)
            survey_ends(mesh, phase[i], side[i], error[i], survey, i)
    return error, unloaded, residual, steps, survey


@kernel
def error_at(
    plane: ContactPlane, phase: FloatArray, error: FloatArray, x: float, y: float, index: int
) -> tuple[float, int]:
    """TE at the roll position whose line passes through (x, y), and its step, looked for from step `index` on.

    The end of the path belongs to the roll position that leaves it, not to the next.
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
    """Line load w [N/m] at points (x, y) of a plane that is in balance."""
    loads, log_load, index = np.empty(x.size), 0.0, 0
    for i in range(x.size):
        approach, index = error_at(mesh.plane, phase, error, x[i], y[i], index)
        loads[i], log_load = load_under(mesh.compliance, approach - gap_at(mesh.gap, x[i], y[i]), x[i], log_load)
    return loads


def line_loads(balance: LoadBalance, x: FloatArray, y: FloatArray) -> FloatArray:
    """Line load w [N/m] at points (x, y) of the plane, arrays of one shape; 0 where the flanks stand apart."""
    if balance.force == 0.0:
        return np.zeros(np.shape(x))
    points = np.ravel(x).astype(float), np.ravel(y).astype(float)
    return loads_at(balance.mesh, balance.rolls.phase, balance.transmission_error, *points).reshape(np.shape(x))
