"""The files in deploy/ and the Dockerfile fit the service, and the steps that build the image work."""

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from app.examples import examples
from app.settings import Settings
from tests.support.server import ROOT

DEPLOY = ROOT / "deploy"
COMPOSE = yaml.safe_load((DEPLOY / "compose.yaml").read_text("utf-8"))["services"]
DOCKERFILE = [
    line.split(maxsplit=1) for line in (ROOT / "Dockerfile").read_text("utf-8").splitlines() if line[:1].isupper()
]
NGINX = (DEPLOY / "nginx.conf").read_text("utf-8")
UNIT = (DEPLOY / "tribodrive.service").read_text("utf-8")
COUPLING = examples()["pahl-axial-displacement"]


def instructions(name: str) -> list[str]:
    """Return the arguments of all instructions of this name in the Dockerfile."""
    return [rest for instruction, rest in DOCKERFILE if instruction == name]


def variables() -> dict[str, str]:
    """Return the environment variables that the Dockerfile sets."""
    return dict(pair.split("=", 1) for line in instructions("ENV") for pair in shlex.split(line))


def test_ports_and_variables_agree() -> None:
    settings = Settings()
    assert instructions("EXPOSE") == [str(settings.port)]
    assert re.findall(r"server (127\.0\.0\.1:\d+);", NGINX) == [f"{settings.host}:{settings.port}"]
    service, proxy = COMPOSE["tribodrive"], COMPOSE["nginx"]
    assert service["network_mode"] == "service:nginx"
    assert service["environment"]["TRIBODRIVE_HOST"] == settings.host
    assert [f"listen {each.split(':')[1]};" in NGINX for each in proxy["ports"]] == [True]
    assert [(DEPLOY / each.split(":")[0]).is_file() for each in proxy["volumes"]] == [True]
    assert (DEPLOY / service["build"] / "Dockerfile").is_file()
    named = {name for name in [*service["environment"], *variables()] if name.startswith("TRIBODRIVE_")}
    named |= set(re.findall(r"TRIBODRIVE_\w+", NGINX + UNIT))
    assert {name.removeprefix("TRIBODRIVE_").lower() for name in named} <= set(Settings.model_fields)
    assert service["read_only"]
    assert service["tmpfs"] == ["/tmp"]  # noqa: S108


def test_whoever_stops_the_service_waits_for_its_last_answers() -> None:
    shutdown_s = Settings().shutdown_s
    assert int(COMPOSE["tribodrive"]["stop_grace_period"].removesuffix("s")) > shutdown_s
    assert int(re.findall(r"TimeoutStopSec=(\d+)", UNIT)[0]) > shutdown_s
    assert f"proxy_read_timeout {int(Settings().study_deadline_s) + 20}s;" in NGINX


def test_the_proxy_lets_every_body_pass_that_the_service_takes() -> None:
    assert f"client_max_body_size {Settings().rexs_mb + 1}m;" in NGINX


def test_the_image_serves_as_nobody() -> None:
    assert instructions("USER") == ["nobody"]
    assert [json.loads(line) for line in instructions("CMD")] == [["python", "-m", "app"]]


@pytest.mark.skipif(shutil.which("systemd-analyze") is None, reason="systemd is not installed")
def test_systemd_accepts_the_unit(tmp_path: Path) -> None:
    unit = tmp_path / "tribodrive.service"
    unit.write_text(UNIT.replace("/opt/tribodrive/bin/tribodrive", sys.executable))
    command = ["systemd-analyze", "verify", str(unit)]
    said = subprocess.run(command, check=False, capture_output=True, text=True)
    assert (said.returncode, said.stderr) == (0, "")


ELSEWHERE = """
import llvmlite.binding as llvm
llvm.get_host_cpu_name = lambda: "znver1"
llvm.get_host_cpu_features = lambda: llvm.FeatureMap(sse2=True)
"""


@pytest.mark.slow
def test_the_image_has_its_kernels_on_another_processor(tmp_path: Path) -> None:
    """The kernels that the build steps of the image compile also run on another processor."""
    # The test compiles the kernels of couplings only. A process that is told that it runs on another type of processor
    # answers a request and leaves these kernels unchanged.
    source, prefix, elsewhere = tmp_path / "src", tmp_path / "prefix", tmp_path / "elsewhere"
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True)  # noqa: S607
    left_out = (ROOT / ".dockerignore").read_text().split()
    for name in listed.stdout.splitlines():
        if name.split("/")[0] not in left_out:
            (source / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, source / name)
    own = {name: value for name, value in os.environ.items() if name not in {"NUMBA_CACHE_DIR", "PYTHONPATH"}}
    own |= {name: value for name, value in variables().items() if name.startswith("NUMBA_")}
    for step in instructions("RUN"):
        command = step.replace("/src", str(source)).replace("/opt/tribodrive", f"{prefix} coupling")
        subprocess.run(["sh", "-c", command], env=own, cwd="/", check=True)  # noqa: S607

    def kernels() -> dict[Path, bytes]:
        return {file: file.read_bytes() for file in (prefix / "kernels").rglob("*.nb?")}

    kept = kernels()
    assert kept
    elsewhere.mkdir()
    (elsewhere / "sitecustomize.py").write_text(ELSEWHERE)
    own |= {"PYTHONPATH": str(elsewhere), "NUMBA_CACHE_DIR": str(prefix / "kernels")}
    solving = [str(prefix / "bin" / "tribodrive"), "solve", COUPLING.endpoint, "-"]
    request = json.dumps(COUPLING.request)
    solved = subprocess.run(solving, env=own, cwd="/", input=request, check=True, capture_output=True, text=True)
    assert json.loads(solved.stdout)["status"] == "ok"
    assert kernels() == kept
