"""In a load spectrum each machine runs all cases, no draw is lost, and the results agree with simple laws."""

import json
from math import hypot
from typing import Any

import numpy as np
import pytest
from scipy.stats import norm

from app.calculations import BY_PATH
from app.evaluate import evaluate
from app.examples import examples, study_bodies
from app.schema.fields import value_at
from app.studies.kinds.spectrum import Spectrum
from app.studies.kinds.sweep import Sweep
from app.studies.points import Point
from solvers.arrays import FloatArray
from tests.support.pools import InlinePool
from tests.support.requests import changed
from tests.support.studies import fault_of, lines_of, study_of, timeless

STAGE = examples()["starter-high-speed-scuffing"]
MU = "friction.coefficient"
SCUFFING = BY_PATH["/v1/scuffing"]
COAXIAL = "axial_thrust.coaxial_limit_n"
PRESSURE = "pressure.max_mpa"
SLOPE = {"path": "modifications.helix_slope_um", "distribution": "normal", "mean": 0, "deviation": 8}


def coupling(**parts: Any) -> dict[str, Any]:
    return study_of("pahl-axial-displacement", **{"cases": [{}], "outputs": [COAXIAL], **parts})


def loads(**parts: Any) -> dict[str, Any]:
    return study_of("xue-pair-1-modified", **{"outputs": [PRESSURE], **parts})


def friction(**parts: Any) -> dict[str, Any]:
    return {"inputs": [{"path": MU, "distribution": "normal", "mean": 0.2, "deviation": 0.02}], **parts}


def above(output: str, mean: float, deviation: float | None = None) -> dict[str, Any]:
    return {"output": output, "above": {"value": mean} if deviation is None else {"mean": mean, "deviation": deviation}}


def below(output: str, **limit: float) -> dict[str, Any]:
    return {"output": output, "below": limit}


def planned(body: object) -> Spectrum:
    return Spectrum(body, 20_000, 30.0)


def solved(body: object, slots: int = 1) -> list[dict[str, Any]]:
    return timeless(lines_of(planned(body), InlinePool(slots)))


def test_lines() -> None:
    header, *points, end = solved(coupling(tolerances=friction(count=4, replicates=2), points=True))
    names = "type endpoint cases tolerances outputs total model_version sources case"
    assert list(header) == names.split()
    assert header["cases"] == [{"name": "case 1", "share": 1.0, "set": {}}]
    assert header["tolerances"]["inputs"][0]["cut_off"] == pytest.approx(6.334248e-5)
    assert [(line["draw"], line["case"]) for line in points] == [(draw, 0) for draw in range(8)]
    assert end["points"] == 8
    assert end["counts"] == {"ok": 8}
    assert "friction.static_coefficient" not in {each["field"] for each in end["assumptions"]}
    without = solved(coupling(tolerances=friction(count=4, replicates=2)))
    assert [line["type"] for line in without] == ["spectrum", "end"]


def test_one_case_without_tolerances() -> None:
    """The probability is P = Phi((y - m) / s) for the output y and a limit with mean m and deviation s."""
    # Without tolerances the probability is exact, so there is no standard error and no interval.
    header, end = solved(coupling(limits=[above(COAXIAL, 3000, 400)]))
    (limit,) = end["limits"]
    mean = end["outputs"][COAXIAL]["mean"]
    assert header["total"] == 1
    assert limit["probability"] == pytest.approx(norm.cdf((mean - 3000) / 400), rel=1e-12)
    assert limit["bounds"] == [limit["probability"]] * 2
    assert limit["standard_error"] is limit["interval"] is limit["rank_correlation"] is None
    assert limit["decides"] == [1.0]


