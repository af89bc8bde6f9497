"""Random couplings, as users have them, pass checks of balances, resolution and jumps; long runs are marked slow."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.random import Generator

from solvers.coupling import kinematics
from solvers.coupling.inputs import CouplingInputs, SleeveSupport
from solvers.coupling.model import solve
from solvers.coupling.orbit import solve_orbit
from tests.support.changes import changed
from tests.support.coupling_checks import CHECKS, check_resolution_of, finer
from tests.support.couplings import random_inputs
from tests.support.outcomes import codes
from tests.support.stored import stored

# How many cases a fifth of a second allows, three at least.
CASES = dict(zip((check.__name__ for check in CHECKS), (8, 5, 3, 3, 3), strict=True))


@pytest.mark.parametrize(
    ("seed", "times"),
    [(2026, 1), pytest.param(2026, 4, marks=pytest.mark.ci), pytest.param(1977, 75, marks=pytest.mark.slow)],
)
@pytest.mark.parametrize("check", CHECKS)
def test_random_couplings(check: Callable[[Generator], None], seed: int, times: int) -> None:
    random = np.random.default_rng(seed)
    for _ in range(times * CASES[check.__name__]):
        check(random)


def test_the_largest_force_is_not_among_the_highest_samples() -> None:
    """The largest force lies between two samples; the sample beside it is only the fourteenth highest of all peaks."""
    (inputs,) = stored(CouplingInputs, "coupling", "largest force not among the highest samples")
    check_resolution_of(inputs)


def test_the_largest_force_between_few_loaded_teeth_is_found() -> None:
    # 208 rotor angles missed up to 3.5 % of it.
    for inputs in stored(CouplingInputs, "coupling", "largest force between few loaded teeth"):
        with finer(kinematics, 2, "_PITCH_NODES", "_LEAST_ROTOR_POSITIONS"):
            exact = solve(inputs).lubrication.max_normal_force
        assert solve(inputs).lubrication.max_normal_force == pytest.approx(exact, rel=5e-3)


def test_the_largest_displacement_between_few_loaded_teeth_is_found() -> None:
    # 220 and 240 rotor angles missed 3.5 % and 2.2 % of it without a notice.
    for inputs in stored(CouplingInputs, "coupling", "largest displacement between few loaded teeth"):
        result = solve_orbit(inputs)
        assert "orbit_resolution" not in codes(result)
        with finer(kinematics, 32, "_LEAST_ROTOR_POSITIONS"):
            sampled = solve_orbit(inputs).orbit
        assert result.max_displacement == pytest.approx(np.hypot(sampled.x, sampled.y).max(), rel=2e-3)


@pytest.mark.parametrize("sleeve", ["centred", "floating"])
def test_the_largest_force_does_not_depend_on_zero_pitch_errors_written_down(sleeve: SleeveSupport) -> None:
    # With errors the largest of a revolution counts, which for `spatial` is more than that of the tilt position.
    random = np.random.default_rng(36)
    for _ in range(20):
        inputs = random_inputs(random, errors=False)
        inputs = changed(inputs, {"model.kinematics": "spatial", "model.sleeve": sleeve})
        zeros = changed(inputs, {"coupling.pitch_errors": (0.0,) * inputs.coupling.teeth})
        without, written = (solve(each).lubrication.max_normal_force for each in (inputs, zeros))
        assert written == pytest.approx(without, rel=1e-12)
