"""Bearing films against the integrated pressure, and back from displacement to force."""

from dataclasses import replace
from math import atan2, degrees, hypot, pi, sqrt

import numpy as np
import pytest

from solvers.drive_train.inputs import JournalBearing, LinearBearing, RigidBearing
from solvers.drive_train.shafts.bearings import attitude_angle, bearing_state, film_force, load_number
from solvers.errors import NoSolution

JOURNAL = JournalBearing(0.0, 0.16, 0.11, 0.014, 130e-6)
SPEED = 1000.0


def force_of(displacement: np.ndarray, rotation: float) -> np.ndarray:
    """The film's force on the shaft at a displacement, by its closed form in the displacement's own directions."""
    eccentricity = hypot(*displacement) / JOURNAL.clearance
    radial, rest = displacement / hypot(*displacement), 1 - eccentricity**2
    tangential = rotation * np.array([-radial[1], radial[0]])
    scale = film_force(JOURNAL, SPEED)
    inward, along = 4 * eccentricity**2 / rest**2, pi * eccentricity / rest**1.5
    return np.asarray(scale * (-inward * radial + along * tangential))


@pytest.mark.parametrize("rotation", [1.0, -1.0])
@pytest.mark.parametrize("load", [(0.0, -50e3), (30e3, 4e3), (-1.0, 0.1), (2e6, 1e6)])
def test_the_film_answers_its_load(load: tuple[float, float], rotation: float) -> None:
    state = bearing_state(JOURNAL, np.array(load), SPEED, rotation)
    assert force_of(state.displacement, rotation) == pytest.approx(-np.array(load), abs=1e-10 * hypot(*load))
    assert state.minimum_film == pytest.approx(JOURNAL.clearance - hypot(*state.displacement))


@pytest.mark.parametrize("eccentricity", [0.05, 0.3, 0.6, 0.9])
def test_closed_form_is_the_integrated_pressure(eccentricity: float) -> None:
    """p = 3 eta omega h' (z^2 - L^2/4)/h^3 where it is positive, integrated over the film."""
    theta, weight = np.polynomial.legendre.leggauss(400)
    theta, weight = pi / 2 * (theta + 1), weight * pi / 2
    clearance, radius, width = JOURNAL.clearance, JOURNAL.diameter / 2, JOURNAL.width
    film, slope = clearance * (1 + eccentricity * np.cos(theta)), -clearance * eccentricity * np.sin(theta)
    per_angle = 3 * JOURNAL.viscosity * SPEED * slope / film**3 * (-(width**3) / 6) * radius
    inward, along = np.sum(weight * per_angle * np.cos(theta)), np.sum(weight * per_angle * np.sin(theta))
    assert hypot(inward, along) == pytest.approx(film_force(JOURNAL, SPEED) * load_number(eccentricity), rel=1e-6)
    assert atan2(along, -inward) == pytest.approx(attitude_angle(eccentricity), rel=1e-6)


def test_without_load_the_shaft_moves_across() -> None:
    assert degrees(attitude_angle(0.0)) == pytest.approx(90.0, abs=1e-4)
    state = bearing_state(JOURNAL, np.zeros(2), SPEED, 1.0)
    assert state.displacement == pytest.approx([0.0, 0.0], abs=0.0)
    assert state.friction_power == pytest.approx(2 * pi * 0.014 * SPEED**2 * 0.08**3 * 0.11 / 130e-6)


def test_a_counterclockwise_shaft_under_its_weight_moves_to_plus_x() -> None:
    assert bearing_state(JOURNAL, np.array([0.0, -1e4]), SPEED, 1.0).displacement[0] > 0.0
    assert bearing_state(JOURNAL, np.array([0.0, -1e4]), SPEED, -1.0).displacement[0] < 0.0


@pytest.mark.parametrize("load", [(0.0, 0.0), (0.0, -50e3), (30e3, 4e3), (3e5, -1e6)])
@pytest.mark.parametrize(
    "bearing",
    [JOURNAL, LinearBearing(0.0, ((3e8, 1e8), (-2e8, 5e8))), RigidBearing(0.0)],
    ids=["film", "spring", "rigid"],
)
def test_flexibility_is_the_derivative(bearing: JournalBearing | LinearBearing, load: tuple[float, float]) -> None:
    step = 0.1
    columns = [
        (
            bearing_state(bearing, np.array(load) + change, SPEED, -1.0).displacement
            - bearing_state(bearing, np.array(load) - change, SPEED, -1.0).displacement
        )
        / (2 * step)
        for change in step * np.eye(2)
    ]
    exact = bearing_state(bearing, np.array(load), SPEED, -1.0).flexibility
    assert pytest.approx(exact, rel=2e-5, abs=1e-5 * np.abs(exact).max()) == np.array(columns).T


def test_springs_and_rigid_bearings() -> None:
    matrix = ((3e8, 1e8), (-2e8, 5e8))
    state = bearing_state(LinearBearing(0.0, matrix), np.array([1e4, 2e4]), SPEED, 1.0)
    assert np.array(matrix) @ state.displacement == pytest.approx([1e4, 2e4])
    assert not np.any(bearing_state(RigidBearing(0.0), np.array([1e4, 2e4]), SPEED, 1.0).displacement)


def test_clearance_left_open_is_a_share_of_the_radius() -> None:
    assert replace(JOURNAL, radial_clearance=None).clearance == pytest.approx(1.5e-3 * 0.08)


def test_a_film_that_cannot_carry_is_no_solution() -> None:
    with pytest.raises(NoSolution) as refusal:
        bearing_state(JOURNAL, np.array([0.0, 1e12]), SPEED, 1.0)
    assert refusal.value.code == "journal"


def test_friction_grows_with_eccentricity() -> None:
    state = bearing_state(JOURNAL, np.array([0.0, -50e3]), SPEED, 1.0)
    plain = bearing_state(JOURNAL, np.zeros(2), SPEED, 1.0).friction_power
    assert state.friction_power == pytest.approx(plain / sqrt(1 - state.eccentricity_ratio**2))
    assert state.specific_pressure == pytest.approx(50e3 / (0.16 * 0.11))
