"""The graded mesh of a contact, with the matrices that depend on it alone."""

from functools import lru_cache
from math import log2, sqrt
from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.contact.ehl.grid.deflection import deflection_matrix
from solvers.contact.ehl.grid.heat_matrix import heat_matrix

SHORTEST_INLET = 4.0
CLEARANCE = 40.0  # undeformed gap at the inlet over the central film


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
