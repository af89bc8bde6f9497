"""Every point of a study equals the endpoint's own answer, bit for bit."""

import json
from typing import Any

import pytest

from app.calculations import BY_PATH
from app.errors import Unprocessable
from app.evaluate import evaluate, written
from app.examples import examples
from app.schema.fields import leaves, value_at
from app.studies import points
from app.studies.points import Question, sized_flow, solve_chunk, solve_point, with_overrides
from tests.support.properties import one_per_endpoint
from tests.support.requests import changed

VARIED = {
    "/v1/coupling": "operation.torque_n_m",
    "/v1/coupling/sleeve-orbit": "coupling.sleeve_mass_kg",
    "/v1/coupling/recommendation": "operation.torque_n_m",
    "/v1/pumping": "operation.pinion_speed_rpm",
    "/v1/pumping/choking-speed": "gears.face_width_mm",
    "/v1/scuffing/load-distribution": "load.pinion_speed_rpm",
    "/v1/scuffing": "temperatures.oil_c",
    "/v1/scuffing/line-contact": "contact.line_load_n_per_mm",
    "/v1/drive-train": "operation.pinion_speed_rpm",
    "/v1/drive-train/warm-up": "start_c",
}
SLOW = {"/v1/scuffing", "/v1/pumping/choking-speed", "/v1/drive-train", "/v1/drive-train/warm-up"}
LOADS = examples()["xue-pair-1-modified"]


def scalars(endpoint: str) -> list[str]:
    """Return the paths of the single values that an answer contains at every level of detail."""
    wanted = (leaf for leaf in leaves(BY_PATH[endpoint].response) if leaf.is_scalar and leaf.kind != "other")
    return [leaf.path for leaf in wanted if leaf.detail == "summary" and "*" not in leaf.path]


def test_every_endpoint_is_varied() -> None:
    assert set(VARIED) == set(BY_PATH) == {example.endpoint for example in examples().values()}


@pytest.mark.parametrize("name", one_per_endpoint(examples()))
def test_points_are_the_endpoints_own_answers(name: str) -> None:
    endpoint = examples()[name].endpoint
    request = changed(examples()[name].request, {"model.path_points": 5} if endpoint == "/v1/scuffing" else {})
    calculation, path, outputs = BY_PATH[endpoint], VARIED[endpoint], scalars(endpoint)
    base = value_at(calculation.request.model_validate(request).model_dump(), path)
    overrides: list[dict[str, Any]] = [
        {path: factor * base} for factor in ((0.97,) if endpoint in SLOW else (0.97, 1.03))
    ]
    question = Question(endpoint, request, outputs, 30.0)
    found = [point for each in overrides for point in solve_chunk(question, [each], 0.25).points]
    assert len({json.dumps(point.out) for point in found}) == len(overrides)
    for each, point in zip(overrides, found, strict=True):
        body = with_overrides(calculation, request, each) | {"detail": "curves"}
        single = json.loads(written(evaluate(calculation, calculation.request.model_validate(body))))
        assert json.loads(json.dumps(point.out)) == [value_at(single, path) for path in outputs]
        assert point.status == single["status"]
        assert point.warnings == [*dict.fromkeys(warning["code"] for warning in single["warnings"])]
        assert list(point.assumptions) == single["assumptions"]


PAIR = {
    **examples()["starter-high-speed-scuffing"].request,
    "model": {"lubrication": "closed_form"},
    "load": {"power_kw": 12000, "pinion_speed_rpm": 10000},
}
POWER, FLOW = "load.power_kw", "cooling.gear_flow_l_per_min"


def test_all_points_have_the_oil_pump_of_the_base_request() -> None:
    outputs = ["safety.blok_factor", "derived.cooling.gear_flow_l_per_min"]
    question = Question("/v1/scuffing", PAIR, outputs, 30.0)
    flow = sized_flow(question, {})
    assert flow is not None
    question = question._replace(gear_flow=flow)
    base, twice = (solve_point(question, {POWER: power}) for power in (12000, 24000))
    assert base.out == [pytest.approx(base.out[0]), pytest.approx(flow)]
    assert twice.out[1] == pytest.approx(flow)
    own = solve_point(question._replace(gear_flow=None), {POWER: 24000, FLOW: flow})
    assert twice.out == own.out, "bit for bit its own answer with this flow"
    assert solve_point(question._replace(gear_flow=None), {POWER: 24000}).out[0] > twice.out[0]
    (assumed,) = [each for each in twice.assumptions if each["field"] == FLOW]
    assert assumed["value"] == flow
    assert solve_point(question, {POWER: 24000, "cooling.flow_rise_k": 10}).out[1] > flow
    assert solve_point(question, {FLOW: 100}).out[1] == pytest.approx(100)
    assert sized_flow(question._replace(base={**PAIR, "cooling": {"gear_flow_l_per_min": 80}}), {}) is None


def test_the_pump_is_that_of_the_first_point_where_the_request_leaves_the_field_out() -> None:
    open_ = {**PAIR, "load": {"pinion_speed_rpm": 10000}}
    question = Question("/v1/scuffing", open_, ["safety.blok_factor"], 30.0)
    assert sized_flow(question, {POWER: 12000}) == sized_flow(question._replace(base=PAIR), {})


