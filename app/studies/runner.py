"""What all studies share: points solved in chunks on a pool of processes and handed on in order, and lines of them.

A kind of study declares its endpoint and its body, and has its checks and its lines.
"""

import asyncio
import json
import logging
import time
from abc import ABC, abstractmethod
from array import array
from collections import Counter, deque
from collections.abc import AsyncGenerator, Callable, Iterable, Sequence
from contextlib import aclosing
from math import nan
from typing import Any, ClassVar, Protocol

import numpy as np

from app.errors import DeadlineExceeded, Unprocessable, WorkerLost
from app.evaluate import calculation_at, case_of
from app.log import STUDIES_UNFINISHED
from app.schema.fields import Leaf
from app.schema.model import MODEL_VERSION
from app.schema.reading import validated
from app.sources import SOURCES
from app.studies.fields import is_number
from app.studies.points import CHUNK_SECONDS, BaseRequest, Chunk, Point, Question, reduced_request, solve_chunk
from app.studies.requests import Overrides
from solvers.arrays import FloatArray

CHUNKS_PER_SLOT = 2  # one at work, one that waits, so that no worker is idle
MOST_POINTS_IN_A_CHUNK = 1000  # however fast a point is: a chunk's answer stays small
PROGRESS_S = 2.0  # between lines of progress: proxies and users see that it runs

Line = dict[str, Any]
Lines = AsyncGenerator[list[Line], None]

logger = logging.getLogger("tribodrive")


class Pool(Protocol):
    """Where chunks are solved: the service's own worker processes, or a cluster."""

    @property
    def slots(self) -> int:
        """How many calls run at once."""

    def submit(self, function: Callable[..., Any], *arguments: Any) -> asyncio.Future[Any]:
        """Begin as soon as a process is free; cancelling takes back what has not begun and lets finish what has.

        The future raises WorkerLost, DeadlineExceeded, PoolLost, and what the function raises.
        """


class PoolLost(Exception):
    """The processes that solve points are gone; `code` names the reason in the line that ends the study."""

    code = "scheduler_lost"


class OtherSources(PoolLost):
    """A worker has other sources of the solvers than the service."""

    code = "other_sources"


class Clock:
    """How long a study has run and how far it has come."""

    def __init__(self, total: int) -> None:
        self.total = total
        self.done = 0
        self._started = time.perf_counter()

    @property
    def elapsed_s(self) -> float:
        """Seconds since the study began, to the millisecond."""
        return round(time.perf_counter() - self._started, 3)

    def line(self) -> Line:
        """How far the study has come."""
        return {"type": "progress", "done": self.done, "total": self.total, "elapsed_s": self.elapsed_s}

    def error(self, code: str, message: str) -> Line:
        """The line that ends a study before its time, which is logged and counted."""
        STUDIES_UNFINISHED.inc()
        logger.warning("a study ended after %d of %d points: %s", self.done, self.total, message)
        return {"type": "error", "code": code, "message": message, "done": self.done}


async def twice_if_lost(pool: Pool, function: Callable[..., Any], *arguments: Any) -> Any:
    """A single call; once more if its process is lost."""
    try:
        return await pool.submit(function, *arguments)
    except WorkerLost:
        return await pool.submit(function, *arguments)


