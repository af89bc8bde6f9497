"""Figures of a gear unit: shafts, gap and load along the face, load and temperature over the flank, thrust, losses."""

from dataclasses import replace
from functools import partial
from math import atan2, copysign, hypot, pi, sin

import numpy as np

from app.figures import parts
from app.figures.data import Axis, Figure, Hue, Level, Line, Mark, NoFigure, Panel, Role, Row, Span, Values, values
from app.figures.declaration import Declaration
from app.figures.sketches import faces_of, shafts
from app.figures.units import MM, axis
from app.figures.wording import number, percent, without_rounding
from app.models.drive_train import helix_figures
from app.models.drive_train.helix_figures import decisive
from app.models.load_distribution.figures import face, over_flank, section
from app.models.scuffing import heat_balance_figures as heat_balance
from app.models.scuffing import micropitting_figures as micropitting
from app.models.scuffing.figures import heat_over_flank
from solvers.drive_train import solve
from solvers.drive_train.film.law import FilmLaw, film_at
from solvers.drive_train.inputs import DriveTrainInputs, Effects, JournalBearing, Shaft, Vector2
from solvers.drive_train.results import DriveTrainResult, ShaftResult
from solvers.drive_train.safety import contact_of
from solvers.drive_train.shafts.bearings import law_of
from solvers.drive_train.unit_heat import at_temperatures
from solvers.heat_balance import FlowCurve
from solvers.quantity import UNITS
from solvers.scuffing.safety_results import Scuffing

OWN = "own derivation"
ROUND = np.linspace(0.0, 2.0 * pi, 181)  # a circle in steps of 2°
WALLS = -1.05, 1.05  # ends of the axes in units of the clearance; this leaves some room around the circle
NEWTONS = 1e3  # newtons per kilonewton
HUES = {
    "without coupling": Hue.ORANGE,
    "without heat": Hue.VERMILLION,
    "without shafts": Hue.GREEN,
    "mesh alone": Hue.GREY,
}
PARTS = (
    ("bearings of the pinion", "films_pinion", Hue.BLUE),
    ("bearings of the wheel", "films_wheel", Hue.BLUE),
    ("torsion", "torsion", Hue.VERMILLION),
    ("bending", "bending", Hue.GREEN),
    ("tilting moment, elastic", "tilting_moment", Hue.GREEN),
    ("offsets of the bores", "bearing_offsets", Hue.PURPLE),
    ("couplings, elastic", "coupling", Hue.ORANGE),
    ("thrust collar, elastic", "collar", Hue.ORANGE),
    ("weight, elastic", "weight", Hue.GREY),
)


def flank_load(inputs: DriveTrainInputs, result: DriveTrainResult) -> Figure:
    """Draw the line load over the flank for the unit in equilibrium."""
    flank, load = result.flank, result.load
    panel = over_flank(face_width(inputs), flank, axis(flank, "line_load"), flank.line_load, load.max_line_load, None)
    if load.face_load_factor is None:
        return Figure("no load", [panel])
    pattern = f"contact pattern {percent(load.contact_fraction)}, K_Hβ = {number(load.face_load_factor)}"
    return Figure(f"{decisive(result)}highest {number(load.max_line_load, 'N/mm')}; {pattern}", [panel])


def contact_temperature(inputs: DriveTrainInputs, result: DriveTrainResult) -> Figure:
    """Draw Blok's contact temperature over the whole flank."""
    flank, temperatures = result.flank, result.derived.temperatures
    grid, shown = flank.contact_temperature, axis(flank, "contact_temperature", "contact temperature")
    if temperatures.bulk is None:
        raise NoFigure(
            "no_oil", "Without an oil and a bulk temperature, the contact temperature cannot be computed", "lubricant"
        )
    friction = result.flash.friction_coefficient
    panel = heat_over_flank(face_width(inputs), flank, shown, grid, temperatures.scuffing, friction)
    high = float(grid.max())
    safety = result.safety.blok_flank if result.safety is not None else None
    finding = "" if safety is None else f", safety factor S_B = {number(safety)}"
    return Figure(f"{decisive(result)}up to {number(high, '°C', digits=4)}{finding}", [panel])


