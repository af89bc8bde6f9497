"""The studies of corners and of the best design use the endpoint's own answers, and refuse faulty bodies."""

from collections.abc import Callable
from itertools import chain, product
from typing import Any

import numpy as np
import pytest

from app.calculations import BY_PATH
from app.evaluate import evaluate
from app.examples import examples
from app.schema.fields import value_at
from app.studies.kinds.corners import Corners
from app.studies.kinds.design import Design, next_place
from app.studies.kinds.sweep import Sweep
from app.studies.points import reduced_request, with_overrides
from app.studies.requests import DRIVE_TRAIN
from app.studies.runner import Pool
from solvers.arrays import FloatArray
from solvers.errors import NoSolution
from tests.support import studies
from tests.support.pools import InlinePool
from tests.support.requests import changed
from tests.support.studies import Planner, fault_of, timeless

UNIT = BY_PATH["/v1/drive-train"]
TURBO = examples()["starter-turbo-gear-drive-train"].request
CLOSED = {**TURBO, "model": {**TURBO.get("model", {}), "lubrication": "closed_form"}}
FRICTION = {"path": "couplings.0.friction.coefficient", "values": [0.05, 0.25]}
RESPONSE = {"path": "thermal.wall_response", "values": [0.3, 1.0]}
OFFSETS = ["couplings.0.offset_um.0", "couplings.0.offset_um.1"]
CONVERGENCE = ["convergence.iterations", "convergence.residual_um"]
K, SAFETY = "load.face_load_factor", "safety.blok_flank"
BEARING = "pinion_shaft.bearings.0"
FILM = [f"{BEARING}.{name}" for name in ("viscosity_pa_s", "radial_clearance_um", "width_mm")]
CARRIES, TOO_THIN = [0.014, 130, 110], [1e-5, 1000, 20]
HELIX = {"path": "modifications.helix_slope_um", "min": 0, "max": 100}


def lines_of(planner: Planner, pool: Pool | None = None, **body: Any) -> list[dict[str, Any]]:
    return studies.lines_of(planner({"request": CLOSED, **body}, 2500, 30.0), pool)


def answered(overrides: dict[str, Any], outputs: list[str], base: dict[str, Any] = CLOSED) -> list[Any]:
    """Return the values that the endpoint itself gives for these outputs, if `overrides` change the base request."""
    found = evaluate(UNIT, UNIT.request.model_validate(with_overrides(UNIT, base, overrides)))
    return [value_at(found, path) for path in outputs]


def test_corners_are_the_units_own_answers() -> None:
    ranges = [{"path": OFFSETS, "values": [[0, 400], [0, -400]]}, RESPONSE]
    header, *points, of_factor, of_safety, end = lines_of(Corners, ranges=ranges, outputs=[K, SAFETY])
    assert header["type"] == "corners"
    assert header["total"] == len(points) == end["points"] == 4
    assert [axis["path"] for axis in header["axes"]] == [OFFSETS, RESPONSE["path"]]
    corners = [
        {OFFSETS[0]: 0, OFFSETS[1]: offset, RESPONSE["path"]: response}
        for offset in (400, -400)
        for response in (0.3, 1.0)
    ]
    assert [point["out"] for point in points] == [answered(corner, [K, SAFETY]) for corner in corners]
    for column, line in enumerate((of_factor, of_safety)):
        values = [point["out"][column] for point in points]
        assert (line["type"], line["output"]) == ("extremes", (K, SAFETY)[column])
        assert line["min"] == {"value": min(values), "at": corners[int(np.argmin(values))]}
        assert line["max"] == {"value": max(values), "at": corners[int(np.argmax(values))]}
    assert (end["counts"], end["warnings"]) == ({"ok_with_warnings": 4}, [])


def test_corners_go_on_with_the_same_lines() -> None:
    body = {"ranges": [FRICTION, RESPONSE], "outputs": [K]}
    whole, rest = (lines_of(Corners, **body, **more) for more in ({}, {"from_index": 2}))
    assert rest[0] == {**whole[0], "from_index": 2}
    assert rest[1:3] == whole[3:5]
    assert rest[-1]["points"] == 2


