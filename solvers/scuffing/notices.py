"""Warnings of a load distribution and of a scuffing check."""

from collections.abc import Iterator
from math import degrees

import numpy as np

from solvers.contact.notices import high_pressure
from solvers.gears.inputs import GearPairInputs
from solvers.gears.notices import pair_notices, tooth_load, tooth_temperature, unusual_gears
from solvers.gears.pair import PathOfContact
from solvers.lubricants import hot_oil, oil_temperature, thick_oil
from solvers.notices import Notice, unusual_value
from solvers.quantity import quantities
from solvers.scuffing.contact_lines import ContactLengths
from solvers.scuffing.contact_slices import reaches_base_circle
from solvers.scuffing.inputs import LoadDistributionInputs, Model, Modifications, ScuffingInputs, Temperatures
from solvers.scuffing.load_balance import LoadBalance
from solvers.scuffing.results import LoadDistribution
from solvers.scuffing.safety_results import Scuffing

LEAST_TEETH = 8  # chosen: gears with fewer teeth are not in use
PRESSURE_ANGLES = (14.5, 30.0)  # degrees
LARGEST_HELIX = 45.0  # degrees
TRANSVERSE_HELIX = 15.0  # degrees
LEAST_MODIFICATION = 0.5e-6  # m, chosen; smaller modifications cannot be ground
LEAST_LENGTH_RATIO = 0.2  # chosen: at lower ratios the total length of the lines nearly vanishes once per base pitch


def geometry_notices(path: PathOfContact, lengths: ContactLengths) -> list[Notice]:
    """Return warnings about the geometry of the pair.

    These warnings concern values outside the ranges of the model, a pitch point outside the path of contact, and an
    uneven contact length.
    """
    notices = [*pair_notices(path), *_range_notices(path.pair.inputs)]
    if not path.start <= path.pitch_point <= path.end:
        notices.append(
            Notice(
                "pitch_point_outside", "the pitch point is outside the path of contact", "profile_shift", rank="note"
            )
        )
    if lengths.ratio < LEAST_LENGTH_RATIO:
        notices.append(
            Notice(
                "uneven_contact_length",
                f"the least total length of contact lines is only {lengths.ratio:.2f} times the largest, and should "
                "be at least 0.2 times; the line loads are highest where the total length is least",
                "face_width",
            )
        )
    return notices


def _range_notices(inputs: GearPairInputs) -> list[Notice]:
    """Return warnings about numbers of teeth, pressure angle and helix angle beyond the ranges of the model."""
    notices = []
    for teeth, name in ((inputs.pinion, "pinion"), (inputs.wheel, "wheel")):
        if teeth.teeth < LEAST_TEETH:
            notices.append(Notice("teeth_range", "the model is meant for gears with at least 8 teeth", f"{name}.teeth"))
    pressure_angle, helix_angle = degrees(inputs.normal_pressure_angle), degrees(abs(inputs.helix_angle))
    if not PRESSURE_ANGLES[0] - 1e-9 <= pressure_angle <= PRESSURE_ANGLES[1] + 1e-9:
        notices.append(
            Notice(
                "pressure_angle_range",
                "the model is meant for normal pressure angles of 14.5 to 30 degrees",
                "pressure_angle",
            )
        )
    if helix_angle > LARGEST_HELIX + 1e-9:
        notices.append(
            Notice("helix_angle_range", "the model is meant for helix angles up to 45 degrees", "helix_angle")
        )
    return notices


def model_notices(path: PathOfContact, model: Model) -> list[Notice]:
    """Return warnings about known errors of the selected options."""
    notices = []
    if model.tooth_stiffness == "parabola":
        notices.append(
            Notice(
                "calibrated_stiffness",
                "the parabolic tooth stiffness is not derived; it is fitted to the maximum loads of Xue and others",
                "tooth_stiffness",
                rank="note",
            )
        )
    if model.section == "transverse" and degrees(abs(path.pair.inputs.helix_angle)) > TRANSVERSE_HELIX:
        notices.append(
            Notice(
                "transverse_section",
                "above a helix angle of 15 degrees, the tooth model in the transverse section overestimates the "
                "stiffness (by 16 % at 20 degrees, by 40 % at 30 degrees)",
                "section",
            )
        )
    return notices


