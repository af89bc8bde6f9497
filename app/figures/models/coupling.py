"""Figures of the couplings: friction map, loads, motion, thrust and losses; sleeve orbit; recommended crowning."""

from dataclasses import replace
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
from app.figures.parts import curve
from app.figures.units import UM, axis
from app.figures.wording import number, percent
from solvers.coupling.crowning import CrowningScan, Recommendation
from solvers.coupling.inputs import CouplingDesign, CouplingInputs, RecommendationInputs
from solvers.coupling.lubrication import CAPACITY_BOUNDARIES, OVERLAP_BOUNDARIES, friction_regime
from solvers.coupling.results import (
    AxialThrust,
    CouplingResult,
    InertiaForce,
    KinematicCurves,
    LoadCurves,
    Lubrication,
    Orbit,
    OrbitResult,
)

TINTS = {"full": Hue.GREEN, "unstable": Hue.PURPLE, "transition": Hue.ORANGE, "boundary": Hue.VERMILLION}
MAP_ENDS = {"overlap": (0.1, 10.0), "capacity": (0.01, 10.0)}  # of the axes, with room around Pahl's boundaries


def friction_map(_: CouplingInputs, result: CouplingResult) -> Figure:
    """Supply of oil against strength of film, with the nine areas and the distance to the next."""
    lubrication = result.lubrication
    regime, found = lubrication.regime, (lubrication.contact_overlap, lubrication.load_capacity_coefficient)
    overlap, capacity = (inf if each is None else each for each in found)  # at the edge of the map
    across, up = _around("overlap", overlap), _around("capacity", capacity)
    x = axis(Lubrication, "contact_overlap", log=True, limits=across, ticks=_ticks(*OVERLAP_BOUNDARIES))
    y = axis(Lubrication, "load_capacity_coefficient", log=True, limits=up, ticks=_ticks(*CAPACITY_BOUNDARIES))
    x = replace(x, title=f"{x.title} (right: worse supply of oil)")
    y = replace(y, title=f"{y.title} (up: stronger film)")
    at = min(max(overlap, across[0]), across[1]), min(max(capacity, up[0]), up[1])
    distance = regime.distance_to_boundary
    away = "" if distance is None else f", a factor {number(exp(distance))} from the next area"
    texts = ("∞" if value is None else number(value) for value in found)
    panel = Panel(
        x=x,
        y=y,
        areas=_areas(across, up),
        lines=() if distance is None else (_to_boundary(*at, distance),),
        marks=(Mark(*at, "Pu = {}\nTr = {}".format(*texts)),),
    )
    finding = f"area {regime.area}, {regime.name}{away}; μ = {number(lubrication.friction_coefficient)}"
    return Figure(finding, (panel,))


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


def _areas(x: tuple[float, float], y: tuple[float, float]) -> tuple[Area, ...]:
    """The nine areas with what the model itself says of each."""
    columns = list(zip((x[0], *OVERLAP_BOUNDARIES), (*OVERLAP_BOUNDARIES, x[1]), strict=True))
    rows = list(zip((y[0], *CAPACITY_BOUNDARIES), (*CAPACITY_BOUNDARIES, y[1]), strict=True))
    return tuple(_one_area(column, row) for row in rows for column in columns)


def _one_area(x: tuple[float, float], y: tuple[float, float]) -> Area:
    regime = friction_regime((x[0] * x[1]) ** 0.5, (y[0] * y[1]) ** 0.5)
    words = {"transition from mixed to boundary lubrication": "transition", "mixed lubrication, unstable": "unstable"}
    name = words.get(regime.name, regime.name.replace(" lubrication", "").replace("predominantly ", ""))
    texts = (regime.area, name.partition(" or ")[0], _band(regime.friction_min, regime.friction_max))
    hue = next((hue for word, hue in TINTS.items() if word in regime.name), Hue.SKY)
    return Area(*x, *y, "\n".join(texts).strip(), hue)


def _band(low: float | None, high: float | None) -> str:
    if low is None and high is None:
        return ""
    if low is None or high is None:
        return f"μ < {high:g}" if high is not None else f"μ > {low:g}"
    return f"μ ≈ {low:g}" if low == high else f"μ {low:g} to {high:g}"


