"""A fixed number of workers: calls are carried out in turn, and workers that end are replaced."""

import asyncio
import logging
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from typing import Any

from app.errors import ClientGone, DeadlineExceeded, WorkerLost
from app.log import CALCULATIONS, DEADLINES_MISSED, INTERRUPTED, WAITING, WORKERS_LOST
from app.workers.control import ProcessDied, Template, Worker, is_running
from app.workers.shares import Job, Shares

SUPERVISION_S = 0.1

logger = logging.getLogger("tribodrive")


class Pool:
    """The workers, copies of one template process, and the calls that wait for them."""

    def __init__(self, size: int, queue: int, memory_mb: int, template: Template) -> None:
        self.size = size
        self.template = template
        self.template_restarted = asyncio.Event()
        self._memory_mb = memory_mb
        self._forkable = asyncio.Event()  # whether the template has loaded what workers need
        self._workers: set[Worker] = set()
        self._idle: list[Worker] = []
        self._shares = shares = Shares(size, size + queue)
        WAITING.set_function(lambda: sum(not job.of_study for job in shares.waiting))
        CALCULATIONS.set_function(lambda: sum(not job.of_study for job in (*shares.running, *shares.waiting)))

    @asynccontextmanager
    async def running(self) -> AsyncIterator[None]:
        """Workers and template are supervised while the context is open; afterwards no process is left."""
        async with asyncio.TaskGroup() as group:
            tasks = [group.create_task(each) for each in (self._supervise(), *(self._slot() for _ in range(self.size)))]
            try:
                yield
            finally:
                for task in tasks:
                    task.cancel()
                self.template.close()

    @property
    def workers_alive(self) -> int:
        """How many workers can calculate."""
        return len(self._workers)

    async def run(self, job: Job, function: Callable[..., Any], *arguments: Any) -> Any:
        """The function's result; a caller that is cancelled ends its worker.

        Raises QueueFull, DeadlineExceeded, ClientGone, WorkerLost, and what the function raises.
        """
        self._shares.admit(job)
        try:
            async with job.timeout:
                while True:
                    try:
                        self._shares.add(job, _now())
                        self._hand_out()
                        await job.turn
                        assert job.worker is not None
                        return await job.worker.call(function, *arguments)
                    except ProcessDied as error:
                        # A call that had not begun, or was interrupted for another client, is made again.
                        if job.worker is not None and job.worker.begun and job.worker is not job.interrupted:
                            WORKERS_LOST.inc()
                            logger.warning("worker %d was lost while it calculated", job.worker.pid)
                            raise WorkerLost from error
                    finally:
                        self._release(job)
        except TimeoutError as error:
            if not job.timeout.expired():
                raise
            if job.left:
                raise ClientGone from error
            DEADLINES_MISSED.inc()
            raise DeadlineExceeded from error

    def _hand_out(self) -> None:
        """Give idle workers to those who wait."""
        self._idle = [worker for worker in self._idle if not worker.ended.is_set()]
        while self._idle and (job := self._shares.next(_now())) is not None:
            job.worker = self._idle.pop()
            if job.of_study:
                job.expire_at(_now() + job.deadline_s)
            job.turn.set_result(None)

    def _release(self, job: Job) -> None:
        """Take a call out of the queue, or back its worker; a worker whose call has no outcome is ended."""
        worker, job.worker = job.worker, None
        self._shares.remove(job, _now(), finished=worker is not None and not worker.busy)
        if worker is not None:
            if worker.busy or worker.outdated:
                worker.end()
            self._idle.append(worker)
        self._hand_out()

    def renew(self) -> None:
        """Replace every worker, the busy ones after their call, by copies of the template as it is now."""
        self._forkable.set()
        for worker in self._workers:
            worker.outdated = True
        for worker in self._idle:
            worker.end()

    async def _slot(self) -> None:
        """One worker after the other."""
        while True:
            try:
                await self._worker_life()
            except (ProcessDied, OSError):
                await asyncio.sleep(SUPERVISION_S)
            except Exception:
                logger.exception("the start of a worker failed; it is tried again")
                await asyncio.sleep(SUPERVISION_S)

    async def _worker_life(self) -> None:
        """A worker from its start to its end."""
        await self._forkable.wait()
        template = self.template
        worker = await template.fork(self._memory_mb)
        self._workers.add(worker)
        try:
            await worker.receive()
            self._idle.append(worker)
            self._hand_out()
            await worker.ended.wait()
        finally:
            worker.end()
            self._workers.discard(worker)
            await template.reap(worker)

    async def _supervise(self) -> None:
        """Replace processes that died or were stopped; interrupt a call where another has waited too long."""
        while True:
            await asyncio.sleep(SUPERVISION_S)
            try:
                for worker in [worker for worker in self._workers if not is_running(worker.pid)]:
                    logger.warning("worker %d died or was stopped; it is replaced", worker.pid)
                    worker.end()
                if self.template.lost:
                    logger.warning("the template process was lost; it is started again")
                    self._forkable.clear()
                    self.template.close()
                    self.template = Template(self.template.preloaded)
                    self.template_restarted.set()
                self._interrupt()
                self._hand_out()  # a reservation may be over
            except Exception:
                logger.exception("supervision of the workers failed; it goes on")

    def _interrupt(self) -> None:
        """End a call for another client that has waited long enough; it is made again, with a new deadline."""
        job = self._shares.to_interrupt(_now())
        if job is not None and job.worker is not None:
            INTERRUPTED.inc()
            job.interrupted = job.worker
            job.expire_at(None if job.of_study else _now() + job.deadline_s)
            job.worker.end()


def _now() -> float:
    return asyncio.get_running_loop().time()
