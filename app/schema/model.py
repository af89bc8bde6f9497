"""Models of requests and responses, filled from the dataclasses of the solvers.

    class CouplingModel(Section, of=si.ModelOptions):
        \"\"\"Choices that the paper leaves open in the coupling model.\"\"\"

This class gets one field for each field that `si.ModelOptions` declares. If a declared field has a unit, the name of
the field in the model ends with this unit. Solvers append an underscore to a name that is a keyword of Python
(`from_`). The name of the field in the model does not have this underscore.

The class body may declare fields of pydantic, too. If such a field has the same name as a filled field, the type in the
class body replaces the type of the filled field. A default in the class body replaces the default of the filled field.
If the type in the class body is annotated with an `Input` or `Output`, this annotation replaces the declaration of the
solver. `Input.of(Record, "field", text=...)` copies the declaration of the solver and replaces only its text.

`Section.si` converts a request into the solver's dataclasses in SI, `app.schema.answers.shown` a result into the
values of an answer. Both take names and units from `members`, which collects them once per model.
"""

import sys
from abc import abstractmethod
from collections.abc import Iterator
from dataclasses import MISSING, dataclass, fields, is_dataclass
from functools import cache, partial
from inspect import get_annotations
from types import GenericAlias, NoneType, UnionType, new_class
from typing import (
    TYPE_CHECKING,
    Annotated,
    Any,
    ClassVar,
    LiteralString,
    Self,
    TypeVar,
    Union,
    get_args,
    get_origin,
    get_type_hints,
)

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, model_validator
from pydantic.fields import FieldInfo
from pydantic_core import PydanticCustomError

from app.schema.quantities import Input, Output, meaning_of
from solvers.quantity import UNITS, Detail, Quantity, Unit, converted, quantities, type_of

T = TypeVar("T")


class Documented(BaseModel):
    """A model whose fields are filled from the declarations of dataclasses.

    `exclusive` lists groups of field names. At most one field of each group may be given. `alternatives` lists groups
    of which a form shows one field at a time, although several may be given. `member_unit` is the unit of
    all fields whose own names state no unit. For example, the fields of the section `mass_flow_g_per_s` are in g/s,
    because the name of the section states this unit. `views` says how pages show and judge
    outputs. The keys of `views` are the solver's names of the outputs.
    """

    exclusive: ClassVar[tuple[tuple[str, ...], ...]] = ()
    alternatives: ClassVar[tuple[tuple[str, ...], ...]] = ()
    member_unit: ClassVar[str | None] = None
    views: ClassVar[dict[str, Any]] = {}
    declares: ClassVar[type[Input] | type[Output]] = Input
    _stands: ClassVar[bool] = True  # whether the model may represent its dataclass in other models
    _optional: ClassVar[bool] = False  # whether filled fields may be missing, because there may be no solution

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            """Let the type checker accept the filled fields, which only exist at run time."""

    def __init_subclass__(
        cls,
        *,
        of: type | tuple[type, ...] = (),
        only: tuple[str, ...] = (),
        without: tuple[str, ...] = (),
        stands: bool = True,
        **config: Any,
    ) -> None:
        """Add the fields that the dataclasses `of` declare.

        If `only` names fields, only these fields are added. Fields in `without` are not added. A field of a base class
        is not changed, unless the class body declares it again.

        If `of` lists several dataclasses, a request section fills all of them. The fields of a response are read from
        the solver's result (first dataclass) and from members of this result (other dataclasses). If such a member is
        None, the fields that are read from it are null.

        If `stands` is true and neither `only` nor `without` is given, the model represents its first dataclass: other
        models use this model wherever a field has this dataclass as its type.

        Raises TypeError if two models represent the same dataclass, or if `only` or the class attribute `views` names a
        field that the dataclasses do not declare.
        """
        super().__init_subclass__(**config)
        records: tuple[Any, ...] = of if isinstance(of, tuple) else (of,)
        declared = {name: (record, quantity) for record in records for name, quantity in quantities(record).items()}
        if unknown := {*only, *vars(cls).get("views", {})} - {*declared}:
            raise TypeError(f"{cls.__name__} names fields that are not declared: {', '.join(sorted(unknown))}")
        names = {  # the names in the interface, by the names of the solver
            name: name.rstrip("_") if quantity.unit in {None, cls.member_unit} else f"{name}_{quantity.unit}"
            for name, (_, quantity) in declared.items()
        }
        inherited = {member.name for base in cls.__bases__ for member in members(base) if member.record}
        own = get_annotations(cls)  # types of fields that the class body declares
        filled: dict[str, Any] = {}
        for name in only or declared:
            (record, quantity), field = declared[name], names[name]
            if name in without or (field in inherited and field not in own):
                continue
            kind = own.get(field) or _published(type_of(record, name), quantity, cls)
            if meaning_of(getattr(kind, "__metadata__", ())):  # the class body gives its own declaration
                filled[field] = kind
                continue
            filled[field], default = cls._filled(kind, record, name, names, nullable=record is not records[0])
            if field not in vars(cls):
                setattr(cls, field, default)
        cls.__annotations__ = filled | {name: kind for name, kind in own.items() if name not in filled}
        if stands and cls._stands and records and not only and not without:
            if (other := _MODELS.get((cls.declares, records[0]), cls)) is not cls:
                raise TypeError(
                    f"{other.__name__} and {cls.__name__} both describe {records[0].__name__}; declare one of them "
                    "with stands=False, so that the other is the standard model"
                )
            _MODELS[cls.declares, records[0]] = cls

    @classmethod
    @abstractmethod
    def standing_for(cls, record: Any) -> "type[Documented]":
        """Return a generated model for a dataclass for which no model was declared."""

    @classmethod
    @abstractmethod
    def _filled(cls, kind: Any, record: Any, name: str, names: dict[str, str], *, nullable: bool) -> tuple[Any, Any]:
        """Return the type and the default of the model's field for the field `name` of the dataclass `record`.

        `names` maps the solver's names to names in the interface. If `nullable` is True, an answer field may be null.
        """


