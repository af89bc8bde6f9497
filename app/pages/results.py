"""An answer as people read it: headline numbers with verdicts, and all numbers with symbol and unit."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import groupby
from typing import Any, NamedTuple

from app.calculations import CALCULATIONS
from app.figures.wording import DIFFERENCES, signed
from app.models.card import NEAR_LIMIT, Verdict, Words
from app.pages.form import link_to, place_of_field
from app.pages.typesetting import shown, words
from app.schema.answers import GROUNDS, Response
from app.schema.fields import ITEM, Branch, Leaf, headlines, leaf_at, tree, value_at
from app.schema.model import Documented, Request
from app.schema.quantities import View

NUMERICS = frozenset(
    {
        *("balance", "balance_error", "convergence", "iterations", "mesh_error", "resolution"),
        *("change_um", "displacement_uncertainty_um", "harmonics_uncertainty_n", "sweeps", "unsolved_points"),
    }
)
"""Sections and fields that say how well a case was solved."""
NOT_RESULTS = GROUNDS | {"status", "warnings", "residuals"}
DIGITS = 3  # significant digits of a headline number
ITEMS = {"shafts": ("pinion shaft", "wheel shaft"), "helices": ("helix 1", "helix 2")}
"""Titles of the items of lists."""
BOTH = " and ".join(ITEMS["helices"])
_one_helix = re.compile("|".join(ITEMS["helices"]))
_of_helix = re.compile(r"(?<![^.])helices\.\d+\.")
LEVELS = ("plain", "good", "near", "bad")
WELL_ABOVE = 2.0  # a value of at least this multiple of a lower limit is well above the limit
UNCHANGED = 5e-6  # relative change; a smaller change counts as no change


class Entry(NamedTuple):
    """A value of an answer, with its full path and the title of its group."""

    group: str
    leaf: Leaf
    path: str
    value: Any


@dataclass(frozen=True, slots=True)
class ResultRow:
    """A row of a table: a single value, or the items of a list.

    `before` holds the items of the variant, and `change` is the change from the variant to the case. `remark` is the
    reason for an assumption, the uncertainty of a result, or the verdict on a headline number. `level` is the level of
    this verdict: good, near, bad or plain.
    """

    leaf: Leaf
    label: str
    path: str
    items: tuple[str, ...]
    unit: str
    before: tuple[str, ...]
    change: str
    remark: str = ""
    level: str = ""

    @property
    def value(self) -> str:
        """All items of the row as one text."""
        return ", ".join(self.items)


def entries(response: Documented) -> Iterator[Entry]:
    """Yield all results of an answer."""
    for member in tree(type(response)).members:
        if member.path not in NOT_RESULTS:
            yield from _entries(member, getattr(response, member.path), member.path, "")


def _entries(member: Leaf | Branch, value: Any, path: str, around: str) -> Iterator[Entry]:
    if isinstance(member, Leaf):
        yield Entry(around, member, path, value)
    elif isinstance(value, list):
        for index, item in enumerate(value):
            titled = replace(member, title=_title_of_item(member, index))
            yield from _entries(titled, item, f"{path}.{index}", around)
    elif value is not None:
        group = f"{around} · {member.title}" if around else member.title
        for inner in member.members:
            name = inner.path.rpartition(".")[2]
            if name in value.model_fields_set:
                yield from _entries(inner, getattr(value, name), f"{path}.{name}", group)


def _title_of_item(member: Branch, index: int) -> str:
    """Return the title of an item of a list, such as "wheel shaft"; most have numbers."""
    titles = ITEMS.get(member.path.rpartition(".")[2], ())
    return titles[index] if index < len(titles) else f"{member.title} {index + 1}"


def values_by_path(response: Documented | None) -> dict[str, Any]:
    """Return all results by their paths. Return an empty dictionary if there is no response."""
    return {entry.path: entry.value for entry in entries(response)} if response is not None else {}


def groups(response: Documented, before: Documented | None = None) -> dict[str, list[ResultRow]]:
    """Return a table of scalars and short lists for each group of an answer. The keys are the titles of the groups.

    The values of both helices of a double-helical pair stand in one row.
    """
    old, remarks = values_by_path(before), words_of(response).remarks(response)
    tables: dict[str, list[ResultRow]] = {}
    beside: dict[str, int] = {}  # places in the tables of rows for both helices
    for group, leaf, path, value in entries(response):
        if ITEM in leaf.path and leaf.detail != "summary":  # a long list, which a figure shows
            continue
        if leaf.is_scalar or (leaf.declared.index and not leaf.axes and leaf.dimensions == 1):
            row = row_of(leaf, path, value, old.get(path))
            row = replace(row, label=leaf.declared.title, remark=remarks.get(path, ""))
            shared, found = _of_helix.subn("", path)
            rows = tables.setdefault(_one_helix.sub(BOTH, group) if found else group or "result", [])
            if found and shared in beside:
                rows[beside[shared]] = _side_by_side(rows[beside[shared]], row)
            else:
                if found:
                    beside[shared] = len(rows)
                rows.append(row)
    return tables


class Part(NamedTuple):
    """A part of all results: its title, its tables by the titles of their groups, and whether it is open at first."""

    title: str
    groups: dict[str, list[ResultRow]]
    is_open: bool = False


def parts(response: Documented, tables: dict[str, list[ResultRow]]) -> list[Part]:
    """Divide the tables of `groups` into the main results, all others, and those about the numerical solution.

    Main are the tiles, whatever has a limit, the losses, and what goes back into a file.
    """
    said = words_of(response)
    main = {*said.tiles, *said.losses, *(each.path for each in said.to_file)}

    def part_of(row: ResultRow) -> int:
        if not NUMERICS.isdisjoint(row.path.split(".")):
            return 2
        view = row.leaf.view
        return 0 if view.headline or view.limit is not None or row.leaf.path in main else 1

    divided = tuple(
        {title: [row for row in rows if part_of(row) == number] for title, rows in tables.items()}
        for number in range(3)
    )
    titles = ("Main results", "All other results", "Numerics: how well this case is solved")
    return [
        Part(title, filled, is_open=number == 0)
        for number, (title, own) in enumerate(zip(titles, divided, strict=True))
        if (filled := {name: rows for name, rows in own.items() if rows})
    ]


def differing(tables: dict[str, list[ResultRow]]) -> tuple[dict[str, list[ResultRow]], int]:
    """Return the rows of tables that differ from the variant, and how many rows are alike."""
    changed = {title: [row for row in rows if row.change != "no change"] for title, rows in tables.items()}
    alike = sum(map(len, tables.values())) - sum(map(len, changed.values()))
    return {title: rows for title, rows in changed.items() if rows}, alike


def _side_by_side(first: ResultRow, second: ResultRow) -> ResultRow:
    """Return one row with the values of two helices."""
    change = first.change if first.change == second.change else f"{first.change}, {second.change}"
    return replace(
        first,
        items=(first.value, second.value),
        unit=first.unit or second.unit,
        before=(", ".join(first.before), ", ".join(second.before)),
        change=change,
    )


def differences(request: type[Documented], response: Response, before: Response) -> list[ResultRow]:
    """Return the inputs that differ between a case and its variant."""
    here, there = flattened(response.inputs), flattened(before.inputs)
    now, old = resolved(response), resolved(before)
    return [
        row_of(leaf, path, now.get(path), old.get(path))
        for path in here | there
        if here.get(path) != there.get(path) and (leaf := leaf_at(request, path))
    ]


def assumptions(request: type[Documented], response: Response) -> list[ResultRow]:
    """Return the inputs for which the answer uses a default of this project, with the reason for each default."""
    return [
        replace(row_of(leaf, assumption.field, assumption.value), remark=assumption.reason)
        for assumption in response.assumptions
        if (leaf := leaf_at(request, assumption.field))
    ]


def row_of(leaf: Leaf, path: str, now: Any = None, before: Any = None, *, digits: int = 5) -> ResultRow:
    """Return the row of a table for a value, and for the value of the variant `before`."""
    unit = leaf.unit or ""
    if leaf.view.percent:
        now, before, unit = (None if now is None else 100.0 * now, None if before is None else 100.0 * before, "%")
    unit_of_value = unit if now is not None or before is not None else ""
    items, old = (_named(leaf, texts_of(value, digits)) for value in (now, before))
    return ResultRow(leaf, leaf.title, path, items, unit_of_value, old, _change(now, before, unit))


def _named(leaf: Leaf, items: tuple[str, ...]) -> tuple[str, ...]:
    """Put names before the items of a field, such as "x" before the first component of a vector."""
    names = (leaf.declared.index or "").split(", ")
    return tuple(map(" ".join, zip(names, items, strict=True))) if len(names) == len(items) > 1 else items


def texts_of(value: Any, digits: int, of_items: int = 4) -> tuple[str, ...]:
    """Return the text of a value, the texts of the items of a list, or the texts of the rows of a matrix."""
    if not isinstance(value, list):
        return (shown(value, digits),)
    if value and isinstance(value[0], list):
        return tuple(f"({', '.join(texts_of(row, of_items, of_items))})" for row in value)
    return tuple(shown(item, of_items) for item in value)


def _change(now: Any, before: Any, unit: str) -> str:
    """Return the change from `before` to `now` as text.

    The change is usually in per cent. For temperatures and similar quantities, the change is a difference, because
    their ratios have no meaning.
    """
    if isinstance(now, bool) or not isinstance(now, int | float) or not isinstance(before, int | float):
        return "no change" if now == before else "changed"
    if abs(now - before) <= UNCHANGED * abs(before):
        return "no change"
    if unit in DIFFERENCES:
        return signed(now - before, DIFFERENCES[unit])
    return "from zero" if before == 0.0 else signed(100.0 * (now / before - 1.0), "%")


def flattened(content: Any, path: str = "") -> dict[str, Any]:
    """Return all single values, lists and matrices in nested content. The keys are the dotted paths."""
    inner: Iterable[tuple[Any, Any]]
    if isinstance(content, dict):
        inner = content.items()
    elif isinstance(content, list) and any(isinstance(item, dict) for item in content):
        inner = enumerate(content)
    else:
        return {path: content}
    values: dict[str, Any] = {}
    for name, part in inner:
        values |= flattened(part, f"{path}.{name}" if path else str(name))
    return values


def resolved(response: Response) -> dict[str, Any]:
    """Return the values used for all inputs: given values, defaults, and derived values for empty inputs."""
    derived = flattened(response.derived.model_dump()) if response.derived else {}
    return {
        path: derived.get(path, derived.get(path.rpartition(".")[2])) if value is None else value
        for path, value in flattened(response.inputs).items()
    }


def cards(response: Documented, inputs: dict[str, Any], before: Documented | None = None) -> list[ResultRow]:
    """Return the tiles: one headline number for each rank, sorted by rank, and the further tiles of the model.

    If several numbers have the same rank, only the number with the worst verdict from `verdicts` is returned. If this
    verdict occurs several times, or if `verdicts` judges none of these numbers, the largest number is returned. A tile
    that a warning touches says so, and is not good. Without a solution there are no tiles.
    """
    if response.status == "no_solution":
        return []
    said = words_of(response)
    values, old = ({**values_by_path(each), **_of(each, said.tiles)} for each in (response, before))
    judged, belongs, remarks = verdicts(response), said.belongs(response), said.remarks(response)
    chosen = [
        max(alike, key=lambda leaf: (_badness(judged.get(leaf.path)), _size(values.get(leaf.path))))
        for _, alike in groupby(headlines(type(response)), key=lambda leaf: leaf.view.headline)
    ]
    chosen += [leaf for path in said.tiles if (leaf := leaf_at(type(response), path)) and path in values]
    rows = []
    for leaf in chosen:
        level, verdict = judged.get(leaf.path) or _verdict(response, leaf, inputs | values)
        value = values.get(leaf.path)
        row = row_of(leaf, leaf.path, value, old.get(leaf.path), digits=DIGITS)
        of = belongs.get(leaf.path, "")
        remark = f"{verdict} ({of})" if verdict and of else verdict or of
        see = "see the warnings" if value is not None and _is_touched(response, leaf.path) else ""
        remark = "; ".join(part for part in (remark, remarks.get(leaf.path, ""), see) if part)
        level = "near" if see and level == "good" else level
        rows.append(replace(row, unit="" if value is None else row.unit, level=level, remark=remark))
    return rows


def _of(response: Documented | None, paths: Iterable[str]) -> dict[str, Any]:
    """Return the values at these paths of an answer, without the paths in sections that the answer does not have."""
    sections = ((path, path.rpartition(".")[0]) for path in paths)
    return {path: value_at(response, path) for path, section in sections if value_at(response, section) is not None}


def _is_touched(response: Documented, path: str) -> bool:
    """Return whether a warning that is more than a note concerns the number at `path`."""
    touches = words_of(response).touches
    codes = (warning.code for warning in response.warnings if warning.rank != "note")
    return any(path in touches.get(code, (path,)) for code in codes)


class Warned(NamedTuple):
    """Warnings of one rank and code: what they say, each with the inputs that they are about (link and place)."""

    rank: str
    code: str
    said: dict[str, list[tuple[str, str]]]


def warned(request: type[Request], response: Response) -> list[Warned]:
    """Return the warnings, equal ones once. An item of a list has its number, so that a bearing can be told."""
    found: dict[tuple[str, str], Warned] = {}
    for each in response.warnings:
        same = found.setdefault((each.rank, each.code), Warned(each.rank, each.code, {}))
        places = same.said.setdefault(each.message, [])
        if each.field:
            places.append((link_to(request, each.field), place_of_field(request, each.field)))
    return [*found.values()]


def verdicts(response: Documented) -> dict[str, Verdict]:
    """Return the verdicts that need more than a single limit. The keys are the paths of the headline numbers."""
    return {} if response.status == "no_solution" else words_of(response).verdicts(response)


def verdict(response: Response) -> Verdict:
    """Return the first sentence about an answer, with its level.

    A warning that makes the answer invalid stands first, unless the model's verdict names it. The names of warnings
    that make it doubtful stand last.
    """
    if response.status == "no_solution":
        return Verdict("bad", f"No solution: {response.warnings[0].message}.")
    said = words_of(response)
    level, text = said.verdict(response)
    invalid = [each for each in response.warnings if each.rank == "invalid" and each.code not in said.names]
    if invalid:
        first = invalid[0].message.partition(". ")[0].removesuffix(".")
        level, text = "bad", f"Not valid: {first}. {text}"
    doubtful = [*dict.fromkeys(words(each.code) for each in response.warnings if each.rank == "doubtful")]
    if doubtful and level != "bad":
        level, text = "near", f"{text} Doubtful: {', '.join(doubtful)}."
    return Verdict(level, text.strip())


def conclusion(response: Documented) -> str:
    """Return what an answer says besides its verdict, one statement a line; empty if it says nothing else."""
    return "" if response.status == "no_solution" else words_of(response).conclusion(response)


class BesideTable(NamedTuple):
    """A table of values of several methods: rows of label, texts and unit, and why the methods differ."""

    title: str
    methods: tuple[str, ...]
    rows: list[tuple[str, list[str], str]]
    why: str


def beside(response: Response) -> list[BesideTable]:
    """Return the tables of values that several methods give, for the methods that the answer has."""
    values = values_by_path(response)
    given = {f"inputs.{path}": value for path, value in resolved(response).items()} if response.inputs else {}
    tables = []
    for title, methods, rows, why, asked, unless, lacking in words_of(response).beside:
        shown_elsewhere = unless and any(path.startswith(f"{unless}.") for path in values)
        if shown_elsewhere or not any(path.startswith(f"{asked}.") for path in values):
            continue
        lines = []
        for label, paths in rows:
            leaves = [leaf_at(type(response), path) for path in paths]
            unit = next((leaf.unit for leaf in leaves if leaf and leaf.unit), "")
            lines.append((label, [shown(values.get(path, given.get(path)), DIGITS + 1) for path in paths], unit))
        notes = (warning.message for warning in response.warnings if warning.code == lacking)
        told = [f"{note[0].upper()}{note[1:]}." for note in notes]
        tables.append(BesideTable(title, methods, lines, " ".join([why, *told])))
    return tables


def words_of(response: Documented) -> Words:
    """Return what the model's card says of answers of this kind; empty for the answers of other endpoints."""
    return next((each.words for each in CALCULATIONS if each.response is type(response)), Words())


