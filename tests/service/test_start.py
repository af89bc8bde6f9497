"""At its first start the service opens at once, solves couplings first and can be stopped; bad caches do no harm."""

import json
import os
import re
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import httpx
import pytest

from app.examples import examples
from tests.support.caches import copy_of_cache
from tests.support.server import (
    FAULTY,
    PATIENCE_S,
    ROOT,
    command_line,
    descendants,
    faulty_server,
    free_port,
    running_server,
    started_server,
    wait_until,
    wait_until_gone,
    wait_until_warm,
)

pytestmark = pytest.mark.service

COUPLING = examples()["pahl-axial-displacement"]
LINE_CONTACT = examples()["xue-line-contact"]


def wait_until_open(address: str) -> None:
    def is_open() -> bool:
        with suppress(httpx.TransportError):
            return httpx.get(f"{address}/healthz", timeout=PATIENCE_S).status_code == 200
        return False

    wait_until(is_open)


def coupling_status(address: str) -> int:
    return httpx.post(address + COUPLING.endpoint, json=COUPLING.request, timeout=PATIENCE_S).status_code


def count_progress(address: str) -> int:
    """Return the number of stages that have begun but are not complete."""
    found = re.findall(r"(\d+) %", httpx.get(f"{address}/readyz", timeout=20).json()["detail"])
    return sum(0 < int(each) < 100 for each in found)


@pytest.mark.ci
def test_cold_start_answers_coupling_first(tmp_path: Path) -> None:
    with started_server(environment={"NUMBA_CACHE_DIR": str(tmp_path)}, log_level="error") as (process, address):
        wait_until_open(address)
        with pytest.raises(httpx.ReadTimeout):  # the request waits for its kernels
            httpx.post(address + LINE_CONTACT.endpoint, json=LINE_CONTACT.request, timeout=1)
        ready = httpx.get(f"{address}/readyz", timeout=5)
        assert ready.status_code == 503
        assert ready.json()["type"].endswith("warming_up")
        assert int(ready.headers["retry-after"]) > 0
        assert "line contact " in ready.json()["detail"]
        wait_until(lambda: coupling_status(address) == 200, 60)
        assert httpx.get(f"{address}/readyz", timeout=5).status_code == 503  # the rest is not warm yet
        wait_until(lambda: count_progress(address) > 0)
        family = descendants(process.pid)
        compiling = [pid for pid in family if " compile " in command_line(pid)]
        assert compiling
        # Ctrl-C in the terminal does not reach them: Python writes a traceback if that interrupts its own start.
        assert os.getpgid(process.pid) not in map(os.getpgid, compiling)
        process.send_signal(signal.SIGINT)
        process.wait(PATIENCE_S)
        wait_until_gone(family)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
@pytest.mark.parametrize("after_s", [0.3, 1.5, 5.0, 9.0])
def test_ends_at_any_moment_of_a_cold_start(tmp_path: Path, number: signal.Signals, after_s: float) -> None:
    """Ctrl-C reaches all processes of the terminal's foreground group. Other signals reach only the service process."""
    log = tmp_path / "log"
    with started_server(environment={"NUMBA_CACHE_DIR": str(tmp_path)}, log=log) as (process, _):
        time.sleep(after_s)
        family = descendants(process.pid)
        (os.killpg if number == signal.SIGINT else os.kill)(process.pid, number)
        process.wait(PATIENCE_S)
        wait_until_gone(family)
    assert "Traceback" not in log.read_text()


@pytest.mark.ci
def test_a_second_interrupt_leaves_no_traceback(tmp_path: Path) -> None:
    log = tmp_path / "log"
    with running_server(log=log) as (process, _):
        process.send_signal(signal.SIGINT)
        time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        assert process.wait(PATIENCE_S) in {0, 130}
    assert "Traceback" not in log.read_text()


@pytest.mark.ci
def test_a_port_in_use_is_told() -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        outcome = subprocess.run(
            [sys.executable, "-m", "app"],
            env={**os.environ, "TRIBODRIVE_PORT": str(port)},
            cwd=ROOT,
            check=False,
            capture_output=True,
            text=True,
            timeout=60,
        )
    assert outcome.returncode == 1
    assert "Address already in use; --port names another port" in outcome.stderr
    assert outcome.stderr.count("\n") == 1


