"""From request fields to SI arguments, from SI results to response fields, by name and unit."""

from dataclasses import dataclass, fields, is_dataclass
from functools import cache
from types import UnionType
from typing import Annotated, Any, TypeVar, Union, get_args, get_origin, get_type_hints

import numpy as np
from pydantic.fields import FieldInfo

from app.schema.model import Documented
from app.schema.quantities import Output
from solvers.quantity import Detail, Unit

T = TypeVar("T")
LEVELS: tuple[Detail, ...] = ("summary", "curves", "fields")


@dataclass(frozen=True, slots=True)
class _Field:
    """How one field of a schema maps to the solver."""

    name: str
    si_name: str
    unit: Unit | None
    level: int
    group: type[Documented] | None
    record: type[Any] | None
    holder: str | None

    def value(self, result: Any) -> Any:
        """What a solver's result holds for it; None where it lacks the member that would."""
        part = getattr(result, self.holder) if self.holder else result
        return None if part is None else getattr(part, self.si_name)


@cache
def _fields(model: type[Documented]) -> tuple[_Field, ...]:
    return tuple(_field(model, name, info) for name, info in model.model_fields.items())


def _field(model: type[Documented], name: str, info: FieldInfo) -> _Field:
    output = next((item for item in info.metadata if isinstance(item, Output)), None)
    level = LEVELS.index(output.detail) if output else 0
    origin = model.origins.get(name)
    record, member = (origin.record, origin.member) if origin else (None, None)
    return _Field(name, model.solver_name(name), model.unit_of(name), level, group_of(info.annotation), record, member)


def group_of(annotation: Any) -> type[Documented] | None:
    """The group or section that a field holds, alone, optional or as the item of a list; None for plain values."""
    if isinstance(annotation, type) and issubclass(annotation, Documented):
        return annotation
    if get_origin(annotation) in {Union, UnionType, list, Annotated}:
        return next((group for kind in get_args(annotation) if (group := group_of(kind))), None)
    return None


def to_si(section: Documented) -> dict[str, Any]:
    """The section's plain fields by their solver names, in SI; nested sections are left to the caller."""
    return {field.si_name: _scaled(getattr(section, field.name), field.unit) for field in _plain_fields(type(section))}


def built(section: Documented, kind: type[T]) -> T:
    """The solver's dataclass that a section was filled from, in SI, with those of the sections inside it."""
    given: dict[str, Any] = {}
    record: Any = kind
    for name, field, inner in _members(type(section), record):
        value = getattr(section, field.name)
        given[name] = _scaled(value, field.unit) if inner is None else _inner(value, inner)
    return kind(**given)


def _inner(value: Any, kind: type[Any]) -> Any:
    if value is None:
        return None
    return tuple(built(each, kind) for each in value) if isinstance(value, list) else built(value, kind)


@cache
def _members(model: type[Documented], kind: Any) -> tuple[tuple[str, _Field, type[Any] | None], ...]:
    """The fields that a dataclass takes from a section, and the dataclass of a section inside it."""
    known = {field.si_name: field for field in _fields(model) if field.record is None or issubclass(kind, field.record)}
    hints = get_type_hints(kind)
    return tuple(
        (each.name, known[each.name], _record_in(hints[each.name]))
        for each in fields(kind)
        if each.init and each.name in known
    )


def _record_in(hint: Any) -> type[Any] | None:
    """The dataclass in a type, alone, optional or as the item of a tuple."""
    if isinstance(hint, type) and is_dataclass(hint):
        return hint
    return next((found for kind in get_args(hint) if (found := _record_in(kind))), None)


@cache
def _plain_fields(section: type[Documented]) -> tuple[_Field, ...]:
    return tuple(field for field in _fields(section) if field.group is None)


def _scaled(value: Any, unit: Unit | None) -> Any:
    match value:
        case float():
            return value if unit is None else value * unit.scale + unit.offset
        case None | bool() | str():
            return value
        case list() | tuple():
            return tuple(_scaled(item, unit) for item in value)
        case _:
            return value if unit is None else value * unit.scale + unit.offset


def from_si(group: type[Documented], result: Any, detail: Detail, skip: frozenset[str] = frozenset()) -> dict[str, Any]:
    """The fields of a response group read from the solver's result, in the units of their names.

    Fields above the level of detail are left out, as are those to `skip`.
    """
    level = LEVELS.index(detail)
    content: dict[str, Any] = {}
    for field in _fields(group):
        if field.level <= level and field.name not in skip:
            value, unit = field.value(result), field.unit
            if field.group is not None and isinstance(value, tuple | list):
                content[field.name] = [from_si(field.group, item, detail) for item in value]
            elif field.group is not None and value is not None:
                content[field.name] = from_si(field.group, value, detail)
            else:
                content[field.name] = value if unit is None and type(value) is float else _displayed(value, unit)
    return content


@cache
def above(group: type[Documented], detail: Detail) -> dict[str, Any]:
    """The fields of a group above a level of detail, as pydantic's `exclude` names them."""
    level = LEVELS.index(detail)
    found: dict[str, Any] = {}
    for field in _fields(group):
        if field.level > level:
            found[field.name] = True
        elif field.group is not None and (inner := above(field.group, detail)):
            found[field.name] = {"__all__": inner} if _is_list(group.model_fields[field.name].annotation) else inner
    return found


def _is_list(annotation: Any) -> bool:
    return any(get_origin(kind) is list for kind in (annotation, *get_args(annotation)))


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