@pytest.mark.ci
def test_studies_say_the_same_on_any_number_of_processes() -> None:
    for planner, body in (
        (Corners, {"ranges": [FRICTION, RESPONSE], "outputs": [K]}),
        (Design, {"variables": [HELIX], "corners": [FRICTION], "objective": SAFETY, "evaluations": 3}),
    ):
        first, *others = (timeless(lines_of(planner, InlinePool(slots), **body)) for slots in (1, 3))
        assert all(other == first for other in others)


def test_the_usual_corners() -> None:
    points = Corners({"request": TURBO}, 2500, 30.0).points
    assert points.total == 128
    assert [(axis.path, axis.values) for axis in points.axes] == [
        ("thermal.wall_response", [0.3, 1.0]),
        ([f"pinion_shaft.bearings.{k}.radial_clearance_um" for k in (0, 1)], [[143.0, 117.0], [117.0, 143.0]]),
        ([f"wheel_shaft.bearings.{k}.radial_clearance_um" for k in (0, 1)], [[165.0, 135.0], [135.0, 165.0]]),
        ("couplings.0.friction.coefficient", [0.05, 0.25]),
        (OFFSETS, [[0.0, 400.0], [-400.0, 0.0], [0.0, -400.0], [400.0, 0.0]]),
        ("couplings.0.thrust_fraction", [0.0, 1.0]),
    ]
    generator = examples()["starter-generator-gear-drive-train"].request
    named = [axis.path for axis in Corners({"request": generator}, 2500, 30.0).points.axes]
    assert not [path for path in named if "clearance" in str(path)], "springs have no clearance"


@pytest.mark.parametrize("every", [pytest.param(29, marks=pytest.mark.ci), pytest.param(1, marks=pytest.mark.slow)])
def test_all_corners_converge_with_bearing_films_of_finite_width(every: int) -> None:
    """Of 288 corners of the turbo unit, none takes more than one iteration more than with short bearings."""
    axes: dict[tuple[str, ...], list[tuple[float, ...]]] = {
        ("couplings.0.friction.coefficient",): [(0.05,), (0.15,), (0.25,)],
        tuple(OFFSETS): [(0.0, 400.0), (-400.0, 0.0), (0.0, -400.0), (400.0, 0.0)],
        ("couplings.0.thrust_fraction",): [(0.0,), (0.5,), (1.0,)],
        ("thermal.wall_response",): [(0.3,), (1.0,)],
        tuple(f"pinion_shaft.bearings.{k}.radial_clearance_um" for k in (0, 1)): [(143.0, 117.0), (117.0, 143.0)],
        tuple(f"wheel_shaft.bearings.{k}.radial_clearance_um" for k in (0, 1)): [(165.0, 135.0), (135.0, 165.0)],
    }
    corners = list(product(*axes.values()))
    assert len(corners) == 288
    names = [name for group in axes for name in group]
    for corner in corners[::every]:
        overrides = dict(zip(names, chain(*corner), strict=True))
        steps, residual = {}, 0.0
        for film in ("finite", "short"):
            steps[film], residual = answered({**overrides, "model.bearing_film": film}, CONVERGENCE)
            assert residual < 1e-6, (film, overrides)
        assert steps["finite"] <= steps["short"] + 1, (steps, overrides)


def test_corners_without_answer_are_told_and_left_out() -> None:
    """One corner has a film too thin for its load."""
    # Two further corners have both bearings of the pinion at one place. Only the remaining corner counts for the
    # extremes.
    far = {"path": "pinion_shaft.bearings.1.position_mm", "values": [620, 220]}
    thin = {"path": FILM, "values": [CARRIES, TOO_THIN]}
    header, *points, extremes, end = lines_of(Corners, ranges=[far, thin], outputs=[K])
    assert [point["status"] for point in points] == ["ok_with_warnings", "no_solution", "refused", "refused"]
    assert points[1]["warnings"] == ["journal"]
    assert points[2]["error"]["code"] == "bearing_order"
    assert extremes["min"] == extremes["max"]
    assert extremes["min"]["value"] == points[0]["out"][0]
    (warning,) = end["warnings"]
    assert warning["code"] == "no_convergence_of_corner"
    assert warning["message"].startswith("3 combinations")
    assert header["total"] == 4


