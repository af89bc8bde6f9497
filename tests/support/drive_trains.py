"""Return the worked example of a turbo gear unit, and variants of this example.

The unit transmits 12 MW at a pinion speed of 10,000 1/min. The pinion has 39 teeth and the wheel has 130 teeth. The
pinion shaft has a gear coupling.
"""

from dataclasses import replace
from math import pi, radians

from solvers.coupling.inputs import Coupling, Friction
from solvers.drive_train.inputs import (
    Bearing,
    DriveTrainInputs,
    Effects,
    Heat,
    JournalBearing,
    RigidBearing,
    Shaft,
    ShaftSection,
    UnitCoupling,
)
from solvers.drive_train.states import solve
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.lubricants import Lubricant
from solvers.materials import Solid
from solvers.pumping.inputs import PumpingSetup
from solvers.scuffing.inputs import Load, LoadDistributionInputs, Modifications, ScuffingInputs, Temperatures
from tests.support.changes import changed

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
    """Return the example with the given flank modifications. Formulas replace the thermal solution of the film."""
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
        temperatures=Temperatures(bulk=95 + CELSIUS, oil=50 + CELSIUS, scuffing=220 + CELSIUS, bulk_method="given"),
        lubrication="closed_form",
        friction="given",
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
        bearing_film="short",
    )


NO_EFFECTS = Effects(shafts=False, coupling=False, thermal=False)


def cold(inputs: DriveTrainInputs) -> DriveTrainInputs:
    """Return the unit with both gears at the reference temperature, and without heating of the teeth by pumped gas."""
    reference = inputs.heat.reference
    return changed(inputs, {"heat.wall_response": 0.0, "heat.pinion_bulk": reference, "heat.wheel_bulk": reference})


def rigid_bearings(bearings: tuple[Bearing, ...]) -> tuple[Bearing, ...]:
    """Return rigid bearings at the positions of the given bearings."""
    return tuple(RigidBearing(bearing.position) for bearing in bearings)


def running_axis(unit: DriveTrainInputs) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the place (x, y) [m] and the slope (x, y) [-] of a machine's hub that is aligned with the running pinion.

    The pinion shaft runs without a coupling. Its axis is extended as a straight line to the hub of the machine.
    """
    curves = solve(replace(unit, effects=Effects(coupling=False))).shafts[0].curves
    reach = COUPLING.position - COUPLING.coupling.hub_distance - curves.z[0]
    slope = [float((line[1] - line[0]) / (curves.z[1] - curves.z[0])) for line in (curves.x, curves.y)]
    place = [float(line[0] + rise * reach) for line, rise in zip((curves.x, curves.y), slope, strict=True)]
    return (place[0], place[1]), (slope[0], slope[1])
