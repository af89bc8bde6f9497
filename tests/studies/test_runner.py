"""The points of a study come back in order, whatever happens to the processes that solve the points."""

import asyncio
from contextlib import aclosing

import pytest

from app.errors import DeadlineExceeded, PoolLost, WorkerLost
from app.studies.points import Point
from app.studies.runner import Clock, in_order
from tests.support.pools import QUESTION, ScriptedPool, at


def solved(pool: ScriptedPool, total: int) -> list[tuple[int, Point]]:
    """Return every point with its index, in the order in which the points arrive."""

    async def run() -> list[tuple[int, Point]]:
        found: list[tuple[int, Point]] = []
        async for indices, points in in_order(pool, QUESTION, at, range(total), Clock(total)):
            found += zip(indices, points, strict=True)
        return found

    return asyncio.run(run())


def assert_all_there(found: list[tuple[int, Point]], total: int, lost: dict[int, str] | None = None) -> None:
    lost = lost or {}
    assert [index for index, _ in found] == list(range(total))
    for index, point in found:
        if index in lost:
            assert point.status == "failed"
            assert point.out == [None]
            assert point.error is not None
            assert point.error["code"] == lost[index]
        else:
            assert point.out == [float(index)]


@pytest.mark.parametrize("slots", [1, 2, 7])
@pytest.mark.parametrize("most", [1, 3, 1000])
@pytest.mark.parametrize("total", [1, 2, 100])
def test_in_order(slots: int, most: int, total: int) -> None:
    assert_all_there(solved(ScriptedPool(slots, most=most), total), total)


@pytest.mark.parametrize(("seconds", "size"), [(0.001, 250), (0.1, 2), (1.0, 1), (0.0, 1000)])
def test_chunks_take_about_their_time(seconds: float, size: int) -> None:
    pool = ScriptedPool(seconds=seconds)
    solved(pool, 10_000 if seconds < 0.01 else 200)
    assert max(map(len, pool.calls)) == size
    assert size * seconds <= max(pool.chunk_s, seconds)


def test_all_processes_finish_together() -> None:
    pool = ScriptedPool(seconds=0.001)
    solved(pool, 2000)
    assert [len(call) for call in pool.calls[-4:]] == [1] * 4


def test_no_more_is_begun_than_the_processes_need() -> None:
    pool = ScriptedPool(slots=3, holds=[0])

    async def run() -> None:
        points = in_order(pool, QUESTION, at, range(1000), Clock(1000))
        with pytest.raises(TimeoutError):
            async with asyncio.timeout(0.05), aclosing(points):
                await anext(points)

    asyncio.run(run())
    assert len(pool.calls) == 3 * pool.ahead


@pytest.mark.parametrize("place", [0, 5, 99])
def test_a_lost_process_costs_its_chunk_a_second_try(place: int) -> None:
    pool = ScriptedPool(faults={place: [WorkerLost()]})
    assert_all_there(solved(pool, 100), 100)
    assert [place] in pool.calls[1:]


def test_a_point_that_kills_every_process_fails_alone() -> None:
    pool = ScriptedPool(seconds=0.01, faults={50: [WorkerLost(), WorkerLost(), WorkerLost()]})
    assert_all_there(solved(pool, 100), 100, {50: "worker_lost"})


def test_a_point_that_hangs_in_company_fails_alone() -> None:
    pool = ScriptedPool(seconds=0.01, faults={50: [DeadlineExceeded(), DeadlineExceeded()]})
    assert_all_there(solved(pool, 100), 100, {50: "deadline_exceeded"})


def test_a_point_that_hangs_alone_gets_no_second_chance() -> None:
    pool = ScriptedPool(seconds=1.0, faults={3: [DeadlineExceeded()]})
    assert_all_there(solved(pool, 5), 5, {3: "deadline_exceeded"})
    assert sum(3 in call for call in pool.calls) == 1


def test_a_lost_pool_ends_everything() -> None:
    with pytest.raises(PoolLost):
        solved(ScriptedPool(faults={20: [PoolLost("gone")]}), 100)


def test_leaving_takes_back_what_has_not_begun() -> None:
    pool = ScriptedPool(slots=2, holds=range(3, 1000))

    async def run() -> None:
        async with aclosing(in_order(pool, QUESTION, at, range(1000), Clock(1000))) as points:
            assert (await anext(points))[0] == range(1)
            assert (await anext(points))[0] == range(1, 2)

    asyncio.run(run())
    assert all(future.done() for future in pool.futures)
    assert sum(future.cancelled() for future in pool.futures) == len(pool.futures) - 3


def test_cancelling_while_waiting_takes_everything_back() -> None:
    pool = ScriptedPool(slots=2, holds=range(1000))

    async def run() -> None:
        points = in_order(pool, QUESTION, at, range(1000), Clock(1000))
        waiting = asyncio.ensure_future(anext(points, None))
        await asyncio.sleep(0)
        waiting.cancel()
        await asyncio.wait({waiting})

    asyncio.run(run())
    assert len(pool.futures) == 4
    assert all(future.cancelled() for future in pool.futures)
