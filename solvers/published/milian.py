"""The gears of Milian, Distretti, Leoni and Velex (Gear Technology, May/June 2004), and their operating points.

The tables give no face width, backlash, groove width or ambient conditions. A face width of 200 mm, a backlash of 0.3
mm, a groove width of 16 mm, and ambient conditions of 101325 Pa and 50 degC are assumed. The module of the tables must
be the normal module, because only then do the centre distances have the round values of 590 and 455 mm.
"""

from dataclasses import replace
from functools import cache
from math import pi, radians

from solvers.gears.inputs import GROUND_FILLET, GearPairInputs, GearTeeth
from solvers.pumping import Closure, Flow, Gap, Groove, PumpingInputs, PumpingModel, PumpingResult, PumpingSetup, Spaces
from solvers.pumping.model import solve
from solvers.pumping.results import SpacesResult

# Gears of Table 1, and gears of Tables 2 and 3. The speeds for Tables 2 and 3 are stated in the text of the paper.
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
SPEED_1, SPEED_2 = 9267.0, 8962.0  # rpm of the pinion
GROOVE = (Groove(0.1, 0.016),)  # in the middle of the face, as in the paper; the width of the groove is assumed
PRINTED = PumpingModel(wall_transport=False, spaces=Spaces.PINION)  # the model of the paper's equations
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
    """Solve one operating point at a speed [rpm] of the pinion; the result is cached."""
    setup = PumpingSetup(gears, backlash, grooves, model=replace(model, slices=slices))
    return solve(PumpingInputs(setup, speed * pi / 30))


def pinion(result: PumpingResult) -> SpacesResult:
    """Return the result for the tooth spaces of the pinion; the paper calculates no other spaces."""
    assert result.pinion_spaces is not None
    return result.pinion_spaces
