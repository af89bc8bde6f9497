"""Figures of pumping between the teeth: over the stroke, along the face, over face and angle, and over the speed."""

from dataclasses import replace

import numpy as np

from app.figures import parts
from app.figures.data import Axis, Figure, Hue, Level, Line, Map, Mark, NoFigure, Panel, Role, Row, Scale, Span, Values
from app.figures.declaration import Declaration, present
from app.figures.units import MM, RPM, axis, shown
from app.figures.wording import UNCERTAIN, number, percent, ratio, without_rounding
from app.models.load_distribution.figures import face, section
from solvers.pumping.inputs import ChokingInputs, Flow, PumpingInputs, PumpingSetup
from solvers.pumping.results import ChokingCurves, ChokingSpeeds, FaceProfile, PumpingResult, SpacesResult
from solvers.pumping.speed_scan import speed_scan

HUES = {"pinion": Hue.BLUE, "wheel": Hue.VERMILLION}
NO_FLOW = 1e-9  # g/s; smaller flows count as no flow
SPEEDS = 24  # number of speeds in the scan; chosen so that the curve looks smooth
BEYOND = 1.5  # highest speed of the scan, divided by the highest choking speed
LOWEST = 0.25  # lowest speed of the scan, divided by the highest speed of the scan


def spaces(result: PumpingResult) -> list[tuple[str, SpacesResult]]:
    """Return the calculated tooth spaces with the names of their gears."""
    both = (("pinion", result.pinion_spaces), ("wheel", result.wheel_spaces))
    return [(gear, space) for gear, space in both if space is not None]


def critical_ratio(setup: PumpingSetup) -> float:
    """Return the ratio of pressure to ambient pressure at which flow into the surroundings becomes sonic (Eq. 7)."""
    exponent = setup.ambient.isentropic_exponent
    return float(((exponent + 1.0) / 2.0) ** (exponent / (exponent - 1.0)))


def pressure_map(inputs: PumpingInputs, result: PumpingResult) -> Figure:
    """Draw the ratio of pressure to ambient pressure. A contour shows where the flow in clearances becomes sonic."""
    sonic = critical_ratio(inputs.setup)
    panels = _maps(inputs, result, "pressure_ratio", Scale.RATIO, Level(sonic, f"sonic {number(sonic)}"))
    peak = max(space.peak_pressure_ratio for _, space in spaces(result))
    least = min(space.min_pressure_ratio for _, space in spaces(result))
    return Figure(f"highest {ratio(peak)}, lowest {ratio(least)} of ambient pressure", panels, beside=True)


def mach_map(inputs: PumpingInputs, result: PumpingResult) -> Figure:
    """Draw the magnitude of the axial Mach number. A contour shows where the flow is sonic."""
    panels = _maps(inputs, result, "axial_mach", Scale.MAGNITUDE, Level(1.0, "sonic"))
    peak = max(space.peak_axial_mach for _, space in spaces(result))
    marked = number(max(float(np.nanmax(panel.map.values)) for panel in panels if panel.map is not None))
    most = number(peak)
    choking = result.choking
    outwards = f"{number(choking.outflow_mach)} outwards ({choking.outflow})"
    inwards = f"{number(choking.inflow_mach)} inwards ({choking.inflow})"
    inside = "; supersonic inside" if peak > 1.0 and choking.outflow == "not choked" else ""
    uncertain = result.resolution.axial_mach
    doubt = f" ± {percent(uncertain)}" if uncertain > UNCERTAIN else ""
    largest = f"up to {marked} in the slices (marked), {most}{doubt} at the ends"
    if marked == most:
        largest = f"up to {most}{doubt} in the slices (marked) and at the ends"
    asked = f"the pressures at the ends ask for {outwards} and {inwards}"
    return Figure(f"{largest}; {asked}{inside}", panels, beside=True)


def temperature_map(inputs: PumpingInputs, result: PumpingResult) -> Figure:
    """Draw the rise of the stagnation temperature above the ambient temperature."""
    panels = _maps(inputs, result, "temperature_rise", Scale.SIGNED)
    peak = max(float(np.nanmax(panel.map.values)) for panel in panels if panel.map is not None)
    finding = f"up to {number(peak, 'K')} above ambient for a moment; the teeth see the mean over the stroke"
    return Figure(finding, panels, beside=True)


