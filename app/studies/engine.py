"""What all studies share: points solved in chunks on a pool of processes and handed on in order, and the first line."""

import asyncio
import logging
import time
from abc import ABC, abstractmethod
from collections import deque
from collections.abc import AsyncGenerator, Callable, Iterable
from contextlib import aclosing
from dataclasses import dataclass
from typing import Any, Protocol

from app.errors import DeadlineExceeded, Unprocessable, WorkerLost
from app.evaluate import case_of
from app.log import STUDIES_UNFINISHED
from app.schema.fields import Leaf
from app.schema.model import MODEL_VERSION
from app.sources import SOURCES
from app.studies.points import CHUNK_SECONDS, Chunk, Point, Question, solve_chunk
from app.studies.requests import DriveTrainStudy, Overrides, StudyRequest

CHUNKS_PER_SLOT = 2  # one at work, one that waits, so that no worker is idle
MOST_POINTS_IN_A_CHUNK = 1000  # however fast a point is: a chunk's answer stays small

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
    pool: Pool, question: Question, overrides: Callable[[int], Overrides], indices: range
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
            yield done, chunk.points
    finally:
        for _, future in pending:
            future.cancel()


async def _solved_singly(pool: Pool, question: Question, overrides: list[Overrides], error: Exception) -> Chunk:
    """The points of a lost chunk one by one, each up to twice; a single point that took too long is not repeated."""
    late = question.failed("deadline_exceeded", "the point took longer than one calculation may")
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


@dataclass(frozen=True, slots=True, kw_only=True)
class Study(ABC):
    """A study that has passed its checks; `outputs` are in the order of the columns of `Point.out`."""

    question: Question
    outputs: tuple[Leaf, ...]
    case: str

    @property
    @abstractmethod
    def total(self) -> int:
        """How many points it has at most."""

    @abstractmethod
    def lines(self, pool: Pool, clock: Clock) -> Lines:
        """All lines but those of progress."""

    def header(self, kind: str, **content: Any) -> Line:
        """A line that identifies the study."""
        return {
            "type": kind,
            "endpoint": self.question.endpoint,
            **content,
            "model_version": MODEL_VERSION,
            "sources": SOURCES,
            "case": self.case,
        }

    async def solve(
        self, pool: Pool, clock: Clock, overrides: Callable[[int], Overrides], indices: range
    ) -> AsyncGenerator[tuple[range, list[Point]], None]:
        """Runs of points with their indices, in order."""
        async with aclosing(in_order(pool, self.question, overrides, indices)) as runs:
            async for solved, points in runs:
                clock.done += len(points)
                yield solved, points


def output_header(leaf: Leaf) -> Line:
    """An output in the first line of a study."""
    return {"path": leaf.path, "unit": leaf.unit, "title": leaf.title}


def paths_of(leaves: Iterable[Leaf]) -> list[str]:
    """The dotted paths of fields."""
    return [leaf.path for leaf in leaves]


def case_of_study(path: str, body: StudyRequest | DriveTrainStudy) -> str:
    """The hash of endpoint, body and sources of a study."""
    try:
        return case_of(path, body.model_dump(exclude={"from_index"}), SOURCES)
    except ValueError:  # in a field that every point replaces
        message = "holds a number that is not finite, or text that is not Unicode"
        raise Unprocessable("not_json", message, "request") from None
