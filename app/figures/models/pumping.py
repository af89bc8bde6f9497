"""Figures of pumping between the teeth: over the stroke, along the face, over face and angle; over the speed."""

from collections.abc import Callable
from dataclasses import replace
from math import pi

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
    matrix,
    values,
)
from app.figures.declaration import Declaration, present
from app.figures.wording import number, ratio
from app.schema.pumping import (
    ChokingSpeedRequest,
    ChokingSpeedResponse,
    PumpingField,
    PumpingRequest,
    PumpingResponse,
    PumpingSpaces,
)
from solvers.pumping.results import ChokingCurves
from solvers.pumping.speed_scan import speed_scan

Rows = list[list[float]]


def spaces(answer: PumpingResponse) -> list[tuple[str, PumpingSpaces]]:
    """The tooth spaces asked for, by their gear."""
    both = (("pinion", answer.pinion_spaces), ("wheel", answer.wheel_spaces))
    return [(gear, space) for gear, space in both if space is not None]


def critical_ratio(request: PumpingRequest | ChokingSpeedRequest) -> float:
    """Pressure over ambient pressure from which the flow into the surroundings is sonic (Eq. 7)."""
    exponent = request.ambient.isentropic_exponent
    return float(((exponent + 1.0) / 2.0) ** (exponent / (exponent - 1.0)))


def pressure_map(request: PumpingRequest, answer: PumpingResponse) -> Figure:
    """Pressure over ambient pressure; the ratio at which clearances become sonic."""
    panels = _panels(
        request,
        answer,
        lambda field: field.pressure_ratio,
        title="pressure ratio",
        scale=Scale.RATIO,
        critical=(Critical(critical_ratio(request), f"sonic {number(critical_ratio(request))}"),),
    )
    peak = max(space.peak_pressure_ratio for _, space in spaces(answer))
    least = min(space.min_pressure_ratio for _, space in spaces(answer))
    finding = f"highest {ratio(peak)}, lowest {ratio(least)} of ambient pressure"
    return Figure(finding, panels, beside=True)


def mach_map(request: PumpingRequest, answer: PumpingResponse) -> Figure:
    """Axial Mach number, signed towards the end that meshes last; sonic both ways."""
    panels = _panels(
        request,
        answer,
        lambda field: field.axial_mach,
        title="axial Mach number",
        scale=Scale.SIGNED,
        critical=(Critical(1.0, "sonic"), Critical(-1.0, "sonic")),
    )
    peak = max(space.peak_axial_mach for _, space in spaces(answer))
    choked = [gear for gear, space in spaces(answer) if space.axial_choked]
    state = f"an end of the {' and '.join(choked)} becomes sonic" if choked else "no end becomes sonic"
    finding = f"up to {number(peak)} with the exit faces; {state}"
    return Figure(finding, panels, beside=True)


def temperature_map(request: PumpingRequest, answer: PumpingResponse) -> Figure:
    """Stagnation temperature above ambient."""
    panels = _panels(
        request, answer, lambda field: field.temperature_rise_k, title="temperature rise", unit="K", scale=Scale.SIGNED
    )
    peak = max(float(np.nanmax(panel.map.values)) for panel in panels if panel.map is not None)
    finding = f"up to {number(peak, 'K')} above ambient for a moment; the teeth see the mean over the stroke"
    return Figure(finding, panels, beside=True)


def _panels(
    request: PumpingRequest,
    answer: PumpingResponse,
    read: Callable[[PumpingField], Rows | None],
    *,
    title: str,
    scale: Scale,
    unit: str | None = None,
    critical: tuple[Critical, ...] = (),
) -> tuple[Panel, ...]:
    """A map for each gear's spaces, all in the same colours, extremes marked."""
    fields = [(gear, present(space.field)) for gear, space in spaces(answer)]
    charts = {gear: read(field) for gear, field in fields}
    if any(rows is None for rows in charts.values()):
        raise NoFigure("no_temperature", "Incompressible flow has no temperatures", "model.flow")
    grids = {gear: matrix(present(rows)) for gear, rows in charts.items()}
    ends = min(float(grid.min()) for grid in grids.values()), max(float(grid.max()) for grid in grids.values())
    if scale is Scale.SIGNED and ends[0] >= 0.0:
        scale = Scale.MAGNITUDE
    panels = []
    for gear, field in fields:
        chart = Map(
            title=title,
            unit=unit,
            x=values(field.position_mm),
            y=values(field.angle_deg),
            values=grids[gear],
            scale=scale,
            critical=critical,
            range=_around(scale, *ends),
            bar=gear == fields[-1][0],
        )
        panels.append(
            Panel(
                x=Axis("position along the face", "mm", limits=(0.0, request.gears.face_width_mm)),
                y=Axis(f"angle of the {gear}", "°", magnitude=False),
                title=f"spaces of the {gear}",
                map=chart,
                marks=_extremes(chart, scale),
                spans=tuple(
                    Span(each.position_mm - each.width_mm / 2, each.position_mm + each.width_mm / 2, "")
                    for each in request.grooves
                ),
            )
        )
    return tuple(panels)


