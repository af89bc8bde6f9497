"""Figures of pumping between the teeth: over the stroke, along the face, over face and angle; over the speed."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from app.figures.data import (
    Axis,
    Bars,
    Critical,
    Figure,
    Hue,
    Level,
    Line,
    Map,
    Mark,
    NoFigure,
    Panel,
    Role,
    Row,
    Scale,
    Span,
    Values,
    values,
)
from app.figures.declaration import Declaration, present
from app.figures.models.load_distribution import face
from app.figures.units import MM, RPM
from app.figures.wording import number, ratio
from solvers.pumping.inputs import ChokingInputs, PumpingInputs, PumpingSetup
from solvers.pumping.results import ChokingCurves, ChokingSpeeds, GasField, PumpingResult, SpacesResult
from solvers.pumping.speed_scan import speed_scan


def spaces(result: PumpingResult) -> list[tuple[str, SpacesResult]]:
    """The tooth spaces asked for, by their gear."""
    both = (("pinion", result.pinion_spaces), ("wheel", result.wheel_spaces))
    return [(gear, space) for gear, space in both if space is not None]


def critical_ratio(setup: PumpingSetup) -> float:
    """Pressure over ambient pressure from which the flow into the surroundings is sonic (Eq. 7)."""
    exponent = setup.ambient.isentropic_exponent
    return float(((exponent + 1.0) / 2.0) ** (exponent / (exponent - 1.0)))


def pressure_map(inputs: PumpingInputs, result: PumpingResult) -> Figure:
    """Pressure over ambient pressure; the ratio at which clearances become sonic."""
    panels = _panels(
        inputs,
        result,
        lambda field: field.pressure_ratio,
        title="pressure ratio",
        scale=Scale.RATIO,
        critical=(Critical(critical_ratio(inputs.setup), f"sonic {number(critical_ratio(inputs.setup))}"),),
    )
    peak = max(space.peak_pressure_ratio for _, space in spaces(result))
    least = min(space.min_pressure_ratio for _, space in spaces(result))
    finding = f"highest {ratio(peak)}, lowest {ratio(least)} of ambient pressure"
    return Figure(finding, panels, beside=True)


def mach_map(inputs: PumpingInputs, result: PumpingResult) -> Figure:
    """Axial Mach number, signed towards the end that meshes last; sonic both ways."""
    panels = _panels(
        inputs,
        result,
        lambda field: field.axial_mach,
        title="axial Mach number",
        scale=Scale.SIGNED,
        critical=(Critical(1.0, "sonic"), Critical(-1.0, "sonic")),
    )
    peak = max(space.peak_axial_mach for _, space in spaces(result))
    choked = [gear for gear, space in spaces(result) if space.axial_choked]
    state = f"an end of the {' and '.join(choked)} becomes sonic" if choked else "no end becomes sonic"
    finding = f"up to {number(peak)} with the exit faces; {state}"
    return Figure(finding, panels, beside=True)


def temperature_map(inputs: PumpingInputs, result: PumpingResult) -> Figure:
    """Stagnation temperature above ambient."""
    panels = _panels(
        inputs, result, lambda field: field.temperature_rise, title="temperature rise", unit="K", scale=Scale.SIGNED
    )
    peak = max(float(np.nanmax(panel.map.values)) for panel in panels if panel.map is not None)
    finding = f"up to {number(peak, 'K')} above ambient for a moment; the teeth see the mean over the stroke"
    return Figure(finding, panels, beside=True)


def _panels(
    inputs: PumpingInputs,
    result: PumpingResult,
    read: Callable[[GasField], Values | None],
    *,
    title: str,
    scale: Scale,
    unit: str | None = None,
    critical: tuple[Critical, ...] = (),
) -> tuple[Panel, ...]:
    """A map for each gear's spaces, all in the same colours, extremes marked."""
    fields = [(gear, space.field) for gear, space in spaces(result)]
    grids = {gear: grid for gear, field in fields if (grid := read(field)) is not None}
    if len(grids) < len(fields):
        raise _without_temperatures()
    ends = min(float(grid.min()) for grid in grids.values()), max(float(grid.max()) for grid in grids.values())
    panels = []
    for gear, field in fields:
        chart = Map(
            title=title,
            unit=unit,
            x=values(field.position),
            y=values(field.angle),
            values=grids[gear],
            scale=scale,
            critical=critical,
            range=_around(scale, *ends),
            bar=gear == fields[-1][0],
        )
        panels.append(
            Panel(
                x=face(inputs.setup.gears.face_width),
                y=Axis(f"angle of the {gear}", "°", magnitude=False),
                title=f"spaces of the {gear}",
                map=chart,
                marks=_extremes(chart, scale),
                spans=tuple(replace(groove, name="") for groove in _grooves(inputs)),
            )
        )
    return tuple(panels)


