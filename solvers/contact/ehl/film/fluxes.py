"""Mass flux through the film: what the columns' flow coefficients make of pressure and film, with derivatives."""

from typing import NamedTuple

import numpy as np

from solvers.arrays import BoolArray, FloatArray
from solvers.compiled import kernel
from solvers.contact.ehl.grid.dense import multiply
from solvers.contact.ehl.grid.mesh import Grid
from solvers.contact.ehl.problem import Problem

# Columns of the coefficient arrays: value, and derivatives by p, by G = h dp/dx and by h.
VALUE, BY_P, BY_G, BY_H = 0, 1, 2, 3


class FlowCoefficients(NamedTuple):
    """Of the mass flux m = B h - A h^3 dp/dx at each node: ln A and B with their derivatives, (n, 4) each.

    Derivatives are total ones: where temperature is unknown they include its response.
    """

    log_a: FloatArray
    b: FloatArray


class FaceFluxes(NamedTuple):
    """Mass flux (divided by flux_scale) through the face right of each node, and its derivatives.

    Shapes: flux (n,); by_pressure (n, 5): nodes i-2..i+2; by_film (n, 3): nodes i-1..i+1; by_b (n, 2): B of the node
    and of its neighbour upstream (at the first face: downstream); by_log_a (n, 2): ln A of nodes i, i+1.
    """

    flux: FloatArray
    by_b: FloatArray
    by_log_a: FloatArray
    by_pressure: FloatArray
    by_film: FloatArray


def flow_coefficients(nodes: int) -> FlowCoefficients:
    """Room for the coefficients of `nodes` nodes."""
    return FlowCoefficients(np.zeros((nodes, 4)), np.zeros((nodes, 4)))


def face_fluxes(nodes: int) -> FaceFluxes:
    """Room for the faces of `nodes` nodes."""
    return FaceFluxes(
        np.zeros(nodes), np.zeros((nodes, 2)), np.zeros((nodes, 2)), np.zeros((nodes, 5)), np.zeros((nodes, 3))
    )


@kernel
def film_shape(grid: Grid, pressure: FloatArray, separation: float, film: FloatArray) -> None:
    """H = H0 + X^2/2 + K P into `film` (Eq. 21)."""
    multiply(grid.deflection, pressure, film)
    for i in range(film.size):
        film[i] += separation + 0.5 * grid.x[i] ** 2


@kernel
def gradient_stencil(x: FloatArray, i: int, cavitated: BoolArray) -> tuple[int, int, float]:
    """The two nodes whose pressure difference makes dP/dX at node i, and its factor."""
    n = x.size
    left, right = max(i - 1, 0), min(i + 1, n - 1)
    if cavitated[i]:
        return left, right, 0.0
    if i + 1 < n and cavitated[i + 1]:
        left = i
    return left, right, 1.0 / (x[right] - x[left])


@kernel
def pressure_gradients(x: FloatArray, pressure: FloatArray, cavitated: BoolArray, gradient: FloatArray) -> None:
    """dP/dX at the nodes: central, one-sided at the inlet, zero where the film is broken.

    The last node before the rupture looks forward, so that its gradient vanishes with its pressure: a node can join
    the broken film without a jump.
    """
    for i in range(x.size):
        left, right, factor = gradient_stencil(x, i, cavitated)
        gradient[i] = factor * (pressure[right] - pressure[left])


@kernel
def _log_mean(a: float, b: float) -> tuple[float, float]:
    """Logarithmic mean of e^a and e^b and its logarithmic derivative by a; exact for an exponential between nodes."""
    half = 0.5 * (a - b)
    if abs(half) < 1e-3:
        return np.exp(0.5 * (a + b)) * (1.0 + half * half / 6.0), 0.5 + half / 6.0
    mean = (np.exp(a) - np.exp(b)) / (a - b)
    return mean, 0.5 + 0.5 * (1.0 / np.tanh(half) - 1.0 / half)


