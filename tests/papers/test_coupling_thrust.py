"""Pahl, "The operating characteristics of gear-type couplings": axial thrust, Figs 12 to 18, and the conclusion.

Numbers without a source in the paper are those of an independent calculation of the same statement.
"""

from dataclasses import replace
from math import asin, cos, pi, radians

import numpy as np
import pytest

from solvers.coupling.crowning import recommend
from solvers.coupling.inputs import CouplingInputs, KinematicModel, ModelOptions, RecommendationInputs
from solvers.coupling.model import solve
from solvers.coupling.results import AxialThrust
from solvers.published.pahl import CREEP, PITCH_RADIUS, pahl_coupling


def thrust(inputs: CouplingInputs) -> AxialThrust:
    return solve(inputs).axial_thrust


def parallel_offset(misalignment: float, **options: object) -> float:
    return thrust(pahl_coupling(misalignment, arrangement="parallel_offset", **options)).force


@pytest.mark.parametrize(("torque", "force"), [(1000.0, 2728.7), (3000.0, 8186.0), (5000.0, 13643.3)])
def test_coaxial_thrust_is_mu_times_the_sum_of_normal_forces(torque: float, force: float) -> None:
    result = thrust(pahl_coupling(0.0, torque=torque, axial_velocity=CREEP))
    assert result.force == pytest.approx(force, abs=0.05)
    assert result.coaxial_limit == pytest.approx(force, abs=0.05)
    assert result.fraction_of_limit == pytest.approx(1.0, rel=1e-12)


def test_figure_14a_thrust_keeps_its_value_while_axial_exceeds_sliding_velocity() -> None:
    limit = np.degrees(CREEP / (200.0 * PITCH_RADIUS))
    for misalignment in (0.0, 0.5 * limit, 0.999 * limit):
        fraction = thrust(pahl_coupling(misalignment, axial_velocity=CREEP)).fraction_of_limit
        assert fraction == pytest.approx(1.0, rel=1e-9)
    assert thrust(pahl_coupling(1.2 * limit, axial_velocity=CREEP)).fraction_of_limit < 0.9


@pytest.mark.parametrize(("speed", "closed", "teeth"), [(200.0, 0.0939, 0.0924), (50.0, 0.400, 0.395)])
def test_figures_15_and_16_thrust_left_at_0_05_degrees(speed: float, closed: float, teeth: float) -> None:
    result = thrust(pahl_coupling(0.05, speed=speed, axial_velocity=CREEP))
    assert result.uniform_load_force / result.coaxial_limit == pytest.approx(closed, rel=2e-3)
    assert result.fraction_of_limit == pytest.approx(teeth, rel=1e-2)


def test_figure_16_less_than_a_tenth_is_left_at_0_05_degrees() -> None:
    for torque in (1000.0, 3000.0, 5000.0):
        for velocity in (0.5e-3, 1e-3, 2e-3):
            fraction = thrust(pahl_coupling(0.05, torque=torque, axial_velocity=velocity)).fraction_of_limit
            assert fraction < 0.1


@pytest.mark.parametrize("speed", [50.0, 200.0])
def test_figures_15_and_16_order_of_the_curves(speed: float) -> None:
    misalignments = (0.0, 0.02, 0.05, 0.1, 0.2)
    curve = [thrust(pahl_coupling(delta, speed=speed, axial_velocity=1e-3)).force for delta in misalignments]
    assert curve == sorted(curve, reverse=True)
    family = [thrust(pahl_coupling(0.1, speed=speed, axial_velocity=v)).force for v in (0.0, 0.5e-3, 1e-3, 2e-3)]
    assert family == sorted(family)
    torques = [thrust(pahl_coupling(0.1, speed=speed, torque=t, axial_velocity=1e-3)).force for t in (1e3, 3e3, 5e3)]
    assert torques == sorted(torques)


def test_figure_14c_thrust_vanishes_once_only_fast_sliding_teeth_carry() -> None:
    result = thrust(pahl_coupling(0.5, axial_velocity=CREEP))
    assert result.force == pytest.approx(0.0, abs=1e-9)
    assert result.uniform_load_force == pytest.approx(76.6, abs=0.05)


