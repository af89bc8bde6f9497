"""Random couplings of the kind users have: books close, no resolution and no jump shows; longer runs marked slow."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.random import Generator

from tests.coupling_checks import CHECKS

# How many cases a second allows in the default run.
CASES = dict(zip((check.__name__ for check in CHECKS), (60, 40, 15, 6, 12), strict=True))


@pytest.mark.parametrize("check", CHECKS)
def test_random_couplings(check: Callable[[Generator], None]) -> None:
    random = np.random.default_rng(2026)
    for _ in range(CASES[check.__name__]):
        check(random)


@pytest.mark.slow
@pytest.mark.parametrize("check", CHECKS)
def test_many_random_couplings(check: Callable[[Generator], None]) -> None:
    random = np.random.default_rng(1977)
    for _ in range(20 * CASES[check.__name__]):
        check(random)
