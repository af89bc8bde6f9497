"""Measure the time from the start command until the service answers, solves three cases, and has all kernels.

The service starts once with an empty cache of kernels and once with a full cache. Beside each time stands the processor
time that all processes of the service had used by then. Run from the project's root: python -m benchmarks.start
"""

import os
import tempfile
import time
from contextlib import suppress
from pathlib import Path

import httpx

from app.examples import examples
from tests.support.server import descendants, started_server, wait_until_warm

CASES = {
    "first coupling": "pahl-axial-displacement",
    "first scuffing in closed form": "xue-pair-1-scuffing",
    "first drive train in closed form": "starter-turbo-gear-drive-train",
}
TICKS = os.sysconf("SC_CLK_TCK")  # processor time is counted in ticks per second


def wait_until(client: httpx.Client, method: str, path: str, body: object = None) -> None:
    """Repeat a request until it succeeds."""
    while True:
        with suppress(httpx.TransportError):
            if client.request(method, path, json=body).is_success:
                return
        time.sleep(0.02)


def used(pid: int) -> float:
    """Return the processor time that a process, its children and theirs have used, also those that have ended [s]."""
    ticks = 0
    for process in (pid, *descendants(pid)):
        with suppress(OSError):
            ticks += sum(map(int, Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[11:15]))
    return ticks / TICKS


def start(cache: str) -> dict[str, str]:
    """Start the service, and return the times until it answers, solves the cases, and is warm, with processor times.

    `cache` is the folder of the cached kernels.
    """
    began, times = time.perf_counter(), {}
    with (
        started_server(environment={"NUMBA_CACHE_DIR": cache}, log_level="error") as (process, address),
        httpx.Client(base_url=address, timeout=120) as client,
    ):

        def reached(what: str) -> None:
            times[what] = f"{time.perf_counter() - began:.1f} s ({used(process.pid):.0f} s)"

        wait_until(client, "GET", "/healthz")
        reached("port answers")
        for what, name in CASES.items():
            wait_until(client, "POST", examples()[name].endpoint, examples()[name].request)
            reached(what)
        wait_until_warm(process, address)
        reached("everything warm")
    return times


def main() -> None:
    """Measure a start with an empty cache and a start with a warm cache, and print the times."""
    with tempfile.TemporaryDirectory() as cache:
        cold, warm = start(cache), start(cache)
    print(f"| start (processor time), {os.cpu_count()} cores | empty cache | warm cache |\n|---|---|---|")
    for what in cold:
        print(f"| {what} | {cold[what]} | {warm[what]} |")


if __name__ == "__main__":
    main()
