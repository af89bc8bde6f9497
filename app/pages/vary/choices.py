"""What can be varied and what can be shown, with the range that is meant when none is given."""

from dataclasses import dataclass
from math import ceil, floor
from typing import Any, NamedTuple

from app.calculations import Calculation
from app.pages.results import NOT_RESULTS
from app.pages.typesetting import shown
from app.schema.fields import ITEM, Leaf, headlines, leaves
from app.schema.tree import tree
from app.studies.fields import value_at
from app.studies.requests import Scalar
from app.studies.sensitivity import NUMBERS, places

AROUND = 0.5  # of a value, to both sides
TOLERANCES = 4.0  # to both sides of zero
INSIDE = 1e-3  # of a range, away from an end that is not allowed


class Range(NamedTuple):
    """From and to."""

    start: float
    stop: float


@dataclass(frozen=True, slots=True)
class Choice:
    """An entry of a menu, in a group."""

    path: str
    label: str
    group: str


def varied(calculation: Calculation, case: dict[str, Any], *, words: bool) -> list[Choice]:
    """Every single field that has numbers, with its value in this case; and those with words to choose from."""
    titles = {branch.path: branch.title for branch in tree(calculation.request).branches}
    found = []
    for leaf in leaves(calculation.request):
        if leaf.is_scalar and leaf.path != "detail" and (has_numbers(leaf) or (words and words_of(leaf))):
            group = titles.get(leaf.path.partition(".")[0], "general")
            found += [Choice(path, _label(leaf, path, case), group) for path in places(leaf.path, case)]
    return found


def words_of(leaf: Leaf) -> list[Scalar]:
    """What a field can be if it is no number."""
    return [True, False] if leaf.kind == "boolean" else [option for option in leaf.options if isinstance(option, str)]


def grades_of(leaf: Leaf) -> list[float]:
    """The numbers of a field that takes only some."""
    return [option for option in leaf.options if isinstance(option, int | float) and not isinstance(option, bool)]


def has_numbers(leaf: Leaf) -> bool:
    """Whether an axis can run along it."""
    return leaf.kind in NUMBERS or bool(grades_of(leaf))


def _label(leaf: Leaf, path: str, case: dict[str, Any]) -> str:
    number = next((part for part in path.split(".") if part.isdecimal()), None)
    name = leaf.title if number is None else f"{leaf.title} {int(number) + 1}"
    value = value_at(case, path)
    return name if value is None else f"{name} ({shown(value)}{f' {leaf.unit}' if leaf.unit else ''})"


def shown_outputs(calculation: Calculation) -> list[Choice]:
    """Every number of the answer that a study can tell, the headlines first."""
    response = calculation.response
    first = headlines(response)
    rest = [leaf for leaf in leaves(response) if _is_told(leaf) and leaf not in first]
    titles = {branch.path: branch.title for branch in tree(response).branches}
    return [Choice(leaf.path, _named(leaf), "numbers that decide") for leaf in first if _is_told(leaf)] + [
        Choice(leaf.path, _named(leaf), titles.get(leaf.path.partition(".")[0], "result")) for leaf in rest
    ]


def _is_told(leaf: Leaf) -> bool:
    whole = leaf.is_scalar and leaf.kind in NUMBERS and leaf.detail == "summary" and ITEM not in leaf.path.split(".")
    return whole and leaf.path.partition(".")[0] not in NOT_RESULTS


def _named(leaf: Leaf) -> str:
    return f"{leaf.title}, {leaf.unit}" if leaf.unit else leaf.title


def usual_range(leaf: Leaf, value: float | None) -> Range | None:
    """Around the value of the case, inside what is allowed; None where the case has none and the field no two ends."""
    low, high = _ends(leaf)
    if value is None or (value == 0.0 and leaf.tolerance is None):
        return None if low is None or high is None else _whole(leaf, Range(low, high))
    reach = AROUND * abs(value) if value else TOLERANCES * (leaf.tolerance or 0.0)
    start, stop = value - reach, value + reach
    start = start if low is None else max(start, low)
    stop = stop if high is None else min(stop, high)
    return _whole(leaf, Range(start, stop))


def _ends(leaf: Leaf) -> tuple[float | None, float | None]:
    """Least and greatest value that are allowed."""
    low, high = (leaf.bounds.get(closed, leaf.bounds.get(beyond)) for closed, beyond in (("ge", "gt"), ("le", "lt")))
    margin = INSIDE * (high - low) if low is not None and high is not None else INSIDE
    if low is not None and "gt" in leaf.bounds:
        low += margin
    if high is not None and "lt" in leaf.bounds:
        high -= margin
    return low, high


def _whole(leaf: Leaf, found: Range) -> Range:
    """Whole numbers where the field takes no others, else four digits."""
    if leaf.kind == "integer":
        return Range(ceil(found.start), floor(found.stop))
    return Range(*(float(f"{end:.4g}") for end in found))
