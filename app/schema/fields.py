"""The fields of a request or response in their sections: what forms, tables, files, studies and tests walk over.

`field_path` tells which of them a solver means that names one of its own inputs.
"""

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from functools import cache
from types import NoneType
from typing import Any, Literal, get_args, get_origin

from app.schema.model import Documented, Member, members
from app.schema.quantities import Output, View
from solvers.quantity import Detail, Quantity

Kind = Literal["number", "integer", "boolean", "text", "other"]
_KINDS: dict[Any, Kind] = {float: "number", int: "integer", bool: "boolean", str: "text"}
ITEM = "*"
"""Stands for the index of a list item in a path: `grooves.*.position_mm`."""


@dataclass(frozen=True, slots=True)
class Leaf:
    """A field that holds values, not fields.

    `declared` says what the field means, `view` how a result is judged. `title` is unique within its request or answer:
    where groups of one kind repeat, the group is named behind it. `dimensions` is 0 for a scalar, 1 for a list, 2 for a
    matrix; `axes` are full paths, as long as the field has dimensions, or empty.
    """

    path: str
    title: str
    declared: Quantity
    view: View
    description: str
    unit: str | None
    kind: Kind
    dimensions: int
    nullable: bool
    required: bool
    default: Any
    options: tuple[Any, ...]
    advanced: bool
    exclusive: tuple[str, ...]
    detail: Detail
    axes: tuple[str, ...]

    @property
    def is_scalar(self) -> bool:
        """Whether it holds one value."""
        return self.dimensions == 0


@dataclass(frozen=True, slots=True)
class Branch:
    """A section: `repeated` is a list of them, `optional` may be null; `path` has `*` for indices of lists."""

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
        """Its own fields."""
        return tuple(member for member in self.members if isinstance(member, Leaf))

    @property
    def branches(self) -> tuple["Branch", ...]:
        """Its own sections."""
        return tuple(member for member in self.members if isinstance(member, Branch))

    @property
    def required(self) -> bool:
        """Whether something in it must be given."""
        return any(leaf.required for leaf in self.leaves) or any(
            branch.required for branch in self.branches if not branch.repeated and not branch.optional
        )


@cache
def tree(model: type[Documented]) -> Branch:
    """The whole request or response as one section without a name.

    Titles tell its leaves apart: each names the nearest section that its namesakes lack.
    """
    namesakes: dict[str, dict[str, list[str]]] = defaultdict(dict)
    for way in _ways(model):
        *around, leaf = way
        if leaf.group is None:
            namesakes[leaf.meaning.title][_path(way)] = [each.meaning.title for each in reversed(around)]
    titles = {}
    for title, places in namesakes.items():
        for path, sections in places.items():
            telling = (name for name in sections if sum(name in others for others in places.values()) == 1)
            section = next(telling, None) if len(places) > 1 else None
            titles[path] = f"{title}, {section}" if section else title
    return Branch("", "", "", model, _below(model, (), titles))


@cache
def branches(model: type[Documented]) -> dict[str, Branch]:
    """Every section by its path."""
    return {each.path: each for each in _all(tree(model)) if isinstance(each, Branch)}


@cache
def leaves(model: type[Documented]) -> tuple[Leaf, ...]:
    """Every leaf in the order of the schema."""
    return tuple(each for each in _all(tree(model)) if isinstance(each, Leaf))


def leaf_at(model: type[Documented], path: str) -> Leaf | None:
    """The leaf at a dotted path, whose list indices may be numbers; None where there is none."""
    wanted = ".".join(ITEM if part.isdecimal() else part for part in path.split("."))
    return next((leaf for leaf in leaves(model) if leaf.path == wanted), None)


@cache
def headlines(response: type[Documented]) -> tuple[Leaf, ...]:
    """The numbers that decide, the most important first.

    An answer that extends another one has its own: those of the fields that it adds.
    """
    added = response.__annotations__
    own = [leaf for leaf in leaves(response) if leaf.view.headline and leaf.path.split(".")[0] in added]
    return tuple(sorted(own, key=lambda leaf: leaf.view.headline or 0))


def _all(member: Leaf | Branch) -> Iterator[Leaf | Branch]:
    """A section and everything below it."""
    yield member
    if isinstance(member, Branch):
        for inner in member.members:
            yield from _all(inner)


_Way = tuple[Member, ...]
_Names = tuple[str, ...]


def _ways(model: type[Documented], above: _Way = ()) -> Iterator[_Way]:
    """For every field of a model and of its sections, the fields around it from the outermost on, and the field."""
    for each in members(model):
        yield (*above, each)
        if each.group:
            yield from _ways(each.group, (*above, each))


