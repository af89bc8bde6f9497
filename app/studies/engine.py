"""Runs the points of a study in chunks on a pool of processes and hands their answers on in order."""

import asyncio
import time
from collections import deque
from collections.abc import AsyncGenerator, Callable
from dataclasses import dataclass
from typing import Any, Protocol

from app.errors import DeadlineExceeded, WorkerLost
from app.studies.points import CHUNK_SECONDS, Chunk, Point, Question, solve_chunk
from app.studies.requests import Overrides

CHUNKS_PER_SLOT = 2
MOST_POINTS_IN_A_CHUNK = 1000


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


@dataclass(frozen=True, slots=True)
class Work:
    """The points to solve."""

    question: Question
    overrides: Callable[[int], Overrides]
    total: int

    def begin(self, pool: Pool, indices: range) -> asyncio.Future[Chunk]:
        """Send points to the pool."""
        return pool.submit(solve_chunk, self.question, [self.overrides(index) for index in indices])


async def twice_if_lost(pool: Pool, function: Callable[..., Any], *arguments: Any) -> Any:
    """A single call; once more if its process is lost."""
    try:
        return await pool.submit(function, *arguments)
    except WorkerLost:
        return await pool.submit(function, *arguments)


async def in_order(pool: Pool, work: Work) -> AsyncGenerator[tuple[range, list[Point]], None]:
    """Runs of points with their indices, in order; a chunk that loses its process is solved again point by point.

    Leaving the iteration takes back the chunks that have not begun and waits for none.
    """
    pending: deque[tuple[range, asyncio.Future[Chunk]]] = deque()
    size, begun = 1, 0
    try:
        while begun < work.total or pending:
            while begun < work.total and len(pending) < CHUNKS_PER_SLOT * pool.slots:
                indices = range(begun, begun + _fair(size, work.total - begun, pool.slots))
                pending.append((indices, work.begin(pool, indices)))
                begun = indices.stop
            indices, future = pending.popleft()
            try:
                chunk = await future
            except (WorkerLost, DeadlineExceeded) as error:
                chunk = await _solved_singly(pool, work, indices, error)
            done, left = indices[: len(chunk.points)], indices[len(chunk.points) :]
            if left:
                pending.appendleft((left, work.begin(pool, left)))
            size = _next_size(len(done), chunk.seconds)
            yield done, chunk.points
    finally:
        for _, future in pending:
            future.cancel()


def _next_size(points: int, seconds: float) -> int:
    """As many points as take about a chunk's time."""
    each = max(seconds / points, CHUNK_SECONDS / MOST_POINTS_IN_A_CHUNK)
    return max(1, round(CHUNK_SECONDS / each))


def _fair(size: int, left: int, slots: int) -> int:
    """Smaller chunks towards the end, so that all processes finish together."""
    return max(1, min(size, -(-left // (2 * slots))))


async def _solved_singly(pool: Pool, work: Work, indices: range, error: Exception) -> Chunk:
    """The points of a lost chunk one by one, each up to twice; a single point that took too long is not repeated."""
    if len(indices) == 1 and isinstance(error, DeadlineExceeded):
        return Chunk([_late(work)], CHUNK_SECONDS)
    started = time.perf_counter()
    points: list[Point] = []
    for index in indices:
        try:
            alone = [work.overrides(index)]
            points += (await twice_if_lost(pool, solve_chunk, work.question, alone)).points
        except WorkerLost:
            points.append(work.question.failed("worker_lost", "the worker process died each time it solved the point"))
        except DeadlineExceeded:
            points.append(_late(work))
    return Chunk(points, time.perf_counter() - started)


def _late(work: Work) -> Point:
    return work.question.failed("deadline_exceeded", "the point took longer than one calculation may")
