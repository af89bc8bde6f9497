"""The graded mesh of a contact, with the matrices of elastic deflection and of surface temperature on this mesh."""

from functools import lru_cache
from math import log2, sqrt
from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.compiled import inner_kernel, kernel

SHORTEST_INLET = 4.0  # least distance from the inlet to the centre of the contact, in half widths, chosen
CLEARANCE = 40.0  # ratio of the undeformed gap at the inlet to the central film thickness


@inner_kernel
def _log_integral(t: float) -> float:
    """Return the antiderivative of ln|t|."""
    return t * np.log(abs(t)) - t if t != 0.0 else 0.0


@inner_kernel
def _log_moment(t: float) -> float:
    """Return the antiderivative of t ln|t|."""
    return 0.5 * t * t * np.log(abs(t)) - 0.25 * t * t if t != 0.0 else 0.0


@kernel
def deflection_matrix(x: FloatArray) -> FloatArray:
    """Matrix K (n, n) of deflection in H = H0 + X^2/2 + K P, exact for pressures linear between the nodes (Eq. 21).

    K P = -(1/pi) int P ln|X - X'| dX'. The paper's E is the E' of `reduced_modulus`; its ln|x - s| has no unit of
    length, here b, which changes H0 only. `x` (n,) in half widths.
    """
    n = x.size
    matrix = np.zeros((n, n))
    for i in range(n):
        near = x[0] - x[i]
        integral, moment = _log_integral(near), _log_moment(near)
        for j in range(n - 1):
            far = x[j + 1] - x[i]
            far_integral, far_moment = _log_integral(far), _log_moment(far)
            length = far - near
            zeroth, first = far_integral - integral, far_moment - moment
            matrix[i, j] -= (far * zeroth - first) / (length * np.pi)
            matrix[i, j + 1] -= (first - near * zeroth) / (length * np.pi)
            near, integral, moment = far, far_integral, far_moment
    return matrix


@kernel
def heat_matrix(x: FloatArray) -> FloatArray:
    """Matrix Wt (n, n): int_{x_0}^{x_i} q(s) (x_i - s)^-1/2 ds = sum_j Wt[i, j] q_j, exact for linear q (Eq. 24).

    Moving line source of Carslaw and Jaeger at a high Peclet number. `x` (n,) increasing, in half widths.
    """
    n = x.size
    matrix = np.zeros((n, n))
    for i in range(n):
        for j in range(i):
            far, near = x[i] - x[j], x[i] - x[j + 1]
            root_far, root_near = np.sqrt(far), np.sqrt(near)
            zeroth = 2.0 * (root_far - root_near)
            first = far * zeroth - (far * root_far - near * root_near) * 2.0 / 3.0
            share = first / (far - near)
            matrix[i, j] += zeroth - share
            matrix[i, j + 1] += share
    return matrix


class Grid(NamedTuple):
    """Nodes x (n,) in half widths, and matrices (n, n) and quadrature weights (n,) that depend on the nodes only.

    `deflection` is the matrix K of `deflection_matrix`, and `heat` is the matrix Wt of `heat_matrix`. `weights` are
    the weights of the trapezoidal rule, and also the widths of the cells around the nodes.
    """

    x: FloatArray
    deflection: FloatArray
    heat: FloatArray
    weights: FloatArray


def grid_for(gap: float, nodes: int) -> Grid:
    """Mesh for a film of thickness `gap` (b^2/R), rounded to a power of sqrt(2) so that contacts share meshes."""
    return _grid(round(2.0 * log2(gap)), nodes)


def inlet_length(gap: float) -> float:
    """Return the distance from the inlet to the centre [half widths] for a film of thickness `gap` (in b^2/R)."""
    return max(SHORTEST_INLET, sqrt(2.0 * CLEARANCE * gap))


@lru_cache(maxsize=64)
def _grid(half_octaves: int, nodes: int) -> Grid:
    x = _graded(2.0 ** (half_octaves / 2), nodes)
    weights = np.zeros(nodes)
    weights[:-1] += 0.5 * np.diff(x)
    weights[1:] += 0.5 * np.diff(x)
    return Grid(frozen(x), frozen(deflection_matrix(x)), frozen(heat_matrix(x)), frozen(weights))


def _graded(gap: float, nodes: int) -> FloatArray:
    """Nodes (n,) from inlet to outlet with prescribed relative distances.

    If the film h is much thicker than b^2/R, pressure extends over (2 R h)^1/2 and lengths of the order of b need no
    nodes.
    """
    inlet = -inlet_length(gap)
    outlet = max(1.25, 1.0 + 1.2 * gap ** (2 / 3))
    layer = 0.45 * gap ** (2 / 3) + 0.004
    fine = np.linspace(inlet, outlet, 40 * nodes)
    distance = np.abs(fine - 1.0 + 0.5 * layer)
    spacing = np.minimum(0.12 * layer + 0.14 * np.abs(fine + 1.0), 0.03 * layer + 0.12 * distance)
    inside = np.abs(fine) < 1.0
    spacing[inside] = np.minimum(spacing[inside], 0.035 * max(1.0, sqrt(2.0 * gap)))
    density = 1.0 / spacing
    count = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]) * np.diff(fine))])
    x = np.interp(np.linspace(0.0, count[-1], nodes), count, fine)
    x[0], x[-1] = inlet, outlet
    return x
