"""Heat in the film: finite volumes across one column, linearised."""

from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import inlined_kernel, kernel
from solvers.contact.ehl.film.fluxes import BY_G, BY_H, BY_P
from solvers.contact.ehl.film.shear import Film
from solvers.contact.ehl.grid.dense import dot
from solvers.contact.ehl.problem import Problem

HEATING = 0  # the response to the mid-film stress; the others are BY_P, BY_G, BY_H


class Heat(NamedTuple):
    """The linearised heat balance of every column; n columns, k nodes across.

    Per node (n, k): lower, pivot (inverse), upper of the factored tridiagonal part, residual, inflow from the left and
    right columns; responses (n, k, 4) of temperature to the mid-film stress (the rank-one part), to p, G = h dp/dx and
    h. edges (n, k + 1): stream function between the cells at the face right of a column. Per column (n,): sherman
    1/(1 + v x), flux_1, flux_2 into the surfaces [W/m^2], history (flash temperature from upstream), its change in a
    step and gain (own flux to own temperature) of both surfaces, fluid fraction; generated and compression [W/m^2].
    """

    lower: FloatArray
    pivot: FloatArray
    upper: FloatArray
    residual: FloatArray
    from_left: FloatArray
    from_right: FloatArray
    responses: FloatArray
    edges: FloatArray
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


AT_NODES = ("lower", "pivot", "upper", "residual", "from_left", "from_right")


def heat_arrays(nodes: int, film_nodes: int) -> Heat:
    """Room for `nodes` columns."""
    across = dict.fromkeys(AT_NODES, (film_nodes,)) | {"responses": (film_nodes, 4), "edges": (film_nodes + 1,)}
    return Heat(**{name: np.zeros((nodes, *across.get(name, ()))) for name in Heat._fields})


@kernel
def face_edges(stream: FloatArray, edges: FloatArray) -> None:
    """Stream function (n, k) at the faces between columns and half way between nodes across, into edges (n, k + 1).

    The surfaces are the outermost edges; the last face is the last column itself.
    """
    n, nodes = stream.shape
    for i in range(n):
        here, there = stream[i], stream[min(i + 1, n - 1)]
        edges[i, 0] = 0.5 * (here[0] + there[0])
        edges[i, nodes] = 0.5 * (here[nodes - 1] + there[nodes - 1])
        for k in range(1, nodes):
            edges[i, k] = 0.25 * (here[k - 1] + here[k] + there[k - 1] + there[k])


@inlined_kernel
def surface_history(problem: Problem, i: int, surface_matrix: FloatArray, heat: Heat) -> None:
    """Flash temperatures that the columns upstream of i leave at i, and the gain of its own heat flux (Eq. 24)."""
    row = surface_matrix[i]
    heat.history_1[i] = problem.surface_heating_1 * dot(row[:i], heat.flux_1[:i])
    heat.history_2[i] = problem.surface_heating_2 * dot(row[:i], heat.flux_2[:i])
    heat.gain_1[i] = problem.surface_heating_1 * row[i]
    heat.gain_2[i] = problem.surface_heating_2 * row[i]


@inlined_kernel
def transport(problem: Problem, i: int, width: float, temperature: FloatArray, h: float, heat: Heat) -> None:
    """Convection (upwind, both ways) and conduction of column i: starts its residual, matrix and responses."""
    n, nodes = temperature.shape
    conductance = heat.fluid_fraction[i] * problem.conductivity * (nodes - 1) / h
    capacity = problem.specific_heat / width
    t, left, right = temperature[i], temperature[i - 1], temperature[min(i + 1, n - 1)]
    entry, outlet = heat.edges[i - 1], heat.edges[i]
    for k in range(nodes):
        from_left = capacity * max(entry[k + 1] - entry[k], 0.0)
        from_right = capacity * max(outlet[k] - outlet[k + 1], 0.0)
        residual = from_left * (t[k] - left[k]) + from_right * (t[k] - right[k])
        lower, upper, conduction = 0.0, 0.0, 0.0
        if k > 0:
            lower = capacity * max(entry[k] - outlet[k], 0.0) + conductance
            residual += lower * (t[k] - t[k - 1])
            conduction += conductance * (t[k] - t[k - 1])
        if k < nodes - 1:
            upper = capacity * max(outlet[k + 1] - entry[k + 1], 0.0) + conductance
            residual += upper * (t[k] - t[k + 1])
            conduction += conductance * (t[k] - t[k + 1])
        heat.from_left[i, k], heat.from_right[i, k] = from_left, from_right
        heat.lower[i, k], heat.upper[i, k] = lower, upper
        heat.pivot[i, k] = from_left + from_right + lower + upper
        heat.residual[i, k] = residual
        heat.responses[i, k, HEATING], heat.responses[i, k, BY_P], heat.responses[i, k, BY_G] = 0.0, 0.0, 0.0
        heat.responses[i, k, BY_H] = -conduction / h


