"""Time per point of a study: single requests, one process without service, one and two workers, a Dask cluster.

Run from the project's root: python -m benchmarks.studies [--seconds 5] [--dask]
"""

import argparse
import asyncio
import json
import time
from collections.abc import Callable
from typing import Any, NamedTuple

import httpx

from app.library import examples
from app.studies.points import Question, solve_point
from app.studies.sweep import plan_sweep
from tests.dask_cluster import running_cluster
from tests.server import running_server


class Kind(NamedTuple):
    """A kind of point: what is asked, what is varied between which ends."""

    name: str
    example: str
    path: str
    start: float
    stop: float

    def body(self, count: int) -> dict[str, Any]:
        """The sweep over this many points."""
        example = examples()[self.example]
        axis = {"path": self.path, "start": self.start, "stop": self.stop, "count": count}
        return {"endpoint": example.endpoint, "request": example.request, "vary": [axis]}


KINDS = (
    Kind("coupling", "pahl-axial-displacement", "operation.misalignment_deg", 0.01, 0.08),
    Kind("load distribution", "xue-pair-1-modified", "modifications.helix_slope_um", -20, 20),
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
    study = plan_sweep(json.dumps(body).encode(), 10**6, 30.0)
    question = Question(body["endpoint"], body["request"], study.outputs.paths, 30.0)
    solve_point(question, study.plan.overrides(0))
    started = time.perf_counter()
    for index in range(study.total):
        solve_point(question, study.plan.overrides(index))
    return time.perf_counter() - started


def single_requests(client: httpx.Client, body: dict[str, Any]) -> float:
    """Seconds of all points as requests of their own, two at a time."""
    study = plan_sweep(json.dumps(body).encode(), 10**6, 30.0)
    return asyncio.run(
        _single_requests(str(client.base_url), body, [study.plan.overrides(i) for i in range(study.total)])
    )


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
        first, last = time.perf_counter() - started, ""
        for last in lines:
            pass
    if json.loads(last)["type"] != "end":
        raise RuntimeError(last)
    return first, time.perf_counter() - started


def table(kinds: list[tuple[Kind, int]], columns: dict[str, Callable[[dict[str, Any]], float]]) -> None:
    """Print milliseconds per point."""
    for name, measure in columns.items():
        cells = [1e3 * measure(kind.body(count)) / count for kind, count in kinds]
        print(f"{name:<34}" + "".join(f"{cell:>20.2f}" for cell in cells), flush=True)


def main(seconds: float, dask: bool) -> None:
    """Measure and print."""
    kinds = []
    for kind in KINDS:
        per_point = in_process(kind.body(3)) / 3
        kinds.append((kind, max(10, min(20_000, round(seconds / per_point)))))
    print(f"{'ms per point':<34}" + "".join(f"{f'{kind.name} ({count})':>20}" for kind, count in kinds))
    table(kinds, {"one process, no service": in_process})
    for workers in (1, 2):
        with (
            running_server(workers=workers, study_points=100_000, log_level="error") as (_, address),
            httpx.Client(base_url=address, timeout=600) as client,
        ):
            study(client, KINDS[0].body(2))
            if workers == 2:
                table(
                    kinds, {"single requests, two workers": lambda body, client=client: single_requests(client, body)}
                )
            table(kinds, {f"study, workers: {workers}": lambda body, client=client: study(client, body)[1]})
            if workers == 2:
                first, whole = study(client, MAP)
                print(f"map of 17 x 11 load distributions: first line {first:.3f} s, all {whole:.2f} s (target 2 s)")
    if dask:
        with (
            running_cluster(2) as cluster,
            running_server(workers=1, study_points=100_000, scheduler=cluster.address, log_level="error") as (
                _,
                address,
            ),
            httpx.Client(base_url=address, timeout=600) as client,
        ):
            study(client, KINDS[0].body(2))
            table(kinds, {"study, Dask workers: 2": lambda body: study(client, body)[1]})


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=5.0, help="of one process for each kind of point")
    parser.add_argument("--dask", action="store_true", help="also a Dask cluster of two processes")
    arguments = parser.parse_args()
    main(arguments.seconds, arguments.dask)