def shaft_lines(inputs: DriveTrainInputs, result: DriveTrainResult) -> Figure:
    """Draw the displaced axes of both shafts in both planes, and the reactions of the bearings."""
    states = result.shafts
    z = np.concatenate([state.curves.z for state in states])
    ends = float(z.min()), float(z.max())
    along = axis(states[0].curves, "z", "position along Z", magnitude=False, symbol="", limits=ends)
    panels = [
        _shaft(inputs, name, own, state, along)
        for name, own, state in zip(("pinion", "wheel"), inputs.shafts, states, strict=True)
    ]
    loads = [hypot(*bearing.reaction) for state in states for bearing in state.bearings]
    finding = f"bearings carry {number(min(loads) / NEWTONS)} to {number(max(loads) / NEWTONS, 'kN')}"
    return Figure(f"{finding}; marks are their reactions", panels)


def _shaft(inputs: DriveTrainInputs, name: str, given: Shaft, state: ShaftResult, along: Axis) -> Panel:
    curves, marks = state.curves, []
    lines = parts.lines(curves.z, {"along X": curves.x, "along Y": curves.y})
    for plane, line in enumerate(lines):
        for bearing, bearing_state in zip(given.bearings, state.bearings, strict=True):
            place = bearing.position / MM
            force = bearing_state.reaction
            reaction = without_rounding(force[plane], hypot(*force)) / NEWTONS
            marks.append(Mark(place, float(np.interp(place, line.x, line.y)), number(reaction, "kN"), line.hue))
    return Panel(
        x=along,
        y=axis(curves, "x", f"displacement of the {name} shaft", magnitude=False, symbol="u, v"),
        lines=lines,
        marks=marks,
        levels=[Level(hub.position / MM, "hub", vertical=True) for hub in inputs.couplings if hub.shaft == name],
        spans=[Span(start / MM, end / MM, "face") for start, end in faces_of(inputs)],
    )


def face_width(inputs: DriveTrainInputs) -> float:
    """Return the face width of the gears [m]."""
    return inputs.mesh.distribution.gears.face_width


def gap(inputs: DriveTrainInputs, result: DriveTrainResult) -> Figure:
    """Draw the gap between the flanks along the face, with the parts that come from shafts, heat and modification."""
    slopes, curves = result.misalignment, result.misalignment.curves
    gaps = {"shafts": curves.shaft, "heat": curves.thermal, "as ground": curves.modification, "total": curves.total}
    opened = axis(curves, "total", "gap, positive where the flanks part", magnitude=False)
    tilt = number(without_rounding(slopes.shaft_slope, slopes.shaft_range))
    heat = number(without_rounding(slopes.thermal_slope, slopes.thermal_range), "µm")
    wanted = f"first estimate of the helix slope to grind {number(slopes.recommended_helix_slope, 'µm')}"
    panel = Panel(x=face(face_width(inputs)), y=opened, lines=parts.lines(curves.position, gaps))
    return Figure(f"{decisive(result)}shafts {tilt}, heat {heat} over the face; {wanted}", [panel])


def slope_parts(_: DriveTrainInputs, result: DriveTrainResult) -> Figure:
    """Draw the parts of the gap's slope, one part for each cause."""
    slopes = result.misalignment
    causes = [Row(name, getattr(slopes.parts, part), hue) for name, part, hue in PARTS]
    totals = [
        Row("shafts, total", slopes.shaft_slope, Hue.PURPLE),
        Row("heat", slopes.thermal_slope, Hue.VERMILLION),
        Row("shafts and heat", slopes.total_slope, Hue.PURPLE),
    ]
    rows = [row for row in (*causes, *totals) if row.value != 0.0]
    if not rows:
        raise NoFigure(
            "no_misalignment",
            "Neither shafts nor heat open a gap between the flanks, so there is nothing to draw",
            "effects",
        )
    slope = axis(slopes, "total_slope", "slope of the gap over the face", magnitude=False)
    largest = max(causes, key=lambda row: abs(row.value))
    finding = f"most by the {largest.name}: {number(largest.value, 'µm')}" if largest.value else "heat alone"
    return Figure(f"{decisive(result)}{finding}", [Panel(x=slope, y=Axis("cause"), rows=rows)])


