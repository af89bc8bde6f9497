"""The isothermal contact: rheology in closed form and Newton's method for (P, H0) with an active set."""

import numpy as np

from solvers.arrays import BoolArray, FloatArray
from solvers.compiled import kernel
from solvers.contact.ehl.problem import Problem
from solvers.contact.ehl.reynolds import (
    PATIENCE,
    RUPTURE_TOLERANCE,
    BY_G,
    BY_H,
    BY_P,
    VALUE,
    FaceFluxes,
    FlowCoefficients,
    assemble_faces,
    assemble_system,
    film_shape,
    pressure_gradients,
    release_cavitated,
)
from solvers.lubricants import density, log_viscosity, pressure_part

STRESS_LIMIT = 300.0  # of |h dp/dx| / (2 tau0): exp(300)^2 is still a number


@kernel
def uniform_film(problem: Problem, p: float, g: float, h: float, log_a: FloatArray, b: FloatArray) -> float:
    """Coefficients of one column at the inlet temperature, into log_a and b (5,); returns the mid-film stress [Pa].

    `g` is h dp/dx. Newtonian: A = rho/(12 eta). Ree-Eyring with s = g/(2 tau0): sinh a = eta du s/(tau0 h sinh s) and
    A = rho/(12 eta) cosh a 3 (s cosh s - sinh s)/s^3, the mid-film stress being tau0 a.
    """
    laws = problem.laws
    term, term_slope = pressure_part(laws, p)
    log_eta, eta_slope, _ = log_viscosity(laws, term, problem.inlet)
    by_p = eta_slope * term_slope
    rho, rho_slope, _ = density(laws, p, problem.inlet)
    um, du = 0.5 * (problem.speed_1 + problem.speed_2), problem.speed_2 - problem.speed_1
    log_a[:] = 0.0
    b[:] = 0.0
    b[VALUE], b[BY_P] = rho * um, rho_slope * um
    log_a[VALUE], log_a[BY_P] = np.log(rho / 12.0) - log_eta, rho_slope / rho - by_p
    if problem.newtonian == 1:
        return np.exp(log_eta) * du / h
    tau0 = problem.eyring_stress
    s = min(abs(g) / (2.0 * tau0), STRESS_LIMIT)
    if s < 1e-2:
        log_sigma, sigma_slope = -s * s / 6.0, -s / 3.0
        log_phi, phi_slope = s * s / 10.0, s / 5.0
    else:
        sinh, cosh = np.sinh(s), np.cosh(s)
        log_sigma, sigma_slope = np.log(s / sinh), 1.0 / s - cosh / sinh
        moment = s * cosh - sinh
        log_phi, phi_slope = np.log(3.0 * moment / s**3), s * sinh / moment - 3.0 / s
    sinh_a = np.exp(log_eta + log_sigma) * du / (tau0 * h)
    share = sinh_a * sinh_a / (1.0 + sinh_a * sinh_a)
    log_a[VALUE] += 0.5 * np.log1p(sinh_a * sinh_a) + log_phi
    log_a[BY_P] += share * by_p
    log_a[BY_H] = -share / h
    log_a[BY_G] = (share * sigma_slope + phi_slope) * np.sign(g) / (2.0 * tau0)
    return tau0 * np.arcsinh(sinh_a)


@kernel
def solve_pressure(
    problem: Problem,
    x: FloatArray,
    deflection: FloatArray,
    weights: FloatArray,
    pressure: FloatArray,
    h0: float,
    cavitated: BoolArray,
    stress: FloatArray,
    coefficients: FlowCoefficients,
    faces: FaceFluxes,
    max_iterations: int,
    tolerance: float,
) -> tuple[float, int, float]:
    """Newton for (P, H0) from the pressures given, in place; returns H0, iterations and the last max|dP| (inf: failed).

    Pressure changes are clipped node by node; a node behind the centre whose pressure falls below zero joins the
    broken film, and leaves it when more oil flows in than out.
    """
    n = x.size
    film, gradient = np.empty(n), np.empty(n)
    trial, trial_film = np.empty(n), np.empty(n)
    jacobian, residual = np.empty((n + 1, n + 1)), np.empty(n + 1)
    last = np.inf
    for iteration in range(max_iterations):
        cavitated[n - 1] = cavitated[n - 2]
        film_shape(x, deflection, pressure, h0, film)
        pressure_gradients(x, pressure, cavitated, gradient)
        slope = problem.maximum_pressure / problem.half_width
        for i in range(n):
            h = film[i] * problem.gap_scale
            stress[i] = uniform_film(
                problem,
                pressure[i] * problem.maximum_pressure,
                h * gradient[i] * slope,
                h,
                coefficients.log_a[i],
                coefficients.b[i],
            )
        assemble_faces(problem, x, pressure, film, gradient, cavitated, coefficients, faces)
        changed = release_cavitated(faces, cavitated, 0.0 if iteration < PATIENCE else RUPTURE_TOLERANCE)
        if not changed and last < tolerance:
            return h0, iteration, last
        assemble_system(x, deflection, weights, pressure, cavitated, faces, jacobian, residual)
        step = np.linalg.solve(jacobian, -residual)
        if not np.all(np.isfinite(step)):
            return h0, iteration, np.inf
        clip = 0.3 if iteration < 5 else 0.5
        last = 0.0
        for i in range(n):
            last = max(last, abs(step[i]))
            step[i] = min(max(step[i], -clip), clip)
        scale = 1.0
        for _ in range(12):
            for i in range(n):
                trial[i] = pressure[i] + scale * step[i]
                if x[i] > 0.0 and trial[i] < 0.0:
                    trial[i] = 0.0
            film_shape(x, deflection, trial, h0 + scale * step[n], trial_film)
            if trial_film.min() > 0.0:
                break
            scale *= 0.5
        for i in range(1, n - 1):
            if x[i] > 0.0 and pressure[i] + scale * step[i] < 0.0 and not cavitated[i]:
                cavitated[i] = True
                changed = True
            pressure[i] = trial[i]
        h0 += scale * step[n]
        if scale < 1.0 or changed:
            last = max(last, 1.0)
    return h0, max_iterations, np.inf
