"""One simultaneous Newton iteration for all unknowns of the thermal contact: temperatures, pressures, separation."""

import numpy as np

from solvers.arrays import BoolArray, FloatArray, IntArray
from solvers.compiled import kernel
from solvers.contact.ehl.film.fluxes import (
    BY_G,
    BY_H,
    BY_P,
    add_flux_changes,
    assemble_faces,
    film_shape,
    pressure_gradients,
)
from solvers.contact.ehl.film.reynolds import (
    PATIENCE,
    RUPTURE_TOLERANCE,
    apply_pressure_step,
    assemble_jacobian,
    balance_of_mass,
    release_cavitated,
)
from solvers.contact.ehl.grid.dense import dot, factor, substitute
from solvers.contact.ehl.grid.mesh import Grid
from solvers.contact.ehl.heat.elimination import factor_column
from solvers.contact.ehl.problem import Problem
from solvers.contact.ehl.solution.krylov import combine_basis, extend_basis
from solvers.contact.ehl.solution.state import State, Work, evaluate_state
from solvers.contact.ehl.solution.temperature import inlet_step, temperature_step

LARGEST_PRESSURE_STEP = 0.3
LARGEST_TEMPERATURE_STEP = 40.0  # K
LOWEST_TEMPERATURE = 200.0  # K, of iterates
KRYLOV = 10
KRYLOV_TOLERANCE = 0.01
FIRST_DAMPING = 30.0  # of the temperatures, in units of their conduction across the film
FROZEN = 1e4
SHORT_STEP = 3e-3  # of P, behind which the Jacobian still holds
SHRINKING = 0.1  # what the next step is of such a one, if it does


@kernel
def include_temperature(work: Work) -> None:
    """Make the derivatives of A and B total: with the response of temperature."""
    log_a, b, responses = work.coefficients.log_a, work.coefficients.b, work.heat.column.responses
    a_slopes, b_slopes = work.film.flow.log_a_by_temperature, work.film.flow.b_by_temperature
    n, nodes = a_slopes.shape
    for i in range(1, n):
        a_by_p, a_by_g, a_by_h = log_a[i, BY_P], log_a[i, BY_G], log_a[i, BY_H]
        b_by_p, b_by_g, b_by_h = b[i, BY_P], b[i, BY_G], b[i, BY_H]
        for k in range(nodes):
            p, g, h = responses[i, k, BY_P], responses[i, k, BY_G], responses[i, k, BY_H]
            a_by_p, a_by_g, a_by_h = (
                a_by_p + a_slopes[i, k] * p,
                a_by_g + a_slopes[i, k] * g,
                a_by_h + a_slopes[i, k] * h,
            )
            b_by_p, b_by_g, b_by_h = (
                b_by_p + b_slopes[i, k] * p,
                b_by_g + b_slopes[i, k] * g,
                b_by_h + b_slopes[i, k] * h,
            )
        log_a[i, BY_P], log_a[i, BY_G], log_a[i, BY_H] = a_by_p, a_by_g, a_by_h
        b[i, BY_P], b[i, BY_G], b[i, BY_H] = b_by_p, b_by_g, b_by_h


@kernel
def add_temperature_changes(
    work: Work, cavitated: BoolArray, step: FloatArray, given: FloatArray, residual: FloatArray
) -> None:
    """Add to `residual` what a temperature step does to the balance of mass, beyond the responses `given`."""
    n, nodes = step.shape
    log_a, b = np.zeros(n), np.zeros(n)
    a_slopes, b_slopes = work.film.flow.log_a_by_temperature, work.film.flow.b_by_temperature
    for i in range(1, n):
        by_a, by_b = 0.0, 0.0
        for k in range(nodes):
            change = step[i, k] - given[i, k]
            by_a += a_slopes[i, k] * change
            by_b += b_slopes[i, k] * change
        log_a[i], b[i] = by_a, by_b
    add_flux_changes(work.faces, cavitated, log_a, b, residual)


