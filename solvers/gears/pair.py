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
    """A meshing pair in the transverse plane; lengths [m], angles [rad].

    `centre_distance` is the centre distance in use. `line_of_action` is the distance N1 N2 between the two base tangent
    points.
    """

    inputs: GearPairInputs
    pinion: Gear
    wheel: Gear
    transverse_module: float
    transverse_pressure_angle: float
    base_helix_angle: float
    transverse_base_pitch: float
    backlash_free_centre_distance: float
    centre_distance: float
    working_pressure_angle: float
    line_of_action: float

    @property
    def pinion_working_radius(self) -> float:
        """Working pitch radius of the pinion [m]."""
        return self.pinion.base_radius / cos(self.working_pressure_angle)

    @property
    def wheel_working_radius(self) -> float:
        """Working pitch radius of the wheel [m]."""
        return self.wheel.base_radius / cos(self.working_pressure_angle)


def gear_pair(inputs: GearPairInputs) -> GearPair:
    """Compute the geometry of a gear pair.

    Parameters
    ----------
    inputs : GearPairInputs
        The pair.

    Returns
    -------
    GearPair
        Radii, angles, base pitch and centre distance in the transverse plane.

    Raises
    ------
    InvalidInput
        `double_helical_spur`, `pointed_rack`, `no_involute`, `pointed_tooth`, `flank_interference`, `no_mesh` or
        `no_tip_clearance`.

    Notes
    -----
    Eq. L1.
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
    """Rectangle in the plane of action within which the teeth touch.

    The coordinate x [m] runs from A to E. The coordinate y [m] is measured along the face, from the end that meshes
    first. Contact line number j has the equation x + y `tan_base_helix` = phase + j `base_pitch`. At x, the roll length
    of the pinion is `start` + x, and the roll length of the wheel is `line_of_action` - `start` - x. Near a base
    circle, the reduced radius may be smaller than `least_radius`. Pressure and flash temperature then have no meaning.
    """

    path_length: float
    face_width: float
    base_pitch: float
    tan_base_helix: float
    cos_base_helix: float
    start: float
    pitch_point: float
    line_of_action: float
    least_radius: float


@kernel
def reduced_radius(plane: ContactPlane, x: Real) -> Real:
    """Compute the reduced radius of curvature in the normal section.

    Parameters
    ----------
    plane : ContactPlane
        The plane of action.
    x : Real
        Distance from A along the path of contact [m].

    Returns
    -------
    Real
        Reduced radius R_n = s (N - s)/(N cos beta_b), where s is the roll length of the pinion and N is the length of
        the line of action [m].

    Notes
    -----
    The contact line is a straight generator of the involute helicoid. Across the contact line, the radius of curvature
    of the helicoid is r_K/cos beta_b, where r_K is the transverse radius of curvature. Eq. 13 prints
    r_K cos^3 beta_b/(1 - 2 sin^2 beta_b). This expression agrees with r_K/cos beta_b to second order in beta_b, but
    the printed expression is singular at beta_b = 45 degrees.
    """
    s = plane.start + x
    return s * (plane.line_of_action - s) / (plane.line_of_action * plane.cos_base_helix)


@dataclass(frozen=True)
class PathOfContact:
    """Path of contact on the line of action.

    `start`, `end` and `pitch_point` are the roll lengths of the pinion [m] at the points A, E and C. `shortened_by`
    names the gears whose root fillets shorten the path. Without the fillets, the path would extend to the tips of the
    mating gears.
    """

    pair: GearPair
    start: float
    end: float
    shortened_by: tuple[str, ...]

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
        """Transverse contact ratio eps_alpha = g_alpha/p_bt [-].

        Eq. 2. The paper prints the circular pitch pi m_t instead of the base pitch p_bt.
        """
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
        """Compute the rolling speeds of both flanks.

        Parameters
        ----------
        x : Real
            Distance from A along the path of contact [m].
        pinion_speed : float
            Speed of the pinion [rad/s].

        Returns
        -------
        tuple of Real
            Speeds u_1 and u_2 of pinion and wheel [m/s].

        Notes
        -----
        The velocity of a flank in the direction across the contact line is exactly the angular speed omega times the
        transverse radius of curvature. Eq. 18 prints the radius of curvature across the contact line instead of the
        transverse radius. The printed radius is too large by the factor 1/cos beta_b.
        """
        s = self.start + x
        wheel_speed = pinion_speed * self.pair.pinion.teeth / self.pair.wheel.teeth
        return pinion_speed * s, wheel_speed * (self.pair.line_of_action - s)


@lru_cache(maxsize=64)
def meshing_path(gears: GearPairInputs) -> PathOfContact:
    """Return the path of contact of a gear pair. Raises the errors of `gear_pair` and of `path_of_contact`."""
    return path_of_contact(gear_pair(gears))


def path_of_contact(pair: GearPair) -> PathOfContact:
    """Compute the path of contact between the tip circles, limited to the usable involutes.

    Parameters
    ----------
    pair : GearPair
        The pair.

    Returns
    -------
    PathOfContact
        The path from A to E.

    Raises
    ------
    InvalidInput
        `form_diameter` if the fillet of a gear reaches the tip of the same gear; `no_contact` if the tips do not reach
        the line of action; `involute_interference` if no part of the path is left between the fillets.

    Notes
    -----
    Eq. L2.
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
