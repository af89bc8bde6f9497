"""The form of a case from the schema: fields with what was typed, what it means and what is wrong with it."""

from collections.abc import Iterator, Mapping
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, field, replace
from itertools import groupby
from typing import Any, Literal

from markupsafe import Markup

from app.pages.query import MATRIX, PICK, PRESENT, SIDE, text_of
from app.pages.typesetting import cited, symbol, words
from app.schema.fields import ITEM, Branch, Leaf, tree
from app.schema.model import Request
from app.schema.model import Section as Fields
from app.schema.quantities import split_unit

BESIDE = 10  # letters of an option that fit beside the label
Widget = Literal["number", "text", "list", "select", "table"]


@dataclass(frozen=True, slots=True)
class State:
    """What is known of a case beside the schema, by path: texts typed, faults, and what an answer resolved.

    `unused` is whether the part of the form at hand is an optional section of which nothing is given.
    """

    texts: Mapping[str, str] = field(default_factory=dict)
    faults: Mapping[str, str] = field(default_factory=dict)
    resolved: Mapping[str, Any] = field(default_factory=dict)
    assumed: AbstractSet[str] = frozenset()
    unused: bool = False

    def given(self, prefix: str) -> int:
        """How many fields below a path were typed."""
        return sum(name == prefix or name.startswith(f"{prefix}.") for name in self.texts)

    def faulty(self, prefix: str) -> bool:
        """Whether something at or below a path is wrong."""
        return any(name == prefix or name.startswith(f"{prefix}.") for name in self.faults)

    def assumptions(self, prefix: str) -> int:
        """How many defaults of ours were used below a path."""
        return sum(name.startswith(f"{prefix}.") for name in self.assumed)


@dataclass(frozen=True, slots=True)
class FieldView:
    """What the template shows of a field; `empty` says in a line what a field without a value stands for."""

    name: str
    label: str
    symbol: Markup
    unit: str
    widget: Widget
    text: str
    placeholder: str
    options: tuple[tuple[str, str], ...]
    required: str
    assumed: bool
    help: tuple[str, ...]
    fault: str | None
    column: str = ""
    excludes: tuple[str, ...] = ()
    empty: str = ""
    kind: str = "field"

    @property
    def id(self) -> str:
        """Anchor on the page."""
        return anchor(self.name)

    @property
    def wide(self) -> bool:
        """Whether an option is too long for a control beside its label."""
        return any(len(label) > BESIDE for _, label in self.options)


def anchor(path: str) -> str:
    """The id of a field or section on the page."""
    return f"f.{path}"


def field_view(leaf: Leaf, name: str, state: State, column: str = "") -> FieldView:
    """A field under its name with indices; `column` names it where several stand side by side."""
    return FieldView(
        name=name,
        label=leaf.declared.title,
        symbol=symbol(leaf.declared.symbol),
        unit=leaf.unit or "",
        widget=_widget(leaf),
        text=state.texts.get(name, ""),
        placeholder=_placeholder(leaf, name, state),
        options=tuple(_options(leaf, state.texts.get(name, ""))),
        empty=_empty(leaf, name, state),
        required=_required(state, needed=leaf.required),
        assumed=name in state.assumed,
        help=tuple(map(cited, _help(leaf, name, state))),
        fault=state.faults.get(name),
        column=column,
        excludes=_excludes(leaf, name),
    )


def _required(state: State, *, needed: bool) -> str:
    """What stands beside a field that must be given: always, or if its section is."""
    return "" if not needed else "required if used" if state.unused else "required"


def _widget(leaf: Leaf) -> Widget:
    if leaf.dimensions:
        return "list"
    if leaf.options or leaf.kind == "boolean":
        return "select"
    return "text" if leaf.kind in {"text", "other"} else "number"


def _excludes(leaf: Leaf, name: str) -> tuple[str, ...]:
    """The fields and sections that must be empty where this field is given."""
    section = name.rpartition(".")[0]
    return tuple(f"{section}.{fellow.rpartition('.')[2]}".lstrip(".") for fellow in leaf.exclusive)


