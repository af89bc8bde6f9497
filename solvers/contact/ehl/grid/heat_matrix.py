"""Temperature of a fast moving surface under a piecewise linear heat flux: the lower triangular matrix Wt."""

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel


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