@kernel
def pressure_responses(
    problem: Problem, grid: Grid, work: Work, cavitated: BoolArray, step: FloatArray, given: FloatArray
) -> None:
    """Temperature change (n, k) that a step (n + 1,) in (P, H0) implies at fixed upstream temperatures."""
    n = grid.x.size
    change, slopes = np.empty(n), np.empty(n)
    film_shape(grid, step[:n], step[n], change)
    pressure_gradients(grid.x, step[:n], cavitated, slopes)
    slope, responses = problem.maximum_pressure / problem.half_width, work.heat.column.responses
    for i in range(n):
        dp = step[i] * problem.maximum_pressure
        dh = (change[i] - 0.5 * grid.x[i] ** 2) * problem.gap_scale
        dg = slope * (slopes[i] * work.height[i] * problem.gap_scale + work.gradient[i] * dh)
        for k in range(given.shape[1]):
            given[i, k] = responses[i, k, BY_P] * dp + responses[i, k, BY_G] * dg + responses[i, k, BY_H] * dh


@kernel
def transport_response(
    problem: Problem,
    grid: Grid,
    work: Work,
    cavitated: BoolArray,
    factors: FloatArray,
    pivots: IntArray,
    step: FloatArray,
    given: FloatArray,
    step_t: FloatArray,
    change: FloatArray,
) -> None:
    """What the factored Jacobian leaves out of a step (n + 1,) in (P, H0), solved with it into `change` (n + 1,).

    It knows how each column responds to its own pressure, not what that passes on downstream, as heat in oil and
    surfaces. `given` and `step_t` (n, k) are room for temperatures.
    """
    pressure_responses(problem, grid, work, cavitated, step, given)
    temperature_step(problem, grid, work.film, work.heat, given, 0.0, step_t)
    change[:] = 0.0
    add_temperature_changes(work, cavitated, step_t, given, change)
    substitute(factors, pivots, change)


@kernel
def newton_step(
    problem: Problem,
    grid: Grid,
    work: Work,
    cavitated: BoolArray,
    factors: FloatArray,
    pivots: IntArray,
    residual: FloatArray,
    step: FloatArray,
    step_t: FloatArray,
) -> None:
    """Step (n + 1,) in (P, H0) and (n, k) in T from the linearised equations.

    What the factored Jacobian leaves out enters through GMRES, preconditioned with it. It corrects the step of the
    Jacobian alone, so that the load is met whenever it stops; where the first correction is so small that its square
    is within tolerance, that is all.
    """
    n, nodes = step_t.shape
    given, change = np.zeros((n, nodes)), np.zeros(n + 1)
    temperature_step(problem, grid, work.film, work.heat, given, 1.0, step_t)
    add_temperature_changes(work, cavitated, step_t, given, residual)
    step[:] = -residual
    substitute(factors, pivots, step)
    norm = np.sqrt(dot(step, step))
    if not (np.isfinite(norm) and norm > 0.0):
        return
    transport_response(problem, grid, work, cavitated, factors, pivots, step, given, step_t, change)
    rest = np.sqrt(dot(change, change))
    if rest * rest <= KRYLOV_TOLERANCE * norm * norm:
        step -= change
    else:
        basis, hessenberg = np.zeros((KRYLOV + 1, n + 1)), np.zeros((KRYLOV, KRYLOV))
        rotations, rhs = np.zeros((KRYLOV, 2)), np.zeros(KRYLOV + 1)
        basis[0], rhs[0], count = -change / rest, rest, 0
        while count < KRYLOV and rest > KRYLOV_TOLERANCE * norm:
            transport_response(problem, grid, work, cavitated, factors, pivots, basis[count], given, step_t, change)
            basis[count + 1] = basis[count] + change
            rest = extend_basis(basis, hessenberg, rotations, rhs, count)
            count += 1
        combine_basis(basis, hessenberg, rhs, count, step)
    pressure_responses(problem, grid, work, cavitated, step, given)
    temperature_step(problem, grid, work.film, work.heat, given, 1.0, step_t)


@kernel
def factor_jacobian(
    problem: Problem, grid: Grid, state: State, work: Work, jacobian: FloatArray, pivots: IntArray
) -> None:
    """The factored system for (P, H0), with the responses of the columns."""
    include_temperature(work)
    assemble_faces(
        problem, grid.x, state.pressure, work.height, work.gradient, state.cavitated, work.coefficients, work.faces
    )
    assemble_jacobian(grid, state.cavitated, work.faces, jacobian)
    factor(jacobian, pivots)


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
