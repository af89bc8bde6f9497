"""The fields of requests and responses as a tree of sections, for forms, tables, files, studies and tests.

A solver's errors and warnings contain the solver's own names of inputs. `field_path` returns the request field that
belongs to such a name.
"""

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from functools import cache
from itertools import product
from types import NoneType
from typing import Any, Literal, NamedTuple, get_args, get_origin

from annotated_types import MaxLen, MinLen
from pydantic import BaseModel

from app.schema.model import Documented, Member, members
from app.schema.quantities import Input, Output, View
from solvers.quantity import Detail

Kind = Literal["number", "integer", "boolean", "text", "other"]
TYPES: dict[Any, Kind] = {float: "number", int: "integer", bool: "boolean", str: "text"}
Names = tuple[str, ...]
ITEM = "*"
"""Placeholder for the index of a list item in a path: `grooves.*.position_mm`."""


@dataclass(frozen=True, slots=True)
class Leaf:
    """A field that holds values and is not a section of further fields.

    `declared` says what the field means. `view` says how pages show and judge a result in this field. `title` is
    unique within the request or answer. If several fields are declared with the same title, the title of a section is
    therefore added to the `title` of each of these fields. `dimensions` is 0 for a scalar, 1 for a list and 2 for a
    matrix. `exclusive` and `alternatives` hold the full paths of the fields that stand in a group with this one
    (`Documented`). `axes` holds the full paths of the fields that are the axes, one path per dimension. `axes` is empty
    if the field has no axes. `pair` says whether a list holds exactly two numbers, such as the ends of a range.
    """

    path: str
    title: str
    declared: Input | Output
    view: View
    unit: str | None
    kind: Kind
    dimensions: int
    nullable: bool
    required: bool
    default: Any
    options: tuple[Any, ...]
    advanced: bool
    exclusive: tuple[str, ...]
    alternatives: tuple[str, ...]
    detail: Detail
    axes: tuple[str, ...]
    pair: bool = False

    @property
    def is_scalar(self) -> bool:
        """Whether the field holds a single value."""
        return self.dimensions == 0


@dataclass(frozen=True, slots=True)
class Branch:
    """A section of fields.

    If `repeated` is set, the field holds a list of such sections. If `optional` is set, the section may be null. In
    `path`, `*` stands for the index of a list item.
    """

    path: str
    title: str
    description: str
    model: type[Documented]
    members: tuple["Leaf | Branch", ...]
    repeated: bool = False
    optional: bool = False
    advanced: bool = False

    @property
    def leaves(self) -> tuple[Leaf, ...]:
        """The fields that are directly in this section."""
        return tuple(member for member in self.members if isinstance(member, Leaf))

    @property
    def branches(self) -> tuple["Branch", ...]:
        """The sections that are directly in this section."""
        return tuple(member for member in self.members if isinstance(member, Branch))

    @property
    def required(self) -> bool:
        """Whether a request must give at least one field of the section."""
        return any(leaf.required for leaf in self.leaves) or any(
            branch.required for branch in self.branches if not branch.repeated and not branch.optional
        )


class Place(NamedTuple):
    """A field or section of a model: the sections around it, the outermost first, and then itself."""

    way: tuple[Member, ...]

    @property
    def member(self) -> Member:
        """The field or section itself."""
        return self.way[-1]

    def names(self, *, solvers: bool = False) -> Names:
        """Return the names on the way, of the interface or of the solver; after the name of a list stands `*`."""
        names = ((member.solver_name if solvers else member.name, member.dimensions) for member in self.way)
        return tuple(part for name, dimensions in names for part in ((name, ITEM) if dimensions else (name,)))

    @property
    def path(self) -> str:
        """The dotted path of the field or section."""
        return ".".join(self.names()).removesuffix(f".{ITEM}")


def walk(model: type[BaseModel], above: tuple[Member, ...] = ()) -> Iterator[Place]:
    """Yield every field and section of a model, in the order of the schema; `above` is the way to the model."""
    for member in members(model):
        way = (*above, member)
        yield Place(way)
        for group in member.groups:
            yield from walk(group, way)


@cache
def tree(model: type[Documented]) -> Branch:
    """Return the whole request or response as one section without a name.

    If several leaves are declared with the same title, each of these leaves gets the title of a section as a
    supplement. This is the innermost section whose title distinguishes the leaf from the other leaves. Where no section
    does for several leaves, these get the titles of all sections that tell some of them apart; a single such leaf keeps
    its title.
    """
    places = [*walk(model)]
    namesakes: dict[str, dict[str, list[str]]] = defaultdict(dict)
    for place in places:
        if not place.member.groups:
            sections = [section.meaning.title for section in place.way[-2::-1]]
            namesakes[place.member.meaning.title][place.path] = sections
    titles = {}
    for title, around in namesakes.items():
        telling = {
            path: next((name for name in sections if sum(name in others for others in around.values()) == 1), None)
            for path, sections in around.items()
        }
        untold = [path for path, section in telling.items() if section is None]
        distinct = _distinct(list(around.values()))
        for path, section in telling.items():
            several = [name for name in around[path] if name in distinct]
            supplements = [section] if section else several if len(untold) > 1 else []
            titles[path] = ", ".join([title, *supplements]) if len(around) > 1 else title
    return Branch("", "", "", model, _nested(places, titles))


