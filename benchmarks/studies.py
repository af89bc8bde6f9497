"""Solve drive trains on two processes in three ways, and compare their rates: python -m benchmarks.studies [points].

Without a study, points go to a `ProcessPoolExecutor` one by one, as fast as two processes can be; a study goes through
the `map` of such an executor, and through that of a Dask client with two local workers. The ways take turns, each with
other points, because the speed of a shared machine drifts. Kernels are loaded before.
"""

import os
import sys
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from math import inf
from multiprocessing import get_context
from time import perf_counter
from typing import Any

from distributed import Client, LocalCluster

from app.examples import examples
from app.studies import study
from app.studies.kinds.sweep import Sweep
from app.studies.points import solve_point
from app.workers.worker import ONE_THREAD

TURNS = 4
UNIT = examples()["starter-turbo-gear-drive-train"]
RANGES = [
    {"path": "modifications.helix_slope_um", "min": 20, "max": 80},
    {"path": "couplings.0.friction.coefficient", "min": 0.05, "max": 0.25},
]


def sample(count: int, seed: int) -> dict[str, Any]:
    """Return a sweep over random points of the unit, without the thermal film."""
    return {
        "endpoint": UNIT.endpoint,
        "request": UNIT.request | {"model": {"lubrication": "closed_form"}},
        "sample": {"count": count, "seed": seed, "ranges": RANGES},
        "outputs": ["load.face_load_factor", "safety.blok_flank"],
    }


def without_study(processes: ProcessPoolExecutor, body: dict[str, Any]) -> None:
    """Solve the points of a sweep one by one."""
    plan = Sweep(body, 1_000_000, inf)
    points = [plan.points.overrides(index) for index in range(plan.total)]
    assert all(point.error is None for point in processes.map(partial(solve_point, plan.question), points))


def by_study(mapping: Callable[..., Any], body: dict[str, Any]) -> None:
    """Solve a sweep."""
    assert list(study("/v1/sweep", body, map=mapping))[-1]["type"] == "end"


def main() -> None:
    """Take turns, and print the rate of each way."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 2000
    os.environ.update(ONE_THREAD)
    spawned = partial(ProcessPoolExecutor, 2, get_context("spawn"))
    with (
        spawned() as bare,
        spawned() as processes,
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as cluster,
        Client(cluster) as client,
    ):
        ways: dict[str, Callable[[dict[str, Any]], None]] = {
            "points one by one, executor": partial(without_study, bare),
            "study, executor": partial(by_study, processes.map),
            "study, Dask": partial(by_study, client.map),
        }
        seconds = dict.fromkeys(ways, 0.0)
        for solve in ways.values():
            solve(sample(16, 0))  # kernels are loaded
        for turn in range(TURNS):
            order = list(ways) if turn % 2 else list(reversed(ways))
            for way in order:
                started = perf_counter()
                ways[way](sample(count // TURNS, 1 + turn))
                seconds[way] += perf_counter() - started
                print(f"turn {turn + 1}, {way}: {seconds[way]:.1f} s", flush=True)
        load = os.getloadavg()[0]
    base = min(seconds["points one by one, executor"], seconds["study, executor"])
    for way, total in seconds.items():
        print(f"{way:<30}{count / total:>8.1f} points/s{base / total:>8.0%}")
    print(f"{count} points each in {TURNS} turns, load of the machine {load:.1f}")


if __name__ == "__main__":
    main()
