"""Warnings about a gear pair and its load. All models give the same warnings."""

from collections.abc import Iterator
from math import cos

from solvers.gears.gear import Gear, rack_tip_radius
from solvers.gears.inputs import GearPairInputs
from solvers.gears.pair import PathOfContact
from solvers.lubricants import hotter_than_gears
from solvers.notices import Notice, unusual_value

THIN_TIP = 0.2  # least usual tip thickness, in normal modules
# The following limits are chosen. A value beyond a limit is unusual.
WIDEST_FACE = 3.0  # face width in pitch diameters of the pinion
NARROWEST_FACE = 0.5  # face width in modules
FASTEST = 250.0  # pitch-line velocity [m/s]
HIGHEST_ROOT_LOAD = 400e6  # F_t/(b m_n) [Pa]; the root stress is about four times F_t/(b m_n), so a steel tooth breaks
LEAST_LOAD = 1e3  # line load [N/m]


def pair_notices(path: PathOfContact) -> list[Notice]:
    """Return the warnings about the shape of the teeth and about the path of contact.

    The subjects are a limited tip radius of the rack, undercut, thin tooth tips, and a path that a fillet shortens.
    """
    inputs, notices = path.pair.inputs, []
    for gear, teeth, name in (
        (path.pair.pinion, inputs.pinion, "pinion"),
        (path.pair.wheel, inputs.wheel, "wheel"),
    ):
        used = rack_tip_radius(inputs, teeth)
        if used < inputs.rack_tip_radius:
            message = (
                f"the rack of the {name} has room for a tip radius of only {used:.3f} modules; this radius is used"
            )
            notices.append(Notice("rack_tip_radius", message, "rack_tip_radius", rank="note"))
        notices += _tooth_notices(gear, inputs.normal_module, name)
    notices += [
        Notice(
            "path_shortened",
            f"the tip of the mating gear reaches below the usable involute of the {name}; the path of contact is cut "
            "off at the lower end of this involute",
            f"{name}.dedendum",
            rank="note",
        )
        for name in path.shortened_by
    ]
    return notices


def _tooth_notices(gear: Gear, module: float, name: str) -> list[Notice]:
    notices = []
    if gear.undercut:
        message = (
            f"the {name} is undercut, but its involute is computed down to the base circle; the real contact near the "
            "base circle is smaller than computed"
        )
        notices.append(Notice("undercut", message, f"{name}.profile_shift"))
    if gear.tip_thickness < THIN_TIP * module:
        message = (
            f"the tips of the {name} are {gear.tip_thickness / module:.2f} modules thick; at least {THIN_TIP:g} "
            "modules are usual, and 0.4 modules for case-hardened teeth"
        )
        notices.append(Notice("thin_tip", message, f"{name}.addendum"))
    return notices


def unusual_gears(pair: GearPairInputs, pinion_speed: float | None = None) -> Iterator[Notice]:
    """Warn of an unusual face width. If `pinion_speed` [rad/s] is given, also warn of a high pitch-line velocity."""
    diameter, width = pitch_diameter(pair), pair.face_width
    if width > WIDEST_FACE * diameter:
        message = (
            f"the face width of {width * 1e3:g} mm exceeds {WIDEST_FACE:g} pitch diameters of the pinion; was a value "
            "entered in the wrong unit (cm)?"
        )
        yield unusual_value("gears.face_width", message)
    if width < NARROWEST_FACE * pair.module:
        yield unusual_value(
            "gears.face_width",
            f"the face width of {width * 1e3:g} mm is less than half a module; was a value entered in the wrong unit "
            "(cm or inches)?",
        )
    if pinion_speed is not None and (velocity := pinion_speed * diameter / 2) > FASTEST:
        message = f"the pitch-line velocity of {velocity:.4g} m/s exceeds {FASTEST:g} m/s"
        message += "; was the speed of another shaft entered?"
        yield unusual_value("pinion_speed", message)


def tooth_load(pair: GearPairInputs, torque: float, line_load: float) -> Iterator[Notice]:
    """Warn if the torque of the pinion [N m] is too high, or if the largest line load [N/m] is too low."""
    root = 2 * torque / pitch_diameter(pair) / (pair.face_width * pair.module)
    if root > HIGHEST_ROOT_LOAD:
        message = f"a tooth force of {root / 1e6:.4g} N per mm of face width and per mm of module breaks a steel tooth"
        message += "; was a value entered in the wrong unit (W or N mm)?"
        yield unusual_value("pinion_torque", message)
    if 0.0 < line_load < LEAST_LOAD:
        message = (
            f"the largest line load is only {line_load / 1e3:.3g} N/mm, which is implausible; was a value entered in "
            "the wrong unit (kW or kN m)?"
        )
        yield unusual_value("pinion_torque", message)


def tooth_temperature(temperature: float | None, field: str = "temperatures.bulk") -> Iterator[Notice]:
    """Warn if the temperature of the teeth [K] is higher than the temperatures of gears in service."""
    if temperature is not None:
        yield from hotter_than_gears(temperature, field)


def pitch_diameter(pair: GearPairInputs) -> float:
    """Return the reference diameter of the pinion [m]."""
    transverse = 1.0 if pair.module_plane == "transverse" else cos(pair.helix_angle)
    return pair.module / transverse * pair.pinion.teeth
