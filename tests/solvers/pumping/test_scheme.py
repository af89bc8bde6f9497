"""The scheme of the gas dynamics has its order of convergence, exact fluxes, and stages that balance."""

import itertools
from collections.abc import Callable
from math import log2, pi, sqrt
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import assume
from hypothesis import strategies as st

from solvers.arrays import FloatArray
from solvers.pumping import Ambient
from solvers.pumping.flow.duct import Duct, wall_table
from solvers.pumping.flow.nozzle import Gas, flux_squared, gas, mass_flux
from solvers.pumping.flow.space_flow import Record, empty_record
from solvers.pumping.gas.gas_dynamics import march
from solvers.pumping.gas.leakage import Stage, Walls, implicit_stage
from solvers.pumping.gas.riemann import State, flux, hllc, ram_pressure, reservoir_face
from solvers.pumping.gas.step import empty_cells
from tests.support.properties import examples

AIR = gas(Ambient())


def smooth_march(cells: int, *, gap: float = 0.0, order: int = 2) -> tuple[Record, int]:
    """Return the record and the number of steps of the flow in a duct that is open at both ends.

    Over time, the section of the duct shrinks by half and grows again. This change begins and ends smoothly.
    """
    place = np.linspace(0, 1, 20001)
    area = 2e-4 * (1 - 0.5 * np.sin(pi * place) ** 4)
    table = wall_table(area, np.full_like(place, gap), np.zeros_like(place))
    duct = Duct(0.0, 0.1 / cells, cells, 0.0, 400.0, 0.0, 1 / 20000, table, 1.0)
    record = empty_record(AIR, 3, cells, 20000)
    steps = march(AIR, duct, empty_cells(cells), np.linspace(0, 1, 3), record, order)
    return record, steps


def orders(values: list[FloatArray]) -> list[float]:
    """Return the observed orders of convergence on grids whose cells are halved from grid to grid."""
    # The errors are mean differences between neighbouring grids.
    errors = [np.abs(a - b.reshape(-1, 2).mean(axis=1)).mean() for a, b in itertools.pairwise(values)]
    return [log2(a / b) for a, b in itertools.pairwise(errors)]


@pytest.mark.parametrize(("gap", "least"), [(0.0, 1.85), (2e-3, 1.7)])
def test_gas_dynamics_is_of_second_order_where_the_flow_is_smooth(gap: float, least: float) -> None:
    # with gaps the square root of the nozzle law at p = p_e costs a little
    records = [smooth_march(cells, gap=gap)[0] for cells in (25, 50, 100, 200, 400)]
    assert min(orders([record.field.pressure[1] for record in records])) > least
    assert min(orders([record.profile.stagnation / record.profile.active for record in records])) > least - 0.15


def test_first_order_scheme_is_of_first_order() -> None:
    records = [smooth_march(cells, order=1)[0] for cells in (50, 100, 200, 400)]
    assert orders([record.field.pressure[1] for record in records]) == pytest.approx([1, 1], abs=0.15)


def test_both_orders_have_one_limit() -> None:
    first, finer, second = smooth_march(200, order=1)[0], smooth_march(400, order=1)[0], smooth_march(200)[0]
    extrapolated = 2 * finer.profile.highest.max() - first.profile.highest.max()
    assert extrapolated == pytest.approx(second.profile.highest.max(), rel=5e-4)
    assert 2 * finer.energy[0].work - first.energy[0].work == pytest.approx(second.energy[0].work, rel=2e-3)


def test_gas_at_rest_stays_at_rest() -> None:
    # a section that varies along the face but not in time moves nothing, with gaps or without: well balanced
    place = np.linspace(0, 1, 201)
    table = wall_table(2e-4 * (1 - 0.8 * np.sin(3 * place) ** 2), np.full_like(place, 1e-3), 0 * place)
    still = 1e-9  # rad/s: the table hardly turns while sound crosses the duct many times
    duct = Duct(0.0, 0.01, 20, 4.0, still, 0.0, 1 / 200, table, 1.0)
    record = empty_record(AIR, 2, 20, 4000)
    assert march(AIR, duct, empty_cells(20), np.array([0.85, 0.85 + 10e-3 * still]), record, 2) > 50
    assert record.extremes[0].mach < 1e-10
    assert record.profile.highest.max() == pytest.approx(AIR.pressure, rel=1e-10)


