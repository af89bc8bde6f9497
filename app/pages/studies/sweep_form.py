"""The form of a study: menus of fields and outputs, ranges with what stands for them when empty."""

from dataclasses import dataclass
from itertools import groupby
from typing import Any

from app.calculations import Calculation
from app.pages.form import FieldView
from app.pages.query import text_of
from app.pages.studies.sweep_query import AXES, COUNTS, Choice, SweepQuery, Varied, shown_outputs, varied
from app.pages.typesetting import symbol
from app.schema.fields import headlines


@dataclass(frozen=True, slots=True)
class Menu:
    """A choice in groups."""

    name: str
    label: str
    empty: str
    chosen: str
    groups: tuple[tuple[str, tuple[Choice, ...]], ...]
    fault: str | None

    @property
    def id(self) -> str:
        """Anchor on the page."""
        return f"f.{self.name}"


@dataclass(frozen=True, slots=True)
class AxisControls:
    """A field and its range."""

    title: str
    menu: Menu
    fields: tuple[FieldView, ...]


@dataclass(frozen=True, slots=True)
class Controls:
    """All of them."""

    axes: tuple[AxisControls, ...]
    show: Menu
    best: FieldView


def controls(
    calculation: Calculation,
    case: dict[str, Any],
    said: dict[str, str],
    faults: dict[str, str],
    query: SweepQuery | None,
) -> Controls:
    """The form with what was said, what stands for the rest, and what is wrong."""
    fields = dict(zip(AXES, query.fields, strict=False)) if query else {}
    titles = {"x": "Vary", "y": "and, as curves or a map"}
    axes = tuple(
        AxisControls(
            titles[name],
            _menu(name, "field", "choose …" if name == "x" else "nothing else", said, faults, choices),
            _range(name, said, faults, fields.get(name)),
        )
        for name in AXES
        for choices in [varied(calculation, case, words=name == "y")]
    )
    ends = (("", "by the output"), ("least", "least"), ("greatest", "greatest"))
    return Controls(
        axes,
        output_menu(calculation, said, faults),
        _select("best", "the best is", said, faults, ends),
    )


def output_menu(calculation: Calculation, said: dict[str, str], faults: dict[str, str]) -> Menu:
    """The outputs that a study can tell."""
    first = headlines(calculation.response)[0]
    return _menu("show", "output", first.title, said, faults, shown_outputs(calculation))


def _menu(
    name: str, label: str, empty: str, said: dict[str, str], faults: dict[str, str], choices: list[Choice]
) -> Menu:
    groups = tuple((group, tuple(items)) for group, items in groupby(choices, key=lambda choice: choice.group))
    chosen = said.get(name, "")
    if chosen and all(choice.path != chosen for choice in choices):
        groups = (*groups, ("asked for", (Choice(chosen, chosen, ""),)))
    return Menu(name, label, empty, chosen, groups, faults.get(name))


def _range(name: str, said: dict[str, str], faults: dict[str, str], found: Varied | None) -> tuple[FieldView, ...]:
    unit = (found.leaf.unit or "") if found else ""
    start, stop = found.usual if found and found.usual else (None, None)
    return (
        _number(f"{name}.from", "from", said, faults, start, unit),
        _number(f"{name}.to", "to", said, faults, stop, unit),
        _number(f"{name}.count", "points", said, faults, COUNTS[name], ""),
        _select(f"{name}.scale", "steps", said, faults, (("", "even steps"), ("log", "even ratios"))),
    )


def _number(
    name: str, label: str, said: dict[str, str], faults: dict[str, str], usual: float | None, unit: str
) -> FieldView:
    placeholder = "" if usual is None else text_of(usual)
    return _field(name, label, said, faults, unit=unit, placeholder=placeholder)


def _select(
    name: str, label: str, said: dict[str, str], faults: dict[str, str], options: tuple[tuple[str, str], ...]
) -> FieldView:
    return _field(name, label, said, faults, options=options)


def _field(
    name: str,
    label: str,
    said: dict[str, str],
    faults: dict[str, str],
    *,
    unit: str = "",
    placeholder: str = "",
    options: tuple[tuple[str, str], ...] = (),
) -> FieldView:
    return FieldView(
        name=name,
        label=label,
        symbol=symbol(None),
        unit=unit,
        widget="select" if options else "number",
        text=said.get(name, ""),
        placeholder=placeholder,
        options=options,
        required=False,
        assumed=False,
        help=(),
        fault=faults.get(name),
    )
