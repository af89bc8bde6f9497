"""A fixed number of workers, replaced when they end, and their fair shares: which call gets the next one.

* The next worker goes to the client or study with the fewest calls running; of these to single requests before studies,
  then to the one served longest ago.
* When all places are taken, the newest call of the client with the most places is refused.
* For a call that has waited for a second, while another client holds more than an equal share, the youngest call of
  such a client is interrupted and made again later; each call once at most. If the waiting call is short, the worker is
  then reserved for short calls as long as they come.

A client alone is never affected.
"""

import asyncio
import logging
import statistics
from collections import Counter, deque
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from cachetools import LRUCache
from fastapi import Request

from app.errors import ClientGone, DeadlineExceeded, QueueFull, WorkerLost
from app.log import CALCULATIONS, DEADLINES_MISSED, INTERRUPTED, REFUSED, WAITING, WORKERS_LOST
from app.settings import Settings
from app.workers.processes import ProcessDied, Template, Worker, is_running

SUPERVISION_S = 0.1  # between two looks at the processes: a lost worker is replaced within 0.3 s
INTERRUPT_AFTER_S = 1.0  # how long a call waits before another one is interrupted for it
SHORT_S = 1.0  # a call is short when the median of the last ones of its kind took less
RESERVED_S = 2.0  # a worker stays reserved for short calls until none has come for so long
DURATIONS_KEPT = 15  # of each kind
GRACE_S = 0.5  # after a study has ended: calculations about to finish save their worker

logger = logging.getLogger("tribodrive")


@dataclass(eq=False, slots=True)
class Job:
    """One call. `owner` is the client or study that asks; calls of one `kind` take about as long as each other.

    A single request has `deadline_s` from when it begins to wait, a call of a study from when it gets its worker.
    """

    owner: object
    kind: object
    deadline_s: float
    of_study: bool = False
    worker: Worker | None = None
    since: float = 0.0  # when it began to wait, or with a worker to run [s]
    interrupted: Worker | None = None  # the worker it lost to another client
    left: bool = False  # its client is gone: the call raises ClientGone
    turn: asyncio.Future[Worker] = field(init=False)  # the worker, once it has one
    timeout: asyncio.Timeout = field(init=False)

    def expire_at(self, when: float | None) -> None:
        """Move the deadline."""
        if not self.timeout.expired():
            self.timeout.reschedule(when)


class Shares:
    """The calls that wait for a worker and those that have one."""

    def __init__(self, workers: int, places: int) -> None:
        self.running: list[Job] = []
        self._workers = workers
        self._places = places
        self._queue: list[Job] = []
        self._served: dict[object, float] = {}  # when an owner last got a worker [s]
        self._durations: LRUCache[object, deque[float]] = LRUCache(256)
        self._reserved_until = 0.0

    @property
    def waiting(self) -> list[Job]:
        """The calls that wait, longest first; without those that were refused or cancelled and are about to leave."""
        return [job for job in self._queue if not job.turn.done()]

    def admit(self, job: Job) -> None:
        """Where all places are taken, refuse a single request; raises QueueFull if it is this one."""
        single = [each for each in (*self.running, *self.waiting, job) if not each.of_study]
        if job.of_study or len(single) <= self._places:
            return
        places = Counter(each.owner for each in single)
        newest_first = [job, *(each for each in reversed(self.waiting) if not each.of_study)]
        refused = max(newest_first, key=lambda each: places[each.owner])
        REFUSED.inc()
        if refused is job:
            raise QueueFull
        refused.turn.set_exception(QueueFull())

    def add(self, job: Job, now: float) -> None:
        """Let a call wait for its turn."""
        job.turn, job.since = asyncio.get_running_loop().create_future(), now
        self._queue.append(job)

    def remove(self, job: Job, now: float, *, finished: bool) -> None:
        """A call has ended, or does not wait any longer."""
        if job in self._queue:
            self._queue.remove(job)
        else:
            self.running.remove(job)
            if finished or now - job.since > SHORT_S:
                self._durations.setdefault(job.kind, deque(maxlen=DURATIONS_KEPT)).append(now - job.since)
        if all(each.owner is not job.owner for each in (*self.running, *self._queue)):
            self._served.pop(job.owner, None)

    def next(self, now: float) -> Job | None:
        """The call that gets the next worker, which from now on it has."""
        waiting = self.waiting
        if now < self._reserved_until and sum(not self._is_short(job) for job in self.running) >= self._workers - 1 > 0:
            waiting = [job for job in waiting if self._is_short(job)]
        held = Counter(job.owner for job in self.running)
        job = min(
            waiting, key=lambda job: (held[job.owner], job.of_study, self._served.get(job.owner, 0.0)), default=None
        )
        if job is not None:
            if self._is_short(job) and now < self._reserved_until:
                self._reserved_until = now + RESERVED_S
            self._queue.remove(job)
            self.running.append(job)
            self._served[job.owner] = job.since = now
        return job

    def to_interrupt(self, now: float) -> Job | None:
        """The call to be interrupted for one that has waited long enough and whose owner holds less than a share."""
        waiting = self.waiting
        if len(self.running) < self._workers:  # a worker is on its way
            return None
        held = Counter(job.owner for job in self.running)
        share = self._workers / len({job.owner for job in (*self.running, *waiting)})
        for job in waiting:
            if now - job.since < INTERRUPT_AFTER_S:
                break
            # Exchanging one long call for another is worth it only if the owners' numbers of workers become more equal.
            least = held[job.owner] + (1 if self._is_short(job) else 2)
            others = [each for each in self.running if held[each.owner] > share and held[each.owner] >= least]
            if others := [each for each in others if each.interrupted is None]:
                if self._is_short(job):
                    self._reserved_until = now + RESERVED_S
                return max(others, key=lambda each: each.since)
        return None

    def _is_short(self, job: Job) -> bool:
        durations = self._durations.get(job.kind)
        return durations is None or statistics.median(durations) < SHORT_S


