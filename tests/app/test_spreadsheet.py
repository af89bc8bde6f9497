"""In tables for spreadsheets, numbers of either sign stay numbers, and no typed text becomes a formula."""

import csv
import io
from typing import Any

import pytest

from app.calculations import BY_PATH
from app.examples import examples
from app.pages.cases import solved
from app.pages.csv import values
from app.pages.query import pairs_of
from app.pages.results import flattened
from app.schema.fields import leaf_at
from app.spreadsheet import csv_of
from app.studies.fields import NUMBERS
from tests.support.requests import example

NEGATIVE: dict[str, dict[str, Any]] = {
    "pahl-axial-displacement": {"operation.speed_rpm": -1910, "operation.misalignment_deg": -0.05},
    "xue-pair-1-modified": {"modifications.helix_slope_um": -12.5, "modifications.profile_slope_um": -1e-7},
    "starter-turbo-gear-drive-train": {"modifications.helix_slope_um": -20.0, "model.lubrication": "closed_form"},
}


def rows(content: bytes) -> list[list[str]]:
    return list(csv.reader(io.StringIO(content.decode(), newline="")))


@pytest.mark.parametrize("text", ["-1", "+2.5", "-0.5", "-1e-07", "-.5", "1.", "-1E+300"])
def test_a_number_is_a_number(text: str) -> None:
    assert rows(csv_of([[text]])) == [[text]]


FORMULAS = ("=1+1", "-1+1", "+cmd", "@sum", "--1", "-", "-1_0", "-x", "-1 ", "-\u0661", "\t=1", "\r=1", "\n=1", "-1;2")


@pytest.mark.parametrize("text", FORMULAS)
def test_a_formula_is_text(text: str) -> None:
    assert rows(csv_of([[text]])) == [[f"'{text}"]]


def test_a_separator_of_lists_begins_a_cell() -> None:
    """Where ; separates the cells, the text after it is a cell of its own."""
    assert rows(csv_of([["a; =1;b;@c;2"]])) == [["a; '=1;b;'@c;2"]]


@pytest.mark.parametrize("name", NEGATIVE)
def test_every_number_of_a_case_is_a_number_in_its_file(name: str) -> None:
    """The CSV file of a case contains every numeric input exactly as the answer does, also negative numbers."""
    changes = NEGATIVE[name]
    calculation = BY_PATH[examples()[name].endpoint]
    case = solved(calculation, pairs_of(example(name, changes)), None, "summary")
    cells = {path: value for path, _, value, *_ in rows(values(case, "-1+1"))}
    assert cells["title"] == "'-1+1"
    inputs = {
        path: value
        for path, value in flattened(case.response.inputs).items()
        if value is not None and (leaf := leaf_at(calculation.request, path)) and leaf.kind in NUMBERS
    }
    numbers = {path: value for path, value in inputs.items() if isinstance(value, int | float)}
    assert {path: float(cells[f"inputs.{path}"]) for path in numbers} == numbers
    assert {path: numbers[path] for path, value in changes.items() if path in numbers} == {
        path: value for path, value in changes.items() if isinstance(value, int | float)
    }