def _placeholder(leaf: Leaf, name: str, state: State) -> str:
    """What an empty field stands for: the value in use after an answer, the default before."""
    value = state.resolved.get(name, leaf.default)
    if isinstance(value, list) and value:
        return " ".join(text_of(item) for item in value[:6]) + (" …" if len(value) > 6 else "")
    if value is not None and value != []:
        return f"{value:.6g}" if isinstance(value, float) else text_of(value)
    return "paste a column" if leaf.dimensions else ""


def _empty(leaf: Leaf, name: str, state: State) -> str:
    """What an empty field stands for, where that is a rule and not a value yet."""
    known = state.resolved.get(name, leaf.default) not in (None, [])
    return "" if known or leaf.options else words(cited(leaf.declared.default_text or "").replace("`", ""))


def _options(leaf: Leaf, text: str) -> list[tuple[str, str]]:
    if not leaf.options and leaf.kind != "boolean":
        return []
    named = [("true", "yes"), ("false", "no")] if leaf.kind == "boolean" else [(o, words(str(o))) for o in leaf.options]
    default = text_of(leaf.default) if leaf.default is not None else None
    shown = [(str(value), label) for value, label in named]
    known = {value for value, _ in shown}
    empty = [] if default in known else [("", cited(leaf.declared.default_text or "choose …"))]
    strange = [(text, text)] if text and text not in known else []
    return [
        *empty,
        *((("" if value == default and text != value else value), label) for value, label in shown),
        *strange,
    ]


def _help(leaf: Leaf, name: str, state: State) -> list[str]:
    """Meaning, range, what is assumed and why, source."""
    lines = [_sentence(leaf.description)]
    if bounds := _range(leaf):
        lines.append(bounds)
    if leaf.declared.assumed:
        lines.append(f"{'Assumed' if name in state.assumed else 'Our default'}: {leaf.declared.assumed}.")
    if leaf.exclusive:
        fellows = ", ".join(_last_words(fellow) for fellow in leaf.exclusive)
        lines.append(f"Instead of: {fellows}.")
    if leaf.declared.source:
        lines.append(f"Source: {leaf.declared.source}.")
    return lines


def _last_words(path: str) -> str:
    """The name of a field without its unit, as words."""
    return words(split_unit(path.rpartition(".")[2])[0])


def _sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}." if text else ""


def _range(leaf: Leaf) -> str:
    names = {"ge": "from", "gt": "above", "le": "to", "lt": "below"}
    parts = [f"{names[key]} {text_of(float(bound))}" for key, bound in leaf.declared.bounds.items()]
    return f"Permissible: {' '.join(parts)} {leaf.unit or ''}".rstrip() + "." if parts else ""


@dataclass(frozen=True, slots=True)
class Matrix:
    """A matrix with a field for each of its elements, by rows."""

    id: str
    label: str
    symbol: Markup
    rows: tuple[tuple[FieldView, ...], ...]
    kind: str = "matrix"


@dataclass(frozen=True, slots=True)
class Choice:
    """Fields of which one is given; `picked` is the one that counts."""

    name: str
    legend: str
    fields: tuple[FieldView, ...]
    picked: str
    required: str
    kind: str = "choice"


@dataclass(frozen=True, slots=True)
class Twins:
    """Sections of one kind side by side: one line per field, one column per section."""

    columns: tuple[str, ...]
    rows: tuple[tuple[FieldView, ...], ...]
    faults: tuple[str, ...]
    anchors: tuple[str, ...]
    kind: str = "twins"


@dataclass(frozen=True, slots=True)
class Section:
    """A part of the form; `switch` is the field that says that an optional section is there."""

    id: str
    path: str
    title: str
    description: str
    open: bool
    given: int
    assumed: int
    fault: str | None
    blocks: tuple["Block", ...]
    switch: FieldView | None = None
    needed: bool = False
    advanced: bool = False
    kind: str = "section"


@dataclass(frozen=True, slots=True)
class Rows:
    """A list of sections; the last one is empty, to be filled."""

    id: str
    path: str
    title: str
    fault: str | None
    items: tuple[Section, ...]
    kind: str = "rows"


Block = FieldView | Matrix | Choice | Twins | Section | Rows


DETAIL = "detail"
"""Not asked for: each view takes the level of detail that it needs."""


