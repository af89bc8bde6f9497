"""A sequence of contacts, such as those along a tooth flank. Earlier solutions give the start for the next contact."""

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

# Largest number of Newton steps from a start that is extrapolated from earlier contacts. If the pressure falls
# steeply from one node to the next, the discrete equations have several solutions: one for each pair of nodes between
# which the fall can lie. A start that needs more steps often ends in the solution for a neighbouring pair of nodes.
# Therefore the contact is then solved as if it were alone.
STEPS_FROM_NEIGHBOURS = 5.0
MOST_STATES = 5  # largest number of states in an extrapolation; more states would only add their remaining errors
HOPELESS = 12  # number of consecutive contacts without a solution, after which further contacts rarely converge
SHARE_WITHOUT_HOPE = 0.1  # share of the usual number of steps that a contact gets after `HOPELESS` failures


@dataclass(slots=True)
class _Walk:
    """States of the contacts solved last (none after a failure), their mesh, and the number of consecutive failures."""

    states: list[State] = field(default_factory=list)
    grid: Grid | None = None
    failures: int = 0

    def move_to(self, grid: Grid) -> None:
        """Interpolate the states onto a mesh, unless they already lie on this mesh."""
        if self.grid is not None and self.grid is not grid:
            self.states = [interpolate(state, self.grid.x, grid.x) for state in self.states]
        self.grid = grid

    def arrive(self, state: State | None) -> None:
        """Record the state of a solved contact, or a failure if `state` is None."""
        self.states = [] if state is None else [*self.states[1 - MOST_STATES :], state]
        self.failures = self.failures + 1 if state is None else 0


def solve_path(contacts: Sequence[LineContactInputs]) -> list[LineContactResult]:
    """Solve neighbouring contacts, each contact on its own mesh.

    Parameters
    ----------
    contacts : sequence of LineContactInputs
        Contacts in the order of the path; all share one model.

    Returns
    -------
    list of LineContactResult
        Results of the contacts, as if each contact were solved alone.

    Raises
    ------
    InvalidInput
        The codes of `check`; also `mixed_models` if the contacts do not share one model.

    Notes
    -----
    If the previous contact was solved, the iteration for a contact starts from extrapolated pressures, temperatures and
    separation. If this iteration does not converge within a few steps, the contact is solved as if it were alone. If
    that fails as well, the contact has no solution, and the next contacts are still solved. After many consecutive
    failures each contact is given fewer steps, until a contact converges again.

    Examples
    --------
    >>> from solvers.contact import ehl
    >>> from solvers.lubricants import Lubricant
    >>> loads = (250e3, 260e3)
    >>> path = [ehl.LineContactInputs(ehl.Contact(w, 6.5e-3, 1.018, 3.708), lubricant=Lubricant()) for w in loads]
    >>> [result.status for result in ehl.solve_path(path)]
    ['ok', 'ok']
    """
    for inputs in contacts:
        check(inputs)
        if inputs.model != contacts[0].model:
            raise InvalidInput("mixed_models", "all contacts of a path must be computed with the same model", "model")
    walk = _Walk()
    return [_solve_next(inputs, walk) for inputs in contacts]


def _solve_next(inputs: LineContactInputs, walk: _Walk) -> LineContactResult:
    """Solve a contact from earlier solutions; if there are none or the iteration fails, as if it were alone."""
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
    """Yield an attempt that starts from earlier solutions, then an attempt that ignores these solutions."""
    grid = grid_for(resolution.gap, resolution.nodes)
    walk.move_to(grid)
    if walk.states:
        guess = _guess(walk.states)
        most = STEPS_FROM_NEIGHBOURS * price(resolution, resolution.nodes)
        yield polish(constants, resolution, grid, guess, TIGHT, spent.part(most))
    share = 1.0 if walk.failures < HOPELESS else SHARE_WITHOUT_HOPE
    yield solve_cold(constants, resolution, spent.part(share * budget_for(resolution).remaining))


def _guess(states: Sequence[State]) -> State:
    """Extrapolated state, limited to physical values; the film is broken where that of the last contact is."""
    last = states[-1]
    film = _extrapolated(np.array([np.append(state.pressure, state.separation) for state in states]))
    pressure = np.where(last.cavitated, 0.0, np.maximum(film[:-1], 0.0))
    temperature = _extrapolated(np.array([state.temperature for state in states]))
    return State(
        pressure=pressure,
        separation=film[-1:].copy(),
        temperature=np.maximum(temperature, 0.9 * last.temperature.min()),
        cavitated=last.cavitated.copy(),
        history=no_steps(),
    )


def _extrapolated(rows: FloatArray) -> FloatArray:
    """Extrapolate `rows` (m, ...) to the next row by Newton's backward differences.

    The result is the last row plus the differences of order 1, 2 and so on. The sum ends before the first order whose
    difference is not larger than the difference of the next order. The reason is a test with the known last row: if the
    earlier rows predict the last row with differences up to order k, the error is the difference of order k + 1.
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
