"""Dense linear algebra for systems of about a hundred unknowns, without the threads of a BLAS.

At this size a threaded BLAS can spend ten times the arithmetic on waking its threads.
"""

import numpy as np

from solvers.arrays import FloatArray, IntArray
from solvers.compiled import kernel

PANEL = 4


@kernel
def dot(a: FloatArray, b: FloatArray) -> float:
    """Scalar product of two vectors (n,), in four partial sums."""
    n = a.size
    s0, s1, s2, s3 = 0.0, 0.0, 0.0, 0.0
    for j in range(0, n - 3, 4):
        s0 += a[j] * b[j]
        s1 += a[j + 1] * b[j + 1]
        s2 += a[j + 2] * b[j + 2]
        s3 += a[j + 3] * b[j + 3]
    for j in range(n - n % 4, n):
        s0 += a[j] * b[j]
    return (s0 + s1) + (s2 + s3)


@kernel
def add_scaled(factor: float, x: FloatArray, y: FloatArray) -> None:
    """Add a multiple of x to y, in place."""
    for j in range(x.size):
        y[j] += factor * x[j]


@kernel
def _subtract_panel(row: FloatArray, first: int, top: FloatArray, target: FloatArray) -> None:
    """Target -= sum of row[first + s] top[s], four rows of `top` (4, n) in one pass."""
    f0, f1, f2, f3 = row[first], row[first + 1], row[first + 2], row[first + 3]
    t0, t1, t2, t3 = top[0], top[1], top[2], top[3]
    for j in range(target.size):
        target[j] -= f0 * t0[j] + f1 * t1[j] + f2 * t2[j] + f3 * t3[j]


@kernel
def _factor_panel(matrix: FloatArray, pivots: IntArray, start: int, stop: int) -> None:
    """Eliminate within columns start..stop, exchanging whole rows."""
    n = pivots.size
    for k in range(start, stop):
        pivot = k + np.abs(matrix[k:, k]).argmax()
        pivots[k] = pivot
        if pivot != k:
            for j in range(n):
                matrix[k, j], matrix[pivot, j] = matrix[pivot, j], matrix[k, j]
        inverse = 1.0 / matrix[k, k]
        for i in range(k + 1, n):
            if matrix[i, k] != 0.0:
                matrix[i, k] *= inverse
                for j in range(k + 1, stop):
                    matrix[i, j] -= matrix[i, k] * matrix[k, j]


@kernel
def factor(matrix: FloatArray, pivots: IntArray) -> None:
    """LU factorisation (n, n) with row pivoting, in place, by panels of four columns; `pivots` (n,)."""
    n = pivots.size
    for start in range(0, n, PANEL):
        stop = min(start + PANEL, n)
        _factor_panel(matrix, pivots, start, stop)
        if stop == n:
            break
        for i in range(start + 1, stop):
            for k in range(start, i):
                add_scaled(-matrix[i, k], matrix[k, stop:], matrix[i, stop:])
        for i in range(stop, n):
            _subtract_panel(matrix[i], start, matrix[start:stop, stop:], matrix[i, stop:])


@kernel
def substitute(factors: FloatArray, pivots: IntArray, vector: FloatArray) -> None:
    """Solve with the factors of `factor` for `vector` (n,), in place."""
    n = pivots.size
    for k in range(n):
        pivot = pivots[k]
        vector[k], vector[pivot] = vector[pivot], vector[k]
    for i in range(1, n):
        vector[i] -= dot(factors[i, :i], vector[:i])
    for i in range(n - 1, -1, -1):
        vector[i] = (vector[i] - dot(factors[i, i + 1 :], vector[i + 1 :])) / factors[i, i]


@kernel
def multiply(matrix: FloatArray, vector: FloatArray, product: FloatArray) -> None:
    """Matrix (n, n) times vector (n,), into `product`."""
    for i in range(vector.size):
        product[i] = dot(matrix[i], vector)


@kernel
def solved(matrix: FloatArray, residual: FloatArray, step: FloatArray) -> bool:
    """Newton's step (n,) against a residual (n,); False where the system has no finite solution.

    For one right-hand side alone LAPACK is quickest; below two hundred unknowns it wakes no threads.
    """
    try:
        step[:] = np.linalg.solve(matrix, -residual)
    except Exception:  # noqa: BLE001  numba knows no narrower one
        return False
    return bool(np.all(np.isfinite(step)))