def test_the_image_checks_the_port_it_serves() -> None:
    lines = (ROOT / "Dockerfile").read_text().splitlines()
    instruction = next(line for line in lines if line.startswith("HEALTHCHECK"))
    program, *arguments = json.loads(instruction.partition(" CMD ")[2])
    assert program == "python"
    with faulty_server() as (_, address):
        for port, outcome in ((address.rpartition(":")[2], 0), (str(free_port()), 1)):
            own = {**os.environ, "TRIBODRIVE_PORT": port}
            checked = subprocess.run([sys.executable, *arguments], env=own, check=False, stderr=subprocess.DEVNULL)
            assert checked.returncode == outcome


@pytest.mark.parametrize("after_s", [0.0, 0.2, 1.0, 2.0, 4.0])
def test_interrupts_of_the_start_say_nothing(tmp_path: Path, after_s: float) -> None:
    """The signal is sent `after_s` seconds after the import of `argparse`, one of the first imports of the service."""
    log = tmp_path / "log"
    command = [sys.executable, "-X", "importtime", "-m", "app"]
    with started_server(command, log=log, log_level="error") as (process, _):
        wait_until(lambda: " argparse" in log.read_text())
        time.sleep(after_s)
        family = descendants(process.pid)
        os.killpg(process.pid, signal.SIGINT)
        assert process.wait(PATIENCE_S) == 130
        assert [line for line in log.read_text().splitlines() if not line.startswith("import time:")] == []
        wait_until_gone(family)


@pytest.mark.parametrize("closed", [">&-", "<&- >&- 2>&-", "> >(head -n 1)"])
def test_runs_on_without_standard_streams(closed: str, tmp_path: Path) -> None:
    log = tmp_path / "log"
    command = ["bash", "-c", f"exec {sys.executable} -m app {closed}"]
    with started_server(command, log=log) as (process, address):
        wait_until_warm(process, address)
        for _ in range(3):
            assert httpx.post(address + COUPLING.endpoint, json=COUPLING.request, timeout=20).status_code == 200
    assert "Traceback" not in log.read_text()


@pytest.mark.skipif(not socket.has_dualstack_ipv6(), reason="no IPv6 here")
def test_the_unspecified_address_serves_both_families(tmp_path: Path) -> None:
    """The service treats a client in the same way over IPv4 and over IPv6."""
    # Over both, a proxy that the settings name is trusted: the log shows the client that `X-Forwarded-For` names.
    log = tmp_path / "log"
    with started_server(host="::", log=log, proxies="127.0.0.1") as (_, address):
        addresses = [address, address.replace("127.0.0.1", "[::1]")]
        for each in addresses:
            wait_until_open(each)
            httpx.get(f"{each}/healthz", headers={"X-Forwarded-For": "192.0.2.7"}, timeout=20)
    answered = [json.loads(line)["client"] for line in log.read_text().splitlines() if line.startswith("{")]
    assert set(answered[:-2]) <= {"127.0.0.1", "192.0.2.7"}
    assert answered[-2:] == ["::1", "192.0.2.7"]


def answer_after_a_start(cache: Path, log: Path) -> bytes:
    """Start a service with the kernels in `cache`, and return its answer to a coupling request."""
    # The service loads the kernels of a few stages only.
    with started_server(FAULTY, environment={"NUMBA_CACHE_DIR": str(cache)}, log=log, workers=2) as (process, address):
        wait_until_warm(process, address)
        answer = httpx.post(address + COUPLING.endpoint, json=COUPLING.request, timeout=20)
    assert answer.status_code == 200
    return answer.content


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """Return the answer to a coupling request from undamaged kernels. The log reports no process that died."""
    folder = tmp_path_factory.mktemp("whole")
    copy_of_cache(folder)
    answer = answer_after_a_start(folder, folder / "log")
    assert "died" not in (folder / "log").read_text("utf-8")
    return answer


def machine_code(cache: Path) -> list[Path]:
    """Return the files with the machine code of `tooth_loads`, a module of the coupling."""
    files = machine_code_in(cache)
    assert files
    return files


def machine_code_in(cache: Path) -> list[Path]:
    return sorted(cache.glob("*/tooth_loads.*.nbc"))


