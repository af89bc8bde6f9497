"""A sweep sends a header, points, ranges, statistics and the best point, either as lines or as a table."""

import csv
import io
from math import comb
from typing import Any

import numpy as np
import pytest
from scipy.stats import spearmanr

from app.schema.fields import Leaf
from app.studies.kinds.sweep import Best, Summary, Sweep, table_row
from app.studies.point_sets import PointSet
from app.studies.points import Point
from app.studies.statistics import of_sample
from tests.support.pools import InlinePool
from tests.support.studies import fault_of, lines_of, study_of, timeless

THRUST = "axial_thrust.force_n"
FILM = "lubrication.load_capacity_coefficient"


def body(**parts: Any) -> dict[str, Any]:
    return study_of("pahl-axial-displacement", **parts)


def swept(slots: int = 1, **parts: Any) -> list[dict[str, Any]]:
    """Return the lines of a sweep over a coupling."""
    return timeless(lines_of(Sweep(body(**parts), 2500, 30.0), InlinePool(slots)))


GRID: list[dict[str, Any]] = [
    {"path": "operation.misalignment_deg", "values": [0.02, 0.05, 0.08]},
    {"path": "friction.coefficient", "start": 0.1, "stop": 0.2, "count": 3},
]


def test_lines_of_a_grid() -> None:
    header, *points, end = swept(vary=GRID, outputs=[THRUST, FILM, "lubrication.regime.area"])
    assert list(header) == ["type", "endpoint", "axes", "outputs", "total", "model_version", "sources", "case"]
    assert header["axes"][0] == {**GRID[0], "unit": "°"}
    assert header["axes"][1]["values"] == pytest.approx([0.1, 0.15, 0.2])
    assert header["outputs"][0] == {"path": THRUST, "unit": "N", "title": "axial thrust"}
    assert header["total"] == 9
    assert [point["index"] for point in points] == list(range(9))
    assert points[4]["at"] == [0.05, pytest.approx(0.15)]
    assert [list(point) for point in points] == [["type", "index", "at", "status", "out", "warnings", "ranks"]] * 9
    assert (end["points"], end["counts"]) == (9, {"ok": 9})
    thrust = [point["out"][0] for point in points]
    low, high = int(np.argmin(thrust)), int(np.argmax(thrust))
    assert end["ranges"][THRUST] == {"min": [thrust[low], low], "max": [thrust[high], high]}
    assert set(end["ranges"]) == {THRUST, FILM}
    assert end["quantiles"] is end["quantile_bounds"] is end["rank_correlation"] is end["best"] is None
    assert "friction.static_coefficient" not in {each["field"] for each in end["assumptions"]}


def test_headline_numbers_by_default() -> None:
    header, *_ = swept(cases=[{}])
    assert [each["path"] for each in header["outputs"]] == [
        "axial_thrust.design_force_n",
        FILM,
        "kinematics.max_sliding_velocity_m_per_s",
        "limits.allowable_misalignment_deg",
    ]
    assert header["axes"] == []


def test_equal_lines_on_any_number_of_processes() -> None:
    first, *others = (swept(slots, vary=GRID) for slots in (1, 2, 5))
    assert all(other == first for other in others)


def test_cases_say_what_they_change() -> None:
    cases: list[dict[str, Any]] = [{"operation.torque_n_m": 4500, "friction.coefficient": None}, {}]
    _, first, second, _ = swept(cases=cases, outputs=[THRUST])
    assert [first["at"], second["at"]] == cases
    assert first["out"] != second["out"]


def test_refused_points_are_lines_and_left_out_of_everything() -> None:
    torques = {"path": "operation.torque_n_m", "values": [1e-20, 3000, 6000]}
    _, refused, *points, end = swept(vary=[torques], outputs=[THRUST], best={"minimise": THRUST})
    assert refused["status"] == "refused"
    assert refused["out"] == [None]
    assert (refused["error"]["pointer"], refused["error"]["code"]) == ("/operation/torque_n_m", "out_of_range")
    assert end["counts"] == {"ok": 2, "refused": 1}
    assert end["ranges"][THRUST]["min"] == [points[0]["out"][0], 1]
    assert end["best"] == {"index": 1, "at": [3000], "out": points[0]["out"], "ends": []}


