"""Figures of a gear unit: shafts, gap and load along the face, load and temperature over the flank, thrust, losses."""

from dataclasses import replace
from functools import partial
from math import atan2, copysign, hypot, pi, sin

import numpy as np

from app.figures.data import (
    Axis,
    Critical,
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
    Values,
    values,
)
from app.figures.declaration import Declaration
from app.figures.models.load_distribution import face, over_flank, section
from app.figures.sketches import shafts
from app.figures.units import MM, axis
from app.figures.wording import number, percent
from solvers.drive_train import solve
from solvers.drive_train.inputs import DriveTrainInputs, Effects, JournalBearing, Shaft, Vector2
from solvers.drive_train.results import DriveTrainResult, FlankMaps, GapCurves, Misalignment, ShaftCurves, ShaftResult
from solvers.drive_train.shafts.bearings import attitude_angle


def flank_load(inputs: DriveTrainInputs, result: DriveTrainResult) -> Figure:
    """Line load over the flank under the gap that all parts agreed on."""
    flank, load, shown = result.flank, result.load, axis(FlankMaps, "line_load")
    panel = over_flank(face_width(inputs), flank, shown, flank.line_load, load.max_line_load, None)
    finding = f"highest {number(load.max_line_load, 'N/mm')}; contact pattern {percent(load.contact_fraction)}"
    factor = "" if load.face_load_factor is None else f", K_Hβ = {number(load.face_load_factor)}"
    return Figure(f"{finding}{factor}" if factor else "no load", (panel,))


def contact_temperature(inputs: DriveTrainInputs, result: DriveTrainResult) -> Figure:
    """Contact temperature by Blok over the whole flank, with its corners."""
    flank, shown = result.flank, axis(FlankMaps, "contact_temperature", "contact temperature")
    grid, limit = flank.contact_temperature, result.derived.temperatures.scuffing
    if result.derived.temperatures.bulk is None:
        raise NoFigure("no_oil", "Without an oil and a bulk temperature there is no contact temperature", "lubricant")
    if not np.isfinite(grid).all():
        raise NoFigure(
            "no_temperature",
            "The loaded path of contact reaches a base circle, where no temperature is defined",
            "gears",
        )
    low, high = float(grid.min()), float(grid.max())
    panel = over_flank(face_width(inputs), flank, shown, grid, high if high > low else None, None)
    assert panel.map is not None
    critical = (Critical(limit, "scuffing"),) if limit is not None and low < limit < high else ()
    colours = replace(panel.map, critical=critical, range=(low, high if high > low else low + 1.0))
    safety = result.safety.blok_flank if result.safety is not None else None
    finding = "" if safety is None else f", safety factor S_B = {number(safety)}"
    return Figure(f"up to {number(high, '°C', digits=4)}{finding}", (replace(panel, map=colours),))


OWN = "own derivation"
ROUND = np.linspace(0.0, 2.0 * pi, 181)  # a circle in steps of 2°
WALLS = -1.05, 1.05  # of the clearance, with some room
NEWTONS = 1e3  # per kilonewton
NOISE = 1e-9  # of a whole: a smaller part is rounding
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


def shaft_lines(inputs: DriveTrainInputs, result: DriveTrainResult) -> Figure:
    """Displaced axes of both shafts in both planes, with the reactions of their bearings."""
    states = result.shafts
    z = np.concatenate([state.curves.z for state in states])
    along = axis(
        ShaftCurves, "z", "position along Z", magnitude=False, symbol="", limits=(float(z.min()), float(z.max()))
    )
    panels = tuple(
        _shaft(inputs, name, own, state, along)
        for name, own, state in zip(("pinion", "wheel"), inputs.shafts, states, strict=True)
    )
    loads = [hypot(*bearing.reaction) for state in states for bearing in state.bearings]
    finding = f"bearings carry {number(min(loads) / NEWTONS)} to {number(max(loads) / NEWTONS, 'kN')}"
    return Figure(f"{finding}; marks are their reactions", panels)


