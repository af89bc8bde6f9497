"""One gear in the transverse plane, cut by a rack: radii, thicknesses, involute and root fillet.

The tip of the rack is rounded with an arc. The arc parameter `t` [rad] is 0 where the arc meets the tip line, and
pi/2 - alpha_n where the arc meets the straight flank. The half angle of a tooth space is the angle from the centre line
of the tooth space to a point on the flank or the root of the tooth.
"""

from dataclasses import dataclass
from math import acos, atan, cos, hypot, pi, sin, sqrt, tan
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from solvers.compiled import kernel
from solvers.gears.inputs import GearPairInputs, GearTeeth

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(20)  # the number of points of the Gauss rule is chosen


def involute(angle: float) -> float:
    """Return the involute function inv(angle) = tan(angle) - angle."""
    return tan(angle) - angle


@dataclass(frozen=True, slots=True)
class Gear:
    """One gear in the transverse plane; lengths [m], angles [rad].

    `form_roll_length` is the roll length at which the involute meets the fillet that the rack cuts. This roll length is
    negative if the gear is undercut.
    """

    teeth: int
    reference_radius: float
    base_radius: float
    tip_radius: float
    root_radius: float
    reference_half_angle: float
    reference_involute: float
    form_roll_length: float

    @property
    def undercut(self) -> bool:
        """True if the rack cuts into the involute."""
        return self.form_roll_length < 0.0

    @property
    def usable_roll_length(self) -> float:
        """Roll length at which the usable involute starts [m].

        If the gear is undercut, the usable involute starts at the base circle, where the roll length is 0.
        """
        return max(self.form_roll_length, 0.0)

    @property
    def form_radius(self) -> float:
        """Radius at which the usable involute starts [m]. If the gear is undercut, this radius is the base radius."""
        return hypot(self.base_radius, self.usable_roll_length)

    @property
    def tip_roll_length(self) -> float:
        """Roll length at the tip [m]."""
        return sqrt(self.tip_radius**2 - self.base_radius**2)

    @property
    def tip_thickness(self) -> float:
        """Thickness of a tooth on the tip circle [m].

        If the flanks meet below the tip circle, the thickness is negative.
        """
        return 2 * self.tip_radius * self.half_tooth_angle(self.tip_radius)

    def half_tooth_angle(self, radius: float) -> float:
        """Return half the angular thickness of a tooth [rad] at a radius [m].

        The radius must not be smaller than the base radius.
        """
        pressure_angle = acos(min(self.base_radius / radius, 1.0))
        return self.reference_half_angle + self.reference_involute - involute(pressure_angle)


def full_rack_tip_radius(dedendum: float, normal_pressure_angle: float) -> float:
    """Return the largest possible tip radius of the rack, in normal modules.

    The result is negative if the flanks of the rack meet below the tip line.
    """
    room = pi / 4 - dedendum * tan(normal_pressure_angle)
    return room * cos(normal_pressure_angle) / (1.0 - sin(normal_pressure_angle))


def rack_tip_radius(inputs: GearPairInputs, teeth: GearTeeth) -> float:
    """Return the tip radius of the rack that cuts the gear, in normal modules.

    This is the given tip radius, limited to the largest possible tip radius.
    """
    return min(inputs.rack_tip_radius, full_rack_tip_radius(teeth.dedendum, inputs.normal_pressure_angle))


def transverse_gear(inputs: GearPairInputs, teeth: GearTeeth) -> Gear:
    """Return one gear of the pair in the transverse plane."""
    pressure_angle = atan(tan(inputs.normal_pressure_angle) / cos(inputs.helix_angle))
    return _cut(inputs, teeth, teeth.teeth, inputs.normal_module / cos(inputs.helix_angle), pressure_angle)


def virtual_gear(inputs: GearPairInputs, teeth: GearTeeth, base_helix_angle: float) -> Gear:
    """Return the virtual spur gear that represents the real gear in the normal section (Eq. L10).

    The rack that cuts the virtual gear is the normal section of the rack that cuts the real gear.
    """
    virtual_teeth = teeth.teeth / (cos(base_helix_angle) ** 2 * cos(inputs.helix_angle))
    return _cut(inputs, teeth, virtual_teeth, inputs.normal_module, inputs.normal_pressure_angle)


def _cut(inputs: GearPairInputs, teeth: GearTeeth, count: float, module: float, pressure_angle: float) -> Gear:
    """Return a gear with `count` teeth in a plane with the given module [m] and pressure angle [rad].

    Addendum, dedendum and profile shift are multiples of the normal module, even if `module` is the transverse module.
    A profile shift increases the tooth thickness in proportion to the tangent of `pressure_angle`.
    """
    height, normal_angle = inputs.normal_module, inputs.normal_pressure_angle
    radius = module * count / 2
    thickness = module * pi / 2 + 2 * teeth.profile_shift * height * tan(pressure_angle)
    rounding = rack_tip_radius(inputs, teeth) * (1.0 - sin(normal_angle))
    straight_depth = height * (teeth.dedendum - teeth.profile_shift - rounding)
    return Gear(
        teeth=teeth.teeth,
        reference_radius=radius,
        base_radius=radius * cos(pressure_angle),
        tip_radius=radius + (teeth.profile_shift + inputs.addendum_of(teeth)) * height,
        root_radius=radius + (teeth.profile_shift - teeth.dedendum) * height,
        reference_half_angle=thickness / (2 * radius),
        reference_involute=involute(pressure_angle),
        form_roll_length=radius * sin(pressure_angle) - straight_depth / sin(pressure_angle),
    )


