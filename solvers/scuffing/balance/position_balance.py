"""Newton's solution for the approach TE at one roll position, over the slices of its lines."""

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.scuffing.balance.contact_slices import CONSTANT, GAP, LENGTH, LIMIT, LOAD, LOG_LOAD, STIFFNESS
from solvers.scuffing.teeth.stiffness import LEAST_OMEGA, line_load_near

MAX_STEPS = 60
ROUNDING = 1e-14  # relative force at which Newton has nothing left to gain
NEAR_ROUNDING = 1e-12
TOLERANCE = 1e-10  # relative force above which there is no solution


@kernel
def _secant_start(table: FloatArray, count: int, logarithmic: float, force: float) -> float:
    """Exact TE of the linear problem; half-spaces take their secant compliance at the mean load, and start from it.

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
            table[LOG_LOAD, i] = log_mean
    error = np.inf
    for _ in range(MAX_STEPS):
        stiffness, moment = 0.0, 0.0
        for i in range(count):
            if table[GAP, i] < error:
                compliance = max(table[CONSTANT, i] - logarithmic * log_mean, logarithmic * LEAST_OMEGA)
                stiffness += table[LENGTH, i] / compliance
                moment += table[LENGTH, i] / compliance * table[GAP, i]
        following = (force + moment) / stiffness
        if following >= error:
            break
        error = following
    return error


@kernel
def _press(table: FloatArray, count: int, logarithmic: float, error: float) -> tuple[float, float, float, float]:
    """Force [N] at an approach [m], its derivative [N/m], its error while slices settle [N], distance of a kink [m].

    Each slice goes one step towards its law and is noted with it. A law has a kink where the slice touches, and where
    its compliance is held.
    """
    force, slope, unsettled, nearest = 0.0, 0.0, 0.0, np.inf
    for i in range(count):
        approach, length = error - table[GAP, i], table[LENGTH, i]
        load, stiffness, log_load, step = line_load_near(
            approach, table[CONSTANT, i], logarithmic, table[LIMIT, i], table[LOG_LOAD, i]
        )
        table[LOAD, i], table[STIFFNESS, i], table[LOG_LOAD, i] = load, stiffness, log_load
        force += load * length
        slope += stiffness * length
        unsettled += load * length * (step * step) ** 2
        nearest = min(nearest, abs(approach))
        if logarithmic > 0.0:
            nearest = min(nearest, abs(table[LIMIT, i] - approach))
    return force, slope, unsettled, nearest


@kernel
def _follow(table: FloatArray, count: int, change: float) -> float:
    """Force [N] once the loads have followed a change of TE [m] along their derivatives."""
    force = 0.0
    for i in range(count):
        table[LOAD, i] += table[STIFFNESS, i] * change
        force += table[LOAD, i] * table[LENGTH, i]
    return force


@kernel
def newton(table: FloatArray, count: int, logarithmic: float, force: float, error: float) -> tuple[float, float, float]:
    """TE [m] from a start, relative residual and steps at one roll position; the slices stay in the table.

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
def solve_position(table: FloatArray, count: int, logarithmic: float, force: float) -> tuple[float, float, float]:
    """TE [m], relative residual and steps at one roll position."""
    return newton(table, count, logarithmic, force, _secant_start(table, count, logarithmic, force))


@kernel
def solve_near(
    table: FloatArray, count: int, logarithmic: float, force: float, error: float
) -> tuple[float, float, float]:
    """The same from the TE [m] of a similar position and the table's ln w; from nothing if TE is NaN or that fails."""
    if not np.isnan(error):
        error, residual, steps = newton(table, count, logarithmic, force, error)
        if residual <= TOLERANCE:
            return error, residual, steps
    return solve_position(table, count, logarithmic, force)