def _shaft(inputs: DriveTrainInputs, name: str, given: Shaft, state: ShaftResult, along: Axis) -> Panel:
    curves = state.curves
    z = values(curves.z)
    lines, marks = [], []
    for plane, (title, shown, hue) in enumerate(
        (("along X", curves.x, Hue.BLUE), ("along Y", curves.y, Hue.VERMILLION))
    ):
        line = Line(title, z, values(shown), hue)
        lines.append(line)
        for bearing, found in zip(given.bearings, state.bearings, strict=True):
            place = bearing.position / MM
            height = float(np.interp(place, z, line.y))
            reaction = _without_rounding(found.reaction[plane], hypot(*found.reaction)) / NEWTONS
            marks.append(Mark(place, height, number(reaction, "kN"), hue))
    hubs = [Level(each.position / MM, "hub", vertical=True) for each in inputs.couplings if each.shaft == name]
    return Panel(
        x=along,
        y=axis(ShaftCurves, "x", f"displacement of the {name} shaft", magnitude=False, symbol="u, v"),
        lines=tuple(lines),
        marks=tuple(marks),
        levels=tuple(hubs),
        spans=(Span(inputs.face_start / MM, (inputs.face_start + face_width(inputs)) / MM, "face"),),
    )


def face_width(inputs: DriveTrainInputs) -> float:
    """Face width of the gears [m]."""
    return inputs.mesh.distribution.gears.face_width


def _without_rounding(value: float, whole: float) -> float:
    """The value; zero where it is rounding error relative to the whole."""
    return 0.0 if abs(value) < NOISE * abs(whole) else value


def gap(inputs: DriveTrainInputs, result: DriveTrainResult) -> Figure:
    """Gap over the face by shafts, heat and what is ground."""
    found = result.misalignment
    curves = found.curves
    y = values(curves.position)
    lines = (
        Line("shafts", y, values(curves.shaft), Hue.BLUE),
        Line("heat", y, values(curves.thermal), Hue.VERMILLION),
        Line("as ground", y, values(curves.modification), Hue.GREEN),
        Line("total", y, values(curves.total), Hue.PURPLE),
    )
    opened = axis(GapCurves, "total", "gap, positive where the flanks part", magnitude=False)
    tilt, heat = (
        _without_rounding(slope, span)
        for slope, span in (
            (found.shaft_slope, found.shaft_range),
            (found.thermal_slope, found.thermal_range),
        )
    )
    slopes = f"shafts {number(tilt)}, heat {number(heat, 'µm')} over the face"
    wanted = f"first estimate of the helix slope to grind {number(found.recommended_helix_slope, 'µm')}"
    return Figure(f"{slopes}; {wanted}", (Panel(x=face(face_width(inputs)), y=opened, lines=lines),))


def slope_parts(_: DriveTrainInputs, result: DriveTrainResult) -> Figure:
    """Where the misalignment comes from."""
    found = result.misalignment
    rows = [Row(name, getattr(found.parts, part), hue) for name, part, hue in PARTS]
    rows += [
        Row("shafts, total", found.shaft_slope, Hue.PURPLE),
        Row("heat", found.thermal_slope, Hue.VERMILLION),
        Row("shafts and heat", found.total_slope, Hue.PURPLE),
    ]
    shown = tuple(row for row in rows if row.value != 0.0)
    if not shown:
        raise NoFigure("no_misalignment", "Neither shafts nor heat open a gap, so there is nothing to draw", "effects")
    slope = axis(Misalignment, "total_slope", "slope of the gap over the face", magnitude=False)
    largest = max(rows[: len(PARTS)], key=lambda row: abs(row.value))
    finding = f"most by the {largest.name}: {number(largest.value, 'µm')}" if largest.value else "heat alone"
    return Figure(finding, (Panel(x=slope, y=Axis("cause"), rows=shown),))


