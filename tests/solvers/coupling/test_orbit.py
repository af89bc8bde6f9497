"""The orbit of the floating sleeve obeys its equation of motion and states its uncertainty, or is refused."""

from typing import Any

import numpy as np
import pytest
from hypothesis import strategies as st

from benchmarks.published.pahl import harmonic_pitch_errors, pahl_coupling
from solvers.coupling import kinematics, orbit
from solvers.coupling.inputs import CouplingInputs
from solvers.coupling.model import solve
from solvers.coupling.orbit import solve_orbit
from solvers.coupling.tooth_loads import ToothLoads, floating_loads
from tests.support.changes import changed
from tests.support.coupling_checks import check_orbit_resolution_of
from tests.support.couplings import floating, random_pitch_errors
from tests.support.outcomes import refused, unsolved
from tests.support.properties import examples, first
from tests.support.stored import stored

ERRORS = harmonic_pitch_errors((1, 2e-6, 0.0), (3, 2e-6, 0.7))


def test_orbit_obeys_newtons_law() -> None:
    inputs = pahl_coupling(0.5, speed=1000.0, pitch_errors=ERRORS)
    result = solve_orbit(inputs)
    force = np.stack((result.inertia_force.x, result.inertia_force.y), axis=1)
    loads, lateral = floating(inputs, result.orbit.rotor_angle, force)
    assert lateral == pytest.approx(-force, abs=1e-4)
    # The path the teeth give is the path whose second derivative is the force: orders up to 12 of m omega^2 k^2 c_k.
    spectrum = np.fft.rfft(loads.displacement, axis=0)[:13] / len(loads.displacement)
    expected = 4.0 * 1000.0**2 * np.arange(13)[:, None] ** 2 * spectrum
    assert np.fft.rfft(force, axis=0)[:13] / len(force) == pytest.approx(expected, abs=1e-3)


def test_harmonics_are_amplitudes() -> None:
    result = solve_orbit(pahl_coupling(0.5, speed=1000.0, pitch_errors=ERRORS))
    angle, force = result.orbit.rotor_angle, result.inertia_force
    for order in (1, 3, 5):
        cosine, sine = (2 * np.mean(force.y * wave(order * angle)) for wave in (np.cos, np.sin))
        assert force.harmonics_y[order] == pytest.approx(np.hypot(cosine, sine), rel=1e-12)
    assert force.harmonics_x[0] == pytest.approx(abs(np.mean(force.x)), abs=1e-12)
    assert len(force.harmonics_x) == len(force.harmonics_y) == 13


@pytest.mark.parametrize("misalignment", [0.1, 1.0])
def test_perfect_teeth_leave_the_sleeve_centred(misalignment: float) -> None:
    result = solve_orbit(pahl_coupling(misalignment, speed=1000.0))
    assert result.max_displacement < 1e-12


def test_slow_orbit_is_the_static_place_of_the_sleeve() -> None:
    inputs = pahl_coupling(0.3, speed=1e-3, pitch_errors=ERRORS)
    result = solve_orbit(inputs)
    assert result.sweeps == 2
    quarter = len(result.orbit.rotor_angle) // 4
    turned = changed(inputs, {"model.sleeve": "floating", "model.rotor_angle": result.orbit.rotor_angle[quarter]})
    place = solve(turned).load_distribution.sleeve_displacement
    assert (result.orbit.x[quarter], result.orbit.y[quarter]) == pytest.approx(place, abs=1e-13)
    sampled = np.hypot(result.orbit.x, result.orbit.y).max()
    assert sampled <= result.max_displacement < sampled * (1.0 + 1e-4)
    loads, _ = floating(inputs, np.linspace(0.0, 2.0 * np.pi, 3328, endpoint=False), (0.0, 0.0))
    assert result.max_displacement == pytest.approx(np.hypot(*loads.displacement.T).max(), rel=1e-6)


def test_the_farthest_place_is_found_between_the_positions_of_an_orbit() -> None:
    inputs = pahl_coupling(0.5, speed=1000.0, pitch_errors=ERRORS)
    result = solve_orbit(inputs)
    fine = 16 * len(result.orbit.rotor_angle)
    force = 16 * np.fft.irfft(np.fft.rfft([result.inertia_force.x, result.inertia_force.y]), n=fine).T
    place = floating(inputs, 2 * np.pi / fine * np.arange(fine), force)[0].displacement
    assert result.max_displacement == pytest.approx(np.hypot(*place.T).max(), rel=1e-5)


# Above 1000 rad/s and near one degree the twelfth order nears its resonance with the few loaded teeth.
@examples(40, 400, st.floats(0.0, 1.0), st.floats(1.0, 1000.0), st.integers(0, 1000))
def test_orbit_converges_within_the_sweeps_of_ordinary_couplings(misalignment: float, speed: float, seed: int) -> None:
    result = solve_orbit(pahl_coupling(misalignment, speed=speed, pitch_errors=random_pitch_errors(seed)))
    assert result.change < 1e-12
    assert result.sweeps <= 50


