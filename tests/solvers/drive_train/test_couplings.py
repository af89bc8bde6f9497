"""In a coupling on a shaft, friction dissipates energy, the sleeve is in balance, and hubs can stick."""

import itertools
from dataclasses import replace
from math import cos, hypot, pi

import numpy as np
import pytest

from solvers.arrays import FloatArray
from solvers.coupling.inputs import Friction
from solvers.coupling.kinematics import pitch_radius
from solvers.drive_train.inputs import Alignment, UnitCoupling
from solvers.drive_train.shafts.coupling_loads import (
    CouplingPort,
    coupling_loads,
    coupling_port,
    elastic_plastic,
    hub_moments,
    sliding_tilt,
)
from tests.support.drive_trains import COUPLING, SPEED

TORQUE = 12e6 / SPEED
DOWN = np.array([0.0, -1.0])
TILTS = np.array([-3.5e-4, 8.4e-4, -1.8e-4, 10.1e-4])


def port(coupling: UnitCoupling = COUPLING, law: str = "elastic_plastic", rotation: float = 1.0) -> CouplingPort:
    return coupling_port(coupling, 0, law, TORQUE, SPEED, rotation, DOWN, 9.80665)


def vector(conjugate: FloatArray) -> FloatArray:
    """Return the moment vector M (X, Y, 0) that belongs to the moments m = -Z x M; m is conjugate to the slopes."""
    return np.array([-conjugate[1], conjugate[0], 0.0])


@pytest.mark.parametrize("law", ["elastic_plastic", "sliding"])
@pytest.mark.parametrize("shaft", ["pinion", "wheel"])
@pytest.mark.parametrize("scale", [1.0, 0.01, 0.003])
def test_derivative_of_the_loads(law: str, shaft: str, scale: float) -> None:
    own = port(replace(COUPLING, shaft=shaft, friction=Friction(), thrust_fraction=0.3), law)
    tilts, step = scale * TILTS, 1e-6 * scale * 1e-3
    _, exact = coupling_loads(own, tilts)
    columns = [
        (coupling_loads(own, tilts + change)[0] - coupling_loads(own, tilts - change)[0]) / (2 * step)
        for change in step * np.eye(4)
    ]
    for row, quotients in zip(exact, np.array(columns).T, strict=True):
        assert row == pytest.approx(quotients, abs=1e-3 * np.abs(exact).max(axis=1).mean())
    assert (np.abs(exact[4]).max() > 0.0) == (scale < 1.0)  # beyond, friction is at its least and stays


@pytest.mark.parametrize("law", ["elastic_plastic", "sliding"])
@pytest.mark.parametrize("rotation", [1.0, -1.0])
@pytest.mark.parametrize("shaft", ["pinion", "wheel"])
@pytest.mark.parametrize("machine_side", ["minus", "plus"])
def test_sleeve_is_in_balance_and_friction_dissipates(law: str, rotation: float, shaft: str, machine_side: str) -> None:
    """The forces of the hubs on the sleeve balance the moments of the hubs on the sleeve."""
    # The loss moment of friction acts against the sliding, and the straightening moment acts against the tilt.
    own = port(replace(COUPLING, shaft=shaft, machine_side=machine_side), law, rotation)
    loads, _ = coupling_loads(own, TILTS)
    force_on_sleeve = -np.array([loads[0], loads[1], 0.0])
    moments = np.zeros(3)
    for hub, tilt in enumerate((TILTS[:2], TILTS[2:])):
        size = hypot(*tilt)
        hub_now = hub_moments(own, size)
        direction = np.array([*tilt, 0.0]) / size
        turn = np.array([-direction[1], direction[0], 0.0])
        torque_part = own.driving[hub] * TORQUE * size / 2
        moments += hub_now.straightening * turn + rotation * (hub_now.loss + torque_part) * direction
        if hub == 0:
            on_hub = vector(loads[2:])
            expected = -hub_now.straightening * turn - rotation * (hub_now.loss - torque_part) * direction
            assert on_hub == pytest.approx(expected, abs=1e-9)
            # Hub and sleeve turn about axes that differ by theta x Z: M.(Omega_hub - Omega_sleeve) = -M_f omega delta.
            sliding = rotation * SPEED * np.cross(turn * size, [0.0, 0.0, 1.0])
            frictional = on_hub - rotation * torque_part * direction
            assert frictional @ sliding == pytest.approx(-hub_now.loss * SPEED * size, rel=1e-9)
            assert on_hub @ turn < 0.0
    # On the sleeve: force f at A, -f at B, a distance l towards the machine.
    arm = np.array([0.0, 0.0, own.length])
    assert moments + np.cross(arm, -force_on_sleeve) == pytest.approx([0.0, 0.0, 0.0], abs=1e-9)


