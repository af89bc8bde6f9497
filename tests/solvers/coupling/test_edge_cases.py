"""For zeros, values out of range and random inputs, the answer is finite or states a reason."""

from collections.abc import Callable
from dataclasses import replace
from math import cos, degrees, inf, nan, pi, radians

import numpy as np
import pytest
from hypothesis import strategies as st

from benchmarks.published.pahl import pahl_coupling
from solvers import coupling
from solvers.coupling.crowning import Recommendation, recommend
from solvers.coupling.inputs import (
    Arrangement,
    Coupling,
    CouplingInputs,
    Friction,
    Lubricant,
    MixedFrictionTable,
    ModelOptions,
    Operation,
    RecommendationInputs,
)
from solvers.coupling.model import solve
from solvers.coupling.orbit import solve_orbit
from solvers.coupling.results import CouplingResult
from solvers.errors import NoSolution, SolverError
from tests.support.changes import changed
from tests.support.outcomes import assert_finite, codes, refused
from tests.support.properties import examples


def test_an_ordinary_case_has_no_warning() -> None:
    result = solve(pahl_coupling(0.1, friction=None))
    assert_finite(result)
    assert result.warnings == ()
    assert not result.axial_thrust.indeterminate


@pytest.mark.parametrize("arrangement", ["single", "parallel_offset", "angular"])
def test_aligned_and_still_shafts_hold_any_thrust_up_to_the_limit(arrangement: Arrangement) -> None:
    result = solve(pahl_coupling(0.0, arrangement=arrangement, friction=None))
    assert_finite(result)
    film, thrust = result.lubrication, result.axial_thrust
    assert film.contact_overlap is None
    assert film.load_capacity_coefficient == film.hydrodynamic_capacity == 0.0
    assert (film.regime.area, film.regime.distance_to_boundary) == ("1.3", None)
    assert film.friction_coefficient == pytest.approx(0.16, rel=1e-12)
    assert (thrust.force, thrust.indeterminate) == (0.0, True)
    assert thrust.upper_bound == pytest.approx(thrust.coaxial_limit, rel=1e-9)
    assert thrust.lower_bound == pytest.approx(-thrust.coaxial_limit, rel=1e-9)
    assert {"no_misalignment", "friction_indeterminate"} <= codes(result)
    assert result.losses.friction_power == 0.0


def test_aligned_shafts_that_separate_have_no_self_induced_thrust_of_their_own() -> None:
    result = solve(pahl_coupling(0.0, axial_velocity=1e-3, arrangement="parallel_offset"))
    assert result.axial_thrust.self_induced.force == 0.0
    assert not result.axial_thrust.indeterminate
    assert "friction_indeterminate" in codes(result)


@pytest.mark.parametrize("arrangement", ["single", "parallel_offset", "angular"])
@pytest.mark.parametrize("sleeve", ["centred", "floating"])
def test_no_torque_no_forces(arrangement: Arrangement, sleeve: str) -> None:
    options = ModelOptions(sleeve=sleeve)
    result = solve(pahl_coupling(0.1, torque=0.0, arrangement=arrangement, model=options, axial_velocity=1e-3))
    assert_finite(result)
    load, thrust = result.load_distribution, result.axial_thrust
    assert load.max_tangential_force == load.loaded_teeth == thrust.force == result.losses.hub_bending_moment == 0.0
    assert result.lubrication.load_capacity_coefficient is None
    assert (load.load_concentration, thrust.fraction_of_limit) == (None, None)
    assert thrust.self_induced is None or thrust.self_induced.force == 0.0
    assert "no_load" in codes(result)


def test_a_tooth_with_a_billionth_of_the_load_does_not_count_as_loaded() -> None:
    # The unloading misalignment leaves the pivot teeth with rounding, or with as little as one likes.
    limit = degrees(solve(pahl_coupling(0.2)).load_distribution.unloading_misalignment)
    load = solve(pahl_coupling(limit * (1.0 - 1e-10))).load_distribution
    assert 0.0 < load.min_tangential_force < 1e-6 * load.mean_tangential_force
    assert load.loaded_teeth == 50
    assert solve(pahl_coupling(limit * (1.0 - 1e-5))).load_distribution.loaded_teeth == 52
    assert solve(pahl_coupling(limit)).load_distribution.min_tangential_force == 0.0
    assert solve(pahl_coupling(1.001 * limit)).load_distribution.loaded_teeth < 52


