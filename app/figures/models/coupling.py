"""Figures of the couplings: friction map, loads, motion, thrust and losses; sleeve orbit; recommended crowning."""

from math import degrees, exp, inf, log

import numpy as np

from app.figures.data import (
    Area,
    Axis,
    Bars,
    Figure,
    Hue,
    Level,
    Line,
    Mark,
    NoFigure,
    Panel,
    Ribbon,
    Role,
    Row,
    Span,
    Values,
    values,
)
from app.figures.declaration import Declaration, present
from app.figures.units import UM, axis
from app.figures.wording import number, percent
from solvers.coupling.crowning import Recommendation
from solvers.coupling.inputs import CouplingInputs, RecommendationInputs
from solvers.coupling.lubrication import CAPACITY_BOUNDARIES, OVERLAP_BOUNDARIES, friction_regime
from solvers.coupling.results import CouplingResult, KinematicCurves, LoadCurves, OrbitResult

MAP_ENDS = {"overlap": (0.1, 10.0), "capacity": (0.01, 10.0)}


def friction_map(_: CouplingInputs, result: CouplingResult) -> Figure:
    """Supply of oil against strength of film, with the nine areas and the distance to the next."""
    lubrication = result.lubrication
    regime = lubrication.regime
    overlap, capacity = _shown(lubrication.contact_overlap), _shown(lubrication.load_capacity_coefficient)
    x = Axis(
        "contact surface overlap Pu (right: worse supply of oil)",
        log=True,
        limits=_around("overlap", overlap),
        ticks=_ticks(*OVERLAP_BOUNDARIES),
    )
    y = Axis(
        "load capacity coefficient Tr (up: stronger film)",
        log=True,
        limits=_around("capacity", capacity),
        ticks=_ticks(*CAPACITY_BOUNDARIES),
    )
    assert x.limits is not None
    assert y.limits is not None
    at = min(max(overlap, x.limits[0]), x.limits[1]), min(max(capacity, y.limits[0]), y.limits[1])
    distance = regime.distance_to_boundary
    away = "" if distance is None else f", a factor {number(exp(distance))} from the next area"
    return Figure(
        finding=f"area {regime.area}, {regime.name}{away}; μ = {number(lubrication.friction_coefficient)}",
        panels=(
            Panel(
                x=x,
                y=y,
                areas=_areas(x.limits, y.limits),
                lines=() if distance is None else (_way_out(*at, distance),),
                marks=(Mark(*at, _at(lubrication.contact_overlap, lubrication.load_capacity_coefficient)),),
            ),
        ),
    )


def _shown(coordinate: float | None) -> float:
    """A coordinate without an end stands at the edge of the map."""
    return inf if coordinate is None else coordinate


def _around(which: str, value: float) -> tuple[float, float]:
    """Ends of the map that hold the point, if a map can."""
    low, high = MAP_ENDS[which]
    if not 0.0 < value < inf:
        return low, high
    return min(low, 10.0 ** np.floor(np.log10(value / 1.2))), max(high, 10.0 ** np.ceil(np.log10(value * 1.2)))


def _ticks(low: float, high: float) -> tuple[float, ...]:
    """The boundaries and the decades that do not crowd them."""
    decades = (10.0**exponent for exponent in range(-12, 13))
    far = (decade for decade in decades if decade <= low / 1.9 or decade >= high * 1.9)
    return tuple(sorted({low, high, *far}))


def _at(overlap: float | None, capacity: float | None) -> str:
    texts = ("∞" if value is None else number(value) for value in (overlap, capacity))
    return "Pu = {}\nTr = {}".format(*texts)


def _areas(x: tuple[float, float], y: tuple[float, float]) -> tuple[Area, ...]:
    """The nine areas with what the model itself says of each."""
    columns = list(zip((x[0], *OVERLAP_BOUNDARIES), (*OVERLAP_BOUNDARIES, x[1]), strict=True))
    rows = list(zip((y[0], *CAPACITY_BOUNDARIES), (*CAPACITY_BOUNDARIES, y[1]), strict=True))
    return tuple(_one_area(column, row) for row in rows for column in columns)


