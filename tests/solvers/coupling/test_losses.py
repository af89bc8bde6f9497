"""Friction power and moments under axial velocity: limits, closed forms, books."""

from math import asin, cos, hypot, pi, radians, sqrt

import numpy as np
import pytest

from solvers.coupling.inputs import CouplingInputs, KinematicModel, ModelOptions
from solvers.coupling.model import solve
from solvers.published.pahl import PITCH_RADIUS, TEETH, pahl_coupling
from tests.support.couplings import random_pitch_errors
from tests.support.plain_coupling import PlainMesh, midpoints

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
