"""If a request leaves out oil, bulk temperature or friction, the answer uses an estimate or has no value."""

from dataclasses import MISSING, fields
from typing import Any

import pytest

from app.calculations import BY_PATH, CALCULATIONS, Calculation
from app.errors import Unprocessable
from app.evaluate import evaluate
from app.examples import examples
from app.figures.data import NoFigure
from app.figures.units import shown
from app.models.scuffing.figures import contact_temperature, friction
from app.models.scuffing.request import ScuffingRequest
from app.pages.results import cards
from app.schema.fields import leaves
from solvers.errors import InvalidInput
from tests.support.requests import CONTACT, COUPLING, GONE, changed, refused, solved

COUPLED, SCUFFING, TRAIN = "/v1/coupling", "/v1/scuffing", "/v1/drive-train"
METHODS = "give bulk_c, or set bulk_method to estimated or heat_balance"
STAGE: dict[str, Any] = {
    "gears": {
        "pinion": {"teeth": 25},
        "wheel": {"teeth": 76},
        "module_mm": 4,
        "helix_angle_deg": 10,
        "face_width_mm": 60,
    },
    "load": {"power_kw": 75, "pinion_speed_rpm": 1500},
    "lubricant": {"iso_vg": 220},
    "temperatures": {"scuffing_test": {"fzg_stage": 12}},
    "model": {"lubrication": "closed_form"},
}
DRY = {name: section for name, section in STAGE.items() if name != "lubricant"}
TURBO = examples()["starter-turbo-gear-drive-train"].request


def codes(answer: dict[str, Any]) -> set[str]:
    return {warning["code"] for warning in answer["warnings"]}


def reasons(answer: dict[str, Any]) -> dict[str, str]:
    return {each["field"]: each["reason"] for each in answer["assumptions"]}


def test_without_an_oil_there_is_no_verdict() -> None:
    answer = solved(SCUFFING, DRY, {})
    assert "no_oil" in codes(answer)
    assert (answer["film"], answer["contact_temperature"], answer["safety"]) == (None, None, None)
    assert (answer["flash"]["blok_max_k"], answer["friction_loss"]["coefficient"]) == (None, None)
    assert (answer["friction_loss"]["power_w"], answer["friction_loss"]["efficiency"]) == (None, None)
    assert answer["friction_loss"]["loss_factor"] > 0.0
    assert answer["inputs"]["lubricant"]["viscosity_pa_s"] is None
    again = solved(SCUFFING, {**answer["inputs"], "detail": "summary"}, {})
    assert {**again, "assumptions": answer["assumptions"]} == answer


def test_flash_stays_without_an_oil_where_friction_is_given() -> None:
    dry = solved(SCUFFING, DRY, {"friction_coefficient": 0.05})
    oiled = solved(SCUFFING, STAGE, {"friction_coefficient": 0.05})
    assert dry["flash"]["blok_max_k"] == pytest.approx(oiled["flash"]["blok_max_k"], rel=1e-9)
    assert dry["friction_loss"] == oiled["friction_loss"]
    assert dry["safety"] is None


def test_figures_of_what_only_an_oil_tells_say_so() -> None:
    request = ScuffingRequest.model_validate(DRY)
    result = shown(evaluate(BY_PATH[SCUFFING], request).result)
    for figure in (contact_temperature, friction):
        with pytest.raises(NoFigure) as refusal:
            figure(request.inputs(), result)
        assert refusal.value.code == "no_oil"


def test_a_line_contact_needs_an_oil() -> None:
    with pytest.raises(Unprocessable) as refusal:
        solved("/v1/scuffing/line-contact", CONTACT, {})
    assert (refusal.value.code, refusal.value.path) == ("no_oil", "lubricant")


def test_a_bulk_temperature_says_by_itself_that_it_is_given() -> None:
    estimated = solved(SCUFFING, STAGE, {})
    assert estimated["inputs"]["temperatures"]["bulk_method"] is None
    assert estimated["derived"]["bulk_method"] == "estimated"
    assert estimated["inputs"]["temperatures"]["bulk_c"] is None
    assert {"temperatures.bulk_method", "temperatures.oil_supply"} <= set(reasons(estimated))
    given = solved(SCUFFING, STAGE, {"temperatures.bulk_c": 86.85})
    assert given["inputs"]["temperatures"]["bulk_method"] == "given"
    assert given["contact_temperature"]["bulk_c"] == pytest.approx(86.85)
    assert refused(SCUFFING, STAGE, {"temperatures.bulk_method": "given"}) == METHODS


