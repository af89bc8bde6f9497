"""Functions that write the chapter "Inputs and outputs" from the models of the service."""

from collections.abc import Callable, Iterator
from inspect import get_annotations
from types import NoneType
from typing import Any, Literal, NamedTuple, get_args, get_origin

from fastapi.routing import APIRoute
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from app.calculations import CALCULATIONS
from app.http.routes import calculations, rexs, service
from app.manual.fields import COLUMNS, SECTIONS
from app.pages.study_kinds import study_pages
from app.schema.fields import ITEM
from app.schema.model import kinds
from app.schema.quantities import Input, Output, meaning_of
from solvers.quantity import UNITS, allowed

HEAD = """# Inputs and outputs

This chapter lists every field of every request and answer, with its unit, its range, and the place where it is \
declared.

The name of a field ends with its unit. A `*` in a path stands for the position in a list. If several endpoints share \
the path and the declaration of a field, these endpoints share a row. The column `solver` names an attribute of the \
solvers, in SI units. To see how an output is computed, search for the line that sets this attribute. For example, the \
line with `allowable_misalignment=` in the named package computes `limits.allowable_misalignment_deg`. If the column \
`solver` is empty, the service itself makes the value, in the class named in the column `schema`. The lines of studies \
are described in [their section](service.md#studies).
"""
WORDS: dict[Any, str] = {float: "number", int: "integer", bool: "boolean", str: "text", Any: "any"}


class Field(NamedTuple):
    """A field that contains a value, and not a section.

    `path` is its dotted path, and `model` is the class that declares the field. `meaning` is None if the field is
    declared neither as an input nor as an output.
    """

    path: str
    model: type[BaseModel]
    name: str
    info: FieldInfo
    meaning: Input | Output | None
    lists: int
    kinds: tuple[Any, ...]


def fields_of(model: type[BaseModel], above: str = "") -> Iterator[Field]:
    """Yield every field of a model and of the models inside this model, in the order of the schema."""
    for name, info in model.model_fields.items():
        path = f"{above}.{name}" if above else name
        allowed_kinds = tuple(kinds(info.annotation))
        lists = max((lists for _, lists in allowed_kinds), default=0)
        inner = [kind for kind, _ in allowed_kinds if isinstance(kind, type) and issubclass(kind, BaseModel)]
        for each in inner:
            yield from fields_of(each, path + f".{ITEM}" * lists)
        if not inner:
            found = tuple(kind for kind, _ in allowed_kinds)
            yield Field(path, _declaring(model, name), name, info, meaning_of(info.metadata), lists, found)


def _declaring(model: type[Any], name: str) -> type[Any]:
    """Return the class that declares the field: the model or one of its base classes."""
    return next(base for base in model.__mro__ if name in get_annotations(base))


def _type(field: Field) -> str:
    """Return the type of a field's values in words."""
    words = []
    if Any in field.kinds:  # checked by a validator, which brings its own schema
        document = field.model.model_json_schema()["properties"][field.name]
        return " or ".join(dict.fromkeys(_words(document)))
    for kind in field.kinds:
        if get_origin(kind) is Literal:
            words += [f"`{each}`" if isinstance(each, str) else str(each) for each in get_args(kind)]
        elif isinstance(getattr(kind, "__members__", None), object) and hasattr(kind, "__members__"):
            words += [f"`{each.value}`" for each in kind]
        else:
            words.append(WORDS.get(kind, "object" if get_origin(kind) is dict or kind is dict else str(kind)))
    text = " or ".join(dict.fromkeys(words))
    text = ("", "list of ", "matrix of ")[field.lists] + text
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


def _default(field: Field) -> str:
    """Return the default of an input in the unit of the field. If the field is an output, return an empty text."""
    if isinstance(field.meaning, Output):
        return ""
    if field.info.is_required():
        return "required"
    value = field.info.get_default(call_default_factory=True)
    stated = field.meaning.default_text if field.meaning else None
    if value is None:
        return f"null: {stated}" if stated else "null"
    if isinstance(value, list | dict):
        return f"`{value}`" if value else "empty"
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:.12g}" if isinstance(value, int | float) else f"`{value}`"


def _solver(meaning: Input | Output | None) -> str:
    """Return the dotted name of the solver's attribute that belongs to the field, or an empty text.

    The class in this name is the class that declares the attribute.
    """
    if meaning is None or meaning.origin is None:
        return ""
    record, name = meaning.origin
    owner: Any = next(base for base in record.__mro__ if name in get_annotations(base) or name in vars(base))
    return f"`{owner.__module__}.{owner.__qualname__}.{name}`"


def row(field: Field) -> tuple[str, ...]:
    """Return the cells of a field's row that follow the path and the endpoints."""
    meaning = field.meaning
    unit = meaning.unit if meaning else None
    return (
        _type(field),
        UNITS[unit].symbol if unit else "",
        allowed(meaning) if isinstance(meaning, Input) else "",
        _default(field),
        (meaning.symbol or "") if meaning else "",
        (meaning.source or "") if meaning else "",
        meaning.title if meaning else field.info.description or "",
        _solver(meaning),
        f"`{field.model.__module__}.{field.model.__qualname__}`",
    )


def models() -> dict[str, list[tuple[str, type[BaseModel]]]]:
    """Return the models of requests and answers with their endpoints. The keys are the sections of the chapter."""
    others = []
    known = {each.path for each in CALCULATIONS}
    for route in (
        *calculations.router.routes,
        *calculations.figures.routes,
        *rexs.router.routes,
        *service.router.routes,
    ):
        if isinstance(route, APIRoute) and route.include_in_schema and route.path not in known:
            found = (kind for kind, _ in kinds(route.response_model) if isinstance(kind, type))
            others += [(route.path, kind) for kind in found if issubclass(kind, BaseModel)]
    return {
        "Requests": [(each.path, each.request) for each in CALCULATIONS],
        "Answers": [(each.path, each.response) for each in CALCULATIONS],
        "Studies": [(page.plan.path, page.plan.model) for page in study_pages()],
        "Service": others,
    }


def rows(section: str) -> list[tuple[str, ...]]:
    """Return the rows of a section. If fields differ only in their endpoints, these fields share a row."""
    found: dict[tuple[str, ...], list[str]] = {}
    for endpoint, model in models()[section]:
        for field in fields_of(model):
            endpoints = found.setdefault((f"`{field.path}`", *row(field)), [])
            if endpoint not in endpoints:
                endpoints.append(endpoint)
    return [(path, " ".join(endpoints), *rest) for (path, *rest), endpoints in found.items()]


def chapter(table: Callable[[tuple[str, ...], Iterator[tuple[str, ...]]], str]) -> str:
    """Return the text of the chapter. The function `table` writes a table in Markdown."""
    parts = [f"## {name}\n\n{about}\n\n{table(COLUMNS, iter(rows(name)))}" for name, about in SECTIONS.items()]
    return "\n".join([HEAD, *parts])
