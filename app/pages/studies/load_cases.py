"""The table of load cases that the user pastes into the page of a load spectrum, and the cases that it states."""

import csv
from typing import Any, NamedTuple

from app.calculations import Calculation
from app.errors import Unprocessable
from app.pages.studies.page import titled
from app.pages.typed import number_of, power_between, question, scaled, separator_of, text_of
from app.pages.typesetting import words
from app.schema.fields import ITEM, leaf_at, leaves, value_at
from app.schema.quantities import split_unit
from app.studies.fields import NUMBERS

NAME, SHARE = "name", "share"
AROUND_UNIT = " ,;[]()"  # characters that may stand before and after the unit in the heading of a column
# Fields that a case of the spectrum usually changes. The page suggests a table of cases with these fields.
USUAL = (
    *("load.power_kw", "load.pinion_torque_n_m", "load.pinion_speed_rpm"),
    *("operation.power_kw", "operation.pinion_torque_n_m", "operation.torque_n_m"),
    *("operation.pinion_speed_rpm", "operation.speed_rpm", "temperatures.oil_c"),
)


class Column(NamedTuple):
    """A column of the table of load cases.

    `path` is the path of the field whose values the column contains. It is "name" for the names of the load cases, and
    "share" for their shares of the operating time. The numbers in the column are multiplied by 10**`power`.
    """

    path: str
    power: int = 0


def cases_of(calculation: Calculation, text: str) -> list[dict[str, Any]]:
    """Return the cases in a table. Raises Unprocessable if the table is not valid.

    The first line of the table names the columns: name, share, and fields by their labels or paths. The columns are
    separated by tabs, as in a table copied from a spreadsheet, or by semicolons. If a cell is empty, the case keeps the
    value of the base request.
    """
    lines = [line for line in text.splitlines() if line.strip()] or [""]
    try:
        heading, *rows = csv.reader(lines, delimiter=separator_of(text))
    except csv.Error:
        raise Unprocessable(
            "table",
            "the table cannot be read; write one case per line, with tabs or semicolons between the columns",
            "cases",
        ) from None
    columns = [_column(calculation, cell.strip()) for cell in heading]
    return [_case(calculation, columns, row, place) for place, row in enumerate(rows, start=2)] or [{}]


def _column(calculation: Calculation, heading: str) -> Column:
    """Return the column that a heading describes.

    A heading is "name", "share", the path of a field, the last part of such a path, or the label of a field in the
    form. A unit may follow the label. Raises Unprocessable if the heading fits several fields. If the heading fits no
    field, the heading is used as the path; the study then reports an unknown path.
    """
    plain = heading.lower()
    if leaf_at(calculation.request, heading) or plain in {NAME, SHARE}:
        return Column(heading if plain not in {NAME, SHARE} else plain)
    if plain.startswith(SHARE) and plain.removeprefix(SHARE).strip(AROUND_UNIT) == "%":
        return Column(SHARE, -2)
    # The longest label with which the heading begins has priority. Among labels of equal length, a label that the form
    # shows has priority.
    alike: dict[tuple[int, bool], dict[str, Column]] = {}
    for leaf in (leaf for leaf in leaves(calculation.request) if leaf.is_scalar and ITEM not in leaf.path):
        name = leaf.path.rpartition(".")[2]
        labels = {leaf.title, leaf.declared.title, name, words(split_unit(name)[0])}
        for label in filter(plain.startswith, map(str.lower, labels)):
            power = power_between(heading[len(label) :].strip(AROUND_UNIT), leaf.unit)
            if power is not None:
                shown = label == leaf.title.lower()
                alike.setdefault((len(label), shown), {})[leaf.title] = Column(leaf.path, power)
    meant = alike[max(alike)] if alike else {heading: Column(heading)}
    if len(meant) > 1:
        message = f"the heading {heading} can mean {' or '.join(meant)}; write one of these"
        raise Unprocessable("table", message, "cases")
    return next(iter(meant.values()))


def _case(calculation: Calculation, columns: list[Column], row: list[str], line: int) -> dict[str, Any]:
    """Return the case that a row of the table describes. Raises Unprocessable if the row is not valid.

    If a field does not accept the content of its cell, the content is kept as text. The study then reports the error.
    """
    if any(cell.strip() for cell in row[len(columns) :]):
        raise Unprocessable("table", f"line {line} has more columns than the first line", "cases")
    case: dict[str, Any] = {"set": {}}
    for (column, power), cell in zip(columns, map(str.strip, row), strict=False):
        leaf = leaf_at(calculation.request, column)
        if not cell:
            continue
        if column != NAME and (asked := question(cell)):
            raise Unprocessable("table", f"line {line}: {asked}", "cases")
        if column == NAME:
            case[NAME] = cell
        elif column == SHARE:
            share = scaled(number_of(cell.removesuffix("%").strip()), -2 if cell.endswith("%") else power)
            if isinstance(share, str):
                raise Unprocessable("table", f"line {line}: the share is not a number", "cases")
            case[SHARE] = float(share)
        elif leaf is not None and leaf.kind == "boolean":
            case["set"][column] = {"true": True, "false": False}.get(cell, cell)
        else:
            case["set"][column] = scaled(number_of(cell), power) if leaf is None or leaf.kind in NUMBERS else cell
    return case


def table_of(calculation: Calculation, cases: list[dict[str, Any]]) -> str:
    """Return the cases as the text of a table.

    The first line names the columns. The name of a field is the label of this field in the form. `cases_of` can read
    the text.
    """
    paths = list(dict.fromkeys(path for case in cases for path in case.get("set", {})))
    rows = [[NAME, SHARE, *(_heading(calculation, path) for path in paths)]]
    for place, case in enumerate(cases, start=1):
        own = case.get("set", {})
        head = [str(case.get(NAME) or f"case {place}"), text_of(case[SHARE]) if case.get(SHARE) is not None else ""]
        rows.append([*head, *(text_of(own[path]) if path in own else "" for path in paths)])
    return "\n".join("\t".join(cell.replace("\t", " ") for cell in row) for row in rows)


def _heading(calculation: Calculation, path: str) -> str:
    """Return the heading of a field's column: the label with the unit, or the path if the label fits several fields."""
    leaf = leaf_at(calculation.request, path)
    if leaf is None:
        return path
    try:
        meant = _column(calculation, titled(leaf))
    except Unprocessable:
        return path
    return titled(leaf) if meant == Column(path) else path


def suggested(calculation: Calculation, case: dict[str, Any]) -> str:
    """Return a table for the user to change: one row with the load of `case`, and one row with half of this load."""
    full = {path: value for path in USUAL if isinstance(value := value_at(case, path), int | float)}
    half = {path: value / 2 if "power" in path or "torque" in path else value for path, value in full.items()}
    return table_of(
        calculation, [{NAME: "full load", SHARE: 0.8, "set": full}, {NAME: "half load", SHARE: 0.2, "set": half}]
    )
