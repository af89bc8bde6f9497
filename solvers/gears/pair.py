"""Transverse geometry of an involute pair: centre distance, working pressure angle, line of action (ISO 21771)."""

from dataclasses import dataclass
from math import acos, asin, atan, cos, pi, sin, tan

from scipy.optimize import brentq

from solvers.gears.checks import (
    centre_distance_in_use,
    check_rack,
    check_teeth,
    check_tips,
    check_working_involute,
)
from solvers.gears.gear import Gear, involute, transverse_gear
from solvers.gears.inputs import GearPairInputs, GearTeeth


def inverse_involute(value: float) -> float:
    """The angle [rad] in [0, pi/2) whose involute function is `value` >= 0."""
    return brentq(lambda angle: involute(angle) - value, 0.0, pi / 2 - 1e-9, xtol=1e-16, rtol=1e-15)


@dataclass(frozen=True, slots=True)
class GearPair:
    """A meshing pair in the transverse plane; lengths [m], angles [rad].

    `centre_distance` is the one in use; `line_of_action` is N1 N2, the distance of the two base tangent points.
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
    """Geometry of the pair.

    Raises InvalidInput: pointed_rack, no_involute, pointed_tooth, flank_interference, no_mesh, no_tip_clearance.
    """
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
        base_helix_angle=asin(sin(inputs.helix_angle) * cos(inputs.normal_pressure_angle)),
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
    """Centre distance [m] by inv alpha_wt = inv alpha_t + 2 (x1 + x2) tan alpha_n / (z1 + z2)."""
    shifts = inputs.pinion.profile_shift + inputs.wheel.profile_shift
    teeth = pinion.teeth + wheel.teeth
    working_involute = involute(transverse_pressure_angle) + 2 * tan(inputs.normal_pressure_angle) * shifts / teeth
    check_working_involute(working_involute)
    return (pinion.base_radius + wheel.base_radius) / cos(inverse_involute(working_involute))
