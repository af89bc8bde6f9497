"""An answer as people read it: the numbers that decide with a verdict, and every number with symbol and unit."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from markupsafe import Markup

from app.pages.typesetting import cited, percent_change, shown, symbol, words
from app.schema.fields import Branch, Leaf, headlines, leaf_at, tree
from app.schema.model import Assumption, Documented, Response

NOT_RESULTS = frozenset(
    {"status", "warnings", "residuals", "assumptions", "model_version", "sources", "model", "derived", "inputs", "case"}
)


@dataclass(frozen=True, slots=True)
class Entry:
    """A value of an answer at its full path."""

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


class Assumed(NamedTuple):
    """A default that is ours: the field, the value used with its unit, and why."""

    path: str
    title: str
    symbol: Markup
    value: str
    unit: str
    reason: str


@dataclass(frozen=True, slots=True)
class Group:
    """Results that belong together."""

    title: str
    rows: tuple[Row, ...]


def entries(response: Documented) -> Iterator[tuple[str, Entry]]:
    """Every result, under the title of its group; those of a list one after the other."""
    root = tree(type(response))
    for member in root.members:
        if member.path.split(".")[0] not in NOT_RESULTS:
            yield from _entries(member, getattr(response, member.path), member.path, "")


def _entries(member: Leaf | Branch, value: Any, path: str, group: str) -> Iterator[tuple[str, Entry]]:
    if isinstance(member, Leaf):
        yield group, Entry(member, path, value)
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
        if entry.leaf.is_scalar or (entry.leaf.declared.index and not entry.leaf.axes and entry.leaf.dimensions == 1):
            tables.setdefault(title or "result", []).append(_row(entry, known))
    return tuple(Group(title, tuple(rows)) for title, rows in tables.items())


def _row(entry: Entry, known: dict[str, Any]) -> Row:
    row = _compared(entry.leaf, entry.path, entry.value, known.get(entry.path))
    return row if known else replace(row, before=(), change="")


def differences(request: type[Documented], response: Response, before: Response) -> Group:
    """The inputs that differ from those of a variant, with what the empty ones stand for."""
    here, there = flattened(response.inputs), flattened(before.inputs)
    now, old = resolved(response), resolved(before)
    rows = (
        replace(_compared(leaf, path, now.get(path), old.get(path)), label=leaf.title)
        for path in here | there
        if here.get(path) != there.get(path) and (leaf := leaf_at(request, path))
    )
    return Group("", tuple(rows))


def _compared(leaf: Leaf, path: str, now: Any, before: Any) -> Row:
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
        change(now, before),
    )


def _items(value: Any) -> tuple[str, ...]:
    """A value, or the items of a list; of a matrix its rows."""
    if not isinstance(value, list):
        return (shown(value),)
    return tuple(f"({', '.join(_items(item))})" if isinstance(item, list) else shown(item, 4) for item in value)


def change(now: Any, before: Any) -> str:
    """What became of a value."""
    if isinstance(now, bool) or not isinstance(now, int | float) or not isinstance(before, int | float):
        return "no change" if now == before else "changed"
    return percent_change(now, before)


def flattened(content: Any, prefix: str = "") -> dict[str, Any]:
    """Plain values, lists and matrices of numbers by dotted path."""
    if isinstance(content, dict):
        return {
            path: value
            for name, inner in content.items()
            for path, value in flattened(inner, f"{prefix}.{name}" if prefix else name).items()
        }
    if isinstance(content, list) and any(isinstance(item, dict) for item in content):
        return {
            path: value
            for index, inner in enumerate(content)
            for path, value in flattened(inner, f"{prefix}.{index}").items()
        }
    return {prefix: content}


def resolved(response: Response) -> dict[str, Any]:
    """What every input stands for: the inputs with their defaults, and what was derived for the empty ones."""
    derived = flattened(response.derived.model_dump()) if response.derived else {}
    found = flattened(response.inputs)
    for path, value in found.items():
        if value is None:
            found[path] = derived.get(path, derived.get(path.rpartition(".")[2]))
    return found


def assumptions(request: type[Documented], response: Response) -> list[Assumed]:
    """The defaults that the answer used and that are ours."""
    return [_assumed(each, leaf_at(request, each.field)) for each in response.assumptions]


def _assumed(each: Assumption, leaf: Leaf | None) -> Assumed:
    reason = cited(each.reason)
    if leaf is None:
        return Assumed(each.field, each.field, Markup(""), ", ".join(_items(each.value)), "", reason)
    unit = (leaf.unit or "") if isinstance(each.value, int | float | list) else ""
    return Assumed(each.field, leaf.title, symbol(leaf.declared.symbol), ", ".join(_items(each.value)), unit, reason)


DIGITS = 3  # of a headline
NEAR = 0.8  # of an upper limit
WELL_ABOVE = 2.0  # times a lower limit


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


class Verdict(NamedTuple):
    """Level, and what it means in words."""

    level: str
    words: str


PLAIN = Verdict("plain", "")


def cards(response: Documented, inputs: dict[str, Any], before: Documented | None = None) -> tuple[Card, ...]:
    """The headline numbers; of several of one rank the largest stands for all."""
    known = {entry.path: entry.value for _, entry in entries(response)}
    old = {entry.path: entry.value for _, entry in entries(before)} if before is not None else {}
    best: dict[int, Leaf] = {}
    for leaf in headlines(type(response)):
        rank = leaf.view.headline or 0
        if rank not in best or _size(known.get(leaf.path)) > _size(known.get(best[rank].path)):
            best[rank] = leaf
    doubtful = any(warning.rank != "note" for warning in response.warnings)
    return tuple(
        _card(leaf, _doubted(_verdict(response, leaf, inputs | known), doubtful=doubtful), known, old)
        for leaf in best.values()
    )


def _doubted(verdict: Verdict, *, doubtful: bool) -> Verdict:
    """The verdict; a good one is good no more where a warning makes it doubtful."""
    if not doubtful or verdict.level != "good":
        return verdict
    return Verdict("near", f"{verdict.words}; see the warnings")


def _size(value: Any) -> float:
    return float(value) if isinstance(value, int | float) else float("-inf")


def _card(leaf: Leaf, verdict: Verdict, known: dict[str, Any], old: dict[str, Any]) -> Card:
    value, previous = known.get(leaf.path), old.get(leaf.path)
    return Card(
        title=leaf.title,
        symbol=symbol(leaf.declared.symbol),
        value=shown(value, DIGITS),
        unit=(leaf.unit or "") if value is not None else "",
        level=verdict.level,
        verdict=verdict.words,
        needs=leaf.view.needs if value is None else None,
        before=shown(previous, DIGITS) if old else "",
        change=change(value, previous) if old else "",
    )


def _verdict(response: Documented, leaf: Leaf, known: dict[str, Any]) -> Verdict:
    """How the value stands to its limit, in the answer's own words where it has some."""
    value = known.get(leaf.path)
    limit = known.get(leaf.view.limit) if isinstance(leaf.view.limit, str) else leaf.view.limit
    if value is None:
        return Verdict("plain", "" if leaf.view.needs else _why_not(leaf.description))
    judge = _judge(response, leaf)
    said = None if judge is None else known.get(judge.path)
    if judge is not None and isinstance(said, bool):
        return Verdict("bad" if said else "good", f"{judge.title}: {'yes' if said else 'no'}")
    if leaf.view.bound is None or limit is None or isinstance(value, bool):
        return PLAIN
    name = f"{shown(limit, 4)} {leaf.unit or ''}".strip()
    verdict = _at_least(value, limit, name) if leaf.view.greatest_is_best else _at_most(abs(value), limit, name)
    return verdict if judge is None or said is None else Verdict(verdict.level, f"{judge.title}: {words(said)}")


def _judge(response: Documented, leaf: Leaf) -> Leaf | None:
    """The result that judges another one in words."""
    path = leaf.view.verdict or ""
    beside = leaf.path.rpartition(".")[0]
    return leaf_at(type(response), beside + path if path.startswith(".") else path) if path else None


def _why_not(description: str) -> str:
    """Why there is no value, as the schema says it."""
    reason = description.partition("null ")[2]
    return f"no value {reason}" if reason else "no value; the warnings say why"


def _at_least(value: float, limit: float, name: str) -> Verdict:
    if value < limit:
        return Verdict("bad", f"below the limit {name}")
    if value < WELL_ABOVE * limit:
        return Verdict("near", f"above the limit {name}, with little margin")
    return Verdict("good", f"well above the limit {name}")


def _at_most(value: float, limit: float, name: str) -> Verdict:
    if value > limit:
        return Verdict("bad", f"beyond the limit {name}")
    if value > NEAR * limit:
        return Verdict("near", f"close to the limit {name}")
    return Verdict("good", f"within the limit {name}")
