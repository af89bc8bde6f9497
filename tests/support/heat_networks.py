"""Build networks of the heat balance: the worked example and random realistic networks.

Each of the networks describes either a gear pair alone or a gear unit with bearings.
"""

from dataclasses import replace
from math import cos, exp, pi, radians

import numpy as np

from solvers.drive_train.inputs import JournalBearing
from solvers.drive_train.shafts.bearings import friction_and_leakage
from solvers.heat_balance.bearings import Journal, Operation
from solvers.heat_balance.conduction import rod_conductance
from solvers.heat_balance.fling_off import turning_teeth
from solvers.heat_balance.losses import MeshHeat, flow_by_rise, windage
from solvers.heat_balance.network import CasingWalls, CooledGear, Network, Spray
from solvers.heat_balance.oil import CoolingOil

CELSIUS = 273.15
SPEED = 10000 * pi / 30
MODULE, WIDTH, TEETH = 6e-3, 0.2, (39, 130)
RADII = tuple(MODULE / cos(radians(11.5)) * teeth / 2 for teeth in TEETH)
VELOCITY = SPEED * RADII[0]
PUMPING = (6904.0, 7844.0)
WINDAGE = 14622.0
MESH = MeshHeat(power=36978.0, temperature=95.0 + CELSIUS, share_to_pinion=0.49)


def turbine_oil(kelvin: float) -> float:
    """Return the viscosity of a turbine oil. It is 0.0095 Pa s at 86.85 C, and falls by about 3 % per kelvin."""
    return 0.0095 * exp(-0.03 * (kelvin - 360.0))


OIL = CoolingOil(50.0 + CELSIUS, turbine_oil, 850.0, 2000.0, 0.14)
FLOW = 140.08e-3 / 60  # m^3/s, given in the worked example


def gear(
    teeth: int, module: float, width: float, radius: float, speed: float, bore: float = 0.0, pumping: float = 0.0
) -> CooledGear:
    """Return a steel gear with an addendum of one module; `bore` is the radius of the shaft beside the faces."""
    tip = radius + module
    flanks = turning_teeth(teeth, width, module, radius, speed)
    return CooledGear(teeth, width, module, tip, flanks, 2 * pi * (tip**2 - bore**2), pumping=pumping)


def operation(bearing: JournalBearing, load: float, speed: float) -> Operation:
    """Return a function of the viscosity [Pa s] for a plain bearing under a fixed load [N]."""
    # The function returns the friction power [W] and the side leakage [m^3/s] of the short bearing.

    def operate(viscosity: float) -> tuple[float, float]:
        return friction_and_leakage(replace(bearing, viscosity=viscosity), load, speed, "short")

    return operate


def journal(number: int, bearing: JournalBearing, load: float, speed: float, *sections: tuple[float, float]) -> Journal:
    """Return a plain bearing on the shaft of gear 0 or 1.

    `sections` are the length and the diameter [m] of each steel cylinder between the gear and the bearing.
    """
    conductance = rod_conductance(tuple((length, outer, 0.0) for length, outer in sections), 46.0)
    return Journal(
        number,
        bearing.diameter,
        bearing.clearance,
        speed,
        conductance,
        operation(bearing, load, speed),
    )


WHEEL_SPEED = SPEED * TEETH[0] / TEETH[1]
PINION_BEARING = JournalBearing(0.0, 0.16, 0.11, 0.014, 130e-6)
WHEEL_BEARING = JournalBearing(0.0, 0.2, 0.14, 0.018, 150e-6)
JOURNALS = (
    journal(0, PINION_BEARING, 43220.0, SPEED, (0.07, 0.16), (0.03, 0.19)),
    journal(0, PINION_BEARING, 58965.0, SPEED, (0.07, 0.16), (0.03, 0.19)),
    journal(1, WHEEL_BEARING, 57657.0, WHEEL_SPEED, (0.08, 0.2), (0.03, 0.26)),
    journal(1, WHEEL_BEARING, 43802.0, WHEEL_SPEED, (0.08, 0.2), (0.03, 0.26)),
)
SPRAY = Spray(FLOW, VELOCITY, 20.0)
PAIR = Network(
    OIL,
    (gear(39, MODULE, WIDTH, RADII[0], SPEED), gear(130, MODULE, WIDTH, RADII[1], WHEEL_SPEED)),
    MESH,
    SPRAY,
    windage=WINDAGE,
)
UNIT = replace(
    PAIR,
    gears=(
        gear(39, MODULE, WIDTH, RADII[0], SPEED, 0.095, PUMPING[0]),
        gear(130, MODULE, WIDTH, RADII[1], WHEEL_SPEED, 0.13, PUMPING[1]),
    ),
    journals=JOURNALS,
)
CASED = replace(UNIT, casing=CasingWalls(6.0, 50.0, 12.0, 25.0 + CELSIUS))


