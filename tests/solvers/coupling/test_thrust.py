"""Thrust, sleeve equilibrium, friction power and moments agree with limits, closed forms and independent solutions."""

from math import asin, cos, hypot, pi, radians, sin, sqrt, tan

import numpy as np
import pytest
from hypothesis import strategies as st
from scipy.optimize import root

from benchmarks.published.pahl import PITCH_RADIUS, TEETH, pahl_coupling
from solvers.coupling.inputs import Arrangement, CouplingInputs, KinematicModel, ModelOptions, tilt_of_offset
from solvers.coupling.kinematics import rotor_samples, tooth_geometry
from solvers.coupling.model import solve
from solvers.coupling.results import SelfInducedThrust
from solvers.coupling.sleeve import sleeve_equilibrium, two_meshes
from tests.support.changes import changed
from tests.support.couplings import random_pitch_errors
from tests.support.outcomes import unsolved
from tests.support.plain_coupling import PlainMesh, midpoints
from tests.support.properties import examples, first

ALPHA = radians(20.0)
STIFFNESS = 2.8e8


def six_equations(inputs: CouplingInputs, friction: float, velocity: float, angle: float) -> tuple[float, float]:
    """Return the thrust [N] on the left and on the right shaft at one rotor angle."""
    # A general root finder solves the six equations, with lengths in um.
    right_tilt = 1 if inputs.operation.arrangement == "parallel_offset" else -1
    meshes = PlainMesh(inputs), PlainMesh(inputs, side=-1, tilt=right_tilt)
    phi = meshes[0].angles(np.array([angle]))[0]
    ahead = [mesh.ahead(phi) for mesh in meshes]
    normal = [mesh.normals(phi) for mesh in meshes]
    direction = [np.sign(v + mesh.sliding(phi)) for mesh, v in zip(meshes, (-velocity, velocity), strict=True)]

    def forces(x: np.ndarray) -> list[np.ndarray]:
        states = 1e-6 * x.reshape(2, 3)
        return [STIFFNESS * np.maximum(0.0, states[i, 0] + ahead[i] - states[i, 1:] @ normal[i]) for i in range(2)]

    def residuals(x: np.ndarray) -> np.ndarray:
        tangential = forces(x)
        lateral = [normal[i] @ tangential[i] for i in range(2)]
        axial = [friction / cos(ALPHA) * tangential[i] * direction[i] for i in range(2)]
        moment_x = PITCH_RADIUS * sum((force * np.sin(phi)).sum() for force in axial)
        moment_y = -PITCH_RADIUS * sum((force * np.cos(phi)).sum() for force in axial)
        half = inputs.coupling.hub_distance / 2
        return np.array(
            [
                PITCH_RADIUS * tangential[0].sum() - inputs.operation.torque,
                PITCH_RADIUS * tangential[1].sum() - inputs.operation.torque,
                *(lateral[0] + lateral[1]),
                moment_x + half * (lateral[0][1] - lateral[1][1]),
                moment_y + half * (lateral[1][0] - lateral[0][0]),
            ]
        )

    guess = np.zeros((2, 3))
    guess[:, 0] = 1e6 * inputs.operation.torque / (PITCH_RADIUS * STIFFNESS * TEETH)
    found = root(residuals, guess.ravel(), tol=1e-12)
    assert np.abs(found.fun).max() < 1e-5
    tangential = forces(found.x)
    left, right = (friction / cos(ALPHA) * float(tangential[i] @ direction[i]) for i in range(2))
    return -left, right


@pytest.mark.parametrize("arrangement", ["parallel_offset", "angular"])
@pytest.mark.parametrize("model", ["tangential", "spatial"])
@pytest.mark.parametrize(("misalignment", "velocity"), [(0.05, 2e-3), (0.1, 0.0), (0.3, -1e-3)])
def test_sleeve_equilibrium_solves_the_six_equations(
    arrangement: Arrangement, model: KinematicModel, misalignment: float, velocity: float
) -> None:
    inputs = pahl_coupling(misalignment, arrangement=arrangement, model=ModelOptions(kinematics=model))
    geometry = tooth_geometry(inputs.coupling)
    samples = rotor_samples(inputs.coupling, two_meshes(inputs, geometry)[0], velocity)
    angles = np.arctan2(samples.teeth.sine[:, 0], samples.teeth.cosine[:, 0])
    left, right = samples.weight @ [six_equations(inputs, 0.2, velocity, angle) for angle in angles]
    force = sleeve_equilibrium(inputs, geometry, 0.2, velocity).thrust
    assert force == pytest.approx(left, rel=1e-6, abs=1e-4)
    # Without pitch deviations the sleeve is in axial balance by symmetry, though no equation asks for it.
    assert left == pytest.approx(right, rel=1e-6, abs=1e-4)


