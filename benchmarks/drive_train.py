"""Print the run times of the drive train and of its studies for the worked example.

Run from the project's root: python -m benchmarks.drive_train. The kernels are warm. The results of the pumped gas are
cached, except in the row "pumped gas". Each printed time is the shortest of 20 runs of the solver, of 3 runs of the
pumped gas, or the time of one run of a study.
"""

import asyncio
from collections.abc import Callable
from dataclasses import replace
from time import perf_counter
from typing import Any

from app.calculations import BY_PATH
from app.examples import examples, study_bodies
from app.studies.kinds.corners import Corners
from app.studies.kinds.design import Design
from app.studies.point_sets import usual_corners
from app.studies.runner import Clock, Study
from solvers.drive_train.gap.thermal_lead import gas_heat
from solvers.drive_train.outcome import outcome
from solvers.drive_train.states import solve
from tests.support.drive_trains import GROUND, SPEED, turbo_gear
from tests.support.pools import InlinePool

REPEATS = 20
INPUTS = replace(turbo_gear(GROUND), coupling_friction="elastic_plastic")
REQUEST = {**examples()["starter-turbo-gear-drive-train"].request, "model": {"lubrication": "closed_form"}}
USUAL = list(usual_corners(BY_PATH["/v1/drive-train"].request.model_validate(REQUEST)).values())


def best(run: Callable[[], object], repeats: int = REPEATS) -> float:
    """Return the shortest time of the repeated runs [s].

    One run before the repeated runs warms the kernels. The shortest time counts, because other work only adds time.
    """
    run()
    times = []
    for _ in range(repeats):
        start = perf_counter()
        run()
        times.append(perf_counter() - start)
    return min(times)


def solve_gas() -> None:
    """Clear the cache of the pumped gas, and compute the pumped gas again."""
    gas_heat.cache_clear()
    gas_heat(INPUTS.pumping, SPEED)


def corners() -> None:
    """Solve the 128 usual corners at two heights of tip relief (256 runs), one run after another."""
    ranges = [
        *(axis.model_dump(exclude_none=True) for axis in USUAL),
        {"path": "modifications.tip_relief_um", "values": [12, 18]},
    ]
    run(Corners, {"request": REQUEST, "ranges": ranges, "outputs": ["safety.blok_flank"]})


def search() -> None:
    """Run the design search of the example, with 12 corners and 3 variables."""
    run(Design, {**study_bodies("/v1/drive-train/design")["robust"]["value"], "request": REQUEST})


def run(study_of: Callable[[Any, int, float], Study], body: dict[str, Any]) -> None:
    """Run the study with this body in this process, and discard the lines of the study."""

    async def lines() -> None:
        study = study_of(body, 2500, 60.0)
        async for _ in study.lines(InlinePool(), Clock(study.total)):
            pass

    asyncio.run(lines())


def main() -> None:
    """Measure the run times, and print them in a table beside the targets."""
    start = outcome(INPUTS).gap
    print(f"{'figure':<52}{'measured':>12}{'target':>12}")
    rows: list[tuple[str, Callable[[], object], int, float, str]] = [
        ("pumped gas", solve_gas, 3, 1e3, "ms"),
        ("answer without thermal film, gas known", lambda: solve(INPUTS), REPEATS, 1e3, "ms"),
        ("figures of a study, cold start", lambda: outcome(INPUTS), REPEATS, 1e3, "ms"),
        ("figures of a study, from a neighbour", lambda: outcome(INPUTS, start), REPEATS, 1e3, "ms"),
        ("256 corners", corners, 1, 1.0, "s"),
        ("design search over 12 corners", search, 1, 1.0, "s"),
    ]
    targets = {"answer without thermal film, gas known": 60, "256 corners": 10, "design search over 12 corners": 60}
    for name, run, repeats, scale, unit in rows:
        print(f"{name:<52}{best(run, repeats) * scale:>9.1f} {unit:<2}{targets.get(name, ''):>9} {unit}")


if __name__ == "__main__":
    main()
