"""Newton's solution for the approach TE at one roll position, over the slices of its lines."""

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.scuffing.balance.contact_slices import CONSTANT, GAP, LENGTH, LIMIT, LOAD, OMEGA
from solvers.scuffing.teeth.stiffness import line_load_near

MAX_STEPS = 60
LEAST_OMEGA = 2.0  # of the start, whose compliance must stay positive
ROUNDING = 1e-14  # relative force at which Newton has nothing left to gain
NEAR_ROUNDING = 1e-12
TOLERANCE = 1e-10  # relative force above which there is no solution


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
def _press(table: FloatArray, count: int, logarithmic: float, error: float) -> tuple[float, float, float]:
    """Force [N] at an approach [m], its derivative [N/m] and what it may change by as omegas settle [N].

    Each slice's omega goes one step; loads and omegas are noted.
    """
    force, slope, unsettled = 0.0, 0.0, 0.0
    for i in range(count):
        load, stiffness, table[OMEGA, i], step = line_load_near(
            error - table[GAP, i], table[CONSTANT, i], logarithmic, table[LIMIT, i], table[OMEGA, i]
        )
        table[LOAD, i] = load
        force += load * table[LENGTH, i]
        slope += stiffness * table[LENGTH, i]
        unsettled += load * table[LENGTH, i] * (step * step) ** 2
    return force, slope, unsettled


@kernel
def newton(table: FloatArray, count: int, logarithmic: float, force: float, error: float) -> tuple[float, float, float]:
    """TE [m] from a start, relative residual and steps at one roll position; loads and omegas stay in the table.

    One iteration over both levels: with every step of TE each slice's omega goes one of its own.
    """
    residual, steps = np.inf, 0.0
    while steps < MAX_STEPS:
        carried, slope, unsettled = _press(table, count, logarithmic, error)
        steps += 1.0
        before, residual = residual, (abs(carried - force) + unsettled) / force
        if residual <= ROUNDING or (residual <= NEAR_ROUNDING and residual >= before):
            break
        error -= (carried - force) / slope
    return error, residual, steps


@kernel
def solve_position(table: FloatArray, count: int, logarithmic: float, force: float) -> tuple[float, float, float]:
    """TE [m], relative residual and steps at one roll position."""
    return newton(table, count, logarithmic, force, _secant_start(table, count, logarithmic, force))


@kernel
def solve_near(
    table: FloatArray, count: int, logarithmic: float, force: float, error: float, omega: FloatArray
) -> tuple[float, float, float]:
    """The same from the TE [m] and the omegas of a similar position; from nothing where TE is NaN or that fails."""
    if not np.isnan(error):
        table[OMEGA, :count] = omega[:count]
        error, residual, steps = newton(table, count, logarithmic, force, error)
        if residual <= TOLERANCE:
            return error, residual, steps
    return solve_position(table, count, logarithmic, force)
