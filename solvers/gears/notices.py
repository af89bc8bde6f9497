"""Warnings about a gear pair that meshes; they are the same in every model."""

from solvers.gears.gear import Gear, rack_tip_radius
from solvers.gears.pair import PathOfContact
from solvers.notices import Notice

THIN_TIP = 0.2  # normal modules


def pair_notices(path: PathOfContact) -> list[Notice]:
    """Return the warnings about limited rack tip radii, undercut, thin tips and a path shortened by fillets."""
    inputs, notices = path.pair.inputs, []
    for gear, teeth, name in (
        (path.pair.pinion, inputs.pinion, "pinion"),
        (path.pair.wheel, inputs.wheel, "wheel"),
    ):
        used = rack_tip_radius(inputs, teeth)
        if used < inputs.rack_tip_radius:
            message = f"the {name}'s rack has room for a tip radius of {used:.3f} modules only; this radius is used"
            notices.append(Notice("rack_tip_radius", message, "rack_tip_radius", rank="note"))
        notices += _tooth_notices(gear, inputs.normal_module, name)
    notices += [
        Notice(
            "path_shortened",
            f"the tip of the mate reaches below the usable involute of the {name}; the path of contact starts at "
            "this involute",
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
            f"the {name} is undercut; its involute is computed from the base circle up, so that near the base circle "
            "there is less contact than computed"
        )
        notices.append(Notice("undercut", message, f"{name}.profile_shift"))
    if gear.tip_thickness < THIN_TIP * module:
        message = (
            f"the {name}'s tip is {gear.tip_thickness / module:.2f} modules thick; at least {THIN_TIP:g} is usual, 0.4 "
            "case-hardened"
        )
        notices.append(Notice("thin_tip", message, f"{name}.addendum"))
    return notices
