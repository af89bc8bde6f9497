"""The start when kernels on disk are damaged or cannot be kept."""

import asyncio
from collections.abc import AsyncIterator, Sequence
from contextlib import asynccontextmanager

import pytest

from app.calculations import COUPLING, Stage
from app.workers import start_up
from app.workers.control import TemplateLost
from app.workers.stages import STAGES
from app.workers.start_up import StartUp


class FakePool:
    """Loads stages as a test says: how often the template dies over one, and how many kernels each compiles."""

    def __init__(self, deaths: dict[str, int] | None = None, compiled: int = 0) -> None:
        self.template_restarted = asyncio.Event()
        self.loaded: list[str] = []
        self.compiled: list[str] = []
        self._deaths = deaths or {}
        self._compiled = compiled

    async def warm(self, stage: str) -> int:
        if self._deaths.get(stage, 0):
            self._deaths[stage] -= 1
            raise TemplateLost
        self.loaded.append(stage)
        return self._compiled

    def renew(self) -> None:
        pass

    @asynccontextmanager
    async def compiler(self, stages: Sequence[str]) -> AsyncIterator["FakePool"]:
        self.compiled += stages
        yield self

    async def receive(self) -> bytes:
        return b"stage"


@pytest.fixture
def marks(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """What is done to the cache."""
    done: list[str] = []
    monkeypatch.setattr(start_up, "RETRY_S", 0.0)
    monkeypatch.setattr(start_up, "discard_kernels", lambda stage: done.append(f"discarded {stage.name}"))
    monkeypatch.setattr(start_up, "mark_complete", lambda _: done.append("complete"))
    return done


def load(pool: FakePool, stage: Stage) -> None:
    asyncio.run(StartUp(pool)._load(stage))


def test_a_stage_that_kills_the_template_twice_is_compiled_again(
    marks: list[str], caplog: pytest.LogCaptureFixture
) -> None:
    pool = FakePool(deaths={COUPLING.name: 2})
    load(pool, COUPLING)
    assert marks == ["discarded coupling"]
    assert pool.compiled == pool.loaded == ["coupling"]
    assert [record.message for record in caplog.records] == [
        "two processes died while they loaded coupling: its kernels are compiled again"
    ]


def test_one_death_of_the_template_costs_no_kernel(marks: list[str]) -> None:
    pool = FakePool(deaths={COUPLING.name: 1})
    load(pool, COUPLING)
    assert marks == []
    assert pool.compiled == []
    assert pool.loaded == ["coupling"]


@pytest.mark.parametrize(("compiled", "expected"), [(0, ["complete"]), (1, [])])
def test_a_cache_is_complete_if_loading_compiled_nothing(marks: list[str], compiled: int, expected: list[str]) -> None:
    pool = FakePool(compiled=compiled)
    asyncio.run(StartUp(pool)._compile())
    assert set(pool.loaded) == {stage.name for stage in STAGES}
    assert marks == expected
