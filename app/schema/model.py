"""Models of requests and responses, filled from the dataclasses of the solvers.

    class CouplingModel(Section, of=si.ModelOptions):
        \"\"\"Choices where the paper leaves room.\"\"\"

has a field for each declaration on `si.ModelOptions`, named with the suffix of its unit, and without the underscore at
its end where it would be a word of Python (`from_`). What stands in the class itself is an ordinary field of pydantic:
under the name of a filled field it changes the type or the default, and with `Input` or `Output` beside the type it
replaces the declaration; `Input.of(Record, "field", text=...)` changes part of one. Requests give the solver's
dataclasses in SI (`Section.si`), responses are read from them (`from_si`), by names and units looked up once a model
(`members`).
"""

from abc import abstractmethod
from collections.abc import Iterator
from dataclasses import MISSING, dataclass, fields, is_dataclass
from functools import cache, partial
from importlib.metadata import version
from inspect import get_annotations
from types import GenericAlias, NoneType, UnionType
from typing import (
    TYPE_CHECKING,
    Annotated,
    Any,
    ClassVar,
    Literal,
    LiteralString,
    Self,
    TypeVar,
    Union,
    get_args,
    get_origin,
    get_type_hints,
)

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, PrivateAttr, model_validator
from pydantic.fields import FieldInfo
from pydantic_core import PydanticCustomError

from app.schema.quantities import Input, Output, View, meaning_of
from solvers.notices import Rank
from solvers.quantity import UNITS, Detail, Quantity, Unit, as_json, converted, quantities, type_of

T = TypeVar("T")
LEVELS: tuple[Detail, ...] = ("summary", "curves", "fields")
MODEL_VERSION = version("tribodrive")


class Documented(BaseModel):
    """A model with fields for the declarations of dataclasses.

    `exclusive` lists groups of fields of which at most one is given. `member_unit` is the unit of the fields whose own
    names carry none: a group `mass_flow_g_per_s` says it once for its members. `views` are the judgements of outputs,
    by the solver's names.
    """

    exclusive: ClassVar[tuple[tuple[str, ...], ...]] = ()
    member_unit: ClassVar[str | None] = None
    views: ClassVar[dict[str, View]] = {}
    _declares: ClassVar[type[Input] | type[Output]] = Input
    _stands: ClassVar[bool] = True  # whether the model is used for its dataclass inside other models
    _optional: ClassVar[bool] = False  # whether filled fields may be missing: where there is no solution

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            """Filled fields."""

    def __init_subclass__(
        cls,
        *,
        of: type | tuple[type, ...] = (),
        only: tuple[str, ...] = (),
        without: tuple[str, ...] = (),
        stands: bool = True,
        **config: Any,
    ) -> None:
        """Fill the model from the declarations of dataclasses: all, `only` some, or all `without` some.

        Of several the first is the solver's result; the others are members of it, which may be None. Fields that a base
        has stay as they are. If a model `stands` for its whole dataclass, it is the model of this dataclass inside
        other models. Raises TypeError if two models stand for one dataclass.
        """
        super().__init_subclass__(**config)
        records: tuple[Any, ...] = of if isinstance(of, tuple) else (of,)
        declared = {name: (record, each) for record in records for name, each in quantities(record).items()}
        if unknown := {*only, *vars(cls).get("views", {})} - {*declared}:
            raise TypeError(f"{cls.__name__} names fields that are not declared: {', '.join(sorted(unknown))}")
        names = {  # in the interface
            name: name.rstrip("_") if each.unit in {None, cls.member_unit} else f"{name}_{each.unit}"
            for name, (_, each) in declared.items()
        }
        inherited = {each.name for base in cls.__bases__ for each in members(base) if each.record}
        own = get_annotations(cls)  # change the type of a filled field, or stand beside it
        filled: dict[str, Any] = {}
        for name in only or declared:
            (record, each), field = declared[name], names[name]
            if name in without or (field in inherited and field not in own):
                continue
            kind = own.get(field) or _published(type_of(record, name), each, cls._declares)
            if meaning_of(getattr(kind, "__metadata__", ())):  # brings its own declaration, and has its place here
                filled[field] = kind
                continue
            filled[field], default = cls._filled(kind, record, name, names, nullable=record is not records[0])
            if field not in vars(cls):
                setattr(cls, field, default)
        cls.__annotations__ = filled | {name: kind for name, kind in own.items() if name not in filled}
        if stands and cls._stands and records and not only and not without:
            if (other := _MODELS.get((cls._declares, records[0]), cls)) is not cls:
                raise TypeError(f"{other.__name__} and {cls.__name__} both stand for {records[0].__name__}")
            _MODELS[cls._declares, records[0]] = cls

    @classmethod
    @abstractmethod
    def _filled(cls, kind: Any, record: Any, name: str, names: dict[str, str], *, nullable: bool) -> tuple[Any, Any]:
        """Type and default of a field; `names` are those of the interface by the solver's."""


