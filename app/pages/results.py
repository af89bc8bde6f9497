"""An answer as people read it: the numbers that decide with a verdict, and every number with symbol and unit."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import groupby
from typing import Any, NamedTuple

from markupsafe import Markup

from app.pages.typesetting import cited, shown, symbol, words
from app.schema.fields import Branch, Leaf, headlines, leaf_at, tree
from app.schema.model import Documented, Response

NOT_RESULTS = frozenset(
    {"status", "warnings", "residuals", "assumptions", "model_version", "sources", "model", "derived", "inputs", "case"}
)
DIGITS = 3  # of a headline
NEAR = 0.8  # of an upper limit
WELL_ABOVE = 2.0  # times a lower limit


class Entry(NamedTuple):
    """A value of an answer at its full path, under the title of its group."""

    group: str
    leaf: Leaf
    path: str
    value: Any


@dataclass(frozen=True, slots=True)
class Row:
    """A line of a table: the value, or the items of a list; `before` is that of the variant, `change` lies between."""

    label: str
    symbol: Markup
    items: tuple[str, ...]
    unit: str
    path: str
    description: str
    before: tuple[str, ...] = ()
    change: str = ""

    @property
    def value(self) -> str:
        """All of it as a text."""
        return ", ".join(self.items)


@dataclass(frozen=True, slots=True)
class Card:
    """A number that decides; `level` is good, near, bad or plain, and `verdict` says so in words."""

    title: str
    symbol: Markup
    value: str
    unit: str
    level: str
    verdict: str
    needs: str | None
    before: str
    change: str


def entries(response: Documented) -> Iterator[Entry]:
    """Every result; those of a list one after the other."""
    for member in tree(type(response)).members:
        if member.path not in NOT_RESULTS:
            yield from _entries(member, getattr(response, member.path), member.path, "")


def _entries(member: Leaf | Branch, value: Any, path: str, around: str) -> Iterator[Entry]:
    if isinstance(member, Leaf):
        yield Entry(around, member, path, value)
    elif isinstance(value, list):
        for index, item in enumerate(value):
            titled = replace(member, title=f"{member.title} {index + 1}")
            yield from _entries(titled, item, f"{path}.{index}", around)
    elif value is not None:
        group = f"{around} · {member.title}" if around else member.title
        for inner in member.members:
            name = inner.path.rpartition(".")[2]
            if name in value.model_fields_set:
                yield from _entries(inner, getattr(value, name), f"{path}.{name}", group)


def values_by_path(response: Documented | None) -> dict[str, Any]:
    """Every result by its path; empty without a response."""
    return {entry.path: entry.value for entry in entries(response)} if response is not None else {}


def groups(response: Documented, before: Documented | None = None) -> dict[str, list[Row]]:
    """Every scalar and short list of the answer by the title of its group, beside those of a variant."""
    old = values_by_path(before)
    tables: dict[str, list[Row]] = {}
    for group, leaf, path, value in entries(response):
        if leaf.is_scalar or (leaf.declared.index and not leaf.axes and leaf.dimensions == 1):
            tables.setdefault(group or "result", []).append(_row(leaf, path, value, old.get(path)))
    return tables


def differences(request: type[Documented], response: Response, before: Response) -> list[Row]:
    """The inputs that differ from those of a variant, with what the empty ones stand for."""
    here, there = flattened(response.inputs), flattened(before.inputs)
    now, old = resolved(response), resolved(before)
    return [
        replace(_row(leaf, path, now.get(path), old.get(path)), label=leaf.title)
        for path in here | there
        if here.get(path) != there.get(path) and (leaf := leaf_at(request, path))
    ]


def assumptions(request: type[Documented], response: Response) -> list[Row]:
    """The defaults that the answer used and that are ours; the description of each says why."""
    rows = []
    for path, value, reason in ((each.field, each.value, cited(each.reason)) for each in response.assumptions):
        leaf = leaf_at(request, path)
        title, sign, unit = (leaf.title, leaf.declared.symbol, leaf.unit or "") if leaf else (path, None, "")
        known_unit = unit if isinstance(value, int | float | list) else ""
        rows.append(Row(title, symbol(sign), _items(value), known_unit, path, reason))
    return rows


def _row(leaf: Leaf, path: str, now: Any, before: Any) -> Row:
    unit = leaf.unit or ""
    if leaf.view.percent:
        now, before, unit = (None if now is None else 100.0 * now, None if before is None else 100.0 * before, "%")
    return Row(
        leaf.declared.title,
        symbol(leaf.declared.symbol),
        _items(now),
        unit if now is not None or before is not None else "",
        path,
        cited(leaf.description),
        _items(before),
        _change(now, before),
    )


def _items(value: Any) -> tuple[str, ...]:
    """A value, or the items of a list; of a matrix its rows."""
    if not isinstance(value, list):
        return (shown(value),)
    return tuple(f"({', '.join(_items(item))})" if isinstance(item, list) else shown(item, 4) for item in value)


def _change(now: Any, before: Any) -> str:
    """What became of a value; of a number by how much it changed."""
    if isinstance(now, bool) or not isinstance(now, int | float) or not isinstance(before, int | float):
        return "no change" if now == before else "changed"
    if before == 0.0:
        return "no change" if now == 0.0 else "from zero"
    change = 100.0 * (now / before - 1.0)
    return "no change" if abs(change) < 5e-4 else f"{change:+.3g} %".replace("-", "−")


def flattened(content: Any, path: str = "") -> dict[str, Any]:
    """Plain values, lists and matrices of numbers by dotted path."""
    inner: Iterable[tuple[Any, Any]]
    if isinstance(content, dict):
        inner = content.items()
    elif isinstance(content, list) and any(isinstance(item, dict) for item in content):
        inner = enumerate(content)
    else:
        return {path: content}
    found: dict[str, Any] = {}
    for name, each in inner:
        found |= flattened(each, f"{path}.{name}" if path else str(name))
    return found


def resolved(response: Response) -> dict[str, Any]:
    """What every input stands for: the inputs with their defaults, and what was derived for the empty ones."""
    derived = flattened(response.derived.model_dump()) if response.derived else {}
    return {
        path: derived.get(path, derived.get(path.rpartition(".")[2])) if value is None else value
        for path, value in flattened(response.inputs).items()
    }


def cards(response: Documented, inputs: dict[str, Any], before: Documented | None = None) -> tuple[Card, ...]:
    """The headline numbers; of several numbers of the same rank only the largest is shown.

    Where a warning makes the answer doubtful, no verdict is good.
    """
    known, old = values_by_path(response), values_by_path(before)
    doubtful = any(warning.rank != "note" for warning in response.warnings)
    found = []
    for _, alike in groupby(headlines(type(response)), key=lambda leaf: leaf.view.headline):
        leaf = max(alike, key=lambda leaf: _size(known.get(leaf.path)))
        value, previous = known.get(leaf.path), old.get(leaf.path)
        level, verdict = _verdict(response, leaf, inputs | known)
        if level == "good" and doubtful:
            level, verdict = "near", f"{verdict}; see the warnings"
        card = Card(
            title=leaf.title,
            symbol=symbol(leaf.declared.symbol),
            value=shown(value, DIGITS),
            unit=(leaf.unit or "") if value is not None else "",
            level=level,
            verdict=verdict,
            needs=leaf.view.needs if value is None else None,
            before=shown(previous, DIGITS),
            change=_change(value, previous),
        )
        found.append(card)
    return tuple(found)


def _size(value: Any) -> float:
    return float(value) if isinstance(value, int | float) else float("-inf")


def _verdict(response: Documented, leaf: Leaf, known: dict[str, Any]) -> tuple[str, str]:
    """Level and words of the verdict: how the value compares with its limit, as the answer says it where it does."""
    view, value = leaf.view, known.get(leaf.path)
    if value is None:
        reason = leaf.description.partition("null ")[2]  # as the schema says it
        why = f"no value {reason}" if reason else "no value; the warnings say why"
        return "plain", "" if view.needs else why
    path = view.verdict or ""
    judge = leaf_at(type(response), leaf.path.rpartition(".")[0] + path if path.startswith(".") else path)
    said = known.get(judge.path) if judge else None
    if judge and isinstance(said, bool):
        return "bad" if said else "good", f"{judge.title}: {'yes' if said else 'no'}"
    limit = known.get(view.limit) if isinstance(view.limit, str) else view.limit
    if view.bound is None or limit is None or isinstance(value, bool):
        return "plain", ""
    level, standing = _at_least(value, limit) if view.greatest_is_best else _at_most(abs(value), limit)
    name = f"{shown(limit, 4)} {leaf.unit or ''}".strip()
    return level, f"{judge.title}: {words(said)}" if judge and said is not None else standing.format(name)


def _at_least(value: float, limit: float) -> tuple[str, str]:
    if value < limit:
        return "bad", "below the limit {}"
    if value < WELL_ABOVE * limit:
        return "near", "above the limit {}, with little margin"
    return "good", "well above the limit {}"


def _at_most(value: float, limit: float) -> tuple[str, str]:
    if value > limit:
        return "bad", "beyond the limit {}"
    if value > NEAR * limit:
        return "near", "close to the limit {}"
    return "good", "within the limit {}"
