"""Sketches of machine parts, to scale: the transverse section of a gear pair, the shafts of a unit."""

from math import cos, pi, sin

import numpy as np

from app.figures.data import Axis, Figure, Hue, Line, Mark, Panel, Role, Shape, Values, values
from app.figures.units import MM
from app.figures.wording import number
from solvers.drive_train.inputs import Bearing, DriveTrainInputs, JournalBearing, Shaft, UnitCoupling
from solvers.gears.gear import Gear, RackFillet, fillet_point, root_profile
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.gears.pair import PathOfContact, meshing_path

WINDOW = 4.2, 3.6  # transverse modules to either side of the pitch point, across and along the line of centres
POINTS = 25  # of a fillet or a flank


def transverse_section(inputs: GearPairInputs) -> Figure:
    """Teeth in contact at the pitch point, the path of contact with its points, the usable flanks.

    The pitch point is the origin, the pinion lies below it and drives towards positive abscissae. Where the path has no
    pitch point the contact is in its middle.
    """
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
        shapes.append(Shape(f"{name}, {gear.teeth} teeth", values(outline[0] / MM), values(outline[1] / MM), hue))
        radius = np.hypot(gear.base_radius, np.linspace(gear.usable_roll_length, gear.tip_roll_length, POINTS))
        flank = _placed(radius, tooth - np.array([gear.half_tooth_angle(each) for each in radius]), centre)
        lines.append(Line("usable flanks", values(flank[0] / MM), values(flank[1] / MM), Hue.GREEN, named=side > 0.0))
    for title, ends, hue, role in (
        ("line of action", (0.0, pair.line_of_action), Hue.GREY, Role.REFERENCE),
        ("path of contact", (path.start, path.end), Hue.PURPLE, Role.RESULT),
    ):
        x, y = np.outer(along, np.array(ends) - tangent) / MM
        lines.append(Line(title, values(x), values(y), hue, role))
    points = ((name, (roll - tangent) / MM) for name, roll in points_of_contact(path).items())
    marks = tuple(Mark(place * cos(angle), place * sin(angle), name, Hue.PURPLE) for name, place in points)
    (across, up), ratio = reach / MM, path.transverse_contact_ratio
    panel = Panel(
        x=Axis("across the line of centres", "mm", magnitude=False, limits=(-across, across)),
        y=Axis("along the line of centres", "mm", magnitude=False, limits=(-up, up)),
        shapes=tuple(shapes),
        lines=tuple(lines),
        marks=marks,
        equal=True,
    )
    diameters = (
        f"{name} usable from {number(2e3 * gear.form_radius, digits=4)} to {number(2e3 * gear.tip_radius, 'mm', 4)}"
        for name, gear in (("pinion", pair.pinion), ("wheel", pair.wheel))
    )
    return Figure(f"ε_α = {number(ratio)}; {', '.join(diameters)} in diameter", (panel,))


def points_of_contact(path: PathOfContact) -> dict[str, float]:
    """The points A to E of the path by their roll lengths on the pinion [m].

    A and E are its ends. Between B and D, each one transverse base pitch from the other end, one pair of teeth meshes
    in a transverse section (with a contact ratio up to 2); C is the pitch point, where the path has one.
    """
    pitch = path.pair.transverse_base_pitch
    points = {"A": path.start, "B": path.end - pitch, "C": path.pitch_point, "D": path.start + pitch, "E": path.end}
    return {name: roll for name, roll in points.items() if name in "AE" or path.start < roll < path.end}