def test_only_what_is_asked_is_calculated() -> None:
    both = {**TURBO, "states": ["hot", "cold"], "model": {"lubrication": "thermal_ehl", "feature_points": 21}}
    for outputs, film, states in (
        ([K, SAFETY], "closed_form", None),
        (["safety.minimum"], "thermal_ehl", None),
        (["states.cold.safety.blok_flank"], "closed_form", ["hot", "cold"]),
        (["states.cold.safety.thermal_ehl_feature"], "thermal_ehl", ["hot", "cold"]),
    ):
        light = reduced_request(DRIVE_TRAIN, both, outputs)
        assert light["model"] == {"lubrication": film, "feature_points": 21}
        assert light.get("states") == states
    assert both["states"] == ["hot", "cold"], "the request itself stays"
    light = reduced_request(DRIVE_TRAIN, {**TURBO, "states": ["hot", "cold"]}, [K, SAFETY])
    assert answered({}, [K, SAFETY], light) == answered({}, [K, SAFETY], TURBO)


def test_a_design_is_judged_at_its_worst_corner() -> None:
    powers: list[dict[str, Any]] = [{"operation.power_kw": 12000}, {"operation.power_kw": 6000}]
    header, *trials, end = lines_of(
        Design, variables=[HELIX], corners=[FRICTION], collective=powers, objective=SAFETY, evaluations=3
    )
    assert (header["type"], header["direction"], header["corners"]) == ("design", "maximise", 4)
    title = "safety factor on the flank (flash temperature method)"
    assert header["objective"] == {"path": SAFETY, "unit": None, "title": title}
    assert header["variables"] == [{"path": [HELIX["path"]], "unit": "µm", "min": 0.0, "max": 100.0}]
    cases = [{**power, FRICTION["path"]: friction} for power in powers for friction in (0.05, 0.25)]
    for trial in (trials[0], trials[-1]):
        values = [answered({**trial["at"], **case}, [SAFETY])[0] for case in cases]
        assert trial["objective"] == min(values)
        assert trial["worst_corner"] == cases[int(np.argmin(values))]
    assert end["start"] == trials[0]["at"] == {HELIX["path"]: 50.0}
    assert end["objective_start"] == trials[0]["objective"]
    best = max(trials, key=lambda trial: trial["objective"])
    assert (end["best"], end["objective_best"]) == (best["at"], best["objective"])
    assert end["worst_corner"] == best["worst_corner"]
    assert end["evaluations"] == len(trials) == len(end["history"]) == 3
    assert [each["objective"] for each in end["history"]] == [trial["objective"] for trial in trials]


def test_the_best_correction_in_whole_steps_is_judged_at_its_own_worst_corner() -> None:
    """No grinder uses steps of 0.7 um. But a result that is a multiple of this unusual step must have been rounded."""
    body = {"corners": [FRICTION], "objective": SAFETY, "evaluations": 3}
    plain = lines_of(Design, variables=[HELIX], **body)
    stepped = lines_of(Design, variables=[{**HELIX, "step": 0.7}], **body)
    rounded = stepped[-1].pop("rounded")
    assert timeless(stepped[1:]) == timeless(plain[1:])
    best, slope = plain[-1]["best"][HELIX["path"]], rounded["at"][HELIX["path"]]
    assert slope == pytest.approx(0.7 * round(best / 0.7), abs=1e-9)
    cases: list[dict[str, Any]] = [{str(FRICTION["path"]): friction} for friction in (0.05, 0.25)]
    values = [answered({str(HELIX["path"]): slope, **case}, [SAFETY])[0] for case in cases]
    assert rounded["objective"] == min(values)
    assert rounded["worst_corner"] == cases[int(np.argmin(values))]


def search(judge: Callable[[FloatArray], FloatArray | None], start: list[float], most: int) -> list[list[float]]:
    """Run a whole search with at most `most` evaluations, and return the evaluated points in order."""
    places: list[list[float]] = []
    told: list[list[float] | None] = []
    place: list[float] | None = start
    while place is not None:
        found = judge(np.array(place))
        places.append(place)
        told.append(None if found is None else found.tolist())
        place = next_place(start, told, most)
    return places


