"""The check of finished states: right on exact heat sources, blind to nothing that once went wrong, and cheap."""

from dataclasses import replace
from time import process_time

import numpy as np
import pytest

from solvers.contact.ehl import LineContactInputs, LineContactResult, Model, Temperatures, refinement
from solvers.contact.ehl.model import solve
from solvers.contact.ehl.refinement import departure, strip_integral
from solvers.published.xue import POINT_A
from tests.support.line_contacts import random_contacts

INPUTS = LineContactInputs(POINT_A)


@pytest.fixture(scope="module")
def point_a() -> LineContactResult:
    return solve(INPUTS)


def departure_with(result: LineContactResult, place: tuple[int | slice, int | slice], warmer: float) -> float:
    """What the check says of the result with another temperature at a place of its field."""
    temperature = result.field.temperature.copy()
    temperature[place] += warmer
    return departure(INPUTS, result.curves, replace(result.field, temperature=temperature))


def test_uniform_flux_heats_with_the_root_of_the_distance() -> None:
    x = np.linspace(-1.0, 1.0, 50) ** 3
    assert strip_integral(x, np.full(50, 3.0)) == pytest.approx(6.0 * np.sqrt(x - x[0]), abs=1e-12)


def test_linear_flux_heats_with_the_three_halves_power() -> None:
    """int_0^x s (x - s)^-1/2 ds = 4/3 x^(3/2)."""
    x = np.linspace(0.0, 1.0, 30) ** 2
    assert strip_integral(x, x) == pytest.approx(4.0 / 3.0 * x**1.5, abs=1e-12)


@pytest.mark.parametrize("rheology", ["ree_eyring", "newtonian"])
def test_random_contacts_pass_with_room(rheology: str) -> None:
    for inputs in random_contacts(replace(Model(refine_mesh=False), rheology=rheology), 12, seed=7):
        result = solve(inputs)
        if result.status != "no_solution":
            assert result.convergence.departure < 1e-3


def test_different_temperatures_of_bulk_and_inlet_pass() -> None:
    result = solve(replace(INPUTS, temperatures=Temperatures(350.0, 370.0, 330.0)))
    assert result.convergence.departure < 1e-3


@pytest.mark.parametrize(
    ("place", "warmer"),
    [
        ((0, 0), 0.2),  # walls off the bulk: what the path once carried from mesh to mesh
        ((0, -1), 0.2),
        ((0, slice(5, 9)), -0.3),  # oil that does not enter at its temperature
    ],
)
def test_the_first_column_off_its_temperature_is_found(
    point_a: LineContactResult, place: tuple[int | slice, int | slice], warmer: float
) -> None:
    assert departure_with(point_a, place, warmer) == pytest.approx(abs(warmer), abs=1e-3)


def test_a_surface_warmer_than_its_heat_is_found(point_a: LineContactResult) -> None:
    wrong = replace(point_a.curves, surface_1_heat_flux=1.01 * point_a.curves.surface_1_heat_flux)
    assert departure(INPUTS, wrong, point_a.field) == pytest.approx(
        0.01 * point_a.temperature.surface_1_flash, rel=0.05
    )


def test_oil_colder_than_everything_around_it_is_found(point_a: LineContactResult) -> None:
    assert departure_with(point_a, (60, 10), 300.0 - point_a.field.temperature[60, 10]) > 30.0


def test_what_fails_is_no_solution(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(refinement, "departure", lambda *_: 0.11)
    result = solve(INPUTS)
    assert result.status == "no_solution"
    assert result.convergence.stage == "verification"
    assert (result.friction, result.curves, result.film.minimum) == (None, None, None)
    monkeypatch.setattr(refinement, "departure", lambda *_: float("nan"))
    assert solve(INPUTS).status == "no_solution"


def test_it_is_cheap(point_a: LineContactResult) -> None:
    """0.1 ms, below 2 % of a warm point; the bound leaves room for a busy machine."""
    departure(INPUTS, point_a.curves, point_a.field)
    start = process_time()
    for _ in range(50):
        departure(INPUTS, point_a.curves, point_a.field)
    assert (process_time() - start) / 50 < 0.6e-3