def _around(scale: Scale, low: float, high: float) -> tuple[float, float]:
    """Ends of the colours: as far below as above 1 by ratio or 0 by difference."""
    if scale is Scale.RATIO:
        reach = max(high, 1.0 / max(low, 1e-3), 1.0001)
        return 1.0 / reach, reach
    reach = max(abs(low), abs(high), 1e-12)
    return -reach, reach


def _extremes(chart: Map, scale: Scale) -> tuple[Mark, ...]:
    """The largest value, and the smallest of a ratio."""
    places = [int(np.argmax(chart.values))] + ([int(np.argmin(chart.values))] if scale is Scale.RATIO else [])
    marks = []
    for place in places:
        row, column = np.unravel_index(place, chart.values.shape)
        value = float(chart.values[row, column])
        text = ratio(value) if scale is Scale.RATIO else number(value, chart.unit or "")
        marks.append(Mark(float(chart.x[column]), float(chart.y[row]), text))
    return tuple(marks)


MAPS = (
    Declaration("pressure-map", "Pressure in the tooth spaces", "Milian 2004, Eqs. 1-4", pressure_map),
    Declaration("mach-map", "Axial flow in the tooth spaces", "Milian 2004, Eq. 7", mach_map),
    Declaration(
        "temperature-map",
        "Temperature in the tooth spaces",
        "Milian 2004, Figs. 5, 6",
        temperature_map,
    ),
)


SPEEDS = 24
BEYOND = 1.5  # times the highest choking speed, where the scan ends
LOWEST = 0.25  # of that, where it starts
TITLE, SOURCE = "Speeds at which the flow becomes sonic", "Milian 2004, Eq. 7"


def scan(inputs: ChokingInputs, result: ChokingSpeeds) -> ChokingCurves:
    """Exit Mach number and peak pressure at evenly spaced speeds around the choking speeds."""
    found = [speed for _, speed in _choking(result) if speed is not None]
    limit = inputs.search_limit / RPM
    end = min(BEYOND * max(found), limit) if len(found) == 2 else limit
    start = min([LOWEST * end, *(0.8 * speed for speed in found)])
    return speed_scan(inputs.setup, np.linspace(start, end, SPEEDS) * RPM)


def choking(inputs: ChokingInputs, result: ChokingSpeeds, curves: ChokingCurves) -> Figure:
    """Both against the limits of sonic flow, choking speeds marked."""
    x = Axis("pinion speed", "1/min", magnitude=False, symbol="n₁")
    speed, critical = values(curves.pinion_speed / RPM), critical_ratio(inputs.setup)
    pressure, mach = values(curves.peak_pressure_ratio), values(curves.exit_mach)
    speeds = dict(_choking(result))
    panels = (
        Panel(
            x=x,
            y=Axis("Mach number that the ambient pressure asks for at the ends"),
            lines=(Line("exit Mach number", speed, mach, named=False),),
            levels=(Level(1.0, "ends sonic", limit=True), *_at("ends", speeds["ends"])),
        ),
        Panel(
            x=x,
            y=Axis("peak pressure over ambient pressure", symbol="p/p₀"),
            lines=(Line("peak pressure", speed, pressure, Hue.VERMILLION, named=False),),
            levels=(
                Level(critical, f"clearances sonic, {number(critical)}", limit=True),
                *_at("clearances", speeds["clearances"]),
            ),
        ),
    )
    limit = number(inputs.search_limit / RPM, "1/min")
    onsets = (f"not up to {limit}" if at is None else f"from {number(at, '1/min')}" for at in speeds.values())
    texts = (f"{name} {onset}" for name, onset in zip(speeds, onsets, strict=True))
    return Figure(f"sonic: {', '.join(texts)}", panels, unsolved=int(np.isnan(mach).sum()))


def _choking(result: ChokingSpeeds) -> tuple[tuple[str, float | None], ...]:
    return ("clearances", result.radial_choking_speed), ("ends", result.axial_choking_speed)


def _at(name: str, speed: float | None) -> tuple[Level, ...]:
    return () if speed is None else (Level(speed, f"{name}: {number(speed, '1/min')}", vertical=True),)


CHOKING_FIGURES = (Declaration("choking", TITLE, SOURCE, choking, compute=scan),)


HUES = {"pinion": Hue.BLUE, "wheel": Hue.VERMILLION}
NO_FLOW = 1e-9  # g/s