@pytest.mark.ci
def test_a_search_asks_for_each_place_once() -> None:
    """The objective has a ridge, and a corner of the square has no solution. Even then the search repeats no point."""

    def figures(shares: FloatArray) -> FloatArray | None:
        x, y = shares
        return None if x + y > 1.5 else 2.0 + np.array([abs(x - 0.7), 2 * (y - x / 2), x - 2 * y]) + 0.1 * x * y

    whole = search(figures, [0.2, 0.9], 20)
    assert len({tuple(place) for place in whole}) == len(whole) <= 20
    assert search(figures, [0.2, 0.9], 10) == whole[:10]


def test_a_design_without_start_ends_with_an_error() -> None:
    body = changed(CLOSED, dict(zip(FILM, TOO_THIN, strict=True)))
    _, trial, error = lines_of(Design, request=body, variables=[HELIX], objective=SAFETY)
    assert (trial["objective"], trial["worst_corner"]) == (None, {})
    assert (error["type"], error["code"]) == ("error", "no_start")


@pytest.mark.ci
def test_a_trial_without_answer_is_worse_than_all() -> None:
    """A thinner oil makes the journal more eccentric, until the film no longer carries the load."""
    # The search for the largest eccentricity therefore also tries viscosities without a solution.
    body = changed(CLOSED, {f"{BEARING}.width_mm": 20, f"{BEARING}.radial_clearance_um": 1000})
    viscosity = {"path": FILM[0], "min": 1e-5, "max": 0.02}
    _, *trials, end = lines_of(
        Design,
        request=body,
        variables=[viscosity],
        objective="shafts.0.bearings.0.eccentricity_ratio",
        direction="maximise",
        evaluations=12,
    )
    unsolved = [trial for trial in trials if trial["objective"] is None]
    assert len(unsolved) == end["unsolved"] > 0
    assert end["objective_best"] == max(trial["objective"] or 0.0 for trial in trials)


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e9])
@pytest.mark.ci
def test_a_search_keeps_away_from_where_there_is_no_solution(scale: float) -> None:
    """The search finds the best point at 0.6 for an objective of any size, although there is no solution beyond 0.7."""
    tried: list[tuple[float, float | None]] = []

    def judge(unit: FloatArray) -> FloatArray | None:
        x = float(unit[0])
        figures = None if x > 0.7 else scale * (1.0 + np.array([x - 0.6, 0.6 - x]))
        tried.append((x, None if figures is None else float(figures.max())))
        return figures

    search(judge, [0.2], 20)
    assert any(figure is None for _, figure in tried)
    assert min((figure, place) for place, figure in tried if figure is not None)[1] == pytest.approx(0.6, abs=0.01)


def test_a_search_needs_a_start() -> None:
    with pytest.raises(NoSolution) as failure:
        search(lambda _: None, [0.5], 10)
    assert failure.value.code == "design"


def test_a_map_over_speed_and_load_is_a_sweep() -> None:
    axes = [
        {"path": "operation.pinion_speed_rpm", "values": [8000, 10000]},
        {"path": "operation.power_kw", "values": [6000, 12000]},
    ]
    outputs = [K, SAFETY, "shafts.0.thrust.upper_n", "losses.total_w"]
    header, *points, end = lines_of(Sweep, endpoint="/v1/drive-train", vary=axes, outputs=outputs)
    assert [each["unit"] for each in header["outputs"]] == [None, None, "N", "W"]
    assert len(points) == 4
    assert not [point for point in points if None in point["out"]]
    thrust = [point["out"][2] for point in points]
    assert thrust[0] / thrust[2] == pytest.approx(10000 / 8000), "as the torque"
    assert points[3]["out"] == answered({}, outputs)
    assert end["counts"] == {"ok_with_warnings": 4}


def corners(**parts: Any) -> tuple[Planner, dict[str, Any]]:
    return Corners, parts


def search_of(**parts: Any) -> tuple[Planner, dict[str, Any]]:
    return Design, {"variables": [HELIX], "objective": SAFETY, **parts}


def search_over(**variable: Any) -> tuple[Planner, dict[str, Any]]:
    return search_of(variables=[{**HELIX, **variable}])


def axis(path: Any, *values: Any) -> dict[str, Any]:
    return {"path": path, "values": list(values)}


