"""The lines of a study as a stream: their deadline, the progress between them, and their bytes."""

import asyncio
import logging
from collections.abc import AsyncGenerator, Callable
from contextlib import aclosing

from app.errors import PoolLost
from app.studies.runner import Clock, Line, Lines

PROGRESS_S = 2.0  # time between lines of progress; these lines show proxies and users that the study runs

logger = logging.getLogger("tribodrive")


async def guarded(lines: Lines, clock: Clock, seconds: float, progress_s: float = PROGRESS_S) -> Lines:
    """Yield the lines of a study, and a line of progress if none came for `progress_s`.

    If the study fails or takes longer than `seconds`, the last line is an error.
    """
    async with aclosing(lines):
        upcoming = asyncio.ensure_future(anext(lines, None))
        try:
            while (left := seconds - clock.elapsed_s) > 0.0:
                done, _ = await asyncio.wait({upcoming}, timeout=min(progress_s, left))
                if done:
                    group = upcoming.result()
                    if group is None:
                        return
                    if group:
                        yield group
                    upcoming = asyncio.ensure_future(anext(lines, None))
                elif left > progress_s:
                    yield [clock.line()]
            yield [clock.error("study_deadline", f"the study took longer than {seconds:g} s; make the study smaller")]
        except PoolLost as error:
            yield [clock.error(error.code, str(error))]
        except Exception:
            logger.exception("a study failed")
            yield [clock.error("internal_error", "something went wrong in the service; the log has the cause")]
        finally:
            upcoming.cancel()
            await asyncio.gather(upcoming, return_exceptions=True)


async def encoded(lines: Lines, encode: Callable[[Line], bytes]) -> AsyncGenerator[bytes, None]:
    """Yield the lines of each group as one bytes object; skip groups without lines."""
    async with aclosing(lines):
        async for group in lines:
            if piece := b"".join(map(encode, group)):
                yield piece
