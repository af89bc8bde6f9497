"""Print the run times of the gear coupling.

The table has rows for one mesh, two meshes on one sleeve, the orbit of the sleeve, and the recommended crowning.

Run from the project's root: python -m benchmarks.coupling [--against REVISION]
"""

from dataclasses import replace
from math import cos, pi, radians

from benchmarks.timing import Figure, print_times
from solvers.coupling.crowning import recommend
from solvers.coupling.inputs import Coupling, CouplingInputs, ModelOptions, Operation, RecommendationInputs
from solvers.coupling.model import solve
from solvers.coupling.orbit import solve_orbit

TEETH = 52
DESIGN = CouplingInputs(
    Coupling(teeth=TEETH, module=3e-3, face_width=24e-3, tooth_height=6e-3),
    Operation(torque=3000.0, speed=200.0, misalignment=radians(0.1), axial_velocity=2e-3),
)
PITCH_ERRORS = tuple(2e-6 * (cos(2 * pi * i / TEETH) + cos(6 * pi * i / TEETH + 0.7)) for i in range(TEETH))
UNEVEN = replace(DESIGN, coupling=replace(DESIGN.coupling, pitch_errors=PITCH_ERRORS))


def offset(inputs: CouplingInputs) -> CouplingInputs:
    """Return the inputs of the same coupling between two shafts with a parallel offset."""
    return replace(inputs, operation=replace(inputs.operation, arrangement="parallel_offset"))


def at(inputs: CouplingInputs, misalignment_deg: float, speed: float) -> CouplingInputs:
    """Return the inputs of the same coupling at another misalignment [deg] and another speed [rad/s]."""
    return replace(inputs, operation=replace(inputs.operation, misalignment=radians(misalignment_deg), speed=speed))


FLOATING = replace(DESIGN, model=ModelOptions(sleeve="floating"))
RANGE = RecommendationInputs(DESIGN, radians(0.05), radians(0.2))
FIGURES = (
    Figure("one mesh with curves", lambda: solve(DESIGN), 2.0),
    Figure("one mesh, floating sleeve", lambda: solve(FLOATING), 2.0),
    Figure("one mesh, pitch errors", lambda: solve(UNEVEN), 0.8),
    Figure("parallel offset, axial velocity", lambda: solve(offset(DESIGN)), 30.0),
    Figure("parallel offset, pitch errors", lambda: solve(offset(UNEVEN)), 30.0),
    Figure("sleeve orbit, all teeth loaded", lambda: solve_orbit(at(UNEVEN, 0.1, 1000.0)), 100.0),
    Figure("sleeve orbit, teeth unloading", lambda: solve_orbit(at(UNEVEN, 1.0, 1000.0)), 100.0),
    Figure("recommendation", lambda: recommend(RANGE), 6.0),
)

if __name__ == "__main__":
    print_times("benchmarks.coupling", FIGURES)
