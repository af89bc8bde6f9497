"""Requests take every value of a file for which they have a field; the answer lists the values that are not used."""

import re
from collections.abc import Sequence
from fnmatch import fnmatch
from math import acos, asin, atan, cos, degrees, pi, radians, sin, sqrt, tan
from pathlib import Path
from typing import Any

import pytest

from app.calculations import BY_PATH
from app.evaluate import evaluate
from app.rexs.document import read
from app.rexs.table import UNITS
from app.rexs.unit import gear_unit
from app.schema.fields import leaves, value_at
from solvers.gears.gear import involute
from solvers.gears.pair import inverse_involute
from tests.rexs.units import UPPER, Unit, Value, double_helical, held, modified, three_stages, turbo_unit

MOST_BYTES = 20_000_000
LOAD, SCUFFING, PUMPING, TRAIN = "/v1/scuffing/load-distribution", "/v1/scuffing", "/v1/pumping", "/v1/drive-train"
Given = tuple[Value, str]


def answer(unit: Unit) -> dict[str, Any]:
    return gear_unit(read(unit.xml(), MOST_BYTES).model)


def stage_of(unit: Unit) -> dict[str, Any]:
    (stage,) = answer(unit)["stages"]
    found: dict[str, Any] = stage
    return found


def first(unit: Unit, type_: str) -> int:
    return next(int(each["id"]) for each in unit.components if each["type"] == type_)


def gear_set(version: str = "2.0", **of: dict[str, Given]) -> Unit:
    """Return the turbo unit with a material of its gears. `of` sets attributes of all components of a type."""
    unit = turbo_unit(version)
    gears = [each["id"] for each in unit.components if each["type"] == "cylindrical_gear"]
    steel = unit.add("material", elastic_modulus=(206000.0, "N / mm^2"))
    stage = first(unit, "cylindrical_stage")
    for gear in gears:
        unit.relate("reference", origin=gear, referenced=steel)
        data = unit.add("cylindrical_stage_gear_data")
        unit.relate("stage_gear_data", stage=stage, gear=gear, stage_gear_data=data)
    for type_, attributes in of.items():
        for each in unit.components:
            if each["type"] == type_:
                each["attributes"].update(attributes)
    return unit


