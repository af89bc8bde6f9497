"""A sequence of contacts, as along the flank of a gear: each solved from its neighbour."""

from collections.abc import Iterator, Sequence
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
STEPS_FROM_NEIGHBOURS = 20.0  # for one guess; where that is not enough it seldom leads anywhere
SHARE = 0.25  # of what is left, for one point that has to start from nothing
EXTRAPOLATION = ((1.0,), (-1.0, 2.0), (1.0, -3.0, 3.0))  # weights of so many states in the next
FEWEST_STEPS = 10.0  # that are worth a start from nothing


@dataclass(slots=True)
class _Walk:
    """Where the path has got to: its mesh, the states solved last (at most three), what steps are left for the rest."""

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
    grid = grid_for(walk.gap, inputs.model.nodes)
    for guess in _guesses(walk.known):
        allowed = min(STEPS_FROM_NEIGHBOURS * price(resolution, inputs.model.nodes), walk.remaining)
        budget = Budget(allowed)
        attempt = solve_from(constants, resolution, grid, guess, budget)
        spent, walk.remaining = spent + budget.spent, walk.remaining - (allowed - budget.remaining)
        if attempt.converged:
            break
    if attempt is None or not attempt.converged:
        allowed = min(budget_for(resolution).remaining, SHARE * walk.remaining)
        allowed = allowed if allowed > FEWEST_STEPS else 0.0
        budget = Budget(allowed)
        attempt = solve_cold(constants, resolution, budget)
        spent, walk.remaining = spent + budget.spent, walk.remaining - (allowed - budget.remaining)
    walk.known = [*walk.known[-2:], attempt.state] if attempt.converged else []
    return result(inputs, scale, constants, attempt, spent)


def _regrade(walk: _Walk, gap: float, nodes: int) -> float:
    """The film the mesh is graded for; where that changes, the known states move to the new mesh."""
    if 1.0 / REGRADED <= gap / walk.gap <= REGRADED:
        return walk.gap
    old, new = grid_for(walk.gap, nodes), grid_for(gap, nodes)
    walk.known = [interpolate(state, old.x, new.x) for state in walk.known]
    walk.gap = gap
    return gap


def _guesses(known: Sequence[State]) -> Iterator[State]:
    """The next state if the changes so far go on, as parabola or line; then the last state itself."""
    if known:
        yield _combined(known, EXTRAPOLATION[len(known) - 1])
    if len(known) > 1:
        yield _combined(known[-1:], EXTRAPOLATION[0])


def _combined(known: Sequence[State], weights: Sequence[float]) -> State:
    """A weighted sum of states, made physical; what is broken in the last one stays so."""
    last = known[-1]
    pressure = np.maximum(sum(w * state.pressure for w, state in zip(weights, known, strict=True)), 0.0)
    pressure[last.cavitated] = 0.0
    temperature = np.asarray(sum(w * state.temperature for w, state in zip(weights, known, strict=True)))
    return State(
        pressure=pressure,
        separation=np.asarray(sum(w * state.separation for w, state in zip(weights, known, strict=True))),
        temperature=np.maximum(temperature, 0.9 * last.temperature.min()),
        cavitated=last.cavitated.copy(),
        history=no_steps(),
    )
