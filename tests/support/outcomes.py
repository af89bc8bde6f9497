"""What a calculation says beside its numbers: its notices, why it refuses, that nothing is lost in between."""

from collections.abc import Callable
from dataclasses import fields, is_dataclass
from math import isfinite
from typing import Any

import numpy as np
import pytest

from solvers.errors import InvalidInput, NoSolution


def codes(result: Any) -> set[str]:
    """The codes of a result's notices."""
    return {notice.code for notice in result.warnings}


def refused(calculation: Callable[..., object], *inputs: object) -> tuple[str, str | None]:
    """Code and field with which a calculation refuses its inputs."""
    with pytest.raises(InvalidInput) as refusal:
        calculation(*inputs)
    return refusal.value.code, refusal.value.field


def unsolved(calculation: Callable[..., object], *inputs: object) -> NoSolution:
    """What a calculation without solution says."""
    with pytest.raises(NoSolution) as failure:
        calculation(*inputs)
    return failure.value


def assert_finite(value: object, path: str = "result") -> None:
    """No NaN or infinity anywhere, and every array read-only."""
    if is_dataclass(value):
        for part in fields(value):
            assert_finite(getattr(value, part.name), f"{path}.{part.name}")
    elif isinstance(value, tuple):
        for part in value:
            assert_finite(part, path)
    elif isinstance(value, np.ndarray):
        assert np.isfinite(value).all(), path
        assert not value.flags.writeable, path
    elif isinstance(value, float):
        assert isfinite(value), path
