"""The start when kernels on disk are damaged or cannot be kept."""

import asyncio
import logging
from collections.abc import AsyncIterator, Sequence
from contextlib import asynccontextmanager

import pytest

from app.calculations import COUPLING, SLEEVE, Stage
from app.workers import start_up
from app.workers.processes import ProcessDied
from app.workers.stages import STAGES
from app.workers.start_up import StartUp


class FakePool:
    """A pool and its template, which loads stages as a test says: how often it dies over one, how many it compiles."""

    def __init__(self, deaths: dict[Stage, int] | None = None, compiled: int = 0) -> None:
        self.template = self
        self.template_restarted = asyncio.Event()
        self.loaded: list[Stage] = []
        self._deaths = deaths or {}
        self._compiled = compiled

    async def warm(self, stage: Stage) -> int:
        if self._deaths.get(stage, 0):
            self._deaths[stage] -= 1
            self.template_restarted.set()
            raise ProcessDied
        self.loaded.append(stage)
        return self._compiled

    def renew(self) -> None:
        pass

    @asynccontextmanager
    async def copy(self, _purpose: str, stages: Sequence[Stage]) -> AsyncIterator["Compiler"]:
        yield Compiler(stages)


class Compiler:
    """A process that reports one kernel for each stage, then the stage."""

    def __init__(self, stages: Sequence[Stage]) -> None:
        self._messages = iter([message for stage in stages for message in (None, stage)])

    async def receive(self) -> Stage | None:
        return next(self._messages)


@pytest.fixture
def marks(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """What is done to the cache."""
    done: list[str] = []
    monkeypatch.setattr(start_up, "discard", lambda module: done.append(f"discarded {module}"))
    monkeypatch.setattr(start_up, "is_complete", lambda _: False)
    monkeypatch.setattr(
        start_up, "mark_complete", lambda _, *, complete: done.append("complete" if complete else "incomplete")
    )
    return done


SAID = "two processes died while they loaded coupling: its kernels are compiled again"


@pytest.mark.parametrize(("deaths", "done", "said"), [(1, [], []), (2, ["discarded solvers.coupling.model"], [SAID])])
def test_a_stage_that_kills_the_template_twice_is_compiled_again(
    marks: list[str], caplog: pytest.LogCaptureFixture, deaths: int, done: list[str], said: list[str]
) -> None:
    pool = FakePool(deaths={COUPLING: deaths})
    asyncio.run(StartUp(pool)._load(COUPLING))
    assert marks == done
    assert pool.loaded == [COUPLING]
    assert [record.message for record in caplog.records if record.levelno >= logging.WARNING] == said


def test_a_complete_cache_in_which_a_kernel_is_missing_is_no_longer_marked(
    marks: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(start_up, "is_complete", lambda _: True)
    asyncio.run(StartUp(FakePool())._load_all())
    asyncio.run(StartUp(FakePool(compiled=1))._load_all())
    assert marks == ["complete", "incomplete"]


def test_a_stage_over_which_the_template_always_dies_is_left_out(
    marks: list[str], caplog: pytest.LogCaptureFixture
) -> None:
    pool = FakePool(deaths={COUPLING: 1000})
    start = StartUp(pool)

    async def load_two() -> None:
        await start._load(COUPLING)
        await start._load(SLEEVE)

    asyncio.run(load_two())
    assert pool.loaded == [SLEEVE]
    assert start.warm == [COUPLING, SLEEVE]
    assert marks == ["discarded solvers.coupling.model"]
    assert "coupling is not loaded" in caplog.text


@pytest.mark.parametrize(("compiled", "expected"), [(0, ["complete"]), (1, ["incomplete"])])
def test_a_cache_is_complete_if_loading_compiled_nothing(marks: list[str], compiled: int, expected: list[str]) -> None:
    pool = FakePool(compiled=compiled)
    asyncio.run(StartUp(pool)._load_all())
    assert set(pool.loaded) == set(STAGES)
    assert marks == expected
