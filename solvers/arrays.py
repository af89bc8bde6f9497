"""Array types, read-only arrays, record arrays, and removal of rounding errors from sums."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solvers.compiled import inner_kernel

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.int64]
RecordArray = np.recarray[Any, np.dtype[np.record]]
"""An array whose elements have named fields: `array[i].pressure` in kernels, `array.pressure` for all elements."""

Fields = list[tuple[str, Any]]
"""Names and types of the fields of a record."""

ROUNDING = 1e-12
"""A sum counts as zero if it is smaller than this fraction of the sum of the absolute values of its summands.

The fraction is far above rounding errors, and far below any measurable effect.
"""


def frozen(values: ArrayLike) -> NDArray[Any]:
    """Read-only array of the values; a view if they are an array already."""
    array = np.asarray(values).view()
    array.flags.writeable = False
    return array


def without_rounding(value: float, scale: float) -> float:
    """The sum `value`, or zero if it is below 1e-12 of `scale`, the sum of the absolute summands."""
    return 0.0 if abs(value) < ROUNDING * abs(scale) else value


def records(shape: int | tuple[int, ...], fields: Fields) -> RecordArray:
    """Record array of zeros, as which kernels pass a group of arrays to each other.

    numba counts the references to every array in a call: with separate arrays `pocket_chain` took 3.3 times as long,
    gas dynamics 1.4 times.
    """
    return np.zeros(shape, fields).view(np.recarray)


def floats(*names: str) -> Fields:
    """Return the names and types of record fields that hold one float each."""
    return [(name, np.float64) for name in names]


@inner_kernel
def copy(source: FloatArray, target: FloatArray, count: int) -> None:
    """Copy the first `count` elements; of a slice assignment numba would compile the error text, like ten kernels."""
    for i in range(count):
        target[i] = source[i]
