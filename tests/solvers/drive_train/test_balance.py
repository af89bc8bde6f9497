"""With rigid shafts the coupled balance is the load distribution of the pair; it converges for random units."""

from dataclasses import replace
from math import radians

import numpy as np
import pytest
from hypothesis import strategies as st

from solvers.arrays import FloatArray
from solvers.drive_train.gap.face_curves import face_mean
from solvers.drive_train.gap.thermal_lead import thermal_lead
from solvers.drive_train.inputs import (
    DriveTrainInputs,
    Effects,
    Heat,
    RigidBearing,
)
from solvers.drive_train.outcome import outcome
from solvers.drive_train.prepared import prepare, settle
from solvers.drive_train.shafts.coupling_loads import TILTS
from solvers.drive_train.states import solve
from solvers.errors import NoSolution
from solvers.scuffing.contact_slices import Mesh
from solvers.scuffing.face_response import FaceResponse, face_response
from solvers.scuffing.inputs import LeadCurve, Resolution
from solvers.scuffing.load_balance import balance_load
from solvers.scuffing.model import mesh_of
from solvers.scuffing.model import solve as solve_load_distribution
from tests.support.changes import changed
from tests.support.drive_trains import COUPLING, GROUND, NO_EFFECTS, rigid_bearings, turbo_gear
from tests.support.outcomes import unsolved
from tests.support.properties import examples, first
from tests.support.random_units import COARSE, mirrored, reversed_ends, rotated, units

# Today's load distribution


def test_an_even_load_of_a_spur_gear_is_even_at_the_stations() -> None:
    """The contact lines of a spur gear run along the face."""
    # The load at the stations is therefore even only if all intervals between stations have the same number of slices.
    spur = {"mesh.distribution.gears.helix_angle": 0.0, "pumping.gears.helix_angle": 0.0, "effects": NO_EFFECTS}
    force = solve(changed(turbo_gear(), spur)).misalignment.curves.line_force
    assert force == pytest.approx(np.full(force.size, force.mean()), rel=1e-9)


@pytest.mark.parametrize("rigid", ["no effects", "stiff shafts in rigid bearings"])
def test_rigid_shafts_are_todays_load_distribution(rigid: str) -> None:
    inputs = replace(turbo_gear(GROUND), effects=Effects(coupling=False, thermal=False))
    if rigid == "no effects":
        inputs = replace(inputs, effects=NO_EFFECTS)
    else:
        stiff = [
            replace(shaft, youngs_modulus=1e30, density=0.0, bearings=rigid_bearings(shaft.bearings))
            for shaft in inputs.shafts
        ]
        inputs = replace(inputs, pinion_shaft=stiff[0], wheel_shaft=stiff[1])
    found, today = solve(inputs).mesh, solve_load_distribution(inputs.mesh.distribution)
    error, expected = found.balance.transmission_error, today.balance.transmission_error
    assert error == pytest.approx(expected, abs=1e-12 * np.abs(expected).max())
    assert found.load.face_load_factor == pytest.approx(today.load.face_load_factor, rel=1e-12)
    assert found.pressure.max == pytest.approx(today.pressure.max, rel=1e-12)
    assert found.friction_loss.power == pytest.approx(today.friction_loss.power, rel=1e-12)
    if rigid == "no effects":
        assert np.array_equal(error, expected)


def test_lead_curves() -> None:
    """A straight lead curve acts like a helix slope. A lead curve of zeros changes no bit of the results."""
    plain = turbo_gear().mesh.distribution
    width = plain.gears.face_width
    none, sloped, straight, zeros = (
        solve_load_distribution(replace(plain, modifications=replace(plain.modifications, **change)))
        for change in (
            {},
            {"helix_slope": 20e-6},
            {"lead_curve": LeadCurve((0.0, 0.03, width), (-10e-6, -7e-6, 10e-6))},
            {"lead_curve": LeadCurve((0.0, width), (0.0, 0.0))},
        )
    )
    error = sloped.balance.transmission_error
    assert straight.balance.transmission_error == pytest.approx(error, abs=1e-12 * error.max())
    assert np.array_equal(zeros.balance.transmission_error, none.balance.transmission_error)
    assert np.array_equal(zeros.flank.line_load, none.flank.line_load)


