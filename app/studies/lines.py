"""How a study's lines are written: as JSON, or as a table."""

import csv
import io
import json
from collections.abc import AsyncGenerator, Callable
from contextlib import aclosing
from typing import Any

from app.schema.fields import Leaf
from app.studies.plan import Plan
from app.studies.points import Point
from app.studies.stream import Line, Lines

FORMULA_SIGNS = ("=", "+", "-", "@", "\t", "\r")


class StudyBroke(Exception):
    """A table cannot say that it is not whole; its connection is cut instead."""


def json_line(line: Line) -> bytes:
    """One line of newline-delimited JSON."""
    return json.dumps(line, ensure_ascii=False, allow_nan=False, separators=(",", ":")).encode() + b"\n"


def point_line(index: int, at: Any, point: Point) -> Line:
    """The line of a point."""
    line = {
        "type": "point",
        "index": index,
        "at": at,
        "status": point.status,
        "out": point.out,
        "warnings": point.warnings,
    }
    return line if point.error is None else {**line, "error": point.error}


async def encoded(lines: Lines, encode: Callable[[Line], bytes]) -> AsyncGenerator[bytes, None]:
    """The lines as bytes, those that come together in one piece."""
    async with aclosing(lines):
        async for group in lines:
            if piece := b"".join(map(encode, group)):
                yield piece


class Table:
    """A sweep as comma-separated values: a header with units, then a row a point."""

    def __init__(self, plan: Plan, varied: tuple[Leaf, ...], outputs: tuple[Leaf, ...]) -> None:
        self._plan = plan
        self._varied = [leaf.path for leaf in varied]
        names = [f"{leaf.path} [{leaf.unit}]" if leaf.unit else leaf.path for leaf in (*varied, *outputs)]
        self._heading = ["index", *names[: len(varied)], "status", *names[len(varied) :], "warnings", "error"]

    def encode(self, line: Line) -> bytes:
        """The row or rows of a line; those of progress and end have none."""
        match line["type"]:
            case "sweep":
                return _row(self._heading)
            case "point":
                return _row(self._cells(line))
            case "error":
                raise StudyBroke(line["message"])
            case _:
                return b""

    def _cells(self, line: Line) -> list[Any]:
        overrides = self._plan.overrides(line["index"])
        at = [overrides.get(path) for path in self._varied]
        error = line.get("error")
        message = f"{error['code']}: {error['message']}" if error else None
        return [line["index"], *at, line["status"], *line["out"], " ".join(line["warnings"]), message]


def _row(cells: list[Any]) -> bytes:
    text = io.StringIO()
    csv.writer(text).writerow([_cell(cell) for cell in cells])
    return text.getvalue().encode()


def _cell(value: Any) -> Any:
    """A cell that no spreadsheet takes for a formula."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str) and value.startswith(FORMULA_SIGNS):
        return f"'{value}"
    return value
