"""How far an output can change without meaning anything."""

from collections.abc import Sequence

import numpy as np

from solvers.arrays import FloatArray

NOISE = 1e-7  # relative change of an output that the tolerance of an iteration can cause


def is_constant(outputs: Sequence[float] | FloatArray) -> bool:
    """Return whether there are several outputs, all of them the same."""
    found = np.asarray(outputs, dtype=np.float64)
    return found.size > 1 and bool(np.ptp(found) <= NOISE * np.abs(found).max())
