"""Models of requests and responses, filled from the dataclasses of the solvers.

    class CouplingModel(Section, of=si.ModelOptions):
        \"\"\"Choices where the paper leaves room.\"\"\"

has a field for each declaration on `si.ModelOptions`, named with the suffix of its unit. What stands in the class
itself is an ordinary field of pydantic: under the name of a filled field it changes the type or the default, and with
`Input` or `Output` beside the type it replaces the declaration. Requests give the solver's dataclasses in SI
(`Section.si`), responses are read from them (`from_si`), by names and units that are looked up once a model.
"""

from abc import abstractmethod
from collections.abc import Iterator
from dataclasses import asdict, dataclass, fields, is_dataclass
from functools import cache
from importlib.metadata import version
from inspect import get_annotations
from types import NoneType, UnionType
from typing import (
    TYPE_CHECKING,
    Annotated,
    Any,
    ClassVar,
    Literal,
    LiteralString,
    NamedTuple,
    Self,
    TypeVar,
    Union,
    get_args,
    get_origin,
    get_type_hints,
)

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, GetJsonSchemaHandler, PrivateAttr, model_validator
from pydantic.fields import FieldInfo
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError

from app.schema.quantities import Input, Output, View, meaning_of, split_unit
from solvers.notices import Rank
from solvers.quantity import UNITS, Detail, Quantity, Unit, quantities, type_of

T = TypeVar("T")
LEVELS: tuple[Detail, ...] = ("summary", "curves", "fields")
MODEL_VERSION = version("tribodrive")


class Origin(NamedTuple):
    """The field of a solver's dataclass that fills a field of a model; `member` of the result holds that dataclass."""

    record: type
    name: str
    member: str | None = None


