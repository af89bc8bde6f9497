"""Requests may contain what an engineer has at hand: an oil grade or a data sheet, an FZG stage, load factors.

Unusual values cause warnings, and inputs that exclude each other are refused.
"""

from dataclasses import replace
from math import cos, pi, radians
from typing import Any, NoReturn

import pytest

from app.calculations import BY_PATH
from app.errors import Unprocessable
from app.evaluate import answer, evaluate
from app.examples import STARTER, examples
from solvers.errors import NoSolution
from solvers.oils import iso_vg
from tests.support.gear_pairs import FZG_TORQUES
from tests.support.requests import CONTACT, COUPLING, GONE, MIST, PAIR, example, refused, solved

LOADS = PAIR | {"model": {}}
HOT_TEETH = {"temperatures.bulk_method": "given", "temperatures.bulk_c": 95, "friction_coefficient": 0.04}
BODIES = {
    "/v1/coupling": COUPLING,
    "/v1/pumping": MIST,
    "/v1/scuffing": PAIR,
    "/v1/scuffing/load-distribution": LOADS,
    "/v1/scuffing/line-contact": CONTACT,
    "/v1/drive-train": example("starter-turbo-gear-drive-train", HOT_TEETH),
}


def fzg(stage: int) -> dict[str, Any]:
    """Return a request for FZG gears of type A, loaded as in a stage; the oil is one that fails at this stage."""
    pinion = {"teeth": 16, "profile_shift": 0.8532, "addendum": (88.8 / 2 - 36) / 4.5 - 0.8532}
    wheel = {"teeth": 24, "profile_shift": -0.5, "addendum": (112.5 / 2 - 54) / 4.5 + 0.5}
    return {
        "gears": {
            "pinion": pinion,
            "wheel": wheel,
            "module_mm": 4.5,
            "face_width_mm": 20,
            "centre_distance_mm": 91.5,
        },
        "load": {"pinion_torque_n_m": FZG_TORQUES[stage - 1], "pinion_speed_rpm": 2165},
        "materials": {"pinion": {"roughness_um": 0.35}, "wheel": {"roughness_um": 0.35}},
        "lubricant": {"viscosity_pa_s": 0.015, "reference_temperature_c": 90},
        "temperatures": {
            "oil_c": 90,
            "bulk_method": "estimated",
            "oil_supply": "dip",
            "scuffing_test": {"fzg_stage": stage},
        },
        "model": {"lubrication": "closed_form", "friction": "iso_tr_13989"},
    }


@pytest.mark.parametrize(
    ("stage", "margin", "safety", "friction", "bulk", "flash"),
    [
        (6, 0.18, 0.91, 0.052, 103.5, 53.9),
        (8, 0.15, 1.00, 0.058, 113.1, 92.6),
        (10, 0.15, 1.06, 0.064, 125.2, 141.0),
        (12, 0.15, 1.10, 0.068, 139.6, 198.7),
    ],
)
def test_fzg_type_a_at_its_own_failing_stage_stands_at_the_limit(
    stage: int, margin: float, safety: float, friction: float, bulk: float, flash: float
) -> None:
    """The FZG test defines a safety factor of 1 at the failing stage."""
    # The other expected numbers follow from the rules of the standard.
    result = solved("/v1/scuffing", fzg(stage), {})
    assert result["safety"]["blok_factor"] == pytest.approx(1.0, abs=margin)
    assert result["safety"]["blok_factor"] == pytest.approx(safety, rel=0.07)
    assert result["flash"]["friction_coefficient"] == pytest.approx(friction, rel=0.07)
    assert result["contact_temperature"]["bulk_c"] == pytest.approx(bulk, rel=0.07)
    assert result["flash"]["blok_max_k"] == pytest.approx(flash, rel=0.07)
    assert result["safety"]["verdict"] == ("moderate" if result["safety"]["blok_factor"] >= 1.0 else "high")


def test_oil_by_its_grade_is_what_it_is_at_the_bulk_temperature() -> None:
    derived = solved("/v1/scuffing", PAIR, {"lubricant": {"iso_vg": 220}, "temperatures.bulk_c": 86.85})["derived"]
    assert derived["reference_temperature_c"] == pytest.approx(86.85)
    assert derived["viscosity_pa_s"] == pytest.approx(0.0237, rel=5e-3)
    assert derived["pressure_viscosity_per_gpa"] == pytest.approx(15.76, rel=1e-3)


