"""Checks of the inputs of a gear pair. All models use the same checks."""

from solvers.errors import InvalidInput
from solvers.gears.gear import Gear, full_rack_tip_radius
from solvers.gears.inputs import GearPairInputs, GearTeeth

# Publications print rounded values of the centre distance, the profile shifts and the module (for example 25.4/3 mm).
# If a given centre distance is smaller than the backlash-free centre distance by at most this share, the backlash-free
# centre distance is used.
PRINTED = 1e-4


def check_helices(inputs: GearPairInputs) -> None:
    """Refuse double-helical gears without a helix. Raises InvalidInput `double_helical_spur`."""
    if inputs.gap_width is not None and inputs.helix_angle == 0.0:
        message = "double-helical gears need a helix; give a helix angle or leave the gap width out"
        raise InvalidInput("double_helical_spur", message, "helix_angle")


def check_rack(inputs: GearPairInputs, teeth: GearTeeth, name: str) -> None:
    """Refuse a pointed rack.

    A rack is pointed if the two flanks of a rack tooth meet before they reach the tip line. Raises InvalidInput:
    `pointed_rack`.
    """
    if full_rack_tip_radius(teeth.dedendum, inputs.normal_pressure_angle) < 0.0:
        message = f"the dedendum of the {name} is so large that the rack has no tip; reduce the dedendum"
        raise InvalidInput("pointed_rack", message, f"{name}.dedendum")


def check_teeth(gear: Gear, name: str) -> None:
    """Refuse a gear without an involute or with pointed teeth.

    Raises InvalidInput: `no_involute` or `pointed_tooth`.
    """
    if gear.root_radius <= 0.0 or gear.tip_radius <= gear.base_radius:
        message = (
            f"the teeth of the {name} have no involute above the base circle; increase the profile shift or the number "
            "of teeth"
        )
        raise InvalidInput("no_involute", message, f"{name}.profile_shift")
    if gear.tip_thickness <= 0.0:
        message = f"the teeth of the {name} are pointed; reduce the addendum or the profile shift of the {name}"
        raise InvalidInput("pointed_tooth", message, f"{name}.addendum")


def check_working_involute(value: float) -> None:
    """Refuse a value of the involute function for which there is no working pressure angle.

    Raises InvalidInput: `flank_interference`.
    """
    if value <= 0.0:
        raise InvalidInput(
            "flank_interference",
            "the sum of the profile shifts is so negative that the gears cannot mesh; increase the profile shifts",
            "profile_shift",
        )


def centre_distance_in_use(given: float | None, backlash_free: float) -> float:
    """Return the centre distance in use [m].

    This is the given centre distance, or the backlash-free centre distance if none is given. A given centre distance
    that is too small only by the rounding of printed values is raised to the backlash-free centre distance. Raises
    InvalidInput: `flank_interference` if the given centre distance is smaller than the backlash-free centre distance by
    more than the rounding of printed values.
    """
    if given is None:
        return backlash_free
    if given < backlash_free * (1.0 - PRINTED):
        message = (
            "at this centre distance the backlash would be negative; the smallest possible centre distance is "
            f"{backlash_free * 1e3:.4f} mm. Increase the centre distance or reduce the profile shifts"
        )
        raise InvalidInput("flank_interference", message, "centre_distance")
    return max(given, backlash_free)


def check_tips(pinion: Gear, wheel: Gear, centre_distance: float) -> None:
    """Refuse a pair if the tip circles do not overlap, or if the tips of a gear touch the root of the mating gear.

    Raises InvalidInput: `no_mesh` if the tip circles do not overlap; `no_tip_clearance` if a tip touches the root of
    the mating gear.
    """
    if pinion.tip_radius + wheel.tip_radius <= centre_distance:
        raise InvalidInput("no_mesh", "the tip circles do not overlap; reduce the centre distance", "centre_distance")
    for tip, root, name in ((wheel, pinion, "pinion"), (pinion, wheel, "wheel")):
        clearance = centre_distance - tip.tip_radius - root.root_radius
        if clearance <= 0.0:
            raise InvalidInput(
                "no_tip_clearance",
                f"the tip of the mating gear reaches {-clearance * 1e3:.4f} mm into the root of the {name}; increase "
                f"the centre distance or the dedendum of the {name}",
                f"{name}.dedendum",
            )


def check_usable_flank(gear: Gear, name: str) -> None:
    """Refuse a gear whose root fillet reaches the tooth tip. Raises InvalidInput: `form_diameter`."""
    if gear.usable_roll_length >= gear.tip_roll_length:
        message = f"the fillet of the {name} reaches the tip, so that no involute is left; increase the profile shift"
        raise InvalidInput("form_diameter", message, f"{name}.profile_shift")


def check_path(tip_start: float, tip_end: float, start: float, end: float) -> None:
    """Refuse a pair if the path of contact has no length.

    All arguments are roll lengths of the pinion [m]. If only the tips limit the path, the path extends from `tip_start`
    to `tip_end`. If tips and root fillets limit the path, the path extends from `start` to `end`. Raises InvalidInput:
    `no_contact` if the path between the tips has no length; `involute_interference` if only the path between tips and
    fillets has no length.
    """
    if tip_end <= tip_start:
        raise InvalidInput(
            "no_contact",
            "the tips of the teeth do not reach the line of action; reduce the centre distance",
            "centre_distance",
        )
    if end <= start:
        message = (
            "the tips of the teeth meet only fillets, so that no path of contact is left; change the profile shifts"
        )
        raise InvalidInput("involute_interference", message, "profile_shift")
