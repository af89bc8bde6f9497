"""Figures of the tooth spaces over face and angle: pressure, Mach number, temperature."""

from collections.abc import Callable

import numpy as np

from app.figures.data import Axis, Critical, Figure, Map, Mark, NoFigure, Panel, Scale, Span, matrix, values
from app.figures.declaration import Declaration, present
from app.figures.wording import number, ratio
from app.schema.pumping import ChokingSpeedRequest, PumpingField, PumpingRequest, PumpingResponse, PumpingSpaces

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
