"""The page and the report of a study, sent in parts while the study runs.

A new part with results or with the progress replaces the part before it.
"""

import logging
from collections.abc import AsyncGenerator, Callable
from contextlib import aclosing, suppress
from typing import Any

from app.errors import DeadlineExceeded, WorkerLost
from app.pages.studies.page import Opened, StudyPage, drawn, report, report_progress
from app.pages.templating import rendered
from app.studies.runner import Clock, Line, Lines, Pool, twice_if_lost

FIRST_FRAME_S = 0.3  # time until a page shows its first points
FRAME_SHARE = 0.3  # pause until a page is drawn again, as a share of the time that the study has run
LONGEST_PAUSE_S = 4.0  # longest time between two drawings of a page, however long the study runs
NOT_DRAWN = (
    b'<div class="frame"><p class="warning">The figure could not be drawn; the files hold the points.</p>'
    b'<span class="ready" hidden></span></div>'
)

logger = logging.getLogger("tribodrive")


async def pieces(pool: Callable[[], Pool], opened: Opened, lines: Lines, clock: Clock) -> AsyncGenerator[bytes, None]:
    """Yield the page of a study: the head of the page, then results, then the tail of the page."""
    yield opened.head
    received, due = list[Line](), FIRST_FRAME_S
    async with aclosing(lines):
        async for group in lines:
            received += [line for line in group if line["type"] != "progress"]
            has_ended = bool(received) and received[-1]["type"] in {"end", "error"}
            if clock.done and clock.elapsed_s >= due and not has_ended:
                yield await _part(pool(), drawn, opened.page, received, clock.progress)
                due = clock.elapsed_s + min(max(FRAME_SHARE * clock.elapsed_s, FIRST_FRAME_S), LONGEST_PAUSE_S)
    ended_early = clock.progress if received and received[-1]["type"] == "error" else None
    yield await _part(pool(), drawn, opened.page, received, ended_early)
    yield opened.tail


async def report_pieces(
    pool: Callable[[], Pool], page: StudyPage, host: str, lines: Lines, clock: Clock
) -> AsyncGenerator[bytes, None]:
    """Yield the parts of a document that first shows the progress of a study, and finally the report of the study."""
    yield rendered("report_progress.html", page.asked.root, page=page).encode() + report_progress(page, clock.progress)
    received, due = list[Line](), FIRST_FRAME_S
    async with aclosing(lines):
        async for group in lines:
            received += [line for line in group if line["type"] != "progress"]
            if clock.elapsed_s >= due:
                yield report_progress(page, clock.progress)
                due = clock.elapsed_s + FIRST_FRAME_S
    last = received[-1]
    if last["type"] == "error":
        ended = f"The study ended after {last['done']} of {clock.total} points. {last['message']}"
        yield report_progress(page, clock.progress, problem=ended)
        return
    yield report_progress(page, clock.progress, has_ended=True)
    failed = report_progress(page, clock.progress, problem="The report could not be written; try again.")
    yield await _part(pool(), report, page, received, host, failed=failed)


async def _part(pool: Pool, view: Callable[..., bytes], *arguments: Any, failed: bytes = NOT_DRAWN) -> bytes:
    """Return the part of a document that a view makes in a worker, or `failed` if the view fails.

    No error is raised, because the status of the response has already been sent.
    """
    part = failed
    try:
        with suppress(WorkerLost, DeadlineExceeded):
            part = await twice_if_lost(pool, view, *arguments)
    except Exception:
        logger.exception("a part of a study's page failed")
    return part
