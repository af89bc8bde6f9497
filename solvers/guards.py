"""Guards of a solver: reject inputs outside their declared ranges, and warn of unusual inputs.

Each model defines its warnings about unusual inputs. Such a warning names the input and the likely mistake, for example
a wrong unit.
"""

from collections.abc import Callable, Iterator
from dataclasses import fields, is_dataclass, replace
from functools import cache, wraps
from typing import Any, Concatenate, NamedTuple, ParamSpec, TypeVar, cast

import numpy as np

from solvers.errors import InvalidInput
from solvers.notices import Notice
from solvers.quantity import UNITS, Quantity, advice, allowed, quantities

I = TypeVar("I")
P = ParamSpec("P")
R = TypeVar("R")
T = TypeVar("T")


def guarded(
    solve: Callable[Concatenate[I, P], R], unusual: Callable[[I, R], Iterator[Notice]]
) -> Callable[Concatenate[I, P], R]:
    """Return a solver that rejects inputs outside their declared ranges and warns of unusual values."""

    @wraps(solve)
    def guarded_solve(inputs: I, /, *args: P.args, **kwargs: P.kwargs) -> R:
        result = solve(checked(inputs), *args, **kwargs)
        warnings = tuple(unusual(inputs, result))
        if not warnings:
            return result
        dataclass_result: Any = result
        return cast("R", replace(dataclass_result, warnings=(*dataclass_result.warnings, *warnings)))

    return guarded_solve


def checked(inputs: T, prefix: str = "") -> T:
    """`inputs`, or InvalidInput `out_of_range` with the first field outside its declared range.

    For inputs built in Python; the service checks requests when they arrive.
    """
    kind: Any = type(inputs)
    for name, ends in _ranges(kind):
        value = getattr(inputs, name)
        if value is None:
            continue
        if isinstance(value, tuple):
            for place, item in enumerate(value):
                _check(item, ends, f"{prefix}{name}.{place}")
        else:
            _check(value, ends, prefix + name)
    return inputs


class _Ends(NamedTuple):
    least: float
    greatest: float
    declared: Quantity


@cache
def _ranges(kind: Any) -> tuple[tuple[str, _Ends | None], ...]:
    """Return the name and the range of every field of a dataclass; the range is None if no range is declared."""
    declared = quantities(kind)
    return tuple((item.name, _ends(declared[item.name]) if item.name in declared else None) for item in fields(kind))


def _ends(declared: Quantity) -> _Ends:
    inside = {end: declared.to_si(float(bound)) for end, bound in declared.bounds.items()}
    above, below = inside.get("gt", -np.inf), inside.get("lt", np.inf)
    return _Ends(
        inside.get("ge", np.nextafter(above, np.inf)), inside.get("le", np.nextafter(below, -np.inf)), declared
    )


def _check(value: Any, ends: _Ends | None, name: str) -> None:
    if isinstance(value, float | int):
        if ends is not None and not ends.least <= value <= ends.greatest:
            unit = f" {UNITS[ends.declared.unit].symbol}" if ends.declared.unit else ""
            shown = f"{ends.declared.from_si(float(value)):.12g}{unit}"
            message = f"{name} is {shown}; permissible: {allowed(ends.declared) or 'finite numbers'}{unit}"
            message += advice(ends.declared, ends.declared.from_si(float(value)))
            raise InvalidInput("out_of_range", message, name)
    elif is_dataclass(value):
        checked(value, f"{name}.")
