"""Which request field a solver means when it names one of its own inputs."""

from collections.abc import Iterator
from functools import cache
from typing import Any, get_args, get_origin

from app.schema.fields import ITEM
from app.schema.model import Documented, group_of

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
        if any(get_origin(kind) is list for kind in (info.annotation, *get_args(info.annotation))):
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