def effects_apart(inputs: DriveTrainInputs, result: DriveTrainResult) -> dict[str, Values]:
    """Compute the load along the face for variants of the unit in which some effects are left out.

    The effects come from shafts, couplings and heat. The variant `mesh alone` leaves out all effects. Every other
    variant leaves out a single effect. The keys are the names of the variants, and the values are transverse forces per
    face width [N/mm].
    """
    own, variants = inputs.effects, dict[str, Effects]()
    if own.shafts and inputs.acting_couplings:
        variants["without coupling"] = replace(own, coupling=False)
    if own.thermal and own.shafts:
        variants["without heat"] = replace(own, thermal=False)
        variants["without shafts"] = replace(own, shafts=False)
    if own.thermal or own.shafts:
        variants["mesh alone"] = Effects(shafts=False, coupling=False, thermal=False)
    warm = as_warm(inputs, result)
    plain = replace(
        warm, mesh=replace(warm.mesh, lubrication="closed_form"), states=("hot",)
    )  # the figure needs no film
    results = {name: solve(replace(plain, effects=effects)) for name, effects in variants.items()}
    return {name: values(_same_face(result, variant) / 1e3) for name, variant in results.items()}


def _same_face(result: DriveTrainResult, variant: DriveTrainResult) -> Values:
    """Return the transverse force per face width [N/m] of a variant, of two helices on the one that decides."""
    own = variant if variant.helices is None else variant.helices[(result.decisive_helix or 1) - 1]
    return own.misalignment.curves.line_force


def face_load(inputs: DriveTrainInputs, result: DriveTrainResult, others: dict[str, Values]) -> Figure:
    """Draw the load along the face with all effects of the case, and for variants in which some effects are left out.

    `others` holds the loads of the variants under the names of the variants.
    """
    curves, load = result.misalignment.curves, result.load
    if load.face_load_factor is None or load.face_load_at is None:
        raise NoFigure("no_load", "Without load there is no line load to draw", "operation")
    lines = [Line("as asked", curves.position, curves.line_force)]
    lines += [Line(name, curves.position, force, HUES[name], Role.REFERENCE) for name, force in others.items()]
    y = axis(curves, "line_force", "transverse force per face, mean over the roll")
    finding = f"K_Hβ = {number(load.face_load_factor)} at {percent(load.face_load_at)} of the face"
    return Figure(f"{decisive(result)}{finding}", [Panel(x=face(face_width(inputs)), y=y, lines=lines)])


def journals(inputs: DriveTrainInputs, result: DriveTrainResult) -> Figure:
    """Draw the position of each journal in its clearance."""
    wall = Line("clearance", np.cos(ROUND), np.sin(ROUND), Hue.GREY, named=False)
    across, up = (
        Axis(f"displacement over clearance, along {way}", magnitude=False, limits=WALLS, symbol=symbol)
        for way, symbol in (("X", "u_B/c"), ("Y", "v_B/c"))
    )
    panels, films = [], list[float]()
    used = (result.derived.pinion_shaft, result.derived.wheel_shaft)
    for name, state, shaft, derived in zip(("pinion", "wheel"), result.shafts, inputs.shafts, used, strict=True):
        lines, marks = [], []
        for index, (bearing, given) in enumerate(zip(state.bearings, shaft.bearings, strict=True)):
            if bearing.min_film is not None:
                films.append(bearing.min_film)
            clearance = derived.bearings[index].radial_clearance
            if bearing.eccentricity_ratio is None or clearance is None or not isinstance(given, JournalBearing):
                continue
            x, y = (float(part) / clearance for part in bearing.displacement)
            hue = (Hue.BLUE, Hue.VERMILLION)[index]
            named = name == "wheel"  # the legend stands beside the last panel
            path = _locus(x, y, bearing.reaction, law_of(given, inputs.bearing_film))
            lines.append(Line(f"bearing {index + 1}", *path, hue, named=named))
            marks.append(Mark(x, y, f"ε = {number(bearing.eccentricity_ratio)}", hue))
        if lines:
            panel = Panel(x=across, y=up, title=f"{name} shaft", lines=[wall, *lines], marks=marks, equal=True)
            panels.append(panel)
    if not panels:
        message = "The unit has no plain bearing; only a plain bearing has a clearance in which the journal moves"
        raise NoFigure("no_plain_bearing", message, "pinion_shaft")
    finding = f"thinnest film {number(min(films), 'µm')}; lines: as the load falls to zero"
    return Figure(finding, panels, beside=True)