def random_network(random: np.random.Generator, *, unit: bool) -> Network:
    """Draw a gear pair or a gear unit of a realistic design."""
    # The pitch-line velocity is 3 to 180 m/s. The mesh loses 1 to 8 W per kW of power. The losses of the gears warm the
    # oil by 5 to 40 K.
    module, helix = random.uniform(1e-3, 10e-3), radians(random.uniform(0.0, 30.0))
    teeth = (int(random.integers(17, 45)), int(random.integers(20, 180)))
    radii = [module / cos(helix) * number / 2 for number in teeth]
    width = 2 * radii[0] * random.uniform(0.3, 1.2)
    velocity = float(np.exp(random.uniform(np.log(3.0), np.log(180.0))))
    speeds = [velocity / radius for radius in radii]
    power = random.uniform(1e6, 6e6) * 2 * radii[0] * width * velocity
    beta, thickness = random.uniform(0.02, 0.05), float(np.exp(random.uniform(np.log(0.008), np.log(0.08))))
    oil = CoolingOil(
        random.uniform(10.0, 80.0) + CELSIUS,
        lambda kelvin: thickness * exp(-beta * (kelvin - 333.15)),
        random.uniform(800.0, 1000.0),
        random.uniform(1800.0, 2200.0),
        random.uniform(0.12, 0.17),
    )
    pumping = [random.uniform(0.0, 2e-3) * power if unit else 0.0 for _ in teeth]
    mesh = MeshHeat(random.uniform(1e-3, 8e-3) * power, oil.inlet + 30.0, random.uniform(0.4, 0.6))
    gears = [
        gear(number, module, width, radius, speed, 0.4 * radius if unit else 0.0, heat)
        for number, radius, speed, heat in zip(teeth, radii, speeds, pumping, strict=True)
    ]
    drag = sum(windage(velocity, 2 * one.flanks.radius, width, module, one.flanks.speed) for one in gears)
    jet, wetting = random.choice([-1.0, 1.0]) * random.uniform(5.0, 40.0), random.uniform(0.1, 1.0)
    flow = flow_by_rise(oil, mesh.power + drag, random.uniform(5.0, 40.0))
    spray = Spray(
        flow,
        velocity,
        jet,
        random.uniform(0.2, 0.8),
        wetting,
        random.uniform(0.0, 1.0),
        random.uniform(0.5, 2.0),
    )
    network = Network(
        oil,
        (gears[0], gears[1]),
        mesh,
        spray,
        windage=drag,
        other=random.uniform(0.0, 0.2) * mesh.power,
        mist_convection_factor=random.uniform(0.5, 10.0),
    )
    return _with_bearings(network, random, power / velocity) if unit else network


def _with_bearings(network: Network, random: np.random.Generator, force: float) -> Network:
    """Return the network with two plain bearings on each shaft, and in half of the cases with walls of a casing.

    Half the tooth force causes a mean pressure of 0.5 to 4 MPa in each of the bearings.
    """
    journals = []
    for number, one in enumerate(network.gears):
        for _ in range(2):
            width = float(np.sqrt(force / 2 * 0.65 / random.uniform(0.5e6, 4e6)))
            diameter = width / 0.65
            bearing = JournalBearing(0.0, diameter, width, 0.02, diameter * random.uniform(0.7e-3, 1.2e-3))
            load, sections = force * random.uniform(0.3, 0.6), (random.uniform(0.5, 1.5) * width, diameter)
            journals.append(journal(number, bearing, load, one.flanks.speed, sections))
    casing = CasingWalls(random.uniform(0.5, 10.0), 50.0, 12.0, 293.15) if random.random() < 0.5 else None
    return replace(network, journals=tuple(journals), casing=casing)
