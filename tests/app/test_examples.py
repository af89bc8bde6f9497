"""Every example is listed, runs as it stands and answers with finite numbers."""

import json

import httpx
import pytest

from app.calculations import CALCULATIONS
from app.examples import examples
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


@pytest.mark.parametrize("name", sorted(examples()))
def test_example_runs_and_repeats_and_detail_only_adds(post: Post, name: str) -> None:
    example = examples()[name]
    answers = []
    for detail in ("summary", "curves", "fields"):
        response = post(example.endpoint, {**example.request, "detail": detail})
        assert response.status_code == 200, response.text
        result = json.loads(response.text, parse_constant=refuse)
        assert result["status"] in {"ok", "ok_with_warnings"}
        assert (result["status"] == "ok") == (not result["warnings"])
        assert result["model_version"]
        assert result["model"]
        answers.append(result)
    again = post(example.endpoint, {**example.request, "detail": "fields"})
    assert again.content == response.content
    summary, curves, fields = answers
    assert_contained(summary, curves)
    assert_contained(curves, fields)
    assert len(json.dumps(summary)) < len(json.dumps(curves)) <= len(json.dumps(fields))


def assert_contained(less: object, more: object) -> None:
    """Everything in `less` stands in `more`, the same."""
    if isinstance(less, dict) and isinstance(more, dict):
        for key, value in less.items():
            assert_contained(value, more[key])
    elif isinstance(less, list) and isinstance(more, list):
        assert len(less) == len(more)
        for few, many in zip(less, more, strict=True):
            assert_contained(few, many)
    else:
        assert less == more
