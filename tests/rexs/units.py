"""Gear units for the tests: a unit is described in Python and written as a REXS file in XML or JSON."""

import io
import json
import zipfile
from dataclasses import dataclass, field
from typing import Any
from xml.sax.saxutils import escape, quoteattr

Value = float | int | str | bool | list[Any]
LOWER, UPPER = 3, 26  # the stages of `double_helical`, in the order of Z


@dataclass
class Unit:
    """A gear unit; tests add components and relations, and write the unit as a REXS file."""

    version: str = "1.4"
    components: list[dict[str, Any]] = field(default_factory=list)
    relations: list[dict[str, Any]] = field(default_factory=list)
    cases: list[dict[int, dict[str, tuple[Value, str]]]] = field(default_factory=list)

    def add(self, type_: str, name: str = "", **attributes: tuple[Value, str]) -> int:
        """Add a component and return its id. Each attribute is a pair of value and unit."""
        self.components.append({"id": len(self.components) + 1, "type": type_, "name": name, "attributes": attributes})
        return len(self.components)

    def relate(self, type_: str, order: int | None = None, **roles: int) -> None:
        """Add a relation. `roles` contains the id of the component in each role."""
        self.relations.append({"id": len(self.relations) + 1, "type": type_, "order": order, "roles": roles})

    def of(self, component: int) -> dict[str, tuple[Value, str]]:
        """Return the attributes of a component. Changes of the returned dictionary change the unit."""
        found: dict[str, tuple[Value, str]] = self.components[component - 1]["attributes"]
        return found

    def xml(self) -> bytes:
        """Return the unit as the content of a .rexs file."""
        lines = [
            '<?xml version="1.0" encoding="UTF-8"?>',
            f'<model applicationId="tests" applicationVersion="1" date="2026-01-01" version="{self.version}">',
            " <!-- kept -->",
            " <relations>",
        ]
        for each in self.relations:
            order = "" if each["order"] is None else f' order="{each["order"]}"'
            lines.append(f'  <relation id="{each["id"]}" type="{each["type"]}"{order}>')
            lines += [f'   <ref id="{part}" role="{role}" hint="x"/>' for role, part in each["roles"].items()]
            lines.append("  </relation>")
        lines += [" </relations>", " <components>"]
        for each in self.components:
            lines += _component(
                each["id"], each["attributes"], f' type="{each["type"]}" name={quoteattr(each["name"])}'
            )
        lines.append(" </components>")
        if self.cases:
            lines.append(' <load_spectrum id="1">')
            for index, case in enumerate(self.cases, 1):
                lines.append(f'  <load_case id="{index}">')
                for component, attributes in case.items():
                    lines += _component(component, attributes, ' type="x"')
                lines.append("  </load_case>")
            lines.append(" </load_spectrum>")
        return "\n".join([*lines, "</model>", ""]).encode()

    def json(self) -> bytes:
        """Return the unit as the content of a .rexsj file."""
        model: dict[str, Any] = {
            "version": self.version,
            "applicationId": "tests",
            "applicationVersion": "1",
            "date": "2026-01-01T00:00:00+00:00",
            "relations": [
                {
                    "id": each["id"],
                    "type": each["type"],
                    **({} if each["order"] is None else {"order": each["order"]}),
                    "refs": [{"id": part, "role": role} for role, part in each["roles"].items()],
                }
                for each in self.relations
            ],
            "components": [
                {"id": each["id"], "type": each["type"], "name": each["name"], "attributes": _json(each["attributes"])}
                for each in self.components
            ],
        }
        if self.cases:
            model["load_spectrum"] = {
                "id": 1,
                "load_cases": [
                    {
                        "id": index,
                        "components": [{"id": id_, "attributes": _json(own)} for id_, own in case.items()],
                    }
                    for index, case in enumerate(self.cases, 1)
                ],
            }
        return json.dumps({"model": model}).encode()

    def zipped(self) -> bytes:
        """Return the unit as the content of a .rexsz file."""
        buffer = io.BytesIO()
        with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("model.rexs", self.xml())
        return buffer.getvalue()


