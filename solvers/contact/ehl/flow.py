"""Flow through the columns of the film: flow coefficients A and B, their derivatives, and stream functions.

Two passes run over the columns: `evaluate_columns` computes the values, and `linearise_columns` computes the
derivatives.
"""

from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray, RecordArray, floats, records
from solvers.compiled import inlined_kernel, inner_kernel
from solvers.contact.ehl.problem import Problem
from solvers.contact.ehl.rheology import mid_film_stress, shear_rates
from solvers.contact.ehl.shear import Film, stress_response, viscosities
from solvers.lubricants import density

COEFFICIENT = floats("value", "by_p", "by_g", "by_h")
"""A flow coefficient, and its derivatives with respect to p, G = h dp/dx and h."""

PLACE = floats("p", "g", "h")
"""Pressure p [Pa], G = h dp/dx [Pa] limited by `rheology.limited_gradient`, and film thickness h [m] of a column."""


class FlowCoefficients(NamedTuple):
    """Flow coefficients ln A and B, with their derivatives. The mass flux is m = B h - A h^3 dp/dx.

    `log_a` and `b` (n,) hold one record of type COEFFICIENT per node. The derivatives are first computed for fixed
    temperatures. In a thermal contact, p, G and h also change the temperatures; `newton.include_temperature` adds this
    effect to the derivatives.
    """

    log_a: RecordArray
    b: RecordArray


def flow_coefficients(nodes: int) -> FlowCoefficients:
    """Return zeroed coefficients for `nodes` nodes."""
    return FlowCoefficients(records(nodes, COEFFICIENT), records(nodes, COEFFICIENT))


@inner_kernel
def evaluate_columns(
    problem: Problem,
    temperature: FloatArray,
    start: int,
    stop: int,
    at: RecordArray,
    film: Film,
    coefficients: FlowCoefficients,
) -> None:
    """Compute viscosity, shear and flow of columns start..stop from the nodal temperatures (n, k) [K].

    The array `at` (n,) holds one record of type PLACE per column, with p, G = h dp/dx and h.
    """
    for i in range(start, stop):
        p, g, h = at[i].p, at[i].g, at[i].h
        viscosities(problem, i, temperature, p, film.shear)
        film.mid.stress[i] = mid_film_stress(problem, i, g, h, film.shear)
        shear_rates(problem, i, g, film.mid.stress[i], film.shear)
        flow_moments(i, film)
        flow(problem, i, h, film, coefficients)


@inlined_kernel
def flow_moments(i: int, film: Film) -> None:
    """Compute integrals across column i: F0 = int phi, F1 = int phi zeta, N0 = int phi R, N1 = int phi zeta R.

    Here phi is the shear rate divided by the stress, and zeta is the height above the middle of the film, divided by h.
    R(zeta) is the integral of the density from zeta to surface 2. The function also computes the mean density, which is
    the integral of the density across the whole film.
    """
    rho, effective, moments = film.shear.density, film.shear.effective, film.moments
    m = rho.shape[1]
    dz, above, f0, f1, n0, n1 = 1.0 / m, 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(m - 1, -1, -1):
        zeta, phi, layer = (j + 0.5) * dz - 0.5, effective[i, j] * dz, rho[i, j] * dz
        middle = above + 0.5 * layer
        above += layer
        f0 += phi
        f1 += phi * zeta
        n0 += phi * middle
        n1 += phi * zeta * middle
    moments[i].density, moments[i].f0, moments[i].f1, moments[i].n0, moments[i].n1 = above, f0, f1, n0, n1


@inlined_kernel
def flow(problem: Problem, i: int, h: float, film: Film, coefficients: FlowCoefficients) -> None:
    """Flow coefficients A = F1 N0/F0 - N1 and B = u1 R + du N0/F0 and stream functions of column i (Eqs. 17, E7.1).

    For a density that varies across the film; R is its mean, du is u2 - u1, J0 and J1 are the integrals of phi and of
    phi zeta from surface 1. `couette` is the integral of h rho (u1 + du J0/F0), `poiseuille` of rho (F1 J0/F0 - J1)/A,
    both from surface 1 to each node; the other symbols are those of `flow_moments`.
    """
    rho, effective, moments, flows = film.shear.density, film.shear.effective, film.moments[i], film.flow
    m, u1, du = rho.shape[1], problem.speed_1, problem.speed_2 - problem.speed_1
    lean, drag = moments.f1 / moments.f0, du / moments.f0
    a = lean * moments.n0 - moments.n1
    dz, per_a, couette, poiseuille, j0, j1 = 1.0 / m, 1.0 / (m * a), 0.0, 0.0, 0.0, 0.0
    for j in range(m):
        phi = effective[i, j] * dz
        phi_zeta = phi * ((j + 0.5) * dz - 0.5)
        flows.couette[i, j], flows.poiseuille[i, j] = couette, poiseuille
        couette += h * rho[i, j] * (u1 + drag * (j0 + 0.5 * phi)) * dz
        poiseuille += rho[i, j] * (lean * (j0 + 0.5 * phi) - (j1 + 0.5 * phi_zeta)) * per_a
        j0 += phi
        j1 += phi_zeta
    flows.couette[i, m], flows.poiseuille[i, m] = couette, poiseuille
    coefficients.log_a[i].value = np.log(a)
    coefficients.b[i].value = u1 * moments.density + drag * moments.n0


