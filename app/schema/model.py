"""Models of requests and responses, filled from the dataclasses of the solvers.

    class CouplingModel(Section, of=si.ModelOptions):
        \"\"\"Choices where the paper leaves room.\"\"\"

has a field for each declaration on `si.ModelOptions`, named with the suffix of its unit. What stands in the class
itself is an ordinary field of pydantic: under the name of a filled field it changes the type or the default, and with
`Input` or `Output` beside the type it replaces the declaration.
"""

from dataclasses import asdict, fields, is_dataclass
from inspect import get_annotations
from types import UnionType
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, NamedTuple, Union, get_args, get_origin, get_type_hints

import numpy as np
from pydantic import BaseModel, Field, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema

from app.schema.quantities import Input, Output, View
from app.schema.units import split_unit
from solvers.quantity import UNITS, Quantity, Unit, quantities, type_of


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
        if not records:
            cls.origins = inherited
            return
        members = _members(records[0])
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
    return Input(**{each.name: getattr(known, each.name) for each in fields(known)} | changes)


def _members(record: type) -> dict[Any, str]:
    """The members of a dataclass by the dataclass that each holds, alone or optional."""
    hints = get_type_hints(record)
    found: dict[Any, str] = {}
    for each in fields(record):
        hint = hints[each.name]
        kinds = get_args(hint) if get_origin(hint) in {Union, UnionType} else (hint,)
        found |= {kind: each.name for kind in kinds if is_dataclass(kind)}
    return found


def _declaration(annotation: Any) -> bool:
    """Whether an annotation brings its own declaration."""
    metadata = get_args(annotation)[1:] if get_origin(annotation) is Annotated else ()
    return any(isinstance(each, Quantity) for each in metadata)


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
