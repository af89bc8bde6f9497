"""A study as a stream of lines: progress between them, an error line at an early end; written as JSON or as a table."""

import asyncio
import json
import logging
from collections.abc import AsyncGenerator, Callable
from contextlib import aclosing
from typing import Any

from app.schema.fields import Leaf
from app.spreadsheet import csv_of
from app.studies.engine import Clock, Line, Lines, PoolLost
from app.studies.point_sets import PointSet
from app.studies.points import Point

PROGRESS_S = 2.0  # between lines of progress: proxies and users see that it runs

logger = logging.getLogger("tribodrive")


async def guarded(lines: Lines, clock: Clock, seconds: float, progress_s: float = PROGRESS_S) -> Lines:
    """The lines, with progress where none came for so long; a study that fails or takes too long ends with an error."""
    async with aclosing(lines):
        upcoming = asyncio.ensure_future(anext(lines, None))
        try:
            while True:
                left = seconds - clock.elapsed_s
                if left <= 0.0:
                    yield [clock.error("study_deadline", f"the study took longer than {seconds:g} s; make it smaller")]
                    return
                done, _ = await asyncio.wait({upcoming}, timeout=min(progress_s, left))
                if not done:
                    if left > progress_s:
                        yield [clock.line()]
                    continue
                group, end = _outcome(upcoming, clock)
                if group:
                    yield group
                if end:
                    return
                upcoming = asyncio.ensure_future(anext(lines, None))
        finally:
            upcoming.cancel()
            await asyncio.gather(upcoming, return_exceptions=True)


def _outcome(upcoming: asyncio.Future[list[Line] | None], clock: Clock) -> tuple[list[Line], bool]:
    """The next lines, and whether they are the last."""
    try:
        group = upcoming.result()
    except PoolLost as error:
        return [clock.error(error.code, str(error))], True
    except Exception:
        logger.exception("a study failed")
        return [clock.error("internal_error", "something went wrong in the service; the log has the cause")], True
    return group or [], group is None


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
        "ranks": point.ranks,
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

    def __init__(self, points: PointSet, outputs: tuple[Leaf, ...]) -> None:
        self._points = points
        self._outputs = outputs
        inputs, results = ([_column(leaf) for leaf in leaves] for leaves in (points.varied, outputs))
        self._heading = ["index", *inputs, "status", *results, "warnings", "error"]

    def encode(self, line: Line) -> bytes:
        """The row of a line: none for progress and end; an error has a row with its message."""
        match line["type"]:
            case "sweep":
                return csv_of([self._heading])
            case "point":
                return csv_of([self._cells(line)])
            case "error":
                inputs, results = ([None] * len(leaves) for leaves in (self._points.varied, self._outputs))
                return csv_of([[None, *inputs, "error", *results, None, f"{line['code']}: {line['message']}"]])
            case _:
                return b""

    def _cells(self, line: Line) -> list[Any]:
        overrides = self._points.overrides(line["index"])
        at = [overrides.get(leaf.path) for leaf in self._points.varied]
        error = line.get("error")
        message = f"{error['code']}: {error['message']}" if error else None
        return [line["index"], *at, line["status"], *line["out"], " ".join(line["warnings"]), message]


def _column(leaf: Leaf) -> str:
    return f"{leaf.path} [{leaf.unit}]" if leaf.unit else leaf.path
