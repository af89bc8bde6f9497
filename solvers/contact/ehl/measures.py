"""Results of a converged state: film, friction, temperatures, curves."""

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.contact.ehl.continuation import Attempt
from solvers.contact.ehl.inputs import LineContactInputs
from solvers.contact.ehl.problem import Problem
from solvers.contact.ehl.results import (
    ContactCurves,
    ContactField,
    ContactFriction,
    ContactHeat,
    ContactPressure,
    ContactTemperature,
)

PEAK_ZONE = 0.1  # half widths downstream of the centre; a maximum upstream of this place is the Hertzian maximum


def load_error(attempt: Attempt) -> float:
    """Return the relative difference between the load and the integral of the pressure."""
    return abs(float(attempt.grid.weights @ attempt.state.pressure) / (0.5 * np.pi) - 1.0)


def film_heights(problem: Problem, attempt: Attempt) -> FloatArray:
    """Return the film thickness at the nodes (n,) [m]."""
    return attempt.work.height * problem.gap_scale


def temperature_range(attempt: Attempt) -> float:
    """Highest minus lowest temperature [K]; within the tolerance of temperatures the heat balance cannot be checked."""
    return float(np.ptp(attempt.state.temperature))


def at_place(attempt: Attempt, values: FloatArray, place: float = 0.0) -> float:
    """Interpolate `values` linearly at a place [half widths]. The default place is the centre."""
    return float(np.interp(place, attempt.grid.x, values))


def pressure(problem: Problem, attempt: Attempt) -> ContactPressure:
    """Return the pressure in the centre, the largest pressure, and the second maximum, downstream of the centre."""
    x, p = attempt.grid.x, attempt.state.pressure
    peak = int(p.argmax())
    inner = np.flatnonzero((p[1:-1] > p[:-2]) & (p[1:-1] >= p[2:])) + 1
    others = inner[(x[inner] > PEAK_ZONE) & (p[inner] > 0.0)]
    second = int(others[p[others].argmax()]) if others.size else None
    return ContactPressure(
        centre=at_place(attempt, p) * problem.maximum_pressure,
        maximum=float(p[peak]) * problem.maximum_pressure,
        maximum_at=float(x[peak]) * problem.half_width,
        second_maximum=None if second is None else float(p[second]) * problem.maximum_pressure,
        second_maximum_at=None if second is None else float(x[second]) * problem.half_width,
    )


def temperature(problem: Problem, attempt: Attempt) -> ContactTemperature:
    """Return the maxima of the temperature in the film and on the surfaces."""
    t, x = attempt.state.temperature, attempt.grid.x * problem.half_width
    film, mid = t.max(axis=1), mid_film(t)
    first, second = t[:, 0], t[:, -1]
    return ContactTemperature(
        film_max=float(film.max()),
        film_max_at=float(x[film.argmax()]),
        mid_film_max=float(mid.max()),
        mid_film_max_at=float(x[mid.argmax()]),
        surface_1_max=float(first.max()),
        surface_1_max_at=float(x[first.argmax()]),
        surface_2_max=float(second.max()),
        surface_2_max_at=float(x[second.argmax()]),
        surface_1_flash=float(first.max()) - problem.bulk_1,
        surface_2_flash=float(second.max()) - problem.bulk_2,
    )


