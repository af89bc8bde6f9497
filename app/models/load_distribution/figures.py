"""Figures of the load distribution: over the flank, over the roll position and along the path of contact."""

from collections.abc import Callable
from dataclasses import replace
from math import radians, tan
from typing import Any

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from app.figures import parts
from app.figures.data import ORDER, Axis, Figure, Hue, Level, Line, Map, Mark, NoFigure, Panel, Role, Scale, Values
from app.figures.declaration import Declaration
from app.figures.sketches import points_of_contact, transverse_section
from app.figures.units import MM, axis
from app.figures.wording import listed, number, percent
from solvers.drive_train.results import FlankMaps
from solvers.gears.inputs import GearPairInputs
from solvers.gears.pair import meshing_path
from solvers.scuffing.inputs import LoadDistributionInputs
from solvers.scuffing.results import Flank, LoadDistribution, Place

MOST_LINES = 12  # largest number of lines of contact on either side of the highest loaded line
FIFTHS = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0)  # ticks of an axis from 0 to 1
PROFILE = Axis("profile (0: A, 1: E)", limits=(0.0, 1.0), ticks=FIFTHS, symbol="ξ")
ROLL = Axis("roll position", "base pitches", limits=(0.0, 1.0), magnitude=False, symbol="φ")
PATH = Axis("path of contact (0: A, pinion root; 1: E, pinion tip)", limits=(0.0, 1.0), magnitude=False, symbol="Ψ")
NO_LOAD = "no load"


def face(width: float) -> Axis:
    """Return the axis along a face of this width [m]."""
    return Axis("position on the face, from the end that meshes first", "mm", limits=(0.0, width / MM), symbol="y")


def section(gears_of: Callable[[Any], GearPairInputs]) -> Declaration:
    """Return the declaration of the figure that shows the transverse section of the gears."""
    title = "Transverse section of the pair"
    return Declaration("section", title, "ISO 21771", lambda inputs, _: transverse_section(gears_of(inputs)))


def over_flank(
    width: float, flank: Flank | FlankMaps, shown: Axis, grid: Values, largest: float | None, at: Place | None
) -> Panel:
    """Return a map of the values `grid` over the flank; `width` is the face width [m].

    If `largest` is given and not zero, the map has a mark with this number. `at` is the position of the mark; if `at`
    is None, the mark stands at the largest value of `grid`.
    """
    y = flank.face_fraction * width / MM
    ends = 0.0, max(float(np.nanmax(grid, initial=0.0)), largest or 0.0) or 1.0
    mapped = Map(shown.title, shown.unit, y, flank.profile_fraction, grid, range=ends)
    marks = []
    if largest:
        mark = replace(parts.extreme_of_map(mapped), text=number(largest, shown.unit))
        if at is not None:
            mark = replace(mark, x=at.face_fraction * width / MM, y=at.profile_fraction)
        marks = [mark]
    return Panel(x=face(width), y=PROFILE, map=mapped, marks=marks)


def flank_load(inputs: LoadDistributionInputs, result: LoadDistribution) -> Figure:
    """Draw the line load over the flank, with a mark at the largest line load of all roll positions."""
    load, flank, shown = result.load, result.flank, axis(Flank, "line_load")
    panel = over_flank(inputs.gears.face_width, flank, shown, flank.line_load, load.max_line_load, load.max_at)
    spread = "" if load.face_load_factor is None else f", K_Hβ = {number(load.face_load_factor)}"
    carrying = f"contact pattern {percent(load.contact_fraction)}"
    finding = f"highest {number(load.max_line_load, 'N/mm')}{spread}; {carrying}"
    return Figure(finding if load.max_at else NO_LOAD, [panel])


def flank_pressure(inputs: LoadDistributionInputs, result: LoadDistribution) -> Figure:
    """Draw the Hertzian pressure over the flank, with a mark at the largest pressure of all roll positions."""
    largest, at, flank = result.pressure.max, result.pressure.max_at, result.flank
    panel = over_flank(inputs.gears.face_width, flank, axis(flank, "pressure"), flank.pressure, largest, at)
    finding = NO_LOAD
    if largest is None:
        finding = "no largest pressure: the path reaches a base circle"
    elif largest and at:
        place = f"{percent(at.face_fraction)} of the face, {percent(at.profile_fraction)} of the profile"
        finding = f"highest {number(largest, 'MPa')} at {place}"
    return Figure(finding, [panel], unsolved=int(np.isnan(flank.pressure).sum()))


