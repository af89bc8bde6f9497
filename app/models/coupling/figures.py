"""Figures of the coupling: friction map, loads, motion, thrust, losses, orbit of the sleeve, recommended crowning."""

from dataclasses import replace
from functools import cache, partial
from itertools import pairwise
from math import degrees, exp, inf, log
from typing import NamedTuple

import numpy as np

from app.figures import parts
from app.figures.data import (
    Area,
    Axis,
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
)
from app.figures.declaration import Declaration, present
from app.figures.units import UM, axis
from app.figures.wording import number, percent
from solvers.coupling.crowning import Recommendation, crowning_state, crowning_window
from solvers.coupling.inputs import CouplingInputs, RecommendationInputs
from solvers.coupling.lubrication import CAPACITY_BOUNDARIES, OVERLAP_BOUNDARIES, friction_regime, static_friction
from solvers.coupling.results import CouplingResult, Orbit, OrbitResult

TINTS = {"full": Hue.GREEN, "unstable": Hue.PURPLE, "transition": Hue.ORANGE, "boundary": Hue.VERMILLION}
MAP_ENDS = {"overlap": (0.1, 10.0), "capacity": (0.01, 10.0)}  # ends of the axes, with room around Pahl's boundaries
RISING = "1.2"  # the paper prints one value for this area, to which the law of the answer rises from area 1.1


def friction_map(inputs: CouplingInputs, result: CouplingResult) -> Figure:
    """Draw the coupling as a point in the map of friction conditions."""
    lubrication = result.lubrication
    regime, point = lubrication.regime, (lubrication.contact_overlap, lubrication.load_capacity_coefficient)
    overlap, capacity = (inf if value is None else value for value in point)  # None is drawn at the edge of the map
    across, up = _around("overlap", overlap), _around("capacity", capacity)
    x = axis(lubrication, "contact_overlap", log=True, limits=across, ticks=_ticks(*OVERLAP_BOUNDARIES))
    y = axis(lubrication, "load_capacity_coefficient", log=True, limits=up, ticks=_ticks(*CAPACITY_BOUNDARIES))
    at = min(max(overlap, across[0]), across[1]), min(max(capacity, up[0]), up[1])
    distance = regime.distance_to_boundary
    away = "" if distance is None else f", a factor {number(exp(distance))} from the next area"
    texts = (_text(value) for value in point)
    panel = Panel(
        x=replace(x, title=f"{x.title} (right: worse supply of oil)"),
        y=replace(y, title=f"{y.title} (up: stronger film)"),
        areas=_areas(across, up),
        lines=[] if distance is None else [_to_boundary(*at, distance)],
        marks=[Mark(*at, "Pu = {}\nTr = {}".format(*texts))],
    )
    used = number(lubrication.friction_coefficient)
    friction = f"μ = {used}" if inputs.friction.coefficient is None else f"given: μ = {used}, whatever the area"
    return Figure(f"area {regime.area}, {regime.name}{away}; {friction}", [panel])


def _text(value: float | None) -> str:
    """Return a coordinate of the coupling in the map, and where it is if the logarithmic axis cannot show it."""
    if value is None:
        return "∞, beyond the scale"
    return number(value) if value > 0.0 else f"{number(value)}, below the scale"


def _around(which: str, value: float) -> tuple[float, float]:
    """Return the ends of the axis `which` of the map."""
    low, high = MAP_ENDS[which]
    if not 0.0 < value < inf:
        return low, high
    return min(low, 10.0 ** np.floor(np.log10(value / 1.2))), max(high, 10.0 ** np.ceil(np.log10(value * 1.2)))


def _ticks(low: float, high: float) -> list[float]:
    """Return the ticks of an axis of the map: the outermost boundaries `low` and `high`, and the powers of ten beyond.

    A power of ten has no tick if it is close to a boundary.
    """
    decades = (10.0**exponent for exponent in range(-12, 13))
    return sorted({low, high, *(decade for decade in decades if decade <= low / 1.9 or decade >= high * 1.9)})


