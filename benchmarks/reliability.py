"""Test the reliability of the service: a mixed load while workers and clients fail, tests of faults, and random input.

The script prints a table like the table in the section "Reliability" of benchmarks/README.md. Run from the project's
root: python -m benchmarks.reliability (one minute of load), or with --seconds 600 --faults 2000 (ten minutes of load).
"""

import argparse
import http.client
import json
import random
import re
import signal
import socket
import statistics
import subprocess
import sys
import threading
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import urlsplit

import httpx

from app.examples import examples
from tests.support.server import descendants, descriptors, memory_mb, running_server, send_signal, workers

ROOT = Path(__file__).parents[1]
MIX = (
    "pahl-axial-displacement",
    "pahl-z-arrangement",
    "pahl-recommended-crowning",
    "xue-pair-1-modified",
    "xue-line-contact",
    "xue-pair-1-thermal",
    "milian-case-1",
)
CLIENTS = 3
BECAUSE_OF = {"worker_lost": "killed", "deadline_exceeded": "stopped"}  # the failures that a fault may cause
LEAVING = "127.0.0.9"  # address of the clients that leave
JSON = {"Content-Type": "application/json"}


@dataclass
class Watch:
    """Records of the service under load: outcomes of requests, faults, times and resources."""

    outcomes: Counter[str] = field(default_factory=Counter)
    faults: Counter[str] = field(default_factory=Counter)
    health_ms: list[float] = field(default_factory=list)
    memory_mb: list[float] = field(default_factory=list)
    descriptors: list[int] = field(default_factory=list)
    processes: list[int] = field(default_factory=list)


@dataclass(frozen=True)
class Case:
    """A request of the mixed load, and the bytes of the correct answer."""

    path: str
    body: bytes
    answer: bytes


def cases(address: str) -> list[Case]:
    """Return the requests of the mixed load, with the answers that the service gives without other load."""
    load_cases = []
    for name in MIX:
        example = examples()[name]
        body = json.dumps({**example.request, "detail": "summary"}).encode()
        response = httpx.post(address + example.endpoint, content=body, headers=JSON, timeout=60).raise_for_status()
        load_cases.append(Case(example.endpoint, body, response.content))
    return load_cases


def outcome(connection: http.client.HTTPConnection, case: Case) -> str:
    """Send a request, and return "right", "wrong" or the code of the problem that the service reports."""
    connection.request("POST", case.path, case.body, JSON)
    response = connection.getresponse()
    content = response.read()
    if response.status == 200:
        return "right" if content == case.answer else "wrong"
    return str(json.loads(content)["type"].rsplit(":", 1)[1])


def load(netloc: str, mix: list[Case], seed: int, watch: Watch, done: threading.Event) -> None:
    """Send random requests as one client with its own IP address until `done` is set, and count the outcomes."""
    choice = random.Random(seed)
    connection = http.client.HTTPConnection(netloc, timeout=60, source_address=(f"127.0.0.{2 + seed}", 0))
    while not done.is_set():
        try:
            watch.outcomes[outcome(connection, choice.choice(mix))] += 1
        except (OSError, http.client.HTTPException) as error:
            watch.outcomes[type(error).__name__] += 1
            connection.close()
    connection.close()


def leave(netloc: str, case: Case) -> None:
    """Send a request, and close the connection after 20 ms without reading the answer."""
    host, port = netloc.split(":")
    with socket.create_connection((host, int(port)), timeout=10, source_address=(LEAVING, 0)) as connection:
        head = f"POST {case.path} HTTP/1.1\r\nHost: {netloc}\r\nContent-Type: application/json\r\n"
        connection.sendall(f"{head}Content-Length: {len(case.body)}\r\n\r\n".encode() + case.body)
        time.sleep(0.02)


def health(netloc: str, watch: Watch, done: threading.Event) -> None:
    """Request /healthz about 20 times per second until `done` is set, and record the response times [ms]."""
    connection = http.client.HTTPConnection(netloc, timeout=60)
    while not done.wait(0.05):
        began = time.perf_counter()
        connection.request("GET", "/healthz")
        connection.getresponse().read()
        watch.health_ms.append(1e3 * (time.perf_counter() - began))


def disturb(process: subprocess.Popen[str], mix: list[Case], netloc: str, watch: Watch) -> None:
    """Cause one fault, and record memory, descriptors and processes of the server.

    The faults take turns: kill a worker, leave as a client, stop a worker, leave as a client. If the server has no
    worker, no worker is killed or stopped, but the fault is still counted.
    """
    long = next(case for case in mix if case.path == "/v1/scuffing")
    kind = ("killed", "left", "stopped", "left")[sum(watch.faults.values()) % 4]
    alive = workers(process)
    if kind == "left":
        leave(netloc, long)
    elif alive:
        worker = random.choice(alive)
        send_signal(worker, signal.SIGKILL if kind == "killed" else signal.SIGSTOP)
    watch.faults[kind] += 1
    watch.memory_mb.append(memory_mb(process.pid))
    watch.descriptors.append(descriptors(process.pid))
    watch.processes.append(len(descendants(process.pid)))