def test_a_coefficient_of_friction_says_by_itself_that_it_is_given() -> None:
    by_oil = solved(SCUFFING, STAGE, {})
    assert by_oil["inputs"]["model"]["friction"] == "iso_tr_13989"
    assert by_oil["inputs"]["friction_coefficient"] is None
    assert "with K_Hα = 1" in reasons(by_oil)["model.friction"]
    given = solved(SCUFFING, STAGE, {"friction_coefficient": 0.06})
    assert given["inputs"]["model"]["friction"] == "given"
    assert given["friction_loss"]["coefficient"] == given["flash"]["friction_coefficient"] == 0.06
    message = "give friction_coefficient, or set model.friction to iso_tr_13989"
    assert refused(SCUFFING, STAGE, {"model.friction": "given"}) == message


def test_the_losses_have_a_friction_of_their_own() -> None:
    """The losses use a mean coefficient of friction, scuffing uses a larger coefficient."""
    # Load factors raise only the coefficient for scuffing.
    power = {"load": {"power_kw": 400, "pinion_speed_rpm": 1500}}
    plain, loaded = (solved(SCUFFING, STAGE, {**power, "load.application_factor": factor}) for factor in (1.0, 2.5))
    for answer, highest in ((plain, 0.82), (loaded, 0.7)):
        loss, flash = answer["friction_loss"], answer["flash"]
        assert 0.6 < loss["coefficient"] / flash["friction_coefficient"] < highest
        assert loss["efficiency"] == pytest.approx(1.0 - loss["coefficient"] * loss["loss_factor"], rel=1e-12)
    assert loaded["friction_loss"]["coefficient"] == plain["friction_loss"]["coefficient"]
    assert loaded["flash"]["friction_coefficient"] > plain["flash"]["friction_coefficient"]
    assert "Schlenk" in reasons(plain)["model.friction"]
    unit = solved(TRAIN, TURBO, {})
    assert unit["flash"]["friction_coefficient"] > 0.0
    given = solved(TRAIN, TURBO, {"friction_coefficient": unit["flash"]["friction_coefficient"]})
    assert given["flash"]["flank_k"] == pytest.approx(unit["flash"]["flank_k"], rel=1e-12)
    assert given["losses"]["mesh_w"] > unit["losses"]["mesh_w"]


def test_the_scuffing_temperature_is_a_property_of_oil_and_steel() -> None:
    """The scuffing temperature does not depend on the oil temperature, because X_L is taken at the 90 C of the test."""
    # With X_L at the oil temperature, the scuffing temperature rose from 329 C (oil at 40 C) to 353 C (oil at 80 C).
    limits = [solved(SCUFFING, STAGE, {"temperatures.oil_c": oil})["safety"]["scuffing_c"] for oil in (40, 60, 80)]
    assert limits == [pytest.approx(357.99, abs=0.01)] * 3


def test_a_hotter_oil_is_never_safer() -> None:
    """With an estimated bulk temperature, a hotter oil lowers the safety factor."""
    # If the bulk temperature is fixed at 86.85 C, the safety factor with oil at 80 C is about twice as large as with
    # oil at 40 C.
    oils = (40, 60, 80)
    safe = [solved(SCUFFING, STAGE, {"temperatures.oil_c": oil})["safety"]["blok_factor"] for oil in oils]
    assert safe == [pytest.approx(value, abs=0.01) for value in (14.37, 12.78, 11.45)]
    paper = {"temperatures.bulk_c": 86.85, "friction_coefficient": 0.06}
    answers = [solved(SCUFFING, STAGE, {"temperatures.oil_c": oil, **paper}) for oil in oils]
    given = [answer["safety"]["blok_factor"] for answer in answers]
    assert given == [pytest.approx(value, abs=0.01) for value in (4.41, 5.72, 8.67)]
    assert all("safety rises" in reasons(answer)["temperatures.bulk_method"] for answer in answers)