def _areas(x: tuple[float, float], y: tuple[float, float]) -> list[Area]:
    """Return the nine areas with their names and with the coefficients of friction from the model."""
    words = {"transition from mixed to boundary lubrication": "transition", "mixed lubrication, unstable": "unstable"}
    areas = []
    for bottom, top in pairwise((y[0], *CAPACITY_BOUNDARIES, y[1])):
        for left, right in pairwise((x[0], *OVERLAP_BOUNDARIES, x[1])):
            regime = friction_regime((left * right) ** 0.5, (bottom * top) ** 0.5)
            name = words.get(regime.name, regime.name.replace(" lubrication", "").replace("predominantly ", ""))
            band = _band(regime.friction_min, regime.friction_max)
            if regime.area == RISING:
                band = f"μ to {regime.friction_max:g}"
            texts = (regime.area, name.partition(" or ")[0], band)
            hue = next((hue for word, hue in TINTS.items() if word in regime.name), Hue.SKY)
            areas.append(Area(left, right, bottom, top, "\n".join(texts).strip(), hue))
    return areas


def _band(low: float | None, high: float | None) -> str:
    if low is None:
        return "" if high is None else f"μ < {high:g}"
    if high is None:
        return f"μ > {low:g}"
    return f"μ ≈ {low:g}" if low == high else f"μ {low:g}–{high:g}"


def _to_boundary(overlap: float, capacity: float, distance: float) -> Line:
    """Return the line from the point of the coupling to the nearest boundary of an area, parallel to an axis."""
    ways = [(bound, capacity) for bound in OVERLAP_BOUNDARIES] + [(overlap, bound) for bound in CAPACITY_BOUNDARIES]
    x, y = min(ways, key=lambda way: abs(abs(log(way[0] / overlap)) + abs(log(way[1] / capacity)) - distance))
    return Line(
        "to the next area", np.array([overlap, x]), np.array([capacity, y]), Hue.GREY, Role.REFERENCE, named=False
    )


QUARTERS = tuple(45.0 * count for count in range(9))
ROTOR = axis(Orbit, "rotor_angle", limits=(0.0, 360.0), ticks=QUARTERS)
TOOTH = Axis("tooth position (tilt at 90° and 270°)", "°", limits=(0.0, 360.0), ticks=QUARTERS, symbol="φ")
TILTS = [Span(82.0, 98.0, ""), Span(262.0, 278.0, "")]  # marks at 90° and 270°, wide enough to be seen
CONTINUOUS = "limit in continuous running"
ORBIT_SOURCE = "Pahl 1978, Fig. 5"
CONSTRAINTS = {
    "contact_overlap": "the overlap cannot fall below 1",
    "edge_contact": "the contact leaves the face",
    "hertz_pressure": "the Hertzian pressure is too high",
    "contact_width": "the contact is too wide",
    "sliding_velocity": "the teeth slide too fast",
}


def orbit(_: CouplingInputs, result: OrbitResult) -> Figure:
    """Draw the path of the sleeve centre, with the same scale on both axes."""
    path, largest = result.orbit, number(result.max_displacement, "µm")
    line = Line("path", np.append(path.x, path.x[0]), np.append(path.y, path.y[0]), named=False)
    panel = Panel(
        x=axis(path, "x", magnitude=False),
        y=axis(path, "y", magnitude=False),
        lines=[line],
        marks=[line.mark(int(np.argmax(np.hypot(line.x, line.y))), largest)],
        levels=[Level(0.0, ""), Level(0.0, "", vertical=True)],
        equal=True,
    )
    return Figure(f"the centre strays up to {largest} from the axis", [panel])


def inertia_force(_: CouplingInputs, result: OrbitResult) -> Figure:
    """Draw the inertia force of the sleeve in both directions over one revolution."""
    angle, force = result.orbit.rotor_angle, result.inertia_force
    directions = {"along x": np.append(force.x, force.x[0]), "along y": np.append(force.y, force.y[0])}
    lines = parts.lines(np.append(angle, angle[0] + 360.0), directions)
    strongest = max(lines, key=lambda line: float(np.abs(line.y).max()))
    at = int(np.argmax(np.abs(strongest.y)))
    value = float(strongest.y[at])
    y = axis(force, "x", "inertia force of the sleeve mass of one mesh", magnitude=False, symbol="F")
    panel = Panel(x=ROTOR, y=y, lines=lines, marks=[strongest.mark(at, number(value, "N"))])
    return Figure(f"up to {number(abs(value), 'N')} {strongest.title}", [panel])


