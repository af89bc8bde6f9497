"""A sequence of contacts, as along the flank of a gear: each solved from its neighbour."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import exp, log

import numpy as np

from solvers.contact.ehl.budget import Budget, budget_for, price
from solvers.contact.ehl.checks import check
from solvers.contact.ehl.continuation import Attempt, interpolate, solve_cold, solve_from
from solvers.contact.ehl.dimensionless import expected_gap, groups
from solvers.contact.ehl.inputs import LineContactInputs
from solvers.contact.ehl.mesh import grid_for
from solvers.contact.ehl.model import resolution_for, result
from solvers.contact.ehl.problem import problem
from solvers.contact.ehl.results import LineContactResult
from solvers.contact.ehl.state import State, no_steps
from solvers.errors import InvalidInput

REGRADED = 2.0  # ratio of films beyond which a point needs a mesh graded for itself
CONTACTS_FROM_NOTHING = 2.0  # that a whole path may pay for, beside a few steps for each point
STEPS_A_POINT = 4.0
SHARE = 0.25  # of what is left, for one point that has to start from nothing
FEWEST_STEPS = 10.0  # that are worth a start from nothing


@dataclass(slots=True)
class _Walk:
    """Where the path has got to: its mesh, the states solved last (at most two), what steps are left for the rest."""

    gap: float
    remaining: float
    known: list[State]


def solve_path(contacts: Sequence[LineContactInputs]) -> list[LineContactResult]:
    """Solve neighbouring contacts on one dimensionless mesh; each result carries its own status.

    The first starts from nothing, the others from the pressures, temperatures and separation of those before,
    extrapolated. What does not converge so is solved from nothing; what fails then too neither stops its neighbours
    nor is filled in. A film twice as thick or thin as the mesh is graded for gets another mesh. All points share one
    budget of steps: the more of them fail, the fewer each further one is given.

    Raises InvalidInput as `check` does, and mixed_models unless all contacts share one model.
    """
    for inputs in contacts:
        check(inputs)
        if inputs.model != contacts[0].model:
            raise InvalidInput("mixed_models", "all contacts of a path must share one model", "model")
    if not contacts:
        return []
    gaps = [expected_gap(inputs) for inputs in contacts]
    mean = exp(sum(map(log, gaps)) / len(gaps))
    resolution = resolution_for(contacts[0], mean)
    steps = STEPS_A_POINT * price(resolution, resolution.nodes) * len(contacts)
    walk = _Walk(mean, CONTACTS_FROM_NOTHING * budget_for(resolution).remaining + steps, [])
    return [_solve_next(inputs, gap, walk) for inputs, gap in zip(contacts, gaps, strict=True)]


def _solve_next(inputs: LineContactInputs, gap: float, walk: _Walk) -> LineContactResult:
    """From the neighbours if there are any, else, or if that fails, from nothing; the walk goes on from here."""
    scale = groups(inputs)
    constants = problem(inputs, scale)
    resolution = resolution_for(inputs, _regrade(walk, gap, inputs.model.nodes))
    spent = 0
    attempt: Attempt | None = None
    if walk.known:
        budget = Budget(walk.remaining)
        grid = grid_for(walk.gap, inputs.model.nodes)
        attempt = solve_from(constants, resolution, grid, _extrapolate(walk.known), budget)
        spent, walk.remaining = budget.spent, budget.remaining
    if attempt is None or not attempt.converged:
        allowed = min(budget_for(resolution).remaining, SHARE * walk.remaining)
        allowed = allowed if allowed > FEWEST_STEPS else 0.0
        budget = Budget(allowed)
        attempt = solve_cold(constants, resolution, budget)
        spent, walk.remaining = spent + budget.spent, walk.remaining - (allowed - budget.remaining)
    walk.known = [*walk.known[-1:], attempt.state] if attempt.converged else []
    return result(inputs, scale, constants, attempt, spent)


def _regrade(walk: _Walk, gap: float, nodes: int) -> float:
    """The film the mesh is graded for; where that changes, the known states move to the new mesh."""
    if 1.0 / REGRADED <= gap / walk.gap <= REGRADED:
        return walk.gap
    old, new = grid_for(walk.gap, nodes), grid_for(gap, nodes)
    walk.known = [interpolate(state, old.x, new.x) for state in walk.known]
    walk.gap = gap
    return gap


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
