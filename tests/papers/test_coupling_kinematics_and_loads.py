"""Pahl, "The operating characteristics of gear-type couplings": kinematics and load distribution, Figs 2 to 6.

Numbers without a source in the paper are those of an independent calculation of the same statement.
"""

from math import atan2, cos, degrees, pi, radians, sin, sqrt, tan

import numpy as np
import pytest

from solvers.coupling.inputs import KinematicModel, ModelOptions, SleeveSupport
from solvers.coupling.kinematics import displacement_peak, mesh_motion, tooth_geometry, tooth_positions
from solvers.coupling.lubrication import max_normal_force
from solvers.coupling.model import solve
from solvers.coupling.orbit import solve_orbit
from solvers.coupling.results import KinematicCurves, OrbitResult
from solvers.coupling.tooth_loads import centred_loads
from solvers.published.pahl import PITCH_RADIUS, TEETH, harmonic_pitch_errors, pahl_coupling
from tests.support.couplings import random_pitch_errors

ALPHA = radians(20.0)
SPATIAL = ModelOptions(kinematics="spatial")
QUARTER = 45  # index of 90 degrees in the curves over a revolution


def curves(model: KinematicModel = "tangential", **coupling: float) -> KinematicCurves:
    return solve(pahl_coupling(0.5, model=ModelOptions(kinematics=model), **coupling)).kinematics.curves


def peak_angle(values: np.ndarray) -> float:
    """Angle [rad] of the largest value of a curve over half a revolution, by a parabola through three points."""
    half = values[: 2 * QUARTER]
    top = int(np.argmax(half))
    before, at, after = half[top - 1], half[top], half[top + 1]
    return (top + (before - after) / (2.0 * (before - 2.0 * at + after))) * pi / (2 * QUARTER)


@pytest.mark.parametrize("model", ["tangential", "spatial"])
def test_figure_2_tilt_and_pivot_alternate_every_quarter_turn(model: KinematicModel) -> None:
    motion = curves(model)
    sliding = motion.sliding_velocity
    largest = radians(0.5) * 200.0 * PITCH_RADIUS
    assert motion.angle[QUARTER] == pytest.approx(pi / 2, rel=1e-15)
    assert sliding[[0, 2 * QUARTER]] == pytest.approx(0.0, abs=1e-15)
    assert sliding[[QUARTER, 3 * QUARTER]] == pytest.approx([largest, -largest], rel=1e-15)
    if model == "tangential":
        displacement = motion.tangential_displacement
        assert displacement[[0, 2 * QUARTER]] == pytest.approx(0.0, abs=1e-20)
        assert displacement[[QUARTER, 3 * QUARTER]] == pytest.approx(displacement.max(), rel=1e-15)


def test_figure_6_reversal_has_largest_sliding_and_displacement_and_small_film_velocity() -> None:
    motion = curves()
    assert np.argmax(np.abs(motion.contact_position)) == QUARTER
    assert np.argmax(motion.sliding_velocity) == QUARTER
    assert np.argmax(motion.tangential_displacement) == QUARTER
    largest = solve(pahl_coupling(0.5)).kinematics.max_hydrodynamic_velocity
    assert motion.hydrodynamic_velocity[QUARTER] / largest == pytest.approx(0.179, abs=5e-4)


def test_figure_6_film_velocity_vanishes_ten_degrees_before_the_reversal() -> None:
    motion = curves()
    vanishes = motion.angle[np.argmin(motion.hydrodynamic_velocity[: QUARTER + 1])]
    assert vanishes == pytest.approx(radians(79.7), abs=radians(1.0))


def test_figure_6_shapes_over_the_contact_position_are_a_straight_v_an_ellipse_and_a_parabola() -> None:
    motion = curves()
    place = motion.contact_position / np.abs(motion.contact_position).max()
    largest_sliding = radians(0.5) * 200 * PITCH_RADIUS
    assert np.abs(motion.sliding_velocity) == pytest.approx(largest_sliding * np.abs(place), abs=1e-15)
    assert motion.tangential_displacement == pytest.approx(motion.tangential_displacement.max() * place**2, abs=1e-18)
    amplitude = 2.0 / tan(ALPHA)
    rolling = amplitude * np.cos(motion.angle)
    ellipse = np.abs(rolling + place) * largest_sliding
    assert motion.hydrodynamic_velocity == pytest.approx(ellipse, rel=1e-12)