def orders(_: CouplingInputs, result: OrbitResult) -> Figure:
    """Draw the harmonics of the inertia force."""
    force = result.inertia_force
    amplitude = Axis("amplitude of the inertia force", "N", symbol="F_k")
    series = {"along x": force.harmonics_x, "along y": force.harmonics_y}
    panel = parts.orders("order of the revolution (0: the mean)", amplitude, 0, series, symbol="k")
    both = np.hypot(*series.values())[1:]
    return Figure(f"strongest at order {int(np.argmax(both)) + 1}" if both.any() else "no force", [panel])


class Bounds(NamedTuple):
    """Bounds that exclude every crowning ratio: the least, what needs it, the largest with the contact on the face."""

    low: float
    need: str
    high: float


def crowning_bounds(inputs: RecommendationInputs, result: Recommendation) -> Bounds | None:
    """Find the bounds of the crowning ratio that contradict each other; None if another limit decides."""
    if result.failed_constraint != "edge_contact":
        return None
    state = cache(partial(crowning_state, inputs))
    low, high, _ = crowning_window(state)
    oil = state(low).overlap > state(low).pressure and state(low).overlap > state(low).width
    return Bounds(low, "the supply of oil" if oil else "Hertz's theory", high)


def crowning_scan(inputs: RecommendationInputs, result: Recommendation, bounds: Bounds | None) -> Figure:
    """Draw curves over the crowning ratio: the least load capacity and the largest contact overlap at each ratio.

    If no ratio serves because its `bounds` contradict each other, a limit shows where the contact leaves the face.
    """
    scan, best = result.scan, result.crowning_ratio
    ratio, capacity = scan.crowning_ratio, scan.min_load_capacity_coefficient
    if not ratio.size:
        raise NoFigure("no_contact_to_scan", "The contact cannot be computed at any crowning ratio")
    # The logarithmic axis begins at 1e-4 of its end, because the capacity is zero where the film tears off.
    top = 10.0 ** np.ceil(np.log10(max(float(np.nanmax(capacity)), CAPACITY_BOUNDARIES[1])))
    x = axis(scan, "crowning_ratio", "crowning ratio (left: heavily, right: slightly crowned)", log=True)
    strength = axis(scan, "min_load_capacity_coefficient", log=True, limits=(top / 1e4, top))
    supply = axis(scan, "max_contact_overlap", log=True)
    choice, marks = list[Level](), list[Mark]()
    if bounds is not None:
        choice.append(Level(bounds.high, "contact off the face →", limit=True, vertical=True))
    inside = ratio[np.array(scan.feasible, dtype=bool)].tolist()
    if best is None:
        failed = result.failed_constraint or ""
        finding = f"no crowning serves this range: {CONSTRAINTS.get(failed, failed.replace('_', ' '))}"
        if bounds is not None:
            finding += f" above ε = {number(bounds.high)}, but {bounds.need} needs more than {number(bounds.low)}"
    else:
        least = present(result.min_load_capacity_coefficient)
        most = max(present(result.at_min).contact_overlap, present(result.at_max).contact_overlap)
        radius, drop = present(result.crowning_radius), present(result.crowning_drop)
        finding = f"radius {number(radius, 'mm')}, drop {number(drop, 'µm')}, ε = {number(best)}: "
        finding += f"least Tr = {number(least)} with Pu up to {number(most)}"
        choice.append(Level(best, "", vertical=True))
        marks.append(Mark(best, least, f"ε = {number(best)}, Tr = {number(least)}"))
        inside.append(best)
    window = [Span(min(inside), max(inside), "feasible")] if inside else []
    areas = [Level(bound, f"Tr = {bound:g}") for bound in CAPACITY_BOUNDARIES]
    ends = Level(OVERLAP_BOUNDARIES[0], "Pu = 1: supply of oil ends", limit=True)
    film = parts.curve(x, strength, ratio, capacity, levels=[*areas, *parts.unnamed(choice)], spans=window)
    oil = parts.curve(
        x,
        supply,
        ratio,
        scan.max_contact_overlap,
        Hue.GREEN,
        levels=[ends, *choice],
        spans=parts.unnamed(window),
    )
    least_tilt, most_tilt = (number(degrees(tilt)) for tilt in (inputs.min_misalignment, inputs.max_misalignment))
    title = f"Crowning for {least_tilt}° to {most_tilt}°"
    return Figure(finding, [replace(film, marks=marks), oil], title=title)


