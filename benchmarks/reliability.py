"""What the service survives: a load under wrk with a worker killed each second, faults, generated inputs. Needs wrk.

Prints the table of the README's section "Reliability". Run from the project's root: python -m benchmarks.reliability
"""

import argparse
import json
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import httpx

from app.library import examples
from tests.server import children, memory_mb, running_server

ROOT = Path(__file__).parents[1]
MIX = (
    "pahl-axial-displacement",
    "pahl-z-arrangement",
    "pahl-recommended-crowning",
    "xue-pair-1-modified",
    "xue-line-contact",
    "milian-case-1",
)
CONNECTIONS = 4
JSON = {"Content-Type": "application/json"}
SCRIPT = """
local cases = {}
%s
local next_case, sent = 0, 0
right, wrong, worker_lost, other = 0, 0, 0, 0
threads = {}
function setup(thread) table.insert(threads, thread) end
function request()
  sent = next_case %% #cases + 1
  next_case = next_case + 1
  return wrk.format("POST", cases[sent].path, {["Content-Type"] = "application/json"}, cases[sent].body)
end
function response(status, headers, body)
  if status == 200 then
    if body == cases[sent].answer then right = right + 1 else wrong = wrong + 1 end
  elseif body:find("worker_lost", 1, true) then worker_lost = worker_lost + 1
  else other = other + 1 end
end
function done()
  local total = {right = 0, wrong = 0, worker_lost = 0, other = 0}
  for _, thread in ipairs(threads) do
    for name, count in pairs(total) do total[name] = count + thread:get(name) end
  end
  for name, count in pairs(total) do io.write("outcome ", name, " ", count, "\\n") end
end
"""


@dataclass
class Watch:
    """What happened to the processes while the load ran."""

    kills: int = 0
    memory_mb: list[float] = field(default_factory=list)


def lua(text: str) -> str:
    """A Lua long string."""
    return f"[====[{text}]====]"


def load_script(address: str) -> str:
    """The wrk script: every case with the answer it must get."""
    lines = []
    for name in MIX:
        example = examples()[name]
        body = json.dumps({**example.request, "detail": "summary"})
        answer = httpx.post(address + example.endpoint, content=body, headers=JSON, timeout=60).raise_for_status().text
        lines.append(
            f"table.insert(cases, {{path = {lua(example.endpoint)}, body = {lua(body)}, answer = {lua(answer)}}})"
        )
    return SCRIPT % "\n".join(lines)


def kill_workers(process: subprocess.Popen[str], done: threading.Event, watch: Watch) -> None:
    """Kill a random worker every second."""
    while not done.wait(1.0):
        workers = children(process)
        if workers:
            os.kill(random.choice(workers), signal.SIGKILL)
            watch.kills += 1
        watch.memory_mb.append(memory_mb(process.pid))


def under_load(seconds: int) -> Iterator[tuple[str, str]]:
    """Rows of the table: a mixed load while workers are killed."""
    watch, done = Watch(), threading.Event()
    with (
        running_server(log_level="error") as (process, address),
        tempfile.NamedTemporaryFile("w", suffix=".lua") as script,
    ):
        script.write(load_script(address))
        script.flush()
        killer = threading.Thread(target=kill_workers, args=(process, done, watch))
        killer.start()
        command = [
            "wrk",
            f"-t{CONNECTIONS}",
            f"-c{CONNECTIONS}",
            f"-d{seconds}s",
            "--timeout",
            "60s",
            "-s",
            script.name,
        ]
        report = subprocess.run([*command, address], check=True, capture_output=True, text=True).stdout
        done.set()
        killer.join()
        time.sleep(1)
        recovered = httpx.get(f"{address}/readyz", timeout=60).is_success
    outcomes = {name: int(count) for name, count in re.findall(r"outcome (\w+) (\d+)", report)}
    yield "load", f"{seconds} s, {CONNECTIONS} connections, {len(MIX)} kinds of request, a worker killed each second"
    yield "workers killed", str(watch.kills)
    yield "right answers", str(outcomes["right"])
    yield "wrong answers", str(outcomes["wrong"])
    yield "requests lost with their worker (503)", str(outcomes["worker_lost"])
    yield "any other failure", str(outcomes["other"])
    yield "memory of the server, first and last", f"{watch.memory_mb[0]:.0f} MB, {watch.memory_mb[-1]:.0f} MB"
    yield "answers afterwards", "yes" if recovered else "no"


def under_faults() -> Iterator[tuple[str, str]]:
    """Rows of the table: every scenario of the fault suite."""
    command = [sys.executable, "-m", "pytest", "-q", "-m", "service", "-rA", "tests/service/test_faults.py"]
    report = subprocess.run(command, cwd=ROOT, check=False, capture_output=True, text=True).stdout
    for outcome, name in re.findall(r"^(PASSED|FAILED|ERROR) \S+::test_(\w+)", report, re.MULTILINE):
        yield f"fault: {name.replace('_', ' ')}", "held" if outcome == "PASSED" else outcome.lower()


def under_generated_inputs(examples_per_operation: int) -> Iterator[tuple[str, str]]:
    """Rows of the table: schemathesis with every check over the whole OpenAPI document."""
    command = [Path(sys.executable).with_name("schemathesis"), "run", "--checks", "all"]
    command += ["--max-examples", str(examples_per_operation)]
    with running_server(log_level="error") as (_, address):
        report = subprocess.run(
            [*command, f"{address}/openapi.json"], cwd=ROOT, check=False, capture_output=True, text=True
        ).stdout
    operations = re.search(r"Tested: (\d+)", report)
    cases = re.search(r"(\d+) generated(?:, (\d+) found)?", report)
    if operations is None or cases is None:
        raise RuntimeError(report[-2000:])
    yield "operations tested with generated inputs", operations[1]
    yield "generated inputs", cases[1]
    yield "of them answered against the contract", cases[2] or "0"


def main(seconds: int, examples_per_operation: int) -> None:
    """Run everything and print the table."""
    print("| tried | what held |\n|---|---|")
    for rows in (under_load(seconds), under_faults(), under_generated_inputs(examples_per_operation)):
        for what, figure in rows:
            print(f"| {what} | {figure} |", flush=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=int, default=60, help="duration of the load")
    parser.add_argument("--examples", type=int, default=100, help="generated inputs an operation, at least")
    arguments = parser.parse_args()
    main(arguments.seconds, arguments.examples)
