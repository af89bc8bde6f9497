"""Tooth loads agree with closed forms, are in equilibrium and minimise the elastic energy."""

from math import cos, pi, radians, sin, sqrt

import numpy as np
import pytest
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.optimize import brentq, minimize

from benchmarks.published.pahl import PITCH_RADIUS, TEETH, harmonic_pitch_errors, pahl_coupling
from solvers.coupling.inputs import Coupling, CouplingInputs, ModelOptions, Operation
from solvers.coupling.model import solve
from solvers.coupling.tooth_loads import ToothLoads, turn_to_torque
from tests.support.changes import changed
from tests.support.couplings import floating, random_pitch_errors, spread
from tests.support.plain_coupling import PlainMesh
from tests.support.properties import examples
from tests.support.stored import stored

COSINE = cos(np.radians(20.0))
STIFFNESS = 2.8e8
FLANK_RADIUS = PITCH_RADIUS / np.tan(np.radians(20.0))
INTERFERENCES = arrays(float, st.integers(1, 80), elements=st.floats(-1e4, 1e4))


@examples(60, 300, INTERFERENCES, st.floats(1e-9, 1e5))
def test_common_rotation_equals_the_sorted_closed_form_from_any_start(interference: np.ndarray, start: float) -> None:
    falling = np.sort(interference)[::-1]
    candidates = (1.0 - np.cumsum(falling)) / np.arange(1, falling.size + 1)
    last = np.flatnonzero(candidates + falling > 0.0).max()
    assert turn_to_torque(interference.copy(), start)[1] == pytest.approx(candidates[last], rel=1e-9, abs=1e-9)


@examples(40, 200, INTERFERENCES)
def test_shares_of_a_centred_sleeve_add_up_to_the_torque(interference: np.ndarray) -> None:
    ahead = interference.copy()
    turn_to_torque(ahead, 1.0)
    assert np.maximum(0.0, ahead).sum() == pytest.approx(1.0, abs=1e-12)


def test_largest_force_while_all_teeth_carry() -> None:
    # F_max = F_m + c_t R_t delta^2/4: exact for a tooth in the tilt position and z a multiple of 4.
    load = solve(pahl_coupling(0.2)).load_distribution
    expected = 3000 / (PITCH_RADIUS * TEETH) + STIFFNESS * FLANK_RADIUS * np.radians(0.2) ** 2 / 4
    assert load.max_tangential_force == pytest.approx(expected, rel=1e-12)
    unloading = sqrt(4 * load.mean_tangential_force / (STIFFNESS * FLANK_RADIUS))
    assert load.unloading_misalignment == pytest.approx(unloading, rel=1e-12)


@pytest.mark.parametrize("misalignment", [0.6, 1.0, 2.0])
def test_many_teeth_approach_the_continuous_half_zone(misalignment: float) -> None:
    teeth, stiffness = 4000, STIFFNESS * TEETH / 4000
    inputs = pahl_coupling(misalignment, teeth=teeth, module=2 * PITCH_RADIUS / teeth, tooth_stiffness=stiffness)
    amplitude = stiffness * FLANK_RADIUS * np.radians(misalignment) ** 2 / 4
    unit = teeth / pi * PITCH_RADIUS * amplitude
    zone = brentq(lambda w: unit * (sin(2 * w) - 2 * w * cos(2 * w)) - 3000, 1e-3, pi / 2)
    load = solve(inputs).load_distribution
    assert load.loaded_teeth == pytest.approx(teeth * 2 * zone / pi, abs=4)
    assert load.max_tangential_force == pytest.approx(2 * amplitude * sin(zone) ** 2, rel=1e-5)


@examples(
    100,
    1000,
    misalignment=st.floats(0.0, 3.0),
    size=st.floats(0.0, 0.9),
    direction=st.floats(0.0, 2 * pi),
    seed=st.integers(0, 100),
    spatial=st.booleans(),
)
def test_floating_sleeve_is_in_equilibrium(
    misalignment: float, size: float, direction: float, seed: int, spatial: bool
) -> None:
    options = ModelOptions(kinematics="spatial" if spatial else "tangential")
    inputs = pahl_coupling(misalignment, pitch_errors=random_pitch_errors(seed), model=options)
    limit = 3000 / (PITCH_RADIUS * COSINE)
    force = (size * limit * cos(direction), size * limit * sin(direction))
    loads, lateral = floating(inputs, 0.3, force)
    assert loads.iterations[0] > 0
    assert loads.tangential_force.min() >= 0.0
    assert loads.tangential_force.sum() * PITCH_RADIUS == pytest.approx(3000.0, rel=1e-9)
    assert lateral[0] == pytest.approx([-force[0], -force[1]], abs=1e-8 * limit)


