"""The price of a tolerance: equal draws for every class, scatter to zero gives the fixed design, brute force agrees."""

from typing import Any

import numpy as np
import pytest
from scipy.stats import norm

from app.calculations import BY_PATH
from app.evaluate import evaluate
from app.examples import examples
from app.schema.fields import value_at
from app.studies.kinds.design import Design
from app.studies.machines import MachineDraws, Machines
from app.studies.points import BaseRequest, with_overrides
from app.studies.price import Damage, coarsest, influences, of_class, probability
from app.studies.requests import DRIVE_TRAIN
from solvers.arrays import FloatArray
from tests.support.properties import seeds
from tests.support.requests import GONE, changed
from tests.support.studies import fault_of, lines_of

CALCULATION = BY_PATH[DRIVE_TRAIN]
UNIT = examples()["starter-turbo-gear-drive-train"].request
HEATED = examples()["starter-turbo-gear-heat"].request
SLOPE, PROFILE = "modifications.helix_slope_um", "modifications.profile_slope_um"
HELIX = {"path": SLOPE, "min": 0.0, "max": 100.0}
ALONE = {"uncertain": [], "model_uncertainty": False}  # nothing but the flanks scatters
SCUFFING = [Damage("scuffing", ("contact", "limit"))]
BOTH = [*SCUFFING, Damage("micropitting", ("safety",))]


def designed(request: dict[str, Any] = UNIT, **parts: Any) -> list[dict[str, Any]]:
    body = {"request": request, "variables": [HELIX], "objective": "safety.blok_flank", "evaluations": 1, **parts}
    return lines_of(Design(body, 2500, 30.0))


def machines(request: dict[str, Any] = UNIT, **given: Any) -> Machines:
    return Machines(MachineDraws(**given), BaseRequest(CALCULATION, request), {}, {SLOPE}, "tolerances")


def values(contact: FloatArray, limit: float = 200.0, safety: float = 9.0) -> FloatArray:
    """Outputs of machines `[replicate, draw, case, output]` from contact temperatures `[replicate, draw]`."""
    own = [contact, np.full_like(contact, limit), np.full_like(contact, safety)]
    return np.stack(own, axis=-1)[:, :, None, :]


def test_every_class_and_correction_meets_the_same_draws() -> None:
    drawn = machines(count=8, replicates=2)
    assert drawn.total == 32
    for draw in range(drawn.total):
        rows = [drawn.overrides(draw, each, {SLOPE: 40.0}) for each in (None, 3, 7)]
        others = [{path: value for path, value in row.items() if path not in drawn.slopes} for row in rows]
        assert others[0] == others[1] == others[2]
        off = [float(row[SLOPE]) - 40.0 for row in rows]
        assert off[0] == 0.0
        widths = [drawn.tolerances[each][SLOPE] for each in (3, 7)]
        assert off[1] / widths[0] == pytest.approx(off[2] / widths[1])
        moved = drawn.overrides(draw, 7, {SLOPE: 10.0})
        assert float(moved[SLOPE]) - 10.0 == pytest.approx(off[2])
        twin = drawn.overrides(draw ^ 1, 7, {SLOPE: 40.0})
        assert float(twin[SLOPE]) - 40.0 == pytest.approx(-off[2])
        assert {path: twin[path] for path in others[0]} == others[0]
    scores = np.array([float(drawn.overrides(draw, 7, {SLOPE: 0.0})[SLOPE]) for draw in range(32)])
    assert scores.std() == pytest.approx(drawn.tolerances[7][SLOPE] / 3, rel=0.15)


def test_machines_lie_between_the_usual_corners() -> None:
    drawn = machines(count=16, replicates=1)
    rows = [drawn.overrides(2 * pair, None, {}) for pair in range(16)]
    responses = [float(row["thermal.wall_response"]) for row in rows]
    assert 0.3 <= min(responses) < 0.35
    assert 0.95 < max(responses) <= 1.0
    offsets = {(row["couplings.0.offset_um.0"], row["couplings.0.offset_um.1"]) for row in rows}
    assert offsets == {(0.0, 400.0), (-400.0, 0.0), (0.0, -400.0), (400.0, 0.0)}
    clearances = np.array(
        [[float(row[f"pinion_shaft.bearings.{k}.radial_clearance_um"]) for k in (0, 1)] for row in rows]
    )
    assert clearances.sum(axis=1) == pytest.approx(260.0)


