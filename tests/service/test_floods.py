"""The service limits headers, bodies and connections; slow and greedy clients are left to the reverse proxy."""

import http.client
import json
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, suppress
from statistics import median
from urllib.parse import urlsplit

import httpx
import pytest

from tests.support.server import (
    PATIENCE_S,
    Server,
    answer_to,
    connected,
    descriptors,
    faulty_server,
    meanwhile,
    memory_mb,
    wait_for_metric,
    wait_until,
)

pytestmark = pytest.mark.service

FLOOD = 30 * 2**20
RUNNING = "tribodrive_calculations"
PIECE = b"x" * 65536
JSON = {"Content-Type": "application/json"}


@pytest.fixture(scope="module")
def service() -> Iterator[Server]:
    with faulty_server(workers=2) as server:
        yield server


def flood(address: str, opening: bytes, piece: bytes) -> tuple[int, bytes]:
    """Send `opening`, then `piece` repeatedly, until the service takes no more or `FLOOD` bytes are sent.

    Return the number of bytes sent in pieces, and the answer.
    """
    sent = 0
    with connected(address) as connection:
        connection.sendall(opening)
        with suppress(OSError):
            while sent < FLOOD:
                connection.sendall(piece)
                sent += len(piece)
        return sent, answer_to(connection)


OPENINGS = {
    "one header without end": (b"GET /healthz HTTP/1.1\r\nHost: x\r\nX-Padding: ", PIECE),
    "headers without end": (b"GET /healthz HTTP/1.1\r\nHost: x\r\n", b"X-Padding: 1234567890\r\n" * 3000),
    "an address without end": (b"GET /", PIECE),
}


UPLOADS, UPLOAD_MB = 24, 19


@pytest.mark.ci
def test_uploads_that_wait_take_no_memory() -> None:
    """Twenty-four files of 19 MB wait for the only worker: they are on disk, and not once in memory."""
    body = b"<model><!--" + b"x" * (UPLOAD_MB * 10**6) + b"--></model>"
    headers = {"Content-Type": "application/xml"}
    with faulty_server(workers=1, queue=UPLOADS) as (process, address), ThreadPoolExecutor(UPLOADS + 1) as clients:
        before = memory_mb(process.pid)
        busy = clients.submit(httpx.post, f"{address}/sleep/20", timeout=60)
        wait_for_metric(address, RUNNING, 1)
        posts = [
            clients.submit(httpx.post, f"{address}/v1/rexs", content=body, headers=headers, timeout=60)
            for _ in range(UPLOADS)
        ]
        wait_for_metric(address, RUNNING, UPLOADS + 1)
        assert memory_mb(process.pid) < before + 3 * UPLOAD_MB
        assert busy.result().status_code == 200
        assert {post.result().status_code for post in posts} == {422}


@pytest.mark.parametrize("kind", OPENINGS)
def test_flood_is_cut_off_before_it_costs_memory(service: Server, kind: str) -> None:
    process, address = service
    before = memory_mb(process.pid)
    sent, answer = flood(address, *OPENINGS[kind])
    assert sent < FLOOD
    assert memory_mb(process.pid) < before + 10
    assert answer[:12] in {b"", b"HTTP/1.1 400"}  # a reset can overtake the answer
    assert httpx.get(f"{address}/healthz", timeout=2).status_code == 200


def test_many_unknown_fields_do_not_hold_up_the_others(address: str) -> None:
    body = json.dumps({f"k{number}": 0 for number in range(30_000)})
    waits, answers = [], []

    def load() -> None:
        answers.append(httpx.post(f"{address}/v1/coupling", content=body, headers=JSON, timeout=30))

    with meanwhile(load, load, load, load), httpx.Client(base_url=address, timeout=PATIENCE_S) as client:
        for _ in range(100):
            started = time.monotonic()
            assert client.get("/healthz").status_code == 200
            waits.append(time.monotonic() - started)
    assert {answer.status_code for answer in answers} == {422}
    assert answers[0].json()["errors"][0]["code"] == "too_many_fields"
    assert median(waits) < 0.5


@pytest.mark.parametrize("size", [2_000_000, 20_000_000])
def test_a_refusal_reaches_a_client_that_sends_on_and_closes(address: str, size: int) -> None:
    for body in (b" " * size, (b" " * 65536 for _ in range(size // 65536))):  # announced, and in chunks
        connection = http.client.HTTPConnection(urlsplit(address).netloc, timeout=10)
        connection.request("POST", "/v1/coupling", body, {**JSON, "Connection": "close"})
        assert connection.getresponse().status == 413
        connection.close()


def test_two_hosts_are_refused(address: str) -> None:
    with connected(address) as connection:
        connection.sendall(b"GET /healthz HTTP/1.1\r\nHost: x\r\nHost: y\r\n\r\n")
        assert answer_to(connection).startswith(b"HTTP/1.1 400")


def test_connections_beyond_the_limit_are_refused_in_plain_text_and_nothing_breaks() -> None:
    with faulty_server(workers=1, limit_concurrency=20) as (process, address), ExitStack() as stack:
        idle = descriptors(process.pid)
        for _ in range(30):
            stack.enter_context(connected(address)).sendall(b"GET /")
        refused = httpx.get(f"{address}/healthz", timeout=5)
        assert refused.status_code == 503
        assert refused.headers["content-type"].startswith("text/plain")
        stack.close()
        wait_until(lambda: descriptors(process.pid) <= idle + 2)
        for _ in range(20):
            assert httpx.get(f"{address}/readyz", timeout=5).status_code == 200
            assert httpx.post(f"{address}/v1/coupling", json={}, timeout=5).status_code == 422
