"""Worst corners: every combination of the ends of what nobody knows better."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import prod
from typing import Any

from solvers.arrays import FloatArray
from solvers.drive_train.inputs import DriveTrainInputs, JournalBearing, Shaft
from solvers.drive_train.outcome import FIGURES, Outcome, check_figure, outcome
from solvers.drive_train.variation import varied
from solvers.errors import InvalidInput, NoSolution
from solvers.notices import Notice

MOST_RUNS = 256
FRICTION = (0.05, 0.25)
THRUST = (0.0, 1.0)
RESPONSE = (0.3, 1.0)
CLEARANCE = 0.1


@dataclass(frozen=True, slots=True)
class Range:
    """Values that an input may take, at a dotted name."""

    name: str
    values: tuple[Any, ...]


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
    """Friction and thrust of the couplings, direction of their offset, wall response, tilt of each shaft by clearance.

    The clearances of a shaft's two bearings move 10 % in opposite senses, for what they share does not tilt.
    """
    ranges = [Range("heat.wall_response", RESPONSE)] if inputs.effects.thermal else []
    if inputs.effects.shafts:
        ranges += [
            Range(f"{name}.bearings", (_clearances(shaft, CLEARANCE), _clearances(shaft, -CLEARANCE)))
            for name, shaft in (("pinion_shaft", inputs.pinion_shaft), ("wheel_shaft", inputs.wheel_shaft))
            if any(isinstance(bearing, JournalBearing) for bearing in shaft.bearings)
        ]
    for k, coupling in enumerate(inputs.acting_couplings):
        x, y = coupling.offset
        ranges += [
            Range(f"couplings.{k}.friction.coefficient", FRICTION),
            Range(f"couplings.{k}.offset", ((x, y), (-y, x), (-x, -y), (y, -x))),
            Range(f"couplings.{k}.thrust_fraction", THRUST),
        ]
    return tuple(ranges)


def _clearances(shaft: Shaft, share: float) -> tuple[Any, ...]:
    """Bearings with clearances up by a share at the first, down at the second."""
    return tuple(
        replace(bearing, radial_clearance=bearing.clearance * (1 + sign * share))
        if isinstance(bearing, JournalBearing)
        else bearing
        for bearing, sign in zip(shaft.bearings, (1.0, -1.0), strict=True)
    )


def run_corners(
    inputs: DriveTrainInputs,
    ranges: Sequence[Range] | None = None,
    figures: Sequence[str] = FIGURES,
    progress: Callable[[int, int], None] | None = None,
) -> Corners:
    """Extremes of the figures over the product of the ranges, each run from its neighbour's gap.

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
    for done, (corner, found) in enumerate(_outcomes(inputs, chosen), start=1):
        if found is None:
            failed += 1
        else:
            _note(found, corner, figures, smallest, largest)
        if progress is not None:
            progress(done, runs)
    warnings = () if not failed else (_unconverged(failed),)
    return Corners(smallest, largest, runs, failed, warnings)


def _unconverged(failed: int) -> Notice:
    return Notice(
        "no_convergence_of_corner", f"{failed} corners have no solution; the extremes are of the rest", "ranges"
    )


def _outcomes(inputs: DriveTrainInputs, ranges: tuple[Range, ...]) -> Iterator[tuple[dict[str, Any], Outcome | None]]:
    """Every corner and its outcome."""
    start: FloatArray | None = None
    for values in product(*(one.values for one in ranges)):
        corner = {one.name: value for one, value in zip(ranges, values, strict=True)}
        try:
            found = outcome(varied(inputs, corner), start)
        except NoSolution:
            yield corner, None
        else:
            start = found.gap
            yield corner, found


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
