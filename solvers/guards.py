"""Guards of a solver: values outside their declared range are refused, unusual ones are warned of.

The warnings of unusual values stand in the `notices` of each model. They name the input and the likely mistake, often a
wrong unit.
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
    """The solver as users call it: inputs outside their declared ranges are refused, unusual values warned of.

    Raises InvalidInput (out_of_range) with the dotted name of the field, beside what the solver raises.
    """

    @wraps(solve)
    def solved(inputs: I, /, *args: P.args, **kwargs: P.kwargs) -> R:
        result = solve(checked(inputs), *args, **kwargs)
        found = tuple(unusual(inputs, result))
        if not found:
            return result
        known: Any = result
        return cast("R", replace(known, warnings=(*known.warnings, *found)))

    return solved


def checked(inputs: T, prefix: str = "") -> T:
    """The inputs, a dataclass, with every declared number inside its range.

    For inputs built in Python; those that come by HTTP have been checked on arrival. Raises `InvalidInput` with the
    code `out_of_range` and the dotted name of the first field at fault.
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
    """The least and the greatest value allowed in SI, and the declaration that says so."""

    least: float
    greatest: float
    declared: Quantity


@cache
def _ranges(kind: Any) -> tuple[tuple[str, _Ends | None], ...]:
    """The range of every field of a dataclass, None for those without one."""
    declared = quantities(kind)
    return tuple((each.name, _ends(declared[each.name]) if each.name in declared else None) for each in fields(kind))


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
            message = f"{name} is {shown}; permissible {allowed(ends.declared) or 'are finite numbers'}{unit}"
            message += advice(ends.declared, ends.declared.from_si(float(value)))
            raise InvalidInput("out_of_range", message, name)
    elif is_dataclass(value):
        checked(value, f"{name}.")