_MODELS: dict[tuple[type, type], type[Documented]] = {}
"""The model of a dataclass inside other models, of requests and of answers."""


def _published(hint: Any, declared: Quantity, declares: type) -> Any:
    """The type of a field in the interface: models for dataclasses, lists for tuples and arrays."""
    alias = getattr(get_origin(hint), "__value__", None)  # of NDArray[...] since numpy 2.5
    hint = hint if alias is None else alias[get_args(hint)]
    origin, arguments = get_origin(hint), get_args(hint)
    if isinstance(hint, type) and is_dataclass(hint):
        return _MODELS[declares, hint]
    if origin in {Union, UnionType}:
        return Union[tuple(_published(each, declared, declares) for each in arguments)]  # noqa: UP007
    if origin is np.ndarray:
        number: Any = bool if "bool" in str(arguments[1]) else float
        row = GenericAlias(list, number | None if declared.gaps else number)
        return GenericAlias(list, row) if isinstance(declared.axis, tuple) else row
    if origin is tuple:
        listed = GenericAlias(list, _published(arguments[0], declared, declares))
        if declares is Input and arguments[-1] is not Ellipsis:
            return Annotated[listed, Field(min_length=len(arguments), max_length=len(arguments))]
        return listed
    return hint


def kinds(annotation: Any, lists: int = 0) -> Iterator[tuple[Any, int]]:
    """The types of single values that an annotation allows, each with the number of lists around it."""
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
    """A field of a model: what it means and holds, and the field of a solver's dataclass that it fills or is read from.

    `record` is that dataclass, None where it may be any; `solver_name` is then the name without its unit. `kinds` are
    the types of single values, `group` the section or group among them, alone, optional or as the items of a list.
    `dimensions` is 0 for a scalar, 1 for a list, 2 for a matrix.
    """

    name: str
    info: FieldInfo
    meaning: Input | Output
    record: type | None
    solver_name: str
    unit: Unit | None
    kinds: tuple[Any, ...]
    group: type[Documented] | None
    dimensions: int


@cache
def members(model: type[BaseModel]) -> tuple[Member, ...]:
    """The fields of a model that are declared."""
    found = []
    for name, info in model.model_fields.items():
        if meaning := meaning_of(info.metadata):
            record, solver_name = meaning.origin or (None, name.removesuffix(f"_{meaning.unit}"))
            unit = UNITS[meaning.unit] if meaning.unit else None
            allowed, lists = zip(*kinds(info.annotation), strict=True)
            groups = (kind for kind in allowed if isinstance(kind, type) and issubclass(kind, Documented))
            group, dimensions = next(groups, None), max(lists)
            found.append(Member(name, info, meaning, record, solver_name, unit, allowed, group, dimensions))
    return tuple(found)


@cache
def _fillings(model: type[Documented], record: Any) -> tuple[tuple[str, Member, Any], ...]:
    """The fields of a dataclass that a section has, and the dataclass inside each, None of plain values."""
    known = {each.solver_name: each for each in members(model) if not each.record or issubclass(record, each.record)}
    hints = get_type_hints(record)
    return tuple(
        (each.name, known[each.name], _record_in(hints[each.name]))
        for each in fields(record)
        if each.init and each.name in known
    )


def _record_in(hint: Any) -> Any:
    """The dataclass in a type, alone, optional or as the item of a tuple; None where there is none."""
    return next((kind for kind, _ in kinds(hint) if is_dataclass(kind)), None)


def _in_si(value: Any, unit: Unit | None, record: Any) -> Any:
    """Return a value of a request in SI; a section fills the dataclass `record`."""
    inside = None if record is None else lambda section: section.si(record)
    return converted(value, unit.to_si if unit else _unchanged, inside)


