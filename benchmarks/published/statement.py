"""A published statement with a number, and the number that the solvers compute for comparison."""

from collections.abc import Callable
from math import inf

from solvers.quantity import described, record

INDEPENDENT = "the paper shows a curve; the number is an independent calculation's"


@record
class Row:
    """A published statement, and the number that the solvers compute for comparison."""

    statement: str = described("What the source says.")
    source: str = described("Paper, and its equation, table or figure.")
    printed: str = described("The number or bound that the source prints.")
    computed: float = described("The number that is computed here, in `unit`.")
    unit: str = described("Unit of both numbers; empty for a number without a unit.")
    deviation: float | None = described("Deviation from the printed number, relative to it; None for a bound [-].")
    holds: bool = described("Whether the computed number is within the tolerance.")
    remark: str = described("Why the statement does not hold; empty if it holds.")


@record
class Statement:
    """A published statement, and the function that computes the number for comparison.

    The source prints a number, a bound or a range. The statement holds if the computed number lies between `least` and
    `most`.
    """

    says: str = described("What the source says.")
    source: str = described("Paper, and its equation, table or figure.")
    printed: str = described("The number or bound that the source prints.")
    unit: str = described("Unit of the numbers; empty for a number without a unit.")
    compute: Callable[[], float] = described("Function that computes the number here, in `unit`.")
    least: float = described("Least number at which the statement holds, in `unit`.")
    most: float = described("Largest number at which the statement holds, in `unit`.")
    number: float | None = described("The printed number; None for a bound, in `unit`.", default=None)
    remark: str = described("Why the statement does not hold; empty if it holds.", default="")

    def row(self) -> Row:
        """Compute the number, and return a row with the statement and the computed number."""
        computed = self.compute()
        deviation = None if not self.number else computed / self.number - 1.0
        holds = self.least <= computed <= self.most
        return Row(self.says, self.source, self.printed, computed, self.unit, deviation, holds, self.remark)


@record
class Says:
    """A sentence of a source. Every method makes a `Statement` from this sentence.

    The argument `compute` of the methods is the function that computes the number with the solvers.
    """

    source: str
    words: str

    def equals(
        self, number: float, unit: str, compute: Callable[[], float], tolerance: float, remark: str = ""
    ) -> Statement:
        """Return the statement that the computed number equals a printed number. `tolerance` is relative."""
        least, most = number - tolerance * abs(number), number + tolerance * abs(number)
        return Statement(self.words, self.source, f"{number:g}", unit, compute, least, most, number, remark)

    def below(self, bound: float, unit: str, compute: Callable[[], float]) -> Statement:
        """Return the statement that the computed number is below a printed bound."""
        return Statement(self.words, self.source, f"below {bound:g}", unit, compute, -inf, bound)

    def above(self, bound: float, unit: str, compute: Callable[[], float]) -> Statement:
        """Return the statement that the computed number is above a printed bound."""
        return Statement(self.words, self.source, f"above {bound:g}", unit, compute, bound, inf)

    def between(self, low: float, high: float, unit: str, compute: Callable[[], float]) -> Statement:
        """Return the statement that the computed number is within a printed range."""
        return Statement(self.words, self.source, f"{low:g} to {high:g}", unit, compute, low, high)

    def not_reproduced(
        self, number: float, unit: str, compute: Callable[[], float], by_equations: float, remark: str
    ) -> Statement:
        """Return a statement whose printed number disagrees with the equations of the same source.

        `by_equations` is the number that follows from these equations. The statement holds if the computed number
        differs from `by_equations` by at most 3 %.
        """
        least, most = 0.97 * by_equations, 1.03 * by_equations
        return Statement(self.words, self.source, f"{number:g}", unit, compute, least, most, number, remark)
