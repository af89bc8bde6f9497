"""Figures of the heat balance: heat flows, temperatures, effect of the oil flow, uncertainty of the safety."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from app.figures.data import Axis, Figure, Hue, Level, Line, Mark, NoFigure, Panel, Row, Values, values
from app.figures.units import axis
from app.figures.wording import number
from solvers.heat_balance import FlowCurve, Heat, over_the_flow
from solvers.quantity import UNITS
from solvers.scuffing.inputs import ScuffingInputs
from solvers.scuffing.model import solve
from solvers.scuffing.safety import safety_factor
from solvers.scuffing.safety_results import BulkInForce, Safety, Scuffing
from solvers.scuffing.thermal.pair_heat import balance_inputs
from solvers.scuffing.thermal.practice import HIGH_RISK_BELOW, LOW_RISK_ABOVE
from solvers.scuffing.thermal.temperatures import with_friction

KILOWATT, KELVIN = UNITS["kw"].scale, UNITS["c"].offset
ROOM = 0.3  # share of the range of temperatures; room at both ends of the axis
SMALL = 2e-3  # share of the heat supplied; smaller flows are left out
ESTIMATE = "ISO/TS 6336-20"
SAME_PLACE = 1.0  # K; marks that are closer are one
FLOWS = np.geomspace(0.25, 4.0, 33)  # oil flows divided by the oil flow of the case
SUPPLY = {
    "friction of the mesh": "friction of the mesh",
    "friction of the bearing": "friction of the bearings",
    "windage": "windage",
    "oil brought to speed": "oil brought to speed",
    "pumped gas": "pumped gas",
    "other losses": "other losses",
    "oil jets": "oil jets",
}
AWAY = {"drain": "oil of the gears", "oil of the bearing": "oil of the bearings", "surroundings": "casing, to the air"}
DRAINED, DRAINED_MIXED = "mist and drained oil", "drained oil, gears and bearings"
BY_GEAR = {
    "oil on the flanks": ("oil on loaded flanks", Hue.BLUE),
    "oil on the unloaded flanks": ("oil on unloaded flanks", Hue.SKY),
    "oil out of the mist": ("oil out of the mist", Hue.GREEN),
    "mist on the rim": ("mist on rim and faces", Hue.ORANGE),
    "mist on the faces": ("mist on rim and faces", Hue.ORANGE),
    "shaft": ("shaft, to the bearings", Hue.PURPLE),
}


def heat_of(heat: Heat | None) -> Heat:
    """Return the heat balance; raise NoFigure if there is no heat balance."""
    if heat is None:
        raise NoFigure("no_oil", "Without an oil there is no heat balance", "lubricant")
    return heat


def where_heat_goes(heat: Heat) -> Figure:
    """Draw the heat that the losses supply, the heat that leaves each gear, and the heat that leaves the unit."""
    supplied = heat.balance.supplied / KILOWATT
    groups = (
        ("supplied", _summed(heat, SUPPLY, origins={"source"}), Hue.VERMILLION),
        ("out of the pinion", _out_of(heat, "pinion"), Hue.BLUE),
        ("out of the wheel", _out_of(heat, "wheel"), Hue.BLUE),
        ("removed", _summed(heat, AWAY, targets={"oil", "ambient"}), Hue.GREEN),
    )
    rows = [
        Row(f"{place}: {name}", power, hue)
        for place, powers, hue in groups
        for name, power in powers.items()
        if abs(power) > SMALL * supplied
    ]
    through_flanks = heat.pinion.friction + heat.wheel.friction
    finding = f"{number(supplied, 'kW')} in all, {number(through_flanks / KILOWATT, 'kW')} by the flanks"
    return Figure(finding, [Panel(x=Axis("heat flow", "kW", symbol="P"), y=Axis("where"), rows=rows)])


def _summed(
    heat: Heat, names: dict[str, str], *, origins: set[str] | None = None, targets: set[str] | None = None
) -> dict[str, float]:
    """Sum the heat flows of each carrier, and return the sums [kW]. The largest sum comes first."""
    powers: dict[str, float] = {}
    for flow in heat.flows:
        if (origins is None or flow.from_ in origins) and (targets is None or flow.to in targets):
            name = names[flow.carrier]
            powers[name] = powers.get(name, 0.0) + flow.power / KILOWATT
    return dict(sorted(powers.items(), key=lambda name_and_power: -name_and_power[1]))


def _out_of(heat: Heat, gear: str) -> dict[str, float]:
    """Return the heat [kW] that each carrier takes out of a gear; heat that enters the gear is negative."""
    powers: dict[str, float] = {}
    for flow in heat.flows:
        inside = [place.startswith(f"{gear}_") for place in (flow.from_, flow.to)]
        if flow.carrier in BY_GEAR and inside[0] != inside[1]:
            name = BY_GEAR[flow.carrier][0]
            powers[name] = powers.get(name, 0.0) + (flow.power if inside[0] else -flow.power) / KILOWATT
    return dict(sorted(powers.items(), key=lambda name_and_power: -name_and_power[1]))


def temperatures(heat: Heat, oil: float) -> Figure:
    """Draw the temperatures of all nodes, and the uncertainty bands of the flank temperatures."""
    band = heat.band
    rows = [
        Row("pinion, loaded flank", heat.pinion.flank, Hue.VERMILLION, None if band is None else band.pinion_flank),
        Row("pinion, body", heat.pinion.body, Hue.ORANGE),
        Row("wheel, loaded flank", heat.wheel.flank, Hue.VERMILLION, None if band is None else band.wheel_flank),
        Row("wheel, body", heat.wheel.body, Hue.ORANGE),
        Row("mist, oil that leaves the gears" if heat.bearings else DRAINED, heat.mist, Hue.SKY),
        *(
            Row(f"bearing {place}, oil that leaves", bearing.outlet, Hue.BLUE)
            for place, bearing in enumerate(heat.bearings, start=1)
        ),
        *([Row(DRAINED_MIXED, heat.drain, Hue.GREEN)] if heat.bearings else []),
        *([] if heat.casing is None else [Row("casing", heat.casing, Hue.GREY)]),
    ]
    levels = [Level(oil, f"oil {number(oil, '°C')}", vertical=True)]
    estimate = heat.estimates.iso_tr_13989_bulk
    if estimate is not None:
        levels.append(Level(estimate, f"bulk by ISO/TS 6336-20 {number(estimate, '°C')}", vertical=True))
    finding = f"flanks {number(heat.pinion.flank, '°C')} and {number(heat.wheel.flank, '°C')}"
    if band is not None:
        low, high = band.pinion_flank
        finding = f"{finding}; pinion {number(low)} to {number(high, '°C')} by the uncertain cooling"
    shown = [level.value for level in levels] + [end for row in rows for end in (row.value, *(row.bounds or ()))]
    room = ROOM * (max(shown) - min(shown) + 1.0)
    x = Axis("temperature", "°C", symbol="θ", magnitude=False, limits=(min(shown) - room, max(shown) + 2 * room))
    return Figure(finding, [Panel(x=x, y=Axis("where"), rows=rows, levels=levels)])


def curve_over_the_flow(inputs: ScuffingInputs, result: Scuffing) -> FlowCurve:
    """Solve the heat balance of a pair at oil flows between 0.25 and 4 times the oil flow of the case."""
    if result.heat is None:
        raise NoFigure("no_oil", "Without an oil there is no heat balance", "lubricant")
    own, helix = inputs.distribution, result.distribution.helix
    if helix is not None:
        own = replace(own, load=replace(own.load, helix_share=helix.share))
    balanced, distribution = with_friction(replace(inputs, distribution=own), solve(own))
    flow = UNITS["l_per_min"].scale * result.heat.gear_flow
    return over_the_flow(balance_inputs(balanced, distribution), FLOWS * flow)


def what_the_flow_does(heat: Heat, curve: FlowCurve) -> list[Panel]:
    """Return a list with one panel, which shows the temperatures of flanks and drained oil over the oil flow."""
    flow = curve.flow / UNITS["l_per_min"].scale
    lines = [
        Line("pinion flank", flow, curve.pinion_flank - KELVIN, Hue.VERMILLION),
        Line("wheel flank", flow, curve.wheel_flank - KELVIN, Hue.ORANGE),
        Line(DRAINED_MIXED if heat.bearings else DRAINED, flow, curve.drain - KELVIN, Hue.BLUE),
    ]
    return [
        Panel(
            x=axis(heat, "gear_flow", "oil flow to the gears", magnitude=False),
            y=Axis("temperature", "°C", magnitude=False, symbol="θ"),
            lines=lines,
            levels=[_own_flow(heat)],
        )
    ]


def _own_flow(heat: Heat) -> Level:
    return Level(heat.gear_flow, f"this case {number(heat.gear_flow, 'l/min')}", vertical=True)


def oil_flow(inputs: ScuffingInputs, result: Scuffing, curve: FlowCurve) -> Figure:
    """Draw the temperatures of flanks and drained oil, and the safety factor, over the oil flow to a gear pair."""
    heat, safety, largest = heat_of(result.heat), result.safety, result.flash.blok_max
    scuffing = None if safety is None or largest is None else (safety.scuffing, largest)
    return over_the_oil_flow(heat, curve, inputs.temperatures.oil - KELVIN, scuffing, result.derived.bulk)


def over_the_oil_flow(
    heat: Heat, curve: FlowCurve, oil: float, scuffing: tuple[float, float] | None, origin: BulkInForce
) -> Figure:
    """Draw the temperatures of flanks and drained oil, and the safety factor, over the oil flow.

    Marks show the flows at which the verdict on the safety factor changes. `scuffing` holds two values that do not
    depend on the flow: the scuffing temperature [°C], and the rise of the contact temperature above the bulk
    temperature [K]. If `scuffing` is None, the safety factor is not drawn. `oil` is the temperature of the supplied oil
    [°C], and `origin` says how the bulk temperature follows from the flanks.
    """
    panels = what_the_flow_does(heat, curve)
    if scuffing is not None:
        limit, rise = scuffing
        bulk = origin.bulk_at((curve.pinion_flank + curve.wheel_flank) / 2 - KELVIN)
        factors = _factors(limit, oil, bulk + rise)
        line = Line("safety", curve.flow / UNITS["l_per_min"].scale, factors, named=False)
        marks = [mark for verdict in (HIGH_RISK_BELOW, LOW_RISK_ABOVE) for mark in _first_crossing(line, verdict)]
        y = axis(Safety, "blok_factor", "safety factor against scuffing")
        levels = [*_verdicts(factors), Level(heat.gear_flow, "", vertical=True)]
        panels.append(Panel(x=panels[0].x, y=y, lines=[line], marks=marks, levels=levels))
    return Figure(_flank_change(heat, curve), panels, unsolved=int(np.isnan(curve.drain).sum()))


def _flank_change(heat: Heat, curve: FlowCurve) -> str:
    """Return a text with two temperatures of the pinion's flank: at twice the oil flow, and at the present oil flow."""
    double = float(np.interp(2.0, FLOWS, curve.pinion_flank)) - KELVIN
    if np.isnan(double):
        return f"pinion flank {number(heat.pinion.flank, '°C')}"
    return f"twice the oil: pinion flank {number(double, '°C')} instead of {number(heat.pinion.flank, '°C')}"


