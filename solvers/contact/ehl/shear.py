"""Shear across the film: viscosity, stress and shear rate in each interval of a column, from its temperatures."""

from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import inlined_kernel
from solvers.contact.ehl.problem import Problem
from solvers.lubricants import density, log_viscosity, pressure_part

STRESS_LIMIT = 300.0  # of |h dp/dx| / (2 tau0): exp(300)^2 is still a number


class Shear(NamedTuple):
    """How the oil shears in every interval, and how dense it is there (n, m).

    Fluidity 1/eta and its logarithmic derivatives by temperature and pressure, stress [Pa], rate [1/s], stiffness
    d rate/d stress, effective fluidity rate/stress and its derivative by stress.
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
    """Flow between surface 1 and every node, and its derivatives by nodal temperature, (n, m + 1).

    stream (function) [kg/(m s)], couette (its part without pressure gradient), poiseuille (the shape, from 0 to 1, of
    its part with it); derivatives of the flow coefficients ln A and B by nodal temperature.
    """

    stream: FloatArray
    couette: FloatArray
    poiseuille: FloatArray
    log_a_by_temperature: FloatArray
    b_by_temperature: FloatArray


class MidFilm(NamedTuple):
    """Stress half way across [Pa] and its derivatives by p, G = h dp/dx and h (n,), by nodal temperature (n, m + 1)."""

    stress: FloatArray
    by_temperature: FloatArray
    by_p: FloatArray
    by_g: FloatArray
    by_h: FloatArray


class Film(NamedTuple):
    """Across each of n columns; m intervals of equal height, m + 1 nodes, zeta = z/h."""

    shear: Shear
    flow: Flow
    mid: MidFilm


def film_arrays(nodes: int, film_nodes: int) -> Film:
    """Room for `nodes` columns."""
    shear = Shear(*np.zeros((len(Shear._fields), nodes, film_nodes - 1)))
    flow = Flow(*np.zeros((len(Flow._fields), nodes, film_nodes)))
    stress, by_p, by_g, by_h = np.zeros((4, nodes))
    return Film(shear, flow, MidFilm(stress, np.zeros((nodes, film_nodes)), by_p, by_g, by_h))


@inlined_kernel
def limited_gradient(problem: Problem, g: float) -> float:
    """G = h dp/dx, kept where exp(G/(2 tau0)) is a number; a solution never needs it."""
    if problem.newtonian == 1:
        return g
    bound = 2.0 * STRESS_LIMIT * problem.eyring_stress
    return min(max(g, -bound), bound)


@inlined_kernel
def viscosities(problem: Problem, i: int, temperature: FloatArray, p: float, shear: Shear) -> tuple[float, float]:
    """Fluidity and density of each interval of column i at its mean temperature; returns mean density and d rho/dp."""
    laws, m = problem.laws, temperature.shape[1] - 1
    term, term_slope = pressure_part(laws, p)
    base, base_slope, by_heating = density(laws, p, laws.reference_temperature)
    total = 0.0
    for j in range(m):
        t = 0.5 * (temperature[i, j] + temperature[i, j + 1])
        value, by_term, by_temperature = log_viscosity(laws, term, t)
        shear.fluidity[i, j] = np.exp(-value)
        shear.by_temperature[i, j] = -by_temperature
        shear.by_pressure[i, j] = -by_term * term_slope
        rho = base + by_heating * (t - laws.reference_temperature)
        shear.density[i, j] = rho
        total += rho
    return total / m, base_slope


@inlined_kernel
def shear_newtonian(problem: Problem, i: int, g: float, h: float, film: Film) -> None:
    """Newton's fluid: tau = tau_mid + G (zeta - 1/2), rate = tau/eta, with the sliding speed as its integral.

    Eq. E4.
    """
    shear, m = film.shear, film.shear.stress.shape[1]
    height, zeroth, first = 1.0 / m, 0.0, 0.0
    for j in range(m):
        zeroth += shear.fluidity[i, j] * height
        first += shear.fluidity[i, j] * ((j + 0.5) * height - 0.5) * height
    mid = ((problem.speed_2 - problem.speed_1) / h - g * first) / zeroth
    film.mid.stress[i] = mid
    for j in range(m):
        stress = mid + g * ((j + 0.5) * height - 0.5)
        fluidity = shear.fluidity[i, j]
        shear.stress[i, j], shear.rate[i, j], shear.stiffness[i, j] = stress, stress * fluidity, fluidity
        shear.effective[i, j], shear.effective_slope[i, j] = fluidity, 0.0


@inlined_kernel
def shear_eyring(problem: Problem, i: int, g: float, h: float, film: Film) -> None:
    """Ree and Eyring's fluid: rate = (tau0/eta) sinh(tau/tau0) with the sliding speed as its integral (Eqs. E5, E6).

    Closed form for e^a, where tau_mid = tau0 a; the form for du < 0 is the conjugate, free of cancellation.
    """
    shear, m = film.shear, film.shear.stress.shape[1]
    tau0, height = problem.eyring_stress, 1.0 / m
    ratio = np.exp(g * height / tau0)
    first = np.exp(g * (0.5 * height - 0.5) / tau0)
    forward, backward, growth = 0.0, 0.0, first
    for j in range(m):
        forward += shear.fluidity[i, j] * growth * height
        backward += shear.fluidity[i, j] / growth * height
        growth *= ratio
    slide = (problem.speed_2 - problem.speed_1) / (h * tau0)
    root = np.sqrt(slide * slide + forward * backward)
    exponential = (slide + root) / forward if slide >= 0.0 else backward / (root - slide)
    mid, per_tau0 = tau0 * np.log(exponential), 1.0 / tau0
    film.mid.stress[i] = mid
    growth = exponential * first
    for j in range(m):
        stress = mid + g * ((j + 0.5) * height - 0.5)
        fluidity = shear.fluidity[i, j]
        inverse = 1.0 / growth
        sinh, cosh = 0.5 * (growth - inverse), 0.5 * (growth + inverse)
        growth *= ratio
        s = stress * per_tau0
        if abs(s) < 1e-3:
            effective, slope = 1.0 + s * s / 6.0, s / 3.0
        else:
            over = 1.0 / s
            effective = sinh * over
            slope = (cosh - effective) * over
        shear.stress[i, j], shear.stiffness[i, j] = stress, fluidity * cosh
        shear.effective[i, j] = fluidity * effective
        shear.effective_slope[i, j] = fluidity * slope * per_tau0
        shear.rate[i, j] = stress * fluidity * effective


@inlined_kernel
def stress_response(problem: Problem, i: int, h: float, film: Film) -> None:
    """Derivatives of the mid-film stress that keep the sliding speed: by nodal temperature, p, G and h."""
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
