"""Elastic deflection of two half-spaces under a piecewise linear pressure: the dense matrix K."""

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel


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

    The integral -(1/pi) int P ln|X - X'| dX' of Eq. 21. The paper's E is E' of Eq. 14 and its ln|x - s| has an
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
