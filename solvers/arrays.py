"""Array types and the rule that a result's arrays are read-only."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.int64]


def frozen(values: ArrayLike) -> NDArray[Any]:
    """The values as a read-only array (a view where they are an array already)."""
    array = np.asarray(values).view()
    array.flags.writeable = False
    return array
