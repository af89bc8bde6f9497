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


@dataclass(frozen=True, slots=True)
class Says:
    """What a source says, in words; each method adds the number and how it is computed here."""

    source: str
    words: str

    def equals(
        self, number: float, unit: str, compute: Callable[[], float], tolerance: float, remark: str = ""
    ) -> Statement:
        """A printed number with a relative tolerance."""
        least, most = number - tolerance * abs(number), number + tolerance * abs(number)
        return Statement(self.words, self.source, f"{number:g}", unit, compute, least, most, number, remark)

    def below(self, bound: float, unit: str, compute: Callable[[], float]) -> Statement:
        """A printed upper bound."""
        return Statement(self.words, self.source, f"below {bound:g}", unit, compute, -inf, bound)

    def above(self, bound: float, unit: str, compute: Callable[[], float]) -> Statement:
        """A printed lower bound."""
        return Statement(self.words, self.source, f"above {bound:g}", unit, compute, bound, inf)

    def between(self, low: float, high: float, unit: str, compute: Callable[[], float]) -> Statement:
        """A printed range."""
        return Statement(self.words, self.source, f"{low:g} to {high:g}", unit, compute, low, high)

    def not_reproduced(
        self, number: float, unit: str, compute: Callable[[], float], found: float, remark: str
    ) -> Statement:
        """A printed number that its own equations do not give; the test holds on to what they do give, to 3 %."""
        least, most = 0.97 * found, 1.03 * found
        return Statement(self.words, self.source, f"{number:g}", unit, compute, least, most, number, remark)
