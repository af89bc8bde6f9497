"""Every setting is an environment variable, and the help and the manual document every setting."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from pydantic import ValidationError

from app.manual import chapters
from app.settings import Settings

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text("utf-8")
MANUAL = chapters()["service"].text


def test_help_and_manual_document_every_setting() -> None:
    shown = subprocess.run(
        [sys.executable, "-m", "app", "--help"], check=True, capture_output=True, text=True, env={"COLUMNS": "200"}
    ).stdout
    for name, field in Settings.model_fields.items():
        variable = f"TRIBODRIVE_{name.upper()}"
        assert variable in shown
        assert field.description in shown
        assert f"| `{variable}` | {field.description} |" in MANUAL


def test_readme_and_manual_document_nothing_else() -> None:
    known = {f"TRIBODRIVE_{name.upper()}" for name in Settings.model_fields}
    assert set(re.findall(r"`(TRIBODRIVE_[A-Z_]+)`", MANUAL)) == known
    assert set(re.findall(r"`(TRIBODRIVE_[A-Z_]+)`", README)) <= known


def test_settings_come_from_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TRIBODRIVE_DEADLINE_S", "2.5")
    assert Settings().deadline_s == 2.5


def test_a_cluster_takes_larger_studies_unless_told_otherwise() -> None:
    address = "tcp://127.0.0.1:8786"
    assert Settings().most_study_points == 2500
    assert Settings(scheduler=address).most_study_points == 100_000
    assert Settings(scheduler=address, study_points=7).most_study_points == 7


@pytest.mark.parametrize(
    ("command", "variable", "workers"),
    [
        ("uvicorn app.main:app", "", 8),
        ("uvicorn app.main:app --workers 2", "", 4),
        ("uvicorn --workers=3 app.main:app", "2", 2),
        ("gunicorn app.main:app -w 20", "", 1),
        ("gunicorn app.main:app", "4", 2),
    ],
)
def test_processes_of_a_server_share_the_cores(
    monkeypatch: pytest.MonkeyPatch, command: str, variable: str, workers: int
) -> None:
    monkeypatch.setattr(sys, "argv", command.split())
    monkeypatch.setattr(os, "cpu_count", lambda: 8)
    if variable:
        monkeypatch.setenv("WEB_CONCURRENCY", variable)
    assert Settings().workers == workers


@pytest.mark.parametrize(("variable", "value"), [("WORKERS", "0"), ("PORT", "x"), ("DEADLINE_S", "-1")])
def test_nonsense_settings_are_refused(monkeypatch: pytest.MonkeyPatch, variable: str, value: str) -> None:
    monkeypatch.setenv(f"TRIBODRIVE_{variable}", value)
    with pytest.raises(ValidationError):
        Settings()


def started_with(server: str, **variables: str) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, **{f"TRIBODRIVE_{name}": value for name, value in variables.items()}}
    command = [sys.executable, "-m", *([server, "app.main:app"] if server == "uvicorn" else [server])]
    return subprocess.run(command, check=False, capture_output=True, text=True, env=environment, cwd=ROOT, timeout=60)


@pytest.mark.parametrize("server", ["app", "uvicorn"])
@pytest.mark.ci
def test_a_wrong_setting_is_one_line(server: str) -> None:
    outcome = started_with(server, PORT="99999", QEUE="3")
    assert outcome.returncode == 1
    assert outcome.stderr.splitlines() == [
        "tribodrive: there is no setting TRIBODRIVE_QEUE; did you mean TRIBODRIVE_QUEUE?",
        "tribodrive: TRIBODRIVE_PORT is '99999': input should be less than or equal to 65535",
    ]