def _around(scale: Scale, low: float, high: float) -> tuple[float, float]:
    """Ends of the colours: as far below as above 1 by ratio or 0 by difference; a magnitude starts at zero."""
    if scale is Scale.RATIO:
        reach = max(high, 1.0 / max(low, 1e-3), 1.0001)
        return 1.0 / reach, reach
    reach = max(abs(low), abs(high), 1e-12)
    return (0.0 if scale is Scale.MAGNITUDE else -reach), reach


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
    Declaration("pressure-map", "Pressure in the tooth spaces", "Milian 2004, Eqs. 1-4", pressure_map, detail="fields"),
    Declaration("mach-map", "Axial flow in the tooth spaces", "Milian 2004, Eq. 7", mach_map, detail="fields"),
    Declaration(
        "temperature-map",
        "Temperature in the tooth spaces",
        "Milian 2004, Figs. 5, 6",
        temperature_map,
        detail="fields",
    ),
)


SPEEDS = 24
BEYOND = 1.5  # times the highest choking speed, where the scan ends
LOWEST = 0.25  # of that, where it starts
RPM = 30.0 / pi
TITLE, SOURCE = "Speeds at which the flow becomes sonic", "Milian 2004, Eq. 7"


def scan(request: ChokingSpeedRequest, answer: ChokingSpeedResponse) -> ChokingCurves:
    """Exit Mach number and peak pressure at evenly spaced speeds around the choking speeds."""
    found = [speed for _, speed in _choking(answer) if speed is not None]
    end = min(BEYOND * max(found), request.search_limit_rpm) if len(found) == 2 else request.search_limit_rpm
    start = min([LOWEST * end, *(0.8 * speed for speed in found)])
    return speed_scan(request.inputs().setup, np.linspace(start, end, SPEEDS) / RPM)


def choking(request: ChokingSpeedRequest, answer: ChokingSpeedResponse, curves: ChokingCurves) -> Figure:
    """Both against the limits of sonic flow, choking speeds marked."""
    x = Axis("pinion speed", "1/min", magnitude=False)
    speed, critical = values(curves.pinion_speed * RPM), critical_ratio(request)
    pressure, mach = values(curves.peak_pressure_ratio), values(curves.exit_mach)
    speeds = dict(_choking(answer))
    panels = (
        Panel(
            x=x,
            y=Axis("Mach number that the ambient pressure asks for at the ends"),
            lines=(Line("exit Mach number", speed, mach, named=False),),
            levels=(Level(1.0, "ends sonic", limit=True), *_at("ends", speeds["ends"])),
        ),
        Panel(
            x=x,
            y=Axis("peak pressure over ambient pressure"),
            lines=(Line("peak pressure", speed, pressure, Hue.VERMILLION, named=False),),
            levels=(
                Level(critical, f"clearances sonic, {number(critical)}", limit=True),
                *_at("clearances", speeds["clearances"]),
            ),
        ),
    )
    limit = number(request.search_limit_rpm, "1/min")
    onsets = (f"not up to {limit}" if at is None else f"from {number(at, '1/min')}" for at in speeds.values())
    texts = (f"{name} {onset}" for name, onset in zip(speeds, onsets, strict=True))
    return Figure(f"sonic: {', '.join(texts)}", panels, unsolved=int(np.isnan(mach).sum()))


def _choking(answer: ChokingSpeedResponse) -> tuple[tuple[str, float | None], ...]:
    return ("clearances", answer.radial_choking_speed_rpm), ("ends", answer.axial_choking_speed_rpm)


