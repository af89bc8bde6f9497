"""A search along one input: where an output has a given value, or where it is least or greatest.

The search asks for the output at some places, is told the values, and asks again. First the whole range is scanned.
Then the ends of gaps are narrowed, turns of the curve are followed that may hide two answers between two points, and
SciPy narrows every bracket. Each step is a pure function of the values told so far: SciPy's methods are repeated from
their beginning with these values, and stop at the first place that is new.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial
from itertools import pairwise
from typing import Literal, NamedTuple

from scipy.optimize import brentq, minimize_scalar

from app.schema.precision import is_constant

Extreme = Literal["least", "greatest"]

PLACE_WITHIN = 1e-6  # of the range; brackets are not narrowed further
VALUE_WITHIN = 1e-6  # of the wanted value, or of the spread of the curve if that is zero; this close is as wanted
JUMP = 1e-2  # of the spread of the curve; a larger change between two places that cannot be told apart is a jump
EDGE = 1 / 16  # of a step of the scan; ends of gaps are not narrowed further
MOST_AT_EDGES = 24  # places that narrow the ends of gaps; more gaps than these find out are no curve
TURN_WITHIN = 5e-3  # of the interval around a turn; two steps of the scan
MOST_TURNS = 4  # turns that are followed, the most promising first
OUTLINE, TURN, ROOT = range(3)  # what a place was asked for


class _Unknown(Exception):
    """Stops a method of SciPy at a place that is not told yet; the argument is the place."""


class _Ended(Exception):
    """Stops a method of SciPy that has found what it was asked for, or a place without a solution."""


@dataclass(frozen=True, slots=True)
class Search:
    """Values of an output along an input, and what is sought: the value `wanted`, or an `extreme`.

    A place is a share of the range from 0 to 1 or, if the places are `whole`, an index in a list of values. `told`
    holds the outputs by their places; None stands for a place without a solution. `asked` says what a place was asked
    for.
    """

    scan: tuple[float, ...]
    wanted: float | None = None
    extreme: Extreme | None = None
    whole: bool = False
    told: dict[float, float | None] = field(default_factory=dict)
    asked: dict[float, int] = field(default_factory=dict)

    def tell(self, place: float, output: float | None, asked: int) -> None:
        self.told[place] = output
        self.asked[place] = asked

    def curve(self, most: int = ROOT) -> list[tuple[float, float | None]]:
        """Return places and outputs in the order of the places, without those that were asked for later than `most`."""
        return sorted(pair for pair in self.told.items() if self.asked[pair[0]] <= most)

    @property
    def solved(self) -> list[tuple[float, float]]:
        """Places and outputs, without the places that have no solution."""
        return [(place, output) for place, output in self.curve() if output is not None]

    @property
    def spread(self) -> float:
        """Difference between the greatest and the least output of the scan."""
        outputs = [output for _, output in self.curve(OUTLINE) if output is not None]
        return max(outputs, default=0.0) - min(outputs, default=0.0)

    @property
    def is_constant(self) -> bool:
        """Whether the output does not depend on the input: at least two places have an output, and all are equal."""
        return is_constant([output for _, output in self.solved])

    def side(self, output: float) -> int:
        """Return on which side of the wanted value an output lies: -1 below, 0 at it, 1 above."""
        assert self.wanted is not None
        beyond = output - self.wanted
        # The spread is no scale of another value: of a curve over decades it is that of the far end.
        return 0 if abs(beyond) <= VALUE_WITHIN * (abs(self.wanted) or self.spread) else 1 if beyond > 0.0 else -1

    @property
    def nearest(self) -> tuple[float, float] | None:
        """The place, and its output, where the output comes closest to what is sought; None without any solution."""
        return min(self.solved, key=lambda pair: self.distance(pair[1]), default=None)

    def distance(self, output: float) -> float:
        """Return how far an output is from what is sought, up to a constant."""
        if self.wanted is not None:
            return abs(output - self.wanted)
        return output if self.extreme == "least" else -output


class Step(NamedTuple):
    """The places to ask for next, and what for; no places if the search has ended."""

    asked: int
    places: list[float]


def next_step(search: Search) -> Step:
    """Return the places to ask for next."""
    if left := [place for place in search.scan if place not in search.told]:
        return Step(OUTLINE, left)
    if search.is_constant:
        return Step(ROOT, [])
    for asked, step in ((OUTLINE, _edges), (TURN, _turns), (ROOT, _roots)):
        if places := sorted(set(step(search))):
            return Step(asked, places)
    return Step(ROOT, [])


def _edges(search: Search) -> Iterator[float]:
    """Yield a place between each solved place and an unsolved one beside it, unless both are close together."""
    closest, outline = 1 if search.whole else EDGE / (len(search.scan) - 1), search.curve(OUTLINE)
    if len(outline) - len(search.scan) >= MOST_AT_EDGES:
        return
    for (low, one), (high, other) in pairwise(outline):
        if (one is None) != (other is None) and high - low > closest:
            yield _middle(search, low, high)


def _turns(search: Search) -> Iterator[float]:
    """Yield the next place of each turn that is followed.

    If a value is wanted, a turn is a place closer to it than both neighbours, all on one side. If an extreme is sought,
    a turn is a place better than both neighbours. An end of the curve needs only one; if a value is wanted, the curve
    must also bend back before it.
    """
    outline = search.curve(OUTLINE)
    turns: list[tuple[float, float, float, float]] = []
    for index, (place, output) in enumerate(outline):
        around = outline[max(index - 1, 0) : index + 2]
        solved = [(at, value) for at, value in around if value is not None]
        beside = [value for at, value in solved if at != place]
        if output is None or not _is_turn(search, output, beside):
            continue
        if search.wanted is None or len(beside) > 1 or _bends_back(search, outline[::-1] if index else outline):
            turns.append((search.distance(output), output, solved[0][0], solved[-1][0]))
    for _, output, low, high in sorted(turns)[:MOST_TURNS]:
        if search.whole:
            yield from _beside_the_nearest(search, low, high)
            continue
        upcoming = _replayed(search, partial(_least, low=low, high=high), partial(_approach, search, output))
        if upcoming is not None:
            yield upcoming


def _beside_the_nearest(search: Search, low: float, high: float) -> Iterator[float]:
    """Yield a place on each side of the best place of an interval, until its neighbours in the list are known."""
    inner = [pair for pair in search.solved if low <= pair[0] <= high]
    at = min(range(len(inner)), key=lambda index: search.distance(inner[index][1]))
    for (left, _), (right, _) in pairwise(inner[max(at - 1, 0) : at + 2]):
        if right - left > 1:
            yield _middle(search, left, right)


def _is_turn(search: Search, output: float, beside: list[float]) -> bool:
    """Return whether the curve turns at an output between those of its neighbours; it ends if there is only one."""
    own, distances = search.distance(output), [search.distance(value) for value in beside]
    if not distances or not own <= min(distances) or own == max(distances):
        return False
    sides = {search.side(value) for value in (output, *beside)} if search.wanted is not None else {1}
    return search.wanted is None or (len(sides) == 1 and 0 not in sides)


def _bends_back(search: Search, outline: list[tuple[float, float | None]]) -> bool:
    """Return whether the parabola through the first three places of a curve turns between the first two."""
    if len(outline) < 3 or any(output is None for _, output in outline[:3]):
        return False
    (x, one), (y, two), (z, three) = ((place, search.distance(output or 0.0)) for place, output in outline[:3])
    first, second = (one - two) / (x - y), (two - three) / (y - z)
    return (first + (first - second) / (x - z) * (x - y)) * (x - y) > 0.0


def _approach(search: Search, first: float, output: float) -> float:
    """Return how far an output is from what is sought; end the search if the output is on another side than `first`."""
    if search.wanted is not None and search.side(output) != search.side(first):
        raise _Ended
    return search.distance(output)


def _least(value: Callable[[float], float], low: float, high: float) -> None:
    minimize_scalar(value, bounds=(low, high), method="bounded", options={"xatol": TURN_WITHIN * (high - low)})


def _roots(search: Search) -> Iterator[float]:
    """Yield the next place in each bracket of the wanted value."""
    if search.wanted is None:
        return
    for (low, one), (high, other) in pairwise(search.curve(TURN)):
        if one is None or other is None or search.side(one) * search.side(other) >= 0:
            continue
        if search.whole:
            inner = [pair for pair in search.solved if low <= pair[0] <= high]
            for (left, before), (right, after) in pairwise(inner):
                if search.side(before) * search.side(after) < 0 and right - left > 1:
                    yield _middle(search, left, right)
        elif (place := _replayed(search, partial(_root, low=low, high=high), partial(_beyond, search))) is not None:
            yield place


def _beyond(search: Search, output: float) -> float:
    """Return how far an output lies beyond the wanted value; zero if it is the wanted value."""
    return 0.0 if search.side(output) == 0 else output - (search.wanted or 0.0)


def _root(value: Callable[[float], float], low: float, high: float) -> None:
    brentq(value, low, high, xtol=PLACE_WITHIN)


def _replayed(
    search: Search, method: Callable[[Callable[[float], float]], None], read: Callable[[float], float]
) -> float | None:
    """Run a method of SciPy with the values told so far; return the first place it lacks, or None if it has ended.

    `read` makes the value for the method from an output.
    """

    def value(place: float) -> float:
        place = float(place)
        if place not in search.told:
            raise _Unknown(place)
        output = search.told[place]
        if output is None:
            raise _Ended
        return read(output)

    try:
        method(value)
    except _Unknown as unknown:
        return float(unknown.args[0])
    except _Ended:
        pass
    return None


def _middle(search: Search, low: float, high: float) -> float:
    return (low + high) // 2 if search.whole else (low + high) / 2.0


class Answer(NamedTuple):
    """A place where the output has the wanted value.

    The curve keeps this value up to the place `until`. `before` and `after` are the sides of the wanted value on which
    the curve comes and goes: -1 below, 1 above, 0 if it begins or ends there.
    """

    place: float
    until: float
    output: float
    before: int
    after: int


Kind = Literal["jump", "gap", "between"]


class Crossing(NamedTuple):
    """Two places between which the curve passes the wanted value without having it.

    `jump`: the two places cannot be told apart; `gap`: between them is no solution; `between`: between them is nothing
    else, because they are neighbours in a list of values, or the search was ended.
    """

    kind: Kind
    places: tuple[float, float]
    outputs: tuple[float, float]


def found(search: Search) -> tuple[list[Answer], list[Crossing]]:
    """Return where the output has the wanted value, and where it passes this value without having it."""
    answers, crossings = list[Answer](), list[Crossing]()
    last, side, is_gap = (0.0, 0.0), 0, False
    for place, output in search.curve():
        if output is None:
            is_gap = True
            continue
        before, side = side, search.side(output)
        if side == 0 and answers and answers[-1].until == last[0] and not is_gap:
            answers[-1] = answers[-1]._replace(until=place)
        elif side == 0:
            answers.append(Answer(place, place, output, before, 0))
        elif before == 0 and answers and answers[-1].until == last[0]:
            answers[-1] = answers[-1]._replace(after=side)
        elif before * side < 0:
            crossing = _crossing(search, last, (place, output), is_gap=is_gap)
            if crossing.kind == "between" and not search.whole and place - last[0] <= PLACE_WITHIN:
                at, value = min((last, (place, output)), key=lambda pair: search.distance(pair[1]))
                answers.append(Answer(at, at, value, before, side))
            else:
                crossings.append(crossing)
        last, is_gap = (place, output), False
    return answers, crossings


def _crossing(search: Search, low: tuple[float, float], high: tuple[float, float], *, is_gap: bool) -> Crossing:
    steep = not search.whole and high[0] - low[0] <= PLACE_WITHIN and abs(high[1] - low[1]) > JUMP * search.spread
    kind: Kind = "gap" if is_gap else "jump" if steep else "between"
    return Crossing(kind, (low[0], high[0]), (low[1], high[1]))
