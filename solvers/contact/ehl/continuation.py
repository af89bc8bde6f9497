"""Solution of a single contact by iterations that start from the pressure of the dry contact.

If the cheapest way to the solution fails, the module tries further ways, as long as the budget of Newton steps lasts.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import inf, sqrt
from typing import Literal

import numpy as np

from solvers.arrays import FloatArray
from solvers.contact.ehl.grid import Grid, grid_for
from solvers.contact.ehl.newton import solve_coupled, solve_isothermal
from solvers.contact.ehl.problem import Problem
from solvers.contact.ehl.rheology import softened
from solvers.contact.ehl.state import State, Work, no_steps, work_arrays
from solvers.contact.ehl.temperature import march_temperatures

STEPS_A_SOLVE = 60  # limit of Newton steps on one mesh
STEPS_IN_ALL = 500.0  # limit per contact, in Newton steps at 121 x 21 nodes; these steps take about 0.25 s
STEPS_ON_FINEST = 25  # the budget suffices for this number of steps on the finest mesh, however fine this mesh is
STEPS_TO_REFINE = 100.0  # limit per contact for solutions on finer meshes, in Newton steps at 121 x 21 nodes
Stage = Literal["isothermal", "coupling"]

COARSEST = 61  # number of nodes of the first mesh, chosen for speed
TIGHT = (1e-5, 0.01)  # tolerances of P and of temperature [K]
LOOSE = (1e-3, 1.0)  # tolerances of P and of temperature [K] on meshes that only prepare the next mesh
MARCH = 5  # largest cost of a march of temperatures, in Newton steps
# Shares of the full speed, a factor of 3 apart. The contact is solved at these speeds first if the solution at the
# full speed does not converge at once.
SPEED_STEPS = (1 / 27, 1 / 9, 1 / 3)
SOFT_STRESSES = tuple(5e6 * 2.0**k for k in range(10))  # Pa, Eyring stresses of the successive solutions


@dataclass(frozen=True, slots=True)
class Resolution:
    """Numbers of nodes of the finest mesh of a contact: `nodes` along the contact, `film_nodes` across the film.

    The spacing of the nodes along the contact suits a film of thickness `gap` (in b^2/R, where b is the Hertzian half
    width and R is the reduced radius). The iteration for a thermal film starts from an isothermal film. The temperature
    of this isothermal film is `entry_temperature` [K].
    """

    gap: float
    entry_temperature: float
    nodes: int
    film_nodes: int
    thermal: bool


@dataclass(slots=True)
class Budget:
    """Budget for Newton steps in units of one at 121 x 21 nodes; a part is deducted from the budget `of` too."""

    remaining: float
    spent: int = 0
    of: "Budget | None" = None

    def part(self, most: float = inf) -> "Budget":
        """Return a part of this budget, of at most `most` units. Costs of the part are deducted from both budgets."""
        return Budget(min(most, self.remaining), of=self)

    def steps(self, resolution: Resolution, nodes: int) -> int:
        """Newton steps that the budget allows on `nodes` nodes, at most `STEPS_A_SOLVE`."""
        return min(STEPS_A_SOLVE, int(self.remaining / price(resolution, nodes)))

    def charge(self, resolution: Resolution, nodes: int, steps: int) -> None:
        """Deduct the cost of `steps` Newton steps on a mesh with `nodes` nodes from the remaining budget."""
        self.pay(steps * price(resolution, nodes), steps)

    def pay(self, units: float, steps: int = 0) -> None:
        """Deduct `units` from the remaining budget, and add `steps` to the number of Newton steps taken."""
        self.remaining -= units
        self.spent += steps
        if self.of is not None:
            self.of.pay(units, steps)


def budget_for(resolution: Resolution) -> Budget:
    """Return the budget of one contact."""
    return Budget(max(STEPS_IN_ALL, STEPS_ON_FINEST * price(resolution, resolution.nodes)))


def price(resolution: Resolution, nodes: int) -> float:
    """Cost of a Newton step over that at 121 x 21 nodes, fitted to measured times."""
    relative = nodes / 121
    if resolution.thermal:
        return relative**2 * (0.4 + 0.4 * resolution.film_nodes / 21 + 0.2 * relative)
    return relative**2 * (0.1 + 0.1 * relative)


@dataclass(slots=True)
class Attempt:
    """Result of one attempt to solve a contact.

    `state` is the last state, and `grid` is its mesh. `converged` tells whether the state has converged. `stage` is
    "coupling" if the last iteration also solved for the temperatures, and otherwise "isothermal". `eyring_stress` has a
    value only if the attempt raised the Eyring stress in steps, and one of the steps failed. The value is the stress of
    the last successful step [Pa], or 0 if the first step failed.
    """

    grid: Grid
    state: State
    work: Work
    converged: bool
    stage: Stage
    eyring_stress: float | None = None


def solve_cold(problem: Problem, resolution: Resolution, budget: Budget) -> Attempt:
    """Attempts from the Hertzian pressure until one converges or the budget is used up; return the best."""
    nearest: Attempt | None = None
    for attempt in _attempts(problem, resolution, budget):
        if attempt.converged:
            return attempt
        if nearest is None or _distance(attempt) < _distance(nearest):
            nearest = attempt
        if budget.steps(resolution, resolution.nodes) < 1:
            break
    assert nearest is not None
    return nearest


def _distance(attempt: Attempt) -> tuple[int, float]:
    """Key by distance from a solution: a finer mesh is nearer, then a smaller last change of pressure."""
    change = float(attempt.state.history[0].pressure_change)
    return -attempt.grid.x.size, change if np.isfinite(change) else np.inf


def _attempts(problem: Problem, resolution: Resolution, budget: Budget) -> Iterator[Attempt]:
    """Yield attempts that are made in different ways, the cheapest way first."""
    coarse = _start(problem, resolution, budget)
    yield _climb(problem, resolution, coarse, _levels(resolution.nodes, 2.0), budget)
    yield _climb(problem, resolution, _start(problem, resolution, budget), _levels(resolution.nodes, 1.25), budget)
    if resolution.thermal:
        yield _from_soft_film(problem, resolution, budget)
    yield _from_slow_film(problem, resolution, budget)
    yield _climb(problem, resolution, _start(problem, resolution, budget), _levels(resolution.nodes, 1.1), budget)


def _levels(nodes: int, ratio: float) -> list[int]:
    """Numbers of nodes of successive meshes up to `nodes`, each at most about `ratio` times the one before."""
    levels = [min(COARSEST, nodes)]
    while levels[-1] < nodes:
        finer = round((levels[-1] - 1) * ratio / 2) * 2 + 1
        levels.append(nodes if finer > 0.85 * nodes else finer)
    return levels


def _start(problem: Problem, resolution: Resolution, budget: Budget) -> Attempt:
    """Solve the isothermal contact on the coarsest mesh; for a thermal film, also compute a first temperature guess."""
    grid = grid_for(resolution.gap, min(COARSEST, resolution.nodes))
    work = work_arrays(grid.x.size, resolution.film_nodes)
    state = _dry_state(grid, resolution)
    steps = budget.steps(resolution, grid.x.size)
    isothermal = problem._replace(inlet=resolution.entry_temperature)
    final = not resolution.thermal and resolution.nodes <= COARSEST
    tolerance = TIGHT[0] * 1e-2 if final else LOOSE[0]
    converged = bool(solve_isothermal(isothermal, grid, state, work, steps, tolerance))
    budget.charge(resolution, grid.x.size, int(state.history[0].iterations))
    if resolution.thermal:
        march_temperatures(problem, grid, state, work)
        budget.pay(MARCH * price(resolution, grid.x.size))
    return Attempt(grid, state, work, converged=converged, stage="isothermal")


def _dry_state(grid: Grid, resolution: Resolution) -> State:
    """Hertzian pressure, scaled to carry the load on this mesh, and a film of the expected thickness h.

    The pressure extends over b, or over (2 R h)^1/2 if larger.
    """
    width = max(1.0, sqrt(2.0 * resolution.gap))
    pressure = np.sqrt(np.maximum(1.0 - (grid.x / width) ** 2, 0.0))
    pressure *= 0.5 * np.pi / float(grid.weights @ pressure)
    centre = int(np.abs(grid.x).argmin())
    return State(
        pressure=pressure,
        separation=np.array([resolution.gap - float(grid.deflection[centre] @ pressure)]),
        temperature=np.zeros((grid.x.size, resolution.film_nodes)),
        cavitated=grid.x > width,
        history=no_steps(),
    )


def _climb(problem: Problem, resolution: Resolution, start: Attempt, levels: Sequence[int], budget: Budget) -> Attempt:
    """Solve on one mesh after the other; only the finest has to meet `TIGHT`, the others `LOOSE`."""
    attempt = start
    if not resolution.thermal and len(levels) == 1:
        return attempt
    for nodes in levels:
        grid = grid_for(resolution.gap, nodes)
        same = nodes == attempt.grid.x.size
        if same and not resolution.thermal:
            continue
        state = attempt.state if same else interpolate(attempt.state, attempt.grid.x, grid.x)
        tolerances = TIGHT if nodes == levels[-1] else LOOSE
        attempt = polish(problem, resolution, grid, state, tolerances, budget)
        if not np.all(np.isfinite(attempt.state.pressure)):
            break
    return attempt


def polish(
    problem: Problem,
    resolution: Resolution,
    grid: Grid,
    state: State,
    tolerances: tuple[float, float],
    budget: Budget,
) -> Attempt:
    """Solve by Newton's method on one mesh. The iteration starts from `state`, and changes `state` in place."""
    work = work_arrays(grid.x.size, resolution.film_nodes)
    steps = budget.steps(resolution, grid.x.size)
    state.history[:] = no_steps()
    if resolution.thermal:
        converged = bool(solve_coupled(problem, grid, state, work, steps, tolerances[0], tolerances[1]))
    else:
        converged = bool(solve_isothermal(problem, grid, state, work, steps, tolerances[0] * 1e-2))
    budget.charge(resolution, grid.x.size, int(state.history[0].iterations))
    stage: Stage = "coupling" if resolution.thermal else "isothermal"
    return Attempt(grid, state, work, converged=converged, stage=stage)