def test_an_assumed_value_that_differs_between_points_is_null() -> None:
    *_, end = swept(vary=[{"path": "coupling.module_mm", "values": [3, 3.5]}])
    *_, single = swept(cases=[{}])
    values = {each["field"]: each["value"] for each in end["assumptions"]}
    assert set(values) == {each["field"] for each in single["assumptions"]}
    assert values["model.simple_thrust_factor" if "model.simple_thrust_factor" in values else "model.inlet"] is not None


def summary(rows: list[list[Any]], **best: Any) -> Summary:
    """Return the summary of a sweep. Each row holds the outputs x, y and z of one point."""
    received = Summary(["x", "y", "z"], Best.model_validate(best) if best else None)
    for row in rows:
        received.add(Point("ok", row, []))
    return received


ROWS = [[3.0, 1, None], [1.0, 5, "word"], [2.0, 2, True], [None, 0, False], [1.0, 3, None]]


@pytest.mark.parametrize(
    ("best", "index"),
    [
        ({"minimise": "x"}, 1),  # of two equal ones the first
        ({"maximise": "x"}, 0),
        ({"minimise": "x", "where": [{"output": "y", "max": 4}]}, 4),
        ({"minimise": "x", "where": [{"output": "y", "min": 1, "max": 2}]}, 2),
        ({"maximise": "x", "where": [{"output": "z", "min": 1}]}, 2),
        ({"minimise": "y"}, 3),
        ({"minimise": "y", "where": [{"output": "x"}]}, 0),
        ({"minimise": "x", "where": [{"output": "y", "min": 6}]}, None),
    ],
)
def test_best_point(best: dict[str, Any], index: int | None) -> None:
    found = summary(ROWS, **best).best_point
    assert found == (None if index is None else (index, ROWS[index]))


def test_ranges_leave_null_and_words_out() -> None:
    assert summary(ROWS).extremes == {
        "x": {"min": (1.0, 1), "max": (3.0, 0)},
        "y": {"min": (0, 3), "max": (5, 1)},
        "z": {"min": (False, 3), "max": (True, 2)},
    }
    assert summary([[1.0, None, "word"]]).extremes == {"x": {"min": (1.0, 0), "max": (1.0, 0)}}


def test_statistics_of_a_sample() -> None:
    ranges = [
        {"path": "operation.misalignment_deg", "min": 0.03, "max": 0.08},
        {"path": "friction.coefficient", "min": 0.1, "max": 0.2},
        {"path": "lubricant.viscosity_pa_s", "min": 0.02, "max": 0.021},
    ]
    header, *points, end = swept(sample={"count": 40, "ranges": ranges}, outputs=[THRUST, "lubrication.regime.area"])
    assert [axis["values"] for axis in header["axes"]] == [None] * 3
    at, thrust = np.array([point["at"] for point in points]), np.array([point["out"][0] for point in points])
    assert set(end["quantiles"]) == set(end["rank_correlation"]) == {THRUST}
    assert end["quantiles"][THRUST] == np.quantile(thrust, [0.05, 0.5, 0.95]).tolist()
    ordered, bounds = np.sort(thrust).tolist(), end["quantile_bounds"][THRUST]
    assert bounds == [[None, ordered[4]], [ordered[14], ordered[25]], [ordered[35], None]]
    for share, beyond in ((0.05, 4), (0.5, 14), (0.5, 25)):
        within = sum(comb(40, k) * share**k * (1 - share) ** (40 - k) for k in range(beyond + 1))
        assert within < 0.05 if beyond == 14 else within >= 0.95
    for place, each in enumerate(ranges):
        expected = spearmanr(at[:, place], thrust).statistic
        assert end["rank_correlation"][THRUST][each["path"]] == pytest.approx(expected, abs=1e-15)
    assert end["rank_correlation"][THRUST]["operation.misalignment_deg"] < -0.5
    assert end["rank_correlation"][THRUST]["friction.coefficient"] > 0.3


def test_statistics_by_hand() -> None:
    nan = float("nan")
    inputs = np.array([[1.0, 7.0], [2.0, 7.0], [3.0, 7.0], [4.0, 7.0], [5.0, 7.0]])
    outputs = np.array(
        [[1.0, nan, 2.0, 5.0], [8.0, nan, nan, 5.0], [27.0, nan, nan, 5.0], [64.0, nan, nan, 5.0], [nan, nan, 3.0, 5.0]]
    )
    found = of_sample(inputs, outputs, ["a", "b"], ["rises", "nothing", "two", "constant"])
    assert found["quantiles"]["rises"] == pytest.approx([1 + 0.15 * 7, 17.5, 64 - 0.15 * 37])
    assert found["rank_correlation"] == {
        "rises": {"a": pytest.approx(1.0), "b": None},
        "two": {"a": None, "b": None},
        "constant": {"a": None, "b": None},
    }
    assert set(found["quantiles"]) == {"rises", "two", "constant"}