STILL = {**CLOSED, "effects": {"shafts": False, "coupling": False, "thermal": False}}
WIDE = changed(CLOSED, {f"{BEARING}.radial_clearance_um": 950})
LENGTH = "pinion_shaft.sections.0.length_mm"
MANY = axis("face_start_mm", *range(257))
MORE = axis("face_start_mm", *range(1025))
REFUSED: dict[str, tuple[tuple[Planner, dict[str, Any]], str, str]] = {
    "corner unknown": (corners(ranges=[axis("thermal.wall", 1)]), "/ranges/0/path", "unknown_path"),
    "corner section": (corners(ranges=[axis("thermal", 1)]), "/ranges/0/path", "not_scalar"),
    "corner range": (corners(ranges=[axis("thermal.wall_response", 3)]), "/ranges/0", "out_of_range"),
    "corner whole": (corners(ranges=[axis("model.face_stations", 11.5)]), "/ranges/0", "not_integer"),
    "corner twice": (corners(ranges=[RESPONSE, RESPONSE]), "/ranges", "duplicate_path"),
    "corner empty": (corners(ranges=[{"path": LENGTH}]), "/ranges/0", "values_or_range"),
    "corner each": (corners(ranges=[axis(OFFSETS, [1, 2, 3])]), "/ranges/0/values/0", "values_per_field"),
    "corner many": (corners(ranges=[MORE]), "/ranges", "too_many_points"),
    "corner none": (corners(ranges=[]), "/ranges", "no_corners"),
    "corner still": (corners(request=STILL), "/ranges", "no_corners"),
    "corner usual": (corners(request=WIDE), "/ranges/1", "out_of_range"),
    "corner output": (corners(outputs=["safety.least"]), "/outputs/0", "unknown_output"),
    "corner curve": (corners(outputs=["misalignment.curves.shaft_um.3"]), "/outputs/0", "not_scalar"),
    "corner output twice": (corners(outputs=[K, K]), "/outputs/1", "duplicate_path"),
    "corner base": (corners(request={**CLOSED, "colour": 1}), "/request/colour", "extra_forbidden"),
    "corner part": (corners(colour=1), "/colour", "extra_forbidden"),
    "design unknown": (search_over(path="modifications.helix_um"), "/variables/0/path", "unknown_path"),
    "design words": (search_over(path="gears.hand"), "/variables/0/path", "not_continuous"),
    "design whole": (search_over(path="gears.pinion.teeth", min=30, max=40), "/variables/0/path", "not_continuous"),
    "design bounds": (search_over(max=1e6), "/variables/0/max", "out_of_range"),
    "design range": (search_over(min=100), "/variables/0", "variable_range"),
    "design step": (search_over(min=1, max=2, step=5), "/variables/0/step", "variable_step"),
    "design none": (search_of(variables=[]), "/variables", "too_short"),
    "design twice": (search_of(variables=[HELIX, HELIX]), "/variables", "duplicate_path"),
    "design both": (search_of(corners=[axis(HELIX["path"], 1)]), "/corners", "duplicate_path"),
    "design all": (
        search_of(corners=[axis("operation.power_kw", 1)], collective=[{"operation.power_kw": 2}]),
        "/collective",
        "duplicate_path",
    ),
    "design corner": (search_of(corners=[axis("thermal.wall", 1)]), "/corners/0/path", "unknown_path"),
    "design many corners": (search_of(corners=[MANY]), "/corners", "too_many_points"),
    "design many cases": (
        search_of(corners=[RESPONSE], collective=[{"operation.power_kw": 1 + k} for k in range(200)]),
        "/corners",
        "too_many_points",
    ),
    "design many points": (search_of(corners=[RESPONSE], evaluations=1000), "/evaluations", "too_many_points"),
    "design operating point": (search_of(collective=[{}, {"operation.power": 2}]), "/collective/1", "unknown_path"),
    "design power": (search_of(collective=[{"operation.power_kw": -2}]), "/collective/0", "out_of_range"),
    "design objective": (search_of(objective="safety.least"), "/objective", "unknown_output"),
    "design words to reach": (search_of(objective="status"), "/objective", "unknown_output"),
    "design direction": (search_of(objective=K), "/direction", "direction_missing"),
    "design base": (search_of(request={**CLOSED, "colour": 1}), "/request/colour", "extra_forbidden"),
    "design nonsense": (search_of(direction="up"), "/direction", "literal_error"),
}


