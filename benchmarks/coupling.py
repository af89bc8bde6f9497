"""Times of the gear coupling: one mesh, two meshes on one sleeve, the sleeve's orbit, the recommended crowning.

Run from the project's root: python -m benchmarks.coupling. Best and median of repeats with warm kernels; the targets
are what the service reckons with on two cores.
"""

from collections.abc import Callable
from dataclasses import replace
from math import cos, pi, radians
from statistics import median
from time import perf_counter

from solvers.coupling import recommend, solve, solve_orbit
from solvers.coupling.inputs import Coupling, CouplingInputs, ModelOptions, Operation, RecommendationInputs

TEETH = 52
REPEATS = 50
DESIGN = CouplingInputs(
    Coupling(teeth=TEETH, module=3e-3, face_width=24e-3, tooth_height=6e-3),
    Operation(torque=3000.0, speed=200.0, misalignment=radians(0.1), axial_velocity=2e-3),
)
PITCH_ERRORS = tuple(2e-6 * (cos(2 * pi * i / TEETH) + cos(6 * pi * i / TEETH + 0.7)) for i in range(TEETH))
UNEVEN = replace(DESIGN, coupling=replace(DESIGN.coupling, pitch_errors=PITCH_ERRORS))


def offset(inputs: CouplingInputs) -> CouplingInputs:
    """The same coupling between parallel shafts."""
    return replace(inputs, operation=replace(inputs.operation, arrangement="parallel_offset"))


def at(inputs: CouplingInputs, misalignment_deg: float, speed: float) -> CouplingInputs:
    """The same coupling at another misalignment and speed [rad/s]."""
    return replace(inputs, operation=replace(inputs.operation, misalignment=radians(misalignment_deg), speed=speed))


FLOATING = replace(DESIGN, model=ModelOptions(sleeve="floating"))
RANGE = RecommendationInputs(DESIGN, radians(0.05), radians(0.2))
CASES: tuple[tuple[str, Callable[[], object], float], ...] = (
    ("single mesh with curves", lambda: solve(DESIGN), 2.0),
    ("single mesh, floating sleeve", lambda: solve(FLOATING), 2.0),
    ("single mesh, pitch errors", lambda: solve(UNEVEN), 2.0),
    ("parallel offset, axial velocity", lambda: solve(offset(DESIGN)), 30.0),
    ("parallel offset, pitch errors", lambda: solve(offset(UNEVEN)), 30.0),
    ("sleeve orbit, all teeth loaded", lambda: solve_orbit(at(UNEVEN, 0.1, 1000.0)), 100.0),
    ("sleeve orbit, teeth unloading", lambda: solve_orbit(at(UNEVEN, 1.0, 1000.0)), 100.0),
    ("recommendation", lambda: recommend(RANGE), 300.0),
)


def main() -> None:
    """Print the table."""
    print(f"{'figure':34}{'best ms':>10}{'median ms':>11}{'target ms':>11}{'target/best':>13}")
    for name, case, target in CASES:
        case()
        times = []
        for _ in range(REPEATS):
            start = perf_counter()
            case()
            times.append(1e3 * (perf_counter() - start))
        best = min(times)
        print(f"{name:34}{best:10.3f}{median(times):11.3f}{target:11.0f}{target / best:13.1f}")


if __name__ == "__main__":
    main()
