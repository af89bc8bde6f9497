"""The drive-train request of a stage: its two shafts in their bearings, along the axis of the pinion's shaft.

It is formed where each of the two shafts carries the one gear of this stage and is held by two radial bearings in the
casing. Z is the u axis of the pinion's shaft, X and Y are its v and w axes.
"""

from dataclasses import dataclass
from itertools import pairwise
from math import atan2, degrees
from typing import Any

from app.rexs import table
from app.rexs.draft import Draft
from app.rexs.model import Component
from app.rexs.reading import Vector
from app.rexs.stages import StageDraft, shaft_axis

MOST_SECTIONS = 40  # of a shaft, as the request allows
LONGEST_PIECE = 10.0  # mm of a cone that one cylinder stands for
SHORTEST_SECTION = 0.1  # mm
RIGID_FROM_N_PER_UM = 1e5  # chosen: some hundred times a plain bearing's stiffness
NAMES = ("pinion_shaft", "wheel_shaft")


@dataclass(frozen=True, slots=True)
class Frame:
    """Axes of the unit's frame as the drive train knows it, in the coordinates of the file."""

    x: Vector
    y: Vector
    z: Vector


def add_drive_train(stage: StageDraft, draft: Draft) -> bool:
    """Add the fields of the drive train to the draft of a stage; False where it cannot be formed, and why is noted."""
    reasons = list(_obstacles(stage))
    for component, reason in reasons:
        draft.lacks("/v1/drive-train", component, None, reason)
    if reasons:
        return False
    return _Unit(stage, draft).fill()


def _obstacles(stage: StageDraft) -> list[tuple[Component, str]]:
    """The reasons why the file does not describe a drive train that can be calculated."""
    found = []
    for place, shaft in enumerate(stage.shafts):
        gears = [each for each in stage.reading.model.parts_of(shaft.id) if "gear" in each.type.split("_")]
        others = [each for each in gears if each.id != stage.gears[place].id]
        if others:
            found.append((shaft, "the shaft carries another gear; a shaft with two meshes is not modelled"))
        bearings = _bearings(stage, shaft)
        if len(bearings) != len(NAMES):
            found.append((shaft, f"the shaft has {len(bearings)} radial bearings in the casing; two are needed"))
        if shaft_axis(stage.reading, shaft) is None:
            found.append((shaft, "the file does not say where the shaft lies (support_vector)"))
        if stage.face_interval(place) is None:
            found.append((stage.gears[place], "the file does not say where on its shaft the gear sits"))
    if stage.driver is None:
        found.append((stage.pair.stage, "power and speed of this stage do not follow from the file"))
    return found


def _bearings(stage: StageDraft, shaft: Component) -> list[Component]:
    """Radial bearings between the shaft and the casing."""
    found = []
    for relation in stage.reading.model.relations_of("side", "inner_part", shaft.id):
        components = stage.reading.model.components
        bearing, outer = (components.get(relation.part(role) or -1) for role in ("assembly", "outer_part"))
        if bearing is None or bearing.type not in table.RADIAL_BEARINGS or outer is None or outer.type != "gear_casing":
            continue
        if stage.reading.flag(bearing, "radial_force_absorption") is not False:
            found.append(bearing)
    return found


