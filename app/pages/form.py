"""The form of a case, made from the schema.

The form shows each field with the text that the user typed, the meaning of the field, and the faults of the field.
"""

import re
from collections.abc import Iterable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, field, replace
from itertools import accumulate, groupby, product
from typing import Any

from app.manual.fields import address as row_address
from app.pages.query import MATRIX, PICK, PRESENT, SIDE, excluded
from app.pages.typed import text_of
from app.pages.typesetting import cited, symbol, words
from app.schema.fields import Branch, Leaf, branches, is_below, leaf_at, pattern_of, tree
from app.schema.model import Request
from app.schema.model import Section as Fields
from app.schema.quantities import split_unit

REQUIRED, IF_USED = "required", "required if used"
BESIDE = 10  # largest number of letters of an option that still fits beside the label of its field
FITS = 16  # largest number of letters of a default in words that still fits into its field
DETAIL = "detail"
"""Name of the request field that sets the level of detail of the answer.

The form does not show this field, because every page sets the level that it needs.
"""


@dataclass(frozen=True, slots=True)
class FormState:
    """The state of a form. The keys of all mappings are the names of fields.

    `texts` holds the texts of the fields, `faults` holds the messages about their faults, and `resolved` holds the
    values that an answer used for the fields. `assumed` are the fields whose default is our own assumption. `required`
    is the remark beside required fields, for example "required if used" in an optional section. `deciding` are the
    fields on which a verdict depends; the sections of these fields are open. `endpoint` is the endpoint to which the
    form belongs. `rules` are the rules of fields that are given but assumed, such as those of typical shafts.
    """

    texts: Mapping[str, str] = field(default_factory=dict)
    faults: Mapping[str, str] = field(default_factory=dict)
    resolved: Mapping[str, Any] = field(default_factory=dict)
    assumed: AbstractSet[str] = frozenset()
    required: str = REQUIRED
    deciding: AbstractSet[str] = frozenset()
    endpoint: str = ""
    rules: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class FieldView:
    """What the template shows of a field. `widget` is number, text, list, select or table.

    `empty` describes in one line the value that is used if the field is empty. `column` names the section of the field
    if several sections are shown side by side. `excludes` are the fields and sections that must be empty if this field
    is given. `elements` are the elements of a matrix, row by row. `reference` is the address of the row of this field
    in the table of all fields.
    """

    name: str
    label: str
    symbol: str = ""
    unit: str = ""
    widget: str = "number"
    text: str = ""
    placeholder: str = ""
    options: tuple[tuple[str, str], ...] = ()
    required: str = ""
    assumed: bool = False
    help: tuple[str, ...] = ()
    fault: str | None = None
    column: str = ""
    excludes: tuple[str, ...] = ()
    empty: str = ""
    elements: tuple["FieldView", ...] = ()
    source: str = ""
    reference: str = ""
    kind: str = "field"

    @property
    def id(self) -> str:
        """The anchor of the field on the page."""
        return anchor(self.name)

    @property
    def wide(self) -> bool:
        """Whether one of the options is too long for a control that stands beside the label of the field."""
        return any(len(label) > BESIDE for _, label in self.options)


@dataclass(frozen=True, slots=True)
class Alternatives:
    """Alternative fields, of which only one may be given; `picked` is the name of the field that is used."""

    name: str
    fields: tuple[FieldView, ...]
    picked: str
    required: str
    kind: str = "choice"


@dataclass(frozen=True, slots=True)
class FormSection:
    """A part of the form.

    `kind` is one of three words:

    - `section`: the part shows fields, choices and inner sections one below the other.
    - `rows`: the part shows the items of a list of sections. The last item is empty, so that the user can add an item.
    - `twins`: the part shows sections of the same model side by side, with one line per field. `columns` holds the
      titles of these sections; the keys are the paths of the sections.

    `switch` is the field by which the user adds or removes an optional section.
    """

    path: str
    title: str
    blocks: tuple["Block", ...]
    open: bool
    given: int
    assumed: int
    id: str
    description: str = ""
    fault: str | None = None
    switch: FieldView | None = None
    needed: bool = False
    deciding: bool = False
    advanced: bool = False
    columns: dict[str, str] = field(default_factory=dict)
    kind: str = "section"


Block = FieldView | Alternatives | FormSection | tuple[FieldView, ...]


def anchor(path: str) -> str:
    """Return the id of a field or section on the page."""
    return f"f.{path}"


def link_to(request: type[Request], path: str) -> str:
    """Return the link to a field or section on the page of the case."""
    sections = branches(request)
    while path and leaf_at(request, path) is None and path not in sections:
        path = path.rpartition(".")[0]
    return f"#{anchor(path)}" if path else "#form"


