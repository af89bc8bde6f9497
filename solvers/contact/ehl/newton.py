"""Newton's method for the isothermal contact, and for all unknowns of the thermal contact together."""

import numpy as np

from solvers.arrays import BoolArray, FloatArray, IntArray, copy
from solvers.compiled import inlined_kernel, inner_kernel, kernel
from solvers.contact.ehl.flow import FlowCoefficients
from solvers.contact.ehl.grid import Grid
from solvers.contact.ehl.heat import factor_columns
from solvers.contact.ehl.linear_algebra import combine_basis, dot, extend_basis, factor, substitute
from solvers.contact.ehl.problem import Problem
from solvers.contact.ehl.reynolds import (
    PATIENCE,
    RUPTURE_TOLERANCE,
    add_flux_changes,
    apply_pressure_step,
    assemble_jacobian,
    balance_of_mass,
    film_shape,
    mass_flux_slopes,
    mass_fluxes,
    pressure_gradients,
    release_cavitated,
)
from solvers.contact.ehl.rheology import uniform_shear
from solvers.contact.ehl.state import NEXT, State, Work, evaluate_state, fluid_fractions, linearise_state
from solvers.contact.ehl.temperature import inlet_step, temperature_step
from solvers.lubricants import density, log_viscosity, pressure_part

EARLY = 5  # number of iterations, from the first, in which the pressure step has a tighter limit
KRYLOV = 10  # largest number of steps of GMRES, chosen for speed
KRYLOV_TOLERANCE = 0.01  # relative to the right-hand side; Newton's method corrects the remaining error
LARGEST_PRESSURE_STEP = 0.3  # share of the Hertzian pressure; the viscosity depends on the pressure exponentially
LARGEST_TEMPERATURE_STEP = 40.0  # K
LOWEST_TEMPERATURE = 200.0  # K, lower limit of the temperatures during the iteration
FIRST_DAMPING = 30.0  # first value of the damping of the temperatures, see `linearise_balances`
FROZEN = 1e4  # a damping above this value would have no further effect
SHORT_STEP = 3e-3  # largest change of P after which the Jacobian can be reused
SHRINKING = 0.1  # steps count as shrinking if the ratio of a step to the step before is below this value


@inlined_kernel
def uniform_film(problem: Problem, i: int, p: float, g: float, h: float, coefficients: FlowCoefficients) -> float:
    """Flow coefficients of column i at the inlet temperature; return the mid-film stress [Pa] (Eq. E7.2).

    B is rho um; A is rho/(12 eta), times a factor of the law of shear.
    """
    laws = problem.laws
    term, term_slope = pressure_part(laws, p)
    log_eta, eta_slope, _ = log_viscosity(laws, term, problem.inlet)
    eta_by_p = eta_slope * term_slope  # derivative of ln eta with respect to p
    rho, rho_by_p, _ = density(laws, p, problem.inlet)
    sheared, by_eta, by_g, by_h, tau_m = uniform_shear(problem, log_eta, g, h)
    um = 0.5 * (problem.speed_1 + problem.speed_2)
    log_a, b = coefficients.log_a, coefficients.b
    b[i].value, b[i].by_p, b[i].by_g, b[i].by_h = rho * um, rho_by_p * um, 0.0, 0.0
    log_a[i].value, log_a[i].by_p = np.log(rho / 12.0) - log_eta + sheared, rho_by_p / rho + (by_eta - 1.0) * eta_by_p
    log_a[i].by_g, log_a[i].by_h = by_g, by_h
    return tau_m


@inner_kernel
def evaluate_isothermal(problem: Problem, grid: Grid, state: State, work: Work) -> None:
    """Film, stress and flow of all columns at the inlet temperature; the last node is cavitated as its neighbour."""
    state.cavitated[-1] = state.cavitated[-2]
    film_shape(grid, state.pressure, state.separation[0], work.height)
    pressure_gradients(grid.x, state.pressure, state.cavitated, work.gradient)
    slope = problem.maximum_pressure / problem.half_width
    for i in range(grid.x.size):
        p, h = state.pressure[i] * problem.maximum_pressure, work.height[i] * problem.gap_scale
        g = h * work.gradient[i] * slope
        work.at[i].p, work.at[i].g, work.at[i].h = p, g, h
        work.film.mid.stress[i] = uniform_film(problem, i, p, g, h, work.coefficients)
    mass_fluxes(problem, grid.x, state.pressure, work.height, work.coefficients, work.faces)


