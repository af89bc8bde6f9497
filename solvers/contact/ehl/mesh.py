"""The graded mesh of a contact, with the matrices that depend on it alone."""

from dataclasses import dataclass
from functools import lru_cache
from math import log2, sqrt

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.contact.ehl.deflection import deflection_matrix
from solvers.contact.ehl.heat_matrix import heat_matrix

STARVED_INLET = -4.0  # the shortest inlet
LONGEST_INLET = -60.0
CLEARANCE = 40.0  # undeformed gap at the inlet over the central film


@dataclass(frozen=True, slots=True)
class Mesh:
    """Nodes x (n,) in half widths, deflection and heat matrices (n, n), quadrature weights and cell widths (n,).

    `deflection` is K, `heat` is Wt; the trapezoidal weights of the nodes are also the widths of their cells.
    """

    x: FloatArray
    deflection: FloatArray
    heat: FloatArray
    weights: FloatArray
    inlet_at_cap: bool


def mesh_for(gap: float, nodes: int) -> Mesh:
    """Mesh graded for a film of `gap` (in b^2/R), rounded to a power of sqrt(2) so that few meshes serve all."""
    return _mesh(round(2.0 * log2(gap)), nodes)


@lru_cache(maxsize=64)
def _mesh(half_octaves: int, nodes: int) -> Mesh:
    gap = 2.0 ** (half_octaves / 2)
    x = _graded(gap, nodes)
    weights = np.zeros(nodes)
    weights[:-1] += 0.5 * np.diff(x)
    weights[1:] += 0.5 * np.diff(x)
    return Mesh(
        x=frozen(x),
        deflection=frozen(deflection_matrix(x)),
        heat=frozen(heat_matrix(x)),
        weights=frozen(weights),
        inlet_at_cap=-sqrt(2.0 * CLEARANCE * gap) < LONGEST_INLET,
    )


def _graded(gap: float, nodes: int) -> FloatArray:
    """Nodes that equidistribute 1/spacing between inlet and outlet (n,)."""
    inlet = min(STARVED_INLET, max(LONGEST_INLET, -sqrt(2.0 * CLEARANCE * gap)))
    outlet = max(1.25, 1.0 + 1.2 * gap ** (2 / 3))
    layer = 0.45 * gap ** (2 / 3) + 0.004
    fine = np.linspace(inlet, outlet, 40 * nodes)
    distance = np.abs(fine - 1.0 + 0.5 * layer)
    spacing = np.minimum(0.12 * layer + 0.14 * np.abs(fine + 1.0), 0.03 * layer + 0.12 * distance)
    spacing[np.abs(fine) < 1.0] = np.minimum(spacing[np.abs(fine) < 1.0], 0.035)
    density = 1.0 / spacing
    count = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]) * np.diff(fine))])
    x = np.interp(np.linspace(0.0, count[-1], nodes), count, fine)
    x[0], x[-1] = inlet, outlet
    return x
