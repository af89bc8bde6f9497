"""Sketches of machine parts to scale: the transverse section of a gear pair, and the shafts of a unit."""

from itertools import pairwise
from math import cos, pi, sin

import numpy as np

from app.figures.data import Axis, Figure, Hue, Line, Mark, Panel, Role, Span, Values, values
from app.figures.units import MM
from app.figures.wording import number
from solvers.drive_train.inputs import Bearing, DriveTrainInputs, JournalBearing, Shaft, floating_shaft
from solvers.gears.gear import Gear, fillet_point, root_profile
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.gears.pair import PathOfContact, meshing_path

WINDOW = 4.2, 3.6  # transverse modules on either side of the pitch point, across and along the line of centres
POINTS = 25  # points per fillet or flank


def transverse_section(inputs: GearPairInputs) -> Figure:
    """Draw the teeth in contact, the path of contact with its points, and the usable flanks."""
    path = meshing_path(inputs)
    pair, angle = path.pair, path.pair.working_pressure_angle
    along, tangent = np.array([cos(angle), sin(angle)]), path.pitch_point
    touching = tangent if path.start < tangent < path.end else (path.start + path.end) / 2.0
    reach = pair.transverse_module * np.array(WINDOW)
    shapes, lines = [], []
    for name, gear, teeth, centre, side, hue in (
        ("pinion", pair.pinion, inputs.pinion, -pair.pinion_working_radius, 1.0, Hue.BLUE),
        ("wheel", pair.wheel, inputs.wheel, pair.wheel_working_radius, -1.0, Hue.VERMILLION),
    ):
        roll = touching if side > 0.0 else pair.line_of_action - touching
        contact = (touching - tangent) * along - (0.0, centre)
        tooth = np.arctan2(contact[1], contact[0]) + gear.half_tooth_angle(np.hypot(gear.base_radius, roll))
        outline = _placed(*_outline(inputs, teeth, gear, tooth, reach[0]), centre)
        shapes.append(Line(f"{name}, {gear.teeth} teeth", *outline, hue))
        radius = np.hypot(gear.base_radius, np.linspace(gear.usable_roll_length, gear.tip_roll_length, POINTS))
        flank = _placed(radius, tooth - np.array([gear.half_tooth_angle(at) for at in radius]), centre)
        lines.append(Line("usable flanks", *flank, Hue.GREEN, named=side > 0.0))
    for title, ends, hue, role in (
        ("line of action", (0.0, pair.line_of_action), Hue.GREY, Role.REFERENCE),
        ("path of contact", (path.start, path.end), Hue.PURPLE, Role.RESULT),
    ):
        x, y = np.outer(along, np.array(ends) - tangent) / MM
        lines.append(Line(title, x, y, hue, role))
    points = ((name, (roll - tangent) / MM) for name, roll in points_of_contact(path).items())
    (across, up), ratio = reach / MM, path.transverse_contact_ratio
    panel = Panel(
        x=Axis("across the line of centres", "mm", magnitude=False, limits=(-across, across)),
        y=Axis("along the line of centres", "mm", magnitude=False, limits=(-up, up)),
        shapes=shapes,
        lines=lines,
        marks=[Mark(place * cos(angle), place * sin(angle), name, Hue.PURPLE) for name, place in points],
        equal=True,
    )
    diameters = (
        f"{name} usable from {number(2e3 * gear.form_radius, digits=4)} to {number(2e3 * gear.tip_radius, 'mm', 4)}"
        for name, gear in (("pinion", pair.pinion), ("wheel", pair.wheel))
    )
    return Figure(f"ε_α = {number(ratio)}; {', '.join(diameters)} in diameter", [panel])


def points_of_contact(path: PathOfContact) -> dict[str, float]:
    """Return the roll lengths [m] of the points A to E of the path of contact, measured on the pinion.

    A and E are the ends of the path. B lies one transverse base pitch before E, and D lies one transverse base pitch
    after A. C is the pitch point. If the contact ratio is at most 2, a transverse section has a single pair of teeth
    in contact between B and D. Points that are not on the path are left out.
    """
    pitch = path.pair.transverse_base_pitch
    points = {"A": path.start, "B": path.end - pitch, "C": path.pitch_point, "D": path.start + pitch, "E": path.end}
    return {name: roll for name, roll in points.items() if name in "AE" or path.start < roll < path.end}


