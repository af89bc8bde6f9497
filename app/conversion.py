"""From request fields to SI arguments, from SI results to response fields, by name and unit."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from types import UnionType
from typing import Any, Union, get_args, get_origin

import numpy as np
from pydantic import BaseModel

from app.quantities import Detail, Input, Output
from app.requests.common import Request, Section
from app.responses.common import Assumption, Group
from app.units import Unit, split_unit

LEVELS: tuple[Detail, ...] = ("summary", "curves", "fields")


@dataclass(frozen=True, slots=True)
class _Field:
    """How one field of a schema maps to the solver."""

    name: str
    si_name: str
    unit: Unit | None
    level: int
    group: type[Group] | None
    assumed: str | None


@cache
def _fields(model: type[BaseModel]) -> tuple[_Field, ...]:
    return tuple(_field(name, info.annotation, info.metadata) for name, info in model.model_fields.items())


def _field(name: str, annotation: Any, metadata: list[Any]) -> _Field:
    base, unit = split_unit(name)
    meaning = next((item for item in metadata if isinstance(item, Input | Output)), None)
    kinds = get_args(annotation) if get_origin(annotation) in {Union, UnionType} else (annotation,)
    group = next((kind for kind in kinds if isinstance(kind, type) and issubclass(kind, Group)), None)
    return _Field(
        name=name,
        si_name=meaning.si if meaning is not None and meaning.si is not None else base,
        unit=unit,
        level=LEVELS.index(meaning.detail) if isinstance(meaning, Output) else 0,
        group=group,
        assumed=meaning.assumed if isinstance(meaning, Input) else None,
    )


def to_si(section: Section) -> dict[str, Any]:
    """The section's plain fields by their solver names, in SI; nested sections are left to the caller."""
    return {
        field.si_name: _scaled(getattr(section, field.name), field.unit)
        for field in _fields(type(section))
        if not isinstance(getattr(section, field.name), Section)
    }


def _scaled(value: Any, unit: Unit | None) -> Any:
    match value:
        case None | bool() | str():
            return value
        case list() | tuple():
            return tuple(_scaled(item, unit) for item in value)
        case float() | int():
            return value if unit is None else value * unit.scale + unit.offset
        case _:
            return value


def from_si(
    group: type[Group], result: Any, detail: Detail, *, unit: Unit | None = None, skip: frozenset[str] = frozenset()
) -> dict[str, Any]:
    """The fields of a response group read from the solver's result, in the units of their names.

    Fields above the level of detail are left out, as are those to `skip`. A group whose name carries a unit hands it
    down to its members.
    """
    level = LEVELS.index(detail)
    return {
        field.name: _leaf_or_group(field, getattr(result, field.si_name), detail, field.unit or unit)
        for field in _fields(group)
        if field.level <= level and field.name not in skip
    }


def _leaf_or_group(field: _Field, value: Any, detail: Detail, unit: Unit | None) -> Any:
    if field.group is not None and value is not None:
        return from_si(field.group, value, detail, unit=unit)
    return _displayed(value, unit)


def _displayed(value: Any, unit: Unit | None) -> Any:
    """A value in the unit of its field; NaN inside an array marks a point without a value and becomes None."""
    match value:
        case None | bool() | str():
            return value
        case np.ndarray():
            return _displayed_array(value, unit)
        case tuple() | list():
            return [_displayed(item, unit) for item in value]
        case _:
            return value if unit is None else (value - unit.offset) / unit.scale


def _displayed_array(values: np.ndarray[Any, Any], unit: Unit | None) -> list[Any]:
    if unit is not None:
        values = (values - unit.offset) / unit.scale
    if values.dtype.kind == "f" and np.isnan(values).any():
        missing = np.isnan(values)
        values = values.astype(object)
        values[missing] = None
    return values.tolist()  # type: ignore[no-any-return]


def assumptions(request: Request, resolved: Request) -> list[Assumption]:
    """The defaults marked as ours that the result rests on; `resolved` tells their values."""
    unused = resolved.unused_defaults()
    return [
        Assumption(field=path, value=value, reason=reason)
        for path, value, reason in _assumed(request, resolved, "")
        if not any(path == name or path.startswith(f"{name}.") for name in unused)
    ]


def _assumed(section: Section, resolved: Section, prefix: str) -> Iterator[tuple[str, Any, str]]:
    for field in _fields(type(section)):
        given, used = getattr(section, field.name), getattr(resolved, field.name)
        if isinstance(given, Section):
            yield from _assumed(given, used, f"{prefix}{field.name}.")
        elif field.assumed and (given is None or field.name not in section.model_fields_set):
            yield f"{prefix}{field.name}", used, field.assumed


def field_path(section: Section, name: str) -> str | None:
    """The dotted request field that the solver's dotted `name` (its end suffices) means, or None."""
    wanted = name.split(".")
    return next((path for path, si_path in _paths(section, "", ()) if list(si_path[-len(wanted) :]) == wanted), None)


def _paths(section: Section, prefix: str, si_prefix: tuple[str, ...]) -> Iterator[tuple[str, tuple[str, ...]]]:
    for field in _fields(type(section)):
        value = getattr(section, field.name)
        path, si_path = f"{prefix}{field.name}", (*si_prefix, field.si_name)
        yield path, si_path
        if isinstance(value, Section):
            yield from _paths(value, f"{path}.", si_path)
        elif isinstance(value, list):
            for index, item in enumerate(value):
                if isinstance(item, Section):
                    yield from _paths(item, f"{path}.{index}.", (*si_path, str(index)))
