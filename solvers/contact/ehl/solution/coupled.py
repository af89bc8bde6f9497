"""One simultaneous Newton iteration for all unknowns of the thermal contact: temperatures, pressures, separation."""

import numpy as np

from solvers.arrays import BoolArray, FloatArray
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
    assemble_system,
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


@kernel
def include_temperature(work: Work) -> None:
    """Make the derivatives of A and B total: with the response of temperature."""
    film, log_a, b = work.film, work.coefficients.log_a, work.coefficients.b
    n, nodes, count = work.heat.column.responses.shape
    for i in range(1, n):
        responses = work.heat.column.responses[i]
        for k in range(nodes):
            a_slope, b_slope = film.flow.log_a_by_temperature[i, k], film.flow.b_by_temperature[i, k]
            for c in range(BY_P, count):
                log_a[i, c] += a_slope * responses[k, c]
                b[i, c] += b_slope * responses[k, c]


@kernel
def add_temperature_changes(
    work: Work, cavitated: BoolArray, step: FloatArray, given: FloatArray, residual: FloatArray
) -> None:
    """Add to `residual` what a temperature step does to the balance of mass, beyond the responses `given`."""
    n, nodes = step.shape
    log_a, b = np.zeros(n), np.zeros(n)
    for i in range(1, n):
        for k in range(nodes):
            change = step[i, k] - given[i, k]
            log_a[i] += work.film.flow.log_a_by_temperature[i, k] * change
            b[i] += work.film.flow.b_by_temperature[i, k] * change
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
    slope = problem.maximum_pressure / problem.half_width
    for i in range(n):
        dp = step[i] * problem.maximum_pressure
        dh = (change[i] - 0.5 * grid.x[i] ** 2) * problem.gap_scale
        dg = slope * (slopes[i] * work.height[i] * problem.gap_scale + work.gradient[i] * dh)
        responses = work.heat.column.responses[i]
        for k in range(given.shape[1]):
            given[i, k] = responses[k, BY_P] * dp + responses[k, BY_G] * dg + responses[k, BY_H] * dh


@kernel
def newton_step(
    problem: Problem,
    grid: Grid,
    work: Work,
    cavitated: BoolArray,
    jacobian: FloatArray,
    residual: FloatArray,
    step: FloatArray,
    step_t: FloatArray,
) -> None:
    """Step (n + 1,) in (P, H0) and (n, k) in T from the linearised equations.

    The Jacobian knows how each column responds to its own pressure; what it passes on to the columns downstream, as
    heat in oil and surfaces, enters through GMRES, preconditioned with the Jacobian (overwritten). It
    corrects the step of the Jacobian alone, so that the load is met whenever it stops.
    """
    n, nodes = step_t.shape
    given = np.zeros((n, nodes))
    basis, hessenberg = np.zeros((KRYLOV + 1, n + 1)), np.zeros((KRYLOV, KRYLOV))
    rotations, rhs, change = np.zeros((KRYLOV, 2)), np.zeros(KRYLOV + 1), np.zeros(n + 1)
    pivots = np.empty(n + 1, np.int64)
    factor(jacobian, pivots)
    temperature_step(problem, grid, work.film, work.heat, given, 1.0, step_t)
    add_temperature_changes(work, cavitated, step_t, given, residual)
    step[:] = -residual
    substitute(jacobian, pivots, step)
    norm = np.sqrt(dot(step, step))
    if not (np.isfinite(norm) and norm > 0.0):
        return
    rest, count = np.inf, -1
    while count < KRYLOV and rest > KRYLOV_TOLERANCE * norm:
        pressure_responses(problem, grid, work, cavitated, step if count < 0 else basis[count], given)
        temperature_step(problem, grid, work.film, work.heat, given, 0.0, step_t)
        change[:] = 0.0
        add_temperature_changes(work, cavitated, step_t, given, change)
        substitute(jacobian, pivots, change)
        if count < 0:
            rest = np.sqrt(dot(change, change))
            rhs[0] = rest
            basis[0] = -change / max(rest, 1e-300)
        else:
            basis[count + 1] = basis[count] + change
            rest = extend_basis(basis, hessenberg, rotations, rhs, count)
        count += 1
    combine_basis(basis, hessenberg, rhs, count, step)
    pressure_responses(problem, grid, work, cavitated, step, given)
    temperature_step(problem, grid, work.film, work.heat, given, 1.0, step_t)


@kernel
def linearise(
    problem: Problem, grid: Grid, state: State, work: Work, jacobian: FloatArray, residual: FloatArray
) -> None:
    """Responses of the columns, and the system for (P, H0) with them."""
    for i in range(1, grid.x.size):
        factor_column(i, work.film, work.heat)
    include_temperature(work)
    assemble_faces(
        problem, grid.x, state.pressure, work.height, work.gradient, state.cavitated, work.coefficients, work.faces
    )
    assemble_system(grid, state.pressure, state.cavitated, work.faces, jacobian, residual)


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
    """Simultaneous Newton for (T, P, H0), in place; whether it converged.

    It has when both steps are within tolerance and taken whole, the broken film unchanged and no guard in action. A
    step that is too long to trust is not taken but repeated with temperatures damped (implicit pseudo-time); the
    damping fades as the steps shrink. Steps that stop shrinking are relaxed.
    """
    n, nodes = state.temperature.shape
    jacobian, residual = np.empty((n + 1, n + 1)), np.empty(n + 1)
    step, step_t = np.zeros(n + 1), np.zeros((n, nodes))
    damping, before, relaxation = 0.0, np.inf, 1.0
    for iteration in range(max_iterations):
        state.history[0] += 1.0
        state.cavitated[n - 1] = state.cavitated[n - 2]
        limited = evaluate_state(problem, grid, state, work, damping)
        tolerance = 0.0 if iteration < PATIENCE else RUPTURE_TOLERANCE
        changed = release_cavitated(work.faces, state.cavitated, tolerance)
        linearise(problem, grid, state, work, jacobian, residual)
        newton_step(problem, grid, work, state.cavitated, jacobian, residual, step, step_t)
        inlet_step(problem, work, state.temperature, step_t)
        last_p, last_t = np.abs(step[:n]).max(), np.abs(step_t).max()
        if not (np.isfinite(last_p) and np.isfinite(last_t) and np.isfinite(step[n])):
            return False
        state.history[1], state.history[2] = last_p, last_t
        scale = min(1.0, LARGEST_PRESSURE_STEP / max(last_p, 1e-9), LARGEST_TEMPERATURE_STEP / max(last_t, 1e-9))
        if scale < 0.2 and damping < FROZEN:
            damping = max(10.0 * damping, FIRST_DAMPING)
            continue
        within = last_p < pressure_tolerance and last_t < temperature_tolerance
        converged = within and damping == 0.0 and not changed and not limited
        if scale == 1.0 and last_p < 0.1:
            damping = 0.2 * damping if damping > 0.15 else 0.0
        if iteration > PATIENCE:
            relaxation = max(0.7 * relaxation, 0.3) if last_p > 0.7 * before else min(1.5 * relaxation, 1.0)
        before = last_p
        taken, joined = apply_pressure_step(
            grid, state.pressure, state.separation, state.cavitated, step, scale if within else scale * relaxation
        )
        for i in range(n):
            for k in range(nodes):
                state.temperature[i, k] = max(state.temperature[i, k] + taken * step_t[i, k], LOWEST_TEMPERATURE)
        if converged and not joined and taken == 1.0:
            return True
    return False
