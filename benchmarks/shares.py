"""What clients get beside each other, and what fair shares cost a client that is alone.

An honest client posts coupling summaries beside 80 parallel long calculations of another client, beside two studies of
long points, and beside three clients that leave; and once to a service that hands out its workers first come, first
served. Then a lone client asks either service in turn. Run from the project's root: python -m benchmarks.shares
"""

import argparse
import itertools
import os
import statistics
import sys
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from typing import Any
from unittest.mock import patch

import httpx
from fastapi import FastAPI

from app.command import serve
from app.errors import QueueFull
from app.examples import examples
from app.main import create_app
from app.workers import pool
from app.workers.pool import Job, Shares
from tests.support.server import running_server

WORKERS = 2
SUMMARY = {**examples()["pahl-axial-displacement"].request, "detail": "summary"}
LONG = {**examples()["xue-pair-1-thermal"].request, "detail": "summary"}
LONG["model"] = {**LONG.get("model", {}), "path_points": 400}
CONTACT = examples()["xue-line-contact"]
STUDY = {"endpoint": "/v1/scuffing", "request": LONG, "cases": [{}] * 200}
HONEST, OTHER = "127.0.0.2", "127.0.0.3"


class FirstComeFirstServed(Shares):
    """One queue for all."""

    def admit(self, job: Job) -> None:
        """Refuse the newcomer where all places are taken."""
        if not job.of_study and len([each for each in (*self.running, *self.waiting) if not each.of_study]) >= 64:
            raise QueueFull

    def next(self, now: float) -> Job | None:
        """Whoever has waited longest."""
        if not self.waiting:
            return None
        job = self.waiting[0]
        self._queue.remove(job)
        self.running.append(job)
        job.since = now
        return job

    def to_interrupt(self, now: float) -> Job | None:
        """Nobody is interrupted."""
        del now
        return None


def __getattr__(name: str) -> FastAPI:
    """The service as it is ("fair") or without fair shares ("first_come"), made when uvicorn asks for it."""
    if name not in {"fair", "first_come"}:
        raise AttributeError(name)
    if name == "first_come":
        patch.object(pool, "Shares", FirstComeFirstServed).start()
    return create_app()


@contextmanager
def served(factory: str) -> Iterator[str]:
    """The address of a running service."""
    command = [sys.executable, "-m", "benchmarks.shares", "--serve", factory]
    with running_server(command, workers=WORKERS, log_level="error") as (_, address):
        yield address


def client(address: str, source: str) -> httpx.Client:
    """A client with an address of its own."""
    return httpx.Client(base_url=address, timeout=120, transport=httpx.HTTPTransport(local_address=source))


def calculate(address: str, done: threading.Event) -> None:
    """Long calculations, one after the other."""
    with client(address, OTHER) as own:
        while not done.is_set():
            with suppress(httpx.TransportError):
                own.post("/v1/scuffing", json=LONG)


def study(address: str, done: threading.Event) -> None:
    """A study of long points."""
    with client(address, OTHER) as own, own.stream("POST", "/v1/sweep", json=STUDY) as response:
        for _ in response.iter_lines():
            if done.is_set():
                return


def leave(address: str, done: threading.Event, seconds: float) -> None:
    """Long calculations for which nobody waits."""
    with client(address, OTHER) as own:
        while not done.is_set():
            with suppress(httpx.ReadTimeout):
                own.post("/v1/scuffing", json=LONG, timeout=httpx.Timeout(5, read=seconds))


Others = list[tuple[Callable[..., None], tuple[Any, ...]]]
BESIDE: dict[str, Others] = {
    "80 parallel long calculations": [(calculate, ())] * 80,
    "two studies of long points": [(study, ())] * 2,
    "three clients that leave after 0.1, 0.4, 1 s": [(leave, (seconds,)) for seconds in (0.1, 0.4, 1.0)],
}


def honest(address: str, seconds: float) -> tuple[Counter[int], list[float]]:
    """Statuses of an honest client's requests, and how long those took that were answered, in order [s]."""
    statuses: Counter[int] = Counter()
    waits = []
    end = time.monotonic() + seconds
    with client(address, HONEST) as own:
        while time.monotonic() < end:
            began = time.monotonic()
            status = own.post("/v1/coupling", json=SUMMARY).status_code
            statuses[status] += 1
            if status == httpx.codes.OK:
                waits.append(time.monotonic() - began)
            time.sleep(0.02)
    return statuses, sorted(waits)


def beside(address: str, others: Others, seconds: float) -> str:
    """A row's cells: answered of all, median, 95th percentile, longest."""
    done = threading.Event()
    threads = [threading.Thread(target=run, args=(address, done, *more)) for run, more in others]
    for each in threads:
        each.start()
    time.sleep(2.0)
    statuses, waits = honest(address, seconds)
    done.set()
    for each in threads:
        each.join()
    median, late = (waits[int(share * len(waits))] for share in (0.5, 0.95)) if waits else (float("nan"),) * 2
    worst = waits[-1] if waits else float("nan")
    return f"{statuses[200]} of {statuses.total()} | {median:.3f} s | {late:.2f} s | {worst:.2f} s"


def rate(address: str, mixed: bool, seconds: float) -> float:
    """Answers per second to a client that keeps eight requests open; mixed: every tenth is a line contact."""
    end = time.monotonic() + seconds

    def ask(first: int) -> int:
        with client(address, HONEST) as own:
            for number in itertools.count(first):
                if time.monotonic() > end:
                    return number - first
                contact = mixed and number % 10 == 0
                path, body = (CONTACT.endpoint, CONTACT.request) if contact else ("/v1/coupling", SUMMARY)
                own.post(path, json=body).raise_for_status()
        raise AssertionError

    with ThreadPoolExecutor(8) as threads:
        return sum(threads.map(ask, range(8))) / seconds


def main(seconds: float, rounds: int) -> None:
    """Measure and print the tables."""
    print(
        "| an honest client beside | service | answered | median | 95 % within | longest |\n|---|---|---|---|---|---|"
    )
    with served("fair") as fair_one, served("first_come") as first_come_one:
        for name, others in BESIDE.items():
            for kind, address in (("fair", fair_one), ("first come", first_come_one)):
                print(f"| {name} | {kind} | {beside(address, others, seconds)} |", flush=True)
                time.sleep(5.0)
        print(f"\n| a client alone, {rounds} rounds in turn | fair | first come | ratio |\n|---|---|---|---|")
        for mixed, name in ((False, "coupling summaries"), (True, "and a line contact in ten")):
            pairs = [(rate(fair_one, mixed, 2.0), rate(first_come_one, mixed, 2.0)) for _ in range(rounds)]
            ratio = statistics.median(with_shares / without for with_shares, without in pairs)
            one, other = (statistics.median(each) for each in zip(*pairs, strict=True))
            print(f"| {name} | {one:.0f}/s | {other:.0f}/s | {ratio:.3f} |", flush=True)
    print(f"\n{WORKERS} workers, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--serve", choices=["fair", "first_come"], help="serve instead of measuring")
    parser.add_argument("--seconds", type=float, default=20.0, help="of each load")
    parser.add_argument("--rounds", type=int, default=25, help="of two seconds for either service")
    arguments = parser.parse_args()
    if arguments.serve:
        serve(f"benchmarks.shares:{arguments.serve}")
    else:
        main(arguments.seconds, arguments.rounds)
