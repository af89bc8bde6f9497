"""Warnings of a pumping calculation: coarse grids, unresolved flows, and unusual or untested inputs.

Untested inputs lie outside the range in which the model has been compared with published results.
"""

from collections.abc import Iterator, Sequence
from math import degrees, expm1, inf, pi

from solvers.gears.inputs import GearPairInputs
from solvers.gears.notices import pair_notices, unusual_gears
from solvers.gears.pair import GearPair, PathOfContact
from solvers.notices import Notice, unusual_value
from solvers.pumping.flow.nozzle import Gas
from solvers.pumping.inputs import ChokingInputs, Flow, PumpingInputs, PumpingSetup
from solvers.pumping.results import MassFlow, Resolution
from solvers.pumping.space.stroke import StrokeTable

FEW_TEETH = 12  # chosen: the gears of the paper and of all comparisons have more teeth
TIP_SPEED_SHARE = 0.8  # share of the ambient speed of sound; published checks end at this tip speed
PITCH_LINE_SPEED = 250.0  # m/s; published checks end at this speed
FEW_SLICES = 20  # if fewer slices are in their stroke at the same time, there is a warning
INCOMPRESSIBLE_MACH = 0.3  # usual limit, at which the density changes by 5 %
RESOLVED = 0.06  # largest relative uncertainty of a result without a warning
NET_UNCERTAINTY = 0.3  # largest uncertainty of a net flow without a warning, relative to the net flow
NEGLIGIBLE = 1e-3  # share of the gross flow; a smaller uncertainty of the net flow is not worth a warning
LEAST_GAUGE_PRESSURE = 1e-6  # share of the ambient pressure; the pocket chain does not resolve smaller values
NARROW = 3.0  # chosen: normal modules; through a gap of 1.6 to 3 modules the gas of both helices escapes
THIN_AIR = 20e3  # Pa, chosen; nearly a vacuum


def narrow_gap(gears: GearPairInputs) -> Iterator[Notice]:
    """Warn if the gas may not escape through the gap of double-helical gears."""
    if gears.gap_width is not None and gears.gap_width < NARROW * gears.normal_module:
        message = (
            f"the gap between the helices is narrower than {NARROW:.0f} modules: the gas that both helices pump may "
            "not escape there, and both are hotter than computed"
        )
        yield Notice("narrow_gap", message, "gears.gap_width")


def setup_notices(setup: PumpingSetup, path: PathOfContact, active_slices: float) -> list[Notice]:
    """Return the warnings about the gear pair, a small contact ratio, a small number of teeth and too few slices.

    `active_slices` is the number of slices that are in their stroke at the same time.
    """
    notices = [*pair_notices(path), *narrow_gap(setup.gears)]
    ratio = path.transverse_contact_ratio
    if ratio < 1.0:
        message = (
            f"the transverse contact ratio of {ratio:.3f} is below 1; at some angles no flanks are in contact, so "
            "that nothing seals the tooth spaces"
        )
        notices.append(Notice("contact_ratio_below_one", message, "addendum", rank="invalid"))
    for gear, name in ((setup.gears.pinion, "pinion"), (setup.gears.wheel, "wheel")):
        if gear.teeth < FEW_TEETH:
            message = (
                f"the {name} has {gear.teeth} teeth; the model has never been checked with fewer than {FEW_TEETH} teeth"
            )
            notices.append(Notice("few_teeth", message, f"{name}.teeth"))
    if setup.model.slice_count == 1 and setup.gears.helix_angle != 0.0:
        message = "a single slice ignores the helix angle; 10 slices are usual"
        notices.append(Notice("single_slice", message, "slices"))
    if setup.model.flow is Flow.GAS_DYNAMICS and active_slices < FEW_SLICES:
        message = (
            f"only {active_slices:.0f} slices take part in the stroke at the same time. With fewer than {FEW_SLICES} "
            "slices the dissipation of the numerical grid raises the power at low speed by tens of percent; use more "
            "slices"
        )
        notices.append(Notice("few_slices", message, "slices"))
    return notices


def jump_notices(tables: Sequence[StrokeTable]) -> list[Notice]:
    """Warning if the area of a tooth space jumps at some angle, which changes the pressure while the teeth rest."""
    share, angle = max(table.jump for table in tables)
    if share == 0.0:
        return []
    message = (
        f"at {degrees(angle):.2f} deg the area of a tooth space jumps by {100 * expm1(share):.0f} %, because the point "
        "nearest to a tip corner changes from the flank to the root. Pressures are wrong from this angle on. Use the "
        "option of contact gaps, which avoids this jump"
    )
    return [Notice("area_jump", message, "gap", rank="invalid")]


