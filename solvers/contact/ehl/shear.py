"""Shear across the columns of the film: arrays, viscosities, densities, and derivatives of the mid-film stress."""

from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray, RecordArray, floats, records
from solvers.compiled import inlined_kernel
from solvers.contact.ehl.problem import Problem
from solvers.lubricants import density, log_viscosity, pressure_part


class Shear(NamedTuple):
    """Shear and density of the oil in all intervals (n, m).

    `fluidity` is 1/eta [1/(Pa s)]. `by_temperature` [1/K] and `by_pressure` [1/Pa] are the derivatives of ln(1/eta).
    `stress` is the shear stress [Pa], and `rate` is the shear rate [1/s]. `stiffness` is the derivative of the rate
    with respect to the stress [1/(Pa s)]. `effective` is the rate divided by the stress [1/(Pa s)]. `effective_slope`
    is the derivative of `effective` with respect to the stress. `density` is in kg/m^3.
    """

    fluidity: FloatArray
    by_temperature: FloatArray
    by_pressure: FloatArray
    stress: FloatArray
    rate: FloatArray
    stiffness: FloatArray
    effective: FloatArray
    effective_slope: FloatArray
    density: FloatArray


class Flow(NamedTuple):
    """Stream functions, and derivatives of ln A and of B with respect to the nodal temperatures, all (n, m + 1).

    A and B are the flow coefficients of the mass flux m = B h - A h^3 dp/dx.

    `stream` is the mass flow between surface 1 and a node [kg/(m s)]. `couette` is the part of this flow that does not
    depend on the pressure gradient [kg/(m s)]. `poiseuille` is the profile of the other part, which the pressure
    gradient drives. This profile rises from 0 at surface 1 to 1 at surface 2.
    """

    stream: FloatArray
    couette: FloatArray
    poiseuille: FloatArray
    log_a_by_temperature: FloatArray
    b_by_temperature: FloatArray


MOMENTS = floats("density", "f0", "f1", "n0", "n1")
"""Results of `flow.flow_moments`: the mean density R and the integrals F0, F1, N0 and N1 across the film."""


class MidFilm(NamedTuple):
    """Shear stress half way across the film (n,) [Pa], and the derivatives of this stress.

    The derivatives with respect to p, G = h dp/dx and h have the shape (n,). The derivatives with respect to the nodal
    temperatures have the shape (n, m + 1).
    """

    stress: FloatArray
    by_temperature: FloatArray
    by_p: FloatArray
    by_g: FloatArray
    by_h: FloatArray


class Film(NamedTuple):
    """Arrays of n columns of the film, each with m intervals of equal height and m + 1 nodes.

    `moments` (n,) holds one record of type MOMENTS per column.
    """

    shear: Shear
    moments: RecordArray
    flow: Flow
    mid: MidFilm


def film_arrays(nodes: int, film_nodes: int) -> Film:
    """Return zeroed arrays for `nodes` columns."""
    shear = Shear(*np.zeros((len(Shear._fields), nodes, film_nodes - 1)))
    flow = Flow(*np.zeros((len(Flow._fields), nodes, film_nodes)))
    stress, by_p, by_g, by_h = np.zeros((4, nodes))
    return Film(shear, records(nodes, MOMENTS), flow, MidFilm(stress, np.zeros((nodes, film_nodes)), by_p, by_g, by_h))


@inlined_kernel
def viscosities(problem: Problem, i: int, temperature: FloatArray, p: float, shear: Shear) -> None:
    """Compute fluidity 1/eta and density of each interval of column i at the mean temperature of the interval."""
    laws, m = problem.laws, temperature.shape[1] - 1
    term, term_slope = pressure_part(laws, p)
    base, _, by_heating = density(laws, p, laws.reference_temperature)
    for j in range(m):
        t = 0.5 * (temperature[i, j] + temperature[i, j + 1])
        value, by_term, by_temperature = log_viscosity(laws, term, t)
        shear.fluidity[i, j] = np.exp(-value)
        shear.by_temperature[i, j] = -by_temperature
        shear.by_pressure[i, j] = -by_term * term_slope
        shear.density[i, j] = base + by_heating * (t - laws.reference_temperature)


@inlined_kernel
def stress_response(problem: Problem, i: int, h: float, film: Film) -> None:
    """Derivatives of the mid-film stress of column i by temperatures, p, h dp/dx and h at constant sliding."""
    shear, mid, m = film.shear, film.mid, film.shear.stress.shape[1]
    height, total, by_p, by_g = 1.0 / m, 0.0, 0.0, 0.0
    for j in range(m):
        total += shear.stiffness[i, j]
        by_p += shear.rate[i, j] * shear.by_pressure[i, j]
        by_g += shear.stiffness[i, j] * ((j + 0.5) * height - 0.5)
    half, share = 0.0, -0.5 / total
    for j in range(m):
        before, half = half, share * shear.rate[i, j] * shear.by_temperature[i, j]
        mid.by_temperature[i, j] = before + half
    mid.by_temperature[i, m] = half
    mid.by_p[i], mid.by_g[i] = -by_p / total, -by_g / total
    mid.by_h[i] = -(problem.speed_2 - problem.speed_1) / (h * h * total / m)
