"""The service behind the reverse proxy that deploy/ configures."""

import json
import shutil
import socket
from collections.abc import Iterator
from contextlib import suppress
from urllib.parse import urlsplit

import httpx
import pytest

from app.examples import examples
from tests.support.proxy import running_proxy
from tests.support.server import running_server

pytestmark = [
    pytest.mark.service,
    pytest.mark.skipif(shutil.which("nginx") is None, reason="nginx is not installed"),
]

COUPLING = examples()["pahl-axial-displacement"]


@pytest.fixture(scope="module")
def proxy(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """The address of nginx in front of a service."""
    with running_server(workers=2, log_level="error") as (_, address):
        folder = tmp_path_factory.mktemp("nginx")
        with running_proxy(folder, address, **{"timeout 10s": "timeout 1s"}) as outside:
            yield outside


def received(address: str, sent: bytes) -> bytes:
    """What is answered to bytes after which nothing follows."""
    target = urlsplit(address)
    answer = b""
    with socket.create_connection((target.hostname, target.port), timeout=10) as connection:
        connection.sendall(sent)
        with suppress(OSError):
            while piece := connection.recv(65536):
                answer += piece
    return answer


def test_calculations_and_pages_pass(proxy: str) -> None:
    answer = httpx.post(proxy + COUPLING.endpoint, json=COUPLING.request, timeout=20)
    assert answer.status_code == 200
    assert httpx.get(f"{proxy}/coupling", timeout=20).status_code == 200
    assert httpx.get(f"{proxy}/metrics", timeout=20).status_code == 403


def test_lines_of_a_study_pass_one_by_one(proxy: str) -> None:
    axis = {"path": "operation.speed_rpm", "start": 100, "stop": 2000, "count": 200}
    body = {"endpoint": COUPLING.endpoint, "request": COUPLING.request, "vary": [axis]}
    with httpx.stream("POST", f"{proxy}/v1/sweep", json=body, timeout=60) as response:
        kinds = [json.loads(line)["type"] for line in response.iter_lines()]
    assert kinds[0] == "sweep"
    assert kinds[-1] == "end"
    assert kinds.count("point") == 200


def test_attacks_end_at_the_proxy(proxy: str) -> None:
    head = b"POST /v1/coupling HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
    assert received(proxy, head + b"Content-Length: 99\r\n\r\n{")[9:12] in {b"", b"408"}
    assert b" 413 " in received(proxy, head + b"Content-Length: 9999999\r\n\r\n")
    assert b" 400 " in received(proxy, head + b"X-Padding: " + b"x" * 20_000 + b"\r\n\r\n")
    assert b" 400 " in received(proxy, b"GET / HTTP/1.1\r\nHost: x\r\nHost: y\r\n\r\n")


def test_one_client_gets_no_more_than_its_rate(proxy: str) -> None:
    with httpx.Client(base_url=proxy, timeout=20) as client:
        statuses = {client.get("/healthz").status_code for _ in range(200)}
    assert statuses == {200, 429}