@pytest.mark.parametrize(
    ("name", "warned"), [("starter-high-speed-scuffing", True), ("starter-industrial-scuffing", False)]
)
def test_the_estimated_bulk_of_a_fast_pair_is_a_lower_bound(name: str, warned: bool) -> None:
    request = changed(
        examples()[name].request, {"model.lubrication": "closed_form", "temperatures.bulk_method": "estimated"}
    )
    assert ("bulk_lower_bound" in codes(solved(SCUFFING, request, {}))) == warned
    given = {"temperatures.bulk_method": "given", "temperatures.bulk_c": 80}
    assert "bulk_lower_bound" not in codes(solved(SCUFFING, request, given))


@pytest.mark.parametrize("name", ["starter-high-speed-scuffing", "starter-turbo-gear-drive-train-cold"])
def test_a_safety_from_a_lower_bound_of_the_bulk_is_never_called_good(name: str) -> None:
    example = examples()[name]
    calculation = BY_PATH[example.endpoint]
    body = changed(example.request, {"temperatures.bulk_method": "estimated", "model.lubrication": "closed_form"})
    answer = evaluate(calculation, calculation.request.model_validate(body))
    assert any(warning.code == "bulk_lower_bound" for warning in answer.warnings)
    assert all(card.level != "good" for card in cards(answer, answer.inputs))


def test_an_ester_takes_the_factor_of_a_mineral_oil_and_says_so() -> None:
    ester = {"lubricant": {"viscosity_pa_s": 0.02, "kind": "ester"}}
    answer = solved(SCUFFING, STAGE, ester)
    mineral = solved(SCUFFING, STAGE, {"lubricant": {"viscosity_pa_s": 0.02}})
    losses = [each["friction_loss"]["coefficient"] for each in (answer, mineral)]
    assert losses[0] / losses[1] == pytest.approx(0.8, rel=1e-12)
    assert answer["flash"] == mineral["flash"]
    assert answer["safety"] == mineral["safety"]
    assert "mineral oil" in reasons(answer)["lubricant.kind"]
    known = {**ester, "friction_coefficient": 0.05, "temperatures": {"scuffing_c": 300}}
    assert "lubricant.kind" not in reasons(solved(SCUFFING, STAGE, known))


def test_the_kind_of_an_oil_given_by_its_viscosity_counts() -> None:
    mineral, polyglycol = (
        solved(SCUFFING, STAGE, {"lubricant": {"viscosity_pa_s": 0.02, "kind": kind}})
        for kind in ("mineral", "polyglycol")
    )
    for section, name in (("flash", "friction_coefficient"), ("friction_loss", "coefficient")):
        assert polyglycol[section][name] / mineral[section][name] == pytest.approx(0.7, rel=1e-12)


def test_without_load_no_coefficient_is_stated() -> None:
    answer = solved(SCUFFING, STAGE, {"load": {"pinion_torque_n_m": 0, "pinion_speed_rpm": 1500}})
    assert answer["friction_loss"]["coefficient"] is None
    assert answer["friction_loss"]["power_w"] == 0.0
    given = solved(
        SCUFFING, STAGE, {"load": {"pinion_torque_n_m": 0, "pinion_speed_rpm": 1500}, "friction_coefficient": 0.05}
    )
    assert given["friction_loss"]["coefficient"] == 0.05


def test_misalignment_raises_the_coefficient_of_friction_by_the_face_load_factor() -> None:
    straight = solved(SCUFFING, STAGE, {"load": {"power_kw": 400, "pinion_speed_rpm": 1500}})
    tilted = solved(
        SCUFFING, STAGE, {"load": {"power_kw": 400, "pinion_speed_rpm": 1500}, "modifications.helix_slope_um": 30}
    )
    factors = [answer["load"]["face_load_factor"] for answer in (straight, tilted)]
    ratio = tilted["flash"]["friction_coefficient"] / straight["flash"]["friction_coefficient"]
    assert factors[1] > 1.2 * factors[0]
    assert ratio == pytest.approx((factors[1] / factors[0]) ** 0.2, rel=1e-9)


def test_no_mean_flash_no_bulk() -> None:
    """Without a mean flash temperature, the answer has loads, but no results that need the bulk temperature."""
    # Here the loaded path reaches the base circle of the pinion with 12 teeth.
    gears = {
        "pinion": {"teeth": 12},
        "wheel": {"teeth": 60},
        "module_mm": 2,
        "helix_angle_deg": 15,
        "face_width_mm": 20,
    }
    answer = solved(SCUFFING, STAGE, {"gears": gears, "load": {"pinion_torque_n_m": 50, "pinion_speed_rpm": 1000}})
    assert {"path_reaches_base_circle", "no_bulk_estimate"} <= codes(answer)
    assert (answer["film"], answer["contact_temperature"], answer["safety"]) == (None, None, None)
    assert answer["load"]["max_line_load_n_per_mm"] > 0.0


