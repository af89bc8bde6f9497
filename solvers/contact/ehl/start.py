"""First temperatures of a contact: one march along the flow at given pressures, shear heating only."""

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.contact.ehl.column import Film, evaluate_column
from solvers.contact.ehl.energy import Heat, column_balance, factor_column, solve_column, surface_history
from solvers.contact.ehl.problem import Problem
from solvers.contact.ehl.reynolds import FlowCoefficients

LARGEST_STEP = 40.0  # K
COLUMN_ITERATIONS = 60


@kernel
def march_temperatures(
    problem: Problem,
    x: FloatArray,
    weights: FloatArray,
    surface_matrix: FloatArray,
    pressure: FloatArray,
    film_height: FloatArray,
    temperature: FloatArray,
    coefficients: FlowCoefficients,
    film: Film,
    heat: Heat,
) -> None:
    """Fill `temperature` (n, k) [K]: columns without pressure gradient, carrying one Couette flow, solved in turn."""
    n, nodes = temperature.shape
    above = np.empty(nodes - 1)
    step = np.zeros((n, nodes))
    u1, u2 = problem.speed_1, problem.speed_2
    flux = problem.laws.density * 0.5 * (u1 + u2) * film_height[np.abs(x).argmin()] * problem.gap_scale
    for k in range(nodes):
        zeta = k / (nodes - 1)
        film.stream[:, k] = flux * (u1 * zeta + 0.5 * (u2 - u1) * zeta * zeta) / (0.5 * (u1 + u2))
        temperature[0, k] = problem.inlet
    profile = film.stream[0].copy()
    temperature[0, 0], temperature[0, nodes - 1] = problem.bulk_1, problem.bulk_2
    heat.flux_1[0], heat.flux_2[0] = 0.0, 0.0
    heat.fluid_fraction[:] = 1.0
    for i in range(1, n):
        h = film_height[i] * problem.gap_scale
        temperature[i] = temperature[i - 1]
        if i + 1 < n:
            temperature[i + 1] = temperature[i]
        surface_history(problem, i, surface_matrix, heat)
        for _ in range(COLUMN_ITERATIONS):
            p = max(pressure[i], 0.0) * problem.maximum_pressure
            evaluate_column(problem, i, temperature[i], p, 0.0, h, film, coefficients, above)
            film.stream[i] = profile
            column_balance(problem, i, weights[i] * problem.half_width, temperature, 0.0, h, 0.0, film, heat)
            factor_column(i, film, heat)
            step[i] = -heat.residual[i]
            solve_column(i, film, heat, step)
            largest = np.abs(step[i]).max()
            temperature[i] += min(1.0, LARGEST_STEP / max(largest, 1e-300)) * step[i]
            if largest < 0.1:
                break
