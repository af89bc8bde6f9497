"""A sequence of contacts, as along the flank of a gear: each solved from its neighbour."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from math import inf

import numpy as np

from solvers.arrays import FloatArray
from solvers.contact.ehl.checks import check
from solvers.contact.ehl.continuation import (
    TIGHT,
    Attempt,
    Budget,
    Resolution,
    budget_for,
    interpolate,
    polish,
    price,
    solve_cold,
)
from solvers.contact.ehl.grid import Grid, grid_for
from solvers.contact.ehl.inputs import LineContactInputs
from solvers.contact.ehl.model import conclude, resolution_for
from solvers.contact.ehl.problem import Problem, groups, problem
from solvers.contact.ehl.results import LineContactResult
from solvers.contact.ehl.state import State, no_steps
from solvers.errors import InvalidInput

# For a guess to lead to its contact. Where pressure falls steeply between two nodes, the discrete film has a solution
# for each pair of nodes that the fall may stand between. A guess that takes longer has lost its own, and where it ends
# would depend on where it began: such a contact is solved from nothing, as it is alone.
STEPS_FROM_NEIGHBOURS = 5.0
MOST_KNOWN = 5  # states that are extrapolated: more only add the errors that they were left with
HOPELESS = 12  # contacts that fail one after the other, even from nothing; those behind them hardly do better
SHARE_WITHOUT_HOPE = 0.1  # of the steps of a contact alone, for each of those: enough for an easy one


@dataclass(slots=True)
class _Walk:
    """Where the path has got to: the states solved last, their mesh, contacts failed in a row."""

    known: list[State] = field(default_factory=list)
    grid: Grid | None = None
    failures: int = 0

    def move_to(self, grid: Grid) -> None:
        """Interpolate the known states onto another mesh, where it is another."""
        if self.grid is not None and self.grid is not grid:
            self.known = [interpolate(state, self.grid.x, grid.x) for state in self.known]
        self.grid = grid

    def arrive(self, solved: State | None) -> None:
        """Go on from a contact, solved or not."""
        self.known = [] if solved is None else [*self.known[1 - MOST_KNOWN :], solved]
        self.failures = self.failures + 1 if solved is None else 0


def solve_path(contacts: Sequence[LineContactInputs]) -> list[LineContactResult]:
    """Solve neighbouring contacts, each on its own mesh; each result is that of the contact solved alone.

    The first starts from nothing, the others from the pressures, temperatures and separation of those before,
    extrapolated. What does not converge so at once is solved as if it were alone; what fails then too neither stops
    its neighbours nor is filled in. Behind many that fail one after the other, each is given fewer steps, until one
    converges.

    Raises InvalidInput as `check` does, and mixed_models unless all contacts share one model.
    """
    for inputs in contacts:
        check(inputs)
        if inputs.model != contacts[0].model:
            raise InvalidInput("mixed_models", "all contacts of a path must share one model", "model")
    walk = _Walk()
    return [_solve_next(inputs, walk) for inputs in contacts]


def _solve_next(inputs: LineContactInputs, walk: _Walk) -> LineContactResult:
    """From the neighbours if there are any, else, or if that fails, from nothing; the next contact starts from here."""
    constants = problem(inputs, groups(inputs))
    resolution = resolution_for(inputs)
    spent = Budget(inf)
    for attempt in _attempts(constants, resolution, walk, spent):
        result = conclude(inputs, constants, resolution, attempt, spent.spent)
        if result.status != "no_solution":
            break
    walk.arrive(None if result.status == "no_solution" else attempt.state)
    return result


def _attempts(constants: Problem, resolution: Resolution, walk: _Walk, spent: Budget) -> Iterator[Attempt]:
    """From the neighbours, then as a contact alone."""
    grid = grid_for(resolution.gap, resolution.nodes)
    walk.move_to(grid)
    if walk.known:
        guess = _guess(walk.known)
        most = STEPS_FROM_NEIGHBOURS * price(resolution, resolution.nodes)
        yield polish(constants, resolution, grid, guess, TIGHT, spent.part(most))
    share = 1.0 if walk.failures < HOPELESS else SHARE_WITHOUT_HOPE
    yield solve_cold(constants, resolution, spent.part(share * budget_for(resolution).remaining))


def _guess(known: Sequence[State]) -> State:
    """The next state, extrapolated and made physical; what is broken in the last one stays so."""
    last = known[-1]
    film = _extrapolated(np.array([np.append(state.pressure, state.separation) for state in known]))
    pressure = np.where(last.cavitated, 0.0, np.maximum(film[:-1], 0.0))
    temperature = _extrapolated(np.array([state.temperature for state in known]))
    return State(
        pressure=pressure,
        separation=film[-1:].copy(),
        temperature=np.maximum(temperature, 0.9 * last.temperature.min()),
        cavitated=last.cavitated.copy(),
        history=no_steps(),
    )


def _extrapolated(rows: FloatArray) -> FloatArray:
    """The next of `rows` (m, ...) by Newton's backward differences: as many orders as shrink, row by row of the last.

    The difference of an order is what all below it would have missed the last one by.
    """
    differences = [rows[-1]]
    while len(rows) > 1:
        rows = rows[1:] - rows[:-1]
        differences.append(rows[-1])
    sizes = [np.abs(difference).max(axis=-1, keepdims=True) for difference in differences[1:]]
    following, shrinking = differences[0], np.full((1,), True)
    for order, difference in enumerate(differences[1:]):
        shrinking = shrinking & (order + 1 == len(sizes) or sizes[order + 1] < sizes[order])
        following = following + np.where(shrinking, difference, 0.0)
    return np.asarray(following)