# component, attribute, value and unit in the file; endpoint, field and value there
# fmt: off
MEANINGS: list[tuple[str, str, Value, str, str, str, Any]] = [
    ("material", "thermal_conductivity", 15.0, "W / (m K)", LOAD, "materials.wheel.thermal_conductivity_w_per_m_k", 15.0),
    ("material", "thermal_capacity", 500.0, "J / (kg K)", SCUFFING, "materials.pinion.specific_heat_j_per_kg_k", 500.0),
    ("material", "elastic_modulus", 196000.0, "MPa", TRAIN, "materials.pinion.youngs_modulus_gpa", 196.0),
    ("material", "elastic_modulus", 196000.0, "MPa", TRAIN, "pinion_shaft.youngs_modulus_gpa", 196.0),
    ("material", "poisson_ratio", 0.28, "none", SCUFFING, "materials.wheel.poisson_ratio", 0.28),
    ("material", "poisson_ratio", 0.28, "none", TRAIN, "wheel_shaft.poisson_ratio", 0.28),
    ("material", "density", 7.7, "kg / dm^3", SCUFFING, "materials.wheel.density_kg_per_m3", 7700.0),
    ("material", "density", 7.7, "kg / dm^3", TRAIN, "wheel_shaft.density_kg_per_m3", 7700.0),
    ("cylindrical_stage", "mesh_load_factor_iso_6336_2006", 1.15, "none", SCUFFING, "load.mesh_load_factor", 1.15),
    ("cylindrical_stage", "mesh_load_factor_iso_6336_2019", 1.2, "none", TRAIN, "operation.mesh_load_factor", 1.2),
    ("cylindrical_stage", "dynamic_factor_iso_6336_2019", 1.1, "none", LOAD, "load.dynamic_factor", 1.1),
    ("cylindrical_stage", "dynamic_factor_iso_6336_2006", 1.1, "none", LOAD, "load.dynamic_factor", 1.1),
    ("cylindrical_stage", "dynamic_factor_din_3990_1987", 1.1, "none", LOAD, "load.dynamic_factor", 1.1),
    ("cylindrical_stage", "dynamic_factor_agma_2101_1995", 1.1, "none", LOAD, "load.dynamic_factor", 1.1),
    ("cylindrical_stage", "dynamic_factor_agma_2101_c95", 1.1, "none", LOAD, "load.dynamic_factor", 1.1),
    ("cylindrical_stage", "dynamic_factor_agma_925_2003", 1.1, "none", LOAD, "load.dynamic_factor", 1.1),
    ("cylindrical_stage", "dynamic_factor_agma_925_a03", 1.1, "none", LOAD, "load.dynamic_factor", 1.1),
    ("cylindrical_stage", "application_factor_iso_6336_2019", 1.3, "none", LOAD, "load.application_factor", 1.3),
    ("cylindrical_stage", "application_factor_iso_6336_2006", 1.3, "none", LOAD, "load.application_factor", 1.3),
    ("cylindrical_stage", "application_factor_din_3990_1987", 1.3, "none", LOAD, "load.application_factor", 1.1),
    ("cylindrical_stage", "application_factor_scuffing_iso_6336_2022", 1.5, "none", SCUFFING, "load.application_factor", 1.5),
    ("cylindrical_stage", "application_factor_scuffing_iso_6336_2022", 1.5, "none", LOAD, "load.application_factor", 1.1),
    ("cylindrical_stage", "application_factor_scuffing_iso_6336_2022", 1.5, "none", TRAIN, "operation.application_factor", 1.1),
    ("cylindrical_stage", "center_distance", 517.4, "mm", LOAD, "gears.centre_distance_mm", 517.4),
    ("cylindrical_stage", "common_face_width", 180.0, "mm", LOAD, "gears.face_width_mm", 180.0),
    ("cylindrical_stage", "temperature_lubricant", 45.0, "C", SCUFFING, "temperatures.oil_c", 45.0),
    ("cylindrical_stage", "oil_inlet_or_sump_temperature_agma_925_2003", 45.0, "C", SCUFFING, "temperatures.oil_c", 45.0),
    ("cylindrical_stage", "oil_inlet_or_sump_temperature_agma_925_a03", 45.0, "C", SCUFFING, "temperatures.oil_c", 45.0),
    ("gear_casing", "temperature_lubricant", 45.0, "C", TRAIN, "temperatures.oil_c", 45.0),
    ("cylindrical_gear", "bulk_temperature", 95.0, "C", SCUFFING, "temperatures.bulk_c", 95.0),
    ("cylindrical_gear", "bulk_temperature", 95.0, "C", TRAIN, "thermal.pinion_bulk_c", 95.0),
    ("cylindrical_gear", "bulk_temperature", 95.0, "C", TRAIN, "thermal.wheel_bulk_c", 95.0),
    ("cylindrical_stage", "tooth_temperature_agma_925_2003", 92.0, "C", SCUFFING, "temperatures.bulk_c", 92.0),
    ("cylindrical_stage", "tooth_temperature_agma_925_a03", 365.15, "K", SCUFFING, "temperatures.bulk_c", 92.0),
    ("cylindrical_stage", "mean_scuffing_temperature_agma_925_2003", 300.0, "C", SCUFFING, "temperatures.scuffing_c", 300.0),
    ("cylindrical_stage", "mean_scuffing_temperature_agma_925_a03", 300.0, "C", TRAIN, "temperatures.scuffing_c", 300.0),
    ("cylindrical_stage", "lubrication_type_agma_925_2003", "splash_lubrication", "none", SCUFFING, "temperatures.oil_supply", "dip"),
    ("cylindrical_stage", "lubrication_type_agma_925_a03", "spray_lubrication", "none", SCUFFING, "temperatures.oil_supply", "spray"),
    ("cylindrical_stage", "lubrication_type_vdi_2736_2014", "circulating_oil", "none", SCUFFING, "temperatures.oil_supply", "spray"),
    ("cylindrical_stage", "determination_of_lubrication_type_vdi_2736_2014", "circulating_oil", "none", SCUFFING, "temperatures.oil_supply", "spray"),
    ("cylindrical_stage", "lubrication_type", "injection", "none", SCUFFING, "temperatures.oil_supply", "spray"),
    ("cylindrical_stage", "lubrication_type", "submerged", "none", SCUFFING, "temperatures.oil_supply", "submerged"),
    ("cylindrical_stage", "lubrication_factor_scuffing_iso_6336_2022", 0.2, "none", SCUFFING, "temperatures.oil_supply", "submerged"),
    ("cylindrical_stage", "mean_coefficient_of_friction_constant_agma_925_2003", 0.07, "none", SCUFFING, "friction_coefficient", 0.07),
    ("cylindrical_stage", "mean_coefficient_of_friction_constant_agma_925_a03", 0.07, "none", LOAD, "friction_coefficient", 0.07),
    ("lubricant", "viscosity_at_40_degree_celsius", 46.0, "mm^2 / s", SCUFFING, "lubricant.kinematic_viscosity_40_mm2_per_s", 46.0),
    ("lubricant", "viscosity_at_100_degree_celsius", 6.0, "mm^2 / s", SCUFFING, "lubricant.kinematic_viscosity_100_mm2_per_s", 6.0),
    ("lubricant", "density_at_15_degree_celsius", 0.9, "kg / dm^3", SCUFFING, "lubricant.density_15_kg_per_m3", 900.0),
    ("lubricant", "thermal_conductivity", 0.13, "W / (m K)", SCUFFING, "lubricant.thermal_conductivity_w_per_m_k", 0.13),
    ("lubricant", "thermal_capacity", 1900.0, "J / (kg K)", TRAIN, "lubricant.specific_heat_j_per_kg_k", 1900.0),
    ("lubricant", "pressure_viscosity_coefficient_agma_925_2003", 0.0219, "mm^2 / N", SCUFFING, "lubricant.pressure_viscosity_per_gpa", 21.9),
    ("lubricant", "pressure_viscosity_coefficient_agma_925_a03", 0.0219, "mm^2 / N", SCUFFING, "lubricant.pressure_viscosity_per_gpa", 21.9),
    ("lubricant", "pressure_viscosity_coefficient_at_38_degrees_celsius", 0.02, "mm^2 / N", SCUFFING, "lubricant.pressure_viscosity_38_per_gpa", 20.0),
    ("cylindrical_gear", "normal_module", 6.5, "mm", LOAD, "gears.module_mm", 6.5),
    ("cylindrical_gear", "face_width", 190.0, "mm", LOAD, "gears.face_width_mm", 190.0),
    ("cylindrical_gear", "global_tolerance_class_iso_1328_2013", 6, "none", LOAD, "gears.quality_class", 6),
    ("cylindrical_gear", "global_tolerance_class_iso_1328_2013", 5, "none", TRAIN, "gears.quality_class", 5),
    ("cylindrical_gear", "addendum_basic_profile", 5.4, "mm", LOAD, "gears.pinion.addendum", 0.9),
    ("cylindrical_gear_flank", "addendum_coefficient_basic_profile", 0.95, "none", LOAD, "gears.wheel.addendum", 0.95),
    ("cylindrical_gear_flank", "addendum_modification_coefficient", 0.1, "none", LOAD, "gears.wheel.profile_shift", 0.1),
    ("cylindrical_gear_flank", "addendum_modification_coefficient_after_finishing", 0.1, "none", LOAD, "gears.wheel.profile_shift", 0.1),
    ("cylindrical_gear_flank", "addendum_modification", 0.6, "mm", LOAD, "gears.pinion.profile_shift", 0.1),
    ("cylindrical_gear_flank", "normal_pressure_angle", 22.5, "deg", LOAD, "gears.pressure_angle_deg", 22.5),
    ("cylindrical_gear", "arithmetic_mean_roughness_flank_iso_4287_1997", 0.5, "mum", LOAD, "materials.pinion.roughness_um", 0.5),
    ("gear_unit", "reference_temperature", 22.0, "C", TRAIN, "thermal.reference_c", 22.0),
    ("gear_unit", "gravitational_acceleration", 4.903325, "m / s^2", TRAIN, "operation.gravity_factor", 0.5),
    ("gear_unit", "account_for_gravity", False, "none", TRAIN, "operation.gravity_factor", 0.0),
    ("hydrodynamic_radial_plain_bearing", "inner_diameter", 150.0, "mm", TRAIN, "wheel_shaft.bearings.0.diameter_mm", 150.0),
    ("hydrodynamic_radial_plain_bearing", "width", 100.0, "mm", TRAIN, "pinion_shaft.bearings.1.width_mm", 100.0),
    ("hydrodynamic_radial_plain_bearing", "diameter_clearance_plain_bearing", 250.0, "mum", TRAIN, "pinion_shaft.bearings.0.radial_clearance_um", 125.0),
    ("hydrodynamic_radial_plain_bearing", "lubricant_flow_through_bearing", 0.5, "l / s", TRAIN, "pinion_shaft.bearings.0.oil_flow_l_per_min", 30.0),
    ("hydrodynamic_radial_plain_bearing", "lubricant_feed_temperature", 60.0, "C", TRAIN, "pinion_shaft.bearings.0.feed_temperature_c", 60.0),
    ("hydrodynamic_radial_plain_bearing", "misalignment_in_v_direction", 20.0, "mum", TRAIN, "pinion_shaft.bearings.0.offset_um.0", 20.0),
]
# fmt: on


