"""Requests and studies without a server: the function `answer`, the command `solve`; `fields` lists all fields."""

import asyncio
import io
import json
import os
import pty
import resource
import socket
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from typing import Any, TextIO

import pytest
import uvicorn

from app.command import main, serve
from app.errors import InvalidBody, Unprocessable
from app.evaluate import answer
from app.settings import Settings
from app.sources import SOURCES
from app.studies import study
from tests.support.server import ROOT, free_port
from tests.support.studies import timeless

COUPLING: dict[str, Any] = {
    "coupling": {"teeth": 52, "module_mm": 3, "crowning_ratio": 1},
    "operation": {"torque_n_m": 3000, "speed_rpm": 1910, "misalignment_deg": 0.05, "axial_velocity_mm_per_s": 2},
    "friction": {"coefficient": 0.2},
}
TILTED = {**COUPLING, "operation": {**COUPLING["operation"], "misalignment_deg": 3}}


def run(*arguments: str, text: str = "") -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "app", *arguments], input=text, capture_output=True, text=True, cwd=ROOT, check=False
    )


def test_an_unknown_endpoint_is_told_those_that_there_are() -> None:
    with pytest.raises(Unprocessable, match="/v1/coupling"):
        answer("/v1/nothing", {})


def test_the_answer_in_process_is_that_of_the_service(post: Any) -> None:
    assert answer("/v1/coupling", COUPLING) == post("/v1/coupling", COUPLING).json()


def test_a_refusal_in_process_names_the_field() -> None:
    with pytest.raises(InvalidBody) as caught:
        answer("/v1/coupling", {**COUPLING, "coupling": {"teeth": 3, "module_mm": 3}})
    assert [fault.pointer for fault in caught.value.faults] == ["/coupling/teeth"]


def printed(case: Path, monkeypatch: pytest.MonkeyPatch, stream: TextIO) -> int | str | None:
    """Run `solve` in this process with `stream` as standard output, and return the exit status or message."""
    monkeypatch.setattr(sys, "argv", ["tribodrive", "solve", "/v1/coupling", str(case)])
    monkeypatch.setattr(sys, "stdout", stream)
    with pytest.raises(SystemExit) as ended:
        main()
    return ended.value.code


@pytest.fixture(name="case")
def case_file(tmp_path: Path) -> Path:
    file = tmp_path / "case.json"
    file.write_text(json.dumps(COUPLING))
    return file


def test_a_full_disk_is_told_in_a_line(case: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with Path("/dev/full").open("w") as full:
        assert printed(case, monkeypatch, full) == "tribodrive: cannot write the answer: No space left on device"


@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "cp1252", "utf-8"])
def test_the_answer_is_json_in_every_locale(case: Path, monkeypatch: pytest.MonkeyPatch, encoding: str) -> None:
    written = io.BytesIO()
    assert printed(case, monkeypatch, io.TextIOWrapper(written, encoding)) == 0
    assert json.loads(written.getvalue().decode(encoding)) == answer("/v1/coupling", COUPLING)


@pytest.mark.parametrize("processes", ["auto", "", "4"])
def test_processes_of_servers_do_not_matter(case: Path, monkeypatch: pytest.MonkeyPatch, processes: str) -> None:
    monkeypatch.setenv("WEB_CONCURRENCY", processes)
    assert printed(case, monkeypatch, io.TextIOWrapper(io.BytesIO(), "utf-8")) == 0


@pytest.mark.parametrize("path", ["/v1/coupling", "/v1/nothing"])
@pytest.mark.ci
def test_what_cannot_be_printed_ends_with_a_line(path: str) -> None:
    """If the standard output is full, the process ends with one line of explanation."""
    # Python itself would complain if it could not flush the standard output at the end.
    environment = {**os.environ, "LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0", "WEB_CONCURRENCY": "a"}
    with Path("/dev/full").open("w") as full:
        ended = subprocess.run(
            [sys.executable, "-m", "app", "solve", path, "-"],
            check=False,
            input=json.dumps(COUPLING),
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            cwd=ROOT,
            env=environment,
        )
    assert ended.returncode == 1
    assert len(ended.stderr.splitlines()) == 1
    assert ended.stderr.startswith("tribodrive: ")


@pytest.mark.slow
def test_a_file_and_the_standard_input_are_solved(tmp_path: Path) -> None:
    file = tmp_path / "case.json"
    file.write_text(json.dumps(COUPLING))
    solved = run("solve", "/v1/coupling", str(file))
    assert solved.returncode == 0
    assert json.loads(solved.stdout) == answer("/v1/coupling", COUPLING)
    assert run("solve", "/v1/coupling", "-", text=json.dumps(COUPLING)).stdout == solved.stdout


@pytest.mark.slow
def test_the_exit_status_tells_warnings() -> None:
    assert run("solve", "/v1/coupling", "-", text=json.dumps(TILTED)).returncode == 3


@pytest.mark.slow
@pytest.mark.parametrize(
    ("endpoint", "text", "message"),
    [
        ("/v1/coupling", "{", "the body is not valid JSON"),
        ("/v1/coupling", '{"coupling": {}}', "tribodrive: /operation is required"),
        ("/v1/couplings", "{}", "there is no endpoint /v1/couplings"),
    ],
)
def test_what_is_refused_says_why(endpoint: str, text: str, message: str) -> None:
    refused = run("solve", endpoint, "-", text=text)
    assert refused.returncode == 1
    assert message in refused.stderr
    assert refused.stdout == ""


AXIS = {"path": "operation.torque_n_m", "start": 1000, "stop": 3000, "count": 300}
SWEEP: dict[str, Any] = {
    "endpoint": "/v1/coupling",
    "request": COUPLING,
    "vary": [AXIS],
    "outputs": ["axial_thrust.force_n"],
}


