"""Runs the points of a study in chunks on a pool of processes and hands their answers on in order."""

import asyncio
import time
from collections import deque
from collections.abc import AsyncIterator, Callable
from dataclasses import dataclass
from typing import Any, Protocol

from app.problems import DeadlineExceeded, WorkerLost
from app.studies.points import Chunk, Point

CHUNK_SECONDS = 0.25
CHUNKS_PER_SLOT = 2
MOST_POINTS_IN_A_CHUNK = 1000


class Pool(Protocol):
    """Where chunks are solved: the service's own worker processes, or a cluster."""

    slots: int

    def submit(self, function: Callable[..., Chunk], *args: Any) -> "asyncio.Future[Chunk]":
        """Begin as soon as a process is free; cancelling takes back what has not begun and lets finish what has."""


class PoolLost(Exception):
    """The pool is gone for good: no further point can be solved."""


@dataclass(frozen=True, slots=True)
class Work:
    """Solves points: `solve(indices) -> Chunk`, given as a function that pickles and its arguments."""

    function: Callable[..., Chunk]
    arguments: Callable[[range], tuple[Any, ...]]
    outputs: int

    def failed(self, code: str, message: str) -> Point:
        """A point that could not be solved for no fault of its request."""
        return Point("failed", [None] * self.outputs, [], {"pointer": "", "code": code, "message": message}, None)


async def in_order(pool: Pool, work: Work, total: int) -> AsyncIterator[tuple[range, list[Point]]]:
    """Runs of points with their indices, in order; a chunk that loses its process is solved again point by point.

    Leaving the iteration takes back the chunks that have not begun and waits for none.
    """
    pending: deque[tuple[range, asyncio.Future[Chunk]]] = deque()
    size, begun = 1, 0
    try:
        while begun < total or pending:
            while begun < total and len(pending) < CHUNKS_PER_SLOT * pool.slots:
                indices = range(begun, min(begun + size, total))
                pending.append((indices, pool.submit(work.function, *work.arguments(indices))))
                begun = indices.stop
            indices, future = pending.popleft()
            chunk = await _solved(pool, work, indices, future)
            size = _next_size(len(indices), chunk.seconds)
            yield indices, chunk.points
    finally:
        for _, future in pending:
            future.cancel()


def _next_size(points: int, seconds: float) -> int:
    """As many points as take about a quarter of a second."""
    each = max(seconds / points, CHUNK_SECONDS / MOST_POINTS_IN_A_CHUNK)
    return max(1, min(MOST_POINTS_IN_A_CHUNK, round(CHUNK_SECONDS / each)))


async def _solved(pool: Pool, work: Work, indices: range, future: "asyncio.Future[Chunk]") -> Chunk:
    """The chunk; if its process died or took too long, its points one by one, a second time."""
    try:
        return await future
    except (WorkerLost, DeadlineExceeded) as error:
        if len(indices) == 1:
            return await _second_try(pool, work, indices, error)
    started = time.perf_counter()
    points: list[Point] = []
    for index in indices:
        one = range(index, index + 1)
        points += (await _solved(pool, work, one, pool.submit(work.function, *work.arguments(one)))).points
    return Chunk(points, time.perf_counter() - started)


async def _second_try(pool: Pool, work: Work, indices: range, error: Exception) -> Chunk:
    """A single point once more after its process died; never after a missed deadline."""
    if isinstance(error, WorkerLost):
        try:
            return await pool.submit(work.function, *work.arguments(indices))
        except WorkerLost:
            return Chunk([work.failed("worker_lost", "the point was lost with its process, twice")], CHUNK_SECONDS)
        except DeadlineExceeded:
            pass
    return Chunk([work.failed("deadline_exceeded", "the point took longer than one calculation may")], CHUNK_SECONDS)
