"""Building blocks of the thermal contact agree with exact solutions."""

from math import asinh, exp, log, sqrt

import numpy as np
import pytest
from hypothesis import strategies as st

from solvers.arrays import RecordArray, records
from solvers.compiled import kernel
from solvers.contact.ehl import Contact, LineContactInputs, Model, flow, heat, linear_algebra, newton
from solvers.contact.ehl.flow import PLACE, flow_coefficients
from solvers.contact.ehl.grid import Grid, deflection_matrix, grid_for, heat_matrix
from solvers.contact.ehl.heat import heat_arrays
from solvers.contact.ehl.problem import Problem, groups, problem
from solvers.contact.ehl.shear import film_arrays
from solvers.lubricants import Lubricant
from tests.support.properties import examples

# Python calls compiled kernels here.
evaluate_columns = kernel(flow.evaluate_columns)
linearise_columns = kernel(flow.linearise_columns)
balance_columns = kernel(heat.balance_columns)
factor_columns = kernel(heat.factor_columns)
linearise_balances = kernel(heat.linearise_balances)
solve_column = kernel(heat.solve_column)
factor = kernel(linear_algebra.factor)
substitute = kernel(linear_algebra.substitute)
uniform_film = kernel(newton.uniform_film)

POINT = Contact(2.73e5, 4.015e-3, 1.0, 3.5)


def constants(oil: Lubricant, rheology: str) -> Problem:
    model = Model(rheology="newtonian") if rheology == "newtonian" else Model()
    inputs = LineContactInputs(POINT, lubricant=oil, model=model)
    return problem(inputs, groups(inputs))


def places(*columns: tuple[float, float, float]) -> RecordArray:
    """Return records with the p, G and h of the given columns."""
    at = records(len(columns), PLACE)
    at.p, at.g, at.h = np.array(columns).T
    return at


def couette_errors(sliding: float, nodes: int) -> tuple[float, float]:
    """Return the relative errors of temperature rise and stress in a flow between two walls at 360 K."""
    # The exact solution is that of Nahme for eta = eta0 e^(-beta (t - t_w)), Na = beta eta0 du^2/lambda: dt = ln(1 +
    # Na/8)/beta and tau = (8 lambda eta0/beta)^1/2/h asinh((Na/8)^1/2)/(1 + Na/8)^1/2.
    height, wall, beta = 0.5e-6, 360.0, 0.042
    oil = Lubricant(viscosity=20.0, temperature_viscosity=beta, pressure_viscosity_law="barus", compressible=False)
    fixed = constants(oil, "newtonian")._replace(
        speed_1=1.0, speed_2=1.0 + sliding, surface_heating_1=0.0, surface_heating_2=0.0
    )
    film, heat, coefficients = film_arrays(2, nodes), heat_arrays(2, nodes), flow_coefficients(2)
    heat.fluid_fraction[:] = 1.0
    t, step = np.full((2, nodes), wall), np.zeros((2, nodes))
    at = places((0.0, 0.0, height), (0.0, 0.0, height))
    grid = Grid(np.arange(2.0), np.zeros((2, 2)), np.zeros((2, 2)), np.ones(2))
    for _ in range(60):
        evaluate_columns(fixed, t, 1, 2, at, film, coefficients)
        linearise_columns(fixed, 1, 2, at, film, coefficients)
        balance_columns(fixed, grid, t, 1, 2, at, film, heat)
        linearise_balances(fixed, t, 1, 2, at, 0.0, film, heat)
        factor_columns(1, 2, film, heat)
        step[1] = -heat.column.residual[1]
        solve_column(1, film, heat, step)
        t[1] += step[1] * min(1.0, 40.0 / max(float(np.abs(step[1]).max()), 1e-9))
    assert float(np.abs(step[1]).max()) < 1e-9
    eighth = beta * oil.viscosity * sliding**2 / oil.thermal_conductivity / 8.0
    rise = log(1.0 + eighth) / beta
    stress = sqrt(8.0 * oil.thermal_conductivity * oil.viscosity / beta) / height
    stress *= asinh(sqrt(eighth)) / sqrt(1.0 + eighth)
    return float(t[1].max() - wall) / rise - 1.0, float(film.mid.stress[1]) / stress - 1.0


def test_thermal_couette_flow() -> None:
    """Xue Eq. 23. At Na = 1.5, temperature rise and stress on 21 nodes are exact to within 5e-4."""
    assert max(map(abs, couette_errors(0.5, 21))) < 5e-4


@pytest.mark.parametrize("sliding", [2.5, 20.0])
def test_thermal_couette_flow_converges_with_second_order(sliding: float) -> None:
    """At Na = 37.5 and 2400 the hottest place of the film is 41 and 136 K warmer than the walls."""
    coarse, fine = (np.abs(couette_errors(sliding, nodes)).max() for nodes in (21, 41))
    assert coarse < 6e-3
    assert coarse / fine == pytest.approx(4.0, rel=0.1)


