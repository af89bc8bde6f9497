"""Area of a tooth space between the flanks and its radial clearances at one position, all in closed form.

Normals of an involute are tangents of its base circle, so the foot of a point on a flank needs no search; the areas
under involutes and circular arcs are elementary. Only a foot on the root fillet is searched for. The right side of a
space at (angle, mate's angle) is the mirror image of the left side at (-angle, -mate's angle).
"""

from typing import NamedTuple

import numpy as np

from solvers.compiled import kernel
from solvers.gears.fillet import RackFillet, fillet_point, fillet_sector_area
from solvers.pumping.space.tooth_space import ToothSpace

_SCAN = 17  # fillet points that bracket the nearest one
_GOLDEN = 0.6180339887498949


class Section(NamedTuple):
    """Area [m^2], clearance of both sides [m], area of gas that the flanks have carried out so far [m^2]."""

    area: float
    left: float
    right: float
    carried: float


@kernel
def _involute(roll: float, base: float) -> float:
    angle: float = roll / base - np.arctan(roll / base)
    return angle


@kernel
def _sector(roll: float, base: float) -> float:
    """1/2 integral r^2 dpsi along an involute from its base circle [m^2]."""
    return roll**3 / (6.0 * base)


@kernel
def _sector_to_involute(space: ToothSpace, roll: float) -> float:
    """Area between the owner's centre and half a space's profile up to a roll length of its involute [m^2]."""
    base = space.base_radius
    return space.root.sector_area + _sector(roll, base) - _sector(space.root.involute_roll, base)


@kernel
def _distance_to_fillet(fillet: RackFillet, t: float, radius: float, angle: float) -> float:
    r, psi = fillet_point(fillet, t)
    distance: float = np.sqrt((r - radius) ** 2 + 4.0 * r * radius * np.sin(0.5 * (psi - angle)) ** 2)
    return distance


@kernel
def _nearest_on_fillet(fillet: RackFillet, radius: float, angle: float) -> tuple[float, float]:
    """Arc parameter and distance [m] of the fillet's point nearest to (radius, angle from the space's centre)."""
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


@kernel
def _foot_on_flank(space: ToothSpace, radius: float, angle: float) -> tuple[float, float]:
    """Roll length of the flank's point nearest to (radius, angle from the space's centre), and its distance [m]."""
    base, start = space.base_radius, space.root.involute_roll
    if radius > base:
        roll = np.sqrt(radius**2 - base**2)
        foot = base * (angle + np.arctan(roll / base) - space.base_half_angle)
        if start <= foot <= space.tip_roll:
            return foot, abs(roll - foot)
    else:
        foot = start
    foot = min(max(foot, start), space.tip_roll)
    psi = space.base_half_angle + _involute(foot, base)
    r = np.hypot(base, foot)
    return foot, np.sqrt((r - radius) ** 2 + 4.0 * r * radius * np.sin(0.5 * (psi - angle)) ** 2)


@kernel
def _nearest_on_profile(space: ToothSpace, radius: float, angle: float) -> tuple[float, float, float, float]:
    """Nearest point of half a space's profile: distance [m], radius [m], half angle [rad], sector below [m^2]."""
    root, base = space.root, space.base_radius
    roll, distance = _foot_on_flank(space, radius, angle)
    r, psi = np.hypot(base, roll), space.base_half_angle + _involute(roll, base)
    area = _sector_to_involute(space, roll)
    bottom = min(max(angle, 0.0), root.root_half_angle)
    gap = np.hypot(root.root_radius * np.sin(bottom - angle), radius - root.root_radius * np.cos(bottom - angle))
    if gap < distance:
        distance, r, psi, area = gap, root.root_radius, bottom, 0.5 * bottom * root.root_radius**2
    if roll <= root.involute_roll or radius < np.hypot(base, root.involute_roll):
        t, gap = _nearest_on_fillet(root.fillet, radius, angle)
        if gap < distance:
            r, psi = fillet_point(root.fillet, t)
            distance = gap if radius - r > r * (angle - psi) else 0.0  # a fillet proud of the involute meets the mate
            area = 0.5 * root.root_half_angle * root.root_radius**2 + fillet_sector_area(root.fillet, t)
    return distance, r, psi, area


