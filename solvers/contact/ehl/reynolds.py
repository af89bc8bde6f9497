"""Reynolds' equation: mass flux between columns, conservation of mass and load, and nodes of broken film."""

from typing import NamedTuple

import numpy as np

from solvers.arrays import BoolArray, FloatArray, copy
from solvers.compiled import inlined_kernel, inner_kernel
from solvers.contact.ehl.flow import FlowCoefficients
from solvers.contact.ehl.grid import Grid
from solvers.contact.ehl.linear_algebra import multiply
from solvers.contact.ehl.problem import Problem

PATIENCE = 10  # number of iterations before the rupture tolerance applies
RUPTURE_TOLERANCE = 5e-3  # share of the flux, see `release_cavitated`
HALVINGS = 12  # largest number of halvings of a step; a step below 1/4096 of Newton's step does not help


class FaceFluxes(NamedTuple):
    """Mass flux through the face on the right of each node, divided by `flux_scale`, and its derivatives.

    `flux` (n,) is the mass flux, and `conductance` (n,) is A H^3/dX in the same units. Row i of the other fields holds
    derivatives of the flux through the face on the right of node i. `by_b` (n, 2) holds the derivatives with respect to
    B of nodes i and i-1; at the first face, the nodes are 0 and 1. `by_log_a` (n, 2) holds the derivatives with respect
    to ln A of nodes i and i+1. `by_pressure` (n, 5) holds the derivatives with respect to P of nodes i-2..i+2.
    `by_film` (n, 3) holds the derivatives with respect to H of nodes i-1..i+1.
    """

    flux: FloatArray
    conductance: FloatArray
    by_b: FloatArray
    by_log_a: FloatArray
    by_pressure: FloatArray
    by_film: FloatArray


def face_arrays(nodes: int) -> FaceFluxes:
    """Return zeroed arrays for the faces of `nodes` nodes."""
    flux, conductance = np.zeros((2, nodes))
    by_b, by_log_a = np.zeros((2, nodes, 2))
    return FaceFluxes(flux, conductance, by_b, by_log_a, np.zeros((nodes, 5)), np.zeros((nodes, 3)))


@inner_kernel
def film_shape(grid: Grid, pressure: FloatArray, separation: float, film: FloatArray) -> None:
    """Compute the film thickness H = H0 + X^2/2 + K P at all nodes, in place (Eq. 21).

    `pressure`: pressures P (n,) [Hertzian pressure]; `film`: receives H (n,) [b^2/R].
    """
    multiply(grid.deflection, pressure, film)
    for i in range(film.size):
        film[i] += separation + 0.5 * grid.x[i] ** 2


@inner_kernel
def gradient_stencil(x: FloatArray, i: int, cavitated: BoolArray) -> tuple[int, int, float]:
    """Return the two nodes whose pressure difference gives dP/dX at node i, and the factor of this difference."""
    n = x.size
    left, right = max(i - 1, 0), min(i + 1, n - 1)
    if cavitated[i]:
        return left, right, 0.0
    if i + 1 < n and cavitated[i + 1]:
        left = i
    return left, right, 1.0 / (x[right] - x[left])


@inner_kernel
def pressure_gradients(x: FloatArray, pressure: FloatArray, cavitated: BoolArray, gradient: FloatArray) -> None:
    """dP/dX (n,) at all nodes, in place (Eq. E14).

    One-sided at the inlet and the last node before the rupture, zero where the film is broken, else central. Forward at
    the last node, the gradient vanishes with its pressure, and the node joins the broken film without a jump.
    """
    for i in range(x.size):
        left, right, factor = gradient_stencil(x, i, cavitated)
        gradient[i] = factor * (pressure[right] - pressure[left])


@inner_kernel
def _log_mean(a: float, b: float) -> tuple[float, float]:
    """Logarithmic mean of e^a and e^b, exact for an exponential between nodes, and d(ln mean)/da."""
    half = 0.5 * (a - b)
    middle = np.exp(0.5 * (a + b))
    if abs(half) < 1e-2:
        square = half * half
        return middle * (1.0 + square / 6.0 * (1.0 + square / 20.0)), 0.5 + half / 6.0 * (1.0 - square / 15.0)
    rise = np.exp(half)
    fall = 1.0 / rise
    return middle * (rise - fall) / (a - b), 0.5 + 0.5 * ((rise + fall) / (rise - fall) - 1.0 / half)


