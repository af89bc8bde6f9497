"""Functions given by equidistant points, as the compiled kernels read them."""

from solvers.arrays import FloatArray
from solvers.compiled import kernel


@kernel
def tabulated(table: FloatArray, points_per_metre: float, x: float) -> float:
    """Linear interpolation in an equidistant table that begins at x = 0."""
    position = x * points_per_metre
    index = min(max(int(position), 0), table.size - 2)
    low, high = float(table[index]), float(table[index + 1])
    return low + (position - index) * (high - low)