def effects_apart(inputs: DriveTrainInputs, _: DriveTrainResult) -> dict[str, Values]:
    """Transverse force per face [N/mm] of the unit without each of its effects, and without all."""
    own, variants = inputs.effects, dict[str, Effects]()
    if own.shafts and inputs.acting_couplings:
        variants["without coupling"] = replace(own, coupling=False)
    if own.thermal and own.shafts:
        variants["without heat"] = replace(own, thermal=False)
        variants["without shafts"] = replace(own, shafts=False)
    if own.thermal or own.shafts:
        variants["mesh alone"] = Effects(shafts=False, coupling=False, thermal=False)
    return {name: _line_force(replace(inputs, effects=effects)) for name, effects in variants.items()}


def _line_force(inputs: DriveTrainInputs) -> Values:
    """Transverse force per face [N/mm]; no film is asked for."""
    closed = replace(inputs, mesh=replace(inputs.mesh, lubrication="closed_form"), states=("hot",))
    return values(solve(closed).misalignment.curves.line_force / 1e3)


def face_load(inputs: DriveTrainInputs, result: DriveTrainResult, others: dict[str, Values]) -> Figure:
    """Load along the face with all effects and without each."""
    curves, load = result.misalignment.curves, result.load
    y = values(curves.position)
    hues = {
        "without coupling": Hue.ORANGE,
        "without heat": Hue.VERMILLION,
        "without shafts": Hue.GREEN,
        "mesh alone": Hue.GREY,
    }
    lines = [Line("as asked", y, values(curves.line_force), Hue.BLUE)]
    lines += [Line(name, y, force, hues[name], Role.REFERENCE) for name, force in others.items()]
    if load.face_load_factor is None or load.face_load_at is None:
        raise NoFigure("no_load", "Without load there is none along the face", "operation")
    place = f"at {percent(load.face_load_at)} of the face"
    panel = Panel(
        x=face(face_width(inputs)),
        y=axis(GapCurves, "line_force", "transverse force per face, mean over the roll"),
        lines=tuple(lines),
    )
    return Figure(f"K_Hβ = {number(load.face_load_factor)} {place}", (panel,))


def journals(_: DriveTrainInputs, result: DriveTrainResult) -> Figure:
    """Journal positions of the plain bearings in their clearances, and their paths as the load changes (Ocvirk)."""
    panels = []
    used = (result.derived.pinion_shaft, result.derived.wheel_shaft)
    for name, state, known in zip(("pinion", "wheel"), result.shafts, used, strict=True):
        lines, marks = [], []
        for index, (bearing, given) in enumerate(zip(state.bearings, known.bearings, strict=True)):
            if bearing.eccentricity_ratio is None or given.radial_clearance is None:
                continue
            x, y = (float(each) / given.radial_clearance for each in bearing.displacement)
            hue = (Hue.BLUE, Hue.VERMILLION)[index]
            named = name == "wheel"  # beside it
            lines.append(Line(f"bearing {index + 1}", *_locus(x, y, bearing.reaction), hue, named=named))
            marks.append(Mark(x, y, f"ε = {number(bearing.eccentricity_ratio)}", hue))
        if lines:
            wall = Line("clearance", values(np.cos(ROUND)), values(np.sin(ROUND)), Hue.GREY, named=False)
            across, up = (
                Axis(f"displacement over clearance, along {way}", magnitude=False, limits=WALLS, symbol=symbol)
                for way, symbol in (("X", "u_B/c"), ("Y", "v_B/c"))
            )
            panels.append(
                Panel(x=across, y=up, title=f"{name} shaft", lines=(wall, *lines), marks=tuple(marks), equal=True)
            )
    if not panels:
        raise NoFigure(
            "no_plain_bearing", "Only plain bearings have a clearance in which a journal moves", "pinion_shaft"
        )
    least = min(each.min_film for state in result.shafts for each in state.bearings if each.min_film is not None)
    return Figure(f"thinnest film {number(least, 'µm')}; lines: as the load falls to zero", tuple(panels), beside=True)


def _locus(x: float, y: float, reaction: Vector2) -> tuple[Values, Values]:
    """From the middle of the clearance to a displacement over clearance, as the load grows in its direction."""
    load = atan2(-reaction[1], -reaction[0])
    side = copysign(1.0, sin(atan2(y, x) - load))
    eccentricity = np.linspace(0.0, hypot(x, y), 60)
    angle = np.array([load + side * attitude_angle(float(each)) for each in eccentricity])
    return values(eccentricity * np.cos(angle)), values(eccentricity * np.sin(angle))


