"""Fair shares: which call gets the next worker, which one is refused, which one is interrupted for another client.

* The next worker goes to the client or study with the fewest calls running; of these to single requests before studies,
  then to the one served longest ago.
* When all places are taken, the newest call of the client with the most places is refused.
* For a call that has waited for a second, while another client holds more than an equal share, the youngest call of
  such a client is interrupted and made again later; each call once at most. If the waiting call is short, the worker is
  then reserved for short calls as long as they come.

A client alone is never affected.
"""

import asyncio
import statistics
from collections import Counter, deque
from dataclasses import dataclass, field

from cachetools import LRUCache

from app.errors import QueueFull
from app.log import REFUSED
from app.workers.control import Worker

INTERRUPT_AFTER_S = 1.0  # how long a call waits before another one is interrupted for it
SHORT_S = 1.0  # a call is short when the median of the last ones of its kind took less
RESERVED_S = 2.0  # a worker stays reserved for short calls until none has come for so long
DURATIONS_KEPT = 15  # of each kind


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
    left: bool = False  # its client is gone
    turn: asyncio.Future[None] = field(init=False)  # done when it has a worker
    timeout: asyncio.Timeout = field(init=False)

    def __post_init__(self) -> None:
        self.timeout = asyncio.timeout(None if self.of_study else self.deadline_s)

    def leave(self) -> None:
        """The client is gone: the call raises ClientGone."""
        self.left = True
        self.expire_at(asyncio.get_running_loop().time())

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
