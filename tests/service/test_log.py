"""The log has one line of JSON per request without its content; a stalled reader of the log delays no answer."""

import http.client
import json
import os
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from urllib.parse import urlsplit

import httpx
import pytest

from tests.support.server import (
    FAULTY,
    PATIENCE_S,
    Server,
    answer_to,
    connected,
    faulty_server,
    started_server,
    wait_for_metric,
    wait_until,
    wait_until_warm,
)

pytestmark = pytest.mark.service


def lines_of(log: Path) -> list[dict[str, object]]:
    *whole, _ = log.read_text("utf-8").split("\n")
    lines = [json.loads(line) for line in whole if line.startswith("{")]
    return [line for line in lines if line["endpoint"] != "/readyz"]


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("log") / "log"


@pytest.fixture(scope="module")
def service(log: Path) -> Iterator[Server]:
    with faulty_server(workers=1, log=log) as server:
        yield server


def test_one_json_line_a_request(address: str, log: Path) -> None:
    before = len(lines_of(log))
    httpx.get(f"{address}/healthz", headers={"X-Request-ID": "first"}, timeout=PATIENCE_S)
    httpx.post(f"{address}/v1/coupling", json={"secret": 1}, headers={"X-Request-ID": "second"}, timeout=PATIENCE_S)
    httpx.get(f"{address}/nothing?token=hidden", headers={"X-Request-ID": 'a"b'}, timeout=PATIENCE_S)
    httpx.head(f"{address}/healthz", timeout=PATIENCE_S)
    wait_until(lambda: len(lines_of(log)) >= before + 4)
    mine = lines_of(log)[before:]
    assert [(line["method"], line["endpoint"], line["status"]) for line in mine] == [
        ("GET", "/healthz", 200),
        ("POST", "/v1/coupling", 422),
        ("GET", "unmatched", 404),
        ("HEAD", "/healthz", 200),
    ]
    assert {line["client"] for line in mine} == {"127.0.0.1"}
    assert [line["request_id"] for line in mine[:2]] == ["first", "second"]
    assert all(float(str(line["duration_ms"])) >= 0 for line in mine)
    assert "secret" not in log.read_text("utf-8")
    assert "hidden" not in log.read_text("utf-8")


def test_the_log_has_the_cause_from_the_worker(address: str, log: Path) -> None:
    assert httpx.post(f"{address}/fail", timeout=PATIENCE_S).status_code == 500
    wait_until(lambda: "ZeroDivisionError: deep inside" in log.read_text("utf-8"))
    assert "in fail_deep_inside" in log.read_text("utf-8")


def test_the_address_of_clients_may_be_left_out(tmp_path: Path) -> None:
    log = tmp_path / "log"
    with faulty_server(log=log, workers=1, log_clients=False) as (_, address):
        httpx.get(f"{address}/healthz", timeout=PATIENCE_S)
    assert [line["client"] for line in lines_of(log)] == [None]
    assert "127.0.0.1" not in log.read_text("utf-8").partition("Uvicorn running")[2].partition("\n")[2]


def test_an_internal_error_is_a_problem_logged_and_counted(address: str, log: Path) -> None:
    bug = httpx.post(f"{address}/bug", timeout=PATIENCE_S)
    assert bug.status_code == 500
    assert bug.headers["content-type"] == "application/problem+json"
    assert bug.headers["x-content-type-options"] == "nosniff"
    assert bug.json()["instance"] == bug.headers["x-request-id"]

    def mine() -> list[dict[str, object]]:
        return [line for line in lines_of(log) if line["request_id"] == bug.json()["instance"]]

    wait_until(lambda: len(mine()) == 1)
    assert [(line["method"], line["endpoint"], line["status"]) for line in mine()] == [("POST", "/bug", 500)]
    assert (
        'tribodrive_requests_total{endpoint="/bug",status="500"} 1.0'
        in httpx.get(f"{address}/metrics", timeout=PATIENCE_S).text
    )
    assert "RuntimeError: a bug" in log.read_text("utf-8")


def test_what_the_server_itself_refuses_is_plain_text(address: str) -> None:
    with connected(address) as connection:
        connection.sendall(b"NONSENSE\r\n\r\n")
        assert answer_to(connection).startswith(b"HTTP/1.1 400")


def test_a_warning_of_a_worker_is_logged(address: str, log: Path) -> None:
    assert httpx.post(f"{address}/warn", timeout=PATIENCE_S).status_code == 200
    wait_until(lambda: "a worker said: " in log.read_text("utf-8"))
    assert "UserWarning: deep inside" in log.read_text("utf-8")


def test_a_log_that_nobody_reads_costs_lines_and_nothing_else() -> None:
    reader, writer = os.pipe()
    try:
        with started_server(FAULTY, log=writer, workers=1) as (process, address):
            wait_until_warm(process, address)
            connection = http.client.HTTPConnection(urlsplit(address).netloc, timeout=PATIENCE_S)
            for _ in range(13_000):  # the pipe holds some hundred lines, the queue ten thousand
                connection.request("GET", "/healthz")
                assert connection.getresponse().read() == b'{"status":"ok"}'
            connection.close()
            metrics = httpx.get(f"{address}/metrics", timeout=PATIENCE_S).text.splitlines()
            dropped = next(line for line in metrics if line.startswith("tribodrive_log_lines_dropped_total"))
            assert float(dropped.split()[1]) > 100
            process.terminate()
            process.wait(PATIENCE_S)
    finally:
        os.close(reader)
        os.close(writer)


def test_ready_does_not_queue_behind_calculations(address: str) -> None:
    with ExitStack() as stack:
        for _ in range(5):
            connection = stack.enter_context(connected(address))
            connection.sendall(b"POST /sleep/5 HTTP/1.1\r\nHost: x\r\nContent-Length: 0\r\n\r\n")
        wait_for_metric(address, "tribodrive_calculations_waiting", 4)
        answer = httpx.get(f"{address}/readyz", timeout=5)
        assert answer.status_code == 200
        assert answer.json()["workers"] == 1
        assert "coupling" in answer.json()["warm"]
