"""Laws of shear of the oil: Newton's law, and the law of Ree and Eyring.

The stress is tau = tau_m + G (zeta - 1/2), where G is h dp/dx and zeta is the height divided by the film thickness h.
Four functions contain all that depends on the law, and choose the law by `Problem.rheology`:

limited_gradient  G, limited to values at which the law can be evaluated
mid_film_stress   the shear stress half way across a column, for the sliding speed u2 - u1
shear_rates       the shear rate of every interval at the given stress, and its derivative with respect to the stress
uniform_shear     the flow and the mid-film stress in a film at one temperature

A further law needs a name in `inputs.Rheology`, a branch in each of these four functions, and one in
`effective_fluidity`, `mid_film_stress` and `uniform_columns` of `tests/support/line_contact_equations.py`.
"""

from typing import get_args

import numpy as np

from solvers.compiled import inlined_kernel, inner_kernel
from solvers.contact.ehl.inputs import Rheology
from solvers.contact.ehl.problem import Problem
from solvers.contact.ehl.shear import Shear

REE_EYRING, NEWTONIAN = map(get_args(Rheology).index, ("ree_eyring", "newtonian"))
STRESS_LIMIT = 300.0  # largest |h dp/dx|/(2 tau0); exp(300)^2 does not overflow


def softened(problem: Problem, stress: float) -> Problem | None:
    """The problem as a Ree-Eyring one with the Eyring stress `stress` [Pa]; None if its stress is at most that."""
    if problem.rheology == REE_EYRING and stress >= problem.eyring_stress:
        return None
    return problem._replace(rheology=REE_EYRING, eyring_stress=stress)


@inner_kernel
def limited_gradient(problem: Problem, g: float) -> float:
    """G = h dp/dx, limited so that exp(G/(2 tau0)) does not overflow; no solution reaches the limit."""
    if problem.rheology == NEWTONIAN:
        return g
    bound = 2.0 * STRESS_LIMIT * problem.eyring_stress
    return min(max(g, -bound), bound)


@inlined_kernel
def mid_film_stress(problem: Problem, i: int, g: float, h: float, shear: Shear) -> float:
    """Compute the shear stress half way across column i for the sliding speed u2 - u1 [Pa] (Eq. E6)."""
    if problem.rheology == NEWTONIAN:
        return _newtonian_mid_stress(problem, i, g, h, shear)
    return _eyring_mid_stress(problem, i, g, h, shear)


@inlined_kernel
def _newtonian_mid_stress(problem: Problem, i: int, g: float, h: float, shear: Shear) -> float:
    """tau_m of du/h = int (tau_m + G (zeta - 1/2))/eta dzeta, with du = u2 - u1."""
    m = shear.fluidity.shape[1]
    dz, zeroth, first = 1.0 / m, 0.0, 0.0
    for j in range(m):
        zeroth += shear.fluidity[i, j] * dz
        first += shear.fluidity[i, j] * ((j + 0.5) * dz - 0.5) * dz
    stress: float = ((problem.speed_2 - problem.speed_1) / h - g * first) / zeroth
    return stress


@inlined_kernel
def _eyring_mid_stress(problem: Problem, i: int, g: float, h: float, shear: Shear) -> float:
    """tau_m = tau0 a, e^a the positive root of a quadratic; its conjugate form for u2 < u1 avoids cancellation."""
    m = shear.fluidity.shape[1]
    tau0, dz = problem.eyring_stress, 1.0 / m
    # e^(G (zeta - 1/2)/tau0) in the first interval, and the ratio of this factor between neighbouring intervals
    growth, ratio = np.exp(g * (0.5 * dz - 0.5) / tau0), np.exp(g * dz / tau0)
    c_plus, c_minus = 0.0, 0.0
    for j in range(m):
        c_plus += shear.fluidity[i, j] * growth * dz
        c_minus += shear.fluidity[i, j] / growth * dz
        growth *= ratio
    d = (problem.speed_2 - problem.speed_1) / (h * tau0)
    root = np.sqrt(d * d + c_plus * c_minus)
    e_a = (d + root) / c_plus if d >= 0.0 else c_minus / (root - d)
    stress: float = tau0 * np.log(e_a)
    return stress


@inlined_kernel
def shear_rates(problem: Problem, i: int, g: float, tau_m: float, shear: Shear) -> None:
    """Stress, rate and effective fluidity of column i with their derivatives by the stress (Eqs. E4, E5)."""
    if problem.rheology == NEWTONIAN:
        _newtonian_rates(i, g, tau_m, shear)
    else:
        _eyring_rates(problem, i, g, tau_m, shear)