@pytest.mark.parametrize(
    ("type_", "name", "value", "unit_", "endpoint", "path", "expected"),
    MEANINGS,
    ids=[f"{each[1]}-{each[4]}-{each[5]}" for each in MEANINGS],
)
def test_an_attribute_becomes_its_field(
    type_: str, name: str, value: Value, unit_: str, endpoint: str, path: str, expected: Any
) -> None:
    stage = stage_of(gear_set(**{type_: {name: (value, unit_)}}))
    found = value_at(stage["requests"][endpoint], path)
    assert found == (pytest.approx(expected, rel=1e-6) if isinstance(expected, float) else expected)
    unused = {
        each["attribute"] for each in stage["ignored"] if each["reason"] != "another value of the file is used instead"
    }
    assert name not in unused


def test_heat_of_the_material_reaches_the_flash() -> None:
    """The thermal conductivity and heat capacity in the file change the flash temperature from 43.7 to 74.3 K."""
    # A contact is hotter if its material conducts heat poorly.
    steel = {"thermal_conductivity": (15.0, "W / (m K)"), "thermal_capacity": (500.0, "J / (kg K)")}
    flashes = []
    for attributes in ({}, steel):
        request = stage_of(gear_set(material=attributes))["requests"][SCUFFING]
        request["model"] = {"lubrication": "closed_form"}
        calculation = BY_PATH[SCUFFING]
        model = calculation.request.model_validate({**request, "detail": "summary"})
        flashes.append(evaluate(calculation, model).model_dump()["flash"]["blok_max_k"])
    coefficient_ratio = sqrt(46.0 * 470.0 / (15.0 * 500.0))  # flash is inverse to the thermal contact coefficient
    assert flashes[1] / flashes[0] == pytest.approx(coefficient_ratio, rel=1e-3)


@pytest.mark.parametrize(
    ("attributes", "kind"),
    [
        ({"lubricant_type_iso_6336_2006": "mineral_oil"}, "mineral"),
        ({"lubricant_type_iso_6336_2006": "polyalfaolefin"}, "pao"),
        ({"lubricant_type_iso_6336_2019": "non_water_soluble_polyglycol", "basis": "mineral"}, "polyglycol"),
        ({"lubricant_type_iso_6336_2019": "water_soluble_polyglycol"}, None),
        ({"basis": "water-soluble polyglycol", "name": "PAG 220"}, None),
        ({"basis": "wasserlösliches Polyglykol"}, None),
        ({"basis": "nicht wasserlösliches Polyglykol"}, "polyglycol"),
        ({"lubricant_type_iso_6336_2019": "phosphate_ester", "basis": "mineral"}, None),
        ({"lubricant_type_iso_6336_2019": "traction_fluid"}, None),
        ({"lubricant_type_agma_925_2003": "pao_based_synthetic_oil"}, "pao"),
        ({"lubricant_type_agma_925_a03": "pag_based_synthetic_oil"}, "polyglycol"),
        ({"lubricant_type_agma_925_a03": "mil_l_23699e"}, "ester"),
        ({"basis": "synthetic", "name": "PAO 220"}, "pao"),
        ({"basis": "mineral_oil"}, "mineral"),
        ({"basis": "x", "kind": "polyglycol"}, "polyglycol"),
        ({"basis": "x", "name": "a Polyglykol"}, "polyglycol"),
        ({"lubricant_type_iso_6336_2006": "phosphate_ester", "basis": "mineral"}, None),
        ({"lubricant_type_iso_6336_2006": "traction_fluid"}, None),
        ({"basis": "synthetic"}, None),
        ({"basis": "biologic_degradable"}, None),
        ({"basis": "food_grade"}, None),
    ],
)
def test_the_kind_of_oil(attributes: dict[str, str], kind: str | None) -> None:
    found = answer(gear_set(lubricant={name: (value, "none") for name, value in attributes.items()}))
    (stage,) = found["stages"]
    assert stage["requests"][SCUFFING]["lubricant"].get("kind") == kind
    assert ("oil_kind" in {each["code"] for each in found["findings"]}) == (kind is None)
    assert ("lubricant.kind" in {each["field"] for each in stage["missing"]}) == (kind is None)


