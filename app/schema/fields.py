"""The fields of a request or response in their sections: what forms, tables, files, studies and tests walk over.

`field_path` tells which of them a solver means that names one of its own inputs.
"""

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, replace
from enum import Enum
from functools import cache
from types import NoneType
from typing import Any, Literal, get_args, get_origin

from pydantic.fields import FieldInfo

from app.schema.model import Documented, dimensions, group_of, kinds
from app.schema.quantities import Input, Output, View, meaning_of
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
    """The whole request or response as one section without a name."""
    return _titled(Branch("", "", "", model, tuple(_members(model, _Place()))))


@cache
def branches(model: type[Documented]) -> dict[str, Branch]:
    """Every section by its path."""
    return {branch.path: branch for branch in _sections(tree(model))}


@cache
def leaves(model: type[Documented]) -> tuple[Leaf, ...]:
    """Every leaf in the order of the schema."""
    return tuple(leaf for leaf, _ in _placed(tree(model)))


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


def _sections(branch: Branch) -> Iterator[Branch]:
    yield branch
    for inner in branch.branches:
        yield from _sections(inner)


def _placed(branch: Branch, titles: tuple[str, ...] = ()) -> Iterator[tuple[Leaf, tuple[str, ...]]]:
    """Every leaf below a section with the titles of the sections around it."""
    for member in branch.members:
        if isinstance(member, Leaf):
            yield member, titles
        else:
            yield from _placed(member, (*titles, member.title))


def _titled(root: Branch) -> Branch:
    """The tree with titles that tell its leaves apart: each names the nearest section that its namesakes lack."""
    namesakes = defaultdict(list)
    for leaf, titles in _placed(root):
        namesakes[leaf.title].append((leaf.path, titles))
    distinct = {}
    for title, places in namesakes.items():
        for path, titles in places:
            telling = (name for name in reversed(titles) if sum(name in others for _, others in places) == 1)
            section = next(telling, None)
            distinct[path] = f"{title}, {section}" if section and len(places) > 1 else title
    return _renamed(root, distinct)


def _renamed(branch: Branch, titles: dict[str, str]) -> Branch:
    members = (
        replace(member, title=titles[member.path]) if isinstance(member, Leaf) else _renamed(member, titles)
        for member in branch.members
    )
    return replace(branch, members=tuple(members))


@dataclass(frozen=True, slots=True)
class _Place:
    """Where the walk is: the path so far, and what its sections hand down."""

    path: tuple[str, ...] = ()
    advanced: bool = False
    detail: Detail = "summary"


def _members(model: type[Documented], around: _Place) -> Iterator[Leaf | Branch]:
    for name, info in model.model_fields.items():
        meaning = meaning_of(info)
        if meaning is None:
            continue
        detail = meaning.detail if isinstance(meaning, Output) and meaning.detail != "summary" else around.detail
        place = _Place((*around.path, name), around.advanced or meaning.advanced, detail)
        group = group_of(info.annotation)
        if group is None:
            yield _leaf(model, info, meaning, place)
            continue
        repeated = dimensions(info.annotation) > 0
        inside = replace(place, path=(*place.path, ITEM)) if repeated else place
        yield Branch(
            ".".join(place.path),
            meaning.title,
            meaning.description,
            group,
            tuple(_members(group, inside)),
            repeated,
            NoneType in get_args(info.annotation),
            meaning.advanced,
        )


def _leaf(model: type[Documented], info: FieldInfo, meaning: Input | Output, place: _Place) -> Leaf:
    *sections, name = place.path
    prefix, unit, allowed = ".".join(sections), model.unit_of(name), tuple(kinds(info.annotation))
    fellows = (each for group in model.exclusive if name in group for each in group if each != name)
    return Leaf(
        path=".".join(place.path),
        title=meaning.title,
        declared=meaning,
        view=meaning if isinstance(meaning, Output) else View(),
        description=meaning.description,
        unit=unit.symbol if unit else None,
        kind=next((_KINDS[kind] for kind in allowed if kind in _KINDS), "text" if _options(allowed) else "other"),
        dimensions=dimensions(info.annotation),
        nullable=NoneType in get_args(info.annotation),
        required=info.is_required(),
        default=None if info.is_required() else info.get_default(call_default_factory=True),
        options=_options(allowed),
        advanced=place.advanced,
        exclusive=tuple(_absolute(each, prefix) for each in fellows),
        detail=place.detail,
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


_Names = tuple[str, ...]


def field_path(request: Documented, name: str) -> str | None:
    """The dotted request field that the solver's dotted `name` (its end suffices) means, or None.

    Of several it is the outermost, of fields that exclude each other the one that was sent; where an item of a list
    lacks what the solver names in it, it is the item.
    """
    for theirs, ours in request.solver_names.items():
        name = f".{name}.".replace(f".{theirs}.", f".{ours}.").strip(".")
    indices = [part for part in name.split(".") if part.isdecimal()]
    wanted = tuple(ITEM if part.isdecimal() else part for part in name.split("."))
    while wanted:
        found = _fields(type(request)).get(wanted)
        if found and (path := _sent(request, found, iter(indices))):
            return path
        wanted = wanted[:-1] if ITEM in wanted[:-1] else ()
    return None


@cache
def _fields(model: type[Documented]) -> dict[_Names, _Names]:
    """The fields of a request by every end of the solver's names for them, the outermost first."""
    found: dict[_Names, _Names] = {}
    for theirs, ours in sorted(_named(model), key=lambda each: len(each[0])):
        for end in _ends(theirs):
            found.setdefault(end, ours)
    return found


def _named(model: type[Documented], theirs: _Names = (), ours: _Names = ()) -> Iterator[tuple[_Names, _Names]]:
    """Every field and list item of a model: the solver's names on its path, and its own."""
    for name, info in model.model_fields.items():
        si_path, path = (*theirs, model.solver_name(name)), (*ours, name)
        yield si_path, path
        if dimensions(info.annotation):
            si_path, path = (*si_path, ITEM), (*path, ITEM)
            yield si_path, path
        if group := group_of(info.annotation):
            yield from _named(group, si_path, path)


def _ends(path: _Names) -> Iterator[_Names]:
    """The names by which a solver may mean a field: between a list item and the end it may leave sections out."""
    if ITEM not in path:
        yield from (path[start:] for start in range(len(path)))
        return
    after = len(path) - path[::-1].index(ITEM)
    for start in range(after - 1):
        yield from (path[start:after] + path[end:] for end in range(after, max(after + 1, len(path))))


def _sent(request: Documented, path: _Names, indices: Iterator[str]) -> str | None:
    """The path in this request, the field sent of those that exclude each other; None where an item lacks."""
    here: Any = request
    taken: list[str] = []
    for part in path:
        name = next(indices, "") if part == ITEM else part
        if part == ITEM:
            if not isinstance(here, list | tuple) or not name or int(name) >= len(here):
                return None
            here = here[int(name)]
        elif isinstance(here, Documented):
            name = _given(here, name)
            here = getattr(here, name)
        else:
            return None
        taken.append(name)
    return ".".join(taken)


def _given(section: Documented, name: str) -> str:
    """The field itself, or the one given instead of it."""
    if getattr(section, name) is None:
        fellows = (fellow for group in section.exclusive if name in group for fellow in group)
        return next((fellow for fellow in fellows if getattr(section, fellow) is not None), name)
    return name
