"""Limits where bytes arrive: headers, trailers, bodies, connections, time. Every flood is bounded in size."""

import http.client
import json
import socket
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, suppress
from statistics import median
from urllib.parse import urlsplit

import httpx
import pytest

from tests.support.server import (
    FAULTY,
    Server,
    answer_to,
    connected,
    descriptors,
    faulty_server,
    meanwhile,
    memory_mb,
    running_server,
    wait_for_metric,
    wait_until,
)

pytestmark = pytest.mark.service

FLOOD = 30 * 2**20
PIECE = b"x" * 65536
JSON = {"Content-Type": "application/json"}


@pytest.fixture(scope="module")
def service() -> Iterator[Server]:
    with faulty_server(workers=2, header_deadline_s=1.5, body_deadline_s=1.5) as server:
        yield server


def post_of(path: str, size: int = 0) -> bytes:
    head = f"POST {path} HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\nContent-Length: {size}\r\n\r\n"
    return head.encode()


def flood(address: str, opening: bytes, piece: bytes) -> tuple[int, bytes]:
    """Send until the service stops taking it: how much it took, what it answered."""
    sent = 0
    with connected(address) as connection:
        connection.sendall(opening)
        with suppress(OSError):
            while sent < FLOOD:
                connection.sendall(piece)
                sent += len(piece)
        return sent, answer_to(connection)


CHUNKED = (
    b"POST /v1/coupling HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\nTransfer-Encoding: chunked\r\n\r\n"
)
OPENINGS = {
    "one header without end": (b"GET /healthz HTTP/1.1\r\nHost: x\r\nX-Padding: ", PIECE),
    "headers without end": (b"GET /healthz HTTP/1.1\r\nHost: x\r\n", b"X-Padding: 1234567890\r\n" * 3000),
    "an address without end": (b"GET /", PIECE),
    "trailers without end": (CHUNKED + b"2\r\n{}\r\n0\r\n", b"X-Padding: 1234567890\r\n" * 3000),
    "a chunk size without end": (CHUNKED + b"2;extension=", PIECE),
}


@pytest.mark.parametrize("kind", OPENINGS)
def test_flood_is_cut_off_before_it_costs_memory(service: Server, kind: str) -> None:
    process, address = service
    before = memory_mb(process.pid)
    sent, answer = flood(address, *OPENINGS[kind])
    assert sent < FLOOD
    assert memory_mb(process.pid) < before + 10
    assert answer[:12] in {b"", b"HTTP/1.1 431", b"HTTP/1.1 400"}  # a reset can overtake the answer
    assert httpx.get(f"{address}/healthz", timeout=2).status_code == 200


def test_refusal_of_headers_is_a_problem_and_is_logged(address: str) -> None:
    with connected(address) as connection:
        connection.sendall(b"GET /healthz HTTP/1.1\r\nHost: x\r\nX-Padding: " + b"x" * 17_000 + b"\r\n\r\n")
        head, _, body = answer_to(connection).partition(b"\r\n\r\n")
    assert head.startswith(b"HTTP/1.1 431")
    assert b"x-content-type-options: nosniff" in head
    assert json.loads(body)["instance"].encode() in head
    assert 'endpoint="unparsed",status="431"' in httpx.get(f"{address}/metrics").text


def test_half_sent_headers_time_out(address: str) -> None:
    with connected(address) as silent, connected(address) as slow:
        slow.sendall(b"GET /healthz HTTP/1.1\r\nHost:")
        started = time.monotonic()
        assert answer_to(slow).startswith(b"HTTP/1.1 408")
        assert answer_to(silent) == b""
        assert 1.4 < time.monotonic() - started < 8.0  # 10 s by default


def read_health(connection: socket.socket) -> None:
    """The answer of /healthz, and no byte more."""
    received = b""
    while not received.endswith(b'{"status":"ok"}'):
        received += connection.recv(65536)
    assert received.startswith(b"HTTP/1.1 200")


def test_half_sent_second_request_times_out(address: str) -> None:
    with connected(address) as connection:
        connection.sendall(b"GET /healthz HTTP/1.1\r\nHost: x\r\n\r\n")
        read_health(connection)
        connection.sendall(b"GET /heal")
        assert answer_to(connection).startswith(b"HTTP/1.1 408")


def test_a_body_that_drips_times_out(address: str) -> None:
    with connected(address) as connection:
        connection.sendall(post_of("/v1/coupling", 99))
        started = time.monotonic()

        def drip() -> None:
            with suppress(OSError):
                for _ in range(40):
                    connection.sendall(b" ")
                    time.sleep(0.1)

        dripping = threading.Thread(target=drip)
        dripping.start()
        assert connection.recv(65536).startswith(b"HTTP/1.1 408")
        assert 1.4 < time.monotonic() - started < 8.0  # 10 s by default
        dripping.join()


def test_many_unknown_fields_do_not_hold_up_the_others(address: str) -> None:
    body = json.dumps({f"k{number}": 0 for number in range(30_000)})
    waits, answers = [], []

    def load() -> None:
        answers.append(httpx.post(f"{address}/v1/coupling", content=body, headers=JSON, timeout=30))

    with meanwhile(load, load, load, load), httpx.Client(base_url=address) as client:
        for _ in range(100):
            started = time.monotonic()
            assert client.get("/healthz").status_code == 200
            waits.append(time.monotonic() - started)
    assert {answer.status_code for answer in answers} == {422}
    assert answers[0].json()["errors"][0]["code"] == "too_many_fields"
    assert median(waits) < 0.5