def test_standing_coupling() -> None:
    result = solve(pahl_coupling(0.1, speed=0.0, axial_velocity=1e-3, friction=None))
    assert_finite(result)
    assert result.limits.allowable_misalignment is None
    assert result.lubrication.load_capacity_coefficient == 0.0
    assert result.axial_thrust.fraction_of_limit == pytest.approx(1.0, rel=1e-9)
    assert "not_turning" in codes(result)
    assert solve(pahl_coupling(0.1, speed=0.0)).axial_thrust.indeterminate


def test_everything_zero_at_once() -> None:
    for arrangement in ("single", "parallel_offset", "angular"):
        result = solve(pahl_coupling(0.0, torque=0.0, speed=0.0, friction=0.0, arrangement=arrangement))
        assert_finite(result)
        assert result.axial_thrust.force == 0.0
        assert {"no_misalignment", "no_load", "not_turning"} <= codes(result)


def test_frictionless_coupling() -> None:
    result = solve(pahl_coupling(0.1, friction=0.0, arrangement="parallel_offset", axial_velocity=1e-3))
    assert_finite(result)
    assert result.axial_thrust.force == 0.0
    assert result.axial_thrust.fraction_of_limit is None
    assert "no_friction" in codes(result)


ON_TWO_TEETH = ModelOptions(sleeve="floating", rotor_angle=pi / 2)


@pytest.mark.parametrize(
    ("inputs", "code"),
    [
        (pahl_coupling(0.5, speed=400.0), "sliding_velocity"),
        (pahl_coupling(0.5, crowning_ratio=8.0), "edge_contact"),
        (pahl_coupling(0.1, crowning_ratio=8.0, face_width=3e-3), "wide_contact"),
        (pahl_coupling(0.1, torque=5.0), "sleeve_not_centred"),
        (pahl_coupling(0.1, model=ModelOptions(inlet="infinite")), "infinite_inlet"),
        (pahl_coupling(2.0, teeth=6, module=26e-3, torque=10.0, model=ON_TWO_TEETH), "sleeve_position"),
        (replace(pahl_coupling(0.02, crowning_ratio=11.0), lubricant=Lubricant(viscosity=1.0)), "unstable_regime"),
        (pahl_coupling(0.1, speed=0.9), "no_sliding_limit"),
        (pahl_coupling(0.1, speed=-14.0), "allowable_misalignment"),
    ],
)
def test_ranges_left_are_named(inputs: CouplingInputs, code: str) -> None:
    result = solve(inputs)
    assert_finite(result)
    assert code in codes(result)


@pytest.mark.parametrize(
    ("speed", "allowed", "code"),
    [
        (0.0, False, "not_turning"),
        (0.97, False, "no_sliding_limit"),  # 0.12 m/s over 0.078 m is 1.54 rad/s at an angle of one, 0.98 at pi/2
        (0.99, True, "allowable_misalignment"),
        (14.6, True, "allowable_misalignment"),  # 14.69 rad/s: 6 degrees
        (14.8, True, None),
    ],
)
def test_allowable_misalignment_is_given_or_its_absence_explained(
    speed: float, allowed: bool, code: str | None
) -> None:
    result = solve(pahl_coupling(0.1, speed=speed, axial_velocity=1e-3))
    assert (result.limits.allowable_misalignment is not None) == allowed
    assert codes(result) & {"not_turning", "no_sliding_limit", "allowable_misalignment"} == ({code} if code else set())


@pytest.mark.parametrize(("misalignment", "area"), [(0.1, "3.1"), (0.0, "1.3")])
def test_without_load_the_notice_says_what_regime_and_friction_rest_on(misalignment: float, area: str) -> None:
    result = solve(pahl_coupling(misalignment, torque=0.0, friction=None))
    message = next(notice.message for notice in result.warnings if notice.code == "no_load")
    assert "regime and the coefficient of friction are stated for a very small load" in message
    vanishing = solve(pahl_coupling(misalignment, torque=1e-6, friction=None)).lubrication
    assert result.lubrication.regime.area == vanishing.regime.area == area
    assert result.lubrication.friction_coefficient == pytest.approx(vanishing.friction_coefficient, rel=1e-6)


OUT_OF_RANGE = [
    ("coupling.teeth", 5),
    ("coupling.module", 0.0),
    ("coupling.face_width", -1.0),
    ("coupling.tooth_height", nan),
    ("coupling.pressure_angle", radians(45.0)),
    ("coupling.pressure_angle", 0.0),
    ("coupling.crowning_ratio", 0.19),
    ("coupling.hub_distance", 0.0),
    ("coupling.tooth_stiffness", inf),
    ("coupling.sleeve_mass", 0.0),
    ("coupling.youngs_modulus", 0.0),
    ("coupling.poisson_ratio", 0.5),
    ("operation.torque", -1.0),
    ("operation.speed", inf),
    ("operation.axial_velocity", nan),
    ("operation.shaft_diameter", 0.0),
    ("lubricant.viscosity", 0.0),
    ("lubricant.reference_film", 0.0),
    ("friction.coefficient", -0.1),
    ("friction.static_coefficient", nan),
    ("friction.mixed_curve.highest", 0.0),
    ("friction.mixed_curve.lowest", nan),
    ("friction.mixed_curve.velocity", 0.0),
    ("model.inlet_length", 0.0),
    ("model.film_angle", nan),
    ("model.rotor_angle", inf),
    ("model.simple_thrust_factor", -0.1),
]


