"""An answer as people read it: verdicts, warnings, every number with its name, what it rests on."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from markupsafe import Markup

from app.contract.fields import Leaf, headlines
from app.contract.quantities import Documented
from app.contract.tree import Branch, Field, tree
from app.pages.typesetting import percent_change, shown, symbol

HEADLINE_DIGITS = 3
NOT_RESULTS = frozenset(
    {"status", "warnings", "residuals", "assumptions", "model_version", "model", "derived", "inputs", "case"}
)


@dataclass(frozen=True, slots=True)
class Entry:
    """A value of an answer at its full path."""

    leaf: Leaf
    label: str
    path: str
    value: Any


@dataclass(frozen=True, slots=True)
class Row:
    """A line of the table of results; `before` is the value of the variant, `change` what lies between."""

    label: str
    symbol: Markup
    value: str
    unit: str
    path: str
    description: str
    before: str = ""
    change: str = ""


@dataclass(frozen=True, slots=True)
class Group:
    """Results that belong together."""

    title: str
    rows: tuple[Row, ...]


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
    before: str = ""
    change: str = ""


def entries(response: Documented) -> Iterator[tuple[str, Entry]]:
    """Every result, under the title of its group; those of a list one after the other."""
    root = tree(type(response))
    for member in root.members:
        if member.path.split(".")[0] not in NOT_RESULTS:
            yield from _entries(member, getattr(response, member.path), member.path, "")


def _entries(member: Field | Branch, value: Any, path: str, group: str) -> Iterator[tuple[str, Entry]]:
    if isinstance(member, Field):
        yield group, Entry(member.leaf, member.label, path, value)
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from _inner(member, item, f"{path}.{index}", _joined(group, f"{member.title} {index + 1}"))
    elif value is not None:
        yield from _inner(member, value, path, _joined(group, member.title))


def _inner(branch: Branch, value: Documented, path: str, group: str) -> Iterator[tuple[str, Entry]]:
    for member in branch.members:
        name = member.path.rpartition(".")[2]
        if name in value.model_fields_set:
            yield from _entries(member, getattr(value, name), f"{path}.{name}", group)


def _joined(group: str, title: str) -> str:
    return f"{group} · {title}" if group else title


def groups(response: Documented, before: Documented | None = None) -> tuple[Group, ...]:
    """Every scalar and short list of the answer, beside those of a variant."""
    known = {entry.path: entry.value for _, entry in entries(before)} if before is not None else {}
    tables: dict[str, list[Row]] = {}
    for title, entry in entries(response):
        if entry.leaf.is_scalar or (entry.leaf.index and not entry.leaf.axes and entry.leaf.dimensions == 1):
            tables.setdefault(title or "result", []).append(_row(entry, known))
    return tuple(Group(title, tuple(rows)) for title, rows in tables.items())


def _row(entry: Entry, known: dict[str, Any]) -> Row:
    leaf = entry.leaf
    old = known.get(entry.path)
    return Row(
        entry.label,
        symbol(leaf.symbol),
        _text(entry.value),
        (leaf.unit or "") if entry.value is not None else "",
        entry.path,
        leaf.description,
        _text(old) if known else "",
        _change(entry.value, old) if known else "",
    )


def _text(value: Any) -> str:
    if isinstance(value, list):
        return ", ".join(shown(item, 4) for item in value[:8]) + (", …" if len(value) > 8 else "")
    return shown(value)


def _change(now: Any, before: Any) -> str:
    if isinstance(now, bool) or not isinstance(now, int | float) or not isinstance(before, int | float):
        return "no change" if now == before else "changed"
    return percent_change(now, before)


def cards(response: Documented, inputs: dict[str, Any], before: Documented | None = None) -> tuple[Card, ...]:
    """The headline numbers; of several of one rank the most critical one stands for all."""
    known = {entry.path: entry.value for _, entry in entries(response)}
    old = {entry.path: entry.value for _, entry in entries(before)} if before is not None else {}
    best: dict[int, tuple[float, Card]] = {}
    for leaf in headlines(type(response)):
        value = known.get(leaf.path)
        card = _card(leaf, value, _limit(leaf, known, inputs), old)
        weight = float(value) if isinstance(value, int | float) else float("-inf")
        rank = leaf.headline or 0
        if rank not in best or weight > best[rank][0]:
            best[rank] = weight, card
    return tuple(card for _, card in best.values())


def _limit(leaf: Leaf, known: dict[str, Any], inputs: dict[str, Any]) -> float | None:
    if isinstance(leaf.limit, str):
        found = known.get(leaf.limit, inputs.get(leaf.limit))
        return float(found) if isinstance(found, int | float) else None
    return leaf.limit


def _card(leaf: Leaf, value: Any, limit: float | None, old: dict[str, Any]) -> Card:
    level, verdict, needs = _verdict(leaf, value, limit)
    previous = old.get(leaf.path)
    return Card(
        leaf.title,
        symbol(leaf.symbol),
        shown(value, HEADLINE_DIGITS),
        (leaf.unit or "") if value is not None else "",
        level,
        verdict,
        needs,
        shown(previous, HEADLINE_DIGITS) if old else "",
        _change(value, previous) if old else "",
    )


def _verdict(leaf: Leaf, value: Any, limit: float | None) -> tuple[str, str, str | None]:
    """Level, words, and the request field that is missing."""
    if value is None:
        return "plain", _after_null(leaf.description), leaf.needs
    if limit is None or leaf.bound is None or isinstance(value, bool) or not isinstance(value, int | float):
        return "plain", "", None
    name = f"{shown(limit, 4)} {leaf.unit or ''}".strip()
    if leaf.bound == "lower":
        return _at_least(value, limit, name)
    return _at_most(abs(value), limit, name)


def _after_null(description: str) -> str:
    """Why there is no value, as the schema says it."""
    reason = description.partition("null ")[2]
    return f"no value {reason}" if reason else "no value; the warnings say why"


def _at_least(value: float, limit: float, name: str) -> tuple[str, str, None]:
    if value < limit:
        return "bad", f"below {name}", None
    if value < 1.5 * limit:
        return "near", f"above {name}, with little margin", None
    return "good", f"well above {name}", None


def _at_most(value: float, limit: float, name: str) -> tuple[str, str, None]:
    if value > limit:
        return "bad", f"beyond the limit of {name}", None
    share = f"limit {name}"
    if value > 0.8 * limit:
        return "near", f"close to the {share}", None
    return "good", f"within the {share}", None


def flattened(content: Any, prefix: str = "") -> dict[str, Any]:
    """Plain values and lists of numbers by dotted path."""
    if isinstance(content, dict):
        return {
            path: value
            for name, inner in content.items()
            for path, value in flattened(inner, f"{prefix}.{name}" if prefix else name).items()
        }
    if isinstance(content, list) and any(isinstance(item, dict | list) for item in content):
        return {
            path: value
            for index, inner in enumerate(content)
            for path, value in flattened(inner, f"{prefix}.{index}").items()
        }
    return {prefix: content}