def _at(name: str, speed: float | None) -> tuple[Level, ...]:
    return () if speed is None else (Level(speed, f"{name}: {number(speed, '1/min')}", vertical=True),)


CHOKING_FIGURES = (Declaration("choking", TITLE, SOURCE, choking, detail="summary", compute=scan),)


HUES = {"pinion": Hue.BLUE, "wheel": Hue.VERMILLION}
NO_FLOW = 1e-9  # g/s
FACE = "position along the face from the end that meshes first"


def stroke(_: PumpingRequest, answer: PumpingResponse) -> Figure:
    """Section left by the mating tooth and its clearances; flanks in contact shaded."""
    gear, first = spaces(answer)[0]
    curves = present(first.stroke.curves)
    angle, area = values(curves.angle_deg), values(curves.area_mm2)
    contact = first.stroke.contact_start_deg, first.stroke.contact_end_deg
    least = int(np.argmin(area))
    x = Axis(f"angle of the {gear} from the line of centres", "°", magnitude=False)
    section = Panel(
        x=x,
        y=Axis("area left by the mating tooth", "mm²"),
        lines=(Line("area", angle, area, named=False),),
        spans=(Span(*contact, "driving flanks in contact"),),
        marks=(Mark(float(angle[least]), float(area[least]), number(float(area[least]), "mm²")),),
    )
    clearances = Panel(
        x=x,
        y=Axis("radial clearance", "mm"),
        lines=(
            Line("behind, L₁", angle, values(curves.clearance_left_mm), Hue.VERMILLION),
            Line("ahead, L₂", angle, values(curves.clearance_right_mm), Hue.GREEN),
        ),
        spans=(Span(*contact, ""),),
    )
    ends = f"{number(first.stroke.max_area_mm2)} to {number(first.stroke.min_area_mm2, 'mm²')}"
    finding = f"the {gear}'s space shrinks from {ends}"
    return Figure(finding, (section, clearances))


def heating(request: PumpingRequest, answer: PumpingResponse) -> Figure:
    """Stroke mean of the temperature along the face of both gears, hottest place marked."""
    lines, marks, texts = [], [], []
    for gear, space in spaces(answer):
        profile = present(space.profile)
        if profile.temperature_rise_k is None or space.max_temperature_rise_k is None:
            raise _without_temperatures()
        line = _along(request, gear, profile.position_mm, profile.temperature_rise_k, HUES[gear])
        lines.append(line)
        hottest = present(space.hottest_position_mm)
        marks.append(Mark(hottest, space.max_temperature_rise_k, number(space.max_temperature_rise_k, "K"), line.hue))
        texts.append(f"{gear} {number(space.max_temperature_rise_k, 'K')} at {number(hottest, 'mm')}")
    panel = Panel(
        x=_face(request),
        y=Axis("temperature rise above ambient", "K"),
        lines=tuple(lines),
        marks=tuple(marks),
        spans=_grooves(request),
    )
    finding = f"hottest: {', '.join(texts)}; of the gas, trends rather than kelvins of the teeth"
    return Figure(finding, (panel,))


def peak_pressure(request: PumpingRequest, answer: PumpingResponse) -> Figure:
    """Largest pressure of the stroke along the face, with the ratio at which clearances become sonic."""
    lines, marks = [], []
    for gear, space in spaces(answer):
        profile = present(space.profile)
        line = _along(request, gear, profile.position_mm, profile.peak_pressure_ratio, HUES[gear])
        at = int(np.nanargmax(line.y))
        lines.append(line)
        marks.append(Mark(float(line.x[at]), float(line.y[at]), ratio(float(line.y[at])), line.hue))
    critical = critical_ratio(request)
    panel = Panel(
        x=_face(request),
        y=Axis("largest pressure over ambient pressure"),
        lines=tuple(lines),
        marks=tuple(marks),
        levels=(Level(critical, f"clearances sonic from {number(critical)}", limit=True), Level(1.0, "ambient")),
        spans=_grooves(request),
    )
    choked = [gear for gear, space in spaces(answer) if space.radial_choked]
    state = f"clearances of the {' and '.join(choked)} become sonic" if choked else "no clearance becomes sonic"
    return Figure(state, (panel,))