def test_a_unit_takes_friction_from_its_oil_and_the_bulk_from_its_teeth() -> None:
    answer = solved(TRAIN, TURBO, {})
    assert answer["inputs"]["friction_coefficient"] is None
    assert answer["inputs"]["model"]["friction"] == "iso_tr_13989"
    assert answer["inputs"]["temperatures"]["bulk_method"] == "given"
    assert answer["derived"]["temperatures"]["bulk_c"] == pytest.approx((95 + 80) / 2)
    assert "safety rises" in reasons(answer)["temperatures.bulk_method"]


def test_a_unit_that_says_nothing_of_its_teeth_estimates_the_bulk() -> None:
    request = {**TURBO, "thermal": {"wall_response": 0.6}}
    assert solved(TRAIN, request, {})["derived"]["temperatures"]["bulk_method"] == "heat_balance"
    request |= {"temperatures": {**TURBO["temperatures"], "oil_supply": "dip"}}
    cool, warm = (solved(TRAIN, request, {"temperatures.oil_c": oil}) for oil in (50, 60))
    assert cool["derived"]["temperatures"]["bulk_method"] == "estimated"
    assert "bulk_lower_bound" in codes(cool)
    assert warm["safety"]["blok_flank"] < cool["safety"]["blok_flank"]


def test_a_unit_without_oil_and_friction_has_no_verdict() -> None:
    request = {name: section for name, section in TURBO.items() if name != "lubricant"}
    answer = solved(TRAIN, request, {"detail": "fields"})
    assert "no_oil" in codes(answer)
    assert not any(answer["safety"].values())
    assert answer["derived"]["temperatures"]["bulk_c"] == pytest.approx((95 + 80) / 2), "of its teeth"
    assert (answer["flash"]["flank_k"], answer["losses"]["mesh_w"], answer["losses"]["total_w"]) == (None, None, None)
    assert answer["flank"]["contact_temperature_c"][0][0] is None
    assert solved(TRAIN, request, {"friction_coefficient": 0.04})["safety"]["minimum"] > 1.0
    request["pinion_shaft"] = {**request["pinion_shaft"]}
    request["pinion_shaft"]["bearings"] = [
        {name: value for name, value in bearing.items() if name != "viscosity_pa_s"}
        for bearing in request["pinion_shaft"]["bearings"]
    ]
    with pytest.raises(Unprocessable) as refusal:
        solved(TRAIN, request, {})
    assert (refusal.value.code, refusal.value.path) == ("no_oil", "pinion_shaft.bearings.0.viscosity_pa_s")


@pytest.mark.parametrize(("torque", "factor"), [(6.0, 0.25**0.25), (48.0, 1.0)])
def test_standard_stiffness_of_light_loads_falls_with_their_fourth_root(torque: float, factor: float) -> None:
    """The standard stiffness c' grows with the fourth root of the line load up to 100 N/mm, then it is constant."""
    # A torque of 6 N m on the spur pinion (m 4, 20 teeth, 6 mm wide) gives 150 N, which is 25 N/mm.
    pair = {"pinion": {"teeth": 20}, "wheel": {"teeth": 40}, "module_mm": 4, "face_width_mm": 6}
    light, full = (
        solved(
            "/v1/scuffing/load-distribution",
            {"gears": pair, "load": {"pinion_torque_n_m": each, "pinion_speed_rpm": 1500}},
            {},
        )["stiffness"]
        for each in (torque, 24.0)
    )
    for name in ("standard_single_n_per_mm_um", "standard_mesh_n_per_mm_um"):
        assert light[name] / full[name] == pytest.approx(factor, rel=1e-9)


