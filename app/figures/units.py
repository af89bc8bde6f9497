"""Conversion of the solvers' results into the units in which their quantities are shown."""

from dataclasses import fields, is_dataclass
from functools import cache, partial
from typing import Any, TypeVar

from app.figures.data import Axis
from app.schema.fields import Leaf
from solvers.quantity import UNITS, Quantity, converted, quantities

T = TypeVar("T")
MM, UM, RPM = (UNITS[name].scale for name in ("mm", "um", "rpm"))
"""One millimetre, one micrometre and one revolution per minute in SI units."""


def shown(data: T) -> T:
    """Return a copy of a solver's dataclass with all quantities in the units in which they are shown.

    Inner dataclasses and declared computed values are converted too. Undeclared values are copied unchanged. Do not
    call other methods of the copy: these methods expect SI units.
    """
    copy: T = _converted(data, None)
    return copy


def axis(data: Any, name: str, title: str = "", **options: Any) -> Axis:
    """Return the axis of a quantity that a dataclass declares."""
    declared = quantities(data if isinstance(data, type) else type(data))[name]
    unit = UNITS[declared.unit].symbol if declared.unit else None
    return Axis(title or declared.title, unit, **{"symbol": declared.symbol or "", **options})


def axis_of(leaf: Leaf, **options: Any) -> Axis:
    """Return the axis of a figure that shows the values of a field. The field belongs to a request or to an answer."""
    return Axis(leaf.title, leaf.unit, symbol=leaf.declared.symbol or "", **options)


def _converted(value: Any, declared: Quantity | None) -> Any:
    """Convert a value from SI into the unit that its field declares."""
    number = declared.from_si if declared else lambda number: number
    return converted(value, number, partial(_copied, declared=declared))


def _copied(value: Any, declared: Quantity | None) -> Any:
    """Return a copy of a dataclass with its values in the units shown. Return any other value unchanged."""
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
    """Return a subclass of a dataclass in which computed values are stored like fields."""
    computed = quantities(kind).keys() - {item.name for item in fields(kind)}
    return type(kind.__name__, (kind,), {"__slots__": tuple(computed), "__doc__": kind.__doc__})