def _outline(inputs: GearPairInputs, teeth: GearTeeth, gear: Gear, tooth: float, width: float) -> tuple[Values, Values]:
    """Return the outline of a tooth and its neighbours as radii [m] and polar angles [rad].

    `tooth` is the polar angle of the middle of the tooth [rad]. There are enough neighbours to fill `width` [m] on
    either side.
    """
    root = root_profile(inputs, teeth, gear)
    fillet = np.array([fillet_point(root.fillet, t) for t in np.linspace(0.0, root.fillet.end, POINTS)])
    flank = np.hypot(gear.base_radius, np.linspace(root.involute_roll, gear.tip_roll_length, POINTS))
    half = pi / gear.teeth
    space = np.array([half - gear.half_tooth_angle(at) for at in flank])
    radius, angle = np.concatenate([fillet[:, 0], flank]), np.concatenate([fillet[:, 1], space]) - half
    one = np.concatenate([radius, radius[::-1]]), np.concatenate([angle, -angle[::-1]])
    count = min(int(width / (half * gear.root_radius)) + 1, gear.teeth // 2)
    pitches = 2.0 * half * np.arange(-count, count + 1)
    around = tooth + np.add.outer(pitches, one[1]).ravel()
    inner = 0.5 * gear.root_radius
    return np.concatenate([np.tile(one[0], pitches.size), [inner, inner]]), np.append(around, around[[-1, 0]])


def _placed(radius: Values, angle: Values, centre: float) -> tuple[Values, Values]:
    """Convert polar coordinates [m, rad] about a centre on the ordinate into x and y [mm]."""
    return radius * np.cos(angle) / MM, (centre + radius * np.sin(angle)) / MM


def shafts(inputs: DriveTrainInputs, _: object) -> Figure:
    """Draw the shafts with their gears, bearings and coupling hubs in the plane of both axes."""
    gears = inputs.mesh.distribution.gears
    pair = meshing_path(gears).pair
    distance, faces = pair.centre_distance, faces_of(inputs)
    shapes, lines, marks = list[Line](), list[Line](), list[Mark]()
    for name, height, shaft, gear in zip(
        ("pinion", "wheel"), (0.0, distance), inputs.shafts, (pair.pinion, pair.wheel), strict=True
    ):
        ends = shaft.start + np.cumsum([0.0, *(section.length for section in shaft.sections)])
        for (start, end), section in zip(pairwise(ends), shaft.sections, strict=True):
            shapes.append(_box("shafts", start, end, height, section.outer_diameter / 2.0, Hue.GREY))
        shapes += [_box("gears", start, end, height, gear.tip_radius, Hue.SKY) for start, end in faces]
        hubs = [coupling for coupling in inputs.couplings if coupling.shaft == name]
        for hub in hubs:
            design, place, half = hub.coupling, hub.position, hub.coupling.face_width / 2.0
            radius = design.teeth * design.module / 2.0
            shapes.append(_box("coupling hubs", place - half, place + half, height, radius, Hue.ORANGE))
        shapes += [_bearing(bearing, shaft, height) for bearing in shaft.bearings]
        bearings = enumerate(shaft.bearings, 1)
        marks += [Mark(bearing.position / MM, height / MM, f"{number_}") for number_, bearing in bearings]
        machines = [
            hub.position + hub.coupling.hub_distance * (1.0 if hub.machine_side == "plus" else -1.0) for hub in hubs
        ]
        marks += [Mark(machine / MM, height / MM, "machine", Hue.ORANGE) for machine in machines]
        if len(faces) > 1 and name == floating_shaft(inputs):
            marks.append(Mark(ends[-1] / MM, height / MM, "floats", Hue.GREEN))
        far = values([min(shaft.start, shaft.end, *machines) / MM, max(shaft.start, shaft.end, *machines) / MM])
        lines.append(Line("axis", far, values([height / MM] * 2), Hue.GREY, Role.REFERENCE, named=False))
    spans = []
    if len(faces) > 1:
        (_, first), (second, _) = faces
        helix, between = (number(width / MM, digits=4) for width in (gears.face_width, second - first))
        spans = [Span(first / MM, second / MM, f"{helix} + {between} + {helix} mm")]
    panel = Panel(
        x=Axis("position along Z", "mm", magnitude=False),
        y=Axis("height above the axis of the pinion", "mm", magnitude=False),
        shapes=shapes,
        lines=lines,
        marks=marks,
        spans=spans,
        equal=True,
    )
    finding = f"pinion below, wheel {number(distance / MM, 'mm', digits=4)} above it"
    if len(faces) > 1:
        finding = f"{widths(gears)}; {finding}"
    return Figure(finding, [panel])


def faces_of(inputs: DriveTrainInputs) -> list[tuple[float, float]]:
    """Return the ends of each helix on the axis of the unit [m]."""
    gears = inputs.mesh.distribution.gears
    step = gears.face_width + (gears.gap_width or 0.0)
    starts = [inputs.face_start + place * step for place in range(gears.helices)]
    return [(start, start + gears.face_width) for start in starts]


def widths(gears: GearPairInputs) -> str:
    """Return the widths of double-helical gears as text: of both helices, of the gap, and of all together."""
    helix, gap, total = (
        number(width / MM, digits=4) for width in (gears.face_width, gears.gap_width or 0.0, gears.total_width)
    )
    return f"two helices of {helix} mm and a gap of {gap} mm, together {total} mm"


def _box(title: str, start: float, end: float, height: float, radius: float, hue: Hue) -> Line:
    """Return the outline [mm] of a cylinder seen from the side. Arguments that are lengths are in m."""
    x, y = np.array([start, end, end, start]) / MM, (height + radius * np.array([-1.0, -1.0, 1.0, 1.0])) / MM
    return Line(title, x, y, hue)


def _bearing(bearing: Bearing, shaft: Shaft, height: float) -> Line:
    """Return the outline of a bearing: a box for a plain bearing, else a triangle under the shaft."""
    place = bearing.position
    if isinstance(bearing, JournalBearing):
        start, end = place - bearing.width / 2.0, place + bearing.width / 2.0
        return _box("plain bearings", start, end, height, 0.65 * bearing.diameter, Hue.BLUE)
    ends = shaft.start + np.cumsum([section.length for section in shaft.sections])
    diameter = shaft.sections[min(int(np.searchsorted(ends, place)), len(ends) - 1)].outer_diameter
    x, y = place + diameter * np.array([-0.5, 0.5, 0.0]), height - diameter * np.array([1.4, 1.4, 0.5])
    return Line("bearings", x / MM, y / MM, Hue.BLUE)
