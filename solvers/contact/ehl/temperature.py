"""Temperatures computed column by column along the flow: the first guess, and the linear step of Newton's method."""

import numpy as np

from solvers.arrays import FloatArray, copy
from solvers.compiled import inlined_kernel, inner_kernel, kernel
from solvers.contact.ehl.flow import evaluate_columns, linearise_columns
from solvers.contact.ehl.grid import Grid
from solvers.contact.ehl.heat import (
    Convection,
    Heat,
    balance_columns,
    face_edges,
    factor_columns,
    linearise_balances,
    solve_column,
)
from solvers.contact.ehl.linear_algebra import add_scaled, row_product
from solvers.contact.ehl.problem import Problem
from solvers.contact.ehl.reynolds import film_shape
from solvers.contact.ehl.shear import Film
from solvers.contact.ehl.state import State, Work

LARGEST_STEP = 40.0  # K, largest change of a temperature in one iteration of a column
COLUMN_ITERATIONS = 60  # limit; a column that has not converged by then does not converge at all
REVERSE_SWEEPS = 3  # number of sweeps if there is reverse flow, chosen; all sweeps but the last also run backward


@kernel
def march_temperatures(problem: Problem, grid: Grid, state: State, work: Work) -> None:
    """First guess of the temperatures at given pressures, column by column in Couette flow of equal mass flux.

    Each starts from the column before, so that all stay on the same branch of solutions.
    """
    film, heat, temperature = work.film, work.heat, state.temperature
    n, nodes = temperature.shape
    step = np.zeros((n, nodes))
    film_shape(grid, state.pressure, state.separation[0], work.height)
    u1, u2 = problem.speed_1, problem.speed_2
    flux = problem.laws.density * 0.5 * (u1 + u2) * work.height[np.abs(grid.x).argmin()] * problem.gap_scale
    for k in range(nodes):
        zeta = k / (nodes - 1)
        film.flow.stream[:, k] = flux * (u1 * zeta + 0.5 * (u2 - u1) * zeta * zeta) / (0.5 * (u1 + u2))
    face_edges(film.flow.stream, heat.convection.edges)
    temperature[0] = problem.inlet
    temperature[0, 0], temperature[0, nodes - 1] = problem.bulk_1, problem.bulk_2
    heat.surfaces.flux_1[0], heat.surfaces.flux_2[0] = 0.0, 0.0
    heat.fluid_fraction[:] = 1.0
    for i in range(n):
        work.at[i].p = max(state.pressure[i], 0.0) * problem.maximum_pressure
        work.at[i].g, work.at[i].h = 0.0, work.height[i] * problem.gap_scale
    for i in range(1, n):
        copy(temperature[i - 1], temperature[i], nodes)
        for _ in range(COLUMN_ITERATIONS):
            evaluate_columns(problem, temperature, i, i + 1, work.at, film, work.coefficients)
            linearise_columns(problem, i, i + 1, work.at, film, work.coefficients)
            balance_columns(problem, grid, temperature, i, i + 1, work.at, film, heat)
            linearise_balances(problem, temperature, i, i + 1, work.at, 0.0, film, heat)
            factor_columns(i, i + 1, film, heat)
            copy(-heat.column.residual[i], step[i], nodes)
            solve_column(i, film, heat, step)
            largest = np.abs(step[i]).max()
            add_scaled(min(1.0, LARGEST_STEP / max(largest, LARGEST_STEP)), step[i], temperature[i])
            if largest < 0.1:
                break


@inner_kernel
def last_reverse(convection: Convection) -> int:
    """Return the last column into which oil flows from its right neighbour; 0 if there is no such column."""
    n, nodes = convection.from_right.shape
    for i in range(n - 2, 0, -1):
        for k in range(nodes):
            if convection.from_right[i, k] > 0.0:
                return i
    return 0


@inlined_kernel
def _relax_column(i: int, film: Film, heat: Heat, given: FloatArray, weight: float, step: FloatArray) -> None:
    """Temperature step of column i from the latest steps beside it; see `temperature_step`."""
    from_left, from_right, residual = heat.convection.from_left, heat.convection.from_right, heat.column.residual
    n, m = step.shape[0], step.shape[1] - 1
    for k in range(m + 1):
        inflow = from_left[i, k] * step[i - 1, k]
        if i + 1 < n:
            inflow += from_right[i, k] * step[i + 1, k]
        step[i, k] = inflow - weight * residual[i, k]
    step[i, 0] += heat.surfaces.walls[i].change_1
    step[i, m] += heat.surfaces.walls[i].change_2
    solve_column(i, film, heat, step)
    for k in range(m + 1):
        step[i, k] += given[i, k]


@inner_kernel
def temperature_step(
    problem: Problem, grid: Grid, film: Film, heat: Heat, given: FloatArray, weight: float, step: FloatArray
) -> None:
    """Solve the linearised heat balance of all columns for the temperature step `step` (n, k).

    `given` (n, k) is the temperature change that a change of pressure causes if the temperatures upstream are fixed.
    `weight` multiplies the residual. It is 1 for a Newton step, and 0 to compute only the effect of `given`.

    The columns are solved one after the other along the flow. If oil flows backward in some columns, the columns up to
    the last of these are first solved several times, alternately along the flow and against the flow.
    """
    n, last = step.shape[0], step.shape[1] - 1
    surfaces, residual = heat.surfaces, heat.column.residual
    flux_1, flux_2 = np.zeros(n), np.zeros(n)
    reverse = last_reverse(heat.convection)
    step[:, :] = 0.0
    for sweep in range(REVERSE_SWEEPS if reverse > 0 else 1):
        final = sweep == REVERSE_SWEEPS - 1 or reverse == 0
        for i in range(1, n if final else reverse + 1):
            surfaces.walls[i].change_1 = problem.surface_heating_1 * row_product(grid.heat, i, 0, i, flux_1)
            surfaces.walls[i].change_2 = problem.surface_heating_2 * row_product(grid.heat, i, 0, i, flux_2)
            _relax_column(i, film, heat, given, weight, step)
            own_1 = step[i, 0] - surfaces.walls[i].change_1 + weight * residual[i, 0]
            own_2 = step[i, last] - surfaces.walls[i].change_2 + weight * residual[i, last]
            flux_1[i], flux_2[i] = own_1 / surfaces.walls[i].gain_1, own_2 / surfaces.walls[i].gain_2
        if not final:
            for i in range(reverse - 1, 0, -1):
                _relax_column(i, film, heat, given, weight, step)


@inner_kernel
def inlet_step(problem: Problem, work: Work, temperature: FloatArray, step: FloatArray) -> None:
    """Temperature step of the first column `step` (n, k), in place (Eq. E8.3).

    Walls have their bulk temperatures, inflow that of the inlet, backflow that of the second column; where oil flows in
    follows from mass flux and uniform viscosity, not from the computed temperatures.
    """
    nodes = step.shape[1]
    u1, u2 = problem.speed_1, problem.speed_2
    mean = work.film.flow.stream[0, nodes - 1] / (problem.laws.density * work.at[0].h)
    step[0, 0] = problem.bulk_1 - temperature[0, 0]
    step[0, nodes - 1] = problem.bulk_2 - temperature[0, nodes - 1]
    for k in range(1, nodes - 1):
        zeta = k / (nodes - 1)
        speed = u1 * (1.0 - zeta) + u2 * zeta + 6.0 * (mean - 0.5 * (u1 + u2)) * zeta * (1.0 - zeta)
        if speed < 0.0:
            step[0, k] = temperature[1, k] + step[1, k] - temperature[0, k]
        else:
            step[0, k] = problem.inlet - temperature[0, k]
