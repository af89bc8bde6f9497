"""What a load distribution has to say about its own validity."""

from math import degrees

import numpy as np

from solvers.gears.inputs import GearPairInputs
from solvers.gears.pair import full_rack_tip_radius
from solvers.notices import Notice
from solvers.scuffing.contact_lines import ContactLengths
from solvers.scuffing.inputs import Model
from solvers.scuffing.load_balance import LoadBalance
from solvers.scuffing.path_of_contact import PathOfContact, reduced_radius

LEAST_TEETH = 8
PRESSURE_ANGLES = (14.5, 30.0)  # degrees
LARGEST_HELIX = 45.0  # degrees
TRANSVERSE_HELIX = 15.0  # degrees
THIN_TIP = 0.2  # normal modules
LEAST_LENGTH_RATIO = 0.2


def geometry_notices(path: PathOfContact, lengths: ContactLengths) -> list[Notice]:
    """Undercut, thin tips, shortened path, pitch point outside it, uneven contact length, ranges of the model."""
    notices = _range_notices(path.pair.inputs)
    for gear, name in ((path.pair.pinion, "pinion"), (path.pair.wheel, "wheel")):
        if gear.undercut:
            notices.append(
                Notice(
                    "undercut",
                    f"the {name} is undercut; its involute counts from the base circle up, so contact near it is less "
                    "than computed",
                    f"{name}.profile_shift",
                )
            )
        tip = 2 * gear.tip_radius * gear.half_tooth_angle(gear.tip_radius) / path.pair.inputs.normal_module
        if tip < THIN_TIP:
            notices.append(
                Notice(
                    "thin_tip",
                    f"the {name}'s tip is {tip:.2f} modules thick; at least 0.2 is usual, 0.4 case-hardened",
                    f"{name}.addendum",
                )
            )
    notices += [
        Notice(
            "path_shortened",
            f"the mate's tip reaches the {name}'s fillet; the path of contact ends where its involute begins",
            f"{name}.dedendum",
        )
        for name in path.shortened_by
    ]
    if not path.start <= path.pitch_point <= path.end:
        notices.append(
            Notice("pitch_point_outside", "the path of contact does not hold the pitch point", "profile_shift")
        )
    if lengths.ratio < LEAST_LENGTH_RATIO:
        notices.append(
            Notice(
                "uneven_contact_length",
                f"the contact length falls to {lengths.ratio:.2f} of its maximum (below 0.2); line loads peak there",
                "face_width",
            )
        )
    return notices


def _range_notices(inputs: GearPairInputs) -> list[Notice]:
    """Rack tip and the ranges of teeth, pressure angle and helix angle the model was made for."""
    notices = []
    for teeth, name in ((inputs.pinion, "pinion"), (inputs.wheel, "wheel")):
        room = full_rack_tip_radius(teeth.dedendum, inputs.normal_pressure_angle)
        if inputs.rack_tip_radius > room:
            notices.append(
                Notice(
                    "rack_tip_radius",
                    f"the {name}'s rack has room for a tip radius of {room:.3f} modules only; that is used",
                    "rack_tip_radius",
                )
            )
        if teeth.teeth < LEAST_TEETH:
            notices.append(Notice("teeth_range", "the model is meant for 8 teeth and more", f"{name}.teeth"))
    pressure_angle, helix_angle = degrees(inputs.normal_pressure_angle), degrees(inputs.helix_angle)
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
    """What the chosen options are known to get wrong."""
    notices = []
    if model.tooth_stiffness == "parabola":
        notices.append(
            Notice(
                "calibrated_stiffness",
                "the parabola is calibrated to the load maxima of Xue, Zhang and Wang, not derived",
                "tooth_stiffness",
            )
        )
    if model.section == "transverse" and degrees(path.pair.inputs.helix_angle) > TRANSVERSE_HELIX:
        notices.append(
            Notice(
                "transverse_section",
                "teeth cut in the transverse section are too stiff above 15 degrees of helix (16 % at 20, 40 % at 30)",
                "section",
            )
        )
    return notices


def load_notices(path: PathOfContact, balance: LoadBalance) -> list[Notice]:
    """Loads that were not applied, or not everywhere, or pressed beyond the half-space; pressures without meaning."""
    notices = []
    if balance.force == 0.0:
        notices.append(
            Notice("no_load", "without torque only the kinematic transmission error is computed", "pinion_torque")
        )
    ends = reduced_radius(path.plane, np.array([0.0, path.length]))
    if np.any(ends < path.plane.least_radius):
        notices.append(
            Notice(
                "pressure_undefined",
                "the path reaches a base circle, where the reduced radius vanishes: no pressure there",
                "profile_shift",
            )
        )
    if np.any(balance.survey.held > 0.0):
        notices.append(
            Notice(
                "half_space",
                "somewhere the contact is wider than half the tooth thickness behind it; its compliance is held there",
                "pinion_torque",
            )
        )
    return notices