def _factors(scuffing: float, oil: float, contact: Values) -> Values:
    """Return the safety factors at contact temperatures [°C]; NaN if the contact is not hotter than the oil."""
    return values([safety_factor(scuffing, oil, float(at)) if at > oil else None for at in contact])


def _verdicts(factors: Values) -> list[Level]:
    """Return the lines that mark high risk and low risk in a figure of the safety factor."""
    levels = [Level(HIGH_RISK_BELOW, "high risk below 1", limit=True)]
    if float(np.nanmax(factors)) > (HIGH_RISK_BELOW + LOW_RISK_ABOVE) / 2:
        levels.append(Level(LOW_RISK_ABOVE, "low risk above 2"))
    return levels


def _first_crossing(line: Line, limit: float) -> Sequence[Mark]:
    """Return a mark at the first place where a rising line reaches a limit, or no mark if there is no such place."""
    above = np.flatnonzero(line.y >= limit)
    if above.size == 0 or above[0] == 0 or np.isnan(line.y[above[0] - 1]):
        return []
    place = slice(above[0] - 1, above[0] + 1)
    flow = float(np.interp(limit, line.y[place], line.x[place]))
    return [Mark(flow, limit, f"{number(limit)} at {number(flow, 'l/min')}", line.hue)]


def safety_over_the_band(inputs: ScuffingInputs, result: Scuffing) -> Figure:
    """Draw the safety factor over the bulk temperature."""
    heat, safety, largest = heat_of(result.heat), result.safety, result.flash.blok_max
    if safety is None or safety.blok_factor is None or largest is None:
        raise NoFigure(
            "no_scuffing_temperature",
            "Without a load and a scuffing temperature no safety can be computed",
            "temperatures",
        )
    if heat.band is None or heat.band.safety is None or heat.band.bulk is None or result.contact_temperature is None:
        raise NoFigure(
            "no_band",
            "The heat balance states no range of safety factors, so there is nothing to draw",
            "cooling.band",
        )
    oil = inputs.temperatures.oil - KELVIN
    bulks = {
        "cool end of the band": heat.band.bulk[0],
        "nominal": result.contact_temperature.bulk,
        "hot end of the band": heat.band.bulk[1],
    }
    estimate = heat.estimates.iso_tr_13989_bulk
    near = [name for name, at in bulks.items() if estimate is not None and abs(at - estimate) < SAME_PLACE][:1]
    points = {f"{name}, {ESTIMATE}" if name in near else name: at for name, at in bulks.items()}
    if estimate is not None and not near:
        points[ESTIMATE] = estimate
    ends = sorted(points.values())
    bulk = np.linspace(ends[0] - 2.0, ends[-1] + 2.0, 101)
    line = Line("safety", bulk, _factors(safety.scuffing, oil, bulk + largest), named=False)
    marks = []
    for name, at in points.items():
        factor = safety_factor(safety.scuffing, oil, at + largest)
        if factor is not None:
            hue = Hue.GREY if name == ESTIMATE else line.hue
            marks.append(Mark(at, factor, f"{name}: {number(factor)} at {number(at, '°C')}", hue))
    low, high = heat.band.safety
    finding = f"safety factor {number(safety.blok_factor)} ({number(low)} to {number(high)})"
    return Figure(
        f"{finding}: {safety.verdict} risk at the lower end",
        [
            Panel(
                x=Axis("bulk temperature, mean of both flanks", "°C", magnitude=False, symbol="θ_M"),
                y=axis(Safety, "blok_factor", "safety factor against scuffing", magnitude=False),
                lines=[line],
                levels=_verdicts(line.y),
                marks=marks,
            )
        ],
    )
