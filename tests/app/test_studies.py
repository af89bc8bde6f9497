"""The endpoints of studies give the numbers of single requests, and refuse a study that contains an error."""

import csv
import io
import json
from typing import Any

import httpx
import pytest

from app.calculations import BY_PATH
from app.examples import examples, study_bodies
from app.schema.fields import headlines
from app.studies.kinds.corners import Corners
from app.studies.kinds.design import Design
from tests.support.requests import Post, changed, refusals, value_at

COUPLING = examples()["pahl-heavily-crowned"]
LOADS = examples()["fzg-type-a"]
UNIT = examples()["starter-turbo-gear-drive-train"]
CORNERS, DESIGN = "/v1/drive-train/corners", "/v1/drive-train/design"
THRUST = "axial_thrust.force_n"
SWEEP = {
    "endpoint": COUPLING.endpoint,
    "request": COUPLING.request,
    "vary": [{"path": "operation.misalignment_deg", "values": [0.02, 0.04]}],
    "outputs": [THRUST],
}


def lines(response: httpx.Response) -> list[dict[str, Any]]:
    """Return the lines of a study without the lines about its progress."""
    assert response.status_code == 200, response.text
    assert response.headers["content-type"] == "application/x-ndjson"
    found = map(json.loads, response.text.splitlines())
    return [line for line in found if line["type"] != "progress"]


def assert_solved(end: dict[str, Any], total: int) -> None:
    """Check in the last line of a study that all points of the study are solved."""
    assert end["type"] == "end"
    assert end["counts"].get("ok", 0) + end["counts"].get("ok_with_warnings", 0) == total


@pytest.mark.parametrize(
    ("example", "axis"),
    [
        (COUPLING, {"path": "operation.misalignment_deg", "start": 0.01, "stop": 0.05, "count": 7}),
        (LOADS, {"path": "modifications.helix_slope_um", "start": -20, "stop": 20, "count": 5}),
        (examples()["milian-case-1-groove"], {"path": "grooves.0.width_mm", "values": [8, 12]}),
    ],
)
def test_points_are_what_single_requests_answer(post: Post, example: Any, axis: dict[str, Any]) -> None:
    sweep = {"endpoint": example.endpoint, "request": example.request, "vary": [axis]}
    header, *points, end = lines(post("/v1/sweep", sweep))
    assert len(points) == header["total"] == end["points"]
    outputs = [leaf.path for leaf in headlines(BY_PATH[example.endpoint].response)]
    for point in points:
        single = post(example.endpoint, changed(example.request, {axis["path"]: point["at"][0]})).json()
        assert point["out"] == [value_at(single, path) for path in outputs]
        assert point["status"] == single["status"]


def test_equal_requests_give_equal_lines(post: Post) -> None:
    *first, one = lines(post("/v1/sweep", SWEEP))
    *second, other = lines(post("/v1/sweep", SWEEP))
    assert first == second
    assert {**one, "elapsed_s": None} == {**other, "elapsed_s": None}


MISSPELT = {"vary": [{"path": "operation.misaligment_deg", "values": [1]}]}
TOO_MANY = {"vary": [{"path": "operation.misalignment_deg", "start": 0.01, "stop": 0.05, "count": 2501}]}
OF_UNIT = {"request": UNIT.request}


@pytest.mark.parametrize(
    ("path", "body", "pointer", "code", "words"),
    [
        (
            "/v1/sweep",
            SWEEP | MISSPELT,
            "vary.0.path",
            "unknown_path",
            ("did you mean operation.misalignment_deg?",),
        ),
        ("/v1/sweep", SWEEP | TOO_MANY, "vary", "too_many_points", ("2501", "2500")),
        (CORNERS, OF_UNIT | {"ranges": [{"path": "thermal.wall", "values": [1]}]}, "ranges.0.path", "unknown_path", ()),
        (CORNERS, OF_UNIT | {"endpoint": "/v1/coupling"}, "endpoint", "extra_forbidden", ()),
        (DESIGN, OF_UNIT | {"variables": []}, "variables", "too_short", ()),
    ],
)
def test_refused_before_the_first_line(
    post: Post, path: str, body: dict[str, Any], pointer: str, code: str, words: tuple[str, ...]
) -> None:
    response = post(path, body)
    assert refusals(response) == [(code, pointer)]
    assert all(word in response.json()["errors"][0]["message"] for word in words)
    if code == "unknown_path":
        assert response.json()["type"].endswith(f":{code}")


