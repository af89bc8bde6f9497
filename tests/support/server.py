"""Functions that start the service in a separate process and observe the processes of the service."""

import os
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import AbstractContextManager, contextmanager, suppress
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import httpx

ROOT = Path(__file__).parents[2]
START_UP_S = 1200.0  # kernels are compiled the first time, by several services side by side
FAULTY = [sys.executable, "-m", "tests.support.faulty_server"]  # run, never imported: it patches the service
HANGING = 1234.5  # a varied value whose point never ends there
LONG, LONG_S = 987.5, 3.0  # one whose point takes three seconds
NAP, NAP_S = 876.5, 0.2  # and one whose point takes a fifth of a second
PATIENCE_S = 30.0
"""Longest time that a test waits for an event [s]. On idle cores the event takes well below a second.

The tests only check that the event happens; the scripts in `benchmarks` measure times.
"""
Server = tuple[subprocess.Popen[str], str]
"""The process of a server, and the URL of the server."""


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port


@contextmanager
def started_server(
    command: list[str] | None = None,
    *,
    log: Path | int | None = None,
    environment: dict[str, str] | None = None,
    **settings: object,
) -> Iterator[Server]:
    """Start a server and yield its process and its URL, without waiting until the server is ready."""
    # The settings are passed as environment variables. At the end of the context, the process is stopped.
    port = free_port()
    variables = {f"TRIBODRIVE_{name.upper()}": str(value) for name, value in settings.items()}
    output = log if isinstance(log, int) else (log or Path(os.devnull)).open("w")
    process = subprocess.Popen(
        command or [sys.executable, "-m", "app"],
        env={**os.environ, **variables, **(environment or {}), "TRIBODRIVE_PORT": str(port)},
        cwd=ROOT,
        stdout=output,
        stderr=output if log else None,
        text=True,
        process_group=0,
    )
    try:
        yield process, f"http://127.0.0.1:{port}"
    finally:
        process.terminate()
        with suppress(subprocess.TimeoutExpired):
            process.wait(40)
        process.kill()
        process.wait()
        if not isinstance(output, int):
            output.close()


@contextmanager
def running_server(
    command: list[str] | None = None, *, log: Path | None = None, **settings: object
) -> Iterator[Server]:
    """Start a server, and yield its process and its URL when all calculations are ready."""
    with started_server(command, log=log, **settings) as (process, address):
        wait_until_warm(process, address)
        yield process, address


def faulty_server(**settings: Any) -> AbstractContextManager[Server]:
    """Return a context that runs the service with additional endpoints that misbehave.

    At the start, this service loads only the kernels of the coupling and of the load distribution.
    """
    return running_server(FAULTY, **{"log_level": "info" if "log" in settings else "error", **settings})


def wait_until(condition: Callable[[], bool], seconds: float = PATIENCE_S) -> None:
    """Wait until a condition holds. Fail if the condition does not hold within the given time [s]."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)


@contextmanager
def meanwhile(*works: Callable[[], object]) -> Iterator[None]:
    """Call each function repeatedly while the context is open. Each function runs in a separate thread."""
    done = threading.Event()

    def repeat(work: Callable[[], object]) -> None:
        while not done.is_set():
            work()

    with ThreadPoolExecutor(len(works)) as pool:
        flights = [pool.submit(repeat, work) for work in works]
        try:
            yield
        finally:
            done.set()
        for flight in flights:
            flight.result()


def metric(address: str, name: str) -> float:
    """Return the value of a metric of the service. The metric must not have labels."""
    lines = httpx.get(f"{address}/metrics", timeout=PATIENCE_S).text.splitlines()
    return float(next(line.split()[1] for line in lines if line.startswith(f"{name} ")))


def wait_for_metric(address: str, name: str, value: float) -> None:
    wait_until(lambda: metric(address, name) == value)


def wait_until_warm(
    process: subprocess.Popen[str], address: str, seconds: float = START_UP_S, socket: Path | None = None
) -> None:
    end = time.monotonic() + seconds
    transport = httpx.HTTPTransport(uds=str(socket) if socket else None)
    # A new client each time would take part of a core.
    with httpx.Client(base_url=address, timeout=seconds, transport=transport) as client:
        while time.monotonic() < end and process.poll() is None:
            with suppress(httpx.TransportError):
                if client.get("/readyz").status_code == httpx.codes.OK:
                    return
            time.sleep(0.1)
    raise RuntimeError(f"the service did not start: exit code {process.poll()}")


def children(pid: int) -> list[int]:
    """Return the process ids of the children of a process."""
    with suppress(OSError):
        return [int(child) for child in Path(f"/proc/{pid}/task/{pid}/children").read_text("ascii").split()]
    return []


def workers(process: subprocess.Popen[Any]) -> list[int]:
    """Return the process ids of the workers of a server."""
    return [child for child in children(process.pid) if "anyio.to_process" in command_line(child)]


def descendants(pid: int) -> set[int]:
    """Return the ids of the children of a process, of their children, and so on."""
    found = set(children(pid))
    return found.union(*map(descendants, found))


def command_line(pid: int) -> str:
    with suppress(OSError):
        return Path(f"/proc/{pid}/cmdline").read_text().replace("\0", " ")
    return ""


def wait_until_gone(pids: Iterable[int]) -> None:
    """Wait until none of the processes runs. A zombie process does not count as running."""
    left = set(pids)
    wait_until(lambda: not any(map(is_alive, left)))


def is_alive(pid: int) -> bool:
    """Return whether a process runs. A zombie process does not count as running."""
    with suppress(OSError):
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    return False


def descriptors(pid: int) -> int:
    """Return the number of open file descriptors of a process, including sockets."""
    return len(list(Path(f"/proc/{pid}/fd").iterdir()))


def memory_mb(pid: int) -> float:
    """Return the resident memory of one process [MiB]."""
    pages = int(Path(f"/proc/{pid}/statm").read_text("ascii").split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 2**20


def send_signal(pid: int, number: signal.Signals) -> None:
    """Send a signal to a process. Do nothing if the process no longer exists."""
    with suppress(ProcessLookupError):
        os.kill(pid, number)


def connected(address: str) -> socket.socket:
    """Open a TCP connection to the server at this URL, and return the socket."""
    target = urlsplit(address)
    return socket.create_connection((target.hostname, target.port), timeout=10)


def answer_to(connection: socket.socket) -> bytes:
    """Return all bytes that the service sends before the connection is closed, fails or times out."""
    received = b""
    with suppress(OSError):
        while piece := connection.recv(65536):
            received += piece
    return received