def interpolate(state: State, x: FloatArray, onto: FloatArray) -> State:
    """Interpolate a state linearly from the nodes `x` to the nodes `onto` of another mesh."""
    right = np.searchsorted(x, onto).clip(1, x.size - 1)
    share = ((onto - x[right - 1]) / (x[right] - x[right - 1])).clip(0.0, 1.0)[:, None]
    pressure = np.interp(onto, x, state.pressure)
    return State(
        pressure=pressure,
        separation=state.separation.copy(),
        temperature=state.temperature[right - 1] * (1.0 - share) + state.temperature[right] * share,
        cavitated=(pressure <= 0.0) & (onto > 0.0),
        history=no_steps(),
    )


def _from_slow_film(problem: Problem, resolution: Resolution, budget: Budget) -> Attempt:
    """On the coarsest mesh raise both speeds in steps (thin films converge easily), then solve on finer meshes."""
    attempt: Attempt | None = None
    for factor in (*SPEED_STEPS, 1.0):
        slower = problem._replace(
            speed_1=problem.speed_1 * factor,
            speed_2=problem.speed_2 * factor,
            flux_scale=problem.flux_scale * factor,
            surface_heating_1=problem.surface_heating_1 / sqrt(factor),
            surface_heating_2=problem.surface_heating_2 / sqrt(factor),
        )
        if attempt is None:
            attempt = _start(slower, resolution, budget)
        attempt = polish(slower, resolution, attempt.grid, attempt.state, LOOSE, budget)
    assert attempt is not None
    return _climb(problem, resolution, attempt, _levels(resolution.nodes, 1.25), budget)


def _from_soft_film(problem: Problem, resolution: Resolution, budget: Budget) -> Attempt:
    """On the coarsest mesh, raise the Eyring stress in steps to its given value; then solve on the finer meshes."""
    attempt: Attempt | None = None
    reached = 0.0
    for stress in SOFT_STRESSES:
        softer = softened(problem, stress)
        if softer is None:
            break
        if attempt is None:
            attempt = _start(softer, resolution, budget)
        attempt = polish(softer, resolution, attempt.grid, attempt.state, LOOSE, budget)
        if not attempt.converged:
            attempt.eyring_stress = reached
            return attempt
        reached = stress
    if attempt is None:
        attempt = _start(problem, resolution, budget)
    return _climb(problem, resolution, attempt, _levels(resolution.nodes, 1.25), budget)
