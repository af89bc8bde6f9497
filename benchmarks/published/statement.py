"""A published statement with a number, and the number that the solvers compute for comparison."""

from collections.abc import Callable
from dataclasses import replace
from math import inf
from typing import Literal

from solvers.quantity import described, record

Basis = Literal["printed", "bound", "independent calculation"]
"""Where the number to compare with comes from.

printed                  the source prints this number
bound                    the source says it in words, as a curve or as a range
independent calculation  the source shows no number; ours come from another calculation or from a closed form
"""


@record
class Row:
    """A published statement, and the number that the solvers compute for comparison."""

    statement: str = described("What the source says.")
    source: str = described("Paper, and its equation, table or figure.")
    basis: Basis = described("Where the expected number comes from.")
    expected: str = described("The number or bound to compare with.")
    computed: float = described("The number that is computed here, in `unit`.")
    unit: str = described("Unit of both numbers; empty for a number without a unit.")
    deviation: float | None = described("Deviation from the expected number, relative to it; None for a bound [-].")
    holds: bool = described("Whether the computed number is within the tolerance.")
    remark: str = described("Why the statement does not hold; empty if it holds.")


@record
class Statement:
    """A published statement, and the function that computes the number for comparison.

    It holds if the computed number lies between `least` and `most`.
    """

    says: str = described("What the source says.")
    source: str = described("Paper, and its equation, table or figure.")
    basis: Basis = described("Where the expected number comes from.")
    expected: str = described("The number or bound to compare with.")
    unit: str = described("Unit of the numbers; empty for a number without a unit.")
    compute: Callable[[], float] = described("Function that computes the number here, in `unit`.")
    least: float = described("Least number at which the statement holds, in `unit`.")
    most: float = described("Largest number at which the statement holds, in `unit`.")
    number: float | None = described("The expected number; None for a bound, in `unit`.", default=None)
    remark: str = described("Why the statement does not hold; empty if it holds.", default="")

    def row(self) -> Row:
        """Compute the number."""
        computed = self.compute()
        deviation = None if not self.number else computed / self.number - 1.0
        holds = self.least <= computed <= self.most
        return Row(
            self.says, self.source, self.basis, self.expected, computed, self.unit, deviation, holds, self.remark
        )


@record
class Says:
    """A sentence of a source, of which every method makes a `Statement`; `compute` gives our number."""

    source: str
    words: str

    def equals(
        self, number: float, unit: str, compute: Callable[[], float], tolerance: float, remark: str = ""
    ) -> Statement:
        """The source prints this number. `tolerance` is relative."""
        return self._near("printed", number, unit, compute, tolerance, remark)

    def prints(self, digits: str, unit: str, compute: Callable[[], float]) -> Statement:
        """The source prints these digits. The tolerance is one unit of the last one."""
        step = 10.0 ** -len(digits.partition(".")[2])
        statement = self._near("printed", float(digits), unit, compute, step / float(digits), "")
        return replace(statement, expected=digits)

    def calculated(self, number: float, unit: str, compute: Callable[[], float], tolerance: float) -> Statement:
        """An independent calculation or a closed form gives this number, which no source prints."""
        return self._near("independent calculation", number, unit, compute, tolerance, "")

    def _near(
        self, basis: Basis, number: float, unit: str, compute: Callable[[], float], tolerance: float, remark: str
    ) -> Statement:
        least, most = number - tolerance * abs(number), number + tolerance * abs(number)
        return Statement(self.words, self.source, basis, f"{number:.6g}", unit, compute, least, most, number, remark)

    def below(self, bound: float, unit: str, compute: Callable[[], float]) -> Statement:
        """The number is below a bound."""
        return Statement(self.words, self.source, "bound", f"below {bound:g}", unit, compute, -inf, bound)

    def above(self, bound: float, unit: str, compute: Callable[[], float]) -> Statement:
        """The number is above a bound."""
        return Statement(self.words, self.source, "bound", f"above {bound:g}", unit, compute, bound, inf)

    def between(self, low: float, high: float, unit: str, compute: Callable[[], float]) -> Statement:
        """The number is within a range."""
        return Statement(self.words, self.source, "bound", f"{low:g} to {high:g}", unit, compute, low, high)

    def not_reproduced(
        self, number: float, unit: str, compute: Callable[[], float], by_equations: float, remark: str
    ) -> Statement:
        """The printed number disagrees with the printed equations, which give `by_equations` within 3 %."""
        least, most = 0.97 * by_equations, 1.03 * by_equations
        return Statement(self.words, self.source, "printed", f"{number:g}", unit, compute, least, most, number, remark)