def _one_area(x: tuple[float, float], y: tuple[float, float]) -> Area:
    regime = friction_regime((x[0] * x[1]) ** 0.5, (y[0] * y[1]) ** 0.5)
    band = _band(regime.friction_min, regime.friction_max)
    words = {"transition from mixed to boundary lubrication": "transition", "mixed lubrication, unstable": "unstable"}
    name = words.get(regime.name, regime.name.replace(" lubrication", "").replace("predominantly ", ""))
    return Area(*x, *y, "\n".join([regime.area, *name.split(" or ", 1)[:1], band]).strip(), _tint(regime.name))


def _band(low: float | None, high: float | None) -> str:
    if low is None and high is None:
        return ""
    if low is None or high is None:
        return f"μ < {high:g}" if high is not None else f"μ > {low:g}"
    return f"μ ≈ {low:g}" if low == high else f"μ {low:g} to {high:g}"


def _tint(name: str) -> Hue:
    for word, hue in (
        ("full", Hue.GREEN),
        ("unstable", Hue.PURPLE),
        ("transition", Hue.ORANGE),
        ("boundary", Hue.VERMILLION),
    ):
        if word in name:
            return hue
    return Hue.SKY


def _way_out(overlap: float, capacity: float, distance: float) -> Line:
    """From the point to the nearest boundary, along an axis."""
    for boundary in OVERLAP_BOUNDARIES:
        if 0.0 < overlap < inf and abs(abs(log(overlap / boundary)) - distance) < 1e-9:
            return _reference([overlap, boundary], [capacity, capacity])
    nearest = min(CAPACITY_BOUNDARIES, key=lambda boundary: abs(abs(log(capacity / boundary)) - distance))
    return _reference([overlap, overlap], [capacity, nearest])


def _reference(x: list[float], y: list[float]) -> Line:
    return Line("to the next area", values(x), values(y), Hue.GREY, Role.REFERENCE, named=False)


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


def orbit(_: CouplingInputs, result: OrbitResult) -> Figure:
    """Path of the sleeve centre in equal axes."""
    path = result.orbit
    x, y = values([*path.x, path.x[0]]), values([*path.y, path.y[0]])
    farthest = int(np.argmax(np.hypot(x, y)))
    largest = result.max_displacement
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


def inertia_force(_: CouplingInputs, result: OrbitResult) -> Figure:
    """Inertia force of the sleeve in both directions over the revolution."""
    path, force = result.orbit, result.inertia_force
    angle = values([*path.rotor_angle, path.rotor_angle[0] + 360.0])
    lines = []
    for title, items, hue in (("along x", force.x, Hue.BLUE), ("along y", force.y, Hue.VERMILLION)):
        curve = items
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


def orders(_: CouplingInputs, result: OrbitResult) -> Figure:
    """Harmonics of the inertia force."""
    force = result.inertia_force
    order = values([float(order) for order in range(len(force.harmonics_x))])
    series = (
        Bars("along x", order, values(force.harmonics_x), Hue.BLUE),
        Bars("along y", order, values(force.harmonics_y), Hue.VERMILLION),
    )
    panel = Panel(
        x=Axis("order of the revolution (0: the mean)", magnitude=False, ticks=tuple(order.tolist())),
        y=Axis("amplitude of the inertia force", "N"),
        bars=series,
    )
    both = np.hypot(series[0].height, series[1].height)[1:]
    finding = f"strongest at order {int(np.argmax(both)) + 1}" if both.any() else "no force"
    return Figure(finding, (panel,))


