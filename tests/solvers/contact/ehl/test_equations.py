"""The compiled kernels agree with the equations in plain NumPy: residual, derivatives by complex step, Newton step.

The integral of the pressure balances the load (Xue, Eq. 22).
"""

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from typing import NamedTuple, get_args

import numpy as np
import pytest

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.contact.ehl import (
    LineContactInputs,
    Model,
    Rheology,
    heat,
    newton,
    reynolds,
    state,
    temperature,
)
from solvers.contact.ehl.continuation import budget_for, solve_cold
from solvers.contact.ehl.grid import Grid
from solvers.contact.ehl.model import resolution_for
from solvers.contact.ehl.problem import Problem, groups, problem
from solvers.contact.ehl.state import State, Work, work_arrays
from solvers.lubricants import Lubricant
from tests.support import line_contact_equations as equations
from tests.support.line_contact_equations import Carried, Residual
from tests.support.line_contacts import at_pressure, random_contacts
from tests.support.properties import first

# Python calls compiled kernels here.
factor_columns = kernel(heat.factor_columns)
add_temperature_changes = kernel(newton.add_temperature_changes)
evaluate_isothermal = kernel(newton.evaluate_isothermal)
factor_jacobian = kernel(newton.factor_jacobian)
newton_step = kernel(newton.newton_step)
pressure_responses = kernel(newton.pressure_responses)
assemble_jacobian = kernel(reynolds.assemble_jacobian)
balance_of_mass = kernel(reynolds.balance_of_mass)
mass_flux_slopes = kernel(reynolds.mass_flux_slopes)
evaluate_state = kernel(state.evaluate_state)
linearise_state = kernel(state.linearise_state)
inlet_step = kernel(temperature.inlet_step)

THERMAL = {name: Model(rheology=name, nodes=61, film_nodes=11) for name in get_args(Rheology)}
ISOTHERMAL = {name: replace(model, thermal=False) for name, model in THERMAL.items()}
FEW, MANY = 10, 20  # states of contacts
STEP = 1e-30  # of the complex step: far below rounding, far above the smallest number
SIMPLE_OIL = Lubricant(viscosity=0.03, pressure_viscosity_law="barus", pressure_viscosity=1e-8, compressible=False)

rheologies = pytest.mark.parametrize(
    ("rheology", "count"),
    first(len(THERMAL), [*((name, FEW) for name in THERMAL), *((name, MANY) for name in THERMAL)]),
)


class At(NamedTuple):
    """A state of a contact. The methods evaluate the equations at this state; `work` holds the kernels' results."""

    problem: Problem
    grid: Grid
    state: State
    work: Work

    @property
    def unknowns(self) -> FloatArray:
        return np.concatenate([self.state.pressure, self.state.separation, self.state.temperature.ravel()])

    def residual(self, unknowns: np.ndarray, carried: Carried | None = None) -> Residual:
        n = self.grid.x.size
        t = unknowns[n + 1 :].reshape(self.state.temperature.shape)
        return equations.residual(self.problem, self.grid, self.state.cavitated, unknowns[:n], unknowns[n], t, carried)

    def slope(self, direction: FloatArray) -> Residual:
        """Return the residual's derivative in a direction. The flow quantities in the heat balance are held fixed."""
        residual = self.residual(self.unknowns + 1j * STEP * direction, self.carried)
        return Residual(*(np.asarray(part).imag / STEP for part in residual))

    @property
    def free(self) -> np.ndarray:
        """Return the indices of all unknowns (P, H0) except the pressures that are pinned to zero."""
        # The pressures at both ends and in the broken film stay at P = 0, where the viscosity has a kink.
        pinned = self.state.cavitated.copy()
        pinned[[0, -1]] = True
        return np.append(np.flatnonzero(~pinned), pinned.size)

    @property
    def dragged(self) -> float:
        """Return the largest flux that the surfaces drag, in flux scales. The pressure holds back most of this flux."""
        drag = self.work.coefficients.b.value * self.work.height
        return float(drag.max()) * self.problem.gap_scale / self.problem.flux_scale

    def set_jacobian(self, jacobian: FloatArray) -> None:
        """Write the Jacobian of mass and load with respect to (P, H0) to `jacobian`."""
        height, gradient, cavitated = self.work.height, self.work.gradient, self.state.cavitated
        mass_flux_slopes(self.problem, self.grid, height, gradient, cavitated, self.work.coefficients, self.work.faces)
        assemble_jacobian(self.grid, cavitated, self.work.faces, jacobian)

    @property
    def carried(self) -> Carried:
        film = self.work.film
        return Carried(film.flow.stream, self.work.heat.fluid_fraction, film.shear.density)


def contacts(model: Model, count: int) -> list[LineContactInputs]:
    """Return random contacts, lightly loaded contacts, contacts with a simpler oil, and a contact in pure rolling."""
    light = [at_pressure(p, ratio, 5.0, 0.05, 10e-3, model) for p, ratio in ((2e7, 0.3), (5e7, -0.8), (1e8, 1.2))]
    simple = [replace(inputs, lubricant=SIMPLE_OIL) for inputs in random_contacts(model, 3, seed=5)]
    rolling = [at_pressure(0.8e9, 0.0, 3.0, 0.02, 8e-3, model)]
    return [*random_contacts(model, count - 7, seed=4), *light, *simple, *rolling]