@inner_kernel
def mass_fluxes(
    problem: Problem,
    x: FloatArray,
    pressure: FloatArray,
    film: FloatArray,
    coefficients: FlowCoefficients,
    faces: FaceFluxes,
) -> None:
    """Mass fluxes m = B H - A H^3 dP/dX through the faces and derivatives by ln A and B, in place (Eqs. E7, E13).

    Couette part extrapolated to second order from the two nodes upstream (first order: film 12 % thicker), Poiseuille
    part with the logarithmic mean of A.
    """
    couette_scale, poiseuille_scale = _flux_scales(problem)
    log_a, b = coefficients.log_a, coefficients.b
    for i in range(x.size - 1):
        upstream, weight = _upstream(x, i)
        faces.by_b[i, 0] = (1.0 - weight) * couette_scale * film[i]
        faces.by_b[i, 1] = weight * couette_scale * film[upstream]
        mean, share = _log_mean(log_a[i].value, log_a[i + 1].value)
        height = 0.5 * (film[i] + film[i + 1])
        faces.conductance[i] = poiseuille_scale * mean * height**3 / (x[i + 1] - x[i])
        poiseuille = faces.conductance[i] * (pressure[i + 1] - pressure[i])
        faces.by_log_a[i, 0], faces.by_log_a[i, 1] = -share * poiseuille, (share - 1.0) * poiseuille
        faces.flux[i] = faces.by_b[i, 0] * b[i].value + faces.by_b[i, 1] * b[upstream].value - poiseuille


@inner_kernel
def mass_flux_slopes(
    problem: Problem,
    grid: Grid,
    film: FloatArray,
    gradient: FloatArray,
    cavitated: BoolArray,
    coefficients: FlowCoefficients,
    faces: FaceFluxes,
) -> None:
    """Derivatives of the mass fluxes by pressures and film thicknesses: chain rule over B and ln A of each node."""
    n, (couette_scale, _), b, log_a = grid.x.size, _flux_scales(problem), coefficients.b, coefficients.log_a
    slope = problem.maximum_pressure / problem.half_width
    b_by_p, a_by_p, b_by_h, a_by_h = np.zeros((n, 3)), np.zeros((n, 3)), np.empty(n), np.empty(n)
    for i in range(n):
        left, right, factor = gradient_stencil(grid.x, i, cavitated)
        by_gradient, per_node = slope * problem.gap_scale, slope * problem.gap_scale * film[i] * factor
        for coefficient, by_p, by_h in ((b, b_by_p, b_by_h), (log_a, a_by_p, a_by_h)):
            by_p[i, 1] += coefficient[i].by_p * problem.maximum_pressure
            by_p[i, right - i + 1] += coefficient[i].by_g * per_node
            by_p[i, left - i + 1] -= coefficient[i].by_g * per_node
            by_h[i] = coefficient[i].by_h * problem.gap_scale + coefficient[i].by_g * by_gradient * gradient[i]
    by_pressure, by_film = faces.by_pressure, faces.by_film
    for i in range(n - 1):
        up, weight = _upstream(grid.x, i)
        of_b, of_up, of_a, of_next = faces.by_b[i, 0], faces.by_b[i, 1], faces.by_log_a[i, 0], faces.by_log_a[i, 1]
        by_pressure[i, 0], by_pressure[i, 4] = 0.0, 0.0
        for k in range(3):
            by_pressure[i, k + 1] = of_b * b_by_p[i, k] + of_a * a_by_p[i, k]
        for k in range(3):
            by_pressure[i, k + 2] += of_next * a_by_p[i + 1, k]
            by_pressure[i, k + up - i + 1] += of_up * b_by_p[up, k]
        by_pressure[i, 2] += faces.conductance[i]
        by_pressure[i, 3] -= faces.conductance[i]
        by_height = 3.0 * (of_a + of_next) / (film[i] + film[i + 1])
        by_film[i, 0] = 0.0
        by_film[i, 1] = (1.0 - weight) * couette_scale * b[i].value
        by_film[i, 1] += of_b * b_by_h[i] + of_a * a_by_h[i] + by_height
        by_film[i, 2] = of_next * a_by_h[i + 1] + by_height
        by_film[i, up - i + 1] += weight * couette_scale * b[up].value + of_up * b_by_h[up]


@inlined_kernel
def _flux_scales(problem: Problem) -> tuple[float, float]:
    """Return the factors by which B H and A H^3 dP/dX are multiplied to get mass fluxes divided by `flux_scale`."""
    couette = problem.gap_scale / problem.flux_scale
    return couette, couette * problem.gap_scale**2 * problem.maximum_pressure / problem.half_width


@inlined_kernel
def _upstream(x: FloatArray, i: int) -> tuple[int, float]:
    """Second node of the extrapolation of B H to the face on the right of node i, and its weight (0.5 at i = 0)."""
    if i == 0:
        return 1, 0.5
    return i - 1, -0.5 * (x[i + 1] - x[i]) / (x[i] - x[i - 1])


