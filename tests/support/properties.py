"""Check properties on random examples: on few examples by default, and on many examples if slow tests are run."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis.strategies import SearchStrategy

from solvers.errors import InvalidInput, NoSolution

Test = Callable[[int], None]


def examples(
    few: int, many: int, *drawn: SearchStrategy, **named: SearchStrategy
) -> Callable[[Callable[..., None]], Test]:
    """Return a decorator that turns a property into a test on random examples, as `given` of hypothesis does."""

    def decorate(holds: Callable[..., None]) -> Test:
        @_on(few, many)
        def test(count: int) -> None:
            settings(max_examples=count, suppress_health_check=list(HealthCheck))(given(*drawn, **named)(holds))()

        test.__name__, test.__qualname__, test.__doc__ = holds.__name__, holds.__qualname__, holds.__doc__
        return test

    return decorate


def seeds(few: int, many: int) -> Callable[[Callable[[np.random.Generator], None]], Test]:
    """Return a decorator that turns a property of random draws into a test with many seeds.

    If the model refuses a draw or has no solution, the draw is ignored. At most 20 % of the draws may be ignored.
    """

    def decorate(holds: Callable[[np.random.Generator], None]) -> Test:
        @_on(few, many)
        def test(count: int) -> None:
            refused = 0
            for seed in range(count):
                try:
                    holds(np.random.default_rng([38, seed]))
                except (InvalidInput, NoSolution):
                    refused += 1
                except AssertionError as error:
                    error.add_note(f"seed {seed}")
                    raise
            assert refused <= 0.2 * count

        test.__name__, test.__qualname__, test.__doc__ = holds.__name__, holds.__qualname__, holds.__doc__
        return test

    return decorate


def _on(few: int, many: int) -> pytest.MarkDecorator:
    """Return a mark that runs a test on few examples, and also on many examples if slow tests are run."""
    return pytest.mark.parametrize(
        "count", [pytest.param(few, id="few"), pytest.param(many, id="many", marks=pytest.mark.slow)]
    )
