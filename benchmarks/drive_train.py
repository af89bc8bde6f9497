"""Time of an answer of the drive train, alone and in its studies, for the worked example.

Run from the project's root: python -m benchmarks.drive_train. Kernels are warm and the pumped gas is known but where it
says otherwise; the best of several repeats counts.
"""

from collections.abc import Callable
from dataclasses import replace
from time import perf_counter

from solvers.drive_train import solve
from solvers.drive_train.gap.thermal_lead import gas_heat
from solvers.drive_train.studies.corners import default_ranges, run_corners, single
from solvers.drive_train.studies.design import Variable, design
from solvers.drive_train.studies.outcome import outcome
from tests.support.drive_trains import COUPLING, GROUND, SPEED, turbo_gear

REPEATS = 20
SHAPE = "mesh.distribution.modifications"
INPUTS = replace(turbo_gear(GROUND), coupling_friction="elastic_plastic")


def best(run: Callable[[], object], repeats: int = REPEATS) -> float:
    """Shortest of the repeats [s], after one to warm the kernels: other work on the machine only adds."""
    run()
    times = []
    for _ in range(repeats):
        start = perf_counter()
        run()
        times.append(perf_counter() - start)
    return min(times)


def pumped() -> None:
    """The gas anew."""
    gas_heat.cache_clear()
    gas_heat(INPUTS.pumping, SPEED)


def all_corners() -> None:
    """256 runs: the default ranges and two heights of tip relief."""
    ranges = (*default_ranges(INPUTS), single(f"{SHAPE}.tip_relief", (12e-6, 18e-6)))
    found = run_corners(INPUTS, ranges)
    assert (found.runs, found.failed) == (256, 0)


def search() -> None:
    """The example's design search: 12 corners, 3 variables."""
    machines = tuple(
        (replace(COUPLING, friction=replace(COUPLING.friction, coefficient=friction), offset=(0.0, offset)),)
        for friction, offset in ((0.05, 400e-6), (0.25, 400e-6), (0.25, -400e-6))
    )
    torque = INPUTS.mesh.distribution.load.pinion_torque
    design(
        INPUTS,
        [
            Variable((f"{SHAPE}.helix_slope",), 0.0, 100e-6),
            Variable((f"{SHAPE}.lead_crowning",), 0.0, 20e-6),
            Variable((f"{SHAPE}.tip_relief", f"{SHAPE}.root_relief"), 0.0, 30e-6),
        ],
        [single("couplings", machines), single("heat.wall_response", (0.3, 0.9))],
        collective=[{"mesh.distribution.load.pinion_torque": share * torque} for share in (1.0, 0.5)],
    )


def main() -> None:
    """Print the table."""
    start = outcome(INPUTS).gap
    print(f"{'figure':<52}{'measured':>12}{'target':>12}")
    rows: list[tuple[str, Callable[[], object], int, float, str]] = [
        ("pumped gas", pumped, 3, 1e3, "ms"),
        ("answer without thermal film, gas known", lambda: solve(INPUTS), REPEATS, 1e3, "ms"),
        ("figures of a study, cold start", lambda: outcome(INPUTS), REPEATS, 1e3, "ms"),
        ("figures of a study, from a neighbour", lambda: outcome(INPUTS, start), REPEATS, 1e3, "ms"),
        ("256 corners", all_corners, 1, 1.0, "s"),
        ("design search over 12 corners", search, 1, 1.0, "s"),
    ]
    targets = {"answer without thermal film, gas known": 60, "256 corners": 10, "design search over 12 corners": 60}
    for name, run, repeats, scale, unit in rows:
        print(f"{name:<52}{best(run, repeats) * scale:>9.1f} {unit:<2}{targets.get(name, ''):>9} {unit}")


if __name__ == "__main__":
    main()