def test_curve_1_is_zero_without_axial_velocity() -> None:
    # Exactly: 52 and 51 teeth used to leave -6.8e-14 N and a millionth of the limit.
    for misalignment in (0.01, 0.1, 0.5):
        for teeth in (51, 52):
            assert thrust(pahl_coupling(misalignment, teeth=teeth)).force == 0.0


def test_uniform_closed_form() -> None:
    sliding = radians(0.05) * 200.0 * PITCH_RADIUS
    result = thrust(pahl_coupling(0.05, axial_velocity=CREEP))
    assert result.uniform_load_force == pytest.approx(result.coaxial_limit * 2 / pi * asin(CREEP / sliding), rel=1e-12)


def test_breakaway_takes_static_friction() -> None:
    inputs = pahl_coupling(0.0, axial_velocity=CREEP)
    inputs = replace(inputs, friction=replace(inputs.friction, static_coefficient=0.3))
    assert thrust(inputs).breakaway_force == pytest.approx(0.3 * 3000 / (PITCH_RADIUS * cos(radians(20))), rel=1e-12)


@pytest.mark.parametrize(("friction", "static"), [(None, 0.16), (0.2, 0.2)])
def test_breakaway_from_rest_knows_no_film(friction: float | None, static: float) -> None:
    # The running coefficient of this good film is 0.0084: breakaway came out as 344 N.
    result = thrust(pahl_coupling(0.1, crowning_ratio=11.0, friction=friction))
    assert result.breakaway_force == pytest.approx(static * 3000 / (PITCH_RADIUS * cos(radians(20))), rel=1e-12)
    if friction is None:
        assert result.breakaway_force == pytest.approx(6550.0, abs=2.0)
        assert result.coaxial_limit == pytest.approx(344.0, abs=0.5)


@pytest.mark.parametrize(("distance", "force"), [(0.1, 723.5), (0.2, 361.7), (0.4, 180.9)])
def test_figure_13_the_ratio_of_diameter_to_hub_distance_matters(distance: float, force: float) -> None:
    assert parallel_offset(0.1, hub_distance=distance) == pytest.approx(force, rel=5e-3)


def test_figure_13_simple_uniform_and_full_models() -> None:
    induced = thrust(pahl_coupling(0.1, arrangement="parallel_offset")).self_induced
    assert induced.simple_model_force == pytest.approx(1277.0, rel=1e-3)
    assert induced.uniform_load_force == pytest.approx(354.0, rel=1e-3)
    assert induced.force == pytest.approx(361.7, rel=1e-2)
    assert parallel_offset(1.0) == pytest.approx(444.0, rel=1e-2)


def test_figure_13_overturning_moment_of_equally_loaded_teeth() -> None:
    induced = thrust(pahl_coupling(0.001, arrangement="parallel_offset")).self_induced
    assert induced.overturning_moment == pytest.approx(4 / pi * 0.2 * 3000 / cos(radians(20)), rel=1e-3)


@pytest.mark.parametrize("misalignment", [0.05, 0.3, 1.0])
def test_angular_arrangement_has_no_thrust(misalignment: float) -> None:
    force = thrust(pahl_coupling(misalignment, arrangement="angular")).force
    assert abs(force) < 1e-6 * 3000.0 / PITCH_RADIUS


@pytest.mark.parametrize(("velocity", "force"), [(CREEP, 1105.0), (-CREEP, -408.0)])
def test_both_conditions_at_the_same_time(velocity: float, force: float) -> None:
    result = thrust(pahl_coupling(0.05, axial_velocity=velocity, arrangement="parallel_offset"))
    assert result.force == pytest.approx(force, rel=1e-2)
    assert result.self_induced.force == pytest.approx(parallel_offset(0.05), rel=1e-12)


def test_angular_arrangement_under_axial_velocity_is_one_mesh_alone() -> None:
    force = thrust(pahl_coupling(0.05, axial_velocity=CREEP, arrangement="angular")).force
    assert force == pytest.approx(756.5, rel=1e-2)
    assert force == pytest.approx(thrust(pahl_coupling(0.05, axial_velocity=CREEP)).force, rel=1e-9)