def crowning_scan(inputs: RecommendationInputs, result: Recommendation) -> Figure:
    """Least load capacity and largest overlap over the crowning ratio, the feasible window and the choice."""
    scan = result.scan
    if not scan.crowning_ratio.size:
        raise NoFigure("no_contact_to_scan", "No crowning ratio gives a contact that can be computed")
    ratio, feasible = values(scan.crowning_ratio), values([float(each) for each in scan.feasible])
    x = Axis("crowning ratio ε (left: heavily, right: slightly crowned)", log=True)
    best = result.crowning_ratio
    capacity, overlap = values(scan.min_load_capacity_coefficient), values(scan.max_contact_overlap)
    window = _window(ratio, feasible, best)
    choice = () if best is None else (Level(best, "", vertical=True),)
    boundaries = tuple(Level(each, f"Tr = {each:g}") for each in CAPACITY_BOUNDARIES)
    panels = (
        Panel(
            x=x,
            y=Axis("least load capacity coefficient Tr over the range", log=True, limits=_decades_shown(capacity)),
            lines=(Line("least Tr", ratio, capacity, named=False),),
            levels=(*boundaries, *choice),
            spans=window,
            marks=_chosen(best, result.min_load_capacity_coefficient),
        ),
        Panel(
            x=x,
            y=Axis("largest overlap Pu over the range", log=True),
            lines=(Line("largest Pu", ratio, overlap, Hue.GREEN, named=False),),
            levels=(Level(OVERLAP_BOUNDARIES[0], "Pu = 1: supply of oil ends", limit=True), *choice),
            spans=tuple(Span(span.start, span.stop, "") for span in window),
        ),
    )
    low, high = degrees(inputs.min_misalignment), degrees(inputs.max_misalignment)
    return Figure(_choice(result), panels, title=f"Crowning for {number(low)}° to {number(high)}°")


def _chosen(best: float | None, capacity: float | None) -> tuple[Mark, ...]:
    if best is None or capacity is None:
        return ()
    return (Mark(best, capacity, f"ε = {number(best)}, Tr = {number(capacity)}"),)


def _window(ratio: Values, feasible: Values, best: float | None) -> tuple[Span, ...]:
    inside = [*ratio[feasible > 0.0].tolist(), *([] if best is None else [best])]
    return (Span(min(inside), max(inside), "feasible"),) if inside else ()


def _decades_shown(capacity: Values) -> tuple[float, float]:
    """Down to a thousandth of the best: where the film tears off, its capacity falls to nothing."""
    top = 10.0 ** np.ceil(np.log10(max(float(np.nanmax(capacity)), CAPACITY_BOUNDARIES[1])))
    return top / 1e4, top


def _choice(result: Recommendation) -> str:
    if result.crowning_ratio is None:
        failed = result.failed_constraint or ""
        return f"no crowning serves this range: {CONSTRAINTS.get(failed, failed.replace('_', ' '))}"
    capacity = present(result.min_load_capacity_coefficient)
    overlap = max(present(result.at_min).contact_overlap, present(result.at_max).contact_overlap)
    return f"ε = {number(result.crowning_ratio)}: least Tr = {number(capacity)} with Pu up to {number(overlap)}"


ORBIT_FIGURES = (
    Declaration("orbit", "Path of the sleeve centre over one revolution", ORBIT_SOURCE, orbit),
    Declaration("inertia-force", "Inertia force of the sleeve", ORBIT_SOURCE, inertia_force),
    Declaration("orders", "Orders of the sleeve's inertia force", ORBIT_SOURCE, orders),
)
RECOMMENDATION_FIGURES = (
    Declaration("crowning-scan", "Crowning for a range of misalignment", "Pahl 1978, conclusion", crowning_scan),
)


QUARTERS = (0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0, 360.0)
TOOTH = Axis("tooth position φ (tilt at 90° and 270°)", "°", limits=(0.0, 360.0), ticks=QUARTERS, magnitude=False)
TILTS = (Span(82.0, 98.0, ""), Span(262.0, 278.0, ""))


def _tilt_deg(inputs: CouplingInputs) -> float:
    """Tilt of hub against sleeve [°], given or by the offset of the shafts."""
    return degrees(inputs.operation.misalignment)


