"""The stages of a gear unit as requests: gears, load, oil, material, modifications of one mesh."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from math import acos, atan, cos, pi, radians, sqrt, tan
from typing import Any, NamedTuple

from app.rexs import table
from app.rexs.draft import Draft
from app.rexs.model import Component, LoadCase, Model
from app.rexs.power import Flow, Mesh
from app.rexs.reading import Reading
from solvers.gears.gear import involute
from solvers.gears.pair import inverse_involute

ISO_53_A = {"addendum": 1.0, "dedendum": 1.25, "rack_tip_radius": 0.38}  # in modules
SAME = 1e-6  # chosen: numbers stated twice that differ by less are equal
ROLES = ("pinion", "wheel")


class Pair(NamedTuple):
    """A stage with its two gears, as the file numbers them, each on its shaft."""

    stage: Component
    gears: tuple[Component, Component]
    shafts: tuple[Component, Component]

    @property
    def mesh(self) -> Mesh:
        """The pair in the flow of power."""
        teeth = tuple(int(float(str(gear.attributes["number_of_teeth"].value))) for gear in self.gears)
        return Mesh(self.stage.id, (self.shafts[0].id, self.shafts[1].id), (teeth[0], teeth[1]))


def pairs(reading: Reading) -> Iterator[Pair]:
    """The cylindrical stages of two external gears on shafts; every other stage is a finding."""
    for stage in reading.model.components.values():
        if stage.type in table.OTHER_STAGES:
            reading.find("stage_not_modelled", stage, None, f"{table.OTHER_STAGES[stage.type]}; the stage is left out")
        if stage.type == "cylindrical_stage" and (pair := _pair(reading, stage)) is not None:
            yield pair


def _pair(reading: Reading, stage: Component) -> Pair | None:
    model = reading.model
    if model.whole_of(stage.id, "planetary_stage") is not None:
        return None
    relation = next(iter(model.relations_of("stage", "stage", stage.id)), None)
    gears = [model.components.get(relation.part(role) or -1) for role in ("gear_1", "gear_2")] if relation else []
    if len(gears) != len(ROLES) or gears[0] is None or gears[1] is None:
        reading.find("relation_missing", stage, None, "the stage has no relation to two gears; it is left out")
        return None
    first, second = gears[0], gears[1]
    for gear in (first, second):
        if gear.type != "cylindrical_gear":
            reading.find("stage_not_modelled", stage, None, "only two external gears are modelled; left out")
            return None
        teeth = reading.number(gear, "number_of_teeth")
        if teeth is None or teeth != int(teeth) or not 1 <= teeth <= 10_000:
            reading.find("teeth", gear, "number_of_teeth", "the gear has no possible number of teeth; stage left out")
            return None
    shafts = [model.whole_of(gear.id, "shaft") or _joined_shaft(model, gear) for gear in (first, second)]
    if shafts[0] is None or shafts[1] is None or shafts[0].id == shafts[1].id:
        reading.find("relation_missing", stage, None, "the gears do not sit on two shafts; the stage is left out")
        return None
    return Pair(stage, (first, second), (shafts[0], shafts[1]))


def _joined_shaft(model: Model, gear: Component) -> Component | None:
    """The shaft that a gear is fastened to by a coupling."""
    for relation in model.relations_of("side", "outer_part", gear.id):
        inner = model.components.get(relation.part("inner_part") or -1)
        if inner is not None and inner.type == "shaft":
            return inner
    return None


@dataclass
class StageDraft:
    """One mesh on its way to requests; `order`: which gear of the file is the pinion, the one that drives.

    `case`: the load case whose load the requests carry, where the model itself states none.
    """

    reading: Reading
    pair: Pair
    flow: Flow
    senses: dict[int, float]
    case: LoadCase | None = None

    def __post_init__(self) -> None:
        """Start an empty draft."""
        self.draft = Draft(self.reading)

    @cached_property
    def driver(self) -> int | None:
        """Which gear of the file drives, where that is known."""
        return self.flow.driver(self.pair.mesh)

    @cached_property
    def order(self) -> tuple[int, int]:
        """Places of pinion and wheel in the file's pair: the driver is the pinion, else the smaller gear."""
        teeth = self.pair.mesh.teeth
        first = self.driver if self.driver is not None else int(teeth[1] < teeth[0])
        return first, 1 - first

    @property
    def gears(self) -> tuple[Component, Component]:
        """Pinion and wheel."""
        return self.pair.gears[self.order[0]], self.pair.gears[self.order[1]]

    @property
    def shafts(self) -> tuple[Component, Component]:
        """Shafts of pinion and wheel."""
        return self.pair.shafts[self.order[0]], self.pair.shafts[self.order[1]]

    @property
    def teeth(self) -> tuple[int, int]:
        """Tooth numbers of pinion and wheel."""
        teeth = self.pair.mesh.teeth
        return teeth[self.order[0]], teeth[self.order[1]]

    def fill(self) -> Draft:
        """All that the file says of the mesh."""
        self._gears()
        self._load()
        self._materials()
        self._oil()
        Modifications(self).fill()
        return self.draft

    def flank(self, place: int, side: str) -> Component | None:
        """The left or right flank of pinion (0) or wheel (1)."""
        return next(self.reading.model.related("flank", "gear", self.gears[place].id, side), None)

    def flanks(self, place: int) -> list[Component]:
        """Both flanks of a gear, as far as the file has them."""
        return [each for side in ("left", "right") if (each := self.flank(place, side)) is not None]

    def face_interval(self, place: int) -> tuple[float, float] | None:
        """Ends of a gear's face along the pinion shaft's axis [mm], where both shafts have a position."""
        width = self.reading.number(self.gears[place], table.FACE_WIDTH.attributes, "mm")
        middle = self.position(self.gears[place], self.shafts[place])
        if width is None or middle is None:
            return None
        return middle - width / 2.0, middle + width / 2.0

    def position(self, part: Component, shaft: Component) -> float | None:
        """Place of a part's middle along the pinion shaft's axis [mm]."""
        along = position_on_shaft(self.reading, part, shaft)
        return None if along is None else self.position_of_coordinate(shaft, along)

    def position_of_coordinate(self, shaft: Component, along: float) -> float | None:
        """Place of a coordinate on a shaft along the pinion shaft's axis [mm]."""
        if shaft.id == self.shafts[0].id:
            return along
        axis, base = shaft_axis(self.reading, shaft), shaft_axis(self.reading, self.shafts[0])
        if axis is None or base is None:
            return None
        start = sum((a - b) * u for a, b, u in zip(axis.origin, base.origin, base.direction, strict=True))
        return start + along * self.along(shaft)

    def along(self, shaft: Component) -> float:
        """+1 where the u axes of a shaft and of the pinion's shaft point the same way, else -1."""
        return self.senses.get(shaft.id, 1.0) * self.senses.get(self.shafts[0].id, 1.0)

    def _gears(self) -> None:
        draft, stage = self.draft, self.pair.stage
        for row in table.STAGE:
            draft.take(row, stage)
        for place, role in enumerate(ROLES):
            draft.put(f"gears.{role}.teeth", self.teeth[place], self.gears[place], "number_of_teeth")
        self._common(table.MODULE, "both gears must have one module")
        if "normal_module" not in self.gears[0].attributes and table.MODULE.field in draft.fields:
            draft.put("gears.module_plane", "transverse", self.gears[0], "transverse_module")
        self._helix()
        self._face_width()
        self._pressure_angle()
        for place, role in enumerate(ROLES):
            self._profile_shift(place, role)
            self._rack(place, role)
        self._rack_tip_radius()
        self._backlash()

    def _common(self, row: table.Row, message: str) -> float | None:
        """A number that both gears must share."""
        values = [self.reading.number(gear, row.attributes, row.unit) for gear in self.gears]
        known = [(value, gear) for value, gear in zip(values, self.gears, strict=True) if value is not None]
        if not known:
            self.draft.lacks(row.field, self.gears[0], row.attributes[0], f"the file has no {row.attributes[0]}")
            return None
        if len(known) > 1 and abs(known[0][0] - known[1][0]) > SAME * abs(known[0][0]):
            self.reading.find("gears_differ", known[1][1], row.attributes[0], f"{message}; the pinion's is used")
        self.draft.put(row.field, known[0][0], known[0][1], row.attributes[0])
        return known[0][0]

    def _helix(self) -> None:
        row = table.HELIX_ANGLE
        angles = [self.reading.number(gear, row.attributes, "deg") for gear in self.gears]
        known = next((each for each in angles if each is not None), None)
        if known is None:
            self.draft.assume(row.field, 0.0, "the file has no helix angle: spur gears")
            return
        if angles[0] is not None and angles[1] is not None and abs(angles[0] + angles[1]) > SAME * 90.0:
            message = "helix angles of an external pair are opposite; the pinion's is used"
            self.reading.find("helix_angles", self.gears[1], row.attributes[0], message)
        pinion = angles[0] if angles[0] is not None else -known
        self.draft.put(row.field, abs(pinion), self.gears[0], row.attributes[0])
        self.draft.put("gears.hand", "right" if pinion >= 0.0 else "left", self.gears[0], row.attributes[0])

    def _face_width(self) -> None:
        row = table.FACE_WIDTH
        widths = [self.reading.number(gear, row.attributes, "mm") for gear in self.gears]
        known = [each for each in widths if each is not None]
        if not known:
            self.draft.lacks(row.field, self.gears[0], row.attributes[0], "the file has no face width")
            return
        ends = [self.face_interval(0), self.face_interval(1)]
        common = min(known)
        if ends[0] is not None and ends[1] is not None:
            overlap = min(ends[0][1], ends[1][1]) - max(ends[0][0], ends[1][0])
            if overlap > 0.0:
                common = min(common, overlap)
            else:
                self.reading.find("faces_apart", self.pair.stage, None, "by their positions the faces do not overlap")
        self.draft.put(row.field, common, self.gears[0], row.attributes[0])
        if any(abs(each - common) > SAME * common for each in known):
            self.draft.note(row.field, common, "the face that both gears have in common")

    def _pressure_angle(self) -> None:
        row = table.PRESSURE_ANGLE
        wheel, pinion = self._of_flanks(1, row), self._of_flanks(0, row)  # the pinion's counts
        if wheel is None and pinion is None:
            self.draft.assume(row.field, 20.0, "the file has no pressure angle: ISO 53")
        elif wheel is not None and pinion is not None and abs(wheel - pinion) > SAME:
            message = "both gears must have one pressure angle; the pinion's is used"
            self.reading.find("gears_differ", self.gears[1], row.attributes[0], message)

    def _profile_shift(self, place: int, role: str) -> None:
        path = f"gears.{role}.profile_shift"
        if self._of_flanks(place, table.PROFILE_SHIFT, path) is not None:
            return
        flank, module = next(iter(self.flanks(place)), None), self.draft.fields.get(table.MODULE.field)
        length = self.reading.number(flank, "addendum_modification", "mm") if flank else None
        if flank is not None and length is not None and module:
            self.draft.put(path, length / module, flank, "addendum_modification")
        else:
            self.draft.assume(path, 0.0, "the file has no profile shift")

    def _of_flanks(self, place: int, row: table.Row, path: str | None = None) -> float | None:
        """A number of the flanks, which both must share."""
        found = [(each, self.reading.number(each, row.attributes, row.unit)) for each in self.flanks(place)]
        known = [(flank, value) for flank, value in found if value is not None]
        if not known:
            return None
        if any(abs(value - known[0][1]) > SAME for _, value in known):
            message = "left and right flank differ, which is not modelled; the left one's is used"
            self.reading.find("flanks_differ", known[1][0], row.attributes[-1], message)
        self.draft.put(path or row.field, known[0][1], known[0][0], row.attributes[-1])
        return known[0][1]

    def _rack(self, place: int, role: str) -> None:
        """Addendum and dedendum coefficients: from tool or basic profile, else from the diameters, else ISO 53 A."""
        if self._of_flanks(place, table.BASIC_ADDENDUM, f"gears.{role}.addendum") is None:
            self._from_diameter(place, role, table.TIP_DIAMETER, 1.0)
        tool, module = self.tool(place), self._normal_module
        if tool is not None:
            found = self.reading.number(tool, table.TOOL_ADDENDUM.attributes)
            length = self.reading.number(tool, table.TOOL_ADDENDUM_LENGTH.attributes, "mm")
            if found is None and length is not None and module:
                found = length / module
            if found is not None:
                self.draft.put(f"gears.{role}.dedendum", found, tool, table.TOOL_ADDENDUM.attributes[0])
                return
        self._from_diameter(place, role, table.ROOT_DIAMETER, -1.0)

    def _from_diameter(self, place: int, role: str, row: table.Row, sign: float) -> None:
        """A rack coefficient from the tip or root diameter; an impossible diameter is a finding and not used."""
        path = f"gears.{role}.{row.field}"
        gear, module = self.gears[place], self._normal_module
        diameter = self.reading.number(gear, row.attributes, "mm")
        involute_gear = self.involute(place)
        if diameter is not None and module and involute_gear is not None:
            shift = self.draft.fields.get(f"gears.{role}.profile_shift", 0.0)
            fault = involute_gear.tip_fault(diameter) if sign > 0.0 else involute_gear.root_fault(diameter)
            if fault is None:
                self.draft.put(
                    path,
                    sign * ((diameter - involute_gear.reference_diameter) / (2.0 * module) - shift),
                    gear,
                    row.attributes[0],
                )
                return
            self.reading.find("diameter", gear, row.attributes[0], f"{row.attributes[0]} {fault}; not used")
        self.draft.assume(path, ISO_53_A[row.field], f"the file gives no {row.field}: ISO 53, profile A")

    def tool(self, place: int) -> Component | None:
        """The rack-shaped tool that made a gear."""
        model = self.reading.model
        for flank in self.flanks(place):
            for tool in model.related("manufacturing_step", "workpiece", flank.id, "tool"):
                if tool.type in table.TOOLS:
                    return tool
        origins = (self.gears[place], *self.flanks(place))
        return next((tool for each in origins for tool in model.references_of(each.id, *table.TOOLS)), None)

    def _rack_tip_radius(self) -> None:
        found = []
        for place in (0, 1):
            tool = self.tool(place)
            if tool is None:
                continue
            value = self.reading.number(tool, table.TOOL_TIP_RADIUS.attributes)
            length = self.reading.number(tool, table.TOOL_TIP_RADIUS_LENGTH.attributes, "mm")
            if value is None and length is not None and self._normal_module:
                value = length / self._normal_module
            if value is not None:
                found.append((value, tool))
        path = "gears.rack_tip_radius"
        if not found:
            self.draft.assume(
                path, ISO_53_A["rack_tip_radius"], "the file gives no tip radius of a tool: ISO 53, profile A"
            )
            return
        smallest, tool = min(found, key=lambda each: each[0])
        self.draft.put(path, smallest, tool, table.TOOL_TIP_RADIUS.attributes[-1])
        if len(found) > 1 and abs(found[0][0] - found[1][0]) > SAME:
            self.draft.note(path, smallest, "the tools differ; the smaller radius serves both gears")

    @property
    def _normal_module(self) -> float | None:
        module = self.draft.fields.get(table.MODULE.field)
        if module is None or self.draft.fields.get("gears.module_plane") != "transverse":
            return module
        return float(module) * cos(radians(self.draft.fields.get(table.HELIX_ANGLE.field, 0.0)))

    def involute(self, place: int) -> "Involute | None":
        """The transverse geometry of a gear, where the file gives enough."""
        module, angle = self._normal_module, self.draft.fields.get(table.PRESSURE_ANGLE.field)
        if not module or module < 0.0 or angle is None or not 0.0 < angle < 45.0:
            return None
        helix = self.draft.fields.get(table.HELIX_ANGLE.field, 0.0)
        if not helix < 80.0:
            return None
        shift = self.draft.fields.get(f"gears.{ROLES[place]}.profile_shift", 0.0)
        return Involute(self.teeth[place], module, radians(angle), radians(helix), shift)

    def _backlash(self) -> None:
        """The normal backlash of the file less the one that the centre distance gives by itself."""
        stage = self.pair.stage
        values = [self.reading.number(stage, name, "mm") for name in table.BACKLASH]
        known = [each for each in values if each is not None]
        path = "gears.normal_backlash_mm"
        if not known:
            self.draft.lacks(path, stage, table.BACKLASH[0], "the pumping calculation needs the normal backlash")
            return
        stated = sum(known) / len(known)
        own = self._backlash_of_centre_distance()
        if own is None or stated < own - SAME:
            message = f"the backlash stated, {stated:.4g} mm, is smaller than what the centre distance gives"
            self.reading.find("backlash", stage, table.BACKLASH[0], message)
            own = stated
        self.draft.put(path, max(stated - own, 0.0), stage, table.BACKLASH[0])
        if len(known) > 1 and known[0] != known[1]:
            self.draft.note(path, stated - own, "mean of the least and the largest backlash")

    def _backlash_of_centre_distance(self) -> float | None:
        """Normal backlash [mm] of unthinned teeth at the centre distance: 2 a cos alpha_wt (inv - inv_0) cos beta_b."""
        pair = self.involute(0), self.involute(1)
        distance = self.draft.fields.get("gears.centre_distance_mm")
        if pair[0] is None or pair[1] is None:
            return None
        if distance is None:
            return 0.0
        base = (pair[0].base_diameter + pair[1].base_diameter) / 2.0
        shifts = pair[0].shift + pair[1].shift
        free = involute(pair[0].transverse_angle) + 2.0 * tan(pair[0].normal_angle) * shifts / sum(self.teeth)
        if not base < distance or free < 0.0:
            return None
        gap = 2.0 * base * (involute(acos(base / distance)) - free)
        return gap * cos(pair[0].base_helix) if gap > 0.0 else 0.0

    def _load(self) -> None:
        draft = self.draft
        place = self.order[0]
        shaft = self.pair.shafts[place]
        torques, speed = self.flow.mesh_torque.get(self.pair.stage.id), self.flow.speed.get(shaft.id)
        if torques is None:
            draft.lacks("load.pinion_torque_n_m", shaft, None, "the torque of this stage does not follow from the file")
        else:
            draft.put("load.pinion_torque_n_m", abs(torques[place]), shaft)
        if speed is None:
            draft.lacks("load.pinion_speed_rpm", shaft, None, "the speed of this stage does not follow from the file")
        else:
            draft.put("load.pinion_speed_rpm", abs(speed), shaft)
        if self.driver is None:
            draft.note("gears.pinion", self.gears[0].id, "which gear drives is not known; the smaller one is taken")

    def _materials(self) -> None:
        for place, role in enumerate(ROLES):
            gear, prefix = self.gears[place], f"materials.{role}."
            self.draft.take(table.ROUGHNESS, gear, prefix)
            material = self.material(place)
            for row in table.MATERIAL if material is not None else ():
                self.draft.take(row, material, prefix)  # type: ignore[arg-type]

    def material(self, place: int) -> Component | None:
        """The gear's material, else its shaft's."""
        origins = (self.gears[place], self.shafts[place])
        return next((m for each in origins for m in self.reading.model.references_of(each.id, "material")), None)

    @cached_property
    def lubricant(self) -> Component | None:
        """The stage's lubricant, else the casing's."""
        origins = [each for each in (self.pair.stage, self.reading.model.casing) if each is not None]
        return next((oil for each in origins for oil in self.reading.model.references_of(each.id, "lubricant")), None)

    def _oil(self) -> None:
        draft, oil = self.draft, self.lubricant
        for origin in (self.pair.stage, self.reading.model.casing):
            if origin is not None and draft.take(table.OIL_TEMPERATURE, origin, case=self.case) is not None:
                break
        if oil is None:
            draft.lacks("lubricant", self.pair.stage, None, "film and scuffing safety need an oil")
            return
        kind = self.reading.text(oil, "kind")
        if kind == "grease":
            self.reading.find("grease", oil, "kind", "the lubricant is a grease, which is not modelled; not used")
            draft.lacks("lubricant", oil, "kind", "film and scuffing safety need an oil")
            return
        if None in [draft.take(row, oil, "lubricant.") for row in table.OIL[:2]]:
            for row in table.OIL[:2]:
                draft.fields.pop(f"lubricant.{row.field}", None)
            draft.lacks(
                "lubricant", oil, table.OIL[0].attributes[0], "the oil's viscosities at 40 and 100 C are needed"
            )
            return
        draft.take(table.OIL[2], oil, "lubricant.")
        words = " ".join(filter(None, (kind, self.reading.text(oil, "basis"), self.reading.text(oil, "name"))))
        known = next((ours for word, ours in OIL_WORDS.items() if word in words), None)
        if known is None:
            draft.assume("lubricant.kind", "mineral", "the file does not give the base oil")
        else:
            draft.put("lubricant.kind", known, oil, "basis")