# References are printed to the newton: half of one is their own rounding.
@pytest.mark.parametrize(
    ("model", "ratio", "misalignment", "force"),
    [
        ("tangential", 1.0, 0.1, 361.7),
        ("tangential", 1.0, 1.0, 446.0),
        ("tangential", 11.0, 0.1, 435.0),
        ("tangential", 11.0, 0.2, 454.0),
        ("spatial", 1.0, 0.1, 361.7),
        ("spatial", 1.0, 1.0, 225.0),
        ("spatial", 11.0, 0.1, 425.0),
        ("spatial", 11.0, 0.2, 18.0),
    ],
)
def test_self_induced_thrust_of_both_kinematic_models(
    model: KinematicModel, ratio: float, misalignment: float, force: float
) -> None:
    computed = parallel_offset(misalignment, crowning_ratio=ratio, model=ModelOptions(kinematics=model))
    assert computed == pytest.approx(force, rel=2e-2, abs=0.5)


@pytest.mark.parametrize(
    ("ratio", "misalignment", "force"),
    [(1.0, 0.1, 14.6), (1.0, 0.3, 131.0), (1.0, 1.0, 223.0), (11.0, 0.1, 306.0), (11.0, 0.2, 435.0)],
)
def test_spatial_kinematics_leave_thrust_in_the_angular_arrangement(
    ratio: float, misalignment: float, force: float
) -> None:
    options = ModelOptions(kinematics="spatial")
    inputs = pahl_coupling(misalignment, arrangement="angular", crowning_ratio=ratio, model=options)
    assert thrust(inputs).force == pytest.approx(force, rel=1e-2)


@pytest.mark.parametrize(("speed", "misalignment"), [(-200.0, 0.1), (200.0, -0.1), (-200.0, -0.1)])
def test_self_induced_thrust_pulls_together_whatever_the_signs(speed: float, misalignment: float) -> None:
    force = parallel_offset(misalignment, speed=speed)
    assert force > 0.0
    assert force == pytest.approx(parallel_offset(0.1), rel=1e-9)


def test_contact_shift_moment_in_space() -> None:
    inputs = pahl_coupling(0.1, model=ModelOptions(kinematics="spatial"))
    assert solve(inputs).losses.contact_shift_moment == pytest.approx(7.445, abs=5e-4)


@pytest.mark.parametrize(
    ("low", "high", "ratio", "capacity"), [(0.05, 0.1, 17.2, 1.347), (0.1, 0.3, 6.97, 0.46), (0.1, 0.5, 4.75, 0.26)]
)
def test_conclusion_crowning_that_suits_a_range_of_misalignment(
    low: float, high: float, ratio: float, capacity: float
) -> None:
    design = pahl_coupling(0.1, friction=None)
    recommendation = recommend(RecommendationInputs(design, radians(low), radians(high)))
    assert recommendation.crowning_ratio == pytest.approx(ratio, rel=2e-2)
    assert recommendation.min_load_capacity_coefficient == pytest.approx(capacity, rel=2e-2)
    assert recommendation.at_min.contact_overlap < 1.0


def test_conclusion_the_window_can_be_a_percent_wide() -> None:
    inputs = RecommendationInputs(pahl_coupling(0.1, friction=None), radians(0.05), radians(0.2))
    recommendation = recommend(inputs)
    assert 11.29 < recommendation.crowning_ratio < 11.48
    assert recommendation.min_load_capacity_coefficient == pytest.approx(0.607, rel=2e-2)
    assert not any(recommendation.scan.feasible)


def test_conclusion_medium_misalignment_gives_low_friction_and_small_thrust() -> None:
    recommendation = recommend(
        RecommendationInputs(pahl_coupling(0.1, friction=None, axial_velocity=1e-3), radians(0.05), radians(0.1))
    )
    for point in (recommendation.at_min, recommendation.at_max):
        assert point.friction_coefficient < 0.01
        assert abs(point.axial_thrust) < 0.01 * 3000.0 / PITCH_RADIUS
