"""The workers as requests and studies see them."""

import asyncio
from collections.abc import Callable
from typing import Any

from fastapi import Request

from app.settings import Settings
from app.workers.pool import Pool
from app.workers.shares import Job

GRACE_S = 0.5  # after a study has ended: calculations about to finish save their worker


class Runner:
    """Single calculations, each for the client of a request."""

    def __init__(self, settings: Settings, pool: Pool) -> None:
        self._settings = settings
        self._pool = pool

    async def run(self, http: Request, function: Callable[..., Any], *arguments: Any) -> Any:
        """The function's result; the client's disconnect ends the work.

        Raises QueueFull, DeadlineExceeded, WorkerLost, ClientGone, and what the function raises.
        """
        job = Job(self._client(http), http.scope["route"].path, self._settings.deadline_s)
        watcher = asyncio.create_task(_watch(http, job))
        try:
            return await self._pool.run(job, function, *arguments)
        finally:
            watcher.cancel()

    def _client(self, http: Request) -> str:
        """Whose request it is: the name in the header that the settings say, else the address."""
        header = self._settings.client_header
        name = http.headers.get(header) if header else None
        return name or (http.client.host if http.client else "")


async def _watch(http: Request, job: Job) -> None:
    await disconnected(http)
    job.leave()


async def disconnected(http: Request) -> None:
    """Wait until the client has left."""
    while (await http.receive())["type"] != "http.disconnect":
        pass


class StudyPool:
    """The workers for one study, which shares them with clients and other studies like one more client."""

    def __init__(self, settings: Settings, pool: Pool) -> None:
        self._deadline_s = settings.deadline_s
        self._pool = pool
        self.slots = pool.size

    def submit(self, function: Callable[..., Any], *arguments: Any) -> asyncio.Future[Any]:
        """The function's result; cancelled, the call ends at once if it waits, and else after GRACE_S.

        The future raises WorkerLost, DeadlineExceeded, and what the function raises.
        """
        job = Job(self, self, self._deadline_s, of_study=True)
        call = asyncio.create_task(self._pool.run(job, function, *arguments))
        outcome = asyncio.shield(call)

        def end(_: object) -> None:
            if outcome.cancelled():
                asyncio.get_running_loop().call_later(GRACE_S if job.worker else 0.0, call.cancel)

        outcome.add_done_callback(end)
        return outcome