@pytest.mark.parametrize("kinematics", ["tangential", "spatial"])
@pytest.mark.parametrize("errors", [None, random_pitch_errors(3)])
@pytest.mark.parametrize("misalignment", [0.06, 0.6])
def test_mean_of_one_mesh_agrees_with_many_midpoints(
    misalignment: float, errors: tuple[float, ...] | None, kinematics: KinematicModel
) -> None:
    model = ModelOptions(kinematics=kinematics)
    inputs = pahl_coupling(misalignment, axial_velocity=2e-3, pitch_errors=errors, model=model)
    rotor = midpoints(4000, 2 * pi / TEETH) if errors is None else midpoints(600 * TEETH, 2 * pi)
    force, moment, power = PlainMesh(inputs).friction(rotor, 0.2)
    result = solve(inputs)
    # A midpoint rule misses up to half a step of a jump of 2 mu F_n.
    missed = 0.2 * result.lubrication.max_normal_force / 500
    assert result.axial_thrust.force == pytest.approx(force, abs=missed)
    assert result.losses.friction_moment == pytest.approx(moment, abs=missed * PITCH_RADIUS)
    assert result.losses.friction_power == pytest.approx(power, rel=1e-5)


@pytest.mark.parametrize("teeth", [6, 52, 208, 400])
def test_a_revolution_is_sampled_as_finely_whatever_the_number_of_teeth(teeth: int) -> None:
    inputs = pahl_coupling(0.3, teeth=teeth, module=2 * PITCH_RADIUS / teeth, pitch_errors=(0.0,) * teeth)
    samples = rotor_samples(inputs.coupling, two_meshes(inputs, tooth_geometry(inputs.coupling))[0], 2e-3)
    assert samples.weight.sum() == pytest.approx(1.0, rel=1e-12)
    # At most six reversals of friction a pitch leave seven pieces, each with its share of the 208 angles.
    assert 208 <= samples.weight.size <= 7 * max(212, teeth)


@pytest.mark.parametrize("teeth", first(2, [6, 104, 400]))
def test_mean_over_a_revolution_is_as_good_with_few_and_with_many_teeth(teeth: int) -> None:
    errors = tuple(2e-6 * np.random.default_rng(5).normal(size=teeth))
    module = 2 * PITCH_RADIUS / teeth
    inputs = pahl_coupling(0.06, axial_velocity=2e-3, teeth=teeth, module=module, pitch_errors=errors)
    parts = [PlainMesh(inputs).friction(midpoints(51200, 2 * pi)[part::16], 0.2) for part in range(16)]
    force, _, power = np.mean(parts, axis=0)
    result = solve(inputs)
    assert result.axial_thrust.force == pytest.approx(force, abs=2e-4 * result.axial_thrust.coaxial_limit)
    assert result.losses.friction_power == pytest.approx(power, rel=1e-4)


def test_mean_of_two_meshes_agrees_with_many_midpoints() -> None:
    inputs = pahl_coupling(0.06, axial_velocity=2e-3, arrangement="parallel_offset")
    angles = midpoints(400, 2 * pi / TEETH)
    mean = float(np.mean([six_equations(inputs, 0.2, 2e-3, angle)[0] for angle in angles]))
    assert solve(inputs).axial_thrust.force == pytest.approx(mean, abs=2 * 0.2 * 1000.0 / 400)


def induced_thrust(inputs: CouplingInputs) -> SelfInducedThrust | None:
    return solve(inputs).axial_thrust.self_induced


def test_self_induced_thrust_of_equal_loads() -> None:
    for friction in (0.05, 0.2):
        # Higher orders in mu are below mu^2 (r_o/l_H)^2: 1 % at 0.2.
        induced = induced_thrust(pahl_coupling(1e-3, friction=friction, arrangement="parallel_offset"))
        expected = 16 / pi**2 * friction**2 * 3000 * tan(ALPHA) / 0.2
        assert induced.uniform_load_force == pytest.approx(expected, rel=1e-12)
        assert induced.force == pytest.approx(expected, rel=2e-3)


def test_self_induced_thrust_of_concentrated_loads_tends_to_sin_alpha() -> None:
    # kappa -> sin(alpha) and M_2 -> 2 mu T/cos(alpha) with the load in the tilt zones; soft in misalignment, so 2 %.
    many = {"teeth": 520, "module": 0.3e-3, "tooth_height": 6e-2}
    induced = induced_thrust(pahl_coupling(2.0, arrangement="parallel_offset", friction=0.05, **many))
    assert induced.force == pytest.approx(sin(ALPHA) * 2 * 0.05**2 * 3000 / cos(ALPHA) / 0.2, rel=2e-2)
    assert induced.overturning_moment == pytest.approx(2 * 0.05 * 3000 / cos(ALPHA), rel=2e-2)


