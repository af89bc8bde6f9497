"""Functions given by equidistant points, as the compiled kernels read them."""

from solvers.arrays import FloatArray
from solvers.compiled import kernel


@kernel
def place_of(x: float, points_per_metre: float, points: int) -> tuple[int, float]:
    """Where x lies among equidistant points from 0 on: the last one before it, and the share of the step beyond."""
    position = x * points_per_metre
    index = min(max(int(position), 0), points - 2)
    return index, position - index


@kernel
def interpolated(table: FloatArray, place: tuple[int, float]) -> float:
    """Linear interpolation at a place of the table's points."""
    index, share = place
    low, high = float(table[index]), float(table[index + 1])
    return low + share * (high - low)
