"""The thermal elastohydrodynamic line contact (Xue, Zhang and Wang, sections III and IV)."""

from dataclasses import replace
from math import isfinite

from solvers.contact.ehl import measures, refinement
from solvers.contact.ehl.checks import check
from solvers.contact.ehl.continuation import STEPS_TO_REFINE, TIGHT, Attempt, Budget, Resolution, budget_for, solve_cold
from solvers.contact.ehl.inputs import Contact, LineContactInputs, Model
from solvers.contact.ehl.notices import failure_notice, input_notices, mesh_notices, result_notices
from solvers.contact.ehl.problem import (
    Groups,
    Problem,
    dowson_higginson_film,
    entry_temperature,
    expected_gap,
    groups,
    peclet_number,
    problem,
)
from solvers.contact.ehl.refinement import refine
from solvers.contact.ehl.results import (
    Convergence,
    Derived,
    Dimensionless,
    FilmThickness,
    HertzContact,
    LineContactResult,
    Stage,
)
from solvers.lubricants import Lubricant, oil_in_use

WORST_BALANCE = 1e-3  # largest accepted relative error of the heat balance; ten times `notices.BALANCE_ERROR`
WORST_LOAD = 1e-9  # largest accepted relative error of the load; far above rounding errors, far below displayed digits
WORST_DEPARTURE = 0.1  # K, largest accepted result of `refinement.departure`


def solve(inputs: LineContactInputs) -> LineContactResult:
    """Compute pressure, film, temperature and friction of one contact.

    Parameters
    ----------
    inputs : LineContactInputs
        The contact.

    Returns
    -------
    LineContactResult
        The results; if the iteration does not converge, their status is "no_solution".

    Raises
    ------
    InvalidInput
        If `checks.check` refuses the contact; the codes are those of `checks.check`.

    Examples
    --------
    >>> from solvers.contact import ehl
    >>> from solvers.lubricants import Lubricant
    >>> contact = ehl.Contact(273e3, 6.5e-3, 1.018, 3.708)
    >>> result = ehl.solve(ehl.LineContactInputs(contact, lubricant=Lubricant()))
    >>> round(result.friction.coefficient, 3)
    0.027
    """
    check(inputs)
    constants = problem(inputs, groups(inputs))
    resolution = resolution_for(inputs)
    budget = budget_for(resolution)
    attempt = solve_cold(constants, resolution, budget)
    return conclude(inputs, constants, resolution, attempt, budget.spent)


def resolution_for(inputs: LineContactInputs) -> Resolution:
    """Return the resolution of a contact; the fields are explained in `Resolution`."""
    model = inputs.model
    return Resolution(
        gap=expected_gap(inputs),
        entry_temperature=entry_temperature(inputs),
        nodes=model.nodes,
        film_nodes=model.film_nodes,
        thermal=model.thermal,
    )


def conclude(
    inputs: LineContactInputs,
    constants: Problem,
    resolution: Resolution,
    attempt: Attempt,
    iterations: int,
) -> LineContactResult:
    """Refine the mesh of an attempt if necessary, and return the results.

    If the attempt has not converged or fails a check, the status is no_solution, and a warning states the reason.
    `iterations` is the number of iterations that led to the attempt.
    """
    scales = groups(inputs)
    dimensionless = _dimensionless(inputs, scales)
    notices = input_notices(inputs, dimensionless)
    unsolved = LineContactResult(
        status="no_solution",
        hertz=HertzContact(constants.half_width, constants.maximum_pressure),
        dimensionless=dimensionless,
        film=FilmThickness(None, None, None, dowson_higginson_film(inputs)),
        pressure=None,
        temperature=None,
        friction=None,
        heat=None,
        mesh_error=None,
        convergence=_convergence(inputs, attempt, iterations),
        curves=None,
        field=None,
        derived=Derived(
            entrainment_speed=inputs.contact.entrainment_speed,
            reduced_modulus=scales.reduced_modulus,
            **oil_in_use(inputs.lubricant),
        ),
        warnings=tuple(notices),
    )
    if not attempt.converged:
        return replace(unsolved, warnings=(*notices, failure_notice(unsolved.convergence)))
    steps = Budget(STEPS_TO_REFINE)
    attempt, error = refine(inputs, constants, resolution, attempt, steps)
    convergence = _convergence(inputs, attempt, iterations + steps.spent)
    result = _read(inputs, constants, attempt, replace(unsolved, convergence=convergence))
    stage = _failed_criterion(attempt, result)
    if stage is not None:
        convergence = replace(result.convergence, stage=stage)
        return replace(unsolved, convergence=convergence, warnings=(*notices, failure_notice(convergence)))
    assert result.friction is not None
    notices += result_notices(result.film, result.friction, result.heat)
    notices += mesh_notices(error)
    return replace(result, status="ok_with_warnings" if notices else "ok", mesh_error=error, warnings=tuple(notices))


