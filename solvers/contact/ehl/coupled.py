"""One Newton iteration for all unknowns of the thermal contact: temperature columns, pressures, separation."""

import numpy as np

from solvers.arrays import BoolArray, FloatArray
from solvers.compiled import kernel
from solvers.contact.ehl.column import Film, evaluate_column, limited_gradient
from solvers.contact.ehl.energy import (
    Heat,
    column_balance,
    factor_column,
    solve_column,
    solve_responses,
    surface_history,
)
from solvers.contact.ehl.krylov import combine_basis, extend_basis
from solvers.contact.ehl.problem import Problem
from solvers.contact.ehl.reynolds import (
    BY_G,
    BY_H,
    BY_P,
    PATIENCE,
    RUPTURE_TOLERANCE,
    VALUE,
    FaceFluxes,
    FlowCoefficients,
    add_flux_changes,
    assemble_faces,
    assemble_system,
    film_shape,
    pressure_gradients,
    release_cavitated,
)

REVERSE_SWEEPS = 3
KRYLOV = 10
KRYLOV_TOLERANCE = 0.01


@kernel
def evaluate_flow(
    problem: Problem,
    pressure: FloatArray,
    film_height: FloatArray,
    gradient: FloatArray,
    temperature: FloatArray,
    film: Film,
    coefficients: FlowCoefficients,
) -> bool:
    """Stress and flow of every column; whether the guard on the pressure gradient acted."""
    above = np.empty(film.stress.shape[1])
    slope = problem.maximum_pressure / problem.half_width
    limited = False
    for i in range(pressure.size):
        h = film_height[i] * problem.gap_scale
        g = h * gradient[i] * slope
        bounded = limited_gradient(problem, g)
        limited = limited or bounded != g
        p = pressure[i] * problem.maximum_pressure
        evaluate_column(problem, i, temperature[i], p, bounded, h, film, coefficients, above)
    return limited


@kernel
def match_stream(
    problem: Problem,
    pressure: FloatArray,
    film_height: FloatArray,
    cavitated: BoolArray,
    coefficients: FlowCoefficients,
    faces: FaceFluxes,
    film: Film,
    heat: Heat,
) -> float:
    """Make every column carry the same mass; fills the fluid fraction and returns the mass flux [kg/(m s)].

    The flux is taken where the pressure is largest, since there it does not depend on the pressure gradient. A full
    column makes up for what the surfaces do not drag with the profile of pressure flow; a broken one keeps
    the profile of the last full one in a fraction of the gap. So convection conserves mass on the way to the solution, too.
    """
    flux = faces.flux[pressure.argmax()] * problem.flux_scale
    last = film.stream.shape[1] - 1
    for i in range(pressure.size):
        heat.fluid_fraction[i] = 1.0
        if cavitated[i]:
            gap_flux = coefficients.b[i, VALUE] * film_height[i] * problem.gap_scale
            heat.fluid_fraction[i] = min(flux / gap_flux, 1.0)
            film.stream[i] = film.stream[i - 1]
        else:
            defect = flux - film.couette[i, last]
            for k in range(last + 1):
                film.stream[i, k] = film.couette[i, k] + defect * film.poiseuille[i, k]
    return flux


@kernel
def balance_columns(
    problem: Problem,
    weights: FloatArray,
    surface_matrix: FloatArray,
    film_height: FloatArray,
    gradient: FloatArray,
    temperature: FloatArray,
    damping: float,
    film: Film,
    heat: Heat,
) -> None:
    """Heat balance of every column at the present temperatures."""
    slope = problem.maximum_pressure / problem.half_width
    heat.flux_1[0], heat.flux_2[0] = 0.0, 0.0
    for i in range(1, weights.size):
        h = film_height[i] * problem.gap_scale
        g = limited_gradient(problem, h * gradient[i] * slope)
        surface_history(problem, i, surface_matrix, heat)
        column_balance(problem, i, weights[i] * problem.half_width, temperature, g, h, damping, film, heat)


@kernel
def _last_reverse(heat: Heat) -> int:
    """The last column into which oil flows from the right."""
    last = 0
    for i in range(1, heat.from_right.shape[0] - 1):
        for k in range(heat.from_right.shape[1]):
            if heat.from_right[i, k] > 0.0:
                last = i
    return last