def test_a_linear_output_of_a_normal_input() -> None:
    """The coaxial thrust is the coefficient of friction times a force, and is therefore normally distributed."""
    # The probability that the thrust exceeds its limit is P = Phi((mu - m) / sqrt(s_y^2 + s^2)), with the mean mu and
    # the deviation s_y of the thrust, and the mean m and the deviation s of the limit.
    nominal = solved(coupling(cases=[{"set": {MU: 0.2}}]))[-1]["outputs"][COAXIAL]["mean"]
    deviation = 0.1 * nominal
    distances = (0.5, 2.0)
    limits = [above(COAXIAL, nominal + distance * deviation, deviation) for distance in distances]
    *_, end = solved(coupling(tolerances=friction(), limits=limits))
    for found, distance in zip(end["limits"], distances, strict=True):
        expected = norm.sf(distance * deviation / hypot(deviation, deviation))
        assert found["interval"][0] <= expected <= found["interval"][1]
        assert found["probability"] == pytest.approx(expected, abs=4.0 * found["standard_error"])
        assert found["standard_error"] < 2e-4
        assert found["rank_correlation"] == {MU: pytest.approx(1.0)}
    low, middle, high = end["cases"][0]["quantiles"][COAXIAL]
    assert middle == pytest.approx(nominal, rel=1e-3)
    assert (low, high) == pytest.approx((nominal - 1.645 * deviation, nominal + 1.645 * deviation), rel=3e-3)


def test_the_interval_of_a_rare_event_is_said_to_cover_less() -> None:
    limits = [above(COAXIAL, 1.5e4, 1e3)]
    *_, rare = solved(coupling(tolerances=friction(count=16, replicates=4), limits=limits))
    assert 0.0 < rare["limits"][0]["probability"] < 0.005
    assert "below 0.5 %" in rare["notes"][0]
    *_, usual = solved(coupling(tolerances=friction(count=16, replicates=4), limits=[above(COAXIAL, 9000, 1e3)]))
    assert usual["limits"][0]["probability"] > 0.005
    assert usual["notes"] == []


def test_a_limit_to_fall_short_of() -> None:
    """If small outputs are bad, the case with the lowest output decides."""
    # The probability is the upper tail of the distribution of the limit.
    cases = [{"name": "low", "set": {"operation.torque_n_m": 2000}}, {"name": "high", "set": {}}]
    limits = [below(COAXIAL, mean=4000, deviation=300), below(COAXIAL, value=4000), below(COAXIAL, value=1)]
    body = coupling(cases=cases, tolerances=friction(count=8, replicates=4), limits=limits, points=True)
    _, *points, end = solved(body)
    thrust = np.array([point["out"][0] for point in points]).reshape(32, 2)
    assert (thrust[:, 0] < thrust[:, 1]).all()
    normal, fixed, never = end["limits"]
    assert [each["side"] for each in end["limits"]] == ["below"] * 3
    assert normal["probability"] == pytest.approx(norm.cdf((4000 - thrust[:, 0]) / 300).mean(), rel=1e-12)
    assert fixed["probability"] == np.mean(thrust[:, 0] < 4000)
    assert 0.0 < fixed["probability"] < 1.0
    assert normal["decides"] == [1.0, 0.0]
    assert (never["probability"], never["interval"]) == (0.0, [0.0, pytest.approx(1.0 - 0.1 ** (1 / 32))])
    alone = end["cases"][1]["limits"][0]["probability"]
    assert alone == pytest.approx(norm.cdf((4000 - thrust[:, 1]) / 300).mean(), rel=1e-12)


def test_the_deadline_ends_a_spectrum_with_a_line() -> None:
    body = coupling(tolerances=friction(count=64), points=True)
    lines = lines_of(planned(body), seconds=1e-9)
    assert "end" not in {line["type"] for line in lines}
    assert (lines[-1]["type"], lines[-1]["code"]) == ("error", "study_deadline")
    assert lines[-1]["done"] < 512


