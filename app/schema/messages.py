"""What is wrong with a request, field by field, in an engineer's words.

Numbers, digit-only text and field names of at most 40 letters may be repeated; nothing else of the input is.
"""

import re
from collections.abc import Iterable
from difflib import get_close_matches
from typing import Any

from pydantic import BaseModel

from app.errors import Fault, pointer
from app.schema.conversion import group_of
from app.schema.model import Documented
from app.schema.quantities import Input
from solvers.quantity import allowed

MOST_FAULTS = 100
_NAME = re.compile(r"[A-Za-z0-9_]{1,40}")
_NUMBER = re.compile(r"[+-]?\d{1,20}([.,]\d{1,20})?")
_RANGE_TYPES = {"greater_than", "greater_than_equal", "less_than", "less_than_equal"}
_NUMBER_TYPES = {"float_type", "int_type", "float_parsing", "int_parsing", "number_type"}
_SECTION_TYPES = {"model_type", "model_attributes_type", "dict_type", "dataclass_type"}


def faults(model: type[BaseModel], items: Iterable[dict[str, Any]]) -> list[Fault]:
    """The faults that a validation of `model` found, at most a hundred; items are pydantic's, their loc within it."""
    found = []
    for item, _ in zip(items, range(MOST_FAULTS), strict=False):
        loc = _fields_only(model, item["loc"])
        found.append(Fault(pointer(loc), str(item["type"]), _message(model, loc, item)))
    return found


def _fields_only(model: type[BaseModel], location: tuple[str | int, ...]) -> tuple[str | int, ...]:
    """The location without the names of the types that a value could have had."""
    kept: list[str | int] = []
    here: type[BaseModel] | None = model
    for place, part in enumerate(location):
        last = place == len(location) - 1
        if isinstance(part, int) or here is None or last or part in here.model_fields:
            kept.append(part)
            if here is not None and isinstance(part, str) and part in here.model_fields:
                here = group_of(here.model_fields[part].annotation)
    return tuple(kept)


def _section(model: type[BaseModel], location: tuple[str | int, ...]) -> type[BaseModel] | None:
    """The section that holds the field at a location."""
    here: type[BaseModel] | None = model
    for part in location[:-1]:
        if isinstance(part, str):
            here = group_of(here.model_fields[part].annotation) if here and part in here.model_fields else None
    return here


def _message(model: type[BaseModel], location: tuple[str | int, ...], item: dict[str, Any]) -> str:
    """The one sentence that says what to change."""
    kind, value, section = item["type"], item.get("input"), _section(model, location)
    name = next((part for part in reversed(location) if isinstance(part, str)), "")
    if kind == "extra_forbidden":
        return _unknown(str(location[-1]), section)
    if kind == "missing":
        return f"{name} is required" if location else "the request needs a body"
    if kind in _NUMBER_TYPES:
        return _no_number(value)
    if kind in _SECTION_TYPES:
        return "leave the section out instead of null" if value is None else "give a section {...} of fields here"
    if kind in _RANGE_TYPES:
        return f"{name} is {_figure(value)}; allowed {_allowed(section, name)}"
    plain = {
        "int_from_float": "give a whole number",
        "finite_number": "give a finite number",
        "bool_type": "give true or false",
        "list_type": "give a list [...] of values here",
        "string_type": "give text",
        "literal_error": f"{name}: allowed are {_choices(item)}",
        "enum": f"{name}: allowed are {_choices(item)}",
        "too_short": f"{name} needs at least {item.get('ctx', {}).get('min_length')} values",
        "too_long": f"{name} takes at most {item.get('ctx', {}).get('max_length')} values",
    }
    return plain.get(kind, str(item["msg"]))


def _unknown(name: str, section: type[BaseModel] | None) -> str:
    """An unknown field, and the one that was meant."""
    if not _NAME.fullmatch(name):
        return "unknown field"
    near = get_close_matches(name, section.model_fields if section else (), n=1, cutoff=0.6)
    return f"unknown field {name}" + (f"; did you mean {near[0]}?" if near else "")


def _no_number(value: Any) -> str:
    if value is None:
        return "give a number, or leave the field out instead of null"
    if isinstance(value, bool):
        return "give a number, not true or false"
    if isinstance(value, str) and _NUMBER.fullmatch(value):
        return f'give a number, not text: {value.replace(",", ".")} instead of "{value}"'
    return "give a number, not text" if isinstance(value, str) else "give a number here"


def _figure(value: Any) -> str:
    """A number as an engineer writes it."""
    try:
        return f"{float(value):.12g}"
    except OverflowError:  # a whole number of more than three hundred digits
        return "far too large" if value > 0 else "far too small"


def _choices(item: dict[str, Any]) -> str:
    return str(item.get("ctx", {}).get("expected", "")).replace("'", "").replace(" or ", ", ")


def _allowed(section: type[BaseModel] | None, name: str) -> str:
    """The range of a field with its unit."""
    field = section.model_fields.get(name) if section else None
    given = next((item for item in field.metadata if isinstance(item, Input)), None) if field else None
    if given is None or section is None or not issubclass(section, Documented):
        return "is another range"
    unit = section.unit_of(name)
    return f"{allowed(given)} {unit.symbol}" if unit else allowed(given)