def test_closed_forms_of_the_angular_arrangement_are_zero() -> None:
    # One tooth pair a mesh, or equal loads: friction's moments are opposite in both meshes.
    for model in ("tangential", "spatial"):
        options = ModelOptions(kinematics=model)
        induced = induced_thrust(pahl_coupling(0.3, arrangement="angular", model=options))
        assert induced.simple_model_force == induced.uniform_load_force == 0.0
        # The full model agrees in the limit of equal loads.
        limit = induced_thrust(pahl_coupling(1e-3, arrangement="angular", model=options))
        assert limit.force == pytest.approx(0.0, abs=1e-2)
        assert limit.overturning_moment == pytest.approx(0.0, abs=1e-2)


@pytest.mark.parametrize("factor", [0.0, 0.25])
def test_one_pair_model_is_proportional_to_its_factor(factor: float) -> None:
    base, scaled = (
        induced_thrust(
            pahl_coupling(0.1, arrangement="parallel_offset", model=ModelOptions(simple_thrust_factor=share))
        )
        for share in (1.0, factor)
    )
    assert scaled.simple_model_force == pytest.approx(factor * base.simple_model_force, rel=1e-12)
    assert scaled.force == base.force


@pytest.mark.parametrize("arrangement", ["parallel_offset", "angular"])
@pytest.mark.parametrize("sign", [1, -1])
def test_coaxial_shafts_that_separate_are_pulled_with_the_whole_limit(arrangement: Arrangement, sign: int) -> None:
    result = solve(pahl_coupling(0.0, axial_velocity=sign * 1e-3, arrangement=arrangement)).axial_thrust
    assert result.force == pytest.approx(sign * result.coaxial_limit, rel=1e-9)


@examples(
    100,
    1000,
    misalignment=st.floats(1e-3, 3.0),
    velocity=st.floats(-5e-3, 5e-3),
    ratio=st.floats(0.3, 12.0),
    spatial=st.booleans(),
    parallel=st.booleans(),
    seed=st.none() | st.integers(0, 20),
)
def test_thrust_never_exceeds_its_coaxial_limit(
    misalignment: float, velocity: float, ratio: float, spatial: bool, parallel: bool, seed: int | None
) -> None:
    inputs = pahl_coupling(
        misalignment,
        axial_velocity=velocity,
        arrangement="parallel_offset" if parallel else "angular",
        model=ModelOptions(kinematics="spatial" if spatial else "tangential"),
        crowning_ratio=ratio,
        pitch_errors=None if seed is None else random_pitch_errors(seed),
    )
    result = solve(inputs).axial_thrust
    assert abs(result.force) <= result.coaxial_limit * (1 + 1e-9)
    assert result.lower_bound == result.force == result.upper_bound


@pytest.mark.parametrize(
    ("arrangement", "velocity", "static", "expected"),
    [
        ("single", 0.0, None, 8186.0),  # at rest friction may hold the whole limit though it turns without thrust
        ("single", 0.1, 0.1, 8186.0),  # all teeth slide axially: running thrust beyond breakaway
        ("parallel_offset", -0.1, 0.1, 8186.0),
        ("single", 0.1, 0.3, 12279.0),
    ],
)
def test_the_bearing_is_designed_for_the_larger_of_thrust_and_breakaway(
    arrangement: Arrangement, velocity: float, static: float | None, expected: float
) -> None:
    inputs = pahl_coupling(0.1, axial_velocity=velocity, arrangement=arrangement)
    result = solve(changed(inputs, {"friction.static_coefficient": static})).axial_thrust
    assert result.design_force == pytest.approx(expected, abs=0.1)


def test_customary_thrust_needs_a_shaft() -> None:
    inputs = pahl_coupling(0.1)
    assert solve(inputs).axial_thrust.customary_force is None
    shaft = changed(inputs, {"operation.shaft_diameter": 0.1})
    assert solve(shaft).axial_thrust.customary_force == 7500.0  # 0.25 x 3000 N m/0.1 m


def test_parallel_offset_tilts_both_hubs() -> None:
    assert tilt_of_offset(0.35e-3, hub_distance=0.2) == pytest.approx(radians(0.10027), rel=1e-4)
    assert tilt_of_offset(-0.35e-3, 0.2) == -tilt_of_offset(0.35e-3, 0.2)


def test_overturned_sleeve_is_no_solution() -> None:
    inputs = pahl_coupling(0.1, friction=0.4, hub_distance=0.02, arrangement="parallel_offset")
    failure = unsolved(solve, inputs)
    assert failure.code == "sleeve_equilibrium"
    assert all(np.isfinite(value) for value in failure.residuals.values())


# Friction power and moments under axial velocity


