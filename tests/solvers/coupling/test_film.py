"""The inlet factor agrees with direct integration and with its limits, and the friction law is continuous."""

from math import exp, inf, radians

import numpy as np
import pytest
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.optimize import brentq

from benchmarks.published.pahl import pahl_coupling
from solvers.coupling.inputs import Friction, InletModel, MixedFrictionCurve, MixedFrictionTable, ModelOptions
from solvers.coupling.lubrication import (
    UNBOUNDED_LOAD,
    friction_coefficient,
    friction_regime,
    inlet_factor,
    mixed_friction,
    regime_friction,
)
from solvers.coupling.model import solve
from tests.support.changes import changed
from tests.support.properties import examples

INLETS: tuple[InletModel, ...] = ("face", "travel", "infinite")
LOWEST = 0.05  # of the default curve of mixed friction


def integrated_load(inlet: float) -> float:
    """Return the load W = -int X dp of a film by direct integration."""
    # The film thickness is H = 1 + X^2, and the pressure p follows from dp/dX = (H - H_m)/H^3. The pressure is 0 at X =
    # -inlet. At the exit, p and dp/dX are 0.

    def pressure_at_exit(exit_place: float) -> float:
        film = 1.0 + exit_place**2
        return quad(lambda x: (1 + x * x - film) / (1 + x * x) ** 3, -inlet, exit_place, epsabs=1e-14)[0]

    exit_place = brentq(pressure_at_exit, 1e-9, min(inlet, 1.0) * (1 - 1e-9), xtol=1e-15)
    film = 1.0 + exit_place**2
    return -quad(lambda x: x * (1 + x * x - film) / (1 + x * x) ** 3, -inlet, exit_place, epsabs=1e-15)[0]


@pytest.mark.parametrize("inlet", [0.3, 1.0, 1.7, 3.0, 10.0])
def test_inlet_factor_equals_direct_integration(inlet: float) -> None:
    assert inlet_factor(inlet) * UNBOUNDED_LOAD == pytest.approx(integrated_load(inlet), rel=1e-6)


def test_inlet_factor_limits() -> None:
    assert inlet_factor(1.7016) == pytest.approx(0.5, abs=1e-4)
    assert inlet_factor(0.0) == 0.0
    assert inlet_factor(inf) == 1.0
    assert inlet_factor(1e4) == pytest.approx(1.0, abs=1e-6)
    # The series is the leading term: its relative error at 0.02 is of the order of B^2 = 4e-4.
    assert inlet_factor(0.01999999) == pytest.approx(inlet_factor(0.02000001), rel=2e-3)


@examples(100, 1000, st.floats(0.0, 100.0), st.floats(1e-3, 1.0))
def test_inlet_factor_rises_with_the_inlet(inlet: float, step: float) -> None:
    assert 0.0 <= inlet_factor(inlet) <= inlet_factor(inlet + step) + 1e-12 <= 1.0 + 1e-12


@pytest.mark.parametrize("inlet", INLETS)
def test_inlet_models(inlet: InletModel) -> None:
    chosen, own = (
        solve(pahl_coupling(0.3, crowning_ratio=4.0, model=ModelOptions(inlet=inlet, inlet_length=length)))
        for length in (None, 5e-3)
    )
    travel, unit = own.kinematics.max_contact_travel, np.sqrt(2 * own.geometry.normal_flank_radius * 1e-6)
    expected = {"face": pytest.approx((12e-3 - travel) / unit, rel=1e-12), "infinite": None}
    expected["travel"] = pytest.approx(travel / unit, rel=1e-12)
    assert chosen.lubrication.inlet_ratio == expected[inlet]
    assert own.lubrication.inlet_ratio == pytest.approx(5e-3 / unit, rel=1e-12)


@pytest.mark.parametrize(
    "options", [ModelOptions(inlet=inlet) for inlet in INLETS] + [ModelOptions(inlet_length=3e-3)], ids=str
)
@pytest.mark.parametrize(("ratio", "misalignment"), [(11.0, 1.0), (4.0, 1.5)])
def test_a_contact_that_has_left_the_tooth_has_no_film(
    ratio: float, misalignment: float, options: ModelOptions
) -> None:
    result = solve(pahl_coupling(misalignment, crowning_ratio=ratio, model=options))
    assert result.kinematics.max_contact_travel > 12e-3
    film = result.lubrication
    assert film.hydrodynamic_capacity == film.load_capacity_coefficient == film.inlet_factor == 0.0
    assert film.regime.area.startswith("1.")
    edge = next(notice for notice in result.warnings if notice.code == "edge_contact")
    assert "leaves the tooth" in edge.message


def test_capacity_is_proportional_to_viscosity_and_inverse_to_the_film() -> None:
    base = pahl_coupling(0.2, model=ModelOptions(inlet="infinite"))
    plain, thick, thin = (
        solve(changed(base, change)).lubrication.hydrodynamic_capacity
        for change in ({}, {"lubricant.viscosity": 0.1}, {"lubricant.reference_film": 0.5e-6})
    )
    assert [thick, thin] == pytest.approx([4 * plain, 2 * plain], rel=1e-12)


