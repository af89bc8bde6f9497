"""One column of the film: how much flows, driven by the surfaces and by pressure, and where across the film."""

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import inlined_kernel
from solvers.contact.ehl.film.fluxes import BY_G, BY_H, BY_P, VALUE, FlowCoefficients
from solvers.contact.ehl.film.shear import Film, Shear, shear_eyring, shear_newtonian, stress_response, viscosities
from solvers.contact.ehl.problem import Problem


@inlined_kernel
def flow_moments(i: int, total: float, shear: Shear) -> tuple[float, float, float, float]:
    """F0, F1, N0, N1 of `flow`; `total` is the density across the film."""
    m = shear.stress.shape[1]
    height = 1.0 / m
    below, f0, f1, n0, n1 = 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(m):
        zeta, phi, layer = (j + 0.5) * height - 0.5, shear.effective[i, j] * height, shear.density[i, j] * height
        above = total - below - 0.5 * layer
        below += layer
        f0 += phi
        f1 += phi * zeta
        n0 += phi * above
        n1 += phi * zeta * above
    return f0, f1, n0, n1


@inlined_kernel
def flow(
    problem: Problem, i: int, h: float, total: float, density_slope: float, film: Film, coefficients: FlowCoefficients
) -> None:
    """Flow coefficients A and B of a column, their derivatives at fixed temperature, and its stream functions.

    With phi = rate/stress, F0 = int phi, F1 = int phi (zeta - 1/2), R(zeta) the density above zeta, N0 = int phi R,
    N1 = int phi (zeta - 1/2) R: A = F1 N0/F0 - N1 and B = u1 R(0) + du N0/F0 (Eq. 17, density varying across the
    film as well). `total` is R(0).
    """
    shear, flows, mid, m = film.shear, film.flow, film.mid, film.shear.stress.shape[1]
    f0, f1, n0, n1 = flow_moments(i, total, shear)
    lean, mass, drag = f1 / f0, n0 / f0, (problem.speed_2 - problem.speed_1) / f0
    a = f1 * mass - n1
    height, per_a, expansion = 1.0 / m, 1.0 / (m * a), problem.laws.density * problem.laws.thermal_expansion
    a_by_p, a_by_g, a_by_stress, b_by_p, b_by_g, b_by_stress = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    couette, poiseuille, half_a, half_b, below, j0, j1 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(m):
        zeta, rho, slope = (j + 0.5) * height - 0.5, shear.density[i, j], shear.effective_slope[i, j]
        effective = shear.effective[i, j]
        phi, above = effective * height, total - below - 0.5 * rho * height
        below += rho * height
        by_density_a = (lean * (j0 + 0.5 * phi) - (j1 + 0.5 * phi * zeta)) * per_a
        by_density_b = (problem.speed_1 + drag * (j0 + 0.5 * phi)) * height
        j0 += phi
        j1 += phi * zeta
        by_phi_a = (zeta * (mass - above) + lean * (above - mass)) * per_a
        by_phi_b = drag * (above - mass) * height
        a_by_stress += by_phi_a * slope
        b_by_stress += by_phi_b * slope
        pressed = effective * shear.by_pressure[i, j]
        a_by_p += by_phi_a * pressed + density_slope * by_density_a
        b_by_p += by_phi_b * pressed + density_slope * by_density_b
        a_by_g += by_phi_a * slope * zeta
        b_by_g += by_phi_b * slope * zeta
        flows.couette[i, j], flows.poiseuille[i, j] = couette, poiseuille
        couette += h * rho * by_density_b
        poiseuille += rho * by_density_a
        warm, before_a, before_b = effective * shear.by_temperature[i, j], half_a, half_b
        half_a = 0.5 * (by_phi_a * warm - expansion * by_density_a)
        half_b = 0.5 * (by_phi_b * warm - expansion * by_density_b)
        flows.log_a_by_temperature[i, j] = before_a + half_a
        flows.b_by_temperature[i, j] = before_b + half_b
    flows.couette[i, m], flows.poiseuille[i, m] = couette, poiseuille
    flows.log_a_by_temperature[i, m], flows.b_by_temperature[i, m] = half_a, half_b
    for k in range(m + 1):
        flows.log_a_by_temperature[i, k] += a_by_stress * mid.by_temperature[i, k]
        flows.b_by_temperature[i, k] += b_by_stress * mid.by_temperature[i, k]
    log_a, b = coefficients.log_a, coefficients.b
    log_a[i, VALUE], b[i, VALUE] = np.log(a), problem.speed_1 * total + (problem.speed_2 - problem.speed_1) * mass
    log_a[i, BY_P], b[i, BY_P] = a_by_p + a_by_stress * mid.by_p[i], b_by_p + b_by_stress * mid.by_p[i]
    log_a[i, BY_G], b[i, BY_G] = a_by_g + a_by_stress * mid.by_g[i], b_by_g + b_by_stress * mid.by_g[i]
    log_a[i, BY_H], b[i, BY_H] = a_by_stress * mid.by_h[i], b_by_stress * mid.by_h[i]


@inlined_kernel
def evaluate_column(
    problem: Problem,
    i: int,
    temperature: FloatArray,
    p: float,
    g: float,
    h: float,
    film: Film,
    coefficients: FlowCoefficients,
) -> None:
    """Everything above for column i: nodal temperatures (n, m + 1) [K], p [Pa], G = h dp/dx [Pa], h [m]."""
    total, density_slope = viscosities(problem, i, temperature, p, film.shear)
    if problem.newtonian == 1:
        shear_newtonian(problem, i, g, h, film)
    else:
        shear_eyring(problem, i, g, h, film)
    stress_response(problem, i, h, film)
    flow(problem, i, h, total, density_slope, film, coefficients)