@kernel
def _foot_on_mate(space: ToothSpace, radius: float, angle: float) -> tuple[float, float]:
    """Roll length of the mate's flank nearest to (radius, angle from its tooth's centre), and its distance [m]."""
    base = space.mate_base_radius
    foot = 0.0
    if radius > base:
        roll = np.sqrt(radius**2 - base**2)
        foot = base * (space.mate_base_half_angle - angle + np.arctan(roll / base))
        if 0.0 <= foot <= space.mate_tip_roll:
            return foot, abs(roll - foot)
    foot = min(max(foot, 0.0), space.mate_tip_roll)
    half_angle = space.mate_base_half_angle - _involute(foot, base)
    r = np.hypot(base, foot)
    return foot, np.sqrt((r - radius) ** 2 + 4.0 * r * radius * np.sin(0.5 * (half_angle - angle)) ** 2)


@kernel
def _area_part(space: ToothSpace, own_x: float, own_y: float, mate_x: float, mate_y: float, mate_roll: float) -> float:
    """What a side adds between the owner's centre and the upper boundary [m^2]: section, mate's flank, mate's tip."""
    base = space.mate_base_radius
    under_flank = _sector(space.mate_tip_roll, base) - _sector(mate_roll, base)
    section = 0.5 * (own_y * mate_x - own_x * mate_y) - 0.5 * space.centre_distance * mate_x
    return section - under_flank - 0.5 * space.mate_tip_radius**2 * space.mate_tip_half_angle


@kernel
def _close(
    space: ToothSpace, angle: float, mate_angle: float, own_radius: float, own_half_angle: float, mate_roll: float
) -> float:
    """Upper area part of a side whose section joins two feet given by radius, half angle and roll length [m^2]."""
    mate_radius = np.hypot(space.mate_base_radius, mate_roll)
    mu = mate_angle - space.mate_base_half_angle + _involute(mate_roll, space.mate_base_radius)
    theta = angle - own_half_angle
    own_x, own_y = own_radius * np.sin(theta), own_radius * np.cos(theta)
    mate_x, mate_y = mate_radius * np.sin(mu), space.centre_distance - mate_radius * np.cos(mu)
    return _area_part(space, own_x, own_y, mate_x, mate_y, mate_roll)


@kernel
def _from_mate(
    space: ToothSpace, angle: float, mate_angle: float, mate_roll: float
) -> tuple[float, float, float, float]:
    """Nearest point of half a space's profile to a point of the mate's flank, as `_nearest_on_profile` tells it."""
    radius = np.hypot(space.mate_base_radius, mate_roll)
    mu = mate_angle - space.mate_base_half_angle + _involute(mate_roll, space.mate_base_radius)
    x, y = radius * np.sin(mu), space.centre_distance - radius * np.cos(mu)
    return _nearest_on_profile(space, np.hypot(x, y), angle - np.arctan2(x, y))


@kernel
def _from_own(space: ToothSpace, angle: float, mate_angle: float, roll: float) -> tuple[float, float]:
    """Foot on the mate's flank of a point of the own one, as `_foot_on_mate` tells it."""
    radius = np.hypot(space.base_radius, roll)
    theta = angle - space.base_half_angle - _involute(roll, space.base_radius)
    x, y = radius * np.sin(theta), space.centre_distance - radius * np.cos(theta)
    return _foot_on_mate(space, np.hypot(x, y), mate_angle - np.arctan2(x, y))


@kernel
def _corner_section(space: ToothSpace, angle: float, mate_angle: float) -> tuple[float, float, float, float, float]:
    """Section from the nearer tip corner to the other gear, from the mate's alone with tip gaps.

    Clearance [m], the foot's radius [m], half angle [rad] and sector below it [m^2], roll length on the mate [m].
    """
    clearance, r, psi, below = _from_mate(space, angle, mate_angle, space.mate_tip_roll)
    foot = space.mate_tip_roll
    if space.contact_gap:
        mate_foot, distance = _from_own(space, angle, mate_angle, space.tip_roll)
        if distance < clearance:
            clearance, foot, r, psi = distance, mate_foot, space.tip_radius, space.tip_half_angle
            below = _sector_to_involute(space, space.tip_roll)
    return clearance, r, psi, below, foot


