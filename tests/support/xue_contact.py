"""The contacts of Xue, Zhang and Wang (gear pair 1, 2000/min, 273 N/mm) and how the tests solve them.

All temperatures are 360 K, where the oil has its 0.08 Pa s: with any other reading of the table the film is far from
the paper's (test_viscosity_is_meant_at_360_kelvin).
"""

from dataclasses import replace
from functools import cache
from math import cos, pi, radians

import numpy as np

from solvers.contact.ehl import Contact, LineContactInputs, LineContactResult, Model, solve_path
from solvers.contact.ehl.model import solve
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.gears.pair import gear_pair

LINE_LOAD = 2.73e5  # N/m
START = Contact(LINE_LOAD, 4.015e-3, 1.0179, 3.7076)  # approach point A
PAIR_1 = GearPairInputs(
    GearTeeth(23), GearTeeth(30), 3e-3, 20e-3, pressure_angle=radians(20.0), helix_angle=radians(9.8)
)
PATH_POINTS = 50


def contact(model: Model, at: Contact = START) -> LineContactInputs:
    """The paper's oil and steel at a contact."""
    return LineContactInputs(at, model=model)


@cache
def point_a(
    nodes: int = 121,
    rheology: str = "ree_eyring",
    thermal: bool = True,
    film_nodes: int = 21,
    eyring_stress: float = 5e6,
) -> LineContactResult:
    """Point A solved at a resolution."""
    model = Model(thermal=thermal, nodes=nodes, film_nodes=film_nodes, eyring_stress=eyring_stress, refine_mesh=False)
    return solve(contact(replace(model, rheology=rheology)))


def path_contacts(model: Model, points: int = PATH_POINTS) -> list[LineContactInputs]:
    """Contacts along the path from A to E at constant line load: roll lengths 4.859 to 19.137 mm of the pinion."""
    pair = gear_pair(PAIR_1)
    pinion_speed = 2000 * pi / 30
    wheel_speed = pinion_speed * 23 / 30
    contacts = []
    for rho_1 in np.linspace(4.859e-3, 19.137e-3, points):
        rho_2 = pair.line_of_action - rho_1
        radius = rho_1 * rho_2 / (pair.line_of_action * cos(pair.base_helix_angle))
        at = Contact(LINE_LOAD, float(radius), float(pinion_speed * rho_1), float(wheel_speed * rho_2))
        contacts.append(contact(model, at))
    return contacts


@cache
def path(rheology: str = "ree_eyring") -> list[LineContactResult]:
    """The path solved."""
    return solve_path(path_contacts(replace(Model(), rheology=rheology)))


def blok_flash(at: Contact, coefficient: float, half_width: float) -> float:
    """Blok's flash temperature [K], Eq. 25, steel on steel; u_i are the rolling speeds, not as printed the sliding."""
    effusivity = (46.0 * 7850.0 * 470.0) ** 0.5
    speeds = at.speed_1**0.5 + at.speed_2**0.5
    heat = coefficient * at.line_load * abs(at.speed_1 - at.speed_2)
    return float(0.7858 * heat / (effusivity * speeds * half_width**0.5))