def test_a_case_listed_twice_changes_nothing_but_who_decides() -> None:
    one = {"name": "a", "share": 0.6, "set": {"operation.torque_n_m": 2000}}
    other = {"name": "b", "share": 0.4, "set": {"operation.torque_n_m": 3000}}
    half = {**other, "share": 0.2}
    parts = {
        "tolerances": friction(count=16, replicates=4),
        "limits": [above(COAXIAL, 3000, 300)],
        "hours_per_year": 8000,
    }
    *_, once = solved(coupling(cases=[one, other], **parts))
    *_, twice = solved(coupling(cases=[one, half, half], **parts))
    assert once["limits"][0].pop("decides") == [0.0, 1.0]
    assert twice["limits"][0].pop("decides") == [0.0, 0.5, 0.5]
    assert twice["limits"] == once["limits"]
    assert twice["cases"][0] == once["cases"][0]
    assert {**twice["cases"][2], "share": 0.4} == once["cases"][1]
    mean, again = (end["outputs"][COAXIAL] for end in (once, twice))
    assert again["mean"] == pytest.approx(mean["mean"], rel=1e-14)
    assert again["max"]["value"] == mean["max"]["value"]


def test_the_same_machine_runs_every_case() -> None:
    """The helix slope of a machine makes one case worse and the other case better."""
    # A machine is therefore bad in one case or in the other case, but rarely in both.
    cases = [{"set": {"modifications.in_plane_deviation_um": each}} for each in (80.0, -80.0)]
    tolerances = {"inputs": [SLOPE], "count": 16, "replicates": 4}
    limit = above(PRESSURE, 1690.0, 25.0)
    header, *points, end = solved(loads(cases=cases, tolerances=tolerances, limits=[limit], points=True))
    for one, other in zip(points[::2], points[1::2], strict=True):
        assert one["at"]["modifications.helix_slope_um"] == other["at"]["modifications.helix_slope_um"]
    up, down = (np.array([point["out"][0] for point in points[case::2]]) for case in (0, 1))
    assert np.corrcoef(up, down)[0, 1] < -0.9
    alone = [case["limits"][0]["probability"] for case in end["cases"]]
    (spectrum,) = end["limits"]
    assert max(alone) < spectrum["probability"] < sum(alone)
    by_hand = norm.cdf((np.maximum(up, down) - 1690.0) / 25.0).mean()
    independent = norm.cdf((np.maximum(up, np.roll(down, 7)) - 1690.0) / 25.0).mean()
    assert spectrum["probability"] == pytest.approx(by_hand, rel=1e-12)
    assert abs(independent - by_hand) > 0.01
    assert sum(spectrum["decides"]) == pytest.approx(1.0)
    assert min(spectrum["decides"]) > 0.2
    assert header["total"] == 128


def test_a_draw_without_solution_is_never_lost() -> None:
    """Teeth that are too high do not mesh."""
    # Draws with such teeth are counted, and the probability lies between two bounds.
    high = {"path": "gears.pinion.addendum", "distribution": "uniform", "min": 1.0, "max": 3.0}
    tolerances = {"inputs": [high], "count": 16, "replicates": 2}
    _, *points, end = solved(loads(cases=[{}], tolerances=tolerances, limits=[above(PRESSURE, 1e5, 1.0)], points=True))
    refused = sum(point["status"] == "refused" for point in points)
    assert 0 < refused < 32
    assert end["counts"]["refused"] == refused
    assert sum(end["errors"].values()) == refused
    assert end["cases"][0]["unsolved"] == end["limits"][0]["unsolved"] == pytest.approx(refused / 32)
    assert end["limits"][0]["probability"] is None
    assert end["limits"][0]["bounds"] == [0.0, pytest.approx(refused / 32)]
    assert end["limits"][0]["risk"] is None, "a pressure has no risk of scuffing"


def test_every_point_without_a_value_is_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    """A machine without a value of the output counts as bad only in the upper bound of the probability."""
    # The point may be refused, failed, without solution, or solved without this output.
    ends = [
        Point("ok", [1.0], []),
        Point("ok_with_warnings", [9.0], ["some"]),
        Point("ok", [None], []),
        Point("no_solution", [5.0], []),
        Point("refused", [None], [], {"pointer": "", "code": "no_mesh", "message": ""}),
        Point("failed", [None], [], {"pointer": "", "code": "worker_lost", "message": ""}),
        Point("ok", [2.0], []),
        Point("ok", [3.0], []),
    ]
    left = iter(ends)
    monkeypatch.setattr("app.studies.points.solve_point", lambda *_: next(left))
    *_, end = solved(coupling(tolerances=friction(count=4, replicates=2), limits=[above(COAXIAL, 8.0)]))
    assert end["counts"] == {"failed": 1, "no_solution": 1, "ok": 4, "ok_with_warnings": 1, "refused": 1}
    assert sum(end["counts"].values()) == end["points"] == 8
    (limit,) = end["limits"]
    assert limit["unsolved"] == end["cases"][0]["unsolved"] == 4 / 8
    assert limit["probability"] is None
    assert limit["bounds"] == [1 / 8, 5 / 8]


