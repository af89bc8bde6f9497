"""Inputs changed at dotted names, and results read at dotted names, for the studies."""

from collections.abc import Mapping
from dataclasses import fields, is_dataclass, replace
from typing import Any

from solvers.drive_train.inputs import DriveTrainInputs
from solvers.errors import InvalidInput


def varied(inputs: DriveTrainInputs, values: Mapping[str, Any]) -> DriveTrainInputs:
    """The inputs with other values at dotted names ("couplings.0.friction.coefficient").

    Raises InvalidInput unknown_name for a name that is none.
    """
    for name, value in values.items():
        inputs = _replaced(inputs, name.split("."), value, name)
    return inputs


def value_at(thing: Any, name: str) -> Any:
    """What stands at a dotted name; None where something on the way is None. Raises InvalidInput unknown_name."""
    for step in name.split("."):
        if thing is None:
            return None
        thing = _part(thing, step, name)
    return thing


def _replaced(thing: Any, steps: list[str], value: Any, name: str) -> Any:
    if not steps:
        return value
    below = _replaced(_part(thing, steps[0], name), steps[1:], value, name)
    if isinstance(thing, tuple):
        index = int(steps[0])
        return (*thing[:index], below, *thing[index + 1 :])
    return replace(thing, **{steps[0]: below})


def _part(thing: Any, step: str, name: str) -> Any:
    if isinstance(thing, tuple) and step.isdigit() and int(step) < len(thing):
        return thing[int(step)]
    if is_dataclass(thing) and step in {item.name for item in fields(thing)}:
        return getattr(thing, step)
    raise InvalidInput("unknown_name", f"there is no {name}", name)