def tooth_loads(inputs: CouplingInputs, result: CouplingResult) -> Figure:
    """Tangential force of each tooth, mean and largest; the pitch errors behind it."""
    load = result.load_distribution
    curves = load.curves
    angle, force = values(curves.angle), values(curves.tangential_force)
    largest = int(np.argmax(force))
    teeth = f"{load.loaded_teeth} of {force.size} teeth carry"
    tilt = f"at {number(abs(_tilt_deg(inputs)))}° tilt"
    panels = [
        Panel(
            x=TOOTH,
            y=axis(LoadCurves, "tangential_force", "tangential force"),
            bars=(Bars("tangential force", angle, force, Hue.BLUE, strong=largest),),
            levels=(Level(load.mean_tangential_force, f"mean {number(load.mean_tangential_force, 'N')}"),),
            marks=(Mark(float(angle[largest]), float(force[largest]), number(float(force[largest]), "N")),),
        )
    ]
    if inputs.coupling.pitch_errors is not None:
        error = Axis("pitch error (positive: carries more)", "µm", magnitude=False)
        bars = Bars("pitch error", angle, values(np.array(inputs.coupling.pitch_errors) / UM), Hue.VERMILLION)
        panels.append(Panel(x=TOOTH, y=error, bars=(bars,)))
    concentration = load.load_concentration
    share = "" if concentration is None else f"; the highest loaded takes {number(concentration)} times the mean {tilt}"
    return Figure(f"{teeth}{share}", tuple(panels))


def tooth_motion(_: CouplingInputs, result: CouplingResult) -> Figure:
    """What wears, what builds the film and what loads a tooth over a revolution."""
    kinematics, limits = result.kinematics, result.limits
    curves = kinematics.curves
    angle, limit = values(curves.angle), limits.sliding_velocity_limit
    sliding = values(curves.sliding_velocity)
    share = kinematics.max_sliding_velocity / limit
    top = int(np.argmax(sliding))
    panels = (
        Panel(
            x=TOOTH,
            y=axis(KinematicCurves, "sliding_velocity", "sliding velocity, that wears"),
            lines=(Line("sliding velocity", angle, sliding, Hue.VERMILLION, named=False),),
            levels=(Level(limit, f"lasting limit {number(limit, 'm/s')}", limit=True),),
            marks=(Mark(float(angle[top]), float(sliding[top]), number(float(sliding[top]), "m/s"), Hue.VERMILLION),),
            spans=TILTS,
        ),
        _motion("hydrodynamic velocity, that builds the film", "m/s", angle, curves.hydrodynamic_velocity, Hue.BLUE),
        _motion(
            "tangential displacement, that loads the tooth", "µm", angle, curves.tangential_displacement, Hue.GREEN
        ),
    )
    finding = f"sliding reaches {percent(share)} of its lasting limit; least film velocity near the tilt positions"
    return Figure(finding, panels)


def _motion(title: str, unit: str, angle: Values, items: Values, hue: Hue) -> Panel:
    line = Line(title.split(",", maxsplit=1)[0], angle, values(items), hue, named=False)
    return Panel(x=TOOTH, y=Axis(title, unit), lines=(line,), spans=TILTS)


def contact_track(_: CouplingInputs, result: CouplingResult) -> Figure:
    """Where the contact is on the face, and how wide."""
    curves, lubrication = result.kinematics.curves, result.lubrication
    angle, position = values(curves.angle), values(curves.contact_position)
    half, width = lubrication.hertz_half_width, result.derived.face_width
    edge = width / 2.0
    reach = float(np.abs(position).max()) + half
    panel = Panel(
        x=TOOTH,
        y=Axis("position on the hub tooth from its middle", "mm", magnitude=False),
        lines=(Line("middle", angle, position, Hue.BLUE),),
        ribbons=(Ribbon("contact", angle, position - half, position + half),),
        levels=(Level(edge, "edge of the face", limit=True), Level(-edge, "edge of the face", limit=True)),
    )
    overlap = lubrication.contact_overlap
    supply = "without travel no oil comes in" if overlap is None else f"overlap Pu = {number(overlap)}"
    finding = f"contact reaches {number(reach, 'mm')} of {number(edge, 'mm')} to the edge; {supply}"
    return Figure(finding, (panel,))


