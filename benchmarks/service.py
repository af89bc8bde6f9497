"""Measure the speed of the service and the memory of its workers.

The script prints requests per second and the 99th percentile of the response time, for endpoints of the service and for
an empty typed endpoint. The script also prints the times of first requests and the memory of the largest worker. Run
from the project's root: python -m benchmarks.service. The program wrk must be installed.
"""

import argparse
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress

import httpx
from fastapi import FastAPI

from app.command import serve
from app.examples import Example, examples
from app.http.routes.service import Health
from app.main import create_app
from app.models.coupling.request import CouplingRequest
from tests.support.server import memory_mb, workers

PORT = 8765
ADDRESS = f"http://127.0.0.1:{PORT}"
EXAMPLE = {**examples()["pahl-axial-displacement"].request, "detail": "summary"}


def with_empty_endpoint(app: FastAPI) -> FastAPI:
    """Add the endpoint /empty to an application. This endpoint validates a coupling request and computes nothing."""

    @app.post("/empty")
    async def empty(_body: CouplingRequest) -> Health:
        return Health()

    routes = app.router.routes
    routes.insert(0, routes.pop())  # first, so that the number of other routes does not matter
    return app


def bare() -> FastAPI:
    """Return an application with the empty endpoint, but without the middleware and the logging of the service."""
    app = with_empty_endpoint(FastAPI())

    @app.get("/readyz")
    async def ready() -> Health:
        return Health()

    return app


def __getattr__(name: str) -> FastAPI:
    """Create the application "bare_app" or "our_app" when uvicorn reads this attribute of the module."""
    match name:
        case "bare_app":
            return bare()
        case "our_app":
            return with_empty_endpoint(create_app())
        case _:
            raise AttributeError(name)


@contextmanager
def served(factory: str) -> Iterator[subprocess.Popen[bytes]]:
    """Run the application "bare" or "ours" in a server process, and yield the process.

    The function first waits until /readyz succeeds, for at most 3000 attempts.
    """
    environment = {**os.environ, "TRIBODRIVE_PORT": str(PORT)}
    command = [sys.executable, "-m", "benchmarks.service", "--serve", factory]
    process = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL)
    try:
        for _ in range(3000):
            with suppress(httpx.TransportError):
                if httpx.get(f"{ADDRESS}/readyz", timeout=60).is_success:
                    break
            time.sleep(0.1)
        yield process
    finally:
        process.terminate()
        process.wait()


def load(path: str, body: object | None, seconds: int, connections: int = 8) -> tuple[float, float]:
    """Send requests with wrk, and return the requests per second and the 99th percentile of the response time [ms]."""
    with tempfile.NamedTemporaryFile("w", suffix=".lua") as script:
        if body is not None:
            content = json.dumps(json.dumps(body))
            script.write('wrk.method = "POST"\nwrk.headers["Content-Type"] = "application/json"\n')
            script.write(f"wrk.body = {content}\n")
            script.flush()
        command = ["wrk", "-t1", f"-c{connections}", f"-d{seconds}s", "--latency", "-s", script.name, ADDRESS + path]
        report = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    if "Non-2xx" in report:
        raise RuntimeError(report)
    rate = re.search(r"Requests/sec:\s+([\d.]+)", report)
    percentile = re.search(r"99%\s+([\d.]+)(us|ms|s)", report)
    assert rate is not None
    assert percentile is not None
    return float(rate[1]), float(percentile[1]) * {"us": 1e-3, "ms": 1.0, "s": 1e3}[percentile[2]]


def milliseconds(client: httpx.Client, example: Example) -> float:
    """Send the request of an example, and return the time until the client has the answer [ms]."""
    start = time.perf_counter()
    client.post(example.endpoint, json=example.request).raise_for_status()
    return 1e3 * (time.perf_counter() - start)


def first_requests() -> None:
    """Print the time of the first request and the median time of later requests for each endpoint.

    Print also the memory of the largest worker after the requests of all examples.
    """
    first_of = {example.endpoint: example for example in reversed(examples().values())}
    with served("ours") as process, httpx.Client(base_url=ADDRESS, timeout=120) as client:
        print(f"\n{'endpoint':<40}{'first ms':>12}{'later ms':>10}")
        for endpoint, example in first_of.items():
            first, *later = (milliseconds(client, example) for _ in range(6))
            print(f"{endpoint:<40}{first:>12.0f}{statistics.median(later):>10.0f}")
        for example in examples().values():
            milliseconds(client, example)
        print(f"largest worker after every example: {max(map(memory_mb, workers(process))):.0f} MB (target 400 MB)")


MEASURED = {
    ("bare", "/empty"): "empty typed endpoint, bare FastAPI",
    ("ours", "/empty"): "empty typed endpoint, this service",
    ("ours", "/healthz"): "/healthz",
    ("ours", "/v1/coupling"): "/v1/coupling, summary (target 500/s)",
}


def best_loads(seconds: int, rounds: int) -> dict[tuple[str, str], tuple[float, float]]:
    """Measure each case in several rounds. Return its highest rate [requests/s] and lowest 99th percentile [ms].

    The cases are the keys of `MEASURED`. In each round, the two applications run one after the other.
    """
    loads: dict[tuple[str, str], list[tuple[float, float]]] = {case: [] for case in MEASURED}
    for _ in range(rounds):
        for factory in ("bare", "ours"):
            with served(factory):
                for case in MEASURED:
                    if case[0] == factory:
                        body = None if case[1] == "/healthz" else EXAMPLE
                        loads[case].append(load(case[1], body, seconds))
    return {case: (max(rate for rate, _ in rounds), min(late for _, late in rounds)) for case, rounds in loads.items()}


def main(seconds: int, rounds: int) -> None:
    """Measure the loads and the first requests, and print the results."""
    best = best_loads(seconds, rounds)
    print(f"{'endpoint':<40}{'requests/s':>12}{'p99 ms':>10}")
    for case, name in MEASURED.items():
        rate, percentile = best[case]
        print(f"{name:<40}{rate:>12.0f}{percentile:>10.1f}")
    share = best["ours", "/v1/coupling"][0] / best["bare", "/empty"][0]
    print(f"/v1/coupling answers at {share:.0%} of the empty typed endpoint of bare FastAPI (target 60 %)")
    cost = 1 - best["ours", "/empty"][0] / best["bare", "/empty"][0]
    print(f"middleware and logging cost {cost:.0%} of the bare application (target 25 %)")
    first_requests()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--serve", choices=["bare", "ours"], help="serve instead of measuring")
    parser.add_argument("--seconds", type=int, default=5, help="duration of each load")
    parser.add_argument("--rounds", type=int, default=3, help="of which the best counts")
    arguments = parser.parse_args()
    if arguments.serve:
        serve("benchmarks.service:" + {"bare": "bare_app", "ours": "our_app"}[arguments.serve])
    else:
        main(arguments.seconds, arguments.rounds)
