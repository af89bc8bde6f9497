"""The numbers that decide, with a verdict in words."""

from dataclasses import dataclass
from typing import Any, NamedTuple

from markupsafe import Markup

from app.pages.results import change, entries
from app.pages.typesetting import shown, symbol, words
from app.schema.fields import Leaf, headlines, leaf_at
from app.schema.model import Documented

DIGITS = 3
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
        rank = leaf.headline or 0
        if rank not in best or _size(known.get(leaf.path)) > _size(known.get(best[rank].path)):
            best[rank] = leaf
    return tuple(_card(leaf, _verdict(response, leaf, inputs | known), known, old) for leaf in best.values())


def _size(value: Any) -> float:
    return float(value) if isinstance(value, int | float) else float("-inf")


def _card(leaf: Leaf, verdict: Verdict, known: dict[str, Any], old: dict[str, Any]) -> Card:
    value, previous = known.get(leaf.path), old.get(leaf.path)
    return Card(
        title=leaf.title,
        symbol=symbol(leaf.symbol),
        value=shown(value, DIGITS),
        unit=(leaf.unit or "") if value is not None else "",
        level=verdict.level,
        verdict=verdict.words,
        needs=leaf.needs if value is None else None,
        before=shown(previous, DIGITS) if old else "",
        change=change(value, previous) if old else "",
    )


def _verdict(response: Documented, leaf: Leaf, known: dict[str, Any]) -> Verdict:
    """How the value stands to its limit, in the answer's own words where it has some."""
    value = known.get(leaf.path)
    limit = known.get(leaf.limit) if isinstance(leaf.limit, str) else leaf.limit
    if value is None:
        return Verdict("plain", "" if leaf.needs else _why_not(leaf.description))
    if leaf.bound is None or limit is None or isinstance(value, bool):
        return PLAIN
    name = f"{shown(limit, 4)} {leaf.unit or ''}".strip()
    verdict = _at_least(value, limit, name) if leaf.bound == "lower" else _at_most(abs(value), limit, name)
    judge = leaf_at(type(response), leaf.verdict) if leaf.verdict else None
    if judge is None or known.get(judge.path) is None:
        return verdict
    return Verdict(verdict.level, f"{judge.title}: {words(known[judge.path])}")


def _why_not(description: str) -> str:
    """Why there is no value, as the schema says it."""
    reason = description.partition("null ")[2]
    return f"no value {reason}" if reason else "no value; the warnings say why"


def _at_least(value: float, limit: float, name: str) -> Verdict:
    if value < limit:
        return Verdict("bad", f"below {name}")
    if value < WELL_ABOVE * limit:
        return Verdict("near", f"above {name}, by less than a factor of {WELL_ABOVE:g}")
    return Verdict("good", f"more than {WELL_ABOVE:g} times {name}")


def _at_most(value: float, limit: float, name: str) -> Verdict:
    if value > limit:
        return Verdict("bad", f"beyond the limit {name}")
    if value > NEAR * limit:
        return Verdict("near", f"close to the limit {name}")
    return Verdict("good", f"within the limit {name}")
