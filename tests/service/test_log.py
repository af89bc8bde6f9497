"""One line of JSON for every request, and nothing of its content."""

import json
from pathlib import Path

import httpx
import pytest

from tests.server import running_server

pytestmark = pytest.mark.service


def test_one_json_line_a_request(tmp_path: Path) -> None:
    log = tmp_path / "log"
    with running_server(log=log, workers=1) as (_, address):
        httpx.get(f"{address}/healthz", headers={"X-Request-ID": "first"})
        httpx.post(f"{address}/v1/coupling", json={"secret": 1}, headers={"X-Request-ID": "second"})
        httpx.get(f"{address}/nothing?token=hidden", headers={"X-Request-ID": 'a"b'})
    lines = [json.loads(line) for line in log.read_text("utf-8").splitlines() if line.startswith("{")]
    mine = [line for line in lines if line["endpoint"] != "/readyz"]
    assert [(line["method"], line["endpoint"], line["status"]) for line in mine] == [
        ("GET", "/healthz", 200),
        ("POST", "/v1/coupling", 422),
        ("GET", "unmatched", 404),
    ]
    assert [line["request_id"] for line in mine[:2]] == ["first", "second"]
    assert all(line["duration_ms"] >= 0 for line in mine)
    assert "secret" not in log.read_text("utf-8")
    assert "hidden" not in log.read_text("utf-8")