def jenkins(ratio: float) -> tuple[float, float]:
    """Return the loss moment and the elastic moment of a spring that slides at a limit force."""
    # The spring is stepped through two cycles with the amplitude `ratio` times the stretch at the limit force. The
    # second cycle gives both moments, divided by the loss moment of full sliding.
    steps, stretch, forces = 20000, 0.0, []
    angle = 2 * pi * np.arange(2 * steps) / steps
    place = ratio * np.cos(angle)
    for before, after in itertools.pairwise(place):
        stretch = min(max(stretch + after - before, -1.0), 1.0)
        forces.append(stretch)
    last, force = angle[steps:], np.array(forces[steps - 1 :])
    elastic, loss = np.mean(force * np.cos(last)), -np.mean(force * np.sin(last))
    full = 2 / pi
    return loss / full, elastic / full


@pytest.mark.parametrize("ratio", [0.5, 1.0, 1.001, 1.5, 4.0, 30.0])
def test_first_harmonic_of_the_stepped_hysteresis(ratio: float) -> None:
    assert elastic_plastic(ratio) == pytest.approx(jenkins(ratio), abs=1e-4)


def test_limits_of_the_yielding_teeth() -> None:
    """For a large ratio beta of the tilt to the sliding limit, the loss moment is the friction moment of full sliding.

    The elastic moment is then 4/(3 sqrt beta) of the same friction moment. Below the sliding limit there is no loss
    moment, and the elastic moment is z r_o^2 c_a delta/2.
    """
    loss, elastic = elastic_plastic(1e6)
    assert loss == pytest.approx(1.0, abs=2e-6)
    assert elastic == pytest.approx(4 / 3 / 1e3, rel=1e-3)
    own = port()
    limit = sliding_tilt(own, 0.15)
    assert limit == pytest.approx(0.013e-3, abs=0.0005e-3)
    stuck = hub_moments(own, 0.5 * limit)
    assert stuck.sticks
    assert stuck.loss == 0.0
    coupling = COUPLING.coupling
    spring = coupling.teeth * pitch_radius(coupling) ** 2 * coupling.tooth_stiffness * 0.5 * limit / 2
    shift = hub_moments(replace(own, law="sliding"), 0.5 * limit).straightening
    assert stuck.straightening - shift == pytest.approx(spring, rel=1e-3)


def test_thrust_takes_the_friction_that_would_tilt() -> None:
    free, locked = port(), port(replace(COUPLING, thrust_fraction=1.0))
    half = port(replace(COUPLING, thrust_fraction=-0.5))
    tilt, full = 1e-3, 2 / pi * 0.15 * TORQUE / cos(COUPLING.coupling.pressure_angle)
    assert hub_moments(free, tilt).loss == pytest.approx(full, rel=0.03)
    assert hub_moments(half, tilt).loss == pytest.approx(full * cos(pi / 4), rel=0.03)
    assert hub_moments(locked, tilt).loss == pytest.approx(0.0, abs=1e-9 * full)
    frictionless = port(replace(COUPLING, friction=Friction(0.0)))
    loads = coupling_loads(locked, TILTS)[0]
    assert loads[:4] == pytest.approx(coupling_loads(frictionless, TILTS)[0][:4], rel=1e-6)
    assert loads[4] == pytest.approx(0.15 * TORQUE / (0.09 * cos(COUPLING.coupling.pressure_angle)), rel=1e-12)


def test_a_machine_that_grows_moves_its_hub_up() -> None:
    grown = port(replace(COUPLING, alignment=Alignment(0.5, 40.0, 0.6, 60.0, 11e-6)))
    rise = 11e-6 * (0.6 * 60 - 0.5 * 40)
    assert grown.rest - port().rest == pytest.approx(np.array([0.0, rise, 0.0, rise]) / 0.4)