def test_film_at_the_reversal_uses_the_velocity_there() -> None:
    largest = solve(pahl_coupling(0.2)).lubrication.hydrodynamic_capacity
    reversal = solve(pahl_coupling(0.2, model=ModelOptions(film_angle=radians(90.0)))).lubrication.hydrodynamic_capacity
    assert reversal / largest == pytest.approx(0.179, abs=5e-4)


def test_hertz_contact_of_the_highest_loaded_tooth() -> None:
    result = solve(pahl_coupling(0.4))
    film, radius = result.lubrication, result.geometry.normal_flank_radius
    half_width = np.sqrt(8 * film.max_normal_force * radius * (1 - 0.09) / (np.pi * 206e9 * 6e-3))
    assert film.hertz_half_width == pytest.approx(half_width, rel=1e-12)
    assert film.hertz_pressure == pytest.approx(2 * film.max_normal_force / (np.pi * half_width * 6e-3), rel=1e-12)
    assert film.contact_overlap == pytest.approx(half_width / result.kinematics.max_contact_travel, rel=1e-12)


def test_lubrication_belongs_to_the_tilt_position_whatever_the_rotor_angle() -> None:
    options = [ModelOptions(rotor_angle=angle) for angle in (0.0, 0.02, 0.05)]
    films = {solve(pahl_coupling(0.8, teeth=51, model=model)).lubrication.max_normal_force for model in options}
    assert len(films) == 1


@examples(
    100,
    1000,
    overlap=st.floats(0.01, 20.0),
    capacity=st.floats(1e-3, 20.0),
    mixed=st.floats(0.05, 0.1),
    step=st.floats(-1e-7, 1e-7),
)
def test_friction_is_continuous(overlap: float, capacity: float, mixed: float, step: float) -> None:
    here = regime_friction(overlap, capacity, mixed, LOWEST)
    for near in (
        regime_friction(overlap * (1 + step), capacity, mixed, LOWEST),
        regime_friction(overlap, capacity * (1 + step), mixed, LOWEST),
    ):
        assert near == pytest.approx(here, rel=1e-5)


@pytest.mark.parametrize("overlap", [1.0, 2.0])
@pytest.mark.parametrize("capacity", [0.0, 0.1, 0.2, 0.5, 0.8, 1.6, 5.0])
def test_friction_is_continuous_across_the_overlap_boundaries(overlap: float, capacity: float) -> None:
    below, above = (regime_friction(overlap * exp(step), capacity, 0.07, LOWEST) for step in (-1e-9, 1e-9))
    assert below == pytest.approx(above, rel=1e-7)


@examples(
    100,
    1000,
    overlap=st.floats(0.01, 10.0),
    capacity=st.floats(0.0, 5.0),
    better=st.floats(0.0, 2.0),
    lowest=st.floats(1e-3, 0.3),
    above=st.floats(1.0, 5.0),
)
def test_friction_never_rises_while_the_film_improves(
    overlap: float, capacity: float, better: float, lowest: float, above: float
) -> None:
    here = regime_friction(overlap, capacity, lowest * above, lowest)
    assert regime_friction(overlap, capacity + better, lowest * above, lowest) <= here * (1 + 1e-12)


@pytest.mark.parametrize("lowest", [0.003, 0.02, 0.05, 0.08])
def test_a_film_lowers_friction_from_the_least_of_the_mixed_curve_in_use(lowest: float) -> None:
    # 0.02: it used to rise to 0.05 at a load capacity coefficient of 0.2.
    for law in (MixedFrictionCurve(lowest=lowest), MixedFrictionTable((0.01, 0.11, 1.0), (0.1, lowest, 0.1))):
        assert mixed_friction(law, 0.11) == pytest.approx(lowest, rel=1e-12)
        friction = Friction(mixed_law=law) if isinstance(law, MixedFrictionTable) else Friction(mixed_curve=law)
        values = [friction_coefficient(friction, 0.5, capacity, 0.11) for capacity in (0.0, 0.1, 0.2, 0.5, 0.8, 1.6)]
        assert values[:3] == pytest.approx([lowest] * 3, rel=1e-12)
        assert np.diff(values).max() < 1e-15
        assert values[4] == pytest.approx(min(0.01, lowest), rel=1e-12)
        assert values[5] == pytest.approx(min(0.005, lowest), rel=1e-12)


def test_mixed_friction_is_continuous_and_lowest_at_its_velocity() -> None:
    law = MixedFrictionCurve()
    assert mixed_friction(law, 0.0) == law.highest
    assert mixed_friction(law, law.velocity) == law.lowest
    assert mixed_friction(law, law.velocity * (1 + 1e-9)) == pytest.approx(law.lowest, rel=1e-9)
    assert mixed_friction(law, 100.0) == law.highest


@pytest.mark.parametrize(
    ("overlap", "capacity", "distance"),
    [(0.5, 0.2, 0.0), (3.0, 0.4, np.log(1.5)), (inf, 0.0, None), (inf, 0.4, np.log(2.0)), (1.1, inf, np.log(1.1))],
)
def test_distance_to_the_nearest_boundary(overlap: float, capacity: float, distance: float | None) -> None:
    expected = None if distance is None else pytest.approx(distance, abs=1e-12)
    assert friction_regime(overlap, capacity).distance_to_boundary == expected