def _distinct(places: list[list[str]]) -> set[str]:
    """Return the sections that tell places apart: none around all places, and one of those always found together."""
    found: dict[frozenset[int], str] = {}
    for sections in places:
        for name in sections:
            found.setdefault(frozenset(at for at, others in enumerate(places) if name in others), name)
    return {name for around, name in found.items() if len(around) < len(places)}


@cache
def branches(model: type[Documented]) -> dict[str, Branch]:
    """Return all sections. The keys are the paths of the sections."""
    return {member.path: member for member in _all(tree(model)) if isinstance(member, Branch)}


@cache
def leaves(model: type[Documented]) -> tuple[Leaf, ...]:
    """Return all leaves in the order of the schema."""
    return tuple(member for member in _all(tree(model)) if isinstance(member, Leaf))


def pattern_of(path: str) -> str:
    """Return a dotted path with `*` instead of the indices of list items."""
    return ".".join(ITEM if part.isdecimal() else part for part in path.split("."))


def is_below(path: str, around: str) -> bool:
    """Return whether a path is the path `around` or leads to something inside it."""
    return f"{path}.".startswith(f"{around}.")


def leaf_at(model: type[Documented], path: str) -> Leaf | None:
    """Return the leaf at a dotted path, or None if there is no such leaf.

    In the path, the index of a list item may be a number or `*`.
    """
    return _leaf_of(model).get(pattern_of(path))


def matrix_at(model: type[Documented], path: str) -> Leaf | None:
    """Return the leaf of the matrix whose element is at a dotted path, or None if there is no such matrix."""
    return leaf_at(model, path.rpartition(".")[0].rpartition(".")[0])


def pair_at(model: type[Documented], path: str) -> Leaf | None:
    """Return the leaf of the pair of numbers of which one is at a dotted path, or None if there is no such pair."""
    whole, _, item = path.rpartition(".")
    leaf = leaf_at(model, whole) if item.isdecimal() else None
    return leaf if leaf and leaf.pair else None


def value_at(content: Any, path: str) -> Any:
    """Return the value at a dotted path of a request or answer; None if a part of the path does not exist."""
    for part in path.split("."):
        if isinstance(content, list | tuple):
            content = content[int(part)] if part.isdecimal() and int(part) < len(content) else None
        else:
            content = content.get(part) if isinstance(content, dict) else getattr(content, part, None)
    return content


def nested(values: dict[str, Any]) -> dict[str, Any]:
    """Return values by dotted paths as nested sections; numbers in a path become the items of a list."""
    content: dict[str, Any] = {}
    for path, value in values.items():
        *sections, name = path.split(".")
        here = content
        for section in sections:
            here = here.setdefault(section, {})
        here[name] = value
    listed: dict[str, Any] = _with_lists(content)
    return listed


def _with_lists(content: Any) -> Any:
    if not isinstance(content, dict):
        return content
    inner = {name: _with_lists(value) for name, value in content.items()}
    return [*inner.values()] if inner and all(map(str.isdecimal, inner)) else inner


@cache
def _leaf_of(model: type[Documented]) -> dict[str, Leaf]:
    """Return all leaves. The keys are the paths of the leaves."""
    return {leaf.path: leaf for leaf in leaves(model)}


@cache
def headlines(response: type[Documented]) -> tuple[Leaf, ...]:
    """Return the headline numbers of an answer, the most important first.

    If the class of the answer extends the class of another answer, only headline numbers in the added fields are
    returned. Numbers of the items of a list are not headlines.
    """
    added = response.__annotations__
    own = [
        leaf
        for leaf in leaves(response)
        if leaf.view.headline and (parts := leaf.path.split("."))[0] in added and ITEM not in parts
    ]
    return tuple(sorted(own, key=lambda leaf: leaf.view.headline or 0))


def _all(member: Leaf | Branch) -> Iterator[Leaf | Branch]:
    """Yield `member`. If `member` is a section, also yield all fields and sections below this section."""
    yield member
    if isinstance(member, Branch):
        for inner in member.members:
            yield from _all(inner)


def _nested(places: list[Place], titles: dict[str, str]) -> tuple[Leaf | Branch, ...]:
    """Return the fields and sections of a whole model. `titles` maps the paths of leaves to their titles."""
    members: dict[str, tuple[Leaf | Branch, ...]] = defaultdict(tuple)
    for place in reversed(places):  # what is in a section before the section itself
        around = place.path.rpartition(".")[0].removesuffix(f".{ITEM}")
        made = _branch(place, members[place.path]) if place.member.groups else _leaf(place, titles[place.path])
        members[around] = (made, *members[around])
    return members[""]


def _branch(place: Place, members: tuple[Leaf | Branch, ...]) -> Branch:
    meaning = place.member.meaning
    return Branch(
        path=place.path,
        title=meaning.title,
        description=meaning.description,
        model=place.member.groups[0],
        members=members,
        repeated=place.member.dimensions > 0,
        optional=NoneType in get_args(place.member.info.annotation),
        advanced=meaning.advanced,
    )