ORBIT_FIGURES = (
    Declaration("orbit", "Path of the sleeve centre over one revolution", ORBIT_SOURCE, orbit),
    Declaration("inertia-force", "Inertia force of the sleeve", ORBIT_SOURCE, inertia_force),
    Declaration("orders", "Orders of the sleeve's inertia force", ORBIT_SOURCE, orders),
)
RECOMMENDATION_FIGURES = (
    Declaration(
        "crowning-scan",
        "Crowning for a range of misalignment",
        "Pahl 1978, conclusion",
        crowning_scan,
        compute=crowning_bounds,
    ),
)


def tooth_loads(inputs: CouplingInputs, result: CouplingResult) -> Figure:
    """Draw the tangential force of each tooth, with the mean force and the largest force."""
    load, deviations = result.load_distribution, inputs.coupling.pitch_errors
    curves, mean = load.curves, load.mean_tangential_force
    bars = Line("tangential force", curves.angle, curves.tangential_force)
    y, level = axis(curves, "tangential_force", "tangential force"), Level(mean, f"mean {number(mean, 'N')}")
    panels = [Panel(x=TOOTH, y=y, bars=[bars], levels=[level], marks=parts.extreme([bars], "N"))]
    if deviations is not None:
        y = axis(inputs.coupling, "pitch_errors", "pitch deviation (positive: carries more)", magnitude=False)
        errors = Line("pitch deviation", curves.angle, np.array(deviations) / UM, Hue.VERMILLION)
        panels.append(Panel(x=TOOTH, y=y, bars=[errors]))
    finding = f"{load.loaded_teeth} of {curves.angle.size} teeth carry"
    if load.load_concentration is not None:
        tilt = f"at {number(abs(degrees(inputs.operation.misalignment)))}° tilt"
        finding += f"; the highest loaded takes {number(load.load_concentration)} times the mean {tilt}"
    return Figure(finding, panels)


def tooth_motion(_: CouplingInputs, result: CouplingResult) -> Figure:
    """Draw sliding velocity, hydrodynamic velocity and tangential displacement of a tooth over a revolution."""
    kinematics, limit = result.kinematics, result.limits.sliding_velocity_limit
    curves, lasting = kinematics.curves, Level(limit, f"{CONTINUOUS} {number(limit, 'm/s')}", limit=True)

    def panel(name: str, title: str, hue: Hue, *levels: Level) -> Panel:
        y, marked = axis(curves, name, title), bool(levels)
        return parts.curve(
            TOOTH, y, curves.angle, getattr(curves, name), hue, marked=marked, levels=levels, spans=TILTS
        )

    panels = [
        panel("sliding_velocity", "sliding velocity, that wears", Hue.VERMILLION, lasting),
        panel("hydrodynamic_velocity", "hydrodynamic velocity, that builds the film", Hue.BLUE),
        panel("tangential_displacement", "tangential displacement, that loads the tooth", Hue.GREEN),
    ]
    share = percent(kinematics.max_sliding_velocity / limit)
    return Figure(f"sliding reaches {share} of its {CONTINUOUS}; least film velocity near the tilt positions", panels)


def contact_track(_: CouplingInputs, result: CouplingResult) -> Figure:
    """Draw position and width of the contact on the face over a revolution."""
    curves, lubrication = result.kinematics.curves, result.lubrication
    position, half = curves.contact_position, lubrication.hertz_half_width
    edge = result.derived.coupling.face_width / 2.0
    panel = Panel(
        x=TOOTH,
        y=axis(curves, "contact_position", "position on the hub tooth from its middle", magnitude=False),
        lines=[Line("middle", curves.angle, position)],
        ribbons=_ribbons(curves.angle, position - half, position + half, edge),
        levels=[Level(end, "edge of the face", limit=True) for end in (edge, -edge)],
    )
    overlap, reach = lubrication.contact_overlap, float(np.abs(position).max()) + half
    supply = "without travel no oil comes in" if overlap is None else f"overlap Pu = {number(overlap)}"
    ends = f"contact reaches {number(reach, 'mm')} from the middle; the face ends at {number(edge, 'mm')}"
    return Figure(f"{ends}; {supply}", [panel])


