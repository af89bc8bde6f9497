"""The wheel contains the files that the service needs and no others, and its command starts the service."""

import subprocess
import sys
import zipfile
from contextlib import suppress
from pathlib import Path

import httpx
import pytest

from app.examples import examples
from tests.support.server import ROOT, START_UP_S, started_server, wait_until

pytestmark = pytest.mark.service

PIP = [sys.executable, "-m", "pip"]


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    subprocess.run([*PIP, "wheel", "--no-deps", "--quiet", "--wheel-dir", folder, ROOT], check=True)
    (found,) = folder.glob("tribodrive-*.whl")
    return found


def test_content_of_the_wheel(wheel: Path) -> None:
    packed = {name for name in zipfile.ZipFile(wheel).namelist() if ".dist-info/" not in name}
    tracked = subprocess.run(
        ["git", "ls-files", "app", "solvers"],  # noqa: S607
        cwd=ROOT,
        check=True,
        capture_output=True,
        text=True,
    ).stdout.splitlines()
    assert packed == set(tracked)


def test_the_command_serves_from_a_folder_that_has_an_app_of_its_own(wheel: Path, tmp_path: Path) -> None:
    installed, other = tmp_path / "installed", tmp_path / "app"
    subprocess.run([*PIP, "install", "--no-deps", "--quiet", "--target", installed, wheel], check=True)
    other.mkdir()
    (other / "__init__.py").write_text("raise SystemExit('another app')")
    command = ["env", "-C", str(tmp_path), f"PYTHONPATH={installed}", str(installed / "bin" / "tribodrive")]
    coupling = examples()["pahl-axial-displacement"]
    with started_server(command) as (_, address):

        def is_answered() -> bool:
            with suppress(httpx.TransportError):
                return httpx.post(address + coupling.endpoint, json=coupling.request, timeout=60).status_code == 200
            return False

        wait_until(is_answered, START_UP_S)
