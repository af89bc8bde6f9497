"""The graded mesh of a contact with the matrices of elastic deflection and of surface temperature on it."""

from functools import lru_cache
from math import log2, sqrt
from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.compiled import kernel

SHORTEST_INLET = 4.0  # half widths of the contact upstream of its centre, chosen
CLEARANCE = 40.0  # undeformed gap at the inlet over the central film


@kernel
def _log_integral(t: float) -> float:
    """Antiderivative of ln|t|."""
    return t * np.log(abs(t)) - t if t != 0.0 else 0.0


@kernel
def _log_moment(t: float) -> float:
    """Antiderivative of t ln|t|."""
    return 0.5 * t * t * np.log(abs(t)) - 0.25 * t * t if t != 0.0 else 0.0


@kernel
def deflection_matrix(x: FloatArray) -> FloatArray:
    """K with H = H0 + X^2/2 + K P, exact for pressures linear between the nodes x (n,); shape (n, n).

    The integral -(1/pi) int P ln|X - X'| dX' of Eq. 21. The paper's E is the E' of Hertz and its ln|x - s| has an
    arbitrary length unit, absorbed by H0; here b.
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
    """Wt with int_{x_0}^{x_i} q(s) (x_i - s)^-1/2 ds = sum_j Wt[i, j] q_j, exact for q linear between nodes.

    `x` (n,) increasing; shape (n, n). Carslaw and Jaeger's moving line source at high Peclet number (Eq. 24).
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
    """Nodes x (n,) in half widths, with the matrices (n, n) and quadrature weights (n,) that depend on them alone.

    `deflection` is K, `heat` is Wt; the trapezoidal weights of the nodes are also the widths of their cells.
    """

    x: FloatArray
    deflection: FloatArray
    heat: FloatArray
    weights: FloatArray


def grid_for(gap: float, nodes: int) -> Grid:
    """Mesh graded for a film of `gap` (in b^2/R), rounded to a power of sqrt(2) so that few meshes serve all."""
    return _grid(round(2.0 * log2(gap)), nodes)


def inlet_length(gap: float) -> float:
    """Distance of the inlet from the centre that a film of `gap` needs, in half widths."""
    return max(SHORTEST_INLET, sqrt(2.0 * CLEARANCE * gap))


@lru_cache(maxsize=64)
def _grid(half_octaves: int, nodes: int) -> Grid:
    x = _graded(2.0 ** (half_octaves / 2), nodes)
    weights = np.zeros(nodes)
    weights[:-1] += 0.5 * np.diff(x)
    weights[1:] += 0.5 * np.diff(x)
    return Grid(frozen(x), frozen(deflection_matrix(x)), frozen(heat_matrix(x)), frozen(weights))


def _graded(gap: float, nodes: int) -> FloatArray:
    """Nodes that equidistribute 1/spacing between inlet and outlet (n,).

    A film much thicker than b^2/R carries its pressure over (2 R h)^1/2 rather than b, which then needs no resolution.
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