@pytest.mark.parametrize("stiffness", [None, 280])
def test_the_teeth_of_a_coupling_are_as_stiff_as_their_material(stiffness: float | None) -> None:
    """A stiffness that is left out is 280 N/um times E/206 GPa. A given stiffness does not depend on E."""
    teeth = {"coupling.tooth_stiffness_n_per_um": stiffness}
    steel, bronze = (solved(COUPLED, COUPLING, {**teeth, "coupling.youngs_modulus_gpa": E}) for E in (206, 103))
    used = [answer["derived"]["tooth_stiffness_n_per_um"] for answer in (steel, bronze)]
    assert used == pytest.approx([280.0, 140.0 if stiffness is None else 280.0], rel=1e-12)
    ratio = bronze["limits"]["torsional_stiffness_n_m_per_rad"] / steel["limits"]["torsional_stiffness_n_m_per_rad"]
    assert ratio == pytest.approx(used[1] / used[0], rel=1e-12)
    assert ("coupling.tooth_stiffness_n_per_um" in reasons(bronze)) == (stiffness is None)


@pytest.mark.parametrize("member", ["pinion", "wheel"])
@pytest.mark.parametrize("modulus", [110, 169, 241, 600])
def test_estimates_made_for_steel_are_warned_of_with_another_material(member: str, modulus: float) -> None:
    field = f"materials.{member}.youngs_modulus_gpa"
    estimates = {"friction_coefficient": None, "temperatures": {"scuffing_test": {"fzg_stage": 12}}}
    told = {each["code"]: each for each in solved(SCUFFING, STAGE, {**estimates, field: modulus})["warnings"]}
    assert (told["made_for_steel"]["field"], told["made_for_steel"]["rank"]) == (field, "doubtful")
    for each in ("coefficient of friction", "bulk temperature", "scuffing temperature"):
        assert each in told["made_for_steel"]["message"]
    assert "made_for_steel" not in codes(solved(SCUFFING, STAGE, {**estimates, field: 170}))
    measured = {"friction_coefficient": 0.05, "temperatures": {"bulk_c": 80, "scuffing_c": 300}}
    assert "made_for_steel" not in codes(solved(SCUFFING, STAGE, {**measured, field: modulus}))
    assert "made_for_steel" not in codes(solved(SCUFFING, DRY, {field: modulus}))


def test_a_safety_against_micropitting_is_made_for_steel() -> None:
    """A wheel of plastic with a film safety by ISO/TR 15144-1 is warned of, even if nothing else is estimated."""
    plastic = {
        "materials.wheel.youngs_modulus_gpa": 3,
        "friction_coefficient": 0.05,
        "temperatures": {"bulk_c": 80, "scuffing_c": 300},
        "micropitting": {"wear_coefficient_mm3_per_n_m": 1e-9},
    }
    assert "made_for_steel" not in codes(solved(SCUFFING, STAGE, plastic))
    for limit in ({"permissible_ratio": 0.3}, {"failure_load_stage": 8}):
        assert "made_for_steel" in codes(solved(SCUFFING, STAGE, {**plastic, "micropitting": limit}))


def test_a_unit_s_estimates_are_made_for_steel_too() -> None:
    assert "made_for_steel" in codes(solved(TRAIN, TURBO, {"materials.wheel.youngs_modulus_gpa": 110}))


def test_the_lubricant_factor_of_the_test_is_listed_with_its_value() -> None:
    """At 90 C, VG 220 has 25.6 mm2/s and 837 kg/m3, hence 21.4 mPa s and X_L = 0.858."""
    # The scuffing temperature is then 80 + 2.25 X_L 144 = 358.0 C.
    path = "temperatures.scuffing_test.lubricant_factor"
    answer = solved(SCUFFING, STAGE, {"temperatures.oil_c": 40})
    told = next(each for each in answer["assumptions"] if each["field"] == path)
    assert told["value"] == pytest.approx(0.858, abs=5e-4)
    assert answer["safety"]["scuffing_c"] == pytest.approx(80 + 2.25 * told["value"] * 144, rel=1e-9)
    assert "90 °C" in told["reason"]
    given = solved(SCUFFING, STAGE, {path: 0.8})
    assert path not in reasons(given)
    assert given["derived"]["lubricant_factor"] == 0.8
    unit = solved(TRAIN, TURBO, {"temperatures.scuffing_c": GONE, "temperatures.scuffing_test": {"fzg_stage": 12}})
    values = {each["field"]: each["value"] for each in unit["assumptions"]}
    assert values[path] == unit["derived"]["temperatures"]["lubricant_factor"] > 0.0


