"""Schemathesis against the whole OpenAPI document, every check on."""

import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.server import running_server

ROOT = Path(__file__).parents[2]

pytestmark = pytest.mark.service


def test_every_operation() -> None:
    """With all phases and more examples: `schemathesis run --checks all --max-examples 1000 ADDRESS/openapi.json`.

    Studies end after a second here: a thousand of a minute each would say nothing more.
    """
    command: list[str | Path] = [
        Path(sys.executable).with_name("schemathesis"),
        "run",
        "--checks",
        "all",
        "--phases",
        "examples,fuzzing",
        "--max-examples",
        "5",
        "--generation-deterministic",
    ]
    with running_server(study_points=16, spectrum_solves=16, study_deadline_s=1) as (_, address):
        outcome = subprocess.run(
            [*command, f"{address}/openapi.json"], cwd=ROOT, capture_output=True, text=True, check=False
        )
    assert outcome.returncode == 0, outcome.stdout[-10_000:]
