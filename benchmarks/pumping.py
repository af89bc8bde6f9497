"""Print the run times of the pumping model: geometry table, flow models, and search for choking speeds.

Run from the project's root: python -m benchmarks.pumping [--against REVISION]
"""

from collections.abc import Callable
from dataclasses import replace
from math import pi

from benchmarks.published.milian import CASE_1, CASE_2
from benchmarks.timing import Figure, print_times
from solvers.gears.inputs import GearPairInputs
from solvers.gears.pair import gear_pair
from solvers.pumping import ChokingInputs, Flow, Gap, PumpingInputs, PumpingModel, PumpingSetup, Spaces
from solvers.pumping.choking import choking_speeds
from solvers.pumping.model import solve
from solvers.pumping.space.stroke import stroke_table
from solvers.pumping.space.tooth_space import tooth_space

ONE_SET = PumpingModel(spaces=Spaces.PINION)


def operating_point(gears: GearPairInputs, rpm: float, model: PumpingModel) -> Callable[[], object]:
    """Return a function that solves the pumping of a gear pair at this speed of the pinion [1/min]."""
    inputs = PumpingInputs(PumpingSetup(gears, model=model), rpm * pi / 30)
    return lambda: solve(inputs)


def figures() -> tuple[Figure, ...]:
    """Return a `Figure` for each row of the printed table."""
    space = tooth_space(gear_pair(CASE_1), 0.3e-3, Gap.CONTACT, of_pinion=True)
    chain = replace(ONE_SET, flow=Flow.POCKET_CHAIN)
    search = ChokingInputs(PumpingSetup(CASE_1, model=ONE_SET), 60000 * pi / 30)
    both = ChokingInputs(PumpingSetup(CASE_1), 60000 * pi / 30)
    return (
        Figure("geometry table of one gear, 361 positions", lambda: stroke_table(space), 30.0),
        Figure("gas dynamics, 100 cells, case 1, 9267 rpm", operating_point(CASE_1, 9267, ONE_SET), 18.0),
        Figure("gas dynamics, 100 cells, case 2, 8962 rpm", operating_point(CASE_2, 8962, ONE_SET), 18.0),
        Figure("pocket chain, 10 pockets, case 1", operating_point(CASE_1, 9267, chain), 10.0),
        Figure("choking speeds, one set of spaces", lambda: choking_speeds(search), 1000.0),
        Figure("choking speeds, both sets", lambda: choking_speeds(both), 1000.0),
    )


if __name__ == "__main__":
    print_times("benchmarks.pumping", figures())