@pytest.mark.parametrize(("field", "value"), OUT_OF_RANGE)
def test_numbers_out_of_range_are_refused(field: str, value: float) -> None:
    for calculation in (coupling.solve, coupling.solve_orbit):
        assert refused(calculation, changed(pahl_coupling(0.1), {field: value})) == ("out_of_range", field)


def table(velocity: tuple[float, ...], coefficient: tuple[float, ...]) -> CouplingInputs:
    return changed(pahl_coupling(0.1), {"friction": Friction(mixed_law=MixedFrictionTable(velocity, coefficient))})


@pytest.mark.parametrize(
    ("inputs", "code", "field"),
    [
        (changed(pahl_coupling(0.1), {"operation.misalignment": radians(6.1)}), "out_of_range", "misalignment"),
        (changed(pahl_coupling(0.1), {"operation.misalignment": nan}), "out_of_range", "misalignment"),
        (pahl_coupling(0.1, pitch_errors=(0.0,) * 51), "pitch_errors_length", "pitch_errors"),
        (pahl_coupling(0.1, pitch_errors=(nan,) * 52), "out_of_range", "pitch_errors"),
        (table((), ()), "mixed_law", "mixed_law"),
        (table((0.1, 0.1), (0.1, 0.1)), "mixed_law", "mixed_law"),
        (table((0.1,), (0.1, 0.2)), "mixed_law", "mixed_law"),
        (table((-0.1, 0.1), (0.1, 0.1)), "mixed_law", "mixed_law"),
        (table((0.1, inf), (0.1, 0.1)), "mixed_law", "mixed_law"),
        (table((0.1, 0.2), (0.1, 0.0)), "mixed_law", "mixed_law"),
        (changed(pahl_coupling(0.1), {"friction.mixed_curve.highest": 0.04}), "mixed_curve", "lowest"),
        (pahl_coupling(0.1, torque=2e6), "hertz_pressure", "torque"),
        (pahl_coupling(0.1, torque=2e5, youngs_modulus=1e9), "contact_width", "crowning_ratio"),
    ],
)
def test_inputs_without_sense_are_refused(inputs: CouplingInputs, code: str, field: str) -> None:
    assert refused(solve, inputs) == (code, field)


def test_a_friction_table_of_one_point_is_a_constant() -> None:
    for speed in (20.0, 200.0):
        inputs = table((0.1,), (0.07,))
        film = solve(changed(inputs, {"operation.misalignment": radians(0.4), "operation.speed": speed})).lubrication
        assert film.regime.area == "1.1"
        assert film.friction_coefficient == pytest.approx(0.07, rel=1e-12)


@st.composite
def any_inputs(draw: st.DrawFn) -> CouplingInputs:
    """Draw valid inputs over several orders of magnitude. Some of the values are zero."""

    def spread(low: float, high: float) -> float:
        return float(np.exp(draw(st.floats(np.log(low), np.log(high)))))

    def signed(low: float, high: float) -> float:
        return draw(st.sampled_from([-1.0, 0.0, 1.0])) * spread(low, high)

    teeth, module = draw(st.integers(6, 120)), spread(5e-4, 2e-2)
    size = draw(st.sampled_from([0.0, 1e-7, 5e-6]))
    errors = None
    if size:
        errors = tuple(size * np.random.default_rng(draw(st.integers(0, 99))).normal(size=teeth))
    coupling = Coupling(
        teeth=teeth,
        module=module,
        face_width=module * spread(2.0, 20.0),
        tooth_height=module * spread(0.5, 3.0),
        pressure_angle=radians(draw(st.floats(5.0, 40.0))),
        crowning_ratio=spread(0.2, 50.0),
        hub_distance=spread(0.01, 3.0),
        tooth_stiffness=spread(1e6, 1e10),
        sleeve_mass=spread(0.01, 500.0),
        pitch_errors=errors,
    )
    operation = Operation(
        torque=draw(st.sampled_from([0.0, 1.0])) * spread(1.0, 1e5),
        speed=signed(1.0, 3000.0),
        misalignment=radians(signed(1e-4, 6.0)),
        axial_velocity=signed(1e-5, 0.1),
        arrangement=draw(st.sampled_from(["single", "parallel_offset", "angular"])),
    )
    options = ModelOptions(
        kinematics=draw(st.sampled_from(["tangential", "spatial"])),
        sleeve=draw(st.sampled_from(["centred", "floating"])),
        inlet=draw(st.sampled_from(["face", "travel", "infinite"])),
        rotor_angle=draw(st.floats(-7.0, 7.0)),
    )
    friction = Friction(draw(st.sampled_from([None, 0.0, 0.1, 0.4])))
    return CouplingInputs(coupling, operation, friction=friction, model=options)