def mid_film(t: FloatArray) -> FloatArray:
    """Temperatures (n,) half way between the surfaces, from those of the nodes (n, k)."""
    middle = (t.shape[1] - 1) // 2
    return np.asarray(0.5 * (t[:, middle] + t[:, t.shape[1] // 2]))


def friction(problem: Problem, attempt: Attempt, inputs: LineContactInputs) -> ContactFriction:
    """Friction by the mid-film stress and by that of both surfaces, which differs by half of h dp/dx (Eq. E9)."""
    work, contact = attempt.work, inputs.contact
    p = attempt.state.pressure * problem.maximum_pressure
    gradient = work.height * problem.gap_scale * work.gradient * problem.maximum_pressure / problem.half_width
    stress = work.film.mid.stress
    share = _share(problem, attempt, inputs)
    middle, first, second = (abs(float(share @ s)) for s in (stress, stress - 0.5 * gradient, stress + 0.5 * gradient))
    loaded = p > 0.1 * min(problem.maximum_pressure, float(p.max()))
    return ContactFriction(
        coefficient=middle,
        coefficient_1=first,
        coefficient_2=second,
        power=middle * contact.line_load * abs(contact.speed_1 - contact.speed_2),
        max_shear_stress=float((np.abs(stress) + 0.5 * np.abs(gradient)).max()),
        max_pressure_stress=float(np.abs(gradient).max()),
        traction_ratio=float((np.abs(stress[loaded]) / p[loaded]).max()),
    )


def friction_by_node(problem: Problem, attempt: Attempt, inputs: LineContactInputs) -> FloatArray:
    """Return the contribution of each node to the coefficient of friction (n,), with the sign of the shear stress."""
    return np.asarray(_share(problem, attempt, inputs) * attempt.work.film.mid.stress)


def _share(problem: Problem, attempt: Attempt, inputs: LineContactInputs) -> FloatArray:
    """Factor [1/Pa] of each node (n,) by which its stress contributes to the coefficient of friction."""
    width = attempt.grid.weights * problem.half_width
    return width * attempt.work.heat.fluid_fraction / inputs.contact.line_load


def heat_by_node(problem: Problem, attempt: Attempt) -> FloatArray:
    """Return the heat of shear in each column (n,) [W/m]; 0 in the first column, whose temperatures are given."""
    heat = attempt.grid.weights * attempt.work.heat.generated * problem.half_width
    heat[0] = 0.0
    return np.asarray(heat)


def heat(problem: Problem, attempt: Attempt) -> ContactHeat:
    """Compute the heat balance of all columns except the first, whose temperatures are given (Eq. E10)."""
    heats, t = attempt.work.heat, attempt.state.temperature
    width = attempt.grid.weights[1:] * problem.half_width
    generated = float(heat_by_node(problem, attempt).sum())
    compression = float(width @ heats.compression[1:])
    to_surfaces = [float(width @ flux[1:]) for flux in (heats.surfaces.flux_1, heats.surfaces.flux_2)]
    inlet = np.diff(_layer_edges(0.5 * (attempt.work.film.flow.stream[0] + attempt.work.film.flow.stream[1])))
    outlet = np.diff(_layer_edges(attempt.work.film.flow.stream[-1]))
    entering = np.where(inlet > 0.0, t[0], t[1])
    convected = problem.specific_heat * float(outlet @ t[-1] - inlet @ entering)
    defect = generated + compression - sum(to_surfaces) - convected
    turnover = max(generated + abs(convected), *map(abs, to_surfaces))
    return ContactHeat(
        generated=generated,
        compression=compression,
        to_surface_1=to_surfaces[0],
        to_surface_2=to_surfaces[1],
        convected=convected,
        balance_error=abs(defect) / turnover if turnover > 0.0 else 0.0,
    )


def _layer_edges(stream: FloatArray) -> FloatArray:
    """Stream function (k + 1,) at the layer edges: half way between nodes, and on the surfaces."""
    return np.concatenate([stream[:1], 0.5 * (stream[1:] + stream[:-1]), stream[-1:]])


def curves(problem: Problem, attempt: Attempt, thermal: bool) -> ContactCurves:
    """Return pressure, film, shear stress, temperatures and heat fluxes along the contact."""
    x, t = attempt.grid.x, attempt.state.temperature
    return ContactCurves(
        x=frozen(x * problem.half_width),
        pressure=frozen(attempt.state.pressure * problem.maximum_pressure),
        hertz_pressure=frozen(np.sqrt(np.maximum(1.0 - x**2, 0.0)) * problem.maximum_pressure),
        film=frozen(film_heights(problem, attempt)),
        shear_stress=frozen(attempt.work.film.mid.stress * attempt.work.heat.fluid_fraction),
        fluid_fraction=frozen(attempt.work.heat.fluid_fraction),
        mid_film_temperature=frozen(mid_film(t)) if thermal else None,
        surface_1_temperature=frozen(t[:, 0].copy()) if thermal else None,
        surface_2_temperature=frozen(t[:, -1].copy()) if thermal else None,
        surface_1_heat_flux=frozen(attempt.work.heat.surfaces.flux_1) if thermal else None,
        surface_2_heat_flux=frozen(attempt.work.heat.surfaces.flux_2) if thermal else None,
    )


def field(problem: Problem, attempt: Attempt) -> ContactField:
    """Return the temperatures across the film."""
    t = attempt.state.temperature
    return ContactField(
        x=frozen(attempt.grid.x * problem.half_width),
        film_fraction=frozen(np.linspace(0.0, 1.0, t.shape[1])),
        temperature=frozen(t),
    )