@pytest.mark.parametrize("ratio", [0.5, 1.0, 4.0])
def test_spatial_reversal_lies_at_the_pressure_angle_behind_the_tilt_position(ratio: float) -> None:
    motion = curves("spatial", crowning_ratio=ratio)
    # Parabolic interpolation of a sine sampled every 2 degrees is good to 1e-3 degrees.
    assert peak_angle(np.abs(motion.contact_position)) == pytest.approx(pi / 2 + ALPHA, abs=radians(2e-3))


@pytest.mark.parametrize("ratio", [0.5, 1.0, 4.0])
def test_spatial_displacement_peaks_between_tilt_position_and_reversal(ratio: float) -> None:
    shift = atan2(sin(ALPHA) * cos(ALPHA), ratio - sin(ALPHA) ** 2) / 2.0
    motion = curves("spatial", crowning_ratio=ratio)
    assert peak_angle(motion.tangential_displacement) == pytest.approx(pi / 2 + ALPHA - shift, abs=radians(2e-3))


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("ratio", [1.0, 11.0])
def test_normal_force_is_that_of_the_tilt_position(ratio: float, side: int) -> None:
    inputs = pahl_coupling(0.5, crowning_ratio=ratio, model=SPATIAL)
    geometry = tooth_geometry(inputs.coupling)
    mesh = mesh_motion(inputs.coupling, geometry, inputs.operation, "spatial", side=side)
    chi = atan2(2.0 * sin(ALPHA) * cos(ALPHA), 2.0 * (ratio - sin(ALPHA) ** 2)) / 2.0
    assert displacement_peak(mesh) == pytest.approx(pi / 2 + side * (ALPHA - chi), rel=1e-12)

    def largest(angles: list[float]) -> float:
        loads = centred_loads(inputs.coupling, mesh, tooth_positions(np.array(angles), TEETH), inputs.operation.torque)
        return float(loads.tangential_force.max() / cos(ALPHA))

    assert max_normal_force(inputs, mesh) == pytest.approx(largest([pi / 2]), rel=1e-12)
    assert max_normal_force(inputs, mesh) <= largest([displacement_peak(mesh)])


@pytest.mark.parametrize("ratio", [0.5, 1.0, 11.0])
def test_largest_values_of_both_kinematic_models(ratio: float) -> None:
    delta, speed, cot = radians(0.5), 200.0, 1.0 / tan(ALPHA)
    sliding = delta * speed * PITCH_RADIUS
    tangential = solve(pahl_coupling(0.5, torque=100.0, crowning_ratio=ratio)).kinematics
    assert tangential.max_contact_travel == pytest.approx(ratio * PITCH_RADIUS * cot * delta, rel=1e-12)
    assert tangential.max_hydrodynamic_velocity == pytest.approx(sliding * sqrt((2 * ratio * cot) ** 2 + 1), rel=1e-12)
    amplitude = ratio * PITCH_RADIUS * cot * delta**2 / 2
    assert tangential.tangential_displacement_peak_to_peak == pytest.approx(amplitude, rel=1e-12)
    spatial = solve(pahl_coupling(0.5, torque=100.0, crowning_ratio=ratio, model=SPATIAL)).kinematics
    assert spatial.max_contact_travel == pytest.approx(ratio * PITCH_RADIUS / sin(ALPHA) * delta, rel=1e-12)
    velocity = sliding * sqrt((2 * ratio * cot) ** 2 + (2 * ratio - 1) ** 2)
    assert spatial.max_hydrodynamic_velocity == pytest.approx(velocity, rel=1e-12)
    amplitude = (
        PITCH_RADIUS * delta**2 / 2 * sqrt((ratio / sin(ALPHA) - sin(ALPHA)) ** 2 + cos(ALPHA) ** 2) / cos(ALPHA)
    )
    assert spatial.tangential_displacement_peak_to_peak == pytest.approx(amplitude, rel=1e-12)


@pytest.mark.parametrize(
    ("misalignment", "concentration"), [(0.0, 1.0), (0.1, 1.062), (0.2, 1.247), (0.4, 1.989), (1.0, 4.018)]
)
def test_figure_3_load_concentrates_in_the_tilt_zones(misalignment: float, concentration: float) -> None:
    load = solve(pahl_coupling(misalignment)).load_distribution
    assert load.load_concentration == pytest.approx(concentration, rel=5e-3)


@pytest.mark.parametrize(("misalignment", "loaded"), [(0.1, 52), (0.5, 34), (1.0, 22), (2.0, 14)])
def test_figure_3_fewer_teeth_carry_as_misalignment_grows(misalignment: float, loaded: int) -> None:
    load = solve(pahl_coupling(misalignment)).load_distribution
    assert load.loaded_teeth == loaded
    height, force = np.abs(np.sin(load.curves.angle)), load.curves.tangential_force
    assert height[force > 0.0].min() > height[force == 0.0].max(initial=-1.0)


