"""The numbers of every example, as they were last accepted: a change of any is seen, whether meant or not.

These are regressions, not truths; truths stand in tests/papers. After a change that is meant:
`python -m tests.golden.test_examples` writes the file anew, and its difference belongs into the commit.
"""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from app.calculations import CALCULATIONS
from app.evaluate import evaluate
from app.library import examples

NUMBERS = Path(__file__).with_name("numbers.json")
NOT_RESULTS = {"inputs", "case", "model_version", "model", "assumptions"}
ROUNDING = {"rel": 1e-6, "abs": 1e-9}
"""What another processor's rounding may change in iterated results, and in what is zero but for rounding."""


def numbers_of(name: str) -> dict[str, Any]:
    """Every scalar of an example's summary by its path, and the codes of its warnings."""
    example = examples()[name]
    calculation = next(each for each in CALCULATIONS if each.path == example.endpoint)
    request = calculation.request.model_validate({**example.request, "detail": "summary"})
    answer = evaluate(calculation, request).model_dump(exclude_unset=True, exclude=NOT_RESULTS)
    answer["warnings"] = [warning["code"] for warning in answer["warnings"]]
    return dict(scalars(answer, ""))


def scalars(value: Any, path: str) -> Iterator[tuple[str, Any]]:
    if isinstance(value, dict):
        for name, item in value.items():
            yield from scalars(item, f"{path}.{name}" if path else name)
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from scalars(item, f"{path}.{index}")
    else:
        yield path, value


def accepted() -> dict[str, dict[str, Any]]:
    numbers: dict[str, dict[str, Any]] = json.loads(NUMBERS.read_text("utf-8"))
    return numbers


def test_every_example_has_its_numbers() -> None:
    assert sorted(accepted()) == sorted(examples())


@pytest.mark.parametrize("name", sorted(examples()))
def test_numbers_are_as_accepted(name: str) -> None:
    found, wanted = numbers_of(name), accepted()[name]
    assert list(found) == list(wanted)
    for path, value in wanted.items():
        assert found[path] == (pytest.approx(value, **ROUNDING) if isinstance(value, float) else value), path


if __name__ == "__main__":
    content = {name: numbers_of(name) for name in sorted(examples())}
    NUMBERS.write_text(json.dumps(content, indent=1, ensure_ascii=False) + "\n", "utf-8")
