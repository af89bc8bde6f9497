"""Figures of the warm-up of a unit: temperatures, face load factor and safety factor over time."""

import numpy as np

from app.figures.data import Axis, Figure, Hue, Level, Line, Mark, Panel
from app.figures.declaration import Declaration
from app.figures.units import axis
from app.figures.wording import number
from solvers.drive_train.warm_up import AlignmentOverTime, UnitWarmUp, WarmUpInputs
from solvers.heat_balance.warm_up import WarmUpCurves

OWN = "own derivation, heat balance"
HUES = {
    "pinion_flank": Hue.VERMILLION,
    "pinion_body": Hue.ORANGE,
    "wheel_flank": Hue.PURPLE,
    "wheel_body": Hue.BLUE,
    "mist": Hue.SKY,
    "casing": Hue.GREY,
}


def temperatures(_: WarmUpInputs, result: UnitWarmUp) -> Figure:
    """Draw the temperatures of all nodes over time."""
    course = result.warm_up
    curves, time = course.curves, axis(WarmUpCurves, "time")
    bearings = [name for name in course.nodes if name not in HUES]
    lines = [
        Line(
            name.replace("_", " "),
            curves.time,
            curves.temperature[:, place],
            HUES.get(name, Hue.GREEN),
            stroke=bearings.index(name) if name in bearings else 0,
        )
        for place, name in enumerate(course.nodes)
    ]
    difference = Line("pinion over wheel", curves.time, curves.difference, Hue.VERMILLION, named=False)
    at, greatest = course.greatest_difference_at, course.greatest_difference
    mark = Mark(at, greatest, f"{number(greatest, 'K')} after {number(at, 's')}", difference.hue)
    finding = f"pinion's body {number(abs(greatest), 'K')} {'over' if greatest > 0.0 else 'below'} the wheel's"
    return Figure(
        f"{finding} after {number(at, 's')}",
        [
            Panel(x=time, y=Axis("temperature", "°C", magnitude=False, symbol="θ"), lines=lines),
            Panel(x=time, y=axis(WarmUpCurves, "difference"), lines=[difference], marks=[mark]),
        ],
    )


def alignment(_: WarmUpInputs, result: UnitWarmUp) -> Figure:
    """Draw the face load factor and the safety factor at five points in time of the warm-up."""
    own, time = result.alignment, axis(AlignmentOverTime, "time", "time")
    factor = Line("face load factor", own.time, own.face_load_factor, Hue.BLUE, named=False)
    factor_axis = axis(AlignmentOverTime, "face_load_factor", magnitude=False)
    finite = [place for place, value in enumerate(own.face_load_factor) if np.isfinite(value)]
    marks = [factor.mark(place, number(float(own.face_load_factor[place]))) for place in finite]
    panels, finding = [Panel(x=time, y=factor_axis, lines=[factor], marks=marks)], ""
    if result.largest_face_load_factor is not None:
        finding = f"K_Hβ up to {number(result.largest_face_load_factor)}"
    if np.isfinite(own.safety).any():
        line = Line("safety", own.time, own.safety, Hue.VERMILLION, named=False)
        marks = [line.mark(place, number(value)) for place, value in enumerate(own.safety) if np.isfinite(value)]
        limit = Level(1.0, "scuffing below 1", limit=True)
        panels.append(Panel(x=time, y=axis(AlignmentOverTime, "safety"), lines=[line], levels=[limit], marks=marks))
        finding = f"{finding}, safety down to {number(float(np.nanmin(own.safety)))}"
    return Figure(finding or "no load", panels)


FIGURES = (
    Declaration("warm-up", "Temperatures of the unit as it warms up", OWN, temperatures),
    Declaration("alignment", "Load and safety of the flanks as the unit warms up", OWN, alignment),
)