def _component(id_: int, attributes: dict[str, tuple[Value, str]], more: str) -> list[str]:
    lines = [f'  <component id="{id_}"{more}>']
    for name, (value, unit) in attributes.items():
        inner = "".join(f"<c>{each}</c>" for each in value) if isinstance(value, list) else None
        text = f"<array>{inner}</array>" if inner is not None else _text(value)
        if name == "coded":
            text = f'<array code="float64">{value}</array>'
        lines.append(f'   <attribute id="{name}" unit={quoteattr(unit)}>{text}</attribute>')
    return [*lines, "  </component>"]


def _text(value: Value) -> str:
    return escape(str(value).lower() if isinstance(value, bool) else str(value))


def _json(attributes: dict[str, tuple[Value, str]]) -> list[dict[str, Any]]:
    kinds = {bool: "boolean", int: "integer", float: "floating_point", str: "string", list: "floating_point_array"}
    return [{"id": name, "unit": unit, kinds[type(value)]: value} for name, (value, unit) in attributes.items()]


def three_stages(version: str = "1.0") -> Unit:
    """Return a helical unit of three stages with 23/67, 13/76 and 14/87 teeth."""
    # The driving shaft has a speed of 1,400 1/min and a torque of 4.724562 N m.
    old = version == "1.0"
    degree = "°" if version < "1.4" else "deg"
    flank_type = "flank_geometry" if old else "cylindrical_gear_flank"
    unit = Unit(version)
    gear_unit = unit.add("gear_unit", "Unit")
    casing = unit.add("gear_casing")
    shafts = [unit.add("shaft", f"shaft {number}") for number in range(4)]
    unit.of(shafts[0]).update(rotational_speed=(1400.0, "1 / min"), defines_speed=(True, "none"))
    for part in (casing, *shafts):
        unit.relate("assembly", assembly=gear_unit, part=part)
    rows = [
        (53.0, 1.0, 30.0, (23, 16.0, 0.581), (67, 11.0, 0.5131)),
        (57.0, 1.25, -10.0, (13, 23.0, 0.521), (76, 15.0, -0.094)),
        (77.0, 1.5, 10.0, (14, 41.0, 0.536), (87, 36.0, -0.4815)),
    ]
    for index, (distance, module, angle, *gears) in enumerate(rows):
        stage = unit.add("cylindrical_stage", f"stage {index}", center_distance=(distance, "mm"))
        unit.relate("assembly", assembly=gear_unit, part=stage)
        ids = []
        for place, (teeth, width, shift) in enumerate(gears):
            gear = unit.add(
                "cylindrical_gear",
                normal_module=(module, "mm"),
                number_of_teeth=(teeth, "none"),
                face_width=(width, "mm"),
                helix_angle_reference_diameter=(angle if place == 0 else -angle, degree),
            )
            ids.append(gear)
            unit.relate("assembly", assembly=shafts[index + place], part=gear)
            flanks = [
                unit.add(
                    flank_type,
                    normal_pressure_angle=(20.0, degree),
                    addendum_modification_coefficient=(shift, "none"),
                )
                for _ in range(2)
            ]
            unit.relate("flank", gear=gear, left=flanks[0], right=flanks[1])
        unit.relate("stage", stage=stage, gear_1=ids[0], gear_2=ids[1])
    for shaft, attributes in (
        (shafts[0], {"torque_around_u_axis": (4.724562306435156, "N m"), "defines_torque": (True, "none")}),
        (shafts[3], {}),
    ):
        load = unit.add("external_load", transmits_torque=(True, "none"), **attributes)
        unit.relate("assembly", assembly=shaft, part=load)
    return unit