LIMIT = 0.2 * 3000.0 / (PITCH_RADIUS * cos(radians(20.0)))
SOFT = 1e4  # tooth stiffness [N/m]: equal loads


def test_axial_motion_faster_than_sliding_takes_all_friction() -> None:
    # Friction points along the shaft at every tooth: no moment against the tilt, and the whole limit times the speed.
    # 7.1 W and 406 N m without the axial velocity.
    losses = solve(pahl_coupling(0.005, axial_velocity=10e-3)).losses
    assert losses.friction_power == pytest.approx(81.9, abs=0.05)
    assert losses.friction_power == pytest.approx(LIMIT * 10e-3, rel=1e-9)
    assert losses.friction_moment == 0.0


@pytest.mark.parametrize("velocity", [0.5e-3, 1e-3, 2e-3, -2e-3])
def test_friction_of_equal_loads_follows_its_closed_form(velocity: float) -> None:
    # M_f = (2/pi) mu T/cos(alpha) sqrt(1 - (v_ax/v_G)^2) and F_ax = F_max (2/pi) asin(v_ax/v_G) with many teeth.
    many = {"tooth_stiffness": SOFT, "teeth": 520, "module": 0.3e-3, "tooth_height": 0.06}
    result = solve(pahl_coupling(0.01, axial_velocity=velocity, **many))
    ratio = velocity / result.kinematics.max_sliding_velocity
    assert abs(ratio) < 1.0
    expected = 2.0 / pi * LIMIT * PITCH_RADIUS * sqrt(1.0 - ratio**2)
    assert result.losses.friction_moment == pytest.approx(expected, rel=1e-4)
    power = expected * radians(0.01) * 200.0 + 2.0 / pi * LIMIT * asin(ratio) * velocity
    assert result.losses.friction_power == pytest.approx(power, rel=1e-4)


@pytest.mark.parametrize(
    ("inputs", "is_open"),
    [
        (pahl_coupling(0.0), True),
        (pahl_coupling(0.3, speed=0.0), True),
        (pahl_coupling(0.0, speed=0.0, arrangement="parallel_offset"), True),
        (pahl_coupling(0.1), False),
        (pahl_coupling(0.0, axial_velocity=1e-3), False),
        (pahl_coupling(0.0, torque=0.0), False),
        (pahl_coupling(0.0, friction=0.0), False),
    ],
)
def test_where_nothing_slides_the_moment_is_open_and_its_bound_is_stated(inputs: CouplingInputs, is_open: bool) -> None:
    result = solve(inputs)
    messages = [notice.message for notice in result.warnings if notice.code == "indeterminate_moment"]
    assert len(messages) == is_open
    if is_open:
        assert result.losses.friction_power == result.losses.friction_moment == 0.0
        assert "406.5 N m" in messages[0]


@pytest.mark.parametrize("errors", [None, random_pitch_errors(4)])
def test_axial_motion_without_tilt_bends_no_hub(errors: tuple[float, ...] | None) -> None:
    losses = solve(pahl_coupling(0.0, axial_velocity=1e-3, pitch_errors=errors)).losses
    assert losses.friction_moment == losses.hub_bending_moment == losses.contact_shift_moment == 0.0
    assert losses.friction_power == pytest.approx(LIMIT * 1e-3, rel=1e-9)


@pytest.mark.parametrize("kinematics", ["tangential", "spatial"])
@pytest.mark.parametrize("velocity", [0.0, 1e-3, -4e-3])
def test_moments_of_the_hub_are_those_of_its_teeth(velocity: float, kinematics: KinematicModel) -> None:
    # Friction summed tooth by tooth over 400 rotor angles; the normal forces' part follows from the power balance
    # (T delta/2) and from virtual work (the contact shift moment, tested against the energy of the teeth).
    inputs = pahl_coupling(0.1, axial_velocity=velocity, model=ModelOptions(kinematics=kinematics))
    losses, mesh, rows = solve(inputs).losses, PlainMesh(inputs), 400
    phi = mesh.angles(midpoints(rows, 2.0 * pi / TEETH))
    arm = PITCH_RADIUS * 0.2 * mesh.forces(phi) / cos(radians(20.0)) * np.sign(velocity + mesh.sliding(phi)) / rows
    x, y = (arm * np.sin(phi)).sum(), -(arm * np.cos(phi)).sum()
    about_pivot = x - 3000.0 * radians(0.1) / 2.0
    # Without the pivoting motion friction's moment about the tilt axis does no work: `tangential` leaves it out.
    about_tilt = losses.contact_shift_moment + (y if kinematics == "spatial" else 0.0)
    assert losses.friction_moment == pytest.approx(x, rel=2e-3)
    assert losses.hub_bending_moment == pytest.approx(hypot(about_pivot, about_tilt), rel=2e-3)
