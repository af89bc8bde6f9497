"""Heat in the film: heat balances of finite volumes, their derivatives, and the solution column by column.

Two passes run over the columns: `balance_columns` computes the residuals, and `linearise_balances` computes their
derivatives.
"""

from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray, RecordArray, floats, records
from solvers.compiled import inlined_kernel, inner_kernel
from solvers.contact.ehl.grid import Grid
from solvers.contact.ehl.linear_algebra import row_product
from solvers.contact.ehl.problem import Problem
from solvers.contact.ehl.shear import Film


class Responses(NamedTuple):
    """Right-hand sides (n, k) of the linear systems of all columns, and later the solutions of these systems.

    `heating` is the derivative of the heat residual with respect to the mid-film stress. `by_p`, `by_g` and `by_h` are
    the right-hand sides for a change of p, of G = h dp/dx and of h. `factor_columns` solves the systems, and replaces
    every right-hand side by the solution. The solutions for p, G and h are changes of the temperatures per unit of p, G
    and h. These solutions are called the responses of the temperatures.
    """

    heating: FloatArray
    by_p: FloatArray
    by_g: FloatArray
    by_h: FloatArray


class ColumnSystem(NamedTuple):
    """Linear systems for the temperatures of all columns.

    The matrix of a column is the sum of a tridiagonal part and a rank-one part. `lower`, `pivot` and `upper` (n, k) are
    the tridiagonal part. `factor_columns` replaces these three arrays by the factors of the tridiagonal part. The
    rank-one part arises because the temperatures change the mid-film stress, and this stress changes the generated
    heat. `sherman` (n,) is the factor of the Sherman-Morrison formula, which takes the rank-one part into account.
    `residual` (n, k) is the residual of the heat balance. `squeeze` (n, k) is the heat of compression per kelvin of
    temperature and per pascal of h dp/dx [W/(m^2 K Pa)]. Here h is the film thickness.
    """

    lower: FloatArray
    pivot: FloatArray
    upper: FloatArray
    residual: FloatArray
    squeeze: FloatArray
    responses: Responses
    sherman: FloatArray


class Convection(NamedTuple):
    """Inflow into the cells from the left and right columns (n, k), and stream function at the cells' edges (n, k + 1).

    The right face of a column lies half way to the next column. `edges` holds the stream function on the right face of
    every column, at the edges between the cells and at both surfaces. The inflow is a heat capacity flux per area
    [W/(m^2 K)]. For the half cells at the walls, `linearise_balances` multiplies the inflow by a temperature rise per
    heat flux. The inflow into these half cells is then a number without unit.
    """

    from_left: FloatArray
    from_right: FloatArray
    edges: FloatArray


WALLS = floats("history_1", "history_2", "change_1", "change_2", "gain_1", "gain_2")
"""Flash temperatures of both surfaces at a column.

`history_1` and `history_2` are the flash temperatures due to the heat fluxes upstream of the column [K]. `change_1` and
`change_2` are the changes of these flash temperatures in a step [K]. `gain_1` and `gain_2` are the temperature rises
per heat flux at the column itself [K m^2/W].
"""


class Surfaces(NamedTuple):
    """Values of both surfaces at all columns (n,): heat fluxes into them [W/m^2], and a record of type WALLS."""

    flux_1: FloatArray
    flux_2: FloatArray
    walls: RecordArray


class Heat(NamedTuple):
    """Linearised heat balance of n columns with k nodes; heats of shear and compression (n,) in W/m^2."""

    column: ColumnSystem
    convection: Convection
    surfaces: Surfaces
    fluid_fraction: FloatArray
    generated: FloatArray
    compression: FloatArray


def heat_arrays(nodes: int, film_nodes: int) -> Heat:
    """Return zeroed arrays for `nodes` columns."""
    lower, pivot, upper, residual, squeeze, from_left, from_right = np.zeros((7, nodes, film_nodes))
    sherman, fluid_fraction, generated, compression = np.zeros((4, nodes))
    return Heat(
        ColumnSystem(lower, pivot, upper, residual, squeeze, Responses(*np.zeros((4, nodes, film_nodes))), sherman),
        Convection(from_left, from_right, np.zeros((nodes, film_nodes + 1))),
        Surfaces(np.zeros(nodes), np.zeros(nodes), records(nodes, WALLS)),
        fluid_fraction,
        generated,
        compression,
    )


@inner_kernel
def face_edges(stream: FloatArray, edges: FloatArray) -> None:
    """Stream function at the cell edges (n, k + 1) of each right face, half way to the next column.

    Inner edges lie half way between two nodes, the outermost on the surfaces; the last column keeps its own values.
    """
    n, nodes = stream.shape
    for i in range(n):
        here, there = stream[i], stream[min(i + 1, n - 1)]
        edges[i, 0] = 0.5 * (here[0] + there[0])
        edges[i, nodes] = 0.5 * (here[nodes - 1] + there[nodes - 1])
        for k in range(1, nodes):
            edges[i, k] = 0.25 * (here[k - 1] + here[k] + there[k - 1] + there[k])