def test_grade_and_its_two_viscosities_are_one_oil() -> None:
    sheet = {"kinematic_viscosity_40_mm2_per_s": 220, "kinematic_viscosity_100_mm2_per_s": 19.0}
    graded = solved("/v1/scuffing", PAIR, {"lubricant": {"iso_vg": 220}})
    measured = solved("/v1/scuffing", PAIR, {"lubricant": sheet})
    for name in ("viscosity_pa_s", "pressure_viscosity_per_gpa", "temperature_viscosity_per_k", "density_kg_per_m3"):
        assert graded["derived"][name] == pytest.approx(measured["derived"][name], rel=1e-12)


def test_oil_of_the_same_pair_by_grade_has_half_the_paper_s_film() -> None:
    by_paper, by_grade = (
        solved("/v1/scuffing", PAIR, {"lubricant": oil, "temperatures.bulk_c": 86.85})["film"]
        for oil in ({"viscosity_pa_s": 0.08}, {"iso_vg": 220})
    )
    assert 0.3 < by_grade["dowson_higginson_min_um"] / by_paper["dowson_higginson_min_um"] < 0.5


def used(endpoint: str, body: dict[str, Any], oil: dict[str, Any], path: str = "lubricant") -> dict[str, Any]:
    """Solve a request with this oil at `path`, and return the values that the answer derives for the oil."""
    derived: dict[str, Any] = solved(endpoint, body, {path: oil})["derived"]
    for name in path.split("."):
        derived = derived[int(name)] if isinstance(derived, list) else derived.get(name, derived)
    return derived


TURBO = BODIES["/v1/drive-train"]
USES = [
    ("/v1/coupling", COUPLING, "lubricant"),
    ("/v1/scuffing", PAIR, "lubricant"),
    ("/v1/scuffing/line-contact", CONTACT, "lubricant"),
    ("/v1/drive-train", TURBO, "lubricant"),
    ("/v1/drive-train", TURBO, "couplings.0.lubricant"),
]


@pytest.mark.parametrize(("endpoint", "body", "path"), USES)
def test_an_oil_by_its_index_is_the_oil_of_both_viscosities_and_says_so(
    endpoint: str, body: dict[str, Any], path: str
) -> None:
    thick = {"kinematic_viscosity_40_mm2_per_s": 220}
    graded = used(endpoint, body, {"iso_vg": 220, "kind": "polyglycol"}, path)
    by_index = used(endpoint, body, {**thick, "viscosity_index": 210, "kind": "polyglycol"}, path)
    by_kind = used(endpoint, body, {**thick, "kind": "polyglycol"}, path)
    thin = {"kinematic_viscosity_100_mm2_per_s": iso_vg(220, "polyglycol").kinematic_viscosity_100 * 1e6}
    by_both = used(endpoint, body, {**thick, **thin, "kind": "polyglycol"}, path)
    assert graded["viscosity_index"] == pytest.approx(210, abs=1e-6)
    assert graded["viscosity_pa_s"] == by_index["viscosity_pa_s"] == by_kind["viscosity_pa_s"]
    assert by_both["viscosity_pa_s"] == pytest.approx(graded["viscosity_pa_s"], rel=1e-9)
    assert by_both["viscosity_index"] == pytest.approx(210, abs=1e-6)
    mineral = used(endpoint, body, {"iso_vg": 220}, path)
    assert mineral["viscosity_index"] == pytest.approx(96.9, abs=0.05)
    assert used(endpoint, body, {"viscosity_pa_s": 0.02}, path)["viscosity_index"] is None


def test_an_index_leaves_nothing_to_assume_of_the_oil_at_100_degrees() -> None:
    thin = "lubricant.kinematic_viscosity_100_mm2_per_s"
    for index in (160, None):
        oil = {"kinematic_viscosity_40_mm2_per_s": 100, "viscosity_index": index}
        told = {each["field"]: each for each in solved("/v1/coupling", COUPLING, {"lubricant": oil})["assumptions"]}
        assert (thin in told) == (index is None)
    assert told[thin]["value"] == pytest.approx(11.07, abs=0.01)
    assert "94 to 102" in told[thin]["reason"]


def test_line_contact_takes_the_oil_at_its_inlet() -> None:
    oil = {"lubricant.iso_vg": 150, "temperatures.inlet_c": 70}
    derived = solved("/v1/scuffing/line-contact", CONTACT, oil)["derived"]
    assert derived["reference_temperature_c"] == pytest.approx(70.0)
    assert derived["pressure_viscosity_per_gpa"] == pytest.approx(16.4, abs=0.05)


