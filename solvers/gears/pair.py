"""Transverse geometry of an involute pair: radii, thicknesses, the line of action (ISO 21771)."""

from dataclasses import dataclass
from math import acos, asin, atan, cos, hypot, pi, sin, sqrt, tan

from scipy.optimize import brentq

from solvers.errors import InvalidInput
from solvers.gears.inputs import GearPairInputs, GearTeeth


def involute(angle: float) -> float:
    """The involute function inv(angle) = tan(angle) - angle."""
    return tan(angle) - angle


def inverse_involute(value: float) -> float:
    """The angle [rad] in [0, pi/2) whose involute function is `value` >= 0."""
    return brentq(lambda angle: involute(angle) - value, 0.0, pi / 2 - 1e-9, xtol=1e-16, rtol=1e-15)


@dataclass(frozen=True, slots=True)
class Gear:
    """One gear in the transverse plane; lengths [m], angles [rad].

    `form_roll_length` is the roll length at which the involute meets the fillet of the rack; negative: undercut.
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
        """Whether the rack cuts into the involute."""
        return self.form_roll_length < 0.0

    @property
    def form_radius(self) -> float:
        """Radius where the usable involute starts [m]; the base radius if undercut."""
        return hypot(self.base_radius, max(self.form_roll_length, 0.0))

    @property
    def tip_roll_length(self) -> float:
        """Roll length at the tip [m]."""
        return sqrt(self.tip_radius**2 - self.base_radius**2)

    def half_tooth_angle(self, radius: float) -> float:
        """Half the angle a tooth takes at a radius at or above the base radius [rad]."""
        pressure_angle = acos(min(self.base_radius / radius, 1.0))
        return self.reference_half_angle + self.reference_involute - involute(pressure_angle)


@dataclass(frozen=True, slots=True)
class GearPair:
    """A meshing pair in the transverse plane; lengths [m], angles [rad].

    `line_of_action` is N1 N2, the distance of the two base tangent points.
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


def full_rack_tip_radius(dedendum: float, normal_pressure_angle: float) -> float:
    """Largest rack tip radius the rack has room for, in normal modules; negative: the rack tip is pointed."""
    room = pi / 4 - dedendum * tan(normal_pressure_angle)
    return room * cos(normal_pressure_angle) / (1.0 - sin(normal_pressure_angle))


def gear_pair(inputs: GearPairInputs, *, slack: float = 1e-9) -> GearPair:
    """Geometry of the pair.

    `slack` is how far, relatively, a centre distance may lie below the backlash-free one: rounded profile shifts put
    it there. Raises InvalidInput: pointed_rack, no_involute, pointed_tooth, flank_interference, no_mesh (tip circles
    apart), no_tip_clearance.
    """
    transverse_module = inputs.normal_module / cos(inputs.helix_angle)
    transverse_pressure_angle = atan(tan(inputs.normal_pressure_angle) / cos(inputs.helix_angle))
    pinion = _gear(inputs, inputs.pinion, "pinion")
    wheel = _gear(inputs, inputs.wheel, "wheel")
    backlash_free, centre_distance = _centre_distances(inputs, pinion, wheel, transverse_pressure_angle, slack)
    working_pressure_angle = acos((pinion.base_radius + wheel.base_radius) / centre_distance)
    _check_tips(pinion, wheel, centre_distance)
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
    """One gear cut by the rack, its tooth thickness by tan(alpha_t), not tan(alpha_n)."""
    module, helix_angle, normal_pressure_angle = inputs.normal_module, inputs.helix_angle, inputs.normal_pressure_angle
    pressure_angle = atan(tan(normal_pressure_angle) / cos(helix_angle))
    transverse_module = module / cos(helix_angle)
    reference_radius = transverse_module * teeth.teeth / 2
    base_radius = reference_radius * cos(pressure_angle)
    tip_radius = reference_radius + (teeth.profile_shift + teeth.addendum) * module
    root_radius = reference_radius + (teeth.profile_shift - teeth.dedendum) * module
    thickness = transverse_module * pi / 2 + 2 * teeth.profile_shift * module * tan(pressure_angle)
    full_radius = full_rack_tip_radius(teeth.dedendum, normal_pressure_angle)
    if full_radius < 0.0:
        raise InvalidInput(
            "pointed_rack", f"the {name}'s dedendum leaves the rack no tip; reduce it", f"{name}.dedendum"
        )
    if root_radius <= 0.0 or tip_radius <= base_radius:
        raise InvalidInput(
            "no_involute", f"the {name}'s teeth have no involute above the base circle", f"{name}.profile_shift"
        )
    rack_tip = min(inputs.rack_tip_radius, full_radius) * (1.0 - sin(normal_pressure_angle))
    straight_depth = module * (teeth.dedendum - teeth.profile_shift - rack_tip)
    gear = Gear(
        teeth=teeth.teeth,
        reference_radius=reference_radius,
        base_radius=base_radius,
        tip_radius=tip_radius,
        root_radius=root_radius,
        reference_half_angle=thickness / (2 * reference_radius),
        reference_involute=involute(pressure_angle),
        form_roll_length=reference_radius * sin(pressure_angle) - straight_depth / sin(pressure_angle),
    )
    if gear.half_tooth_angle(tip_radius) <= 0.0:
        raise InvalidInput(
            "pointed_tooth", f"the {name}'s teeth are pointed; reduce its addendum or profile shift", f"{name}.addendum"
        )
    return gear


def _centre_distances(
    inputs: GearPairInputs, pinion: Gear, wheel: Gear, pressure_angle: float, slack: float
) -> tuple[float, float]:
    """Backlash-free and actual centre distance [m]."""
    shifts = inputs.pinion.profile_shift + inputs.wheel.profile_shift
    teeth = pinion.teeth + wheel.teeth
    working_involute = involute(pressure_angle) + 2 * tan(inputs.normal_pressure_angle) * shifts / teeth
    if working_involute <= 0.0:
        raise InvalidInput("flank_interference", "the sum of profile shifts is too negative to mesh", "profile_shift")
    backlash_free = (pinion.base_radius + wheel.base_radius) / cos(inverse_involute(working_involute))
    centre_distance = backlash_free if inputs.centre_distance is None else inputs.centre_distance
    if centre_distance < backlash_free * (1 - slack):
        raise InvalidInput(
            "flank_interference",
            f"the centre distance is below the backlash-free value of {backlash_free * 1e3:.4f} mm",
            "centre_distance",
        )
    return backlash_free, centre_distance


def _check_tips(pinion: Gear, wheel: Gear, centre_distance: float) -> None:
    """Tips must reach into each other's spaces and stay clear of each other's roots."""
    if pinion.tip_radius + wheel.tip_radius <= centre_distance:
        raise InvalidInput("no_mesh", "the tip circles do not overlap; reduce the centre distance", "centre_distance")
    for tip, root, name in ((wheel, pinion, "pinion"), (pinion, wheel, "wheel")):
        clearance = centre_distance - tip.tip_radius - root.root_radius
        if clearance <= 0.0:
            raise InvalidInput(
                "no_tip_clearance",
                f"the mate's tip reaches {-clearance * 1e3:.4f} mm into the {name}'s root; enlarge the centre distance",
                f"{name}.dedendum",
            )
