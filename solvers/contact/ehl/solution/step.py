"""One Newton step for all unknowns of the thermal contact at once: temperatures, pressures, separation."""

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
from solvers.contact.ehl.film.reynolds import assemble_jacobian
from solvers.contact.ehl.grid.dense import dot, factor, substitute
from solvers.contact.ehl.grid.mesh import Grid
from solvers.contact.ehl.problem import Problem
from solvers.contact.ehl.solution.krylov import combine_basis, extend_basis
from solvers.contact.ehl.solution.state import State, Work
from solvers.contact.ehl.solution.temperature import temperature_step

KRYLOV = 10
KRYLOV_TOLERANCE = 0.01


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