def test_coupling_takes_the_oil_at_the_teeth_and_the_shafts_offset() -> None:
    by_sheet = solved("/v1/coupling", COUPLING, {"lubricant": {"iso_vg": 46, "temperature_c": 40}})
    by_viscosity = solved("/v1/coupling", COUPLING, {"lubricant.viscosity_pa_s": 46e-6 * 880 * (1 - 0.00065 * 25)})
    capacities = [result["lubrication"]["hydrodynamic_capacity_n"] for result in (by_sheet, by_viscosity)]
    assert capacities[0] == pytest.approx(capacities[1], rel=1e-12)
    tilted = solved("/v1/coupling", COUPLING, {"operation.misalignment_deg": None, "operation.parallel_offset_mm": 0.2})
    sliding = 1910 * pi / 30 * 0.078 * 1e-3
    assert tilted["kinematics"]["max_sliding_velocity_m_per_s"] == pytest.approx(sliding, rel=1e-6)


def test_thrust_that_a_bearing_must_hold() -> None:
    thrust = solved("/v1/coupling", COUPLING, {"operation.shaft_diameter_mm": 100})["axial_thrust"]
    assert thrust["design_force_n"] == max(abs(thrust["force_n"]), thrust["breakaway_force_n"])
    assert thrust["customary_force_n"] == pytest.approx(0.25 * 3000 / 0.1)


def test_load_factors_raise_the_contacts_not_the_power() -> None:
    factors = {"load.application_factor": 1.25, "load.dynamic_factor": 1.1, "load.mesh_load_factor": 1.05}
    plain, raised = (solved("/v1/scuffing/load-distribution", LOADS, changes) for changes in ({}, factors))
    assert raised["load"]["contact_factor"] == pytest.approx(1.44375)
    assert raised["load"]["normal_force_n"] == pytest.approx(1.44375 * plain["load"]["normal_force_n"], rel=1e-12)
    assert raised["load"]["pinion_torque_n_m"] == plain["load"]["pinion_torque_n_m"]
    assert raised["friction_loss"]["power_w"] == pytest.approx(plain["friction_loss"]["power_w"], rel=0.02)


def test_efficiency_is_what_friction_leaves() -> None:
    loss = solved("/v1/scuffing", PAIR, {"friction_coefficient": 0.06})["friction_loss"]
    assert loss["efficiency"] == pytest.approx(1.0 - loss["power_w"] / 50e3, rel=1e-12)


def test_defaults_of_oil_temperature_and_friction_are_assumptions() -> None:
    def assumed(oil: dict[str, float]) -> set[str]:
        return {item["field"] for item in solved("/v1/scuffing", PAIR, {"lubricant": oil})["assumptions"]}

    temperatures = {f"temperatures.{name}" for name in ("bulk_method", "oil_supply", "oil_c")}
    assert temperatures | {"lubricant.density_15_kg_per_m3", "model.friction"} <= assumed({"iso_vg": 220})
    names = ("reference_temperature_c", "pressure_viscosity_per_gpa", "kind")
    assert {f"lubricant.{name}" for name in names} <= assumed({"viscosity_pa_s": 0.02})
    loads = solved("/v1/scuffing/load-distribution", LOADS, {})["assumptions"]
    assert {item["field"]: item["value"] for item in loads}["friction_coefficient"] == 0.06


def test_from_a_data_sheet_to_a_safety_factor_in_one_request() -> None:
    temperatures = {"oil_c": 70, "bulk_method": "estimated", "scuffing_test": {"fzg_stage": 10}}
    oil = {"iso_vg": 150, "kind": "pao"}
    changes = {"lubricant": oil, "temperatures": temperatures, "model.friction": "iso_tr_13989"}
    result = solved("/v1/scuffing", PAIR, changes)
    assert result["safety"]["blok_factor"] > 1.0
    assert all(item["value"] is not None for item in result["assumptions"])