@pytest.mark.parametrize(("ratio", "misalignment_deg"), [(1.0, 0.402), (11.0, 0.121)])
def test_unloading_of_the_pivot_teeth_starts(ratio: float, misalignment_deg: float) -> None:
    load = solve(pahl_coupling(0.05, crowning_ratio=ratio)).load_distribution
    assert degrees(load.unloading_misalignment) == pytest.approx(misalignment_deg, abs=5e-4)


@pytest.mark.parametrize(("sleeve", "example"), [("centred", 2.60), ("floating", 2.65)])
def test_figure_4_pitch_errors_of_the_order_of_the_displacement_disturb_the_load(
    sleeve: SleeveSupport, example: float
) -> None:
    # The largest of 52 normal errors varies from coupling to coupling: the statement is about the typical one, and the
    # example of an independent calculation must be an ordinary member of the sample.
    options = ModelOptions(sleeve=sleeve)
    concentrations = [
        load.load_concentration or 0.0
        for load in (
            solve(pahl_coupling(0.0, pitch_errors=random_pitch_errors(seed), model=options)).load_distribution
            for seed in range(40)
        )
    ]
    lower, median, upper = np.quantile(concentrations, [0.1, 0.5, 0.9])
    assert 2.0 < median < 3.0
    assert lower < example < upper
    assert min(concentrations) > 1.8


FIG_5_ERRORS = harmonic_pitch_errors((1, 2e-6, 0.0), (3, 2e-6, 0.7))


@pytest.fixture(scope="module")
def figure_5() -> dict[float, OrbitResult]:
    return {
        misalignment: solve_orbit(pahl_coupling(misalignment, speed=1000.0, pitch_errors=FIG_5_ERRORS))
        for misalignment in (0.1, 0.3, 0.5, 1.0)
    }


def test_figure_5_inertia_force_is_a_sinusoid_at_small_misalignment(figure_5: dict[float, OrbitResult]) -> None:
    harmonics = figure_5[0.1].inertia_force.harmonics_y
    assert harmonics[3] / harmonics[1] < 1e-3
    assert harmonics[1] == pytest.approx(7.52, rel=2e-3)


@pytest.mark.parametrize(("misalignment", "ratio"), [(0.3, 0.546), (0.5, 5.84), (1.0, 19.4)])
def test_figure_5_threefold_excitation_grows_with_misalignment(
    figure_5: dict[float, OrbitResult], misalignment: float, ratio: float
) -> None:
    harmonics = figure_5[misalignment].inertia_force.harmonics_y
    assert harmonics[3] / harmonics[1] == pytest.approx(ratio, rel=2e-2)


def test_figure_5_only_odd_orders_of_rotation_appear(figure_5: dict[float, OrbitResult]) -> None:
    harmonics = figure_5[1.0].inertia_force.harmonics_y
    assert harmonics[0::2].max() < 1e-6 * harmonics[1]


def test_figure_5_needs_a_third_harmonic_in_the_pitch_errors() -> None:
    errors = harmonic_pitch_errors((1, 2e-6, 0.0))
    harmonics = solve_orbit(pahl_coupling(1.0, speed=1000.0, pitch_errors=errors)).inertia_force.harmonics_y
    assert harmonics[1] == pytest.approx(7.6, rel=1e-2)
    assert harmonics[3] < 0.005


@pytest.mark.parametrize("seed", [1, 2])
def test_figure_5_random_pitch_errors_excite_orders_three_and_five_once_teeth_unload(seed: int) -> None:
    errors = random_pitch_errors(seed)
    small = solve_orbit(pahl_coupling(0.1, speed=1000.0, pitch_errors=errors)).inertia_force.harmonics_y
    large = solve_orbit(pahl_coupling(1.0, speed=1000.0, pitch_errors=errors)).inertia_force.harmonics_y
    assert 0.1 < small[1] < 4.0
    assert 10.0 < large[3] < 60.0
    assert 10.0 < large[5] < 60.0


def test_teeth_of_the_paper() -> None:
    geometry = solve(pahl_coupling(0.1)).geometry
    assert geometry.pitch_radius == pytest.approx(TEETH * 3e-3 / 2, rel=1e-15)
    assert geometry.crowning_radius == pytest.approx(0.078, rel=1e-15)
    assert geometry.tangential_flank_radius == pytest.approx(0.078 / tan(ALPHA), rel=1e-15)
    assert geometry.normal_flank_radius == pytest.approx(0.078 / sin(ALPHA), rel=1e-15)
