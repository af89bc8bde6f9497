"""The form of a request, generated from its schema."""

from collections import Counter
from collections.abc import Iterator
from itertools import groupby

from app.pages.blocks import Block, Choice, Rows, Section, Single, Twins
from app.pages.fields import FieldView, State, anchor, field_view
from app.pages.query import PICK, PRESENT
from app.pages.typesetting import symbol
from app.schema.base import Request
from app.schema.fields import ITEM
from app.schema.tree import Branch, Field, tree

DETAIL = "detail"
"""Not asked for: each view takes the level of detail that it needs."""


def form(request: type[Request], state: State) -> tuple[Section, ...]:
    """The sections of the form: those with required fields first, model options last."""
    root = tree(request)
    sections = [_section(group, state) for group in _grouped(root.branches)]
    loose = tuple(field for field in root.fields if field.path != DETAIL)
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


def _loose(fields: tuple[Field, ...], state: State) -> Section:
    blocks = tuple(Single(field_view(field, field.path, state)) for field in fields)
    names = [field.path for field in fields]
    needed = any(field.leaf.required for field in fields)
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
    return Section(
        id=anchor(path),
        path=path,
        title=branch.title if item is None else f"{branch.title} {item + 1}",
        description=branch.description if branch.description != branch.title and item is None else "",
        open=needed or given > 0 or state.faulty(path),
        given=given,
        assumed=state.assumptions(path),
        fault=state.faults.get(path),
        blocks=tuple(_blocks(branch, f"{path}.", state)),
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
        required=False,
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
            yield Single(field_view(member, _name(member, prefix), state))
        elif member.path not in shown:
            shown.update(field.path for field in group)
            yield _choice(group, prefix, state)


def _inner(group: tuple[Branch, ...], prefix: str, state: State) -> Block:
    first = group[0]
    if len(group) > 1:
        return _twins(group, prefix, state)
    path = prefix + _last(first.path)
    return _rows(first, path, state) if first.repeated else _branch(first, path, state)


def _choices(branch: Branch) -> dict[str, tuple[Field, ...]]:
    """Fields that exclude each other and nothing else, by the path of each of them."""
    fields = {_last(field.path): field for field in branch.fields}
    memberships = Counter(name for group in branch.model.exclusive for name in group)
    found: dict[str, tuple[Field, ...]] = {}
    for group in branch.model.exclusive:
        if all(name in fields and memberships[name] == 1 for name in group):
            members = tuple(fields[name] for name in group)
            found |= {field.path: members for field in members}
    return found


def _choice(group: tuple[Field, ...], prefix: str, state: State) -> Choice:
    names = [_name(field, prefix) for field in group]
    given = next((name for name in names if name in state.texts), None)
    known = next((name for name in names if state.resolved.get(name) is not None), None)
    legend = " or ".join(field.label for field in group)
    views = tuple(field_view(field, name, state) for field, name in zip(group, names, strict=True))
    return Choice(PICK + names[0], legend, views, given or known or names[0])


def _twins(group: tuple[Branch, ...], prefix: str, state: State) -> Twins:
    paths = [prefix + _last(branch.path) for branch in group]
    columns = tuple(branch.title for branch in group)
    rows = tuple(
        tuple(
            field_view(field, f"{path}.{_last(field.path)}", state, column)
            for field, path, column in zip(line, paths, columns, strict=True)
        )
        for line in zip(*(branch.fields for branch in group), strict=True)
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


def _name(field: Field, prefix: str) -> str:
    return prefix + _last(field.path)


def _last(path: str) -> str:
    return path.removesuffix(f".{ITEM}").rpartition(".")[2]