class Pool:
    """The workers, copies of one template process, and the calls that wait for them."""

    def __init__(self, settings: Settings, template: Template) -> None:
        self.size = settings.workers
        self.template = template
        self.template_restarted = asyncio.Event()
        self._settings = settings
        self._forkable = asyncio.Event()  # whether the template has loaded what workers need
        self._workers: set[Worker] = set()
        self._idle: list[Worker] = []
        self._shares = shares = Shares(settings.workers, settings.workers + settings.queue)
        WAITING.set_function(lambda: sum(not job.of_study for job in shares.waiting))
        CALCULATIONS.set_function(lambda: sum(not job.of_study for job in (*shares.running, *shares.waiting)))

    @property
    def workers_alive(self) -> int:
        """How many workers can calculate."""
        return len(self._workers)

    async def calculate(self, http: Request, function: Callable[..., Any], *arguments: Any) -> Any:
        """The function's result for the client of a request, whose disconnect ends the work.

        The client is what the header of the settings names, else an address. Raises what `run` raises.
        """
        header = self._settings.client_header
        name = http.headers.get(header) if header else None
        owner = name or (http.client.host if http.client else "")
        job = Job(owner, http.scope["route"].path, self._settings.deadline_s)
        watcher = asyncio.create_task(_leave_with_client(http, job))
        try:
            return await self.run(job, function, *arguments)
        finally:
            watcher.cancel()

    async def run(self, job: Job, function: Callable[..., Any], *arguments: Any) -> Any:
        """The function's result; a caller that is cancelled ends its worker.

        Raises QueueFull, DeadlineExceeded, ClientGone, WorkerLost, and what the function raises.
        """
        self._shares.admit(job)
        try:
            async with asyncio.timeout(None if job.of_study else job.deadline_s) as job.timeout:
                while True:
                    try:
                        self._shares.add(job, _now())
                        self._hand_out()
                        worker = await job.turn
                        return await worker.call(function, *arguments)
                    except ProcessDied as error:
                        # A call that had not begun, or was interrupted for another client, is made again.
                        if worker.begun and worker is not job.interrupted:
                            WORKERS_LOST.inc()
                            logger.warning("worker %d was lost while it calculated", worker.pid)
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
            job.turn.set_result(job.worker)

    def _release(self, job: Job) -> None:
        """Remove a call from the queue, or free its worker."""
        worker, job.worker = job.worker, None
        self._shares.remove(job, _now(), finished=worker is not None and not worker.ended.is_set())
        if worker is not None:
            if worker.outdated:
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

    async def keep_worker(self) -> None:
        """Have a worker, and another one when it has ended."""
        while True:
            await self._forkable.wait()
            try:
                async with self.template.copy("work", self._settings.worker_memory_mb) as worker:
                    self._workers.add(worker)
                    try:
                        await worker.receive()
                        self._idle.append(worker)
                        self._hand_out()
                        await worker.ended.wait()
                    finally:
                        self._workers.discard(worker)
            except ProcessDied:
                await asyncio.sleep(SUPERVISION_S)
            except Exception:
                logger.exception("the start of a worker failed; it is tried again")
                await asyncio.sleep(SUPERVISION_S)

    async def supervise(self) -> None:
        """Replace processes that died or were stopped; interrupt a call where another has waited too long."""
        while True:
            await asyncio.sleep(SUPERVISION_S)
            try:
                for worker in tuple(self._workers):
                    if not worker.ended.is_set() and not is_running(worker.pid):
                        logger.warning("worker %d died or was stopped; it is replaced", worker.pid)
                        worker.end()
                if self.template.lost:
                    logger.warning("the template process was lost; it is started again")
                    self._forkable.clear()
                    self.template.close()
                    self.template = Template(self.template.preloaded)
                    self.template_restarted.set()
                if (job := self._shares.to_interrupt(_now())) is not None and job.worker is not None:
                    # For another client that has waited long enough; it is made again, with a new deadline.
                    INTERRUPTED.inc()
                    job.interrupted = job.worker
                    job.expire_at(None if job.of_study else _now() + job.deadline_s)
                    job.worker.end()
                self._hand_out()  # a reservation may be over
            except Exception:
                logger.exception("supervision of the workers failed; it goes on")


async def _leave_with_client(http: Request, job: Job) -> None:
    await disconnected(http)
    job.left = True
    job.expire_at(_now())


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


def _now() -> float:
    return asyncio.get_running_loop().time()
