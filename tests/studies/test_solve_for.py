"""A search answers what brute force answers: which flow, which grade, which crowning, which oil."""

import json
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from app.examples import examples
from app.studies.kinds.solve_for import SolveFor, Track, usual_range
from app.studies.kinds.sweep import Sweep
from app.studies.points import solve_point
from solvers.named_oils import named_oils
from tests.support.pools import InlinePool
from tests.support.properties import seeds
from tests.support.requests import GONE, changed
from tests.support.studies import fault_of, lines_of, study_of, timeless

COUPLING = "pahl-axial-displacement"
THRUST, HELD_THRUST = "axial_thrust.force_n", "axial_thrust.design_force_n"
TORQUE, GRADE, NAME = "operation.torque_n_m", "lubricant.iso_vg", "lubricant.name"
PITTED = "starter-industrial-micropitting"
S_LAMBDA, PERMISSIBLE = "micropitting.local.safety", "micropitting.permissible_ratio"
SCUFFING, LOADS = "/v1/scuffing", "/v1/scuffing/load-distribution"

Body = dict[str, Any]


def planned(body: Body) -> SolveFor:
    return SolveFor(body, 2500, 30.0)


def coupling(path: str | Sequence[str], output: str = HELD_THRUST, **more: Any) -> Body:
    ends = {name: more.pop(name) for name in ("min", "max", "scale") if name in more}
    return study_of(COUPLING, find={"path": path, **ends}, output=output, **more)


def ended(body: Body) -> dict[str, Any]:
    return lines_of(planned(body))[-1]


def outputs_at(study: SolveFor, places: Sequence[Any]) -> list[float]:
    """Return the output at values of the field, by brute force; NaN without a solution."""
    outs = [solve_point(study.question, study.overrides(place)).out[0] for place in places]
    return [np.nan if out is None else float(out) for out in outs]


def confirm(body: Body, wanted_of: Any) -> None:
    """Check the answers of a search against the changes of side along many points between its ends."""
    study = planned({**body, "equals": 1.0})
    low, high = study.track.low, study.track.high
    assert low is not None
    assert high is not None
    places = np.linspace(low, high, 20).tolist()
    outputs = np.array(outputs_at(study, places))
    wanted = wanted_of(outputs)
    study = planned({**body, "equals": wanted})
    end = lines_of(study)[-1]
    beyond = outputs - wanted
    expected = [(places[at], places[at + 1]) for at in np.flatnonzero(beyond[:-1] * beyond[1:] < 0.0)]
    answers = [each["at"] for each in end["answers"]]
    assert len(answers) == len(expected), (answers, expected)
    assert all(start <= at <= stop for at, (start, stop) in zip(answers, expected, strict=True))
    assert outputs_at(study, answers) == pytest.approx([wanted] * len(answers), rel=1e-4)


def pitted(rng: np.random.Generator) -> Body:
    changes = {
        "load.power_kw": rng.uniform(200, 400),
        "load.pinion_speed_rpm": rng.uniform(800, 1600),
        "temperatures.oil_c": rng.uniform(60, 85),
        "micropitting.failure_load_stage": int(rng.integers(7, 11)),
        "model.lubrication": "closed_form",
    }
    request = changed(examples()[PITTED].request, changes)
    return {"endpoint": SCUFFING, "request": request, "find": {"path": GRADE}, "output": S_LAMBDA, "equals": 1.2}


@seeds(20, 40, default=1)
def test_which_flow_is_safe_at_the_worst_end(rng: np.random.Generator) -> None:
    changes = {
        "load.power_kw": rng.uniform(9000, 13000),
        "load.pinion_speed_rpm": rng.uniform(8500, 11000),
        "temperatures.oil_c": rng.uniform(45, 60),
        "cooling.gear_flow_l_per_min": rng.uniform(80, 250),
    }
    request = changed(examples()["starter-turbo-pair-heat"].request, changes)
    find = {"path": "cooling.gear_flow_l_per_min"}
    body = {"endpoint": SCUFFING, "request": request, "find": find, "output": "heat.band.safety.0"}
    confirm(body, lambda outputs: float(rng.uniform(np.nanmin(outputs), np.nanmax(outputs))))