def _locus(x: float, y: float, reaction: Vector2, law: FilmLaw) -> tuple[Values, Values]:
    """Return the path of a journal whose load grows from zero to the full load without changing its direction."""
    load = atan2(-reaction[1], -reaction[0])
    side = copysign(1.0, sin(atan2(y, x) - load))
    eccentricity = np.linspace(0.0, hypot(x, y), 60)
    angle = np.array([load + side * film_at(law, float(ratio)).attitude for ratio in eccentricity])
    return eccentricity * np.cos(angle), eccentricity * np.sin(angle)


def thrust(inputs: DriveTrainInputs, result: DriveTrainResult) -> Figure:
    """Draw the axial load of each shaft, and the bounds between which friction in the couplings may shift this load."""
    rows, usable, reversing = [], dict[float, list[str]](), []
    for name, given, state in zip(("pinion", "wheel"), inputs.shafts, result.shafts, strict=True):
        load = state.thrust
        bounds = None if load.lower is None or load.upper is None else (load.lower, load.upper)
        rows.append(Row(f"{name} shaft", load.mesh, Hue.GREY if bounds is None else Hue.BLUE, bounds))
        if load.reverses:
            reversing.append(name)
        if given.ultimate_thrust is not None:
            usable.setdefault(0.5 * given.ultimate_thrust, []).append(name)
    levels = []
    for half, names in usable.items():
        text = "half the ultimate load" if len(usable) == 1 else f"half the ultimate, {names[0]}"
        levels += [Level(end, name, limit=True, vertical=True) for end, name in ((half, text), (-half, ""))]
    title = "axial load towards +Z: of the mesh, and its bounds with the couplings"
    x = Axis(title, "N", magnitude=False, symbol="F_a")
    finding = f"friction can reverse the load of the {reversing[0]}" if reversing else "no load reverses"
    if result.axial is not None:
        carried = [(row.name, row.bounds) for row in rows if row.bounds is not None]
        texts = [f"{name} carries {' to '.join(number(end / NEWTONS) for end in ends)} kN" for name, ends in carried]
        finding = "; ".join([f"{result.axial.floating_shaft} floats", *texts])
    return Figure(finding, [Panel(x=x, y=Axis("shaft"), rows=rows, levels=levels)])


def losses(inputs: DriveTrainInputs, result: DriveTrainResult) -> Figure:
    """Draw the power losses of the unit, with one bar for each kind of loss."""
    lost, bearings = result.losses, (*inputs.pinion_shaft.bearings, *inputs.wheel_shaft.bearings)
    plain = any(isinstance(bearing, JournalBearing) for bearing in bearings)  # other bearings have no known friction
    powers: tuple[tuple[str, float | None, Hue], ...] = (
        ("plain bearings" if plain else "bearings", lost.bearings if plain else None, Hue.BLUE),
        ("mesh", lost.mesh, Hue.VERMILLION),
        ("pumping of air and mist", lost.pumping, Hue.GREEN),
        ("couplings", lost.coupling, Hue.ORANGE),
    )
    if result.heat is not None:
        powers += (
            ("oil brought to speed", lost.oil_acceleration, Hue.SKY),
            ("windage", lost.windage, Hue.PURPLE),
            ("other parts", lost.other, Hue.GREY),
        )
    rows = [Row(name, np.nan if power is None else power, hue) for name, power, hue in powers]
    finding = "without the loss of the mesh, whose coefficient of friction is not known"
    if lost.total is not None:
        finding = f"total {number(lost.total / NEWTONS, 'kW')}"
        if lost.efficiency is not None:
            finding += f", efficiency {number(100 * lost.efficiency, '%', digits=4)}"
        if not plain:
            finding += "; without the bearings"
    return Figure(finding, [Panel(x=Axis("power lost", "W", symbol="P"), y=Axis("where"), rows=rows)])


def as_warm(inputs: DriveTrainInputs, result: DriveTrainResult) -> DriveTrainInputs:
    """Unit at the temperatures of its heat balance. If there is no heat balance, return the unit unchanged."""
    heat, kelvin = result.heat, UNITS["c"].offset
    if heat is None:
        return inputs
    plain_bearings = iter(heat.bearings)
    films = [
        next(plain_bearings).film + kelvin if isinstance(bearing, JournalBearing) else np.nan
        for shaft in inputs.shafts
        for bearing in shaft.bearings
    ]
    flanks = (heat.pinion.flank + kelvin, heat.wheel.flank + kelvin)
    bodies = (heat.pinion.body + kelvin, heat.wheel.body + kelvin)
    return at_temperatures(inputs, flanks, bodies, films, None if heat.casing is None else heat.casing + kelvin)


