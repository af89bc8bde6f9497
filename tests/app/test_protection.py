"""Limits, headers and identification of requests."""

import socket
import time
from urllib.parse import urlsplit

import httpx
import pytest

from app.settings import Settings


def test_a_decent_request_id_is_kept(client: httpx.Client) -> None:
    assert client.get("/healthz", headers={"X-Request-ID": "report-7.b"}).headers["x-request-id"] == "report-7.b"


@pytest.mark.parametrize("sent", ["", "a b", "x" * 129, "line\tbreak"])
def test_a_strange_request_id_is_replaced(client: httpx.Client, sent: str) -> None:
    assert client.get("/healthz", headers={"X-Request-ID": sent}).headers["x-request-id"] != sent


def test_headers_of_every_answer(client: httpx.Client) -> None:
    for path in ("/healthz", "/nothing", "/docs"):
        headers = client.get(path).headers
        assert headers["x-content-type-options"] == "nosniff"
        assert headers["server-timing"].startswith("total;dur=")
        assert "server" not in headers


def test_announced_large_body(client: httpx.Client) -> None:
    response = client.post("/v1/coupling", content=b" " * (Settings().max_body_bytes + 1))
    assert response.status_code == 413
    assert response.headers["content-type"] == "application/problem+json"


def test_unannounced_large_body(client: httpx.Client) -> None:
    chunks = (b" " * 65536 for _ in range(Settings().max_body_bytes // 65536 + 2))
    response = client.post("/v1/coupling", content=chunks)
    assert response.status_code == 413
    assert response.headers["content-type"] == "application/problem+json"


def test_large_headers(client: httpx.Client) -> None:
    response = client.get("/healthz", headers={"X-Padding": "x" * 20_000})
    assert response.status_code == 431


def test_wrong_method(client: httpx.Client) -> None:
    response = client.get("/v1/coupling")
    assert response.status_code == 405
    assert response.headers["allow"] == "POST"


def test_home_leads_to_the_docs(client: httpx.Client) -> None:
    assert client.get("/").headers["location"] == "/docs"


def test_metrics_count_requests(client: httpx.Client) -> None:
    client.get("/healthz")
    text = client.get("/metrics").text
    assert 'tribodrive_requests_total{endpoint="/healthz",status="200"}' in text


@pytest.mark.slow
def test_slow_body(server: str) -> None:
    address = urlsplit(server)
    started = time.monotonic()
    with socket.create_connection((address.hostname, address.port), timeout=30) as connection:
        connection.sendall(b"POST /v1/coupling HTTP/1.1\r\nHost: x\r\nContent-Length: 100\r\n\r\n{")
        answer = connection.recv(65536)
    assert answer.startswith(b"HTTP/1.1 408")
    assert time.monotonic() - started == pytest.approx(Settings().body_deadline_s, abs=2.0)
