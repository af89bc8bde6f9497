"""Figures of the floating sleeve and of the recommended crowning."""

import numpy as np

from app.figures.data import Axis, Bars, Figure, Hue, Level, Line, Mark, NoFigure, Panel, Span, Values, values
from app.figures.declaration import Declaration, present
from app.figures.wording import number
from app.schema.coupling import RecommendationRequest, RecommendationResponse, SleeveOrbitRequest, SleeveOrbitResponse
from solvers.coupling.friction.regimes import CAPACITY_BOUNDARIES, OVERLAP_BOUNDARIES

ROTOR = Axis(
    "rotor angle θ", "°", limits=(0.0, 360.0), ticks=(0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0, 360.0)
)
ORBIT_SOURCE = "Pahl 1978, Fig. 5"
CONSTRAINTS = {
    "contact_overlap": "the overlap cannot fall below 1",
    "edge_contact": "the contact leaves the face",
    "hertz_pressure": "the Hertz pressure is too high",
    "contact_width": "the contact is too wide",
    "sliding_velocity": "the teeth slide too fast",
}


def orbit(_: SleeveOrbitRequest, answer: SleeveOrbitResponse) -> Figure:
    """Path of the sleeve centre in equal axes."""
    path = present(answer.orbit)
    x, y = values([*path.x_um, path.x_um[0]]), values([*path.y_um, path.y_um[0]])
    farthest = int(np.argmax(np.hypot(x, y)))
    largest = present(answer.max_displacement_um)
    panel = Panel(
        x=Axis("displacement in the pivot direction at θ = 0", "µm", magnitude=False),
        y=Axis("displacement along the tilt axis", "µm", magnitude=False),
        lines=(Line("path", x, y, named=False),),
        marks=(Mark(float(x[farthest]), float(y[farthest]), number(largest, "µm")),),
        levels=(Level(0.0, ""), Level(0.0, "", vertical=True)),
        equal=True,
    )
    finding = f"the centre strays up to {number(largest, 'µm')} from the axis"
    return Figure(finding, (panel,))


def inertia_force(_: SleeveOrbitRequest, answer: SleeveOrbitResponse) -> Figure:
    """Inertia force of the sleeve in both directions over the revolution."""
    path, force = present(answer.orbit), present(answer.inertia_force)
    angle = values([*path.rotor_angle_deg, path.rotor_angle_deg[0] + 360.0])
    lines = []
    for title, items, hue in (("along x", force.x_n, Hue.BLUE), ("along y", force.y_n, Hue.VERMILLION)):
        curve = present(items)
        lines.append(Line(title, angle, values([*curve, curve[0]]), hue))
    strongest = max(lines, key=lambda line: float(np.abs(line.y).max()))
    at = int(np.argmax(np.abs(strongest.y)))
    value = float(strongest.y[at])
    panel = Panel(
        x=ROTOR,
        y=Axis("inertia force of the sleeve mass of one mesh", "N", magnitude=False),
        lines=tuple(lines),
        marks=(Mark(float(angle[at]), value, number(value, "N"), strongest.hue),),
    )
    return Figure(f"up to {number(abs(value), 'N')} {strongest.title}", (panel,))


def orders(_: SleeveOrbitRequest, answer: SleeveOrbitResponse) -> Figure:
    """Harmonics of the inertia force."""
    force = present(answer.inertia_force)
    order = values([float(order) for order in range(len(force.harmonics_x_n))])
    series = (
        Bars("along x", order, values(force.harmonics_x_n), Hue.BLUE),
        Bars("along y", order, values(force.harmonics_y_n), Hue.VERMILLION),
    )
    panel = Panel(
        x=Axis("order of the revolution (0: the mean)", magnitude=False, ticks=tuple(order.tolist())),
        y=Axis("amplitude of the inertia force", "N"),
        bars=series,
    )
    both = np.hypot(series[0].height, series[1].height)[1:]
    finding = f"strongest at order {int(np.argmax(both)) + 1}" if both.any() else "no force"
    return Figure(finding, (panel,))


def crowning_scan(request: RecommendationRequest, answer: RecommendationResponse) -> Figure:
    """Least load capacity and largest overlap over the crowning ratio, the feasible window and the choice."""
    scan = present(answer.scan)
    if not scan.crowning_ratio:
        raise NoFigure("no_contact_to_scan", "No crowning ratio gives a contact that can be computed")
    ratio, feasible = values(scan.crowning_ratio), values([float(each) for each in scan.feasible])
    x = Axis("crowning ratio ε (left: heavily, right: slightly crowned)", log=True)
    best = answer.crowning_ratio
    capacity, overlap = values(scan.min_load_capacity_coefficient), values(scan.max_contact_overlap)
    window = _window(ratio, feasible, best)
    choice = () if best is None else (Level(best, "", vertical=True),)
    chosen = present(answer.min_load_capacity_coefficient) if best is not None else np.nan
    boundaries = tuple(Level(each, f"Tr = {each:g}") for each in CAPACITY_BOUNDARIES)
    panels = (
        Panel(
            x=x,
            y=Axis("least load capacity coefficient Tr over the range", log=True, limits=_decades_shown(capacity)),
            lines=(Line("least Tr", ratio, capacity, named=False),),
            levels=(*boundaries, *choice),
            spans=window,
            marks=() if best is None else (Mark(best, chosen, f"ε = {number(best)}, Tr = {number(chosen)}"),),
        ),
        Panel(
            x=x,
            y=Axis("largest overlap Pu over the range", log=True),
            lines=(Line("largest Pu", ratio, overlap, Hue.GREEN, named=False),),
            levels=(Level(OVERLAP_BOUNDARIES[0], "Pu = 1: supply of oil ends", limit=True), *choice),
            spans=tuple(Span(span.start, span.stop, "") for span in window),
        ),
    )
    low, high = request.operation.misalignment_range_deg
    return Figure(_choice(answer), panels, title=f"Crowning for {number(low)}° to {number(high)}°")


def _window(ratio: Values, feasible: Values, best: float | None) -> tuple[Span, ...]:
    inside = [*ratio[feasible > 0.0].tolist(), *([] if best is None else [best])]
    return (Span(min(inside), max(inside), "feasible"),) if inside else ()


def _decades_shown(capacity: Values) -> tuple[float, float]:
    """Down to a thousandth of the best: where the film tears off, its capacity falls to nothing."""
    top = 10.0 ** np.ceil(np.log10(max(float(np.nanmax(capacity)), CAPACITY_BOUNDARIES[1])))
    return top / 1e4, top


def _choice(answer: RecommendationResponse) -> str:
    if answer.crowning_ratio is None:
        failed = answer.failed_constraint or ""
        return f"no crowning serves this range: {CONSTRAINTS.get(failed, failed.replace('_', ' '))}"
    capacity = present(answer.min_load_capacity_coefficient)
    overlap = max(present(answer.at_min).contact_overlap, present(answer.at_max).contact_overlap)
    return f"ε = {number(answer.crowning_ratio)}: least Tr = {number(capacity)} with Pu up to {number(overlap)}"


ORBIT_FIGURES = (
    Declaration("orbit", "Path of the sleeve centre over one revolution", ORBIT_SOURCE, orbit),
    Declaration("inertia-force", "Inertia force of the sleeve", ORBIT_SOURCE, inertia_force),
    Declaration("orders", "Orders of the sleeve's inertia force", ORBIT_SOURCE, orders),
)
RECOMMENDATION_FIGURES = (
    Declaration("crowning-scan", "Crowning for a range of misalignment", "Pahl 1978, conclusion", crowning_scan),
)
