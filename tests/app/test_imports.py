"""What a script imports: the solvers need three packages alone, and a folder `app` beside it hides the service."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.server import ROOT

ALONE = ("numpy", "scipy", "numba", "llvmlite", "solvers")  # llvmlite belongs to numba
REFUSE = f"""
import importlib, pkgutil, sys

class Refusal:
    def find_spec(self, name, path=None, target=None):
        package = name.partition(".")[0]
        if package not in {ALONE} and package not in sys.stdlib_module_names:
            raise ModuleNotFoundError(f"no {{name}} here", name=name)

sys.meta_path.insert(0, Refusal())
"""
SOLVE = """
import solvers
names = [module.name for module in pkgutil.walk_packages(solvers.__path__, "solvers.")]
for name in names:
    importlib.import_module(name)
from solvers import coupling
point = coupling.Operation(torque=3000, speed=200, misalignment=1e-3, axial_velocity=1e-3)
inputs = coupling.CouplingInputs(coupling.Coupling(teeth=52, module=3e-3, crowning_ratio=1), point)
print(len(names), coupling.solve(inputs).axial_thrust.force > 0)
"""


# An editable installation finds modules of a package that another one hides; a user has no editable installation.
INSTALLED = "import sys; sys.meta_path = [each for each in sys.meta_path if 'Editable' not in repr(each)]"


def run(script: str, *options: str, folder: Path = ROOT) -> subprocess.CompletedProcess[str]:
    """Run a script that stands in a folder."""
    file = folder / "script.py"
    file.write_text(script, "utf-8")
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, *options, str(file)]
    return subprocess.run(command, env=environment, cwd=folder, capture_output=True, text=True, check=False)


@pytest.mark.ci
def test_the_solvers_need_numerics_alone(tmp_path: Path) -> None:
    ended = run(REFUSE + SOLVE, folder=tmp_path)
    assert ended.returncode == 0, ended.stderr
    count, is_solved = ended.stdout.split()
    assert int(count) > 100
    assert is_solved == "True"
    assert "no pydantic here" in run(REFUSE + "import pydantic", folder=tmp_path).stderr


@pytest.mark.ci
def test_a_folder_app_beside_a_script_hides_the_service_unless_the_path_is_safe(tmp_path: Path) -> None:
    """The manual names the error and the cure."""
    script = f"{INSTALLED}; import app.evaluate; print(app.evaluate.__name__)"
    own = tmp_path / "app"
    own.mkdir()
    (own / "__init__.py").write_text("")
    hidden = run(script, folder=tmp_path)
    assert hidden.stderr.splitlines()[-1] == "ModuleNotFoundError: No module named 'app.evaluate'"
    assert run(script, "-P", folder=tmp_path).stdout == "app.evaluate\n"
    chapter = (ROOT / "app" / "manual" / "service.md").read_text("utf-8")
    assert "No module named 'app.evaluate'" in chapter
    assert "python -P" in chapter
