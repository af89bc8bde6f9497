"""Who may calculate: a bounded queue, a deadline that counts the waiting, and an end when the client leaves."""

import asyncio
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from typing import Any

from starlette.types import Receive

from app.metrics import DEADLINES_MISSED, QUEUE
from app.problems import ClientGone, DeadlineExceeded, QueueFull
from app.settings import Settings
from app.workers.pool import Pool


class Runner:
    """Admits single calculations to the pool."""

    def __init__(self, settings: Settings, pool: Pool) -> None:
        self._settings = settings
        self._pool = pool
        self._admitted = 0

    async def run(self, receive: Receive, function: Callable[..., Any], *arguments: Any) -> Any:
        """The function's result; the client's disconnect, seen by `receive`, ends the work.

        Raises QueueFull, DeadlineExceeded, WorkerLost, ClientGone, and what the function raises.
        """
        if self._admitted >= self._settings.workers + self._settings.queue:
            raise QueueFull
        self._admitted += 1
        QUEUE.set(self._admitted)
        try:
            async with _time_and_client(receive, self._settings.deadline_s):
                return await self._pool.run(function, *arguments)
        finally:
            self._admitted -= 1
            QUEUE.set(self._admitted)


@asynccontextmanager
async def _time_and_client(receive: Receive, seconds: float) -> AsyncIterator[None]:
    """Cancel the body of the context at the deadline or when the client leaves, whichever comes first."""
    loop = asyncio.get_running_loop()
    gone = False
    scope = asyncio.timeout(seconds)

    async def watch() -> None:
        nonlocal gone
        while (await receive())["type"] != "http.disconnect":
            pass
        gone = True
        if not scope.expired():
            scope.reschedule(loop.time())

    watcher = loop.create_task(watch())
    try:
        async with scope:
            yield
    except TimeoutError as error:
        if not scope.expired():
            raise
        if gone:
            raise ClientGone from error
        DEADLINES_MISSED.inc()
        raise DeadlineExceeded from error
    finally:
        watcher.cancel()
