"""Who gets the next worker, and workers that die, stop or are not wanted any more are replaced.

Shares are fair: the next worker goes to the client or study with the fewest calculations running. Who has waited for a
second while another holds more than an equal share gets the other's youngest calculation ended, which is asked again
later; the worker that this frees is then kept for short calculations as long as they come. A calculation is ended in
this way once at most. A client alone is never touched by any of this.
"""

import asyncio
import logging
import statistics
from collections import Counter, deque
from collections.abc import AsyncIterator, Callable, Coroutine, Sequence
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from typing import Any

from cachetools import LRUCache

from app.errors import ClientGone, DeadlineExceeded, QueueFull, WorkerLost
from app.log import CALCULATIONS, DEADLINES_MISSED, ENDED, REFUSED, WAITING, WORKERS_LOST
from app.workers.control import Template, TemplateLost, Worker, WorkerDied, is_running

SUPERVISION_S = 0.1
PATIENCE_S = 1.0  # so long who holds less than his share waits for others to finish
SHORT_S = 1.0  # a calculation is short when the median of the last ones of its kind took less
KEPT_S = 2.0  # a worker is kept for short calculations until none has come for so long
REMEMBERED = 15  # durations of each kind

logger = logging.getLogger("tribodrive")


@dataclass(eq=False, slots=True)
class Job:
    """One call. `owner` is the client or study that asks; calls of one `kind` take about as long as each other.

    A single request has `deadline_s` from when it begins to wait, a call of a study from when it begins.
    """

    owner: object
    kind: object
    deadline_s: float
    of_study: bool = False
    worker: Worker | None = None
    began: float = 0.0  # to wait, or with a worker to calculate
    taken: Worker | None = None  # the worker that it had to give up for others
    left: bool = False
    place: asyncio.Future[Worker] = field(init=False)
    timeout: asyncio.Timeout = field(init=False)

    def leave(self) -> None:
        """The client is gone: the call raises ClientGone."""
        self.left = True
        self.expire_at(asyncio.get_running_loop().time())

    def expire_at(self, when: float | None) -> None:
        """Move the deadline."""
        if not self.timeout.expired():
            self.timeout.reschedule(when)