@kernel
def _relax_column(i: int, film: Film, heat: Heat, given: FloatArray, weight: float, step: FloatArray) -> None:
    """Temperature step of column i from those of its neighbours and of the surfaces upstream; `given` is added.

    The residual counts with `weight`; heat.change_1 and change_2 hold the flash temperatures' steps from upstream.
    """
    n, m = step.shape[0], step.shape[1] - 1
    for k in range(m + 1):
        inflow = heat.from_left[i, k] * step[i - 1, k]
        if i + 1 < n:
            inflow += heat.from_right[i, k] * step[i + 1, k]
        if k == 0:
            inflow = inflow * heat.gain_1[i] + heat.change_1[i]
        elif k == m:
            inflow = inflow * heat.gain_2[i] + heat.change_2[i]
        step[i, k] = inflow - weight * heat.residual[i, k]
    solve_column(i, film, heat, step)
    for k in range(m + 1):
        step[i, k] += given[i, k]


@kernel
def temperature_step(
    problem: Problem,
    surface_matrix: FloatArray,
    film: Film,
    heat: Heat,
    given: FloatArray,
    weight: float,
    step: FloatArray,
) -> None:
    """Solve the linearised heat balance of all columns for `step` (n, k), with the responses `given` to pressure.

    A march along the flow; columns with reverse flow are swept backward in between, their right neighbours lagging.
    `weight` is 1 for a Newton step and 0 for the derivative alone.
    """
    n, last = step.shape[0], step.shape[1] - 1
    flux_1, flux_2 = np.zeros(n), np.zeros(n)
    reverse = _last_reverse(heat)
    step[:, :] = 0.0
    for sweep in range(REVERSE_SWEEPS if reverse > 0 else 1):
        final = sweep == REVERSE_SWEEPS - 1 or reverse == 0
        for i in range(1, n if final else reverse + 1):
            heat.change_1[i] = _history(problem.surface_heating_1, surface_matrix, flux_1, i)
            heat.change_2[i] = _history(problem.surface_heating_2, surface_matrix, flux_2, i)
            _relax_column(i, film, heat, given, weight, step)
            own_1 = step[i, 0] - heat.change_1[i] + weight * heat.residual[i, 0]
            own_2 = step[i, last] - heat.change_2[i] + weight * heat.residual[i, last]
            flux_1[i], flux_2[i] = own_1 / heat.gain_1[i], own_2 / heat.gain_2[i]
        if not final:
            for i in range(reverse - 1, 0, -1):
                _relax_column(i, film, heat, given, weight, step)


@kernel
def _history(surface_heating: float, surface_matrix: FloatArray, flux: FloatArray, i: int) -> float:
    total = 0.0
    for j in range(i):
        total += surface_matrix[i, j] * flux[j]
    return surface_heating * total


@kernel
def inlet_step(problem: Problem, film: Film, temperature: FloatArray, step: FloatArray) -> None:
    """First column of `step`: oil enters at the inlet temperature, and leaves at that of the column behind it."""
    for k in range(1, step.shape[1] - 1):
        if film.stream[0, k + 1] < film.stream[0, k - 1]:
            step[0, k] = temperature[1, k] + step[1, k] - temperature[0, k]
        else:
            step[0, k] = problem.inlet - temperature[0, k]


@kernel
def include_temperature(coefficients: FlowCoefficients, film: Film, heat: Heat) -> None:
    """Make the derivatives of A and B total: with the response of temperature."""
    n, nodes = heat.by_p.shape
    for i in range(1, n):
        for k in range(nodes):
            a, b = film.log_a_by_temperature[i, k], film.b_by_temperature[i, k]
            coefficients.log_a[i, BY_P] += a * heat.by_p[i, k]
            coefficients.log_a[i, BY_G] += a * heat.by_g[i, k]
            coefficients.log_a[i, BY_H] += a * heat.by_h[i, k]
            coefficients.b[i, BY_P] += b * heat.by_p[i, k]
            coefficients.b[i, BY_G] += b * heat.by_g[i, k]
            coefficients.b[i, BY_H] += b * heat.by_h[i, k]