def table_of(lines: list[dict[str, Any]], points: PointSet, outputs: tuple[Leaf, ...]) -> list[list[str]]:
    text = b"".join(table_row(points, outputs, line) for line in lines).decode()
    return list(csv.reader(io.StringIO(text)))


def test_table() -> None:
    first: dict[str, Any] = {"operation.torque_n_m": 4500}
    parts = {"cases": [first], "outputs": [THRUST, "lubrication.regime.area"]}
    study = Sweep(body(**parts), 10, 30.0)
    cases = [first, {"model.sleeve": "floating", "operation.torque_n_m": None}]
    points = PointSet([], study.points.varied, cases)
    _, point, end = swept(**parts)
    refused = {**point, "index": 1, "status": "refused", "out": [None, "=1+1"], "warnings": ["a", "b"]}
    refused["error"] = {"pointer": "/x", "code": "some_code", "message": 'says "no", twice'}
    lines = [{"type": "sweep"}, point, {"type": "progress"}, refused, end]
    heading = f"index,operation.torque_n_m [N m],status,{THRUST} [N],lubrication.regime.area,warnings,error"
    assert table_of(lines, points, study.outputs) == [
        heading.split(","),
        ["0", "4500", "ok", repr(point["out"][0]), point["out"][1], "", ""],
        ["1", "", "refused", "", "'=1+1", "a b", 'some_code: says "no", twice'],
    ]


@pytest.mark.parametrize("text", ["=cmd()", "+1+1", "-x", "@sum", "\tx", "\rx"])
def test_words_that_a_spreadsheet_would_compute_are_quoted(text: str) -> None:
    points = PointSet([], (), [{}])
    line = {"type": "point", "index": 0, "status": "ok", "out": [text, -1.5, True, None], "warnings": []}
    (cells,) = csv.reader(io.StringIO(table_row(points, (), line).decode(), newline=""))
    assert cells[2:6] == [f"'{text}", "-1.5", "true", ""]


def test_a_table_of_a_study_that_ended_early_ends_with_a_row_that_says_so() -> None:
    study = Sweep(body(cases=[{"operation.torque_n_m": 4500}], outputs=[THRUST]), 10, 30.0)
    error = {"type": "error", "code": "study_deadline", "message": "the study took longer than 1 s", "done": 0}
    heading, row = table_of([{"type": "sweep"}, error], study.points, study.outputs)
    assert dict(zip(heading, row, strict=True)) == {
        "index": "",
        "operation.torque_n_m [N m]": "",
        "status": "error",
        f"{THRUST} [N]": "",
        "warnings": "",
        "error": "study_deadline: the study took longer than 1 s",
    }


POINTS: dict[str, Any] = {
    "vary": GRID,
    "cases": [{"operation.torque_n_m": torque} for torque in (3000, 3500, 4000, 4500, 5000)],
    "sample": {"count": 16, "seed": 5, "ranges": [{"path": "operation.misalignment_deg", "min": 0.03, "max": 0.08}]},
}


@pytest.mark.parametrize("kind", POINTS)
def test_a_study_whose_connection_was_lost_goes_on_with_the_same_lines(kind: str) -> None:
    parts = {kind: POINTS[kind], "outputs": [THRUST], "best": {"minimise": THRUST}}
    header, *whole, _ = swept(**parts)
    again, *rest, end = swept(**parts, from_index=3)
    assert rest == whole[3:]
    assert again == {**header, "from_index": 3}
    least = min(rest, key=lambda line: line["out"][0])
    assert end["points"] == len(rest) == header["total"] - 3
    ends = [each["path"] for each in GRID] if kind == "vary" else []
    assert end["best"] == {name: least[name] for name in ("index", "at", "out")} | {"ends": ends}
    assert end["ranges"][THRUST]["min"] == [least["out"][0], least["index"]]


def test_a_study_does_not_go_on_behind_its_last_point() -> None:
    assert fault_of(Sweep, body(cases=[{}, {}], from_index=2))[:2] == ("/from_index", "out_of_range")
