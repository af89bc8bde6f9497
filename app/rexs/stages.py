"""The draft of a request for each stage of a gear unit: the gears, the load and the materials of the stage's mesh."""

from collections.abc import Iterable, Iterator
from math import acos, asin, atan, cos, degrees, pi, radians, sin, sqrt, tan

from app.rexs import table
from app.rexs.links import shaft_of
from app.rexs.model import Component
from app.rexs.power import Pair, PowerFlow
from app.rexs.reading import Draft, Reading
from solvers.gears.gear import involute
from solvers.gears.pair import inverse_involute

ISO_53_A = {"addendum": 1.0, "dedendum": 1.25, "rack_tip_radius": 0.38}  # coefficients, in modules
SAME = 1e-6  # two stated numbers count as equal if their difference is smaller than this; chosen
OFF_CENTRE = 1e-3  # tolerated error of positions, which are often rounded, as a share of the centre distance; chosen
MOST_INVOLUTE = 1e8  # only absurd profile shifts give larger involute functions; the inverse function works up to 1e9
COARSEST_CLASS = 11  # of ISO 1328-1:2013, whose finest class is 1
NORMAL_ANGLE = 20.0  # normal pressure angle of ISO 53 [deg]
ROLES = ("pinion", "wheel")
TORQUE, SPEED = "load.pinion_torque_n_m", "load.pinion_speed_rpm"


def pairs(reading: Reading) -> Iterator[Pair]:
    """Yield the cylindrical stages that have two external gears on two shafts. Record all other stages as findings."""
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
    first, second = (model.part(relation, role) if relation else None for role in ("gear_1", "gear_2"))
    if first is None or second is None:
        reading.find("relation_missing", stage, None, "the stage has no relation to two gears; the stage is left out")
        return None
    teeth = _teeth(reading, stage, first), _teeth(reading, stage, second)
    if teeth[0] is None or teeth[1] is None:
        return None
    shafts = shaft_of(reading, first), shaft_of(reading, second)
    if shafts[0] is None or shafts[1] is None or shafts[0].id == shafts[1].id:
        reading.find(
            "relation_missing", stage, None, "the two gears do not sit on two different shafts; the stage is left out"
        )
        return None
    return Pair(stage, (first, second), (shafts[0], shafts[1]), (teeth[0], teeth[1]))


def _teeth(reading: Reading, stage: Component, gear: Component) -> int | None:
    """Return the number of teeth of an external gear. Record any other gear as a finding."""
    if gear.type != "cylindrical_gear":
        what = "pairs with a ring gear" if gear.type == "ring_gear" else "other pairs than two external gears"
        reading.find("stage_not_modelled", stage, None, f"{what} are not modelled; the stage is left out")
        return None
    number = reading.number(gear, "number_of_teeth")
    if number is not None and number < 0.0:
        message = "pairs with a ring gear (a negative number of teeth) are not modelled; the stage is left out"
        reading.find("ring_gear", gear, "number_of_teeth", message)
        return None
    if number is None or number != int(number) or not 1 <= number <= 10_000:
        reading.find("teeth", gear, "number_of_teeth", "the number of teeth is not permissible; the stage is left out")
        return None
    return int(number)


