"""One published statement with a number, and how it is computed here."""

from collections.abc import Callable
from dataclasses import dataclass
from math import inf

INDEPENDENT = "the paper shows a curve; the number is an independent calculation's"


@dataclass(frozen=True, slots=True)
class Row:
    """A statement beside its computed number; deviation [-] is relative to the printed number, None for a bound."""

    statement: str
    source: str
    printed: str
    computed: float
    unit: str
    deviation: float | None
    holds: bool
    remark: str


@dataclass(frozen=True, slots=True)
class Statement:
    """What a source says: a number with the tolerance argued for it, or a bound; `remark` where it does not hold."""

    says: str
    source: str
    printed: str
    unit: str
    compute: Callable[[], float]
    least: float
    most: float
    number: float | None = None
    remark: str = ""

    def row(self) -> Row:
        """The statement with the number that is computed now."""
        computed = self.compute()
        deviation = None if not self.number else computed / self.number - 1.0
        holds = self.least <= computed <= self.most
        return Row(self.says, self.source, self.printed, computed, self.unit, deviation, holds, self.remark)


def equals(
    says: str, source: str, number: float, unit: str, compute: Callable[[], float], tolerance: float, remark: str = ""
) -> Statement:
    """A printed number with a relative tolerance."""
    margin = tolerance * abs(number)
    return Statement(says, source, f"{number:g}", unit, compute, number - margin, number + margin, number, remark)


def below(says: str, source: str, bound: float, unit: str, compute: Callable[[], float]) -> Statement:
    """A printed upper bound."""
    return Statement(says, source, f"below {bound:g}", unit, compute, -inf, bound)


def above(says: str, source: str, bound: float, unit: str, compute: Callable[[], float]) -> Statement:
    """A printed lower bound."""
    return Statement(says, source, f"above {bound:g}", unit, compute, bound, inf)


def between(says: str, source: str, low: float, high: float, unit: str, compute: Callable[[], float]) -> Statement:
    """A printed range."""
    return Statement(says, source, f"{low:g} to {high:g}", unit, compute, low, high)


def not_reproduced(
    says: str, source: str, number: float, unit: str, compute: Callable[[], float], found: float, remark: str
) -> Statement:
    """A printed number that its own equations do not give; the test holds on to what they do give, to 3 %."""
    return Statement(says, source, f"{number:g}", unit, compute, 0.97 * found, 1.03 * found, number, remark)
