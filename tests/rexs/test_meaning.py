"""Values of a file that were read as something else, or not at all, and the load that passes through other stages."""

from typing import Any

import numpy as np
import pytest

from app.calculations import BY_PATH
from app.evaluate import solve
from app.rexs.document import read
from app.rexs.power import Train
from app.rexs.reading import Reading
from app.rexs.stages import pairs
from app.rexs.unit import gear_unit
from app.schema.fields import value_at
from solvers.drive_train.inputs import FILM_ABOVE_OIL, JournalBearing, torsion_diameter
from solvers.oils import OilSheet
from tests.rexs.test_fields import LOAD, MEANINGS, MOST_BYTES, SCUFFING, TRAIN, answer, first, gear_set, stage_of
from tests.rexs.units import Unit, three_stages, turbo_unit
from tests.support.properties import seeds

CELSIUS = 273.15


def codes(unit: Unit) -> set[str]:
    return {each["code"] for each in answer(unit)["findings"]}


def assumed(stage: dict[str, Any]) -> dict[str, Any]:
    return {each["field"]: each["value"] for each in stage["assumed"]}


def missing(stage: dict[str, Any]) -> dict[str, str]:
    return {each["field"]: each["message"] for each in stage["missing"]}


def bearings_of(request: dict[str, Any]) -> list[JournalBearing]:
    inputs = BY_PATH[TRAIN].request.model_validate(request).inputs()
    return [bearing for shaft in inputs.shafts for bearing in shaft.bearings]


def test_a_feed_temperature_is_that_of_the_entering_oil() -> None:
    """Without a heat balance the film is 15 K warmer than the oil that enters the bearing."""
    request = stage_of(turbo_unit())["requests"][TRAIN]
    request["temperatures"]["bulk_method"] = "estimated"
    oil = BY_PATH[TRAIN].request.model_validate(request).inputs().mesh.oil
    assert isinstance(oil, OilSheet)
    for bearing in bearings_of(request):
        assert bearing.feed_temperature == pytest.approx(65.0 + CELSIUS)
        assert bearing.in_gear_oil
        assert bearing.viscosity == pytest.approx(oil.viscosity(65.0 + CELSIUS + FILM_ABOVE_OIL), rel=1e-12)


def test_roughness_given_as_rz_alone_is_a_sixth() -> None:
    unit = turbo_unit()
    for each in unit.components:
        if each["type"] == "cylindrical_gear":
            del each["attributes"]["arithmetic_mean_roughness_flank_iso_4287_1997"]
            each["attributes"]["averaged_peak_to_valley_height_flank"] = (4.8, "mum")
    stage = stage_of(unit)
    assert stage["requests"][SCUFFING]["materials"]["wheel"]["roughness_um"] == pytest.approx(0.8)
    assert assumed(stage)["materials.pinion.roughness_um"] == pytest.approx(0.8)


def coupled(type_: str, **attributes: tuple[Any, str]) -> Unit:
    """Return a unit of three stages whose first shaft is driven through a connection of the given type."""
    unit = three_stages("1.4")
    shaft, unit_id = first(unit, "shaft"), first(unit, "gear_unit")
    motor = unit.add("shaft", "motor")
    unit.relate("assembly", assembly=unit_id, part=motor)
    joint = unit.add(type_, **attributes)
    unit.relate("side", assembly=joint, inner_part=motor, outer_part=shaft)
    load = first(unit, "external_load")
    for relation in unit.relations:
        if relation["roles"].get("part") == load:
            relation["roles"]["assembly"] = motor
    for name in ("rotational_speed", "defines_speed"):
        unit.of(motor)[name] = unit.of(shaft).pop(name)
    return unit


@pytest.mark.parametrize(
    ("type_", "attributes"),
    [
        ("coupling", {}),
        ("feather_key_connection", {}),
        ("involute_spline_connection", {}),
        ("tapered_interference_fit", {}),
        ("switchable_coupling", {"is_engaged": (True, "none")}),
        ("switchable_coupling", {"is_engaged": (["true"], "none")}),
    ],
)
def test_torque_passes_every_connection(type_: str, attributes: dict[str, tuple[Any, str]]) -> None:
    load = answer(coupled(type_, **attributes))["stages"][0]["requests"][LOAD]["load"]
    assert load["pinion_torque_n_m"] == pytest.approx(4.724562, rel=1e-6)
    assert load["pinion_speed_rpm"] == 1400.0


