"""The check of finished states: right on exact heat sources, blind to nothing that once went wrong, and cheap."""

from dataclasses import replace
from time import process_time

import numpy as np
import pytest

from solvers.contact.ehl import LineContactInputs, LineContactResult, Model, Temperatures, refinement
from solvers.contact.ehl.model import solve
from solvers.contact.ehl.refinement import departure, strip_integral
from solvers.contact.ehl.results import ContactCurves, ContactField
from tests.support.line_contacts import POINT, random_contacts

INPUTS = LineContactInputs(POINT)


@pytest.fixture(scope="module")
def point_a() -> LineContactResult:
    return solve(INPUTS)


def parts(result: LineContactResult) -> tuple[ContactCurves, ContactField]:
    assert result.curves is not None
    assert result.field is not None
    return result.curves, result.field


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
            assert result.convergence.departure is not None
            assert result.convergence.departure < 1e-3


def test_different_temperatures_of_bulk_and_inlet_pass() -> None:
    result = solve(replace(INPUTS, temperatures=Temperatures(350.0, 370.0, 330.0)))
    assert result.convergence.departure is not None
    assert result.convergence.departure < 1e-3


def test_walls_off_the_bulk_are_found(point_a: LineContactResult) -> None:
    """What the path once carried from mesh to mesh."""
    curves, field = parts(point_a)
    for node in (0, -1):
        t = field.temperature.copy()
        t[0, node] += 0.2
        assert departure(INPUTS, curves, replace(field, temperature=t)) == pytest.approx(0.2, abs=1e-3)


def test_oil_that_does_not_enter_at_its_temperature_is_found(point_a: LineContactResult) -> None:
    curves, field = parts(point_a)
    t = field.temperature.copy()
    t[0, 5:9] -= 0.3
    assert departure(INPUTS, curves, replace(field, temperature=t)) == pytest.approx(0.3, abs=1e-3)


def test_a_surface_warmer_than_its_heat_is_found(point_a: LineContactResult) -> None:
    curves, field = parts(point_a)
    assert curves.surface_1_heat_flux is not None
    wrong = replace(curves, surface_1_heat_flux=1.01 * curves.surface_1_heat_flux)
    assert point_a.temperature is not None
    assert departure(INPUTS, wrong, field) == pytest.approx(0.01 * point_a.temperature.surface_1_flash, rel=0.05)


def test_oil_colder_than_everything_around_it_is_found(point_a: LineContactResult) -> None:
    curves, field = parts(point_a)
    t = field.temperature.copy()
    t[60, 10] = 300.0
    assert departure(INPUTS, curves, replace(field, temperature=t)) > 30.0


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
    curves, field = parts(point_a)
    departure(INPUTS, curves, field)
    start = process_time()
    for _ in range(50):
        departure(INPUTS, curves, field)
    assert (process_time() - start) / 50 < 0.6e-3
