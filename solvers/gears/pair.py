"""An involute gear pair in the transverse plane (ISO 21771), and the path of contact on the line of action.

The path of contact runs from A, where a pair of teeth comes into contact, to E, where the contact ends.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache
from math import acos, asin, atan, cos, pi, sin, tan
from typing import NamedTuple, TypeVar

from scipy.optimize import brentq

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.gears.checks import (
    centre_distance_in_use,
    check_helices,
    check_path,
    check_rack,
    check_teeth,
    check_tips,
    check_usable_flank,
    check_working_involute,
)
from solvers.gears.gear import Gear, involute, transverse_gear
from solvers.gears.inputs import GearPairInputs, GearTeeth

Real = TypeVar("Real", float, FloatArray)

# A helical gear with a smaller overlap ratio is treated as a spur gear. Its contact lines would enter the mesh over the
# whole face at once, up to rounding errors.
LEAST_OVERLAP = 1e-9
# If the ratio of reduced radius to normal module is smaller, pressure and flash temperature have no meaning. The
# formulas of Hertz and Blok give results that grow without limit as the radius falls to zero.
LEAST_RADIUS = 0.02
ROUNDING = 1e-9  # lengths below this share of the line of action count as 0


def inverse_involute(value: float) -> float:
    """Return the angle [rad] in [0, pi/2) whose involute function is `value` >= 0."""
    return brentq(lambda angle: involute(angle) - value, 0.0, pi / 2 - 1e-9, xtol=1e-16, rtol=1e-15)


@dataclass(frozen=True, slots=True)
class GearPair:
    """A meshing pair in the transverse plane; lengths [m], angles [rad]."""

    inputs: GearPairInputs
    pinion: Gear
    wheel: Gear
    transverse_module: float
    transverse_pressure_angle: float
    base_helix_angle: float
    transverse_base_pitch: float
    backlash_free_centre_distance: float
    centre_distance: float  # in use
    working_pressure_angle: float
    line_of_action: float  # distance N1 N2 between the base tangent points

    @property
    def pinion_working_radius(self) -> float:
        """Working pitch radius of the pinion [m]."""
        return self.pinion.base_radius / cos(self.working_pressure_angle)

    @property
    def wheel_working_radius(self) -> float:
        """Working pitch radius of the wheel [m]."""
        return self.wheel.base_radius / cos(self.working_pressure_angle)


def gear_pair(inputs: GearPairInputs) -> GearPair:
    """Radii, angles, base pitch and centre distance of a pair in the transverse plane (Eq. L1).

    Raises InvalidInput: `double_helical_spur`, `pointed_rack`, `no_involute`, `pointed_tooth`, `flank_interference`,
    `no_mesh` or `no_tip_clearance`.
    """
    check_helices(inputs)
    transverse_module = inputs.normal_module / cos(inputs.helix_angle)
    transverse_pressure_angle = atan(tan(inputs.normal_pressure_angle) / cos(inputs.helix_angle))
    pinion, wheel = _gear(inputs, inputs.pinion, "pinion"), _gear(inputs, inputs.wheel, "wheel")
    backlash_free = _backlash_free_centre_distance(inputs, pinion, wheel, transverse_pressure_angle)
    centre_distance = centre_distance_in_use(inputs.centre_distance, backlash_free)
    check_tips(pinion, wheel, centre_distance)
    working_pressure_angle = acos((pinion.base_radius + wheel.base_radius) / centre_distance)
    return GearPair(
        inputs=inputs,
        pinion=pinion,
        wheel=wheel,
        transverse_module=transverse_module,
        transverse_pressure_angle=transverse_pressure_angle,
        base_helix_angle=asin(sin(abs(inputs.helix_angle)) * cos(inputs.normal_pressure_angle)),
        transverse_base_pitch=pi * transverse_module * cos(transverse_pressure_angle),
        backlash_free_centre_distance=backlash_free,
        centre_distance=centre_distance,
        working_pressure_angle=working_pressure_angle,
        line_of_action=centre_distance * sin(working_pressure_angle),
    )


def _gear(inputs: GearPairInputs, teeth: GearTeeth, name: str) -> Gear:
    check_rack(inputs, teeth, name)
    gear = transverse_gear(inputs, teeth)
    check_teeth(gear, name)
    return gear


def _backlash_free_centre_distance(
    inputs: GearPairInputs, pinion: Gear, wheel: Gear, transverse_pressure_angle: float
) -> float:
    """Return the centre distance [m] at which inv alpha_wt = inv alpha_t + 2 (x1 + x2) tan alpha_n/(z1 + z2)."""
    shifts = inputs.pinion.profile_shift + inputs.wheel.profile_shift
    teeth = pinion.teeth + wheel.teeth
    working_involute = involute(transverse_pressure_angle) + 2 * tan(inputs.normal_pressure_angle) * shifts / teeth
    check_working_involute(working_involute)
    return (pinion.base_radius + wheel.base_radius) / cos(inverse_involute(working_involute))


class ContactPlane(NamedTuple):
    """Rectangle in the plane of action within which the teeth touch; x [m] runs from A to E, y [m] along the face.

    y begins at the end that meshes first. Contact line j is x + y `tan_base_helix` = phase + j `base_pitch`.
    """

    path_length: float
    face_width: float
    base_pitch: float
    tan_base_helix: float
    cos_base_helix: float
    start: float  # roll length of the pinion at A; at x it is start + x, that of the wheel line_of_action - start - x
    pitch_point: float
    line_of_action: float
    least_radius: float  # where the reduced radius is smaller, pressure and flash temperature have no meaning


@kernel
def reduced_radius(plane: ContactPlane, x: Real) -> Real:
    """Reduced radius of curvature R_n = s (N - s)/(N cos beta_b) [m] in the normal section, at x [m] from A.

    s is the roll length of the pinion, N the length of the line of action. For r_K/cos beta_b Eq. 13 prints
    r_K cos^3 beta_b/(1 - 2 sin^2 beta_b): equal to second order in beta_b, but singular at 45 degrees.
    """
    # The contact line is a straight generator of the involute helicoid. Across it the radius of curvature of the
    # helicoid is r_K/cos beta_b, where r_K is the transverse radius of curvature.
    s = plane.start + x
    return s * (plane.line_of_action - s) / (plane.line_of_action * plane.cos_base_helix)


@dataclass(frozen=True)
class PathOfContact:
    """Path of contact on the line of action."""

    pair: GearPair
    start: float  # roll length of the pinion at A, m
    end: float  # at E, m
    shortened_by: tuple[str, ...]  # gears whose root fillets keep the path from the tips of the mating gears

    @property
    def length(self) -> float:
        """Length g_alpha of the path A-E [m]."""
        return self.end - self.start

    @cached_property
    def pitch_point(self) -> float:
        """Pinion roll length at the pitch point C [m]."""
        return self.pair.pinion.base_radius * tan(self.pair.working_pressure_angle)

    @property
    def transverse_contact_ratio(self) -> float:
        """Transverse contact ratio eps_alpha = g_alpha/p_bt [-]; Eq. 2 prints the circular pitch pi m_t for p_bt."""
        return self.length / self.pair.transverse_base_pitch

    @property
    def overlap_ratio(self) -> float:
        """Overlap ratio eps_beta = b tan beta_b/p_bt [-] (Eq. 3)."""
        return self.plane.face_width * self.plane.tan_base_helix / self.plane.base_pitch

    @property
    def total_contact_ratio(self) -> float:
        """Total contact ratio eps_gamma = eps_alpha + eps_beta [-]."""
        return self.transverse_contact_ratio + self.overlap_ratio

    @cached_property
    def plane(self) -> ContactPlane:
        """Rectangle in the plane of action within which the teeth touch."""
        pair, face_width = self.pair, self.pair.inputs.face_width
        helix = tan(pair.base_helix_angle)
        if face_width * helix < LEAST_OVERLAP * pair.transverse_base_pitch:
            helix = 0.0
        return ContactPlane(
            path_length=self.length,
            face_width=face_width,
            base_pitch=pair.transverse_base_pitch,
            tan_base_helix=helix,
            cos_base_helix=cos(pair.base_helix_angle) if helix else 1.0,
            start=self.start,
            pitch_point=self.pitch_point,
            line_of_action=pair.line_of_action,
            least_radius=LEAST_RADIUS * pair.inputs.normal_module,
        )

    def profile_parameter(self, x: Real) -> Real:
        """Return the profile parameter Gamma = (N1K - N1C)/N1C [-] of the point K at distance x [m] from A."""
        return (self.start + x) / self.pitch_point - 1.0

    def surface_speeds(self, x: Real, pinion_speed: float) -> tuple[Real, Real]:
        """Rolling speeds u_1 and u_2 of pinion and wheel [m/s] at x [m] from A; `pinion_speed` [rad/s].

        Eq. 18 prints the radius of curvature across the contact line, which is too large by the factor 1/cos beta_b.
        """
        # Across the contact line a flank moves at exactly omega times the transverse radius of curvature.
        s = self.start + x
        wheel_speed = pinion_speed * self.pair.pinion.teeth / self.pair.wheel.teeth
        return pinion_speed * s, wheel_speed * (self.pair.line_of_action - s)


@lru_cache(maxsize=64)
def meshing_path(gears: GearPairInputs) -> PathOfContact:
    """Return the path of contact of a gear pair. Raises the errors of `gear_pair` and of `path_of_contact`."""
    return path_of_contact(gear_pair(gears))


def path_of_contact(pair: GearPair) -> PathOfContact:
    """Path of contact between the tip circles, limited to the usable involutes (Eq. L2).

    Raises InvalidInput: `form_diameter` if a fillet reaches the tip of its own gear, `no_contact` if the tips do not
    reach the line of action, `involute_interference` if the fillets leave nothing of the path.
    """
    whole = pair.line_of_action
    check_usable_flank(pair.pinion, "pinion")
    check_usable_flank(pair.wheel, "wheel")
    tip_start, tip_end = whole - pair.wheel.tip_roll_length, pair.pinion.tip_roll_length
    start = max(tip_start, pair.pinion.usable_roll_length)
    end = min(tip_end, whole - pair.wheel.usable_roll_length)
    check_path(tip_start, tip_end, start, end)
    lost = {"pinion": start - tip_start, "wheel": tip_end - end}
    return PathOfContact(pair, start, end, tuple(name for name, length in lost.items() if length > ROUNDING * whole))