@pytest.mark.parametrize("contact", ["hertzian", "linear"])
@pytest.mark.parametrize("helix", [0.0, 11.5])
def test_face_response_is_the_balances_own(contact: str, helix: float) -> None:
    """The forces at the stations add up to the mesh force, and their derivative is the difference quotient."""
    # A start from another response gives the same forces. The approach of helical flanks is that of the load balance.
    values = {"gears.helix_angle": radians(helix), "model.contact": contact}
    given_mesh = mesh_of(changed(turbo_gear(GROUND).mesh.distribution, values))
    lead = np.random.default_rng(3).normal(size=11) * 3e-6
    change = np.random.default_rng(4).normal(size=11)

    def mesh_with(gap: np.ndarray) -> Mesh:
        fine = np.interp(np.linspace(0, 1, 401), np.linspace(0, 1, 11), gap)
        return given_mesh.mesh._replace(gap=given_mesh.mesh.gap._replace(lead=fine))

    def under(gap: np.ndarray, start: FaceResponse | None = None) -> FaceResponse:
        return face_response(mesh_with(gap), given_mesh.rolls, given_mesh.force, 100, 11, start)

    found, step = under(lead), 1e-9
    assert found.force.sum() == pytest.approx(given_mesh.tangential_force, rel=1e-12)
    scale = np.abs(found.derivative).max()
    assert found.derivative.sum(axis=0) == pytest.approx(np.zeros(11), abs=1e-12 * scale)
    assert found.derivative == pytest.approx(found.derivative.T, abs=1e-12 * scale)
    quotient = (under(lead + step * change).force - under(lead - step * change).force) / (2 * step)
    assert found.derivative @ change == pytest.approx(quotient, abs=1e-4 * np.abs(quotient).max())
    again = under(lead, under(lead + 20e-6 * change))
    assert again.force == pytest.approx(found.force, rel=1e-10, abs=1e-10 * found.force.max())
    balance = balance_load(mesh_with(lead), given_mesh.rolls, given_mesh.force, 100)
    if helix == 0.0:
        return  # the error jumps where a spur gear's pairs come and go, and both stand for either side
    # The balance cuts lines that are loaded in part finer than the response does.
    error = np.interp(given_mesh.rolls.phase, balance.rolls.phase, balance.transmission_error)
    assert again.error == pytest.approx(error, rel=5e-4)


# Heat


def test_equally_hot_gears_have_no_error() -> None:
    inputs = turbo_gear()
    path = mesh_of(inputs.mesh.distribution).path
    heat = Heat(0.0, pinion_bulk=360.0, wheel_bulk=360.0)
    found = thermal_lead(replace(inputs, heat=heat), path, np.linspace(0, 0.2, 41))
    assert found.lead == pytest.approx(np.zeros(41), abs=1e-15)
    assert found.profile_slope == 0.0
    assert found.base_pitch == 0.0


def test_a_hot_pinion_leaves_its_contact_lines_parallel() -> None:
    """A hot pinion causes a constant gap along a contact line; neighbouring lines differ by alpha dT p_bt."""
    # This gap is the sum of lead and profile slope.
    inputs = turbo_gear()
    path = mesh_of(inputs.mesh.distribution).path
    plane, rise = path.plane, 15.0
    y = np.linspace(0.0, plane.face_width, 41)
    heat = Heat(0.0, pinion_bulk=353.15 + rise, wheel_bulk=353.15)
    found = thermal_lead(replace(inputs, heat=heat), path, y)
    assert found.base_pitch == pytest.approx(12e-6 * rise * plane.base_pitch, rel=1e-12)

    def gap(line: float) -> np.ndarray:
        x = line - y * plane.tan_base_helix
        whole = found.lead + found.profile_slope * (x / plane.path_length - 0.5)
        return np.asarray(whole[(x >= 0.0) & (x <= plane.path_length)])

    lines = [gap(2.1 * plane.base_pitch), gap(3.1 * plane.base_pitch)]
    for line in lines:
        assert np.ptp(line) < 1e-15
    assert lines[0][0] - lines[1][0] == pytest.approx(found.base_pitch, rel=1e-9)


# Random units


@examples(8, 100, units(), st.floats(-3.0, 3.0))
def test_a_unit_turned_or_mirrored_answers_alike(inputs: DriveTrainInputs, angle: float) -> None:
    one = outcome(inputs)
    turns = -1.0 if inputs.mesh.distribution.gears.helix_angle == 0.0 else 1.0
    for image, sign in ((rotated(inputs, angle), 1.0), (mirrored(inputs), turns), (reversed_ends(inputs), turns)):
        other = outcome(image)
        assert other.face_load_factor == pytest.approx(one.face_load_factor, rel=1e-9)
        assert sign * other.shaft_slope == pytest.approx(one.shaft_slope, rel=1e-9, abs=1e-14)
        assert other.max_pressure == pytest.approx(one.max_pressure, rel=1e-9)
        assert other.safety == pytest.approx(one.safety, rel=1e-9)


@examples(25, 250, units())
def test_forces_and_moments_are_in_balance(inputs: DriveTrainInputs) -> None:
    found = solve(inputs)
    assert found.balance.force_error < 1e-10
    assert found.balance.moment_error < 1e-10
    assert found.convergence.residual <= 1e-12
    curves = found.misalignment.curves
    assert face_mean(curves.shaft) == pytest.approx(0.0, abs=1e-15)
    # The gap is what the shafts make of the load that the gap leaves.
    parts = found.misalignment.parts
    total = sum(
        getattr(parts, name)
        for name in ("bending", "torsion", "tilting_moment", "films", "bearing_offsets", "coupling", "collar", "weight")
    )
    # The residual of the gap, 1e-12 m at a station, tilts its straight line by at most three times as much.
    assert total == pytest.approx(found.misalignment.shaft_slope, abs=3e-12)