def swap(files: list[Path]) -> None:
    contents = [file.read_bytes() for file in files]
    for file, content in zip(files, contents[1:] + contents[:1], strict=True):
        file.write_bytes(content)


def cut(files: list[Path]) -> None:
    for file in files:
        file.write_bytes(file.read_bytes()[:100])


@pytest.mark.parametrize("damage", [cut, swap])
def test_kernels_that_kill_who_loads_them_are_compiled_anew(
    tmp_path: Path, whole: bytes, damage: Callable[[list[Path]], None]
) -> None:
    folder, log = copy_of_cache(tmp_path), tmp_path / "log"
    damage(machine_code(folder))
    assert answer_after_a_start(tmp_path, log) == whole
    assert "a process that compiled kernels died: all are compiled anew" in log.read_text("utf-8")
    assert "died again" not in log.read_text("utf-8")
    assert answer_after_a_start(tmp_path, log) == whole
    assert "died" not in log.read_text("utf-8")


def test_a_folder_that_cannot_be_written_costs_time_alone(tmp_path: Path, whole: bytes) -> None:
    (tmp_path / "file").touch()
    log = tmp_path / "log"
    variables = {"NUMBA_CACHE_DIR": str(tmp_path / "file" / "folder")}
    with started_server(environment=variables, log=log, workers=1) as (process, address):
        wait_until_warm(process, address)
        assert httpx.post(address + COUPLING.endpoint, json=COUPLING.request, timeout=60).content == whole
    assert log.read_text("utf-8").count("compiled kernels are not kept") == 1


READ_ONLY = """
for place in WRITABLE; do mount --bind "$place" "$place"; done
findmnt -rno TARGET | while read -r place; do
    case " WRITABLE " in *" $place "*) ;; *) mount -o remount,bind,ro "$place" ;; esac
done 2>/dev/null
exec "$@"
"""


def on_read_only_disks(*writable: Path) -> list[str]:
    """Return the start command of a service that has no home folder and can write to the given folders only."""
    script = READ_ONLY.replace("WRITABLE", " ".join(map(str, writable)))
    start = ["env", "HOME=/nonexistent", sys.executable, "-m", "app"]
    return ["unshare", "--mount", "sh", "-c", script, "sh", *start]


as_root = pytest.mark.skipif(os.getuid() != 0, reason="root alone can remount folders")


@as_root
@pytest.mark.ci
def test_needs_nothing_to_be_writable_but_the_cache(tmp_path: Path) -> None:
    """Only the cache can be written: there is no home folder, and the temporary folder is read-only."""
    copy_of_cache(tmp_path)
    log = tmp_path / "log"
    variables = {"NUMBA_CACHE_DIR": str(tmp_path)}
    command = on_read_only_disks(tmp_path)
    with started_server(command, log=log, workers=2, environment=variables) as (process, address):
        wait_until_warm(process, address)
        figure = f"{COUPLING.endpoint}/figures/losses.svg"
        assert httpx.post(address + figure, json=COUPLING.request, timeout=60).status_code == 200
    text = log.read_text("utf-8")
    assert "everything is warm" in text
    assert not re.search("not kept|died|Traceback", text)


@as_root
@pytest.mark.ci
def test_kernels_of_a_cache_that_cannot_be_written_are_used(tmp_path: Path) -> None:
    """The kernels of a read-only folder are used and completed in the folder for temporary files."""
    cache, temporary = tmp_path / "cache", tmp_path / "temporary"
    folder = copy_of_cache(cache)
    temporary.mkdir()
    for file in machine_code(folder):
        file.unlink()
    variables = {"NUMBA_CACHE_DIR": str(cache), "TMPDIR": str(temporary)}
    log, command = temporary / "log", on_read_only_disks(temporary)
    with started_server(command, log=log, workers=1, deadline_s=2, environment=variables) as (process, address):
        wait_until_warm(process, address)
        assert httpx.post(address + COUPLING.endpoint, json=COUPLING.request, timeout=60).status_code == 200
        assert httpx.post(address + LINE_CONTACT.endpoint, json=LINE_CONTACT.request, timeout=60).status_code == 200
    assert "every worker compiles" not in log.read_text("utf-8")
    assert not machine_code_in(folder)
    (completed,) = temporary.glob(f"tribodrive-*/{folder.name}")
    assert machine_code(completed)