@pytest.mark.parametrize(
    ("endpoint", "changes", "message"),
    [
        (
            "/v1/scuffing",
            {"lubricant": {"iso_vg": 220, "reference_temperature_c": 60}},
            "reference_temperature_c and iso_vg are both given; keep one",
        ),
        (
            "/v1/scuffing",
            {"lubricant": {"iso_vg": 220, "viscosity_pa_s": 0.1}},
            "iso_vg and viscosity_pa_s are both given; keep one",
        ),
        (
            "/v1/scuffing",
            {"temperatures": {"bulk_method": "estimated", "bulk_c": 90}},
            (
                "bulk_c gives the bulk temperature, but bulk_method selects an estimated bulk temperature; "
                "leave out one of the two"
            ),
        ),
        (
            "/v1/scuffing",
            {"temperatures": {"scuffing_c": 200, "scuffing_test": {"fzg_stage": 12}}},
            "scuffing_c and scuffing_test are both given; keep one",
        ),
        (
            "/v1/coupling",
            {"lubricant.iso_vg": 47},
            "iso_vg: must be one of 10, 15, 22, 32, 46, 68, 100, 150, 220, 320, 460, 680, 1000, 1500",
        ),
        (
            "/v1/coupling",
            {"operation.parallel_offset_mm": 0.2},
            "misalignment_deg and parallel_offset_mm are both given; keep one",
        ),
        (
            "/v1/scuffing",
            {"temperatures.scuffing_test": {"fzg_stage": 12, "test": "A10/16.6R/90"}},
            (
                "test: must be one of A/8.3/90; load stages of faster or hotter tests, such as A/16.6/90, mean other "
                "temperatures; enter the stage of A/8.3/90, or the scuffing temperature itself"
            ),
        ),
        (
            "/v1/scuffing",
            {"temperatures.oil_c": "0.05-0.1"},
            'give a number, not the range "0.05-0.1"; for a range enter two values: 0.05 and 0.1',
        ),
    ],
)
def test_what_excludes_what(endpoint: str, changes: dict[str, Any], message: str) -> None:
    assert refused(endpoint, BODIES[endpoint], changes) == message


SCUFFING, LOAD_DISTRIBUTION, TRAIN = "/v1/scuffing", "/v1/scuffing/load-distribution", "/v1/drive-train"
THICK = (
    "a viscosity of {} Pa s at operating temperature is unusually high; was a value entered in the wrong unit (mPa s)?"
)
VACUUM = "an ambient pressure of 1.01 kPa is nearly a vacuum; was a value entered in the wrong unit (bar)?"
EXCHANGED = "°C; were the two temperatures exchanged?"
GROUND = "a modification of {} µm is too small to be ground; was a value entered in the wrong unit (mm)?"
NARROW = "the face width of {} mm is less than half a module; was a value entered in the wrong unit (cm or inches)?"
RELIEF = (
    "the relief is {} mm long, but the path of contact is only {} mm long; was a radius entered instead of a length?"
)
DIAMETER = "the tooth height of 13 mm exceeds 4 modules; was a diameter entered instead of a height?"
FAST = "the pitch-line velocity of {} m/s exceeds 250 m/s; was the speed of another shaft entered?"
FAHRENHEIT = "a temperature of {} °C is unusually high for gears in service; was a value entered in degrees Fahrenheit?"
COLD = "a temperature of {} °C is unusually low for an oil in service; is the sign right?"
WARM = {"iso_vg": 220}
SLACK = (
    "the largest line load is only {} N/mm, which is implausible; was a value entered in the wrong unit (kW or kN m)?"
)