OIL_WORDS = {"polyglycol": "polyglycol", "polyglykol": "polyglycol", "pao": "pao", "polyalpha": "pao", "ester": "ester",
             "miner": "mineral"}  # fmt: skip
"""Parts of what programs write for the base oil."""


class Axis(NamedTuple):
    """A shaft's axis in the unit: its origin [mm] and its direction."""

    origin: tuple[float, float, float]
    direction: tuple[float, float, float]


def shaft_axis(reading: Reading, shaft: Component) -> Axis | None:
    """Where a shaft lies, if the file says so."""
    origin, direction = reading.vector(shaft, "support_vector"), reading.vector(shaft, "u_axis_vector")
    if origin is None:
        return None
    x, y, z = direction or (1.0, 0.0, 0.0)
    size = sqrt(x * x + y * y + z * z)
    if not size > 0.0:
        reading.find("axis", shaft, "u_axis_vector", "the axis has no direction")
        return None
    return Axis(origin, (x / size, y / size, z / size))


def position_on_shaft(reading: Reading, part: Component, shaft: Component) -> float | None:
    """Place of a part's middle along its shaft's u axis [mm].

    The origin of a part is the middle of its width. Where the file gives the part's origin and a coordinate that
    differs by half the width, the coordinate counts from the end of the part.
    """
    names = ("u_coordinate_on_shaft", "u_coordinate_on_shaft_inner_side")
    stated = reading.number(part, names, "mm")
    origin, axis = reading.vector(part, "support_vector"), shaft_axis(reading, shaft)
    if origin is None or axis is None:
        return stated
    along = sum((a - b) * u for a, b, u in zip(origin, axis.origin, axis.direction, strict=True))
    if stated is None:
        return along
    half = (reading.number(part, ("face_width", "width"), "mm") or 0.0) / 2.0
    tolerance = 1e-3 * max(1.0, abs(along))
    if abs(along - stated) > tolerance and abs(abs(along - stated) - half) > tolerance:
        message = f"the coordinate on the shaft is {stated:.6g} mm, by the position vectors it is {along:.6g}; used"
        reading.find("position", part, names[0], message)
    return along


