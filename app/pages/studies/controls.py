"""The controls in the form of a study. A control states which part of the request body it sets.

`body_of` converts typed texts into the body, and `texts_of` converts a body into texts.
"""

from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple

from app.calculations import Calculation
from app.pages.typed import number_of, text_of
from app.pages.typesetting import shown
from app.schema.fields import Leaf, leaves, nested, tree, value_at
from app.studies.fields import NUMBERS, indexed, is_plain_number

Options = tuple[tuple[str, str], ...]


class Control(NamedTuple):
    """A control of the form, and the part of the request body that the control sets.

    Attributes
    ----------
    name
        Name of the control in links.
    path
        Dotted path of the part of the body, with numbers for positions in lists.
    default
        Value if nothing is typed; None leaves the part out.
    read
        Converts a typed text into the value.
    label, unit, options
        Label, unit and choices in the form.
    sets
        Whether `body_of` sets the part from this control. If not, other code sets the part, and the control only shows
        the errors of the part.
    """

    name: str
    path: str
    default: Any = None
    read: Callable[[str], Any] = number_of
    label: str = ""
    unit: str = ""
    options: Options = ()
    sets: bool = True


def body_of(controls: Iterable[Control], typed: Mapping[str, str]) -> dict[str, Any]:
    """Return the parts of the body that the controls set."""
    given = ((control, typed.get(control.name)) for control in controls if control.sets)
    values = {control.path: control.read(text) if text else control.default for control, text in given}
    return nested({path: value for path, value in values.items() if value is not None})


def texts_of(controls: Iterable[Control], body: Any) -> dict[str, str]:
    """Return the text of each control from which `body_of` would make this body."""
    values = ((control, value_at(body, control.path)) for control in controls if control.sets)
    return {control.name: text_of(value) for control, value in values if value is not None and value != control.default}


class Choice(NamedTuple):
    """An entry of a menu, with the title of its group."""

    path: str
    label: str
    group: str


class Menu(NamedTuple):
    """A menu with grouped entries.

    `chosen` is the path of the chosen entry, or an empty text if nothing is chosen. `empty` is the label of the entry
    that stands for no choice. `shown` is the label of the chosen entry, printed below the menu because a narrow menu
    cuts the label off.
    """

    name: str
    label: str
    empty: str
    chosen: str
    shown: str
    groups: list[tuple[str, list[Choice]]]
    fault: str | None


def field_choices(calculation: Calculation, case: dict[str, Any], *, texts: bool) -> list[Choice]:
    """Return a choice for every field that takes a single number. The label states the value of the field in the case.

    If `texts` is true, fields that take one of several fixed texts are also included.
    """
    titles = {branch.path: branch.title for branch in tree(calculation.request).branches}
    choices = []
    for leaf in leaves(calculation.request):
        if leaf.is_scalar and leaf.path != "detail" and (has_numbers(leaf) or (texts and choices_of(leaf))):
            group = titles.get(leaf.path.partition(".")[0], "general")
            unit = f" {leaf.unit}" if leaf.unit else ""
            for path in indexed(leaf.path, case):
                name, value = numbered(leaf.title, path), value_at(case, path)
                choices.append(Choice(path, name if value is None else f"{name} ({shown(value)}{unit})", group))
    return choices


def numbered(title: str, path: str) -> str:
    """Return the title of an input, followed by the numbers of the list items on its path, counted from 1."""
    places = [str(int(part) + 1) for part in path.split(".") if part.isdecimal()]
    return f"{title} {'.'.join(places)}" if places else title


def choices_of(leaf: Leaf) -> list[Any]:
    """Return the values of a field that accepts only a fixed set of values; an empty list for any other field."""
    return [True, False] if leaf.kind == "boolean" else list(leaf.options)


def has_numbers(leaf: Leaf) -> bool:
    """Return whether a field takes numbers. Only such a field can be varied along an axis of numbers."""
    return leaf.kind in NUMBERS or any(map(is_plain_number, leaf.options))
