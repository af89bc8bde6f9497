"""The single values of requests and answers that a study names by their dotted paths."""

from collections.abc import Iterable
from dataclasses import replace
from difflib import get_close_matches
from typing import Any

from app.contract.fields import ITEM, Leaf, leaf_at, leaves
from app.contract.quantities import Documented
from app.studies.errors import StudyRefused
from app.studies.requests import Scalar

Fault = tuple[str, str]


def scalar_at(model: type[Documented], path: str, pointer: str, unknown: str) -> Leaf:
    """The leaf of a request or answer that holds one value at this path.

    Raises StudyRefused `not_scalar` for sections, lists and matrices, `unknown` for what there is not.
    """
    leaf = leaf_at(model, path) or _item_of_list(model, path)
    if leaf is None:
        known = [each.path for each in leaves(model)]
        if any(name.startswith(f"{path}.") for name in known):
            raise StudyRefused(pointer, "not_scalar", f"{path} is a section, not a single value; name one of its fields")
        raise StudyRefused(pointer, unknown, f"there is no {path}{did_you_mean(path, known)}")
    if not leaf.is_scalar:
        raise StudyRefused(pointer, "not_scalar", f"{path} is a list, not a single value; name one of its places")
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


def fault(leaf: Leaf, value: Scalar) -> Fault | None:
    """Code and message of why the field's schema does not take a value; None where it does."""
    if value is None:
        return None if leaf.nullable else ("out_of_range", "null is not allowed here")
    if leaf.options:
        allowed = ", ".join(map(str, leaf.options))
        return None if value in leaf.options else ("out_of_range", f"one of {allowed} is allowed")
    match leaf.kind:
        case "boolean":
            return None if isinstance(value, bool) else ("out_of_range", "true or false is allowed")
        case "number" | "integer":
            return _number_fault(leaf, value)
        case _:
            return None if isinstance(value, str) else ("out_of_range", "text is allowed")


def _number_fault(leaf: Leaf, value: Scalar) -> Fault | None:
    if isinstance(value, bool | str) or value is None:
        return "out_of_range", "a number is allowed"
    if leaf.kind == "integer" and value != int(value):
        return "not_integer", f"{value:g} is not a whole number"
    bounds = leaf.bounds
    inside = (
        value >= bounds.get("ge", value)
        and value <= bounds.get("le", value)
        and not value <= bounds.get("gt", -float("inf"))
        and not value >= bounds.get("lt", float("inf"))
    )
    return None if inside else ("out_of_range", f"{value:g} is outside {_range(bounds)}")


def _range(bounds: dict[str, float]) -> str:
    words = {"ge": "at least", "gt": "above", "le": "at most", "lt": "below"}
    return " and ".join(f"{words[key]} {bound:g}" for key, bound in bounds.items())


def read(answer: Any, path: str) -> Any:
    """The value at a dotted path of a response; None where a group on the way is missing."""
    for part in path.split("."):
        if answer is None:
            return None
        answer = answer[int(part)] if part.isdecimal() else getattr(answer, part)
    return answer


def write(body: dict[str, Any], path: str, value: Scalar) -> None:
    """Set the value at a dotted path of a request, sections on the way made where they are missing."""
    *way, last = path.split(".")
    place: Any = body
    for part in way:
        if part.isdecimal():
            place = place[int(part)]
        else:
            if place.get(part) is None:
                place[part] = {}
            place = place[part]
    if last.isdecimal():
        place[int(last)] = value
    else:
        place[last] = value


def clear(body: dict[str, Any], path: str) -> None:
    """Take a field out of a request, if it is there."""
    *way, last = path.split(".")
    place: Any = body
    for part in way:
        place = place[int(part)] if part.isdecimal() else place.get(part)
        if place is None:
            return
    place.pop(last, None)