@seeds(20, 40, default=1)
def test_which_grade_for_a_safety_against_micropitting(rng: np.random.Generator) -> None:
    """The permissible film is that of the case at every grade; brute force gives it as a number."""
    body = pitted(rng)
    study = planned(body)
    header, *_, end = lines_of(study)
    base = solve_point(study.question._replace(base=body["request"], outputs=[PERMISSIBLE]), {})
    assert header["held"] == {PERMISSIBLE: base.out[0]}
    given = {"micropitting": {**body["request"]["micropitting"], "permissible_ratio": base.out[0]}}
    del given["micropitting"]["failure_load_stage"]
    question = study.question._replace(base=body["request"] | given)
    safeties = [solve_point(question, {GRADE: grade}).out[0] for grade in header["find"]["values"]]
    assert safeties == sorted(safeties), "a thicker oil has a thicker film"
    reach = [grade for grade, safety in zip(header["find"]["values"], safeties, strict=True) if safety >= 1.2]
    between = [each["between"][1] for each in end["crossings"]]
    assert between == (reach[:1] if 0 < len(reach) < len(safeties) else [])
    assert end["answers"] == []


@seeds(20, 40, default=1)
def test_which_crowning_for_the_least_pressure(rng: np.random.Generator) -> None:
    changes = {"load.pinion_torque_n_m": rng.uniform(200, 1500), "modifications.helix_slope_um": rng.uniform(-25, 25)}
    request = changed(examples()["xue-pair-1-modified"].request, {"load.power_kw": GONE, **changes})
    find = {"path": "modifications.lead_crowning_um", "min": 0, "max": 40}
    output = "pressure.max_mpa"
    study = planned({"endpoint": LOADS, "request": request, "find": find, "output": output, "extreme": "least"})
    (best,) = lines_of(study)[-1]["answers"]
    outputs = outputs_at(study, np.linspace(0.0, 40.0, 42).tolist())
    assert best["out"] <= min(outputs) * (1 + 1e-5)
    assert outputs_at(study, [best["at"]]) == [best["out"]]
    assert (best["end"] is None) == (0.0 < best["at"] < 40.0)


def test_a_thin_oil_looks_as_good_as_a_thick_one_only_while_its_stage_is_another_oils() -> None:
    """By the stage VG 15 reaches what in truth takes VG 150."""
    body = study_of(PITTED, find={"path": GRADE}, output=S_LAMBDA, equals=1.2)
    by_stage, held = (lines_of(planned({**body, "oil_tests": each})) for each in ("by_stage", "held"))
    assert [lines[-1]["crossings"][0]["between"] for lines in (by_stage, held)] == [[10, 15], [100, 150]]
    assert "belongs to the oil of the case" in by_stage[-1]["remarks"][0]
    assert "is held: " in held[-1]["remarks"][0]


def test_named_oils_bring_their_own_stages() -> None:
    body = pitted(np.random.default_rng(2)) | {"find": {"path": NAME}}
    study = planned(body)
    header, *points, end = lines_of(study)
    printing = [oil for oil in named_oils().values() if oil.micropitting_stage]
    assert [point["at"] for point in points] == header["find"]["values"] == [oil.name for oil in printing]
    request = body["request"] | {"lubricant": {"name": printing[0].name}}
    request["micropitting"] = {**request["micropitting"], "failure_load_stage": printing[0].micropitting_stage}
    request["temperatures"] = {**request["temperatures"], "scuffing_test": {"fzg_stage": printing[0].fzg_stage}}
    assert solve_point(study.question._replace(base=request), {}).out == points[0]["out"]
    reached = [point["at"] for point in points if point["out"][0] >= 1.2]
    assert [each["at"] for each in end["answers"]] == reached
    assert end["remarks"] == []


def test_a_sweep_over_the_grade_says_whose_stage_it_is_and_can_hold_the_limit() -> None:
    body = pitted(np.random.default_rng(3))
    vary = {"endpoint": SCUFFING, "request": body["request"], "vary": [{"path": GRADE, "values": [68, 150, 320]}]}
    vary["outputs"] = [S_LAMBDA]
    *_, end = lines_of(Sweep(vary, 2500, 30.0))
    assert "belongs to the oil of the case" in end["remarks"][0]
    header, *points, end = lines_of(Sweep({**vary, "oil_tests": "held"}, 2500, 30.0))
    sought = {line["at"]: line["out"] for line in lines_of(planned(body))[1:-1]}
    assert header["held"]
    assert [point["out"] for point in points] == [sought[grade] for grade in (68, 150, 320)]
    other = {**vary, "outputs": ["load.face_load_factor"]}
    assert "remarks" not in lines_of(Sweep(other, 2500, 30.0))[-1]


