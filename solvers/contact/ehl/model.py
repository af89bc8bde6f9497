"""The thermal elastohydrodynamic line contact (Xue, Zhang and Wang, sections III and IV)."""

from dataclasses import replace
from math import isfinite

from solvers.contact.ehl import measures
from solvers.contact.ehl.budget import Resolution, budget_for
from solvers.contact.ehl.checks import check
from solvers.contact.ehl.continuation import TIGHT, Attempt, solve_cold
from solvers.contact.ehl.dimensionless import (
    Groups,
    dowson_higginson_film,
    entry_temperature,
    expected_gap,
    groups,
)
from solvers.contact.ehl.inputs import Contact, LineContactInputs, Model
from solvers.contact.ehl.notices import failure_notice, input_notices, result_notices
from solvers.contact.ehl.problem import Problem, peclet_number, problem
from solvers.contact.ehl.results import (
    Convergence,
    Derived,
    Dimensionless,
    FilmThickness,
    HertzContact,
    LineContactResult,
)
from solvers.lubricants import Lubricant

WORST_BALANCE = 1e-3
WORST_LOAD = 1e-9


def solve(inputs: LineContactInputs) -> LineContactResult:
    """Pressure, film, temperature and friction of one contact.

    Raises InvalidInput as `inputs.check` does; what cannot be converged is a result with status no_solution.
    """
    check(inputs)
    scales = groups(inputs)
    constants = problem(inputs, scales)
    resolution = resolution_for(inputs, expected_gap(inputs))
    budget = budget_for(resolution)
    return result(inputs, scales, constants, solve_cold(constants, resolution, budget), budget.spent)


def resolution_for(inputs: LineContactInputs, gap: float) -> Resolution:
    """Mesh of the contact, graded for a film of `gap` (in b^2/R)."""
    model = inputs.model
    return Resolution(
        gap=gap,
        entry_temperature=entry_temperature(inputs),
        nodes=model.nodes,
        film_nodes=model.film_nodes,
        thermal=model.thermal,
    )


def result(
    inputs: LineContactInputs, scales: Groups, constants: Problem, attempt: Attempt, iterations: int
) -> LineContactResult:
    """Everything read off an attempt: all of it if the attempt meets every criterion, else why not."""
    thermal = inputs.model.thermal
    dimensionless = _dimensionless(inputs, scales)
    notices = input_notices(inputs, dimensionless)
    if attempt.converged:
        measures.settle(constants, attempt, thermal)
    heat = measures.heat(constants, attempt) if thermal and attempt.converged else None
    balanced = heat is None or heat.balance_error < WORST_BALANCE or measures.temperature_range(attempt) < TIGHT[1]
    convergence = _convergence(attempt, iterations, thermal, balanced)
    unsolved = LineContactResult(
        status="no_solution",
        hertz=HertzContact(scales.half_width, scales.maximum_pressure),
        dimensionless=dimensionless,
        film=FilmThickness(None, None, None, dowson_higginson_film(inputs)),
        pressure=None,
        temperature=None,
        friction=None,
        heat=None,
        convergence=convergence,
        curves=None,
        field=None,
        derived=Derived(inputs.contact.entrainment_speed, scales.reduced_modulus),
        warnings=tuple(notices),
    )
    if not (attempt.converged and balanced and convergence.load_error < WORST_LOAD):
        return replace(unsolved, warnings=(*notices, failure_notice(convergence)))
    film = _film(inputs, constants, attempt)
    friction = measures.friction(constants, attempt, inputs)
    notices += result_notices(film, friction, heat)
    return replace(
        unsolved,
        status="ok_with_warnings" if notices else "ok",
        film=film,
        pressure=measures.pressure(constants, attempt),
        temperature=measures.temperature(constants, attempt) if thermal else None,
        friction=friction,
        heat=heat,
        curves=measures.curves(constants, attempt, thermal),
        field=measures.field(constants, attempt) if thermal else None,
        warnings=tuple(notices),
    )


def _dimensionless(inputs: LineContactInputs, scales: Groups) -> Dimensionless:
    contact = inputs.contact
    return Dimensionless(
        moes_m=scales.moes_m,
        moes_l=scales.moes_l,
        slide_roll_ratio=contact.slide_roll_ratio,
        peclet_1=peclet_number(inputs.surface_1, contact.speed_1, scales),
        peclet_2=peclet_number(inputs.surface_2, contact.speed_2, scales),
    )


def _convergence(attempt: Attempt, iterations: int, thermal: bool, balanced: bool) -> Convergence:
    changes = [float(change) if isfinite(change) else None for change in attempt.state.history[1:]]
    return Convergence(
        iterations=iterations,
        pressure_change=changes[0],
        temperature_change=changes[1] if thermal else None,
        load_error=measures.load_error(attempt),
        nodes=attempt.grid.x.size,
        stage=attempt.stage if balanced else "heat_balance",
        eyring_stress=attempt.eyring_stress,
    )


def _film(inputs: LineContactInputs, constants: Problem, attempt: Attempt) -> FilmThickness:
    heights = measures.film_heights(constants, attempt)
    thinnest = int(heights.argmin())
    return FilmThickness(
        central=measures.at_centre(attempt, heights),
        minimum=float(heights[thinnest]),
        minimum_at=float(attempt.grid.x[thinnest]) * constants.half_width,
        dowson_higginson=dowson_higginson_film(inputs),
    )


def warm_up() -> None:
    """Compile, or load from the cache, every kernel, by small solves; flags choose the laws, not other code."""
    contact = Contact(line_load=1e5, radius=0.01, speed_1=2.0, speed_2=1.5)
    for model in (Model(nodes=61), Model(nodes=61, thermal=False)):
        solve(LineContactInputs(contact, model=model))
    Lubricant().density_at(0.0, 300.0)