def _ribbons(angle: Values, low: Values, high: Values, edge: float) -> list[Ribbon]:
    """Return the contact on the face, and its parts beyond the ends of the face."""
    shares = (
        ("contact", np.maximum(low, -edge), np.minimum(high, edge), Hue.BLUE),
        ("off the face", np.maximum(low, edge), high, Hue.VERMILLION),
        ("off the face", low, np.minimum(high, -edge), Hue.VERMILLION),
    )
    return [
        Ribbon(title, angle, np.where(bottom < top, bottom, np.nan), np.where(bottom < top, top, np.nan), hue)
        for title, bottom, top, hue in shares
        if (bottom < top).any()
    ]


def axial_thrust(inputs: CouplingInputs, result: CouplingResult) -> Figure:
    """Draw the axial thrust, and the sliding velocity along the teeth."""
    thrust, curves, axial = result.axial_thrust, result.kinematics.curves, inputs.operation.axial_velocity
    rows = [
        Row("thrust", thrust.force, Hue.BLUE, (thrust.lower_bound, thrust.upper_bound)),
        Row("if all teeth carried alike", thrust.uniform_load_force, Hue.GREY),
        Row(f"breakaway at rest, μ = {number(static_friction(inputs.friction))}", thrust.breakaway_force, Hue.ORANGE),
    ]
    if thrust.self_induced is not None:
        rows += [
            Row("self-induced", thrust.self_induced.force, Hue.PURPLE),
            Row("self-induced, one-pair model", thrust.self_induced.simple_model_force, Hue.GREY),
        ]
    running = f"coaxial limit in motion, μ = {number(result.lubrication.friction_coefficient)}"
    limit = Level(thrust.coaxial_limit, running, limit=True, vertical=True)
    forces = Panel(x=axis(thrust, "force", "thrust"), y=Axis("thrust"), rows=rows, levels=[limit])
    y = axis(curves, "sliding_velocity", "sliding velocity along the tooth")
    motion = Panel(
        x=TOOTH,
        y=y,
        lines=[Line(y.title, curves.angle, curves.sliding_velocity, Hue.VERMILLION, named=False)],
        levels=[Level(axial, f"axial {number(axial * 1e3, 'mm/s')}")] if axial else [],
    )
    finding = "no limit without load or friction"
    if thrust.fraction_of_limit is not None:
        finding = f"{percent(thrust.fraction_of_limit)} of the coaxial limit"
    if thrust.indeterminate:
        finding += "; friction at rest is indeterminate"
    elif axial:
        opposed = float(np.mean(curves.sliding_velocity[:-1] > abs(axial)))
        finding += f"; {percent(opposed)} of the revolution slides against the axial motion"
    return Figure(finding, [forces, motion])


def losses(_: CouplingInputs, result: CouplingResult) -> Figure:
    """Draw, for one mesh, the moments that load shaft and bearings, and the power that is lost as heat."""
    loss = result.losses
    moments = [
        Row("friction", loss.friction_moment, Hue.VERMILLION),
        Row("shift of the contacts", loss.contact_shift_moment, Hue.BLUE),
        Row("bending of the hub, resultant", loss.hub_bending_moment, Hue.GREY),
    ]
    power = [Row("friction power of one mesh", loss.friction_power, Hue.VERMILLION)]
    panels = [
        Panel(x=Axis("moment", "N m", symbol="M"), y=Axis("moment"), rows=moments),
        Panel(x=Axis("power", "W", symbol="P"), y=Axis("power"), rows=power),
    ]
    bending = number(loss.hub_bending_moment, "N m")
    return Figure(f"{number(loss.friction_power, 'W')} of heat and {bending} of bending in one mesh", panels)


FIGURES = (
    Declaration("friction-regime", "Friction regime of the coupling", "Pahl 1978, Fig. 9", friction_map),
    Declaration("tooth-loads", "Load on the coupling teeth", "Pahl 1978, Figs. 3, 4", tooth_loads),
    Declaration("tooth-motion", "Motion of one tooth over a revolution", "Pahl 1978, Figs. 6, 12", tooth_motion),
    Declaration("contact-track", "Track of the contact on the face", "Pahl 1978, Fig. 7", contact_track),
    Declaration("axial-thrust", "Axial thrust of the coupling", "Pahl 1978, Fig. 14", axial_thrust),
    Declaration("losses", "Moments and losses of one mesh", "Pahl 1978", losses),
)
