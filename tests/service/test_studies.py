"""Lost workers, full queues, and slow or leaving clients during a study do not affect other clients."""

import json
import os
import signal
import socket
import subprocess
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from typing import Any
from urllib.parse import urlsplit

import httpx
import pytest

from app.calculations import BY_PATH
from app.examples import examples
from app.schema.fields import leaves
from tests.support.browsing import address_of
from tests.support.server import (
    HANGING,
    PATIENCE_S,
    Server,
    descendants,
    descriptors,
    faulty_server,
    meanwhile,
    memory_mb,
    metric,
    send_signal,
    wait_for_metric,
    wait_until,
    workers,
)
from tests.support.studies import study_of

pytestmark = [pytest.mark.service, pytest.mark.ci]

SWEEP = "/v1/sweep"
SLOPE = "modifications.helix_slope_um"
COUPLING = examples()["pahl-axial-displacement"]
NUMBERS = [
    leaf.path
    for leaf in leaves(BY_PATH["/v1/coupling"].response)
    if leaf.kind == "number" and leaf.is_scalar and "." in leaf.path
]


@pytest.fixture(scope="module")
def service() -> Iterator[Server]:
    # The deadline is far longer than the start of a worker, for which a call may have to wait.
    with faulty_server(workers=2, queue=2, deadline_s=20, study_points=30_000) as server:
        yield server


def loads(count: int) -> dict[str, Any]:
    """Return a study of the load distribution with `count` points. A point takes a few milliseconds."""
    axis = {"path": SLOPE, "start": -20, "stop": 20, "count": count}
    return study_of("xue-pair-1-modified", vary=[axis], outputs=["pressure.max_mpa"])


def couplings(count: int, outputs: Sequence[str] = ("axial_thrust.force_n",)) -> dict[str, Any]:
    """Return a study of a coupling with `count` points. A point takes less than a millisecond."""
    axis = {"path": "operation.speed_rpm", "start": 100, "stop": 2000, "count": count}
    return study_of(COUPLING.name, vary=[axis], outputs=outputs)


def lines_of(address: str, body: object) -> list[dict[str, Any]]:
    response = httpx.post(address + SWEEP, json=body, timeout=120)
    assert response.status_code == 200, response.text
    return [json.loads(line) for line in response.text.splitlines()]


@contextmanager
def running_study(address: str, body: object) -> Iterator[Iterator[str]]:
    """Start a study, and yield its lines after its first point. The client leaves the study when the context ends."""
    with httpx.stream("POST", address + SWEEP, json=body, timeout=60) as response:
        found = response.iter_lines()
        while '"point"' not in next(found):
            pass
        yield found


def wait_until_free(address: str) -> None:
    """Wait until no study runs. The service must end a study that its client has left."""
    wait_for_metric(address, "tribodrive_studies", 0)


def processor_seconds(pids: list[int]) -> float:
    ticks = 0
    for pid in pids:
        with open(f"/proc/{pid}/stat") as file:  # noqa: PTH123
            ticks += sum(map(int, file.read().rpartition(")")[2].split()[11:13]))
    return ticks / os.sysconf("SC_CLK_TCK")


def numbers(lines: list[dict[str, Any]]) -> list[Any]:
    return [line for line in lines if line["type"] == "point"]


def test_same_lines_from_one_worker_and_from_two(address: str) -> None:
    two = numbers(lines_of(address, loads(60)))
    with faulty_server(workers=1) as (_, other):
        assert numbers(lines_of(other, loads(60))) == two


def test_a_killed_worker_costs_nothing_but_time(service: Server) -> None:
    process, address = service
    expected = numbers(lines_of(address, loads(200)))
    with ThreadPoolExecutor(1) as pool:
        flight = pool.submit(lines_of, address, loads(200))
        killed = 0
        while not flight.done() and killed < 4:
            time.sleep(0.2)
            for worker in workers(process)[:1]:
                send_signal(worker, signal.SIGKILL)
                killed += 1
        found = flight.result()
    assert killed >= 2
    assert numbers(found) == expected
    assert set(found[-1]["counts"]) <= {"ok", "ok_with_warnings"}


