"""Which call gets the next worker, and which one is interrupted for another; two workers."""

import asyncio
from collections.abc import Callable

from app.workers.pool import Job, Shares


def with_shares(check: Callable[[Shares], None]) -> None:
    """Two workers whose calls of kind "short" have taken 0.01 s and of kind "long" 5 s."""

    async def run() -> None:
        shares = Shares(2, 64)
        for kind, seconds in (("short", 0.01), ("long", 5.0)):
            job = begun(shares, kind, "before", -10.0)
            shares.remove(job, -10.0 + seconds, finished=True)
        check(shares)

    asyncio.run(run())


def waiting(shares: Shares, kind: str, owner: str, now: float) -> Job:
    job = Job(owner, kind, 30.0)
    shares.add(job, now)
    return job


def begun(shares: Shares, kind: str, owner: str, now: float) -> Job:
    job = waiting(shares, kind, owner, now)
    assert shares.next(now) is job
    return job


def test_the_youngest_call_is_interrupted_after_a_second_and_once_only() -> None:
    def check(shares: Shares) -> None:
        older, younger = begun(shares, "long", "greedy", 0.0), begun(shares, "long", "greedy", 0.5)
        waiting(shares, "short", "honest", 1.0)
        assert shares.to_interrupt(1.9) is None
        assert shares.to_interrupt(2.0) is younger
        younger.interrupted = older.interrupted = object()  # type: ignore[assignment]  # any worker
        assert shares.to_interrupt(3.0) is None

    with_shares(check)


def test_nobody_is_interrupted_who_holds_no_more_than_a_share() -> None:
    def check(shares: Shares) -> None:
        begun(shares, "long", "one", 0.0)
        begun(shares, "long", "another", 0.0)
        waiting(shares, "long", "one", 0.0)
        assert shares.to_interrupt(10.0) is None

    with_shares(check)


def test_the_worker_that_was_freed_is_kept_for_short_calls_while_they_come() -> None:
    def check(shares: Shares) -> None:
        begun(shares, "long", "greedy", 0.0)
        ended = begun(shares, "long", "greedy", 0.0)
        first = waiting(shares, "short", "honest", 0.0)
        assert shares.to_interrupt(1.0) is not None
        shares.remove(ended, 1.0, finished=False)
        assert shares.next(1.0) is first
        long = waiting(shares, "long", "greedy", 1.0)
        shares.remove(first, 1.01, finished=True)
        assert shares.next(1.1) is None
        second = waiting(shares, "short", "honest", 2.5)
        assert shares.next(2.5) is second  # and two seconds more from now
        shares.remove(second, 2.51, finished=True)
        assert shares.next(4.4) is None
        assert shares.next(4.6) is long

    with_shares(check)


def test_the_next_worker_goes_to_whoever_has_fewest() -> None:
    def check(shares: Shares) -> None:
        begun(shares, "long", "greedy", 0.0)
        waiting(shares, "long", "greedy", 0.1)
        assert shares.next(0.3) is not None
        waiting(shares, "long", "greedy", 0.2)
        late = waiting(shares, "long", "honest", 0.3)
        assert shares.next(0.4) is late

    with_shares(check)
