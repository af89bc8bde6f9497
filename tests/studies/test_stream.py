"""The stream of a study reports progress while no line comes, and an early end in its last line."""

import asyncio
from collections.abc import AsyncGenerator
from contextlib import ExitStack, nullcontext

import pytest
from prometheus_client import REGISTRY
from starlette.types import Message

from app.errors import PoolLost
from app.http.routes.studies import StudyStream
from app.http.streams import guarded
from app.studies.runner import Clock, Line


def lines_of(*steps: float | Exception, progress_s: float = 2.0) -> list[Line]:
    """Return the lines of a study. Each of `steps` is either the wait [s] before a line, or an exception to raise."""
    closed = []

    async def study() -> AsyncGenerator[list[Line], None]:
        try:
            for place, step in enumerate(steps):
                if isinstance(step, Exception):
                    raise step
                await asyncio.sleep(step)
                yield [{"type": "point", "index": place}]
        finally:
            closed.append(True)

    async def run() -> list[Line]:
        found: list[Line] = []
        async for group in guarded(study(), Clock(len(steps)), 0.5, progress_s):
            found += group
        return found

    found = asyncio.run(run())
    assert closed == [True]
    return found


def test_progress_while_nothing_comes() -> None:
    kinds = [line["type"] for line in lines_of(0.0, 0.13, 0.0, progress_s=0.05)]
    assert kinds[0] == "point"
    assert set(kinds[1:-2]) == {"progress"}
    assert kinds[-2:] == ["point", "point"]


def test_no_progress_while_points_come() -> None:
    assert [line["type"] for line in lines_of(*[0.01] * 5)] == ["point"] * 5


def test_the_deadline_ends_a_study_and_is_logged_and_counted(caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level("WARNING", "tribodrive")  # a service that ran in this process may have left a higher level
    before = REGISTRY.get_sample_value("tribodrive_studies_unfinished_total") or 0.0
    *_, last = lines_of(0.0, 5.0)
    assert (last["type"], last["code"]) == ("error", "study_deadline")
    assert REGISTRY.get_sample_value("tribodrive_studies_unfinished_total") == before + 1
    assert "ended after 0 of 2 points: the study took longer than 0.5 s" in caplog.text


def test_the_deadline_ends_a_study_that_sends_without_end() -> None:
    *points, last = lines_of(*[0.01] * 1000)
    assert (last["type"], last["code"]) == ("error", "study_deadline")
    assert 0 < len(points) < 100


@pytest.mark.parametrize(
    ("error", "code"), [(PoolLost("gone"), "scheduler_lost"), (RuntimeError("secret"), "internal_error")]
)
def test_a_study_that_breaks_says_so(error: Exception, code: str) -> None:
    point, last = lines_of(0.0, error, 0.0)
    assert point["type"] == "point"
    assert (last["type"], last["code"], last["done"]) == ("error", code, 0)
    assert "secret" not in last["message"]


def test_leaving_closes_the_study() -> None:
    closed = []

    async def study() -> AsyncGenerator[list[Line], None]:
        try:
            yield []
            await asyncio.sleep(60)
        finally:
            closed.append(True)

    async def run() -> None:
        lines = guarded(study(), Clock(2), 60)
        waiting = asyncio.ensure_future(anext(lines, None))
        await asyncio.sleep(0.02)
        waiting.cancel()
        await asyncio.wait({waiting})
        await lines.aclose()

    asyncio.run(run())
    assert closed == [True]


@pytest.mark.parametrize("leaves", [True, False])
def test_a_client_who_leaves_or_never_reads_loses_his_place(leaves: bool) -> None:
    freed = []

    async def pieces() -> AsyncGenerator[bytes, None]:
        try:
            while True:
                yield b"x"
        finally:
            freed.append("study")

    async def receive() -> Message:
        await asyncio.sleep(0.05 if leaves else 60)
        return {"type": "http.disconnect"}

    async def send(message: Message) -> None:
        if message["type"] == "http.response.body":
            await asyncio.sleep(60)

    stack = ExitStack()
    stack.callback(freed.append, "place")
    answer = StudyStream(pieces(), 0.3, stack)
    with nullcontext() if leaves else pytest.raises(TimeoutError):
        asyncio.run(answer({"type": "http"}, receive, send))
    assert freed == ["study", "place"]
