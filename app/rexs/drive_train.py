"""The drive-train request of a stage. The request describes both shafts and the bearings of both shafts.

A stage has a drive-train request if both shafts carry only the gears of this stage, and if each shaft runs in two
radial bearings in the casing. Positions are along the axis Z of the pinion's shaft. Z is the u axis of this shaft in
the file; X and Y are the v and w axes of this shaft.
"""

from collections.abc import Iterator
from itertools import pairwise
from math import atan2, degrees
from typing import Any, NamedTuple

from app.rexs import table
from app.rexs.helices import helices_of
from app.rexs.model import Component
from app.rexs.reading import Vector
from app.rexs.stages import ROLES, StageDraft

MOST_PIECES = 10  # largest number of cylinders that replace a cone; a request allows 40 sections per shaft
LONGEST_PIECE = 10.0  # mm; largest length of a cylinder that replaces a part of a cone, if MOST_PIECES are enough
SHORTEST_SECTION = 0.1  # mm; shorter sections are left out
RIGID_FROM_N_PER_UM = 1e5  # bearings at least this stiff are rigid; chosen: 100 times the stiffness of plain bearings
STANDARD_GRAVITY = 9.80665  # m/s^2
NAMES = ("pinion_shaft", "wheel_shaft")


class ShaftSection(NamedTuple):
    """A cylindrical section of a shaft: the positions of both ends along Z, the outer and the inner diameter [mm]."""

    begin: float
    end: float
    outer: float
    inner: float


def add_drive_train(stage: StageDraft) -> bool:
    """Add the fields of the drive train to the draft of a stage, and return True on success.

    Return False if the file does not describe a drive train that can be calculated. The draft then lists the reasons as
    missing values.
    """
    reasons = list(_obstacles(stage))
    for component, reason in reasons:
        stage.lacks("/v1/drive-train", component, None, reason)
    return not reasons and _DriveTrain(stage).fill()


def _obstacles(stage: StageDraft) -> Iterator[tuple[Component, str]]:
    """Yield the reasons why the file does not describe a drive train that can be calculated."""
    own = {gear.id for helix in helices_of(stage) for gear in helix.gears}
    for gear, shaft, place in zip(stage.gears, stage.shafts, (0, 1), strict=True):
        parts = stage.reading.model.parts_of(shaft.id)
        if any("gear" in part.type.split("_") and part.id not in own for part in parts):
            yield shaft, "the shaft carries another gear; shafts with two meshes are not modelled"
        bearings = bearings_of(stage, shaft)
        if len(bearings) != len(NAMES):
            yield shaft, f"the shaft has {len(bearings)} radial bearings in the casing; exactly two are needed"
        if stage.reading.axis(shaft) is None:
            yield shaft, "the file does not say where the shaft lies (support_vector)"
        if stage.face_interval(place) is None:
            yield gear, "the file does not say at which position of the shaft the gear sits"
    if stage.driver is None or not stage.flow.knows(stage.pair):
        reason = "the file does not determine the power and the speed of this stage"
        if stage.stage.id in stage.flow.hidden:
            reason = "the power and the speed of this stage are determined through a stage that is not modelled"
        yield stage.stage, reason


def bearings_of(stage: StageDraft, shaft: Component) -> list[Component]:
    """Return the radial bearings between the shaft and the casing."""
    bearings, model = [], stage.reading.model
    for relation in model.relations_of("side", "inner_part", shaft.id):
        bearing, outer = model.part(relation, "assembly"), model.part(relation, "outer_part")
        if bearing is None or bearing.type not in table.RADIAL_BEARINGS or outer is None or outer.type != "gear_casing":
            continue
        if stage.reading.flag(bearing, "radial_force_absorption") is not False:
            bearings.append(bearing)
    return bearings


