"""Links that carry the gears or the coupling of a page to the pages of other calculations.

A link fills in all fields that the other calculation has. The query field `pair` of the link keeps the values of the
remaining fields, so that a later link can fill them in again. If the link would be too long, `pair` is left out. If
the values were read from a REXS file, the link also names this file.
"""

from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple
from urllib.parse import urlencode

from app.calculations import BY_PATH, CALCULATIONS, Calculation, card_of
from app.pages.cases import Asked
from app.pages.query import LONGEST_QUERY, Pairs, link, pairs_of_query
from app.pages.templating import page_path
from app.schema.fields import Branch, Leaf, branches, is_below, leaf_at, matrix_at, pattern_of, tree
from app.schema.model import Documented

LOAD, OPERATION = "load.", "operation."
"""Two prefixes of field names that denote the same section.

The section is `load` in requests of scuffing and in the query field `pair`. The section is `operation` in all other
requests.
"""


class Use(NamedTuple):
    """A link that opens the same gears or the same coupling on the page of another calculation.

    `missing` holds the titles of the fields that the other calculation requires and that the link does not fill in.
    """

    title: str
    address: str
    missing: list[str]


def uses(asked: Asked) -> list[Use]:
    """Return links to all other calculations that accept the same gears or the same coupling."""
    subject = card_of(asked.calculation).subject
    others = (other for other in CALCULATIONS if other is not asked.calculation and card_of(other).subject == subject)
    return [_use(asked, other) for other in others] if subject else []


def _use(asked: Asked, other: Calculation) -> Use:
    """Return the link to the calculation `other`, filled in with the fields of the page."""
    own = [(_common(asked.calculation, name), text) for name, text in asked.pairs]
    beyond = pairs_of_query(asked.views.get("pair", ""))
    fields = dict(beyond) | dict(own)
    there = {name: _there(other, name) for name in fields}
    taken: Pairs = [(there[name], text) for name, text in fields.items() if _has(other.request, there[name])]
    left: Pairs = [(name, text) for name, text in fields.items() if not _has(other.request, there[name])]
    views = {"theme": asked.theme, **asked.file}
    address = link(page_path(other), taken, **views, pair=urlencode(left, safe=",:", errors="replace"))
    if len(address) > LONGEST_QUERY:
        address = link(page_path(other), taken, **views)
    return Use(other.title, address, [*_missing(tree(other.request), {name for name, _ in taken})])


def _common(calculation: Calculation, name: str) -> str:
    """Return the name under which a link keeps the field `name` of a calculation."""
    if card_of(calculation).subject != "pair" or not name.startswith(OPERATION):
        return name
    renamed = f"{LOAD}{name.removeprefix(OPERATION)}"
    return renamed if _has(BY_PATH["/v1/scuffing"].request, renamed) else name


def _there(calculation: Calculation, name: str) -> str:
    """Convert a field name that a link keeps into the name of the field in the request of a calculation."""
    if name.startswith(LOAD) and not _has(calculation.request, name):
        return f"{OPERATION}{name.removeprefix(LOAD)}"
    return name


def _has(model: type[Documented], name: str) -> bool:
    """Return whether a request has a field, a matrix element or an optional section of this name."""
    return bool(leaf_at(model, name) or matrix_at(model, name)) or pattern_of(name) in branches(model)


def _missing(branch: Branch, names: set[str]) -> Iterator[str]:
    """Yield the titles of the required fields of a request that are missing from `names`."""
    for group in _choices(branch.model):
        paths = [f"{branch.path}.{name}" for name in group]
        if names.isdisjoint(paths):
            yield " or ".join(leaf.declared.title for leaf in branch.leaves if leaf.path in paths)
    for member in branch.members:
        if isinstance(member, Leaf):
            if member.required and member.path not in names:
                yield member.title
        elif _is_given(member.path, names) and not member.repeated:
            yield from _missing(member, names)
        elif member.repeated:
            field = branch.model.model_fields[member.path.rpartition(".")[2]]
            if field.is_required() and not _is_given(member.path, names):
                yield member.title
        elif not member.optional:
            yield from _missing(member, names)


def _choices(model: type[Documented]) -> Iterable[tuple[str, ...]]:
    """Return groups of fields. A request must contain exactly one field of each group."""
    groups: Any = model.exclusive if getattr(model, "choice_missing", None) else ()
    return [group for group in groups[:1] if all(model.model_fields[name].default is None for name in group)]


def _is_given(path: str, names: set[str]) -> bool:
    """Return whether `names` contains the path of a section, or the path of a field in this section."""
    return any(is_below(name, path) for name in names)
