"""The largest value over a revolution of what peaks between the rotor angles sampled."""

from collections.abc import Callable

import numpy as np

from solvers.arrays import FloatArray

_PEAKS = 8
_FINER = np.arange(-1.0, 1.125, 0.125)


def largest_value(angles: FloatArray, values_at: Callable[[FloatArray], FloatArray]) -> float:
    """Largest value over evenly spaced rotor angles [rad], searched again in steps eight times as fine.

    The second search is around the local maxima that may hide the largest value, were they to rise for half a step as
    they did before: between few loaded teeth a peak lasts but a fraction of a pitch, and each tooth has its own.
    `values_at` takes rotor angles (rows) and returns one value each.
    """
    coarse = values_at(angles)
    before, after = np.roll(coarse, 1), np.roll(coarse, -1)
    local = np.flatnonzero((coarse >= before) & (coarse >= after))
    reach = 1.5 * coarse - 0.5 * np.minimum(before, after)
    peaks = local[np.argsort(reach[local])[-_PEAKS:]]
    around = (angles[1] - angles[0]) * _FINER
    fine = values_at((angles[peaks, None] + around).ravel())
    return float(max(coarse.max(), fine.max()))
