"""Every leaf of a request or response, one after the other: what forms, tables, files, studies and tests walk over."""

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, replace
from enum import Enum
from functools import cache
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic.fields import FieldInfo

from app.schema.conversion import group_of
from app.schema.model import Documented
from app.schema.quantities import Bound, Input, Output
from solvers.quantity import Detail

Kind = Literal["number", "integer", "boolean", "text", "other"]
_KINDS: dict[Any, Kind] = {float: "number", int: "integer", bool: "boolean", str: "text"}
ITEM = "*"
"""Stands for the index of a list item in a path: `grooves.*.position_mm`."""


@dataclass(frozen=True, slots=True)
class Leaf:
    """A field that holds values, not fields.

    `title` is unique within its request or answer: where groups of one kind repeat, the group is named behind it.
    `dimensions` is 0 for a scalar, 1 for a list, 2 for a matrix. `bounds` are `ge`, `gt`, `le`, `lt`, those there are;
    `axes` are full paths, as long as the field has dimensions, or empty.
    """

    path: str
    title: str
    description: str
    symbol: str | None
    unit: str | None
    source: str | None
    kind: Kind
    dimensions: int
    nullable: bool
    required: bool
    default: Any
    default_text: str | None
    bounds: dict[str, float]
    options: tuple[Any, ...]
    assumed: str | None
    advanced: bool
    tolerance: float | None
    relative_tolerance: float | None
    exclusive: tuple[str, ...]
    detail: Detail
    axes: tuple[str, ...]
    index: str | None
    headline: int | None
    limit: str | float | None
    bound: Bound | None
    needs: str | None
    verdict: str | None

    @property
    def is_scalar(self) -> bool:
        """Whether it holds one value."""
        return self.dimensions == 0


@cache
def leaves(model: type[Documented]) -> tuple[Leaf, ...]:
    """Every leaf in the order of the schema."""
    found = tuple(_walk(model, _Place()))
    named = defaultdict(list)
    for leaf, groups in found:
        named[leaf.title].append((leaf, groups))
    return tuple(replace(leaf, title=_distinct(leaf, groups, named[leaf.title])) for leaf, groups in found)


def leaf_at(model: type[Documented], path: str) -> Leaf | None:
    """The leaf at a dotted path, whose list indices may be numbers; None where there is none."""
    wanted = ".".join(ITEM if part.isdecimal() else part for part in path.split("."))
    return next((leaf for leaf in leaves(model) if leaf.path == wanted), None)


@cache
def headlines(response: type[Documented]) -> tuple[Leaf, ...]:
    """The numbers that decide, the most important first.

    An answer that extends another one has its own: those of the fields that it adds.
    """
    own = [leaf for leaf in leaves(response) if leaf.headline and leaf.path.split(".")[0] in response.__annotations__]
    return tuple(sorted(own, key=lambda leaf: leaf.headline or 0))


@dataclass(frozen=True, slots=True)
class _Place:
    """Where the walk is: the path so far, the groups' titles on it, and what they hand down."""

    path: tuple[str, ...] = ()
    titles: tuple[str, ...] = ()
    advanced: bool = False
    detail: Detail = "summary"


def _walk(model: type[Documented], place: _Place) -> Iterator[tuple[Leaf, tuple[str, ...]]]:
    for name, info in model.model_fields.items():
        meaning = next((item for item in info.metadata if isinstance(item, Input | Output)), None)
        if meaning is None:
            continue
        below = _below(place, name, meaning)
        group = group_of(info.annotation)
        if group is None:
            yield _leaf(model, name, info, meaning, below), place.titles
        else:
            items = (ITEM,) if _dimensions(info.annotation) else ()
            inside = replace(below, path=below.path + items, titles=(*place.titles, meaning.title))
            yield from _walk(group, inside)


def _below(place: _Place, name: str, meaning: Input | Output) -> _Place:
    return replace(
        place,
        path=(*place.path, name),
        advanced=place.advanced or (isinstance(meaning, Input) and meaning.advanced),
        detail=meaning.detail if isinstance(meaning, Output) and meaning.detail != "summary" else place.detail,
    )


def _leaf(model: type[Documented], name: str, info: FieldInfo, meaning: Input | Output, place: _Place) -> Leaf:
    kinds = tuple(_scalars(info.annotation))
    given = meaning if isinstance(meaning, Input) else None
    found = meaning if isinstance(meaning, Output) else None
    prefix, unit = ".".join(place.path[:-1]), model.unit_of(name)
    return Leaf(
        path=".".join(place.path),
        title=meaning.title,
        description=meaning.description,
        symbol=meaning.symbol,
        unit=unit.symbol if unit else None,
        source=meaning.source,
        kind=next((_KINDS[kind] for kind in kinds if kind in _KINDS), "text" if _options(kinds) else "other"),
        dimensions=_dimensions(info.annotation),
        nullable=NoneType in get_args(info.annotation),
        required=info.is_required(),
        default=None if info.is_required() else info.get_default(call_default_factory=True),
        default_text=given.default_text if given else None,
        bounds={key: bound for key in ("ge", "gt", "le", "lt") if given and (bound := getattr(given, key)) is not None},
        options=_options(kinds),
        assumed=given.assumed if given else None,
        advanced=place.advanced,
        tolerance=given.tolerance if given else None,
        relative_tolerance=given.relative_tolerance if given else None,
        exclusive=tuple(
            _absolute(fellow, prefix)
            for group in model.exclusive
            if name in group
            for fellow in group
            if fellow != name
        ),
        detail=place.detail,
        axes=tuple(_absolute(axis, prefix) for axis in found.axes) if found else (),
        index=found.index if found else None,
        headline=found.headline if found else None,
        limit=found.limit if found else None,
        bound=found.bound if found else None,
        needs=found.needs if found else None,
        verdict=found.verdict if found else None,
    )


def _absolute(name: str, prefix: str) -> str:
    """The full path of a sibling; a dotted name is one already."""
    return name if "." in name or not prefix else f"{prefix}.{name}"


def _scalars(annotation: Any) -> Iterator[Any]:
    """The types of single values that an annotation allows."""
    if get_origin(annotation) is Annotated:
        yield from _scalars(get_args(annotation)[0])
    elif get_origin(annotation) in {Union, UnionType, list}:
        for kind in get_args(annotation):
            yield from _scalars(kind)
    elif annotation is not NoneType:
        yield annotation


def _options(kinds: tuple[Any, ...]) -> tuple[Any, ...]:
    """The words of a choice."""
    for kind in kinds:
        if get_origin(kind) is Literal:
            return get_args(kind)
        if isinstance(kind, type) and issubclass(kind, Enum):
            return tuple(member.value for member in kind)
    return ()


def _dimensions(annotation: Any) -> int:
    if get_origin(annotation) is Annotated:
        return _dimensions(get_args(annotation)[0])
    if get_origin(annotation) is list:
        return 1 + _dimensions(get_args(annotation)[0])
    if get_origin(annotation) in {Union, UnionType}:
        return max(_dimensions(kind) for kind in get_args(annotation))
    return 0


def _distinct(leaf: Leaf, groups: tuple[str, ...], fellows: list[tuple[Leaf, tuple[str, ...]]]) -> str:
    """The title, with the nearest group that tells it from its namesakes."""
    if len(fellows) == 1:
        return leaf.title
    for group in reversed(groups):
        if sum(group in others for _, others in fellows) == 1:
            return f"{leaf.title}, {group}"
    return leaf.title