@inlined_kernel
def surface_history(problem: Problem, i: int, surface_matrix: FloatArray, surfaces: Surfaces) -> None:
    """Gains (temperature rise per own heat flux) and flash temperatures by upstream fluxes of column i (Eq. 24)."""
    surfaces.walls[i].history_1 = problem.surface_heating_1 * row_product(surface_matrix, i, 0, i, surfaces.flux_1)
    surfaces.walls[i].history_2 = problem.surface_heating_2 * row_product(surface_matrix, i, 0, i, surfaces.flux_2)
    surfaces.walls[i].gain_1 = problem.surface_heating_1 * surface_matrix[i, i]
    surfaces.walls[i].gain_2 = problem.surface_heating_2 * surface_matrix[i, i]


@inner_kernel
def balance_columns(
    problem: Problem,
    grid: Grid,
    temperature: FloatArray,
    start: int,
    stop: int,
    at: RecordArray,
    film: Film,
    heat: Heat,
) -> None:
    """Compute the residuals of the heat balance and the heat fluxes into both surfaces, column by column.

    The cells lie around the nodes. The heat balance of a cell (Eqs. E8, E15) is c [d(psi_zeta t)/dx - d(psi_x t)/dzeta]
    = (lambda/h) t_zetazeta + h (tau rate + (0.00065 rho0/rho) t u p'). The flow across the film follows from
    continuity; Eq. 23 of the paper leaves out this flow. Half cells at the walls give the heat fluxes q1 = lambda t_z
    and q2 = -lambda t_z. Eq. 24 prints no sign, but heat must flow into both solids. The residuals of the half cells
    are converted to differences of temperature. `temperature`: temperatures (n, k) [K]; `at`: records (n,) of type
    PLACE: G = h dp/dx [Pa] and h [m] of every column.
    """
    surfaces, last = heat.surfaces, temperature.shape[1] - 1
    for i in range(start, stop):
        exchange(problem, i, grid.weights[i] * problem.half_width, at[i].h, film, heat)
        column_residual(i, temperature, at[i].g, at[i].h, film, heat)
        residual = heat.column.residual
        surfaces.flux_1[i], surfaces.flux_2[i] = -residual[i, 0], -residual[i, last]
        surface_history(problem, i, grid.heat, surfaces)
        lacking_1 = temperature[i, 0] - problem.bulk_1 - surfaces.walls[i].history_1
        lacking_2 = temperature[i, last] - problem.bulk_2 - surfaces.walls[i].history_2
        residual[i, 0] = lacking_1 + surfaces.walls[i].gain_1 * residual[i, 0]
        residual[i, last] = lacking_2 + surfaces.walls[i].gain_2 * residual[i, last]


@inlined_kernel
def exchange(problem: Problem, i: int, width: float, h: float, film: Film, heat: Heat) -> None:
    """Compute the heat that the cells of column i exchange with their neighbours, per kelvin [W/(m^2 K)].

    The exchange consists of convection, computed upwind, and of conduction. `width` is the width of the column [m]. The
    function also computes the heat of compression per kelvin and pascal, (0.00065 rho0/rho) u/h.
    """
    convection, column, edges, psi, rho = (
        heat.convection,
        heat.column,
        heat.convection.edges,
        film.flow.stream,
        film.shear.density,
    )
    m = rho.shape[1]
    conductance = heat.fluid_fraction[i] * problem.conductivity * m / h
    capacity, expansion = problem.specific_heat / width, problem.laws.density * problem.laws.thermal_expansion / h
    below = psi[i, 0]
    for k in range(m + 1):
        convection.from_left[i, k] = capacity * max(edges[i - 1, k + 1] - edges[i - 1, k], 0.0)
        convection.from_right[i, k] = capacity * max(edges[i, k] - edges[i, k + 1], 0.0)
        column.lower[i, k] = capacity * max(edges[i - 1, k] - edges[i, k], 0.0) + conductance if k > 0 else 0.0
        column.upper[i, k] = capacity * max(edges[i, k + 1] - edges[i - 1, k + 1], 0.0) + conductance if k < m else 0.0
        above = 0.5 * (psi[i, k] + psi[i, k + 1]) if k < m else psi[i, m]
        density = 0.5 * (rho[i, max(k - 1, 0)] + rho[i, min(k, m - 1)])
        column.squeeze[i, k] = expansion * (above - below) / (density * density)
        below = above


