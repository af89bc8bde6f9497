"""Solved contacts meet all criteria of convergence, limits, symmetry and order; wrong inputs are refused."""

from dataclasses import replace

import numpy as np
import pytest

from benchmarks.published.xue import POINT_A
from solvers.contact.ehl import LineContactInputs, LineContactResult, Model, Temperatures, continuation
from solvers.contact.ehl.model import solve
from solvers.contact.ehl.rheology import STRESS_LIMIT
from solvers.lubricants import Lubricant
from solvers.materials import Solid
from tests.support.line_contacts import at_pressure, grid_contacts, random_contacts
from tests.support.outcomes import assert_finite, codes, refused

EYRING = Model()


def check_solution(result: LineContactResult, model: Model = EYRING) -> None:
    """Assert that a result meets all criteria of convergence and contains only finite numbers."""
    curves, convergence = result.curves, result.convergence
    assert convergence.pressure_change < 1e-5
    assert convergence.load_error < 1e-9
    broken = curves.fluid_fraction < 1.0
    assert np.all(curves.pressure >= 0.0)
    assert np.all(curves.pressure[broken] == 0.0)
    assert np.all(np.diff(broken.astype(int)) >= 0)  # the film breaks once, behind the centre
    assert np.all(curves.film > 0.0)
    assert np.all((curves.fluid_fraction > 0.0) & (curves.fluid_fraction <= 1.0))
    if model.rheology == "ree_eyring":
        assert result.friction.max_pressure_stress < 2.0 * STRESS_LIMIT * model.eyring_stress  # no guard acted
    assert_finite(result)
    if model.thermal:
        assert convergence.temperature_change < 0.01
        assert result.heat.balance_error < 1e-4
    else:
        assert (result.heat, result.temperature) == (None, None)


def check_all(contacts: list[LineContactInputs]) -> int:
    """Check that solutions meet all criteria and that other results have no numbers; return the number of solutions."""
    solved = 0
    for inputs in contacts:
        result = solve(inputs)
        if result.status == "no_solution":
            assert (result.friction, result.film.minimum) == (None, None)
            assert result.convergence.stage in {"isothermal", "coupling", "heat_balance"}
            continue
        check_solution(result, inputs.model)
        solved += 1
    return solved


def test_every_eyring_contact_is_solved() -> None:
    assert check_all(random_contacts(Model(), 60, seed=2)) == 60


@pytest.mark.slow
def test_every_one_of_500_eyring_contacts_and_of_the_grid_is_solved() -> None:
    assert check_all(random_contacts(Model(), 500, seed=1)) == 500
    assert check_all(grid_contacts(Model())) == 200


def test_a_newtonian_contact_is_solved_or_says_that_it_is_not() -> None:
    assert check_all(random_contacts(Model(rheology="newtonian"), 30, seed=3)) >= 28


@pytest.mark.slow
def test_newtonian_contacts_of_the_grid_and_at_random() -> None:
    """Near pure rolling nothing limits the stress of a Newtonian oil."""
    # Four contacts of the grid are not solved. Their slide-roll ratios are at most 0.1.
    newtonian = Model(rheology="newtonian")
    assert check_all(grid_contacts(newtonian)) >= 195
    assert check_all(random_contacts(newtonian, 500, seed=1)) >= 498


@pytest.mark.parametrize("rheology", ["ree_eyring", "newtonian"])
@pytest.mark.parametrize("pressure", [0.3e9, 1e9, 3e9])
@pytest.mark.parametrize(("speed", "viscosity"), [(0.3, 0.008), (15.0, 0.08)])
@pytest.mark.parametrize("radius", [4e-3, 20e-3])
def test_isothermal_contacts(rheology: str, pressure: float, speed: float, viscosity: float, radius: float) -> None:
    model = replace(Model(thermal=False), rheology=rheology)
    result = solve(at_pressure(pressure, 0.5, speed, viscosity, radius, model))
    assert result.status != "no_solution"
    check_solution(result, model)