class Involute(NamedTuple):
    """Transverse geometry of one gear: teeth, normal module [mm], angles [rad], profile shift coefficient."""

    teeth: int
    module: float
    normal_angle: float
    helix: float
    shift: float

    @property
    def transverse_angle(self) -> float:
        """Transverse pressure angle [rad]."""
        return atan(tan(self.normal_angle) / cos(self.helix))

    @property
    def base_helix(self) -> float:
        """Base helix angle [rad]."""
        return atan(tan(self.helix) * cos(self.transverse_angle))

    @property
    def reference_diameter(self) -> float:
        """Reference diameter [mm]."""
        return self.module * self.teeth / cos(self.helix)

    @property
    def base_diameter(self) -> float:
        """Base diameter [mm]."""
        return self.reference_diameter * cos(self.transverse_angle)

    def roll_length(self, diameter: float) -> float:
        """Distance from the base tangent point along the line of action [mm]; 0 inside the base circle."""
        return sqrt(max(diameter**2 - self.base_diameter**2, 0.0)) / 2.0

    @property
    def pointed_diameter(self) -> float:
        """Diameter at which the tooth has no thickness left [mm]."""
        half = pi / (2 * self.teeth) + 2.0 * self.shift * tan(self.normal_angle) / self.teeth
        reach = half + involute(self.transverse_angle)
        return self.base_diameter / cos(inverse_involute(reach)) if reach > 0.0 else self.base_diameter

    def tip_fault(self, diameter: float) -> str | None:
        """What is wrong with a tip diameter [mm], or None."""
        if diameter < self.reference_diameter:
            return f"is {diameter:.6g} mm, below the reference circle of {self.reference_diameter:.6g} mm"
        if diameter > self.pointed_diameter:
            return f"is {diameter:.6g} mm, where the tooth is pointed at {self.pointed_diameter:.6g} mm"
        return None

    def root_fault(self, diameter: float) -> str | None:
        """What is wrong with a root diameter [mm], or None."""
        low, high = self.reference_diameter - 6.0 * self.module, self.reference_diameter + 2.0 * self.module
        return None if max(low, 0.0) < diameter < high else f"is {diameter:.6g} mm, which is no root of these teeth"


