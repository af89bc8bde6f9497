"""Array types, read-only results, and sums without their rounding."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.int64]
RecordArray = np.recarray[Any, np.dtype[np.record]]
"""An array whose elements have named fields: `array[i].pressure` in kernels, `array.pressure` for all of them."""

Fields = list[tuple[str, Any]]
"""Names and types of the fields of a record."""

ROUNDING = 1e-12
"""Of what is summed: far above the rounding of a sum of doubles, far below anything that is measured."""


def frozen(values: ArrayLike) -> NDArray[Any]:
    """Return the values as a read-only array; an array is not copied."""
    array = np.asarray(values).view()
    array.flags.writeable = False
    return array


def without_rounding(value: float, scale: float) -> float:
    """Return the value, or zero if it is below 1e-12 of `scale`, the sum of its parts without their signs."""
    return 0.0 if abs(value) < ROUNDING * abs(scale) else value


def records(shape: int | tuple[int, ...], fields: Fields) -> RecordArray:
    """Return a record array of zeros.

    Kernels share their arrays as records because numba counts references to every array of a group in a call. With one
    array per field, a march of the pocket chain took 3.3 times as long, and a march of the gas dynamics 1.4 times.
    """
    return np.zeros(shape, fields).view(np.recarray)


def floats(*names: str) -> Fields:
    """Return fields of these names that are all numbers."""
    return [(name, np.float64) for name in names]