def test_a_spike_without_a_limit_is_said_not_to_converge() -> None:
    """The friction coefficient of an isothermal Newtonian contact at 1 GPa and 15 m/s does not converge."""
    # The coefficient is 1405, 3512 and 5682 on 121, 241 and 481 nodes. Half of the nodes with interpolated pressures
    # would keep the spike of all nodes: after one Newton step on them the error would seem to be 3.4 %, and not 38 %.
    # The stated error is the whole difference between both meshes, because the pressure falls steeply from one node to
    # the next.
    model = Model(thermal=False, rheology="newtonian")
    inputs = at_pressure(1e9, 0.5, 15.0, 0.08, 4e-3, model)
    result, coarse = solve(inputs), solve(replace(inputs, model=replace(model, nodes=241, refine_mesh=False)))
    assert result.convergence.nodes == 481
    moved = abs(coarse.friction.coefficient / result.friction.coefficient - 1.0)
    assert result.mesh_error.friction == pytest.approx(moved, rel=0.02)
    assert "mesh_error" in codes(result)
    assert result.film.minimum == pytest.approx(coarse.film.minimum, rel=0.005)


@pytest.mark.parametrize("thermal", [True, False])
def test_film_thickness_converges_with_second_order(thermal: bool) -> None:
    """The three meshes have 90, 180 and 360 intervals of the same grading."""
    films = [
        solve(
            LineContactInputs(POINT_A, model=Model(thermal=thermal, nodes=n, refine_mesh=False), lubricant=Lubricant())
        ).film
        for n in (91, 181, 361)
    ]
    for values in ([f.central for f in films], [f.minimum for f in films]):
        coarse, middle, fine = (value or 0.0 for value in values)
        assert np.log2((middle - coarse) / (fine - middle)) == pytest.approx(2.0, abs=0.4)


@pytest.mark.parametrize("rheology", ["ree_eyring", "newtonian"])
def test_exchanged_surfaces_exchange_the_results(rheology: str) -> None:
    model = replace(Model(), rheology=rheology)
    mirror = replace(POINT_A, speed_1=POINT_A.speed_2, speed_2=POINT_A.speed_1)
    one, other = (solve(LineContactInputs(c, model=model, lubricant=Lubricant())) for c in (POINT_A, mirror))
    assert one.film.minimum == pytest.approx(other.film.minimum, rel=1e-5)
    assert one.friction.coefficient == pytest.approx(other.friction.coefficient, rel=1e-5)
    assert one.friction.coefficient_1 == pytest.approx(other.friction.coefficient_2, rel=1e-5)
    assert np.abs(one.field.temperature - other.field.temperature[:, ::-1]).max() < 0.01
    assert one.heat.to_surface_1 == pytest.approx(other.heat.to_surface_2, rel=1e-5)


@pytest.mark.parametrize(("rheology", "nodes", "load"), [("newtonian", 121, 1e4), ("ree_eyring", 361, 2.73e5)])
def test_perfect_conductors_make_it_isothermal(rheology: str, nodes: int, load: float) -> None:
    """If film and solids carry all heat away, the thermal film agrees with the isothermal film to within 0.4 %."""
    # The 20 intervals across the thermal film change the flow coefficient A by 1/400. Both films also split the flux of
    # a Ree-Eyring oil differently into its parts, which costs 0.8 % on 121 nodes.
    metal = Solid(thermal_conductivity=1e12)
    model = replace(Model(nodes=nodes), rheology=rheology)
    at = replace(POINT_A, line_load=load)
    inputs = LineContactInputs(at, metal, metal, lubricant=Lubricant(thermal_conductivity=1e7), model=model)
    cold = solve(inputs)
    isothermal = solve(replace(inputs, model=replace(model, thermal=False)))
    assert cold.temperature.film_max == pytest.approx(360.0, abs=0.01)
    assert cold.film.minimum == pytest.approx(isothermal.film.minimum, rel=0.004)
    assert cold.film.central == pytest.approx(isothermal.film.central, rel=0.004)
    assert cold.friction.coefficient == pytest.approx(isothermal.friction.coefficient, rel=0.004)


def test_warmer_surroundings_shift_a_film_without_viscosity_change() -> None:
    """If all temperatures rise by 20 K, the contact with Barus' law stays the same, but is 20 K warmer."""
    # The reference temperature of the oil also rises by 20 K.
    oil = Lubricant(pressure_viscosity_law="barus", pressure_viscosity=12e-9, compressible=False)
    one, other = (
        solve(
            LineContactInputs(
                POINT_A, lubricant=replace(oil, reference_temperature=t), temperatures=Temperatures(t, t, t)
            )
        )
        for t in (360.0, 380.0)
    )
    assert other.temperature.film_max - one.temperature.film_max == pytest.approx(20.0, abs=0.01)
    assert other.film.minimum == pytest.approx(one.film.minimum, rel=1e-5)


