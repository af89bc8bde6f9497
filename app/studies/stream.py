"""A study as a stream of lines: progress while nothing else comes, an end that says so when it is not the planned one."""

import asyncio
import time
from collections.abc import AsyncIterator, Callable
from typing import Any

from app.studies.engine import PoolLost

Line = dict[str, Any]
PROGRESS_SECONDS = 2.0


class Clock:
    """How long a study has run and how far it has come."""

    def __init__(self, total: int) -> None:
        self.total = total
        self.done = 0
        self._started = time.perf_counter()

    @property
    def elapsed_s(self) -> float:
        """Seconds since the study began, to the millisecond."""
        return round(time.perf_counter() - self._started, 3)


async def guarded(lines: AsyncIterator[list[Line]], clock: Clock, seconds: float) -> AsyncIterator[list[Line]]:
    """The lines, with progress between them; a study that breaks off or takes too long ends with an error line."""
    upcoming = asyncio.ensure_future(anext(lines))
    try:
        while True:
            left = seconds - clock.elapsed_s
            if left <= 0.0:
                yield [_error(clock, "study_deadline", f"the study took longer than {seconds:g} s; make it smaller")]
                return
            done, _ = await asyncio.wait({upcoming}, timeout=min(PROGRESS_SECONDS, left))
            if not done:
                yield [_progress(clock)]
                continue
            try:
                yield upcoming.result()
            except StopAsyncIteration:
                return
            except PoolLost as error:
                yield [_error(clock, "scheduler_lost", str(error))]
                return
            upcoming = asyncio.ensure_future(anext(lines))
    finally:
        await _closed(upcoming)


async def _closed(upcoming: "asyncio.Future[Any]") -> None:
    """Stop waiting for the next line and let its generator clean up."""
    upcoming.cancel()
    await asyncio.wait({upcoming})
    if not upcoming.cancelled():
        upcoming.exception()


def _progress(clock: Clock) -> Line:
    return {"type": "progress", "done": clock.done, "total": clock.total, "elapsed_s": clock.elapsed_s}


def _error(clock: Clock, code: str, message: str) -> Line:
    return {"type": "error", "code": code, "message": message, "done": clock.done}


async def encoded(lines: AsyncIterator[list[Line]], encode: Callable[[Line], bytes]) -> AsyncIterator[bytes]:
    """The lines as bytes, those that come together in one piece."""
    async for group in lines:
        piece = b"".join(map(encode, group))
        if piece:
            yield piece
