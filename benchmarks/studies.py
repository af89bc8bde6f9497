"""Time per point of a study: single requests, one process without service, one and two workers, a Dask cluster.

Run from the project's root: python -m benchmarks.studies [--seconds 5] [--dask]
"""

import argparse
import asyncio
import copy
import json
import time
from collections import deque
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from typing import Any, NamedTuple

import httpx

from app.calculations import BY_PATH
from app.examples import examples
from app.studies.fields import set_value
from app.studies.kinds.sweep import Sweep
from app.studies.points import Question, solve_point
from app.studies.runner import paths_of
from tests.support.dask_cluster import running_cluster
from tests.support.server import running_server


class Kind(NamedTuple):
    """A kind of point: what is asked, with what fixed, what is varied between which ends."""

    name: str
    example: str
    path: str
    start: float
    stop: float
    fixed: Mapping[str, float] = {}

    def body(self, count: int) -> dict[str, Any]:
        """The sweep over this many points."""
        example = examples()[self.example]
        request = copy.deepcopy(example.request)
        for path, value in self.fixed.items():
            set_value(BY_PATH[example.endpoint].request, request, path, value)
        axis = {"path": self.path, "start": self.start, "stop": self.stop, "count": count}
        return {"endpoint": example.endpoint, "request": request, "vary": [axis]}


KINDS = (
    Kind("coupling", "pahl-axial-displacement", "operation.misalignment_deg", 0.01, 0.08),
    Kind("load distribution", "xue-pair-1-modified", "modifications.helix_slope_um", -20, 20),
    Kind("gas dynamics", "milian-case-1", "operation.pinion_speed_rpm", 9000, 9500, {"model.slices": 180}),
    Kind("thermal path", "xue-pair-1-thermal", "temperatures.bulk_c", 60, 100),
)
MAP = {
    "endpoint": examples()["xue-pair-1-modified"].endpoint,
    "request": examples()["xue-pair-1-modified"].request,
    "vary": [
        {"path": "modifications.helix_slope_um", "start": -20, "stop": 20, "count": 17},
        {"path": "modifications.lead_crowning_um", "start": 0, "stop": 20, "count": 11},
    ],
    "outputs": ["pressure.max_mpa", "load.face_load_factor"],
}


def in_process(body: dict[str, Any]) -> float:
    """Seconds of all points one after another in this process."""
    study = Sweep(body, 10**6, 30.0)
    question = Question(body["endpoint"], body["request"], paths_of(study.outputs), 30.0)
    solve_point(question, study.points.overrides(0))
    started = time.perf_counter()
    for index in range(study.total):
        solve_point(question, study.points.overrides(index))
    return time.perf_counter() - started


def in_two_processes(body: dict[str, Any]) -> float:
    """Seconds of all points by two processes that do nothing else: what two cores of this machine are worth."""
    with ProcessPoolExecutor(2) as pool:
        return sum(pool.map(in_process, [body, body])) / 4


def single_requests(client: httpx.Client, body: dict[str, Any]) -> float:
    """Seconds of all points as requests of their own, two at a time."""
    points = Sweep(body, 10**6, 30.0).points
    overrides = [points.overrides(index) for index in range(points.total)]
    return asyncio.run(_single_requests(str(client.base_url), body, overrides))


async def _single_requests(address: str, body: dict[str, Any], points: list[dict[str, Any]]) -> float:
    waiting = iter(points)

    async def one_after_another(client: httpx.AsyncClient) -> None:
        for overrides in waiting:
            request = json.loads(json.dumps({**body["request"], "detail": "summary"}))
            for path, value in overrides.items():
                section, name = path.split(".")
                request.setdefault(section, {})[name] = value
            (await client.post(body["endpoint"], json=request)).raise_for_status()

    async with httpx.AsyncClient(base_url=address, timeout=60) as client:
        started = time.perf_counter()
        await asyncio.gather(one_after_another(client), one_after_another(client))
        return time.perf_counter() - started


def study(client: httpx.Client, body: dict[str, Any]) -> tuple[float, float]:
    """Seconds to the first line and to the end."""
    started = time.perf_counter()
    with client.stream("POST", "/v1/sweep", json=body) as response:
        response.raise_for_status()
        lines = response.iter_lines()
        next(lines)
        first = time.perf_counter() - started
        (last,) = deque(lines, maxlen=1)
    if json.loads(last)["type"] != "end":
        raise RuntimeError(last)
    return first, time.perf_counter() - started


@contextmanager
def served(**settings: object) -> Iterator[httpx.Client]:
    """A client of a service that has run its first study."""
    with (
        running_server(study_points=100_000, log_level="error", **settings) as (_, address),
        httpx.Client(base_url=address, timeout=600) as client,
    ):
        study(client, KINDS[0].body(2))
        yield client


def table(kinds: list[tuple[Kind, int]], name: str, measure: Callable[[dict[str, Any]], float]) -> list[float]:
    """Print and return milliseconds per point."""
    cells = [1e3 * measure(kind.body(count)) / count for kind, count in kinds]
    print(f"{name:<34}" + "".join(f"{cell:>20.2f}" for cell in cells), flush=True)
    return cells


def share(name: str, bound: list[float], reached: list[float]) -> None:
    """Print what part of the possible is reached."""
    print(
        f"{name:<34}" + "".join(f"{best / cell:>20.0%}" for best, cell in zip(bound, reached, strict=True)), flush=True
    )


def main(seconds: float, dask: bool) -> None:
    """Measure and print."""
    kinds = []
    for kind in KINDS:
        per_point = in_process(kind.body(3)) / 3
        kinds.append((kind, max(10, min(20_000, round(seconds / per_point)))))
    print(f"{'ms per point':<34}" + "".join(f"{f'{kind.name} ({count})':>20}" for kind, count in kinds))
    alone = table(kinds, "one process, no service", in_process)
    both = table(kinds, "two processes, no service", in_two_processes)
    with served(workers=1) as client:
        one = table(kinds, "study, one worker", lambda body: study(client, body)[1])
    with served(workers=2) as client:
        two = table(kinds, "study, two workers", lambda body: study(client, body)[1])
        table(kinds, "single requests, two workers", lambda body: single_requests(client, body))
        first, whole = study(client, MAP)
    share("one worker, of one process", alone, one)
    share("two workers, of two processes", both, two)
    share("two workers, of twice one worker", [cell / 2 for cell in one], two)
    if dask:
        with running_cluster(2) as cluster, served(workers=1, scheduler=cluster.address) as client:
            remote = table(kinds, "study, two Dask workers", lambda body: study(client, body)[1])
            share("two Dask workers, of two workers", two, remote)
    print(f"map of 17 x 11 load distributions: first line {first:.3f} s (0.3 s), all {whole:.2f} s (2 s)")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=5.0, help="of one process for each kind of point")
    parser.add_argument("--dask", action="store_true", help="also a Dask cluster of two processes")
    arguments = parser.parse_args()
    main(arguments.seconds, arguments.dask)
