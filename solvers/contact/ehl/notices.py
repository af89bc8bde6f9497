"""Warnings about a lubricated line contact, one for each exceeded range."""

from collections.abc import Iterator

from solvers.contact.ehl.inputs import LineContactInputs
from solvers.contact.ehl.results import (
    ContactFriction,
    ContactHeat,
    Convergence,
    Dimensionless,
    FilmThickness,
    LineContactResult,
    MeshError,
    Stage,
)
from solvers.contact.notices import high_pressure
from solvers.lubricants import oil_temperature, thick_oil
from solvers.notices import Notice

LOWEST_PECLET = 5.0  # usual limit above which conduction along the surface is neglected
NEWTONIAN_SLIDE_ROLL_RATIO = 0.3  # chosen; below 0.3 too little heat arises to limit the traction of a Newtonian oil
TRACTION_RATIO = 0.1  # coefficients of friction of oils seldom exceed 0.1
THIN_FILM = 0.05e-6  # m
BALANCE_ERROR = 1e-4  # relative error of the heat balance, chosen
LARGEST_MESH_ERROR = 0.02  # chosen: required relative accuracy of film, friction and temperature
FAILURES: dict[Stage, str] = {
    "isothermal": "the isothermal film did not converge",
    "coupling": "pressures and temperatures did not converge together",
    "heat_balance": "the solution does not satisfy the heat balance",
    "verification": "the solution contradicts the heat flow into the surfaces or the flow of oil into the contact",
}


def input_notices(inputs: LineContactInputs, groups: Dimensionless) -> list[Notice]:
    """Return the warnings that follow from the inputs."""
    notices = []
    model = inputs.model
    slowest = min(groups.peclet_1, groups.peclet_2)
    if model.thermal and slowest < LOWEST_PECLET:
        side = 1 if groups.peclet_1 <= groups.peclet_2 else 2
        notices.append(
            Notice(
                "low_peclet",
                f"the Peclet number of surface {side} is {slowest:.2g}, which is below {LOWEST_PECLET:g}. Heat then "
                "also spreads along the surface, and the computed flash temperature is too high: by 3 to 7 % at Peclet "
                "numbers from 1 to 4.5, and by 19 % at 0.35",
                f"speed_{side}",
            )
        )
    if model.rheology == "newtonian" and abs(groups.slide_roll_ratio) < NEWTONIAN_SLIDE_ROLL_RATIO:
        notices.append(
            Notice(
                "newtonian_low_slip",
                "for |slide-roll ratio| < 0.3 the traction of a Newtonian oil is not reliable, because there is too "
                "little heating to limit the traction; choose the rheology ree_eyring",
                "rheology",
            )
        )
    return notices


def result_notices(film: FilmThickness, friction: ContactFriction, heat: ContactHeat | None) -> list[Notice]:
    """Return the warnings that follow from the solution."""
    notices = []
    if film.minimum is not None and film.minimum < THIN_FILM:
        notices.append(
            Notice(
                "thin_film",
                f"the film is only {film.minimum * 1e6:.3f} µm thick; below 0.05 µm the roughness of the surfaces "
                "carries part of the load",
                "viscosity",
            )
        )
    if friction.traction_ratio > TRACTION_RATIO:
        notices.append(
            Notice(
                "high_traction",
                f"the shear stress reaches {friction.traction_ratio:.2g} times the pressure, but real oils reach only "
                "0.05 to 0.08 times the pressure",
                "rheology",
            )
        )
    if heat is not None and heat.balance_error > BALANCE_ERROR:
        notices.append(
            Notice(
                "heat_balance",
                f"the heat balance has a relative error of {heat.balance_error:.1e}; the limit is 1e-4",
                "nodes",
            )
        )
    return notices


def mesh_notices(error: MeshError | None) -> list[Notice]:
    """Return the warnings about the accuracy of the mesh."""
    if error is None:
        return [
            Notice(
                "mesh_error",
                "the error of the numerical grid could not be estimated; repeat the calculation with more nodes, and "
                "compare the results",
                "nodes",
            )
        ]
    if error.largest <= LARGEST_MESH_ERROR:
        return []
    worst = [
        f"{name.replace('_', ' ')} {value:.1%}" for name, value in error.estimates.items() if value > LARGEST_MESH_ERROR
    ]
    return [
        Notice(
            "mesh_error",
            f"the numerical grid is too coarse; these results have errors above 2 %: {', '.join(worst)}. Increase the "
            "number of nodes",
            "nodes",
        )
    ]


def failure_notice(convergence: Convergence) -> Notice:
    """Return the warning that says why there is no solution."""
    message = (
        f"with {convergence.nodes} nodes {FAILURES[convergence.stage]}; try another number of nodes, or the rheology "
        "ree_eyring"
    )
    return Notice("not_converged", message, "nodes", rank="invalid")


def unusual_values(inputs: LineContactInputs, result: LineContactResult) -> Iterator[Notice]:
    """Yield the warnings about unusual values of oil, inlet temperature and load."""
    yield from oil_temperature(inputs.temperatures.inlet, "temperatures.inlet")
    yield from thick_oil(result.derived.viscosity)
    yield from high_pressure(result.hertz.max_pressure, "line_load")