_MODELS: dict[tuple[type, type], type[Documented]] = {}
"""The models that represent dataclasses. A key is a pair: `Input` or `Output`, and the dataclass."""


def stands_for(declares: type, record: Any) -> "type[Documented] | None":
    """Return the model that represents a dataclass; None if there is none yet."""
    return _MODELS.get((declares, record))


def _published(hint: Any, declared: Quantity, holder: type[Documented]) -> Any:
    """Return the type that a field of the model `holder` has in the interface.

    Dataclasses become models, and tuples and arrays become lists.
    """
    alias = getattr(get_origin(hint), "__value__", None)  # since numpy 2.5, NDArray[...] is an alias
    hint = hint if alias is None else alias[get_args(hint)]
    origin, arguments = get_origin(hint), get_args(hint)
    if isinstance(hint, type) and is_dataclass(hint):
        return stands_for(holder.declares, hint) or holder.standing_for(hint)
    if origin in {Union, UnionType}:
        return Union[tuple(_published(argument, declared, holder) for argument in arguments)]  # noqa: UP007
    if origin is np.ndarray:
        number: Any = bool if "bool" in str(arguments[1]) else float
        row = GenericAlias(list, number | None if declared.gaps else number)
        return GenericAlias(list, row) if isinstance(declared.axis, tuple) else row
    if origin is tuple:
        listed = GenericAlias(list, _published(arguments[0], declared, holder))
        if holder.declares is Input and arguments[-1] is not Ellipsis:
            return Annotated[listed, Field(min_length=len(arguments), max_length=len(arguments))]
        return listed
    return hint


def generated(base: type[Documented], name: str, own: dict[str, Any], **keywords: Any) -> type[Any]:
    """Return a model without code of its own, with the docstring of the first dataclass that it describes.

    `own` holds class attributes, and `keywords` are those of `Documented`.
    """
    record: Any = keywords["of"][0] if isinstance(keywords["of"], tuple) else keywords["of"]
    text = {
        "__doc__": record.__doc__.partition("\n\nParameters\n---")[0].partition("\n\nAttributes\n---")[0],
        "__module__": __name__,
    }
    return new_class(name, (base,), keywords, lambda namespace: namespace.update(text | own))