@cache
def states(model: Model, count: int) -> list[At]:
    """Return states near solutions. They differ from the solutions in pressures, separation and temperatures."""
    return list(_states(model, count))


def _states(model: Model, count: int) -> Iterator[At]:
    draw = np.random.default_rng(0)
    for inputs in contacts(model, count):
        constants = problem(inputs, groups(inputs))
        resolution = resolution_for(inputs)
        attempt = solve_cold(constants, resolution, budget_for(resolution))
        state, n = attempt.state, attempt.grid.x.size
        state.pressure[:] *= 1.0 + 0.02 * draw.standard_normal(n)
        state.separation[:] += 0.02 * attempt.work.height.min()
        state.temperature[1:] += 2.0 * draw.standard_normal((n - 1, model.film_nodes))
        work = work_arrays(n, model.film_nodes)
        if model.thermal:
            assert not evaluate_state(constants, attempt.grid, state, work)  # no guard acts
            linearise_state(constants, state, work, 0.0)
        else:
            evaluate_isothermal(constants, attempt.grid, state, work)
        yield At(constants, attempt.grid, state, work)


def of_kernels(at: At) -> Residual:
    n, k = at.state.temperature.shape
    mass, step = np.empty(n + 1), np.zeros((n, k))
    balance_of_mass(at.grid, at.state.pressure, at.state.cavitated, at.work.faces, mass)
    heat = at.work.heat.column.residual.copy()
    inlet_step(at.problem, at.work, at.state.temperature, step)
    heat[0] = -step[0]
    return Residual(mass[:n], mass[n], heat)


def heat_slope_of_kernels(at: At, direction: FloatArray) -> FloatArray:
    """Return the derivative of the heat residual in a direction, as the kernels linearise the columns."""
    # The columns are not factored yet. The row of a wall yields the heat flux into the wall, and this flux warms the
    # surface downstream.
    n, k = at.state.temperature.shape
    column, surfaces, m = at.work.heat.column, at.work.heat.surfaces, k - 1
    step, dt = direction[: n + 1], direction[n + 1 :].reshape(n, k)
    by_pressure, slope = np.zeros((n, k)), np.zeros((n, k))
    pressure_responses(at.problem, at.grid, at.work, at.state.cavitated, step, by_pressure)
    flux = np.zeros((2, n))
    for i in range(1, n):
        slope[i] = column.pivot[i] * dt[i] - by_pressure[i]
        slope[i, 1:] -= column.lower[i, 1:] * dt[i, :-1]
        slope[i, :-1] -= column.upper[i, :-1] * dt[i, 1:]
        slope[i] += column.responses.heating[i] * (at.work.film.mid.by_temperature[i] @ dt[i])
        slope[i] -= at.work.heat.convection.from_left[i] * dt[i - 1]
        slope[i] -= at.work.heat.convection.from_right[i] * dt[min(i + 1, n - 1)]
        for side, place, heating, gain in (
            (0, 0, at.problem.surface_heating_1, surfaces.walls[i].gain_1),
            (1, m, at.problem.surface_heating_2, surfaces.walls[i].gain_2),
        ):
            flux[side, i] = -(slope[i, place] - dt[i, place]) / gain
            slope[i, place] -= heating * (at.grid.heat[i, :i] @ flux[side, :i])
    return slope


def directions(at: At, *, of_pressure: bool, seed: int) -> FloatArray:
    """Return a random change of all pressures and of H0, or of all temperatures downstream of the inlet."""
    draw = np.random.default_rng(seed)
    n, k = at.state.temperature.shape
    change = np.zeros(n + 1 + n * k)
    if of_pressure:
        change[at.free] = 1e-2 * draw.standard_normal(at.free.size)
    else:
        change[n + 1 + k :] = draw.standard_normal((n - 1) * k)
    return change


def assert_near(found: FloatArray, expected: FloatArray, tolerance: float) -> None:
    """Assert that the arrays differ by at most `tolerance` times the largest expected value."""
    assert np.abs(found - expected).max() <= tolerance * np.abs(expected).max()


@rheologies
def test_residual_of_a_thermal_contact(rheology: str, count: int) -> None:
    """The residuals agree to 1e-12."""
    # This tolerance is relative to the largest flux that the surfaces drag, to the largest heat in the film, and to the
    # largest temperature. For the dimensionless load the tolerance is absolute.
    assert len(states(THERMAL[rheology], count)) == count
    for at in states(THERMAL[rheology], count):
        found, expected = of_kernels(at), at.residual(at.unknowns)
        assert np.abs(found.mass - expected.mass).max() < 1e-12 * at.dragged
        assert abs(found.load - expected.load) < 1e-12
        assert_near(found.heat[1:, 1:-1], expected.heat[1:, 1:-1], 1e-12)
        assert np.abs(found.heat[1:, [0, -1]] - expected.heat[1:, [0, -1]]).max() < 1e-12 * at.state.temperature.max()
        assert np.abs(found.heat[0] - expected.heat[0]).max() < 1e-12 * at.state.temperature.max()