def form(request: type[Request], state: State) -> tuple[Section, ...]:
    """The sections of the form: those with required fields first, model options last."""
    root = tree(request)
    sections = [_section(group, state) for group in _grouped(root.branches)]
    loose = tuple(field for field in root.leaves if field.path != DETAIL)
    if loose:
        sections.append(_loose(loose, state))
    return tuple(sorted(sections, key=lambda each: (not each.needed, each.advanced)))


def _grouped(branches: tuple[Branch, ...]) -> Iterator[tuple[Branch, ...]]:
    """Neighbours of one kind together."""
    for _, group in groupby(branches, key=lambda branch: (branch.model, branch.repeated or bool(branch.branches))):
        members = tuple(group)
        if members[0].repeated or members[0].branches:
            yield from ((member,) for member in members)
        else:
            yield members


def _loose(fields: tuple[Leaf, ...], state: State) -> Section:
    blocks = tuple(_own(field, field.path, state) for field in fields)
    names = [field.path for field in fields]
    needed = any(field.required for field in fields)
    return Section(
        anchor("general"),
        "general",
        "general",
        "",
        needed or any(map(state.given, names)) or any(map(state.faulty, names)),
        sum(map(state.given, names)),
        sum(name in state.assumed for name in names),
        None,
        blocks,
    )


def _section(group: tuple[Branch, ...], state: State) -> Section:
    """A section of the form's first level: one of the request, or twins."""
    first = group[0]
    if len(group) == 1:
        return (_listed if first.repeated else _branch)(first, first.path, state)
    blocks = (_twins(group, "", state),)
    return Section(
        id=anchor(f"{first.path}-"),
        path=first.path,
        title=" and ".join(branch.title for branch in group),
        description="",
        open=any(branch.required or state.given(branch.path) or state.faulty(branch.path) for branch in group),
        given=sum(state.given(branch.path) for branch in group),
        assumed=sum(state.assumptions(branch.path) for branch in group),
        fault=None,
        blocks=blocks,
        needed=any(branch.required for branch in group),
    )


def _branch(branch: Branch, path: str, state: State, item: int | None = None) -> Section:
    needed = branch.required and not branch.optional and item is None
    given = state.given(path)
    optional = branch.optional or branch.repeated
    inside = replace(state, unused=(optional or state.unused) and not given)
    return Section(
        id=anchor(path),
        path=path,
        title=branch.title if item is None else f"{branch.title} {item + 1}",
        description=branch.description if branch.description != branch.title and item is None else "",
        open=needed or given > 0 or state.faulty(path),
        given=given,
        assumed=state.assumptions(path),
        fault=state.faults.get(path),
        blocks=tuple(_blocks(branch, f"{path}.", inside)),
        switch=_switch(branch, path, state),
        needed=needed,
        advanced=branch.advanced,
    )


def _listed(branch: Branch, path: str, state: State) -> Section:
    """A list of sections as a section of its own."""
    rows = _rows(branch, path, state)
    return Section(
        id=f"{anchor(path)}-",
        path=path,
        title=branch.title,
        description=branch.description if branch.description != branch.title else "",
        open=state.given(path) > 0 or state.faulty(path),
        given=len(rows.items) - 1,
        assumed=state.assumptions(path),
        fault=None,
        blocks=(rows,),
    )


def _switch(branch: Branch, path: str, state: State) -> FieldView | None:
    """Says that an optional section is there, where none of its fields would."""
    if not branch.optional or branch.required:
        return None
    return FieldView(
        name=path,
        label=f"use {branch.title}",
        symbol=symbol(None),
        unit="",
        widget="select",
        text=state.texts.get(path, PRESENT if state.given(path) else ""),
        placeholder="",
        options=(("", "no"), (PRESENT, "yes")),
        required="",
        assumed=False,
        help=(branch.description,),
        fault=None,
    )


