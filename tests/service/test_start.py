"""The first start: open at once, coupling first, stoppable at any moment; and a cache in every state of disrepair."""

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
    PATIENCE_S,
    ROOT,
    children,
    command_line,
    descendants,
    faulty_server,
    free_port,
    running_server,
    started_server,
    template,
    wait_until,
    wait_until_gone,
    wait_until_warm,
    workers,
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


def test_cold_start_answers_coupling_first(tmp_path: Path) -> None:
    with started_server(environment={"NUMBA_CACHE_DIR": str(tmp_path)}, log_level="error") as (process, address):
        wait_until_open(address)
        waiting = httpx.post(address + LINE_CONTACT.endpoint, json=LINE_CONTACT.request, timeout=20)
        assert waiting.status_code == 503
        assert waiting.json()["type"].endswith("warming_up")
        assert int(waiting.headers["retry-after"]) > 0
        assert "line contact 0 %" in waiting.json()["detail"]
        ready = httpx.get(f"{address}/readyz", timeout=5)
        assert ready.status_code == 503
        assert "coupling" in ready.json()["detail"]
        wait_until(lambda: coupling_status(address) == 200, 60)  # 7 s on quiet cores, everything 80 s
        assert httpx.get(f"{address}/readyz", timeout=5).status_code == 503  # the rest is not warm yet
        family = descendants(process.pid)
        process.send_signal(signal.SIGINT)
        process.wait(PATIENCE_S)
        wait_until_gone(family)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
@pytest.mark.parametrize("after_s", [0.3, 1.5, 5.0])
def test_ends_at_any_moment_of_a_cold_start(tmp_path: Path, number: signal.Signals, after_s: float) -> None:
    log = tmp_path / "log"
    with started_server(environment={"NUMBA_CACHE_DIR": str(tmp_path)}, log=log) as (process, _):
        time.sleep(after_s)
        family = descendants(process.pid)
        process.send_signal(number)
        process.wait(PATIENCE_S)
        wait_until_gone(family)
    assert "Traceback" not in log.read_text()


def test_a_second_interrupt_leaves_no_traceback(tmp_path: Path) -> None:
    log = tmp_path / "log"
    with running_server(log=log) as (process, _):
        process.send_signal(signal.SIGINT)
        time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        assert process.wait(PATIENCE_S) in {0, 130}
    assert "Traceback" not in log.read_text()


def test_port_in_use_is_said_at_once() -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        outcome = subprocess.run(
            [sys.executable, "-m", "app"],
            env={**os.environ, "TRIBODRIVE_PORT": str(port)},
            cwd=ROOT,
            check=False,
            capture_output=True,
            text=True,
            timeout=PATIENCE_S,
        )
    assert outcome.returncode == 1
    assert outcome.stderr == f"tribodrive: cannot listen on port {port} of 127.0.0.1: Address already in use\n"
    assert outcome.stdout == ""


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


@pytest.mark.parametrize("after_s", [0.0, 0.05, 0.2, 0.5, 1.0, 2.0])
def test_interrupts_of_the_start_say_nothing(tmp_path: Path, after_s: float) -> None:
    """Ctrl-C reaches all processes of the terminal's foreground group. Counted from the first import of the service."""
    log = tmp_path / "log"
    command = [sys.executable, "-X", "importtime", "-m", "app"]
    with started_server(command, log=log, log_level="error") as (process, _):
        wait_until(lambda: " argparse" in log.read_text())
        time.sleep(after_s)
        family = descendants(process.pid)
        os.killpg(process.pid, signal.SIGINT)
        assert process.wait(PATIENCE_S) == 130
        assert [line for line in log.read_text().splitlines() if not line.startswith("import time:")] == []
        wait_until_gone(family)  # the template ends when its interpreter has started


@pytest.mark.parametrize("closed", [">&-", "<&- >&- 2>&-", "> >(head -n 1)"])
def test_runs_on_without_standard_streams(closed: str, tmp_path: Path) -> None:
    log = tmp_path / "log"
    command = ["bash", "-c", f"exec {sys.executable} -m app {closed}"]
    with started_server(command, log=log) as (process, address):
        wait_until_warm(process, address, 60)
        for _ in range(3):
            assert httpx.post(address + COUPLING.endpoint, json=COUPLING.request, timeout=20).status_code == 200
    assert "Traceback" not in log.read_text()


@pytest.mark.skipif(not socket.has_dualstack_ipv6(), reason="no IPv6 here")
def test_the_unspecified_address_serves_both_families(tmp_path: Path) -> None:
    """A client is the same by either, and so is a proxy on this machine, whose word for the client counts."""
    log = tmp_path / "log"
    with started_server(host="::", log=log) as (_, address):
        addresses = [address, address.replace("127.0.0.1", "[::1]")]
        for each in addresses:
            wait_until_open(each)
            httpx.get(f"{each}/healthz", headers={"X-Forwarded-For": "192.0.2.7"}, timeout=20)
    answered = [json.loads(line)["client"] for line in log.read_text().splitlines() if line.startswith("{")]
    assert set(answered[:-2]) <= {"127.0.0.1", "192.0.2.7"}
    assert answered[-2:] == ["::1", "192.0.2.7"]


def answer_after_a_start(cache: Path, log: Path, seconds: float = 120) -> bytes:
    """What the service answers to a coupling with this cache."""
    with started_server(environment={"NUMBA_CACHE_DIR": str(cache)}, log=log, workers=2) as (process, address):
        wait_until_warm(process, address, seconds)
        answer = httpx.post(address + COUPLING.endpoint, json=COUPLING.request, timeout=20)
    assert answer.status_code == 200
    return answer.content


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """The answer with kernels that nobody damaged, about which nothing is said."""
    folder = tmp_path_factory.mktemp("whole")
    answer = answer_after_a_start(copy_of_cache(folder / "cache"), folder / "log")
    assert not re.search("broken|died", (folder / "log").read_text("utf-8"))
    return answer


