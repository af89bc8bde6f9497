"""The sections of a request or response with their fields inside: what forms, tables and reports are laid out by."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from types import NoneType
from typing import get_args, get_origin

from app.schema.conversion import group_of
from app.schema.fields import ITEM, Leaf, leaves
from app.schema.model import Documented
from app.schema.quantities import Input, Output


@dataclass(frozen=True, slots=True)
class Field:
    """A leaf under the label that suffices within its section."""

    leaf: Leaf
    label: str

    @property
    def path(self) -> str:
        """Where it stands."""
        return self.leaf.path


@dataclass(frozen=True, slots=True)
class Branch:
    """A section: `repeated` is a list of them, `optional` may be null; `path` has `*` for indices of lists."""

    path: str
    title: str
    description: str
    model: type[Documented]
    members: tuple["Field | Branch", ...]
    repeated: bool = False
    optional: bool = False
    advanced: bool = False

    @property
    def fields(self) -> tuple[Field, ...]:
        """Its own fields."""
        return tuple(member for member in self.members if isinstance(member, Field))

    @property
    def branches(self) -> tuple["Branch", ...]:
        """Its own sections."""
        return tuple(member for member in self.members if isinstance(member, Branch))

    @property
    def required(self) -> bool:
        """Whether something in it must be given."""
        return any(field.leaf.required for field in self.fields) or any(
            branch.required for branch in self.branches if not branch.repeated and not branch.optional
        )


@cache
def tree(model: type[Documented]) -> Branch:
    """The whole request or response as one section without a name."""
    return Branch("", "", "", model, tuple(_members(model, "", {leaf.path: leaf for leaf in leaves(model)})))


@cache
def branches(model: type[Documented]) -> dict[str, Branch]:
    """Every section by its path."""
    return {branch.path: branch for branch in _all(tree(model))}


def _all(branch: Branch) -> Iterator[Branch]:
    yield branch
    for inner in branch.branches:
        yield from _all(inner)


def _members(model: type[Documented], prefix: str, known: dict[str, Leaf]) -> Iterator[Field | Branch]:
    for name, info in model.model_fields.items():
        meaning = next((item for item in info.metadata if isinstance(item, Input | Output)), None)
        if meaning is None:
            continue
        path, group = prefix + name, group_of(info.annotation)
        if group is None:
            yield Field(known[path], meaning.title)
            continue
        repeated = any(get_origin(kind) is list for kind in (info.annotation, *get_args(info.annotation)))
        inside = f"{path}.{ITEM}." if repeated else f"{path}."
        yield Branch(
            path,
            meaning.title,
            meaning.description,
            group,
            tuple(_members(group, inside, known)),
            repeated,
            NoneType in get_args(info.annotation),
            isinstance(meaning, Input) and meaning.advanced,
        )
