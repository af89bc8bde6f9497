"""Figure of the choking speeds: the answer knows where they are, a scan of its own shows how they come about."""

from math import pi

import numpy as np

from app.figures.data import Axis, Figure, Hue, Level, Line, Panel, values
from app.figures.declaration import Declaration
from app.figures.models.pumping_maps import critical_ratio
from app.figures.wording import number
from app.schema.pumping import ChokingSpeedRequest, ChokingSpeedResponse
from solvers.pumping.results import ChokingCurves
from solvers.pumping.speed_scan import speed_scan

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


FIGURES = (Declaration("choking", TITLE, SOURCE, choking, detail="summary", compute=scan),)
