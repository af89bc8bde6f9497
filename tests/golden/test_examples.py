"""The numbers of every example agree with the numbers that were accepted last.

These tests notice every change beyond rounding, whether the change is intended or not. They do not show that a number
is correct; the tests in tests/papers do. After an intended change, run

`python -m tests.golden.test_examples "what was changed, which numbers moved, why"`

This command writes the numbers to numbers.json, appends the text to the list "Numbers" of the newest version in
CHANGELOG.md and renews the version's hash; without a text it only renews the hash. Both files belong to the commit.
"""

import itertools
import json
import re
import sys
import textwrap
import tomllib
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path
from typing import Any

import pytest

from app.calculations import CALCULATIONS
from app.evaluate import evaluate
from app.examples import examples

NUMBERS = Path(__file__).with_name("numbers.json")
CHANGELOG = Path(__file__).parents[2] / "CHANGELOG.md"
PROJECT = CHANGELOG.with_name("pyproject.toml")
NOT_RESULTS = {"inputs", "case", "model_version", "sources", "model", "assumptions"}
ROUNDING = {"rel": 1e-6, "abs": 1e-9}
"""The differences that rounding on another processor may cause.

Rounding changes the results of iterations, and numbers that would be zero without rounding.
"""


def numbers_of(name: str) -> dict[str, Any]:
    """Return all results in the summary of an example by their paths, and the codes of its warnings."""
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


def agrees(found: Any, wanted: Any) -> bool:
    return bool(found == (pytest.approx(wanted, **ROUNDING) if isinstance(wanted, float) else wanted))


@pytest.mark.parametrize("name", sorted(examples()))
def test_numbers_are_as_accepted(name: str) -> None:
    found, wanted = numbers_of(name), accepted()[name]
    assert list(found) == list(wanted)
    for path, value in wanted.items():
        assert agrees(found[path], value), f"{path}: {found[path]}, accepted {value}"


def hash_of_numbers() -> str:
    return sha256(NUMBERS.read_bytes()).hexdigest()


def test_the_changelog_is_about_these_numbers() -> None:
    assert sections()[0][1] == hash_of_numbers(), "see the docstring of this module"


def sections() -> list[tuple[tuple[int, ...], str]]:
    """Return the version and the hash of every section of the changelog, newest first."""
    found = [part.partition("\n") for part in CHANGELOG.read_text("utf-8").split("\n## ")[1:]]
    hashes = [re.findall(r"`([0-9a-f]{64})`", entries) for _, _, entries in found]
    return [(tuple(map(int, title.split("."))), only) for (title, *_), (only,) in zip(found, hashes, strict=True)]


def test_the_newest_section_is_the_version_of_the_project() -> None:
    project = tomllib.loads(PROJECT.read_text("utf-8"))["project"]
    assert sections()[0][0] == tuple(map(int, project["version"].split(".")))


def test_moved_numbers_are_at_least_a_minor_version() -> None:
    for (version, numbers), (before, numbers_before) in itertools.pairwise(sections()):
        assert version > before
        assert numbers == numbers_before or version[:2] > before[:2], f"numbers moved between {before} and {version}"


def accept(entry: str) -> None:
    """Write the numbers that differ by more than rounding, renew the hash of the newest version and append `entry`."""
    known = accepted()
    content = {}
    for name in sorted(examples()):
        old = known.get(name, {})
        content[name] = {
            path: old[path] if path in old and agrees(value, old[path]) else value
            for path, value in numbers_of(name).items()
        }
    NUMBERS.write_text(json.dumps(content, indent=1, ensure_ascii=False) + "\n", "utf-8")
    changelog = re.sub(r"`[0-9a-f]{64}`", f"`{hash_of_numbers()}`", CHANGELOG.read_text("utf-8"), count=1)
    if entry:
        text = textwrap.fill(entry, 120, initial_indent="* ", subsequent_indent="  ")
        numbers, service, rest = changelog.partition("\n\n### Service\n")
        changelog = f"{numbers}\n{text}{service}{rest}"
    CHANGELOG.write_text(changelog, "utf-8")


if __name__ == "__main__":
    accept(" ".join(sys.argv[1:]))