class Documented(BaseModel):
    """A model whose JSON schema states the unit of every field that has one.

    `exclusive` lists groups of fields of which at most one is given. `member_unit` is the unit of the fields whose own
    names carry none: a group `mass_flow_g_per_s` says it once for its members. `views` are the judgements of outputs,
    by the solver's names. `solver_names` are the parts of dotted names that the solver spells otherwise, with the
    fields' spelling.
    """

    exclusive: ClassVar[tuple[tuple[str, ...], ...]] = ()
    member_unit: ClassVar[Unit | None] = None
    views: ClassVar[dict[str, View]] = {}
    solver_names: ClassVar[dict[str, str]] = {}
    origins: ClassVar[dict[str, Origin]] = {}
    """Where filled fields come from."""
    _declares: ClassVar[type[Input] | type[Output]] = Input
    _optional: ClassVar[bool] = False

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            """Filled fields."""

    def __init_subclass__(
        cls,
        *,
        of: type | tuple[type, ...] = (),
        only: tuple[str, ...] = (),
        without: tuple[str, ...] = (),
        **config: Any,
    ) -> None:
        """Fill the model from the declarations of dataclasses: all, `only` some, or all `without` some.

        Of several the first is the solver's result, and has a member that is the other. Fields that a base has stay as
        they are, but for the member of the result that holds them.
        """
        super().__init_subclass__(**config)
        records = of if isinstance(of, tuple) else (of,)
        inherited = {
            name: each for base in reversed(cls.__mro__) for name, each in vars(base).get("origins", {}).items()
        }
        for name, kind in get_annotations(cls).items():
            given = _declaration(kind)
            if isinstance(given, Input) and given.origin is not None:
                inherited[name] = Origin(*given.origin)
        if not records:
            cls.origins = inherited
            return
        members = _holders(records[0])
        cls.origins = {name: each._replace(member=members.get(each.record)) for name, each in inherited.items()}
        filled: dict[str, Any] = {}
        for record in records:
            chosen = {name: each for name, each in quantities(record).items() if name not in without}
            if only:
                chosen = {name: chosen[name] for name in only if name in chosen}
            filled |= cls._filled(record, chosen, members.get(record))
        cls._check_names({*only, *vars(cls).get("views", {})})
        own = get_annotations(cls)
        cls.__annotations__ = filled | {name: kind for name, kind in own.items() if name not in filled}
        if not only and not without:
            _MODELS.setdefault((cls._declares, records[0]), cls)

    @classmethod
    def _check_names(cls, named: set[str]) -> None:
        """Raise TypeError for names that no dataclass declares."""
        unknown = named - {each.name for each in cls.origins.values()}
        if unknown:
            raise TypeError(f"{cls.__name__} names fields that are not declared: {', '.join(sorted(unknown))}")

    @classmethod
    def _filled(cls, record: type[Any], chosen: dict[str, Quantity], member: str | None) -> dict[str, Any]:
        """Annotations for the declared fields of a dataclass that the model lacks; their defaults are set."""
        own, inherited = get_annotations(cls), {*cls.origins}
        shown = {each.name: name for name, each in cls.origins.items()}
        shown |= {name: cls._shown(each, name) for name, each in chosen.items()}
        factories = {each.name for each in fields(record) if callable(each.default_factory)}
        filled = {}
        for name, declared in chosen.items():
            api_name = shown[name]
            if api_name in inherited and api_name not in own:
                continue
            cls.origins[api_name] = Origin(record, name, member)
            if _declaration(own.get(api_name)):
                continue
            kind = own[api_name] if api_name in own else _published(type_of(record, name), declared, cls._declares)
            optional = cls._optional or declared.detail != "summary"
            filled[api_name] = cls._annotated(kind | None if optional or member else kind, name, declared, shown)
            if api_name not in cls.__dict__:
                cls._set_default(api_name, kind, declared, optional=optional, factory=name in factories)
        return filled

    @classmethod
    def _shown(cls, declared: Quantity, name: str) -> str:
        bare = declared.unit is None or UNITS[declared.unit] == cls.member_unit
        return name if bare else f"{name}_{declared.unit}"

    @classmethod
    def _annotated(cls, kind: Any, name: str, declared: Quantity, shown: dict[str, str]) -> Any:
        known: dict[str, Any] = {each.name: getattr(declared, each.name) for each in fields(declared)}
        if declared.axis:
            axes = tuple(shown.get(axis, axis) for axis in np.atleast_1d(declared.axis).tolist())
            known["axis"] = axes if isinstance(declared.axis, tuple) else axes[0]
        if cls._declares is Output:
            return Annotated[kind, Output(**known, **asdict(cls.views.get(name, View())))]
        if declared.length:
            least, most = declared.length
            return Annotated[kind, Field(min_length=least or None, max_length=most), Input(**known)]
        return Annotated[kind, Input(**known)]

    @classmethod
    def _set_default(cls, name: str, kind: Any, declared: Quantity, *, optional: bool, factory: bool) -> None:
        """The default of a filled field; results have none."""
        if optional:
            setattr(cls, name, None)
        elif cls._declares is Input and isinstance(declared.default, tuple):
            setattr(cls, name, Field(default_factory=lambda: [*declared.default]))
        elif cls._declares is Input and declared.default is not ...:
            setattr(cls, name, declared.default)
        elif cls._declares is Input and factory:
            setattr(cls, name, kind())

    @classmethod
    def solver_name(cls, name: str) -> str:
        """The solver's name of a field."""
        return cls.origins[name].name if name in cls.origins else split_unit(name)[0]

    @classmethod
    def unit_of(cls, name: str) -> Unit | None:
        """The unit of a field."""
        return split_unit(name)[1] or cls.member_unit

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        """The schema with `x-unit` added field by field, and `x-exclusive`."""
        document = handler(schema)
        definition = handler.resolve_ref_schema(document)
        for name, field in definition.get("properties", {}).items():
            unit = cls.unit_of(name) or getattr(cls.model_fields[name].annotation, "member_unit", None)
            if unit is not None:
                field["x-unit"] = unit.symbol
        if cls.exclusive:
            definition["x-exclusive"] = [list(group) for group in cls.exclusive]
        return document


