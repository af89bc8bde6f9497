"""Links that carry the gears or the coupling of a page to the pages of other calculations.

A link fills in all fields that the other calculation has, and what the answer of the page hands on to it, such as the
crowning that was found. The query field `pair` of the link keeps the values of the remaining fields, so that a later
link can fill them in again. If the link would be too long, `pair` is left out. The link also says where the values came
from: a REXS file, or the typical shafts.
"""

from collections.abc import Collection, Iterable, Iterator
from dataclasses import replace
from typing import Any, NamedTuple
from urllib.parse import urlencode

from app.calculations import BY_PATH, CALCULATIONS, Calculation, card_of
from app.pages.cases import Asked
from app.pages.query import LONGEST_QUERY, Pairs, excluded, link, pairs_of_query
from app.pages.templating import page_path
from app.schema.fields import Branch, Leaf, branches, is_below, leaf_at, matrix_at, pair_at, pattern_of, tree, value_at
from app.schema.model import Documented

LOAD, OPERATION = "load.", "operation."
"""Two prefixes of field names that denote the same section.

The section is `load` in requests of scuffing and in the query field `pair`. The section is `operation` in all other
requests.
"""


INPUTS = "inputs."  # of paths in an answer that repeat what was given
DIGITS = 6  # of a result that becomes an input


class Use(NamedTuple):
    """A link that opens the same gears or the same coupling on the page of another calculation.

    `missing` holds the titles of the fields that the other calculation requires and that the link does not fill in;
    `found` holds the titles of the fields whose values are results of the page.
    """

    title: str
    address: str
    missing: list[str]
    found: list[str]


class Offer(NamedTuple):
    """A link that takes a result of another calculation as an input of the case: the title of the input, and where."""

    title: str
    source: str
    address: str


def uses(asked: Asked, answer: Any = None) -> list[Use]:
    """Return links to all other calculations that accept the same gears or the same coupling."""
    subject = card_of(asked.calculation).subject
    others = (other for other in CALCULATIONS if other is not asked.calculation and card_of(other).subject == subject)
    return [use_in(asked, other, answer) for other in others] if subject else []


def use_in(asked: Asked, other: Calculation, answer: Any = None) -> Use:
    """Return the link to the calculation `other`, with the fields of the page and with what its `answer` hands on."""
    there = carried_to(asked, other, answer)
    sources = asked.calculation.words.hands_on.get(other.path, {})
    titles = [
        leaf.declared.title
        for path in _handed_on(asked.calculation, other, answer)
        if not sources[path].startswith(INPUTS) and (leaf := _leaf(other, path))
    ]
    address = address_of(there)
    if len(address) > LONGEST_QUERY:
        address = link(there.path, there.pairs, theme=there.theme, **there.carried | {"pair": None})
    return Use(other.title, address, missing(there), titles)


def address_of(asked: Asked) -> str:
    """Return the address of a case with all that goes along with it, however long."""
    return link(asked.path, asked.pairs, theme=asked.theme, **asked.carried)


def carried_to(asked: Asked, other: Calculation, answer: Any = None) -> Asked:
    """Return the case of the calculation `other` that has the fields of the page, and what its `answer` hands on."""
    found = _handed_on(asked.calculation, other, answer)
    replaced = {name for path in found if (leaf := _leaf(other, path)) for name in excluded(path, leaf)}
    own = [(_common(asked.calculation, name), text) for name, text in asked.pairs]
    fields = dict(pairs_of_query(asked.views.get("pair", ""))) | dict(own)
    there = {name: _there(other, name) for name in fields}
    stated = {there[name]: text for name, text in fields.items() if _has(other.request, there[name])}
    taken = {name: text for name, text in stated.items() if name not in replaced} | found
    left: Pairs = [(name, text) for name, text in fields.items() if not _has(other.request, there[name])]
    views = {name: text for name, text in asked.carried.items() if text}
    views |= {"pair": urlencode(left, safe=",:", errors="replace"), "theme": asked.theme or ""}
    return Asked(
        page_path(other), [*taken.items()], {name: text for name, text in views.items() if text}, root=asked.root
    )


def missing(asked: Asked, apart: Collection[str] = ()) -> list[str]:
    """Return the titles of the fields that the case lacks, apart from some fields and sections of the request."""
    whole = tree(asked.calculation.request)
    members = tuple(member for member in whole.members if member.path not in apart)
    return [*_missing(replace(whole, members=members), {name for name, _ in asked.pairs})]


def _leaf(calculation: Calculation, path: str) -> Leaf | None:
    return leaf_at(calculation.request, path)


def _handed_on(calculation: Calculation, other: Calculation, answer: Any) -> dict[str, str]:
    """Return the fields of the other calculation that are in the answer, with their texts.

    If a result is missing, nothing is handed on: the values of a case without it belong to no result.
    """
    paths = calculation.words.hands_on.get(other.path, {}) if answer is not None else {}
    values = {there: value_at(answer, path) for there, path in paths.items()}
    return {} if None in values.values() else {there: f"{value:.{DIGITS}g}" for there, value in values.items()}


def offers(asked: Asked) -> list[Offer]:
    """Return links that solve another calculation for the same case and come back with its result as an input.

    A field that is already given gets no link; nor does a case that is too long to come back with all its values.
    """
    given = {name for name, _ in asked.pairs}
    found = []
    for other in CALCULATIONS:
        paths = [path for path in other.words.hands_on.get(asked.calculation.path, ()) if path not in given]
        there = carried_to(asked, other)
        address = address_of(there)
        if paths and asked.pairs and len(address) <= LONGEST_QUERY and not missing(there):
            titles = (leaf.declared.title for path in paths if (leaf := _leaf(asked.calculation, path)))
            place, _, query = address.partition("?")
            found.append(Offer(" and ".join(titles), other.title, f"{place}/into{asked.path}?{query}"))
    return found


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
    return bool(leaf_at(model, name) or matrix_at(model, name) or pair_at(model, name)) or pattern_of(name) in branches(
        model
    )


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
