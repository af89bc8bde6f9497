"""A fixed number of workers. One that dies, is stopped or is no longer wanted costs its own call and is replaced."""

import asyncio
import contextlib
import logging
import os
from collections import deque
from collections.abc import AsyncIterator, Callable, Coroutine, Sequence
from contextlib import asynccontextmanager
from typing import Any, TypeVar

from app.metrics import WORKERS_LOST
from app.problems import WorkerLost
from app.processes import is_stopped
from app.workers.fork_server import Compiler, ForkServer, TemplateLost, Worker, WorkerDied

SUPERVISION_S = 0.25
PING_EVERY_S = 2.0
PING_TIMEOUT_S = 5.0

logger = logging.getLogger("tribodrive")
T = TypeVar("T")


class Pool:
    """Workers copied from one template process, and who waits for them."""

    def __init__(self, size: int, memory_mb: int, template: ForkServer) -> None:
        self._size = size
        self._memory_mb = memory_mb
        self._template = template
        self._warm: list[str] = []
        self._workers: set[Worker] = set()
        self._stale: set[Worker] = set()
        self._idle: list[Worker] = []
        self._waiting: deque[asyncio.Future[Worker]] = deque()
        self._patient: deque[asyncio.Future[Worker]] = deque()
        self._starting = 0
        self._tasks: set[asyncio.Task[None]] = set()
        self._closed = False

    @asynccontextmanager
    async def running(self) -> AsyncIterator[None]:
        """The template is supervised while the context is open; afterwards no process is left."""
        self.spawn_task(self._repeat(SUPERVISION_S, self._supervise))
        self.spawn_task(self._repeat(PING_EVERY_S, self._ping))
        try:
            yield
        finally:
            self._closed = True
            for task in self._tasks:
                task.cancel()
            for worker in list(self._workers):
                worker.kill()
            self._template.close()

    @property
    def workers_alive(self) -> int:
        """How many workers can calculate."""
        return len(self._workers)

    async def warm(self, stage: str) -> None:
        """Have the template load what the stage needs."""
        await self._patiently(lambda: self._template.warm(stage))
        self._warm.append(stage)

    def renew(self) -> None:
        """Replace every worker, the busy ones after their call, by copies of the template as it is now."""
        for worker in self._idle:
            worker.kill()
        self._stale = self._workers - set(self._idle)
        self._idle.clear()
        self._fill()

    @asynccontextmanager
    async def compiler(self, stages: Sequence[str]) -> AsyncIterator[asyncio.StreamReader]:
        """What a process that compiles these stages says; it ends with the context at the latest."""
        compiler = await self._patiently(lambda: self._template.compile(stages))
        try:
            yield compiler.lines
        finally:
            compiler.end()
            if not self._closed:
                self.spawn_task(self._reap(compiler))

    async def _patiently(self, command: Callable[[], Coroutine[Any, Any, T]]) -> T:
        """The template's outcome; a template that is lost meanwhile is replaced, and asked again."""
        while True:
            with contextlib.suppress(TemplateLost):
                return await command()
            await asyncio.sleep(SUPERVISION_S)

    async def run(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """The function's result; a caller that is cancelled takes its worker's process along.

        Raises WorkerLost, and what the function raises.
        """
        worker = await self._acquire()
        try:
            return await worker.call(function, *arguments)
        except asyncio.CancelledError:
            worker.kill()
            raise
        except WorkerDied as error:
            self.report_lost(worker)
            raise WorkerLost from error
        finally:
            self.release(worker)

    def patient_place(self) -> asyncio.Future[Worker]:
        """A worker as soon as one is free and nobody in `run` waits for it; to be released, or cancelled before."""
        place: asyncio.Future[Worker] = asyncio.get_running_loop().create_future()
        if (worker := self._take_idle()) is not None:
            place.set_result(worker)
        else:
            self._patient.append(place)
        return place

    def report_lost(self, worker: Worker) -> None:
        """Write to the books that a worker died over a call."""
        WORKERS_LOST.inc()
        logger.warning("worker %d was lost while it calculated", worker.pid)

    def _take_idle(self) -> Worker | None:
        while self._idle:
            worker = self._idle.pop()
            if worker.alive:
                return worker
        return None

    async def _acquire(self) -> Worker:
        if (worker := self._take_idle()) is not None:
            return worker
        place: asyncio.Future[Worker] = asyncio.get_running_loop().create_future()
        self._waiting.append(place)
        try:
            return await place
        except asyncio.CancelledError:
            if place.done() and not place.cancelled():
                self.release(place.result())
            raise

    def release(self, worker: Worker) -> None:
        """Give a worker to whoever waits, single requests before patient calls."""
        if worker in self._stale:
            worker.kill()
        if not worker.alive or worker not in self._workers:
            return
        for places in (self._waiting, self._patient):
            while places:
                place = places.popleft()
                if not place.done():
                    place.set_result(worker)
                    return
        self._idle.append(worker)

    def _ended(self, worker: Worker) -> None:
        """A worker's socket closed: the process is dead or about to be."""
        self._workers.discard(worker)
        self._stale.discard(worker)
        if worker in self._idle:
            self._idle.remove(worker)
        if not self._closed:
            self.spawn_task(self._reap(worker))
            self._fill()

    async def _reap(self, ended: Worker | Compiler) -> None:
        """Have the template that the process was copied from forget it, if there still is that template."""
        with contextlib.suppress(TemplateLost):
            await ended.server.reap(ended.pid)

    def _fill(self) -> None:
        """Start as many workers as are missing."""
        if not self._warm or self._closed:
            return
        for _ in range(self._size - len(self._workers - self._stale) - self._starting):
            self._starting += 1
            self.spawn_task(self._start_worker())

    async def _start_worker(self) -> None:
        try:
            worker = await self._template.fork(self._memory_mb, self._ended)
        except TemplateLost:
            return
        finally:
            self._starting -= 1
        self._workers.add(worker)
        if worker.alive:
            self.release(worker)
        else:
            self._ended(worker)

    async def _repeat(self, every_s: float, duty: Callable[[], Coroutine[Any, Any, None]]) -> None:
        """A duty that is never given up."""
        while True:
            await asyncio.sleep(every_s)
            try:
                await duty()
            except Exception:
                logger.exception("supervision of the workers failed; it goes on")

    async def _supervise(self) -> None:
        """Miss nobody: a stopped worker is ended, a lost template started again, a missing worker replaced."""
        for worker in [worker for worker in self._workers if is_stopped(worker.pid)]:
            logger.warning("worker %d was stopped; it is replaced", worker.pid)
            worker.kill()
        if self._template.lost:
            logger.warning("the template process was lost; it is started again")
            self._restart_template()
        self._fill()

    def _restart_template(self) -> None:
        self._template.close()
        self._template = ForkServer.start()
        self.spawn_task(self._warm_again(self._template))

    async def _warm_again(self, template: ForkServer) -> None:
        """Have a new template load what the lost one had; beside the supervision, which watches this one too."""
        with contextlib.suppress(TemplateLost):
            for stage in list(self._warm):
                await template.warm(stage)

    async def _ping(self) -> None:
        """Ask idle workers for a sign of life."""
        for worker in list(self._idle):
            if worker in self._idle:
                self._idle.remove(worker)
                await self._sign_of_life(worker)

    async def _sign_of_life(self, worker: Worker) -> None:
        try:
            async with asyncio.timeout(PING_TIMEOUT_S):
                await worker.call(os.getpid)
        except TimeoutError:
            logger.warning("worker %d does not answer; it is replaced", worker.pid)
            worker.kill()
        except WorkerDied:
            pass
        finally:
            self.release(worker)

    def spawn_task(self, coroutine: Coroutine[Any, Any, None]) -> None:
        """Run something beside, until the pool closes."""
        task = asyncio.get_running_loop().create_task(coroutine)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