def stroke(_: PumpingInputs, result: PumpingResult) -> Figure:
    """Section left by the mating tooth and its clearances; flanks in contact shaded."""
    gear, first = spaces(result)[0]
    curves = first.stroke.curves
    angle, area = values(curves.angle), values(curves.area)
    contact = first.stroke.contact_start, first.stroke.contact_end
    least = int(np.argmin(area))
    x = Axis(f"angle of the {gear} from the line of centres", "°", magnitude=False)
    section = Panel(
        x=x,
        y=Axis("area left by the mating tooth", "mm²", symbol="S_A"),
        lines=(Line("area", angle, area, named=False),),
        spans=(Span(*contact, "driving flanks in contact"),),
        marks=(Mark(float(angle[least]), float(area[least]), number(float(area[least]), "mm²")),),
    )
    clearances = Panel(
        x=x,
        y=Axis("radial clearance", "mm"),
        lines=(
            Line("behind, L₁", angle, values(curves.clearance_left), Hue.VERMILLION),
            Line("ahead, L₂", angle, values(curves.clearance_right), Hue.GREEN),
        ),
        spans=(Span(*contact, ""),),
    )
    ends = f"{number(first.stroke.max_area)} to {number(first.stroke.min_area, 'mm²')}"
    finding = f"the {gear}'s space shrinks from {ends}"
    return Figure(finding, (section, clearances))


def heating(inputs: PumpingInputs, result: PumpingResult) -> Figure:
    """Stroke mean of the temperature along the face of both gears, hottest place marked."""
    lines, marks, texts = [], [], []
    for gear, space in spaces(result):
        profile = space.profile
        if profile.temperature_rise is None or space.max_temperature_rise is None:
            raise _without_temperatures()
        line = _along(inputs, gear, profile.position, profile.temperature_rise, HUES[gear])
        lines.append(line)
        hottest = present(space.hottest_position)
        marks.append(Mark(hottest, space.max_temperature_rise, number(space.max_temperature_rise, "K"), line.hue))
        texts.append(f"{gear} {number(space.max_temperature_rise, 'K')} at {number(hottest, 'mm')}")
    panel = Panel(
        x=face(inputs.setup.gears.face_width),
        y=Axis("temperature rise above ambient", "K"),
        lines=tuple(lines),
        marks=tuple(marks),
        spans=_grooves(inputs),
    )
    finding = f"hottest: {', '.join(texts)}; of the gas, trends rather than kelvins of the teeth"
    return Figure(finding, (panel,))


def peak_pressure(inputs: PumpingInputs, result: PumpingResult) -> Figure:
    """Largest pressure of the stroke along the face, with the ratio at which clearances become sonic."""
    lines, marks = [], []
    for gear, space in spaces(result):
        profile = space.profile
        line = _along(inputs, gear, profile.position, profile.peak_pressure_ratio, HUES[gear])
        at = int(np.nanargmax(line.y))
        lines.append(line)
        marks.append(Mark(float(line.x[at]), float(line.y[at]), ratio(float(line.y[at])), line.hue))
    critical = critical_ratio(inputs.setup)
    panel = Panel(
        x=face(inputs.setup.gears.face_width),
        y=Axis("largest pressure over ambient pressure", symbol="p/p₀"),
        lines=tuple(lines),
        marks=tuple(marks),
        levels=(Level(critical, f"clearances sonic from {number(critical)}", limit=True), Level(1.0, "ambient")),
        spans=_grooves(inputs),
    )
    choked = [gear for gear, space in spaces(result) if space.radial_choked]
    state = f"clearances of the {' and '.join(choked)} become sonic" if choked else "no clearance becomes sonic"
    return Figure(state, (panel,))


def lead_correction(inputs: PumpingInputs, result: PumpingResult) -> Figure:
    """Thermal growth of the pinion's flank and what undoes it."""
    lead = result.lead_correction
    if lead is None:
        raise NoFigure(
            "no_lead_correction", "A lead correction needs the temperatures of the pinion's spaces", "model.spaces"
        )
    curves = lead.curves
    panel = Panel(
        x=face(inputs.setup.gears.face_width),
        y=Axis("normal to the flank of the pinion", "µm", magnitude=False),
        lines=(
            _along(inputs, "growth", curves.position, curves.growth, Hue.VERMILLION),
            replace(
                _along(inputs, "by the radius alone", curves.position, curves.radial_only, Hue.VERMILLION),
                role=Role.REFERENCE,
            ),
            _along(inputs, "correction", curves.position, curves.correction, Hue.BLUE),
        ),
        spans=_grooves(inputs),
    )
    shape = f"slope {number(lead.slope, 'µm')}, crown {number(lead.crown, 'µm')}"
    finding = f"growth ranges over {number(lead.range, 'µm')}; {shape}"
    return Figure(finding, (panel,))


