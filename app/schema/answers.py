"""Answers: models that are generated from the solvers' dataclasses, and the values of a result in their units.

A dataclass that a result contains becomes a component of the API with the name of the dataclass. `group` makes a
component with another name, with other fields, or with views, which say how pages show and judge an output.
"""

from collections.abc import Callable
from functools import cache, partial
from importlib.metadata import version
from typing import Annotated, Any, ClassVar, Literal, Self, get_type_hints

from pydantic import ConfigDict, PrivateAttr

from app.schema.model import Documented, Member, generated, members, record_in, stands_for
from app.schema.quantities import Output, View
from solvers.notices import Rank
from solvers.quantity import Detail, as_json, converted, quantities

LEVELS: tuple[Detail, ...] = ("summary", "curves", "fields")
MODEL_VERSION = version("tribodrive")


class Group(Documented):
    """A part of a response; none of its numbers is NaN or infinite."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)
    views: ClassVar[dict[str, View]] = {}
    declares: ClassVar = Output

    @classmethod
    def standing_for(cls, record: Any) -> type[Documented]:
        return _COMPONENTS[record]() if record in _COMPONENTS else group(record)

    @classmethod
    def _filled(cls, kind: Any, record: Any, name: str, names: dict[Any, Any], *, nullable: bool) -> tuple[Any, Any]:
        declared = quantities(record)[name]
        unit, axis = declared.unit or getattr(kind, "member_unit", None), declared.axis
        axis = tuple(names.get(item, item) for item in axis) if isinstance(axis, tuple) else names.get(axis, axis)
        meaning = Output.of(record, name, unit=unit, axis=axis, **vars(cls.views.get(name, View())))
        optional = cls._optional or declared.left_out or declared.detail != "summary"
        return Annotated[kind | None if optional or nullable else kind, meaning], None if optional else ...


def group(
    record: Any,
    name: str = "",
    *more: Any,
    base: type[Group] = Group,
    only: tuple[str, ...] = (),
    without: tuple[str, ...] = (),
    unit: str | None = None,
    stands: bool = True,
    fields: dict[str, Any] | None = None,
    **views: View,
) -> type[Any]:
    """Return the model of a part of answers, generated from the dataclass `record` and the dataclasses `more`.

    `fields` holds the types of fields that are not those of the dataclass, `unit` the unit of all fields that name
    none, and `views` says how pages show an output, by its name in the solver. See `Documented` for the rest.
    """
    own = {"__annotations__": dict(fields or {}), "views": views, **({"member_unit": unit} if unit else {})}
    keywords = {"of": (record, *more), "only": only, "without": without, "stands": stands}
    return generated(base, name or record.__name__, own, **keywords)


_COMPONENTS: dict[Any, Callable[[], type[Group]]] = {}
"""How to make the components of dataclasses that need more than their generated model."""


def component(record: Any, name: str = "", *more: Any, **keywords: Any) -> None:
    """Say how the component of a dataclass is made, with the arguments of `group`; it is made where it is needed.

    Raises TypeError if this was said before or comes too late, because views would be lost in silence.
    """
    if record in _COMPONENTS or stands_for(Output, record):
        raise TypeError(f"the component of {record.__name__} is declared twice, or after it was needed")
    _COMPONENTS[record] = partial(group, record, name, *more, **keywords)


def named(**records: Any) -> None:
    """Give components of the API names that are not those of their dataclasses."""
    for name, record in records.items():
        component(record, name)


class Notice(Group):
    """A warning about a value that is outside its range of validity or has no meaning."""

    rank: Annotated[
        Rank,
        Output(
            "rank of the warning",
            text=(
                "invalid: a result is missing or the theory does not hold; doubtful: a limit is exceeded; "
                "note: something is left out, assumed or without meaning; the gravest come first"
            ),
        ),
    ]
    code: Annotated[str, Output("code of the warning", text="stable name, meant for programs")]
    message: Annotated[str, Output("message of the warning", text="what is out of which range, and what follows")]
    field: Annotated[
        str | None, Output("field of the warning", text="dotted name of the request field it is about")
    ] = None


class Assumption(Group):
    """A default that affects the results of the answer. This project chose the default; the paper does not state it."""

    field: Annotated[str, Output("assumed field", text="dotted name of the request field")]
    value: Annotated[Any, Output("assumed value", text="the value used")]
    reason: Annotated[str, Output("reason of the assumption", text="why this value")]


GROUNDS = frozenset({"assumptions", "model_version", "sources", "model", "derived", "inputs", "case"})
"""The names of the fields that stand last in every answer. These fields state the basis of the results."""


class Response(Group):
    """An answer: status, warnings and the basis of the results. Subclasses add the results."""

    _optional: ClassVar = True
    _stands: ClassVar = False

    status: Annotated[
        Literal["ok", "ok_with_warnings", "no_solution"],
        Output("status", text="whether the calculation succeeded; with no_solution, `residuals` says how far it came"),
    ]
    warnings: Annotated[list[Notice], Output("warnings", text="limits of validity that this case exceeds")]
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
    derived: Annotated[Any, Output("derived", text="values that the service derived from the request")] = None
    inputs: Annotated[dict[str, Any], Output("inputs", text="the request with its defaults, to be posted")]
    case: Annotated[str, Output("case", text="SHA-256 of endpoint, inputs and sources; equal cases have equal results")]

    _result: Any = PrivateAttr(default=None)

    @property
    def result(self) -> Any:
        """The solver's result in SI from which the response was read; None if the solver raised NoSolution."""
        return self._result

    def read_from(self, result: Any) -> Self:
        """Store the solver's result, which the figures need, and return this response."""
        self._result = result
        return self

    @classmethod
    def __pydantic_init_subclass__(cls, **_: Any) -> None:
        """Move the fields in `GROUNDS` behind the fields with results."""
        by_name = cls.__pydantic_fields__
        cls.__pydantic_fields__ = {name: by_name[name] for name in sorted(by_name, key=lambda name: name in GROUNDS)}
        cls.model_rebuild(force=True)