def test_what_varies_elsewhere_is_not_drawn() -> None:
    response = {"path": "thermal.wall_response", "min": 0.3, "max": 0.9}
    study = Design({"request": UNIT, "variables": [response], "tolerances": {}}, 2500, 30.0)
    assert study.pricing is not None
    assert "wall response" not in study.pricing.machines.axes
    cooled = machines(
        HEATED, inputs=[{"path": "cooling.wetting_share", "distribution": "uniform", "min": 0.3, "max": 0.6}]
    )
    assert [each.path for each in cooled.scatters].count("cooling.wetting_share") == 1


def test_the_class_of_the_gears_judges_corrections() -> None:
    assert machines(changed(UNIT, {"gears.quality_class": 6})).reference == 6
    assert machines(UNIT).reference == 5
    assert machines(UNIT, classes=[8, 7, 9]).reference == 8


@pytest.mark.parametrize(
    ("tolerances", "pointer", "code"),
    [
        ({"count": 100}, "/tolerances/count", "not_power_of_two"),
        ({"count": 0}, "/tolerances/count", "greater_than_equal"),
        ({"classes": []}, "/tolerances/classes", "too_short"),
        ({"classes": [12]}, "/tolerances/classes/0", "less_than_equal"),
        ({"classes": ["5"]}, "/tolerances/classes/0", "number_type"),
        ({"replicates": 1e9}, "/tolerances/replicates", "less_than_equal"),
        ({"count": 64}, "/tolerances/count", "too_many_points"),
        ({"uncertain": [{"path": SLOPE, "values": [1, 2]}]}, "/tolerances/uncertain", "duplicate_path"),
        ({"uncertain": [{"path": "no.such", "values": [1]}]}, "/tolerances/uncertain/0/path", "unknown_path"),
        (
            {"inputs": [{"path": SLOPE, "distribution": "uniform", "min": 0, "max": 1}]},
            "/tolerances/inputs",
            "duplicate_path",
        ),
        (
            {"inputs": [{"path": "operation.power_kw", "distribution": "normal"}]},
            "/tolerances/inputs/0/mean",
            "missing",
        ),
        ({"model_uncertainty": 1}, "/tolerances/model_uncertainty", "bool_type"),
        ({"unknown": 1}, "/tolerances/unknown", "extra_forbidden"),
    ],
)
def test_refusals(tolerances: dict[str, Any], pointer: str, code: str) -> None:
    body = {"request": UNIT, "variables": [HELIX], "tolerances": tolerances}
    assert fault_of(Design, body)[:2] == (pointer, code)


def test_what_the_load_cases_set_may_be_missing_in_the_request() -> None:
    lacking = changed(UNIT, {"operation.power_kw": GONE})
    cases = [{"operation.power_kw": 12000}, {"operation.power_kw": 6000}]
    study = Design(
        {"request": lacking, "variables": [HELIX], "collective": cases, "tolerances": {"count": 1}}, 2500, 30.0
    )
    assert study.pricing is not None
    assert "operation.power_kw" not in {each.path for each in study.pricing.machines.scatters}


def test_uncertain_inputs_are_drawn_however_many_corners_they_have() -> None:
    paths = ("thermal.wall_response", "couplings.0.offset_um.0", "modifications.lead_crowning_um")
    axes = [{"path": path, "values": [k / 10 for k in range(1, 10)]} for path in paths]
    assert len(machines(uncertain=axes).axes) == 3


def test_no_probability_without_a_limit() -> None:
    bare = changed(UNIT, {"temperatures": {"oil_c": 50.0}})
    assert fault_of(Design, {"request": bare, "variables": [HELIX], "tolerances": {}})[:2] == ("/request", "no_limit")
    judged = {"request": UNIT, "variables": [HELIX], "judged_by": "luck"}
    assert fault_of(Design, judged)[0] == "/judged_by"
    tiny = changed(UNIT, {"gears.module_mm": 0.4})
    assert fault_of(Design, {"request": tiny, "variables": [HELIX], "tolerances": {}})[1] == "quality_class"


def test_the_more_probable_damage_counts() -> None:
    contact = np.array([[150.0, 160.0], [155.0, 145.0]])
    found = probability(BOTH, values(contact))
    assert found["kind"] == "scuffing"
    assert found["probability"] == pytest.approx(norm.cdf((contact - 200.0) / 30.0).mean())
    worn = probability(BOTH, values(contact, safety=1.0))
    assert (worn["kind"], worn["probability"], worn["risk"]) == ("micropitting", pytest.approx(0.5), None)
    assert worn["kinds"]["scuffing"]["probability"] == found["probability"]