def title_of(request: type[Request], path: str) -> str:
    """Return the title of a field. For a section, return the titles of all sections on its path, outermost first."""
    leaf = leaf_at(request, path)
    if leaf is not None:
        return leaf.title
    sections, around = branches(request), accumulate(path.split("."), "{}.{}".format)
    return ", ".join(sections[outer].title for outer in around if outer in sections) or path


def place_of_field(request: type[Request], path: str) -> str:
    """Return the title of a field. For a field of a list's item, the item stands before it: pinion shaft, bearing 1."""
    names, sections = path.split("."), branches(request)
    last = max((place for place, name in enumerate(names) if name.isdecimal()), default=0)
    if not last:
        return title_of(request, path)
    titles = list[str]()
    for place, name in enumerate(names[: last + 1]):
        around = pattern_of(".".join(names[: place + 1]))
        if name.isdecimal():
            titles[-1] = f"{titles[-1].removesuffix('s')} {int(name) + 1}"
        elif around in sections:
            titles.append(sections[around].title)
    leaf = leaf_at(request, path)
    return ", ".join([*titles, leaf.title] if leaf else titles)


def form(request: type[Request], state: FormState) -> tuple[FormSection, ...]:
    """Return the sections of the form: sections with required fields first, advanced sections last."""
    root, loose = tree(request), list[Block]()
    sections = []
    for block in _blocks(root, "", state):
        if not isinstance(block, FormSection):
            loose.append(block)
        elif block.kind == "section":
            sections.append(block)
        else:  # rows and twins get a section around them
            sections.append(replace(block, blocks=(block,), kind="section", id=f"{anchor(block.path)}-", fault=None))
    if loose:
        names = [leaf.path for leaf in root.leaves if leaf.path != DETAIL]
        attributes: dict[str, Any] = {"path": "general", "id": anchor("general"), "fault": None}
        needed = any(leaf.required for leaf in root.leaves)
        sections.append(_section("general", loose, state, names, needed=needed, **attributes))
    return tuple(sorted(sections, key=lambda section: (not section.needed, section.advanced, not section.deciding)))


def _section(title: str, blocks: Iterable[Block], state: FormState, paths: list[str], **settled: Any) -> FormSection:
    """Return a section of the form, with the fields of the request at or below `paths`."""
    groups = (state.texts, state.faults, {*state.assumed, *state.rules}, state.deciding)
    given, faulty, assumed, deciding = (sum(_count(names, path) for path in paths) for names in groups)
    attributes: dict[str, Any] = {
        "path": paths[0],
        "open": settled.get("needed", False)
        or faulty > 0
        or deciding > 0
        or (given > 0 and not settled.get("advanced")),
        "deciding": deciding > 0,
        "given": given,
        "assumed": assumed,
        "id": anchor(paths[0]),
        "fault": "; ".join(state.faults[path] for path in paths if path in state.faults) or None,
    }
    return FormSection(title=title, blocks=tuple(blocks), **attributes | settled)


def _count(names: Iterable[str], path: str) -> int:
    """Count the `names` that are equal to `path` or lie below `path`."""
    return sum(is_below(name, path) for name in names)


def _branch(branch: Branch, path: str, state: FormState, item: int | None = None) -> FormSection:
    """Return the part of the form that shows a section of the request."""
    given = _count(state.texts, path) > 0
    switch = None
    if branch.optional and not branch.required:  # the switch adds the section even if all its fields are empty
        switch = FieldView(
            name=path,
            label=f"use {branch.title}",
            widget="select",
            text=state.texts.get(path, PRESENT if given else ""),
            options=(("", "no"), (PRESENT, "yes")),
            help=(_in_a_form(branch.description),),
        )
    unused = (branch.optional or branch.repeated or state.required == IF_USED) and not given
    is_solved_item = item is not None and state.resolved and not _count(state.faults, path)
    return _section(
        branch.title if item is None else f"{branch.title} {item + 1}",
        _with_folded(branch, path, replace(state, required=IF_USED if unused else REQUIRED)),
        state,
        [path],
        description=branch.description if item is None else "",
        switch=switch,
        needed=branch.required and not branch.optional and item is None,
        advanced=branch.advanced,
        **({"open": False} if is_solved_item else {}),
    )


def _with_folded(branch: Branch, path: str, state: FormState) -> Iterator[Block]:
    """Yield the blocks of a section, and then an inner section with the fields that only few users need."""
    folded = {f"{path}.{_last(leaf.path)}" for leaf in branch.leaves if leaf.declared.folded}
    behind = list[Block]()
    for block in _blocks(branch, f"{path}.", state):
        if isinstance(block, FieldView) and block.name in folded:
            behind.append(block)
        else:
            yield block
    if behind:
        name = f"{path}.advanced"
        yield _section("advanced", behind, state, sorted(folded), path=name, id=anchor(name), fault=None)


