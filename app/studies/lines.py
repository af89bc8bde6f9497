"""A study's answer, line by line: as JSON objects, or as a table."""

import csv
import io
import json
from collections.abc import Iterator
from typing import Any

from app.studies.points import Point
from app.studies.requests import Scalar

FORMULA_SIGNS = ("=", "+", "-", "@", "\t", "\r")


def json_line(line: dict[str, Any]) -> bytes:
    """One line of newline-delimited JSON."""
    return json.dumps(line, ensure_ascii=False, allow_nan=False, separators=(",", ":")).encode() + b"\n"


def point_line(index: int, at: Any, point: Point) -> dict[str, Any]:
    """The line of a point."""
    line = {
        "type": "point",
        "index": index,
        "at": at,
        "status": point.status,
        "out": point.out,
        "warnings": point.warnings,
    }
    if point.error is not None:
        line["error"] = point.error
    return line


class Table:
    """A sweep as comma-separated values: a header with units, then a row a point."""

    def __init__(self, header: dict[str, Any], columns: list[str]) -> None:
        self._coordinates = columns
        axes = [
            _heading(path, axis["unit"])
            for axis in header["axes"]
            for path in (axis["path"] if isinstance(axis["path"], list) else [axis["path"]])
        ] or columns
        outputs = [_heading(output["path"], output["unit"]) for output in header["outputs"]]
        self.header = _row(["index", *axes, "status", *outputs, "warnings", "error"])

    def row(self, line: dict[str, Any], coordinates: dict[str, Scalar]) -> bytes:
        """The row of a point."""
        error = line.get("error")
        at = [coordinates.get(path) for path in self._coordinates]
        tail = [" ".join(line["warnings"]), f"{error['code']}: {error['message']}" if error else None]
        return _row([line["index"], *at, line["status"], *line["out"], *tail])


def _heading(path: str, unit: str | None) -> str:
    return f"{path} [{unit}]" if unit else path


def _row(cells: list[Any]) -> bytes:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerow([_cell(cell) for cell in cells])
    return text.getvalue().encode()


def _cell(value: Any) -> Any:
    """A cell that no spreadsheet takes for a formula."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str) and value.startswith(FORMULA_SIGNS):
        return f"'{value}"
    return value


def columns_of(header: dict[str, Any], cases: list[dict[str, Scalar]] | None) -> list[str]:
    """The varied fields, in the order of the axes or of their first appearance in the cases."""
    return list(_paths(header, cases))


def _paths(header: dict[str, Any], cases: list[dict[str, Scalar]] | None) -> Iterator[str]:
    if cases is not None:
        yield from dict.fromkeys(path for case in cases for path in case)
    for axis in header["axes"]:
        yield from axis["path"] if isinstance(axis["path"], list) else [axis["path"]]
