"""A study as a stream of lines: progress while nothing else comes, and an error line where it ends before its time."""

import asyncio
import logging
import time
from collections.abc import AsyncGenerator
from contextlib import aclosing
from typing import Any

from app.studies.engine import PoolLost

Line = dict[str, Any]
Lines = AsyncGenerator[list[Line], None]
PROGRESS_SECONDS = 2.0

logger = logging.getLogger("tribodrive")


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

    def line(self) -> Line:
        """How far the study has come."""
        return {"type": "progress", "done": self.done, "total": self.total, "elapsed_s": self.elapsed_s}

    def error(self, code: str, message: str) -> Line:
        """The line that ends a study before its time."""
        return {"type": "error", "code": code, "message": message, "done": self.done}


async def guarded(lines: Lines, clock: Clock, seconds: float) -> Lines:
    """The lines, with progress between them; a study that breaks off or takes too long ends with an error line."""
    async with aclosing(lines):
        upcoming = asyncio.ensure_future(anext(lines, None))
        try:
            while True:
                left = seconds - clock.elapsed_s
                if left <= 0.0:
                    yield [clock.error("study_deadline", f"the study took longer than {seconds:g} s; make it smaller")]
                    return
                done, _ = await asyncio.wait({upcoming}, timeout=min(PROGRESS_SECONDS, left))
                if not done:
                    if left > PROGRESS_SECONDS:
                        yield [clock.line()]
                    continue
                group, end = _outcome(upcoming, clock)
                if group:
                    yield group
                if end:
                    return
                upcoming = asyncio.ensure_future(anext(lines, None))
        finally:
            upcoming.cancel()
            await asyncio.gather(upcoming, return_exceptions=True)


def _outcome(upcoming: asyncio.Future[list[Line] | None], clock: Clock) -> tuple[list[Line], bool]:
    """The next lines, and whether they are the last."""
    try:
        group = upcoming.result()
    except PoolLost as error:
        return [clock.error("scheduler_lost", str(error))], True
    except Exception:
        logger.exception("a study failed")
        return [clock.error("internal_error", "something went wrong in the service; the log has the cause")], True
    return group or [], group is None