def relief_notices(path: PathOfContact, modifications: Modifications) -> list[Notice]:
    """Return warnings about reliefs that are longer than the path or the face."""
    m, face_width = modifications, path.plane.face_width
    reliefs = (
        ("tip_relief", m.tip_relief, m.tip_relief_length, path.length, "path of contact"),
        ("root_relief", m.root_relief, m.root_relief_length, path.length, "path of contact"),
        ("end_relief", m.end_relief, m.end_relief_length, face_width, "face"),
    )
    return [
        Notice(
            "unusual_value",
            f"the relief is {length * 1e3:.4g} mm long, but the {place} is only {whole * 1e3:.4g} mm long; was a "
            "radius entered instead of a length?",
            f"{name}_length",
        )
        for name, amplitude, length, whole, place in reliefs
        if amplitude != 0.0 and length is not None and length > whole
    ]


def load_notices(balance: LoadBalance) -> list[Notice]:
    """Return the warnings about the load, the width of the contact and the loaded path.

    There is a warning for each of these conditions:

    - There is no load.
    - The load is so small that the interpolation of loads between the roll positions is inaccurate.
    - The loaded path reaches a base circle, where the pressure grows without bound.
    - The contact is too wide for the compliance law.
    """
    notices = []
    if balance.force == 0.0:
        message = "no torque presses the flanks together; only the kinematic transmission error is computed"
        notices.append(Notice("no_load", message, "pinion_torque", rank="note"))
    if balance.bent_steps:
        message = (
            f"the contact is so light that loads are interpolated only roughly in {balance.bent_steps} intervals "
            "between roll positions; curves over the flank and the face load factor may be wrong by several percent"
        )
        notices.append(Notice("light_contact", message, "pinion_torque"))
    if reaches_base_circle(balance.survey):
        message = (
            "the loaded path of contact reaches a base circle, where the reduced radius vanishes; pressure and flash "
            "temperature have no maximum there, and no safety is stated"
        )
        notices.append(Notice("path_reaches_base_circle", message, "profile_shift", rank="invalid"))
    if np.any(balance.survey.held > 0.0):
        notices.append(
            Notice(
                "half_space",
                "at some points the contact is wider than half the thickness of the tooth at these points. The contact "
                "model does not hold there, and the compliance is that of a contact as wide as half the thickness",
                "pinion_torque",
            )
        )
    return notices


def unusual_load_values(inputs: LoadDistributionInputs, result: LoadDistribution) -> Iterator[Notice]:
    """Warn of unusual values of gears, modifications and load."""
    yield from unusual_gears(inputs.gears, inputs.load.pinion_speed)
    yield from unusual_modifications(inputs.modifications)
    yield from high_pressure(result.pressure.max)
    yield from tooth_load(
        inputs.gears, (result.helix.share if result.helix else 1.0) * inputs.load.torque, result.load.max_line_load
    )


def unusual_modifications(modifications: Modifications) -> Iterator[Notice]:
    """Warn of modifications that are too small to be made by grinding."""
    depths = {
        name: getattr(modifications, name)
        for name, declared in quantities(Modifications).items()
        if declared.unit == "um"
    }
    if (second := modifications.second_helix) is not None:
        depths |= {f"second_helix.{name}": getattr(second, name) for name in ("helix_slope", "lead_crowning")}
    for name, value in depths.items():
        if value is not None and 0.0 < abs(value) < LEAST_MODIFICATION:
            message = (
                f"a modification of {value * 1e6:g} µm is too small to be ground; was a value entered in the wrong "
                "unit (mm)?"
            )
            yield unusual_value(f"modifications.{name}", message)
    highest = max(map(abs, modifications.lead_curve.gap), default=0.0)
    if 0.0 < highest < LEAST_MODIFICATION:
        message = (
            f"a lead curve whose largest gap is {highest * 1e6:g} µm is too small to be ground; was a value entered in "
            "the wrong unit (mm)?"
        )
        yield unusual_value("modifications.lead_curve.gap", message)


def unusual_temperatures(temperatures: Temperatures) -> Iterator[Notice]:
    """Warn if the oil temperature or a given bulk temperature is unusual for gears in service."""
    yield from oil_temperature(temperatures.oil)
    if temperatures.bulk_method == "given":
        yield from tooth_temperature(temperatures.bulk)


def unusual_scuffing_values(inputs: ScuffingInputs, result: Scuffing) -> Iterator[Notice]:
    """Warn of unusual values of oil, temperatures, gears, modifications and load."""
    oil, hottest = result.derived.oil, result.contact_temperature
    yield from thick_oil(oil.viscosity if oil else None)
    if inputs.known_oil is not None:
        yield from unusual_temperatures(inputs.temperatures)
        yield from hot_oil(inputs.temperatures.oil, hottest.bulk if hottest else None)
    yield from unusual_load_values(inputs.distribution, result.distribution)