@pytest.mark.parametrize("said", ["oil_mist", "dry", "grease", "water_oil_emulsion"])
def test_a_lubrication_that_is_not_modelled_is_found(said: str) -> None:
    found = answer(gear_set(cylindrical_stage={"lubrication_type_vdi_2736_2014": (said, "none")}))
    assert "oil_supply" in {each["code"] for each in found["findings"]}
    assert "oil_supply" not in found["stages"][0]["requests"][SCUFFING]["temperatures"]


def test_a_friction_that_was_calculated_is_not_taken() -> None:
    stage = gear_set(
        cylindrical_stage={
            "mean_coefficient_of_friction_constant_agma_925_2003": (0.07, "none"),
            "determination_of_mean_coefficient_of_friction_agma_925_2003": (
                "constant_according_to_agma_217_01",
                "none",
            ),
        }
    )
    assert "friction_coefficient" not in stage_of(stage)["requests"][SCUFFING]


def test_the_bulk_temperature_is_the_mean_of_the_gears() -> None:
    unit = gear_set(cylindrical_gear={"bulk_temperature": (90.0, "C")})
    unit.of(first(unit, "cylindrical_gear"))["bulk_temperature"] = (100.0, "C")
    assert stage_of(unit)["requests"][SCUFFING]["temperatures"]["bulk_c"] == 95.0
    thermal = stage_of(unit)["requests"][TRAIN]["thermal"]
    assert (thermal["pinion_bulk_c"], thermal["wheel_bulk_c"]) == (100.0, 90.0)


def turbine_stage(basic_profile: bool = True) -> Unit:
    """Return the fast stage of a wind turbine. The tip diameters do not follow from the basic profile."""
    unit = Unit("1.4")
    unit.add("gear_unit")
    shafts = [unit.add("shaft"), unit.add("shaft")]
    unit.of(shafts[0]).update(rotational_speed=(1165.9, "1 / min"), defines_speed=(True, "none"))
    stage = unit.add("cylindrical_stage", center_distance=(861.0, "mm"))
    gears = []
    for place, (teeth, helix, shift, tip) in enumerate(((24, 10.0, 0.48, 380.747), (95, -10.0, 0.6691, 1395.376))):
        gear = unit.add(
            "cylindrical_gear",
            number_of_teeth=(teeth, "none"),
            normal_module=(14.0, "mm"),
            helix_angle_reference_diameter=(helix, "deg"),
            face_width=(360.0, "mm"),
            tip_diameter=(tip, "mm"),
        )
        gears.append(gear)
        unit.relate("assembly", assembly=shafts[place], part=gear)
        profile: dict[str, Given] = {"addendum_coefficient_basic_profile": (1.0, "none")} if basic_profile else {}
        shifts: dict[str, Given] = {"addendum_modification_coefficient": (shift, "none")}
        flanks = [
            unit.add("cylindrical_gear_flank", normal_pressure_angle=(20.0, "deg"), **shifts, **profile) for _ in "lr"
        ]
        unit.relate("flank", gear=gear, left=flanks[0], right=flanks[1])
    unit.relate("stage", stage=stage, gear_1=gears[0], gear_2=gears[1])
    load = unit.add("external_load", torque_around_u_axis=(40953.0, "N m"))
    unit.relate("assembly", assembly=shafts[0], part=load)
    return unit


@pytest.mark.parametrize("basic_profile", [True, False])
def test_the_tip_diameter_counts_before_the_basic_profile(basic_profile: bool) -> None:
    gears = stage_of(turbine_stage(basic_profile))["requests"][LOAD]["gears"]
    for role, teeth, shift, tip in (("pinion", 24, 0.48, 380.747), ("wheel", 95, 0.6691, 1395.376)):
        diameter = 14.0 * (teeth / cos(radians(10.0)) + 2.0 * (gears[role]["addendum"] + shift))
        assert diameter == pytest.approx(tip, abs=1e-4)


def test_a_gear_with_tip_alteration_has_its_contact_ratio() -> None:
    calculation = BY_PATH[LOAD]
    request = {**stage_of(turbine_stage())["requests"][LOAD], "detail": "summary"}
    found = evaluate(calculation, calculation.request.model_validate(request)).model_dump()
    ratios = [value for name, value in _numbers(found) if "contact_ratio" in name]
    assert pytest.approx(1.463, abs=2e-3) in ratios


def _numbers(of: Any, name: str = "") -> list[tuple[str, float]]:
    if isinstance(of, dict):
        return [each for key, value in of.items() for each in _numbers(value, f"{name}.{key}")]
    return [(name, of)] if isinstance(of, float) else []


def test_the_mean_of_the_limits_stands_in_for_a_tip_diameter() -> None:
    unit = turbine_stage()
    expected = stage_of(unit)["requests"][LOAD]["gears"]["pinion"]["addendum"]
    gear = unit.of(first(unit, "cylindrical_gear"))
    del gear["tip_diameter"]
    gear.update(minimum_tip_diameter=(380.647, "mm"), maximum_tip_diameter=(380.847, "mm"))
    assert stage_of(unit)["requests"][LOAD]["gears"]["pinion"]["addendum"] == pytest.approx(expected, abs=1e-6)


