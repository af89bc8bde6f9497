"""Some changes of the inputs must not change the answer, and other changes must only scale the answer."""

from math import pi, tan

import numpy as np
import pytest
from hypothesis import assume
from hypothesis import strategies as st

from benchmarks.published.pahl import PITCH_RADIUS, TEETH, pahl_coupling
from solvers.coupling.inputs import CouplingInputs, ModelOptions
from solvers.coupling.model import solve
from tests.support.changes import changed, scaled
from tests.support.couplings import random_pitch_errors
from tests.support.plain_coupling import PlainMesh, midpoints
from tests.support.properties import examples

misalignments = st.floats(0.01, 1.0)
kinematics = st.sampled_from(["tangential", "spatial"])
sleeves = st.sampled_from(["centred", "floating"])


@st.composite
def couplings(draw: st.DrawFn) -> CouplingInputs:
    seed = draw(st.none() | st.integers(0, 50))
    return pahl_coupling(
        draw(misalignments),
        torque=draw(st.floats(500.0, 5000.0)),
        speed=draw(st.floats(-400.0, 400.0).filter(lambda speed: abs(speed) > 1.0)),
        axial_velocity=draw(st.sampled_from([0.0, 1e-3, -3e-3])),
        model=ModelOptions(kinematics=draw(kinematics), sleeve=draw(sleeves)),
        pitch_errors=None if seed is None else random_pitch_errors(seed),
    )


@examples(30, 300, couplings(), st.floats(0.2, 3.0))
def test_torque_and_stiffness_scale_forces_and_nothing_else(inputs: CouplingInputs, factor: float) -> None:
    before, after = solve(inputs), solve(scaled(inputs, factor, "coupling.tooth_stiffness", "operation.torque"))
    one, other = before.load_distribution, after.load_distribution
    assert other.rotation == pytest.approx(one.rotation, rel=1e-9)
    assert other.loaded_teeth == one.loaded_teeth
    assert other.max_tangential_force == pytest.approx(factor * one.max_tangential_force, rel=1e-7)
    thrust, small = after.axial_thrust, 1e-6 * after.axial_thrust.coaxial_limit
    assert thrust.force == pytest.approx(factor * before.axial_thrust.force, rel=1e-6, abs=small)
    assert after.losses.friction_power == pytest.approx(factor * before.losses.friction_power, rel=1e-7)


@examples(30, 300, couplings())
def test_sign_of_misalignment_does_not_matter_to_magnitudes(inputs: CouplingInputs) -> None:
    # With pitch deviations the mirror image is the same coupling seen half a turn later: means over a revolution agree.
    before, after = solve(inputs), solve(scaled(inputs, -1.0, "operation.misalignment"))
    assert after.lubrication.max_normal_force == pytest.approx(before.lubrication.max_normal_force, rel=1e-7)
    limit = before.axial_thrust.coaxial_limit
    assert after.axial_thrust.force == pytest.approx(before.axial_thrust.force, abs=1e-6 * limit)
    assert after.losses.friction_moment == pytest.approx(before.losses.friction_moment, rel=1e-6)
    assert after.losses.hub_bending_moment == pytest.approx(before.losses.hub_bending_moment, rel=1e-6)


@examples(30, 300, couplings())
def test_sense_of_rotation_does_not_matter_to_magnitudes(inputs: CouplingInputs) -> None:
    before, after = solve(inputs), solve(scaled(inputs, -1.0, "operation.speed"))
    capacity = before.lubrication.load_capacity_coefficient
    assert after.lubrication.load_capacity_coefficient == pytest.approx(capacity, rel=1e-7)
    assert after.losses.hub_bending_moment == pytest.approx(before.losses.hub_bending_moment, rel=1e-9)
    limit = before.axial_thrust.coaxial_limit
    assert after.axial_thrust.force == pytest.approx(before.axial_thrust.force, abs=1e-6 * limit)


@examples(30, 300, couplings())
def test_thrust_moment_and_power_are_those_of_the_teeth_one_by_one(inputs: CouplingInputs) -> None:
    centred = changed(inputs, {"model.sleeve": "centred"})
    turns = 1 if inputs.coupling.pitch_errors is None else TEETH
    force, moment, power = PlainMesh(centred).friction(midpoints(400 * turns, 2 * pi * turns / TEETH), 0.2)
    result = solve(centred)
    missed = 2 * 0.2 * result.lubrication.max_normal_force / 400  # jumps of friction within a step of the rotor
    assert result.axial_thrust.force == pytest.approx(force, abs=missed)
    assert result.losses.friction_moment == pytest.approx(moment, abs=missed * PITCH_RADIUS)
    assert result.losses.friction_power == pytest.approx(power, rel=1e-4)


@examples(30, 300, couplings())
def test_thrust_turns_with_the_axial_velocity(inputs: CouplingInputs) -> None:
    before, after = solve(inputs), solve(scaled(inputs, -1.0, "operation.axial_velocity"))
    limit = before.axial_thrust.coaxial_limit
    assert after.axial_thrust.force == pytest.approx(-before.axial_thrust.force, abs=1e-6 * limit)


