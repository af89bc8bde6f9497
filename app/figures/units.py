"""Dataclasses of the solvers with their quantities in the units in which they are shown."""

from dataclasses import fields, is_dataclass
from functools import cache, partial
from typing import Any, TypeVar

from app.figures.data import Axis
from app.schema.fields import Leaf
from solvers.quantity import UNITS, Quantity, converted, quantities

T = TypeVar("T")
MM, UM, RPM = (UNITS[name].scale for name in ("mm", "um", "rpm"))
"""In SI."""


def shown(data: T) -> T:
    """A copy of a solver's dataclass, and of those inside it, whose declared values are in the units shown.

    Computed values that are declared are converted as well; other methods of the copy must not be used, because they
    would compute from values that are not in SI. What is not declared, and None, stays as it is.
    """
    converted: T = _converted(data, None)
    return converted


def axis(data: Any, name: str, title: str = "", **known: Any) -> Axis:
    """The axis of a quantity that a dataclass declares: its unit, its symbol, its title unless another is given."""
    declared = quantities(data if isinstance(data, type) else type(data))[name]
    unit = UNITS[declared.unit].symbol if declared.unit else None
    return Axis(title or declared.title, unit, **{"symbol": declared.symbol or "", **known})


def axis_of(leaf: Leaf, **known: Any) -> Axis:
    """The axis of a field of a request or of an answer."""
    return Axis(leaf.title, leaf.unit, symbol=leaf.declared.symbol or "", **known)


def _converted(value: Any, declared: Quantity | None) -> Any:
    """A value in its unit; `declared` is that of the field that holds it, which counts where one inside has none."""
    number = declared.from_si if declared else lambda number: number
    return converted(value, number, partial(_copied, declared=declared))


def _copied(value: Any, declared: Quantity | None) -> Any:
    """A copy of a dataclass with its values in their units; what else has no number stays."""
    if not is_dataclass(value) or isinstance(value, type):
        return value
    kind: Any = type(value)
    known = quantities(kind)
    copy = object.__new__(_plain(kind))
    for name in {*(each.name for each in fields(value)), *known}:
        own = known.get(name)
        inner = own if declared is None or (own is not None and own.unit is not None) else declared
        object.__setattr__(copy, name, _converted(getattr(value, name), inner))
    return copy


@cache
def _plain(kind: Any) -> Any:
    """A subclass with slots for what the dataclass computes."""
    computed = quantities(kind).keys() - {each.name for each in fields(kind)}
    return type(kind.__name__, (kind,), {"__slots__": tuple(computed), "__doc__": kind.__doc__})