@kernel
def solve_isothermal(
    problem: Problem, grid: Grid, state: State, work: Work, max_iterations: int, tolerance: float
) -> bool:
    """Solve for (P, H0) by Newton's method from the given pressures, in place; return whether the iteration converged.

    `work` receives all quantities of the solution. In the first iterations, the change of pressure is limited at each
    node. In later iterations, the whole step is scaled. If the pressure at a node downstream of the centre falls below
    zero, the node joins the broken film. The node leaves the broken film again if more oil flows into the node than out
    of the node.
    """
    n = grid.x.size
    jacobian, residual, step = np.empty((n + 1, n + 1)), np.empty(n + 1), np.empty(n + 1)
    pivots = np.empty(n + 1, np.int64)
    for iteration in range(max_iterations):
        state.history[0].iterations += 1.0
        evaluate_isothermal(problem, grid, state, work)
        mass_flux_slopes(problem, grid, work.height, work.gradient, state.cavitated, work.coefficients, work.faces)
        rupture_tolerance = 0.0 if iteration < PATIENCE else RUPTURE_TOLERANCE
        changed = release_cavitated(work.faces, state.cavitated, rupture_tolerance)
        balance_of_mass(grid, state.pressure, state.cavitated, work.faces, residual)
        assemble_jacobian(grid, state.cavitated, work.faces, jacobian)
        factor(jacobian, pivots)
        copy(-residual, step, n + 1)
        substitute(jacobian, pivots, step)
        if not np.all(np.isfinite(step)):
            return False
        largest = np.abs(step[:n]).max()
        state.history[0].pressure_change = largest
        scale = 1.0
        if iteration < PATIENCE:
            clip = 0.3 if iteration < EARLY else 0.5
            for i in range(n):
                step[i] = min(max(step[i], -clip), clip)
        else:
            scale = min(1.0, 0.5 / max(largest, 0.5))
        taken, joined = apply_pressure_step(grid, state.pressure, state.separation, state.cavitated, step, scale)
        if largest < tolerance and taken == 1.0 and not (changed or joined):
            evaluate_isothermal(problem, grid, state, work)
            fluid_fractions(problem, state, work)
            return True
    return False


@inner_kernel
def include_temperature(work: Work) -> None:
    """Add the effect of the temperatures to the derivatives of ln A and B, which hold at fixed temperatures before."""
    log_a, b, responses = work.coefficients.log_a, work.coefficients.b, work.heat.column.responses
    a_slopes, b_slopes = work.film.flow.log_a_by_temperature, work.film.flow.b_by_temperature
    n, nodes = a_slopes.shape
    for i in range(1, n):
        a_by_p, a_by_g, a_by_h = log_a[i].by_p, log_a[i].by_g, log_a[i].by_h
        b_by_p, b_by_g, b_by_h = b[i].by_p, b[i].by_g, b[i].by_h
        for k in range(nodes):
            p, g, h = responses.by_p[i, k], responses.by_g[i, k], responses.by_h[i, k]
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
        log_a[i].by_p, log_a[i].by_g, log_a[i].by_h = a_by_p, a_by_g, a_by_h
        b[i].by_p, b[i].by_g, b[i].by_h = b_by_p, b_by_g, b_by_h


@inner_kernel
def add_temperature_changes(
    work: Work, cavitated: BoolArray, step: FloatArray, given: FloatArray, residual: FloatArray
) -> None:
    """Add to `residual` the effect of the temperature changes `step` - `given` on the balance of mass.

    `given` holds the temperature changes that the step in (P, H0) causes at fixed upstream temperatures. The
    derivatives of ln A and B by p, G and h already contain the effect of `given`.
    """
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


@inner_kernel
def pressure_responses(
    problem: Problem, grid: Grid, work: Work, cavitated: BoolArray, step: FloatArray, given: FloatArray
) -> None:
    """Compute the temperature change (n, k) that a step (n + 1,) in (P, H0) causes at fixed upstream temperatures."""
    n = grid.x.size
    change, slopes = np.empty(n), np.empty(n)
    film_shape(grid, step[:n], step[n], change)
    pressure_gradients(grid.x, step[:n], cavitated, slopes)
    slope, responses = problem.maximum_pressure / problem.half_width, work.heat.column.responses
    for i in range(n):
        dp = step[i] * problem.maximum_pressure
        dh = (change[i] - 0.5 * grid.x[i] ** 2) * problem.gap_scale
        dg = slope * (slopes[i] * work.at[i].h + work.gradient[i] * dh)
        for k in range(given.shape[1]):
            given[i, k] = responses.by_p[i, k] * dp + responses.by_g[i, k] * dg + responses.by_h[i, k] * dh