def _outline(inputs: GearPairInputs, teeth: GearTeeth, gear: Gear, tooth: float, width: float) -> tuple[Values, Values]:
    """Radius [m] and polar angle [rad] of the teeth as wide as the window to both sides of one at an angle."""
    root = root_profile(inputs, teeth, gear)
    fillet = np.array([_fillet(root.fillet, t) for t in np.linspace(0.0, root.fillet.end, POINTS)])
    flank = np.hypot(gear.base_radius, np.linspace(root.involute_roll, gear.tip_roll_length, POINTS))
    half = pi / gear.teeth
    space = np.array([half - gear.half_tooth_angle(each) for each in flank])
    radius, angle = np.concatenate([fillet[:, 0], flank]), np.concatenate([fillet[:, 1], space]) - half
    one = np.concatenate([radius, radius[::-1]]), np.concatenate([angle, -angle[::-1]])
    count = min(int(width / (half * gear.root_radius)) + 1, gear.teeth // 2)
    pitches = 2.0 * half * np.arange(-count, count + 1)
    around = tooth + np.add.outer(pitches, one[1]).ravel()
    inner = 0.5 * gear.root_radius
    return np.concatenate([np.tile(one[0], pitches.size), [inner, inner]]), np.append(around, around[[-1, 0]])


def _fillet(fillet: RackFillet, t: float) -> tuple[float, float]:
    return fillet_point(fillet, t)


def _placed(radius: Values, angle: Values, centre: float) -> Values:
    """Polar coordinates about a centre on the ordinate as x and y [m]."""
    return np.array([radius * np.cos(angle), centre + radius * np.sin(angle)])


def shafts(inputs: DriveTrainInputs, _: object) -> Figure:
    """Shafts with their gears, bearings and coupling hubs in the plane of both axes."""
    gears = inputs.mesh.distribution.gears
    pair = meshing_path(gears).pair
    heights = {"pinion": 0.0, "wheel": pair.centre_distance}
    shapes, lines, marks = list[Shape](), list[Line](), list[Mark]()
    for (name, height), shaft, gear in zip(heights.items(), inputs.shafts, (pair.pinion, pair.wheel), strict=True):
        shapes += _sections(shaft, height)
        start, end = inputs.face_start, inputs.face_start + gears.face_width
        shapes.append(_box("gears", start, end, height, gear.tip_radius, Hue.SKY))
        hubs = [each for each in inputs.couplings if each.shaft == name]
        shapes += [_hub(each, height) for each in hubs]
        shapes += [_bearing(each, shaft, height) for each in shaft.bearings]
        marks += [Mark(each.position / MM, height / MM, f"{place}") for place, each in enumerate(shaft.bearings, 1)]
        ends = [shaft.start, shaft.end, *(_machine(each) for each in hubs)]
        axis = values([min(ends) / MM, max(ends) / MM]), values([height / MM] * 2)
        lines.append(Line("axis", *axis, Hue.GREY, Role.REFERENCE, named=False))
        marks += [Mark(_machine(each) / MM, height / MM, "machine", Hue.ORANGE) for each in hubs]
    panel = Panel(
        x=Axis("position along Z", "mm", magnitude=False),
        y=Axis("height above the axis of the pinion", "mm", magnitude=False),
        shapes=tuple(shapes),
        lines=tuple(lines),
        marks=tuple(marks),
        equal=True,
    )
    return Figure(f"pinion below, wheel {number(pair.centre_distance / MM, 'mm', digits=4)} above it", (panel,))


def _box(title: str, start: float, end: float, height: float, radius: float, hue: Hue) -> Shape:
    """A cylinder seen from the side; lengths [m]."""
    x, y = np.array([start, end, end, start]) / MM, (height + radius * np.array([-1.0, -1.0, 1.0, 1.0])) / MM
    return Shape(title, values(x), values(y), hue)


def _sections(shaft: Shaft, height: float) -> list[Shape]:
    ends = shaft.start + np.cumsum([0.0, *(each.length for each in shaft.sections)])
    return [
        _box("shafts", float(ends[place]), float(ends[place + 1]), height, each.outer_diameter / 2.0, Hue.GREY)
        for place, each in enumerate(shaft.sections)
    ]


def _bearing(bearing: Bearing, shaft: Shaft, height: float) -> Shape:
    """A plain bearing as long as it is; another one a triangle under the shaft."""
    place = bearing.position
    if isinstance(bearing, JournalBearing):
        start, end = place - bearing.width / 2.0, place + bearing.width / 2.0
        return _box("plain bearings", start, end, height, 0.65 * bearing.diameter, Hue.BLUE)
    ends = shaft.start + np.cumsum([each.length for each in shaft.sections])
    diameter = shaft.sections[min(int(np.searchsorted(ends, place)), len(ends) - 1)].outer_diameter
    x, y = place + diameter * np.array([-0.5, 0.5, 0.0]), height - diameter * np.array([1.4, 1.4, 0.5])
    return Shape("bearings", values(x / MM), values(y / MM), Hue.BLUE)


def _hub(coupling: UnitCoupling, height: float) -> Shape:
    """The teeth of the hub."""
    design, place = coupling.coupling, coupling.position
    radius, half = design.teeth * design.module / 2.0, design.face_width / 2.0
    return _box("coupling hubs", place - half, place + half, height, radius, Hue.ORANGE)


def _machine(coupling: UnitCoupling) -> float:
    """Where the machine's hub is [m]."""
    return coupling.position + coupling.coupling.hub_distance * (1.0 if coupling.machine_side == "plus" else -1.0)
