"""One column of the film: how much flows, driven by the surfaces and by pressure, and where across the film."""

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import inlined_kernel
from solvers.contact.ehl.film.fluxes import BY_G, BY_H, BY_P, VALUE, FlowCoefficients
from solvers.contact.ehl.film.shear import Film, Shear, shear_eyring, shear_newtonian, stress_response, viscosities
from solvers.contact.ehl.problem import Problem


@inlined_kernel
def flow_moments(i: int, shear: Shear, above: FloatArray) -> tuple[float, float, float, float, float]:
    """Density across the film, above each interval too (m,), and F0, F1, N0, N1 of `flow`."""
    m = shear.stress.shape[1]
    total = 0.0
    for j in range(m - 1, -1, -1):
        above[j] = total + 0.5 * shear.density[i, j] / m
        total += shear.density[i, j] / m
    f0, f1, n0, n1 = 0.0, 0.0, 0.0, 0.0
    for j in range(m):
        zeta = (j + 0.5) / m - 0.5
        phi = shear.effective[i, j] / m
        f0 += phi
        f1 += phi * zeta
        n0 += phi * above[j]
        n1 += phi * zeta * above[j]
    return total, f0, f1, n0, n1


@inlined_kernel
def flow(
    problem: Problem,
    i: int,
    h: float,
    density_slope: float,
    film: Film,
    coefficients: FlowCoefficients,
    above: FloatArray,
) -> None:
    """Flow coefficients A and B of a column, their derivatives at fixed temperature, and its stream functions.

    With phi = rate/stress, F0 = int phi, F1 = int phi (zeta - 1/2), R(zeta) the density above zeta, N0 = int phi R,
    N1 = int phi (zeta - 1/2) R: A = F1 N0/F0 - N1 and B = u1 R(0) + du N0/F0 (Eq. 17, density varying across the
    film as well). `above` (m,) is room for R.
    """
    shear, flows, mid, m = film.shear, film.flow, film.mid, film.shear.stress.shape[1]
    du = problem.speed_2 - problem.speed_1
    total, f0, f1, n0, n1 = flow_moments(i, shear, above)
    lean, mass, drag = f1 / f0, n0 / f0, du / f0
    a = f1 * mass - n1
    per_a = 1.0 / (m * a)
    log_a, b = coefficients.log_a[i], coefficients.b[i]
    log_a[:] = 0.0
    b[:] = 0.0
    log_a[VALUE], b[VALUE] = np.log(a), problem.speed_1 * total + du * mass
    flows.log_a_by_temperature[i, :] = 0.0
    flows.b_by_temperature[i, :] = 0.0
    heating = -problem.laws.density * problem.laws.thermal_expansion
    through_a, through_b, j0, j1 = 0.0, 0.0, 0.0, 0.0
    flows.couette[i, 0], flows.poiseuille[i, 0] = 0.0, 0.0
    for j in range(m):
        zeta = (j + 0.5) / m - 0.5
        effective, slope, rho = shear.effective[i, j], shear.effective_slope[i, j], shear.density[i, j]
        phi = effective / m
        mid0, mid1 = j0 + 0.5 * phi, j1 + 0.5 * phi * zeta
        by_density_a = (lean * mid0 - mid1) * per_a
        by_density_b = (problem.speed_1 + drag * mid0) / m
        flows.couette[i, j + 1] = flows.couette[i, j] + h * rho * by_density_b
        flows.poiseuille[i, j + 1] = flows.poiseuille[i, j] + rho * by_density_a
        j0 += phi
        j1 += phi * zeta
        by_phi_a = (zeta * (mass - above[j]) + lean * (above[j] - mass)) * per_a
        by_phi_b = drag * (above[j] - mass) / m
        through_a += by_phi_a * slope
        through_b += by_phi_b * slope
        pressed = effective * shear.by_pressure[i, j]
        log_a[BY_P] += by_phi_a * pressed + density_slope * by_density_a
        b[BY_P] += by_phi_b * pressed + density_slope * by_density_b
        log_a[BY_G] += by_phi_a * slope * zeta
        b[BY_G] += by_phi_b * slope * zeta
        warm = 0.5 * effective * shear.by_temperature[i, j]
        half_a = by_phi_a * warm + 0.5 * heating * by_density_a
        half_b = by_phi_b * warm + 0.5 * heating * by_density_b
        flows.log_a_by_temperature[i, j] += half_a
        flows.log_a_by_temperature[i, j + 1] += half_a
        flows.b_by_temperature[i, j] += half_b
        flows.b_by_temperature[i, j + 1] += half_b
    for k in range(m + 1):
        flows.log_a_by_temperature[i, k] += through_a * mid.by_temperature[i, k]
        flows.b_by_temperature[i, k] += through_b * mid.by_temperature[i, k]
    log_a[BY_P] += through_a * mid.by_p[i]
    log_a[BY_G] += through_a * mid.by_g[i]
    log_a[BY_H] = through_a * mid.by_h[i]
    b[BY_P] += through_b * mid.by_p[i]
    b[BY_G] += through_b * mid.by_g[i]
    b[BY_H] = through_b * mid.by_h[i]


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
    above: FloatArray,
) -> None:
    """Everything above for column i: nodal temperatures (m + 1,) [K], p [Pa], G = h dp/dx [Pa], h [m]."""
    density_slope = viscosities(problem, i, temperature, p, film.shear)
    if problem.newtonian == 1:
        shear_newtonian(problem, i, g, h, film)
    else:
        shear_eyring(problem, i, g, h, film)
    stress_response(problem, i, h, film)
    flow(problem, i, h, density_slope, film, coefficients, above)