def pulsation(_: PumpingInputs, result: PumpingResult) -> Figure:
    """Amplitudes of the mass flow at both ends by multiples of the meshing frequency."""
    pulse, total = result.pulsation, result.total
    orders = values([float(order) for order in range(1, len(pulse.frequency) + 1)])
    series = (
        Bars("end that meshes first", orders, values(pulse.front_mass_flow), Hue.BLUE),
        Bars("end that meshes last", orders, values(pulse.rear_mass_flow), Hue.VERMILLION),
    )
    frequency = number(total.meshing_frequency, "Hz")
    panel = Panel(
        x=Axis(f"multiple of the meshing frequency of {frequency}", magnitude=False, ticks=tuple(orders.tolist())),
        y=Axis("amplitude of the mass flow", "g/s"),
        bars=series,
    )
    peak = max(float(each.height.max()) for each in series)
    return Figure(f"up to {number(peak, 'g/s')}", (panel,))


def mass_flow(_: PumpingInputs, result: PumpingResult) -> Figure:
    """What leaves and enters the tooth spaces of each gear at the ends, and the net flow out by exit."""
    exits = {gear: _exits(space) for gear, space in spaces(result)}
    still = all(abs(row.value) < NO_FLOW for rows in exits.values() for row in rows)
    x = Axis("mass flow (net: out; negative: in)", "g/s", limits=(0.0, 1.0) if still else None)
    panels = tuple(Panel(x=x, y=Axis("exit"), title=f"spaces of the {gear}", rows=rows) for gear, rows in exits.items())
    flows = [space.mass_flow for _, space in spaces(result)]
    net = sum(flow.front + flow.rear for flow in flows)
    out = number(sum(flow.front_out + flow.rear_out for flow in flows), "g/s")
    way = "leave" if net > 0.0 else "enter"
    balance = f"{number(abs(net), 'g/s')} {way} net" if abs(net) > NO_FLOW else "as much enters"
    finding = f"{out} leave through the ends of the face, {balance}; the net flows of a gear sum to zero"
    return Figure("nothing flows" if still else finding, panels)


def _exits(space: SpacesResult) -> tuple[Row, ...]:
    flow, known = space.mass_flow, space.mass_flow.net_uncertainty
    return (
        Row("first end: out", flow.front_out, Hue.BLUE),
        Row("first end: in", flow.front_in, Hue.BLUE),
        Row("first end: net", flow.front, Hue.BLUE, (flow.front - known, flow.front + known)),
        Row("last end: out", flow.rear_out, Hue.VERMILLION),
        Row("last end: in", flow.rear_in, Hue.VERMILLION),
        Row("last end: net", flow.rear, Hue.VERMILLION, (flow.rear - known, flow.rear + known)),
        Row("radial clearances: net", flow.radial, Hue.GREEN),
        Row("grooves: net", flow.grooves, Hue.ORANGE),
        Row("given back between strokes", flow.reset, Hue.GREY),
    )


def _grooves(inputs: PumpingInputs) -> tuple[Span, ...]:
    halves = ((each.position / MM, each.width / 2.0 / MM) for each in inputs.setup.grooves)
    return tuple(Span(middle - half, middle + half, "groove") for middle, half in halves)


def _along(inputs: PumpingInputs, title: str, position: Values, items: Values, hue: Hue) -> Line:
    """A line along the face, broken where a groove is."""
    x, y = values(position), values(items)
    middles = np.array(sorted(groove.position / MM for groove in inputs.setup.grooves))
    at = np.searchsorted(x, middles)
    return Line(title, values(np.insert(x, at, middles)), values(np.insert(y, at, np.nan)), hue)


def _without_temperatures() -> NoFigure:
    return NoFigure("no_temperature", "Incompressible flow has no temperatures", "model.flow")


FIGURES = (
    Declaration("stroke", "One stroke of a tooth space", "Milian 2004, Fig. 3", stroke),
    Declaration("heating", "Where along the face the mist heats the teeth", "Milian 2004, Figs. 5, 6", heating),
    Declaration("peak-pressure", "Highest pressure along the face", "Milian 2004, Eq. 7", peak_pressure),
    *MAPS,
    Declaration("lead-correction", "Lead correction against thermal growth", "Milian 2004", lead_correction),
    Declaration("pulsation", "Pulsating flow at the ends of the face", "Milian 2004", pulsation),
    Declaration("mass-flow", "Where the mist leaves and enters the tooth spaces", "Milian 2004", mass_flow),
)
