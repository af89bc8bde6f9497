"""The common parts of all studies.

A pool solves the points of a study in chunks, which come back in order. The answer is a sequence of lines. `Study` is
the base class of the kinds: a subclass declares endpoint and body, checks the body and makes the lines.
"""

import json
import logging
import time
from abc import ABC, abstractmethod
from array import array
from collections import Counter, deque
from collections.abc import AsyncGenerator, Awaitable, Callable, Iterable, Sequence
from math import nan
from typing import Any, ClassVar, NamedTuple, Protocol

import numpy as np

from app.errors import DeadlineExceeded, Unprocessable, WorkerLost
from app.evaluate import calculation_at, case_of
from app.log import STUDIES_UNFINISHED
from app.schema.answers import MODEL_VERSION
from app.schema.fields import Leaf
from app.schema.reading import validated
from app.sources import SOURCES
from app.studies.fields import is_number
from app.studies.points import BaseRequest, Chunk, Point, Question, reduced_request, sized_flow, solve_chunk
from app.studies.requests import Overrides
from solvers.arrays import FloatArray

MOST_POINTS_IN_A_CHUNK = 1000  # limit for points that are solved very fast, so that the answer of a chunk stays small
LONG_S = 5.0  # how long a study is left is said if it takes longer

Line = dict[str, Any]
Lines = AsyncGenerator[list[Line], None]

logger = logging.getLogger("tribodrive")


class Call(Awaitable[Any], Protocol):
    """A call in a process. It raises WorkerLost, DeadlineExceeded, PoolLost, and the exceptions of its function."""

    def cancel(self) -> Any:
        """Take the call back unless it has begun; a call that has begun runs to its end."""


class Pool(Protocol):
    """What solves chunks: the service's workers, a cluster, or any `map` of a script."""

    chunk_s: float  # usual computing time of a chunk; after a chunk, a process can do the work of another client
    longest_s: float  # after this time a chunk ends, and what is left of it is sent again
    ahead: int  # chunks per slot, sent before the first of them is back; with two, no process is idle

    @property
    def slots(self) -> int:
        """The number of calls that run at once."""

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Call:
        """Call the function in a process as soon as one is free."""


class Progress(NamedTuple):
    """How many points of a study are solved, and how long the rest will take [s]; None if this is not worth saying."""

    done: int
    total: int
    left_s: float | None = None


class Clock:
    """The running time of a study and the number of its solved points, `kept` of which took no time."""

    def __init__(self, total: int) -> None:
        self.total = total
        self.done = self.kept = 0
        self._started = time.perf_counter()

    @property
    def elapsed_s(self) -> float:
        """The time since the study began [s], rounded to milliseconds."""
        return round(time.perf_counter() - self._started, 3)

    @property
    def progress(self) -> Progress:
        """The progress of the study; the points still to solve are expected to take as long as those solved now."""
        elapsed, left = self.elapsed_s, None
        if self.done > self.kept:
            left = elapsed * max(self.total - self.done, 0) / (self.done - self.kept)
        return Progress(self.done, self.total, left if left and elapsed + left > LONG_S else None)

    def line(self) -> Line:
        """Return a line with the progress."""
        done, total, left = self.progress
        told = {"type": "progress", "done": done, "total": total, "elapsed_s": self.elapsed_s}
        return told if left is None else {**told, "left_s": round(left, 1)}

    def error(self, code: str, message: str) -> Line:
        """Return the line of an error that ends the study early, log it and count it."""
        STUDIES_UNFINISHED.inc()
        logger.warning("a study ended after %d of %d points: %s", self.done, self.total, message)
        return {"type": "error", "code": code, "message": message, "done": self.done}


async def twice_if_lost(pool: Pool, function: Callable[..., Any], *arguments: Any) -> Any:
    """Return the result of a call in a process of the pool; repeat the call once if its process is lost."""
    try:
        return await pool.submit(function, *arguments)
    except WorkerLost:
        return await pool.submit(function, *arguments)