_MODELS: dict[tuple[type, type], type[Documented]] = {}
"""The first model filled from a dataclass stands for it wherever another dataclass holds it."""


def declared(kind: type, name: str, **changes: Any) -> Input:
    """The declaration of a dataclass's field, changed for one request."""
    known = quantities(kind)[name]
    return Input(**{each.name: getattr(known, each.name) for each in fields(known)} | changes, origin=(kind, name))


def _holders(record: type) -> dict[Any, str]:
    """The members of a dataclass by the dataclass that each holds, alone or optional."""
    hints = get_type_hints(record)
    found: dict[Any, str] = {}
    for each in fields(record):
        hint = hints[each.name]
        kinds = get_args(hint) if get_origin(hint) in {Union, UnionType} else (hint,)
        found |= {kind: each.name for kind in kinds if is_dataclass(kind)}
    return found


def _declaration(annotation: Any) -> Input | Output | None:
    """The declaration that an annotation brings."""
    metadata = get_args(annotation)[1:] if get_origin(annotation) is Annotated else ()
    return next((each for each in metadata if isinstance(each, Input | Output)), None)


def _published(hint: Any, declared: Quantity, declares: type) -> Any:
    """The type of a field in the interface: models for dataclasses, lists for tuples and arrays."""
    origin, arguments = get_origin(hint), get_args(hint)
    if isinstance(hint, type) and is_dataclass(hint):
        return _MODELS[declares, hint]
    if origin in {Union, UnionType}:
        return Union[tuple(_published(each, declared, declares) for each in arguments)]  # noqa: UP007
    if origin is np.ndarray:
        number: Any = bool if "bool" in str(arguments[1]) else float
        row = _list_of(number | None if declared.gaps else number)
        return _list_of(row) if isinstance(declared.axis, tuple) else row
    if origin is tuple:
        listed = _list_of(_published(arguments[0], declared, declares))
        if declares is Input and arguments[-1] is not Ellipsis:
            return Annotated[listed, Field(min_length=len(arguments), max_length=len(arguments))]
        return listed
    return hint


def _list_of(kind: Any) -> Any:
    return list[kind]


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
    meaning = meaning_of(info)
    level = LEVELS.index(meaning.detail) if isinstance(meaning, Output) else 0
    origin = model.origins.get(name)
    record, member = (origin.record, origin.member) if origin else (None, None)
    return _Field(name, model.solver_name(name), model.unit_of(name), level, group_of(info.annotation), record, member)


def kinds(annotation: Any) -> Iterator[Any]:
    """The types of single values that an annotation allows, alone, as one of several or as items of a list."""
    if get_origin(annotation) is Annotated:
        yield from kinds(get_args(annotation)[0])
    elif get_origin(annotation) in {Union, UnionType, list, tuple}:
        for kind in get_args(annotation):
            yield from kinds(kind)
    elif annotation is not NoneType:
        yield annotation


def dimensions(annotation: Any) -> int:
    """How many lists stand around a value: 0 for a scalar, 1 for a list, 2 for a matrix."""
    if get_origin(annotation) is Annotated:
        return dimensions(get_args(annotation)[0])
    if get_origin(annotation) is list:
        return 1 + dimensions(get_args(annotation)[0])
    if get_origin(annotation) in {Union, UnionType}:
        return max(dimensions(kind) for kind in get_args(annotation))
    return 0


def group_of(annotation: Any) -> type[Documented] | None:
    """The group or section that a field holds, alone, optional or as the item of a list; None for plain values."""
    return next((kind for kind in kinds(annotation) if isinstance(kind, type) and issubclass(kind, Documented)), None)


def built(kind: type[T], sections: tuple[Documented, ...], known: dict[str, Any]) -> T:
    """The solver's dataclass in SI from the sections that have its fields, the first of several that has one.

    Sections inside these fill the dataclasses inside it; what is `known` stands for fields of its own.
    """
    given: dict[str, Any] = {}
    record: Any = kind
    for section in reversed(sections):
        for name, field, inner in _members(type(section), record):
            if name not in known:
                value = getattr(section, field.name)
                given[name] = _scaled(value, field.unit) if inner is None else _inner(value, inner)
    return kind(**given | known)