@kernel
def assemble_faces(
    problem: Problem,
    x: FloatArray,
    pressure: FloatArray,
    film: FloatArray,
    gradient: FloatArray,
    cavitated: BoolArray,
    coefficients: FlowCoefficients,
    faces: FaceFluxes,
) -> None:
    """Fluxes m = B H - A H^3 dP/dX through the faces between nodes, with their derivatives.

    The Couette part is extrapolated from the two nodes upstream (second order; first order upwinding thickens the
    film by 12 per cent), the Poiseuille part uses the logarithmic mean of A.
    """
    n = x.size
    p_scale, h_scale = problem.maximum_pressure, problem.gap_scale
    couette_scale = h_scale / problem.flux_scale
    slope = p_scale / problem.half_width
    poiseuille_scale = h_scale**3 * slope / problem.flux_scale
    log_a, b = coefficients.log_a, coefficients.b
    for i in range(n - 1):
        faces.by_pressure[i, :] = 0.0
        faces.by_film[i, :] = 0.0
        flux = 0.0
        ratio = 0.5 * (x[i + 1] - x[i]) / (x[i] - x[i - 1]) if i > 0 else -0.5
        other = i - 1 if i > 0 else 1
        for side in range(2):
            node, weight = (i, 1.0 + ratio) if side == 0 else (other, -ratio)
            scale = weight * couette_scale
            flux += scale * b[node, VALUE] * film[node]
            faces.by_b[i, side] = scale * film[node]
            by_g = scale * film[node] * b[node, BY_G] * slope
            left, right, factor = gradient_stencil(x, node, cavitated)
            h = film[node] * h_scale
            faces.by_pressure[i, node - i + 2] += scale * film[node] * b[node, BY_P] * p_scale
            faces.by_pressure[i, right - i + 2] += by_g * h * factor
            faces.by_pressure[i, left - i + 2] -= by_g * h * factor
            faces.by_film[i, node - i + 1] += scale * (
                b[node, VALUE] + film[node] * h_scale * (b[node, BY_H] + b[node, BY_G] * slope * gradient[node])
            )
        mean, share = _log_mean(log_a[i, VALUE], log_a[i + 1, VALUE])
        height = 0.5 * (film[i] + film[i + 1])
        conductance = poiseuille_scale * mean * height**3 / (x[i + 1] - x[i])
        poiseuille = conductance * (pressure[i + 1] - pressure[i])
        flux -= poiseuille
        faces.by_pressure[i, 3] -= conductance
        faces.by_pressure[i, 2] += conductance
        for side in range(2):
            node, weight = (i, share) if side == 0 else (i + 1, 1.0 - share)
            scale = -poiseuille * weight
            faces.by_log_a[i, side] = scale
            left, right, factor = gradient_stencil(x, node, cavitated)
            h = film[node] * h_scale
            faces.by_pressure[i, node - i + 2] += scale * log_a[node, BY_P] * p_scale
            if right - i + 2 < 5:
                faces.by_pressure[i, right - i + 2] += scale * log_a[node, BY_G] * slope * h * factor
            faces.by_pressure[i, left - i + 2] -= scale * log_a[node, BY_G] * slope * h * factor
            by_h = log_a[node, BY_H] + log_a[node, BY_G] * slope * gradient[node]
            faces.by_film[i, node - i + 1] += scale * h_scale * by_h - 1.5 * poiseuille / height
        faces.flux[i] = flux


@kernel
def add_flux_changes(
    faces: FaceFluxes, cavitated: BoolArray, log_a: FloatArray, b: FloatArray, residual: FloatArray
) -> None:
    """Add to `residual` (n + 1,) what changes of ln A and B at the nodes (n,) do to the balance of mass."""
    before = 0.0
    for i in range(cavitated.size - 1):
        other = i - 1 if i > 0 else 1
        change = faces.by_b[i, 0] * b[i] + faces.by_b[i, 1] * b[other]
        change += faces.by_log_a[i, 0] * log_a[i] + faces.by_log_a[i, 1] * log_a[i + 1]
        if i > 0 and not cavitated[i]:
            residual[i] += change - before
        before = change