def test_force_grows_with_the_square_of_speed_while_small() -> None:
    slow, fast = (solve_orbit(pahl_coupling(0.1, speed=speed, pitch_errors=ERRORS)) for speed in (10.0, 20.0))
    assert fast.inertia_force.harmonics_y[1] == pytest.approx(4 * slow.inertia_force.harmonics_y[1], rel=1e-5)


@pytest.mark.parametrize("torque", [0.0, 1.0])
def test_low_torque_cannot_centre_the_sleeve(torque: float) -> None:
    inputs = pahl_coupling(0.1, torque=torque, speed=2000.0, pitch_errors=ERRORS)
    assert refused(solve_orbit, inputs) == ("torque_too_low", "torque")


def test_inertia_beyond_the_mesh_stiffness_has_no_solution() -> None:
    inputs = pahl_coupling(0.1, speed=20000.0, torque=1e6, tooth_height=1.0, pitch_errors=ERRORS)
    failure = unsolved(solve_orbit, inputs)
    assert failure.code == "sleeve_orbit"
    assert failure.residuals["change"] > 1e-12
    assert failure.residuals["sweeps"] == 50.0


def test_an_orbit_with_a_position_left_without_balance_is_no_solution(monkeypatch: pytest.MonkeyPatch) -> None:
    def one_unbalanced(*arguments: Any) -> ToothLoads:
        loads = floating_loads(*arguments)
        loads.iterations[7] = -1
        return loads

    monkeypatch.setattr(orbit, "floating_loads", one_unbalanced)
    assert unsolved(solve_orbit, pahl_coupling(0.3, speed=100.0, pitch_errors=ERRORS)).code == "sleeve_orbit"


@pytest.mark.parametrize(("teeth", "positions"), first(2, [(6, 210), (53, 212), (52, 208), (208, 208), (400, 400)]))
def test_an_orbit_takes_about_as_many_positions_whatever_the_teeth(teeth: int, positions: int) -> None:
    result = solve_orbit(pahl_coupling(0.1, speed=100.0, teeth=teeth, module=0.156 / teeth))
    assert len(result.orbit.rotor_angle) == positions


@pytest.mark.parametrize("misalignment", [0.1, 0.3, 0.5])
def test_an_orbit_states_how_certain_it_is(misalignment: float, monkeypatch: pytest.MonkeyPatch) -> None:
    inputs = pahl_coupling(misalignment, speed=1000.0, pitch_errors=ERRORS)
    result = solve_orbit(inputs)
    assert result.warnings == ()
    monkeypatch.setattr(orbit, "HIGHEST_ORDER", 2 * orbit.HIGHEST_ORDER)
    moved, changes = [], []
    for refinement in orbit.REFINEMENTS:
        monkeypatch.setattr(kinematics, "_LEAST_ROTOR_POSITIONS", refinement * 208)
        finer = solve_orbit(inputs)
        moved.append(abs(finer.max_displacement - result.max_displacement))
        changes += [
            np.abs(getattr(finer.inertia_force, axis)[:13] - getattr(result.inertia_force, axis)).max()
            for axis in ("harmonics_x", "harmonics_y")
        ]
    assert max(changes) == pytest.approx(result.harmonics_uncertainty, abs=1e-6)
    assert max(moved) == pytest.approx(result.displacement_uncertainty, abs=1e-12)


def test_an_orbit_that_happens_to_agree_with_twice_its_angles_is_not_called_certain() -> None:
    """With four rotor angles per pitch, the orbit has an error of 1.2 %."""
    # A comparison with eight angles per pitch shows 0.9 %, and a comparison with twelve angles shows 1.5 %.
    cases = stored(CouplingInputs, "coupling", "orbit that agrees with twice its angles by luck")
    assert [notice.code for notice in solve_orbit(cases[0]).warnings] == ["orbit_resolution"]
    for inputs in cases:
        check_orbit_resolution_of(inputs)


def test_an_orbit_that_twice_the_orders_unsettle_says_so() -> None:
    result = solve_orbit(pahl_coupling(1.0, speed=1000.0, pitch_errors=ERRORS))
    assert (result.displacement_uncertainty, result.harmonics_uncertainty) == (None, None)
    assert [(notice.code, notice.field) for notice in result.warnings] == [("orbit_resolution", "speed")]


def test_a_sleeve_that_moves_between_few_teeth_has_an_uncertain_orbit() -> None:
    errors = random_pitch_errors(1)
    result = solve_orbit(pahl_coupling(3.0, torque=100.0, speed=5.0, pitch_errors=errors))
    (notice,) = result.warnings
    assert (notice.code, notice.field) == ("orbit_resolution", "misalignment")
    largest = max(result.inertia_force.harmonics_x.max(), result.inertia_force.harmonics_y.max())
    share = 100 * result.harmonics_uncertainty / largest
    assert notice.message.endswith(f"largest harmonic of the force is therefore uncertain by {share:.2g} %")


def test_an_orbit_on_two_teeth_has_no_place_of_its_own() -> None:
    result = solve_orbit(pahl_coupling(2.0, teeth=6, module=26e-3, torque=10.0, speed=1.0))
    assert [notice.code for notice in result.warnings] == ["sleeve_position"]