@inlined_kernel
def _newtonian_rates(i: int, g: float, tau_m: float, shear: Shear) -> None:
    """Compute the rate tau/eta of all intervals."""
    m = shear.fluidity.shape[1]
    for j in range(m):
        tau, fluidity = tau_m + g * ((j + 0.5) / m - 0.5), shear.fluidity[i, j]
        shear.stress[i, j], shear.rate[i, j], shear.stiffness[i, j] = tau, tau * fluidity, fluidity
        shear.effective[i, j], shear.effective_slope[i, j] = fluidity, 0.0


@inlined_kernel
def _eyring_rates(problem: Problem, i: int, g: float, tau_m: float, shear: Shear) -> None:
    """Rate (tau0/eta) sinh(tau/tau0) and its derivative, from one exponential."""
    m = shear.fluidity.shape[1]
    per_tau0, dz = 1.0 / problem.eyring_stress, 1.0 / m
    e_s, ratio = np.exp((tau_m + g * (0.5 * dz - 0.5)) * per_tau0), np.exp(g * dz * per_tau0)
    for j in range(m):
        tau, fluidity, inverse = tau_m + g * ((j + 0.5) * dz - 0.5), shear.fluidity[i, j], 1.0 / e_s
        sinh, cosh, s = 0.5 * (e_s - inverse), 0.5 * (e_s + inverse), tau * per_tau0
        e_s *= ratio
        if abs(s) < 1e-3:
            effective, slope = 1.0 + s * s / 6.0, s / 3.0
        else:
            over = 1.0 / s
            effective = sinh * over
            slope = (cosh - effective) * over
        shear.stress[i, j], shear.stiffness[i, j] = tau, fluidity * cosh
        shear.rate[i, j] = tau * fluidity * effective
        shear.effective[i, j], shear.effective_slope[i, j] = fluidity * effective, fluidity * slope * per_tau0


@inlined_kernel
def uniform_shear(problem: Problem, log_eta: float, g: float, h: float) -> tuple[float, float, float, float, float]:
    """Compute flow and mid-film stress of a film at one temperature [Pa] (Eq. E7.2).

    A Newtonian oil has A = rho/(12 eta). For a Ree-Eyring oil, s = G/(2 tau0) and sinh a = eta du s/(tau0 h sinh s),
    where du is u2 - u1. Then tau_m = tau0 a, and 12 eta A/rho = 3 cosh(a) (s cosh s - sinh s)/s^3. In the code, `sigma`
    is s/sinh s and `phi` is 3 (s cosh s - sinh s)/s^3. If s is small, both are computed by series. `sigma_slope` and
    `phi_slope` are the derivatives of ln sigma and ln phi with respect to s.
    """
    du = problem.speed_2 - problem.speed_1
    if problem.rheology == NEWTONIAN:
        return 0.0, 0.0, 0.0, 0.0, float(np.exp(log_eta) * du / h)
    tau0 = problem.eyring_stress
    s = min(abs(g) / (2.0 * tau0), STRESS_LIMIT)
    q = s * s
    if s < 0.3:
        ratio = 1.0 + q / 6.0 * (1.0 + q / 20.0 * (1.0 + q / 42.0 * (1.0 + q / 72.0 * (1.0 + q / 110.0))))
        by_s = s / 3.0 * (1.0 + q / 10.0 * (1.0 + q / 28.0 * (1.0 + q / 54.0 * (1.0 + q / 88.0))))
        sigma, sigma_slope = 1.0 / ratio, -by_s / ratio
        phi = 1.0 + q / 10.0 * (1.0 + q / 28.0 * (1.0 + q / 54.0 * (1.0 + q / 88.0 * (1.0 + q / 130.0))))
        by_s = s / 5.0 * (1.0 + q / 14.0 * (1.0 + q / 36.0 * (1.0 + q / 66.0 * (1.0 + q / 104.0))))
        phi_slope = by_s / phi
    else:
        rise = np.exp(s)
        sinh, cosh = 0.5 * (rise - 1.0 / rise), 0.5 * (rise + 1.0 / rise)
        sigma, sigma_slope = s / sinh, 1.0 / s - cosh / sinh
        moment = s * cosh - sinh
        phi, phi_slope = 3.0 * moment / (q * s), s * sinh / moment - 3.0 / s
    sinh_a = np.exp(log_eta) * sigma * du / (tau0 * h)
    share = sinh_a * sinh_a / (1.0 + sinh_a * sinh_a)
    by_g = (share * sigma_slope + phi_slope) * np.sign(g) / (2.0 * tau0)
    return 0.5 * np.log1p(sinh_a * sinh_a) + np.log(phi), share, by_g, -share / h, float(tau0 * np.arcsinh(sinh_a))