def flow_notices(flow: Flow, largest_mach: float, largest_gauge_pressure: float) -> list[Notice]:
    """Warning if the model does not resolve the flow. `largest_gauge_pressure` is relative to the ambient pressure."""
    if flow is Flow.INCOMPRESSIBLE and largest_mach > INCOMPRESSIBLE_MACH:
        message = (
            f"the Mach number is {largest_mach:.2f}; above {INCOMPRESSIBLE_MACH:g} the gas cannot be treated as "
            "incompressible"
        )
        return [Notice("incompressible_mach", message, "flow", rank="invalid")]
    if flow is Flow.POCKET_CHAIN and largest_gauge_pressure < LEAST_GAUGE_PRESSURE:
        message = (
            "the relative difference between the pressure and the ambient pressure is below "
            f"{LEAST_GAUGE_PRESSURE:g}; the pocket chain cannot resolve such a small difference. Compute the power at "
            "a higher speed instead; at low speed the power is proportional to the cube of the speed"
        )
        return [Notice("pressure_not_resolved", message, "pinion_speed")]
    return []


def net_flow_notices(model: Flow, flows: list[MassFlow], slices: int, finest: int) -> list[Notice]:
    """Return a warning about the most uncertain net flow out of an end, if its uncertainty exceeds `NET_UNCERTAINTY`.

    The net flow is uncertain if it is a small difference between outflow and inflow. `finest` is the largest number of
    slices that the speed allows.
    """
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
        f"a net flow of {1e3 * net:.3g} g/s out of an end is uncertain by {1e3 * flow.net_uncertainty:.2g} g/s, "
        "because this net flow is a small difference between outflow and inflow"
    )
    if model is Flow.GAS_DYNAMICS and slices < finest:
        message += f"; use more slices (this speed allows {finest})"
    return [Notice("net_flow_uncertain", message, "slices")]


def resolution_notices(flow: Flow, uncertain: Resolution, slices: int, finest: int) -> list[Notice]:
    """Return a warning that names the results of gas dynamics that are uncertain with this number of slices.

    `finest` is the largest number of slices that the speed allows.
    """
    shares = ", ".join(
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
    if flow is not Flow.GAS_DYNAMICS or not shares:
        return []
    more = f"use more slices (this speed allows {finest})" if slices < finest else "this speed allows no more slices"
    return [Notice("not_resolved", f"not resolved by {slices} slices: {shares}; {more}", "slices")]


def speed_notices(pair: GearPair, gas: Gas, pinion_speed: float) -> list[Notice]:
    """Return a warning if tip speed or pitch-line velocity is above all published results compared with the model."""
    tip = max(pair.pinion.tip_radius, pair.wheel.tip_radius * pair.pinion.teeth / pair.wheel.teeth) * pinion_speed
    pitch_line = pair.pinion_working_radius * pinion_speed
    if tip > TIP_SPEED_SHARE * gas.sound_speed or pitch_line > PITCH_LINE_SPEED:
        message = (
            f"the tip speed is {tip:.0f} m/s, and the pitch-line velocity is {pitch_line:.0f} m/s. The model has been "
            f"compared with published results only up to a tip speed of {TIP_SPEED_SHARE:g} times the speed of sound, "
            f"and up to a pitch-line velocity of {PITCH_LINE_SPEED:g} m/s (at "
            f"{PITCH_LINE_SPEED / pair.pinion_working_radius * 30 / pi:.0f} rpm of the pinion)"
        )
        return [Notice("high_speed", message, "pinion_speed")]
    return []


def unusual_values(inputs: PumpingInputs | ChokingInputs, _result: object) -> Iterator[Notice]:
    """Yield the warnings about unusual values of the ambient pressure, the gears and the speed."""
    yield from thin_air(inputs.setup.ambient.pressure)
    speed = inputs.pinion_speed if isinstance(inputs, PumpingInputs) else None
    yield from unusual_gears(inputs.setup.gears, speed)


def thin_air(pressure: float) -> Iterator[Notice]:
    """Warn of an ambient pressure [Pa] that is nearly a vacuum."""
    if pressure < THIN_AIR:
        yield unusual_value(
            "ambient.pressure",
            f"an ambient pressure of {pressure / 1e3:g} kPa is nearly a vacuum; was a value entered in the wrong unit "
            "(bar)?",
        )