def _read(
    inputs: LineContactInputs, constants: Problem, attempt: Attempt, unsolved: LineContactResult
) -> LineContactResult:
    """Return a copy of `unsolved` that also contains the results of a converged state."""
    thermal = inputs.model.thermal
    curves = measures.curves(constants, attempt, thermal)
    field = measures.field(constants, attempt) if thermal else None
    departure = refinement.departure(inputs, curves, field) if field is not None else None
    return replace(
        unsolved,
        film=_film(inputs, constants, attempt),
        pressure=measures.pressure(constants, attempt),
        temperature=measures.temperature(constants, attempt) if thermal else None,
        friction=measures.friction(constants, attempt, inputs),
        heat=measures.heat(constants, attempt) if thermal else None,
        convergence=replace(unsolved.convergence, departure=departure),
        curves=curves,
        field=field,
    )


def _failed_criterion(attempt: Attempt, result: LineContactResult) -> Stage | None:
    """Return the stage to report if a converged state fails a check, or None if the state passes all checks.

    If the pressure does not carry the load, the result is the stage at which the iteration ended. If the heat is not
    balanced, the result is "heat_balance"; this check is omitted if all temperatures are nearly equal. If the
    temperatures fail the check of `refinement.departure`, the result is "verification".
    """
    convergence, heat = result.convergence, result.heat
    if convergence.load_error >= WORST_LOAD:
        return convergence.stage
    if heat is not None and heat.balance_error >= WORST_BALANCE and measures.temperature_range(attempt) >= TIGHT[1]:
        return "heat_balance"
    if convergence.departure is not None and not convergence.departure < WORST_DEPARTURE:
        return "verification"
    return None


def _dimensionless(inputs: LineContactInputs, scales: Groups) -> Dimensionless:
    contact = inputs.contact
    return Dimensionless(
        moes_m=scales.moes_m,
        moes_l=scales.moes_l,
        slide_roll_ratio=contact.slide_roll_ratio,
        peclet_1=peclet_number(inputs.surface_1, contact.speed_1, scales),
        peclet_2=peclet_number(inputs.surface_2, contact.speed_2, scales),
    )


def _convergence(inputs: LineContactInputs, attempt: Attempt, iterations: int) -> Convergence:
    history = attempt.state.history[0]
    changes = [
        float(change) if isfinite(change) else None for change in (history.pressure_change, history.temperature_change)
    ]
    return Convergence(
        iterations=iterations,
        pressure_change=changes[0],
        temperature_change=changes[1] if inputs.model.thermal else None,
        load_error=measures.load_error(attempt),
        nodes=attempt.grid.x.size,
        stage=attempt.stage,
        eyring_stress=attempt.eyring_stress,
        departure=None,
    )


def _film(inputs: LineContactInputs, constants: Problem, attempt: Attempt) -> FilmThickness:
    heights = measures.film_heights(constants, attempt)
    thinnest = int(heights.argmin())
    return FilmThickness(
        central=measures.at_place(attempt, heights),
        minimum=float(heights[thinnest]),
        minimum_at=float(attempt.grid.x[thinnest]) * constants.half_width,
        dowson_higginson=dowson_higginson_film(inputs),
    )


def warm_up() -> None:
    """Compile every kernel, or load it from the cache, by solving two small contacts.

    Examples
    --------
    >>> warm_up()
    """
    # Two contacts reach all kernels, because each kernel chooses the laws of the oil at run time.
    contact = Contact(line_load=1e5, radius=0.01, speed_1=2.0, speed_2=1.5)
    for model in (Model(nodes=61), Model(nodes=61, thermal=False)):
        solve(LineContactInputs(contact, model=model, lubricant=Lubricant()))
    Lubricant().density_at(0.0, 300.0)
