"""The gears of Milian, Distretti, Leoni and Velex (Gear Technology, May/June 2004), and their operating points.

The tables of the paper do not state face width, backlash, groove width and ambient conditions. These values are
assumed: a face width of 200 mm, a backlash of 0.3 mm, a groove width of 16 mm, and ambient conditions of 101325 Pa and
50 degC. The module in the tables must be the normal module, because only then do the centre distances have the round
values of 590 and 455 mm.
"""

from dataclasses import replace
from functools import cache
from math import pi, radians

from solvers.gears.inputs import GROUND_FILLET, GearPairInputs, GearTeeth
from solvers.pumping import Closure, Flow, Gap, Groove, PumpingInputs, PumpingModel, PumpingResult, PumpingSetup, Spaces
from solvers.pumping.model import solve_on_slices
from solvers.pumping.results import SpacesResult

# The gears of Table 1, of Table 2 (case 1) and of Table 3 (case 2). The text of the paper states the speeds of cases 1
# and 2.
TABLE_1 = GearPairInputs(
    GearTeeth(47, 0.291, 1.0, 1.475),
    GearTeeth(103, 0.322, 1.0, 1.474),
    6.8e-3,
    0.2,
    pressure_angle=radians(22.5),
    rack_tip_radius=GROUND_FILLET,
)
CASE_1 = GearPairInputs(
    GearTeeth(47, 0.16, 0.9919, 1.47921),
    GearTeeth(117, 0.05, 0.9925, 1.47885),
    7e-3,
    0.2,
    pressure_angle=radians(20),
    helix_angle=radians(12.75),
    centre_distance=0.590,
    rack_tip_radius=GROUND_FILLET,
)
CASE_2 = GearPairInputs(
    GearTeeth(52, 0.198, 0.9891, 1.47469),
    GearTeeth(79, 0.21, 0.9894, 1.47507),
    6.8e-3,
    0.2,
    pressure_angle=radians(22.5),
    helix_angle=radians(10),
    centre_distance=0.455,
    rack_tip_radius=GROUND_FILLET,
)
SPEED_1, SPEED_2 = 9267.0, 8962.0  # speed of the pinion [rpm]
GROOVE = (Groove(0.1, 0.016),)  # in the middle of the face, as in the paper; the width of the groove is assumed
PRINTED = PumpingModel(wall_transport=False, spaces=Spaces.PINION)  # the model that the paper's equations describe
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
    """Solve one operating point. `speed` is the speed of the pinion [rpm]. The result is cached."""
    setup = PumpingSetup(gears, backlash, grooves, model=replace(model, slices=slices))
    return solve_on_slices(PumpingInputs(setup, speed * pi / 30))


def pinion(result: PumpingResult) -> SpacesResult:
    """Return the result for the tooth spaces of the pinion. The paper calculates no other tooth spaces."""
    assert result.pinion_spaces is not None
    return result.pinion_spaces