def kinds(annotation: Any, lists: int = 0) -> Iterator[tuple[Any, int]]:
    """Yield the types of single values that an annotation contains.

    Each type comes with the number of lists around the type. For example, `list[float] | None` yields `(float, 1)`.
    """
    origin = get_origin(annotation)
    if origin is Annotated:
        yield from kinds(get_args(annotation)[0], lists)
    elif origin in {Union, UnionType, list, tuple}:
        for kind in get_args(annotation):
            yield from kinds(kind, lists + (origin is list))
    elif annotation is not NoneType:
        yield annotation, lists


@dataclass(frozen=True, slots=True)
class Member:
    """A field of a model, with its declaration, its types and the corresponding field of a solver's dataclass.

    `meaning` is the declaration. `record` is the dataclass that contains the declaration, and `solver_name` is the name
    of the field in this dataclass. If the class body of the model contains the declaration, `record` is None, and
    `solver_name` is `name` without the unit.

    `kinds` are the types that a single value of the field may have, and `groups` those of them that are models: the
    field is then a section. `dimensions` is 0 for a scalar, 1 for a list, 2 for a matrix.
    """

    model: type[BaseModel]
    name: str
    info: FieldInfo
    meaning: Input | Output
    record: type | None
    solver_name: str
    unit: Unit | None
    kinds: tuple[Any, ...]
    groups: tuple[type[Any], ...]
    dimensions: int

    @property
    def group(self) -> type[Documented] | None:
        """The model of the section; None if the field is no section. Sections of calculations have one model each."""
        return self.groups[0] if self.groups else None


@cache
def members(model: type[BaseModel]) -> tuple[Member, ...]:
    """Return the fields of a model. A field without an `Input` or `Output` means what its description says."""
    found = []
    for name, info in model.model_fields.items():
        meaning = meaning_of(info.metadata) or Input(info.description or "")
        record, solver_name = meaning.origin or (None, name.removesuffix(f"_{meaning.unit}"))
        unit = UNITS[meaning.unit] if meaning.unit else None
        allowed, lists = zip(*kinds(info.annotation), strict=True)
        groups = tuple(kind for kind in allowed if isinstance(kind, type) and issubclass(kind, BaseModel))
        found.append(Member(model, name, info, meaning, record, solver_name, unit, allowed, groups, max(lists)))
    return tuple(found)


@cache
def _fillings(model: type[Documented], record: Any) -> tuple[tuple[str, Member, Any], ...]:
    """Return the fields of the dataclass `record` that the section `model` fills.

    Each item has three parts: the name of the field, the member of `model` that fills the field, and a dataclass. This
    dataclass is the type of the field, or None if the field does not hold a dataclass.
    """
    by_solver_name = {
        member.solver_name: member
        for member in members(model)
        if not member.record or issubclass(record, member.record)
    }
    hints = get_type_hints(record)
    return tuple(
        (field.name, by_solver_name[field.name], record_in(hints[field.name]))
        for field in fields(record)
        if field.init and field.name in by_solver_name
    )


def record_in(hint: Any) -> Any:
    """Return the dataclass that a type contains, or None if the type contains no dataclass.

    Examples of types that contain the dataclass `Record` are `Record`, `Record | None` and `tuple[Record, ...]`.
    """
    return next((kind for kind, _ in kinds(hint) if is_dataclass(kind)), None)


def _in_si(value: Any, unit: Unit | None, record: Any) -> Any:
    """Convert a value of a request into SI. A section is converted into the dataclass `record`."""
    inside = None if record is None else lambda section: section.si(record)
    return converted(value, unit.to_si if unit else lambda number: number, inside)


def _with_choices(document: dict[str, Any], section: type[Any]) -> None:
    """Add the groups of fields that exclude each other to the JSON schema, under the key `x-exclusive`."""
    if section.exclusive:
        document["x-exclusive"] = [list(group) for group in section.exclusive]