def shown(kind: type[Documented], result: Any, detail: Detail) -> dict[str, Any]:
    """Return the values of a response group, read from a solver's result, by the names of the response's fields.

    Each value is converted into the unit in the name of its field. Fields above the level of detail are left out.
    Pydantic makes the answer of them, which is quicker than to make the models here.
    """
    content: dict[str, Any] = {}
    record: Any = type(result)
    for member, holder in _sources(kind, record, detail):
        part = getattr(result, holder) if holder else result
        value = None if part is None else _displayed(getattr(part, member.solver_name), member, detail)
        if value is not None or not member.meaning.left_out:
            content[member.name] = value
    return content


@cache
def _sources(model: type[Documented], record: Any, detail: Detail) -> tuple[tuple[Member, str | None], ...]:
    """Return the fields of a response group, and the member of a result of the type `record` that holds each value.

    The member is None if the result itself holds the value. Fields that no dataclass declares, and fields above the
    level of detail, are left out.
    """
    held = {name: inner for name, hint in get_type_hints(record).items() if (inner := record_in(hint))}
    sources = []
    for member in members(model):
        if member.record and LEVELS.index(member.meaning.detail) <= LEVELS.index(detail):
            holders = (name for name, inner in held.items() if issubclass(inner, member.record))
            sources.append((member, None if issubclass(record, member.record) else next(holders, None)))
    return tuple(sources)


def _displayed(value: Any, member: Member, detail: Detail) -> Any:
    """Return a value in the unit of its field; None replaces NaN in an array, which marks a point without a value."""
    group, unit = member.group, member.unit
    inside = None if group is None else lambda part: shown(group, part, detail)
    return converted(value, lambda number: as_json(unit.from_si(number) if unit else number), inside, list)