@examples(30, 300, couplings(), st.floats(-2e-5, 2e-5))
def test_the_same_pitch_error_on_every_tooth_only_turns_the_hub(inputs: CouplingInputs, shift: float) -> None:
    errors = inputs.coupling.pitch_errors
    assume(errors is not None)
    shifted = changed(inputs, {"coupling.pitch_errors": tuple(error + shift for error in errors)})
    before, after = solve(inputs).load_distribution, solve(shifted).load_distribution
    assert after.rotation == pytest.approx(before.rotation - shift, abs=1e-12)
    assert after.curves.tangential_force == pytest.approx(before.curves.tangential_force, abs=1e-4)


@examples(30, 300, couplings(), st.floats(0.0, 6.0))
def test_moving_all_pitch_errors_by_one_tooth_is_turning_the_rotor(inputs: CouplingInputs, angle: float) -> None:
    errors = inputs.coupling.pitch_errors
    assume(errors is not None)
    assert errors is not None
    moved = changed(inputs, {"coupling.pitch_errors": (errors[-1], *errors[:-1]), "model.rotor_angle": angle})
    turned = changed(inputs, {"model.rotor_angle": angle + 2 * pi / TEETH})
    before, after = solve(turned).load_distribution, solve(moved).load_distribution
    assert after.curves.tangential_force[1:] == pytest.approx(before.curves.tangential_force[:-1], abs=1e-4)
    assert after.sleeve_displacement == pytest.approx(before.sleeve_displacement, abs=1e-12)


@examples(30, 300, couplings(), st.sampled_from([1, 2, 5]))
def test_turning_by_a_pitch_changes_nothing_without_pitch_errors(inputs: CouplingInputs, pitches: int) -> None:
    perfect = changed(inputs, {"coupling.pitch_errors": None})
    turned = changed(perfect, {"model.rotor_angle": 2 * pi * pitches / TEETH})
    before, after = solve(perfect).load_distribution, solve(turned).load_distribution
    assert after.max_tangential_force == pytest.approx(before.max_tangential_force, rel=1e-9)
    assert after.rotation == pytest.approx(before.rotation, rel=1e-9)


@examples(30, 300, couplings(), st.floats(0.3, 3.0))
def test_similar_couplings_behave_alike(inputs: CouplingInputs, scale: float) -> None:
    # All lengths x k, stiffness x k (E l), torque x k^3: the same strains and stresses, forces x k^2.
    lengths = ("module", "face_width", "tooth_height", "hub_distance", "tooth_stiffness")
    similar = scaled(inputs, scale, *(f"coupling.{name}" for name in lengths), "operation.axial_velocity")
    similar = scaled(similar, scale**3, "operation.torque")
    errors = inputs.coupling.pitch_errors
    if errors is not None:
        similar = changed(similar, {"coupling.pitch_errors": tuple(scale * error for error in errors)})
    before, after = solve(inputs), solve(similar)
    assert after.lubrication.hertz_pressure == pytest.approx(before.lubrication.hertz_pressure, rel=1e-7)
    assert after.lubrication.contact_overlap == pytest.approx(before.lubrication.contact_overlap, rel=1e-7)
    assert after.load_distribution.rotation == pytest.approx(scale * before.load_distribution.rotation, rel=1e-7)
    assert after.axial_thrust.fraction_of_limit == pytest.approx(before.axial_thrust.fraction_of_limit, abs=1e-6)


@examples(30, 300, st.integers(8, 100), misalignments)
def test_a_soft_ring_of_any_number_of_teeth_shares_by_closed_form(teeth: int, delta: float) -> None:
    # All teeth carry: mean T/(r_o z), and c_t r_o delta^2/(2 tan alpha) (sin^2 phi - 1/2) beside it.
    inputs = pahl_coupling(delta, teeth=teeth, module=2 * PITCH_RADIUS / teeth, tooth_stiffness=1e5, tooth_height=0.05)
    load = solve(inputs).load_distribution
    mean = 3000 / (PITCH_RADIUS * teeth)
    spread = 1e5 * PITCH_RADIUS * inputs.operation.misalignment**2 / (2 * tan(inputs.coupling.pressure_angle))
    sine = np.sin(2 * pi / teeth * np.arange(teeth))
    assert load.loaded_teeth == teeth
    assert load.curves.tangential_force == pytest.approx(mean + spread * (sine**2 - 0.5), rel=1e-9)
    assert load.load_concentration == pytest.approx(1 + spread / mean * ((sine**2).max() - 0.5), rel=1e-9)


@examples(15, 100, couplings())
def test_contact_shift_moment_is_the_derivative_of_the_tooth_energy(inputs: CouplingInputs) -> None:
    # Virtual work: at constant torque the tilting moment is dU/d delta, with c_t u^2/2 summed and -T psi/r_o.
    perfect = changed(inputs, {"coupling.pitch_errors": None, "model.sleeve": "centred", "model.rotor_angle": 0.0})

    def potential(factor: float) -> float:
        total = 0.0
        for angle in midpoints(24, 2 * pi / TEETH):
            at = scaled(changed(perfect, {"model.rotor_angle": angle}), factor, "operation.misalignment")
            load = solve(at).load_distribution
            energy = (load.curves.tangential_force**2).sum() / (2 * at.coupling.tooth_stiffness)
            total += energy - at.operation.torque / PITCH_RADIUS * load.rotation
        return total / 24

    step = 1e-4
    slope = (potential(1 + step) - potential(1 - step)) / (2 * step * perfect.operation.misalignment)
    assert solve(perfect).losses.contact_shift_moment == pytest.approx(abs(slope), rel=1e-3, abs=1e-3)
