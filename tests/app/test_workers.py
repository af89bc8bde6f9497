"""The pool shares its workers fairly among the callers, and replaces workers that die or do not start.

The tests use a stand-in instead of real processes.
"""

import asyncio
import pickle
from collections import Counter, deque
from collections.abc import Awaitable, Callable
from contextlib import suppress
from typing import Any

import pytest
from anyio import BrokenWorkerProcess, CapacityLimiter, to_process

from app.errors import QueueFull, WorkerLost
from app.settings import Settings
from app.workers import pool as pools
from app.workers.pool import Outcome, Pool
from app.workers.worker import perform, prepare


class Processes:
    """Stand-in for AnyIO's processes. A test decides how processes start and when calls are answered.

    As in AnyIO, a call goes to the idle process that was used last. If no process is idle, the call starts a process.
    """

    def __init__(self) -> None:
        self.calls: dict[str, asyncio.Future[tuple[str, list[str]]]] = {}
        self.order: list[str] = []
        self.idle: list[int] = []
        self.checked = Counter[int]()
        self.starts = 0
        self.faults: deque[Callable[[], Awaitable[None]]] = deque()

    async def run_sync(self, function: Callable[..., Any], *arguments: Any, limiter: CapacityLimiter, **_: Any) -> Any:
        async with limiter:
            if self.idle:
                process = self.idle.pop()
            else:
                self.starts += 1
                process = self.starts
                if self.faults:
                    await self.faults.popleft()()
            if function is prepare:
                self.checked[process] += 1
                await asyncio.sleep(0)
                self.idle.append(process)
                return process
            assert function is perform
            _, (name,) = pickle.loads(arguments[-1])  # noqa: S301  of this test
            self.order.append(name)
            self.calls[name] = asyncio.get_running_loop().create_future()
            answer = await self.calls[name]
            self.idle.append(process)
            return answer

    async def answer(self, name: str) -> None:
        """End the call that has this name, with the name as its result."""
        self.calls[name].set_result((name, []))
        await settled()


async def settled() -> None:
    for _ in range(20):
        await asyncio.sleep(0)


def with_pool(
    monkeypatch: pytest.MonkeyPatch,
    check: Callable[[Pool, Processes], Awaitable[None]],
    workers: int = 2,
    faults: tuple[Callable[[], Awaitable[None]], ...] = (),
) -> None:
    """Run `check` with a pool whose workers are processes of the stand-in `Processes`."""
    processes = Processes()
    processes.faults.extend(faults)
    monkeypatch.setattr(to_process, "run_sync", processes.run_sync)

    async def run() -> None:
        pool = Pool(Settings(workers=workers, queue=4), ())
        tasks = [asyncio.create_task(work) for work in (pool.keep_workers(), *(pool.serve() for _ in range(workers)))]
        await settled()
        while not faults and pool.alive < workers:  # noqa: ASYNC110  nothing tells when
            await asyncio.sleep(0.01)
        try:
            await check(pool, processes)
        finally:
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)

    asyncio.run(run())


def ask(pool: Pool, owner: str, name: str, **options: bool) -> Outcome:
    return pool.submit(owner, str, name, **options).outcome


