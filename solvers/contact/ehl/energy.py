"""Heat in the film: finite volumes across one column and the march along the contact."""

from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.contact.ehl.column import Film
from solvers.contact.ehl.problem import Problem


class Heat(NamedTuple):
    """The linearised heat balance of every column; n columns, k nodes across.

    Per node (n, k): lower, pivot (inverse), upper of the factored tridiagonal part, heating (the rank-one column:
    what a mid-film stress does) and its solution, residual, inflow from the left and right columns, response of
    temperature to p, G and h. Per column (n,): sherman 1/(1 + v x), flux_1, flux_2 into the surfaces [W/m^2], history
    (flash temperature from upstream), its change in a step and gain (own flux to own temperature) of both surfaces, fluid fraction;
    generated and compression [W/m^2].
    """

    lower: FloatArray
    pivot: FloatArray
    upper: FloatArray
    heating: FloatArray
    heating_solved: FloatArray
    residual: FloatArray
    from_left: FloatArray
    from_right: FloatArray
    by_p: FloatArray
    by_g: FloatArray
    by_h: FloatArray
    sherman: FloatArray
    flux_1: FloatArray
    flux_2: FloatArray
    history_1: FloatArray
    history_2: FloatArray
    change_1: FloatArray
    change_2: FloatArray
    gain_1: FloatArray
    gain_2: FloatArray
    fluid_fraction: FloatArray
    generated: FloatArray
    compression: FloatArray


def heat_arrays(nodes: int, film_nodes: int) -> Heat:
    """Room for `nodes` columns."""
    at_nodes = [np.zeros((nodes, film_nodes)) for _ in range(11)]
    columns = [np.zeros(nodes) for _ in range(12)]
    return Heat(*at_nodes, *columns)


@kernel
def layer_edge(stream: FloatArray, i: int, k: int) -> float:
    """Stream function at the lower edge of the cell of node k: half way between nodes, the surfaces at the ends."""
    if k == 0:
        return stream[i, 0]
    if k == stream.shape[1]:
        return stream[i, k - 1]
    return 0.5 * (stream[i, k - 1] + stream[i, k])


@kernel
def face_edge(stream: FloatArray, i: int, k: int) -> float:
    """The same at the face right of column i, mean of both columns; the last face is the last column."""
    if i + 1 < stream.shape[0]:
        return 0.5 * (layer_edge(stream, i, k) + layer_edge(stream, i + 1, k))
    return layer_edge(stream, i, k)


@kernel
def surface_history(
    problem: Problem, i: int, surface_matrix: FloatArray, heat: Heat
) -> None:
    """Flash temperatures that the columns upstream of i leave at i, and the gain of its own heat flux (Eq. 24)."""
    total_1, total_2 = 0.0, 0.0
    for j in range(i):
        total_1 += surface_matrix[i, j] * heat.flux_1[j]
        total_2 += surface_matrix[i, j] * heat.flux_2[j]
    heat.history_1[i] = problem.surface_heating_1 * total_1
    heat.history_2[i] = problem.surface_heating_2 * total_2
    heat.gain_1[i] = problem.surface_heating_1 * surface_matrix[i, i]
    heat.gain_2[i] = problem.surface_heating_2 * surface_matrix[i, i]