def axial_thrust(inputs: CouplingInputs, result: CouplingResult) -> Figure:
    """Which teeth slide which way, and the thrust that is left of the coaxial one."""
    thrust, curves = result.axial_thrust, result.kinematics.curves
    axial = inputs.operation.axial_velocity
    sliding = values(curves.sliding_velocity)
    opposed = float(np.mean(sliding[:-1] > abs(axial)))
    rows = [
        Row("thrust", thrust.force, Hue.BLUE, (thrust.lower_bound, thrust.upper_bound)),
        Row("if all teeth carried alike", thrust.uniform_load_force, Hue.GREY),
        Row("breakaway, coaxial at rest", thrust.breakaway_force, Hue.ORANGE),
    ]
    if thrust.self_induced is not None:
        rows += [
            Row("self-induced", thrust.self_induced.force, Hue.PURPLE),
            Row("self-induced, one-pair model", thrust.self_induced.simple_model_force, Hue.GREY),
        ]
    limit = Level(thrust.coaxial_limit, "coaxial limit", limit=True, vertical=True)
    motion = Panel(
        x=TOOTH,
        y=Axis("velocity along the tooth", "m/s"),
        lines=(Line("sliding by tilt", values(curves.angle), sliding, Hue.VERMILLION),),
        levels=(Level(axial, f"axial velocity {number(axial * 1e3, 'mm/s')}"),) if axial else (),
    )
    share = (
        "no limit without load or friction"
        if thrust.fraction_of_limit is None
        else f"{percent(thrust.fraction_of_limit)} of the coaxial limit"
    )
    state = (
        "friction at rest is indeterminate"
        if thrust.indeterminate
        else f"{percent(opposed)} of the revolution slides against the axial motion"
    )
    finding = f"{share}; {state}" if axial or thrust.indeterminate else share
    return Figure(
        finding,
        (Panel(x=Axis("thrust", "N", symbol="F_ax"), y=Axis("thrust"), rows=tuple(rows), levels=(limit,)), motion),
    )


def losses(_: CouplingInputs, result: CouplingResult) -> Figure:
    """Moments on shaft and bearings, and the power that becomes heat."""
    loss = result.losses
    moments = (
        Row("friction", loss.friction_moment, Hue.VERMILLION),
        Row("shift of the contacts", loss.contact_shift_moment, Hue.BLUE),
        Row("bending of the hub, resultant", loss.hub_bending_moment, Hue.GREY),
    )
    power = (Row("friction power of one mesh", loss.friction_power, Hue.VERMILLION),)
    bending = number(loss.hub_bending_moment, "N m")
    finding = f"{number(loss.friction_power, 'W')} of heat and {bending} of bending in one mesh"
    panels = (
        Panel(x=Axis("moment", "N m"), y=Axis("moment"), rows=moments),
        Panel(x=Axis("power", "W"), y=Axis("power"), rows=power),
    )
    return Figure(finding, panels)


FIGURES = (
    Declaration("friction-regime", "Friction regime of the coupling", "Pahl 1978, Fig. 9", friction_map),
    Declaration("tooth-loads", "Load on the coupling teeth", "Pahl 1978, Figs. 3, 4", tooth_loads),
    Declaration("tooth-motion", "Motion of one tooth over a revolution", "Pahl 1978, Figs. 6, 12", tooth_motion),
    Declaration("contact-track", "Track of the contact on the face", "Pahl 1978, Fig. 7", contact_track),
    Declaration("axial-thrust", "Axial thrust of the coupling", "Pahl 1978, Fig. 14", axial_thrust),
    Declaration("losses", "Moments and losses of one mesh", "Pahl 1978", losses),
)
