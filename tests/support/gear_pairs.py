"""Several tests share these gear pairs and loads. Published numbers are given as the sources print them."""

from dataclasses import replace
from math import radians

from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.scuffing.inputs import LoadDistributionInputs

# FZG type A as standards print it: centre distance and profile shifts are rounded.
FZG_A = GearPairInputs(
    GearTeeth(16, 0.8532, (88.8 / 2 - 36) / 4.5 - 0.8532),
    GearTeeth(24, -0.5, (112.5 / 2 - 54) / 4.5 + 0.5),
    4.5e-3,
    20e-3,
    centre_distance=91.5e-3,
    rack_tip_radius=0.38,
)
# Diametral pitch 3, its centre distance printed in hundredths of a millimetre, 7e-5 below 25.4/3 (20 + 31) / 2.
INCH_PAIR = GearPairInputs(
    GearTeeth(20), GearTeeth(31), 25.4e-3 / 3, 60e-3, centre_distance=215.89e-3, rack_tip_radius=0.38
)
# The wheel's tip reaches past the pinion's base tangent point.
UNDERCUT_PAIR = GearPairInputs(GearTeeth(12), GearTeeth(60), 2e-3, 20e-3, helix_angle=radians(15), rack_tip_radius=0.38)


def with_torque(inputs: LoadDistributionInputs, torque: float) -> LoadDistributionInputs:
    """Return the same gear pair under another pinion torque [N m]."""
    return replace(inputs, load=replace(inputs.load, pinion_torque=torque))


FZG_TORQUES = (3.3, 13.7, 35.25, 60.75, 94.1, 135.3, 183.35, 239.25, 302.0, 372.6, 450.1, 534.5)  # N m, stages 1 to 12
