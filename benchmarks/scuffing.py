"""Time of a load distribution with its 200 x 100 flank map, of a scuffing check, and of a relief sweep.

Run from the project's root: python -m benchmarks.scuffing. Kernels are warm; the best of several repeats counts.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import product
from math import radians
from time import perf_counter

from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.scuffing import solve_load_distribution, solve_scuffing
from solvers.scuffing.inputs import (
    Load,
    LoadDistributionInputs,
    Model,
    Modifications,
    Resolution,
    ScuffingInputs,
    angular_speed,
)

REPEATS = 60
SPEED = angular_speed(2000)
MODIFIED = Modifications(profile_crowning=10e-6, lead_crowning=10e-6, tip_relief=5e-6)
MAP = Resolution(profile_points=200, face_points=100)
SWEEP = Resolution(roll_positions=60, slices=40, profile_points=41, face_points=21, feature_points=5)


def paper_pair(width: float, helix: float, model: Model, modifications: Modifications) -> LoadDistributionInputs:
    """A pair of Xue, Zhang and Wang at 50 kW and 2000 1/min."""
    gears = GearPairInputs(GearTeeth(23), GearTeeth(30), 3e-3, width, helix_angle=radians(helix), rack_tip_radius=0.38)
    return LoadDistributionInputs(gears, Load(50e3 / SPEED, SPEED), modifications, model=model, resolution=MAP)


def best(run: Callable[[], object]) -> float:
    """Shortest of the repeats [ms], after one to warm the kernels: other work on the machine only adds."""
    run()
    times = []
    for _ in range(REPEATS):
        start = perf_counter()
        run()
        times.append(perf_counter() - start)
    return min(times) * 1e3


def relief_designs() -> Iterator[Modifications]:
    """5^4 designs of tip relief, its length, profile crowning and lead crowning."""
    for relief, length, profile, lead in product(range(5), range(1, 6), range(5), range(5)):
        yield Modifications(
            tip_relief=relief * 5e-6,
            tip_relief_length=length * 1e-3,
            profile_crowning=profile * 3e-6,
            lead_crowning=lead * 4e-6,
        )


def sweep_seconds(model: Model) -> float:
    """Time of all designs one after the other [s]."""
    inputs = replace(paper_pair(20e-3, 9.8, model, MODIFIED), resolution=SWEEP)
    solve_load_distribution(inputs)
    start = perf_counter()
    for design in relief_designs():
        solve_load_distribution(replace(inputs, modifications=design))
    return perf_counter() - start


def main() -> None:
    """Print the table."""
    linear, half_space = Model(contact="linear"), Model()
    print(f"{'figure':<58}{'measured':>12}{'target':>12}")
    for name, model, target in (("linear", linear, 6), ("half-space", half_space, 15)):
        for width, helix in ((20e-3, 9.8), (40e-3, 20.2)):
            for label, shape in (("unmodified", Modifications()), ("modified", MODIFIED)):
                inputs = paper_pair(width, helix, model, shape)
                figure = f"solve, {name}, {label}, {width * 1e3:.0f} mm at {helix} deg"
                print(f"{figure:<58}{best(lambda i=inputs: solve_load_distribution(i)):>9.2f} ms{target:>9} ms")  # type: ignore[misc]
    scuffing = ScuffingInputs(paper_pair(20e-3, 9.8, half_space, MODIFIED), lubrication="closed_form")
    print(f"{'scuffing in closed form, half-space':<58}{best(lambda: solve_scuffing(scuffing)):>9.2f} ms{20:>9} ms")
    for name, model in (("linear", linear), ("half-space", half_space)):
        seconds = sweep_seconds(model)
        print(f"{f'sweep of 625 relief designs, {name}':<58}{seconds:>9.2f} s {3:>9} s")
        print(f"{'  designs a second':<58}{625 / seconds:>9.0f}{'':>12}")


if __name__ == "__main__":
    main()