def _leaf(place: Place, title: str) -> Leaf:
    """Return the leaf at a place.

    Its level of detail is the level that the field declares; if that is `summary`, the level of the innermost section
    around it that declares another one.
    """
    member, prefix = place.member, place.path.rpartition(".")[0]
    info, meaning, options = member.info, member.meaning, next(filter(None, map(options_of, member.kinds)), ())

    def fellows(kind: str) -> tuple[str, ...]:
        groups: tuple[tuple[str, ...], ...] = getattr(member.model, kind, ())
        names = (name for group in groups if member.name in group for name in group if name != member.name)
        return tuple(_absolute(name, prefix) for name in names)

    details = (step.meaning.detail for step in reversed(place.way) if step.meaning.detail != "summary")
    return Leaf(
        path=place.path,
        title=title,
        declared=meaning,
        view=meaning if isinstance(meaning, Output) else View(),
        unit=member.unit.symbol if member.unit else None,
        kind=next((TYPES[kind] for kind in member.kinds if kind in TYPES), "text" if options else "other"),
        dimensions=member.dimensions,
        nullable=NoneType in get_args(info.annotation),
        required=info.is_required(),
        default=None if info.is_required() else info.get_default(call_default_factory=True),
        options=options,
        advanced=any(step.meaning.advanced for step in place.way),
        exclusive=fellows("exclusive"),
        alternatives=fellows("alternatives"),
        detail=next(details, "summary"),
        axes=tuple(_absolute(axis, prefix) for axis in meaning.axes) if isinstance(meaning, Output) else (),
        pair=member.dimensions == 1
        and {MinLen(2), MaxLen(2)} <= {bound for bound in info.metadata if isinstance(bound, MinLen | MaxLen)},
    )


def _absolute(name: str, prefix: str) -> str:
    """Return the full path of a field.

    A `name` without a dot is a field in the section `prefix`. A `name` with a dot is already a full path.
    """
    return name if "." in name or not prefix else f"{prefix}.{name}"


def options_of(kind: Any) -> tuple[Any, ...]:
    """Return the permissible words if a type is a choice of words, otherwise an empty tuple."""
    if get_origin(kind) is Literal:
        return get_args(kind)
    return tuple(member.value for member in kind) if isinstance(kind, type) and issubclass(kind, Enum) else ()


def field_path(request: Documented, name: str | None) -> str | None:
    """Return the dotted path of the request field that a solver calls `name`, or None if no field matches.

    `name` is a dotted name of the solver, in which outer sections may be missing. If several fields match, return the
    path of the outermost field. If the request gives an alternative instead of the field, return the path of the
    alternative. If the items of a list have no such field, return the path of the list item.
    """
    parts = name.split(".") if name else []
    indices = [part for part in parts if part.isdecimal()]
    wanted = tuple(ITEM if part.isdecimal() else part for part in parts)
    own, brief = _by_solvers_names(type(request))
    while wanted:
        # The first names may be those of solver inputs that contain all inputs of the request.
        found = brief.get(wanted) or next((own[wanted[at:]] for at in range(len(wanted)) if wanted[at:] in own), None)
        if found and (path := _sent(request, found, iter(indices))):
            return path
        wanted = wanted[:-1] if ITEM in wanted[:-1] else ()
    return None


@cache
def _by_solvers_names(model: type[Documented]) -> tuple[dict[Names, Names], dict[Names, Names]]:
    """Return the names of fields and list items in the interface, by the solver's names: all, and without sections."""
    own: dict[Names, Names] = {}
    for place in walk(model):
        theirs, ours = place.names(solvers=True), place.names()
        own |= {theirs: ours} | ({theirs[:-1]: ours[:-1]} if place.member.dimensions else {})
    brief: dict[Names, Names] = {}
    for *around, last in sorted(own, key=len):
        for kept in product((True, False), repeat=len(around)):
            names = (name for name, keep in zip(around, kept, strict=True) if keep or name == ITEM)
            brief.setdefault((*names, last), own[(*around, last)])
    return own, brief


def _sent(request: Documented, path: Names, indices: Iterator[str]) -> str | None:
    """Return the dotted path of a request field, with the indices of list items.

    `path` has `*` instead of every index, and `indices` yields the indices. If the request gives an alternative
    instead of a field on the path, the result names the alternative. Return None if the request lacks a section or a
    list item on the path.
    """
    here: Any = request
    taken: list[str] = []
    for part in path:
        if part == ITEM and isinstance(here, list) and int(index := next(indices)) < len(here):
            here = here[int(index)]
            taken.append(index)
        elif part != ITEM and isinstance(here, Documented):
            fellows = [fellow for group in here.exclusive if part in group for fellow in group]
            sent = (name for name in (part, *fellows) if getattr(here, name) is not None)
            taken.append(next(sent, part))
            here = getattr(here, taken[-1])
        else:
            return None
    return ".".join(taken)
