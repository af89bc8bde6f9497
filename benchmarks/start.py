"""Measure the time from the start command until the service answers, solves a coupling, and has all kernels.

The service starts once with an empty cache of kernels and once with a full cache. Run from the project's root:
python -m benchmarks.start
"""

import os
import tempfile
import time
from contextlib import suppress

import httpx

from app.examples import examples
from tests.support.server import started_server, wait_until_warm

COUPLING = examples()["pahl-axial-displacement"]


def wait_until(client: httpx.Client, method: str, path: str, body: object = None) -> None:
    """Repeat a request until it succeeds."""
    while True:
        with suppress(httpx.TransportError):
            if client.request(method, path, json=body).is_success:
                return
        time.sleep(0.02)


def start(cache: str) -> dict[str, float]:
    """Start the service, and return the times until the service answers, solves a coupling, and is warm [s].

    `cache` is the folder of the cached kernels.
    """
    began = time.perf_counter()
    with (
        started_server(environment={"NUMBA_CACHE_DIR": cache}, log_level="error") as (process, address),
        httpx.Client(base_url=address, timeout=60) as client,
    ):
        times = {}
        wait_until(client, "GET", "/healthz")
        times["port answers"] = time.perf_counter() - began
        wait_until(client, "POST", COUPLING.endpoint, COUPLING.request)
        times["first coupling"] = time.perf_counter() - began
        wait_until_warm(process, address)
        times["everything warm"] = time.perf_counter() - began
        return times


def main() -> None:
    """Measure a start with an empty cache and a start with a warm cache, and print the times."""
    with tempfile.TemporaryDirectory() as cache:
        cold, warm = start(cache), start(cache)
    print(f"| start, {os.cpu_count()} cores | empty cache | warm cache |\n|---|---|---|")
    for what in cold:
        print(f"| {what} | {cold[what]:.1f} s | {warm[what]:.1f} s |")


if __name__ == "__main__":
    main()