def test_errors_of_the_base_request_are_its_own(post: Post) -> None:
    body = {**COUPLING.request, "colour": 1}
    own, sweep = post(COUPLING.endpoint, body).json(), post("/v1/sweep", {**SWEEP, "request": body}).json()
    assert sweep["type"] == own["type"]
    assert sweep["errors"] == [{**error, "pointer": f"/request{error['pointer']}"} for error in own["errors"]]


def test_errors_of_a_point_are_the_endpoints_own(post: Post) -> None:
    cases = [{"gears.pinion.addendum": 3.0}, {}]
    _, refused, good, end = lines(
        post("/v1/sweep", {"endpoint": LOADS.endpoint, "request": LOADS.request, "cases": cases})
    )
    body = changed(LOADS.request, cases[0])
    assert refused["error"] == post(LOADS.endpoint, body).json()["errors"][0]
    assert good["status"] in {"ok", "ok_with_warnings"}
    assert end["counts"]["refused"] == 1


@pytest.mark.parametrize("body", [b"", b"{", b"[1]", b'{"a": 1, "a": 2}'])
@pytest.mark.parametrize("path", ["/v1/sweep", "/v1/sensitivity", "/v1/spectrum"])
def test_what_is_no_study(client: httpx.Client, path: str, body: bytes) -> None:
    response = client.post(path, content=body, headers={"Content-Type": "application/json"})
    assert response.status_code in {400, 422}
    assert response.headers["content-type"] == "application/problem+json"


def test_a_study_must_be_declared_as_json(client: httpx.Client) -> None:
    assert client.post("/v1/sweep", content=b"{}", headers={"Content-Type": "text/csv"}).status_code == 415


@pytest.mark.parametrize(
    ("query", "accept", "media_type"),
    [
        ("", "*/*", "application/x-ndjson"),
        ("", "text/csv", "text/csv"),
        ("", "text/html, text/csv;q=0.9, */*", "text/csv"),
        ("", "application/x-ndjson, text/csv", "application/x-ndjson"),
        ("?format=csv", "application/x-ndjson", "text/csv"),
        ("?format=ndjson", "text/csv", "application/x-ndjson"),
    ],
)
def test_formats(client: httpx.Client, query: str, accept: str, media_type: str) -> None:
    response = client.post(f"/v1/sweep{query}", json=SWEEP, headers={"Accept": accept})
    assert response.status_code == 200
    assert response.headers["content-type"].startswith(media_type)


def test_unknown_format(post: Post) -> None:
    assert refusals(post("/v1/sweep?format=xlsx", SWEEP))[0][1] == "format"


def test_table_has_the_numbers_of_the_lines(post: Post) -> None:
    _, *points, _ = lines(post("/v1/sweep", SWEEP))
    heading, *rows = csv.reader(io.StringIO(post("/v1/sweep?format=csv", SWEEP).text))
    assert heading == ["index", "operation.misalignment_deg [°]", "status", f"{THRUST} [N]", "warnings", "error"]
    assert [float(row[3]) for row in rows] == [point["out"][0] for point in points]


@pytest.mark.parametrize("name", study_bodies("/v1/sweep"))
def test_examples_of_sweeps(post: Post, name: str) -> None:
    *_, end = lines(post("/v1/sweep", study_bodies("/v1/sweep")[name]["value"]))
    assert_solved(end, end["points"])