def test_nothing_solved() -> None:
    *_, end = solved(loads(cases=[{"set": {"gears.pinion.addendum": 3.0}}], limits=[above(PRESSURE, 1e3)]))
    assert end["limits"][0]["bounds"] == [0.0, 1.0]
    assert end["limits"][0]["decides"] is None
    assert end["outputs"][PRESSURE] == dict.fromkeys(("mean", "standard_error", "interval", "min", "max"))


def test_means_energy_and_extremes() -> None:
    cases = [
        {"share": 0.25, "set": {"operation.speed_rpm": 1000}},
        {"share": 0.75, "set": {"operation.speed_rpm": 2000}},
    ]
    power = "losses.friction_power_w"
    *_, end = solved(coupling(cases=cases, outputs=[power], hours_per_year=8000))
    first, second = (case["means"][power] for case in end["cases"])
    found = end["outputs"][power]
    assert found["mean"] == pytest.approx(0.25 * first + 0.75 * second)
    assert found["energy_kwh_per_year"] == pytest.approx(found["mean"] * 8.0)
    assert (found["min"]["value"], found["min"]["case"], found["min"]["draw"]) == (first, 0, 0)
    assert found["max"]["at"] == {"operation.speed_rpm": 2000}


def scuffing() -> dict[str, Any]:
    return {**few_draws("scuffing"), "cases": [{"set": {"load.power_kw": 7000}}, {}]}


def few_draws(example: str) -> dict[str, Any]:
    """Example of a spectrum, reduced to 2 replicates of 2 draws. Two replicates still give a standard error."""
    draws = {"tolerances.count": 2, "tolerances.replicates": 2}
    return changed(study_bodies("/v1/spectrum")[example]["value"], draws)


def test_the_scuffing_temperature_is_the_limit_where_none_is_given() -> None:
    *_, end = solved(scuffing())
    (limit,) = end["limits"]
    assert limit["output"] == "contact_temperature.blok_max_c"
    assert limit["side"] == "above"
    assert limit["deviation"] == pytest.approx(0.15 * limit["mean"])
    (assumption,) = [each for each in end["assumptions"] if each["field"] == "limits"]
    assert "AGMA 925-A03" in assumption["reason"]
    own = evaluate(
        SCUFFING, SCUFFING.request.model_validate({**STAGE.request, "model": {"lubrication": "closed_form"}})
    )
    assert limit["mean"] == pytest.approx(own.safety.scuffing_c)
    assert end["notes"] == []


def test_the_thermal_film_is_left_out_where_no_output_needs_it() -> None:
    body = changed(scuffing(), {"request.model.path_points": 5})
    assert "lubrication" not in body["request"]["model"]
    light, whole = planned(body), planned({**body, "outputs": ["film.thickness_ratio"]})
    assert light.question.base["model"]["lubrication"] == "closed_form"
    assert "lubrication" not in whole.question.base["model"]
    requests = (light.question.base, body["request"])
    own, film = (evaluate(SCUFFING, SCUFFING.request.model_validate(request)) for request in requests)
    for path in light.question.outputs:
        assert value_at(own, path) == value_at(film, path)