@pytest.fixture(name="sweep")
def sweep_file(tmp_path: Path) -> Path:
    file = tmp_path / "sweep.json"
    file.write_text(json.dumps(SWEEP))
    return file


@pytest.mark.ci
def test_a_study_is_lines_or_a_table_and_goes_on(sweep: Path, post: Any) -> None:
    kept = sweep.with_name("kept.jsonl")
    for _ in range(2):
        solved = run("solve", "/v1/sweep", str(sweep), "--kept", str(kept))
        assert (solved.returncode, solved.stderr) == (0, "")
        lines = [json.loads(line) for line in solved.stdout.splitlines()]
        assert timeless(lines) == timeless(list(study("/v1/sweep", SWEEP)))
    table = run("solve", "/v1/sweep", str(sweep), "--kept", str(kept), "--csv").stdout
    assert table == post("/v1/sweep?format=csv", SWEEP).text.replace("\r\n", "\n")
    kept.write_text(kept.read_text("utf-8").replace(SOURCES, "0" * 64), "utf-8")
    refused = run("solve", "/v1/sweep", str(sweep), "--kept", str(kept))
    assert (refused.returncode, refused.stdout, len(refused.stderr.splitlines())) == (1, "", 1)
    assert SOURCES in refused.stderr
    assert "0" * 64 in refused.stderr


@pytest.mark.ci
def test_a_study_shows_its_progress_on_a_terminal_and_stops_with_its_reader(sweep: Path) -> None:
    terminal, end = pty.openpty()
    with subprocess.Popen(
        [sys.executable, "-m", "app", "solve", "/v1/sweep", str(sweep)], stdout=subprocess.PIPE, stderr=end, cwd=ROOT
    ) as process:
        os.close(end)
        assert process.stdout is not None
        assert process.stdout.readline().startswith(b'{"type":"sweep"')
        process.stdout.close()
        shown = b""
        with suppress(OSError):  # the terminal is closed at the end
            while part := os.read(terminal, 1000):
                shown += part
    assert process.returncode == 0
    assert b"of 300 points" in shown
    os.close(terminal)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("/v1/coupling", "--csv"), "the answer of /v1/coupling is no table; leave out --csv"),
        (("/v1/spectrum", "--csv"), "the answer of /v1/spectrum is no table; leave out --csv"),
        (("/v1/coupling", "--kept", "x"), "/v1/coupling is no study; leave out --kept"),
        (("/v1/sweeps",), "there is no endpoint /v1/sweeps; the endpoints are /v1/coupling, "),
        (("/v1/sweep",), "/endpoint is required"),
    ],
)
def test_a_study_that_cannot_be_printed_is_told(
    arguments: tuple[str, ...], message: str, case: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    endpoint, *options = arguments
    monkeypatch.setattr(sys, "argv", ["tribodrive", "solve", endpoint, str(case), *options])
    with pytest.raises(SystemExit) as ended:
        main()
    assert message in str(ended.value.code)


def test_a_taken_port_is_one_line() -> None:
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = str(other.getsockname()[1])
        command = [sys.executable, "-m", "app", "--port", port]
        ended = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert ended.returncode == 1
    assert len(ended.stderr.splitlines()) == 1
    assert f"cannot listen on port {port} of 127.0.0.1" in ended.stderr


def test_fields_leads_from_a_name_in_json_to_its_attribute(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "argv", ["tribodrive", "fields"])
    main()
    head, *rows = (line.split("\t") for line in capsys.readouterr().out.splitlines())
    assert {len(row) for row in rows} == {len(head)}
    (found,) = (dict(zip(head, row, strict=True)) for row in rows if row[1] == "limits.allowable_misalignment_deg")
    assert found["solver"] == "solvers.coupling.results.Limits.allowable_misalignment"
    assert (found["section"], found["unit"]) == ("Answers", "°")


@pytest.mark.parametrize(("limit", "line"), [(31, "only 31 files may be open at once, fewer than 32"), (32, "")])
def test_too_few_descriptors_are_told(
    limit: int, line: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(resource, "getrlimit", lambda _: (limit, 4096))
    monkeypatch.setattr("app.command.settings", lambda: Settings(port=free_port()))
    monkeypatch.setattr(uvicorn, "run", lambda *_, **__: None)
    serve("app.main:app")
    said = capsys.readouterr().err
    assert line in said
    assert bool(said) == bool(line)


@pytest.mark.parametrize(
    ("proxies", "client"),
    [("", "127.0.0.1"), ("192.0.2.1", "127.0.0.1"), ("192.0.2.1,127.0.0.1", "192.0.2.7"), ("*", "192.0.2.7")],
)
def test_x_forwarded_for_is_believed_from_the_proxies_of_the_settings_alone(
    proxies: str, client: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen: list[Any] = []

    async def application(scope: Any, _receive: Any, _send: Any) -> None:
        seen.append(scope["client"][0])

    monkeypatch.setenv("FORWARDED_ALLOW_IPS", "*")  # uvicorn's own variable
    monkeypatch.setattr("app.command.settings", lambda: Settings(port=free_port(), proxies=proxies))
    monkeypatch.setattr(uvicorn, "run", lambda _, **options: seen.append(uvicorn.Config(application, **options)))
    serve("app.main:app")
    config = seen.pop()
    config.load()
    headers = [(b"x-forwarded-for", b"192.0.2.7")]
    scope = {"type": "http", "client": ("127.0.0.1", 50000), "scheme": "http", "headers": headers}
    asyncio.run(config.loaded_app(scope, None, None))
    assert seen == [client]
