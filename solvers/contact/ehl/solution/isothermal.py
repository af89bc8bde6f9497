"""The isothermal contact: rheology in closed form and Newton's method for (P, H0) with an active set."""

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.contact.ehl.film.fluxes import BY_G, BY_H, BY_P, VALUE, assemble_faces, film_shape, pressure_gradients
from solvers.contact.ehl.film.reynolds import (
    PATIENCE,
    RUPTURE_TOLERANCE,
    apply_pressure_step,
    assemble_jacobian,
    balance_of_mass,
    release_cavitated,
)
from solvers.contact.ehl.film.shear import STRESS_LIMIT
from solvers.contact.ehl.grid.dense import solved
from solvers.contact.ehl.grid.mesh import Grid
from solvers.contact.ehl.problem import Problem
from solvers.contact.ehl.solution.state import State, Work, fluid_fractions
from solvers.lubricants import density, log_viscosity, pressure_part

EARLY = 5  # iterations with a tighter clip


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
        return float(np.exp(log_eta) * du / h)
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
    return float(tau0 * np.arcsinh(sinh_a))


@kernel
def evaluate_isothermal(problem: Problem, grid: Grid, state: State, work: Work) -> None:
    """Film, stress and flow of every column at the inlet temperature. Film that is broken reaches the end."""
    state.cavitated[-1] = state.cavitated[-2]
    film_shape(grid, state.pressure, state.separation[0], work.height)
    pressure_gradients(grid.x, state.pressure, state.cavitated, work.gradient)
    slope = problem.maximum_pressure / problem.half_width
    for i in range(grid.x.size):
        h = work.height[i] * problem.gap_scale
        p, g = state.pressure[i] * problem.maximum_pressure, h * work.gradient[i] * slope
        coefficients = work.coefficients
        work.film.mid.stress[i] = uniform_film(problem, p, g, h, coefficients.log_a[i], coefficients.b[i])
    assemble_faces(
        problem, grid.x, state.pressure, work.height, work.gradient, state.cavitated, work.coefficients, work.faces
    )


@kernel
def solve_isothermal(
    problem: Problem, grid: Grid, state: State, work: Work, max_iterations: int, tolerance: float
) -> bool:
    """Newton for (P, H0) from the pressures given, in place; whether it converged. It is evaluated into `work`.

    Pressure changes are first clipped node by node, later scaled as a whole; a node behind the centre whose pressure
    falls below zero joins the broken film, and leaves it when more oil flows in than out.
    """
    n = grid.x.size
    jacobian, residual, step = np.empty((n + 1, n + 1)), np.empty(n + 1), np.empty(n + 1)
    for iteration in range(max_iterations):
        state.history[0] += 1.0
        evaluate_isothermal(problem, grid, state, work)
        rupture_tolerance = 0.0 if iteration < PATIENCE else RUPTURE_TOLERANCE
        changed = release_cavitated(work.faces, state.cavitated, rupture_tolerance)
        balance_of_mass(grid, state.pressure, state.cavitated, work.faces, residual)
        assemble_jacobian(grid, state.cavitated, work.faces, jacobian)
        if not solved(jacobian, residual, step):
            return False
        largest = np.abs(step[:n]).max()
        state.history[1] = largest
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
