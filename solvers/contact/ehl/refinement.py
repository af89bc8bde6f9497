"""What the mesh costs in accuracy: the error estimated from half as many nodes, and a finer mesh where it is large."""

from dataclasses import replace
from math import ceil, isfinite, log2, sqrt

from solvers.contact.ehl import measures
from solvers.contact.ehl.grid.mesh import grid_for
from solvers.contact.ehl.inputs import LineContactInputs
from solvers.contact.ehl.notices import LARGEST_MESH_ERROR
from solvers.contact.ehl.problem import Problem
from solvers.contact.ehl.results import MeshError
from solvers.contact.ehl.solution.budget import Budget, Resolution, price
from solvers.contact.ehl.solution.continuation import TIGHT, Attempt, interpolate, polish

FINEST = 481
STEPS_ON_FINER = 20.0
STEPS_ON_COARSER = 12
# A step of the contact on half the nodes after which its numbers are known well enough: dP, dT [K].
NEAR = (0.12, 12.0)
# What is left of the difference that half as many nodes make: 1/3 in second order; less is observed where heat decides.
LEFT = {
    "central_film": 1 / 3,
    "minimum_film": 1 / 3,
    "centre_pressure": 1 / 3,
    "friction": 1 / 2,
    "surface_1_flash": 1 / 1.5,
    "surface_2_flash": 1 / 1.5,
    "generated_heat": 1 / 2,
}
LEAST = {"friction": 1e-3, "surface_1_flash": 25.0, "surface_2_flash": 25.0}  # [-], [K]: smaller numbers count as these


def refined(
    inputs: LineContactInputs, constants: Problem, resolution: Resolution, attempt: Attempt, budget: Budget
) -> tuple[Attempt, MeshError | None]:
    """A converged attempt on a mesh fine enough for its numbers, and the error left in them (None: not known).

    It stays on its mesh if that is fine enough, the finest or all that was asked for, and if the finer one does not
    converge within the steps left. What decides is the contact itself, never how its solution was found.
    """
    error = mesh_error(inputs, constants, resolution, attempt)
    while inputs.model.refine and not acceptable(error) and resolution.nodes < FINEST:
        resolution = replace(resolution, nodes=finer_nodes(resolution.nodes, error))
        grid = grid_for(resolution.gap, resolution.nodes)
        guess = interpolate(attempt.state, attempt.grid.x, grid.x)
        steps = budget.part(STEPS_ON_FINER * price(resolution, resolution.nodes))
        finer = polish(constants, resolution, grid, guess, TIGHT, steps)
        if not finer.converged:
            break
        attempt = finer
        measures.settle(constants, attempt, inputs.model.thermal)
        error = mesh_error(inputs, constants, resolution, attempt)
    return attempt, error


def acceptable(error: MeshError | None) -> bool:
    """Whether a mesh is fine enough."""
    return error is not None and error.largest <= LARGEST_MESH_ERROR


def finer_nodes(nodes: int, error: MeshError | None) -> int:
    """Nodes that bring an error of second order below the limit, in steps of sqrt(2) so that meshes are shared."""
    excess = 4.0 if error is None else min(error.largest / LARGEST_MESH_ERROR, 16.0)
    half_octaves = max(ceil(log2(excess)), 1)
    return min(round((nodes - 1) * sqrt(2.0) ** half_octaves) + 1, FINEST)


def mesh_error(
    inputs: LineContactInputs, constants: Problem, resolution: Resolution, attempt: Attempt
) -> MeshError | None:
    """Error of each number from its difference to the same contact on every other node (Richardson).

    So near is that contact that one Newton step mostly finds it; a spike or a film that runs hot takes more, as half
    the nodes keep the peak they are given. None if it is not found.
    """
    grid = grid_for(resolution.gap, resolution.nodes // 2 + 1)
    state = interpolate(attempt.state, attempt.grid.x, grid.x)
    steps = Budget(STEPS_ON_COARSER * price(resolution, grid.x.size))
    coarse = polish(constants, resolution, grid, state, NEAR, steps)
    if not coarse.converged:
        return None
    measures.settle(constants, coarse, resolution.thermal)
    fine, other = (_numbers(inputs, constants, found) for found in (attempt, coarse))
    errors = {
        name: LEFT[name] * abs(fine[name] - other[name]) / max(abs(fine[name]), LEAST.get(name, 0.0)) for name in fine
    }
    return MeshError(**errors) if all(map(isfinite, errors.values())) else None


def _numbers(inputs: LineContactInputs, constants: Problem, attempt: Attempt) -> dict[str, float]:
    """What is reported of a contact, but for local maxima, by the names of `MeshError`."""
    heights = measures.film_heights(constants, attempt)
    numbers = {
        "central_film": measures.at_centre(attempt, heights),
        "minimum_film": float(heights.min()),
        "centre_pressure": measures.at_centre(attempt, attempt.state.pressure),
        "friction": measures.friction_coefficient(constants, attempt, inputs),
    }
    if inputs.model.thermal:
        temperature = attempt.state.temperature
        numbers["surface_1_flash"] = float(temperature[:, 0].max()) - constants.bulk_1
        numbers["surface_2_flash"] = float(temperature[:, -1].max()) - constants.bulk_2
        numbers["generated_heat"] = measures.generated_heat(constants, attempt)
    return numbers
