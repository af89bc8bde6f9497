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
    root = Branch("", "", "", model, tuple(_members(model)))
    namesakes = defaultdict(list)
    for leaf, sections in _placed(root):
        namesakes[leaf.title].append((leaf.path, sections))
    titles = {}
    for title, places in namesakes.items():
        for path, sections in places:
            telling = (name for name in reversed(sections) if sum(name in others for _, others in places) == 1)
            section = next(telling, None)
            titles[path] = f"{title}, {section}" if section and len(places) > 1 else title
    return _retitled(root, titles)


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


def _retitled(branch: Branch, titles: dict[str, str]) -> Branch:
    members = (
        replace(member, title=titles[member.path]) if isinstance(member, Leaf) else _retitled(member, titles)
        for member in branch.members
    )
    return replace(branch, members=tuple(members))


def _members(
    model: type[Documented], place: tuple[str, ...] = (), *, advanced: bool = False, detail: Detail = "summary"
) -> Iterator[Leaf | Branch]:
    """The fields and sections of a model; it hands down where it is and what the sections around say."""
    for each in members(model):
        meaning, path = each.meaning, (*place, each.name)
        said: Any = {
            "advanced": advanced or meaning.advanced,
            "detail": detail if meaning.detail == "summary" else meaning.detail,
        }
        if each.group is None:
            yield _leaf(model, each, path, **said)
            continue
        repeated = each.dimensions > 0
        yield Branch(
            ".".join(path),
            meaning.title,
            meaning.description,
            each.group,
            tuple(_members(each.group, (*path, ITEM) if repeated else path, **said)),
            repeated,
            NoneType in get_args(each.info.annotation),
            meaning.advanced,
        )


def _leaf(model: type[Documented], member: Member, place: tuple[str, ...], *, advanced: bool, detail: Detail) -> Leaf:
    info, meaning, prefix = member.info, member.meaning, ".".join(place[:-1])
    options = _options(member.kinds)
    fellows = (each for group in model.exclusive if member.name in group for each in group if each != member.name)
    return Leaf(
        path=".".join(place),
        title=meaning.title,
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
        advanced=advanced,
        exclusive=tuple(_absolute(each, prefix) for each in fellows),
        detail=detail,
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
    """The path of the outermost field that a solver means by these names.

    The solver may leave out sections, but not lists; before a name at the root it may name parts of its inputs that
    the request does not have.
    """
    for start in range(len(wanted)):
        found = [
            (theirs, ours)
            for theirs, ours in _named(model)
            if theirs[-1] == wanted[-1]
            and theirs.count(ITEM) == wanted.count(ITEM)
            and _in_order(wanted[start:], theirs)
            and (start == 0 or theirs[0] == wanted[start])
        ]
        if found:
            return min(found, key=lambda each: len(each[0]))[1]
    return None


def _in_order(names: _Names, path: _Names) -> bool:
    """Whether a path has all these names, in their order."""
    rest = iter(path)
    return all(name in rest for name in names)


def _named(model: type[Documented], theirs: _Names = (), ours: _Names = ()) -> Iterator[tuple[_Names, _Names]]:
    """Every field and list item of a model: the solver's names on its path, and its own."""
    for each in members(model):
        si_path, path = (*theirs, each.solver_name), (*ours, each.name)
        yield si_path, path
        if each.dimensions:
            si_path, path = (*si_path, ITEM), (*path, ITEM)
            yield si_path, path
        if each.group:
            yield from _named(each.group, si_path, path)


def _sent(request: Documented, path: _Names, indices: Iterator[str]) -> str | None:
    """The path in this request, the field sent of those that exclude each other; None where a section or item lacks."""
    here: Any = request
    taken: list[str] = []
    for part in path:
        if part == ITEM and isinstance(here, list) and int(index := next(indices)) < len(here):
            here = here[int(index)]
            taken.append(index)
        elif part != ITEM and isinstance(here, Documented):
            name = _given(here, part)
            here = getattr(here, name)
            taken.append(name)
        else:
            return None
    return ".".join(taken)


def _given(section: Documented, name: str) -> str:
    """The field itself, or the one given instead of it."""
    if getattr(section, name) is None:
        fellows = (fellow for group in section.exclusive if name in group for fellow in group)
        return next((fellow for fellow in fellows if getattr(section, fellow) is not None), name)
    return name