@inner_kernel
def linearise_columns(
    problem: Problem,
    start: int,
    stop: int,
    at: RecordArray,
    film: Film,
    coefficients: FlowCoefficients,
) -> None:
    """Derivatives of the mid-film stress, of ln A and of B in columns start..stop, after `evaluate_columns`."""
    for i in range(start, stop):
        stress_response(problem, i, at[i].h, film)
        flow_slopes(problem, i, at[i].p, film, coefficients)


@inlined_kernel
def flow_slopes(problem: Problem, i: int, p: float, film: Film, coefficients: FlowCoefficients) -> None:
    """Derivatives of ln A and B of column i by p, G, h at fixed temperatures, and by the nodal temperatures."""
    shear, moments, flows, mid = film.shear, film.moments[i], film.flow, film.mid
    m, u1, du = shear.density.shape[1], problem.speed_1, problem.speed_2 - problem.speed_1
    lean, mass, drag = moments.f1 / moments.f0, moments.n0 / moments.f0, du / moments.f0
    dz, per_a = 1.0 / m, 1.0 / (m * (moments.f1 * mass - moments.n1))
    rho_by_p = density(problem.laws, p, problem.laws.reference_temperature)[1]
    rho_by_t = -problem.laws.density * problem.laws.thermal_expansion
    a_by_p, a_by_g, a_by_stress, b_by_p, b_by_g, b_by_stress = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    half_a, half_b, below, j0, j1 = 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(m):
        zeta, layer, slope = (j + 0.5) * dz - 0.5, shear.density[i, j] * dz, shear.effective_slope[i, j]
        effective = shear.effective[i, j]
        phi, above = effective * dz, moments.density - below - 0.5 * layer
        below += layer
        a_by_rho = (lean * (j0 + 0.5 * phi) - (j1 + 0.5 * phi * zeta)) * per_a
        b_by_rho = (u1 + drag * (j0 + 0.5 * phi)) * dz
        j0 += phi
        j1 += phi * zeta
        a_by_phi = (zeta * (mass - above) + lean * (above - mass)) * per_a
        b_by_phi = drag * (above - mass) * dz
        a_by_stress += a_by_phi * slope
        b_by_stress += b_by_phi * slope
        phi_by_p, phi_by_t = effective * shear.by_pressure[i, j], effective * shear.by_temperature[i, j]
        a_by_p += a_by_phi * phi_by_p + a_by_rho * rho_by_p
        b_by_p += b_by_phi * phi_by_p + b_by_rho * rho_by_p
        a_by_g += a_by_phi * slope * zeta
        b_by_g += b_by_phi * slope * zeta
        before_a, before_b = half_a, half_b
        half_a = 0.5 * (a_by_phi * phi_by_t + a_by_rho * rho_by_t)
        half_b = 0.5 * (b_by_phi * phi_by_t + b_by_rho * rho_by_t)
        flows.log_a_by_temperature[i, j] = before_a + half_a
        flows.b_by_temperature[i, j] = before_b + half_b
    flows.log_a_by_temperature[i, m], flows.b_by_temperature[i, m] = half_a, half_b
    for k in range(m + 1):
        flows.log_a_by_temperature[i, k] += a_by_stress * mid.by_temperature[i, k]
        flows.b_by_temperature[i, k] += b_by_stress * mid.by_temperature[i, k]
    log_a, b = coefficients.log_a, coefficients.b
    log_a[i].by_p, b[i].by_p = a_by_p + a_by_stress * mid.by_p[i], b_by_p + b_by_stress * mid.by_p[i]
    log_a[i].by_g, b[i].by_g = a_by_g + a_by_stress * mid.by_g[i], b_by_g + b_by_stress * mid.by_g[i]
    log_a[i].by_h, b[i].by_h = a_by_stress * mid.by_h[i], b_by_stress * mid.by_h[i]
