"""Random couplings like those of users are compared with their mirror images in every number of the answer."""

from collections.abc import Callable
from dataclasses import replace
from math import pi

import numpy as np
import pytest

from solvers.arrays import FloatArray
from solvers.coupling.inputs import CouplingInputs
from solvers.coupling.model import solve
from solvers.coupling.orbit import solve_orbit
from solvers.coupling.results import AxialThrust, CouplingResult
from tests.support.answers import TOLERANCE, Expected, differences, unchanged
from tests.support.changes import changed, scaled
from tests.support.couplings import random_inputs
from tests.support.properties import seeds

SLIDING = "kinematics.curves.sliding_velocity"
TRAVEL = "kinematics.curves.contact_position"
PLACE = "load_distribution.sleeve_displacement"
MOMENT = r"\.overturning_moment$"


def unlike(
    inputs: CouplingInputs,
    image: CouplingInputs,
    expected: Expected,
    answer: Callable[[CouplingInputs], object] = solve,
) -> list[str]:
    """Return the names of the values that differ between a coupling and its image."""
    # The overturning moment is a small difference of large friction moments of opposite teeth. Its tolerance is
    # therefore a share of the largest possible moment of friction.
    one, other = answer(inputs), answer(image)
    if isinstance(one, CouplingResult) and isinstance(other, CouplingResult):
        largest = one.axial_thrust.coaxial_limit * one.geometry.pitch_radius
        moments = [
            0.0 if (own := each.axial_thrust.self_induced) is None else own.overturning_moment for each in (one, other)
        ]
        assert moments[1] == pytest.approx(moments[0], rel=0.0, abs=TOLERANCE * largest)
    return differences(one, other, expected, without=MOMENT)


@seeds(25, 1000)
def test_a_coupling_that_tilts_the_other_way(random: np.random.Generator) -> None:
    """A coupling with opposite tilt and rotor half a turn further is the same coupling, seen from the other side."""
    inputs = random_inputs(random)
    image = scaled(inputs, -1.0, "operation.misalignment")
    image = changed(image, {"model.rotor_angle": inputs.model.rotor_angle + pi})

    def expected(name: str, values: FloatArray, _: str | None) -> FloatArray:
        if name == "load_distribution.curves.angle":
            return values + pi
        return -values if name in {SLIDING, TRAVEL, PLACE} else values

    assert not unlike(inputs, image, expected)


@seeds(25, 1000)
def test_a_coupling_that_turns_the_other_way(random: np.random.Generator) -> None:
    inputs = random_inputs(random)

    def expected(name: str, values: FloatArray, _: str | None) -> FloatArray:
        return -values if name == SLIDING else values

    assert not unlike(inputs, scaled(inputs, -1.0, "operation.speed"), expected)


@seeds(25, 1000)
def test_a_hub_that_moves_the_other_way(random: np.random.Generator) -> None:
    """If a hub moves the other way, its thrust changes sign; the bounds of the thrust change sign and exchange places.

    The test takes couplings with one mesh, because two meshes cause a thrust even without axial motion.
    """
    inputs = random_inputs(random, single=True)

    def expected(name: str, values: FloatArray, _: str | None) -> FloatArray:
        turned = ("axial_thrust.force", "axial_thrust.fraction_of_limit", "axial_thrust.uniform_load_force")
        return -values if name in turned else values

    def with_bounds_exchanged(inputs: CouplingInputs) -> object:
        result = solve(inputs)
        if inputs.operation.axial_velocity >= 0.0:
            return result
        return replace(result, axial_thrust=_exchanged(result.axial_thrust))

    if inputs.operation.axial_velocity:
        image = scaled(inputs, -1.0, "operation.axial_velocity")
        assert not unlike(inputs, image, expected, with_bounds_exchanged)


def _exchanged(thrust: AxialThrust) -> AxialThrust:
    return replace(thrust, lower_bound=-thrust.upper_bound, upper_bound=-thrust.lower_bound)


@seeds(25, 1000)
def test_hubs_that_are_tilted_alike_may_be_exchanged_for_hubs_that_turn_back(random: np.random.Generator) -> None:
    """Seen from the other end of the sleeve, two hubs that tilt alike have the opposite speed and the opposite tilt."""
    inputs = changed(random_inputs(random), {"operation.arrangement": "parallel_offset"})
    image = scaled(inputs, -1.0, "operation.speed", "operation.misalignment")

    def expected(name: str, values: FloatArray, _: str | None) -> FloatArray:
        return -values if name == TRAVEL else values

    turned = changed(image, {"model.rotor_angle": inputs.model.rotor_angle + pi})
    assert not differences(solve(inputs).axial_thrust, solve(turned).axial_thrust, expected)


@seeds(25, 1000)
def test_tooth_numbers_may_start_anywhere(random: np.random.Generator) -> None:
    """Any tooth may have the number 0; the values that belong to a tooth move with its number."""
    inputs = random_inputs(random, errors=True)
    teeth = inputs.coupling.teeth
    steps = int(random.integers(1, teeth))
    errors = inputs.coupling.pitch_errors or ()
    moved = {
        "coupling.pitch_errors": errors[-steps:] + errors[:-steps],
        "model.rotor_angle": inputs.model.rotor_angle - 2 * pi * steps / teeth,
    }

    def expected(name: str, values: FloatArray, _: str | None) -> FloatArray:
        if name == "load_distribution.curves.angle":
            return values - 2 * pi * steps / teeth
        return np.roll(values, steps) if name == "load_distribution.curves.tangential_force" else values

    without = r"^derived\.pitch_errors"
    assert not differences(solve(inputs), solve(changed(inputs, moved)), expected, without=without)


@seeds(4, 100)
def test_an_orbit_begins_where_the_rotor_is_said_to_stand(random: np.random.Generator) -> None:
    """The opposite sense of rotation gives the same orbit, because the inertia forces stay the same."""
    inputs = random_inputs(random, errors=True, single=True)
    image = scaled(inputs, -1.0, "operation.speed")
    assert not differences(solve_orbit(inputs), solve_orbit(image), unchanged)
