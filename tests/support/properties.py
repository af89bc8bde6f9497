"""Properties checked on random examples: on few in the default run, on many where slow tests run."""

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
    """Turn a property into a test over what the strategies draw, as `given` does."""

    def decorate(holds: Callable[..., None]) -> Test:
        @_on(few, many)
        def test(count: int) -> None:
            settings(max_examples=count, suppress_health_check=list(HealthCheck))(given(*drawn, **named)(holds))()

        test.__name__, test.__qualname__, test.__doc__ = holds.__name__, holds.__qualname__, holds.__doc__
        return test

    return decorate


def seeds(few: int, many: int) -> Callable[[Callable[[np.random.Generator], None]], Test]:
    """Turn a property of what a generator draws into a test over seeds; a draw that a model refuses is passed over."""

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
    """Few examples by default, many where slow tests run."""
    return pytest.mark.parametrize(
        "count", [pytest.param(few, id="few"), pytest.param(many, id="many", marks=pytest.mark.slow)]
    )