def test_angles_at_the_base_circle_and_in_the_transverse_section_are_converted() -> None:
    unit = gear_set()
    transverse = degrees(atan(tan(radians(22.5)) / cos(radians(11.5))))
    base = degrees(asin(sin(radians(11.5)) * cos(radians(22.5))))
    for each in unit.components:
        attributes = each["attributes"]
        if each["type"] == "cylindrical_gear":
            helix = attributes.pop("helix_angle_reference_diameter")[0]
            attributes["helix_angle_base_diameter"] = (base if helix > 0.0 else -base, "deg")
        if each["type"] == "cylindrical_gear_flank":
            del attributes["normal_pressure_angle"]
            attributes["pressure_angle_in_the_transverse_section"] = (transverse, "deg")
    stage = stage_of(unit)
    gears = stage["requests"][LOAD]["gears"]
    assert gears["helix_angle_deg"] == pytest.approx(11.5, rel=1e-6)
    assert gears["pressure_angle_deg"] == pytest.approx(22.5, rel=1e-6)
    assert stage["hand"] == "right"


def test_an_impossible_tip_diameter_leaves_the_basic_profile() -> None:
    unit = turbine_stage()
    unit.of(first(unit, "cylindrical_gear"))["tip_diameter"] = (300.0, "mm")
    found = answer(unit)
    assert found["stages"][0]["requests"][LOAD]["gears"]["pinion"]["addendum"] == 1.0
    assert "diameter" in {each["code"] for each in found["findings"]}


def test_the_shift_after_finishing_is_the_backlash() -> None:
    unit = gear_set(
        cylindrical_gear_flank={
            "addendum_modification_coefficient": (0.1, "none"),
            "addendum_modification_coefficient_after_finishing": (0.08, "none"),
        }
    )
    for name in ("minimum_normal_backlash", "maximum_normal_backlash"):
        del unit.of(first(unit, "cylindrical_stage"))[name]
    gears = stage_of(unit)["requests"][PUMPING]["gears"]
    assert gears["pinion"]["profile_shift"] == 0.1
    assert gears["normal_backlash_mm"] == pytest.approx(2 * 6.0 * sin(radians(20.0)) * 0.04, rel=1e-6)


def test_a_transverse_backlash_is_converted() -> None:
    unit = gear_set(
        cylindrical_stage={"minimum_transverse_backlash": (0.3, "mm"), "maximum_transverse_backlash": (0.4, "mm")}
    )
    stage = unit.of(first(unit, "cylindrical_stage"))
    for name in ("minimum_normal_backlash", "maximum_normal_backlash"):
        del stage[name]
    helix, normal = radians(11.5), radians(20.0)
    transverse = atan(tan(normal) / cos(helix))
    base = 6.0 * 169 / cos(helix) * cos(transverse)  # sum of both base diameters
    working, base_helix = acos(base / 2 / 517.387), atan(tan(helix) * cos(transverse))
    own = base * (involute(working) - involute(transverse)) * cos(base_helix)
    expected = 0.35 * cos(working) * cos(base_helix) - own
    found = stage_of(unit)["requests"][PUMPING]["gears"]["normal_backlash_mm"]
    assert found == pytest.approx(expected, abs=1e-6)
    stage["minimum_normal_backlash"] = (0.5, "mm")  # counts before the transverse one
    assert stage_of(unit)["requests"][PUMPING]["gears"]["normal_backlash_mm"] == pytest.approx(0.5 - own, abs=1e-6)


def test_the_common_face_width_counts_before_the_smaller_face() -> None:
    unit = three_stages("1.4")
    unit.of(first(unit, "cylindrical_stage"))["common_face_width"] = (10.0, "mm")
    assert answer(unit)["stages"][0]["requests"][LOAD]["gears"]["face_width_mm"] == 10.0


@pytest.mark.parametrize(
    ("classes", "expected"),
    [((5, 7), 7), ((8, 6), 8), ((6, None), 6), ((5, 12), None), ((0, 0), None), ((5.5, 5), None)],
)
def test_the_coarser_quality_class_of_both_gears_is_used(classes: Sequence[float | None], expected: int | None) -> None:
    """A class that the standard does not have is a finding; the request then has no class."""
    unit = gear_set()
    gears = [each["attributes"] for each in unit.components if each["type"] == "cylindrical_gear"]
    for attributes, stated in zip(gears, classes, strict=True):
        if stated is not None:
            attributes["global_tolerance_class_iso_1328_2013"] = (stated, "none")
    found = answer(unit)
    (stage,) = found["stages"]
    assert {stage["requests"][each]["gears"].get("quality_class") for each in (LOAD, SCUFFING, TRAIN)} == {expected}
    assert ("quality_class" in {each["code"] for each in found["findings"]}) == (expected is None)
    assumed = {each["field"] for each in stage["assumed"]}
    assert ("gears.quality_class" in assumed) == (expected in {7, 8})


def test_a_transverse_module_becomes_the_normal_one() -> None:
    """In REXS, the pressure angle is the normal one. A profile shift in mm is divided by the normal module."""
    unit = gear_set(cylindrical_gear_flank={"addendum_modification": (1.2, "mm")})
    for each in unit.components:
        if each["type"] == "cylindrical_gear":
            del each["attributes"]["normal_module"]
            helix = each["attributes"]["helix_angle_reference_diameter"][0]
            each["attributes"]["transverse_module"] = (4.0 / cos(radians(15.0)), "mm")
            each["attributes"]["helix_angle_reference_diameter"] = (15.0 if helix > 0 else -15.0, "deg")
    gears = stage_of(unit)["requests"][LOAD]["gears"]
    assert gears["module_mm"] == pytest.approx(4.0, rel=1e-6)
    assert gears["pinion"]["profile_shift"] == pytest.approx(0.3, rel=1e-6)
    assert gears.get("module_plane", "normal") == "normal"
    base_pitch = pi * 4.0 / cos(radians(15.0)) * cos(atan(tan(radians(20.0)) / cos(radians(15.0))))
    assert base_pitch == pytest.approx(12.1741, abs=1e-4)  # of the normal pressure angle 20