def turbo_unit(version: str = "2.0") -> Unit:
    """Return the turbo gear unit of the starter example: 12 MW, 10,000 1/min, 39/130 teeth, journal bearings."""
    unit = Unit(version)
    gear_unit = unit.add("gear_unit", "Turbo unit")
    casing = unit.add("gear_casing", temperature_lubricant=(50.0, "C"))
    stage = unit.add(
        "cylindrical_stage",
        "stage",
        minimum_normal_backlash=(0.25, "mm"),
        maximum_normal_backlash=(0.35, "mm"),
        application_factor_iso_6336_2006=(1.1, "none"),
    )
    oil = unit.add(
        "lubricant",
        viscosity_at_40_degree_celsius=(32.0, "mm^2 / s"),
        viscosity_at_100_degree_celsius=(5.4, "mm^2 / s"),
        density_at_15_degree_celsius=(0.87, "kg / dm^3"),
        basis=("mineral", "none"),
    )
    unit.relate("reference", origin=casing, referenced=oil)
    steel = unit.add(
        "material", elastic_modulus=(206000.0, "MPa"), poisson_ratio=(0.3, "none"), density=(7.85, "kg / dm^3")
    )
    axes = {"u_axis_vector": ([1.0, 0.0, 0.0], "mm"), "w_axis_vector": ([0.0, 0.0, 1.0], "mm")}
    gears = []
    rows = (
        (39, 11.5, [0.0, 0.0, 0.0], 160.0, 110.0, 260.0, 240.0),
        (130, -11.5, [0.0, 517.387, 0.0], 200.0, 140.0, 300.0, 800.0),
    )
    for place, (teeth, helix, origin, bore, width, clearance, outer) in enumerate(rows):
        shaft = unit.add("shaft", f"shaft {place}", support_vector=(origin, "mm"), **axes)
        unit.relate("reference", origin=shaft, referenced=steel)
        gear = unit.add(
            "cylindrical_gear",
            number_of_teeth=(teeth, "none"),
            normal_module=(6.0, "mm"),
            face_width=(200.0, "mm"),
            helix_angle_reference_diameter=(helix, "deg"),
            u_coordinate_on_shaft=(420.0, "mm"),
            arithmetic_mean_roughness_flank_iso_4287_1997=(0.3, "mum"),
        )
        gears.append(gear)
        unit.relate("assembly", assembly=shaft, part=gear)
        flanks = [unit.add("cylindrical_gear_flank", normal_pressure_angle=(20.0, "deg")) for _ in range(2)]
        unit.relate("flank", gear=gear, left=flanks[0], right=flanks[1])
        sections = ((0.0, 320.0, bore), (320.0, 200.0, outer), (520.0, 240.0, bore))
        for begin, length, diameter in sections:
            section = unit.add(
                "shaft_section",
                u_coordinate_on_shaft=(begin, "mm"),
                length=(length, "mm"),
                outer_diameter_begin=(diameter, "mm"),
                outer_diameter_end=(diameter, "mm"),
            )
            unit.relate("assembly", assembly=shaft, part=section)
        for position in (220.0, 620.0):
            bearing = unit.add(
                "hydrodynamic_radial_plain_bearing",
                inner_diameter=(bore, "mm"),
                width=(width, "mm"),
                diameter_clearance_plain_bearing=(clearance, "mum"),
                lubricant_feed_temperature=(65.0, "C"),
                u_coordinate_on_shaft_inner_side=(position, "mm"),
            )
            unit.relate("side", assembly=bearing, inner_part=shaft, outer_part=casing)
        loads: dict[str, tuple[Value, str]] = {"u_coordinate_on_shaft": (20.0, "mm")}
        if place == 0:
            unit.of(shaft).update(rotational_speed=(10000.0, "1 / min"), defines_speed=(True, "none"))
            loads.update(power=(12000.0, "kW"), defines_torque=(True, "none"))
        load = unit.add("external_load", transmits_torque=(True, "none"), **loads)
        unit.relate("assembly", assembly=shaft, part=load)
    unit.of(stage)["center_distance"] = (517.387, "mm")
    unit.relate("stage", stage=stage, gear_1=gears[0], gear_2=gears[1])
    unit.relate("assembly", assembly=gear_unit, part=stage)
    return unit