def under_load(seconds: int, faults: int) -> Iterator[tuple[str, str]]:
    """Run the mixed load while workers and clients fail, and yield the rows of the table about this load."""
    watch, done = Watch(), threading.Event()
    with running_server(log_level="error") as (process, address):
        netloc = urlsplit(address).netloc
        mix = cases(address)
        threads = [threading.Thread(target=load, args=(netloc, mix, seed, watch, done)) for seed in range(CLIENTS)]
        threads.append(threading.Thread(target=health, args=(netloc, watch, done)))
        for thread in threads:
            thread.start()
        began = time.monotonic()
        for number in range(faults):
            time.sleep(max(0.0, began + (number + 1) * seconds / faults - time.monotonic()))
            disturb(process, mix, netloc, watch)
        done.set()
        for thread in threads:
            thread.join()
        time.sleep(1)
        recovered = httpx.get(f"{address}/readyz", timeout=60).is_success
        left_over = len(descendants(process.pid))
    other = {name: count for name, count in watch.outcomes.items() if name not in {"right", "wrong", *BECAUSE_OF}}
    yield "load", f"{seconds} s, {CLIENTS} clients that check every byte, {len(MIX)} kinds of request"
    yield (
        "workers killed, workers stopped, clients that left",
        ", ".join(str(watch.faults[kind]) for kind in ("killed", "stopped", "left")),
    )
    yield "answers equal to those at rest, bit for bit", str(watch.outcomes["right"])
    yield "wrong answers", str(watch.outcomes["wrong"])
    for name, kind in BECAUSE_OF.items():
        yield f"requests with {name}, workers {kind}", f"{watch.outcomes[name]}, {watch.faults[kind]}"
    yield "any other failure", ", ".join(f"{count} {name}" for name, count in other.items()) or "0"
    yield (
        "/healthz: median, 99th percentile",
        (f"{statistics.median(watch.health_ms):.1f} ms, {statistics.quantiles(watch.health_ms, n=100)[-1]:.1f} ms"),
    )
    yield "memory of the server: first, last", f"{watch.memory_mb[0]:.0f} MB, {watch.memory_mb[-1]:.0f} MB"
    yield "descriptors: first, most, last", f"{watch.descriptors[0]}, {max(watch.descriptors)}, {watch.descriptors[-1]}"
    yield "processes: most, afterwards", f"{max(watch.processes)}, {left_over}"
    yield "answers afterwards", "yes" if recovered else "no"


def under_faults() -> Iterator[tuple[str, str]]:
    """Run the service tests of faults, floods, log and start with pytest, and yield one row of the table per test."""
    suites = ["tests/service/test_faults.py", "tests/service/test_floods.py", "tests/service/test_log.py"]
    command = [sys.executable, "-m", "pytest", "-q", "-m", "service", "-rA", *suites, "tests/service/test_start.py"]
    report = subprocess.run(command, cwd=ROOT, check=False, capture_output=True, text=True).stdout
    for result, name in re.findall(r"^(PASSED|FAILED|ERROR) \S+::test_(\w+)", report, re.MULTILINE):
        yield f"fault: {name.replace('_', ' ')}", "held" if result == "PASSED" else result.lower()


def under_generated_inputs(examples_per_operation: int) -> Iterator[tuple[str, str]]:
    """Run all checks of schemathesis on the OpenAPI document, and yield the rows of the table about these checks."""
    command = [str(Path(sys.executable).with_name("schemathesis")), "run", "--checks", "all"]
    command += ["--max-examples", str(examples_per_operation)]
    with running_server(log_level="error") as (_, address):
        report = subprocess.run(
            [*command, f"{address}/openapi.json"], cwd=ROOT, check=False, capture_output=True, text=True
        ).stdout
    operations = re.search(r"Tested: (\d+)", report)
    generated = re.search(r"(\d+) generated(?:, (\d+) found)?", report)
    if operations is None or generated is None:
        raise RuntimeError(report[-2000:])
    yield "operations tested with generated inputs", operations[1]
    yield "generated inputs", generated[1]
    yield "of them answered against the contract", generated[2] or "0"


def main(seconds: int, faults: int, examples_per_operation: int, *, load_only: bool) -> None:
    """Run the mixed load and, unless `load_only` is set, the service tests and schemathesis. Print the table."""
    print("| tried | what held |\n|---|---|")
    parts = [under_load(seconds, faults)]
    if not load_only:
        parts += [under_faults(), under_generated_inputs(examples_per_operation)]
    for rows in parts:
        for what, figure in rows:
            print(f"| {what} | {figure} |", flush=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=int, default=60, help="duration of the load")
    parser.add_argument("--faults", type=int, default=120, help="faults in it; half of them are clients that leave")
    parser.add_argument("--examples", type=int, default=100, help="generated inputs an operation, at least")
    parser.add_argument("--load-only", action="store_true", help="leave out the fault suite and generated inputs")
    arguments = parser.parse_args()
    main(arguments.seconds, arguments.faults, arguments.examples, load_only=arguments.load_only)