def test_a_relief_by_diameter_without_centre_distance_uses_that_of_the_shifts() -> None:
    unit = turbine_stage()
    flanks = [each["id"] for each in unit.components if each["type"] == "cylindrical_gear_flank"]
    relief = unit.add("root_relief", root_relief_depth=(20.0, "mum"), root_relief_datum_diameter=(1360.0, "mm"))
    for flank in flanks[2:]:
        unit.relate("reference", origin=flank, referenced=relief)
    lengths = []
    for stated in (True, False):
        if not stated:
            normal, helix = radians(20.0), radians(10.0)
            transverse = atan(tan(normal) / cos(helix))
            free = involute(transverse) + 2 * tan(normal) * (0.48 + 0.6691) / 119
            distance = 14.0 * 119 / cos(helix) / 2 * cos(transverse) / cos(inverse_involute(free))
            unit.of(first(unit, "cylindrical_stage"))["center_distance"] = (distance, "mm")
        lengths.append(_relief(unit))
        if not stated:
            del unit.of(first(unit, "cylindrical_stage"))["center_distance"]
            assert _relief(unit) == pytest.approx(lengths[-1], abs=1e-4)
    assert lengths[0] == pytest.approx(lengths[1], abs=2.0)


def _relief(unit: Unit) -> float:
    return float(stage_of(unit)["requests"][LOAD]["modifications"]["tip_relief_length_mm"])


def test_shafts_that_are_not_at_the_centre_distance_are_found() -> None:
    unit = turbo_unit()
    assert answer(unit)["findings"] == []
    shafts = [each for each in unit.components if each["type"] == "shaft"]
    shafts[1]["attributes"]["support_vector"] = ([0.0, 120.0, 0.0], "mm")
    found = [each for each in answer(unit)["findings"] if each["code"] == "centre_distance"]
    assert "120 mm" in found[0]["message"]


def in_cases(unit: Unit, *cases: dict[int, dict[str, Given]]) -> Unit:
    unit.cases = list(cases)
    return unit


def test_a_load_case_of_another_direction_is_told_and_keeps_the_flanks() -> None:
    """A modification is on the flanks that carry in the request. The last case has another direction there."""
    unit = turbo_unit()
    flanks = [each["id"] for each in unit.components if each["type"] == "cylindrical_gear_flank"]
    for flank, amount in zip(flanks, (10.0, 20.0, 30.0, 40.0), strict=True):
        slope = unit.add("helix_slope", helix_slope=(amount, "mum"))
        unit.relate("reference", origin=flank, referenced=slope)
    load, shaft = first(unit, "external_load"), first(unit, "shaft")
    in_cases(
        unit,
        {load: {"power": (-12000.0, "kW")}},
        {shaft: {"rotational_speed": (-10000.0, "1 / min")}},
        {load: {"power": (9000.0, "kW")}},
        {load: {"power": (-12000.0, "kW")}, shaft: {"rotational_speed": (-10000.0, "1 / min")}},
        {load: {"power": (-12000.0, "kW")}, first(unit, "gear_casing"): {"temperature_lubricant": (60.0, "C")}},
    )
    found = answer(unit)
    told = [each["message"] for each in found["findings"] if each["code"] == "other_direction"]
    assert [re.findall(r"load case (\d+)", message) for message in told] == [["1"], ["2"], ["4"], ["5"]]
    (stage,) = found["stages"]
    assert stage["requests"][LOAD]["modifications"]["helix_slope_um"] != 0.0
    changed = {path.partition(".")[0] for case in stage["cases"] for path in case["overrides"]}
    assert changed == {"load", "temperatures"}


def test_power_in_a_load_case_counts_before_the_torque_of_the_model() -> None:
    unit = three_stages("1.4")
    load, shaft = first(unit, "external_load"), first(unit, "shaft")
    in_cases(unit, {load: {"power": (20.0, "kW")}, shaft: {"rotational_speed": (1500.0, "1 / min")}})
    case = answer(unit)["stages"][0]["cases"][0]
    assert case["overrides"]["load.pinion_torque_n_m"] == pytest.approx(127.324, abs=1e-3)


@pytest.mark.parametrize(("power", "conflict"), [(0.69265, False), (20.0, True)])
def test_power_and_torque_that_contradict_are_found(power: float, conflict: bool) -> None:
    unit = three_stages("1.4")
    unit.of(first(unit, "external_load"))["power"] = (power, "kW")
    found = answer(unit)
    assert ("power_conflict" in {each["code"] for each in found["findings"]}) == conflict
    assert found["stages"][0]["requests"][LOAD]["load"]["pinion_torque_n_m"] == pytest.approx(4.724562, rel=1e-6)


def test_every_input_of_a_load_case_is_an_override() -> None:
    unit = gear_set()
    stage, oil, gear = (first(unit, type_) for type_ in ("cylindrical_stage", "lubricant", "cylindrical_gear"))
    in_cases(
        unit,
        {
            1: {"operating_time_fraction": (30.0, "%")},
            stage: {
                "application_factor_iso_6336_2006": (1.25, "none"),
                "dynamic_factor_iso_6336_2006": (1.092, "none"),
                "mesh_load_factor_iso_6336_2019": (1.15, "none"),
                "application_factor_scuffing_iso_6336_2022": (1.6, "none"),
                "lubrication_type_agma_925_2003": ("splash_lubrication", "none"),
                "face_load_factor_contact_stress": (1.4, "none"),
            },
            oil: {"viscosity_at_40_degree_celsius": (46.0, "mm^2 / s")},
            gear: {"bulk_temperature": (90.0, "C")},
            first(unit, "gear_casing"): {"temperature_lubricant": (50.0, "C")},
        },
        {1: {"operating_time_fraction": (70.0, "%")}},
    )
    found = answer(unit)["stages"][0]
    overrides = found["cases"][0]["overrides"]
    assert {path: value for path, value in overrides.items() if not path.startswith("load.pinion")} == {
        "load.application_factor": 1.6,
        "load.dynamic_factor": 1.092,
        "load.mesh_load_factor": 1.15,
        "temperatures.oil_supply": "dip",
        "temperatures.bulk_c": 90.0,
        "temperatures.oil_c": 50.0,
        "lubricant.kinematic_viscosity_40_mm2_per_s": 46.0,
    }
    assert found["spectra"][LOAD][0]["set"]["load.application_factor"] == 1.25
    assert found["spectra"][TRAIN][0]["set"]["operation.application_factor"] == 1.25
    assert set(found["cases"][1]["overrides"]) == {"load.pinion_torque_n_m", "load.pinion_speed_rpm"}
    unused = [(each["attribute"], each["case"]) for each in found["ignored"] if each["case"] is not None]
    assert unused == [("face_load_factor_contact_stress", "1")]