def _maps(inputs: PumpingInputs, result: PumpingResult, name: str, scale: Scale, *critical: Level) -> list[Panel]:
    """Return a map of the quantity `name` over face and angle for the tooth spaces of each gear."""
    fields = {gear: space.field for gear, space in spaces(result)}
    grids: list[Values] = [getattr(field, name) for field in fields.values()]
    if any(grid is None for grid in grids):
        raise _without_temperatures()
    # The smallest value of a ratio matters as much as the largest value, so both are marked.
    wording, extremes = (ratio, (False, True)) if scale is Scale.RATIO else (number, (False,))
    panels = []
    for gear, field in fields.items():
        quantity = axis(field, name)
        chart = Map(quantity.title, quantity.unit, field.position, field.angle, getattr(field, name), scale, critical)
        chart = replace(chart, range=replace(chart, values=np.array(grids).ravel()).ends, bar=gear == [*fields][-1])
        panel = Panel(
            x=face(inputs.setup.gears.face_width),
            y=axis(field, "angle", f"angle of the {gear}", magnitude=False),
            title=f"spaces of the {gear}",
            map=chart,
            marks=[parts.extreme_of_map(chart, wording, least=least) for least in extremes],
            spans=parts.unnamed(_grooves(inputs)),
        )
        panels.append(panel)
    return panels


def scan(inputs: ChokingInputs, result: ChokingSpeeds) -> ChokingCurves:
    """Compute Mach numbers and peak pressure at evenly spaced speeds around the choking speeds."""
    outwards = result.radial_choking_speed, result.axial_choking_speed
    speeds = [speed for speed in (*outwards, result.inflow_choking_speed) if speed is not None]
    limit = inputs.search_limit / RPM
    end = limit if None in outwards else min(BEYOND * max(speeds), limit)  # many inflows choke nowhere
    start = min([LOWEST * end, *(0.8 * speed for speed in speeds)])
    return shown(speed_scan(inputs.setup, np.linspace(start, end, SPEEDS) * RPM))


def choking(inputs: ChokingInputs, result: ChokingSpeeds, curves: ChokingCurves) -> Figure:
    """Draw peak pressure and the Mach numbers of outflow and inflow over the speed.

    Lines show the pressure and the Mach number at which the flow becomes sonic. Further lines show the choking speeds.

    The exit Mach number is the Mach number after an expansion to ambient pressure. But if the gas in the outermost
    slice is supersonic, which only the gas-dynamics model can compute, the Mach number in this slice is drawn. The Mach
    number in the slice is smaller than the Mach number after the expansion. The curve therefore bends at the speed at
    which the gas in the slice becomes supersonic.
    """
    critical, mach, peak = critical_ratio(inputs.setup), curves.exit_mach, curves.peak_pressure_ratio
    clearances = [Level(critical, f"clearances sonic, {number(critical)}", limit=True)]
    ends = [Level(1.0, "ends sonic", limit=True)]
    filling = [Level(1.0, "inflow sonic", limit=True)]
    texts = []
    for name, speed, levels in (
        ("clearances", result.radial_choking_speed, clearances),
        ("outflow", result.axial_choking_speed, ends),
        ("inflow", result.inflow_choking_speed, filling),
    ):
        if speed is None:
            texts.append(f"{name} not up to {number(inputs.search_limit / RPM, '1/min')}")
        else:
            texts.append(f"{name} from {number(speed, '1/min')}")
            levels.append(Level(speed, f"{name}: {number(speed, '1/min')}", vertical=True))
    x = axis(curves, "pinion_speed", "pinion speed", magnitude=False)
    demand = axis(curves, "exit_mach", "Mach number that the ambient pressure asks for at the ends")
    inflow = axis(curves, "inflow_mach", "Mach number of the air that fills the spaces")
    pressure = axis(curves, "peak_pressure_ratio", "peak pressure over ambient pressure")
    panels = [
        parts.curve(x, demand, curves.pinion_speed, mach, levels=ends),
        parts.curve(x, inflow, curves.pinion_speed, curves.inflow_mach, Hue.SKY, levels=filling),
        parts.curve(x, pressure, curves.pinion_speed, peak, Hue.VERMILLION, levels=clearances),
    ]
    bend = inputs.setup.model.flow is Flow.GAS_DYNAMICS and np.nanmax(mach, initial=0.0) > 1.0
    bends = "; the curve bends where the gas reaches an end faster than sound" if bend else ""
    return Figure(f"sonic: {', '.join(texts)}{bends}", panels, unsolved=int(np.isnan(mach).sum()))


CHOKING_FIGURES = (
    Declaration("choking", "Speeds at which the flow becomes sonic", "Milian 2004, Eq. 7", choking, compute=scan),
)