def test_what_holds_no_number_says_what_it_is() -> None:
    """The search needs numbers. For options, flags and whole numbers, the message says what the field is."""
    told = {
        "gears.hand": "gears.hand is an option (right, left), not a number",
        "effects.shafts": "effects.shafts is either true or false, not a number",
        "gears.pinion.teeth": (
            "gears.pinion.teeth accepts only whole numbers, but the search needs a field that accepts all numbers"
        ),
    }
    for path, message in told.items():
        planner, parts = search_over(path=path)
        assert fault_of(planner, {"request": CLOSED, **parts})[2] == message


@pytest.mark.parametrize("case", REFUSED)
def test_refused_with_place_and_code(case: str) -> None:
    (planner, parts), pointer, code = REFUSED[case]
    assert fault_of(planner, {"request": CLOSED, **parts}, most=1999)[:2] == (pointer, code)


EXAMPLE = changed(
    CLOSED,
    {
        "model": {**CLOSED["model"], "coupling_friction": "sliding", "bearing_film": "short"},
        "friction_coefficient": 0.04,
        "temperatures": {"bulk_c": 95, "oil_c": 50, "scuffing_c": 220},
        "pinion_shaft.sections.3.outer_diameter_mm": 238.8,
    },
)
"""The worked example: the starter case with the friction, the temperatures and the pinion diameter of the example."""


@pytest.mark.slow
def test_tolerances_of_the_example() -> None:
    """The 5, 50 and 95 % quantiles of face load factor, safety and total slope agree with the worked example."""
    # The example and the test use different Latin hypercubes of 128 points. Both samples scatter, so that a quantile
    # may differ by 1.5 times the distance to its bound.
    clearances = {"pinion": 130, "wheel": 150}
    scatter = {
        "couplings.0.friction.coefficient": (0.05, 0.25),
        OFFSETS[0]: (-500, 500),
        OFFSETS[1]: (-500, 500),
        "thermal.wall_response": (0.3, 0.9),
        "modifications.helix_slope_um": (45, 55),
        "modifications.lead_crowning_um": (2, 7),
        **{
            f"{shaft}_shaft.bearings.{k}.radial_clearance_um": (0.9 * own, 1.1 * own)
            for shaft, own in clearances.items()
            for k in (0, 1)
        },
    }
    ranges = [{"path": path, "min": low, "max": high} for path, (low, high) in scatter.items()]
    expected = {
        K: (1.036, 1.111, 1.306),
        SAFETY: (1.678, 1.792, 1.844),
        "misalignment.total_slope_um": (-54, -43, -30),
    }
    *_, end = lines_of(
        Sweep,
        endpoint="/v1/drive-train",
        request=EXAMPLE,
        sample={"count": 128, "seed": 0, "ranges": ranges},
        outputs=list(expected),
    )
    for output, values in expected.items():
        found = zip(values, end["quantiles"][output], end["quantile_bounds"][output], strict=True)
        for value, quantile, (low, high) in found:
            assert abs(value - quantile) < 1.5 * (quantile - low if value < quantile else high - quantile), output


@pytest.mark.slow
def test_the_robust_design() -> None:
    """The search raises the safety at the worst of 12 corners from 1.609 to 1.741, as in the worked example."""
    # Before the search, the helix slope is 50 um, the crowning 4 um and the relief 15 um; the best values are 43.1, 7.8
    # and 12.9 um. The example does not state its second wall response; its numbers require a value between 0.9 and 1.
    variables = [
        HELIX,
        {"path": "modifications.lead_crowning_um", "min": 0, "max": 20},
        {"path": ["modifications.tip_relief_um", "modifications.root_relief_um"], "min": 0, "max": 30},
    ]
    corners = [
        axis([FRICTION["path"], OFFSETS[1]], [0.05, 400], [0.25, 400], [0.25, -400]),
        axis(RESPONSE["path"], 0.3, 0.9),
    ]
    powers = [{"operation.power_kw": power} for power in (12000, 6000)]
    *_, end = lines_of(
        Design, request=EXAMPLE, variables=variables, corners=corners, collective=powers, objective=SAFETY
    )
    assert end["objective_start"] == pytest.approx(1.609, abs=0.0015)
    assert end["objective_best"] == pytest.approx(1.741, abs=0.004)
    helix, crowning, relief, _ = end["best"].values()
    assert [helix, crowning, relief] == pytest.approx([43.1, 7.8, 12.9], abs=1.5)
    assert end["evaluations"] <= 60