def test_a_scuffing_temperature_that_differs_between_cases_is_said() -> None:
    cases = [{"set": {}}, {"set": {"temperatures.scuffing_test.fzg_stage": 10}}]
    *_, end = solved({**scuffing(), "cases": cases})
    (note,) = end["notes"]
    assert "not the same in all cases" in note
    *_, alone = solved({**scuffing(), "cases": cases[1:]})
    assert end["cases"][1]["limits"] == alone["cases"][0]["limits"]
    assert STAGE.request["temperatures"]["scuffing_test"]["fzg_stage"] < 10
    assert end["limits"][0]["decides"] == [1.0, 0.0], "the lower stage, at equal contact temperatures"


def test_machines_with_scuffing_temperatures_of_their_own_are_judged_by_these() -> None:
    body = scuffing()
    body["request"]["temperatures"].pop("scuffing_test")
    body["tolerances"]["inputs"] = [
        {"path": "temperatures.scuffing_c", "distribution": "normal", "mean": 300, "deviation": 30}
    ]
    body |= {"outputs": ["contact_temperature.blok_max_c"], "cases": [{}], "points": True}
    _, *points, end = solved(body)
    drawn, reached = np.array([(line["at"]["temperatures.scuffing_c"], line["out"][0]) for line in points]).T
    (limit,) = end["limits"]
    assert limit["mean"] == pytest.approx(np.median(drawn))
    assert limit["probability"] == pytest.approx(norm.cdf((reached - drawn) / (0.15 * drawn)).mean())


def test_stages_of_a_test_are_listed_with_their_weights() -> None:
    body = scuffing() | {"cases": [{}], "points": True}
    stage = "temperatures.scuffing_test.fzg_stage"
    body["tolerances"] = {"count": 8, "replicates": 1, "inputs": [scatter_of(stage, values=[10, 12], weights=[1, 3])]}
    header, *points, end = solved(body)
    stages = [line["at"][stage] for line in points]
    assert sorted(set(stages)) == [10, 12]
    assert stages.count(12) == 6  # a Sobol sample of eight is even
    assert header["tolerances"]["inputs"][0]["cut_off"] == 0.0
    single = {**body, "tolerances": None, "points": False}
    alone = [solved(changed(single, {f"request.{stage}": value}))[-1]["limits"][0]["probability"] for value in (10, 12)]
    assert end["limits"][0]["probability"] == pytest.approx((alone[0] + 3 * alone[1]) / 4)


def test_grades_of_an_oil_are_listed_and_whose_stage_counts_is_said() -> None:
    body = scuffing() | {"cases": [{}], "points": True}
    grades = scatter_of("lubricant.iso_vg", values=[150, 220], weights=[1, 3])
    body["tolerances"] = {"count": 8, "replicates": 1, "inputs": [grades]}
    body["request"]["lubricant"] = {"iso_vg": 220}
    _, *points, end = solved(body)
    drawn = [line["at"]["lubricant.iso_vg"] for line in points]
    assert (drawn.count(150), drawn.count(220)) == (2, 6)
    assert any("belongs to the oil of the case" in note for note in end["notes"])
    own = {
        **body["tolerances"],
        "inputs": [scatter_of("temperatures.scuffing_test.fzg_stage", values=[10, 12]), grades],
    }
    assert not any("belongs to the oil" in note for note in solved({**body, "tolerances": own})[-1]["notes"])


def test_risk_in_words_belongs_to_the_scuffing_temperature() -> None:
    *_, end = solved({**scuffing(), "cases": [{}]})
    (own,) = end["limits"]
    assert own["risk"] in {"low", "moderate", "high"}
    stated = {"value": own["mean"]}
    others = [{"value": 60.0}, {"value": own["mean"] + 5.0}]
    limits = [{"output": own["output"], "above": each} for each in (stated, *others)]
    limits.append({"output": own["output"], "below": stated})
    *_, end = solved({**scuffing(), "cases": [{}], "tolerances": None, "limits": limits})
    assert [limit["risk"] is None for limit in end["limits"]] == [False, True, True, True]
    assert [limit["risk"] is None for limit in end["cases"][0]["limits"]] == [False, True, True, True]
    *_, end = solved(coupling(limits=[above(COAXIAL, 3000, 100)]))
    assert end["limits"][0]["risk"] is end["cases"][0]["limits"][0]["risk"] is None


