"""Stiffness of a pair of teeth in contact: both teeth's bending and the contact's own flattening.

A slice of contact line approaches by delta along the transverse line of action and carries w per length of line:
    linear contact      delta = C w
    half-space contact  delta = a w omega,  omega = A/a - ln w      (w in N/m)
The second has the closed form w = delta / (a omega) with omega - ln omega = A/a + ln(a / delta), a branch of
Lambert's function. `PairCompliance` holds C or A over the path of contact, and a.
"""

from dataclasses import dataclass
from math import cos, log, pi
from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import inlined_kernel, kernel
from solvers.contact.hertz import reduced_modulus
from solvers.errors import InvalidInput
from solvers.gears.gear import Gear
from solvers.gears.path_of_contact import PathOfContact, reduced_radius
from solvers.materials import Solid
from solvers.scuffing.flank.tables import interpolated, place_of
from solvers.scuffing.inputs import Model
from solvers.scuffing.teeth.compliance import bending_compliance, load_points, section_gear, tooth_shape

TABLE_POINTS = 801
LEAST_RADIUS = 1e-6  # normal modules; on a base circle it vanishes, and the half width with it
SHALLOWEST = 2.0  # half-space depth over contact half width
OMEGA_STEPS = 12
LEAST_OMEGA = 2.0  # of a guess; omega is larger wherever the law is not held, and has no meaning below 1
LAST_STEP = 1e-3  # of omega; it leaves less than a tenth of its fourth power, so the next step would be rounding


class PairCompliance(NamedTuple):
    """Compliance over equidistant points from A to E; `constant` [1/Pa] is C or A, `logarithmic` [1/Pa] is 0 or a.

    Beyond the approach `limit` [m], where the half width reaches half the depth of the half-space, the compliance
    reached there is kept.
    """

    constant: FloatArray
    limit: FloatArray
    logarithmic: float
    points_per_metre: float


@dataclass(frozen=True, slots=True)
class Member:
    """One gear's part in the pair, over the table points: radii at which it is loaded [m], bending [1/Pa]."""

    gear: Gear
    material: Solid
    radius: FloatArray
    bending: FloatArray


def pair_compliance(path: PathOfContact, pinion: Solid, wheel: Solid, model: Model) -> PairCompliance:
    """Compliance of a pair of teeth along the path.

    Raises InvalidInput contact_law: the parabola is scaled to linear contact and refuses the half-space.
    """
    if model.tooth_stiffness == "parabola" and model.contact != "linear":
        raise InvalidInput(
            "contact_law", "the parabola is scaled to Ishikawa's maximum with linear contact; choose linear", "contact"
        )
    x = np.linspace(0.0, path.length, TABLE_POINTS)
    roll_lengths = (path.start + x, path.pair.line_of_action - path.start - x)
    gears, teeth = (path.pair.pinion, path.pair.wheel), (path.pair.inputs.pinion, path.pair.inputs.wheel)
    members = [
        _member(gear, section_gear(path.pair, gear, one, model.section), roll, material)
        for gear, one, roll, material in zip(gears, teeth, roll_lengths, (pinion, wheel), strict=True)
    ]
    # A slice dy carries w dl cos(beta_b) = w dy in the transverse plane, so a tooth bent there yields to w itself; the
    # contact, and a tooth bent in its normal section, yield along the normal, which the transverse line sees longer.
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
    """c_PV = (2/pi) [(1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2] [1/Pa]; printed with one E (Eq. 6)."""
    return 2 / pi * (pinion.plane_strain_compliance + wheel.plane_strain_compliance)


def _member(gear: Gear, section: Gear, roll_length: FloatArray, material: Solid) -> Member:
    """A member's bending in its section, at the same height above the reference circle."""
    radius = np.hypot(gear.base_radius, roll_length)
    points = load_points(section, section.reference_radius + radius - gear.reference_radius)
    return Member(gear, material, radius, bending_compliance(tooth_shape(section), points, material))


def _half_space(path: PathOfContact, x: FloatArray, members: list[Member]) -> tuple[FloatArray, float, float]:
    """Offset [1/Pa], slope [1/Pa] and least contact part of omega of the half-space contact (Johnson 1985; Weber).

    delta_H / w = sum_i (1 - nu_i^2)/(pi E_i) [2 ln(2 d_i / b_H) - nu_i/(1 - nu_i)],  b_H^2 = 8 w R_n/(pi E').
    """
    modulus = reduced_modulus(members[0].material, members[1].material)
    radius = np.maximum(reduced_radius(path.plane, x), LEAST_RADIUS * path.pair.inputs.normal_module)
    log_square = np.log(8 * radius / (pi * modulus))  # of b_H at 1 N/m
    slope = sum(member.material.plane_strain_compliance for member in members) / pi
    offset, least = np.zeros_like(x), 0.0
    for member in members:
        own = member.material.plane_strain_compliance / pi
        poisson = member.material.poisson_ratio / (1 - member.material.poisson_ratio)
        depth = load_points(member.gear, member.radius).depth  # in the transverse section
        offset += own * (2 * np.log(2 * depth) - log_square - poisson)
        least += own * (2 * log(2 * SHALLOWEST) - poisson)
    return offset, slope, least / slope


def _parabola(fraction: FloatArray, end_ratio: float) -> FloatArray:
    """1 - (1 - r)(2 xi - 1)^2, calibrated to the paper's load maxima with r = 0.757."""
    return np.asarray(1 - (1 - end_ratio) * (2 * fraction - 1) ** 2)


@inlined_kernel
def compliance_at(compliance: PairCompliance, x: float) -> tuple[float, float]:
    """`constant` [1/Pa] and `limit` [m] at x [m] from A; linear contact has no limit."""
    place = place_of(x, compliance.points_per_metre, compliance.constant.size)
    constant = interpolated(compliance.constant, place)
    return constant, np.inf if compliance.logarithmic == 0.0 else interpolated(compliance.limit, place)


@inlined_kernel
def line_load(
    approach: float, constant: float, logarithmic: float, limit: float, log_load: float
) -> tuple[float, float, float]:
    """Line load w [N/m], its derivative [Pa] by the approach [m], and ln w, a next guess as `log_load` is."""
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
    """The same after one step of omega from the guess, and that step, relative; it leaves its fourth power.

    omega - ln omega = A/a + ln(a / delta) by the iteration of Fritsch, Shafer and Crowley (1973) for Lambert's
    function, which takes one logarithm a step and settles from any guess; dw/d(delta) = 1 / (a (omega - 1)). The guess
    is carried as ln w, at most that of the limit, which changes less from place to place than omega does.
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
    common = per_slope / (omega * (omega - 1.0))  # of the load and its derivative
    rising = omega - 1.0 if approach > limit else omega
    return approach * (omega - 1.0) * common, rising * common, offset - omega, step


@kernel
def _secants(constant: FloatArray, limit: FloatArray, logarithmic: float, load: float) -> FloatArray:
    """1 / (a omega) at a line load [N/m], omega that of the load or of the limit."""
    stiffness = np.empty(constant.size)
    for i in range(constant.size):
        _, _, log_limit = line_load(limit[i], constant[i], logarithmic, limit[i], np.log(load))
        stiffness[i] = 1.0 / (constant[i] - logarithmic * min(np.log(load), log_limit))
    return stiffness


def single_stiffness(compliance: PairCompliance, load: float) -> FloatArray:
    """Secant stiffness w / delta [Pa] of one pair at the table points under the line load [N/m]."""
    if compliance.logarithmic == 0.0:
        return np.asarray(1 / compliance.constant)
    return _secants(compliance.constant, compliance.limit, compliance.logarithmic, load)
