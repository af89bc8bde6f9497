"""Two whole answers are compared: every declared number of one answer with the same number of the other answer.

A test of a symmetry that compares only selected numbers overlooks the other numbers. Here a symmetry states how a
number changes, depending on its name and unit, and every number of the answer is checked.
"""

import re
from collections.abc import Callable, Iterator
from dataclasses import is_dataclass
from typing import Any, NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.quantity import Quantity, quantities

TOLERANCE = 1e-9


class Leaf(NamedTuple):
    """The values under one name of an answer: numbers with a unit and a scale, or a word."""

    values: FloatArray | str
    unit: str | None
    scale: float


Expected = Callable[[str, FloatArray, str | None], FloatArray]
"""A function that returns the expected numbers of the other answer. Its arguments are name, numbers and unit."""


def unchanged(_: str, values: FloatArray, __: str | None) -> FloatArray:
    return values


def leaves(answer: Any) -> dict[str, Leaf]:
    """Return every declared value of an answer. The keys are the dotted names of the values."""
    # The scale of a number is the largest absolute value with the same unit in the same part of the answer, because a
    # difference of large numbers is no more exact than these numbers. The scale of a number without a unit is at least
    # 1, the size of a share.
    found: dict[str, Leaf] = {}
    _walk(answer, "", None, found)
    scales: dict[tuple[str, str | None], float] = {}
    for name, leaf in found.items():
        if not isinstance(leaf.values, str):
            key = (_part(name), leaf.unit)
            least = 1.0 if leaf.unit is None else 0.0
            scales[key] = max(scales.get(key, least), _largest(leaf.values))
    return {
        name: leaf if isinstance(leaf.values, str) else leaf._replace(scale=scales[_part(name), leaf.unit])
        for name, leaf in found.items()
    }


def differences(
    one: Any,
    other: Any,
    expected: Expected = unchanged,
    *,
    tolerance: float = TOLERANCE,
    without: str = "^$",
    loose: dict[str, float] | None = None,
) -> list[str]:
    """Return a text for every value of `other` that differs from the value that is expected from `one`.

    Values whose name matches `without` are left out. If a name matches a key of `loose`, its tolerance is the value at
    this key.
    """
    before, after = leaves(one), leaves(other)
    names = [name for name in before if not re.search(without, name)]
    missing = [f"{name} only in one answer" for name in before.keys() ^ after.keys() if not re.search(without, name)]
    told: list[str] = []
    for name in names:
        if name in after:
            allowed = next((share for key, share in (loose or {}).items() if re.search(key, name)), tolerance)
            told += _difference(name, before[name], after[name], expected, allowed)
    return missing + told


def _difference(name: str, one: Leaf, other: Leaf, expected: Expected, tolerance: float) -> Iterator[str]:
    if isinstance(one.values, str) or isinstance(other.values, str):
        if str(one.values) != str(other.values):
            yield f"{name}: {one.values} and {other.values}"
        return
    wanted = expected(name, one.values, one.unit)
    if wanted.shape != other.values.shape:
        yield f"{name}: {wanted.shape} and {other.values.shape} values"
        return
    if not wanted.size:
        return
    blank = np.isnan(wanted)
    if not np.array_equal(blank, np.isnan(other.values)):
        yield f"{name}: gaps differ"
        return
    # the expectation may rescale a unit, and so its scale
    scale = max(one.scale, 0.0) * _factor(wanted, one.values)
    off = np.abs(other.values - wanted)[~blank].max(initial=0.0)
    if not off <= tolerance * max(scale, other.scale):
        place = int(np.nanargmax(np.abs(other.values - wanted)))
        yield (
            f"{name}: {wanted.flat[place]:.12g} and {other.values.flat[place]:.12g}"
            f" ({off / max(scale, other.scale):.1e} of {max(scale, other.scale):.3g})"
        )


def _factor(wanted: FloatArray, given: FloatArray) -> float:
    """Return the largest wanted value divided by the largest given value, or 1 if all given values are zero."""
    before, after = _largest(given), _largest(wanted)
    return after / before if before > 0.0 else 1.0


def _largest(values: FloatArray) -> float:
    return float(np.abs(values[~np.isnan(values)]).max(initial=0.0))


def _part(name: str) -> str:
    return name.partition(".")[0]


def _walk(value: Any, name: str, outer: Quantity | None, found: dict[str, Leaf]) -> None:
    if is_dataclass(value):
        kind: Any = type(value)
        for own, declared in quantities(kind).items():
            known = outer if outer and declared.unit is None else declared
            _walk(getattr(value, own), f"{name}.{own}".lstrip("."), known, found)
        if hasattr(value, "warnings"):
            codes = ", ".join(sorted(notice.code for notice in value.warnings))
            found[f"{name}.warnings".lstrip(".")] = Leaf(codes, None, 0.0)
        return
    unit = outer.unit if outer else None
    match value:
        case None | str() | bool():
            found[name] = Leaf(str(value), unit, 0.0)
        case np.ndarray() if value.dtype.kind in "fiu":
            found[name] = Leaf(np.asarray(value, dtype=float), unit, 0.0)
        case float() | int() | np.floating() | np.integer():
            found[name] = Leaf(np.array([value], dtype=float), unit, 0.0)
        case tuple() | list() if value and all(isinstance(item, int | float) for item in value):
            found[name] = Leaf(np.array(value, dtype=float), unit, 0.0)
        case tuple() | list():
            for place, item in enumerate(value):
                _walk(item, f"{name}.{place}".lstrip("."), outer, found)
        case _:
            found[name] = Leaf(str(value), unit, 0.0)
