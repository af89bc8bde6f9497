"""Reading and validation of request bodies. If a body is not valid, messages explain the faults in plain words.

Messages repeat only three kinds of input: numbers, texts that consist of a number, and field names of at most 40
characters.
"""

import json
import re
from collections import Counter
from collections.abc import Iterable
from difflib import get_close_matches
from itertools import islice
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from app.errors import Fault, InvalidBody, Unreadable, pointer, printable
from app.schema.model import kinds
from app.schema.quantities import meaning_of
from solvers.quantity import UNITS, Quantity, advice, allowed

M = TypeVar("M", bound=BaseModel)
Models = tuple[type[BaseModel], ...]
MOST_MEMBERS = 1000  # largest number of fields per object; chosen: far more than a section has
MOST_OBJECTS = 10_000  # largest number of objects per body; chosen: far more than the largest study needs
MOST_FAULTS = 100  # largest number of faults in one answer; chosen: nobody corrects more at once
_NAME = re.compile(r"[A-Za-z0-9_]{1,40}")
_NUMBER = re.compile(r"[+-]?\d{1,20}([.,]\d{1,20})?")
_RANGE = re.compile(r"\s*(\d{1,20}(?:[.,]\d{1,20})?)\s*(?:-|\u2013|\u2212|\.\.\.?|to)\s*(\d{1,20}(?:[.,]\d{1,20})?)\s*")
_RANGE_TYPES = {"greater_than", "greater_than_equal", "less_than", "less_than_equal"}
_NUMBER_TYPES = {"float_type", "int_type"}
_SECTION_TYPES = {"model_type", "model_attributes_type", "dict_type", "dataclass_type"}