@as_root
@pytest.mark.ci
def test_a_service_that_cannot_keep_kernels_is_not_ready_before_its_worker(tmp_path: Path) -> None:
    """Neither the cache nor the folder for temporary files can be written, so the worker compiles at its start."""
    cache = tmp_path / "cache"
    cache.mkdir()
    variables = {"NUMBA_CACHE_DIR": str(cache)}
    (tmp_path / "log").touch()
    log, command = tmp_path / "log", on_read_only_disks()
    with started_server(command, log=log, workers=1, environment=variables) as (process, address):
        wait_until_open(address)
        wait_until(lambda: "every worker compiles all of them at its start" in log.read_text("utf-8"))
        until = time.monotonic() + 3.0
        while time.monotonic() < until:
            assert httpx.get(f"{address}/readyz", timeout=20).status_code == 503
            time.sleep(0.2)
        assert httpx.get(f"{address}/healthz", timeout=20).status_code == 200
        process.send_signal(signal.SIGINT)
        process.wait(PATIENCE_S)


@as_root
def test_a_service_that_cannot_keep_kernels_answers_once_its_worker_has_compiled(tmp_path: Path) -> None:
    """Compilation counts against no deadline, so thermal scuffing is answered too."""
    thermal = examples()["xue-pair-1-thermal"]
    variables = {"NUMBA_CACHE_DIR": str(tmp_path / "cache")}
    command = on_read_only_disks()
    with started_server(command, workers=1, deadline_s=20, environment=variables) as (process, address):
        wait_until_warm(process, address)
        assert httpx.post(address + thermal.endpoint, json=thermal.request, timeout=60).status_code == 200


SERVERS = {
    "uvicorn": ["uvicorn", "app.main:app", "--port", "PORT"],
    "uvicorn, two processes": ["uvicorn", "app.main:app", "--port", "PORT", "--workers", "2"],
    "uvicorn, Unix socket": ["uvicorn", "app.main:app", "--uds", "SOCKET"],
    "uvicorn, prefix": ["uvicorn", "app.main:app", "--port", "PORT", "--root-path", "/below"],
    "gunicorn": ["gunicorn", "app.main:app", "-k", "uvicorn_worker.UvicornWorker", "-b", "127.0.0.1:PORT", "-w", "2"],
}


@pytest.mark.parametrize("server", SERVERS)
def test_other_servers_serve_the_application(server: str, tmp_path: Path) -> None:
    log, path = tmp_path / "log", tmp_path / "socket" if "SOCKET" in SERVERS[server] else None
    port = free_port()
    arguments = [word.replace("PORT", str(port)).replace("SOCKET", str(path)) for word in SERVERS[server]]
    processes = 2 if arguments[-1] == "2" else 1
    with started_server([sys.executable, "-m", *arguments], log=log) as (process, _):
        address = f"http://127.0.0.1:{port}"
        if path:  # httpx leaves sockets open that cannot be connected
            wait_until(lambda: "running on" in log.read_text())
        wait_until_warm(process, address, socket=path)

        def ask(method: str, place: str, **options: Any) -> httpx.Response:
            """Send a request on a new connection. Any of the server processes may answer it."""
            with httpx.Client(transport=httpx.HTTPTransport(uds=str(path) if path else None), timeout=60) as client:
                return client.request(method, address + place, **options)

        wait_until(lambda: log.read_text("utf-8").count("everything is warm") == processes, 120)
        answers = {ask("POST", COUPLING.endpoint, json=COUPLING.request).status_code for _ in range(4)}
        assert answers == {200}
        prefix = "/below" if "prefix" in server else ""
        assert f'href="{prefix}/docs"' in ask("GET", "/").text  # a proxy strips the prefix
        family = descendants(process.pid)
        process.terminate()
        process.wait(PATIENCE_S)
        wait_until_gone(family)
    text = log.read_text("utf-8")
    workers_each = max(1, (os.cpu_count() or 2) // processes)
    assert text.count(f"tribodrive: {workers_each} workers") == processes
    assert "Traceback" not in text
