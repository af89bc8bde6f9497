"""Warnings of a pumping calculation: too coarse, unresolved, or outside the range in which the models were compared."""

from collections.abc import Iterator, Sequence
from math import degrees, expm1, inf, pi

from solvers.gears.notices import pair_notices, unusual_gears
from solvers.gears.pair import GearPair, PathOfContact
from solvers.notices import Notice, unusual_value
from solvers.pumping.flow.nozzle import Gas
from solvers.pumping.inputs import ChokingInputs, Flow, PumpingInputs, PumpingSetup
from solvers.pumping.results import MassFlow, Resolution
from solvers.pumping.space.stroke import StrokeTable

FEW_TEETH = 12  # chosen: the paper and the comparisons with it have more
TIP_SPEED_SHARE = 0.8  # of the ambient speed of sound
PITCH_LINE_SPEED = 250.0  # m/s
FEW_SLICES = 20  # in the stroke at one time
INCOMPRESSIBLE_MACH = 0.3  # usual limit: density changes by 5 %
RESOLVED = 0.06  # of a number, by its resolution
NET_UNCERTAINTY = 0.3  # of the net flow
NEGLIGIBLE = 1e-3  # of the gross flow
LEAST_GAUGE_PRESSURE = 1e-6  # of the ambient pressure
THIN_AIR = 20e3  # Pa, chosen; nearly a vacuum


def setup_notices(setup: PumpingSetup, path: PathOfContact, active_slices: float) -> list[Notice]:
    """What is said of the pair, few teeth, no seal between two pairs of teeth, too few slices.

    `active_slices` are in the stroke at one time.
    """
    notices = pair_notices(path)
    ratio = path.transverse_contact_ratio
    if ratio < 1.0:
        message = f"the transverse contact ratio is {ratio:.3f}: below 1 nothing seals the space between two pairs"
        notices.append(Notice("contact_ratio_below_one", message, "addendum", rank="invalid"))
    for gear, name in ((setup.gears.pinion, "pinion"), (setup.gears.wheel, "wheel")):
        if gear.teeth < FEW_TEETH:
            message = f"the {name} has {gear.teeth} teeth: below {FEW_TEETH} the model was never checked"
            notices.append(Notice("few_teeth", message, f"{name}.teeth"))
    if setup.model.slice_count == 1 and setup.gears.helix_angle != 0.0:
        message = "one pocket takes no notice of the helix; 10 slices are usual"
        notices.append(Notice("single_slice", message, "slices"))
    if setup.model.flow is Flow.GAS_DYNAMICS and active_slices < FEW_SLICES:
        message = (
            f"{active_slices:.0f} slices are in the stroke at one time: below {FEW_SLICES} the grid's own dissipation "
            "raises the power at low speed by tens of percent"
        )
        notices.append(Notice("few_slices", message, "slices"))
    return notices


def jump_notices(tables: Sequence[StrokeTable]) -> list[Notice]:
    """Strokes in which the area of a space jumps: what compresses or relieves the gas there is no motion of teeth."""
    share, angle = max(table.jump for table in tables)
    if share == 0.0:
        return []
    message = (
        f"the area of a tooth space jumps by {100 * expm1(share):.0f} % at {degrees(angle):.2f} deg, where the nearest "
        "point to a tip corner leaves the flank for the root: pressures are wrong from there on; the contact gap knows "
        "no such jump"
    )
    return [Notice("area_jump", message, "gap", rank="invalid")]


def flow_notices(flow: Flow, largest_mach: float, largest_gauge_pressure: float) -> list[Notice]:
    """Flows outside what their model resolves; the pressure is a share of the ambient one."""
    if flow is Flow.INCOMPRESSIBLE and largest_mach > INCOMPRESSIBLE_MACH:
        message = f"Mach {largest_mach:.2f}: above {INCOMPRESSIBLE_MACH:g} the gas is far from incompressible"
        return [Notice("incompressible_mach", message, "flow", rank="invalid")]
    if flow is Flow.POCKET_CHAIN and largest_gauge_pressure < LEAST_GAUGE_PRESSURE:
        message = (
            f"the pressure differs from the ambient one by less than its {LEAST_GAUGE_PRESSURE:g}th part, which the "
            "pocket chain does not resolve; power falls as the cube of the speed"
        )
        return [Notice("pressure_not_resolved", message, "pinion_speed")]
    return []


def net_flow_notices(model: Flow, flows: list[MassFlow]) -> list[Notice]:
    """Net flows out of the ends that are small differences of what leaves and what enters."""
    shares = [
        (flow.net_uncertainty / abs(net) if net else inf, net, flow)
        for flow in flows
        for net in (flow.front, flow.rear)
        if flow.net_uncertainty > NEGLIGIBLE * (flow.front_out + flow.rear_out)
    ]
    share, net, flow = max(shares, key=lambda entry: entry[0], default=(0.0, 0.0, None))
    if flow is None or share <= NET_UNCERTAINTY:
        return []
    message = (
        f"a net flow of {1e3 * net:.3g} g/s out of an end, a small difference of what leaves and what enters, is "
        f"uncertain by {1e3 * flow.net_uncertainty:.2g} g/s"
    )
    if model is Flow.GAS_DYNAMICS:
        message += "; use more slices"
    return [Notice("net_flow_uncertain", message, "slices")]


def resolution_notices(flow: Flow, uncertain: Resolution) -> list[Notice]:
    """Numbers that the slices of gas dynamics leave uncertain."""
    found = ", ".join(
        f"{name} by {100 * share:.2g} %"
        for name, share in (
            ("peak pressure", uncertain.peak_pressure),
            ("lowest pressure", uncertain.min_pressure),
            ("Mach number", uncertain.axial_mach),
            ("power", uncertain.pumping_power),
            ("temperature rise", uncertain.temperature_rise),
            ("flow through the ends", uncertain.gross_flow),
        )
        if share is not None and share > RESOLVED
    )
    if flow is not Flow.GAS_DYNAMICS or not found:
        return []
    return [Notice("not_resolved", f"with these slices the results are uncertain: {found}; use more slices", "slices")]


def speed_notices(pair: GearPair, gas: Gas, pinion_speed: float) -> list[Notice]:
    """Speeds beyond every published check."""
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


def unusual_values(inputs: PumpingInputs | ChokingInputs, _result: object) -> Iterator[Notice]:
    """Unusual values of ambient, gears and speed."""
    yield from thin_air(inputs.setup.ambient.pressure)
    speed = inputs.pinion_speed if isinstance(inputs, PumpingInputs) else None
    yield from unusual_gears(inputs.setup.gears, speed)


def thin_air(pressure: float) -> Iterator[Notice]:
    """An ambient pressure [Pa] that is nearly none."""
    if pressure < THIN_AIR:
        yield unusual_value("ambient.pressure", f"{pressure / 1e3:g} kPa is nearly a vacuum; was bar meant?")
