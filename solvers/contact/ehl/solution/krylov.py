"""A few steps of GMRES for small dense systems whose operator is known by its products only."""

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.contact.ehl.grid.dense import add_scaled, dot


@kernel
def extend_basis(basis: FloatArray, hessenberg: FloatArray, rotations: FloatArray, rhs: FloatArray, j: int) -> float:
    """Orthogonalise basis[j + 1] (the operator's product with basis[j]) and update the least-squares problem.

    Modified Gram-Schmidt and Givens rotations (Saad and Schultz, 1986). Shapes: basis (m + 1, n), hessenberg (m, m)
    by columns in rows, rotations (m, 2), rhs (m + 1,). Returns the norm of the residual.
    """
    vector = basis[j + 1]
    column = hessenberg[j]
    for i in range(j + 1):
        column[i] = dot(basis[i], vector)
        add_scaled(-column[i], basis[i], vector)
    norm = np.sqrt(dot(vector, vector))
    if norm > 0.0:
        vector /= norm
    for i in range(j):
        upper = rotations[i, 0] * column[i] + rotations[i, 1] * column[i + 1]
        column[i + 1] = rotations[i, 0] * column[i + 1] - rotations[i, 1] * column[i]
        column[i] = upper
    radius = np.hypot(column[j], norm)
    rotations[j, 0], rotations[j, 1] = column[j] / radius, norm / radius
    column[j] = radius
    rhs[j + 1] = -rotations[j, 1] * rhs[j]
    rhs[j] *= rotations[j, 0]
    return float(abs(rhs[j + 1]))


@kernel
def combine_basis(basis: FloatArray, hessenberg: FloatArray, rhs: FloatArray, count: int, solution: FloatArray) -> None:
    """Add the least-squares solution from the first `count` basis vectors to `solution` (n,)."""
    for j in range(count - 1, -1, -1):
        weight = rhs[j]
        for i in range(j + 1, count):
            weight -= hessenberg[i, j] * rhs[i]
        rhs[j] = weight / hessenberg[j, j]
        add_scaled(rhs[j], basis[j], solution)
