"""The common parts of all studies.

A pool of processes solves the points of a study. Points are sent to the processes in chunks, but come back in order.
The answer of a study is a sequence of lines. `Study` is the base class of the kinds of study. A subclass declares the
endpoint of the study and the model of the body. The subclass also checks the body and makes the lines.
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
from app.schema.answers import MODEL_VERSION
from app.schema.fields import Leaf
from app.schema.reading import validated
from app.sources import SOURCES
from app.studies.fields import is_number
from app.studies.points import (
    CHUNK_SECONDS,
    BaseRequest,
    Chunk,
    Point,
    Question,
    reduced_request,
    sized_flow,
    solve_chunk,
)
from app.studies.requests import Overrides
from solvers.arrays import FloatArray

CHUNKS_PER_SLOT = 2  # per process: one chunk is solved while another chunk waits, so that no process is idle
MOST_POINTS_IN_A_CHUNK = 1000  # limit for points that are solved very fast, so that the answer of a chunk stays small
PROGRESS_S = 2.0  # time between lines of progress; these lines show proxies and users that the study runs

Line = dict[str, Any]
Lines = AsyncGenerator[list[Line], None]

logger = logging.getLogger("tribodrive")


class Pool(Protocol):
    """The processes that solve chunks: the service's own workers, or a cluster."""

    @property
    def slots(self) -> int:
        """The number of calls that run at once."""

    def submit(self, function: Callable[..., Any], *arguments: Any) -> asyncio.Future[Any]:
        """Call the function in a process as soon as a process is free, and return the future of the result.

        Cancelling the future cancels a call that has not begun; a call that has begun runs to its end. The future
        raises WorkerLost, DeadlineExceeded, PoolLost, and the exceptions of the function.
        """


class PoolLost(Exception):
    """The processes that solve points are lost.

    The study then ends with a line that reports an error. `code` is the code of this error.
    """

    code = "scheduler_lost"


class OtherSources(PoolLost):
    """The source code of the solvers in a worker differs from the source code of the solvers in the service."""

    code = "other_sources"


class Clock:
    """The running time of a study and the number of its solved points."""

    def __init__(self, total: int) -> None:
        self.total = total
        self.done = 0
        self._started = time.perf_counter()

    @property
    def elapsed_s(self) -> float:
        """The time since the study began [s], rounded to milliseconds."""
        return round(time.perf_counter() - self._started, 3)

    def line(self) -> Line:
        """Return a line with the progress of the study."""
        return {"type": "progress", "done": self.done, "total": self.total, "elapsed_s": self.elapsed_s}

    def error(self, code: str, message: str) -> Line:
        """Return the line of an error that ends a study early. Log the error, and count the study as unfinished."""
        STUDIES_UNFINISHED.inc()
        logger.warning("a study ended after %d of %d points: %s", self.done, self.total, message)
        return {"type": "error", "code": code, "message": message, "done": self.done}


async def twice_if_lost(pool: Pool, function: Callable[..., Any], *arguments: Any) -> Any:
    """Call a function in a process of the pool and return its result. If the process is lost, repeat the call once."""
    try:
        return await pool.submit(function, *arguments)
    except WorkerLost:
        return await pool.submit(function, *arguments)


async def in_order(
    pool: Pool, question: Question, overrides: Callable[[int], Overrides], indices: range, clock: Clock
) -> AsyncGenerator[tuple[range, list[Point]], None]:
    """Solve the points with the given indices. Yield pairs: a range of indices, and the solved points of this range.

    The pairs are yielded in the order of the indices. `overrides` takes the index of a point, and returns the values
    by which the request of this point differs from `question.base`. If a chunk loses its process or exceeds the
    deadline, the points of the chunk are solved again one by one. If the caller leaves the iteration, chunks that have
    not begun are cancelled.
    """

    def submit(some: range) -> tuple[range, asyncio.Future[Chunk]]:
        return some, pool.submit(solve_chunk, question, [overrides(index) for index in some])

    pending: deque[tuple[range, asyncio.Future[Chunk]]] = deque()
    size, left = 1, indices
    try:
        while left or pending:
            while left and len(pending) < CHUNKS_PER_SLOT * pool.slots:
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
            seconds = max(chunk.seconds / len(done), CHUNK_SECONDS / MOST_POINTS_IN_A_CHUNK)  # time per point
            size = max(1, round(CHUNK_SECONDS / seconds))
            clock.done += len(done)
            yield done, chunk.points
    finally:
        for _, future in pending:
            future.cancel()