@inlined_kernel
def column_residual(i: int, temperature: FloatArray, g: float, h: float, film: Film, heat: Heat) -> None:
    """Compute the heat that the cells of column i lose, minus the heat generated in these cells [W/m^2] (Eq. E15).

    The heat is generated by shear and compression. Shear generates heat in the intervals between two nodes. Each of the
    two nodes gets half of this heat. `temperature`: temperatures (n, k) [K].
    """
    n, last = temperature.shape[0], temperature.shape[1] - 1
    column, convection, tau, rate, t = heat.column, heat.convection, film.shear.stress, film.shear.rate, temperature
    share, right, sheared, compressed, below = 0.5 * heat.fluid_fraction[i] * h / last, min(i + 1, n - 1), 0.0, 0.0, 0.0
    for k in range(last + 1):
        lost = convection.from_left[i, k] * (t[i, k] - t[i - 1, k])
        lost += convection.from_right[i, k] * (t[i, k] - t[right, k])
        lost += column.lower[i, k] * (t[i, k] - t[i, max(k - 1, 0)])
        lost += column.upper[i, k] * (t[i, k] - t[i, min(k + 1, last)])
        above = share * tau[i, k] * rate[i, k] if k < last else 0.0
        squeezed = column.squeeze[i, k] * g * t[i, k]
        column.residual[i, k] = lost - below - above - squeezed
        sheared += below + above
        compressed += squeezed
        below = above
    heat.generated[i], heat.compression[i] = sheared, compressed


@inner_kernel
def linearise_balances(
    problem: Problem,
    temperature: FloatArray,
    start: int,
    stop: int,
    at: RecordArray,
    damping: float,
    film: Film,
    heat: Heat,
) -> None:
    """Compute the derivatives of the heat balances of the columns `start` to `stop` - 1.

    `balance_columns` must have computed these columns before. The results are the tridiagonal part of the linear
    systems and their right-hand sides. Each right-hand side belongs to a change of one quantity: of the mid-film
    stress, of p, of G = h dp/dx, or of h. `damping` is an artificial heat capacity, divided by the heat conduction
    across the film. The damping makes the temperature steps shorter.
    """
    m = temperature.shape[1] - 1
    for i in range(start, stop):
        g, h = at[i].g, at[i].h
        inertia = damping * np.pi**2 * problem.conductivity / (h * m)
        conductance = heat.fluid_fraction[i] * problem.conductivity * m / h
        column_slopes(i, temperature, g, h, conductance, inertia, film, heat)
        _scale_walls(i, inertia, heat)


@inlined_kernel
def column_slopes(
    i: int, temperature: FloatArray, g: float, h: float, conductance: float, inertia: float, film: Film, heat: Heat
) -> None:
    """Tridiagonal matrix and the four right-hand sides of the heat balance of column i.

    Rows are derivatives of `column_residual` by the temperatures at fixed tau_m; the right-hand sides are its
    derivative by tau_m and the negative ones by p, G = h dp/dx and h, which include their effect on tau_m. Shear heat
    is stress times rate: temperature and p change it by the viscosity, tau_m in all intervals by the stress.
    """
    shear, mid, column, convection, last = film.shear, film.mid, heat.column, heat.convection, temperature.shape[1] - 1
    lower, upper, responses, t = column.lower, column.upper, column.responses, temperature
    dz, per_h, share = 1.0 / last, 1.0 / h, 0.5 * heat.fluid_fraction[i] * h / last
    by_p, by_g, by_h = mid.by_p[i], mid.by_g[i], mid.by_h[i]
    source, by_stress, by_t, pressed, tilted = 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(last + 1):
        exchanged = convection.from_left[i, k] + convection.from_right[i, k] + lower[i, k] + upper[i, k]
        conducted = conductance * (2.0 * t[i, k] - t[i, max(k - 1, 0)] - t[i, min(k + 1, last)])
        sources, stressed, warmed, by_pressure, by_tilt = source, by_stress, by_t, pressed, tilted
        lower[i, k] += by_t
        if k < last:
            tau, rate = shear.stress[i, k], shear.rate[i, k]
            source = share * tau * rate
            by_stress = share * (rate + tau * shear.stiffness[i, k])
            by_t = 0.5 * source * shear.by_temperature[i, k]
            pressed = source * shear.by_pressure[i, k]
            tilted = by_stress * ((k + 0.5) * dz - 0.5)
            sources, stressed, warmed = sources + source, stressed + by_stress, warmed + by_t
            by_pressure, by_tilt = by_pressure + pressed, by_tilt + tilted
            upper[i, k] += by_t
        squeeze = column.squeeze[i, k]
        column.pivot[i, k] = exchanged - warmed - squeeze * g + inertia
        responses.heating[i, k] = -stressed
        responses.by_p[i, k] = by_pressure + stressed * by_p
        responses.by_g[i, k] = by_tilt + stressed * by_g + squeeze * t[i, k]
        responses.by_h[i, k] = (conducted + sources - squeeze * g * t[i, k]) * per_h + stressed * by_h