def _rows(branch: Branch, path: str, state: FormState) -> FormSection:
    below = (name.removeprefix(f"{path}.") for name in state.texts if name.startswith(f"{path}."))
    indices = (name.partition(".")[0] for name in below)
    count = 1 + max((int(index) for index in indices if index.isdecimal() and index.isascii()), default=-1)
    items = [_branch(branch, f"{path}.{index}", state, item=index) for index in range(count + 1)]
    return _section(branch.title, items, state, [path], given=count, description=branch.description, kind="rows")


def _twins(group: tuple[Branch, ...], prefix: str, state: FormState) -> FormSection:
    columns = {prefix + _last(branch.path): branch.title for branch in group}
    lines = [
        tuple(
            replace(field_view(leaf, f"{path}.{_last(leaf.path)}", state), column=title)
            for leaf, (path, title) in zip(line, columns.items(), strict=True)
        )
        for line in zip(*(branch.leaves for branch in group), strict=True)
    ]
    needed, title = any(view.required for line in lines for view in line), " and ".join(columns.values())
    return _section(title, lines, state, [*columns], needed=needed, columns=columns, kind="twins")


def _blocks(branch: Branch, prefix: str, state: FormState) -> Iterator[Block]:
    """Yield the fields of a section and the sections inside the section, in the order of the schema."""
    choices = _choices(branch)
    shown = {DETAIL}
    # Neighbouring sections of the same model are shown side by side if they contain only fields.
    alike = groupby(branch.branches, lambda inner: inner.path if inner.repeated or inner.branches else inner.model)
    groups = {group[0].path: group for group in (tuple(members) for _, members in alike)}
    for member in branch.members:
        name = prefix + _last(member.path)
        if isinstance(member, Branch):
            group = groups.get(member.path, ())
            if len(group) > 1:
                yield _twins(group, prefix, state)
            elif group:
                yield _rows(member, name, state) if member.repeated else _branch(member, name, state)
        elif member.path in choices and member.path not in shown:
            shown.update(leaf.path for leaf in choices[member.path])
            needed = issubclass(branch.model, Fields) and branch.model.choice_missing is not None
            yield _choice(choices[member.path], prefix, state, state.required if needed else "")
        elif member.path not in shown:
            yield _own(member, name, state)


def _choices(branch: Branch) -> dict[str, tuple[Leaf, ...]]:
    """Return the groups of alternative fields. The form shows one field of each group at a time."""
    fields = {_last(leaf.path): leaf for leaf in branch.leaves}
    choices: dict[str, tuple[Leaf, ...]] = {}
    for group in (*branch.model.alternatives, *branch.model.exclusive):
        if all(name in fields and fields[name].path not in choices for name in group):
            members = tuple(fields[name] for name in group)
            choices |= {leaf.path: members for leaf in members}
    return choices


def _choice(group: tuple[Leaf, ...], prefix: str, state: FormState, required: str) -> Alternatives:
    fields = {prefix + _last(leaf.path): leaf for leaf in group}
    given = [name for name in fields if name in state.texts]
    resolved = [name for name in fields if state.resolved.get(name) is not None]
    first, *_ = fields
    views = tuple(field_view(leaf, name, state) for name, leaf in fields.items())
    return Alternatives(PICK + first, views, [*given, *resolved, first][0], required)


def _own(leaf: Leaf, name: str, state: FormState) -> FieldView:
    """View of a field that has no alternative fields. The view of a matrix or a pair has a view of each element."""
    whole, resolved = field_view(leaf, name, state), state.resolved.get(name)
    if leaf.pair:
        return _pair(leaf, whole, state)
    if leaf.dimensions < MATRIX:
        return whole
    elements = tuple(
        replace(
            whole,
            name=f"{name}.{row}.{column}",
            label=f"{whole.label}, row {row + 1}, column {column + 1}",
            widget="number",
            text=state.texts.get(f"{name}.{row}.{column}", whole.text if row == column == 0 else ""),
            placeholder=f"{resolved[row][column]:.6g}" if resolved else "",
            help=(*whole.help, "If only the first element is given, the stiffness is the same in every direction."),
            fault=state.faults.get(f"{name}.{row}.{column}", whole.fault if row == column == 0 else None),
        )
        for row, column in product(range(SIDE), repeat=2)
    )
    return replace(whole, elements=elements, kind="matrix")