class Section(Documented):
    """A part of a request.

    A section refuses unknown fields, infinite numbers, numbers out of range, and numbers that are sent as text.
    `choice_code` is the code of the error if a request gives two fields of a group in `exclusive`. `choice_missing` is
    the code of the error if a request gives no field of a group. If `choice_missing` is None, leaving out all fields of
    a group is not an error.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, json_schema_extra=_with_choices)
    choice_code: ClassVar[LiteralString] = "exclusive"
    choice_missing: ClassVar[LiteralString | None] = None

    @classmethod
    def standing_for(cls, record: Any) -> type[Documented]:
        section = generated(Section, record.__name__, {"__module__": cls.__module__}, of=record)
        setattr(sys.modules[cls.__module__], section.__name__, section)  # where pickle looks on the way to a worker
        return section

    @classmethod
    def _filled(cls, kind: Any, record: Any, name: str, names: dict[str, str], *, nullable: bool) -> tuple[Any, Any]:  # noqa: ARG003
        declared = quantities(record)[name]
        default = declared.default
        if isinstance(default, tuple):
            default = Field(default_factory=partial(list, default))
        elif default is ... and record.__dataclass_fields__[name].default_factory is not MISSING:
            default = kind()
        return Annotated[kind, Input.of(record, name)], default

    @model_validator(mode="after")
    def one_of_each_choice(self) -> Self:
        """Refuse a request that gives several fields of a group in `exclusive`.

        If `choice_missing` is set, also refuse a request that gives none of the fields of such a group.
        """
        for group in self.exclusive:
            given = [name for name in group if getattr(self, name) is not None]
            if len(given) > 1:
                raise PydanticCustomError(
                    self.choice_code, "{names} are both given; keep one", {"names": " and ".join(given[:2])}
                )
            if self.choice_missing and not given:
                raise PydanticCustomError(self.choice_missing, "give {names}", {"names": " or ".join(group)})
        return self

    def si(self, kind: type[T], /, *others: "Section", **values: Any) -> T:
        """Return an object of the solver's dataclass `kind` in SI, filled from this section and the sections `others`.

        If several sections fill the same field, the first section is used. An inner section becomes an object of the
        dataclass that the field of `kind` has as its type. `values` are already in SI and take precedence over all
        sections.
        """
        return kind(**self.filling(kind, *others, **values))

    def filling(self, kind: type[Any], /, *others: "Section", **values: Any) -> dict[str, Any]:
        """Return the values with which `si` fills the dataclass `kind`. The keys are the names of its fields."""
        given: dict[str, Any] = {}
        record: Any = kind
        for section in reversed((self, *others)):
            for name, member, inner in _fillings(type(section), record):
                if name not in values:
                    given[name] = _in_si(getattr(section, member.name), member.unit, inner)
        return given | values

    def unused(self) -> dict[str, bool]:
        """Return which fields and subsections of this section have no effect, given the values of the other fields.

        The keys are dotted names that start below this section. A value is True if the field or subsection has no
        effect.
        """
        return {}

    def values_by_source(self) -> dict[str, str]:
        """Return the fields of this section whose values were looked up for the request, and where they come from."""
        return {}

    def stands_for_null(self, _name: str) -> Any:
        """Return the value that the calculation uses if the request leaves the field `_name` null.

        None means that the value is not known. Sections that know this value override this method.
        """
        return None


def _in_reading_order(document: dict[str, Any]) -> None:
    """Sort the fields of the JSON schema as the docs page shows them: required fields first, `detail` last."""
    required, properties = document.get("required", ()), document["properties"]
    names = sorted(properties, key=lambda name: (name not in required, name == "detail"))
    document["properties"] = {name: properties[name] for name in names}


class Request(Section):
    """The body of a request for a calculation."""

    detail: Annotated[
        Detail,
        Input("level of detail", text="what to return: scalars, scalars and curves, or also two-dimensional fields"),
    ] = "curves"

    model_config = ConfigDict(json_schema_extra=_in_reading_order)
    _stands: ClassVar = False

    @abstractmethod
    def inputs(self) -> Any:
        """Return the solver's inputs in SI."""

    def options(self) -> dict[str, Any]:
        """Return the model options that the calculation uses. The keys are the names in the interface."""
        return self.model.model_dump()  # type: ignore[no-any-return]

    def assumed_by_the_model(self) -> dict[str, str]:
        """Return the assumptions that the model makes with the options of this request.

        The keys are dotted names of request fields. The values are the reasons for the assumptions.
        """
        return {}