@rheologies
def test_residual_of_an_isothermal_contact(rheology: str, count: int) -> None:
    assert len(states(ISOTHERMAL[rheology], count)) == count
    for at in states(ISOTHERMAL[rheology], count):
        mass, load = equations.isothermal_residual(
            at.problem, at.grid, at.state.cavitated, at.state.pressure, at.state.separation[0]
        )
        found = of_kernels(at)
        assert np.abs(found.mass - mass).max() < 1e-12 * at.dragged
        assert abs(found.load - load) < 1e-12


@rheologies
def test_jacobian_of_an_isothermal_contact(rheology: str, count: int) -> None:
    for at in states(ISOTHERMAL[rheology], count):
        n = at.grid.x.size
        found, expected = np.empty((2, n + 1, n + 1))
        at.set_jacobian(found)
        for j in at.free:
            changed = np.append(at.state.pressure, at.state.separation).astype(complex)
            changed[j] += 1j * STEP
            mass, load = equations.isothermal_residual(at.problem, at.grid, at.state.cavitated, changed[:n], changed[n])
            expected[:, j] = np.append(mass, load).imag / STEP
        assert_near(found[:, at.free], expected[:, at.free], 1e-10)


@rheologies
def test_jacobian_of_mass_at_given_temperatures(rheology: str, count: int) -> None:
    for at in states(THERMAL[rheology], count):
        n = at.grid.x.size
        found, expected = np.empty((2, n + 1, n + 1))
        at.set_jacobian(found)
        for j in at.free:
            direction = np.zeros(at.unknowns.size)
            direction[j] = 1.0
            slope = at.slope(direction)
            expected[:, j] = np.append(slope.mass, slope.load)
        assert_near(found[:, at.free], expected[:, at.free], 1e-10)


@rheologies
def test_derivative_of_mass_by_temperatures(rheology: str, count: int) -> None:
    for seed, at in enumerate(states(THERMAL[rheology], count)):
        n, k = at.state.temperature.shape
        direction = directions(at, of_pressure=False, seed=seed)
        found = np.zeros(n + 1)
        changes = direction[n + 1 :].reshape(n, k)
        add_temperature_changes(at.work, at.state.cavitated, changes, np.zeros((n, k)), found)
        assert_near(found[:n], at.slope(direction).mass, 1e-10)


@rheologies
@pytest.mark.parametrize("of_pressure", [True, False])
def test_derivative_of_heat(rheology: str, count: int, *, of_pressure: bool) -> None:
    """The heat residual is differentiated by all pressures and H0, or by all temperatures."""
    # The rows of the surfaces are compared separately, because their residuals are temperatures.
    for seed, at in enumerate(states(THERMAL[rheology], count)):
        direction = directions(at, of_pressure=of_pressure, seed=seed)
        found, expected = heat_slope_of_kernels(at, direction), at.slope(direction).heat
        assert_near(found[1:, 1:-1], expected[1:, 1:-1], 1e-10)
        assert_near(found[1:, [0, -1]], expected[1:, [0, -1]], 1e-10)


@pytest.mark.parametrize("rheology", THERMAL)
def test_newtons_step_solves_the_linearised_equations(rheology: str) -> None:
    """The step by elimination of the columns, march and GMRES agrees with a dense solution to within 2 %."""
    # GMRES stops if the remaining error is below 1 %.
    at = states(THERMAL[rheology], FEW)[0]
    n, k = at.state.temperature.shape
    size = n + 1 + n * k
    dense = np.empty((size, size))
    for j in range(size):
        slope = at.slope(np.eye(1, size, j)[0])
        dense[:, j] = np.concatenate([slope.mass, [slope.load], slope.heat.ravel()])
    left = at.residual(at.unknowns)
    expected = -np.linalg.solve(dense, np.concatenate([left.mass, [left.load], left.heat.ravel()]))
    at = at._replace(work=work_arrays(n, k))
    evaluate_state(at.problem, at.grid, at.state, at.work)
    linearise_state(at.problem, at.state, at.work, 0.0)
    jacobian, residual, pivots = np.empty((n + 1, n + 1)), np.empty(n + 1), np.empty(n + 1, np.int64)
    factor_columns(1, n, at.work.film, at.work.heat)
    factor_jacobian(at.problem, at.grid, at.state, at.work, jacobian, pivots)
    balance_of_mass(at.grid, at.state.pressure, at.state.cavitated, at.work.faces, residual)
    step, step_t = np.zeros(n + 1), np.zeros((n, k))
    newton_step(at.problem, at.grid, at.work, at.state.cavitated, jacobian, pivots, residual, step, step_t)
    inlet_step(at.problem, at.work, at.state.temperature, step_t)
    assert_near(step, expected[: n + 1], 0.02)
    assert_near(step_t.ravel(), expected[n + 1 :], 0.02)
