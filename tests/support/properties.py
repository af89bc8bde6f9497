"""Check properties on random examples: at least three by default, `few` with the marker `ci`, `many` with `slow`."""

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis.strategies import SearchStrategy

from app.examples import examples as shown
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


def seeds(few: int, many: int, default: int | None = None) -> Callable[[Callable[[np.random.Generator], None]], Test]:
    """Return a decorator that turns a property of random draws into a test with many seeds.

    If the model refuses a draw or has no solution, the draw is ignored. At most 20 % of the draws may be ignored.
    `default` is the number of seeds by default, if draws take so long that it shall be less than three.
    """

    def decorate(holds: Callable[[np.random.Generator], None]) -> Test:
        @_on(few, many, default)
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


def _on(few: int, many: int, default: int | None = None) -> pytest.MarkDecorator:
    usual = pytest.param(default or min(few, max(3, few // 5)), id="default")
    marked = [pytest.param(few, id="few", marks=pytest.mark.ci), pytest.param(many, id="many", marks=pytest.mark.slow)]
    return pytest.mark.parametrize("count", [usual, *marked])


def first(count: int, values: Iterable[Any]) -> list[Any]:
    """Return parameters of a test: the first `count` values by default, the others with the marker `ci`."""
    found = list(values)
    others = (value if isinstance(value, tuple) else (value,) for value in found[count:])
    return [*found[:count], *(pytest.param(*value, marks=pytest.mark.ci) for value in others)]


def one_per_endpoint(names: Iterable[str]) -> list[Any]:
    """Return names of examples as parameters: one of each endpoint by default, the others with the marker `ci`."""
    seen: set[str] = set()
    found = []
    for name in sorted(names):
        endpoint = shown()[name].endpoint
        found.append(pytest.param(name, marks=pytest.mark.ci) if endpoint in seen else name)
        seen.add(endpoint)
    return found