def modification(inputs: LoadDistributionInputs, result: LoadDistribution) -> Figure:
    """Draw a map of the gap that the modifications leave between the unloaded flanks."""
    flank, width, gap = result.flank, inputs.gears.face_width, _modified(result.flank)
    y = flank.face_fraction * width / MM
    mapped = Map("gap between the unloaded flanks", "µm", y, flank.profile_fraction, gap, Scale.SIGNED)
    finding = f"from {number(float(gap.min()))} to {number(float(gap.max()), 'µm')}"
    return Figure(finding, [Panel(x=face(width), y=PROFILE, map=mapped)])


def _modified(flank: Flank) -> Values:
    """Return the gap that the modifications leave between the flanks. Raise NoFigure if there are no modifications."""
    if not flank.modification.any():
        raise NoFigure("no_modification", "The flanks are not modified: the gap between them is zero", "modifications")
    return flank.modification


def traces(inputs: LoadDistributionInputs, result: LoadDistribution) -> Figure:
    """Draw profile and helix charts. Removed material is drawn downwards.

    Each chart assumes that the whole modification is on one gear. The profiles are taken at the middle of the face, and
    are drawn over the diameter of the gear. The helix is taken at the middle of the profile.
    """
    flank, path = result.flank, meshing_path(inputs.gears)
    gap, pair, width = -_modified(flank), path.pair, inputs.gears.face_width
    profile, helix = gap[:, gap.shape[1] // 2], gap[gap.shape[0] // 2]
    roll = path.start + path.length * flank.profile_fraction
    depth = Axis("removed material downwards", "µm", magnitude=False)
    panels = []
    for name, gear, side, hue in (
        ("pinion", pair.pinion, 0.0, Hue.BLUE),
        ("wheel", pair.wheel, pair.line_of_action, Hue.VERMILLION),
    ):
        diameter = 2.0 * np.hypot(gear.base_radius, roll - side) / MM
        points = [
            Level(2.0 * float(np.hypot(gear.base_radius, at - side)) / MM, point, vertical=True, point=True)
            for point, at in points_of_contact(path).items()
        ]
        x = Axis(f"diameter of the {name}", "mm", magnitude=False, symbol="d_y")
        panels.append(parts.curve(x, depth, diameter, profile, hue, title=f"profile of the {name}", levels=points))
    along = flank.face_fraction * width / MM
    panels.append(parts.curve(face(width), depth, along, helix, title="helix of either"))
    ranges = [number(float(np.ptp(trace)), "µm") for trace in (profile, helix)]
    return Figure(f"profile over {ranges[0]}, helix over {ranges[1]}, each as if on one gear alone", panels)


def contact_line_load(inputs: LoadDistributionInputs, result: LoadDistribution) -> Figure:
    """Draw the line load along the lines of contact, at the roll position with the largest line load."""
    load, flank, geometry, width = result.load, result.flank, result.geometry, inputs.gears.face_width
    if load.max_at is None:
        raise NoFigure("no_load", "Without load there is no line load to draw", "load")
    y, start = flank.face_fraction * width / MM, load.max_at.face_fraction * width / MM
    profile = load.max_at.profile_fraction
    if not geometry.base_helix_angle:  # rows of the map are lines of contact; the load may jump from row to row
        profile = flank.profile_fraction[int(np.argmax(flank.line_load.max(axis=1)))]
    line_load = RegularGridInterpolator((flank.profile_fraction, y), flank.line_load, bounds_error=False)
    lines = []
    for pitches in range(-MOST_LINES, MOST_LINES + 1):
        across = (start - y) * tan(radians(geometry.base_helix_angle)) + pitches * geometry.transverse_base_pitch
        along = line_load(np.column_stack([profile + across / geometry.path_of_contact, y]))
        if np.isfinite(along).sum() > 1:
            name = f"{abs(pitches)} {'ahead' if pitches > 0 else 'behind'}" if pitches else "highest loaded line"
            lines.append(Line(name, y, along, ORDER[pitches % len(ORDER)]))
    highest = number(load.max_line_load, "N/mm")
    marks = [Mark(start, load.max_line_load, highest)]
    factor = "" if load.face_load_factor is None else f"K_Hβ = {number(load.face_load_factor)}; "
    finding = f"{factor}highest {highest} at {number(start, 'mm')}"
    return Figure(finding, [Panel(x=face(width), y=axis(flank, "line_load"), lines=lines, marks=marks)])


def transmission_error(_: LoadDistributionInputs, result: LoadDistribution) -> Figure:
    """Draw the transmission error and the length of the lines of contact over the roll position."""
    error, lines = result.transmission_error, result.contact_lines
    y, mean = axis(error.curves, "error", magnitude=False), Level(error.mean, f"mean {number(error.mean, 'µm')}")
    length = axis(lines.curves, "length")
    amplitude = Axis("amplitude of the transmission error", "µm", symbol="TE_k")
    panels = [
        parts.curve(ROLL, y, error.curves.roll_position, error.curves.error, levels=[mean]),
        parts.curve(ROLL, length, lines.curves.roll_position, lines.curves.length, Hue.GREEN),
        parts.orders("order of the mesh", amplitude, 1, {"amplitude": error.harmonics}),
    ]
    contact = f"contact from {number(lines.min_length)} to {number(lines.max_length, 'mm')}"
    return Figure(f"peak to peak {number(error.peak_to_peak, 'µm')}; {contact}", panels)


def path_of_contact(inputs: LoadDistributionInputs, result: LoadDistribution) -> Figure:
    """Draw line load, pressure and sliding along the feature line, which is the diagonal of the flank."""
    curves, psi, pressure = result.feature_line, result.feature_line.psi, result.pressure.max
    points = path_points(inputs.gears)
    plain = parts.unnamed(points)
    load, hertz = axis(curves, "line_load", "line load"), axis(curves, "pressure", "Hertzian pressure")
    speed = Axis("sliding speed", "m/s", symbol="|u_1−u_2|")
    panels = [
        parts.curve(PATH, load, psi, curves.line_load, marked=True, levels=points),
        parts.curve(PATH, hertz, psi, curves.pressure, Hue.VERMILLION, marked=True, levels=plain),
        parts.curve(PATH, speed, psi, np.abs(curves.sliding), Hue.GREEN, levels=plain),
    ]
    along = [number(float(np.nanmax(curves.line_load, initial=0.0)), "N/mm")]
    anywhere = [number(result.load.max_line_load, "N/mm")]
    if pressure is not None:
        along.append(number(float(np.nanmax(curves.pressure, initial=0.0)), "MPa"))
        anywhere.append(number(pressure, "MPa"))
    finding = f"along the diagonal of the flank up to {listed(along)}; on the whole flank up to {listed(anywhere)}"
    unsolved = int(np.isnan(curves.pressure).sum())
    return Figure(NO_LOAD if result.load.max_at is None else finding, panels, unsolved=unsolved)


def path_points(gears: GearPairInputs) -> list[Level]:
    """Return vertical lines at the points A to E of the path of contact."""
    path = meshing_path(gears)
    fractions = {name: (roll - path.start) / path.length for name, roll in points_of_contact(path).items()}
    return [Level(fraction, name, vertical=True, point=True) for name, fraction in fractions.items()]


def stiffness(inputs: LoadDistributionInputs, result: LoadDistribution) -> Figure:
    """Draw the stiffness of one pair of teeth along the path of contact, and the stiffness by ISO 6336-1."""
    stiff, path = result.stiffness, meshing_path(inputs.gears)
    levels = [Level(stiff.standard_single, f"ISO 6336-1, one pair: {number(stiff.standard_single)}", listed=True)]
    if stiff.mean_mesh is not None:
        levels.append(Level(stiff.mean_mesh, f"mean of the loaded mesh: {number(stiff.mean_mesh)}", listed=True))
    for name, roll in points_of_contact(path).items():
        levels.append(Level(path.profile_parameter(roll - path.start), name, vertical=True, point=True))
    x = axis(stiff.curves, "gamma", "profile parameter", magnitude=False)
    y = axis(stiff.curves, "single", "stiffness of one pair per face width")
    panel = parts.curve(x, y, stiff.curves.gamma, stiff.curves.single, levels=levels)
    marks = [Mark(stiff.max_at_gamma, stiff.max, number(stiff.max, y.unit))]
    highest = f"highest {number(stiff.max)} at Γ = {number(stiff.max_at_gamma)}"
    ends = f"{number(stiff.approach)} at A, {number(stiff.recess, y.unit)} at E"
    return Figure(f"{highest}, {ends}", [replace(panel, marks=marks)])


def load_sharing(inputs: LoadDistributionInputs, result: LoadDistribution) -> Figure:
    """Draw the load sharing factor along the path of contact, and the factor by ISO/TS 6336-20."""
    curves, lines, finding = result.feature_line, list[Line](), NO_LOAD
    if curves.load_sharing is not None:
        lines.append(Line("this mesh", curves.psi, curves.load_sharing))
    marks = parts.extreme(lines)
    for mark in marks:
        times = f"{number(mark.y)} times the force per face width"
        finding = f"line load along the diagonal of the flank up to {times}, at Ψ = {number(mark.x)}"
    if curves.iso_load_sharing is not None:
        lines.append(Line("ISO/TS 6336-20", curves.psi, curves.iso_load_sharing, Hue.GREY, Role.REFERENCE))
    y = axis(curves, "load_sharing", "load sharing factor, w b / F_bt")
    return Figure(finding, [Panel(x=PATH, y=y, lines=lines, levels=path_points(inputs.gears), marks=marks)])


def pair_share(_: LoadDistributionInputs, result: LoadDistribution) -> Figure:
    """Draw, over the roll position, the share of the force that each line of contact carries."""
    if result.load.pair_share is None:
        raise NoFigure("no_load", "Without load there is no load sharing to draw", "load")
    roll, lines = result.transmission_error.curves.roll_position, list[Line]()
    for share in result.load.pair_share:
        if share.any():
            place = len(lines)
            role = Role.RESULT if place < len(ORDER) else Role.REFERENCE
            lines.append(Line(f"line {place + 1}", roll, share, ORDER[place % len(ORDER)], role))
    most = max(float(line.y.max()) for line in lines)
    panel = Panel(x=ROLL, y=Axis("share of the normal force", symbol="F_i/F"), lines=lines)
    return Figure(f"one line of contact carries up to {percent(most)} of the force", [panel])


FIGURES = (
    Declaration("flank-load", "Line load on the flank", "Xue 2020, Fig. 11", flank_load),
    Declaration("flank-pressure", "Hertzian pressure on the flank", "Xue 2020, Figs. 13, 16, 17", flank_pressure),
    Declaration(
        "contact-line-load",
        "Line load along the face at the worst roll position",
        "Xue 2020, section II",
        contact_line_load,
    ),
    Declaration(
        "transmission-error", "Transmission error and length of contact", "Xue 2020, Figs. 5, 12", transmission_error
    ),
    section(lambda inputs: inputs.gears),
    Declaration("modification", "Modification of the flank", "Xue 2020, Fig. 15", modification),
    Declaration("modification-traces", "Profile and helix charts", "Xue 2020, Fig. 15", traces),
    Declaration(
        "path-of-contact",
        "Load, pressure and sliding along the path of contact",
        "Xue 2020, Figs. 11, 13, 18",
        path_of_contact,
    ),
    Declaration("stiffness", "Stiffness of a pair of teeth along the path", "Xue 2020, Fig. 8", stiffness),
    Declaration("load-sharing", "Load sharing along the path of contact", "Xue 2020, Fig. 19", load_sharing),
    Declaration("pair-share", "Share of each pair of teeth over the roll", "Xue 2020, section II", pair_share),
)