class _Unit:
    """Fills the fields of one drive train."""

    def __init__(self, stage: StageDraft, draft: Draft) -> None:
        self._stage, self._draft, self._reading = stage, draft, stage.reading
        self._frame = self._axes()

    def fill(self) -> bool:
        """Set all fields; False where the shafts' sections do not make a shaft."""
        stage, draft = self._stage, self._draft
        faces = [stage.face_interval(place) for place in (0, 1)]
        start = max(each[0] for each in faces if each is not None)
        draft.put("face_start_mm", start, stage.gears[0], "u_coordinate_on_shaft")
        speed = stage.flow.speed[stage.shafts[0].id]
        rotation = "counterclockwise" if speed > 0.0 else "clockwise"
        draft.put("operation.rotation", rotation, stage.shafts[0], "rotational_speed")
        self._directions()
        for place, name in enumerate(NAMES):
            if not self._shaft(place, name, start):
                return False
        self._couplings()
        return True

    def _axes(self) -> Frame:
        shaft = self._stage.shafts[0]
        axis = shaft_axis(self._reading, shaft)
        z = axis.direction if axis else (1.0, 0.0, 0.0)
        y = self._reading.vector(shaft, "w_axis_vector")
        if y is None or abs(_dot(y, z)) > 1e-6 or _dot(y, y) <= 0.0:
            y = min(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)), key=lambda each: abs(_dot(each, z)))
            y = _cross(_cross(z, y), z)
        size = _dot(y, y) ** 0.5
        y = (y[0] / size, y[1] / size, y[2] / size)
        return Frame(_cross(y, z), y, z)

    def _directions(self) -> None:
        stage, frame = self._stage, self._frame
        axes = [shaft_axis(self._reading, shaft) for shaft in stage.shafts]
        if axes[0] is not None and axes[1] is not None:
            between = _minus(axes[1].origin, axes[0].origin)
            angle = degrees(atan2(_dot(between, frame.y), _dot(between, frame.x)))
            self._draft.put("operation.wheel_angle_deg", angle, stage.shafts[1], "support_vector")
        unit = next((c for c in self._reading.model.components.values() if c.type == "gear_unit"), None)
        parts = [self._reading.number(unit, f"direction_vector_gravity_{axis}") for axis in "uvw"] if unit else [None]
        if unit is None or None in parts or not any(parts):
            self._draft.assume("operation.gravity_angle_deg", -90.0, "the file gives no direction of gravity")
            return
        u, v, w = (float(each or 0.0) for each in parts)
        direction = self._in_file(unit, (u, v, w))
        angle = degrees(atan2(_dot(direction, frame.y), _dot(direction, frame.x)))
        self._draft.put("operation.gravity_angle_deg", angle, unit, "direction_vector_gravity_v")

    def _in_file(self, component: Component, along: Vector) -> Vector:
        """A vector given along a component's own u, v, w axes, in the coordinates of the file."""
        u = self._reading.vector(component, "u_axis_vector") or (1.0, 0.0, 0.0)
        w = self._reading.vector(component, "w_axis_vector") or (0.0, 0.0, 1.0)
        v = _cross(w, u)
        return (
            along[0] * u[0] + along[1] * v[0] + along[2] * w[0],
            along[0] * u[1] + along[1] * v[1] + along[2] * w[1],
            along[0] * u[2] + along[1] * v[2] + along[2] * w[2],
        )

    def _shaft(self, place: int, name: str, face_start: float) -> bool:
        stage, shaft = self._stage, self._stage.shafts[place]
        sections = self._sections(place)
        if not sections:
            self._draft.lacks("/v1/drive-train", shaft, None, "the file has no sections of the shaft")
            return False
        start = sections[0][0]
        self._draft.put(f"{name}.start_mm", start, shaft)
        sections = self._under_teeth(place, name, sections, face_start)
        cylinders = [
            {"length_mm": end - begin, "outer_diameter_mm": outer, "inner_diameter_mm": inner}
            for begin, end, outer, inner in sections
        ]
        self._draft.put(f"{name}.sections", cylinders, shaft)
        bearings = sorted(
            (self._bearing(each, shaft, name, index) for index, each in enumerate(_bearings(stage, shaft))),
            key=lambda each: float(each.get("position_mm", 0.0)),
        )
        self._draft.put(f"{name}.bearings", bearings, shaft)
        material = next(iter(self._reading.model.references_of(shaft.id, "material")), None)
        for row in table.MATERIAL if material is not None else ():
            self._draft.take(row, material, f"{name}.")  # type: ignore[arg-type]
        self._torque_position(place, name)
        return True

    def _sections(self, place: int) -> list[tuple[float, float, float, float]]:
        """Begin, end, outer and inner diameter [mm] of each cylinder along Z; cones in pieces of their mean."""
        stage, shaft = self._stage, self._stage.shafts[place]
        reading = self._reading
        found, stacked = [], 0.0
        for part in reading.model.parts_of(shaft.id):
            if part.type != "shaft_section":
                continue
            length = reading.number(part, "length", "mm")
            outer = [reading.number(part, f"outer_diameter_{end}", "mm") for end in ("begin", "end")]
            inner = [reading.number(part, f"inner_diameter_{end}", "mm") or 0.0 for end in ("begin", "end")]
            if length is None or length <= 0.0 or outer[0] is None or outer[1] is None:
                reading.find("section", part, "length", "the section has no length or no diameters; left out")
                continue
            begin = reading.number(part, "u_coordinate_on_shaft", "mm")
            begin = stacked if begin is None else begin
            stacked = begin + length
            pieces = 1 if outer[0] == outer[1] and inner[0] == inner[1] else _pieces(length)
            for piece in range(pieces):
                share = (piece + 0.5) / pieces
                found.append(
                    (
                        begin + length * piece / pieces,
                        begin + length * (piece + 1) / pieces,
                        outer[0] + share * (outer[1] - outer[0]),
                        inner[0] + share * (inner[1] - inner[0]),
                    )
                )
        base = stage.position_of_coordinate(shaft, 0.0)
        sense = stage.along(shaft)
        if base is None:
            return []
        along = [
            (base + sense * begin, base + sense * end, outer, inner)
            if sense > 0.0
            else (base + sense * end, base + sense * begin, outer, inner)
            for begin, end, outer, inner in found
        ]
        return self._contiguous(sorted(along), shaft)

    def _contiguous(
        self, sections: list[tuple[float, float, float, float]], shaft: Component
    ) -> list[tuple[float, float, float, float]]:
        """The sections without gaps and overlaps; both are findings."""
        joined: list[tuple[float, float, float, float]] = []
        for begin, end, outer, inner in sections:
            here = joined[-1][1] if joined else begin
            if abs(begin - here) > SHORTEST_SECTION:
                self._reading.find("section", shaft, None, "the sections of the shaft leave a gap or overlap")
            if end - here >= SHORTEST_SECTION:
                joined.append((here, end, outer, inner))
        return joined

    def _under_teeth(
        self, place: int, name: str, sections: list[tuple[float, float, float, float]], face_start: float
    ) -> list[tuple[float, float, float, float]]:
        """Under the teeth the shaft has at least the reference diameter, as ISO 6336-1 counts an integral pinion."""
        gear = self._stage.involute(place)
        width = self._draft.fields.get(table.FACE_WIDTH.field)
        if gear is None or width is None:
            return sections
        ends = (face_start, face_start + width)
        changed, found = False, []
        for begin, end, outer, inner in sections:
            cuts = sorted({begin, end, *(each for each in ends if begin < each < end)})
            for low, high in pairwise(cuts):
                covered = low >= ends[0] - SHORTEST_SECTION and high <= ends[1] + SHORTEST_SECTION
                grown = covered and outer < gear.reference_diameter
                changed |= grown
                found.append((low, high, gear.reference_diameter if grown else outer, inner))
        if changed:
            reason = "under the teeth the reference diameter, as in ISO 6336-1"
            self._draft.note(f"{name}.sections", gear.reference_diameter, reason)
        return [each for each in found if each[1] - each[0] >= SHORTEST_SECTION]

    def _bearing(self, bearing: Component, shaft: Component, name: str, index: int) -> dict[str, Any]:
        reading = self._reading
        path = f"{name}.bearings.{index}"
        made: dict[str, Any] = {}
        position = self._stage.position(bearing, shaft)
        if position is None:
            self._draft.lacks(
                f"{path}.position_mm", bearing, "u_coordinate_on_shaft_inner_side", "where the bearing sits"
            )
        else:
            made["position_mm"] = position
        offsets = [reading.number(bearing, f"misalignment_in_{axis}_direction", "um") for axis in "vw"]
        if any(offsets):
            moved = self._in_file(shaft, (0.0, offsets[0] or 0.0, offsets[1] or 0.0))
            made["offset_um"] = [_dot(moved, self._frame.x), _dot(moved, self._frame.y)]
        if bearing.type == "hydrodynamic_radial_plain_bearing":
            return made | self._journal(bearing)
        stiffness = reading.number(bearing, "radial_stiffness", "N/um")
        if stiffness is not None and stiffness >= RIGID_FROM_N_PER_UM:
            return made | {"type": "rigid"}
        if not stiffness or stiffness < 0.0:
            message = "the file has no radial stiffness of the bearing"
            self._draft.lacks(f"{path}.stiffness_n_per_um", bearing, "radial_stiffness", message)
            return made | {"type": "linear"}
        return made | {"type": "linear", "stiffness_n_per_um": stiffness}

    def _journal(self, bearing: Component) -> dict[str, Any]:
        reading = self._reading
        made: dict[str, Any] = {"type": "journal"}
        rows = (
            ("diameter_mm", "inner_diameter", "mm", 1.0),
            ("width_mm", "width", "mm", 1.0),
            ("radial_clearance_um", "diameter_clearance_plain_bearing", "um", 0.5),
            ("film_temperature_c", "lubricant_feed_temperature", "C", 1.0),
        )
        for ours, attribute, unit, factor in rows:
            value = reading.number(bearing, attribute, unit)
            if value is not None:
                made[ours] = factor * value
        return made

    def _torque_position(self, place: int, name: str) -> None:
        shaft = self._stage.shafts[place]
        loads = [each for each in self._reading.model.parts_of(shaft.id) if each.type == "external_load"]
        turning = [each for each in loads if self._reading.flag(each, "transmits_torque") is not False]
        for load in turning:
            position = self._stage.position(load, shaft)
            if position is not None:
                self._draft.put(f"{name}.torque_position_mm", position, load, "u_coordinate_on_shaft")
                return
        self._draft.lacks(f"{name}.torque_position_mm", shaft, None, "where the torque enters or leaves the shaft")

    def _couplings(self) -> None:
        """A coupling has no tooth data in the file: the drive train is formed without it."""
        for shaft in self._stage.shafts:
            for relation in self._reading.model.relations_of("side", "inner_part", shaft.id):
                part = self._reading.model.components.get(relation.part("assembly") or -1)
                if part is not None and part.type in {"coupling", "switchable_coupling"}:
                    self._draft.lacks("couplings", part, None, "the file has no tooth data of the coupling; left out")


def _pieces(length: float) -> int:
    return min(max(int(-(-length // LONGEST_PIECE)), 1), MOST_SECTIONS // 4)


def paths(draft: Draft) -> dict[str, str]:
    """Path in the draft -> path in the request of /v1/drive-train."""
    known = {}
    for path in {**draft.fields, **draft.missing}:
        section = path.split(".")[0]
        if section == "load":
            known[path] = path.replace("load.", "operation.", 1)
        elif not path.startswith("/"):
            known[path] = path
    return known


def _dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _minus(a: Vector, b: Vector) -> Vector:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