@inner_kernel
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
    """Compute how (P, H0) respond to the heat transport between columns that a step (n + 1,) in (P, H0) causes.

    Oil and surfaces carry heat from column to column. The factored Jacobian neglects this transport. The function
    computes the residuals that the transport causes if the step is taken, solves the factored system for these
    residuals, and writes the solution to `change` (n + 1,). `given` and `step_t` (n, k) are work arrays.
    """
    pressure_responses(problem, grid, work, cavitated, step, given)
    temperature_step(problem, grid, work.film, work.heat, given, 0.0, step_t)
    change[:] = 0.0
    add_temperature_changes(work, cavitated, step_t, given, change)
    substitute(factors, pivots, change)


@inner_kernel
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
    """Compute the Newton step from the linearised equations: `step` (n + 1,) in (P, H0), and `step_t` (n, k) in T.

    The factored Jacobian neglects the transport of heat between columns. GMRES corrects the step for this transport,
    with the Jacobian as preconditioner. If a single correction is enough, GMRES is not started. The step satisfies the
    balance of load after any number of corrections, because the Jacobian contains this balance without approximation.
    """
    n, nodes = step_t.shape
    given, change = np.zeros((n, nodes)), np.zeros(n + 1)
    temperature_step(problem, grid, work.film, work.heat, given, 1.0, step_t)
    add_temperature_changes(work, cavitated, step_t, given, residual)
    copy(-residual, step, n + 1)
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
        copy(-change / rest, basis[0], n + 1)
        rhs[0], count = rest, 0
        while count < KRYLOV and rest > KRYLOV_TOLERANCE * norm:
            transport_response(problem, grid, work, cavitated, factors, pivots, basis[count], given, step_t, change)
            copy(basis[count] + change, basis[count + 1], n + 1)
            rest = extend_basis(basis, hessenberg, rotations, rhs, count)
            count += 1
        combine_basis(basis, hessenberg, rhs, count, step)
    pressure_responses(problem, grid, work, cavitated, step, given)
    temperature_step(problem, grid, work.film, work.heat, given, 1.0, step_t)


@inner_kernel
def factor_jacobian(
    problem: Problem, grid: Grid, state: State, work: Work, jacobian: FloatArray, pivots: IntArray
) -> None:
    """Assemble and factor the system for (P, H0), including the response of each column's temperatures."""
    include_temperature(work)
    mass_flux_slopes(problem, grid, work.height, work.gradient, state.cavitated, work.coefficients, work.faces)
    assemble_jacobian(grid, state.cavitated, work.faces, jacobian)
    factor(jacobian, pivots)


@inner_kernel
def take_step(grid: Grid, state: State, step: FloatArray, step_t: FloatArray, scale: float) -> tuple[float, bool]:
    """Change all unknowns by `scale` times the step, or by less if the film would close (`apply_pressure_step`)."""
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
    """Solve for (T, P, H0) together by Newton's method, in place; return whether the iteration converged.

    `work` receives all quantities of the solution. The iteration has converged if four conditions hold: the steps of
    pressure and temperature are within tolerance, the steps were not shortened, the broken film has not changed, and no
    pressure gradient was limited. A step that is too long is computed again with damped temperatures (implicit
    pseudo-time). The damping decreases as the steps shrink. If the steps stop shrinking, only a part of each step is
    taken.
    """
    n, nodes = state.temperature.shape
    jacobian, residual = np.empty((n + 1, n + 1)), np.empty(n + 1)
    pivots, step, step_t = np.empty(n + 1, np.int64), np.zeros(n + 1), np.zeros((n, nodes))
    damping, before, before_t, relaxation, near = 0.0, np.inf, np.inf, 1.0, False
    for iteration in range(max_iterations):
        state.history[0].iterations += 1.0
        limited = evaluate_state(problem, grid, state, work)
        tolerance = 0.0 if iteration < PATIENCE else RUPTURE_TOLERANCE
        changed = release_cavitated(work.faces, state.cavitated, tolerance)
        linearise_state(problem, state, work, damping)
        factor_columns(NEXT, n, work.film, work.heat)
        fresh = changed or limited or not near
        if fresh:
            factor_jacobian(problem, grid, state, work, jacobian, pivots)
        balance_of_mass(grid, state.pressure, state.cavitated, work.faces, residual)
        newton_step(problem, grid, work, state.cavitated, jacobian, pivots, residual, step, step_t)
        inlet_step(problem, work, state.temperature, step_t)
        last_p, last_t = np.abs(step[:n]).max(), np.abs(step_t).max()
        if not (np.isfinite(last_p) and np.isfinite(last_t) and np.isfinite(step[n])):
            return False
        state.history[0].pressure_change, state.history[0].temperature_change = last_p, last_t
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
            evaluate_state(problem, grid, state, work)
            return True
        near = last_p < SHORT_STEP and shrinking and undamped and not joined and taken == 1.0
    return False
