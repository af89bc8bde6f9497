"""The single values of requests and answers that a study names by their dotted paths."""

import copy
import operator
from collections.abc import Iterable
from dataclasses import replace
from difflib import get_close_matches
from functools import lru_cache, reduce
from typing import Any

from app.errors import Unprocessable
from app.schema.fields import ITEM, Leaf, leaf_at, leaves
from app.schema.model import Documented
from app.studies.requests import Scalar
from solvers.quantity import allowed

NUMBERS = frozenset({"number", "integer"})


def scalar_at(model: type[Documented], path: str, place: str, unknown: str) -> Leaf:
    """The leaf of a request or answer that holds one value at this path.

    Raises Unprocessable at `place` of the study: `not_scalar` for sections and lists, `unknown` for what there is not.
    """
    leaf = leaf_at(model, path) or _item_of_list(model, path)
    if leaf is None:
        known = [each.path for each in leaves(model)]
        if any(name.startswith(f"{path}.") for name in known):
            raise Unprocessable("not_scalar", f"{path} is a section, not a single value; name one of its fields", place)
        raise Unprocessable(unknown, f"there is no {path}{did_you_mean(path, known)}", place)
    if leaf.kind == "other":
        raise Unprocessable("not_scalar", f"{path} is not a single value", place)
    if not leaf.is_scalar:
        raise Unprocessable("not_scalar", f"{path} is a list, not a single value", place)
    return replace(leaf, path=path)


def _item_of_list(model: type[Documented], path: str) -> Leaf | None:
    """The place of a list that the path's last part counts, as a leaf of its own."""
    whole, _, place = path.rpartition(".")
    leaf = leaf_at(model, whole) if place.isdecimal() else None
    return None if leaf is None or leaf.dimensions != 1 else replace(leaf, dimensions=0, nullable=False)


def did_you_mean(path: str, known: Iterable[str]) -> str:
    """The nearest known path as a question, or nothing."""
    near = get_close_matches(path, list(known), n=1)
    return f"; did you mean {near[0]}?" if near else ""


def fault(leaf: Leaf, value: Scalar) -> tuple[str, str] | None:
    """Code and message of why the field's schema does not take a value; None where it does."""
    if value is None:
        return None if leaf.nullable else ("out_of_range", "null is not accepted here")
    if leaf.options:
        allowed = ", ".join(map(str, leaf.options))
        return None if value in leaf.options else ("out_of_range", f"must be one of {allowed}")
    if leaf.kind in NUMBERS:
        return _number_fault(leaf, value)
    kind, message = (bool, "give true or false") if leaf.kind == "boolean" else (str, "give text")
    return None if isinstance(value, kind) else ("out_of_range", message)


def _number_fault(leaf: Leaf, value: bool | float | str) -> tuple[str, str] | None:
    if isinstance(value, bool | str):
        return "out_of_range", "give a number"
    if leaf.kind == "integer" and value != int(value):
        return "not_integer", f"{value:g} is not a whole number"
    if all(getattr(operator, name)(value, bound) for name, bound in leaf.declared.bounds.items()):
        return None
    return "out_of_range", f"{value:.12g} is out of range; permissible {allowed(leaf.declared)}"


def value_at(content: Any, path: str) -> Any:
    """The value at a dotted path of a request or answer; None where a section or a place on the way is missing."""
    return reduce(_step, path.split("."), content)


def _step(here: Any, part: str) -> Any:
    if isinstance(here, list | tuple):
        return here[int(part)] if part.isdecimal() and int(part) < len(here) else None
    return here.get(part) if isinstance(here, dict) else getattr(here, part, None)


def is_reachable(model: type[Documented], body: dict[str, Any], path: str) -> bool:
    """Whether a value can be set at this path: the lists on the way, given or by default, are long enough."""
    try:
        set_value(model, copy.deepcopy(body), path, None)
    except IndexError:
        return False
    return True


def set_value(model: type[Documented], body: dict[str, Any], path: str, value: Scalar) -> None:
    """Set the value at a dotted path of a request; sections and lists left to their defaults are filled in.

    Raises IndexError where a list is too short. What is neither section nor list where one belongs is left to the
    request's own validation.
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


def clear(body: dict[str, Any], path: str) -> None:
    """Take a field out of a request, if it is there."""
    section, _, name = path.rpartition(".")
    here = value_at(body, section) if section else body
    if isinstance(here, dict):
        here.pop(name, None)


@lru_cache(maxsize=1024)
def excluded_by(model: type[Documented], path: str) -> tuple[str, ...]:
    """The fields that a given value of this one excludes, with its own list indices."""
    leaf, own = leaf_at(model, path), path.split(".")
    return tuple(
        ".".join(own[place] if part == ITEM else part for place, part in enumerate(each.split(".")))
        for each in (leaf.exclusive if leaf else ())
    )
