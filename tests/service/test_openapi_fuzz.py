"""Schemathesis finds no fault in the operations of the OpenAPI document with all of its checks."""

import subprocess
import sys
from pathlib import Path

import httpx
import pytest

from tests.support.server import ROOT, running_server

pytestmark = pytest.mark.service


def schemathesis(*options: str) -> subprocess.CompletedProcess[str]:
    """Run Schemathesis against a service whose studies end after one second."""
    # The program starts about a thousand studies. A minute for each study would not find more faults.
    program = Path(sys.executable).with_name("schemathesis")
    with running_server(study_points=16, spectrum_solves=16, study_deadline_s=1) as (_, address):
        httpx.get(f"{address}/openapi.json", timeout=60).raise_for_status()  # made once; the program waits for 10 s
        return subprocess.run(
            [program, "run", "--checks", "all", "--generation-deterministic", *options, f"{address}/openapi.json"],
            cwd=ROOT,
            capture_output=True,
            text=True,
            check=False,
        )


def test_every_operation() -> None:
    """Schemathesis finds no fault in a short search."""
    # A longer search has all phases: `schemathesis run --checks all --max-examples 1000 ADDRESS/openapi.json`.
    outcome = schemathesis("--phases", "examples,fuzzing", "--max-examples", "5")
    assert outcome.returncode == 0, outcome.stdout[-10_000:]


def test_requests_that_fit_the_schema_are_answered_or_refused_by_a_known_rule() -> None:
    """The tests spend most of their time on valid requests, because only many of these reveal a needless refusal."""
    outcome = schemathesis("--mode", "positive", "--phases", "fuzzing", "--max-examples", "30", "--workers", "2")
    assert outcome.returncode == 0, outcome.stdout[-10_000:]
