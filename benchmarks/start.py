"""How fast the service is there: empty cache to first answer and to everything warm, warm start, a new worker.

Run from the project's root: python -m benchmarks.start
"""

import os
import signal
import statistics
import tempfile
import time
from contextlib import suppress

import httpx

from app.examples import examples
from tests.support.server import (
    memory_mb,
    private_memory_mb,
    send_signal,
    started_server,
    template,
    wait_until_warm,
    workers,
)

COUPLING = examples()["pahl-axial-displacement"]
FORKS = 50


def wait_until(client: httpx.Client, method: str, path: str, body: object = None) -> None:
    """Repeat a request until it succeeds."""
    while True:
        with suppress(httpx.TransportError):
            if client.request(method, path, json=body).is_success:
                return
        time.sleep(0.02)


def start(cache: str) -> dict[str, float]:
    """Measure the times from the command until the port is open, a coupling is solved and everything is warm [s]."""
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


def new_workers(cache: str) -> tuple[list[float], float, float, float]:
    """Measure the replacement of killed workers.

    Returns the times until a killed worker is replaced [ms], the private memory of a new and of a used worker, and the
    resident memory of a worker [MB].
    """
    with started_server(environment={"NUMBA_CACHE_DIR": cache}, workers=1, log_level="error") as (process, address):
        wait_until_warm(process, address)
        source = template(process)
        fresh = private_memory_mb(workers(process)[0])
        with httpx.Client(base_url=address, timeout=60) as client:
            for example in examples().values():
                client.post(example.endpoint, json=example.request).raise_for_status()
        used = private_memory_mb(workers(process)[0])
        times = []
        for _ in range(FORKS):
            (old,) = workers(process)
            began = time.perf_counter()
            send_signal(old, signal.SIGKILL)
            while (now := workers(process)) == [old] or len(now) != 1:
                time.sleep(0.0005)
            times.append(1e3 * (time.perf_counter() - began))
            assert template(process) == source
        return times, fresh, used, memory_mb(workers(process)[0])


def main() -> None:
    """Measure and print the table."""
    with tempfile.TemporaryDirectory() as cache:
        cold, warm = start(cache), start(cache)
        replacement, fresh, used, resident = new_workers(cache)
    print(f"| start, {os.cpu_count()} cores | empty cache | warm cache |\n|---|---|---|")
    for what in cold:
        print(f"| {what} | {cold[what]:.1f} s | {warm[what]:.1f} s |")
    print("\n| worker | measured |\n|---|---|")
    print(
        f"| killed and replaced: median, slowest of {FORKS} | "
        f"{statistics.median(replacement):.0f} ms, {max(replacement):.0f} ms |"
    )
    print(f"| private memory: new, after every example | {fresh:.0f} MB, {used:.0f} MB |")
    print(f"| resident memory, shared included | {resident:.0f} MB |")


if __name__ == "__main__":
    main()
