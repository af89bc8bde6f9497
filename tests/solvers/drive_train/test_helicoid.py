"""Mesh force and thermal growth agree with involute helicoids that are built point by point.

A taut string unwinds from the base circle, and its end draws a curve. A flank is this curve, moved along Z and turned
about Z. The flanks use the line of action itself, but no formula for the growth along this line.
"""

from collections.abc import Callable
from dataclasses import replace
from math import cos, sin

import numpy as np
import pytest
from scipy.optimize import fsolve

from solvers.arrays import FloatArray
from solvers.drive_train.gap.thermal_lead import EXPANSION, thermal_lead
from solvers.drive_train.inputs import Arrangement, Heat
from solvers.drive_train.shafts.frame import Z_AXIS, frame
from solvers.gears.pair import PathOfContact
from solvers.scuffing.model import mesh_of
from tests.support.drive_trains import turbo_gear

UNIT = turbo_gear()
PATH: PathOfContact = mesh_of(UNIT.mesh.distribution).path
Surface = Callable[[float, float], FloatArray]
STANDINGS = [
    Arrangement(hand=hand, rotation=rotation, wheel_angle=angle)
    for hand in ("right", "left")
    for rotation in ("counterclockwise", "clockwise")
    for angle in (0.0, 2.2)
]
PLACES = [(0.1, 0.0), (0.4, 0.3), (0.9, 1.0)]  # shares of path and face


def turned(vector: FloatArray, angle: float) -> FloatArray:
    x, y, z = vector
    return np.array([cos(angle) * x - sin(angle) * y, sin(angle) * x + cos(angle) * y, z])


def helicoid(centre: FloatArray, foot: FloatArray, end: FloatArray, twist: float) -> Surface:
    """Return the flank through `end` that the end of a taut string draws, as a function of unwound angle and Z."""
    # The string leaves the base circle around `centre` at `foot`. If the string unwinds further by an angle, its length
    # changes by the arc. `twist` [rad/m] turns the curve along Z.
    arm, string = foot - centre, end - foot
    radius, length = np.linalg.norm(arm), np.linalg.norm(string)
    taut = string / length
    sense = float(np.cross(arm, taut)[2]) / radius

    def surface(unwound: float, along: float) -> FloatArray:
        drawn = turned(arm, unwound) + (length - sense * radius * unwound) * turned(taut, unwound)
        return np.asarray(centre + turned(drawn, twist * along) + along * Z_AXIS)

    return surface


def flanks(standing: Arrangement, reach: float) -> tuple[FloatArray, Surface, Surface]:
    """Return the direction of the path of contact, and the flanks of pinion and wheel.

    At the end y = 0 of the face, both flanks touch at the pinion's roll length `reach` [m].
    """
    pair, own = PATH.pair, frame(standing, PATH, 0.0)
    onward = -own.transverse_force
    point = own.arms[0] + (reach - PATH.pitch_point) * onward
    centre = pair.centre_distance * own.radial
    hand = 1.0 if standing.hand == "right" else -1.0
    slope = PATH.plane.tan_base_helix
    pinion = helicoid(np.zeros(3), point - reach * onward, point, hand * slope / pair.pinion.base_radius)
    rest = pair.line_of_action - reach
    wheel = helicoid(centre, point + rest * onward, point, -hand * slope / pair.wheel.base_radius)
    return onward, pinion, wheel


def beyond(surface: Surface, origin: FloatArray, onward: FloatArray, along: float, growth: float = 0.0) -> float:
    """Return the distance along the path of contact from the cold flank at Z = 0 to the grown flank at Z = `along`."""
    # The flank grows around `origin` by the share `growth`.
    began = surface(0.0, 0.0)

    def miss(unknown: FloatArray) -> FloatArray:
        unwound, distance = unknown
        grown = origin + (1 + growth) * (surface(unwound, along / (1 + growth)) - origin)
        return np.asarray((grown - began - distance * onward)[:2])

    return float(fsolve(miss, np.zeros(2), xtol=1e-10)[1])


@pytest.mark.parametrize("standing", STANDINGS)
@pytest.mark.parametrize("share", [0.05, 0.5, 0.95])
def test_the_force_is_normal_to_the_flanks(standing: Arrangement, share: float) -> None:
    own = frame(standing, PATH, 0.0)
    step = 1e-5
    for flank in flanks(standing, PATH.start + share * PATH.length)[1:]:
        by_roll = flank(step, 0.0) - flank(-step, 0.0)
        by_face = flank(0.0, step) - flank(0.0, -step)
        normal = np.cross(by_roll, by_face)
        normal *= np.sign(normal @ own.transverse_force) / np.linalg.norm(normal)
        assert normal / cos(PATH.pair.base_helix_angle) == pytest.approx(own.faces[0].force, abs=1e-6)


@pytest.mark.parametrize("standing", STANDINGS)
def test_the_face_begins_at_the_end_that_is_ahead(standing: Arrangement) -> None:
    """At the distance y from the end that meshes first, both flanks lie back by y tan beta_b and still touch."""
    own = frame(standing, PATH, 0.0)
    onward, pinion, wheel = flanks(standing, PATH.pitch_point)
    centre = PATH.pair.centre_distance * own.radial
    for y in (0.05, 0.2):
        back = -y * PATH.plane.tan_base_helix
        assert beyond(pinion, np.zeros(3), onward, own.faces[0].direction * y) == pytest.approx(back, abs=1e-10)
        assert beyond(wheel, centre, onward, own.faces[0].direction * y) == pytest.approx(back, abs=1e-10)


@pytest.mark.parametrize("standing", STANDINGS)
@pytest.mark.parametrize("rises", [(15.0, 0.0), (0.0, 12.0), (20.0, 20.0), (25.0, -5.0)])
def test_growth_by_heat_closes_the_gap_that_the_thermal_lead_says(
    standing: Arrangement, rises: tuple[float, float]
) -> None:
    """Each gear body expands away from its axis and away from the plane y = 0."""
    # To first order in the growth, thermal lead and profile slope together equal the gap between the flanks, up to a
    # constant.
    heat = Heat(0.0, pinion_bulk=300.0 + rises[0], wheel_bulk=300.0 + rises[1], reference=300.0)
    y = np.linspace(0.0, PATH.plane.face_width, 11)
    found = thermal_lead(replace(UNIT, heat=heat, arrangement=standing), PATH, y)
    own = frame(standing, PATH, 0.0)
    centre = PATH.pair.centre_distance * own.radial
    gaps, said = [], []
    for along_path, along_face in PLACES:
        x, width = along_path * PATH.length, along_face * PATH.plane.face_width
        onward, pinion, wheel = flanks(standing, PATH.start + x + width * PATH.plane.tan_base_helix)
        place, back = own.faces[0].direction * width, -width * PATH.plane.tan_base_helix
        closer = beyond(pinion, np.zeros(3), onward, place, EXPANSION * rises[0]) - back
        closer -= beyond(wheel, centre, onward, place, EXPANSION * rises[1]) - back
        gaps.append(-closer)
        said.append(float(np.interp(width, y, found.lead)) + found.profile_slope * (along_path - 0.5))
    assert np.array(said) - said[0] == pytest.approx(np.array(gaps) - gaps[0], abs=2e-8)
    if rises[0] != rises[1]:
        assert np.ptp(gaps) > 1e-6, "the comparison means something"