class StageDraft(Draft):
    """The draft of one mesh. The pinion is the driving gear, or the smaller gear if the driving gear is not known.

    `pair` has the gears in the order of the file; `gears`, `shafts` and `teeth` begin with the pinion. `order` holds
    the positions of pinion and wheel in `pair`. `driver` is the position of the driving gear in `pair`, or None if the
    driving gear is not known. `face_start` is the end of lowest Z of the common face [mm], or None if it is not known.
    `second_helix` is the draft of the helix at the higher Z of double-helical gears. The argument `place` of the
    methods is 0 for the pinion and 1 for the wheel.
    """

    def __init__(self, pair: Pair, flow: PowerFlow, pinion: int | None = None) -> None:
        """Choose the pinion."""
        super().__init__(flow.reading)
        self.flow, self.pair = flow, pair
        self.driver = self._driver()
        smaller = int(pair.teeth[1] < pair.teeth[0])
        first = next(place for place in (pinion, self.driver, smaller) if place is not None)
        self.order = first, 1 - first
        self.stage = pair.stage
        turn = -1 if first else 1
        self.gears, self.shafts, self.teeth = pair.gears[::turn], pair.shafts[::turn], pair.teeth[::turn]
        starts = [face[0] for place in (0, 1) if (face := self.face_interval(place)) is not None]
        self.face_start = max(starts) if len(starts) == len(ROLES) else None
        self.second_helix: StageDraft | None = None

    def fill(self) -> None:
        """Fill in all fields of the mesh except modifications and oil."""
        for row in table.STAGE:
            self.take(row, self.stage)
        for place, role in enumerate(ROLES):
            self.put(f"gears.{role}.teeth", self.teeth[place], self.gears[place], "number_of_teeth")
        self._helix()
        self._module()
        self._face_width()
        self._pressure_angle()
        for place in (0, 1):
            self._profile_shift(place)
            self._rack(place)
        self._rack_tip_radius()
        self._backlash()
        self._quality_class()
        self._axes()
        self._load()
        for place, role in enumerate(ROLES):
            self._roughness(place)
            material = self.material(place)
            for row in (*table.MATERIAL, *table.HEAT):
                if self.take(row, material, f"materials.{role}.") is None and self.reading.is_elsewhere(material):
                    message = "the value is in another file, which is not read; without it steel is calculated"
                    self.lacks(f"materials.{role}.{row.field}", material, row.name, message)

    def _roughness(self, place: int) -> None:
        """Fill in the roughness Ra of a flank. If the file states only Rz, Ra = Rz/6 is assumed."""
        prefix, gear = f"materials.{ROLES[place]}.", self.gears[place]
        rz = self.reading.number(gear, table.MEAN_PEAK_TO_VALLEY)
        if self.take(table.ROUGHNESS, gear, prefix) is None and rz is not None:
            path, ra = prefix + table.ROUGHNESS.field, rz * table.RA_OF_RZ
            self.put(path, ra, gear, table.MEAN_PEAK_TO_VALLEY.name)
            self.note(path, ra, f"Ra = Rz/6, because the file states only Rz, {rz:.4g} µm")

    def _driver(self) -> int | None:
        """Return the position of the driving gear in `pair`, or None if the driving gear is not known."""
        by_power, pair = self.flow.driver(self.pair), self.pair
        stated = [place for place in (0, 1) for data in self.data_of(pair.gears[place])
                  if self.reading.flag(data, "is_driving_gear")]  # fmt: skip
        if by_power is None and len(stated) == 1:
            return stated[0]
        if by_power is not None and stated and by_power not in stated:
            message = (
                "the file states that this gear drives, but according to torque and speed the other gear drives; the "
                "other gear is used as the driver"
            )
            self.reading.find("driver", pair.gears[stated[0]], None, message)
        return by_power

    def flanks(self, place: int) -> dict[str, Component]:
        """Return the flanks of pinion (0) or wheel (1) that the file contains. The keys are "left" and "right"."""
        relation = "flank", "gear", self.gears[place].id
        flanks = {side: next(self.reading.model.related(*relation, side), None) for side in ("left", "right")}
        return {side: flank for side, flank in flanks.items() if flank is not None}

    @property
    def both_flanks(self) -> list[Component]:
        """The flanks of both gears, those of the pinion first."""
        return [flank for place in (0, 1) for flank in self.flanks(place).values()]

    def data_of(self, gear: Component) -> Iterator[Component]:
        """Yield the components that hold data of a gear in this stage."""
        for relation in self.reading.model.relations_of("stage_gear_data", "gear", gear.id):
            data = self.reading.model.part(relation, "stage_gear_data")
            if data is not None and relation.part("stage") in {self.pair.stage.id, None}:
                yield data

    def tool(self, place: int) -> Component | None:
        """Return the rack-shaped tool that cuts a gear, or None if the file does not state such a tool."""
        model, flanks = self.reading.model, self.flanks(place).values()
        tools = (
            tool for flank in flanks for tool in model.related("manufacturing_step", "workpiece", flank.id, "tool")
        )
        made_by = next((tool for tool in tools if tool.type == table.TOOL), None)
        return made_by or model.reference_of((self.gears[place], *flanks), table.TOOL)

    def material(self, place: int) -> Component | None:
        """Return the material of a gear, or the material of the gear's shaft if the gear has no stated material."""
        return self.reading.model.reference_of((self.gears[place], self.shafts[place]), "material")

    @property
    def oil_origins(self) -> tuple[Component | None, ...]:
        """The components that may state the oil and the oil temperature. The stage has priority over the casing."""
        return self.stage, self.reading.model.first("gear_casing")

    @property
    def lubricant(self) -> Component | None:
        """The lubricant of the stage, or the lubricant of the casing if the stage has no lubricant in the file."""
        return self.reading.model.reference_of(self.oil_origins, "lubricant")

    def load(self, flow: PowerFlow) -> dict[str, float]:
        """Return the torque and the speed of the pinion. The keys are the paths of the fields in the draft."""
        torques, speed = flow.mesh_torque.get(self.stage.id), flow.speed.get(self.shafts[0].id)
        fields = {} if torques is None else {TORQUE: abs(torques[self.order[0]])}
        return fields if speed is None else fields | {SPEED: abs(speed)}

    def face_interval(self, place: int) -> tuple[float, float] | None:
        """Return the positions of both ends of a gear's face along the axis of the pinion's shaft [mm].

        Return None if the face width or the position of the gear is not known.
        """
        width = self.reading.number(self.gears[place], table.FACE_WIDTH)
        middle = self.position(self.gears[place], self.shafts[place])
        if width is None or middle is None:
            return None
        return middle - width / 2.0, middle + width / 2.0

    def faces(self) -> list[tuple[float, float]]:
        """Return both ends of the common face of each helix along Z [mm]; empty if they are not known."""
        start, width = self.face_start, self.fields.get(table.FACE_WIDTH.field)
        if start is None or width is None:
            return []
        gap = self.fields.get("gears.gap_width_mm")
        starts = [start] if gap is None else [start, start + width + gap]
        return [(each, each + width) for each in starts]

    def position(self, part: Component, shaft: Component) -> float | None:
        """Return the position of the middle of a part along the axis of the pinion's shaft [mm].

        The file may state the position in two ways: as the origin of the part, and as a coordinate on the shaft. The
        origin is the middle of the part. The coordinate may be the middle or an end of the part. If the file states
        both, the origin is used, and a finding is recorded if the coordinate is neither the middle nor an end. Return
        None if the position is not known.
        """
        reading = self.reading
        stated = reading.number(part, table.POSITION)
        origin, axis = reading.vector(part, "support_vector"), reading.axis(shaft)
        if origin is None or axis is None:
            return None if stated is None else self.position_of_coordinate(shaft, stated)
        along = axis.along(origin)
        if stated is not None:
            half = (reading.number(part, table.WIDTH) or 0.0) / 2.0
            tolerance = 1e-3 * max(1.0, abs(along))
            if abs(along - stated) > tolerance and abs(abs(along - stated) - half) > tolerance:
                message = (
                    f"the coordinate on the shaft is {stated:.6g} mm, but the position vectors give {along:.6g} mm; "
                    "the position vectors are used"
                )
                reading.find("position", part, table.POSITION.name, message)
        return self.position_of_coordinate(shaft, along)

    def position_of_coordinate(self, shaft: Component, along: float) -> float | None:
        """Convert a coordinate on a shaft to a position along the axis of the pinion's shaft [mm]."""
        if shaft.id == self.shafts[0].id:
            return along
        axis, base = self.reading.axis(shaft), self.reading.axis(self.shafts[0])
        if axis is None or base is None:
            return None
        return base.along(axis.origin) + along * self.along(shaft)

    def along(self, shaft: Component) -> float:
        """Return +1 if the u axis of a shaft has the same direction as the u axis of the pinion's shaft, else -1."""
        return self.reading.sense(shaft) * self.reading.sense(self.shafts[0])

    def involute(self, place: int) -> "Involute | None":
        """Return the transverse geometry of a gear, or None if the draft does not contain enough data."""
        fields, module = self.fields, self.fields.get(table.MODULE.field)
        angle, helix = fields.get(table.PRESSURE_ANGLE.field), fields.get(table.HELIX_ANGLE.field, 0.0)
        if not module or module < 0.0 or angle is None or not 0.0 < angle < 45.0 or not helix < 80.0:
            return None
        shift = fields.get(f"gears.{ROLES[place]}.profile_shift", 0.0)
        return Involute(self.teeth[place], module, radians(angle), radians(helix), shift)

    def values_of(self, components: Iterable[Component], row: table.Row) -> list[tuple[float, Component]]:
        """Return a pair (value, component) for every component that states the number described by `row`."""
        numbers = ((self.reading.number(component, row), component) for component in components)
        return [(value, component) for value, component in numbers if value is not None]

    def _module(self) -> None:
        row, pinion = table.MODULE, self.gears[0]
        modules = self.values_of(self.gears, row) or self._transverse_modules()
        if not modules:
            self.lacks(row.field, pinion, row.name, f"the file has no {row.name}")
            return
        if abs(modules[0][0] - modules[-1][0]) > SAME * abs(modules[0][0]):
            message = "both gears must have the same module; the module of the pinion is used"
            self.reading.find("gears_differ", modules[-1][1], row.name, message)
        self.put(row.field, *modules[0], row.name)

    def _transverse_modules(self) -> list[tuple[float, Component]]:
        """Return the pair (normal module, gear) for each gear that has a transverse module in the file."""
        cosine = cos(radians(self.fields.get(table.HELIX_ANGLE.field, 0.0)))
        modules = self.values_of(self.gears, table.TRANSVERSE_MODULE)
        if modules:
            reason = "computed as the transverse module times the cosine of the helix angle"
            self.note(table.MODULE.field, modules[0][0] * cosine, reason)
        return [(value * cosine, gear) for value, gear in modules]

    def _quality_class(self) -> None:
        """Fill in the quality class. If the gears have different classes, the coarser one is used."""
        row, classes = table.QUALITY_CLASS, self.values_of(self.gears, table.QUALITY_CLASS)
        if not classes:
            return
        coarsest, gear = max(classes, key=lambda each: each[0])
        if coarsest not in range(1, COARSEST_CLASS + 1):
            message = (
                f"the quality class must be a whole number from 1 to {COARSEST_CLASS}; {coarsest:.4g} is not used and "
                "the flanks have no tolerances"
            )
            self.reading.find("quality_class", gear, row.name, message)
            return
        self.put(row.field, int(coarsest), gear, row.name)
        if min(classes, key=lambda each: each[0])[0] != coarsest:
            self.note(row.field, int(coarsest), "the coarser class of both gears is used")

    def _helix(self) -> None:
        row, gear = table.HELIX_ANGLE, self.gears[0]
        pinion, wheel = (self._helix_angle(gear) for gear in self.gears)
        if pinion is not None and wheel is not None and abs(pinion + wheel) > SAME * 90.0:
            message = (
                "the helix angles of an external pair must be equal and of opposite sign; the helix angle of the "
                "pinion is used"
            )
            self.reading.find("helix_angles", self.gears[1], row.name, message)
        if pinion is None:
            if wheel is None:
                self.assume(row.field, 0.0, "the file has no helix angle; spur gears are assumed")
                return
            pinion = -wheel
        self.put(row.field, abs(pinion), gear, row.name)
        self.put("gears.hand", "right" if pinion >= 0.0 else "left", gear, row.name)

    def _helix_angle(self, gear: Component) -> float | None:
        """Return the helix angle at the reference circle [deg]; None if the file does not state a helix angle."""
        stated = self.reading.number(gear, table.HELIX_ANGLE)
        base = self.reading.number(gear, table.BASE_HELIX_ANGLE) if stated is None else None
        if base is None:
            return stated
        normal, transverse = (
            next((value for value, _ in self.values_of(self.both_flanks, row)), None)
            for row in (table.PRESSURE_ANGLE, table.TRANSVERSE_PRESSURE_ANGLE)
        )
        if normal is None and transverse is not None and abs(transverse) < 90.0 > abs(base):
            return degrees(atan(tan(radians(base)) / cos(radians(transverse))))
        sine = sin(radians(base)) / max(cos(radians(NORMAL_ANGLE if normal is None else normal)), SAME)
        return degrees(asin(sine)) if abs(sine) < 1.0 else None

    def _face_width(self) -> None:
        row, gear = table.FACE_WIDTH, self.gears[0]
        if self.take(table.COMMON_WIDTH, self.stage) is not None:
            return
        widths = [value for value, _ in self.values_of(self.gears, row)]
        if not widths:
            self.lacks(row.field, gear, row.name, "the file has no face width")
            return
        common = min(widths)
        first, second = self.face_interval(0), self.face_interval(1)
        if first is not None and second is not None:
            overlap = min(first[1], second[1]) - max(first[0], second[0])
            if overlap > 0.0:
                common = min(common, overlap)
            else:
                self.reading.find(
                    "faces_apart", self.stage, None, "according to the positions of the gears, the faces do not overlap"
                )
        self.put(row.field, common, gear, row.name)
        if any(abs(width - common) > SAME * common for width in widths):
            self.note(row.field, common, "the part of the face that both gears have in common")

    def _pressure_angle(self) -> None:
        row = table.PRESSURE_ANGLE
        # The pinion is read last, so that the field keeps the angle of the pinion.
        wheel, pinion = self._of_flanks(1, row, row.field), self._of_flanks(0, row, row.field)
        if wheel is None and pinion is None:
            self._from_transverse_angle()
        elif wheel is not None and pinion is not None and abs(wheel - pinion) > SAME:
            message = "both gears must have the same pressure angle; the pressure angle of the pinion is used"
            self.reading.find("gears_differ", self.gears[1], row.name, message)

    def _from_transverse_angle(self) -> None:
        row = table.PRESSURE_ANGLE
        angles = self.values_of(self.both_flanks, table.TRANSVERSE_PRESSURE_ANGLE)
        if not angles:
            self.assume(row.field, NORMAL_ANGLE, "the file has no pressure angle; the value of ISO 53 is used")
            return
        helix = radians(self.fields.get(table.HELIX_ANGLE.field, 0.0))
        normal = degrees(atan(tan(radians(angles[0][0])) * cos(helix)))
        self.put(row.field, normal, angles[0][1], table.TRANSVERSE_PRESSURE_ANGLE.name)

    def _profile_shift(self, place: int) -> None:
        """Fill in the nominal profile shift."""
        path = f"gears.{ROLES[place]}.profile_shift"
        if self._of_flanks(place, table.PROFILE_SHIFT, path) is not None:
            return
        flank, module = next(iter(self.flanks(place).values()), None), self.fields.get(table.MODULE.field)
        length = self.reading.number(flank, "addendum_modification", "mm")
        if flank is not None and length is not None and module:
            self.put(path, length / module, flank, "addendum_modification")
        elif (finished := self._of_flanks(place, table.FINISHED_SHIFT, path)) is not None:
            reason = "the profile shift after finishing is used, because the file has no nominal profile shift"
            self.note(path, finished, reason)
        else:
            self.assume(path, 0.0, "the file has no profile shift")

    def _of_flanks(self, place: int, row: table.Row, path: str) -> float | None:
        """Fill in a number that must be the same for both flanks, and return the number.

        If the numbers of the two flanks differ, record a finding and use the number of the left flank. Return None if
        the file states no number for either flank.
        """
        values = self.values_of(self.flanks(place).values(), row)
        if not values:
            return None
        if any(abs(value - values[0][0]) > SAME for value, _ in values):
            message = "the left and the right flank differ, which is not modelled; the value of the left flank is used"
            self.reading.find("flanks_differ", values[1][1], row.attributes[-1], message)
        self.put(path, *values[0], row.attributes[-1])
        return values[0][0]

    def _rack(self, place: int) -> None:
        """Fill in the coefficients of addendum and dedendum."""
        prefix, tool = f"gears.{ROLES[place]}.", self.tool(place)
        path, module = f"{prefix}addendum", self.fields.get(table.MODULE.field)
        if not self._from_diameter(place, table.TIP_DIAMETER):
            length = self.reading.number(self.gears[place], table.BASIC_ADDENDUM_LENGTH)
            is_stated = self._of_flanks(place, table.BASIC_ADDENDUM, path) is not None
            if not is_stated and length is not None and module:
                self.put(path, length / module, self.gears[place], table.BASIC_ADDENDUM_LENGTH.name)
            elif not is_stated:
                self._assume_rack(place, "addendum")
        dedendum = self._of_tool(tool, table.TOOL_ADDENDUM, table.TOOL_ADDENDUM_LENGTH)
        if tool is not None and dedendum is not None:
            self.put(f"{prefix}dedendum", dedendum, tool, table.TOOL_ADDENDUM.name)
        elif not self._from_diameter(place, table.ROOT_DIAMETER):
            self._assume_rack(place, "dedendum")

    def _assume_rack(self, place: int, name: str) -> None:
        path, tool = f"gears.{ROLES[place]}.{name}", self.tool(place)
        if name == "dedendum" and self.reading.is_elsewhere(tool):
            self.lacks(path, tool, table.TOOL_ADDENDUM.name, "the tool is in another file, which is not read")
        self.assume(path, ISO_53_A[name], f"the file gives no {name}; the value of ISO 53, profile A, is used")

    def _of_tool(self, tool: Component | None, row: table.Row, length_row: table.Row) -> float | None:
        """Return a coefficient of the tool in modules, or None if the file does not determine the coefficient."""
        coefficient, length = self.reading.number(tool, row), self.reading.number(tool, length_row)
        module = self.fields.get(table.MODULE.field)
        return length / module if coefficient is None and length is not None and module else coefficient

    def _from_diameter(self, place: int, row: table.Row) -> bool:
        """Fill in the addendum from the tip diameter, or the dedendum from the root diameter. Return True on success.

        `row` describes either the tip diameter or the root diameter. An impossible diameter is recorded as a finding
        and is not used.
        """
        path, gear = f"gears.{ROLES[place]}.{row.field}", self.gears[place]
        diameter, flank = self.reading.number(gear, row), self.involute(place)
        tip = row is table.TIP_DIAMETER
        if diameter is None and tip:
            limits = [self.reading.number(gear, name, "mm") for name in table.TIP_DIAMETER_LIMITS]
            stated = [limit for limit in limits if limit is not None]
            diameter = sum(stated) / len(stated) if stated else None
        if diameter is None or flank is None:
            return False
        fault = flank.tip_fault(diameter) if tip else flank.root_fault(diameter)
        if fault is not None:
            self.reading.find("diameter", gear, row.name, f"{row.name} {fault}; the value is not used")
            return False
        height = (diameter - flank.reference_diameter) / (2.0 * flank.module) - flank.shift
        self.put(path, height if tip else -height, gear, row.name)
        return True

    def _rack_tip_radius(self) -> None:
        radii = []
        for tool in (self.tool(0), self.tool(1)):
            radius = self._of_tool(tool, table.TOOL_TIP_RADIUS, table.TOOL_TIP_RADIUS_LENGTH)
            if tool is not None and radius is not None:
                radii.append((radius, tool))
        path = "gears.rack_tip_radius"
        if not radii:
            reason = "the file gives no tip radius of a tool; the value of ISO 53, profile A, is used"
            self.assume(path, ISO_53_A["rack_tip_radius"], reason)
            return
        smallest, tool = min(radii, key=lambda radius_and_tool: radius_and_tool[0])
        self.put(path, smallest, tool, table.TOOL_TIP_RADIUS.attributes[-1])
        if abs(radii[0][0] - radii[-1][0]) > SAME:
            reason = "the tools of the two gears have different tip radii; the smaller radius is used for both gears"
            self.note(path, smallest, reason)

    def _backlash(self) -> None:
        """Fill in the part of the normal backlash that results from the thinning of the teeth."""
        path, name = "gears.normal_backlash_mm", table.BACKLASH[0]
        limits = self._stated_backlash()
        if not limits:
            thinning = self._thinning()
            if thinning is None:
                self.lacks(path, self.stage, name, "the pumping calculation needs the normal backlash")
            else:
                self.put(path, thinning, self.gears[0], table.FINISHED_SHIFT.name)
            return
        stated = sum(limits) / len(limits)
        own = self._backlash_of_centre_distance()
        if own is None or stated < own - SAME:
            reason = "cannot be computed" if own is None else f"is larger than the stated backlash of {stated:.4g} mm"
            message = f"the backlash that results from the centre distance {reason}; no further backlash is added"
            self.reading.find("backlash", self.stage, name, message)
            own = stated
        self.put(path, max(stated - own, 0.0), self.stage, name)
        if limits[0] != limits[-1]:
            self.note(path, stated - own, "mean of the least and the largest backlash")

    def _stated_backlash(self) -> list[float]:
        """Return the least and the largest normal backlash in the file [mm]; empty if the file states no backlash."""
        normal, transverse = (
            [value for name in names if (value := self.reading.number(self.stage, name, "mm")) is not None]
            for names in (table.BACKLASH, table.TRANSVERSE_BACKLASH)
        )
        pinion, wheel, distance = self.involute(0), self.involute(1), self.working_distance()
        if normal or not transverse or pinion is None or wheel is None or distance is None:
            return normal
        factor = (pinion.base_diameter + wheel.base_diameter) / (2.0 * distance) * cos(pinion.base_helix)
        return [value * factor for value in transverse]

    def _thinning(self) -> float | None:
        """Return the normal backlash that results from the finishing of both gears [mm]."""
        pinion, total = self.involute(0), 0.0
        for place, role in enumerate(ROLES):
            finished = self.values_of(self.flanks(place).values(), table.FINISHED_SHIFT)
            if pinion is None or not finished:
                return None
            total += self.fields[f"gears.{role}.profile_shift"] - finished[0][0]
        if pinion is None or total < 0.0:
            return None
        return 2.0 * pinion.module * sin(pinion.normal_angle) * total

    def working_distance(self) -> float | None:
        """Return the centre distance in the file [mm], or else the backlash-free centre distance.

        Return None if this centre distance is impossible, or if the geometry of one of the gears is not known.
        """
        pinion, wheel = self.involute(0), self.involute(1)
        if pinion is None or wheel is None:
            return None
        base = (pinion.base_diameter + wheel.base_diameter) / 2.0
        distance = self.fields.get("gears.centre_distance_mm")
        if distance is not None:
            return float(distance) if distance > base else None
        free = self._free_involute(pinion, wheel)
        return base / cos(inverse_involute(free)) if 0.0 <= free <= MOST_INVOLUTE else None

    def _free_involute(self, pinion: "Involute", wheel: "Involute") -> float:
        """Return the involute function of the working pressure angle at which the teeth mesh without backlash."""
        shifts = 2.0 * tan(pinion.normal_angle) * (pinion.shift + wheel.shift)
        return involute(pinion.transverse_angle) + shifts / sum(self.teeth)

    def _backlash_of_centre_distance(self) -> float | None:
        """Return the normal backlash [mm] that teeth without thinning have at the centre distance."""
        pinion, wheel = self.involute(0), self.involute(1)
        distance = self.fields.get("gears.centre_distance_mm")
        if pinion is None or wheel is None:
            return None
        if distance is None:
            return 0.0
        base = (pinion.base_diameter + wheel.base_diameter) / 2.0
        free = self._free_involute(pinion, wheel)
        if not base < distance or free < 0.0:
            return None
        gap = 2.0 * base * (involute(acos(base / distance)) - free)
        return gap * cos(pinion.base_helix) if gap > 0.0 else 0.0

    def _axes(self) -> None:
        """Record a finding if the distance between the axes of the shafts differs from the centre distance."""
        first, second = (self.reading.axis(shaft) for shaft in self.shafts)
        distance = self.fields.get("gears.centre_distance_mm")
        if first is None or second is None or distance is None:
            return
        apart = first.apart(second)
        if abs(apart - distance) > OFF_CENTRE * abs(distance):
            message = (
                f"the positions of the shafts give a distance of {apart:.6g} mm, which differs from the centre "
                "distance of the stage; the centre distance of the stage is used"
            )
            self.reading.find("centre_distance", self.stage, "center_distance", message)

    def _load(self) -> None:
        """Fill in the torque and the speed of the pinion."""
        load = self.load(self.flow)
        own = (table.GEAR_TORQUE, self.data_of(self.gears[0])), (table.GEAR_SPEED, (self.gears[0],))
        for (row, origins), what in zip(own, ("torque", "speed"), strict=True):
            values = self.values_of(origins, row)
            if row.field in load:
                self.put(row.field, load[row.field], self.shafts[0])
            elif values:
                value, component = values[0]
                self.put(row.field, abs(value), component, row.name)
                self.note(row.field, abs(value), f"the {what} that the file states for the gear")
            elif self.pair.stage.id in self.flow.hidden:
                message = f"the {what} of this stage is determined through a stage that is not modelled"
                self.lacks(row.field, self.shafts[0], None, message)
            else:
                self.lacks(row.field, self.shafts[0], None, f"the file does not determine the {what} of this stage")
            if row.field in load and (reasons := self.flow.through.get(self.pair.stage.id)):
                self.note(row.field, load[row.field], "; ".join(sorted(reasons)))
        if self.driver is None:
            reason = "it is not known which gear drives; the smaller gear is taken as the driver"
            self.note("gears.pinion", self.gears[0].id, reason)