def stroke(_: PumpingInputs, result: PumpingResult) -> Figure:
    """Draw the free area of a tooth space over one stroke, and below it the radial clearances over the same stroke."""
    gear, first = spaces(result)[0]
    course, curves = first.stroke, first.stroke.curves
    x = axis(curves, "angle", f"angle of the {gear} from the line of centres", magnitude=False)
    area = axis(curves, "area", "area left by the mating tooth")
    contact = [Span(course.contact_start, course.contact_end, "driving flanks in contact")]
    left = parts.curve(x, area, curves.angle, curves.area, spans=contact)
    clearances = [
        Line("behind, L₁", curves.angle, curves.clearance_left, Hue.VERMILLION),
        Line("ahead, L₂", curves.angle, curves.clearance_right, Hue.GREEN),
    ]
    y = Axis("radial clearance", "mm", symbol="L")
    panels = [
        replace(left, marks=parts.extreme(left.lines, area.unit, least=True)),
        Panel(x=x, y=y, lines=clearances, spans=parts.unnamed(contact)),
    ]
    return Figure(
        f"the {gear}'s space shrinks from {number(course.max_area)} to {number(course.min_area, 'mm²')}", panels
    )


def heating(inputs: PumpingInputs, result: PumpingResult) -> Figure:
    """Draw, along the face, the temperature rise averaged over the stroke, with marks at the hottest places."""
    lines, marks, texts = [], [], []
    for gear, space in spaces(result):
        profile, most = space.profile, space.max_temperature_rise
        if profile.temperature_rise is None or most is None:
            raise _without_temperatures()
        place = present(space.hottest_position)
        lines.append(_along(inputs, gear, profile.position, profile.temperature_rise, HUES[gear]))
        marks.append(Mark(place, most, number(most, "K"), HUES[gear]))
        texts.append(f"{gear} {number(most, 'K')} at {number(place, 'mm')}")
    x, y = face(inputs.setup.gears.face_width), axis(FaceProfile, "temperature_rise", "temperature rise above ambient")
    finding = f"hottest: {', '.join(texts)}; of the gas, trends rather than kelvins of the teeth"
    return Figure(finding, [Panel(x=x, y=y, lines=lines, marks=marks, spans=_grooves(inputs))])


def peak_pressure(inputs: PumpingInputs, result: PumpingResult) -> Figure:
    """Draw, along the face, the largest pressure of the stroke."""
    lines, marks = [], []
    for gear, space in spaces(result):
        line = _along(inputs, gear, space.profile.position, space.profile.peak_pressure_ratio, HUES[gear])
        at = int(np.nanargmax(line.y))
        lines.append(line)
        marks.append(line.mark(at, ratio(float(line.y[at]))))
    critical = critical_ratio(inputs.setup)
    panel = Panel(
        x=face(inputs.setup.gears.face_width),
        y=axis(FaceProfile, "peak_pressure_ratio", "largest pressure over ambient pressure"),
        lines=lines,
        marks=marks,
        levels=[Level(critical, f"sonic from {number(critical)}", limit=True), Level(1.0, "ambient")],
        spans=_grooves(inputs),
    )
    choked = [gear for gear, space in spaces(result) if space.radial_choked]
    state = f"clearances of the {' and '.join(choked)} become sonic" if choked else "no clearance becomes sonic"
    return Figure(state, [panel])


def lead_correction(inputs: PumpingInputs, result: PumpingResult) -> Figure:
    """Draw the thermal growth of the pinion's flank, and the lead correction that compensates this growth."""
    lead = result.lead_correction
    if lead is None:
        message = (
            "The lead correction is computed from the temperatures in the tooth spaces of the pinion; these "
            "temperatures were not computed"
        )
        raise NoFigure("no_lead_correction", message, "model.spaces")
    curves = lead.curves
    radial = _along(inputs, "by the radius alone", curves.position, curves.radial_only, Hue.VERMILLION)
    lines = [
        _along(inputs, "growth", curves.position, curves.growth, Hue.VERMILLION),
        replace(radial, role=Role.REFERENCE),
        _along(inputs, "correction", curves.position, curves.correction, Hue.BLUE),
    ]
    x = face(inputs.setup.gears.face_width)
    y = Axis("normal to the flank of the pinion", "µm", magnitude=False, symbol="C")
    slope, crown = (number(without_rounding(part, lead.range), "µm") for part in (lead.slope, lead.crown))
    finding = f"growth ranges over {number(lead.range, 'µm')}; slope {slope}, crown {crown}"
    return Figure(finding, [Panel(x=x, y=y, lines=lines, spans=_grooves(inputs))])


