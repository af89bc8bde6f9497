"""Array types, read-only arrays, record arrays, and removal of rounding errors from sums."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.int64]
RecordArray = np.recarray[Any, np.dtype[np.record]]
"""An array whose elements have named fields: `array[i].pressure` in kernels, `array.pressure` for all elements."""

Fields = list[tuple[str, Any]]
"""Names and types of the fields of a record."""

ROUNDING = 1e-12
"""Ratio of a sum to the sum of the absolute values of its summands, below which the sum counts as zero.

This ratio is far above rounding errors and far below any measured share.
"""


def frozen(values: ArrayLike) -> NDArray[Any]:
    """Return the values as a read-only array; the elements of a given array are not copied."""
    array = np.asarray(values).view()
    array.flags.writeable = False
    return array


def without_rounding(value: float, scale: float) -> float:
    """Return a sum, or zero if the sum is only a rounding error.

    A sum below 1e-12 of `scale` counts as a rounding error, where `scale` is the sum of the absolute values of the
    summands.
    """
    return 0.0 if abs(value) < ROUNDING * abs(scale) else value


def records(shape: int | tuple[int, ...], fields: Fields) -> RecordArray:
    """Return a record array of zeros.

    Kernels pass groups of arrays to each other as one record array, because numba counts references to every array that
    is passed in a call. With one array per field, a run of the pocket chain took 3.3 times as long, and a run of the
    gas dynamics took 1.4 times as long.
    """
    return np.zeros(shape, fields).view(np.recarray)


def floats(*names: str) -> Fields:
    """Return record fields with these names; each field holds one number."""
    return [(name, np.float64) for name in names]
