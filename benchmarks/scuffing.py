"""Print the run times of the load distribution, of a scuffing check, and of a sweep over 625 relief designs.

Each single load distribution includes a flank map of 200 x 100 points.

Run from the project's root: python -m benchmarks.scuffing [--against REVISION]
"""

from collections.abc import Iterator
from dataclasses import replace
from itertools import product
from math import radians

from benchmarks.timing import Figure, print_times
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.lubricants import Lubricant
from solvers.scuffing.inputs import (
    Load,
    LoadDistributionInputs,
    Model,
    Modifications,
    Resolution,
    ScuffingInputs,
    Temperatures,
    angular_speed,
)
from solvers.scuffing.model import solve as solve_load_distribution
from solvers.scuffing.safety import solve_scuffing

SPEED = angular_speed(2000)
MODIFIED = Modifications(profile_crowning=10e-6, lead_crowning=10e-6, tip_relief=5e-6)
MAP = Resolution(profile_points=200, face_points=100)
SWEEP = Resolution(roll_positions=60, slices=40, profile_points=41, face_points=21, feature_points=5)


def paper_pair(width: float, helix: float, model: Model, modifications: Modifications) -> LoadDistributionInputs:
    """Return a gear pair of Xue, Zhang and Wang at 50 kW and 2000 1/min; `width` is in [m] and `helix` in [deg]."""
    gears = GearPairInputs(GearTeeth(23), GearTeeth(30), 3e-3, width, helix_angle=radians(helix), rack_tip_radius=0.38)
    return LoadDistributionInputs(gears, Load(50e3 / SPEED, SPEED), modifications, model=model, resolution=MAP)


def relief_designs() -> Iterator[Modifications]:
    """Yield 5^4 designs that differ in tip relief, length of the tip relief, profile crowning and lead crowning."""
    for relief, length, profile, lead in product(range(5), range(1, 6), range(5), range(5)):
        yield Modifications(
            tip_relief=relief * 5e-6,
            tip_relief_length=length * 1e-3,
            profile_crowning=profile * 3e-6,
            lead_crowning=lead * 4e-6,
        )


def sweep(model: Model) -> None:
    """Compute the load distributions of all relief designs, one design after another."""
    inputs = replace(paper_pair(20e-3, 9.8, model, MODIFIED), resolution=SWEEP)
    for design in relief_designs():
        solve_load_distribution(replace(inputs, modifications=design))


def figures() -> Iterator[Figure]:
    """Yield a `Figure` for each row of the printed table."""
    models = (("linear", Model(contact="linear"), 3.0), ("half-space", Model(), 6.0))
    for name, model, target in models:
        for width, helix in ((20e-3, 9.8), (40e-3, 20.2)):
            for label, shape in (("unmodified", Modifications()), ("modified", MODIFIED)):
                inputs = paper_pair(width, helix, model, shape)
                figure = f"solve, {name}, {label}, {width * 1e3:.0f} mm at {helix} deg"
                yield Figure(figure, lambda inputs=inputs: solve_load_distribution(inputs), target)  # type: ignore[misc]
    scuffing = ScuffingInputs(
        paper_pair(20e-3, 9.8, Model(), MODIFIED),
        lubrication="closed_form",
        lubricant=Lubricant(),
        friction="given",
        temperatures=Temperatures(bulk=360.0, bulk_method="given"),
    )
    yield Figure("scuffing in closed form, half-space", lambda: solve_scuffing(scuffing), 20.0)
    for name, model, _ in models:
        yield Figure(f"sweep of 625 relief designs, {name}", lambda model=model: sweep(model), 3000.0)  # type: ignore[misc]


if __name__ == "__main__":
    print_times("benchmarks.scuffing", tuple(figures()))