def test_the_next_worker_goes_to_whoever_has_the_fewest_then_to_whoever_waits_longest(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    async def check(pool: Pool, processes: Processes) -> None:
        for number in range(4):
            ask(pool, "greedy", f"greedy {number}")
        await settled()
        assert processes.order == ["greedy 0", "greedy 1"]
        ask(pool, "study", "study 0", is_single=False)
        ask(pool, "honest", "honest 0")
        await processes.answer("greedy 0")
        assert processes.order[2:] == ["study 0"]
        ask(pool, "study", "study 1", is_single=False)
        await processes.answer("study 0")
        assert processes.order[3:] == ["honest 0"]
        ask(pool, "honest", "honest 1")
        await processes.answer("honest 0")
        assert processes.order[4:] == ["study 1"]  # honest had its turn later

    with_pool(monkeypatch, check)


def test_a_full_queue_refuses_whoever_has_most_places(monkeypatch: pytest.MonkeyPatch) -> None:
    async def check(pool: Pool, _: Processes) -> None:
        greedy = [ask(pool, "greedy", f"{number}") for number in range(6)]  # two workers, four places in the queue
        await settled()
        with pytest.raises(QueueFull):
            pool._admit("greedy")
        for number in range(5):
            pool._admit("honest")
            ask(pool, "honest", f"honest {number}")
        with pytest.raises(QueueFull):
            pool._admit("honest")
        pool._admit("other")
        assert not any(call.done() for call in greedy)

    with_pool(monkeypatch, check)


def test_a_call_that_nobody_waits_for_has_a_little_time(monkeypatch: pytest.MonkeyPatch) -> None:
    async def check(pool: Pool, processes: Processes) -> None:
        waiting = [ask(pool, "client", f"{number}") for number in range(2)]
        await settled()
        for each in waiting:
            each.cancel()
        await settled()
        assert processes.order == ["0"]
        assert not processes.calls["0"].cancelled()
        await asyncio.sleep(0.3)
        assert processes.calls["0"].cancelled()  # which kills AnyIO's worker
        ask(pool, "client", "2")
        await settled()
        assert processes.order == ["0", "2"]

    monkeypatch.setattr(pools, "GRACE_S", 0.1)
    with_pool(monkeypatch, check, workers=1)


def test_a_lost_worker_costs_its_own_call_and_another_one_starts(monkeypatch: pytest.MonkeyPatch) -> None:
    async def check(pool: Pool, processes: Processes) -> None:
        lost, other = ask(pool, "client", "0"), ask(pool, "client", "1")
        await asyncio.sleep(0.2)
        starts = processes.starts
        processes.calls["0"].set_exception(BrokenWorkerProcess())
        await settled()
        with pytest.raises(WorkerLost):
            lost.result()
        assert processes.starts > starts
        await processes.answer("1")
        assert other.result() == "1"

    with_pool(monkeypatch, check)


async def succeed() -> None:
    pass


async def hang() -> None:
    await asyncio.sleep(3600)


async def die() -> None:
    raise BrokenWorkerProcess


async def interrupt() -> None:
    raise KeyboardInterrupt


@pytest.mark.parametrize("fault", [hang, die, interrupt])
def test_a_worker_that_does_not_start_is_started_again(
    monkeypatch: pytest.MonkeyPatch, fault: Callable[[], Awaitable[None]]
) -> None:
    async def check(pool: Pool, processes: Processes) -> None:
        with suppress(TimeoutError):
            async with asyncio.timeout(5):
                while pool.alive < 2:  # noqa: ASYNC110  nothing tells when
                    await asyncio.sleep(0.01)
        assert pool.alive == 2
        assert processes.starts >= 3

    monkeypatch.setattr(pools, "START_S", 0.1)
    monkeypatch.setattr(pools, "PAUSE_S", 0.01)
    with_pool(monkeypatch, check, faults=(fault,))


def test_a_call_does_not_wait_for_the_start_of_a_worker_if_another_worker_is_free(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The start of a worker must not use up the time that a study's call has until its deadline."""

    async def check(pool: Pool, processes: Processes) -> None:
        assert pool.alive == 1
        first, second = ask(pool, "study", "0", is_single=False), ask(pool, "study", "1", is_single=False)
        await settled()
        assert processes.order == ["0"]
        await processes.answer("0")
        assert processes.order == ["0", "1"]
        await processes.answer("1")
        assert (first.result(), second.result()) == ("0", "1")

    monkeypatch.setattr(pools, "PAUSE_S", 0.01)
    with_pool(monkeypatch, check, faults=(succeed, hang))


def test_idle_workers_are_checked_all_at_the_same_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """If idle workers were checked one after another, AnyIO would give all checks to the same worker."""
    # AnyIO would then end the other worker.

    async def check(pool: Pool, processes: Processes) -> None:
        await asyncio.sleep(0.5)
        assert pool.alive == processes.starts == 2
        assert all(count > 3 for count in processes.checked.values())

    monkeypatch.setattr(pools, "IDLE_S", 0.05)
    monkeypatch.setattr(pools, "PAUSE_S", 0.01)
    with_pool(monkeypatch, check)


def test_a_lost_worker_is_replaced_while_another_one_is_idle(monkeypatch: pytest.MonkeyPatch) -> None:
    """The pool has to start a new worker, because a check of the idle worker does not replace the lost worker."""

    async def check(pool: Pool, processes: Processes) -> None:
        await asyncio.sleep(0.2)
        assert pool.alive == processes.starts == 2
        lost = ask(pool, "client", "0")
        await settled()
        processes.calls["0"].set_exception(BrokenWorkerProcess())
        await asyncio.sleep(0.2)
        assert isinstance(lost.exception(), WorkerLost)
        assert len(processes.idle) == pool.alive == 2
        assert processes.starts == 3

    monkeypatch.setattr(pools, "PAUSE_S", 0.01)
    with_pool(monkeypatch, check)