@pytest.mark.parametrize(
    ("type_", "attributes", "code"),
    [
        ("switchable_coupling", {}, "coupling_state"),
        ("switchable_coupling", {"is_engaged": (["true", "false"], "none")}, "coupling_state"),
        ("magic_coupling", {}, "connection_not_modelled"),
    ],
)
def test_a_connection_that_is_not_followed_is_named(
    type_: str, attributes: dict[str, tuple[Any, str]], code: str
) -> None:
    unit = coupled(type_, **attributes)
    assert code in codes(unit)
    for stage in answer(unit)["stages"]:
        assert "load.pinion_torque_n_m" in missing(stage)
        assert "pinion_torque_n_m" not in stage["requests"][LOAD].get("load", {})


@pytest.mark.parametrize(("gear", "engaged"), [(1, False), (2, True)])
def test_the_shift_position_says_which_couplings_are_engaged(gear: int, *, engaged: bool) -> None:
    unit = coupled("switchable_coupling", is_engaged=(["false", "true"], "none"))
    unit.of(first(unit, "gear_unit"))["gear_shift_index"] = (gear, "none")
    stage = answer(unit)["stages"][0]
    assert ("pinion_torque_n_m" in stage["requests"][LOAD].get("load", {})) is engaged


def test_a_torque_of_zero_that_the_file_does_not_state_is_found() -> None:
    assert "zero_torque" in codes(coupled("switchable_coupling", is_engaged=(False, "none")))


def test_a_viscosity_at_40_degrees_is_enough() -> None:
    unit = turbo_unit()
    del unit.of(first(unit, "lubricant"))["viscosity_at_100_degree_celsius"]
    stage = stage_of(unit)
    assert stage["requests"][SCUFFING]["lubricant"]["kinematic_viscosity_40_mm2_per_s"] == 32.0
    assert not [field for field in missing(stage) if field.startswith("lubricant")]


@pytest.mark.parametrize("name", ["data_source", "referenced_component_id"])
def test_data_in_another_file_are_found_and_missing(name: str) -> None:
    unit = gear_set()
    material = next(each["id"] for each in reversed(unit.components) if each["type"] == "material")
    unit.of(material).clear()
    unit.of(material)[name] = ("7", "none")
    assert "data_elsewhere" in codes(unit)
    assert {"materials.pinion.youngs_modulus_gpa", "materials.wheel.specific_heat_j_per_kg_k"} <= {
        *missing(stage_of(unit))
    }


def behind(type_: str) -> Unit:
    """Return a unit of three stages of which the first is of another type."""
    unit = three_stages("1.4")
    unit.components[first(unit, "cylindrical_stage") - 1]["type"] = type_
    return unit


def test_the_load_is_followed_through_a_bevel_stage() -> None:
    straight, bevel = answer(three_stages("1.4"))["stages"][1:], answer(behind("bevel_stage"))
    assert "stage_not_modelled" in {each["code"] for each in bevel["findings"]}
    for stage, expected in zip(bevel["stages"], straight, strict=True):
        assert stage["requests"][LOAD]["load"] == expected["requests"][LOAD]["load"]
        reasons = {each["field"]: each["reason"] for each in stage["assumed"]}
        assert "losses are neglected" in reasons["load.pinion_torque_n_m"]


def test_the_sense_behind_a_bevel_stage_follows_from_the_places_of_its_gears() -> None:
    """A bevel gear on the other side of the apex turns its shaft the other way."""
    senses = []
    for place in (40.0, -40.0):
        unit = behind("bevel_stage")
        shafts = [each for each in unit.components if each["type"] == "shaft"]
        for number, shaft in enumerate(shafts):
            axis = [1.0, 0.0, 0.0] if number == 0 else [0.0, 1.0, 0.0]
            shaft["attributes"]["u_axis_vector"] = (axis, "mm")
            shaft["attributes"]["support_vector"] = ([0.0, 0.0, 57.0 * max(number - 1, 0)], "mm")
        gears = [each for each in unit.components if each["type"] == "cylindrical_gear"]
        gears[0]["attributes"]["u_coordinate_on_shaft"] = (30.0, "mm")
        gears[1]["attributes"]["u_coordinate_on_shaft"] = (place, "mm")
        found = answer(unit)
        reason = next(
            each["reason"] for each in found["stages"][0]["assumed"] if each["field"] == "load.pinion_speed_rpm"
        )
        assert "sense of rotation is assumed" not in reason

        reading = Reading(read(unit.xml(), MOST_BYTES).model)
        flow = Train(reading, list(pairs(reading))).flow()
        senses.append(flow.speed[shafts[1]["id"]])
    assert senses[0] == pytest.approx(-1400.0 * 23 / 67)
    assert senses[1] == -senses[0]