def _names(way: _Way, *, solvers: bool = False) -> _Names:
    """The names along a way, in the interface or in the solver, with `*` after each list."""
    names = ((each.solver_name if solvers else each.name, each.dimensions) for each in way)
    return tuple(part for name, listed in names for part in ((name, ITEM) if listed else (name,)))


def _path(way: _Way) -> str:
    return ".".join(_names(way)).removesuffix(f".{ITEM}")


def _below(model: type[Documented], above: _Way, titles: dict[str, str]) -> tuple[Leaf | Branch, ...]:
    """The fields and sections of a model, which take over the level of detail of the sections around them."""
    found: list[Leaf | Branch] = []
    for each in members(model):
        way = (*above, each)
        if each.group is None:
            found.append(_leaf(model, way, titles))
            continue
        found.append(
            Branch(
                _path(way),
                each.meaning.title,
                each.meaning.description,
                each.group,
                _below(each.group, way, titles),
                repeated=each.dimensions > 0,
                optional=NoneType in get_args(each.info.annotation),
                advanced=each.meaning.advanced,
            )
        )
    return tuple(found)


def _leaf(model: type[Documented], way: _Way, titles: dict[str, str]) -> Leaf:
    member, path = way[-1], _path(way)
    info, meaning, prefix = member.info, member.meaning, path.rpartition(".")[0]
    options = _options(member.kinds)
    fellows = (each for group in model.exclusive if member.name in group for each in group if each != member.name)
    details = (each.meaning.detail for each in reversed(way) if each.meaning.detail != "summary")
    return Leaf(
        path=path,
        title=titles[path],
        declared=meaning,
        view=meaning if isinstance(meaning, Output) else View(),
        description=meaning.description,
        unit=member.unit.symbol if member.unit else None,
        kind=next((_KINDS[kind] for kind in member.kinds if kind in _KINDS), "text" if options else "other"),
        dimensions=member.dimensions,
        nullable=NoneType in get_args(info.annotation),
        required=info.is_required(),
        default=None if info.is_required() else info.get_default(call_default_factory=True),
        options=options,
        advanced=any(each.meaning.advanced for each in way),
        exclusive=tuple(_absolute(each, prefix) for each in fellows),
        detail=next(details, "summary"),
        axes=tuple(_absolute(axis, prefix) for axis in meaning.axes) if isinstance(meaning, Output) else (),
    )


def _absolute(name: str, prefix: str) -> str:
    """The full path of a sibling; a dotted name is one already."""
    return name if "." in name or not prefix else f"{prefix}.{name}"


def _options(allowed: tuple[Any, ...]) -> tuple[Any, ...]:
    """The words of a choice."""
    for kind in allowed:
        if get_origin(kind) is Literal:
            return get_args(kind)
        if isinstance(kind, type) and issubclass(kind, Enum):
            return tuple(member.value for member in kind)
    return ()


def field_path(request: Documented, name: str) -> str | None:
    """The dotted request field that the solver's dotted `name` (its end suffices) means, or None.

    Of several it is the outermost, of fields that exclude each other the one that was sent; where an item of a list
    lacks what the solver names in it, it is the item.
    """
    indices = [part for part in name.split(".") if part.isdecimal()]
    wanted = tuple(ITEM if part.isdecimal() else part for part in name.split("."))
    while wanted:
        found = _meant(type(request), wanted)
        if found and (path := _sent(request, found, iter(indices))):
            return path
        wanted = wanted[:-1] if ITEM in wanted[:-1] else ()
    return None


@cache
def _meant(model: type[Documented], wanted: _Names) -> _Names | None:
    """The names on the way to the outermost field or list item that a solver means by these names.

    The solver may leave out sections, but not lists; before a name at the root it may name parts of its inputs that
    the request does not have.
    """
    known: dict[_Names, _Names] = {}
    for way in _ways(model):
        theirs, ours = _names(way, solvers=True), _names(way)
        known |= {theirs: ours} | ({theirs[:-1]: ours[:-1]} if way[-1].dimensions else {})
    for start in range(len(wanted)):
        for theirs in sorted(known, key=len):
            rest = iter(theirs)
            if (
                theirs[-1] == wanted[-1]
                and theirs.count(ITEM) == wanted.count(ITEM)
                and all(name in rest for name in wanted[start:])  # in their order
                and (start == 0 or theirs[0] == wanted[start])
            ):
                return known[theirs]
    return None


def _sent(request: Documented, path: _Names, indices: Iterator[str]) -> str | None:
    """The path in this request, the field sent of those that exclude each other; None where a section or item lacks."""
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