async def in_order(
    pool: Pool, question: Question, overrides: Callable[[int], Overrides], indices: range, clock: Clock
) -> AsyncGenerator[tuple[range, list[Point]], None]:
    """Solve the points with the given indices. Yield ranges of indices in their order, with the points of each.

    `overrides` returns the values by which the request of a point differs from `question.base`. If a chunk loses its
    process or exceeds the deadline, its points are solved again one by one. If the caller leaves the iteration, chunks
    that have not begun are taken back.
    """

    def submit(some: range) -> tuple[range, Call]:
        return some, pool.submit(solve_chunk, question, [overrides(index) for index in some], pool.longest_s)

    pending: deque[tuple[range, Call]] = deque()
    size, left = 1, indices
    try:
        while left or pending:
            while left and len(pending) < pool.ahead * pool.slots:
                # Chunks become smaller towards the end, so that all processes finish together.
                fair = max(1, min(size, -(-len(left) // (2 * pool.slots))))
                pending.append(submit(left[:fair]))
                left = left[fair:]
            sent, future = pending.popleft()
            try:
                chunk = await future
            except (WorkerLost, DeadlineExceeded) as error:
                chunk = await _solved_singly(pool, question, [overrides(index) for index in sent], error)
            done, rest = sent[: len(chunk.points)], sent[len(chunk.points) :]
            if rest:
                pending.appendleft(submit(rest))
            if chunk.seconds is None:
                clock.kept += len(done)
            else:
                seconds = max(chunk.seconds / len(done), pool.chunk_s / MOST_POINTS_IN_A_CHUNK)  # time per point
                size = max(1, round(pool.chunk_s / seconds))
            clock.done += len(done)
            yield done, chunk.points
    finally:
        for _, future in pending:
            future.cancel()


async def _solved_singly(pool: Pool, question: Question, overrides: list[Overrides], error: Exception) -> Chunk:
    """Solve the points of a chunk again, one by one, after the chunk failed with `error`.

    A point that loses its process is solved once more; one that exceeded the deadline alone is not.
    """
    late = question.failed("deadline_exceeded", "this point took longer than the time limit of one calculation")
    if len(overrides) == 1 and isinstance(error, DeadlineExceeded):
        return Chunk([late], pool.chunk_s)
    started = time.perf_counter()
    points: list[Point] = []
    for point_overrides in overrides:
        try:
            points += (await twice_if_lost(pool, solve_chunk, question, [point_overrides], pool.longest_s)).points
        except WorkerLost:
            points.append(question.failed("worker_lost", "the worker process died every time it calculated this point"))
        except DeadlineExceeded:
            points.append(late)
    return Chunk(points, time.perf_counter() - started)


class Study(ABC):
    """Base class of the kinds of study: a study whose body has passed all checks.

    The docstring of a subclass describes the endpoint in the API. The constructor, which runs in a worker, takes the
    content of the body (JSON objects or the validated model), the largest number of points and the deadline of a point
    [s]; it raises InvalidBody or Unprocessable with the place of the fault. `outputs` describes the first columns of
    `Point.out`; a subclass may add further columns.
    """

    path: ClassVar[str]  # of the endpoint; its last part is also the type of the first line
    summary: ClassVar[str]  # of the endpoint in the API
    answer: ClassVar[str]  # text that lists the lines of the answer
    model: ClassVar[type[Any]]  # of the body
    formats: ClassVar[tuple[str, ...]] = ("ndjson",)  # of the answer
    most: ClassVar[str] = "most_study_points"  # name of the setting that limits the number of points
    is_reduced: ClassVar[bool] = True  # True if calculations that no output needs are left out

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
        except ValueError:  # the checks miss a faulty field if every point replaces the field
            message = "the request holds a number that is not finite, or text that is not Unicode"
            raise Unprocessable("not_json", message, "request") from None

    def _outputs(self, base: BaseRequest) -> tuple[Leaf, ...]:
        """Return the requested outputs, or else the headline numbers."""
        return base.outputs(self.body.outputs)

    async def _size_flow(self, pool: Pool, first: Overrides) -> None:
        """Size the oil flow once, in a process of the pool; `first` holds the values of the first point."""
        flow = await twice_if_lost(pool, sized_flow, self.question, first)
        self.question = self.question._replace(gear_flow=flow)

    @abstractmethod
    def _planned(self, base: BaseRequest, most: int) -> int:
        """Check the rest of the body, prepare the points and return their number, the largest if it may end early."""

    @abstractmethod
    def lines(self, pool: Pool, clock: Clock) -> Lines:
        """Yield the lines of the answer in groups, as soon as they are known.

        A `map` waits where this function waits for the pool, so it waits for nothing else.
        """

    def encoder(self, _: str) -> Callable[[Line], bytes]:
        """Return the function that writes a line in the requested format: JSON, unless a subclass has others."""
        return json_line

    def header(self, **content: Any) -> Line:
        """Return a line with this content and with what identifies the study: type, endpoint, versions and case."""
        identity = {"model_version": MODEL_VERSION, "sources": SOURCES, "case": self.case}
        return {"type": self.path.rpartition("/")[2], "endpoint": self.question.endpoint, **content, **identity}


def output_header(leaf: Leaf) -> Line:
    """Return path, unit and title of an output or input, for a line of the answer."""
    return {"path": leaf.path, "unit": leaf.unit, "title": leaf.title}


def paths_of(leaves: Iterable[Leaf]) -> list[str]:
    return [leaf.path for leaf in leaves]


def point_line(index: int, at: Any, point: Point) -> Line:
    line = {"type": "point", "index": index, "at": at, "status": point.status, "out": point.out}
    line |= {"warnings": point.warnings, "ranks": point.ranks}
    return line if point.error is None else {**line, "error": point.error}


class Tally:
    """Counter of the points per status, of errors and warnings per code; it also stores outputs.

    It collects the assumptions by their fields; one whose value differs between points has the `value` None.
    """

    def __init__(self, outputs: Sequence[str]) -> None:
        self.counts: Counter[str] = Counter()
        self.errors: Counter[str] = Counter()
        self.warnings: Counter[str] = Counter()
        self.assumptions: dict[str, Line] = {}
        self._numbers = array("d")
        self.outputs = outputs

    def add(self, point: Point) -> None:
        """Count a point, its error and its warnings, and merge its assumptions."""
        self.counts[point.status] += 1
        if point.error is not None:
            self.errors[point.error["code"]] += 1
        self.warnings.update(point.warnings)
        for assumption in point.assumptions:
            first = self.assumptions.setdefault(assumption["field"], assumption)
            if first["value"] != assumption["value"]:
                self.assumptions[assumption["field"]] = {**first, "value": None}

    def keep(self, out: Sequence[Any]) -> None:
        """Store the outputs of a point."""
        self._numbers.extend(value if is_number(value) else nan for value in out)

    @property
    def values(self) -> FloatArray:
        """The stored outputs, one row per point; NaN if an output is no number."""
        return np.array(self._numbers).reshape(-1, len(self.outputs))


def json_line(line: Line) -> bytes:
    """Return a line of newline-delimited JSON."""
    return json.dumps(line, ensure_ascii=False, allow_nan=False, separators=(",", ":")).encode() + b"\n"
