"""Pools for studies without processes: one that calculates at once, one that does what a test says."""

import asyncio
from collections.abc import Callable, Sequence
from typing import Any

from app.studies.points import Chunk, Point, Question
from app.studies.requests import Overrides


class InlinePool:
    """Calculates in this process, when asked."""

    def __init__(self, slots: int = 1) -> None:
        self.slots = slots

    def submit(self, function: Callable[..., Any], *arguments: Any) -> asyncio.Future[Any]:
        outcome: asyncio.Future[Any] = asyncio.get_running_loop().create_future()
        outcome.set_result(function(*arguments))
        return outcome


class ScriptedPool:
    """Answers the point at `x` with x, after what `faults` has in store for it; keeps back what it `holds`.

    It takes `seconds` a point, says so, and solves at most `most` of the points of a call.
    """

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