@inlined_kernel
def _scale_walls(i: int, inertia: float, heat: Heat) -> None:
    """Turn the balances of the half cells at both walls into equations for the surface temperatures.

    They contain the inertia of a whole cell; half of it is subtracted.
    """
    column, convection, responses, walls = heat.column, heat.convection, heat.column.responses, heat.surfaces.walls[i]
    for side in range(2):
        k, gain = (0, walls.gain_1) if side == 0 else (column.pivot.shape[1] - 1, walls.gain_2)
        column.pivot[i, k] = 1.0 + gain * (column.pivot[i, k] - 0.5 * inertia)
        column.lower[i, k] *= gain
        column.upper[i, k] *= gain
        convection.from_left[i, k] *= gain
        convection.from_right[i, k] *= gain
        responses.heating[i, k] *= gain
        responses.by_p[i, k] *= gain
        responses.by_g[i, k] *= gain
        responses.by_h[i, k] *= gain


@inner_kernel
def factor_columns(start: int, stop: int, film: Film, heat: Heat) -> None:
    """Factor the systems of columns start..stop - 1 in place and solve each for its four right-hand sides.

    Thomas' algorithm for the tridiagonal part, Sherman-Morrison for the rank-one part (warmer oil shears at a lower
    stress, which stabilises a sliding film). `pivot` becomes its inverse, `lower` and `upper` the factors of both
    substitutions.
    """
    column, by_temperature = heat.column, film.mid.by_temperature
    lower, pivot, upper, responses = column.lower, column.pivot, column.upper, column.responses
    m = film.shear.stress.shape[1]
    for i in range(start, stop):
        inverse = 1.0 / pivot[i, 0]
        pivot[i, 0] = inverse
        for k in range(1, m + 1):
            passed_on = lower[i, k] * inverse
            inverse = 1.0 / (pivot[i, k] - passed_on * upper[i, k - 1])
            upper[i, k - 1] *= pivot[i, k - 1]
            lower[i, k], pivot[i, k] = passed_on, inverse
            responses.heating[i, k] += passed_on * responses.heating[i, k - 1]
            responses.by_p[i, k] += passed_on * responses.by_p[i, k - 1]
            responses.by_g[i, k] += passed_on * responses.by_g[i, k - 1]
            responses.by_h[i, k] += passed_on * responses.by_h[i, k - 1]
        heating, p, g, h = 0.0, 0.0, 0.0, 0.0
        shared, by_p, by_g, by_h = 1.0, 0.0, 0.0, 0.0
        for k in range(m, -1, -1):
            inverse, passed_back = pivot[i, k], upper[i, k]
            heating = responses.heating[i, k] * inverse + passed_back * heating
            p = responses.by_p[i, k] * inverse + passed_back * p
            g = responses.by_g[i, k] * inverse + passed_back * g
            h = responses.by_h[i, k] * inverse + passed_back * h
            responses.heating[i, k], responses.by_p[i, k] = heating, p
            responses.by_g[i, k], responses.by_h[i, k] = g, h
            shared += by_temperature[i, k] * heating
            by_p += by_temperature[i, k] * p
            by_g += by_temperature[i, k] * g
            by_h += by_temperature[i, k] * h
        sherman = 1.0 / shared
        column.sherman[i] = sherman
        for k in range(m + 1):
            heating = responses.heating[i, k] * sherman
            responses.by_p[i, k] -= heating * by_p
            responses.by_g[i, k] -= heating * by_g
            responses.by_h[i, k] -= heating * by_h


@inlined_kernel
def solve_column(i: int, film: Film, heat: Heat, vector: FloatArray) -> None:
    """Solve the linearised system of column i. The solution replaces the right-hand side, row i of `vector` (n, k)."""
    column, by_temperature = heat.column, film.mid.by_temperature
    lower, pivot, upper, responses = column.lower, column.pivot, column.upper, column.responses
    m = vector.shape[1] - 1
    value = vector[i, 0]
    for k in range(1, m + 1):
        value = vector[i, k] + lower[i, k] * value
        vector[i, k] = value
    value, shared = 0.0, 0.0
    for k in range(m, -1, -1):
        value = vector[i, k] * pivot[i, k] + upper[i, k] * value
        vector[i, k] = value
        shared += by_temperature[i, k] * value
    shared *= column.sherman[i]
    for k in range(m + 1):
        vector[i, k] -= responses.heating[i, k] * shared
