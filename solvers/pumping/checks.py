"""What no calculation can be made of, and what lies outside every published check."""

from math import pi

from solvers.errors import InvalidInput
from solvers.gears.pair import GearPair
from solvers.notices import Notice
from solvers.pumping.gas_dynamics import LEAST_SLICES
from solvers.pumping.inputs import Flow, PumpingSetup
from solvers.pumping.nozzle import Gas

LEAST_TEETH = 5
FEW_TEETH = 12
TIP_SPEED_SHARE = 0.8  # of the ambient speed of sound
PITCH_LINE_SPEED = 250.0  # m/s
FEW_SLICES = 20  # in the stroke at one time
INCOMPRESSIBLE_MACH = 0.3
LEAST_GAUGE_PRESSURE = 1e-6  # of the ambient pressure


def check_setup(setup: PumpingSetup) -> list[Notice]:
    """Notices of few teeth and of a helix without slices.

    Raises InvalidInput: too_few_teeth, face_width, negative_backlash, isentropic_exponent, discharge_coefficient,
    too_few_slices, helix_incompressible, grooves_incompressible, slices_incompressible.
    """
    notices = []
    for gear, name in ((setup.gears.pinion, "pinion"), (setup.gears.wheel, "wheel")):
        if gear.teeth < LEAST_TEETH:
            raise InvalidInput("too_few_teeth", f"the {name} needs at least {LEAST_TEETH} teeth", f"{name}.teeth")
        if gear.teeth < FEW_TEETH:
            message = f"the {name} has {gear.teeth} teeth: below {FEW_TEETH} the model was never checked"
            notices.append(Notice("few_teeth", message, f"{name}.teeth"))
    _check_ranges(setup)
    return notices + _check_slices(setup)


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


def _check_slices(setup: PumpingSetup) -> list[Notice]:
    flow, slices = setup.model.flow, setup.model.slice_count
    if flow is Flow.INCOMPRESSIBLE:
        _check_incompressible(setup)
    least = LEAST_SLICES if flow is Flow.GAS_DYNAMICS else 1
    if slices < least:
        raise InvalidInput("too_few_slices", f"the flow model needs at least {least} slices", "slices")
    if slices == 1 and setup.gears.helix_angle != 0.0:
        return [Notice("single_slice", "one pocket takes no notice of the helix; 10 slices are usual", "slices")]
    return []


def _check_incompressible(setup: PumpingSetup) -> None:
    if setup.gears.helix_angle != 0.0:
        raise InvalidInput("helix_incompressible", "the incompressible model takes spur gears only", "helix_angle")
    if setup.grooves:
        raise InvalidInput("grooves_incompressible", "the incompressible model takes no grooves", "grooves")
    if setup.model.slice_count != 1:
        raise InvalidInput("slices_incompressible", "the incompressible model is a single pocket", "slices")
    if setup.model.discharge_coefficient == 0.0:
        message = "incompressible gas cannot stay in a shrinking space"
        raise InvalidInput("discharge_coefficient", message, "discharge_coefficient")


def check_resolution(flow: Flow, active_slices: float) -> list[Notice]:
    """A notice of gas dynamics with few slices in the stroke at one time."""
    if flow is not Flow.GAS_DYNAMICS or active_slices >= FEW_SLICES:
        return []
    message = (
        f"{active_slices:.0f} slices are in the stroke at one time: below {FEW_SLICES} the grid's own dissipation "
        "raises the power at low speed by tens of percent"
    )
    return [Notice("few_slices", message, "slices")]


def check_flow(flow: Flow, largest_mach: float, largest_gauge_pressure: float) -> list[Notice]:
    """Notices of flows outside what their model resolves; the pressure is a share of the ambient one."""
    if flow is Flow.INCOMPRESSIBLE and largest_mach > INCOMPRESSIBLE_MACH:
        message = f"Mach {largest_mach:.2f}: above {INCOMPRESSIBLE_MACH:g} the gas is far from incompressible"
        return [Notice("incompressible_mach", message, "flow")]
    if flow is Flow.POCKET_CHAIN and largest_gauge_pressure < LEAST_GAUGE_PRESSURE:
        message = (
            f"the pressure differs from the ambient one by less than its {LEAST_GAUGE_PRESSURE:g}th part, which the "
            "pocket chain does not resolve; power falls as the cube of the speed"
        )
        return [Notice("pressure_not_resolved", message, "pinion_speed")]
    return []


def check_speed(pair: GearPair, gas: Gas, pinion_speed: float) -> list[Notice]:
    """A notice of speeds beyond every published check. Raises InvalidInput: speed_not_positive."""
    if pinion_speed <= 0.0:
        message = "the speed must be positive; towards standstill power vanishes and pressure is ambient"
        raise InvalidInput("speed_not_positive", message, "pinion_speed")
    tip = max(pair.pinion.tip_radius, pair.wheel.tip_radius * pair.pinion.teeth / pair.wheel.teeth) * pinion_speed
    pitch_line = pair.pinion_working_radius * pinion_speed
    if tip > TIP_SPEED_SHARE * gas.sound_speed or pitch_line > PITCH_LINE_SPEED:
        message = (
            f"tip speed {tip:.0f} m/s, pitch line {pitch_line:.0f} m/s: published checks end at "
            f"{TIP_SPEED_SHARE:g} of the speed of sound and {PITCH_LINE_SPEED:g} m/s; "
            f"{PITCH_LINE_SPEED / pair.pinion_working_radius * 30 / pi:.0f} rpm is the latter"
        )
        return [Notice("high_speed", message, "pinion_speed")]
    return []