def _inner(value: Any, kind: type[Any]) -> Any:
    if value is None:
        return None
    return tuple(built(kind, (each,), {}) for each in value) if isinstance(value, list) else built(kind, (value,), {})


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


def _record_in(hint: Any) -> Any:
    """The dataclass in a type, alone, optional or as the item of a tuple; None where there is none."""
    return next(filter(is_dataclass, kinds(hint)), None)


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
            found[field.name] = {"__all__": inner} if dimensions(group.model_fields[field.name].annotation) else inner
    return found


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


class Section(Documented):
    """A part of a request: unknown fields are refused, numbers are numbers, finite and in range.

    `choice_code` is the code of an error where two fields that exclude each other are given, `choice_missing` that
    where none is, if one is required.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)
    choice_code: ClassVar[LiteralString] = "exclusive"
    choice_missing: ClassVar[LiteralString | None] = None

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

    def si(self, kind: type[T], *others: "Section", **known: Any) -> T:
        """The solver's dataclass in SI that these fields fill, with those of others and with what is known of it."""
        return built(kind, (self, *others), known)

    def unused(self) -> set[str]:
        """Names, dotted below this section, of fields and sections that the values given leave out of a result."""
        return set()

    def stands_for_null(self, _name: str) -> Any:
        """What a field that was left null stands for, where the section itself knows it."""
        return None


class Request(Section):
    """The body of a calculation."""

    detail: Annotated[
        Detail,
        Input("level of detail", text="what to return: scalars, scalars and curves, or also two-dimensional fields"),
    ] = "curves"

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        """The schema as the docs page shows it best: what is required first, the level of detail last."""
        document = super().__get_pydantic_json_schema__(schema, handler)
        definition = handler.resolve_ref_schema(document)
        required = definition.get("required", ())
        rank = {name: (name not in required, name == "detail") for name in definition["properties"]}
        definition["properties"] = {name: definition["properties"][name] for name in sorted(rank, key=rank.__getitem__)}
        return document

    @abstractmethod
    def inputs(self) -> Any:
        """The solver's inputs, SI."""

    def options(self) -> dict[str, Any]:
        """The options in force, by their names in the contract."""
        options: dict[str, Any] = self.model.model_dump()
        return options

    def assumed_by_the_model(self) -> dict[str, str]:
        """What the options in force take for granted whatever else is given: reasons by dotted names of options."""
        return {}


class Group(Documented):
    """A part of a response; nothing in it is NaN or infinite."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)
    _declares: ClassVar = Output


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


class Response(Group):
    """What every result says about itself; each adds its results."""

    _optional: ClassVar = True

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
        str,
        Output("sources of the solvers", text="SHA-256 of the solvers' syntax trees; equal for equal calculations"),
    ]
    model: Annotated[dict[str, Any], Output("options in force")]
    derived: Annotated[Derived | None, Output("derived", text="what follows from the request before any physics")] = (
        None
    )
    inputs: Annotated[
        dict[str, Any],
        Output("inputs", text="the request with its defaults, to be posted"),
    ]
    case: Annotated[
        str,
        Output("case", text="SHA-256 of endpoint, inputs and sources; equal cases have equal results"),
    ]

    _result: Any = PrivateAttr(default=None)

    @property
    def result(self) -> Any:
        """The solver's result that the response was read from, in SI; None where there is none."""
        return self._result

    def read_from(self, result: Any) -> Self:
        """The response with the solver's result kept beside it, for its figures."""
        self._result = result
        return self

    @classmethod
    def __pydantic_init_subclass__(cls, **_: Any) -> None:
        """Results stand before what they rest on."""
        for name in ("assumptions", "model_version", "sources", "model", "derived", "inputs", "case"):
            cls.model_fields[name] = cls.model_fields.pop(name)
        cls.model_rebuild(force=True)