def _unchanged(value: Any) -> Any:
    return value


def from_si(group: type[Documented], result: Any, detail: Detail) -> dict[str, Any]:
    """The fields of a response group that a solver's result declares, in the units of their names.

    Fields above the level of detail are left out.
    """
    content: dict[str, Any] = {}
    kind: Any = type(result)
    for member, holder in _sources(group, kind, detail):
        part = getattr(result, holder) if holder else result
        value = None if part is None else getattr(part, member.solver_name)
        content[member.name] = _displayed(value, member, detail)
    return content


@cache
def _sources(group: type[Documented], record: Any, detail: Detail) -> tuple[tuple[Member, str | None], ...]:
    """The filled fields of a group, and the member of the result that holds each; None for the result's own."""
    held = {name: inner for name, hint in get_type_hints(record).items() if (inner := _record_in(hint))}
    found = []
    for each in members(group):
        if each.record and LEVELS.index(each.meaning.detail) <= LEVELS.index(detail):
            holders = (name for name, inner in held.items() if issubclass(inner, each.record))
            found.append((each, None if issubclass(record, each.record) else next(holders, None)))
    return tuple(found)


def _displayed(value: Any, member: Member, detail: Detail) -> Any:
    """A value in the unit of its field; NaN inside an array marks a point without a value and becomes None."""
    group, unit = member.group, member.unit
    inside = None if group is None else lambda part: from_si(group, part, detail)
    return converted(value, lambda number: as_json(unit.from_si(number) if unit else number), inside, list)


def _with_choices(document: dict[str, Any], section: type[Any]) -> None:
    """The schema with `x-exclusive`."""
    if section.exclusive:
        document["x-exclusive"] = [list(group) for group in section.exclusive]


class Section(Documented):
    """A part of a request: unknown fields are refused, numbers are numbers, finite and in range.

    `choice_code` is the code of an error where two fields that exclude each other are given, `choice_missing` that
    where none is, if one is required.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, json_schema_extra=_with_choices)
    choice_code: ClassVar[LiteralString] = "exclusive"
    choice_missing: ClassVar[LiteralString | None] = None

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
        """Refuse two fields that exclude each other, and none of them where one is required."""
        for group in self.exclusive:
            given = [name for name in group if getattr(self, name) is not None]
            if len(given) > 1:
                raise PydanticCustomError(
                    self.choice_code, "{names} are both given; keep one", {"names": " and ".join(given[:2])}
                )
            if self.choice_missing and not given:
                raise PydanticCustomError(self.choice_missing, "give {names}", {"names": " or ".join(group)})
        return self

    def si(self, kind: type[T], /, *others: "Section", **known: Any) -> T:
        """The solver's dataclass in SI that these fields fill, then those of other sections.

        Sections inside these fill the dataclasses inside it; what is `known` stands for fields of its own.
        """
        return kind(**self.filling(kind, *others, **known))

    def filling(self, kind: type[Any], /, *others: "Section", **known: Any) -> dict[str, Any]:
        """Return the values that `si` gives to the dataclass, by the names of its fields."""
        given: dict[str, Any] = {}
        record: Any = kind
        for section in reversed((self, *others)):
            for name, member, inner in _fillings(type(section), record):
                if name not in known:
                    given[name] = _in_si(getattr(section, member.name), member.unit, inner)
        return given | known

    def unused(self) -> dict[str, bool]:
        """Whether the values given leave a field or section out of a result, by names dotted below this section."""
        return {}

    def stands_for_null(self, _name: str) -> Any:
        """What a field that was left null stands for, where the section itself knows it."""
        return None


def _in_reading_order(document: dict[str, Any]) -> None:
    """The schema as the docs page shows it best: what is required first, the level of detail last."""
    required, properties = document.get("required", ()), document["properties"]
    names = sorted(properties, key=lambda name: (name not in required, name == "detail"))
    document["properties"] = {name: properties[name] for name in names}


class Request(Section):
    """The body of a calculation."""

    detail: Annotated[
        Detail,
        Input("level of detail", text="what to return: scalars, scalars and curves, or also two-dimensional fields"),
    ] = "curves"

    model_config = ConfigDict(json_schema_extra=_in_reading_order)
    _stands: ClassVar = False

    @abstractmethod
    def inputs(self) -> Any:
        """The solver's inputs, SI."""

    def options(self) -> dict[str, Any]:
        """The options in force, by their names in the contract."""
        return self.model.model_dump()  # type: ignore[no-any-return]

    def assumed_by_the_model(self) -> dict[str, str]:
        """What the options in force take for granted whatever else is given: reasons by dotted names of options."""
        return {}


