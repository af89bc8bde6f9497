"""Profiles of a tooth space and of the mate's tooth, and the point of a profile that is nearest to a given point.

A normal of an involute is a tangent of its base circle, so the nearest point of a flank follows without a search. The
areas under involutes and circular arcs have closed forms. Only the nearest point of a root fillet needs a search.

Points are given by their distance from the axis of a gear [m] and their angle [rad] from the centre line of the space
or tooth. Profiles are symmetric, so one half is enough. A roll length [m] is the length of the tangent from a point of
an involute to its base circle.
"""

import numpy as np

from solvers.compiled import inner_kernel
from solvers.gears.gear import RackFillet, fillet_point, fillet_sector_area
from solvers.pumping.space.tooth_space import ToothSpace

_SCAN = 17  # number of points of the fillet by which the search brackets the nearest point
_GOLDEN = 0.6180339887498949  # (sqrt(5) - 1) / 2, the golden section


@inner_kernel
def involute(roll: float, base: float) -> float:
    """Compute the polar angle [rad] between the start of an involute and the point at the roll length `roll` [m]."""
    angle: float = roll / base - np.arctan(roll / base)
    return angle


@inner_kernel
def sector(roll: float, base: float) -> float:
    """Area 1/2 int r^2 dpsi [m^2] between an involute up to the roll length `roll` [m] and the centre."""
    return roll**3 / (6.0 * base)


@inner_kernel
def sector_to_involute(space: ToothSpace, roll: float) -> float:
    """Area [m^2] between the axis and the profile from the centre line of the space to the roll length `roll` [m]."""
    base = space.base_radius
    return space.root.sector_area + sector(roll, base) - sector(space.root.involute_roll, base)


@inner_kernel
def _distance_to_fillet(fillet: RackFillet, t: float, radius: float, angle: float) -> float:
    r, psi = fillet_point(fillet, t)
    distance: float = np.sqrt((r - radius) ** 2 + 4.0 * r * radius * np.sin(0.5 * (psi - angle)) ** 2)
    return distance


@inner_kernel
def _nearest_on_fillet(fillet: RackFillet, radius: float, angle: float) -> tuple[float, float]:
    """Arc parameter [rad] of the fillet's point nearest to (radius, angle), and its distance [m]."""
    step = fillet.end / (_SCAN - 1)
    best, nearest = 0, np.inf
    for k in range(_SCAN):
        distance = _distance_to_fillet(fillet, k * step, radius, angle)
        if distance < nearest:
            best, nearest = k, distance
    low, high = max(best - 1, 0) * step, min(best + 1, _SCAN - 1) * step
    for _ in range(36):
        inner, outer = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
        if _distance_to_fillet(fillet, inner, radius, angle) < _distance_to_fillet(fillet, outer, radius, angle):
            high = outer
        else:
            low = inner
    t = 0.5 * (low + high)
    return t, _distance_to_fillet(fillet, t, radius, angle)


@inner_kernel
def _foot_on_flank(space: ToothSpace, radius: float, angle: float) -> tuple[float, float]:
    """Roll length [m] of the flank's point nearest to (radius, angle), and its distance [m]."""
    base, start = space.base_radius, space.root.involute_roll
    if radius > base:
        roll = np.sqrt(radius**2 - base**2)
        foot = base * (angle + np.arctan(roll / base) - space.base_half_angle)
        if start <= foot <= space.tip_roll:
            return foot, abs(roll - foot)
    else:
        foot = start
    foot = min(max(foot, start), space.tip_roll)
    psi = space.base_half_angle + involute(foot, base)
    r = np.hypot(base, foot)
    return foot, np.sqrt((r - radius) ** 2 + 4.0 * r * radius * np.sin(0.5 * (psi - angle)) ** 2)


@inner_kernel
def nearest_on_profile(space: ToothSpace, radius: float, angle: float) -> tuple[float, float, float, float]:
    """Nearest point of one half of the profile to (radius, angle).

    Returns its distance [m], radius [m], angle [rad] and the area [m^2] up to it from the centre line.
    """
    root, base = space.root, space.base_radius
    roll, distance = _foot_on_flank(space, radius, angle)
    r, psi = np.hypot(base, roll), space.base_half_angle + involute(roll, base)
    area = sector_to_involute(space, roll)
    bottom = min(max(angle, 0.0), root.root_half_angle)
    gap = np.hypot(root.root_radius * np.sin(bottom - angle), radius - root.root_radius * np.cos(bottom - angle))
    if gap < distance:
        distance, r, psi, area = gap, root.root_radius, bottom, 0.5 * bottom * root.root_radius**2
    if roll <= root.involute_roll or radius < np.hypot(base, root.involute_roll):
        t, gap = _nearest_on_fillet(root.fillet, radius, angle)
        if gap < distance:
            r, psi = fillet_point(root.fillet, t)
            # If the fillet protrudes beyond the involute, the mate's point may lie inside; the distance is then 0.
            distance = gap if radius - r > r * (angle - psi) else 0.0
            area = 0.5 * root.root_half_angle * root.root_radius**2 + fillet_sector_area(root.fillet, t)
    return distance, r, psi, area


@inner_kernel
def foot_on_mate(space: ToothSpace, radius: float, angle: float) -> tuple[float, float]:
    """Roll length [m] of the mating flank's point nearest to (radius, angle), and its distance [m]."""
    base = space.mate_base_radius
    foot = 0.0
    if radius > base:
        roll = np.sqrt(radius**2 - base**2)
        foot = base * (space.mate_base_half_angle - angle + np.arctan(roll / base))
        if 0.0 <= foot <= space.mate_tip_roll:
            return foot, abs(roll - foot)
    foot = min(max(foot, 0.0), space.mate_tip_roll)
    half_angle = space.mate_base_half_angle - involute(foot, base)
    r = np.hypot(base, foot)
    return foot, np.sqrt((r - radius) ** 2 + 4.0 * r * radius * np.sin(0.5 * (half_angle - angle)) ** 2)


@inner_kernel
def from_mate(
    space: ToothSpace, angle: float, mate_angle: float, mate_roll: float
) -> tuple[float, float, float, float]:
    """`nearest_on_profile` of the mating flank's point at the roll length `mate_roll` [m]."""
    radius = np.hypot(space.mate_base_radius, mate_roll)
    mu = mate_angle - space.mate_base_half_angle + involute(mate_roll, space.mate_base_radius)
    x, y = radius * np.sin(mu), space.centre_distance - radius * np.cos(mu)
    return nearest_on_profile(space, np.hypot(x, y), angle - np.arctan2(x, y))


@inner_kernel
def from_own(space: ToothSpace, angle: float, mate_angle: float, roll: float) -> tuple[float, float]:
    """`foot_on_mate` of the space's flank point at the roll length `roll` [m]."""
    radius = np.hypot(space.base_radius, roll)
    theta = angle - space.base_half_angle - involute(roll, space.base_radius)
    x, y = radius * np.sin(theta), space.centre_distance - radius * np.cos(theta)
    return foot_on_mate(space, np.hypot(x, y), mate_angle - np.arctan2(x, y))
