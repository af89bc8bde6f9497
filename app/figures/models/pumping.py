"""Figures of the mist pumped between gear teeth: along the face, over the stroke, at the ends."""

from dataclasses import replace

import numpy as np

from app.figures.data import (
    Axis,
    Bars,
    Figure,
    Hue,
    Level,
    Line,
    Mark,
    NoFigure,
    Panel,
    Role,
    Row,
    Span,
    values,
)
from app.figures.declaration import Declaration, present
from app.figures.models.pumping_maps import MAPS, critical_ratio, spaces
from app.figures.wording import number, ratio
from app.schema.pumping import PumpingRequest, PumpingResponse, PumpingSpaces

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