class Group(Documented):
    """A part of a response; nothing in it is NaN or infinite."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)
    _declares: ClassVar = Output

    @classmethod
    def _filled(cls, kind: Any, record: Any, name: str, names: dict[Any, Any], *, nullable: bool) -> tuple[Any, Any]:
        declared = quantities(record)[name]
        unit, axis = declared.unit or getattr(kind, "member_unit", None), declared.axis
        axis = tuple(names.get(each, each) for each in axis) if isinstance(axis, tuple) else names.get(axis, axis)
        meaning = Output.of(record, name, unit=unit, axis=axis, **vars(cls.views.get(name, View())))
        optional = cls._optional or declared.detail != "summary"
        return Annotated[kind | None if optional or nullable else kind, meaning], None if optional else ...


class Notice(Group):
    """A value outside its range of validity, or without meaning."""

    rank: Annotated[
        Rank,
        Output(
            "rank of the warning",
            text="invalid: a result is missing or the theory does not hold; doubtful: a limit is left; note: left out, "
            "assumed or without meaning; the gravest first",
        ),
    ]
    code: Annotated[str, Output("code of the warning", text="stable name, meant for programs")]
    message: Annotated[str, Output("message of the warning", text="what is out of which range, and what follows")]
    field: Annotated[
        str | None, Output("field of the warning", text="dotted name of the request field it is about")
    ] = None


class Assumption(Group):
    """A default that this result used and that is ours, not the paper's."""

    field: Annotated[str, Output("assumed field", text="dotted name of the request field")]
    value: Annotated[Any, Output("assumed value", text="the value used")]
    reason: Annotated[str, Output("reason of the assumption", text="why this value")]


class Derived(Group):
    """What follows from the request before any physics."""


GROUNDS = frozenset({"assumptions", "model_version", "sources", "model", "derived", "inputs", "case"})
"""The last fields of every answer: the basis of the results."""


class Response(Group):
    """What every result says about itself; each adds its results."""

    _optional: ClassVar = True
    _stands: ClassVar = False

    status: Annotated[
        Literal["ok", "ok_with_warnings", "no_solution"],
        Output("status", text="whether the calculation succeeded; with no_solution, `residuals` says how far it came"),
    ]
    warnings: Annotated[list[Notice], Output("warnings", text="limits of validity that this result touches")]
    residuals: Annotated[
        dict[str, float] | None, Output("residuals", text="how far an iteration without a solution came")
    ] = None
    assumptions: Annotated[
        list[Assumption], Output("assumptions", text="defaults used that are ours and not the paper's")
    ]
    model_version: Annotated[str, Output("model version", text="version of the model that computed this result")]
    sources: Annotated[
        str, Output("sources of the solvers", text="SHA-256 of the solvers' syntax trees; equal for equal calculations")
    ]
    model: Annotated[dict[str, Any], Output("options in force")]
    derived: Annotated[Derived | None, Output("derived", text="what follows from the request before any physics")] = (
        None
    )
    inputs: Annotated[dict[str, Any], Output("inputs", text="the request with its defaults, to be posted")]
    case: Annotated[str, Output("case", text="SHA-256 of endpoint, inputs and sources; equal cases have equal results")]

    _result: Any = PrivateAttr(default=None)

    @property
    def result(self) -> Any:
        """The solver's result that the response was read from, in SI; None where there is none."""
        return self._result

    def remarks(self) -> dict[str, str]:
        """How well results are known, where that is to stand beside them: texts by path."""
        return {}

    def read_from(self, result: Any) -> Self:
        """The response with the solver's result kept beside it, for its figures."""
        self._result = result
        return self

    @classmethod
    def __pydantic_init_subclass__(cls, **_: Any) -> None:
        """Results stand before what they rest on."""
        known = cls.__pydantic_fields__
        cls.__pydantic_fields__ = {name: known[name] for name in sorted(known, key=lambda name: name in GROUNDS)}
        cls.model_rebuild(force=True)
