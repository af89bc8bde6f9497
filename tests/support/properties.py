"""Properties checked on random examples: on few in the default run, on many where slow tests run."""

from collections.abc import Callable

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis.strategies import SearchStrategy

Test = Callable[[int], None]


def examples(
    few: int, many: int, *drawn: SearchStrategy, **named: SearchStrategy
) -> Callable[[Callable[..., None]], Test]:
    """Turn a property into a test over what the strategies draw, as `given` does."""

    def decorate(holds: Callable[..., None]) -> Test:
        @pytest.mark.parametrize(
            "count", [pytest.param(few, id="few"), pytest.param(many, id="many", marks=pytest.mark.slow)]
        )
        def test(count: int) -> None:
            settings(max_examples=count, suppress_health_check=list(HealthCheck))(given(*drawn, **named)(holds))()

        test.__name__, test.__qualname__, test.__doc__ = holds.__name__, holds.__qualname__, holds.__doc__
        return test

    return decorate
