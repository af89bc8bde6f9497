"""Newton's method for all unknowns of the thermal contact at once: temperatures, pressures, separation."""

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.contact.ehl.film.reynolds import (
    PATIENCE,
    RUPTURE_TOLERANCE,
    apply_pressure_step,
    balance_of_mass,
    release_cavitated,
)
from solvers.contact.ehl.grid.mesh import Grid
from solvers.contact.ehl.heat.elimination import factor_column
from solvers.contact.ehl.problem import Problem
from solvers.contact.ehl.solution.state import State, Work, evaluate_state
from solvers.contact.ehl.solution.step import factor_jacobian, newton_step
from solvers.contact.ehl.solution.temperature import inlet_step

LARGEST_PRESSURE_STEP = 0.3
LARGEST_TEMPERATURE_STEP = 40.0  # K
LOWEST_TEMPERATURE = 200.0  # K, of iterates
FIRST_DAMPING = 30.0  # of the temperatures, in units of their conduction across the film
FROZEN = 1e4
SHORT_STEP = 3e-3  # of P, behind which the Jacobian still holds
SHRINKING = 0.1  # what the next step is of such a one, if it does


@kernel
def take_step(grid: Grid, state: State, step: FloatArray, step_t: FloatArray, scale: float) -> tuple[float, bool]:
    """Move all unknowns by `scale` times the step, less where the film would close; see `apply_pressure_step`."""
    taken, joined = apply_pressure_step(grid, state.pressure, state.separation, state.cavitated, step, scale)
    n, nodes = step_t.shape
    for i in range(n):
        for k in range(nodes):
            state.temperature[i, k] = max(state.temperature[i, k] + taken * step_t[i, k], LOWEST_TEMPERATURE)
    return taken, joined


@kernel
def solve_coupled(
    problem: Problem,
    grid: Grid,
    state: State,
    work: Work,
    max_iterations: int,
    pressure_tolerance: float,
    temperature_tolerance: float,
) -> bool:
    """Simultaneous Newton for (T, P, H0), in place; whether it converged. What it found is evaluated into `work`.

    It has when both steps are within tolerance and taken whole, the broken film unchanged and no guard in action. A
    step that is too long to trust is not taken but repeated with temperatures damped (implicit pseudo-time); the
    damping fades as the steps shrink. Steps that stop shrinking are relaxed. Behind a short step that was taken whole
    the Jacobian is that of before, as long as each step is far shorter than the last.
    """
    n, nodes = state.temperature.shape
    jacobian, residual = np.empty((n + 1, n + 1)), np.empty(n + 1)
    pivots, step, step_t = np.empty(n + 1, np.int64), np.zeros(n + 1), np.zeros((n, nodes))
    damping, before, before_t, relaxation, near = 0.0, np.inf, np.inf, 1.0, False
    for iteration in range(max_iterations):
        state.history[0] += 1.0
        limited = evaluate_state(problem, grid, state, work, damping)
        tolerance = 0.0 if iteration < PATIENCE else RUPTURE_TOLERANCE
        changed = release_cavitated(work.faces, state.cavitated, tolerance)
        for i in range(1, n):
            factor_column(i, work.film, work.heat)
        fresh = changed or limited or not near
        if fresh:
            factor_jacobian(problem, grid, state, work, jacobian, pivots)
        balance_of_mass(grid, state.pressure, state.cavitated, work.faces, residual)
        newton_step(problem, grid, work, state.cavitated, jacobian, pivots, residual, step, step_t)
        inlet_step(problem, work, state.temperature, step_t)
        last_p, last_t = np.abs(step[:n]).max(), np.abs(step_t).max()
        if not (np.isfinite(last_p) and np.isfinite(last_t) and np.isfinite(step[n])):
            return False
        state.history[1], state.history[2] = last_p, last_t
        scale = min(1.0, LARGEST_PRESSURE_STEP / max(last_p, 1e-9), LARGEST_TEMPERATURE_STEP / max(last_t, 1e-9))
        if scale < 0.2 and damping < FROZEN:
            damping, near = max(10.0 * damping, FIRST_DAMPING), False
            continue
        within = last_p < pressure_tolerance and last_t < temperature_tolerance
        shrinking = last_p < SHRINKING * before and last_t < SHRINKING * before_t
        undamped = damping == 0.0
        converged = within and undamped and not changed and not limited and (fresh or shrinking)
        if scale == 1.0 and last_p < 0.1:
            damping = 0.2 * damping if damping > 0.15 else 0.0
        if iteration > PATIENCE:
            relaxation = max(0.7 * relaxation, 0.3) if last_p > 0.7 * before else min(1.5 * relaxation, 1.0)
        before, before_t = last_p, last_t
        taken, joined = take_step(grid, state, step, step_t, scale if within else scale * relaxation)
        if converged and not joined and taken == 1.0:
            evaluate_state(problem, grid, state, work, 0.0)
            return True
        near = last_p < SHORT_STEP and shrinking and undamped and not joined and taken == 1.0
    return False