def machine_code(cache: Path) -> list[Path]:
    """The files of one module of the coupling."""
    files = sorted(cache.glob("tooth_loads-*/*.nbc"))
    assert len(files) > 5
    return files


def swap(files: list[Path]) -> None:
    contents = [file.read_bytes() for file in files]
    for file, content in zip(files, contents[1:] + contents[:1], strict=True):
        file.write_bytes(content)


def flip_a_bit(files: list[Path]) -> None:
    content = bytearray(files[0].read_bytes())
    content[len(content) // 2] ^= 1
    files[0].write_bytes(content)


def cut(files: list[Path]) -> None:
    for file in files:
        file.write_bytes(file.read_bytes()[:100])


@pytest.mark.parametrize("damage", [flip_a_bit, cut])
def test_damaged_kernels_are_noticed_and_compiled_again(
    tmp_path: Path, whole: bytes, damage: Callable[[list[Path]], None]
) -> None:
    cache, log = copy_of_cache(tmp_path / "cache"), tmp_path / "log"
    damage(machine_code(cache))
    assert answer_after_a_start(cache, log) == whole
    lines = [line for line in log.read_text("utf-8").splitlines() if "broken kernel cache" in line]
    assert lines
    assert all("tooth_loads-" in line for line in lines)
    assert answer_after_a_start(cache, log, 60) == whole
    assert "broken" not in log.read_text("utf-8")


def test_kernels_over_which_the_template_dies_twice_are_compiled_again(tmp_path: Path, whole: bytes) -> None:
    """Damage of which no digest tells."""
    cache, log = copy_of_cache(tmp_path / "cache"), tmp_path / "log"
    for digest in cache.glob("*/sha256"):
        digest.unlink()
    swap(machine_code(cache))
    assert answer_after_a_start(cache, log) == whole
    lines = [line for line in log.read_text("utf-8").splitlines() if "compiled again" in line]
    assert lines == ["two processes died while they loaded coupling: its kernels are compiled again"]
    assert answer_after_a_start(cache, log, 60) == whole
    assert "died" not in log.read_text("utf-8")


WITHOUT_ROOM = """
import resource
resource.setrlimit(resource.RLIMIT_FSIZE, (10_000, 10_000))
from app.calculations import COUPLING
from app.workers.stages import warm
print(warm(COUPLING), warm(COUPLING))
"""


def test_kernels_that_cannot_be_written_are_compiled_in_memory(tmp_path: Path) -> None:
    """As on a full disk; they count as missing each time."""
    for _ in range(2):
        outcome = subprocess.run(
            [sys.executable, "-c", WITHOUT_ROOM],
            env={**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)},
            cwd=ROOT,
            check=True,
            capture_output=True,
            text=True,
        )
        first, second = map(int, outcome.stdout.split())
        assert first > 2
        assert second == 0
        assert "could not be kept on disk" in outcome.stderr


READ_ONLY = """
findmnt -rno TARGET | while read -r place; do mount -o remount,bind,ro "$place"; done 2>/dev/null
exec "$@"
"""


@pytest.mark.skipif(os.getuid() != 0, reason="root alone can remount folders")
def test_needs_nothing_that_can_be_written(tmp_path: Path) -> None:
    """No temporary folder, no home, and compiled kernels."""
    (tmp_path / "tribodrive").mkdir()
    copy_of_cache(tmp_path / "tribodrive" / "kernels")
    own = ["env", "-u", "NUMBA_CACHE_DIR", f"XDG_CACHE_HOME={tmp_path}", "HOME=/nonexistent"]
    command = ["unshare", "--mount", "sh", "-c", READ_ONLY, "sh", *own, sys.executable, "-m", "app"]
    log = tmp_path / "log"
    with started_server(command, log=log, workers=2) as (process, address):
        wait_until_warm(process, address, 60)
        assert children(process.pid) == [template(process)]  # nothing else compiles
        assert len(workers(process)) == 2
        figure = f"{COUPLING.endpoint}/figures/losses.svg"
        assert httpx.post(address + figure, json=COUPLING.request, timeout=20).status_code == 200
    text = log.read_text("utf-8")
    assert "everything is warm" in text
    assert not re.search("compiled|not on disk|Traceback", text)


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
        wait_until_warm(process, address, 120, path)

        def ask(method: str, place: str, **options: Any) -> httpx.Response:
            """An answer on a connection of its own, to whichever server process takes it."""
            with httpx.Client(transport=httpx.HTTPTransport(uds=str(path) if path else None), timeout=60) as client:
                return client.request(method, address + place, **options)

        wait_until(lambda: log.read_text("utf-8").count("served by another server") == processes, 120)
        answers = {ask("POST", COUPLING.endpoint, json=COUPLING.request).status_code for _ in range(4)}
        assert answers <= {200, 503}  # the other process may still be loading
        assert 200 in answers
        prefix = "/below" if "prefix" in server else ""
        assert f'href="{prefix}/docs"' in ask("GET", "/").text  # a proxy strips the prefix
        family = descendants(process.pid)
        templates = [pid for pid in family if len(children(pid)) and "app.workers.processes" in command_line(pid)]
        assert len(templates) == processes
        assert sum(len(children(pid)) for pid in templates) <= max(processes, os.cpu_count() or 2)
        process.terminate()
        process.wait(PATIENCE_S)
        wait_until_gone(family)
    text = log.read_text("utf-8")
    workers_each = max(1, (os.cpu_count() or 2) // processes)
    assert text.count(f"served by another server with {workers_each} workers: limits of headers, conn") == processes
    assert "Traceback" not in text
