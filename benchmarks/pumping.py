"""Times of pumping: geometry table, flow models, choking search, and the compiled gas step against numpy.

Run from the project's root: python -m benchmarks.pumping [--against REVISION]
"""

from collections.abc import Callable
from dataclasses import replace
from math import pi

import numpy as np
from solvers.pumping.flow.record import empty_record
from solvers.pumping.gas.cells import Cells, empty_cells, set_walls
from solvers.pumping.gas.march import march

from benchmarks.pumping_numpy import numpy_step
from benchmarks.timing import Figure, print_times
from solvers.gears.inputs import GearPairInputs
from solvers.gears.pair import gear_pair
from solvers.published.milian import CASE_1, CASE_2
from solvers.pumping import ChokingInputs, Flow, Gap, PumpingInputs, PumpingModel, PumpingSetup, Spaces
from solvers.pumping.choking import choking_speeds
from solvers.pumping.flow.duct import active_range
from solvers.pumping.gas.step import step
from solvers.pumping.model import solve
from solvers.pumping.space.stroke import stroke_table
from solvers.pumping.space.tooth_space import tooth_space
from solvers.pumping.spaces import face_stretches, prepare, space_duct

ONE_SET = PumpingModel(spaces=Spaces.PINION)
SPEED = 9267 * pi / 30


def operating_point(gears: GearPairInputs, rpm: float, model: PumpingModel) -> Callable[[], object]:
    """A solution of one set of spaces."""
    inputs = PumpingInputs(PumpingSetup(gears, model=model), rpm * pi / 30)
    return lambda: solve(inputs)


def mid_stroke() -> tuple[Callable[[], object], Callable[[], object], float]:
    """One gas step of case 1 with all 100 slices active, compiled and in numpy, and their largest difference."""
    mesh = prepare(PumpingSetup(CASE_1, model=ONE_SET))
    space = mesh.spaces[0]
    stretch = face_stretches(mesh.setup, 100)[0]
    part = space_duct(mesh, space, SPEED, stretch, transport=True)
    full = np.linspace(space.table.limits.start, space.lag * stretch.centres[-1] + 0.3 * space.table.limits.start, 81)
    cells = empty_cells(100)
    march(mesh.gas, part, cells, full, empty_record(mesh.gas, full.size, 100, 4000), 2)
    turn = 1e-6 * SPEED
    assert active_range(part, full[-1] + 0.5 * turn) == (0, 100)
    set_walls(part, cells, 0, 100, full[-1], turn)
    other = Cells(*[array.copy() for array in cells])

    def compiled() -> object:
        return step(mesh.gas, part, cells, 0, 100, 1e-6, 2)

    def vectorised() -> object:
        return numpy_step(mesh.gas, part, other, 1e-6)

    compiled()
    vectorised()
    scale = np.abs(cells.next_state).max(axis=0)
    return compiled, vectorised, float((np.abs(cells.next_state - other.next_state) / scale).max())


def figures() -> tuple[Figure, ...]:
    """The rows of the table."""
    space = tooth_space(gear_pair(CASE_1), 0.3e-3, Gap.CONTACT, of_pinion=True)
    chain = replace(ONE_SET, flow=Flow.POCKET_CHAIN)
    search = ChokingInputs(PumpingSetup(CASE_1, model=ONE_SET), 60000 * pi / 30)
    both = ChokingInputs(PumpingSetup(CASE_1), 60000 * pi / 30)
    compiled, vectorised, _ = mid_stroke()
    return (
        Figure("geometry table of one gear, 361 positions", lambda: stroke_table(space), 30.0),
        Figure("gas dynamics, 100 cells, case 1, 9267 rpm", operating_point(CASE_1, 9267, ONE_SET), 18.0),
        Figure("gas dynamics, 100 cells, case 2, 8962 rpm", operating_point(CASE_2, 8962, ONE_SET), 18.0),
        Figure("pocket chain, 10 pockets, case 1", operating_point(CASE_1, 9267, chain), 10.0),
        Figure("choking speeds, one set of spaces", lambda: choking_speeds(search), 1000.0),
        Figure("choking speeds, both sets", lambda: choking_speeds(both), 1000.0),
        Figure("one gas step of 100 cells, compiled", compiled, 0.1),
        Figure("the same in numpy, for comparison", vectorised, 10.0),
    )


if __name__ == "__main__":
    print_times("benchmarks.pumping", figures())
