"""A fixed number of worker processes, and the queue of their calls.

The owner of a call is a client or a study. A free worker gets a call of the owner with the fewest running calls; of
several such owners, the owner whose last call began longest ago is next. If nobody waits for the result of a running
call any more, the call may run for another `GRACE_S` seconds. Then the worker is killed and replaced.
"""

import asyncio
import logging
import os
import pickle
import time
from collections import Counter
from collections.abc import Callable, Hashable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from shutil import rmtree
from tempfile import mkdtemp
from typing import Any
from weakref import finalize

from anyio import BrokenWorkerProcess, CapacityLimiter, to_process
from cachetools import LRUCache
from fastapi import Request

from app.errors import ClientGone, DeadlineExceeded, QueueFull, WorkerLost
from app.log import CALCULATIONS, DEADLINES_MISSED, REFUSED, WAITING, WORKERS_LOST
from app.settings import MEBIBYTE, Settings
from app.workers.worker import perform, prepare
from solvers.kernel_cache import FOLDER

GRACE_S = 2.0  # nearly all calculations end in this time, so users who leave a page early rarely cost a worker
START_S = 30.0  # longest time of a worker's start, chosen: a start takes 2 s on an idle core
COMPILING_S = 150.0  # longest time for the kernels of one call, which does not count against its deadline; chosen
TICK_S = 0.5
IDLE_S = 5.0  # time between two checks that idle workers answer
PAUSE_S = 0.1  # pause after the start of a worker has failed

logger = logging.getLogger("tribodrive")
Outcome = asyncio.Future[Any]


@dataclass(eq=False, slots=True)
class Job:
    """A call that a client or a study (`owner`) has queued. `call` is the pickled function with its arguments."""

    owner: Hashable
    call: bytes
    is_single: bool  # False if the call is part of a study
    outcome: Outcome
    timeout: asyncio.Timeout | None = None  # ends the call; None before the call runs
    compiled_s: float = 0.0  # time in which the call waited for the compilation of kernels; not its fault