@inlined_kernel
def dissipation(i: int, h: float, film: Film, heat: Heat) -> None:
    """Shear heating of column i, half of each interval's to each of its nodes, with its derivatives."""
    m = film.stress.shape[1]
    share = 0.5 * heat.fluid_fraction[i] * h / m
    by_p, by_g, by_h = film.mid_by_p[i], film.mid_by_g[i], film.mid_by_h[i]
    total = 0.0
    for j in range(m):
        rate, stress = film.rate[i, j], film.stress[i, j]
        source = share * stress * rate
        by_stress = share * (rate + stress * film.stiffness[i, j])
        warm = 0.5 * source * film.by_temperature[i, j]
        slope_p = source * film.by_pressure[i, j] + by_stress * by_p
        slope_g = by_stress * ((j + 0.5) / m - 0.5 + by_g)
        slope_h = source / h + by_stress * by_h
        total += 2.0 * source
        for k in range(j, j + 2):
            heat.residual[i, k] -= source
            heat.pivot[i, k] -= warm
            heat.responses[i, k, HEATING] -= by_stress
            heat.responses[i, k, BY_P] -= slope_p
            heat.responses[i, k, BY_G] -= slope_g
            heat.responses[i, k, BY_H] -= slope_h
        heat.upper[i, j] += warm
        heat.lower[i, j + 1] += warm
    heat.generated[i] = total


@inlined_kernel
def compress(problem: Problem, i: int, t: FloatArray, g: float, h: float, film: Film, heat: Heat) -> None:
    """Heat of compression of column i, (0.00065 rho0/rho) t u p'."""
    m = film.stress.shape[1]
    expansion = problem.laws.density * problem.laws.thermal_expansion
    stream, total, edge = film.stream[i], 0.0, 0.0
    for k in range(m + 1):
        density = 0.5 * (film.density[i, max(k - 1, 0)] + film.density[i, min(k, m - 1)])
        above = 0.5 * (stream[k] + stream[k + 1]) if k < m else stream[m]
        squeeze = expansion * (above - edge) / (density * density * h)
        edge = above
        source = squeeze * g * t[k]
        total += source
        heat.residual[i, k] -= source
        heat.pivot[i, k] -= squeeze * g
        heat.responses[i, k, BY_G] -= squeeze * t[k]
        heat.responses[i, k, BY_H] += source / h
    heat.compression[i] = total


@inlined_kernel
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
    fluxes q1 = lambda t_z and q2 = -lambda t_z (Eq. 24 prints no sign; heat must flow into both solids); their rows
    are the surfaces' temperatures. `width` of the cell [m]; `damping` adds heat capacity, in units of conduction.
    """
    m = film.stress.shape[1]
    t = temperature[i]
    transport(problem, i, width, temperature, h, heat)
    dissipation(i, h, film, heat)
    compress(problem, i, t, g, h, film, heat)
    heat.flux_1[i], heat.flux_2[i] = -heat.residual[i, 0], -heat.residual[i, m]
    inertia = damping * np.pi**2 * problem.conductivity / (h * m)
    for k in range(1, m):
        heat.pivot[i, k] += inertia
    for k, gain in ((0, heat.gain_1[i]), (m, heat.gain_2[i])):
        heat.residual[i, k] *= gain
        heat.lower[i, k] *= gain
        heat.upper[i, k] *= gain
        heat.pivot[i, k] = 1.0 + gain * (heat.pivot[i, k] + 0.5 * inertia)
        for c in range(4):
            heat.responses[i, k, c] *= gain
    heat.residual[i, 0] += t[0] - problem.bulk_1 - heat.history_1[i]
    heat.residual[i, m] += t[m] - problem.bulk_2 - heat.history_2[i]
