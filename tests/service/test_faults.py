"""Faults of workers and clients (deaths, stops, disconnects, deadlines, full queues) cost only their own request."""

import os
import random
import signal
import subprocess
import time
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager

import httpx
import pytest

from app.examples import examples
from tests.support.server import (
    PATIENCE_S,
    Server,
    descendants,
    descriptors,
    faulty_server,
    is_alive,
    meanwhile,
    memory_mb,
    metric,
    running_server,
    send_signal,
    wait_for_metric,
    wait_until,
    wait_until_gone,
    workers,
)

pytestmark = [pytest.mark.service, pytest.mark.ci]

KILLS = 8
KILL_EVERY_S = 2.0
DEADLINE_S = 30.0  # a worker starts within it on busy cores too
RUNNING = "tribodrive_calculations"
LOST = "tribodrive_workers_lost_total"


@pytest.fixture(scope="module")
def service() -> Iterator[Server]:
    with faulty_server(workers=2, queue=2, deadline_s=DEADLINE_S, worker_memory_mb=1024) as server:
        yield server


def assert_recovers(address: str, seconds: float = PATIENCE_S) -> None:
    """Wait until no calculation runs or waits and the service answers a new calculation."""

    def recovered() -> bool:
        idle = metric(address, RUNNING) == 0
        return idle and httpx.post(f"{address}/sleep/0", timeout=20).status_code == 200

    wait_until(recovered, seconds)


def test_killed_workers_cost_only_their_own_requests() -> None:
    with running_server(workers=2, log_level="error") as (process, address):
        outcomes = outcomes_while_killing(process, address)
        assert outcomes["right"] > 0
        assert set(outcomes) <= {"right", "worker_lost"}
        assert outcomes["worker_lost"] <= KILLS
        assert httpx.get(f"{address}/readyz", timeout=30).is_success


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_stop_of_the_whole_group_lets_calls_in_flight_end(number: signal.Signals) -> None:
    """systemd and Ctrl-C signal every process of the service; the workers leave their end to the service."""
    with faulty_server(workers=1) as (process, address), ThreadPoolExecutor() as clients:
        call = clients.submit(httpx.post, f"{address}/sleep/3", timeout=PATIENCE_S)
        wait_for_metric(address, RUNNING, 1)
        children = descendants(process.pid)
        os.killpg(process.pid, number)
        assert call.result().status_code == 200
        process.wait(PATIENCE_S)
        wait_until_gone(children)


def outcomes_while_killing(process: subprocess.Popen[str], address: str) -> Counter[str]:
    """Kill workers while clients send requests, and count the answers by outcome."""
    # The outcome is `right` or `wrong`, or the code of the problem if the answer is a problem.
    cases = [example for _, example in sorted(examples().items()) if example.endpoint.startswith("/v1/coupling")]
    references = {
        case.name: httpx.post(address + case.endpoint, json=case.request, timeout=30).content for case in cases
    }
    outcomes: Counter[str] = Counter()

    def load() -> None:
        case = random.choice(cases)
        response = client.post(case.endpoint, json=case.request)
        if response.status_code == 200:
            outcomes["right" if response.content == references[case.name] else "wrong"] += 1
        else:
            outcomes[response.json()["type"].rsplit(":", 1)[1]] += 1

    with httpx.Client(base_url=address, timeout=60) as client, meanwhile(load, load, load):
        for _ in range(KILLS):
            time.sleep(KILL_EVERY_S)
            alive = workers(process)
            if alive:
                send_signal(random.choice(alive), signal.SIGKILL)
    return outcomes


def test_deadline(address: str) -> None:
    started = time.monotonic()
    response = httpx.post(f"{address}/sleep/60", timeout=90)
    assert response.status_code == 504
    assert time.monotonic() - started > DEADLINE_S - 0.1
    assert_recovers(address)


def test_a_client_that_leaves_ends_its_calculation(address: str) -> None:
    with pytest.raises(httpx.ReadTimeout):
        httpx.post(f"{address}/sleep/600", timeout=0.5)
    wait_until(lambda: metric(address, RUNNING) == 0)
    assert_recovers(address)


def test_memory_bomb(address: str) -> None:
    response = httpx.post(f"{address}/allocate/4096", timeout=20)
    assert response.status_code == 503
    assert response.json()["type"].endswith("memory_limit")
    assert_recovers(address)


def test_full_queue_and_recovery(address: str) -> None:
    with ThreadPoolExecutor(8) as pool:
        responses = list(pool.map(lambda _: httpx.post(f"{address}/sleep/1.5", timeout=20), range(8)))
    refused = [response for response in responses if response.status_code == 503]
    assert len(refused) == 4  # two in the workers, two in the queue
    assert all(response.headers["retry-after"] for response in refused)
    assert sum(response.status_code == 200 for response in responses) == 4
    assert_recovers(address)


def test_health_while_all_workers_are_busy(address: str) -> None:
    with ThreadPoolExecutor(2) as pool, httpx.Client(base_url=address, timeout=PATIENCE_S) as client:
        busy = [pool.submit(httpx.post, f"{address}/sleep/3", timeout=20) for _ in range(2)]
        answered = 0
        while not all(each.done() for each in busy):
            assert client.get("/healthz").status_code == 200
            answered += 1
    assert answered > 20  # two or three if each waits for a worker
    assert_recovers(address)


