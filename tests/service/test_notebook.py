"""The notebooks run to the end; their assertions compare equations written by hand with the library."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.support.server import ROOT

pytestmark = pytest.mark.service

RUN = "import sys; from nbclient.cli import main; sys.exit(main())"  # in a process of its own: it brings an event loop


def outputs_of(notebook: Path) -> list[dict[str, Any]]:
    cells = [cell for cell in json.loads(notebook.read_text("utf-8"))["cells"] if cell["cell_type"] == "code"]
    return [output for cell in cells for output in cell["outputs"]]


@pytest.mark.parametrize(
    ("name", "figures", "expected"),
    [
        ("solvers", 4, ("permissible: 0.1 to 100 mm", "blok_factor=")),
        ("models", 8, ("flash temperature [K]: by hand", "Grind a helix slope of")),
        ("studies", 1, ("of 2000 points are kept", "in all {'ok", "exceeds 2.5 kN in")),
    ],
)
def test_the_notebook_runs_and_draws(name: str, figures: int, expected: tuple[str, ...], tmp_path: Path) -> None:
    executed = tmp_path / "executed.ipynb"
    notebook = ROOT / "docs" / f"{name}.ipynb"
    subprocess.run(
        [sys.executable, "-c", RUN, f"--output={executed.with_suffix('')}", "--timeout=600", str(notebook)],
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        check=True,
    )
    outputs, stored = outputs_of(executed), outputs_of(notebook)
    assert sum("image/png" in output.get("data", {}) for output in outputs) == figures
    assert sum("image/png" in output.get("data", {}) for output in stored) == figures, "store it with its outputs"
    texts = ["".join(output.get("text", output.get("data", {}).get("text/plain", ""))) for output in outputs]
    assert all(any(part in text for text in texts) for part in expected)
