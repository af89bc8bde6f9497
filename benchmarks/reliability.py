"""What the service survives: a mixed load under wrk while a worker is killed every second. Prints a table. Needs wrk.

python benchmarks/reliability.py
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
from dataclasses import dataclass, field
from pathlib import Path

import httpx

sys.path.insert(0, str(Path(__file__).parents[1]))

from app.library import examples
from tests.server import running_server

MIX = (
    "pahl-axial-displacement",
    "pahl-z-arrangement",
    "pahl-recommended-crowning",
    "xue-pair-1-modified",
    "xue-line-contact",
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


def children(process: subprocess.Popen[str]) -> list[int]:
    """Process ids of the workers."""
    return [int(pid) for pid in Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text("ascii").split()]


def memory_mb(pid: int) -> float:
    """Resident memory of one process."""
    pages = int(Path(f"/proc/{pid}/statm").read_text("ascii").split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 2**20


def kill_workers(process: subprocess.Popen[str], done: threading.Event, watch: Watch) -> None:
    """Kill a random worker every second."""
    while not done.wait(1.0):
        workers = children(process)
        if workers:
            os.kill(random.choice(workers), signal.SIGKILL)
            watch.kills += 1
        watch.memory_mb.append(memory_mb(process.pid))


def main(seconds: int) -> None:
    """Run the load and print the table."""
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
    print("| what | figure |\n|---|---|")
    print(f"| load | {seconds} s, {CONNECTIONS} connections, {len(MIX)} kinds of request |")
    print(f"| workers killed | {watch.kills} |")
    print(f"| right answers | {outcomes['right']} |")
    print(f"| wrong answers | {outcomes['wrong']} |")
    print(f"| requests lost with their worker (503) | {outcomes['worker_lost']} |")
    print(f"| any other failure | {outcomes['other']} |")
    print(f"| memory of the server, first and last | {watch.memory_mb[0]:.0f} MB, {watch.memory_mb[-1]:.0f} MB |")
    print(f"| answers afterwards | {'yes' if recovered else 'no'} |")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=int, default=60)
    main(parser.parse_args().seconds)
