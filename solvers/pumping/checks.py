"""Checks of the inputs of a pumping calculation."""

from math import ceil, floor, isfinite, log10, sqrt
from typing import NoReturn

from solvers.errors import InvalidInput
from solvers.pumping.gas.gas_dynamics import LEAST_SLICES
from solvers.pumping.inputs import Flow, PumpingSetup, rpm
from solvers.pumping.space.face import Stretch

LEAST_TEETH = 5  # chosen, because gears with fewer teeth are not in use
LEAST_SPEED = 1e-100  # rad/s; at lower speeds the duration of a stroke overflows
NARROW = 0.5  # share of the widest slice; if a slice is narrower, the grooves are the reason for short steps


def check_setup(setup: PumpingSetup) -> None:
    """Raise InvalidInput for inputs outside the range of the models.

    The codes are too_few_teeth, face_width, negative_backlash, isentropic_exponent, discharge_coefficient,
    too_few_slices, helix_incompressible, grooves_incompressible and slices_incompressible.
    """
    for gear, name in ((setup.gears.pinion, "pinion"), (setup.gears.wheel, "wheel")):
        if gear.teeth < LEAST_TEETH:
            raise InvalidInput("too_few_teeth", f"the {name} needs at least {LEAST_TEETH} teeth", f"{name}.teeth")
    _check_ranges(setup)
    _check_slices(setup)


def _check_ranges(setup: PumpingSetup) -> None:
    if setup.gears.face_width <= 0.0:
        raise InvalidInput("face_width", "the face width must be positive", "face_width")
    if setup.normal_backlash < 0.0 or setup.model.minimum_gap < 0.0:
        raise InvalidInput("negative_backlash", "backlash and gaps must not be negative", "normal_backlash")
    if setup.ambient.isentropic_exponent <= 1.0:
        raise InvalidInput("isentropic_exponent", "the isentropic exponent must exceed 1", "isentropic_exponent")
    if not 0.0 <= setup.model.discharge_coefficient <= 1.0:
        message = "the discharge coefficient must lie between 0 and 1"
        raise InvalidInput("discharge_coefficient", message, "discharge_coefficient")


def _check_slices(setup: PumpingSetup) -> None:
    flow, slices = setup.model.flow, setup.model.slice_count
    if flow is Flow.INCOMPRESSIBLE:
        _check_incompressible(setup)
    least = LEAST_SLICES if flow is Flow.GAS_DYNAMICS else 1
    if slices < least:
        raise InvalidInput("too_few_slices", f"the flow model needs at least {least} slices", "slices")


def _check_incompressible(setup: PumpingSetup) -> None:
    if setup.gears.helix_angle != 0.0:
        raise InvalidInput(
            "helix_incompressible",
            "the incompressible model supports only spur gears; give a helix angle of 0 or choose another flow model",
            "helix_angle",
        )
    if setup.grooves:
        raise InvalidInput(
            "grooves_incompressible",
            "the incompressible model does not support grooves; leave the grooves out or choose another flow model",
            "grooves",
        )
    if setup.model.slice_count != 1:
        raise InvalidInput(
            "slices_incompressible",
            "the incompressible model treats the tooth space as a single pocket; it cannot be combined with a pocket "
            "chain or slices",
            "slices",
        )
    if setup.model.discharge_coefficient == 0.0:
        message = (
            "with a discharge coefficient of 0, incompressible gas cannot leave a shrinking tooth space; give a "
            "coefficient above 0"
        )
        raise InvalidInput("discharge_coefficient", message, "discharge_coefficient")


def check_speed(pinion_speed: float) -> None:
    """Raise InvalidInput (speed_not_positive) at standstill."""
    if pinion_speed < LEAST_SPEED:
        message = (
            "the speed must be positive; at standstill there is no pumping power, and the pressure equals the ambient "
            "pressure"
        )
        raise InvalidInput("speed_not_positive", message, "pinion_speed")


def refuse_cost(pinion_speed: float, parts: list[Stretch], excess: float) -> NoReturn:
    """Raise InvalidInput for `excess` times the permitted steps: narrow_land between grooves, else too_many_steps."""
    narrowest, widest = min(part.width for part in parts), max(part.width for part in parts)
    if narrowest < NARROW * widest:
        land = min(part.width * part.cells for part in parts)
        message = (
            f"the grooves leave a part of the face that is only {1e3 * land:.3g} mm wide; the slices in this part are "
            "so thin that too many steps are needed. Extend the grooves over this part, or make this part at least "
            f"{1e3 * LEAST_SLICES * NARROW * widest:.3g} mm wide"
        )
        raise InvalidInput("narrow_land", message, "grooves")
    slices = sum(part.cells for part in parts)
    message = f"{slices} slices need too many steps at this speed; raise the speed, or choose the pocket chain"
    if isfinite(needed := rpm(pinion_speed) * excess):
        message = (
            f"{slices} slices need too many steps at this speed; raise the speed of the pinion to at least "
            f"{_rounded_up(needed):g} rpm, use at most {int(slices / sqrt(excess))} slices, or choose the pocket chain"
        )
    raise InvalidInput("too_many_steps", message, "pinion_speed")


def _rounded_up(value: float) -> float:
    """Round a value up and keep three significant digits."""
    unit = 10.0 ** (floor(log10(value)) - 2)
    return ceil(value / unit) * unit
