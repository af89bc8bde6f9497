"""Print the run times of the line contact.

The table has rows for single points that are solved without a start value, isothermal and thermal, for paths of contact
of gear pair 1, and for the median over a grid of 200 points.

Run from the project's root: python -m benchmarks.ehl [--against REVISION]
"""

from collections.abc import Iterator
from dataclasses import replace
from math import cos, pi, radians

from benchmarks.published.xue import POINT_A
from benchmarks.timing import Figure, MedianFigure, print_times
from solvers.contact.ehl import Contact, LineContactInputs, Model, solve_path
from solvers.contact.ehl.model import solve
from solvers.gears.inputs import GROUND_FILLET, GearPairInputs, GearTeeth
from solvers.gears.pair import gear_pair
from solvers.lubricants import Lubricant
from tests.support.line_contacts import grid_contacts

EYRING = Model()
STIFF = Model(eyring_stress=10e6)
NEWTONIAN = Model(rheology="newtonian")
ISOTHERMAL = Model(thermal=False, rheology="newtonian")


def path(model: Model, points: int = 50) -> list[LineContactInputs]:
    """Return contacts of gear pair 1 from A to E of the path of contact, at a line load of 273 N/mm."""
    pair = gear_pair(
        GearPairInputs(
            GearTeeth(23),
            GearTeeth(30),
            3e-3,
            20e-3,
            pressure_angle=radians(20.0),
            helix_angle=radians(9.8),
            rack_tip_radius=GROUND_FILLET,
        )
    )
    turn = 2000 * pi / 30
    contacts = []
    for k in range(points):
        first = 4.859e-3 + (19.137e-3 - 4.859e-3) * k / (points - 1)
        second = pair.line_of_action - first
        radius = first * second / (pair.line_of_action * cos(pair.base_helix_angle))
        contact = Contact(2.73e5, radius, turn * first, turn * 23 / 30 * second)
        contacts.append(LineContactInputs(contact, model=model, lubricant=Lubricant()))
    return contacts


def figures() -> Iterator[Figure | MedianFigure]:
    """Yield a `Figure` or `MedianFigure` for each row of the printed table."""
    for name, model, target in (
        ("isothermal Newtonian point, 121 nodes", ISOTHERMAL, 6.0),
        ("isothermal Ree-Eyring point, 121 nodes", replace(EYRING, thermal=False), 6.0),
        ("thermal Ree-Eyring point A, from nothing", EYRING, 12.0),
        ("thermal Newtonian point A, from nothing", NEWTONIAN, 34.0),
    ):
        inputs = LineContactInputs(POINT_A, model=model, lubricant=Lubricant())
        yield Figure(name, lambda inputs=inputs: solve(inputs), target)  # type: ignore[misc]
    for name, model, target in (
        ("Ree-Eyring 5 MPa", EYRING, 150.0),
        ("Ree-Eyring 10 MPa", STIFF, 150.0),
        ("Newtonian", NEWTONIAN, 400.0),
        ("isothermal Ree-Eyring", replace(EYRING, thermal=False), 150.0),
    ):
        contacts = path(model)
        yield Figure(f"path of 50 points, {name}", lambda contacts=contacts: solve_path(contacts), target)  # type: ignore[misc]
    # Behind point A and before the pitch point: all of them lead to their neighbours.
    smooth = path(EYRING)[1:22]
    yield Figure("21 neighbouring thermal points", lambda: solve_path(smooth), 12.0 + 20 * 3.0)
    for name, model, target in (("Ree-Eyring", EYRING, 12.0), ("Newtonian", NEWTONIAN, 34.0)):
        alone = [lambda inputs=inputs: solve(inputs) for inputs in grid_contacts(model)]
        yield MedianFigure(f"thermal from nothing, median of 200, {name}", alone, target)


if __name__ == "__main__":
    print_times("benchmarks.ehl", tuple(figures()))
