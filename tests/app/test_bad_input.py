"""The service answers bad input with a problem document, never with status 500.

If a value in the request is a wrong word, the problem document does not repeat this word.
"""

import json
import re
from collections.abc import Iterator
from typing import Any

import httpx
import pytest
from pydantic import BaseModel

from app.calculations import BY_PATH, CALCULATIONS, Calculation
from app.examples import Example, examples
from app.pages.query import pairs_of
from app.schema.quantities import Input
from tests.support.requests import changed

NO_NUMBERS: list[Any] = ["30", True, float("nan"), float("inf"), [1.0], {"a": 1}, 10**400]
HOSTILE: list[Any] = ["30", True, "x" * 50, None, [], {}, -1e300, 1e300, 10**400, 0, 1e-9, 1e-300]


def example_of(calculation: Calculation) -> dict[str, Any]:
    return next(each.request for each in examples().values() if each.endpoint == calculation.path)


def number_fields(model: type[BaseModel], prefix: str = "") -> Iterator[str]:
    """Yield the dotted paths of the number fields of a request. Lists and optional sections are left out."""
    for name, field in model.model_fields.items():
        if isinstance(field.annotation, type) and issubclass(field.annotation, BaseModel):
            yield from number_fields(field.annotation, f"{prefix}{name}.")
        elif field.annotation in {int, float, float | None}:
            yield f"{prefix}{name}"


def short_path(calculation: Calculation) -> dict[str, int]:
    """Return a change that gives the path of contact five points, so that the answer takes little time.

    If the request has no `model.path_points`, the change is empty.
    """
    return {"model.path_points": 5} if "model.path_points" in number_fields(calculation.request) else {}


def send(client: httpx.Client, path: str, body: object) -> httpx.Response:
    """Post a body as JSON with NaN and Infinity. Strict encoders reject these numbers."""
    return client.post(path, content=json.dumps(body), headers={"Content-Type": "application/json"})


def assert_problem(response: httpx.Response, status: int = 422) -> dict[str, Any]:
    assert response.status_code == status, response.text
    assert response.headers["content-type"] == "application/problem+json"
    problem: dict[str, Any] = response.json()
    assert set(problem) >= {"type", "title", "status", "detail", "instance"}
    assert problem["instance"] == response.headers["x-request-id"]
    assert problem["status"] == status
    return problem


def pointers(response: httpx.Response) -> set[str]:
    return {error["pointer"] for error in assert_problem(response)["errors"]}


def pointer(path: str) -> str:
    return "/" + path.replace(".", "/")


@pytest.mark.parametrize("value", NO_NUMBERS, ids=lambda each: str(each)[:9])
@pytest.mark.parametrize("calculation", CALCULATIONS, ids=lambda each: each.path)
def test_number_fields_refuse_what_is_no_number(client: httpx.Client, calculation: Calculation, value: Any) -> None:
    """The service reports every number field with a wrong value."""
    # The test sends at most 90 wrong fields per request, because an answer reports at most 100 errors.
    every = sorted(set(number_fields(calculation.request)))
    for paths in (every[start : start + 90] for start in range(0, len(every), 90)):
        response = send(client, calculation.path, changed(example_of(calculation), dict.fromkeys(paths, value)))
        assert {pointer(path) for path in paths} <= pointers(response)


@pytest.mark.parametrize("calculation", CALCULATIONS, ids=lambda each: each.path)
def test_unknown_fields_are_refused_at_every_level(client: httpx.Client, calculation: Calculation) -> None:
    request = example_of(calculation)
    for section in ("", *(f"{name}." for name, value in request.items() if isinstance(value, dict))):
        response = send(client, calculation.path, changed(request, {f"{section}no~such/field": 1}))
        assert f"{pointer(section)}no~0such~1field" in pointers(response)


@pytest.mark.parametrize("calculation", CALCULATIONS, ids=lambda each: each.path)
def test_missing_sections_are_named(client: httpx.Client, calculation: Calculation) -> None:
    required = {f"/{name}" for name, field in calculation.request.model_fields.items() if field.is_required()}
    assert pointers(send(client, calculation.path, {})) == required


