"""The gears of Milian, Distretti, Leoni, Velex (Gear Technology, May/June 2004), and how the tests run them.

The tables give no face width, backlash, groove width or ambient: 200 mm, 0.3 mm, 16 mm, 101325 Pa and 50 degC are
assumed. The tables' module is the normal module: only then are the centre distances the round 590 and 455 mm.
"""

from dataclasses import replace
from functools import cache
from math import pi

from solvers.gears.inputs import GearPairInputs
from solvers.pumping import (
    Closure,
    Flow,
    Gap,
    Groove,
    PumpingInputs,
    PumpingModel,
    PumpingResult,
    PumpingSetup,
    Spaces,
    solve,
)
from solvers.pumping.results import SpacesResult

SPEED_1, SPEED_2 = 9267.0, 8962.0  # rpm of the pinion
GROOVE = (Groove(0.1, 0.016),)
PRINTED = PumpingModel(wall_transport=False, spaces=Spaces.PINION)  # what the reference numbers were computed with
TIP = replace(PRINTED, gap=Gap.TIP)
CHAIN = replace(PRINTED, flow=Flow.POCKET_CHAIN)
ISENTROPIC = replace(CHAIN, closure=Closure.ISENTROPIC)
INCOMPRESSIBLE = replace(TIP, flow=Flow.INCOMPRESSIBLE)


@cache
def run(
    gears: GearPairInputs,
    speed: float,
    model: PumpingModel = PRINTED,
    slices: int | None = None,
    backlash: float = 0.3e-3,
    grooves: tuple[Groove, ...] = (),
) -> PumpingResult:
    """One operating point at a speed in rpm; solved once in a test session."""
    setup = PumpingSetup(gears, backlash, grooves, model=replace(model, slices=slices))
    return solve(PumpingInputs(setup, speed * pi / 30))


def pinion(result: PumpingResult) -> SpacesResult:
    """The pinion's spaces, which are the paper's."""
    assert result.pinion_spaces is not None
    return result.pinion_spaces