@inner_kernel
def add_flux_changes(
    faces: FaceFluxes, cavitated: BoolArray, log_a: FloatArray, b: FloatArray, residual: FloatArray
) -> None:
    """Update the mass balances in `residual` (n + 1,) for changes `log_a` and `b` (n,) of ln A and B."""
    before = 0.0
    for i in range(cavitated.size - 1):
        other = i - 1 if i > 0 else 1
        change = faces.by_b[i, 0] * b[i] + faces.by_b[i, 1] * b[other]
        change += faces.by_log_a[i, 0] * log_a[i] + faces.by_log_a[i, 1] * log_a[i + 1]
        if i > 0 and not cavitated[i]:
            residual[i] += change - before
        before = change


@inner_kernel
def balance_of_mass(
    grid: Grid, pressure: FloatArray, cavitated: BoolArray, faces: FaceFluxes, residual: FloatArray
) -> None:
    """Compute the residuals of the balance of mass and of the balance of load, in place (Eqs. E7, 22).

    `pressure`: pressures P (n,) [Hertzian pressure]; `cavitated`: whether the film is broken at the nodes (n,);
    `residual`: receives the residuals (n + 1,): P at both ends and at broken nodes; the outflow minus the inflow at all
    other nodes; after the nodes, the residual of the load [-].
    """
    n = grid.x.size
    residual[n] = -0.5 * np.pi
    for i in range(n):
        if i == 0 or i == n - 1 or cavitated[i]:
            residual[i] = pressure[i]
        else:
            residual[i] = faces.flux[i] - faces.flux[i - 1]
        residual[n] += grid.weights[i] * pressure[i]


@inner_kernel
def assemble_jacobian(grid: Grid, cavitated: BoolArray, faces: FaceFluxes, jacobian: FloatArray) -> None:
    """Compute the derivatives of the residuals of `balance_of_mass` with respect to P_0..P_n-1 and H0."""
    n = grid.x.size
    deflection, by_film, by_pressure = grid.deflection, faces.by_film, faces.by_pressure
    for i in range(n):
        if i == 0 or i == n - 1 or cavitated[i]:
            jacobian[i, :] = 0.0
            jacobian[i, i] = 1.0
            continue
        # The fluxes through the faces right and left of a node depend on the film thickness at four nodes.
        far, left, here, right = max(i - 2, 0), i - 1, i, i + 1
        by_far, by_left = -by_film[i - 1, 0], by_film[i, 0] - by_film[i - 1, 1]
        by_here, by_right = by_film[i, 1] - by_film[i - 1, 2], by_film[i, 2]
        for j in range(n):
            jacobian[i, j] = (
                by_far * deflection[far, j]
                + by_left * deflection[left, j]
                + by_here * deflection[here, j]
                + by_right * deflection[right, j]
            )
        jacobian[i, n] = by_far + by_left + by_here + by_right
        for k in range(max(i - 2, 0), min(i + 3, n)):
            jacobian[i, k] += by_pressure[i, k - i + 2]
        for k in range(max(i - 3, 0), min(i + 2, n)):
            jacobian[i, k] -= by_pressure[i - 1, k - i + 3]
    for j in range(n):
        jacobian[n, j] = grid.weights[j]
    jacobian[n, n] = 0.0


@inner_kernel
def release_cavitated(faces: FaceFluxes, cavitated: BoolArray, tolerance: float) -> bool:
    """Move nodes into which more oil flows than out to the full film; return whether any was moved.

    Only beyond `tolerance` times the flux, or a node at the edge could change sides for ever.
    """
    changed = False
    for i in range(1, cavitated.size - 1):
        if cavitated[i] and faces.flux[i] - faces.flux[i - 1] < -tolerance * abs(faces.flux[i]):
            cavitated[i] = False
            changed = True
    return changed


@inner_kernel
def apply_pressure_step(
    grid: Grid,
    pressure: FloatArray,
    separation: FloatArray,
    cavitated: BoolArray,
    step: FloatArray,
    scale: float,
) -> tuple[float, bool]:
    """Change pressures P and separation H0 by `scale` times the step (n + 1,), or by less if the film would close.

    If the pressure at a node downstream of the centre would fall below zero, this node joins the broken film. The
    result is the scale that was used, and whether any node joined the broken film. The pressure at both ends is set to
    zero, because a state from another mesh may have other values there.
    """
    n = grid.x.size
    trial, film = np.empty(n), np.empty(n)
    for _ in range(HALVINGS):
        for i in range(n):
            trial[i] = pressure[i] + scale * step[i]
            if grid.x[i] > 0.0 and trial[i] < 0.0:
                trial[i] = 0.0
        trial[0], trial[n - 1] = 0.0, 0.0
        film_shape(grid, trial, separation[0] + scale * step[n], film)
        if film.min() > 0.0:
            break
        scale *= 0.5
    joined = False
    for i in range(1, n - 1):
        if grid.x[i] > 0.0 and pressure[i] + scale * step[i] < 0.0 and not cavitated[i]:
            cavitated[i] = True
            joined = True
    copy(trial, pressure, n)
    separation[0] += scale * step[n]
    return scale, joined