def _badness(verdict: Verdict | None) -> int:
    """Return a number that is larger the worse the verdict is. Return 0 if there is no verdict."""
    return LEVELS.index(verdict.level) if verdict else 0


def _size(value: Any) -> float:
    return float(value) if isinstance(value, int | float) else float("-inf")


def _verdict(response: Documented, leaf: Leaf, values: dict[str, Any]) -> tuple[str, str]:
    """Return the level and the words of the verdict on a headline number."""
    view, value = leaf.view, values.get(leaf.path)
    if value is None:
        # The reason as the schema states it; where the whole section is missing, it is another one.
        reason = leaf.declared.description.partition("null ")[2] if leaf.path in values else ""
        why = f"no value {reason}" if reason else "no value; the warnings say why"
        return "plain", "" if view.needs else why
    path = view.verdict or ""
    judge = leaf_at(type(response), leaf.path.rpartition(".")[0] + path if path.startswith(".") else path)
    said = values.get(judge.path) if judge else None
    if judge and isinstance(said, bool):
        return "bad" if said else "good", f"{judge.title}: {'yes' if said else 'no'}"
    limit = values.get(view.limit) if isinstance(view.limit, str) else view.limit
    if view.bound is None or limit is None or isinstance(value, bool):
        return "plain", ""
    ends = (values.get(view.band) if view.band else None) or [value]
    worse = min(ends) if view.greatest_is_best else max(ends)
    level, standing = _standing(worse, limit, greatest_is_best=view.greatest_is_best)
    name = f"{shown(limit, 4)} {leaf.unit or ''}".strip()
    verdict = words(said) if judge and said is not None else standing.format(name)
    if len(ends) > 1:
        return level, f"at worst {shown(worse, DIGITS)}: {verdict}"
    return level, f"{judge.title}: {verdict}" if judge and said is not None else verdict


def verdict_lines(view: View, values: Any) -> tuple[float | None, float | None]:
    """Return the limit of an output, and where the output is well on the safe side of it; None without such a limit.

    `values` holds the fields that may be the limit.
    """
    limit = view.limit if view.bound else None
    limit = value_at(values, limit) if isinstance(limit, str) else limit
    if isinstance(limit, bool) or not isinstance(limit, int | float):
        return None, None
    return float(limit), (WELL_ABOVE if view.greatest_is_best else NEAR_LIMIT) * limit


def _standing(value: float, limit: float, *, greatest_is_best: bool) -> tuple[str, str]:
    """Compare a value with its limit: return the level (good, near or bad) and a text."""
    if greatest_is_best:
        if value < limit:
            return "bad", "below the limit {}"
        if value < WELL_ABOVE * limit:
            return "near", "above the limit {}, with little margin"
        return "good", "well above the limit {}"
    if abs(value) > limit:
        return "bad", "beyond the limit {}"
    if abs(value) > NEAR_LIMIT * limit:
        return "near", "close to the limit {}"
    return "good", "within the limit {}"
