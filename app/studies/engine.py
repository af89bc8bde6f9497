"""Runs the points of a study in chunks on a pool of processes and hands their answers on in order."""

import asyncio
import time
from collections import deque
from collections.abc import AsyncGenerator, Callable
from typing import Any, NamedTuple, Protocol

from app.errors import DeadlineExceeded, WorkerLost
from app.studies.points import CHUNK_SECONDS, Chunk, Point, Question, solve_chunk
from app.studies.requests import Overrides

CHUNKS_PER_SLOT = 2  # one at work, one that waits, so that no worker is idle
MOST_POINTS_IN_A_CHUNK = 1000  # however fast a point is: a chunk's answer stays small


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


class Work(NamedTuple):
    """The points to solve: those at `indices`, and what each changes in the question's request."""

    question: Question
    overrides: Callable[[int], Overrides]
    indices: range

    def begin(self, pool: Pool, indices: range) -> asyncio.Future[Chunk]:
        """Send points to the pool."""
        return pool.submit(solve_chunk, self.question, [self.overrides(index) for index in indices])

    def late(self) -> Point:
        """A point that took too long."""
        return self.question.failed("deadline_exceeded", "the point took longer than one calculation may")


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
    size, left = 1, work.indices
    try:
        while left or pending:
            while left and len(pending) < CHUNKS_PER_SLOT * pool.slots:
                # Smaller chunks towards the end, so that all processes finish together.
                fair = max(1, min(size, -(-len(left) // (2 * pool.slots))))
                pending.append((left[:fair], work.begin(pool, left[:fair])))
                left = left[fair:]
            indices, future = pending.popleft()
            try:
                chunk = await future
            except (WorkerLost, DeadlineExceeded) as error:
                chunk = await _solved_singly(pool, work, indices, error)
            done, rest = indices[: len(chunk.points)], indices[len(chunk.points) :]
            if rest:
                pending.appendleft((rest, work.begin(pool, rest)))
            seconds = max(chunk.seconds / len(done), CHUNK_SECONDS / MOST_POINTS_IN_A_CHUNK)  # of a point
            size = max(1, round(CHUNK_SECONDS / seconds))
            yield done, chunk.points
    finally:
        for _, future in pending:
            future.cancel()


async def _solved_singly(pool: Pool, work: Work, indices: range, error: Exception) -> Chunk:
    """The points of a lost chunk one by one, each up to twice; a single point that took too long is not repeated."""
    if len(indices) == 1 and isinstance(error, DeadlineExceeded):
        return Chunk([work.late()], CHUNK_SECONDS)
    started = time.perf_counter()
    points: list[Point] = []
    for index in indices:
        try:
            alone = [work.overrides(index)]
            points += (await twice_if_lost(pool, solve_chunk, work.question, alone)).points
        except WorkerLost:
            points.append(work.question.failed("worker_lost", "the worker process died each time it solved the point"))
        except DeadlineExceeded:
            points.append(work.late())
    return Chunk(points, time.perf_counter() - started)