@kernel
def add_temperature_changes(
    faces: FaceFluxes, cavitated: BoolArray, film: Film, step: FloatArray, given: FloatArray, residual: FloatArray
) -> None:
    """Add to `residual` what a temperature step does to the balance of mass, beyond the responses `given`."""
    n, nodes = step.shape
    log_a, b = np.zeros(n), np.zeros(n)
    for i in range(1, n):
        for k in range(nodes):
            change = step[i, k] - given[i, k]
            log_a[i] += film.log_a_by_temperature[i, k] * change
            b[i] += film.b_by_temperature[i, k] * change
    add_flux_changes(faces, cavitated, log_a, b, residual)


@kernel
def pressure_responses(
    problem: Problem,
    x: FloatArray,
    deflection: FloatArray,
    film_height: FloatArray,
    gradient: FloatArray,
    cavitated: BoolArray,
    step: FloatArray,
    heat: Heat,
    given: FloatArray,
) -> None:
    """Temperature change that the step (n + 1,) in (P, H0) implies at fixed upstream temperatures, into `given`."""
    n = x.size
    change, slopes = np.empty(n), np.empty(n)
    film_shape(x, deflection, step[:n], step[n], change)
    pressure_gradients(x, step[:n], cavitated, slopes)
    slope = problem.maximum_pressure / problem.half_width
    for i in range(n):
        dp = step[i] * problem.maximum_pressure
        dh = (change[i] - 0.5 * x[i] ** 2) * problem.gap_scale
        dg = slope * (slopes[i] * film_height[i] * problem.gap_scale + gradient[i] * dh)
        for k in range(given.shape[1]):
            given[i, k] = heat.by_p[i, k] * dp + heat.by_g[i, k] * dg + heat.by_h[i, k] * dh


@kernel
def newton_step(
    problem: Problem,
    x: FloatArray,
    deflection: FloatArray,
    surface_matrix: FloatArray,
    film_height: FloatArray,
    gradient: FloatArray,
    cavitated: BoolArray,
    faces: FaceFluxes,
    film: Film,
    heat: Heat,
    jacobian: FloatArray,
    residual: FloatArray,
    step: FloatArray,
    step_t: FloatArray,
) -> int:
    """Step in (P, H0) and T from the linearised equations; returns the products it took.

    The Jacobian knows how each column responds to its own pressure; what it passes on to the columns downstream, as
    heat in oil and surfaces, enters through GMRES, preconditioned with the inverse Jacobian.
    """
    n, nodes = step_t.shape
    given = np.zeros((n, nodes))
    basis, hessenberg = np.zeros((KRYLOV + 1, n + 1)), np.zeros((KRYLOV, KRYLOV))
    rotations, rhs = np.zeros((KRYLOV, 2)), np.zeros(KRYLOV + 1)
    inverse = np.linalg.inv(jacobian)
    temperature_step(problem, surface_matrix, film, heat, given, 1.0, step_t)
    add_temperature_changes(faces, cavitated, film, step_t, given, residual)
    start = -np.dot(inverse, residual)
    norm = np.sqrt(np.dot(start, start))
    if not (np.isfinite(norm) and norm > 0.0):
        step[:] = start
        return 0
    basis[0] = start / norm
    rhs[0] = norm
    change = np.zeros(n + 1)
    count = 0
    while count < KRYLOV:
        pressure_responses(problem, x, deflection, film_height, gradient, cavitated, basis[count], heat, given)
        temperature_step(problem, surface_matrix, film, heat, given, 0.0, step_t)
        change[:] = 0.0
        add_temperature_changes(faces, cavitated, film, step_t, given, change)
        basis[count + 1] = basis[count] + np.dot(inverse, change)
        remaining = extend_basis(basis, hessenberg, rotations, rhs, count)
        count += 1
        if remaining < KRYLOV_TOLERANCE * norm:
            break
    combine_basis(basis, hessenberg, rhs, count, step)
    pressure_responses(problem, x, deflection, film_height, gradient, cavitated, step, heat, given)
    temperature_step(problem, surface_matrix, film, heat, given, 1.0, step_t)
    return count