def thrust(inputs: DriveTrainInputs, result: DriveTrainResult) -> Figure:
    """Axial load of both shafts between the bounds that the couplings' friction leaves."""
    named = tuple(zip(("pinion", "wheel"), inputs.shafts, result.shafts, strict=True))
    rows = []
    for name, _, state in named:
        low, high = state.thrust.lower, state.thrust.upper
        known = None if low is None or high is None else (low, high)
        rows.append(Row(f"{name} shaft", state.thrust.mesh, Hue.GREY if known is None else Hue.BLUE, known))
    usable = {name: 0.5 * shaft.ultimate_thrust for name, shaft, _ in named if shaft.ultimate_thrust is not None}
    alike = len(set(usable.values())) == 1
    limits = {
        load: "half the ultimate load" if alike else f"half the ultimate, {name}" for name, load in usable.items()
    }
    levels = [
        Level(sign * load, text if sign > 0.0 else "", limit=True, vertical=True)
        for load, text in limits.items()
        for sign in (1.0, -1.0)
    ]
    reversing = [name for name, _, state in named if state.thrust.reverses]
    finding = f"friction can reverse the load of the {reversing[0]}" if reversing else "no load reverses"
    panel = Panel(
        x=Axis(
            "axial load towards +Z: of the mesh, and its bounds with the couplings", "N", magnitude=False, symbol="F_a"
        ),
        y=Axis("shaft"),
        rows=tuple(rows),
        levels=tuple(levels),
    )
    return Figure(finding, (panel,))


def losses(inputs: DriveTrainInputs, result: DriveTrainResult) -> Figure:
    """What the unit loses, and where."""
    found = result.losses
    bearings = (*inputs.pinion_shaft.bearings, *inputs.wheel_shaft.bearings)
    plain = any(isinstance(each, JournalBearing) for each in bearings)  # no friction is known of other bearings
    parts = (
        ("plain bearings" if plain else "bearings", found.bearings if plain else None, Hue.BLUE),
        ("mesh", found.mesh, Hue.VERMILLION),
        ("pumping of air and mist", found.pumping, Hue.GREEN),
        ("couplings", found.coupling, Hue.ORANGE),
    )
    rows = tuple(Row(name, np.nan if power is None else power, hue) for name, power, hue in parts)
    efficiency = "" if found.efficiency is None else f", efficiency {number(100 * found.efficiency, '%', digits=4)}"
    if found.total is None:
        finding = "without the loss of the mesh, whose coefficient of friction is not known"
    else:
        finding = f"total {number(found.total / NEWTONS, 'kW')}{efficiency}" + (
            "" if plain else "; without the bearings"
        )
    return Figure(finding, (Panel(x=Axis("power lost", "W", symbol="P"), y=Axis("where"), rows=rows),))


LOAD_ALONE = Declaration("face-load", "Load along the face", OWN, partial(face_load, others={}))
GAP = Declaration("gap", "Gap over the face by parts", OWN, gap)
FIGURES = (
    Declaration("shafts", "Shafts, bearings and couplings", "as described", shafts),
    section(lambda inputs: inputs.mesh.distribution.gears),
    Declaration("shaft-lines", "Displaced shafts in both planes", OWN, shaft_lines),
    GAP,
    Declaration("slope-parts", "Where the misalignment comes from", OWN, slope_parts),
    Declaration(
        "face-load", "Load along the face, with and without each effect", OWN, face_load, compute=effects_apart
    ),
    Declaration("flank-load", "Line load on the flank", "Xue 2020, Fig. 11", flank_load),
    Declaration("contact-temperature", "Contact temperature on the flank", "Xue 2020, Eq. 25", contact_temperature),
    Declaration("journals", "Journals in the clearances of the plain bearings", "Ocvirk 1953", journals),
    Declaration("thrust", "Axial load of the shafts", "API 613, 5th ed.", thrust),
    Declaration("losses", "Losses of the unit", OWN, losses),
)
