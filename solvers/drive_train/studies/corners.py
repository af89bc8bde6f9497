"""Worst corners: every combination of the ends of what nobody knows better."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from math import prod
from typing import Any

from solvers.drive_train.inputs import DriveTrainInputs, JournalBearing, Shaft
from solvers.drive_train.studies.outcome import FIGURES, Outcome, check_figure, outcome
from solvers.drive_train.studies.variation import varied
from solvers.errors import InvalidInput, NoSolution
from solvers.notices import Notice

MOST_RUNS = 256
FRICTION = (0.05, 0.25)
THRUST = (0.0, 1.0)
RESPONSE = (0.3, 1.0)
CLEARANCE = 0.1
QUARTERS: tuple[Callable[[float, float], tuple[float, float]], ...] = (
    lambda x, y: (x, y),
    lambda x, y: (-y, x),
    lambda x, y: (-x, -y),
    lambda x, y: (y, -x),
)


@dataclass(frozen=True, slots=True)
class Range:
    """Values that inputs at dotted names take together, a row for each choice."""

    names: tuple[str, ...]
    values: tuple[tuple[Any, ...], ...]

    def choices(self) -> Iterator[dict[str, Any]]:
        """The values by their names, row by row."""
        return (dict(zip(self.names, row, strict=True)) for row in self.values)


def single(name: str, values: Iterable[Any]) -> Range:
    """The values of one input."""
    return Range((name,), tuple((value,) for value in values))


@dataclass(frozen=True, slots=True)
class Extreme:
    """A largest or smallest figure and the corner where it is: dotted name, value."""

    value: float
    corner: dict[str, Any]


@dataclass(frozen=True, slots=True)
class Corners:
    """Smallest and largest of every figure over `runs` combinations; `failed` of them have no solution."""

    smallest: dict[str, Extreme]
    largest: dict[str, Extreme]
    runs: int
    failed: int
    warnings: tuple[Notice, ...]


def default_ranges(inputs: DriveTrainInputs) -> tuple[Range, ...]:
    """Wall response, tilt of each shaft by clearance; friction, direction of the offset and thrust of the couplings.

    The clearances of a shaft's two bearings move 10 % in opposite senses, for what they share does not tilt. Couplings
    move together: in all combinations of their own, two would need 2,048 runs.
    """
    ranges = [single("heat.wall_response", RESPONSE)] if inputs.effects.thermal else []
    if inputs.effects.shafts:
        named = (("pinion_shaft", inputs.pinion_shaft), ("wheel_shaft", inputs.wheel_shaft))
        ranges += [_clearances(name, shaft) for name, shaft in named]
    if inputs.acting_couplings:
        ranges += [
            _together(inputs, "friction.coefficient", FRICTION),
            _offsets(inputs),
            _together(inputs, "thrust_fraction", THRUST),
        ]
    return tuple(one for one in ranges if one.names)


def _clearances(name: str, shaft: Shaft) -> Range:
    """Clearances of plain bearings up by a share at the first, down at the second, and the reverse."""
    plain = [(k, bearing.clearance) for k, bearing in enumerate(shaft.bearings) if isinstance(bearing, JournalBearing)]
    return Range(
        tuple(f"{name}.bearings.{k}.radial_clearance" for k, _ in plain),
        tuple(tuple(own * (1 + sign * (1 - 2 * k) * CLEARANCE) for k, own in plain) for sign in (1, -1)),
    )


def _together(inputs: DriveTrainInputs, name: str, values: tuple[float, ...]) -> Range:
    """The same values of all couplings."""
    names = tuple(f"couplings.{k}.{name}" for k in range(len(inputs.acting_couplings)))
    return Range(names, tuple((value,) * len(names) for value in values))


def _offsets(inputs: DriveTrainInputs) -> Range:
    """The offsets of all couplings that have one, turned by quarters."""
    given = [(k, one.offset) for k, one in enumerate(inputs.acting_couplings) if any(one.offset)]
    names = tuple(f"couplings.{k}.offset.{axis}" for k, _ in given for axis in range(2))
    turned = ([pair for _, (x, y) in given for pair in turn(x, y)] for turn in QUARTERS)
    return Range(names, tuple(map(tuple, turned)))


def run_corners(
    inputs: DriveTrainInputs,
    ranges: Sequence[Range] | None = None,
    figures: Sequence[str] = FIGURES,
    progress: Callable[[int, int], None] | None = None,
) -> Corners:
    """Extremes of the figures over the product of the ranges.

    Raises InvalidInput (too_many_corners, unknown_name, unknown_figure and what `outcome` raises).
    """
    chosen = default_ranges(inputs) if ranges is None else tuple(ranges)
    for figure in figures:
        check_figure(figure)
    runs = prod(len(one.values) for one in chosen)
    if runs > MOST_RUNS:
        raise InvalidInput("too_many_corners", f"the ranges make {runs} combinations; at most {MOST_RUNS}", "ranges")
    smallest: dict[str, Extreme] = {}
    largest: dict[str, Extreme] = {}
    failed = 0
    for done, corner in enumerate(combinations(chosen), start=1):
        found = _outcome(inputs, corner)
        if found is None:
            failed += 1
        else:
            _note(found, corner, figures, smallest, largest)
        if progress is not None:
            progress(done, runs)
    warnings = () if not failed else (unconverged(failed),)
    return Corners(smallest, largest, runs, failed, warnings)


def unconverged(failed: int) -> Notice:
    """What extremes over corners have to say where some have no solution."""
    return Notice(
        "no_convergence_of_corner", f"{failed} corners have no solution; the extremes are of the rest", "ranges"
    )


def combinations(ranges: Sequence[Range]) -> Iterator[dict[str, Any]]:
    """Every corner: the product of the ranges, the last fastest."""
    for choices in product(*(list(one.choices()) for one in ranges)):
        yield {name: value for choice in choices for name, value in choice.items()}


def _outcome(inputs: DriveTrainInputs, corner: dict[str, Any]) -> Outcome | None:
    """A corner's outcome; None without solution.

    Each starts anew: a neighbour's gap saves no step of the iteration, and every corner stands for itself this way.
    """
    try:
        return outcome(varied(inputs, corner))
    except NoSolution:
        return None


def _note(
    found: Outcome,
    corner: dict[str, Any],
    figures: Sequence[str],
    smallest: dict[str, Extreme],
    largest: dict[str, Extreme],
) -> None:
    for name in figures:
        value = getattr(found, name)
        if value is None:
            continue
        if name not in smallest or value < smallest[name].value:
            smallest[name] = Extreme(value, corner)
        if name not in largest or value > largest[name].value:
            largest[name] = Extreme(value, corner)
