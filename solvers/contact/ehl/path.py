"""A sequence of contacts, as along the flank of a gear: each solved from its neighbour."""

from collections.abc import Sequence
from math import exp, log

import numpy as np

from solvers.contact.ehl.checks import check
from solvers.contact.ehl.continuation import Attempt, Budget, Resolution, solve_cold, solve_from
from solvers.contact.ehl.dimensionless import expected_gap, groups
from solvers.contact.ehl.inputs import LineContactInputs
from solvers.contact.ehl.mesh import grid_for
from solvers.contact.ehl.model import resolution_for, result
from solvers.contact.ehl.problem import Problem, problem
from solvers.contact.ehl.results import LineContactResult
from solvers.contact.ehl.state import State, no_steps
from solvers.errors import InvalidInput


def solve_path(contacts: Sequence[LineContactInputs]) -> list[LineContactResult]:
    """Solve neighbouring contacts on one dimensionless mesh; each result carries its own status.

    The first starts from nothing, the others from the pressures, temperatures and separation of those before,
    extrapolated. What does not converge so is solved from nothing; what fails then too neither stops its neighbours
    nor is filled in. Raises InvalidInput as `inputs.check` does, and mixed_models unless all contacts share one model.
    """
    for inputs in contacts:
        check(inputs)
        if inputs.model != contacts[0].model:
            raise InvalidInput("mixed_models", "all contacts of a path must share one model", "model")
    if not contacts:
        return []
    gap = exp(sum(log(expected_gap(inputs)) for inputs in contacts) / len(contacts))
    known: list[State] = []
    results = []
    for inputs in contacts:
        scale = groups(inputs)
        constants = problem(inputs, scale)
        attempt, steps = _solve_next(constants, resolution_for(inputs, gap), known)
        results.append(result(inputs, scale, constants, attempt, steps))
        known = [*known[-1:], attempt.state] if attempt.converged else []
    return results


def _solve_next(constants: Problem, resolution: Resolution, known: Sequence[State]) -> tuple[Attempt, int]:
    """From the neighbours if there are any, else, or if that fails, from nothing; with the Newton steps it took."""
    spent = 0
    if known:
        budget = Budget()
        grid = grid_for(resolution.gap, resolution.nodes)
        attempt = solve_from(constants, resolution, grid, _extrapolate(known), budget)
        if attempt.converged:
            return attempt, budget.spent
        spent = budget.spent
    budget = Budget()
    attempt = solve_cold(constants, resolution, budget)
    return attempt, spent + budget.spent


def _extrapolate(known: Sequence[State]) -> State:
    """The next state if the last change repeats itself; the last state itself where it is the only one."""
    last = known[-1]
    before = known[0]
    cavitated = last.cavitated.copy()
    pressure = np.maximum(2.0 * last.pressure - before.pressure, 0.0)
    pressure[cavitated] = 0.0
    return State(
        pressure=pressure,
        separation=2.0 * last.separation - before.separation,
        temperature=np.maximum(2.0 * last.temperature - before.temperature, 0.9 * last.temperature.min()),
        cavitated=cavitated,
        history=no_steps(),
    )