@kernel
def solve_coupled(
    problem: Problem,
    x: FloatArray,
    deflection: FloatArray,
    weights: FloatArray,
    surface_matrix: FloatArray,
    pressure: FloatArray,
    h0: float,
    temperature: FloatArray,
    cavitated: BoolArray,
    coefficients: FlowCoefficients,
    faces: FaceFluxes,
    film: Film,
    heat: Heat,
    damping: float,
    max_iterations: int,
    pressure_tolerance: float,
    temperature_tolerance: float,
) -> tuple[float, int, float, float, bool]:
    """Simultaneous Newton for (T, P, H0) in place; returns H0, iterations, last max|dP|, max|dT| [K], converged."""
    n, nodes = temperature.shape
    film_height, gradient, trial = np.empty(n), np.empty(n), np.empty(n)
    jacobian, residual = np.empty((n + 1, n + 1)), np.empty(n + 1)
    step, step_t = np.zeros(n + 1), np.zeros((n, nodes))
    last_p, last_t = np.inf, np.inf
    before, relaxation = np.inf, 1.0
    for iteration in range(max_iterations):
        cavitated[n - 1] = cavitated[n - 2]
        film_shape(x, deflection, pressure, h0, film_height)
        pressure_gradients(x, pressure, cavitated, gradient)
        limited = evaluate_flow(problem, pressure, film_height, gradient, temperature, film, coefficients)
        assemble_faces(problem, x, pressure, film_height, gradient, cavitated, coefficients, faces)
        match_stream(problem, pressure, film_height, cavitated, coefficients, faces, film, heat)
        balance_columns(problem, weights, surface_matrix, film_height, gradient, temperature, damping, film, heat)
        for i in range(1, n):
            factor_column(i, film, heat)
            solve_responses(i, film, heat)
        changed = release_cavitated(faces, cavitated, 0.0 if iteration < PATIENCE else RUPTURE_TOLERANCE)
        include_temperature(coefficients, film, heat)
        assemble_faces(problem, x, pressure, film_height, gradient, cavitated, coefficients, faces)
        assemble_system(x, deflection, weights, pressure, cavitated, faces, jacobian, residual)
        newton_step(
            problem, x, deflection, surface_matrix, film_height, gradient, cavitated, faces, film, heat,
            jacobian, residual, step, step_t,
        )
        inlet_step(problem, film, temperature, step_t)
        last_p, last_t = np.abs(step[:n]).max(), np.abs(step_t).max()
        if not (np.isfinite(last_p) and np.isfinite(last_t) and np.isfinite(step[n])):
            return h0, iteration, np.inf, np.inf, False
        scale = min(1.0, 0.3 / max(last_p, 1e-300), 40.0 / max(last_t, 1e-300))
        used = damping
        if scale < 0.2 and damping < 1e4:
            damping = max(10.0 * damping, 30.0)
            continue
        if scale == 1.0 and last_p < 0.1:
            damping = 0.2 * damping if damping > 0.15 else 0.0
        if iteration > PATIENCE:
            relaxation = max(0.7 * relaxation, 0.3) if last_p > 0.7 * before else min(1.5 * relaxation, 1.0)
        before = last_p
        converged = (
            used == 0.0
            and scale == 1.0
            and not changed
            and not limited
            and last_p < pressure_tolerance
            and last_t < temperature_tolerance
        )
        if not converged:
            scale = min(scale, relaxation)
        for _ in range(12):
            for i in range(n):
                trial[i] = pressure[i] + scale * step[i]
                if x[i] > 0.0 and trial[i] < 0.0:
                    trial[i] = 0.0
            film_shape(x, deflection, trial, h0 + scale * step[n], film_height)
            if film_height.min() > 0.0:
                break
            scale *= 0.5
        for i in range(1, n - 1):
            if x[i] > 0.0 and pressure[i] + scale * step[i] < 0.0 and not cavitated[i]:
                cavitated[i] = True
                changed = True
            pressure[i] = trial[i]
        h0 += scale * step[n]
        for i in range(n):
            for k in range(nodes):
                temperature[i, k] = max(temperature[i, k] + scale * step_t[i, k], 200.0)
        if converged:
            return h0, iteration + 1, last_p, last_t, True
    return h0, max_iterations, last_p, last_t, False