class Pool:
    """A fixed number of workers, copies of one template process."""

    def __init__(self, size: int, queue: int, memory_mb: int, template: Template) -> None:
        self._size = size
        self._places = size + queue
        self._memory_mb = memory_mb
        self._template = template
        self._open = False  # whether the template has loaded what workers need
        self._workers: set[Worker] = set()
        self._stale: set[Worker] = set()
        self._idle: list[Worker] = []
        self._starting = 0
        self._waiting: list[Job] = []
        self._running: set[Job] = set()
        self._served: dict[object, float] = {}
        self._seconds: LRUCache[object, deque[float]] = LRUCache(256)
        self._kept_until = 0.0
        self._tasks: set[asyncio.Task[None]] = set()
        self.template_restarted = asyncio.Event()

    @asynccontextmanager
    async def running(self) -> AsyncIterator[None]:
        """Workers and template are supervised while the context is open; afterwards no process is left."""
        self._spawn(self._supervise())
        try:
            yield
        finally:
            self._open = False
            for task in self._tasks:
                task.cancel()
            for worker in self._workers:
                worker.end()
            self._template.close()

    @property
    def size(self) -> int:
        """How many calls run at once."""
        return self._size

    @property
    def workers_alive(self) -> int:
        """How many workers can calculate."""
        return len(self._workers)

    async def run(self, job: Job, function: Callable[..., Any], *arguments: Any) -> Any:
        """The function's result; a caller that is cancelled ends its worker.

        Raises QueueFull, DeadlineExceeded, ClientGone, WorkerLost, and what the function raises.
        """
        if not job.of_study:
            self._admit(job)
        job.timeout = asyncio.timeout(None if job.of_study else job.deadline_s)
        try:
            async with job.timeout:
                while True:
                    worker = await self._turn(job)
                    try:
                        return await worker.call(function, *arguments)
                    except WorkerDied as error:
                        if worker.begun and worker is not job.taken:
                            WORKERS_LOST.inc()
                            logger.warning("worker %d was lost while it calculated", worker.pid)
                            raise WorkerLost from error
                    finally:
                        self._release(job, worker)
        except TimeoutError as error:
            if not job.timeout.expired():
                raise
            if job.left:
                raise ClientGone from error
            DEADLINES_MISSED.inc()
            raise DeadlineExceeded from error

    def _admit(self, job: Job) -> None:
        """Where all places are taken, refuse the newest request of the client that has most."""
        singles = [each for each in (*self._running, *self._waiting, job) if not each.of_study]
        if len(singles) <= self._places:
            return
        places = Counter(each.owner for each in singles)
        newest_first = [job, *(each for each in reversed(self._waiting) if not each.of_study)]
        refused = max(newest_first, key=lambda each: places[each.owner])
        REFUSED.inc()
        if refused is job:
            raise QueueFull
        self._waiting.remove(refused)
        refused.place.set_exception(QueueFull())

    async def _turn(self, job: Job) -> Worker:
        """A worker, when it is the job's turn."""
        loop = asyncio.get_running_loop()
        job.place, job.began = loop.create_future(), loop.time()
        self._waiting.append(job)
        self._hand_out()
        try:
            return await job.place
        except asyncio.CancelledError:
            if job.worker is not None:
                self._release(job, job.worker)
            raise
        finally:
            if job in self._waiting:
                self._waiting.remove(job)
            self._count()

    def _release(self, job: Job, worker: Worker) -> None:
        """The job has finished with its worker; one whose call has no outcome is ended."""
        now = asyncio.get_running_loop().time()
        if not worker.busy or now - job.began > SHORT_S:
            self._seconds.setdefault(job.kind, deque(maxlen=REMEMBERED)).append(now - job.began)
        self._running.discard(job)
        job.worker = None
        if all(each.owner is not job.owner for each in (*self._running, *self._waiting)):
            self._served.pop(job.owner, None)
        if worker.busy or worker in self._stale or not worker.alive:
            self._replace(worker)
        else:
            self._idle.append(worker)
        self._hand_out()

    def _hand_out(self) -> None:
        """Give idle workers to those who wait."""
        now = asyncio.get_running_loop().time()
        while self._idle and (job := self._next(now)) is not None:
            if self._is_short(job) and now < self._kept_until:
                self._kept_until = now + KEPT_S
            self._waiting.remove(job)
            self._running.add(job)
            self._served[job.owner] = job.began = now
            job.worker = self._idle.pop()
            if job.of_study:
                job.expire_at(now + job.deadline_s)
            job.place.set_result(job.worker)
        self._count()

    def _next(self, now: float) -> Job | None:
        """Of those who wait: whose owner has the fewest running; single requests before studies; who waited longest."""
        waiting = [job for job in self._waiting if not job.place.done()]  # cancelled, and about to leave
        if now < self._kept_until and sum(not self._is_short(job) for job in self._running) >= self._size - 1 > 0:
            waiting = [job for job in waiting if self._is_short(job)]
        held = Counter(job.owner for job in self._running)
        return min(
            waiting, key=lambda job: (held[job.owner], job.of_study, self._served.get(job.owner, 0.0)), default=None
        )

    def _is_short(self, job: Job) -> bool:
        seconds = self._seconds.get(job.kind)
        return seconds is None or statistics.median(seconds) < SHORT_S

    def _take_for_others(self) -> None:
        """End one calculation for the sake of who has waited long enough and holds less than his share."""
        if not self._waiting or len(self._running) < self._size:  # else a worker is on its way
            return
        now = asyncio.get_running_loop().time()
        held = Counter(job.owner for job in self._running)
        share = self._size / len({job.owner for job in (*self._running, *self._waiting)})
        for job in self._waiting:
            # A long calculation takes a worker for good, so that its owner then must not hold more than the other.
            least = held[job.owner] + (1 if self._is_short(job) else 2)
            others = [
                each
                for each in self._running
                if each.taken is None and held[each.owner] > share and held[each.owner] >= least
            ]
            if others and now - job.began >= PATIENCE_S:
                if self._is_short(job):
                    self._kept_until = now + KEPT_S
                self._take(max(others, key=lambda each: each.began), now)
                return

    def _take(self, job: Job, now: float) -> None:
        """End the calculation of a job that is asked again later."""
        assert job.worker is not None
        ENDED.inc()
        job.taken = job.worker
        job.expire_at(None if job.of_study else now + job.deadline_s)
        self._replace(job.worker)

    def _count(self) -> None:
        waiting = sum(not job.of_study for job in self._waiting)
        WAITING.set(waiting)
        CALCULATIONS.set(waiting + sum(not job.of_study for job in self._running))

    def renew(self) -> None:
        """Replace every worker, the busy ones after their call, by copies of the template as it is now."""
        self._open = True
        self._stale = set(self._workers)
        for worker in list(self._idle):
            self._replace(worker)
        self._fill()

    async def warm(self, stage: str) -> int:
        """Have the template load a stage; how many kernels had to be compiled. Raises TemplateLost."""
        return await self._template.warm(stage)

    @asynccontextmanager
    async def compiler(self, stages: Sequence[str]) -> AsyncIterator[Worker]:
        """A process that compiles these stages; it ends with the context at the latest."""
        process = await self._template.compile(stages)
        try:
            yield process
        finally:
            process.end()

    def _replace(self, worker: Worker) -> None:
        """End a worker and start another."""
        worker.end()
        self._workers.discard(worker)
        self._stale.discard(worker)
        if worker in self._idle:
            self._idle.remove(worker)
        self._fill()

    def _fill(self) -> None:
        """Start as many workers as are missing."""
        if self._open:
            for _ in range(self._size - len(self._workers - self._stale) - self._starting):
                self._starting += 1
                self._spawn(self._start_worker())

    async def _start_worker(self) -> None:
        try:
            worker = await self._template.fork(self._memory_mb)
        except (TemplateLost, WorkerDied):
            return  # the supervision tries again
        finally:
            self._starting -= 1
        self._workers.add(worker)
        self._idle.append(worker)
        self._hand_out()

    async def _supervise(self) -> None:
        """Never miss a process that died or was stopped, nor who waits too long."""
        while True:
            await asyncio.sleep(SUPERVISION_S)
            try:
                for worker in [worker for worker in self._workers if not is_running(worker.pid)]:
                    logger.warning("worker %d died or was stopped; it is replaced", worker.pid)
                    self._replace(worker)
                if self._template.lost:
                    logger.warning("the template process was lost; it is started again")
                    self._open = False
                    self._template.close()
                    self._template = Template(self._template.preloaded)
                    self.template_restarted.set()
                self._fill()
                self._take_for_others()
                self._hand_out()
            except Exception:
                logger.exception("supervision of the workers failed; it goes on")

    def _spawn(self, coroutine: Coroutine[Any, Any, None]) -> None:
        """Run something beside, until the pool closes."""
        task = asyncio.get_running_loop().create_task(coroutine)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
