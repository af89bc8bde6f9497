"""The service starts on a platform without `resource`, CPU affinity and `fork`."""

import re
from pathlib import Path

import httpx
import pytest

from app.examples import examples
from tests.support.server import started_server, wait_until_warm

pytestmark = pytest.mark.service

LESS = """
import os
import sys
sys.modules["resource"] = None
for name in ("fork", "forkpty", "sched_getaffinity", "sched_setaffinity"):
    delattr(os, name)
"""
"""Every Python process of the service runs this code first. The code removes what such a platform lacks."""


def test_starts_and_answers_with_less(tmp_path: Path) -> None:
    (tmp_path / "sitecustomize.py").write_text(LESS)
    log = tmp_path / "log"
    coupling = examples()["pahl-axial-displacement"]
    with started_server(environment={"PYTHONPATH": str(tmp_path)}, log=log) as (process, address):
        wait_until_warm(process, address)
        answer = httpx.post(address + coupling.endpoint, json=coupling.request, timeout=20)
        assert answer.json()["status"] == "ok"
    assert not re.search("Traceback|Error|died", log.read_text("utf-8"))
