"""A sequence of contacts, as along the flank of a gear: each solved from its neighbour."""

from collections.abc import Iterator, Sequence
from dataclasses import astuple, dataclass, field, replace

import numpy as np

from solvers.contact.ehl.budget import Budget, Resolution, budget_for, price, refinement_budget
from solvers.contact.ehl.checks import check
from solvers.contact.ehl.continuation import LOOSE, TIGHT, Attempt, interpolate, polish, solve_cold
from solvers.contact.ehl.dimensionless import groups
from solvers.contact.ehl.inputs import Contact, LineContactInputs
from solvers.contact.ehl.mesh import Grid, grid_for
from solvers.contact.ehl.model import conclude, resolution_for
from solvers.contact.ehl.problem import Problem, problem
from solvers.contact.ehl.results import LineContactResult
from solvers.contact.ehl.state import State, no_steps
from solvers.errors import InvalidInput

CONTACTS_FROM_NOTHING = 2.0  # that a whole path may pay for, beside a few steps for each point
STEPS_A_POINT = 4.0
STEPS_FROM_NEIGHBOURS = 20.0  # for one guess; where that is not enough it seldom leads anywhere
SHARE = 0.25  # of what is left, for one point that has to start from nothing
EXTRAPOLATION = ((1.0,), (-1.0, 2.0), (1.0, -3.0, 3.0))  # weights of so many states in the next
STRIDES = 4  # from one contact to the next, where one does not lead there
FEWEST_STEPS = 10.0  # that are worth a start from nothing


@dataclass(slots=True)
class _Walk:
    """Where the path has got to: steps left, the last contact, the states solved last (at most three), their mesh."""

    budget: Budget
    for_refinement: Budget
    contact: Contact
    known: list[State] = field(default_factory=list)
    grid: Grid | None = None

    def move_to(self, grid: Grid) -> None:
        """Interpolate the known states onto another mesh, where it is another."""
        if self.grid is not None and self.grid is not grid:
            self.known = [interpolate(state, self.grid.x, grid.x) for state in self.known]
        self.grid = grid


def solve_path(contacts: Sequence[LineContactInputs]) -> list[LineContactResult]:
    """Solve neighbouring contacts, each on its own mesh; each result is that of the contact solved alone.

    The first starts from nothing, the others from the pressures, temperatures and separation of those before,
    extrapolated. What does not converge so is approached in smaller steps, then solved from nothing; what fails then
    too neither stops its neighbours nor is filled in. All points share one budget of steps: the more of them fail, the
    fewer each further one is given.

    Raises InvalidInput as `check` does, and mixed_models unless all contacts share one model.
    """
    for inputs in contacts:
        check(inputs)
        if inputs.model != contacts[0].model:
            raise InvalidInput("mixed_models", "all contacts of a path must share one model", "model")
    if not contacts:
        return []
    resolution = resolution_for(contacts[0])
    steps = STEPS_A_POINT * price(resolution, resolution.nodes) * len(contacts)
    budget = Budget(CONTACTS_FROM_NOTHING * budget_for(resolution).remaining + steps)
    walk = _Walk(budget, refinement_budget(len(contacts)), contacts[0].contact)
    return [_solve_next(inputs, walk) for inputs in contacts]


def _solve_next(inputs: LineContactInputs, walk: _Walk) -> LineContactResult:
    """From the neighbours if there are any, else, or if that fails, from nothing; the walk goes on from here."""
    constants = problem(inputs, groups(inputs))
    resolution = resolution_for(inputs)
    grid = grid_for(resolution.gap, resolution.nodes)
    walk.move_to(grid)
    point = walk.budget.part()
    attempt = _from_neighbours(inputs, constants, resolution, grid, walk, point) if walk.known else None
    if attempt is None or not attempt.converged:
        allowed = min(budget_for(resolution).remaining, SHARE * walk.budget.remaining)
        attempt = solve_cold(constants, resolution, point.part(allowed if allowed > FEWEST_STEPS else 0.0))
    walk.known, walk.contact = ([*walk.known[-2:], attempt.state] if attempt.converged else []), inputs.contact
    return conclude(inputs, constants, resolution, attempt, point.spent, walk.for_refinement)


def _from_neighbours(
    inputs: LineContactInputs, constants: Problem, resolution: Resolution, grid: Grid, walk: _Walk, point: Budget
) -> Attempt:
    """In one step from what the neighbours suggest; if that fails in steps of load, radius and speeds."""
    most = STEPS_FROM_NEIGHBOURS * price(resolution, resolution.nodes)
    for guess in _guesses(walk.known):
        attempt = polish(constants, resolution, grid, guess, TIGHT, point.part(most))
        if attempt.converged:
            return attempt
    last = walk.known[-1:]
    for step in range(1, STRIDES + 1):
        between = replace(inputs, contact=_between(walk.contact, inputs.contact, step / STRIDES))
        guess = _combined(last[-2:], EXTRAPOLATION[len(last[-2:]) - 1])
        stride = problem(between, groups(between))
        attempt = polish(stride, resolution, grid, guess, LOOSE if step < STRIDES else TIGHT, point.part(most))
        if not attempt.converged:
            break
        last.append(attempt.state)
    return attempt


def _between(one: Contact, other: Contact, share: float) -> Contact:
    """A contact part of the way from one to another, by the logarithms of load, radius and speeds."""
    ways = [
        a * (b / a) ** share if a > 0.0 < b else a + (b - a) * share
        for a, b in zip(astuple(one), astuple(other), strict=True)
    ]
    return Contact(*ways)


def _guesses(known: Sequence[State]) -> Iterator[State]:
    """The next state if the changes so far go on, as parabola or line; then the last state itself."""
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
