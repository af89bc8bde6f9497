"""Access to single values of requests and answers. A study names a single value by the dotted path of its field."""

import operator
from dataclasses import replace
from math import inf, isfinite
from typing import Any

from app.errors import Unprocessable
from app.schema.fields import ITEM, Leaf, leaf_at, leaves, pattern_of, value_at
from app.schema.model import Documented
from app.schema.reading import did_you_mean
from app.studies.requests import Scalar
from solvers.quantity import allowed

NUMBERS = frozenset({"number", "integer"})
INSIDE = 1e-3  # distance of a default end from a bound that is not itself permissible, as a share of the range


def scalar_at(model: type[Documented], path: str, place: str, unknown: str) -> Leaf:
    """Return the `Leaf` that describes the single value at a path of a request or answer.

    Raises Unprocessable with the code `not_scalar` if the path names a section or a list, and with the code `unknown`
    if the path does not exist. `place` is the field of the study's body that contains the path; the error names this
    field.
    """
    leaf = leaf_at(model, path)
    whole, _, item = path.rpartition(".")
    if leaf is None and item.isdecimal() and (listed := leaf_at(model, whole)) and listed.dimensions == 1:
        leaf = replace(listed, dimensions=0, nullable=False)
    if leaf is None:
        paths = [other.path for other in leaves(model)]
        if any(name.startswith(f"{pattern_of(path)}.") for name in paths):
            message = f"{path} is a section and not a single value; name one of the fields in the section"
            raise Unprocessable("not_scalar", message, place)
        raise Unprocessable(unknown, f"there is no {path}{did_you_mean(path, paths)}", place)
    if leaf.kind == "other":
        raise Unprocessable("not_scalar", f"{path} is not a single value", place)
    if not leaf.is_scalar:
        message = f"{path} is a list and not a single value"
        if leaf.dimensions == 1:
            message += f"; name one of the values in the list, such as {path}.0"
        raise Unprocessable("not_scalar", message, place)
    return replace(leaf, path=path)


def not_a_number(leaf: Leaf) -> str | None:
    """Return a message that says what the field holds instead of a number; None if the field holds a number."""
    if leaf.options:
        return f"{leaf.path} is an option ({', '.join(map(str, leaf.options))}), not a number"
    if leaf.kind in NUMBERS:
        return None
    holds = "either true or false" if leaf.kind == "boolean" else "text"
    return f"{leaf.path} is {holds}, not a number"


def fault(leaf: Leaf, value: Scalar) -> tuple[str, str] | None:
    """Code and the message of the error if a field rejects a value. Return None if the field accepts the value."""
    code = "out_of_range"
    if value is None:
        wrong, message = not leaf.nullable, "null is not accepted here"
    elif leaf.options:
        wrong, message = value not in leaf.options, f"must be one of {', '.join(map(str, leaf.options))}"
    elif leaf.kind == "boolean":
        wrong, message = not isinstance(value, bool), "give true or false"
    elif leaf.kind not in NUMBERS:
        wrong, message = not isinstance(value, str), "give text"
    elif isinstance(value, bool | str):
        wrong, message = True, "give a number"
    elif leaf.kind == "integer" and value != int(value):
        wrong, code, message = True, "not_integer", f"{value:g} is not a whole number"
    else:
        wrong = not all(getattr(operator, name)(value, bound) for name, bound in leaf.declared.bounds.items())
        message = f"{value:.12g} is out of range; permissible: {allowed(leaf.declared)}"
    return (code, message) if wrong else None


def whole_range(leaf: Leaf) -> tuple[float, float]:
    """Return the ends of the permissible range of a field; infinite where it has none."""
    bounds = leaf.declared.bounds
    low, high = bounds.get("ge", bounds.get("gt", -inf)), bounds.get("le", bounds.get("lt", inf))
    margin = INSIDE * (high - low) if isfinite(high - low) else INSIDE
    return low + margin * ("gt" in bounds), high - margin * ("lt" in bounds)


def check_value(leaf: Leaf, value: Scalar, place: str) -> None:
    """Raise Unprocessable if the field does not accept the value."""
    if reason := fault(leaf, value):
        code, message = reason
        raise Unprocessable(code, f"{leaf.path}: {message}", place)


def is_number(value: Any) -> bool:
    """Return True if a value can be compared with numbers. A boolean counts as a number, because true equals 1."""
    return isinstance(value, int | float)


def set_value(model: type[Documented], body: dict[str, Any], path: str, value: Scalar) -> None:
    """Set the value at a dotted path of a request.

    Missing sections on the path are inserted empty. Missing lists on the path are inserted with their default items.
    If the path does not fit the request, the value is not set; the later validation of the request reports the error.
    Raises IndexError if a list on the path is too short.
    """
    parts = path.split(".")
    here: Any = body
    for place, part in enumerate(parts):
        if isinstance(here, list) != part.isdecimal() or not isinstance(here, list | dict):
            return
        key: Any = int(part) if isinstance(here, list) else part
        if place == len(parts) - 1:
            here[key] = value
        elif isinstance(here, dict) and here.get(part) is None:
            leaf = leaf_at(model, ".".join(parts[: place + 1]))
            given = list(leaf.default) if leaf is not None and isinstance(leaf.default, list) else []
            here[part] = given if parts[place + 1].isdecimal() else {}
            here = here[part]
        else:
            here = here[key]


def clear_excluded(model: type[Documented], body: dict[str, Any], path: str) -> None:
    """Remove from the request `body` the fields that must not be given together with the field at `path`."""
    leaf, own = leaf_at(model, path), path.split(".")
    for excluded in leaf.exclusive if leaf else ():
        *section, name = [own[place] if part == ITEM else part for place, part in enumerate(excluded.split("."))]
        here = value_at(body, ".".join(section)) if section else body
        if isinstance(here, dict):
            here.pop(name, None)


def is_plain_number(value: Any) -> bool:
    """Return whether a value is a number; true and false are not numbers."""
    return isinstance(value, int | float) and not isinstance(value, bool)


def indexed(path: str, case: dict[str, Any]) -> list[str]:
    """Replace every list marker in a path by the indices of the list, and return the resulting paths.

    A path without a marker is returned unchanged.
    """
    before, star, after = path.partition(f".{ITEM}")
    if not star:
        return [path]
    items = range(len(value_at(case, before) or ()))
    return [place for index in items for place in indexed(f"{before}.{index}{after}", case)]
