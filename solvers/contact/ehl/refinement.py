"""What the mesh costs in accuracy: the error estimated from half as many nodes, and a finer mesh where it is large."""

from dataclasses import replace
from math import ceil, isfinite, log2, sqrt

import numpy as np

from solvers.arrays import FloatArray
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
# What is left of the difference that half as many nodes make, for each part of a number: 1/3 in second order; less is
# observed where heat decides, and least at a spike.
LEFT: dict[str, tuple[float, ...]] = {
    "central_film": (1 / 3,),
    "minimum_film": (1 / 3,),
    "centre_pressure": (1 / 3,),
    "friction": (1 / 2,),
    "surface_1_flash": (1 / 2, 1 / 1.5),
    "surface_2_flash": (1 / 2, 1 / 1.5),
    "generated_heat": (1 / 2,),
}
# A fall of pressure between two nodes, in p_H. Half as many nodes have it between the same two, wherever it ought to
# be, and so agree with the others more than either do with the truth: their difference then counts whole.
STEEP = 0.5
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
    fine, other = (_parts(inputs, constants, found) for found in (attempt, coarse))
    steep = _steepest_fall(attempt) > STEEP
    errors = {}
    for name, parts in fine.items():
        left = (1.0,) * len(parts) if steep else LEFT[name]
        moved = sum(k * abs(a - b) for k, a, b in zip(left, parts, other[name], strict=True))
        errors[name] = moved / max(abs(sum(parts)), LEAST.get(name, 0.0))
    # Where the film is thinnest there flows what passes the centre.
    errors["minimum_film"] = max(errors["minimum_film"], errors["central_film"])
    return MeshError(**errors) if all(map(isfinite, errors.values())) else None


def _steepest_fall(attempt: Attempt) -> float:
    """The largest fall of P between two nodes behind the centre."""
    return float(-np.diff(attempt.state.pressure[attempt.grid.x > 0.0]).min())


def _parts(inputs: LineContactInputs, constants: Problem, attempt: Attempt) -> dict[str, tuple[float, ...]]:
    """What is reported of a contact, but for local maxima, by the names of `MeshError`, as sums of parts.

    A flash temperature is that of the centre and what is added up to its maximum: more nodes cool the one, as the film
    thickens, and heat the other where it is the work of a spike. The errors of their sum can cancel on one mesh.
    """
    heights = measures.film_heights(constants, attempt)
    parts: dict[str, tuple[float, ...]] = {
        "central_film": (measures.at_centre(attempt, heights),),
        "minimum_film": (float(heights.min()),),
        "centre_pressure": (measures.at_centre(attempt, attempt.state.pressure),),
        "friction": (measures.friction_coefficient(constants, attempt, inputs),),
    }
    if inputs.model.thermal:
        temperature = attempt.state.temperature
        parts["surface_1_flash"] = _flash_parts(attempt, temperature[:, 0], constants.bulk_1)
        parts["surface_2_flash"] = _flash_parts(attempt, temperature[:, -1], constants.bulk_2)
        parts["generated_heat"] = (measures.generated_heat(constants, attempt),)
    return parts


def _flash_parts(attempt: Attempt, surface: FloatArray, bulk: float) -> tuple[float, float]:
    """Flash temperature of a surface in the centre, and how much higher its maximum is [K]."""
    centre = measures.at_centre(attempt, surface)
    return centre - bulk, float(surface.max()) - centre
