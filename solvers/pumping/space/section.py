"""Area of a tooth space between the flanks and its radial clearances at one position, all in closed form.

The right side of a space at (angle, mate's angle) is the mirror image of the left side at (-angle, -mate's angle).
"""

from typing import NamedTuple

import numpy as np

from solvers.compiled import kernel
from solvers.pumping.space.profile import from_mate, from_own, involute, sector, sector_to_involute
from solvers.pumping.space.tooth_space import ToothSpace


class Section(NamedTuple):
    """Area [m^2], clearance of both sides [m], area of gas that the flanks have carried out so far [m^2]."""

    area: float
    left: float
    right: float
    carried: float


@kernel
def _area_part(space: ToothSpace, own_x: float, own_y: float, mate_x: float, mate_y: float, mate_roll: float) -> float:
    """What a side adds between the owner's centre and the upper boundary [m^2]: section, mate's flank, mate's tip."""
    base = space.mate_base_radius
    under_flank = sector(space.mate_tip_roll, base) - sector(mate_roll, base)
    section = 0.5 * (own_y * mate_x - own_x * mate_y) - 0.5 * space.centre_distance * mate_x
    return section - under_flank - 0.5 * space.mate_tip_radius**2 * space.mate_tip_half_angle


@kernel
def _close(
    space: ToothSpace, angle: float, mate_angle: float, own_radius: float, own_half_angle: float, mate_roll: float
) -> float:
    """Upper area part of a side whose section joins two feet given by radius, half angle and roll length [m^2]."""
    mate_radius = np.hypot(space.mate_base_radius, mate_roll)
    mu = mate_angle - space.mate_base_half_angle + involute(mate_roll, space.mate_base_radius)
    theta = angle - own_half_angle
    own_x, own_y = own_radius * np.sin(theta), own_radius * np.cos(theta)
    mate_x, mate_y = mate_radius * np.sin(mu), space.centre_distance - mate_radius * np.cos(mu)
    return _area_part(space, own_x, own_y, mate_x, mate_y, mate_roll)


@kernel
def _corner_section(space: ToothSpace, angle: float, mate_angle: float) -> tuple[float, float, float, float, float]:
    """Section from the nearer tip corner to the other gear, from the mate's alone with tip gaps.

    Clearance [m], the foot's radius [m], half angle [rad] and sector below it [m^2], roll length on the mate [m].
    """
    clearance, r, psi, below = from_mate(space, angle, mate_angle, space.mate_tip_roll)
    foot = space.mate_tip_roll
    if space.contact_gap:
        mate_foot, distance = from_own(space, angle, mate_angle, space.tip_roll)
        if distance < clearance:
            clearance, foot, r, psi = distance, mate_foot, space.tip_radius, space.tip_half_angle
            below = sector_to_involute(space, space.tip_roll)
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
        clearance, r, psi, below = from_mate(space, angle, mate_angle, mate_roll)
        _, at_end = from_own(space, angle, mate_angle, start)
        return min(clearance, at_end), r, psi, below, mate_roll
    r, psi = np.hypot(space.base_radius, roll), space.base_half_angle + involute(roll, space.base_radius)
    foot, clearance = mate_roll, gap
    if mate_roll < 0.0:
        foot, clearance = from_own(space, angle, mate_angle, roll)
        at_end, _, _, _ = from_mate(space, angle, mate_angle, 0.0)
        clearance = min(clearance, at_end)
    return clearance, r, psi, sector_to_involute(space, roll), foot


@kernel
def _carried(space: ToothSpace, roll: float, gap: float) -> float:
    """Area that rolling flanks have carried through a section of `gap` [m], towards growing roll lengths [m^2].

    The integral of gap times half the sum of both flanks' rolling velocities, from where both are 0.
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
    """The section at an `angle` [rad] of the owner; only differences of what is carried have a meaning (Eqs. 5, P3).

    The flanks of the coast side roll through the section fixed on the line of action: out of the space where the
    owner drives, else into it.
    """
    mate_angle = angle * space.ratio + space.offset
    left_gap = 0.0 if space.owner_drives else space.backlash_gap
    left_area, left, left_carried = _side(space, angle, mate_angle, left_gap)
    right_area, right, right_carried = _side(space, -angle, -mate_angle, space.backlash_gap - left_gap)
    return Section(left_area + right_area, left, right, -left_carried - right_carried)
