"""The coupling for which Bloch's book explains a hand method (Improving Machinery Reliability, pp. 208-210)."""

from functools import cache
from math import radians, tan

from solvers.coupling.inputs import Coupling, CouplingInputs, Friction, Operation
from solvers.coupling.model import solve
from solvers.coupling.results import CouplingResult

TORQUE, DIAMETER, FACE, FRICTION = 21806.0, 0.2286, 0.033, 0.3  # N m, m, m, -
MISALIGNMENT = radians(0.057)  # in the book: 0.001 mm per mm
END_CONTACT = FACE / 2 * tan(radians(20.0)) / (DIAMETER / 2 * MISALIGNMENT)
"""The crowning ratio with which the contact just reaches the end of the tooth face."""


@cache
def bloch(crowning: float = 1.0, stiffness: float = 2.8e8, axial_velocity: float = 0.0) -> CouplingResult:
    """Solve Bloch's coupling.

    The book does not state the number of teeth. The calculation assumes 72 teeth of diametral pitch 8. These numbers
    agree with the diameter in the book.
    """
    design = Coupling(
        teeth=72,
        module=DIAMETER / 72,
        face_width=FACE,
        tooth_height=2 * DIAMETER / 72,
        crowning_ratio=crowning,
        tooth_stiffness=stiffness,
    )
    return solve(
        CouplingInputs(
            design, Operation(TORQUE, 500.0, axial_velocity, misalignment=MISALIGNMENT), friction=Friction(FRICTION)
        )
    )
