"""Free area and radial clearances of a tooth space at one angle, by closed forms.

The owner is the gear to which the space belongs. A space has a left and a right side. Each side is closed by its
narrowest section, which is the shortest line between the profile of the space and the mate's tooth. The length of this
line is the clearance. The line ends at two feet: a point of the space (radius [m], half angle [rad]) and a point of the
mate (roll length [m]). The right side at (angle, mate's angle) is the mirror image of the left side at
(-angle, -mate's angle).
"""

from typing import NamedTuple

import numpy as np

from solvers.compiled import inner_kernel
from solvers.pumping.space.profile import from_mate, from_own, involute, sector, sector_to_involute
from solvers.pumping.space.tooth_space import ToothSpace


class Section(NamedTuple):
    """Areas [m^2] and clearances [m] of a tooth space at one angle.

    `area` is the free area of the space. `left` and `right` are the clearances of the left side and of the right side.
    `carried` is the volume of gas per face width that the flanks have carried out of the space [m^2].
    """

    area: float
    left: float
    right: float
    carried: float


@inner_kernel
def _area_part(space: ToothSpace, own_x: float, own_y: float, mate_x: float, mate_y: float, mate_roll: float) -> float:
    """Area [m^2] of one side of a space from the owner's axis to the narrowest section, the mate's flank and tip."""
    base = space.mate_base_radius
    under_flank = sector(space.mate_tip_roll, base) - sector(mate_roll, base)
    section = 0.5 * (own_y * mate_x - own_x * mate_y) - 0.5 * space.centre_distance * mate_x
    return section - under_flank - 0.5 * space.mate_tip_radius**2 * space.mate_tip_half_angle


@inner_kernel
def _close(
    space: ToothSpace, angle: float, mate_angle: float, own_radius: float, own_half_angle: float, mate_roll: float
) -> float:
    """`_area_part` [m^2] if the narrowest section lies between a point of the profile and one of the mating flank."""
    mate_radius = np.hypot(space.mate_base_radius, mate_roll)
    mu = mate_angle - space.mate_base_half_angle + involute(mate_roll, space.mate_base_radius)
    theta = angle - own_half_angle
    own_x, own_y = own_radius * np.sin(theta), own_radius * np.cos(theta)
    mate_x, mate_y = mate_radius * np.sin(mu), space.centre_distance - mate_radius * np.cos(mu)
    return _area_part(space, own_x, own_y, mate_x, mate_y, mate_roll)


@inner_kernel
def _corner_section(space: ToothSpace, angle: float, mate_angle: float) -> tuple[float, float, float, float, float]:
    """Find the shortest line between a tip corner of one gear and the profile of the other gear.

    If `space.contact_gap` is True, the tip corners of both gears are tried, and the shorter line is returned. Otherwise
    only the tip corner of the mate is tried. The mate is the gear whose tooth enters the tooth space.

    Returns five numbers: the length of the line [m]; radius [m] and half angle [rad] of the end on the tooth space; the
    area between the profile up to this end and the axis of the gear with the space [m^2]; and the roll length of the
    end on the mate [m].
    """
    clearance, r, psi, below = from_mate(space, angle, mate_angle, space.mate_tip_roll)
    foot = space.mate_tip_roll
    if space.contact_gap:
        mate_foot, distance = from_own(space, angle, mate_angle, space.tip_roll)
        if distance < clearance:
            clearance, foot, r, psi = distance, mate_foot, space.tip_radius, space.tip_half_angle
            below = sector_to_involute(space, space.tip_roll)
    return clearance, r, psi, below, foot


@inner_kernel
def _flank_section(
    space: ToothSpace, angle: float, mate_angle: float, roll: float, mate_roll: float, gap: float
) -> tuple[float, float, float, float, float]:
    """Find the narrowest section between two flanks on the line of action. Return the same values as `_corner_section`.

    If the line of action meets the involute of a gear A but misses the involute of the other gear B, the section leads
    from the flank of A to the nearest point of B. The clearance is then the smaller of two lengths: the length of this
    section, and the distance from the inner end of the involute of B to A.
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


@inner_kernel
def _carried(space: ToothSpace, roll: float, gap: float) -> float:
    """Gas per face width [m^2] that rolling flanks have carried through a gap, positive towards growing roll lengths.

    It moves with the mean of both rolling velocities, counted from where each is 0.
    """
    facing = space.line_of_action - gap
    roll = min(max(roll, facing - space.mate_tip_roll), space.tip_roll)
    own, mate = max(roll, 0.0), max(facing - roll, 0.0)
    return 0.25 * gap / space.base_radius * (own**2 - space.ratio * mate**2)


@inner_kernel
def _side(space: ToothSpace, angle: float, mate_angle: float, gap: float) -> tuple[float, float, float]:
    """Area [m^2], clearance [m] and carried gas per face width [m^2] of one side of a tooth space.

    Facing flanks have their narrowest section on the line of action, at the distance `gap` [m]; involutes start at base
    circles even if undercut, as in the path of contact. A tip corner may be closer: it then sets the clearance, and the
    area is still bounded on the line of action.
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


@inner_kernel
def section(space: ToothSpace, angle: float) -> Section:
    """Section of a tooth space at an angle of its owner, 0 on the line of centres (Eqs. 5, P3).

    On the coast side the flanks carry gas through the gap on the line of action: out if the owner drives, else in.
    """
    mate_angle = angle * space.ratio + space.offset
    left_gap = 0.0 if space.owner_drives else space.backlash_gap
    left_area, left, left_carried = _side(space, angle, mate_angle, left_gap)
    right_area, right, right_carried = _side(space, -angle, -mate_angle, space.backlash_gap - left_gap)
    return Section(left_area + right_area, left, right, -left_carried - right_carried)
