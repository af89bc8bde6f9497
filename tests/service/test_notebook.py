"""The notebook runs from beginning to end."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.server import ROOT

pytestmark = pytest.mark.service

FIGURES = 4
RUN = "import sys; from nbclient.cli import main; sys.exit(main())"  # in a process of its own: it brings an event loop


def test_the_notebook_runs_and_draws(tmp_path: Path) -> None:
    executed = tmp_path / "executed.ipynb"
    notebook = ROOT / "docs" / "solvers.ipynb"
    subprocess.run(
        [sys.executable, "-c", RUN, f"--output={executed.with_suffix('')}", "--timeout=600", str(notebook)],
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        check=True,
    )
    cells = [cell for cell in json.loads(executed.read_text("utf-8"))["cells"] if cell["cell_type"] == "code"]
    outputs = [output for cell in cells for output in cell["outputs"]]
    assert sum("image/png" in output.get("data", {}) for output in outputs) == FIGURES
    texts = ["".join(output.get("text", output.get("data", {}).get("text/plain", ""))) for output in outputs]
    assert any("permissible 0.1 to 100 mm" in text for text in texts)
    assert any("blok_factor=" in text for text in texts)