def double_helical(version: str = "2.0") -> Unit:
    """Return the turbo unit with double-helical gears: two stages of 28 degrees, 2 x 110 mm wide, 60 mm apart.

    The first stage is that at the lower Z, with a right-hand pinion. Its tip relief is that of both helices; each helix
    has a helix slope of its own.
    """
    unit = turbo_unit(version)
    stages = [next(each["id"] for each in unit.components if each["type"] == "cylindrical_stage")]
    gears = [each["id"] for each in unit.components if each["type"] == "cylindrical_gear"]
    shafts = [each["id"] for each in unit.components if each["type"] == "shaft"]
    stages.append(unit.add("cylindrical_stage", "stage 2", **unit.of(stages[0])))
    far = [unit.add("cylindrical_gear", **unit.of(gear)) for gear in gears]
    for helix, (pair, middle) in enumerate(((gears, 375.0), (far, 545.0))):
        for place, gear in enumerate(pair):
            unit.of(gear).update(
                normal_module=(5.5, "mm"),
                face_width=(110.0, "mm"),
                u_coordinate_on_shaft=(middle, "mm"),
                helix_angle_reference_diameter=(28.0 if helix == place else -28.0, "deg"),
            )
            if helix:
                unit.relate("assembly", assembly=shafts[place], part=gear)
                flanks = [unit.add("cylindrical_gear_flank", normal_pressure_angle=(20.0, "deg")) for _ in range(2)]
                unit.relate("flank", gear=gear, left=flanks[0], right=flanks[1])
    unit.relate("stage", stage=stages[1], gear_1=far[0], gear_2=far[1])
    for stage in stages:
        unit.of(stage)["center_distance"] = (526.362, "mm")
    for each in unit.components:
        own = each["attributes"]
        if each["type"] == "shaft" and own["support_vector"][0][1]:
            own["support_vector"] = ([0.0, 526.362, 0.0], "mm")
        if each["type"] == "hydrodynamic_radial_plain_bearing" and own["u_coordinate_on_shaft_inner_side"][0] > 600.0:
            own["u_coordinate_on_shaft_inner_side"] = (700.0, "mm")
        if each["type"] == "shaft_section" and own["u_coordinate_on_shaft"][0] > 300.0:
            begin = own["u_coordinate_on_shaft"][0]
            own["length"] = (280.0 if begin < 400.0 else 240.0, "mm")
            own["u_coordinate_on_shaft"] = (320.0 if begin < 400.0 else 600.0, "mm")
    return unit


def gears(unit: Unit, stage: int) -> tuple[int, int]:
    """Return the gears of a stage in the order of its relation."""
    roles = next(each["roles"] for each in unit.relations if each["roles"].get("stage") == stage)
    return roles["gear_1"], roles["gear_2"]


def modified(unit: Unit, stage: int, kind: str, **attributes: tuple[Value, str]) -> None:
    """Add a modification to both flanks of the pinion of a stage."""
    (flanks,) = [
        (each["roles"]["left"], each["roles"]["right"])
        for each in unit.relations
        if each["type"] == "flank" and each["roles"]["gear"] == gears(unit, stage)[0]
    ]
    for flank in flanks:
        unit.relate("reference", origin=flank, referenced=unit.add(kind, **attributes))


def held(unit: Unit, place: int) -> int:
    """Add a bearing that holds the pinion's (0) or the wheel's shaft (1) along its axis, and return its id."""
    shafts, casing = (
        [each["id"] for each in unit.components if each["type"] == name] for name in ("shaft", "gear_casing")
    )
    bearing = unit.add(
        "concept_bearing",
        radial_force_absorption=(False, "none"),
        axial_force_absorption=("both_directions", "none"),
    )
    unit.relate("side", assembly=bearing, inner_part=shafts[place], outer_part=casing[0])
    return bearing
