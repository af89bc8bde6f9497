"""The table of the chapter "Inputs and outputs": every field of every request and answer, read from their models."""

from collections import Counter
from collections.abc import Iterator
from functools import cache
from inspect import get_annotations
from types import NoneType
from typing import Any, NamedTuple, get_args, get_origin

from pydantic import BaseModel

from app.calculations import CALCULATIONS
from app.manual import FIELDS
from app.schema.fields import TYPES, options_of, walk
from app.schema.model import Member
from app.schema.quantities import Input, Output
from app.studies.kinds import KINDS
from solvers.quantity import allowed

COLUMNS = (
    *("field", "endpoints", "type", "unit", "range", "default", "symbol", "source", "meaning", "solver", "schema"),
)
SECTIONS = {
    "Requests": "The inputs of the calculations.",
    "Answers": "The results of the calculations.",
    "Studies": "The inputs of the studies. The field `request` contains a request of the endpoint that is studied.",
    "Service": "The answers of the other addresses.",
}

Models = tuple[tuple[str, type[BaseModel]], ...]
"""Endpoints, each with the model of its request or answer."""
REQUESTS: Models = tuple((each.path, each.request) for each in CALCULATIONS)


class FieldRow(NamedTuple):
    """A row of the table; backticks in a cell enclose code."""

    anchor: str  # on the page
    section: str
    cells: tuple[str, ...]  # under `COLUMNS`

    @property
    def path(self) -> str:
        """The dotted path of the field."""
        return self.cells[0].strip("`")

    @property
    def endpoints(self) -> list[str]:
        """The endpoints whose request or answer has the field."""
        return self.cells[1].split()


def table(others: Models) -> tuple[FieldRow, ...]:
    """Return the rows of the table; `others` are the answers of the addresses that calculate nothing."""
    answers = tuple((each.path, each.response) for each in CALCULATIONS)
    studies = tuple((kind.path, kind.model) for kind in KINDS)
    models = zip(SECTIONS, (REQUESTS, answers, studies, others), strict=True)
    return tuple(entry for section, some in models for entry in entries(section, some))


@cache
def entries(section: str, models: Models) -> tuple[FieldRow, ...]:
    """Return the rows of a section. Fields that differ only in their endpoints share a row."""
    found: dict[tuple[str, ...], dict[str, None]] = {}
    for endpoint, model in models:
        for place in walk(model):
            if not place.member.groups:
                found.setdefault((f"`{place.path}`", *_cells(place.member)), {})[endpoint] = None
    rows, places = list[FieldRow](), Counter[str]()
    for (path, *rest), endpoints in found.items():
        places[path] += 1
        number = f"-{places[path]}" if places[path] > 1 else ""
        anchor = f"{section.lower()}.{path.strip('`')}{number}"
        rows.append(FieldRow(anchor, section, (path, " ".join(endpoints), *rest)))
    return tuple(rows)


@cache
def _anchors() -> dict[tuple[str, str], str]:
    return {(endpoint, row.path): row.anchor for row in entries("Requests", REQUESTS) for endpoint in row.endpoints}


def address(endpoint: str, path: str) -> str:
    """Return the address of the row of a request's field, or an empty text if the field has no row."""
    anchor = _anchors().get((endpoint, path))
    return f"/manual/{FIELDS}#{anchor}" if anchor else ""


def _cells(field: Member) -> tuple[str, ...]:
    """Return the cells of a field's row that follow the path and the endpoints."""
    meaning = field.meaning
    declaring = next(base for base in field.model.__mro__ if field.name in get_annotations(base))
    return (
        _type(field),
        field.unit.symbol if field.unit else "",
        allowed(meaning) if isinstance(meaning, Input) else "",
        _default(field),
        meaning.symbol or "",
        meaning.source or "",
        meaning.title,
        _solver(meaning),
        f"`{declaring.__module__}.{declaring.__qualname__}`",
    )


def _type(field: Member) -> str:
    """Return the type of a field's values in words."""
    if Any in field.kinds:  # checked by a validator, which brings its own schema
        document = field.model.model_json_schema()["properties"][field.name]
        return " or ".join(dict.fromkeys(_words(document)))
    words = list[str]()
    for kind in field.kinds:
        plain = TYPES.get(kind, "object" if get_origin(kind) is dict or kind is dict else str(kind))
        words += [f"`{each}`" if isinstance(each, str) else str(each) for each in options_of(kind)] or [plain]
    text = ("", "list of ", "matrix of ")[field.dimensions] + " or ".join(dict.fromkeys(words))
    return f"{text} or null" if NoneType in get_args(field.info.annotation) else text


def _words(document: dict[str, Any]) -> Iterator[str]:
    """Yield the types that a JSON schema allows, in words."""
    for each in document.get("anyOf", [document]):
        match each.get("type"):
            case "array":
                yield from (f"list of {word}" for word in dict.fromkeys(_words(each["items"])))
            case "string":
                yield "path of a field" if "pattern" in each else "text"
            case kind:
                yield kind or "any"


def _default(field: Member) -> str:
    """Return the default of an input in the unit of the field; empty for an output."""
    if isinstance(field.meaning, Output):
        return ""
    if field.info.is_required():
        return "required"
    value = field.info.get_default(call_default_factory=True)
    stated = field.meaning.default_text
    if value is None:
        return f"null: {stated}" if stated else "null"
    if isinstance(value, list | dict):
        return f"`{value}`" if value else "empty"
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:.12g}" if isinstance(value, int | float) else f"`{value}`"


def _solver(meaning: Input | Output) -> str:
    """Return the dotted name of the solver's attribute, in the class that declares it; empty if there is none."""
    if meaning.origin is None:
        return ""
    record, name = meaning.origin
    owner: Any = next(base for base in record.__mro__ if name in get_annotations(base) or name in vars(base))
    return f"`{owner.__module__}.{owner.__qualname__}.{name}`"