def test_flux_between_equal_states_is_the_exact_flux() -> None:
    rho, u, p = state = State(1.3, 120.0, 2e5)
    energy = p / 0.4 + 0.5 * rho * u * u
    assert (
        hllc(1.4, state, state)
        == flux(1.4, 1.0, state, ram_pressure(state))
        == pytest.approx((rho * u, rho * u * u + p, u * (energy + p)), rel=1e-14)
    )


def test_hllc_keeps_a_contact_at_rest() -> None:
    assert hllc(1.4, State(1.0, 0.0, 1e5), State(3.0, 0.0, 1e5)) == pytest.approx((0.0, 1e5, 0.0), abs=1e-9)


@examples(100, 1000, st.floats(0.2, 6), st.floats(-1.5, 1.5), st.floats(0.2, 10))
def test_reservoir_face(density: float, mach: float, pressure: float) -> None:
    rho, p = density * AIR.density, pressure * AIR.pressure
    c = np.sqrt(1.4 * p / rho)
    assume(mach + 2 / 0.4 > 0)
    (rho_f, v_f, p_f), demand = reservoir_face(AIR, State(rho, mach * c, p))
    c_f = np.sqrt(1.4 * p_f / rho_f)
    assert abs(v_f) <= c_f * (1 + 1e-12) or mach > 1
    if -0.95 * c_f < v_f < 0:  # inflow keeps the stagnation state of the surroundings and the outgoing invariant
        assert c_f**2 + 0.2 * v_f**2 == pytest.approx(AIR.sound_speed**2, rel=1e-9)
        expanded = c * (p_f / p) ** (1 / 7)  # the cell's own gas at the pressure of the face
        assert v_f + 5 * expanded == pytest.approx(mach * c + 5 * c, rel=1e-9)
    elif 0 < demand < 1:  # unchoked outflow has the ambient pressure
        assert p_f == pytest.approx(AIR.pressure, rel=1e-9)
        assert v_f / c_f == pytest.approx(demand, rel=1e-9)
    elif demand > 1 and mach < 1:
        assert v_f == pytest.approx(c_f, rel=1e-12)


@pytest.mark.parametrize("drop", [1e-3, 1e-6, 1e-9, 1e-12])
def test_nozzle_law_down_to_any_pressure_drop(drop: float) -> None:
    density = 1e5 / (AIR.constant * 300.0)
    expected = 2 * density * 1e5 * drop
    assert flux_squared(AIR, 1e5, density, drop)[0] == pytest.approx(expected, rel=2 * drop + 1e-12)


@pytest.mark.parametrize("exponent", [1.05, 1.4, 1.66])
@pytest.mark.parametrize("drop", [1e-9, 1e-5, 5e-3, 0.00999999, 0.01000001, 0.02, 0.1, 0.4])
def test_nozzle_law_is_exact_on_both_sides_of_its_series(exponent: float, drop: float) -> None:
    some = gas(Ambient(isentropic_exponent=exponent))
    fallen = np.expm1(np.log1p(-np.longdouble(drop)) / np.longdouble(exponent))
    exact = 2 * exponent / (exponent - 1) * 1e5 * 1.2 * (1 + fallen) * (fallen + np.longdouble(drop))
    assert flux_squared(some, 1e5, 1.2, drop)[0] == pytest.approx(float(exact), rel=3e-13)


@examples(100, 1000, st.floats(1.0, 8.0), st.floats(0.1, 5.0))
def test_nozzle_derivatives(ratio: float, density: float) -> None:
    up, down = ratio * 1e5, 1e5
    assume(abs(ratio - 1 / AIR.critical_ratio) > 1e-3)
    assume(ratio > 1 + 1e-4)
    for law in (mass_flux, squared_by_pressures):
        _, by_up, by_down = law(AIR, up, density, down)
        step = 1e-6 * (up - down)
        assert by_up == pytest.approx(difference(law, up, density, down, step, 0.0), rel=1e-4)
        assert by_down == pytest.approx(difference(law, up, density, down, 0.0, step), rel=1e-4, abs=1e-12)