def test_a_case_without_the_limit_has_none_to_hold() -> None:
    body = pitted(np.random.default_rng(4))
    body["request"] = changed(body["request"], {"lubricant": {"viscosity_pa_s": 0.05}, "micropitting": {}})
    assert lines_of(planned(body))[-1]["type"] == "end", "no test, nothing to hold"
    dry = changed(body["request"], {"lubricant": GONE, "micropitting.failure_load_stage": 8})
    *_, last = lines_of(planned({**body, "request": dry}))
    assert (last["type"], last["code"]) == ("error", "no_limit")


def test_lines() -> None:
    header, *points, end = timeless(lines_of(planned(coupling(TORQUE, equals=10000))))
    assert header["type"] == "solve-for"
    assert header["find"] == {
        "path": TORQUE,
        "unit": "N m",
        "title": "transmitted torque",
        "min": 0.0,
        "max": 12000.0,
        "scale": "linear",
        "values": None,
    }
    assert [point["index"] for point in points] == list(range(end["points"]))
    (answer,) = end["answers"]
    at = {"operation": {**examples()[COUPLING].request["operation"], "torque_n_m": answer["at"]}}
    body = coupling(TORQUE, equals=1)
    alone = solve_point(planned(body).question._replace(base=body["request"] | at), {})
    assert alone.out == [answer["out"]] == [pytest.approx(10000, rel=1e-6)]
    assert (answer["before"], answer["after"], answer["end"], answer["until"]) == (-1, 1, None, None)


def test_equal_lines_on_any_number_of_processes() -> None:
    body = coupling("operation.misalignment_deg", THRUST, equals=300, min=-6, max=6)
    first, *others = (timeless(lines_of(planned(body), InlinePool(slots))) for slots in (1, 2, 5))
    assert all(other == first for other in others)
    low, high = (each["at"] for each in first[-1]["answers"])
    assert low == pytest.approx(-high)


def test_a_peak_at_zero_is_seen_between_two_points() -> None:
    """The thrust of nearly coaxial shafts is a peak that is far narrower than a step of the scan."""
    body = coupling("operation.misalignment_deg", THRUST, equals=2000, min=-0.5, max=0.1, count=5)
    low, high = (each["at"] for each in ended(body)["answers"])
    assert low == pytest.approx(-high)
    assert high < 0.02


@pytest.mark.parametrize(("low", "high"), [(-5.0, 10.0), (-0.3, 0.6), (-1e-3, 7.0), (-7.0, 1e-12)])
def test_zero_is_scanned_once(low: float, high: float) -> None:
    track = Track("linear", low, high)
    values = [track.value(place) for place in track.scan(4)]
    assert values.count(0.0) == 1
    assert values == sorted(values)
    assert min(np.diff(np.array(values, dtype=float))) > 1e-10 * (high - low)


def test_a_range_without_an_answer_names_the_nearest_and_its_end() -> None:
    end = ended(coupling(TORQUE, equals=1e6))
    assert end["answers"] == end["crossings"] == []
    assert (end["nearest"]["at"], end["nearest"]["end"]) == (12000.0, "max")


def test_whole_numbers_have_answers_between_neighbours() -> None:
    study = planned(coupling("coupling.teeth", equals=8000))
    ((low, high),) = [each["between"] for each in lines_of(study)[-1]["crossings"]]
    more, less = outputs_at(study, [low, high])
    assert high == low + 1
    assert more > 8000 > less


def test_an_output_that_does_not_depend_on_the_field() -> None:
    end = ended(coupling(GRADE, "axial_thrust.coaxial_limit_n", equals=1000))
    assert end["constant"]
    assert end["points"] == 14


def test_fields_move_together() -> None:
    both = ["friction.coefficient", "friction.static_coefficient"]
    study = planned(coupling(both, equals=9000))
    (answer,) = lines_of(study)[-1]["answers"]
    assert study.overrides(answer["at"]) == dict.fromkeys(both, answer["at"])


def test_a_gap_has_a_reason() -> None:
    limits = study_of("starter-coupling-at-its-limits", find={"path": "operation.misalignment_deg"}, equals=1)
    (gap,) = ended({**limits, "output": "lubrication.contact_overlap"})["gaps"]
    assert gap == {"from": 0.0, "to": 0.0, "reason": "the answer has no value of this output"}


def test_an_extreme_at_an_end_says_so() -> None:
    (best,) = ended(coupling(TORQUE, extreme="greatest"))["answers"]
    assert (best["at"], best["end"]) == (12000.0, "max")


