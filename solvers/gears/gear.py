"""One gear in the transverse plane, cut by the rack of its pair: radii, thicknesses, the ends of its involute."""

from dataclasses import dataclass
from math import acos, atan, cos, hypot, pi, sin, sqrt, tan

from solvers.gears.inputs import GearPairInputs, GearTeeth


def involute(angle: float) -> float:
    """The involute function inv(angle) = tan(angle) - angle."""
    return tan(angle) - angle


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
    def usable_roll_length(self) -> float:
        """Roll length where the usable involute starts [m]; 0, the base circle, if undercut."""
        return max(self.form_roll_length, 0.0)

    @property
    def form_radius(self) -> float:
        """Radius where the usable involute starts [m]; the base radius if undercut."""
        return hypot(self.base_radius, self.usable_roll_length)

    @property
    def tip_roll_length(self) -> float:
        """Roll length at the tip [m]."""
        return sqrt(self.tip_radius**2 - self.base_radius**2)

    @property
    def tip_thickness(self) -> float:
        """Thickness of a tooth on the tip circle [m]; negative: pointed below it."""
        return 2 * self.tip_radius * self.half_tooth_angle(self.tip_radius)

    def half_tooth_angle(self, radius: float) -> float:
        """Half the angle a tooth takes at a radius at or above the base radius [rad]."""
        pressure_angle = acos(min(self.base_radius / radius, 1.0))
        return self.reference_half_angle + self.reference_involute - involute(pressure_angle)


def full_rack_tip_radius(dedendum: float, normal_pressure_angle: float) -> float:
    """Largest rack tip radius the rack has room for, in normal modules; negative: the rack tip is pointed."""
    room = pi / 4 - dedendum * tan(normal_pressure_angle)
    return room * cos(normal_pressure_angle) / (1.0 - sin(normal_pressure_angle))


def rack_tip_radius(inputs: GearPairInputs, teeth: GearTeeth) -> float:
    """Rack tip radius that cuts a gear of the pair, in normal modules: the one given, as far as its rack has room."""
    return min(inputs.rack_tip_radius, full_rack_tip_radius(teeth.dedendum, inputs.normal_pressure_angle))


def transverse_gear(inputs: GearPairInputs, teeth: GearTeeth) -> Gear:
    """One gear of the pair."""
    pressure_angle = atan(tan(inputs.normal_pressure_angle) / cos(inputs.helix_angle))
    return _cut(inputs, teeth, teeth.teeth, inputs.normal_module / cos(inputs.helix_angle), pressure_angle)


def virtual_gear(inputs: GearPairInputs, teeth: GearTeeth, base_helix_angle: float) -> Gear:
    """The virtual spur gear of the normal section, of z / (cos^2 beta_b cos beta) teeth, cut by the same rack."""
    virtual_teeth = teeth.teeth / (cos(base_helix_angle) ** 2 * cos(inputs.helix_angle))
    return _cut(inputs, teeth, virtual_teeth, inputs.normal_module, inputs.normal_pressure_angle)


def _cut(inputs: GearPairInputs, teeth: GearTeeth, count: float, module: float, pressure_angle: float) -> Gear:
    """A gear of `count` teeth in a plane of this module [m] and pressure angle [rad].

    Heights count normal modules, the thickness of a shifted tooth goes by the tangent of the plane's pressure angle.
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
        tip_radius=radius + (teeth.profile_shift + teeth.addendum) * height,
        root_radius=radius + (teeth.profile_shift - teeth.dedendum) * height,
        reference_half_angle=thickness / (2 * radius),
        reference_involute=involute(pressure_angle),
        form_roll_length=radius * sin(pressure_angle) - straight_depth / sin(pressure_angle),
    )