Law = Callable[[Gas, float, float, float], tuple[float, float, float]]


def squared_by_pressures(gas: Gas, up: float, density: float, down: float) -> tuple[float, float, float]:
    return flux_squared(gas, up, density, (up - down) / up)


def difference(law: Law, up: float, density: float, down: float, d_up: float, d_down: float) -> float:
    ahead, back = law(AIR, up + d_up, density, down + d_down)[0], law(AIR, up - d_up, density, down - d_down)[0]
    return (ahead - back) / (2 * (d_up + d_down))


class Cell(NamedTuple):
    """The gas in a slice and the walls of the slice before a stage that takes the time h [s]."""

    walls: Walls
    mass: float
    momentum: float
    energy: float
    h: float

    def after(self, guess: float = 0.0) -> Stage:
        return implicit_stage(AIR, self.walls, self.mass, self.momentum, self.energy, self.h, guess)


def cells(gap: st.SearchStrategy[float], transport: st.SearchStrategy[float]) -> st.SearchStrategy[Cell]:
    """Return a strategy for cells with an area of 1 cm2 that changes by up to 80 % within a stage."""

    def cell(pressure: float, velocity: float, gap: float, transport: float, log_time: float, growth: float) -> Cell:
        area, h = 1e-4, 10.0**log_time
        walls = Walls(area, growth * 0.02 * area / h, gap, transport * 0.1 * area / h)
        mass = AIR.density * area * pressure**0.7
        energy = pressure * AIR.pressure * area / 0.4 + 0.5 * mass * velocity**2
        return Cell(walls, mass, mass * velocity, energy, h)

    return st.builds(
        cell, st.floats(0.1, 10), st.floats(-300, 300), gap, transport, st.floats(-7, -3), st.floats(-40, 40)
    )


@examples(100, 1000, cells(st.floats(0, 5e-3), st.floats(-0.3, 0.3)))
def test_implicit_stage_meets_the_nozzle_law_and_closes_its_books(cell: Cell) -> None:
    walls, area, gap = cell.walls, cell.walls.area, cell.walls.gap
    stage = cell.after()
    assume(stage.fits)
    assert stage.mass == pytest.approx(cell.mass - cell.h * stage.leak, rel=1e-9)
    assert stage.energy == pytest.approx(cell.energy - cell.h * stage.energy_rate, rel=1e-12)
    inner = stage.energy - 0.5 * stage.momentum**2 / stage.mass
    assert stage.pressure == pytest.approx(0.4 * inner / area, rel=1e-9)
    # the stage takes the square root of the law itself; `mass_flux` is linear in the last 1e-7 of the pressure
    if stage.pressure > AIR.pressure:
        drop = (stage.pressure - AIR.pressure) / stage.pressure
        nozzle = gap * sqrt(flux_squared(AIR, stage.pressure, stage.mass / area, drop)[0])
    else:
        drop = (AIR.pressure - stage.pressure) / AIR.pressure
        nozzle = -gap * sqrt(flux_squared(AIR, AIR.pressure, AIR.density, drop)[0])
    density = stage.mass / area if walls.transport > 0 else AIR.density
    expected = nozzle + walls.transport * density
    scale = abs(nozzle) + gap * 1e-4 * AIR.density * AIR.sound_speed + cell.mass / cell.h * 1e-9
    assert stage.leak == pytest.approx(expected, abs=1e-5 * scale)


@examples(100, 1000, cells(st.floats(1e-6, 5e-3), st.floats(-5e-3, 5e-3)), st.floats(-6, 0), st.sampled_from((-1, 1)))
def test_implicit_stage_is_exact_from_any_guess_however_near(cell: Cell, log_off: float, side: int) -> None:
    # one more of Newton's steps, which squares what is left, tells how much the first answer left
    found = cell.after()
    assume(found.fits)
    exact = cell.after(cell.after(found.through_gaps).through_gaps)
    near = cell.after(exact.through_gaps * (1.0 + side * 10.0**log_off))
    for stage in (found, near):
        assert stage.through_gaps == pytest.approx(exact.through_gaps, rel=1e-10, abs=1e-13 * cell.mass / cell.h)
