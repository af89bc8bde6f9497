"""Pools in the process of the test: two calculate at once, the third gives the answers that a test prescribes."""

import asyncio
import pickle
from collections.abc import Callable, Hashable, Sequence
from typing import Any

from app.settings import Settings
from app.studies.points import Chunk, Point, Question
from app.studies.requests import Overrides
from app.workers.pool import Job, Pool


class InlinePool:
    """This pool of a study calculates as soon as a calculation is submitted."""

    chunk_s = longest_s = 0.25
    ahead = 2

    def __init__(self, slots: int = 1) -> None:
        self.slots = slots

    def submit(self, function: Callable[..., Any], *arguments: Any) -> asyncio.Future[Any]:
        outcome: asyncio.Future[Any] = asyncio.get_running_loop().create_future()
        outcome.set_result(function(*arguments))
        return outcome


class InlineWorkers(Pool):
    """The service's pool without processes: a call is pickled as for a worker, and ends as it is queued."""

    def __init__(self, settings: Settings) -> None:
        super().__init__(settings, ())
        self.alive = self.size

    def submit(self, owner: Hashable, function: Callable[..., Any], *arguments: Any, is_single: bool = True) -> Job:
        job = Job(owner, pickle.dumps((function, arguments)), is_single, asyncio.get_running_loop().create_future())
        called, given = pickle.loads(job.call)  # noqa: S301  of this test
        try:
            job.outcome.set_result(pickle.loads(pickle.dumps(called(*given))))  # noqa: S301
        except Exception as error:  # noqa: BLE001  any error of the call
            job.outcome.set_exception(error)
        return job


class ScriptedPool:
    """This pool answers the point at `x` with the number x.

    If `faults` has errors for a point, the calls with this point fail first, one call for each of the errors. A call
    with a point in `holds` is never answered. The pool reports a computing time of `seconds` per point. The pool
    solves at most `most` of the points of a call.
    """

    chunk_s = longest_s = 0.25
    ahead = 2

    def __init__(
        self,
        slots: int = 2,
        faults: dict[int, list[Exception]] | None = None,
        *,
        holds: Sequence[int] = (),
        seconds: float = 0.05,
        most: int = 1000,
    ) -> None:
        self.slots = slots
        self.calls: list[list[int]] = []
        self.futures: list[asyncio.Future[Any]] = []
        self._faults = {place: list(errors) for place, errors in (faults or {}).items()}
        self._holds = set(holds)
        self._seconds = seconds
        self._most = most

    def submit(self, _function: Callable[..., Any], *arguments: Any) -> asyncio.Future[Any]:
        asked: Sequence[Overrides] = arguments[1]
        places = [int(each["x"] or 0) for each in asked]
        self.calls.append(places)
        outcome: asyncio.Future[Any] = asyncio.get_running_loop().create_future()
        self.futures.append(outcome)
        error = next((self._faults[place].pop(0) for place in places if self._faults.get(place)), None)
        if error is not None:
            outcome.set_exception(error)
        elif not self._holds & set(places):
            done = places[: self._most]
            points = [Point("ok", [float(place)], []) for place in done]
            outcome.set_result(Chunk(points, self._seconds * len(done)))
        return outcome


QUESTION = Question("/v1/coupling", {}, ["axial_thrust.force_n"], 30.0)


def at(index: int) -> Overrides:
    return {"x": index}
