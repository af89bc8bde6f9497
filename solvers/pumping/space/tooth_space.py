"""A tooth space of one gear, and the tooth of the mate that passes through this space, in the transverse plane.

The owner is the gear to which the space belongs, and the mate is the mating gear. The owner turns about (0, 0), and the
mate turns about (0, a). Angles of the owner are measured from +y and angles of the mate from -y, both positive towards
+x, the direction of motion. At angle 0 the centre of the space is on the line of centres. The right side of the space
is ahead in the direction of motion. If the owner drives, its driving flank is on the left side of the space.
"""

from dataclasses import dataclass
from math import acos, cos, pi, sin
from typing import NamedTuple

from solvers.errors import InvalidInput
from solvers.gears.gear import RootProfile, root_profile
from solvers.gears.pair import GearPair, path_of_contact
from solvers.pumping.inputs import Gap


class ToothSpace(NamedTuple):
    """Shape and motion of a tooth space and of the mating gear's tooth; lengths [m], angles [rad].

    The owner is the gear to which the space belongs, and the mate is the mating gear.

    A flank is given by its base radius, its half angle at the base circle and its roll length at the tip. The flanks
    are in contact between the roll lengths `first_contact` and `last_contact` of the owner. `ratio` is the rotation of
    the mate divided by the rotation of the owner. `offset` is the angle of the mate at the moment at which the space is
    on the line of centres. `backlash_gap` is the distance between the coast flanks along the line of action.
    """

    root: RootProfile
    base_radius: float
    base_half_angle: float
    tip_roll: float
    tip_radius: float
    tip_half_angle: float
    pitch_roll: float
    pitch_half_angle: float
    mate_base_radius: float
    mate_base_half_angle: float
    mate_tip_roll: float
    mate_tip_radius: float
    mate_tip_half_angle: float
    centre_distance: float
    line_of_action: float
    first_contact: float
    last_contact: float
    ratio: float
    offset: float
    backlash_gap: float
    owner_drives: bool
    contact_gap: bool


@dataclass(frozen=True, slots=True)
class StrokeLimits:
    """Owner's angles [rad] between which the mating tooth is in the space, and in contact."""

    start: float
    contact_start: float
    contact_end: float
    end: float


def circumferential_backlash(pair: GearPair, normal_backlash: float) -> float:
    """Compute the circumferential backlash j_t on the working circles [m] (Eq. P1)."""
    radius_1, radius_2 = pair.pinion_working_radius, pair.wheel_working_radius
    thickness_1 = 2 * radius_1 * pair.pinion.half_tooth_angle(radius_1)
    thickness_2 = 2 * radius_2 * pair.wheel.half_tooth_angle(radius_2)
    return 2 * pi * radius_1 / pair.pinion.teeth - thickness_1 - thickness_2 + _thinning(pair, normal_backlash)


def normal_backlash(pair: GearPair, extra: float) -> float:
    """Compute the backlash along the normal of the flanks [m], including `extra` [m] due to a thinner tooth."""
    tangential = circumferential_backlash(pair, extra)
    return tangential * cos(pair.working_pressure_angle) * cos(pair.base_helix_angle)


def _thinning(pair: GearPair, normal_backlash: float) -> float:
    """Return the decrease in tooth thickness, on the working circle, that gives the backlash `normal_backlash` [m]."""
    return normal_backlash / (cos(pair.base_helix_angle) * cos(pair.working_pressure_angle))


def tooth_space(pair: GearPair, extra_backlash: float, gap: Gap, *, of_pinion: bool) -> ToothSpace:
    """Tooth space and mating tooth, thinned by `extra_backlash` [m]; raises `pointed_tooth` if that is pointed."""
    path, whole = path_of_contact(pair), pair.line_of_action
    first, last = (path.start, path.end) if of_pinion else (whole - path.end, whole - path.start)
    owner, mate = (pair.pinion, pair.wheel) if of_pinion else (pair.wheel, pair.pinion)
    teeth = pair.inputs.pinion if of_pinion else pair.inputs.wheel
    cos_working = cos(pair.working_pressure_angle)
    pitch_radius, mate_pitch_radius = owner.base_radius / cos_working, mate.base_radius / cos_working
    thinning = _thinning(pair, extra_backlash) / (2 * mate_pitch_radius)
    tangential = circumferential_backlash(pair, extra_backlash)
    mate_tip = mate.half_tooth_angle(mate.tip_radius) - thinning
    if mate_tip <= 0.0:
        raise InvalidInput(
            "pointed_tooth",
            "with this backlash the teeth of the mating gear are pointed; reduce the backlash",
            "normal_backlash",
        )
    return ToothSpace(
        root=root_profile(pair.inputs, teeth, owner),
        base_radius=owner.base_radius,
        base_half_angle=pi / owner.teeth - owner.reference_half_angle - owner.reference_involute,
        tip_roll=owner.tip_roll_length,
        tip_radius=owner.tip_radius,
        tip_half_angle=pi / owner.teeth - owner.half_tooth_angle(owner.tip_radius),
        pitch_roll=pitch_radius * sin(pair.working_pressure_angle),
        pitch_half_angle=pi / owner.teeth - owner.half_tooth_angle(pitch_radius),
        mate_base_radius=mate.base_radius,
        mate_base_half_angle=mate.reference_half_angle + mate.reference_involute - thinning,
        mate_tip_roll=mate.tip_roll_length,
        mate_tip_radius=mate.tip_radius,
        mate_tip_half_angle=mate_tip,
        centre_distance=pair.centre_distance,
        line_of_action=pair.line_of_action,
        first_contact=first,
        last_contact=last,
        ratio=owner.teeth / mate.teeth,
        offset=(-tangential if of_pinion else tangential) / (2 * mate_pitch_radius),
        backlash_gap=tangential * cos_working,
        owner_drives=of_pinion,
        contact_gap=gap is Gap.CONTACT,
    )


def stroke_limits(space: ToothSpace) -> StrokeLimits:
    """Compute the angles between which the mating gear's tooth is in a tooth space, and in contact (Eq. P2)."""
    a, tip, mate_tip = space.centre_distance, space.tip_radius, space.mate_tip_radius
    reach = acos((a**2 + mate_tip**2 - tip**2) / (2 * a * mate_tip)) + space.mate_tip_half_angle
    approach = (space.first_contact - space.pitch_roll) / space.base_radius
    recess = (space.last_contact - space.pitch_roll) / space.base_radius
    phi_a, phi_e = space.pitch_half_angle + approach, space.pitch_half_angle + recess
    return StrokeLimits(
        start=(-reach - space.offset) / space.ratio,
        contact_start=phi_a if space.owner_drives else -phi_e,
        contact_end=phi_e if space.owner_drives else -phi_a,
        end=(reach - space.offset) / space.ratio,
    )