def test_a_section_under_the_teeth_takes_the_diameter_that_carries_torsion() -> None:
    """The section has the reference diameter less 1.25 modules: 231.29 mm."""
    # The reference diameter for 39 teeth, m_n 6 mm and 11.5 degrees is 238.79 mm.
    path = "pinion_shaft.sections.3.outer_diameter_mm"
    by_rule = solved(TRAIN, TURBO, {path: GONE})
    told = {each["field"]: each for each in by_rule["assumptions"]}[path]
    explicit, integral = (solved(TRAIN, TURBO, {path: each}) for each in (told["value"], 238.8))
    assert told["value"] == pytest.approx(231.294, abs=1e-3)
    assert "mean of root and reference diameter" in told["reason"]
    assert path not in reasons(explicit)
    twists = [answer["misalignment"]["parts"]["torsion"] for answer in (by_rule, explicit, integral)]
    assert twists[0] == pytest.approx(twists[1], rel=1e-9)
    assert 1.13 < twists[0] / twists[2] < 1.18
    with pytest.raises(Unprocessable, match="only under the teeth; give the outer diameter of section 1") as refusal:
        solved(TRAIN, TURBO, {"pinion_shaft.sections.1.outer_diameter_mm": GONE})
    assert (refusal.value.code, refusal.value.path) == (
        "section_diameter",
        "pinion_shaft.sections.1.outer_diameter_mm",
    )


def test_a_section_under_one_helix_may_stick_out() -> None:
    """A section without a diameter may be longer than the teeth above it, but not reach from helix to helix."""
    shaft = "pinion_shaft.sections"
    longer = {f"{shaft}.{place}.length_mm": length for place, length in ((2, 20), (3, 220), (4, 20))}
    solved_inputs = BY_PATH[TRAIN].request.model_validate(changed(TURBO, longer)).inputs()
    assert solved_inputs.pinion_shaft.sections[3].length == pytest.approx(0.22)
    double = examples()["starter-turbo-double-helical"].request
    into_the_gap = {f"{shaft}.3.length_mm": 115, f"{shaft}.4.length_mm": 55}
    BY_PATH[TRAIN].request.model_validate(changed(double, into_the_gap)).inputs()
    for wrong in ({f"{shaft}.4.outer_diameter_mm": GONE}, {f"{shaft}.3.length_mm": 172, f"{shaft}.4.length_mm": 1}):
        with pytest.raises(InvalidInput, match="not in the gap between the helices"):
            BY_PATH[TRAIN].request.model_validate(changed(double, wrong)).inputs()


@pytest.mark.parametrize("name", [name for name in examples() if name.startswith("xue-")])
def test_examples_of_the_paper_assume_nothing_of_oil_bulk_and_friction(name: str) -> None:
    example = examples()[name]
    if example.endpoint == SCUFFING:
        assert example.request["temperatures"]["bulk_c"] == 86.85
    if example.endpoint != "/v1/scuffing/load-distribution":
        assert example.request["lubricant"]["viscosity_pa_s"] == 0.08
    if example.endpoint != "/v1/scuffing/line-contact":
        assert example.request["friction_coefficient"] == 0.06


LEFT_OPEN = {
    ("Load", "pinion_torque"): "torque or power",
    ("Lubricant", "viscosity"): "without one, a grade or a data sheet no oil is known",
    ("Lubricant", "temperature"): "of a coupling's oil, told where a grade or a data sheet names it",
    ("LoadDistributionInputs", "friction_coefficient"): "scuffing takes the law of friction instead",
}
"""Inputs for which the service cannot have the solver's default, each with the reason."""


@pytest.mark.parametrize("calculation", CALCULATIONS, ids=lambda each: each.path)
def test_inputs_of_the_solvers_have_the_defaults_of_the_service_or_none(calculation: Calculation) -> None:
    """If a solver declares a default for an input, the service has the same default, except in `LEFT_OPEN`."""
    for leaf in leaves(calculation.request):
        record, name = getattr(leaf.declared, "origin", None) or (None, "")
        own = {each.name: each.default for each in fields(record)}.get(name, MISSING) if record else MISSING
        if own is MISSING or (record.__name__, name) in LEFT_OPEN:
            continue
        default = list(leaf.default) if isinstance(leaf.default, list | tuple) else leaf.default
        shown = leaf.declared.from_si(own) if isinstance(own, float) else own
        shown = list(shown) if isinstance(shown, tuple) else shown
        assert not leaf.required, leaf.path
        assert (pytest.approx(shown, rel=1e-12) if isinstance(own, float) else shown) == default, leaf.path
