"""Starts the service as a process of its own."""

import os
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import httpx

START_UP_S = 400.0  # kernels are compiled the first time


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port


@contextmanager
def running_server(
    command: list[str] | None = None, *, log: Path | None = None, **settings: object
) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """A server process and its address; settings become environment variables."""
    port = free_port()
    environment = {f"TRIBODRIVE_{name.upper()}": str(value) for name, value in settings.items()}
    with (log or Path(os.devnull)).open("w") as output:
        process = subprocess.Popen(
            command or [sys.executable, "-m", "app"],
            env={**os.environ, **environment, "TRIBODRIVE_PORT": str(port)},
            cwd=Path(__file__).parents[1],
            stdout=output,
            text=True,
        )
        try:
            yield process, _ready(process, f"http://127.0.0.1:{port}")
        finally:
            process.terminate()
            process.wait(40)


def _ready(process: subprocess.Popen[str], address: str) -> str:
    end = time.monotonic() + START_UP_S
    while time.monotonic() < end and process.poll() is None:
        try:
            if httpx.get(f"{address}/readyz", timeout=START_UP_S).status_code == httpx.codes.OK:
                return address
        except httpx.TransportError:
            time.sleep(0.1)
    raise RuntimeError(f"the service did not start: exit code {process.poll()}")


def children(process: subprocess.Popen[Any]) -> list[int]:
    """Process ids of the workers."""
    return [int(pid) for pid in Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text("ascii").split()]


def memory_mb(pid: int) -> float:
    """Resident memory of one process [MiB]."""
    pages = int(Path(f"/proc/{pid}/statm").read_text("ascii").split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 2**20
