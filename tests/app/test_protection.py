"""The service refuses requests that break its limits, sets headers on every answer, and identifies requests."""

import json
import socket
import time
from contextlib import suppress
from urllib.parse import urlsplit

import httpx
import pytest

from app.examples import examples
from app.settings import Settings


def answer_to(client: httpx.Client, sent: bytes) -> bytes:
    """Send bytes on a new connection, and return all bytes that the service sends until it closes the connection."""
    target = urlsplit(str(client.base_url))
    with socket.create_connection((target.hostname, target.port), timeout=60) as connection:
        connection.sendall(sent)
        return b"".join(iter(lambda: connection.recv(65536), b""))


@pytest.mark.ci
def test_an_old_client_gets_no_chunks(served: httpx.Client) -> None:
    request = examples()["pahl-axial-displacement"]
    axis = {"path": "operation.speed_rpm", "start": 100, "stop": 200, "count": 5}
    body = json.dumps({"endpoint": request.endpoint, "request": request.request, "vary": [axis]}).encode()
    head = b"POST /v1/sweep HTTP/1.0\r\nContent-Type: application/json\r\nContent-Length: %d\r\n\r\n" % len(body)
    headers, _, content = answer_to(served, head + body).partition(b"\r\n\r\n")
    assert b" 200 " in headers
    assert b"transfer-encoding" not in headers.lower()
    assert json.loads(content.splitlines()[-1])["type"] == "end"


def test_a_decent_request_id_is_kept(client: httpx.Client) -> None:
    assert client.get("/healthz", headers={"X-Request-ID": "report-7.b"}).headers["x-request-id"] == "report-7.b"


@pytest.mark.parametrize("sent", ["", "a b", "x" * 129, "line\tbreak"])
def test_a_strange_request_id_is_replaced(client: httpx.Client, sent: str) -> None:
    assert client.get("/healthz", headers={"X-Request-ID": sent}).headers["x-request-id"] != sent


@pytest.mark.ci
def test_headers_of_every_answer(served: httpx.Client) -> None:
    for path in ("/healthz", "/nothing", "/docs"):
        headers = served.get(path).headers
        assert headers["x-content-type-options"] == "nosniff"
        assert headers["server-timing"].startswith("total;dur=")
        assert "server" not in headers


@pytest.mark.ci
@pytest.mark.parametrize("announced", [True, False])
def test_large_bodies(served: httpx.Client, *, announced: bool) -> None:
    size = Settings().max_body_bytes + 1
    content = b" " * size if announced else (b" " * 65536 for _ in range(size // 65536 + 2))
    headers = {"Content-Type": "application/json"}
    response = served.post("/v1/coupling", content=content, headers=headers)
    assert response.status_code == 413
    assert response.headers["content-type"] == "application/problem+json"
    problem = response.json()
    assert problem["type"] == "urn:tribodrive:problem:content_too_large"
    assert problem["title"] == "The request body is too large"
    assert problem["detail"] == f"The request body is larger than {size - 1} bytes"


@pytest.mark.parametrize(("beyond", "status"), [(0, 422), (1, 413)])
def test_a_body_may_be_as_large_as_the_limit(client: httpx.Client, beyond: int, status: int) -> None:
    content = b" " * (Settings().max_body_bytes + beyond)
    answer = client.post("/v1/coupling", content=content, headers={"Content-Type": "application/json"})
    assert answer.status_code == status


@pytest.mark.ci
def test_large_headers(served: httpx.Client) -> None:
    """The answer is 400; the rest of the header stays unread, and TCP may reset the connection before it arrives."""
    with suppress(httpx.ReadError, httpx.WriteError):
        response = served.get("/healthz", headers={"X-Padding": "x" * 600_000})
        assert response.status_code == 400
    assert served.get("/healthz").status_code == 200


NO_CHUNK = b"POST /v1/coupling HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\nno length\r\n"


@pytest.mark.parametrize("earlier", [1, 3])
@pytest.mark.ci
def test_a_refused_request_does_not_cost_the_answers_to_those_before(served: httpx.Client, earlier: int) -> None:
    example = examples()["pahl-axial-displacement"]
    body = json.dumps(example.request).encode()
    head = f"POST {example.endpoint} HTTP/1.1\r\nHost: a\r\nContent-Type: application/json\r\n"
    calculation = f"{head}Content-Length: {len(body)}\r\n\r\n".encode() + body
    answers = answer_to(served, calculation * earlier + NO_CHUNK).split(b"HTTP/1.1 ")[1:]
    assert [each[:3] for each in answers] == [*[b"200"] * earlier, b"400"]


def test_wrong_method(client: httpx.Client) -> None:
    response = client.get("/v1/coupling")
    assert response.status_code == 405
    assert response.headers["allow"] == "POST"


@pytest.mark.parametrize("path", ["/healthz", "/readyz", "/v1/examples", "/docs", "/openapi.json", "/metrics"])
def test_head_where_get_is(client: httpx.Client, path: str) -> None:
    head, get = client.head(path), client.get(path)
    assert head.status_code == get.status_code == 200
    assert head.headers["content-type"] == get.headers["content-type"]
    assert head.content == b""


def test_head_where_get_is_not(client: httpx.Client) -> None:
    assert client.head("/v1/coupling").status_code == 405


@pytest.mark.parametrize("content_type", [None, "text/plain", "application/x-www-form-urlencoded", "json"])
def test_body_must_be_declared_as_json(client: httpx.Client, content_type: str | None) -> None:
    request = client.build_request("POST", "/v1/coupling", content=b"{}")
    if content_type:
        request.headers["Content-Type"] = content_type
    response = client.send(request)
    assert response.status_code == 415
    assert response.json()["type"].endswith("unsupported_media_type")


@pytest.mark.parametrize("content_type", ["application/json; charset=utf-8", "Application/JSON", "application/x+json"])
def test_json_by_any_of_its_names(client: httpx.Client, content_type: str) -> None:
    response = client.post("/v1/coupling", content=b"{}", headers={"Content-Type": content_type})
    assert response.status_code == 422


def test_duplicate_names_are_refused(client: httpx.Client) -> None:
    response = client.post(
        "/v1/coupling", content=b'{"operation": {"a": 1, "a": 2}}', headers={"Content-Type": "application/json"}
    )
    assert response.status_code == 400
    assert "twice" in response.json()["detail"]


@pytest.mark.parametrize(
    ("example", "options", "field"),
    [
        ("xue-pair-1-thermal", {"path_points": 500, "nodes": 481, "film_nodes": 61}, "/model/path_points"),
        ("milian-case-1-choking", {"flow": "pocket_chain", "slices": 1000}, "/model/slices"),
    ],
)
def test_what_cannot_finish_is_refused_with_the_reason(
    client: httpx.Client, example: str, options: dict[str, object], field: str
) -> None:
    case = examples()[example]
    started = time.monotonic()
    response = client.post(case.endpoint, json=case.request | {"model": options})
    assert time.monotonic() - started < 5
    assert response.status_code == 422
    assert response.json()["type"].endswith("cannot_finish")
    assert response.json()["errors"][0]["pointer"] == field


def test_home_is_the_start_page(client: httpx.Client) -> None:
    answer = client.get("/")
    assert answer.status_code == 200
    assert "/manual/coupling" in answer.text


def test_metrics_count_requests(client: httpx.Client) -> None:
    client.get("/healthz")
    text = client.get("/metrics").text
    assert 'tribodrive_requests_total{endpoint="/healthz",status="200"}' in text