@pytest.mark.parametrize(
    ("path", "value", "ends"),
    [
        ("load.power_kw", 100.0, (0.0, 400.0)),
        ("load.pinion_speed_rpm", 1000.0, (250.0, 4000.0)),
        ("modifications.helix_slope_um", 0.0, (-80.0, 80.0)),
        ("modifications.helix_slope_um", -200.0, (-400.0, 0.0)),
        ("modifications.tip_relief_um", 400.0, (0.0, 1000.0)),
        ("temperatures.oil_c", 70.0, (0.0, 140.0)),
        ("cooling.gear_flow_l_per_min", None, (0.1, 5000.0)),
        ("gears.pinion.teeth", 19, (5, 76)),
    ],
)
def test_the_usual_range(path: str, value: float | None, ends: tuple[float, float]) -> None:
    study = planned({**pitted(np.random.default_rng(1)), "find": {"path": path}})
    assert usual_range(study.leaves[0], value) == pytest.approx(ends)


@pytest.mark.parametrize(
    ("change", "pointer", "code"),
    [
        ({"equals": None}, "", "equals_or_extreme"),
        ({"extreme": "least"}, "", "equals_or_extreme"),
        ({"equals": float("nan")}, "/equals", "finite_number"),
        ({"equals": "NaN"}, "/equals", "number_type"),
        ({"equals": True}, "/equals", "number_type"),
        ({"equals": 1e301}, "/equals", "less_than_equal"),
        ({"equals": None, "extreme": "worst"}, "/extreme", "literal_error"),
        ({"count": 2}, "/count", "greater_than_equal"),
        ({"count": 501}, "/count", "less_than_equal"),
        ({"output": "axial_thrust"}, "/output", "not_scalar"),
        ({"output": "lubrication.regime.name"}, "/output", "unknown_output"),
        ({"output": "nothing"}, "/output", "unknown_output"),
        ({"output": ["axial_thrust.force_n"]}, "/output", "path_type"),
        ({"find": None}, "/find", "model_type"),
        ({"find": {}}, "/find/path", "missing"),
        ({"find": {"path": "operation.torque"}}, "/find/path", "unknown_path"),
        ({"find": {"path": "operation"}}, "/find/path", "not_scalar"),
        ({"find": {"path": "operation.arrangement"}}, "/find/path", "not_scalar"),
        ({"find": {"path": [TORQUE, GRADE]}}, "/find/path", "not_scalar"),
        ({"find": {"path": TORQUE, "min": 5, "max": 5}}, "/find/min", "values_or_range"),
        ({"find": {"path": TORQUE, "min": -1}}, "/find/min", "out_of_range"),
        ({"find": {"path": TORQUE, "max": 1e300}}, "/find/max", "out_of_range"),
        ({"find": {"path": TORQUE, "min": 0, "scale": "log"}}, "/find/min", "log_needs_positive"),
        ({"find": {"path": TORQUE, "scale": "even"}}, "/find/scale", "literal_error"),
        ({"find": {"path": "coupling.teeth", "min": 10.5}}, "/find/min", "not_integer"),
        ({"find": {"path": GRADE, "min": 11, "max": 12}}, "/find/min", "out_of_range"),
        ({"find": {"path": NAME, "min": 1}}, "/find/min", "values_or_range"),
        ({"oil_tests": "own"}, "/oil_tests", "literal_error"),
        ({"unknown": 1}, "/unknown", "extra_forbidden"),
        ({"endpoint": "/v1/nothing"}, "/endpoint", "unknown_endpoint"),
        ({"request": []}, "/request", "dict_type"),
    ],
)
def test_what_is_refused_names_the_field(change: Body, pointer: str, code: str) -> None:
    body = {**coupling(TORQUE, equals=10000), **change}
    assert fault_of(SolveFor, {name: part for name, part in body.items() if part is not None or name == "find"})[
        :2
    ] == (
        pointer,
        code,
    )


def test_too_many_points() -> None:
    assert fault_of(SolveFor, coupling(TORQUE, equals=1), most=100)[:2] == ("/count", "too_many_points")


def test_a_wanted_value_near_zero_or_far_away_is_no_trouble() -> None:
    for wanted in (0.0, 5e-324, -1e300, 1e300):
        lines = lines_of(planned(coupling(TORQUE, equals=wanted)))
        assert lines[-1]["type"] == "end"
        json.dumps(lines, allow_nan=False)
