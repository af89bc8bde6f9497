"""Calls without hurry: each begins when no single request waits for a worker, and none ends a worker by its leaving."""

import asyncio
from collections.abc import Callable
from typing import Any

from app.metrics import DEADLINES_MISSED
from app.problems import DeadlineExceeded, WorkerLost
from app.workers.fork_server import Worker, WorkerDied
from app.workers.pool import Pool


class PatientPool:
    """The pool as studies see it."""

    def __init__(self, pool: Pool, slots: int, deadline_s: float) -> None:
        self._pool = pool
        self._deadline_s = deadline_s
        self.slots = slots

    def submit(self, function: Callable[..., Any], *arguments: Any) -> asyncio.Future[Any]:
        """The function's result; cancelling takes the call back if it waits, and drops its result if it runs.

        The future raises WorkerLost, DeadlineExceeded, and what the function raises.
        """
        outcome: asyncio.Future[Any] = asyncio.get_running_loop().create_future()
        place = self._pool.patient_place()
        outcome.add_done_callback(lambda _: place.cancel())
        self._pool.spawn_task(self._serve(place, outcome, function, arguments))
        return outcome

    async def _serve(
        self,
        place: asyncio.Future[Worker],
        outcome: asyncio.Future[Any],
        function: Callable[..., Any],
        arguments: tuple[Any, ...],
    ) -> None:
        await asyncio.wait({place})
        if place.cancelled():
            return
        worker = place.result()
        try:
            if not outcome.cancelled():
                await self._call(worker, outcome, function, arguments)
        finally:
            self._pool.release(worker)

    async def _call(
        self, worker: Worker, outcome: asyncio.Future[Any], function: Callable[..., Any], arguments: tuple[Any, ...]
    ) -> None:
        """The call, to its end even if nobody wants its result any more."""
        result = None
        error: Exception | None = None
        try:
            async with asyncio.timeout(self._deadline_s):
                result = await worker.call(function, *arguments)
        except TimeoutError:
            DEADLINES_MISSED.inc()
            worker.kill()
            error = DeadlineExceeded()
        except WorkerDied:
            self._pool.report_lost(worker)
            error = WorkerLost()
        except Exception as raised:  # noqa: BLE001  handed to the caller
            error = raised
        if outcome.done():
            return
        if error is None:
            outcome.set_result(result)
        else:
            outcome.set_exception(error)
