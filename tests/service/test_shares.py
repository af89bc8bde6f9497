"""Clients and studies share the workers fairly: a call is answered, no matter what other clients do."""

import json
import threading
import time
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from typing import Any

import httpx
import pytest

from app.examples import examples
from tests.support.server import (
    HANGING,
    LONG,
    LONG_S,
    NAP,
    Server,
    faulty_server,
    meanwhile,
    metric,
    wait_for_metric,
    wait_until,
    workers,
)
from tests.support.studies import study_of

pytestmark = pytest.mark.service

COUPLING = examples()["pahl-axial-displacement"]
SUMMARY = {**COUPLING.request, "detail": "summary"}
FAIR_S = 5.0
"""Time [s] within which nearly every short call is answered while other clients calculate.

The short call may have to wait for the rest of a call of one second, on a busy machine.
"""
HONEST, GREEDY = "127.0.0.2", "127.0.0.3"


@pytest.fixture(scope="module")
def service() -> Iterator[Server]:
    with faulty_server(workers=2, deadline_s=40) as server:
        yield server


def client(address: str, source: str) -> httpx.Client:
    """Return an HTTP client that sends from the address `source`."""
    return httpx.Client(base_url=address, timeout=60, transport=httpx.HTTPTransport(local_address=source))


def honest_waits(address: str, count: int, pause_s: float = 0.05) -> list[float]:
    """Send `count` coupling requests as another client, and return the sorted times until their answers [s].

    Every request must be answered with a result. The requests ask for summaries.
    """
    waits = []
    with client(address, HONEST) as own:
        for _ in range(count):
            started = time.monotonic()
            answer = own.post(COUPLING.endpoint, json=SUMMARY)
            assert answer.status_code == 200, answer.text
            waits.append(time.monotonic() - started)
            time.sleep(pause_s)
    return sorted(waits)


def test_beside_80_long_calculations_of_another_client(address: str) -> None:
    statuses: list[int] = []

    def ask(own: httpx.Client) -> None:
        with suppress(httpx.TransportError):
            statuses.append(own.post("/sleep/1").status_code)

    with ExitStack() as stack:
        many = [stack.enter_context(client(address, GREEDY)) for _ in range(80)]
        stack.enter_context(meanwhile(*(partial(ask, own) for own in many)))
        wait_for_metric(address, "tribodrive_calculations_waiting", 64)
        waits = honest_waits(address, 15)
    assert waits[13] < FAIR_S
    assert set(statuses) <= {200, 503, 504}
    assert statuses.count(200) > 0
    assert metric(address, "tribodrive_calculations_refused_total") > 0


def test_every_owner_beside_others_in_a_closed_loop_advances(address: str) -> None:
    """Four clients and a sweep share two workers, and each of the five gets more than half of its fair share."""
    # The fair share is 4 s of computing time in 10 s.
    seconds, work_s = 10.0, 0.2
    counts: Counter[str] = Counter()
    end = time.monotonic() + seconds
    sources = [f"127.0.0.{number}" for number in range(2, 6)]

    def ask(source: str) -> None:
        with client(address, source) as own:
            while time.monotonic() < end:
                assert own.post(f"/sleep/{work_s}").status_code == 200
                counts[source] += 1

    def sweep() -> None:
        with client(address, "127.0.0.6") as own, own.stream("POST", "/v1/sweep", json=sleeps(400)) as response:
            for line in response.iter_lines():
                counts["sweep"] += json.loads(line)["type"] == "point"
                if time.monotonic() > end:
                    return

    with ThreadPoolExecutor(5) as pool:
        flights = [pool.submit(sweep), *(pool.submit(ask, source) for source in sources)]
        for flight in flights:
            flight.result()
    share = 2 * seconds / 5 / work_s
    assert min(counts[source] for source in sources) > share / 2, counts
    assert counts["sweep"] > share / 2, counts


def sleeps(count: int) -> dict[str, Any]:
    """Return a study of `count` points. Each of the points takes as long as a calculation of the clients."""
    return study_of(COUPLING.name, cases=[{"operation.speed_rpm": NAP}] * count)


def long_study(count: int) -> dict[str, Any]:
    return study_of(COUPLING.name, cases=[{"operation.speed_rpm": LONG}] * count)


@contextmanager
def running_studies(address: str, count: int) -> Iterator[None]:
    with ThreadPoolExecutor(count) as pool:
        done = threading.Event()

        def read() -> None:
            with (
                client(address, GREEDY) as own,
                own.stream("POST", "/v1/sweep", json=long_study(400)) as response,
            ):
                for line in response.iter_lines():
                    if done.is_set():
                        return
                    assert json.loads(line)["type"] != "error"

        flights = [pool.submit(read) for _ in range(count)]
        wait_for_metric(address, "tribodrive_studies", count)
        try:
            yield
        finally:
            done.set()
            for flight in flights:
                flight.result()


def test_beside_two_studies_of_long_points(address: str) -> None:
    with running_studies(address, 2):
        time.sleep(1.0)
        waits = honest_waits(address, 10)
    assert waits[-1] < LONG_S + FAIR_S


def test_points_of_a_study_end_with_it(service: Server) -> None:
    """The workers hang at points of the study, and are replaced after the client has left."""
    # A worker whose point ends is not replaced.
    process, address = service
    wait_until(lambda: len(set(workers(process))) == 2)
    before = set(workers(process))
    speeds = [1910.0] * 2 + [HANGING] * 4
    study = study_of(COUPLING.name, cases=[{"operation.speed_rpm": speed} for speed in speeds])
    with client(address, GREEDY) as own, own.stream("POST", "/v1/sweep", json=study) as response:
        lines = response.iter_lines()  # kept: the connection closes with the iterator
        next(line for line in lines if json.loads(line)["type"] == "point")
        time.sleep(1.0)  # until both workers hang
    wait_until(lambda: not set(workers(process)) & before)
    wait_for_metric(address, "tribodrive_studies", 0)


@pytest.fixture(scope="module")
def one_worker() -> Iterator[str]:
    """Yield the address of a service with one worker and three places in its queue."""
    # The header `X-User` may name the client of a request.
    with faulty_server(workers=1, queue=3, deadline_s=4, client_header="X-User") as (_, address):
        yield address


@pytest.mark.parametrize("named", [False, True])
def test_a_full_queue_refuses_whoever_has_most_places(one_worker: str, named: bool) -> None:
    """Clients are distinguished by their addresses, or by a header if all of them come from the address of a proxy."""
    refused = metric(one_worker, "tribodrive_calculations_refused_total")
    names = [{"X-User": "greedy"}, {"X-User": "honest"}] if named else [{}, {}]
    with (
        ThreadPoolExecutor(4) as pool,
        client(one_worker, GREEDY) as greedy,
        client(one_worker, GREEDY if named else HONEST) as honest,
    ):
        many = [pool.submit(greedy.post, "/sleep/0.8", headers=names[0]) for _ in range(4)]
        wait_for_metric(one_worker, "tribodrive_calculations_waiting", 3)
        assert greedy.post("/sleep/0.01", headers=names[0]).status_code == 503
        assert honest.post("/sleep/0.01", headers=names[1]).status_code == 200
        assert {each.result().status_code for each in many} == {200}
    assert metric(one_worker, "tribodrive_calculations_refused_total") == refused + 1