class RackFillet(NamedTuple):
    """The rounded rack tip that cuts the root fillet of a tooth; lengths [m].

    `centre_x` and `centre_y` are the coordinates of the centre of the tip arc in the normal plane. `centre_x` is
    measured from the centre line of the rack tooth; `centre_y` is measured from the reference circle. `end` is the arc
    parameter at which the fillet meets the involute.
    """

    reference_radius: float
    centre_x: float
    centre_y: float
    tip_radius: float
    cos_helix: float
    end: float


class RootProfile(NamedTuple):
    """One half of the profile of a tooth root, from the middle of the bottom land to the start of the involute.

    `root_half_angle` [rad] is half the angle of the bottom land. `involute_roll` [m] is the roll length at which the
    involute starts. `sector_area` [m^2] is the area between the centre of the gear and this half of the root profile.
    """

    fillet: RackFillet
    root_radius: float
    root_half_angle: float
    involute_roll: float
    sector_area: float


@kernel
def fillet_point(fillet: RackFillet, t: float) -> tuple[float, float]:
    """Return the radius [m] of a fillet point and its angle [rad] from the centre line of the tooth space.

    The arc parameter t [rad] selects the point.
    """
    y = fillet.centre_y - fillet.tip_radius * np.cos(t)
    x = (fillet.centre_x + fillet.tip_radius * np.sin(t)) / fillet.cos_helix
    across = -y * np.tan(t) * fillet.cos_helix  # equal to x + shift: the normal passes through the pitch point
    shift = across - x
    up = y + fillet.reference_radius
    return np.hypot(across, up), np.arctan2(across, up) - shift / fillet.reference_radius


@kernel
def fillet_sector_area(fillet: RackFillet, end: float) -> float:
    """Return the area [m^2] between the centre of the gear and the part of the fillet from t = 0 to t = `end`.

    The area is 1/2 integral r^2 dpsi, where psi is the angle from the centre line of the tooth space.
    """
    r, tip, cos_helix = fillet.reference_radius, fillet.tip_radius, fillet.cos_helix
    area = 0.0
    for node, weight in zip(_NODES, _WEIGHTS):  # noqa: B905  numba's zip has no argument `strict`
        t = 0.5 * end * (1.0 + node)
        y, dy = fillet.centre_y - tip * np.cos(t), tip * np.sin(t)
        across, up = -y * np.tan(t) * cos_helix, y + r
        d_across = -(dy * np.tan(t) + y / np.cos(t) ** 2) * cos_helix
        d_shift = d_across - tip * np.cos(t) / cos_helix
        area += weight * (up * d_across - across * dy - (across**2 + up**2) * d_shift / r)
    return 0.25 * end * area


def root_profile(pair: GearPairInputs, teeth: GearTeeth, gear: Gear) -> RootProfile:
    """Return the root profile of one gear of the pair.

    If the gear is undercut, the tip of the rack and the flank of the rack sweep different areas. The tooth space is the
    union of both areas.
    """
    module, angle = pair.normal_module, pair.normal_pressure_angle
    tip = rack_tip_radius(pair, teeth) * module
    centre_y = (teeth.profile_shift - teeth.dedendum) * module + tip
    straight_y = centre_y - tip * sin(angle) - teeth.profile_shift * module
    centre_x = pi * module / 4 + straight_y * tan(angle) - tip * cos(angle)
    fillet = RackFillet(gear.reference_radius, centre_x, centre_y, tip, cos(pair.helix_angle), pi / 2 - angle)
    roll = gear.usable_roll_length
    if gear.undercut:
        end, roll = _undercut_start(fillet, gear)
        fillet = fillet._replace(end=end)
    radius, half_angle = fillet_point(fillet, fillet.end)
    root_half_angle = fillet_point(fillet, 0.0)[1]
    step = _half_space_angle(gear, radius) - half_angle  # 0, unless an undercut ends on the base circle
    area = root_half_angle * gear.root_radius**2 / 2 + fillet_sector_area(fillet, fillet.end) + step * radius**2 / 2
    return RootProfile(fillet, gear.root_radius, root_half_angle, roll, area)


def _half_space_angle(gear: Gear, radius: float) -> float:
    return pi / gear.teeth - gear.half_tooth_angle(radius)


def _undercut_start(fillet: RackFillet, gear: Gear) -> tuple[float, float]:
    """Return the arc parameter [rad] and the roll length [m] of the point at which the fillet crosses the involute.

    If the fillet does not cross the involute, return the values of the point at which the fillet crosses the base
    circle.
    """

    def excess(t: float) -> float:
        radius, half_angle = fillet_point(fillet, t)
        return half_angle - _half_space_angle(gear, max(radius, gear.base_radius))

    def below_base(t: float) -> float:
        return fillet_point(fillet, t)[0] - gear.base_radius

    base = brentq(below_base, 0.0, fillet.end, xtol=1e-15) if below_base(0.0) < 0.0 else 0.0
    if excess(base) <= 0.0:
        return base, 0.0
    crossing = brentq(excess, base, fillet.end, xtol=1e-15)
    radius = fillet_point(fillet, crossing)[0]
    return crossing, float(np.sqrt(max(radius**2 - gear.base_radius**2, 0.0)))