class Modifications:
    """Flank modifications of both gears as the gap of the mesh, on the flanks that carry the load.

    Tip relief of the pinion and root relief of the wheel act at E, the others at A; a slope's sign follows from the
    end of the face that meshes first.
    """

    def __init__(self, stage: StageDraft) -> None:
        self._stage, self._draft, self._reading = stage, stage.draft, stage.reading

    def fill(self) -> None:
        """Set the fields of `modifications`."""
        carried = {place: self._carried(place) for place in (0, 1)}
        self._relief("tip_relief", (("tip_relief", carried[0], 0), ("root_relief", carried[1], 1)))
        self._relief("root_relief", (("root_relief", carried[0], 0), ("tip_relief", carried[1], 1)))
        self._sum(
            "profile_crowning_um", carried, "profile_crowning", ("profile_crowning_at_tip", "profile_crowning_at_root")
        )
        self._sum(
            "lead_crowning_um",
            carried,
            "helix_crowning",
            ("helix_crowning_amount_datum_face", "helix_crowning_amount_non_datum_face"),
        )
        self._slopes(carried)
        self._end_relief(carried)

    def _carried(self, place: int) -> list[Component]:
        """Modifications of the flank of pinion (0) or wheel (1) that carries the load."""
        sides = {side: self._of_flank(self._stage.flank(place, side)) for side in ("left", "right")}
        if not any(sides.values()):
            return []
        side = self._working_side(place)
        if side is None:
            side = "right" if sides["right"] else "left"
            self._draft.note("modifications", side, "which flank carries the load is not known")
        for each in sides[side]:
            if each.type in table.OTHER_MODIFICATIONS:
                self._reading.find("modification", each, None, f"{table.OTHER_MODIFICATIONS[each.type]}; left out")
        return [each for each in sides[side] if each.type in table.MODIFICATIONS]

    def _of_flank(self, flank: Component | None) -> list[Component]:
        if flank is None:
            return []
        kinds = (*table.MODIFICATIONS, *table.OTHER_MODIFICATIONS)
        return list(self._reading.model.references_of(flank.id, *kinds))

    def _working_side(self, place: int) -> str | None:
        """The flank that carries the load: as the file says, else by sense of rotation and driver.

        Seen from the end of the shaft where u is least (the datum face), a gear with positive speed turns clockwise:
        of a driving gear the right flank then leads and pushes, of a driven one the left flank is pushed.
        """
        stage = self._stage
        data = self._reading.model.related("stage_gear_data", "gear", stage.gears[place].id, "stage_gear_data")
        for each in data:
            if (said := self._reading.text(each, "loaded_tooth_flank")) in {"left", "right"}:
                return said
        speed = stage.flow.speed.get(stage.shafts[place].id)
        if not speed or stage.driver is None:
            return None
        return "right" if (speed > 0.0) == (place == 0) else "left"

    def _mean(self, component: Component, names: tuple[str, str]) -> float | None:
        """Mean of the amounts at two ends [um]; unequal ones are a finding."""
        values = [self._reading.number(component, name, "um") for name in names]
        known = [each for each in values if each is not None]
        if not known:
            return None
        if len(known) > 1 and abs(known[0] - known[1]) > 0.01:
            self._reading.find(
                "ends_differ", component, names[1], "the amounts at both ends differ; their mean is used"
            )
        return sum(known) / len(known)

    def _sum(self, name: str, carried: dict[int, list[Component]], kind: str, ends: tuple[str, str]) -> None:
        """A crowning: the amounts of both gears add."""
        found = [(each, self._mean(each, ends)) for place in (0, 1) for each in carried[place] if each.type == kind]
        known = [(each, value) for each, value in found if value is not None]
        if known:
            self._draft.put(f"modifications.{name}", sum(value for _, value in known), known[0][0], ends[0])

    def _relief(self, name: str, members: tuple[tuple[str, list[Component], int], ...]) -> None:
        """A relief at one end of the path: amounts add, length and shape are those of the larger one."""
        found = []
        for kind, carried, place in members:
            for each in carried:
                amount = self._reading.number(each, f"{kind}_depth", "um") if each.type == kind else None
                if amount:
                    found.append((amount, each, kind, place))
        if not found:
            return
        largest, component, kind, place = max(found, key=lambda each: abs(each[0]))
        self._draft.put(f"modifications.{name}_um", sum(each[0] for each in found), component, f"{kind}_depth")
        length = self._relief_length(component, kind, place)
        if length is not None:
            self._draft.put(f"modifications.{name}_length_mm", length, component, f"{kind}_datum_length")
        if len(found) > 1:
            reason = "both gears are relieved there; amounts add, length and shape of the larger one"
            self._draft.note(f"modifications.{name}_um", largest, reason)
        shape = self._reading.text(component, "shape_of_relief")
        exponent = {"linear": 1.0, "parabolic": 2.0}.get(shape or "")
        path = "modifications.relief_exponent"
        if exponent is None:
            self._draft.assume(path, 1.0, f"the shape of the relief is {(shape or 'not stated')[:30]}; linear is used")
        elif self._draft.fields.get(path, exponent) != exponent:
            self._draft.note(path, self._draft.fields[path], "tip and root relief have different shapes")
        else:
            self._draft.put(path, exponent, component, "shape_of_relief")

    def _relief_length(self, component: Component, kind: str, place: int) -> float | None:
        """Length of a relief along the line of action [mm], from its length or from the diameter where it begins."""
        length = self._reading.number(component, f"{kind}_datum_length", "mm")
        if length is not None:
            return length
        diameter = self._reading.number(component, f"{kind}_datum_diameter", "mm")
        gear, mate = self._stage.involute(place), self._stage.involute(1 - place)
        if diameter is None or gear is None or mate is None:
            return None
        begin = gear.roll_length(diameter)
        if kind == "tip_relief":
            return self._tip_roll(place, gear) - begin
        base = (gear.base_diameter + mate.base_diameter) / 2.0
        distance = (
            self._draft.fields.get("gears.centre_distance_mm")
            or (gear.reference_diameter + mate.reference_diameter) / 2
        )
        line = sqrt(max(distance**2 - base**2, 0.0))
        return begin - (line - self._tip_roll(1 - place, mate))

    def _tip_roll(self, place: int, gear: Involute) -> float:
        """Roll length of a gear's tip [mm]."""
        addendum = self._draft.fields.get(f"gears.{ROLES[place]}.addendum", 1.0)
        return gear.roll_length(gear.reference_diameter + 2.0 * gear.module * (addendum + gear.shift))

    def _slopes(self, carried: dict[int, list[Component]]) -> None:
        """Profile and helix slopes; positive amounts take material away at the tip and at the non-datum face."""
        profile, helix, origin = 0.0, 0.0, {}
        for place in (0, 1):
            for each in carried[place]:
                if each.type == "profile_slope" and (amount := self._reading.number(each, "profile_slope", "um")):
                    profile += amount if place == 0 else -amount
                    origin["profile"] = each
                if each.type == "helix_slope" and (amount := self._reading.number(each, "helix_slope", "um")):
                    sense = self._end_sense(place)
                    if sense is None:
                        message = "left out: its sign needs the direction of rotation and the driver"
                        self._reading.find("modification", each, "helix_slope", message)
                        continue
                    helix += sense * amount
                    origin["helix"] = each
        if "profile" in origin:
            self._draft.put("modifications.profile_slope_um", profile, origin["profile"], "profile_slope")
            self._draft.note("modifications.profile_slope_um", profile, "positive amounts remove material at the tip")
        if "helix" in origin:
            self._draft.put("modifications.helix_slope_um", helix, origin["helix"], "helix_slope")
            reason = "positive amounts remove material at the face where u is largest (the non-datum face)"
            self._draft.note("modifications.helix_slope_um", helix, reason)

    def _end_sense(self, place: int) -> float | None:
        """+1 where u of this gear's shaft grows towards the end that leaves the mesh last.

        Contact begins at the end that follows from sense of rotation and hand of the driver: seen along its u axis
        y runs against sigma h, sigma the sense of rotation and h +1 for a right-hand helix.
        """
        stage = self._stage
        speed = stage.flow.speed.get(stage.shafts[0].id)
        if not speed:
            return None
        hand = -1.0 if self._draft.fields.get("gears.hand") == "left" else 1.0
        return -(1.0 if speed > 0.0 else -1.0) * hand * stage.along(stage.shafts[place])

    def _end_relief(self, carried: dict[int, list[Component]]) -> None:
        """Relief of both ends: ours is the same at both, so that the mean of the ends is used."""
        ends: dict[str, list[tuple[float, float | None, Component]]] = {"datum_face": [], "non_datum_face": []}
        for place in (0, 1):
            for each in carried[place]:
                for end, found in ends.items():
                    if each.type == f"end_relief_{end}":
                        amount = self._reading.number(each, f"end_relief_depth_{end}", "um")
                        length = self._reading.number(each, f"end_relief_length_{end}", "mm")
                        if amount:
                            found.append((amount, length, each))
        amounts = [sum(amount for amount, _, _ in found) for found in ends.values()]
        parts = [each for found in ends.values() for each in found]
        if not parts:
            return
        mean = sum(amounts) / 2.0
        if abs(amounts[0] - amounts[1]) > 0.01:
            self._reading.find("ends_differ", parts[0][2], None, "end reliefs differ; their mean is used at both ends")
        self._draft.put("modifications.end_relief_um", mean, parts[0][2], f"end_relief_depth_{next(iter(ends))}")
        lengths = [length for _, length, _ in parts if length]
        if lengths:
            path = "modifications.end_relief_length_mm"
            self._draft.put(path, sum(lengths) / len(lengths), parts[0][2], "end_relief_length_datum_face")