@kernel
def column_balance(
    problem: Problem,
    i: int,
    width: float,
    temperature: FloatArray,
    g: float,
    h: float,
    damping: float,
    film: Film,
    heat: Heat,
) -> None:
    """Heat balance of column i, linearised by its own temperatures: residual, tridiagonal part, responses.

    c [d(psi_zeta t)/dx - d(psi_x t)/dzeta] = (lambda/h) t_zetazeta + h (tau rate + (0.00065 rho0/rho) t u p'), with
    the cross-film flow from continuity (Eq. 23 of the paper leaves it out). Half cells at the walls give the heat
    fluxes q1 = lambda t_z and q2 = -lambda t_z (Eq. 24 prints no sign; heat must flow into both solids). Convection
    is upwinded; dissipation of an interval goes half to each of its nodes. `width` of the cell [m].
    """
    m = film.stress.shape[1]
    theta = heat.fluid_fraction[i]
    conductance = theta * problem.conductivity * m / h
    capacity = problem.specific_heat / width
    expansion = problem.laws.density * problem.laws.thermal_expansion
    inertia = damping * np.pi**2 * problem.conductivity / (h * m)
    t = temperature[i]
    heat.generated[i], heat.compression[i] = 0.0, 0.0
    for k in range(m + 1):
        left = face_edge(film.stream, i - 1, k + 1) - face_edge(film.stream, i - 1, k)
        right = face_edge(film.stream, i, k + 1) - face_edge(film.stream, i, k)
        heat.from_left[i, k] = capacity * max(left, 0.0)
        heat.from_right[i, k] = capacity * max(-right, 0.0)
        lower, upper = 0.0, 0.0
        if k > 0:
            rising = face_edge(film.stream, i - 1, k) - face_edge(film.stream, i, k)
            lower = capacity * max(rising, 0.0) + conductance
        if k < m:
            rising = face_edge(film.stream, i - 1, k + 1) - face_edge(film.stream, i, k + 1)
            upper = capacity * max(-rising, 0.0) + conductance
        diagonal = heat.from_left[i, k] + heat.from_right[i, k] + lower + upper
        residual = heat.from_left[i, k] * (t[k] - temperature[i - 1, k])
        if i + 1 < temperature.shape[0]:
            residual += heat.from_right[i, k] * (t[k] - temperature[i + 1, k])
        conduction = 0.0
        if k > 0:
            residual += lower * (t[k] - t[k - 1])
            conduction += conductance * (t[k] - t[k - 1])
        if k < m:
            residual += upper * (t[k] - t[k + 1])
            conduction += conductance * (t[k] - t[k + 1])
        by_p, by_g, by_h, heating, source = 0.0, 0.0, -conduction / h, 0.0, 0.0
        for j in range(max(k - 1, 0), min(k + 1, m)):
            share = 0.5 * theta * h / m
            rate, stress = film.rate[i, j], film.stress[i, j]
            by_stress = share * (rate + stress * film.stiffness[i, j])
            warm = 0.5 * share * stress * rate * film.by_temperature[i, j]
            source += share * stress * rate
            heating -= by_stress
            by_p -= share * stress * rate * film.by_pressure[i, j] + by_stress * film.mid_by_p[i]
            by_g -= by_stress * ((j + 0.5) / m - 0.5 + film.mid_by_g[i])
            by_h -= share * stress * rate / h + by_stress * film.mid_by_h[i]
            diagonal -= warm
            if j < k:
                lower += warm
            else:
                upper += warm
        density = 0.5 * (film.density[i, max(k - 1, 0)] + film.density[i, min(k, m - 1)])
        flow = layer_edge(film.stream, i, k + 1) - layer_edge(film.stream, i, k)
        squeeze = expansion * flow / (density * density * h)
        heat.generated[i] += source
        heat.compression[i] += squeeze * g * t[k]
        residual -= source + squeeze * g * t[k]
        diagonal -= squeeze * g
        by_g -= squeeze * t[k]
        by_h += squeeze * g * t[k] / h
        scale = 1.0
        if k == 0:
            scale = heat.gain_1[i]
            heat.flux_1[i] = -residual
        elif k == m:
            scale = heat.gain_2[i]
            heat.flux_2[i] = -residual
        diagonal += inertia if 0 < k < m else 0.5 * inertia
        heat.residual[i, k] = scale * residual
        heat.lower[i, k], heat.pivot[i, k], heat.upper[i, k] = -scale * lower, scale * diagonal, -scale * upper
        heat.heating[i, k] = scale * heating
        heat.by_p[i, k], heat.by_g[i, k], heat.by_h[i, k] = -scale * by_p, -scale * by_g, -scale * by_h
    heat.residual[i, 0] += t[0] - problem.bulk_1 - heat.history_1[i]
    heat.residual[i, m] += t[m] - problem.bulk_2 - heat.history_2[i]
    heat.pivot[i, 0] += 1.0
    heat.pivot[i, m] += 1.0


@kernel
def factor_column(i: int, film: Film, heat: Heat) -> None:
    """Thomas factorisation of column i and the Sherman-Morrison term of its rank-one part."""
    m = film.stress.shape[1]
    heat.pivot[i, 0] = 1.0 / heat.pivot[i, 0]
    for k in range(1, m + 1):
        heat.lower[i, k] *= heat.pivot[i, k - 1]
        heat.pivot[i, k] = 1.0 / (heat.pivot[i, k] - heat.lower[i, k] * heat.upper[i, k - 1])
    heat.heating_solved[i, :] = heat.heating[i, :]
    _substitute(i, heat, heat.heating_solved)
    total = 1.0
    for k in range(m + 1):
        total += film.mid_by_temperature[i, k] * heat.heating_solved[i, k]
    heat.sherman[i] = 1.0 / total


@kernel
def _substitute(i: int, heat: Heat, vector: FloatArray) -> None:
    """Forward and back substitution of row i of `vector` with the tridiagonal part."""
    m = vector.shape[1] - 1
    for k in range(1, m + 1):
        vector[i, k] -= heat.lower[i, k] * vector[i, k - 1]
    vector[i, m] *= heat.pivot[i, m]
    for k in range(m - 1, -1, -1):
        vector[i, k] = (vector[i, k] - heat.upper[i, k] * vector[i, k + 1]) * heat.pivot[i, k]


@kernel
def solve_column(i: int, film: Film, heat: Heat, vector: FloatArray) -> None:
    """Solve the linearised column i for row i of `vector`, in place."""
    _substitute(i, heat, vector)
    total = 0.0
    for k in range(vector.shape[1]):
        total += film.mid_by_temperature[i, k] * vector[i, k]
    total *= heat.sherman[i]
    for k in range(vector.shape[1]):
        vector[i, k] -= heat.heating_solved[i, k] * total


@kernel
def solve_responses(i: int, film: Film, heat: Heat) -> None:
    """Turn the right-hand sides of p, G and h of column i into temperature responses."""
    solve_column(i, film, heat, heat.by_p)
    solve_column(i, film, heat, heat.by_g)
    solve_column(i, film, heat, heat.by_h)