def answered(calculation: Callable[[], object], reasons: set[str]) -> object | None:
    """Return the answer of the calculation, or None if the calculation refuses or fails for one of `reasons`."""
    try:
        result = calculation()
    except SolverError as error:
        if error.code not in reasons:
            raise
        if isinstance(error, NoSolution):
            assert_finite(tuple(error.residuals.values()))
        return None
    assert_finite(result)
    return result


@examples(100, 300, any_inputs())
def test_any_valid_input_is_answered_or_refused_with_a_reason(inputs: CouplingInputs) -> None:
    reasons = {"hertz_pressure", "contact_width"}
    friction = 0.16 if inputs.friction.coefficient is None else inputs.friction.coefficient
    diameter, teeth = inputs.coupling.module * inputs.coupling.teeth, inputs.coupling.teeth
    if friction * diameter / inputs.coupling.hub_distance > 0.999 * cos(pi / teeth):
        # Below, Brouwer's theorem promises an equilibrium: friction maps the forces the teeth hold into themselves.
        reasons.add("sleeve_equilibrium")
    result = answered(lambda: solve(inputs), reasons)
    if isinstance(result, CouplingResult):
        force = result.load_distribution.curves.tangential_force
        assert force.min() >= 0.0
        assert force.sum() * result.geometry.pitch_radius == pytest.approx(inputs.operation.torque, rel=1e-6)


@examples(100, 300, any_inputs())
def test_every_floating_sleeve_is_balanced(inputs: CouplingInputs) -> None:
    alone = changed(inputs, {"operation.arrangement": "single", "model.sleeve": "floating"})
    answered(lambda: solve(alone), {"hertz_pressure", "contact_width"})


@st.composite
def sleeves_in_equilibrium(draw: st.DrawFn) -> CouplingInputs:
    """Draw a coupling with two meshes whose friction is low enough for an equilibrium of the sleeve."""
    teeth, friction = draw(st.integers(6, 100)), draw(st.floats(0.01, 0.3))
    errors = draw(st.sampled_from([0.0, 1e-6, 1e-5]))
    return pahl_coupling(
        draw(st.floats(0.005, 3.0)),
        torque=draw(st.floats(30.0, 5000.0)),
        axial_velocity=draw(st.sampled_from([0.0, 1e-4, -1e-3, 1e-2])),
        arrangement=draw(st.sampled_from(["parallel_offset", "angular"])),
        friction=friction,
        model=ModelOptions(kinematics=draw(st.sampled_from(["tangential", "spatial"]))),
        teeth=teeth,
        module=0.156 / teeth,
        hub_distance=friction * 0.156 / (draw(st.floats(0.01, 0.99)) * cos(pi / teeth)),
        pitch_errors=tuple(errors * np.random.default_rng(teeth).normal(size=teeth)) if errors else None,
    )


@examples(100, 300, sleeves_in_equilibrium())
def test_every_sleeve_whose_equilibrium_exists_is_balanced(inputs: CouplingInputs) -> None:
    answered(lambda: solve(inputs), {"hertz_pressure"})


@examples(20, 60, any_inputs())
def test_any_orbit_is_answered_or_refused_with_a_reason(inputs: CouplingInputs) -> None:
    answered(lambda: solve_orbit(inputs), {"torque_too_low", "sleeve_orbit"})


@examples(20, 60, any_inputs(), st.floats(1e-3, 1.0), st.floats(1.0, 5.0))
def test_any_recommendation_is_answered_or_refused_with_a_reason(
    inputs: CouplingInputs, low: float, width: float
) -> None:
    wanted = RecommendationInputs(inputs, radians(low), radians(low * width))
    result = answered(lambda: recommend(wanted), {"no_load", "not_turning", "sleeve_equilibrium"})
    if isinstance(result, Recommendation):
        assert result.feasible == (result.failed_constraint is None) == (result.crowning_ratio is not None)
