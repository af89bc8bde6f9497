"""The single values of requests and answers that a study names by their dotted paths."""

import operator
from collections.abc import Callable, Iterable
from dataclasses import replace
from difflib import get_close_matches
from functools import lru_cache
from typing import Any, NamedTuple

from app.errors import Unprocessable
from app.schema.fields import ITEM, Leaf, leaf_at, leaves
from app.schema.model import Documented
from app.studies.requests import Scalar

NUMBERS = frozenset({"number", "integer"})


class _Bound(NamedTuple):
    """A kind of bound: whether a value keeps it, and in words."""

    holds: Callable[[float, float], bool]
    words: str


BOUNDS = {
    "ge": _Bound(operator.ge, "at least"),
    "gt": _Bound(operator.gt, "above"),
    "le": _Bound(operator.le, "at most"),
    "lt": _Bound(operator.lt, "below"),
}


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
        return None if leaf.nullable else ("out_of_range", "null is not allowed here")
    if leaf.options:
        allowed = ", ".join(map(str, leaf.options))
        return None if value in leaf.options else ("out_of_range", f"allowed are {allowed}")
    if leaf.kind in NUMBERS:
        return _number_fault(leaf, value)
    kind, message = (bool, "give true or false") if leaf.kind == "boolean" else (str, "give text")
    return None if isinstance(value, kind) else ("out_of_range", message)


def _number_fault(leaf: Leaf, value: bool | float | str) -> tuple[str, str] | None:
    if isinstance(value, bool | str):
        return "out_of_range", "give a number"
    if leaf.kind == "integer" and value != int(value):
        return "not_integer", f"{value:g} is not a whole number"
    bounds = leaf.declared.bounds
    if all(BOUNDS[key].holds(value, bound) for key, bound in bounds.items()):
        return None
    allowed = " and ".join(f"{BOUNDS[key].words} {bound:g}" for key, bound in bounds.items())
    return "out_of_range", f"{value:g} is not {allowed}"


def value_at(answer: Any, path: str) -> Any:
    """The value at a dotted path of an answer; None where a group or a place on the way is missing."""
    for part in path.split("."):
        if answer is None:
            return None
        if isinstance(answer, list | tuple):
            answer = answer[int(part)] if int(part) < len(answer) else None
        else:
            answer = answer.get(part) if isinstance(answer, dict) else getattr(answer, part)
    return answer


def is_reachable(model: type[Documented], body: dict[str, Any], path: str) -> bool:
    """Whether a value can be set at this path: the lists on the way, given or by default, are long enough.

    What is no section where one belongs is left to the request's own validation.
    """
    here: Any = body
    parts = path.split(".")
    for place, part in enumerate(parts):
        if part.isdecimal():
            if here is None:
                here = _default_list(model, parts[:place])
            if here is None or (isinstance(here, list) and int(part) >= len(here)):
                return False
            here = here[int(part)] if isinstance(here, list) else {}
        else:
            here = here.get(part) if isinstance(here, dict) else None
    return True


def set_value(model: type[Documented], body: dict[str, Any], path: str, value: Scalar) -> None:
    """Set the value at a dotted path of a request; sections and lists left to their defaults are filled in."""
    *way, last = path.split(".")
    here: Any = body
    for place, part in enumerate(way, start=1):
        if isinstance(here, dict) and here.get(part) is None:
            here[part] = _default_list(model, way[:place]) or {}
        here = _step(here, part)
    if isinstance(here, list):
        here[int(last)] = value
    elif isinstance(here, dict):
        here[last] = value


def _default_list(model: type[Documented], way: list[str]) -> list[Any] | None:
    """The list of values that a field holds where nothing is given; None where it is no such list."""
    leaf = leaf_at(model, ".".join(way))
    return list(leaf.default) if leaf is not None and isinstance(leaf.default, list) else None


def clear(body: dict[str, Any], path: str) -> None:
    """Take a field out of a request, if it is there."""
    *way, last = path.split(".")
    here: Any = body
    for part in way:
        here = _step(here, part)
    if isinstance(here, dict):
        here.pop(last, None)


def _step(here: Any, part: str) -> Any:
    """One step down a request; None where it has another shape."""
    if isinstance(here, list):
        return here[int(part)] if part.isdecimal() else None
    return here.get(part) if isinstance(here, dict) else None


@lru_cache(maxsize=1024)
def excluded_by(model: type[Documented], path: str) -> tuple[str, ...]:
    """The fields that a given value of this one excludes, with its own list indices."""
    leaf, own = leaf_at(model, path), path.split(".")
    return tuple(
        ".".join(own[place] if part == ITEM else part for place, part in enumerate(each.split(".")))
        for each in (leaf.exclusive if leaf else ())
    )
