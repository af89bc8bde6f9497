"""Mild wear of both flanks by Archard's law, from the load over the flank and the sliding speed."""

from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.scuffing.contact_slices import reaches_base_circle
from solvers.scuffing.inputs import MicropittingCheck
from solvers.scuffing.micropitting.results import Wear
from solvers.scuffing.results import LoadDistribution


class WearDepths(NamedTuple):
    """Maps [profile, face] of the depth of wear of each gear per revolution of this gear [m].

    The depth is NaN at loaded points near a base circle.
    """

    pinion: FloatArray
    wheel: FloatArray


def wear_depths(coefficient: float, distribution: LoadDistribution) -> WearDepths:
    """Compute the depth of wear of both flanks.

    Eq. M15 of the chapter on micropitting: the depth of wear per passage through the mesh is k w |v_g| / v_i. Here w is
    the line load, v_g is the sliding speed, and v_i is the surface speed of the gear. At a base circle the surface
    speed of one gear is 0, and the depth of wear would be infinite. Near a base circle the result is therefore NaN
    under load, and 0 without load.
    """
    path, flank = distribution.path_of_contact, distribution.flank
    speeds = np.stack(path.surface_speeds(flank.profile_fraction * path.length, 1.0))
    sliding = np.abs(speeds[0] - speeds[1])
    with np.errstate(divide="ignore", invalid="ignore"):
        pinion, wheel = sliding / speeds
        loaded = [coefficient * flank.line_load * ratio[:, None] for ratio in (pinion, wheel)]
    undefined, apart = np.isnan(flank.pressure), flank.line_load == 0.0
    return WearDepths(*(np.where(apart, 0.0, np.where(undefined, np.nan, depth)) for depth in loaded))


def solve_wear(coefficient: float, distribution: LoadDistribution) -> Wear:
    """Compute the wear of both flanks."""
    depths = wear_depths(coefficient, distribution)
    pinion, wheel = (_largest(depth, distribution) for depth in depths)
    return Wear(
        pinion_max=pinion.value,
        pinion_at_psi=pinion.psi,
        pinion_at_face=pinion.face,
        wheel_max=wheel.value,
        wheel_at_psi=wheel.psi,
        wheel_at_face=wheel.face,
        psi=distribution.flank.profile_fraction,
        pinion=frozen(depths.pinion.max(axis=1)),  # NaN in a row with a loaded point near a base circle
        wheel=frozen(depths.wheel.max(axis=1)),
        pinion_map=frozen(depths.pinion),
        wheel_map=frozen(depths.wheel),
    )


class _Largest(NamedTuple):
    """Largest depth of wear [m] on a flank, and the place of this depth.

    `psi` is the fraction of the path from A, and `face` is the distance from the end that meshes first [m]. If the
    loaded path reaches a base circle, the depth would be infinite at the base circle, and all three fields are None.
    """

    value: float | None
    psi: float | None
    face: float | None


def _largest(depth: FloatArray, distribution: LoadDistribution) -> _Largest:
    if reaches_base_circle(distribution.balance.survey):
        return _Largest(None, None, None)
    flank, width = distribution.flank, distribution.path_of_contact.plane.face_width
    i, k = np.unravel_index(np.nanargmax(depth), depth.shape)
    return _Largest(float(depth[i, k]), float(flank.profile_fraction[i]), float(flank.face_fraction[k] * width))


def wear_asked_for(check: MicropittingCheck | None, distribution: LoadDistribution) -> Wear | None:
    """Return the wear of both flanks; None if no wear coefficient is given."""
    if check is None or check.wear_coefficient is None:
        return None
    return solve_wear(check.wear_coefficient, distribution)