class Involute:
    """Transverse geometry of one gear: normal module and diameters [mm], angles [rad], profile shift coefficient."""

    def __init__(self, teeth: int, module: float, normal_angle: float, helix: float, shift: float) -> None:
        self.teeth, self.module, self.normal_angle, self.shift = teeth, module, normal_angle, shift
        self.transverse_angle = atan(tan(normal_angle) / cos(helix))
        self.base_helix = atan(tan(helix) * cos(self.transverse_angle))
        self.reference_diameter = module * teeth / cos(helix)
        self.base_diameter = self.reference_diameter * cos(self.transverse_angle)

    def roll_length(self, diameter: float) -> float:
        """Return the roll length [mm] at a diameter [mm]."""
        return sqrt(max(diameter**2 - self.base_diameter**2, 0.0)) / 2.0

    def tip_fault(self, diameter: float) -> str | None:
        """Return the reason why a tip diameter [mm] is impossible, or None if the diameter is possible."""
        half = pi / (2 * self.teeth) + 2.0 * self.shift * tan(self.normal_angle) / self.teeth
        reach = min(max(half + involute(self.transverse_angle), 0.0), MOST_INVOLUTE)
        pointed = self.base_diameter / cos(inverse_involute(reach))
        if diameter < self.reference_diameter:
            return f"is {diameter:.6g} mm, below the reference circle of {self.reference_diameter:.6g} mm"
        if diameter > pointed:
            return f"is {diameter:.6g} mm, but the teeth become pointed at {pointed:.6g} mm"
        return None

    def root_fault(self, diameter: float) -> str | None:
        """Return the reason why a root diameter [mm] is impossible, or None if the diameter is possible."""
        low, high = self.reference_diameter - 6.0 * self.module, self.reference_diameter + 2.0 * self.module
        if max(low, 0.0) < diameter < high:
            return None
        return f"is {diameter:.6g} mm, which is not a possible root diameter of these teeth"
