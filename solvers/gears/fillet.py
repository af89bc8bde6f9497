"""Root fillet of a gear as the exact envelope of the rounded rack tip, in the transverse plane.

The arc of the rack tip is followed by `t`: 0 on the tip line, pi/2 - alpha_n where it joins the straight flank. Half
space angles count from the centre of the tooth space.
"""

from math import cos, pi, sin, tan
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from solvers.compiled import kernel
from solvers.gears.gear import Gear, rack_tip_radius
from solvers.gears.inputs import GearPairInputs, GearTeeth

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(20)


class RackFillet(NamedTuple):
    """The rack tip that cuts a root; lengths [m].

    `centre_x`, `centre_y`: centre of the tip arc in the normal plane, from the centre line of the rack tooth and from
    the reference circle; `end`: arc parameter where the fillet hands over to the involute.
    """

    reference_radius: float
    centre_x: float
    centre_y: float
    tip_radius: float
    cos_helix: float
    end: float


class RootProfile(NamedTuple):
    """A root from the middle of its bottom land to the start of the involute.

    `root_half_angle` [rad]: half the bottom land; `involute_roll` [m]: roll length at which the involute starts;
    `sector_area` [m^2]: area between the gear's centre and half the root, up to there.
    """

    fillet: RackFillet
    root_radius: float
    root_half_angle: float
    involute_roll: float
    sector_area: float


@kernel
def fillet_point(fillet: RackFillet, t: float) -> tuple[float, float]:
    """Radius [m] and half space angle [rad] of the fillet at arc parameter t [rad]."""
    y = fillet.centre_y - fillet.tip_radius * np.cos(t)
    x = (fillet.centre_x + fillet.tip_radius * np.sin(t)) / fillet.cos_helix
    across = -y * np.tan(t) * fillet.cos_helix  # X + d: the contact normal passes through the pitch point
    shift = across - x
    up = y + fillet.reference_radius
    return np.hypot(across, up), np.arctan2(across, up) - shift / fillet.reference_radius


@kernel
def fillet_sector_area(fillet: RackFillet, end: float) -> float:
    """Area between the gear's centre and the fillet from t = 0 to `end`, 1/2 integral r^2 dpsi [m^2]."""
    r, tip, cos_helix = fillet.reference_radius, fillet.tip_radius, fillet.cos_helix
    area = 0.0
    for node, weight in zip(_NODES, _WEIGHTS):  # noqa: B905  numba's zip knows no strict
        t = 0.5 * end * (1.0 + node)
        y, dy = fillet.centre_y - tip * np.cos(t), tip * np.sin(t)
        across, up = -y * np.tan(t) * cos_helix, y + r
        d_across = -(dy * np.tan(t) + y / np.cos(t) ** 2) * cos_helix
        d_shift = d_across - tip * np.cos(t) / cos_helix
        area += weight * (up * d_across - across * dy - (across**2 + up**2) * d_shift / r)
    return 0.25 * end * area


def root_profile(pair: GearPairInputs, teeth: GearTeeth, gear: Gear) -> RootProfile:
    """Root of one gear of the pair; where it is undercut, the union of what rack tip and rack flank sweep."""
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
    step = _half_space_angle(gear, radius) - half_angle  # nought but where an undercut ends on the base circle
    area = root_half_angle * gear.root_radius**2 / 2 + fillet_sector_area(fillet, fillet.end) + step * radius**2 / 2
    return RootProfile(fillet, gear.root_radius, root_half_angle, roll, area)


def _half_space_angle(gear: Gear, radius: float) -> float:
    return pi / gear.teeth - gear.half_tooth_angle(radius)


def _undercut_start(fillet: RackFillet, gear: Gear) -> tuple[float, float]:
    """Arc parameter and roll length [m] where an undercutting fillet crosses the involute."""

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