def test_a_stopped_worker_costs_at_most_the_point_that_it_solves(service: Server) -> None:
    process, address = service
    with ThreadPoolExecutor(1) as pool:
        flight = pool.submit(lines_of, address, loads(200))
        time.sleep(0.5)
        send_signal(workers(process)[0], signal.SIGSTOP)
        lines = flight.result()
    assert [line["index"] for line in numbers(lines)] == list(range(200))
    late = [line for line in numbers(lines) if line["status"] == "failed"]
    assert len(late) <= 1  # the stopped worker may have had a chunk of one point, whose deadline then passes
    assert {line["error"]["code"] for line in late} <= {"deadline_exceeded"}


def test_a_third_study_waits_outside(address: str) -> None:
    with running_study(address, loads(20_000)), running_study(address, loads(20_000)):
        refused = httpx.post(address + SWEEP, json=loads(2), timeout=PATIENCE_S)
        assert refused.status_code == 503
        assert refused.json()["type"].endswith("studies_full")
        assert int(refused.headers["retry-after"]) >= 1
        assert httpx.post(address + "/v1/coupling", json=COUPLING.request, timeout=20).status_code == 200
    wait_until_free(address)
    assert lines_of(address, loads(2))[-1]["type"] == "end"


def test_a_full_queue_refuses_a_study_before_its_first_line(address: str) -> None:
    with ThreadPoolExecutor(4) as pool:
        busy = [pool.submit(httpx.post, f"{address}/sleep/5", timeout=20) for _ in range(4)]
        wait_for_metric(address, "tribodrive_calculations_waiting", 2)
        refused = httpx.post(address + SWEEP, json=loads(2), timeout=PATIENCE_S)
        assert refused.status_code == 503
        assert refused.json()["type"].endswith("queue_full")
        assert {each.result().status_code for each in busy} <= {200, 504}
    assert metric(address, "tribodrive_studies") == 0


def test_single_requests_come_before_chunks(address: str) -> None:
    with httpx.Client(base_url=address, timeout=20) as client, running_study(address, loads(20_000)):
        waits = []
        for _ in range(20):
            started = time.perf_counter()
            assert client.post("/v1/coupling", json=COUPLING.request).status_code == 200
            waits.append(time.perf_counter() - started)
    assert median(waits) < 2.0  # the rest of one chunk, a quarter of a second on quiet cores
    wait_until_free(address)


def test_leaving_frees_the_workers_and_kills_none(service: Server) -> None:
    process, address = service
    lines_of(address, loads(2))
    family, lost = set(workers(process)), metric(address, "tribodrive_workers_lost_total")
    with running_study(address, loads(20_000)):
        pass
    wait_until_free(address)
    wait_until(lambda: calculated_within(process, 0.5) < 0.05)
    assert set(workers(process)) == family
    assert metric(address, "tribodrive_workers_lost_total") == lost


def test_a_hundred_cancelled_sweeps_leave_nothing_behind(service: Server) -> None:
    process, address = service
    body = loads(20_000)
    for _ in range(3):
        with running_study(address, body):
            pass
    wait_until_free(address)
    time.sleep(0.5)
    family = set(workers(process))
    before = len(descendants(process.pid)), descriptors(process.pid), memory_mb(process.pid)
    for _ in range(100):
        wait_until_free(address)
        with running_study(address, body):
            pass
    wait_until_free(address)
    assert set(workers(process)) == family
    wait_until(lambda: len(descendants(process.pid)) == before[0])
    wait_until(lambda: descriptors(process.pid) <= before[1] + 2)
    assert memory_mb(process.pid) < before[2] + 20


def test_a_hanging_point_fails_alone(service: Server) -> None:
    """The deadline ends the worker that hangs. The points before and after the hanging point are solved."""
    process, address = service
    cases = [{"operation.speed_rpm": speed} for speed in (100, HANGING, 200)]
    found = numbers(lines_of(address, study_of(COUPLING.name, cases=cases)))
    assert [point["status"] in {"ok", "ok_with_warnings"} for point in found] == [True, False, True]
    assert found[1]["error"]["code"] == "deadline_exceeded"
    assert len(workers(process)) == 2