def related_components(stage: StageDraft) -> Iterable[Component]:
    """The components that describe the mesh: what they say and nobody asked for is listed as ignored."""
    yield stage.pair.stage
    for place in (0, 1):
        yield stage.gears[place]
        for flank in stage.flanks(place):
            yield flank
            yield from stage.reading.model.references_of(flank.id, *table.MODIFICATIONS, *table.OTHER_MODIFICATIONS)
        for each in (stage.tool(place), stage.material(place)):
            if each is not None:
                yield each
    if stage.lubricant is not None:
        yield stage.lubricant


def requests_of(stage: StageDraft) -> dict[str, Any]:
    """Path in the draft -> path in the request, for each endpoint that knows a single mesh."""
    fields = stage.draft.fields | stage.draft.missing  # also what may yet be refused for missing it
    shared = {path: path for path in fields if path.split(".")[0] in {"gears", "load", "materials", "modifications"}}
    mesh = {path: path for path in shared if path not in {"gears.normal_backlash_mm", "gears.hand"}}
    oil = {path: path for path in fields if path.split(".")[0] in {"lubricant", "temperatures"}}
    pumping = {path: path for path in shared if path.startswith("gears.") and path != "gears.hand"}
    pumping["load.pinion_speed_rpm"] = "operation.pinion_speed_rpm"
    return {
        "/v1/scuffing/load-distribution": mesh,
        "/v1/scuffing": mesh | oil,
        "/v1/pumping": pumping,
    }