def _to_boundary(overlap: float, capacity: float, distance: float) -> Line:
    """From the point to the nearest boundary, along an axis."""
    ways = [(each, capacity) for each in OVERLAP_BOUNDARIES] + [(overlap, each) for each in CAPACITY_BOUNDARIES]
    x, y = min(ways, key=lambda way: abs(abs(log(way[0] / overlap)) + abs(log(way[1] / capacity)) - distance))
    return Line("to the next area", values([overlap, x]), values([capacity, y]), Hue.GREY, Role.REFERENCE, named=False)


QUARTERS = tuple(45.0 * each for each in range(9))
ROTOR = axis(Orbit, "rotor_angle", limits=(0.0, 360.0), ticks=QUARTERS)
TOOTH = Axis("tooth position (tilt at 90° and 270°)", "°", limits=(0.0, 360.0), ticks=QUARTERS, symbol="φ")
TILTS = (Span(82.0, 98.0, ""), Span(262.0, 278.0, ""))  # marks at 90° and 270°, wide enough to be seen
ORBIT_SOURCE = "Pahl 1978, Fig. 5"
CONSTRAINTS = {
    "contact_overlap": "the overlap cannot fall below 1",
    "edge_contact": "the contact leaves the face",
    "hertz_pressure": "the Hertzian pressure is too high",
    "contact_width": "the contact is too wide",
    "sliding_velocity": "the teeth slide too fast",
}


def orbit(_: CouplingInputs, result: OrbitResult) -> Figure:
    """Path of the sleeve centre in equal axes."""
    path, largest = result.orbit, number(result.max_displacement, "µm")
    x, y = values([*path.x, path.x[0]]), values([*path.y, path.y[0]])
    farthest = int(np.argmax(np.hypot(x, y)))
    panel = Panel(
        x=axis(Orbit, "x", magnitude=False),
        y=axis(Orbit, "y", magnitude=False),
        lines=(Line("path", x, y, named=False),),
        marks=(Mark(float(x[farthest]), float(y[farthest]), largest),),
        levels=(Level(0.0, ""), Level(0.0, "", vertical=True)),
        equal=True,
    )
    return Figure(f"the centre strays up to {largest} from the axis", (panel,))


def inertia_force(_: CouplingInputs, result: OrbitResult) -> Figure:
    """Inertia force of the sleeve in both directions over the revolution."""
    path, force = result.orbit, result.inertia_force
    angle = values([*path.rotor_angle, path.rotor_angle[0] + 360.0])
    directions = (("along x", force.x, Hue.BLUE), ("along y", force.y, Hue.VERMILLION))
    lines = [Line(title, angle, values([*curve, curve[0]]), hue) for title, curve, hue in directions]
    strongest = max(lines, key=lambda line: float(np.abs(line.y).max()))
    at = int(np.argmax(np.abs(strongest.y)))
    value = float(strongest.y[at])
    y = axis(InertiaForce, "x", "inertia force of the sleeve mass of one mesh", magnitude=False, symbol="F")
    mark = Mark(float(angle[at]), value, number(value, "N"), strongest.hue)
    panel = Panel(x=ROTOR, y=y, lines=tuple(lines), marks=(mark,))
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
        x=Axis("order of the revolution (0: the mean)", magnitude=False, ticks=tuple(order.tolist()), symbol="k"),
        y=Axis("amplitude of the inertia force", "N", symbol="F_k"),
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
    ratio, best = values(scan.crowning_ratio), result.crowning_ratio
    x = axis(CrowningScan, "crowning_ratio", "crowning ratio (left: heavily, right: slightly crowned)", log=True)
    inside = [*ratio[np.array(scan.feasible, dtype=bool)].tolist(), *([] if best is None else [best])]
    window = (Span(min(inside), max(inside), "feasible"),) if inside else ()
    choice = () if best is None else (Level(best, "", vertical=True),)
    capacity = axis(CrowningScan, "min_load_capacity_coefficient", log=True)
    capacity = replace(capacity, limits=_decades_shown(values(scan.min_load_capacity_coefficient)))
    overlap = axis(CrowningScan, "max_contact_overlap", log=True)
    boundaries = tuple(Level(each, f"Tr = {each:g}") for each in CAPACITY_BOUNDARIES)
    supply = Level(OVERLAP_BOUNDARIES[0], "Pu = 1: supply of oil ends", limit=True)
    least = curve(x, capacity, ratio, scan.min_load_capacity_coefficient, levels=(*boundaries, *choice), spans=window)
    panels = (
        replace(least, marks=_chosen(best, result.min_load_capacity_coefficient)),
        curve(
            x,
            overlap,
            ratio,
            scan.max_contact_overlap,
            Hue.GREEN,
            levels=(supply, *choice),
            spans=tuple(replace(span, name="") for span in window),
        ),
    )
    low, high = degrees(inputs.min_misalignment), degrees(inputs.max_misalignment)
    return Figure(_choice(result), panels, title=f"Crowning for {number(low)}° to {number(high)}°")


