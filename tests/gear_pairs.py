"""Gear pairs that several scuffing tests share, and loads on them; numbers as the sources print them."""

from dataclasses import replace
from math import radians

from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.scuffing.inputs import Load, LoadDistributionInputs, Model, Modifications, angular_speed, torque_from_power

PAPER_MODEL = Model(contact="linear", section="transverse")
PAPER_MODIFICATIONS = Modifications(profile_crowning=10e-6, lead_crowning=10e-6, tip_relief=5e-6)
HELIX_AND_WIDTH = {1: (9.8, 20.0), 2: (9.8, 40.0), 3: (20.2, 20.0), 4: (20.2, 40.0)}
PAPER_SPEED = angular_speed(2000.0)
PAPER_LOAD = Load(torque_from_power(50e3, PAPER_SPEED), PAPER_SPEED)

# FZG type A (published.md of the specifications): centre distance and profile shifts are rounded.
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


def paper_gears(pair: int) -> GearPairInputs:
    """Gear pair 1 to 4 of Xue, Zhang and Wang, Table 1."""
    helix, width = HELIX_AND_WIDTH[pair]
    return GearPairInputs(
        GearTeeth(23), GearTeeth(30), 3e-3, width * 1e-3, helix_angle=radians(helix), rack_tip_radius=0.38
    )


def paper_pair(
    pair: int, modifications: Modifications | None = None, model: Model = PAPER_MODEL
) -> LoadDistributionInputs:
    """Gear pair 1 to 4 under 50 kW at 2000 1/min."""
    return LoadDistributionInputs(
        gears=paper_gears(pair), load=PAPER_LOAD, modifications=modifications or Modifications(), model=model
    )


def with_torque(inputs: LoadDistributionInputs, torque: float) -> LoadDistributionInputs:
    """The same pair under another pinion torque [N m]."""
    return replace(inputs, load=replace(inputs.load, pinion_torque=torque))


FZG_TORQUES = (3.3, 13.7, 35.25, 60.75, 94.1, 135.3, 183.35, 239.25, 302.0, 372.6, 450.1, 534.5)  # N m, stages 1 to 12