@pytest.mark.parametrize("direction", np.linspace(0.0, 2 * pi, 7))
@pytest.mark.parametrize("share", [1e-10, 1e-6, 1e-2])
def test_sleeve_on_two_teeth_finds_the_next_one_however_light_the_force(direction: float, share: float) -> None:
    # At little torque two opposite teeth carry and leave one direction free: the third tooth is many steps away.
    inputs = pahl_coupling(2.0, torque=10.0)
    size = share * 10.0 / PITCH_RADIUS
    force = (size * cos(direction), size * sin(direction))
    loads, lateral = floating(inputs, pi / 2, force)
    assert 0 < loads.iterations[0] < 100
    assert lateral[0] == pytest.approx([-force[0], -force[1]], abs=1e-12 * 10.0 / PITCH_RADIUS)


def test_a_sleeve_on_two_of_six_teeth_finds_the_balance_it_has() -> None:
    # No balance was found for this one: two opposite teeth carry, nothing holds the sleeve across them.
    (inputs,) = stored(CouplingInputs, "coupling", "balance on two of six teeth")
    load = solve(inputs).load_distribution
    force = load.curves.tangential_force
    assert load.loaded_teeth == 2
    assert force[[1, 4]] == pytest.approx([inputs.operation.torque / (6 * inputs.coupling.module)] * 2, rel=1e-12)
    assert force[[0, 2, 3, 5]].max() == 0.0


def random_balance(random: np.random.Generator) -> tuple[ToothLoads, np.ndarray, np.ndarray, float]:
    """Return the loads and lateral force of the teeth, the external force and T/r_o of a random valid sleeve."""
    # The inputs reach to the bounds of the API, and some pitch deviations of a coupling are equal.
    teeth = int(random.choice([6, 7, 8, 9, 12, 20, 52, 77, 120, 400]))
    error = float(random.choice([0.0, 1e-9, 1e-7, 1e-6, 5e-6, 1e-4, 1e-2]))
    errors = random.normal(size=teeth)
    coupling = Coupling(
        teeth=teeth,
        module=spread(random, 1e-4, 0.1),
        face_width=0.02,
        tooth_height=0.005,
        pressure_angle=radians(random.uniform(1.0, 44.9)),
        crowning_ratio=spread(random, 0.2, 1000.0),
        tooth_stiffness=spread(random, 1e5, 1e11),
        pitch_errors=tuple(error * (errors if random.random() < 0.8 else np.round(2.0 * errors))),
    )
    torque = spread(random, 1e-6, 1e8) if random.random() < 0.5 else spread(random, 1.0, 1e4)
    tilt = float(random.choice([-1.0, 0.0, 1.0])) * radians(spread(random, 1e-4, 6.0))
    inputs = CouplingInputs(
        coupling,
        Operation(torque, 1.0, misalignment=tilt),
        model=ModelOptions(kinematics=random.choice(["tangential", "spatial"])),
    )
    angles = random.uniform(0.0, 7.0) + np.arange(4) * float(random.choice([0.0, 1e-9, 0.01, pi / teeth, 0.5]))
    unit = torque / (coupling.module * teeth / 2.0)
    # The largest force that the normals of so many teeth hold at every rotor angle, and less.
    size = random.choice([0.0, 0.0, 1e-10, 1e-3, 0.5, 0.999]) * unit / cos(coupling.pressure_angle) * cos(pi / teeth)
    direction = random.uniform(0.0, 7.0, size=4)
    force = size * np.stack((np.cos(direction), np.sin(direction)), axis=1)
    return (*floating(inputs, angles, force), force, unit)


@pytest.mark.parametrize("seed", [0, *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(1, 4))])
def test_every_floating_sleeve_that_can_be_balanced_is(seed: int) -> None:
    """The tooth forces balance the torque and the lateral force within 1e-12 of T/r_o."""
    random = np.random.default_rng(seed)
    for _ in range(1000):
        loads, lateral, force, unit = random_balance(random)
        assert loads.iterations.min() > 0
        assert loads.tangential_force.min() >= 0.0
        assert loads.tangential_force.sum(axis=1) == pytest.approx(unit, rel=1e-12)
        assert lateral == pytest.approx(-force, abs=1e-12 * unit)


def test_floating_rows_end_at_the_first_without_balance() -> None:
    beyond = 1.01 * 3000 / (PITCH_RADIUS * COSINE)
    forces = np.array([[0.0, 0.0], [0.0, 0.0], [beyond, 0.0], [0.0, 0.0]])
    loads, _ = floating(pahl_coupling(0.1), np.array([0.0, 0.1, 0.2, 0.3]), forces)
    assert list(np.sign(loads.iterations)) == [1, 1, -1, 0]
    assert np.isfinite(loads.tangential_force).all()


