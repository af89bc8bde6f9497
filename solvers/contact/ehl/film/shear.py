"""Shear across the film: viscosity, stress and rate of each interval of a column, from its temperatures."""

from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import inlined_kernel
from solvers.contact.ehl.problem import Problem
from solvers.lubricants import density, log_viscosity, pressure_part

STRESS_LIMIT = 300.0  # of |h dp/dx| / (2 tau0): exp(300)^2 is still a number


class Film(NamedTuple):
    """Across every column; n columns, m intervals of equal height, m + 1 nodes, zeta = z/h.

    Per interval (n, m): fluidity 1/eta, its logarithmic derivatives by temperature and pressure, stress [Pa],
    rate [1/s], stiffness d rate/d stress, effective fluidity rate/stress and its derivative by stress, density.
    Per node (n, m + 1): stream (function, from surface 1) [kg/(m s)], couette (its part without pressure gradient),
    poiseuille (the shape, from 0 to 1, of its part with it), and the derivatives by nodal temperature of the mid-film
    stress and of the flow coefficients ln A and B.
    Per column (n,): mid-film stress and its derivatives by p, by G = h dp/dx and by h.
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
    stream: FloatArray
    couette: FloatArray
    poiseuille: FloatArray
    mid_by_temperature: FloatArray
    log_a_by_temperature: FloatArray
    b_by_temperature: FloatArray
    mid_stress: FloatArray
    mid_by_p: FloatArray
    mid_by_g: FloatArray
    mid_by_h: FloatArray


def film_arrays(nodes: int, film_nodes: int) -> Film:
    """Room for `nodes` columns."""
    shapes = dict.fromkeys(Film._fields, (nodes, film_nodes - 1))
    shapes |= dict.fromkeys(AT_NODES, (nodes, film_nodes))
    return Film(**{name: np.zeros(nodes if name in OF_COLUMNS else shape) for name, shape in shapes.items()})


AT_NODES = ("stream", "couette", "poiseuille", "mid_by_temperature", "log_a_by_temperature", "b_by_temperature")
OF_COLUMNS = ("mid_stress", "mid_by_p", "mid_by_g", "mid_by_h")


@inlined_kernel
def limited_gradient(problem: Problem, g: float) -> float:
    """G = h dp/dx, kept where exp(G/(2 tau0)) is a number; a solution never needs it."""
    if problem.newtonian == 1:
        return g
    bound = 2.0 * STRESS_LIMIT * problem.eyring_stress
    return min(max(g, -bound), bound)


@inlined_kernel
def viscosities(problem: Problem, i: int, temperature: FloatArray, p: float, film: Film) -> float:
    """Fluidity and density of each interval at its mean temperature (m + 1,); returns d rho/dp."""
    laws = problem.laws
    term, term_slope = pressure_part(laws, p)
    base, base_slope, by_heating = density(laws, p, laws.reference_temperature)
    for j in range(temperature.size - 1):
        t = 0.5 * (temperature[j] + temperature[j + 1])
        value, by_term, by_temperature = log_viscosity(laws, term, t)
        film.fluidity[i, j] = np.exp(-value)
        film.by_temperature[i, j] = -by_temperature
        film.by_pressure[i, j] = -by_term * term_slope
        film.density[i, j] = base + by_heating * (t - laws.reference_temperature)
    return base_slope


@inlined_kernel
def shear_newtonian(problem: Problem, i: int, g: float, h: float, film: Film) -> None:
    """Newton's fluid: tau = tau_mid + G (zeta - 1/2), rate = tau/eta, with the sliding speed as its integral."""
    m = film.stress.shape[1]
    zeroth, first = 0.0, 0.0
    for j in range(m):
        zeroth += film.fluidity[i, j] / m
        first += film.fluidity[i, j] * ((j + 0.5) / m - 0.5) / m
    mid = ((problem.speed_2 - problem.speed_1) / h - g * first) / zeroth
    film.mid_stress[i] = mid
    for j in range(m):
        stress = mid + g * ((j + 0.5) / m - 0.5)
        fluidity = film.fluidity[i, j]
        film.stress[i, j], film.rate[i, j], film.stiffness[i, j] = stress, stress * fluidity, fluidity
        film.effective[i, j], film.effective_slope[i, j] = fluidity, 0.0


@inlined_kernel
def shear_eyring(problem: Problem, i: int, g: float, h: float, film: Film) -> None:
    """Ree and Eyring's fluid: rate = (tau0/eta) sinh(tau/tau0) with the sliding speed as its integral.

    Closed form for e^a, where tau_mid = tau0 a; the form for du < 0 is the conjugate, free of cancellation.
    """
    m = film.stress.shape[1]
    tau0 = problem.eyring_stress
    ratio = np.exp(g / (m * tau0))
    first = np.exp(g * (0.5 / m - 0.5) / tau0)
    forward, backward, growth = 0.0, 0.0, first
    for j in range(m):
        forward += film.fluidity[i, j] * growth / m
        backward += film.fluidity[i, j] / (growth * m)
        growth *= ratio
    slide = (problem.speed_2 - problem.speed_1) / (h * tau0)
    root = np.sqrt(slide * slide + forward * backward)
    exponential = (slide + root) / forward if slide >= 0.0 else backward / (root - slide)
    film.mid_stress[i] = tau0 * np.log(exponential)
    growth = exponential * first
    for j in range(m):
        stress = film.mid_stress[i] + g * ((j + 0.5) / m - 0.5)
        fluidity = film.fluidity[i, j]
        inverse = 1.0 / growth
        sinh, cosh = 0.5 * (growth - inverse), 0.5 * (growth + inverse)
        growth *= ratio
        s = stress / tau0
        if abs(s) < 1e-3:
            effective, slope = 1.0 + s * s / 6.0, s / 3.0
        else:
            over = 1.0 / s
            effective = sinh * over
            slope = (cosh - effective) * over
        film.stress[i, j], film.stiffness[i, j] = stress, fluidity * cosh
        film.effective[i, j] = fluidity * effective
        film.effective_slope[i, j] = fluidity * slope / tau0
        film.rate[i, j] = stress * fluidity * effective


@inlined_kernel
def stress_response(problem: Problem, i: int, h: float, film: Film) -> None:
    """Derivatives of the mid-film stress that keep the sliding speed: by nodal temperature, p, G and h."""
    m = film.stress.shape[1]
    total, by_p, by_g = 0.0, 0.0, 0.0
    film.mid_by_temperature[i, :] = 0.0
    for j in range(m):
        total += film.stiffness[i, j]
        by_p += film.rate[i, j] * film.by_pressure[i, j]
        by_g += film.stiffness[i, j] * ((j + 0.5) / m - 0.5)
    for j in range(m):
        share = -0.5 * film.rate[i, j] * film.by_temperature[i, j] / total
        film.mid_by_temperature[i, j] += share
        film.mid_by_temperature[i, j + 1] += share
    film.mid_by_p[i], film.mid_by_g[i] = -by_p / total, -by_g / total
    film.mid_by_h[i] = -(problem.speed_2 - problem.speed_1) / (h * h * total / m)
