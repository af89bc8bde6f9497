"""One field of the form: what was typed, what it means, what stands for it when empty, what is wrong with it."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from markupsafe import Markup

from app.pages.query import text_of
from app.pages.typesetting import symbol, words
from app.schema.fields import Leaf
from app.schema.tree import Field
from app.schema.units import split_unit

Widget = Literal["number", "text", "list", "select"]
ROWS_OF_TEXT = 3


@dataclass(frozen=True, slots=True)
class State:
    """What is known of a case beside the schema, by path: texts typed, faults, and what an answer resolved."""

    texts: Mapping[str, str] = field(default_factory=dict)
    faults: Mapping[str, str] = field(default_factory=dict)
    resolved: Mapping[str, Any] = field(default_factory=dict)
    assumed: Mapping[str, str] = field(default_factory=dict)

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
    """What the template shows of a field."""

    name: str
    label: str
    symbol: Markup
    unit: str
    widget: Widget
    text: str
    placeholder: str
    options: tuple[tuple[str, str], ...]
    required: bool
    assumed: bool
    help: tuple[str, ...]
    fault: str | None
    column: str = ""
    excludes: tuple[str, ...] = ()

    @property
    def id(self) -> str:
        """Anchor on the page."""
        return anchor(self.name)


def anchor(path: str) -> str:
    """The id of a field or section on the page."""
    return f"f.{path}"


def field_view(member: Field, name: str, state: State, column: str = "") -> FieldView:
    """A field under its name with indices; `column` names it where several stand side by side."""
    leaf = member.leaf
    return FieldView(
        name=name,
        label=member.label,
        symbol=symbol(leaf.symbol),
        unit=leaf.unit or "",
        widget=_widget(leaf),
        text=state.texts.get(name, ""),
        placeholder=_placeholder(leaf, name, state),
        options=tuple(_options(leaf, state.texts.get(name, ""))),
        required=leaf.required,
        assumed=name in state.assumed,
        help=tuple(_help(leaf, name, state)),
        fault=state.faults.get(name),
        column=column,
        excludes=_excludes(leaf, name),
    )


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
    if leaf.default_text:
        return leaf.default_text
    return "paste a column" if leaf.dimensions else ""


def _options(leaf: Leaf, text: str) -> list[tuple[str, str]]:
    if not leaf.options and leaf.kind != "boolean":
        return []
    named = [("true", "yes"), ("false", "no")] if leaf.kind == "boolean" else [(o, words(str(o))) for o in leaf.options]
    default = text_of(leaf.default) if leaf.default is not None else None
    shown = [(str(value), f"{label} (default)" if str(value) == default else label) for value, label in named]
    known = {value for value, _ in shown}
    empty = [] if default in known else [("", leaf.default_text or "choose …")]
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
    if leaf.assumed:
        lines.append(f"{'Assumed' if name in state.assumed else 'Our default'}: {leaf.assumed}.")
    if leaf.exclusive:
        fellows = ", ".join(_last_words(fellow) for fellow in leaf.exclusive)
        lines.append(f"Instead of: {fellows}.")
    if leaf.source:
        lines.append(f"Source: {leaf.source}.")
    return lines


def _last_words(path: str) -> str:
    """The name of a field without its unit, as words."""
    return words(split_unit(path.rpartition(".")[2])[0])


def _sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}." if text else ""


def _range(leaf: Leaf) -> str:
    names = {"ge": "from", "gt": "above", "le": "to", "lt": "below"}
    parts = [f"{names[key]} {text_of(float(bound))}" for key, bound in leaf.bounds.items()]
    return f"Allowed: {' '.join(parts)} {leaf.unit or ''}".rstrip() + "." if parts else ""