def test_bodies_in_pieces_of_a_byte_do_not_hold_up_the_others(address: str) -> None:
    opening = CHUNKED.replace(b"/v1/coupling", b"/v1/rexs").replace(b"json", b"xml")
    answers, slowest = [], 0.0

    def load() -> None:
        with connected(address) as connection:
            with suppress(OSError):
                connection.sendall(opening + b"1\r\n \r\n" * 400_000)
            answers.append(answer_to(connection)[:12])

    loads = [threading.Thread(target=load) for _ in range(20)]
    with httpx.Client(base_url=address) as client:
        client.get("/healthz")
        for each in loads:
            each.start()
        while any(each.is_alive() for each in loads):
            started = time.monotonic()
            client.get("/healthz")
            slowest = max(slowest, time.monotonic() - started)
    assert set(answers) <= {b"HTTP/1.1 400", b""}  # a client that goes on sending may lose its answer to a reset
    assert slowest < 3.0  # 4 s on quiet cores if each piece is taken for itself


def test_pipelined_requests_are_bounded(service: Server) -> None:
    process, address = service
    before = memory_mb(process.pid)
    with connected(address) as connection:
        with suppress(OSError):
            connection.sendall(b"GET /healthz HTTP/1.1\r\nHost: x\r\n\r\n" * 20_000)
        answer_to(connection)
    assert memory_mb(process.pid) < before + 10
    assert httpx.get(f"{address}/healthz", timeout=2).status_code == 200


def test_pipelined_documents_that_nobody_reads_do_not_hold_up_a_newcomer(address: str) -> None:
    request = b"GET /openapi.json HTTP/1.1\r\nHost: x\r\nAccept-Encoding: gzip\r\n\r\n"
    httpx.get(f"{address}/openapi.json", timeout=20)  # the first one takes a second
    with ExitStack() as stack:
        for _ in range(100):
            stack.enter_context(connected(address)).sendall(request * 15)
        started = time.monotonic()
        assert httpx.get(f"{address}/healthz", timeout=60).status_code == 200
        assert time.monotonic() - started < 8.0  # 10 s on quiet cores if each is written anew


def test_bytes_behind_a_long_request_do_not_cost_its_answer(address: str) -> None:
    with connected(address) as connection:
        connection.sendall(post_of("/sleep/2.5"))
        wait_for_metric(address, "tribodrive_calculations", 1)
        connection.sendall(b"\r\n")
        assert connection.recv(65536).startswith(b"HTTP/1.1 200")


def test_a_pipelined_request_whose_body_comes_late_is_answered(address: str) -> None:
    first = b"GET /healthz HTTP/1.1\r\nHost: x\r\n\r\n"
    with connected(address) as connection:
        connection.sendall(first + post_of("/v1/coupling", 2) + b"{")
        read_health(connection)
        time.sleep(1.0)
        connection.sendall(b"}")
        assert connection.recv(65536).startswith(b"HTTP/1.1 422")


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


def test_an_answer_that_nobody_reads_is_given_up() -> None:
    """The memory of it is free again after the deadline; who reads slowly gets the whole of it."""
    with (
        faulty_server(workers=1, send_deadline_s=6) as (process, address),
        ExitStack() as stack,
    ):
        request = b"GET /openapi.json HTTP/1.1\r\nHost: x\r\n\r\n"
        whole = len(httpx.get(f"{address}/openapi.json", timeout=60).content)
        idle = descriptors(process.pid)
        for _ in range(20):
            connection = stack.enter_context(socket.socket())
            connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            connection.connect((urlsplit(address).hostname, urlsplit(address).port))
            connection.sendall(request * 10)
        wait_until(lambda: descriptors(process.pid) >= idle + 10)  # slow machines give up the first before the last
        slow = stack.enter_context(connected(address))
        slow.sendall(request)
        received = 0
        while received < whole:
            received += len(slow.recv(20_000))
            time.sleep(0.01)
        wait_until(lambda: descriptors(process.pid) <= idle + 2, 60)


def test_few_descriptors() -> None:
    """Idle connections beyond the limit are refused, and nothing breaks while they are there or afterwards."""
    command = ["bash", "-c", f"ulimit -n 256; exec {' '.join(FAULTY)}"]
    with (
        running_server(command, workers=2, header_deadline_s=3, log_level="error") as (process, address),
        ExitStack() as stack,
    ):
        idle = descriptors(process.pid)
        for _ in range(300):
            with suppress(OSError):
                stack.enter_context(connected(address)).sendall(b"GET /")
        refused = httpx.get(f"{address}/healthz", timeout=5)
        assert refused.status_code == 503
        assert refused.json()["type"].endswith("service_unavailable")
        wait_until(lambda: descriptors(process.pid) <= idle + 2)
        for _ in range(20):
            assert httpx.get(f"{address}/readyz", timeout=5).status_code == 200
            assert httpx.post(f"{address}/v1/coupling", json={}, timeout=5).status_code == 422
