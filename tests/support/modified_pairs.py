"""Draw modified gear pairs like those of users, and check a thermal path against the separate solution of its points.

The pairs are turbo, industrial and slow pairs with every kind of modification and misalignment. Their films are
Ree-Eyring or Newtonian.
"""

from math import log, radians

import numpy as np

from solvers.contact import ehl
from solvers.contact.hertz import reduced_modulus
from solvers.errors import InvalidInput
from solvers.gears.inputs import GROUND_FILLET, GearPairInputs, GearTeeth
from solvers.lubricants import Lubricant
from solvers.scuffing.flank_results import contact_points
from solvers.scuffing.inputs import (
    Load,
    LoadDistributionInputs,
    Modifications,
    ScuffingInputs,
    Temperatures,
    angular_speed,
)
from solvers.scuffing.load_balance import line_loads
from solvers.scuffing.results import ContactPoints
from solvers.scuffing.safety import solve_scuffing
from solvers.scuffing.safety_results import Scuffing
from solvers.scuffing.thermal.thermal_path import contact_at

# Module [mm], pitch-line velocity [m/s], face width over pinion diameter, load intensity F_t/(b d_1) [N/mm^2],
# viscosity [Pa s], bulk temperature [K]: lowest and highest of each kind of pair.
KINDS = {
    "turbo": ((4.0, 8.0), (60.0, 160.0), (0.5, 1.0), (0.7, 2.0), (0.008, 0.02), (343.15, 373.15)),
    "industrial": ((2.0, 10.0), (3.0, 30.0), (0.3, 1.0), (1.0, 4.0), (0.02, 0.1), (323.15, 363.15)),
    "slow": ((3.0, 20.0), (0.2, 2.0), (0.3, 0.8), (1.5, 5.0), (0.1, 0.5), (303.15, 343.15)),
}
PATH_POINTS = (25, 50, 100, 200)


def random_pair(rng: np.random.Generator) -> ScuffingInputs:
    """Draw a turbo, industrial or slow gear pair under load, with random modifications and a model of the film."""
    module, velocity, width, intensity, viscosity, bulk = KINDS[str(rng.choice(list(KINDS)))]
    teeth = int(rng.integers(18, 45))
    normal_module, helix = _between(rng, *module) * 1e-3, radians(float(rng.choice([0.0, rng.uniform(6.0, 30.0)])))
    diameter = teeth * normal_module / np.cos(helix)
    face_width = _between(rng, *width) * diameter
    gears = GearPairInputs(
        GearTeeth(teeth),
        GearTeeth(int(teeth * rng.uniform(1.0, 4.0))),
        normal_module,
        face_width,
        helix_angle=helix,
        rack_tip_radius=GROUND_FILLET,
    )
    torque = _between(rng, *intensity) * 1e6 * face_width * diameter**2 / 2
    load = Load(torque, 2 * _between(rng, *velocity) / diameter)
    distribution = LoadDistributionInputs(gears, load, random_modifications(rng, face_width))
    return ScuffingInputs(
        distribution,
        lubricant=Lubricant(viscosity=_between(rng, *viscosity)),
        temperatures=Temperatures(bulk=rng.uniform(*bulk), oil=323.15, scuffing=523.15, bulk_method="given"),
        film=ehl.Model(rheology="newtonian" if rng.random() < 0.3 else "ree_eyring"),
        path_points=int(rng.choice(PATH_POINTS)),
        friction="given",
    )


def random_modifications(rng: np.random.Generator, face_width: float) -> Modifications:
    """Draw reliefs, crownings, slopes and deviations of 2 to 50 um.

    Each of them is present with a probability of 1/3, and otherwise zero.
    """

    def amount(low: float = 2e-6, *, signed: bool = False) -> float:
        value = _between(rng, low, 50e-6) * (rng.choice([-1.0, 1.0]) if signed else 1.0)
        return float(value) if rng.random() < 1 / 3 else 0.0

    return Modifications(
        profile_crowning=amount(),
        lead_crowning=amount(),
        profile_slope=amount(signed=True),
        helix_slope=amount(signed=True),
        in_plane_deviation=amount(signed=True),
        out_of_plane_deviation=amount(signed=True),
        tip_relief=amount(),
        root_relief=amount(),
        end_relief=amount(),
        end_relief_length=rng.uniform(0.05, 0.4) * face_width,
        relief_exponent=float(rng.choice([1.0, 2.0, 1.5])),
    )


def _between(rng: np.random.Generator, low: float, high: float) -> float:
    """Draw a number between two bounds. The logarithm of the number is uniformly distributed."""
    return float(np.exp(rng.uniform(log(low), log(high))))