def test_uniform_strip_source() -> None:
    """Xue Eq. 24. Uniform heat on a strip of 2 b warms the end of the strip by 2 q sqrt(2 b/(pi rho c u lambda))."""
    # The computed value agrees to within 0.1 %.
    grid = grid_for(0.2, 121)
    inside = (np.abs(grid.x) <= 1.0).astype(float)
    end = int(np.flatnonzero(inside)[-1])
    first = float(grid.x[np.flatnonzero(inside)[0]])
    before = float(grid.x[np.flatnonzero(inside)[0] - 1])
    length = float(grid.x[end]) - 0.5 * (first + before)  # the flux is linear across one interval
    assert float(grid.heat[end] @ inside) == pytest.approx(2.0 * sqrt(length), rel=1e-3)
    whole = np.linspace(-1.0, 1.0, 33)
    assert float(heat_matrix(whole)[-1] @ np.ones(33)) == pytest.approx(2.0 * sqrt(2.0), rel=1e-12)


def test_square_root_of_distance_heats_linearly() -> None:
    """The flux q = sqrt(s) gives pi/2 s. This flux is not piecewise linear, so the error falls with second order."""
    errors = []
    for nodes in (65, 129):
        x = np.linspace(0.0, 1.0, nodes) ** 2
        errors.append(abs(float(heat_matrix(x)[-1] @ np.sqrt(x)) / (np.pi / 2.0) - 1.0))
    assert errors[1] < 1e-4
    assert errors[0] / errors[1] > 3.5


def test_hertz_pressure_flattens_the_parabola() -> None:
    """Xue Eq. 21. With Hertzian pressure, X^2/2 + K P is constant inside the contact."""
    # The error arises because the computed pressure is linear between the nodes.
    defects = []
    for nodes in (241, 481):
        x = np.cos(np.linspace(np.pi, 0.0, nodes))
        pressure = np.sqrt(1.0 - x**2)
        gap = 0.5 * x**2 + deflection_matrix(x) @ pressure
        defects.append(float(np.ptp(gap)))
    assert defects[1] < 1e-4
    assert defects[0] / defects[1] > 3.5


@pytest.mark.parametrize("rheology", ["newtonian", "ree_eyring"])
@pytest.mark.parametrize(
    ("p", "g", "h"), [(0.9e9, 3e7, 0.5e-6), (0.2e9, -4e7, 0.3e-6), (1.5e9, 1e6, 0.5e-6), (1e7, 1e4, 3e-6)]
)
def test_column_at_one_temperature_is_the_closed_form(rheology: str, p: float, g: float, h: float) -> None:
    """Xue Eq. 17. Flux and mid-film stress on 200 intervals agree with the closed form for a uniform temperature."""
    # The flow coefficients A and B differ from those of the closed form, but the flux does not.
    given_ = constants(Lubricant(), rheology)
    film, coefficients = film_arrays(1, 201), flow_coefficients(1)
    evaluate_columns(given_, np.full((1, 201), 360.0), 0, 1, places((p, g, h)), film, coefficients)
    closed = flow_coefficients(1)
    stress = uniform_film(given_, 0, p, g, h, closed)
    numeric, exact = (each.b.value[0] - exp(each.log_a.value[0]) * h * g for each in (coefficients, closed))
    assert numeric == pytest.approx(exact, rel=5e-4)
    assert film.mid.stress[0] == pytest.approx(stress, rel=5e-4)


@pytest.mark.parametrize("rheology", ["newtonian", "ree_eyring"])
def test_derivatives_of_a_column(rheology: str) -> None:
    """The derivatives of ln A, of B and of the mid-film stress agree with central differences."""
    # These are the derivatives with respect to p, G, h and one temperature.
    given_ = constants(Lubricant(), rheology)
    film, coefficients = film_arrays(1, 21), flow_coefficients(1)
    t = 380.0 + 40.0 * np.random.default_rng(0).random(21)

    def value(p: float, g: float, h: float, warmer: float) -> np.ndarray:
        shifted = t.copy()
        shifted[7] += warmer
        at = places((p, g, h))
        evaluate_columns(given_, shifted[None, :], 0, 1, at, film, coefficients)
        linearise_columns(given_, 0, 1, at, film, coefficients)
        return np.array([coefficients.log_a.value[0], coefficients.b.value[0], film.mid.stress[0]])

    at = np.array([0.9e9, 3e7, 0.5e-6, 0.0])
    value(*at)
    slopes = ("by_p", "by_g", "by_h")
    exact = np.array([[coefficients.log_a[name][0], coefficients.b[name][0]] for name in slopes])
    stress = [film.mid.by_p[0], film.mid.by_g[0], film.mid.by_h[0], film.mid.by_temperature[0, 7]]
    by_t = [film.flow.log_a_by_temperature[0, 7], film.flow.b_by_temperature[0, 7]]
    for k, width in enumerate((1e4, 3e2, 5e-12, 1e-3)):
        step = np.zeros(4)
        step[k] = width
        slope = (value(*(at + step)) - value(*(at - step))) / (2.0 * width)
        expected = [*(exact[k] if k < 3 else by_t), stress[k]]
        assert slope == pytest.approx(expected, rel=1e-4, abs=1e-12)


@examples(100, 1000, st.integers(1, 40), st.integers(0, 2**31))
def test_dense_solution(n: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    matrix, solution = rng.standard_normal((n, n)) + np.eye(n), rng.standard_normal(n)
    vector, factors, pivots = matrix @ solution, matrix.copy(), np.empty(n, np.int64)
    factor(factors, pivots)
    substitute(factors, pivots, vector)
    assert np.abs(matrix @ (vector - solution)).max() < 1e-9 * n
