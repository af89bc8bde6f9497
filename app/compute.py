"""Runs one solve in a worker process: deadline, cancellation, queue limit, memory cap.

A worker that dies or is ended costs only its own request; the next request finds another one.
"""

import logging
import os
import resource
import signal
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from functools import lru_cache
from typing import Any, TypeVar

import anyio
from anyio import BrokenWorkerProcess, CapacityLimiter, to_process
from anyio.abc import TaskGroup
from starlette.types import Receive

from app.metrics import DEADLINES_MISSED, QUEUE, WORKERS_LOST
from app.problems import ClientGone, DeadlineExceeded, QueueFull, WorkerLost
from app.settings import MEBIBYTE, Settings

T = TypeVar("T")
KEEP_WARM_S = 120.0  # idle workers are dropped after 300 s
WORKER_DIED = (BrokenWorkerProcess, ProcessLookupError)  # the latter if it died while it started

logger = logging.getLogger("tribodrive")


class Runner:
    """A fixed number of worker processes and a bounded queue before them."""

    def __init__(self, settings: Settings, warm_up: Callable[[], None]) -> None:
        self._settings = settings
        self._warm_up = warm_up
        self._limiter = CapacityLimiter(settings.workers)
        self._admitted = 0
        self._tasks: TaskGroup | None = None

    @asynccontextmanager
    async def started(self) -> AsyncIterator[None]:
        """Workers warm and kept warm while the context is open."""
        for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS"):
            os.environ.setdefault(variable, "1")
        async with anyio.create_task_group() as self._tasks:
            await self._warm()
            self._tasks.start_soon(self._keep_warm)
            yield
            self._tasks.cancel_scope.cancel()

    async def run(self, receive: Receive, function: Callable[..., T], *args: Any) -> T:
        """The function's result; the client's disconnect, seen by `receive`, ends the work.

        Raises QueueFull, DeadlineExceeded, WorkerLost, ClientGone, and what the function raises.
        """
        if self._admitted >= self._settings.workers + self._settings.queue:
            raise QueueFull
        self._admitted += 1
        QUEUE.set(self._admitted)
        try:
            result: T = await _unless_disconnected(receive, self._run, function, *args)
            return result
        finally:
            self._admitted -= 1
            QUEUE.set(self._admitted)

    async def ping(self) -> None:
        """Prove that a worker answers."""
        await self._run(os.getpid)

    async def _run(self, function: Callable[..., T], *args: Any) -> T:
        memory = self._settings.worker_memory_mb * MEBIBYTE
        try:
            with anyio.fail_after(self._settings.deadline_s):
                return await to_process.run_sync(
                    _in_worker, memory, function, args, cancellable=True, limiter=self._limiter
                )
        except TimeoutError as error:
            DEADLINES_MISSED.inc()
            self._replace_worker()
            raise DeadlineExceeded from error
        except WORKER_DIED as error:
            WORKERS_LOST.inc()
            logger.warning("a worker process was lost")
            self._replace_worker()
            raise WorkerLost from error

    def _replace_worker(self) -> None:
        if self._tasks is not None:
            self._tasks.start_soon(self._warm)

    async def _warm(self) -> None:
        """Give every worker its warm-up at the same time, so that none is missing and none is cold."""
        async with anyio.create_task_group() as group:
            for _ in range(self._settings.workers):
                group.start_soon(self._warm_one)

    async def _warm_one(self) -> None:
        memory = self._settings.worker_memory_mb * MEBIBYTE
        try:
            await to_process.run_sync(_in_worker, memory, self._warm_up, (), limiter=self._limiter)
        except WORKER_DIED:
            logger.warning("a worker process was lost while it warmed up")

    async def _keep_warm(self) -> None:
        while True:
            await anyio.sleep(KEEP_WARM_S)
            await self._warm()


async def _unless_disconnected(receive: Receive, function: Callable[..., Any], *args: Any) -> Any:
    """The awaited function's result; ClientGone, and the work cancelled, if the client leaves first."""
    outcome: list[Any] = []
    failure: list[Exception] = []

    async def work(group: TaskGroup) -> None:
        try:
            outcome.append(await function(*args))
        except Exception as error:  # noqa: BLE001  handed on below, out of the task group's exception group
            failure.append(error)
        group.cancel_scope.cancel()

    async with anyio.create_task_group() as group:
        group.start_soon(work, group)
        while (await receive())["type"] != "http.disconnect":
            pass
        group.cancel_scope.cancel()
    if failure:
        raise failure[0]
    if not outcome:
        raise ClientGone
    return outcome[0]


def _in_worker(memory: int, function: Callable[..., T], args: tuple[Any, ...]) -> T:
    """Call the function inside a worker that has its limits."""
    _limit_worker(memory)
    return function(*args)


@lru_cache(maxsize=1)
def _limit_worker(memory: int) -> None:
    """Cap this process's memory and leave interrupts to the parent."""
    resource.setrlimit(resource.RLIMIT_DATA, (memory, memory))
    signal.signal(signal.SIGINT, signal.SIG_IGN)