def relieved_pair(points: int) -> ScuffingInputs:
    """Return a pair with 23 and 30 teeth, a power of 50 kW at 2000 1/min, and tip and root relief of 30 um."""
    gears = GearPairInputs(GearTeeth(23), GearTeeth(30), 3e-3, 20e-3, helix_angle=radians(9.8), rack_tip_radius=0.38)
    speed = angular_speed(2000.0)
    distribution = LoadDistributionInputs(
        gears, Load(50e3 / speed, speed), Modifications(tip_relief=30e-6, root_relief=30e-6)
    )
    return ScuffingInputs(
        distribution,
        temperatures=Temperatures(scuffing=573.15, bulk=360.0, bulk_method="given"),
        path_points=points,
        lubricant=Lubricant(),
        friction="given",
    )


def turbo_pair(helix_slope: float) -> ScuffingInputs:
    """Return a turbo pair that transmits 12 MW at 10,000 1/min. `helix_slope` is in m."""
    # The pair has 39 and 130 teeth, a module of 6 mm, a helix angle of 11.5 degrees and a face width of 200 mm.
    gears = GearPairInputs(
        GearTeeth(39), GearTeeth(130), 6e-3, 0.2, helix_angle=radians(11.5), rack_tip_radius=GROUND_FILLET
    )
    speed = angular_speed(10000.0)
    distribution = LoadDistributionInputs(gears, Load(12e6 / speed, speed), Modifications(helix_slope=helix_slope))
    return ScuffingInputs(
        distribution,
        lubricant=Lubricant(viscosity=0.0095),
        friction="given",
        temperatures=Temperatures(bulk=360.0, bulk_method="given"),
    )


def points_alone(inputs: ScuffingInputs, result: Scuffing, every: int = 1) -> dict[int, ehl.LineContactResult]:
    """Solve the contacts at points of a path one by one, without a neighbour's solution as the start.

    Refused and unloaded points are left out. Of the other points, only every `every`-th is solved. The keys of the
    result are the indices of the points.
    """
    taken = [k for k, status in enumerate(result.path.status) if status not in {"refused", "unloaded"}]
    points = points_of(inputs, result)
    return {k: ehl.solve(contact_at(inputs, points, k)) for k in taken[::every]}


def points_of(inputs: ScuffingInputs, result: Scuffing) -> ContactPoints:
    """Return the load, the radius and the speeds at the points of a path."""
    mesh, psi, given = result.distribution, result.path.psi, inputs.distribution
    modulus = reduced_modulus(given.pinion_material, given.wheel_material)
    plane = mesh.path_of_contact.plane
    x, y = psi * plane.path_length, psi * plane.face_width
    load = line_loads(mesh.balance, x, y)
    return contact_points(mesh.path_of_contact, x, load, given.load.pinion_speed, modulus)


def check_path(inputs: ScuffingInputs, every: int = 1) -> Scuffing:
    """Check that a path has the same results as its points solved one by one. Return the results of the path."""
    # The minimum film thickness and the friction must agree within 1 %, flash temperatures within 1 % or 0.5 K. If they
    # do not agree, the AssertionError contains the case. A point that is solved alone must also be solved along the
    # path. The path may solve more points, because the solver starts each point from the solution at a neighbour.
    result = solve_scuffing(inputs)
    path, thermal = result.path, result.path.thermal
    for point, alone in points_alone(inputs, result, every).items():
        if alone.status == "no_solution":
            continue
        where = f"at psi {path.psi[point]:.4f}"
        assert path.status[point] != "no_solution", f"solved alone, not along the path, {where}; {inputs}"
        pairs = (
            ("film", thermal.minimum_film, alone.film.minimum, 0.0),
            ("friction", thermal.friction_coefficient, alone.friction.coefficient, 1e-6),
            ("pinion flash", thermal.pinion_flash, alone.temperature.surface_1_flash, 0.5),
            ("wheel flash", thermal.wheel_flash, alone.temperature.surface_2_flash, 0.5),
        )
        for name, along, expected, absolute in pairs:
            assert abs(along[point] - expected) <= max(0.01 * abs(expected), absolute), (
                f"{name} {where}: {along[point]:.6g} along the path, {expected:.6g} alone; {inputs}"
            )
    return result


def search_paths(rng: np.random.Generator) -> None:
    """Draw a pair, solve its path, solve every tenth point again on its own, and compare the results."""
    # A pair that the solver refuses passes the check.
    inputs = random_pair(rng)
    try:
        check_path(inputs, every=10)
    except InvalidInput:
        return