def mesh_as_drawn(inputs: DriveTrainInputs, result: DriveTrainResult) -> Scuffing | None:
    """Solve the mesh without modifications, as if the shafts were rigid and the gears did not expand with heat."""
    warm = as_warm(inputs, result)
    contact, number = contact_of(warm), result.decisive_helix
    if result.helices is not None and number is not None:  # the decisive helix as a pair of its own
        given = contact.distribution
        alone = replace(
            given,
            gears=replace(given.gears, gap_width=None),
            load=replace(given.load, helix_share=result.helices[number - 1].share),
        )
        contact = replace(contact, distribution=alone)
    return micropitting.solve_unmodified(contact)


def where_micropitting_starts(inputs: DriveTrainInputs, result: DriveTrainResult, plain: Scuffing | None) -> Figure:
    """Draw two maps of the film ratio over the flank, one of the unit and one of the unmodified mesh."""
    answer = micropitting.answered(result)
    figure = micropitting.over_flanks(inputs.mesh, answer, result.flank, plain)
    return replace(figure, finding=f"{decisive(result)}{figure.finding}")


def wear(inputs: DriveTrainInputs, result: DriveTrainResult) -> Figure:
    """Draw the depth of wear over the flanks of pinion and wheel."""
    figure = micropitting.wear_on_flank(inputs.mesh, result)
    return replace(figure, finding=f"{decisive(result)}{figure.finding}")


def face_heat(inputs: DriveTrainInputs, result: DriveTrainResult) -> Figure:
    """Draw flank temperatures and load along the face, and in pale both as the heat of an even load makes them."""
    along = None if result.heat is None else result.heat.face
    if along is None:
        raise NoFigure(
            "uniform_face", "The temperatures along the face are uniform; ask for the profile", "model.face_heat"
        )
    even, x, load = along.uniform_heat, face(face_width(inputs)), result.misalignment.curves
    warm = axis(along.pinion, "flank", "flank temperature", magnitude=False)
    lines = [
        Line(f"{gear}{title}", along.position, curve, hue, role)
        for gear, hue, curves in (
            ("pinion", Hue.VERMILLION, (along.pinion.flank, even.pinion_flank)),
            ("wheel", Hue.BLUE, (along.wheel.flank, even.wheel_flank)),
        )
        for curve, title, role in zip(curves, ("", ", even heat"), (Role.RESULT, Role.REFERENCE), strict=True)
    ]
    forces = [
        Line("own heat", load.position, load.line_force, Hue.BLUE),
        Line("even heat", along.position, even.line_force, Hue.BLUE, Role.REFERENCE),
    ]
    carried = axis(load, "line_force", "transverse force per face, mean over the roll")
    panels = [
        Panel(x=x, y=warm, lines=lines, marks=parts.extreme(lines[::2])),
        Panel(x=x, y=carried, lines=forces, marks=parts.extreme(forces[:1])),
    ]
    if along.amplification is None:
        return Figure(f"{decisive(result)}unstable: one end of the face takes the load and heats itself", panels)
    factors = result.load.face_load_factor, even.face_load_factor
    spread = ""
    if None not in factors:
        now, before = (number(factor or 0.0) for factor in factors)
        spread = f", K_Hβ stays {now}" if now == before else f", K_Hβ from {before} to {now}"
    change = "raises" if along.amplification >= 1.0 else "lowers"
    by = number(along.amplification)
    return Figure(f"{decisive(result)}heat {change} the misalignment by a factor of {by}{spread}", panels)


def where_heat_goes(_: DriveTrainInputs, result: DriveTrainResult) -> Figure:
    """Draw the heat that the losses supply, the heat that leaves the gears, and the heat that leaves the unit."""
    figure = heat_balance.where_heat_goes(heat_balance.heat_of(result.heat))
    apart = "; without the couplings' loss" if result.losses.coupling else ""
    return replace(figure, finding=f"{figure.finding}{apart}")


def temperatures(inputs: DriveTrainInputs, result: DriveTrainResult) -> Figure:
    """Draw the temperatures of flanks, bodies, bearings and casing."""
    return heat_balance.temperatures(heat_balance.heat_of(result.heat), oil_temperature(inputs))