def test_killed_workers_are_replaced(service: Server) -> None:
    process, address = service
    before = set(workers(process))
    for worker in before:
        send_signal(worker, signal.SIGKILL)
    wait_until(lambda: len(set(workers(process)) - before) == len(before))
    assert all(not is_alive(worker) for worker in before)
    assert_recovers(address)


def test_a_client_that_leaves_a_short_calculation_costs_no_worker(service: Server) -> None:
    process, address = service
    assert_recovers(address)
    before = workers(process)
    with pytest.raises(httpx.ReadTimeout):
        httpx.post(f"{address}/sleep/0.5", timeout=0.2)
    assert_recovers(address)
    assert workers(process) == before


def test_a_killed_idle_worker_harms_nobody(service: Server) -> None:
    process, address = service
    assert_recovers(address)
    lost = metric(address, LOST)
    for _ in range(3):
        wait_until(lambda: len(workers(process)) == 2)
        for worker in workers(process):
            send_signal(worker, signal.SIGKILL)
            wait_until_gone([worker])
        time.sleep(0.1)
        assert httpx.post(f"{address}/sleep/0", timeout=60).status_code == 200
    assert metric(address, LOST) == lost


def test_a_worker_that_crashes_costs_its_own_call_alone(address: str) -> None:
    with ThreadPoolExecutor(2) as pool:
        other = pool.submit(httpx.post, f"{address}/sleep/3", timeout=60)
        wait_for_metric(address, RUNNING, 1)
        crash = httpx.post(f"{address}/crash", timeout=60)
        assert crash.status_code == 503
        assert crash.json()["type"].endswith("worker_lost")
        assert other.result().status_code == 200
    assert_recovers(address)


def test_a_stopped_worker_costs_one_call_its_deadline_and_is_replaced(service: Server) -> None:
    process, address = service
    assert_recovers(address)
    wait_until(lambda: len(workers(process)) == 2)
    before = set(workers(process))
    with ThreadPoolExecutor(2) as pool:
        flights = [pool.submit(httpx.post, f"{address}/sleep/2", timeout=60) for _ in range(2)]
        wait_for_metric(address, RUNNING, 2)
        stopped = min(before)
        send_signal(stopped, signal.SIGSTOP)
        assert sorted(flight.result().status_code for flight in flights) == [200, 504]
    wait_until(lambda: not is_alive(stopped))
    assert before - {stopped} <= set(workers(process))
    assert_recovers(address)


def test_a_storm_of_disconnects_leaves_nothing_behind(service: Server) -> None:
    process, address = service
    assert_recovers(address)
    before = len(descendants(process.pid)), descriptors(process.pid), memory_mb(process.pid)
    answered = 0

    def leave() -> None:
        with pytest.raises(httpx.ReadTimeout):
            httpx.post(f"{address}/sleep/5", timeout=httpx.Timeout(5, read=0.1))

    other = httpx.HTTPTransport(local_address="127.0.0.2")
    with meanwhile(leave), httpx.Client(base_url=address, timeout=60, transport=other) as client:
        end = time.monotonic() + 20
        while time.monotonic() < end:
            assert client.post("/sleep/0.01").status_code == 200
            answered += 1
    assert answered > 3  # a worker starts again after each client that left
    assert_recovers(address)
    wait_until(lambda: len(descendants(process.pid)) <= before[0])
    wait_until(lambda: descriptors(process.pid) <= before[1] + 2)
    assert memory_mb(process.pid) < before[2] + 20


@contextmanager
def calculating(path: str, **settings: int) -> Iterator[tuple[subprocess.Popen[str], Future[httpx.Response]]]:
    """Start a service and one calculation; yield the service's process and the future of the answer."""
    with faulty_server(**settings) as (process, address), ThreadPoolExecutor(1) as pool:
        flight = pool.submit(httpx.post, address + path, timeout=60)
        wait_for_metric(address, RUNNING, 1)
        yield process, flight


def test_death_of_the_service_takes_everything_along() -> None:
    with calculating("/spin/60", workers=2) as (process, flight):
        family = descendants(process.pid)
        assert len(family) >= 2
        process.kill()
        with pytest.raises(httpx.TransportError):
            flight.result()
        wait_until_gone(family)


def test_a_second_interrupt_does_not_wait_for_a_calculation() -> None:
    with calculating("/spin/600", workers=2) as (process, flight):
        family = descendants(process.pid)
        process.send_signal(signal.SIGINT)
        time.sleep(0.5)
        assert process.poll() is None
        process.send_signal(signal.SIGINT)
        process.wait(20)
        wait_until_gone(family)
        assert flight.exception() is not None or flight.result().status_code == 503


def test_a_calculation_that_outlasts_the_shutdown_is_answered_that_the_service_stops() -> None:
    with calculating("/spin/600", workers=1, shutdown_s=1) as (process, flight):
        process.send_signal(signal.SIGTERM)
        assert flight.result().status_code == 503
        assert flight.result().json()["type"].endswith("shutting_down")
        process.wait(20)


def test_shutdown_finishes_what_is_in_flight() -> None:
    with calculating("/sleep/2", workers=1) as (process, flight):
        process.send_signal(signal.SIGTERM)
        assert flight.result().status_code == 200
        assert process.wait(20) in {0, -signal.SIGTERM}
