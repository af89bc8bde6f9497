"""Statements with numbers from papers, books and standards, and the numbers that the solvers compute for comparison.

Tests, manual and `benchmarks.papers` share them.
"""

from benchmarks.published import coupling, micropitting, pumping, scuffing, standard
from benchmarks.published.statement import Row, Statement

STATEMENTS: dict[str, tuple[Statement, ...]] = {
    "coupling": coupling.STATEMENTS,
    "pumping": pumping.STATEMENTS,
    "scuffing": scuffing.STATEMENTS,
    "micropitting": micropitting.STATEMENTS,
    "standard": standard.STATEMENTS,
}

__all__ = ["STATEMENTS", "Row", "Statement"]
