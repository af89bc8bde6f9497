"""Return the notices and the errors of a calculation, and check that all numbers of a result are finite."""

from collections.abc import Callable
from dataclasses import fields, is_dataclass
from math import isfinite
from typing import Any

import numpy as np
import pytest

from solvers.errors import InvalidInput, NoSolution


def codes(result: Any) -> set[str]:
    """Return the codes of a result's notices."""
    return {notice.code for notice in result.warnings}


def refused(calculation: Callable[..., object], *inputs: object) -> tuple[str, str | None]:
    """Return the code and the field of the error with which a calculation must refuse its inputs."""
    with pytest.raises(InvalidInput) as refusal:
        calculation(*inputs)
    return refusal.value.code, refusal.value.field


def unsolved(calculation: Callable[..., object], *inputs: object) -> NoSolution:
    """Return the exception NoSolution that a calculation must raise."""
    with pytest.raises(NoSolution) as failure:
        calculation(*inputs)
    return failure.value


def assert_finite(value: object, path: str = "result") -> None:
    """Check that a result contains no NaN and no infinity, and that every array in the result is read-only."""
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