def _pair(leaf: Leaf, whole: FieldView, state: FormState) -> FieldView:
    """View of two numbers that belong together, such as the ends of a range: a field for each of them."""
    used = state.resolved.get(whole.name, leaf.default) or (None, None)
    names = (leaf.declared.index or "first, second").split(", ")
    elements = tuple(
        replace(
            whole,
            name=f"{whole.name}.{place}",
            label=f"{whole.label}, {name}",
            widget="number",
            text=state.texts.get(f"{whole.name}.{place}", ""),
            placeholder=name if value is None else f"{value:.6g}",
            fault=state.faults.get(f"{whole.name}.{place}", whole.fault if place == 0 else None),
        )
        for place, (name, value) in enumerate(zip(names, used, strict=True))
    )
    return replace(whole, elements=elements, kind="matrix")


def field_view(leaf: Leaf, name: str, state: FormState) -> FieldView:
    """Return the view of a field; `name` is the path of the field with the indices of lists."""
    text, value = state.texts.get(name, ""), state.resolved.get(name, leaf.default)
    options = _options(leaf, text, value)
    widget = "text" if leaf.kind in {"text", "other"} else "number"
    rule = "" if value not in (None, []) or leaf.options else leaf.declared.default_text or ""
    rule = words(cited(rule).replace("`", ""))
    fits = widget == "number" and not leaf.dimensions and len(rule) <= FITS
    return FieldView(
        name=name,
        label=leaf.declared.title,
        symbol=symbol(leaf.declared.symbol),
        unit=leaf.unit or "",
        widget="list" if leaf.dimensions else "select" if options else widget,
        text=text,
        placeholder=_placeholder(leaf, value) or (rule if fits else ""),
        options=options,
        required=state.required if leaf.required else "",
        assumed=name in state.assumed or name in state.rules,
        help=(*_help(leaf, assumed=name in state.assumed), *_rule(name, state)),
        fault=state.faults.get(name),
        excludes=excluded(name, leaf),
        source=cited(leaf.declared.source or ""),
        reference=row_address(state.endpoint, leaf.path),
        empty="" if fits else rule,
    )


def _placeholder(leaf: Leaf, value: Any) -> str:
    """Return the text in an empty field: the value that an answer used, or the default if there is no answer."""
    if isinstance(value, list) and value:
        return " ".join(text_of(item) for item in value[:6]) + (" …" if len(value) > 6 else "")
    if value is None or value == []:
        return "paste a column" if leaf.dimensions else ""
    return f"{value:.6g}" if isinstance(value, float) else text_of(value)


def _options(leaf: Leaf, text: str, used: Any) -> tuple[tuple[str, str], ...]:
    """Return the values and labels of the options of a field; empty if the field has no options."""
    named = {str(option): words(str(option)) for option in leaf.options}
    if leaf.kind == "boolean":
        named = {"true": "yes", "false": "no"}
    if not named:
        return ()
    default = "" if leaf.default is None else text_of(leaf.default)
    if used is not None and not text and text_of(used) != default:
        default = ""  # another value than the default was looked up, such as the kind of a named oil
    if default not in named:
        open_label = (
            cited(leaf.declared.default_text or "choose …")
            if used is None or text
            else f"by default: {named.get(text_of(used), words(text_of(used)))}"
        )
        named = {"": open_label, **named}
    if text:
        named.setdefault(text, text)
    return tuple(("" if value == default != text else value, label) for value, label in named.items())


def _help(leaf: Leaf, *, assumed: bool) -> tuple[str, ...]:
    """Return the lines of help: meaning, permissible range, assumed default and alternatives."""
    ends = {"ge": "from", "gt": "above", "le": "to", "lt": "below"}
    bounds = [f"{ends[key]} {text_of(float(bound))}" for key, bound in leaf.declared.bounds.items()]
    fellows = (words(split_unit(fellow.rpartition(".")[2])[0]) for fellow in leaf.exclusive)
    meaning = leaf.declared.description
    lines = [
        f"{meaning[0].upper()}{meaning[1:]}.",
        " ".join(["Permissible:", *bounds, leaf.unit or ""]).rstrip() + "." if bounds else "",
        f"{'Assumed' if assumed else 'Our default'}: {leaf.declared.assumed}." if leaf.declared.assumed else "",
        f"Instead of: {', '.join(fellows)}." if leaf.exclusive else "",
    ]
    return tuple(cited(_in_a_form(line)) for line in lines if line)


def _in_a_form(text: str) -> str:
    """Return a text about a request in the words of a form, where a field without a value is empty."""
    return re.sub(r"\bnull\b", "empty", text)


def _rule(name: str, state: FormState) -> tuple[str, ...]:
    """Return a line of help that states by which rule the value of the field is assumed."""
    return (f"Assumed, typical: {state.rules[name]}.",) if name in state.rules else ()


def _last(path: str) -> str:
    return path.rpartition(".")[2]