def test_a_fault_of_a_load_case_names_the_case() -> None:
    unit = gear_set()
    in_cases(unit, {first(unit, "cylindrical_stage"): {"dynamic_factor_iso_6336_2006": (1.1, "kg")}})
    (fault,) = answer(unit)["findings"]
    assert fault["message"].startswith("load case 1: ")


def test_numbers_have_at_most_seven_digits() -> None:
    unit = three_stages("1.4")
    flank = first(unit, "cylindrical_gear_flank")
    unit.of(flank)["addendum_modification_coefficient"] = (0.5810000000000001, "none")
    unit.of(flank + 1)["addendum_modification_coefficient"] = (0.5810000000000001, "none")
    unit = in_cases(unit, {first(unit, "external_load"): {"torque_around_u_axis": (1.0 / 3.0, "N m")}})
    found = answer(unit)["stages"]
    for stage in found:
        for _, number in (*_numbers(stage["requests"]), *_numbers(stage["cases"][0])):
            assert number == float(f"{number:.7g}")
    assert found[0]["requests"][LOAD]["gears"]["pinion"]["profile_shift"] == 0.581


@pytest.mark.parametrize("teeth", [-60, -23])
def test_a_ring_gear_is_named(teeth: int) -> None:
    unit = three_stages("1.4")
    unit.of(first(unit, "cylindrical_gear"))["number_of_teeth"] = (teeth, "none")
    found = answer(unit)
    assert any("ring gear" in each["message"] for each in found["findings"])
    assert len(found["stages"]) == 2


def test_a_boolean_is_no_number() -> None:
    unit = three_stages("1.4")
    unit.of(first(unit, "cylindrical_gear"))["face_width"] = (True, "mm")
    found = gear_unit(read(unit.json(), MOST_BYTES).model)
    assert "not_a_number" in {each["code"] for each in found["findings"]}


def test_what_the_gear_states_stands_in_for_what_the_shafts_do_not() -> None:
    unit = gear_set(
        cylindrical_stage_gear_data={"torque": (-11000.0, "N m")},
        cylindrical_gear={"rotational_speed": (9000.0, "1 / min")},
    )
    data = [each for each in unit.components if each["type"] == "cylindrical_stage_gear_data"]
    data[0]["attributes"]["is_driving_gear"] = (True, "none")
    del unit.of(first(unit, "shaft"))["rotational_speed"], unit.of(first(unit, "external_load"))["power"]
    stage = stage_of(unit)
    assert stage["requests"][LOAD]["load"]["pinion_torque_n_m"] == 11000.0
    assert stage["requests"][LOAD]["load"]["pinion_speed_rpm"] == 9000.0
    assert stage["driver"] == stage["pinion"]
    assert TRAIN not in stage["requests"]


SCHEMAS = {
    type_: names.split()
    for type_, names in (
        line.split(":") for line in (Path(__file__).parent / "schema_attributes.txt").read_text("ascii").splitlines()
    )
}
"""Names of the attributes that each type of component has in the schemas of REXS 1.0 to 2.0."""
NOT_IN_FILES = {
    "detail": "a choice of the answer",
    "states": "a choice of the calculation",
    "model.*": "a choice of the calculation",
    "effects.*": "a choice of the calculation",
    "couplings.*": "the standard has no teeth of couplings",
    "grooves.*": "unknown to the standard",
    "thrust_collar.*": "unknown to the standard",
    "ambient.*": "the air in the casing is unknown to the standard",
    "modifications.*lead_curve.*": "topographies are not mapped",
    "gears.apex_runout_um": "runout of the apex is unknown to the standard",
    "gears.module_plane": "modules of the request are normal ones",
    "gears.*.tip_diameter_mm": "tip diameters of files become addendum coefficients, as their limits do",
    "*.power_kw": "the torque is given",
    "cooling.*": "the standard has no oil flow to gears and no measured teeth; its casings are those of plastic gears",
    "micropitting.*": "no version of the standard has a test of micropitting",
    "modifications.*_plane_deviation_um": "the positions of shafts in files are nominal",
    "lubricant.iso_vg": "the viscosities are given",
    "lubricant.name": "the viscosities are given",
    "lubricant.viscosity_*": "the viscosities are given",
    "lubricant.reference_temperature_c": "belongs to the viscosity at one temperature",
    "lubricant.density_kg_per_m3": "belongs to the viscosity at one temperature",
    "lubricant.temperature_viscosity_per_k": "follows from the viscosities",
    "lubricant.pressure_viscosity_law": "a choice of the calculation",
    "lubricant.compressible": "a choice of the calculation",
    "temperatures.bulk_method": "follows from the bulk temperature",
    "temperatures.local_bulk": "a choice of the calculation",
    "temperatures.scuffing_test.*": "files give the temperature itself",
    "friction_factor": "how uncertain the law of friction is",
    "standard.*": "the dynamic factor of a file belongs to the load; other factors in files are results of programs",
    "thermal.wall_response*": "unknown to the standard",
    "thermal.bulk_includes_pumping": "unknown to the standard",
    "lubricant.pressure_viscosity_38_per_gpa": "the coefficient at the bulk temperature is given",
    "*.bearings.*.film_temperature_c": "follows from the feed temperature",
    "*.bearings.*.viscosity_pa_s": "follows from the oil and the feed temperature",
    "*.thrust_bearing.*": "unknown to the standard",
    "*.gear_body.*": "files give the material and the teeth of a gear",
}
"""Patterns of the fields of a request that no file gives, each with the reason."""