class _DriveTrain:
    """Builder that fills in the fields of one drive train."""

    def __init__(self, stage: StageDraft) -> None:
        self._stage, self._reading = stage, stage.reading
        axes = [self._reading.axis(shaft) for shaft in stage.shafts]
        self._axes = [axis for axis in axes if axis is not None]
        z, y = self._axes[0].direction, self._reading.vector(stage.shafts[0], "w_axis_vector")
        if y is None or abs(_dot(y, z)) > 1e-6 or _dot(y, y) <= 0.0:
            y = min(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)), key=lambda axis: abs(_dot(axis, z)))
            y = _cross(_cross(z, y), z)
        size = _dot(y, y) ** 0.5
        self._y = y[0] / size, y[1] / size, y[2] / size
        self._x = _cross(self._y, z)

    def fill(self) -> bool:
        """Fill in all fields of the drive train, and return True. Return False if a shaft has no sections."""
        stage = self._stage
        stage.put("face_start_mm", stage.face_start, stage.gears[0], "u_coordinate_on_shaft")
        speed = stage.flow.speed[stage.shafts[0].id]
        rotation = "counterclockwise" if speed > 0.0 else "clockwise"
        stage.put("operation.rotation", rotation, stage.shafts[0], "rotational_speed")
        self._directions()
        stage.take(table.REFERENCE_TEMPERATURE, self._reading.model.first("gear_unit"))
        for gear, row in zip(stage.gears, table.TOOTH_TEMPERATURES, strict=True):
            stage.take(row, gear)
        for place in (0, 1):
            if not self._shaft(place):
                return False
        for shaft in stage.shafts:
            for part in self._reading.model.related("side", "inner_part", shaft.id, "assembly"):
                if part.type in table.JOINTS:
                    stage.lacks(
                        "couplings", part, None, "the file has no tooth data of the coupling; the coupling is left out"
                    )
        return True

    def _directions(self) -> None:
        (pinion, wheel), reading = self._axes, self._reading
        x, y, z = (b - a for a, b in zip(pinion.origin, wheel.origin, strict=True))
        self._stage.put("operation.wheel_angle_deg", self._angle((x, y, z)), self._stage.shafts[1], "support_vector")
        unit, path = reading.model.first("gear_unit"), "operation.gravity_angle_deg"
        if unit is not None and reading.flag(unit, "account_for_gravity") is False:
            self._stage.put("operation.gravity_factor", 0.0, unit, "account_for_gravity")
        elif unit is not None and (weight := reading.number(unit, "gravitational_acceleration", "m/s^2")):
            self._stage.put("operation.gravity_factor", weight / STANDARD_GRAVITY, unit, "gravitational_acceleration")
        parts = [reading.number(unit, f"direction_vector_gravity_{axis}") for axis in "uvw"]
        if unit is None or None in parts or not any(parts):
            self._stage.assume(path, -90.0, "the file gives no direction of gravity")
            return
        u, v, w = (part or 0.0 for part in parts)
        self._stage.put(path, self._angle(self._in_file(unit, (u, v, w))), unit, "direction_vector_gravity_v")

    def _angle(self, direction: Vector) -> float:
        """Return the angle [deg] from the X axis to a direction, positive towards the Y axis."""
        return degrees(atan2(_dot(direction, self._y), _dot(direction, self._x)))

    def _in_file(self, component: Component, along: Vector) -> Vector:
        """Convert a vector from the u, v, w axes of a component to the coordinates of the file."""
        u = self._reading.vector(component, "u_axis_vector") or (1.0, 0.0, 0.0)
        w = self._reading.vector(component, "w_axis_vector") or (0.0, 0.0, 1.0)
        x, y, z = (_dot(along, axes) for axes in zip(u, _cross(w, u), w, strict=True))
        return x, y, z

    def _shaft(self, place: int) -> bool:
        stage, shaft, name = self._stage, self._stage.shafts[place], NAMES[place]
        sections = self._sections(shaft)
        if not sections:
            stage.lacks("/v1/drive-train", shaft, None, "the file has no sections of the shaft")
            return False
        stage.put(f"{name}.start_mm", sections[0].begin, shaft)
        cylinders = [
            {"length_mm": end - begin, "outer_diameter_mm": outer, "inner_diameter_mm": inner}
            for begin, end, outer, inner in self._under_teeth(place, sections)
        ]
        stage.put(f"{name}.sections", cylinders, shaft)
        placed = [(stage.position(bearing, shaft), bearing) for bearing in bearings_of(stage, shaft)]
        placed.sort(key=lambda place_and_bearing: place_and_bearing[0] or 0.0)
        bearings = [
            self._bearing(bearing, position, shaft, f"{name}.bearings.{index}")
            for index, (position, bearing) in enumerate(placed)
        ]
        stage.put(f"{name}.bearings", bearings, shaft)
        material = self._reading.model.reference_of([shaft], "material")
        for row in table.MATERIAL:
            stage.take(row, material, f"{name}.")
        self._torque_position(shaft, f"{name}.torque_position_mm")
        return True

    def _sections(self, shaft: Component) -> list[ShaftSection]:
        """Return the sections of a shaft."""
        reading, stage = self._reading, self._stage
        base, sense = stage.position_of_coordinate(shaft, 0.0) or 0.0, stage.along(shaft)
        cylinders, stacked = [], 0.0
        for part in reading.model.parts_of(shaft.id):
            if part.type != "shaft_section":
                continue
            length = reading.number(part, "length", "mm")
            outer, end_outer = (reading.number(part, f"outer_diameter_{end}", "mm") for end in ("begin", "end"))
            inner, end_inner = (reading.number(part, f"inner_diameter_{end}", "mm") or 0.0 for end in ("begin", "end"))
            if length is None or length <= 0.0 or outer is None or end_outer is None:
                reading.find(
                    "section", part, "length", "the section has no length or no diameter; the section is left out"
                )
                continue
            begin = reading.number(part, "u_coordinate_on_shaft", "mm")
            begin = stacked if begin is None else begin
            stacked = begin + length
            cone = outer != end_outer or inner != end_inner
            pieces = min(max(int(-(-length // LONGEST_PIECE)), 1), MOST_PIECES) if cone else 1
            for piece in range(pieces):
                share = (piece + 0.5) / pieces
                low, high = sorted(base + sense * (begin + length * edge / pieces) for edge in (piece, piece + 1))
                diameters = outer + share * (end_outer - outer), inner + share * (end_inner - inner)
                cylinders.append(ShaftSection(low, high, *diameters))
        return self._contiguous(sorted(cylinders), shaft)

    def _contiguous(self, sections: list[ShaftSection], shaft: Component) -> list[ShaftSection]:
        """Move the ends of the sections so that there are no gaps and no overlaps."""
        joined: list[ShaftSection] = []
        for section in sections:
            here = joined[-1].end if joined else section.begin
            if abs(section.begin - here) > SHORTEST_SECTION:
                self._reading.find(
                    "section", shaft, None, "between the sections of the shaft there is a gap or an overlap"
                )
            if section.end - here >= SHORTEST_SECTION:
                joined.append(section._replace(begin=here))
        return joined

    def _under_teeth(self, place: int, sections: list[ShaftSection]) -> list[ShaftSection]:
        """Enlarge the sections under the teeth to the diameter that carries torsion, d - m h_fP*."""
        gear, faces = self._stage.involute(place), self._stage.faces()
        if gear is None or not faces:
            return sections
        solid = gear.reference_diameter - gear.module * self._stage.fields[f"gears.{ROLES[place]}.dedendum"]
        changed, cylinders = False, []
        for begin, end, outer, inner in sections:
            cuts = sorted({begin, end, *(edge for face in faces for edge in face if begin < edge < end)})
            for low, high in pairwise(cuts):
                covered = any(
                    low >= start - SHORTEST_SECTION and high <= stop + SHORTEST_SECTION for start, stop in faces
                )
                grown = covered and outer < solid
                changed |= grown
                if high - low >= SHORTEST_SECTION:
                    cylinders.append(ShaftSection(low, high, solid if grown else outer, inner))
        if changed:
            reason = "under the teeth the shaft has the diameter that carries torsion, d - m h_fP*"
            self._stage.note(f"{NAMES[place]}.sections", solid, reason)
        return cylinders

    def _bearing(self, bearing: Component, position: float | None, shaft: Component, path: str) -> dict[str, Any]:
        reading, stage = self._reading, self._stage
        fields: dict[str, Any] = {}
        if position is None:
            attribute = "u_coordinate_on_shaft_inner_side"
            stage.lacks(f"{path}.position_mm", bearing, attribute, "the position of the bearing")
        else:
            fields["position_mm"] = position
        v, w = (reading.number(bearing, f"misalignment_in_{axis}_direction", "um") or 0.0 for axis in "vw")
        if v or w:
            moved = self._in_file(shaft, (0.0, v, w))
            fields["offset_um"] = [_dot(moved, self._x), _dot(moved, self._y)]
        if bearing.type == "hydrodynamic_radial_plain_bearing":
            fields["type"] = "journal"
            for row in table.JOURNAL:
                if (value := reading.number(bearing, row)) is not None:
                    fields[row.field] = value / 2.0 if row.field == "radial_clearance_um" else value
            if fields.get("oil_flow_l_per_min", 1.0) <= 0.0:  # without an oil flow, the solver uses the side leakage
                del fields["oil_flow_l_per_min"]
            relative = reading.number(bearing, "relative_clearance_plain_bearing")
            bore = reading.number(bearing, table.BEARING_BORE)
            if "radial_clearance_um" not in fields and relative is not None and bore is not None:
                # 500: 1000 um per mm, and the radial clearance is half the diametral clearance
                fields["radial_clearance_um"] = relative * bore * 500.0
            return fields
        stiffness = reading.number(bearing, "radial_stiffness", "N/um")
        if stiffness is not None and stiffness >= RIGID_FROM_N_PER_UM:
            return fields | {"type": "rigid"}
        if not stiffness or stiffness < 0.0:
            message = "the file does not state the radial stiffness of the bearing"
            stage.lacks(f"{path}.stiffness_n_per_um", bearing, "radial_stiffness", message)
            return fields | {"type": "linear"}
        return fields | {"type": "linear", "stiffness_n_per_um": stiffness}

    def _torque_position(self, shaft: Component, path: str) -> None:
        for load in self._reading.model.parts_of(shaft.id):
            if load.type != "external_load" or self._reading.flag(load, "transmits_torque") is False:
                continue
            position = self._stage.position(load, shaft)
            if position is not None:
                self._stage.put(path, position, load, "u_coordinate_on_shaft")
                return
        self._stage.lacks(path, shaft, None, "the position at which the torque enters or leaves the shaft")


def _dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