def test_behind_a_stage_that_is_not_modelled_this_is_the_reason() -> None:
    for stage in answer(behind("worm_stage"))["stages"]:
        assert "determined through a stage that is not modelled" in missing(stage)["load.pinion_torque_n_m"]


def planetary(*, held: bool) -> Unit:
    """Return a unit of three stages whose first shaft is the carrier of a planetary stage, with a driven sun."""
    unit = three_stages("1.4")
    carrier, load = first(unit, "shaft"), first(unit, "external_load")
    sun, ring_shaft = unit.add("shaft", "sun"), unit.add("shaft", "ring")
    stage, mesh, other = unit.add("planetary_stage"), unit.add("cylindrical_stage"), unit.add("cylindrical_stage")
    gears = [unit.add(kind, number_of_teeth=(teeth, "none")) for kind, teeth in
             (("cylindrical_gear", 20), ("cylindrical_gear", 25), ("ring_gear", -70))]  # fmt: skip
    pin = unit.add("shaft", "planet")
    for shaft, gear in ((sun, gears[0]), (pin, gears[1]), (ring_shaft, gears[2])):
        unit.relate("assembly", assembly=shaft, part=gear)
    unit.relate("stage", stage=mesh, gear_1=gears[0], gear_2=gears[1])
    unit.relate("stage", stage=other, gear_1=gears[1], gear_2=gears[2])
    for part in (mesh, other):
        unit.relate("assembly", assembly=stage, part=part)
    for shaft in (sun, ring_shaft):
        unit.relate("central_shaft", planetary_stage=stage, shaft=shaft)
    unit.relate("planet_carrier_shaft", planetary_stage=stage, shaft=carrier)
    brake = unit.add("switchable_coupling", is_engaged=([held], "none"))
    unit.relate("side", assembly=brake, inner_part=ring_shaft, outer_part=first(unit, "gear_casing"))
    for relation in unit.relations:
        if relation["roles"].get("part") == load:
            relation["roles"]["assembly"] = sun
    for name in ("rotational_speed", "defines_speed"):
        unit.of(sun)[name] = unit.of(carrier).pop(name)
    return unit


def test_behind_a_planetary_stage_with_a_held_ring() -> None:
    """Willis: the carrier turns z_s/(z_s + z_r) = 20/90 as fast as the sun, with 90/20 of its torque."""
    load = answer(planetary(held=True))["stages"][0]["requests"][LOAD]["load"]
    assert load["pinion_speed_rpm"] == pytest.approx(1400.0 * 20 / 90, rel=1e-6)
    assert load["pinion_torque_n_m"] == pytest.approx(4.724562 * 90 / 20, rel=1e-6)


def test_behind_a_planetary_stage_of_which_nothing_is_held() -> None:
    stage = answer(planetary(held=False))["stages"][0]
    assert "determined through a stage that is not modelled" in missing(stage)["load.pinion_torque_n_m"]


def test_a_pressure_viscosity_coefficient_at_38_degrees_is_converted() -> None:
    """At 90 °C the law gives 1 + 516 (1/363 - 1/311) = 0.762 of the coefficient at 38 °C."""
    name = "pressure_viscosity_coefficient_at_38_degrees_celsius"
    stage = stage_of(gear_set(lubricant={name: (19.5, "1 / GPa")}))
    assert "ISO/TR 15144-1" in next(each["reason"] for each in stage["assumed"] if "38" in each["field"])
    request = BY_PATH[SCUFFING].request.model_validate(stage["requests"][SCUFFING])
    oil = request.inputs().oil
    assert oil.pressure_coefficient(90.0 + CELSIUS) == pytest.approx(
        19.5e-9 * (1 + 516 * (1 / 363 - 1 / 311)), rel=1e-9
    )
    assert oil.pressure_coefficient(38.0 + CELSIUS) == pytest.approx(19.5e-9, rel=1e-9)