async def _solved_singly(pool: Pool, question: Question, overrides: list[Overrides], error: Exception) -> Chunk:
    """Solve the points of a chunk again, one by one, after the chunk failed with `error`.

    If the process that solves a point is lost, solve the point once more. If the chunk has only one point and
    exceeded the deadline, do not solve this point again.
    """
    late = question.failed("deadline_exceeded", "this point took longer than the time limit of one calculation")
    if len(overrides) == 1 and isinstance(error, DeadlineExceeded):
        return Chunk([late], CHUNK_SECONDS)
    started = time.perf_counter()
    points: list[Point] = []
    for point_overrides in overrides:
        try:
            points += (await twice_if_lost(pool, solve_chunk, question, [point_overrides])).points
        except WorkerLost:
            points.append(question.failed("worker_lost", "the worker process died every time it calculated this point"))
        except DeadlineExceeded:
            points.append(late)
    return Chunk(points, time.perf_counter() - started)


class Study(ABC):
    """Base class of the kinds of study. An object of this class is a study whose body has passed all checks.

    The docstring of a subclass is the description of the study's endpoint in the API. A worker constructs the study.
    The arguments are the content of the body (JSON objects or the validated model), the largest number of points, and
    the deadline of a point [s]. If a check fails, the constructor raises InvalidBody or Unprocessable. The error names
    the location of the fault in the body. `outputs` describes the first columns of `Point.out`. A subclass may add
    further columns.
    """

    path: ClassVar[str]  # path of the study's endpoint; its last part is also the type of the first line
    summary: ClassVar[str]  # summary of the endpoint in the API
    answer: ClassVar[str]  # text that lists the lines of the answer
    model: ClassVar[type[Any]]  # model of the body
    formats: ClassVar[tuple[str, ...]] = ("ndjson",)  # formats of the answer
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
        """Return the requested outputs, or the headline numbers if the request names no outputs."""
        return base.outputs(self.body.outputs)

    async def _size_flow(self, pool: Pool, first: Overrides) -> None:
        """Size the oil flow once, in a process of the pool; `first` holds the values of the first point."""
        flow = await twice_if_lost(pool, sized_flow, self.question, first)
        self.question = self.question._replace(gear_flow=flow)

    @abstractmethod
    def _planned(self, base: BaseRequest, most: int) -> int:
        """Check the remaining parts of the body and prepare the points.

        Return the number of points, or the largest possible number if the study may end early.
        """

    @abstractmethod
    def lines(self, pool: Pool, clock: Clock) -> Lines:
        """Yield the lines of the study's answer in groups. A group is yielded as soon as its lines are known.

        `guarded` adds the lines of progress.
        """

    def encoder(self, _: str) -> Callable[[Line], bytes]:
        """Return the function that converts a line into bytes in the requested format.

        In this class the function always writes JSON. Subclasses with further formats override this method.
        """
        return json_line

    def header(self, **content: Any) -> Line:
        """Return a line with the given content and with the data that identify the study.

        These data are the type of the line, the endpoint, the versions, and the identifier of the case.
        """
        identity = {"model_version": MODEL_VERSION, "sources": SOURCES, "case": self.case}
        return {"type": self.path.rpartition("/")[2], "endpoint": self.question.endpoint, **content, **identity}


def output_header(leaf: Leaf) -> Line:
    """Return the path, the unit and the title of an output or input, for a line of a study's answer."""
    return {"path": leaf.path, "unit": leaf.unit, "title": leaf.title}


def paths_of(leaves: Iterable[Leaf]) -> list[str]:
    return [leaf.path for leaf in leaves]


def point_line(index: int, at: Any, point: Point) -> Line:
    line = {"type": "point", "index": index, "at": at, "status": point.status, "out": point.out}
    line |= {"warnings": point.warnings, "ranks": point.ranks}
    return line if point.error is None else {**line, "error": point.error}


class Tally:
    """Counter of the points of a study per status, and of the errors and warnings per code.

    The tally also collects the assumptions and stores outputs. The keys of `assumptions` are the names of the fields.
    If the assumed value of a field differs between points, the `value` of its assumption is None.
    """

    def __init__(self, outputs: Sequence[str]) -> None:
        self.counts: Counter[str] = Counter()
        self.errors: Counter[str] = Counter()
        self.warnings: Counter[str] = Counter()
        self.assumptions: dict[str, Line] = {}
        self._numbers = array("d")
        self.outputs = outputs

    def add(self, point: Point) -> None:
        """Count a point, its error and its warnings, and merge its assumptions into `assumptions`."""
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
        """The stored outputs, one row per point. An output that is not a number is NaN."""
        return np.array(self._numbers).reshape(-1, len(self.outputs))


async def guarded(lines: Lines, clock: Clock, seconds: float, progress_s: float = PROGRESS_S) -> Lines:
    """Yield the lines of a study's answer. If no line comes for `progress_s` seconds, yield a line of progress.

    If the study fails, or if the study takes longer than `seconds`, the last line is an error.
    """
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
    """Yield the lines of each group as one bytes object. Skip groups without lines."""
    async with aclosing(lines):
        async for group in lines:
            if piece := b"".join(map(encode, group)):
                yield piece


def json_line(line: Line) -> bytes:
    """Return a line of newline-delimited JSON."""
    return json.dumps(line, ensure_ascii=False, allow_nan=False, separators=(",", ":")).encode() + b"\n"