def test_floating_sleeve_minimises_the_energy() -> None:
    inputs = pahl_coupling(0.7, pitch_errors=random_pitch_errors(7))
    mesh, unit = PlainMesh(inputs), 3000 / (PITCH_RADIUS * STIFFNESS)
    phi = mesh.angles(np.array([0.3]))[0]
    normal, ahead = mesh.normals(phi), mesh.ahead(phi) / unit

    def energy(state: np.ndarray) -> float:
        u = state[0] + ahead - state[1:] @ normal
        return float(0.5 * (np.maximum(u, 0.0) ** 2).sum() - state[0] - 0.2 * state[1] + 0.1 * state[2])

    found = minimize(
        energy, np.zeros(3), method="Nelder-Mead", options={"xatol": 1e-10, "fatol": 1e-14, "maxiter": 5000}
    )
    loads, _ = floating(inputs, 0.3, (0.2 * unit * STIFFNESS, -0.1 * unit * STIFFNESS))
    state = np.array([loads.rotation[0], *loads.displacement[0]]) / unit
    assert energy(state) <= found.fun + 1e-12
    assert state == pytest.approx(found.x, abs=1e-5)


def test_stiffness_of_the_loaded_mesh() -> None:
    result = solve(pahl_coupling(0.0))
    loads, _ = floating(pahl_coupling(0.0), 0.3, (100.0, 0.0))
    lateral, torsional = result.limits.lateral_stiffness, result.limits.torsional_stiffness
    assert loads.displacement[0] == pytest.approx([100.0 / lateral, 0.0], rel=1e-9, abs=1e-18)
    assert lateral == pytest.approx(TEETH * STIFFNESS / (2 * COSINE**2), rel=1e-12)
    assert torsional == pytest.approx(3000.0 / (result.load_distribution.rotation / PITCH_RADIUS), rel=1e-12)


def test_sleeve_weight_is_held_by_loaded_teeth_from_the_centring_torque_on() -> None:
    # Lateral force W with every tooth loaded: the least loaded one is F_m - 2 W cos(alpha)/z = 0 at that torque.
    torque = solve(pahl_coupling(0.0)).limits.sleeve_centring_torque
    weight = 4.0 * 9.80665
    above, _ = floating(pahl_coupling(0.0, torque=1.001 * torque), 0.0, (0.0, -weight))
    below, _ = floating(pahl_coupling(0.0, torque=0.95 * torque), 0.0, (0.0, -weight))
    assert above.tangential_force.min() > 0.0
    assert below.tangential_force.min() == 0.0


def test_two_wave_pitch_errors_are_carried_and_eccentricity_is_floated_away() -> None:
    # An eccentric pitch circle (one wave) is what a floating sleeve follows; two waves it cannot.
    eccentric, oval = harmonic_pitch_errors((1, 2e-6, 0.4)), harmonic_pitch_errors((2, 2e-6, 0.4))
    options = ModelOptions(sleeve="floating")
    floated = solve(pahl_coupling(0.0, pitch_errors=eccentric, model=options)).load_distribution
    assert floated.load_concentration == pytest.approx(1.0, rel=1e-9)
    assert np.hypot(*floated.sleeve_displacement) == pytest.approx(2e-6 * COSINE, rel=1e-9)
    carried = solve(pahl_coupling(0.0, pitch_errors=oval, model=options)).load_distribution
    assert carried.load_concentration > 1.5


def test_the_largest_force_of_spatial_kinematics_lies_past_the_tilt_position() -> None:
    """The displacement is largest at 107.8 degrees, where a tooth carries 3833 N."""
    # If a tooth stands at 90 degrees, the largest tooth force is only 3601 N.
    design = Coupling(teeth=32, module=6e-3, face_width=0.048, tooth_height=0.012, crowning_ratio=4.39)
    operation = Operation(torque=1922.8, speed=200.0, misalignment=radians(0.63))
    spatial = CouplingInputs(design, operation, model=ModelOptions(kinematics="spatial"))
    assert solve(spatial).lubrication.max_normal_force == pytest.approx(3601.0, abs=0.5)

    def largest(angle: float) -> float:
        return float(solve(changed(spatial, {"model.rotor_angle": angle})).load_distribution.max_normal_force)

    assert largest(pi / 2) == pytest.approx(3601.0, abs=0.5)
    assert max(largest(angle) for angle in np.linspace(0.0, 2 * pi / 32, 65)) == pytest.approx(3833.0, rel=1e-3)
    tiny = changed(spatial, {"coupling.pitch_errors": (*((0.0,) * 31), 1e-15)})
    assert solve(tiny).lubrication.max_normal_force == pytest.approx(3833.0, abs=0.5)