def _blocks(branch: Branch, prefix: str, state: State) -> Iterator[Block]:
    """Fields in the order of the schema, then the sections inside."""
    choices = _choices(branch)
    shown: set[str] = set()
    groups = {group[0].path: group for group in _grouped(branch.branches)}
    for member in branch.members:
        if isinstance(member, Branch):
            if member.path in groups:
                yield _inner(groups[member.path], prefix, state)
        elif (group := choices.get(member.path)) is None:
            yield _own(member, _name(member, prefix), state)
        elif member.path not in shown:
            shown.update(field.path for field in group)
            needed = issubclass(branch.model, Fields) and branch.model.choice_missing is not None
            yield _choice(group, prefix, state, _required(state, needed=needed))


def _own(leaf: Leaf, name: str, state: State) -> FieldView | Matrix:
    """A field that shares its line with no other one."""
    if leaf.dimensions < MATRIX:
        return field_view(leaf, name, state)
    whole, resolved = field_view(leaf, name, state), state.resolved.get(name)
    rows = tuple(
        tuple(
            replace(
                whole,
                name=f"{name}.{row}.{column}",
                label=f"{whole.label}, row {row + 1}, column {column + 1}",
                widget="number",
                text=state.texts.get(f"{name}.{row}.{column}", whole.text if row == column == 0 else ""),
                placeholder=f"{resolved[row][column]:.6g}" if resolved else "",
                help=(*whole.help, "The first element alone: the same in every direction."),
                fault=state.faults.get(f"{name}.{row}.{column}", whole.fault if row == column == 0 else None),
            )
            for column in range(SIDE)
        )
        for row in range(SIDE)
    )
    return Matrix(whole.id, whole.label, whole.symbol, rows)


def _inner(group: tuple[Branch, ...], prefix: str, state: State) -> Block:
    first = group[0]
    if len(group) > 1:
        return _twins(group, prefix, state)
    path = prefix + _last(first.path)
    return _rows(first, path, state) if first.repeated else _branch(first, path, state)


def _choices(branch: Branch) -> dict[str, tuple[Leaf, ...]]:
    """Fields of which one is given, by the path of each of them; a field belongs to the first such group only."""
    fields = {_last(leaf.path): leaf for leaf in branch.leaves}
    found: dict[str, tuple[Leaf, ...]] = {}
    for group in branch.model.exclusive:
        if all(name in fields and fields[name].path not in found for name in group):
            members = tuple(fields[name] for name in group)
            found |= {leaf.path: members for leaf in members}
    return found


def _choice(group: tuple[Leaf, ...], prefix: str, state: State, required: str) -> Choice:
    names = [_name(field, prefix) for field in group]
    given = next((name for name in names if name in state.texts), None)
    known = next((name for name in names if state.resolved.get(name) is not None), None)
    legend = " or ".join(field.declared.title for field in group)
    views = tuple(field_view(field, name, state) for field, name in zip(group, names, strict=True))
    return Choice(PICK + names[0], legend, views, given or known or names[0], required)


def _twins(group: tuple[Branch, ...], prefix: str, state: State) -> Twins:
    paths = [prefix + _last(branch.path) for branch in group]
    columns = tuple(branch.title for branch in group)
    rows = tuple(
        tuple(
            field_view(field, f"{path}.{_last(field.path)}", state, column)
            for field, path, column in zip(line, paths, columns, strict=True)
        )
        for line in zip(*(branch.leaves for branch in group), strict=True)
    )
    faults = tuple(state.faults[path] for path in paths if path in state.faults)
    return Twins(columns, rows, faults, tuple(anchor(path) for path in paths))


def _rows(branch: Branch, path: str, state: State) -> Rows:
    count = 1 + max((int(index) for name in state.texts if (index := _index(name, path)) is not None), default=-1)
    items = tuple(_branch(branch, f"{path}.{index}", state, item=index) for index in range(count + 1))
    return Rows(anchor(path), path, branch.title, state.faults.get(path), items)


def _index(name: str, path: str) -> str | None:
    """Which item of a list a field belongs to."""
    if not name.startswith(f"{path}."):
        return None
    part = name[len(path) + 1 :].partition(".")[0]
    return part if part.isdecimal() and part.isascii() else None


def _name(field: Leaf, prefix: str) -> str:
    return prefix + _last(field.path)


def _last(path: str) -> str:
    return path.removesuffix(f".{ITEM}").rpartition(".")[2]