@pytest.mark.parametrize("name", study_bodies("/v1/sensitivity"))
def test_examples_of_sensitivities(post: Post, name: str) -> None:
    *found, end = lines(post("/v1/sensitivity", study_bodies("/v1/sensitivity")[name]["value"]))
    assert end["type"] == "end"
    expected = {(output["path"], each["path"]) for output in end["outputs"] for each in end["inputs"]}
    assert {(line["output"], line["path"]) for line in found if line["type"] == "sensitivity"} == expected
    assert len(expected) > 15


@pytest.mark.slow
@pytest.mark.parametrize("name", study_bodies("/v1/spectrum"))
def test_examples_of_spectra(post: Post, name: str) -> None:
    header, *_, end = lines(post("/v1/spectrum", study_bodies("/v1/spectrum")[name]["value"]))
    assert header["type"] == "spectrum"
    assert_solved(end, header["total"])
    assert len(end["limits"]) == 1


def test_corners_on_the_workers(post: Post) -> None:
    """A study of corners omits the thermal film if no output needs the film."""
    # The outputs are nevertheless those of a single request with the film.
    ranges = [{"path": "thermal.wall_response", "values": [0.3, 1.0]}]
    outputs = ["load.face_load_factor", "safety.blok_flank"]
    body = {**UNIT.request, "model": {"lubrication": "thermal_ehl", "path_points": 3}}
    _, *points, _, _, end = lines(post(CORNERS, {"request": body, "ranges": ranges, "outputs": outputs}))
    assert end["counts"] == {"ok_with_warnings": 2}
    single = post(UNIT.endpoint, changed(body, {"thermal.wall_response": 1.0})).json()
    assert single["safety"]["thermal_ehl_feature"] is not None
    assert points[1]["out"] == [value_at(single, path) for path in outputs]


@pytest.mark.ci
def test_a_design_on_the_workers(post: Post) -> None:
    worked = {"request.friction_coefficient": 0.04, "request.temperatures.bulk_c": 95.0}
    worked["request.pinion_shaft.sections.3.outer_diameter_mm"] = 238.8
    body = changed(study_bodies(DESIGN)["robust"]["value"], {"evaluations": 1, **worked})
    header, trial, end = lines(post(DESIGN, body))
    assert header["corners"] == 12
    assert trial["objective"] == end["objective_best"] == end["objective_start"]
    assert 1.6 < trial["objective"] < 1.63, "the nominal correction of the worked example: 1.609 with full sliding"


@pytest.mark.parametrize("example", study_bodies(CORNERS).values(), ids=list(study_bodies(CORNERS)))
def test_examples_of_corners_are_accepted(example: dict[str, Any]) -> None:
    assert Corners(example["value"], 2500, 30.0).total in {12, 128}


@pytest.mark.parametrize("example", study_bodies(DESIGN).values(), ids=list(study_bodies(DESIGN)))
def test_examples_of_designs_are_accepted(example: dict[str, Any]) -> None:
    assert Design(example["value"], 2500, 30.0).total in {720, 785}


@pytest.mark.parametrize(
    ("path", "schema"), [("/v1/sweep", "SweepRequest"), (CORNERS, "CornersRequest"), (DESIGN, "DesignRequest")]
)
def test_documents(client: httpx.Client, path: str, schema: str) -> None:
    document = client.get("/openapi.json").json()
    operation = document["paths"][path]["post"]
    content = operation["requestBody"]["content"]["application/json"]
    assert content["schema"] == {"$ref": f"#/components/schemas/{schema}"}
    assert set(content["examples"]) == set(study_bodies(path))
    properties = document["components"]["schemas"][schema]["properties"]
    assert all(each["title"] and each["description"] for each in properties.values())
    if path == "/v1/sweep":
        assert set(operation["responses"]["200"]["content"]) == {"application/x-ndjson", "text/csv"}
    assert "422" in document["paths"]["/v1/sensitivity"]["post"]["responses"]