def scatter_of(path: str, **numbers: Any) -> dict[str, Any]:
    return {"path": path, "distribution": "listed", **numbers}


def test_a_tolerance_that_the_model_does_not_use_is_said() -> None:
    """The stage computes its friction from the oil."""
    # A tolerance of the coefficient of friction therefore changes nothing, and a note says so.
    body = scuffing()
    drawn = {"path": "friction_coefficient", "distribution": "lognormal", "median": 0.05, "factor": 1.3}
    body["tolerances"]["inputs"].append(drawn)
    *_, end = solved(body)
    (note,) = end["notes"]
    assert note.startswith(
        "the tolerance of friction_coefficient has no effect; not used, because `model.friction` selects"
    )
    body["request"]["model"]["friction"] = "given"
    *_, end = solved(body)
    assert end["notes"] == []


def test_no_limit_without_a_scuffing_temperature() -> None:
    body = scuffing()
    body["request"]["temperatures"].pop("scuffing_test")
    *_, end = solved(body)
    assert end["limits"] == []
    assert "no scuffing temperature" in end["notes"][0]
    *_, end = solved({**scuffing(), "limits": []})
    assert end["limits"] == end["notes"] == []


def test_equal_seeds_give_equal_bytes() -> None:
    body = coupling(tolerances=friction(count=8, replicates=2), limits=[above(COAXIAL, 3000)])
    first, second, other = solved(body), solved(body, slots=3), solved(coupling(tolerances=friction(count=8, seed=2)))
    assert json.dumps(first) == json.dumps(second)
    assert first[-1]["outputs"] != other[-1]["outputs"]


def test_replicates_are_independent_samples() -> None:
    study = planned(coupling(tolerances=friction(count=8, replicates=3)))
    samples = study.machines.reshape(3, 8)
    assert len({tuple(sorted(sample)) for sample in samples}) == 3
    for sample in samples:  # one point in each eighth of the distribution
        assert sorted(np.floor(8 * norm.cdf((sample - 0.2) / 0.02)).astype(int)) == list(range(8))


def test_a_gear_unit_with_temperatures_of_its_own_in_each_case() -> None:
    header, *points, end = solved({**few_draws("drive_train"), "points": True})
    contact = [each["path"] for each in header["outputs"]].index("flash.contact_max_c")
    full, half = (np.array([line["out"][contact] for line in points if line["case"] == case]) for case in (0, 1))
    assert (full > half + 10.0).all()
    assert end["limits"][0]["output"] == "flash.contact_max_c"
    assert (end["limits"][0]["mean"], end["limits"][0]["deviation"]) == (pytest.approx(220.0), pytest.approx(33.0))
    assert end["limits"][0]["decides"] == [1.0, 0.0]
    assert end["cases"][0]["limits"][0]["probability"] == pytest.approx(norm.cdf((full - 220) / 33).mean())


def scatter(path: str, distribution: str, **numbers: Any) -> dict[str, Any]:
    return {"tolerances": {"inputs": [{"path": path, "distribution": distribution, **numbers}]}}


FIRST = "/tolerances/inputs/0"


