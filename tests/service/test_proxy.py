"""The service works behind the reverse proxy that deploy/ configures, and attacks end at this proxy."""

import json
import shutil
import socket
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, suppress
from statistics import median
from urllib.parse import urlsplit

import httpx
import pytest

from app.examples import examples
from tests.rexs.units import turbo_unit
from tests.support.proxy import running_proxy
from tests.support.server import Server, answer_to, faulty_server, memory_mb
from tests.support.studies import study_of

pytestmark = [
    pytest.mark.service,
    pytest.mark.ci,
    pytest.mark.skipif(shutil.which("nginx") is None, reason="nginx is not installed"),
]

COUPLING = examples()["pahl-axial-displacement"]


@pytest.fixture(scope="module")
def service() -> Iterator[Server]:
    with faulty_server(workers=2) as server:
        yield server


@pytest.fixture(scope="module")
def proxy(address: str, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Yield the address of nginx in front of the service. nginx waits only 1 s, not 10 s, for headers and bodies."""
    with running_proxy(tmp_path_factory.mktemp("nginx"), address, **{"timeout 10s": "timeout 1s"}) as outside:
        yield outside


def attacking(address: str) -> socket.socket:
    """Connect from 127.0.0.3, so that nginx limits these requests separately from those of other clients."""
    target = urlsplit(address)
    return socket.create_connection((target.hostname, target.port), timeout=4, source_address=("127.0.0.3", 0))


def received(address: str, *sent: bytes, pause_s: float = 0.0) -> bytes:
    """Send the bytes `sent` and nothing after them, and return the answer."""
    with attacking(address) as connection, suppress(OSError):
        for each in sent:
            connection.sendall(each)
            time.sleep(pause_s)
        return answer_to(connection)
    return b""


def test_calculations_and_pages_pass(proxy: str) -> None:
    answer = httpx.post(proxy + COUPLING.endpoint, json=COUPLING.request, timeout=20)
    assert answer.status_code == 200
    assert httpx.get(f"{proxy}/coupling", timeout=20).status_code == 200
    assert httpx.get(f"{proxy}/metrics", timeout=20).status_code == 403


def test_lines_of_a_study_pass_one_by_one(proxy: str) -> None:
    body = study_of(COUPLING.name, vary=[{"path": "operation.speed_rpm", "start": 100, "stop": 2000, "count": 200}])
    with httpx.stream("POST", f"{proxy}/v1/sweep", json=body, timeout=60) as response:
        kinds = [json.loads(line)["type"] for line in response.iter_lines()]
    assert kinds[0] == "sweep"
    assert kinds[-1] == "end"
    assert kinds.count("point") == 200


def test_a_file_of_a_gear_unit_passes(proxy: str) -> None:
    unit = turbo_unit().xml() + b" " * 2**20
    answer = httpx.post(f"{proxy}/v1/rexs", content=unit, headers={"Content-Type": "application/xml"}, timeout=20)
    assert answer.status_code == 200


HEAD = b"POST /v1/coupling HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
SLEEP = b"POST /sleep/2 HTTP/1.1\r\nHost: x\r\nContent-Length: 0\r\n"
HEALTH = b"GET /healthz HTTP/1.1\r\nHost: x\r\n"
LAST = b"Connection: close\r\n\r\n"


def test_attacks_end_at_the_proxy(proxy: str) -> None:
    assert received(proxy, HEAD + b"Content-Length: 99\r\n\r\n{").partition(b" ")[2][:3] in {b"", b"408"}
    for ending in (b"\r\n", LAST):
        assert b" 413 " in received(proxy, HEAD + b"Content-Length: 99999999\r\n" + ending)
    assert b" 400 " in received(proxy, HEAD + b"X-Padding: " + b"x" * 20_000 + b"\r\n\r\n")
    assert b" 400 " in received(proxy, HEALTH + b"Host: y\r\n\r\n")


def test_a_late_byte_and_a_late_end_cost_no_answer(proxy: str) -> None:
    assert b" 200 " in received(proxy, SLEEP + b"\r\n", b"\r\n", pause_s=0.5)
    late = received(proxy, HEALTH + b"\r\n" + HEAD + LAST.replace(b"\r\n\r\n", b"\r\nContent-Length: 2\r\n\r\n{"), b"}")
    assert late.count(b"HTTP/1.1 200") == late.count(b"HTTP/1.1 422") == 1


def test_floods_reach_nobody_else(service: Server, proxy: str) -> None:
    """Two floods neither delay another client nor fill the memory of the service."""
    # One flood sends bodies in chunks of one byte, the other pipelines requests whose answers nobody reads.
    process, direct = service
    httpx.get(f"{direct}/openapi.json", timeout=20)  # the first one takes a second
    before = memory_mb(process.pid)
    chunked = (
        HEAD.replace(b"/v1/coupling", b"/v1/rexs") + b"Transfer-Encoding: chunked\r\n\r\n" + b"1\r\n \r\n" * 400_000
    )
    documents = b"GET /openapi.json HTTP/1.1\r\nHost: x\r\n\r\n" * 15
    waits = []
    with ExitStack() as stack:
        for _ in range(100):
            stack.enter_context(attacking(proxy)).sendall(documents)
        floods = [threading.Thread(target=received, args=(proxy, chunked)) for _ in range(20)]
        for each in floods:
            each.start()
        with httpx.Client(base_url=proxy, timeout=20, transport=httpx.HTTPTransport(local_address="127.0.0.2")) as own:
            while any(each.is_alive() for each in floods):
                started = time.monotonic()
                assert own.get("/healthz").status_code == 200
                waits.append(time.monotonic() - started)
                time.sleep(0.1)
        assert median(waits) < 0.5
        assert memory_mb(process.pid) < before + 40


def test_one_client_gets_no_more_than_its_rate(proxy: str) -> None:
    with httpx.Client(base_url=proxy, timeout=20) as client:
        statuses = {client.get("/healthz").status_code for _ in range(200)}
    assert statuses == {200, 429}