def oil_temperature(inputs: DriveTrainInputs) -> float:
    """Return the temperature of the supplied oil [°C]."""
    return inputs.mesh.temperatures.oil - UNITS["c"].offset


def curve_over_the_flow(_: DriveTrainInputs, result: DriveTrainResult) -> FlowCurve:
    """Solve the heat balance at oil flows between 0.25 and 4 times the oil flow of the case."""
    heat = heat_balance.heat_of(result.heat)
    assert result.over_the_flow is not None
    return result.over_the_flow(heat_balance.FLOWS * UNITS["l_per_min"].scale * heat.gear_flow)


def oil_flow(inputs: DriveTrainInputs, result: DriveTrainResult, curve: FlowCurve) -> Figure:
    """Draw the temperatures of flanks and drained oil, and the safety factor, over the oil flow to the gears."""
    scuffing, oil, used = None, oil_temperature(inputs), result.derived.temperatures
    heat, bulk = heat_balance.heat_of(result.heat), used.bulk
    if result.safety is not None and result.safety.minimum and used.scuffing is not None and bulk is not None:
        if result.helices is not None:  # the curve shows the unit, above which the decisive helix stays as now
            bulk = float(used.origin.bulk_at(np.array((heat.pinion.flank + heat.wheel.flank) / 2)))
        scuffing = (used.scuffing, oil + (used.scuffing - oil) / result.safety.minimum - bulk)
    return heat_balance.over_the_oil_flow(heat, curve, oil, scuffing, used.origin)


LOAD_ALONE = Declaration("face-load", "Load along the face", OWN, partial(face_load, others={}))
GAP = Declaration("gap", "Gap over the face by parts", OWN, gap)
METHOD, BALANCE = "temperatures.bulk_method", "asks_for_balance"
DOUBLE = "gears.gap_width_mm"  # its presence makes the gears double helical
FIGURES = (
    Declaration("shafts", "Shafts, bearings and couplings", "as described", shafts),
    Declaration("helices", "Load and gap of both helices", OWN, helix_figures.over_both, asked_by=DOUBLE),
    Declaration(
        "thrust-shares",
        "Shares and safety over the coupling's thrust",
        OWN,
        helix_figures.shares,
        compute=helix_figures.over_the_thrust,
        asked_by=DOUBLE,
    ),
    GAP,
    Declaration(
        "face-load", "Load along the face, with and without each effect", OWN, face_load, compute=effects_apart
    ),
    Declaration("contact-temperature", "Contact temperature on the flank", "Xue 2020, Eq. 25", contact_temperature),
    section(lambda inputs: inputs.mesh.distribution.gears),
    Declaration("shaft-lines", "Displaced shafts in both planes", OWN, shaft_lines),
    Declaration("slope-parts", "Where the misalignment comes from", OWN, slope_parts),
    Declaration(
        "face-heat",
        "Heat along the face, and what it does to the load",
        OWN,
        face_heat,
        asked_by=METHOD,
        asked_if=BALANCE,
    ),
    Declaration("flank-load", "Line load on the flank", "Xue 2020, Fig. 11", flank_load),
    Declaration(
        "micropitting",
        "Where will micropitting start?",
        "ISO/TR 15144-1, formula 2",
        where_micropitting_starts,
        compute=mesh_as_drawn,
        asked_by="micropitting",
    ),
    Declaration("wear", "Wear over the flanks", "Archard 1953", wear, asked_by="micropitting"),
    Declaration("journals", "Journals in the clearances of the plain bearings", "Reynolds 1886", journals),
    Declaration("thrust", "Axial load of the shafts", "API 613, 5th ed.", thrust),
    Declaration("losses", "Losses of the unit", OWN, losses),
    Declaration("heat-flows", "Where the heat goes", OWN, where_heat_goes, asked_by=METHOD, asked_if=BALANCE),
    Declaration("node-temperatures", "Temperatures of the unit", OWN, temperatures, asked_by=METHOD, asked_if=BALANCE),
    Declaration(
        "oil-flow",
        "What the oil flow does",
        OWN,
        oil_flow,
        compute=curve_over_the_flow,
        asked_by=METHOD,
        asked_if=BALANCE,
    ),
)