def test_equal_flanks_cost_nothing_and_the_error_is_that_of_the_ratio() -> None:
    contact = np.array([[150.0, 160.0], [155.0, 145.0]])
    same = of_class(SCUFFING, values(contact), values(contact))
    assert (same["more"], same["more_error"]) == (0.0, 0.0)
    warmer = of_class(SCUFFING, values(contact + 5.0), values(contact))
    chances = [norm.cdf((each - 200.0) / 30.0).mean(axis=1) for each in (contact + 5.0, contact)]
    assert warmer["more"] == pytest.approx(chances[0].mean() / chances[1].mean() - 1.0)
    safe = of_class(SCUFFING, values(contact - 400.0), values(contact - 400.0))
    assert (safe["more"], safe["more_error"], safe["enough"]) == (0.0, 0.0, True)


def test_a_class_that_is_not_safe_is_not_enough_although_exact_flanks_are() -> None:
    contact = np.full((2, 4), 180.0)
    found = of_class(SCUFFING, values(contact), values(contact - 400.0))
    assert found["probability"] > 0.2
    assert (found["more"], found["more_error"], found["enough"]) == (None, None, False)


def test_machines_without_solution_count_as_damaged_in_the_price_as_in_its_bounds() -> None:
    contact = np.array([[150.0, 160.0], [155.0, 145.0]])
    lost = contact.copy()
    lost[0, 0] = np.nan
    chances = [probability(SCUFFING, values(each))["bounds"][1] for each in (lost, contact)]
    assert of_class(SCUFFING, values(lost), values(contact))["more"] == pytest.approx(chances[0] / chances[1] - 1.0)
    assert of_class(SCUFFING, values(lost), values(lost))["more"] == 0.0


@pytest.mark.parametrize(
    ("more", "error", "expected"),
    [
        ((0.01, 0.05, 0.2), 0.0, (4, False)),
        ((0.01, 0.2, 0.05), 0.0, (3, False)),  # a class after one that costs more does not count
        ((0.2, 0.3, 0.4), 0.0, (None, False)),
        ((0.01, 0.05, 0.12), 0.02, (4, True)),
        ((0.0, 0.0, None), 0.0, (4, False)),
        ((None, None, None), 0.0, (None, False)),
        ((0.01, 0.05, 0.4), None, (4, True)),  # a single sample does not know its error
        ((0.01, 0.055, 0.4), 0.02, (4, True)),  # 2.25 standard errors are not sure with three degrees of freedom
    ],
)
def test_the_coarsest_class_costs_less_than_a_tenth(
    more: tuple[float | None, ...], error: float | None, expected: tuple[int | None, bool]
) -> None:
    rows = [
        {
            "quality_class": 3 + place,
            "more": each,
            "more_error": error,
            "enough": each is not None and each < 0.1,
        }
        for place, each in enumerate(more)
    ]
    assert coarsest(rows, 1 if error is None else 4) == expected


def test_a_machine_without_solution_is_counted() -> None:
    contact = np.array([[150.0, np.nan], [155.0, 145.0]])
    found = probability(SCUFFING, values(contact))
    assert found["unsolved"] == 0.25
    assert found["probability"] is None
    assert found["bounds"][1] - found["bounds"][0] == pytest.approx(0.25)
    assert probability(SCUFFING, values(np.full((2, 2), np.nan)))["unsolved"] == 1.0


def test_the_input_that_dominates_comes_first() -> None:
    drawn = machines()
    varied = drawn.variations({SLOPE: 40.0})
    by_name = {each.name: each for each in varied}
    width = drawn.tolerances[5][SLOPE] * 2 / 3
    assert [row[SLOPE] for row in by_name["helix slope"].rows] == pytest.approx([40.0 - width, 40.0 + width])
    assert len(by_name["offset"].rows) == 4
    rows = [(each.name, row) for each in varied for row in each.rows]
    contact = np.array(
        [[155.0 if name == "helix slope" else 152.0 if name == "friction" else 150.0] for name, _ in rows]
    )
    first, second, *others = influences(SCUFFING, "scuffing", values(np.array([[150.0]])), values(contact), varied)
    assert (first["name"], second["name"]) == ("helix slope", "friction"), "although both sides of the slope cost"
    assert first["range"] == pytest.approx(5.0 / 30.0)
    assert first["share"] == pytest.approx(25 / 29)
    assert {each["range"] for each in others} == {0.0}