def content_of(body: bytes) -> Any:
    """Return the content of a JSON body.

    Raises InvalidBody if the body is empty, is not valid JSON, or has more objects or fields than any request needs.
    Raises Unreadable if a name occurs twice in one object, or if the body cannot be decoded.
    """
    objects = 0

    def members_of(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        nonlocal objects
        objects += 1
        if objects > MOST_OBJECTS:
            message = f"the body contains too many objects; at most {MOST_OBJECTS} are allowed"
            raise InvalidBody([Fault("", "too_many_objects", message)])
        if len(pairs) > MOST_MEMBERS:
            message = f"an object of the body contains too many fields; at most {MOST_MEMBERS} are allowed"
            raise InvalidBody([Fault("", "too_many_fields", message)])
        content = dict(pairs)
        if len(content) < len(pairs):
            name, _ = Counter(name for name, _ in pairs).most_common(1)[0]
            raise Unreadable(f"The name '{printable(name)}' occurs twice in one object of the body")
        return content

    if not body:
        raise InvalidBody([Fault("", "missing", "the request needs a body")])
    try:
        return json.loads(body, object_pairs_hook=members_of)
    except json.JSONDecodeError as error:
        message = f"the body is not valid JSON: {error.msg} at position {error.pos}"
        raise InvalidBody([Fault("", "json_invalid", message)]) from None
    except (ValueError, RecursionError):  # not UTF-8, too many digits in a number, or too many brackets
        raise Unreadable("The body cannot be read as JSON") from None


def validated(model: type[M], content: Any) -> M:
    """Return `content` as a request of type `model`; raise InvalidBody if `content` is not a valid request."""
    try:
        return model.model_validate(content)
    except ValidationError as error:
        items = error.errors(include_url=False)
        raise InvalidBody(faults(model, items, content)) from None  # type: ignore[arg-type]


def faults(model: type[BaseModel], items: Iterable[dict[str, Any]], content: Any = None) -> list[Fault]:
    """Return the faults that pydantic reported for the body `content`, at most a hundred.

    `items` are the errors of pydantic. The locations in these errors start at `model`.
    """
    field_faults = []
    for item in islice(items, MOST_FAULTS):
        place, sections = _located(model, item["loc"])
        place = _sent(place, content)
        no_number = item["type"] in _NUMBER_TYPES and isinstance(item.get("input"), bool | str)
        code = "number_type" if no_number else str(item["type"])
        field_faults.append(Fault(pointer(place), code, _message(place, sections, item)))
    return field_faults


def _sent(place: list[str | int], content: Any) -> list[str | int]:
    """Return a location without the indices below a number that was sent, which stands for a whole matrix."""
    here = content
    for depth, part in enumerate(place):
        if isinstance(part, int) and isinstance(here, int | float):
            return place[:depth]
        try:
            here = here[part]
        except (KeyError, IndexError, TypeError):
            return place
    return place


def _located(model: type[BaseModel], location: tuple[str | int, ...]) -> tuple[list[str | int], Models]:
    """Return the location of a fault, and the sections that may hold the field at this location.

    If a field accepts several types, pydantic adds the name of a type to the location. These names are removed here.
    """
    kept: list[str | int] = []
    here: Models = (model,)
    for place, part in enumerate(location):
        last = place == len(location) - 1
        named = (section.model_fields.get(part) for section in here if isinstance(part, str))
        fields = [field for field in named if field]
        if isinstance(part, int) or fields or not here or last:
            kept.append(part)
        if fields and not last:
            inner = (kind for field in fields for kind, _ in kinds(field.annotation))
            here = tuple(kind for kind in inner if isinstance(kind, type) and issubclass(kind, BaseModel)) or here
    return kept, here


def _message(location: list[str | int], sections: Models, item: dict[str, Any]) -> str:
    """Return one sentence that says what to change."""
    kind, value = item["type"], item.get("input")
    name = next((part for part in reversed(location) if isinstance(part, str)), "")
    if kind == "extra_forbidden":
        return _unknown(str(location[-1]), sections)
    if kind == "missing":
        return f"{name} is required" if location else "the request needs a body"
    if kind in _NUMBER_TYPES:
        return _no_number(value) + _advice(sections, name, value)
    if kind in _SECTION_TYPES:
        return "leave the section out instead of null" if value is None else "give a section {...} of fields here"
    if kind in _RANGE_TYPES:
        return f"{name} is {_figure(value)}; permissible: {_allowed(sections, name)}{_advice(sections, name, value)}"
    context = {key: str(said).replace("'", "") for key, said in item.get("ctx", {}).items()}
    choices = context.get("expected", "").replace(" or ", ", ")
    plain = {
        "int_from_float": "give a whole number",
        "finite_number": "give a finite number",
        "bool_type": "give true or false",
        "list_type": "give a list [...] of values here",
        "string_type": "give text",
        "union_tag_not_found": f"{context.get('discriminator')} is required",
        "union_tag_invalid": f"{context.get('discriminator')}: must be one of {context.get('expected_tags')}",
        "literal_error": f"{name}: must be one of {choices}{_advice(sections, name, value)}",
        "enum": f"{name}: must be one of {choices}",
        "too_short": f"{name} needs at least {context.get('min_length')} values",
        "too_long": f"{name} takes at most {context.get('max_length')} values",
    }
    return plain.get(kind, str(item["msg"]))


def _unknown(name: str, sections: Models) -> str:
    """Return the message about an unknown field. If a known field has a similar name, suggest this name."""
    if not _NAME.fullmatch(name):
        return "unknown field"
    known = (field for section in sections for field in section.model_fields)
    return f"unknown field {name}{did_you_mean(name, known)}"


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Return a question that suggests the known name most similar to `name`; empty if none is similar."""
    near = get_close_matches(name, list(known), n=1)
    return f"; did you mean {near[0]}?" if near else ""


def _no_number(value: Any) -> str:
    if value is None:
        return "give a number, or leave the field out instead of null"
    if isinstance(value, bool):
        return "give a number, not true or false"
    if isinstance(value, int):  # this whole number is larger than any float
        return f"the number is {_figure(value)}"
    if isinstance(value, str) and (ends := _RANGE.fullmatch(value)):
        low, high = (end.replace(",", ".") for end in ends.groups())
        return f'give a number, not the range "{value}"; for a range enter two values: {low} and {high}'
    if isinstance(value, str) and _NUMBER.fullmatch(value):
        return f'give a number, not text: {value.replace(",", ".")} instead of "{value}"'
    return "give a number, not text" if isinstance(value, str) else "give a number here"


def _figure(value: Any) -> str:
    """Return a number as an engineer writes it. If the number is beyond the range of floats, return words."""
    try:
        return f"{float(value):.12g}"
    except OverflowError:  # a whole number of more than three hundred digits
        return "far too large" if value > 0 else "far too small"


def _declared(sections: Models, name: str) -> Quantity | None:
    """Return the declaration of the field `name`, or None if none of the sections has this field."""
    fields = (section.model_fields.get(name) for section in sections)
    return next((given for field in fields if field and (given := meaning_of(field.metadata))), None)


def _allowed(sections: Models, name: str) -> str:
    """Return the permissible range of a field, with the unit."""
    given = _declared(sections, name)
    if given is None:
        return "another range"
    return f"{allowed(given)} {UNITS[given.unit].symbol}" if given.unit else allowed(given)


def _advice(sections: Models, name: str, value: Any) -> str:
    """Return advice on what to give instead of `value`, or an empty text if there is no advice."""
    given = _declared(sections, name)
    return advice(given, value) if given else ""