@pytest.mark.parametrize(
    ("endpoint", "changes", "message"),
    [
        (SCUFFING, {"lubricant.viscosity_pa_s": 25}, THICK.format(25)),
        (TRAIN, {"lubricant.viscosity_pa_s": 9.5}, THICK.format(9.5)),
        (TRAIN, {"pinion_shaft.bearings.0.viscosity_pa_s": 14}, THICK.format(14)),
        (TRAIN, {"wheel_shaft.bearings.1.viscosity_pa_s": 18}, THICK.format(18)),
        (TRAIN, {"couplings.0.lubricant.viscosity_pa_s": 25}, THICK.format(25)),
        ("/v1/pumping", {"ambient.pressure_kpa": 1.01}, VACUUM),
        (TRAIN, {"ambient.pressure_kpa": 1.01}, VACUUM),
        (LOAD_DISTRIBUTION, {"modifications.tip_relief_um": 0.03}, GROUND.format(0.03)),
        (TRAIN, {"modifications.helix_slope_um": 0.05}, GROUND.format(0.05)),
        (LOAD_DISTRIBUTION, {"gears.face_width_mm": 1.2}, NARROW.format(1.2)),
        (TRAIN, {"model.slices": 10, "gears.face_width_mm": 2}, NARROW.format(2)),
        (
            LOAD_DISTRIBUTION,
            {"gears.face_width_mm": 250},
            (
                "the face width of 250 mm exceeds 3 pitch diameters of the pinion; "
                "was a value entered in the wrong unit (cm)?"
            ),
        ),
        (
            LOAD_DISTRIBUTION,
            {"load.power_kw": 900},
            "the Hertzian pressure of 5917 MPa exceeds the strength of steel; is the load correct?",
        ),
        (
            TRAIN,
            {"operation.power_kw": 120e3},
            (
                "a tooth force of 799.8 N per mm of face width and per mm of module breaks a steel tooth; "
                "was a value entered in the wrong unit (W or N mm)?"
            ),
        ),
        (LOAD_DISTRIBUTION, {"load.power_kw": 0.05}, SLACK.format(0.367)),
        (TRAIN, {"operation.power_kw": 0.01}, SLACK.format(0.606)),
        ("/v1/coupling", {"coupling.tooth_height_mm": 13}, DIAMETER),
        (TRAIN, {"couplings.0.coupling.tooth_height_mm": 13}, DIAMETER),
        (
            SCUFFING,
            {"lubricant": {"iso_vg": 220}, "temperatures.bulk_c": 86.85, "temperatures.oil_c": 95},
            f"the oil at 95 °C is hotter than the teeth at 86.85 {EXCHANGED}",
        ),
        (TRAIN, {"temperatures.oil_c": 120}, f"the oil at 120 °C is hotter than the teeth at 95 {EXCHANGED}"),
        (SCUFFING, {"lubricant": {"iso_vg": 220}, "temperatures.oil_c": 180}, FAHRENHEIT.format(180)),
        (SCUFFING, {"lubricant": {"iso_vg": 220}, "temperatures.bulk_c": 250}, FAHRENHEIT.format(250)),
        (SCUFFING, {"lubricant": {"iso_vg": 32}, "temperatures.oil_c": -31}, COLD.format(-31)),
        (TRAIN, {"temperatures.oil_c": 140}, FAHRENHEIT.format(140)),
        (TRAIN, {"temperatures.bulk_c": 140}, FAHRENHEIT.format(140)),
        (TRAIN, {"thermal.pinion_bulk_c": 200}, FAHRENHEIT.format(200)),
        (TRAIN, {"temperatures.oil_c": -31}, COLD.format(-31)),
        (
            TRAIN,
            {"couplings.0.lubricant": dict(WARM), "couplings.0.lubricant.temperature_c": 140},
            FAHRENHEIT.format(140),
        ),
        ("/v1/coupling", {"lubricant": dict(WARM), "lubricant.temperature_c": 140}, FAHRENHEIT.format(140)),
        ("/v1/scuffing/line-contact", {"lubricant": dict(WARM), "temperatures.inlet_c": 140}, FAHRENHEIT.format(140)),
        (LOAD_DISTRIBUTION, {"load.pinion_speed_rpm": 100000}, FAST.format(366.6)),
        (TRAIN, {"operation.pinion_speed_rpm": 25000}, FAST.format(312.6)),
        (
            LOAD_DISTRIBUTION,
            {"modifications.tip_relief_um": 20, "modifications.tip_relief_length_mm": 30},
            RELIEF.format(30, 14.28),
        ),
        (
            TRAIN,
            {"modifications.tip_relief_length_mm": 60},
            RELIEF.format(60, 31.36),
        ),
    ],
)
def test_unusual_values_are_named(endpoint: str, changes: dict[str, Any], message: str) -> None:
    """The warning names the field that stands last in `changes`."""
    result = solved(endpoint, BODIES[endpoint], changes)
    assert result["status"] == "ok_with_warnings"
    field = list(changes)[-1]
    assert {"rank": "doubtful", "code": "unusual_value", "message": message, "field": field} in result["warnings"]


HELICAL = {"gears.helix_angle_deg": 15, "gears.wheel.profile_shift": -0.1, "gears.wheel.addendum": 0.95}