def test_a_code_counts_once_at_a_point() -> None:
    """Little oil limits the cooling of both gears: two warnings, one code with one rank at the point of a study."""
    pair = examples()["starter-turbo-pair-heat"]
    base = changed(pair.request, {"model.lubrication": "closed_form", "cooling.wetting_share": 0.2})
    calculation = BY_PATH[pair.endpoint]
    answer = json.loads(written(evaluate(calculation, calculation.request.model_validate(base))))
    codes = [warning["code"] for warning in answer["warnings"]]
    assert codes.count("oil_limited") == 2
    (point,) = solve_chunk(Question(pair.endpoint, base, ["safety.blok_factor"], 30.0), [{}], 0.25).points
    assert point.warnings.count("oil_limited") == 1
    assert len(point.ranks) == len(point.warnings)


def one(overrides: dict[str, Any], *, base: dict[str, Any] = LOADS.request, deadline_s: float = 30.0) -> points.Point:
    (point,) = solve_chunk(Question(LOADS.endpoint, base, ["pressure.max_mpa"], deadline_s), [overrides], 0.25).points
    return point


def test_what_physics_refuses_is_a_point() -> None:
    point = one({"gears.pinion.addendum": 3.0})
    assert (point.status, point.out) == ("refused", [None])
    assert point.error is not None
    calculation = BY_PATH[LOADS.endpoint]
    body = with_overrides(calculation, LOADS.request, {"gears.pinion.addendum": 3.0})
    with pytest.raises(Unprocessable) as caught:
        written(evaluate(calculation, calculation.request.model_validate(body)))
    assert point.error["code"] == caught.value.code


def test_what_two_fields_refuse_together_is_a_point() -> None:
    point = one({"load.pinion_torque_n_m": None, "load.power_kw": None})
    assert point.status == "refused"
    assert point.error is not None
    assert (point.error["pointer"], point.error["code"]) == ("/load", "torque_or_power")


def test_what_cannot_finish_is_a_point() -> None:
    example = examples()["xue-pair-1-thermal"]
    body = {**example.request, "model": {"nodes": 481, "film_nodes": 61}}
    (point,) = solve_chunk(Question(example.endpoint, body, [], 30.0), [{"model.path_points": 500}], 0.25).points
    assert point.error is not None
    assert (point.error["pointer"], point.error["code"]) == ("/model/path_points", "cannot_finish")


def test_no_solution_is_a_point() -> None:
    contact = {"line_load_n_per_mm": 68.0028, "radius_mm": 5, "speed_1_m_per_s": 10.5, "speed_2_m_per_s": 9.5}
    body = {"contact": contact, "lubricant": {"viscosity_pa_s": 0.08}, "model": {"rheology": "newtonian"}}
    question = Question("/v1/scuffing/line-contact", body, ["film.minimum_um", "status"], 30.0)
    (point,) = solve_chunk(question, [{}], 0.25).points
    assert (point.status, point.out) == ("no_solution", [None, "no_solution"])


@pytest.mark.parametrize(
    ("error", "code"), [(MemoryError(), "memory_limit"), (RuntimeError("secret"), "internal_error")]
)
def test_what_breaks_is_a_failed_point(monkeypatch: pytest.MonkeyPatch, error: Exception, code: str) -> None:
    def broken(*_: object) -> None:
        raise error

    monkeypatch.setattr(points, "evaluate", broken)
    point = one({})
    assert point.status == "failed"
    assert point.error is not None
    assert point.error["code"] == code
    assert "secret" not in point.error["message"]


def test_an_exclusive_field_clears_its_fellow_in_the_base() -> None:
    calculation = BY_PATH[LOADS.endpoint]
    assert LOADS.request["load"].get("pinion_torque_n_m") or LOADS.request["load"].get("power_kw")
    for path, fellow in (("power_kw", "pinion_torque_n_m"), ("pinion_torque_n_m", "power_kw")):
        given = {**LOADS.request, "load": {"pinion_speed_rpm": 2000.0, fellow: 10.0}}
        body = with_overrides(calculation, given, {f"load.{path}": 20.0})
        assert body["load"] == {"pinion_speed_rpm": 2000.0, path: 20.0}
        assert given["load"][fellow] == 10.0
        assert one({f"load.{path}": 20.0}, base=given).status in {"ok", "ok_with_warnings"}


def test_equal_assumptions_are_one_object_which_is_sent_once() -> None:
    question = Question("/v1/coupling", examples()["pahl-axial-displacement"].request, [], 30.0)
    torque, friction = "operation.torque_n_m", "friction.coefficient"
    points = [{torque: 3000}, {torque: 3001}, {friction: None}, {friction: None}]
    first, second, third, fourth = (point.assumptions for point in solve_chunk(question, points, 60.0).points)
    assert first is second
    assert third is fourth
    assert first != third


def test_a_chunk_ends_after_its_time(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = iter(range(1000))
    monkeypatch.setattr("app.studies.points.time.perf_counter", lambda: 0.1 * next(clock))
    question = Question("/v1/coupling", examples()["pahl-axial-displacement"].request, ["axial_thrust.force_n"], 30.0)
    speeds = [{"operation.speed_rpm": 1000 + index} for index in range(10)]
    assert len(solve_chunk(question, speeds, 0.25).points) == 3