def lead_correction(request: PumpingRequest, answer: PumpingResponse) -> Figure:
    """Thermal growth of the pinion's flank and what undoes it."""
    lead = answer.lead_correction
    if lead is None:
        raise NoFigure(
            "no_lead_correction", "A lead correction needs the temperatures of the pinion's spaces", "model.spaces"
        )
    curves = present(lead.curves)
    panel = Panel(
        x=_face(request),
        y=Axis("normal to the flank of the pinion", "µm", magnitude=False),
        lines=(
            _along(request, "growth", curves.position_mm, curves.growth_um, Hue.VERMILLION),
            replace(
                _along(request, "by the radius alone", curves.position_mm, curves.radial_only_um, Hue.VERMILLION),
                role=Role.REFERENCE,
            ),
            _along(request, "correction", curves.position_mm, curves.correction_um, Hue.BLUE),
        ),
        spans=_grooves(request),
    )
    shape = f"slope {number(lead.slope_um, 'µm')}, crown {number(lead.crown_um, 'µm')}"
    finding = f"growth ranges over {number(lead.range_um, 'µm')}; {shape}"
    return Figure(finding, (panel,))


def pulsation(_: PumpingRequest, answer: PumpingResponse) -> Figure:
    """Amplitudes of the mass flow at both ends by multiples of the meshing frequency."""
    pulse, total = present(answer.pulsation), present(answer.total)
    orders = values([float(order) for order in range(1, len(pulse.frequency_hz) + 1)])
    series = (
        Bars("end that meshes first", orders, values(pulse.front_mass_flow_g_per_s), Hue.BLUE),
        Bars("end that meshes last", orders, values(pulse.rear_mass_flow_g_per_s), Hue.VERMILLION),
    )
    frequency = number(total.meshing_frequency_hz, "Hz")
    panel = Panel(
        x=Axis(f"multiple of the meshing frequency of {frequency}", magnitude=False, ticks=tuple(orders.tolist())),
        y=Axis("amplitude of the mass flow", "g/s"),
        bars=series,
    )
    peak = max(float(each.height.max()) for each in series)
    return Figure(f"up to {number(peak, 'g/s')}", (panel,))


def mass_flow(_: PumpingRequest, answer: PumpingResponse) -> Figure:
    """What leaves and enters the tooth spaces of each gear at the ends, and the net flow out by exit."""
    exits = {gear: _exits(space) for gear, space in spaces(answer)}
    still = all(abs(row.value) < NO_FLOW for rows in exits.values() for row in rows)
    x = Axis("mass flow (net: out; negative: in)", "g/s", limits=(0.0, 1.0) if still else None)
    panels = tuple(Panel(x=x, y=Axis("exit"), title=f"spaces of the {gear}", rows=rows) for gear, rows in exits.items())
    flows = [space.mass_flow_g_per_s for _, space in spaces(answer)]
    net = sum(flow.front + flow.rear for flow in flows)
    out = number(sum(flow.front_out + flow.rear_out for flow in flows), "g/s")
    way = "leave" if net > 0.0 else "enter"
    balance = f"{number(abs(net), 'g/s')} {way} net" if abs(net) > NO_FLOW else "as much enters"
    finding = f"{out} leave through the ends of the face, {balance}; the net flows of a gear sum to zero"
    return Figure("nothing flows" if still else finding, panels)


def _exits(space: PumpingSpaces) -> tuple[Row, ...]:
    flow, known = space.mass_flow_g_per_s, space.mass_flow_g_per_s.net_uncertainty
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


def _face(request: PumpingRequest) -> Axis:
    return Axis(FACE, "mm", limits=(0.0, request.gears.face_width_mm))


def _grooves(request: PumpingRequest) -> tuple[Span, ...]:
    halves = ((groove.position_mm, groove.width_mm / 2.0) for groove in request.grooves)
    return tuple(Span(middle - half, middle + half, "groove") for middle, half in halves)


def _along(request: PumpingRequest, title: str, position: list[float], items: list[float], hue: Hue) -> Line:
    """A line along the face, broken where a groove is."""
    x, y = values(position), values(items)
    middles = np.array(sorted(groove.position_mm for groove in request.grooves))
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
    Declaration(
        "mass-flow", "Where the mist leaves and enters the tooth spaces", "Milian 2004", mass_flow, detail="summary"
    ),
)