def test_a_section_under_the_teeth_has_the_diameter_that_carries_torsion() -> None:
    unit = turbo_unit()
    for each in unit.components:
        if each["type"] == "shaft_section" and each["attributes"]["length"][0] == 200.0:
            for end in ("begin", "end"):
                each["attributes"][f"outer_diameter_{end}"] = (170.0, "mm")
    request = stage_of(unit)["requests"][TRAIN]
    inputs = BY_PATH[TRAIN].request.model_validate(request).inputs()
    gears = inputs.mesh.distribution.gears
    for shaft, teeth in ((inputs.pinion_shaft, gears.pinion), (inputs.wheel_shaft, gears.wheel)):
        assert shaft.sections[1].outer_diameter == pytest.approx(torsion_diameter(gears, teeth), rel=1e-6)


def applied(request: dict[str, Any], overrides: dict[str, Any]) -> dict[str, Any]:
    for path, value in overrides.items():
        *sections, name = path.split(".")
        here: Any = request
        for section in sections:
            here = here[int(section)] if isinstance(here, list) else here.setdefault(section, {})
        here[int(name) if isinstance(here, list) else name] = value
    return request


IN_A_CASE = [row for row in MEANINGS if row[0] not in {"shaft_section", "cylindrical_gear_flank", "rack_shaped_tool"}]


@seeds(6, 200)
def test_an_attribute_of_a_load_case_acts_as_the_same_attribute_of_the_model(rng: np.random.Generator) -> None:
    """The request with the changes of the load case is the request of the file that states the value in its model."""
    type_, name, value, size, endpoint, path, _ = IN_A_CASE[rng.integers(len(IN_A_CASE))]
    of_model, of_case = gear_set(**{type_: {name: (value, size)}}), gear_set()
    of_case.cases.append({each["id"]: {name: (value, size)} for each in of_case.components if each["type"] == type_})
    expected = stage_of(of_model)["requests"][endpoint]
    stage = stage_of(of_case)
    (case,) = stage["spectra"][endpoint]
    assert value_at(applied(stage["requests"][endpoint], case["set"]), path) == value_at(expected, path)


def test_tooth_temperatures_of_a_load_case_reach_the_unit() -> None:
    unit = gear_set()
    gears = [each["id"] for each in unit.components if each["type"] == "cylindrical_gear"]
    unit.cases.append({gear: {"bulk_temperature": (80.0 + 30.0 * k, "C")} for k, gear in enumerate(gears)})
    (case,) = stage_of(unit)["spectra"][TRAIN]
    assert case["set"]["thermal.pinion_bulk_c"] == 80.0
    assert case["set"]["thermal.wheel_bulk_c"] == 110.0
    assert gear_unit(read(unit.xml(), MOST_BYTES).model)["findings"] is not None


def test_the_film_follows_from_the_feed_by_the_heat_balance() -> None:
    """The warmer oil makes the film of the heat balance warmer, but by less than the feed, and the losses smaller."""
    request = stage_of(turbo_unit())["requests"][TRAIN] | {"model": {"lubrication": "closed_form"}, "detail": "summary"}
    request["temperatures"] |= {"bulk_method": "heat_balance", "oil_supply": "spray"}
    films, losses = [], []
    for feed in (50.0, 65.0):
        for shaft in ("pinion_shaft", "wheel_shaft"):
            for bearing in request[shaft]["bearings"]:
                bearing["feed_temperature_c"] = feed
        calculation = BY_PATH[TRAIN]
        result = solve(calculation, calculation.request.model_validate(request))
        films.append([bearing.film for bearing in result.heat.bearings])
        losses.append(result.losses.bearings)
        assert result.heat.balance.error == pytest.approx(0.0, abs=1e-9)
    assert all(50.0 + CELSIUS < cold < warm < cold + 15.0 for cold, warm in zip(*films, strict=True))
    assert losses[1] < losses[0]
