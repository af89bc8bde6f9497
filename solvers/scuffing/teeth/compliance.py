"""Compliance of one tooth: Ishikawa's rectangle and trapezium (Eqs. 5-6), per unit width, along the load."""

from dataclasses import dataclass
from math import cos, pi, sin, sqrt
from typing import Literal

import numpy as np

from solvers.arrays import FloatArray
from solvers.errors import InvalidInput
from solvers.gears.gear import Gear, virtual_gear
from solvers.gears.inputs import GearTeeth
from solvers.gears.pair import GearPair
from solvers.materials import Solid


@dataclass(frozen=True, slots=True)
class LoadPoints:
    """Where and how a tooth is loaded, over the load points.

    height above the root chord [m], angle of the load against the normal of the centre line [rad], depth from the
    flank to the centre line along the load [m].
    """

    height: FloatArray
    angle: FloatArray
    depth: FloatArray


@dataclass(frozen=True, slots=True)
class ToothShape:
    """Rectangle (root_width, rectangle_height) below a trapezium that narrows to tip_width at `height` [m]."""

    root_width: float
    tip_width: float
    rectangle_height: float
    height: float


def section_gear(pair: GearPair, gear: Gear, teeth: GearTeeth, section: Literal["normal", "transverse"]) -> Gear:
    """The gear whose teeth are bent: itself, or the virtual spur gear of z / (cos^2 beta_b cos beta) teeth."""
    return gear if section == "transverse" else virtual_gear(pair.inputs, teeth, pair.base_helix_angle)


def tooth_shape(gear: Gear) -> ToothShape:
    """The rectangle and trapezium of a tooth.

    Heights run along the centre line from the chord of width S_F that lies on the root circle. A tooth no narrower
    at the tip than at the root counts as one rectangle. Raises InvalidInput pointed_tooth: the virtual tooth of a
    normal section may end in a point where the tooth itself does not.
    """
    root_angle, tip_angle = gear.half_tooth_angle(gear.form_radius), gear.half_tooth_angle(gear.tip_radius)
    root_width = 2 * gear.form_radius * sin(root_angle)
    tip_width = 2 * gear.tip_radius * sin(tip_angle)
    if tip_width <= 0.0:
        raise InvalidInput(
            "pointed_tooth",
            "a tooth is pointed in its normal section; choose transverse, or reduce addendum or profile shift",
            "section",
        )
    height = gear.tip_radius * cos(tip_angle) - _chord_height(gear, root_width)
    if root_width <= tip_width:
        return ToothShape(root_width, root_width, height, height)
    return ToothShape(
        root_width, tip_width, gear.form_radius * cos(root_angle) - _chord_height(gear, root_width), height
    )


def load_points(gear: Gear, radius: FloatArray) -> LoadPoints:
    """Load points at radii [m].

    The load angle is alpha_x - g_x, flank pressure angle less half tooth angle (the paper calls it pressure angle; the
    static bending arm needs the load angle).
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
    """Distance of the root chord from the gear's axis [m].

    Raises InvalidInput root_circle where the chord does not fit into the root circle.
    """
    if gear.root_radius <= root_width / 2:
        message = "a gear's root circle is narrower than the root of its teeth; reduce the dedendum or take more teeth"
        raise InvalidInput("root_circle", message, "gears")
    return sqrt(gear.root_radius**2 - root_width**2 / 4)


def bending_rectangle(shape: ToothShape, points: LoadPoints, material: Solid) -> FloatArray:
    """delta_Br / w [1/Pa], for load heights above or inside the rectangle."""
    h_x, s_f = points.height, shape.root_width
    h_r = np.minimum(shape.rectangle_height, h_x)
    factor = 12 * np.cos(points.angle) ** 2 / (material.youngs_modulus * s_f**3)
    return np.asarray(factor * (h_x * h_r * (h_x - h_r) + h_r**3 / 3))


def bending_trapezium(shape: ToothShape, points: LoadPoints, material: Solid) -> FloatArray:
    """delta_Bt / w [1/Pa]: 6 cos^2 w / (E S_F^3) [q (4 - q) - 2 ln q - 3] (h_i - h_r)^3, q = (h_i - h_x)/(h_i - h_r).

    The logarithm is right as printed (with its sign turned the compliance is negative); E is that of the member, not
    E_1 as printed.
    """
    if shape.tip_width == shape.root_width:
        return np.zeros_like(points.height)
    q = _apex_fraction(shape, points)
    factor = 6 * np.cos(points.angle) ** 2 / (material.youngs_modulus * shape.root_width**3)
    return np.asarray(factor * (q * (4 - q) - 2 * np.log(q) - 3) * (_apex_height(shape) - shape.rectangle_height) ** 3)


def shear(shape: ToothShape, points: LoadPoints, material: Solid) -> FloatArray:
    """delta_S / w [1/Pa], shear factor 1: 2 (1 + nu) cos^2 w / (E S_F) [h_r + (h_i - h_r) ln(1/q)]."""
    length = np.minimum(shape.rectangle_height, points.height)
    if shape.tip_width < shape.root_width:
        slope_height = _apex_height(shape) - shape.rectangle_height
        length = length - slope_height * np.log(_apex_fraction(shape, points))
    factor = 2 * (1 + material.poisson_ratio) * np.cos(points.angle) ** 2
    return np.asarray(factor / (material.youngs_modulus * shape.root_width) * length)


def root_rotation(shape: ToothShape, points: LoadPoints, material: Solid) -> FloatArray:
    """delta_G / w = 24 h_x^2 cos^2 w / (pi E S_F^2) [1/Pa].

    Printed with h_x in place of h_x^2; a rotation M/(E S_F^2) times the arm h_x, and the unit, ask for the square.
    """
    arm = points.height * np.cos(points.angle)
    return np.asarray(24 * arm**2 / (pi * material.youngs_modulus * shape.root_width**2))


def bending_compliance(shape: ToothShape, points: LoadPoints, material: Solid) -> FloatArray:
    """Deflection of one tooth along the load per line load [1/Pa] (Eq. 5)."""
    parts = (bending_rectangle, bending_trapezium, shear, root_rotation)
    return np.asarray(sum(part(shape, points, material) for part in parts))


def _apex_height(shape: ToothShape) -> float:
    """h_i = (h S_F - h_r S_a) / (S_F - S_a): where the trapezium's sides meet."""
    h, h_r, s_f, s_a = shape.height, shape.rectangle_height, shape.root_width, shape.tip_width
    return (h * s_f - h_r * s_a) / (s_f - s_a)


def _apex_fraction(shape: ToothShape, points: LoadPoints) -> FloatArray:
    """Q = (h_i - h_x) / (h_i - h_r), 1 within the rectangle."""
    apex = _apex_height(shape)
    return np.minimum((apex - points.height) / (apex - shape.rectangle_height), 1.0)