def pulsation(_: PumpingInputs, result: PumpingResult) -> Figure:
    """Draw the amplitudes of the mass flows at both ends over the multiples of the meshing frequency."""
    pulse, frequency = result.pulsation, number(result.total.meshing_frequency, "Hz")
    series = {"end that meshes first": pulse.front_mass_flow, "end that meshes last": pulse.rear_mass_flow}
    amplitude = Axis("amplitude of the mass flow", "g/s", symbol="m_k")
    panel = parts.orders(f"multiple of the meshing frequency of {frequency}", amplitude, 1, series)
    return Figure(f"up to {number(max(float(flow.max()) for flow in series.values()), 'g/s')}", [panel])


def mass_flow(_: PumpingInputs, result: PumpingResult) -> Figure:
    """Draw the mass flows of the tooth spaces.

    Three bars belong to each end of the face: outflow, inflow and net outflow. For radial clearances and grooves, only
    the net outflow is drawn. One more bar belongs to no end of the face and is the sum of two parts. The first part is
    the mass that slices lose between two strokes, because ambient gas replaces the gas in these slices. The second part
    is the mass that flows from slices in their stroke to slices outside their stroke.
    """
    exits = {gear: _exits(space) for gear, space in spaces(result)}
    still = all(abs(row.value) < NO_FLOW for rows in exits.values() for row in rows)
    x = Axis(
        "mass flow (negative net flow: in; black: uncertainty)", "g/s", limits=(0.0, 1.0) if still else None, symbol="m"
    )
    panels = [Panel(x=x, y=Axis("exit"), title=f"spaces of the {gear}", rows=rows) for gear, rows in exits.items()]
    flows = [space.mass_flow for _, space in spaces(result)]
    net = sum(flow.front + flow.rear for flow in flows)
    out = number(sum(flow.front_out + flow.rear_out for flow in flows), "g/s")
    way = "leave" if net > 0.0 else "enter"
    balance = f"{number(abs(net), 'g/s')} {way} net" if abs(net) > NO_FLOW else "as much enters"
    finding = f"{out} leave through the ends of the face, {balance}; the net flows of a gear sum to zero"
    return Figure("nothing flows" if still else finding, panels)


def _exits(space: SpacesResult) -> list[Row]:
    flow, error = space.mass_flow, space.mass_flow.net_uncertainty
    return [
        Row("first end: out", flow.front_out, Hue.BLUE),
        Row("first end: in", flow.front_in, Hue.BLUE),
        Row("first end: net", flow.front, Hue.BLUE, (flow.front - error, flow.front + error)),
        Row("last end: out", flow.rear_out, Hue.VERMILLION),
        Row("last end: in", flow.rear_in, Hue.VERMILLION),
        Row("last end: net", flow.rear, Hue.VERMILLION, (flow.rear - error, flow.rear + error)),
        Row("radial clearances: net", flow.radial, Hue.GREEN),
        Row("grooves: net", flow.grooves, Hue.ORANGE),
        Row("given back between strokes", flow.reset, Hue.GREY),
    ]


def _grooves(inputs: PumpingInputs) -> list[Span]:
    halves = ((groove.position / MM, groove.width / 2.0 / MM) for groove in inputs.setup.grooves)
    return [Span(middle - half, middle + half, "groove") for middle, half in halves]


def _along(inputs: PumpingInputs, title: str, position: Values, items: Values, hue: Hue) -> Line:
    """Return a line along the face. The line has gaps at the grooves."""
    middles = sorted(groove.position / MM for groove in inputs.setup.grooves)
    at = np.searchsorted(position, middles)
    return Line(title, np.insert(position, at, middles), np.insert(items, at, np.nan), hue)


def _without_temperatures() -> NoFigure:
    return NoFigure("no_temperature", "Incompressible flow has no temperatures", "model.flow")


FIGURES = (
    Declaration("mach-map", "Axial flow in the tooth spaces", "Milian 2004, Eq. 7", mach_map),
    Declaration("peak-pressure", "Highest pressure along the face", "Milian 2004, Eq. 7", peak_pressure),
    Declaration("temperature-map", "Temperature in the tooth spaces", "Milian 2004, Figs. 5, 6", temperature_map),
    Declaration("pressure-map", "Pressure in the tooth spaces", "Milian 2004, Eqs. 1–4", pressure_map),
    section(lambda inputs: inputs.setup.gears),
    Declaration("stroke", "One stroke of a tooth space", "Milian 2004, Fig. 3", stroke),
    Declaration("heating", "Where along the face the mist heats the teeth", "Milian 2004, Figs. 5, 6", heating),
    Declaration("lead-correction", "Lead correction against thermal growth", "Milian 2004", lead_correction),
    Declaration("pulsation", "Pulsating flow at the ends of the face", "Milian 2004", pulsation),
    Declaration("mass-flow", "Where the mist leaves and enters the tooth spaces", "Milian 2004", mass_flow),
)
