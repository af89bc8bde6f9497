"""Patient calls: they wait behind nobody's back, are taken back while they wait, and never end a worker by leaving."""

import asyncio
from collections.abc import Awaitable, Callable, Coroutine
from typing import Any, cast

import pytest

from app.problems import DeadlineExceeded, WorkerLost
from app.workers.fork_server import ForkServer, Worker, WorkerDied
from app.workers.patient import PatientPool
from app.workers.pool import Pool


class FakeWorker:
    """Makes the call itself, with what a test lets happen."""

    def __init__(self) -> None:
        self.pid = 1
        self.alive = True
        self.calls = 0

    async def call(self, function: Callable[..., Awaitable[Any]], *arguments: Any) -> Any:
        self.calls += 1
        return await function(*arguments)

    def kill(self) -> None:
        self.alive = False


def worked(workers: int, scenario: Callable[[PatientPool, Pool, list[FakeWorker]], Coroutine[Any, Any, None]]) -> None:
    """Run a scenario on a pool of fake workers, all of them idle."""

    async def run() -> None:
        pool = Pool(workers, 512, cast("ForkServer", None))
        fakes = [FakeWorker() for _ in range(workers)]
        pool._workers = {cast("Worker", fake) for fake in fakes}
        pool._idle = list(pool._workers)
        await scenario(PatientPool(pool, workers, 0.2), pool, fakes)
        await asyncio.gather(*pool._tasks)
        assert len(pool._idle) == sum(fake.alive for fake in fakes)

    asyncio.run(run())


async def echo(value: int, seconds: float = 0.0) -> int:
    await asyncio.sleep(seconds)
    return value


async def broken(error: Exception) -> None:
    raise error


def test_results_and_errors() -> None:
    async def scenario(patient: PatientPool, _pool: Pool, _fakes: list[FakeWorker]) -> None:
        assert await asyncio.gather(*(patient.submit(echo, value) for value in range(5))) == list(range(5))
        with pytest.raises(ZeroDivisionError):
            await patient.submit(broken, ZeroDivisionError())
        with pytest.raises(WorkerLost):
            await patient.submit(broken, WorkerDied())

    worked(2, scenario)


def test_single_requests_come_first() -> None:
    order: list[str] = []

    async def note(name: str) -> None:
        await asyncio.sleep(0.01)
        order.append(name)

    async def scenario(patient: PatientPool, pool: Pool, _fakes: list[FakeWorker]) -> None:
        chunks = [patient.submit(note, f"chunk {number}") for number in range(3)]
        await asyncio.sleep(0)
        single = asyncio.create_task(pool.run(note, "single"))
        await asyncio.gather(single, *chunks)
        assert order == ["chunk 0", "single", "chunk 1", "chunk 2"]

    worked(1, scenario)


def test_what_waits_is_taken_back_and_what_runs_is_let_run() -> None:
    async def scenario(patient: PatientPool, _pool: Pool, fakes: list[FakeWorker]) -> None:
        running, waiting = patient.submit(echo, 1, 0.05), patient.submit(echo, 2)
        await asyncio.sleep(0.01)
        running.cancel()
        waiting.cancel()
        assert await patient.submit(echo, 3) == 3
        assert fakes[0].alive
        assert fakes[0].calls == 2

    worked(1, scenario)


def test_a_call_that_hangs_ends_its_worker() -> None:
    async def scenario(patient: PatientPool, _pool: Pool, fakes: list[FakeWorker]) -> None:
        with pytest.raises(DeadlineExceeded):
            await patient.submit(echo, 1, 5.0)
        assert sum(fake.alive for fake in fakes) == 1
        assert await patient.submit(echo, 2) == 2

    worked(2, scenario)
