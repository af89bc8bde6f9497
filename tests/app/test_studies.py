"""Studies by their addresses."""

import csv
import io
import json
from collections.abc import Callable
from typing import Any

import httpx
import pytest

from app.calculations import BY_PATH
from app.examples import examples
from app.schema.fields import headlines
from app.studies.fields import set_value, value_at
from app.studies.requests import EXAMPLES

Post = Callable[[str, object], httpx.Response]

COUPLING = examples()["pahl-heavily-crowned"]
LOADS = examples()["fzg-type-a"]
THRUST = "axial_thrust.force_n"
SWEEP = {
    "endpoint": COUPLING.endpoint,
    "request": COUPLING.request,
    "vary": [{"path": "operation.misalignment_deg", "values": [0.02, 0.04]}],
    "outputs": [THRUST],
}


def lines(response: httpx.Response) -> list[dict[str, Any]]:
    assert response.status_code == 200, response.text
    return [json.loads(line) for line in response.text.splitlines()]


def without_time(text: str) -> list[dict[str, Any]]:
    found = map(json.loads, text.splitlines())
    return [
        {key: value for key, value in line.items() if key != "elapsed_s"}
        for line in found
        if line["type"] != "progress"
    ]


@pytest.mark.parametrize(
    ("example", "axis"),
    [
        (COUPLING, {"path": "operation.misalignment_deg", "start": 0.01, "stop": 0.05, "count": 7}),
        (LOADS, {"path": "modifications.helix_slope_um", "start": -20, "stop": 20, "count": 5}),
        (examples()["milian-case-1-groove"], {"path": "grooves.0.width_mm", "values": [8, 12]}),
    ],
)
def test_points_are_what_single_requests_answer(post: Post, example: Any, axis: dict[str, Any]) -> None:
    response = post("/v1/sweep", {"endpoint": example.endpoint, "request": example.request, "vary": [axis]})
    assert response.headers["content-type"] == "application/x-ndjson"
    header, *points, end = [line for line in lines(response) if line["type"] != "progress"]
    assert len(points) == header["total"] == end["points"]
    outputs = [leaf.path for leaf in headlines(BY_PATH[example.endpoint].response)]
    for point in points:
        body = json.loads(json.dumps(example.request))
        set_value(BY_PATH[example.endpoint].request, body, axis["path"], point["at"][0])
        single = post(example.endpoint, body).json()
        assert point["out"] == [value_at(single, path) for path in outputs]
        assert point["status"] == single["status"]


def test_equal_requests_give_equal_lines(post: Post) -> None:
    first, second = (post("/v1/sweep", SWEEP).text for _ in range(2))
    assert without_time(first) == without_time(second)


def test_refused_before_the_first_line(post: Post) -> None:
    response = post("/v1/sweep", {**SWEEP, "vary": [{"path": "operation.misaligment_deg", "values": [1]}]})
    assert response.status_code == 422
    assert response.headers["content-type"] == "application/problem+json"
    assert response.json()["type"].endswith(":unknown_path")
    (error,) = response.json()["errors"]
    assert error["pointer"] == "/vary/0/path"
    assert "did you mean operation.misalignment_deg?" in error["message"]


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
    body = json.loads(json.dumps(LOADS.request))
    set_value(BY_PATH[LOADS.endpoint].request, body, "gears.pinion.addendum", 3.0)
    assert refused["error"] == post(LOADS.endpoint, body).json()["errors"][0]
    assert good["status"] in {"ok", "ok_with_warnings"}
    assert end["counts"]["refused"] == 1


def test_more_points_than_the_setting_allows(post: Post) -> None:
    axis = {"path": "operation.misalignment_deg", "start": 0.01, "stop": 0.05, "count": 2501}
    (error,) = post("/v1/sweep", {**SWEEP, "vary": [axis]}).json()["errors"]
    assert (error["pointer"], error["code"]) == ("/vary", "too_many_points")
    assert "2501" in error["message"]
    assert "2500" in error["message"]


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
    response = post("/v1/sweep?format=xlsx", SWEEP)
    assert response.status_code == 422
    assert response.json()["errors"][0]["pointer"] == "/format"


def test_table_has_the_numbers_of_the_lines(post: Post) -> None:
    _, *points, _ = lines(post("/v1/sweep", SWEEP))
    heading, *rows = csv.reader(io.StringIO(post("/v1/sweep?format=csv", SWEEP).text))
    assert heading == ["index", "operation.misalignment_deg [°]", "status", f"{THRUST} [N]", "warnings", "error"]
    assert [float(row[3]) for row in rows] == [point["out"][0] for point in points]


@pytest.mark.parametrize("name", EXAMPLES["/v1/sweep"])
def test_examples_of_sweeps(post: Post, name: str) -> None:
    *_, end = lines(post("/v1/sweep", EXAMPLES["/v1/sweep"][name]["value"]))
    assert end["type"] == "end"
    assert end["counts"].get("ok", 0) + end["counts"].get("ok_with_warnings", 0) == end["points"]


@pytest.mark.parametrize("name", EXAMPLES["/v1/sensitivity"])
def test_examples_of_sensitivities(post: Post, name: str) -> None:
    *found, end = lines(post("/v1/sensitivity", EXAMPLES["/v1/sensitivity"][name]["value"]))
    assert end["type"] == "end"
    expected = {(output["path"], each["path"]) for output in end["outputs"] for each in end["inputs"]}
    assert {(line["output"], line["path"]) for line in found if line["type"] == "sensitivity"} == expected
    assert len(expected) > 15


@pytest.mark.slow
@pytest.mark.parametrize("name", EXAMPLES["/v1/spectrum"])
def test_examples_of_spectra(post: Post, name: str) -> None:
    header, *_, end = lines(post("/v1/spectrum", EXAMPLES["/v1/spectrum"][name]["value"]))
    assert header["type"] == "spectrum"
    assert end["counts"].get("ok", 0) + end["counts"].get("ok_with_warnings", 0) == header["total"]
    assert len(end["limits"]) == 1


def test_documents(client: httpx.Client) -> None:
    document = client.get("/openapi.json").json()
    sweep = document["paths"]["/v1/sweep"]["post"]
    assert set(sweep["responses"]["200"]["content"]) == {"application/x-ndjson", "text/csv"}
    assert sweep["requestBody"]["content"]["application/json"]["schema"] == {
        "$ref": "#/components/schemas/SweepRequest"
    }
    assert set(sweep["requestBody"]["content"]["application/json"]["examples"]) == set(EXAMPLES["/v1/sweep"])
    assert "422" in document["paths"]["/v1/sensitivity"]["post"]["responses"]