def chance_of(changes: dict[str, Any], request: dict[str, Any] = UNIT) -> float:
    """Probability of scuffing of one machine, from the answer of the calculation."""
    body = with_overrides(CALCULATION, changed(request, {"model.lubrication": "closed_form"}), changes)
    answer = evaluate(CALCULATION, CALCULATION.request.model_validate(body))
    contact, limit = (value_at(answer, path) for path in ("flash.contact_max_c", "derived.temperatures.scuffing_c"))
    return float(norm.cdf((contact - limit) / (0.15 * limit)))


def test_scatter_to_zero_gives_the_fixed_design() -> None:
    """With nothing else drawn, exact flanks have the probability of the nominal unit; so do finer and finer ones."""
    finest = [{"path": "operation.power_kw", "distribution": "normal", "mean": 12000.0, "deviation": 1e-6}]
    tolerances = {**ALONE, "count": 1, "replicates": 2, "classes": [1], "inputs": finest}
    *_, end = designed(tolerances=tolerances)
    price = end["price"]
    fixed = chance_of({})
    assert price["nominal"]["probability"] == pytest.approx(fixed, rel=1e-9)
    assert price["exact"]["probability"] == pytest.approx(fixed, rel=1e-6)
    (row,) = price["classes"]
    # Three deviations of class 1 are 3.5 µm, of class 5 14 µm: what is left falls with their square.
    assert row["probability"] == pytest.approx(fixed, rel=0.01)
    assert price["correction"] == {SLOPE: 50.0}
    assert end["evaluations"] == 1


def unit_of(rng: np.random.Generator) -> dict[str, Any]:
    changes = {
        "operation.power_kw": rng.uniform(8000, 14000),
        "operation.pinion_speed_rpm": rng.uniform(9000, 11000),
        "temperatures.oil_c": rng.uniform(45, 60),
        SLOPE: rng.uniform(10, 80),
    }
    return changed(UNIT, changes)


@seeds(4, 20, default=1)
def test_brute_force_finds_the_same_probability(rng: np.random.Generator) -> None:
    """Each drawn machine, sent to the endpoint on its own, gives the probability that the study states."""
    request, quality_class = unit_of(rng), int(rng.integers(3, 8))
    tolerances = {"count": 1, "replicates": 2, "classes": [quality_class]}
    *_, end = designed(request, tolerances=tolerances, judged_by="probability")
    drawn = machines(request, **tolerances)
    at = end["price"]["correction"]
    single = [chance_of(drawn.overrides(draw, quality_class, at), request) for draw in range(4)]
    (row,) = end["price"]["classes"]
    assert row["probability"] == pytest.approx(np.mean(single), rel=1e-9)
    assert end["objective_best"] == pytest.approx(np.mean(single[:2]), rel=1e-9), "the search judges by one sample"


@pytest.mark.parametrize("count", [pytest.param(1, marks=pytest.mark.ci), pytest.param(20, marks=pytest.mark.slow)])
def test_a_quadrature_over_both_slopes_finds_the_same_probability(count: int) -> None:
    """Nothing of the study is used: two normal slopes, of which the tolerance is three deviations, and the answers."""
    nodes, weights = np.polynomial.hermite_e.hermegauss(5)
    for seed in range(count):
        rng = np.random.default_rng([66, seed])
        request, quality_class = unit_of(rng), int(rng.integers(3, 8))
        tolerances = {**ALONE, "count": 16, "replicates": 4, "classes": [quality_class]}
        *_, end = designed(request, tolerances=tolerances)
        (row,) = end["price"]["classes"]
        means = {SLOPE: end["price"]["correction"][SLOPE], PROFILE: value_at(request, PROFILE) or 0.0}
        helix, profile = (
            [{path: means[path] + node * row["tolerances"][path.partition(".")[2]] / 3} for node in nodes]
            for path in means
        )
        grid = [[chance_of(one | other, request) for other in profile] for one in helix]
        expected = weights @ np.array(grid) @ weights / weights.sum() ** 2
        assert row["probability"] == pytest.approx(expected, rel=0.02, abs=4 * row["standard_error"]), seed


@pytest.mark.ci
def test_the_least_probable_correction_beats_the_one_described() -> None:
    header, *_, end = designed(
        judged_by="probability", evaluations=12, tolerances={"count": 4, "replicates": 1, "classes": [5]}
    )
    assert header["objective"]["path"] == "probability"
    assert (header["direction"], header["corners"], header["quality_class"]) == ("minimise", 8, 5)
    assert end["objective_best"] < end["objective_start"]
    price = end["price"]
    assert price["classes"][0]["probability"] == pytest.approx(end["objective_best"])
    assert price["as_described"]["probability"] == pytest.approx(end["objective_start"])