async def in_order(
    pool: Pool, question: Question, overrides: Callable[[int], Overrides], indices: range, clock: Clock
) -> AsyncGenerator[tuple[range, list[Point]], None]:
    """Runs of points with their indices, in order; a chunk that loses its process is solved again point by point.

    `overrides` gives what the point of an index changes in the question's request.
    Leaving the iteration takes back the chunks that have not begun and waits for none.
    """

    def begun(some: range) -> tuple[range, asyncio.Future[Chunk]]:
        return some, pool.submit(solve_chunk, question, [overrides(index) for index in some])

    pending: deque[tuple[range, asyncio.Future[Chunk]]] = deque()
    size, left = 1, indices
    try:
        while left or pending:
            while left and len(pending) < CHUNKS_PER_SLOT * pool.slots:
                # Smaller chunks towards the end, so that all processes finish together.
                fair = max(1, min(size, -(-len(left) // (2 * pool.slots))))
                pending.append(begun(left[:fair]))
                left = left[fair:]
            sent, future = pending.popleft()
            try:
                chunk = await future
            except (WorkerLost, DeadlineExceeded) as error:
                chunk = await _solved_singly(pool, question, [overrides(index) for index in sent], error)
            done, rest = sent[: len(chunk.points)], sent[len(chunk.points) :]
            if rest:
                pending.appendleft(begun(rest))
            seconds = max(chunk.seconds / len(done), CHUNK_SECONDS / MOST_POINTS_IN_A_CHUNK)  # of a point
            size = max(1, round(CHUNK_SECONDS / seconds))
            clock.done += len(done)
            yield done, chunk.points
    finally:
        for _, future in pending:
            future.cancel()


async def _solved_singly(pool: Pool, question: Question, overrides: list[Overrides], error: Exception) -> Chunk:
    """The points of a lost chunk one by one, each up to twice; a single point that took too long is not repeated."""
    late = question.failed("deadline_exceeded", "the point took longer than the time limit of one calculation")
    if len(overrides) == 1 and isinstance(error, DeadlineExceeded):
        return Chunk([late], CHUNK_SECONDS)
    started = time.perf_counter()
    points: list[Point] = []
    for each in overrides:
        try:
            points += (await twice_if_lost(pool, solve_chunk, question, [each])).points
        except WorkerLost:
            points.append(question.failed("worker_lost", "the worker process died each time it solved the point"))
        except DeadlineExceeded:
            points.append(late)
    return Chunk(points, time.perf_counter() - started)


class Study(ABC):
    """A study that has passed its checks; the docstring of each kind describes its endpoint.

    It is made in a worker, from the body as JSON's objects or validated, the most points and the deadline of each;
    raises InvalidBody and Unprocessable with locations in the body. `outputs` are the first columns of `Point.out`.
    """

    path: ClassVar[str]  # of the endpoint; its last part is the type of the first line
    summary: ClassVar[str]
    answer: ClassVar[str]  # which lines there are
    model: ClassVar[type[Any]]  # of the body
    most: ClassVar[str] = "most_study_points"  # the setting that bounds the points
    is_reduced: ClassVar[bool] = True  # whether the film is left out where no output needs it

    def __init__(self, content: Any, most: int, deadline_s: float) -> None:
        self.body = validated(self.model, content)
        endpoint, request = self.body.endpoint, self.body.request
        base = BaseRequest(calculation_at(endpoint), request)
        self.outputs = self._outputs(base)
        paths = paths_of(self.outputs)
        asked = reduced_request(endpoint, request, paths) if self.is_reduced else request
        self.question = Question(endpoint, asked, paths, deadline_s)
        self.total = self._planned(base, most)
        try:
            self.case = case_of(self.path, self.body.model_dump(exclude={"from_index"}), SOURCES)
        except ValueError:  # in a field that every point replaces
            message = "holds a number that is not finite, or text that is not Unicode"
            raise Unprocessable("not_json", message, "request") from None

    def _outputs(self, base: BaseRequest) -> tuple[Leaf, ...]:
        """The outputs asked for, by default the headline numbers."""
        return base.outputs(self.body.outputs)

    @abstractmethod
    def _planned(self, base: BaseRequest, most: int) -> int:
        """How many points there are at most, once everything else of the body has been checked."""

    @abstractmethod
    def lines(self, pool: Pool, clock: Clock) -> Lines:
        """All lines but those of progress."""

    def encoder(self, _: str) -> Callable[[Line], bytes]:
        """Return what writes a line in a format; here there is only JSON."""
        return json_line

    def header(self, **content: Any) -> Line:
        """A line that identifies the study."""
        identity = {"model_version": MODEL_VERSION, "sources": SOURCES, "case": self.case}
        return {"type": self.path.rpartition("/")[2], "endpoint": self.question.endpoint, **content, **identity}


def output_header(leaf: Leaf) -> Line:
    """An output in the first line of a study."""
    return {"path": leaf.path, "unit": leaf.unit, "title": leaf.title}


def paths_of(leaves: Iterable[Leaf]) -> list[str]:
    """The dotted paths of fields."""
    return [leaf.path for leaf in leaves]


def point_line(index: int, at: Any, point: Point) -> Line:
    """The line of a point."""
    line = {"type": "point", "index": index, "at": at, "status": point.status, "out": point.out}
    line |= {"warnings": point.warnings, "ranks": point.ranks}
    return line if point.error is None else {**line, "error": point.error}


class Tally:
    """Counts of the points by status, of their errors and warnings by code; their assumptions; kept numbers.

    Each assumption is there once, by its field; a value that differs between points is null.
    """

    def __init__(self, outputs: Sequence[str]) -> None:
        self.counts: Counter[str] = Counter()
        self.errors: Counter[str] = Counter()
        self.warnings: Counter[str] = Counter()
        self.assumptions: dict[str, Line] = {}
        self._numbers = array("d")
        self.outputs = outputs

    def add(self, point: Point) -> None:
        """Take in the next point."""
        self.counts[point.status] += 1
        if point.error is not None:
            self.errors[point.error["code"]] += 1
        self.warnings.update(point.warnings)
        for each in point.assumptions:
            known = self.assumptions.setdefault(each["field"], each)
            if known["value"] != each["value"]:
                self.assumptions[each["field"]] = {**known, "value": None}

    def keep(self, out: Sequence[Any]) -> None:
        """Keep the numbers of a point."""
        self._numbers.extend(value if is_number(value) else nan for value in out)

    @property
    def values(self) -> FloatArray:
        """The numbers kept, one row per point, NaN where there is none."""
        return np.array(self._numbers).reshape(-1, len(self.outputs))


async def guarded(lines: Lines, clock: Clock, seconds: float, progress_s: float = PROGRESS_S) -> Lines:
    """The lines, with progress where none came for so long; a study that fails or takes too long ends with an error."""
    async with aclosing(lines):
        upcoming = asyncio.ensure_future(anext(lines, None))
        try:
            while (left := seconds - clock.elapsed_s) > 0.0:
                done, _ = await asyncio.wait({upcoming}, timeout=min(progress_s, left))
                if done:
                    group = upcoming.result()
                    if group is None:
                        return
                    if group:
                        yield group
                    upcoming = asyncio.ensure_future(anext(lines, None))
                elif left > progress_s:
                    yield [clock.line()]
            yield [clock.error("study_deadline", f"the study took longer than {seconds:g} s; make the study smaller")]
        except PoolLost as error:
            yield [clock.error(error.code, str(error))]
        except Exception:
            logger.exception("a study failed")
            yield [clock.error("internal_error", "something went wrong in the service; the log has the cause")]
        finally:
            upcoming.cancel()
            await asyncio.gather(upcoming, return_exceptions=True)


async def encoded(lines: Lines, encode: Callable[[Line], bytes]) -> AsyncGenerator[bytes, None]:
    """The lines as bytes, those that come together in one piece."""
    async with aclosing(lines):
        async for group in lines:
            if piece := b"".join(map(encode, group)):
                yield piece


def json_line(line: Line) -> bytes:
    """One line of newline-delimited JSON."""
    return json.dumps(line, ensure_ascii=False, allow_nan=False, separators=(",", ":")).encode() + b"\n"
