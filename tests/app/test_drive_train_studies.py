"""Corners and design of a gear unit by their addresses."""

import copy
import json
from collections.abc import Callable
from typing import Any

import httpx
import pytest

from app.calculations import BY_PATH
from app.examples import examples
from app.studies.design import Design
from app.studies.fields import set_value, value_at
from app.studies.requests import EXAMPLES
from app.studies.sweep import Corners

Post = Callable[[str, object], httpx.Response]

CORNERS, DESIGN = "/v1/drive-train/corners", "/v1/drive-train/design"
UNIT = examples()["starter-turbo-gear-drive-train"]


def lines(response: httpx.Response) -> list[dict[str, Any]]:
    assert response.status_code == 200, response.text
    assert response.headers["content-type"] == "application/x-ndjson"
    found = map(json.loads, response.text.splitlines())
    return [line for line in found if line["type"] != "progress"]


def test_corners_on_the_workers(post: Post) -> None:
    """The thermal film is left out, and the outputs are still those of the whole answer."""
    ranges = [{"path": "thermal.wall_response", "values": [0.3, 1.0]}]
    outputs = ["load.face_load_factor", "safety.blok_flank"]
    body = {**UNIT.request, "model": {"lubrication": "thermal_ehl", "path_points": 3}}
    _, *points, _, _, end = lines(post(CORNERS, {"request": body, "ranges": ranges, "outputs": outputs}))
    assert end["counts"] == {"ok_with_warnings": 2}
    body = json.loads(json.dumps(body))
    set_value(BY_PATH[UNIT.endpoint].request, body, "thermal.wall_response", 1.0)
    single = post(UNIT.endpoint, body).json()
    assert single["safety"]["thermal_ehl_feature"] is not None
    assert points[1]["out"] == [value_at(single, path) for path in outputs]


def test_a_design_on_the_workers(post: Post) -> None:
    body = copy.deepcopy({**EXAMPLES[DESIGN]["robust"]["value"], "evaluations": 1})
    body["request"] |= {"friction_coefficient": 0.04}
    body["request"]["temperatures"] |= {"bulk_c": 95.0}
    header, trial, end = lines(post(DESIGN, body))
    assert header["corners"] == 12
    assert trial["objective"] == end["objective_best"] == end["objective_start"]
    assert 1.6 < trial["objective"] < 1.63, "the nominal correction of the worked example: 1.609 with full sliding"


@pytest.mark.parametrize("example", EXAMPLES[CORNERS].values(), ids=list(EXAMPLES[CORNERS]))
def test_examples_of_corners_are_accepted(example: dict[str, Any]) -> None:
    assert Corners(example["value"], 2500, 30.0).total in {12, 128}


@pytest.mark.parametrize("example", EXAMPLES[DESIGN].values(), ids=list(EXAMPLES[DESIGN]))
def test_examples_of_designs_are_accepted(example: dict[str, Any]) -> None:
    assert Design(example["value"], 2500, 30.0).total == 720


@pytest.mark.parametrize(
    ("path", "parts", "pointer", "code"),
    [
        (CORNERS, {"ranges": [{"path": "thermal.wall", "values": [1]}]}, "/ranges/0/path", "unknown_path"),
        (CORNERS, {"endpoint": "/v1/coupling"}, "/endpoint", "extra_forbidden"),
        (DESIGN, {"variables": []}, "/variables", "too_short"),
    ],
)
def test_refused_before_the_first_line(post: Post, path: str, parts: dict[str, Any], pointer: str, code: str) -> None:
    response = post(path, {"request": UNIT.request, **parts})
    assert response.status_code == 422
    assert response.headers["content-type"] == "application/problem+json"
    (error,) = response.json()["errors"]
    assert (error["pointer"], error["code"]) == (pointer, code)


@pytest.mark.parametrize(
    ("path", "schema", "known"),
    [
        (CORNERS, "CornersRequest", EXAMPLES[CORNERS]),
        (DESIGN, "DesignRequest", EXAMPLES[DESIGN]),
    ],
)
def test_documented(client: httpx.Client, path: str, schema: str, known: dict[str, Any]) -> None:
    document = client.get("/openapi.json").json()
    content = document["paths"][path]["post"]["requestBody"]["content"]["application/json"]
    assert content["schema"] == {"$ref": f"#/components/schemas/{schema}"}
    assert set(content["examples"]) == set(known)
    properties = document["components"]["schemas"][schema]["properties"]
    assert all(each["title"] and each["description"] for each in properties.values())