@pytest.mark.parametrize("calculation", CALCULATIONS, ids=lambda each: each.path)
@pytest.mark.parametrize("body", [b"", b"{", b"[]", b"null", b"NaN", b'"text"', b"[1,", b"\xff\xfe", b'{"\\ud800": 1}'])
def test_broken_json(client: httpx.Client, calculation: Calculation, body: bytes) -> None:
    response = client.post(calculation.path, content=body, headers={"Content-Type": "application/json"})
    assert_problem(response)


@pytest.mark.parametrize("body", [b"[" * 100_000, b"1" * 5_000])
def test_json_beyond_the_parser(client: httpx.Client, body: bytes) -> None:
    response = client.post(CALCULATIONS[0].path, content=body, headers={"Content-Type": "application/json"})
    assert_problem(response, 400)


def test_integers_may_be_written_with_a_point(client: httpx.Client) -> None:
    whole, point = (changed(example_of(CALCULATIONS[0]), {"coupling.teeth": teeth}) for teeth in (52, 52.0))
    assert send(client, CALCULATIONS[0].path, whole).json() == send(client, CALCULATIONS[0].path, point).json()


def test_the_input_is_not_echoed(client: httpx.Client) -> None:
    secret = "do-not-repeat-me"
    response = send(client, CALCULATIONS[0].path, changed(example_of(CALCULATIONS[0]), {"detail": secret}))
    assert secret not in response.text


def own_fields(calculation: Calculation) -> list[str]:
    """Return the number fields to vary.

    For a warm-up, these are the fields in `cooling` and the fields that the drive train lacks.
    """
    unit = BY_PATH["/v1/drive-train"]
    others = number_fields(unit.request) if calculation.path.startswith(f"{unit.path}/") else []
    return [path for path in number_fields(calculation.request) if path not in others or path.startswith("cooling.")]


@pytest.mark.slow
@pytest.mark.parametrize("calculation", CALCULATIONS, ids=lambda each: each.path)
def test_nothing_gives_500(client: httpx.Client, calculation: Calculation) -> None:
    for path in own_fields(calculation):
        for value in HOSTILE:
            request = changed(example_of(calculation), {**short_path(calculation), path: value})
            response = send(client, calculation.path, request)
            assert response.status_code in {200, 422}, (path, value, response.text)


def range_ends(model: type[BaseModel], path: str) -> tuple[float, float]:
    """Return the lower and the upper limit of a number field. A limit may itself be outside the range."""
    first, _, below = path.partition(".")
    field = model.model_fields[first]
    if below:
        return range_ends(field.annotation, below)
    meaning = next(item for item in field.metadata if isinstance(item, Input))
    low = meaning.ge if meaning.ge is not None else meaning.gt
    high = meaning.le if meaning.le is not None else meaning.lt
    assert low is not None
    assert high is not None
    return low, high


def kind_of(example: Example) -> tuple[str, frozenset[tuple[str, str]]]:
    """Return the endpoint of an example, and its fields with their texts. Numbers become empty texts."""
    pairs = pairs_of(example.request)
    numbers = re.compile(r"[-+\d.e, ]*")
    return example.endpoint, frozenset((name, "" if numbers.fullmatch(text) else text) for name, text in pairs)


KINDS = {kind_of(each): each for each in reversed(examples().values())}
"""The first example of each kind. Other examples of a kind differ in numbers only, and the test varies the numbers."""
FULLEST = {kind[0]: each for kind, each in sorted(KINDS.items(), key=lambda item: len(item[0][1]))}
"""For each endpoint, the example with the most fields. Here the test also varies fields that are not given."""


@pytest.mark.slow
@pytest.mark.parametrize("example", KINDS.values(), ids=lambda each: each.name)
def test_ends_of_every_range_are_answered(client: httpx.Client, example: Example) -> None:
    calculation = BY_PATH[example.endpoint]
    given = {name for name, _ in pairs_of(example.request)}
    for path in own_fields(calculation):
        if path not in given and example is not FULLEST[example.endpoint]:
            continue
        for value in range_ends(calculation.request, path):
            request = changed(example.request, {**short_path(calculation), path: value, "detail": "summary"})
            response = send(client, calculation.path, request)
            assert response.status_code in {200, 422}, (path, value, response.text)