@pytest.mark.parametrize("plane", ["normal", "transverse"])
@pytest.mark.parametrize("endpoint", [LOAD_DISTRIBUTION, "/v1/pumping"])
def test_a_tip_diameter_is_the_addendum_of_the_drawing(endpoint: str, plane: str) -> None:
    """The geometry is the same if the tip diameter is given instead of the addendum."""
    # The tip and root diameters of the wheel follow from addendum, dedendum and profile shift, as on a drawing.
    body, plain = BODIES[endpoint], {**HELICAL, "gears.module_plane": plane}
    by_addendum = solved(endpoint, body, plain)
    tip = by_addendum["geometry"]["wheel_tip_diameter_mm"]
    given = {"gears.wheel.addendum": GONE, "gears.wheel.tip_diameter_mm": tip}
    by_diameter = solved(endpoint, body, plain | given)
    gears = by_addendum["inputs"]["gears"]
    normal = gears["module_mm"] * (cos(radians(15)) if plane == "transverse" else 1.0)
    reference = gears["wheel"]["teeth"] * normal / cos(radians(15))
    assert tip == pytest.approx(reference + 2 * normal * (0.95 - 0.1), rel=1e-12)
    root = reference - 2 * normal * (gears["wheel"]["dedendum"] + 0.1)
    assert by_addendum["geometry"]["wheel_root_diameter_mm"] == pytest.approx(root, rel=1e-12)
    for name, value in by_addendum["geometry"].items():
        assert by_diameter["geometry"][name] == pytest.approx(value, rel=1e-9)
    assert by_diameter["inputs"]["gears"]["wheel"]["addendum"] is None
    again = solved(endpoint, {**by_diameter["inputs"], "detail": "curves"}, {})
    assert again["geometry"] == by_diameter["geometry"]


def test_one_of_tip_diameter_and_addendum_is_given() -> None:
    both = {"gears.wheel.tip_diameter_mm": 95, "gears.wheel.addendum": 1.0}
    assert refused(LOAD_DISTRIBUTION, LOADS, both) == "addendum and tip_diameter_mm are both given; keep one"
    neither = {"gears.wheel.addendum": None}
    assert refused(LOAD_DISTRIBUTION, LOADS, neither) == "give addendum or tip_diameter_mm"
    with pytest.raises(Unprocessable, match="corresponds to an addendum coefficient of") as refusal:
        solved(LOAD_DISTRIBUTION, LOADS, {"gears.wheel.tip_diameter_mm": 300})
    assert (refusal.value.code, refusal.value.path) == ("tip_diameter", "gears.wheel.tip_diameter_mm")


@pytest.mark.parametrize("endpoint", sorted(BY_PATH))
def test_every_endpoint_has_a_starter_and_starters_come_first(endpoint: str) -> None:
    names = [example.name for example in examples().values() if example.endpoint == endpoint]
    starts = [name.startswith(STARTER) for name in names]
    assert starts[0]
    assert starts == sorted(starts, reverse=True)


@pytest.mark.parametrize("flow", ["gas_dynamics", "pocket_chain"])
def test_stagnation_temperature_of_the_axial_speed_only_is_an_assumption(flow: str) -> None:
    assumptions = solved("/v1/pumping", MIST, {"model": {"flow": flow}})["assumptions"]
    assert [item["value"] for item in assumptions if "only the axial speed" in item["reason"]] == [flow]


@pytest.mark.parametrize(
    ("example", "ranked"),
    [
        ("starter-coupling-at-its-limits", [("invalid", "edge_contact"), ("doubtful", "sliding_velocity")]),
        (
            "starter-turbo-gear-drive-train",
            [
                ("doubtful", "thrust_reversal"),
                ("doubtful", "net_flow_uncertain"),
                ("note", "gas_grows_freely"),
                ("note", "no_standard_flash"),
            ],
        ),
        (
            "milian-table-1-incompressible",
            [("note", each) for each in ("spur_gear", "no_temperature", "no_lead_correction")],
        ),
    ],
)
def test_warnings_stand_in_the_order_of_their_rank(example: str, ranked: list[tuple[str, str]]) -> None:
    chosen = examples()[example]
    found = answer(chosen.endpoint, {**chosen.request, "detail": "summary"})
    assert [(each["rank"], each["code"]) for each in found["warnings"]] == ranked


def test_what_has_no_solution_is_invalid() -> None:
    calculation = BY_PATH["/v1/scuffing/load-distribution"]
    request = calculation.request.model_validate(LOADS)

    def unsolved(_: object) -> NoReturn:
        raise NoSolution("load_balance", "the load balance does not converge", {"force": 0.1})

    found = evaluate(replace(calculation, solve=unsolved), request)
    assert [(each.rank, each.code) for each in found.warnings] == [("invalid", "load_balance")]
