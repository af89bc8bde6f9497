"""Points of former runs, kept in a file of JSON lines, so that a study goes on after a crash.

The first line names the solvers. Every other line is a point with its `case`: the hash of its request, of the outputs
and of the solvers. Studies that share points can share a file, also at once: it is locked while it is read or written.
"""

import json
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import takewhile
from pathlib import Path
from typing import Any, BinaryIO

from app.calculations import BY_PATH
from app.errors import OtherSources
from app.evaluate import case_of
from app.schema.answers import MODEL_VERSION
from app.sources import SOURCES
from app.studies.points import Chunk, Point, Question, with_overrides
from app.studies.requests import Overrides

try:
    import fcntl
except ImportError:  # Windows, where files are not locked
    fcntl = None  # type: ignore[assignment]

HEAD = {"type": "kept", "model_version": MODEL_VERSION, "sources": SOURCES}


class Kept:
    """The points in a file, which is made if it is missing. Raises OtherSources if other solvers calculated them.

    A last line that a crash has cut off is removed. Raises ValueError if the file holds anything else.
    """

    def __init__(self, file: Path) -> None:
        self._file = file
        self._points: dict[str, Point] = {}
        self._assumptions: tuple[dict[str, Any], ...] = ()  # of the last line read; the next need not repeat them
        with _locked(file) as opened:
            content = opened.read()
            whole, newline, torn = content.rpartition(b"\n")
            head, *lines = whole.splitlines() or [torn]
            if newline:
                self._check(head)
            elif not _line(HEAD).startswith(torn):
                raise ValueError(f"{file} holds no kept points; name another file")
            for number, line in enumerate(lines, start=2):
                try:
                    self._read(json.loads(line))
                except (ValueError, LookupError, TypeError, AttributeError) as error:
                    raise ValueError(f"line {number} of {file} is no kept point; name another file") from error
            opened.truncate(len(whole) + len(newline))
            if not newline:
                opened.write(_line(HEAD))

    def _check(self, head: bytes) -> None:
        """Raise ValueError or OtherSources unless the first line is that of these solvers."""
        try:
            kind, sources = (json.loads(head)[name] for name in ("type", "sources"))
        except (ValueError, LookupError, TypeError) as error:
            raise ValueError(f"{self._file} holds no kept points; name another file") from error
        if kind != HEAD["type"]:
            raise ValueError(f"{self._file} holds no kept points; name another file")
        if sources != SOURCES:
            raise OtherSources(
                f"other solvers (hash {sources}) calculated the points in {self._file} than those of this process "
                f"(hash {SOURCES}); name another file"
            )

    def _read(self, line: dict[str, Any]) -> None:
        case, assumptions = line.pop("case"), line.pop("assumptions")
        self._assumptions = self._assumptions if assumptions is None else tuple(assumptions)
        ranks = tuple(line.pop("ranks"))
        self._points[case] = Point(**line, assumptions=self._assumptions, ranks=ranks)

    def __contains__(self, case: str) -> bool:
        return case in self._points

    def leading(self, cases: list[str]) -> list[Point]:
        """Return the points of the first cases, up to the first that was not kept."""
        return [self._points[case] for case in takewhile(self._points.__contains__, cases)]

    def add(self, cases: list[str], chunk: Chunk) -> None:
        """Keep the points of a chunk, but not those that failed, because another run may solve them."""
        lines: list[dict[str, Any]] = []
        before = None  # the first line states its assumptions, because the line before it may be of another process
        for case, point in zip(cases, chunk.points, strict=False):
            if point.status != "failed":
                assumptions = None if point.assumptions == before else point.assumptions
                lines.append({"case": case, **point._asdict(), "assumptions": assumptions})
                self._points[case], before = point, point.assumptions
        with _locked(self._file) as opened:
            opened.write(b"".join(map(_line, lines)))


@contextmanager
def _locked(file: Path) -> Iterator[BinaryIO]:
    """Open a file to read it from the start and to write at its end, while no other process does."""
    with file.open("a+b") as opened:
        if fcntl:
            fcntl.flock(opened, fcntl.LOCK_EX)
        opened.seek(0)
        yield opened


def case_of_point(question: Question, overrides: Overrides) -> str:
    """Return the hash of what determines a point: its request, the oil flow of the study, its outputs, the solvers."""
    request = with_overrides(BY_PATH[question.endpoint], question.base, overrides)
    asked = {"request": request, "gear_flow": question.gear_flow, "outputs": list(question.outputs)}
    return case_of(question.endpoint, asked, SOURCES)


def _line(content: dict[str, Any]) -> bytes:
    return json.dumps(content, ensure_ascii=False, allow_nan=False, separators=(",", ":")).encode() + b"\n"
