"""Stiffness of a pair of teeth: bending of each tooth (Ishikawa, Eqs. 5-6), and flattening of the contact.

At a slice of a contact line, the flanks approach each other by delta along the transverse line of action and carry the
line load w. There are two contact models:
    linear contact      delta = C w
    half-space contact  delta = a w omega,  omega = A/a - ln w      (w in N/m)
The load of a half-space contact is w = delta / (a omega). Here omega is the solution of the equation
omega - ln omega = A/a + ln(a / delta). This solution is a branch of Lambert's function. The symbols `C`, `A` and `a`
are compliances [1/Pa]. `C` and `A` depend on the point of the path of contact; `a` is the same at all points.
`PairCompliance` contains these compliances.
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from math import cos, log, pi, sin, sqrt
from typing import Literal, NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import inlined_kernel, kernel
from solvers.contact.hertz import plane_strain_compliance, reduced_modulus
from solvers.errors import InvalidInput
from solvers.gears.gear import Gear, virtual_gear
from solvers.gears.inputs import GearTeeth
from solvers.gears.pair import GearPair, PathOfContact, reduced_radius
from solvers.materials import Solid
from solvers.scuffing.inputs import Model
from solvers.scuffing.modification import interpolated, place_of

TABLE_POINTS = 801  # one point per 0.125 % of the path, chosen
LEAST_RADIUS = 1e-6  # normal modules; on a base circle the reduced radius and the half width would be 0
SHALLOWEST = 2.0  # least ratio of the depth of the half-space to the half width of the contact
OMEGA_STEPS = 12  # largest number of iterations for the branch of Lambert's function
# A guess of omega below this limit is raised to the limit. The true omega is larger than this limit, except where the
# compliance is held constant. Values of omega below 1 have no meaning.
LEAST_OMEGA = 2.0
# Relative step of omega at which the iteration ends. The error after a smaller step is below a tenth of the fourth
# power of this step, so that the next step would change only rounding errors.
LAST_STEP = 1e-3


@dataclass(frozen=True, slots=True)
class LoadPoints:
    """Points at which a tooth is loaded; the fields are arrays over these points.

    `height` is the height of the point above the root chord [m]. `angle` is the angle between the load and the normal
    of the tooth's centre line [rad]. `depth` is the distance from the flank to the centre line, measured along the load
    [m].
    """

    height: FloatArray
    angle: FloatArray
    depth: FloatArray


@dataclass(frozen=True, slots=True)
class ToothShape:
    """Shape of a tooth: a rectangle at the root, and a trapezium on top of the rectangle; lengths in [m].

    The rectangle is `root_width` wide and `rectangle_height` high. The trapezium narrows to `tip_width` at `height`.
    """

    root_width: float
    tip_width: float
    rectangle_height: float
    height: float


def section_gear(pair: GearPair, gear: Gear, teeth: GearTeeth, section: Literal["normal", "transverse"]) -> Gear:
    """Return the gear whose tooth shape is used to compute the bending.

    For the transverse section, this is the gear itself. For the normal section, this is the virtual spur gear, which
    has z / (cos^2 beta_b cos beta) teeth.
    """
    return gear if section == "transverse" else virtual_gear(pair.inputs, teeth, pair.base_helix_angle)


def tooth_shape(gear: Gear) -> ToothShape:
    """Return the rectangle and the trapezium of a tooth.

    Heights are measured along the tooth's centre line from the root chord, which is the chord of width S_F on the root
    circle. If a tooth is at least as wide at the tip as at the root, its shape is a single rectangle. Raises
    InvalidInput (`pointed_tooth`) if the tooth ends in a point. In the normal section, the tooth of the virtual gear
    may end in a point even if the tooth of the gear itself does not.
    """
    root_angle, tip_angle = gear.half_tooth_angle(gear.form_radius), gear.half_tooth_angle(gear.tip_radius)
    root_width = 2 * gear.form_radius * sin(root_angle)
    tip_width = 2 * gear.tip_radius * sin(tip_angle)
    if tip_width <= 0.0:
        raise InvalidInput(
            "pointed_tooth",
            "a tooth is pointed in its normal section; choose the transverse section, or reduce addendum or profile "
            "shift",
            "section",
        )
    height = gear.tip_radius * cos(tip_angle) - _chord_height(gear, root_width)
    if root_width <= tip_width:
        return ToothShape(root_width, root_width, height, height)
    return ToothShape(
        root_width, tip_width, gear.form_radius * cos(root_angle) - _chord_height(gear, root_width), height
    )


def load_points(gear: Gear, radius: FloatArray) -> LoadPoints:
    """Return the load points of a tooth at the given radii [m].

    The load angle is alpha_x - g_x: the pressure angle of the flank minus half the angle that the tooth fills at this
    radius. The paper calls the load angle a pressure angle. But the arm of the bending moment depends on the load
    angle, not on the pressure angle.
    """
    pressure_angle = np.arccos(np.minimum(gear.base_radius / radius, 1.0))
    half_angle = gear.reference_half_angle + gear.reference_involute - np.tan(pressure_angle) + pressure_angle
    angle = pressure_angle - half_angle
    root_width = 2 * gear.form_radius * sin(gear.half_tooth_angle(gear.form_radius))
    return LoadPoints(
        height=radius * np.cos(half_angle) - _chord_height(gear, root_width),
        angle=angle,
        depth=radius * np.sin(half_angle) / np.cos(angle),
    )


def _chord_height(gear: Gear, root_width: float) -> float:
    """Return the distance of the root chord from the gear's axis [m].

    Raises InvalidInput (`root_circle`) if the chord does not fit into the root circle.
    """
    if gear.root_radius <= root_width / 2:
        message = (
            "the roots of the teeth do not fit on the root circle of a gear; reduce the dedendum or increase the "
            "number of teeth"
        )
        raise InvalidInput("root_circle", message, "gears")
    return sqrt(gear.root_radius**2 - root_width**2 / 4)


def bending_rectangle(shape: ToothShape, points: LoadPoints, material: Solid) -> FloatArray:
    """Compute the bending deflection of the rectangle of a tooth [1/Pa].

    Eq. L4: delta_Br / w. The formula holds for loads above the rectangle and for loads on the rectangle.
    """
    h_x, s_f = points.height, shape.root_width
    h_r = np.minimum(shape.rectangle_height, h_x)
    factor = 12 * np.cos(points.angle) ** 2 / (material.youngs_modulus * s_f**3)
    return np.asarray(factor * (h_x * h_r * (h_x - h_r) + h_r**3 / 3))


def bending_trapezium(shape: ToothShape, points: LoadPoints, material: Solid) -> FloatArray:
    """Compute the bending deflection of the trapezium of a tooth [1/Pa].

    Eq. L5: delta_Bt / w = 6 cos^2 omega_x / (E S_F^3) [q (4 - q) - 2 ln q - 3] (h_i - h_r)^3 with q = (h_i - h_x)/(h_i
    - h_r) and the load angle omega_x. h_i is the height at which the sides of the trapezium meet, h_r is the height of
    the rectangle, h_x is the height of the load point, and S_F is the width of the rectangle. The sign of the logarithm
    is right as printed; with the other sign the compliance would be negative. E is the modulus of the gear itself; the
    paper prints E_1.
    """
    if shape.tip_width == shape.root_width:
        return np.zeros_like(points.height)
    q = _apex_fraction(shape, points)
    factor = 6 * np.cos(points.angle) ** 2 / (material.youngs_modulus * shape.root_width**3)
    return np.asarray(factor * (q * (4 - q) - 2 * np.log(q) - 3) * (_apex_height(shape) - shape.rectangle_height) ** 3)


def shear(shape: ToothShape, points: LoadPoints, material: Solid) -> FloatArray:
    """Compute the shear deflection of a tooth [1/Pa].

    Eq. L6: delta_S / w = 2 (1 + nu) cos^2 omega_x / (E S_F) [h_r + (h_i - h_r) ln(1/q)], with the load angle omega_x
    and a shear factor of 1. The other symbols are those of `bending_trapezium`.
    """
    length = np.minimum(shape.rectangle_height, points.height)
    if shape.tip_width < shape.root_width:
        slope_height = _apex_height(shape) - shape.rectangle_height
        length = length - slope_height * np.log(_apex_fraction(shape, points))
    factor = 2 * (1 + material.poisson_ratio) * np.cos(points.angle) ** 2
    return np.asarray(factor / (material.youngs_modulus * shape.root_width) * length)


def root_rotation(shape: ToothShape, points: LoadPoints, material: Solid) -> FloatArray:
    """Compute the deflection that the rotation of the root of a tooth causes [1/Pa].

    Eq. L7: delta_G / w = 24 h_x^2 cos^2 omega_x / (pi E S_F^2), with the load angle omega_x. The paper prints h_x
    instead of h_x^2. The bending moment M is proportional to the arm h_x, and the rotation is proportional to M/(E
    S_F^2). The deflection is the rotation times the arm h_x, and is therefore proportional to h_x^2. Only h_x^2 gives
    the right unit.
    """
    arm = points.height * np.cos(points.angle)
    return np.asarray(24 * arm**2 / (pi * material.youngs_modulus * shape.root_width**2))


def bending_compliance(shape: ToothShape, points: LoadPoints, material: Solid) -> FloatArray:
    """Compute the deflection of one tooth in the direction of the load [1/Pa] (Eq. 5)."""
    parts = (bending_rectangle, bending_trapezium, shear, root_rotation)
    return np.asarray(sum(part(shape, points, material) for part in parts))


def _apex_height(shape: ToothShape) -> float:
    """Return h_i = (h S_F - h_r S_a) / (S_F - S_a), the height at which the sides of the trapezium meet."""
    h, h_r, s_f, s_a = shape.height, shape.rectangle_height, shape.root_width, shape.tip_width
    return (h * s_f - h_r * s_a) / (s_f - s_a)


def _apex_fraction(shape: ToothShape, points: LoadPoints) -> FloatArray:
    """Return q = (h_i - h_x) / (h_i - h_r); return 1 for load points on the rectangle.

    Here h_i is the height that `_apex_height` returns, h_x is the height of a load point, and h_r is the height of the
    rectangle.
    """
    apex = _apex_height(shape)
    return np.minimum((apex - points.height) / (apex - shape.rectangle_height), 1.0)


class PairCompliance(NamedTuple):
    """Compliance of a pair of teeth at equidistant points from A to E.

    The compliances `C`, `A` and `a` are defined at the top of this module. For linear contact, `constant` [1/Pa] is `C`
    and `logarithmic` [1/Pa] is 0. For half-space contact, `constant` is `A` and `logarithmic` is `a`. `limit` [m] is
    the approach of the flanks up to which the formula for half-space contact is used (see `_half_space`). At larger
    approaches the compliance is held constant.
    """

    constant: FloatArray
    limit: FloatArray
    logarithmic: float
    points_per_metre: float


@dataclass(frozen=True, slots=True)
class Member:
    """One gear of the pair.

    `radius` [m] and `bending` [1/Pa] are arrays over the points of the compliance table. `radius` is the radius at
    which the load acts on the tooth. `bending` is the bending compliance of the tooth under a load at this radius.
    """

    gear: Gear
    material: Solid
    radius: FloatArray
    bending: FloatArray


def pair_compliance(path: PathOfContact, pinion: Solid, wheel: Solid, model: Model) -> PairCompliance:
    """Compute the compliance of a pair of teeth along the path (Eqs. 7, L8).

    The result is stored and reused for further loads of the same teeth. Raises InvalidInput: `contact_law` if the
    parabola is combined with the half-space; the parabola is defined only for linear contact.
    """
    return _pair_compliance(path, replace(pinion, roughness=0.0), replace(wheel, roughness=0.0), model)


@lru_cache(maxsize=64)
def _pair_compliance(path: PathOfContact, pinion: Solid, wheel: Solid, model: Model) -> PairCompliance:
    if model.tooth_stiffness == "parabola" and model.contact != "linear":
        raise InvalidInput(
            "contact_law",
            "the tooth stiffness 'parabola' is only defined for the contact model 'linear'; choose this contact model",
            "contact",
        )
    x = np.linspace(0.0, path.length, TABLE_POINTS)
    roll_lengths = (path.start + x, path.pair.line_of_action - path.start - x)
    gears, teeth = (path.pair.pinion, path.pair.wheel), (path.pair.inputs.pinion, path.pair.inputs.wheel)
    members = [
        _member(gear, section_gear(path.pair, gear, one, model.section), roll, material)
        for gear, one, roll, material in zip(gears, teeth, roll_lengths, (pinion, wheel), strict=True)
    ]
    # In the transverse plane a slice dy carries w dl cos(beta_b) = w dy. If the tooth bends in this plane, the load per
    # width is therefore w itself. The contact deflects along the normal of the flank, and so does a tooth that bends in
    # its normal section. Along the transverse line of action this deflection is larger by the factor 1 / cos(beta_b).
    inclination = cos(path.pair.base_helix_angle)
    bending = (members[0].bending + members[1].bending) / (inclination if model.section == "normal" else 1.0)
    points_per_metre = (TABLE_POINTS - 1) / path.length
    if model.contact == "linear":
        constant = bending + linear_contact_compliance(pinion, wheel) / inclination
        if model.tooth_stiffness == "parabola":
            constant = constant.min() / _parabola(x / path.length, model.parabola_end_ratio)
        return PairCompliance(constant, np.full_like(x, np.inf), 0.0, points_per_metre)
    offset, slope, least = _half_space(path, x, members)
    constant, logarithmic = bending + offset / inclination, slope / inclination
    least_omega = bending / logarithmic + least
    limit = logarithmic * least_omega * np.exp(constant / logarithmic - least_omega)
    return PairCompliance(constant, limit, logarithmic, points_per_metre)


def linear_contact_compliance(pinion: Solid, wheel: Solid) -> float:
    """Compute the compliance of the linear contact [1/Pa].

    Eq. 6: c_PV = (2/pi) [(1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2]; the paper prints one E for both.
    """
    return 2 / pi * (plane_strain_compliance(pinion) + plane_strain_compliance(wheel))


def _member(gear: Gear, section: Gear, roll_length: FloatArray, material: Solid) -> Member:
    """Return a gear of the pair with the bending compliance of its teeth.

    The bending is computed for a tooth of `section`, the gear that `section_gear` returns for `gear`. On this tooth,
    the load acts at the same height above the reference circle as on a tooth of `gear`.
    """
    radius = np.hypot(gear.base_radius, roll_length)
    points = load_points(section, section.reference_radius + radius - gear.reference_radius)
    return Member(gear, material, radius, bending_compliance(tooth_shape(section), points, material))


def _half_space(path: PathOfContact, x: FloatArray, members: list[Member]) -> tuple[FloatArray, float, float]:
    """Return offset and slope [1/Pa] of the half-space compliance, and the contact's least contribution to omega.

    The compliance between two half-spaces (Johnson 1985, Weber) equals offset - slope ln w:
    delta_H / w = sum_i (1 - nu_i^2)/(pi E_i) [2 ln(2 d_i / b_H) - nu_i/(1 - nu_i)],  b_H^2 = 8 w R_n/(pi E'),
    with the half width b_H and the `depth` d_i of the load point of gear i (see `LoadPoints`). It contributes
    offset / slope - ln w to omega, least where b_H is so large that d_i is `SHALLOWEST` b_H for both gears.
    """
    modulus = reduced_modulus(members[0].material, members[1].material)
    radius = np.maximum(reduced_radius(path.plane, x), LEAST_RADIUS * path.pair.inputs.normal_module)
    log_square = np.log(8 * radius / (pi * modulus))  # ln b_H^2 at 1 N/m
    slope = sum(plane_strain_compliance(member.material) for member in members) / pi
    offset, least = np.zeros_like(x), 0.0
    for member in members:
        own = plane_strain_compliance(member.material) / pi
        poisson = member.material.poisson_ratio / (1 - member.material.poisson_ratio)
        depth = load_points(member.gear, member.radius).depth  # in the transverse section
        offset += own * (2 * np.log(2 * depth) - log_square - poisson)
        least += own * (2 * log(2 * SHALLOWEST) - poisson)
    return offset, slope, least / slope


def _parabola(fraction: FloatArray, end_ratio: float) -> FloatArray:
    """Return the ratio of the stiffness to its maximum, 1 - (1 - r)(2 xi - 1)^2.

    Here r is `end_ratio`, and xi is `fraction`, the distance from A divided by the length of the path. With r = 0.757
    the largest loads agree with the largest loads in the paper.
    """
    return np.asarray(1 - (1 - end_ratio) * (2 * fraction - 1) ** 2)


@inlined_kernel
def compliance_at(compliance: PairCompliance, x: float) -> tuple[float, float]:
    """Return `constant` [1/Pa] and `limit` [m] at x [m] from A; for linear contact, `limit` is infinite."""
    place = place_of(x, compliance.points_per_metre, compliance.constant.size)
    constant = interpolated(compliance.constant, place)
    return constant, np.inf if compliance.logarithmic == 0.0 else interpolated(compliance.limit, place)


@inlined_kernel
def line_load(
    approach: float, constant: float, logarithmic: float, limit: float, log_load: float
) -> tuple[float, float, float]:
    """Compute the line load of a pair of teeth under an approach (Eq. L9).

    Returns `load`: line load w [N/m]; `stiffness`: derivative of the line load with respect to the approach [Pa];
    `log_load`: logarithm ln w; serves as the guess at a similar approach.
    """
    load = stiffness = 0.0
    for _ in range(OMEGA_STEPS):
        load, stiffness, log_load, step = line_load_near(approach, constant, logarithmic, limit, log_load)
        if abs(step) <= LAST_STEP:
            break
    return load, stiffness, log_load


@inlined_kernel
def line_load_near(
    approach: float, constant: float, logarithmic: float, limit: float, log_load: float
) -> tuple[float, float, float, float]:
    """Improve a guess of omega by one step. Return the three results of `line_load`, and the relative step of omega.

    The symbols are defined at the top of this module. The equation omega - ln omega = A/a + ln(a / delta) is solved by
    the iteration of Fritsch, Shafer and Crowley (1973) for Lambert's function. This iteration needs one logarithm per
    step and converges from any guess. After a step, the error of omega is of the order of the fourth power of the step.
    The guess is given as ln w, because ln w changes less than omega between neighbouring roll positions. If `approach`
    exceeds `limit`, the returned ln w belongs to `limit`.
    """
    if approach <= 0.0:
        return 0.0, 0.0, log_load, 0.0
    if logarithmic == 0.0:
        return approach / constant, 1.0 / constant, log_load, 0.0
    per_slope = 1.0 / logarithmic
    offset = constant * per_slope
    omega = max(offset - log_load, LEAST_OMEGA)
    excess, slope = omega - offset + np.log(min(approach, limit) * per_slope / omega), omega - 1.0
    scale = 2.0 * slope * (slope - excess * (2.0 / 3.0))
    step = -excess * (scale - excess) / (slope * (scale - 2.0 * excess))
    omega *= 1.0 + step
    common = per_slope / (omega * (omega - 1.0))  # common factor of the load and its derivative
    rising = omega - 1.0 if approach > limit else omega
    return approach * (omega - 1.0) * common, rising * common, offset - omega, step


@kernel
def _secants(constant: FloatArray, limit: FloatArray, logarithmic: float, load: float) -> FloatArray:
    """Return the stiffness 1 / (a omega) [Pa] at every table point under the line load `load` [N/m].

    The docstring of this module explains a and omega; a is `logarithmic`. If the load causes an approach greater than
    `limit`, omega keeps the value that omega has at the approach `limit`.
    """
    stiffness = np.empty(constant.size)
    for i in range(constant.size):
        _, _, log_limit = line_load(limit[i], constant[i], logarithmic, limit[i], np.log(load))
        stiffness[i] = 1.0 / (constant[i] - logarithmic * min(np.log(load), log_limit))
    return stiffness


def single_stiffness(compliance: PairCompliance, load: float) -> FloatArray:
    """Return the secant stiffness w / delta [Pa] of one pair of teeth at the table points, under a line load [N/m]."""
    if compliance.logarithmic == 0.0:
        return np.asarray(1 / compliance.constant)
    return _secants(compliance.constant, compliance.limit, compliance.logarithmic, load)
