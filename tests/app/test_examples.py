"""Every example is in the list, can be sent unchanged, and gives an answer with finite numbers."""

import json
from itertools import pairwise

import httpx
import pytest

from app.calculations import BY_PATH, CALCULATIONS
from app.evaluate import response_to, solve, written
from app.examples import examples
from tests.support.properties import one_per_endpoint
from tests.support.requests import Post


def refuse(token: str) -> float:
    raise AssertionError(f"{token} left the service")


def test_list_and_single_examples_agree(client: httpx.Client) -> None:
    listed = client.get("/v1/examples").json()
    assert [item["name"] for item in listed] == list(examples())
    for item in listed:
        example = client.get(f"/v1/examples/{item['name']}").json()
        assert {key: example[key] for key in item} == item
        assert example["request"]


def test_unknown_example_is_a_problem(client: httpx.Client) -> None:
    response = client.get("/v1/examples/none")
    assert response.status_code == 404
    assert response.headers["content-type"] == "application/problem+json"


def test_every_calculation_has_an_example() -> None:
    assert {example.endpoint for example in examples().values()} == {each.path for each in CALCULATIONS}


@pytest.mark.parametrize("name", one_per_endpoint(examples()))
def test_example_is_answered_alike_by_two_processes_and_detail_only_adds(post: Post, name: str) -> None:
    example = examples()[name]
    calculation = BY_PATH[example.endpoint]
    summary, curves, fields = (
        calculation.request.model_validate({**example.request, "detail": detail})
        for detail in ("summary", "curves", "fields")
    )
    solution = solve(calculation, fields)
    answers = [written(response_to(calculation, request, solution)) for request in (summary, curves, fields)]
    response = post(example.endpoint, {**example.request, "detail": "fields"})
    assert response.status_code == 200, response.text
    assert response.content == answers[-1]
    results = [json.loads(answer, parse_constant=refuse) for answer in answers]
    for result in results:
        assert result["status"] in {"ok", "ok_with_warnings"}
        assert (result["status"] == "ok") == (not result["warnings"])
        assert result["model_version"]
        assert result["model"]
    for less, more in pairwise(results):
        assert_contained(less, more)
    lengths = [len(answer) for answer in answers]
    assert lengths[0] < lengths[1] <= lengths[2]


def assert_contained(less: object, more: object) -> None:
    """Check that `more` contains everything in `less`, with the same values."""
    if isinstance(less, dict) and isinstance(more, dict):
        for key, value in less.items():
            assert_contained(value, more[key])
    elif isinstance(less, list) and isinstance(more, list):
        assert len(less) == len(more)
        for few, many in zip(less, more, strict=True):
            assert_contained(few, many)
    else:
        assert less == more