def full_unit() -> Unit:
    """Return a unit that states every value that a request can take from a file."""
    unit = gear_set()
    for type_, name, value, size, *_ in MEANINGS:
        for each in unit.components:
            if each["type"] == type_:
                each["attributes"].setdefault(name, (value, size))
    for each in unit.components:
        if each["type"] == "cylindrical_gear_flank":
            for kind, attributes in {
                "tip_relief": {"tip_relief_depth": (20.0, "mum"), "tip_relief_datum_length": (4.0, "mm")},
                "root_relief": {"root_relief_depth": (20.0, "mum"), "root_relief_datum_length": (4.0, "mm")},
                "helix_slope": {"helix_slope": (20.0, "mum")},
                "helix_crowning": {"helix_crowning_amount_datum_face": (20.0, "mum")},
                "profile_crowning": {"profile_crowning_at_tip": (20.0, "mum")},
                "profile_slope": {"profile_slope": (10.0, "mum")},
                "end_relief_datum_face": {
                    "end_relief_depth_datum_face": (20.0, "mum"),
                    "end_relief_length_datum_face": (20.0, "mm"),
                },
            }.items():
                added = unit.add(kind, **attributes)
                unit.components[added - 1]["attributes"].setdefault("shape_of_relief", ("linear", "none"))
                unit.relate("reference", origin=each["id"], referenced=added)
    bearings = [each for each in unit.components if each["type"] == "hydrodynamic_radial_plain_bearing"]
    for bearing in (bearings[0], bearings[2]):  # one of each shaft
        bearing["type"] = "concept_bearing"
        bearing["attributes"]["radial_stiffness"] = (1e9, "N / m")
    return unit


def paths_of(request: Any, path: str = "") -> set[str]:
    if isinstance(request, dict):
        return {each for name, inner in request.items() for each in paths_of(inner, f"{path}.{name}".strip("."))}
    if isinstance(request, list) and request and isinstance(request[0], dict):
        return {each for inner in request for each in paths_of(inner, f"{path}.*")}
    return {path}


@pytest.mark.parametrize("endpoint", [LOAD, SCUFFING, PUMPING, TRAIN])
def test_every_field_of_a_request_is_reached_or_listed_with_its_reason(endpoint: str) -> None:
    helices = double_helical()
    held(helices, 1)
    helices.of(first(helices, "external_load"))["force_u_direction"] = (5.0, "kN")
    modified(helices, UPPER, "helix_slope", helix_slope=(20.0, "mum"))
    modified(helices, UPPER, "helix_crowning", helix_crowning_amount_datum_face=(4.0, "mum"))
    reached = {path for unit in (full_unit(), helices) for path in paths_of(stage_of(unit)["requests"][endpoint])}
    known = {leaf.path for leaf in leaves(BY_PATH[endpoint].request)}
    assert reached <= known
    listed = {path for path in known if any(fnmatch(path, pattern) for pattern in NOT_IN_FILES)}
    assert known - reached == listed


def placed(unit: Unit, type_: str) -> int:
    """Return the id of a component of the given type.

    If the unit has no such component, make one in the place where the reader looks for it.
    """
    present = [each["id"] for each in unit.components if each["type"] == type_]
    if present:
        return int(present[0])
    if type_ in {"concept_bearing", "flank_geometry"}:
        other = {"concept_bearing": "hydrodynamic_radial_plain_bearing", "flank_geometry": "cylindrical_gear_flank"}[
            type_
        ]
        found = next(each for each in unit.components if each["type"] == other)
        found["type"] = type_
        return int(found["id"])
    if type_ == "stage_gear_data":
        return placed(unit, "cylindrical_stage_gear_data")
    added = unit.add(type_)
    flank = [each["id"] for each in unit.components if each["type"] == "cylindrical_gear_flank"][1]
    unit.relate("reference", origin=flank, referenced=added)
    return added


@pytest.mark.parametrize("type_", SCHEMAS)
def test_no_attribute_of_the_standard_is_dropped_silently(type_: str) -> None:
    """Every attribute of the standard is either used or listed with the reason why it is not used."""
    # The reason for unknown names does not occur.
    unit = gear_set()
    component = placed(unit, type_)
    for name in SCHEMAS[type_]:
        unit.of(component).setdefault(name, (1.0, "none"))
    document = read(unit.xml(), MOST_BYTES)
    listed = {
        each["attribute"]: each["reason"]
        for each in gear_unit(document.model)["stages"][0]["ignored"]
        if each["component"] == component
    }
    assert len(listed) < len(SCHEMAS[type_])
    assert [name for name, reason in listed.items() if reason == "the models have no such input"] == []


def test_a_name_that_no_standard_has_is_listed() -> None:
    unit = gear_set(cylindrical_stage={"colour_of_paint": (1.0, "none")})
    (unused,) = [each for each in stage_of(unit)["ignored"] if each["attribute"] == "colour_of_paint"]
    assert unused["reason"] == "the models have no such input"


def test_prefixes_of_units_are_powers_of_ten() -> None:
    """The units of a quantity that differ by a prefix alone differ by the power of ten that the prefix means."""
    prefixes = {"k": 1e3, "M": 1e6, "G": 1e9, "mu": 1e-6, "µ": 1e-6}
    pairs = [
        (group[prefix + unit], factor * size)
        for group in UNITS
        for unit, size in group.items()
        for prefix, factor in prefixes.items()
        if unit and "^" not in unit and prefix + unit in group
    ]
    assert len(pairs) >= 7
    assert all(found == pytest.approx(wanted, rel=1e-12) for found, wanted in pairs)