class Pool:
    """Worker processes, and the queue of their calls. Each worker loads `modules` before its first call."""

    def __init__(self, settings: Settings, modules: Sequence[str]) -> None:
        self.size = settings.workers
        self.alive = self._lost = 0  # workers that can calculate, and workers that were lost during the last check
        self._settings = settings
        self._preparation = (settings.worker_memory_mb * MEBIBYTE, tuple(modules))
        self._limiter = CapacityLimiter(settings.workers)
        self._folder: Path | None = None  # see `compiling.Clock`
        with suppress(OSError):  # where nothing can be written, compilation counts against the deadline
            self._folder = Path(mkdtemp(prefix="tribodrive-", dir=FOLDER))
            finalize(self, rmtree, self._folder, ignore_errors=True)
        self._running: list[Job] = []
        self._waiting: list[Job] = []
        self._arrival, self._trouble = asyncio.Event(), asyncio.Event()
        self._begun: LRUCache[Hashable, float] = LRUCache(1000)  # time [s] when the last call of each owner began
        WAITING.set_function(lambda: sum(job.is_single for job in self._waiting))
        CALCULATIONS.set_function(lambda: sum(job.is_single for job in (*self._running, *self._waiting)))

    async def calculate(self, http: Request, function: Callable[..., Any], *arguments: Any) -> Any:
        """Run a call of a client in a worker. Raises the errors of the call and the errors in the table `PROBLEMS`."""
        owner = http.headers.get(self._settings.client_header or "") or (http.client.host if http.client else "")
        self._admit(owner)
        job = self.submit(owner, function, *arguments)
        try:
            return await unless_gone(http, job.outcome, lambda: self._settings.deadline_s + job.compiled_s)
        except TimeoutError:
            DEADLINES_MISSED.inc()
            raise DeadlineExceeded from None

    def submit(self, owner: Hashable, function: Callable[..., Any], *arguments: Any, is_single: bool = True) -> Job:
        """Add a call to the queue. To give up the call, cancel its outcome."""
        job = Job(owner, pickle.dumps((function, arguments)), is_single, asyncio.get_running_loop().create_future())
        job.outcome.add_done_callback(lambda _: self._let_go(job))
        self._waiting.append(job)
        self._arrival.set()
        return job

    def _admit(self, owner: Hashable) -> None:
        """Raise QueueFull if the queue is full, unless another client has at least two calls more than `owner`."""
        places = Counter(job.owner for job in (*self._running, *self._waiting) if job.is_single)
        if places.total() >= self.size + self._settings.queue and max(places.values()) <= places[owner] + 1:
            REFUSED.inc()
            raise QueueFull

    def _let_go(self, job: Job) -> None:
        """Remove a waiting call from the queue, or limit a running call to another `GRACE_S` seconds."""
        if job in self._waiting:
            self._waiting.remove(job)
        elif job in self._running and job.timeout is not None and not job.timeout.expired():
            job.timeout.reschedule(asyncio.get_running_loop().time() + GRACE_S)

    async def keep_workers(self) -> None:
        """Start the workers, check idle workers, and replace lost workers.

        The first worker starts alone, so that it is ready soon. All idle workers are checked at the same time, because
        AnyIO would give successive checks to the same worker.
        """
        count = 1
        while True:
            running, self._lost = len(self._running), 0
            self._trouble.clear()
            pids = set(await asyncio.gather(*(self._prepared() for _ in range(count)))) - {None}
            self.alive = running + len(pids) - self._lost
            self._arrival.set()
            with suppress(TimeoutError):
                async with asyncio.timeout(IDLE_S if self.alive >= self.size else PAUSE_S):
                    await self._trouble.wait()
            count = self.size - len(self._running)

    async def _prepared(self) -> int | None:
        """Start a worker or check an idle worker. Return the identifier of its process, or None after a failure."""
        try:
            async with asyncio.timeout(START_S if FOLDER is not None else START_S + 4 * COMPILING_S):
                pid: int = await self._in_worker(prepare)
                return pid
        except Exception as error:  # noqa: BLE001  whatever prevents a worker must not end the service
            logger.warning("a worker could not be prepared: %r", error)
            return None

    async def serve(self) -> None:
        """Run calls from the queue one after another, without end. There is one such loop for each worker."""
        while True:
            while len(self._running) >= self.alive or not (
                waiting := [job for job in self._waiting if not job.outcome.done()]
            ):
                self._arrival.clear()
                await self._arrival.wait()
            running = Counter(job.owner for job in self._running)
            job = min(waiting, key=lambda job: (running[job.owner], self._begun.get(job.owner, 0.0)))
            self._begun[job.owner] = asyncio.get_running_loop().time()
            self._waiting.remove(job)
            self._running.append(job)
            try:
                is_usable = await self._carry_out(job)
            finally:
                self._running.remove(job)
            if not is_usable:
                self._lost, self.alive = self._lost + 1, self.alive - 1
                self._trouble.set()

    async def _carry_out(self, job: Job) -> bool:
        """Run a call and set the result or the exception of its future. Return True if the worker can be used again."""
        job.timeout = asyncio.timeout(None if job.is_single else self._settings.deadline_s)
        file = None if self._folder is None else self._folder / str(id(job))
        watch = asyncio.create_task(_watch(job, file))
        try:
            async with job.timeout:
                result, lines = await self._in_worker(perform, file, job.call)
            for line in lines:
                logger.warning("a worker said: %s", line)
            if not job.outcome.done():
                job.outcome.set_result(result)
        except Exception as error:  # noqa: BLE001  any error of the call
            is_late, is_lost = job.timeout.expired(), isinstance(error, BrokenWorkerProcess)
            if is_lost:
                WORKERS_LOST.inc()
                logger.warning("a worker was lost while it calculated")
            if not job.outcome.done():
                DEADLINES_MISSED.inc(is_late)
                job.outcome.set_exception(DeadlineExceeded() if is_late else WorkerLost() if is_lost else error)
            return not (is_late or is_lost)
        finally:
            watch.cancel()
            if file is not None:
                file.unlink(missing_ok=True)
        return True

    async def _in_worker(self, function: Callable[..., Any], *arguments: Any) -> Any:
        arguments = (*self._preparation, *arguments)
        try:
            return await to_process.run_sync(function, *arguments, cancellable=True, limiter=self._limiter)
        except KeyboardInterrupt as error:  # Ctrl-C reached the worker before the worker ignored the signal
            raise BrokenWorkerProcess from error


async def _watch(job: Job, file: Path | None) -> None:
    """Move the end of a call while its worker compiles kernels, by at most `COMPILING_S` altogether."""
    while file is not None and job.compiled_s < COMPILING_S:
        await asyncio.sleep(TICK_S)
        if os.path.exists(file):  # noqa: PTH110, ASYNC240  in memory, takes a microsecond
            job.compiled_s += TICK_S
            if job.timeout is not None and (end := job.timeout.when()) is not None and not job.timeout.expired():
                job.timeout.reschedule(end + TICK_S)


async def unless_gone(http: Request, work: Outcome, deadline_s: Callable[[], float] | None = None) -> Any:
    """Return the result of `work`. Raises ClientGone if the client leaves, TimeoutError if the deadline passes.

    `deadline_s` is asked anew when it has passed, because it moves while kernels are compiled.
    """
    departure, began = asyncio.create_task(_departure(http)), time.monotonic()
    left: float | None = None
    try:
        while deadline_s is None or (left := began + deadline_s() - time.monotonic()) > 0.0:
            await asyncio.wait({work, departure}, timeout=left, return_when=asyncio.FIRST_COMPLETED)
            if work.done():
                return work.result()
            if departure.done():
                raise ClientGone
        raise TimeoutError
    finally:
        departure.cancel()
        work.cancel()


async def _departure(http: Request) -> None:
    while (await http.receive())["type"] != "http.disconnect":
        pass
