"""Read and change values of nested inputs by their dotted names."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, TypeVar

Inputs = TypeVar("Inputs")


def changed(inputs: Inputs, values: Mapping[str, Any]) -> Inputs:
    """Return the inputs with new values. The keys are dotted names, such as "couplings.0.friction.coefficient"."""
    for name, value in values.items():
        inputs = _replaced(inputs, name.split("."), value)
    return inputs


def scaled(inputs: Inputs, factor: float, *names: str) -> Inputs:
    """Return the inputs with the values at the dotted names multiplied by `factor`."""
    return changed(inputs, {name: factor * value_at(inputs, name) for name in names})


def value_at(thing: Any, name: str) -> Any:
    """Return the value at a dotted name. Numbers in the name are indices of tuples."""
    for step in name.split("."):
        thing = thing[int(step)] if isinstance(thing, tuple) else getattr(thing, step)
    return thing


def _replaced(thing: Any, steps: list[str], value: Any) -> Any:
    if not steps:
        return value
    below = _replaced(value_at(thing, steps[0]), steps[1:], value)
    if isinstance(thing, tuple):
        place = int(steps[0])
        return (*thing[:place], below, *thing[place + 1 :])
    return replace(thing, **{steps[0]: below})
