"""Dense linear algebra for systems of about a hundred unknowns: LU decomposition, products, a few steps of GMRES.

For systems of this size, starting the threads of a BLAS takes up to ten times as long as the arithmetic. The functions
take the indices of rows instead of views of rows, because the creation of a view takes as long as the arithmetic.
"""

import numpy as np

from solvers.arrays import FloatArray, IntArray
from solvers.compiled import inlined_kernel, inner_kernel

PANEL = 8  # number of columns that are eliminated together, chosen for speed


@inner_kernel
def dot(a: FloatArray, b: FloatArray) -> float:
    """Return the scalar product of two vectors (n,)."""
    total = 0.0
    for j in range(a.size):
        total += a[j] * b[j]
    return total


@inner_kernel
def add_scaled(factor: float, x: FloatArray, y: FloatArray) -> None:
    """Add a multiple of x to y, in place."""
    for j in range(x.size):
        y[j] += factor * x[j]


@inlined_kernel
def row_product(matrix: FloatArray, i: int, start: int, stop: int, vector: FloatArray) -> float:
    """Scalar product of elements start..stop of row i and of a vector (n,), in four partial sums for speed."""
    s0, s1, s2, s3 = 0.0, 0.0, 0.0, 0.0
    last = stop - (stop - start) % 4
    for j in range(start, last, 4):
        s0 += matrix[i, j] * vector[j]
        s1 += matrix[i, j + 1] * vector[j + 1]
        s2 += matrix[i, j + 2] * vector[j + 2]
        s3 += matrix[i, j + 3] * vector[j + 3]
    for j in range(last, stop):
        s0 += matrix[i, j] * vector[j]
    return (s0 + s1) + (s2 + s3)


@inlined_kernel
def _factor_panel(matrix: FloatArray, pivots: IntArray, start: int, stop: int) -> None:
    """Eliminate below the diagonal in columns start..stop; later columns only take part in the row exchanges."""
    n = pivots.size
    for k in range(start, stop):
        pivot = k
        for i in range(k + 1, n):
            if abs(matrix[i, k]) > abs(matrix[pivot, k]):
                pivot = i
        pivots[k] = pivot
        if pivot != k:
            for j in range(n):
                matrix[k, j], matrix[pivot, j] = matrix[pivot, j], matrix[k, j]
        inverse = 1.0 / matrix[k, k]
        for i in range(k + 1, n):
            share = matrix[i, k] * inverse
            matrix[i, k] = share
            for j in range(k + 1, stop):
                matrix[i, j] -= share * matrix[k, j]


@inlined_kernel
def _subtract_panel(matrix: FloatArray, i: int, start: int, stop: int) -> None:
    """Subtract multiples of the rows start..start + 7 from row i, in the columns from `stop` on."""
    k = start
    f0, f1, f2, f3 = matrix[i, k], matrix[i, k + 1], matrix[i, k + 2], matrix[i, k + 3]
    f4, f5, f6, f7 = matrix[i, k + 4], matrix[i, k + 5], matrix[i, k + 6], matrix[i, k + 7]
    for j in range(stop, matrix.shape[1]):
        total = f0 * matrix[k, j] + f1 * matrix[k + 1, j] + f2 * matrix[k + 2, j] + f3 * matrix[k + 3, j]
        total += f4 * matrix[k + 4, j] + f5 * matrix[k + 5, j] + f6 * matrix[k + 6, j] + f7 * matrix[k + 7, j]
        matrix[i, j] -= total


@inner_kernel
def factor(matrix: FloatArray, pivots: IntArray) -> None:
    """LU factors of a matrix (n, n) in place, panels of eight columns; `pivots` (n,) receives the exchanged rows."""
    n = pivots.size
    for start in range(0, n, PANEL):
        stop = min(start + PANEL, n)
        _factor_panel(matrix, pivots, start, stop)
        for i in range(start + 1, stop):
            for k in range(start, i):
                share = matrix[i, k]
                for j in range(stop, n):
                    matrix[i, j] -= share * matrix[k, j]
        for i in range(stop, n):
            _subtract_panel(matrix, i, start, stop)


@inner_kernel
def substitute(factors: FloatArray, pivots: IntArray, vector: FloatArray) -> None:
    """Replace the right-hand side `vector` (n,) by the solution of the system that `factor` has factored."""
    n = pivots.size
    for k in range(n):
        pivot = pivots[k]
        vector[k], vector[pivot] = vector[pivot], vector[k]
    for i in range(1, n):
        vector[i] -= row_product(factors, i, 0, i, vector)
    for i in range(n - 1, -1, -1):
        vector[i] = (vector[i] - row_product(factors, i, i + 1, n, vector)) / factors[i, i]


@inner_kernel
def multiply(matrix: FloatArray, vector: FloatArray, product: FloatArray) -> None:
    """Multiply a matrix (n, n) by a vector (n,) and store the result in `product` (n,)."""
    n = vector.size
    for i in range(n):
        product[i] = row_product(matrix, i, 0, n, vector)


@inner_kernel
def extend_basis(basis: FloatArray, hessenberg: FloatArray, rotations: FloatArray, rhs: FloatArray, j: int) -> float:
    """Orthogonalise basis[j + 1] to all earlier basis vectors, and return the norm of the residual of GMRES.

    On entry, basis[j + 1] is the product of the operator and basis[j]. The method is modified Gram-Schmidt with Givens
    rotations (Saad and Schultz, 1986). Shapes: basis (m + 1, n); hessenberg (m, m), whose rows hold the columns of the
    Hessenberg matrix; rotations (m, 2); rhs (m + 1,).
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


@inner_kernel
def combine_basis(basis: FloatArray, hessenberg: FloatArray, rhs: FloatArray, count: int, solution: FloatArray) -> None:
    """Add the least-squares combination of the first `count` basis vectors to `solution` (n,)."""
    for j in range(count - 1, -1, -1):
        weight = rhs[j]
        for i in range(j + 1, count):
            weight -= hessenberg[i, j] * rhs[i]
        rhs[j] = weight / hessenberg[j, j]
        add_scaled(rhs[j], basis[j], solution)
