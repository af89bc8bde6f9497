"""A load spectrum of scuffing in closed form: four cases, 128 x 8 machines of six tolerances, on two workers.

Run from the project's root on two cores: taskset -c 0,1 python -m benchmarks.spectrum [--count 128]
"""

import argparse
import copy
import json
import time
from typing import Any

import httpx

from app.studies.requests import EXAMPLES
from tests.support.server import running_server


def main() -> None:
    """Print when the header, the first progress and the end came, and the probability."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=128, help="machines of each of the 8 replicates")
    body: dict[str, Any] = copy.deepcopy(EXAMPLES["/v1/spectrum"]["scuffing"]["value"])
    body["tolerances"] |= {"count": parser.parse_args().count, "replicates": 8}
    with running_server(workers=2, log_level="error") as (_, address):
        wait(address)
        started, times = time.perf_counter(), dict[str, float]()
        with httpx.stream("POST", f"{address}/v1/spectrum", json=body, timeout=600) as response:
            for text in response.iter_lines():
                line = json.loads(text)
                times.setdefault(line["type"], time.perf_counter() - started)
    print(", ".join(f"{kind} after {seconds:.2f} s" for kind, seconds in times.items()))
    (limit,) = line["limits"]
    print(f"{line['points']} solutions, {times['end'] / line['points'] * 1e3:.2f} ms each")
    print(f"probability {limit['probability']:.5f}, interval {limit['interval']}, counts {line['counts']}")


def wait(address: str) -> None:
    """Until every kernel is there, figures and statistics included."""
    while httpx.get(f"{address}/readyz").status_code != 200:
        time.sleep(0.5)


if __name__ == "__main__":
    main()
