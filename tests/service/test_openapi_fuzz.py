"""Schemathesis against the whole OpenAPI document, every check on."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

pytestmark = pytest.mark.service


def test_every_operation(server: str) -> None:
    """With more examples: `schemathesis run --checks all --max-examples 1000 ADDRESS/openapi.json`."""
    command = [
        Path(sys.executable).with_name("schemathesis"),
        "run",
        "--checks",
        "all",
        "--max-examples",
        "25",
        "--generation-deterministic",
    ]
    outcome = subprocess.run(
        [*command, f"{server}/openapi.json"], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert outcome.returncode == 0, outcome.stdout[-10_000:]
