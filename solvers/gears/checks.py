"""Checks of the inputs of a gear pair, the same in every model."""

from solvers.errors import InvalidInput
from solvers.gears.gear import Gear, full_rack_tip_radius
from solvers.gears.inputs import GearPairInputs, GearTeeth

# Published pairs print centre distances, profile shifts and modules such as 25.4/3 mm rounded: that much of the
# centre distance may be missing, and is taken as backlash-free.
PRINTED = 1e-4


def check_rack(inputs: GearPairInputs, teeth: GearTeeth, name: str) -> None:
    """Raises InvalidInput pointed_rack where the rack's flanks meet above its tip line."""
    if full_rack_tip_radius(teeth.dedendum, inputs.normal_pressure_angle) < 0.0:
        message = f"the {name}'s dedendum leaves the rack no tip; reduce it"
        raise InvalidInput("pointed_rack", message, f"{name}.dedendum")


def check_teeth(gear: Gear, name: str) -> None:
    """Raises InvalidInput: no_involute, pointed_tooth."""
    if gear.root_radius <= 0.0 or gear.tip_radius <= gear.base_radius:
        message = f"the {name}'s teeth have no involute above the base circle"
        raise InvalidInput("no_involute", message, f"{name}.profile_shift")
    if gear.tip_thickness <= 0.0:
        message = f"the {name}'s teeth are pointed; reduce its addendum or profile shift"
        raise InvalidInput("pointed_tooth", message, f"{name}.addendum")


def check_working_involute(value: float) -> None:
    """Raises InvalidInput flank_interference where no working pressure angle has the involute function `value`."""
    if value <= 0.0:
        raise InvalidInput("flank_interference", "the sum of profile shifts is too negative to mesh", "profile_shift")


def centre_distance_in_use(given: float | None, backlash_free: float) -> float:
    """The centre distance [m]: the one given, but the backlash-free one for a rounding of it.

    Raises InvalidInput flank_interference where the given one is smaller than that.
    """
    if given is None:
        return backlash_free
    if given < backlash_free * (1.0 - PRINTED):
        message = f"the centre distance is below the backlash-free value of {backlash_free * 1e3:.4f} mm"
        raise InvalidInput("flank_interference", message, "centre_distance")
    return max(given, backlash_free)


def check_tips(pinion: Gear, wheel: Gear, centre_distance: float) -> None:
    """Tips must reach into each other's spaces and stay clear of each other's roots.

    Raises InvalidInput: no_mesh (tip circles apart), no_tip_clearance.
    """
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


def check_usable_flank(gear: Gear, name: str) -> None:
    """Raises InvalidInput form_diameter where the fillet reaches the gear's own tip."""
    if gear.usable_roll_length >= gear.tip_roll_length:
        message = f"the {name}'s fillet reaches its tip; no involute is left"
        raise InvalidInput("form_diameter", message, f"{name}.profile_shift")


def check_path(tip_start: float, tip_end: float, start: float, end: float) -> None:
    """Some of the line of action must lie between the tips, and between the fillets; roll lengths of the pinion [m].

    Raises InvalidInput: no_contact, involute_interference.
    """
    if tip_end <= tip_start:
        raise InvalidInput("no_contact", "the tips do not reach the line of action", "centre_distance")
    if end <= start:
        message = "the tips meet fillets only; no path of contact is left"
        raise InvalidInput("involute_interference", message, "profile_shift")
