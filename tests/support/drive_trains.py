"""The worked example of a turbo gear unit: 12 MW, 10,000 1/min, 39/130, with a gear coupling on its pinion."""

from collections.abc import Mapping
from dataclasses import replace
from math import pi, radians
from typing import Any

from solvers.coupling.inputs import Coupling, Friction
from solvers.drive_train.inputs import (
    DriveTrainInputs,
    Effects,
    Heat,
    JournalBearing,
    Shaft,
    ShaftSection,
    UnitCoupling,
)
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.lubricants import Lubricant
from solvers.materials import Solid
from solvers.pumping.inputs import PumpingSetup
from solvers.scuffing.inputs import (
    Load,
    LoadDistributionInputs,
    Modifications,
    ScuffingInputs,
    Temperatures,
)

SPEED = 10000 * pi / 30
CELSIUS = 273.15
PLAIN = Modifications(tip_relief=15e-6, root_relief=15e-6, tip_relief_length=6e-3, root_relief_length=6e-3)
GROUND = replace(PLAIN, helix_slope=50e-6, lead_crowning=4e-6)


def _sections(*mm: tuple[float, float]) -> tuple[ShaftSection, ...]:
    return tuple(ShaftSection(length * 1e-3, diameter * 1e-3) for length, diameter in mm)


PINION_SHAFT = Shaft(
    sections=_sections((150, 130), (140, 160), (30, 190), (200, 238.8), (30, 190), (150, 160)),
    bearings=tuple(JournalBearing(z, 0.16, 0.11, 0.014, 130e-6) for z in (0.22, 0.62)),
    torque_position=0.02,
)
WHEEL_SHAFT = Shaft(
    start=0.12,
    sections=_sections((170, 200), (30, 260), (200, 700), (30, 260), (350, 200)),
    bearings=tuple(JournalBearing(z, 0.2, 0.14, 0.018, 150e-6) for z in (0.21, 0.63)),
    torque_position=0.88,
)
COUPLING = UnitCoupling(
    shaft="pinion",
    position=0.02,
    machine_side="minus",
    coupling=Coupling(
        teeth=60,
        module=3e-3,
        face_width=30e-3,
        tooth_height=6e-3,
        crowning_ratio=4.0,
        hub_distance=0.4,
        sleeve_mass=12.0,
    ),
    friction=Friction(coefficient=0.15),
    offset=(0.0, 400e-6),
)
HEAT = Heat(0.6, pinion_bulk=95 + CELSIUS, wheel_bulk=80 + CELSIUS, reference=20 + CELSIUS)


def turbo_gear(modifications: Modifications = PLAIN, power: float = 12e6) -> DriveTrainInputs:
    """The example with a flank as drawn, or another; thermal film left out."""
    gears = GearPairInputs(GearTeeth(39), GearTeeth(130), 6e-3, 0.2, helix_angle=radians(11.5), rack_tip_radius=0.38)
    distribution = LoadDistributionInputs(
        gears,
        Load(power / SPEED, SPEED),
        modifications,
        pinion_material=Solid(roughness=0.4e-6),
        wheel_material=Solid(roughness=0.4e-6),
        friction_coefficient=0.04,
    )
    mesh = ScuffingInputs(
        distribution,
        lubricant=Lubricant(0.0095, 360.0, 16e-9, 0.03, 850.0),
        temperatures=Temperatures(bulk=95 + CELSIUS, oil=50 + CELSIUS, scuffing=220 + CELSIUS),
        lubrication="closed_form",
    )
    return DriveTrainInputs(
        mesh=mesh,
        pumping=PumpingSetup(replace(gears, rack_tip_radius=0.25)),
        face_start=0.32,
        pinion_shaft=PINION_SHAFT,
        wheel_shaft=WHEEL_SHAFT,
        couplings=(COUPLING,),
        heat=HEAT,
        coupling_friction="sliding",
    )


NO_EFFECTS = Effects(shafts=False, coupling=False, thermal=False)


def cold(inputs: DriveTrainInputs) -> DriveTrainInputs:
    """Every tooth at its reference temperature, nothing pumped warm."""
    reference = inputs.heat.reference
    return replace(inputs, heat=replace(inputs.heat, wall_response=0.0, pinion_bulk=reference, wheel_bulk=reference))


def varied(inputs: DriveTrainInputs, values: Mapping[str, Any]) -> DriveTrainInputs:
    """The inputs with other values at dotted names ("couplings.0.friction.coefficient")."""
    for name, value in values.items():
        inputs = _replaced(inputs, name.split("."), value)
    return inputs


def value_at(thing: Any, name: str) -> Any:
    """The value at a dotted name."""
    for step in name.split("."):
        thing = thing[int(step)] if isinstance(thing, tuple) else getattr(thing, step)
    return thing


def _replaced(thing: Any, steps: list[str], value: Any) -> Any:
    if not steps:
        return value
    below = _replaced(value_at(thing, steps[0]), steps[1:], value)
    if isinstance(thing, tuple):
        place = int(steps[0])
        return (*thing[:place], below, *thing[place + 1 :])
    return replace(thing, **{steps[0]: below})