def _chosen(best: float | None, capacity: float | None) -> tuple[Mark, ...]:
    if best is None or capacity is None:
        return ()
    return (Mark(best, capacity, f"ε = {number(best)}, Tr = {number(capacity)}"),)


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


def tooth_loads(inputs: CouplingInputs, result: CouplingResult) -> Figure:
    """Tangential force of each tooth, mean and largest; the pitch deviations behind it."""
    load = result.load_distribution
    curves = load.curves
    angle, force = values(curves.angle), values(curves.tangential_force)
    largest, mean = int(np.argmax(force)), load.mean_tangential_force
    teeth = f"{load.loaded_teeth} of {force.size} teeth carry"
    tilt = f"at {number(abs(degrees(inputs.operation.misalignment)))}° tilt"
    bars = Bars("tangential force", angle, force, Hue.BLUE, strong=largest)
    panels = [
        Panel(
            x=TOOTH,
            y=axis(LoadCurves, "tangential_force", "tangential force"),
            bars=(bars,),
            levels=(Level(mean, f"mean {number(mean, 'N')}"),),
            marks=(Mark(float(angle[largest]), float(force[largest]), number(float(force[largest]), "N")),),
        )
    ]
    if inputs.coupling.pitch_errors is not None:
        error = axis(CouplingDesign, "pitch_errors", "pitch deviation (positive: carries more)", magnitude=False)
        errors = Bars("pitch deviation", angle, values(np.array(inputs.coupling.pitch_errors) / UM), Hue.VERMILLION)
        panels.append(Panel(x=TOOTH, y=error, bars=(errors,)))
    concentration = load.load_concentration
    share = "" if concentration is None else f"; the highest loaded takes {number(concentration)} times the mean {tilt}"
    return Figure(f"{teeth}{share}", tuple(panels))


def tooth_motion(_: CouplingInputs, result: CouplingResult) -> Figure:
    """What wears, what builds the film and what loads a tooth over a revolution."""
    kinematics, limit = result.kinematics, result.limits.sliding_velocity_limit
    panels = tuple(
        curve(
            TOOTH,
            axis(KinematicCurves, name, title),
            kinematics.curves.angle,
            getattr(kinematics.curves, name),
            hue,
            marked=bool(levels),
            levels=levels,
            spans=TILTS,
        )
        for name, title, hue, levels in (
            (
                "sliding_velocity",
                "sliding velocity, that wears",
                Hue.VERMILLION,
                (Level(limit, f"lasting limit {number(limit, 'm/s')}", limit=True),),
            ),
            ("hydrodynamic_velocity", "hydrodynamic velocity, that builds the film", Hue.BLUE, ()),
            ("tangential_displacement", "tangential displacement, that loads the tooth", Hue.GREEN, ()),
        )
    )
    share = percent(kinematics.max_sliding_velocity / limit)
    return Figure(f"sliding reaches {share} of its lasting limit; least film velocity near the tilt positions", panels)


def contact_track(_: CouplingInputs, result: CouplingResult) -> Figure:
    """Where the contact is on the face, and how wide."""
    curves, lubrication = result.kinematics.curves, result.lubrication
    angle, position = values(curves.angle), values(curves.contact_position)
    half, width = lubrication.hertz_half_width, result.derived.face_width
    edge = width / 2.0
    reach = float(np.abs(position).max()) + half
    panel = Panel(
        x=TOOTH,
        y=axis(KinematicCurves, "contact_position", "position on the hub tooth from its middle", magnitude=False),
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
        y=axis(KinematicCurves, "sliding_velocity", "velocity along the tooth"),
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
        (Panel(x=axis(AxialThrust, "force", "thrust"), y=Axis("thrust"), rows=tuple(rows), levels=(limit,)), motion),
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
        Panel(x=Axis("moment", "N m", symbol="M"), y=Axis("moment"), rows=moments),
        Panel(x=Axis("power", "W", symbol="P"), y=Axis("power"), rows=power),
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