@pytest.mark.parametrize(
    ("change", "pointer", "code"),
    [
        ({"cases": []}, "/cases", "too_short"),
        ({"cases": [{"share": 0.5}, {}]}, "/cases", "shares"),
        ({"cases": [{"share": 0.5}, {"share": 0.4}]}, "/cases", "shares"),
        ({"cases": [{"share": -0.5}]}, "/cases/0/share", "greater_than_equal"),
        ({"cases": [{}] * 101}, "/cases", "too_long"),
        ({"cases": [{"set": {"operation.sped_rpm": 1}}]}, "/cases/0/set", "unknown_path"),
        ({"cases": [{"set": {}}, {"set": {"operation.speed_rpm": 1e9}}]}, "/cases/1/set", "out_of_range"),
        ({"cases": [{"set": {MU: 0.1}}], "tolerances": friction()}, f"{FIRST}/path", "duplicate_path"),
        ({"tolerances": friction(count=100)}, "/tolerances/count", "not_power_of_two"),
        ({"tolerances": friction(inputs=[])}, "/tolerances/inputs", "too_short"),
        ({"tolerances": {"inputs": [{"path": MU}]}}, FIRST, "union_tag_not_found"),
        (scatter(MU, "beta"), FIRST, "union_tag_invalid"),
        (scatter(MU, "normal", mean=0.2, deviation=0), f"{FIRST}/deviation", "greater_than"),
        (scatter(MU, "normal", mean=-1, deviation=1), f"{FIRST}/mean", "out_of_range"),
        (scatter(MU, "triangular", min=0, mode=2, max=1), FIRST, "out_of_range"),
        (scatter(MU, "normal", mean=0.2, deviation=1e300), f"{FIRST}/deviation", "out_of_range"),
        (scatter("coupling.teeth", "uniform", min=20, max=30), FIRST, "not_integer"),
        (scatter("coupling.teeth", "listed", values=[20, 30.5]), f"{FIRST}/values/1", "not_integer"),
        (scatter("coupling.teeth", "listed", values=[20, 1e9]), f"{FIRST}/values/1", "out_of_range"),
        (scatter("coupling.teeth", "listed", values=[]), f"{FIRST}/values", "too_short"),
        (scatter("coupling.teeth", "listed", values=[20], weights=[1, 2]), f"{FIRST}/weights", "weights"),
        (scatter("coupling.teeth", "listed", values=[20], weights=[0]), f"{FIRST}/weights/0", "greater_than"),
        ({"tolerances": friction(model_uncertainty="yes")}, "/tolerances/model_uncertainty", "bool_type"),
        (scatter("model.sleeve", "uniform", min=0, max=1), f"{FIRST}/path", "not_continuous"),
        ({"limits": [{"output": COAXIAL}]}, "/limits/0", "above_or_below"),
        ({"limits": [{"output": COAXIAL, "above": {"mean": 2}}]}, "/limits/0/above", "value_or_mean"),
        ({"limits": [above("lubrication.regime.area", 1)]}, "/limits/0/output", "unknown_output"),
        ({"outputs": ["lubrication.regime.area"]}, "/outputs/0", "unknown_output"),
        ({"hours_per_year": 1e9}, "/hours_per_year", "less_than_equal"),
        ({"endpoint": "/v1/nothing"}, "/endpoint", "unknown_endpoint"),
    ],
)
def test_refusals(change: dict[str, Any], pointer: str, code: str) -> None:
    assert fault_of(Spectrum, coupling(**change))[:2] == (pointer, code)


def test_shares_are_normalised() -> None:
    found = planned(coupling(cases=[{"share": 0.5}, {"share": 0.495}])).cases
    assert [case.share for case in found] == pytest.approx([0.502513, 0.497487], abs=1e-6)
    assert [case.share for case in planned(coupling(cases=[{}, {}, {}, {}])).cases] == [0.25] * 4


def test_a_study_of_too_many_solutions_is_refused_with_an_estimate() -> None:
    body = coupling(tolerances=friction(count=1024, replicates=100))
    pointer, code, message = fault_of(Spectrum, body, most=20_000)
    assert (pointer, code) == ("/tolerances/count", "too_many_points")
    assert "is 102400, but at most 20000 are allowed" in message
    assert " s on one core" in message


def test_distributions_of_a_sample() -> None:
    """The random sample of a sweep accepts the same distributions as a spectrum."""
    sample = sampled(method="sobol", **friction())
    assert sample.mean() == pytest.approx(0.2, abs=1e-3)
    assert sample.std() == pytest.approx(0.02, abs=1e-3)
    ends = {"path": MU, "min": 0.1, "max": 0.3}
    assert np.array_equal(sampled(ranges=[ends]), sampled(inputs=[{**ends, "distribution": "uniform"}]))


def sampled(**parts: Any) -> FloatArray:
    body = study_of("pahl-axial-displacement", sample={"count": 64, **parts})
    return np.array(Sweep(body, 2500, 30.0).points.rows)
