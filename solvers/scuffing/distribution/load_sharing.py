"""The load-sharing diagrams of ISO/TR 13989-1 for helical gears (the paper's Fig. 19), for comparison only.

Eq. 15 is in the paper; the forms of X_Gamma and of the buttressing factor X_but are quoted from general knowledge of
the standard and were not read again.
"""

import numpy as np

from solvers.arrays import FloatArray
from solvers.gears.path_of_contact import PathOfContact


def iso_load_sharing(path: PathOfContact, x: FloatArray) -> FloatArray | None:
    """X_Gamma X_but at distances x [m] from A; None where the standard draws no diagram.

    Narrow gears (eps_gamma < 2) share as spur gears of quality 7 or better do, wide gears by 1 / eps_alpha. Not
    defined below eps_alpha = 1, nor for spur gears from eps_alpha = 2.
    """
    ratio = path.transverse_contact_ratio
    if ratio < 1.0 or (path.overlap_ratio == 0.0 and ratio >= 2.0):
        return None
    if path.total_contact_ratio < 2.0:
        shared = _narrow(x, path.length, path.length - path.plane.base_pitch)
    else:
        shared = np.full_like(x, 1.0 / ratio)
    return shared * _buttressing(path, x)


def _narrow(x: FloatArray, length: float, double: float) -> FloatArray:
    """1/3 to 2/3 over the double contact A-B, 1 between B and D, mirrored to E."""
    from_end = np.minimum(x, length - x)
    with_mate = 1 / 3 + from_end / (3 * double) if double > 0.0 else np.ones_like(x)
    return np.where(from_end < double, with_mate, 1.0)


def _buttressing(path: PathOfContact, x: FloatArray) -> FloatArray:
    """1 + 0.3 min(eps_beta, 1) at A and E, falling to 1 over 0.2 sin beta_b of Gamma (Eq. 15); 1 for spur gears."""
    plane = path.plane
    ramp = 0.2 * plane.tan_base_helix * plane.cos_base_helix * path.pitch_point
    if ramp == 0.0:
        return np.ones_like(x)
    from_end = np.minimum(x, path.length - x)
    return 1.0 + 0.3 * min(path.overlap_ratio, 1.0) * np.maximum(1.0 - from_end / ramp, 0.0)