def test_memory_is_flat_over_many_points_and_a_slow_reader_slows_only_his_own(service: Server) -> None:
    process, address = service
    lines_of(address, couplings(2000))
    before = memory_mb(process.pid)
    highest = []

    def watch() -> None:
        highest.append(memory_mb(process.pid))
        time.sleep(0.1)

    with meanwhile(watch), httpx.stream("POST", address + SWEEP, json=couplings(25_000), timeout=60) as response:
        count = sum('"point"' in line for line in response.iter_lines())
    assert count == 25_000
    assert max(highest) < before + 25


def test_nobody_calculates_what_nobody_reads(service: Server) -> None:
    process, address = service
    target = urlsplit(address)
    content = json.dumps(couplings(30_000, NUMBERS)).encode()
    head = f"POST {SWEEP} HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
    with socket.socket() as connection:
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        connection.connect((target.hostname, target.port))
        connection.sendall(f"{head}Content-Length: {len(content)}\r\n\r\n".encode() + content)
        time.sleep(1)
        wait_until(lambda: calculated_within(process, 0.5) < 0.05, 120)
        assert metric(address, "tribodrive_studies") == 1
        assert lines_of(address, loads(4))[-1]["type"] == "end"  # others go on
        before = processor_seconds(workers(process))
        received = b""
        while b'"type":"end"' not in received:
            received = received[-20:] + connection.recv(2**20)
        assert processor_seconds(workers(process)) - before > 0.5  # the rest was calculated when it was read
    wait_until_free(address)


def calculated_within(process: subprocess.Popen[str], seconds: float) -> float:
    """Return the processor time that the workers use within the next `seconds` seconds [s]."""
    before = processor_seconds(workers(process))
    time.sleep(seconds)
    return processor_seconds(workers(process)) - before


def test_a_study_that_lost_its_connection_goes_on_from_where_it_was(address: str) -> None:
    sample = {"count": 256, "seed": 7, "ranges": [{"path": "operation.speed_rpm", "min": 100, "max": 2000}]}
    body = study_of(COUPLING.name, sample=sample, outputs=["axial_thrust.force_n"])
    whole = numbers(lines_of(address, body))
    with running_study(address, body) as found:
        seen = [whole[0], *(json.loads(next(found)) for _ in range(9))]
    assert seen == whole[:10]
    assert numbers(lines_of(address, body | {"from_index": 10})) == whole[10:]


@pytest.fixture(scope="module")
def short_of_time(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, Path]]:
    """Yield the address and the log of a service whose studies end after one second."""
    log = tmp_path_factory.mktemp("log") / "log"
    with faulty_server(workers=1, study_deadline_s=1, log=log) as (_, address):
        yield address, log


def test_the_deadline_of_a_study_ends_it_with_a_line(short_of_time: tuple[str, Path]) -> None:
    address, log = short_of_time
    *points, last = lines_of(address, loads(2500))
    assert last["type"] == "error"
    assert last["code"] == "study_deadline"
    assert last["done"] == len(numbers(points)) < 2500
    table = httpx.post(address + SWEEP + "?format=csv", json=loads(2500), timeout=60).text.splitlines()
    assert table[-1] == ",,error,,,study_deadline: the study took longer than 1 s; make the study smaller"
    assert metric(address, "tribodrive_studies_unfinished_total") == 2
    assert "Traceback" not in log.read_text("utf-8")


def curve(count: int) -> str:
    """Return the address of the figure that shows a study. The study has `count` points."""
    figure = address_of("xue-pair-1-modified", "/vary/figures/curve.svg")
    return f"{figure}&x={SLOPE}&x.count={count}&show=pressure.max_mpa"


def test_a_figure_of_a_study_that_ends_at_its_deadline_is_a_503(short_of_time: tuple[str, Path]) -> None:
    address, log = short_of_time
    answer = httpx.get(address + curve(2500), timeout=60)
    assert answer.status_code == 503
    assert answer.json()["type"].endswith("study_ended")
    assert "longer than 1 s" in answer.json()["detail"]
    assert metric(address, "tribodrive_studies") == 0
    assert "Traceback" not in log.read_text("utf-8")


def test_a_client_who_leaves_a_figure_frees_its_study(address: str) -> None:
    with pytest.raises(httpx.ReadTimeout):
        httpx.get(address + curve(20_000), timeout=1.0)
    wait_until_free(address)