@examples(15, 1000, units())
def test_random_units_converge_or_say_so(inputs: DriveTrainInputs) -> None:
    try:
        residual = settle(inputs, prepare(inputs)).residual
    except NoSolution as error:
        refusal = error
    else:
        assert residual <= 1e-12
        return
    assert refusal.code in {"drive_train", "journal", "load_balance"}
    assert refusal.residuals


@pytest.mark.parametrize("unknowns", [TILTS, turbo_gear().face_stations])
def test_singular_equations_are_no_solution(unknowns: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """The singular equations are those for the tilts of both hubs, or those for the gap over the face."""
    inputs, solve_regular = turbo_gear(), np.linalg.solve

    def solve_singular(matrix: FloatArray, right: FloatArray) -> FloatArray:
        return np.asarray(solve_regular(0.0 * matrix if len(matrix) == unknowns else matrix, right), dtype=float)

    prepared = prepare(inputs)
    monkeypatch.setattr(np.linalg, "solve", solve_singular)
    failure = unsolved(settle, inputs, prepared)
    assert failure.code == "drive_train"
    assert failure.residuals


def test_finer_stations_change_little() -> None:
    """81 stations instead of 41 change K_H_beta by less than 1e-4 and the slope of the shafts by less than 2e-4."""
    # 96 roll positions and 60 slices instead of 200 and 100 change K_H_beta by less than 1e-3. All changes are
    # relative.
    plain = turbo_gear()
    one, other = outcome(plain), outcome(replace(plain, face_stations=81))
    assert other.face_load_factor == pytest.approx(one.face_load_factor, rel=1e-4)
    assert other.shaft_slope == pytest.approx(one.shaft_slope, rel=2e-4)
    coarse = changed(plain, {"mesh.distribution.resolution": Resolution(roll_positions=96, slices=60)})
    assert outcome(coarse).face_load_factor == pytest.approx(one.face_load_factor, rel=1e-3)


def test_without_torque_the_shafts_bend_by_weight_and_offsets_alone() -> None:
    bearings = (RigidBearing(0.22, offset=(0.0, 20e-6)), RigidBearing(0.62))
    idle = {"mesh.distribution.load.pinion_torque": 0.0, "pinion_shaft.bearings": bearings}
    found = solve(changed(turbo_gear(), idle))
    assert (found.load.face_load_factor, found.load.face_load_at) == (None, None)
    assert found.misalignment.parts.bearing_offsets != 0.0
    assert found.misalignment.parts.bending == 0.0
    assert found.balance.force_error is None
    error = found.mesh.balance
    assert np.array_equal(error.transmission_error, error.unloaded_error)
    assert found.losses.efficiency is None


def test_order_of_couplings_does_not_matter() -> None:
    plain = turbo_gear()
    wheel = replace(COUPLING, shaft="wheel", position=0.88, machine_side="plus", offset=(200e-6, -100e-6))
    one, other = (outcome(replace(plain, couplings=pair)) for pair in ((COUPLING, wheel), (wheel, COUPLING)))
    assert other.face_load_factor == pytest.approx(one.face_load_factor, rel=1e-10)
    assert other.shaft_slope == pytest.approx(one.shaft_slope, rel=1e-9)
    assert outcome(plain).face_load_factor != pytest.approx(one.face_load_factor, rel=1e-4)


def test_contact_load_factors_raise_the_contacts_alone() -> None:
    """An application factor of 1.5 raises the contact pressure, but the shafts still carry the force F_bt."""
    plain = replace(turbo_gear(), effects=Effects(coupling=False, thermal=False))
    one, other = solve(plain), solve(changed(plain, {"mesh.distribution.load.application_factor": 1.5}))
    assert other.load.max_pressure > 1.1 * one.load.max_pressure
    for a, b in zip(one.shafts, other.shafts, strict=True):
        for before, after in zip(a.bearings, b.bearings, strict=True):
            assert np.hypot(*after.reaction) == pytest.approx(np.hypot(*before.reaction), rel=0.03)
    assert other.balance.moment_error < 1e-10


@pytest.mark.parametrize("count", first(1, [3, 24]))
def test_aligned_and_random_offsets_find_one_solution(count: int) -> None:
    """The solution of a unit with elastic-plastic hubs does not depend on the gap from which the solver starts."""
    rng = np.random.default_rng(7)
    plain = turbo_gear(GROUND)
    plain = changed(plain, {"coupling_friction": "elastic_plastic", "mesh.distribution.resolution": COARSE})
    far = outcome(changed(plain, {"couplings.0.offset": (500e-6, -500e-6)})).gap
    for offset in [(0.0, 0.0), *map(tuple, rng.uniform(-500e-6, 500e-6, (count, 2)).tolist())]:
        unit = changed(plain, {"couplings.0.offset": offset})
        one, other = outcome(unit), outcome(unit, far)
        assert other.gap == pytest.approx(one.gap, abs=1e-12)