def test_equal_speeds_are_a_regular_point() -> None:
    result = solve(LineContactInputs(replace(POINT_A, speed_1=2.0, speed_2=2.0), lubricant=Lubricant()))
    check_solution(result)
    assert result.friction.power == 0.0


REFUSED = [
    ("no_entrainment", {"speed_1": -1.0, "speed_2": 1.0}, {}, {}),
    ("no_entrainment", {"speed_1": 0.0, "speed_2": 0.0}, {}, {"thermal": False}),
    ("stationary_surface", {"speed_1": 0.0}, {}, {}),
    ("stationary_surface", {"speed_2": -0.5}, {}, {}),
    ("viscosity_range", {}, {"viscosity": 6e-5}, {}),
    ("pressure_range", {"line_load": 2e6}, {}, {}),
    ("no_load", {"line_load": 0.0}, {}, {}),
    ("temperature_range", {}, {"reference_temperature": 150.0}, {}),
    ("viscosity_range", {}, {"reference_temperature": 600.0}, {}),
    ("viscosity_range", {"line_load": 1e6}, {"pressure_viscosity": 120e-9, "pressure_viscosity_law": "barus"}, {}),
    ("load_range", {"line_load": 1.0}, {}, {}),
    ("film_range", {"speed_1": 1e-6, "speed_2": 1e-6}, {}, {}),
    ("resolution", {}, {}, {"nodes": 11}),
]


@pytest.mark.parametrize(("code", "contact", "oil", "model"), REFUSED)
def test_refused(code: str, contact: dict[str, float], oil: dict[str, float], model: dict[str, bool]) -> None:
    parts = {"lubricant": replace(Lubricant(), **oil), "model": replace(Model(), **model)}
    found, field = refused(solve, LineContactInputs(replace(POINT_A, **contact), **parts))
    assert found == code
    assert field


def test_stationary_surface_is_allowed_without_heat() -> None:
    result = solve(LineContactInputs(replace(POINT_A, speed_1=0.0), model=Model(thermal=False), lubricant=Lubricant()))
    check_solution(result, Model(thermal=False))


def test_slow_surface_is_solved_with_a_warning() -> None:
    """At point A the Peclet number of surface 1 is 4.5. At 0.08 m/s it is 0.35, and the contact is still solved."""
    for speed in (POINT_A.speed_1, 0.08):
        result = solve(LineContactInputs(replace(POINT_A, speed_1=speed), lubricant=Lubricant()))
        assert result.status == "ok_with_warnings"
        assert "low_peclet" in codes(result)
    assert result.dimensionless.peclet_1 == pytest.approx(0.35, abs=0.01)


def test_thin_film_and_high_traction_are_flagged() -> None:
    thin = solve(at_pressure(3e9, 0.5, 0.3, 0.008, 3e-3, Model()))
    assert "thin_film" in codes(thin)
    stiff = solve(at_pressure(1.4e9, 0.05, 2.4, 0.08, 6.5e-3, Model(rheology="newtonian")))
    assert {"high_traction", "newtonian_low_slip"} <= codes(stiff)


def test_no_solution_carries_residuals_and_no_numbers(monkeypatch: pytest.MonkeyPatch) -> None:
    """No attempt converges if the number of Newton steps on a mesh is limited to three."""
    monkeypatch.setattr(continuation, "STEPS_A_SOLVE", 3)
    result = solve(LineContactInputs(POINT_A, model=Model(rheology="newtonian"), lubricant=Lubricant()))
    assert result.status == "no_solution"
    assert result.convergence.stage == "coupling"
    assert (result.convergence.pressure_change or 0.0) > 0.0
    assert (result.pressure, result.temperature, result.friction, result.heat, result.curves) == (None,) * 5
    assert result.film.dowson_higginson > 0.0


def test_steps_are_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    """If the tolerances cannot be met, the budget limits the number of Newton steps of all attempts together."""
    monkeypatch.setattr(continuation, "TIGHT", (0.0, 0.0))
    monkeypatch.setattr(continuation, "LOOSE", (0.0, 0.0))
    result = solve(LineContactInputs(POINT_A, lubricant=Lubricant()))
    assert result.status == "no_solution"
    assert result.convergence.iterations < 4 * continuation.STEPS_IN_ALL  # coarse meshes are cheaper