@kernel
def _flank_section(
    space: ToothSpace, angle: float, mate_angle: float, roll: float, mate_roll: float, gap: float
) -> tuple[float, float, float, float, float]:
    """Section where the plane of action crosses a side, told as by `_corner_section`.

    Beyond the end of one gear's involute it joins the other gear's flank to the nearest point of the first; where that
    involute ends may be closer still.
    """
    start = space.root.involute_roll
    if roll < start:
        clearance, r, psi, below = _from_mate(space, angle, mate_angle, mate_roll)
        _, at_end = _from_own(space, angle, mate_angle, start)
        return min(clearance, at_end), r, psi, below, mate_roll
    r, psi = np.hypot(space.base_radius, roll), space.base_half_angle + _involute(roll, space.base_radius)
    foot, clearance = mate_roll, gap
    if mate_roll < 0.0:
        foot, clearance = _from_own(space, angle, mate_angle, roll)
        at_end, _, _, _ = _from_mate(space, angle, mate_angle, 0.0)
        clearance = min(clearance, at_end)
    return clearance, r, psi, _sector_to_involute(space, roll), foot


@kernel
def _carried(space: ToothSpace, roll: float, gap: float) -> float:
    """Area that rolling flanks have carried through a section of `gap` [m], towards growing roll lengths [m^2].

    The integral of gap times half the sum of both flanks' rolling velocities, from where both stand at nought.
    """
    facing = space.line_of_action - gap
    roll = min(max(roll, facing - space.mate_tip_roll), space.tip_roll)
    own, mate = max(roll, 0.0), max(facing - roll, 0.0)
    return 0.25 * gap / space.base_radius * (own**2 - space.ratio * mate**2)


@kernel
def _side(space: ToothSpace, angle: float, mate_angle: float, gap: float) -> tuple[float, float, float]:
    """One side: area part [m^2], clearance [m], area that the flanks have rolled through its section [m^2].

    Flanks that face each other close the space on the line of action, `gap` [m] apart there: with no gap down to the
    base circles, as an undercut counts in the path of contact. A wide gap is not always the side's narrowest place: a
    tip corner may come closer to the root fillet and throttles, but closes nothing.
    """
    roll = space.pitch_roll + space.base_radius * (angle - space.pitch_half_angle)
    mate_roll = space.line_of_action - roll - gap
    carried = _carried(space, roll, gap) if space.contact_gap else 0.0
    if not (space.contact_gap and roll <= space.tip_roll and mate_roll <= space.mate_tip_roll):
        clearance, r, psi, below, foot = _corner_section(space, angle, mate_angle)
        return _close(space, angle, mate_angle, r, psi, foot) - below, clearance, carried
    clearance, r, psi, below, foot = _flank_section(space, angle, mate_angle, roll, mate_roll, gap)
    if gap == 0.0 and roll >= 0.0 and mate_roll >= 0.0:
        clearance = 0.0
    else:
        at_corner, _, _, _, _ = _corner_section(space, angle, mate_angle)
        clearance = min(clearance, at_corner)
    return _close(space, angle, mate_angle, r, psi, foot) - below, clearance, carried


@kernel
def section(space: ToothSpace, angle: float) -> Section:
    """The section at an `angle` [rad] of the owner; only differences of what is carried have a meaning. The flanks of the coast side roll
    through the section fixed on the line of action: out of the space where the owner drives, else into it.
    """
    mate_angle = angle * space.ratio + space.offset
    left_gap = 0.0 if space.owner_drives else space.backlash_gap
    left_area, left, left_carried = _side(space, angle, mate_angle, left_gap)
    right_area, right, right_carried = _side(space, -angle, -mate_angle, space.backlash_gap - left_gap)
    return Section(left_area + right_area, left, right, -left_carried - right_carried)
